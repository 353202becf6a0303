// Loads and springs in fields: weights, the hand, forces, springs and how the driver moves in time.

import { give, h, put, say } from "../widget/dom.mjs";
import { act } from "../widget/kinematics.mjs";
import { radians } from "../widget/numbers.mjs";
import { bodyOf, standing } from "./document.mjs";
import { NumberField, PairField, button, choice, labelled } from "./fields.mjs";
import { endOf, forcesOf, hasLoads, setAt, sidesOf, springsOf, valueOf, withEnd } from "./loads.mjs";

const DOWN = -9.80665; // m/s²: what a file's "down" says
const LINKS = ["ground", "body", "driver", "follower"];
const CODES = ["E177", "E178", "E179"]; // what the readers refuse of loads
const SIDES = ["ground_point", "body_point"];
const BODY = ["loads", "body"], PLATE = { plate: "steel 3", width: 12 };

/** Three digits of a number are enough to begin with. */
const rough = (value) => Number(value.toPrecision(3));

/** A place where lists of rows are kept as long as what they show: rows count from 0. */
class Rows {
  constructor(make) {
    this.make = make;
    this.rows = [];
    this.element = h("div", { class: "bs-load-rows" });
  }

  draw(items) {
    while (this.rows.length < items.length) {
      this.rows.push(this.make(this.rows.length));
      this.element.append(this.rows.at(-1).element);
    }
    for (const row of this.rows.splice(items.length)) row.element.remove();
    this.rows.forEach((row, k) => row.show(items[k]));
  }
}

export class LoadsPanel {
  /** form: of loads, as the start of the page says; handles: the points in the plane. */
  /** @type {any} */ search;

  constructor(store, scene, handles, answers, surface, form) {
    this.store = store;
    this.scene = scene;
    this.handles = handles;
    this.answers = answers;
    this.form = form;
    this.shown = []; // functions that show the task
    this.fault = h("p", { class: "bs-fault", role: "status" });
    this.said = h("ul", { class: "bs-load-notes" });
    this.sizes = h("datalist", { id: "bs-spring-sizes" });
    this.forces = new Rows((k) => this.makeForce(k));
    this.springs = new Rows((k) => this.makeSpring(k));
    const search = h("div", {}), find = button("Find a spring", () => this.find(search, surface), { "data-do": "find-spring" });
    const canFind = () => {
      give(find, "hidden", !store.document.loads);
      give(find, "disabled", store.chosen === "placed" || !answers.shown);
    };
    store.on("document chosen solved", canFind);
    canFind();
    this.element = h("details", { class: "bs-section bs-loads", "data-section": "loads" }, h("summary", {}, "Loads and springs"), this.fault, this.said, this.sizes,
      h("h4", {}, "Weight"), this.makeWeight(), h("h4", {}, "Hand and forces"), this.makeHand(), this.forces.element,
      h("div", { class: "bs-row" }, button("Add a force", () => this.addForce(), { "data-do": "add-force" })),
      h("h4", {}, "Springs"), this.springs.element,
      h("div", { class: "bs-row" }, button("Add a spring", () => this.addSpring(), { "data-do": "add-spring" }), find), search,
      h("h4", {}, "Motion in time"), this.makeDrive());
    store.on("document selection", () => this.draw());
    store.on("messages", () => this.tell());
    answers.on("answers moved shown placed", () => this.sum());
    this.draw();
    this.sum();
    if (hasLoads(store.document)) this.element.open = true;
  }

  /** Look for springs; what they are chosen from is loaded when it is first asked for. */
  async find(place, surface) {
    // @ts-ignore: the server has it under this name
    const { SpringSearch } = await import("/tools.mjs");
    if (!this.search) place.append((this.search = new SpringSearch(this.store, surface)).element);
    await this.search.run();
  }

  set(path, value) {
    this.store.edit((document) => setAt(document, path, value));
  }

  /** A number at a path of the document. */
  number(label, path, options = {}, attributes = {}) {
    const field = new NumberField({ label, commit: (value) => this.set(path, value), options: () => ({ optional: true, unit: this.store.document.length_unit, ...options }), step: () => (options.kind === "length" ? this.scene.step : 1), attributes: { "data-key": path.join("."), placeholder: "–", ...attributes } });
    this.shown.push((document) => field.show(valueOf(document, path)));
    return labelled(label, field.element);
  }

