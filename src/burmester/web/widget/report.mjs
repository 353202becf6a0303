// The report of a synthesis: ranked linkages, the chosen one moving, its errors and its image space.

import { Assemblies } from "./assemblies.mjs";
import { Cards } from "./cards.mjs";
import { h } from "./dom.mjs";
import { FamilyMap } from "./family_map.mjs";
import { header } from "./header.mjs";
import { ImageSpace } from "./image_space.mjs";
import { listenToKeys } from "./keyboard.mjs";
import { LoadPlots } from "./load_plots.mjs";
import { PivotMap } from "./pivot_map.mjs";
import { FACTORS, Plane, factorFor, hasFarPivots } from "./plane.mjs";
import { Player } from "./player.mjs";
import { Plots } from "./plots.mjs";
import { restForPrint, unfoldForPrint } from "./printing.mjs";
import { dyadTable, imageTables, nounOf, numbersOf, poseTable, provedOf, worded } from "./tables.mjs";
import { factsOf, keyOf, loopKey, spaceStory } from "./words.mjs";

const REDUCED_MOTION = "(prefers-reduced-motion: reduce)";
const DARK_SCHEME = "(prefers-color-scheme: dark)";
const HIGHEST = 0.66; // heights of the window: of the drawing, so that what moves it stands on the same screen
const LONGEST_NAME = 5; // characters of a pose's name that a drawing has room for

const section = (name, title, ...content) =>
  h("section", { class: `bm-card bm-${name}`, "aria-label": title }, h("h2", {}, title), ...content);

/** What a report may leave out. */
const NOTHING = { unit: null, poses: [], path: null, body: null, keep_out: [], loads: null, dyads: [] };

/** Where names are long, drawings have numbers instead, and tables both. */
function label(poses) {
  const short = poses.every((pose) => pose.name.length <= LONGEST_NAME);
  poses.forEach((pose, k) => (pose.label = short ? pose.name : String(k + 1)));
}

export class Report {
  /** @type {any} */ player;
  /** @type {any} */ linkage;
  /** @type {any} */ story;
  /** @type {any} */ title;
  /** @type {any} */ far;
  /** @type {any} */ farName;
  /** @type {any} */ farLabel;
  /** @type {any} */ closer;
  /** @type {any} */ closeLabel;
  /** @type {any} */ numbers;
  /** @type {any} */ cards;
  /** @type {any} */ poses;
  /** @type {any} */ rows;
  /** @type {any} */ current;
  /** @type {any} */ sizes;
  /** @type {any} */ fitting;
  /** @type {any} */ assemblies;
  /** @type {any} */ plots;
  /** @type {any} */ loops;
  /** @type {any} */ loads;
  /** @type {any} */ aside;
  /** @type {any} */ plane;
  /** @type {any} */ spaceStory;
  /** @type {any} */ spaceNumbers;

  constructor(given, el, options) {
    const data = (this.data = { ...NOTHING, ...given });
    this.el = el;
    this.options = options;
    this.ended = new AbortController();
    for (const { poses } of [data, ...data.linkages.flatMap(({ picture }) => picture ?? [])]) label(poses);
    Object.assign(data, data.linkages[0]?.picture);
    this.linkages = data.linkages.map((linkage) => ({
      ...linkage,
      pose_errors: linkage.pose_errors.map((row) => ({ ...row, at: row.way === null ? null : linkage.ways[row.way] })),
    }));
    this.root = h("div", { class: "bm" });
    el.replaceChildren(this.root);
    this.frame();
    if (this.linkages.length) this.choose(0);
    else this.rebuild();
    this.listen();
  }

  /** Everything that is there whichever linkage is chosen, with the places for the rest. */
  frame() {
    const { data, linkages } = this;
    const main = h("div", { class: "bm-main" }), body = h("div", { class: "bm-body" });
    this.root.append(header(data, linkages.some((each) => each.usable)), body);
    if (linkages.length) {
      this.player = new Player(data, (...now) => this.show(...now), () => this.rebuild());
      this.assemblies = new Assemblies(data, (index) => this.player.take(index));
      this.cards = new Cards(data, linkages, (index) => this.choose(index));
      body.append(this.cards.element);
    }
    body.append(main);
    main.append(this.stage());
    if (linkages.length) main.append(this.numbersAndPlots());
    if (linkages.length && data.loads) main.append(this.loadPlots());
    const family = data.family_map ? this.familyMap() : null;
    const space = data.space ? this.imageSpace() : null;
    main.append(...(this.family?.isCurve ? [family, space] : [space, family]).filter(Boolean));
    if (data.pivot_map) main.append(this.pivotMap());
    this.poses = section("pose-box", { point: "Point by point", pose: "Pose by pose", place: "Pair by pair" }[nounOf(data)]);
    main.append(this.poses);
    if (linkages.length) main.append(section("all", "All linkages", worded(data, { ...data.table, class: "bm-linkages bm-stacks" }), this.everyDimension()));
    if (data.dyads.length) main.append(section("dyads", "Dyads", dyadTable(data)));
    if (data.certificate) main.append(section("proved", "What is proved", provedOf(data)));
    this.root.append(h("footer", { class: "bm-foot-notes" }, data.footnotes));
  }

