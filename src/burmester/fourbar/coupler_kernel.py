# cython: language_level=3, infer_types=True
# cython: boundscheck=False, wraparound=False, cdivision=True, initializedcheck=False
"""Couplers at their places, one after the other; compiled.

Places are rows (x, y, length x angle), see `foot_points`; kinds and dimensions are those of
`LinkageBatch`.  Of each dyad the constraint manifold is, with d = x + iy and t = e^(i angle),

    f = round |d|² + Re(d* (still + turned t)) + Re(both t) + constant = 0,

the eight coefficients of `constraint_manifold` in another order.  RR is scaled by 1 / (2 r), lines
by 1, so that f is near its zero the distance from the constraint.
"""

import cython

if not cython.compiled:
    raise ImportError("burmester's kernels are not compiled: install it again, by scripts/setup")

from cython.cimports.libc.math import NAN, atan2, cos, fabs, hypot, isnan, sin, sqrt

RR = cython.declare(cython.int, 0)  # kinds of dyads, as in `linkage_batch.DYAD_KINDS`
PR = cython.declare(cython.int, 1)
RP = cython.declare(cython.int, 2)
STRIDE = cython.declare(cython.double, 1e-7)  # of difference quotients
PI = cython.declare(cython.double, 3.141592653589793)
MAX_STEP_LENGTH = cython.declare(cython.double, 0.3)  # lengths; a longer step is shortened to it
MIN_CURVATURE = cython.declare(cython.double, 0.2)  # of half the squared distance along the circuit
# Squared sine between the dyads' forces.  Forces with a smaller one count as having this one.
PARALLEL_FORCES = cython.declare(cython.double, 1e-20)
TINY = cython.declare(cython.double, 2.3e-308)  # keeps what is above 0 from dividing by 0


@cython.cclass
class Dyad:
    """A dyad's constraint manifold, and what it is at the place that was looked at last.

    f; force_x, force_y, moment: its derivatives by d and the angle; arm: turned t; swing: the real
    part of d* turned t + both t, which is minus the second derivative by the angle.
    """

    kind: cython.int
    z: cython.double[5]
    round: cython.double
    still_x: cython.double
    still_y: cython.double
    turned_x: cython.double
    turned_y: cython.double
    both_x: cython.double
    both_y: cython.double
    constant: cython.double
    f: cython.double
    force_x: cython.double
    force_y: cython.double
    moment: cython.double
    arm_x: cython.double
    arm_y: cython.double
    swing: cython.double
    slope: cython.double[5]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def take(self, kind: cython.int, z: cython.const[cython.double][:]) -> cython.void:
        """Be the dyad of a kind with five dimensions."""
        self.kind = kind
        for i in range(5):
            self.z[i] = z[i]
        self.form()

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def nudge(self, number: cython.Py_ssize_t) -> cython.void:
        """Let one dimension be longer by the stride of difference quotients."""
        self.z[number] += STRIDE
        self.form()

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def form(self) -> cython.void:
        """Set the coefficients of the constraint manifold."""
        z = self.z
        self.round = self.still_x = self.still_y = self.turned_x = self.turned_y = 0.0
        if self.kind == RR:
            c_x, c_y, m_x, m_y, r = z[0], z[1], z[2], z[3], z[4]
            self.round = 0.5 / r
            self.still_x, self.still_y = -c_x / r, -c_y / r
            self.turned_x, self.turned_y = m_x / r, m_y / r
            self.both_x, self.both_y = -(m_x * c_x + m_y * c_y) / r, -(m_y * c_x - m_x * c_y) / r
            square: cython.double = m_x * m_x + m_y * m_y + c_x * c_x + c_y * c_y
            self.constant = (square / r - r) / 2
        elif self.kind == PR:
            n_x, n_y = cos(z[0]), sin(z[0])
            self.still_x, self.still_y = n_x, n_y
            self.both_x, self.both_y = n_x * z[2] + n_y * z[3], n_x * z[3] - n_y * z[2]
            self.constant = -z[1]
        else:
            n_x, n_y = cos(z[2]), sin(z[2])
            self.turned_x, self.turned_y = -n_x, -n_y
            self.both_x, self.both_y = n_x * z[0] + n_y * z[1], n_y * z[0] - n_x * z[1]
            self.constant = -z[3]

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def look(
        self, x: cython.double, y: cython.double, cosine: cython.double, sine: cython.double
    ) -> cython.void:
        """Set f and its derivatives at a place."""
        self.arm_x = self.turned_x * cosine - self.turned_y * sine
        self.arm_y = self.turned_x * sine + self.turned_y * cosine
        self.swing = x * self.arm_x + y * self.arm_y + self.both_x * cosine - self.both_y * sine
        self.moment = y * self.arm_x - x * self.arm_y - self.both_x * sine - self.both_y * cosine
        self.f = self.round * (x * x + y * y) + x * self.still_x + y * self.still_y
        self.f += self.swing + self.constant
        self.force_x = 2 * self.round * x + self.still_x + self.arm_x
        self.force_y = 2 * self.round * y + self.still_y + self.arm_y

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def bend(self, v_x: cython.double, v_y: cython.double, omega: cython.double) -> cython.double:
        """The second derivative of f along a velocity."""
        turning: cython.double = 2 * omega * (v_y * self.arm_x - v_x * self.arm_y)
        speed: cython.double = v_x * v_x + v_y * v_y
        return 2 * self.round * speed + turning - omega * omega * self.swing

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def differentiate(
        self, x: cython.double, y: cython.double, cosine: cython.double, sine: cython.double
    ) -> cython.void:
        """Set `slope`: the derivatives of f by the dimensions, at a place that was looked at."""
        f_x, f_y = self.force_x, self.force_y
        if self.kind == RR:
            self.slope[0], self.slope[1] = -f_x, -f_y
        elif self.kind == PR:
            p_x: cython.double = x + self.z[2] * cosine - self.z[3] * sine
            p_y: cython.double = y + self.z[2] * sine + self.z[3] * cosine
            self.slope[0], self.slope[1] = f_x * p_y - f_y * p_x, -1.0
        else:
            p_x: cython.double = self.z[0] - x
            p_y: cython.double = self.z[1] - y
            self.slope[0], self.slope[1] = -f_x, -f_y
            self.slope[2], self.slope[3] = f_y * p_x - f_x * p_y, -1.0
        if self.kind != RP:
            self.slope[2] = f_x * cosine + f_y * sine
            self.slope[3] = f_y * cosine - f_x * sine
        self.slope[4] = -(f_x * f_x + f_y * f_y + 1) / 2 if self.kind == RR else 0.0


