// What the linkage must be, in fields: limits of dyads, regions, requirements, options.

import { give, h, put, say } from "../widget/dom.mjs";
import { limitsOf, regionsOf, setBody, setLimit, setRegion, setRequirement, setSurrounding, shapeOf, splitLimits, bodyOf, limitRegions, withKeys } from "./document.mjs";
import { NumberField, button, choice, labelled, textField, tick } from "./fields.mjs";
import { PointFields } from "./point_fields.mjs";

const SHAPES = ["point", "line", "segment", "box", "polygon"];
const KINDS = [["RR", "RR: a link"], ["PR", "PR: a slider"], ["RP", "RP: a slot"], ["PP", "PP: a carriage"]];
const TYPES = [
  "grashof", "non-grashof", "crank-rocker", "rocker-crank", "double-crank", "double-rocker", "triple-rocker", "change-point",
  "slider-crank", "inverted slider-crank", "double slider", "Oldham linkage", "Rapson slide",
];
const DRIVERS = [["any", "either dyad"], ["crank", "one that turns fully"], ["first", "the first of two limits"], ["second", "the second of two limits"]];
const METHODS = [["auto", "chosen by the task"], ["complete", "complete: every locally best dyad"], ["pencil", "pencil: the two dyads of the paper"], ["exact", "exact: through five poses"]];
const PREFERENCES = [["transmission", "transmission"], ["size", "size"], ["accuracy", "accuracy"]];
const NORMS = [["rms", "the root mean square"], ["worst", "the worst pose"]];
const UNITS = ["", "mm", "cm", "m", "in", "ft"];

const section = (name, title, open, ...content) => h("details", { class: "bs-section", "data-section": name, open }, h("summary", {}, title), ...content);

export class TaskPanel {
  /** @type {any} */ madeTables;
  /** @type {any} */ regionRows;
  /** @type {any} */ linkWidth;
  /** @type {any} */ margin;
  /** @type {any} */ inPlane;
  /** @type {any} */ bodyNumbers;
  /** @type {any} */ driver;
  /** @type {any} */ anyOrder;
  /** @type {any} */ numbers;
  /** @type {any} */ lengths;
  /** @type {any} */ tables;
  /** @type {any} */ apart;
  /** @type {any} */ regionList;
  /** @type {any} */ bodyState;

  constructor(store, scene, regions, body, files) {
    this.store = store;
    this.scene = scene;
    this.regions = regions;
    this.body = body;
    this.files = files;
    this.element = h("div", { class: "bs-task" });
    this.element.append(this.makeLimits(), this.makeRegions(), this.makeBody(), this.makeRequirements(), this.makeOptions());
    store.on("document selection", () => this.draw());
    regions.onjudged = () => this.drawVerdicts();
    this.draw();
  }

  edit(change) {
    this.store.edit(change);
  }

  length(label, commit, options = {}, attributes = {}) {
    return new NumberField({ label, commit, options: () => ({ kind: "length", unit: this.store.document.length_unit, optional: true, ...options }), step: () => this.scene.step, attributes });
  }

  /** Buttons that draw a shape; the one in use is pressed. */
  tools(label, shapes, toolOf, data) {
    return h("div", { class: "bs-tools", role: "group", "aria-label": label }, shapes.map((shape) => this.toolButton(shape, () => toolOf(shape), { "data-draw": `${data} ${shape}` })));
  }

  toolButton(text, toolOf, attributes) {
    const made = button(text, () => this.scene.use(made.tool && made.tool === this.scene.tool ? null : (made.tool = toolOf())), { "aria-pressed": "false", ...attributes });
    this.scene.on("tool", (tool) => put(made, "aria-pressed", Boolean(tool) && tool === made.tool));
    return made;
  }

  /** Fields for the points of a shape; set(change) changes them. */
  points(name, set) {
    return new PointFields({ name, set, options: () => ({ kind: "length", unit: this.store.document.length_unit }), step: () => this.scene.step });
  }

  // Limits

  makeLimits() {
    this.apart = tick("another limit for each of the two dyads", (on) => this.edit((document) => splitLimits(document, on)), { "data-key": "limits-apart" });
    this.tables = h("div", {});
    this.madeTables = [];
    return section("limits", "Limits of pivots and links", false, this.apart.element, this.tables);
  }

