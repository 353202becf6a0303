// Numbers in tables, and the short phrases that tables and cards share.

import { h } from "./dom.mjs";
import { clamp, fixed } from "./numbers.mjs";

const MOST_NAMES = 24; // points of a path that all have names in a drawing
const NAME_STEP = 5; // of longer paths the first has one, and then each fifth
const MOST_ROWS = 40; // of a long table; the others are folded
const NONE = "–"; // what stands where there is nothing

/** A table that scrolls sideways.  heads: names, or { name, text } for columns of words. */
export function table(caption, heads, rows, attributes) {
  return h(
    "div",
    { class: "bm-scroll", tabindex: "0", role: "region", "aria-label": caption },
    h(
      "table",
      attributes,
      h("caption", {}, caption),
      h("thead", {}, h("tr", {}, heads.map((head) => h("th", { scope: "col", class: head.text ? "bm-words" : null }, head.name ?? head)))),
      h("tbody", {}, rows),
    ),
  );
}

/** The same; of very many rows the last ones are folded. */
function longTable(caption, heads, rows, attributes) {
  const first = table(caption, heads, rows.slice(0, MOST_ROWS), attributes), others = rows.slice(MOST_ROWS);
  if (!others.length) return first;
  return h("div", { class: "bm-long" }, first, h("details", { class: "bm-every" }, h("summary", {}, `${others.length} more`), table(`${caption}, from ${MOST_ROWS + 1}`, heads, others, attributes)));
}

/** The cells of a row, the first one its head; words: columns of words; heads: for tables that stack. */
export const cells = (values, words = [], heads = []) =>
  values.map((value, k) =>
    k === 0
      ? h("th", { scope: "row" }, value)
      : h("td", { class: classes(words.includes(k) && "bm-words", (value ?? NONE) === NONE && "bm-none"), "data-head": heads[k]?.name ?? heads[k] }, value ?? NONE),
  );

const classes = (...names) => names.filter(Boolean).join(" ") || null;

const UNIT_NAMES = { in: "inches", ft: "feet" };

/** The unit of lengths after a caption. */
export const inUnit = (data) => (data.unit ? `, in ${UNIT_NAMES[data.unit] ?? data.unit}` : "");

/** The unit of lengths in brackets, for a head. */
const unitOf = (data) => (data.unit ? ` (${data.unit})` : "");

/** Decimals of a position: the last one is between a thousandth and a ten-thousandth of the scene. */
export const decimalsOf = (data) => clamp(4 - Math.ceil(Math.log10(data.scene)), 0, 12);

/** The number and the name of a pose, or its name alone where drawings have room for that. */
export const poseName = (pose) => (pose.label === pose.name ? pose.name : `${pose.label}: ${pose.name}`);

/** Whether a pose is a point of the body, whose angle is free. */
export const isPoint = (pose) => pose.angle_deg === null;

/** What the rows of a task are: points where no angle counts, else poses. */
export const nounOf = ({ poses, stop = undefined }) => stop ?? (poses.length && poses.every(isPoint) ? "point" : "pose");

/** Whether pose k has its name in a drawing: the points of a long path are close together. */
export const isNamed = ({ path, poses }, k) => !path || poses.length <= MOST_NAMES || k === 0 || (k + 1) % NAME_STEP === 0;

/** A pose as a sentence calls it: "pose 3", "point 4: lift". */
export const calledOf = (pose) => pose.called ?? `${isPoint(pose) ? "point" : "pose"} ${poseName(pose)}`;

/** A text cut to a number of characters. */
export const shortened = (text, most) => (text.length > most ? `${text.slice(0, most - 1).trimEnd()}…` : text);

/** A position error and an angle error in one phrase; shares of tolerances stand in brackets. */
export function missOf(position, angle, unit) {
  if (position === "-") return "–";
  const [away, ...share] = position.split(" (");
  const length = [away === "exact" ? away : `${away}${unit}`, ...share].join(" (");
  return angle === "free" || (position === "exact" && angle === "exact") ? length : `${length} and ${angle}`;
}

/** All dyads, with their misses; of a point alone a dyad misses nothing. */
export function dyadTable(data) {
  const misses = data.poses.some(isPoint) ? [] : ["rms miss", "worst miss"];
  const heads = ["", { name: "kind", text: true }, "on the ground (F)", "on the body (M)", `length${unitOf(data)}`, ...misses];
  const rows = data.dyads.map((dyad) =>
    h("tr", {}, cells([dyad.id, dyad.kind, dyad.said.ground, dyad.said.body, dyad.said.length, ...(misses.length ? [dyad.said.rms, dyad.said.worst] : [])], [1], heads)),
  );
  return longTable(data.dyads_title, heads, rows, { class: "bm-stacks" });
}

/** A table of words and numbers as the data have it: `words` are its columns of words, `lengths` whether its unit is told.
 * A cell of several texts has a line for each. */
export function worded(data, { caption, heads, words = [], rows, ...how }) {
  const named = heads.map((name, k) => (words.includes(k) ? { name, text: true } : name));
  const lines = (cell) => (Array.isArray(cell) ? cell.map((part) => h("span", { class: "bm-line-of" }, part)) : cell);
  const made = longTable(caption + (how.lengths ? inUnit(data) : ""), named, rows.map((row) => h("tr", {}, cells(row.map(lines), words, named))), { class: how.class });
  return how.folded ? h("details", { class: "bm-every" }, h("summary", {}, how.folded), made) : made;
}

