// The studio: one page on which a linkage is designed by hand.  Lengths are in the task's unit, angles in degrees
// where a document or a name says so, else in radians; F is the ground, M the body.

import { give, h, put, say } from "../widget/dom.mjs";
import { Autosave, keptHere } from "./autosave.mjs";
import { Banners } from "./banners.mjs";
import { BodyEditor } from "./body_editor.mjs";
import { currentLinkage } from "./conditions.mjs";
import { Connection, Refused } from "./connection.mjs";
import { isPath, isPoint } from "./document.mjs";
import { ExportSettings } from "./export_settings.mjs";
import { button } from "./fields.mjs";
import { Files } from "./files.mjs";
import { decodeFrame } from "./frames.mjs";
import { keyList, listenToKeys } from "./keyboard.mjs";
import { PathCurve, PathTool } from "./path_curve.mjs";
import { PathPanel } from "./path_panel.mjs";
import { PointTool, PoseHandles, PoseTool } from "./pose_handles.mjs";
import { PoseTable } from "./pose_table.mjs";
import { Regions } from "./regions.mjs";
import { addResults } from "./answer_panels.mjs";
import { Scene } from "./scene.mjs";
import { Store } from "./store.mjs";
import { TaskPanel } from "./task_panel.mjs";

const EMPTY = "An empty task: add poses or points here, draw a path, paste rows of a spreadsheet, drop a file, or take a template.";
const CURVE = "Drag a point of the curve, or draw another one: the linkages are looked for anew.";
const POINTS = "Drag a pose or a point: the linkages are looked for anew.";
const FIRST = "Drag a pose by its point, turn it by the tip of its arrow: every linkage answers at once.";

/** The parts of the page, laid out in `root`. */
function layOut(root, store, start) {
  const scene = new Scene(store), banners = new Banners(store), files = new Files(store, start, banners);
  banners.files = files;
  const body = new BodyEditor(store, scene), regions = new Regions(store, scene);
  const panel = new TaskPanel(store, scene, regions, body, files, start.form), handles = new PoseHandles(store, scene), table = new PoseTable(store, scene);
  const curve = new PathCurve(store, scene), path = new PathPanel(store, scene);
  const player = h("div", { id: "bs-player" }), results = h("aside", { id: "bs-results", "aria-label": "Linkages" }), panels = h("div", { id: "bs-panels" });
  const name = h("input", { class: "bs-text bs-task-name", "aria-label": "Name of the task", autocomplete: "off", spellcheck: "false", onchange: () => store.rename(name.value.trim() || "task") });
  const undo = button("↶", () => store.undo(), { "data-do": "undo", title: "Undo (Ctrl+Z)", "aria-label": "Undo" }), redo = button("↷", () => store.redo(), { "data-do": "redo", title: "Redo (Ctrl+Shift+Z)", "aria-label": "Redo" });
  const show = () => {
    if (document.activeElement !== name) give(name, "value", store.name.replace(/[\r\n]+/g, " "));
    give(undo, "disabled", !store.history.canUndo);
    give(redo, "disabled", !store.history.canRedo);
  };
  store.on("document", show);
  show();
  root.replaceChildren(
    h("header", { class: "bs-head" }, h("h1", {}, "burmester studio"), name, h("div", { class: "bs-row" }, undo, redo), files.element, banners.status, banners.live),
    banners.element,
    h("main", { class: "bs-main" },
      h("section", { class: "bs-left", "aria-label": "The task" }, h("div", { class: "bm-card" }, h("h2", {}, "Poses"), table.element, path.element), h("div", { class: "bm-card" }, panel.element, new ExportSettings(store, scene).element)),
      h("section", { class: "bs-stage bm-card", "aria-label": "The plane" }, stageBar(store, scene, () => files.opened()), scene.element, player),
      results, panels),
  );
  scene.resize();
  addResults(store, scene, { player, results, panels });
  listenToKeys(store, scene, files);
  new Autosave(store);
  files.opened = refitWhenSolved(store, scene);
  return { scene, banners, files, body, regions, panel, handles, table, curve, path };
}

