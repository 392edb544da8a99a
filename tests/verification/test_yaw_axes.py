"""Hydrodynamic axes that turn with the yaw of each body."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.frequency import LinearModel

POINTS = {"base": (0.0, 0.0, -9.0), "flap1": (-12.5, 0.0, -5.5), "flap2": (12.5, 0.0, -5.5)}


def turned_z(angle: float) -> np.ndarray:
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def device(folder: Path, axes: str, angle: float, heading: float, phase: str = "fixed") -> hydrodae.Results:  # fmt: skip # noqa: E501
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


@pytest.mark.parametrize("phase", ["fixed", "moving"])
def test_turning_device_and_waves_turns_the_result(repository: Path, phase: str) -> None:
    folder = repository / "cases" / "f3of"
    straight = device(folder, "yaw", 0.0, 60.0, phase)
    turned = device(folder, "yaw", 25.0, 85.0, phase)
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
    if phase == "fixed":  # axes that do not turn see other waves
        other = device(folder, "mean", 25.0, 85.0)
        force = other["forces/excitation/base/force"].values
        a = straight["forces/excitation/base/force"].values
        assert abs(force - a @ R.T).max() > 0.05 * abs(a).max()


def test_without_yaw_the_same_as_mean_axes(repository: Path) -> None:
    case = hydrodae.Case.read(repository / "cases" / "f3of" / "flap_decay.toml")
    angles = [
        hydrodae.run(case, set={"hydro.axes": axes, "solver.end_time": 20.0, "solver.rtol": 1e-8})[
            "joints/hinge2/angle"
        ].values
        for axes in ("yaw", "mean")
    ]
    np.testing.assert_allclose(angles[0], angles[1], atol=1e-9)


def test_frequency_domain_refuses_a_turned_device(repository: Path) -> None:
    case = hydrodae.Case.read(repository / "cases" / "f3of" / "rao.toml").with_values(
        {
            "hydro.axes": "yaw",
            "hydro.radiation": "none",
            **{f"body.{n}.motion": "rigid" for n in POINTS},
            **{f"body.{n}.initial.rotation_deg": [0.0, 0.0, 25.0] for n in POINTS},
            **{
                f"body.{n}.initial.displacement": (turned_z(25.0) @ p - p).tolist()
                for n, p in POINTS.items()
            },
        }
    )
    with pytest.raises(CaseError, match="turn the headings of the waves"):
        LinearModel(case)
