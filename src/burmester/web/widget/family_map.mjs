// The map of a family: all pairs of the dyads that few poses leave, coloured by what becomes of them.
// Four poses: a square over the curve of dyads, beside the curve itself.  Three poses: the plane of
// the second fixed pivot, beside one dyad that is chosen.

import { h, rgb, s } from "./dom.mjs";
import { CLASSES, FamilyPairs, OUTSIDE, SHARES } from "./family_pairs.mjs";
import { Labels } from "./labels.mjs";
import { clamp, figure, fixed, px } from "./numbers.mjs";
import { PartnerCurve } from "./partner_curve.mjs";

const TINTS = ["", "", "outside", "order", "branch", "circuit", "none"]; // of classes, in the style sheet
const SHORT = ["works", "works", "outside limits or standard", "order defect", "branch defect", "circuit defect", ""];
const SPECK = 6; // of nine pairs around one that does not work; no outline goes around that one
const MARGIN = { left: 50, right: 8, top: 8, bottom: 26 }; // pixels around the square
const LARGEST = 520; // pixels: the side of the square
const BESIDE = 620; // pixels; a narrower panel has the two pictures under each other

export class FamilyMap {
  /** @type {any} */ tints;
  /** @type {any} */ scale;
  /** @type {any} */ curve;
  /** @type {any} */ view;
  /** @type {any} */ place;
  /** @type {any} */ drawn;

  constructor(data, parent) {
    this.data = data;
    this.map = data.family_map;
    this.parent = parent;
    this.pairs = new FamilyPairs(data);
    const { isCurve, columns, rows } = this.pairs;
    this.isCurve = isCurve;
    this.columns = columns;
    this.rows = rows;
    this.canvas = h("canvas", { "aria-hidden": "true", width: this.columns, height: this.rows });
    const name = `bm-pairs-${Math.random().toString(36).slice(2)}`; // a page may hold several reports
    const what = this.isCurve ? "pairs of dyads on the curve of four poses" : "the second fixed pivot of three poses";
    this.svg = s("svg", {
      class: "bm-pairs-picture", role: "application", tabindex: "0", "aria-roledescription": "map", "aria-describedby": name,
      "aria-label": `Family map: ${what}. Arrow keys move a cursor, with Shift by ten steps; what the pair does is told and drawn.`,
    });
    this.curve = isCurve ? new PartnerCurve(data, this.pairs) : null;
    this.readout = h("output", { class: "bm-readout", id: name });
    this.legend = h("p", { class: "bm-legend" });
    this.box = h("div", { class: "bm-pairs" }, h("div", { class: "bm-pairs-map" }, this.canvas, this.svg), this.curve?.svg);
    parent.append(this.box, this.legend, this.readout);
    this.cursor = null;
    this.svg.addEventListener("pointermove", (event) => this.tell(this.cellAt(event)));
    this.svg.addEventListener("pointerdown", (event) => this.pin(this.cellAt(event)));
    this.svg.addEventListener("pointerleave", () => this.tell(this.cursor));
    this.svg.addEventListener("keydown", (event) => this.move(event));
  }

  build(linkage, index) {
    const { parent, svg, isCurve } = this, wide = Math.max(240, parent.clientWidth);
    const beside = isCurve && wide >= BESIDE, width = !isCurve ? wide : Math.min(LARGEST, beside ? Math.floor((wide - 16) / 2) : wide);
    const margin = isCurve ? MARGIN : { left: 0, right: 0, top: 0, bottom: 0 };
    const across = width - margin.left - margin.right;
    const down = isCurve ? across : Math.round((across * this.rows) / this.columns);
    const height = down + margin.top + margin.bottom;
    this.box.classList.toggle("bm-beside", beside);
    Object.assign(this.canvas.style, { left: `${margin.left}px`, top: `${margin.top}px`, width: `${across}px`, height: `${down}px` });
    Object.assign(svg.parentElement.style, { width: `${width}px`, height: `${height}px` });
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.view = { width, height, margin, across, down };
    this.place = isCurve ? (this.map.places[index ?? 0] ?? null) : this.pairs.cellOf(this.map.other.fixed);
    this.paint();
    svg.replaceChildren(...this.outline(), isCurve ? this.axes() : this.ground());
    this.drawn = s("g", { class: "bm-pair-drawn" });
    this.mark = s("path", { class: "bm-map-cursor", d: "M-11 0H-4M4 0H11M0 -11V-4M0 4V11" });
    if (!isCurve) svg.append(this.drawn);
    svg.append(this.rings(), this.mark);
    this.curve?.build(beside ? wide - width - 16 : wide, height, { drawn: this.drawn, place: this.place, colour: (pair) => this.colour(pair) });
    this.explain();
    this.tell(this.cursor);
  }

