"""Added mass, radiation and excitation by the pose of a body, in whole runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from tests.attack.parts import Table, body, case
from tests.errors import stopped, wrong
from tests.verification import hulls
from tests.verification.blocks import run_tables

import hydrodae
from hydrodae.case.case import to_toml
from hydrodae.errors import CaseError
from hydrodae.hdb import HydroDatabase
from hydrodae.linear import LinearModel
from hydrodae.support.arrays import Array

ROOT = Path(__file__).resolve().parents[2]
RADIUS, MASS, CENTER, RHO, GRAVITY = 5.0, 261.8e3, -2.0, 1000.0, 9.81


def growth(rise: Array | float) -> Array:
    """Return how the tables grow with the depth of a sphere: smooth, 1 at rest."""
    return np.asarray(np.exp(-np.asarray(rise) / 6.0) * (1.0 + 0.1 * np.sin(rise)))


def write_tables(folder: Path, poses: Array, *, turns: bool = False) -> None:
    """Write the database of the sphere, scaled for each pose, and that of rest."""
    rest = HydroDatabase.read(ROOT / "cases" / "sphere" / "hydro.h5")
    rest.write(folder / "hydro.h5")
    for k, pose in enumerate(poses):
        factor = float(growth(pose))
        body = rest.bodies["sphere"]
        point = body.reference_point + np.array([0.0, 0.0, 0.0 if turns else pose])
        fits = {
            name: replace(
                fit,
                output_matrix=factor * fit.output_matrix,
                added_mass_inf=factor * fit.added_mass_inf,
            )
            for name, fit in rest.memory.items()
        }
        replace(
            rest,
            added_mass=factor * rest.added_mass,
            radiation_damping=factor * rest.radiation_damping,
            added_mass_inf=factor * rest.added_mass_inf,
            froude_krylov=np.sqrt(factor) * rest.froude_krylov,
            diffraction=np.sqrt(factor) * rest.diffraction,
            bodies={"sphere": replace(body, reference_point=point)},
            memory=fits,
            kernel=None,
        ).write(folder / f"pose{k}.h5")


def write_case(
    folder: Path,
    poses: Array,
    memory: str = "rest",
    *,
    motion: str = "heave",
    rise: float = 3.0,
    end: float = 20.0,
    rtol: float = 1e-9,
    mass: float = MASS,
    start: Table | None = None,
    table: Table | None = None,
    wave: Sequence[Table] = (),
    **hydro: Any,
) -> Path:
    """Write a case of the sphere with a table over heave; `table` are other keys of it."""
    hulls.write_obj(folder / "sphere.obj", hulls.sphere(RADIUS, 12))
    initial = {"displacement": [0.0, 0.0, rise]} | (start or {})
    sphere = body("float", motion, mass, [0.0, 0.0, CENTER], [1.69e6, 1.69e6, 2.6e6], **initial)
    sphere |= {"hydro": "sphere", "mesh": "sphere.obj", "hydrostatics": "mesh"}
    water = {"database": "hydro.h5", "radiation": "none", **hydro}
    tables = case([sphere], end, hydro=water, output={"step": 0.05})
    if wave:
        tables["wave"] = list(wave)
    if poses.size:
        files = [f"pose{k}.h5" for k in range(poses.size)]
        one: Table = dict(name="depth", body="float", coordinate="heave", values=poses.tolist())
        one |= dict(databases=files, memory=memory) | (table or {})
        tables["pose_table"] = [{key: value for key, value in one.items() if value is not None}]
    tables["solver"]["rtol"] = rtol
    path = folder / "case.toml"
    path.write_text("".join(f"{key} = {to_toml(value, key)}\n" for key, value in tables.items()))
    return path


SWELL = dict(name="swell", type="regular", period=7.0, height=1.0)


def heave(results: hydrodae.Results) -> Array:
    """Return the heave about rest [m]."""
    return np.asarray(results["bodies/float/position"].values[:, 2] - CENTER)


POSES = np.linspace(-4.8, 4.8, 9)


@pytest.mark.parametrize("method", ["auto", "radau", "ida"])
def test_energy_is_conserved_without_radiation(tmp_path: Path, method: str) -> None:
    write_tables(tmp_path, POSES)
    path = write_case(tmp_path, POSES, end=60.0, rtol=1e-11 if method != "ida" else 1e-9)
    results = hydrodae.run(path, set={"solver.method": method})
    total, kinetic = results["energy/total"].values, results["energy/kinetic"].values
    bound = 1e-8 if method != "ida" else 1e-5
    assert np.ptp(heave(results)) > 5.0
    assert np.abs(total - total[0]).max() < bound * kinetic.max()


def test_the_load_of_a_wave_follows_the_pose(tmp_path: Path) -> None:
    """That of rest times the root of what the tables grow by, at the heave of each moment."""
    poses = np.linspace(-4.8, 4.8, 25)
    write_tables(tmp_path, poses)
    loads = []
    for table in (np.array([]), poses):
        results = hydrodae.run(write_case(tmp_path, table, wave=[SWELL], rtol=1e-6))
        loads.append(results["forces/excitation/float/force"].values[:, 2])
    rest, load = loads
    expected = np.sqrt(growth(heave(results))) * rest
    assert np.ptp(heave(results)) > 4.0
    np.testing.assert_allclose(load, expected, atol=1e-4 * np.abs(expected).max())


def reference_decay(
    folder: Path, poses: Array, times: Array, memory: str, start: float = 3.0
) -> Array:
    """Return the heave by an own program: (m + A(z)) z'' + A'(z) z'^2 / 2 = F(z) - C x [m].

    C is that of rest, or C(z).
    """
    bases = [HydroDatabase.read(folder / f"pose{k}.h5").memory["heave"] for k in range(poses.size)]
    rest = HydroDatabase.read(folder / "hydro.h5").memory["heave"]
    added = CubicSpline(poses, [float(fit.added_mass_inf[0, 0]) for fit in bases])
    blends = CubicSpline(poses, [fit.output_matrix[0] for fit in bases])
    poles, inputs = rest.poles, rest.input_matrix[:, 0]

    def outputs(z: float) -> Array:
        return np.asarray(blends(z) if memory == "blended" else rest.output_matrix[0])

    vertices, triangles = hulls.sphere(RADIUS, 12)

    def buoyancy(rise: float) -> float:
        return RHO * GRAVITY * _volume(vertices, triangles, rise)

    def rates(_: float, y: Array) -> Array:
        z, v = y[0], y[1]
        x = y[2 : 2 + len(poles)] + 1j * y[2 + len(poles) :]
        force = buoyancy(z) - MASS * GRAVITY - float((outputs(z) * x).sum().real)
        a = (force - 0.5 * float(added(z, 1)) * v * v) / (MASS + float(added(z)))
        change = poles * x + inputs * v
        return np.asarray(np.r_[v, a, change.real, change.imag])

    first = np.r_[start, np.zeros(1 + 2 * len(poles))]
    found = solve_ivp(rates, (0.0, times[-1]), first, "DOP853", times, rtol=1e-9, atol=1e-9)
    return np.asarray(found.y[0])


def _volume(vertices: Array, triangles: NDArray[np.int64], height: float) -> float:
    """Return the volume of a mesh beneath z = 0 when its origin is at `height` [m3].

    By Gauss's theorem: horizontal projection of each triangle times its mean of min(z, 0).
    """
    p, q, r = np.moveaxis(vertices[triangles], 1, 0)
    projection = 0.5 * np.cross(q - p, r - p)[:, 2]
    low, middle, high = np.sort(vertices[triangles][:, :, 2] + height, axis=1).T
    with np.errstate(divide="ignore", invalid="ignore"):
        tip = low**3 / (3.0 * (middle - low) * (high - low))
        rest = (low + middle + high) / 3.0 - high**3 / (3.0 * (high - low) * (high - middle))
    below = np.where(middle > 0.0, tip, np.where(high > 0.0, rest, (low + middle + high) / 3.0))
    return float(np.sum(projection * np.where(low < 0.0, below, 0.0)))


@pytest.mark.parametrize("memory", ["rest", "blended"])
def test_a_decay_with_memory_follows_an_own_program(tmp_path: Path, memory: str) -> None:
    write_tables(tmp_path, POSES)
    path = write_case(tmp_path, POSES, memory, radiation="exponential", end=6.0)
    results = hydrodae.run(path)
    exact = reference_decay(tmp_path, POSES, results.time, memory)
    np.testing.assert_allclose(heave(results), exact, atol=2e-6)
    assert not any("rises or sinks" in note for note in results.notes)
    # and differs from constant tables by much more
    fixed = hydrodae.run(write_case(tmp_path, np.array([]), radiation="exponential", end=6.0))
    assert np.abs(heave(fixed) - exact).max() > 0.1


def write_released(folder: Path, reference: Path, *, lightens: bool) -> Array:
    """Write tables of the sphere of 5 m that is let go out of the water; return their poses.

    Added mass at 19 positions by a boundary-element method, or that of rest. The damping of long
    waves goes with the square of the waterplane.
    """
    rows = np.genfromtxt(
        reference / "nonlinear" / "sphere_ainf_z" / "ainf.csv", delimiter=",", names=True
    )
    ratio = np.r_[rows["A_over_half_sphere_mass"], 0.002]
    poses = RADIUS * np.r_[rows["z_over_R"], 1.0]
    write_tables(folder, poses)
    rest = HydroDatabase.read(folder / "hydro.h5")
    for k, added in enumerate(ratio / ratio[poses == 0.0] if lightens else np.ones(poses.size)):
        damping = max(1.0 - (poses[k] / RADIUS) ** 2, 0.0) ** 2
        inf = {"added_mass_inf": added * rest.memory["heave"].added_mass_inf}
        fit = rest.memory["heave"]
        fit = replace(fit, output_matrix=damping * fit.output_matrix, **inf)
        table = HydroDatabase.read(folder / f"pose{k}.h5")
        replace(table, memory={"heave": fit}).write(folder / f"pose{k}.h5")
    return np.asarray(poses)


@pytest.mark.parametrize("lightens", [True, False])
def test_the_release_of_a_sphere(tmp_path: Path, reference: Path, lightens: bool) -> None:
    """From 5 m, where it leaves the water: both memories by an own program.

    The series comes from a program with the added mass and the memory of rest.
    """
    poses = write_released(tmp_path, reference, lightens=lightens)
    series = np.genfromtxt(
        reference / "nonlinear" / "sphere_5m_oes" / "decay_5m.csv", delimiter=",", names=True
    )
    errors = []
    for memory in ("rest", "blended"):
        path = write_case(tmp_path, poses, memory, radiation="exponential", rise=4.99, end=15.0)
        results = hydrodae.run(path)
        exact = reference_decay(tmp_path, poses, results.time, memory, start=4.99)
        np.testing.assert_allclose(heave(results), exact, atol=2e-5)
        other = np.interp(results.time, series["time"], series["NREL_CFD"])
        errors.append(float(np.sqrt(np.mean((heave(results) - other) ** 2))))
    assert errors[0] < errors[1]
    assert lightens or (errors[0] < 0.05 and errors[1] > 0.25)


@pytest.mark.parametrize("radiation", ["none", "exponential", "constant"])
def test_equal_tables_are_one_database(tmp_path: Path, radiation: str) -> None:
    poses = np.array([-4.0, -1.0, 2.0, 5.0])
    write_tables(tmp_path, poses)
    rest = HydroDatabase.read(tmp_path / "hydro.h5")
    for k, pose in enumerate(poses):
        body = rest.bodies["sphere"]
        moved = replace(body, reference_point=body.reference_point + np.array([0.0, 0.0, pose]))
        replace(rest, bodies={"sphere": moved}).write(tmp_path / f"pose{k}.h5")
    more: Table = dict(radiation=radiation, motion="planar", wave=[SWELL])
    if radiation == "constant":
        more["frequency"] = 1.3
    if radiation == "exponential":
        more["motion"] = "heave"
    one = hydrodae.run(write_case(tmp_path, np.array([]), **more))
    several = hydrodae.run(write_case(tmp_path, poses, **more))
    np.testing.assert_allclose(heave(several), heave(one), atol=1e-7)


def test_a_finer_table_converges(tmp_path: Path) -> None:
    found = []
    for n in (4, 7, 13, 25):
        poses = np.linspace(-4.8, 4.8, n)
        write_tables(tmp_path, poses)
        found.append(heave(hydrodae.run(write_case(tmp_path, poses, end=5.0))))
    errors = [float(np.abs(series - found[-1]).max()) for series in found[:-1]]
    assert errors[1] < 0.3 * errors[0]
    assert errors[2] < 0.1 * errors[1]  # fourth order: a sixteenth


def test_a_pose_beyond_the_table_ends_the_run(tmp_path: Path) -> None:
    poses = np.array([-1.0, 0.0, 1.0, 3.2])
    write_tables(tmp_path, poses)
    with stopped("range", "bodies/float"):
        hydrodae.run(write_case(tmp_path, poses))


@pytest.mark.parametrize(
    ("table", "hydro", "message"),
    [
        ({"coordinate": "pitch"}, {}, "values_deg"),
        ({"values": [2.0, 0.0, 1.0]}, {}, "two or more ascending"),
        ({"values": [-1.0, 0.0]}, {}, "give one for each"),
        ({"values": [-1.0, 0.5, 1.0]}, {}, "center_of_gravity"),
        ({"body": "flaot"}, {}, "did you mean"),
        ({}, {"radiation": "convolution"}, "no tables over poses"),
        ({"memory": "blended"}, {}, "needs radiation"),
    ],
)
def test_a_wrong_table_is_refused(tmp_path: Path, table: Table, hydro: Table, message: str) -> None:
    poses = np.array([-1.0, 0.0, 1.0])
    write_tables(tmp_path, poses)
    with pytest.raises(CaseError, match=message):
        hydrodae.run(write_case(tmp_path, poses, table=table, **hydro))


def test_the_frequency_domain_takes_the_tables_at_equilibrium(tmp_path: Path) -> None:
    poses = np.linspace(-4.0, 4.0, 9)
    write_tables(tmp_path, poses)
    # heavier: it floats 1 m deeper
    deeper = RHO * _volume(*hulls.sphere(RADIUS, 12), -1.0)
    model = LinearModel(write_case(tmp_path, poses, mass=deeper))
    rest = HydroDatabase.read(tmp_path / "hydro.h5")
    added, _ = model.added(np.array([1.2]))
    i = list(rest.coordinates).index("sphere.heave")
    at_rest = CubicSpline(rest.omega, rest.added_mass[:, i, i], bc_type="natural")(1.2)
    assert added[0, 0, 0] == pytest.approx(float(growth(-1.0)) * float(at_rest), rel=1e-4)


def test_the_added_mass_of_a_small_sphere_keeps_the_energy(tmp_path: Path, reference: Path) -> None:
    # 19 positions by a boundary-element method; let go from 0.8 radii, without waves and radiation
    rows = np.genfromtxt(
        reference / "nonlinear" / "sphere_ainf_z" / "ainf.csv", delimiter=",", names=True
    )
    radius, mass = 0.15, 7.056
    rest = HydroDatabase.read(ROOT / "cases" / "sphere" / "hydro.h5")
    i = rest.coordinates.index("sphere.heave")
    files, poses = [], radius * rows["z_over_R"]
    for k, (pose, added) in enumerate(zip(poses, rows["A_extrapolated_kg"], strict=True)):
        inf = np.zeros_like(rest.added_mass_inf)
        inf[i, i] = added
        point = np.array([0.0, 0.0, pose])
        hull = replace(rest.bodies["sphere"], reference_point=point, hydrostatics=None)
        files.append(f"pose{k}.h5")
        replace(
            rest, added_mass_inf=inf, rho=998.2, bodies={"sphere": hull}, memory={}, kernel=None
        ).write(tmp_path / files[-1])
    hulls.write_obj(tmp_path / "sphere.obj", hulls.sphere(radius, 12))
    middle = files[int(np.abs(poses).argmin())]
    ball = body("ball", "heave", mass, displacement=[0.0, 0.0, 0.8 * radius])
    ball |= {"hydro": "sphere", "mesh": "sphere.obj", "hydrostatics": "mesh"}
    table: Table = dict(name="depth", body="ball", coordinate="heave")
    table |= dict(values=poses.tolist(), databases=files)
    water = {"database": middle, "radiation": "none"}
    tables = case([ball], 4.0, hydro=water, pose_table=[table], samples=400)
    results = run_tables(tables, tmp_path, rtol=1e-12)
    total, kinetic = results["energy/total"].values, results["energy/kinetic"].values
    assert np.ptp(results["bodies/ball/position"].values[:, 2]) > 1.5 * 0.8 * radius
    assert np.abs(total - total[0]).max() < 1e-8 * kinetic.max()


def test_a_table_over_pitch_gives_one_motion_by_all_methods(tmp_path: Path) -> None:
    poses = np.array([-30.0, -10.0, 10.0, 30.0])
    write_tables(tmp_path, poses / 10.0, turns=True)
    turns = dict(coordinate="pitch", values=None, values_deg=poses.tolist())
    start = {"rotation_deg": [0, 12, 0]}
    given: Table = dict(motion="planar", rise=0.5, end=10.0, start=start, table=turns)
    water: Table = dict(radiation="constant", frequency=1.3, wave=[SWELL])
    path = write_case(tmp_path, poses, **given, **water)
    places = [
        hydrodae.run(path, set={"solver.method": method})["bodies/float/position"].values
        for method in ("explicit_rk", "radau", "ida")
    ]
    assert np.ptp(places[0][:, 0]) > 1.0
    for place in places[1:]:
        np.testing.assert_allclose(place, places[0], atol=2e-6)


def test_a_table_of_a_coupled_body_is_refused(tmp_path: Path) -> None:
    folder = ROOT / "cases" / "f3of"
    (tmp_path / "hydro.h5").write_bytes((folder / "hydro.h5").read_bytes())
    table = dict(name="turn", body="flap1", coordinate="pitch", values_deg=[-20.0, 20.0])
    text = f"pose_table = [{to_toml(table | {'databases': ['hydro.h5'] * 2})}]\n"
    path = tmp_path / "case.toml"
    path.write_text(text + (folder / "flap_decay.toml").read_text())
    with wrong("pose_table.turn.body"):
        hydrodae.run(path)