  makeTable(k) {
    const { store, regions } = this, edit = (changes) => this.edit((document) => setLimit(document, k, changes));
    const title = h("h3", {}), parts = {};
    for (const [key, name] of [["fixed_pivot", "Fixed pivot, in the ground"], ["moving_pivot", "Moving pivot, in the body"]]) {
      const state = h("p", { class: "bs-state" });
      const numbers = this.points(`the limit of the ${key.replace("_", " ")}`, (change) => this.edit((document) => withPoints(document, k, key, change)));
      const remove = button("Delete", () => regions.removeLimit(k, key), { "data-do": `delete-limit-${k}-${key}`, "aria-label": `Delete the limit: ${name}` });
      parts[key] = { state, numbers, remove };
      parts[key].element = h("div", { class: "bs-limit-box" }, h("h4", {}, name), this.tools(`Draw a limit: ${name}`, SHAPES, (shape) => regions.limitTool(k, key, shape), `limit ${k} ${key}`), numbers.element, state, remove);
    }
    const least = this.length("least length", (value) => edit({ length: range(value, limitsOf(store.document)[k]?.length?.most) }), { least: 0 }, { "data-key": `least-${k}`, placeholder: "any" });
    const most = this.length("greatest length", (value) => edit({ length: range(limitsOf(store.document)[k]?.length?.least, value) }), { least: 0 }, { "data-key": `most-${k}`, placeholder: "any" });
    const kinds = KINDS.map(([kind, text]) => ({ kind, ...tick(text, () => edit({ kinds: kindsOf(kinds) }), { "data-key": `kind-${k}-${kind}` }) }));
    const lengthState = h("p", { class: "bs-state" }), kindsState = h("p", { class: "bs-state" });
    const element = h("div", { class: "bs-limit-table" }, title, parts.fixed_pivot.element, parts.moving_pivot.element,
      h("div", { class: "bs-row" }, labelled("length from", least.element), labelled("to", most.element)), lengthState,
      h("div", { class: "bs-row", role: "group", "aria-label": "kinds of dyads" }, kinds.map((each) => each.element)), kindsState);
    return { element, title, parts, least, most, kinds, lengthState, kindsState };
  }

  drawLimits() {
    const { document } = this.store, tables = limitsOf(document), count = Math.max(1, tables.length);
    give(this.apart.box, "checked", tables.length > 1);
    while (this.madeTables.length < count) this.madeTables.push(this.makeTable(this.madeTables.length));
    while (this.tables.children.length > count) this.tables.lastChild.remove();
    while (this.tables.children.length < count) this.tables.append(this.madeTables[this.tables.children.length].element);
    for (let k = 0; k < count; k += 1) {
      const table = tables[k] ?? {}, made = this.madeTables[k];
      say(made.title, count > 1 ? `Dyad ${k + 1}` : "Both dyads");
      for (const key of ["fixed_pivot", "moving_pivot"]) this.drawLimit(made.parts[key], table[key]);
      made.least.show(table.length?.least);
      made.most.show(table.length?.most);
      for (const { kind, box } of made.kinds) box.checked = !table.kinds || table.kinds.includes(kind);
    }
  }

  drawLimit({ numbers, remove }, region) {
    for (const each of [remove, numbers.element]) give(each, "hidden", !region);
    if (!region) return;
    const [[shape, stated]] = Object.entries(region);
    numbers.show(shape, shape === "point" ? [stated] : stated);
  }

  drawVerdicts() {
    const { regions } = this, tables = limitsOf(this.store.document);
    this.madeTables.forEach((made, k) => {
      for (const key of ["fixed_pivot", "moving_pivot"]) tell(made.parts[key].state, tables[k]?.[key] ? regions.said(k, key) : null);
      tell(made.lengthState, tables[k]?.length ? regions.said(k, "length") : null);
      tell(made.kindsState, tables[k]?.kinds ? regions.said(k, "kinds") : null);
    });
    this.regionRows.forEach((row, k) => tell(row.state, regions.touched ? [regions.touched[k]].filter(Boolean) : null));
  }

  // Regions to keep out of

  makeRegions() {
    this.regionList = h("div", {});
    this.regionRows = [];
    this.linkWidth = this.length("width of the links", (value) => this.edit((document) => setSurrounding(document, "link_width", value)), { least: 0 }, { "data-key": "link_width", placeholder: "0" });
    this.margin = this.length("least clearance", (value) => this.edit((document) => setSurrounding(document, "margin", value)), { least: 0 }, { "data-key": "margin", placeholder: "0" });
    this.inPlane = tick("links that stand on the ground must not touch the body either", (on) => this.edit((document) => setSurrounding(document, "body_in_plane", on || undefined)), { "data-key": "body_in_plane" });
    return section("keep-out", "Regions to keep out of", false,
      h("p", { class: "bs-hint" }, "The body and the links must not touch them between the poses."),
      this.tools("Draw a region to keep out of", ["box", "polygon"], (shape) => this.regions.regionTool(shape), "region"), this.regionList,
      h("div", { class: "bs-row" }, labelled("links are wide", this.linkWidth.element), labelled("least clearance", this.margin.element)), this.inPlane.element);
  }

