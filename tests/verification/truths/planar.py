"""Planar mechanisms in minimal coordinates, gravity along -y.

A mechanism of one angle with the kinetic energy T = I(a) a'^2 / 2 moves by

    I a'' + I_a a'^2 / 2 = Q(a)

I_a: slope of the inertia, Q: load along the angle. Those of several coordinates solve for the
accelerations with their whole mass matrix.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from tests.verification.truths.problem import FINE, GRAVITY, Accuracy, Problem, integrated

from hydrodae.support.arrays import Array


def pendulum(time: Array, accuracy: Accuracy) -> Array:
    """Point of 1 kg on a rod of 1 m, let go level at x = -1; tension = m (a'^2 L + g cos a).

    Jacobi, in the angle a from below: sin(a / 2) = k sn(K - w t), k = sin(a0 / 2); else DOP853.
    """
    from scipy.special import ellipj, ellipk

    rate, start = np.sqrt(GRAVITY), -0.5 * np.pi
    if accuracy is FINE:
        m = np.sin(0.5 * start) ** 2
        sn, cn, _dn, _phase = ellipj(ellipk(m) - rate * time, m)
        angle = -2.0 * np.arcsin(np.sqrt(m) * sn)
        speed = 2.0 * np.sqrt(m) * rate * cn
    else:
        angle, speed = integrated(
            lambda _t, s: [s[1], -GRAVITY * np.sin(s[0])], [start, 0.0], time, accuracy
        )
    tension = speed**2 + GRAVITY * np.cos(angle)
    return np.column_stack([np.sin(angle), -np.cos(angle), tension])


def four_bar(time: Array, accuracy: Accuracy) -> Array:
    """Two windows of uniform bars (1 m, 1 kg), uprights parallel, B0 at +1 m/s; angle from above.

    Three uprights turn about their feet, two couplers move as their ends do.
    """
    inertia, weight_arm = 3.0 / 3.0 + 2.0, 3.0 / 2.0 + 2.0  # kg m2, kg m
    angle, _speed = integrated(
        lambda _t, s: [s[1], weight_arm * GRAVITY * np.sin(s[0]) / inertia],
        [0.0, 1.0],
        time,
        accuracy,
    )
    return np.column_stack([np.sin(angle), np.cos(angle)])


def slider_crank(time: Array, accuracy: Accuracy) -> Array:
    """Crank and rod of 1 m and 1 kg, slider of 1 kg; the rod mirrors the crank, at 45 deg first.

    Centre of the rod (1.5 cos a, 0.5 sin a), slider (2 cos a, 0).
    """

    def rates(_t: float, s: Array) -> list[float]:
        sin, cos = np.sin(s[0]), np.cos(s[0])
        inertia = 1 / 3 + 1 / 12 + (1.5 * sin) ** 2 + (0.5 * cos) ** 2 + (2.0 * sin) ** 2
        slope = 2.0 * sin * cos * (1.5**2 - 0.5**2 + 2.0**2)
        return [s[1], (-GRAVITY * cos - 0.5 * slope * s[1] ** 2) / inertia]

    start = 0.25 * np.pi
    speed = 4.0 / (2.0 * np.sin(start))  # the slider at -4 m/s
    angle, _speed = integrated(rates, [start, speed], time, accuracy)
    return np.column_stack([2.0 * np.cos(angle), np.cos(angle), np.sin(angle)])


def door(time: Array, accuracy: Accuracy) -> Array:
    """Plate of 20 kg, 1 m by 0.04 m, about an upright edge that leans by 20 deg, from 90 deg."""
    mass, width, thickness = 20.0, 1.0, 0.04
    inertia = mass * ((width**2 + thickness**2) / 12.0 + (0.5 * width) ** 2)
    moment = mass * GRAVITY * np.sin(np.radians(20.0)) * 0.5 * width
    angle = integrated(
        lambda _t, s: [s[1], -moment / inertia * np.sin(s[0])], [0.5 * np.pi, 0.0], time, accuracy
    )[0]
    return np.asarray(angle[:, None])


def links(
    masses: Sequence[float], length: float, start: float, time: Array, accuracy: Accuracy
) -> Array:
    """(nt, n, 2) points of a chain of massless links, at rest, all angles from below at `start`.

    m_ij = sum of the masses from max(i, j) on; with d = a_i - a_j:
    sum_j m_ij L (cos d a_j'' + sin d a_j'^2) = -g m_ii sin a_i
    """
    n = len(masses)
    beyond = np.cumsum(np.asarray(masses)[::-1])[::-1]
    carried = beyond[np.maximum.outer(np.arange(n), np.arange(n))]

    def rates(_t: float, s: Array) -> Array:
        angle, speed = s[:n], s[n:]
        apart = angle[:, None] - angle[None, :]
        load = -(carried * np.sin(apart)) @ speed**2 - GRAVITY / length * beyond * np.sin(angle)
        return np.asarray(np.r_[speed, np.linalg.solve(carried * np.cos(apart), load)])

    angles = integrated(rates, [*[start] * n, *[0.0] * n], time, accuracy)[:n]
    steps = length * np.stack([np.sin(angles), -np.cos(angles)])
    return np.asarray(np.cumsum(steps, axis=1).transpose(2, 1, 0))


def chain(time: Array, accuracy: Accuracy) -> Array:
    """Ten points of 0.1 kg on ten links of 0.1 m, let go level."""
    points = links([0.1] * 10, 0.1, 0.5 * np.pi, time, accuracy)
    return np.column_stack([points[:, 4], points[:, 9]])


def light_joint(time: Array, accuracy: Accuracy) -> Array:
    """Two links of 1 m with 1e-6 kg between them and 1 kg at the end, both at 0.5 rad."""
    return links([1e-6, 1.0], 1.0, 0.5, time, accuracy)[:, 1]


def mass_ratio(time: Array, accuracy: Accuracy) -> Array:
    """1e6 kg in x on 1e6 N/m from x = 1 m, and 0.1 kg on 1 m below it, hanging at rest.

    (M + m) x'' + m L (cos a a'' - sin a a'^2) + k x = 0 and L a'' + cos a x'' + g sin a = 0; the
    second gives a'', which leaves one equation for x'' that does not cancel.
    """
    heavy, light, stiffness = 1e6, 0.1, 1e6

    def rates(_t: float, s: Array) -> list[float]:
        x, a, v, w = s
        sin, cos = np.sin(a), np.cos(a)
        load = light * sin * (w * w + GRAVITY * cos) - stiffness * x
        push = load / (heavy + light * sin * sin)
        return [v, w, push, -cos * push - GRAVITY * sin]

    x, a, _v, _w = integrated(rates, [1.0, 0.0, 0.0, 0.0], time, accuracy)
    return np.column_stack([x, x + np.sin(a), -np.cos(a)])


FINEST = Accuracy(3e-14, 1e-15)
RADAU = Accuracy(1e-9, 1e-12, "Radau")  # the mode of 3e3 rad/s is hardly excited

PROBLEMS = {
    "simple_pendulum": Problem(
        "Jacobi elliptic functions", ("x", "y", "rod_tension"), 10.0, 0.05, pendulum, 1e-10, FINEST
    ),
    "pendulum_1000s": Problem(
        "Jacobi elliptic functions", ("x", "y", "rod_tension"), 1000.0, 5.0, pendulum, 5e-8, FINEST
    ),
    "n_four_bar_2": Problem("DOP853, one angle", ("B0x", "B0y"), 10.0, 0.05, four_bar, 2e-8),
    "slider_crank_equal": Problem(
        "DOP853, one angle", ("slider_x", "pin_x", "pin_y"), 10.0, 0.05, slider_crank, 2e-8
    ),
    "door": Problem("DOP853, one angle", ("angle",), 10.0, 0.05, door, 1e-10),
    "chain_10": Problem(
        "DOP853, ten angles", ("xmid", "ymid", "xend", "yend"), 1.5, 0.01, chain, 1e-9
    ),
    "light_joint": Problem(
        "DOP853 and Radau, two angles", ("xend", "yend"), 5.0, 0.05, light_joint, 1e-9, RADAU
    ),
    "mass_ratio": Problem(
        "DOP853, two coordinates", ("buoy_x", "bob_x", "bob_y"), 20.0, 0.1, mass_ratio, 1e-10
    ),
}
