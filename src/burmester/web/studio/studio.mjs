// The studio: one page on which a linkage is designed by hand.  Lengths are in the task's unit, angles in degrees
// where a document or a name says so, else in radians; F is the ground, M the body.

import { give, h, put, say } from "../widget/dom.mjs";
import { Drawer, sheets, sidePanel, walkByArrows } from "./arrangement.mjs";
import { Autosave, keptHere } from "./autosave.mjs";
import { Banners } from "./banners.mjs";
import { BodyEditor } from "./body_editor.mjs";
import { currentLinkage } from "./conditions.mjs";
import { Connection, linkInAddress, Refused } from "./connection.mjs";
import { isPath, isPoint } from "./document.mjs";
import { ExportSettings } from "./export_settings.mjs";
import { button } from "./fields.mjs";
import { Files, tools } from "./files.mjs";
import { decodeFrame } from "./frames.mjs";
import { keyList, listenToKeys } from "./keyboard.mjs";
import { JudgePanel } from "./judge_panel.mjs";
import { LoadHandles } from "./load_handles.mjs";
import { LoadsPanel } from "./loads_panel.mjs";
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
const PATIENCE = 700; // milliseconds until solving may be stopped
const FIRST = "Drag a pose by its point, turn it by the tip of its arrow: every linkage answers at once.";

/** The parts of the page, laid out in `root`. */
function layOut(root, store, start) {
  const scene = new Scene(store), banners = new Banners(store), files = new Files(store, start, banners);
  banners.files = files;
  const body = new BodyEditor(store, scene), regions = new Regions(store, scene);
  const settings = new ExportSettings(store, scene, start.exports ?? [], files);
  const panel = new TaskPanel(store, scene, regions, body, files, start.form), handles = new PoseHandles(store, scene), table = new PoseTable(store, scene);
  const curve = new PathCurve(store, scene), path = new PathPanel(store, scene);
  const player = h("div", { id: "bs-player" }), cards = h("div", { id: "bs-results" }), drawer = new Drawer();
  const poses = h("details", { class: "bs-section bs-section-poses", "data-section": "poses", open: true }, h("summary", {}, "Poses"), table.element, path.element);
  const left = sidePanel("left", "The task", h("div", { class: "bs-left" }, poses, panel.element, ...laterSections(store, scene, banners, start.form)));
  const right = sidePanel("right", "Linkages", cards);
  root.replaceChildren(
    h("a", { class: "bs-skip", href: "#plane", onclick: (event) => (event.preventDefault(), scene.svg.focus()) }, "Skip to the plane"),
    head(store, files, settings, banners, keyList()),
    banners.element,
    h("main", { class: "bs-main" },
      h("section", { class: "bs-stage", id: "plane", "aria-label": "The plane" }, player, h("div", { class: "bs-canvas" }, scene.element, planeLine(store, scene)), stageBar(store, scene, () => files.opened())),
      sheets(root, [["task", "Task", left], ["linkages", "Linkages", right], ["drawer", "Charts", drawer.element]]),
      left, right, drawer.element),
  );
  scene.resize();
  const { playing, answers, surface } = addResults(store, scene, { player, results: cards, drawer }, { panel, regions });
  root.querySelector(".bs-bar")?.append(dimensionsButton(store, scene, playing, answers));
  drawer.add("judge", "Judge", new JudgePanel(store, answers, scene, surface, (what, then) => files.trying(what, then)).element);
  const loads = new LoadsPanel(store, scene, new LoadHandles(store, scene, playing), answers, surface, start.form.loads);
  panel.element.querySelector("[data-section=requirements]").before(loads.element);
  listenToKeys(store, scene, files);
  new Autosave(store);
  files.opened = refitWhenSolved(store, scene);
  return { scene, banners, files, body, regions, panel, handles, table, curve, path };
}

/** Shows the lengths of the chosen linkage. */
function dimensionsButton(store, scene, playing, answers) {
  let dimensions;
  const made = button("Dimensions", async () => {
    const { Dimensions } = await tools();
    dimensions ??= new Dimensions(store, scene, playing, answers);
    put(made, "aria-pressed", dimensions.toggle());
  }, { "data-do": "dimensions", "aria-pressed": "false", title: "The lengths of the chosen linkage; click one to change it" });
  return made;
}

/** Sections of the task whose scripts are loaded when they are first opened, or when a task comes with a picture. */
function laterSections(store, scene, banners, form) {
  const later = (name, title, make) => {
    const element = h("details", { class: "bs-section", "data-section": name }, h("summary", {}, title));
    let asked = false;
    const load = async () => {
      if (asked) return;
      asked = true;
      element.append(make(await tools()).element);
    };
    element.addEventListener("toggle", load);
    return { element, load };
  };
  const lengths = form.options.filter((each) => each.form === "length").map(({ key }) => key);
  const transform = later("transform", "Move, turn, mirror, scale", ({ TransformPanel }) => new TransformPanel(store, scene, lengths));
  const picture = later("picture", "Picture or film behind the plane", ({ Backdrop }) => new Backdrop(store, scene, banners));
  const show = () => store.picture && picture.load();
  store.on("picture", show);
  show();
  return [transform.element, picture.element];
}

