"""Devices placed turned, and hydrodynamic axes that turn with the yaw of each body."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.linear import LinearModel

POINTS = {"base": (0.0, 0.0, -9.0), "flap1": (-12.5, 0.0, -5.5), "flap2": (12.5, 0.0, -5.5)}


def turned_z(angle: float) -> np.ndarray:
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def device(
    folder: Path, axes: str, angle: float, heading: float, phase: str = "fixed"
) -> hydrodae.Results:
    """F3OF, free in six degrees of freedom, turned about the origin by `angle` [deg]."""
    case = hydrodae.Case.read(folder / "rao.toml")
    values: dict[str, Any] = {
        "hydro.axes": axes,
        "hydro.radiation": "constant",
        "hydro.frequency": 0.6,
        "sea.ramp": 5.0,
        "sea.phase": phase,
        "wave.swell.height": 2.0,
        "wave.swell.heading_deg": heading,
        "solver.end_time": 15.0,
        "solver.rtol": 1e-8,
        "solver.start": "given",
        # The mooring of the case is a matrix in earth axes.
        "force": [
            {"type": "pto_linear", "name": f"pto{k}", "joint": f"hinge{k}", "damping": 4e7}
            for k in (1, 2)
        ],
    }
    for name, point in POINTS.items():
        values[f"body.{name}.motion"] = "rigid"
        values[f"body.{name}.initial.rotation_deg"] = [0.0, 0.0, angle]
        moved = turned_z(angle) @ point - point
        values[f"body.{name}.initial.displacement"] = moved.tolist()
    return hydrodae.run(case, set=values)


TURNED = [("mean", "fixed"), ("mean", "moving"), ("yaw", "fixed"), ("yaw", "moving")]


@pytest.mark.parametrize(("axes", "phase"), [*TURNED, ("body", "fixed")])
def test_turning_device_and_waves_turns_the_result(repository: Path, axes: str, phase: str) -> None:
    folder = repository / "cases" / "f3of"
    straight = device(folder, axes, 0.0, 60.0, phase)
    turned = device(folder, axes, 25.0, 85.0, phase)
    R = turned_z(25.0)
    for name in POINTS:
        a = straight[f"bodies/{name}/position"].values
        b = turned[f"bodies/{name}/position"].values
        np.testing.assert_allclose(b, a @ R.T, atol=1e-6 * np.ptp(a))
        a, b = (r[f"forces/excitation/{name}/force"].values for r in (straight, turned))
        np.testing.assert_allclose(b, a @ R.T, atol=1e-5 * abs(a).max())
    for name in ("hinge1", "hinge2"):
        a, b = (r[f"joints/{name}/angle"].values for r in (straight, turned))
        assert np.ptp(a) > 0.01
        np.testing.assert_allclose(b, a, atol=1e-6 * np.ptp(a))
    assert abs(straight["bodies/base/rotation"].values[:, 2]).max() > 1e-4  # it yaws
    assert straight.statistics["relative_balance_error"] < 1e-5


def test_without_yaw_the_same_as_mean_axes(repository: Path) -> None:
    case = hydrodae.Case.read(repository / "cases" / "f3of" / "flap_decay.toml")
    angles = [
        hydrodae.run(case, set={"hydro.axes": axes, "solver.end_time": 20.0, "solver.rtol": 1e-8})[
            "joints/hinge2/angle"
        ].values
        for axes in ("yaw", "mean")
    ]
    np.testing.assert_allclose(angles[0], angles[1], atol=1e-9)


def turned_model(folder: Path, axes: str, angle: float) -> LinearModel:
    """F3OF on a soft mooring that holds its yaw, linearised where it stands, turned by `angle`."""
    stiffness = np.zeros((6, 6))
    stiffness[0, 0] = stiffness[1, 1] = 1e5
    values: dict[str, Any] = {
        "hydro.axes": axes,
        "hydro.radiation": "none",
        "force": [
            {"type": "pto_linear", "name": f"pto{k}", "joint": f"hinge{k}", "damping": 4e7}
            for k in (1, 2)
        ],
        "solver.start": "equilibrium",
    }
    for name, point in POINTS.items():
        values[f"body.{name}.motion"] = "rigid"
        values[f"body.{name}.initial.rotation_deg"] = [0.0, 0.0, angle]
        values[f"body.{name}.initial.displacement"] = (turned_z(angle) @ point - point).tolist()
    return LinearModel(hydrodae.Case.read(folder / "rao.toml").with_values(values))


@pytest.mark.parametrize("axes", ["mean", "yaw", "body"])
def test_frequency_domain_of_a_turned_device(repository: Path, axes: str) -> None:
    """Turned together with the waves: the same hinge angles, with their phases."""
    folder = repository / "cases" / "f3of"
    omega, heading = np.array([0.5, 0.8]), np.radians(60.0)
    straight = turned_model(folder, axes, 0.0).response(omega, heading)
    turned = turned_model(folder, axes, 25.0).response(omega, heading + np.radians(25.0))
    for name in ("hinge1", "hinge2"):
        a, b = (r[f"joints/{name}/angle"] for r in (straight, turned))
        np.testing.assert_allclose(b, a, rtol=1e-5)


def test_equilibrium_sets_the_mean_yaw(repository: Path) -> None:
    """A spring turns the moored device by 20 degrees: waves meet it there."""
    folder = repository / "cases" / "f3of"
    yaw = np.radians(20.0)
    moored = {
        "type": "mooring_matrix",
        "name": "mooring",
        "body": "base",
        "stiffness": [1e5, 1e5, 0.0, 0.0, 0.0, 1e8],
    }
    twist = {"type": "constant_load", "name": "twist", "body": "base", "moment": [0, 0, 1e8 * yaw]}
    values: dict[str, Any] = {
        "hydro.radiation": "none",
        "wave.swell.heading_deg": 20.0,
        "sea.ramp": 5.0,
        "solver.end_time": 20.0,
        "solver.start": "equilibrium",
        "force": [moored, twist],
        **{f"body.{name}.motion": "rigid" for name in POINTS},
    }
    results = hydrodae.run(folder / "rao.toml", set=values)
    rotation = results["bodies/base/rotation"].values
    assert rotation[0, 2] == pytest.approx(yaw, abs=1e-6)
    force = results["forces/excitation/base/force"].values
    across = force @ np.array([-np.sin(yaw), np.cos(yaw), 0.0])  # head seas for the device
    assert abs(across).max() < 1e-3 * abs(force).max()
