// What the page says of the chosen linkage: in sentences, in facts, and in the key of its drawing.

import { h, s } from "./dom.mjs";
import { axes } from "./drawing.mjs";
import { roundPath, springPath } from "./load_marks.mjs";
import { runs } from "./numbers.mjs";
import { isPoint, nounOf } from "./tables.mjs";

/** The poses of a way and how it ends, behind its name. */
export function wayStory(way, poses) {
  const noun = nounOf({ poses }), names = poses.map((pose) => pose.label);
  const all = way.poses.length === names.length;
  const here = all ? `all ${noun}s` : way.poses.length ? `${noun}${way.poses.length > 1 ? "s" : ""} ${runs(way.poses, names)}` : `no ${noun}`;
  const dead = way.dead.filter(Boolean).length;
  const ends = way.round ? "turns round" : dead === 2 ? "between two dead points" : dead ? "up to a dead point" : "open";
  return `${here}; ${ends}`;
}

/** Facts of a linkage: rows of a name and a text. */
export const factsOf = ({ said }) => h("dl", { class: "bm-facts" }, said.facts.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));

/** What image space shows. */
export function spaceStory(data, linkage) {
  const some = data.poses.some(isPoint), every = nounOf(data) === "point";
  const taken = some && linkage ? `the places that ${linkage.id} takes at ${every ? "the" : "its"} points` : "";
  const marked = [every ? "" : "the poses", taken].filter(Boolean).join(" and ");
  const plain = `Every place of the body is one point of this space${marked ? `; numbered points are ${marked}` : ""}.`;
  if (!linkage) return [plain];
  const surface = (side) => h("b", { class: `bm-side${side}` }, linkage.led[side].id);
  return [plain, " The surfaces are all places that dyad ", surface(0), " (driver) and dyad ", surface(1), " (follower) allow; where they meet, the line, the coupler moves."];
}

/** The lines of the plot, and what they mean; of several loops. */
export function loopKey({ loops = [] }) {
  const one = (text, k) => h("li", {}, s("svg", { width: 34, height: 12, viewBox: "0 -6 34 12", "aria-hidden": "true", class: "bm-key" }, s("path", { class: `bm-line bm-loop${k}`, d: "M0 0H32" })), text);
  return loops.length ? h("ul", { class: "bm-keys" }, loops.map(one)) : null;
}

/** The signs of the drawing, and what they mean. */
export function keyOf(data, hasLinkages) {
  const one = (sign, text) => h("li", {}, s("svg", { width: 34, height: 20, viewBox: "-4 -13 34 20", "aria-hidden": "true", class: "bm-key" }, sign), text);
  const link = (kind) => s("g", { class: `bm-link bm-${kind}` }, s("path", { class: "bm-bar", d: "M0 -3H22" }), s("path", { class: "bm-core", d: "M0 -3H22" }));
  const posed = data.poses.some((pose) => !isPoint(pose)) || !data.poses.length, some = data.poses.some(isPoint);
  const frame = (name, axis, r, text) => (posed ? [one(s("g", { class: name }, s("path", { d: axes(axis) }), s("circle", { r })), text)] : []);
  const dot = (name, r, text) => (some ? [one(s("g", { class: name }, s("circle", { cx: 11, cy: -3, r })), text)] : []);
  if (data.stop) return h("ul", { class: "bm-keys" }, data.keys.map(([kind, text]) => one(link(kind), text)));
  const items = [...frame("bm-wanted", 22, 4, "wanted pose"), ...dot("bm-wanted", 4, "wanted point")];
  if (data.path) items.push(one(s("path", { class: "bm-wanted-path", d: "M-2 2C6 -16 18 -10 28 -4" }), "wanted path"));
  if (hasLinkages) {
    items.push(
      ...frame("bm-achieved", 17, 2.2, "achieved pose"),
      ...dot("bm-achieved", 2.2, "achieved point"),
      one(s("g", { class: "bm-errors" }, s("path", { d: "M0 0L22 -6L15 -7.5M22 -6L17 -0.8" })), "error, enlarged"),
      ...data.keys.map(([kind, text]) => one(link(kind), text)),
      one(s("path", { class: "bm-curve bm-here", d: "M-2 2C6 -16 18 -10 28 -4" }), "path of the origin of M"),
    );
  }
  const { springs = [], hand = null } = data.loads ?? {};
  const round = ["torsion", "counterweight"], straight = springs.filter(({ kind }) => !round.includes(kind));
  if (straight.length) items.push(one(s("path", { class: "bm-spring", d: straight[0].kind === "gas" || straight[0].kind === "constant" ? springPath(straight[0].kind, [-2, -3], [28, -3]) : "M-2 -3H2L5 -9L9 3L13 -9L17 3L21 -9L24 -3H28" }), straight.length > 1 ? "springs" : `${straight[0].kind} spring`));
  for (const kind of round.filter((each) => springs.some((spring) => spring.kind === each))) items.push(one(s("path", { class: "bm-spring", d: roundPath(kind, [11, -3]) }), kind === "torsion" ? "torsion spring" : kind));
  if (hand && hasLinkages) items.push(one(s("path", { class: "bm-hand", d: "M0 -3H22M15 -7L22 -3L15 1" }), "push of the hand"));
  const box = "M-2 6H26V-10H-2Z";
  if (data.body || data.linkages[0]?.drawn) items.push(one(s("path", { class: "bm-ghost", d: "M-2 5L22 7L26 -1L4 -9Z" }), "body at the poses"));
  if (data.keep_out.length) items.push(one(s("g", {}, s("path", { class: "bm-region-edge", d: box, fill: "none" }), s("path", { class: "bm-hatch", d: "M-2 1L9 -10M2 6L18 -10M12 6L26 -8" })), "keep out"));
  return h("ul", { class: "bm-keys" }, items);
}
