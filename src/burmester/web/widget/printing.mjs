// On paper there is nothing to fold out and nothing moves: all details are open while a report is printed, and the drawing is at a pose.

/** Open the details of a report before it is printed, and close them afterwards, until the signal.
 * @param {Element} root @param {AbortSignal} signal */
export function unfoldForPrint(root, signal) {
  window.addEventListener("beforeprint", () => {
    for (const part of detailsOf(root, ":not([open])")) {
      part.open = true;
      part.dataset.opened = "";
    }
  }, { signal });
  window.addEventListener("afterprint", () => {
    for (const part of detailsOf(root, "[data-opened]")) {
      part.open = false;
      delete part.dataset.opened;
    }
  }, { signal });
}

/** Stop what moves, at the nearest pose on its way while it is printed, until the signal.
 * @param {{ u: number, linkage: unknown, stopsOnWay: { frame: number }[], play: (on: boolean) => void, go: (u: number) => void }} player @param {AbortSignal} [signal] */
export function restForPrint(player, signal) {
  let before = 0;
  window.addEventListener("beforeprint", () => {
    player.play(false);
    before = player.u;
    const [nearest] = player.linkage ? player.stopsOnWay.map(({ frame }) => frame).sort((a, b) => Math.abs(a - before) - Math.abs(b - before)) : [];
    if (nearest !== undefined) player.go(nearest);
  }, { signal });
  window.addEventListener("afterprint", () => player.go(before), { signal });
}

/** @param {Element} root @param {string} which @returns {NodeListOf<HTMLDetailsElement>} */
const detailsOf = (root, which) => root.querySelectorAll(`details${which}`);
