// Files: opened, dropped, pasted, saved, exported; and the command line that does the same.

import { give, h, put, say } from "../widget/dom.mjs";
import { isPath, setBody, withKeys } from "./document.mjs";
import { Refused } from "./connection.mjs";
import { button } from "./fields.mjs";

const DRAWINGS = /\.(svg|dxf)$/i;
const TASKS = /\.(toml|json)$/i;
const KINDS = ".toml,.json,.csv,.tsv,.txt,.xlsx,.parquet,.trc,.svg,.dxf";
const BESIDE = ["limits", "requirements", "keep_out", "surroundings", "body"]; // what a task says beside its poses
const HEADERS = { 2: ["x,y", "Read them as x, y: points"], 3: ["x,y,angle_deg", "Read them as x, y, angle in degrees"] }; // by the number of columns
const LONGEST_NAME = 200; // characters of a task's name in a link
const PROGRESS = 700; // milliseconds between two questions how far an export is, and before the first
const LARGEST = 1_400_000; // bytes of a file: in base64 they are 2 MB with what is around them

/** What is loaded when it is first used.
 * @returns {Promise<any>} */
// @ts-ignore: the server has it under this name
export const tools = () => import("/tools.mjs");

/** A file's bytes in base64. */
export async function base64Of(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  let text = "";
  for (let k = 0; k < bytes.length; k += 0x8000) text += String.fromCharCode(...bytes.subarray(k, k + 0x8000));
  return btoa(text);
}

/** Whether a pasted text is rows of cells: tabs or several lines, with a digit. */
export const isTable = (text) => /\d/.test(text) && (/\t/.test(text) || /\n\s*\S/.test(text.trim()));

