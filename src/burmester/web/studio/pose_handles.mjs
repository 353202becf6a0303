// Poses to take hold of: the origin moves, the tip of the x axis turns, keys do both.

import { put, s, say } from "../widget/dom.mjs";
import { axes, transform } from "../widget/drawing.mjs";
import { LETTER } from "../widget/mechanism.mjs";
import { clamp, degrees, px, radians } from "../widget/numbers.mjs";
import { shortened } from "../widget/tables.mjs";
import { addPose, isPath, isPoint, poseName, removePoses, setAngle, setPose, standing, statedOf } from "./document.mjs";
import { stepOf, stepped } from "./fields.mjs";
import { around } from "./name_places.mjs";
import { isOther } from "./pacing.mjs";
import { Kept } from "./scene.mjs";
import { about, withPosesMoved } from "./task_transform.mjs";

const LONGEST_ARM = 46; // pixels from the origin of a pose to the handle that turns it
const SHORTEST_ARM = 27; // the same where poses are crowded
const FEW = 24; // poses that all have handles; of more, those that have room, the last and the selected one
const MOST = 240; // poses that have handles
const ROOM = 14; // pixels from a handle to the next
const NAME = 14; // pixels from the origin of a pose to its name
const LONGEST_NAME = 18; // characters of a name that the drawing has room for
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
/** The angle nearest to another one that points the same way. */
const unwrapped = (angle, near) => angle + 360 * Math.round((near - angle) / 360);

/** How many poses of a task there are from one handle to the next. */
const strideOf = ({ poses }, scale) => {
  const length = poses.slice(1).reduce((sum, { x, y }, k) => sum + (Math.hypot(x - poses[k].x, y - poses[k].y) || 0), 0);
  return poses.length <= FEW ? 1 : Math.ceil(poses.length / clamp((scale * length) / ROOM, FEW, MOST));
};

/** The indices of the poses that are drawn: as many as have room at this scale. */
export function drawnPoses({ document, selection }, scale) {
  const { poses } = document, count = poses.length, all = [...poses.keys()];
  if (count <= FEW) return all;
  const stride = strideOf(document, scale), chosen = selection?.kind === "pose" ? selection.indices ?? [selection.index] : [];
  return all.filter((k) => k % stride === 0 || k === count - 1 || chosen.includes(k));
}

