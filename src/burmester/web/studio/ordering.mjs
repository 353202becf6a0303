// Which linkages are shown, and in which order: pure functions over what is known of them.

/** What cards are sorted by: the name, and a number that is the smaller the better.
 * @type {Record<string, { name: string, of: (linkage: any) => number }>} */
export const ORDERS = {
  rank: { name: "best first", of: (linkage) => linkage.rank ?? Infinity },
  worst: { name: "worst miss", of: (linkage) => linkage.worst ?? Infinity },
  least: { name: "transmission angle", of: (linkage) => -(linkage.least ?? -1) },
  size: { name: "size", of: (linkage) => linkage.quality?.extent ?? Infinity },
  sensitivity: { name: "sensitivity", of: (linkage) => linkage.quality?.sensitivity ?? Infinity },
};

/** Which of them are shown: the name, and whether one is; `pinned` is a set of ids.
 * @type {Record<string, { name: string, holds: (linkage: any, pinned: Set<string>) => boolean }>} */
export const FILTERS = {
  all: { name: "all", holds: () => true },
  usable: { name: "usable", holds: (linkage) => linkage.usable },
  pinned: { name: "pinned", holds: (linkage, pinned) => pinned.has(linkage.id) },
};

/** The linkages to show, pinned ones first; equal ones keep their order.
 * @param {any[]} linkages @param {{ order: string, filter: string, type: string, pinned: Set<string> }} wanted */
export function arranged(linkages, { order, filter, type, pinned }) {
  const { of } = ORDERS[order], { holds } = FILTERS[filter];
  return linkages
    .filter((each) => holds(each, pinned) && (!type || each.type === type))
    .map((each, k) => ({ each, k, key: of(each) }))
    .sort((a, b) => Number(pinned.has(b.each.id)) - Number(pinned.has(a.each.id)) || (a.key === b.key ? 0 : a.key - b.key) || a.k - b.k)
    .map(({ each }) => each);
}