/** What is done in the plane, and one line that says what can be dragged. */
function stageBar(store, scene, drawn) {
  const pose = button("Add poses", () => scene.use(scene.tool?.name === "pose" ? null : new PoseTool(store, scene)), { "data-do": "add-poses", "aria-pressed": "false" });
  const toggle = (text, name, make, data) => button(text, () => scene.use(scene.tool?.name === name ? null : make()), { "data-do": data, "aria-pressed": "false" });
  const point = toggle("Add points", "point", () => new PointTool(store, scene), "add-points");
  const path = toggle("Draw a path", "path", () => new PathTool(store, scene, drawn), "draw-path");
  const stop = button("Stop solving", () => store.cancel(), { "data-do": "cancel", hidden: true });
  const line = h("p", { class: "bs-line" });
  const show = () => {
    say(line, scene.tool?.hint ?? (store.document.poses.length ? (isPath(store.document) ? CURVE : store.document.poses.some(isPoint) ? POINTS : FIRST) : EMPTY));
    for (const [each, name] of [[pose, "pose"], [point, "point"], [path, "path"]]) put(each, "aria-pressed", scene.tool?.name === name);
  };
  scene.on("tool", show);
  store.on("document", show);
  // Offered only where solving is not over at once.
  let waiting;
  store.on("state", () => {
    clearTimeout(waiting);
    if (store.state === "solving") waiting = setTimeout(() => give(stop, "hidden", false), 700);
    else give(stop, "hidden", true);
  });
  show();
  return h("div", { class: "bs-bar" },
    h("div", { class: "bs-row" }, pose, point, path, button("Fit", () => scene.fitAgain(), { "data-do": "fit", title: "Show the poses; once more: all of the body and the regions, too (0)" }),
      button("+", () => scene.zoom(1.25, scene.size.width / 2, scene.size.height / 2), { "aria-label": "Zoom in" }), button("−", () => scene.zoom(0.8, scene.size.width / 2, scene.size.height / 2), { "aria-label": "Zoom out" }), ...keyList(), stop),
    line);
}

/** The first answer to a task brings pivots that its first view did not know. */
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

/** Whether a point is not so far from the poses that it would dwarf them. */
function isNear({ solved, document: { poses } }, [x, y]) {
  return poses.some((pose) => Math.hypot(x - pose.x, y - pose.y) < 3 * (solved?.scene ?? Infinity));
}

/** A new token in the address: the server was started anew, and its address opened in this tab. */
function listenToTokens(connection, banners) {
  addEventListener("hashchange", async () => {
    if (!location.hash) return;
    await connection.session();
    connection.open();
  });
  let asked = false;
  connection.on("open", () => banners.close("expired")); // the new address was opened, in this tab or in another one
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
  const root = /** @type {HTMLElement} */ (document.getElementById("studio")), connection = new Connection(decodeFrame);
  try {
    await connection.session();
    const start = await connection.get("/start"), kept = keptHere();
    const store = new Store({ connection, document: start.document, options: start.options, name: start.name, ...kept });
    const parts = layOut(root, store, start);
    if (start.saved && !kept) offerSaved(store, parts, start.saved);
    listenToTokens(connection, parts.banners);
    document.documentElement.dataset.ready = "true";
    connection.open();
  } catch (error) {
    addEventListener("hashchange", () => location.reload()); // another address, opened in this tab
    const [told] = error instanceof Refused && error.status === 401 ? error.messages : [];
    root.replaceChildren(h("p", { class: "bs-failed", role: "alert" }, told
      ? `The studio is not shown here: ${told.message}. What to do: ${told.help}.`
      : `The page could not start: ${/** @type {Error} */ (error).message}. Is burmester studio still running? Start it again and open the address that it prints.`));
    if (!(error instanceof Refused)) throw error;
  }
}

function offerSaved(store, { banners, files }, saved) {
  const when = typeof saved.when === "number" ? new Date(1000 * saved.when).toLocaleString() : saved.when;
  banners.say("saved", `Your task of last time, ${saved.name}${when ? ` (${when})` : ""}, was kept.`, [], {
    actions: [button("Go on with it", () => {
      banners.close("saved");
      store.replace(saved);
      files.opened();
    }, { "data-do": "restore" })],
  });
}

main();
