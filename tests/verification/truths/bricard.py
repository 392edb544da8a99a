"""Bricard's mechanism: five rods along the edges of a cube, six hinges, one degree of freedom.

Coordinates are the angles of the first five hinges from the cube; the sixth hinge closes the loop:
its point stays in place (3 rows), its axis stays along x of the ground (2 rows). Of these five rows
four are independent in every pose. The motion is that along the null direction n of the rows,

    q' = n (n . u),   u' = c + n a

c the least q'' that the closed loop needs, a from the equation of motion along n.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from tests.verification.truths.problem import GRAVITY, Accuracy, Problem, integrated

from hydrodae.support.arrays import Array

CORNERS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, -1, 0], [1, -1, 1], [0, -1, 1], [0, 0, 1]], dtype=float
)
AXES = np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]], dtype=float)
RODS = np.diff(CORNERS, axis=0)
MASS, ALONG, ACROSS = 1.0, 0.1**2 / 6.0, (1.0 + 0.1**2) / 12.0  # kg, kg m2
DOWN = np.array([0.0, -GRAVITY, 0.0])


def rotation(axis: Array, angle: float) -> Array:
    """Rodrigues."""
    k = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.asarray(np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k)


@dataclass
class Frame:
    """A point that rides on a rod: place, gradients (3, 5) and accelerations at q'' = 0."""

    place: Array
    turn: Array
    rate: Array
    by_place: Array
    by_turn: Array
    bias: Array
    bias_turn: Array

    def moved(self, arm: Array) -> Frame:
        """The point at `arm` (world axes) from this one on the same rod."""
        return Frame(
            self.place + arm,
            self.turn,
            self.rate,
            self.by_place + np.cross(self.by_turn.T, arm).T,
            self.by_turn,
            self.bias
            + np.cross(self.bias_turn, arm)
            + np.cross(self.rate, np.cross(self.rate, arm)),
            self.bias_turn,
        )

    def hinged(self, index: int, angle: float, speed: float) -> Frame:
        """The same point on the next rod."""
        axis = self.turn @ AXES[index]
        by_turn = self.by_turn.copy()
        by_turn[:, index] = axis
        return Frame(
            self.place,
            self.turn @ rotation(AXES[index], angle),
            self.rate + axis * speed,
            self.by_place,
            by_turn,
            self.bias,
            self.bias_turn + np.cross(self.rate, axis) * speed,
        )


def frames(q: Array, u: Array) -> tuple[list[Frame], Frame]:
    """Centres of the rods, and the end of the last one."""
    zero = np.zeros(3)
    here = Frame(CORNERS[0], np.eye(3), zero, np.zeros((3, 5)), np.zeros((3, 5)), zero, zero)
    centres = []
    for i in range(5):
        here = here.hinged(i, q[i], u[i])
        rod = here.turn @ RODS[i]
        centres.append(here.moved(0.5 * rod))
        here = here.moved(rod)
    return centres, here


def closing(end: Frame) -> tuple[Array, Array]:
    """Rows (5, 5) of the sixth hinge and their accelerations at q'' = 0 (5,)."""
    axis = end.turn @ AXES[5]
    by_axis = np.cross(end.by_turn.T, axis).T
    bias = np.cross(end.bias_turn, axis) + np.cross(end.rate, np.cross(end.rate, axis))
    return np.vstack([end.by_place, by_axis[1:]]), np.r_[end.bias, bias[1:]]


def null_direction(q: Array) -> Array:
    """Of the rows in a pose; its sign is of no account."""
    return np.asarray(np.linalg.svd(closing(frames(q, np.zeros(5))[1])[0])[2][-1])


def rates(_t: float, s: Array) -> Array:
    """State: five angles and their rates."""
    q, n = s[:5], null_direction(s[:5])
    u = n * (n @ s[5:])
    centres, end = frames(q, u)
    rows, bias = closing(end)
    left, values, right = np.linalg.svd(rows)
    beside = -right[:4].T @ ((left[:, :4].T @ bias) / values[:4])
    inertia: Any = 0.0
    load: Any = 0.0
    for centre, rod in zip(centres, RODS, strict=True):
        matrix = ACROSS * np.eye(3) + (ALONG - ACROSS) * np.outer(rod, rod)
        matrix = centre.turn @ matrix @ centre.turn.T
        moves, turns = centre.by_place @ n, centre.by_turn @ n
        inertia += MASS * moves @ moves + turns @ matrix @ turns
        load += MASS * moves @ (DOWN - centre.bias - centre.by_place @ beside)
        spin = np.cross(centre.rate, matrix @ centre.rate)
        load -= turns @ (matrix @ (centre.bias_turn + centre.by_turn @ beside) + spin)
    return np.asarray(np.r_[u, beside + n * load / inertia])


def energy(s: Array) -> float:
    """Kinetic and potential energy of a state, J; a witness of the motion."""
    total: Any = 0.0
    for centre, rod in zip(frames(s[:5], s[5:])[0], RODS, strict=True):
        matrix = ACROSS * np.eye(3) + (ALONG - ACROSS) * np.outer(rod, rod)
        velocity, local = centre.by_place @ s[5:], centre.turn.T @ centre.rate
        total += 0.5 * MASS * velocity @ velocity + 0.5 * local @ matrix @ local
        total -= MASS * DOWN @ centre.place
    return float(total)


def bricard(time: Array, accuracy: Accuracy) -> Array:
    """End of the third rod."""
    states = integrated(rates, [0.0] * 10, time, accuracy).T
    gaps = [np.abs(frames(s[:5], s[5:])[1].place - CORNERS[5]).max() for s in states]
    assert max(gaps) < 1e-9
    assert np.ptp([energy(s) for s in states]) < 1e-8

    def third(s: Array) -> Array:
        centre = frames(s[:5], s[5:])[0][2]
        return np.asarray(centre.place + 0.5 * (centre.turn @ RODS[2]))

    return np.array([third(s) for s in states])


PROBLEMS = {
    "bricard": Problem(
        "DOP853, relative angles, speed along the null space of the loop",
        ("P3x", "P3y", "P3z"),
        10.0,
        0.05,
        bricard,
        1e-9,
    )
}
