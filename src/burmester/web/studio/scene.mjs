// The plane with its layers: panned, zoomed and fitted, with a grid, and gestures on what is drawn in it.

import { h, put, s } from "../widget/dom.mjs";
import { bounds, fitted, viewOf } from "../widget/framing.mjs";
import { clamp, px, ticks } from "../widget/numbers.mjs";
import { HandleField } from "./handle_field.mjs";
import { NamePlaces } from "./name_places.mjs";
import { Snapping } from "./snapping.mjs";

const LAYERS = ["grid", "regions", "ghosts", "map", "curves", "paths", "mechanism", "limits", "pivots", "poses", "labels", "tool"];
const MARGIN = 46; // pixels around what a fit shows
const ZOOM = 1.0018; // a pixel of the wheel
const WIDEST = 1e6; // times the fitted scale, either way
const CLICK = 4; // pixels: a pointer that moves no farther clicks
const RAW = 8; // milliseconds: so often a hand is followed between two pictures, where the browser tells

/** What stands in the middle of the page: `layer(name)` is a group to draw in, in pixels; `view` goes to pixels and back.
 *
 * zoomKey: whether the wheel zooms with Ctrl or Cmd only, for it scrolls the page.
 */
export class Scene {
  /** @type {any} */ view;
  /** @type {any} */ pressed = null;
  /** @type {any} */ field;

  constructor(store, { zoomKey = false } = {}) {
    this.store = store;
    this.zoomKey = zoomKey;
    this.listeners = { view: [], click: [], tool: [], dropped: [], closer: [], marquee: [], key: [] };
    this.tool = null;
    this.dragged = null;
    this.layers = new Map(LAYERS.map((name) => [name, s("g", { class: `bs-layer bs-layer-${name}` })]));
    this.layers.get("grid").setAttribute("aria-hidden", "true");
    this.svg = s("svg", { class: "bs-scene", tabindex: 0, role: "group", "aria-label": "The plane: poses, linkage and limits. Arrow keys pan, plus and minus zoom, 0 fits." }, ...this.layers.values());
    this.element = h("div", { class: "bs-plane" }, this.svg);
    this.size = { width: 640, height: 480 };
    this.origin = { scale: 1, left: 320, top: 240 };
    this.isFitted = true; // until a hand moves it
    this.pointers = new Map(); // on the empty plane: one pans, two pinch
    this.boxes = []; // functions that say what a fit has to hold
    this.names = new NamePlaces(this);
    this.marquee = s("rect", { class: "bs-marquee" });
    this.snap = new Snapping(store, this);
    this.update();
    this.listen();
    this.field = new HandleField(store, this);
    store.on("document", () => this.unit === store.document.length_unit || this.grid());
    new ResizeObserver(() => this.resize()).observe(this.element);
    addEventListener("scroll", () => (this.box = null), { capture: true, passive: true });
  }

  layer(name) {
    return this.layers.get(name);
  }

  /** "view": after it changes; "click": on the empty plane, with a point and the event; "tool": another tool, or none; "dropped": a hand let go;
   * "closer": what is selected is to be seen closer; "marquee": a box of F was drawn with Shift; "key": on the plane, true where it had a use. */
  on(name, fn) {
    this.listeners[name].push(fn);
  }

  emit(name, ...values) {
    return this.listeners[name].map((fn) => fn(...values)).some(Boolean);
  }

  /** `fn` returns points of F that a fit has to hold, or in a close-up; far: as far as they leave room for handles. */
  hold(fn, far = false) {
    this.boxes.push({ fn, far });
  }

  // The view

  update() {
    const { width, height } = this.size, { scale, left, top } = this.origin;
    this.view = {
      scale, left, top, width, height,
      X: (x) => left + scale * x, Y: (y) => top - scale * y, x: (X) => (X - left) / scale, y: (Y) => (top - Y) / scale,
    };
    Object.assign(this.svg.dataset, { scale, left, top, fit: this.isFitted ? (this.isWhole ? "all" : "near") : "" });
    this.grid();
    this.emit("view", this.view);
  }

  resize() {
    this.box = null;
    const { width, height } = this.svg.getBoundingClientRect(); // a pixel of the picture is one of the page
    if (!width || !height || (width === this.size.width && height === this.size.height)) return;
    if (!this.dragged) this.origin = { ...this.origin, left: this.origin.left + (width - this.size.width) / 2, top: this.origin.top + (height - this.size.height) / 2 };
    this.size = { width, height };
    put(this.svg, "viewBox", `0 0 ${width} ${height}`);
    if (!this.refit()) this.update();
  }

