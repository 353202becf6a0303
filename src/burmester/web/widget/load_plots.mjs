// What a linkage bears, over its driver or over time, with the cursor of the moving picture.

import { h, s } from "./dom.mjs";
import { valueAt } from "./kinematics.mjs";
import { px, ticks } from "./numbers.mjs";
import { LEFT, Plots, RIGHT } from "./plots.mjs";
import { driveAtTime, stretchOf } from "./travel.mjs";

const TITLE = "Loads";

let fieldsets = 0;

/** Curves of loads in `parent`; where the task has a drive, buttons say over what they are. */
export class LoadPlots extends Plots {
  /** @type {any} */ own = null;
  /** @type {any} */ timed = null;
  /** @type {number | undefined} */ drive;
  overTime = false;

  constructor(data, parent, scrub) {
    super(data, parent, scrub);
    const name = `bm-over-${(fieldsets += 1)}`;
    const one = (text, overTime) => h("label", {}, h("input", { type: "radio", name, checked: !overTime, onchange: () => this.take(overTime) }), h("span", {}, text));
    this.choice = h("fieldset", { class: "bm-ways bm-over", hidden: true }, one("Over the driver", false), one("Over time", true));
    this.nothing = h("p", { class: "bm-note-text", hidden: true }, "Loads are known from the first pose to the last, of a linkage that leads through all of them with its own driver.");
    this.forces = h("label", { class: "bm-forces", hidden: true }, h("input", { type: "checkbox", class: "bm-show-forces" }), h("span", {}, "Draw the forces of pins: of the link or the ground that holds a pin, on the other link; all to one scale"));
    parent.prepend(this.choice, this.forces, this.nothing);
  }

  take(overTime) {
    this.overTime = overTime;
    this.draw();
    if (this.drive !== undefined) this.show(this.drive);
  }

  /** Draw the panels of a linkage, if its loads are known along the way `index`. */
  build(linkage, index) {
    this.svg.classList.toggle("bm-stale", Boolean(linkage?.followed)); // curves of before, until the hand rests
    this.linkage = linkage;
    const loads = linkage?.loads, here = Boolean(loads) && loads.way === index && Boolean(linkage.ways[index]);
    this.own = here ? loads : null;
    this.way = here ? linkage.ways[index] : null;
    this.choice.hidden = !this.own?.timed;
    this.nothing.hidden = here;
    this.forces.hidden = !here;
    this.draw();
  }

  draw() {
    const { svg, own, data } = this;
    svg.replaceChildren();
    svg.removeAttribute("height");
    this.cursor = null;
    if (!own) return;
    const timed = this.overTime && own.timed ? own.timed : null, panels = (timed ?? own).panels, { x } = panels[0];
    this.timed = timed;
    const [driver] = this.linkage.led, slides = driver.kind === "PR";
    const title = timed ? "time (s)" : slides ? `place of ${driver.id} on its line (${data.unit})` : `driver angle (${driver.id})`;
    svg.setAttribute("aria-label", `${this.linkage.id}: ${TITLE.toLowerCase()} over ${timed ? "time" : "the driver"}`);
    const ends = [x[0], x[x.length - 1]], [low, high] = !timed && stretchOf(this.linkage, own.way).sense < 0 ? ends.reverse() : ends;
    this.frame(panels.length, low, high, !slides && !timed, title, () => {
      panels.forEach((each, k) => this.lines(k, each, k + 1 === panels.length));
    });
  }

  /** A panel with one or more curves, which have their names in its title. */
  lines(k, { title, x, lines }, last) {
    const all = lines.flatMap(({ y }) => y.filter((each) => each !== null)), [y0, base] = this.heights(k);
    const least = Math.min(0, ...all), most = Math.max(0, ...all), room = 0.08 * (most - least || 1);
    this.panel(title, y0, base, last);
    const Y = (v) => base - ((v - least + room) / (most - least + 2 * room)) * (base - y0);
    for (const { at, text } of ticks(least, most, 4)) this.rule(Y(at), text);
    if (least < 0 && most > 0) this.svg.append(s("path", { class: "bm-usual", d: `M${LEFT} ${px(Y(0))}H${this.width - RIGHT}` }));
    lines.forEach(({ y }, line) => {
      let d = "", pen = "M";
      x.forEach((at, i) => {
        if (y[i] === null) pen = "M";
        else {
          d += `${pen}${px(this.X(at))} ${px(Y(y[i]))}`;
          pen = "L";
        }
      });
      this.svg.append(s("path", { class: `bm-line bm-curve${line}`, d }));
      this.mark((at) => valueAt({ x, y }, at), Y);
    });
    if (lines.length > 1) {
      const names = s("text", { class: "bm-title", x: this.width - RIGHT, y: y0 - 7, "text-anchor": "end" });
      lines.forEach(({ name }, line) => names.append(s("tspan", { class: `bm-curve${line}`, dx: line ? 7 : 0 }, name)));
      this.svg.append(names);
    }
  }

  /** What the cursor is at: the driver, or the time at which it is there. */
  placeOf(drive) {
    const { own, timed } = this;
    if (this.linkage.followed) return null;
    if (timed) return valueAt(timed.time, drive);
    const { x } = own.panels[0];
    return drive < x[0] - 1e-6 || drive > x[x.length - 1] + 1e-6 ? null : drive;
  }

  driveAt(at) {
    return this.timed ? driveAtTime(this.timed, at) : at;
  }

  show(drive) {
    this.drive = drive;
    super.show(drive);
  }
}