  /** The drawing with what moves it. */
  stage() {
    const { data, player } = this;
    const drawing = h("div", { class: "bm-drawing" });
    this.plane = new Plane(data, drawing);
    this.plane.reveal = () => {
      this.far.checked = true;
      this.draw();
    };
    this.title = h("h2", { class: "bm-stage-title" }, "The poses");
    this.story = h("p", { class: "bm-story" });
    return h(
      "section",
      { class: "bm-card bm-stage", "aria-label": "The linkage moving" },
      this.title,
      this.story,
      drawing,
      player ? [player.element, this.assemblies.element] : null,
      h("div", { class: "bm-under" }, keyOf(data, Boolean(player)), player ? h("div", { class: "bm-choose" }, this.farPivots(), data.stop ? null : this.magnification()) : null),
    );
  }

  /** Whether the picture is to hold far pivots and outlines that leave it; only where there are some. */
  farPivots() {
    this.far = h("input", { type: "checkbox", checked: Boolean(this.data.whole), onchange: () => this.draw() });
    this.farName = h("span", {});
    this.farLabel = h("label", { class: "bm-factor bm-far-pivots", hidden: true }, this.far, " ", this.farName);
    this.closer = h("input", { type: "checkbox", onchange: () => this.draw() });
    this.closeLabel = h("label", { class: "bm-factor bm-close-up", hidden: true }, this.closer, " The linkage alone");
    return [this.closeLabel, this.farLabel];
  }

  offerAll(linkage) {
    if (!this.farLabel) return;
    const pivots = hasFarPivots(this.data, linkage, this.plane.places);
    this.farLabel.hidden = !pivots && !this.plane.cut && (this.data.whole || !this.far.checked);
    this.farName.textContent = pivots ? "Whole linkage, with far pivots" : "All of the surroundings";
    this.closeLabel.hidden = !this.plane.isLarge;
  }

  magnification() {
    this.factor = h(
      "select",
      { onchange: () => this.draw() },
      FACTORS.map((factor) => h("option", { value: factor }, factor ? `× ${factor.toLocaleString("en").replaceAll(",", " ")}` : "not drawn")),
    );
    return h("label", { class: "bm-factor" }, "Error arrows ", this.factor);
  }

  numbersAndPlots() {
    this.numbers = h("div", { class: "bm-fill" });
    this.loops = h("div", {});
    const plots = h("div", { class: "bm-fill" });
    this.plots = new Plots(this.data, plots, (u) => this.player.go(u));
    plots.append(this.loops);
    this.aside = h(
      "div",
      { class: "bm-aside" },
      section("numbers", "Numbers", this.numbers),
      section("plotted", this.linkages[0].loops ? "Transmission over the driver" : "Errors and transmission", plots),
    );
    return this.aside;
  }

  /** What the linkage bears, and how it moves in time. */
  loadPlots() {
    const plots = h("div", { class: "bm-fill" });
    this.loads = new LoadPlots(this.data, plots, (u) => this.player.go(u));
    return section("loaded", "Loads along the motion", plots);
  }

  imageSpace() {
    const picture = h("div", { class: "bm-fill" });
    this.spaceStory = h("p", { class: "bm-story" });
    this.spaceNumbers = h("details", { class: "bm-every" }, h("summary", {}, "In numbers"));
    this.space = new ImageSpace(this.data, picture, this.options.webgl !== false);
    return section("image", "Image space", this.spaceStory, picture, this.spaceNumbers);
  }

  pivotMap() {
    const picture = h("div", { class: "bm-fill" });
    this.map = new PivotMap(this.data, picture);
    return section(
      "pivots", "Where to put a fixed pivot",
      h("p", { class: "bm-story" }, "How well the best link with its fixed pivot at a place meets the poses: the stronger the colour, the better."),
      picture,
    );
  }

  familyMap() {
    const picture = h("div", { class: "bm-fill" });
    this.family = new FamilyMap(this.data, picture);
    const story = this.family.isCurve
      ? "Every dyad that meets the four poses is a place on a curve. Here each is paired with each other one; a pair that works is coloured by its least transmission angle, driven from its better side."
      : `Every fixed pivot has one dyad that meets the three poses. Here ${this.data.family_map.chosen.id} is paired with each of them, at the place of its fixed pivot; a pair that works is coloured by its least transmission angle, driven from its better side.`;
    return section(`family bm-family-${this.data.family_map.kind}`, "Which pairs of dyads work", h("p", { class: "bm-story" }, story), picture);
  }

