// What moves a function generator: its stops are pairs of angles, and it tells input, output and error.

import { put } from "./dom.mjs";
import { linear } from "./kinematics.mjs";
import { figure, fixed } from "./numbers.mjs";
import { Player } from "./player.mjs";
import { poseName } from "./tables.mjs";

/** An angle in degrees, by whole turns as near as can be to another. */
const near = (angle, other) => angle - 360 * Math.round((angle - other) / 360);

export class GeneratorPlayer extends Player {
  get stop() {
    return "place";
  }

  constructor(data, show, rebuild, generator) {
    super(data, show, rebuild);
    this.generator = generator;
  }

  /** The input at a drive, in degrees. */
  inputOf(drive) {
    const { low, high } = this.generator.range;
    return near(drive - this.generator.input_phase, (low + high) / 2);
  }

  /** The drive at an input that is played. */
  driveOf(input) {
    const low = linear(this.path.drive, this.stretch.low);
    return low + input - this.inputOf(low);
  }

  /** The input where the linkage is; at a stop exactly its own. */
  inputAt(drive) {
    const stop = this.linkage.pose_errors.findIndex((row) => row.at === this.path && Math.abs(row.frame - this.u) < 1e-6);
    return stop < 0 ? this.inputOf(drive) : this.data.poses[stop].input_deg;
  }

  tell(place, drive, transmission, stop) {
    const { generator } = this, input = this.inputAt(drive);
    const wanted = generator.wantedAt(input), { output } = generator.at(input);
    const pose = this.data.poses[stop], row = this.linkage.pose_errors[stop];
    const here = row?.at === this.path && Math.abs(row.frame - this.u) < 1e-6;
    const texts = [
      `input ${fixed(input, 2)}°`,
      `output ${fixed(output, 3)}°${wanted === null || output === null ? "" : `, off by ${size(output - wanted)}`}`,
      `transmission ${transmission === null ? "–" : `${fixed(transmission, 1)}°`}`,
      here ? `at ${stopName(pose)}` : `near ${stopName(pose)}`,
    ];
    texts.forEach((text, k) => {
      const whole = k + 1 < texts.length ? `${text} ·` : text;
      if (this.parts[k].textContent !== whole) this.parts[k].textContent = whole;
    });
    put(this.slider, "aria-valuetext", texts.slice(0, 2).join(", "));
  }
}

/** A stop as a sentence names it: a pair by its number, another by its own name. */
const stopName = (pose) => (/^\d+$/.test(pose.name) ? `pair ${poseName(pose)}` : poseName(pose));

/** An error in degrees; what is rounding is none. */
const size = (error) => (Math.abs(error) < 1e-7 ? "0°" : `${figure(error)}°`);
