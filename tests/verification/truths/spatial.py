"""Spinning bodies without constraints: what is left of them in minimal coordinates."""

from __future__ import annotations

import numpy as np
from tests.verification.truths.problem import GRAVITY, Accuracy, Problem, integrated

from hydrodae.support.arrays import Array


def fast_rotor(time: Array, accuracy: Accuracy) -> Array:
    """Centre of gravity of a disc at 1000 rad/s, 0.2 m along its axis x from a fixed point.

    A symmetric top with the axis n and the angular momentum H about the fixed point: its turn about
    n does not move n, so that with the transverse inertia J

        n' = H x n / J,   H' = l n x (-m g e_z)
    """
    mass, arm, axial, transverse, spin = 2.0, 0.2, 0.01, 0.005, 1000.0
    across = transverse + mass * arm**2

    def rates(_t: float, s: Array) -> Array:
        nx, ny, nz, hx, hy, hz = s
        weight = mass * GRAVITY * arm
        return np.array(
            [
                (hy * nz - hz * ny) / across,
                (hz * nx - hx * nz) / across,
                (hx * ny - hy * nx) / across,
                -weight * ny,
                weight * nx,
                0.0,
            ]
        )

    start = [1.0, 0.0, 0.0, axial * spin, 0.0, 0.0]
    return np.asarray(arm * integrated(rates, start, time, accuracy)[:3].T)


def tumbling_body(time: Array, accuracy: Accuracy) -> Array:
    """Body rates and the body's x axis of a free body of inertia 1, 2, 3 kg m2.

    Euler: J w' = -w x J w; the rows of the rotation (world axes seen from the body) turn by
    r' = r x w, and the body's x axis is the first component of each.
    """
    inertia = np.array([1.0, 2.0, 3.0])

    def rates(_t: float, s: Array) -> Array:
        w, rows = s[:3], s[3:].reshape(3, 3)
        return np.asarray(np.r_[-np.cross(w, inertia * w) / inertia, np.cross(rows, w).ravel()])

    start = [0.01, 5.0, 0.01, *np.eye(3).ravel()]
    states = integrated(rates, start, time, accuracy)
    return np.asarray(np.r_[states[:3], states[3::3]].T)


PROBLEMS = {
    "fast_rotor": Problem(
        "DOP853, axis and angular momentum", ("comx", "comy", "comz"), 1.0, 0.005, fast_rotor, 1e-10
    ),
    "tumbling_body": Problem(
        "DOP853, body rates and rotation matrix",
        ("wx", "wy", "wz", "ex_x", "ex_y", "ex_z"),
        20.0,
        0.05,
        tumbling_body,
        2e-8,
    ),
}
