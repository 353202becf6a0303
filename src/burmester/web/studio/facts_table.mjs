// Every drawn fact in tables: dimensions, poses and errors, dyads, image space, instant centres, picked points.

import { h } from "../widget/dom.mjs";
import { instantCentre } from "../widget/instantaneous.mjs";
import { act } from "../widget/kinematics.mjs";
import { fixed } from "../widget/numbers.mjs";
import { decimalsOf, dyadTable, imageTables, inUnit, numbersOf, poseName, poseTable, worded } from "../widget/tables.mjs";
import { factsOf } from "../widget/words.mjs";
import { PLACED, dimensionsOf, leastOf, placeOf, worstOf } from "./answers.mjs";
import { Pace, isSeen, watch } from "./pacing.mjs";

/** A table with a caption that is read; rows of texts, the first one of each its head. */
function table(caption, heads, rows) {
  return h(
    "div", { class: "bm-scroll", tabindex: 0, role: "region", "aria-label": caption },
    h("table", {}, h("caption", {}, caption), h("thead", {}, h("tr", {}, heads.map((head) => h("th", { scope: "col" }, head)))),
      h("tbody", {}, rows.map((row) => h("tr", {}, row.map((text, k) => (k ? h("td", {}, text) : h("th", { scope: "row" }, text))))))),
  );
}

const point = (at, digits) => `(${at.map((value) => fixed(value, digits)).join(", ")})`;

/** Where the body turns at each pose, and where picked points are: rows of texts. */
export function poseFacts(linkage, data, points) {
  const digits = decimalsOf(data);
  return linkage.pose_errors.map((row, k) => {
    const name = data.poses[k] ? poseName(data.poses[k]) : String(k + 1);
    if (row.x === null) return [name, "–", ...points.map(() => "–")];
    const place = placeOf(row), centre = instantCentre(linkage.led, place);
    return [name, centre ? point(centre, digits) : "at infinity", ...points.map((each) => point(act(place, each.at), digits))];
  });
}

export class FactsTable {
  constructor(store, answers, playing, curves) {
    this.store = store;
    this.answers = answers;
    this.playing = playing;
    this.curves = curves;
    this.element = h("div", { class: "bs-facts" });
    this.pace = new Pace(() => this.build(), () => isSeen(this.element));
    playing.on("shape", () => this.pace.ask());
    answers.on("answers poses placed", () => this.pace.ask());
    watch(this.element, () => this.pace.ask());
    this.element.append(h("p", { class: "bm-story" }, "Nothing is known yet."));
  }

  build() {
    const { answers, playing } = this, { data, isOld } = answers, { linkage } = playing;
    const parts = [];
    const part = (title, old, ...content) => parts.push(h("section", { class: old ? "bs-old" : null, "aria-label": title }, h("h3", {}, title), old ? h("p", { class: "bs-quiet" }, "As of the last whole answer.") : null, content));
    const fits = linkage && linkage.pose_errors.length === data.poses.length;
    if (linkage) {
      const name = linkage.id === PLACED ? "Pivots put down by hand" : `${linkage.id}: ${linkage.type}`;
      const live = linkage.followed || playing.isOther;
      part(name, false, live ? this.followedFacts(linkage) : [h("p", { class: "bm-story" }, linkage.said.story), numbersOf(data, { ...linkage, id: linkage.id === PLACED ? "the linkage by hand" : linkage.id }), factsOf(linkage), ...linkage.said.notes.map((note) => h("p", { class: "bm-note-text" }, note))]);
    }
    part("Pose by pose", false, poseTable(data, fits ? linkage : undefined));
    if (fits && !linkage.drawn) {
      const points = this.curves?.points ?? [];
      part("Instant centre and picked points", false, table("At each pose, in F", ["pose", "instant centre", ...points.map((each, k) => `point ${k + 1}`)], poseFacts(linkage, data, points)));
    }
    if (this.store.placed) part("Pivots put down by hand", false, this.placedTable());
    if (data.linkages.length) part("All linkages", isOld, this.linkages());
    if (data.dyads.length) part("Dyads", isOld, dyadTable(data));
    if (linkage && !linkage.followed && linkage.said.manifolds?.[0].length && !playing.isOther) part("Image space", isOld, imageTables(data, linkage));
    this.element.replaceChildren(...parts);
  }

  followedFacts(linkage) {
    const { data } = this.answers;
    return [
      table(`Dimensions of ${linkage.id}${inUnit(data)}`, ["", "", "value"], dimensionsOf(linkage, data).map(({ dyad, what, value }) => [dyad, what, value])),
      table("Verdict", ["", "value"], [
        ["verdict", linkage.gone ?? (linkage.usable ? "usable" : `not usable: ${linkage.reason ?? linkage.said.reasons.join("; ")}`)],
        ["worst miss", worstOf(linkage, data)], ["least transmission angle", leastOf(linkage)], ["driver", linkage.led[0].id],
      ]),
    ];
  }

  /** All linkages: as the report has them, or what was followed of them. */
  linkages() {
    const { answers } = this, { data } = answers;
    if (!answers.linkages.some((each) => each.followed)) return worded(data, { ...data.table, class: "bm-linkages bm-stacks" });
    return table("All linkages, followed", ["", "verdict", "type", "worst miss", "least transmission"], answers.linkages.map((each) => [each.id, each.gone ? "gone" : each.usable ? "usable" : "not usable", each.type, worstOf(each, data), leastOf(each)]));
  }

  placedTable() {
    const { placed } = this.store, unit = inUnit(this.answers.data);
    return table(`Their dyads${unit}`, ["", "on the ground (F)", "on the body (M)", "length", "rms miss", "worst miss"], placed.dyads.map((dyad) => [dyad.id, dyad.said.ground, dyad.said.body, dyad.said.length, dyad.said.rms, dyad.said.worst]));
  }
}