export class PoseHandles {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.element = scene.layer("poses");
    this.names = scene.layer("labels");
    this.kept = new Kept(this.element, (k) => this.make(k), (group, k) => this.show(group, k));
    this.labels = new Kept(this.names, () => s("text", { class: "bs-pose-name" }), (text, k) => this.showName(text, k));
    store.on("document selection reference", () => this.draw());
    scene.on("view", () => this.draw());
    scene.on("marquee", ([x, y, u, v]) => store.selectPoses([...store.document.poses.keys()].filter((k) => {
      const at = standing(store.document, k);
      return at.x >= x && at.x <= u && at.y >= y && at.y <= v;
    })));
    scene.on("key", (event) => store.selectedPoses.length > 0 && this.key(event, store.selection.index, false));
    scene.hold(() => store.document.poses.map((_, k) => standing(store.document, k)).map(({ x, y }) => [x, y]));
    scene.on("click", () => store.select(null));
    scene.names.avoid(() => this.obstacles());
    this.draw();
  }

  /** Arms are shorter where poses are crowded: about the distance from one to the next. */
  get arm() {
    const { document } = this.store, { scale } = this.scene.view, places = drawnPoses(this.store, scale).map((k) => standing(document, k));
    const away = places.slice(1).map(({ x, y }, k) => scale * Math.hypot(x - places[k].x, y - places[k].y)).sort((a, b) => a - b);
    return away.length ? clamp(1.2 * away[away.length >> 1], SHORTEST_ARM, LONGEST_ARM) : LONGEST_ARM;
  }

  draw() {
    this.length = this.scene.dragged ? this.length ?? this.arm : this.arm; // a handle does not run from the hand
    const poses = drawnPoses(this.store, this.scene.view.scale).map((k) => [k, k]);
    this.kept.draw(poses);
    this.labels.draw(poses.length > FEW && isPath(this.store.document) ? [] : poses); // a curve of many points needs no numbers
  }

  make(k) {
    const origin = s("g", { class: "bs-origin", "data-pose": k + 1, tabindex: 0, role: "button" }, s("circle", { class: "bs-hold", r: 12 }), s("circle", { class: "bs-dot", r: 5.5 }));
    const turn = s(
      "g",
      { class: "bs-turn", "data-turn": k + 1, tabindex: 0, role: "slider", "aria-valuemin": -360, "aria-valuemax": 360 },
      s("circle", { class: "bs-hold", r: 12 }),
      s("circle", { class: "bs-tip", r: 5 }),
    );
    const group = s("g", { class: "bs-pose" }, s("path", { class: "bs-axes" }), origin, turn);
    this.dragOrigin(origin, k);
    this.dragTurn(turn, k);
    for (const part of [origin, turn]) part.addEventListener("focus", () => this.touch(k));
    origin.addEventListener("keydown", (event) => this.key(event, k, false));
    turn.addEventListener("keydown", (event) => this.key(event, k, true));
    return group;
  }

  show(group, k) {
    const { store, scene: { view } } = this, { x, y, angle } = standing(store.document, k), pose = store.document.poses[k];
    const selected = store.selectedPoses.includes(k), isReference = store.referenceIndex === k, unit = store.document.length_unit ?? "", name = poseName(store.document, k);
    const point = isPoint(pose);
    if (!isOther(group, [view, this.length, x, y, angle, Boolean(pose.exact), pose.name, name, unit, selected, isReference, point])) return;
    const [arrow, origin, turn] = group.children;
    put(group, "transform", transform(view.X(x), view.Y(y), point ? 0 : radians(angle)));
    for (const part of [arrow, turn]) put(part, "display", point ? "none" : "inline");
    group.classList.toggle("bs-point", point);
    put(arrow, "d", axes(this.length - 8));
    put(turn, "transform", `translate(${px(this.length)} 0)`);
    group.classList.toggle("bs-selected", selected);
    group.classList.toggle("bs-reference", isReference);
    group.classList.toggle("bs-exact", Boolean(pose.exact));
    const what = point ? "Point" : "Pose", called = pose.name ? `${what} ${k + 1}, ${name}` : `${what} ${k + 1}`;
    put(origin, "aria-label", `${called}: x ${x} ${unit}, y ${y} ${unit}, ${point ? "angle free" : `angle ${angle}°`}. Drag, or use the arrow keys; Delete removes it.`);
    put(origin, "aria-pressed", selected);
    put(turn, "aria-label", `Turn ${called}`);
    put(turn, "aria-valuenow", angle);
    put(turn, "aria-valuetext", `${angle}°`);
  }

  /** What names keep off: origins, both axes, the handles that turn, and where the letter M stands at a pose. */
  obstacles() {
    const { store, scene: { view }, length } = this, boxes = [];
    for (const k of drawnPoses(store, view.scale)) {
      const { x, y, angle } = standing(store.document, k), a = radians(angle), [c, d] = [Math.cos(a), Math.sin(a)];
      const at = (along, across, size) => boxes.push([view.X(x) + along * c - across * d, view.Y(y) - along * d - across * c, size, size]);
      at(0, 0, 13);
      if (isPoint(store.document.poses[k])) continue;
      at(length, 0, 12);
      at(LETTER, -LETTER, 12);
      for (const share of [0.35, 0.7]) at(share * length, 0, 6);
      for (const share of [0.3, 0.6]) at(0, share * (length - 8), 6);
    }
    return boxes;
  }

  /** Names stand behind the origin, away from the x axis, where there is room. */
  showName(text, k) {
    const { store, scene } = this, { view } = scene, { x, y, angle } = standing(store.document, k), isHere = store.isOnBody && k === store.referenceIndex;
    const name = `${shortened(poseName(store.document, k), LONGEST_NAME)}${isHere ? ": drawn here" : ""}`;
    text.classList.toggle("bs-reference", k === store.referenceIndex);
    if (!isOther(text, [view, x, y, angle, name])) return;
    say(text, name);
    scene.names.put(text, view.X(x), view.Y(y), name, around(name, radians(angle + 215), NAME, scene.names.areMany));
  }

  /** A change of one pose; what is free and not stated stays free. */
  set(k, changes, gesture) {
    this.store.edit((document) => setPose(document, k, statedOf(document.poses[k], changes)), { gesture });
  }

  /** A pose has the focus: it is selected, with those that were selected with it; Shift adds it when it is let go. */
  touch(k) {
    const { store, scene } = this;
    if (scene.pressed?.shiftKey) return;
    if (store.selectedPoses.includes(k)) store.selectPoses(store.selectedPoses, k);
    else store.select({ kind: "pose", index: k });
  }

  /** A press that moved nothing. */
  click(event, k) {
    if (event.shiftKey) return this.store.selectAlso(k);
    this.store.select({ kind: "pose", index: k });
    return this.openField(k);
  }

  /** The poses that go along when one is taken hold of. */
  heldWith(k) {
    const { store } = this;
    if (!store.selectedPoses.includes(k)) store.select({ kind: "pose", index: k });
    return store.selectedPoses;
  }

  /** Its numbers beside it. */
  openField(k) {
    const { store, scene } = this, isThere = () => store.selectedPoses.includes(k), point = isPoint(store.document.poses[k]);
    scene.field.open({
      name: `pose ${k + 1}`, kind: "pose", at: () => isThere() && Object.values(standing(store.document, k)).slice(0, 2), values: () => standing(store.document, k),
      fields: [["x", "x", "length"], ["y", "y", "length"], ...(point ? [] : [["angle", "angle °", "angle"]])], set: (changes) => this.set(k, changes, null),
    });
  }

  /** Several poses moved as one, from where they were; what cannot be turned so stays. */
  moveAll(before, indices, by, gesture) {
    const next = withPosesMoved(before, indices, by);
    if (next) this.store.edit((document) => ({ ...document, poses: next.poses }), { gesture });
  }

  dragOrigin(element, k) {
    const { store, scene } = this;
    let gesture, off, before, reach, start, held;
    scene.drag(element, {
      start: (from) => {
        const { x, y } = standing(store.document, k);
        gesture = Symbol("move a pose");
        start = [x, y];
        off = [x - from.x, y - from.y];
        before = store.document;
        reach = isPath(before) ? strideOf(before, scene.view.scale) : 1;
        held = this.heldWith(k);
        this.openField(k);
      },
      move: (point, event) => {
        const to = scene.snap.point([point.x + off[0], point.y + off[1]], { event, from: start, skip: (of) => held.some((each) => of.endsWith(`pose ${each}`)) });
        if (held.length > 1) this.moveAll(before, held, { turn: 0, scale: 1, mirror: false, x: to[0] - start[0], y: to[1] - start[1] }, gesture);
        else if (reach > 1) this.bend(before, k, reach, [to[0] - start[0], to[1] - start[1]], gesture);
        else this.set(k, { x: to[0], y: to[1] }, gesture);
      },
      cancel: () => store.abandon(gesture),
      click: (event) => this.click(event, k),
    });
  }

  /** A point of a curve of many takes those without a handle of their own along, the less the farther they are. */
  bend({ poses, path }, k, reach, [dx, dy], gesture) {
    const count = poses.length;
    const moved = poses.map((pose, j) => {
      const away = path?.closed ? Math.min(Math.abs(j - k), count - Math.abs(j - k)) : Math.abs(j - k), share = 1 - away / reach;
      return share > 0 ? { ...pose, x: this.scene.rounded(pose.x + share * dx), y: this.scene.rounded(pose.y + share * dy) } : pose;
    });
    this.store.edit((document) => ({ ...document, poses: moved }), { gesture });
  }

  dragTurn(element, k) {
    const { store, scene } = this;
    let gesture, off, before, held;
    const angleTo = (point) => {
      const { x, y } = standing(store.document, k);
      return degrees(Math.atan2(point.y - y, point.x - x));
    };
    scene.drag(element, {
      start: (from) => {
        gesture = Symbol("turn a pose");
        before = store.document;
        held = this.heldWith(k);
        off = standing(before, k).angle - angleTo(from);
        this.openField(k);
      },
      move: (point, event) => {
        const { x, y, angle: now } = standing(store.document, k), angle = scene.snap.angle(unwrapped(angleTo(point) + off, now), [point.x, point.y], { event, skip: k });
        if (held.length > 1) this.moveAll(before, held, about([x, y], { turn: angle - standing(before, k).angle }), gesture);
        else this.set(k, { angle }, gesture);
      },
      cancel: () => store.abandon(gesture),
      click: (event) => this.click(event, k),
    });
  }

  key(event, k, turning) {
    const { store, scene } = this, arrow = ARROWS[event.key], held = store.selectedPoses.includes(k) ? store.selectedPoses : [k];
    if (event.ctrlKey || event.metaKey) return false;
    if (arrow) {
      if (!event.repeat) this.keyed = Symbol("keys"); // a key that is held is one gesture
      const { x, y, angle } = standing(store.document, k), by = stepOf(event, turning ? 1 : scene.step);
      if (held.length > 1 && turning) this.moveAll(store.document, held, about([x, y], { turn: by * (arrow[0] === 0 ? arrow[1] : -arrow[0]) }), this.keyed);
      else if (held.length > 1) this.moveAll(store.document, held, { turn: 0, scale: 1, mirror: false, x: by * arrow[0], y: by * arrow[1] }, this.keyed);
      else if (turning) this.set(k, { angle: stepped(angle, by * (arrow[0] === 0 ? arrow[1] : -arrow[0])) }, this.keyed);
      else this.set(k, { x: stepped(x, by * arrow[0]), y: stepped(y, by * arrow[1]) }, this.keyed);
    } else if (event.key === "Delete" || event.key === "Backspace") {
      store.edit((document) => removePoses(document, held));
      const left = store.document.poses.length, next = Math.min(held.length > 1 ? held[0] : k, left - 1);
      store.select(left ? { kind: "pose", index: next } : null);
      this.focus(next);
    } else {
      return false;
    }
    event.preventDefault();
    return true;
  }

  focus(k) {
    this.element.querySelector(`[data-pose="${k + 1}"]`)?.focus({ preventScroll: true });
  }
}

