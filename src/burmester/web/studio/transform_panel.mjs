// The whole task, or the selected poses, moved, turned, mirrored and scaled by numbers, and aligned to a pivot.

import { give, h, say } from "../widget/dom.mjs";
import { currentLinkage } from "./conditions.mjs";
import { poseName, standing } from "./document.mjs";
import { NumberField, button, choice, labelled } from "./fields.mjs";
import { about, aslant, composed, middleOfPoses, transformed, withPosesMoved } from "./task_transform.mjs";

export class TransformPanel {
  /** lengths: the options of `burmester synthesize` that are lengths. */
  constructor(store, scene, lengths) {
    this.store = store;
    this.scene = scene;
    this.lengths = lengths;
    const field = (label, kind, value, name, bounds = {}) => {
      const made = new NumberField({ label, commit: () => {}, options: () => ({ kind, unit: store.document.length_unit, ...bounds }), step: () => (kind === "length" ? scene.step : kind === "angle" ? 1 : 0.1), attributes: { "data-key": name } });
      made.show(value);
      return made;
    };
    const x = field("to the right", "length", 0, "move-x"), y = field("up", "length", 0, "move-y"), turn = field("turn by", "angle", 90, "turn-by"), scale = field("scale by", "number", 2, "scale-by", { above: 0 });
    const act = (text, by, name) => button(text, () => [x, y, turn, scale].every((each) => each.fault.hidden) && this.apply(by()), { "data-do": name });
    const still = { turn: 0, scale: 1, mirror: false };
    this.what = choice("What is moved", [["task", "the whole task"], ["poses", "the selected poses"]], () => this.draw(), { "data-key": "move-what" });
    this.point = choice("The point that stays", [], () => {}, { "data-key": "move-about" });
    this.fault = h("p", { class: "bs-fault", hidden: true, role: "alert" });
    this.element = h("div", {},
      h("p", { class: "bs-hint" }, "All conditions go along: limits, outline, surroundings, loads. Forces, masses and times stay."),
      this.what,
      h("div", { class: "bs-row" }, labelled("right", x.element), labelled("up", y.element), act("Move", () => ({ ...still, x: x.value, y: y.value }), "move-by")),
      labelled("about", this.point),
      h("div", { class: "bs-row" }, labelled("by °", turn.element), act("Turn", () => this.about({ turn: turn.value }), "turn-by")),
      h("div", { class: "bs-row" }, labelled("by", scale.element), act("Scale", () => this.about({ scale: scale.value }), "scale-by")),
      h("div", { class: "bs-row" }, act("Mirror left to right", () => this.about({ turn: 180, mirror: true }), "mirror-x"), act("Mirror upside down", () => this.about({ mirror: true }), "mirror-y")),
      h("div", { class: "bs-row" }, act("Bring that point to 0, 0", () => ({ ...still, x: -this.at[0], y: -this.at[1] }), "to-origin")),
      this.fault);
    store.on("document selection solved chosen", () => this.draw());
    this.draw();
  }

  about(by) {
    return about(this.at, by);
  }

  /** Points that may stay, by their names. */
  get points() {
    const { store } = this, { document, selectedPoses } = this.store;
    return [
      ["the origin of the ground", [0, 0]], ["the middle of the poses", middleOfPoses(document)],
      ...selectedPoses.slice(0, 1).map((k) => [`pose ${poseName(document, k)}`, Object.values(standing(document, k)).slice(0, 2)]),
      ...(currentLinkage(store)?.led ?? []).filter((dyad) => dyad.fixed_pivot).map((dyad) => [`the fixed pivot of ${dyad.id}`, dyad.fixed_pivot]),
    ];
  }

  get at() {
    const { points } = this;
    return (points.find(([name]) => name === this.point.value) ?? points[0])[1];
  }

  draw() {
    if (this.element.isConnected && !this.element.checkVisibility()) return;
    const names = this.points.map(([name]) => name), before = this.point.value;
    if (names.join() !== [...this.point.options].map((each) => each.value).join()) this.point.replaceChildren(...names.map((name) => h("option", { value: name }, name)));
    if (names.includes(before)) this.point.value = before;
    give(this.what.options[1], "disabled", !this.store.selectedPoses.length);
    if (!this.store.selectedPoses.length) this.what.value = "task";
  }

  apply(by) {
    const { store } = this, { document, selectedPoses, options } = store, indices = this.what.value === "poses" ? selectedPoses : [...document.poses.keys()];
    const fault = aslant({ ...document, poses: document.poses.filter((_, k) => indices.includes(k)) }, by);
    give(this.fault, "hidden", !fault);
    say(this.fault, fault);
    if (fault) return;
    if (this.what.value === "poses") return void store.edit((now) => withPosesMoved(now, indices, by) ?? now);
    const hasMoreDigits = by.scale !== 1 || by.turn % 90 !== 0, sigma = document.pose_sigma ?? (hasMoreDigits ? store.solved?.pose_sigma : undefined);
    const scaled = Object.entries(options).map(([key, value]) => [key, this.lengths.includes(key) ? by.scale * value : value]);
    store.edit((now) => transformed(now, by, sigma), { options: Object.fromEntries(scaled), picture: store.picture && { ...store.picture, place: composed(by, store.picture.place) } });
    this.scene.fit();
  }
}
