// The transmission angles of a six-bar over the drive.

import { s } from "./dom.mjs";
import { LEFT, Plots, RIGHT } from "./plots.mjs";
import { figure, px } from "./numbers.mjs";

const PANEL = 150; // pixels: height of the panel
const SOUND = 30; // degrees: the transmission angle below which a linkage is not sound

export class SixBarPlots extends Plots {
  static HEIGHT = PANEL;
  static TITLE = "Transmission angles";

  panels(rows) {
    const { svg, way, width, top } = this, base = top + PANEL;
    this.Y = (v) => base - (v / 90) * PANEL;
    this.panel("transmission angle (°)", top, base, true);
    for (const at of [0, 30, 60, 90]) this.rule(this.Y(at), at);
    const asked = this.data.asked_transmission_deg, limit = asked ?? SOUND, y = px(this.Y(limit));
    svg.append(
      s("path", { class: "bm-usual", d: `M${LEFT} ${y}H${width - RIGHT}` }),
      s("text", { class: "bm-tick bm-halo", x: width - RIGHT - 4, y: y + 12, "text-anchor": "end" }, `${figure(limit)}°, ${asked ? "asked" : "of a sound linkage"}`),
    );
    way.loops.forEach((values, k) => {
      this.curve(values, this.Y, `bm-line bm-loop${k}`);
      for (const row of rows) svg.append(s("circle", { class: `bm-dot bm-loop${k}`, cx: px(this.X(row.drive)), cy: px(this.Y(row.loops[k])), r: 3 }));
    });
    return base;
  }

  build(linkage, index, stretch) {
    super.build(linkage, index, stretch);
    if (!this.cursor) return;
    this.others = linkage.legs.slice(1).map(() => s("circle", { r: 4.5 }));
    this.cursor.append(...this.others);
  }

  show(drive, transmission, place) {
    if (!this.cursor) return;
    super.show(drive, place.loops[0]);
    this.others.forEach((mark, k) => mark.setAttribute("cy", px(this.Y(place.loops[k + 1]))));
  }
}