  /** Fit again, where no person has moved the plane and none holds anything: it stays under a hand.  Returns whether it did. */
  refit() {
    if (!this.isFitted || this.dragged) return false;
    this.fit(this.isWhole);
    return true;
  }

  pan(dx, dy) {
    this.isFitted = false;
    this.origin = { ...this.origin, left: this.origin.left + dx, top: this.origin.top + dy };
    this.update();
  }

  /** Zoom about a point in pixels, which stays where it is. */
  zoom(factor, X, Y) {
    const fitted = this.fittedScale ?? this.origin.scale;
    const scale = clamp(this.origin.scale * factor, fitted / WIDEST, fitted * WIDEST), by = scale / this.origin.scale;
    this.isFitted = false;
    this.origin = { scale, left: X + by * (this.origin.left - X), top: Y + by * (this.origin.top - Y) };
    this.update();
  }

  /** Show what is held; whole: what is far as well. */
  fit(whole = false) {
    const pointsOf = (isFar) => this.boxes.filter(({ far }) => far === isFar).flatMap(({ fn }) => fn());
    this.isWhole = whole;
    this.isFitted = true;
    this.fitBox(fitted(pointsOf(false), pointsOf(true), whole));
  }

  /** Show a box of F. */
  fitBox(box) {
    const [x, y, u, v] = Number.isFinite(box[0]) ? box : [-50, -50, 50, 50], size = 0.1 * (Math.max(u - x, v - y) || Math.max(1, Math.abs(u), Math.abs(v)));
    const { width, height } = this.size, wide = Math.max(0, size - u + x) / 2, high = Math.max(0, size - v + y) / 2;
    const { scale, left, top } = viewOf([x - wide, y - high, u + wide, v + high], width, height, Math.min(MARGIN, width / 8));
    this.fittedScale = scale;
    this.origin = { scale, left, top };
    this.update();
  }

  /** Fit; and where that is done already, all or not all. */
  fitAgain() {
    this.fit(this.isFitted && !this.isWhole);
  }

  /** Show a few points alone, or what is seen and one more. */
  closeUp(points) {
    this.isFitted = false;
    this.fitBox(bounds(points));
  }

  reveal(point) {
    const { view } = this, margin = Math.min(MARGIN, view.width / 8);
    this.closeUp([point, [view.x(margin), view.y(margin)], [view.x(view.width - margin), view.y(view.height - margin)]]);
  }

  grid() {
    const { view } = this, { width, height } = view, group = this.layer("grid");
    const name = (this.unit = this.store.document.length_unit), unit = name ? ` ${name}` : "";
    const across = ticks(view.x(0), view.x(width), width / 110), up = ticks(view.y(height), view.y(0), height / 80);
    const lines = [...across.map(({ at }) => `M${px(view.X(at))} 0V${height}`), ...up.map(({ at }) => `M0 ${px(view.Y(at))}H${width}`)];
    const origin = `M${px(clamp(view.X(0), -9, width + 9))} 0V${height}M0 ${px(clamp(view.Y(0), -9, height + 9))}H${width}`;
    group.replaceChildren(
      s("path", { class: "bs-grid-line", d: lines.join("") }),
      s("path", { class: "bs-grid-axis", d: origin }),
      ...across.filter(({ at }) => view.X(at) > 46 && view.X(at) < width - (unit ? 54 : 30)).map(({ at, text }) => s("text", { x: px(view.X(at)), y: height - 6, "text-anchor": "middle" }, text)),
      ...up.filter(({ at }) => view.Y(at) > 30 && view.Y(at) < height - 24).map(({ at, text }) => s("text", { x: 6, y: px(view.Y(at) - 4) }, text)),
      s("text", { x: 6, y: 14 }, `y${unit}`),
      s("text", { x: width - 6, y: height - 6, "text-anchor": "end" }, `x${unit}`),
    );
  }

  /** The finest number that a pixel tells, a power of ten. */
  get grain() {
    return 10 ** Math.floor(Math.log10(0.35 / this.view.scale));
  }