  pair(label, path, options = {}) {
    const names = ["x", "y"];
    const pair = new PairField({ labels: names.map((name) => `${label}, ${name}`), commit: (value) => this.set(path, value), options: () => ({ kind: "length", unit: this.store.document.length_unit, ...options }), step: () => this.scene.step, attributes: names.map((name) => ({ "data-key": `${path.join(".")}.${name}`, placeholder: "–" })) });
    this.shown.push((document) => pair.show(valueOf(document, path)));
    return labelled(label, pair.element);
  }

  // Weight

  makeWeight() {
    const mass = new NumberField({ label: "mass of the body, kg", options: () => ({ optional: true, least: 0 }), attributes: { "data-key": "mass_kg", placeholder: "–" }, commit: (value) => this.set(BODY, value === undefined ? undefined : { ...this.store.document.loads?.body, mass_kg: value, ...this.centre() }) });
    const links = choice("masses of the links", [["", "none"], ["plate", "plates of a material"], ["mass", "in kg, by link"]], (value) => this.set(["loads", "links"], { plate: PLATE, mass: { driver: 0.5, follower: 0.5 } }[value]), { "data-key": "links" });
    const material = choice("material of the plates", this.form.materials.map((name) => [name, name]), () => this.setPlate(material.value, thickness.value), { "data-key": "material" });
    const thickness = new NumberField({ label: "thickness of the plates", options: () => ({ kind: "length", unit: this.store.document.length_unit, above: 0 }), commit: (value) => this.setPlate(material.value, value) });
    const plates = h("div", { class: "bs-grid" }, labelled("material", material), labelled("thickness", thickness.element), this.number("width of the plates", ["loads", "links", "width"], { kind: "length", above: 0, optional: false }));
    const masses = h("div", { class: "bs-grid" }, ["driver", "follower", "coupler"].map((link) => this.number(`mass of the ${link}, kg`, ["loads", "links", link], { least: 0 })));
    const gravity = choice("gravity", [["down", "down"], ["none", "none: a flat plane"], ["own", "in a direction of its own"]], (value) => this.set(["loads", "gravity"], value === "own" ? [0, -9.81] : value === "down" && !this.store.document.loads ? undefined : value), { "data-key": "gravity" });
    const direction = this.pair("gravity, m/s²", ["loads", "gravity"], { kind: "number" });
    this.shown.push((document) => {
      const { body, links: stated, gravity: pull = "down" } = document.loads ?? {}, isPlate = stated?.plate !== undefined;
      mass.show(body?.mass_kg);
      links.value = isPlate ? "plate" : stated ? "mass" : "";
      give(plates, "hidden", !isPlate);
      give(masses, "hidden", !stated || isPlate);
      if (isPlate) {
        const [name, thick] = stated.plate.trim().split(/\s+/);
        if (![...material.options].some((each) => each.value === name)) material.append(h("option", { value: name }, `${name} kg/m³`));
        material.value = name;
        thickness.show(Number(thick));
      }
      const isDown = pull === "down" || (pull[0] === 0 && pull[1] === DOWN), isNone = pull === "none" || (pull[0] === 0 && pull[1] === 0);
      gravity.value = isDown ? "down" : isNone ? "none" : "own";
      give(direction, "hidden", isDown || isNone);
    });
    return h("div", { class: "bs-grid" }, labelled("mass of the body, kg", mass.element), this.pair("centre of mass, in M", [...BODY, "center"]), this.number("moment of inertia, kg m²", [...BODY, "inertia_kgm2"], { least: 0 }), labelled("masses of the links", links), plates, masses, labelled("gravity", gravity), direction);
  }

  setPlate(material, thickness) {
    this.set(["loads", "links", "plate"], `${material} ${thickness}`);
  }

  /** A centre to begin with, where no outline says one. */
  centre() {
    const { document } = this.store;
    return bodyOf(document).length || document.body || document.loads?.body?.center ? {} : { center: [rough(0.5 * this.size), 0] };
  }

