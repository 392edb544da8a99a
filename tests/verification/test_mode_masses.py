"""Masses of modes: light modes in the water, and mass that couples modes and rigid motions."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.verification.test_modes import BARGE, MASSES, MODES, STIFFNESSES, write_wet_beam

import hydrodae
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.labels import DOFS
from hydrodae.linear import LinearModel


@pytest.mark.parametrize("amplitude", [0.1, 1e-3])
def test_added_mass_is_part_of_the_scale_of_the_energy(tmp_path: Path, amplitude: float) -> None:
    """A mode of 1 mg with an added mass of 40 kg: errors of its energy are those of 40 kg."""
    write_wet_beam(tmp_path / "hydro.h5")
    scene = hydrodae.Scene("a light mode", directory=tmp_path)
    scene.hydro(database="hydro.h5", radiation="none")
    scene.body("beam", hydro="beam", motion="heave", mass=1e3, center_of_gravity=[0.0, 0.0, 0.0])
    start: Any = {"amplitude": amplitude}
    scene.mode("bend", body="beam", mass=1e-6, stiffness=4000.0, initial=start)
    scene.solver(end_time=1.0, method="ida", rtol=1e-3, accuracy="none")
    assert hydrodae.run(scene).status == "completed"


#: Two modes of equal stiffness and damping, of which any rotation is a pair of modes, too.
BODY, MODAL, STIFFNESS, DAMPING = 1000.0, np.array([60.0, 90.0]), 4000.0, 30.0
AMPLITUDES = ("modes/beam.bend/amplitude", "modes/beam.twist/amplitude")
HEAVE = "bodies/beam/heave"


def basis(turn: float, part: Any) -> np.ndarray:
    """Return T (3, 3) of x = T x' over heave and two modes: turned, and with a part of heave."""
    c, s = np.cos(turn), np.sin(turn)
    return np.array([[1.0, *part], [0.0, c, -s], [0.0, s, c]])


def changed(database: HydroDatabase, turn: np.ndarray, own: np.ndarray) -> HydroDatabase:
    """Return a database of one body over the coordinates x'; `own` (n, n) is its stiffness."""
    loads = {k: getattr(database, k) @ turn for k in ("froude_krylov", "diffraction")}
    tables = {
        k: turn.T @ getattr(database, k) @ turn
        for k in ("added_mass", "radiation_damping", "added_mass_inf")
    }
    ((name, body),) = database.bodies.items()
    bodies = {name: replace(body, mode_stiffness=turn.T @ own @ turn)}
    return replace(database, **loads, **tables, bodies=bodies)


def beam(folder: Path, T: np.ndarray, **second: Any) -> hydrodae.Scene:
    """Return a beam in heave with two modes, over x' of x = T x'; keys of the second mode."""
    labels = tuple(f"beam.{dof}" for dof in (*DOFS, "bend", "twist"))
    added = np.diag([50.0, 50.0, 100.0, 1e3, 1e3, 1e3, 40.0, 25.0])
    added[2, 6] = added[6, 2] = 20.0
    omega, whole = np.linspace(0.5, 8.0, 16), np.eye(8)
    force = np.array([30.0, 0.0, 500.0, 0.0, 100.0, 0.0, 200.0 + 50.0j, 80.0j])
    every = np.broadcast_to(force, (16, 1, 8)).copy()
    own = np.zeros((8, 8))
    own[2, 2], own[6, 6], own[2, 6], own[6, 2], own[7, 7] = 2000.0, 900.0, 150.0, 250.0, -300.0
    statics = hydrodae.hdb.Hydrostatics(1.0, np.zeros(3), 0.2, np.zeros(5))
    body = hydrodae.hdb.Body("beam", np.zeros(3), statics, mode_stiffness=own)
    A, B, zero = np.broadcast_to(added, (16, 8, 8)).copy(), np.zeros((16, 8, 8)), np.zeros((8, 8))
    database = HydroDatabase(
        labels, omega, A, B, added, zero, np.zeros(1), np.zeros_like(every), every,
        {"beam": body}, 1000.0, 10.0, excitation_split=False,
    )  # fmt: skip
    at = [2, 6, 7]
    whole[np.ix_(at, at)] = T
    changed(database, whole, own).write(folder / "hydro.h5")
    M = T.T @ np.diag([BODY, *MODAL]) @ T
    start = np.linalg.solve(T, [0.0, 0.01, -0.005])
    scene = hydrodae.Scene("two modes", directory=folder)
    scene.hydro(database="hydro.h5", radiation="none")
    place: Any = {"displacement": [0.0, 0.0, start[0]], "velocity": [0.0, 0.0, 0.0]}
    centre = [0.0, 0.0, 0.0]
    scene.body(
        "beam", hydro="beam", motion="heave", mass=BODY, center_of_gravity=centre, initial=place
    )
    for k, name in ((1, "bend"), (2, "twist")):
        more: dict[str, Any] = {}
        if k == 2 and M[1, 2]:
            more["mass_with_modes"] = [M[1, 2]]
        if M[0, k]:
            more["mass_with_motions"] = [0.0, 0.0, M[0, k], 0.0, 0.0, 0.0]
        more |= second if k == 2 else {}
        own_start: Any = {"amplitude": start[k], "rate": 0.0}
        scene.mode(
            name, body="beam", mass=M[k, k], stiffness=STIFFNESS, damping=DAMPING,
            initial=own_start, **more,
        )  # fmt: skip
    scene.wave.regular("sea", height=0.02, period=2.5)
    scene.solver(end_time=10.0, rtol=1e-10, accuracy="none")
    return scene


