// Numbers as people type them: with a unit, with a decimal comma, with a typographic minus sign.

const LENGTHS = { // in metres
  µm: 1e-6, um: 1e-6, mm: 1e-3, cm: 1e-2, m: 1, in: 0.0254, inch: 0.0254, '"': 0.0254, "″": 0.0254, ft: 0.3048, "'": 0.3048, "′": 0.3048,
};
const ANGLES = { "°": 1, deg: 1, degree: 1, degrees: 1, rad: 180 / Math.PI, mrad: 0.18 / Math.PI }; // in degrees
const WRITTEN = /^([+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:e[+-]?\d+)?)\s*(.*)$/i;
const DIGITS = 12; // significant digits of a number that was converted
const GREATEST = 1e300; // what arithmetic on a page survives

/** A number without the noise of a conversion in its last digits. */
export const tidy = (value) => Number(value.toPrecision(DIGITS));

/** A number as a field shows it: the fewest digits that say it. */
export const written = (value) => (value === undefined || value === null ? "" : String(value).replace("-", "−").replace("e−", "e-"));

/** What a text says: { value } in the unit of the task (lengths) or in degrees (angles), or { fault }, a sentence.
 *
 * kind: "length", "angle" or "number"; unit: the task's unit of length, if it has one; least, above, below: what the value may be;
 * whole: whether it is a whole number; optional: whether nothing may stand there, which is the value undefined;
 * many: whether they are several with commas between them, which stay a text.
 * @returns {{ value?: any, fault?: string }}
 */
export function quantity(text, { kind = "number", unit = "", optional = false, many = false, least = -Infinity, above = -Infinity, below = Infinity, whole = false } = {}) {
  const plain = text.normalize("NFKC").replace(/[−–]/g, "-").replace(/[\u00a0\u2009\u202f]/g, " ").trim();
  const example = { length: unit in LENGTHS ? `12.5 or 0.5 in` : "12.5", angle: "30 or 0.5 rad", number: "12.5" }[kind];
  if (many && plain) {
    const all = text.split(/[,;]/).map((each) => quantity(each, { kind, unit, least, above, below, whole })), wrong = all.find(({ fault }) => fault);
    return wrong ?? { value: all.map(({ value }) => value).join(",") };
  }
  if (!plain) return optional ? { value: undefined } : { fault: `A number is missing here: write one such as ${example}.` };
  const found = WRITTEN.exec(plain);
  if (!found) return { fault: `“${text.trim()}” is not a number: write one such as ${example}.` };
  const number = Number(found[1].replace(",", ".")), name = found[2].trim().replace(/^μm$/, "µm");
  const factor = factorOf(name, kind, unit);
  if (typeof factor === "string") return { fault: factor };
  const value = factor === 1 ? number : tidy(number * factor);
  if (!(Math.abs(value) <= GREATEST)) return { fault: `${text.trim()} is too large a number.` };
  const shown = kind === "angle" ? "°" : kind === "length" && unit ? ` ${unit}` : "";
  if (whole && !Number.isInteger(value)) return { fault: `This has to be a whole number, such as ${Math.max(1, Math.round(value))}.` };
  if (value < least) return { fault: `This may not be less than ${least}${shown}.` };
  if (value <= above) return { fault: `This must be greater than ${above}${shown}.` };
  if (value >= below) return { fault: `This must be less than ${below}${shown}.` };
  return { value };
}

/** What a number with a unit is multiplied by; or a sentence that says why it cannot be. */
function factorOf(name, kind, unit) {
  if (!name || (kind === "length" && name === unit)) return 1;
  if (kind === "number") return `“${name}” is not needed here: write the number alone.`;
  const units = kind === "angle" ? ANGLES : LENGTHS, known = name in units ? name : name.toLowerCase();
  if (!Object.hasOwn(units, known)) {
    const usual = kind === "angle" ? "° or rad" : "mm, cm, m, in or ft";
    return `“${name}” is not a unit of ${kind} known here: write ${usual}, or the number alone.`;
  }
  if (kind === "angle") return units[known];
  if (!Object.hasOwn(LENGTHS, unit)) return `This task has ${unit ? `the unit ${unit}` : "no unit of length"}: write the number alone.`;
  return units[known] / LENGTHS[unit];
}
