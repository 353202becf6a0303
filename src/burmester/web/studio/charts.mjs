// Errors at the poses and the transmission angle along the motion, and what the linkage bears: they follow at a slower pace.

import { give, h } from "../widget/dom.mjs";
import { LoadPlots } from "../widget/load_plots.mjs";
import { Plots } from "../widget/plots.mjs";
import { Pace, isSeen, watch } from "./pacing.mjs";

const NO_MOTION = "No linkage is there whose motion could be shown.";

/** Curves along the motion; Kind: `Plots` or a class that extends it. */
class Curves {
  constructor(answers, playing, Kind) {
    this.playing = playing;
    const fill = h("div", { class: "bm-fill" });
    this.plots = new Kind(answers.data, fill, (u) => playing.player.go(u));
    this.nothing = h("p", { class: "bs-quiet", hidden: true }, NO_MOTION);
    this.element = h("div", {}, this.nothing, fill);
    this.pace = new Pace(() => this.build(), () => isSeen(fill));
    playing.on("shape", () => this.pace.ask());
    playing.on("place", ({ drive }) => {
      if (this.isFresh && isSeen(fill)) this.plots.show(drive);
    });
    answers.on("poses", () => (this.isFresh = false));
    new ResizeObserver(() => this.pace.ask()).observe(fill);
    watch(fill, () => this.pace.ask());
  }

  build() {
    const { playing, plots } = this, { linkage, path, player } = playing;
    give(this.nothing, "hidden", Boolean(linkage && path && !linkage.gone));
    if (!linkage || !path || linkage.gone || linkage.pose_errors.length !== plots.data.poses.length) {
      plots.svg.replaceChildren();
      plots.way = plots.cursor = null;
      return;
    }
    plots.build(linkage, player.way, player.stretch);
    this.isFresh = true;
    if (playing.here) plots.show(playing.here.drive);
  }
}

export class Charts extends Curves {
  constructor(answers, playing) {
    super(answers, playing, Plots);
  }
}

export class LoadCharts extends Curves {
  constructor(answers, playing) {
    super(answers, playing, LoadPlots);
  }
}