/** The tool that adds points, whose angle is free. */
export class PointTool {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.name = "point";
    this.hint = "Click where the body's point is to pass; how the body turns there is free. Escape ends.";
  }

  click(point, event) {
    const { store, scene } = this, index = store.document.poses.length, [x, y] = scene.snap.point([point.x, point.y], { event });
    store.edit((document) => setAngle(addPose(document, { x, y }), index, undefined));
    store.select({ kind: "pose", index });
  }

  key(event) {
    if (event.key !== "Escape") return false;
    this.scene.use(null);
    return true;
  }
}

/** The tool that adds poses: a click sets one, the second click turns it. */
export class PoseTool {
  constructor(store, scene) {
    this.store = store;
    this.scene = scene;
    this.name = "pose";
    this.gesture = null;
    this.hint = "Click where the pose is to stand, and click again to turn it. Escape ends.";
  }

  click(point, event) {
    const { store, scene } = this;
    if (this.gesture) {
      this.turn(point, event);
      this.gesture = null;
      return;
    }
    const [x, y] = scene.snap.point([point.x, point.y], { event });
    this.gesture = Symbol("add a pose");
    const angle = store.document.poses.findLast((pose) => Number.isFinite(pose.angle))?.angle ?? 0;
    store.edit((document) => addPose(document, { x, y, angle }), { gesture: this.gesture });
    store.select({ kind: "pose", index: store.document.poses.length - 1 });
  }

  hover(point, event) {
    if (this.gesture && point) this.turn(point, event);
    else if (point) this.scene.snap.point([point.x, point.y], { event });
  }

  turn(point, event) {
    const { store, gesture } = this, k = store.document.poses.length - 1, { x, y, angle } = standing(store.document, k);
    const away = Math.hypot(point.x - x, point.y - y) * this.scene.view.scale;
    if (away < 6) return; // a second click on the origin leaves the angle
    const next = this.scene.snap.angle(unwrapped(degrees(Math.atan2(point.y - y, point.x - x)), angle), [point.x, point.y], { event, skip: k });
    store.edit((document) => setPose(document, k, { angle: next }), { gesture });
  }

  key(event) {
    if (event.key !== "Escape") return false;
    if (this.gesture) this.store.abandon(this.gesture);
    this.gesture = null;
    this.scene.use(null);
    return true;
  }
}