  drawRegions() {
    const { store } = this, regions = regionsOf(store.document);
    while (this.regionRows.length < regions.length) {
      this.regionRows.push(this.regionRow(this.regionRows.length));
      this.regionList.append(this.regionRows.at(-1).element);
    }
    for (const row of this.regionRows.splice(regions.length)) row.element.remove();
    this.regionRows.forEach((row, k) => row.show(regions[k], store.selection?.kind === "region" && store.selection.index === k));
    const { link_width, margin, body_in_plane } = store.document.surroundings ?? {};
    this.linkWidth.show(link_width);
    this.margin.show(margin);
    give(this.inPlane.box, "checked", Boolean(body_in_plane));
  }

  regionRow(k) {
    const { store } = this, shapeKey = (region) => (region.box ? "box" : "polygon");
    const name = textField(`Name of region ${k + 1}`, (text) => this.edit((document) => setRegion(document, k, { name: text.trim() || undefined })), { "data-key": `region-name-${k}`, placeholder: `region ${k + 1}` });
    const numbers = this.points(`region ${k + 1}`, (change) =>
      this.edit((document) => {
        const region = regionsOf(document)[k], key = shapeKey(region);
        return setRegion(document, k, { [key]: change(region[key]) });
      }));
    const state = h("p", { class: "bs-state" }), inNumbers = h("details", {}, h("summary", {}, "in numbers"), numbers.element), file = h("p", { class: "bs-hint" });
    const element = h("div", { class: "bs-limit-box", "data-region-row": k, onfocusin: () => store.select({ kind: "region", index: k }) },
      h("div", { class: "bs-row" }, name, button("Delete", () => this.regions.removeRegion(k), { "data-do": `delete-region-${k}`, "aria-label": `Delete region ${k + 1}` })), state, inNumbers, file);
    const show = (region, selected) => {
      const text = (region.name ?? "").replace(/[\r\n]+/g, " ");
      if (document.activeElement !== name && name.value !== text) name.value = text;
      element.classList.toggle("bs-selected", selected);
      give(inNumbers, "hidden", region.file !== undefined);
      give(file, "hidden", !inNumbers.hidden);
      if (inNumbers.hidden) file.textContent = `from the drawing ${region.file}`;
      else numbers.show(shapeKey(region), region[shapeKey(region)]);
    };
    return { element, state, show };
  }

  // The body

  makeBody() {
    this.bodyNumbers = this.points("the outline", (change) => this.edit((document) => setBody(document, change(bodyOf(document)))));
    this.bodyCount = h("summary", {});
    this.bodyBox = h("details", {}, this.bodyCount, this.bodyNumbers.element);
    this.noBody = button("Delete the outline", () => this.edit((document) => setBody(document, [])), { "data-do": "delete-body" });
    return section("body", "Outline of the body", false,
      h("p", { class: "bs-hint" }, "It is seen at every pose, moves with the linkage, and says what an angle error counts as."),
      h("div", { class: "bs-tools" }, this.toolButton("Draw it", () => this.body.tool(), { "data-draw": "body" }), button("From a drawing (SVG, DXF)…", () => this.files.chooseOutline(), { "data-do": "outline-file" }), this.noBody),
      this.bodyBox);
  }

  drawBody() {
    const { document: task } = this.store, corners = bodyOf(task);
    give(this.noBody, "hidden", !task.body);
    give(this.bodyBox, "hidden", !corners.length);
    if (!corners.length) return;
    say(this.bodyCount, `${corners.length} corners, in numbers`);
    this.bodyNumbers.show("polygon", corners);
  }

  // Requirements and options

  makeRequirements() {
    const set = (key) => (value) => this.edit((document) => setRequirement(document, key, value));
    const number = (label, key, options) => new NumberField({ label, commit: set(key), options: () => ({ optional: true, unit: this.store.document.length_unit, ...options }), attributes: { "data-key": key, placeholder: "–" } });
    this.numbers = {
      transmission_deg: number("least transmission angle", "transmission_deg", { kind: "angle", least: 0, most: 90 }),
      link_ratio: number("longest link to the shortest, at most", "link_ratio", { least: 1 }),
      within: number("greatest position error", "within", { kind: "length", above: 0 }),
      within_deg: number("greatest angle error", "within_deg", { kind: "angle", above: 0 }),
    };
    this.driver = choice("driver", DRIVERS, (value) => set("driver")(value === "any" ? undefined : value), { "data-key": "driver" });
    this.anyOrder = tick("the poses may be met in any order", (on) => set("any_order")(on || undefined), { "data-key": "any_order" });
    this.types = TYPES.map((type) => ({ type, ...tick(type, () => set("types")(typesOf(this.types)), { "data-key": `type-${type}` }) }));
    this.noFootprint = button("Delete", () => set("footprint")(undefined), { "data-do": "delete-footprint", "aria-label": "Delete the footprint" });
    return section("requirements", "What the linkage must be", true,
      h("div", { class: "bs-grid" },
        labelled("transmission angle at least", this.numbers.transmission_deg.element, "°"),
        labelled("position error at most", this.numbers.within.element, " "),
        labelled("angle error at most", this.numbers.within_deg.element, "°"),
        labelled("link ratio at most", this.numbers.link_ratio.element, " "),
        labelled("driver", this.driver)),
      this.anyOrder.element,
      h("div", { class: "bs-limit-box" }, h("h4", {}, "Footprint: holds all pivots, wherever the poses take them"), this.tools("Draw the footprint", ["box", "polygon"], (shape) => this.regions.footprintTool(shape), "footprint"), this.noFootprint),
      h("details", {}, h("summary", {}, "Types"), h("div", { class: "bs-ticks" }, this.types.map((each) => each.element)), h("p", { class: "bs-hint" }, "None: any type.")));
  }

