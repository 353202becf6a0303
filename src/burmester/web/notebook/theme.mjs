// Style sheets that follow the notebook, whose theme is its own and need not be that of the browser.

const DARK_SCHEME = "(prefers-color-scheme: dark)";
const REM = 16; // pixels: a notebook may have another size at its root
const LATE = 400; // milliseconds: a notebook may load the colours of another theme after it says so

/** The styles of a shadow root, from texts; `signal` ends them. */
export function dress(root, texts, signal) {
  const sheets = texts.map((text) => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(text.replace(/([\d.]+)rem\b/g, (_, size) => `${REM * size}px`));
    return sheet;
  });
  const dark = sheets.flatMap(({ cssRules }) => [...cssRules]).filter((rule) => rule.media?.mediaText === DARK_SCHEME);
  const follow = () => {
    const on = isDark(root.host);
    for (const rule of dark) rule.media.mediaText = on ? "all" : "not all";
    root.host.style.colorScheme = on ? "dark" : "light";
  };
  const both = () => {
    follow();
    setTimeout(follow, LATE);
  };
  const seen = new MutationObserver(both);
  for (const element of [document.documentElement, document.body]) seen.observe(element, { attributes: true });
  matchMedia(DARK_SCHEME).addEventListener("change", both, { signal });
  const placed = new ResizeObserver(follow); // once it is in the page
  placed.observe(root.host);
  signal.addEventListener("abort", () => [seen, placed].forEach((each) => each.disconnect()));
  root.adoptedStyleSheets = sheets;
  both();
}

/** Whether what stands behind an element is dark. */
function isDark(element) {
  for (let node = element; node; node = node.parentElement ?? node.getRootNode().host) {
    const colour = getComputedStyle(node).backgroundColor; // empty where the element is in no page yet
    const [r, g, b, a = 1] = colour.startsWith("rgb") ? (colour.match(/[\d.]+/g) ?? []).map(Number) : [0, 0, 0, 0];
    if (a > 0.5) return 0.299 * r + 0.587 * g + 0.114 * b < 128;
  }
  return matchMedia(DARK_SCHEME).matches;
}
