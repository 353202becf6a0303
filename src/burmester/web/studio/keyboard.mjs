// Keys of the whole page; those of a handle or a field are theirs.

import { h } from "../widget/dom.mjs";
import { button } from "./fields.mjs";

const KEYS = [
  ["Tab", "from the plane to the first pose, from handle to handle, field to field"],
  ["← →", "in a bar, a menu, a row of tabs or the list of linkages: from one to the next"],
  ["arrow keys", "move what has the focus by a step: a pose, the tip that turns it, a corner, a shape, a number; Shift: ten steps, Alt: a tenth"],
  ["Shift, Alt", "while a hand drags: Shift holds an axis or steps of 15°, Alt frees it from what it snaps to"],
  ["Shift and a click or a box", "selects several poses, which are moved, turned and deleted together"],
  ["a digit", "after a drag: the number is typed beside the handle"],
  ["Delete", "removes the pose, the corner or the shape"],
  ["Enter", "closes an outline; puts a shape in the middle while it is drawn"],
  ["Escape", "gives up what is under way: a drag, a drawing, a selection"],
  ["+ − 0", "on the plane: zoom and fit; arrow keys pan it"],
  ["space", "plays and stops"],
  ["?", "this list"],
  ["Ctrl+Z, Ctrl+Shift+Z", "undo and redo"],
  ["Ctrl+S, Ctrl+O, Ctrl+V", "save the task, open a file, paste rows of a spreadsheet"],
];

/** A button that shows what keys do, and so does the key ?. */
export function keyList() {
  const close = button("Close", () => dialog.close());
  const dialog = h("dialog", { class: "bs-dialog", "aria-label": "Keys" }, h("h2", {}, "Keys"),
    h("dl", { class: "bs-keys" }, KEYS.map(([key, what]) => h("div", {}, h("dt", {}, key), h("dd", {}, what)))), close);
  document.addEventListener("keydown", (event) => {
    if (event.key === "?" && !written(event.target) && !dialog.open) dialog.showModal();
  });
  return [button("?", () => dialog.showModal(), { "data-do": "keys", "aria-label": "Keys", title: "What keys do (?)" }), dialog];
}

const TYPED_IN = "button, input, select, textarea, summary, a, [role=button], [role=slider]"; // elements with a use of their own for space

const written = (element) => element?.matches?.("input:not([type=checkbox]):not([type=radio]):not([type=range]), textarea");

/** @typedef {{ save: Function, chooser: HTMLElement }} Opener */

/** Undo and redo, and save and open where there are files; Escape ends a gesture, then a tool, then a selection.
 * root: where keys are heard, the page or a part of it.
 * @param {any} store @param {any} scene @param {Opener | null} files @param {any} root */
export function listenToKeys(store, scene, files = null, root = document) {
  const acts = (event) => ({ z: () => (event.shiftKey ? store.redo() : store.undo()), y: () => store.redo(), ...(files && { s: () => files.save(), o: () => files.chooser.click() }) });
  root.addEventListener("keydown", (event) => {
    const { key, target } = event, control = (event.ctrlKey || event.metaKey) && !event.altKey;
    if (control) {
      const act = acts(event)[key.toLowerCase()];
      // A text that is being typed has the browser's own undo.
      if (!act || (written(target) && /** @type {HTMLElement} */ (target).dataset.typing === "true" && /^[zy]$/i.test(key))) return;
      event.preventDefault();
      act();
    } else if (scene.dragged && key === "Escape") {
      event.preventDefault();
      scene.dragged.cancel();
    } else if (scene.tool && !written(target) && scene.tool.key(event)) {
      event.preventDefault();
      event.stopPropagation();
    } else if (key === "Escape" && !written(target) && store.selection) {
      store.select(null);
    }
  }, true);
  // From the plane Tab goes to the chosen pose, or to the first one: limits and pivots stand before it.
  scene.svg.addEventListener("keydown", (event) => {
    if (event.key !== "Tab" || event.shiftKey || event.target !== scene.svg) return;
    const pose = scene.svg.querySelector(".bs-pose.bs-selected .bs-origin, .bs-pose .bs-origin");
    if (!pose) return;
    event.preventDefault();
    pose.focus();
  });
  root.addEventListener("input", ({ target }) => target instanceof HTMLElement && (target.dataset.typing = "true"));
  for (const name of ["change", "focusout"]) root.addEventListener(name, ({ target }) => target instanceof HTMLElement && delete target.dataset.typing);
}

/** Space plays and stops wherever it has no other use. */
export function listenToSpace({ player }, root = document) {
  root.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.ctrlKey || event.metaKey || event.altKey || (event.target instanceof Element && event.target.closest(TYPED_IN)) || !player.path) return;
    event.preventDefault();
    player.play(!player.playing);
  });
}
