// Made by scripts/bundle from src/burmester/web/widget: change those files, not this one.

// src/burmester/web/widget/dom.mjs
var SVG = "http://www.w3.org/2000/svg";
function furnish(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === void 0 || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== void 0));
  return node;
}
var h = (tag, attributes, ...children) => furnish(document.createElement(tag), attributes, children);
var s = (tag, attributes, ...children) => furnish(document.createElementNS(SVG, tag), attributes, children);
function put(node, name, value) {
  const text = String(value);
  if (node.getAttribute(name) !== text) node.setAttribute(name, text);
}
function give(node, name, value) {
  const next = typeof node[name] === "boolean" ? Boolean(value) : String(value);
  if (node[name] !== next) node[name] = next;
}
function say(node, text) {
  const next = String(text);
  if (node.textContent !== next) node.textContent = next;
}
function rgb(text) {
  const hex = text.trim().replace("#", "");
  return [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));
}

// src/burmester/web/widget/numbers.mjs
var clamp = (value, low, high) => Math.min(Math.max(value, low), high);
var degrees = (angle) => angle * 180 / Math.PI;
var radians = (angle) => angle * Math.PI / 180;
var px = (value) => Math.abs(value) < 1e7 ? +value.toFixed(5) : Math.sign(value) * 1e7;
function fixed(value, digits) {
  if (value === null || value === void 0 || !Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}
function figure(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  if (Math.abs(value) >= 99.5 && Math.abs(value) < 1e6) return value.toFixed(0);
  const rounded = value.toExponential(1), [digits, power] = rounded.split("e").map(Number);
  if (power >= -4 && power < 2) return String(Number(rounded));
  if (power > 0) return `${digits}e${power}`;
  return `${digits}e-${String(-power).padStart(2, "0")}`;
}
function ticks(low, high, about) {
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
function angleTicks(low, high, about) {
  const step = [5, 10, 15, 30, 45, 60, 90, 180].find((each) => (high - low) / each <= about) ?? 360;
  const marks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-6; k += 1) {
    marks.push({ at: k * step, text: `${fixed(k * step, 0)}°` });
  }
  return marks.length > 1 ? marks : ticks(low, high, about).map((t) => ({ ...t, text: `${t.text}°` }));
}
function listed(words) {
  if (words.length < 2) return words.join("");
  return `${words.slice(0, -1).join(", ")} and ${words[words.length - 1]}`;
}
function runs(numbers, names) {
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

// src/burmester/web/widget/tables.mjs
var MOST_NAMES = 24;
var NAME_STEP = 5;
var MOST_ROWS = 40;
var NONE = "–";
function table(caption, heads, rows, attributes) {
  return h(
    "div",
    { class: "bm-scroll", tabindex: "0", role: "region", "aria-label": caption },
    h(
      "table",
      attributes,
      h("caption", {}, caption),
      h("thead", {}, h("tr", {}, heads.map((head) => h("th", { scope: "col", class: head.text ? "bm-words" : null }, head.name ?? head)))),
      h("tbody", {}, rows)
    )
  );
}
function longTable(caption, heads, rows, attributes) {
  const first = table(caption, heads, rows.slice(0, MOST_ROWS), attributes), others = rows.slice(MOST_ROWS);
  if (!others.length) return first;
  return h("div", { class: "bm-long" }, first, h("details", { class: "bm-every" }, h("summary", {}, `${others.length} more`), table(`${caption}, from ${MOST_ROWS + 1}`, heads, others, attributes)));
}
var cells = (values, words = [], heads = []) => values.map(
  (value, k) => k === 0 ? h("th", { scope: "row" }, value) : h("td", { class: classes(words.includes(k) && "bm-words", (value ?? NONE) === NONE && "bm-none"), "data-head": heads[k]?.name ?? heads[k] }, value ?? NONE)
);
var classes = (...names) => names.filter(Boolean).join(" ") || null;
var UNIT_NAMES = { in: "inches", ft: "feet" };
var inUnit = (data) => data.unit ? `, in ${UNIT_NAMES[data.unit] ?? data.unit}` : "";
var unitOf = (data) => data.unit ? ` (${data.unit})` : "";
var decimalsOf = (data) => clamp(4 - Math.ceil(Math.log10(data.scene)), 0, 12);
var poseName = (pose) => pose.label === pose.name ? pose.name : `${pose.label}: ${pose.name}`;
var isPoint = (pose) => pose.angle_deg === null;
var nounOf = ({ poses, stop = void 0 }) => stop ?? (poses.length && poses.every(isPoint) ? "point" : "pose");
var isNamed = ({ path, poses }, k) => !path || poses.length <= MOST_NAMES || k === 0 || (k + 1) % NAME_STEP === 0;
var calledOf = (pose) => pose.called ?? `${isPoint(pose) ? "point" : "pose"} ${poseName(pose)}`;
var shortened = (text, most) => text.length > most ? `${text.slice(0, most - 1).trimEnd()}…` : text;
function missOf(position, angle, unit2) {
  if (position === "-") return "–";
  const [away, ...share] = position.split(" (");
  const length = [away === "exact" ? away : `${away}${unit2}`, ...share].join(" (");
  return angle === "free" || position === "exact" && angle === "exact" ? length : `${length} and ${angle}`;
}
function dyadTable(data) {
  const misses = data.poses.some(isPoint) ? [] : ["rms miss", "worst miss"];
  const heads = ["", { name: "kind", text: true }, "on the ground (F)", "on the body (M)", `length${unitOf(data)}`, ...misses];
  const rows = data.dyads.map(
    (dyad) => h("tr", {}, cells([dyad.id, dyad.kind, dyad.said.ground, dyad.said.body, dyad.said.length, ...misses.length ? [dyad.said.rms, dyad.said.worst] : []], [1], heads))
  );
  return longTable(data.dyads_title, heads, rows, { class: "bm-stacks" });
}
function worded(data, { caption, heads, words = [], rows, ...how }) {
  const named = heads.map((name, k) => words.includes(k) ? { name, text: true } : name);
  const lines = (cell) => Array.isArray(cell) ? cell.map((part) => h("span", { class: "bm-line-of" }, part)) : cell;
  const made = longTable(caption + (how.lengths ? inUnit(data) : ""), named, rows.map((row) => h("tr", {}, cells(row.map(lines), words, named))), { class: how.class });
  return how.folded ? h("details", { class: "bm-every" }, h("summary", {}, how.folded), made) : made;
}
function dimensionRows(linkage) {
  const uncertain = linkage.said.dimensions.some((row) => row.give);
  let last = null;
  return linkage.said.dimensions.map((row) => {
    const name = row.dyad === last ? "" : row.dyad;
    last = row.dyad;
    const side = linkage.led.findIndex((dyad) => dyad.id === row.dyad);
    return h(
      "tr",
      {},
      h("th", { scope: "row", class: name ? `bm-side${side}` : null }, name),
      h("td", { class: "bm-words" }, row.what),
      h("td", {}, row.value),
      uncertain ? h("td", {}, row.give) : null
    );
  });
}
function dimensionTable(data, linkage) {
  return table(
    `Dimensions of ${linkage.id}${inUnit(data)}`,
    ["", { name: "", text: true }, "value", ...linkage.said.dimensions.some((row) => row.give) ? ["± (95 %)"] : []],
    dimensionRows(linkage),
    { class: "bm-dimensions" }
  );
}
var numbersOf = (data, linkage) => linkage.tables?.map((each) => worded(data, each)) ?? [dimensionTable(data, linkage)];
function poseTable(data, linkage) {
  const digits = decimalsOf(data), unit2 = unitOf(data), noun = nounOf(data), turned = noun !== "point";
  const ifTurned = (value) => turned ? [value] : [];
  const heads = [noun, `wanted x`, `y${unit2}`, ...ifTurned("angle")];
  if (linkage) heads.push("body x", `y${unit2}`, "angle", "off by", ...ifTurned("turned by"), ...linkage.columns?.map(([head]) => head) ?? ["transm."], { name: "where", text: true });
  const rows = data.poses.map((pose, k) => {
    const values = [
      poseName(pose) + (pose.exact ? " (exact)" : ""),
      fixed(pose.x, digits),
      fixed(pose.y, digits),
      ...ifTurned(isPoint(pose) ? "free" : `${fixed(pose.angle_deg, 2)}°`)
    ];
    if (linkage) {
      const row = linkage.pose_errors[k];
      values.push(
        fixed(row.x, digits),
        fixed(row.y, digits),
        row.angle_deg === null ? "–" : `${fixed(row.angle_deg, 2)}°`,
        row.said.position,
        ...ifTurned(row.said.turned),
        ...linkage.columns?.map(([, texts]) => texts[k]) ?? [row.said.transmission],
        row.way === null ? "–" : wayName(linkage.ways[row.way], linkage)
      );
    }
    return h("tr", { "data-pose": k + 1 }, cells(values, [heads.length - 1]));
  });
  const what = turned ? "Poses" : "Points";
  return table(linkage ? `${what}, and where ${linkage.id} takes the body` : what, heads, rows, { class: data.poses.some((pose) => pose.label !== pose.name) ? "bm-pose-table bm-named" : "bm-pose-table" });
}
function imageTables(data, linkage) {
  const digits = decimalsOf(data);
  const rows = data.poses.filter((pose) => !isPoint(pose)).map((pose) => {
    const c = Math.cos(pose.angle_deg * Math.PI / 360), d = Math.sin(pose.angle_deg * Math.PI / 360);
    const z = [(pose.x * d - pose.y * c) / 2, (pose.x * c + pose.y * d) / 2, d, c];
    return h("tr", {}, cells([pose.label, ...z.map((value, k) => fixed(value, k < 2 ? digits : 5))]));
  });
  const points = rows.length ? [table(`Image points of the poses${unitOf(data)}, Z3² + Z4² = 1`, ["pose", "Z1", "Z2", "Z3", "Z4"], rows)] : [];
  if (!linkage) return points;
  const surfaces = linkage.led.map((dyad, k) => h("tr", {}, cells([dyad.id, ...linkage.said.manifolds[k]])));
  const heads = ["", ...[1, 2, 3, 4, 5, 6, 7, 8].map((k) => `p${k}`)];
  const caption = "Surfaces: p1 (Z1² + Z2²) + p2 Z3² + p3 Z1 Z3 + p4 Z2 Z3 + p5 Z1 Z4 + p6 Z2 Z4 + p7 Z3 Z4 + p8 Z4² = 0";
  return [...points, table(caption, heads, surfaces)];
}
function provedOf({ certificate }) {
  const rows = certificate ? [["Proved, of all digits, for the poses as given", certificate.proved], ["Computed, not proved", certificate.numerical]] : [];
  return rows.filter(([, lines]) => lines.length).map(([head, lines]) => h("div", { class: "bm-proved" }, h("b", {}, head), h("ul", {}, lines.map((line) => h("li", {}, line)))));
}
function wayName(way, linkage) {
  const circuits = new Set(linkage.ways.map((each) => each.circuit)).size;
  const parts = [];
  if (circuits > 1 || way.branches < 2) parts.push(`assembly ${way.circuit}`);
  if (way.branches > 1) parts.push(`branch ${way.branch}`);
  return parts.join(", ");
}

// src/burmester/web/widget/drawing.mjs
var AXIS = 26;
var BLOCK = [22, 14];
var transform = (x, y, angle) => `translate(${px(x)} ${px(y)}) rotate(${px(degrees(-angle))})`;
function foot() {
  let hatch = "";
  for (let k = -2; k <= 2; k += 1) hatch += `M${5.5 * k + 3} 16l-6 7`;
  return s(
    "g",
    { class: "bm-foot" },
    s("path", { class: "bm-solid", d: "M0 0L-10 16H10Z" }),
    s("path", { class: "bm-ground", d: `M-16 16H16${hatch}` })
  );
}
function axes(length) {
  const l = length, head = Math.max(4, 0.22 * length);
  return `M0 0H${l}m${-head} ${-head / 2}l${head} ${head / 2}l${-head} ${head / 2}M0 0V${-0.6 * l}`;
}
function polyline(points, view) {
  let path = "", pen = "M";
  for (const [x, y] of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      pen = "M";
      continue;
    }
    path += `${pen}${px(view.X(x))} ${px(view.Y(y))}`;
    pen = "L";
  }
  return path;
}
function hull(points) {
  const sorted = [...points].sort((p, q) => p[0] - q[0] || p[1] - q[1]);
  const half = (list) => {
    const kept = [];
    for (const point of list) {
      while (kept.length > 1) {
        const [a, b] = kept.slice(-2);
        if ((b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) > 0) break;
        kept.pop();
      }
      kept.push(point);
    }
    return kept.slice(0, -1);
  };
  const corners = [...half(sorted), ...half(sorted.reverse())];
  return corners.length ? corners : sorted.slice(0, 1);
}

// src/burmester/web/widget/kinematics.mjs
function act(place, [x, y]) {
  const c = Math.cos(place.a), d = Math.sin(place.a);
  return [place.x + c * x - d * y, place.y + d * x + c * y];
}
function back(place, [x, y]) {
  const c = Math.cos(place.a), d = Math.sin(place.a);
  return [c * (x - place.x) + d * (y - place.y), -d * (x - place.x) + c * (y - place.y)];
}
var normalOf = (dyad) => {
  const angle = radians(dyad.line.normal_deg);
  return [Math.cos(angle), Math.sin(angle)];
};
function constraint(dyad, place) {
  if (dyad.kind === "PP") {
    const away = place.a - radians(dyad.angle_deg);
    return [away - 2 * Math.PI * Math.round(away / (2 * Math.PI)), 0, 0, 1];
  }
  if (dyad.kind === "RP") {
    const [nx2, ny2] = normalOf(dyad);
    const c = Math.cos(place.a), d = Math.sin(place.a);
    const tx = c * nx2 - d * ny2, ty = d * nx2 + c * ny2;
    const ax = dyad.fixed_pivot[0] - place.x, ay = dyad.fixed_pivot[1] - place.y;
    return [tx * ax + ty * ay - dyad.line.offset, -tx, -ty, tx * ay - ty * ax];
  }
  const [x, y] = act(place, dyad.moving_pivot);
  let nx, ny, residual;
  if (dyad.kind === "RR") {
    const ax = x - dyad.fixed_pivot[0], ay = y - dyad.fixed_pivot[1];
    const size = Math.hypot(ax, ay) || 1;
    [nx, ny, residual] = [ax / size, ay / size, size - dyad.radius];
  } else {
    [nx, ny] = normalOf(dyad);
    residual = nx * x + ny * y - dyad.line.offset;
  }
  return [residual, nx, ny, (x - place.x) * ny - (y - place.y) * nx];
}
function project(dyads, place, length) {
  let { x, y, a } = place;
  for (let step = 0; step < 4; step += 1) {
    const [f, ...p] = constraint(dyads[0], { x, y, a });
    const [g, ...q] = constraint(dyads[1], { x, y, a });
    p[2] /= length;
    q[2] /= length;
    const pp = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    const pq = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    const qq = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const det = pp * qq - pq * pq;
    if (!(det > 1e-9 * pp * qq)) return { x, y, a };
    const u = (f * qq - g * pq) / det, v = (g * pp - f * pq) / det;
    x -= u * p[0] + v * q[0];
    y -= u * p[1] + v * q[1];
    a -= (u * p[2] + v * q[2]) / length;
    if (Math.abs(f) + Math.abs(g) < 1e-14 * length) break;
  }
  return { x, y, a };
}
function catmullRom(values, i, share, round) {
  const last = values.length - 1;
  const at = (k) => {
    if (k >= 0 && k <= last) return values[k];
    if (!round) return k < 0 ? 2 * values[0] - values[-k] : 2 * values[last] - values[2 * last - k];
    const wrap = k < 0 ? k + last : k - last;
    return values[wrap] + (k < 0 ? -1 : 1) * (values[last] - values[0]);
  };
  const [p, q, r, t] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
  return q + share / 2 * (r - p + share * (2 * p - 5 * q + 4 * r - t + share * (3 * (q - r) + t - p)));
}
function placeAt(linkage, way, u, length) {
  if (way.joints) return placeOfJoints(linkage, way, way.joints, u);
  const stop = linkage.pose_errors.find((row) => row.at === way && Math.abs(row.frame - u) < 1e-6);
  if (stop) return { x: stop.x, y: stop.y, a: radians(stop.angle_deg) };
  const i = clamp(Math.floor(u), 0, way.x.length - 2), share = u - i;
  const place = {
    x: catmullRom(way.x, i, share, way.round),
    y: catmullRom(way.y, i, share, way.round),
    a: catmullRom(way.angle, i, share, way.round)
  };
  return project(linkage.led, place, length);
}
function placeOfJoints({ ground: ground2 }, way, moving, u) {
  const at = (values) => smooth(values, u), joints = { ...ground2 };
  for (const [name, [x, y]] of Object.entries(moving)) joints[name] = [at(x), at(y)];
  return { x: at(way.x), y: at(way.y), a: at(way.angle), joints };
}
function smooth(values, u) {
  const count = Math.min(6, values.length), first = clamp(Math.floor(u) - 2, 0, values.length - count);
  let sum = 0;
  for (let j = 0; j < count; j += 1) {
    let weight = 1;
    for (let k = 0; k < count; k += 1) if (k !== j) weight *= (u - first - k) / (j - k);
    sum += weight * values[first + j];
  }
  return sum;
}
function linear(values, u) {
  const i = clamp(Math.floor(u), 0, values.length - 2), share = u - i;
  const before = values[i], after = values[i + 1];
  if (before === null || after === null) return null;
  const value = before + share * (after - before);
  return Number.isNaN(value) ? null : value;
}
function valueAt({ x, y, stems = false }, at) {
  if (at === null) return null;
  const here = x.findIndex((each) => Math.abs(each - at) < 1e-6);
  if (here >= 0) return y[here];
  return stems || !(at > x[0] && at < x[x.length - 1]) ? null : linear(y, frameAt(x, at));
}
function frameAt(values, wanted) {
  let low = 0, high = values.length - 1;
  if (wanted <= values[low]) return low;
  if (wanted >= values[high]) return high;
  while (high - low > 1) {
    const middle = low + high >> 1;
    if (values[middle] <= wanted) low = middle;
    else high = middle;
  }
  const step = values[high] - values[low];
  return low + (step > 0 ? (wanted - values[low]) / step : 0);
}

// src/burmester/web/widget/load_marks.mjs
var COILS = 9;
var LEAD = 0.15;
var BARREL = 0.6;
var HALF_WIDTH = 6;
var LEAST_ARROW = 16;
var LONGEST_ARROW = 62;
var RADIUS = 11;
var TURNS = 2.25;
var LONGEST_FORCE = 90;
var LEAST_FORCE = 2;
var BARB = [9, 4.5];
function springPath(kind, [x, y], [u, v]) {
  const length = Math.hypot(u - x, v - y) || 1, across = [-HALF_WIDTH * (v - y) / length, HALF_WIDTH * (u - x) / length];
  const at = (share, side) => `${px(x + share * (u - x) + side * across[0])} ${px(y + share * (v - y) + side * across[1])}`;
  if (kind === "constant") return `M${at(0, 0)}L${at(1, 0)}`;
  if (kind === "gas") return `M${at(0, 1)}L${at(BARREL, 1)}L${at(BARREL, -1)}L${at(0, -1)}ZM${at(BARREL, 0)}L${at(1, 0)}`;
  const teeth = Array.from({ length: 2 * COILS + 1 }, (_, k) => at(LEAD + (1 - 2 * LEAD) * k / (2 * COILS), k % (2 * COILS) ? k % 2 ? 1 : -1 : 0));
  return `M${[at(0, 0), ...teeth, at(1, 0)].join("L")}`;
}
function roundPath(kind, [x, y]) {
  if (kind !== "torsion") return `M${px(x - RADIUS)} ${px(y)}a${RADIUS} ${RADIUS} 0 1 0 ${2 * RADIUS} 0a${RADIUS} ${RADIUS} 0 1 0 ${-2 * RADIUS} 0h${2 * RADIUS}M${px(x)} ${px(y - RADIUS)}v${2 * RADIUS}`;
  const points = Array.from({ length: 55 }, (_, k) => [k / 54 * RADIUS, k / 54 * 2 * Math.PI * TURNS]);
  return `M${points.map(([r, turn]) => `${px(x + r * Math.cos(turn))} ${px(y - r * Math.sin(turn))}`).join("L")}`;
}
function markPoints({ loads }, places) {
  if (!loads) return [];
  const ends = loads.springs.flatMap((spring) => spring.ends), on = (name) => ends.filter(({ link }) => link === name).map(({ point }) => point);
  return [...on("ground"), ...places.flatMap((place) => [...on("body"), ...loads.hand ? [loads.hand] : []].map((point) => act(place, point)))];
}
function arrowPath([x, y], angle, length) {
  const c = Math.cos(angle), d = -Math.sin(angle), tip = [x + length * c, y + length * d];
  const barb = (side) => `${px(tip[0] - BARB[0] * c - side * BARB[1] * d)} ${px(tip[1] - BARB[0] * d + side * BARB[1] * c)}`;
  return `M${px(x)} ${px(y)}L${tip.map(px).join(" ")}M${barb(1)}L${tip.map(px).join(" ")}L${barb(-1)}`;
}
var LoadMarks = class {
  constructor() {
    this.springs = s("g", { class: "bm-springs" });
    this.hand = s("path", { class: "bm-hand" });
    this.forces = s("g", { class: "bm-pin-forces" });
    this.group = s("g", { class: "bm-loads" }, this.springs, this.hand, this.forces);
  }
  /** @param {any} data @param {any} linkage @param {import("./types").View} view */
  shape(data, linkage, view) {
    this.view = view;
    this.loads = data.loads ?? null;
    this.known = (linkage.followed ? null : linkage.loads) ?? null;
    const springs = this.loads?.springs ?? [];
    while (this.springs.children.length > springs.length) this.springs.lastChild?.remove();
    while (this.springs.children.length < springs.length) this.springs.append(s("g", {}, s("path", { class: "bm-spring" }), s("circle", { class: "bm-spring-end", r: 2.6 }), s("circle", { class: "bm-spring-end", r: 2.6 })));
    springs.forEach(({ kind, ends }, k) => {
      const [, ...marks] = this.springs.children[k].children;
      put(this.springs.children[k], "data-spring", kind);
      for (const mark of marks) put(mark, "visibility", ends.length > 1 ? "inherit" : "hidden");
    });
    const pins = this.known?.pins ?? [];
    this.greatest = Math.max(0, ...pins.flatMap(({ force: [x, y] }) => x.map((each, i) => each === null || y[i] === null ? 0 : Math.hypot(each, y[i]))));
    this.forces.replaceChildren(...pins.map(({ name }) => s("g", { "data-pin": name }, s("path", { class: "bm-pin-force" }), s("text", { class: "bm-pin-newtons" }))));
  }
  /** @param {import("./types").Place} place @param {number | null} drive */
  show(place, drive) {
    const { loads, view } = this;
    if (!loads || !view) {
      put(this.hand, "d", "");
      return;
    }
    loads.springs.forEach(({ kind, ends }, k) => {
      const at = ends.map((end, j) => this.endOf(end, k, j, place, drive)), group = this.springs.children[k];
      put(group, "visibility", at.every(Boolean) ? "inherit" : "hidden");
      if (!at.every(Boolean)) return;
      put(group.children[0], "d", at.length > 1 ? springPath(kind, at[0], at[1]) : roundPath(kind, at[0]));
      at.forEach(([x, y], j) => {
        put(group.children[j + 1], "cx", px(x));
        put(group.children[j + 1], "cy", px(y));
      });
    });
    (this.known?.pins ?? []).forEach((pin, k) => this.showForce(this.forces.children[k], pin, drive));
    const pushes = this.known?.hand, angle = pushes && drive !== null ? valueAt(pushes, drive) : null;
    if (!loads.hand || angle === null) put(this.hand, "d", "");
    else {
      const force = valueAt({ x: pushes.x, y: pushes.force }, drive) ?? 0, size = LEAST_ARROW + (LONGEST_ARROW - LEAST_ARROW) * Math.abs(force);
      put(this.hand, "d", arrowPath(this.seen(act(place, loads.hand)), force < 0 ? angle + Math.PI : angle, size));
    }
  }
  /** The force of a pin at a drive: an arrow, the longest of which is that of the greatest force, and its newtons. */
  showForce(group, { at, force }, drive) {
    const place = drive === null ? [null] : at.map((each) => valueAt(each, drive)), [x, y] = drive === null ? [null, null] : force.map((each) => valueAt({ x: at[0].x, y: each }, drive));
    const known = place.every((each) => each !== null) && x !== null && y !== null, size = known ? Math.hypot(x, y) : 0, long = this.greatest ? LONGEST_FORCE * size / this.greatest : 0;
    put(group, "visibility", long > LEAST_FORCE ? "inherit" : "hidden");
    if (!(long > LEAST_FORCE)) return;
    const from = this.seen(place), c = x / size, d = y / size;
    put(group.children[0], "d", arrowPath(from, Math.atan2(y, x), long));
    put(group.children[1], "x", px(from[0] + (long + 6) * c));
    put(group.children[1], "y", px(from[1] - (long + 6) * d + 4));
    put(group.children[1], "text-anchor", c < -0.3 ? "end" : c > 0.3 ? "start" : "middle");
    group.children[1].textContent = `${group.dataset.pin} ${Number(size.toPrecision(3))} N`;
  }
  /** A point of F in pixels.
   * @param {any} point */
  seen([x, y]) {
    const { view } = this;
    return view ? [view.X(x), view.Y(y)] : [0, 0];
  }
  /** An end of a spring in pixels; null where it is not known: on another link beyond the poses. */
  endOf({ link, point }, spring, end, place, drive) {
    if (link === "ground") return this.seen(point);
    if (link === "body") return this.seen(act(place, point));
    const known = this.known?.moved.find((each) => each.spring === spring && each.end === end);
    const at = known && drive !== null ? known.at.map((each) => valueAt(each, drive)) : [null];
    return at.some((each) => each === null) ? null : this.seen(at);
  }
};

// src/burmester/web/widget/words.mjs
function wayStory(way, poses) {
  const noun = nounOf({ poses }), names = poses.map((pose) => pose.label);
  const all = way.poses.length === names.length;
  const here = all ? `all ${noun}s` : way.poses.length ? `${noun}${way.poses.length > 1 ? "s" : ""} ${runs(way.poses, names)}` : `no ${noun}`;
  const dead = way.dead.filter(Boolean).length;
  const ends = way.round ? "turns round" : dead === 2 ? "between two dead points" : dead ? "up to a dead point" : "open";
  return `${here}; ${ends}`;
}
var factsOf = ({ said }) => h("dl", { class: "bm-facts" }, said.facts.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
function spaceStory(data, linkage) {
  const some = data.poses.some(isPoint), every = nounOf(data) === "point";
  const taken = some && linkage ? `the places that ${linkage.id} takes at ${every ? "the" : "its"} points` : "";
  const marked = [every ? "" : "the poses", taken].filter(Boolean).join(" and ");
  const plain = `Every place of the body is one point of this space${marked ? `; numbered points are ${marked}` : ""}.`;
  if (!linkage) return [plain];
  const surface = (side) => h("b", { class: `bm-side${side}` }, linkage.led[side].id);
  return [plain, " The surfaces are all places that dyad ", surface(0), " (driver) and dyad ", surface(1), " (follower) allow; where they meet, the line, the coupler moves."];
}
function loopKey({ loops = [] }) {
  const one = (text, k) => h("li", {}, s("svg", { width: 34, height: 12, viewBox: "0 -6 34 12", "aria-hidden": "true", class: "bm-key" }, s("path", { class: `bm-line bm-loop${k}`, d: "M0 0H32" })), text);
  return loops.length ? h("ul", { class: "bm-keys" }, loops.map(one)) : null;
}
function keyOf(data, hasLinkages) {
  const one = (sign, text) => h("li", {}, s("svg", { width: 34, height: 20, viewBox: "-4 -13 34 20", "aria-hidden": "true", class: "bm-key" }, sign), text);
  const link = (kind) => s("g", { class: `bm-link bm-${kind}` }, s("path", { class: "bm-bar", d: "M0 -3H22" }), s("path", { class: "bm-core", d: "M0 -3H22" }));
  const posed = data.poses.some((pose) => !isPoint(pose)) || !data.poses.length, some = data.poses.some(isPoint);
  const frame = (name, axis, r, text) => posed ? [one(s("g", { class: name }, s("path", { d: axes(axis) }), s("circle", { r })), text)] : [];
  const dot3 = (name, r, text) => some ? [one(s("g", { class: name }, s("circle", { cx: 11, cy: -3, r })), text)] : [];
  if (data.stop) return h("ul", { class: "bm-keys" }, data.keys.map(([kind, text]) => one(link(kind), text)));
  const items = [...frame("bm-wanted", 22, 4, "wanted pose"), ...dot3("bm-wanted", 4, "wanted point")];
  if (data.path) items.push(one(s("path", { class: "bm-wanted-path", d: "M-2 2C6 -16 18 -10 28 -4" }), "wanted path"));
  if (hasLinkages) {
    items.push(
      ...frame("bm-achieved", 17, 2.2, "achieved pose"),
      ...dot3("bm-achieved", 2.2, "achieved point"),
      one(s("g", { class: "bm-errors" }, s("path", { d: "M0 0L22 -6L15 -7.5M22 -6L17 -0.8" })), "error, enlarged"),
      ...data.keys.map(([kind, text]) => one(link(kind), text)),
      one(s("path", { class: "bm-curve bm-here", d: "M-2 2C6 -16 18 -10 28 -4" }), "path of the origin of M")
    );
  }
  const { springs = [], hand = null } = data.loads ?? {};
  const round = ["torsion", "counterweight"], straight = springs.filter(({ kind }) => !round.includes(kind));
  if (straight.length) items.push(one(s("path", { class: "bm-spring", d: straight[0].kind === "gas" || straight[0].kind === "constant" ? springPath(straight[0].kind, [-2, -3], [28, -3]) : "M-2 -3H2L5 -9L9 3L13 -9L17 3L21 -9L24 -3H28" }), straight.length > 1 ? "springs" : `${straight[0].kind} spring`));
  for (const kind of round.filter((each) => springs.some((spring) => spring.kind === each))) items.push(one(s("path", { class: "bm-spring", d: roundPath(kind, [11, -3]) }), kind === "torsion" ? "torsion spring" : kind));
  if (hand && hasLinkages) items.push(one(s("path", { class: "bm-hand", d: "M0 -3H22M15 -7L22 -3L15 1" }), "push of the hand"));
  const box = "M-2 6H26V-10H-2Z";
  if (data.body || data.linkages[0]?.drawn) items.push(one(s("path", { class: "bm-ghost", d: "M-2 5L22 7L26 -1L4 -9Z" }), "body at the poses"));
  if (data.keep_out.length) items.push(one(s("g", {}, s("path", { class: "bm-region-edge", d: box, fill: "none" }), s("path", { class: "bm-hatch", d: "M-2 1L9 -10M2 6L18 -10M12 6L26 -8" })), "keep out"));
  return h("ul", { class: "bm-keys" }, items);
}

// src/burmester/web/widget/assemblies.mjs
var Assemblies = class {
  constructor(data, take) {
    this.data = data;
    this.take = take;
    this.name = `bm-way-${Math.random().toString(36).slice(2)}`;
    this.element = h("fieldset", { class: "bm-ways" });
  }
  build(linkage, index) {
    const one = (way, k) => h(
      "label",
      {},
      h("input", { type: "radio", name: this.name, value: k, checked: k === index, onchange: () => this.take(k) }),
      h("span", {}, h("b", {}, wayName(way, linkage).replace("assembly ", "")), ` ${wayStory(way, this.data.poses)}`)
    );
    this.element.replaceChildren(h("legend", {}, "Assembly"), ...linkage.ways.map(one));
    give(this.element, "hidden", !linkage.ways.length || Boolean(this.data.whole));
  }
};

// src/burmester/web/widget/travel.mjs
var LONGEST_STEP = 0.015;
var MOST_BETWEEN = 40;
var LEAST_STRETCH = 1e-6;
function stretchOf(linkage, index, whole = false) {
  const last = (linkage?.ways[index]?.x.length ?? 2) - 1, frames = linkage.pose_errors.filter((row) => row.way === index).map((row) => row.frame);
  const low = frames.reduce((a, b) => Math.min(a, b), last), high = frames.reduce((a, b) => Math.max(a, b), 0);
  const isApart = high - low > LEAST_STRETCH, sense = frames[frames.length - 1] < frames[0] ? -1 : 1;
  return { ...isApart && !whole ? { low, high } : { low: 0, high: last }, sense, isApart };
}
var placesOf = (data, linkage, way, stretch) => placesAlong(data, stretch, (u) => Number.isInteger(u) && !way.joints ? { x: way.x[u], y: way.y[u], a: way.angle[u] } : placeAt(linkage, way, u, data.chart.length));
function placesAlong(data, { low, high }, at) {
  const places = [at(low)];
  let before = low;
  const goTo = (u) => {
    const next = at(u), last = places[places.length - 1];
    const count = Math.min(MOST_BETWEEN, Math.floor(Math.hypot(next.x - last.x, next.y - last.y) / (LONGEST_STEP * data.scene)));
    for (let k = 1; k <= count; k += 1) places.push(at(before + k / (count + 1) * (u - before)));
    places.push(next);
    before = u;
  };
  for (let k = Math.floor(low) + 1; k < high; k += 1) goTo(k);
  goTo(high);
  return places;
}
function wayOfMost({ ways }) {
  const counts = ways.map((way) => way.poses.length);
  return Math.max(0, counts.indexOf(Math.max(...counts)));
}
function driveAtTime({ time: { x, y } }, time) {
  return y[0] <= y[y.length - 1] ? valueAt({ x: y, y: x }, time) : valueAt({ x: [...y].reverse(), y: [...x].reverse() }, time);
}
function alongLine(dyad, place) {
  const [nx, ny] = normalOf(dyad);
  const [x, y] = dyad.kind === "PR" ? act(place, dyad.moving_pivot) : back(place, dyad.fixed_pivot);
  return nx * y - ny * x;
}
function travelOf(dyad, places) {
  const along = places.map((place) => alongLine(dyad, place));
  return [along.reduce((a, b) => Math.min(a, b)), along.reduce((a, b) => Math.max(a, b))];
}
function pointOnLine(dyad, along) {
  const [nx, ny] = normalOf(dyad), { offset } = dyad.line;
  return [offset * nx - along * ny, offset * ny + along * nx];
}

// src/burmester/web/widget/framing.mjs
var WIDEST = 4;
var ROOM = 2.5;
var SPARE = 0.75;
var LEAST = 0.25;
var MOST_PLACES = 400;
var INSET = 12;
var bounds = (points) => points.reduce(([x, y, u, v], [a, b]) => Number.isFinite(a + b) ? [Math.min(x, a), Math.min(y, b), Math.max(u, a), Math.max(v, b)] : [x, y, u, v], [Infinity, Infinity, -Infinity, -Infinity]);
var placesAtPoses = (data, linkage) => data.poses.flatMap((pose, k) => {
  const row = linkage?.pose_errors[k], at = row && row.x !== null ? row : pose;
  return at.angle_deg === null ? [] : [{ x: at.x, y: at.y, a: radians(at.angle_deg), k }];
});
function farFrom(data) {
  const [x, y, u, v] = bounds(data.poses.map((pose) => [pose.x, pose.y])), reach = (data.body ?? []).reduce((most, [a, b]) => Math.max(most, Math.hypot(a, b)), 0);
  return (point) => !(Math.hypot(point[0] - (x + u) / 2, point[1] - (y + v) / 2) < Math.max(WIDEST * data.scene, reach));
}
function pivotsAt(linkage, places) {
  const fixed2 = linkage.led.flatMap((dyad) => dyad.fixed_pivot ? [dyad.fixed_pivot] : []);
  const own = linkage.led.flatMap((dyad) => dyad.moving_pivot ? [dyad.moving_pivot] : dyad.kind === "RP" && places.length ? travelOf(dyad, places).map((end) => pointOnLine(dyad, end)) : []);
  return [...fixed2, ...places.flatMap((place) => [...own.map((point) => act(place, point)), ...Object.values(place.joints ?? {})])];
}
function nearPoints(data, linkage, places, { far = false, close = false } = {}) {
  const isFar = farFrom(data), seen = (point) => far || !isFar(point);
  const reached = linkage ? [...linkage.pose_errors.filter((row) => row.x !== null), ...places] : [];
  const points = [...[...data.poses, ...reached].map(({ x, y }) => [x, y]), ...linkage ? [...pivotsAt(linkage, places), ...markPoints(data, places)] : []];
  const some = places.filter((place, k) => k % Math.ceil(places.length / MOST_PLACES) === 0 && seen([place.x, place.y]));
  const corners = data.body && !close ? [...placesAtPoses(data, linkage), ...some].flatMap((place) => data.body.map((corner) => act(place, corner))) : [];
  return [...points.filter(seen), ...corners];
}
function fitted(near, others, whole) {
  const all = bounds([...near, ...others]);
  const [x, y, u, v] = bounds(near), size = Math.max(u - x, v - y) || 1, reach = SPARE * size;
  if (whole || !near.length || Math.max(all[2] - all[0], all[3] - all[1]) <= ROOM * size) return all;
  return [Math.max(all[0], x - reach), Math.max(all[1], y - reach), Math.min(all[2], u + reach), Math.min(all[3], v + reach)];
}
function boxOf(data, linkage, places, { whole = false, close = false } = {}) {
  const near = nearPoints(data, linkage, places, { far: whole, close }), regions = close ? [] : data.keep_out.flatMap((region) => region.outline);
  const box = fitted(near, regions, whole || !linkage), least = LEAST * data.scene;
  for (const k of [0, 1]) {
    const lack = Math.max(0, least - (box[k + 2] - box[k]));
    box[k] -= lack / 2;
    box[k + 2] += lack / 2;
  }
  return box;
}
function viewOf(box, width, height, margin) {
  const scale = Math.min((width - 2 * margin) / (box[2] - box[0]), (height - 2 * margin) / (box[3] - box[1]));
  const left = width / 2 - scale * (box[0] + box[2]) / 2, top = height / 2 + scale * (box[1] + box[3]) / 2;
  return { scale, left, top, width, height, X: (x) => left + scale * x, Y: (y) => top - scale * y };
}
function edgeTowards({ X, Y, width, height }, at) {
  const x = X(at[0]), y = Y(at[1]), cx = width / 2, cy = height / 2;
  if (x >= 0 && y >= 0 && x <= width && y <= height) return null;
  const size = Math.hypot(x - cx, y - cy), u = (x - cx) / size, v = (y - cy) / size;
  const reach = Math.min((cx - INSET) / Math.abs(u), (cy - INSET) / Math.abs(v));
  return { x: cx + reach * u, y: cy + reach * v, angle: Math.atan2(-v, u) };
}

// src/burmester/web/widget/outlines.mjs
var HATCH = 9;
var PALEST = 0.45;
var LONGEST_NAME = 28;
var MANY_GHOSTS = 6;
var patterns = 0;
var closed = (points, view, [x, y]) => `M${points.map((each) => `${px(x + view.scale * each[0])} ${px(y - view.scale * each[1])}`).join("L")}Z`;
var bodyOutline = (data, view) => closed(data.body, view, [0, 0]);
var hasGhost = (k, count) => count <= MANY_GHOSTS || k === 0 || k === count - 1;
function ghosts(data, linkage, view) {
  const group = s("g", { class: "bm-ghosts" });
  if (!data.body) {
    for (const row of linkage?.drawn ? linkage.pose_errors.filter((_, k) => hasGhost(k, linkage.pose_errors.length)) : []) group.append(plate(placeAt(linkage, linkage.ways[row.way], row.frame, data.chart.length), linkage, view));
    return group;
  }
  const last = Math.max(1, data.poses.length - 1);
  for (const { x, y, a, k } of placesAtPoses(data, linkage).filter((place) => !linkage || hasGhost(place.k, data.poses.length))) {
    const opacity = (PALEST + (1 - PALEST) * k / last).toFixed(3);
    group.append(s("path", { class: "bm-ghost", d: bodyOutline(data, view), "data-pose": k + 1, opacity, transform: transform(view.X(x), view.Y(y), a) }));
  }
  return group;
}
var plate = (place, { drawn }, view) => s("path", { class: "bm-ghost", d: `${polyline([...drawn.find(({ kind }) => kind === "carried").joints].map((joint) => place.joints[joint] ?? [place.x, place.y]), view)}Z` });
function keepOut(data, view) {
  const group = s("g", { class: "bm-keep-out" });
  if (!data.keep_out.length) return group;
  const id = `bm-hatch-${patterns += 1}`;
  group.append(
    s(
      "defs",
      {},
      s(
        "pattern",
        { id, width: HATCH, height: HATCH, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" },
        s("path", { class: "bm-hatch", d: `M0 0V${HATCH}` })
      )
    )
  );
  for (const region of data.keep_out) {
    const d = closed(region.outline, view, [view.left, view.top]);
    group.append(s("g", { class: "bm-region" }, s("title", {}, region.name || "keep out"), s("path", { class: "bm-region-plain", d }), s("path", { class: "bm-region-edge", d, fill: `url(#${id})` })));
  }
  return group;
}
function keepOutNames(data, view, labels) {
  return data.keep_out.filter(({ name }) => name).map(({ name, at: [x, y] }) => {
    const text = shortened(name, LONGEST_NAME);
    labels.block(view.X(x), view.Y(y), 7.2 * text.length, 14);
    return s("text", { class: "bm-region-name", x: px(view.X(x)), y: px(view.Y(y) + 4), "text-anchor": "middle" }, text);
  });
}

// src/burmester/web/widget/mechanism.mjs
var BODY_AXIS = AXIS + 10;
var LETTER = 14;
var TURNING_ARROW = "M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9";
var BLOCK_IN_SLOT = [18, 10];
var SPARE2 = 5;
var NAME = 15;
var ARROW = 24;
function mechanism(data, linkage, view, places) {
  const drawn = new Mechanism(linkage);
  drawn.shape(data, linkage, view, places);
  return drawn;
}
var Mechanism = class {
  constructor({ led, drawn: links = [], ground: ground2, names }) {
    this.kinds = kindsOf(led);
    this.outline = s("path", { class: "bm-body-outline" });
    this.links = s("g");
    this.blocks = s("g");
    this.pins = s("g");
    this.coupler = s("g", { class: "bm-coupler" });
    this.arrow = s("path", { class: "bm-drive-mark bm-side0" });
    this.letter = s("text", { class: "bm-letter", "text-anchor": "middle" }, "M");
    this.plates = [s("path", { class: "bm-plate-rim" }), s("path", { class: "bm-plate" })];
    this.coupler.append(...this.plates);
    this.parts = led.map((dyad, side) => new PARTS[dyad.kind](this, side));
    if (links.length) this.parts.push(...links.map((link) => new JointedLink(this, link)), new Joints(this, ground2, names));
    this.coupler.append(s("path", { class: "bm-body-frame", d: axes(BODY_AXIS) }), s("circle", { class: "bm-origin", r: 4 }));
    for (const part of this.parts) if (part.pin) this.coupler.append(part.pin);
    this.marks = new LoadMarks();
    this.group = s("g", { class: "bm-linkage" }, this.arrow, this.links, this.coupler, this.blocks, this.pins, this.marks.group, links.length ? null : this.letter);
  }
  /** Whether it can be given the dimensions of a linkage. */
  fits({ led }) {
    return kindsOf(led) === this.kinds;
  }
  /** The dimensions of a linkage in a picture; slots are as long as the places need. */
  shape(data, linkage, view, places) {
    this.view = view;
    this.led = linkage.led;
    this.hasBody = Boolean(data.body);
    if (this.hasBody) {
      put(this.outline, "d", bodyOutline(data, view));
      if (!this.outline.parentNode) this.group.prepend(this.outline);
    } else {
      this.outline.remove();
    }
    const corners = [[0, 0]];
    linkage.led.forEach((dyad, side) => {
      if (dyad.moving_pivot) corners.push(inBody(dyad.moving_pivot, view));
      const more = this.parts[side].shape(dyad, view, places);
      if (more) corners.push(more);
    });
    const d = `M${hull(corners).map((corner) => corner.map(px).join(" ")).join("L")}Z`;
    for (const plate2 of linkage.drawn ? [] : this.plates) put(plate2, "d", d);
    for (const part of this.parts.slice(linkage.led.length)) part.shape(view);
    this.marks.shape(data, linkage, view);
    this.shapeArrow();
  }
  /** drive: where the driver is, for what is known over it only. */
  show(place, drive = null) {
    const { view } = this, at = transform(view.X(place.x), view.Y(place.y), place.a);
    this.marks.show(place, drive);
    put(this.coupler, "transform", at);
    if (this.hasBody) put(this.outline, "transform", at);
    for (const part of this.parts) part.show(place);
    const [x, y] = act(place, [LETTER / view.scale, -LETTER / view.scale]);
    put(this.letter, "transform", `translate(${px(view.X(x))} ${px(view.Y(y) + 4)})`);
    const [driver] = this.led;
    if (driver.kind === "PR") put(this.arrow, "transform", `${onRail(driver, place, view)} translate(0 ${-ARROW})`);
  }
  /** A turning or sliding arrow at the driver, for eyes that tell no colours apart. */
  shapeArrow() {
    const { arrow, view } = this, [driver] = this.led;
    if (driver.kind === "PR") put(arrow, "d", "M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5");
    if (!driver.fixed_pivot) return;
    const [x, y] = driver.fixed_pivot;
    put(arrow, "d", TURNING_ARROW);
    put(arrow, "transform", `translate(${px(view.X(x))} ${px(view.Y(y))}) rotate(-90)`);
  }
};
var kindsOf = (led) => led.map((dyad) => dyad.kind).join();
var inBody = ([x, y], view) => [view.scale * x, -view.scale * y];
function onRail(dyad, place, view) {
  const [x, y] = act(place, dyad.moving_pivot), [nx, ny] = normalOf(dyad);
  return transform(view.X(x), view.Y(y), Math.atan2(nx, -ny));
}
var block = (side, width, height) => s("g", { class: `bm-block bm-side${side}` }, s("rect", { x: -width / 2, y: -height / 2, width, height, rx: 2 }));
function setPin(pin, [x, y], dyad) {
  put(pin, "cx", px(x));
  put(pin, "cy", px(y));
  put(pin, "data-dyad", dyad.id);
}
var inGround = ([x, y], view) => [view.X(x), view.Y(y)];
var Bar = class {
  constructor({ links, pins }, side) {
    this.strokes = [s("path", { class: "bm-bar" }), s("path", { class: "bm-core" })];
    this.bar = s("g", { class: `bm-link bm-side${side}` }, this.strokes);
    this.ground = s("circle", { class: "bm-pin bm-fixed-pin", r: 4.5 });
    this.pin = s("circle", { class: "bm-pin", r: 4.5 });
    links.append(this.bar);
    pins.append(this.ground);
  }
  shape(dyad, view) {
    this.dyad = dyad;
    this.view = view;
    for (const stroke of this.strokes) put(stroke, "d", `M0 0H${px(view.scale * dyad.radius)}`);
    setPin(this.ground, inGround(dyad.fixed_pivot, view), dyad);
    setPin(this.pin, inBody(dyad.moving_pivot, view), dyad);
  }
  show(place) {
    const { dyad, view } = this, [cx, cy] = dyad.fixed_pivot, [x, y] = act(place, dyad.moving_pivot);
    put(this.bar, "transform", transform(view.X(cx), view.Y(cy), Math.atan2(y - cy, x - cx)));
  }
};
var BlockOnRail = class {
  constructor({ blocks }, side) {
    this.block = block(side, ...BLOCK);
    this.pin = s("circle", { class: "bm-pin", r: 4.5 });
    blocks.append(this.block);
  }
  shape(dyad, view) {
    this.dyad = dyad;
    this.view = view;
    put(this.block, "data-dyad", dyad.id);
    setPin(this.pin, inBody(dyad.moving_pivot, view), dyad);
  }
  show(place) {
    put(this.block, "transform", onRail(this.dyad, place, this.view));
  }
};
var Slot = class {
  constructor({ blocks, pins, coupler }, side) {
    this.strokes = ["rim", "plate", "edge"].map((name) => s("path", { class: `bm-slot-${name}` }));
    this.strokes.push(s("path", { class: "bm-slot" }));
    this.block = block(side, ...BLOCK_IN_SLOT);
    this.ground = s("circle", { class: "bm-pin bm-fixed-pin", r: 4 });
    coupler.append(...this.strokes);
    blocks.append(this.block);
    pins.append(this.ground);
  }
  /** Returns the middle of the slot, for the body's plate. */
  shape(dyad, view, places) {
    this.dyad = dyad;
    this.view = view;
    const [low, high] = places.length ? travelOf(dyad, places) : [0, 0], end = (BLOCK_IN_SLOT[0] / 2 + SPARE2) / view.scale;
    const seen = (along) => inBody(pointOnLine(dyad, along), view);
    const d = `M${[seen(low - end), seen(high + end)].map((each) => each.map(px).join(" ")).join("L")}`;
    for (const stroke of this.strokes) put(stroke, "d", d);
    for (const part of [this.strokes[3], this.block]) put(part, "data-dyad", dyad.id);
    setPin(this.ground, inGround(dyad.fixed_pivot, view), dyad);
    return seen((low + high) / 2);
  }
  show(place) {
    const { dyad, view } = this, [nx, ny] = normalOf(dyad), [cx, cy] = dyad.fixed_pivot;
    put(this.block, "transform", transform(view.X(cx), view.Y(cy), place.a + Math.atan2(nx, -ny)));
  }
};
var JointedLink = class {
  constructor({ links }, { joints, kind }) {
    this.joints = [...joints];
    this.strokes = [s("path", { class: "bm-bar" }), s("path", { class: "bm-core" })];
    links.append(s("g", { class: `bm-link bm-${kind}${joints.length > 2 ? " bm-ternary" : ""}`, "data-link": joints.replace("M", "") }, this.strokes));
  }
  shape(view) {
    this.view = view;
  }
  show(place) {
    const d = `M${this.joints.map((joint) => inGround(place.joints[joint] ?? [place.x, place.y], this.view).map(px).join(" ")).join("L")}${this.joints.length > 2 ? "Z" : ""}`;
    for (const stroke of this.strokes) put(stroke, "d", d);
  }
};
var Joints = class {
  constructor({ pins }, ground2, names) {
    this.pins = [...Object.keys(ground2), ...Object.keys(names)].map((joint) => {
      const pin = s("circle", { class: `bm-pin${joint in ground2 ? " bm-fixed-pin" : ""}`, r: 4.5, "data-joint": joint });
      return { joint, pin, link: [...names[joint] ?? ""], name: joint in ground2 ? null : s("text", { class: "bm-name", "text-anchor": "middle" }, joint) };
    });
    pins.append(...this.pins.map(({ pin }) => pin), ...this.pins.flatMap(({ name }) => name ?? []));
  }
  shape(view) {
    this.view = view;
  }
  show({ joints }) {
    for (const { joint, pin, link, name } of this.pins) {
      const [x, y] = inGround(joints[joint], this.view);
      put(pin, "cx", px(x));
      put(pin, "cy", px(y));
      if (!name) continue;
      const [u, v] = outwards(link.map((each) => inGround(joints[each], this.view)), [x, y]);
      put(name, "x", px(x + NAME * u));
      put(name, "y", px(y + NAME * v + 4));
    }
  }
};
function outwards(corners, [x, y]) {
  const middle = [0, 1].map((k) => corners.reduce((sum, corner) => sum + corner[k], 0) / corners.length);
  const u = x - middle[0], v = y - middle[1], size = Math.hypot(u, v);
  return size > 1 ? [u / size, v / size] : [0, -1];
}
var Nothing = class {
  shape() {
  }
  show() {
  }
};
var PARTS = { RR: Bar, PR: BlockOnRail, RP: Slot, PP: Nothing, crank: Nothing };

// src/burmester/web/widget/rail.mjs
var LONGEST = 4e3;
function railOf(dyad, places, view) {
  const [nx, ny] = normalOf(dyad), [low, high] = travelOf(dyad, places);
  const half = view.scale * (high - low) / 2 + BLOCK[0], edge = BLOCK[1] / 2 + 1;
  const [x, y] = ((at) => [view.X(at[0]), view.Y(at[1])])(pointOnLine(dyad, (low + high) / 2));
  const bodySide = places.reduce((sum, place) => sum + nx * place.x + ny * place.y - dyad.line.offset, 0);
  const turned = Math.atan2(nx, -ny) + (bodySide > 0 ? Math.PI : 0);
  const drawn = Math.min(half, LONGEST);
  let hatch = "";
  for (let k = -drawn + 4; k < drawn - 2; k += 8) hatch += `M${px(k + 4)} ${edge}l-6 7`;
  return { x, y, half, drawn, turned, paths: [`M${px(-half)} ${edge}H${px(half)}${hatch}`, `M${px(-half)} ${-edge}H${px(half)}`] };
}

// src/burmester/web/widget/portrait.mjs
var WIDTH = 300;
var HEIGHTS = [110, 180];
var MARGIN = 16;
var BODY_ROOM = 3;
var Portrait = class {
  constructor() {
    this.svg = s("svg", { class: "bm-portrait", viewBox: `0 0 ${WIDTH} ${HEIGHTS[0]}`, "aria-hidden": "true" });
  }
  /** Draw a linkage, if it is another one, or has other ways, than before. */
  draw(data, linkage) {
    if (this.ways === linkage.ways || !linkage.ways.length) return;
    this.ways = linkage.ways;
    this.linkage = linkage;
    const bare = { ...data, ...linkage.picture, loads: null, keep_out: [] }, index = this.index = wayOfMost(linkage), way = linkage.ways[index];
    const stretch = stretchOf(linkage, index), places = placesOf(bare, linkage, way, stretch), ends = stretch.sense < 0 ? [stretch.high, stretch.low] : [stretch.low, stretch.high];
    const box = boxOf(bare, linkage, places), close = boxOf(bare, linkage, places, { close: true });
    const held = sizeOf(box) > BODY_ROOM * sizeOf(close) ? close : box, [x, y, u, v] = held, height = Math.round(clamp((v - y) / (u - x) * (WIDTH - 2 * MARGIN) + 2 * MARGIN, HEIGHTS[0], HEIGHTS[1]));
    const view = viewOf(held, WIDTH, height, MARGIN);
    put(this.svg, "viewBox", `0 0 ${WIDTH} ${height}`);
    Object.assign(this.svg.dataset, { scale: view.scale, left: view.left, top: view.top });
    this.length = data.chart.length;
    const at = (u2) => placeAt(linkage, way, u2, data.chart.length);
    const one = (u2) => {
      const drawn = new Mechanism(linkage);
      drawn.shape(bare, linkage, view, places);
      drawn.show(at(u2), linear(way.drive, u2));
      return drawn;
    };
    const last = one(ends[1]);
    last.group.classList.add("bm-portrait-last");
    this.now = one(ends[0]);
    this.now.group.classList.add("bm-portrait-now");
    const path = s("path", { class: "bm-curve bm-here", d: polyline(places.map(({ x: x2, y: y2 }) => [x2, y2]), view) });
    const poses = bare.poses.map(({ x: x2, y: y2 }) => s("circle", { class: "bm-portrait-pose", cx: px(view.X(x2)), cy: px(view.Y(y2)), r: 4 }));
    this.svg.replaceChildren(...linkage.led.map((dyad) => ground(dyad, places, view)).filter(Boolean), path, last.group, ...poses, this.now.group);
  }
  /** Move it to a frame of one of its ways; back to its first pose where there is none. */
  show(at) {
    if (!this.now || !this.linkage) return;
    const index = at?.way ?? this.index, stretch = stretchOf(this.linkage, index), u = at?.u ?? (stretch.sense < 0 ? stretch.high : stretch.low), way = this.linkage.ways[index];
    this.now.show(placeAt(this.linkage, way, u, this.length ?? 1), linear(way.drive, u));
  }
};
var sizeOf = ([x, y, u, v]) => Math.max(u - x, v - y);
function ground(dyad, places, view) {
  if (dyad.kind === "PR") {
    const { x, y, turned, paths } = railOf(dyad, places, view);
    return s("g", { class: "bm-rail", transform: transform(x, y, turned) }, paths.map((d) => s("path", { class: "bm-ground", d })));
  }
  if (!dyad.fixed_pivot) return null;
  const at = foot();
  put(at, "transform", `translate(${px(view.X(dyad.fixed_pivot[0]))} ${px(view.Y(dyad.fixed_pivot[1]))})`);
  return at;
}

// src/burmester/web/widget/cards.mjs
var ERRORS = { mm: 0.1, cm: 0.01, m: 1e-4, um: 1, in: 5e-3, ft: 5e-4 };
var LINK_DIGITS = 4;
var ALIKE = 0.02;
var missOf2 = ({ said }, data) => said.worst === "-" ? "–" : [said.worst === "exact" ? "nothing" : withUnit(said.worst, data), said.angle && !["-", "exact", "free"].includes(said.angle) ? said.angle : null].filter(Boolean).join(", ");
var withUnit = (text, data) => `${text}${data.unit ? ` ${data.unit}` : ""}`;
var sizeOf2 = (linkage, data) => (linkage.quality?.extent ?? NaN) * data.span;
function sensitivityText({ quality }, data) {
  const sensitivity = quality?.sensitivity ?? NaN, error = ERRORS[data.unit] ?? 10 ** Math.round(Math.log10(data.span / 1e3));
  return [`${withUnit(figure(error), data)} of error`, Number.isFinite(sensitivity) ? `moves it ${withUnit(figure(error * sensitivity), data)}` : "–"];
}
var figuresOf = (linkage, data) => [
  ["worst", "misses by", missOf2(linkage, data)],
  ["least", "transmits", leastText(linkage.said.transmission)],
  ["size", "size", Number.isFinite(sizeOf2(linkage, data)) ? withUnit(figure(sizeOf2(linkage, data)), data) : "–"],
  ["sensitivity", ...sensitivityText(linkage, data)]
];
var leastText = (text) => ({ "-": "–", "–": "–", "0°": "down to 0°" })[text] ?? `${text} or more`;
function differenceOf(linkage, best, data) {
  if (!linkage.usable || !best?.usable || best.id === linkage.id) return "";
  const size = sizeOf2(linkage, data) - sizeOf2(best, data), angle = leastOf(linkage) - leastOf(best), sense = (value, more, less) => value > 0 ? more : less;
  const parts = [
    Math.abs(size) > ALIKE * sizeOf2(best, data) ? `${withUnit(figure(Math.abs(size)), data)} ${sense(size, "larger", "smaller")}` : "",
    Math.abs(angle) >= 0.5 ? `transmits ${fixed(Math.abs(angle), 0)}° ${sense(angle, "more", "less")}` : ""
  ].filter(Boolean);
  return parts.length ? `Than ${best.id}: ${parts.join(", ")}` : "";
}
var leastOf = (linkage) => linkage.least ?? linkage.min_transmission_angle_deg?.range ?? NaN;
function verdictOf(linkage) {
  if (linkage.card?.facts) return linkage.card.verdict;
  if (!linkage.usable) return "✕ not usable";
  return linkage.shortcomings?.length && !linkage.followed ? `✓ usable, but ${linkage.shortcomings.join("; ")}` : "✓ usable";
}
var Card = class {
  /** @param {string} kind @param {() => void} onclick */
  constructor(kind, onclick) {
    this.name = h("b", {});
    this.type = h("span", { class: "bm-type" });
    this.was = h("span", { class: "bs-was" });
    this.verdict = h("span", { class: "bm-verdict" });
    this.portrait = new Portrait();
    this.figures = h("dl", {});
    this.differs = h("span", { class: "bm-differs" });
    this.links = h("span", { class: "bm-lengths" });
    this.quiet = h("span", { class: "bm-quiet" });
    this.reason = h("span", { class: "bm-reason" });
    this.help = h("span", { class: "bs-help" });
    this.element = h(
      "button",
      { type: "button", class: kind, "aria-pressed": "false", onclick },
      h("span", { class: "bm-choice-head" }, this.name, " ", this.type, " ", this.was),
      this.portrait.svg,
      this.verdict,
      this.figures,
      this.differs,
      this.links,
      this.quiet,
      this.reason,
      this.help
    );
  }
  /** figures: [key, name, text] each; what is not given stays empty. */
  show(data, linkage, { name = linkage.id, was = "", verdict = verdictOf(linkage), figures, differs = "", links = "", quiet = "", reason = "", help = "" }) {
    this.portrait.draw(data, linkage);
    for (const [element, text] of [[this.name, name], [this.type, linkage.type], [this.was, was], [this.verdict, verdict], [this.differs, differs], [this.links, links], [this.quiet, quiet], [this.reason, reason], [this.help, help]]) say(element, text);
    const rows = this.figures.children, names = figures.map(([key, title]) => `${key} ${title}`).join();
    if (names !== this.names) this.figures.replaceChildren(...figures.map(([key, title]) => h("div", {}, h("dt", {}, title), h("dd", { "data-figure": key }))));
    this.names = names;
    figures.forEach(([, , text], k) => say(rows[k].lastChild, text));
  }
};
var Cards = class {
  constructor(data, linkages, choose) {
    const cards = this.cards = linkages.map((each, k) => cardOf(data, each, linkages[0], () => choose(k)));
    this.element = h(
      "nav",
      { class: "bm-list", "aria-label": "Linkages, best first" },
      h("h2", {}, `${cards.length} linkage${cards.length === 1 ? "" : "s"}`),
      h("div", { class: "bm-choices" }, this.cards)
    );
    this.element.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
      const at = this.cards.indexOf(document.activeElement);
      if (!step || at < 0) return;
      event.preventDefault();
      this.cards[clamp(at + step, 0, this.cards.length - 1)].focus();
    });
  }
  mark(index) {
    this.cards.forEach((each, k) => each.setAttribute("aria-pressed", String(k === index)));
  }
};
function cardOf(data, linkage, best, onclick) {
  const { facts, quiet, reason } = linkage.card, links = Object.entries(linkage.said.links ?? {});
  const card = new Card(`bm-choice ${linkage.usable ? "bm-good" : "bm-bad"}`, onclick);
  put(card.element, "data-linkage", linkage.id);
  card.show(data, linkage, {
    figures: facts?.map(([name, text]) => [name, name, Array.isArray(text) ? text.join(", ") : text]) ?? figuresOf(linkage, data),
    differs: facts ? "" : differenceOf(linkage, best, data),
    links: links.length ? withUnit(links.map(([name, text]) => `${name} ${Number(Number(text).toPrecision(LINK_DIGITS))}`).join(", "), data) : "",
    quiet: quiet ?? "",
    reason: reason ?? ""
  });
  return card.element;
}

// src/burmester/web/widget/family_pairs.mjs
var CLASSES = 7;
var OUTSIDE = 2;
var SHARES = [0, 0.25, 0.5, 0.75];
var FamilyPairs = class {
  constructor(data) {
    this.data = data;
    this.map = data.family_map;
    this.isCurve = this.map.kind === "curve";
    this.columns = this.isCurve ? this.map.fixed.length : this.map.columns;
    this.rows = this.isCurve ? this.columns : this.map.rows;
    this.starts = [];
    (this.map.loops ?? []).reduce((start, size) => (this.starts.push(start), start + size), 0);
  }
  /** The letter of a loop, where there are several. */
  letter(loop) {
    return this.starts.length > 1 ? `${"ABCDEFGH"[loop]} ` : "";
  }
  /** The pair at column i and row j: its class, its driver (0 or 1) and whole degrees. */
  pair([i, j]) {
    const { cells: cells2 } = this.map;
    if (!this.isCurve) return this.decoded(cells2[j * this.columns + i]);
    if (i === j) return { kind: CLASSES - 1, driver: 0, degrees: 0 };
    const [a, b] = [Math.min(i, j), Math.max(i, j)], n = this.columns;
    const pair = this.decoded(cells2[a * n - a * (a + 1) / 2 + b - a - 1]);
    return i < j ? pair : { ...pair, driver: 1 - pair.driver };
  }
  decoded(code) {
    const rest = Math.floor(code / CLASSES);
    return { kind: code % CLASSES, driver: rest % 2, degrees: Math.floor(rest / 2) };
  }
  /** The best pair that a dyad of the curve makes. */
  bestPartner(i) {
    let best = { kind: CLASSES - 1, degrees: 0 };
    for (let j = 0; j < this.columns; j += 1) {
      const pair = this.pair([i, j]);
      if (pair.kind < best.kind || pair.kind === best.kind && pair.degrees > best.degrees) best = pair;
    }
    return best;
  }
  /** The name of a place along the curve: its share of its loop, after the loop's letter. */
  placeName(k) {
    const loop = this.starts.findLastIndex((start) => start <= k), size = this.map.loops[loop];
    return `${this.letter(loop)}${((k - this.starts[loop] + 0.5) / size).toFixed(2)}`;
  }
  /** The cell of a fixed pivot in the plane of three poses. */
  cellOf(pivot) {
    if (!pivot) return null;
    const { low, high } = this.map, many = [this.columns, this.rows];
    const at = pivot.map((v, k) => Math.round((v - low[k]) / (high[k] - low[k]) * (many[k] - 1)));
    return at.every((v, k) => v >= 0 && v < many[k]) ? at : null;
  }
  /** The fixed pivot of a cell in the plane of three poses. */
  pivotOf(cell) {
    const { low, high } = this.map, many = [this.columns, this.rows];
    return cell.map((v, k) => low[k] + v / (many[k] - 1) * (high[k] - low[k]));
  }
  /** Both dyads of a pair: fixed pivots in F, moving ones in M, lengths. */
  dyadsOf(cell) {
    const { map } = this;
    if (this.isCurve) return cell.map((k) => ({ fixed: map.fixed[k], moving: map.moving[k], length: map.length[k] }));
    return [map.chosen, dyadOfThree(this.data.poses, this.pivotOf(cell))];
  }
  /** The pivots of a pair in F, at pose 1. */
  pinsOf(cell) {
    if (!cell) return [];
    return this.dyadsOf(cell).flatMap((each) => [...each.fixed ? [each.fixed] : [], ...each.moving ? [this.seen(each.moving)] : []]);
  }
  /** A point of the body in F, at pose 1. */
  seen([x, y]) {
    const [pose] = this.data.poses, turn = pose.angle_deg * Math.PI / 180, [cos, sin] = [Math.cos(turn), Math.sin(turn)];
    return [pose.x + cos * x - sin * y, pose.y + sin * x + cos * y];
  }
};
function dyadOfThree(poses, pivot) {
  const [a, b, c] = poses.map((pose) => {
    const turn = -pose.angle_deg * Math.PI / 180, [x, y] = [pivot[0] - pose.x, pivot[1] - pose.y];
    return [Math.cos(turn) * x - Math.sin(turn) * y, Math.sin(turn) * x + Math.cos(turn) * y];
  });
  const u = [b[0] - a[0], b[1] - a[1]], v = [c[0] - a[0], c[1] - a[1]];
  const cross2 = 2 * (u[0] * v[1] - u[1] * v[0]), uu = u[0] ** 2 + u[1] ** 2, vv = v[0] ** 2 + v[1] ** 2;
  const arm = [(uu * v[1] - vv * u[1]) / cross2, (vv * u[0] - uu * v[0]) / cross2];
  return { fixed: pivot, moving: [a[0] + arm[0], a[1] + arm[1]], length: Math.hypot(...arm) };
}

// src/burmester/web/widget/labels.mjs
var Labels = class {
  /** @param {{ width: number, height: number }} view */
  constructor(view) {
    this.view = view;
    this.taken = [];
  }
  /** @param {number} x @param {number} y @param {number} width @param {number} height */
  block(x, y, width, height) {
    this.taken.push([x - width / 2, y - height / 2, x + width / 2, y + height / 2]);
  }
  /** @param {number} x @param {number} y @param {string} text @param {number} distance @param {Record<string, any>} [attributes] */
  put(x, y, text, distance, attributes) {
    const width = 7.2 * text.length + 4, height = 14;
    let best = { cost: Infinity, cx: 0, cy: 0, box: [0, 0, 0, 0] };
    for (let ring = 0; ring < 3; ring += 1) {
      for (let k = 0; k < 16; k += 1) {
        const angle = Math.PI / 8 * k + Math.PI / 4;
        const away = distance + 9 * ring;
        const cx = x + (away + width / 2 - 6) * Math.cos(angle);
        const cy = y - away * Math.sin(angle);
        const box = [cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2];
        let cost = 0.02 * k + 6 * ring;
        for (const other of this.taken) {
          const across = Math.min(box[2], other[2]) - Math.max(box[0], other[0]);
          const down = Math.min(box[3], other[3]) - Math.max(box[1], other[1]);
          if (across > 0 && down > 0) cost += across * down;
        }
        if (box[0] < 2 || box[2] > this.view.width - 2) cost += 500;
        if (box[1] < 2 || box[3] > this.view.height - 2) cost += 500;
        if (cost < best.cost) best = { cost, cx, cy, box };
      }
    }
    this.taken.push(best.box);
    return s(
      "text",
      { x: px(best.cx), y: px(best.cy + 4), "text-anchor": "middle", ...attributes },
      text
    );
  }
};

// src/burmester/web/widget/partner_curve.mjs
var PartnerCurve = class {
  /** @type {any} */
  pixel;
  constructor(data, pairs) {
    this.data = data;
    this.map = data.family_map;
    this.pairs = pairs;
    this.svg = s("svg", { class: "bm-pairs-scene", role: "img", "aria-label": "The centre-point curve, and the linkage of the pair at pose 1" });
  }
  /** Drawn anew; drawn: the group with the pair, place: of the linkage, colour: of a pair. */
  build(width, height, { drawn, place, colour }) {
    const { map, pairs, svg, data } = this;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    Object.assign(svg.style, { width: `${width}px`, height: `${height}px` });
    const best = map.fixed.map((_, i) => pairs.bestPartner(i));
    const poses = data.poses.map((pose) => [pose.x, pose.y]);
    const middle = [0, 1].map((k) => (Math.min(...poses.map((p) => p[k])) + Math.max(...poses.map((p) => p[k]))) / 2);
    const near = (p) => p.every((v, k) => Math.abs(v - middle[k]) < 3 * data.scene);
    const held = [...poses, ...map.fixed.filter((p, i) => best[i].kind < OUTSIDE && near(p)), ...pairs.pinsOf(place)];
    const low = [0, 1].map((k) => Math.min(...held.map((p) => p[k]))), high = [0, 1].map((k) => Math.max(...held.map((p) => p[k])));
    const scale = Math.min(width / (high[0] - low[0] || data.scene), height / (high[1] - low[1] || data.scene)) * 0.8;
    this.pixel = (p) => [width / 2 + (p[0] - (low[0] + high[0]) / 2) * scale, height / 2 - (p[1] - (low[1] + high[1]) / 2) * scale];
    const curve = s("g", { class: "bm-pairs-curve" }), under = s("g", { class: "bm-pairs-under" }), labels = new Labels({ width, height });
    const marks = s("g", { class: "bm-pairs-axes" });
    const inside2 = ([x, y]) => x > 0 && y > 0 && x < width && y < height;
    const beyond = (p, q) => !inside2(p) && !inside2(q) && (p[0] - width / 2) * (q[0] - width / 2) + (p[1] - height / 2) * (q[1] - height / 2) < 0;
    pairs.starts.forEach((start, loop) => {
      const size = map.loops[loop], at = (k) => this.pixel(map.fixed[start + (k + size) % size]);
      const between = (p, q) => [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];
      for (let k = 0; k < size; k += 1) {
        const piece = [between(at(k - 1), at(k)), at(k), between(at(k), at(k + 1))];
        if (beyond(at(k - 1), at(k)) || beyond(at(k), at(k + 1))) continue;
        const d = `M${piece.map((p) => p.map(px).join(" ")).join("L")}`;
        under.append(s("path", { d }));
        curve.append(s("path", { d, stroke: `rgb(${colour(best[start + k]).join()})` }));
      }
      for (const share of SHARES) {
        const [x, y] = at(Math.min(size - 1, Math.round(share * size)));
        if (!inside2([x, y])) continue;
        marks.append(s("circle", { class: "bm-pairs-mark", cx: px(x), cy: px(y), r: 2.2 }));
        marks.append(labels.put(x, y, `${pairs.letter(loop)}${share}`, 12, {}));
      }
    });
    const wanted = s("g", {});
    for (const pose of data.poses) {
      const [x, y] = this.pixel([pose.x, pose.y]).map(px);
      wanted.append(s("path", { class: "bm-cross", d: `M${x - 4} ${y}h8M${x} ${y - 4}v8` }), labels.put(x, y, pose.label, 10, { class: "bm-map-name" }));
    }
    svg.replaceChildren(under, curve, marks, wanted, drawn);
  }
};

// src/burmester/web/widget/family_map.mjs
var TINTS = ["", "", "outside", "order", "branch", "circuit", "none"];
var SHORT = ["works", "works", "outside limits or standard", "order defect", "branch defect", "circuit defect", ""];
var SPECK = 6;
var MARGIN2 = { left: 50, right: 8, top: 8, bottom: 26 };
var LARGEST = 520;
var BESIDE = 620;
var FamilyMap = class {
  /** @type {any} */
  tints;
  /** @type {any} */
  scale;
  /** @type {any} */
  curve;
  /** @type {any} */
  view;
  /** @type {any} */
  place;
  /** @type {any} */
  drawn;
  constructor(data, parent) {
    this.data = data;
    this.map = data.family_map;
    this.parent = parent;
    this.pairs = new FamilyPairs(data);
    const { isCurve, columns, rows } = this.pairs;
    this.isCurve = isCurve;
    this.columns = columns;
    this.rows = rows;
    this.canvas = h("canvas", { "aria-hidden": "true", width: this.columns, height: this.rows });
    const name = `bm-pairs-${Math.random().toString(36).slice(2)}`;
    const what = this.isCurve ? "pairs of dyads on the curve of four poses" : "the second fixed pivot of three poses";
    this.svg = s("svg", {
      class: "bm-pairs-picture",
      role: "application",
      tabindex: "0",
      "aria-roledescription": "map",
      "aria-describedby": name,
      "aria-label": `Family map: ${what}. Arrow keys move a cursor, with Shift by ten steps; what the pair does is told and drawn.`
    });
    this.curve = isCurve ? new PartnerCurve(data, this.pairs) : null;
    this.readout = h("output", { class: "bm-readout", id: name });
    this.legend = h("p", { class: "bm-legend" });
    this.box = h("div", { class: "bm-pairs" }, h("div", { class: "bm-pairs-map" }, this.canvas, this.svg), this.curve?.svg);
    parent.append(this.box, this.legend, this.readout);
    this.cursor = null;
    this.svg.addEventListener("pointermove", (event) => this.tell(this.cellAt(event)));
    this.svg.addEventListener("pointerdown", (event) => this.pin(this.cellAt(event)));
    this.svg.addEventListener("pointerleave", () => this.tell(this.cursor));
    this.svg.addEventListener("keydown", (event) => this.move(event));
  }
  build(linkage, index) {
    const { parent, svg, isCurve } = this, wide = Math.max(240, parent.clientWidth);
    const beside = isCurve && wide >= BESIDE, width = !isCurve ? wide : Math.min(LARGEST, beside ? Math.floor((wide - 16) / 2) : wide);
    const margin = isCurve ? MARGIN2 : { left: 0, right: 0, top: 0, bottom: 0 };
    const across = width - margin.left - margin.right;
    const down = isCurve ? across : Math.round(across * this.rows / this.columns);
    const height = down + margin.top + margin.bottom;
    this.box.classList.toggle("bm-beside", beside);
    Object.assign(this.canvas.style, { left: `${margin.left}px`, top: `${margin.top}px`, width: `${across}px`, height: `${down}px` });
    Object.assign(svg.parentElement.style, { width: `${width}px`, height: `${height}px` });
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.view = { width, height, margin, across, down };
    this.place = isCurve ? this.map.places[index ?? 0] ?? null : this.pairs.cellOf(this.map.other.fixed);
    this.paint();
    svg.replaceChildren(...this.outline(), isCurve ? this.axes() : this.ground());
    this.drawn = s("g", { class: "bm-pair-drawn" });
    this.mark = s("path", { class: "bm-map-cursor", d: "M-11 0H-4M4 0H11M0 -11V-4M0 4V11" });
    if (!isCurve) svg.append(this.drawn);
    svg.append(this.rings(), this.mark);
    this.curve?.build(beside ? wide - width - 16 : wide, height, { drawn: this.drawn, place: this.place, colour: (pair) => this.colour(pair) });
    this.explain();
    this.tell(this.cursor);
  }
  /** The colours of the style sheet, by name. */
  colours() {
    const style = getComputedStyle(this.parent);
    return (name) => rgb(style.getPropertyValue(`--bm-pair-${name}`));
  }
  /** The colour of a pair: a tint by its class, or along the scale by its angle. */
  colour({ kind, degrees: degrees2 }) {
    if (kind >= OUTSIDE) return this.tints[kind];
    const [low, high] = this.map.scale, share = 2 * clamp((degrees2 - low) / (high - low), 0, 1);
    const [from, to] = share < 1 ? [this.scale[0], this.scale[1]] : [this.scale[1], this.scale[2]];
    return from.map((c, k) => Math.round(c + (share % 1 || (share === 2 ? 1 : 0)) * (to[k] - c)));
  }
  paint() {
    const colour = this.colours(), context = this.canvas.getContext("2d");
    this.scale = ["low", "middle", "high"].map(colour);
    this.tints = TINTS.map((name) => name && name !== "none" ? colour(name) : rgb(getComputedStyle(this.parent).getPropertyValue("--bm-panel")));
    const image = context.createImageData(this.columns, this.rows);
    for (let j = 0; j < this.rows; j += 1) {
      for (let i = 0; i < this.columns; i += 1) {
        image.data.set([...this.colour(this.pairs.pair([i, j])), 255], 4 * ((this.rows - 1 - j) * this.columns + i));
      }
    }
    context.putImageData(image, 0, 0);
  }
  /** A line around the pairs that work with pivots where they are assumed, if others work, too. */
  outline() {
    const kinds = new Set(this.map.cells.map((code) => code % CLASSES));
    this.outlined = kinds.has(0) && kinds.has(1);
    if (!this.outlined) return [];
    const own = (i, j) => i >= 0 && j >= 0 && i < this.columns && j < this.rows && this.pairs.pair([i, j]).kind === 0;
    const mask = [];
    for (let j = -1; j <= this.rows; j += 1) {
      for (let i = -1; i <= this.columns; i += 1) {
        let around2 = 0;
        for (const dj of [-1, 0, 1]) for (const di of [-1, 0, 1]) around2 += Number(own(i + di, j + dj));
        mask.push(own(i, j) || around2 >= SPECK);
      }
    }
    const works = (i, j) => mask[(j + 1) * (this.columns + 2) + i + 1];
    const corner = (i, j) => this.middleOf([i - 0.5, j - 0.5]).map(px).join(" "), parts = [];
    for (let j = 0; j <= this.rows; j += 1) {
      for (let i = 0; i <= this.columns; i += 1) {
        if (works(i, j) !== works(i - 1, j)) parts.push(`M${corner(i, j)}L${corner(i, j + 1)}`);
        if (works(i, j) !== works(i, j - 1)) parts.push(`M${corner(i, j)}L${corner(i + 1, j)}`);
      }
    }
    const d = parts.join("");
    return [s("path", { class: "bm-pair-halo bm-thin", d }), s("path", { class: "bm-pair-outline", d })];
  }
  /** The middle of a cell in pixels. */
  middleOf([i, j]) {
    const { margin, across, down } = this.view;
    return [margin.left + (i + 0.5) / this.columns * across, margin.top + down - (j + 0.5) / this.rows * down];
  }
  /** The cell under the pointer; null beside the map. */
  cellAt(event) {
    const box = this.svg.getBoundingClientRect(), { margin, across, down, width, height } = this.view;
    const x = (event.clientX - box.left) / box.width * width - margin.left;
    const y = (event.clientY - box.top) / box.height * height - margin.top;
    if (x < 0 || y < 0 || x >= across || y >= down) return this.cursor;
    return [Math.floor(x / across * this.columns), Math.floor((1 - y / down) * this.rows)].map((v, k) => clamp(v, 0, (k ? this.rows : this.columns) - 1));
  }
  /** Ticks and lines between loops, on both axes of the square. */
  axes() {
    const { margin, across, down } = this.view, out = s("g", { class: "bm-pairs-axes" });
    const { pairs } = this, left = margin.left, foot2 = margin.top + down;
    pairs.starts.forEach((start, loop) => {
      const size = this.map.loops[loop], letter = pairs.letter(loop);
      const shares = size / this.columns * across < 150 ? [0, 0.5] : SHARES;
      for (const share of shares) {
        const along = (start + share * size) / this.columns * across, text = `${letter}${share}`;
        out.append(
          s("path", { d: `M${px(left + along)} ${foot2}v4M${left} ${px(foot2 - along)}h-4` }),
          s("text", { x: px(left + along), y: foot2 + 17, "text-anchor": "middle" }, text),
          s("text", { x: left - 7, y: px(foot2 - along + 4), "text-anchor": "end" }, text)
        );
      }
      if (loop) {
        const at = start / this.columns * across;
        out.append(s("path", { d: `M${px(left + at)} ${margin.top}v${down}M${left} ${px(foot2 - at)}h${across}` }));
      }
    });
    out.append(s("rect", { x: left, y: margin.top, width: across, height: down, fill: "none" }));
    return out;
  }
  /** Poses, poles and the fixed pivot of the dyad that is chosen, over the plane of three poses. */
  ground() {
    const out = s("g", {}), labels = new Labels(this.view);
    for (const pose of this.data.poses) {
      const at = this.pixel([pose.x, pose.y]);
      out.append(s("path", { class: "bm-cross", d: `M${at[0] - 4} ${at[1]}h8M${at[0]} ${at[1] - 4}v8` }), labels.put(at[0], at[1], pose.label, 10, { class: "bm-map-name" }));
    }
    for (const pole of this.map.poles) {
      const [x, y] = this.pixel(pole);
      out.append(s("path", { class: "bm-pole", d: `M${x} ${y - 5}l4.5 8h-9z` }));
    }
    if (this.map.chosen.fixed) {
      const at = this.pixel(this.map.chosen.fixed);
      out.append(s("circle", { class: "bm-its-pivot bm-side0", cx: at[0], cy: at[1], r: 6 }), labels.put(at[0], at[1], this.map.chosen.id, 12, { class: "bm-map-name" }));
    }
    return out;
  }
  /** A point of F in pixels of the plane of three poses. */
  pixel(point) {
    const { low, high } = this.map, many = [this.columns, this.rows];
    return this.middleOf(point.map((v, k) => (v - low[k]) / (high[k] - low[k]) * (many[k] - 1))).map(px);
  }
  /** Rings around the linkage: on the square twice, as each pair has its place twice. */
  rings() {
    const out = s("g", {});
    if (!this.place) return out;
    for (const at of this.isCurve ? [this.place, [...this.place].reverse()] : [this.place]) {
      const [x, y] = this.middleOf(at).map(px);
      out.append(s("circle", { class: "bm-pair-halo", cx: x, cy: y, r: 7 }), s("circle", { class: "bm-pair-ring", cx: x, cy: y, r: 7 }));
    }
    return out;
  }
  explain() {
    const [low, high] = this.map.scale, swatch = (name) => h("span", { class: `bm-swatch bm-pair-${name}` });
    const used = new Set(this.map.cells.map((code) => code % CLASSES));
    this.legend.replaceChildren(
      h("span", { class: "bm-pair-scale", "aria-hidden": "true" }),
      ` works: transmission angle from ${fixed(low, 0)}° to ${fixed(high, 0)}°. `,
      ...TINTS.flatMap((name, kind) => kind >= OUTSIDE && SHORT[kind] && used.has(kind) ? [h("span", { class: "bm-pair-key" }, swatch(name), ` ${SHORT[kind]}`), " "] : []),
      this.outlined ? "Outlined: works with pivots where they are assumed to lie; the rest works with pivots farther away. " : "",
      this.place ? this.isCurve ? "Ring: this linkage." : `Ring: ${this.map.other.id}. Triangles: poles.` : this.isCurve ? "" : "Triangles: poles."
    );
  }
  /** Move the cursor by a key, from one pair to the next; it starts at the linkage. */
  move(event) {
    if (event.key === "Escape" && this.cursor) {
      this.pin(null);
      return;
    }
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const many = event.shiftKey ? 10 : 1, [i, j] = this.cursor ?? this.place ?? [this.columns >> 1, this.rows >> 1];
    this.pin([clamp(i + many * step[0], 0, this.columns - 1), clamp(j + many * step[1], 0, this.rows - 1)]);
  }
  /** Put the cursor on a pair, or take it away. */
  pin(cell) {
    this.cursor = cell;
    this.tell(cell);
  }
  /** Say what a pair does, and draw its linkage at pose 1; without a pair how to get one. */
  tell(cell) {
    const { mark, cursor } = this;
    mark.setAttribute("visibility", cursor ? "visible" : "hidden");
    if (cursor) mark.setAttribute("transform", `translate(${this.middleOf(cursor).map(px).join(" ")})`);
    const shown = cell ?? this.place;
    this.drawPair(shown);
    this.readout.textContent = cell ? this.words(cell) : "Point at the map to read a pair, or move over it by arrow keys.";
  }
  words(cell) {
    const { kind, driver, degrees: degrees2 } = this.pairs.pair(cell), { map } = this, { words } = map;
    const digits = Math.max(0, 2 - Math.floor(Math.log10(this.data.scene))), unit2 = this.data.unit ? ` ${this.data.unit}` : "";
    const point = (p) => `(${p.map((v) => fixed(v, digits)).join(", ")})`;
    const dyad = ({ fixed: c, moving: m, length }) => `fixed pivot ${point(c)}, moving pivot ${point(m)}, link ${figure(length)}${unit2}`;
    const dyads = this.pairs.dyadsOf(cell);
    const does = kind <= OUTSIDE ? `${words[kind]}; transmission angle ${degrees2}° or more, driven by ${this.isCurve ? ["the first", "the second"][driver] : [map.chosen.id, "the other one"][driver]}` : words[kind];
    if (!this.isCurve) return `${capital(dyad(dyads[1]))}: ${does}.`;
    return `${this.pairs.placeName(cell[0])} with ${this.pairs.placeName(cell[1])}: ${does}. First: ${dyad(dyads[0])}. Second: ${dyad(dyads[1])}.`;
  }
  drawPair(cell) {
    this.drawn.replaceChildren();
    if (!cell) return;
    const to = this.isCurve ? this.curve.pixel : (p) => this.pixel(p), [pose] = this.data.poses;
    const dyads = this.pairs.dyadsOf(cell), pins = dyads.filter((each) => each.moving).map((each) => to(this.pairs.seen(each.moving)));
    const line = (points, name) => s("path", { class: name, d: `M${points.map((p) => p.map(px).join(" ")).join("L")}` });
    this.drawn.append(line([...pins, to([pose.x, pose.y])], "bm-pair-body"));
    dyads.forEach((each, side) => {
      if (each.fixed && each.moving) this.drawn.append(line([to(each.fixed), to(this.pairs.seen(each.moving))], `bm-pair-link bm-side${side}`));
      if (each.fixed) this.drawn.append(dot(to(each.fixed), `bm-pair-ground bm-side${side}`, 4.5));
    });
    for (const pin of pins) this.drawn.append(dot(pin, "bm-pair-pin", 3.2));
  }
};
var dot = ([x, y], name, r) => s("circle", { class: name, cx: px(x), cy: px(y), r });
var capital = (text) => text[0].toUpperCase() + text.slice(1);

// src/burmester/web/widget/header.mjs
var OPEN = /^R(303|31)/;
function header(data, good) {
  const { outcome, warnings } = data, open = OPEN.test(outcome.code);
  const [best, ...more] = good ? data.best : [];
  const found = [`${outcome.message[0].toUpperCase()}${outcome.message.slice(1)}. `, h("span", { class: "bm-code" }, outcome.code)];
  const said = (text) => text && data.best.some((sentence) => sentence.slice(1).startsWith(text.slice(1)));
  const told = [notes({ why: said(outcome.why) ? null : outcome.why, help: said(outcome.help) ? null : outcome.help }), warnings.length ? h("ul", { class: "bm-warnings", "aria-label": "Warnings" }, warnings.map(warning)) : null];
  const count = warnings.length ? `, and ${warnings.length} warning${warnings.length === 1 ? "" : "s"}` : "";
  return h(
    "header",
    { class: "bm-head" },
    h("p", { class: "bm-overline" }, `burmester · ${data.overline ?? "linkage report"}`),
    data.title ? h("h1", {}, data.title) : null,
    h(
      "p",
      { class: `bm-outcome ${good ? "bm-good" : open ? "bm-open" : "bm-bad"}` },
      h("span", { class: "bm-sign", "aria-hidden": "true" }, good ? "✓" : open ? "i" : "✕"),
      h("span", {}, best ?? found)
    ),
    (best ? more : data.best).map((sentence) => h("p", { class: "bm-best" }, sentence)),
    best ? h("details", { class: "bm-about" }, h("summary", {}, `How it was found${count}`), h("p", { class: "bm-found" }, found), told) : told
  );
}
var warning = (each) => h(
  "li",
  {},
  h("p", {}, h("b", {}, "! Warning "), h("span", { class: "bm-code" }, each.code), ` ${each.message}.`),
  notes(each)
);
var notes = ({ why, help }) => [
  why ? h("p", { class: "bm-why" }, h("b", {}, "Why: "), why, ".") : null,
  help ? h("p", { class: "bm-why" }, h("b", {}, "What helps: "), help, ".") : null
];

// src/burmester/web/widget/vectors.mjs
var dot2 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
var scaled = (a, k) => [a[0] * k, a[1] * k, a[2] * k];
var plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
var cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
var unit = (a) => scaled(a, 1 / Math.hypot(...a));
var times = (c, p, w) => [0, 4, 8, 12].map((r) => c[r] * p[0] + c[r + 1] * p[1] + c[r + 2] * p[2] + c[r + 3] * w);
function intersections(c, o, d) {
  const cd = times(c, d, 0), co = times(c, o, 1);
  const a = dot2(d, cd), b = dot2(o, cd) + cd[3], e = dot2(o, co) + co[3];
  const root = b * b - a * e;
  if (root < 0) return [];
  const q = -(b + (b < 0 ? -1 : 1) * Math.sqrt(root));
  const roots = [];
  if (Math.abs(a) > 1e-12 * Math.abs(q)) roots.push(q / a);
  if (q !== 0) roots.push(e / q);
  return roots;
}

// src/burmester/web/widget/ray_casting.mjs
var WIDTH2 = 440;
var TURNING_SHARE = 0.35;
function drawStill(canvas, scene, size, turning) {
  const share = turning ? TURNING_SHARE : Math.min(1, WIDTH2 / size.width);
  const width = Math.round(size.width * share), height = Math.round(size.height * share);
  canvas.width = width;
  canvas.height = height;
  if (!scene.quadrics.length) return;
  const context = canvas.getContext("2d");
  if (!context) return;
  const image = context.createImageData(width, height);
  cast(image, scene);
  context.putImageData(image, 0, 0);
}
function cast(image, { eye, ahead, right, up, reach, quadrics, paint, angles }) {
  const { data, width, height } = image, [ex, ey, ez] = eye, [zc, zh, middleAngle, step] = angles;
  const lamp = unit(plus(plus(scaled(ahead, -1), scaled(up, 0.5)), scaled(right, -0.6)));
  const far = new Float64Array(4), which = new Uint8Array(4);
  for (let j = 0; j < height; j += 1) {
    const v = (1 - (2 * j + 1) / height) * reach[1];
    for (let i = 0; i < width; i += 1) {
      const u = ((2 * i + 1) / width - 1) * reach[0];
      let dx = ahead[0] + u * right[0] + v * up[0];
      let dy = ahead[1] + u * right[1] + v * up[1];
      let dz = ahead[2] + u * right[2] + v * up[2];
      const size = 1 / Math.sqrt(dx * dx + dy * dy + dz * dz);
      dx *= size;
      dy *= size;
      dz *= size;
      const x1 = (-1 - ex) / dx, x2 = (1 - ex) / dx, y1 = (-1 - ey) / dy, y2 = (1 - ey) / dy;
      const z1 = (-1 - ez) / dz, z2 = (1 - ez) / dz;
      const enter = Math.max(Math.min(x1, x2), Math.min(y1, y2), Math.min(z1, z2));
      const leave = Math.min(Math.max(x1, x2), Math.max(y1, y2), Math.max(z1, z2));
      if (!(enter < leave)) continue;
      const middle = (enter + leave) / 2, half = (leave - enter) / 2;
      const ox = ex + middle * dx, oy = ey + middle * dy, oz = ez + middle * dz;
      let count = 0;
      for (let k = 0; k < quadrics.length; k += 1) {
        const c = quadrics[k];
        const cx = c[0] * dx + c[1] * dy + c[2] * dz, cy = c[4] * dx + c[5] * dy + c[6] * dz;
        const cz = c[8] * dx + c[9] * dy + c[10] * dz, cw = c[12] * dx + c[13] * dy + c[14] * dz;
        const a = dx * cx + dy * cy + dz * cz, b = ox * cx + oy * cy + oz * cz + cw;
        const e = ox * (c[0] * ox + 2 * (c[1] * oy + c[2] * oz + c[3])) + oy * (c[5] * oy + 2 * (c[6] * oz + c[7])) + oz * (c[10] * oz + 2 * c[11]) + c[15];
        const root = b * b - a * e;
        if (root < 0) continue;
        const q = -(b + (b < 0 ? -1 : 1) * Math.sqrt(root));
        for (let side = 0; side < 2; side += 1) {
          const t = side ? e / q : q / a;
          if (!(Math.abs(t) <= half)) continue;
          let at2 = count;
          while (at2 > 0 && far[at2 - 1] > t) {
            far[at2] = far[at2 - 1];
            which[at2] = which[at2 - 1];
            at2 -= 1;
          }
          far[at2] = t;
          which[at2] = k;
          count += 1;
        }
      }
      if (!count) continue;
      let red = 0, green = 0, blue = 0, through = 1;
      for (let k = 0; k < count; k += 1) {
        const t = far[k], c = quadrics[which[k]], own = paint[which[k]];
        const x = ox + t * dx, y = oy + t * dy, z = oz + t * dz;
        let nx = c[0] * x + c[1] * y + c[2] * z + c[3];
        let ny = c[4] * x + c[5] * y + c[6] * z + c[7];
        let nz = c[8] * x + c[9] * y + c[10] * z + c[11];
        const n = 1 / Math.sqrt(nx * nx + ny * ny + nz * nz);
        nx *= n;
        ny *= n;
        nz *= n;
        const facing = Math.abs(nx * dx + ny * dy + nz * dz);
        const pixels = (middle + t) * reach[1] / height * (Math.sqrt(Math.max(0, 1 - nz * nz)) / Math.max(facing, 0.15)) + 1e-4;
        const z3 = zc + zh * z, turns = (2 * Math.atan(z3) + middleAngle) / step;
        const off = Math.abs(turns - Math.round(turns)) * step * (1 + z3 * z3) / (2 * zh);
        const line = 1 - clamp((off / pixels - 0.5) / 1.1, 0, 1);
        const lit = (0.42 + 0.58 * Math.abs(nx * lamp[0] + ny * lamp[1] + nz * lamp[2])) * (1 - 0.35 * line);
        const alpha = 0.5 + 0.42 * (1 - facing) * (1 - facing), share = through * alpha;
        red += share * own[0] * lit;
        green += share * own[1] * lit;
        blue += share * own[2] * lit;
        through *= 1 - alpha;
      }
      const at = 4 * (j * width + i), whole = 255 / (1 - through);
      data[at] = red * whole;
      data[at + 1] = green * whole;
      data[at + 2] = blue * whole;
      data[at + 3] = 255 * (1 - through);
    }
  }
}

// src/burmester/web/widget/shader.mjs
var STILL_MILLISECONDS = 250;
var TURNING_MILLISECONDS = 25;
var UNIFORMS = ["surface", "paint", "eye", "right", "up", "ahead", "reach", "pixel", "samples", "angles"];
var VERTEX = `#version 300 es
in vec2 corner;
out vec2 at;
void main() { at = corner; gl_Position = vec4(corner, 0.0, 1.0); }`;
var FRAGMENT = `#version 300 es
precision highp float;
in vec2 at;
out vec4 colour;
uniform mat4 surface[2];
uniform vec3 paint[2];
uniform vec3 eye, right, up, ahead;
uniform vec2 reach;   // half the picture's width and height, over the distance to it
uniform vec2 pixel;   // a pixel's share of at
uniform int samples;
uniform vec4 angles;  // of M: Z3 in the middle of the box and half its height, middle angle, step of lines

void meet(mat4 c, vec3 o, vec3 d, out float t1, out float t2) {
  vec4 o4 = vec4(o, 1.0), d4 = vec4(d, 0.0);
  vec4 cd = c * d4;
  float a = dot(d4, cd), b = dot(o4, cd), e = dot(o4, c * o4);
  float root = b * b - a * e;
  t1 = t2 = 1e9;
  if (root < 0.0) return;
  float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(root));
  if (abs(a) > 1e-9 * abs(q)) t1 = q / a;
  if (q != 0.0) t2 = e / q;
}

vec4 ray(vec2 xy) {
  vec3 d = normalize(ahead + xy.x * reach.x * right + xy.y * reach.y * up);
  vec3 near3 = (-1.0 - eye) / d, far3 = (1.0 - eye) / d;
  vec3 least = min(near3, far3), most = max(near3, far3);
  float enter = max(max(least.x, least.y), least.z), leave = min(min(most.x, most.y), most.z);
  if (enter >= leave) return vec4(0.0);
  float middle = (enter + leave) / 2.0;
  vec3 o = eye + middle * d;
  float reachable = (leave - enter) / 2.0;
  vec2 hit[4]; // how far, and which surface
  meet(surface[0], o, d, hit[0].x, hit[1].x);
  meet(surface[1], o, d, hit[2].x, hit[3].x);
  hit[0].y = hit[1].y = 0.0;
  hit[2].y = hit[3].y = 1.0;
  // Sorted, each pair first.
  for (int k = 0; k < 5; k++) {
    int i = k == 1 ? 2 : k == 3 ? 1 : k == 4 ? 1 : 0, j = k == 0 ? 1 : k == 1 ? 3 : k == 2 ? 2 : k == 3 ? 3 : 2;
    if (hit[i].x > hit[j].x) { vec2 other = hit[i]; hit[i] = hit[j]; hit[j] = other; }
  }
  vec3 light = vec3(0.0);
  float through = 1.0;
  for (int k = 0; k < 4; k++) {
    float t = hit[k].x;
    if (abs(t) > reachable) continue;
    bool first = hit[k].y < 0.5;
    vec3 p = o + t * d;
    vec3 n = normalize(((first ? surface[0] : surface[1]) * vec4(p, 1.0)).xyz);
    float facing = abs(dot(n, d));
    vec3 lamp = normalize(-ahead + 0.5 * up - 0.6 * right);
    float lit = 0.42 + 0.58 * abs(dot(n, lamp));
    float shine = pow(abs(dot(n, normalize(lamp - d))), 40.0);
    float width = (middle + t) * pixel.y * reach.y * sqrt(max(0.0, 1.0 - n.z * n.z)) / max(facing, 0.15) + 1e-4;
    float z = angles.x + angles.y * p.z;
    float turns = (2.0 * atan(z) + angles.z) / angles.w;
    float off = abs(fract(turns + 0.5) - 0.5) * angles.w * (1.0 + z * z) / (2.0 * angles.y);
    float line = 1.0 - smoothstep(0.5 * width, 1.6 * width, off);
    float alpha = mix(0.5, 0.92, pow(1.0 - facing, 2.0));
    vec3 own = (first ? paint[0] : paint[1]) * lit * (1.0 - 0.35 * line) + 0.22 * shine;
    light += through * alpha * own;
    through *= 1.0 - alpha;
  }
  return vec4(light, 1.0 - through);
}

void main() {
  if (samples == 1) { colour = ray(at); return; }
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 4; k++) {
    vec2 part = vec2(k % 2 == 0 ? -0.5 : 0.5, k < 2 ? -0.5 : 0.5);
    sum += ray(at + part * pixel);
  }
  colour = sum / 4.0;
}`;
function hasGraphics() {
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  const named = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && named ? gl.getParameter(named.UNMASKED_RENDERER_WEBGL) : "";
  return Boolean(gl) && !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
var Shader = class _Shader {
  /** @type {any} */
  pace;
  /** The shader on a canvas, null where it cannot be; `lost` is called when it ceases to be. */
  static on(canvas, lost) {
    if (!hasGraphics()) return null;
    const gl = canvas.getContext("webgl2", { antialias: false, premultipliedAlpha: true, preserveDrawingBuffer: true });
    if (!gl) return null;
    const program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      lost();
      return null;
    }
    canvas.addEventListener("webglcontextlost", lost, { once: true });
    return new _Shader(canvas, gl, program);
  }
  constructor(canvas, gl, program) {
    this.canvas = canvas;
    this.gl = gl;
    gl.useProgram(program);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
    const corner = gl.getAttribLocation(program, "corner");
    gl.enableVertexAttribArray(corner);
    gl.vertexAttribPointer(corner, 2, gl.FLOAT, false, 0, 0);
    this.places = Object.fromEntries(UNIFORMS.map((name) => [name, gl.getUniformLocation(program, name)]));
  }
  draw(scene, size, turning) {
    const { gl, places } = this;
    gl.clearColor(0, 0, 0, 0);
    if (!scene.quadrics.length) {
      gl.clear(gl.COLOR_BUFFER_BIT);
      return;
    }
    gl.uniformMatrix4fv(places.surface, false, new Float32Array(scene.quadrics.flat()));
    gl.uniform3fv(places.paint, new Float32Array(scene.paint.flat()));
    for (const name of ["eye", "right", "up", "ahead"]) gl.uniform3fv(places[name], scene[name]);
    gl.uniform2fv(places.reach, scene.reach);
    gl.uniform4fv(places.angles, scene.angles);
    this.pace ??= this.measure(size);
    const full = Math.min(2, window.devicePixelRatio || 1), most = turning ? TURNING_MILLISECONDS : STILL_MILLISECONDS;
    const ways = turning ? [[1, 1], [0.7, 1], [0.45, 1]] : [[full, 4], [1, 4], [full, 1], [1, 1], [0.7, 1]];
    const fits = ways.find(([dense, samples]) => dense * dense * samples * this.pace * size.width * size.height < most);
    this.once(size, ...fits ?? ways[ways.length - 1]);
  }
  /** Milliseconds a ray takes: where graphics are slow, the picture gets fewer of them. */
  measure(size) {
    const { gl } = this;
    this.once(size, 0.12, 1);
    gl.finish();
    const start = performance.now();
    this.once(size, 0.3, 1);
    gl.finish();
    return (performance.now() - start) / (0.09 * size.width * size.height);
  }
  /** One picture: pixels of the canvas per pixel of the page along a side, rays per pixel. */
  once(size, dense, samples) {
    const { gl, canvas, places } = this;
    const width = Math.round(size.width * dense), height = Math.round(size.height * dense);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    gl.viewport(0, 0, width, height);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.uniform2f(places.pixel, 1 / width, 1 / height);
    gl.uniform1i(places.samples, samples);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
};

// src/burmester/web/widget/image_space.mjs
var FOCAL_LENGTH = 2.3;
var EYE_DISTANCE = 4.6;
var START = { around: -0.62, above: 0.38, zoom: 1 };
var MANY_POSES = 40;
var inside = (point) => point.every((value) => Math.abs(value) <= 1.0001);
var ImageSpace = class {
  /** @type {any} */
  waiting;
  /** @type {any} */
  space;
  /** @type {any} */
  marks;
  /** @type {any} */
  view;
  /** @type {any} */
  width;
  /** @type {any} */
  height;
  constructor(data, parent, webgl) {
    this.data = data;
    this.parent = parent;
    this.turn = { ...START };
    this.canvas = h("canvas", { "aria-hidden": "true" });
    this.svg = s("svg", { "aria-hidden": "true" });
    this.note = h("p", { class: "bm-readout" });
    this.box = h("div", {
      class: "bm-space",
      role: "img",
      tabindex: "0",
      "aria-label": "Image space: two surfaces and the curve they meet in. Arrow keys turn it, plus and minus zoom."
    }, this.canvas, this.svg);
    parent.append(this.box, this.note);
    this.shader = webgl ? Shader.on(this.canvas, () => this.withoutGl()) : null;
    this.explain();
    this.listen();
  }
  explain() {
    this.canvas.dataset.drawn = this.shader ? "webgl" : "still";
    this.note.textContent = this.shader ? "Drag it, or turn it with the arrow keys; + and − zoom, 0 goes back." : "A still picture, for fast WebGL 2 is missing here; it can be turned all the same, by dragging or with the arrow keys.";
  }
  /** Go on without WebGL, on a fresh canvas: the old one can hold nothing else. */
  withoutGl() {
    const fresh = this.canvas.cloneNode();
    this.canvas.replaceWith(fresh);
    this.canvas = fresh;
    this.shader = null;
    this.explain();
    if (this.space) this.draw(false);
  }
  listen() {
    const { box } = this;
    let grip = null;
    box.addEventListener("pointerdown", (event) => {
      grip = [event.clientX, event.clientY];
      box.setPointerCapture(event.pointerId);
    });
    box.addEventListener("pointermove", (event) => {
      if (!grip) return;
      this.turn.around -= 8e-3 * (event.clientX - grip[0]);
      this.turn.above += 8e-3 * (event.clientY - grip[1]);
      grip = [event.clientX, event.clientY];
      this.redraw(true);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      box.addEventListener(end, () => {
        if (grip) this.redraw(false);
        grip = null;
      });
    }
    box.addEventListener("keydown", (event) => {
      const { turn } = this;
      const step = {
        ArrowLeft: () => turn.around += 0.1,
        ArrowRight: () => turn.around -= 0.1,
        ArrowUp: () => turn.above += 0.1,
        ArrowDown: () => turn.above -= 0.1,
        "+": () => turn.zoom *= 1.15,
        "=": () => turn.zoom *= 1.15,
        "-": () => turn.zoom /= 1.15,
        0: () => Object.assign(turn, START)
      }[event.key];
      if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      step();
      this.redraw(false);
    });
  }
  redraw(turning) {
    this.turn.above = clamp(this.turn.above, -1.5, 1.5);
    this.turn.zoom = clamp(this.turn.zoom, 0.6, 4);
    cancelAnimationFrame(this.waiting);
    this.waiting = requestAnimationFrame(() => this.draw(turning));
  }
  /** The point of the box that is a place of the body. */
  point(place) {
    const { chart } = this.data, { centre, half } = this.space;
    const x = (place.x - chart.origin[0]) / chart.length, y = (place.y - chart.origin[1]) / chart.length;
    const t = Math.tan((place.a - chart.angle) / 2);
    return [(x * t - y) / 2, (x + y * t) / 2, t].map((value, k) => (value - centre[k]) / half[k]);
  }
  /** A linkage on its way `index`; quick: coarsely, for more changes follow. */
  build(linkage, index, quick = false) {
    this.linkage = linkage;
    this.space = linkage?.space ?? this.data.space;
    this.poses = this.data.poses.map((pose, k) => {
      const at = isPoint(pose) ? linkage?.pose_errors[k] : pose;
      return at && at.x !== null ? this.point({ x: at.x, y: at.y, a: radians(at.angle_deg) }) : null;
    });
    this.curves = (linkage?.ways ?? []).map((way, k) => ({
      here: k === index,
      points: Array.from(way.x, (x, i) => this.point({ x, y: way.y[i], a: way.angle[i] }))
    }));
    const { centre, half } = this.space;
    const angleOf = (q) => degrees(2 * Math.atan(centre[2] + half[2] * q) + this.data.chart.angle);
    this.marks = angleTicks(angleOf(-1), angleOf(1), 7);
    const width = Math.max(240, this.parent.clientWidth);
    this.width = width;
    this.height = Math.round(clamp(0.8 * width, 240, 520));
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
    this.box.style.height = `${this.height}px`;
    this.draw(quick);
  }
  camera() {
    const { around: around2, above, zoom } = this.turn;
    const ahead = [
      -Math.cos(above) * Math.sin(around2),
      Math.cos(above) * Math.cos(around2),
      -Math.sin(above)
    ];
    const right = [Math.cos(around2), Math.sin(around2), 0];
    const up = cross(right, ahead);
    const eye = scaled(ahead, -EYE_DISTANCE);
    const least = Math.min(this.width, this.height);
    const focal = least / 2 * FOCAL_LENGTH * zoom * 1.02;
    return { ahead, right, up, eye, focal, reach: [this.width / 2 / focal, this.height / 2 / focal] };
  }
  draw(turning) {
    this.view = this.camera();
    const scene = this.sceneOf(this.view);
    if (this.shader) this.shader.draw(scene, this, turning);
    else drawStill(this.canvas, scene, this, turning);
    this.overlay();
    if (this.place) this.show(this.place);
  }
  /** What is drawn: the camera, the quadrics, their colours (0 to 1) and the lines of equal angle. */
  sceneOf(camera) {
    const style = getComputedStyle(this.parent);
    const paint = ["--bm-driver-solid", "--bm-follower-solid"].map((name) => rgb(style.getPropertyValue(name)).map((v) => v / 255));
    return { ...camera, paint, quadrics: this.space.quadrics, angles: this.angles() };
  }
  /** Of M: Z3 in the middle of the box and half its height, middle angle, step of the lines. */
  angles() {
    const { centre, half } = this.space, { marks } = this;
    const step = marks.length > 1 ? radians(marks[1].at - marks[0].at) : Math.PI;
    return [centre[2], half[2], this.data.chart.angle, step];
  }
  /** From the box to pixels, as the camera sees it. */
  project(point) {
    const { eye, ahead, right, up, focal } = this.view;
    const to = [0, 1, 2].map((k) => point[k] - eye[k]), depth = dot2(to, ahead);
    return [this.width / 2 + focal * dot2(to, right) / depth, this.height / 2 - focal * dot2(to, up) / depth];
  }
  /** The number of sheets of the surfaces between a point and the eye. */
  sheetsBefore(point) {
    const to = plus(this.view.eye, scaled(point, -1)), d = unit(to);
    let leave = Infinity;
    for (let k = 0; k < 3; k += 1) leave = Math.min(leave, ((d[k] > 0 ? 1 : -1) - point[k]) / d[k]);
    let count = 0;
    for (const c of this.space.quadrics) for (const t of intersections(c, point, d)) if (t > 0.02 && t < leave) count += 1;
    return count;
  }
  /** Lines, points and names over the surfaces. */
  overlay() {
    const { svg } = this;
    const back2 = this.view.ahead.map((value) => value > 0 ? 1 : -1);
    svg.replaceChildren(...this.edges(back2), ...this.axisNames(back2), ...this.angleMarks(), ...this.motions());
    this.images();
    this.runner = s("circle", { class: "bm-runner", r: 6, visibility: "hidden" });
    svg.append(this.runner);
  }
  /** Edges of the box; those at the farthest corner are behind everything. */
  edges(back2) {
    let front = "", behind = "";
    for (let axis = 0; axis < 3; axis += 1) {
      for (const [b, c] of [[-1, -1], [-1, 1], [1, -1], [1, 1]]) {
        const one = [0, 0, 0], [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
        [one[j], one[k], one[axis]] = [b, c, -1];
        const other = [...one];
        other[axis] = 1;
        const d = `M${this.project(one).map(px).join(" ")}L${this.project(other).map(px).join(" ")}`;
        if (b === back2[j] && c === back2[k]) behind += d;
        else front += d;
      }
    }
    return [s("path", { class: "bm-box bm-behind", d: behind }), s("path", { class: "bm-box", d: front })];
  }
  /** Names at the middle of edges that are in sight. */
  axisNames(back2) {
    const name = (point, text) => {
      const [x, y] = this.project(point), [cx, cy] = [x - this.width / 2, y - this.height / 2];
      const size = Math.hypot(cx, cy) || 1;
      return s("text", { class: "bm-axis", x: px(x + 14 * cx / size), y: px(y + 14 * cy / size + 4), "text-anchor": "middle" }, text);
    };
    const base = this.turn.above >= 0 ? -1 : 1;
    return [name([0, -back2[1], base], "Z1"), name([-back2[0], 0, base], "Z2")];
  }
  /** The third coordinate, as the angle of M, at the edge farthest to the left. */
  angleMarks() {
    const upright = [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(([a, b]) => ({ a, b, x: this.project([a, b, 0])[0] }));
    const edge = upright.reduce((one, other) => other.x < one.x ? other : one);
    const { centre, half } = this.space;
    return this.marks.flatMap(({ at, text }) => {
      const t = Math.tan((radians(at) - this.data.chart.angle) / 2), q = (t - centre[2]) / half[2];
      const [x, y] = this.project([edge.a, edge.b, q]);
      return [
        s("path", { class: "bm-box", d: `M${px(x)} ${px(y)}h-5` }),
        s("text", { class: "bm-axis", x: px(x - 8), y: px(y + 4), "text-anchor": "end" }, text)
      ];
    });
  }
  /** The motions of the coupler, in two paths each: behind a surface and before them. */
  motions() {
    return this.curves.flatMap(({ here, points }) => {
      const paths = ["", ""];
      let last = null;
      for (let k = 0; k < points.length; k += 1) {
        const p = points[k];
        if (!inside(p) || k && Math.hypot(...plus(p, scaled(points[k - 1], -1))) > 0.6) last = null;
        if (!inside(p)) continue;
        const at = this.project(p), hidden = this.sheetsBefore(p) > 0 ? 1 : 0;
        if (last) paths[hidden] += `M${last.map(px).join(" ")}L${at.map(px).join(" ")}`;
        last = at;
      }
      const kind = here ? "bm-here" : "bm-other";
      return [
        s("path", { class: `bm-motion bm-hidden ${kind}`, d: paths[1] }),
        s("path", { class: `bm-motion ${kind}`, d: paths[0] })
      ];
    });
  }
  /** The image points of the poses, with their names. */
  images() {
    const { svg, data } = this;
    const labels = new Labels({ width: this.width, height: this.height });
    const shown = this.poses.map((point, k) => ({ point, k })).filter(({ point }) => point && inside(point));
    for (const { point } of shown) {
      const [x, y] = this.project(point);
      labels.block(x, y, 10, 10);
    }
    for (const { point, k } of shown) {
      const [x, y] = this.project(point), hidden = this.sheetsBefore(point) > 0;
      svg.append(s("circle", { class: `bm-image-point${hidden ? " bm-hidden" : ""}`, cx: px(x), cy: px(y), r: 4 }));
      if (shown.length <= MANY_POSES && isNamed(data, k)) svg.append(labels.put(x, y, data.poses[k].label, 12, { class: "bm-image-name" }));
    }
  }
  /** No place of the body is known. */
  hide() {
    this.place = null;
    this.runner.setAttribute("visibility", "hidden");
  }
  show(place) {
    this.place = place;
    const point = this.point(place);
    const inside2 = point.every((value) => Math.abs(value) <= 1.02);
    this.runner.setAttribute("visibility", inside2 ? "visible" : "hidden");
    if (!inside2) return;
    const [x, y] = this.project(point);
    this.runner.setAttribute("transform", `translate(${px(x)} ${px(y)})`);
  }
};

// src/burmester/web/widget/keyboard.mjs
var TYPED_IN = "button, select, textarea, summary, a, input[type=checkbox]";
function listenToKeys(root, drawing, player, signal) {
  root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !player.path) return;
    if (event.key === " " && !event.target.matches(TYPED_IN)) {
      event.preventDefault();
      player.play(!player.playing);
    } else if (event.target === drawing && /^Arrow/.test(event.key)) {
      event.preventDefault();
      const sense = event.key === "ArrowLeft" || event.key === "ArrowDown" ? -1 : 1;
      player.step(event.shiftKey ? 10 * sense : sense);
    }
  }, { signal });
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || event.target !== document.body || !player.path) return;
    event.preventDefault();
    player.play(!player.playing);
  }, { signal });
}

