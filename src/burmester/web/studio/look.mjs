// What is looked for beside four-bars, such as springs and six-bars: its progress, and a button that stops it.

import { give, h, say } from "../widget/dom.mjs";
import { button } from "./fields.mjs";

/** what: what the server is asked for; more(): what goes with the task. */
export class Look {
  constructor(store, what, more = () => ({})) {
    this.store = store;
    this.what = what;
    this.more = more;
    this.note = h("p", { class: "bs-hint", role: "status" });
    this.stop = button("Stop", () => store.connection.send({ do: "stop" }), { "data-do": `stop-${what}`, hidden: true });
    this.element = h("div", { class: "bs-row" }, this.note, this.stop);
    store.connection.on("message", ({ n, kind, text }) => {
      if (n === this.n && kind === "progress") say(this.note, `${text[0].toUpperCase()}${text.slice(1)} …`);
    });
  }

  /** What the server found for the task as it is; null where it was stopped or refused, which is told. */
  async run() {
    const { document, options, connection } = this.store;
    give(this.stop, "hidden", false);
    say(this.note, "Looking …");
    let told;
    try {
      const asked = connection.ask({ do: this.what, document, options, ...this.more() });
      this.n = connection.n;
      told = await asked;
    } catch {
      told = { kind: "ended", messages: [{ message: "the server does not answer" }] };
    }
    give(this.stop, "hidden", true);
    if (told.kind === "looked") {
      say(this.note, "");
      return told;
    }
    const sentences = (told.messages ?? []).map(({ message, help }) => `${message}${help ? `: ${help}` : ""}`).join(". ");
    say(this.note, told.kind === "cancelled" ? "Stopped." : `That did not work: ${sentences || told.message}.`);
    return null;
  }
}