  /** A length as a hand sets it: to a fraction of a pixel. */
  rounded(value) {
    const { grain } = this, digits = clamp(-Math.round(Math.log10(grain)), 0, 12);
    return Number((Math.round(value / grain) * grain).toFixed(digits)) + 0;
  }

  /** A step of the arrow keys: a power of ten, about a hundredth of what the poses span. */
  get step() {
    const [x, y, u, v] = bounds(this.store.document.poses.map((pose) => [pose.x ?? 0, pose.y ?? 0]));
    const span = Math.hypot(u - x, v - y);
    return Number.isFinite(span) && span > 0 ? 10 ** Math.floor(Math.log10(span / 50)) : 1;
  }

  // Gestures

  /** The point of an event: in F, and in pixels of the picture. */
  at(event) {
    if (!this.box) {
      this.box = this.svg.getBoundingClientRect(); // once a picture, or a drag: it costs a layout where something was drawn since
      if (!this.dragged) requestAnimationFrame(() => this.dragged || (this.box = null));
    }
    const { left, top } = this.box, X = event.clientX - left, Y = event.clientY - top;
    return { X, Y, x: this.view.x(X), y: this.view.y(Y) };
  }

  /** Drag an element: start(point, event) may return false; move(point, event); end(point); cancel() at Escape.
   *
   * A press that does not move is a click: click(event), and nothing is dragged.
   * @param {any} element @param {Record<string, any>} hand
   */
  drag(element, { start = () => true, move, end = () => {}, cancel = () => {}, click = () => {} }) {
    element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || this.tool || this.dragged) return;
      event.preventDefault();
      event.stopPropagation();
      this.pressed = event; // the focus tells a selection, and Shift adds to it
      element.focus?.({ preventScroll: true });
      this.pressed = null;
      const from = this.at(event), ended = new AbortController(), { signal } = ended;
      let begun = false;
      /** @param {() => void} finish */
      const stop = (finish) => {
        ended.abort();
        this.dragged = this.box = null;
        this.svg.classList.remove("bs-grasped");
        if (this.svg.hasPointerCapture?.(event.pointerId)) this.svg.releasePointerCapture(event.pointerId);
        finish();
        this.emit("dropped");
      };
      this.dragged = { cancel: () => stop(() => begun && cancel()) };
      this.capture(event);
      const on = (name, fn) => this.svg.addEventListener(name, (each) => each.pointerId === event.pointerId && fn(each), { signal });
      let last = from, then = event.timeStamp;
      const go = (each) => {
        const point = this.at(each);
        if (point.X === last.X && point.Y === last.Y) return;
        last = point;
        then = each.timeStamp;
        if (!begun) {
          if (Math.hypot(point.X - from.X, point.Y - from.Y) < CLICK) return;
          begun = start(from, event) !== false;
          if (!begun) return stop(() => {});
          this.svg.classList.add("bs-grasped");
        }
        move(point, each);
      };
      on("pointermove", go);
      on("pointerrawupdate", (each) => each.timeStamp - then >= RAW && go(each)); // pointermove waits for the next picture
      on("pointerup", (each) => stop(() => (begun ? end(this.at(each)) : click(event))));
      on("pointercancel", () => stop(() => begun && cancel()));
    });
  }

  /** Draw with a tool, or with none: { name, click(point), hover(point), drag(point, held), release(point, held), key(event), end() }. */
  use(tool) {
    const before = this.tool;
    this.tool = tool ?? null;
    before?.end?.();
    this.svg.classList.toggle("bs-drawing", Boolean(tool));
    this.emit("tool", this.tool);
    if (tool) this.svg.focus({ preventScroll: true });
  }

  listen() {
    const { svg } = this;
    svg.addEventListener("wheel", (event) => {
      if (this.zoomKey && !event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      const { X, Y } = this.at(event), unit = event.deltaMode === 1 ? 16 : 1;
      this.zoom(ZOOM ** (-event.deltaY * unit * (event.ctrlKey && !this.zoomKey ? 4 : 1)), X, Y);
    }, { passive: false });
    svg.addEventListener("pointerdown", (event) => this.press(event));
    svg.addEventListener("pointermove", (event) => this.moved(event));
    for (const name of ["pointerup", "pointercancel"]) svg.addEventListener(name, (event) => this.released(event));
    svg.addEventListener("keydown", (event) => this.key(event));
  }

  /** Hear of a pointer wherever it goes. */
  capture({ pointerId }) {
    try {
      this.svg.setPointerCapture(pointerId);
    } catch {
      // it is gone already, and nothing else will come of it
    }
  }

  press(event) {
    if (event.button !== 0 && event.button !== 1) return;
    const { X, Y } = this.at(event);
    this.pointers.set(event.pointerId, { X, Y, from: { X, Y }, button: event.button, isMarquee: event.shiftKey && !this.tool });
    if (this.pointers.size > 1) for (const each of this.pointers.values()) each.panned = true;
    this.capture(event);
  }

  moved(event) {
    const point = this.at(event), held = this.pointers.get(event.pointerId);
    if (!held) {
      if (!this.dragged) this.tool?.hover?.(point, event);
      return;
    }
    const before = { X: held.X, Y: held.Y };
    Object.assign(held, { X: point.X, Y: point.Y });
    if (this.pointers.size === 2) {
      const [one, other] = this.pointers.values(), still = held === one ? other : one;
      const [now, then] = [point, before].map(({ X, Y }) => Math.hypot(X - still.X, Y - still.Y));
      if (then > 0) this.zoom(now / then, (point.X + still.X) / 2, (point.Y + still.Y) / 2);
      return;
    }
    held.panned ||= Math.hypot(point.X - held.from.X, point.Y - held.from.Y) > CLICK;
    if (!held.panned) return;
    if (held.isMarquee) return void this.stretch(held);
    if (this.tool?.drag?.(point, held, event)) return;
    this.svg.classList.add("bs-grasped");
    this.pan(point.X - before.X, point.Y - before.Y);
  }

  released(event) {
    const held = this.pointers.get(event.pointerId);
    if (!held) return;
    this.pointers.delete(event.pointerId);
    this.svg.classList.remove("bs-grasped");
    const point = this.at(event);
    if (event.type === "pointercancel") this.tool?.hover?.(null);
    else if (held.panned && held.isMarquee) this.caught(held);
    else if (held.panned) this.tool?.release?.(point, held);
    else if (held.button === 0) this.tool ? this.tool.click(point, event) : this.emit("click", point, event);
  }

  /** A box that a hand draws with Shift. */
  stretch({ X, Y, from }) {
    for (const [key, value] of Object.entries({ x: Math.min(X, from.X), y: Math.min(Y, from.Y), width: Math.abs(X - from.X), height: Math.abs(Y - from.Y) })) put(this.marquee, key, value);
    this.layer("tool").append(this.marquee);
  }

  caught({ X, Y, from }) {
    const { view } = this;
    this.marquee.remove();
    this.emit("marquee", bounds([[view.x(X), view.y(Y)], [view.x(from.X), view.y(from.Y)]]));
  }

  key(event) {
    if (event.target !== this.svg || event.ctrlKey || event.metaKey || this.emit("key", event) || event.altKey) return;
    const by = event.shiftKey ? 160 : 40, { width, height } = this.size;
    const steps = { ArrowLeft: [by, 0], ArrowRight: [-by, 0], ArrowUp: [0, by], ArrowDown: [0, -by] };
    if (steps[event.key]) this.pan(...steps[event.key]);
    else if (event.key === "+" || event.key === "=") this.zoom(1.25, width / 2, height / 2);
    else if (event.key === "-") this.zoom(0.8, width / 2, height / 2);
    else if (event.key === "0") this.fitAgain();
    else if (event.key === "z") this.emit("closer");
    else return;
    event.preventDefault();
  }
}

/** Elements of a layer that stay the same from one drawing to the next, by their keys, so that focus and gestures survive.
 *
 * make(key, item) is called once for a key; show(element, item) at each drawing.
 */
export class Kept {
  constructor(group, make, show) {
    this.group = group;
    this.make = make;
    this.show = show;
    this.elements = new Map();
  }

  draw(items) {
    const kept = new Map();
    for (const [key, item] of items) {
      const element = this.elements.get(key) ?? this.make(key, item);
      kept.set(key, element);
      this.show(element, item);
    }
    for (const [key, element] of this.elements) if (!kept.has(key)) element.remove();
    let before = null;
    for (const element of kept.values()) { // moved only where the order is another, for moving takes the focus away
      const next = before ? before.nextSibling : this.group.firstChild;
      if (element !== next || element.parentNode !== this.group) this.group.insertBefore(element, next);
      before = element;
    }
    this.elements = kept;
  }
}
