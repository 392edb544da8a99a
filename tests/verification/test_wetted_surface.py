"""Hydrostatics and Froude-Krylov loads of the wetted part of a mesh, in whole runs."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
from tests.verification import hulls

import hydrodae

RHO, GRAVITY = 1000.0, 9.81
ROOT = Path(__file__).resolve().parents[2]
FLOAT = """
[environment]
gravity = 9.81
water_density = 1000.0
[[body]]
name = "float"
motion = "{motion}"
mass = {mass!r}
center_of_gravity = [0.0, 0.0, {height!r}]
inertia = [{inertia!r}, {inertia!r}, {inertia!r}]
mesh = "{mesh}"
hydrostatics = "mesh"
initial = {{ displacement = [0.0, 0.0, {release!r}], rotation_deg = [0.0, {pitch!r}, 0.0] }}
[solver]
end_time = {end!r}
rtol = {rtol!r}
[output]
step = {step!r}
"""


def _float(folder: Path, mesh: str, mass: float, **more: float | str) -> Path:
    values = {"motion": "heave", "height": 0.0, "inertia": 1.0, "release": 0.0, "pitch": 0.0,
              "end": 10.0, "rtol": 1e-8, "step": 0.05}  # fmt: skip
    path = folder / "case.toml"
    path.write_text(FLOAT.format(mesh=mesh, mass=mass, **(values | more)))
    return path


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
    results = hydrodae.run(_float(tmp_path, name, RHO * 8.0, release=0.8))
    rate = np.sqrt(GRAVITY / 1.0)
    exact = 0.8 * np.cos(rate * results.time)
    np.testing.assert_allclose(results["bodies/float/position"].values[:, 2], exact, atol=1e-5)


def test_a_box_rolls_by_the_lever_of_a_wall_sided_hull(tmp_path: Path) -> None:
    # GZ = sin(phi) (GM + BM tan^2(phi) / 2), held in heave at its draught by volume
    hulls.write_obj(tmp_path / "box.obj", hulls.box(4.0, 2.0, -1.0, 1.5))
    mass, inertia, start = RHO * 8.0, 2.0e4, 20.0
    path = _float(tmp_path, "box.obj", mass, motion="planar", height=-0.2, inertia=inertia,
                  pitch=start, end=0.02, step=0.01)  # fmt: skip
    results = hydrodae.run(path)
    turned = np.deg2rad(start)
    above = 0.5 - 0.2  # centre of gravity over the centre of buoyancy, upright
    beam = 4.0**2 / 12.0 / 1.0  # BM = I / V
    lever = np.sin(turned) * (beam - above + 0.5 * beam * np.tan(turned) ** 2)
    # the draught at the centre line does not change at equal volume; the point 0.2 m below does
    moment = results["forces/hydrostatic/float/moment"].values[0, 1]
    force = results["forces/hydrostatic/float/force"].values[0, 2]
    assert moment == pytest.approx(-lever * mass * GRAVITY, rel=0.05)
    assert force == pytest.approx(mass * GRAVITY, rel=0.05)


@pytest.mark.parametrize("shape", ["sphere", "cone"])
@pytest.mark.parametrize("method", ["auto", "radau"])
def test_undamped_bobbing_keeps_its_energy(tmp_path: Path, shape: str, method: str) -> None:
    if shape == "sphere":
        mesh, mass = hulls.sphere(1.0, 10), RHO * 2.0 / 3.0 * np.pi
    else:  # its apex 1 m below the water at rest
        mesh = hulls.revolved(np.array([0.0, 2.0, 0.0]), np.array([-1.0, 1.0, 1.0]), 48)
        mass = RHO * np.pi / 3.0
    hulls.write_obj(tmp_path / "hull.obj", mesh)
    path = _float(tmp_path, "hull.obj", float(mass), release=0.8, end=190.0, rtol=1e-9)
    results = hydrodae.run(path, set={"solver.method": method})
    total = results["energy/total"].values
    assert np.ptp(results["bodies/float/position"].values[:, 2]) > 1.3
    assert np.abs(total - total[0]).max() < 1e-6 * results["energy/kinetic"].values.max()


def _sphere_in_waves(folder: Path, height: float, more: str, end: float = 100.0) -> Path:
    shutil.copy(ROOT / "cases" / "sphere" / "hydro.h5", folder)
    hulls.write_obj(folder / "sphere.obj", hulls.sphere(5.0, 30))
    path = folder / "case.toml"
    path.write_text(f"""