  drawRequirements() {
    const asked = this.store.document.requirements ?? {};
    for (const [key, field] of Object.entries(this.numbers)) field.show(asked[key]);
    this.driver.value = asked.driver ?? "any";
    give(this.anyOrder.box, "checked", Boolean(asked.any_order));
    give(this.noFootprint, "hidden", !asked.footprint);
    for (const { type, box } of this.types) box.checked = Boolean(asked.types?.includes(type));
  }

  makeOptions() {
    const { store } = this;
    this.unit = choice("unit of length", UNITS.map((unit) => [unit, unit || "not stated"]), (value) => this.edit((document) => withKeys(document, { length_unit: value || undefined })), { "data-key": "length_unit" });
    this.method = choice("method", METHODS, (value) => store.option("method", value === "auto" ? undefined : value), { "data-key": "method" });
    this.norm = choice("norm", NORMS, (value) => store.option("norm", value === "rms" ? undefined : value), { "data-key": "norm" });
    this.prefer = choice("best at", PREFERENCES, (value) => store.option("prefer", value === "transmission" ? undefined : value), { "data-key": "prefer" });
    this.lengths = ["angle-weight", "tolerance"].map((name) => ({ name, field: this.length(name, (value) => store.option(name, value), { above: 0 }, { "data-key": name, placeholder: "–" }) }));
    const [weight, made] = this.lengths.map(({ field }) => field.element);
    return section("options", "Unit and method", false, h("div", { class: "bs-grid" },
      labelled("unit of length", this.unit), labelled("method", this.method), labelled("what is made least", this.norm), labelled("two to four poses: best at", this.prefer),
      labelled("one radian counts as", weight, " "), labelled("pivots and lengths are made to ±", made, " ")),
      h("p", { class: "bs-hint" }, "Another unit leaves the numbers as they are."));
  }

  drawOptions() {
    const { document, options } = this.store, unit = document.length_unit ?? "";
    if (![...this.unit.options].some((each) => each.value === unit)) this.unit.append(h("option", { value: unit }, unit));
    this.unit.value = unit;
    this.method.value = options.method ?? "auto";
    this.norm.value = options.norm ?? "rms";
    this.prefer.value = options.prefer ?? "transmission";
    for (const { name, field } of this.lengths) field.show(options[name]);
  }

  /** While poses are dragged nothing here is another. */
  draw() {
    const { document: { limits, keep_out, surroundings, body, requirements, length_unit }, options, selection } = this.store;
    const now = [limits, keep_out, surroundings, body, requirements, length_unit, options, selection];
    if (now.every((each, k) => each === this.drawn?.[k]) && this.drawn) return;
    this.drawn = now;
    this.drawLimits();
    this.drawRegions();
    this.drawBody();
    this.drawRequirements();
    this.drawOptions();
    this.drawVerdicts();
  }
}

/** Whether a condition is met: a sign, and sentences where it is not. */
function tell(element, sentences) {
  give(element, "hidden", sentences === null);
  if (sentences === null) return;
  put(element, "class", `bs-state ${sentences.length ? "bs-broken" : "bs-met"}`);
  say(element, sentences.length ? `✕ ${sentences.join(" ")}` : "✓ met by the chosen linkage");
}

/** A document with other points in a limit. */
function withPoints(document, k, key, change) {
  const [[shape, stated]] = Object.entries(limitsOf(document)[k][key]);
  return setLimit(document, k, { [key]: shapeOf(shape, change(shape === "point" ? [stated] : stated)) });
}

const range = (least, most) => (least === undefined && most === undefined ? undefined : { ...(least === undefined ? {} : { least }), ...(most === undefined ? {} : { most }) });

/** The kinds that are ticked, or undefined for all of them. */
function kindsOf(kinds) {
  const list = kinds.filter(({ box }) => box.checked).map(({ kind }) => kind);
  return list.length === kinds.length || !list.length ? undefined : list;
}

function typesOf(types) {
  const list = types.filter(({ box }) => box.checked).map(({ type }) => type);
  return list.length ? list : undefined;
}
