// The moving parts of a linkage as they are drawn: links, blocks in slots, the body and its pivots.
//
// Elements are made once for two kinds of dyads; `shape` gives them the dimensions of a linkage and
// `show` puts them at a place of the body, so that a linkage that changes is not drawn anew.

import { put, s } from "./dom.mjs";
import { AXIS, BLOCK, axes, hull, transform } from "./drawing.mjs";
import { act, normalOf } from "./kinematics.mjs";
import { LoadMarks } from "./load_marks.mjs";
import { px } from "./numbers.mjs";
import { bodyOutline } from "./outlines.mjs";
import { pointOnLine, travelOf } from "./travel.mjs";

const BODY_AXIS = AXIS + 10; // pixels: the x axis of the body
export const LETTER = 14; // pixels: how far the letter M stands from the origin of M, along x and against y: names of poses stand elsewhere
/** A driver that turns, around the origin. */
const TURNING_ARROW = "M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9";
const BLOCK_IN_SLOT = [18, 10]; // pixels: its length and height
const SPARE = 5; // pixels: how far a slot goes on beyond its block
const NAME = 15; // pixels: how far the name of a joint stands from it
const ARROW = 24; // pixels: how far the arrow of a sliding driver stands from its block

/** The parts of a linkage in a picture; places: all that are shown. */
export function mechanism(data, linkage, view, places) {
  const drawn = new Mechanism(linkage);
  drawn.shape(data, linkage, view, places);
  return drawn;
}

/** The parts of linkages whose dyads are of the same kinds as one: `group` holds them. */
export class Mechanism {
  constructor({ led, drawn: links = [], ground, names }) {
    this.kinds = kindsOf(led);
    this.outline = s("path", { class: "bm-body-outline" });
    this.links = s("g");
    this.blocks = s("g");
    this.pins = s("g");
    this.coupler = s("g", { class: "bm-coupler" });
    this.arrow = s("path", { class: "bm-drive-mark bm-side0" });
    this.letter = s("text", { class: "bm-letter", "text-anchor": "middle" }, "M");
    this.plates = [s("path", { class: "bm-plate-rim" }), s("path", { class: "bm-plate" })];
    this.coupler.append(...this.plates);
    this.parts = led.map((dyad, side) => new PARTS[dyad.kind](this, side));
    if (links.length) this.parts.push(...links.map((link) => new JointedLink(this, link)), new Joints(this, ground, names));
    this.coupler.append(s("path", { class: "bm-body-frame", d: axes(BODY_AXIS) }), s("circle", { class: "bm-origin", r: 4 }));
    for (const part of this.parts) if (part.pin) this.coupler.append(part.pin);
    this.marks = new LoadMarks();
    this.group = s("g", { class: "bm-linkage" }, this.arrow, this.links, this.coupler, this.blocks, this.pins, this.marks.group, links.length ? null : this.letter);
  }

  /** Whether it can be given the dimensions of a linkage. */
  fits({ led }) {
    return kindsOf(led) === this.kinds;
  }

  /** The dimensions of a linkage in a picture; slots are as long as the places need. */
  shape(data, linkage, view, places) {
    this.view = view;
    this.led = linkage.led;
    this.hasBody = Boolean(data.body);
    if (this.hasBody) {
      put(this.outline, "d", bodyOutline(data, view));
      if (!this.outline.parentNode) this.group.prepend(this.outline);
    } else {
      this.outline.remove();
    }
    const corners = [[0, 0]]; // of the body's plate, in pixels from the origin of M
    linkage.led.forEach((dyad, side) => {
      if (dyad.moving_pivot) corners.push(inBody(dyad.moving_pivot, view));
      const more = this.parts[side].shape(dyad, view, places);
      if (more) corners.push(more);
    });
    const d = `M${hull(corners).map((corner) => corner.map(px).join(" ")).join("L")}Z`;
    for (const plate of linkage.drawn ? [] : this.plates) put(plate, "d", d);
    for (const part of this.parts.slice(linkage.led.length)) part.shape(view);
    this.marks.shape(data, linkage, view);
    this.shapeArrow();
  }

