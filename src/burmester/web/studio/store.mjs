// What the page knows: the task with its history, the server's answers, and what is chosen.
//
// While a gesture lasts, its documents are followed: each is sent at once, and the server takes the newest one when it is
// free, so that it never waits for a page that is drawing.  When the hand has
// rested, the whole search runs.  Every part draws from here and listens for what it draws.

import { withKeys } from "./document.mjs";
import { History } from "./history.mjs";

const REST = 150; // milliseconds without an edit before the whole search runs
const MOST_REST = 1000; // the same where what was asked before is not answered yet
const MOST_FLYING = 1; // follows on their way, as a rule: of two the second would wait, and answer to an older task than one asked later
const MOST_SHOWN = 6; // linkages whose motion is asked for while dragging
const FEWEST = 2; // poses that make a task
export const QUICK = 1.2; // seconds; what cannot be followed is solved at once while a hand drags, if that takes no longer
const NO_ANSWER = { linkages: [], dyads: [], best: [], warnings: [], pivot_map: null, family_map: null, outcome: { message: "Two poses or more make a task" } };
const PICTURE = /^data:image\/jpeg;base64,[A-Za-z0-9+/=]+$/; // one that this page made
const PLACED = "placed"; // chosen: the linkage whose pivots were put down by hand

/** What decides whether a task can be followed from another one: how many poses it has, what is free, and whether it is a path. */
const kindOf = ({ poses, path }) => `${poses.map(({ free }) => free?.join("") ?? "-").join()} ${path ? path.closed : ""}`;

/** Events: document, solved, followed, state, chosen, pinned, filters, placed, selection, reference, picture, history, messages. */
export class Store {
  /** @type {any} */ solving;
  /** @type {any} */ placing;
  /** @type {any} */ solved;

  /** @param {{ connection: import("./connection.mjs").Connection, document: object, options?: object, name?: string, settings?: object, filters?: object, choice?: any, picture?: any, history?: any, mostFlying?: number }} start */
  constructor({ connection, document, options = {}, name = "task", settings = {}, filters = {}, choice = null, picture = null, history = undefined, mostFlying = MOST_FLYING }) {
    this.connection = connection;
    this.mostFlying = mostFlying;
    this.renamed = new Map(); // of the last whole answer: old id, new id
    this.moved = new Map(); // of it, too: new id, how far the search moved that linkage
    this.document = document;
    this.options = options;
    this.name = name;
    this.settings = settings; // of exports: options of `burmester export`
    this.filters = filters; // of cards, by the names of their fields
    this.images = new Map(); // data URLs of pictures, by their ids
    this.picture = this.known(picture); // behind the plane: where it is, and how strong
    this.wanted = choice && { ...choice, document }; // what is chosen again when there is an answer to that document
    this.history = new History(history);
    this.history.onchange = () => this.emit("history");
    this.solved = null;
    this.advice = []; // on the last answer: { code, message, why, help, assumed, cures } each
    this.solvedFor = null;
    this.followed = null;
    this.followedFor = null;
    this.state = "resting";
    this.progress = "";
    this.chosen = null;
    this.pinned = new Set();
    this.placed = null;
    this.whole = null; // the kind of tasks to which the last answer cannot be followed, as far as it is known
    this.task = 0; // another number for another task, which is no change of this one
    this.solvedTask = 0;
    this.selection = null;
    this.reference = 0; // the pose at which what belongs to the body is drawn
    this.isOnBody = false; // whether such a thing is drawn now, or has its handles
    this.messages = [];
    this.listeners = new Map();
    this.basis = null; // the number of the solve that `solved` answers
    this.pending = null; // a whole answer to an older document, until a followed frame goes on from it
    this.flying = new Map(); // the follows in flight by their numbers: { document, isOld }
    this.placing = null; // the place in flight: { n, wanted }
    this.solving = null; // the solve in flight: { n, document, options }
    connection.on("message", (message) => this.take(message));
    connection.on("open", () => this.opened());
    connection.on("closed", () => this.closed());
  }

  // Events

