// What moves a six-bar: its joints meet at every angle of the driver.

import { fixed } from "./numbers.mjs";
import { Player } from "./player.mjs";
import { sixBarAt } from "./six_bar.mjs";

export class SixBarPlayer extends Player {
  placeAt(u) {
    return sixBarAt(this.linkage, this.path, u);
  }

  driverText(drive) {
    return `${this.linkage.crank} ${fixed(drive, 1)}°`;
  }
}
