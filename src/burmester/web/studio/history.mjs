// What was before: undo and redo, one entry a gesture.

const MOST = 500; // entries that are kept

/** Values before and after each change.  A value is never changed in place, so an entry costs what it changed. */
export class History {
  /** @type {() => void} */ onchange = () => {};

  /** kept: what `kept` said of another history, whose entries this one goes on from.
   * @param {{ past: any[], future: any[] }} kept */
  constructor(kept = { past: [], future: [] }) {
    /** @type {{ value: any, gesture: unknown }[]} */ this.past = kept.past.map((value) => ({ value, gesture: null })); // the value before each gesture
    /** @type {any[]} */ this.future = [...kept.future];
  }

  /** The entries nearest to now as values for JSON, as many as have room.
   * @param {number} room characters */
  kept(room) {
    const some = (/** @type {any[]} */ list) => {
      const out = [];
      for (let k = list.length - 1; k >= 0 && (room -= JSON.stringify(list[k]).length) > 0; k -= 1) out.unshift(list[k]);
      return out;
    };
    return { past: some(this.past.map(({ value }) => value)), future: some(this.future) };
  }

  /** Keep the value that a change is about to replace; edits of one gesture are one entry.
   * @param {any} value @param {unknown} gesture */
  record(value, gesture) {
    this.future = [];
    const last = this.past.at(-1);
    if (gesture !== null && last?.gesture === gesture) return;
    this.past.push({ value, gesture });
    if (this.past.length > MOST) this.past.shift();
    this.onchange();
  }

  /** The value before the last gesture, or null.
   * @param {any} value */
  undo(value) {
    const last = this.past.pop();
    if (!last) return null;
    this.future.push(value);
    return last.value;
  }

  /** The value that the last undo took away, or null.
   * @param {any} value */
  redo(value) {
    const next = this.future.pop();
    if (next === undefined) return null;
    this.past.push({ value, gesture: null });
    return next;
  }

  /** The value before a gesture that is given up, which leaves no entry; or null.
   * @param {unknown} gesture */
  abandon(gesture) {
    if (this.past.at(-1)?.gesture !== gesture) return null;
    return this.past.pop()?.value;
  }

  get canUndo() {
    return this.past.length > 0;
  }

  get canRedo() {
    return this.future.length > 0;
  }
}