@cython.cclass
class Coupler:
    """The coupler of two dyads, at the place that was looked at last.

    cosine, sine: of its angle; moment1, moment2: by length x angle; a, b, c, det: the products 11,
    12, 22 of both forces in the space of rows, and their determinant, above 0.
    """

    one: Dyad
    two: Dyad
    length: cython.double
    x: cython.double
    y: cython.double
    angle: cython.double
    cosine: cython.double
    sine: cython.double
    moment1: cython.double
    moment2: cython.double
    a: cython.double
    b: cython.double
    c: cython.double
    det: cython.double

    def __init__(self, length: cython.double) -> None:
        self.one, self.two, self.length = Dyad(), Dyad(), length

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def take(
        self, kinds: cython.const[cython.schar][:], z: cython.const[cython.double][:, :]
    ) -> cython.void:
        """Be the coupler of a linkage."""
        self.one.take(kinds[0], z[0])
        self.two.take(kinds[1], z[1])

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def look(self, x: cython.double, y: cython.double, along: cython.double) -> cython.void:
        """Set what belongs to a place."""
        self.x, self.y, self.angle = x, y, along / self.length
        self.cosine, self.sine = cos(self.angle), sin(self.angle)
        self.one.look(x, y, self.cosine, self.sine)
        self.two.look(x, y, self.cosine, self.sine)
        m1: cython.double = self.one.moment / self.length
        m2: cython.double = self.two.moment / self.length
        x1, y1, x2, y2 = self.one.force_x, self.one.force_y, self.two.force_x, self.two.force_y
        a: cython.double = x1 * x1 + y1 * y1 + m1 * m1
        b: cython.double = x1 * x2 + y1 * y2 + m1 * m2
        c: cython.double = x2 * x2 + y2 * y2 + m2 * m2
        self.moment1, self.moment2, self.a, self.b, self.c = m1, m2, a, b, c
        self.det = max(a * c - b * b, PARALLEL_FORCES * a * c) + TINY

    @cython.cfunc
    @cython.nogil
    @cython.exceptval(check=False)
    def step(
        self, row: cython.double[:], target: cython.const[cython.double][:], ahead: cython.bint
    ) -> cython.double:
        """Newton's step from a row, back onto both manifolds.

        Also along their intersection to the place nearest to the target, if not straight ahead.
        Returns its size before it is shortened.
        """
        self.look(row[0], row[1], row[2])
        a, b, c, det, m1, m2 = self.a, self.b, self.c, self.det, self.moment1, self.moment2
        x1, y1, f1 = self.one.force_x, self.one.force_y, self.one.f
        x2, y2, f2 = self.two.force_x, self.two.force_y, self.two.f
        back1: cython.double = (c * f1 - b * f2) / det
        back2: cython.double = (a * f2 - b * f1) / det
        step_x: cython.double = -back1 * x1 - back2 * x2
        step_y: cython.double = -back1 * y1 - back2 * y2
        step_a: cython.double = -back1 * m1 - back2 * m2
        if not ahead:
            to_x: cython.double = target[0] - row[0]
            to_y: cython.double = target[1] - row[1]
            to_a: cython.double = target[2] - row[2]
            # The target's distance as a combination of both forces, and how the manifolds bend.
            product1: cython.double = x1 * to_x + y1 * to_y + m1 * to_a
            product2: cython.double = x2 * to_x + y2 * to_y + m2 * to_a
            along_x: cython.double = y1 * m2 - y2 * m1
            along_y: cython.double = x2 * m1 - x1 * m2
            omega: cython.double = x1 * y2 - y1 * x2
            bend1: cython.double = self.one.bend(along_x, along_y, omega / self.length)
            bend2: cython.double = self.two.bend(along_x, along_y, omega / self.length)
            curvature: cython.double = (c * product1 - b * product2) * bend1
            curvature += (a * product2 - b * product1) * bend2
            curvature = max(1 + curvature / (det * det), MIN_CURVATURE)
            distance: cython.double = along_x * to_x + along_y * to_y + omega * to_a
            distance = distance / det / curvature
            step_x += distance * along_x
            step_y += distance * along_y
            step_a += distance * omega
        size: cython.double = max(fabs(step_x), fabs(step_y), fabs(step_a))
        part: cython.double = MAX_STEP_LENGTH / size if size > MAX_STEP_LENGTH else 1.0
        row[0] += part * step_x
        row[1] += part * step_y
        row[2] += part * step_a
        return NAN if isnan(step_x) else size


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def transmission_sine(lead: Dyad, follow: Dyad, coupler: Coupler) -> cython.double:
    """The signed sine of the transmission angle at the coupler's place: see `transmission`."""
    slot: cython.bint = lead.kind == RP
    slot2: cython.bint = follow.kind == RP
    l_x, l_y, f_x, f_y = lead.force_x, lead.force_y, follow.force_x, follow.force_y
    across: cython.double = l_x * f_y - l_y * f_x
    if slot:
        return across
    hand_x: cython.double = lead.z[2] * coupler.cosine - lead.z[3] * coupler.sine
    hand_y: cython.double = lead.z[2] * coupler.sine + lead.z[3] * coupler.cosine
    # det(effort, own force, other force), by its moments; the effort is across the own force.
    det: cython.double = (hand_x * l_x + hand_y * l_y) * across
    det += lead.moment * (l_x * f_x + l_y * f_y) - follow.moment * (l_x * l_x + l_y * l_y)
    if slot2:
        return det / hypot(follow.z[0] - coupler.x - hand_x, follow.z[1] - coupler.y - hand_y)
    return det / hypot(follow.z[2] - lead.z[2], follow.z[3] - lead.z[3])


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def input_there(lead: Dyad, coupler: Coupler) -> cython.double:
    """The input, see `loop_closure`, at the coupler's place."""
    if lead.kind == RP:
        return coupler.angle + lead.z[2]
    pin_x: cython.double = coupler.x + lead.z[2] * coupler.cosine - lead.z[3] * coupler.sine
    pin_y: cython.double = coupler.y + lead.z[2] * coupler.sine + lead.z[3] * coupler.cosine
    if lead.kind == RR:
        return atan2(pin_y - lead.z[1], pin_x - lead.z[0])
    return pin_y * cos(lead.z[0]) - pin_x * sin(lead.z[0])


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def least_cosine(lead: Dyad, follow: Dyad, both: cython.double) -> cython.double:
    """The cosine of the transmission angle where it may be least: see `transmission`."""
    z, z2, kind, kind2 = lead.z, follow.z, lead.kind, follow.kind
    ground: cython.double = hypot(z2[0] - z[0], z2[1] - z[1])
    far: cython.double = fabs(ground - both * z[4])
    if kind == PR:
        far = fabs(z2[0] * cos(z[0]) + z2[1] * sin(z[0]) - z[1])
    arm: cython.double = hypot(z2[2] - z[2], z2[3] - z[3])
    if kind != RP and kind2 == RR:
        return (arm * arm + z2[4] * z2[4] - far * far) / (2 * arm * z2[4])
    if kind == RR and kind2 == PR:
        rail: cython.double = z2[1] - z[0] * cos(z2[0]) - z[1] * sin(z2[0])
        return (rail - both * z[4]) / arm
    if kind != RP and kind2 == RP:
        return (z2[3] - z[2] * cos(z2[2]) - z[3] * sin(z2[2])) / far
    if kind == RP and kind2 == RR:
        slot: cython.double = z2[2] * cos(z[2]) + z2[3] * sin(z[2]) - z[3]
        return (both * ground + slot) / z2[4]
    return NAN