// src/burmester/web/widget/plots.mjs
var LEFT = 62;
var RIGHT = 14;
var TOP = 22;
var BOTTOM = 44;
var PANEL = 84;
var ONLY = 150;
var GAP = 28;
var MANY_POSES2 = 40;
var HEADROOM = 1.32;
var NO_ERROR = 1e-7;
var TITLE = "Errors and transmission angle";
var INSET2 = 8;
var LONGEST_NAME2 = 16;
var NAME_WIDTH = 11;
var Plots = class {
  top = TOP;
  /** @type {any} */
  count;
  /** @type {any} */
  marks;
  /** @type {any} */
  way;
  /** @type {any} */
  width;
  /** @type {any} */
  X;
  /** @type {any} */
  stretch;
  /** @type {any} */
  across;
  constructor(data, parent, scrub) {
    this.data = data;
    this.parent = parent;
    this.svg = s("svg", { class: "bm-plots", role: "img", "aria-label": TITLE });
    parent.append(this.svg);
    const go = (event) => {
      if (!this.way) return;
      const box = this.svg.getBoundingClientRect();
      const at = (event.clientX - box.left - LEFT - INSET2) / (this.width - LEFT - RIGHT - 2 * INSET2);
      const drive = this.driveAt(this.low + clamp(at, 0, 1) * (this.high - this.low));
      if (drive !== null) scrub(frameAt(this.way.drive, drive));
    };
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      go(event);
    });
    this.svg.addEventListener("pointermove", (event) => event.buttons & 1 && go(event));
  }
  /** Draw the panels of a linkage over a stretch of its way `index`. */
  build(linkage, index, stretch) {
    const { data, svg } = this, way = linkage.ways[index];
    this.linkage = linkage;
    this.way = way;
    svg.replaceChildren();
    this.cursor = null;
    if (!way) return;
    svg.setAttribute("aria-label", `${linkage.id}: ${TITLE.toLowerCase()} along the driver`);
    const poses = linkage.pose_errors.map((row, k) => ({ ...row, pose: data.poses[k] })).filter((row) => row.way === index && row.pose);
    const upright = poses.some(({ pose }) => pose.label !== pose.name);
    const longest = Math.max(0, ...poses.map(({ pose }) => shortened(poseName(pose), LONGEST_NAME2).length));
    this.top = TOP + (upright ? 6.2 * longest + 6 : 0);
    const count = linkage.panels ? linkage.panels.length + 1 : way.loops ? 1 : nounOf(data) === "point" ? 2 : 3;
    const [driver] = linkage.led, slides = driver.kind === "PR";
    this.stretch = stretch;
    const rows = poses.map((row) => ({ ...row, drive: linear(way.drive, row.frame) }));
    const unit2 = data.unit ?? "unit of the poses";
    const title = way.told ? `${way.told[0].name} (°)` : slides ? `place of ${driver.id} on its line (${unit2})` : `driver angle (${driver.id})`;
    const ends = [stretch.low, stretch.high].map((u) => linear(way.drive, u)), [low, high] = stretch.sense < 0 ? ends.reverse() : ends;
    this.frame(count, low, high, !slides, title, () => {
      this.panels(rows, unit2);
      if (upright) this.uprightNames(rows);
    });
  }
  /** So many panels, which `draw` fills, over what goes from low at the left to high at the right; with the cursor. */
  frame(count, low, high, turns, title, draw) {
    const { svg } = this, width = this.width = Math.max(260, this.parent.clientWidth);
    this.count = count;
    this.low = low;
    this.high = high;
    const base = this.top + (count > 1 ? count * PANEL + (count - 1) * GAP : ONLY), height = base + BOTTOM;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("height", height);
    this.X = (at) => LEFT + INSET2 + (at - low) / (high - low) * (width - LEFT - RIGHT - 2 * INSET2);
    const ends = [Math.min(low, high), Math.max(low, high)], marks = turns ? angleTicks(ends[0], ends[1], Math.max(3, width / 70)) : ticks(ends[0], ends[1], width / 90);
    this.across = low > high ? marks.reverse() : marks;
    this.marks = [];
    draw();
    svg.append(s("text", { class: "bm-title", x: (LEFT + width - RIGHT) / 2, y: height - 6, "text-anchor": "middle" }, title));
    this.cursor = s("g", { class: "bm-cursor" }, s("path", { d: `M0 ${this.top}V${base}` }));
    this.cursor.append(...this.marks.map(({ mark }) => mark));
    svg.append(this.cursor);
  }
  /** Where panel k begins and ends. */
  heights(k) {
    const y0 = this.top + k * (PANEL + GAP);
    return [y0, y0 + (this.count > 1 ? PANEL : ONLY)];
  }
  /** What the panels are over where the driver is at a place, and back; null where it is not known. */
  placeOf(drive) {
    return drive;
  }
  driveAt(place) {
    return place;
  }
  /** Draw the panels. */
  panels(rows, unit2) {
    this.linkage.panels?.forEach((each, k) => this.values(k, each));
    if (this.linkage.panels || this.count === 1) {
      this.transmission(this.count - 1, rows);
      return;
    }
    this.errors(0, `position error (${unit2})`, rows, (row) => row.position, 1e-11 * this.data.scene);
    if (nounOf(this.data) === "point") {
      this.transmission(1, rows);
      return;
    }
    this.errors(1, "angle error (°)", rows.filter(({ pose }) => !isPoint(pose)), (row) => row.turned_deg, 1e-9);
    this.transmission(2, rows);
  }
  /** The errors of the poses as stems; below `rounding` they are zero. */
  errors(k, title, rows, value, rounding) {
    const { svg, X } = this, [y0, base] = this.heights(k);
    const greatest = Math.max(1e-300, ...rows.map((row) => value(row) ?? 0));
    const visible = greatest > rounding;
    const high = visible ? HEADROOM * greatest : 1;
    const Y = (v) => base - v / high * PANEL;
    this.panel(title, y0, base);
    if (!visible) {
      svg.append(s("text", { class: "bm-note", x: LEFT + 8, y: y0 + PANEL / 2 }, rows.length ? "exact, up to rounding" : `no ${nounOf(this.data)} is on this assembly`));
    } else {
      for (const { at } of ticks(0, high, 3).slice(1)) this.rule(Y(at), figure(at));
      svg.append(s("text", { class: "bm-tick", x: LEFT - 6, y: base + 4, "text-anchor": "end" }, "0"));
    }
    const greatestThree = new Set([...rows].sort((a, b) => value(b) - value(a)).slice(0, 3));
    let last = -99;
    for (const row of [...rows].sort((a, b) => X(a.drive) - X(b.drive))) {
      const x = px(X(row.drive)), y = px(visible ? Y(value(row)) : base);
      svg.append(
        s("path", { class: "bm-stem", d: `M${x} ${base}V${y}` }),
        s("circle", { class: "bm-dot", cx: x, cy: y, r: 3.5 }, s("title", {}, `${calledOf(row.pose)}: ${figure(value(row))}`))
      );
      const { label: label2 } = row.pose;
      if (x - last > 6 + 6.5 * label2.length && (rows.length <= MANY_POSES2 || greatestThree.has(row))) {
        svg.append(s("text", { class: "bm-dot-name", x, y: y - 7, "text-anchor": "middle" }, label2));
        last = x;
      }
    }
  }
  /** The transmission angle along the way, and at its poses. */
  transmission(k, rows) {
    const { svg, way, width, X } = this, [y0, base] = this.heights(k);
    const Y = (v) => base - v / 90 * (base - y0);
    this.panel("transmission angle (°)", y0, base, true);
    for (const at of [0, 30, 60, 90]) this.rule(Y(at), at);
    const { deg: limit, said } = this.data.transmission_limit;
    svg.append(s("path", { class: "bm-usual", d: `M${LEFT} ${px(Y(limit))}H${width - RIGHT}` }));
    const below = limit > 15 && (linear(way.transmission, this.stretch.sense < 0 ? this.stretch.low : this.stretch.high) ?? 90) > limit;
    const limitName = s("text", { class: "bm-tick bm-halo", x: width - RIGHT - 4, y: px(Y(limit)) + (below ? 12 : -4), "text-anchor": "end" }, said);
    (way.loops ?? [way.transmission]).forEach((values, loop) => {
      this.mark((drive) => linear(values, frameAt(way.drive, drive)), Y);
      const kind = way.loops ? ` bm-loop${loop}` : "";
      this.curve(values, Y, `bm-line${kind}`);
      for (const row of rows) {
        const value = way.loops ? row.loops[loop] : row.transmission_deg;
        if (value !== null) svg.append(s("circle", { class: `bm-dot${kind}`, cx: px(X(row.drive)), cy: px(Y(value)), r: 3 }));
      }
    });
    svg.append(limitName);
  }
  /** A dot on the cursor, at a value for the drive. */
  mark(value, Y) {
    this.marks.push({ mark: s("circle", { r: 4.5 }), value, Y });
  }
  /** A curve of its own over the drive, or stems from zero, with dots. */
  values(k, curve) {
    const { title, x, y, dots, stems } = curve, { svg } = this, [low, high] = [Math.min(this.low, this.high), Math.max(this.low, this.high)], [y0, base] = this.heights(k);
    const shown = [...x.keys()].filter((i) => y[i] !== null && x[i] >= low && x[i] <= high).map((i) => [x[i], y[i]]);
    const all = [...shown, ...dots].map(([, value]) => value), least = Math.min(...all), most = Math.max(...all), room = 0.08 * (most - least);
    this.panel(title, y0, base);
    if (!(Math.max(Math.abs(least), Math.abs(most)) > NO_ERROR)) {
      svg.append(s("text", { class: "bm-note", x: LEFT + 8, y: y0 + PANEL / 2 }, shown.length ? "exact, up to rounding" : "it cannot be assembled"));
      return;
    }
    const Y = (v) => base - (v - least + room) / (most - least + 2 * room) * PANEL;
    const at = (point) => `${px(this.X(point[0]))} ${px(Y(point[1]))}`;
    for (const { at: value, text } of ticks(least, most, 4)) this.rule(Y(value), text);
    if (least < 0 && most > 0) svg.append(s("path", { class: "bm-usual", d: `M${LEFT} ${px(Y(0))}H${this.width - RIGHT}` }));
    if (stems) for (const [a, b] of shown) svg.append(s("path", { class: "bm-stem", d: `M${at([a, 0])}L${at([a, b])}` }));
    else svg.append(s("path", { class: "bm-line", d: `M${shown.map(at).join("L")}` }));
    const ofPixel = (most - least + 2 * room) / PANEL;
    dots.forEach(([a, b], i) => svg.append(s("circle", { class: "bm-dot", cx: px(this.X(a)), cy: px(Y(b)), r: 3.5, "data-dot": i, "data-panel": k, "data-of-pixel": ofPixel }, s("title", {}, `${figure(b)}°`))));
    this.mark((drive) => valueAt(curve, drive), Y);
  }
  /** Values along the way as a line over the drive. */
  curve(values, Y, name) {
    const { low, high } = this.stretch, frames = [low];
    for (let i = Math.floor(low) + 1; i < high; i += 1) frames.push(i);
    frames.push(high);
    let line = "", pen = "M";
    for (const u of frames) {
      const value = linear(values, u);
      if (value === null) continue;
      line += `${pen}${px(this.X(linear(this.way.drive, u)))} ${px(Y(value))}`;
      pen = "L";
    }
    this.svg.append(s("path", { class: name, d: line }));
  }
  /** Names of the poses over their stems, those that have room. */
  uprightNames(rows) {
    let last = -99;
    for (const row of [...rows].sort((a, b) => this.X(a.drive) - this.X(b.drive))) {
      const x = this.X(row.drive), y = this.top - 20;
      if (x - last < NAME_WIDTH) continue;
      last = x;
      const text = s("text", { class: "bm-dot-name bm-upright", transform: `translate(${px(x + 4)} ${px(y)}) rotate(-90)` });
      text.append(shortened(poseName(row.pose), LONGEST_NAME2));
      this.svg.append(s("g", {}, s("title", {}, poseName(row.pose)), text));
    }
  }
  /** An empty panel with its title and the lines of the drive. */
  panel(title, y0, base, labelled = false) {
    const { svg, width } = this;
    svg.append(
      s("rect", { class: "bm-panel", x: LEFT, y: y0, width: width - LEFT - RIGHT, height: base - y0 }),
      s("text", { class: "bm-title", x: LEFT, y: y0 - 7 }, title)
    );
    let last = -99;
    for (const { at, text } of this.across) {
      const x = px(this.X(at));
      svg.append(s("path", { class: "bm-rule", d: `M${x} ${y0}V${base}` }));
      if (labelled && x - last > 34) {
        svg.append(s("text", { class: "bm-tick", x, y: base + 15, "text-anchor": "middle" }, text));
        last = x;
      }
    }
  }
  rule(y, text) {
    this.svg.append(
      s("path", { class: "bm-rule", d: `M${LEFT} ${px(y)}H${this.width - RIGHT}` }),
      s("text", { class: "bm-tick", x: LEFT - 6, y: px(y) + 4, "text-anchor": "end" }, text)
    );
  }
  show(drive) {
    if (!this.cursor) return;
    const at = this.placeOf(drive);
    put(this.cursor, "visibility", at === null ? "hidden" : "visible");
    if (at === null) return;
    this.cursor.setAttribute("transform", `translate(${px(this.X(at))} 0)`);
    for (const { mark, value, Y } of this.marks) {
      const known = value(at);
      put(mark, "visibility", known === null ? "hidden" : "inherit");
      if (known !== null) put(mark, "cy", px(Y(known)));
    }
  }
};

