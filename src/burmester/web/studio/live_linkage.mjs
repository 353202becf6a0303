// The chosen linkage in the scene: what it passes through, its ground, and the linkage itself, moved by
// attributes while it is followed or played.

import { put, s, say } from "../widget/dom.mjs";
import { AXIS, axes, foot, transform } from "../widget/drawing.mjs";
import { edgeTowards, nearPoints, placesAtPoses } from "../widget/framing.mjs";
import { act, placeAt } from "../widget/kinematics.mjs";
import { Mechanism } from "../widget/mechanism.mjs";
import { clamp, px, radians } from "../widget/numbers.mjs";
import { factorFor, scaleOfErrors } from "../widget/plane.mjs";
import { railOf } from "../widget/rail.mjs";
import { smoothPath } from "../widget/smooth_path.mjs";
import { UNSEEN } from "./answers.mjs";
import { around } from "./name_places.mjs";

const NARROW = 480; // pixels: in a narrower plane poses come before the body, of which they would be a small part
const MOST_ACHIEVED = 240; // places at poses that are drawn
const OFF = 27; // pixels from the middle of a foot to the name of its dyad
const FOOT = 11; // pixels from a fixed pivot down to that middle
const LEAST_ARROW = 1.5; // pixels

export class LiveLinkage {
  constructor(answers, playing, scene) {
    this.answers = answers;
    this.playing = playing;
    this.scene = scene;
    this.factor = 0;
    this.beyond = s("path", { class: "bm-curve bm-beyond" });
    this.others = s("path", { class: "bm-curve bm-other" });
    this.here = s("path", { class: "bm-curve bm-here" });
    this.pivotPaths = [0, 1].map((side) => s("path", { class: `bm-pivot-path bm-side${side}` }));
    this.paths = s("g", { class: "bs-paths", "aria-hidden": "true" }, this.others, this.beyond, ...this.pivotPaths, this.here);
    this.feet = [0, 1].map((side) => {
      const at = foot();
      at.classList.add(`bm-side${side}`);
      return at;
    });
    this.rails = [0, 1].map((side) => s("g", { class: `bm-rail bm-side${side}` }, s("path", { class: "bm-ground" }), s("path", { class: "bm-ground bm-thin" })));
    this.achieved = s("g", { class: "bs-achieved" });
    this.arrows = s("path", {});
    this.names = [0, 1].map((side) => s("text", { class: `bm-name bm-side${side}`, "text-anchor": "middle" }));
    this.mechanism = null;
    this.holder = s("g", { class: "bs-mechanism" }, ...this.rails, ...this.feet, this.achieved, s("g", { class: "bm-errors" }, this.arrows));
    this.labels = s("g", { class: "bs-dyad-names" }, this.names);
    this.edges = s("g", { class: "bs-edges" });
    scene.layer("paths").append(this.paths);
    scene.layer("mechanism").append(this.holder);
    scene.layer("labels").append(this.labels, this.edges);
    scene.hold?.(() => this.points(scene.size.width < NARROW && !scene.isWhole));
    scene.on("closer", () => this.closer());
    answers.on("shown", () => scene.refit());
    playing.on("shape", () => this.shape());
    playing.on("place", ({ place, drive }) => this.mechanism?.show(place, drive));
    scene.on("view", () => this.redraw());
    scene.names?.avoid(() => this.obstacles());
    this.redraw();
  }

  /** Points that a fit has to hold: poses, body and linkage at the poses; close: without the body. */
  points(close = false) {
    const { linkage } = this.playing, { data } = this.answers;
    return nearPoints(data, linkage, linkage ? placesAtPoses(data, linkage) : [], { close });
  }

  /** The selected pose with its neighbours, or else the linkage without its body, as large as they fit. */
  closer() {
    const { selection, document: { poses } } = this.answers.store, k = selection?.kind === "pose" ? selection.index : null;
    const near = k === null ? [] : poses.slice(Math.max(0, k - 1), k + 2).map((pose) => [pose.x ?? 0, pose.y ?? 0]);
    this.scene.closeUp(near.length > 1 ? near : this.points(true));
  }

