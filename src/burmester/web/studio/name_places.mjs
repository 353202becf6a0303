// Names in the plane: each beside what it names, off handles and off the other names.

import { put } from "../widget/dom.mjs";
import { px } from "../widget/numbers.mjs";

const LETTER = 7.2; // pixels of a character, about
const HEIGHT = 14; // pixels of a line
const REST = 80; // milliseconds without a change of the view before names are placed anew
const MANY = 60; // names, of which each has fewer places to choose from
const OUTSIDE = 500; // cost of a name that is not wholly in the picture
const HABIT = 6; // the cost by which another place has to be better than the one a name has
const MISLEADING = 60; // cost of a name that stands nearer to the point of another one
const COVERED = 0.15; // of its area; a lesser name that lies so far over others is not shown
const SAME = 2; // how much worse a name on a name is than a name on a handle, of equal area

/** Places around a point, the nearest to a direction first: [right, up, cost] of the middle of the name, in pixels.
 *
 * toward: radians, counter-clockwise from the right; distance: pixels from the point to the name.
 */
export function around(text, toward, distance, few = false) {
  const half = (LETTER * text.length + 4) / 2, places = [], count = few ? 8 : 16;
  for (let ring = 0; ring < (few ? 1 : 3); ring += 1) {
    for (let k = 0; k < count; k += 1) {
      const turn = (k % 2 ? 1 : -1) * Math.ceil(k / 2) * ((2 * Math.PI) / count), angle = toward + turn, away = distance + 9 * ring;
      // A line is wide and low: the nearest point of its box is so far away, not its middle.
      places.push([(away + half - 5) * Math.cos(angle), away * Math.sin(angle), 3 * Math.abs(turn) + 14 * ring]);
    }
  }
  return places;
}

/** Places along a horizontal edge of a region, outside it first: [right, up, cost]. */
export function along(up, width) {
  const reach = Math.max(0, width / 2 - 30);
  return [0, -0.5, 0.5, -1, 1].flatMap((share) => [[share * reach, up, 8 * Math.abs(share)], [share * reach, -up, 10 + 8 * Math.abs(share)]]);
}

/** All names of the plane.  `put` moves a name with its point at once; where it stands beside the point is looked
 * at anew when the hand rests, so that no name runs about during a drag. */
export class NamePlaces {
  /** @type {any} */ timer;

  constructor(scene) {
    this.scene = scene;
    this.names = new Map(); // by their elements
    this.obstacles = [];
    this.timer = null;
    scene.on("dropped", () => this.ask());
  }

  /** `fn` returns boxes that names keep off: [middle x, middle y, width, height] in pixels. */
  avoid(fn) {
    this.obstacles.push(fn);
  }

  get areMany() {
    return this.names.size > MANY;
  }

  /** The point that a name belongs to, in pixels, and the places that it may have beside it.
   *
   * isLesser: whether it is left out where there is no room for it.
   */
  put(element, x, y, text, places, isLesser = false) {
    const before = this.names.get(element), name = { x, y, text, places, isLesser, at: before?.text === text ? before.at : places[0] };
    this.names.set(element, name);
    this.show(element, name);
    this.ask();
  }

  ask() {
    clearTimeout(this.timer);
    if (!this.scene.dragged) this.timer = setTimeout(() => this.place(), REST);
  }

  show(element, { x, y, at }) {
    put(element, "text-anchor", "middle");
    put(element, "transform", `translate(${px(x + at[0])} ${px(y - at[1] + 4)})`); // its letters are not set anew
  }

  /** Each name in turn goes where it covers the least; then once more, for by then all others stand. */
  place() {
    if (this.scene.dragged) return;
    for (const element of [...this.names.keys()]) if (!element.isConnected) this.names.delete(element);
    const { width, height } = this.scene.view;
    const seen = [...this.names].filter(([element, { x, y }]) => x > -20 && y > -20 && x < width + 20 && y < height + 20 && element.getAttribute("display") !== "none");
    const taken = this.obstacles.flatMap((fn) => fn()).map(boxOf), stands = new Map();
    for (let pass = 0; pass < (this.areMany ? 1 : 2); pass += 1) {
      for (const [element, name] of seen) {
        stands.delete(element);
        const others = [...stands.values()];
        let best = { cost: Infinity, at: name.at, box: [0, 0, 0, 0] };
        for (const at of name.places) {
          const box = boxAt(name, at);
          const habit = at[0] === name.at[0] && at[1] === name.at[1] ? HABIT : 0;
          let cost = at[2] - habit;
          if (box[0] < 2 || box[1] < 2 || box[2] > width - 2 || box[3] > height - 2) cost += OUTSIDE;
          for (const other of taken) cost += overlap(box, other);
          for (const other of others) cost += SAME * overlap(box, other);
          const own = awayFrom(box, name);
          if (seen.some(([, other]) => other !== name && awayFrom(box, other) < own + 1)) cost += MISLEADING;
          if (cost < best.cost) best = { cost, at, box };
        }
        name.at = best.at;
        stands.set(element, best.box);
      }
    }
    const shown = seen.filter(([, { isLesser }]) => !isLesser).map(([element]) => stands.get(element));
    for (const [element, name] of seen) {
      const box = stands.get(element), isHidden = name.isLesser && shown.some((other) => overlap(box, other) > COVERED * (box[2] - box[0]) * HEIGHT);
      if (name.isLesser && !isHidden) shown.push(box);
      put(element, "visibility", isHidden ? "hidden" : "visible");
      this.show(element, name);
    }
  }
}

const boxOf = ([x, y, width, height]) => [x - width / 2, y - height / 2, x + width / 2, y + height / 2];

const boxAt = ({ x, y, text }, at) => boxOf([x + at[0], y - at[1], LETTER * text.length + 4, HEIGHT]);

/** The distance from a point to a box. */
const awayFrom = (box, { x, y }) => Math.hypot(Math.max(box[0] - x, 0, x - box[2]), Math.max(box[1] - y, 0, y - box[3]));

/** The area that two boxes share. */
function overlap(one, other) {
  const across = Math.min(one[2], other[2]) - Math.max(one[0], other[0]), down = Math.min(one[3], other[3]) - Math.max(one[1], other[1]);
  return across > 0 && down > 0 ? across * down : 0;
}
