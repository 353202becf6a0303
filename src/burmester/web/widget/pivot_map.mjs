// Where to put a fixed pivot: the least error of a link for every pivot of a grid, in shades.

import { h, rgb, s } from "./dom.mjs";
import { Labels } from "./labels.mjs";
import { clamp, figure, fixed, listed, px } from "./numbers.mjs";

const MAX_BANDS = 12; // shades between the least and the greatest error

/** A canvas in shades under an SVG element with pivots and poses, a legend and a readout. */
export class PivotMap {
  /** @type {any} */ view;

  constructor(data, parent) {
    this.data = data;
    this.parent = parent;
    this.canvas = h("canvas", { "aria-hidden": "true" });
    const name = `bm-map-${Math.random().toString(36).slice(2)}`; // a page may hold several reports
    this.svg = s("svg", {
      class: "bm-map-picture", role: "application", tabindex: "0", "aria-roledescription": "map", "aria-describedby": name,
      "aria-label": "Pivot map: the error of the best link for every fixed pivot. Arrow keys move a cursor, with Shift by ten steps; the error there is told.",
    });
    this.readout = h("output", { class: "bm-readout", id: name });
    this.cursor = null; // column and row of the grid, where the keys have gone
    this.legend = h("p", { class: "bm-legend" });
    parent.append(h("div", { class: "bm-map" }, this.canvas, this.svg), this.legend, this.readout);
    this.svg.addEventListener("pointermove", (event) => this.read(event));
    this.svg.addEventListener("pointerleave", () => this.tell());
    this.svg.addEventListener("keydown", (event) => this.move(event));
    const { log10_rms: levels } = data.pivot_map;
    const known = levels.filter((level) => level !== null).sort((a, b) => a - b);
    // The least errors cover no area that can be seen, the greatest say nothing: neither sets the shades.
    const low = known[Math.floor(0.002 * known.length)], high = known[Math.floor(0.98 * known.length)];
    this.step = [1 / 24, 1 / 12, 1 / 6, 1 / 3, 1 / 2, 1, 2].find((step) => (high - low) / step < MAX_BANDS - 1) ?? 3;
    this.low = Math.floor(low / this.step) * this.step;
    this.high = Math.ceil(high / this.step) * this.step;
    this.count = Math.max(1, Math.round((this.high - this.low) / this.step));
    this.invitation = "Point at the map to read it, or move over it by arrow keys.";
    this.readout.append(this.invitation);
  }

