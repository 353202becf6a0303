// Image space without WebGL: the same rays as in the shader, one by one.

import { clamp } from "./numbers.mjs";
import { plus, scaled, unit } from "./vectors.mjs";

/** @typedef {import("./types").Vector} Vector
 * @typedef {{ eye: Vector, ahead: Vector, right: Vector, up: Vector, reach: Vector, quadrics: Vector[], paint: Vector[], angles: Vector }} Scene */

const WIDTH = 440; // pixels of a picture at rest, at most; the canvas stretches it
const TURNING_SHARE = 0.35; // of the pixels along a side while it turns

/** Draw a scene, as `sceneOf` in image_space.mjs describes it, on a canvas of a size in pixels.
 * @param {HTMLCanvasElement} canvas @param {Scene} scene @param {{ width: number, height: number }} size @param {boolean} turning */
export function drawStill(canvas, scene, size, turning) {
  const share = turning ? TURNING_SHARE : Math.min(1, WIDTH / size.width);
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

/** Colours of all pixels of an image.  The loop allocates nothing: it runs for every pixel.
 * @param {ImageData} image @param {Scene} scene */
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
