// The linkage in its plane: grid, paths, ground, wanted and achieved poses, and the moving parts.

import { s } from "./dom.mjs";
import { AXIS, axes, foot, polyline, transform } from "./drawing.mjs";
import { boxOf, edgeTowards, farFrom, pivotsAt, viewOf } from "./framing.mjs";
import { act, normalOf } from "./kinematics.mjs";
import { Labels } from "./labels.mjs";
import { mechanism } from "./mechanism.mjs";
import { clamp, fixed, px, radians, ticks } from "./numbers.mjs";
import { ghosts, keepOut, keepOutNames } from "./outlines.mjs";
import { decimalsOf, isNamed, isPoint } from "./tables.mjs";
import { railOf } from "./rail.mjs";
import { placesOf, pointOnLine, travelOf } from "./travel.mjs";

const CLOSER = 0.4; // of the picture: where the linkage takes less, it may be looked at alone
const BESIDE_PIVOT = [16, 28, 40]; // pixels from a pivot, along its crank

/** Magnifications of the error arrows; 0 draws none. */
export const FACTORS = [0, 1, 10, 100, 1000, 10000, 100000];

/** The greatest magnification at which no error arrow is longer than a third of the scene. */
export function factorFor(data, linkage) {
  const worst = Math.max(0, ...linkage.pose_errors.map((row) => row.position ?? 0));
  if (!(worst > 1e-9 * data.scene)) return 0;
  const fits = FACTORS.filter((factor) => factor >= 1 && factor * worst < 0.3 * data.scene);
  return fits.length ? fits[fits.length - 1] : 1;
}

const sizeOf = ([x, y, u, v]) => Math.max(u - x, v - y);

/** Where a dyad stands on the ground: its fixed pivot, or the middle of its rail. */
const standing = (dyad, places) =>
  dyad.fixed_pivot ?? (dyad.kind === "PR" && places.length ? pointOnLine(dyad, travelOf(dyad, places).reduce((a, b) => (a + b) / 2)) : null);

/** Whether a linkage has pivots too far from the poses for the picture to hold them unasked. */
export function hasFarPivots(data, linkage, places) {
  const isFar = farFrom(data);
  return pivotsAt(linkage, places).some(isFar);
}

/** An SVG element in `parent`: `build` draws a linkage on one of its ways, `show` moves it. */
export class Plane {
  /** @type {any} */ view;
  /** @type {any} */ places;
  /** @type {any} */ linkage;
  /** @type {(() => void) | undefined} */ reveal;

  constructor(data, parent) {
    this.data = data;
    this.svg = s("svg", { class: "bm-plane", role: "img", tabindex: "0" });
    this.parent = parent;
    parent.append(this.svg);
  }

  /** Draw what stands still.
   *
   * stretch: the part of the way that is shown; factor: of the error arrows; fill: the height to
   * fill, 0 for the picture's own; far: whether the picture is to hold pivots far from the poses;
   * close: whether it holds poses and linkage alone.
   */
  build(linkage, way, stretch, { factor, fill, far, close = false }) {
    const { data, svg } = this, path = linkage?.ways[way];
    this.linkage = linkage;
    this.way = way;
    this.places = path ? placesOf(data, linkage, path, stretch) : [];
    const width = Math.max(260, this.parent.clientWidth);
    const box = boxOf(data, linkage, this.places, { whole: far, close }), different = (other) => other.some((each, k) => each !== box[k]);
    this.cut = !far && different(boxOf(data, linkage, this.places, { whole: true }));
    this.isLarge = close || (Boolean(linkage) && sizeOf(boxOf(data, linkage, this.places, { close: true })) < CLOSER * sizeOf(box));
    const shape = (box[3] - box[1]) / (box[2] - box[0]);
    const own = clamp(width * clamp(shape, 0.45, 1), 260, clamp(0.62 * window.innerHeight, 340, 680));
    const height = Math.round(fill ? clamp(fill, own, 1.15 * width) : own);
    const view = viewOf(box, width, height, width < 500 ? 34 : 42);
    this.view = view;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("height", height);
    svg.dataset.scale = view.scale;
    svg.dataset.left = view.left;
    svg.dataset.top = view.top;
    svg.replaceChildren();
    svg.append(this.grid(), keepOut(data, view), ghosts(data, linkage, view));
    svg.append(...[this.wantedPath(), linkage ? this.paths() : null].filter(Boolean));
    const labels = new Labels(view);
    this.names = s("g", { class: "bm-names" }, keepOutNames(data, view, labels));
    if (linkage) svg.append(this.ground(labels));
    for (const pose of data.poses) {
      const x = view.X(pose.x), y = view.Y(pose.y), angle = radians(pose.angle_deg);
      const c = AXIS * Math.cos(angle), d = AXIS * Math.sin(angle);
      labels.block(x, y, 12, 12);
      if (isPoint(pose)) continue;
      for (const share of [0.35, 0.65, 1]) {
        labels.block(x + share * c, y - share * d, 6, 6);
        labels.block(x - 0.6 * share * d, y - 0.6 * share * c, 6, 6);
      }
    }
    svg.append(this.poses(linkage, factor, labels));
    this.moving = path ? mechanism(data, linkage, view, this.places) : null;
    if (this.moving) svg.append(this.moving.group);
    if (linkage) this.farPivots(labels);
    svg.append(this.names);
  }

