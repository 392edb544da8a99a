"""Bodies of small or no inertia beside heavy ones: pendulums, chains of two, links without mass.

The equations of a point on a revolute or of two points on rods, in angles, integrated by SciPy, are
the truth.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import hydrodae
from hydrodae.case.case import to_toml

GRAVITY = 9.81
RTOL = 1e-6
METHODS = ("auto", "ida", "radau", "explicit_rk")


def _run(tmp_path: Path, tables: dict[str, Any], end: float, method: str) -> Any:
    document = {
        "environment": {"gravity": GRAVITY},
        **tables,
        "solver": {"end_time": end, "method": method, "rtol": RTOL},
        "output": {"step": end / 50.0},
    }
    path = tmp_path / "case.toml"
    path.write_text("\n".join(f"{key} = {to_toml(value)}" for key, value in document.items()))
    return hydrodae.run(path)


def _body(
    name: str, mass: float, at: list[float], inertia: float | list[float], **more: Any
) -> Any:
    values = [inertia] * 3 if isinstance(inertia, float) else inertia
    return dict(name=name, motion="rigid", mass=mass, center_of_gravity=at, inertia=values) | more


def _joint(kind: str, name: str, a: str, b: str, point: list[float]) -> dict[str, Any]:
    axis = {"axis": [0.0, 1.0, 0.0]} if kind == "revolute" else {}
    return {"type": kind, "name": name, "body_a": a, "body_b": b, "point": point, **axis}


def _pendulum(length: float, moment_ratio: float, start: float, times: Any) -> Any:
    """(nt, 2) x and z of a point at `length` with I = ratio m L^2, from rest at `start` rad."""
    rate = GRAVITY / length / (1.0 + moment_ratio)
    found = solve_ivp(
        lambda _, y: [y[1], -rate * np.sin(y[0])],
        (0.0, times[-1]),
        [start, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=times,
    )
    return length * np.column_stack([np.sin(found.y[0]), -np.cos(found.y[0])])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("ratio", [0.0, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0])
@pytest.mark.parametrize(("mass", "length"), [(1e5, 10.0), (1.0, 0.2)])
def test_pendulum_of_any_inertia_swings_as_in_closed_form(
    tmp_path: Path, mass: float, length: float, ratio: float, method: str
) -> None:
    start = 1.0
    at = [length * np.sin(start), 0.0, -length * np.cos(start)]
    results = _run(
        tmp_path,
        {
            "body": [_body("bob", mass, at, ratio * mass * length**2)],
            "joint": [_joint("revolute", "hinge", "bob", "ground", [0.0, 0.0, 0.0])],
        },
        5.0 * np.sqrt(length),
        method,
    )
    ours = results["bodies/bob/position"].values[:, [0, 2]]
    exact = _pendulum(length, ratio, start, results.time)
    assert np.abs(ours - exact).max() < 100.0 * RTOL * length


def _two_points(ratio: float, start: tuple[float, float], times: Any) -> Any:
    """(nt, 4) x, z of two points on rods of 1 m, the second of `ratio` the first's mass."""

    def rates(_: float, y: Any) -> list[float]:
        a, b, p, q = y
        c, s = np.cos(a - b), np.sin(a - b)
        matrix = np.array([[1.0 + ratio, ratio * c], [c, 1.0]])  # second row divided by its mass
        loads = [
            -ratio * s * q * q - (1.0 + ratio) * GRAVITY * np.sin(a),
            s * p * p - GRAVITY * np.sin(b),
        ]
        return [p, q, *np.linalg.solve(matrix, loads)]

    y = solve_ivp(
        rates,
        (0.0, times[-1]),
        [*start, 0.0, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-13,
        t_eval=times,
    ).y
    first = np.column_stack([np.sin(y[0]), -np.cos(y[0])])
    return np.column_stack([first, first + np.column_stack([np.sin(y[1]), -np.cos(y[1])])])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("ratio", [1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9])
def test_two_points_of_any_mass_ratio_swing_as_in_closed_form(
    tmp_path: Path, ratio: float, method: str
) -> None:
    # A light point between the pivot and a heavy one would swing at sqrt(2 ratio g / L): 1e5 rad/s
    # for the largest. From a straight start it does not, and both move as one pendulum of 2 m.
    a, b = 0.3, 0.2 if ratio <= 1.0 else 0.3
    first = [np.sin(a), 0.0, -np.cos(a)]
    second = [first[0] + np.sin(b), 0.0, first[2] - np.cos(b)]
    results = _run(
        tmp_path,
        {
            "body": [_body("upper", 1.0, first, 0.0), _body("lower", ratio, second, 0.0)],
            "joint": [
                _joint("revolute", "top", "upper", "ground", [0.0, 0.0, 0.0]),
                _joint("revolute", "middle", "lower", "upper", first),
            ],
        },
        2.0 if ratio < 1e9 else 0.2,
        method,
    )
    ours = np.hstack(
        [results[f"bodies/{name}/position"].values[:, [0, 2]] for name in ("upper", "lower")]
    )
    if ratio < 1e6:
        exact = _two_points(ratio, (a, b), results.time)
    else:
        lower = _pendulum(2.0, 0.0, a, results.time)
        exact = np.hstack([0.5 * lower, lower])
    assert np.abs(ours - exact).max() < 100.0 * RTOL


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("light", [0.0, 1e-9, 1e-6])
def test_bob_on_a_link_of_little_or_no_mass_is_a_pendulum(
    tmp_path: Path, light: float, method: str
) -> None:
    """The link on a revolute, the bob on a spherical joint at its centre."""
    length, start, mass = 4.0, 1.2, 500.0
    at = [length * np.sin(start), 0.0, -length * np.cos(start)]
    middle = [0.5 * x for x in at]
    moment = light * mass * length**2 / 12.0
    results = _run(
        tmp_path,
        {
            "body": [
                _body("link", light * mass, middle, [moment, moment, 0.0]),
                _body("bob", mass, at, [3.0, 4.0, 5.0]),
            ],
            "joint": [
                _joint("revolute", "top", "link", "ground", [0.0, 0.0, 0.0]),
                _joint("spherical", "end", "bob", "link", at),
            ],
        },
        10.0,
        method,
    )
    ours = results["bodies/bob/position"].values[:, [0, 2]]
    # m L^2 (1 + light / 3) th'' = -m g L (1 + light / 2) sin(th)
    ratio = (1.0 + light / 3.0) / (1.0 + light / 2.0) - 1.0
    assert (
        np.abs(ours - _pendulum(length, ratio, start, results.time)).max() < 100.0 * RTOL * length
    )


@pytest.mark.parametrize("method", METHODS)
def test_parallelogram_of_massless_links_carries_its_platform_as_a_pendulum(
    tmp_path: Path, method: str
) -> None:
    length, start = 2.0, 0.8
    shift = [length * np.sin(start), -length * np.cos(start)]
    bodies, joints = [], []
    for name, x in (("left", -1.0), ("right", 1.0)):
        end = [x + shift[0], 0.0, shift[1]]
        middle = [x + 0.5 * shift[0], 0.0, 0.5 * shift[1]]
        bodies.append(_body(name, 0.0, middle, 0.0))
        joints.append(_joint("revolute", f"{name}_top", name, "ground", [x, 0.0, 0.0]))
        joints.append(_joint("revolute", f"{name}_end", "platform", name, end))
    bodies.append(_body("platform", 80.0, [shift[0], 0.0, shift[1]], [9.0, 7.0, 6.0]))
    results = _run(tmp_path, {"body": bodies, "joint": joints}, 6.0, method)
    ours = results["bodies/platform/position"].values[:, [0, 2]]
    assert np.abs(ours - _pendulum(length, 0.0, start, results.time)).max() < 100 * RTOL * length
    # The massless links pass on what the platform needs.
    forces = [results[f"joints/{side}_top/reaction_force"].values for side in ("left", "right")]
    needed = results["bodies/platform/acceleration"].values + np.array([0.0, 0.0, GRAVITY])
    np.testing.assert_allclose(
        np.linalg.norm(forces[0] + forces[1], axis=1),
        80.0 * np.linalg.norm(needed, axis=1),
        atol=1.0,
    )


@pytest.mark.parametrize(
    ("joints", "key", "words"),
    [
        (
            [
                _joint("spherical", "top", "rod", "ground", [0.0, 0.0, 0.0]),
                _joint("spherical", "end", "bob", "rod", [0.0, 0.0, -1.0]),
            ],
            "inertia",
            "body 'rod' has no moment of inertia, and no constraint holds its rotation about its "
            "axis [0, 0, 1]",
        ),
        (
            [_joint("spherical", "end", "bob", "rod", [0.0, 0.0, -1.0])],
            "inertia",
            "body 'rod' has no moment of inertia, and no constraint holds its rotation",
        ),
    ],
)
def test_a_direction_without_inertia_that_nothing_holds_is_named(
    tmp_path: Path, joints: list[dict[str, Any]], key: str, words: str
) -> None:
    bodies = [_body("rod", 0.0, [0.0, 0.0, -0.5], 0.0), _body("bob", 3.0, [0.0, 0.0, -1.0], 1.0)]
    with pytest.raises(hydrodae.CaseError, match=r"(?s)" + words.replace("[", r"\[")) as error:
        _run(tmp_path, {"body": bodies, "joint": joints}, 1.0, "auto")
    assert key in str(error.value) or "case.toml" in str(error.value)
