// Made by scripts/bundle from src/burmester/web/studio: change those files, not this one.

// src/burmester/web/widget/dom.mjs
var SVG = "http://www.w3.org/2000/svg";
function furnish(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === void 0 || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== void 0));
  return node;
}
var h = (tag, attributes, ...children) => furnish(document.createElement(tag), attributes, children);
var s = (tag, attributes, ...children) => furnish(document.createElementNS(SVG, tag), attributes, children);

// src/burmester/web/studio/autosave.mjs
var KEY = "burmester.studio";
var TAB = "burmester.studio.tab";
var SOON = 400;
var Autosave = class {
  constructor(store) {
    this.store = store;
    store.on("document", () => this.soon());
    store.connection.on("open", () => this.isOpen && this.soon());
    addEventListener("pagehide", () => this.keep());
    document.addEventListener("visibilitychange", () => document.visibilityState === "hidden" && this.keep());
  }
  soon() {
    clearTimeout(this.timer);
    this.isOpen = true;
    document.documentElement.dataset.kept = "false";
    this.timer = setTimeout(() => this.keep(), SOON);
  }
  keep() {
    if (!this.isOpen) return;
    this.isOpen = false;
    clearTimeout(this.timer);
    const { document: task, options, name, connection } = this.store, text = { document: task, options, name };
    document.documentElement.dataset.kept = "true";
    try {
      sessionStorage.setItem(KEY, JSON.stringify(text));
    } catch {
    }
    connection.post("/autosave", { ...text, tab: tabName() }, "PUT").catch(() => this.isOpen = true);
  }
};
function tabName() {
  try {
    const name = sessionStorage.getItem(TAB) ?? crypto.randomUUID();
    sessionStorage.setItem(TAB, name);
    return name;
  } catch {
    return "tab";
  }
}
function keptHere() {
  try {
    const kept = JSON.parse(sessionStorage.getItem(KEY));
    return Array.isArray(kept?.document?.poses) ? kept : null;
  } catch {
    return null;
  }
}

// src/burmester/web/studio/quantities.mjs
var LENGTHS = {
  // in metres
  µm: 1e-6,
  um: 1e-6,
  mm: 1e-3,
  cm: 0.01,
  m: 1,
  in: 0.0254,
  inch: 0.0254,
  '"': 0.0254,
  "″": 0.0254,
  ft: 0.3048,
  "'": 0.3048,
  "′": 0.3048
};
var ANGLES = { "°": 1, deg: 1, degree: 1, degrees: 1, rad: 180 / Math.PI, mrad: 0.18 / Math.PI };
var WRITTEN = /^([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[+-]?\d+)?)\s*(.*)$/i;
var DIGITS = 12;
var GREATEST = 1e300;
var tidy = (value) => Number(value.toPrecision(DIGITS));
var written = (value) => value === void 0 || value === null ? "" : String(value).replace("-", "−").replace("e−", "e-");
function quantity(text, { kind = "number", unit = "", optional = false, least = -Infinity, above = -Infinity, most = Infinity } = {}) {
  const plain = text.normalize("NFKC").replace(/[−–]/g, "-").replace(/[\u00a0\u2009\u202f]/g, " ").trim();
  const example = { length: unit in LENGTHS ? `12.5 or 0.5 in` : "12.5", angle: "30 or 0.5 rad", number: "12.5" }[kind];
  if (!plain) return optional ? { value: void 0 } : { fault: `A number is missing here: write one such as ${example}.` };
  const found = WRITTEN.exec(plain);
  if (!found) return { fault: `“${text.trim()}” is not a number: write one such as ${example}.` };
  const number = Number(found[1].replace(",", ".")), name = found[2].trim().replace(/^μm$/, "µm");
  const factor = factorOf(name, kind, unit);
  if (typeof factor === "string") return { fault: factor };
  const value = factor === 1 ? number : tidy(number * factor);
  if (!(Math.abs(value) <= GREATEST)) return { fault: `${text.trim()} is too large a number.` };
  const shown = kind === "angle" ? "°" : kind === "length" && unit ? ` ${unit}` : "";
  if (value < least) return { fault: `This may not be less than ${least}${shown}.` };
  if (value <= above) return { fault: `This must be greater than ${above}${shown}.` };
  if (value > most) return { fault: `This may not be more than ${most}${shown}.` };
  return { value };
}
function factorOf(name, kind, unit) {
  if (!name || kind === "length" && name === unit) return 1;
  if (kind === "number") return `“${name}” is not needed here: write the number alone.`;
  const units = kind === "angle" ? ANGLES : LENGTHS, known = name in units ? name : name.toLowerCase();
  if (!Object.hasOwn(units, known)) {
    const usual = kind === "angle" ? "° or rad" : "mm, cm, m, in or ft";
    return `“${name}” is not a unit of ${kind} known here: write ${usual}, or the number alone.`;
  }
  if (kind === "angle") return units[known];
  if (!Object.hasOwn(LENGTHS, unit)) return `This task has ${unit ? `the unit ${unit}` : "no unit of length"}: write the number alone.`;
  return units[known] / LENGTHS[unit];
}

// src/burmester/web/studio/fields.mjs
var made = 0;
var NumberField = class {
  constructor({ label, options, commit, step = () => 1, attributes = {} }) {
    made += 1;
    this.options = options;
    this.commit = commit;
    this.value = void 0;
    this.drafts = /* @__PURE__ */ new Map();
    this.fault = h("p", { class: "bs-fault", id: `bs-fault-${made}`, hidden: true });
    this.input = h("input", {
      class: "bs-number",
      type: "text",
      inputmode: "text",
      autocomplete: "off",
      spellcheck: "false",
      "aria-label": label,
      ...attributes,
      onchange: () => this.read(),
      oninput: () => this.fault.hidden || this.read(),
      onkeydown: (event) => this.nudge(event, step())
    });
    this.element = h("span", { class: "bs-field" }, this.input, this.fault);
  }
  /** Show a value of the task; text that could not be read stays. */
  show(value) {
    const changed = value !== this.value;
    this.value = value;
    if (changed || this.fault.hidden) {
      const text = written(value);
      if (this.input.value !== text && !(this.isEdited && !changed)) this.input.value = text;
      if (changed) this.say(null);
    }
  }
  /** Show the value of another thing; what could not be read waits for its own thing to come back. */
  turnTo(id, value) {
    if (id === this.id) return;
    if (this.fault.hidden) this.drafts.delete(this.id);
    else this.drafts.set(this.id, this.input.value);
    const draft = this.drafts.get(id);
    Object.assign(this, { id, value });
    this.input.value = draft ?? written(value);
    this.say(draft === void 0 ? null : quantity(draft, this.options()).fault ?? null);
  }
  get isEdited() {
    return document.activeElement === this.input && this.input.value !== written(this.value);
  }
  read() {
    const { value, fault } = quantity(this.input.value, this.options());
    this.say(fault ?? null);
    if (fault) return;
    const isNew = value !== this.value;
    this.value = value;
    if (document.activeElement !== this.input || !isNew) this.input.value = written(value);
    if (isNew) this.commit(value);
    this.input.value = written(this.value);
  }
  /** The arrow keys: a step, ten with Shift, a tenth with Alt. */
  nudge(event, step) {
    if (event.key === "Enter") this.read();
    const sense = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (!sense || event.ctrlKey || event.metaKey) return;
    const { value, fault } = quantity(this.input.value, this.options());
    if (fault || value === void 0) return;
    event.preventDefault();
    this.input.value = written(stepped(value, sense * stepOf(event, step)));
    this.read();
  }
  say(sentence) {
    this.fault.hidden = sentence === null;
    this.fault.textContent = sentence ?? "";
    if (sentence === null) {
      this.input.removeAttribute("aria-invalid");
      this.input.removeAttribute("aria-describedby");
    } else {
      this.input.setAttribute("aria-invalid", "true");
      this.input.setAttribute("aria-describedby", this.fault.id);
    }
  }
};
var stepOf = (event, step) => step * (event.shiftKey ? 10 : event.altKey ? 0.1 : 1);
var stepped = (value, by) => Number((value + by).toPrecision(12));
var labelled = (text, control, hint) => h("label", { class: "bs-labelled" }, h("span", { class: "bs-label" }, text), control, hint ? h("span", { class: "bs-hint" }, hint) : null);
function textField(label, commit, attributes = {}) {
  return h("input", { class: "bs-text", type: "text", autocomplete: "off", spellcheck: "false", "aria-label": label, ...attributes, onchange: (event) => commit(event.target.value) });
}
function tick(text, commit, attributes = {}) {
  const box = h("input", { type: "checkbox", ...attributes, onchange: (event) => commit(event.target.checked) });
  return { box, element: h("label", { class: "bs-tick" }, box, " ", text) };
}
function choice(label, pairs, commit, attributes = {}) {
  return h(
    "select",
    { class: "bs-choice", "aria-label": label, ...attributes, onchange: (event) => commit(event.target.value) },
    pairs.map(([value, text]) => h("option", { value }, text))
  );
}
var button = (text, onclick, attributes = {}) => h("button", { type: "button", class: "bm-button", onclick, ...attributes }, text);

// src/burmester/web/studio/banners.mjs
var ROLES = { refused: "alert", offline: "alert", limit: "alert", expired: "alert" };
var NO_FILE = "task.json";
function sentenceOf({ code, message, where, why, help }) {
  return h(
    "li",
    {},
    code ? h("span", { class: "bm-code" }, code) : null,
    " ",
    h("span", {}, message),
    where && !where.startsWith(NO_FILE) ? h("pre", { class: "bs-where" }, where) : null,
    why ? h("p", { class: "bs-why" }, `Why: ${why}.`) : null,
    help ? h("p", { class: "bs-help" }, `What to do: ${help}.`) : null
  );
}
var Banners = class {
  constructor(store) {
    this.store = store;
    this.shown = /* @__PURE__ */ new Map();
    this.element = h("div", { class: "bs-banners" });
    this.status = h("p", { class: "bs-status", role: "status", "aria-live": "polite" });
    store.on("messages", () => this.messages());
    store.on("state solved messages", () => this.state());
  }
  /** Show a banner of a kind in place of the one before; actions: buttons. */
  say(kind, title, messages = [], { undo = false, actions = [] } = {}) {
    const close = button("✕", () => this.close(kind), { "aria-label": "Close", class: "bs-close" });
    const all = [...actions, ...undo ? [button("Undo", () => (this.close(kind), this.store.undo()))] : []];
    const banner = h(
      "section",
      { class: `bs-banner bs-${kind}`, role: ROLES[kind] ?? "status", "data-banner": kind },
      h("p", { class: "bs-banner-title" }, title),
      messages.length ? h("ul", {}, messages.map(sentenceOf)) : null,
      all.length ? h("div", { class: "bs-row" }, all) : null,
      kind === "offline" ? null : close
    );
    this.shown.get(kind)?.remove();
    this.shown.set(kind, banner);
    this.element.append(banner);
  }
  close(kind) {
    this.shown.get(kind)?.remove();
    this.shown.delete(kind);
  }
  /** What the server said of the task, by its kind. */
  messages() {
    const { store } = this, { messages } = store, [first] = messages;
    this.close("limit");
    this.close("refused");
    if (!first) return;
    if (first.tone === "cancelled") this.say("note", "Solving was stopped. What is shown was followed from the answer before.", [], { actions: [this.again()] });
    else if (first.tone === "limit") this.say("limit", "Solving took too long and was stopped. Nothing is lost: what is shown was followed from the answer before.", messages, { actions: [this.again()] });
    else this.say("refused", "The task cannot be solved as it is.", messages);
  }
  again() {
    return button("Solve again", () => {
      this.close("note");
      this.close("limit");
      this.store.solve();
    }, { "data-do": "solve-again" });
  }
  state() {
    const { store } = this, solving = store.state === "solving";
    if (store.state === "offline") this.offline();
    else this.close("offline");
    this.status.dataset.state = store.state;
    if (store.state === "dragging") return;
    this.status.textContent = solving ? `Solving${store.progress ? `: ${store.progress}` : "…"}` : store.state === "offline" ? "Not connected" : this.summary();
  }
  summary() {
    const { solved, solvedFor, document: document2, messages } = this.store;
    if (messages.length) return "Not solved";
    if (!solved || solvedFor !== document2) return "";
    const count = solved.linkages.length, usable = solved.linkages.filter((each) => each.usable).length;
    return count ? `${count} linkage${count === 1 ? "" : "s"}, ${usable} usable` : "No linkage";
  }
  offline() {
    if (this.shown.has("offline")) return;
    this.say("offline", "The server does not answer. Nothing is lost: the task is in this page, and can still be changed and saved.", [], {
      actions: [
        button("Save the task (JSON)", () => this.files.saveWithoutServer(), { "data-do": "save-json" }),
        h("span", { class: "bs-hint" }, "The page tries again by itself. If the server has ended, start burmester studio with that file, or drop the file on the new page.")
      ]
    });
  }
  /** Another server answers at this address, which asks for its own token. */
  expired() {
    this.close("offline");
    this.say("expired", "The server was started anew. Nothing is lost: open the address that it printed in this tab, and go on here.", [], {
      actions: [button("Save the task (JSON)", () => this.files.saveWithoutServer())]
    });
  }
};

// src/burmester/web/widget/numbers.mjs
var clamp = (value, low, high) => Math.min(Math.max(value, low), high);
var degrees = (angle) => angle * 180 / Math.PI;
var radians = (angle) => angle * Math.PI / 180;
var px = (value) => Math.abs(value) < 1e7 ? +value.toFixed(5) : Math.sign(value) * 1e7;
function fixed(value, digits) {
  if (value === null || value === void 0 || !Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}
function ticks(low, high, about) {
  const rough = (high - low) / Math.max(1, about);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((each) => each >= rough * 0.999);
  const digits = Math.max(0, -Math.floor(Math.log10(step * 1.0001)));
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k += 1) {
    marks.push({ at: k * step, text: fixed(k * step, digits) });
  }
  return marks;
}

// src/burmester/web/widget/kinematics.mjs
function act(place, [x, y]) {
  const c = Math.cos(place.a), d = Math.sin(place.a);
  return [place.x + c * x - d * y, place.y + d * x + c * y];
}
function back(place, [x, y]) {
  const c = Math.cos(place.a), d = Math.sin(place.a);
  return [c * (x - place.x) + d * (y - place.y), -d * (x - place.x) + c * (y - place.y)];
}

// src/burmester/web/widget/drawing.mjs
var transform = (x, y, angle) => `translate(${px(x)} ${px(y)}) rotate(${px(degrees(-angle))})`;
function axes(length) {
  const l = length, head = Math.max(4, 0.22 * length);
  return `M0 0H${l}m${-head} ${-head / 2}l${head} ${head / 2}l${-head} ${head / 2}M0 0V${-0.6 * l}`;
}