@cython.cfunc
@cython.nogil
@cython.exceptval(check=False)
def least_input(lead: Dyad, follow: Dyad) -> cython.double:
    """The first of the inputs that belong to `least_cosine`."""
    if lead.kind == RR and follow.kind == PR:
        return follow.z[0]
    x: cython.double = follow.z[0] - lead.z[0]
    y: cython.double = follow.z[1] - lead.z[1]
    if lead.kind == RR:
        return atan2(y, x)
    if lead.kind == PR:
        return follow.z[1] * cos(lead.z[0]) - follow.z[0] * sin(lead.z[0])
    return atan2(-y, -x)


def walk(
    kinds: cython.const[cython.schar][:, :],
    dimensions: cython.const[cython.double][:, :, :],
    rows: cython.double[:, :, :],
    target: cython.const[cython.double][:, :, :],
    length: cython.double,
    ahead: cython.bint,
    steps: cython.int,
    close: cython.double,
    size: cython.double[:, :],
) -> None:
    """Move rows (k, N, 3) by Newton's steps to the places nearest to targets, or straight ahead.

    Each until its step is at most `close`, relative to 1 plus the greatest number in its row.
    size: (k, N), set to those of the last steps, before they were shortened; nan where one has no
    value.
    """
    coupler: Coupler = Coupler(length)
    for k in range(rows.shape[0]):
        coupler.take(kinds[k], dimensions[k])
        for n in range(rows.shape[1]):
            row = rows[k, n]
            for _ in range(steps):
                size[k, n] = coupler.step(row, target[k, n], ahead)
                far: cython.double = max(fabs(row[0]), fabs(row[1]), fabs(row[2]))
                if not size[k, n] > close * (1 + far):
                    break


