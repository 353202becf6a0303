// The parts that show answers, and where they stand.

import { give, h } from "../widget/dom.mjs";
import { unfoldForPrint } from "../widget/printing.mjs";
import { Answers } from "./answers.mjs";
import { Centrodes } from "./centrodes.mjs";
import { CognatePanel } from "./cognate_panel.mjs";
import { Charts, LoadCharts } from "./charts.mjs";
import { Compare } from "./compare.mjs";
import { isOfPoints, isPoint } from "./document.mjs";
import { CouplerCurves } from "./coupler_curve.mjs";
import { FactsTable } from "./facts_table.mjs";
import { listenToSpace } from "./keyboard.mjs";
import { LiveLinkage } from "./live_linkage.mjs";
import { catchUpForPrint } from "./pacing.mjs";
import { PivotSurface } from "./pivot_surface.mjs";
import { Playing, playOnce } from "./playing.mjs";
import { Results } from "./results.mjs";
import { SpacePanel } from "./space_panel.mjs";

const LOADS = ["loads", "springs", "drive"]; // what a task states of them

/** A panel under the scene that folds. */
const panel = (name, title, open, ...content) =>
  h("details", { class: `bm-card bs-panel bs-panel-${name}`, open, "data-panel": name }, h("summary", {}, h("h2", {}, title)), content);

/** Make every part that shows answers, and put it in its place.
 * @param {object} store @param {object} scene @param {{ player: Element, results: Element, panels: Element }} places */
export function addResults(store, scene, { player, results, panels }) {
  const answers = new Answers(store), playing = new Playing(store, answers);
  const live = new LiveLinkage(answers, playing, scene), surface = new PivotSurface(store, answers, playing, scene);
  const centrodes = new Centrodes(answers, playing, scene), curves = new CouplerCurves(answers, playing, scene);
  const cards = new Results(store, answers), charts = new Charts(answers, playing), space = new SpacePanel(answers, playing);
  const cognates = new CognatePanel(store, answers);
  const compare = new Compare(store, answers, playing), facts = new FactsTable(store, answers, playing, curves);
  player.append(playing.element, h("div", { class: "bs-player-tools" }, centrodes.element, curves.element));
  results.append(cards.element);
  const ofAngles = [panel("pivots", "Put a pivot somewhere", true, surface.element), panel("space", "Image space", true, space.element)];
  const loads = new LoadCharts(answers, playing), ofLoads = panel("loads", "Loads along the motion", true, loads.element);
  const ofCurve = panel("cognates", "The same curve by three linkages", true, cognates.element);
  const fold = () => {
    const { document } = store;
    for (const each of ofAngles) give(each, "hidden", document.poses.some(isPoint)); // they tell of angles, which points leave free
    give(ofCurve, "hidden", !isOfPoints(document));
    give(ofLoads, "hidden", !LOADS.some((key) => document[key]));
  };
  store.on("document", fold);
  fold();
  panels.append(
    ofCurve,
    ...ofAngles,
    panel("charts", "Errors and transmission", true, charts.element),
    ofLoads,
    panel("compare", "Compare two linkages", false, compare.element),
    panel("facts", "Every number in tables", false, facts.element),
  );
  for (const part of panels.children) part.addEventListener("toggle", () => dispatchEvent(new Event("resize")));
  unfoldForPrint(panels, new AbortController().signal); // what is folded of the task says nothing
  catchUpForPrint();
  listenToSpace(playing);
  playOnce(store, answers, playing);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => answers.emit("answers"));
  return { answers, playing, live, surface, centrodes, curves, cards, charts, loads, space, cognates, compare, facts };
}
