"""Where a page of six-bars has drawn their joints and links, and a place of the slider."""

# Where joints are by their pins, the ends of links, and the body, all in the task's unit.
DRAWN = """() => {
  const svg = document.querySelector(".bm-plane"), { scale, left, top } = svg.dataset;
  const world = (x, y) => [(x - left) / scale, (top - y) / scale];
  const joints = {}, links = {};
  for (const pin of svg.querySelectorAll("[data-joint]"))
    joints[pin.dataset.joint] = world(+pin.getAttribute("cx"), +pin.getAttribute("cy"));
  for (const link of svg.querySelectorAll("[data-link]")) {
    const numbers = link.firstChild.getAttribute("d").match(/-?[\\d.]+(e-?\\d+)?/g).map(Number);
    links[link.dataset.link] = numbers.flatMap((x, k) => (k % 2 ? [] : [world(x, numbers[k + 1])]));
  }
  const at = svg.querySelector(".bm-coupler").getAttribute("transform").match(/-?[\\d.]+/g);
  const [x, y, turned] = at.map(Number);
  return { joints, links, body: [...world(x, y), (-turned * Math.PI) / 180], scale: +scale };
}"""
SCRUB = """(share) => {
  const slider = document.querySelector(".bm-slider");
  slider.value = +slider.min + share * (slider.max - slider.min);
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""


def points(drawn):
    """The joints that `DRAWN` gives, as complex numbers."""
    return {name: complex(*at) for name, at in drawn["joints"].items()}
