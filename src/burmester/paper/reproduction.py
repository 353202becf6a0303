"""The tables of Ge, Zhao, Purwar and Li 2012, computed again and laid beside the print.

Each printed number is held against the same number computed from the paper's own poses, and
against its spread: the smallest and the greatest value over copies of the poses drawn evenly
within the rounding of their last printed digit (half a unit: 5e-5 in x and y, 0.005 deg in the
angle), each number by itself.  Angles are in degrees here.

Source: JCISE 12(4) 041003, doi 10.1115/1.4007447.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import asdict, replace
from typing import Any, Final

import numpy as np

from burmester.dyads.pencil import fit_pencil
from burmester.fourbar.dyad import RR
from burmester.geometry import constraint_manifold
from burmester.geometry.displacement import Displacement
from burmester.io.cases import load
from burmester.numerics.arrays import FloatArray
from burmester.paper.comparison import (
    MISPRINTS,
    Comparison,
    Section,
    Verdict,
    compare,
    compare_columns,
)
from burmester.paper.fit import LAST_DIGIT, VECTORS, PaperFit, rounded
from burmester.paper.five_methods import SideBySide, side_by_side_data

ENTRIES: Final = ("sigma1", "sigma2", "tau1", "tau2", "c33", "c34", "c44")  # of Eq. (9), at
PLACES: Final = ([0, 1, 0, 1, 2, 2, 3], [2, 2, 3, 3, 2, 3, 3])


def reproduce(samples: int = 4000, seed: int = 2012) -> tuple[Section, ...]:
    """Every number of the paper's Sec. 6 that its own poses can give, beside the print.

    samples: copies of the poses for the spread; the same seed gives the same result.
    """
    return compare_cases(load("ge2012-exact"), load("ge2012-approximate"), samples, seed)


def compare_cases(
    exact: dict[str, Any], approximate: dict[str, Any], samples: int, seed: int
) -> tuple[Section, ...]:
    """`reproduce` on the two examples as `burmester.io.cases.load` gives them."""
    first = PaperFit.of(exact, "Table 4", "singular_vectors_table4", samples, seed)
    second = PaperFit.of(approximate, "Table 7", "singular_vectors_table7", samples, seed)
    return (
        _table2(first, samples, seed),
        _table3(first),
        _table4(first),
        _equations19(first),
        _figure4(first),
        Section(
            "Table 6: singular values of [A], approximate motion",
            tuple(_singular_values(second, "Table 6")),
        ),
        _table7(second),
        _equations22(second),
        _table8(second),
        _beyond(first, second),
    )


def reproduction_data(
    sections: Iterable[Section], tasks: Iterable[SideBySide] = ()
) -> dict[str, Any]:
    """The sections, and the methods side by side, as plain data."""
    return {
        "schema": "burmester.reproduction/1",
        "sections": [asdict(s) for s in sections],
        "methods": [side_by_side_data(task) for task in tasks],
    }


def _table2(fit: PaperFit, samples: int, seed: int) -> Section:
    given = fit.case["poses_as_printed"]
    poses, linkage = rounded(given, samples, seed), _circles(fit.printed["linkage"])
    angles = np.degrees(_nearest_on_linkage(poses, linkage).angle)
    names = [f"angle {i}" for i in range(1, len(given) + 1)]
    rows = compare_columns("Table 2", names, [row[2] for row in given], angles, ".2f")
    miss, right = (np.abs(linkage.residual(d[0])) for d in (poses, fit.poses))
    rows[5] = rows[5].noted(
        f"With the printed angle pose 6 misses the two circles by {miss[0, 5]:.1e} and "
        f"{miss[1, 5]:.1e}, with 52.87 by {right[0, 5]:.1e} and {right[1, 5]:.1e}; every other "
        f"pose by {np.delete(miss, 5, axis=1).max():.1e} at most.",
    )
    wrong = fit_pencil(poses[0], normalise=False).singular_values
    changes = ", ".join(
        f"sigma{i + 1} = {wrong[i]:.4f} ({wrong[i] - fit.values[0, i]:+.4f})" for i in range(1, 7)
    )
    per_pose = "; ".join(" ".join(f"{x * 1e4:.1f}" for x in circle) for circle in miss)
    return Section(
        "Table 2: the angles at which its poses are on the linkage of Fig. 2",
        tuple(rows),
        (
            f"Misses of the two circles by poses 1 to 10 as printed, in 1e-4: {per_pose}.",
            f"Singular values with pose 6 as printed (and against 52.87): {changes}.",
        ),
    )


def _table3(fit: PaperFit) -> Section:
    exact = _nearest_on_linkage(fit.poses[0], _circles(fit.printed["linkage"]))
    moved = np.abs(exact.translation - fit.poses[0].translation).max() / LAST_DIGIT[0]
    turned = np.degrees(np.abs(exact.angle - fit.poses[0].angle).max()) / LAST_DIGIT[2]
    design = constraint_manifold.monomials(exact.as_image_point())
    by_svd = np.linalg.svd(design, compute_uv=False)[-2]
    by_square = math.sqrt(np.abs(np.linalg.eigvalsh(design.T @ design)[:2]).max())
    low, high = fit.values[:, :2].min(axis=0), fit.values[:, :2].max(axis=0)
    return Section(
        "Table 3: singular values of [A], exact motion, pose 6 at 52.87 deg",
        tuple(_singular_values(fit, "Table 3", vanishes=True)),
        (
            f"The rounding of the poses alone gives a sigma1 of {low[0]:.0e} to {high[0]:.0e} and "
            f"a sigma2 of {low[1]:.0e} to {high[1]:.0e}: the paper computed with more digits than "
            f"Table 2 prints.",
            f"Poses put exactly on the linkage of Fig. 2, by {max(moved, turned):.2f} of a last "
            f"digit at most, give {by_svd:.0e} by SVD and {by_square:.0e} by the eigenvalues of "
            f"AᵀA, which is the size of the print.",
        ),
    )


def _table4(fit: PaperFit) -> Section:
    v, meant, plane = np.array(fit.printed["singular_vectors_table4"]), fit.vectors, fit.plane
    near = np.einsum("kj,nij,nil->nkl", meant, plane, plane)
    near /= np.linalg.norm(near, axis=-1, keepdims=True)
    rows = compare_columns("Table 4", VECTORS, v.ravel(), near.reshape(-1, 16))
    rows[4] = rows[4].noted(
        f"As printed |v1| = {np.linalg.norm(v[0]):.4f} and v1 · v2 = {v[0] @ v[1]:.4f}; with "
        f"{meant[0, 4]:.4f} they are {np.linalg.norm(meant[0]):.4f} and {meant[0] @ meant[1]:.4f}.",
    )
    tilt = _sine(near, plane[0]).max(axis=0)
    off, off_meant = _sine(v, plane[0]), _sine(meant, plane[0])
    for i, name in enumerate(("v1", "v2")):
        verdict = Verdict.WITHIN if off[i] <= tilt[i] else Verdict.DIFFERS
        note = "Sine of the angle with the computed plane; the spread is its tilt by rounding."
        if off[i] > tilt[i] >= off_meant[i]:
            verdict, note = Verdict.MISPRINT, f"{note} With p5 as meant it is {off_meant[i]:.4f}."
        item = f"Table 4, {name} off plane"
        rows.append(Comparison(item, "0", float(off[i]), 0.0, float(tilt[i]), verdict, note))
    own = _root_of_e(meant)
    prints = fit.printed["singular_vector_errors_table4"]
    rows += compare_columns("Table 4", ("v1 e", "v2 e"), prints, own[None])
    return Section(
        "Table 4: singular vectors, exact motion, beside the nearest in the computed plane",
        tuple(rows),
        (
            "On exact data sigma1 = sigma2 = 0 and any orthonormal pair in the plane may be v1, "
            "v2: what can be compared is the vector of the plane nearest to each printed one.",
            f"e is computed from the printed digits (v1 p5 as meant). It is the root of E of Eq. "
            f"(18): sqrt(E) is {own[0]:.4f} and {own[1]:.4f}, E is {own[0] ** 2:.4f} and "
            f"{own[1] ** 2:.4f}.",
        ),
    )


def _equations19(fit: PaperFit) -> Section:
    theta = np.array(fit.printed["theta_deg"])
    turned, counted = _angles(fit.p, fit.vectors[None], theta), _angles(fit.p, fit.plane, theta)
    rows = []
    for i, name in enumerate(("theta1", "theta2")):
        free = turned[:, i]
        row = compare(f"Eq. (19), {name}", theta[i], counted[:, i], ".2f", (free, Verdict.FREE))
        spread = f"{free[0]:.2f} ({free.min():.2f} .. {free.max():.2f})"
        rows.append(row.noted(f"Counted from the printed v1, v2 it is {spread}."))
    unit = fit.p / np.linalg.norm(fit.p, axis=-1, keepdims=True)
    between = np.degrees(np.arccos(np.abs((unit[:, 0] * unit[:, 1]).sum(axis=-1))))
    apart = 90 - abs(90 - (theta[1] - theta[0]) % 180)
    rows.append(compare("Eq. (19), difference", apart, between, ".2f"))
    rows += compare_columns(
        "Eq. (19)", ("e1", "e2"), fit.printed["theta_error"], fit.e, ".2e", vanishes=True
    )
    linkage = _circles(fit.printed["linkage"])
    own = constraint_manifold.matrix(linkage.coefficients()[:, 0]) - [
        fit.printed["C1"],
        fit.printed["C2"],
    ]
    exact = _nearest_on_linkage(fit.poses[0], linkage)
    root = np.sqrt(fit_pencil(exact, normalise=False).error[:2].max())
    low, high = fit.e.min(axis=0) ** 2, fit.e.max(axis=0) ** 2
    return Section(
        "Eqs. (19) to (21): the two constraint manifolds, exact motion",
        (*rows, *_matrix_rows(fit, "Eq. (20)", "Eq. (21)")),
        (
            "theta is counted from v1, so it turns with the free choice of v1, v2; the difference "
            "theta2 - theta1 does not (here as the angle of two lines, up to 90 deg).",
            f"Rounded poses do not tell if e1, e2 are E or sqrt(E). As sqrt(E), which e is "
            f"everywhere else, they are below every sample, as sigma1 and sigma2 are (poses put "
            f"exactly on the linkage give {root:.0e}); as E the samples hold "
            f"{low[0]:.0e} .. {high[0]:.0e} and {low[1]:.0e} .. {high[1]:.0e}.",
            f"The matrices of the linkage of Fig. 2 itself are those of Eqs. (20) and (21) within "
            f"{np.abs(own).max():.0e}.",
        ),
    )


def _figure4(fit: PaperFit) -> Section:
    centre, _, squared = constraint_manifold.circle(fit.p)
    texts = {"Xc1": "X + 22", "Yc1": "Y - 01", "Xc2": "X + 115", "Yc2": "Y - 038"}
    rows = []
    for k, (name, text) in enumerate(texts.items()):
        item, form = f"Fig. 4, {name}", ".1f" if k < 2 else ".2f"
        row = compare(item, MISPRINTS[item][0], centre[:, k // 2, k % 2], form)
        rows.append(replace(row, printed=text))
    square = np.sqrt(squared).mean(axis=-1) ** 2
    rows += compare_columns("Fig. 4", ("r1 squared", "r2 squared"), (1.53, 21.82), square, ".2f")
    return Section("Fig. 4: the two circles, exact motion", tuple(rows))


def _table7(fit: PaperFit) -> Section:
    rows = compare_columns("Table 7", VECTORS, fit.vectors.ravel(), fit.plane.reshape(-1, 16))
    prints = fit.printed["singular_vector_errors_table7"]
    rows += compare_columns("Table 7", ("v1 e", "v2 e"), prints, _root_of_e(fit.plane))
    t = np.radians(fit.printed["theta_deg"])[:, None]
    own = _root_of_e(np.vstack([fit.vectors, np.hstack([np.cos(t), np.sin(t)]) @ fit.vectors]))
    return Section(
        "Table 7: singular vectors, approximate motion",
        tuple(rows),
        (
            f"From the printed digits sqrt(E) = {own[0]:.4f}, {own[1]:.4f} for v1, v2 and "
            f"{own[2]:.2e}, {own[3]:.2e} at the printed angles: here and in Eq. (22) e is the "
            f"root of E of Eq. (18).",
            f"sigma3 is only {fit.values[0, 2] / fit.values[0, 1]:.1f} times sigma2, so the "
            f"fourth decimal of Table 5 moves all that follows by far more than one digit.",
        ),
    )


def _equations22(fit: PaperFit) -> Section:
    theta = np.array(fit.printed["theta_deg"])
    rows = compare_columns(
        "Eq. (22)", ("theta1", "theta2"), theta, _angles(fit.p, fit.plane, theta), ".2f"
    )
    rows += compare_columns("Eq. (22)", ("e1", "e2"), fit.printed["theta_error"], fit.e, ".2e")
    tau1, sigma2 = fit.printed["C2"][0][3], fit.printed["C2"][1][2]
    return Section(
        "Eqs. (22) to (24): the two constraint manifolds, approximate motion",
        (*rows, *_matrix_rows(fit, "Eq. (23)", "Eq. (24)")),
        (
            f"Yc2 = tau1 - sigma2 from Eq. (24) is {tau1 - sigma2:.4f} as printed and "
            f"{-tau1 - sigma2:.4f} with the other sign of tau1; Table 8 prints "
            f"{fit.printed['linkage_table8'][1]['fixed_pivot'][1]:.4f}.",
        ),
    )


def _table8(fit: PaperFit) -> Section:
    fixed, moving, squared = constraint_manifold.circle(fit.p)
    radii = np.sqrt(squared)
    values = np.concatenate([fixed, radii.mean(axis=-1, keepdims=True), moving], axis=-1)
    rows = []
    for i, dyad in enumerate(fit.printed["linkage_table8"]):
        prints = (*dyad["fixed_pivot"], dyad["radius"], *dyad["moving_pivot"])
        names = [f"{name}{i + 1}" for name in ("Xc", "Yc", "r", "x", "y")]
        rows += compare_columns("Table 8", names, prints, values[:, i])
    miss = _circles(fit.printed["linkage_table8"]).residual(fit.poses[0])
    before, after = np.sqrt((miss**2).mean(axis=-1)), miss.std(axis=-1)
    worst = np.abs(miss).max(axis=-1)
    return Section(
        "Table 8: the linkage, approximate motion, r = mean of the two radii of a manifold",
        tuple(rows),
        (
            f"A manifold holds its radius in p2 and again in p8: {radii[0, 0, 0]:.4f} and "
            f"{radii[0, 0, 1]:.4f}, {radii[0, 1, 0]:.4f} and {radii[0, 1, 1]:.4f}.",
            f"The structural error of {fit.printed['structural_error']:.2e} is not compared: the "
            f"paper does not define it. By |R m + d - c| - r on Table 5 the printed dyads miss "
            f"their circles by {before[0]:.4f} and {before[1]:.4f} rms, {worst[0]:.4f} and "
            f"{worst[1]:.4f} at most.",
            f"Refitting the two radii alone leaves {after[0]:.4f} and {after[1]:.4f} rms, "
            f"{before[0] / after[0]:.1f} and {before[1] / after[1]:.1f} times less.",
        ),
    )


def _beyond(*fits: PaperFit) -> Section:
    remarks = [
        "Tables 1 and 9 are not compared: they rest on ten poses of Ravani and Roth that the "
        "paper does not print."
    ]
    for fit, name in zip(fits, ("Table 2 (pose 6 at 52.87 deg)", "Table 5"), strict=True):
        a, b = (np.sort(fit_pencil(fit.poses[0], normalise=n).rms_error) for n in (False, True))
        remarks.append(
            f"{name}: the two dyads miss their circles, radii refitted, by {a[0]:.1e} and "
            f"{a[1]:.1e} rms with the paper's fit, and by {b[0]:.1e} and {b[1]:.1e} with the "
            f"normalised fit, which does not depend on frames and units."
        )
    return Section("Not compared, and beyond the print", (), tuple(remarks))


def _singular_values(fit: PaperFit, where: str, *, vanishes: bool = False) -> list[Comparison]:
    """The eight singular values, and the greatest in the chart Z4 = 1 of Eq. (14)."""
    printed = fit.printed[f"singular_values_{where.lower().replace(' ', '')}"]
    names = [f"sigma{i}" for i in range(1, 9)]
    # The paper writes the first two with powers of ten.
    first = fit.values[:, :2]
    rows = compare_columns(where, names[:2], printed[:2], first, ".2e", vanishes=vanishes)
    rows += compare_columns(where, names[2:], printed[2:], fit.values[:, 2:], ".4f")
    point = fit.poses[0].as_image_point()
    chart: FloatArray = np.linalg.svd(constraint_manifold.monomials(point / point[:, 3:]))[1][:1]
    unit = fit.values[:, 7]
    row = compare(f"{where}, sigma8, Z4 = 1", printed[7], chart, other=(unit, Verdict.MISPRINT))
    return [*rows, row.noted(f"Eq. (14) sets Z4 = 1; unit image points give {unit[0]:.4f}.")]


def _matrix_rows(fit: PaperFit, *equations: str) -> list[Comparison]:
    rows: list[Comparison] = []
    for i, equation in enumerate(equations):
        prints = np.array(fit.printed[f"C{i + 1}"])[PLACES]
        entries = constraint_manifold.matrix(fit.p[:, i])[:, *PLACES]
        rows += compare_columns(equation, ENTRIES, prints, entries)
    return rows


def _angles(p: FloatArray, basis: FloatArray, near: FloatArray) -> FloatArray:
    """The angles of Eq. (16) (k, 2) in a basis (k, 2, 8), in degrees modulo 180 near the print."""
    part = np.einsum("nkl,nil->nki", p, np.broadcast_to(basis, p.shape))
    angle: FloatArray = np.degrees(np.arctan2(part[..., 1], part[..., 0]))
    return (angle - near + 90) % 180 - 90 + near


def _nearest_on_linkage(poses: Displacement, linkage: RR) -> Displacement:
    """The poses (*, N) moved onto both circles by the fewest units of their last digits."""
    unit = LAST_DIGIT * (1, 1, math.pi / 180)
    start = np.concatenate([poses.translation, poses.angle[..., None]], axis=-1)
    step = np.zeros_like(start)
    for _ in range(5):  # Gauss-Newton; it has settled after three
        moved = Displacement.from_poses(start + step * unit)[..., None]
        turned = moved.rotate(linkage.moving_pivot[:, 0])
        arm = turned + moved.translation - linkage.fixed_pivot[:, 0]
        lever = turned[..., 0] * arm[..., 1] - turned[..., 1] * arm[..., 0]
        slope = 2 * np.concatenate([arm, lever[..., None]], axis=-1) * unit
        gap = (slope @ step[..., None])[..., 0] - (arm**2).sum(axis=-1) + linkage.radius[:, 0] ** 2
        across = np.swapaxes(slope, -1, -2)
        step = (across @ np.linalg.solve(slope @ across, gap[..., None]))[..., 0]
    return Displacement.from_poses(start + step * unit)


def _circles(dyads: Sequence[dict[str, Any]]) -> RR:
    """Two printed dyads, with an axis for the poses: (2, 1)."""
    fixed, moving = (np.array([[d[k]] for d in dyads]) for k in ("fixed_pivot", "moving_pivot"))
    return RR(fixed, moving, np.array([[d["radius"]] for d in dyads]))


def _root_of_e(p: FloatArray) -> FloatArray:
    """sqrt(E) of Eq. (18)."""
    root: FloatArray = np.linalg.norm(constraint_manifold.conditions(p), axis=-1)
    return root


def _sine(vectors: FloatArray, plane: FloatArray) -> FloatArray:
    """The sine of the angle of vectors (*, 8) with the plane of two orthonormal rows."""
    off = np.linalg.norm(vectors - vectors @ plane.T @ plane, axis=-1)
    sine: FloatArray = off / np.linalg.norm(vectors, axis=-1)
    return sine
