// What is drawn in the plane as a condition: regions to keep out of, limits of pivots, the footprint.

import { put, s, say } from "../widget/dom.mjs";
import { act } from "../widget/kinematics.mjs";
import { shortened } from "../widget/tables.mjs";
import { atReference, referencePlace } from "./body_editor.mjs";
import { currentLinkage, limitsMissed, missedSentence, regionsTouched } from "./conditions.mjs";
import { addRegion, bodyOf, isOnBody, limitPart, limitRegions, limitsOf, regionsOf, removeRegion, setLimit, setRegion, setRequirement, shapeOf } from "./document.mjs";
import { along } from "./name_places.mjs";
import { outlineOf } from "./region_geometry.mjs";
import { bounds } from "../widget/framing.mjs";
import { Kept } from "./scene.mjs";
import { GROUND, ShapeHandles } from "./shape_handles.mjs";
import { ShapeTool } from "./shape_tool.mjs";

const LONGEST_NAME = 22;
const ABOVE = 10; // pixels from an edge to the middle of a name
const HATCH = 9; // pixels between the lines of a hatch
const NAMES = { fixed_pivot: "Fixed pivot", moving_pivot: "Moving pivot", "rail through": "Rail through", "rail travel": "Rail travel", "slot through": "Slot through", "slot travel": "Slot travel" };

/** What a limit is called: of which pivot, and of which dyad where there are two tables. */
export function limitName(document, { table, key }) {
  return `${NAMES[key]}${limitsOf(document).length > 1 ? ` of dyad ${table + 1}` : ""}`;
}

/** A region's shape and points; null where it is a drawing.
 * @returns {any} */
function regionShape(region) {
  if (region.box) return { shape: "box", points: region.box };
  return region.polygon ? { shape: "polygon", points: region.polygon } : null;
}