  /** The size of the motion. */
  get size() {
    return this.answers.data.scene || 1;
  }

  // Hand and forces

  makeHand() {
    const add = button("Put a hand on the body", () => this.set(["loads", "hand", "at"], [rough(this.size), 0]), { "data-do": "add-hand" });
    const at = this.pair("point of the hand, in M", ["loads", "hand", "at"]);
    this.shown.push((document) => {
      give(add, "hidden", Boolean(document.loads?.hand));
      give(at, "hidden", !document.loads?.hand);
    });
    return h("div", { class: "bs-grid" }, add, at, this.number("torque on the body, N·m", ["loads", "torque_Nm"]), this.number("temperature of gas springs, °C", ["loads", "temperature_C"], { least: -273 }, { placeholder: "20" }));
  }

  addForce() {
    const { document } = this.store;
    this.set(["loads", "force", forcesOf(document).length], { at: [rough(0.5 * this.size), 0], force_N: [0, -50] });
  }

  makeForce(k) {
    const path = ["loads", "force", k], own = this.shown;
    this.shown = [];
    const frame = choice(`Force ${k + 1} turns`, [["F", "keeps its direction"], ["M", "turns with the body"]], (value) => this.set([...path, "frame"], value === "F" ? undefined : value), { "data-key": `force-${k}-frame` });
    const pose = (key) => this.number(key === "from_pose" ? "from pose" : "to pose", [...path, key], { whole: true, least: 1 }, { placeholder: "any" });
    const element = h("div", { class: "bs-limit-box", "data-force": k }, h("div", { class: "bs-row" }, h("b", {}, `Force ${k + 1}`), button("Delete", () => this.set(path, undefined), { "data-do": `delete-force-${k}`, "aria-label": `Delete force ${k + 1}` })),
      h("div", { class: "bs-grid" }, this.pair("at, in M", [...path, "at"]), this.pair("force, N", [...path, "force_N"], { kind: "number" }), labelled("direction", frame), pose("from_pose"), pose("to_pose")));
    const shown = this.shown;
    this.shown = own;
    return { element, show: (force) => (shown.forEach((each) => each(this.store.document)), (frame.value = force.frame ?? "F")) };
  }

  // Springs

  /** A spring to begin with: from the ground beside the linkage to the body, as long as it is there. */
  addSpring() {
    const { document } = this.store, led = this.answers.shown?.led ?? [], fixed = led.find((dyad) => dyad.fixed_pivot)?.fixed_pivot ?? [0, -this.size];
    const spring = { kind: "gas", ground_point: [rough(fixed[0] + 0.2 * this.size), rough(fixed[1] - 0.2 * this.size)], body_point: [rough(0.5 * this.size), 0] };
    this.set(["springs", springsOf(document).length], { ...spring, ...this.begun("gas", spring) });
  }

  /** Numbers of a kind to begin with, which fit between the ends at the first pose. */
  begun(kind, spring) {
    const { x, y, angle } = standing(this.store.document, 0), place = { x, y, a: radians(angle) };
    const [one, two] = SIDES.map((side) => endOf(spring, side)), there = act(place, two.point), long = Math.hypot(one.point[0] - there[0], one.point[1] - there[1]) || this.size;
    return Object.fromEntries(this.kindOf(kind).numbers.filter(({ needed }) => needed).map(({ key, kind: counts, usual }) => [key, spring[key] ?? (counts === "length" ? rough(usual * long) : usual)]));
  }

  kindOf(kind) {
    return this.form.springs.find((each) => each.kind === kind);
  }