  grid() {
    const { view } = this, group = s("g", { class: "bm-grid", "aria-hidden": "true" });
    const unit = this.data.unit ? ` ${this.data.unit}` : "";
    const across = ticks(-view.left / view.scale, (view.width - view.left) / view.scale, view.width / 110);
    const up = ticks((view.top - view.height) / view.scale, view.top / view.scale, view.height / 80);
    for (const { at, text } of across) {
      const x = px(view.X(at));
      group.append(s("path", { d: `M${x} 0V${view.height}` }));
      if (x > 46 && x < view.width - (unit ? 54 : 30)) {
        group.append(s("text", { x, y: view.height - 6, "text-anchor": "middle" }, text));
      }
    }
    for (const { at, text } of up) {
      const y = px(view.Y(at));
      group.append(s("path", { d: `M0 ${y}H${view.width}` }));
      if (y > 26 && y < view.height - 24) group.append(s("text", { x: 6, y: y - 4 }, text));
    }
    group.append(
      s("text", { x: 6, y: 14 }, `y${unit}`),
      s("text", { x: view.width - 6, y: view.height - 6, "text-anchor": "end" }, `x${unit}`),
    );
    return group;
  }

  /** Paths of the body's origin and of its pivots: full along the stretch that is shown. */
  paths() {
    const { view, linkage, places } = this, group = s("g", { class: "bm-paths" });
    linkage.ways.forEach((way, k) => {
      const same = way.circuit === linkage.ways[this.way]?.circuit;
      const kind = k === this.way ? "bm-beyond" : same ? "bm-same" : "bm-other";
      const whole = placesOf(this.data, linkage, way, { low: 0, high: way.x.length - 1 });
      const d = polyline(whole.map(({ x, y }) => [x, y]), view);
      group.append(s("path", { class: `bm-curve ${kind}`, d }));
    });
    for (const { side, points } of this.pivotPaths()) {
      group.append(s("path", { class: `bm-pivot-path bm-side${side}`, d: polyline(points, view) }));
    }
    const d = polyline(places.map(({ x, y }) => [x, y]), view);
    group.append(s("path", { class: "bm-curve bm-here", d }));
    return group;
  }

  /** The paths of the body's pivots: those on links and in slots. */
  pivotPaths() {
    const { places, linkage } = this;
    if (linkage.traced) return [...linkage.traced].map((joint) => ({ side: "-inner", points: places.map((place) => place.joints[joint]) }));
    const drawn = [...linkage.led.entries()].filter(([, dyad]) => dyad.moving_pivot && dyad.kind !== "PR");
    return drawn.map(([side, dyad]) => ({ side, points: places.map((place) => act(place, dyad.moving_pivot)) }));
  }

  /** Feet of fixed pivots and rails of sliders, with the names of their dyads. */
  ground(labels) {
    const group = s("g", { class: "bm-grounds" });
    this.keepCranksFree(labels);
    this.linkage.led.forEach((dyad, k) => {
      const side = Math.min(k, 1);
      if (dyad.kind === "PR") this.rail(group, labels, dyad, side);
      else if (dyad.fixed_pivot) this.fixedPivot(group, labels, dyad, side);
    });
    return group;
  }

  /** Where cranks between joints are on their way no name is to stand. */
  keepCranksFree(labels) {
    const { view, places, linkage } = this, every = Math.ceil(places.length / 9);
    const arms = (linkage.drawn ?? []).flatMap(({ joints }) => [...joints].filter((joint) => joint in linkage.ground).flatMap((pivot) => [...joints].map((end) => [pivot, end])));
    for (const { joints } of places.filter((_, k) => k % every === 0)) {
      for (const [pivot, end] of arms) {
        const [[x, y], [u, v]] = [joints[pivot], joints[end]].map((at) => [view.X(at[0]), view.Y(at[1])]), size = Math.hypot(u - x, v - y);
        if (size) for (const along of BESIDE_PIVOT) labels.block(x + (along * (u - x)) / size, y + (along * (v - y)) / size, 12, 12);
      }
    }
  }

  /** A rail as long as the travel of its block. */
  rail(group, labels, dyad, side) {
    if (!this.places.length) return;
    const { x, y, drawn, turned, paths } = railOf(dyad, this.places, this.view), [nx, ny] = normalOf(dyad);
    group.append(
      s(
        "g",
        { class: `bm-rail bm-side${side}`, "data-dyad": dyad.id, transform: transform(x, y, turned) },
        s("path", { class: "bm-ground", d: paths[0] }),
        s("path", { class: "bm-ground bm-thin", d: paths[1] }),
      ),
    );
    for (let k = -drawn; k <= drawn; k += 14) labels.block(x - k * ny, y - k * nx, 22, 22);
    this.names.append(labels.put(x, y, dyad.id, 26, { class: `bm-name bm-side${side}` }));
  }

