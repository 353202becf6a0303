// Events of a part: who listens is told by name.

export class Events {
  /** @type {Map<string, Function[]> | undefined} */ heard;

  /** Call `fn` after any of the events whose names stand in `names`, blanks between them.
   * @param {string} names @param {Function} fn */
  on(names, fn) {
    this.heard ??= new Map();
    for (const name of names.split(" ")) this.heard.set(name, [...(this.heard.get(name) ?? []), fn]);
  }

  /** @param {string} name @param {unknown[]} values */
  emit(name, ...values) {
    for (const fn of this.heard?.get(name) ?? []) fn(...values);
  }
}