// src/burmester/web/widget/load_plots.mjs
var TITLE2 = "Loads";
var fieldsets = 0;
var LoadPlots = class extends Plots {
  /** @type {any} */
  own = null;
  /** @type {any} */
  timed = null;
  /** @type {number | undefined} */
  drive;
  overTime = false;
  constructor(data, parent, scrub) {
    super(data, parent, scrub);
    const name = `bm-over-${fieldsets += 1}`;
    const one = (text, overTime) => h("label", {}, h("input", { type: "radio", name, checked: !overTime, onchange: () => this.take(overTime) }), h("span", {}, text));
    this.choice = h("fieldset", { class: "bm-ways bm-over", hidden: true }, one("Over the driver", false), one("Over time", true));
    this.nothing = h("p", { class: "bm-note-text", hidden: true }, "Loads are known from the first pose to the last, of a linkage that leads through all of them with its own driver.");
    this.forces = h("label", { class: "bm-forces", hidden: true }, h("input", { type: "checkbox", class: "bm-show-forces" }), h("span", {}, "Draw the forces of pins: of the link or the ground that holds a pin, on the other link; all to one scale"));
    parent.prepend(this.choice, this.forces, this.nothing);
  }
  take(overTime) {
    this.overTime = overTime;
    this.draw();
    if (this.drive !== void 0) this.show(this.drive);
  }
  /** Draw the panels of a linkage, if its loads are known along the way `index`. */
  build(linkage, index) {
    this.svg.classList.toggle("bm-stale", Boolean(linkage?.followed));
    this.linkage = linkage;
    const loads = linkage?.loads, here = Boolean(loads) && loads.way === index && Boolean(linkage.ways[index]);
    this.own = here ? loads : null;
    this.way = here ? linkage.ways[index] : null;
    this.choice.hidden = !this.own?.timed;
    this.nothing.hidden = here;
    this.forces.hidden = !here;
    this.draw();
  }
  draw() {
    const { svg, own, data } = this;
    svg.replaceChildren();
    svg.removeAttribute("height");
    this.cursor = null;
    if (!own) return;
    const timed = this.overTime && own.timed ? own.timed : null, panels = (timed ?? own).panels, { x } = panels[0];
    this.timed = timed;
    const [driver] = this.linkage.led, slides = driver.kind === "PR";
    const title = timed ? "time (s)" : slides ? `place of ${driver.id} on its line (${data.unit})` : `driver angle (${driver.id})`;
    svg.setAttribute("aria-label", `${this.linkage.id}: ${TITLE2.toLowerCase()} over ${timed ? "time" : "the driver"}`);
    const ends = [x[0], x[x.length - 1]], [low, high] = !timed && stretchOf(this.linkage, own.way).sense < 0 ? ends.reverse() : ends;
    this.frame(panels.length, low, high, !slides && !timed, title, () => {
      panels.forEach((each, k) => this.lines(k, each, k + 1 === panels.length));
    });
  }
  /** A panel with one or more curves, which have their names in its title. */
  lines(k, { title, x, lines }, last) {
    const all = lines.flatMap(({ y }) => y.filter((each) => each !== null)), [y0, base] = this.heights(k);
    const least = Math.min(0, ...all), most = Math.max(0, ...all), room = 0.08 * (most - least || 1);
    this.panel(title, y0, base, last);
    const Y = (v) => base - (v - least + room) / (most - least + 2 * room) * (base - y0);
    for (const { at, text } of ticks(least, most, 4)) this.rule(Y(at), text);
    if (least < 0 && most > 0) this.svg.append(s("path", { class: "bm-usual", d: `M${LEFT} ${px(Y(0))}H${this.width - RIGHT}` }));
    lines.forEach(({ y }, line) => {
      let d = "", pen = "M";
      x.forEach((at, i) => {
        if (y[i] === null) pen = "M";
        else {
          d += `${pen}${px(this.X(at))} ${px(Y(y[i]))}`;
          pen = "L";
        }
      });
      this.svg.append(s("path", { class: `bm-line bm-curve${line}`, d }));
      this.mark((at) => valueAt({ x, y }, at), Y);
    });
    if (lines.length > 1) {
      const names = s("text", { class: "bm-title", x: this.width - RIGHT, y: y0 - 7, "text-anchor": "end" });
      lines.forEach(({ name }, line) => names.append(s("tspan", { class: `bm-curve${line}`, dx: line ? 7 : 0 }, name)));
      this.svg.append(names);
    }
  }
  /** What the cursor is at: the driver, or the time at which it is there. */
  placeOf(drive) {
    const { own, timed } = this;
    if (this.linkage.followed) return null;
    if (timed) return valueAt(timed.time, drive);
    const { x } = own.panels[0];
    return drive < x[0] - 1e-6 || drive > x[x.length - 1] + 1e-6 ? null : drive;
  }
  driveAt(at) {
    return this.timed ? driveAtTime(this.timed, at) : at;
  }
  show(drive) {
    this.drive = drive;
    super.show(drive);
  }
};

