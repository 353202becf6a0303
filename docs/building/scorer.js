/* Which page comes first in the search: the glossary, then what a user does, then how the code is built. */
/* `var`: searchtools.js declares it once more. */
var rankOfPage = (name) =>
  name === "glossary" ? 30 : /^(project|reference\/modules|choices)/.test(name) ? -20 : 0;

var Scorer = {
  score: ([docname, , , , score]) => score + rankOfPage(docname),
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