  /** drive: where the driver is, for what is known over it only. */
  show(place, /** @type {number | null} */ drive = null) {
    const { view } = this, at = transform(view.X(place.x), view.Y(place.y), place.a);
    this.marks.show(place, drive);
    put(this.coupler, "transform", at);
    if (this.hasBody) put(this.outline, "transform", at);
    for (const part of this.parts) part.show(place);
    const [x, y] = act(place, [LETTER / view.scale, -LETTER / view.scale]);
    put(this.letter, "transform", `translate(${px(view.X(x))} ${px(view.Y(y) + 4)})`);
    const [driver] = this.led;
    if (driver.kind === "PR") put(this.arrow, "transform", `${onRail(driver, place, view)} translate(0 ${-ARROW})`);
  }

  /** A turning or sliding arrow at the driver, for eyes that tell no colours apart. */
  shapeArrow() {
    const { arrow, view } = this, [driver] = this.led;
    if (driver.kind === "PR") put(arrow, "d", "M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5");
    if (!driver.fixed_pivot) return;
    const [x, y] = driver.fixed_pivot;
    put(arrow, "d", TURNING_ARROW);
    put(arrow, "transform", `translate(${px(view.X(x))} ${px(view.Y(y))}) rotate(-90)`);
  }
}

const kindsOf = (led) => led.map((dyad) => dyad.kind).join();

/** A point of M in pixels from its origin.
 * @param {number[]} point @param {import("./types").View} view */
const inBody = ([x, y], view) => [view.scale * x, -view.scale * y];

/** The transform of a block on its rail. */
function onRail(dyad, place, view) {
  const [x, y] = act(place, dyad.moving_pivot), [nx, ny] = normalOf(dyad);
  return transform(view.X(x), view.Y(y), Math.atan2(nx, -ny));
}

const block = (side, width, height) =>
  s("g", { class: `bm-block bm-side${side}` }, s("rect", { x: -width / 2, y: -height / 2, width, height, rx: 2 }));

/** Put a pin at a point given in pixels, with the name of its dyad.
 * @param {any} pin @param {number[]} point @param {any} dyad */
function setPin(pin, [x, y], dyad) {
  put(pin, "cx", px(x));
  put(pin, "cy", px(y));
  put(pin, "data-dyad", dyad.id);
}

/** A point of F in pixels.
 * @param {number[]} point @param {import("./types").View} view */
const inGround = ([x, y], view) => [view.X(x), view.Y(y)];

/** RR: a bar from the fixed pivot to the moving one. */
class Bar {
  constructor({ links, pins }, side) {
    this.strokes = [s("path", { class: "bm-bar" }), s("path", { class: "bm-core" })];
    this.bar = s("g", { class: `bm-link bm-side${side}` }, this.strokes);
    this.ground = s("circle", { class: "bm-pin bm-fixed-pin", r: 4.5 });
    this.pin = s("circle", { class: "bm-pin", r: 4.5 });
    links.append(this.bar);
    pins.append(this.ground);
  }

  shape(dyad, view) {
    this.dyad = dyad;
    this.view = view;
    for (const stroke of this.strokes) put(stroke, "d", `M0 0H${px(view.scale * dyad.radius)}`);
    setPin(this.ground, inGround(dyad.fixed_pivot, view), dyad);
    setPin(this.pin, inBody(dyad.moving_pivot, view), dyad);
  }

  show(place) {
    const { dyad, view } = this, [cx, cy] = dyad.fixed_pivot, [x, y] = act(place, dyad.moving_pivot);
    put(this.bar, "transform", transform(view.X(cx), view.Y(cy), Math.atan2(y - cy, x - cx)));
  }
}

/** PR: a block on the rail that stands on the ground. */
class BlockOnRail {
  constructor({ blocks }, side) {
    this.block = block(side, ...BLOCK);
    this.pin = s("circle", { class: "bm-pin", r: 4.5 });
    blocks.append(this.block);
  }

  shape(dyad, view) {
    this.dyad = dyad;
    this.view = view;
    put(this.block, "data-dyad", dyad.id);
    setPin(this.pin, inBody(dyad.moving_pivot, view), dyad);
  }

  show(place) {
    put(this.block, "transform", onRail(this.dyad, place, this.view));
  }
}

