// The report of a function task: its generators, the chosen one moving, and its structural error.

import { CardList } from "./cards.mjs";
import { h } from "./dom.mjs";
import { header } from "./header.mjs";
import { GeneratorView } from "./generator_view.mjs";
import { generatorCard, generatorTable } from "./function_tables.mjs";

export class FunctionReport {
  constructor(data, el, options) {
    this.data = data;
    this.el = el;
    this.options = options;
    const root = h("div", { class: "bm" }), body = h("div", { class: "bm-body" });
    const works = data.generators.some((each) => each.usable);
    root.append(header(data, works, "function report"), body);
    el.replaceChildren(root);
    this.root = root;
    const main = h("div", { class: "bm-main" });
    if (data.generators.length) {
      this.cards = new CardList(data.generators.map((each, k) => generatorCard(each, () => this.choose(k))));
      this.stand = h("div", { class: "bm-stand" });
      main.append(this.stand);
      body.append(this.cards.element);
    }
    body.append(main);
    main.append(h("section", { class: "bm-card bm-all", "aria-label": "All linkages" }, h("h2", {}, "All linkages"), generatorTable(data)));
    root.append(h("footer", { class: "bm-foot-notes" }, data.footnotes));
    if (data.generators.length) this.choose(0);
  }

  choose(index) {
    const anew = Boolean(this.view);
    this.view?.close();
    this.cards.mark(index);
    this.view = new GeneratorView(this.data, this.data.generators[index], this.stand, this.options);
    if (anew && this.stand.getBoundingClientRect().bottom < 0.4 * window.innerHeight) this.stand.scrollIntoView({ block: "start" });
  }

  close() {
    this.view?.close();
    this.el.replaceChildren();
  }
}
