// What leaves the page, by what it is for, and what it is made with: holes and plates, drawings, models, films.

import { give, h } from "../widget/dom.mjs";
import { NumberField, choice, labelled, tick } from "./fields.mjs";
import { menuItem, popover } from "./files.mjs";

const LENGTHS = [["hole", "holes"], ["pin", "pins"], ["width", "links are wide"], ["thickness", "plates are thick"], ["gap", "gap between plates"]];
const NUMBERS = [ // name, words, what the command takes otherwise, what the value may be
  ["pose", "drawn at pose", "1", { least: 1, whole: true }], ["density", "density, kg/m³", "2700", { above: 0 }],
  ["seconds", "film, seconds", "4", { above: 0 }], ["frames_per_second", "pictures a second", "25", { above: 0 }], ["width_px", "pixels wide", "800", { least: 1, whole: true }],
];
const AXES = ["y", "x", "z", "-x", "-y", "-z"];
const UNITS = ["mm", "cm", "m", "in", "ft"];

const USES = { cut: "Cut", print: "Print", cad: "CAD", simulate: "Simulate", film: "Film", share: "Share" };

/** Every export there is, and options of `burmester export`; one that is left empty is not given. */
export class ExportSettings {
  /** formats: those that the server can write; files: who hands them over. */
  constructor(store, scene, formats, files) {
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
    const sizes = h("details", { class: "bs-section", "data-section": "export" }, h("summary", {}, "Sizes and settings"),
      h("p", { class: "bs-hint" }, "Left empty: sizes that suit the linkage."),
      h("div", { class: "bs-grid" }, this.unitRow, rows(LENGTHS, () => "–", () => ({ kind: "length", above: 0 })), rows(NUMBERS, (each) => each[2], (each) => each[3]), labelled("up, in models", this.up)),
      this.dimensions.element, this.assembled.element);
    const uses = h("div", { class: "bs-uses" }), all = [
      ...formats.map(({ format, title, suffix, use }) => ({ use, title, note: suffix, act: () => files.export("/export", { format }), data: { "data-export": format } })),
      { use: "share", title: "Report", note: ".html", act: () => files.export("/report"), data: { "data-export": "report" } },
      { use: "share", title: "Result", note: ".json", act: () => files.export("/result"), data: { "data-export": "result" } },
    ];
    const fill = (close) => uses.replaceChildren(...Object.entries(USES).map(([use, name]) => ({ name, some: all.filter((each) => each.use === use) })).filter(({ some }) => some.length).map(({ name, some }) =>
      h("div", { role: "group", "aria-label": name }, h("p", { class: "bs-menu-heading" }, name), some.map((each) => menuItem(each, close)))));
    this.element = popover("Export", h("div", { class: "bs-menu-list bs-exports" }, uses, sizes), fill, { "data-menu": "export" });
    store.on("document", () => this.draw());
    this.draw();
  }

  draw() {
    const { settings, document } = this.store;
    for (const [name, field] of this.fields) field.show(settings[name]);
    give(this.unit, "value", settings.unit ?? "mm");
    give(this.unitRow, "hidden", Boolean(document.length_unit) && !settings.unit);
    give(this.up, "value", settings.up ?? "y");
    give(this.dimensions.box, "checked", settings.dimensions !== false);
    give(this.assembled.box, "checked", Boolean(settings.assembled));
  }
}
