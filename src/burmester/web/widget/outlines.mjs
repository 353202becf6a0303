// The outline of the body, and the regions that body and links have to keep out of.

import { s } from "./dom.mjs";
import { polyline, transform } from "./drawing.mjs";
import { placesAtPoses } from "./framing.mjs";
import { placeAt } from "./kinematics.mjs";
import { px } from "./numbers.mjs";
import { shortened } from "./tables.mjs";

const HATCH = 9; // pixels between the lines of a hatch
const PALEST = 0.45; // how strong the outline is at the first pose, of its strength at the last
const LONGEST_NAME = 28; // characters of a region's name that the drawing has room for
const MANY_GHOSTS = 6; // of more poses the first and the last one have theirs

let patterns = 0; // ids of hatches are unique on the page

/** A closed path through points (x, y) of the plane or of M, in pixels from its origin. */
const closed = (points, view, [x, y]) => `M${points.map((each) => `${px(x + view.scale * each[0])} ${px(y - view.scale * each[1])}`).join("L")}Z`;

/** The outline of the body as a path, in pixels from the origin of M. */
export const bodyOutline = (data, view) => closed(data.body, view, [0, 0]);

/** Whether the body is drawn at pose k of so many: of many only at the first and the last one. */
export const hasGhost = (k, count) => count <= MANY_GHOSTS || k === 0 || k === count - 1;

/** The body at the poses, the paler the earlier. */
export function ghosts(data, linkage, view) {
  const group = s("g", { class: "bm-ghosts" });
  if (!data.body) {
    for (const row of linkage?.drawn ? linkage.pose_errors.filter((_, k) => hasGhost(k, linkage.pose_errors.length)) : []) group.append(plate(placeAt(linkage, linkage.ways[row.way], row.frame, data.chart.length), linkage, view));
    return group;
  }
  const last = Math.max(1, data.poses.length - 1);
  for (const { x, y, a, k } of placesAtPoses(data, linkage).filter((place) => !linkage || hasGhost(place.k, data.poses.length))) {
    const opacity = (PALEST + ((1 - PALEST) * k) / last).toFixed(3);
    group.append(s("path", { class: "bm-ghost", d: bodyOutline(data, view), "data-pose": k + 1, opacity, transform: transform(view.X(x), view.Y(y), a) }));
  }
  return group;
}

/** The body by its joints, and by its origin where that is a corner. */
const plate = (place, { drawn }, view) =>
  s("path", { class: "bm-ghost", d: `${polyline([...drawn.find(({ kind }) => kind === "carried").joints].map((joint) => place.joints[joint] ?? [place.x, place.y]), view)}Z` });

/** The regions to keep out of, hatched, with their names. */
export function keepOut(data, view) {
  const group = s("g", { class: "bm-keep-out" });
  if (!data.keep_out.length) return group;
  const id = `bm-hatch-${(patterns += 1)}`;
  group.append(
    s(
      "defs",
      {},
      s(
        "pattern",
        { id, width: HATCH, height: HATCH, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
        s("path", { class: "bm-hatch", d: `M0 0V${HATCH}` }),
      ),
    ),
  );
  for (const region of data.keep_out) {
    const d = closed(region.outline, view, [view.left, view.top]);
    group.append(s("g", { class: "bm-region" }, s("title", {}, region.name || "keep out"), s("path", { class: "bm-region-plain", d }), s("path", { class: "bm-region-edge", d, fill: `url(#${id})` })));
  }
  return group;
}

/** The names of the regions, each at a point inside; their places are kept free of other labels. */
export function keepOutNames(data, view, labels) {
  return data.keep_out.filter(({ name }) => name).map(({ name, at: [x, y] }) => {
    const text = shortened(name, LONGEST_NAME);
    labels.block(view.X(x), view.Y(y), 7.2 * text.length, 14);
    return s("text", { class: "bm-region-name", x: px(view.X(x)), y: px(view.Y(y) + 4), "text-anchor": "middle" }, text);
  });
}