def constraint_jacobians(
    kinds: cython.const[cython.schar][:, :],
    dimensions: cython.const[cython.double][:, :, :],
    places: cython.const[cython.double][:, :, :],
    miss: cython.double[:, :, :],
    force: cython.double[:, :, :, :],
    by_dimension: cython.double[:, :, :, :],
) -> None:
    """Set f (k, 2, n), its derivatives by place (k, 2, n, 3) and by dimension (k, 2, n, 5).

    places: (k, n, 3), of x, y and angle.
    """
    dyad: Dyad = Dyad()
    for k in range(places.shape[0]):
        for side in range(2):
            dyad.take(kinds[k, side], dimensions[k, side])
            for n in range(places.shape[1]):
                x, y = places[k, n, 0], places[k, n, 1]
                cosine: cython.double = cos(places[k, n, 2])
                sine: cython.double = sin(places[k, n, 2])
                dyad.look(x, y, cosine, sine)
                dyad.differentiate(x, y, cosine, sine)
                miss[k, side, n] = dyad.f
                force[k, side, n, 0], force[k, side, n, 1] = dyad.force_x, dyad.force_y
                force[k, side, n, 2] = dyad.moment
                for i in range(5):
                    by_dimension[k, side, n, i] = dyad.slope[i]


def normal_parts(
    kinds: cython.const[cython.schar][:, :],
    dimensions: cython.const[cython.double][:, :, :],
    rows: cython.double[:, :, :],
    wanted: cython.const[cython.double][:, :],
    length: cython.double,
    off: cython.double,
    residual: cython.double[:, :, :],
    jacobian: cython.double[:, :, :, :],
    place_jacobian: cython.double[:, :, :, :],
    ways: cython.bint,
) -> None:
    """Set the components (k, N, 2) of rows minus wanted ones (N, 3) that are normal to the motion.

    In an orthonormal basis, with their derivatives (k, N, 2, 10) by the dimensions, and those of
    the places (k, N, 3, 10), which are followed by N unknowns, a step along the motion for each
    place, if there are ways.  Rows off the linkage by more than `off` become nan.
    """
    coupler: Coupler = Coupler(length)
    one, two = coupler.one, coupler.two
    normal1 = cython.declare(cython.double[3])
    normal2 = cython.declare(cython.double[3])
    for k in range(rows.shape[0]):
        coupler.take(kinds[k], dimensions[k])
        for n in range(rows.shape[1]):
            x, y = rows[k, n, 0], rows[k, n, 1]
            coupler.look(x, y, rows[k, n, 2])
            one.differentiate(x, y, coupler.cosine, coupler.sine)
            two.differentiate(x, y, coupler.cosine, coupler.sine)
            if not (fabs(one.f) < off and fabs(two.f) < off):
                rows[k, n, 0] = rows[k, n, 1] = rows[k, n, 2] = NAN
            first: cython.double = sqrt(coupler.a)
            height: cython.double = sqrt(coupler.det / coupler.a)
            lean: cython.double = coupler.b / coupler.a
            normal1[0], normal1[1] = one.force_x / first, one.force_y / first
            normal1[2] = coupler.moment1 / first
            normal2[0] = (two.force_x - lean * one.force_x) / height
            normal2[1] = (two.force_y - lean * one.force_y) / height
            normal2[2] = (coupler.moment2 - lean * coupler.moment1) / height
            residual[k, n, 0] = residual[k, n, 1] = 0.0
            for j in range(3):
                gap: cython.double = rows[k, n, j] - wanted[n, j]
                residual[k, n, 0] += normal1[j] * gap
                residual[k, n, 1] += normal2[j] * gap
            for i in range(5):
                jacobian[k, n, 0, i], jacobian[k, n, 0, 5 + i] = -one.slope[i] / first, 0.0
                jacobian[k, n, 1, i] = lean / height * one.slope[i]
                jacobian[k, n, 1, 5 + i] = -two.slope[i] / height
            for j in range(3):
                for i in range(10):
                    place_jacobian[k, n, j, i] = (
                        normal1[j] * jacobian[k, n, 0, i] + normal2[j] * jacobian[k, n, 1, i]
                    )
            if ways:
                root: cython.double = sqrt(coupler.det)
                m1, m2 = coupler.moment1, coupler.moment2
                place_jacobian[k, n, 0, 10 + n] = (one.force_y * m2 - m1 * two.force_y) / root
                place_jacobian[k, n, 1, 10 + n] = (m1 * two.force_x - one.force_x * m2) / root
                place_jacobian[k, n, 2, 10 + n] = (
                    one.force_x * two.force_y - one.force_y * two.force_x
                ) / root


