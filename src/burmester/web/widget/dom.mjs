// Elements of HTML and SVG, made in one call: tag, attributes, children.

const SVG = "http://www.w3.org/2000/svg";

/** @typedef {Record<string, any> | null | undefined} Attributes what an element is given, by name */

/** @template {Element} E @param {E} node @param {Attributes} attributes @param {any[]} children */
function furnish(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

/** @param {string} tag @param {Attributes} [attributes] @param {any[]} children @returns {any} */
export const h = (tag, attributes, ...children) => furnish(document.createElement(tag), attributes, children);
/** @param {string} tag @param {Attributes} [attributes] @param {any[]} children @returns {any} */
export const s = (tag, attributes, ...children) =>
  furnish(document.createElementNS(SVG, tag), attributes, children);

/** An attribute, set only where it differs: a browser looks anew at whatever is written, changed or not.
 * @param {Element} node @param {string} name @param {unknown} value */
export function put(node, name, value) {
  const text = String(value);
  if (node.getAttribute(name) !== text) node.setAttribute(name, text);
}

/** A property such as value, hidden or checked, set only where it differs: of a field or a button that was written a
 * browser goes through every field of the page.
 * @param {any} node @param {string} name @param {unknown} value */
export function give(node, name, value) {
  const next = typeof node[name] === "boolean" ? Boolean(value) : String(value);
  if (node[name] !== next) node[name] = next;
}

/** The text of an element, set only where it differs: a page that is read aloud, and one that is drawn, are left alone.
 * @param {Element} node @param {unknown} text */
export function say(node, text) {
  const next = String(text);
  if (node.textContent !== next) node.textContent = next;
}

/** A colour of a style sheet, #rrggbb, as three numbers from 0 to 255.
 * @param {string} text */
export function rgb(text) {
  const hex = text.trim().replace("#", "");
  return [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));
}