OTHER = [basis(0.7, (0.0, 0.0)), basis(0.7, (0.3, -0.4))]


@pytest.mark.parametrize("T", OTHER, ids=["turned", "with heave"])
def test_motion_does_not_depend_on_the_choice_of_the_modes(tmp_path: Path, T: np.ndarray) -> None:
    """Runs, `rao` and `spectral` over other shapes of the same motions: x = T x'."""
    found = []
    for basis_of in (np.eye(3), T):
        scene = beam(tmp_path, basis_of)
        run = hydrodae.run(scene)
        linear = LinearModel(scene).response(np.array([0.9, 2.5, 6.0]))
        spectral = hydrodae.spectral(scene)
        heave = run["bodies/beam/position"].values[:, 2]
        found.append(
            [
                basis_of @ np.array([heave, *(run[a].values for a in AMPLITUDES)]),
                basis_of @ np.array([linear[a] for a in (HEAVE, *AMPLITUDES)]),
                basis_of @ np.array([spectral.channel(a) for a in (HEAVE, *AMPLITUDES)]),
            ]
        )
    (time, rao, sea), (other_time, other_rao, other_sea) = found
    assert np.ptp(time, axis=1).min() > 1e-4
    np.testing.assert_allclose(other_time, time, atol=1e-9)
    np.testing.assert_allclose(other_rao, rao, rtol=1e-10)
    np.testing.assert_allclose(other_sea, sea, rtol=1e-10)


@pytest.mark.parametrize("method", ["radau", "ida", "explicit_rk"])
def test_shared_mass_is_in_the_energy(tmp_path: Path, method: Any) -> None:
    """The balance of a run holds: power of the waves is the change of the energy."""
    case = beam(tmp_path, OTHER[1]).case()
    strict = {"solver.method": method, "solver.energy_guard": 1e-4}
    assert hydrodae.run(case, set=strict).status == "completed"


def test_barge_over_other_shapes(reference: Path, tmp_path: Path) -> None:
    """The amplitudes of WAMIT, from bending modes that are turned and hold a part of heave."""
    database, _ = hydrodae.hdb.import_database(reference / "modes" / "gbm_barge" / "barge.1")
    at = [database.coordinates.index(f"barge.{name}") for name in ("heave", *MODES)]
    T, whole = np.eye(5), np.eye(len(database.coordinates))
    T[:3, :3] = basis(0.4, (0.2, -0.1))
    whole[np.ix_(at, at)] = T
    own = database.bodies["barge"].mode_stiffness
    assert own is not None
    assert own[2, 2] == pytest.approx(database.rho * database.gravity * 800.0, rel=1e-3)
    structure = np.diag([0.0] * 6 + list(STIFFNESSES))
    changed(database, whole, own + structure).write(tmp_path / "hydro.h5")
    M = T.T @ np.diag([4e6, *MASSES]) @ T
    scene = hydrodae.Scene("barge", directory=tmp_path)
    scene.hydro(database="hydro.h5", radiation="none")
    inertia, centre = [6.666667e7, 2.166667e9, 2.166667e9], [0.0, 0.0, 0.0]
    scene.body(
        "barge", hydro="barge", motion="planar", mass=4e6, inertia=inertia,
        center_of_gravity=centre,
    )  # fmt: skip
    for k, name in enumerate(MODES, start=1):
        scene.mode(
            name, body="barge", mass=float(M[k, k]), mass_with_motions=[0, 0, M[0, k], 0, 0, 0],
            **({"mass_with_modes": M[k, 1:k].tolist()} if k > 1 else {}),
        )  # fmt: skip
    scene.solver(end_time=1.0)
    found = LinearModel(scene).response(2.0 * np.pi / np.array(list(BARGE)))
    channels = ["bodies/barge/heave", *(f"modes/barge.{m}/amplitude" for m in MODES)]
    values = np.abs(T @ np.array([found[c] for c in channels]))
    np.testing.assert_allclose(values[:3].T, list(BARGE.values()), rtol=1e-3, atol=6e-5)


@pytest.mark.parametrize(
    ("keys", "key", "text"),
    [
        ({"mass_with_modes": [73.5]}, "mass_with_modes", "not positive definite"),
        ({"mass_with_motions": [0, 0, 301.0, 0, 0, 0]}, "mass_with_motions", "not positive"),
        ({"mass_with_modes": [1.0, 2.0]}, "mass_with_modes", "one mass for each"),
        ({"mass_with_motions": [1.0]}, "mass_with_motions", "expected six"),
    ],
)
def test_masses_of_no_body_are_refused(
    tmp_path: Path, keys: dict[str, Any], key: str, text: str
) -> None:
    """Roots of 60 * 90 and 1000 * 90: 73.48 and 300 kg."""
    with pytest.raises(hydrodae.CaseError, match=text) as caught:
        hydrodae.check(beam(tmp_path, np.eye(3), **keys))
    assert caught.value.key == f"mode.twist.{key}"