def transmissions(
    kinds: cython.const[cython.schar][:, :],
    dimensions: cython.const[cython.double][:, :, :],
    rows: cython.const[cython.double][:, :, :],
    length: cython.double,
    driver: cython.const[cython.Py_ssize_t][:],
    sine: cython.double[:, :],
    drive: cython.double[:, :],
) -> None:
    """Set the sines of the transmission angle and the inputs (k, N) at rows (k, N, 3)."""
    coupler: Coupler = Coupler(length)
    for k in range(rows.shape[0]):
        coupler.take(kinds[k], dimensions[k])
        lead, follow = coupler.one, coupler.two
        if driver[k] == 1:
            lead, follow = follow, lead
        for n in range(rows.shape[1]):
            coupler.look(rows[k, n, 0], rows[k, n, 1], rows[k, n, 2])
            sine[k, n] = transmission_sine(lead, follow, coupler)
            drive[k, n] = input_there(lead, coupler)


def transmission_slopes(
    kinds: cython.const[cython.schar][:, :],
    dimensions: cython.const[cython.double][:, :, :],
    rows: cython.const[cython.double][:, :, :],
    place_jacobian: cython.const[cython.double][:, :, :, :],
    length: cython.double,
    driver: cython.const[cython.Py_ssize_t][:],
    sine: cython.double[:, :],
    drive: cython.double[:, :],
    sine_slope: cython.double[:, :, :],
    drive_slope: cython.double[:, :, :],
) -> None:
    """Set what `transmissions` does, and difference quotients (k, N, 11) of it.

    place_jacobian: (k, N, 3, n), derivatives of the places by the ten dimensions, and by each
    place's own step along the motion: the last of the eleven quotients.
    """
    transmissions(kinds, dimensions, rows, length, driver, sine, drive)
    coupler: Coupler = Coupler(length)
    ways: cython.bint = place_jacobian.shape[3] > 10
    for k in range(rows.shape[0]):
        coupler.take(kinds[k], dimensions[k])
        lead, follow = coupler.one, coupler.two
        if driver[k] == 1:
            lead, follow = follow, lead
        for i in range(11):
            if i < 10:
                coupler.take(kinds[k], dimensions[k])
                side = coupler.one if i < 5 else coupler.two
                side.nudge(i % 5)
            for n in range(rows.shape[1]):
                if i == 10 and not ways:
                    sine_slope[k, n, i] = drive_slope[k, n, i] = 0.0
                    continue
                column: cython.Py_ssize_t = i if i < 10 else 10 + n
                coupler.look(
                    rows[k, n, 0] + STRIDE * place_jacobian[k, n, 0, column],
                    rows[k, n, 1] + STRIDE * place_jacobian[k, n, 1, column],
                    rows[k, n, 2] + STRIDE * place_jacobian[k, n, 2, column],
                )
                gained: cython.double = transmission_sine(lead, follow, coupler) - sine[k, n]
                sine_slope[k, n, i] = gained / STRIDE
                gained = input_there(lead, coupler) - drive[k, n]
                if lead.kind == RR and fabs(gained) > PI:  # past the end of a turn
                    gained -= 2 * PI if gained > 0 else -2 * PI
                drive_slope[k, n, i] = gained / STRIDE
            if i == 9:
                coupler.take(kinds[k], dimensions[k])