export class Regions {
  /** @type {any} */ onjudged;

  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.shapes = new Map();
    scene.layer("regions").append(s("defs", {}, s("pattern", { id: "bs-hatch", width: HATCH, height: HATCH, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" }, s("path", { class: "bm-hatch", d: `M0 0V${HATCH}` }))));
    this.regions = new Kept(s("g"), (key, k) => this.makeRegion(k), (element) => this.shapes.get(element).draw());
    this.footprint = new Kept(s("g"), () => this.makeFootprint(), (element) => this.shapes.get(element).draw());
    this.limits = new Kept(s("g"), (key, limit) => this.makeLimit(limit), (element) => this.shapes.get(element).draw());
    this.names = new Kept(s("g", { class: "bs-region-names", "aria-hidden": "true" }), () => s("text", {}), (text, name) => this.showName(text, name));
    scene.layer("regions").append(this.regions.group, this.footprint.group);
    scene.layer("limits").append(this.limits.group);
    scene.layer("labels").append(this.names.group);
    store.on("document", () => this.judge(store.state === "dragging" && !this.isOther()));
    store.on("selection reference", () => this.draw());
    store.on("solved followed chosen placed", () => this.judge());
    scene.on("view", () => this.draw());
    scene.hold(() => limitRegions(store.document).filter(({ shape }) => shape !== "line").flatMap((each) => this.corners(each)));
    scene.hold(() => regionsOf(store.document).map(regionShape).filter(Boolean).flatMap(({ shape, points }) => outlineOf(shape, points)), true);
    this.judge();
  }

  place({ key }) {
    return isOnBody(key) ? referencePlace(this.store) : GROUND;
  }

  corners(limit) {
    return outlineOf(limit.shape, limit.points).map((point) => act(this.place(limit), point));
  }

  /** Whether what must not be touched, or what touches, is another than when it was judged. */
  isOther() {
    const { body, keep_out, surroundings } = this.store.document, now = [body, keep_out, surroundings];
    return now.some((each, k) => each !== this.judged?.[k]);
  }

  /** What the chosen linkage meets and breaks; it is drawn, and said in the lists.
   *
   * pivots: of limits only, for what is touched follows with the linkage.
   */
  judge(pivots = false) {
    const { document, solved } = this.store, linkage = currentLinkage(this.store);
    this.broken = linkage?.led ? limitsMissed(document, linkage, solved?.scene ?? 1) : null;
    if (!pivots) {
      this.judged = [document.body, document.keep_out, document.surroundings];
      this.touched = linkage?.led ? regionsTouched(document, linkage, bodyOf(document)) : null;
    }
    this.draw();
    this.onjudged?.();
  }

  /** Sentences on a limit, by its table and key; null where no linkage is there, and of rails, which only the search judges. */
  said(table, key) {
    return /^(rail|slot)/.test(key) ? null : this.broken?.[table]?.filter((each) => each.key === key).map((each) => missedSentence(each, this.store.document.length_unit)) ?? null;
  }

  draw() {
    const { document } = this.store, regions = regionsOf(document), limits = limitRegions(document), { footprint } = document.requirements ?? {};
    this.regions.draw(regions.map((region, k) => [k, k]).filter(([k]) => regionShape(regions[k])));
    this.limits.draw(limits.map((limit) => [`${limit.table} ${limit.key}`, limit]));
    this.footprint.draw(footprint ? [["footprint", footprint]] : []);
    for (const [element, handles] of this.shapes) {
      if (element.parentNode) continue;
      handles.clear();
      this.shapes.delete(element);
    }
    this.names.draw([
      ...regions.map((region, k) => [`region ${k}`, region.name && regionShape(region) ? { text: region.name, at: middle(outlineOf(...Object.values(regionShape(region)))) } : null]),
      ...limits.map((limit) => [`limit ${limit.table} ${limit.key}`, { text: limitName(document, limit), at: middleOf(this.corners(limit), isOnBody(limit.key)), off: isOnBody(limit.key) ? ABOVE : -ABOVE, width: widthOf(this.corners(limit)) }]),
      ["footprint", footprint ? { text: "Footprint", at: middleOf(footprint.polygon ?? outlineOf("box", footprint.box), true), off: ABOVE, width: widthOf(footprint.polygon ?? footprint.box) } : null],
    ].filter(([, name]) => name));
  }

  kept(handles) {
    this.shapes.set(handles.element, handles);
    return handles.element;
  }

  makeRegion(k) {
    const { store } = this;
    const handles = new ShapeHandles(this.scene, {
      className: "bs-region",
      what: () => {
        const region = regionsOf(store.document)[k];
        return {
          ...regionShape(region), place: GROUND, name: region.name ? `Keep out: ${region.name}` : `Region ${k + 1} to keep out of`,
          selected: store.selection?.kind === "region" && store.selection.index === k, state: this.touched ? (this.touched[k] ? "broken" : "met") : "", data: { region: k },
        };
      },
      set: (points, gesture) => store.edit((document) => setRegion(document, k, shapeOf(regionShape(regionsOf(document)[k]).shape, points)), { gesture }),
      remove: () => this.removeRegion(k),
      select: () => store.select({ kind: "region", index: k }),
      abandon: (gesture) => store.abandon(gesture),
    });
    handles.element.insertBefore(s("path", { class: "bs-hatched", fill: "url(#bs-hatch)" }), handles.area);
    const draw = handles.draw.bind(handles);
    handles.draw = () => {
      draw();
      handles.element.querySelector(".bs-hatched").setAttribute("d", handles.line.getAttribute("d"));
    };
    return this.kept(handles);
  }

  removeRegion(k) {
    this.store.edit((document) => removeRegion(document, k));
    this.store.select(null);
    this.scene.svg.focus({ preventScroll: true });
  }

  makeLimit({ table, key }) {
    const { store } = this, place = () => this.place({ key });
    const at = () => limitRegions(store.document).findIndex((each) => each.table === table && each.key === key);
    return this.kept(new ShapeHandles(this.scene, {
      className: `bs-limit bs-${key.replace(/[_ ]/, "-")}`,
      what: () => {
        const index = at(), limit = limitRegions(store.document)[index], said = this.said(table, key);
        return {
          ...limit, place: place(), name: `Limit: ${limitName(store.document, limit)}`, selected: store.selection?.kind === "limit" && store.selection.index === index,
          state: said ? (said.length ? "broken" : "met") : "", data: { limit: index, plane: isOnBody(key) ? "M" : "F" },
        };
      },
      set: (points, gesture) => store.edit((document) => setLimit(document, table, { [key]: shapeOf(Object.keys(limitPart(limitsOf(document)[table], key))[0], points) }), { gesture }),
      remove: () => this.removeLimit(table, key),
      select: () => store.select({ kind: "limit", index: at() }),
      abandon: (gesture) => store.abandon(gesture),
    }));
  }

  removeLimit(table, key) {
    this.store.edit((document) => setLimit(document, table, { [key]: undefined }));
    this.store.select(null);
    this.scene.svg.focus({ preventScroll: true });
  }

  makeFootprint() {
    const { store } = this, shape = () => Object.keys(store.document.requirements.footprint)[0];
    return this.kept(new ShapeHandles(this.scene, {
      className: "bs-footprint",
      what: () => ({ shape: shape(), points: store.document.requirements.footprint[shape()], place: GROUND, name: "Footprint: holds all pivots", selected: store.selection?.kind === "footprint", data: { footprint: "" } }),
      set: (points, gesture) => store.edit((document) => setRequirement(document, "footprint", { [shape()]: points }), { gesture }),
      remove: () => {
        store.edit((document) => setRequirement(document, "footprint", undefined));
        store.select(null);
      },
      select: () => store.select({ kind: "footprint", index: 0 }),
      abandon: (gesture) => store.abandon(gesture),
    }));
  }

  showName(text, { text: name, at: [x, y], off, width }) {
    const { scene } = this, { view } = scene, shown = shortened(name, LONGEST_NAME);
    say(text, shown);
    put(text, "class", off ? "bs-limit-name" : "bs-region-name");
    scene.names.put(text, view.X(x), view.Y(y), shown, off ? along(off, view.scale * (width ?? 0)) : [[0, 0, 0]], Boolean(off));
  }

  // Tools that draw a new one

  regionTool(shape) {
    const { store } = this;
    return new ShapeTool(this.scene, {
      shape, name: `region ${shape}`, place: () => GROUND,
      done: (points) => {
        store.edit((document) => addRegion(document, { [shape]: points }));
        store.select({ kind: "region", index: regionsOf(store.document).length - 1 });
      },
    });
  }

  limitTool(table, key, shape) {
    const { store } = this;
    return new ShapeTool(this.scene, {
      shape, name: `limit ${table} ${key} ${shape}`, place: () => this.place({ key }), at: isOnBody(key) ? atReference(store) : "",
      done: (points) => {
        store.edit((document) => setLimit(document, table, { [key]: shapeOf(shape, points) }));
        store.select({ kind: "limit", index: limitRegions(store.document).findIndex((each) => each.table === table && each.key === key) });
      },
    });
  }

  footprintTool(shape) {
    const { store } = this;
    return new ShapeTool(this.scene, {
      shape, name: `footprint ${shape}`, place: () => GROUND,
      done: (points) => {
        store.edit((document) => setRequirement(document, "footprint", { [shape]: points }));
        store.select({ kind: "footprint", index: 0 });
      },
    });
  }
}

function middle(points) {
  const [x, y, u, v] = bounds(points);
  return [(x + u) / 2, (y + v) / 2];
}

/** The middle of the upper or lower edge of what points span. */
function middleOf(points, upper) {
  const [x, y, u, v] = bounds(points);
  return [(x + u) / 2, upper ? v : y];
}

/** How wide what points span is. */
function widthOf(points) {
  const [x, , u] = bounds(points);
  return Number.isFinite(u - x) ? u - x : 0;
}
