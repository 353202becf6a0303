// The moving parts of a linkage as they are drawn: links, blocks in slots, the body and its pivots.

import { s } from "./dom.mjs";
import { AXIS, BLOCK, axes, hull, transform } from "./drawing.mjs";
import { act, normalOf } from "./kinematics.mjs";
import { px } from "./numbers.mjs";
import { bodyPath } from "./outlines.mjs";
import { pointOnLine, travelOf } from "./travel.mjs";

const BODY_AXIS = AXIS + 10; // pixels: the x axis of the body
const LETTER = 14; // pixels: how far the letter M stands from the origin of M, along each axis
const BLOCK_IN_SLOT = [18, 10]; // pixels: its length and height
const SPARE = 5; // pixels: how far a slot goes on beyond its block
const ARROW = 24; // pixels: how far the arrow of a sliding driver stands from its block

/** The parts in the middle of a picture, and `show` that puts them at a place of the body.
 *
 * places: all that are shown; slots are as long as they need.
 */
export function mechanism(data, linkage, view, places) {
  const parts = {
    links: s("g"), blocks: s("g"), pins: s("g"), coupler: s("g", { class: "bm-coupler" }),
    corners: [[0, 0]], // of the body's plate, in pixels from the origin of M
    moves: [],
  };
  const outline = bodyPath(data, view, { class: "bm-body-outline" });
  parts.moves.push((place) => {
    const at = transform(view.X(place.x), view.Y(place.y), place.a);
    for (const part of [parts.coupler, outline]) part?.setAttribute("transform", at);
  });
  linkage.led.forEach((dyad, side) => {
    if (dyad.moving_pivot) parts.corners.push([view.scale * dyad.moving_pivot[0], -view.scale * dyad.moving_pivot[1]]);
    if (dyad.kind === "RR") addLink(parts, dyad, side, view);
    else if (dyad.kind === "PR") addBlockOnRail(parts, dyad, side, view);
    else if (dyad.kind === "RP") addSlot(parts, dyad, side, view, places);
  });
  const letter = addBody(parts, linkage, view);
  const arrow = driverArrow(parts, linkage.led[0], view);
  const group = s("g", { class: "bm-linkage" }, outline, arrow, parts.links, parts.coupler, parts.blocks, parts.pins, letter);
  return { group, show: (place) => parts.moves.forEach((move) => move(place)) };
}

const groundPin = (dyad, r, view) =>
  s("circle", {
    class: "bm-pin bm-fixed-pin", r, cx: px(view.X(dyad.fixed_pivot[0])), cy: px(view.Y(dyad.fixed_pivot[1])), "data-dyad": dyad.id,
  });

const block = (dyad, side, width, height) =>
  s(
    "g",
    { class: `bm-block bm-side${side}`, "data-dyad": dyad.id },
    s("rect", { x: -width / 2, y: -height / 2, width, height, rx: 2 }),
  );

/** RR: a bar from the fixed pivot to the moving one. */
function addLink({ links, pins, moves }, dyad, side, view) {
  const d = `M0 0H${px(view.scale * dyad.radius)}`;
  const bar = s(
    "g",
    { class: `bm-link bm-side${side}` },
    s("path", { class: "bm-bar", d }),
    s("path", { class: "bm-core", d }),
  );
  links.append(bar);
  pins.append(groundPin(dyad, 4.5, view));
  const [cx, cy] = dyad.fixed_pivot;
  moves.push((place) => {
    const [x, y] = act(place, dyad.moving_pivot);
    bar.setAttribute("transform", transform(view.X(cx), view.Y(cy), Math.atan2(y - cy, x - cx)));
  });
}

/** PR: a block on the rail that stands on the ground. */
function addBlockOnRail({ blocks, moves }, dyad, side, view) {
  const slider = block(dyad, side, ...BLOCK);
  blocks.append(slider);
  const [nx, ny] = normalOf(dyad), along = Math.atan2(nx, -ny);
  moves.push((place) => {
    const [x, y] = act(place, dyad.moving_pivot);
    slider.setAttribute("transform", transform(view.X(x), view.Y(y), along));
  });
}

