// What would make a linkage usable, without the names of the command's options.

const OPTIONS = [
  [/--min-transmission ([\d.e+-]+)/g, "a least transmission angle of $1°"],
  [/--within-angle ([\d.e+-]+)/g, "a permitted turn of $1°"],
  [/--within ([\d.e+-]+)/g, "a permitted miss of $1"],
  [/--link-ratio ([\d.e+-]+)/g, "a link ratio of $1"],
  [/--type "([^"]+)"/g, "the type $1"],
  [/--type (\S+)/g, "the type $1"],
  [/--driver any/g, "either driver"],
  [/--any-order/g, "any order of the poses"],
];

/** A sentence of `hints` for the page: options as what they ask for.
 * @param {string} text */
export function helpInWords(text) {
  const marked = OPTIONS.reduce((said, [option, words]) => said.replace(option, `\u0001${words}\u0002`), text);
  const plain = marked.replaceAll("\u0002 \u0001", " and ").replaceAll(/[\u0001\u0002]/g, "");
  return plain.replace(/with (.+?) (L\d+) would do/g, "it would do with $1");
}
