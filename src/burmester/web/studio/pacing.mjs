// Work that may lag behind the hand: done soon, not at every picture, and never most of the time.

const LEAST = 250; // milliseconds between two times: nobody reads faster, and every time the page is laid out anew
const SHARE = 8; // the pause after work is so many times as long as the work

/** `ask` has `work` done, at once where it rested long enough; asked again meanwhile, it is done once more afterwards. */
export class Pace {
  /** @type {any} */ timer;

  /** @param {() => void} work @param {() => boolean} [wanted] asked before the work; what is not wanted is not done */
  constructor(work, wanted = () => true) {
    this.work = work;
    this.wanted = wanted;
    this.free = 0; // when it may be done again
    this.timer = null;
    paces.add(this);
  }

  ask() {
    if (this.timer !== null || !this.wanted()) return;
    this.timer = setTimeout(() => this.now(), Math.max(0, this.free - performance.now()));
  }

  /** Do at once what was asked for. */
  catchUp() {
    if (this.timer !== null) this.now();
  }

  now() {
    clearTimeout(this.timer);
    this.timer = null;
    const start = performance.now();
    this.work();
    const end = performance.now();
    this.free = end + Math.max(LEAST, SHARE * (end - start));
  }
}

/** @type {WeakMap<Element, unknown[]>} */
const shown = new WeakMap();

/** Whether an element shows other facts than at the last call: what shows the same ones need not be drawn again.
 * @param {Element} element @param {unknown[]} facts */
export function isOther(element, facts) {
  const before = shown.get(element);
  shown.set(element, facts);
  return before?.length !== facts.length || facts.some((fact, k) => !Object.is(fact, before[k]));
}

/** @type {WeakMap<Element, boolean>} */
const sights = new WeakMap(); // whether an element is in the window, as the browser tells: asking it costs a layout
/** @type {WeakMap<Element, () => void>} */
const callers = new WeakMap();
/** @type {IntersectionObserver | null} */
let observer = null;

/** Watch whether an element can be seen: not folded away, and within the window; `fn` is called when it comes into sight.
 * @param {Element} element @param {() => void} fn */
export function watch(element, fn) {
  observer ??= new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      sights.set(target, isIntersecting);
      if (isIntersecting) callers.get(target)?.();
    }
  });
  callers.set(element, fn);
  observer.observe(element);
}

/** Whether an element that is watched can be seen, in the window or on paper.
 * @param {Element} element */
export const isSeen = (element) => printing || sights.get(element) === true;

/** @type {Set<Pace>} */
const paces = new Set();
let printing = false;

/** On paper everything is seen: what lags behind is done before. */
export function catchUpForPrint() {
  addEventListener("beforeprint", () => {
    printing = true;
    for (const pace of paces) if (pace.wanted()) pace.now();
  });
  addEventListener("afterprint", () => (printing = false));
}
