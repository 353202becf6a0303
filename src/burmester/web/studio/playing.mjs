// What moves the chosen linkage: play controls, either driver, either assembly; and where it is now.

import { Assemblies } from "../widget/assemblies.mjs";
import { give, h, put, say } from "../widget/dom.mjs";
import { frameAt } from "../widget/kinematics.mjs";
import { fixed } from "../widget/numbers.mjs";
import { Player } from "../widget/player.mjs";
import { restForPrint } from "../widget/printing.mjs";
import { wayOfMost } from "../widget/travel.mjs";
import { Events } from "./events.mjs";
import { drivenByOther } from "./other_driver.mjs";
import { Pace } from "./pacing.mjs";

const REDUCED_MOTION = "(prefers-reduced-motion: reduce)";
const AT_POSE = 1e-6; // frames: nearer than that the body is at the pose

/** Events: "shape" (another linkage or way, or the same one with other dimensions: `moved` is true), "place" (it moved along its way). */
export class Playing extends Events {
  constructor(store, answers) {
    super();
    this.store = store;
    this.answers = answers;
    this.isOther = false; // whether the other dyad drives
    this.here = null; // { place, drive, transmission, near }
    this.player = new Player(answers.data, (place, drive, transmission, near) => this.placed({ place, drive, transmission, near }), () => this.rebuild());
    this.assemblies = new Assemblies(answers.data, (index) => this.player.take(index));
    this.drivers = h("fieldset", { class: "bm-ways bs-drivers", hidden: true });
    this.note = h("p", { class: "bs-quiet bs-driver-note" });
    this.element = h("div", { class: "bs-player" }, this.player.element, h("div", { class: "bs-player-ways" }, this.drivers, this.assemblies.element), this.note);
    this.words = new Pace(() => this.player.path && this.player.show());
    this.marks = new Pace(() => this.player.drawStops());
    answers.on("answers shown placed", () => this.load());
    answers.on("moved", () => this.follow());
    store.on("selection", () => this.goToSelected());
    store.on("state", () => this.hush());
    restForPrint(this.player);
    new ResizeObserver(() => this.marks.ask()).observe(this.element);
    this.load();
  }

  /** The linkage as it is driven, or null. */
  get linkage() {
    return this.player.linkage;
  }

  /** The frames of the way that is shown, or undefined. */
  get path() {
    return this.player.path;
  }

  /** Another linkage, or another answer for the same one, which stays where it is. */
  load() {
    const base = this.answers.shown ?? null;
    if (base === this.base && base) {
      this.follow();
      this.tellDriver();
      return;
    }
    this.base = base;
    this.isOther = false;
    this.at = null;
    this.dress();
    if (!base) {
      this.player.linkage = null;
      this.player.way = 0;
      this.player.play(false);
      for (const each of [this.assemblies.element, this.drivers]) give(each, "hidden", true);
      say(this.note, "");
      this.element.classList.add("bs-empty");
      this.emit("shape", false);
      return;
    }
    this.element.classList.remove("bs-empty");
    this.player.load(this.driven());
    this.goToSelected();
  }

  /** The linkage led by the dyad that is to drive. */
  driven() {
    return this.isOther ? drivenByOther(this.base, this.answers.data.chart.length) : this.base;
  }

  /** Drive by the first dyad of the linkage, or by the other one. */
  driveBy(other) {
    this.isOther = other;
    this.player.linkage = this.driven();
    this.at = null;
    this.takeBest();
    this.rebuild();
    this.tellDriver();
  }

  takeBest() {
    this.player.way = wayOfMost(this.linkage);
    this.player.u = this.player.firstStop();
  }

  /** The same linkage with other dimensions: at the same pose, or the same place of its driver. */
  follow() {
    const { base, player } = this;
    if (!base) return;
    player.linkage = this.driven();
    const row = this.at?.pose === undefined ? null : player.linkage.pose_errors[this.at.pose];
    if (row && row.way !== null) {
      player.way = row.way;
      player.u = row.frame;
    } else if (!player.path) {
      if (player.linkage.ways.length) this.takeBest();
    } else if (this.at) {
      player.u = this.frameOf(player.path, this.at.drive);
    }
    player.rebuild();
    this.emit("shape", true);
    player.show(false);
    this.words.ask();
    this.marks.ask();
  }

