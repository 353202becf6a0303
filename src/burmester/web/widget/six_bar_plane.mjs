// A six-bar in its plane: the picture holds all of it, and the joints have their names.

import { s } from "./dom.mjs";
import { linear } from "./kinematics.mjs";
import { including } from "./outlines.mjs";
import { Plane } from "./plane.mjs";
import { sixBarAt } from "./six_bar.mjs";
import { SixBarMechanism } from "./six_bar_mechanism.mjs";
import { placesAlong } from "./travel.mjs";

export class SixBarPlane extends Plane {
  build(linkage, way, stretch, how) {
    super.build(linkage, way, stretch, { ...how, far: true });
  }

  placesOf(way, stretch) {
    return placesAlong(this.data, stretch, (u) => sixBarAt(this.linkage, linear(way.drive, u)));
  }

  bounds(far) {
    return including(super.bounds(far), this.places.flatMap((place) => Object.values(place.joints)));
  }

  mechanism() {
    return new SixBarMechanism(this.data, this.linkage, this.view);
  }

  /** The paths of the two pins that carry the body. */
  pivotPaths() {
    return ["E", "H"].map((joint) => ({ side: "-inner", points: this.places.map((place) => place.joints[joint]) }));
  }

  ground(labels) {
    const group = s("g", { class: "bm-grounds" });
    this.linkage.led.forEach(({ id, fixed_pivot }, side) => this.fixedPivot(group, labels, { id: id[0], fixed_pivot }, side));
    return group;
  }
}
