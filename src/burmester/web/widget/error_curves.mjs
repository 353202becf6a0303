// Output, structural error and transmission angle over the input, with one cursor through all.

import { s } from "./dom.mjs";
import { angleTicks, clamp, figure, px, ticks } from "./numbers.mjs";

const LEFT = 62, RIGHT = 14, TOP = 22, BOTTOM = 44; // pixels around the panels
const HEIGHTS = [110, 130, 84], GAP = 30; // pixels: heights of the panels, distance between two
const INSET = 8; // pixels: from the sides of a panel to the ends of what is shown
const ROUNDING = 1e-7; // degrees; errors below are none
const HEADROOM = 1.15; // greatest values: the height of a panel
const MOST_DOTS = 40; // pairs whose dots stand on a curve
const SAMPLES = 241; // inputs at which curves are drawn
const SPARE = 0.01; // of the range: frames beside its ends are within it
const USUAL_LIMIT = 30; // degrees: the transmission angle below which a linkage is not sound

export class ErrorCurves {
  constructor(task, generator, parent, go) {
    this.task = task;
    this.generator = generator;
    this.parent = parent;
    this.svg = s("svg", { class: "bm-plots", role: "img", "aria-label": `${generator.id}: output, structural error and transmission angle over the input` });
    parent.append(this.svg);
    const scrub = (event) => {
      const box = this.svg.getBoundingClientRect(), { low, high } = generator.range;
      const share = (event.clientX - box.left - LEFT - INSET) / (this.width - LEFT - RIGHT - 2 * INSET);
      go(low + clamp(share, 0, 1) * (high - low));
    };
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      scrub(event);
    });
    this.svg.addEventListener("pointermove", (event) => event.buttons & 1 && scrub(event));
  }

  build() {
    const { svg, generator } = this, { low, high } = generator.range;
    svg.replaceChildren();
    const width = (this.width = Math.max(260, this.parent.clientWidth));
    const height = TOP + HEIGHTS.reduce((a, b) => a + b) + 2 * GAP + BOTTOM;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("height", height);
    this.X = (input) => LEFT + INSET + ((input - low) / (high - low)) * (width - LEFT - RIGHT - 2 * INSET);
    this.across = angleTicks(low, high, Math.max(3, width / 90));
    const { curve, pair_at } = generator;
    const pairs = pair_at.length <= MOST_DOTS ? pair_at : [];
    const inputs = Array.from({ length: SAMPLES }, (_, k) => low + (k / (SAMPLES - 1)) * (high - low));
    const along = inputs.map(generator.at);
    this.Yout = this.output(0, curve, inputs, along.map((each) => each.output), pairs);
    this.Yerr = this.error(1, curve, pairs);
    this.Ytra = this.transmission(2, inputs, along.map((each) => each.transmission));
    const base = TOP + HEIGHTS.reduce((a, b) => a + b) + 2 * GAP;
    svg.append(s("text", { class: "bm-title", x: (LEFT + width - RIGHT) / 2, y: height - 6, "text-anchor": "middle" }, "input (°)"));
    this.marks = [1, 2, 3].map(() => s("circle", { r: 4.5 }));
    this.cursor = s("g", { class: "bm-cursor" }, s("path", { d: `M0 ${TOP}V${base}` }), ...this.marks);
    svg.append(this.cursor);
  }

  /** An empty panel with its title; its top and its base. */
  panel(k, title, labelled = false) {
    const { svg, width } = this;
    const y0 = TOP + HEIGHTS.slice(0, k).reduce((a, b) => a + b, 0) + k * GAP, base = y0 + HEIGHTS[k];
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
    return [y0, base];
  }

  rule(y, text) {
    this.svg.append(
      s("path", { class: "bm-rule", d: `M${LEFT} ${px(y)}H${this.width - RIGHT}` }),
      s("text", { class: "bm-tick", x: LEFT - 6, y: px(y) + 4, "text-anchor": "end" }, text),
    );
  }

  /** A line over inputs, broken where a value is null. */
  line(inputs, values, Y, name) {
    let path = "", pen = "M";
    values.forEach((value, k) => {
      if (value === null) return (pen = "M");
      path += `${pen}${px(this.X(inputs[k]))} ${px(Y(value))}`;
      return (pen = "L");
    });
    this.svg.append(s("path", { class: name, d: path }));
  }

  dots(pairs, Y, value, unit) {
    for (const pair of pairs) {
      if (value(pair) === null) continue;
      const dot = s("circle", { class: "bm-dot", cx: px(this.X(pair.input)), cy: px(Y(value(pair))), r: 3.5 });
      dot.append(s("title", {}, `pair ${pair.pair}: ${figure(value(pair))}${unit}`));
      this.svg.append(dot);
    }
  }

  output(k, curve, inputs, made, pairs) {
    const [y0, base] = this.panel(k, `output (°)${pairs.length ? ": wanted as dots, made as a line" : ""}`);
    const every = [...curve.wanted, ...made.filter((each) => each !== null)];
    const low = Math.min(...every), high = Math.max(...every), room = 0.08 * (high - low);
    const Y = (v) => base - ((v - low + room) / (high - low + 2 * room)) * (base - y0);
    for (const { at, text } of ticks(low, high, 4)) this.rule(Y(at), text);
    this.line(inputs, made, Y, "bm-line");
    this.dots(pairs, Y, (pair) => pair.wanted, "°");
    return Y;
  }

  error(k, curve, pairs) {
    const [y0, base] = this.panel(k, `structural error of the output (°)${curve.whole ? "" : ", at the pairs"}`);
    const known = curve.error.filter((each) => each !== null);
    const greatest = known.reduce((a, b) => Math.max(a, Math.abs(b)), 0), middle = (y0 + base) / 2;
    const visible = greatest > ROUNDING;
    const Y = (v) => middle - (visible ? v / (HEADROOM * greatest) : 0) * ((base - y0) / 2);
    this.svg.append(s("path", { class: "bm-usual", d: `M${LEFT} ${px(middle)}H${this.width - RIGHT}` }));
    if (!visible) {
      const text = known.length ? "exact, up to rounding" : "it cannot be assembled";
      this.svg.append(s("text", { class: "bm-note", x: LEFT + 8, y: middle - 12 }, text));
    } else {
      for (const { at, text } of ticks(-greatest, greatest, 4)) this.rule(Y(at), text);
    }
    if (curve.whole) this.line(curve.input, curve.error, Y, "bm-line");
    else
      for (const pair of pairs) {
        if (pair.error !== null) this.svg.append(s("path", { class: "bm-stem", d: `M${px(this.X(pair.input))} ${middle}V${px(Y(pair.error))}` }));
      }
    this.dots(pairs, Y, (pair) => pair.error, "°");
    return Y;
  }

  transmission(k, inputs, values) {
    const [y0, base] = this.panel(k, "transmission angle (°)", true);
    const Y = (v) => base - (v / 90) * (base - y0);
    for (const at of [0, 30, 60, 90]) this.rule(Y(at), at);
    const asked = this.task.asked_transmission_deg, limit = asked ?? USUAL_LIMIT;
    this.svg.append(s("path", { class: "bm-usual", d: `M${LEFT} ${px(Y(limit))}H${this.width - RIGHT}` }));
    this.line(inputs, values, Y, "bm-line");
    return Y;
  }

  show(input, transmission) {
    if (!this.cursor) return;
    const { low, high } = this.generator.range, spare = SPARE * (high - low);
    const within = input >= low - spare && input <= high + spare, { output } = this.generator.at(input);
    this.cursor.setAttribute("visibility", within ? "visible" : "hidden");
    this.cursor.setAttribute("transform", `translate(${px(this.X(input))} 0)`);
    const wanted = this.generator.wantedAt(input);
    const missed = wanted === null || output === null ? null : output - wanted;
    const places = [output === null ? null : this.Yout(output), missed === null ? null : this.Yerr(missed), transmission === null ? null : this.Ytra(transmission)];
    places.forEach((y, k) => {
      this.marks[k].setAttribute("visibility", y === null || !within ? "hidden" : "inherit");
      if (y !== null) this.marks[k].setAttribute("cy", px(y));
    });
  }
}
