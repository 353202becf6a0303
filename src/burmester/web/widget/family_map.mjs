// The map of a family: all pairs of the dyads that few poses leave, coloured by what becomes of them.
// Four poses: a square over the curve of dyads, beside the curve itself.  Three poses: the plane of
// the second fixed pivot, beside one dyad that is chosen.

import { h, rgb, s } from "./dom.mjs";
import { Labels } from "./labels.mjs";
import { clamp, figure, fixed, px } from "./numbers.mjs";

const CLASSES = 7; // see PairClass of burmester/families/pair_verdicts.py
const TINTS = ["", "", "outside", "order", "branch", "circuit", "none"]; // of classes, in the style sheet
const SHORT = ["works", "works", "outside limits or standard", "order defect", "branch defect", "circuit defect", ""];
const SPECK = 6; // of nine pairs around one that does not work; no outline goes around that one
const OUTSIDE = 2; // the first class that does not work
const MARGIN = { left: 50, right: 8, top: 8, bottom: 26 }; // pixels around the square
const SHARES = [0, 0.25, 0.5, 0.75]; // places along a loop that both pictures mark
const LARGEST = 520; // pixels: the side of the square
const BESIDE = 620; // pixels; a narrower panel has the two pictures under each other

export class FamilyMap {
  constructor(data, parent) {
    this.data = data;
    this.map = data.family_map;
    this.parent = parent;
    this.isCurve = this.map.kind === "curve";
    this.columns = this.isCurve ? this.map.fixed.length : this.map.columns;
    this.rows = this.isCurve ? this.columns : this.map.rows;
    this.canvas = h("canvas", { "aria-hidden": "true", width: this.columns, height: this.rows });
    const name = `bm-pairs-${Math.random().toString(36).slice(2)}`; // a page may hold several reports
    const what = this.isCurve ? "pairs of dyads on the curve of four poses" : "the second fixed pivot of three poses";
    this.svg = s("svg", {
      class: "bm-pairs-picture", role: "application", tabindex: "0", "aria-roledescription": "map", "aria-describedby": name,
      "aria-label": `Family map: ${what}. Arrow keys move a cursor, with Shift by ten steps; what the pair does is told and drawn.`,
    });
    this.scene = this.isCurve ? s("svg", { class: "bm-pairs-scene", role: "img", "aria-label": "The centre-point curve, and the linkage of the pair at pose 1" }) : null;
    this.readout = h("output", { class: "bm-readout", id: name });
    this.legend = h("p", { class: "bm-legend" });
    this.box = h("div", { class: "bm-pairs" }, h("div", { class: "bm-pairs-map" }, this.canvas, this.svg), this.scene);
    parent.append(this.box, this.legend, this.readout);
    this.cursor = null;
    this.svg.addEventListener("pointermove", (event) => this.tell(this.cellAt(event)));
    this.svg.addEventListener("pointerdown", (event) => this.pin(this.cellAt(event)));
    this.svg.addEventListener("pointerleave", () => this.tell(this.cursor));
    this.svg.addEventListener("keydown", (event) => this.move(event));
    this.starts = [];
    (this.map.loops ?? []).reduce((start, size) => (this.starts.push(start), start + size), 0);
  }

  /** The pair at column i and row j: its class, its driver (0 or 1) and whole degrees. */
  pair([i, j]) {
    const { cells } = this.map;
    if (!this.isCurve) return this.decoded(cells[j * this.columns + i]);
    if (i === j) return { kind: CLASSES - 1, driver: 0, degrees: 0 };
    const [a, b] = [Math.min(i, j), Math.max(i, j)], n = this.columns;
    const pair = this.decoded(cells[a * n - (a * (a + 1)) / 2 + b - a - 1]);
    return i < j ? pair : { ...pair, driver: 1 - pair.driver };
  }

