// The report of a synthesis: ranked linkages, the chosen one moving, its errors and its image space.
//
// An ES module in anywidget's module format: render({ model, el }) fills the element and returns
// what takes it away again; model.get("data") is what `burmester.report.data.report_data` makes.
// No other code is needed, and nothing is loaded.  Angles are radians unless a name says degrees;
// lengths in the task's unit; F is the ground, M the body.

const SVG = "http://www.w3.org/2000/svg";
const TURN_SECONDS = 7; // a whole turn of the driver, or a branch there and back
const REDUCED = "(prefers-reduced-motion: reduce)";
const DARK = "(prefers-color-scheme: dark)";

// ------------------------------------------------------------------------------ small tools

function made(node, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

const h = (tag, attributes, ...children) => made(document.createElement(tag), attributes, children);
const s = (tag, attributes, ...children) =>
  made(document.createElementNS(SVG, tag), attributes, children);

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
const degrees = (angle) => (angle * 180) / Math.PI;
const px = (value) => (Math.abs(value) < 1e7 ? +value.toFixed(5) : Math.sign(value) * 1e7);

/** A number with so many decimals, and no sign where it is zero. */
function fixed(value, digits) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

/** A figure with two digits, as `reasons.figure` writes it. */
function figure(value) {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 99.5 && size < 1e6) return value.toFixed(0);
  if (size >= 1e-4 && size < 99.5) {
    const places = Math.max(0, 1 - Math.floor(Math.log10(size)));
    return String(Number(value.toFixed(places)));
  }
  const [digits, power] = value.toExponential(1).split("e");
  const places = String(Math.abs(Number(power))).padStart(2, "0");
  return `${Number(digits)}e${Number(power) < 0 ? "-" : "+"}${places}`;
}

/** Round numbers between two ends, about so many of them. */
function ticks(low, high, about) {
  const rough = (high - low) / Math.max(1, about);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((k) => k * power).find((each) => each >= rough * 0.999);
  const digits = Math.max(0, -Math.floor(Math.log10(step * 1.0001)));
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + step * 1e-9; k += 1) {
    found.push({ at: k * step, text: fixed(k * step, digits) });
  }
  return found;
}

/** Turning ticks: of an axis in degrees. */
function angleTicks(low, high, about) {
  const step = [5, 10, 15, 30, 45, 60, 90, 180].find((each) => (high - low) / each <= about) ?? 360;
  const found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-6; k += 1) {
    found.push({ at: k * step, text: `${fixed(k * step, 0)}°` });
  }
  return found.length > 1 ? found : ticks(low, high, about).map((t) => ({ ...t, text: `${t.text}°` }));
}

function listed(words) {
  if (words.length < 2) return words.join("");
  return `${words.slice(0, -1).join(", ")} and ${words[words.length - 1]}`;
}

/** Numbers from 1 with runs drawn together: "1–4 and 7". */
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

// --------------------------------------------------------------------------------- kinematics

/** A point of M, seen in F. */
function act(place, [x, y]) {
  const c = Math.cos(place.a), d = Math.sin(place.a);
  return [place.x + c * x - d * y, place.y + d * x + c * y];
}

/** A point of F, seen in M. */
function back(place, [x, y]) {
  const c = Math.cos(place.a), d = Math.sin(place.a);
  return [c * (x - place.x) + d * (y - place.y), -d * (x - place.x) + c * (y - place.y)];
}

const normalOf = (dyad) => {
  const angle = (dyad.line.normal_deg * Math.PI) / 180;
  return [Math.cos(angle), Math.sin(angle)];
};

/** How far a place is from what a dyad allows, and the derivatives by x, y and the angle. */
function equation(dyad, place) {
  if (dyad.kind === "PP") {
    const away = place.a - (dyad.angle_deg * Math.PI) / 180;
    return [away - 2 * Math.PI * Math.round(away / (2 * Math.PI)), 0, 0, 1];
  }
  if (dyad.kind === "RP") {
    const [nx, ny] = normalOf(dyad);
    const c = Math.cos(place.a), d = Math.sin(place.a);
    const tx = c * nx - d * ny, ty = d * nx + c * ny;
    const ax = dyad.fixed_pivot[0] - place.x, ay = dyad.fixed_pivot[1] - place.y;
    return [tx * ax + ty * ay - dyad.line.offset, -tx, -ty, tx * ay - ty * ax];
  }
  const [x, y] = act(place, dyad.moving_pivot);
  let nx, ny, miss;
  if (dyad.kind === "RR") {
    const ax = x - dyad.fixed_pivot[0], ay = y - dyad.fixed_pivot[1];
    const size = Math.hypot(ax, ay) || 1;
    [nx, ny, miss] = [ax / size, ay / size, size - dyad.radius];
  } else {
    [nx, ny] = normalOf(dyad);
    miss = nx * x + ny * y - dyad.line.offset;
  }
  return [miss, nx, ny, (x - place.x) * ny - (y - place.y) * nx];
}

/** A place near a linkage, put on it by the shortest step; `length` weighs the angle. */
function settled(dyads, place, length) {
  let { x, y, a } = place;
  for (let step = 0; step < 4; step += 1) {
    const [f, ...p] = equation(dyads[0], { x, y, a });
    const [g, ...q] = equation(dyads[1], { x, y, a });
    p[2] /= length;
    q[2] /= length;
    const pp = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    const pq = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    const qq = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    const det = pp * qq - pq * pq;
    if (!(det > 1e-9 * pp * qq)) return { x, y, a }; // at a change point: as it is
    const u = (f * qq - g * pq) / det, v = (g * pp - f * pq) / det;
    x -= u * p[0] + v * q[0];
    y -= u * p[1] + v * q[1];
    a -= (u * p[2] + v * q[2]) / length;
    if (Math.abs(f) + Math.abs(g) < 1e-14 * length) break;
  }
  return { x, y, a };
}

/** Between four values, at a share of the way from the second to the third. */
function between(values, i, share, round) {
  const last = values.length - 1;
  const at = (k) => {
    if (k >= 0 && k <= last) return values[k];
    if (!round) return k < 0 ? 2 * values[0] - values[-k] : 2 * values[last] - values[2 * last - k];
    const wrap = k < 0 ? k + last : k - last; // a turn of the angle is kept
    return values[wrap] + (k < 0 ? -1 : 1) * (values[last] - values[0]);
  };
  const [p, q, r, t] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
  return q + (share / 2) * (r - p + share * (2 * p - 5 * q + 4 * r - t + share * (3 * (q - r) + t - p)));
}

/** Where the coupler is at frame u of a way, u need not be whole; exactly on the linkage. */
function placeAt(linkage, way, u, length) {
  const stop = linkage.pose_errors.find((row) => row.at === way && Math.abs(row.frame - u) < 1e-6);
  if (stop) return { x: stop.x, y: stop.y, a: (stop.angle_deg * Math.PI) / 180 };
  const i = clamp(Math.floor(u), 0, way.x.length - 2), share = u - i;
  const place = {
    x: between(way.x, i, share, way.round),
    y: between(way.y, i, share, way.round),
    a: between(way.angle, i, share, way.round),
  };
  return settled(linkage.led, place, length);
}

function linear(values, u) {
  const i = clamp(Math.floor(u), 0, values.length - 2), share = u - i;
  if (values[i] === null || values[i + 1] === null) return null;
  return values[i] + share * (values[i + 1] - values[i]);
}

/** The frame at which rising values reach one. */
function frameAt(values, wanted) {
  let low = 0, high = values.length - 1;
  if (wanted <= values[low]) return low;
  if (wanted >= values[high]) return high;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= wanted) low = middle;
    else high = middle;
  }
  const step = values[high] - values[low];
  return low + (step > 0 ? (wanted - values[low]) / step : 0);
}

// ----------------------------------------------------------------------- the linkage in its plane

const AXIS = 26; // pixels: the x axis of a pose
const BLOCK = [22, 14]; // pixels: a slider's length and height
const FAR = 2.5; // sizes of the scene from its middle: what is farther away does not widen the picture

/** Everything that should be in the picture: [x low, y low, x high, y high]. */
function boundsOf(data, linkage) {
  const points = data.poses.map((pose) => [pose.x, pose.y]);
  const middle = [0, 1].map((k) => {
    const values = points.map((point) => point[k]);
    return (Math.min(...values) + Math.max(...values)) / 2;
  });
  const near = ([x, y]) =>
    Math.hypot(x - middle[0], y - middle[1]) < FAR * data.scene;
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  const hold = (point) => {
    if (!near(point)) return;
    box[0] = Math.min(box[0], point[0]);
    box[1] = Math.min(box[1], point[1]);
    box[2] = Math.max(box[2], point[0]);
    box[3] = Math.max(box[3], point[1]);
  };
  points.forEach(hold);
  if (linkage) {
    for (const dyad of linkage.led) if (dyad.fixed_pivot) hold(dyad.fixed_pivot);
    for (const way of linkage.ways) {
      for (let k = 0; k < way.x.length; k += 4) {
        const place = { x: way.x[k], y: way.y[k], a: way.angle[k] };
        hold([place.x, place.y]);
        for (const dyad of linkage.led) if (dyad.moving_pivot) hold(act(place, dyad.moving_pivot));
      }
    }
  }
  const least = 0.25 * data.scene;
  for (const k of [0, 1]) {
    const lack = least - (box[k + 2] - box[k]);
    if (lack > 0) {
      box[k] -= lack / 2;
      box[k + 2] += lack / 2;
    }
  }
  return box;
}

/** From the plane to pixels, as large as it fits. */
function frameOf(box, width, height, margin) {
  const scale = Math.min(
    (width - 2 * margin) / (box[2] - box[0]),
    (height - 2 * margin) / (box[3] - box[1]),
  );
  const left = width / 2 - (scale * (box[0] + box[2])) / 2;
  const top = height / 2 + (scale * (box[1] + box[3])) / 2;
  return { scale, left, top, width, height, X: (x) => left + scale * x, Y: (y) => top - scale * y };
}

const moved = (x, y, angle) => `translate(${px(x)} ${px(y)}) rotate(${px(degrees(-angle))})`;

/** A fixed pivot on the ground: a hatched foot. */
function foot(name) {
  let hatch = "";
  for (let k = -2; k <= 2; k += 1) hatch += `M${5.5 * k + 3} 16l-6 7`;
  return s(
    "g",
    { class: "bm-foot" },
    s("path", { class: "bm-solid", d: "M0 0L-10 16H10Z" }),
    s("path", { class: "bm-ground", d: `M-16 16H16${hatch}` }),
  );
}

/** The frame of a pose or of the body: x axis with a head, y axis shorter without one. */
function axes(length) {
  const l = length, head = Math.max(4, 0.22 * length);
  return `M0 0H${l}m${-head} ${-head / 2}l${head} ${head / 2}l${-head} ${head / 2}M0 0V${-0.6 * l}`;
}

function polyline(points, frame) {
  let path = "", pen = "M";
  for (const [x, y] of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      pen = "M";
      continue;
    }
    path += `${pen}${px(frame.X(x))} ${px(frame.Y(y))}`;
    pen = "L";
  }
  return path;
}

const pathOf = (way, point) =>
  way.x.map((x, k) => act({ x, y: way.y[k], a: way.angle[k] }, point));

/** Puts labels where they cover the least: each at one of some places around its point. */
class Labels {
  constructor(frame) {
    this.frame = frame;
    this.taken = [];
  }

