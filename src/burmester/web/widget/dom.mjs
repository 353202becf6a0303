// Elements of HTML and SVG, made in one call: tag, attributes, children.

const SVG = "http://www.w3.org/2000/svg";

function furnish(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

export const h = (tag, attributes, ...children) => furnish(document.createElement(tag), attributes, children);
export const s = (tag, attributes, ...children) =>
  furnish(document.createElementNS(SVG, tag), attributes, children);

/** A colour of a style sheet, #rrggbb, as three numbers from 0 to 255. */
export function rgb(text) {
  const hex = text.trim().replace("#", "");
  return [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));
}
