// The moving parts of a six-bar: links of two and of three joints, the body, pins and their names.
//
// Links are drawn between the joints where these are; the body, with its outline, where its frame is.

import { put, s } from "./dom.mjs";
import { AXIS, axes, transform } from "./drawing.mjs";
import { TURNING_ARROW } from "./mechanism.mjs";
import { px } from "./numbers.mjs";
import { bodyOutline } from "./outlines.mjs";

const NAME = 15; // pixels: how far the name of a joint stands from it
const BODY_AXIS = AXIS + 10; // pixels: the x axis of the body

/** How a link is drawn: the driver filled, another crank hollow, in grey those between; the body is grey and filled. */
function kindOf({ name, pin }, { driver, carries, ground }) {
  if (name === carries) return "bm-carried";
  return pin in ground ? `bm-side${name === driver ? 0 : 1}` : "bm-inner";
}

/** The link beyond which the name of a joint stands: the first one of three joints, else one that is not the body. */
function namedOn(joint, { links, carries }) {
  const own = links.filter(({ joints }) => joint in joints), others = own.filter(({ name }) => name !== carries);
  return others.find(({ joints }) => Object.keys(joints).length > 2) ?? others[0] ?? own[0];
}

export class SixBarMechanism {
  constructor(data, linkage, view) {
    this.view = view;
    // From the lowest to the topmost: links of three joints, those of two, the body.
    const height = ({ name, outline }) => (name === linkage.carries ? 2 : outline.length > 2 ? 0 : 1);
    this.links = [...linkage.links].sort((a, b) => height(a) - height(b)).map((link) => {
      const strokes = [s("path", { class: "bm-bar" }), s("path", { class: "bm-core" })];
      const group = s("g", { class: `bm-link ${kindOf(link, linkage)}${link.outline.length > 2 ? " bm-ternary" : ""}`, "data-link": link.outline.replace("M", "") }, strokes);
      return { joints: link.outline, strokes, group };
    });
    this.outline = data.body ? s("path", { class: "bm-body-outline", d: bodyOutline(data, view) }) : null;
    this.frame = s("g", { class: "bm-coupler" }, s("path", { class: "bm-body-frame", d: axes(BODY_AXIS) }), s("circle", { class: "bm-origin", r: 4 }));
    this.pins = Object.keys(linkage.pose_errors[0].joints).map((joint) => {
      const fixed = joint in linkage.ground, on = fixed ? null : Object.keys(namedOn(joint, linkage).joints);
      const pin = s("circle", { class: `bm-pin${fixed ? " bm-fixed-pin" : ""}`, r: 4.5, "data-joint": joint });
      return { joint, on, pin, name: fixed ? null : s("text", { class: "bm-name", "text-anchor": "middle" }, joint) };
    });
    const pivot = linkage.led[0].fixed_pivot;
    this.group = s(
      "g",
      { class: "bm-linkage bm-six-bar" },
      this.outline,
      s("path", { class: "bm-drive-mark bm-side0", d: TURNING_ARROW, transform: `translate(${px(view.X(pivot[0]))} ${px(view.Y(pivot[1]))}) rotate(-90)` }),
      this.links.map((each) => each.group),
      this.frame,
      this.pins.map((each) => each.pin),
      this.pins.map((each) => each.name),
    );
  }

  show(place) {
    const { view } = this, at = {};
    for (const [joint, [x, y]] of Object.entries({ ...place.joints, M: [place.x, place.y] })) at[joint] = [view.X(x), view.Y(y)];
    for (const { joints, strokes } of this.links) {
      const d = `M${[...joints].map((joint) => at[joint].map(px).join(" ")).join("L")}${joints.length > 2 ? "Z" : ""}`;
      for (const stroke of strokes) put(stroke, "d", d);
    }
    const seen = transform(...at.M, place.a);
    put(this.frame, "transform", seen);
    if (this.outline) put(this.outline, "transform", seen);
    for (const { joint, on, pin, name } of this.pins) {
      const [x, y] = at[joint];
      put(pin, "cx", px(x));
      put(pin, "cy", px(y));
      if (!name) continue;
      const [u, v] = outwards(on.map((each) => at[each]), at[joint]);
      put(name, "x", px(x + NAME * u));
      put(name, "y", px(y + NAME * v + 4));
    }
  }
}

/** The direction from the middle of a plate to one of its corners; upwards where they are one point. */
function outwards(corners, [x, y]) {
  const middle = [0, 1].map((k) => corners.reduce((sum, corner) => sum + corner[k], 0) / corners.length);
  const u = x - middle[0], v = y - middle[1], size = Math.hypot(u, v);
  return size > 1 ? [u / size, v / size] : [0, -1];
}
