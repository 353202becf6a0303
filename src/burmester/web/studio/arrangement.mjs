// How the page is arranged: panels that fold, the drawer with its tabs, and what this browser remembers of it.

import { give, h, put } from "../widget/dom.mjs";
import { clamp } from "../widget/numbers.mjs";
import { button } from "./fields.mjs";

const KEY = "burmester.studio.arrangement";
const LEAST = 120; // pixels: a lower drawer shows nothing
const LEFT = 160; // pixels of the height that a drawer leaves to the plane
const STEP = 24; // pixels of an arrow key

/** What was remembered of the arrangement, in a browser that keeps anything. */
const kept = (() => {
  try {
    return Object(JSON.parse(localStorage.getItem(KEY) ?? "{}"));
  } catch {
    return {};
  }
})();

/** @param {string} name @param {unknown} value */
function remember(name, value) {
  kept[name] = value;
  try {
    localStorage.setItem(KEY, JSON.stringify(kept));
  } catch {
    // the arrangement lasts as long as the page
  }
}

/** The whole page is laid out anew: plots and the plane take their new sizes. */
const resized = () => dispatchEvent(new Event("resize"));

/** One of a group is reached by Tab, the others from there by arrow keys, Home and End; in a text or a choice only
 * by those that it has no use for.
 * @param {Element} group @param {string} which selects them */
export function walkByArrows(group, which) {
  const all = () => [...group.querySelectorAll(which)].filter((each) => each.checkVisibility() && !(/** @type {any} */ (each).disabled));
  const stop = (one) => {
    for (const each of group.querySelectorAll(which)) put(each, "tabindex", each === one ? 0 : -1);
  };
  const first = () => stop(group.querySelector(`${which}[aria-selected=true]`) ?? all()[0] ?? group.querySelector(which));
  group.addEventListener("focusin", ({ target }) => target instanceof Element && target.matches(which) && stop(target));
  group.addEventListener("focusout", (/** @type {any} */ event) => group.contains(event.relatedTarget) || first()); // what is there now may be gone later
  group.addEventListener("keydown", (/** @type {any} */ event) => {
    const { target, key } = event, there = all(), at = there.indexOf(target), last = there.length - 1;
    const to = { ArrowRight: at + 1, ArrowDown: at + 1, ArrowLeft: at - 1, ArrowUp: at - 1, Home: 0, End: last }[key];
    if (at < 0 || to === undefined || event.ctrlKey || event.metaKey || event.altKey) return;
    if (target.matches("select") && !/Left|Right/.test(key)) return;
    if (target.matches("input[type=text], input:not([type])") && !(target.selectionStart === target.selectionEnd && target.selectionStart === { ArrowLeft: 0, ArrowRight: target.value.length }[key])) return;
    event.preventDefault();
    /** @type {HTMLElement} */ (there[(to + there.length) % there.length]).focus();
  });
  return { stop, first };
}

/** A panel beside the plane, which folds to a strip. */
export function sidePanel(name, title, element, attributes = {}) {
  const fold = button("", () => show(!panel.classList.contains("bs-folded"), true), { class: "bs-fold", "data-fold": name });
  const panel = h("section", { class: `bs-side bs-side-${name}`, "aria-label": title, ...attributes }, fold, element);
  const show = (folded, said = false) => {
    panel.classList.toggle("bs-folded", folded);
    put(fold, "aria-expanded", !folded);
    put(fold, "aria-label", `${folded ? "Show" : "Hide"}: ${title}`);
    give(fold, "title", fold.getAttribute("aria-label"));
    fold.replaceChildren(h("span", { "aria-hidden": "true" }, (name === "left") === folded ? "»" : "«"), h("span", { class: "bs-fold-name", "aria-hidden": "true" }, title));
    if (!said) return;
    remember(`${name} folded`, folded);
    resized();
  };
  show(kept[`${name} folded`] === true);
  return panel;
}

