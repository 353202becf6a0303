// A picture behind the plane, set to scale by two points and a length; or the frames of a film, on which poses are clicked.
//
// A picture is kept with the task, as a JPEG of bounded size whatever it was: an SVG is only ever shown by <img>, where no
// script of it runs.  The curves of a DXF are drawn where they are, in the unit of the task.  A film stays a file of this machine, and is not kept.  Both lie in the plane by a similarity that
// takes their pixels, counted to the right and up from their lower left corner, to F.

import { give, h, put, s } from "../widget/dom.mjs";
import { degrees, px } from "../widget/numbers.mjs";
import { addPose } from "./document.mjs";
import { base64Of } from "./files.mjs";
import { NumberField, button, labelled } from "./fields.mjs";
import { about, composed, moved } from "./task_transform.mjs";

const LONGEST_SIDE = 2000; // pixels of a picture that is kept
const MOST = 1_000_000; // characters of it
const FILL = 0.9; // of the plane that a picture covers when it comes
const USUAL_OPACITY = 0.6;
const tenths = (angle) => Number(angle.toFixed(1)) + 0;

/** An element that has loaded, of the bytes of a file. */
function loaded(element, event, address) {
  return new Promise((done, fail) => {
    element.addEventListener(event, () => done(element), { once: true });
    element.addEventListener("error", () => fail(new Error("the browser cannot show it")), { once: true });
    element.src = address;
  });
}

/** What `paint(pen, canvas, scale)` draws of something so wide and high, as a JPEG in a data URL, not greater than is kept.
 * @param {(pen: CanvasRenderingContext2D, canvas: HTMLCanvasElement, scale: number) => void} paint */
function asJpeg(wide, high, largest, paint) {
  const canvas = document.createElement("canvas"), longest = Math.max(wide, high);
  for (let size = largest; ; size *= 0.7) {
    Object.assign(canvas, { width: Math.max(1, Math.round((wide * size) / longest)), height: Math.max(1, Math.round((high * size) / longest)) });
    const { width, height } = canvas, pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    pen.fillStyle = "white";
    pen.fillRect(0, 0, width, height);
    paint(pen, canvas, size / longest);
    const data = canvas.toDataURL("image/jpeg", 0.85);
    if (data.length <= MOST) return { data, width, height };
  }
}

