// Two linkages side by side, moving together, with their numbers beside each other.

import { give, h, say } from "../widget/dom.mjs";
import { placeAt } from "../widget/kinematics.mjs";
import { figure, fixed, spans } from "../widget/numbers.mjs";
import { Plane } from "../widget/plane.mjs";
import { leastOf, worstOf } from "./answers.mjs";
import { Pace, isSeen, watch } from "./pacing.mjs";
import { frameAtStage, stageOf } from "./together.mjs";

/** Rows of numbers of two linkages: a name, both values, and which of them is better (0, 1 or null). */
export function comparison(one, other, data) {
  const unit = data.unit ? ` ${data.unit}` : "", both = [one, other];
  const least = (values) => (values.every(Number.isFinite) && values[0] !== values[1] ? (values[0] < values[1] ? 0 : 1) : null);
  const row = (name, text, value, sign = 1) => ({ name, texts: both.map(text), better: value ? least(both.map((each) => sign * (value(each) ?? NaN))) : null });
  const links = ["ground", "driver", "coupler", "follower"];
  return [
    row("verdict", (each) => (each.gone ? "gone" : each.usable ? "usable" : "not usable"), (each) => (each.usable ? 0 : 1)),
    row("type", (each) => each.type),
    row("worst miss", (each) => worstOf(each, data), (each) => each.worst),
    row("least transmission angle", (each) => leastOf(each), (each) => each.least, -1),
    row("size", (each) => (each.quality ? spans(each.quality.extent) : "–"), (each) => each.quality?.extent),
    row("sensitivity", (each) => (each.quality ? figure(each.quality.sensitivity) : "–"), (each) => each.quality?.sensitivity),
    row("driver", (each) => each.led[0].id),
    ...links.map((name) => row(`${name} link`, (each) => (each.said.links?.[name] ? `${each.said.links[name]}${unit}` : "–"))),
    row("reason", (each) => (each.usable ? "–" : (each.followed ? each.reason : each.said.reasons.join("; ")) || "–")),
  ];
}

export class Compare {
  /** onstart: called when a comparison begins. */
  constructor(store, answers, playing, onstart) {
    this.store = store;
    this.onstart = onstart;
    this.answers = answers;
    this.playing = playing;
    this.pictures = [0, 1].map(() => h("div", { class: "bm-drawing" }));
    this.planes = this.pictures.map((parent) => new Plane(answers.data, parent));
    this.names = [0, 1].map(() => h("h3", {}));
    this.places = [0, 1].map(() => h("p", { class: "bs-quiet" }));
    this.table = h("div", { class: "bm-scroll", tabindex: 0, role: "region", "aria-label": "Both linkages in numbers" });
    this.button = h("button", { type: "button", class: "bm-button", onclick: () => playing.player.play(!playing.player.playing) }, "Play both");
    this.close = h("button", { type: "button", class: "bs-small", onclick: () => store.compared && store.compare(store.compared) }, "End the comparison");
    this.pairs = h("div", { class: "bs-beside" }, [0, 1].map((k) => h("div", {}, this.names[k], this.pictures[k], this.places[k])));
    this.empty = h("p", { class: "bm-story" }, "Press “Compare” on a card: that linkage moves beside the chosen one.");
    this.full = h("div", { hidden: true }, this.pairs, h("div", { class: "bs-tool" }, this.button, " ", this.close), this.table);
    this.element = h("div", { class: "bs-compare" }, this.empty, this.full);
    this.pace = new Pace(() => this.build(), () => this.on && isSeen(this.element));
    answers.on("answers shown", () => this.start());
    playing.on("shape", () => this.pace.ask());
    playing.on("place", (here) => this.show(here));
    new ResizeObserver(() => this.pace.ask()).observe(this.element);
    watch(this.element, () => this.pace.ask());
  }

  get other() {
    return this.answers.get(this.store.compared);
  }

  get on() {
    return Boolean(this.other && this.playing.linkage && this.other !== this.answers.shown);
  }

  start() {
    give(this.full, "hidden", !this.on);
    give(this.empty, "hidden", this.on);
    if (!this.on) return void (this.began = null);
    if (this.began !== this.other) this.onstart();
    this.began = this.other;
    this.build();
  }

  build() {
    if (!this.on) return;
    const { answers, playing, other } = this, mine = playing.linkage;
    const options = { factor: 0, fill: 0, far: false };
    this.names.forEach((name, k) => (name.textContent = [mine, other][k].id === "placed" ? "By hand" : `${[mine, other][k].id}: ${[mine, other][k].type}`));
    this.planes[0].build(mine, playing.player.way, playing.player.stretch, options);
    this.way = null;
    this.buildTable(comparison(mine, other, answers.data));
    if (playing.here) this.show(playing.here);
  }

  buildTable(rows) {
    const old = this.answers.isOld ? "bs-old" : null;
    this.table.replaceChildren(
      h("table", { class: "bs-compared" }, h("caption", {}, "Both linkages in numbers; the better one of each row is bold"),
        h("thead", {}, h("tr", {}, h("th", { scope: "col" }, ""), this.names.map((name) => h("th", { scope: "col" }, name.textContent)))),
        h("tbody", {}, rows.map(({ name, texts, better }) => h("tr", { class: /size|sensitivity|link/.test(name) ? old : null }, h("th", { scope: "row" }, name), texts.map((text, k) => h("td", { class: "bm-words" }, better === k ? h("b", {}, text) : text)))))),
    );
  }

  /** Both at the same stage. */
  show({ place, transmission }) {
    if (!this.on || !isSeen(this.element)) return;
    const { playing, other, answers: { data } } = this, { player } = playing;
    this.planes[0].show(place);
    this.tell(0, transmission);
    const at = frameAtStage(other, stageOf(playing.linkage, player.way, player.u));
    this.pictures[1].classList.toggle("bs-old", !at);
    if (!at) {
      this.planes[1].build(other, 0, { low: 0, high: (other.ways[0]?.x.length ?? 2) - 1 }, { factor: 0, fill: 0, far: false });
      this.places[1].textContent = "It does not reach this pose.";
      return;
    }
    if (this.way !== at.way) {
      this.way = at.way;
      const stops = other.pose_errors.filter((row) => row.way === at.way).map((row) => row.frame);
      const [low, high] = [Math.min(...stops), Math.max(...stops)];
      this.planes[1].build(other, at.way, high > low ? { low, high } : { low: 0, high: other.ways[at.way].x.length - 1 }, { factor: 0, fill: 0, far: false });
    }
    const way = other.ways[at.way];
    this.planes[1].show(placeAt(other, way, at.u, data.chart.length));
    this.tell(1, way.transmission[Math.round(at.u)]);
  }

  tell(k, transmission) {
    const text = `transmission angle ${transmission === null || !Number.isFinite(transmission) ? "–" : `${fixed(transmission, 1)}°`}`;
    say(this.places[k], text);
  }
}