  /** Call `fn` after any of the events in `names`, which blanks or a list separate. */
  on(names, fn) {
    for (const name of [names].flat().join(" ").split(/\s+/)) {
      if (!this.listeners.has(name)) this.listeners.set(name, []);
      this.listeners.get(name).push(fn);
    }
  }

  emit(...names) {
    const told = new Set(); // a part that listens for several is told once
    for (const name of names) {
      for (const fn of this.listeners.get(name) ?? []) {
        if (told.has(fn)) continue;
        told.add(fn);
        fn(name);
      }
    }
  }

  // The task

  /** Change the document, and with it what is given; `gesture` is the same value for all edits that are undone as one. */
  edit(change, { gesture = null, options = this.options, picture = this.picture } = {}) {
    const next = change(this.document);
    if (next === this.document) return;
    this.history.record(this.version, gesture);
    const hasMoved = picture !== this.picture;
    Object.assign(this, { document: next, options, picture });
    this.changed();
    if (hasMoved) this.emit("picture");
  }

  /** An option of `burmester synthesize`; undefined takes it away. */
  option(name, value) {
    this.history.record(this.version, null);
    const { [name]: _, ...rest } = this.options;
    this.options = value === undefined ? rest : { ...rest, [name]: value };
    this.changed();
  }

  /** An option of `burmester export`; undefined takes it away. */
  setting(name, value) {
    this.history.record(this.version, null);
    this.settings = withKeys(this.settings, { [name]: value });
    this.emit("document");
  }

  /** Another name for the task, and for its files. */
  rename(name) {
    this.history.record(this.version, null);
    this.name = name;
    this.emit("document");
  }

  /** Which cards are shown, and in what order. */
  filter(name, value) {
    this.history.record(this.version, name);
    this.filters = { ...this.filters, [name]: value };
    this.emit("filters");
  }

  /** A picture as it was kept, whose data go to the others; null where it is none that this page made. */
  known(picture) {
    if (!picture || typeof picture.data !== "string" || !PICTURE.test(picture.data)) return null;
    const { data, ...rest } = picture, { place } = rest;
    if (![rest.width, rest.height, rest.opacity, place?.turn, place?.scale, place?.x, place?.y].every(Number.isFinite)) return null;
    this.images.set(rest.id, data);
    return rest;
  }

  /** The picture as it is kept. */
  get keptPicture() {
    return this.picture && { ...this.picture, data: this.images.get(this.picture.id) };
  }

  /** Where the picture behind the plane is, and how strong; null: none.
   * @param {any} changes @param {unknown} gesture */
  setPicture(changes, gesture = null) {
    this.history.record(this.version, gesture);
    this.picture = changes && { ...this.picture, ...changes };
    this.emit("picture");
  }

  /** Another task in place of this one: one entry, too.
   * @param {any} task */
  replace({ document, options = {}, name = this.name, settings = this.settings, picture = null, choice = null }) {
    this.history.record(this.version, null);
    this.tasks = (this.tasks ?? 0) + 1;
    this.document = document;
    this.options = options;
    this.name = name;
    this.settings = settings;
    this.wanted = choice && { ...choice, document };
    this.picture = picture?.data ? this.known(picture) : picture;
    this.selection = null;
    this.reference = 0;
    this.placed = null;
    this.task = this.tasks;
    this.changed();
    this.emit("selection", "placed", "reference", "picture");
  }

  undo() {
    this.goTo(this.history.undo(this.version));
  }

  redo() {
    this.goTo(this.history.redo(this.version));
  }

  /** Give up a gesture: the task is as it was before it. */
  abandon(gesture) {
    this.goTo(this.history.abandon(gesture));
  }

  get version() {
    const { document, options, name, settings, task, filters, picture, choice } = this;
    return { document, options, name, settings, task, filters, picture, choice };
  }

  /** The linkages that are chosen and pinned. */
  get choice() {
    return { chosen: this.chosen, pinned: [...this.pinned] };
  }

