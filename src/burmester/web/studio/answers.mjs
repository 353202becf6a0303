// The linkages as they are known now: those of the last whole search, moved on by what was followed since.
//
// Every part of the page that shows a linkage reads it here.  A linkage stays the same object while it is
// followed, and over whole searches as long as it goes on: the server says which one goes on as which.

import { figure, fixed, radians } from "../widget/numbers.mjs";
import { decimalsOf } from "../widget/tables.mjs";
import { isPath, isPoint } from "./document.mjs";
import { Events } from "./events.mjs";
import { drawnLoads } from "./loads.mjs";

const LONGEST_NAME = 5; // characters of a pose's name that a drawing has room for
const FOLLOWED = 1e-7; // scenes; the same of what is followed, whose places are single floats
const EXACT_TURN = 1e-5; // degrees; the same for an angle

/** The error of a followed linkage, in scenes, that a drawing does not show: it may be rounding. */
export const UNSEEN = 1e-6;

export const PLACED = "placed"; // the id of the linkage whose pivots were put down by hand

/** What stands where nothing is known yet. */
const NOTHING = {
  poses: [], body: null, keep_out: [], loads: null, scene: 1, span: 1, unit: null, dyads: [], linkages: [], dyads_title: "Dyads",
  chart: { origin: [0, 0], angle: 0, length: 1 }, space: { centre: [0, 0, 0], half: [1, 1, 1], quadrics: [] },
  pivot_map: null, family_map: null, transmission_limit: { deg: 40, said: "40°, a usual limit" }, keys: [], table: null, best: [], warnings: [], footnotes: "",
};

/** Events: "answers" (another set of linkages), "moved" (the same ones elsewhere), "shown" (another one is chosen),
 * "poses" (the poses alone moved), "placed" (pivots were put down by hand). */
export class Answers extends Events {
  /** @param {object} store */
  constructor(store) {
    super();
    this.store = store;
    this.data = { ...NOTHING }; // as report_data, but for the poses: they are those of the document
    this.linkages = []; // in the order of the whole search, those that appeared since behind them
    this.gone = []; // ids of linkages before that are none of the last whole search
    this.byId = new Map();
    this.others = new Map(); // what was looked for besides, such as six-bars, by id
    this.placed = null;
    store.on("solved", () => this.takeSolved());
    store.on("followed", () => this.takeFollowed());
    store.on("document", () => this.takePoses());
    store.on("chosen", () => this.emit("shown"));
    store.on("placed", () => this.takePlaced());
    this.takePoses();
    if (store.solved) this.takeSolved();
  }

  /** The linkage that is drawn, or undefined. */
  get shown() {
    return this.get(this.store.chosen) ?? (this.store.chosen === PLACED ? undefined : this.linkages[0]);
  }

  /** @param {string | null} id */
  get(id) {
    return id === PLACED ? this.placed ?? undefined : this.byId.get(id) ?? this.others.get(id ?? "");
  }

  /** Whether what only the whole search knows belongs to an older task. */
  get isOld() {
    return this.store.solvedFor !== this.store.document;
  }

  takePoses() {
    const poses = posesOf(this.store.document);
    Object.assign(this.data, { poses, isPath: isPath(this.store.document), loads: drawnLoads(this.store.document), ...surroundingsOf(this.store.document, this.data) });
    this.emit("poses");
  }

  takeSolved() {
    const { solved, document } = this.store, before = this.linkages.filter((each) => !each.gone);
    const { renamed: names, moved } = this.store;
    const was = new Map([...names].map(([old, id]) => [id, this.byId.get(old)]));
    const { poses, body, keep_out, ...rest } = solved;
    Object.assign(this.data, { body, keep_out, ...rest, poses: posesOf(document), loads: drawnLoads(document) });
    this.gone = this.store.isEmpty || this.store.isAnother ? [] : before.filter((each) => !names.has(each.id)).map((each) => each.id);
    this.byId = new Map();
    this.linkages = solved.linkages.map((fresh) => {
      const kept = was.get(fresh.id), now = kept ?? {};
      const stood = kept && kept.rank !== Infinity; // in the last whole answer, not only since
      const before = stood && kept.id !== fresh.id ? kept.id : null;
      for (const key of Object.keys(now)) delete now[key];
      Object.assign(now, figured(linked(fresh)), { was: before, shift: moved.get(fresh.id) ?? 0, isNew: this.known && !this.store.isAnother && !stood, followed: false, gone: null, change: null });
      this.byId.set(now.id, now);
      return now;
    });
    this.known = !this.store.isEmpty;
    this.emit("answers");
  }

  takeFollowed() {
    const frame = this.store.followed;
    if (!frame) return;
    for (const each of frame.linkages) {
      let now = this.byId.get(each.id);
      if (now && each.fresh === false) continue; // it was not judged at this step: it stands as it did
      if (!now) {
        now = appeared(each);
        this.byId.set(each.id, now);
        this.linkages.push(now);
        this.hasNew = true;
      }
      follow(now, each, this.data);
    }
    for (const { id, message } of frame.vanished ?? []) {
      const now = this.byId.get(id);
      if (now) Object.assign(now, { gone: message, usable: false });
    }
    for (const { id, kind, message } of frame.changes ?? []) {
      const now = this.byId.get(id);
      if (now && kind !== "vanished") now.change = message;
    }
    if (this.hasNew) {
      this.hasNew = false;
      this.emit("answers");
    } else {
      this.emit("moved");
    }
  }

