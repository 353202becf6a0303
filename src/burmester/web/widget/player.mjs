// What moves a linkage along one of its ways: playing, the slider, steps from pose to pose.

import { h, s } from "./dom.mjs";
import { linear, placeAt } from "./kinematics.mjs";
import { clamp, degrees, figure, fixed, px, radians } from "./numbers.mjs";
import { decimalsOf, missOf } from "./tables.mjs";

const TURN_SECONDS = 7; // a whole turn of the driver, or a way there and back
const STEPS = 360; // of a key along a way, at least

/** Where the linkage is, `u` frames along its way, with the elements that show it and change it.
 *
 * show(place, drive, transmission, near) draws what moves: the place of the body, the drive and the
 * transmission angle there, and the index of the nearest pose; rebuild() draws another way.
 */
export class Player {
  constructor(data, show, rebuild) {
    this.data = data;
    this.draw = { show, rebuild };
    this.linkage = null;
    this.way = 0;
    this.u = 0;
    this.heading = 1; // or -1, on the way back
    this.playing = false;
    this.remaining = null; // frames until it rests by itself; null: it does not
    this.element = this.controls();
  }

  /** The way as frames; undefined where the linkage has none. */
  get path() {
    return this.linkage?.ways[this.way];
  }

  controls() {
    const button = (name, text, label, onclick) => h("button", { type: "button", class: `bm-button ${name}`, "aria-label": label, title: label, onclick }, text);
    this.button = button("bm-play", "", "Play", () => this.play(!this.playing));
    this.slider = h("input", { type: "range", class: "bm-slider", min: 0, step: "any", "aria-label": "Driver", oninput: () => this.go(Number(this.slider.value)) });
    this.stops = s("svg", { class: "bm-stops", "aria-hidden": "true" });
    this.parts = ["", "", "", ""].map((text) => h("span", {}, text));
    this.readout = h("output", { class: "bm-now" }, this.parts.flatMap((part, k) => (k ? [" ", part] : [part])));
    this.slider.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      this.step(event.shiftKey ? 10 * step : step);
    });
    return h(
      "div",
      { class: "bm-controls" },
      h(
        "div",
        { class: "bm-row" },
        this.button,
        button("bm-back", "◀ Pose", "Previous pose", () => this.toPose(-1)),
        button("bm-next", "Pose ▶", "Next pose", () => this.toPose(1)),
        h("div", { class: "bm-track" }, this.slider, this.stops),
      ),
      this.readout,
    );
  }

  /** Another linkage, on the way with most poses, at the first of them. */
  load(linkage) {
    this.linkage = linkage;
    const counts = linkage.ways.map((way) => way.poses.length);
    this.take(Math.max(0, counts.indexOf(Math.max(...counts))));
  }

  /** Another way, at its first pose. */
  take(index) {
    this.way = index;
    this.u = this.firstStop();
    this.draw.rebuild();
  }

  firstStop() {
    return this.linkage.pose_errors.find((row) => row.way === this.way)?.frame ?? 0;
  }

  /** The slider and its marks, for the way as it is now. */
  rebuild() {
    const { path, slider } = this;
    this.heading = 1;
    if (!path) this.play(false);
    slider.max = path ? path.x.length - 1 : 1;
    slider.disabled = this.button.disabled = !path;
  }

  /** Marks under the slider where the poses are. */
  drawStops() {
    const { stops, path } = this;
    stops.replaceChildren();
    if (!path) return;
    const width = Math.max(60, this.slider.clientWidth), inset = 9;
    stops.setAttribute("viewBox", `0 0 ${width} 16`);
    const X = (u) => inset + (u / (path.x.length - 1)) * (width - 2 * inset);
    let last = -99;
    const rows = this.linkage.pose_errors.map((row, k) => ({ ...row, k })).filter((row) => row.way === this.way);
    for (const row of rows.sort((a, b) => a.frame - b.frame)) {
      const x = px(X(row.frame)), name = this.data.poses[row.k].label;
      stops.append(s("path", { d: `M${x} 0V4` }));
      if (x - last > 4 + 6.4 * name.length) {
        stops.append(s("text", { x, y: 14, "text-anchor": "middle" }, name));
        last = x;
      }
    }
  }

  play(on) {
    if (on && !this.path) return;
    this.playing = on;
    this.readout.setAttribute("aria-live", on ? "off" : "polite"); // it would talk without end
    this.remaining = null;
    this.button.replaceChildren(icon(on), on ? "Pause" : "Play");
    this.button.setAttribute("aria-label", on ? "Pause" : "Play");
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

  /** Play once round, or there and back; then rest until someone asks. */
  playOnce() {
    if (!this.path) return;
    this.play(true);
    this.remaining = (this.path.round ? 1 : 2) * (this.path.x.length - 1);
  }

  advance(seconds) {
    const { path } = this, last = path.x.length - 1;
    const step = (seconds * last) / (path.round ? TURN_SECONDS : TURN_SECONDS / 2);
    if (this.remaining !== null) {
      this.remaining -= step;
      if (this.remaining <= 0) {
        this.play(false);
        this.u = this.firstStop();
        this.show();
        return;
      }
    }
    if (path.round) this.u = (this.u + step) % last;
    else {
      // It stops at a dead point, and goes back: it never flips to the other branch.
      this.u += this.heading * step;
      if (this.u >= last || this.u <= 0) {
        this.heading = this.u >= last ? -1 : 1;
        this.u = clamp(this.u, 0, last);
      }
    }
    this.show();
  }

  step(steps) {
    if (!this.path) return;
    const last = this.path.x.length - 1;
    const u = this.u + steps * Math.max(1, last / STEPS);
    this.go(this.path.round ? ((u % last) + last) % last : u);
  }

  go(u) {
    if (!this.path) return;
    this.play(false);
    this.u = clamp(u, 0, this.path.x.length - 1);
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

  /** The pose nearest to a place, the angle weighed as the errors weigh it. */
  nearest(place) {
    let near = 0, least = Infinity;
    this.data.poses.forEach((pose, k) => {
      const turn = place.a - radians(pose.angle_deg);
      const away = Math.hypot(place.x - pose.x, place.y - pose.y, this.data.chart.length * (turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI))));
      if (away < least) [near, least] = [k, away];
    });
    return near;
  }

  show() {
    const { path, linkage, data } = this;
    if (!path) {
      for (const part of this.parts) part.textContent = "";
      return;
    }
    const place = placeAt(linkage, path, this.u, data.chart.length);
    const drive = linear(path.drive, this.u), transmission = linear(path.transmission, this.u);
    const near = (this.atPose = this.nearest(place));
    this.slider.value = this.u;
    this.tell(place, drive, transmission, near);
    this.draw.show(place, drive, transmission, near);
  }

  /** The readout: driver, body, transmission angle, and the nearest pose. */
  tell(place, drive, transmission, near) {
    const { data, linkage } = this;
    const unit = data.unit ? ` ${data.unit}` : "", digits = decimalsOf(data);
    const driver = linkage.led[0].kind === "PR" ? `${fixed(drive, digits)}${unit}` : `${fixed(drive, 1)}°`;
    const pose = data.poses[near], row = linkage.pose_errors[near];
    const at = row.at === this.path && Math.abs(row.frame - this.u) < 1e-6;
    const texts = [
      `driver ${driver}`,
      `body (${fixed(place.x, digits)}, ${fixed(place.y, digits)})${unit}, ${fixed(((degrees(place.a) + 180) % 360 + 360) % 360 - 180, 2)}°`,
      `transmission ${transmission === null ? "–" : `${fixed(transmission, 1)}°`}`,
      at
        ? `at pose ${pose.label}, ${row.said.position === "exact" ? "" : "off by "}${missOf(row.said.position, row.said.turned, unit)}`
        : `${figure(Math.hypot(place.x - pose.x, place.y - pose.y))}${unit} from pose ${pose.label}`,
    ];
    texts.forEach((text, k) => {
      const whole = k + 1 < texts.length ? `${text} ·` : text;
      if (this.parts[k].textContent !== whole) this.parts[k].textContent = whole;
    });
    this.slider.setAttribute("aria-valuetext", `driver ${driver}`);
  }
}

function icon(pause) {
  return s(
    "svg",
    { width: 12, height: 12, viewBox: "0 0 12 12", "aria-hidden": "true" },
    s("path", { d: pause ? "M1 0h3.5v12H1zM7.5 0H11v12H7.5z" : "M1 0l11 6l-11 6z" }),
  );
}