  decoded(code) {
    const rest = Math.floor(code / CLASSES);
    return { kind: code % CLASSES, driver: rest % 2, degrees: Math.floor(rest / 2) };
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
    this.place = isCurve ? (this.map.places[index ?? 0] ?? null) : this.cellOf(this.map.other.fixed);
    this.paint();
    svg.replaceChildren(...this.outline(), isCurve ? this.axes() : this.ground());
    this.drawn = s("g", { class: "bm-pair-drawn" });
    this.mark = s("path", { class: "bm-map-cursor", d: "M-11 0H-4M4 0H11M0 -11V-4M0 4V11" });
    if (!isCurve) svg.append(this.drawn);
    svg.append(this.rings(), this.mark);
    if (this.scene) this.buildScene(beside ? wide - width - 16 : wide, height);
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
        image.data.set([...this.colour(this.pair([i, j])), 255], 4 * ((this.rows - 1 - j) * this.columns + i));
      }
    }
    context.putImageData(image, 0, 0);
  }

  /** A line around the pairs that work with pivots where they are assumed, if others work, too. */
  outline() {
    const kinds = new Set(this.map.cells.map((code) => code % CLASSES));
    this.outlined = kinds.has(0) && kinds.has(1);
    if (!this.outlined) return [];
    const own = (i, j) => i >= 0 && j >= 0 && i < this.columns && j < this.rows && this.pair([i, j]).kind === 0;
    const mask = []; // with specks filled that do not work amid pairs that do
    for (let j = -1; j <= this.rows; j += 1) {
      for (let i = -1; i <= this.columns; i += 1) {
        let around = 0;
        for (const dj of [-1, 0, 1]) for (const di of [-1, 0, 1]) around += own(i + di, j + dj);
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

  /** The cell of a fixed pivot in the plane of three poses. */
  cellOf(pivot) {
    if (!pivot) return null;
    const { low, high } = this.map, many = [this.columns, this.rows];
    const at = pivot.map((v, k) => Math.round(((v - low[k]) / (high[k] - low[k])) * (many[k] - 1)));
    return at.every((v, k) => v >= 0 && v < many[k]) ? at : null;
  }

  /** The fixed pivot of a cell in the plane of three poses. */
  pivotOf(cell) {
    const { low, high } = this.map, many = [this.columns, this.rows];
    return cell.map((v, k) => low[k] + (v / (many[k] - 1)) * (high[k] - low[k]));
  }

  /** The name of a place along the curve: its share of its loop, after the loop's letter. */
  placeName(k) {
    const loop = this.starts.findLastIndex((start) => start <= k), size = this.map.loops[loop];
    return `${this.starts.length > 1 ? `${"ABCDEFGH"[loop]} ` : ""}${((k - this.starts[loop] + 0.5) / size).toFixed(2)}`;
  }

  /** Ticks and lines between loops, on both axes of the square. */
  axes() {
    const { margin, across, down } = this.view, out = s("g", { class: "bm-pairs-axes" });
    const many = this.starts.length > 1, left = margin.left, foot = margin.top + down;
    this.starts.forEach((start, loop) => {
      const size = this.map.loops[loop], letter = many ? `${"ABCDEFGH"[loop]} ` : "";
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
      out.append(s("path", { class: "bm-cross", d: `M${at[0] - 4} ${at[1]}h8M${at[0]} ${at[1] - 4}v8` }), labels.put(...at, pose.label, 10, { class: "bm-map-name" }));
    }
    for (const pole of this.map.poles) {
      const [x, y] = this.pixel(pole);
      out.append(s("path", { class: "bm-pole", d: `M${x} ${y - 5}l4.5 8h-9z` }));
    }
    if (this.map.chosen.fixed) {
      const at = this.pixel(this.map.chosen.fixed);
      out.append(s("circle", { class: "bm-its-pivot bm-side0", cx: at[0], cy: at[1], r: 6 }), labels.put(...at, this.map.chosen.id, 12, { class: "bm-map-name" }));
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

  /** The curve itself, in the colours of the best partners, with marks of places along it. */
  buildScene(width, height) {
    const { map, scene, data } = this;
    scene.setAttribute("viewBox", `0 0 ${width} ${height}`);
    Object.assign(scene.style, { width: `${width}px`, height: `${height}px` });
    const best = map.fixed.map((_, i) => this.bestPartner(i));
    const poses = data.poses.map((pose) => [pose.x, pose.y]);
    const middle = [0, 1].map((k) => (Math.min(...poses.map((p) => p[k])) + Math.max(...poses.map((p) => p[k]))) / 2);
    const near = (p) => p.every((v, k) => Math.abs(v - middle[k]) < 3 * data.scene);
    const held = [...poses, ...map.fixed.filter((p, i) => best[i].kind < OUTSIDE && near(p)), ...this.pinsOf(this.place)];
    const low = [0, 1].map((k) => Math.min(...held.map((p) => p[k]))), high = [0, 1].map((k) => Math.max(...held.map((p) => p[k])));
    const scale = Math.min(width / (high[0] - low[0] || data.scene), height / (high[1] - low[1] || data.scene)) * 0.8;
    this.toScene = (p) => [width / 2 + (p[0] - (low[0] + high[0]) / 2) * scale, height / 2 - (p[1] - (low[1] + high[1]) / 2) * scale];
    const curve = s("g", { class: "bm-pairs-curve" }), under = s("g", { class: "bm-pairs-under" }), labels = new Labels({ width, height });
    const marks = s("g", { class: "bm-pairs-axes" });
    const inside = ([x, y]) => x > 0 && y > 0 && x < width && y < height;
    // Two places on opposite sides of the view, neither of them in it: the curve goes through infinity.
    const beyond = (p, q) => !inside(p) && !inside(q) && (p[0] - width / 2) * (q[0] - width / 2) + (p[1] - height / 2) * (q[1] - height / 2) < 0;
    this.starts.forEach((start, loop) => {
      const size = map.loops[loop], at = (k) => this.toScene(map.fixed[start + ((k + size) % size)]);
      const between = (p, q) => [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
      for (let k = 0; k < size; k += 1) {
        const piece = [between(at(k - 1), at(k)), at(k), between(at(k), at(k + 1))];
        if (beyond(at(k - 1), at(k)) || beyond(at(k), at(k + 1))) continue;
        const d = `M${piece.map((p) => p.map(px).join(" ")).join("L")}`;
        under.append(s("path", { d }));
        curve.append(s("path", { d, stroke: `rgb(${this.colour(best[start + k]).join()})` }));
      }
      for (const share of SHARES) {
        const [x, y] = at(Math.min(size - 1, Math.round(share * size)));
        if (!inside([x, y])) continue;
        marks.append(s("circle", { class: "bm-pairs-mark", cx: px(x), cy: px(y), r: 2.2 }));
        marks.append(labels.put(x, y, `${this.starts.length > 1 ? `${"ABCDEFGH"[loop]} ` : ""}${share}`, 12, {}));
      }
    });
    const wanted = s("g", {});
    for (const pose of data.poses) {
      const [x, y] = this.toScene([pose.x, pose.y]).map(px);
      wanted.append(s("path", { class: "bm-cross", d: `M${x - 4} ${y}h8M${x} ${y - 4}v8` }), labels.put(x, y, pose.label, 10, { class: "bm-map-name" }));
    }
    scene.replaceChildren(under, curve, marks, wanted, this.drawn);
  }

  /** The best pair that a dyad of the curve makes. */
  bestPartner(i) {
    let best = { kind: CLASSES - 1, degrees: 0 };
    for (let j = 0; j < this.columns; j += 1) {
      const pair = this.pair([i, j]);
      if (pair.kind < best.kind || (pair.kind === best.kind && pair.degrees > best.degrees)) best = pair;
    }
    return best;
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
    const { kind, driver, degrees } = this.pair(cell), { map } = this, { words } = map;
    const digits = Math.max(0, 2 - Math.floor(Math.log10(this.data.scene))), unit = this.data.unit ? ` ${this.data.unit}` : "";
    const point = (p) => `(${p.map((v) => fixed(v, digits)).join(", ")})`;
    const dyad = ({ fixed: c, moving: m, length }) => `fixed pivot ${point(c)}, moving pivot ${point(m)}, link ${figure(length)}${unit}`;
    const dyads = this.dyadsOf(cell);
    const does = kind <= OUTSIDE ? `${words[kind]}; transmission angle ${degrees}° or more, driven by ${this.isCurve ? ["the first", "the second"][driver] : [map.chosen.id, "the other one"][driver]}` : words[kind];
    if (!this.isCurve) return `${capital(dyad(dyads[1]))}: ${does}.`;
    return `${this.placeName(cell[0])} with ${this.placeName(cell[1])}: ${does}. First: ${dyad(dyads[0])}. Second: ${dyad(dyads[1])}.`;
  }

  /** Both dyads of a pair: fixed pivots in F, moving ones in M, lengths. */
  dyadsOf(cell) {
    const { map } = this;
    if (this.isCurve) return cell.map((k) => ({ fixed: map.fixed[k], moving: map.moving[k], length: map.length[k] }));
    return [map.chosen, dyadOfThree(this.data.poses, this.pivotOf(cell))];
  }

  /** The pivots of a pair in F, at pose 1. */
  pinsOf(cell) {
    if (!cell) return [];
    return this.dyadsOf(cell).flatMap((each) => [...(each.fixed ? [each.fixed] : []), ...(each.moving ? [this.seen(each.moving)] : [])]);
  }

  /** A point of the body in F, at pose 1. */
  seen([x, y]) {
    const [pose] = this.data.poses, turn = (pose.angle_deg * Math.PI) / 180, [cos, sin] = [Math.cos(turn), Math.sin(turn)];
    return [pose.x + cos * x - sin * y, pose.y + sin * x + cos * y];
  }

  drawPair(cell) {
    this.drawn.replaceChildren();
    if (!cell) return;
    const to = this.isCurve ? this.toScene : (p) => this.pixel(p), [pose] = this.data.poses;
    const dyads = this.dyadsOf(cell), pins = dyads.filter((each) => each.moving).map((each) => to(this.seen(each.moving)));
    const line = (points, name) => s("path", { class: name, d: `M${points.map((p) => p.map(px).join(" ")).join("L")}` });
    this.drawn.append(line([...pins, to([pose.x, pose.y])], "bm-pair-body"));
    dyads.forEach((each, side) => {
      if (each.fixed && each.moving) this.drawn.append(line([to(each.fixed), to(this.seen(each.moving))], `bm-pair-link bm-side${side}`));
      if (each.fixed) this.drawn.append(dot(to(each.fixed), `bm-pair-ground bm-side${side}`, 4.5));
    });
    for (const pin of pins) this.drawn.append(dot(pin, "bm-pair-pin", 3.2));
  }
}

const dot = ([x, y], name, r) => s("circle", { class: name, cx: px(x), cy: px(y), r });
const capital = (text) => text[0].toUpperCase() + text.slice(1);

/** The dyad of three poses with a fixed pivot: seen from the body, the pivot runs on a circle. */
function dyadOfThree(poses, pivot) {
  const [a, b, c] = poses.map((pose) => {
    const turn = (-pose.angle_deg * Math.PI) / 180, [x, y] = [pivot[0] - pose.x, pivot[1] - pose.y];
    return [Math.cos(turn) * x - Math.sin(turn) * y, Math.sin(turn) * x + Math.cos(turn) * y];
  });
  const u = [b[0] - a[0], b[1] - a[1]], v = [c[0] - a[0], c[1] - a[1]];
  const cross = 2 * (u[0] * v[1] - u[1] * v[0]), uu = u[0] ** 2 + u[1] ** 2, vv = v[0] ** 2 + v[1] ** 2;
  const arm = [(uu * v[1] - vv * u[1]) / cross, (vv * u[0] - uu * v[0]) / cross];
  return { fixed: pivot, moving: [a[0] + arm[0], a[1] + arm[1]], length: Math.hypot(...arm) };
}