// src/burmester/web/widget/pivot_map.mjs
var MAX_BANDS = 12;
var PivotMap = class {
  /** @type {any} */
  view;
  constructor(data, parent) {
    this.data = data;
    this.parent = parent;
    this.canvas = h("canvas", { "aria-hidden": "true" });
    const name = `bm-map-${Math.random().toString(36).slice(2)}`;
    this.svg = s("svg", {
      class: "bm-map-picture",
      role: "application",
      tabindex: "0",
      "aria-roledescription": "map",
      "aria-describedby": name,
      "aria-label": "Pivot map: the error of the best link for every fixed pivot. Arrow keys move a cursor, with Shift by ten steps; the error there is told."
    });
    this.readout = h("output", { class: "bm-readout", id: name });
    this.cursor = null;
    this.legend = h("p", { class: "bm-legend" });
    parent.append(h("div", { class: "bm-map" }, this.canvas, this.svg), this.legend, this.readout);
    this.svg.addEventListener("pointermove", (event) => this.read(event));
    this.svg.addEventListener("pointerleave", () => this.tell());
    this.svg.addEventListener("keydown", (event) => this.move(event));
    const { log10_rms: levels } = data.pivot_map;
    const known = levels.filter((level) => level !== null).sort((a, b) => a - b);
    const low = known[Math.floor(2e-3 * known.length)], high = known[Math.floor(0.98 * known.length)];
    this.step = [1 / 24, 1 / 12, 1 / 6, 1 / 3, 1 / 2, 1, 2].find((step) => (high - low) / step < MAX_BANDS - 1) ?? 3;
    this.low = Math.floor(low / this.step) * this.step;
    this.high = Math.ceil(high / this.step) * this.step;
    this.count = Math.max(1, Math.round((this.high - this.low) / this.step));
    this.invitation = "Point at the map to read it, or move over it by arrow keys.";
    this.readout.append(this.invitation);
  }
  /** log10 of the error at column u and row v of the grid, bilinear between four of its points. */
  level(u, v) {
    const { columns, rows, log10_rms: levels } = this.data.pivot_map;
    const i = clamp(Math.floor(u), 0, columns - 2), j = clamp(Math.floor(v), 0, rows - 2);
    const a = u - i, b = v - j, at = j * columns + i;
    const [p, q, r, t] = [levels[at], levels[at + 1], levels[at + columns], levels[at + columns + 1]];
    const shares = [(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b];
    if ([p, q, r, t].some((level, k) => level === null && shares[k] > 0)) return null;
    return shares[0] * p + shares[1] * q + shares[2] * r + shares[3] * t;
  }
  build(linkage) {
    const { svg } = this, map = this.data.pivot_map;
    const width = Math.max(240, this.parent.clientWidth);
    const height = Math.round(width * (map.high[1] - map.low[1]) / (map.high[0] - map.low[0]));
    this.paint(width, height);
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.replaceChildren();
    const scale = width / (map.high[0] - map.low[0]);
    const view = { width, height, X: (x) => (x - map.low[0]) * scale, Y: (y) => height - (y - map.low[1]) * scale };
    this.linkage = linkage;
    this.view = view;
    this.explain(this.pivots(linkage, view));
    this.mark = s("path", { class: "bm-map-cursor", d: "M-11 0H-4M4 0H11M0 -11V-4M0 4V11" });
    svg.append(this.mark);
    this.tell();
  }
  /** The shades, painted again only where their size or the colours have changed. */
  paint(width, height) {
    const { canvas } = this, map = this.data.pivot_map;
    const dense = Math.min(2, window.devicePixelRatio || 1);
    const style = getComputedStyle(this.parent);
    const near = rgb(style.getPropertyValue("--bm-map-near"));
    const far = rgb(style.getPropertyValue("--bm-map-far"));
    const w = Math.round(width * dense), t = Math.round(height * dense);
    if (canvas.width === w && this.paintedIn === near.join()) return;
    this.paintedIn = near.join();
    canvas.width = w;
    canvas.height = t;
    const context = canvas.getContext("2d"), image = context.createImageData(w, t);
    const band = new Int16Array(w * t);
    for (let j = 0; j < t; j += 1) {
      for (let i = 0; i < w; i += 1) {
        const level = this.level(i / (w - 1) * (map.columns - 1), (1 - j / (t - 1)) * (map.rows - 1));
        band[j * w + i] = level === null ? -1 : clamp(Math.floor((level - this.low) / this.step), 0, this.count - 1);
      }
    }
    for (let k = 0; k < w * t; k += 1) {
      const own = band[k];
      const edge = k % w && band[k - 1] !== own || k >= w && band[k - w] !== own;
      const share = own < 0 ? 1 : own / Math.max(1, this.count - 1);
      const shade = edge ? 0.84 : 1;
      for (let c = 0; c < 3; c += 1) image.data[4 * k + c] = shade * (near[c] + share * (far[c] - near[c]));
      image.data[4 * k + 3] = 255;
    }
    context.putImageData(image, 0, 0);
  }
  /** Marks of poses and of all fixed pivots.  Returns sentences on those of the linkage that lie outside. */
  pivots(linkage, view) {
    const { data, svg } = this, map = data.pivot_map;
    const labels = new Labels(view);
    for (const pose of data.poses) {
      const x = px(view.X(pose.x)), y = px(view.Y(pose.y));
      svg.append(s("path", { class: "bm-cross", d: `M${x - 3} ${y}h6M${x} ${y - 3}v6` }));
    }
    const every = /* @__PURE__ */ new Map();
    for (const each of data.linkages) for (const dyad of each.led) if (dyad.fixed_pivot) every.set(dyad.fixed_pivot.join(), dyad);
    for (const dyad of data.dyads) if (dyad.fixed_pivot) every.set(dyad.fixed_pivot.join(), dyad);
    const inside2 = ([x, y]) => x >= map.low[0] && x <= map.high[0] && y >= map.low[1] && y <= map.high[1];
    for (const dyad of every.values()) {
      if (!inside2(dyad.fixed_pivot)) continue;
      const [x, y] = [view.X(dyad.fixed_pivot[0]), view.Y(dyad.fixed_pivot[1])];
      svg.append(s("circle", { class: "bm-some-pivot", cx: px(x), cy: px(y), r: 2.5 }));
    }
    const outside = [];
    (linkage?.led ?? []).forEach((dyad, side) => {
      if (!dyad.fixed_pivot) return;
      if (!inside2(dyad.fixed_pivot)) {
        outside.push(`the fixed pivot of ${dyad.id} lies outside`);
        return;
      }
      const [x, y] = [view.X(dyad.fixed_pivot[0]), view.Y(dyad.fixed_pivot[1])];
      labels.block(x, y, 12, 12);
      svg.append(
        s("circle", { class: `bm-its-pivot bm-side${side}`, cx: px(x), cy: px(y), r: 6 }),
        labels.put(x, y, dyad.id, 16, { class: "bm-map-name" })
      );
    });
    return outside;
  }
  explain(outside) {
    const unit2 = this.data.unit ? ` ${this.data.unit}` : "";
    this.legend.replaceChildren(
      h("span", { class: "bm-swatch bm-near" }),
      ` ${figure(10 ** this.low)}${unit2} or less`,
      h("span", { class: "bm-swatch bm-far" }),
      ` ${figure(10 ** this.high)}${unit2} or more; each line is a factor of ${figure(10 ** this.step)}. `,
      "Small dots: fixed pivots of all dyads; crosses: the poses.",
      outside.length ? ` Of this linkage, ${listed(outside)}.` : ""
    );
  }
  /** A place of the grid, by its column and row, in the plane. */
  placeAt([u, v]) {
    const { low, high, columns, rows } = this.data.pivot_map;
    return [low[0] + u / (columns - 1) * (high[0] - low[0]), low[1] + v / (rows - 1) * (high[1] - low[1])];
  }
  /** Move the cursor by a key, from one place of the grid to the next; it starts at the driver's pivot. */
  move(event) {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const { low, high, columns, rows } = this.data.pivot_map, many = event.shiftKey ? 10 : 1;
    const pivot = this.linkage?.led.map((dyad) => dyad.fixed_pivot).find(Boolean) ?? this.placeAt([(columns - 1) / 2, (rows - 1) / 2]);
    const [u, v] = this.cursor ?? [
      Math.round((pivot[0] - low[0]) / (high[0] - low[0]) * (columns - 1)),
      Math.round((pivot[1] - low[1]) / (high[1] - low[1]) * (rows - 1))
    ];
    this.cursor = [clamp(u + many * step[0], 0, columns - 1), clamp(v + many * step[1], 0, rows - 1)];
    this.tell();
  }
  /** The cursor, and the error there; without a cursor how to get one. */
  tell() {
    const { cursor, mark, view } = this;
    mark?.setAttribute("visibility", cursor ? "visible" : "hidden");
    if (!cursor) {
      this.readout.textContent = this.invitation;
      return;
    }
    const [x, y] = this.placeAt(cursor);
    mark?.setAttribute("transform", `translate(${px(view.X(x))} ${px(view.Y(y))})`);
    this.say(cursor);
  }
  /** The error at the pointer. */
  read(event) {
    const box = this.svg.getBoundingClientRect(), { columns, rows } = this.data.pivot_map;
    this.say([(event.clientX - box.left) / box.width * (columns - 1), (1 - (event.clientY - box.top) / box.height) * (rows - 1)]);
  }
  /** The error at a column and a row of the grid, which may be fractions. */
  say(at) {
    const [x, y] = this.placeAt(at), level = this.level(...at);
    const digits = Math.max(0, 2 - Math.floor(Math.log10(this.data.scene)));
    const unit2 = this.data.unit ? ` ${this.data.unit}` : "";
    this.readout.textContent = `Fixed pivot (${fixed(x, digits)}, ${fixed(y, digits)}): the best link misses by ` + (level === null ? "an unknown error." : `${figure(10 ** level)}${unit2} (rms).`);
  }
};

// src/burmester/web/widget/plane.mjs
var CLOSER = 0.4;
var BESIDE_PIVOT = [16, 28, 40];
var FACTORS = [0, 1, 10, 100, 1e3, 1e4, 1e5];
function factorFor(data, linkage) {
  const worst = Math.max(0, ...linkage.pose_errors.map((row) => row.position ?? 0));
  if (!(worst > 1e-9 * data.scene)) return 0;
  const fits = FACTORS.filter((factor) => factor >= 1 && factor * worst < 0.3 * data.scene);
  return fits.length ? fits[fits.length - 1] : 1;
}
var sizeOf3 = ([x, y, u, v]) => Math.max(u - x, v - y);
var standing = (dyad, places) => dyad.fixed_pivot ?? (dyad.kind === "PR" && places.length ? pointOnLine(dyad, travelOf(dyad, places).reduce((a, b) => (a + b) / 2)) : null);
function hasFarPivots(data, linkage, places) {
  const isFar = farFrom(data);
  return pivotsAt(linkage, places).some(isFar);
}
var Plane = class {
  /** @type {any} */
  view;
  /** @type {any} */
  places;
  /** @type {any} */
  linkage;
  /** @type {(() => void) | undefined} */
  reveal;
  constructor(data, parent) {
    this.data = data;
    this.svg = s("svg", { class: "bm-plane", role: "img", tabindex: "0" });
    this.parent = parent;
    parent.append(this.svg);
  }
  /** Draw what stands still.
   *
   * stretch: the part of the way that is shown; factor: of the error arrows; fill: the height to
   * fill, 0 for the picture's own; far: whether the picture is to hold pivots far from the poses;
   * close: whether it holds poses and linkage alone.
   */
  build(linkage, way, stretch, { factor, fill, far, close = false }) {
    const { data, svg } = this, path = linkage?.ways[way];
    this.linkage = linkage;
    this.way = way;
    this.places = path ? placesOf(data, linkage, path, stretch) : [];
    const width = Math.max(260, this.parent.clientWidth);
    const box = boxOf(data, linkage, this.places, { whole: far, close }), different = (other) => other.some((each, k) => each !== box[k]);
    this.cut = !far && different(boxOf(data, linkage, this.places, { whole: true }));
    this.isLarge = close || Boolean(linkage) && sizeOf3(boxOf(data, linkage, this.places, { close: true })) < CLOSER * sizeOf3(box);
    const shape = (box[3] - box[1]) / (box[2] - box[0]);
    const own = clamp(width * clamp(shape, 0.45, 1), 260, clamp(0.62 * window.innerHeight, 340, 680));
    const height = Math.round(fill ? clamp(fill, own, 1.15 * width) : own);
    const view = viewOf(box, width, height, width < 500 ? 34 : 42);
    this.view = view;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("height", height);
    svg.dataset.scale = view.scale;
    svg.dataset.left = view.left;
    svg.dataset.top = view.top;
    svg.replaceChildren();
    svg.append(this.grid(), keepOut(data, view), ghosts(data, linkage, view));
    svg.append(...[this.wantedPath(), linkage ? this.paths() : null].filter(Boolean));
    const labels = new Labels(view);
    this.names = s("g", { class: "bm-names" }, keepOutNames(data, view, labels));
    if (linkage) svg.append(this.ground(labels));
    for (const pose of data.poses) {
      const x = view.X(pose.x), y = view.Y(pose.y), angle = radians(pose.angle_deg);
      const c = AXIS * Math.cos(angle), d = AXIS * Math.sin(angle);
      labels.block(x, y, 12, 12);
      if (isPoint(pose)) continue;
      for (const share of [0.35, 0.65, 1]) {
        labels.block(x + share * c, y - share * d, 6, 6);
        labels.block(x - 0.6 * share * d, y - 0.6 * share * c, 6, 6);
      }
    }
    svg.append(this.poses(linkage, factor, labels));
    this.moving = path ? mechanism(data, linkage, view, this.places) : null;
    if (this.moving) svg.append(this.moving.group);
    if (linkage) this.farPivots(labels);
    svg.append(this.names);
  }
  grid() {
    const { view } = this, group = s("g", { class: "bm-grid", "aria-hidden": "true" });
    const unit2 = this.data.unit ? ` ${this.data.unit}` : "";
    const across = ticks(-view.left / view.scale, (view.width - view.left) / view.scale, view.width / 110);
    const up = ticks((view.top - view.height) / view.scale, view.top / view.scale, view.height / 80);
    for (const { at, text } of across) {
      const x = px(view.X(at));
      group.append(s("path", { d: `M${x} 0V${view.height}` }));
      if (x > 46 && x < view.width - (unit2 ? 54 : 30)) {
        group.append(s("text", { x, y: view.height - 6, "text-anchor": "middle" }, text));
      }
    }
    for (const { at, text } of up) {
      const y = px(view.Y(at));
      group.append(s("path", { d: `M0 ${y}H${view.width}` }));
      if (y > 26 && y < view.height - 24) group.append(s("text", { x: 6, y: y - 4 }, text));
    }
    group.append(
      s("text", { x: 6, y: 14 }, `y${unit2}`),
      s("text", { x: view.width - 6, y: view.height - 6, "text-anchor": "end" }, `x${unit2}`)
    );
    return group;
  }
  /** Paths of the body's origin and of its pivots: full along the stretch that is shown. */
  paths() {
    const { view, linkage, places } = this, group = s("g", { class: "bm-paths" });
    linkage.ways.forEach((way, k) => {
      const same = way.circuit === linkage.ways[this.way]?.circuit;
      const kind = k === this.way ? "bm-beyond" : same ? "bm-same" : "bm-other";
      const whole = placesOf(this.data, linkage, way, { low: 0, high: way.x.length - 1 });
      const d2 = polyline(whole.map(({ x, y }) => [x, y]), view);
      group.append(s("path", { class: `bm-curve ${kind}`, d: d2 }));
    });
    for (const { side, points } of this.pivotPaths()) {
      group.append(s("path", { class: `bm-pivot-path bm-side${side}`, d: polyline(points, view) }));
    }
    const d = polyline(places.map(({ x, y }) => [x, y]), view);
    group.append(s("path", { class: "bm-curve bm-here", d }));
    return group;
  }
  /** The paths of the body's pivots: those on links and in slots. */
  pivotPaths() {
    const { places, linkage } = this;
    if (linkage.traced) return [...linkage.traced].map((joint) => ({ side: "-inner", points: places.map((place) => place.joints[joint]) }));
    const drawn = [...linkage.led.entries()].filter(([, dyad]) => dyad.moving_pivot && dyad.kind !== "PR");
    return drawn.map(([side, dyad]) => ({ side, points: places.map((place) => act(place, dyad.moving_pivot)) }));
  }
  /** Feet of fixed pivots and rails of sliders, with the names of their dyads. */
  ground(labels) {
    const group = s("g", { class: "bm-grounds" });
    this.keepCranksFree(labels);
    this.linkage.led.forEach((dyad, k) => {
      const side = Math.min(k, 1);
      if (dyad.kind === "PR") this.rail(group, labels, dyad, side);
      else if (dyad.fixed_pivot) this.fixedPivot(group, labels, dyad, side);
    });
    return group;
  }
  /** Where cranks between joints are on their way no name is to stand. */
  keepCranksFree(labels) {
    const { view, places, linkage } = this, every = Math.ceil(places.length / 9);
    const arms = (linkage.drawn ?? []).flatMap(({ joints }) => [...joints].filter((joint) => joint in linkage.ground).flatMap((pivot) => [...joints].map((end) => [pivot, end])));
    for (const { joints } of places.filter((_, k) => k % every === 0)) {
      for (const [pivot, end] of arms) {
        const [[x, y], [u, v]] = [joints[pivot], joints[end]].map((at) => [view.X(at[0]), view.Y(at[1])]), size = Math.hypot(u - x, v - y);
        if (size) for (const along of BESIDE_PIVOT) labels.block(x + along * (u - x) / size, y + along * (v - y) / size, 12, 12);
      }
    }
  }
  /** A rail as long as the travel of its block. */
  rail(group, labels, dyad, side) {
    if (!this.places.length) return;
    const { x, y, drawn, turned, paths } = railOf(dyad, this.places, this.view), [nx, ny] = normalOf(dyad);
    group.append(
      s(
        "g",
        { class: `bm-rail bm-side${side}`, "data-dyad": dyad.id, transform: transform(x, y, turned) },
        s("path", { class: "bm-ground", d: paths[0] }),
        s("path", { class: "bm-ground bm-thin", d: paths[1] })
      )
    );
    for (let k = -drawn; k <= drawn; k += 14) labels.block(x - k * ny, y - k * nx, 22, 22);
    this.names.append(labels.put(x, y, dyad.id, 26, { class: `bm-name bm-side${side}` }));
  }
  fixedPivot(group, labels, dyad, side) {
    const x = this.view.X(dyad.fixed_pivot[0]), y = this.view.Y(dyad.fixed_pivot[1]);
    labels.block(x, y + 10, 32, 34);
    if (!side) labels.block(x, y, 40, 40);
    const at = foot();
    at.setAttribute("transform", `translate(${px(x)} ${px(y)})`);
    group.append(at);
    this.names.append(labels.put(x, y + 4, dyad.name ?? dyad.id, 27, { class: `bm-name bm-side${side}` }));
  }
  /** At the edge of the picture, in their direction, the names of what stands outside; a press on one calls `reveal`. */
  farPivots(labels) {
    const { data, view } = this, digits = decimalsOf(data);
    this.linkage.led.forEach((dyad, side) => {
      const at = standing(dyad, this.places);
      const edge = at && edgeTowards(view, at);
      if (!edge) return;
      const text = `${dyad.name ?? dyad.id}: ${dyad.fixed_pivot ? "fixed pivot" : "rail"} at (${at.map((each) => fixed(each, digits)).join(", ")})`;
      labels.block(edge.x, edge.y, 20, 20);
      this.names.append(
        s(
          "g",
          { class: "bm-to-far", onclick: () => this.reveal?.() },
          s("path", { class: `bm-far-mark bm-side${side}`, d: "M-9 -6L3 0L-9 6", transform: transform(edge.x, edge.y, edge.angle) }),
          labels.put(edge.x, edge.y, text, 14, { class: `bm-name bm-far-name bm-side${side}` })
        )
      );
    });
  }
  /** The path that is to be traced, straight from point to point. */
  wantedPath() {
    const { data, view } = this;
    if (!data.path) return null;
    const points = data.poses.map(({ x, y }) => [x, y]);
    return s("path", { class: "bm-wanted-path", d: `${polyline(points, view)}${data.path.closed ? "Z" : ""}` });
  }
  /** Wanted poses, the places that the linkage takes instead, and the errors between them, enlarged.
   *
   * At a point there are no axes: how the body turns there is not asked for.
   */
  poses(linkage, factor, labels) {
    const { data, view } = this, group = s("g", { class: "bm-poses" });
    const small = data.poses.length > 24 ? 0.6 : 1;
    const arrows = this.errors(linkage, factor, labels);
    const names = s("g", { class: "bm-pose-names" });
    data.poses.forEach((pose, k) => {
      const x = view.X(pose.x), y = view.Y(pose.y);
      group.append(
        s(
          "g",
          { class: "bm-wanted", transform: transform(x, y, isPoint(pose) ? 0 : radians(pose.angle_deg)), "data-pose": k + 1 },
          isPoint(pose) ? null : s("path", { d: axes(AXIS * small) }),
          s("circle", { r: 4.5 * small })
        )
      );
      if (data.poses.length <= 60 && isNamed(data, k)) names.append(labels.put(x, y, pose.label, 13, {}));
      const row = linkage?.pose_errors[k];
      if (!row || row.x === null) return;
      const elsewhere = row.way === this.way ? "" : " bm-elsewhere";
      group.append(
        s(
          "g",
          { class: `bm-achieved${elsewhere}`, transform: transform(view.X(row.x), view.Y(row.y), radians(row.angle_deg)) },
          isPoint(pose) ? null : s("path", { d: axes(0.72 * AXIS * small) }),
          s("circle", { r: 2.2 * small })
        )
      );
    });
    group.append(arrows, names);
    return group;
  }
  errors(linkage, factor, labels) {
    const { data, view } = this, arrows = s("g", { class: "bm-errors" });
    if (!linkage || !factor) return arrows;
    linkage.pose_errors.forEach((row, k) => {
      if (row.x === null) return;
      const pose = data.poses[k], x = view.X(pose.x), y = view.Y(pose.y);
      const dx = factor * view.scale * (row.x - pose.x), dy = -factor * view.scale * (row.y - pose.y);
      const size = Math.hypot(dx, dy);
      if (size < 1.5) return;
      const head = Math.min(7, 0.5 * size), ux = dx / size, uy = dy / size;
      const tip = `${px(x + dx)} ${px(y + dy)}`;
      const barb = (sign) => `L${px(x + dx - head * (ux - sign * 0.5 * uy))} ${px(y + dy - head * (uy + sign * 0.5 * ux))}`;
      arrows.append(s("path", { d: `M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(-1)}` }));
      for (let share = 0; share <= 1; share += 0.2) labels.block(x + share * dx, y + share * dy, 8, 8);
    });
    if (arrows.children.length) this.names.append(scaleOfErrors(view, factor));
    return arrows;
  }
  show(place, drive) {
    this.moving?.show(place, drive);
  }
};
var scaleOfErrors = ({ width }, factor) => s("text", { class: "bm-error-scale", x: width - 8, y: 16, "text-anchor": "end" }, factor === 1 ? "errors to scale" : `errors × ${factor.toLocaleString("en").replaceAll(",", " ")}`);

// src/burmester/web/widget/player.mjs
var TURN_SECONDS = 7;
var TURN = 1e-6;
var NAME_ROWS = 5;
var NUMBER_ROWS = 2;
var MANY_POSES3 = 100;
var ROW = 13;
var LONGEST_TICK = 18;
var NO_ERROR2 = 1e-7;
var STEPS = 360;
var SPEEDS = [0.25, 0.5, 1, 2, 4];
var LOOPS = [["back", "there and back"], ["again", "again and again"], ["once", "once"]];
var Player = class {
  /** @type {any} */
  parts;
  /** @type {any} */
  steps;
  /** @type {any} */
  tick;
  /** @type {any} */
  wholeLabel;
  /** @type {any} */
  speeds;
  /** @type {any} */
  loops;
  /** @type {any} */
  real;
  /** @type {any} */
  realLabel;
  constructor(data, show, rebuild) {
    this.data = data;
    this.draw = { show, rebuild };
    this.linkage = null;
    this.way = 0;
    this.u = 0;
    this.heading = 1;
    this.speed = 1;
    this.loop = "back";
    this.isReal = false;
    this.whole = false;
    this.stretch = { low: 0, high: 1, sense: 1 };
    this.playing = false;
    this.remaining = null;
    this.element = this.controls();
  }
  /** The way as frames; undefined where the linkage has none. */
  get path() {
    return this.linkage?.ways[this.way];
  }
  /** What a place to stop at is called. */
  get stop() {
    return nounOf(this.data);
  }
  controls() {
    const button = (name, text, label2, onclick) => h("button", { type: "button", class: `bm-button ${name}`, "aria-label": label2, title: label2, onclick }, text);
    this.button = button("bm-play", "", "Play", () => this.play(!this.playing));
    this.slider = h("input", { type: "range", class: "bm-slider", min: 0, step: "any", "aria-label": "Driver", oninput: () => this.go(this.turned(Number(this.slider.value))) });
    this.box = h("input", { type: "checkbox", onchange: () => this.playWhole(this.box.checked) });
    this.boxName = h("span", {}, "Whole branch");
    this.stops = s("svg", { class: "bm-stops", "aria-hidden": "true" });
    this.parts = ["", "", "", ""].map((text) => h("span", {}, text));
    this.readout = h("output", { class: "bm-now" }, this.parts.flatMap((part, k) => k ? [" ", part] : [part]));
    this.slider.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      this.step(event.shiftKey ? 10 * step : step);
    });
    const choice = (label2, entries, take) => h("select", { class: "bm-pick", "aria-label": label2, title: label2, onchange: (event) => take(event.target.value) }, entries.map(([value, text]) => h("option", { value }, text)));
    this.steps = [button("bm-back", "", "", () => this.toPose(-1)), button("bm-next", "", "", () => this.toPose(1))];
    this.speeds = choice("Speed", SPEEDS.map((each) => [each, `${each} ×`]), (value) => this.speed = Number(value));
    this.speeds.value = "1";
    this.loops = choice("What comes after the last pose", LOOPS, (value) => this.takeLoop(value));
    this.real = h("input", { type: "checkbox", onchange: () => this.isReal = this.real.checked });
    this.realLabel = h("label", { class: "bm-real", hidden: true, title: "Move as the drive of the task moves it" }, this.real, h("span", {}, "As driven"));
    this.wholeLabel = h("label", { class: "bm-whole" }, this.box, this.boxName);
    this.nameStops();
    return h(
      "div",
      { class: "bm-controls" },
      h("div", { class: "bm-track" }, this.slider, this.stops),
      h(
        "div",
        { class: "bm-row" },
        this.button,
        this.steps[0],
        button("bm-small-step", "‹", "A small step back", () => this.step(-1)),
        button("bm-small-step", "›", "A small step on", () => this.step(1)),
        this.steps[1]
      ),
      h("div", { class: "bm-more" }, this.speeds, this.loops, this.wholeLabel, this.realLabel),
      this.readout
    );
  }
  /** What the buttons call the places to stop at. */
  nameStops() {
    const { stop } = this, title = stop[0].toUpperCase() + stop.slice(1);
    [[`◀ ${title}`, `Previous ${stop}`], [`${title} ▶`, `Next ${stop}`]].forEach(([text, label2], k) => {
      say(this.steps[k], text);
      put(this.steps[k], "aria-label", label2);
      give(this.steps[k], "title", label2);
    });
    give(this.wholeLabel, "title", `Play all that the driver reaches, not only from the first ${stop} to the last`);
  }
  /** Another linkage, on the way with most poses, at the first of them. */
  load(linkage) {
    this.linkage = linkage;
    this.take(wayOfMost(linkage));
  }
  /** Another way, at its first pose. */
  take(index) {
    this.way = index;
    this.u = this.firstStop();
    this.draw.rebuild();
  }
  /** Poses on this way, in their order: the rows of their errors, with k, the pose's index. */
  get stopsOnWay() {
    return this.linkage.pose_errors.map((row, k) => ({ ...row, k })).filter((row) => row.way === this.way);
  }
  firstStop() {
    return this.stopsOnWay[0]?.frame ?? 0;
  }
  /** The slider and what it runs over, for the way as it is now. */
  rebuild() {
    const { path, slider } = this;
    if (!path) this.play(false);
    this.nameStops();
    for (const each of [slider, this.button]) give(each, "disabled", !path);
    if (this.linkage) this.stretch = stretchOf(this.linkage, this.way, this.whole);
    give(this.box, "disabled", !this.stretch.isApart);
    give(this.realLabel, "hidden", !this.timed);
    say(this.boxName, path?.round ? "Whole turn" : "Whole branch");
    this.heading = 1;
    this.u = clamp(this.u, this.stretch.low, this.stretch.high);
  }
  /** Play all of a way, or only from its first pose to its last; so it stays for other linkages. */
  playWhole(on) {
    this.whole = on;
    this.draw.rebuild();
  }
  /** Marks under the slider where the poses are, with as many of their names as there is room for. */
  drawStops() {
    const { stops, path } = this, { low, high } = this.stretch;
    stops.replaceChildren();
    if (!path) return;
    const width = Math.max(60, this.slider.clientWidth), inset = 9;
    const X = (u) => inset + (this.turned(u) - low) / (high - low) * (width - 2 * inset);
    const known = this.stopsOnWay.filter((row) => this.data.poses[row.k]);
    const rows = known.sort((a, b) => X(a.frame) - X(b.frame)).map((row) => ({ ...row, x: X(row.frame), pose: this.data.poses[row.k] }));
    const named = laidOut(rows.map(({ x, pose }) => ({ x, text: shortened(poseName(pose), LONGEST_TICK) })), width, NAME_ROWS);
    const texts = named.every(({ at }) => at >= 0) ? named : laidOut(rows.map(({ x, pose }) => ({ x, text: pose.label })), width, rows.length > MANY_POSES3 ? 1 : NUMBER_ROWS);
    const deepest = Math.max(0, ...texts.map(({ at }) => at));
    const one = (k, pose, ...parts) => s("g", { "data-pose": k + 1 }, s("title", {}, calledOf(pose)), ...parts);
    rows.forEach(({ k, x, pose }, i) => stops.append(one(k, pose, s("path", { d: `M${px(x)} 0V${4 + ROW * Math.max(0, texts[i].at)}` }))));
    rows.forEach(({ k, pose }, i) => {
      const { at, middle, text } = texts[i];
      if (at >= 0) stops.append(one(k, pose, s("text", { x: px(middle), y: 14 + ROW * at, "text-anchor": "middle" }, text)));
    });
    put(stops, "viewBox", `0 0 ${width} ${16 + ROW * deepest}`);
    put(stops, "height", 16 + ROW * deepest);
  }
  play(on) {
    if (on && !this.path) return;
    this.remaining = null;
    if (on === this.playing && this.isDressed) return;
    this.isDressed = true;
    this.playing = on;
    put(this.readout, "aria-live", on ? "off" : "polite");
    this.button.replaceChildren(icon(on), on ? "Pause" : "Play");
    put(this.button, "aria-label", on ? "Pause" : "Play");
    this.button.title = on ? "Pause (space)" : "Play (space)";
    cancelAnimationFrame(this.tick);
    if (!on) return;
    let before = null;
    const run = (now) => {
      if (!this.playing) return;
      if (before !== null) this.advance(Math.min(0.1, (now - before) / 1e3));
      before = now;
      if (this.playing) this.tick = requestAnimationFrame(run);
    };
    this.tick = requestAnimationFrame(run);
  }
  /** Play once there and back, or once round; then rest until someone asks. */
  playOnce() {
    if (!this.path) return;
    const { low, high } = this.stretch;
    this.u = this.turned(low);
    this.heading = 1;
    this.play(true);
    this.remaining = (this.goesRound ? 1 : 2) * (high - low);
  }
  /** Whether what is played ends where it begins. */
  get goesRound() {
    return this.path.round && this.stretch.high - this.stretch.low > this.path.x.length - 1 - TURN;
  }
  /** A frame counted in time, from the low end of the stretch on, and back. */
  turned(u) {
    const { low, high, sense } = this.stretch;
    return sense < 0 ? low + high - u : u;
  }
  /** What is known of the linkage's motion in time along this way. */
  get timed() {
    const loads = this.linkage?.followed ? null : this.linkage?.loads;
    return loads?.way === this.way && !this.whole ? loads.timed : null;
  }
  /** Another answer to what comes after the last pose. */
  takeLoop(loop) {
    this.loop = loop;
    this.heading = 1;
  }
  advance(seconds) {
    const { low, high } = this.stretch;
    if (this.isReal && this.timed) return this.drive(seconds);
    const step = this.speed * seconds * (high - low) / (this.goesRound ? TURN_SECONDS : TURN_SECONDS / 2);
    if (this.remaining !== null) {
      this.remaining -= step;
      if (this.remaining <= 0) {
        this.play(false);
        this.u = this.firstStop();
        this.show();
        return;
      }
    }
    const at = this.turned(this.u) + this.heading * step, isOver = at >= high;
    if (isOver && this.loop === "once") {
      this.play(false);
      this.u = this.turned(high);
    } else if (this.goesRound) {
      this.u = this.turned(around(at, high));
    } else if (isOver && this.loop === "again") {
      this.u = this.turned(low);
    } else {
      if (isOver || at <= low) this.heading = isOver ? -1 : 1;
      this.u = this.turned(clamp(at, low, high));
    }
    this.show();
  }
  /** Move as the drive of the task does: from its first moment on, and again or to rest at its last. */
  drive(seconds) {
    const { timed } = this, { y } = timed.time, last = Math.max(y[0], y[y.length - 1]), here = valueAt(timed.time, linear(this.path.drive, this.u)) ?? 0;
    let time = here + this.speed * seconds;
    if (time >= last && here < last) time = last;
    else if (time >= last && this.loop === "once") return this.play(false);
    else if (time >= last) time = 0;
    this.u = frameAt(this.path.drive, driveAtTime(timed, time) ?? linear(this.path.drive, this.u) ?? 0);
    this.show();
  }
  step(steps) {
    if (!this.path) return;
    const { low, high } = this.stretch;
    const at = this.turned(this.u) + steps * Math.max(1e-3, (high - low) / STEPS);
    this.go(this.turned(this.goesRound ? around(at, high) : at));
  }
  go(u) {
    if (!this.path) return;
    this.play(false);
    this.u = clamp(u, this.stretch.low, this.stretch.high);
    this.show();
  }
  /** The next pose (sense 1) or the one before (-1) that the linkage reaches, on whichever way. */
  toPose(sense) {
    const all = this.linkage.pose_errors.map((row, k) => ({ ...row, k })).filter((row) => row.way !== null);
    if (!all.length) return;
    const here = this.atPose ?? (sense > 0 ? -1 : this.data.poses.length);
    const next = sense > 0 ? all.find((row) => row.k > here) ?? all[0] : [...all].reverse().find((row) => row.k < here) ?? all[all.length - 1];
    this.play(false);
    if (next.way !== this.way) {
      this.way = next.way;
      this.u = next.frame;
      this.draw.rebuild();
    }
    this.go(next.frame);
    this.atPose = next.k;
  }
  /** The place of the body at a frame of the way. */
  placeAt(u) {
    return placeAt(this.linkage, this.path, u, this.data.chart.length);
  }
  /** The pose nearest to a place, the angle weighed as the errors weigh it. */
  nearest(place) {
    let near = 0, least = Infinity;
    this.data.poses.forEach((pose, k) => {
      const turn = pose.angle_deg === null ? 0 : place.a - radians(pose.angle_deg);
      const away = Math.hypot(place.x - pose.x, place.y - pose.y, this.data.chart.length * (turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI))));
      if (away < least) [near, least] = [k, away];
    });
    return near;
  }
  /** Draw where it is; told: also with the slider and in words, which may lag behind a hand. */
  show(told = true) {
    const { path } = this;
    if (!path) {
      for (const part of this.parts) part.textContent = "";
      return;
    }
    const place = this.placeAt(this.u);
    const drive = linear(path.drive, this.u), transmission = linear(path.transmission, this.u);
    const near = this.atPose = this.nearest(place);
    if (told) {
      give(this.slider, "min", this.stretch.low);
      give(this.slider, "max", this.stretch.high);
      give(this.slider, "value", this.turned(this.u));
      this.tell(place, drive, transmission, near);
    }
    this.draw.show(place, drive, transmission, near);
  }
  /** Where the driver is: an angle, or a place on its line. */
  driverText(drive) {
    const { data, linkage } = this;
    return linkage.led[0].kind === "PR" ? `${fixed(drive, decimalsOf(data))}${data.unit ? ` ${data.unit}` : ""}` : `${linkage.crank ?? ""}${fixed(drive, 1)}°`;
  }
  /** The readout: driver, body, transmission angle, and the nearest pose. */
  tell(place, drive, transmission, near) {
    const { data, linkage } = this;
    const unit2 = data.unit ? ` ${data.unit}` : "", digits = decimalsOf(data), driver = this.driverText(drive);
    const pose = data.poses[near], row = linkage.pose_errors[near];
    const at = row?.at === this.path && Math.abs(row.frame - this.u) < 1e-6;
    const away = () => `${figure(Math.hypot(place.x - pose.x, place.y - pose.y))}${unit2} from ${calledOf(pose)}`;
    const missed = () => `at ${calledOf(pose)}, ${row.said.position === "exact" ? "" : "off by "}${missOf(row.said.position, row.said.turned, unit2)}`;
    const said = !pose ? "between the poses" : pose.called ? `${at ? "at" : "near"} ${pose.called}` : at ? missed() : away();
    const time = this.isReal && this.timed && drive !== null ? valueAt(this.timed.time, drive) : null;
    const known = this.path.told?.map((each) => this.toldOf(each)) ?? [
      `driver ${driver}${time === null ? "" : ` at ${fixed(time, 2)} s`}`,
      `body (${fixed(place.x, digits)}, ${fixed(place.y, digits)})${unit2}, ${fixed(((degrees(place.a) + 180) % 360 + 360) % 360 - 180, 2)}°`
    ];
    const texts = [
      ...known,
      `transmission ${transmission === null ? "–" : `${fixed(transmission, 1)}°`}`,
      said
    ];
    texts.forEach((text, k) => {
      const whole = k + 1 < texts.length ? `${text} ·` : text;
      if (this.parts[k].textContent !== whole) this.parts[k].textContent = whole;
    });
    put(this.slider, "aria-valuetext", `${texts[0]}, ${texts[3]}`);
  }
  /** A value along the way, and how far it is off where a panel says so. */
  toldOf({ name, digits, values, panel }) {
    const error = panel === void 0 ? null : valueAt(this.linkage.panels[panel], smooth(this.path.drive, this.u));
    const off = error === null ? "" : `, off by ${Math.abs(error) < NO_ERROR2 ? "0" : figure(error)}°`;
    return `${name} ${fixed(smooth(values, this.u), digits)}°${off}`;
  }
};
function laidOut(texts, width, count) {
  const ends = Array(count).fill(-99);
  return texts.map(({ x, text }) => {
    const size = 6.4 * text.length, left = clamp(x - size / 2, 0, Math.max(0, width - size));
    const at = ends.findIndex((end) => left > end + 4);
    if (at >= 0) ends[at] = left + size;
    return { text, at, middle: left + size / 2 };
  });
}
var around = (u, turn) => (u % turn + turn) % turn;
function icon(pause) {
  return s(
    "svg",
    { width: 12, height: 12, viewBox: "0 0 12 12", "aria-hidden": "true" },
    s("path", { d: pause ? "M1 0h3.5v12H1zM7.5 0H11v12H7.5z" : "M1 0l11 6l-11 6z" })
  );
}

