// The lengths of the chosen linkage, drawn along its links where it stands; one that is changed becomes a limit.

import { put, s, say } from "../widget/dom.mjs";
import { act } from "../widget/kinematics.mjs";
import { fixed, px } from "../widget/numbers.mjs";
import { decimalsOf } from "../widget/tables.mjs";
import { currentLinkage, limitedDyads } from "./conditions.mjs";
import { setLimit, splitLimits } from "./document.mjs";
import { Kept } from "./scene.mjs";

const OFF = 15; // pixels from a link to its dimension line
const TICK = 4; // half of a tick's length
const LEAST = 26; // pixels of a link whose length has room

const away = ([a, b], [c, d]) => Math.hypot(c - a, d - b);

export class Dimensions {
  isOn = false;

  constructor(store, scene, playing, answers) {
    this.store = store;
    this.scene = scene;
    this.playing = playing;
    this.answers = answers;
    this.kept = new Kept(s("g", { class: "bs-dimensions" }), (key, item) => this.make(item), (group, item) => this.show(group, item));
    scene.layer("labels").append(this.kept.group);
    for (const each of ["shape", "place"]) playing.on(each, () => this.draw());
    scene.on("view", () => this.draw());
    store.on("document solved followed chosen", () => this.draw());
  }

  /** Show them, or no longer; whether they are shown. */
  toggle() {
    this.isOn = !this.isOn;
    this.draw();
    return this.isOn;
  }

  /** The links with two pins: { name, from, to, isDyad }; the length of a dyad's may be limited. */
  links() {
    const { playing: { here, linkage } } = this, place = here?.place;
    if (!this.isOn || !place || !linkage || linkage.gone) return [];
    const ends = linkage.led.map((dyad) => ({ dyad, fixed: dyad.fixed_pivot, moving: dyad.moving_pivot && act(place, dyad.moving_pivot) }));
    const [one, other] = ends, pairs = [["ground", one.fixed, other.fixed, false], ["coupler", one.moving, other.moving, false], ...ends.map(({ dyad, fixed: from, moving }) => [dyad.id, from, moving, true])];
    return pairs.filter(([, from, to]) => from && to).map(([name, from, to, isDyad]) => ({ name, from, to, isDyad }));
  }

  draw() {
    this.kept.draw(this.links().map((link) => [link.name, link]));
  }

  make({ name, isDyad }) {
    const text = s("text", { class: "bs-dimension", "text-anchor": "middle", "dominant-baseline": "middle", ...(isDyad ? { tabindex: 0, role: "button" } : {}) });
    const group = s("g", { "data-dimension": name }, s("path", { class: "bs-dimension-line" }), text);
    const open = () => this.open(name);
    if (isDyad) {
      this.scene.drag(text, { start: () => false, move: () => {}, click: open });
      text.addEventListener("keydown", (event) => event.key === "Enter" && (event.preventDefault(), open()));
    }
    return group;
  }

  show(group, { name, from, to }) {
    const { view } = this.scene, [line, text] = group.children, [a, b, c, d] = [view.X(from[0]), view.Y(from[1]), view.X(to[0]), view.Y(to[1])];
    const size = away([a, b], [c, d]), [u, v] = [(c - a) / size, (d - b) / size], [x, y] = [-v * OFF, u * OFF];
    put(group, "visibility", size < LEAST ? "hidden" : "visible");
    const end = (X, Y) => `M${px(X)} ${px(Y)}l${px(x * 1.3)} ${px(y * 1.3)}M${px(X + x - TICK * (u + v))} ${px(Y + y + TICK * (u - v))}l${px(2 * TICK * (u + v))} ${px(2 * TICK * (v - u))}`;
    put(line, "d", `${end(a, b)}${end(c, d)}M${px(a + x)} ${px(b + y)}L${px(c + x)} ${px(d + y)}`);
    const turn = (Math.atan2(d - b, c - a) * 180) / Math.PI, upright = Math.abs(turn) > 90 ? turn + 180 : turn;
    put(text, "transform", `translate(${px((a + c) / 2 + 1.7 * x)} ${px((b + d) / 2 + 1.7 * y)}) rotate(${px(upright)})`);
    say(text, fixed(away(from, to), decimalsOf(this.answers.data)));
    if (text.tabIndex === 0) put(text, "aria-label", `Length of the link of ${name}: ${text.textContent}. Enter changes it.`);
  }

  /** The length of a link, to be typed. */
  open(name) {
    /** @type {() => any} */
    const link = () => this.links().find((each) => each.name === name), middle = ({ from, to }) => [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
    this.scene.field.open({
      name: `the link of ${name}`, kind: this.store.selection?.kind, fields: [["length", "length", "length"]], options: { above: 0 },
      at: () => link() && middle(link()), values: () => ({ length: Number(fixed(away(link().from, link().to), decimalsOf(this.answers.data))) }),
      set: ({ length }) => this.limit(name, length),
    });
    const [{ input }] = this.scene.field.fields;
    input.focus();
    input.select();
  }

  /** The link of a dyad is to have this length: a limit for that dyad alone. */
  limit(name, length) {
    const { store, answers } = this, table = limitedDyads(store.document, currentLinkage(store), answers.data.scene).findIndex(({ id }) => id === name);
    store.edit((document) => setLimit(splitLimits(document, true), table, { length: { least: length, most: length } }));
  }
}
