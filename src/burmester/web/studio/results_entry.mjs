// The parts that show answers; they are made here.

/** @param {object} store @param {object} scene @param {{ player: Element, results: Element, panels: Element }} places */
export function addResults(store, scene, places) {
  places.results.textContent = "";
}