  block(x, y, width, height) {
    this.taken.push([x - width / 2, y - height / 2, x + width / 2, y + height / 2]);
  }

  put(x, y, text, distance, attributes) {
    const width = 7.2 * text.length + 4, height = 14;
    let best = null;
    for (let ring = 0; ring < 3; ring += 1) {
      for (let k = 0; k < 16; k += 1) {
        const angle = (Math.PI / 8) * k + Math.PI / 4;
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
        if (box[0] < 2 || box[2] > this.frame.width - 2) cost += 500;
        if (box[1] < 2 || box[3] > this.frame.height - 2) cost += 500;
        if (!best || cost < best.cost) best = { cost, cx, cy, box };
      }
    }
    this.taken.push(best.box);
    return s(
      "text",
      { x: px(best.cx), y: px(best.cy + 4), "text-anchor": "middle", ...attributes },
      text,
    );
  }
}

const FACTORS = [0, 1, 10, 100, 1000, 10000, 100000];

/** The greatest magnification at which no error arrow is longer than a third of the scene. */
function factorFor(data, linkage) {
  const worst = Math.max(0, ...linkage.pose_errors.map((row) => row.position ?? 0));
  if (!(worst > 1e-9 * data.scene)) return 0;
  const fits = FACTORS.filter((factor) => factor >= 1 && factor * worst < 0.3 * data.scene);
  return fits.length ? fits[fits.length - 1] : 1;
}

class Plane {
  constructor(data, parent) {
    this.data = data;
    this.svg = s("svg", { class: "bm-plane", role: "img", tabindex: "0" });
    this.parent = parent;
    parent.append(this.svg);
  }

  /** Draw everything that stands still; `show` moves the rest. */
  build(linkage, way, factor, fill) {
    const { data, svg } = this;
    const box = boundsOf(data, linkage);
    const width = Math.max(260, this.parent.clientWidth);
    const shape = (box[3] - box[1]) / (box[2] - box[0]);
    const own = clamp(width * clamp(shape, 0.45, 1), 260, clamp(0.62 * window.innerHeight, 340, 680));
    const height = Math.round(fill ? clamp(fill, own, 1.15 * width) : own);
    const frame = frameOf(box, width, height, width < 500 ? 34 : 42);
    this.frame = frame;
    this.linkage = linkage;
    this.way = way;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("height", height);
    svg.dataset.scale = frame.scale;
    svg.dataset.left = frame.left;
    svg.dataset.top = frame.top;
    svg.replaceChildren();
    svg.append(this.ruled(box));
    if (linkage) svg.append(this.paths());
    const labels = new Labels(frame);
    this.names = s("g", { class: "bm-names" });
    if (linkage) svg.append(this.ground(labels));
    for (const pose of data.poses) {
      const x = frame.X(pose.x), y = frame.Y(pose.y), angle = (pose.angle_deg * Math.PI) / 180;
      const c = AXIS * Math.cos(angle), d = AXIS * Math.sin(angle);
      labels.block(x, y, 12, 12);
      for (const share of [0.35, 0.65, 1]) {
        labels.block(x + share * c, y - share * d, 6, 6);
        labels.block(x - 0.6 * share * d, y - 0.6 * share * c, 6, 6);
      }
    }
    svg.append(this.poses(linkage, factor, labels));
    this.moving = linkage?.ways.length ? this.mechanism() : null;
    if (this.moving) svg.append(this.moving.group);
    svg.append(this.names);
  }

  ruled() {
    const { frame } = this, group = s("g", { class: "bm-grid", "aria-hidden": "true" });
    const unit = this.data.unit ? ` ${this.data.unit}` : "";
    const across = ticks(-frame.left / frame.scale, (frame.width - frame.left) / frame.scale, frame.width / 110);
    const up = ticks((frame.top - frame.height) / frame.scale, frame.top / frame.scale, frame.height / 80);
    for (const { at, text } of across) {
      const x = px(frame.X(at));
      group.append(s("path", { d: `M${x} 0V${frame.height}` }));
      if (x > 46 && x < frame.width - 30) {
        group.append(s("text", { x, y: frame.height - 6, "text-anchor": "middle" }, text));
      }
    }
    for (const { at, text } of up) {
      const y = px(frame.Y(at));
      group.append(s("path", { d: `M0 ${y}H${frame.width}` }));
      if (y > 26 && y < frame.height - 24) group.append(s("text", { x: 6, y: y - 4 }, text));
    }
    group.append(
      s("text", { x: 6, y: 14 }, `y${unit}`),
      s("text", { x: frame.width - 6, y: frame.height - 6, "text-anchor": "end" }, `x${unit}`),
    );
    return group;
  }

  paths() {
    const { frame, linkage } = this, group = s("g", { class: "bm-paths" });
    linkage.ways.forEach((way, k) => {
      const here = k === this.way;
      const same = way.circuit === linkage.ways[this.way]?.circuit;
      const kind = here ? "bm-here" : same ? "bm-same" : "bm-other";
      if (here) {
        for (const [side, dyad] of linkage.led.entries()) {
          if (!dyad.moving_pivot || dyad.kind === "PR") continue;
          const d = polyline(pathOf(way, dyad.moving_pivot), frame);
          group.append(s("path", { class: `bm-pivot-path bm-side${side}`, d }));
        }
      }
      const d = polyline(way.x.map((x, i) => [x, way.y[i]]), frame);
      group.append(s("path", { class: `bm-curve ${kind}`, d }));
    });
    return group;
  }

  ground(labels) {
    const { frame, linkage } = this, group = s("g", { class: "bm-grounds" });
    linkage.led.forEach((dyad, side) => {
      if (dyad.kind === "PR") {
        const [nx, ny] = normalOf(dyad), { offset } = dyad.line;
        let low = Infinity, high = -Infinity;
        for (const way of linkage.ways) {
          for (const [x, y] of pathOf(way, dyad.moving_pivot)) {
            const along = -ny * x + nx * y;
            low = Math.min(low, along);
            high = Math.max(high, along);
          }
        }
        if (!(high >= low)) return;
        const limit = 3 * this.data.scene, middle = (low + high) / 2;
        [low, high] = [Math.max(low, middle - limit), Math.min(high, middle + limit)];
        const half = (frame.scale * (high - low)) / 2 + BLOCK[0];
        const x = offset * nx - middle * ny, y = offset * ny + middle * nx;
        const edge = BLOCK[1] / 2 + 1;
        let hatch = "";
        for (let k = -half + 4; k < half - 2; k += 8) hatch += `M${px(k + 4)} ${edge}l-6 7`;
        const rail = s(
          "g",
          { class: `bm-rail bm-side${side}`, transform: moved(frame.X(x), frame.Y(y), Math.atan2(nx, -ny)) },
          s("path", { class: "bm-ground", d: `M${px(-half)} ${edge}H${px(half)}${hatch}` }),
          s("path", { class: "bm-ground bm-thin", d: `M${px(-half)} ${-edge}H${px(half)}` }),
        );
        group.append(rail);
        const at = [frame.X(x), frame.Y(y)];
        for (let k = -half; k <= half; k += 14) {
          labels.block(at[0] - (k * ny) , at[1] - k * nx, 22, 22);
        }
        this.names.append(labels.put(...at, dyad.id, 26, { class: `bm-name bm-side${side}` }));
        return;
      }
      if (!dyad.fixed_pivot) return;
      const [x, y] = [frame.X(dyad.fixed_pivot[0]), frame.Y(dyad.fixed_pivot[1])];
      labels.block(x, y + 10, 32, 34);
      if (!side) labels.block(x, y, 40, 40);
      const at = foot();
      at.setAttribute("transform", `translate(${px(x)} ${px(y)})`);
      group.append(at);
      this.names.append(labels.put(x, y + 4, dyad.id, 27, { class: `bm-name bm-side${side}` }));
    });
    return group;
  }

  poses(linkage, factor, labels) {
    const { data, frame } = this, group = s("g", { class: "bm-poses" });
    const small = data.poses.length > 24 ? 0.6 : 1;
    const arrows = s("g", { class: "bm-errors" });
    const names = s("g", { class: "bm-pose-names" });
    data.poses.forEach((pose, k) => {
      const row = linkage?.pose_errors[k];
      if (!factor || !row || row.x === null) return;
      const x = frame.X(pose.x), y = frame.Y(pose.y);
      const dx = factor * frame.scale * (row.x - pose.x), dy = -factor * frame.scale * (row.y - pose.y);
      const size = Math.hypot(dx, dy);
      if (size < 1.5) return;
      const head = Math.min(7, 0.5 * size), ux = dx / size, uy = dy / size;
      const tip = `${px(x + dx)} ${px(y + dy)}`;
      const barb = (sign) =>
        `L${px(x + dx - head * (ux - sign * 0.5 * uy))} ${px(y + dy - head * (uy + sign * 0.5 * ux))}`;
      arrows.append(s("path", { d: `M${px(x)} ${px(y)}L${tip}${barb(1)}M${tip}${barb(-1)}` }));
      for (let share = 0; share <= 1; share += 0.2) labels.block(x + share * dx, y + share * dy, 8, 8);
    });
    data.poses.forEach((pose, k) => {
      const angle = (pose.angle_deg * Math.PI) / 180;
      const x = frame.X(pose.x), y = frame.Y(pose.y);
      group.append(
        s(
          "g",
          { class: "bm-wanted", transform: moved(x, y, angle), "data-pose": k + 1 },
          s("path", { d: axes(AXIS * small) }),
          s("circle", { r: 4.5 * small }),
        ),
      );
      if (data.poses.length <= 60) names.append(labels.put(x, y, pose.label, 13, {}));
      const row = linkage?.pose_errors[k];
      if (!row || row.x === null) return;
      const other = row.way !== this.way;
      group.append(
        s(
          "g",
          {
            class: `bm-achieved${other ? " bm-elsewhere" : ""}`,
            transform: moved(frame.X(row.x), frame.Y(row.y), (row.angle_deg * Math.PI) / 180),
          },
          s("path", { d: axes(0.72 * AXIS * small) }),
          s("circle", { r: 2.2 * small }),
        ),
      );
    });
    group.append(arrows, names);
    return group;
  }

