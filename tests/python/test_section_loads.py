"""Shear and moment of sections from modes against a uniform free-free beam in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from hydrodae.errors import CaseError
from hydrodae.results.sections import section_loads
from hydrodae.support.arrays import Array

LENGTH, MASS, EI = 80.0, 4.0e4, 3.0e10  # m, kg/m, N m2
#: Roots of tan(u) + tanh(u) = 0: u = b L/2 of the first symmetric modes.
ROOTS = np.array([2.3650203724, 5.4978039190, 8.6393798287, 11.7809724510])
X = np.linspace(-0.5 * LENGTH, 0.5 * LENGTH, 2001)
STATIONS = {"quarter": -20.013, "midship": 0.0, "ahead": 31.4}


def modes(x: Array) -> tuple[Array, Array, Array, Array]:
    """Shapes phi = cosh bx/cosh u + cos bx/cos u, EI phi'', EI phi''' (4, n), stiffness (4,)."""
    b = 2.0 * ROOTS[:, None] / LENGTH
    u = ROOTS[:, None]
    even, bent = np.cosh(b * x) / np.cosh(u), np.cos(b * x) / np.cos(u)
    third = b**3 * (np.sinh(b * x) / np.cosh(u) + np.sin(b * x) / np.cos(u))
    square = LENGTH  # int phi^2 dx of a free-free mode with ends of 2: L 2^2/4
    return even + bent, EI * b**2 * (even - bent), EI * third, EI * (b[:, 0] ** 4) * square


def test_a_uniform_beam() -> None:
    shapes, _, _, stiffness = modes(X)
    q = np.array([[0.3 + 0.1j, -0.2], [0.05, 0.02j], [0.01, 0.0], [0.0, 0.003]])
    found = section_loads(X, np.full(len(X), MASS), shapes, stiffness, q, STATIONS)
    _, moments, shears, _ = modes(np.array(list(STATIONS.values())))
    top = np.abs(moments).max(), np.abs(shears).max()
    for i, load in enumerate(found.values()):
        np.testing.assert_allclose(load.moment, moments[:, i] @ q, atol=1e-5 * top[0])
        np.testing.assert_allclose(load.shear, shears[:, i] @ q, atol=1e-5 * top[1])
    assert found["midship"].moment[0].real > 0.0  # ends up: sagging


def test_a_static_load() -> None:
    """The load p cos(2 pi x/L) has M = -p (L/2 pi)^2 (cos(2 pi x/L) + 1); four modes come near."""
    shapes, _, _, stiffness = modes(X)
    p = 1.0e4 * np.cos(2.0 * np.pi * X / LENGTH)
    q = np.trapezoid(p * shapes, X, axis=1) / stiffness
    found = section_loads(X, np.full(len(X), MASS), shapes, stiffness, q, STATIONS)
    most = 1.0e4 * (LENGTH / (2.0 * np.pi)) ** 2
    for name, place in STATIONS.items():
        exact = -most * (np.cos(2.0 * np.pi * place / LENGTH) + 1.0)
        assert found[name].moment == pytest.approx(exact, abs=0.005 * 2.0 * most)


def test_a_load_of_several_masses_is_that_of_the_part_ahead() -> None:
    """V and M of a section balance the inertia of the part ahead, of any mass and any shape."""
    mass = MASS * (1.0 + 0.5 * np.cos(0.1 * X))
    basis = np.stack([np.ones_like(X), X])
    gram = np.trapezoid(mass * basis[:, None] * basis, X)
    shape = np.cos(2.0 * np.pi * X / LENGTH)
    shape = shape - np.linalg.solve(gram, np.trapezoid(mass * basis * shape, X)) @ basis
    at = X[1300]
    (load,) = section_loads(X, mass, [shape], [2.0e6], [0.7], {"a": at}).values()
    pull = 0.7 * 2.0e6 * mass * shape / np.trapezoid(mass * shape**2, X)
    ahead = slice(1300, None)
    assert load.shear == pytest.approx(-np.trapezoid(pull[ahead], X[ahead]), rel=1e-6)
    arm = X[ahead] - at
    assert load.moment == pytest.approx(np.trapezoid(arm * pull[ahead], X[ahead]), rel=1e-5)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"shapes": [np.ones_like(X)]}, "shape 1 over the mass has a net force or moment"),
        ({"shapes": [X]}, "shape 1 over the mass has a net force or moment"),
        ({"stations": {"bow": 41.0}}, "station bow: 41 m is outside of -40 to 40 m"),
        ({"x": X[::-1]}, "x: expected 3 places or more, ascending"),
        ({"mass": np.full(len(X), -1.0)}, "mass: expected 2001 numbers >= 0"),
        ({"amplitudes": [1.0, 2.0]}, r"expected \(k, 2001\), \(k,\) and \(k, ...\) of k modes"),
        ({"stiffness": [-1.0]}, "stiffness must be >= 0"),
    ],
)
def test_bad_input(change: dict[str, object], message: str) -> None:
    good = {
        "x": X,
        "mass": np.full(len(X), MASS),
        "shapes": modes(X)[0][:1],
        "stiffness": [1.0],
        "amplitudes": [1.0],
        "stations": STATIONS,
    }
    with pytest.raises(CaseError, match=message):
        section_loads(**(good | change))  # type: ignore[arg-type]
