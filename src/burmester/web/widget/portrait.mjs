// A linkage as a small picture: at the first pose, faintly at the last one, and the way of its body between.

import { put, s } from "./dom.mjs";
import { foot, polyline, transform } from "./drawing.mjs";
import { boxOf, viewOf } from "./framing.mjs";
import { linear, placeAt } from "./kinematics.mjs";
import { Mechanism } from "./mechanism.mjs";
import { clamp, px } from "./numbers.mjs";
import { railOf } from "./rail.mjs";
import { placesOf, stretchOf, wayOfMost } from "./travel.mjs";

const WIDTH = 300, HEIGHTS = [110, 180], MARGIN = 16; // pixels: drawn somewhat larger than it is seen
const BODY_ROOM = 3; // sizes of the linkage: a larger body is cut at the edge

export class Portrait {
  constructor() {
    this.svg = s("svg", { class: "bm-portrait", viewBox: `0 0 ${WIDTH} ${HEIGHTS[0]}`, "aria-hidden": "true" });
  }

  /** Draw a linkage, if it is another one, or has other ways, than before. */
  draw(data, linkage) {
    if (this.ways === linkage.ways || !linkage.ways.length) return;
    this.ways = linkage.ways;
    this.linkage = linkage;
    const bare = { ...data, ...linkage.picture, loads: null, keep_out: [] }, index = (this.index = wayOfMost(linkage)), way = linkage.ways[index];
    const stretch = stretchOf(linkage, index), places = placesOf(bare, linkage, way, stretch), ends = stretch.sense < 0 ? [stretch.high, stretch.low] : [stretch.low, stretch.high];
    const box = boxOf(bare, linkage, places), close = boxOf(bare, linkage, places, { close: true });
    const held = sizeOf(box) > BODY_ROOM * sizeOf(close) ? close : box, [x, y, u, v] = held, height = Math.round(clamp(((v - y) / (u - x)) * (WIDTH - 2 * MARGIN) + 2 * MARGIN, HEIGHTS[0], HEIGHTS[1]));
    const view = viewOf(held, WIDTH, height, MARGIN);
    put(this.svg, "viewBox", `0 0 ${WIDTH} ${height}`);
    Object.assign(this.svg.dataset, { scale: view.scale, left: view.left, top: view.top });
    this.length = data.chart.length;
    const at = (u) => placeAt(linkage, way, u, data.chart.length);
    const one = (u) => {
      const drawn = new Mechanism(linkage);
      drawn.shape(bare, linkage, view, places);
      drawn.show(at(u), linear(way.drive, u));
      return drawn;
    };
    const last = one(ends[1]);
    last.group.classList.add("bm-portrait-last");
    this.now = one(ends[0]);
    this.now.group.classList.add("bm-portrait-now");
    const path = s("path", { class: "bm-curve bm-here", d: polyline(places.map(({ x, y }) => [x, y]), view) });
    const poses = bare.poses.map(({ x, y }) => s("circle", { class: "bm-portrait-pose", cx: px(view.X(x)), cy: px(view.Y(y)), r: 4 }));
    this.svg.replaceChildren(...linkage.led.map((dyad) => ground(dyad, places, view)).filter(Boolean), path, last.group, ...poses, this.now.group);
  }

  /** Move it to a frame of one of its ways; back to its first pose where there is none. */
  show(at) {
    if (!this.now || !this.linkage) return;
    const index = at?.way ?? this.index, stretch = stretchOf(this.linkage, index), u = at?.u ?? (stretch.sense < 0 ? stretch.high : stretch.low), way = this.linkage.ways[index];
    this.now.show(placeAt(this.linkage, way, u, this.length ?? 1), linear(way.drive, u));
  }
}

const sizeOf = ([x, y, u, v]) => Math.max(u - x, v - y);

/** What a dyad stands on. */
function ground(dyad, places, view) {
  if (dyad.kind === "PR") {
    const { x, y, turned, paths } = railOf(dyad, places, view);
    return s("g", { class: "bm-rail", transform: transform(x, y, turned) }, paths.map((d) => s("path", { class: "bm-ground", d })));
  }
  if (!dyad.fixed_pivot) return null;
  const at = foot();
  put(at, "transform", `translate(${px(view.X(dyad.fixed_pivot[0]))} ${px(view.Y(dyad.fixed_pivot[1]))})`);
  return at;
}