// src/burmester/web/studio/document.mjs
function withKeys(object, changes) {
  const copy = { ...object, ...changes };
  for (const [key, value] of Object.entries(changes)) if (value === void 0) delete copy[key];
  return copy;
}
var replaced = (list, index, value) => list.map((each, k) => k === index ? value : each);
var without = (list, index) => list.filter((_, k) => k !== index);
var inserted = (list, index, value) => [...list.slice(0, index), value, ...list.slice(index)];
var withList = (document2, key, list) => withKeys(document2, { [key]: list.length ? list : void 0 });
var filled = (table) => Object.keys(table).length ? table : void 0;
var setPose = (document2, index, changes) => withKeys(document2, { poses: replaced(document2.poses, index, withKeys(document2.poses[index], changes)) });
var addPose = (document2, pose, index = document2.poses.length) => withKeys(document2, { poses: inserted(document2.poses, index, pose) });
var removePose = (document2, index) => withKeys(document2, { poses: without(document2.poses, index) });
var duplicatePose = (document2, index) => addPose(document2, withKeys(document2.poses[index], { name: void 0 }), index + 1);
function movePose(document2, from, to) {
  const poses = without(document2.poses, from);
  return withKeys(document2, { poses: inserted(poses, to, document2.poses[from]) });
}
function setFree(document2, index, component2, free) {
  const pose = document2.poses[index], others = (pose.free ?? []).filter((each) => each !== component2);
  const list = free ? [...others, component2] : others;
  const { [component2]: bound, ...bounds2 } = pose.tolerance ?? {};
  return setPose(document2, index, { free: list.length ? list : void 0, tolerance: free ? filled(bounds2) : pose.tolerance });
}
var setTolerance = (document2, index, key, bound) => setPose(document2, index, { tolerance: filled(withKeys(document2.poses[index].tolerance ?? {}, { [key]: bound })) });
var setBody = (document2, corners) => withList(document2, "body", corners);
var bodyOf = (document2) => Array.isArray(document2.body) ? document2.body : [];
var regionsOf = (document2) => document2.keep_out === void 0 ? [] : [document2.keep_out].flat();
var addRegion = (document2, region) => withList(document2, "keep_out", [...regionsOf(document2), region]);
var setRegion = (document2, index, changes) => withList(document2, "keep_out", replaced(regionsOf(document2), index, withKeys(regionsOf(document2)[index], changes)));
var removeRegion = (document2, index) => withList(document2, "keep_out", without(regionsOf(document2), index));
var setSurrounding = (document2, key, value) => withKeys(document2, { surroundings: filled(withKeys(document2.surroundings ?? {}, { [key]: value })) });
var limitsOf = (document2) => document2.limits === void 0 ? [] : [document2.limits].flat();
function setLimit(document2, index, changes) {
  const tables = limitsOf(document2), changed = withKeys(tables[index] ?? {}, changes);
  const all = index < tables.length ? replaced(tables, index, changed) : [...tables, changed];
  const kept = all.length > 1 || filled(changed) ? all : [];
  return withKeys(document2, { limits: kept.length > 1 ? kept : kept[0] });
}
function splitLimits(document2, apart) {
  const tables = limitsOf(document2);
  if (!apart) return withKeys(document2, { limits: tables[0] && filled(tables[0]) });
  return tables.length > 1 ? document2 : withKeys(document2, { limits: [tables[0] ?? {}, tables[0] ?? {}] });
}
var limitRegions = (document2) => limitsOf(document2).flatMap(
  (table, index) => ["fixed_pivot", "moving_pivot"].filter((key) => table[key]).map((key) => {
    const [[shape, points]] = Object.entries(table[key]);
    return { table: index, key, shape, points: shape === "point" ? [points] : points };
  })
);
var shapeOf = (shape, points) => ({ [shape]: shape === "point" ? points[0] : points });
var setRequirement = (document2, key, value) => withKeys(document2, { requirements: filled(withKeys(document2.requirements ?? {}, { [key]: value })) });
function component(poses, index, key) {
  if (Number.isFinite(poses[index][key])) return poses[index][key];
  const before = poses.slice(0, index).findLastIndex((pose) => Number.isFinite(pose[key]));
  const behind = poses.slice(index + 1).findIndex((pose) => Number.isFinite(pose[key])) + index + 1;
  const [a, b] = [poses[before]?.[key], behind > index ? poses[behind][key] : void 0];
  if (a === void 0 || b === void 0) return a ?? b ?? 0;
  return a + (index - before) / (behind - before) * (b - a);
}
function standing({ poses }, index) {
  const { x, y, angle } = poses[index];
  if (Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(angle)) return { x, y, angle };
  return { x: component(poses, index, "x"), y: component(poses, index, "y"), angle: component(poses, index, "angle") };
}
var poseName = ({ poses }, index) => poses[index]?.name ?? String(index + 1);
var statedOf = (pose, changes) => Object.fromEntries(Object.entries(changes).filter(([key]) => Number.isFinite(pose[key])));

// src/burmester/web/widget/tables.mjs
var shortened = (text, most) => text.length > most ? `${text.slice(0, most - 1).trimEnd()}…` : text;

// src/burmester/web/studio/scene.mjs
var LAYERS = ["grid", "regions", "ghosts", "map", "curves", "paths", "mechanism", "limits", "pivots", "poses", "labels", "tool"];
var MARGIN = 46;
var ZOOM = 1.0018;
var WIDEST = 1e6;
var CLICK = 4;
var SPARE = 0.5;
var Scene = class {
  constructor(store) {
    this.store = store;
    this.listeners = { view: [], click: [], tool: [] };
    this.tool = null;
    this.dragged = null;
    this.layers = new Map(LAYERS.map((name) => [name, s("g", { class: `bs-layer bs-layer-${name}` })]));
    this.layers.get("grid").setAttribute("aria-hidden", "true");
    this.svg = s("svg", { class: "bs-scene", tabindex: 0, role: "group", "aria-label": "The plane: poses, linkage and limits. Arrow keys pan, plus and minus zoom, 0 fits." }, ...this.layers.values());
    this.element = h("div", { class: "bs-plane" }, this.svg);
    this.size = { width: 640, height: 480 };
    this.origin = { scale: 1, left: 320, top: 240 };
    this.isFitted = true;
    this.pointers = /* @__PURE__ */ new Map();
    this.boxes = [];
    this.update();
    this.listen();
    store.on("document", () => this.unit === store.document.length_unit || this.grid());
    new ResizeObserver(() => this.resize()).observe(this.element);
  }
  layer(name) {
    return this.layers.get(name);
  }
  /** "view": after it changes; "click": on the empty plane, with a point and the event; "tool": another tool, or none. */
  on(name, fn) {
    this.listeners[name].push(fn);
  }
  emit(name, ...values) {
    return this.listeners[name].map((fn) => fn(...values)).some(Boolean);
  }
  /** `fn` returns points of F that a fit has to hold; far: as far as they leave room for handles. */
  hold(fn, far = false) {
    this.boxes.push({ fn, far });
  }
  // The view
  update() {
    const { width, height } = this.size, { scale, left, top } = this.origin;
    this.view = {
      scale,
      left,
      top,
      width,
      height,
      X: (x) => left + scale * x,
      Y: (y) => top - scale * y,
      x: (X) => (X - left) / scale,
      y: (Y) => (top - Y) / scale
    };
    Object.assign(this.svg.dataset, { scale, left, top });
    this.grid();
    this.emit("view", this.view);
  }
  resize() {
    const { width, height } = this.svg.getBoundingClientRect();
    if (!width || !height || width === this.size.width && height === this.size.height) return;
    this.origin = { ...this.origin, left: this.origin.left + (width - this.size.width) / 2, top: this.origin.top + (height - this.size.height) / 2 };
    this.size = { width, height };
    this.svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    if (this.isFitted) this.fit(this.isWhole);
    else this.update();
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
  /** Show what is held; what is far as well where all of it is wanted. */
  fit(whole = false) {
    const pointsOf = (isFar) => this.boxes.filter(({ far: far2 }) => far2 === isFar).flatMap(({ fn }) => fn());
    const near = pointsOf(false), far = pointsOf(true), all = bounds([...near, ...far]);
    let [x, y, u, v] = near.length && !whole ? bounds(near) : Number.isFinite(all[0]) ? all : [-50, -50, 50, 50];
    const size2 = Math.max(u - x, v - y) || Math.max(1, Math.abs(u), Math.abs(v));
    if (near.length && far.length && !whole) {
      const reach = SPARE * size2;
      [x, y, u, v] = [Math.max(all[0], x - reach), Math.max(all[1], y - reach), Math.min(all[2], u + reach), Math.min(all[3], v + reach)];
    }
    this.isWhole = whole;
    const { width, height } = this.size, margin = Math.min(MARGIN, width / 8);
    const scale = Math.min((width - 2 * margin) / Math.max(u - x, 0.1 * size2), (height - 2 * margin) / Math.max(v - y, 0.1 * size2));
    this.fittedScale = scale;
    this.origin = { scale, left: width / 2 - scale * (x + u) / 2, top: height / 2 + scale * (y + v) / 2 };
    this.isFitted = true;
    this.update();
  }
  /** Fit; and where that is done already, all or not all. */
  fitAgain() {
    this.fit(this.isFitted && !this.isWhole);
  }
  grid() {
    const { view } = this, { width, height } = view, group = this.layer("grid");
    const name = this.unit = this.store.document.length_unit, unit = name ? ` ${name}` : "";
    const across = ticks(view.x(0), view.x(width), width / 110), up = ticks(view.y(height), view.y(0), height / 80);
    const lines = [...across.map(({ at }) => `M${px(view.X(at))} 0V${height}`), ...up.map(({ at }) => `M0 ${px(view.Y(at))}H${width}`)];
    const origin = `M${px(clamp(view.X(0), -9, width + 9))} 0V${height}M0 ${px(clamp(view.Y(0), -9, height + 9))}H${width}`;
    group.replaceChildren(
      s("path", { class: "bs-grid-line", d: lines.join("") }),
      s("path", { class: "bs-grid-axis", d: origin }),
      ...across.filter(({ at }) => view.X(at) > 46 && view.X(at) < width - (unit ? 54 : 30)).map(({ at, text }) => s("text", { x: px(view.X(at)), y: height - 6, "text-anchor": "middle" }, text)),
      ...up.filter(({ at }) => view.Y(at) > 30 && view.Y(at) < height - 24).map(({ at, text }) => s("text", { x: 6, y: px(view.Y(at) - 4) }, text)),
      s("text", { x: 6, y: 14 }, `y${unit}`),
      s("text", { x: width - 6, y: height - 6, "text-anchor": "end" }, `x${unit}`)
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
    const { left, top } = this.svg.getBoundingClientRect(), X = event.clientX - left, Y = event.clientY - top;
    return { X, Y, x: this.view.x(X), y: this.view.y(Y) };
  }
  /** Drag an element: start(point, event) may return false; move(point, event); end(point); cancel() at Escape.
   *
   * A press that does not move is a click: click(event), and nothing is dragged.
   */
  drag(element, { start = () => true, move, end = () => {
  }, cancel = () => {
  }, click = () => {
  } }) {
    element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || this.tool || this.dragged) return;
      event.preventDefault();
      event.stopPropagation();
      element.focus?.({ preventScroll: true });
      const from = this.at(event), ended = new AbortController(), { signal } = ended;
      let begun = false;
      const stop = (finish) => {
        ended.abort();
        this.dragged = null;
        this.svg.classList.remove("bs-grasped");
        if (this.svg.hasPointerCapture?.(event.pointerId)) this.svg.releasePointerCapture(event.pointerId);
        finish();
      };
      this.dragged = { cancel: () => stop(() => begun && cancel()) };
      this.capture(event);
      const on = (name, fn) => this.svg.addEventListener(name, (each) => each.pointerId === event.pointerId && fn(each), { signal });
      on("pointermove", (each) => {
        const point = this.at(each);
        if (!begun) {
          if (Math.hypot(point.X - from.X, point.Y - from.Y) < CLICK) return;
          begun = start(from, event) !== false;
          if (!begun) return stop(() => {
          });
          this.svg.classList.add("bs-grasped");
        }
        move(point, each);
      });
      on("pointerup", (each) => stop(() => begun ? end(this.at(each)) : click(event)));
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
      event.preventDefault();
      const { X, Y } = this.at(event), unit = event.deltaMode === 1 ? 16 : 1;
      this.zoom(ZOOM ** (-event.deltaY * unit * (event.ctrlKey ? 4 : 1)), X, Y);
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
    }
  }
  press(event) {
    if (event.button !== 0 && event.button !== 1) return;
    const { X, Y } = this.at(event);
    this.pointers.set(event.pointerId, { X, Y, from: { X, Y }, button: event.button });
    if (this.pointers.size > 1) for (const each of this.pointers.values()) each.panned = true;
    this.capture(event);
  }
  moved(event) {
    const point = this.at(event), held = this.pointers.get(event.pointerId);
    if (!held) {
      if (!this.dragged) this.tool?.hover?.(point);
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
    if (this.tool?.drag?.(point, held)) return;
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
    else if (held.panned) this.tool?.release?.(point, held);
    else if (held.button === 0) this.tool ? this.tool.click(point, event) : this.emit("click", point, event);
  }
  key(event) {
    if (event.target !== this.svg || event.ctrlKey || event.metaKey || event.altKey) return;
    const by = event.shiftKey ? 160 : 40, { width, height } = this.size;
    const steps = { ArrowLeft: [by, 0], ArrowRight: [-by, 0], ArrowUp: [0, by], ArrowDown: [0, -by] };
    if (steps[event.key]) this.pan(...steps[event.key]);
    else if (event.key === "+" || event.key === "=") this.zoom(1.25, width / 2, height / 2);
    else if (event.key === "-") this.zoom(0.8, width / 2, height / 2);
    else if (event.key === "0") this.fitAgain();
    else return;
    event.preventDefault();
  }
};
var bounds = (points) => points.reduce(([x, y, u, v], [a, b]) => Number.isFinite(a + b) ? [Math.min(x, a), Math.min(y, b), Math.max(u, a), Math.max(v, b)] : [x, y, u, v], [Infinity, Infinity, -Infinity, -Infinity]);
var Kept = class {
  constructor(group, make, show) {
    Object.assign(this, { group, make, show, elements: /* @__PURE__ */ new Map() });
  }
  draw(items) {
    const kept = /* @__PURE__ */ new Map();
    for (const [key, item] of items) {
      const element = this.elements.get(key) ?? this.make(key, item);
      kept.set(key, element);
      this.show(element, item);
    }
    for (const [key, element] of this.elements) if (!kept.has(key)) element.remove();
    let before = null;
    for (const element of kept.values()) {
      const next = before ? before.nextSibling : this.group.firstChild;
      if (element !== next || element.parentNode !== this.group) this.group.insertBefore(element, next);
      before = element;
    }
    this.elements = kept;
  }
};

// src/burmester/web/studio/pose_handles.mjs
var LONGEST_ARM = 46;
var SHORTEST_ARM = 27;
var MOST = 240;
var LONGEST_NAME = 18;
var ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
var tenths = (angle) => Number(angle.toFixed(1)) + 0;
var unwrapped = (angle, near) => angle + 360 * Math.round((near - angle) / 360);
function drawnPoses(store) {
  const count = store.document.poses.length, stride = Math.ceil(count / MOST);
  const chosen = store.selection?.kind === "pose" ? store.selection.index : -1;
  return [...store.document.poses.keys()].filter((k) => k % stride === 0 || k === count - 1 || k === chosen);
}
var PoseHandles = class {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.element = scene.layer("poses");
    this.names = scene.layer("labels");
    this.kept = new Kept(this.element, (k) => this.make(k), (group, k) => this.show(group, k));
    this.labels = new Kept(this.names, () => s("text", { class: "bs-pose-name" }), (text, k) => this.showName(text, k));
    store.on("document selection", () => this.draw());
    scene.on("view", () => this.draw());
    scene.hold(() => store.document.poses.map((_, k) => standing(store.document, k)).map(({ x, y }) => [x, y]));
    scene.on("click", () => store.select(null));
    this.draw();
  }
  /** Arms are shorter where poses are crowded: about the distance from one to the next. */
  get arm() {
    const { document: document2 } = this.store, { scale } = this.scene.view, places = drawnPoses(this.store).map((k) => standing(document2, k));
    const away = places.slice(1).map(({ x, y }, k) => scale * Math.hypot(x - places[k].x, y - places[k].y)).sort((a, b) => a - b);
    return away.length ? clamp(1.2 * away[away.length >> 1], SHORTEST_ARM, LONGEST_ARM) : LONGEST_ARM;
  }
  draw() {
    this.length = this.scene.dragged ? this.length ?? this.arm : this.arm;
    const poses = drawnPoses(this.store).map((k) => [k, k]);
    this.kept.draw(poses);
    this.labels.draw(poses);
  }
  make(k) {
    const origin = s("g", { class: "bs-origin", "data-pose": k + 1, tabindex: 0, role: "button" }, s("circle", { class: "bs-hold", r: 12 }), s("circle", { class: "bs-dot", r: 5.5 }));
    const turn = s(
      "g",
      { class: "bs-turn", "data-turn": k + 1, tabindex: 0, role: "slider", "aria-valuemin": -360, "aria-valuemax": 360 },
      s("circle", { class: "bs-hold", r: 12 }),
      s("circle", { class: "bs-tip", r: 5 })
    );
    const group = s("g", { class: "bs-pose" }, s("path", { class: "bs-axes" }), origin, turn);
    this.dragOrigin(origin, k);
    this.dragTurn(turn, k);
    for (const part of [origin, turn]) part.addEventListener("focus", () => this.store.select({ kind: "pose", index: k }));
    origin.addEventListener("keydown", (event) => this.key(event, k, false));
    turn.addEventListener("keydown", (event) => this.key(event, k, true));
    return group;
  }
  show(group, k) {
    const { store, scene: { view } } = this, { x, y, angle } = standing(store.document, k), pose = store.document.poses[k];
    const [arrow, origin, turn] = group.children;
    const selected = store.selection?.kind === "pose" && store.selection.index === k;
    group.setAttribute("transform", transform(view.X(x), view.Y(y), radians(angle)));
    arrow.setAttribute("d", axes(this.length - 8));
    turn.setAttribute("transform", `translate(${px(this.length)} 0)`);
    group.classList.toggle("bs-selected", selected);
    group.classList.toggle("bs-exact", Boolean(pose.exact));
    const unit = store.document.length_unit ?? "", name = poseName(store.document, k);
    const called = pose.name ? `Pose ${k + 1}, ${name}` : `Pose ${k + 1}`;
    origin.setAttribute("aria-label", `${called}: x ${x} ${unit}, y ${y} ${unit}, angle ${angle}°. Drag, or use the arrow keys; Delete removes it.`);
    origin.setAttribute("aria-pressed", selected);
    turn.setAttribute("aria-label", `Turn ${called}`);
    turn.setAttribute("aria-valuenow", angle);
    turn.setAttribute("aria-valuetext", `${angle}°`);
  }
  /** Names stand behind the origin, away from the x axis. */
  showName(text, k) {
    const { store, scene: { view } } = this, { x, y, angle } = standing(store.document, k), a = radians(angle + 215);
    const name = shortened(poseName(store.document, k), LONGEST_NAME);
    if (text.textContent !== name) text.textContent = name;
    text.setAttribute("text-anchor", Math.cos(a) < -0.3 ? "end" : Math.cos(a) > 0.3 ? "start" : "middle");
    text.setAttribute("x", px(view.X(x) + 13 * Math.cos(a)));
    text.setAttribute("y", px(view.Y(y) - 13 * Math.sin(a) + 4));
  }
  /** A change of one pose; what is free and not stated stays free. */
  set(k, changes, gesture) {
    this.store.edit((document2) => setPose(document2, k, statedOf(document2.poses[k], changes)), { gesture });
  }
  dragOrigin(element, k) {
    const { store, scene } = this;
    let gesture, off;
    scene.drag(element, {
      start: (from) => {
        const { x, y } = standing(store.document, k);
        gesture = /* @__PURE__ */ Symbol("move a pose");
        off = [x - from.x, y - from.y];
      },
      move: (point) => this.set(k, { x: scene.rounded(point.x + off[0]), y: scene.rounded(point.y + off[1]) }, gesture),
      cancel: () => store.abandon(gesture)
    });
  }
  dragTurn(element, k) {
    const { store, scene } = this;
    let gesture, off;
    const angleTo = (point) => {
      const { x, y } = standing(store.document, k);
      return degrees(Math.atan2(point.y - y, point.x - x));
    };
    scene.drag(element, {
      start: (from) => {
        gesture = /* @__PURE__ */ Symbol("turn a pose");
        off = standing(store.document, k).angle - angleTo(from);
      },
      move: (point) => this.set(k, { angle: tenths(unwrapped(angleTo(point) + off, standing(store.document, k).angle)) }, gesture),
      cancel: () => store.abandon(gesture)
    });
  }
  key(event, k, turning) {
    const { store, scene } = this, arrow = ARROWS[event.key];
    if (event.ctrlKey || event.metaKey) return;
    if (arrow) {
      if (!event.repeat) this.keyed = /* @__PURE__ */ Symbol("keys");
      const { x, y, angle } = standing(store.document, k), by = stepOf(event, turning ? 1 : scene.step);
      if (turning) this.set(k, { angle: stepped(angle, by * (arrow[0] === 0 ? arrow[1] : -arrow[0])) }, this.keyed);
      else this.set(k, { x: stepped(x, by * arrow[0]), y: stepped(y, by * arrow[1]) }, this.keyed);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      store.edit((document2) => removePose(document2, k));
      const left = store.document.poses.length;
      store.select(left ? { kind: "pose", index: Math.min(k, left - 1) } : null);
      this.focus(Math.min(k, left - 1));
    } else {
      return;
    }
    event.preventDefault();
  }
  focus(k) {
    this.element.querySelector(`[data-pose="${k + 1}"]`)?.focus({ preventScroll: true });
  }
};
var PoseTool = class {
  constructor(store, scene) {
    Object.assign(this, { store, scene, name: "pose", gesture: null });
    this.hint = "Click where the pose is to stand, and click again to turn it. Escape ends.";
  }
  click(point) {
    const { store, scene } = this;
    if (this.gesture) {
      this.turn(point);
      this.gesture = null;
      return;
    }
    this.gesture = /* @__PURE__ */ Symbol("add a pose");
    const angle = store.document.poses.at(-1)?.angle ?? 0;
    store.edit((document2) => addPose(document2, { x: scene.rounded(point.x), y: scene.rounded(point.y), angle }), { gesture: this.gesture });
    store.select({ kind: "pose", index: store.document.poses.length - 1 });
  }
  hover(point) {
    if (this.gesture && point) this.turn(point);
  }
  turn(point) {
    const { store, gesture } = this, k = store.document.poses.length - 1, { x, y, angle } = standing(store.document, k);
    const away = Math.hypot(point.x - x, point.y - y) * this.scene.view.scale;
    if (away < 6) return;
    const next = tenths(unwrapped(degrees(Math.atan2(point.y - y, point.x - x)), angle));
    store.edit((document2) => setPose(document2, k, { angle: next }), { gesture });
  }
  key(event) {
    if (event.key !== "Escape") return false;
    if (this.gesture) this.store.abandon(this.gesture);
    this.gesture = null;
    this.scene.use(null);
    return true;
  }
};

