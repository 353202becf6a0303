// On paper there is nothing to fold out: all details are open while a report is printed.

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

/** @param {Element} root @param {string} which @returns {NodeListOf<HTMLDetailsElement>} */
const detailsOf = (root, which) => root.querySelectorAll(`details${which}`);