/** Hand a file to the person. */
export function download(blob, name) {
  const address = URL.createObjectURL(blob), link = h("a", { href: address, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** What opens under a button: `fill` makes its content anew each time.  Arrow keys go from item to item. */
export function popover(text, list, fill, attributes = {}) {
  const summary = h("summary", { class: "bm-button" }, text), element = h("details", { class: "bs-menu", ...attributes }, summary, list);
  const close = () => {
    if (!element.open) return;
    element.open = false;
    summary.focus();
  };
  element.addEventListener("toggle", () => element.open && fill(close));
  element.addEventListener("keydown", (event) => {
    const all = [...list.querySelectorAll(".bs-menu-item")], at = all.indexOf(document.activeElement), step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (event.key === "Escape") close();
    else if (step && (at >= 0 || document.activeElement === summary)) all[(at + step + all.length) % all.length]?.focus();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  document.addEventListener("pointerdown", (event) => element.contains(event.target) || (element.open = false));
  return element;
}

/** One thing to choose in what opens under a button. */
export const menuItem = ({ title, note, act, data }, close, attributes = {}) =>
  h("button", { type: "button", class: "bs-menu-item", ...attributes, ...data, onclick: () => (close(), act()) }, h("b", {}, title), note ? h("span", {}, note) : null);

/** A menu under a button: a list of what can be done, with headings. */
export function menu(text, items, attributes = {}) {
  const list = h("div", { class: "bs-menu-list", role: "menu" });
  return popover(text, list, (close) => list.replaceChildren(...items().map((each) => (each.heading ? h("p", { class: "bs-menu-heading", role: "presentation" }, each.heading) : menuItem(each, close, { role: "menuitem" })))), attributes);
}

export class Files {
  /** @type {any} */ opened;
  /** @type {any} */ functions;

  /** start: what the server said of templates and exports; banners: where is told what happened. */
  constructor(store, start, banners) {
    this.store = store;
    this.start = start;
    this.banners = banners;
    this.server = store.connection;
    this.chooser = h("input", { type: "file", hidden: true, accept: KINDS, "data-file": "open", onchange: () => this.chosen(this.chooser) });
    this.outlines = h("input", { type: "file", hidden: true, accept: ".svg,.dxf", "data-file": "outline", onchange: () => this.chosen(this.outlines) });
    this.dropping = h("div", { class: "bs-dropping", hidden: true, "aria-hidden": "true" }, h("p", {}, "Drop a task, a table of poses, or the outline of the body"));
    this.dialog = h("dialog", { class: "bs-dialog", });
    this.element = h("div", { class: "bs-files" }, this.menu(), this.chooser, this.outlines, this.dropping, this.dialog);
    this.listen();
  }

  /** What is done with the task as a whole. */
  menu() {
    const item = (title, note, act, data) => ({ title, note, act, data: { "data-do": data } });
    return menu("Task", () => [
      item("New", "an empty task", () => this.fresh(), "new"),
      item("Open…", "a task, or a table of poses (Ctrl+O)", () => this.chooser.click(), "open"),
      item("Function of an angle…", "an output link that turns as a function of an input link", () => this.function(), "function"),
      item("Save task", "the file that the command reads (Ctrl+S)", () => this.save(), "save"),
      item("Copy link…", "the whole task in a link or a command, for somebody else", () => this.copyLink(), "link"),
      item("Copy as command", "the same from the command line", () => this.commands(), "command"),
      { heading: "Templates" },
      ...(this.start.templates ?? []).map(({ name, summary }) => ({ title: name, note: summary, act: () => this.template(name), data: { "data-template": name } })),
    ], { "data-menu": "task" });
  }

  get task() {
    const { document, options, name } = this.store;
    return { document, options, name };
  }

  /** Do what asks the server; what it refuses is told, and so is that it is not there. */
  async trying(what, then, actions = []) {
    try {
      return await then();
    } catch (error) {
      const { messages } = /** @type {any} */ (error);
      if (messages?.length) this.banners.say("refused", `${what} was not done.`, messages, { actions });
      else this.banners.say("refused", `${what} was not done: ${error instanceof Refused ? error.message : "the server does not answer"}.`);
      return null;
    }
  }

  fresh() {
    this.store.replace({ document: { length_unit: "mm", angle_unit: "deg", poses: [] }, options: {}, name: "task" });
  }

  template(name) {
    return this.trying(`Opening ${name}`, async () => {
      const made = await this.server.get(`/template/${encodeURIComponent(name)}`);
      if (made.document.function) return this.function(made.document.function, name);
      this.store.replace({ name, ...made });
      this.opened?.();
    });
  }

  /** The page of functions of angles; task: what is opened there, else what was there last. */
  async function(task = null, name = undefined) {
    // @ts-ignore: the server has it under this name
    const { FunctionPage } = await import("/tools.mjs");
    this.functions ??= new FunctionPage(this);
    this.functions.open(task, name);
  }

  async chosen(input) {
    for (const file of input.files) await this.take(file, input === this.outlines);
    input.value = "";
  }

  chooseOutline() {
    this.outlines.click();
  }

  /** A file that was chosen or dropped: an outline, a task, or a table of poses. */
  take(file, asOutline = DRAWINGS.test(file.name) && this.store.document.poses.length > 0 && !isPath(this.store.document)) {
    const isDrawing = DRAWINGS.test(file.name), { document: before } = this.store;
    const other = isDrawing ? button(asOutline ? "Take it as a path to trace" : "Take it as the outline of the body", () => {
      for (const kind of ["note", "refused"]) this.banners.close(kind);
      if (this.store.document !== before) this.store.undo();
      this.take(file, !asOutline);
    }, { "data-do": asOutline ? "as-path" : "as-outline" }) : null;
    return this.trying(`Reading ${file.name}`, async () => {
      if (file.size > LARGEST) throw new Refused(413, [{ message: `${file.name} has ${Math.round(file.size / 1000)} kB, and the page takes ${LARGEST / 1000}.`, help: "give it to the command: burmester studio FILE" }]);
      const body = { name: file.name, base64: await base64Of(file), length_unit: this.store.document.length_unit };
      if (asOutline) return this.outline(await (await this.server.post("/outline", body)).json(), file.name, other);
      const { document, options = {}, notes = [], picture } = await (await this.server.post("/read", body)).json();
      const name = file.name.replace(/\.[^.]*$/, "");
      if (document.function) return this.function(document.function, name);
      const whole = TASKS.test(file.name);
      this.store.replace(whole ? { document, options, name, picture: this.store.known(picture) } : { document, options: this.store.options, name });
      this.opened?.();
      return this.banners.say("note", `${file.name} is open.`, notes, { undo: true, actions: other ? [other] : [] });
    }, other ? [other] : []);
  }

  outline({ outline: corners, notes = [] }, name, other) {
    this.store.edit((document) => setBody(document, corners));
    this.store.select({ kind: "body", index: 0 });
    this.banners.say("note", `The outline of the body is that in ${name}: ${corners.length} corners.`, notes, { undo: true, actions: other ? [other] : [] });
  }

  /** Rows of a spreadsheet are another task; what the one before said beside its poses can be kept. */
  paste(text, columns) {
    const [first] = text.trim().split("\n"), header = HEADERS[first.trim().split(/\t/.test(first) ? /\t/ : /[,;\s]+/).length];
    const again = !columns && header && !/[^\d\s.,;+\-eE\u2212]/.test(first) ? [button(header[1], () => (this.banners.close("refused"), this.paste(text, header[0])), { "data-do": "read-columns" })] : [];
    return this.trying("Pasting", async () => {
      const old = this.store.document;
      const { document, notes = [] } = await (await this.server.post("/read", { name: "pasted", text, columns, length_unit: old.length_unit, angle_unit: "deg" })).json();
      if (document.function) return this.function(document.function);
      const beside = Object.fromEntries(BESIDE.filter((key) => old[key] !== undefined && document[key] === undefined).map((key) => [key, old[key]]));
      this.store.replace({ document: withKeys(document, { length_unit: document.length_unit ?? old.length_unit }), options: this.store.options, picture: this.store.picture });
      this.store.select(null);
      this.opened?.();
      this.banners.close("refused");
      const keep = button("Keep the limits and the body of the task before", () => (keep.remove(), this.store.edit((now) => withKeys(now, beside))), { "data-do": "keep-rest" });
      const what = document.poses.some((pose) => pose.angle !== undefined) ? "poses" : "points";
      this.banners.say("note", `${document.poses.length} ${what} were pasted.`, notes, { undo: true, actions: Object.keys(beside).length ? [keep] : [] });
    }, again);
  }

  /** As a task file in TOML; where there is no server, as the same in JSON. */
  save() {
    return this.trying("Saving", async () => {
      try {
        await this.hand(await this.server.post("/task", { ...this.task, picture: this.store.keptPicture }), `${this.store.name}.toml`);
      } catch (error) {
        if (error instanceof Refused) throw error;
        this.saveWithoutServer();
        this.banners.say("note", "The server does not answer: the task was saved as JSON, which the command reads as well.");
      }
    });
  }

  /** The task as JSON, made by the page: what the command reads, where there is no server. */
  saveWithoutServer() {
    download(new Blob([`${JSON.stringify({ ...this.store.document, picture: this.store.keptPicture ?? undefined }, null, 2)}\n`], { type: "application/json" }), `${this.store.name.replace(/[^\w.-]+/g, "-") || "task"}.json`);
  }

  /** The linkage that is chosen: its id, or the dyads of one that is none of the answer. */
  get chosenLinkage() {
    const { chosen, placed } = this.store, dyads = chosen === "placed" ? placed?.linkage?.dyads : undefined;
    if (!dyads?.every((dyad) => dyad.kind === "RR")) return { linkage: chosen === "placed" ? null : chosen, kind: chosen?.startsWith("S") ? "six_bars" : undefined };
    return { linkage: null, dyads: dyads.map(({ fixed_pivot, moving_pivot, radius }) => ({ fixed_pivot, moving_pivot, radius })) };
  }

  export(path, what = {}) {
    return this.trying("Exporting", async () => {
      const name = crypto.randomUUID(), ending = new AbortController(), { signal } = ending;
      const asking = setInterval(() => this.tellProgress(name, ending), PROGRESS);
      try {
        const body = { ...this.task, ...this.chosenLinkage, settings: this.store.settings, progress: name, ...what };
        await this.hand(await this.server.post(path, body, "POST", signal), "export");
      } catch (error) {
        if (!signal.aborted) throw error;
      } finally {
        clearInterval(asking);
        ending.abort(); // whose answer comes late shows nothing
        this.banners.close("exporting");
      }
    });
  }

  /** How far an export is, with a button that ends it. */
  async tellProgress(name, ending) {
    const { text } = await this.server.get(`/progress/${name}`).catch(() => ({ text: "" }));
    if (ending.signal.aborted) return;
    const cancel = button("Cancel", () => ending.abort(), { "data-do": "cancel-export" });
    const banner = this.banners.shown.get("exporting") ?? this.banners.say("exporting", "", [], { actions: [cancel] });
    say(banner.querySelector(".bs-banner-title"), text ? `Exporting: ${text}.` : "Exporting…");
  }

  async hand(response, otherwise) {
    const name = /filename="([^"]+)"/.exec(response.headers.get("Content-Disposition") ?? "")?.[1] ?? otherwise;
    download(await response.blob(), name);
  }

  commands() {
    return this.trying("Copying", async () => {
      const { commands } = await (await this.server.post("/command", { ...this.task, settings: this.store.settings, ...this.chosenLinkage })).json();
      this.showCopies("The same from the command line", "Save the task first; the commands read that file.", commands);
    });
  }

  /** The task as a link: for others where they reach this page or one like it, else as a command. */
  copyLink() {
    return this.trying("Making a link", async () => {
      const { encode, qrCode } = await tools(), { chosen } = this.store, { page } = this.start;
      const code = await encode(this.store.document, this.store.options, this.store.name, chosen === "placed" ? null : chosen);
      const link = `${new URL(page ?? location.pathname, location.href).href}#${code}`;
      const commands = [{ title: "Open it where burmester is installed", command: `burmester studio ${code}` }, { title: "Find its linkages", command: `burmester synthesize ${code}` }];
      const hint = `It holds poses, conditions, body, loads, options and the chosen linkage, in ${link.length} characters; no picture behind the plane.`;
      if (page) return this.showCopies("The task as a link", hint, [{ title: "Link", command: link }, ...commands], qrCode(link));
      return this.showCopies("The task as a link", hint, [...commands, { title: "Link to this studio, on this machine and while it runs", command: link }]);
    });
  }

  /** Open the task in a link; one that cannot be read changes nothing. */
  openLink(text) {
    return this.trying("Opening the link", async () => {
      const { decode } = await tools(), { document: given, options, name, choice } = await decode(text);
      const { document, notes = [] } = await (await this.server.post("/read", { name: "task.json", text: JSON.stringify(given) })).json();
      if (document.function) return this.function(document.function, name);
      await this.server.post("/check", { document, options });
      this.store.replace({ document, options, name: name.slice(0, LONGEST_NAME), choice: choice && { chosen: choice } });
      this.opened?.();
      this.banners.say("note", "The task of the link is open.", notes, { undo: true });
    });
  }

  /** Texts to copy, each with its button, and a picture of the first one.
   * @param {any} [picture] */
  showCopies(title, hint, texts, picture) {
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
    put(this.dialog, "aria-label", title);
    this.dialog.replaceChildren(
      h("h2", {}, title),
      h("p", { class: "bs-hint" }, hint),
      ...texts.map(({ title, command }, at) => h("div", { class: "bs-command" }, h("h3", {}, title), h("pre", { tabindex: 0 }, command), button("Copy", () => copy(command), { "aria-label": `Copy: ${title}` }), at === 0 ? picture : null)),
      h("div", { class: "bs-row" }, close, said),
    );
    this.dialog.showModal();
  }

  listen() {
    let inside = 0;
    const hasFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
    const show = (by) => {
      inside = Math.max(0, inside + by);
      give(this.dropping, "hidden", inside === 0);
    };
    document.addEventListener("dragenter", (event) => hasFiles(event) && (event.preventDefault(), show(1)));
    document.addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
    document.addEventListener("dragleave", (event) => hasFiles(event) && show(-1));
    document.addEventListener("drop", async (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      show(-Infinity);
      inside = 0;
      for (const file of event.dataTransfer?.files ?? []) await this.take(file);
    });
    document.addEventListener("paste", (event) => {
      const text = event.clipboardData?.getData("text/plain") ?? "", [file] = event.clipboardData?.files ?? [];
      const typing = event.target instanceof HTMLElement && event.target.closest("input, textarea, select");
      if (file) this.take(file);
      else if (isTable(text)) this.paste(text);
      else return;
      event.preventDefault();
      if (typing) /** @type {HTMLElement} */ (typing).blur();
    });
  }
}