// src/burmester/web/studio/region_geometry.mjs
var cross = ([a, b], [c, d]) => a * d - b * c;
var minus = ([a, b], [c, d]) => [a - c, b - d];
var size = ([a, b]) => Math.hypot(a, b);
function fromSegment(point, start, end) {
  const along = minus(end, start), away = minus(point, start), square = along[0] ** 2 + along[1] ** 2;
  const share = square > 0 ? Math.min(1, Math.max(0, (along[0] * away[0] + along[1] * away[1]) / square)) : 0;
  return size(minus(away, [share * along[0], share * along[1]]));
}
var boxCorners = ([[a, b], [c, d]]) => [[a, b], [c, b], [c, d], [a, d]];
var outlineOf = (shape, points) => shape === "box" ? boxCorners(points) : points;
function isInside([x, y], corners) {
  let inside = false;
  corners.forEach(([a, b], k) => {
    const [c, d] = corners[(k + 1) % corners.length];
    if (b > y !== d > y && x < a + (y - b) / (d - b) * (c - a)) inside = !inside;
  });
  return inside;
}
function distanceTo(point, shape, points) {
  if (shape === "point") return size(minus(point, points[0]));
  if (shape === "segment") return fromSegment(point, ...points);
  if (shape === "line") {
    const along = minus(points[1], points[0]);
    return Math.abs(cross(along, minus(point, points[0]))) / size(along);
  }
  const corners = outlineOf(shape, points);
  if (isInside(point, corners)) return 0;
  return Math.min(...corners.map((corner, k) => fromSegment(point, corner, corners[(k + 1) % corners.length])));
}
var crosses = (a, b, c, d) => {
  const turn = (p, q, r) => Math.sign(cross(minus(q, p), minus(r, p)));
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
};
var edges = (corners) => corners.map((corner, k) => [corner, corners[(k + 1) % corners.length]]);
function overlap(one, other) {
  if (isInside(one[0], other) || isInside(other[0], one)) return true;
  return edges(one).some(([a, b]) => edges(other).some(([c, d]) => crosses(a, b, c, d)));
}
function segmentFromPolygon([start, end], corners) {
  if (isInside(start, corners) || edges(corners).some(([c, d]) => crosses(start, end, c, d))) return 0;
  return Math.min(
    ...edges(corners).map(([c, d]) => Math.min(fromSegment(start, c, d), fromSegment(end, c, d), fromSegment(c, start, end), fromSegment(d, start, end)))
  );
}

// src/burmester/web/studio/shape_handles.mjs
var ARROWS2 = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
var LEAST_CORNERS = 3;
var CLOSED = /* @__PURE__ */ new Set(["box", "polygon"]);
var GROUND = { x: 0, y: 0, a: 0 };
function pathOf(shape, points, place, view) {
  const seen2 = outlineOf(shape, points).map((point) => act(place, point)).map(([x, y]) => [view.X(x), view.Y(y)]);
  if (shape === "point") return `M${px(seen2[0][0] - 7)} ${px(seen2[0][1])}h14m-7 -7v14`;
  if (shape === "line") {
    const [[a, b], [c, d]] = seen2, size2 = Math.hypot(c - a, d - b) || 1, far = view.width + view.height + Math.hypot(a, b);
    const [u, v] = [far * (c - a) / size2, far * (d - b) / size2];
    return `M${px(a - u)} ${px(b - v)}L${px(c + u)} ${px(d + v)}`;
  }
  return `M${seen2.map((point) => point.map(px).join(" ")).join("L")}${CLOSED.has(shape) ? "Z" : ""}`;
}
function withCorner(shape, points, k, to) {
  if (shape !== "box") return points.map((point, i) => i === k ? to : point);
  const opposite = boxCorners(points)[(k + 2) % 4];
  return [[Math.min(to[0], opposite[0]), Math.min(to[1], opposite[1])], [Math.max(to[0], opposite[0]), Math.max(to[1], opposite[1])]];
}
var ShapeHandles = class {
  constructor(scene, { what, set, remove, select, abandon, className = "" }) {
    Object.assign(this, { scene, what, set, remove, select, abandon });
    this.title = s("title");
    this.area = s("path", { class: "bs-shape-area", tabindex: 0, role: "button" }, this.title);
    this.line = s("path", { class: "bs-shape-line" });
    this.element = s("g", { class: `bs-shape ${className}` }, this.line, this.area);
    this.middles = new Kept(s("g"), (key, k) => this.makeMiddle(k), (element, k) => this.showMiddle(element, k));
    this.corners = new Kept(s("g"), (key, k) => this.makeCorner(k), (element, k) => this.showCorner(element, k));
    this.handles = s("g", { class: "bs-corners" }, this.middles.group, this.corners.group);
    this.dragWhole();
    this.area.addEventListener("focus", () => this.select());
    this.area.addEventListener("keydown", (event) => this.keys(event, (points, by) => points.map(([x, y]) => [stepped(x, by[0]), stepped(y, by[1])]), () => this.remove()));
  }
  draw() {
    const { shape, points, place, name, selected, state, data } = this.now = this.what();
    const d = pathOf(shape, points, place, this.scene.view);
    this.line.setAttribute("d", d);
    this.area.setAttribute("d", d);
    this.area.classList.toggle("bs-open", !CLOSED.has(shape));
    this.area.setAttribute("aria-label", `${name}${state ? `, ${state} by the chosen linkage` : ""}. Drag, or use the arrow keys; Delete removes it.`);
    this.area.setAttribute("aria-pressed", Boolean(selected));
    this.title.textContent = name;
    for (const [key2, value2] of Object.entries(data)) this.element.dataset[key2] = value2;
    this.element.dataset.shape = shape;
    this.element.classList.toggle("bs-selected", Boolean(selected));
    this.element.classList.toggle("bs-met", state === "met");
    this.element.classList.toggle("bs-broken", state === "broken");
    const [[key, value]] = Object.entries(data);
    this.handles.dataset.handles = `${key} ${value}`.trim();
    if (!this.handles.parentNode) this.scene.layer("tool").append(this.handles);
    const count = selected ? outlineOf(shape, points).length : 0, edges2 = shape === "polygon" ? count : 0;
    this.corners.draw([...Array(count).keys()].map((k) => [k, k]));
    this.middles.draw([...Array(edges2).keys()].map((k) => [k, k]));
  }
  /** Where the shape is no more. */
  clear() {
    this.element.remove();
    this.handles.remove();
  }
  at([x, y]) {
    const [u, v] = act(this.now.place, [x, y]);
    return { cx: px(this.scene.view.X(u)), cy: px(this.scene.view.Y(v)) };
  }
  /** A point of an event in the frame of the shape, as a hand sets it. */
  point({ x, y }) {
    return back(this.now.place, [x, y]).map((each) => this.scene.rounded(each));
  }
  dragWhole() {
    let gesture, from, before;
    this.scene.drag(this.area, {
      start: (point) => {
        gesture = /* @__PURE__ */ Symbol("move a shape");
        from = back(this.now.place, [point.x, point.y]);
        before = this.now.points;
      },
      move: (point) => {
        const to = back(this.now.place, [point.x, point.y]), by = [to[0] - from[0], to[1] - from[1]];
        this.set(before.map(([x, y]) => [this.scene.rounded(x + by[0]), this.scene.rounded(y + by[1])]), gesture);
      },
      cancel: () => this.abandon(gesture),
      click: () => this.select()
    });
  }
  makeCorner(k) {
    const circle = s("circle", { class: "bs-corner", r: 6, tabindex: 0, role: "button", "data-corner": k + 1 });
    let gesture;
    this.scene.drag(circle, {
      start: () => (gesture = /* @__PURE__ */ Symbol("move a corner")) && true,
      move: (point) => this.set(withCorner(this.now.shape, this.now.points, k, this.point(point)), gesture),
      cancel: () => this.abandon(gesture)
    });
    circle.addEventListener("keydown", (event) => this.keys(event, (points, by) => {
      const [x, y] = outlineOf(this.now.shape, points)[k];
      return withCorner(this.now.shape, points, k, [stepped(x, by[0]), stepped(y, by[1])]);
    }, () => this.removeCorner(k)));
    return circle;
  }
  removeCorner(k) {
    const { shape, points } = this.now;
    if (shape !== "polygon" || points.length <= LEAST_CORNERS) return;
    this.set(points.filter((_, i) => i !== k), null);
  }
  /** The middle of an edge makes a corner when it is dragged. */
  makeMiddle(k) {
    const circle = s("circle", { class: "bs-middle", r: 4.5, "data-edge": k + 1 });
    let gesture;
    this.scene.drag(circle, {
      start: () => {
        gesture = /* @__PURE__ */ Symbol("add a corner");
        this.set([...this.now.points.slice(0, k + 1), this.now.points[k], ...this.now.points.slice(k + 1)], gesture);
      },
      move: (point) => this.set(withCorner("polygon", this.now.points, k + 1, this.point(point)), gesture),
      cancel: () => this.abandon(gesture)
    });
    return circle;
  }
  showCorner(element, k) {
    const corner = outlineOf(this.now.shape, this.now.points)[k];
    for (const [name, value] of Object.entries(this.at(corner))) element.setAttribute(name, value);
    element.setAttribute("aria-label", `Corner ${k + 1} of ${this.now.name}: ${corner.join(", ")}`);
  }
  showMiddle(element, k) {
    const { points } = this.now, next = points[(k + 1) % points.length];
    const middle2 = this.at([(points[k][0] + next[0]) / 2, (points[k][1] + next[1]) / 2]);
    for (const [name, value] of Object.entries(middle2)) element.setAttribute(name, value);
  }
  keys(event, moved, remove) {
    if (event.ctrlKey || event.metaKey) return;
    const arrow = ARROWS2[event.key];
    if (arrow) {
      if (!event.repeat) this.keyed = /* @__PURE__ */ Symbol("keys");
      const by = stepOf(event, this.scene.step);
      this.set(moved(this.now.points, [by * arrow[0], by * arrow[1]]), this.keyed);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      remove();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }
};

// src/burmester/web/studio/shape_tool.mjs
var CLOSE = 12;
var PAIRS = /* @__PURE__ */ new Set(["segment", "line", "box"]);
var HINTS = {
  point: "Click the point. Enter puts it in the middle, Escape gives up.",
  segment: "Click both ends. Enter puts one in the middle, Escape gives up.",
  line: "Click two points of the line. Enter puts one in the middle, Escape gives up.",
  box: "Drag from corner to corner, or click both. Enter puts one in the middle, Escape gives up.",
  polygon: "Click the corners; Enter or a click on the first one closes. Backspace takes the last one back, Escape gives up."
};
var MIDDLE = { point: [[0, 0]], segment: [[-1, 0], [1, 0]], line: [[-1, 0], [1, 0]], box: [[-1, -1], [1, 1]], polygon: [[-1, -1], [1, -1], [0, 1]] };
var SHARE = 0.12;
var ordered = ([[a, b], [c, d]]) => [[Math.min(a, c), Math.min(b, d)], [Math.max(a, c), Math.max(b, d)]];
var isFlat = ([[a, b], [c, d]]) => a === c && b === d;
var ShapeTool = class {
  constructor(scene, { shape, place, done, name }) {
    Object.assign(this, { scene, shape, place, done, name, points: [], next: null });
    this.hint = HINTS[shape];
    this.path = s("path", { class: "bs-draft" });
    this.dots = s("g");
    this.element = s("g", {}, this.path, this.dots);
    scene.layer("tool").append(this.element);
  }
  point({ x, y }) {
    return back(this.place(), [x, y]).map((each) => this.scene.rounded(each));
  }
  click(point, event) {
    const next = this.point(point);
    if (this.shape === "polygon") {
      if (this.points.length > 2 && (this.isFirst(point) || event?.detail > 1)) return this.finish(this.points);
      if (this.points.length && isFlat([this.points.at(-1), next])) return void 0;
    }
    this.points.push(next);
    if (this.shape === "point" || PAIRS.has(this.shape) && this.points.length === 2) return this.finish(this.points);
    return this.draw();
  }
  isFirst({ X, Y }) {
    const [x, y] = act(this.place(), this.points[0]), { view } = this.scene;
    return Math.hypot(view.X(x) - X, view.Y(y) - Y) < CLOSE;
  }
  hover(point) {
    this.next = point && this.point(point);
    this.draw();
  }
  /** Two points are drawn by a drag as well; of a polygon a drag moves the plane. */
  drag(point, held) {
    if (!PAIRS.has(this.shape) || this.points.length) return false;
    this.dragging = [this.point(this.inPlane(held.from)), this.point(point)];
    this.draw();
    return true;
  }
  inPlane({ X, Y }) {
    return { x: this.scene.view.x(X), y: this.scene.view.y(Y) };
  }
  /** A shape in the middle of the picture, to be moved by keys. */
  inMiddle() {
    const { width, height } = this.scene.size, half = SHARE * Math.min(width, height);
    return MIDDLE[this.shape].map(([x, y]) => this.point(this.inPlane({ X: width / 2 + half * x, Y: height / 2 - half * y })));
  }
  release() {
    if (!this.dragging) return;
    const pair = this.dragging;
    this.dragging = null;
    this.finish(pair);
  }
  finish(points) {
    if (PAIRS.has(this.shape) && isFlat(points)) {
      this.points = points.slice(0, 1);
      return this.draw();
    }
    this.scene.use(null);
    return this.done(this.shape === "box" ? ordered(points) : points);
  }
  key(event) {
    if (event.key === "Escape") this.scene.use(null);
    else if (event.key === "Backspace") this.points.pop();
    else if (event.key === "Enter" && !this.points.length) this.finish(this.inMiddle());
    else if (event.key === "Enter" && this.points.length > 2) this.finish(this.points);
    else return false;
    this.draw();
    return true;
  }
  draw() {
    const { scene: { view }, shape } = this, shown = this.dragging ?? [...this.points, ...this.next ? [this.next] : []];
    const place = this.place(), whole = shape === "polygon" ? "open polygon" : shape;
    const complete = shown.length > 1 || shape === "point";
    this.path.setAttribute("d", complete && shown.length ? pathOf(whole, shown, place, view) : "");
    this.dots.replaceChildren(
      ...(this.dragging ?? this.points).map((point) => act(place, point)).map(([x, y], k) => s("circle", { class: k ? "bs-draft-dot" : "bs-draft-dot bs-first", r: 4, cx: px(view.X(x)), cy: px(view.Y(y)) }))
    );
  }
  end() {
    this.element.remove();
  }
};

// src/burmester/web/studio/body_editor.mjs
var MOST_GHOSTS = 60;
var PALEST = 0.4;
function referenceIndex(store) {
  const { selection, document: document2 } = store;
  if (selection?.kind === "pose" && selection.index < document2.poses.length) store.reference = selection.index;
  return Math.min(store.reference ?? 0, document2.poses.length - 1);
}
function referencePlace(store) {
  const k = referenceIndex(store);
  if (k < 0) return { x: 0, y: 0, a: 0 };
  const { x, y, angle } = standing(store.document, k);
  return { x, y, a: radians(angle) };
}
var BodyEditor = class {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.ghosts = new Kept(s("g", { class: "bs-ghosts", "aria-hidden": "true" }), () => s("path", { class: "bs-ghost" }), (path, item) => this.showGhost(path, item));
    scene.layer("ghosts").append(this.ghosts.group);
    this.handles = new ShapeHandles(scene, {
      className: "bs-body-shape",
      what: () => ({ shape: "polygon", points: bodyOf(store.document), place: referencePlace(store), name: "Outline of the body", selected: store.selection?.kind === "body", data: { body: "" } }),
      set: (points, gesture) => store.edit((document2) => setBody(document2, points), { gesture }),
      remove: () => store.edit((document2) => setBody(document2, [])),
      select: () => store.select({ kind: "body", index: 0 }),
      abandon: (gesture) => store.abandon(gesture)
    });
    store.on("document selection", () => this.draw());
    scene.on("view", () => this.draw());
    scene.hold(() => this.corners(), true);
    this.draw();
  }
  corners() {
    const body = bodyOf(this.store.document);
    return this.indices().flatMap((k) => {
      const { x, y, angle } = standing(this.store.document, k);
      return body.map((corner) => act({ x, y, a: radians(angle) }, corner));
    });
  }
  indices() {
    const drawn = drawnPoses(this.store), stride = Math.ceil(drawn.length / MOST_GHOSTS);
    return drawn.filter((_, i) => i % stride === 0 || i === drawn.length - 1);
  }
  draw() {
    const body = bodyOf(this.store.document), { scale } = this.scene.view;
    this.path = body.length ? `M${body.map(([x, y]) => `${px(scale * x)} ${px(-scale * y)}`).join("L")}Z` : "";
    this.ghosts.draw(body.length ? this.indices().map((k) => [k, k]) : []);
    if (!body.length || !this.store.document.poses.length) return this.handles.clear();
    if (!this.handles.element.parentNode) this.scene.layer("ghosts").append(this.handles.element);
    return this.handles.draw();
  }
  showGhost(path, k) {
    const { view } = this.scene, { x, y, angle } = standing(this.store.document, k), last = Math.max(1, this.store.document.poses.length - 1);
    if (path.getAttribute("d") !== this.path) path.setAttribute("d", this.path);
    path.setAttribute("opacity", (PALEST + (1 - PALEST) * k / last).toFixed(3));
    path.setAttribute("transform", transform(view.X(x), view.Y(y), radians(angle)));
  }
  /** Draw an outline by clicks, at the pose that is selected or the first one. */
  tool() {
    return new ShapeTool(this.scene, {
      shape: "polygon",
      name: "body",
      place: () => referencePlace(this.store),
      done: (points) => {
        this.store.edit((document2) => setBody(document2, points));
        this.store.select({ kind: "body", index: 0 });
      }
    });
  }
};

