// Labels where they cover the least.

import { s } from "./dom.mjs";
import { px } from "./numbers.mjs";

/** Each label goes to the one of 48 places around its point where it overlaps least with the rest. */
export class Labels {
  /** @param {{ width: number, height: number }} view */
  constructor(view) {
    this.view = view;
    /** @type {number[][]} */ this.taken = [];
  }

  /** @param {number} x @param {number} y @param {number} width @param {number} height */
  block(x, y, width, height) {
    this.taken.push([x - width / 2, y - height / 2, x + width / 2, y + height / 2]);
  }

  /** @param {number} x @param {number} y @param {string} text @param {number} distance @param {Record<string, any>} [attributes] */
  put(x, y, text, distance, attributes) {
    const width = 7.2 * text.length + 4, height = 14;
    let best = { cost: Infinity, cx: 0, cy: 0, box: [0, 0, 0, 0] };
    for (let ring = 0; ring < 3; ring += 1) {
      for (let k = 0; k < 16; k += 1) {
        const angle = (Math.PI / 8) * k + Math.PI / 4;
        const away = distance + 9 * ring;
        const cx = x + (away + width / 2 - 6) * Math.cos(angle);
        const cy = y - away * Math.sin(angle);
        const box = [cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2];
        let cost = 0.02 * k + 6 * ring;
        for (const other of this.taken) {
          const across = Math.min(box[2], other[2]) - Math.max(box[0], other[0]);
          const down = Math.min(box[3], other[3]) - Math.max(box[1], other[1]);
          if (across > 0 && down > 0) cost += across * down;
        }
        if (box[0] < 2 || box[2] > this.view.width - 2) cost += 500;
        if (box[1] < 2 || box[3] > this.view.height - 2) cost += 500;
        if (cost < best.cost) best = { cost, cx, cy, box };
      }
    }
    this.taken.push(best.box);
    return s(
      "text",
      { x: px(best.cx), y: px(best.cy + 4), "text-anchor": "middle", ...attributes },
      text,
    );
  }
}
