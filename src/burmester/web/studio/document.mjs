// Changes of a task: functions from a document to a document.  A document has the keys of a task file;
// it is never changed in place, so that history keeps what was, and what did not change is the same object.

/** A copy of an object with some keys changed; a key whose value is undefined is left out.
 * @param {object} object @param {object} changes */
export function withKeys(object, changes) {
  const copy = { ...object, ...changes };
  for (const [key, value] of Object.entries(changes)) if (value === undefined) delete copy[key];
  return copy;
}

const replaced = (list, index, value) => list.map((each, k) => (k === index ? value : each));
const without = (list, index) => list.filter((_, k) => k !== index);
const inserted = (list, index, value) => [...list.slice(0, index), value, ...list.slice(index)];

/** A list under a key, or no key where the list is empty. */
const withList = (document, key, list) => withKeys(document, { [key]: list.length ? list : undefined });

/** The keys of a table, or no table where none is left. */
const filled = (table) => (Object.keys(table).length ? table : undefined);

// Points are poses whose angle is free; points alone, with a path or too many to be met exactly, are a path

const EXACT = { x: 0, y: 0, angle_deg: 0 }; // the tolerance of what states none, where something is free
const FEWEST_TRACED = 10; // points without angles that are a path in any case

/** Whether a component of a pose counts for nothing. */
export const isFree = (pose, key) => Boolean(pose?.free?.includes(key)) || pose?.tolerance?.[key] === "free";

export const isPoint = (pose) => isFree(pose, "angle");

/** Whether the task is points alone. */
export const isOfPoints = ({ poses }) => poses.length > 0 && poses.every(isPoint);

/** Whether the task is a path: points that are traced one after the other, and may be missed. */
export const isPath = (document) => isOfPoints(document) && (document.path !== undefined || document.poses.length >= FEWEST_TRACED);

/** Some keys of the path; undefined takes a key away. */
export const setPath = (document, changes) => withKeys(document, { path: withKeys(document.path ?? { closed: false }, changes) });

/** The tolerance of all points: key is x or y. */
export const setUsual = (document, key, value) => withKeys(document, { tolerance: { ...EXACT, ...document.tolerance, [key]: value ?? 0 } });

/** A task of points alone: those of a path are as near as possible, as long as no tolerance is stated. */
export const pathDocument = (document, points, closed) =>
  withKeys(document, {
    poses: points.map(([x, y]) => ({ x, y, free: ["angle"] })), path: { closed },
    tolerance: isOfPoints(document) ? document.tolerance ?? EXACT : EXACT,
  });

const isExact = (tolerance) => tolerance && ["x", "y", "angle_deg"].every((key) => !tolerance[key]);

/** What is free needs a tolerance beside it, and a path points alone. */
function settled(document) {
  const { poses, path, tolerance } = document, some = poses.some((pose) => pose.free?.length);
  return withKeys(document, {
    path: path && poses.length && !poses.every(isPoint) ? undefined : path,
    tolerance: some ? tolerance ?? EXACT : isExact(tolerance) ? undefined : tolerance,
  });
}

/** Crank angles go with their points: `change` of the list, where there is one. */
const withCrank = (document, change) => (document.path?.crank_deg ? setPath(document, { crank_deg: change(document.path.crank_deg) }) : document);

/** The crank angle of a point put among others: between its neighbours, or a step on. */
function betweenCranks(angles, index) {
  const [a, b] = [angles[index - 1], angles[index]];
  if (a !== undefined && b !== undefined) return (a + b) / 2;
  return a === undefined ? (b ?? 0) - 10 : a + (a - (angles[index - 2] ?? a - 10));
}

// Poses

/** Some keys of a pose changed, counted from 0; undefined takes a key away. */
export const setPose = (document, index, changes) =>
  withKeys(document, { poses: replaced(document.poses, index, withKeys(document.poses[index], changes)) });

export const addPose = (document, pose, index = document.poses.length) =>
  settled(withCrank(withKeys(document, { poses: inserted(document.poses, index, pose) }), (angles) => inserted(angles, index, betweenCranks(angles, index))));

export const removePose = (document, index) =>
  settled(withCrank(withKeys(document, { poses: without(document.poses, index) }), (angles) => without(angles, index)));

/** Several poses taken away at once. */
export const removePoses = (document, indices) => [...indices].sort((a, b) => b - a).reduce(removePose, document);

/** The angle of a pose; none makes it a point, whose angle is free. */
export function setAngle(document, index, angle) {
  const free = angle === undefined, same = isPoint(document.poses[index]) === free;
  return setPose(same ? document : setFree(document, index, "angle", free), index, { angle });
}

/** How far the crank has turned at a point. */
export const setCrank = (document, index, angle) => withCrank(document, (angles) => replaced(angles, index, angle));

/** A copy of a pose behind it, without its name, which is that pose's alone. */
export const duplicatePose = (document, index) => addPose(document, withKeys(document.poses[index], { name: undefined }), index + 1);

/** A pose at another place in the order. */
export function movePose(document, from, to) {
  const moved = (list) => inserted(without(list, from), to, list[from]);
  return withCrank(withKeys(document, { poses: moved(document.poses) }), moved);
}

/** A component of a pose (x, y or angle) that counts, or does not. */
export function setFree(document, index, component, free) {
  const pose = document.poses[index], others = (pose.free ?? []).filter((each) => each !== component);
  const list = free ? [...others, component] : others;
  const { [component]: _, [component === "angle" ? "angle_deg" : component]: bound, ...bounds } = pose.tolerance ?? {}; // a bound of what is free says nothing
  return settled(setPose(document, index, { free: list.length ? list : undefined, tolerance: free || pose.tolerance?.[component] === "free" ? filled(bounds) : pose.tolerance }));
}

