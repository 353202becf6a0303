// What moves a linkage along one of its ways: playing, the slider, steps from pose to pose.

import { give, h, put, s, say } from "./dom.mjs";
import { frameAt, linear, placeAt, smooth, valueAt } from "./kinematics.mjs";
import { clamp, degrees, figure, fixed, px, radians } from "./numbers.mjs";
import { calledOf, decimalsOf, missOf, nounOf, poseName, shortened } from "./tables.mjs";
import { driveAtTime, stretchOf, wayOfMost } from "./travel.mjs";

const TURN_SECONDS = 7; // a whole turn of the driver, or a way there and back
const TURN = 1e-6; // frames: a stretch that is shorter than its way by less is all of it
const NAME_ROWS = 5; // rows of names under the slider
const NUMBER_ROWS = 2; // rows of numbers, where the names have no room
const MANY_POSES = 100; // above this number there is one row of numbers
const ROW = 13; // pixels: the distance between two of them
const LONGEST_TICK = 18; // characters of a pose's name under the slider
const NO_ERROR = 1e-7; // degrees; an error below is rounding
const STEPS = 360; // of a key along what is played
const SPEEDS = [0.25, 0.5, 1, 2, 4];
const LOOPS = [["back", "there and back"], ["again", "again and again"], ["once", "once"]];

/** Where the linkage is, `u` frames along its way, with the elements that show it and change it.
 *
 * show(place, drive, transmission, near) draws what moves: the place of the body, the drive and the
 * transmission angle there, and the index of the nearest pose; rebuild() draws another way.
 */
export class Player {
  /** @type {any} */ parts;
  /** @type {any} */ steps;
  /** @type {any} */ tick;
  /** @type {any} */ wholeLabel;
  /** @type {any} */ speeds;
  /** @type {any} */ loops;
  /** @type {any} */ real;
  /** @type {any} */ realLabel;

  constructor(data, show, rebuild) {
    this.data = data;
    this.draw = { show, rebuild };
    this.linkage = null;
    this.way = 0;
    this.u = 0;
    this.heading = 1; // or -1, on the way back to the first pose
    this.speed = 1;
    this.loop = "back";
    this.isReal = false; // whether it moves as its drive moves it
    this.whole = false; // whether all of the way is played, instead of the poses on it
    this.stretch = { low: 0, high: 1, sense: 1 }; // the frames that are played
    this.playing = false;
    this.remaining = null; // frames until it rests by itself; null: it does not
    this.element = this.controls();
  }

  /** The way as frames; undefined where the linkage has none. */
  get path() {
    return this.linkage?.ways[this.way];
  }

  /** What a place to stop at is called. */
  get stop() {
    return nounOf(this.data);
  }