  /** The parts that move, and what moves them. */
  mechanism() {
    const { frame, linkage } = this, [driver] = linkage.led;
    const S = frame.scale;
    const group = s("g", { class: "bm-linkage" });
    const links = s("g"), blocks = s("g"), pins = s("g");
    const coupler = s("g", { class: "bm-coupler" });
    const moves = [(place) => coupler.setAttribute("transform", moved(frame.X(place.x), frame.Y(place.y), place.a))];
    const corners = [[0, 0]];
    linkage.led.forEach((dyad, side) => {
      if (dyad.moving_pivot) corners.push([S * dyad.moving_pivot[0], -S * dyad.moving_pivot[1]]);
      if (dyad.kind === "RR") {
        const bar = s(
          "g",
          { class: `bm-link bm-side${side}` },
          s("path", { class: "bm-bar", d: `M0 0H${px(S * dyad.radius)}` }),
          s("path", { class: "bm-core", d: `M0 0H${px(S * dyad.radius)}` }),
        );
        links.append(bar);
        const [cx, cy] = dyad.fixed_pivot;
        pins.append(s("circle", { class: "bm-pin bm-fixed-pin", r: 4.5, cx: px(frame.X(cx)), cy: px(frame.Y(cy)), "data-dyad": dyad.id }));
        moves.push((place) => {
          const [x, y] = act(place, dyad.moving_pivot);
          bar.setAttribute("transform", moved(frame.X(cx), frame.Y(cy), Math.atan2(y - cy, x - cx)));
        });
      } else if (dyad.kind === "PR") {
        const block = s(
          "g",
          { class: `bm-block bm-side${side}` },
          s("rect", { x: -BLOCK[0] / 2, y: -BLOCK[1] / 2, width: BLOCK[0], height: BLOCK[1], rx: 2 }),
        );
        blocks.append(block);
        const [nx, ny] = normalOf(dyad), along = Math.atan2(nx, -ny);
        moves.push((place) => {
          const [x, y] = act(place, dyad.moving_pivot);
          block.setAttribute("transform", moved(frame.X(x), frame.Y(y), along));
        });
      } else if (dyad.kind === "RP") {
        const [nx, ny] = normalOf(dyad), { offset } = dyad.line;
        let low = Infinity, high = -Infinity;
        for (const way of linkage.ways) {
          for (let k = 0; k < way.x.length; k += 1) {
            const [x, y] = back({ x: way.x[k], y: way.y[k], a: way.angle[k] }, dyad.fixed_pivot);
            low = Math.min(low, -ny * x + nx * y);
            high = Math.max(high, -ny * x + nx * y);
          }
        }
        if (high >= low) {
          const ends = [low - 14 / S, high + 14 / S].map((t) => [
            S * (offset * nx - t * ny),
            -S * (offset * ny + t * nx),
          ]);
          const d = `M${ends.map((end) => end.map(px).join(" ")).join("L")}`;
          coupler.append(
            s("path", { class: "bm-slot-rim", d }),
            s("path", { class: "bm-slot-plate", d }),
            s("path", { class: "bm-slot-edge", d }),
            s("path", { class: "bm-slot", d }),
          );
          corners.push([S * offset * nx - (S * (low + high) * ny) / 2, -S * offset * ny - (S * (low + high) * nx) / 2]);
        }
        const [cx, cy] = dyad.fixed_pivot;
        const block = s(
          "g",
          { class: `bm-block bm-side${side}` },
          s("rect", { x: -9, y: -5, width: 18, height: 10, rx: 2 }),
        );
        blocks.append(block);
        pins.append(s("circle", { class: "bm-pin bm-fixed-pin", r: 4, cx: px(frame.X(cx)), cy: px(frame.Y(cy)), "data-dyad": dyad.id }));
        moves.push((place) =>
          block.setAttribute("transform", moved(frame.X(cx), frame.Y(cy), place.a + Math.atan2(nx, -ny))),
        );
      }
    });
    // The body: a plate through its pivots and the origin of M.
    const plate = `M${hull(corners).map((corner) => corner.map(px).join(" ")).join("L")}Z`;
    coupler.prepend(s("path", { class: "bm-plate-rim", d: plate }), s("path", { class: "bm-plate", d: plate }));
    coupler.append(
      s("path", { class: "bm-body-frame", d: axes(36) }),
      s("circle", { class: "bm-origin", r: 4 }),
    );
    const letter = s("text", { class: "bm-letter", "text-anchor": "middle" }, "M");
    moves.push((place) => {
      const [x, y] = act(place, [-14 / S, -14 / S]);
      letter.setAttribute("x", px(frame.X(x)));
      letter.setAttribute("y", px(frame.Y(y) + 4));
    });
    for (const dyad of linkage.led) {
      if (!dyad.moving_pivot) continue;
      const [x, y] = dyad.moving_pivot;
      coupler.append(s("circle", { class: "bm-pin", r: 4.5, cx: px(S * x), cy: px(-S * y), "data-dyad": dyad.id }));
    }
    // A turning arrow at the driver, for the eye that sees no colours.
    const mark = s("path", { class: "bm-drive-mark bm-side0" });
    if (driver.kind === "RR" || driver.kind === "RP") {
      mark.setAttribute("d", "M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9");
      mark.setAttribute("transform", `translate(${px(frame.X(driver.fixed_pivot[0]))} ${px(frame.Y(driver.fixed_pivot[1]))}) rotate(-90)`);
    } else if (driver.kind === "PR") {
      mark.setAttribute("d", "M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5");
      const along = Math.atan2(...((n) => [n[0], -n[1]])(normalOf(driver)));
      moves.push((place) => {
        const [x, y] = act(place, driver.moving_pivot);
        const off = 24;
        mark.setAttribute(
          "transform",
          `${moved(frame.X(x), frame.Y(y), along)} translate(0 ${-off})`,
        );
      });
    }
    group.append(mark, links, coupler, blocks, pins, letter);
    return { group, show: (place) => moves.forEach((move) => move(place)) };
  }

  show(place) {
    this.moving?.show(place);
  }
}

/** The convex hull of a few points. */
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
  const found = [...half(sorted), ...half(sorted.reverse())];
  return found.length ? found : sorted.slice(0, 1);
}

// -------------------------------------------------------------------------------------- plots

const LEFT = 62, RIGHT = 14;

/** Errors at the poses and the transmission angle, over the drive, with one cursor through all. */
class Plots {
  constructor(data, parent, scrub) {
    this.data = data;
    this.parent = parent;
    this.svg = s("svg", { class: "bm-plots", role: "img" });
    parent.append(this.svg);
    const go = (event) => {
      if (!this.way) return;
      const box = this.svg.getBoundingClientRect();
      const at = (event.clientX - box.left - LEFT) / (this.width - LEFT - RIGHT);
      scrub(frameAt(this.way.drive, this.low + clamp(at, 0, 1) * (this.high - this.low)));
    };
    this.svg.addEventListener("pointerdown", (event) => {
      this.svg.setPointerCapture(event.pointerId);
      go(event);
    });
    this.svg.addEventListener("pointermove", (event) => event.buttons & 1 && go(event));
  }

  build(linkage, index) {
    const { data, svg } = this, way = linkage.ways[index];
    this.way = way;
    svg.replaceChildren();
    this.cursor = null;
    if (!way) return;
    const width = (this.width = Math.max(260, this.parent.clientWidth));
    const tall = 84, gap = 28, top = 22;
    const height = top + 3 * tall + 2 * gap + 44;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.setAttribute("height", height);
    const slides = linkage.led[0].kind === "PR";
    this.low = way.drive[0];
    this.high = way.drive[way.drive.length - 1];
    const X = (drive) => LEFT + ((drive - this.low) / (this.high - this.low)) * (width - LEFT - RIGHT);
    this.X = X;
    const rows = linkage.pose_errors
      .map((row, k) => ({ ...row, name: data.poses[k].label }))
      .filter((row) => row.way === index)
      .map((row) => ({ ...row, drive: linear(way.drive, row.frame) }));
    const unit = data.unit ?? "unit of the poses";
    const panels = [
      { title: `position error (${unit})`, value: (row) => row.position },
      { title: "angle error (°)", value: (row) => row.turned_deg },
    ];
    const across = slides
      ? ticks(this.low, this.high, width / 90)
      : angleTicks(this.low, this.high, Math.max(3, width / 70));
    panels.forEach(({ title, value }, k) => {
      const y0 = top + k * (tall + gap), base = y0 + tall;
      const greatest = Math.max(1e-300, ...rows.map((row) => value(row) ?? 0));
      const digits = greatest > (k ? 1e-9 : 1e-11 * data.scene);
      const high = digits ? 1.15 * greatest : 1;
      const Y = (v) => base - (v / high) * tall;
      this.panel(title, y0, base, width, across, X);
      if (!digits) {
        svg.append(s("text", { class: "bm-note", x: LEFT + 8, y: y0 + tall / 2 }, rows.length ? "exact, up to rounding" : "no pose is on this assembly"));
      } else {
        for (const { at } of ticks(0, high, 3).slice(1)) {
          svg.append(
            s("path", { class: "bm-rule", d: `M${LEFT} ${px(Y(at))}H${width - RIGHT}` }),
            s("text", { class: "bm-tick", x: LEFT - 6, y: px(Y(at)) + 4, "text-anchor": "end" }, figure(at)),
          );
        }
        svg.append(s("text", { class: "bm-tick", x: LEFT - 6, y: base + 4, "text-anchor": "end" }, "0"));
      }
      let last = -99;
      const greatestFew = new Set([...rows].sort((a, b) => value(b) - value(a)).slice(0, 3));
      for (const row of [...rows].sort((a, b) => a.drive - b.drive)) {
        const x = px(X(row.drive)), y = px(digits ? Y(value(row)) : base);
        svg.append(
          s("path", { class: "bm-stem", d: `M${x} ${base}V${y}` }),
          s("circle", { class: "bm-dot", cx: x, cy: y, r: 3.5 }, s("title", {}, `pose ${row.name}: ${figure(value(row))}`)),
        );
        if (x - last > 6 + 6.5 * row.name.length && (rows.length <= 40 || greatestFew.has(row))) {
          svg.append(s("text", { class: "bm-dot-name", x, y: y - 7, "text-anchor": "middle" }, row.name));
          last = x;
        }
      }
    });
    const y0 = top + 2 * (tall + gap), base = y0 + tall;
    const Y = (v) => base - (v / 90) * tall;
    this.panel("transmission angle (°)", y0, base, width, across, X, true);
    for (const at of [0, 30, 60, 90]) {
      svg.append(
        s("path", { class: "bm-rule", d: `M${LEFT} ${px(Y(at))}H${width - RIGHT}` }),
        s("text", { class: "bm-tick", x: LEFT - 6, y: px(Y(at)) + 4, "text-anchor": "end" }, at),
      );
    }
    svg.append(
      s("path", { class: "bm-usual", d: `M${LEFT} ${px(Y(40))}H${width - RIGHT}` }),
      s("text", { class: "bm-tick", x: width - RIGHT - 4, y: px(Y(40)) - 4, "text-anchor": "end" }, "40°, a usual limit"),
    );
    let line = "", pen = "M";
    way.transmission.forEach((angle, k) => {
      if (angle === null) return;
      line += `${pen}${px(X(way.drive[k]))} ${px(Y(angle))}`;
      pen = "L";
    });
    svg.append(s("path", { class: "bm-line", d: line }));
    for (const row of rows) {
      if (row.transmission_deg === null) continue;
      svg.append(s("circle", { class: "bm-dot", cx: px(X(row.drive)), cy: px(Y(row.transmission_deg)), r: 3 }));
    }
    const what = slides ? `place of the driver ${linkage.led[0].id} along its line (${unit})` : `driver angle (${linkage.led[0].id})`;
    svg.append(s("text", { class: "bm-title", x: (LEFT + width - RIGHT) / 2, y: height - 6, "text-anchor": "middle" }, what));
    this.cursor = s("g", { class: "bm-cursor" }, s("path", { d: `M0 ${top}V${base}` }));
    this.mark = s("circle", { r: 4.5 });
    this.cursor.append(this.mark);
    this.Y = Y;
    svg.append(this.cursor);
  }

  panel(title, y0, base, width, across, X, labelled = false) {
    const { svg } = this;
    svg.append(
      s("rect", { class: "bm-panel", x: LEFT, y: y0, width: width - LEFT - RIGHT, height: base - y0 }),
      s("text", { class: "bm-title", x: LEFT, y: y0 - 7 }, title),
    );
    let last = -99;
    for (const { at, text } of across) {
      const x = px(X(at));
      svg.append(s("path", { class: "bm-rule", d: `M${x} ${y0}V${base}` }));
      if (labelled && x - last > 34) {
        svg.append(s("text", { class: "bm-tick", x, y: base + 15, "text-anchor": "middle" }, text));
        last = x;
      }
    }
  }

