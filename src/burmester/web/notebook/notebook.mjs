// The studio in a cell of a notebook, in anywidget's module format.  Python's side is `burmester.notebook`.

import studioStyle from "../assets/studio.css";
import sharedStyle from "../assets/widget.css";
import { Answers } from "../studio/answers.mjs";
import { BodyEditor } from "../studio/body_editor.mjs";
import { bodyOf, limitRegions, regionsOf } from "../studio/document.mjs";
import { button } from "../studio/fields.mjs";
import { listenToKeys, listenToSpace } from "../studio/keyboard.mjs";
import { LiveLinkage } from "../studio/live_linkage.mjs";
import { Playing, playOnce } from "../studio/playing.mjs";
import { PoseHandles, PoseTool } from "../studio/pose_handles.mjs";
import { Regions } from "../studio/regions.mjs";
import { Results } from "../studio/results.mjs";
import { Scene } from "../studio/scene.mjs";
import { Store } from "../studio/store.mjs";
import { give, h, put, say } from "../widget/dom.mjs";
import { Kernel } from "./kernel.mjs";
import ownStyle from "./notebook.css";
import { dress } from "./theme.mjs";

const MOST_FLYING = 2; // follows on their way: while one is answered the next one comes; more make the machine slower
const PATIENCE = 700; // milliseconds until solving may be stopped
const BUSY = "The kernel is busy: what is done here is answered when it is free.";
const SAVED = "No kernel answers: this is the linkage as it was last. Run the cell to take hold of it.";
const HINT = "Drag a pose by its point, turn it by the tip of its arrow.";
const ROOM = "Drag poses by their points, turn them by the tips of their arrows; limits, regions and the body are dragged, too.";

function render({ model, el }) {
  const line = h("p", { class: "bn-line" }, "Waiting for the kernel…"), still = h("div", { class: "bn-still" });
  still.append(...new DOMParser().parseFromString(model.get("still") ?? "", "text/html").body.childNodes);
  const ended = new AbortController(), { signal } = ended, kernel = new Kernel(model);
  const host = h("div", {}), frame = h("div", { class: "bm bs bn" }, line, still);
  host.attachShadow({ mode: "open" }).append(frame);
  el.replaceChildren(host);
  dress(host.shadowRoot, [sharedStyle, studioStyle, ownStyle], signal);
  keepKeys(host);
  let studio = null;
  kernel.on("message", (message) => {
    if (message.kind === "opened" && !studio) studio = layOut(frame, kernel, message, turn);
  });
  kernel.on("told", (message) => {
    if (message.kind === "task" && message.by !== kernel.view) studio?.replace(message.document);
    else if (message.kind === "chosen" && message.id) studio?.store.choose(message.id);
  });
  const turn = () => {
    model.set("turn", model.get("turn") + 1);
    model.save_changes();
  };
  kernel.on("busy", (on) => on && say(line, SAVED));
  kernel.send({ do: "open" });
  return () => {
    ended.abort();
    kernel.close();
    studio?.playing.player.play(false);
    el.replaceChildren();
  };
}

/** The parts of the widget in its frame; turn: to be called where Python has something new. */
function layOut(frame, kernel, { document: task }, turn) {
  const store = new Store({ connection: kernel, document: task, mostFlying: MOST_FLYING });
  const scene = new Scene(store, { zoomKey: true }), answers = new Answers(store), playing = new Playing(store, answers);
  new LiveLinkage(answers, playing, scene);
  new BodyEditor(store, scene);
  new Regions(store, scene);
  new PoseHandles(store, scene);
  const results = new Results(store, answers, playing), left = h("div", { class: "bn-left" }, bar(store, scene, kernel), scene.element, playing.element);
  const ways = playing.element.querySelector(".bs-player-ways"), fold = h("details", { class: "bn-ways" }, h("summary", {}, "Driver and assembly"));
  ways.replaceWith(fold);
  fold.append(ways);
  frame.replaceChildren(h("div", { class: "bn-main" }, left, results.element));
  scene.resize();
  const refit = fitOnceSolved(store, scene);
  listenToKeys(store, scene, null, frame);
  listenToSpace(playing, frame);
  playOnce(store, answers, playing);
  store.on("chosen", () => {
    kernel.send({ do: "choose", id: store.chosen, basis: store.basis });
    turn();
  });
  kernel.emit("open");
  const replace = (document) => {
    if (JSON.stringify(document) !== JSON.stringify(store.document)) {
      store.replace({ document });
      refit();
    } else if (store.solvedFor === store.document) {
      return;
    }
    store.solve(); // its answer is there
  };
  return { store, playing, replace };
}

/** What is done in the plane, and a line that says what can be done, or what is wrong. */
function bar(store, scene, kernel) {
  const undo = button("↶", () => store.undo(), { "data-do": "undo", title: "Undo (Ctrl+Z)", "aria-label": "Undo" });
  const redo = button("↷", () => store.redo(), { "data-do": "redo", title: "Redo (Ctrl+Shift+Z)", "aria-label": "Redo" });
  const stop = button("Stop", () => store.cancel(), { "data-do": "cancel", title: "Stop solving", hidden: true });
  const pose = button("Add poses", () => scene.use(scene.tool ? null : new PoseTool(store, scene)), { "data-do": "add-poses", "aria-pressed": "false" });
  const line = h("p", { class: "bn-line", role: "status" });
  let isBusy = false;
  const show = () => {
    give(undo, "disabled", !store.history.canUndo);
    give(redo, "disabled", !store.history.canRedo);
    const [said] = store.messages, solving = store.state === "solving" && store.progress;
    put(pose, "aria-pressed", Boolean(scene.tool));
    const text = isBusy ? BUSY : said ? [said.message, said.help].filter(Boolean).join("; ") : scene.tool ? scene.tool.hint : solving ? `Solving: ${store.progress}` : hint(store.document);
    if (line.textContent !== text) line.textContent = text;
    line.classList.toggle("bn-refused", Boolean(said));
  };
  kernel.on("busy", (on) => {
    if (on === isBusy) return;
    isBusy = on;
    show();
  });
  let waiting;
  store.on("state", () => {
    clearTimeout(waiting);
    if (store.state === "solving") waiting = setTimeout(() => give(stop, "hidden", false), PATIENCE);
    else give(stop, "hidden", true);
  });
  store.on("document state messages solved", show);
  scene.on("tool", show);
  show();
  return h("div", { class: "bn-bar" }, undo, redo, pose, button("Fit", () => scene.fitAgain(), { "data-do": "fit", title: "Show all poses and pivots (0)" }), stop, line);
}

/** What can be dragged. */
function hint(document) {
  return limitRegions(document).length || regionsOf(document).length || bodyOf(document).length ? ROOM : HINT;
}

/** The first answer to a task brings pivots that its first view did not know; calling what is returned waits for another. */
function fitOnceSolved(store, scene) {
  let waits = true;
  store.on("solved", () => {
    if (waits && scene.isFitted) scene.fit();
    waits = false;
  });
  return () => (waits = true);
}

/** Keys in the widget are its own; those with Ctrl or Cmd are the notebook's, but for undo and redo. */
function keepKeys(host) {
  host.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || /^[zy]$/i.test(event.key)) event.stopPropagation();
  });
}

export default { render };
