"""A bead on a bent wire against one equation in its horizontal place."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from tests.attack.parts import Table, body, case, joint
from tests.verification.blocks import run_tables

import hydrodae

GRAVITY = 9.81


def wire() -> np.ndarray:
    x = np.linspace(-2.0, 2.0, 17)
    return np.column_stack([x, 0.0 * x, 0.4 * x**2])


AT = [1.5, 0.0, 0.9]


def bead_on(carrier: str, *bodies: Table, end: float = 4.0, **wire_keys: Any) -> hydrodae.Results:
    """Run a bead on the wire, which a body or the ground carries."""
    path = joint("wire", "path", carrier, "bead", AT, path=wire().tolist(), **wire_keys)
    bead = body("bead", "point", 2.0, AT)
    tables = case([bead, *bodies], end, joints=[path], output={"step": 0.05})
    return run_tables(tables, rtol=1e-9)


def exact(time: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Place x, z of the bead: Lagrange's equation along the same natural spline."""
    points = wire()
    chord = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))]
    curve = CubicSpline(chord, points[:, [0, 2]], bc_type="natural")

    def rates(_time: float, y: np.ndarray) -> np.ndarray:
        c1, c2 = curve(y[0], 1), curve(y[0], 2)
        return np.array([y[1], (-GRAVITY * c1[1] - c1 @ c2 * y[1] ** 2) / (c1 @ c1)])

    start = chord[14]  # x = 1.5 is one of the points
    solution = solve_ivp(rates, (0, time[-1]), [start, 0.0], "DOP853", time, rtol=1e-11, atol=1e-12)
    return curve(solution.y[0]), solution.y[0]


def test_bead_slides_on_a_wire() -> None:
    results = bead_on("ground")
    place, _ = exact(results.time)
    ours = results["bodies/bead/position"].values
    np.testing.assert_allclose(ours[:, [0, 2]], place, atol=2e-6)
    total = results["energy/total"].values
    assert abs(total - total[0]).max() < 1e-5
    # the wire pushes across its own direction only
    force = results["joints/wire/reaction_force"].values
    velocity = results["bodies/bead/velocity"].values
    power = np.sum(force * velocity, axis=1)
    assert abs(power).max() < 1e-5


def test_displacement_is_the_arc_length() -> None:
    results = bead_on("ground")
    speed = np.linalg.norm(results["bodies/bead/velocity"].values, axis=1)
    rate = results["joints/wire/displacement_rate"].values
    np.testing.assert_allclose(abs(rate), speed, atol=1e-9)
    # z = 0.4 x^2 with k = 0.8 x: half of (x sqrt(1 + k^2) + arsinh(k) / 0.8), from x = -2
    x = np.r_[-2.0, results["bodies/bead/position"].values[:, 0]]
    arc = 0.5 * (x * np.sqrt(1 + (0.8 * x) ** 2) + np.arcsinh(0.8 * x) / 0.8)
    displacement = results["joints/wire/displacement"].values
    np.testing.assert_allclose(displacement, arc[1:] - arc[0], atol=3e-3)  # a spline through it


def test_start_by_arc_length_and_a_wire_that_falls_with_its_bead() -> None:
    """Carried by a body in free fall the bead keeps its place; started 1 m along the wire."""
    frame = body("frame", "rigid", 5.0, [0.3, 0.1, -0.2], [1.0, 1.2, 0.9])
    results = bead_on("frame", frame, end=1.0, initial={"displacement": 1.0})
    np.testing.assert_allclose(results["joints/wire/displacement"].values, 1.0, atol=1e-6)
    fall = -0.5 * GRAVITY * results.time**2
    height = results["bodies/bead/position"].values[:, 2]
    np.testing.assert_allclose(height - height[0], fall, atol=1e-6)