[hydro]
database = "hydro.h5"
[sea]
ramp = 30.0
[[wave]]
name = "swell"
type = "regular"
period = 5.0
height = {height!r}
[[body]]
name = "sphere"
hydro = "sphere"
motion = "heave"
mass = 261.8e3
center_of_gravity = [0.0, 0.0, -2.0]
{more}
[solver]
end_time = {end!r}
rtol = 1e-7
[output]
step = 0.1
""")
    return path


MESH = 'mesh = "sphere.obj"\nhydrostatics = "mesh"\nfroude_krylov = "mesh"'


@pytest.mark.parametrize("split", [True, False])
def test_small_waves_move_it_as_linear_theory_says(tmp_path: Path, split: bool) -> None:
    """Whether the database has Froude-Krylov and diffraction loads apart or their sum alone."""
    height = 0.004  # 1e-4 of the length
    linear = hydrodae.run(_sphere_in_waves(tmp_path, height, ""))
    case = _sphere_in_waves(tmp_path, height, MESH)
    if not split:
        with h5py.File(tmp_path / "hydro.h5", "r+") as file:
            parts = file["excitation"]
            parts["diffraction"][...] += parts["froude_krylov"][...]
            parts["froude_krylov"][...] = 0.0
            parts.attrs["split"] = "total only"
    meshed = hydrodae.run(case)
    late = linear.time > 60.0
    a, b = (r["bodies/sphere/position"].values[late, 2] for r in (linear, meshed))
    a, b = a - a.mean(), b - b.mean()  # facets and digits of the mass move the mean
    assert np.abs(a - b).max() < 0.005 * np.abs(a).max()
    # in heave the hydrostatic part changes too, so the load of the waves is compared in surge
    parts = (linear, "froude_krylov"), (meshed, "wave_pressure")
    loads = [r[f"forces/{part}/sphere/force"].values[late, 0] for r, part in parts]
    assert np.ptp(loads[1]) == pytest.approx(np.ptp(loads[0]), rel=0.01)


def test_a_sphere_released_from_its_radius_follows_the_exact_cap(tmp_path: Path) -> None:
    """The extremes of a Cummins equation with the volume of the cap, integrated elsewhere."""
    more = MESH + "\ninitial = { displacement = [0.0, 0.0, 5.0] }"
    text = _sphere_in_waves(tmp_path, 1.0, more, end=16.0).read_text()
    path = tmp_path / "drop.toml"
    before, after = text.split("[sea]")
    path.write_text(before + "[[body]]" + after.split("[[body]]")[1])
    results = hydrodae.run(path, set={"output.step": 0.01})
    heave = results["bodies/sphere/position"].values[:, 2] + 2.0
    first = heave[results.time < 4.0].min()
    second = heave[(results.time > 3.5) & (results.time < 6.0)].max()
    assert first == pytest.approx(-4.177, abs=0.05)
    assert second == pytest.approx(2.917, abs=0.05)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('mesh = "sphere.obj"', 'a mesh does nothing without hydrostatics = "mesh"'),
        ('hydrostatics = "mesh"', "needs 'mesh', the file of the surface"),
        ('mesh = "sphere.obj"\nfroude_krylov = "mesh"\nhydrostatics = "linear"',
         "a mesh does nothing without"),
        ('mesh = "none.stl"\nhydrostatics = "mesh"', "cannot read the mesh"),
        ('mesh = "hydro.h5"\nhydrostatics = "mesh"', "a mesh is an .stl or .obj file"),
        ('mesh = "open.obj"\nhydrostatics = "mesh"', "key 'mesh' in [[body]] 'sphere'"),
    ],
)  # fmt: skip
def test_what_a_mesh_lacks_is_said(tmp_path: Path, body: str, message: str) -> None:
    vertices, triangles = hulls.sphere(5.0, 6)
    hulls.write_obj(tmp_path / "open.obj", (vertices, triangles[:-1]))
    with pytest.raises(hydrodae.CaseError) as error:
        hydrodae.Case.read(_sphere_in_waves(tmp_path, 1.0, body))
    assert message in str(error.value)
    assert "case.toml:" in str(error.value)