  show(drive, transmission) {
    if (!this.cursor) return;
    this.cursor.setAttribute("transform", `translate(${px(this.X(drive))} 0)`);
    if (transmission !== null) this.mark.setAttribute("cy", px(this.Y(transmission)));
  }
}

// ---------------------------------------------------------------------------------- pivot map

const BANDS = 12; // shades between the least and the greatest error

class PivotMap {
  constructor(data, parent) {
    this.data = data;
    this.parent = parent;
    this.canvas = h("canvas", { "aria-hidden": "true" });
    this.svg = s("svg", { role: "img" });
    this.readout = h("p", { class: "bm-readout" });
    this.legend = h("p", { class: "bm-legend" });
    parent.append(h("div", { class: "bm-map" }, this.canvas, this.svg), this.legend, this.readout);
    this.svg.addEventListener("pointermove", (event) => this.tell(event));
    this.svg.addEventListener("pointerleave", () => this.readout.replaceChildren(this.rest));
    const { log10_rms: levels } = data.pivot_map;
    const known = levels.filter((level) => level !== null).sort((a, b) => a - b);
    // A little of the least is a point; the picture is of what can be seen.
    const low = known[Math.floor(0.002 * known.length)], high = known[Math.floor(0.98 * known.length)];
    this.step = [1 / 24, 1 / 12, 1 / 6, 1 / 3, 1 / 2, 1, 2].find((step) => (high - low) / step < BANDS - 1) ?? 3;
    this.low = Math.floor(low / this.step) * this.step;
    this.high = Math.ceil(high / this.step) * this.step;
    this.count = Math.max(1, Math.round((this.high - this.low) / this.step));
    this.rest = "Point at the map to read it.";
    this.readout.append(this.rest);
  }

  /** The level at a pixel's place in the grid, between its four neighbours. */
  level(u, v) {
    const { columns, rows, log10_rms: levels } = this.data.pivot_map;
    const i = clamp(Math.floor(u), 0, columns - 2), j = clamp(Math.floor(v), 0, rows - 2);
    const a = u - i, b = v - j, at = j * columns + i;
    const [p, q, r, t] = [levels[at], levels[at + 1], levels[at + columns], levels[at + columns + 1]];
    if (p === null || q === null || r === null || t === null) return null;
    return (1 - b) * ((1 - a) * p + a * q) + b * ((1 - a) * r + a * t);
  }

  build(linkage) {
    const { data, canvas, svg } = this, map = data.pivot_map;
    const width = Math.max(240, this.parent.clientWidth);
    const height = Math.round((width * (map.high[1] - map.low[1])) / (map.high[0] - map.low[0]));
    const dense = Math.min(2, window.devicePixelRatio || 1);
    const style = getComputedStyle(this.parent);
    const near = rgb(style.getPropertyValue("--bm-map-near"));
    const far = rgb(style.getPropertyValue("--bm-map-far"));
    const w = Math.round(width * dense), t = Math.round(height * dense);
    if (canvas.width !== w || this.drawnIn !== near.join()) {
      this.drawnIn = near.join();
      canvas.width = w;
      canvas.height = t;
      const context = canvas.getContext("2d"), image = context.createImageData(w, t);
      const band = new Int16Array(w * t);
      for (let j = 0; j < t; j += 1) {
        for (let i = 0; i < w; i += 1) {
          const level = this.level((i / (w - 1)) * (map.columns - 1), (1 - j / (t - 1)) * (map.rows - 1));
          band[j * w + i] = level === null ? -1 : clamp(Math.floor((level - this.low) / this.step), 0, this.count - 1);
        }
      }
      for (let k = 0; k < w * t; k += 1) {
        const own = band[k];
        const edge = (k % w && band[k - 1] !== own) || (k >= w && band[k - w] !== own);
        const share = own < 0 ? 1 : own / Math.max(1, this.count - 1);
        const shade = edge ? 0.84 : 1;
        for (let c = 0; c < 3; c += 1) image.data[4 * k + c] = shade * (near[c] + share * (far[c] - near[c]));
        image.data[4 * k + 3] = 255;
      }
      context.putImageData(image, 0, 0);
    }
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    svg.replaceChildren();
    const scale = width / (map.high[0] - map.low[0]);
    const frame = { width, height, X: (x) => (x - map.low[0]) * scale, Y: (y) => height - (y - map.low[1]) * scale };
    this.frame = { ...frame, scale };
    const labels = new Labels(frame);
    for (const pose of data.poses) {
      const x = px(frame.X(pose.x)), y = px(frame.Y(pose.y));
      svg.append(s("path", { class: "bm-cross", d: `M${x - 3} ${y}h6M${x} ${y - 3}v6` }));
    }
    const others = new Map();
    for (const each of data.linkages) for (const dyad of each.led) if (dyad.fixed_pivot) others.set(dyad.fixed_pivot.join(), dyad);
    for (const dyad of data.dyads) if (dyad.fixed_pivot) others.set(dyad.fixed_pivot.join(), dyad);
    const inside = ([x, y]) => x >= map.low[0] && x <= map.high[0] && y >= map.low[1] && y <= map.high[1];
    for (const dyad of others.values()) {
      if (!inside(dyad.fixed_pivot)) continue;
      const [x, y] = [frame.X(dyad.fixed_pivot[0]), frame.Y(dyad.fixed_pivot[1])];
      svg.append(s("circle", { class: "bm-some-pivot", cx: px(x), cy: px(y), r: 2.5 }));
    }
    const said = [];
    (linkage?.led ?? []).forEach((dyad, side) => {
      if (!dyad.fixed_pivot) return;
      if (!inside(dyad.fixed_pivot)) {
        said.push(`the fixed pivot of ${dyad.id} lies outside`);
        return;
      }
      const [x, y] = [frame.X(dyad.fixed_pivot[0]), frame.Y(dyad.fixed_pivot[1])];
      labels.block(x, y, 12, 12);
      svg.append(
        s("circle", { class: `bm-its-pivot bm-side${side}`, cx: px(x), cy: px(y), r: 6 }),
        labels.put(x, y, dyad.id, 16, { class: "bm-map-name" }),
      );
    });
    const unit = data.unit ? ` ${data.unit}` : "";
    this.legend.replaceChildren(
      h("span", { class: "bm-swatch bm-near" }),
      ` ${figure(10 ** this.low)}${unit} or less`,
      h("span", { class: "bm-swatch bm-far" }),
      ` ${figure(10 ** this.high)}${unit} or more; each line is a factor of ${figure(10 ** this.step)}. `,
      "Small dots: fixed pivots of all dyads; crosses: the poses.",
      said.length ? ` Of this linkage, ${listed(said)}.` : "",
    );
  }

  tell(event) {
    const box = this.svg.getBoundingClientRect(), map = this.data.pivot_map;
    const x = map.low[0] + ((event.clientX - box.left) / box.width) * (map.high[0] - map.low[0]);
    const y = map.high[1] - ((event.clientY - box.top) / box.height) * (map.high[1] - map.low[1]);
    const level = this.level(
      ((x - map.low[0]) / (map.high[0] - map.low[0])) * (map.columns - 1),
      ((y - map.low[1]) / (map.high[1] - map.low[1])) * (map.rows - 1),
    );
    const digits = Math.max(0, 2 - Math.floor(Math.log10(this.data.scene)));
    const unit = this.data.unit ? ` ${this.data.unit}` : "";
    this.readout.textContent =
      `Fixed pivot (${fixed(x, digits)}, ${fixed(y, digits)}): the best link misses by ` +
      (level === null ? "an unknown error." : `${figure(10 ** level)}${unit} (rms).`);
  }
}

function rgb(text) {
  const hex = text.trim().replace("#", "");
  return [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));
}

// -------------------------------------------------------------------------------- image space

const FIELD = 2.3; // of the lens: the larger, the flatter
const AWAY = 4.6; // from the middle of the box
const STILL = 250, QUICK = 25; // milliseconds that a picture may take, at rest and while it turns

const VERTEX = `#version 300 es
in vec2 corner;
out vec2 at;
void main() { at = corner; gl_Position = vec4(corner, 0.0, 1.0); }`;

// Exact: every pixel's ray meets each quadric where a quadratic equation says.
const FRAGMENT = `#version 300 es
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

vec4 seen(vec2 xy) {
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
  if (samples == 1) { colour = seen(at); return; }
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 4; k++) {
    vec2 part = vec2(k % 2 == 0 ? -0.5 : 0.5, k < 2 ? -0.5 : 0.5);
    sum += seen(at + part * pixel);
  }
  colour = sum / 4.0;
}`;

const dot3 = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const scaled = (a, k) => [a[0] * k, a[1] * k, a[2] * k];
const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit3 = (a) => scaled(a, 1 / Math.hypot(...a));

/** c times (p, w), a row-by-row symmetric 4 x 4 matrix. */
const times = (c, p, w) =>
  [0, 4, 8, 12].map((r) => c[r] * p[0] + c[r + 1] * p[1] + c[r + 2] * p[2] + c[r + 3] * w);

/** Where the line o + t d meets a quadric: as in the shader. */
function meets(c, o, d) {
  const cd = times(c, d, 0), co = times(c, o, 1);
  const a = dot3(d, cd), b = dot3(o, cd) + cd[3], e = dot3(o, co) + co[3];
  const root = b * b - a * e;
  if (root < 0) return [];
  const q = -(b + (b < 0 ? -1 : 1) * Math.sqrt(root));
  const found = [];
  if (Math.abs(a) > 1e-12 * Math.abs(q)) found.push(q / a);
  if (q !== 0) found.push(e / q);
  return found;
}

