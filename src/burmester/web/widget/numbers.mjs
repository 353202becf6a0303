// Numbers as people read them, and the small arithmetic that every module needs.

/** @param {number} value @param {number} low @param {number} high */
export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
/** @param {number} angle */
export const degrees = (angle) => (angle * 180) / Math.PI;
/** @param {number} angle */
export const radians = (angle) => (angle * Math.PI) / 180;
/** A length in pixels, as an attribute holds it: five decimals, and within what a browser draws.
 * @param {number} value */
export const px = (value) => (Math.abs(value) < 1e7 ? +value.toFixed(5) : Math.sign(value) * 1e7);

/** A number with this number of decimals, without a sign where it rounds to zero.
 * @param {number | null | undefined} value @param {number} digits */
export function fixed(value, digits) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

/** A figure with two digits, as `figure` of burmester/wording.py writes it, but for exact ties.
 * @param {number | null} value */
export function figure(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  if (Math.abs(value) >= 99.5 && Math.abs(value) < 1e6) return value.toFixed(0);
  const rounded = value.toExponential(1), [digits, power] = rounded.split("e").map(Number);
  if (power >= -4 && power < 2) return String(Number(rounded));
  if (power > 0) return `${digits}e${power}`;
  return `${digits}e-${String(-power).padStart(2, "0")}`;
}

/** A length in spans of the motion: "1 span", "1.6 spans".
 * @param {number | null} extent */
export const spans = (extent) => `${figure(extent)} span${figure(extent) === "1" ? "" : "s"}`;

/** Round numbers between two ends for an axis, `about` of them.
 * @param {number} low @param {number} high @param {number} about */
export function ticks(low, high, about) {
  const rough = (high - low) / Math.max(1, about);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((each) => each >= rough * 0.999) ?? 10 * power;
  const digits = Math.max(0, -Math.floor(Math.log10(step * 1.0001)));
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k += 1) {
    marks.push({ at: k * step, text: fixed(k * step, digits) });
  }
  return marks;
}

/** The same for an axis in degrees.
 * @param {number} low @param {number} high @param {number} about */
export function angleTicks(low, high, about) {
  const step = [5, 10, 15, 30, 45, 60, 90, 180].find((each) => (high - low) / each <= about) ?? 360;
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-6; k += 1) {
    marks.push({ at: k * step, text: `${fixed(k * step, 0)}°` });
  }
  return marks.length > 1 ? marks : ticks(low, high, about).map((t) => ({ ...t, text: `${t.text}°` }));
}

/** Words as a list: "a, b and c".
 * @param {string[]} words */
export function listed(words) {
  if (words.length < 2) return words.join("");
  return `${words.slice(0, -1).join(", ")} and ${words[words.length - 1]}`;
}

/** The names of numbers that count from 1, runs drawn together: "1–4 and 7".
 * @param {number[]} numbers @param {string[]} names */
export function runs(numbers, names) {
  const parts = [];
  for (let k = 0; k < numbers.length; ) {
    let end = k;
    while (end + 1 < numbers.length && numbers[end + 1] === numbers[end] + 1) end += 1;
    if (end - k >= 2) parts.push(`${names[numbers[k] - 1]}–${names[numbers[end] - 1]}`);
    else for (let i = k; i <= end; i += 1) parts.push(names[numbers[i] - 1]);
    k = end + 1;
  }
  return listed(parts);
}
