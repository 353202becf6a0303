// Errors at the poses and the transmission angle, over the drive, with one cursor through all.

import { put, s } from "./dom.mjs";
import { frameAt, linear, valueAt } from "./kinematics.mjs";
import { angleTicks, clamp, figure, px, ticks } from "./numbers.mjs";
import { calledOf, isPoint, nounOf, poseName, shortened } from "./tables.mjs";

export const LEFT = 62, RIGHT = 14; // pixels beside the panels
const TOP = 22, BOTTOM = 44; // pixels over and under them
const PANEL = 84, ONLY = 150, GAP = 28; // pixels: height of a panel, of one alone, distance between two
const MANY_POSES = 40; // above this number only the three greatest errors are named
const HEADROOM = 1.32; // greatest errors: the height of a panel, so that their names stay within
const NO_ERROR = 1e-7; // degrees; errors below are rounding
const TITLE = "Errors and transmission angle";
const INSET = 8; // pixels: from the sides of a panel to the ends of what is shown
const LONGEST_NAME = 16; // characters of a pose's name beside its stem
const NAME_WIDTH = 11; // pixels: what an upright name takes of the width

/** An SVG element in `parent`; a pointer on it calls `scrub` with a frame of the way. */
export class Plots {
  top = TOP;
  /** @type {any} */ count;
  /** @type {any} */ marks;
  /** @type {any} */ way;
  /** @type {any} */ width;
  /** @type {any} */ X;
  /** @type {any} */ stretch;
  /** @type {any} */ across;