  fixedPivot(group, labels, dyad, side) {
    const x = this.view.X(dyad.fixed_pivot[0]), y = this.view.Y(dyad.fixed_pivot[1]);
    labels.block(x, y + 10, 32, 34);
    if (!side) labels.block(x, y, 40, 40);
    const at = foot();
    at.setAttribute("transform", `translate(${px(x)} ${px(y)})`);
    group.append(at);
    this.names.append(labels.put(x, y + 4, dyad.name ?? dyad.id, 27, { class: `bm-name bm-side${side}` }));
  }

  /** At the edge of the picture, in their direction, the names of what stands outside; a press on one calls `reveal`. */
  farPivots(labels) {
    const { data, view } = this, digits = decimalsOf(data);
    this.linkage.led.forEach((dyad, side) => {
      const at = standing(dyad, this.places);
      const edge = at && edgeTowards(view, at);
      if (!edge) return;
      const text = `${dyad.name ?? dyad.id}: ${dyad.fixed_pivot ? "fixed pivot" : "rail"} at (${at.map((each) => fixed(each, digits)).join(", ")})`;
      labels.block(edge.x, edge.y, 20, 20);
      this.names.append(
        s("g", { class: "bm-to-far", onclick: () => this.reveal?.() },
          s("path", { class: `bm-far-mark bm-side${side}`, d: "M-9 -6L3 0L-9 6", transform: transform(edge.x, edge.y, edge.angle) }),
          labels.put(edge.x, edge.y, text, 14, { class: `bm-name bm-far-name bm-side${side}` })),
      );
    });
  }

  /** The path that is to be traced, straight from point to point. */
  wantedPath() {
    const { data, view } = this;
    if (!data.path) return null;
    const points = data.poses.map(({ x, y }) => [x, y]);
    return s("path", { class: "bm-wanted-path", d: `${polyline(points, view)}${data.path.closed ? "Z" : ""}` });
  }

  /** Wanted poses, the places that the linkage takes instead, and the errors between them, enlarged.
   *
   * At a point there are no axes: how the body turns there is not asked for.
   */
  poses(linkage, factor, labels) {
    const { data, view } = this, group = s("g", { class: "bm-poses" });
    const small = data.poses.length > 24 ? 0.6 : 1;
    const arrows = this.errors(linkage, factor, labels);
    const names = s("g", { class: "bm-pose-names" });
    data.poses.forEach((pose, k) => {
      const x = view.X(pose.x), y = view.Y(pose.y);
      group.append(
        s(
          "g",
          { class: "bm-wanted", transform: transform(x, y, isPoint(pose) ? 0 : radians(pose.angle_deg)), "data-pose": k + 1 },
          isPoint(pose) ? null : s("path", { d: axes(AXIS * small) }),
          s("circle", { r: 4.5 * small }),
        ),
      );
      if (data.poses.length <= 60 && isNamed(data, k)) names.append(labels.put(x, y, pose.label, 13, {}));
      const row = linkage?.pose_errors[k];
      if (!row || row.x === null) return;
      const elsewhere = row.way === this.way ? "" : " bm-elsewhere";
      group.append(
        s(
          "g",
          { class: `bm-achieved${elsewhere}`, transform: transform(view.X(row.x), view.Y(row.y), radians(row.angle_deg)) },
          isPoint(pose) ? null : s("path", { d: axes(0.72 * AXIS * small) }),
          s("circle", { r: 2.2 * small }),
        ),
      );
    });
    group.append(arrows, names);
    return group;
  }

  errors(linkage, factor, labels) {
    const { data, view } = this, arrows = s("g", { class: "bm-errors" });
    if (!linkage || !factor) return arrows;
    linkage.pose_errors.forEach((row, k) => {
      if (row.x === null) return;
      const pose = data.poses[k], x = view.X(pose.x), y = view.Y(pose.y);
      const dx = factor * view.scale * (row.x - pose.x), dy = -factor * view.scale * (row.y - pose.y);
      const size = Math.hypot(dx, dy);
      if (size < 1.5) return;
      const head = Math.min(7, 0.5 * size), ux = dx / size, uy = dy / size;
      const tip = `${px(x + dx)} ${px(y + dy)}`;
      const barb = (sign) =>
        `L${px(x + dx - head * (ux - sign * 0.5 * uy))} ${px(y + dy - head * (uy + sign * 0.5 * ux))}`;
      arrows.append(s("path", { d: `M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(-1)}` }));
      for (let share = 0; share <= 1; share += 0.2) labels.block(x + share * dx, y + share * dy, 8, 8);
    });
    if (arrows.children.length) this.names.append(scaleOfErrors(view, factor));
    return arrows;
  }

  show(place, drive) {
    this.moving?.show(place, drive);
  }
}

/** How much larger than the picture's scale its error arrows are. */
export const scaleOfErrors = ({ width }, factor) =>
  s("text", { class: "bm-error-scale", x: width - 8, y: 16, "text-anchor": "end" }, factor === 1 ? "errors to scale" : `errors × ${factor.toLocaleString("en").replaceAll(",", " ")}`);