/** A bound of a pose's tolerance: key is x, y or angle_deg; undefined takes it away. */
export const setTolerance = (document, index, key, bound) =>
  setPose(document, index, { tolerance: filled(withKeys(document.poses[index].tolerance ?? {}, { [key]: bound })) });

// The body, and what it must not touch

/** The corners of the body in M; an empty list takes the body away. */
export const setBody = (document, corners) => withList(document, "body", corners);

/** The corners of the body, where they are stated in numbers. */
export const bodyOf = (document) => (Array.isArray(document.body) ? document.body : []);

/** The regions to keep out of, as a list: a file may hold a single table. */
export const regionsOf = (document) => (document.keep_out === undefined ? [] : [document.keep_out].flat());

export const addRegion = (document, region) => withList(document, "keep_out", [...regionsOf(document), region]);
export const setRegion = (document, index, changes) =>
  withList(document, "keep_out", replaced(regionsOf(document), index, withKeys(regionsOf(document)[index], changes)));
export const removeRegion = (document, index) => withList(document, "keep_out", without(regionsOf(document), index));

/** A key of the table of surroundings: link_width, margin, body_in_plane. */
export const setSurrounding = (document, key, value) =>
  withKeys(document, { surroundings: filled(withKeys(document.surroundings ?? {}, { [key]: value })) });

// Limits: one table for both dyads, or a list of two

/** The tables of limits, none to two. */
export const limitsOf = (document) => (document.limits === undefined ? [] : [document.limits].flat());

/** The regions of a table of limits by their keys: of pivots, and of the parts of a rail and of a slot. */
export const LIMIT_KEYS = ["fixed_pivot", "moving_pivot", "rail through", "rail travel", "slot through", "slot travel"];

/** The keys of those that belong to the body. */
export const isOnBody = (key) => key === "moving_pivot" || key.startsWith("slot");

/** A part of a table of limits by its key, such as "rail through". */
export const limitPart = (table, key) => key.split(" ").reduce((part, name) => part?.[name], table);

/** A table of limits with some parts changed, by their keys. */
const withParts = (table, changes) =>
  Object.entries(changes).reduce((now, [key, value]) => {
    const [name, part] = key.split(" ");
    return withKeys(now, { [name]: part ? filled(withKeys(now[name] ?? {}, { [part]: value })) : value });
  }, table);

/** Some keys of a table of limits; a table that is left empty stays where there are two. */
export function setLimit(document, index, changes) {
  const tables = limitsOf(document), changed = withParts(tables[index] ?? {}, changes);
  const all = index < tables.length ? replaced(tables, index, changed) : [...tables, changed];
  const kept = all.length > 1 || filled(changed) ? all : [];
  return withKeys(document, { limits: kept.length > 1 ? kept : kept[0] });
}

/** One table for both dyads, or the first one twice, one for each. */
export function splitLimits(document, apart) {
  const tables = limitsOf(document);
  if (!apart) return withKeys(document, { limits: tables[0] && filled(tables[0]) });
  return tables.length > 1 ? document : withKeys(document, { limits: [tables[0] ?? {}, tables[0] ?? {}] });
}

/** Every region that limits draw in the plane: { table, key, shape, points } each, in order. */
export const limitRegions = (document) =>
  limitsOf(document).flatMap((table, index) =>
    LIMIT_KEYS.filter((key) => limitPart(table, key)).map((key) => {
      const [[shape, points]] = Object.entries(limitPart(table, key));
      return { table: index, key, shape, points: shape === "point" ? [points] : points };
    }),
  );

/** A shape with these points, as the keys of a file have it. */
export const shapeOf = (shape, points) => ({ [shape]: shape === "point" ? points[0] : points });

/** A requirement; undefined takes it away. */
export const setRequirement = (document, key, value) =>
  withKeys(document, { requirements: filled(withKeys(document.requirements ?? {}, { [key]: value })) });

// Poses as they are drawn

/** A component of a pose; where it is free and not stated, between its neighbours in the order. */
function component(poses, index, key) {
  if (Number.isFinite(poses[index][key])) return poses[index][key];
  const before = poses.slice(0, index).findLastIndex((pose) => Number.isFinite(pose[key]));
  const behind = poses.slice(index + 1).findIndex((pose) => Number.isFinite(pose[key])) + index + 1;
  const [a, b] = [poses[before]?.[key], behind > index ? poses[behind][key] : undefined];
  if (a === undefined || b === undefined) return a ?? b ?? 0;
  return a + ((index - before) / (behind - before)) * (b - a);
}

/** Where a pose stands: { x, y, angle } in degrees, all of them numbers. */
export function standing({ poses }, index) {
  const { x, y, angle } = poses[index];
  if (Number.isFinite(x) && Number.isFinite(y) && Number.isFinite(angle)) return { x, y, angle };
  return { x: component(poses, index, "x"), y: component(poses, index, "y"), angle: component(poses, index, "angle") };
}

/** What a pose is called: its name, or its number. */
export const poseName = ({ poses }, index) => (poses[index]?.name ?? String(index + 1)).replace(/[\r\n\u2028\u2029]+/g, " ");

/** The keys among these that the pose states: what is free is not set by moving it. */
export const statedOf = (pose, changes) => Object.fromEntries(Object.entries(changes).filter(([key]) => Number.isFinite(pose[key])));