  constructor(data, parent, scrub) {
    this.data = data;
    this.parent = parent;
    this.svg = s("svg", { class: "bm-plots", role: "img", "aria-label": TITLE });
    parent.append(this.svg);
    const go = (event) => {
      if (!this.way) return;
      const box = this.svg.getBoundingClientRect();
      const at = (event.clientX - box.left - LEFT - INSET) / (this.width - LEFT - RIGHT - 2 * INSET);
      const drive = this.driveAt(this.low + clamp(at, 0, 1) * (this.high - this.low));
      if (drive !== null) scrub(frameAt(this.way.drive, drive));
    };
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      go(event);
    });
    this.svg.addEventListener("pointermove", (event) => event.buttons & 1 && go(event));
  }

  /** Draw the panels of a linkage over a stretch of its way `index`. */
  build(linkage, index, stretch) {
    const { data, svg } = this, way = linkage.ways[index];
    this.linkage = linkage;
    this.way = way;
    svg.replaceChildren();
    this.cursor = null;
    if (!way) return;
    svg.setAttribute("aria-label", `${linkage.id}: ${TITLE.toLowerCase()} along the driver`);
    // Long names stand upright, in a strip over the first panel.
    const poses = linkage.pose_errors.map((row, k) => ({ ...row, pose: data.poses[k] })).filter((row) => row.way === index && row.pose);
    const upright = poses.some(({ pose }) => pose.label !== pose.name);
    const longest = Math.max(0, ...poses.map(({ pose }) => shortened(poseName(pose), LONGEST_NAME).length));
    this.top = TOP + (upright ? 6.2 * longest + 6 : 0);
    const count = linkage.panels ? linkage.panels.length + 1 : way.loops ? 1 : nounOf(data) === "point" ? 2 : 3;
    const [driver] = linkage.led, slides = driver.kind === "PR";
    this.stretch = stretch;
    const rows = poses.map((row) => ({ ...row, drive: linear(way.drive, row.frame) }));
    const unit = data.unit ?? "unit of the poses";
    const title = way.told ? `${way.told[0].name} (°)` : slides ? `place of ${driver.id} on its line (${unit})` : `driver angle (${driver.id})`;
    const ends = [stretch.low, stretch.high].map((u) => linear(way.drive, u)), [low, high] = stretch.sense < 0 ? ends.reverse() : ends;
    this.frame(count, low, high, !slides, title, () => {
      this.panels(rows, unit);
      if (upright) this.uprightNames(rows);
    });
  }

  /** So many panels, which `draw` fills, over what goes from low at the left to high at the right; with the cursor. */
  frame(count, low, high, turns, title, draw) {
    const { svg } = this, width = (this.width = Math.max(260, this.parent.clientWidth));
    this.count = count;
    this.low = low;
    this.high = high;
    const base = this.top + (count > 1 ? count * PANEL + (count - 1) * GAP : ONLY), height = base + BOTTOM;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("height", height);
    this.X = (at) => LEFT + INSET + ((at - low) / (high - low)) * (width - LEFT - RIGHT - 2 * INSET);
    const ends = [Math.min(low, high), Math.max(low, high)], marks = turns ? angleTicks(ends[0], ends[1], Math.max(3, width / 70)) : ticks(ends[0], ends[1], width / 90);
    this.across = low > high ? marks.reverse() : marks;
    this.marks = [];
    draw();
    svg.append(s("text", { class: "bm-title", x: (LEFT + width - RIGHT) / 2, y: height - 6, "text-anchor": "middle" }, title));
    this.cursor = s("g", { class: "bm-cursor" }, s("path", { d: `M0 ${this.top}V${base}` }));
    this.cursor.append(...this.marks.map(({ mark }) => mark));
    svg.append(this.cursor);
  }

  /** Where panel k begins and ends. */
  heights(k) {
    const y0 = this.top + k * (PANEL + GAP);
    return [y0, y0 + (this.count > 1 ? PANEL : ONLY)];
  }

  /** What the panels are over where the driver is at a place, and back; null where it is not known. */
  placeOf(drive) {
    return drive;
  }

  driveAt(place) {
    return place;
  }

  /** Draw the panels. */
  panels(rows, unit) {
    this.linkage.panels?.forEach((each, k) => this.values(k, each));
    if (this.linkage.panels || this.count === 1) {
      this.transmission(this.count - 1, rows);
      return;
    }
    this.errors(0, `position error (${unit})`, rows, (row) => row.position, 1e-11 * this.data.scene);
    if (nounOf(this.data) === "point") {
      this.transmission(1, rows);
      return;
    }
    this.errors(1, "angle error (°)", rows.filter(({ pose }) => !isPoint(pose)), (row) => row.turned_deg, 1e-9);
    this.transmission(2, rows);
  }

  /** The errors of the poses as stems; below `rounding` they are zero. */
  errors(k, title, rows, value, rounding) {
    const { svg, X } = this, [y0, base] = this.heights(k);
    const greatest = Math.max(1e-300, ...rows.map((row) => value(row) ?? 0));
    const visible = greatest > rounding;
    const high = visible ? HEADROOM * greatest : 1;
    const Y = (v) => base - (v / high) * PANEL;
    this.panel(title, y0, base);
    if (!visible) {
      svg.append(s("text", { class: "bm-note", x: LEFT + 8, y: y0 + PANEL / 2 }, rows.length ? "exact, up to rounding" : `no ${nounOf(this.data)} is on this assembly`));
    } else {
      for (const { at } of ticks(0, high, 3).slice(1)) this.rule(Y(at), figure(at));
      svg.append(s("text", { class: "bm-tick", x: LEFT - 6, y: base + 4, "text-anchor": "end" }, "0"));
    }
    const greatestThree = new Set([...rows].sort((a, b) => value(b) - value(a)).slice(0, 3));
    let last = -99;
    for (const row of [...rows].sort((a, b) => X(a.drive) - X(b.drive))) {
      const x = px(X(row.drive)), y = px(visible ? Y(value(row)) : base);
      svg.append(
        s("path", { class: "bm-stem", d: `M${x} ${base}V${y}` }),
        s("circle", { class: "bm-dot", cx: x, cy: y, r: 3.5 }, s("title", {}, `${calledOf(row.pose)}: ${figure(value(row))}`)),
      );
      const { label } = row.pose;
      if (x - last > 6 + 6.5 * label.length && (rows.length <= MANY_POSES || greatestThree.has(row))) {
        svg.append(s("text", { class: "bm-dot-name", x, y: y - 7, "text-anchor": "middle" }, label));
        last = x;
      }
    }
  }

  /** The transmission angle along the way, and at its poses. */
  transmission(k, rows) {
    const { svg, way, width, X } = this, [y0, base] = this.heights(k);
    const Y = (v) => base - (v / 90) * (base - y0);
    this.panel("transmission angle (°)", y0, base, true);
    for (const at of [0, 30, 60, 90]) this.rule(Y(at), at);
    const { deg: limit, said } = this.data.transmission_limit;
    svg.append(s("path", { class: "bm-usual", d: `M${LEFT} ${px(Y(limit))}H${width - RIGHT}` }));
    // Its name stands on the side of the line where the curve is not.
    const below = limit > 15 && (linear(way.transmission, this.stretch.sense < 0 ? this.stretch.low : this.stretch.high) ?? 90) > limit;
    const limitName = s("text", { class: "bm-tick bm-halo", x: width - RIGHT - 4, y: px(Y(limit)) + (below ? 12 : -4), "text-anchor": "end" }, said);
    (way.loops ?? [way.transmission]).forEach((values, loop) => {
      this.mark((drive) => linear(values, frameAt(way.drive, drive)), Y);
      const kind = way.loops ? ` bm-loop${loop}` : "";
      this.curve(values, Y, `bm-line${kind}`);
      for (const row of rows) {
        const value = way.loops ? row.loops[loop] : row.transmission_deg;
        if (value !== null) svg.append(s("circle", { class: `bm-dot${kind}`, cx: px(X(row.drive)), cy: px(Y(value)), r: 3 }));
      }
    });
    svg.append(limitName);
  }

  /** A dot on the cursor, at a value for the drive. */
  mark(value, Y) {
    this.marks.push({ mark: s("circle", { r: 4.5 }), value, Y });
  }

  /** A curve of its own over the drive, or stems from zero, with dots. */
  values(k, curve) {
    const { title, x, y, dots, stems } = curve, { svg } = this, [low, high] = [Math.min(this.low, this.high), Math.max(this.low, this.high)], [y0, base] = this.heights(k);
    const shown = [...x.keys()].filter((i) => y[i] !== null && x[i] >= low && x[i] <= high).map((i) => [x[i], y[i]]);
    const all = [...shown, ...dots].map(([, value]) => value), least = Math.min(...all), most = Math.max(...all), room = 0.08 * (most - least);
    this.panel(title, y0, base);
    if (!(Math.max(Math.abs(least), Math.abs(most)) > NO_ERROR)) {
      svg.append(s("text", { class: "bm-note", x: LEFT + 8, y: y0 + PANEL / 2 }, shown.length ? "exact, up to rounding" : "it cannot be assembled"));
      return;
    }
    const Y = (v) => base - ((v - least + room) / (most - least + 2 * room)) * PANEL;
    const at = (point) => `${px(this.X(point[0]))} ${px(Y(point[1]))}`;
    for (const { at: value, text } of ticks(least, most, 4)) this.rule(Y(value), text);
    if (least < 0 && most > 0) svg.append(s("path", { class: "bm-usual", d: `M${LEFT} ${px(Y(0))}H${this.width - RIGHT}` }));
    if (stems) for (const [a, b] of shown) svg.append(s("path", { class: "bm-stem", d: `M${at([a, 0])}L${at([a, b])}` }));
    else svg.append(s("path", { class: "bm-line", d: `M${shown.map(at).join("L")}` }));
    const ofPixel = (most - least + 2 * room) / PANEL; // for who drags a dot
    dots.forEach(([a, b], i) => svg.append(s("circle", { class: "bm-dot", cx: px(this.X(a)), cy: px(Y(b)), r: 3.5, "data-dot": i, "data-panel": k, "data-of-pixel": ofPixel }, s("title", {}, `${figure(b)}°`))));
    this.mark((drive) => valueAt(curve, drive), Y);
  }

  /** Values along the way as a line over the drive. */
  curve(values, Y, name) {
    const { low, high } = this.stretch, frames = [low];
    for (let i = Math.floor(low) + 1; i < high; i += 1) frames.push(i);
    frames.push(high);
    let line = "", pen = "M";
    for (const u of frames) {
      const value = linear(values, u);
      if (value === null) continue;
      line += `${pen}${px(this.X(linear(this.way.drive, u)))} ${px(Y(value))}`;
      pen = "L";
    }
    this.svg.append(s("path", { class: name, d: line }));
  }

  /** Names of the poses over their stems, those that have room. */
  uprightNames(rows) {
    let last = -99;
    for (const row of [...rows].sort((a, b) => this.X(a.drive) - this.X(b.drive))) {
      const x = this.X(row.drive), y = this.top - 20;
      if (x - last < NAME_WIDTH) continue;
      last = x;
      const text = s("text", { class: "bm-dot-name bm-upright", transform: `translate(${px(x + 4)} ${px(y)}) rotate(-90)` });
      text.append(shortened(poseName(row.pose), LONGEST_NAME));
      this.svg.append(s("g", {}, s("title", {}, poseName(row.pose)), text));
    }
  }

  /** An empty panel with its title and the lines of the drive. */
  panel(title, y0, base, labelled = false) {
    const { svg, width } = this;
    svg.append(
      s("rect", { class: "bm-panel", x: LEFT, y: y0, width: width - LEFT - RIGHT, height: base - y0 }),
      s("text", { class: "bm-title", x: LEFT, y: y0 - 7 }, title),
    );
    let last = -99;
    for (const { at, text } of this.across) {
      const x = px(this.X(at));
      svg.append(s("path", { class: "bm-rule", d: `M${x} ${y0}V${base}` }));
      if (labelled && x - last > 34) {
        svg.append(s("text", { class: "bm-tick", x, y: base + 15, "text-anchor": "middle" }, text));
        last = x;
      }
    }
  }

  rule(y, text) {
    this.svg.append(
      s("path", { class: "bm-rule", d: `M${LEFT} ${px(y)}H${this.width - RIGHT}` }),
      s("text", { class: "bm-tick", x: LEFT - 6, y: px(y) + 4, "text-anchor": "end" }, text),
    );
  }

  show(drive) {
    if (!this.cursor) return;
    const at = this.placeOf(drive);
    put(this.cursor, "visibility", at === null ? "hidden" : "visible");
    if (at === null) return;
    this.cursor.setAttribute("transform", `translate(${px(this.X(at))} 0)`);
    for (const { mark, value, Y } of this.marks) {
      const known = value(at);
      put(mark, "visibility", known === null ? "hidden" : "inherit");
      if (known !== null) put(mark, "cy", px(Y(known)));
    }
  }
}
