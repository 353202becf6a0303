// What exports are made with, in fields: holes and plates, drawings, models, films; and how well the poses are known.

import { give, h } from "../widget/dom.mjs";
import { withKeys } from "./document.mjs";
import { NumberField, choice, labelled, tick } from "./fields.mjs";

const LENGTHS = [["hole", "holes"], ["pin", "pins"], ["width", "links are wide"], ["thickness", "plates are thick"], ["gap", "gap between plates"]];
const NUMBERS = [ // name, words, what the command takes otherwise, what the value may be
  ["pose", "drawn at pose", "1", { least: 1, whole: true }], ["density", "density, kg/m³", "2700", { above: 0 }],
  ["seconds", "film, seconds", "4", { above: 0 }], ["frames_per_second", "pictures a second", "25", { above: 0 }], ["width_px", "pixels wide", "800", { least: 1, whole: true }],
];
const AXES = ["y", "x", "z", "-x", "-y", "-z"];
const UNITS = ["mm", "cm", "m", "in", "ft"];
const SIGMA = [["position", "position", "length"], ["angle_deg", "angle", "angle"]];

const section = (name, title, ...content) => h("details", { class: "bs-section", "data-section": name }, h("summary", {}, title), ...content);

/** Options of `burmester export`; one that is left empty is not given. */
export class ExportSettings {
  /** @type {any} */ sigma;

  constructor(store, scene) {
    this.store = store;
    const set = (name) => (value) => store.setting(name, value);
    this.fields = new Map();
    const number = (name, placeholder, options) => {
      const field = new NumberField({ label: name.replace(/_/g, " "), commit: set(name), options: () => ({ optional: true, unit: store.document.length_unit, ...options }), step: () => (options.kind ? scene.step : 1), attributes: { "data-setting": name, placeholder } });
      this.fields.set(name, field);
      return field.element;
    };
    this.unit = choice("unit of what is exported", UNITS.map((unit) => [unit, unit]), (value) => set("unit")(value === "mm" ? undefined : value), { "data-setting": "unit" });
    this.unitRow = labelled("unit of the lengths", this.unit);
    this.up = choice("up", AXES.map((axis) => [axis, axis]), (value) => set("up")(value === "y" ? undefined : value), { "data-setting": "up" });
    this.dimensions = tick("drawings have dimension lines", (on) => set("dimensions")(on ? undefined : false), { "data-setting": "dimensions" });
    this.assembled = tick("STL: the parts in their places", (on) => set("assembled")(on || undefined), { "data-setting": "assembled" });
    const rows = (all, placeholderOf, optionsOf) => all.map((each) => labelled(each[1], number(each[0], placeholderOf(each), optionsOf(each)), " "));
    this.element = h("div", { class: "bs-task" },
      section("export", "What is exported",
        h("p", { class: "bs-hint" }, "Left empty: sizes that suit the linkage."),
        h("div", { class: "bs-grid" }, this.unitRow, rows(LENGTHS, () => "–", () => ({ kind: "length", above: 0 })), rows(NUMBERS, (each) => each[2], (each) => each[3]), labelled("up, in models", this.up)),
        this.dimensions.element, this.assembled.element),
      this.makeSigma(scene));
    store.on("document", () => this.draw());
    this.draw();
  }

  /** The standard deviations of the poses: both or none. */
  makeSigma(scene) {
    const { store } = this;
    this.wanted = {};
    this.lack = h("p", { class: "bs-fault", hidden: true }, "Give both: how far positions are off, and how far angles.");
    this.sigma = SIGMA.map(([key, name, kind]) => {
      const field = new NumberField({
        label: `standard deviation of the ${name}`, options: () => ({ kind, unit: store.document.length_unit, optional: true, above: 0 }), step: () => (kind === "angle" ? 0.1 : scene.step / 10),
        commit: (value) => this.setSigma(key, value), attributes: { "data-key": `sigma-${key}`, placeholder: "–" },
      });
      return { key, name, field };
    });
    return section("sigma", "How well the poses are known",
      h("p", { class: "bs-hint" }, "Standard deviations of what was measured. Left empty: as well as their digits say."),
      h("div", { class: "bs-grid" }, this.sigma.map(({ name, field }) => labelled(`${name} ±`, field.element, name === "angle" ? "°" : " "))), this.lack);
  }

  setSigma(key, value) {
    this.wanted = withKeys({ ...this.store.document.pose_sigma, ...this.wanted }, { [key]: value });
    const given = Object.keys(this.wanted).length;
    give(this.lack, "hidden", given !== 1);
    if (given === 1) return; // the other one is still to come
    const pose_sigma = given ? this.wanted : undefined;
    this.wanted = {};
    this.store.edit((document) => withKeys(document, { pose_sigma }));
  }

  draw() {
    const { settings, document } = this.store, { pose_sigma } = document, isOther = pose_sigma !== this.shown;
    for (const [name, field] of this.fields) field.show(settings[name]);
    give(this.unit, "value", settings.unit ?? "mm");
    give(this.unitRow, "hidden", Boolean(document.length_unit) && !settings.unit);
    give(this.up, "value", settings.up ?? "y");
    give(this.dimensions.box, "checked", settings.dimensions !== false);
    give(this.assembled.box, "checked", Boolean(settings.assembled));
    if (!isOther) return;
    this.shown = pose_sigma;
    this.wanted = {};
    give(this.lack, "hidden", true);
    for (const { key, field } of this.sigma) field.show(pose_sigma?.[key]);
  }
}
