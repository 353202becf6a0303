// The kernel: what `src/burmester/notebook/pages.py` is asked and tells, by messages of the widget's model.

import { decodeFrame } from "../studio/frames.mjs";

const PATIENCE = 1500; // milliseconds until a kernel that says nothing is called busy

/** The connection of one view, as the store takes it. */
export class Kernel {
  constructor(model) {
    this.model = model;
    this.view = Math.random().toString(36).slice(2); // several views of a widget share its messages
    this.listeners = { message: [], open: [], closed: [], told: [], busy: [] };
    this.n = 0;
    this.waiting = null;
    this.heard = (message, buffers) => this.take(message, buffers);
    model.on("msg:custom", this.heard);
  }

  /** "message": with an answer; "told": with what the kernel says unasked; "open": it is asked for the first time;
   * "busy": whether it has said nothing for long. */
  on(name, fn) {
    this.listeners[name].push(fn);
  }

  emit(name, value) {
    for (const fn of this.listeners[name]) fn(value);
  }

  take(message, buffers = []) {
    if (message.view !== null && message.view !== this.view) return;
    this.rest();
    if (message.n === undefined) this.emit("told", message);
    else this.emit("message", message.kind === "followed" ? decodeFrame(bytesOf(buffers[0])) : message);
  }

  /** Send a message; returns its number. */
  send(message) {
    this.n += 1;
    if (message.do !== "choose") this.waiting ??= setTimeout(() => this.emit("busy", true), PATIENCE);
    this.model.send({ view: this.view, n: this.n, ...message });
    return this.n;
  }

  /** It has said something. */
  rest() {
    clearTimeout(this.waiting);
    this.waiting = null;
    this.emit("busy", false);
  }

  close() {
    clearTimeout(this.waiting);
    this.model.off("msg:custom", this.heard);
  }
}

/** A buffer of its own, whose first byte is the first of the frame. */
function bytesOf(data) {
  return data instanceof ArrayBuffer ? data : data.buffer.slice(data.byteOffset, data.byteOffset + data.byteLength);
}