/** Whether WebGL 2 is drawn by hardware: where it is not, rays cast in `cast` hold nothing up. */
function hasGraphics() {
  const gl = document.createElement("canvas").getContext("webgl2", { failIfMajorPerformanceCaveat: true });
  const named = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = named ? gl.getParameter(named.UNMASKED_RENDERER_WEBGL) : "";
  return Boolean(gl) && !/swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/** What the shader does, for every pixel of an image: numbers only, nothing is made in the loop. */
function cast(image, { eye, ahead, right, up, reach, quadrics, paint, angles }) {
  const { data, width, height } = image, [ex, ey, ez] = eye, [zc, zh, middleAngle, step] = angles;
  const lamp = unit3(plus(plus(scaled(ahead, -1), scaled(up, 0.5)), scaled(right, -0.6)));
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
        const e =
          ox * (c[0] * ox + 2 * (c[1] * oy + c[2] * oz + c[3])) + oy * (c[5] * oy + 2 * (c[6] * oz + c[7])) +
          oz * (c[10] * oz + 2 * c[11]) + c[15];
        const root = b * b - a * e;
        if (root < 0) continue;
        const q = -(b + (b < 0 ? -1 : 1) * Math.sqrt(root));
        for (let side = 0; side < 2; side += 1) {
          const t = side ? e / q : q / a;
          if (!(Math.abs(t) <= half)) continue;
          let at = count;
          while (at > 0 && far[at - 1] > t) {
            far[at] = far[at - 1];
            which[at] = which[at - 1];
            at -= 1;
          }
          far[at] = t;
          which[at] = k;
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
        const pixels = (((middle + t) * reach[1]) / height) * (Math.sqrt(Math.max(0, 1 - nz * nz)) / Math.max(facing, 0.15)) + 1e-4;
        const z3 = zc + zh * z, turns = (2 * Math.atan(z3) + middleAngle) / step;
        const off = (Math.abs(turns - Math.round(turns)) * step * (1 + z3 * z3)) / (2 * zh);
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

class Space {
  constructor(data, parent, webgl) {
    this.data = data;
    this.parent = parent;
    this.turn = { around: -0.62, above: 0.38, zoom: 1 };
    this.canvas = h("canvas", { "aria-hidden": "true" });
    this.svg = s("svg", { "aria-hidden": "true" });
    this.note = h("p", { class: "bm-readout" });
    this.box = h("div", {
      class: "bm-space", role: "img", tabindex: "0",
      "aria-label": "Image space: two surfaces and the curve they meet in. Arrow keys turn it, plus and minus zoom.",
    }, this.canvas, this.svg);
    parent.append(this.box, this.note);
    this.gl = webgl ? this.started() : null;
    this.say();
    this.listen();
  }

  say() {
    this.canvas.dataset.drawn = this.gl ? "webgl" : "still";
    this.note.textContent = this.gl
      ? "Drag it, or turn it with the arrow keys; + and − zoom, 0 goes back."
      : "A still picture, for fast WebGL 2 is missing here; it can be turned all the same, by dragging or with the arrow keys.";
  }

  /** Go on without WebGL.  A canvas that has once held it holds nothing else. */
  withoutGl() {
    const fresh = this.canvas.cloneNode();
    this.canvas.replaceWith(fresh);
    this.canvas = fresh;
    this.gl = null;
    this.say();
  }

  started() {
    if (!hasGraphics()) return null;
    const gl = this.canvas.getContext("webgl2", { antialias: false, premultipliedAlpha: true, preserveDrawingBuffer: true });
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
      this.withoutGl();
      return null;
    }
    this.canvas.addEventListener("webglcontextlost", () => {
      if (this.gl !== gl) return;
      this.withoutGl();
      if (this.space) this.draw(false);
    });
    gl.useProgram(program);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
    const corner = gl.getAttribLocation(program, "corner");
    gl.enableVertexAttribArray(corner);
    gl.vertexAttribPointer(corner, 2, gl.FLOAT, false, 0, 0);
    this.places = {};
    for (const name of ["surface", "paint", "eye", "right", "up", "ahead", "reach", "pixel", "samples", "angles"]) {
      this.places[name] = gl.getUniformLocation(program, name);
    }
    return gl;
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
      this.turn.around -= 0.008 * (event.clientX - grip[0]);
      this.turn.above += 0.008 * (event.clientY - grip[1]);
      grip = [event.clientX, event.clientY];
      this.turned(true);
    });
    for (const end of ["pointerup", "pointercancel"]) {
      box.addEventListener(end, () => {
        if (grip) this.turned(false);
        grip = null;
      });
    }
    box.addEventListener("keydown", (event) => {
      const { turn } = this;
      const step = {
        ArrowLeft: () => (turn.around += 0.1),
        ArrowRight: () => (turn.around -= 0.1),
        ArrowUp: () => (turn.above += 0.1),
        ArrowDown: () => (turn.above -= 0.1),
        "+": () => (turn.zoom *= 1.15),
        "=": () => (turn.zoom *= 1.15),
        "-": () => (turn.zoom /= 1.15),
        0: () => Object.assign(turn, { around: -0.62, above: 0.38, zoom: 1 }),
      }[event.key];
      if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      step();
      this.turned(false);
    });
  }

  turned(fast) {
    this.turn.above = clamp(this.turn.above, -1.5, 1.5);
    this.turn.zoom = clamp(this.turn.zoom, 0.6, 4);
    cancelAnimationFrame(this.waiting);
    this.waiting = requestAnimationFrame(() => this.draw(fast));
  }

  /** The point of the box where a displacement is. */
  point(place) {
    const { chart } = this.data, { centre, half } = this.space;
    const x = (place.x - chart.origin[0]) / chart.length, y = (place.y - chart.origin[1]) / chart.length;
    const t = Math.tan((place.a - chart.angle) / 2);
    return [(x * t - y) / 2, (x + y * t) / 2, t].map((value, k) => (value - centre[k]) / half[k]);
  }

  build(linkage, index) {
    this.linkage = linkage;
    this.space = linkage?.space ?? this.data.space;
    this.poses = this.data.poses.map((pose) => this.point({ x: pose.x, y: pose.y, a: (pose.angle_deg * Math.PI) / 180 }));
    this.curves = (linkage?.ways ?? []).map((way, k) => ({
      here: k === index,
      points: way.x.map((x, i) => this.point({ x, y: way.y[i], a: way.angle[i] })),
    }));
    const { centre, half } = this.space;
    const angleOf = (q) => degrees(2 * Math.atan(centre[2] + half[2] * q) + this.data.chart.angle);
    this.marks = angleTicks(angleOf(-1), angleOf(1), 7);
    const width = Math.max(240, this.parent.clientWidth);
    this.width = width;
    this.height = Math.round(clamp(0.8 * width, 240, 520));
    this.svg.setAttribute("viewBox", `0 0 ${width} ${this.height}`);
    this.box.style.height = `${this.height}px`;
    this.draw(false);
  }

  camera() {
    const { around, above, zoom } = this.turn;
    const ahead = [
      -Math.cos(above) * Math.sin(around), Math.cos(above) * Math.cos(around), -Math.sin(above),
    ];
    const right = [Math.cos(around), Math.sin(around), 0];
    const up = cross(right, ahead);
    const eye = scaled(ahead, -AWAY);
    const least = Math.min(this.width, this.height);
    const focal = (least / 2) * FIELD * zoom * 1.02;
    return { ahead, right, up, eye, focal, reach: [this.width / 2 / focal, this.height / 2 / focal] };
  }

  draw(fast) {
    const camera = (this.view = this.camera());
    const style = getComputedStyle(this.parent);
    const paint = ["--bm-driver-solid", "--bm-follower-solid"].map((name) => rgb(style.getPropertyValue(name)).map((v) => v / 255));
    const quadrics = this.space.quadrics;
    if (this.gl) this.drawWithGl(camera, paint, quadrics, fast);
    else this.drawWithout(camera, paint, quadrics, fast);
    this.overlay(camera);
    if (this.place) this.show(this.place);
  }

  drawWithGl(camera, paint, quadrics, fast) {
    const { gl, canvas, places } = this;
    gl.clearColor(0, 0, 0, 0);
    if (!quadrics.length) {
      gl.clear(gl.COLOR_BUFFER_BIT);
      return;
    }
    gl.uniformMatrix4fv(places.surface, false, new Float32Array(quadrics.flat()));
    gl.uniform3fv(places.paint, new Float32Array(paint.flat()));
    for (const name of ["eye", "right", "up", "ahead"]) gl.uniform3fv(places[name], camera[name]);
    gl.uniform2fv(places.reach, camera.reach);
    gl.uniform4fv(places.angles, this.angles());
    const once = (dense, samples) => {
      const width = Math.round(this.width * dense), height = Math.round(this.height * dense);
      if (canvas.width !== width || canvas.height !== height) {
        canvas.width = width;
        canvas.height = height;
      }
      gl.viewport(0, 0, width, height);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.uniform2f(places.pixel, 1 / width, 1 / height);
      gl.uniform1i(places.samples, samples);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    };
    if (this.pace === undefined) {
      // How long a ray takes here: where graphics are software, the picture gets fewer of them.
      once(0.12, 1); // the first one is compiled, too
      gl.finish();
      const start = performance.now();
      once(0.3, 1);
      gl.finish();
      this.pace = (performance.now() - start) / (0.09 * this.width * this.height);
    }
    const full = Math.min(2, window.devicePixelRatio || 1), most = fast ? QUICK : STILL;
    const ways = fast ? [[1, 1], [0.7, 1], [0.45, 1]] : [[full, 4], [1, 4], [full, 1], [1, 1], [0.7, 1]];
    const fits = ways.find(([dense, samples]) => dense * dense * samples * this.pace * this.width * this.height < most);
    once(...(fits ?? ways[ways.length - 1]));
  }

  /** The same picture without WebGL, ray by ray. */
  drawWithout(camera, paint, quadrics, fast) {
    const { canvas } = this;
    const share = fast ? 0.35 : Math.min(1, 440 / this.width);
    const width = Math.round(this.width * share), height = Math.round(this.height * share);
    canvas.width = width;
    canvas.height = height;
    if (!quadrics.length) return;
    const context = canvas.getContext("2d"), image = context.createImageData(width, height);
    cast(image, { ...camera, quadrics, paint, angles: this.angles() });
    context.putImageData(image, 0, 0);
  }

  /** Of M: Z3 in the middle of the box and half its height, middle angle, step of the lines. */
  angles() {
    const { centre, half } = this.space, { marks } = this;
    const step = marks.length > 1 ? ((marks[1].at - marks[0].at) * Math.PI) / 180 : Math.PI;
    return [centre[2], half[2], this.data.chart.angle, step];
  }

  /** From the box to pixels. */
  seen(point) {
    const { eye, ahead, right, up, focal } = this.view;
    const to = [0, 1, 2].map((k) => point[k] - eye[k]), depth = dot3(to, ahead);
    return [this.width / 2 + (focal * dot3(to, right)) / depth, this.height / 2 - (focal * dot3(to, up)) / depth];
  }

  /** How many sheets of the surfaces are between a point and the eye. */
  layers(point) {
    const to = plus(this.view.eye, scaled(point, -1)), d = unit3(to);
    let leave = Infinity;
    for (let k = 0; k < 3; k += 1) leave = Math.min(leave, ((d[k] > 0 ? 1 : -1) - point[k]) / d[k]);
    let count = 0;
    for (const c of this.space.quadrics) for (const t of meets(c, point, d)) if (t > 0.02 && t < leave) count += 1;
    return count;
  }

  overlay() {
    const { svg, data } = this;
    const inside = (p) => p.every((value) => Math.abs(value) <= 1.0001);
    svg.replaceChildren();
    // Edges of the box; those at the farthest corner are behind everything.
    const back = this.view.ahead.map((value) => (value > 0 ? 1 : -1));
    let front = "", behind = "";
    for (let axis = 0; axis < 3; axis += 1) {
      for (const [b, c] of [[-1, -1], [-1, 1], [1, -1], [1, 1]]) {
        const one = [0, 0, 0], [j, k] = [(axis + 1) % 3, (axis + 2) % 3];
        [one[j], one[k], one[axis]] = [b, c, -1];
        const other = [...one];
        other[axis] = 1;
        const d = `M${this.seen(one).map(px).join(" ")}L${this.seen(other).map(px).join(" ")}`;
        if (b === back[j] && c === back[k]) behind += d;
        else front += d;
      }
    }
    svg.append(s("path", { class: "bm-box bm-behind", d: behind }), s("path", { class: "bm-box", d: front }));
    // Names at the middle of edges that are in sight.
    const name = (point, text) => {
      const [x, y] = this.seen(point), [cx, cy] = [x - this.width / 2, y - this.height / 2];
      const size = Math.hypot(cx, cy) || 1;
      return s("text", { class: "bm-axis", x: px(x + (14 * cx) / size), y: px(y + (14 * cy) / size + 4), "text-anchor": "middle" }, text);
    };
    svg.append(
      name([0, -back[1], this.turn.above >= 0 ? -1 : 1], "Z1"),
      name([-back[0], 0, this.turn.above >= 0 ? -1 : 1], "Z2"),
    );
    // The third coordinate says the angle.
    const upright = [[-1, -1], [-1, 1], [1, -1], [1, 1]].map(([a, b]) => ({ a, b, x: this.seen([a, b, 0])[0] }));
    const edge = upright.reduce((one, other) => (other.x < one.x ? other : one));
    const { centre, half } = this.space;
    for (const { at, text } of this.marks) {
      const t = Math.tan(((at * Math.PI) / 180 - data.chart.angle) / 2), q = (t - centre[2]) / half[2];
      const [x, y] = this.seen([edge.a, edge.b, q]);
      svg.append(
        s("path", { class: "bm-box", d: `M${px(x)} ${px(y)}h-5` }),
        s("text", { class: "bm-axis", x: px(x - 8), y: px(y + 4), "text-anchor": "end" }, text),
      );
    }
    for (const { here, points } of this.curves) {
      const paths = ["", ""];
      let last = null;
      for (let k = 0; k < points.length; k += 1) {
        const p = points[k];
        if (!inside(p) || (k && Math.hypot(...plus(p, scaled(points[k - 1], -1))) > 0.6)) last = null;
        if (!inside(p)) continue;
        const at = this.seen(p), hidden = this.layers(p) > 0 ? 1 : 0;
        if (last) paths[hidden] += `M${last.map(px).join(" ")}L${at.map(px).join(" ")}`;
        last = at;
      }
      const kind = here ? "bm-here" : "bm-other";
      svg.append(
        s("path", { class: `bm-motion bm-hidden ${kind}`, d: paths[1] }),
        s("path", { class: `bm-motion ${kind}`, d: paths[0] }),
      );
    }
    const labels = new Labels({ width: this.width, height: this.height });
    const shown = this.poses.map((point, k) => ({ point, k })).filter(({ point }) => inside(point));
    for (const { point } of shown) labels.block(...this.seen(point), 10, 10);
    for (const { point, k } of shown) {
      const [x, y] = this.seen(point), hidden = this.layers(point) > 0;
      svg.append(s("circle", { class: `bm-image-point${hidden ? " bm-hidden" : ""}`, cx: px(x), cy: px(y), r: 4 }));
      if (shown.length <= 40) svg.append(labels.put(x, y, data.poses[k].label, 12, { class: "bm-image-name" }));
    }
    this.runner = s("circle", { class: "bm-runner", r: 6, visibility: "hidden" });
    svg.append(this.runner);
  }

  show(place) {
    this.place = place;
    const point = this.point(place);
    const inside = point.every((value) => Math.abs(value) <= 1.02);
    this.runner.setAttribute("visibility", inside ? "visible" : "hidden");
    if (!inside) return;
    const [x, y] = this.seen(point);
    this.runner.setAttribute("transform", `translate(${px(x)} ${px(y)})`);
  }
}