/** A picture that the browser shows. */
async function ofImage(file) {
  const address = URL.createObjectURL(file);
  try {
    const image = await loaded(new Image(), "load", address), longest = Math.max(image.naturalWidth, image.naturalHeight) || LONGEST_SIDE;
    const largest = file.type === "image/svg+xml" ? LONGEST_SIDE : Math.min(LONGEST_SIDE, longest);
    return asJpeg(image.naturalWidth || longest, image.naturalHeight || longest, largest, (pen, { width, height }) => pen.drawImage(image, 0, 0, width, height));
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** The curves of a drawing, and their place. */
function ofCurves(curves) {
  const [left, bottom, right, top] = curves.flat().reduce(([l, b, r, t], [x, y]) => [Math.min(l, x), Math.min(b, y), Math.max(r, x), Math.max(t, y)], [Infinity, Infinity, -Infinity, -Infinity]);
  const edge = 0.01 * Math.max(right - left, top - bottom), wide = right - left + 2 * edge, high = top - bottom + 2 * edge;
  if (!(edge > 0)) throw new Error("it has no lines");
  const made = asJpeg(wide, high, LONGEST_SIDE, (pen, { height }, scale) => {
    pen.lineWidth = 2;
    for (const curve of curves) for (const [k, [x, y]] of curve.entries()) pen[k ? "lineTo" : "moveTo"]((x - left + edge) * scale, height - (y - bottom + edge) * scale);
    pen.stroke();
  });
  return { ...made, place: { turn: 0, scale: Math.max(wide, high) / Math.max(made.width, made.height), mirror: false, x: left - edge, y: bottom - edge } };
}

/** The address of what a data URL holds. */
function addressOf(data) {
  const bytes = Uint8Array.from(atob(data.slice(data.indexOf(",") + 1)), (each) => each.charCodeAt(0));
  return URL.createObjectURL(new Blob([bytes], { type: "image/jpeg" }));
}

export class Backdrop {
  /** @type {any} */ film = null;

  constructor(store, scene, banners) {
    this.store = store;
    this.scene = scene;
    this.banners = banners;
    this.image = h("img", { class: "bs-backdrop", alt: "", draggable: "false", hidden: true });
    scene.element.prepend(this.image);
    const chooser = h("input", { type: "file", hidden: true, accept: "image/png,image/jpeg,image/svg+xml,video/*,.dxf", "data-file": "picture", onchange: () => this.take(chooser.files[0]).finally(() => (chooser.value = "")) });
    const tool = (text, data, make) => {
      const made = button(text, () => scene.use(scene.tool?.name === data ? null : make()), { "data-do": data, "aria-pressed": "false" });
      scene.on("tool", () => put(made, "aria-pressed", scene.tool?.name === data));
      return made;
    };
    this.turned = new NumberField({ label: "angle of the picture", commit: (angle) => this.turn(angle), options: () => ({ kind: "angle" }), attributes: { "data-key": "picture-angle" } });
    this.faded = h("input", { type: "range", min: 0.1, max: 1, step: 0.05, "aria-label": "How strong the picture is", "data-key": "picture-opacity", oninput: () => this.change({ opacity: Number(this.faded.value) }, "fade") });
    const field = (label, value, name, bounds) => {
      const made = new NumberField({ label, commit: () => {}, options: () => bounds, attributes: { "data-key": name } });
      made.show(value);
      return made;
    };
    this.rate = field("frames a second", 25, "film-rate", { above: 0 });
    this.stride = field("frames from pose to pose", 5, "film-stride", { whole: true, least: 1 });
    this.time = h("span", { class: "bs-hint" });
    this.ofFilm = h("div", {},
      h("div", { class: "bs-row" }, button("‹ frame", () => this.step(-1), { "data-do": "frame-back" }), button("frame ›", () => this.step(1), { "data-do": "frame-on" }), this.time),
      h("div", { class: "bs-row" }, labelled("frames a second", this.rate.element), labelled("every", this.stride.element, "frames")),
      tool("Poses from the film", "film-poses", () => new FilmTool(this)));
    this.ofPicture = h("div", {},
      h("div", { class: "bs-row" }, tool("Set its scale", "picture-scale", () => new ScaleTool(this)), tool("Move it", "picture-move", () => new MoveTool(this)), button("Take it away", () => this.remove(), { "data-do": "picture-remove" })),
      h("div", { class: "bs-row" }, labelled("turned by °", this.turned.element), labelled("strength", this.faded)), this.ofFilm);
    this.element = h("div", {},
      h("p", { class: "bs-hint" }, "A photo or a drawing behind the plane, on which poses are clicked; a DXF keeps its scale. It is saved with the task. A film's frames as poses: two points of the body in each. Films stay on this machine and are not kept."),
      button("A picture or a film…", () => chooser.click(), { "data-do": "picture" }), chooser, this.ofPicture);
    store.on("picture", () => this.load());
    scene.on("view", () => this.draw());
    this.load();
  }

  /** What lies behind the plane: { place, width, height, opacity }, or null. */
  get now() {
    return this.film ?? this.store.picture;
  }

  /** @param {any} changes @param {unknown} gesture */
  change(changes, gesture = null) {
    if (!this.film) return this.store.setPicture(changes, gesture);
    Object.assign(this.film, changes);
    return this.draw();
  }

  async take(file) {
    try {
      if (file.type.startsWith("video/")) return await this.open(file);
      if (file.type === "application/pdf") throw new Error("save its page as PNG, SVG or DXF, and open that");
      const { data, width, height, place } = await (/\.dxf$/i.test(file.name) ? this.drawing(file) : ofImage(file)), id = crypto.randomUUID();
      this.close();
      this.store.images.set(id, data);
      return this.store.setPicture({ id, file: file.name, width, height, opacity: USUAL_OPACITY, place: place ?? this.middle(width, height) });
    } catch (error) {
      return this.banners.say("refused", `${file.name} is not shown: ${/** @type {Error} */ (error).message}.`);
    }
  }

  /** The curves of a DXF, at their own coordinates. */
  async drawing(file) {
    const body = { name: file.name, base64: await base64Of(file), length_unit: this.store.document.length_unit };
    const { curves } = await (await this.store.connection.post("/drawing", body)).json(), made = ofCurves(curves);
    this.banners.say("note", `${file.name} lies at its own coordinates. Where it is out of sight, zoom out, or take Move it.`);
    return made;
  }

  /** A film, at its first frame. */
  async open(file) {
    const address = URL.createObjectURL(file), element = h("video", { class: "bs-backdrop", muted: true, playsinline: "", preload: "auto" });
    await loaded(element, "loadeddata", address);
    this.close();
    this.scene.element.prepend(element);
    const { videoWidth: width, videoHeight: height } = element;
    this.film = { element, address, width, height, opacity: 1, place: this.middle(width, height) };
    element.addEventListener("seeked", () => this.tell());
    this.draw();
  }

  /** Put away the film. */
  close() {
    if (!this.film) return;
    this.film.element.remove();
    URL.revokeObjectURL(this.film.address);
    this.film = null;
  }

  remove() {
    const wasFilm = Boolean(this.film);
    this.scene.use(null);
    this.close();
    if (wasFilm) this.draw();
    else this.store.setPicture(null);
  }

  /** Some frames on; the element says when it is there. */
  step(frames) {
    const { element } = this.film;
    if (!this.rate.fault.hidden) return;
    element.currentTime = Math.min(Math.max(0, element.currentTime + frames / this.rate.value), element.duration || Infinity);
  }

  tell() {
    this.time.textContent = `${this.film.element.currentTime.toFixed(3)} s`;
  }

  /** The place of a picture that comes: in the middle of what is seen. */
  middle(width, height) {
    const { view } = this.scene, scale = (FILL * Math.min(view.width / width, view.height / height)) / view.scale;
    return { turn: 0, scale, mirror: false, x: view.x(view.width / 2) - (scale * width) / 2, y: view.y(view.height / 2) - (scale * height) / 2 };
  }

  turn(angle) {
    const { place, width, height } = this.now;
    this.change({ place: composed(about(moved(place, [width / 2, height / 2]), { turn: angle - place.turn }), place) });
  }

  load() {
    const { picture, images } = this.store, data = images.get(picture?.id);
    if (picture?.id !== this.shown) {
      URL.revokeObjectURL(this.image.src);
      if (data) this.image.src = addressOf(data);
      this.shown = picture?.id;
    }
    give(this.image, "hidden", !data);
    this.draw();
  }

  draw() {
    const { now, film, scene: { view } } = this;
    for (const [part, isThere] of [[this.ofPicture, now], [this.ofFilm, film]]) give(part, "hidden", !isThere);
    if (!now) return;
    const { element } = film ?? { element: this.image }, { place, width, height, opacity } = now;
    if (film) give(this.image, "hidden", true);
    const at = (u, v) => (([x, y]) => [view.X(x), view.Y(y)])(moved(place, [u, v])), [a, b] = at(0, height), [c, d] = at(width, height), [e, f] = at(0, 0);
    Object.assign(element.style, {
      width: `${width}px`, height: `${height}px`, opacity: String(opacity),
      transform: `matrix(${(c - a) / width}, ${(d - b) / width}, ${(e - a) / height}, ${(f - b) / height}, ${a}, ${b})`,
    });
    this.turned.show(tenths(place.turn));
    this.faded.value = String(opacity);
  }
}

/** What tools of a picture share: a line between two clicks, and Escape. */
class PictureTool {
  /** @type {any} */ first = null;

  constructor(backdrop) {
    this.backdrop = backdrop;
    this.scene = backdrop.scene;
    this.line = s("path", { class: "bs-draft" });
    this.scene.layer("tool").append(this.line);
  }

  hover(point) {
    const { view } = this.scene;
    if (this.first && point) put(this.line, "d", `M${px(view.X(this.first.x))} ${px(view.Y(this.first.y))}L${px(point.X)} ${px(point.Y)}`);
  }

  key(event) {
    if (event.key !== "Escape") return false;
    this.scene.use(null);
    return true;
  }

  end() {
    this.line.remove();
  }
}

/** Two clicks and the length between them set the scale; the first point stays. */
class ScaleTool extends PictureTool {
  name = "picture-scale";
  hint = "Click two points of the picture whose distance you know. Escape gives up.";

  click({ x, y }) {
    const { backdrop, scene, first } = this;
    if (!first) {
      this.first = { x, y };
      return;
    }
    let length = Math.hypot(x - first.x, y - first.y);
    if (!length) return;
    scene.use(null);
    scene.field.open({
      name: "what was clicked", kind: backdrop.store.selection?.kind, at: () => [x, y], fields: [["length", "length", "length"]], options: { above: 0 }, values: () => ({ length: scene.rounded(length) }),
      set: ({ length: wanted }) => {
        backdrop.change({ place: composed(about([first.x, first.y], { scale: wanted / length }), backdrop.now.place) });
        length = wanted;
      },
    });
    const [{ input }] = scene.field.fields;
    input.focus();
    input.select();
  }
}

class MoveTool extends PictureTool {
  name = "picture-move";
  hint = "Drag the picture. Escape ends.";
  gesture = Symbol("move the picture");

  click() {}

  drag({ x, y }, held) {
    this.first ??= { ...this.backdrop.now.place, from: held.from };
    const { from, ...place } = this.first, { view } = this.scene;
    this.backdrop.change({ place: { ...place, x: place.x + x - view.x(from.X), y: place.y + y - view.y(from.Y) } }, this.gesture);
    return true;
  }

  hover() {}

  release() {
    this.first = null;
    this.gesture = Symbol("move the picture");
  }
}

/** Two points of the body in each frame: a pose, and on to the next frame. */
class FilmTool extends PictureTool {
  name = "film-poses";
  hint = "Click a point of the body, then a second one: they make a pose, and the film goes on. The same two points in each frame. Escape ends.";

  click({ x, y }) {
    const { first, scene, backdrop: { store, stride } } = this;
    if (!first) {
      this.first = { x, y };
      return;
    }
    const poses = store.document.poses, last = poses.at(-1)?.angle ?? 0, angle = degrees(Math.atan2(y - first.y, x - first.x));
    store.edit((document) => addPose(document, { x: scene.rounded(first.x), y: scene.rounded(first.y), angle: tenths(angle + 360 * Math.round((last - angle) / 360)) }));
    this.first = null;
    put(this.line, "d", "");
    this.backdrop.step(stride.value ?? 1);
  }
}
