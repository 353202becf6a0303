// The server: a key for this page, questions over HTTP, and one websocket that is opened again.

const AGAIN = [250, 500, 1000, 2000, 4000]; // milliseconds before it is tried again
const KEY = "burmester.studio.key"; // in storage, which browsers keep apart for every port, unlike cookies
const TASK = /^#t\d+=/; // in an address: a link to a task, and no token
const UNFINISHED = new Set(["solving", "progress", "waiting"]); // kinds of messages that more follow

/** Take a link to a task out of the address; "" where there is none. */
export function linkInAddress() {
  const { hash, pathname, search } = location;
  if (!TASK.test(hash)) return "";
  history.replaceState(null, "", pathname + search); // what is changed since is not undone by a reload
  return hash;
}

/** What the server refused: its messages, and the status. */
export class Refused extends Error {
  constructor(status, messages) {
    super(messages.map((each) => each.message).join(" ") || `the server answered ${status}`);
    this.status = status;
    this.messages = messages;
  }
}

async function messagesOf(response) {
  try {
    return (await response.json()).messages ?? [];
  } catch {
    return [];
  }
}

/** The one connection of a page; `decode` reads a binary frame. */
export class Connection {
  /** @type {any} */ socket;

  /** @param {(frame: ArrayBuffer) => object} decode */
  constructor(decode) {
    this.decode = decode;
    this.listeners = { message: [], open: [], closed: [] };
    this.asked = new Map(); // by n: who waits for the answer
    this.n = 0;
    this.tries = 0;
    this.socket = null;
  }

  on(name, fn) {
    this.listeners[name].push(fn);
  }

  emit(name, value) {
    for (const fn of this.listeners[name]) fn(value);
  }

  get isOpen() {
    return this.socket?.readyState === 1;
  }

  /** What opens the server: the key that this browser got last from it, in whichever tab. */
  get key() {
    try {
      return localStorage.getItem(KEY) ?? this.own;
    } catch {
      return this.own; // a browser that keeps nothing: the key of this page, until it is loaded again
    }
  }

  /** Exchange the token in the address for a key, and take it out of the address. */
  async session() {
    if (TASK.test(location.hash)) return;
    const token = decodeURIComponent(location.hash.slice(1)).replace(/^token=/, "");
    if (!token) return;
    history.replaceState(null, "", location.pathname);
    try {
      this.own = (await (await this.post("/session", { token })).json()).key;
    } catch (error) {
      if (!(error instanceof Refused) || !this.key) throw error;
      return; // the address was opened before, maybe in this browser: then the key of that time is good
    }
    try {
      localStorage.setItem(KEY, this.own);
    } catch {
      // this page alone has it
    }
  }

  async get(path) {
    return (await this.request(path, {})).json();
  }

  /** The answer as a Response: JSON or a file. */
  post(path, body, method = "POST", signal = /** @type {AbortSignal | undefined} */ (undefined)) {
    return this.request(path, { method, signal, headers: { "Content-Type": "application/json" }, body: JSON.stringify(body) });
  }

  /** Raises Refused with the server's messages; a TypeError where there is no server. */
  async request(path, options) {
    const headers = { ...options.headers, Authorization: `Bearer ${this.key}` };
    const response = await fetch(path, { credentials: "omit", ...options, headers });
    if (!response.ok) throw new Refused(response.status, await messagesOf(response));
    return response;
  }

  /** Open the websocket, and open it again whenever it ends. */
  open() {
    clearTimeout(this.timer);
    this.socket?.close();
    const socket = new WebSocket(`${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/live`, ["burmester", this.key]);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.tries = 0;
      this.emit("open");
    };
    socket.onmessage = ({ data }) => {
      if (socket === this.socket) this.take(typeof data === "string" ? JSON.parse(data) : this.decode(data));
    };
    socket.onclose = () => {
      if (socket !== this.socket) return; // another one is open
      for (const { reject } of this.asked.values()) reject(new Error("the connection ended"));
      this.asked.clear();
      this.emit("closed", this.tries);
      this.timer = setTimeout(() => this.open(), AGAIN[Math.min(this.tries, AGAIN.length - 1)]);
      this.tries += 1;
    };
  }

  /** @param {import("../widget/types").Told} message */
  take(message) {
    const waiting = this.asked.get(message.n);
    if (waiting && !UNFINISHED.has(message.kind)) {
      this.asked.delete(message.n);
      waiting.resolve(message);
    }
    this.emit("message", message);
  }

  /** Send a message; returns its number, or null where the connection is closed.
   * @param {import("../widget/types").Asked} message */
  send(message) {
    if (!this.isOpen) return null;
    this.n += 1;
    this.socket.send(JSON.stringify({ n: this.n, ...message }));
    return this.n;
  }

  /** Send a message and wait for its last answer.
   * @param {import("../widget/types").Asked} message */
  ask(message) {
    return new Promise((resolve, reject) => {
      const n = this.send(message);
      if (n === null) reject(new Error("the connection is closed"));
      else this.asked.set(n, { resolve, reject });
    });
  }
}