// ------------------------------------------------------------------------------------- tables

function table(caption, heads, rows, attributes) {
  return h(
    "div",
    { class: "bm-scroll", tabindex: "0", role: "region", "aria-label": caption },
    h(
      "table",
      attributes,
      h("caption", {}, caption),
      h("thead", {}, h("tr", {}, heads.map((head) => h("th", { scope: "col", class: head.text ? "bm-words" : null }, head.name ?? head)))),
      h("tbody", {}, rows),
    ),
  );
}

const cells = (values, words = []) =>
  values.map((value, k) =>
    k === 0
      ? h("th", { scope: "row" }, value)
      : h("td", { class: words.includes(k) ? "bm-words" : null }, value ?? "–"),
  );

const unitOf = (data) => (data.unit ? ` (${data.unit})` : "");

/** How many decimals positions get: down to a thousandth of a share of the scene. */
const decimalsOf = (data) => clamp(4 - Math.ceil(Math.log10(data.scene)), 0, 12);

/** A position error and an angle error, as one. */
function missOf(position, angle, unit) {
  if (position === "exact" && angle === "exact") return "exact";
  if (position === "-") return "–";
  return `${position}${position === "exact" ? "" : unit} and ${angle}`;
}

function verdictOf(linkage) {
  return linkage.usable ? "✓ usable" : "✕ not usable";
}

function dyadTable(data) {
  const heads = ["", { name: "kind", text: true }, "on the ground (F)", "on the body (M)", `length${unitOf(data)}`, "rms miss", "worst miss"];
  const rows = data.dyads.map((dyad) =>
    h("tr", {}, cells([dyad.id, dyad.kind, dyad.said.ground, dyad.said.body, dyad.said.length, dyad.said.rms, dyad.said.worst], [1])),
  );
  return table("Dyads", heads, rows);
}

function linkageTable(data) {
  const names = ["ground", "driver", "coupler", "follower"];
  const heads = [
    "", { name: "verdict", text: true }, { name: "type", text: true }, { name: "dyads", text: true }, { name: "driver", text: true }, ...names.map((name) => `${name} link`),
    "worst miss", "worst angle", "least transm.", { name: "why not", text: true },
  ];
  const rows = data.linkages.map((each) =>
    h(
      "tr",
      {},
      cells(
        [
          each.id, verdictOf(each), each.type, each.dyads.map((dyad) => dyad.id).join(" "), each.led[0].id,
          ...names.map((name) => each.said.links?.[name] ?? "–"),
          each.said.worst, each.said.angle, each.said.transmission, each.said.reasons.join("; ") || "–",
        ],
        [1, 2, 3, 4, 12],
      ),
    ),
  );
  return table(`All linkages${unitOf(data)}`, heads, rows, { class: "bm-linkages" });
}

function dimensionRows(linkage) {
  const some = linkage.said.dimensions.some((row) => row.give);
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
      some ? h("td", {}, row.give) : null,
    );
  });
}

function dimensionTable(data, linkage) {
  return table(
    `Dimensions of ${linkage.id}${data.unit ? `, in ${data.unit}` : ""}`,
    ["", { name: "", text: true }, "value", ...(linkage.said.dimensions.some((row) => row.give) ? ["± (95 %)"] : [])],
    dimensionRows(linkage),
    { class: "bm-dimensions" },
  );
}

function poseTable(data, linkage) {
  const digits = decimalsOf(data), unit = unitOf(data);
  const heads = ["pose", `wanted x`, `y${unit}`, "angle"];
  if (linkage) heads.push("coupler x", `y${unit}`, "angle", "off by", "turned by", "transm.", { name: "where", text: true });
  const rows = data.poses.map((pose, k) => {
    const values = [
      (pose.label === pose.name ? "" : `${pose.label}: `) + pose.name + (pose.exact ? " (exact)" : ""), fixed(pose.x, digits), fixed(pose.y, digits), `${fixed(pose.angle_deg, 2)}°`,
    ];
    if (linkage) {
      const row = linkage.pose_errors[k];
      values.push(
        fixed(row.x, digits), fixed(row.y, digits), row.angle_deg === null ? "–" : `${fixed(row.angle_deg, 2)}°`,
        row.said.position, row.said.turned, row.said.transmission,
        row.way === null ? "–" : wayName(linkage.ways[row.way], linkage),
      );
    }
    return h("tr", { "data-pose": k + 1 }, cells(values, [10]));
  });
  return table(linkage ? `Poses, and where ${linkage.id} takes the body` : "Poses", heads, rows, { class: "bm-pose-table" });
}

/** The image points of the poses, Z3² + Z4² = 1, and the manifolds' eight coefficients. */
function imageTables(data, linkage) {
  const digits = decimalsOf(data);
  const rows = data.poses.map((pose) => {
    const c = Math.cos((pose.angle_deg * Math.PI) / 360), d = Math.sin((pose.angle_deg * Math.PI) / 360);
    const z = [(pose.x * d - pose.y * c) / 2, (pose.x * c + pose.y * d) / 2, d, c];
    return h("tr", {}, cells([pose.label, ...z.map((value, k) => fixed(value, k < 2 ? digits : 5))]));
  });
  const points = table(`Image points of the poses${unitOf(data)}, Z3² + Z4² = 1`, ["pose", "Z1", "Z2", "Z3", "Z4"], rows);
  if (!linkage) return [points];
  const surfaces = linkage.led.map((dyad, k) => h("tr", {}, cells([dyad.id, ...linkage.said.manifolds[k]])));
  const heads = ["", ...[1, 2, 3, 4, 5, 6, 7, 8].map((k) => `p${k}`)];
  const caption = "Surfaces: p1 (Z1² + Z2²) + p2 Z3² + p3 Z1 Z3 + p4 Z2 Z3 + p5 Z1 Z4 + p6 Z2 Z4 + p7 Z3 Z4 + p8 Z4² = 0";
  return [points, table(caption, heads, surfaces)];
}

/** What a way is called: only as much as tells it from the others. */
function wayName(way, linkage) {
  const circuits = new Set(linkage.ways.map((each) => each.circuit)).size;
  const parts = [];
  if (circuits > 1 || way.branches < 2) parts.push(`assembly ${way.circuit}`);
  if (way.branches > 1) parts.push(`branch ${way.branch}`);
  return parts.join(", ");
}

// ---------------------------------------------------------------------------------- the report

class Report {
  constructor(data, el, options) {
    this.data = data;
    this.el = el;
    this.options = options;
    this.chosen = 0;
    this.way = 0;
    this.u = 0;
    this.heading = 1; // or -1, on the way back
    this.playing = false;
    this.near = -1;
    this.cleanups = [];
    // Long names would hide what they name: drawings then have numbers, and tables both.
    const short = data.poses.every((pose) => pose.name.length <= 5);
    data.poses.forEach((pose, k) => (pose.label = short ? pose.name : String(k + 1)));
    this.links = data.linkages.map((linkage) => ({
      ...linkage,
      pose_errors: linkage.pose_errors.map((row) => ({ ...row, at: row.way === null ? null : linkage.ways[row.way] })),
    }));
    el.replaceChildren();
    this.root = h("div", { class: "bm" });
    el.append(this.root);
    this.frame();
    if (this.links.length) this.choose(0);
    else this.rebuild();
    this.listen();
  }

  get linkage() {
    return this.links[this.chosen];
  }

  get path() {
    return this.linkage?.ways[this.way];
  }

  frame() {
    const { data } = this;
    const section = (name, title, ...content) =>
      h("section", { class: `bm-card bm-${name}`, "aria-label": title }, h("h2", {}, title), ...content);
    this.root.append(this.head());
    const body = h("div", { class: "bm-body" });
    this.root.append(body);
    if (this.links.length) body.append(this.list());
    const main = h("div", { class: "bm-main" });
    body.append(main);

    const drawing = h("div", { class: "bm-drawing" });
    this.plane = new Plane(data, drawing);
    this.stageTitle = h("h2", { class: "bm-stage-title" }, "The poses");
    this.story = h("p", { class: "bm-story" });
    const stage = h("section", { class: "bm-card bm-stage", "aria-label": "The linkage moving" }, this.stageTitle, this.story);
    if (this.links.length) stage.append(this.assemblies());
    if (this.links.length) stage.append(this.controls());
    stage.append(drawing, h("div", { class: "bm-under" }, this.key(), this.links.length ? this.enlarged() : null));
    main.append(stage);

    if (this.links.length) {
      this.numbers = section("numbers", "Numbers", h("div", { class: "bm-fill" }));
      const plots = section("plotted", "Errors and transmission", h("div", { class: "bm-fill" }));
      this.aside = h("div", { class: "bm-aside" }, this.numbers, plots);
      main.append(this.aside);
      this.plots = new Plots(data, plots.querySelector(".bm-fill"), (u) => this.go(u));
    }
    const space = section("image", "Image space", h("p", { class: "bm-story" }), h("div", { class: "bm-fill" }));
    main.append(space);
    this.spaceNumbers = h("details", { class: "bm-every" }, h("summary", {}, "In numbers"));
    space.append(this.spaceNumbers);
    this.spaceStory = space.querySelector("p");
    this.space = new Space(data, space.querySelector(".bm-fill"), this.options.webgl !== false);
    if (data.pivot_map) {
      const map = section(
        "pivots", "Where to put a fixed pivot",
        h("p", { class: "bm-story" }, "How well the best link with its fixed pivot at a place meets the poses: the stronger the colour, the better."),
        h("div", { class: "bm-fill" }),
      );
      main.append(map);
      this.map = new PivotMap(data, map.querySelector(".bm-fill"));
    }
    this.poseBox = section("pose-box", "Pose by pose", h("div", {}));
    main.append(this.poseBox);
    if (this.links.length) main.append(section("all", "All linkages", linkageTable(data), this.everyDimension()));
    if (data.dyads.length) main.append(section("dyads", "Dyads", dyadTable(data)));
    this.root.append(
      h("footer", { class: "bm-foot-notes" }, data.footnotes, " RR: a link with two pins; PR: a slider on the ground; RP: a pin on the ground in a slot of the body."),
    );
  }