  /** log10 of the error at column u and row v of the grid, bilinear between four of its points. */
  level(u, v) {
    const { columns, rows, log10_rms: levels } = this.data.pivot_map;
    const i = clamp(Math.floor(u), 0, columns - 2), j = clamp(Math.floor(v), 0, rows - 2);
    const a = u - i, b = v - j, at = j * columns + i;
    const [p, q, r, t] = [levels[at], levels[at + 1], levels[at + columns], levels[at + columns + 1]];
    const shares = [(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b];
    if ([p, q, r, t].some((level, k) => level === null && shares[k] > 0)) return null;
    return shares[0] * p + shares[1] * q + shares[2] * r + shares[3] * t;
  }

  build(linkage) {
    const { svg } = this, map = this.data.pivot_map;
    const width = Math.max(240, this.parent.clientWidth);
    const height = Math.round((width * (map.high[1] - map.low[1])) / (map.high[0] - map.low[0]));
    this.paint(width, height);
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.replaceChildren();
    const scale = width / (map.high[0] - map.low[0]);
    const view = { width, height, X: (x) => (x - map.low[0]) * scale, Y: (y) => height - (y - map.low[1]) * scale };
    this.linkage = linkage;
    this.view = view;
    this.explain(this.pivots(linkage, view));
    this.mark = s("path", { class: "bm-map-cursor", d: "M-11 0H-4M4 0H11M0 -11V-4M0 4V11" });
    svg.append(this.mark);
    this.tell();
  }

  /** The shades, painted again only where their size or the colours have changed. */
  paint(width, height) {
    const { canvas } = this, map = this.data.pivot_map;
    const dense = Math.min(2, window.devicePixelRatio || 1);
    const style = getComputedStyle(this.parent);
    const near = rgb(style.getPropertyValue("--bm-map-near"));
    const far = rgb(style.getPropertyValue("--bm-map-far"));
    const w = Math.round(width * dense), t = Math.round(height * dense);
    if (canvas.width === w && this.paintedIn === near.join()) return;
    this.paintedIn = near.join();
    canvas.width = w;
    canvas.height = t;
    const context = canvas.getContext("2d"), image = context.createImageData(w, t);
    const band = new Int16Array(w * t);
    for (let j = 0; j < t; j += 1) {
      for (let i = 0; i < w; i += 1) {
        const level = this.level((i / (w - 1)) * (map.columns - 1), (1 - j / (t - 1)) * (map.rows - 1));
        band[j * w + i] = level === null ? -1 : clamp(Math.floor((level - this.low) / this.step), 0, this.count - 1);
      }
    }
    for (let k = 0; k < w * t; k += 1) {
      const own = band[k];
      const edge = (k % w && band[k - 1] !== own) || (k >= w && band[k - w] !== own);
      const share = own < 0 ? 1 : own / Math.max(1, this.count - 1);
      const shade = edge ? 0.84 : 1;
      for (let c = 0; c < 3; c += 1) image.data[4 * k + c] = shade * (near[c] + share * (far[c] - near[c]));
      image.data[4 * k + 3] = 255;
    }
    context.putImageData(image, 0, 0);
  }

  /** Marks of poses and of all fixed pivots.  Returns sentences on those of the linkage that lie outside. */
  pivots(linkage, view) {
    const { data, svg } = this, map = data.pivot_map;
    const labels = new Labels(view);
    for (const pose of data.poses) {
      const x = px(view.X(pose.x)), y = px(view.Y(pose.y));
      svg.append(s("path", { class: "bm-cross", d: `M${x - 3} ${y}h6M${x} ${y - 3}v6` }));
    }
    const every = new Map();
    for (const each of data.linkages) for (const dyad of each.led) if (dyad.fixed_pivot) every.set(dyad.fixed_pivot.join(), dyad);
    for (const dyad of data.dyads) if (dyad.fixed_pivot) every.set(dyad.fixed_pivot.join(), dyad);
    const inside = ([x, y]) => x >= map.low[0] && x <= map.high[0] && y >= map.low[1] && y <= map.high[1];
    for (const dyad of every.values()) {
      if (!inside(dyad.fixed_pivot)) continue;
      const [x, y] = [view.X(dyad.fixed_pivot[0]), view.Y(dyad.fixed_pivot[1])];
      svg.append(s("circle", { class: "bm-some-pivot", cx: px(x), cy: px(y), r: 2.5 }));
    }
    const outside = [];
    (linkage?.led ?? []).forEach((dyad, side) => {
      if (!dyad.fixed_pivot) return;
      if (!inside(dyad.fixed_pivot)) {
        outside.push(`the fixed pivot of ${dyad.id} lies outside`);
        return;
      }
      const [x, y] = [view.X(dyad.fixed_pivot[0]), view.Y(dyad.fixed_pivot[1])];
      labels.block(x, y, 12, 12);
      svg.append(
        s("circle", { class: `bm-its-pivot bm-side${side}`, cx: px(x), cy: px(y), r: 6 }),
        labels.put(x, y, dyad.id, 16, { class: "bm-map-name" }),
      );
    });
    return outside;
  }

  explain(outside) {
    const unit = this.data.unit ? ` ${this.data.unit}` : "";
    this.legend.replaceChildren(
      h("span", { class: "bm-swatch bm-near" }),
      ` ${figure(10 ** this.low)}${unit} or less`,
      h("span", { class: "bm-swatch bm-far" }),
      ` ${figure(10 ** this.high)}${unit} or more; each line is a factor of ${figure(10 ** this.step)}. `,
      "Small dots: fixed pivots of all dyads; crosses: the poses.",
      outside.length ? ` Of this linkage, ${listed(outside)}.` : "",
    );
  }

  /** A place of the grid, by its column and row, in the plane. */
  placeAt([u, v]) {
    const { low, high, columns, rows } = this.data.pivot_map;
    return [low[0] + (u / (columns - 1)) * (high[0] - low[0]), low[1] + (v / (rows - 1)) * (high[1] - low[1])];
  }

  /** Move the cursor by a key, from one place of the grid to the next; it starts at the driver's pivot. */
  move(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const { low, high, columns, rows } = this.data.pivot_map, many = event.shiftKey ? 10 : 1;
    const pivot = this.linkage?.led.map((dyad) => dyad.fixed_pivot).find(Boolean) ?? this.placeAt([(columns - 1) / 2, (rows - 1) / 2]);
    const [u, v] = this.cursor ?? [
      Math.round(((pivot[0] - low[0]) / (high[0] - low[0])) * (columns - 1)),
      Math.round(((pivot[1] - low[1]) / (high[1] - low[1])) * (rows - 1)),
    ];
    this.cursor = [clamp(u + many * step[0], 0, columns - 1), clamp(v + many * step[1], 0, rows - 1)];
    this.tell();
  }

  /** The cursor, and the error there; without a cursor how to get one. */
  tell() {
    const { cursor, mark, view } = this;
    mark?.setAttribute("visibility", cursor ? "visible" : "hidden");
    if (!cursor) {
      this.readout.textContent = this.invitation;
      return;
    }
    const [x, y] = this.placeAt(cursor);
    mark?.setAttribute("transform", `translate(${px(view.X(x))} ${px(view.Y(y))})`);
    this.say(cursor);
  }

  /** The error at the pointer. */
  read(event) {
    const box = this.svg.getBoundingClientRect(), { columns, rows } = this.data.pivot_map;
    this.say([((event.clientX - box.left) / box.width) * (columns - 1), (1 - (event.clientY - box.top) / box.height) * (rows - 1)]);
  }

  /** The error at a column and a row of the grid, which may be fractions. */
  say(at) {
    const [x, y] = this.placeAt(at), level = this.level(...at);
    const digits = Math.max(0, 2 - Math.floor(Math.log10(this.data.scene)));
    const unit = this.data.unit ? ` ${this.data.unit}` : "";
    this.readout.textContent =
      `Fixed pivot (${fixed(x, digits)}, ${fixed(y, digits)}): the best link misses by ` +
      (level === null ? "an unknown error." : `${figure(10 ** level)}${unit} (rms).`);
  }
}