  /** The colours of the style sheet, by name. */
  colours() {
    const style = getComputedStyle(this.parent);
    return (name) => rgb(style.getPropertyValue(`--bm-pair-${name}`));
  }

  /** The colour of a pair: a tint by its class, or along the scale by its angle. */
  colour({ kind, degrees }) {
    if (kind >= OUTSIDE) return this.tints[kind];
    const [low, high] = this.map.scale, share = 2 * clamp((degrees - low) / (high - low), 0, 1);
    const [from, to] = share < 1 ? [this.scale[0], this.scale[1]] : [this.scale[1], this.scale[2]];
    return from.map((c, k) => Math.round(c + (share % 1 || (share === 2 ? 1 : 0)) * (to[k] - c)));
  }

  paint() {
    const colour = this.colours(), context = this.canvas.getContext("2d");
    this.scale = ["low", "middle", "high"].map(colour);
    this.tints = TINTS.map((name) => (name && name !== "none" ? colour(name) : rgb(getComputedStyle(this.parent).getPropertyValue("--bm-panel"))));
    const image = context.createImageData(this.columns, this.rows);
    for (let j = 0; j < this.rows; j += 1) {
      for (let i = 0; i < this.columns; i += 1) {
        image.data.set([...this.colour(this.pairs.pair([i, j])), 255], 4 * ((this.rows - 1 - j) * this.columns + i));
      }
    }
    context.putImageData(image, 0, 0);
  }

  /** A line around the pairs that work with pivots where they are assumed, if others work, too. */
  outline() {
    const kinds = new Set(this.map.cells.map((code) => code % CLASSES));
    this.outlined = kinds.has(0) && kinds.has(1);
    if (!this.outlined) return [];
    const own = (i, j) => i >= 0 && j >= 0 && i < this.columns && j < this.rows && this.pairs.pair([i, j]).kind === 0;
    const mask = []; // with specks filled that do not work amid pairs that do
    for (let j = -1; j <= this.rows; j += 1) {
      for (let i = -1; i <= this.columns; i += 1) {
        let around = 0;
        for (const dj of [-1, 0, 1]) for (const di of [-1, 0, 1]) around += Number(own(i + di, j + dj));
        mask.push(own(i, j) || around >= SPECK);
      }
    }
    const works = (i, j) => mask[(j + 1) * (this.columns + 2) + i + 1];
    const corner = (i, j) => this.middleOf([i - 0.5, j - 0.5]).map(px).join(" "), parts = [];
    for (let j = 0; j <= this.rows; j += 1) {
      for (let i = 0; i <= this.columns; i += 1) {
        if (works(i, j) !== works(i - 1, j)) parts.push(`M${corner(i, j)}L${corner(i, j + 1)}`);
        if (works(i, j) !== works(i, j - 1)) parts.push(`M${corner(i, j)}L${corner(i + 1, j)}`);
      }
    }
    const d = parts.join("");
    return [s("path", { class: "bm-pair-halo bm-thin", d }), s("path", { class: "bm-pair-outline", d })];
  }

  /** The middle of a cell in pixels. */
  middleOf([i, j]) {
    const { margin, across, down } = this.view;
    return [margin.left + ((i + 0.5) / this.columns) * across, margin.top + down - ((j + 0.5) / this.rows) * down];
  }