/** The head of the page: the task as a whole, and what leaves it. */
function head(store, files, settings, banners, keys) {
  const name = h("input", { class: "bs-text bs-task-name", "aria-label": "Name of the task", autocomplete: "off", spellcheck: "false", onchange: () => store.rename(name.value.trim() || "task") });
  const undo = button("↶", () => store.undo(), { "data-do": "undo", title: "Undo (Ctrl+Z)", "aria-label": "Undo" }), redo = button("↷", () => store.redo(), { "data-do": "redo", title: "Redo (Ctrl+Shift+Z)", "aria-label": "Redo" });
  const show = () => {
    if (document.activeElement !== name) give(name, "value", store.name.replace(/[\r\n]+/g, " "));
    give(undo, "disabled", !store.history.canUndo);
    give(redo, "disabled", !store.history.canRedo);
  };
  store.on("document history", show);
  show();
  const stop = button("Stop", () => store.cancel(), { "data-do": "cancel", hidden: true, "aria-label": "Stop solving" });
  // Offered only where solving is not over at once.
  let waiting;
  store.on("state", () => {
    clearTimeout(waiting);
    if (store.state === "solving") waiting = setTimeout(() => give(stop, "hidden", false), PATIENCE);
    else give(stop, "hidden", true);
  });
  const made = h("header", { class: "bs-head" }, h("h1", {}, "burmester studio"), files.element, name, h("div", { class: "bs-row" }, undo, redo), banners.status, stop, banners.live, settings.element, keys);
  walkByArrows(made, ":scope > .bs-files > .bs-menu > summary, :scope > .bs-menu > summary, .bs-task-name, .bs-row > button, [data-do=keys]").first();
  return made;
}

/** What is done in the plane. */
function stageBar(store, scene, drawn) {
  const toggle = (text, name, make, data) => {
    const made = button(text, () => scene.use(scene.tool?.name === name ? null : make()), { "data-do": data, "aria-pressed": "false" });
    scene.on("tool", () => put(made, "aria-pressed", scene.tool?.name === name));
    return made;
  };
  const snap = button("Snap", () => {
    scene.snap.isOn = !scene.snap.isOn;
    put(snap, "aria-pressed", scene.snap.isOn);
  }, { "data-do": "snap", "aria-pressed": "true", title: "Snap to the grid, pivots, corners and other poses; Alt frees, Shift holds an axis" });
  const zoom = (text, label, factor) => button(text, () => scene.zoom(factor, scene.size.width / 2, scene.size.height / 2), { "aria-label": label, title: label });
  const bar = h("div", { class: "bs-bar", role: "toolbar", "aria-label": "Tools of the plane" },
    toggle("Add poses", "pose", () => new PoseTool(store, scene), "add-poses"),
    toggle("Add points", "point", () => new PointTool(store, scene), "add-points"),
    toggle("Draw a path", "path", () => new PathTool(store, scene, drawn), "draw-path"),
    h("span", { class: "bs-gap" }),
    snap,
    button("Fit", () => scene.fitAgain(), { "data-do": "fit", title: "Show the poses; once more: all of the body and the regions, too (0)" }),
    zoom("+", "Zoom in", 1.25), zoom("−", "Zoom out", 0.8));
  walkByArrows(bar, "button").first();
  return bar;
}

/** One line over the plane that says what can be dragged. */
function planeLine(store, scene) {
  const line = h("p", { class: "bs-line" });
  const show = () => say(line, scene.tool?.hint ?? (store.document.poses.length ? (isPath(store.document) ? CURVE : store.document.poses.some(isPoint) ? POINTS : FIRST) : EMPTY));
  scene.on("tool", show);
  store.on("document", show);
  show();
  return line;
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

/** A link to a task, or a new token in the address: the server was started anew, and its address opened in this tab. */
function listenToAddress(connection, { banners, files }) {
  addEventListener("hashchange", async () => {
    const link = linkInAddress();
    if (link) return files.openLink(link);
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
    const choice = start.choice ? { chosen: start.choice } : null, link = linkInAddress();
    const store = new Store({ connection, document: start.document, options: start.options, name: start.name, picture: start.picture, choice, ...kept });
    const parts = layOut(root, store, start);
    if (start.saved && !kept) offerSaved(store, parts, start.saved);
    listenToAddress(connection, parts);
    if (link) await parts.files.openLink(link);
    document.documentElement.dataset.ready = "true";
    connection.open();
    if (start.function) parts.files.function(start.function, start.name);
  } catch (error) {
    addEventListener("hashchange", () => location.reload()); // another address, opened in this tab
    const [told] = error instanceof Refused && error.status === 401 ? error.messages : [];
    root.replaceChildren(h("p", { class: "bs-failed", role: "alert" }, told
      ? `The studio is not shown here: ${told.message}. What to do: ${told.help}.`
      : `The page could not start: ${/** @type {Error} */ (error).message}. Is burmester studio still running? Start it again and open the address that it prints.`));
    if (!(error instanceof Refused)) throw error;
  }
}

/** Work of last time, in a quiet line above the task. */
function offerSaved(store, { files }, saved) {
  const when = typeof saved.when === "number" ? new Date(1000 * saved.when).toLocaleString() : saved.when;
  const line = h("p", { class: "bs-quiet-line", "data-saved": "" }, h("span", {}, "Last time: ", h("bdi", {}, saved.name), when ? `, ${when}` : ""), button("Go on with it", () => {
    line.remove();
    store.replace(saved);
    files.opened();
  }, { "data-do": "restore" }));
  document.querySelector(".bs-left")?.prepend(line);
}

main();