def least_transmissions(
    kinds: cython.const[cython.schar][:, :],
    dimensions: cython.const[cython.double][:, :, :],
    driver: cython.const[cython.Py_ssize_t][:],
    at: cython.double[:, :],
    cosine: cython.double[:, :],
    slope: cython.double[:, :, :],
) -> None:
    """Set the inputs (k, 2) where the transmission angle may be least, and its cosines there.

    With difference quotients (k, 2, 10) of the cosines by the dimensions.
    """
    coupler: Coupler = Coupler(1.0)
    for k in range(kinds.shape[0]):
        coupler.take(kinds[k], dimensions[k])
        lead, follow = coupler.one, coupler.two
        if driver[k] == 1:
            lead, follow = follow, lead
        at[k, 0] = least_input(lead, follow)
        at[k, 1] = NAN if lead.kind == PR else at[k, 0] + PI
        cosine[k, 0], cosine[k, 1] = (
            least_cosine(lead, follow, 1.0),
            least_cosine(lead, follow, -1.0),
        )
        for i in range(10):
            side = coupler.one if i < 5 else coupler.two
            before: cython.double = side.z[i % 5]
            side.z[i % 5] += STRIDE
            slope[k, 0, i] = (least_cosine(lead, follow, 1.0) - cosine[k, 0]) / STRIDE
            slope[k, 1, i] = (least_cosine(lead, follow, -1.0) - cosine[k, 1]) / STRIDE
            side.z[i % 5] = before