  takePlaced() {
    const placed = this.store.placed?.linkage, { cognateOf } = this.store.placed ?? {}, called = cognateOf ? `Cognate of ${cognateOf}` : "By hand";
    const before = this.placed;
    this.placed = placed ? Object.assign(before ?? {}, figured(linked(placed)), { id: PLACED, called, gone: null, followed: false }) : null;
    this.emit("placed");
    if (this.store.chosen === PLACED) this.emit(before && placed ? "moved" : "shown");
  }
}

/** A linkage of a report with the way of each pose beside it. */
export const linked = (linkage) => ({
  ...linkage,
  pose_errors: linkage.pose_errors.map((row) => ({ ...row, at: row.way === null ? null : linkage.ways[row.way] })),
});

/** With the figures that cards show and sort by under the names that followed answers have, too. */
const figured = (linkage) => Object.assign(linkage, { worst: linkage.position_error.max, least: linkage.min_transmission_angle_deg.range });

/** The poses of a document as a report has them, with short labels for drawings. */
export function posesOf({ poses = [] }) {
  const names = poses.map((pose, k) => pose.name || String(k + 1));
  const short = names.every((name) => name.length <= LONGEST_NAME);
  return poses.map((pose, k) => ({ ...pose, angle_deg: isPoint(pose) ? null : pose.angle, name: names[k], label: short ? names[k] : String(k + 1) }));
}

/** The outline of the body as the document has it, where it is stated in numbers. */
const surroundingsOf = (document, data) => ({ body: Array.isArray(document.body) ? document.body : document.body === undefined ? null : data.body });

/** What is followed goes into the linkage that it continues. */
function follow(now, each, data) {
  now.usable = each.usable;
  now.led = each.led;
  now.worst = each.worst;
  now.least = each.transmission_deg;
  now.reason = each.reason;
  now.followed = true;
  now.gone = null;
  if (each.type) now.type = each.type;
  if (!each.ways?.length) {
    now.ways = now.ways ?? [];
    return;
  }
  now.ways = each.ways;
  now.pose_errors = each.pose_errors.map((row) => ({
    ...row, at: row.way === null ? null : each.ways[row.way],
    said: row.x === null
      ? { position: "-", turned: "-", transmission: "-" }
      : {
        position: row.position < FOLLOWED * data.scene ? "exact" : figure(row.position),
        turned: row.turned_deg < EXACT_TURN ? "exact" : `${figure(row.turned_deg)}°`,
        transmission: row.transmission_deg === null ? "-" : `${fixed(row.transmission_deg, 1)}°`,
      },
  }));
}

/** A linkage that was not there before it was followed: the whole search will say more of it. */
const appeared = (each) => ({
  id: each.id, type: each.type ?? "linkage", rank: Infinity, dyads: each.led, ways: [], pose_errors: [], isNew: true, followed: true,
  said: { met: "", story: "", facts: [], reasons: [], quality: {}, dimensions: [], notes: [], links: null, manifolds: [[], []], worst: "–", rms: "–", transmission: "-" },
  space: null, shortcomings: [], defects: [], unmet: [],
});

/** The worst miss as a card says it: the words of the whole search, or a number of what was followed. */
export function worstOf(linkage, data) {
  if (linkage.worst === null || linkage.worst === undefined) return "–";
  if (!linkage.followed) return linkage.said.worst === "-" ? "–" : linkage.said.worst === "exact" ? "exact" : `${linkage.said.worst}${data.unit ? ` ${data.unit}` : ""}`;
  return linkage.worst < FOLLOWED * data.scene ? "exact" : `${figure(linkage.worst)}${data.unit ? ` ${data.unit}` : ""}`;
}

/** How far the coupler point passes from the points of a path: root mean square, and at most. */
export function pathErrorOf(linkage, data) {
  const { rms } = linkage.said, worst = worstOf(linkage, data);
  return linkage.followed || !rms || rms === "-" || rms === "exact" ? worst : `${rms} rms, ${worst} at most`;
}

/** The least transmission angle, in the same way; a bound, so it is rounded down. */
export function leastOf(linkage) {
  if (!linkage.followed) return linkage.said.transmission === "-" ? "–" : linkage.said.transmission;
  return linkage.least === null || linkage.least === undefined ? "–" : `${Math.floor(10 * linkage.least + 1e-6) / 10}°`;
}

/** The dimensions of both dyads as rows { dyad, what, value }, from their numbers. */
export function dimensionsOf(linkage, data) {
  const digits = decimalsOf(data), point = (p) => `(${p.map((value) => fixed(value, digits)).join(", ")})`;
  return linkage.led.flatMap((dyad) => [
    ...(dyad.fixed_pivot ? [{ dyad: dyad.id, what: "fixed pivot in F", value: point(dyad.fixed_pivot) }] : []),
    ...(dyad.moving_pivot ? [{ dyad: dyad.id, what: "moving pivot in M", value: point(dyad.moving_pivot) }] : []),
    ...(dyad.radius !== undefined ? [{ dyad: dyad.id, what: "length", value: fixed(dyad.radius, digits) }] : []),
    ...(dyad.line ? [{ dyad: dyad.id, what: `line in ${dyad.kind === "PR" ? "F" : "M"}, normal and offset`, value: `${fixed(dyad.line.normal_deg, 2)}°, ${fixed(dyad.line.offset, digits)}` }] : []),
  ]);
}

/** A place of the body { x, y, a } of a row of errors. */
export const placeOf = (row) => ({ x: row.x, y: row.y, a: radians(row.angle_deg) });

