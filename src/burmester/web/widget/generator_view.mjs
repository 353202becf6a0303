// One function generator: the linkage moving, its numbers, its curves, and its pairs.

import { h, s } from "./dom.mjs";
import { ErrorCurves } from "./error_curves.mjs";
import { generatorFacts, pairTable } from "./function_tables.mjs";
import { GeneratorPlayer } from "./generator_player.mjs";
import { frameAt } from "./kinematics.mjs";
import { degrees, radians } from "./numbers.mjs";
import { Plane, hasFarPivots } from "./plane.mjs";
import { Report, section } from "./report.mjs";

const MANY_PAIRS = 30; // more of them are there to unfold

export class GeneratorView extends Report {
  constructor(task, generator, el, options) {
    const { curve } = generator;
    generator.wantedAt = (input) => wantedAt(curve, input);
    generator.at = (input) => closed(generator, input);
    super({ ...generator.motion, task, generator }, el, options);
  }

  frame() {
    const { data } = this, { generator } = data;
    this.generator = generator;
    this.player = new GeneratorPlayer(data, (...now) => this.show(...now), () => this.rebuild(), generator);
    const stage = this.stage();
    const numbers = h("div", { class: "bm-fill" }), curves = h("div", { class: "bm-fill" });
    numbers.append(generatorFacts(generator));
    this.curves = new ErrorCurves(data.task, generator, curves, (input) => this.goTo(input));
    this.aside = h("div", { class: "bm-aside" }, section("numbers", "Numbers", numbers));
    this.root.className = "bm-view"; // within the page that has the colours
    this.root.append(stage, this.aside, section("curves", "Output, error and transmission", curves));
    const pairs = pairTable(data.task, generator);
    const many = generator.pairs.length > MANY_PAIRS;
    this.root.append(
      section("pair-box", "Pair by pair", many ? h("details", { class: "bm-every" }, h("summary", {}, `${generator.pairs.length} pairs`), pairs) : pairs),
    );
    this.rows = data.poses.map((pose) => (/^\d+$/.test(pose.name) ? pairs.querySelector(`[data-pair="${pose.name}"]`) : null));
  }

  /** The drawing with what moves it. */
  stage() {
    const { data, player, generator } = this;
    const drawing = h("div", { class: "bm-drawing" });
    this.plane = new Plane(data, drawing);
    const far = this.farPivots();
    this.far.checked = true; // both links belong to the answer, however far from each other
    return h(
      "section",
      { class: "bm-card bm-stage", "aria-label": "The linkage moving" },
      h("h2", { class: "bm-stage-title" }, `${generator.id}: ${generator.type}`),
      h("p", { class: "bm-story" }, generator.said.story),
      drawing,
      player.element,
      h("div", { class: "bm-under" }, keys(), h("div", { class: "bm-choose" }, far)),
    );
  }

  offerAll(linkage) {
    const far = hasFarPivots(this.data, linkage, this.plane.places);
    this.farLabel.hidden = !far;
    this.farName.textContent = "Whole linkage, with far pivots";
  }

  choose(index) {
    this.linkage = this.linkages[index];
    this.player.load(this.linkage);
  }

  rebuild() {
    this.player.rebuild();
    this.draw();
  }

  draw() {
    const { linkage, player, generator } = this, { way, stretch } = player;
    this.plane.build(linkage, way, stretch, { factor: 0, fill: this.room(), far: Boolean(this.far?.checked) });
    this.offerAll(linkage);
    this.plane.svg.setAttribute("aria-label", `${generator.id}, a ${generator.type}. Space plays, arrow keys move the input link.`);
    this.curves.build();
    player.drawStops();
    player.show();
  }

  goTo(input) {
    const { player } = this;
    if (player.path) player.go(frameAt(player.path.drive, player.driveOf(input)));
  }

  show(place, drive, transmission, near) {
    const { player } = this;
    this.plane.show(place);
    this.curves.show(player.inputAt(drive), transmission);
    const row = this.rows[near];
    if (row === this.current) return;
    this.current?.classList.remove("bm-current");
    row?.classList.add("bm-current");
    this.current = row;
  }

}

/** Output and transmission angle of the linkage at an input, in degrees: the triangle over its diagonal, closed. */
function closed({ ground, input_link: a, coupler: r, output_link: b, side, input_phase, output_phase, curve }, input) {
  const theta = radians(input_phase + input), x = ground - a * Math.cos(theta), y = -a * Math.sin(theta);
  const size = Math.hypot(x, y), opening = Math.acos((r * r - b * b - size * size) / (2 * b * size));
  const between = degrees(Math.acos((r * r + b * b - size * size) / (2 * r * b)));
  if (Number.isNaN(opening)) return { output: null, transmission: null };
  const output = degrees(Math.atan2(y, x) + side * opening) - output_phase;
  const k = curve.input.reduce((best, each, i) => (Math.abs(each - input) < Math.abs(curve.input[best] - input) ? i : best), 0);
  return { output: output - 360 * Math.round((output - curve.wanted[k]) / 360), transmission: Math.min(between, 180 - between) };
}

/** The output that is wanted at an input, where one is: of a function between its samples, of pairs at each. */
function wantedAt({ input, wanted, whole }, at) {
  for (let k = 0; k < input.length; k += 1) if (Math.abs(input[k] - at) < 1e-6) return wanted[k];
  if (!whole || at < input[0] || at > input[input.length - 1]) return null;
  const k = Math.max(1, input.findIndex((each) => each > at));
  const share = (at - input[k - 1]) / (input[k] - input[k - 1]);
  return wanted[k - 1] + share * (wanted[k] - wanted[k - 1]);
}

function keys() {
  const one = (sign, text) => h("li", {}, s("svg", { width: 34, height: 20, viewBox: "-4 -13 34 20", "aria-hidden": "true", class: "bm-key" }, sign), text);
  const link = (side) => s("g", { class: `bm-link bm-side${side}` }, s("path", { class: "bm-bar", d: "M0 -3H22" }), s("path", { class: "bm-core", d: "M0 -3H22" }));
  return h("ul", { class: "bm-keys" }, one(link(0), "input link (filled)"), one(link(1), "output link (hollow)"));
}