  controls() {
    const button = (name, text, label, onclick) => h("button", { type: "button", class: `bm-button ${name}`, "aria-label": label, title: label, onclick }, text);
    this.button = button("bm-play", "", "Play", () => this.play(!this.playing));
    this.slider = h("input", { type: "range", class: "bm-slider", min: 0, step: "any", "aria-label": "Driver", oninput: () => this.go(this.turned(Number(this.slider.value))) });
    this.box = h("input", { type: "checkbox", onchange: () => this.playWhole(this.box.checked) });
    this.boxName = h("span", {}, "Whole branch");
    this.stops = s("svg", { class: "bm-stops", "aria-hidden": "true" });
    this.parts = ["", "", "", ""].map((text) => h("span", {}, text));
    this.readout = h("output", { class: "bm-now" }, this.parts.flatMap((part, k) => (k ? [" ", part] : [part])));
    this.slider.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      this.step(event.shiftKey ? 10 * step : step);
    });
    const choice = (label, entries, take) => h("select", { class: "bm-pick", "aria-label": label, title: label, onchange: (event) => take(event.target.value) }, entries.map(([value, text]) => h("option", { value }, text)));
    this.steps = [button("bm-back", "", "", () => this.toPose(-1)), button("bm-next", "", "", () => this.toPose(1))];
    this.speeds = choice("Speed", SPEEDS.map((each) => [each, `${each} ×`]), (value) => (this.speed = Number(value)));
    this.speeds.value = "1";
    this.loops = choice("What comes after the last pose", LOOPS, (value) => this.takeLoop(value));
    this.real = h("input", { type: "checkbox", onchange: () => (this.isReal = this.real.checked) });
    this.realLabel = h("label", { class: "bm-real", hidden: true, title: "Move as the drive of the task moves it" }, this.real, h("span", {}, "As driven"));
    this.wholeLabel = h("label", { class: "bm-whole" }, this.box, this.boxName);
    this.nameStops();
    return h(
      "div",
      { class: "bm-controls" },
      h("div", { class: "bm-track" }, this.slider, this.stops),
      h(
        "div",
        { class: "bm-row" },
        this.button,
        this.steps[0],
        button("bm-small-step", "‹", "A small step back", () => this.step(-1)),
        button("bm-small-step", "›", "A small step on", () => this.step(1)),
        this.steps[1],
      ),
      h("div", { class: "bm-more" }, this.speeds, this.loops, this.wholeLabel, this.realLabel),
      this.readout,
    );
  }

  /** What the buttons call the places to stop at. */
  nameStops() {
    const { stop } = this, title = stop[0].toUpperCase() + stop.slice(1);
    [[`◀ ${title}`, `Previous ${stop}`], [`${title} ▶`, `Next ${stop}`]].forEach(([text, label], k) => {
      say(this.steps[k], text);
      put(this.steps[k], "aria-label", label);
      give(this.steps[k], "title", label);
    });
    give(this.wholeLabel, "title", `Play all that the driver reaches, not only from the first ${stop} to the last`);
  }

  /** Another linkage, on the way with most poses, at the first of them. */
  load(linkage) {
    this.linkage = linkage;
    this.take(wayOfMost(linkage));
  }

  /** Another way, at its first pose. */
  take(index) {
    this.way = index;
    this.u = this.firstStop();
    this.draw.rebuild();
  }

  /** Poses on this way, in their order: the rows of their errors, with k, the pose's index. */
  get stopsOnWay() {
    return this.linkage.pose_errors.map((row, k) => ({ ...row, k })).filter((row) => row.way === this.way);
  }

  firstStop() {
    return this.stopsOnWay[0]?.frame ?? 0;
  }

  /** The slider and what it runs over, for the way as it is now. */
  rebuild() {
    const { path, slider } = this;
    if (!path) this.play(false);
    this.nameStops();
    for (const each of [slider, this.button]) give(each, "disabled", !path);
    if (this.linkage) this.stretch = stretchOf(this.linkage, this.way, this.whole);
    give(this.box, "disabled", !this.stretch.isApart);
    give(this.realLabel, "hidden", !this.timed);
    say(this.boxName, path?.round ? "Whole turn" : "Whole branch");
    this.heading = 1; // at an end it turns round by itself
    this.u = clamp(this.u, this.stretch.low, this.stretch.high);
  }

  /** Play all of a way, or only from its first pose to its last; so it stays for other linkages. */
  playWhole(on) {
    this.whole = on;
    this.draw.rebuild();
  }

  /** Marks under the slider where the poses are, with as many of their names as there is room for. */
  drawStops() {
    const { stops, path } = this, { low, high } = this.stretch;
    stops.replaceChildren();
    if (!path) return;
    const width = Math.max(60, this.slider.clientWidth), inset = 9;
    const X = (u) => inset + ((this.turned(u) - low) / (high - low)) * (width - 2 * inset);
    const known = this.stopsOnWay.filter((row) => this.data.poses[row.k]); // a task may lose poses before it is solved again
    const rows = known.sort((a, b) => X(a.frame) - X(b.frame)).map((row) => ({ ...row, x: X(row.frame), pose: this.data.poses[row.k] }));
    // Names where all of them have room, else numbers; the whole name is there to point at.
    const named = laidOut(rows.map(({ x, pose }) => ({ x, text: shortened(poseName(pose), LONGEST_TICK) })), width, NAME_ROWS);
    const texts = named.every(({ at }) => at >= 0) ? named : laidOut(rows.map(({ x, pose }) => ({ x, text: pose.label })), width, rows.length > MANY_POSES ? 1 : NUMBER_ROWS);
    const deepest = Math.max(0, ...texts.map(({ at }) => at));
    const one = (k, pose, ...parts) => s("g", { "data-pose": k + 1 }, s("title", {}, calledOf(pose)), ...parts);
    rows.forEach(({ k, x, pose }, i) => stops.append(one(k, pose, s("path", { d: `M${px(x)} 0V${4 + ROW * Math.max(0, texts[i].at)}` }))));
    rows.forEach(({ k, pose }, i) => {
      const { at, middle, text } = texts[i];
      if (at >= 0) stops.append(one(k, pose, s("text", { x: px(middle), y: 14 + ROW * at, "text-anchor": "middle" }, text)));
    });
    put(stops, "viewBox", `0 0 ${width} ${16 + ROW * deepest}`);
    put(stops, "height", 16 + ROW * deepest);
  }

  play(on) {
    if (on && !this.path) return;
    this.remaining = null;
    if (on === this.playing && this.isDressed) return;
    this.isDressed = true;
    this.playing = on;
    put(this.readout, "aria-live", on ? "off" : "polite"); // it would talk without end
    this.button.replaceChildren(icon(on), on ? "Pause" : "Play");
    put(this.button, "aria-label", on ? "Pause" : "Play");
    this.button.title = on ? "Pause (space)" : "Play (space)";
    cancelAnimationFrame(this.tick);
    if (!on) return;
    let before = null;
    const run = (now) => {
      if (!this.playing) return;
      if (before !== null) this.advance(Math.min(0.1, (now - before) / 1000));
      before = now;
      if (this.playing) this.tick = requestAnimationFrame(run);
    };
    this.tick = requestAnimationFrame(run);
  }

  /** Play once there and back, or once round; then rest until someone asks. */
  playOnce() {
    if (!this.path) return;
    const { low, high } = this.stretch;
    this.u = this.turned(low);
    this.heading = 1;
    this.play(true);
    this.remaining = (this.goesRound ? 1 : 2) * (high - low);
  }

  /** Whether what is played ends where it begins. */
  get goesRound() {
    return this.path.round && this.stretch.high - this.stretch.low > this.path.x.length - 1 - TURN;
  }

  /** A frame counted in time, from the low end of the stretch on, and back. */
  turned(u) {
    const { low, high, sense } = this.stretch;
    return sense < 0 ? low + high - u : u;
  }

  /** What is known of the linkage's motion in time along this way. */
  get timed() {
    const loads = this.linkage?.followed ? null : this.linkage?.loads;
    return loads?.way === this.way && !this.whole ? loads.timed : null;
  }

  /** Another answer to what comes after the last pose. */
  takeLoop(loop) {
    this.loop = loop;
    this.heading = 1;
  }

  advance(seconds) {
    const { low, high } = this.stretch;
    if (this.isReal && this.timed) return this.drive(seconds);
    const step = (this.speed * seconds * (high - low)) / (this.goesRound ? TURN_SECONDS : TURN_SECONDS / 2);
    if (this.remaining !== null) {
      this.remaining -= step;
      if (this.remaining <= 0) {
        this.play(false);
        this.u = this.firstStop();
        this.show();
        return;
      }
    }
    const at = this.turned(this.u) + this.heading * step, isOver = at >= high;
    if (isOver && this.loop === "once") {
      this.play(false);
      this.u = this.turned(high);
    } else if (this.goesRound) {
      this.u = this.turned(around(at, high));
    } else if (isOver && this.loop === "again") {
      this.u = this.turned(low);
    } else {
      // It goes back at the last pose, or at a dead point: it never flips to the other branch.
      if (isOver || at <= low) this.heading = isOver ? -1 : 1;
      this.u = this.turned(clamp(at, low, high));
    }
    this.show();
  }

  /** Move as the drive of the task does: from its first moment on, and again or to rest at its last. */
  drive(seconds) {
    const { timed } = this, { y } = timed.time, last = Math.max(y[0], y[y.length - 1]), here = valueAt(timed.time, linear(this.path.drive, this.u)) ?? 0;
    let time = here + this.speed * seconds;
    if (time >= last && here < last) time = last;
    else if (time >= last && this.loop === "once") return this.play(false);
    else if (time >= last) time = 0;
    this.u = frameAt(this.path.drive, driveAtTime(timed, time) ?? linear(this.path.drive, this.u) ?? 0);
    this.show();
  }

  step(steps) {
    if (!this.path) return;
    const { low, high } = this.stretch;
    const at = this.turned(this.u) + steps * Math.max(1e-3, (high - low) / STEPS);
    this.go(this.turned(this.goesRound ? around(at, high) : at));
  }

  go(u) {
    if (!this.path) return;
    this.play(false);
    this.u = clamp(u, this.stretch.low, this.stretch.high);
    this.show();
  }

  /** The next pose (sense 1) or the one before (-1) that the linkage reaches, on whichever way. */
  toPose(sense) {
    const all = this.linkage.pose_errors.map((row, k) => ({ ...row, k })).filter((row) => row.way !== null);
    if (!all.length) return;
    const here = this.atPose ?? (sense > 0 ? -1 : this.data.poses.length);
    const next = sense > 0 ? (all.find((row) => row.k > here) ?? all[0]) : ([...all].reverse().find((row) => row.k < here) ?? all[all.length - 1]);
    this.play(false);
    if (next.way !== this.way) {
      this.way = next.way;
      this.u = next.frame;
      this.draw.rebuild();
    }
    this.go(next.frame);
    this.atPose = next.k;
  }

  /** The place of the body at a frame of the way. */
  placeAt(u) {
    return placeAt(this.linkage, this.path, u, this.data.chart.length);
  }

  /** The pose nearest to a place, the angle weighed as the errors weigh it. */
  nearest(place) {
    let near = 0, least = Infinity;
    this.data.poses.forEach((pose, k) => {
      const turn = pose.angle_deg === null ? 0 : place.a - radians(pose.angle_deg);
      const away = Math.hypot(place.x - pose.x, place.y - pose.y, this.data.chart.length * (turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI))));
      if (away < least) [near, least] = [k, away];
    });
    return near;
  }

  /** Draw where it is; told: also with the slider and in words, which may lag behind a hand. */
  show(told = true) {
    const { path } = this;
    if (!path) {
      for (const part of this.parts) part.textContent = "";
      return;
    }
    const place = this.placeAt(this.u);
    const drive = linear(path.drive, this.u), transmission = linear(path.transmission, this.u);
    const near = (this.atPose = this.nearest(place));
    if (told) {
      give(this.slider, "min", this.stretch.low);
      give(this.slider, "max", this.stretch.high);
      give(this.slider, "value", this.turned(this.u));
      this.tell(place, drive, transmission, near);
    }
    this.draw.show(place, drive, transmission, near);
  }

  /** Where the driver is: an angle, or a place on its line. */
  driverText(drive) {
    const { data, linkage } = this;
    return linkage.led[0].kind === "PR" ? `${fixed(drive, decimalsOf(data))}${data.unit ? ` ${data.unit}` : ""}` : `${linkage.crank ?? ""}${fixed(drive, 1)}°`;
  }

  /** The readout: driver, body, transmission angle, and the nearest pose. */
  tell(place, drive, transmission, near) {
    const { data, linkage } = this;
    const unit = data.unit ? ` ${data.unit}` : "", digits = decimalsOf(data), driver = this.driverText(drive);
    const pose = data.poses[near], row = linkage.pose_errors[near];
    const at = row?.at === this.path && Math.abs(row.frame - this.u) < 1e-6;
    // A task may lose poses before it is solved again.
    const away = () => `${figure(Math.hypot(place.x - pose.x, place.y - pose.y))}${unit} from ${calledOf(pose)}`;
    const missed = () => `at ${calledOf(pose)}, ${row.said.position === "exact" ? "" : "off by "}${missOf(row.said.position, row.said.turned, unit)}`;
    const said = !pose ? "between the poses" : pose.called ? `${at ? "at" : "near"} ${pose.called}` : at ? missed() : away();
    const time = this.isReal && this.timed && drive !== null ? valueAt(this.timed.time, drive) : null;
    const known = this.path.told?.map((each) => this.toldOf(each)) ?? [
      `driver ${driver}${time === null ? "" : ` at ${fixed(time, 2)} s`}`,
      `body (${fixed(place.x, digits)}, ${fixed(place.y, digits)})${unit}, ${fixed(((degrees(place.a) + 180) % 360 + 360) % 360 - 180, 2)}°`,
    ];
    const texts = [
      ...known,
      `transmission ${transmission === null ? "–" : `${fixed(transmission, 1)}°`}`,
      said,
    ];
    texts.forEach((text, k) => {
      const whole = k + 1 < texts.length ? `${text} ·` : text;
      if (this.parts[k].textContent !== whole) this.parts[k].textContent = whole;
    });
    put(this.slider, "aria-valuetext", `${texts[0]}, ${texts[3]}`);
  }

  /** A value along the way, and how far it is off where a panel says so. */
  toldOf({ name, digits, values, panel }) {
    const error = panel === undefined ? null : valueAt(this.linkage.panels[panel], smooth(this.path.drive, this.u));
    const off = error === null ? "" : `, off by ${Math.abs(error) < NO_ERROR ? "0" : figure(error)}°`;
    return `${name} ${fixed(smooth(values, this.u), digits)}°${off}`;
  }
}

/** Rows for texts around places from left to right; at: its row, -1 where it has no room. */
function laidOut(texts, width, count) {
  const ends = Array(count).fill(-99); // where each row is free again
  return texts.map(({ x, text }) => {
    const size = 6.4 * text.length, left = clamp(x - size / 2, 0, Math.max(0, width - size));
    const at = ends.findIndex((end) => left > end + 4);
    if (at >= 0) ends[at] = left + size;
    return { text, at, middle: left + size / 2 };
  });
}

const around = (u, turn) => ((u % turn) + turn) % turn;

function icon(pause) {
  return s(
    "svg",
    { width: 12, height: 12, viewBox: "0 0 12 12", "aria-hidden": "true" },
    s("path", { d: pause ? "M1 0h3.5v12H1zM7.5 0H11v12H7.5z" : "M1 0l11 6l-11 6z" }),
  );
}