  /** The cell under the pointer; null beside the map. */
  cellAt(event) {
    const box = this.svg.getBoundingClientRect(), { margin, across, down, width, height } = this.view;
    const x = ((event.clientX - box.left) / box.width) * width - margin.left;
    const y = ((event.clientY - box.top) / box.height) * height - margin.top;
    if (x < 0 || y < 0 || x >= across || y >= down) return this.cursor;
    return [Math.floor((x / across) * this.columns), Math.floor((1 - y / down) * this.rows)].map((v, k) => clamp(v, 0, (k ? this.rows : this.columns) - 1));
  }

  /** Ticks and lines between loops, on both axes of the square. */
  axes() {
    const { margin, across, down } = this.view, out = s("g", { class: "bm-pairs-axes" });
    const { pairs } = this, left = margin.left, foot = margin.top + down;
    pairs.starts.forEach((start, loop) => {
      const size = this.map.loops[loop], letter = pairs.letter(loop);
      const shares = (size / this.columns) * across < 150 ? [0, 0.5] : SHARES;
      for (const share of shares) {
        const along = ((start + share * size) / this.columns) * across, text = `${letter}${share}`;
        out.append(
          s("path", { d: `M${px(left + along)} ${foot}v4M${left} ${px(foot - along)}h-4` }),
          s("text", { x: px(left + along), y: foot + 17, "text-anchor": "middle" }, text),
          s("text", { x: left - 7, y: px(foot - along + 4), "text-anchor": "end" }, text),
        );
      }
      if (loop) {
        const at = (start / this.columns) * across;
        out.append(s("path", { d: `M${px(left + at)} ${margin.top}v${down}M${left} ${px(foot - at)}h${across}` }));
      }
    });
    out.append(s("rect", { x: left, y: margin.top, width: across, height: down, fill: "none" }));
    return out;
  }

  /** Poses, poles and the fixed pivot of the dyad that is chosen, over the plane of three poses. */
  ground() {
    const out = s("g", {}), labels = new Labels(this.view);
    for (const pose of this.data.poses) {
      const at = this.pixel([pose.x, pose.y]);
      out.append(s("path", { class: "bm-cross", d: `M${at[0] - 4} ${at[1]}h8M${at[0]} ${at[1] - 4}v8` }), labels.put(at[0], at[1], pose.label, 10, { class: "bm-map-name" }));
    }
    for (const pole of this.map.poles) {
      const [x, y] = this.pixel(pole);
      out.append(s("path", { class: "bm-pole", d: `M${x} ${y - 5}l4.5 8h-9z` }));
    }
    if (this.map.chosen.fixed) {
      const at = this.pixel(this.map.chosen.fixed);
      out.append(s("circle", { class: "bm-its-pivot bm-side0", cx: at[0], cy: at[1], r: 6 }), labels.put(at[0], at[1], this.map.chosen.id, 12, { class: "bm-map-name" }));
    }
    return out;
  }

  /** A point of F in pixels of the plane of three poses. */
  pixel(point) {
    const { low, high } = this.map, many = [this.columns, this.rows];
    return this.middleOf(point.map((v, k) => ((v - low[k]) / (high[k] - low[k])) * (many[k] - 1))).map(px);
  }

  /** Rings around the linkage: on the square twice, as each pair has its place twice. */
  rings() {
    const out = s("g", {});
    if (!this.place) return out;
    for (const at of this.isCurve ? [this.place, [...this.place].reverse()] : [this.place]) {
      const [x, y] = this.middleOf(at).map(px);
      out.append(s("circle", { class: "bm-pair-halo", cx: x, cy: y, r: 7 }), s("circle", { class: "bm-pair-ring", cx: x, cy: y, r: 7 }));
    }
    return out;
  }