/** RP: a slot in the body, as long as the travel of its block, which stands on the fixed pivot. */
class Slot {
  constructor({ blocks, pins, coupler }, side) {
    this.strokes = ["rim", "plate", "edge"].map((name) => s("path", { class: `bm-slot-${name}` }));
    this.strokes.push(s("path", { class: "bm-slot" }));
    this.block = block(side, ...BLOCK_IN_SLOT);
    this.ground = s("circle", { class: "bm-pin bm-fixed-pin", r: 4 });
    coupler.append(...this.strokes);
    blocks.append(this.block);
    pins.append(this.ground);
  }

  /** Returns the middle of the slot, for the body's plate. */
  shape(dyad, view, places) {
    this.dyad = dyad;
    this.view = view;
    const [low, high] = places.length ? travelOf(dyad, places) : [0, 0], end = (BLOCK_IN_SLOT[0] / 2 + SPARE) / view.scale;
    const seen = (along) => inBody(pointOnLine(dyad, along), view);
    const d = `M${[seen(low - end), seen(high + end)].map((each) => each.map(px).join(" ")).join("L")}`;
    for (const stroke of this.strokes) put(stroke, "d", d);
    for (const part of [this.strokes[3], this.block]) put(part, "data-dyad", dyad.id);
    setPin(this.ground, inGround(dyad.fixed_pivot, view), dyad);
    return seen((low + high) / 2);
  }

  show(place) {
    const { dyad, view } = this, [nx, ny] = normalOf(dyad), [cx, cy] = dyad.fixed_pivot;
    put(this.block, "transform", transform(view.X(cx), view.Y(cy), place.a + Math.atan2(nx, -ny)));
  }
}

/** A link between joints: a bar, or a plate of three and more. */
class JointedLink {
  constructor({ links }, { joints, kind }) {
    this.joints = [...joints];
    this.strokes = [s("path", { class: "bm-bar" }), s("path", { class: "bm-core" })];
    links.append(s("g", { class: `bm-link bm-${kind}${joints.length > 2 ? " bm-ternary" : ""}`, "data-link": joints.replace("M", "") }, this.strokes));
  }

  shape(view) {
    this.view = view;
  }

  show(place) {
    const d = `M${this.joints.map((joint) => inGround(place.joints[joint] ?? [place.x, place.y], this.view).map(px).join(" ")).join("L")}${this.joints.length > 2 ? "Z" : ""}`;
    for (const stroke of this.strokes) put(stroke, "d", d);
  }
}

/** The pins of joints; the name of one that moves stands beyond the corner of a link. */
class Joints {
  constructor({ pins }, ground, names) {
    this.pins = [...Object.keys(ground), ...Object.keys(names)].map((joint) => {
      const pin = s("circle", { class: `bm-pin${joint in ground ? " bm-fixed-pin" : ""}`, r: 4.5, "data-joint": joint });
      return { joint, pin, link: [...(names[joint] ?? "")], name: joint in ground ? null : s("text", { class: "bm-name", "text-anchor": "middle" }, joint) };
    });
    pins.append(...this.pins.map(({ pin }) => pin), ...this.pins.flatMap(({ name }) => name ?? []));
  }

  shape(view) {
    this.view = view;
  }

  show({ joints }) {
    for (const { joint, pin, link, name } of this.pins) {
      const [x, y] = inGround(joints[joint], this.view);
      put(pin, "cx", px(x));
      put(pin, "cy", px(y));
      if (!name) continue;
      const [u, v] = outwards(link.map((each) => inGround(joints[each], this.view)), [x, y]);
      put(name, "x", px(x + NAME * u));
      put(name, "y", px(y + NAME * v + 4));
    }
  }
}

/** The direction from the middle of a plate to one of its corners; upwards where they are one point.
 * @param {number[][]} corners @param {number[]} corner */
function outwards(corners, [x, y]) {
  const middle = [0, 1].map((k) => corners.reduce((sum, corner) => sum + corner[k], 0) / corners.length);
  const u = x - middle[0], v = y - middle[1], size = Math.hypot(u, v);
  return size > 1 ? [u / size, v / size] : [0, -1];
}

/** PP: a body that only translates has no part of its own; nor has a crank between joints. */
class Nothing {
  shape() {}

  show() {}
}

const PARTS = { RR: Bar, PR: BlockOnRail, RP: Slot, PP: Nothing, crank: Nothing };
