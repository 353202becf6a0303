// The report of six-bars: ranked, the chosen one moving, its dimensions and its transmission angles.

import { h } from "./dom.mjs";
import { header } from "./header.mjs";
import { Report, section } from "./report.mjs";
import { moving } from "./six_bar.mjs";
import { SixBarPlane } from "./six_bar_plane.mjs";
import { SixBarPlayer } from "./six_bar_player.mjs";
import { SixBarPlots } from "./six_bar_plots.mjs";
import { SixBarCards, loopKey, sixBarDimensions, sixBarDistances, sixBarFacts, sixBarKey, sixBarPoses, sixBarTable } from "./six_bar_tables.mjs";

export class SixBarReport extends Report {
  constructor(data, el, options) {
    super({ ...data, linkages: data.six_bars.map((each) => moving(each, data.poses)) }, el, options);
  }

  frame() {
    const { data, linkages } = this, any = linkages.length > 0;
    const main = h("div", { class: "bm-main" }), body = h("div", { class: "bm-body" });
    this.root.append(header(data, linkages.some((each) => each.usable)), body);
    if (any) {
      this.player = new SixBarPlayer(data, (...now) => this.show(...now), () => this.rebuild());
      this.cards = new SixBarCards(linkages, (index) => this.choose(index));
      body.append(this.cards.element);
    }
    body.append(main);
    main.append(this.stage());
    if (any) main.append(this.numbersAndPlots());
    this.poses = section("pose-box", "Pose by pose");
    main.append(this.poses);
    if (any) main.append(section("all", "All six-bars", sixBarTable(data), this.everyDimension()));
    this.root.append(h("footer", { class: "bm-foot-notes" }, data.footnotes));
  }

  stage() {
    const drawing = h("div", { class: "bm-drawing" });
    this.plane = new SixBarPlane(this.data, drawing);
    this.title = h("h2", { class: "bm-stage-title" }, "The poses");
    this.story = h("p", { class: "bm-story" });
    return h(
      "section",
      { class: "bm-card bm-stage", "aria-label": "The linkage moving" },
      this.title,
      this.story,
      drawing,
      this.player?.element,
      h("div", { class: "bm-under" }, sixBarKey(this.data)),
    );
  }

  numbersAndPlots() {
    this.numbers = h("div", { class: "bm-fill" });
    this.loops = h("div", {});
    const plots = h("div", { class: "bm-fill" });
    this.plots = new SixBarPlots(this.data, plots, (u) => this.player.go(u));
    plots.append(this.loops);
    this.aside = h("div", { class: "bm-aside" }, section("numbers", "Numbers", this.numbers), section("plotted", "Transmission over the driver", plots));
    return this.aside;
  }

  everyDimension() {
    const parts = this.linkages.map((each) => h("div", { class: "bm-every-one" }, sixBarDimensions(this.data, each)));
    return h("details", { class: "bm-every" }, h("summary", {}, "Dimensions of every six-bar"), h("div", { class: "bm-every-all" }, parts));
  }

  rebuild() {
    const { linkage, data, player } = this;
    if (linkage) {
      player.rebuild();
      this.title.textContent = `${linkage.id}: ${linkage.type}`;
      this.story.textContent = linkage.said.story;
      this.numbers.replaceChildren(sixBarDimensions(data, linkage), sixBarFacts(data, linkage), sixBarDistances(data, linkage));
      this.loops.replaceChildren(loopKey(linkage));
    }
    this.poses.replaceChildren(this.poses.querySelector("h2"), sixBarPoses(data, linkage));
    this.rows = [...this.poses.querySelectorAll("tbody tr")];
    this.draw();
  }
}
