// A frame of followed answers: what src/burmester/live/frames.py writes.

const WAY = ["x", "y", "angle", "drive", "transmission"];
const POSE = ["x", "y", "angle_deg", "position", "turned_deg", "transmission_deg"];

/**
 * The header of a frame with its numbers put where they belong: `ways` and `pose_errors` of a
 * linkage are as in the data of the report, but for arrays that are Float32Array.  A number that
 * does not exist is null in `pose_errors`, and NaN in an array.
 * @param {ArrayBuffer} buffer
 * @returns {any}
 */
export function decodeFrame(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const numbers = floats(buffer, 4 + length);
  for (const linkage of header.linkages ?? []) {
    if (linkage.ways) linkage.ways = linkage.ways.map((/** @type {any} */ way) => ({ ...way, ...pieces(numbers, way, WAY) }));
    if (!linkage.poses) continue; // it stands as it did
    const { count } = linkage.poses;
    const columns = pieces(numbers, linkage.poses, POSE);
    linkage.pose_errors = Array.from({ length: count }, (/** @type {unknown} */ _, /** @type {number} */ pose) => {
      const at = linkage.at?.[pose] ?? null;
      /** @type {Record<string, any>} */ const row = { way: at ? at[0] : null, frame: at ? at[1] : null };
      for (const name of POSE) {
        const value = columns[name][pose];
        row[name] = Number.isNaN(value) ? null : value;
      }
      return row;
    });
  }
  return header;
}

/** The numbers of a frame, which are little-endian whatever the machine is.
 * @param {ArrayBuffer} buffer @param {number} start */
function floats(buffer, start) {
  if (new Uint8Array(new Uint16Array([1]).buffer)[0] === 1) return new Float32Array(buffer, start);
  const view = new DataView(buffer, start);
  return Float32Array.from({ length: view.byteLength / 4 }, (_, k) => view.getFloat32(4 * k, true));
}

/** Pieces of `count` numbers one after another, each under its name.
 * @param {Float32Array} numbers @param {{ start: number, count: number }} range @param {string[]} names
 * @returns {Record<string, Float32Array>} */
function pieces(numbers, { start, count }, names) {
  return Object.fromEntries(names.map((name, k) => [name, numbers.subarray(start + k * count, start + (k + 1) * count)]));
}