  /** What names keep off: the feet of fixed pivots. */
  obstacles() {
    const { playing: { linkage }, scene: { view } } = this, pins = linkage && !linkage.gone ? linkage.led.filter((dyad) => dyad.fixed_pivot) : [];
    return pins.map(({ fixed_pivot: [x, y] }) => [view.X(x), view.Y(y) + FOOT, 34, 36]);
  }

  /** How errors are enlarged: while a hand drags never more than before, so that arrows do not flicker. */
  enlarge() {
    const { linkage } = this.playing, { data } = this.answers;
    const seen = linkage?.pose_errors.length && !(linkage.followed && linkage.worst < UNSEEN * data.scene);
    const fits = seen ? factorFor(data, linkage) : 0;
    this.factor = this.answers.isOld && this.factor && fits ? Math.min(this.factor, fits) : fits;
  }

  redraw() {
    this.shape();
    if (this.playing.here && this.playing.path) this.mechanism?.show(this.playing.here.place, this.playing.here.drive);
  }

  /** Everything but the place along the way. */
  shape() {
    const { playing, answers, scene } = this, { linkage, path } = playing, { view } = scene;
    const there = Boolean(linkage) && !linkage.gone;
    for (const part of [this.paths, this.holder, this.labels, this.edges]) put(part, "visibility", there ? "visible" : "hidden");
    if (!there) return;
    const places = path ? framesOf(path) : [];
    this.enlarge();
    this.curves(linkage, path, places, view);
    this.ground(linkage, places, view);
    this.outside(linkage, view);
    this.atPoses(linkage, view);
    if (!path) {
      this.mechanism?.group.remove();
      this.mechanism = null;
      return;
    }
    if (!this.mechanism?.fits(linkage)) {
      this.mechanism?.group.remove();
      this.mechanism = new Mechanism(linkage);
      this.holder.append(this.mechanism.group);
    }
    this.mechanism.shape(answers.data, linkage, view, places);
  }

  curves(linkage, path, places, view) {
    const set = (element, list, closed) =>
      put(element, "d", smoothPath(list.map(([x]) => view.X(x)), list.map(([, y]) => view.Y(y)), closed));
    const others = linkage.ways.filter((way) => way !== path);
    put(this.others, "d", others.map((way) => pathOf(way, view)).join(""));
    put(this.beyond, "d", path ? pathOf(path, view) : "");
    this.pivotPaths.forEach((element, side) => {
      const dyad = linkage.led[side];
      if (!path || !dyad.moving_pivot || dyad.kind === "PR") put(element, "d", "");
      else set(element, places.map((place) => act(place, dyad.moving_pivot)), path.round);
    });
    if (!path) {
      put(this.here, "d", "");
      return;
    }
    const { low, high } = this.playing.player.stretch, { length } = this.answers.data.chart, list = [];
    const end = (u) => ((place) => [place.x, place.y])(placeAt(linkage, path, u, length));
    list.push(end(low));
    for (let k = Math.floor(low) + 1; k < high; k += 1) list.push([path.x[k], path.y[k]]);
    list.push(end(high));
    set(this.here, list, path.round && high - low > path.x.length - 1 - 1e-6);
  }

  ground(linkage, places, view) {
    const { scene } = this;
    linkage.led.forEach((dyad, side) => {
      const [rail, at, name] = [this.rails[side], this.feet[side], this.names[side]];
      const slides = dyad.kind === "PR" && places.length > 0;
      put(rail, "display", slides ? "inline" : "none");
      put(at, "display", dyad.fixed_pivot ? "inline" : "none");
      put(name, "display", slides || dyad.fixed_pivot ? "inline" : "none");
      say(name, dyad.id);
      let x, y;
      if (slides) {
        const drawn = railOf(dyad, places, view);
        ({ x, y } = drawn);
        put(rail, "transform", transform(x, y, drawn.turned));
        drawn.paths.forEach((d, k) => put(rail.children[k], "d", d));
        put(rail, "data-dyad", dyad.id);
      } else if (dyad.fixed_pivot) {
        [x, y] = [view.X(dyad.fixed_pivot[0]), view.Y(dyad.fixed_pivot[1])];
        put(at, "transform", `translate(${px(x)} ${px(y)})`);
      } else {
        return;
      }
      scene.names.put(name, x, y + FOOT, dyad.id, around(dyad.id, -Math.PI / 2, OFF));
    });
  }