  /** The frame of a way at which its driver stands so; of angles, whole turns do not count. */
  frameOf(way, drive) {
    if (drive === null || this.linkage.led[0].kind === "PR") return frameAt(way.drive, drive ?? way.drive[0]);
    const middle = (way.drive[0] + way.drive[way.drive.length - 1]) / 2;
    return frameAt(way.drive, drive - 360 * Math.round((drive - middle) / 360));
  }

  /** Everything that depends on the way. */
  rebuild() {
    const { player } = this;
    player.rebuild();
    this.assemblies.build(this.linkage, player.way);
    this.buildDrivers();
    this.emit("shape", false);
    this.marks.ask();
    player.show();
  }

  placed(here) {
    this.here = here;
    const { path, u } = this.player;
    const pose = this.linkage.pose_errors.findIndex((row) => row.at === path && Math.abs(row.frame - u) < AT_POSE);
    this.at = { drive: here.drive, pose: pose < 0 ? undefined : pose };
    this.emit("place", here);
  }

  /** The linkage goes to a pose that is taken hold of. */
  goToSelected() {
    const { selection } = this.store, { player } = this;
    if (selection?.kind !== "pose" || player.playing) return;
    const row = this.linkage?.pose_errors[selection.index];
    if (!row || row.way === null) return;
    const other = row.way !== player.way;
    player.way = row.way;
    player.u = row.frame;
    if (other) this.rebuild();
    else player.go(row.frame);
  }

  /** A choice between both dyads. */
  buildDrivers() {
    const { base } = this;
    give(this.drivers, "hidden", !base || !base.ways.length || base.led.some(({ kind }) => kind === "PP" || kind === "crank"));
    if (this.drivers.hidden) return;
    const key = `${base.id} ${base.led.map((dyad) => dyad.id)} ${this.isOther}`;
    if (key === this.driversKey) return;
    this.driversKey = key;
    const one = (dyad, other) =>
      h("label", {}, h("input", { type: "radio", name: "bs-driver", checked: other === this.isOther, "data-driver": dyad.id, onchange: () => this.driveBy(other) }), h("span", {}, h("b", {}, dyad.id), ` ${{ RR: "crank or rocker", PR: "slider on its rail", RP: "slot" }[dyad.kind]}`));
    this.drivers.replaceChildren(h("legend", {}, "Driver"), one(base.led[0], false), one(base.led[1], true));
    this.tellDriver();
  }

  /** What the whole search says of the driver that is chosen. */
  tellDriver() {
    const { base } = this;
    if (!base?.drives || base.followed) {
      say(this.note, "");
      return;
    }
    const driver = this.isOther ? base.led[1] : base.led[0];
    const drive = base.dyads[0].id === driver.id ? base.drives.first : base.drives.second;
    const least = drive.min_transmission_angle_deg.range;
    const said = drive.defects.length
      ? drive.defects.map((each) => each.message).join("; ")
      : `${drive.turns_fully ? "turns fully" : "reaches every pose"}${least === null ? "" : `, transmission angle ${fixed(least, 1)}° or more between the poses`}`;
    say(this.note, `Driven by ${driver.id}: ${said}.`);
  }

  /** Poses and outlines are read by the player from the data, which stay the same object. */
  dress() {
    this.driversKey = null;
  }

  /** While a hand drags, nothing is read out. */
  hush() {
    const quiet = this.store.state === "dragging" || this.player.playing;
    put(this.player.readout, "aria-live", quiet ? "off" : "polite");
  }
}

/** The first answer moves once, unless the reader wants no motion; a hand that takes hold of something stops it. */
export function playOnce(store, answers, { player }) {
  if (matchMedia(REDUCED_MOTION).matches) return;
  let first = true;
  answers.on("answers", () => {
    if (first && player.path) {
      first = false;
      player.playOnce();
    }
  });
  store.on("document selection", () => {
    first = false;
    if (player.remaining !== null) player.play(false);
  });
}