/** RP: a slot in the body, as long as the travel of its block, which stands on the fixed pivot. */
function addSlot({ blocks, pins, coupler, corners, moves }, dyad, side, view, places) {
  const S = view.scale, [low, high] = travelOf(dyad, places), end = (BLOCK_IN_SLOT[0] / 2 + SPARE) / S;
  const seen = (along) => (([x, y]) => [S * x, -S * y])(pointOnLine(dyad, along));
  const ends = [seen(low - end), seen(high + end)];
  const d = `M${ends.map((each) => each.map(px).join(" ")).join("L")}`;
  coupler.append(
    s("path", { class: "bm-slot-rim", d }),
    s("path", { class: "bm-slot-plate", d }),
    s("path", { class: "bm-slot-edge", d }),
    s("path", { class: "bm-slot", d, "data-dyad": dyad.id }),
  );
  corners.push(seen((low + high) / 2));
  const [nx, ny] = normalOf(dyad), [cx, cy] = dyad.fixed_pivot;
  const slider = block(dyad, side, ...BLOCK_IN_SLOT);
  blocks.append(slider);
  pins.append(groundPin(dyad, 4, view));
  moves.push((place) =>
    slider.setAttribute("transform", transform(view.X(cx), view.Y(cy), place.a + Math.atan2(nx, -ny))),
  );
}

/** The body: a plate through its pivots and the origin of M.  Returns its letter, which stays upright. */
function addBody({ coupler, corners, moves }, linkage, view) {
  const S = view.scale;
  const d = `M${hull(corners).map((corner) => corner.map(px).join(" ")).join("L")}Z`;
  coupler.prepend(s("path", { class: "bm-plate-rim", d }), s("path", { class: "bm-plate", d }));
  coupler.append(
    s("path", { class: "bm-body-frame", d: axes(BODY_AXIS) }),
    s("circle", { class: "bm-origin", r: 4 }),
  );
  for (const dyad of linkage.led) {
    if (!dyad.moving_pivot) continue;
    const [x, y] = dyad.moving_pivot;
    coupler.append(s("circle", { class: "bm-pin", r: 4.5, cx: px(S * x), cy: px(-S * y), "data-dyad": dyad.id }));
  }
  const letter = s("text", { class: "bm-letter", "text-anchor": "middle" }, "M");
  moves.push((place) => {
    const [x, y] = act(place, [-LETTER / S, -LETTER / S]);
    letter.setAttribute("x", px(view.X(x)));
    letter.setAttribute("y", px(view.Y(y) + 4));
  });
  return letter;
}

/** A turning or sliding arrow at the driver, for eyes that tell no colours apart. */
function driverArrow({ moves }, driver, view) {
  const arrow = s("path", { class: "bm-drive-mark bm-side0" });
  if (driver.kind === "RR" || driver.kind === "RP") {
    const [x, y] = driver.fixed_pivot;
    arrow.setAttribute("d", "M17 -6A18 18 0 1 0 17 6m1.6 -7.5l-1.4 8.2l-7.4 -3.9");
    arrow.setAttribute("transform", `translate(${px(view.X(x))} ${px(view.Y(y))}) rotate(-90)`);
  } else if (driver.kind === "PR") {
    arrow.setAttribute("d", "M-26 0H26m-6 -5l6 5l-6 5M-20 -5l-6 5l6 5");
    const [nx, ny] = normalOf(driver), along = Math.atan2(nx, -ny);
    moves.push((place) => {
      const [x, y] = act(place, driver.moving_pivot);
      arrow.setAttribute("transform", `${transform(view.X(x), view.Y(y), along)} translate(0 ${-ARROW})`);
    });
  }
  return arrow;
}
