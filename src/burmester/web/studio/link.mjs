// A whole task in a link: `t1=` and a code behind the # of an address.  The code is JSON, deflated, in base64url: a list
// of the document, the options, the name, and the id of the chosen linkage.  A link comes from anybody.

import { base64Of } from "./files.mjs";

const LINK = /^(?:(?:https?:\/\/[^\s#]*)?#)?t(\d+)=(.*)$/s;
const VERSION = "1";
const MOST_CHARACTERS = 20_000; // of a code
const MOST_BYTES = 200_000; // of the JSON in it

/** An error with what happened and what to do, as messages of the server have them. */
const unread = (message, help) => Object.assign(new Error(message), { messages: [{ message, help }] });

/** The code of a task, with its version.
 * @param {object} document @param {object} options @param {string} name @param {string | null} [choice] */
export async function encode(document, options, name, choice = null) {
  const text = new Blob([JSON.stringify([document, options, name, choice])]);
  const packed = text.stream().pipeThrough(new CompressionStream("deflate-raw"));
  const code = (await base64Of(await new Response(packed).blob())).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
  if (code.length > MOST_CHARACTERS || text.size > MOST_BYTES) throw unread("The task is too large for a link.", "save it, and send the file instead");
  return `t${VERSION}=${code}`;
}

/** The task in a link: { document, options, name, choice }, of which the document may still be anything.
 * Rejects with one sentence in `messages` where there is none. */
export async function decode(text) {
  const [, version, code] = LINK.exec(text.trim()) ?? [];
  if (!version) throw unread("This is no link to a task.", "a link has #t1= and a code behind it");
  if (Number(version) !== Number(VERSION)) throw unread(`The link has version ${Number(version)}, and ${VERSION} is read.`, "install the newest burmester, or ask for the task as a file");
  if (code.length > MOST_CHARACTERS) throw unread(`The link has ${code.length} characters, and ${MOST_CHARACTERS} are the most.`, "ask for the task as a file");
  const again = "copy the link once more, to its end", unfolded = await unfold(code).catch(() => null);
  if (unfolded === "") throw unread(`The link unfolds to more than ${MOST_BYTES / 1000} kB.`, "ask for the task as a file");
  if (!unfolded) throw unread("The link is damaged.", again);
  const [document, options, name, choice] = Array.isArray(unfolded) ? unfolded : [];
  if (!isObject(document)) throw unread("The link holds no task.", again);
  return { document, options: isObject(options) ? options : {}, name: name && typeof name === "string" ? name : "task", choice: typeof choice === "string" ? choice : null };
}

const isObject = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

/** The JSON of a code; "" where it is too much, which is not read to its end.  Rejects where it is damaged. */
async function unfold(code) {
  if (!/^[\w-]*$/.test(code)) throw new Error(code);
  const bytes = Uint8Array.from(atob(code.replace(/-/g, "+").replace(/_/g, "/")), (each) => each.charCodeAt(0));
  const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).getReader(), parts = [];
  for (let size = 0, next; !(next = await reader.read()).done; parts.push(next.value)) {
    size += next.value.length;
    if (size > MOST_BYTES) {
      reader.cancel();
      return "";
    }
  }
  return JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(await new Blob(parts).arrayBuffer()));
}