// src/burmester/web/studio/conditions.mjs
var ROUNDING = 1e-6;
var MOST_PLACES = 90;
var KEYS = ["fixed_pivot", "moving_pivot"];
function currentLinkage(store) {
  if (store.chosen === "placed") return store.placed?.linkage ?? null;
  const followed = store.followed?.linkages.find(({ id }) => id === store.chosen);
  if (followed) return followed;
  if (store.followed?.vanished?.some(({ id }) => id === store.chosen)) return null;
  return store.solved?.linkages.find(({ id }) => id === store.chosen) ?? null;
}
var PIVOT = { fixed_pivot: "fixed pivot", moving_pivot: "moving pivot" };
function missed(table, dyad, slack) {
  const found = [];
  for (const key of KEYS) {
    if (!table[key]) continue;
    const [[shape, stated]] = Object.entries(table[key]), points = shape === "point" ? [stated] : stated;
    const away = dyad[key] ? distanceTo(dyad[key], shape, points) : Infinity;
    if (away > slack) found.push({ key, dyad: dyad.id, away });
  }
  const { least = 0, most = Infinity } = table.length ?? {};
  if (table.length && dyad.kind === "RR" && (dyad.radius < least - slack || dyad.radius > most + slack)) {
    found.push({ key: "length", dyad: dyad.id, away: Math.max(least - dyad.radius, dyad.radius - most) });
  }
  if (table.kinds && !table.kinds.includes(dyad.kind)) found.push({ key: "kinds", dyad: dyad.id, away: Infinity });
  return found;
}
function limitsMissed(document2, linkage, size2) {
  const tables = limitsOf(document2), slack = ROUNDING * size2, [one, other] = linkage.led;
  if (tables.length < 2) return tables.map((table) => [...missed(table, one, slack), ...missed(table, other, slack)]);
  const pairings = [[one, other], [other, one]].map((dyads) => dyads.map((dyad, k) => missed(tables[k], dyad, slack)));
  const total = (lists) => lists.flat().length;
  return total(pairings[1]) < total(pairings[0]) ? pairings[1] : pairings[0];
}
function missedSentence({ key, dyad, away }, unit) {
  const by = `${Number(away.toPrecision(2))}${unit ? ` ${unit}` : ""}`;
  if (key === "kinds") return `${dyad} is of another kind.`;
  if (key === "length") return `The link of ${dyad} is ${by} beyond its range.`;
  return away === Infinity ? `${dyad} has no ${PIVOT[key]}.` : `The ${PIVOT[key]} of ${dyad} is ${by} outside.`;
}
function usedPlaces(linkage) {
  const rows = (linkage.pose_errors ?? []).filter((row) => row.way !== null && row.frame !== null);
  if (!rows.length || !linkage.ways?.length) return [];
  const counts = /* @__PURE__ */ new Map();
  for (const { way: way2 } of rows) counts.set(way2, (counts.get(way2) ?? 0) + 1);
  const [best] = [...counts].sort((a, b) => b[1] - a[1])[0], way = linkage.ways[best];
  const frames = rows.filter((row) => row.way === best).map(({ frame }) => frame);
  const low = Math.floor(Math.min(...frames)), high = Math.ceil(Math.max(...frames)), stride = Math.max(1, Math.ceil((high - low) / MOST_PLACES));
  const places = [];
  for (let k = low; k <= high && k < way.x.length; k += stride) places.push({ x: way.x[k], y: way.y[k], a: way.angle[k] });
  return places;
}
var regionCorners = (region) => region.polygon ?? (region.box ? boxCorners(region.box) : null);
var seen = (body, place) => body.map((corner) => act(place, corner));
function posePlace(document2, k) {
  const { x, y, angle } = standing(document2, k);
  return { x, y, a: radians(angle) };
}
function regionsTouched(document2, linkage, body) {
  const places = usedPlaces(linkage), width = document2.surroundings?.link_width ?? 0, margin = document2.surroundings?.margin ?? 0;
  const apart = Math.ceil(document2.poses.length / MOST_PLACES), some = [...document2.poses.keys()].filter((k) => k % apart === 0);
  return regionsOf(document2).map((region) => {
    const corners = regionCorners(region);
    if (!corners) return "";
    const pose = body.length > 2 ? some.find((k) => overlap(seen(body, posePlace(document2, k)), corners)) : void 0;
    if (pose !== void 0) return `The body touches it at pose ${poseName(document2, pose)}.`;
    if (!places.length) return "";
    if (body.length > 2 && places.some((place) => overlap(seen(body, place), corners))) return "The body touches it.";
    for (const dyad of linkage.led) {
      if (dyad.kind !== "RR") continue;
      const near = Math.min(...places.map((place) => segmentFromPolygon([dyad.fixed_pivot, act(place, dyad.moving_pivot)], corners)));
      if (near === 0 || near < width / 2) return `The link of ${dyad.id} touches it.`;
      if (near < width / 2 + margin) return `The link of ${dyad.id} comes nearer than the margin.`;
    }
    return "";
  });
}