// src/burmester/web/widget/printing.mjs
function unfoldForPrint(root, signal) {
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
function restForPrint(player, signal) {
  let before = 0;
  window.addEventListener("beforeprint", () => {
    player.play(false);
    before = player.u;
    const [nearest] = player.linkage ? player.stopsOnWay.map(({ frame }) => frame).sort((a, b) => Math.abs(a - before) - Math.abs(b - before)) : [];
    if (nearest !== void 0) player.go(nearest);
  }, { signal });
  window.addEventListener("afterprint", () => player.go(before), { signal });
}
var detailsOf = (root, which) => root.querySelectorAll(`details${which}`);

// src/burmester/web/widget/report.mjs
var REDUCED_MOTION = "(prefers-reduced-motion: reduce)";
var DARK_SCHEME = "(prefers-color-scheme: dark)";
var HIGHEST = 0.66;
var LONGEST_NAME3 = 5;
var section = (name, title, ...content) => h("section", { class: `bm-card bm-${name}`, "aria-label": title }, h("h2", {}, title), ...content);
var NOTHING = { unit: null, poses: [], path: null, body: null, keep_out: [], loads: null, dyads: [] };
function label(poses) {
  const short = poses.every((pose) => pose.name.length <= LONGEST_NAME3);
  poses.forEach((pose, k) => pose.label = short ? pose.name : String(k + 1));
}
var Report = class {
  /** @type {any} */
  player;
  /** @type {any} */
  linkage;
  /** @type {any} */
  story;
  /** @type {any} */
  title;
  /** @type {any} */
  far;
  /** @type {any} */
  farName;
  /** @type {any} */
  farLabel;
  /** @type {any} */
  closer;
  /** @type {any} */
  closeLabel;
  /** @type {any} */
  numbers;
  /** @type {any} */
  cards;
  /** @type {any} */
  poses;
  /** @type {any} */
  rows;
  /** @type {any} */
  current;
  /** @type {any} */
  sizes;
  /** @type {any} */
  fitting;
  /** @type {any} */
  assemblies;
  /** @type {any} */
  plots;
  /** @type {any} */
  loops;
  /** @type {any} */
  loads;
  /** @type {any} */
  aside;
  /** @type {any} */
  plane;
  /** @type {any} */
  spaceStory;
  /** @type {any} */
  spaceNumbers;
  constructor(given, el, options) {
    const data = this.data = { ...NOTHING, ...given };
    this.el = el;
    this.options = options;
    this.ended = new AbortController();
    for (const { poses } of [data, ...data.linkages.flatMap(({ picture }) => picture ?? [])]) label(poses);
    Object.assign(data, data.linkages[0]?.picture);
    this.linkages = data.linkages.map((linkage) => ({
      ...linkage,
      pose_errors: linkage.pose_errors.map((row) => ({ ...row, at: row.way === null ? null : linkage.ways[row.way] }))
    }));
    this.root = h("div", { class: "bm" });
    el.replaceChildren(this.root);
    this.frame();
    if (this.linkages.length) this.choose(0);
    else this.rebuild();
    this.listen();
  }
  /** Everything that is there whichever linkage is chosen, with the places for the rest. */
  frame() {
    const { data, linkages } = this;
    const main = h("div", { class: "bm-main" }), body = h("div", { class: "bm-body" });
    this.root.append(header(data, linkages.some((each) => each.usable)), body);
    if (linkages.length) {
      this.player = new Player(data, (...now) => this.show(...now), () => this.rebuild());
      this.assemblies = new Assemblies(data, (index) => this.player.take(index));
      this.cards = new Cards(data, linkages, (index) => this.choose(index));
      body.append(this.cards.element);
    }
    body.append(main);
    main.append(this.stage());
    if (linkages.length) main.append(this.numbersAndPlots());
    if (linkages.length && data.loads) main.append(this.loadPlots());
    const family = data.family_map ? this.familyMap() : null;
    const space = data.space ? this.imageSpace() : null;
    main.append(...(this.family?.isCurve ? [family, space] : [space, family]).filter(Boolean));
    if (data.pivot_map) main.append(this.pivotMap());
    this.poses = section("pose-box", { point: "Point by point", pose: "Pose by pose", place: "Pair by pair" }[nounOf(data)]);
    main.append(this.poses);
    if (linkages.length) main.append(section("all", "All linkages", worded(data, { ...data.table, class: "bm-linkages bm-stacks" }), this.everyDimension()));
    if (data.dyads.length) main.append(section("dyads", "Dyads", dyadTable(data)));
    if (data.certificate) main.append(section("proved", "What is proved", provedOf(data)));
    this.root.append(h("footer", { class: "bm-foot-notes" }, data.footnotes));
  }
  /** The drawing with what moves it. */
  stage() {
    const { data, player } = this;
    const drawing = h("div", { class: "bm-drawing" });
    this.plane = new Plane(data, drawing);
    this.plane.reveal = () => {
      this.far.checked = true;
      this.draw();
    };
    this.title = h("h2", { class: "bm-stage-title" }, "The poses");
    this.story = h("p", { class: "bm-story" });
    return h(
      "section",
      { class: "bm-card bm-stage", "aria-label": "The linkage moving" },
      this.title,
      this.story,
      drawing,
      player ? [player.element, this.assemblies.element] : null,
      h("div", { class: "bm-under" }, keyOf(data, Boolean(player)), player ? h("div", { class: "bm-choose" }, this.farPivots(), data.stop ? null : this.magnification()) : null)
    );
  }
  /** Whether the picture is to hold far pivots and outlines that leave it; only where there are some. */
  farPivots() {
    this.far = h("input", { type: "checkbox", checked: Boolean(this.data.whole), onchange: () => this.draw() });
    this.farName = h("span", {});
    this.farLabel = h("label", { class: "bm-factor bm-far-pivots", hidden: true }, this.far, " ", this.farName);
    this.closer = h("input", { type: "checkbox", onchange: () => this.draw() });
    this.closeLabel = h("label", { class: "bm-factor bm-close-up", hidden: true }, this.closer, " The linkage alone");
    return [this.closeLabel, this.farLabel];
  }
  offerAll(linkage) {
    if (!this.farLabel) return;
    const pivots = hasFarPivots(this.data, linkage, this.plane.places);
    this.farLabel.hidden = !pivots && !this.plane.cut && (this.data.whole || !this.far.checked);
    this.farName.textContent = pivots ? "Whole linkage, with far pivots" : "All of the surroundings";
    this.closeLabel.hidden = !this.plane.isLarge;
  }
  magnification() {
    this.factor = h(
      "select",
      { onchange: () => this.draw() },
      FACTORS.map((factor) => h("option", { value: factor }, factor ? `× ${factor.toLocaleString("en").replaceAll(",", " ")}` : "not drawn"))
    );
    return h("label", { class: "bm-factor" }, "Error arrows ", this.factor);
  }
  numbersAndPlots() {
    this.numbers = h("div", { class: "bm-fill" });
    this.loops = h("div", {});
    const plots = h("div", { class: "bm-fill" });
    this.plots = new Plots(this.data, plots, (u) => this.player.go(u));
    plots.append(this.loops);
    this.aside = h(
      "div",
      { class: "bm-aside" },
      section("numbers", "Numbers", this.numbers),
      section("plotted", this.linkages[0].loops ? "Transmission over the driver" : "Errors and transmission", plots)
    );
    return this.aside;
  }
  /** What the linkage bears, and how it moves in time. */
  loadPlots() {
    const plots = h("div", { class: "bm-fill" });
    this.loads = new LoadPlots(this.data, plots, (u) => this.player.go(u));
    return section("loaded", "Loads along the motion", plots);
  }
  imageSpace() {
    const picture = h("div", { class: "bm-fill" });
    this.spaceStory = h("p", { class: "bm-story" });
    this.spaceNumbers = h("details", { class: "bm-every" }, h("summary", {}, "In numbers"));
    this.space = new ImageSpace(this.data, picture, this.options.webgl !== false);
    return section("image", "Image space", this.spaceStory, picture, this.spaceNumbers);
  }
  pivotMap() {
    const picture = h("div", { class: "bm-fill" });
    this.map = new PivotMap(this.data, picture);
    return section(
      "pivots",
      "Where to put a fixed pivot",
      h("p", { class: "bm-story" }, "How well the best link with its fixed pivot at a place meets the poses: the stronger the colour, the better."),
      picture
    );
  }
  familyMap() {
    const picture = h("div", { class: "bm-fill" });
    this.family = new FamilyMap(this.data, picture);
    const story = this.family.isCurve ? "Every dyad that meets the four poses is a place on a curve. Here each is paired with each other one; a pair that works is coloured by its least transmission angle, driven from its better side." : `Every fixed pivot has one dyad that meets the three poses. Here ${this.data.family_map.chosen.id} is paired with each of them, at the place of its fixed pivot; a pair that works is coloured by its least transmission angle, driven from its better side.`;
    return section(`family bm-family-${this.data.family_map.kind}`, "Which pairs of dyads work", h("p", { class: "bm-story" }, story), picture);
  }
  /** For print, and for those who read: the dimensions of every linkage. */
  everyDimension() {
    const parts = this.linkages.map((each) => h("div", { class: "bm-every-one" }, numbersOf(this.data, each)));
    return this.linkages[0].tables?.length === 0 ? null : h("details", { class: "bm-every" }, h("summary", {}, "Dimensions of every linkage"), h("div", { class: "bm-every-all" }, parts));
  }
  choose(index) {
    const known = Boolean(this.linkage);
    this.linkage = this.linkages[index];
    Object.assign(this.data, this.linkage.picture);
    this.cards.mark(index);
    if (this.factor) this.factor.value = String(factorFor(this.data, this.linkage));
    this.player.load(this.linkage);
    if (known) this.bringIntoSight();
  }
  /** Where the cards stand under the picture, a choice among them goes back to the picture. */
  bringIntoSight() {
    const stage = this.plane.parent.parentElement;
    if (stage.getBoundingClientRect().bottom < 0.4 * window.innerHeight) stage.scrollIntoView({ block: "start" });
  }
  /** Everything that depends on the linkage and on its way. */
  rebuild() {
    const { linkage, data, player } = this;
    if (linkage) {
      player.rebuild();
      this.title.textContent = `${linkage.id}: ${linkage.type}`;
      this.story.textContent = linkage.said.story;
      this.loops.replaceChildren(loopKey(linkage) ?? "");
      this.assemblies.build(linkage, player.way);
      this.numbers.replaceChildren(...numbersOf(data, linkage), factsOf(linkage), ...linkage.said.notes.map((note) => h("p", { class: "bm-note-text" }, note)));
    }
    this.poses.replaceChildren(this.poses.querySelector("h2"), linkage?.stops ? worded(data, linkage.stops) : poseTable(data, linkage));
    const rows = [...this.poses.querySelectorAll("tbody tr")];
    this.rows = data.poses.map((pose, k) => rows[pose.row === void 0 ? k : pose.row]);
    if (this.space) {
      this.spaceStory.replaceChildren(...spaceStory(data, linkage));
      this.spaceNumbers.replaceChildren(this.spaceNumbers.firstChild, ...imageTables(data, linkage));
    }
    this.draw();
  }
  /** Draw what stands still anew, and then what moves. */
  draw() {
    const { linkage, player } = this, way = player?.way ?? 0, stretch = player?.stretch;
    this.plots?.build(linkage, way, stretch);
    this.loads?.build(linkage, way);
    const factor = Number(this.factor?.value ?? 0), far = Boolean(this.far?.checked), close = Boolean(this.closer?.checked);
    this.plane.build(linkage, way, stretch, { factor, fill: this.room(), far, close });
    this.offerAll(linkage);
    this.plane.svg.setAttribute("aria-label", linkage ? `${linkage.id}, a ${linkage.type}, at the poses. Space plays, arrow keys move the driver.` : "The poses");
    this.space?.build(linkage, way);
    this.map?.build(linkage);
    this.family?.build(linkage, this.linkages.indexOf(linkage));
    if (!player?.path) this.space?.hide();
    player?.drawStops();
    player?.show();
  }
  /** The height that is left for the drawing where the numbers stand beside it. */
  room() {
    if (!this.aside) return 0;
    const stage = this.plane.parent.parentElement;
    if (this.aside.offsetLeft <= stage.offsetLeft) return 0;
    const beside = this.aside.offsetHeight - (stage.offsetHeight - this.plane.parent.clientHeight);
    return Math.min(beside, HIGHEST * window.innerHeight);
  }
  /** What moves, at a place of the body; near: the index of the nearest pose. */
  show(place, drive, transmission, near) {
    this.plane.show(place, drive);
    this.space?.show(place);
    this.plots.show(drive);
    this.loads?.show(drive);
    const row = this.rows[near];
    if (row === this.current) return;
    this.current?.classList.remove("bm-current");
    row?.classList.add("bm-current");
    this.current = row;
  }
  listen() {
    const { root, player } = this, { signal } = this.ended;
    window.matchMedia(DARK_SCHEME).addEventListener("change", () => this.draw(), { signal });
    let width = root.clientWidth;
    this.sizes = new ResizeObserver(() => {
      if (root.clientWidth === width) return;
      width = root.clientWidth;
      cancelAnimationFrame(this.fitting);
      this.fitting = requestAnimationFrame(() => this.draw());
    });
    this.sizes.observe(root);
    unfoldForPrint(root, signal);
    if (!player) return;
    listenToKeys(this.root, this.plane.svg, player, signal);
    restForPrint(player, signal);
    player.play(false);
    if (!this.options.still && !window.matchMedia(REDUCED_MOTION).matches) player.playOnce();
  }
  close() {
    this.ended.abort();
    this.sizes.disconnect();
    cancelAnimationFrame(this.fitting);
    this.player?.play(false);
    this.el.replaceChildren();
  }
};

// src/burmester/web/widget/widget.mjs
var widget = {
  render({ model, el }) {
    const options = { webgl: model.get("webgl") ?? true };
    const made = (data) => new Report(data, el, options);
    let report = made(model.get("data"));
    const anew = () => {
      report.close();
      report = made(model.get("data"));
    };
    model.on?.("change:data", anew);
    return () => {
      model.off?.("change:data", anew);
      report.close();
    };
  }
};
export {
  widget as default
};
