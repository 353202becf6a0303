// The centre-point curve of four poses, in the colours of the best partners, with marks of places along it.

import { s } from "./dom.mjs";
import { OUTSIDE, SHARES } from "./family_pairs.mjs";
import { Labels } from "./labels.mjs";
import { px } from "./numbers.mjs";

export class PartnerCurve {
  /** @type {any} */ pixel;

  constructor(data, pairs) {
    this.data = data;
    this.map = data.family_map;
    this.pairs = pairs;
    this.svg = s("svg", { class: "bm-pairs-scene", role: "img", "aria-label": "The centre-point curve, and the linkage of the pair at pose 1" });
  }

  /** Drawn anew; drawn: the group with the pair, place: of the linkage, colour: of a pair. */
  build(width, height, { drawn, place, colour }) {
    const { map, pairs, svg, data } = this;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    Object.assign(svg.style, { width: `${width}px`, height: `${height}px` });
    const best = map.fixed.map((_, i) => pairs.bestPartner(i));
    const poses = data.poses.map((pose) => [pose.x, pose.y]);
    const middle = [0, 1].map((k) => (Math.min(...poses.map((p) => p[k])) + Math.max(...poses.map((p) => p[k]))) / 2);
    const near = (p) => p.every((v, k) => Math.abs(v - middle[k]) < 3 * data.scene);
    const held = [...poses, ...map.fixed.filter((p, i) => best[i].kind < OUTSIDE && near(p)), ...pairs.pinsOf(place)];
    const low = [0, 1].map((k) => Math.min(...held.map((p) => p[k]))), high = [0, 1].map((k) => Math.max(...held.map((p) => p[k])));
    const scale = Math.min(width / (high[0] - low[0] || data.scene), height / (high[1] - low[1] || data.scene)) * 0.8;
    this.pixel = (p) => [width / 2 + (p[0] - (low[0] + high[0]) / 2) * scale, height / 2 - (p[1] - (low[1] + high[1]) / 2) * scale];
    const curve = s("g", { class: "bm-pairs-curve" }), under = s("g", { class: "bm-pairs-under" }), labels = new Labels({ width, height });
    const marks = s("g", { class: "bm-pairs-axes" });
    const inside = ([x, y]) => x > 0 && y > 0 && x < width && y < height;
    // Two places on opposite sides of the view, neither of them in it: the curve goes through infinity.
    const beyond = (p, q) => !inside(p) && !inside(q) && (p[0] - width / 2) * (q[0] - width / 2) + (p[1] - height / 2) * (q[1] - height / 2) < 0;
    pairs.starts.forEach((start, loop) => {
      const size = map.loops[loop], at = (k) => this.pixel(map.fixed[start + ((k + size) % size)]);
      const between = (p, q) => [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
      for (let k = 0; k < size; k += 1) {
        const piece = [between(at(k - 1), at(k)), at(k), between(at(k), at(k + 1))];
        if (beyond(at(k - 1), at(k)) || beyond(at(k), at(k + 1))) continue;
        const d = `M${piece.map((p) => p.map(px).join(" ")).join("L")}`;
        under.append(s("path", { d }));
        curve.append(s("path", { d, stroke: `rgb(${colour(best[start + k]).join()})` }));
      }
      for (const share of SHARES) {
        const [x, y] = at(Math.min(size - 1, Math.round(share * size)));
        if (!inside([x, y])) continue;
        marks.append(s("circle", { class: "bm-pairs-mark", cx: px(x), cy: px(y), r: 2.2 }));
        marks.append(labels.put(x, y, `${pairs.letter(loop)}${share}`, 12, {}));
      }
    });
    const wanted = s("g", {});
    for (const pose of data.poses) {
      const [x, y] = this.pixel([pose.x, pose.y]).map(px);
      wanted.append(s("path", { class: "bm-cross", d: `M${x - 4} ${y}h8M${x} ${y - 4}v8` }), labels.put(x, y, pose.label, 10, { class: "bm-map-name" }));
    }
    svg.replaceChildren(under, curve, marks, wanted, drawn);
  }
}
