// The outline of the body, and the regions that body and links have to keep out of.

import { s } from "./dom.mjs";
import { polyline, transform } from "./drawing.mjs";
import { act, placeAt } from "./kinematics.mjs";
import { px, radians } from "./numbers.mjs";
import { isPoint, shortened } from "./tables.mjs";

const HATCH = 9; // pixels between the lines of a hatch
const PALEST = 0.45; // how strong the outline is at the first pose, of its strength at the last
const LONGEST_NAME = 28; // characters of a region's name that the drawing has room for
const LEAST_LINKAGE = 110; // pixels: outlines leave the linkage as large as that, unless all of them is asked for

const MOST_PLACES = 400; // of the motion whose outlines the picture is made to hold; its margin holds those between

let patterns = 0; // ids of hatches are unique on the page

/** A closed path through points (x, y) of the plane or of M, in pixels from its origin. */
const closed = (points, view, [x, y]) => `M${points.map((each) => `${px(x + view.scale * each[0])} ${px(y - view.scale * each[1])}`).join("L")}Z`;

/** The outline of the body as a path, in pixels from the origin of M. */
export const bodyOutline = (data, view) => closed(data.body, view, [0, 0]);

/** Where the body is at every pose k: the place that a linkage takes for it, or else the pose itself, if it has an angle. */
const placesAtPoses = (data, linkage) =>
  data.poses.flatMap((pose, k) => {
    const row = linkage?.pose_errors[k], at = row && row.x !== null ? row : pose;
    return isPoint(at) ? [] : [{ x: at.x, y: at.y, a: radians(at.angle_deg), k }];
  });

/** The body at every pose, the paler the earlier. */
export function ghosts(data, linkage, view) {
  const group = s("g", { class: "bm-ghosts" });
  if (!data.body) {
    for (const row of linkage?.drawn ? linkage.pose_errors : []) group.append(plate(placeAt(linkage, linkage.ways[row.way], row.frame, data.chart.length), linkage, view));
    return group;
  }
  const last = Math.max(1, data.poses.length - 1);
  for (const { x, y, a, k } of placesAtPoses(data, linkage)) {
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

/** Corners of the body in the plane, at the poses and at some of the places. */
function bodyCorners(data, linkage, places) {
  if (!data.body) return [];
  const some = places.filter((_, k) => k % Math.ceil(places.length / MOST_PLACES) === 0);
  return [...placesAtPoses(data, linkage), ...some].flatMap((place) => data.body.map((corner) => act(place, corner)));
}

const sizeOf = ([x, y, u, v]) => Math.max(u - x, v - y);

/** A box, [x low, y low, x high, y high], that holds points, too. */
const including = (box, points) =>
  points.reduce(([x, y, u, v], [a, b]) => [Math.min(x, a), Math.min(y, b), Math.max(u, a), Math.max(v, b)], box);

/** The box of the picture that holds the outlines, too: all of them, or as far as the linkage stays large.
 *
 * Where not all has room, the body goes before the regions.
 * box: of what else there is; width: of the picture, in pixels.
 */
export function widened(box, data, linkage, places, width, all) {
  const withBody = including(box, bodyCorners(data, linkage, places));
  const whole = including(withBody, data.keep_out.flatMap((region) => region.outline));
  const most = Math.max(2, width / LEAST_LINKAGE) * sizeOf(box);
  if (all || !linkage || sizeOf(whole) <= most) return whole;
  const inner = sizeOf(withBody) <= most ? withBody : box, reach = (most - sizeOf(inner)) / 2;
  return whole.map((each, k) => (k < 2 ? Math.max(each, inner[k] - reach) : Math.min(each, inner[k] + reach)));
}