  goTo(version) {
    if (!version) return;
    const { choice, ...task } = version, isSame = task.document === this.document && task.options === this.options;
    Object.assign(this, task);
    this.emit("filters", "picture");
    this.wanted = { ...choice, document: task.document };
    if (!isSame) return this.changed();
    if (this.solvedFor === task.document) {
      this.takeWanted();
      this.showChosen();
    }
    return this.emit("document"); // the answers stay
  }

  /** After any change: follow it, and solve when the hand rests. */
  changed() {
    if (this.placed?.cognateOf) this.letCognateGo();
    this.follow(); // the server works while the page draws
    this.emit("document");
    if (this.isEmpty) this.forget();
    if (this.state !== "offline") this.setState("dragging");
    this.solveAfterRest();
  }

  // The server

  /** The linkages whose motion is wanted while dragging. */
  get shown() {
    return [...new Set([this.chosen, ...this.pinned])].filter((id) => id && id !== PLACED).slice(0, MOST_SHOWN);
  }

  follow() {
    if (!this.solved || this.flying.size >= this.mostFlying) return;
    if (!this.canFollow) {
      this.solveMeanwhile();
      return;
    }
    const { document, options, shown } = this;
    const n = this.connection.send({ do: "follow", document, options, shown });
    if (n !== null) this.flying.set(n, { document, isOld: false });
  }

  /** Whether the last answer can be followed, as far as it is known: points and paths cannot. */
  get canFollow() {
    return this.whole !== kindOf(this.document);
  }

  /** Seconds that the task took last where it cannot be followed; null where it can. */
  get slow() {
    return this.canFollow || this.seconds === undefined ? null : this.seconds;
  }

  /** What cannot be followed is solved while a hand drags, where that is quick: one at a time, the newest wins. */
  solveMeanwhile() {
    if (this.solving || this.state === "offline" || this.isEmpty || this.slow === null || this.slow > QUICK) return;
    const { document, options } = this, n = this.connection.send({ do: "solve", document, options });
    if (n !== null) this.solving = { n, document, options };
  }

  solveAfterRest() {
    clearTimeout(this.resting);
    const since = performance.now();
    const rest = () => {
      // A machine that is behind with what is followed has no time for more.
      if (this.flying.size && performance.now() - since < MOST_REST) this.resting = setTimeout(rest, REST / 3);
      else this.solve();
    };
    this.resting = setTimeout(rest, REST);
  }

  /** Run the whole search for the task as it is now; limit: seconds it may take, where they are others than usual. */
  solve(limit) {
    clearTimeout(this.resting);
    const { document, options } = this;
    if (!limit && this.solving?.document === document && this.solving.options === options) {
      this.setState("solving", ""); // it is on its way
      return;
    }
    const n = this.connection.send({ do: "solve", document, options, limit });
    if (n === null) return;
    this.solving = { n, document, options };
    this.setState("solving", "");
  }

  /** Stop the whole search; what was followed stays. */
  cancel() {
    this.connection.send({ do: "cancel" });
  }

  /** The best dyad with each of these pivots, { plane: "F" | "M", at } one or two; none: no longer. */
  place(pivots) {
    this.placeWanted = pivots?.length ? pivots : null;
    if (!this.placeWanted) {
      this.placed = null;
      this.emit("placed");
    } else if (!this.placing) {
      this.sendPlace();
    }
  }

  sendPlace() {
    const { document, options, placeWanted: pivots } = this;
    const n = this.connection.send({ do: "place", document, options, pivots });
    this.placing = n === null ? null : { n, pivots };
  }

  take(message) {
    const { n, kind } = message;
    if (kind === "ended") this.say(message.messages.map((each) => ({ tone: kind, ...each })));
    if (kind === "followed") this.takeFollowed(message);
    else if (this.flying.has(n)) this.followRefused(message);
    else if (n === this.placing?.n) this.takePlaced(message);
    else if (n === this.solving?.n || (kind === "cancelled" && this.solving && n > this.solving.n)) this.takeSolving(message);
  }

