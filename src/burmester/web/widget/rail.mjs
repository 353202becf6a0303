// The rail of a slider on the ground, as long as the travel of its block.

import { BLOCK } from "./drawing.mjs";
import { normalOf } from "./kinematics.mjs";
import { px } from "./numbers.mjs";
import { pointOnLine, travelOf } from "./travel.mjs";

const LONGEST = 4000; // pixels to either side: a rail is hatched no farther

/** Where a rail stands in a picture, in pixels: its middle, half its length and how far of that is hatched, its angle,
 * and its two paths, the hatched one first. */
export function railOf(dyad, places, view) {
  const [nx, ny] = normalOf(dyad), [low, high] = travelOf(dyad, places);
  const half = (view.scale * (high - low)) / 2 + BLOCK[0], edge = BLOCK[1] / 2 + 1;
  const [x, y] = ((at) => [view.X(at[0]), view.Y(at[1])])(pointOnLine(dyad, (low + high) / 2));
  // The ground is on the side where the body is not.
  const bodySide = places.reduce((sum, place) => sum + nx * place.x + ny * place.y - dyad.line.offset, 0);
  const turned = Math.atan2(nx, -ny) + (bodySide > 0 ? Math.PI : 0);
  const drawn = Math.min(half, LONGEST);
  let hatch = "";
  for (let k = -drawn + 4; k < drawn - 2; k += 8) hatch += `M${px(k + 4)} ${edge}l-6 7`;
  return { x, y, half, drawn, turned, paths: [`M${px(-half)} ${edge}H${px(half)}${hatch}`, `M${px(-half)} ${-edge}H${px(half)}`] };
}
