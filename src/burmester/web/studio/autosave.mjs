// The task is kept: in this tab at once, so that a reload loses nothing, and by the server for the next time.

import { put } from "../widget/dom.mjs";

const KEY = "burmester.studio", TAB = "burmester.studio.tab";
const SOON = 400; // milliseconds of rest before it is kept
const ROOM = 1_000_000; // characters of undo entries that a tab keeps

export class Autosave {
  constructor(store) {
    this.store = store;
    store.on("document chosen pinned filters picture", () => this.soon());
    store.connection.on("open", () => this.isOpen && this.soon()); // what the server missed
    addEventListener("pagehide", () => this.keep());
    document.addEventListener("visibilitychange", () => document.visibilityState === "hidden" && this.keep());
  }

  soon() {
    clearTimeout(this.timer);
    this.isOpen = true;
    put(document.documentElement, "data-kept", false);
    this.timer = setTimeout(() => this.keep(), SOON);
  }

  keep() {
    if (!this.isOpen) return;
    this.isOpen = false;
    clearTimeout(this.timer);
    const { document: task, options, name, settings, keptPicture: picture, filters, choice, history, connection } = this.store, text = { document: task, options, name, settings, picture };
    document.documentElement.dataset.kept = "true";
    try {
      sessionStorage.setItem(KEY, JSON.stringify({ ...text, filters, choice, history: history.kept(ROOM) }));
    } catch {
      // a tab that keeps nothing, or is full: the server keeps it
    }
    connection.post("/autosave", { ...text, tab: tabName() }, "PUT").catch(() => (this.isOpen = true)); // once more after the next change
  }
}

/** A name of this tab's own, so that two tabs keep two tasks. */
function tabName() {
  try {
    const name = sessionStorage.getItem(TAB) ?? crypto.randomUUID();
    sessionStorage.setItem(TAB, name);
    return name;
  } catch {
    return "tab";
  }
}

/** What this tab kept before it was loaded again, or null. */
export function keptHere() {
  try {
    const kept = JSON.parse(sessionStorage.getItem(KEY) ?? "null");
    if (!Array.isArray(kept?.document?.poses)) return null;
    // A task that did not change from one entry to the next is one object again, so that its answer stays.
    const seen = new Map(), shared = (value) => {
      const key = JSON.stringify(value);
      if (!seen.has(key)) seen.set(key, value);
      return seen.get(key);
    };
    for (const each of [kept, ...(kept.history?.past ?? []), ...(kept.history?.future ?? [])]) Object.assign(each, { document: shared(each.document), options: shared(each.options) });
    return kept;
  } catch {
    return null;
  }
}