  explain() {
    const [low, high] = this.map.scale, swatch = (name) => h("span", { class: `bm-swatch bm-pair-${name}` });
    const used = new Set(this.map.cells.map((code) => code % CLASSES));
    this.legend.replaceChildren(
      h("span", { class: "bm-pair-scale", "aria-hidden": "true" }),
      ` works: transmission angle from ${fixed(low, 0)}° to ${fixed(high, 0)}°. `,
      ...TINTS.flatMap((name, kind) => (kind >= OUTSIDE && SHORT[kind] && used.has(kind) ? [h("span", { class: "bm-pair-key" }, swatch(name), ` ${SHORT[kind]}`), " "] : [])),
      this.outlined ? "Outlined: works with pivots where they are assumed to lie; the rest works with pivots farther away. " : "",
      this.place ? (this.isCurve ? "Ring: this linkage." : `Ring: ${this.map.other.id}. Triangles: poles.`) : this.isCurve ? "" : "Triangles: poles.",
    );
  }

  /** Move the cursor by a key, from one pair to the next; it starts at the linkage. */
  move(event) {
    if (event.key === "Escape" && this.cursor) {
      this.pin(null);
      return;
    }
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const many = event.shiftKey ? 10 : 1, [i, j] = this.cursor ?? this.place ?? [this.columns >> 1, this.rows >> 1];
    this.pin([clamp(i + many * step[0], 0, this.columns - 1), clamp(j + many * step[1], 0, this.rows - 1)]);
  }

  /** Put the cursor on a pair, or take it away. */
  pin(cell) {
    this.cursor = cell;
    this.tell(cell);
  }

  /** Say what a pair does, and draw its linkage at pose 1; without a pair how to get one. */
  tell(cell) {
    const { mark, cursor } = this;
    mark.setAttribute("visibility", cursor ? "visible" : "hidden");
    if (cursor) mark.setAttribute("transform", `translate(${this.middleOf(cursor).map(px).join(" ")})`);
    const shown = cell ?? this.place;
    this.drawPair(shown);
    this.readout.textContent = cell ? this.words(cell) : "Point at the map to read a pair, or move over it by arrow keys.";
  }

  words(cell) {
    const { kind, driver, degrees } = this.pairs.pair(cell), { map } = this, { words } = map;
    const digits = Math.max(0, 2 - Math.floor(Math.log10(this.data.scene))), unit = this.data.unit ? ` ${this.data.unit}` : "";
    const point = (p) => `(${p.map((v) => fixed(v, digits)).join(", ")})`;
    const dyad = ({ fixed: c, moving: m, length }) => `fixed pivot ${point(c)}, moving pivot ${point(m)}, link ${figure(length)}${unit}`;
    const dyads = this.pairs.dyadsOf(cell);
    const does = kind <= OUTSIDE ? `${words[kind]}; transmission angle ${degrees}° or more, driven by ${this.isCurve ? ["the first", "the second"][driver] : [map.chosen.id, "the other one"][driver]}` : words[kind];
    if (!this.isCurve) return `${capital(dyad(dyads[1]))}: ${does}.`;
    return `${this.pairs.placeName(cell[0])} with ${this.pairs.placeName(cell[1])}: ${does}. First: ${dyad(dyads[0])}. Second: ${dyad(dyads[1])}.`;
  }

  drawPair(cell) {
    this.drawn.replaceChildren();
    if (!cell) return;
    const to = this.isCurve ? this.curve.pixel : (p) => this.pixel(p), [pose] = this.data.poses;
    const dyads = this.pairs.dyadsOf(cell), pins = dyads.filter((each) => each.moving).map((each) => to(this.pairs.seen(each.moving)));
    const line = (points, name) => s("path", { class: name, d: `M${points.map((p) => p.map(px).join(" ")).join("L")}` });
    this.drawn.append(line([...pins, to([pose.x, pose.y])], "bm-pair-body"));
    dyads.forEach((each, side) => {
      if (each.fixed && each.moving) this.drawn.append(line([to(each.fixed), to(this.pairs.seen(each.moving))], `bm-pair-link bm-side${side}`));
      if (each.fixed) this.drawn.append(dot(to(each.fixed), `bm-pair-ground bm-side${side}`, 4.5));
    });
    for (const pin of pins) this.drawn.append(dot(pin, "bm-pair-pin", 3.2));
  }
}

const dot = ([x, y], name, r) => s("circle", { class: name, cx: px(x), cy: px(y), r });
const capital = (text) => text[0].toUpperCase() + text.slice(1);
