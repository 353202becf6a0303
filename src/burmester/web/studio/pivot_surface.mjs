// Pivots to take hold of: put one anywhere, and see the best dyad there and what it costs; two make a linkage.
//
// Of four poses a pivot slides along a Burmester curve, of three it goes anywhere in F or in M.

import { give, h, put, s, say } from "../widget/dom.mjs";
import { act, back } from "../widget/kinematics.mjs";
import { figure, fixed, px } from "../widget/numbers.mjs";
import { decimalsOf } from "../widget/tables.mjs";
import { PLACED } from "./answers.mjs";
import { isPoint } from "./document.mjs";
import { FamilyCurves } from "./family_curves.mjs";
import { PivotMapPanel } from "./pivot_map_panel.mjs";

const KEYS = { F: "fixed_pivot", M: "moving_pivot" };
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class PivotSurface {
  /** @type {any} */ held;
  judges = false; // whether pivots stay where they are, and the linkage is judged

  constructor(store, answers, playing, scene) {
    this.store = store;
    this.answers = answers;
    this.playing = playing;
    this.scene = scene;
    this.pivots = null;
    this.held = null;
    this.handles = s("g", { class: "bs-pivots" });
    scene.layer("pivots").append(this.handles);
    this.parts = [0, 1].map((k) => ["F", "M"].map((plane) => this.handle(k, plane)));
    this.story = h("p", { class: "bm-story" });
    this.readout = h("output", { class: "bs-placed-readout", "aria-live": "polite" });
    this.letGo = h("button", { type: "button", class: "bs-small", hidden: true, onclick: () => this.release() }, "Let go of the pivots");
    this.curves = new FamilyCurves(store, answers, playing, scene);
    this.map = new PivotMapPanel(answers, playing, this);
    this.element = h("div", { class: "bs-surface" }, this.story, h("div", { class: "bs-tool" }, this.curves.label), this.curves.legend, this.map.element, this.readout, h("div", { class: "bs-tool" }, this.letGo)); // what comes and goes stands below
    answers.on("answers", () => this.renew());
    answers.on("poses", () => {
      this.explain();
      if (this.pivots) store.place(this.pivots); // the best dyads with the same pivots are others now
    });
    answers.on("placed", () => this.tell());
    playing.on("shape", () => this.show());
    playing.on("place", () => this.move());
    scene.on("view", () => this.show());
    store.on("state document", () => this.element.classList.toggle("bs-stale", answers.isOld));
    this.renew();
  }

  /** The dyads whose pivots can be taken: those put down by hand, or those of the linkage. */
  get dyads() {
    if (this.store.document.poses.some(isPoint) || this.answers.shown?.drawn) return []; // the best dyad of a pivot is one for angles, and no link of a six-bar
    const placed = this.store.placed?.dyads;
    if (this.pivots && placed?.length) return placed;
    return this.answers.shown?.led ?? [];
  }

  /** A pivot of dyad k in a plane: { plane, at, id }, or null where it has none. */
  pivot(k, plane) {
    const dyad = this.dyads[k];
    if (!dyad) return null;
    const wanted = this.pivots?.[k];
    if (wanted?.fixed_pivot) return { plane, at: wanted[KEYS[plane]], id: dyad.id };
    const at = wanted?.plane === plane ? wanted.at : plane === "F" ? dyad.fixed_pivot : dyad.moving_pivot;
    return at ? { plane, at, id: dyad.id } : null;
  }

  // Handles in the scene

  handle(k, plane) {
    const name = plane === "F" ? "fixed" : "moving";
    const element = s("g", { class: `bs-pivot bs-pivot-${name} bm-side${k}`, "data-plane": plane, tabindex: 0, role: "button" }, s("circle", { class: "bs-hold", r: 13 }), s("circle", { class: "bs-pivot-ring", r: 8 }));
    let before;
    this.scene.drag?.(element, {
      start: () => {
        before = this.pivots;
        this.playing.player.play(false);
        this.place = this.playing.here?.place ?? null;
        return this.take(k, plane);
      },
      move: ({ x, y }) => this.put(plane === "F" ? [x, y] : back(this.place, [x, y])),
      end: () => this.drop(),
      cancel: () => {
        this.drop();
        if (before) this.ask(before);
        else this.release();
      },
    });
    element.addEventListener("keydown", (event) => this.key(event, k, plane));
    this.handles.append(element);
    return element;
  }

  key(event, k, plane) {
    if (event.ctrlKey || event.metaKey) return;
    const arrow = ARROWS[event.key];
    if (event.key === "Escape" && this.pivots) {
      this.release();
    } else if (arrow) {
      const { at } = this.pivot(k, plane), step = (this.scene.step ?? this.answers.data.scene / 100) * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
      if (!this.take(k, plane)) return;
      this.put(at.map((value, axis) => value + step * arrow[axis]), step);
      this.drop();
    } else {
      return;
    }
    event.preventDefault();
  }

  /** Take hold of a pivot; the other dyad keeps one of its own. */
  take(k, plane) {
    const start = this.pivot(k, plane);
    if (!start || (plane === "M" && !this.playing.here)) return false;
    if (this.judges) {
      if (!this.pivots?.[0]?.fixed_pivot) this.pivots = this.dyads.map(({ fixed_pivot, moving_pivot }) => ({ fixed_pivot, moving_pivot }));
      this.held = { k, plane };
      this.keepHeight();
      return this.pivots.every((each) => each.fixed_pivot && each.moving_pivot);
    }
    const other = this.pivots?.[1 - k] ?? this.pivot(1 - k, "F") ?? this.pivot(1 - k, "M");
    const next = [];
    next[k] = { plane, at: start.at };
    if (other) next[1 - k] = { plane: other.plane, at: other.at };
    this.pivots = next;
    this.held = { k, plane };
    this.keepHeight();
    return true;
  }

  /** What stands above does not shrink, so that nothing moves away under the hand. */
  keepHeight() {
    const { element } = this.playing;
    element.style.minHeight = `${element.offsetHeight}px`;
  }

  /** The held pivot goes to a point of its plane, or to the nearest one of its curve. */
  put(point, step = 0) {
    const { k, plane } = this.held, digits = decimalsOf(this.answers.data);
    let at = this.judges ? null : this.curves.onto(plane, point);
    if (!at) at = point.map((value) => (step ? Number(value.toFixed(digits)) : this.scene.rounded(value)));
    const { fixed_pivot, moving_pivot } = this.pivots[k];
    this.ask(this.pivots.map((each, n) => (n !== k ? each : fixed_pivot ? { fixed_pivot, moving_pivot, [KEYS[plane]]: at } : { plane, at })));
  }

  drop() {
    this.held = null;
  }

  /** Judge the linkage of two links, { fixed_pivot, moving_pivot, radius } each, as they are. */
  judge(links) {
    this.judges = true;
    this.held = null;
    this.ask(links);
  }

  /** Ask for the best dyads with these pivots. */
  ask(pivots) {
    this.pivots = pivots;
    this.store.place(pivots);
    this.show();
    this.tell();
  }

  /** The pivots are no longer put down: the linkage that was chosen before is back. */
  release() {
    this.pivots = null;
    this.held = null;
    this.judges = false;
    this.playing.element.style.minHeight = "";
    this.store.place([]);
    if (this.store.chosen === PLACED) this.store.choose(this.before ?? this.answers.linkages[0]?.id ?? null);
    this.tell();
    this.show();
  }

  // Drawing

  /** Everything that the answer brings. */
  renew() {
    const { data } = this.answers;
    if (!this.pivots && this.store.chosen !== PLACED) this.before = this.store.chosen;
    this.curves.renew();
    this.map.renew();
    this.explain();
    this.show();
  }

  explain() {
    const count = this.answers.data.poses.length;
    const text = count === 4 && this.curves.family
      ? "Four poses leave a curve of dyads. Drag a pivot in the drawing: it slides along its curve."
      : count === 3
        ? "Three poses leave every pivot free. Drag a fixed pivot anywhere in F, or a moving pivot anywhere on the body."
        : count === 2
          ? "Two poses leave much open. Drag a pivot: its best dyad follows."
          : "Drag a pivot in the drawing or on the map: the best dyad there is shown with what it costs.";
    say(this.story, text);
  }

  /** Handles where the pivots are. */
  show() {
    const { view } = this.scene, place = this.playing.here?.place, there = this.answers.shown && !this.answers.shown.gone;
    this.parts.forEach((planes, k) => {
      planes.forEach((element, n) => {
        const plane = "FM"[n], pivot = there || this.pivots ? this.pivot(k, plane) : null;
        const seen = pivot && (plane === "F" || place);
        put(element, "display", seen ? "inline" : "none");
        if (!seen) return;
        put(element, "data-pivot", pivot.id);
        element.classList.toggle("bs-put", this.pivots?.[k]?.plane === plane);
        if (plane === "F") put(element, "transform", `translate(${px(view.X(pivot.at[0]))} ${px(view.Y(pivot.at[1]))})`);
      });
    });
    this.name();
    this.move();
    this.map.drawHandles();
  }

  /** What is on the body goes along with it. */
  move() {
    const { view } = this.scene, place = this.playing.here?.place;
    if (!place) return;
    this.parts.forEach(([, element], k) => {
      const pivot = element.getAttribute("display") === "none" ? null : this.pivot(k, "M");
      if (!pivot) return;
      const [x, y] = act(this.held?.k === k && this.held.plane === "M" && this.place ? this.place : place, pivot.at);
      put(element, "transform", `translate(${px(view.X(x))} ${px(view.Y(y))})`);
    });
  }

  /** Names for those who do not see them; not while a hand drags. */
  name() {
    if (this.held || this.store.state === "dragging") return;
    const digits = decimalsOf(this.answers.data);
    this.parts.forEach((planes, k) => planes.forEach((element, n) => {
      const pivot = this.pivot(k, "FM"[n]);
      if (!pivot) return;
      const text = `${n ? "Moving" : "Fixed"} pivot of ${pivot.id} at (${pivot.at.map((value) => fixed(value, digits)).join(", ")}) in ${"FM"[n]}. Drag it, or use the arrow keys; the best dyad there is shown.`;
      put(element, "aria-label", text);
    }));
  }

  /** What the pivots cost, in words. */
  tell() {
    const { store, answers } = this, { placed } = store;
    give(this.letGo, "hidden", !this.pivots);
    if (!this.pivots || !placed) {
      say(this.readout, "");
      if (!placed && this.pivots && !this.held && store.placeWanted === null) this.pivots = null;
      return;
    }
    put(this.readout, "aria-live", this.held ? "off" : "polite");
    say(this.readout, placedInWords(placed, answers.data));
    if (placed.linkage && store.chosen !== PLACED && this.pivots) {
      this.before = store.chosen;
      store.choose(PLACED);
    }
    this.show();
  }
}

/** What pivots that were put down cost: each dyad, and the linkage of both.
 * @param {object} placed @param {{ unit: string | null, scene: number }} data */
export function placedInWords(placed, data) {
  const unit = data.unit ? ` ${data.unit}` : "", digits = decimalsOf(data);
  const miss = (value) => (value === null ? "an unknown error" : value < 1e-9 * data.scene ? "nothing" : `${figure(value)}${unit}`);
  const dyads = placed.dyads.map((dyad) => `${dyad.id}: fixed pivot (${dyad.fixed_pivot.map((v) => fixed(v, digits)).join(", ")}), moving pivot (${dyad.moving_pivot.map((v) => fixed(v, digits)).join(", ")}), misses by ${miss(dyad.max_error)} at most.`);
  const { linkage } = placed;
  if (!linkage) return [...dyads, ...(placed.messages ?? []).map(({ message }) => `${message[0].toUpperCase()}${message.slice(1)}.`)].join(" ");
  const both = linkage.usable ? `usable, ${linkage.said.met}` : `not usable: ${linkage.said.reasons.join("; ")}`;
  return `${dyads.join(" ")} Together a ${linkage.type}: ${both}.`;
}
