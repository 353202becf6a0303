// The parts that show answers, and where they stand.

import { h } from "../widget/dom.mjs";
import { unfoldForPrint } from "../widget/printing.mjs";
import { Answers } from "./answers.mjs";
import { walkByArrows } from "./arrangement.mjs";
import { Centrodes } from "./centrodes.mjs";
import { CognatePanel } from "./cognate_panel.mjs";
import { Charts, LoadCharts } from "./charts.mjs";
import { Chips } from "./chips.mjs";
import { isOfPoints, isPoint } from "./document.mjs";
import { CouplerCurves } from "./coupler_curve.mjs";
import { FactsTable } from "./facts_table.mjs";
import { listenToSpace } from "./keyboard.mjs";
import { LiveLinkage } from "./live_linkage.mjs";
import { catchUpForPrint } from "./pacing.mjs";
import { PivotSurface } from "./pivot_surface.mjs";
import { hasLoads } from "./loads.mjs";
import { Playing, playOnce } from "./playing.mjs";
import { Results } from "./results.mjs";
import { SixBars } from "./six_bars.mjs";
import { SpacePanel } from "./space_panel.mjs";

/** Make every part that shows answers, and put it in its place.
 * @param {object} store @param {object} scene @param {{ player: Element, results: Element, drawer: import("./arrangement.mjs").Drawer }} places
 * @param {{ panel: object, regions: object }} task what its chips change */
export function addResults(store, scene, { player, results, drawer }, { panel, regions }) {
  const answers = new Answers(store), playing = new Playing(store, answers);
  const live = new LiveLinkage(answers, playing, scene), surface = new PivotSurface(store, answers, playing, scene);
  const centrodes = new Centrodes(answers, playing, scene), curves = new CouplerCurves(answers, playing, scene);
  const cards = new Results(store, answers, playing), charts = new Charts(answers, playing), space = new SpacePanel(answers, playing);
  const cognates = new CognatePanel(store, answers), loads = new LoadCharts(answers, playing);
  const facts = new FactsTable(store, answers, playing, curves);
  const ways = [...playing.element.querySelectorAll(".bs-player-ways, .bs-driver-note")];
  player.append(playing.element);
  walkByArrows(playing.element.querySelector(".bm-controls"), ".bm-row button, .bm-more select, .bm-more input").first();
  results.append(new Chips(store, answers, panel, regions).element, cards.element);
  cards.list.before(new SixBars(store, answers).element);
  const ofAngles = () => !store.document.poses.some(isPoint) && !answers.shown?.drawn; // points leave angles free, and six-bars have no two dyads
  drawer.add("charts", "Errors and transmission", charts.element);
  drawer.add("loads", "Loads", loads.element, () => hasLoads(store.document));
  drawer.add("motion", "Driver and curves", h("div", {}, ways, h("div", { class: "bs-player-tools" }, centrodes.element, curves.element)));
  drawer.add("cognates", "Cognates", cognates.element, () => isOfPoints(store.document));
  drawer.add("pivots", "Pivots", surface.element, ofAngles);
  drawer.add("space", "Image space", space.element, ofAngles);
  drawer.add("facts", "Tables", facts.element);
  store.on("document chosen", () => drawer.update());
  drawer.update();
  unfoldForPrint(drawer.element, new AbortController().signal); // what is folded of the task says nothing
  catchUpForPrint();
  listenToSpace(playing);
  playOnce(store, answers, playing);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => answers.emit("answers"));
  return { answers, playing, live, surface, centrodes, curves, cards, charts, loads, space, cognates, facts };
}
