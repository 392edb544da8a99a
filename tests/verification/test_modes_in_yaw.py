"""Waves on modes follow yaw and place of the body that deforms."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.verification.test_meshes_in_seas import CENTER, database

import hydrodae

AMPLITUDE = "modes/float.belly/amplitude"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Float with a mode whose load depends on the heading, as that of a shape along x."""
    out = tmp_path_factory.mktemp("yaw")
    rigid = database({"float": (0.0, 0.0)})
    at = [rigid.coordinates.index(f"float.{dof}") for dof in ("surge", "heave")]
    add = np.eye(len(rigid.coordinates) + 1)[:-1]
    add[at, -1] = 0.3, 0.2  # the mode is loaded as these parts of surge and heave
    square = ("added_mass", "radiation_damping", "added_mass_inf")
    tables = {k: add.T @ getattr(rigid, k) @ add for k in square}
    tables["added_mass_inf_std"] = np.zeros_like(tables["added_mass_inf"])
    loads = {k: getattr(rigid, k) @ add for k in ("froude_krylov", "diffraction")}
    stiffness = np.zeros((7, 7))
    stiffness[2, 6] = stiffness[6, 2] = 2e4
    stiffness[0, 6], stiffness[6, 0] = 1e4, -1e4  # of files, which yaw axes leave out
    body = replace(rigid.bodies["float"], mode_stiffness=stiffness)
    labels = (*rigid.coordinates, "float.belly")
    replace(rigid, coordinates=labels, **tables, **loads, bodies={"float": body}).write(
        out / "hydro.h5"
    )
    return out


def scene(
    folder: Path, yaw: float, heading: float, spin: float = 0.0, push: float = 0.0, **sea: Any
) -> hydrodae.Scene:
    """Return the float, turned by a yaw and spinning, in waves with a heading [deg]."""
    out = hydrodae.Scene("float with a belly", directory=folder)
    out.hydro(database="hydro.h5", radiation="constant", frequency=1.25, axes="yaw")
    start: Any = {"rotation_deg": [0.0, 0.0, yaw], "angular_velocity": [0.0, 0.0, spin]}
    out.body(
        "float", hydro="float", mass="equilibrium", center_of_gravity=[0.0, 0.0, CENTER],
        radii_of_gyration=[1.6, 1.6, 2.0], initial=start,
    )  # fmt: skip
    out.mode("belly", body="float", mass=2e4, stiffness=3e5, damping=2e4)
    out.force.mooring_matrix("mooring", body="float", stiffness=[2e4, 2e4, 0, 0, 0, 0])
    angle = np.radians(heading)
    if push:
        load = [push * np.cos(angle), push * np.sin(angle), 0.0]
        out.force.constant_load("push", body="float", force=load)
    out.wave.regular("waves", height=0.2, period=5.0, heading_deg=heading)
    out.sea(ramp=5.0, **sea)
    out.solver(end_time=25.0, rtol=1e-8, accuracy="none")
    return out


@pytest.mark.parametrize("phase", ["fixed", "moving"])
def test_waves_and_body_turned_together(folder: Path, phase: Any) -> None:
    """A float that spins by a radian: the same amplitude whatever the direction of the scene."""
    runs = [
        hydrodae.run(scene(folder, turn, turn, spin=0.05, push=4e4, phase=phase))
        for turn in (0.0, 40.0)
    ]
    one, other = (run[AMPLITUDE].values for run in runs)
    alone = hydrodae.run(scene(folder, 0.0, 40.0, spin=0.05, push=4e4, phase=phase))
    size = np.ptp(one)
    assert np.abs(runs[0]["bodies/float/rotation"].values[-1, 2]) > 0.5
    assert np.abs(alone[AMPLITUDE].values - one).max() > 0.05 * size
    np.testing.assert_allclose(other, one, atol=1e-5 * size)


def test_waves_on_a_mode_follow_the_yaw(folder: Path) -> None:
    """Slow spin through a right angle: the load is that of the heading relative to the body."""
    run = hydrodae.run(scene(folder, 0.0, 0.0, spin=0.06))
    data = hydrodae.hdb.HydroDatabase.read(folder / "hydro.h5")
    omega, time = 2.0 * np.pi / 5.0, run.time
    loads = (data.froude_krylov + data.diffraction)[:, :-1, -1]
    at = np.array([np.interp(omega, data.omega, loads[:, k]) for k in range(loads.shape[1])])
    yaw = run["bodies/float/rotation"].values[:, 2]
    series = np.fft.fft(at) / at.size  # over the headings, 0 to 330 deg
    orders = np.fft.fftfreq(at.size, 1.0 / at.size)
    by_yaw = np.exp(-1j * np.outer(yaw, orders)) @ series
    expected = 0.1 * np.real(by_yaw * np.exp(1j * omega * time))
    found = run["forces/excitation/float.belly/load"].values
    late = time > 6.0
    assert np.ptp(yaw) > 1.0
    np.testing.assert_allclose(found[late], expected[late], atol=0.01 * np.ptp(expected))


def test_waves_on_a_mode_follow_its_place(folder: Path) -> None:
    """A float that is pushed by x against one that stays: its waves lag by k x."""
    run = hydrodae.run(scene(folder, 0.0, 0.0, push=1e5, phase="moving"))
    still = hydrodae.run(scene(folder, 0.0, 0.0, push=1e5, phase="fixed"))
    name = "forces/excitation/float.belly/load"
    size = np.ptp(still[name].values)
    assert np.abs(run["bodies/float/position"].values[:, 0]).max() > 3.0
    assert np.abs(run[name].values - still[name].values).max() > 0.2 * size