/** Tabs under the plane.  The tab that is open closes the drawer when it is pressed again. */
export class Drawer {
  constructor() {
    this.tabs = new Map();
    this.list = h("div", { class: "bs-tabs", role: "tablist", "aria-label": "Charts, maps and tables" });
    this.grip = h("div", { class: "bs-grip", role: "separator", tabindex: 0, "aria-orientation": "horizontal", "aria-label": "Height of the drawer", title: "Drag to change the height" });
    this.panels = h("div", { class: "bs-drawer-panels", id: "bs-panels" });
    this.element = h("section", { class: "bs-drawer", "aria-label": "Charts, maps and tables" }, this.grip, this.list, this.panels);
    this.walk = walkByArrows(this.list, "[role=tab]");
    this.listen();
    this.setHeight(kept.height);
    this.open(null);
    addEventListener("beforeprint", () => this.showAll(true)); // on paper there are no tabs
    addEventListener("afterprint", () => this.showAll(false));
  }

  /** One tab more; it is there while `isWanted`, which `update` asks. */
  add(name, title, element, isWanted = () => true) {
    const tab = h("button", { type: "button", role: "tab", class: "bs-tab", id: `bs-tab-${name}`, "data-tab": name, "aria-controls": `bs-panel-${name}`, onclick: () => this.open(this.shown === name ? null : name, true) }, title);
    const panel = h("section", { class: `bs-panel bs-panel-${name}`, id: `bs-panel-${name}`, role: "tabpanel", tabindex: 0, "data-panel": name, "aria-labelledby": tab.id }, h("h2", {}, title), element);
    this.tabs.set(name, { tab, panel, isWanted });
    this.list.append(tab);
    this.panels.append(panel);
    this.open(this.shown ?? (kept.tab === name ? name : null));
  }

  /** Tabs that mean nothing for the task are not there. */
  update() {
    for (const { tab, panel, isWanted } of this.tabs.values()) {
      give(tab, "hidden", !isWanted());
      panel.classList.toggle("bs-unwanted", tab.hidden);
    }
    if (this.tabs.get(this.shown)?.tab.hidden) this.open(null);
    this.walk.first();
  }

  /** Open a tab; null: none. */
  open(name, said = false) {
    this.shown = name;
    for (const [each, { tab, panel }] of this.tabs) {
      put(tab, "aria-selected", each === name);
      give(panel, "hidden", each !== name);
    }
    this.element.classList.toggle("bs-closed", name === null);
    give(this.grip, "hidden", name === null);
    this.walk.first();
    if (said) remember("tab", name);
    resized();
  }

  showAll(on) {
    this.element.classList.toggle("bs-on-paper", on);
    for (const [each, { panel, tab }] of this.tabs) give(panel, "hidden", on ? tab.hidden : each !== this.shown);
  }

  setHeight(height) {
    const most = Math.max(LEAST, innerHeight - LEFT);
    this.height = clamp(Number.isFinite(height) ? height : 0.34 * innerHeight, LEAST, most);
    this.element.style.setProperty("--bs-height", `${Math.round(this.height)}px`);
    for (const [name, value] of Object.entries({ min: LEAST, max: most, now: this.height })) put(this.grip, `aria-value${name}`, Math.round(value));
  }

  listen() {
    const { grip } = this;
    const take = (height) => {
      this.setHeight(height);
      remember("height", this.height);
      resized();
    };
    let from = null;
    grip.addEventListener("pointerdown", (event) => {
      event.preventDefault();
      grip.setPointerCapture(event.pointerId);
      from = { y: event.clientY, height: this.height };
    });
    grip.addEventListener("pointermove", (event) => from && take(from.height + from.y - event.clientY));
    for (const name of ["pointerup", "pointercancel"]) grip.addEventListener(name, () => (from = null));
    grip.addEventListener("keydown", (event) => {
      const by = { ArrowUp: STEP, ArrowDown: -STEP }[event.key];
      if (!by) return;
      event.preventDefault();
      take(this.height + by);
    });
  }
}

/** Where there is no room beside the plane, one of these stands there at a time: [name, title, element]. */
export function sheets(root, all) {
  const buttons = all.map(([name, title]) => button(title, () => show(name, true), { class: "bs-sheet", "data-sheet-of": name }));
  const show = (name, said = false) => {
    all.forEach(([each, , element], k) => {
      element.classList.toggle("bs-below", each !== name);
      put(buttons[k], "aria-pressed", each === name);
    });
    if (!said) return;
    remember("sheet", name);
    resized();
  };
  show(all.some(([name]) => name === kept.sheet) ? kept.sheet : all[1][0]);
  return h("div", { class: "bs-sheets", role: "group", "aria-label": "Beside the plane" }, buttons);
}
