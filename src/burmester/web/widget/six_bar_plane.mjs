// A six-bar in its plane: the picture holds all of it, and the joints have their names.

import { s } from "./dom.mjs";
import { polyline } from "./drawing.mjs";
import { including } from "./outlines.mjs";
import { Plane } from "./plane.mjs";
import { sixBarAt } from "./six_bar.mjs";
import { SixBarMechanism } from "./six_bar_mechanism.mjs";
import { placesAlong } from "./travel.mjs";

const BESIDE_PIVOT = [16, 28, 40]; // pixels from a pivot, along its crank

export class SixBarPlane extends Plane {
  build(linkage, way, stretch, how) {
    super.build(linkage, way, stretch, { ...how, far: true });
  }

  placesOf(way, stretch) {
    return placesAlong(this.data, stretch, (u) => sixBarAt(this.linkage, way, u));
  }

  bounds(far) {
    return including(super.bounds(far), this.places.flatMap((place) => Object.values(place.joints)));
  }

  /** The link that is the body. */
  get body() {
    return this.linkage.links.find(({ name }) => name === this.linkage.carries);
  }

  /** The body at every pose; where it has no outline, its joints and its origin. */
  ghosts() {
    const { data, linkage, view } = this;
    if (data.body || !linkage) return super.ghosts();
    const plates = linkage.pose_errors.map(({ x, y, joints }) => s("path", { class: "bm-ghost", d: `${polyline([...this.body.outline].map((joint) => joints[joint] ?? [x, y]), view)}Z` }));
    return s("g", { class: "bm-ghosts" }, plates);
  }

  mechanism() {
    return new SixBarMechanism(this.data, this.linkage, this.view);
  }

  /** The paths of the pins that carry the body. */
  pivotPaths() {
    return Object.keys(this.body.joints).filter((joint) => !(joint in this.linkage.ground)).map((joint) => ({ side: "-inner", points: this.places.map((place) => place.joints[joint]) }));
  }

  ground(labels) {
    const group = s("g", { class: "bm-grounds" });
    this.keepCranksFree(labels);
    this.linkage.led.forEach(({ id, fixed_pivot }, side) => this.fixedPivot(group, labels, { id: id[0], fixed_pivot }, Math.min(side, 1)));
    return group;
  }

  /** Where cranks are on their way no name is to stand. */
  keepCranksFree(labels) {
    const { view, places, linkage } = this, every = Math.ceil(places.length / 9);
    const cranks = linkage.links.filter(({ pin }) => pin in linkage.ground);
    const arms = cranks.flatMap(({ pin, joints }) => Object.keys(joints).filter((joint) => joint !== pin).map((joint) => pin + joint));
    for (const { joints } of places.filter((_, k) => k % every === 0)) {
      for (const [pivot, end] of arms) {
        const [[x, y], [u, v]] = [joints[pivot], joints[end]].map((at) => [view.X(at[0]), view.Y(at[1])]);
        const size = Math.hypot(u - x, v - y) || 1;
        for (const along of BESIDE_PIVOT) labels.block(x + (along * (u - x)) / size, y + (along * (v - y)) / size, 12, 12);
      }
    }
  }
}