  takeFollowed(frame) {
    const asked = this.flying.get(frame.n);
    if (!asked) return;
    const { document, isOld } = asked, from = frame.from ?? (isOld ? null : this.basis);
    this.flying.delete(frame.n);
    if (this.pending && from === this.pending.n) this.install(this.pending);
    this.goOn(document); // before anything is drawn
    const isThere = document === this.solvedFor && !this.followed; // as the whole answer has it, which knows more
    if (from === this.basis && !isThere) {
      this.followed = frame;
      this.followedFor = document;
      this.emit("followed");
    }
    if (!this.flying.size && ![this.followedFor, this.solvedFor].includes(this.document)) this.follow();
  }

  /** Follow the task as it is now, if it is another than one that was followed, and none that is on its way. */
  goOn(document) {
    const asked = [document, ...[...this.flying.values()].map((each) => each.document)];
    if (!asked.includes(this.document)) this.follow();
  }

  /** What cannot be followed is solved when the hand rests. */
  followRefused({ n, kind, messages = [], solve = false, whole = false }) {
    const { document } = this.flying.get(n);
    this.flying.delete(n);
    if (kind === "refused" && !solve) this.say(messages);
    if (whole) this.whole = kindOf(document);
    this.goOn(document);
  }

  takePlaced(message) {
    const { pivots } = this.placing;
    this.placing = null;
    if (this.placeWanted && message.kind === "placed") {
      this.placed = { ...message, pivots };
      this.emit("placed");
    } else if (message.kind === "refused") {
      this.say(message.messages);
    }
    if (this.placeWanted && this.placeWanted !== pivots) this.sendPlace();
  }

  /** While a newer task is at hand, what an older search says is not told. */
  takeSolving(message) {
    const { document } = this.solving, isNow = document === this.document, isAnother = this.solvedTask !== this.task;
    if (message.kind === "progress" || message.kind === "waiting") {
      const before = `waiting for ${message.before} other${message.before === 1 ? "" : "s"}`;
      if (isNow) this.setState("solving", message.kind === "progress" ? message.text : before);
      return;
    }
    if (message.kind === "solving") return;
    this.solving = null;
    if (message.kind === "solved") {
      const answer = { ...message, document };
      if (isNow || !this.canFollow) this.install(answer);
      else this.pending = answer; // a frame that goes on from it brings it
    } else if (isAnother) {
      this.forget("There is no answer to this task yet");
    }
    if (message.kind === "refused") {
      this.say(message.messages);
    } else if (!["solved", "ended"].includes(message.kind)) {
      const [said] = [message.message].flat();
      this.say([{ tone: message.kind, ...(typeof said === "string" ? { message: said } : said) }]);
    }
    if (isNow) this.setState("resting", "");
  }

  /** Whether the task has too few poses for any linkage. */
  get isEmpty() {
    return this.document.poses.length < FEWEST;
  }

  /** No linkage of an older task stays on the page of an empty one, or of another that has no answer. */
  forget(message = NO_ANSWER.outcome.message) {
    if (!this.solved) return;
    const result = { ...this.solved, ...NO_ANSWER, outcome: { message }, space: { ...this.solved.space, quadrics: [] } };
    this.install({ n: null, result, document: this.document, seconds: null, was: undefined });
    if (this.placed) this.place([]);
  }

  /** A whole answer becomes what is shown; what was chosen goes on as the same linkage, whatever its id. */
  install({ n, result, document, seconds, was, advice = [] }) {
    const told = Object.entries(was ?? {});
    this.renamed = new Map(told.map(([now, { id }]) => [id, now]));
    this.moved = new Map(told.map(([now, { moved }]) => [now, moved]));
    // A server that was started anew finds the same linkages of the same task.
    if (!told.length && document === this.solvedFor && !this.followed) for (const { id } of result.linkages) this.renamed.set(id, id);
    const carried = (id) => (id === PLACED && this.placed?.linkage ? id : this.renamed.get(id) ?? null);
    this.isAnother = this.solvedTask !== this.task; // then nothing of the answer before is missing
    this.solved = result;
    this.advice = advice;
    this.solvedFor = document;
    this.solvedTask = this.task;
    this.seconds = seconds;
    this.basis = n;
    this.whole = null;
    this.pending = null;
    this.followed = null;
    this.followedFor = null;
    for (const each of this.flying.values()) each.isOld = true; // it may go on from the answer before
    this.chosen = carried(this.chosen) ?? result.linkages[0]?.id ?? null;
    this.pinned = new Set([...this.pinned].map(carried).filter(Boolean));
    if (this.wanted?.document === document) this.takeWanted();
    this.messages = [];
    this.emit("solved", "chosen", "pinned", "messages");
    if (document !== this.document) this.follow();
  }

