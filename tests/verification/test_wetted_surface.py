"""Hydrostatics and Froude-Krylov loads of the wetted part of a mesh, in whole runs."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from tests.attack.parts import Table, body, case
from tests.verification import hulls
from tests.verification.blocks import case_of, run_tables
from tests.verification.hull_truths import cap_decay, panel_heave

import hydrodae
from hydrodae.commands import cli

RHO, GRAVITY = 1000.0, 9.81
ROOT = Path(__file__).resolve().parents[2]
MESHED = {"hydrostatics": "mesh", "froude_krylov": "mesh", "mesh": "sphere.obj"}


def _float(
    mesh: str,
    mass: float,
    end: float = 10.0,
    *,
    motion: str = "heave",
    height: float = 0.0,
    inertia: float = 1.0,
    release: float = 0.0,
    pitch: float = 0.0,
    step: float = 0.05,
) -> Table:
    """Return a float whose only loads are those of its mesh and its weight."""
    start = dict(displacement=[0.0, 0.0, release], rotation_deg=[0.0, pitch, 0.0])
    hull = body("float", motion, mass, [0.0, 0.0, height], [inertia] * 3, **start)
    hull |= {"mesh": mesh, "hydrostatics": "mesh"}
    water: Table = {
        "environment": {"gravity": 9.81, "water_density": 1000.0},
        "output": {"step": step},
    }
    return case([hull], end, **water)


@pytest.mark.parametrize(
    ("name", "write"),
    [
        ("box.obj", hulls.write_obj),
        ("box.stl", hulls.write_stl),
        ("box.STL", hulls.write_binary_stl),
    ],
)
def test_a_box_heaves_as_in_closed_form(
    tmp_path: Path, name: str, write: Callable[..., None]
) -> None:
    # without added mass: m z'' = -rho g A z, as long as its deck is dry and its bottom wet
    write(tmp_path / name, hulls.box(4.0, 2.0, -1.0, 1.5))
    tables = _float(name, RHO * 8.0, release=0.8)
    results = run_tables(tables, tmp_path, rtol=1e-8)
    rate = np.sqrt(GRAVITY / 1.0)
    exact = 0.8 * np.cos(rate * results.time)
    np.testing.assert_allclose(results["bodies/float/position"].values[:, 2], exact, atol=1e-5)


def test_a_turned_box_has_the_load_of_its_submerged_prism(tmp_path: Path) -> None:
    # Turned by a about y through a point at depth d; in body axes the water reaches up to
    # s = d / cos(a) + x tan(a) above that point, the bottom is 0.8 m below it.
    hulls.write_obj(tmp_path / "box.obj", hulls.box(4.0, 2.0, -1.0, 1.5))
    depth, bottom, angle = 0.2, 0.8, np.deg2rad(20.0)
    turned = dict(height=-depth, inertia=2.0e4, pitch=20.0, step=0.01)
    tables = _float("box.obj", RHO * 8.0, 0.02, motion="planar", **turned)
    results = run_tables(tables, tmp_path, rtol=1e-8)
    middle, slope = depth / np.cos(angle), np.tan(angle)
    volume = 2.0 * 4.0 * (middle + bottom)
    along = 2.0 * slope * 16.0 / 3.0  # integral of x over the prism
    upwards = 4.0 * middle**2 + slope**2 * 16.0 / 3.0 - 4.0 * bottom**2  # of s
    arm = along * np.cos(angle) + upwards * np.sin(angle)
    force = results["forces/hydrostatic/float/force"].values[0]
    moment = results["forces/hydrostatic/float/moment"].values[0]
    np.testing.assert_allclose(force, [0.0, 0.0, RHO * GRAVITY * volume], rtol=1e-10, atol=1e-6)
    np.testing.assert_allclose(moment, [0.0, -RHO * GRAVITY * arm, 0.0], rtol=1e-10, atol=1e-6)


@pytest.mark.parametrize("shape", ["sphere", "cone"])
@pytest.mark.parametrize("method", ["auto", "radau"])
def test_undamped_bobbing_keeps_its_energy(tmp_path: Path, shape: str, method: str) -> None:
    if shape == "sphere":
        mesh, mass = hulls.sphere(1.0, 10), RHO * 2.0 / 3.0 * np.pi
    else:  # its apex 1 m below the water at rest
        mesh = hulls.revolved(np.array([0.0, 2.0, 0.0]), np.array([-1.0, 1.0, 1.0]), 48)
        mass = RHO * np.pi / 3.0
    hulls.write_obj(tmp_path / "hull.obj", mesh)
    tables = _float("hull.obj", float(mass), 190.0, release=0.8)
    results = run_tables(tables, tmp_path, method=method, rtol=1e-9)
    total = results["energy/total"].values
    assert np.ptp(results["bodies/float/position"].values[:, 2]) > 1.3
    assert np.abs(total - total[0]).max() < 1e-6 * results["energy/kinetic"].values.max()


def _sphere_in_waves(
    folder: Path,
    height: float,
    hull: Table,
    end: float = 100.0,
    *,
    motion: str = "heave",
    ramp: float = 30.0,
    release: float = 0.0,
    facets: int = 30,
    **more: Any,
) -> hydrodae.Case:
    """Return the sphere of cases/sphere in a wave, or in still water if its height is 0."""
    shutil.copy(ROOT / "cases" / "sphere" / "hydro.h5", folder)
    hulls.write_obj(folder / "sphere.obj", hulls.sphere(5.0, facets))
    start = [0.0, 0.0, release]
    sphere = body("sphere", motion, 261.8e3, [0.0, 0.0, -2.0], displacement=start)
    if height:
        swell = dict(name="swell", type="regular", period=5.0, height=height)
        more |= {"sea": {"ramp": ramp}, "wave": [swell]}
    output = {"step": 0.1 if height else 0.01}
    given: Table = dict(hydro={"database": "hydro.h5"}, output=output, **more)
    return case_of(case([sphere | {"hydro": "sphere"} | hull], end, **given), folder, rtol=1e-7)


@pytest.mark.parametrize("split", [True, False])
def test_small_waves_move_it_as_linear_theory_says(tmp_path: Path, split: bool) -> None:
    """Whether the database has Froude-Krylov and diffraction loads apart or their sum alone."""
    height = 0.004  # 1e-4 of the length
    linear = hydrodae.run(_sphere_in_waves(tmp_path, height, {}))
    small = _sphere_in_waves(tmp_path, height, MESHED)
    if not split:
        with h5py.File(tmp_path / "hydro.h5", "r+") as file:
            parts = file["excitation"]
            parts["diffraction"][...] += parts["froude_krylov"][...]
            parts["froude_krylov"][...] = 0.0
            parts.attrs["split"] = "total only"
    meshed = hydrodae.run(small)
    late = linear.time > 60.0
    a, b = (r["bodies/sphere/position"].values[late, 2] for r in (linear, meshed))
    a, b = a - a.mean(), b - b.mean()  # facets and digits of the mass move the mean
    assert np.abs(a - b).max() < 0.005 * np.abs(a).max()
    # in heave the hydrostatic part changes too, so the load of the waves is compared in surge
    parts = (linear, "froude_krylov"), (meshed, "wave_pressure")
    loads = [r[f"forces/{part}/sphere/force"].values[late, 0] for r, part in parts]
    assert np.ptp(loads[1]) == pytest.approx(np.ptp(loads[0]), rel=0.01)


def test_a_sphere_released_from_its_radius_follows_the_exact_cap(tmp_path: Path) -> None:
    errors = []
    for n in (15, 30):
        drop = _sphere_in_waves(tmp_path, 0.0, MESHED, end=16.0, release=5.0, facets=n)
        results = hydrodae.run(drop)
        heave = results["bodies/sphere/position"].values[:, 2] + 2.0
        exact = cap_decay(tmp_path / "hydro.h5", 5.0, 261.8e3, 5.0, results.time)
        errors.append(np.sqrt(np.mean((heave - exact) ** 2)))
    assert errors[1] < 0.005  # m
    assert 3.0 < errors[0] / errors[1] < 5.0  # of second order in the size of the triangles


@pytest.mark.parametrize("stretching", ["vertical", "none"])
def test_large_waves_move_it_as_an_independent_program_says(
    tmp_path: Path, stretching: str
) -> None:
    large = _sphere_in_waves(tmp_path, 3.0, MESHED, end=60.0)
    radiation = {"hydro.radiation": "constant", "hydro.frequency": 2.0 * np.pi / 5.0}
    results = hydrodae.run(large, set={"sea.stretching": stretching, **radiation})
    heave = results["bodies/sphere/position"].values[:, 2] + 2.0
    times = np.arange(0.0, 60.01, 0.05)
    own = panel_heave(
        tmp_path / "hydro.h5",
        hulls.sphere(5.0, 60),
        261.8e3,
        2.0 * np.pi / 5.0,
        1.5,
        30.0,
        times,
        mean=stretching == "none",
    )
    late = results.time > 40.0
    assert np.abs(heave - own[::2])[late].max() < 0.003 * np.ptp(heave[late])


@pytest.mark.parametrize(
    ("hull", "message"),
    [
        ({"mesh": "sphere.obj"}, 'a mesh does nothing without hydrostatics = "mesh"'),
        ({"hydrostatics": "mesh"}, "needs 'mesh', the file of the surface"),
        (MESHED | {"hydrostatics": "linear"}, "a mesh does nothing without"),
        ({"mesh": "none.stl", "hydrostatics": "mesh"}, "cannot read the mesh"),
        ({"mesh": "hydro.h5", "hydrostatics": "mesh"}, "a mesh is an .stl or .obj file"),
        ({"mesh": "open.obj", "hydrostatics": "mesh"}, "key 'mesh' in [[body]] 'sphere'"),
    ],
)
def test_what_a_mesh_lacks_is_said(tmp_path: Path, hull: Table, message: str) -> None:
    vertices, triangles = hulls.sphere(5.0, 6)
    hulls.write_obj(tmp_path / "open.obj", (vertices, triangles[:-1]))
    with pytest.raises(hydrodae.CaseError) as error:
        _sphere_in_waves(tmp_path, 1.0, hull)
    assert message in error.value.fault
    assert error.value.key.startswith("body.sphere.")


def test_an_element_inside_the_mesh_leaves_the_waves_to_it(tmp_path: Path) -> None:
    """rho V (1 + C_a) a_f holds the undisturbed waves, which the mesh has by its pressure."""
    ball = dict(body="sphere", volume=10.0, added_mass_coefficient=0.25)
    inside = ball | {"name": "inside", "point": [0.0, 0.0, -2.5]}
    beside = ball | {"name": "beside", "point": [6.0, 0.0, -2.5]}

    def fixed(hull: Table, *elements: Table) -> hydrodae.Results:
        given: Table = dict(end=20.0, motion="fixed", ramp=2.0, morison=elements)
        return hydrodae.run(_sphere_in_waves(tmp_path, 0.5, hull, **given))

    forces = []
    for hull in (MESHED, {}):
        results = fixed(hull, inside, beside)
        forces.append({k: results[f"forces/{k}/sphere/force"].values for k in ("inside", "beside")})
        assert ("lies inside the mesh" in str(results.notes)) == bool(hull)
    assert np.abs(forces[1]["inside"]).max() > 100.0
    np.testing.assert_allclose(forces[0]["inside"], 0.2 * forces[1]["inside"], atol=1e-6)
    np.testing.assert_allclose(forces[0]["beside"], forces[1]["beside"], atol=1e-6)
    ends = dict(point_a=[0.0, 0.0, -2.5], point_b=[0.0, 0.0, -9.0], diameter=1.0)
    member = dict(name="inside", body="sphere", added_mass_coefficient=0.25, **ends)
    with pytest.raises(hydrodae.CaseError, match="8 of its 20 pieces lie inside the mesh") as error:
        fixed(MESHED, member, beside)
    assert error.value.key == "morison.inside"


@pytest.mark.parametrize(("height", "capsizes"), [(1.2, True), (-0.2, False)])
def test_a_meshed_body_that_is_top_heavy_is_found(
    tmp_path: Path, height: float, capsizes: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    """Box 4 m long, draught 1 m: BM = 4^2 / 12 m in pitch, so it capsizes with G above 0.833 m."""
    hulls.write_obj(tmp_path / "box.obj", hulls.box(4.0, 2.0, -1.0, 1.5))
    tables = _float("box.obj", 8000.0, motion="planar", height=height, inertia=1e4)
    path = tmp_path / "case.toml"
    path.write_text(case_of(tables, tmp_path).text)
    cli.main(["check", str(path)])
    assert (
        "body 'float' capsizes: its pitch stiffness" in "".join(capsys.readouterr())
    ) == capsizes