  head() {
    const { data } = this, { outcome } = data;
    const good = this.links.some((each) => each.usable);
    const open = /^R(303|31)/.test(outcome.code); // nothing went wrong: there is no one answer
    const head = h(
      "header",
      { class: "bm-head" },
      h("p", { class: "bm-overline" }, "burmester · linkage report"),
      data.title ? h("h1", {}, data.title) : null,
      h(
        "p",
        { class: `bm-outcome ${good ? "bm-good" : open ? "bm-open" : "bm-bad"}` },
        h("span", { class: "bm-sign", "aria-hidden": "true" }, good ? "✓" : open ? "i" : "✕"),
        h("span", {}, `${outcome.message[0].toUpperCase()}${outcome.message.slice(1)}. `, h("span", { class: "bm-code" }, outcome.code)),
      ),
      data.best.map((sentence) => h("p", { class: "bm-best" }, sentence)),
    );
    if (outcome.why) head.append(h("p", { class: "bm-why" }, h("b", {}, "Why: "), outcome.why, "."));
    if (outcome.help) head.append(h("p", { class: "bm-why" }, h("b", {}, "What helps: "), outcome.help, "."));
    if (data.warnings.length) {
      head.append(
        h(
          "ul",
          { class: "bm-warnings", "aria-label": "Warnings" },
          data.warnings.map((each) =>
            h(
              "li",
              {},
              h("p", {}, h("b", {}, "! Warning "), h("span", { class: "bm-code" }, each.code), ` ${each.message}.`),
              each.why ? h("p", { class: "bm-why" }, h("b", {}, "Why: "), each.why, ".") : null,
              each.help ? h("p", { class: "bm-why" }, h("b", {}, "What helps: "), each.help, ".") : null,
            ),
          ),
        ),
      );
    }
    return head;
  }

