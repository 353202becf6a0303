// The poses as a table: the same data as the handles, to the last digit.

import { give, h, put, say } from "../widget/dom.mjs";
import { addPose, duplicatePose, isFree, isOfPoints, isPoint, movePose, removePose, setAngle, setCrank, setFree, setPose, setTolerance, standing } from "./document.mjs";
import { NumberField, button, choice, labelled, textField, tick } from "./fields.mjs";
import { Pace, isOther } from "./pacing.mjs";

const PAGE = 60; // rows at a time
const NUMBERS = [["x", "length"], ["y", "length"], ["angle", "angle"]];
const BOUNDS = [["x", "x", "length"], ["y", "y", "length"], ["angle", "angle_deg", "angle"]];

/** A name as one line of text: a field of the page keeps no line ends. */
const oneLine = (name) => (name ?? "").replace(/[\r\n\u2028\u2029]+/g, " ");

export class PoseTable {
  /** @type {any} */ exact;
  /** @type {any} */ crank;
  /** @type {any} */ weight;
  /** @type {any} */ bounds;
  /** @type {any} */ crankLine;

  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.page = 0;
    this.rows = [];
    this.body = h("tbody", {});
    this.unit = h("span", { class: "bs-unit" });
    this.pages = h("div", { class: "bs-pages", hidden: true });
    this.details = h("div", { class: "bs-details", "data-details": "pose" });
    this.hint = h("p", { class: "bs-hint" }, "A blank angle is free: then the row is a point, which the body passes at any angle.");
    this.table = h(
      "table",
      { class: "bs-poses", "aria-label": "Poses" },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "#"), h("th", { scope: "col" }, "name"), h("th", { scope: "col" }, "x"), h("th", { scope: "col" }, "y"), h("th", { scope: "col" }, "angle °"))),
      this.body,
    );
    const add = button("Add a pose", () => this.add(), { "data-do": "add-pose-row" });
    this.element = h("div", { class: "bs-table-box" }, this.table, this.pages, h("div", { class: "bs-row" }, add, this.unit), this.hint, this.details);
    this.makeDetails();
    this.pace = new Pace(() => this.draw());
    store.on("document selection", () => (scene.dragged ? this.pace.ask() : this.draw())); // numbers may lag behind a hand
    scene.on("dropped", () => this.pace.catchUp());
    this.draw();
  }

  get selected() {
    const { selection, document } = this.store;
    return selection?.kind === "pose" && selection.index < document.poses.length ? selection.index : null;
  }

  draw() {
    const { document } = this.store, count = document.poses.length, pages = Math.max(1, Math.ceil(count / PAGE));
    if (this.selected !== null && this.selected !== this.shownSelection) this.page = Math.floor(this.selected / PAGE);
    this.shownSelection = this.selected;
    this.page = Math.min(this.page, pages - 1);
    const first = this.page * PAGE, shown = Math.min(PAGE, count - first);
    while (this.rows.length < shown) this.rows.push(this.makeRow(this.rows.length));
    while (this.body.children.length > shown) this.body.lastChild.remove();
    for (let k = 0; k < shown; k += 1) {
      if (!this.rows[k].tr.isConnected || this.body.children[k] !== this.rows[k].tr) this.body.append(this.rows[k].tr);
      this.showRow(this.rows[k], first + k);
    }
    say(this.unit, document.length_unit ? `x and y in ${document.length_unit}` : "");
    this.showPages(pages, count);
    this.showDetails();
  }

  /** One row of the table, at a place of the page; which pose it shows changes. */
  makeRow(place) {
    const row = { index: place, fields: {} };
    const change = (changes) => this.store.edit((document) => setPose(document, row.index, changes));
    row.number = h("button", { type: "button", class: "bs-index", onclick: (event) => (event.shiftKey || event.ctrlKey || event.metaKey ? this.store.selectAlso(row.index) : this.store.select(row.index === this.selected && this.store.selectedPoses.length === 1 ? null : { kind: "pose", index: row.index })) });
    row.name = textField("Name", (text) => change({ name: text.trim() || undefined }), { class: "bs-text bs-name", placeholder: "–" });
    const cells = NUMBERS.map(([key, kind]) => {
      const field = new NumberField({
        label: key,
        options: () => ({ kind, unit: this.store.document.length_unit, optional: key === "angle" || this.isFree(row.index, key) }),
        step: () => (kind === "angle" ? 1 : this.scene.step),
        commit: (value) => (key === "angle" ? this.store.edit((document) => setAngle(document, row.index, value)) : change({ [key]: value })),
        attributes: { "data-key": key },
      });
      row.fields[key] = field;
      return h("td", {}, field.element);
    });
    row.tr = h("tr", { class: "bs-pose-row" }, h("th", { scope: "row" }, row.number), h("td", {}, row.name), cells);
    row.tr.addEventListener("focusin", (event) => event.target !== row.number && this.store.select({ kind: "pose", index: row.index }));
    return row;
  }

  isFree(index, key) {
    return isFree(this.store.document.poses[index], key);
  }

  showRow(row, index) {
    const pose = this.store.document.poses[index], moved = row.index !== index, selected = this.store.selectedPoses.includes(index);
    row.index = index;
    if (!isOther(row.tr, [index, pose, selected]) && document.activeElement?.closest("tr") !== row.tr) return;
    put(row.tr, "data-row", index + 1);
    row.tr.classList.toggle("bs-selected", selected);
    say(row.number, index + 1);
    put(row.number, "aria-label", `Pose ${index + 1}`);
    put(row.number, "aria-pressed", selected);
    if (moved || document.activeElement !== row.name) give(row.name, "value", oneLine(pose.name));
    put(row.name, "aria-label", `Name of pose ${index + 1}`);
    for (const [key] of NUMBERS) {
      const { input } = row.fields[key], free = this.isFree(index, key);
      put(input, "aria-label", `${key} of pose ${index + 1}`);
      put(input, "placeholder", free ? "free" : "");
      row.fields[key].turnTo(index, pose[key]);
      row.fields[key].show(pose[key]);
    }
  }

  showPages(pages, count) {
    give(this.pages, "hidden", pages < 2);
    if (pages < 2) return;
    const go = (page) => {
      this.page = page;
      this.draw();
    };
    this.pages.replaceChildren(
      button("‹", () => go(Math.max(0, this.page - 1)), { "aria-label": "Earlier poses", disabled: this.page === 0 }),
      h("span", {}, `${this.page * PAGE + 1}–${Math.min(count, (this.page + 1) * PAGE)} of ${count}`),
      button("›", () => go(Math.min(pages - 1, this.page + 1)), { "aria-label": "Later poses", disabled: this.page === pages - 1 }),
    );
  }

  /** A copy of the last pose, a step beside it, and its x ready to be typed over. */
  add() {
    const { store, scene } = this, count = store.document.poses.length;
    const last = count ? standing(store.document, count - 1) : { x: 0, y: 0, angle: 0 }, ofPoints = isOfPoints(store.document);
    store.edit((document) => {
      const more = addPose(document, count ? { ...last, x: scene.rounded(last.x + 10 * scene.step) } : last);
      return ofPoints ? setAngle(more, count, undefined) : more;
    });
    store.select({ kind: "pose", index: count });
    const field = this.rows.find((row) => row.index === count && row.tr.isConnected)?.fields.x.input;
    field?.focus();
    field?.select();
  }

  // What else a pose says: shown for the selected one

  makeDetails() {
    const { store } = this;
    const at = () => this.selected;
    const edit = (change) => store.edit((document) => change(document, at()));
    this.title = h("h3", { class: "bs-pose-title" });
    this.exact = tick("met exactly", (on) => edit((document, k) => setPose(document, k, { exact: on || undefined })), { "data-key": "exact" });
    this.weight = new NumberField({
      label: "weight", options: () => ({ optional: true, above: 0 }),
      commit: (value) => edit((document, k) => setPose(document, k, { weight: value })), attributes: { "data-key": "weight", placeholder: "1" },
    });
    this.bounds = BOUNDS.map(([component, key, kind]) => {
      const field = new NumberField({
        label: `tolerance of ${component}`, options: () => ({ kind, unit: store.document.length_unit, optional: true, least: 0 }), step: () => (kind === "angle" ? 1 : this.scene.step),
        commit: (value) => edit((document, k) => setTolerance(document, k, key, value)), attributes: { "data-key": `tolerance-${component}`, placeholder: "–" },
      });
      const turned = (document, k, on) => setAngle(document, k, on ? undefined : standing(document, k).angle);
      const free = tick("free", (on) => edit((document, k) => (component === "angle" ? turned(document, k, on) : setFree(document, k, component, on))), { "data-key": `free-${component}`, "aria-label": `${component} is free` });
      return { component, key, field, free };
    });
    this.axes = choice("Axes of the tolerance", [["fixed", "along the axes of the ground"], ["body", "along the axes of the body"]], (value) =>
      edit((document, k) => setTolerance(document, k, "axes", value === "body" ? value : undefined)), { "data-key": "tolerance-axes" });
    const act = (text, name, change, then) =>
      button(text, () => {
        const k = at();
        edit(change);
        store.select(then(k) === null ? null : { kind: "pose", index: then(k) });
      }, { "data-do": name });
    const last = () => store.document.poses.length - 1;
    this.up = act("Earlier", "earlier", (document, k) => movePose(document, k, k - 1), (k) => k - 1);
    this.down = act("Later", "later", (document, k) => movePose(document, k, k + 1), (k) => k + 1);
    this.crank = new NumberField({
      label: "crank angle", options: () => ({ kind: "angle" }), step: () => 1,
      commit: (value) => edit((document, k) => setCrank(document, k, value)), attributes: { "data-key": "crank" },
    });
    this.crankLine = labelled("crank angle °", this.crank.element);
    this.details.append(
      this.title,
      this.crankLine,
      h("div", { class: "bs-row" }, this.exact.element, labelled("weight", this.weight.element)),
      h("p", { class: "bs-hint" }, "Tolerance: how far from it the body may be, to either side"),
      h("table", { class: "bs-tolerances", "aria-label": "Tolerance" },
        h("tbody", {}, this.bounds.map(({ component, field, free }) => h("tr", {}, h("th", { scope: "row" }, component === "angle" ? "angle °" : component), h("td", {}, field.element), h("td", {}, free.element))))),
      this.axes,
      h("div", { class: "bs-row" }, this.up, this.down,
        act("Duplicate", "duplicate", duplicatePose, (k) => k + 1),
        act("Delete", "delete-pose", removePose, (k) => (last() < 0 ? null : Math.min(k, last())))),
    );
  }

  showDetails() {
    const k = this.selected;
    give(this.details, "hidden", k === null);
    if (k === null) return;
    const { poses } = this.store.document, pose = poses[k];
    if (!isOther(this.details, [k, pose, poses.length, this.store.document.path]) && !this.details.contains(document.activeElement)) return;
    const turned = this.store.document.path?.crank_deg?.[k];
    give(this.crankLine, "hidden", turned === undefined);
    this.crank.turnTo(k, turned);
    this.crank.show(turned);
    this.title.replaceChildren(`${isPoint(pose) ? "Point" : "Pose"} ${k + 1}`, ...(pose.name ? [": ", h("bdi", {}, oneLine(pose.name))] : []));
    give(this.exact.box, "checked", Boolean(pose.exact));
    this.weight.turnTo(k, pose.weight);
    this.weight.show(pose.weight);
    for (const { component, key, field, free } of this.bounds) {
      const isFree = this.isFree(k, component) || pose.tolerance?.[component] === "free";
      give(free.box, "checked", isFree);
      give(field.input, "disabled", isFree);
      const stated = pose.tolerance?.[key], bound = typeof stated === "number" ? stated : undefined;
      field.turnTo(k, bound);
      field.show(bound);
    }
    give(this.axes, "hidden", !pose.tolerance);
    give(this.axes, "value", pose.tolerance?.axes ?? "fixed");
    give(this.up, "disabled", k === 0);
    give(this.down, "disabled", k === poses.length - 1);
  }
}
