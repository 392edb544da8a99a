"""Motions of the scenes in minimal coordinates: closed forms, or DOP853 at a tight tolerance.

None of them shares a line with the solver: one angle instead of bodies and constraints.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from hydrodae.support.arrays import Array

GRAVITY = 9.81

#: End of rod 3 of the Bricard mechanism every 0.5 s [m]: DOP853 in relative angles with the speed
#: along the null space of the loop; two settings agree to 8e-14, energy is kept to 2e-13 J.
BRICARD_STEP = 0.5
BRICARD = np.array(
    [
        (1.0000000000, 1.0000000000, -1.0000000000),
        (0.7501466094, 0.9682836791, -1.2246251594),
        (0.1401231146, 0.5105014612, -1.6491675994),
        (0.1444556276, -0.5177294919, -1.6465384128),
        (0.7542780108, -0.9693403448, -1.2212468950),
        (0.9999831852, -0.9999999999, -1.0000168147),
        (0.7459831762, -0.9671998000, -1.2280202147),
        (0.1358393079, -0.5032159558, -1.6517631138),
        (0.1488358461, 0.5248995934, -1.6438760013),
        (0.7583772035, 0.9703702511, -1.2178857060),
        (0.9999327400, 0.9999999977, -1.0000672577),
        (0.7417878939, 0.9660882508, -1.2314317733),
        (0.1316052040, 0.4958734499, -1.6543245123),
        (0.1532627657, -0.5320113307, -1.6411808153),
        (0.7624440171, -0.9713738492, -1.2145418749),
        (0.9998486630, -0.9999999885, -1.0001513256),
        (0.7375609518, -0.9649485717, -1.2348595452),
        (0.1274217949, -0.4884744374, -1.6568513543),
        (0.1577353784, 0.5390642885, -1.6384533082),
        (0.7664782870, 0.9723515874, -1.2112156810),
        (0.9997309511, 0.9999999638, -1.0002690127),
    ]
)

#: End of the double pendulum with a middle mass of 1e-6 kg every 0.5 s [m]: DOP853 in two angles,
#: which resolves the fast mode of 5e3 rad/s (too slow to do again); Radau agrees to 3e-14.
LIGHT_JOINT_STEP = 0.5
LIGHT_JOINT = np.array(
    [
        (0.9588510772, -1.7551651238),
        (0.4601772070, -1.9463393687),
        (-0.5665195359, -1.9180864463),
        (-0.9516658632, -1.7590713700),
        (-0.3447152988, -1.9700688726),
        (0.6620387958, -1.8872478991),
        (0.9301238535, -1.7705563016),
        (0.2222156138, -1.9876167188),
        (-0.7454256204, -1.8558934895),
        (-0.8942797888, -1.7889280755),
        (-0.0950807823, -1.9977386328),
    ]
)


def integrated(
    rates: Callable[[float, Array], Sequence[float] | Array],
    start: Sequence[float],
    place: Callable[[Array], Sequence[Array]],
    rtol: float = 1e-12,
) -> Callable[[Array], Array]:
    """Return a truth by DOP853: `rates` of the state, and `place` of (n_states, nt) states."""
    known: dict[bytes, Array] = {}

    def truth(time: Array) -> Array:
        key = np.asarray(time).tobytes()
        if key not in known:
            known[key] = solve(time)
        return known[key]

    def solve(time: Array) -> Array:
        from scipy.integrate import solve_ivp

        if len(time) < 2:
            return np.column_stack(place(np.repeat(np.array(start)[:, None], len(time), axis=1)))
        span = (0.0, float(time[-1]))
        solved = solve_ivp(rates, span, start, "DOP853", t_eval=time, rtol=rtol, atol=0.1 * rtol)
        assert solved.success
        return np.column_stack(place(solved.y))

    return truth


def pendulum_angle(time: Array, rate: float, start: float) -> Array:
    """Angle from below of a pendulum let go at rest at `start` [rad]; `rate` of small swings."""
    from scipy.special import ellipj, ellipk

    m = np.sin(0.5 * start) ** 2
    sn = ellipj(ellipk(m) - rate * time, m)[0]
    return np.asarray(2.0 * np.arcsin(np.sin(0.5 * start) * sn))


def pendulum(time: Array) -> Array:
    """x, z of a point on a massless rod of 1 m, let go level at x = -1."""
    angle = -pendulum_angle(time, np.sqrt(GRAVITY), 0.5 * np.pi)
    return np.column_stack([np.sin(angle), -np.cos(angle)])


def door(time: Array) -> Array:
    """Angle of the door that leans by 20 deg, from 90 deg; relative to the start."""
    inertia = 20.0 * (1.0 + 0.04**2) / 12.0 + 20.0 * 0.25
    rate = np.sqrt(20.0 * GRAVITY * np.sin(np.radians(20.0)) * 0.5 / inertia)
    return np.asarray(pendulum_angle(time, rate, 0.5 * np.pi)[:, None] - 0.5 * np.pi)


four_bar = (
    integrated(  # all uprights parallel; angle from above; effective inertia 3, weight arm 3.5
        lambda _t, s: [s[1], 3.5 / 3.0 * GRAVITY * np.sin(s[0])],
        [0.0, 1.0],
        lambda s: [np.sin(s[0]), np.cos(s[0])],
    )
)


def _slider_crank(_t: float, s: Array) -> list[float]:
    sin, cos = np.sin(s[0]), np.cos(s[0])
    inertia = 1.0 / 3.0 + 2.25 * sin**2 + 0.25 * cos**2 + 1.0 / 12.0 + 4.0 * sin**2
    return [s[1], (-6.0 * sin * cos * s[1] ** 2 - GRAVITY * cos) / inertia]


slider_crank = integrated(  # the rod mirrors the crank
    _slider_crank, [0.25 * np.pi, 2.0 * np.sqrt(2.0)], lambda s: [2.0 * np.cos(s[0])]
)


def lock(time: Array) -> Array:
    """Place x of the slider, crank of 1 m at 1 rad/s, rod of 0.5 m; until asin(0.5) s."""
    return np.asarray((np.cos(time) + np.sqrt(0.25 - np.sin(time) ** 2))[:, None])


def bricard(time: Array) -> Array:
    """End of rod 3, at multiples of BRICARD_STEP only."""
    return np.asarray(BRICARD[np.rint(time / BRICARD_STEP).astype(int)])


def light_joint(time: Array) -> Array:
    """End of the double pendulum with a light joint, at multiples of LIGHT_JOINT_STEP only."""
    return np.asarray(LIGHT_JOINT[np.rint(time / LIGHT_JOINT_STEP).astype(int)])


def _buoy_pendulum(_t: float, s: Array) -> Array:
    x, a, v, w = s
    coupling = 0.1 * np.cos(a)  # kg m; rows scaled by 1e6 kg and 0.1 kg m2
    mass = np.array([[1.0 + 1e-7, coupling / 1e6], [coupling / 0.1, 1.0]])
    load = [1e-7 * np.sin(a) * w * w - x, -GRAVITY * np.sin(a)]
    return np.asarray(np.r_[v, w, np.linalg.solve(mass, load)])


mass_ratio = integrated(
    _buoy_pendulum, [1.0, 0.0, 0.0, 0.0], lambda s: [s[0] + np.sin(s[1]), -np.cos(s[1])]
)


def cross(a: Sequence[float] | Array, b: Sequence[float] | Array) -> Array:
    """a x b of two vectors, in a twentieth of the time of `np.cross`."""
    (p, q, r), (x, y, z) = a, b
    return np.array([q * z - r * y, r * x - p * z, p * y - q * x])


def top(mass: float, arm: Array, inertia: Array, rates: Array) -> Callable[[Array], Array]:
    """Truth of a body on a spherical joint at the origin: its centre of gravity, `arm` at first.

    `inertia` is about the joint; the state is the quaternion and the body rates.
    """

    def matrix(p: Array) -> Array:
        w, x, y, z = p / np.linalg.norm(p, axis=0)
        rows = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        return np.array(rows)

    def turning(_t: float, s: Array) -> Array:
        w, x, y, z = s[:4]
        a, b, c = s[4:]
        change = [-x * a - y * b - z * c, w * a + y * c - z * b, w * b + z * a - x * c,
                  w * c + x * b - y * a]  # fmt: skip
        moment = cross(arm, -mass * GRAVITY * matrix(s[:4])[2])
        spin = (moment - cross(s[4:], inertia * s[4:])) / inertia
        return np.concatenate([0.5 * np.array(change), spin])

    def place(s: Array) -> list[Array]:
        return list(np.einsum("ijt,j->it", matrix(s[:4]), arm))

    return integrated(turning, [1.0, 0.0, 0.0, 0.0, *rates], place, rtol=1e-10)


def linear(system: Array, start: Sequence[float], row: int) -> Callable[[Array], Array]:
    """Truth of y' = system y, its component `row`, by the eigenvectors of `system`."""
    values, vectors = np.linalg.eig(system)
    weights = vectors[row] * np.linalg.solve(vectors, np.array(start, dtype=complex))
    return lambda time: np.asarray((np.exp(np.outer(time, values)) @ weights).real[:, None])


def stiff_pair(stiffness: float, soft: float) -> Callable[[Array], Array]:
    """Truth of x of two carts of 1 kg joined by `stiffness`, one on `soft` to the ground [N/m].

    Both let go at x = 1 at rest. Closed form by the two modes, the slow one without cancellation.
    """
    k, c = stiffness, soft
    fast = k + 0.5 * c + np.sqrt(k * k + 0.25 * c * c)
    squares = np.array([k * c / fast, fast])  # of the rates: their product is k c
    # rows of a mode (a, b): k a = (k - w^2) b and (k + c - w^2) a = k b
    shapes = np.array([[1.0 - squares[0] / k, 1.0], [1.0, -k / (fast - k)]]).T
    weights = np.linalg.solve(shapes, [1.0, 1.0])
    rates = np.sqrt(squares)
    return lambda time: np.asarray(np.cos(np.outer(time, rates)) @ (shapes * weights).T)
