// Regions of limits: how far a point is from one, and outlines that meet.

/** @typedef {number[]} Point */
/** @type {(p: Point, q: Point) => number} */
const cross = ([a, b], [c, d]) => a * d - b * c;
/** @type {(p: Point, q: Point) => Point} */
const minus = ([a, b], [c, d]) => [a - c, b - d];
/** @type {(p: Point) => number} */
const size = ([a, b]) => Math.hypot(a, b);

/** How far a point is from a segment. */
function fromSegment(point, start, end) {
  const along = minus(end, start), away = minus(point, start), square = along[0] ** 2 + along[1] ** 2;
  const share = square > 0 ? Math.min(1, Math.max(0, (along[0] * away[0] + along[1] * away[1]) / square)) : 0;
  return size(minus(away, [share * along[0], share * along[1]]));
}

/** The four corners of a box with two opposite ones. */
export const boxCorners = ([[a, b], [c, d]]) => [[a, b], [c, b], [c, d], [a, d]];

/** The corners that a shape draws: a box has four. */
export const outlineOf = (shape, points) => (shape === "box" ? boxCorners(points) : points);

/** Whether a point is inside a polygon. */
export function isInside([x, y], corners) {
  let inside = false;
  corners.forEach(([a, b], k) => {
    const [c, d] = corners[(k + 1) % corners.length];
    if (b > y !== d > y && x < a + ((y - b) / (d - b)) * (c - a)) inside = !inside;
  });
  return inside;
}

/** How far a point is from a region; 0 in it. */
export function distanceTo(point, shape, points) {
  if (shape === "point") return size(minus(point, points[0]));
  if (shape === "segment") return fromSegment(point, ...points);
  if (shape === "line") {
    const along = minus(points[1], points[0]);
    return Math.abs(cross(along, minus(point, points[0]))) / size(along);
  }
  const corners = outlineOf(shape, points);
  if (isInside(point, corners)) return 0;
  return Math.min(...corners.map((corner, k) => fromSegment(point, corner, corners[(k + 1) % corners.length])));
}

const crosses = (a, b, c, d) => {
  const turn = (p, q, r) => Math.sign(cross(minus(q, p), minus(r, p)));
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
};

const edges = (corners) => corners.map((corner, k) => [corner, corners[(k + 1) % corners.length]]);

/** Whether two polygons overlap. */
export function overlap(one, other) {
  if (isInside(one[0], other) || isInside(other[0], one)) return true;
  return edges(one).some(([a, b]) => edges(other).some(([c, d]) => crosses(a, b, c, d)));
}

/** How near a segment comes to a polygon; 0 where it enters. */
export function segmentFromPolygon([start, end], corners) {
  if (isInside(start, corners) || edges(corners).some(([c, d]) => crosses(start, end, c, d))) return 0;
  return Math.min(
    ...edges(corners).map(([c, d]) => Math.min(fromSegment(start, c, d), fromSegment(end, c, d), fromSegment(c, start, end), fromSegment(d, start, end))),
  );
}
