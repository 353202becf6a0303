// Image space beside the scene: the manifolds of the dyads in hand, turned by dragging, going along with the poses.

import { h } from "../widget/dom.mjs";
import { ImageSpace } from "../widget/image_space.mjs";
import { spaceStory } from "../widget/words.mjs";
import { quadricOf } from "./manifold.mjs";
import { Pace, isSeen, watch } from "./pacing.mjs";

const CALM = 200; // milliseconds after the last change: then the picture is drawn finely

export class SpacePanel {
  constructor(answers, playing) {
    this.answers = answers;
    this.playing = playing;
    this.story = h("p", { class: "bm-story" });
    const fill = h("div", { class: "bm-fill" });
    this.element = h("div", {}, this.story, fill);
    this.fill = fill;
    this.space = new ImageSpace(answers.data, fill, true);
    this.quick = new Pace(() => this.build(true), () => isSeen(fill));
    playing.on("shape", () => this.ask());
    answers.on("poses placed", () => this.ask());
    playing.on("place", ({ place }) => {
      if (this.space.view && !answers.isOld && isSeen(fill)) this.space.show(place); // under a hand it is built again and again
    });
    new ResizeObserver(() => this.ask()).observe(fill);
    watch(fill, () => this.ask());
  }

  /** Coarsely at once, and finely when nothing changes any more. */
  ask() {
    this.quick.ask();
    clearTimeout(this.calm);
    this.calm = setTimeout(() => isSeen(this.fill) && this.build(false), CALM);
  }

  /** The dyads whose manifolds are shown: those put down by hand where they make no linkage, or those of the linkage. */
  get dyads() {
    const { linkage } = this.playing, { placed } = this.answers.store;
    if (!linkage && placed?.dyads?.length) return placed.dyads;
    return linkage?.led ?? [];
  }

  build(quick) {
    const { answers, playing, space, dyads } = this, { data } = answers, { linkage } = playing;
    if (!data.poses.length || linkage?.drawn) return;
    const box = linkage?.space ?? data.space;
    const quadrics = dyads.map((dyad) => quadricOf(dyad, data.chart, box));
    if (quadrics.length === 1) quadrics.push(quadrics[0]);
    const shown = { ...(linkage && !linkage.gone ? linkage : { ways: [], led: dyads }), space: { ...box, quadrics } };
    const key = dyads.map((dyad) => dyad.id).join();
    if (key !== this.told) {
      this.told = key;
      this.story.replaceChildren(...spaceStory(data, linkage && dyads.length === 2 ? { id: linkage.id, led: dyads } : null));
    }
    space.build(shown, playing.player.way, quick);
    if (playing.path && playing.here) space.show(playing.here.place);
    else space.hide();
  }
}