  /** What was chosen of this task before it was left, as far as it is there. */
  takeWanted() {
    const { chosen, pinned = [] } = this.wanted, isThere = (id) => (id === PLACED ? Boolean(this.placed) : this.solved.linkages.some((each) => each.id === id));
    if (isThere(chosen)) this.chosen = chosen;
    this.pinned = new Set(pinned.filter(isThere));
    this.wanted = null;
  }

  /** Show a cognate in place of the linkage whose curve it traces. */
  takeCognate(linkage, of) {
    this.placeWanted = null;
    this.placed = { linkage, dyads: [], pivots: [], cost: null, messages: [], cognateOf: of };
    this.chosen = PLACED;
    this.emit("placed", "chosen");
  }

  letCognateGo() {
    const { cognateOf } = this.placed;
    this.placed = null;
    if (this.chosen === PLACED) this.chosen = cognateOf;
    this.emit("placed", "chosen");
  }

  opened() {
    this.flying.clear();
    this.solving = this.placing = null;
    this.setState("resting", "");
    this.basis = null; // the server knows nothing of what was solved before
    this.solve();
  }

  closed() {
    clearTimeout(this.resting);
    this.flying.clear();
    this.solving = this.placing = null;
    this.setState("offline", "");
  }

  setState(state, progress = "") {
    if (state === this.state && progress === this.progress) return;
    this.state = state;
    this.progress = progress;
    this.emit("state");
  }

  /** Messages in the readers' form: { code, message, where, help }; an empty list takes them away. */
  say(messages) {
    this.messages = messages;
    this.emit("messages");
  }

  // What is looked at

  choose(id) {
    if (id === this.chosen) return;
    this.history.record(this.version, "choose"); // going through the cards is one entry
    this.chosen = id;
    this.showChosen();
  }

  showChosen() {
    this.emit("chosen", "pinned");
    if (this.state === "dragging" || this.document !== this.solvedFor) this.follow();
  }

  pin(id) {
    this.history.record(this.version, null);
    if (!this.pinned.delete(id)) this.pinned.add(id);
    this.emit("pinned");
  }

  /** { kind: "pose" | "limit" | "region" | "body", index }, or null; of several poses all are in `indices`. */
  select(selection) {
    if (["kind", "index", "indices"].every((key) => String(selection?.[key]) === String(this.selection?.[key]))) return;
    this.selection = selection;
    this.emit("selection");
  }

  /** The poses that are selected: none, one or several. */
  get selectedPoses() {
    const { selection, document } = this;
    return selection?.kind === "pose" ? (selection.indices ?? [selection.index]).filter((k) => k < document.poses.length) : [];
  }

  /** Select several poses, of which one is the last that was touched. */
  selectPoses(indices, index = indices.at(-1)) {
    this.select(indices.length ? { kind: "pose", index: indices.includes(index) ? index : indices.at(-1), indices: indices.length > 1 ? indices : undefined } : null);
  }

  /** Take a pose into the selection, or out of it. */
  selectAlso(index) {
    const before = this.selectedPoses;
    this.selectPoses(before.includes(index) ? before.filter((k) => k !== index) : [...before, index], index);
  }

  /** The pose at which what belongs to the body is drawn. */
  get referenceIndex() {
    return Math.min(this.reference, this.document.poses.length - 1);
  }

  setReference(index) {
    this.reference = index;
    this.emit("reference");
  }
}
