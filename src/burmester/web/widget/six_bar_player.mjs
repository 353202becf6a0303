// What moves a six-bar: its places are exact at every angle of the driver.

import { linear } from "./kinematics.mjs";
import { fixed } from "./numbers.mjs";
import { Player } from "./player.mjs";
import { sixBarAt } from "./six_bar.mjs";

export class SixBarPlayer extends Player {
  placeAt(u) {
    return sixBarAt(this.linkage, linear(this.path.drive, u));
  }

  driverText(drive) {
    return `${this.linkage.crank} ${fixed(drive, 1)}°`;
  }
}
