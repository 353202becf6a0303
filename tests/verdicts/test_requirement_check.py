"""What is asked of a linkage and is not so, against a sweep of its drive."""

import numpy as np

from burmester.fourbar.defects import judge
from burmester.fourbar.dyad import PR, RR
from burmester.fourbar.linkage import Linkage
from burmester.geometry.displacement import Displacement
from burmester.geometry.regions import Polygon
from burmester.tasks.requirements import Requirements
from burmester.verdicts.requirement_check import violations
from tests.oracles.hard_tasks import sines
from tests.oracles.witness import places, random_four_bar

BOX = Polygon([[-2, -2], [2, -2], [2, 2], [-2, 2]])


def driven_linkages(rng, count):
    """Random linkages with five places in order on one branch, and the sweep between them."""
    while count:
        dyads = random_four_bar(rng)
        drive = rng.uniform(-3, 3) + np.linspace(0, rng.uniform(0.5, 2.5), 5)
        sweep = np.linspace(drive[0], drive[-1], 4001)
        d, phi = (part[0] for part in places(*dyads, sweep))
        if not np.isfinite(phi).all():
            continue
        at = slice(None, None, 1000)
        rows = Displacement(np.column_stack([d[at].real, d[at].imag])[None], phi[at][None])
        linkage = Linkage(*dyads)
        (verdict,) = judge(_stacked(linkage), rows, missed=np.zeros((1, 5)), reach=1.0)
        count -= 1
        yield linkage, verdict.first, d, phi


def _stacked(linkage):
    return Linkage(
        *(
            RR(each.fixed_pivot[None], each.moving_pivot[None], each.radius[None])
            for each in (linkage.first, linkage.second)
        )
    )


def kinds(linkage, driven, **asked):
    return {each.kind for each in violations(linkage, driven, Requirements(**asked))}


def test_every_requirement_is_told_just_where_it_is_not_met():
    rng = np.random.default_rng(0)
    told = {name: [] for name in ("transmission", "crank", "ratio", "room", "type")}
    for linkage, driven, d, phi in driven_linkages(rng, 120):
        first, second = linkage.first, linkage.second
        least = np.degrees(np.arcsin(np.abs(sines(first, second, d, phi)).min()))
        if abs(least - 20) > 0.1:
            wrong = kinds(linkage, driven, transmission_deg=20) == {"transmission"}
            assert wrong == (least < 20)
            told["transmission"].append(wrong)
        whole = np.isfinite(places(first, second, np.linspace(-np.pi, np.pi, 20001))[1]).all()
        wrong = kinds(linkage, driven, driver="crank") == {"driver"}
        assert wrong == (not whole)
        told["crank"].append(wrong)
        links = [
            np.linalg.norm(second.fixed_pivot - first.fixed_pivot),
            first.radius,
            np.linalg.norm(second.moving_pivot - first.moving_pivot),
            second.radius,
        ]
        wrong = kinds(linkage, driven, link_ratio=4.0) == {"link ratio"}
        assert wrong == (max(links) / min(links) > 4.0)
        told["ratio"].append(wrong)
        pins = [first.fixed_pivot @ [1, 1j], second.fixed_pivot @ [1, 1j]]
        for dyad in (first, second):
            pins += list(d + np.exp(1j * phi) * (dyad.moving_pivot @ [1, 1j]))
        beyond = max(np.abs(np.real(pins)).max(), np.abs(np.imag(pins)).max()) - 2
        if abs(beyond) > 1e-3:
            wrong = kinds(linkage, driven, footprint=BOX) == {"footprint"}
            assert wrong == (beyond > 0)
            told["room"].append(wrong)
        grashof = 2 * (min(links) + max(links)) < sum(links)
        wrong = kinds(linkage, driven, types={"grashof"}) == {"type"}
        assert wrong == (not grashof)
        told["type"].append(wrong)
        everything = kinds(linkage, driven)
        assert not everything
    for name, each in told.items():
        assert 0.05 < np.mean(each) < 0.95, name


def test_what_is_said_has_the_numbers():
    rng = np.random.default_rng(1)
    said = 0
    for linkage, driven, d, phi in driven_linkages(rng, 40):
        least = np.degrees(np.arcsin(np.abs(sines(linkage.first, linkage.second, d, phi)).min()))
        for each in violations(linkage, driven, Requirements(transmission_deg=45)):
            number = float(each.message.split("falls to ")[1].split("°")[0])
            assert np.isclose(number, least, rtol=0.02, atol=0.05)
            assert "45°" in each.message
            said += 1
        small = Polygon([[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]])
        (room,) = violations(linkage, driven, Requirements(footprint=small), "mm")
        assert "footprint" in room.message
        assert "mm" in room.message
    assert said > 5


def test_links_that_slide_have_no_ratio():
    linkage = Linkage(RR([0.0, 0.0], [0.0, 0.0], 0.1), PR(np.pi / 2, 0.0, [10.0, 0.0]))
    angle = -np.arcsin(0.1 * np.sin(np.linspace(0.3, 1.2, 5)) / 10)
    pin = 0.1 * np.exp(1j * np.linspace(0.3, 1.2, 5))
    rows = Displacement(np.column_stack([pin.real, pin.imag])[None], angle[None])
    stacked = Linkage(
        RR(linkage.first.fixed_pivot[None], linkage.first.moving_pivot[None], np.array([0.1])),
        PR(np.array([np.pi / 2]), np.array([0.0]), linkage.second.moving_pivot[None]),
    )
    (verdict,) = judge(stacked, rows, missed=np.zeros((1, 5)), reach=1.0)
    assert not kinds(linkage, verdict.first, link_ratio=2.0)
    assert kinds(linkage, verdict.first, types={"crank-rocker"}) == {"type"}
    assert not kinds(linkage, verdict.first, types={"slider-crank"}, driver="crank")