  list() {
    const { data } = this;
    this.cards = this.links.map((each, k) => {
      const { said } = each, unit = data.unit ? ` ${data.unit}` : "";
      const fact = (name, value) => [h("dt", {}, name), h("dd", {}, value)];
      const links = said.links ? Object.entries(said.links) : [];
      return h(
        "button",
        { type: "button", class: `bm-choice ${each.usable ? "bm-good" : "bm-bad"}`, "aria-pressed": "false", "data-linkage": each.id, onclick: () => this.choose(k) },
        h("span", { class: "bm-choice-head" }, h("b", {}, each.id), " ", h("span", { class: "bm-type" }, each.type)),
        h("span", { class: "bm-verdict" }, verdictOf(each)),
        h(
          "dl",
          {},
          fact("worst miss", missOf(said.worst, said.angle, unit).replace(" and ", ", ")),
          fact("transmission", said.transmission === "-" ? "–" : said.transmission === "0°" ? "down to 0°" : `${said.transmission} or more`),
          fact("driver", `${each.led[0].id}${said.turns_fully ? ", turns fully" : ""}`),
          links.length ? fact("links", links.map(([, value]) => value).join(" · ")) : fact("dyads", each.dyads.map((dyad) => `${dyad.id} (${dyad.kind})`).join(" · ")),
        ),
        said.reasons.length ? h("span", { class: "bm-reason" }, said.reasons.join("; ")) : null,
      );
    });
    const box = h("nav", { class: "bm-list", "aria-label": "Linkages, best first" }, h("h2", {}, `${this.links.length} linkage${this.links.length === 1 ? "" : "s"}`), h("div", { class: "bm-choices" }, this.cards));
    box.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
      const at = this.cards.indexOf(document.activeElement);
      if (!step || at < 0) return;
      event.preventDefault();
      this.cards[clamp(at + step, 0, this.cards.length - 1)].focus();
    });
    return box;
  }

  assemblies() {
    this.ways = h("fieldset", { class: "bm-ways" });
    return this.ways;
  }

  controls() {
    const button = (name, text, label, onclick) => h("button", { type: "button", class: `bm-button ${name}`, "aria-label": label, title: label, onclick }, text);
    this.playButton = button("bm-play", "", "Play", () => this.play(!this.playing));
    this.slider = h("input", { type: "range", class: "bm-slider", min: 0, step: "any", "aria-label": "Driver", oninput: () => this.go(Number(this.slider.value)) });
    this.stops = s("svg", { class: "bm-stops", "aria-hidden": "true" });
    this.said = ["", "", "", ""].map((text) => h("span", {}, text));
    this.readout = h("output", { class: "bm-now" }, this.said.flatMap((part, k) => (k ? [" ", part] : [part])));
    this.slider.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
      if (!step) return;
      event.preventDefault();
      this.step(event.shiftKey ? 10 * step : step);
    });
    return h(
      "div",
      { class: "bm-controls" },
      h(
        "div",
        { class: "bm-row" },
        this.playButton,
        button("bm-back", "◀ Pose", "Previous pose", () => this.toPose(-1)),
        button("bm-next", "Pose ▶", "Next pose", () => this.toPose(1)),
        h("div", { class: "bm-track" }, this.slider, this.stops),
      ),
      this.readout,
    );
  }

  enlarged() {
    this.factorBox = h(
      "select",
      { onchange: () => { this.factor = Number(this.factorBox.value); this.draw(); } },
      FACTORS.map((factor) => h("option", { value: factor }, factor ? `× ${factor.toLocaleString("en").replaceAll(",", " ")}` : "not drawn")),
    );
    return h("label", { class: "bm-factor" }, "Error arrows ", this.factorBox);
  }

  key() {
    const one = (kind, text) => h("li", {}, s("svg", { width: 34, height: 20, viewBox: "-4 -13 34 20", "aria-hidden": "true", class: "bm-key" }, kind), text);
    const items = [one(s("g", { class: "bm-wanted" }, s("path", { d: axes(22) }), s("circle", { r: 4 })), "wanted pose")];
    if (this.links.length) {
      items.push(
        one(s("g", { class: "bm-achieved" }, s("path", { d: axes(17) }), s("circle", { r: 2.2 })), "achieved pose"),
        one(s("g", { class: "bm-errors" }, s("path", { d: "M0 0L22 -6L15 -7.5M22 -6L17 -0.8" })), "error, enlarged"),
        one(s("g", { class: "bm-link bm-side0" }, s("path", { class: "bm-bar", d: "M0 -3H22" }), s("path", { class: "bm-core", d: "M0 -3H22" })), "driver (filled)"),
        one(s("g", { class: "bm-link bm-side1" }, s("path", { class: "bm-bar", d: "M0 -3H22" }), s("path", { class: "bm-core", d: "M0 -3H22" })), "follower (hollow)"),
        one(s("path", { class: "bm-curve bm-here", d: "M-2 2C6 -16 18 -10 28 -4" }), "path of the origin of M"),
      );
    }
    return h("ul", { class: "bm-keys" }, items);
  }

  /** For print, and for those who read: the dimensions of every linkage. */
  everyDimension() {
    const parts = this.links.map((each) => h("div", { class: "bm-every-one" }, dimensionTable(this.data, each)));
    return h("details", { class: "bm-every" }, h("summary", {}, "Dimensions of every linkage"), h("div", { class: "bm-every-all" }, parts));
  }

  choose(index) {
    this.chosen = index;
    const { linkage } = this;
    this.cards.forEach((card, k) => card.setAttribute("aria-pressed", String(k === index)));
    const first = linkage.pose_errors.find((row) => row.way !== null);
    const counts = linkage.ways.map((way) => way.poses.length);
    this.way = Math.max(0, counts.indexOf(Math.max(...counts)));
    const start = linkage.pose_errors.find((row) => row.way === this.way) ?? first;
    this.u = start?.way === this.way ? start.frame : 0;
    this.factor = factorFor(this.data, linkage);
    this.factorBox.value = String(this.factor);
    this.rebuild();
  }

  take(index) {
    this.way = index;
    const start = this.linkage.pose_errors.find((row) => row.way === index);
    this.u = start ? start.frame : 0;
    this.heading = 1;
    this.rebuild();
  }

  /** Everything that depends on the linkage and on the assembly. */
  rebuild() {
    const { linkage, path, data } = this;
    this.near = -1;
    this.heading = 1;
    if (!path) this.play(false);
    if (linkage) {
      this.stageTitle.textContent = `${linkage.id}: ${linkage.type}`;
      this.story.textContent = this.storyOf(linkage);
      this.fillWays();
      const fill = this.numbers.querySelector(".bm-fill");
      fill.replaceChildren(this.facts(linkage), dimensionTable(data, linkage), ...linkage.said.notes.map((note) => h("p", { class: "bm-note-text" }, note)));
      const { slider } = this;
      slider.max = path ? path.x.length - 1 : 1;
      slider.disabled = this.playButton.disabled = !path;
    }
    this.poseBox.replaceChildren(this.poseBox.querySelector("h2"), poseTable(data, linkage));
    this.rows = [...this.poseBox.querySelectorAll("tbody tr")];
    this.spaceStory.replaceChildren(...this.spaceWords());
    this.spaceNumbers.replaceChildren(this.spaceNumbers.firstChild, ...imageTables(data, linkage));
    this.draw();
  }

  facts(linkage) {
    const { data } = this, { said } = linkage;
    const unit = data.unit ? ` ${data.unit}` : "";
    const rows = [["verdict", verdictOf(linkage)]];
    if (said.links) for (const [name, value] of Object.entries(said.links)) rows.push([`${name} link`, `${value}${unit}`]);
    rows.push(
      ["worst miss", missOf(said.worst, said.angle, unit)],
      ["rms miss", missOf(said.rms, said.rms_angle, unit)],
      ["least transmission angle", said.transmission === "-" ? "–" : said.transmission],
      ["driver", `${linkage.led[0].id}${said.turns_fully ? ", turns fully" : ""}`],
    );
    return h("dl", { class: "bm-facts" }, rows.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
  }

  storyOf(linkage) {
    const { said } = linkage;
    const met = `${linkage.usable ? "Usable" : "Not usable"}: it ${said.met}`;
    if (!linkage.ways.length) return `${met}. It cannot be shown moving: ${said.reasons.join("; ") || "its motion is not known"}.`;
    if (linkage.type === "change-point") {
      return `${met}, driven by ${linkage.led[0].id}. At a change point, where all links lie in one line, it may go on either way.`;
    }
    return linkage.usable ? `${met}, driven by ${linkage.led[0].id}.` : `Not usable: it ${said.in_short}.`;
  }

  fillWays() {
    const { linkage } = this, names = this.data.poses.map((pose) => pose.label);
    this.ways.replaceChildren(h("legend", {}, "Assembly"));
    linkage.ways.forEach((way, k) => {
      const held = way.poses.length === names.length ? "all poses" : way.poses.length ? `pose${way.poses.length > 1 ? "s" : ""} ${runs(way.poses, names)}` : "no pose";
      const dead = way.dead.filter(Boolean).length;
      const ends = way.round ? "turns round" : dead === 2 ? "between two dead points" : dead ? "up to a dead point" : "open";
      this.ways.append(
        h(
          "label",
          {},
          h("input", { type: "radio", name: this.name ?? (this.name = `bm-way-${Math.random().toString(36).slice(2)}`), value: k, checked: k === this.way, onchange: () => this.take(k) }),
          h("span", {}, h("b", {}, wayName(way, linkage).replace("assembly ", "")), ` ${held}; ${ends}`),
        ),
      );
    });
    this.ways.hidden = !linkage.ways.length;
  }

  spaceWords() {
    const { linkage } = this;
    const plain = "Every place of the body is one point of this space; numbered points are the poses.";
    if (!linkage) return [plain];
    const surface = (side) => h("b", { class: `bm-side${side}` }, linkage.led[side].id);
    return [plain, " The surfaces are all places that dyad ", surface(0), " (driver) and dyad ", surface(1), " (follower) allow; where they meet, the line, the coupler moves."];
  }

  /** Draw what stands still anew, and then what moves. */
  draw() {
    const { linkage } = this;
    if (linkage) this.plots.build(linkage, this.way);
    this.plane.build(linkage, this.way, this.factor ?? 0, this.room());
    this.plane.svg.setAttribute("aria-label", linkage ? `${linkage.id}, a ${linkage.type}, at the poses. Space plays, arrow keys move the driver.` : "The poses");
    this.space.build(linkage, this.way);
    this.map?.build(linkage);
    if (linkage) this.drawStops();
    this.show();
  }

  /** The height that is left for the drawing where the numbers stand beside it. */
  room() {
    if (!this.aside) return 0;
    const stage = this.plane.parent.parentElement;
    if (this.aside.offsetLeft <= stage.offsetLeft) return 0;
    return this.aside.offsetHeight - (stage.offsetHeight - this.plane.parent.clientHeight);
  }

  drawStops() {
    const { stops, path } = this;
    stops.replaceChildren();
    if (!path) return;
    const width = Math.max(60, this.slider.clientWidth), inset = 9;
    stops.setAttribute("viewBox", `0 0 ${width} 16`);
    const X = (u) => inset + (u / (path.x.length - 1)) * (width - 2 * inset);
    let last = -99;
    const rows = this.linkage.pose_errors.map((row, k) => ({ ...row, k })).filter((row) => row.way === this.way);
    for (const row of rows.sort((a, b) => a.frame - b.frame)) {
      const x = px(X(row.frame)), name = this.data.poses[row.k].label;
      stops.append(s("path", { d: `M${x} 0V4` }));
      if (x - last > 4 + 6.4 * name.length) {
        stops.append(s("text", { x, y: 14, "text-anchor": "middle" }, name));
        last = x;
      }
    }
  }

  play(on) {
    if (!this.playButton || (on && !this.path)) return;
    this.playing = on;
    this.readout.setAttribute("aria-live", on ? "off" : "polite"); // it would talk without end
    this.cycle = null;
    this.playButton.replaceChildren(icon(on), on ? "Pause" : "Play");
    this.playButton.setAttribute("aria-label", on ? "Pause" : "Play");
    this.playButton.title = on ? "Pause (space)" : "Play (space)";
    cancelAnimationFrame(this.tick);
    if (!on) return;
    let before = null;
    const run = (now) => {
      if (!this.playing) return;
      const start = performance.now();
      if (before !== null) this.advance(Math.min(0.1, (now - before) / 1000));
      before = now;
      this.cost = performance.now() - start;
      if (this.playing) this.tick = requestAnimationFrame(run);
    };
    this.tick = requestAnimationFrame(run);
  }

  advance(seconds) {
    const { path } = this, last = path.x.length - 1;
    const step = (seconds * last) / (path.round ? TURN_SECONDS : TURN_SECONDS / 2);
    if (this.cycle !== null) {
      this.cycle -= step;
      if (this.cycle <= 0) {
        const start = this.linkage.pose_errors.find((row) => row.way === this.way);
        this.play(false);
        this.go(start ? start.frame : 0, true);
        return;
      }
    }
    if (path.round) this.u = (this.u + step) % last;
    else {
      // It stops at a dead point, and goes back: it never flips to the other branch.
      this.u += this.heading * step;
      if (this.u >= last || this.u <= 0) {
        this.heading = this.u >= last ? -1 : 1;
        this.u = clamp(this.u, 0, last);
      }
    }
    this.show();
  }

  step(frames) {
    if (!this.path) return;
    const last = this.path.x.length - 1;
    const u = this.u + frames * Math.max(1, last / 360);
    this.go(this.path.round ? ((u % last) + last) % last : clamp(u, 0, last));
  }

  go(u, silent = false) {
    if (!this.path) return;
    if (!silent) this.play(false);
    this.u = clamp(u, 0, this.path.x.length - 1);
    this.show();
  }

  toPose(sense) {
    const all = this.linkage.pose_errors.map((row, k) => ({ ...row, k })).filter((row) => row.way !== null);
    if (!all.length) return;
    const here = this.atPose ?? (sense > 0 ? -1 : this.data.poses.length);
    const next = sense > 0 ? (all.find((row) => row.k > here) ?? all[0]) : ([...all].reverse().find((row) => row.k < here) ?? all[all.length - 1]);
    this.play(false);
    if (next.way !== this.way) {
      this.way = next.way;
      this.u = next.frame;
      this.rebuild();
    }
    this.go(next.frame);
    this.atPose = next.k;
  }

  show() {
    const { path, data, linkage } = this;
    if (!path) {
      this.space.place = null;
      this.space.runner.setAttribute("visibility", "hidden");
      for (const part of this.said ?? []) part.textContent = "";
      return;
    }
    const place = (this.place = placeAt(linkage, path, this.u, data.chart.length));
    this.plane.show(place);
    this.space.show(place);
    const drive = linear(path.drive, this.u), transmission = linear(path.transmission, this.u);
    this.plots.show(drive, transmission);
    this.slider.value = this.u;
    const slides = linkage.led[0].kind === "PR", unit = data.unit ? ` ${data.unit}` : "";
    const digits = decimalsOf(data);
    const driver = slides ? `${fixed(drive, digits)}${unit}` : `${fixed(drive, 1)}°`;
    // The pose that the body is nearest to, the angle counted as the errors count it.
    let near = 0, least = Infinity;
    data.poses.forEach((pose, k) => {
      const turn = place.a - (pose.angle_deg * Math.PI) / 180;
      const away = Math.hypot(place.x - pose.x, place.y - pose.y, data.chart.length * (turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI))));
      if (away < least) [near, least] = [k, away];
    });
    this.atPose = near;
    const pose = data.poses[near];
    const off = Math.hypot(place.x - pose.x, place.y - pose.y);
    const here = linkage.pose_errors[near];
    const at = here.at === path && Math.abs(here.frame - this.u) < 1e-6;
    const parts = [
      `driver ${driver}`,
      `body (${fixed(place.x, digits)}, ${fixed(place.y, digits)})${unit}, ${fixed(((degrees(place.a) + 180) % 360 + 360) % 360 - 180, 2)}°`,
      `transmission ${transmission === null ? "–" : `${fixed(transmission, 1)}°`}`,
      at ? `at pose ${pose.label}, ${here.said.position === "exact" ? "" : "off by "}${missOf(here.said.position, here.said.turned, unit)}` : `${figure(off)}${unit} from pose ${pose.label}`,
    ];
    parts.forEach((text, k) => {
      const whole = k + 1 < parts.length ? `${text} ·` : text;
      if (this.said[k].textContent !== whole) this.said[k].textContent = whole;
    });
    this.slider.setAttribute("aria-valuetext", `driver ${driver}`);
    if (near !== this.near || at !== this.wasAt) {
      this.rows[this.near]?.classList.remove("bm-current");
      this.rows[near]?.classList.add("bm-current");
      [this.near, this.wasAt] = [near, at];
    }
  }

  listen() {
    const on = (target, name, what, options) => {
      target.addEventListener(name, what, options);
      this.cleanups.push(() => target.removeEventListener(name, what, options));
    };
    on(this.root, "keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || !this.path) return;
      const inPlane = event.target === this.plane.svg;
      const typed = /^(BUTTON|SELECT|TEXTAREA|SUMMARY|A)$/.test(event.target.tagName);
      if (event.key === " " && !typed) {
        event.preventDefault();
        this.play(!this.playing);
      } else if (inPlane && /^Arrow/.test(event.key)) {
        event.preventDefault();
        const sense = event.key === "ArrowLeft" || event.key === "ArrowDown" ? -1 : 1;
        this.step(event.shiftKey ? 10 * sense : sense);
      }
    });
    // Space plays wherever nothing else has the focus.
    on(document, "keydown", (event) => {
      if (event.key !== " " || event.target !== document.body || !this.path) return;
      event.preventDefault();
      this.play(!this.playing);
    });
    on(window.matchMedia(DARK), "change", () => this.draw());
    let width = this.root.clientWidth;
    const sizes = new ResizeObserver(() => {
      if (this.root.clientWidth === width) return;
      width = this.root.clientWidth;
      cancelAnimationFrame(this.fitting);
      this.fitting = requestAnimationFrame(() => this.draw());
    });
    sizes.observe(this.root);
    this.cleanups.push(() => sizes.disconnect(), () => this.play(false));
    // On paper there is nothing to fold out.
    on(window, "beforeprint", () => {
      this.play(false);
      for (const part of this.root.querySelectorAll("details:not([open])")) {
        part.open = true;
        part.dataset.opened = "";
      }
    });
    on(window, "afterprint", () => {
      for (const part of this.root.querySelectorAll("details[data-opened]")) {
        part.open = false;
        delete part.dataset.opened;
      }
    });
    if (!this.links.length) return;
    this.play(false);
    // Once round, to show that it moves; then it rests until it is asked.
    if (this.path && !window.matchMedia(REDUCED).matches) {
      this.play(true);
      this.cycle = (this.path.round ? 1 : 2) * (this.path.x.length - 1);
    }
  }

  close() {
    for (const cleanup of this.cleanups) cleanup();
    this.el.replaceChildren();
  }
}

function icon(pause) {
  return s(
    "svg",
    { width: 12, height: 12, viewBox: "0 0 12 12", "aria-hidden": "true" },
    s("path", { d: pause ? "M1 0h3.5v12H1zM7.5 0H11v12H7.5z" : "M1 0l11 6l-11 6z" }),
  );
}

export default {
  render({ model, el }) {
    const options = { webgl: model.get("webgl") ?? true };
    let report = new Report(model.get("data"), el, options);
    const anew = () => {
      report.close();
      report = new Report(model.get("data"), el, options);
    };
    model.on?.("change:data", anew);
    return () => {
      model.off?.("change:data", anew);
      report.close();
    };
  },
};