  makeSpring(k) {
    const at = () => springsOf(this.store.document)[k], edit = (spring) => this.set(["springs", k], spring);
    const ends = (spring) => Object.fromEntries([...SIDES, "from", "to", "count"].filter((key) => spring[key] !== undefined).map((key) => [key, spring[key]]));
    const kind = choice(`Kind of spring ${k + 1}`, this.form.springs.map((each) => [each.kind, each.label]), (value) => edit({ kind: value, ...ends(at()), ...this.begun(value, ends(at())) }), { "data-key": `spring-${k}-kind` });
    const count = new NumberField({ label: `how many springs ${k + 1}`, options: () => ({ whole: true, least: 1 }), commit: (value) => edit({ ...at(), count: value }), attributes: { "data-key": `spring-${k}-count` } });
    const size = h("input", { class: "bs-text", list: "bs-spring-sizes", placeholder: "of the list of sizes", "aria-label": `Size of spring ${k + 1}`, "data-key": `spring-${k}-size`, autocomplete: "off", onfocus: () => this.loadSizes(at().kind), onchange: () => take() });
    const none = h("p", { class: "bs-fault", hidden: true });
    const take = () => {
      const found = this.offers?.find(({ name }) => name === size.value.trim());
      give(none, "hidden", Boolean(found) || !size.value);
      say(none, `There is no spring “${size.value}” in the list.`);
      if (!found) return;
      const { name, ...numbers } = found;
      size.value = "";
      edit({ ...ends(at()), ...numbers });
    };
    const sides = SIDES.map((side, n) => this.makeEnd(k, side, n));
    const numbers = h("div", { class: "bs-grid" });
    const element = h("div", { class: "bs-limit-box", "data-spring": k }, h("div", { class: "bs-row" }, h("b", {}, `Spring ${k + 1}`), kind, button("Delete", () => this.set(["springs", k], undefined), { "data-do": `delete-spring-${k}`, "aria-label": `Delete spring ${k + 1}` })),
      h("div", { class: "bs-grid" }, labelled("size", h("span", { class: "bs-field" }, size, none)), sides.map((each) => each.element), labelled("how many", count.element)), numbers);
    let made = null, shown = [];
    return {
      element,
      show: (spring) => {
        if (made !== spring.kind) {
          made = spring.kind;
          [shown, this.shown] = [this.shown, []];
          numbers.replaceChildren(...this.kindOf(made).numbers.map(({ key, label, kind: counts, needed }) => this.number(label, ["springs", k, key], { kind: counts, ...(counts === "angle" ? {} : { least: 0 }), optional: !needed })));
          [shown, this.shown] = [this.shown, shown];
        }
        kind.value = spring.kind;
        count.show(spring.count ?? 1);
        give(size.parentNode.parentNode, "hidden", spring.kind === "torsion" || spring.kind === "counterweight" || spring.kind === "constant");
        shown.forEach((each) => each(this.store.document));
        sides.forEach((each) => each.show(spring));
      },
    };
  }

  makeEnd(k, side, n) {
    const { store } = this, at = () => springsOf(store.document)[k], label = `end on the ${n ? "body" : "ground"}`;
    const link = choice(`Link of ${label}, spring ${k + 1}`, LINKS.map((name) => [name, name]), (value) => this.set(["springs", k], withEnd(at(), side, value, this.handles.moved(at(), side, value))), { "data-key": `spring-${k}-${side}-link` });
    const pair = new PairField({ labels: ["x", "y"].map((axis) => `${axis} of ${label}, spring ${k + 1}`), options: () => ({ kind: "length", unit: store.document.length_unit }), step: () => this.scene.step, commit: (value) => value && this.set(["springs", k, ...endOf(at(), side).path], value), attributes: ["x", "y"].map((axis) => ({ "data-key": `spring-${k}-${side}-${axis}` })) });
    const element = labelled(n ? "to" : "from", h("span", { class: "bs-row" }, link, pair.element));
    return {
      element,
      show: (spring) => {
        const end = endOf(spring, side);
        if (![...link.options].some((each) => each.value === end.link)) link.append(h("option", { value: end.link }, end.link));
        link.value = end.link;
        pair.show(end.point);
        give(pair.element, "hidden", !sidesOf(spring).includes(side));
        give(element, "hidden", spring.kind === "counterweight" && !n);
      },
    };
  }

  /** The springs of usual sizes of a kind, asked for once in a unit. */
  async loadSizes(kind) {
    const { length_unit: unit } = this.store.document;
    if (this.offersIn !== unit) {
      this.offersIn = unit;
      this.offers = await (await this.store.connection.post("/springs", { length_unit: unit })).json().catch(() => []);
    }
    this.sizes.replaceChildren(...(this.offers ?? []).filter((each) => each.kind === kind).map(({ name }) => h("option", { value: name })));
  }

