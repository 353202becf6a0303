// The coupler curve of any point picked on the body: points stay on the body and can be taken hold of.

import { h, put, s } from "../widget/dom.mjs";
import { transform } from "../widget/drawing.mjs";
import { act, back } from "../widget/kinematics.mjs";
import { clamp, fixed } from "../widget/numbers.mjs";
import { smoothPath } from "../widget/smooth_path.mjs";
import { decimalsOf } from "../widget/tables.mjs";
import { framesOf } from "./live_linkage.mjs";

const MOST = 8; // points at once
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** The curve of a point of M along a way: points of F.
 * @param {object} way @param {number[]} point */
export const curveOf = (way, point) => framesOf(way).map((place) => act(place, point));

export class CouplerCurves {
  constructor(answers, playing, scene) {
    this.answers = answers;
    this.playing = playing;
    this.scene = scene;
    this.points = [];
    this.group = s("g", { class: "bs-coupler-curves" });
    this.handles = s("g", { class: "bs-coupler-points" });
    scene.layer("paths").append(this.group);
    scene.layer("pivots").append(this.handles);
    this.button = h("button", { type: "button", class: "bs-small", "aria-pressed": "false", "data-tool": "coupler-point", onclick: () => this.pick() }, "Pick a point on the body");
    this.list = h("ul", { class: "bs-points" });
    this.readout = h("output", { class: "bs-quiet" });
    this.element = h("div", { class: "bs-tool" }, this.button, " ", this.readout, this.list);
    this.tool = {
      name: "coupler-point",
      hint: "Click on the body: the curve of that point is drawn. Escape ends.",
      click: ({ x, y }) => this.add([x, y]),
      key: (event) => {
        if (event.key !== "Escape") return false;
        scene.use?.(null);
        return true;
      },
      end: () => put(this.button, "aria-pressed", "false"),
    };
    playing.on("shape", () => this.shape());
    playing.on("place", ({ place }) => this.show(place));
    scene.on("view", () => this.shape());
    this.tell();
  }

  pick() {
    const on = this.scene.tool !== this.tool;
    this.scene.use?.(on ? this.tool : null);
    put(this.button, "aria-pressed", String(on));
  }

  /** A point of F where the body is now, or a point of M. */
  add(at, inBody = false) {
    const place = this.playing.here?.place;
    if ((!place && !inBody) || this.points.length >= MOST) return;
    const point = { at: inBody ? at : this.rounded(back(place, at)), path: s("path", { class: "bm-curve bs-coupler-curve" }) };
    point.handle = s(
      "g", { class: "bs-coupler-point", tabindex: 0, role: "button", "data-point": this.points.length + 1 },
      s("circle", { class: "bs-hold", r: 13 }), s("circle", { class: "bs-coupler-dot", r: 4.5 }),
    );
    this.drag(point);
    this.points.push(point);
    this.group.append(point.path);
    this.handles.append(point.handle);
    this.number();
    this.shape();
  }

  remove(point) {
    this.points = this.points.filter((each) => each !== point);
    point.path.remove();
    point.handle.remove();
    this.number();
    this.shape();
  }

  number() {
    this.points.forEach((point, k) => (point.handle.dataset.point = k + 1));
  }

  rounded(point) {
    return point.map((value) => Number(value.toFixed(clamp(decimalsOf(this.answers.data), 0, 12))));
  }

  drag(point) {
    let before;
    this.scene.drag?.(point.handle, {
      start: () => {
        before = point.at;
        this.playing.player.play(false);
      },
      move: ({ x, y }) => this.put(point, back(this.playing.here.place, [x, y])),
      cancel: () => this.put(point, before),
    });
    point.handle.addEventListener("keydown", (event) => {
      const arrow = ARROWS[event.key];
      if (event.ctrlKey || event.metaKey) return;
      if (arrow) {
        const step = (this.scene.step ?? this.answers.data.scene / 100) * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
        this.put(point, point.at.map((value, k) => value + step * arrow[k]));
      } else if (event.key === "Delete" || event.key === "Backspace") {
        this.remove(point);
      } else {
        return;
      }
      event.preventDefault();
    });
  }

  put(point, at) {
    point.at = this.rounded(at);
    this.shape();
  }

  shape() {
    const { path, linkage } = this.playing, { view } = this.scene, there = path && !linkage.gone;
    for (const point of this.points) {
      const list = there ? curveOf(path, point.at) : [];
      put(point.path, "d", smoothPath(list.map(([x]) => view.X(x)), list.map(([, y]) => view.Y(y)), path?.round));
      put(point.handle, "visibility", there ? "visible" : "hidden");
    }
    if (there && this.playing.here) this.show(this.playing.here.place);
    this.tell();
  }

  show(place) {
    const { view } = this.scene;
    for (const point of this.points) {
      const [x, y] = act(place, point.at);
      put(point.handle, "transform", transform(view.X(x), view.Y(y), 0));
    }
  }

  /** The points in words, each with a button that takes it away. */
  tell() {
    const digits = decimalsOf(this.answers.data), key = `${this.points.map(({ at }) => at.join()).join(" ")} ${digits}`;
    if (key === this.told) return;
    this.told = key;
    this.readout.textContent = this.points.length ? "" : "Its curve is drawn, and goes along with every change.";
    this.list.replaceChildren(
      ...this.points.map((point, k) => {
        const name = `Point ${k + 1} at (${point.at.map((value) => fixed(value, digits)).join(", ")}) of the body`;
        put(point.handle, "aria-label", `${name}. Drag it, or use the arrow keys; Delete removes it.`);
        return h("li", {}, name, " ", h("button", { type: "button", class: "bs-small", "aria-label": `Remove point ${k + 1}`, onclick: () => this.remove(point) }, "Remove"));
      }),
    );
  }
}

