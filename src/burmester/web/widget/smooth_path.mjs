// A smooth path through the frames of a way, as few pieces as there are frames.

/** @param {number} value */
const hundredths = (value) => Math.round(Math.min(Math.max(value, -1e6), 1e6) * 100) / 100;

/** Cubic curves of Catmull and Rom through points given in pixels, X[k], Y[k]; closed: the last point is the first.
 * @param {import("./types").Values} X @param {import("./types").Values} Y @param {boolean} closed */
export function smoothPath(X, Y, closed) {
  const last = X.length - 1;
  if (last < 1) return "";
  /** @param {import("./types").Values} values @param {number} k */
  const ahead = (values, k) => (k < last ? values[k + 1] : closed ? values[1] : 2 * values[last] - values[last - 1]);
  /** @param {import("./types").Values} values @param {number} k */
  const behind = (values, k) => (k > 0 ? values[k - 1] : closed ? values[last - 1] : 2 * values[0] - values[1]);
  let d = `M${hundredths(X[0])} ${hundredths(Y[0])}`;
  let [u, v] = [(ahead(X, 0) - behind(X, 0)) / 6, (ahead(Y, 0) - behind(Y, 0)) / 6];
  for (let k = 0; k < last; k += 1) {
    const p = (ahead(X, k + 1) - X[k]) / 6, q = (ahead(Y, k + 1) - Y[k]) / 6;
    d += `C${hundredths(X[k] + u)} ${hundredths(Y[k] + v)} ${hundredths(X[k + 1] - p)} ${hundredths(Y[k + 1] - q)} ${hundredths(X[k + 1])} ${hundredths(Y[k + 1])}`;
    [u, v] = [p, q];
  }
  return d;
}
