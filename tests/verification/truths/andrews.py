"""Andrews' squeezing mechanism: seven bodies in a plane, three loops, one degree of freedom.

W. Schiehlen, Multibody Systems Handbook (1990); E. Hairer and G. Wanner, Solving Ordinary
Differential Equations II, VII.7, whose names of lengths and angles are kept. Points of the plane
are complex numbers: z = c + sum_k a_k exp(i (n_k . q + p_k)), q = (beta, Theta, gamma, Phi, delta,
Omega, epsilon). With that dz/dq and the part of z'' by q' alone follow at once.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from tests.verification.truths.problem import Accuracy, Problem, integrated

from hydrodae.support.arrays import Array

COORDINATES = ("beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon")
LEFT, UP, RIGHT, DOWN = np.pi, 0.5 * np.pi, 0.0, -0.5 * np.pi


def turned(*names: str) -> Array:
    """Weights of the coordinates whose sum is an angle."""
    return np.array([float(name in names) for name in COORDINATES])


@dataclass(frozen=True)
class Point:
    """Start (m), and arms: length [m], coordinates of its angle, phase [rad]."""

    start: complex
    arms: tuple[tuple[float, Array, float], ...]

    def __call__(self, q: Array, rates: Array) -> tuple[complex, NDArray[np.complex128], complex]:
        """Place, its gradient (7,), and its acceleration at q'' = 0."""
        place, gradient, bias = self.start, np.zeros(7, dtype=complex), 0j
        for length, weights, phase in self.arms:
            arm = length * np.exp(1j * (weights @ q + phase))
            place += arm
            gradient += 1j * arm * weights
            bias -= arm * (weights @ rates) ** 2
        return place, gradient, bias


A, B, C = -0.06934 - 0.00227j, -0.03635 + 0.03273j, 0.014 + 0.072j
CRANK, ROD = turned("beta"), turned("beta", "Theta")
TRIANGLE, LEVER = turned("gamma"), turned("delta")
UPPER, LOWER = turned("Phi", "delta"), turned("Omega", "epsilon")
ARM = turned("epsilon")

# centre of gravity, mass [kg], inertia about it [kg m2], coordinates of the body's angle
BODIES = (
    (Point(0, ((92e-5, CRANK, RIGHT),)), 0.04325, 2.194e-6, CRANK),
    (Point(0, ((7e-3, CRANK, RIGHT), (0.0115, ROD, LEFT))), 0.00365, 4.410e-7, ROD),
    (
        Point(B, ((0.01874, TRIANGLE, DOWN), (0.01043, TRIANGLE, RIGHT))),
        0.02373,
        5.255e-6,
        TRIANGLE,
    ),
    (Point(A, ((0.04, LEVER, RIGHT), (0.02 - 0.01421, UPPER, DOWN))), 0.00706, 5.667e-7, UPPER),
    (Point(A, ((0.02308, LEVER, RIGHT), (0.00916, LEVER, UP))), 0.07050, 1.169e-5, LEVER),
    (Point(A, ((0.04, ARM, DOWN), (0.02 - 0.01421, LOWER, RIGHT))), 0.00706, 5.667e-7, LOWER),
    (Point(A, ((0.01228, ARM, DOWN), (0.00449, ARM, LEFT))), 0.05498, 1.912e-5, ARM),
)
END = ((7e-3, CRANK, RIGHT), (0.028, ROD, LEFT))  # of the rod, where three bodies meet
LOOPS = (  # zero when closed: along the crank and the rod, back to B and twice to A
    Point(-B, (*END, (0.035, TRIANGLE, UP))),
    Point(-A, (*END, (0.02, UPPER, UP), (0.04, LEVER, LEFT))),
    Point(-A, (*END, (0.02, LOWER, LEFT), (0.04, ARM, UP))),
)
HOOK = Point(B, ((0.018, TRIANGLE, DOWN), (0.02, TRIANGLE, RIGHT)))  # of the spring to C
STIFFNESS, LENGTH, TORQUE = 4530.0, 0.07785, 0.033  # N/m, m, N m on the crank

START = (
    -0.0617138900142764496,
    0.0,
    0.455279819163070380,
    0.222668390165885884,
    0.487364979543842550,
    -0.222668390165885884,
    1.23054744454982119,
)


def closed(q: Array, rates: Array) -> tuple[Array, Array]:
    """Change of all coordinates by beta alone, and what q'' has beside it: loops stay closed."""
    slopes, biases = zip(*(loop(q, rates)[1:] for loop in LOOPS), strict=True)
    gradient = np.array([[row.real, row.imag] for row in slopes]).reshape(6, 7)
    bias = np.array([[z.real, z.imag] for z in biases]).ravel()
    solved = np.linalg.solve(gradient[:, 1:], np.column_stack([gradient[:, 0], bias]))
    return np.r_[1.0, -solved[:, 0]], np.r_[0.0, -solved[:, 1]]


def rates(_t: float, s: Array) -> Array:
    """State: the seven angles and beta'."""
    q, speed = s[:7], s[7]
    along, _ = closed(q, np.zeros(7))
    velocity = along * speed
    _, beside = closed(q, velocity)
    inertia: Any = 0.0
    load: Any = TORQUE
    for centre, mass, turning, weights in BODIES:
        _, gradient, bias = centre(q, velocity)
        moves, turns = gradient @ along, weights @ along
        inertia += mass * abs(moves) ** 2 + turning * turns**2
        load -= mass * (moves.conjugate() * (gradient @ beside + bias)).real
        load -= turning * turns * (weights @ beside)
    place, gradient, _ = HOOK(q, velocity)
    reach = abs(place - C)
    pull = STIFFNESS * (reach - LENGTH) * (place - C) / reach
    load -= (pull.conjugate() * (gradient @ along)).real
    return np.asarray(np.r_[velocity, load / inertia])


def andrews(time: Array, accuracy: Accuracy) -> Array:
    """End F of the crank [m] and its angle beta."""
    beta = integrated(rates, [*START, 0.0], time, accuracy)[0]
    return np.column_stack([0.007 * np.cos(beta), 0.007 * np.sin(beta), beta])


PROBLEMS = {
    "andrews": Problem(
        "DOP853, speed of the crank", ("Fx", "Fy", "beta"), 0.05, 0.0005, andrews, 2e-8
    )
}
