// Cards, tables and facts of six-bars, and the key of their drawing.

import { CardList } from "./cards.mjs";
import { h, s } from "./dom.mjs";
import { axes } from "./drawing.mjs";
import { fixed } from "./numbers.mjs";
import { cells, decimalsOf, inUnit, poseName, table } from "./tables.mjs";

export class SixBarCards extends CardList {
  constructor(linkages, choose) {
    super(linkages.map((each, k) => card(each, () => choose(k))));
  }
}

const verdictOf = (linkage) => (!linkage.usable ? "✕ does not work" : linkage.sound ? "✓ works, sound" : "✓ works");

function card(linkage, onclick) {
  const { said } = linkage, [, driver, turn] = said.row, lacks = said.shortcomings.length ? `It ${said.shortcomings.join("; ")}` : null;
  const fact = (name, value, kind = null) => [h("dt", { class: kind }, name), h("dd", { class: kind }, value)];
  return h(
    "button",
    { type: "button", class: `bm-choice ${linkage.usable ? "bm-good" : "bm-bad"}`, "aria-pressed": "false", "data-linkage": linkage.id, onclick },
    h("span", { class: "bm-choice-head" }, h("b", {}, linkage.id), " ", h("span", { class: "bm-type" }, linkage.type)),
    h("span", { class: "bm-verdict" }, verdictOf(linkage)),
    h(
      "dl",
      {},
      fact("driver", `${driver}${linkage.turns_fully ? ", turns fully" : `, by ${turn}`}`),
      fact("transmission", `${said.transmission} or more`),
      fact("extent", said.extent),
      fact("link ratio", said.link_ratio, "bm-detail"),
    ),
    said.why_not || lacks ? h("span", { class: "bm-reason" }, said.why_not ?? lacks) : null,
  );
}

/** All six-bars with their figures. */
export function sixBarTable(data) {
  const heads = ["", { name: "driver", text: true }, ...data.heads.slice(2), { name: "falls short", text: true }];
  const rows = data.linkages.map(({ said }) => h("tr", {}, cells([...said.row, said.shortcomings.join("; ") || "–"], [1, heads.length - 1], heads)));
  return table("All six-bars, best first", heads, rows, { class: "bm-linkages bm-stacks" });
}

const lines = (parts) => parts.map((part) => h("span", { class: "bm-line-of" }, part));

/** What to build a six-bar from: the joints of each link in its own frame, or its length. */
export function sixBarDimensions(data, { id, said }) {
  const rows = said.dimensions.map(([link, ...joints]) => h("tr", {}, cells([link, lines(joints.filter(Boolean))])));
  return table(`Dimensions of ${id}${inUnit(data)}`, [{ name: "link", text: true }, "joints, or length"], rows, { class: "bm-dimensions bm-joints" });
}

/** The distances between the joints of one link, to measure and to check. */
export function sixBarDistances(data, { id, said }) {
  const caption = `Distances between joints of ${id}${inUnit(data)}`;
  const rows = said.distances.map((row) => h("tr", {}, cells(row)));
  return h("details", { class: "bm-every" }, h("summary", {}, "Distances between joints"), table(caption, [{ name: "joints", text: true }, "distance"], rows));
}

/** The figures of a six-bar, under the heads of the table of all. */
export function sixBarFacts(data, { said }) {
  const rows = [...data.heads.slice(1).map((head, k) => [head, said.row[k + 1]]), ["at the poses", said.met ?? "exact, up to rounding"]];
  return h("dl", { class: "bm-facts" }, rows.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
}

/** The poses, and driver and transmission angles there. */
export function sixBarPoses(data, linkage) {
  const digits = decimalsOf(data), unit = data.unit ? ` (${data.unit})` : "";
  const missed = linkage?.said.errors;
  const heads = ["pose", "x", `y${unit}`, "angle", ...(missed ? ["off by", "turned by"] : []), ...(linkage ? [`driver ${linkage.crank}`, ...loopTips(linkage).map((tip, k) => `${k ? "" : "transm. "}at ${tip}`)] : [])];
  const rows = data.poses.map((pose, k) => {
    const values = [poseName(pose), fixed(pose.x, digits), fixed(pose.y, digits), `${fixed(pose.angle_deg, 2)}°`];
    if (missed) values.push(...missed[k]);
    if (linkage) {
      const row = linkage.pose_errors[k];
      values.push(...[row.drive_deg, ...row.loops].map((angle) => `${fixed(angle, 1)}°`));
    }
    return h("tr", { "data-pose": k + 1 }, cells(values));
  });
  const named = data.poses.some((pose) => pose.label !== pose.name);
  return table(linkage ? `Poses, and how ${linkage.id} stands there` : "Poses", heads, rows, { class: named ? "bm-pose-table bm-named" : "bm-pose-table" });
}

/** The joints at which links transmit, the first loop's first. */
export const loopTips = (linkage) => linkage.legs.map((legs) => [...new Set(legs.map(([, tip]) => tip))].join(", "));

/** The links between cranks and body, by their names and joints. */
function between(linkages) {
  const inner = linkages[0].links.filter(({ name, pin }) => !(pin in linkages[0].ground) && name !== linkages[0].carries);
  const same = linkages.every(({ type, carries }) => type === linkages[0].type && carries === linkages[0].carries);
  return same ? inner.map(({ name, joints }) => [...new Set([name, Object.keys(joints).join("")])].join(" ")).join(" and ") : "links between";
}

/** The signs of the drawing, and what they mean. */
export function sixBarKey(data) {
  const hasLinkages = data.linkages.length > 0;
  const one = (sign, text) => h("li", {}, s("svg", { width: 34, height: 20, viewBox: "-4 -13 34 20", "aria-hidden": "true", class: "bm-key" }, sign), text);
  const link = (kind) => s("g", { class: `bm-link ${kind}` }, s("path", { class: "bm-bar", d: "M0 -3H22" }), s("path", { class: "bm-core", d: "M0 -3H22" }));
  const items = [one(s("g", { class: "bm-wanted" }, s("path", { d: axes(22) }), s("circle", { r: 4 })), "wanted pose")];
  if (hasLinkages) {
    items.push(
      one(link("bm-side0"), "driver (filled)"),
      one(link("bm-side1"), data.linkages[0].led.length > 2 ? "other cranks (hollow)" : "other crank (hollow)"),
      one(link("bm-inner"), between(data.linkages)),
      one(link("bm-carried"), "body, with its frame M"),
      one(s("path", { class: "bm-curve bm-here", d: "M-2 2C6 -16 18 -10 28 -4" }), "path of the origin of M"),
    );
  }
  if (data.body || hasLinkages) items.push(one(s("path", { class: "bm-ghost", d: "M-2 5L22 7L26 -1L4 -9Z" }), "body at the poses"));
  return h("ul", { class: "bm-keys" }, items);
}

/** The lines of the plot, and what they mean. */
export function loopKey(linkage) {
  const one = (k, text) => h("li", {}, s("svg", { width: 34, height: 12, viewBox: "0 -6 34 12", "aria-hidden": "true", class: "bm-key" }, s("path", { class: `bm-line bm-loop${k}`, d: "M0 0H32" })), text);
  const tips = loopTips(linkage), of = tips.length > 1 ? ["first loop, ", "second loop, "] : ["the least, "];
  return h("ul", { class: "bm-keys" }, tips.map((tip, k) => one(k, `${of[k]}at ${tip}`)));
}
