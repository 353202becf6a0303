// What the page has to say: the server is gone, solving took too long, a task was refused, work of last time is kept.

import { h, put, say } from "../widget/dom.mjs";
import { button } from "./fields.mjs";

const ROLES = { refused: "alert", offline: "alert", limit: "alert", ended: "alert", expired: "alert" };

const LONGEST_HELP = 240; // characters; of a longer one the rest is folded
const NO_FILE = "task.json"; // what the server calls the task of this page, which is in no file

/** A message of the readers: what happened and where, why, and what to do. */
function sentenceOf({ code, message, where, why, help }) {
  return h("li", {},
    code ? h("span", { class: "bm-code" }, code) : null, " ", h("span", {}, message),
    where && !where.startsWith(NO_FILE) ? h("pre", { class: "bs-where" }, where) : null,
    why ? h("p", { class: "bs-why" }, `Why: ${why}.`) : null, help ? helpOf(help) : null);
}

/** What to do; of a long help the first clause, the rest folded. */
function helpOf(help) {
  if (help.length <= LONGEST_HELP) return h("p", { class: "bs-help" }, `What to do: ${help}.`);
  const end = help.slice(0, LONGEST_HELP).lastIndexOf("; "), cut = end > 0 ? end : help.slice(0, LONGEST_HELP).lastIndexOf(" ");
  return h("div", { class: "bs-help" }, h("p", {}, `What to do: ${help.slice(0, cut)}${end > 0 ? "." : " …"}`),
    h("details", {}, h("summary", {}, "More"), h("p", {}, `${help.slice(cut).replace(/^[; ]+/, "")}.`)));
}

export class Banners {
  /** @type {any} */ files;

  constructor(store) {
    this.store = store;
    this.shown = new Map(); // by kind: one of each
    this.element = h("div", { class: "bs-banners" });
    this.status = h("p", { class: "bs-status" });
    this.live = h("p", { class: "bs-unseen", role: "status" }); // what is said aloud: answers, not each step to them
    new ResizeObserver(() => document.body.style.setProperty("--bs-banners", `${this.element.offsetHeight}px`)).observe(this.element);
    store.on("messages", () => this.messages());
    store.on("state solved messages", () => this.state());
  }

  /** Show a banner of a kind in place of the one before; actions: buttons. */
  /** @param {string} kind @param {any} title @param {any[]} messages @param {{ undo?: boolean, actions?: any[] }} how */
  say(kind, title, messages = [], { undo = false, actions = [] } = {}) {
    const close = button("✕", () => this.close(kind), { "aria-label": "Close", class: "bs-close" });
    const all = [...actions, ...(undo ? [button("Undo", () => (this.close(kind), this.store.undo()))] : [])];
    const banner = h("section", { class: `bs-banner bs-${kind}`, role: ROLES[kind] ?? "status", "data-banner": kind },
      h("p", { class: "bs-banner-title" }, title), messages.length ? h("ul", {}, messages.map(sentenceOf)) : null, all.length ? h("div", { class: "bs-row" }, all) : null, kind === "offline" ? null : close);
    this.shown.get(kind)?.remove();
    this.shown.set(kind, banner);
    this.element.append(banner);
    return banner;
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
    if (!first || store.document.poses.length < 2) return; // the line above the plane says what to do
    const shown = store.solved?.linkages.length ? " What is shown was followed from the answer before." : "";
    if (first.tone === "cancelled") this.say("note", `Solving was stopped.${shown}`, [], { actions: [this.again()] });
    else if (first.tone === "limit") this.say("limit", `Solving took too long and was stopped. Nothing of the task is lost.${shown}`, messages, { actions: [this.again()] });
    else if (first.tone === "ended") this.say("ended", "The process that computes for this page has ended. Nothing of the task is lost.", messages, { actions: [this.again()] });
    else this.say("refused", "The task cannot be solved as it is.", messages);
  }

  again() {
    return button("Solve again", () => {
      this.close("note");
      this.close("limit");
      this.close("ended");
      this.store.solve();
    }, { "data-do": "solve-again" });
  }

  state() {
    const { store } = this, solving = store.state === "solving";
    if (store.state === "offline") this.offline();
    else this.close("offline");
    put(this.status, "data-state", store.state);
    if (store.state === "dragging") return;
    const said = store.state === "offline" ? "Not connected" : this.summary();
    say(this.status, solving ? `Solving${store.progress ? `: ${store.progress}` : "…"}` : said);
    if (!solving && said) say(this.live, said);
  }

  summary() {
    const { solved, solvedFor, document, messages } = this.store;
    if (document.poses.length < 2) return "Two poses or more make a task";
    if (messages.length) return "Not solved";
    if (!solved || solvedFor !== document) return "";
    const count = solved.linkages.length, usable = solved.linkages.filter((each) => each.usable).length;
    return count ? `${count} linkage${count === 1 ? "" : "s"}, ${usable} usable` : "No linkage";
  }

  offline() {
    if (this.shown.has("offline")) return;
    this.say("offline", "The server does not answer. Nothing is lost: the task is in this page, and can still be changed and saved.", [], {
      actions: [
        button("Save the task (JSON)", () => this.files.saveWithoutServer(), { "data-do": "save-json" }),
        h("span", { class: "bs-hint" }, "The page tries again by itself. If the server has ended, start burmester studio with that file, or drop the file on the new page."),
      ],
    });
  }

  /** Another server answers at this address, which asks for its own token. */
  expired() {
    this.close("offline");
    this.say("expired", "The server was started anew. Nothing is lost: open the address that it printed in this tab, and go on here.", [], {
      actions: [button("Save the task (JSON)", () => this.files.saveWithoutServer())],
    });
  }
}
