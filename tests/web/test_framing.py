"""What a picture holds: corners and pivots carried here, without the page's arithmetic."""

import numpy as np

from burmester import synthesize
from burmester.verdicts.motion import Motion
from burmester.web.data import report_data
from tests.oracles.bodies import bodied
from tests.oracles.page_modules import value

BOXES = """return bodies.map((body) => {
  const data = { ...given, body, keep_out: [] }, [linkage] = data.linkages;
  return m.boxOf(data, linkage, places);
});"""


def test_a_picture_holds_the_body_wherever_it_goes_and_every_pivot():
    """Bodies from a tenth to thirty sizes of the motion, anywhere around their frame."""
    found = synthesize(bodied())
    best = found.linkages[0]
    rng = np.random.default_rng(3)
    bodies = rng.normal(size=(60, 1, 2)) + rng.normal(size=(60, 5, 2))
    bodies *= 10 ** rng.uniform(-1, 1.5, (60, 1, 1))
    places = Motion.of(best, 300).places
    given = [
        {"x": x, "y": y, "a": a}
        for (x, y), a in zip(places.translation.tolist(), places.angle.tolist(), strict=True)
    ]
    data = report_data(found)
    boxes = value("../widget/framing.mjs", BOXES, given=data, bodies=bodies.tolist(), places=given)
    at = np.r_[places.translation, found.task.poses.translation] @ [1, 1j]
    turn = np.exp(1j * np.r_[places.angle, found.task.poses.angle])
    dyads = [each.dyad for each in best.dyads]
    still = [each.fixed_pivot for each in dyads]
    for body, box in zip(bodies, boxes, strict=True):
        points = np.r_[body, [[0, 0]], [each.moving_pivot for each in dyads]] @ [1, 1j]
        seen = np.r_[(at[:, None] + turn[:, None] * points).ravel(), still @ np.array([1, 1j])]
        wanted = [seen.real.min(), seen.imag.min(), seen.real.max(), seen.imag.max()]
        np.testing.assert_allclose(box, wanted, atol=1e-4 * abs(seen).max())
