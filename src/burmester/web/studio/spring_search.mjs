// A search for the spring that makes the chosen linkage light: `burmester balance`, and its springs to choose from.

import { give, h, say } from "../widget/dom.mjs";
import { button } from "./fields.mjs";
import { Look } from "./look.mjs";
import { setAt, springsOf } from "./loads.mjs";

const newtons = (value) => Number(value.toPrecision(3));

/** The button that starts it, and where its springs stand.
 * @param {object} store @param {import("./answers.mjs").Answers} answers */
export function springSearch(store, answers) {
  const list = h("ul", { class: "bs-found-springs" });
  let put = null; // the spring that was put in last: the next one takes its place
  const look = new Look(store, "balance", () => ({ linkage: store.chosen }));
  const start = button("Find a spring", () => run(), { "data-do": "find-spring" });

  async function run() {
    list.replaceChildren();
    put = null;
    const found = await look.run();
    if (!found) return;
    if (!found.springs.length) say(look.note, "No spring of the list fits between the ground and the body.");
    else say(look.note, `For ${store.chosen}, the best first. That none is better is not proved.`);
    list.replaceChildren(...found.springs.map(row));
  }

  function row({ name, greatest, greatest_without: before, keeps_all: keeps, loads, spring }) {
    const unit = loads.hand_force_N || !loads.driver_torque_Nm ? "N" : "N·m", text = `${name}: ${newtons(greatest)} ${unit} at most, ${newtons(before)} ${unit} without it`;
    return h("li", {}, button(text, () => take(spring), { "data-spring-name": name, title: "Put it into the task" }), h("span", { class: "bs-hint" }, keeps ? " keeps all that is asked" : " does not keep all that is asked"));
  }

  function take(spring) {
    const springs = springsOf(store.document), at = put ? springs.indexOf(put) : -1;
    put = spring;
    store.edit((document) => setAt(document, ["springs", at < 0 ? springs.length : at], spring));
  }

  const show = () => {
    give(start, "hidden", !store.document.loads);
    give(start, "disabled", store.chosen === "placed" || !answers.shown);
  };
  store.on("document chosen solved", show);
  show();
  return { start, element: h("div", {}, look.element, list) };
}