  /** At the edge, arrows that lead to pivots outside the picture; and how much larger error arrows are. */
  outside(linkage, view) {
    const marks = linkage.led.flatMap((dyad, side) => {
      const edge = dyad.fixed_pivot && edgeTowards(view, dyad.fixed_pivot), end = edge && edge.x > view.width / 2;
      return edge ? [s("g", { class: `bm-to-far bm-side${side}`, "data-dyad": dyad.id, onclick: () => this.scene.reveal(dyad.fixed_pivot) },
        s("path", { class: `bm-far-mark bm-side${side}`, d: "M-9 -6L3 0L-9 6", transform: transform(edge.x, edge.y, edge.angle) }),
        s("text", { class: `bm-name bm-side${side}`, x: px(edge.x + (end ? -12 : 12)), y: px(clamp(edge.y + 4, 14, view.height - 24)), "text-anchor": end ? "end" : "start" }, `${dyad.id} is outside`))] : [];
    });
    this.edges.replaceChildren(...marks, ...(this.factor ? [scaleOfErrors(view, this.factor)] : []));
  }

  /** Where the linkage takes the body instead of the poses, and the errors between them, enlarged. */
  atPoses(linkage, view) {
    const { achieved, answers: { data } } = this, rows = linkage.pose_errors;
    const count = Math.min(rows.length, MOST_ACHIEVED), small = count > 24 ? 0.6 : 1;
    while (achieved.children.length > count) achieved.lastChild.remove();
    while (achieved.children.length < count) achieved.append(s("g", { class: "bm-achieved" }, s("path", {}), s("circle", {})));
    let arrows = "";
    for (let k = 0; k < count; k += 1) {
      const row = rows[k], group = achieved.children[k];
      if (group.dataset.size !== String(small)) {
        group.dataset.size = small;
        put(group.children[0], "d", axes(0.72 * AXIS * small));
        put(group.children[1], "r", 2.2 * small);
      }
      if (row.x === null) {
        put(group, "display", "none");
        continue;
      }
      put(group, "display", "inline");
      put(group.children[0], "display", data.poses[k]?.angle_deg === null ? "none" : "inline"); // how the body turns at a point is not asked for
      put(group, "transform", transform(view.X(row.x), view.Y(row.y), radians(row.angle_deg)));
      group.classList.toggle("bm-elsewhere", row.at !== this.playing.path);
      if (this.factor && data.poses[k]) arrows += arrow(view, data.poses[k], row, this.factor);
    }
    put(this.arrows, "d", arrows);
  }
}

/** The frames of a way as places. */
export const framesOf = (way) => Array.from(way.x, (x, k) => ({ x, y: way.y[k], a: way.angle[k] }));

const pathOf = (way, view) => smoothPath(Array.from(way.x, view.X), Array.from(way.y, view.Y), way.round);

/** An error as an arrow from the pose, enlarged. */
function arrow(view, pose, row, factor) {
  const x = view.X(pose.x), y = view.Y(pose.y), by = factor * view.scale;
  const dx = by * (row.x - pose.x), dy = -by * (row.y - pose.y), size = Math.hypot(dx, dy);
  if (!(size >= LEAST_ARROW)) return "";
  const head = Math.min(7, 0.5 * size), ux = dx / size, uy = dy / size, tip = `${px(x + dx)} ${px(y + dy)}`;
  const barb = (sign) => `L${px(x + dx - head * (ux - sign * 0.5 * uy))} ${px(y + dy - head * (uy + sign * 0.5 * ux))}`;
  return `M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(-1)}`;
}