  /** For print, and for those who read: the dimensions of every linkage. */
  everyDimension() {
    const parts = this.linkages.map((each) => h("div", { class: "bm-every-one" }, numbersOf(this.data, each)));
    return this.linkages[0].tables?.length === 0 ? null : h("details", { class: "bm-every" }, h("summary", {}, "Dimensions of every linkage"), h("div", { class: "bm-every-all" }, parts));
  }

  choose(index) {
    const known = Boolean(this.linkage);
    this.linkage = this.linkages[index];
    Object.assign(this.data, this.linkage.picture); // a linkage that has poses of its own
    this.cards.mark(index);
    if (this.factor) this.factor.value = String(factorFor(this.data, this.linkage));
    this.player.load(this.linkage);
    if (known) this.bringIntoSight();
  }

  /** Where the cards stand under the picture, a choice among them goes back to the picture. */
  bringIntoSight() {
    const stage = this.plane.parent.parentElement;
    if (stage.getBoundingClientRect().bottom < 0.4 * window.innerHeight) stage.scrollIntoView({ block: "start" });
  }

  /** Everything that depends on the linkage and on its way. */
  rebuild() {
    const { linkage, data, player } = this;
    if (linkage) {
      player.rebuild();
      this.title.textContent = `${linkage.id}: ${linkage.type}`;
      this.story.textContent = linkage.said.story;
      this.loops.replaceChildren(loopKey(linkage) ?? "");
      this.assemblies.build(linkage, player.way);
      this.numbers.replaceChildren(...numbersOf(data, linkage), factsOf(linkage), ...linkage.said.notes.map((note) => h("p", { class: "bm-note-text" }, note)));
    }
    this.poses.replaceChildren(this.poses.querySelector("h2"), linkage?.stops ? worded(data, linkage.stops) : poseTable(data, linkage));
    const rows = [...this.poses.querySelectorAll("tbody tr")];
    this.rows = data.poses.map((pose, k) => rows[pose.row === undefined ? k : pose.row]);
    if (this.space) {
      this.spaceStory.replaceChildren(...spaceStory(data, linkage));
      this.spaceNumbers.replaceChildren(this.spaceNumbers.firstChild, ...imageTables(data, linkage));
    }
    this.draw();
  }

  /** Draw what stands still anew, and then what moves. */
  draw() {
    const { linkage, player } = this, way = player?.way ?? 0, stretch = player?.stretch;
    this.plots?.build(linkage, way, stretch);
    this.loads?.build(linkage, way);
    const factor = Number(this.factor?.value ?? 0), far = Boolean(this.far?.checked), close = Boolean(this.closer?.checked);
    this.plane.build(linkage, way, stretch, { factor, fill: this.room(), far, close });
    this.offerAll(linkage);
    this.plane.svg.setAttribute("aria-label", linkage ? `${linkage.id}, a ${linkage.type}, at the poses. Space plays, arrow keys move the driver.` : "The poses");
    this.space?.build(linkage, way);
    this.map?.build(linkage);
    this.family?.build(linkage, this.linkages.indexOf(linkage));
    if (!player?.path) this.space?.hide();
    player?.drawStops();
    player?.show();
  }

  /** The height that is left for the drawing where the numbers stand beside it. */
  room() {
    if (!this.aside) return 0;
    const stage = this.plane.parent.parentElement;
    if (this.aside.offsetLeft <= stage.offsetLeft) return 0;
    const beside = this.aside.offsetHeight - (stage.offsetHeight - this.plane.parent.clientHeight);
    return Math.min(beside, HIGHEST * window.innerHeight);
  }

  /** What moves, at a place of the body; near: the index of the nearest pose. */
  show(place, drive, transmission, near) {
    this.plane.show(place, drive);
    this.space?.show(place);
    this.plots.show(drive);
    this.loads?.show(drive);
    const row = this.rows[near];
    if (row === this.current) return;
    this.current?.classList.remove("bm-current");
    row?.classList.add("bm-current");
    this.current = row;
  }

  listen() {
    const { root, player } = this, { signal } = this.ended;
    window.matchMedia(DARK_SCHEME).addEventListener("change", () => this.draw(), { signal });
    let width = root.clientWidth;
    this.sizes = new ResizeObserver(() => {
      if (root.clientWidth === width) return;
      width = root.clientWidth;
      cancelAnimationFrame(this.fitting);
      this.fitting = requestAnimationFrame(() => this.draw());
    });
    this.sizes.observe(root);
    unfoldForPrint(root, signal);
    if (!player) return;
    listenToKeys(this.root, this.plane.svg, player, signal);
    restForPrint(player, signal);
    player.play(false);
    if (!this.options.still && !window.matchMedia(REDUCED_MOTION).matches) player.playOnce();
  }

  close() {
    this.ended.abort();
    this.sizes.disconnect();
    cancelAnimationFrame(this.fitting);
    this.player?.play(false);
    this.el.replaceChildren();
  }
}