// src/burmester/web/studio/connection.mjs
var AGAIN = [250, 500, 1e3, 2e3, 4e3];
var UNFINISHED = /* @__PURE__ */ new Set(["solving", "progress", "waiting"]);
var Refused = class extends Error {
  constructor(status, messages) {
    super(messages.map((each) => each.message).join(" ") || `the server answered ${status}`);
    this.status = status;
    this.messages = messages;
  }
};
async function messagesOf(response) {
  try {
    return (await response.json()).messages ?? [];
  } catch {
    return [];
  }
}
var Connection = class {
  /** @param {(frame: ArrayBuffer) => object} decode */
  constructor(decode) {
    this.decode = decode;
    this.listeners = { message: [], open: [], closed: [] };
    this.asked = /* @__PURE__ */ new Map();
    this.n = 0;
    this.tries = 0;
    this.socket = null;
  }
  on(name, fn) {
    this.listeners[name].push(fn);
  }
  emit(name, value) {
    for (const fn of this.listeners[name]) fn(value);
  }
  get isOpen() {
    return this.socket?.readyState === 1;
  }
  /** Exchange the token in the address for a cookie, and take it out of the address. */
  async session() {
    const token = decodeURIComponent(location.hash.slice(1)).replace(/^token=/, "");
    if (!token) return;
    await this.post("/session", { token });
    history.replaceState(null, "", location.pathname);
  }
  async get(path) {
    return (await this.request(path, {})).json();
  }
  /** The answer as a Response: JSON or a file. */
  post(path, body, method = "POST") {
    return this.request(path, { method, headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });
  }
  /** Raises Refused with the server's messages; a TypeError where there is no server. */
  async request(path, options) {
    const response = await fetch(path, { credentials: "same-origin", ...options });
    if (!response.ok) throw new Refused(response.status, await messagesOf(response));
    return response;
  }
  /** Open the websocket, and open it again whenever it ends. */
  open() {
    clearTimeout(this.timer);
    this.socket?.close();
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/live`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.tries = 0;
      this.emit("open");
    };
    socket.onmessage = ({ data }) => {
      if (socket === this.socket) this.take(typeof data === "string" ? JSON.parse(data) : this.decode(data));
    };
    socket.onclose = () => {
      if (socket !== this.socket) return;
      for (const { reject } of this.asked.values()) reject(new Error("the connection ended"));
      this.asked.clear();
      this.emit("closed", this.tries);
      this.timer = setTimeout(() => this.open(), AGAIN[Math.min(this.tries, AGAIN.length - 1)]);
      this.tries += 1;
    };
  }
  take(message) {
    const waiting = this.asked.get(message.n);
    if (waiting && !UNFINISHED.has(message.kind)) {
      this.asked.delete(message.n);
      waiting.resolve(message);
    }
    this.emit("message", message);
  }
  /** Send a message; returns its number, or null where the connection is closed. */
  send(message) {
    if (!this.isOpen) return null;
    this.n += 1;
    this.socket.send(JSON.stringify({ n: this.n, ...message }));
    return this.n;
  }
  /** Send a message and wait for its last answer. */
  ask(message) {
    return new Promise((resolve, reject) => {
      const n = this.send(message);
      if (n === null) reject(new Error("the connection is closed"));
      else this.asked.set(n, { resolve, reject });
    });
  }
};

// src/burmester/web/studio/files.mjs
var DRAWINGS = /\.(svg|dxf)$/i;
var TASKS = /\.(toml|json)$/i;
var KINDS = ".toml,.json,.csv,.tsv,.txt,.xlsx,.parquet,.trc,.svg,.dxf";
var LARGEST = 14e5;
async function base64Of(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  let text = "";
  for (let k = 0; k < bytes.length; k += 32768) text += String.fromCharCode(...bytes.subarray(k, k + 32768));
  return btoa(text);
}
var isTable = (text) => /\d/.test(text) && (/\t/.test(text) || /\n\s*\S/.test(text.trim()));
function download(blob, name) {
  const address = URL.createObjectURL(blob), link = h("a", { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 1e4);
}
function menu(text, items, attributes = {}) {
  const list = h("div", { class: "bs-menu-list", role: "menu" });
  const summary = h("summary", { class: "bm-button" }, text), element = h("details", { class: "bs-menu", ...attributes }, summary, list);
  const close = () => {
    if (!element.open) return;
    element.open = false;
    summary.focus();
  };
  element.addEventListener("toggle", () => {
    if (element.open) list.replaceChildren(...items().map(({ title, note, act: act2, data }) => h("button", { type: "button", role: "menuitem", class: "bs-menu-item", ...data, onclick: () => (close(), act2()) }, h("b", {}, title), note ? h("span", {}, note) : null)));
  });
  element.addEventListener("keydown", (event) => {
    const all = [...list.children], at = all.indexOf(document.activeElement);
    if (event.key === "Escape") close();
    else if (event.key === "ArrowDown") all[(at + 1) % all.length]?.focus();
    else if (event.key === "ArrowUp") all[(at + all.length - 1) % all.length]?.focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  document.addEventListener("pointerdown", (event) => element.contains(event.target) || (element.open = false));
  return element;
}
var Files = class {
  /** start: what the server said of templates and exports; banners: where is told what happened. */
  constructor(store, start, banners) {
    Object.assign(this, { store, start, banners, server: store.connection });
    this.chooser = h("input", { type: "file", hidden: true, accept: KINDS, "data-file": "open", onchange: () => this.chosen(this.chooser) });
    this.outlines = h("input", { type: "file", hidden: true, accept: ".svg,.dxf", "data-file": "outline", onchange: () => this.chosen(this.outlines) });
    this.dropping = h("div", { class: "bs-dropping", hidden: true, "aria-hidden": "true" }, h("p", {}, "Drop a task, a table of poses, or the outline of the body"));
    this.dialog = h("dialog", { class: "bs-dialog", "aria-label": "The same from the command line" });
    this.element = h("div", { class: "bs-files" }, ...this.buttons(), this.chooser, this.outlines, this.dropping, this.dialog);
    this.listen();
  }
  buttons() {
    const { start } = this;
    return [
      menu("Templates", () => (start.templates ?? []).map(({ name, summary }) => ({ title: name, note: summary, act: () => this.template(name), data: { "data-template": name } })), { "data-menu": "templates" }),
      button("New", () => this.fresh(), { "data-do": "new", title: "An empty task" }),
      button("Open…", () => this.chooser.click(), { "data-do": "open", title: "A task, or a table of poses (Ctrl+O)" }),
      button("Save task", () => this.save(), { "data-do": "save", title: "The file that the command reads (Ctrl+S)" }),
      menu("Export", () => [
        ...(start.exports ?? []).map(({ format, title, suffix }) => ({ title, note: suffix, act: () => this.export("/export", { format }), data: { "data-export": format } })),
        { title: "Report", note: ".html", act: () => this.export("/report"), data: { "data-export": "report" } },
        { title: "Result", note: ".json", act: () => this.export("/result"), data: { "data-export": "result" } }
      ], { "data-menu": "export" }),
      button("Copy as command", () => this.commands(), { "data-do": "command", title: "The same from the command line" })
    ];
  }
  get task() {
    const { document: document2, options, name } = this.store;
    return { document: document2, options, name };
  }
  /** Do what asks the server; what it refuses is told, and so is that it is not there. */
  async trying(what, then) {
    try {
      return await then();
    } catch (error) {
      if (error instanceof Refused && error.messages.length) this.banners.say("refused", `${what} was not done.`, error.messages);
      else this.banners.say("refused", `${what} was not done: ${error instanceof Refused ? error.message : "the server does not answer"}.`);
      return null;
    }
  }
  fresh() {
    this.store.replace({ document: { length_unit: "mm", angle_unit: "deg", poses: [] }, options: {}, name: "task" });
  }
  template(name) {
    return this.trying(`Opening ${name}`, async () => {
      const made2 = await this.server.get(`/template/${encodeURIComponent(name)}`);
      this.store.replace({ name, ...made2 });
      this.opened?.();
    });
  }
  async chosen(input) {
    for (const file of input.files) await this.take(file, input === this.outlines);
    input.value = "";
  }
  chooseOutline() {
    this.outlines.click();
  }
  /** A file that was chosen or dropped: an outline, a task, or a table of poses. */
  take(file, asOutline = DRAWINGS.test(file.name)) {
    return this.trying(`Reading ${file.name}`, async () => {
      if (file.size > LARGEST) throw new Refused(413, [{ message: `${file.name} has ${Math.round(file.size / 1e3)} kB, and the page takes ${LARGEST / 1e3}.`, help: "give it to the command: burmester studio FILE" }]);
      const body = { name: file.name, base64: await base64Of(file), length_unit: this.store.document.length_unit };
      if (asOutline) return this.outline(await (await this.server.post("/outline", body)).json(), file.name);
      const { document: document2, options = {}, notes = [] } = await (await this.server.post("/read", body)).json();
      const name = file.name.replace(/\.[^.]*$/, "");
      const whole = TASKS.test(file.name);
      this.store.replace(whole ? { document: document2, options, name } : { document: document2, options: this.store.options, name });
      this.opened?.();
      return this.banners.say("note", `${file.name} is open.`, notes, { undo: true });
    });
  }
  outline({ outline: corners, notes = [] }, name) {
    this.store.edit((document2) => setBody(document2, corners));
    this.store.select({ kind: "body", index: 0 });
    this.banners.say("note", `The outline of the body is that in ${name}: ${corners.length} corners.`, notes, { undo: true });
  }
  /** Rows of a spreadsheet: the poses are theirs, the rest of the task stays. */
  paste(text) {
    return this.trying("Pasting", async () => {
      const { document: document2, notes = [] } = await (await this.server.post("/read", { name: "pasted", text, length_unit: this.store.document.length_unit, angle_unit: "deg" })).json();
      const { poses, length_unit } = document2;
      this.store.edit((old) => withKeys(old, { poses, length_unit: length_unit ?? old.length_unit }));
      this.store.select(null);
      this.opened?.();
      this.banners.say("note", `${poses.length} poses were pasted.`, notes, { undo: true });
    });
  }
  /** As a task file in TOML; where there is no server, as the same in JSON. */
  save() {
    return this.trying("Saving", async () => {
      try {
        await this.hand(await this.server.post("/task", this.task), `${this.store.name}.toml`);
      } catch (error) {
        if (error instanceof Refused) throw error;
        this.saveWithoutServer();
        this.banners.say("note", "The server does not answer: the task was saved as JSON, which the command reads as well.");
      }
    });
  }
  /** The task as JSON, made by the page: what the command reads, where there is no server. */
  saveWithoutServer() {
    download(new Blob([`${JSON.stringify(this.store.document, null, 2)}
`], { type: "application/json" }), `${this.store.name.replace(/[^\w.-]+/g, "-") || "task"}.json`);
  }
  export(path, what = {}) {
    return this.trying("Exporting", async () => {
      const linkage = this.store.chosen === "placed" ? null : this.store.chosen;
      this.hand(await this.server.post(path, { ...this.task, linkage, ...what }), "export");
    });
  }
  async hand(response, otherwise) {
    const name = /filename="([^"]+)"/.exec(response.headers.get("Content-Disposition") ?? "")?.[1] ?? otherwise;
    download(await response.blob(), name);
  }
  commands() {
    return this.trying("Copying", async () => {
      const { commands } = await (await this.server.post("/command", { ...this.task, linkage: this.store.chosen === "placed" ? null : this.store.chosen })).json();
      const close = button("Close", () => this.dialog.close(), { "data-do": "close" });
      const said = h("p", { class: "bs-hint", role: "status" });
      const copy = async (command) => {
        try {
          await navigator.clipboard.writeText(command);
          said.textContent = "Copied.";
        } catch {
          said.textContent = "The browser does not let this page copy: select the text.";
        }
      };
      this.dialog.replaceChildren(
        h("h2", {}, "The same from the command line"),
        h("p", { class: "bs-hint" }, "Save the task first; the commands read that file."),
        ...commands.map(({ title, command }) => h("div", { class: "bs-command" }, h("h3", {}, title), h("pre", { tabindex: 0 }, command), button("Copy", () => copy(command), { "aria-label": `Copy: ${title}` }))),
        h("div", { class: "bs-row" }, close, said)
      );
      this.dialog.showModal();
    });
  }
  listen() {
    let inside = 0;
    const hasFiles = (event) => [...event.dataTransfer?.types ?? []].includes("Files");
    const show = (by) => {
      inside = Math.max(0, inside + by);
      this.dropping.hidden = inside === 0;
    };
    document.addEventListener("dragenter", (event) => hasFiles(event) && (event.preventDefault(), show(1)));
    document.addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
    document.addEventListener("dragleave", (event) => hasFiles(event) && show(-1));
    document.addEventListener("drop", async (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      show(-Infinity);
      inside = 0;
      for (const file of event.dataTransfer.files) await this.take(file);
    });
    document.addEventListener("paste", (event) => {
      const text = event.clipboardData?.getData("text/plain") ?? "", [file] = event.clipboardData?.files ?? [];
      const typing = event.target.closest?.("input, textarea, select");
      if (file) this.take(file);
      else if (isTable(text)) this.paste(text);
      else return;
      event.preventDefault();
      if (typing) typing.blur();
    });
  }
};

// src/burmester/web/studio/frames.mjs
var WAY = ["x", "y", "angle", "drive", "transmission"];
var POSE = ["x", "y", "angle_deg", "position", "turned_deg", "transmission_deg"];
function decodeFrame(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const numbers = floats(buffer, 4 + length);
  for (const linkage of header.linkages ?? []) {
    if (linkage.ways) linkage.ways = linkage.ways.map((way) => ({ ...way, ...pieces(numbers, way, WAY) }));
    const { count } = linkage.poses;
    const columns = pieces(numbers, linkage.poses, POSE);
    linkage.pose_errors = Array.from({ length: count }, (_, pose) => {
      const at = linkage.at?.[pose] ?? null;
      const row = { way: at ? at[0] : null, frame: at ? at[1] : null };
      for (const name of POSE) {
        const value = columns[name][pose];
        row[name] = Number.isNaN(value) ? null : value;
      }
      return row;
    });
  }
  return header;
}
function floats(buffer, start) {
  if (new Uint8Array(new Uint16Array([1]).buffer)[0] === 1) return new Float32Array(buffer, start);
  const view = new DataView(buffer, start);
  return Float32Array.from({ length: view.byteLength / 4 }, (_, k) => view.getFloat32(4 * k, true));
}
function pieces(numbers, { start, count }, names) {
  return Object.fromEntries(names.map((name, k) => [name, numbers.subarray(start + k * count, start + (k + 1) * count)]));
}

// src/burmester/web/studio/identity.mjs
var SAME = 2e-3;
var AMBIGUOUS = 0.25;
function coordinates(dyad, scene) {
  const out = [];
  for (const point of [dyad.fixed_pivot, dyad.moving_pivot]) if (point) out.push(point[0] / scene, point[1] / scene);
  if (dyad.radius !== void 0) out.push(dyad.radius / scene);
  if (dyad.line) {
    const angle = radians(dyad.line.normal_deg), offset = dyad.line.offset / scene;
    const sense = Math.cos(angle) > 1e-9 || Math.abs(Math.cos(angle)) <= 1e-9 && Math.sin(angle) > 0 ? 1 : -1;
    out.push(sense * Math.cos(angle), sense * Math.sin(angle), sense * offset);
  }
  if (dyad.angle_deg !== void 0) out.push(Math.cos(radians(dyad.angle_deg)), Math.sin(radians(dyad.angle_deg)));
  return out;
}
function dyadDistance(one, other, scene) {
  if (one.kind !== other.kind) return Infinity;
  const a = coordinates(one, scene), b = coordinates(other, scene);
  const size2 = 1 + Math.max(...a.map(Math.abs));
  return Math.max(...a.map((value, k) => Math.abs(value - b[k]))) / size2;
}
function linkageDistance(one, other, scene) {
  const pairs = (p, q) => Math.max(dyadDistance(one.led[0], other.led[p], scene), dyadDistance(one.led[1], other.led[q], scene));
  return Math.min(pairs(0, 1), pairs(1, 0));
}
function continuedAs(before, after, scene) {
  const away = before.map((one) => after.map((other) => linkageDistance(one, other, scene)));
  const nearest = (row) => {
    let best = -1, second = Infinity;
    row.forEach((value, k) => {
      if (best < 0 || value < row[best]) [best, second] = [k, best < 0 ? Infinity : row[best]];
      else if (value < second) second = value;
    });
    return best >= 0 && row[best] < SAME && row[best] <= AMBIGUOUS * second ? best : -1;
  };
  const names = /* @__PURE__ */ new Map();
  before.forEach((one, i) => {
    const j = nearest(away[i]);
    if (j >= 0 && nearest(away.map((row) => row[j])) === i) names.set(one.id, after[j].id);
  });
  return names;
}

// src/burmester/web/studio/keyboard.mjs
var KEYS2 = [
  ["Tab", "from handle to handle, field to field"],
  ["arrow keys", "move what has the focus by a step: a pose, the tip that turns it, a corner, a shape, a number; Shift: ten steps, Alt: a tenth"],
  ["Delete", "removes the pose, the corner or the shape"],
  ["Enter", "closes an outline; puts a shape in the middle while it is drawn"],
  ["Escape", "gives up what is under way: a drag, a drawing, a selection"],
  ["+ − 0", "on the plane: zoom and fit; arrow keys pan it"],
  ["space", "plays and stops"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo and redo"],
  ["Ctrl+S, Ctrl+O, Ctrl+V", "save the task, open a file, paste rows of a spreadsheet"]
];
function keyList() {
  const close = button("Close", () => dialog.close());
  const dialog = h(
    "dialog",
    { class: "bs-dialog", "aria-label": "Keys" },
    h("h2", {}, "Keys"),
    h("dl", { class: "bs-keys" }, KEYS2.map(([key, what]) => h("div", {}, h("dt", {}, key), h("dd", {}, what)))),
    close
  );
  return [button("Keys", () => dialog.showModal(), { "data-do": "keys" }), dialog];
}
var written2 = (element) => element?.matches?.("input:not([type=checkbox]):not([type=radio]):not([type=range]), textarea");
function listenToKeys(store, scene, files) {
  document.addEventListener("keydown", (event) => {
    const { key, target } = event, control = (event.ctrlKey || event.metaKey) && !event.altKey;
    if (control) {
      const act2 = { z: () => event.shiftKey ? store.redo() : store.undo(), y: () => store.redo(), s: () => files.save(), o: () => files.chooser.click() }[key.toLowerCase()];
      if (!act2 || written2(target) && target.dataset.typing === "true" && /^[zy]$/i.test(key)) return;
      event.preventDefault();
      act2();
    } else if (scene.dragged && key === "Escape") {
      event.preventDefault();
      scene.dragged.cancel();
    } else if (scene.tool && !written2(target) && scene.tool.key(event)) {
      event.preventDefault();
      event.stopPropagation();
    } else if (key === "Escape" && !written2(target) && store.selection) {
      store.select(null);
    }
  }, true);
  document.addEventListener("input", ({ target }) => target.dataset && (target.dataset.typing = "true"));
  for (const name of ["change", "focusout"]) document.addEventListener(name, ({ target }) => target.dataset && delete target.dataset.typing);
}

// src/burmester/web/studio/pose_table.mjs
var PAGE = 60;
var NUMBERS = [["x", "length"], ["y", "length"], ["angle", "angle"]];
var BOUNDS = [["x", "x", "length"], ["y", "y", "length"], ["angle", "angle_deg", "angle"]];
var oneLine = (name) => (name ?? "").replace(/[\r\n\u2028\u2029]+/g, " ");
var PoseTable = class {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.page = 0;
    this.rows = [];
    this.body = h("tbody", {});
    this.unit = h("span", { class: "bs-unit" });
    this.pages = h("div", { class: "bs-pages", hidden: true });
    this.details = h("div", { class: "bs-details", "data-details": "pose" });
    this.table = h(
      "table",
      { class: "bs-poses", "aria-label": "Poses" },
      h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "#"), h("th", { scope: "col" }, "name"), h("th", { scope: "col" }, "x"), h("th", { scope: "col" }, "y"), h("th", { scope: "col" }, "angle °"))),
      this.body
    );
    const add = button("Add a pose", () => this.add(), { "data-do": "add-pose-row" });
    this.element = h("div", { class: "bs-table-box" }, this.table, this.pages, h("div", { class: "bs-row" }, add, this.unit), this.details);
    this.makeDetails();
    store.on("document selection", () => this.draw());
    this.draw();
  }
  get selected() {
    const { selection, document: document2 } = this.store;
    return selection?.kind === "pose" && selection.index < document2.poses.length ? selection.index : null;
  }
  draw() {
    const { document: document2 } = this.store, count = document2.poses.length, pages = Math.max(1, Math.ceil(count / PAGE));
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
    this.unit.textContent = document2.length_unit ? `x and y in ${document2.length_unit}` : "";
    this.showPages(pages, count);
    this.showDetails();
  }
  /** One row of the table, at a place of the page; which pose it shows changes. */
  makeRow(place) {
    const row = { index: place, fields: {} };
    const change = (changes) => this.store.edit((document2) => setPose(document2, row.index, changes));
    row.number = h("button", { type: "button", class: "bs-index", onclick: () => this.store.select(row.index === this.selected ? null : { kind: "pose", index: row.index }) });
    row.name = textField("Name", (text) => change({ name: text.trim() || void 0 }), { class: "bs-text bs-name", placeholder: "–" });
    const cells = NUMBERS.map(([key, kind]) => {
      const field = new NumberField({
        label: key,
        options: () => ({ kind, unit: this.store.document.length_unit, optional: this.isFree(row.index, key) }),
        step: () => kind === "angle" ? 1 : this.scene.step,
        commit: (value) => change({ [key]: value }),
        attributes: { "data-key": key }
      });
      row.fields[key] = field;
      return h("td", {}, field.element);
    });
    row.tr = h("tr", { class: "bs-pose-row" }, h("th", { scope: "row" }, row.number), h("td", {}, row.name), cells);
    row.tr.addEventListener("focusin", (event) => event.target !== row.number && this.store.select({ kind: "pose", index: row.index }));
    return row;
  }
  isFree(index, key) {
    return Boolean(this.store.document.poses[index]?.free?.includes(key));
  }
  showRow(row, index) {
    const pose = this.store.document.poses[index], moved = row.index !== index;
    row.index = index;
    row.tr.dataset.row = index + 1;
    row.tr.classList.toggle("bs-selected", index === this.selected);
    row.number.textContent = index + 1;
    row.number.setAttribute("aria-label", `Pose ${index + 1}`);
    row.number.setAttribute("aria-pressed", index === this.selected);
    if (moved || document.activeElement !== row.name) row.name.value = oneLine(pose.name);
    row.name.setAttribute("aria-label", `Name of pose ${index + 1}`);
    for (const [key] of NUMBERS) {
      const { input } = row.fields[key], free = this.isFree(index, key);
      input.setAttribute("aria-label", `${key} of pose ${index + 1}`);
      input.placeholder = free ? "free" : "";
      row.fields[key].turnTo(index, pose[key]);
      row.fields[key].show(pose[key]);
    }
  }
  showPages(pages, count) {
    this.pages.hidden = pages < 2;
    if (pages < 2) return;
    const go = (page) => {
      this.page = page;
      this.draw();
    };
    this.pages.replaceChildren(
      button("‹", () => go(Math.max(0, this.page - 1)), { "aria-label": "Earlier poses", disabled: this.page === 0 }),
      h("span", {}, `${this.page * PAGE + 1}–${Math.min(count, (this.page + 1) * PAGE)} of ${count}`),
      button("›", () => go(Math.min(pages - 1, this.page + 1)), { "aria-label": "Later poses", disabled: this.page === pages - 1 })
    );
  }
  /** A copy of the last pose, a step beside it, and its x ready to be typed over. */
  add() {
    const { store, scene } = this, count = store.document.poses.length;
    const last = count ? standing(store.document, count - 1) : { x: 0, y: 0, angle: 0 };
    store.edit((document2) => addPose(document2, count ? { ...last, x: scene.rounded(last.x + 10 * scene.step) } : last));
    store.select({ kind: "pose", index: count });
    const field = this.rows.find((row) => row.index === count && row.tr.isConnected)?.fields.x.input;
    field?.focus();
    field?.select();
  }
  // What else a pose says: shown for the selected one
  makeDetails() {
    const { store } = this;
    const at = () => this.selected;
    const edit = (change) => store.edit((document2) => change(document2, at()));
    this.title = h("h3", { class: "bs-pose-title" });
    this.exact = tick("met exactly", (on) => edit((document2, k) => setPose(document2, k, { exact: on || void 0 })), { "data-key": "exact" });
    this.weight = new NumberField({
      label: "weight",
      options: () => ({ optional: true, above: 0 }),
      commit: (value) => edit((document2, k) => setPose(document2, k, { weight: value })),
      attributes: { "data-key": "weight", placeholder: "1" }
    });
    this.bounds = BOUNDS.map(([component2, key, kind]) => {
      const field = new NumberField({
        label: `tolerance of ${component2}`,
        options: () => ({ kind, unit: store.document.length_unit, optional: true, least: 0 }),
        step: () => kind === "angle" ? 1 : this.scene.step,
        commit: (value) => edit((document2, k) => setTolerance(document2, k, key, value)),
        attributes: { "data-key": `tolerance-${component2}`, placeholder: "–" }
      });
      const free = tick("free", (on) => edit((document2, k) => setFree(document2, k, component2, on)), { "data-key": `free-${component2}`, "aria-label": `${component2} is free` });
      return { component: component2, key, field, free };
    });
    this.axes = choice("Axes of the tolerance", [["fixed", "along the axes of the ground"], ["body", "along the axes of the body"]], (value) => edit((document2, k) => setTolerance(document2, k, "axes", value === "body" ? value : void 0)), { "data-key": "tolerance-axes" });
    const act2 = (text, name, change, then) => button(text, () => {
      const k = at();
      edit(change);
      store.select(then(k) === null ? null : { kind: "pose", index: then(k) });
    }, { "data-do": name });
    const last = () => store.document.poses.length - 1;
    this.up = act2("Earlier", "earlier", (document2, k) => movePose(document2, k, k - 1), (k) => k - 1);
    this.down = act2("Later", "later", (document2, k) => movePose(document2, k, k + 1), (k) => k + 1);
    this.details.append(
      this.title,
      h("div", { class: "bs-row" }, this.exact.element, labelled("weight", this.weight.element)),
      h(
        "table",
        { class: "bs-tolerances" },
        h("caption", {}, "Tolerance: how far from it the body may be, to either side"),
        h("tbody", {}, this.bounds.map(({ component: component2, field, free }) => h("tr", {}, h("th", { scope: "row" }, component2 === "angle" ? "angle °" : component2), h("td", {}, field.element), h("td", {}, free.element))))
      ),
      this.axes,
      h(
        "div",
        { class: "bs-row" },
        this.up,
        this.down,
        act2("Duplicate", "duplicate", duplicatePose, (k) => k + 1),
        act2("Delete", "delete-pose", removePose, (k) => last() < 0 ? null : Math.min(k, last()))
      )
    );
  }
  showDetails() {
    const k = this.selected;
    this.details.hidden = k === null;
    if (k === null) return;
    const pose = this.store.document.poses[k];
    this.title.replaceChildren(`Pose ${k + 1}`, ...pose.name ? [": ", h("bdi", {}, oneLine(pose.name))] : []);
    this.exact.box.checked = Boolean(pose.exact);
    this.weight.turnTo(k, pose.weight);
    this.weight.show(pose.weight);
    for (const { component: component2, key, field, free } of this.bounds) {
      const isFree = this.isFree(k, component2) || pose.tolerance?.[component2] === "free";
      free.box.checked = isFree;
      field.input.disabled = isFree;
      const stated = pose.tolerance?.[key], bound = typeof stated === "number" ? stated : void 0;
      field.turnTo(k, bound);
      field.show(bound);
    }
    this.axes.hidden = !pose.tolerance;
    this.axes.value = pose.tolerance?.axes ?? "fixed";
    this.up.disabled = k === 0;
    this.down.disabled = k === this.store.document.poses.length - 1;
  }
};

// src/burmester/web/studio/regions.mjs
var LONGEST_NAME2 = 22;
var HATCH = 9;
var PIVOT2 = { fixed_pivot: "Fixed pivot", moving_pivot: "Moving pivot" };
function limitName(document2, { table, key }) {
  return `${PIVOT2[key]}${limitsOf(document2).length > 1 ? ` of dyad ${table + 1}` : ""}`;
}
function regionShape(region) {
  if (region.box) return { shape: "box", points: region.box };
  return region.polygon ? { shape: "polygon", points: region.polygon } : null;
}
var Regions = class {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.shapes = /* @__PURE__ */ new Map();
    scene.layer("regions").append(s("defs", {}, s("pattern", { id: "bs-hatch", width: HATCH, height: HATCH, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" }, s("path", { class: "bm-hatch", d: `M0 0V${HATCH}` }))));
    this.regions = new Kept(s("g"), (key, k) => this.makeRegion(k), (element) => this.shapes.get(element).draw());
    this.footprint = new Kept(s("g"), () => this.makeFootprint(), (element) => this.shapes.get(element).draw());
    this.limits = new Kept(s("g"), (key, limit) => this.makeLimit(limit), (element) => this.shapes.get(element).draw());
    this.names = new Kept(s("g", { class: "bs-region-names", "aria-hidden": "true" }), () => s("text", {}), (text, name) => this.showName(text, name));
    scene.layer("regions").append(this.regions.group, this.footprint.group);
    scene.layer("limits").append(this.limits.group);
    scene.layer("labels").append(this.names.group);
    store.on("document", () => this.judge(store.state === "dragging" && !this.isOther()));
    store.on("selection", () => this.draw());
    store.on("solved followed chosen placed", () => this.judge());
    scene.on("view", () => this.draw());
    scene.hold(() => limitRegions(store.document).filter(({ shape }) => shape !== "line").flatMap((each) => this.corners(each)));
    scene.hold(() => regionsOf(store.document).map(regionShape).filter(Boolean).flatMap(({ shape, points }) => outlineOf(shape, points)), true);
    this.judge();
  }
  place({ key }) {
    return key === "moving_pivot" ? referencePlace(this.store) : GROUND;
  }
  corners(limit) {
    return outlineOf(limit.shape, limit.points).map((point) => act(this.place(limit), point));
  }
  /** Whether what must not be touched, or what touches, is another than when it was judged. */
  isOther() {
    const { body, keep_out, surroundings } = this.store.document, now = [body, keep_out, surroundings];
    return now.some((each, k) => each !== this.judged?.[k]);
  }
  /** What the chosen linkage meets and breaks; it is drawn, and said in the lists.
   *
   * pivots: of limits only, for what is touched follows with the linkage.
   */
  judge(pivots = false) {
    const { document: document2, solved } = this.store, linkage = currentLinkage(this.store);
    this.broken = linkage?.led ? limitsMissed(document2, linkage, solved?.scene ?? 1) : null;
    if (!pivots) {
      this.judged = [document2.body, document2.keep_out, document2.surroundings];
      this.touched = linkage?.led ? regionsTouched(document2, linkage, bodyOf(document2)) : null;
    }
    this.draw();
    this.onjudged?.();
  }
  /** Sentences on a limit, by its table and key; null where no linkage is there. */
  said(table, key) {
    return this.broken?.[table]?.filter((each) => each.key === key).map((each) => missedSentence(each, this.store.document.length_unit)) ?? null;
  }
  draw() {
    const { document: document2 } = this.store, regions = regionsOf(document2), limits = limitRegions(document2), { footprint } = document2.requirements ?? {};
    this.regions.draw(regions.map((region, k) => [k, k]).filter(([k]) => regionShape(regions[k])));
    this.limits.draw(limits.map((limit) => [`${limit.table} ${limit.key}`, limit]));
    this.footprint.draw(footprint ? [["footprint", footprint]] : []);
    for (const [element, handles] of this.shapes) {
      if (element.parentNode) continue;
      handles.clear();
      this.shapes.delete(element);
    }
    this.names.draw([
      ...regions.map((region, k) => [`region ${k}`, region.name && regionShape(region) ? { text: region.name, at: middle(outlineOf(...Object.values(regionShape(region)))) } : null]),
      ...limits.map((limit) => [`limit ${limit.table} ${limit.key}`, { text: limitName(document2, limit), at: middleOf(this.corners(limit), limit.key === "moving_pivot"), off: limit.key === "moving_pivot" ? -5 : 14 }]),
      ["footprint", footprint ? { text: "Footprint", at: middleOf(footprint.polygon ?? outlineOf("box", footprint.box), true), off: -5 } : null]
    ].filter(([, name]) => name));
  }
  kept(handles) {
    this.shapes.set(handles.element, handles);
    return handles.element;
  }
  makeRegion(k) {
    const { store } = this;
    const handles = new ShapeHandles(this.scene, {
      className: "bs-region",
      what: () => {
        const region = regionsOf(store.document)[k];
        return {
          ...regionShape(region),
          place: GROUND,
          name: region.name ? `Keep out: ${region.name}` : `Region ${k + 1} to keep out of`,
          selected: store.selection?.kind === "region" && store.selection.index === k,
          state: this.touched ? this.touched[k] ? "broken" : "met" : "",
          data: { region: k }
        };
      },
      set: (points, gesture) => store.edit((document2) => setRegion(document2, k, shapeOf(regionShape(regionsOf(document2)[k]).shape, points)), { gesture }),
      remove: () => this.removeRegion(k),
      select: () => store.select({ kind: "region", index: k }),
      abandon: (gesture) => store.abandon(gesture)
    });
    handles.element.insertBefore(s("path", { class: "bs-hatched", fill: "url(#bs-hatch)" }), handles.area);
    const draw = handles.draw.bind(handles);
    handles.draw = () => {
      draw();
      handles.element.querySelector(".bs-hatched").setAttribute("d", handles.line.getAttribute("d"));
    };
    return this.kept(handles);
  }
  removeRegion(k) {
    this.store.edit((document2) => removeRegion(document2, k));
    this.store.select(null);
    this.scene.svg.focus({ preventScroll: true });
  }
  makeLimit({ table, key }) {
    const { store } = this, place = () => this.place({ key });
    const at = () => limitRegions(store.document).findIndex((each) => each.table === table && each.key === key);
    return this.kept(new ShapeHandles(this.scene, {
      className: `bs-limit bs-${key.replace("_", "-")}`,
      what: () => {
        const index = at(), limit = limitRegions(store.document)[index], said = this.said(table, key);
        return {
          ...limit,
          place: place(),
          name: `Limit: ${limitName(store.document, limit)}`,
          selected: store.selection?.kind === "limit" && store.selection.index === index,
          state: said ? said.length ? "broken" : "met" : "",
          data: { limit: index, plane: key === "moving_pivot" ? "M" : "F" }
        };
      },
      set: (points, gesture) => store.edit((document2) => setLimit(document2, table, { [key]: shapeOf(Object.keys(limitsOf(document2)[table][key])[0], points) }), { gesture }),
      remove: () => this.removeLimit(table, key),
      select: () => store.select({ kind: "limit", index: at() }),
      abandon: (gesture) => store.abandon(gesture)
    }));
  }
  removeLimit(table, key) {
    this.store.edit((document2) => setLimit(document2, table, { [key]: void 0 }));
    this.store.select(null);
    this.scene.svg.focus({ preventScroll: true });
  }
  makeFootprint() {
    const { store } = this, shape = () => Object.keys(store.document.requirements.footprint)[0];
    return this.kept(new ShapeHandles(this.scene, {
      className: "bs-footprint",
      what: () => ({ shape: shape(), points: store.document.requirements.footprint[shape()], place: GROUND, name: "Footprint: holds all pivots", selected: store.selection?.kind === "footprint", data: { footprint: "" } }),
      set: (points, gesture) => store.edit((document2) => setRequirement(document2, "footprint", { [shape()]: points }), { gesture }),
      remove: () => {
        store.edit((document2) => setRequirement(document2, "footprint", void 0));
        store.select(null);
      },
      select: () => store.select({ kind: "footprint", index: 0 }),
      abandon: (gesture) => store.abandon(gesture)
    }));
  }
  showName(text, { text: name, at: [x, y], off }) {
    const { view } = this.scene, shown = shortened(name, LONGEST_NAME2);
    if (text.textContent !== shown) text.textContent = shown;
    text.setAttribute("class", off ? "bs-limit-name" : "bs-region-name");
    text.setAttribute("text-anchor", "middle");
    text.setAttribute("x", px(view.X(x)));
    text.setAttribute("y", px(view.Y(y) + (off ?? 4)));
  }
  // Tools that draw a new one
  regionTool(shape) {
    const { store } = this;
    return new ShapeTool(this.scene, {
      shape,
      name: `region ${shape}`,
      place: () => GROUND,
      done: (points) => {
        store.edit((document2) => addRegion(document2, { [shape]: points }));
        store.select({ kind: "region", index: regionsOf(store.document).length - 1 });
      }
    });
  }
  limitTool(table, key, shape) {
    const { store } = this;
    return new ShapeTool(this.scene, {
      shape,
      name: `limit ${table} ${key} ${shape}`,
      place: () => this.place({ key }),
      done: (points) => {
        store.edit((document2) => setLimit(document2, table, { [key]: shapeOf(shape, points) }));
        store.select({ kind: "limit", index: limitRegions(store.document).findIndex((each) => each.table === table && each.key === key) });
      }
    });
  }
  footprintTool(shape) {
    const { store } = this;
    return new ShapeTool(this.scene, {
      shape,
      name: `footprint ${shape}`,
      place: () => GROUND,
      done: (points) => {
        store.edit((document2) => setRequirement(document2, "footprint", { [shape]: points }));
        store.select({ kind: "footprint", index: 0 });
      }
    });
  }
};
function middle(points) {
  const [x, y, u, v] = bounds(points);
  return [(x + u) / 2, (y + v) / 2];
}
function middleOf(points, upper) {
  const [x, y, u, v] = bounds(points);
  return [(x + u) / 2, upper ? v : y];
}

// src/burmester/web/studio/results_entry.mjs
function addResults(store, scene, places) {
  places.results.textContent = "";
}

// src/burmester/web/studio/history.mjs
var MOST2 = 500;
var History = class {
  constructor() {
    this.past = [];
    this.future = [];
  }
  /** Keep the value that a change is about to replace; edits of one gesture are one entry. */
  record(value, gesture) {
    this.future = [];
    const last = this.past.at(-1);
    if (gesture !== null && last?.gesture === gesture) return;
    this.past.push({ value, gesture });
    if (this.past.length > MOST2) this.past.shift();
  }
  /** The value before the last gesture, or null. */
  undo(value) {
    const last = this.past.pop();
    if (!last) return null;
    this.future.push(value);
    return last.value;
  }
  /** The value that the last undo took away, or null. */
  redo(value) {
    const next = this.future.pop();
    if (next === void 0) return null;
    this.past.push({ value, gesture: null });
    return next;
  }
  /** The value before a gesture that is given up, which leaves no entry; or null. */
  abandon(gesture) {
    if (this.past.at(-1)?.gesture !== gesture) return null;
    return this.past.pop().value;
  }
  get canUndo() {
    return this.past.length > 0;
  }
  get canRedo() {
    return this.future.length > 0;
  }
};

// src/burmester/web/studio/store.mjs
var REST = 150;
var MOST_SHOWN = 6;
var PLACED = "placed";
var sameIds = (before, after) => new Map(before.filter(({ id }) => after.some((each) => each.id === id)).map(({ id }) => [id, id]));
var Store = class {
  /** continued(before, after, scene): for each linkage before the id with which it goes on.
   * @param {{ connection: import("./connection.mjs").Connection, document: object, options?: object, name?: string, continued?: Function }} start */
  constructor({ connection, document: document2, options = {}, name = "task", continued = sameIds }) {
    this.connection = connection;
    this.continued = continued;
    this.renamed = null;
    this.document = document2;
    this.options = options;
    this.name = name;
    this.history = new History();
    this.solved = null;
    this.solvedFor = null;
    this.followed = null;
    this.followedFor = null;
    this.state = "resting";
    this.progress = "";
    this.chosen = null;
    this.pinned = /* @__PURE__ */ new Set();
    this.compared = null;
    this.placed = null;
    this.selection = null;
    this.messages = [];
    this.listeners = /* @__PURE__ */ new Map();
    this.basis = null;
    this.pending = null;
    this.flying = null;
    this.placing = null;
    this.solving = null;
    this.improving = null;
    this.improved = null;
    connection.on("message", (message) => this.take(message));
    connection.on("open", () => this.opened());
    connection.on("closed", () => this.closed());
  }
  // Events
  /** Call `fn` after any of the events in `names`, which blanks or a list separate. */
  on(names, fn) {
    for (const name of [names].flat().join(" ").split(/\s+/)) {
      if (!this.listeners.has(name)) this.listeners.set(name, []);
      this.listeners.get(name).push(fn);
    }
  }
  emit(...names) {
    const told = /* @__PURE__ */ new Set();
    for (const name of names) {
      for (const fn of this.listeners.get(name) ?? []) {
        if (told.has(fn)) continue;
        told.add(fn);
        fn(name);
      }
    }
  }
  // The task
  /** Change the document; `gesture` is the same value for all edits that are undone as one. */
  edit(change, { gesture = null } = {}) {
    const next = change(this.document);
    if (next === this.document) return;
    this.history.record(this.version, gesture);
    this.document = next;
    this.changed();
  }
  /** An option of `burmester synthesize`; undefined takes it away. */
  option(name, value) {
    this.history.record(this.version, null);
    const { [name]: _, ...rest } = this.options;
    this.options = value === void 0 ? rest : { ...rest, [name]: value };
    this.changed();
  }
  /** Another name for the task, and for its files. */
  rename(name) {
    this.history.record(this.version, null);
    this.name = name;
    this.emit("document");
  }
  /** Another task in place of this one: one entry, too. */
  replace({ document: document2, options = {}, name = this.name }) {
    this.history.record(this.version, null);
    Object.assign(this, { document: document2, options, name, selection: null, placed: null });
    this.changed();
    this.emit("selection", "placed");
  }
  undo() {
    this.goTo(this.history.undo(this.version));
  }
  redo() {
    this.goTo(this.history.redo(this.version));
  }
  /** Give up a gesture: the task is as it was before it. */
  abandon(gesture) {
    this.goTo(this.history.abandon(gesture));
  }
  get version() {
    return { document: this.document, options: this.options, name: this.name };
  }
  goTo(version) {
    if (!version) return;
    Object.assign(this, version);
    this.changed();
  }
  /** After any change: follow it, and solve when the hand rests. */
  changed() {
    this.emit("document");
    if (this.state !== "offline") this.setState("dragging");
    this.follow();
    this.solveAfterRest();
  }
  // The server
  /** The linkages whose motion is wanted while dragging. */
  get shown() {
    return [.../* @__PURE__ */ new Set([this.chosen, this.compared, ...this.pinned])].filter((id) => id && id !== PLACED).slice(0, MOST_SHOWN);
  }
  follow() {
    if (!this.solved || this.flying) return;
    const { document: document2, options, shown } = this;
    const n = this.connection.send({ do: "follow", document: document2, options, shown });
    if (n !== null) this.flying = { n, document: document2 };
  }
  solveAfterRest() {
    clearTimeout(this.resting);
    this.resting = setTimeout(() => this.solve(), REST);
  }
  /** Run the whole road for the task as it is now. */
  solve() {
    clearTimeout(this.resting);
    const { document: document2, options } = this;
    const n = this.connection.send({ do: "solve", document: document2, options });
    if (n === null) return;
    this.solving = { n, document: document2, options };
    this.setState("solving", "");
  }
  /** Stop the whole road; what was followed stays. */
  cancel() {
    this.connection.send({ do: "cancel" });
  }
  /** The best dyad with each of these pivots, { plane: "F" | "M", at } one or two; none: no longer. */
  place(pivots) {
    this.placeWanted = pivots?.length ? pivots : null;
    if (!this.placeWanted) {
      this.placed = null;
      this.emit("placed");
    } else if (!this.placing) {
      this.sendPlace();
    }
  }
  sendPlace() {
    const { document: document2, options, placeWanted: pivots } = this;
    const n = this.connection.send({ do: "place", document: document2, options, pivots });
    this.placing = n === null ? null : { n, pivots };
  }
  take(message) {
    const { n, kind } = message;
    if (kind === "followed") this.takeFollowed(message);
    else if (n === this.flying?.n) this.followRefused(message);
    else if (n === this.placing?.n) this.takePlaced(message);
    else if (n === this.improving?.n) this.takeImproved(message);
    else if (n === this.solving?.n || kind === "cancelled" && this.solving && n > this.solving.n) this.takeSolving(message);
  }
  takeFollowed(frame) {
    if (frame.n !== this.flying?.n) return;
    const { document: document2, isOld } = this.flying, from = frame.from ?? (isOld ? null : this.basis);
    this.flying = null;
    if (this.pending && from === this.pending.n) this.install(this.pending);
    if (from === this.basis) {
      this.followed = frame;
      this.followedFor = document2;
      this.emit("followed");
    }
    if (document2 !== this.document || ![this.followedFor, this.solvedFor].includes(document2)) this.follow();
  }
  /** What cannot be followed is solved when the hand rests. */
  followRefused({ kind, messages = [], solve = false }) {
    const { document: document2 } = this.flying;
    this.flying = null;
    if (kind === "refused" && !solve) this.say(messages);
    if (document2 !== this.document) this.follow();
  }
  takePlaced(message) {
    const { pivots } = this.placing;
    this.placing = null;
    if (this.placeWanted && message.kind === "placed") {
      this.placed = { ...message, pivots };
      this.emit("placed");
    } else if (message.kind === "refused") {
      this.say(message.messages);
    }
    if (this.placeWanted && this.placeWanted !== pivots) this.sendPlace();
  }
  /** While a newer task is at hand, what an older search says is not told. */
  takeSolving(message) {
    const { document: document2 } = this.solving, isNow = document2 === this.document;
    if (message.kind === "progress" || message.kind === "waiting") {
      const before = `waiting for ${message.before} other${message.before === 1 ? "" : "s"}`;
      if (isNow) this.setState("solving", message.kind === "progress" ? message.text : before);
      return;
    }
    if (message.kind === "solving") return;
    this.solving = null;
    if (message.kind === "solved") {
      const answer = { ...message, document: document2 };
      if (isNow) this.install(answer);
      else this.pending = answer;
    } else if (message.kind === "refused") {
      this.say(message.messages);
    } else {
      const [said] = [message.message].flat();
      this.say([{ tone: message.kind, ...typeof said === "string" ? { message: said } : said }]);
    }
    if (isNow) this.setState("resting", "");
  }
  /** Look for the nearest better linkages around one that is not usable. */
  improve(linkage) {
    const { document: document2, options } = this, n = this.connection.send({ do: "improve", document: document2, options, linkage });
    this.improving = n === null ? null : { n, linkage };
    this.emit("improved");
  }
  takeImproved(message) {
    if (message.kind === "progress" || message.kind === "waiting" || message.kind === "solving") return;
    this.improving = null;
    if (message.kind === "improved") this.improved = message;
    else if (message.messages) this.say(message.messages);
    this.emit("improved");
  }
  /** A whole answer becomes what is shown; what was chosen goes on as the same linkage, whatever its id. */
  install({ n, result, document: document2, seconds, was }) {
    const before = this.followed?.linkages ?? this.solved?.linkages ?? [];
    this.renamed = was ? new Map(Object.entries(was).map(([now, old]) => [old, now])) : this.continued(before, result.linkages, result.scene);
    const carried = (id) => id === PLACED && this.placed?.linkage ? id : this.renamed.get(id) ?? null;
    Object.assign(this, { solved: result, solvedFor: document2, seconds, basis: n, pending: null, followed: null, followedFor: null });
    if (this.flying) this.flying.isOld = true;
    this.chosen = carried(this.chosen) ?? result.linkages[0]?.id ?? null;
    this.compared = carried(this.compared);
    this.pinned = new Set([...this.pinned].map(carried).filter(Boolean));
    this.messages = [];
    this.emit("solved", "chosen", "pinned", "messages");
    if (document2 !== this.document) this.follow();
  }
  opened() {
    this.flying = this.solving = this.placing = this.improving = null;
    this.setState("resting", "");
    this.basis = null;
    this.solve();
  }
  closed() {
    clearTimeout(this.resting);
    this.flying = this.solving = this.placing = this.improving = null;
    this.setState("offline", "");
  }
  setState(state, progress = "") {
    if (state === this.state && progress === this.progress) return;
    this.state = state;
    this.progress = progress;
    this.emit("state");
  }
  /** Messages in the readers' form: { code, message, where, help }; an empty list takes them away. */
  say(messages) {
    this.messages = messages;
    this.emit("messages");
  }
  // What is looked at
  choose(id) {
    if (id === this.chosen) return;
    this.chosen = id;
    this.emit("chosen");
    if (this.state === "dragging" || this.document !== this.solvedFor) this.follow();
  }
  pin(id) {
    if (!this.pinned.delete(id)) this.pinned.add(id);
    this.emit("pinned");
  }
  compare(id) {
    this.compared = id === this.compared ? null : id;
    this.emit("chosen");
  }
  /** { kind: "pose" | "limit" | "region" | "body", index }, or null. */
  select(selection) {
    if (selection?.kind === this.selection?.kind && selection?.index === this.selection?.index) return;
    this.selection = selection;
    this.emit("selection");
  }
};

// src/burmester/web/studio/point_fields.mjs
var FEW = 40;
var PointFields = class {
  /** options and step: as a NumberField of a length takes them; set(change): change goes from points to points. */
  constructor({ name, options, step, set }) {
    Object.assign(this, { name, options, step, set, fields: [] });
    this.shape = h("span", { class: "bs-hint" });
    this.more = h("p", { class: "bs-hint" });
    this.pairs = h("div", { class: "bs-coordinates" });
    this.element = h("div", { class: "bs-point-fields" }, this.shape, this.pairs, this.more);
  }
  /** Show a shape; text that is no number stays where it is, as long as its point does. */
  show(shape, points) {
    const count = Math.min(points.length, FEW);
    if (shape !== this.shape.textContent) this.fields = [];
    this.shape.textContent = shape;
    while (this.fields.length < count) this.fields.push(this.make(this.fields.length));
    this.fields.length = count;
    const wanted = this.fields.map((each) => each.element);
    if (wanted.length !== this.pairs.children.length || wanted.some((each, k) => each !== this.pairs.children[k])) this.pairs.replaceChildren(...wanted);
    this.fields.forEach(({ pair }, k) => pair.forEach((field, i) => field.show(points[k][i])));
    this.more.hidden = points.length <= FEW;
    this.more.textContent = `and ${points.length - FEW} more, to drag in the plane`;
  }
  make(k) {
    const pair = ["x", "y"].map((axis, i) => new NumberField({
      label: `${axis} of point ${k + 1} of ${this.name}`,
      options: () => ({ ...this.options(), optional: false }),
      step: this.step,
      commit: (value) => this.set((points) => points.map((point, j) => j === k ? point.map((old, m) => m === i ? value : old) : point))
    }));
    return { pair, element: h("span", { class: "bs-pair" }, pair.map((field) => field.element)) };
  }
};

// src/burmester/web/studio/task_panel.mjs
var SHAPES = ["point", "line", "segment", "box", "polygon"];
var KINDS2 = [["RR", "RR: a link"], ["PR", "PR: a slider"], ["RP", "RP: a slot"], ["PP", "PP: a carriage"]];
var TYPES = [
  "grashof",
  "non-grashof",
  "crank-rocker",
  "rocker-crank",
  "double-crank",
  "double-rocker",
  "triple-rocker",
  "change-point",
  "slider-crank",
  "inverted slider-crank",
  "double slider",
  "Oldham linkage",
  "Rapson slide"
];
var DRIVERS = [["any", "either dyad"], ["crank", "one that turns fully"], ["first", "the first of two limits"], ["second", "the second of two limits"]];
var METHODS = [["auto", "chosen by the task"], ["complete", "complete: every locally best dyad"], ["pencil", "pencil: the two dyads of the paper"], ["exact", "exact: through five poses"]];
var PREFERENCES = [["transmission", "transmission"], ["size", "size"], ["accuracy", "accuracy"]];
var NORMS = [["rms", "the root mean square"], ["worst", "the worst pose"]];
var UNITS = ["", "mm", "cm", "m", "in", "ft"];
var section = (name, title, open, ...content) => h("details", { class: "bs-section", "data-section": name, open }, h("summary", {}, title), ...content);
var TaskPanel = class {
  constructor(store, scene, regions, body, files) {
    Object.assign(this, { store, scene, regions, body, files });
    this.element = h("div", { class: "bs-task" });
    this.element.append(this.makeLimits(), this.makeRegions(), this.makeBody(), this.makeRequirements(), this.makeOptions());
    store.on("document selection", () => this.draw());
    regions.onjudged = () => this.drawVerdicts();
    this.draw();
  }
  edit(change) {
    this.store.edit(change);
  }
  length(label, commit, options = {}, attributes = {}) {
    return new NumberField({ label, commit, options: () => ({ kind: "length", unit: this.store.document.length_unit, optional: true, ...options }), step: () => this.scene.step, attributes });
  }
  /** Buttons that draw a shape; the one in use is pressed. */
  tools(label, shapes, toolOf, data) {
    return h("div", { class: "bs-tools", role: "group", "aria-label": label }, shapes.map((shape) => this.toolButton(shape, () => toolOf(shape), { "data-draw": `${data} ${shape}` })));
  }
  toolButton(text, toolOf, attributes) {
    const made2 = button(text, () => this.scene.use(made2.tool && made2.tool === this.scene.tool ? null : made2.tool = toolOf()), { "aria-pressed": "false", ...attributes });
    this.scene.on("tool", (tool) => made2.setAttribute("aria-pressed", Boolean(tool) && tool === made2.tool));
    return made2;
  }
  /** Fields for the points of a shape; set(change) changes them. */
  points(name, set) {
    return new PointFields({ name, set, options: () => ({ kind: "length", unit: this.store.document.length_unit }), step: () => this.scene.step });
  }
  // Limits
  makeLimits() {
    this.apart = tick("another limit for each of the two dyads", (on) => this.edit((document2) => splitLimits(document2, on)), { "data-key": "limits-apart" });
    this.tables = h("div", {});
    this.madeTables = [];
    return section("limits", "Limits of pivots and links", false, this.apart.element, this.tables);
  }
  makeTable(k) {
    const { store, regions } = this, edit = (changes) => this.edit((document2) => setLimit(document2, k, changes));
    const title = h("h3", {}), parts = {};
    for (const [key, name] of [["fixed_pivot", "Fixed pivot, in the ground"], ["moving_pivot", "Moving pivot, in the body"]]) {
      const state = h("p", { class: "bs-state" });
      const numbers = this.points(`the limit of the ${key.replace("_", " ")}`, (change) => this.edit((document2) => withPoints(document2, k, key, change)));
      const remove = button("Delete", () => regions.removeLimit(k, key), { "data-do": `delete-limit-${k}-${key}`, "aria-label": `Delete the limit: ${name}` });
      parts[key] = { state, numbers, remove };
      parts[key].element = h("div", { class: "bs-limit-box" }, h("h4", {}, name), this.tools(`Draw a limit: ${name}`, SHAPES, (shape) => regions.limitTool(k, key, shape), `limit ${k} ${key}`), numbers.element, state, remove);
    }
    const least = this.length("least length", (value) => edit({ length: range(value, limitsOf(store.document)[k]?.length?.most) }), { least: 0 }, { "data-key": `least-${k}`, placeholder: "any" });
    const most = this.length("greatest length", (value) => edit({ length: range(limitsOf(store.document)[k]?.length?.least, value) }), { least: 0 }, { "data-key": `most-${k}`, placeholder: "any" });
    const kinds = KINDS2.map(([kind, text]) => ({ kind, ...tick(text, () => edit({ kinds: kindsOf(kinds) }), { "data-key": `kind-${k}-${kind}` }) }));
    const lengthState = h("p", { class: "bs-state" }), kindsState = h("p", { class: "bs-state" });
    const element = h(
      "div",
      { class: "bs-limit-table" },
      title,
      parts.fixed_pivot.element,
      parts.moving_pivot.element,
      h("div", { class: "bs-row" }, labelled("length from", least.element), labelled("to", most.element)),
      lengthState,
      h("div", { class: "bs-row", role: "group", "aria-label": "kinds of dyads" }, kinds.map((each) => each.element)),
      kindsState
    );
    return { element, title, parts, least, most, kinds, lengthState, kindsState };
  }
  drawLimits() {
    const { document: document2 } = this.store, tables = limitsOf(document2), count = Math.max(1, tables.length);
    this.apart.box.checked = tables.length > 1;
    while (this.madeTables.length < count) this.madeTables.push(this.makeTable(this.madeTables.length));
    while (this.tables.children.length > count) this.tables.lastChild.remove();
    while (this.tables.children.length < count) this.tables.append(this.madeTables[this.tables.children.length].element);
    for (let k = 0; k < count; k += 1) {
      const table = tables[k] ?? {}, made2 = this.madeTables[k];
      made2.title.textContent = count > 1 ? `Dyad ${k + 1}` : "Both dyads";
      for (const key of ["fixed_pivot", "moving_pivot"]) this.drawLimit(made2.parts[key], table[key]);
      made2.least.show(table.length?.least);
      made2.most.show(table.length?.most);
      for (const { kind, box } of made2.kinds) box.checked = !table.kinds || table.kinds.includes(kind);
    }
  }
  drawLimit({ numbers, remove }, region) {
    remove.hidden = numbers.element.hidden = !region;
    if (!region) return;
    const [[shape, stated]] = Object.entries(region);
    numbers.show(shape, shape === "point" ? [stated] : stated);
  }
  drawVerdicts() {
    const { regions } = this, tables = limitsOf(this.store.document);
    this.madeTables.forEach((made2, k) => {
      for (const key of ["fixed_pivot", "moving_pivot"]) tell(made2.parts[key].state, tables[k]?.[key] ? regions.said(k, key) : null);
      tell(made2.lengthState, tables[k]?.length ? regions.said(k, "length") : null);
      tell(made2.kindsState, tables[k]?.kinds ? regions.said(k, "kinds") : null);
    });
    this.regionRows.forEach((row, k) => tell(row.state, regions.touched ? [regions.touched[k]].filter(Boolean) : null));
  }
  // Regions to keep out of
  makeRegions() {
    this.regionList = h("div", {});
    this.regionRows = [];
    this.linkWidth = this.length("width of the links", (value) => this.edit((document2) => setSurrounding(document2, "link_width", value)), { least: 0 }, { "data-key": "link_width", placeholder: "0" });
    this.margin = this.length("least clearance", (value) => this.edit((document2) => setSurrounding(document2, "margin", value)), { least: 0 }, { "data-key": "margin", placeholder: "0" });
    this.inPlane = tick("links that stand on the ground must not touch the body either", (on) => this.edit((document2) => setSurrounding(document2, "body_in_plane", on || void 0)), { "data-key": "body_in_plane" });
    return section(
      "keep-out",
      "Regions to keep out of",
      false,
      h("p", { class: "bs-hint" }, "The body and the links must not touch them between the poses."),
      this.tools("Draw a region to keep out of", ["box", "polygon"], (shape) => this.regions.regionTool(shape), "region"),
      this.regionList,
      h("div", { class: "bs-row" }, labelled("links are wide", this.linkWidth.element), labelled("least clearance", this.margin.element)),
      this.inPlane.element
    );
  }
  drawRegions() {
    const { store } = this, regions = regionsOf(store.document);
    while (this.regionRows.length < regions.length) {
      this.regionRows.push(this.regionRow(this.regionRows.length));
      this.regionList.append(this.regionRows.at(-1).element);
    }
    for (const row of this.regionRows.splice(regions.length)) row.element.remove();
    this.regionRows.forEach((row, k) => row.show(regions[k], store.selection?.kind === "region" && store.selection.index === k));
    const { link_width, margin, body_in_plane } = store.document.surroundings ?? {};
    this.linkWidth.show(link_width);
    this.margin.show(margin);
    this.inPlane.box.checked = Boolean(body_in_plane);
  }
  regionRow(k) {
    const { store } = this, shapeKey = (region) => region.box ? "box" : "polygon";
    const name = textField(`Name of region ${k + 1}`, (text) => this.edit((document2) => setRegion(document2, k, { name: text.trim() || void 0 })), { "data-key": `region-name-${k}`, placeholder: `region ${k + 1}` });
    const numbers = this.points(`region ${k + 1}`, (change) => this.edit((document2) => {
      const region = regionsOf(document2)[k], key = shapeKey(region);
      return setRegion(document2, k, { [key]: change(region[key]) });
    }));
    const state = h("p", { class: "bs-state" }), inNumbers = h("details", {}, h("summary", {}, "in numbers"), numbers.element), file = h("p", { class: "bs-hint" });
    const element = h(
      "div",
      { class: "bs-limit-box", "data-region-row": k, onfocusin: () => store.select({ kind: "region", index: k }) },
      h("div", { class: "bs-row" }, name, button("Delete", () => this.regions.removeRegion(k), { "data-do": `delete-region-${k}`, "aria-label": `Delete region ${k + 1}` })),
      state,
      inNumbers,
      file
    );
    const show = (region, selected) => {
      const text = (region.name ?? "").replace(/[\r\n]+/g, " ");
      if (document.activeElement !== name && name.value !== text) name.value = text;
      element.classList.toggle("bs-selected", selected);
      inNumbers.hidden = region.file !== void 0;
      file.hidden = !inNumbers.hidden;
      if (inNumbers.hidden) file.textContent = `from the drawing ${region.file}`;
      else numbers.show(shapeKey(region), region[shapeKey(region)]);
    };
    return { element, state, show };
  }
  // The body
  makeBody() {
    this.bodyNumbers = this.points("the outline", (change) => this.edit((document2) => setBody(document2, change(bodyOf(document2)))));
    this.bodyCount = h("summary", {});
    this.bodyBox = h("details", {}, this.bodyCount, this.bodyNumbers.element);
    this.noBody = button("Delete the outline", () => this.edit((document2) => setBody(document2, [])), { "data-do": "delete-body" });
    return section(
      "body",
      "Outline of the body",
      false,
      h("p", { class: "bs-hint" }, "It is seen at every pose, moves with the linkage, and says what an angle error counts as."),
      h("div", { class: "bs-tools" }, this.toolButton("Draw it", () => this.body.tool(), { "data-draw": "body" }), button("From a drawing (SVG, DXF)…", () => this.files.chooseOutline(), { "data-do": "outline-file" }), this.noBody),
      this.bodyBox
    );
  }
  drawBody() {
    const { document: task } = this.store, corners = bodyOf(task);
    this.noBody.hidden = !task.body;
    this.bodyBox.hidden = !corners.length;
    if (!corners.length) return;
    this.bodyCount.textContent = `${corners.length} corners, in numbers`;
    this.bodyNumbers.show("polygon", corners);
  }
  // Requirements and options
  makeRequirements() {
    const set = (key) => (value) => this.edit((document2) => setRequirement(document2, key, value));
    const number = (label, key, options) => new NumberField({ label, commit: set(key), options: () => ({ optional: true, unit: this.store.document.length_unit, ...options }), attributes: { "data-key": key, placeholder: "–" } });
    this.numbers = {
      transmission_deg: number("least transmission angle", "transmission_deg", { kind: "angle", least: 0, most: 90 }),
      link_ratio: number("longest link to the shortest, at most", "link_ratio", { least: 1 }),
      within: number("greatest position error", "within", { kind: "length", above: 0 }),
      within_deg: number("greatest angle error", "within_deg", { kind: "angle", above: 0 })
    };
    this.driver = choice("driver", DRIVERS, (value) => set("driver")(value === "any" ? void 0 : value), { "data-key": "driver" });
    this.anyOrder = tick("the poses may be met in any order", (on) => set("any_order")(on || void 0), { "data-key": "any_order" });
    this.types = TYPES.map((type) => ({ type, ...tick(type, () => set("types")(typesOf(this.types)), { "data-key": `type-${type}` }) }));
    this.noFootprint = button("Delete", () => set("footprint")(void 0), { "data-do": "delete-footprint", "aria-label": "Delete the footprint" });
    return section(
      "requirements",
      "What the linkage must be",
      true,
      h(
        "div",
        { class: "bs-grid" },
        labelled("transmission angle at least", this.numbers.transmission_deg.element, "°"),
        labelled("position error at most", this.numbers.within.element, " "),
        labelled("angle error at most", this.numbers.within_deg.element, "°"),
        labelled("link ratio at most", this.numbers.link_ratio.element, " "),
        labelled("driver", this.driver)
      ),
      this.anyOrder.element,
      h("div", { class: "bs-limit-box" }, h("h4", {}, "Footprint: holds all pivots, wherever the poses take them"), this.tools("Draw the footprint", ["box", "polygon"], (shape) => this.regions.footprintTool(shape), "footprint"), this.noFootprint),
      h("details", {}, h("summary", {}, "Types"), h("div", { class: "bs-ticks" }, this.types.map((each) => each.element)), h("p", { class: "bs-hint" }, "None: any type."))
    );
  }
  drawRequirements() {
    const asked = this.store.document.requirements ?? {};
    for (const [key, field] of Object.entries(this.numbers)) field.show(asked[key]);
    this.driver.value = asked.driver ?? "any";
    this.anyOrder.box.checked = Boolean(asked.any_order);
    this.noFootprint.hidden = !asked.footprint;
    for (const { type, box } of this.types) box.checked = Boolean(asked.types?.includes(type));
  }
  makeOptions() {
    const { store } = this;
    this.unit = choice("unit of length", UNITS.map((unit) => [unit, unit || "not stated"]), (value) => this.edit((document2) => withKeys(document2, { length_unit: value || void 0 })), { "data-key": "length_unit" });
    this.method = choice("method", METHODS, (value) => store.option("method", value === "auto" ? void 0 : value), { "data-key": "method" });
    this.norm = choice("norm", NORMS, (value) => store.option("norm", value === "rms" ? void 0 : value), { "data-key": "norm" });
    this.prefer = choice("best at", PREFERENCES, (value) => store.option("prefer", value === "transmission" ? void 0 : value), { "data-key": "prefer" });
    this.lengths = ["angle-weight", "tolerance"].map((name) => ({ name, field: this.length(name, (value) => store.option(name, value), { above: 0 }, { "data-key": name, placeholder: "–" }) }));
    const [weight, made2] = this.lengths.map(({ field }) => field.element);
    return section(
      "options",
      "Unit and method",
      false,
      h(
        "div",
        { class: "bs-grid" },
        labelled("unit of length", this.unit),
        labelled("method", this.method),
        labelled("what is made least", this.norm),
        labelled("two to four poses: best at", this.prefer),
        labelled("one radian counts as", weight, " "),
        labelled("pivots and lengths are made to ±", made2, " ")
      ),
      h("p", { class: "bs-hint" }, "Another unit leaves the numbers as they are.")
    );
  }
  drawOptions() {
    const { document: document2, options } = this.store, unit = document2.length_unit ?? "";
    if (![...this.unit.options].some((each) => each.value === unit)) this.unit.append(h("option", { value: unit }, unit));
    this.unit.value = unit;
    this.method.value = options.method ?? "auto";
    this.norm.value = options.norm ?? "rms";
    this.prefer.value = options.prefer ?? "transmission";
    for (const { name, field } of this.lengths) field.show(options[name]);
  }
  /** While poses are dragged nothing here is another. */
  draw() {
    const { document: { limits, keep_out, surroundings, body, requirements, length_unit }, options, selection } = this.store;
    const now = [limits, keep_out, surroundings, body, requirements, length_unit, options, selection];
    if (now.every((each, k) => each === this.drawn?.[k]) && this.drawn) return;
    this.drawn = now;
    this.drawLimits();
    this.drawRegions();
    this.drawBody();
    this.drawRequirements();
    this.drawOptions();
    this.drawVerdicts();
  }
};
function tell(element, sentences) {
  element.hidden = sentences === null;
  if (sentences === null) return;
  element.className = `bs-state ${sentences.length ? "bs-broken" : "bs-met"}`;
  element.textContent = sentences.length ? `✕ ${sentences.join(" ")}` : "✓ met by the chosen linkage";
}
function withPoints(document2, k, key, change) {
  const [[shape, stated]] = Object.entries(limitsOf(document2)[k][key]);
  return setLimit(document2, k, { [key]: shapeOf(shape, change(shape === "point" ? [stated] : stated)) });
}
var range = (least, most) => least === void 0 && most === void 0 ? void 0 : { ...least === void 0 ? {} : { least }, ...most === void 0 ? {} : { most } };
function kindsOf(kinds) {
  const list = kinds.filter(({ box }) => box.checked).map(({ kind }) => kind);
  return list.length === kinds.length || !list.length ? void 0 : list;
}
function typesOf(types) {
  const list = types.filter(({ box }) => box.checked).map(({ type }) => type);
  return list.length ? list : void 0;
}

// src/burmester/web/studio/studio.mjs
var EMPTY = "An empty task: add poses here, paste rows of a spreadsheet, drop a file, or take a template.";
var FIRST = "Drag a pose by its point, turn it by the tip of its arrow: every linkage answers at once.";
function layOut(root, store, start) {
  const scene = new Scene(store), banners = new Banners(store), files = new Files(store, start, banners);
  banners.files = files;
  const body = new BodyEditor(store, scene), regions = new Regions(store, scene);
  const panel = new TaskPanel(store, scene, regions, body, files), handles = new PoseHandles(store, scene), table = new PoseTable(store, scene);
  const player = h("div", { id: "bs-player" }), results = h("aside", { id: "bs-results", "aria-label": "Linkages" }), panels = h("div", { id: "bs-panels" });
  const name = h("input", { class: "bs-text bs-task-name", "aria-label": "Name of the task", autocomplete: "off", spellcheck: "false", onchange: () => store.rename(name.value.trim() || "task") });
  const undo = button("↶", () => store.undo(), { "data-do": "undo", title: "Undo (Ctrl+Z)", "aria-label": "Undo" }), redo = button("↷", () => store.redo(), { "data-do": "redo", title: "Redo (Ctrl+Shift+Z)", "aria-label": "Redo" });
  const show = () => {
    if (document.activeElement !== name) name.value = store.name.replace(/[\r\n]+/g, " ");
    undo.disabled = !store.history.canUndo;
    redo.disabled = !store.history.canRedo;
  };
  store.on("document", show);
  show();
  root.replaceChildren(
    h("header", { class: "bs-head" }, h("h1", {}, "burmester studio"), name, h("div", { class: "bs-row" }, undo, redo), files.element, banners.status),
    banners.element,
    h(
      "main",
      { class: "bs-main" },
      h("section", { class: "bs-left", "aria-label": "The task" }, h("div", { class: "bm-card" }, h("h2", {}, "Poses"), table.element), h("div", { class: "bm-card" }, panel.element)),
      h("section", { class: "bs-stage bm-card", "aria-label": "The plane" }, stageBar(store, scene), scene.element, player),
      results,
      panels
    )
  );
  scene.resize();
  addResults(store, scene, { player, results, panels });
  listenToKeys(store, scene, files);
  new Autosave(store);
  files.opened = refitWhenSolved(store, scene);
  return { scene, banners, files, body, regions, panel, handles, table };
}
function stageBar(store, scene) {
  const pose = button("Add poses", () => scene.use(scene.tool?.name === "pose" ? null : new PoseTool(store, scene)), { "data-do": "add-poses", "aria-pressed": "false" });
  const stop = button("Stop solving", () => store.cancel(), { "data-do": "cancel", hidden: true });
  const line = h("p", { class: "bs-line" });
  const show = () => {
    line.textContent = scene.tool?.hint ?? (store.document.poses.length ? FIRST : EMPTY);
    pose.setAttribute("aria-pressed", scene.tool?.name === "pose");
  };
  scene.on("tool", show);
  store.on("document", show);
  let waiting;
  store.on("state", () => {
    clearTimeout(waiting);
    if (store.state === "solving") waiting = setTimeout(() => stop.hidden = false, 700);
    else stop.hidden = true;
  });
  show();
  return h(
    "div",
    { class: "bs-bar" },
    h(
      "div",
      { class: "bs-row" },
      pose,
      button("Fit", () => scene.fitAgain(), { "data-do": "fit", title: "Show the poses; once more: all of the body and the regions, too (0)" }),
      button("+", () => scene.zoom(1.25, scene.size.width / 2, scene.size.height / 2), { "aria-label": "Zoom in" }),
      button("−", () => scene.zoom(0.8, scene.size.width / 2, scene.size.height / 2), { "aria-label": "Zoom out" }),
      ...keyList(),
      stop
    ),
    line
  );
}
function refitWhenSolved(store, scene) {
  let waits = true;
  scene.hold(() => (waits ? [] : currentLinkage(store)?.led ?? []).map((dyad) => dyad.fixed_pivot).filter((point) => point && isNear(store, point)));
  store.on("solved", () => {
    const refit = waits && scene.isFitted;
    waits = false;
    if (refit) scene.fit();
  });
  return () => {
    waits = true;
    scene.fit();
  };
}
function isNear({ solved, document: { poses } }, [x, y]) {
  return poses.some((pose) => Math.hypot(x - pose.x, y - pose.y) < 3 * (solved?.scene ?? Infinity));
}
function listenToTokens(connection, banners) {
  addEventListener("hashchange", async () => {
    if (!location.hash) return;
    await connection.session();
    banners.close("expired");
    connection.open();
  });
  let asked = false;
  connection.on("closed", async () => {
    if (asked) return;
    asked = true;
    try {
      await connection.get("/start");
    } catch (error) {
      if (error instanceof Refused && error.status === 401) banners.expired();
    }
    asked = false;
  });
}
async function main() {
  const root = document.getElementById("studio"), connection = new Connection(decodeFrame);
  try {
    await connection.session();
    const start = await connection.get("/start"), kept = keptHere();
    const store = new Store({ connection, continued: continuedAs, document: start.document, options: start.options, name: start.name, ...kept });
    const parts = layOut(root, store, start);
    if (start.saved && !kept) offerSaved(store, parts, start.saved);
    listenToTokens(connection, parts.banners);
    document.documentElement.dataset.ready = "true";
    connection.open();
  } catch (error) {
    root.replaceChildren(h("p", { class: "bs-failed", role: "alert" }, error instanceof Refused && error.status === 401 ? "This page needs the address that burmester studio printed, with the token in it. Open that address, or start burmester studio again." : `The page could not start: ${error.message}. Is burmester studio still running? Start it again and open the address that it prints.`));
    if (!(error instanceof Refused)) throw error;
  }
}
function offerSaved(store, { banners, files }, saved) {
  const when = typeof saved.when === "number" ? new Date(1e3 * saved.when).toLocaleString() : saved.when;
  banners.say("saved", `Your task of last time, ${saved.name}${when ? ` (${when})` : ""}, was kept.`, [], {
    actions: [button("Go on with it", () => {
      banners.close("saved");
      store.replace(saved);
      files.opened();
    }, { "data-do": "restore" })]
  });
}
main();