  // Motion in time

  makeDrive() {
    const { store } = this;
    const profile = choice("motion in time", [["", "not stated"], ...this.form.profiles, ["times", "a table of times"]], (value) => this.set(["drive"], value === "" ? undefined : value === "times" ? { times: this.usualTimes() } : { duration_s: store.document.drive?.duration_s ?? 2, profile: value }), { "data-key": "profile" });
    const fault = h("p", { class: "bs-fault", hidden: true });
    const times = h("textarea", { class: "bs-text", rows: 4, "aria-label": "Table of times", "data-key": "times", spellcheck: "false", onchange: () => {
      const read = rowsOf(times.value);
      give(fault, "hidden", Array.isArray(read));
      put(times, "aria-invalid", !Array.isArray(read));
      if (Array.isArray(read)) this.set(["drive", "times"], read);
      else say(fault, read);
    } });
    const duration = this.number("duration, s", ["drive", "duration_s"], { above: 0, optional: false });
    const table = h("div", { class: "bs-field" }, times, fault, h("p", { class: "bs-hint" }, "A line is seconds and a pose, such as 2 open, or degrees of the driver, such as 2 35°."));
    this.shown.push(({ drive }) => {
      profile.value = !drive ? "" : drive.times ? "times" : drive.profile ?? "3-4-5";
      give(duration, "hidden", !drive || Boolean(drive.times));
      give(table, "hidden", !drive?.times);
      if (Array.isArray(drive?.times) && fault.hidden && document.activeElement !== times) give(times, "value", drive.times.map(([time, place]) => `${time} ${typeof place === "number" ? `${place}°` : place}`).join("\n"));
    });
    return h("div", { class: "bs-grid" }, labelled("motion in time", profile), duration, table);
  }

  /** From the first pose to the last, in the time that is stated so far. */
  usualTimes() {
    const { poses, drive } = this.store.document;
    return [[0, poses[0]?.name ?? "1"], [drive?.duration_s ?? 2, poses.at(-1)?.name ?? String(poses.length)]];
  }

  draw() {
    const { document } = this.store;
    this.springs.draw(springsOf(document));
    this.forces.draw(forcesOf(document));
    for (const show of this.shown) show(document);
    this.tell();
  }

  /** What the chosen linkage bears, in sentences; those of before while a hand drags. */
  sum() {
    const { shown } = this.answers, said = shown?.loads?.said ?? [];
    this.said.classList.toggle("bs-old", Boolean(shown?.followed));
    if (said.join() !== this.saidNow) this.said.replaceChildren(...said.map((each) => h("li", {}, each)));
    this.saidNow = said.join();
  }

  /** What the readers refuse of the loads stands here, too. */
  tell() {
    const { messages, document } = this.store, refused = messages.find(({ code }) => CODES.includes(code));
    const text = refused ? [refused.message, refused.why, refused.help].filter(Boolean).map((each) => `${each[0].toUpperCase()}${each.slice(1)}.`).join(" ") : hasLoads(document) && !document.length_unit ? "Loads need the unit of lengths: choose it under Unit and method." : "";
    give(this.fault, "hidden", !text);
    say(this.fault, text);
  }
}

/** The rows of a table of times; or a sentence about the line that is none. */
function rowsOf(text) {
  const lines = text.split("\n").map((line) => line.trim()).filter(Boolean), rows = [];
  for (const line of lines) {
    const found = /^(\d+(?:[.,]\d*)?|[.,]\d+)\s*s?[\s,;:]+(.+)$/.exec(line.normalize("NFKC"));
    if (!found) return `“${line}” is no time and pose: write seconds and a pose, such as 2 open.`;
    const turn = /^([+\-−]?[\d.,]+)\s*(?:°|deg)$/.exec(found[2]), number = (each) => Number(each.replace(",", ".").replace("−", "-"));
    if (turn && !Number.isFinite(number(turn[1]))) return `“${found[2]}” is no angle: write one such as 35°.`;
    rows.push([number(found[1]), turn ? number(turn[1]) : found[2]]);
  }
  return rows.length < 2 ? "A table of times has two lines or more." : rows;
}
