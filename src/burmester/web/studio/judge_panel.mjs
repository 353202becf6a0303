// A linkage that exists, judged at the poses: drawn by four clicks, of a card, or from a file; its pivots are dragged.

import { give, h, put, s } from "../widget/dom.mjs";
import { act, back } from "../widget/kinematics.mjs";
import { px } from "../widget/numbers.mjs";
import { referencePlace } from "./body_editor.mjs";
import { button } from "./fields.mjs";
import { base64Of } from "./files.mjs";
import { GROUND } from "./shape_handles.mjs";

const STEPS = ["the driver's pivot on the ground", "the driver's pivot on the body", "the follower's pivot on the body", "the follower's pivot on the ground"];
const linksOf = (dyads) => dyads.map(({ fixed_pivot, moving_pivot, radius }) => ({ fixed_pivot, moving_pivot, radius }));

/** The tool that draws a linkage: from the ground over the body and back, as the body stands at the pose that is drawn at. */
class LinkageTool {
  constructor(scene, store, done) {
    this.name = "linkage";
    this.scene = scene;
    this.store = store;
    this.done = done;
    /** @type {number[][]} */
    this.points = [];
    this.line = s("path", { class: "bs-draft" });
    scene.layer("tool").append(this.line);
    this.ask();
  }

  ask() {
    this.hint = `Click ${STEPS[this.points.length]}. Escape gives up.`;
    this.scene.emit("tool", this);
  }

  click({ x, y }) {
    const place = [1, 2].includes(this.points.length) ? referencePlace(this.store) : GROUND;
    this.points.push(back(place, [x, y]).map((each) => this.scene.rounded(each)));
    if (this.points.length < STEPS.length) return this.ask();
    const [a, b, c, d] = this.points;
    this.scene.use(null);
    return this.done([{ fixed_pivot: a, moving_pivot: b }, { fixed_pivot: d, moving_pivot: c }]);
  }

  hover(point) {
    const { view } = this.scene, seen = this.points.map((each, k) => act(k ? referencePlace(this.store) : GROUND, each));
    if (point) seen.push([point.x, point.y]);
    put(this.line, "d", seen.length > 1 ? `M${seen.map(([x, y]) => `${px(view.X(x))} ${px(view.Y(y))}`).join("L")}` : "");
  }

  key() {}

  end() {
    this.line.remove();
  }
}

export class JudgePanel {
  constructor(store, answers, scene, surface, trying) {
    const draw = button("Draw a linkage", () => scene.use(scene.tool?.name === "linkage" ? null : new LinkageTool(scene, store, (links) => surface.judge(links))), { "data-do": "draw-linkage", "aria-pressed": "false" });
    const take = button("Judge the chosen one", () => surface.judge(linksOf(answers.shown.led)), { "data-do": "judge-chosen", title: "Then its pivots are dragged one by one" });
    const file = h("input", { type: "file", hidden: true, accept: ".toml,.json", "data-file": "linkage", onchange: () => read() });
    const better = h("ul", { class: "bs-found-springs" });
    const improve = button("Look for better ones near it", () => look(), { "data-do": "improve-judged" });
    this.element = h("div", {}, h("p", { class: "bm-story" }, "Draw a linkage that exists, take the chosen one, or open its file. It is judged as it is; drag its pivots, and the verdict follows."),
      h("div", { class: "bs-row" }, draw, take, button("From a file…", () => file.click(), { "data-do": "linkage-file" }), file, improve), better);

    const read = () => trying("Reading the linkage", async () => {
      const [one] = file.files, body = { name: one.name, base64: await base64Of(one), length_unit: store.document.length_unit };
      file.value = "";
      surface.judge((await (await store.connection.post("/linkage", body)).json()).dyads);
    });
    const look = () => trying("Looking near it", async () => {
      const { document, options, placed } = store;
      better.replaceChildren(h("li", { class: "bs-hint" }, "Looking near it …"));
      const found = await (await store.connection.post("/improve", { document, options, dyads: linksOf(placed.linkage.dyads) })).json();
      better.replaceChildren(...found.linkages.slice(1).map((each, k) => h("li", {}, button(`Take ${each.id}`, () => surface.judge(linksOf(each.dyads)), { "data-better": each.id }), h("span", { class: "bs-hint" }, ` ${found.better[k] ?? each.said.met}`))));
      if (found.linkages.length < 2) better.replaceChildren(h("li", {}, "Nothing better lies near it."));
    });
    const show = () => {
      const { shown } = answers;
      give(take, "disabled", !shown?.led.every((dyad) => dyad.kind === "RR"));
      give(improve, "hidden", !(surface.judges && store.placed?.linkage));
      if (improve.hidden) better.replaceChildren();
    };
    scene.on("tool", () => put(draw, "aria-pressed", scene.tool?.name === "linkage"));
    store.on("placed chosen solved", show);
    store.on("document", () => better.replaceChildren());
    show();
  }
}