function dimensionRows(linkage) {
  const uncertain = linkage.said.dimensions.some((row) => row.give);
  let last = null;
  return linkage.said.dimensions.map((row) => {
    const name = row.dyad === last ? "" : row.dyad;
    last = row.dyad;
    const side = linkage.led.findIndex((dyad) => dyad.id === row.dyad);
    return h(
      "tr",
      {},
      h("th", { scope: "row", class: name ? `bm-side${side}` : null }, name),
      h("td", { class: "bm-words" }, row.what),
      h("td", {}, row.value),
      uncertain ? h("td", {}, row.give) : null,
    );
  });
}

export function dimensionTable(data, linkage) {
  return table(
    `Dimensions of ${linkage.id}${inUnit(data)}`,
    ["", { name: "", text: true }, "value", ...(linkage.said.dimensions.some((row) => row.give) ? ["± (95 %)"] : [])],
    dimensionRows(linkage),
    { class: "bm-dimensions" },
  );
}

/** What to build a linkage from, in tables. */
export const numbersOf = (data, linkage) => linkage.tables?.map((each) => worded(data, each)) ?? [dimensionTable(data, linkage)];

/** The poses, and where a linkage takes the body; of points alone without what is asked of the angle. */
export function poseTable(data, linkage) {
  const digits = decimalsOf(data), unit = unitOf(data), noun = nounOf(data), turned = noun !== "point";
  const ifTurned = (value) => (turned ? [value] : []);
  const heads = [noun, `wanted x`, `y${unit}`, ...ifTurned("angle")];
  if (linkage) heads.push("body x", `y${unit}`, "angle", "off by", ...ifTurned("turned by"), ...(linkage.columns?.map(([head]) => head) ?? ["transm."]), { name: "where", text: true });
  const rows = data.poses.map((pose, k) => {
    const values = [
      poseName(pose) + (pose.exact ? " (exact)" : ""), fixed(pose.x, digits), fixed(pose.y, digits), ...ifTurned(isPoint(pose) ? "free" : `${fixed(pose.angle_deg, 2)}°`),
    ];
    if (linkage) {
      const row = linkage.pose_errors[k];
      values.push(
        fixed(row.x, digits), fixed(row.y, digits), row.angle_deg === null ? "–" : `${fixed(row.angle_deg, 2)}°`,
        row.said.position, ...ifTurned(row.said.turned), ...(linkage.columns?.map(([, texts]) => texts[k]) ?? [row.said.transmission]),
        row.way === null ? "–" : wayName(linkage.ways[row.way], linkage),
      );
    }
    return h("tr", { "data-pose": k + 1 }, cells(values, [heads.length - 1]));
  });
  const what = turned ? "Poses" : "Points";
  return table(linkage ? `${what}, and where ${linkage.id} takes the body` : what, heads, rows, { class: data.poses.some((pose) => pose.label !== pose.name) ? "bm-pose-table bm-named" : "bm-pose-table" });
}

/** The image points of the poses, Z3² + Z4² = 1, and the manifolds' eight coefficients; a point of the body has none. */
export function imageTables(data, linkage) {
  const digits = decimalsOf(data);
  const rows = data.poses.filter((pose) => !isPoint(pose)).map((pose) => {
    const c = Math.cos((pose.angle_deg * Math.PI) / 360), d = Math.sin((pose.angle_deg * Math.PI) / 360);
    const z = [(pose.x * d - pose.y * c) / 2, (pose.x * c + pose.y * d) / 2, d, c];
    return h("tr", {}, cells([pose.label, ...z.map((value, k) => fixed(value, k < 2 ? digits : 5))]));
  });
  const points = rows.length ? [table(`Image points of the poses${unitOf(data)}, Z3² + Z4² = 1`, ["pose", "Z1", "Z2", "Z3", "Z4"], rows)] : [];
  if (!linkage) return points;
  const surfaces = linkage.led.map((dyad, k) => h("tr", {}, cells([dyad.id, ...linkage.said.manifolds[k]])));
  const heads = ["", ...[1, 2, 3, 4, 5, 6, 7, 8].map((k) => `p${k}`)];
  const caption = "Surfaces: p1 (Z1² + Z2²) + p2 Z3² + p3 Z1 Z3 + p4 Z2 Z3 + p5 Z1 Z4 + p6 Z2 Z4 + p7 Z3 Z4 + p8 Z4² = 0";
  return [...points, table(caption, heads, surfaces)];
}

/** What is proved of an answer, and what is computed only; nothing where no proof was asked for. */
export function provedOf({ certificate }) {
  const rows = certificate ? [["Proved, of all digits, for the poses as given", certificate.proved], ["Computed, not proved", certificate.numerical]] : [];
  return rows.filter(([, lines]) => lines.length).map(([head, lines]) => h("div", { class: "bm-proved" }, h("b", {}, head), h("ul", {}, lines.map((line) => h("li", {}, line)))));
}

/** The name of a way: as short as it stays different from the others. */
export function wayName(way, linkage) {
  const circuits = new Set(linkage.ways.map((each) => each.circuit)).size;
  const parts = [];
  if (circuits > 1 || way.branches < 2) parts.push(`assembly ${way.circuit}`);
  if (way.branches > 1) parts.push(`branch ${way.branch}`);
  return parts.join(", ");
}
