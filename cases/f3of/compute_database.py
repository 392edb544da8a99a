"""Hydrodynamic database of the F3OF device: Capytaine run, netCDF file, `hydro.h5` with its fits.

    python cases/f3of/compute_database.py -o cases/f3of/hydro.h5

Three bodies with six coordinates each about their centres of gravity, infinite depth, direct
method, lids on the inner water planes. The mesh keeps both planes of symmetry, which cuts the work
by four. Every frequency is kept in the build folder as soon as it is done: an interrupted run goes
on where it stopped, and a changed mesh or setting starts a new folder. Capytaine uses all
processors; set OMP_NUM_THREADS to allow fewer.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from cases.f3of.mesh import CENTER_OF_GRAVITY, PanelSize, bodies, quarter  # noqa: E402
from cases.f3of.panels import Array, check, hydrostatics  # noqa: E402

from hydrodae import hdb  # noqa: E402
from hydrodae.hdb.memory import fit_memory  # noqa: E402
from hydrodae.support.extras import install_command  # noqa: E402

try:
    import capytaine as cpt
    from capytaine.bodies.dofs import DofOnSubmesh, rigid_body_dofs
    from capytaine.tools.block_circulant_matrices import NestedBlockCirculantMatrix
except ModuleNotFoundError:
    print(f"compute_database.py needs Capytaine: {install_command('bem')}", file=sys.stderr)
    sys.exit(2)

RHO, GRAVITY = 1025.0, 9.81  # kg/m3, m/s2
HEADINGS = np.radians([0.0, 45.0, 90.0, 135.0, 180.0])
PLANAR = ("Surge", "Heave", "Pitch")
TABLES = ("added_mass", "radiation_damping", "diffraction_force", "Froude_Krylov_force")


def frequencies() -> Array:
    """Grid [rad/s], ending with infinity: fine where waves between the flaps resonate.

    It ends at 3.2 rad/s, where a wave is five panels long. Beyond 3.5 rad/s damping of motion in
    the plane has negative eigenvalues (across it from 2.9 rad/s): no passive memory follows that.
    """
    low, resonant = np.arange(4, 98, 4), np.arange(100, 300)
    return np.append(np.concatenate([low, resonant, np.arange(300, 321, 2)]) / 100.0, np.inf)


def capytaine_mesh(panels: Array) -> cpt.ReflectionSymmetricMesh:
    """Mesh with both planes of symmetry from the panels (n, 4, 3) of the quarter."""
    vertices, index = np.unique(panels.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    part = cpt.Mesh(vertices=vertices, faces=index.reshape(-1, 4))
    half = cpt.ReflectionSymmetricMesh(part, plane="xOz")
    return cpt.ReflectionSymmetricMesh(half, plane="yOz")


def device(size: PanelSize) -> cpt.FloatingBody:
    """All three bodies as one mesh with 18 degrees of freedom `<body>__<Dof>`."""
    part = quarter(size=size)
    hull = capytaine_mesh(np.concatenate([part["base"], part["flap"]]))
    lid = capytaine_mesh(part["lid"])
    if lid.nb_faces == 0 or lid.faces_areas.max() > hull.faces_areas.max():
        raise ValueError("the lid needs panels, and none larger than those of the hull")
    flap = np.arange(len(part["base"]) + len(part["flap"])) >= len(part["base"])
    flap = np.tile(flap, 4)  # order of the reflected quarters
    x = hull.faces_centers[:, 0]
    masks = {"base": ~flap, "flap1": flap & (x < 0.0), "flap2": flap & (x > 0.0)}
    dofs = {
        f"{name}__{dof}": DofOnSubmesh(motion, np.flatnonzero(masks[name]))
        for name, point in CENTER_OF_GRAVITY.items()
        for dof, motion in rigid_body_dofs(rotation_center=np.array(point)).items()
    }
    return cpt.FloatingBody(mesh=hull, lid_mesh=lid, dofs=dofs, name="f3of")


def solve(body: cpt.FloatingBody, omega: float, solver: cpt.BEMSolver) -> xr.Dataset:
    """All radiation and diffraction problems of one frequency (one factorisation).

    Raises
    ------
    ValueError
        NaN in the result.
    """
    common: dict[str, Any] = {"body": body, "omega": omega, "rho": RHO, "g": GRAVITY}
    problems = [cpt.RadiationProblem(radiating_dof=d, **common) for d in body.dofs]
    if np.isfinite(omega):
        problems += [cpt.DiffractionProblem(wave_direction=h, **common) for h in HEADINGS]
    results = [solver.solve(p, keep_details=False, _check_wavelength=False) for p in problems]
    # Capytaine 3.0 keeps the matrices of the last 128 frequencies alive in this cache (15 GB here)
    NestedBlockCirculantMatrix.to_BlockCirculantMatrix.cache_clear()
    names = list(body.dofs)
    data: xr.Dataset = cpt.assemble_dataset(results)
    data = data.sel(influenced_dof=names, radiating_dof=names)
    data = data.assign_coords(influenced_dof=names, radiating_dof=names)  # plain text for netCDF
    missing = {k: int(np.isnan(data[k].values).sum()) for k in TABLES if k in data}
    if not np.isfinite(omega):
        missing["radiation_damping"] = 0  # not defined at infinity
    if any(missing.values()):
        raise ValueError(f"NaN in the results at w = {omega} rad/s: {missing}")
    return data


def settings_key(size: PanelSize) -> str:
    """Short hash of mesh, constants and Capytaine version: name of the folder of results."""
    text = f"{cpt.__version__} {RHO} {GRAVITY} {HEADINGS.round(9).tolist()}"
    digest = hashlib.sha256(text.encode())
    for name, panels in sorted(quarter(size=size).items()):
        digest.update(name.encode() + panels.round(9).tobytes())
    return digest.hexdigest()[:12]


def run(build: Path, size: PanelSize) -> list[Path]:
    """Solve what is not in the build folder yet; one netCDF file for each frequency."""
    folder = build / settings_key(size)
    folder.mkdir(parents=True, exist_ok=True)
    files = {w: folder / f"omega_{w:.4f}.nc" for w in frequencies()}
    todo = [w for w, f in files.items() if not f.is_file()]
    print(f"{len(files)} frequencies, {len(todo)} to do, in {folder}")
    if not todo:
        return list(files.values())
    body, solver = device(size), cpt.BEMSolver(method="direct")
    print(f"{body.mesh.nb_faces} panels and {body.lid_mesh.nb_faces} on the lids")
    start = time.monotonic()
    for i, w in enumerate(todo, start=1):
        data = cpt.io.xarray.separate_complex_values(solve(body, w, solver))
        partial = files[w].with_suffix(".part")
        data.to_netcdf(partial)
        partial.rename(files[w])
        spent = time.monotonic() - start
        left = spent / i * (len(todo) - i)
        print(f"{i}/{len(todo)}  w = {w:.4g} rad/s  {spent:.0f} s, {left:.0f} s left", flush=True)
    return list(files.values())


def collect(files: list[Path]) -> xr.Dataset:
    """One dataset of all frequencies, with the reference points of the three bodies.

    Motion in the plane y = 0 is not coupled to motion across it; the noise there is removed.

    Raises
    ------
    ValueError
        That noise is more than noise.
    """
    parts = []
    for file in files:
        with xr.open_dataset(file) as opened:
            parts.append(opened.load())
    data = xr.concat(
        parts, "omega", data_vars="all", coords="minimal", compat="override", join="outer"
    )
    data = data.sortby("omega").drop_vars("rotation_center", errors="ignore")
    in_plane = [str(d).endswith(PLANAR) for d in data["influenced_dof"].values]
    row = xr.DataArray(in_plane, dims="influenced_dof")
    column = xr.DataArray(in_plane, dims="radiating_dof")
    for name in ("added_mass", "radiation_damping"):
        table = data[name]
        leak = float(abs(table.where(row != column)).max() / abs(table).max())
        if leak > 1e-4:
            raise ValueError(f"{name}: motions in and across y = 0 are coupled by {leak:.2g}")
        data[name] = table.where(row == column, 0.0)
    data = data.assign_coords(body_name=list(CENTER_OF_GRAVITY))
    points = np.array(list(CENTER_OF_GRAVITY.values()))
    data["rotation_center"] = (("body_name", "space_coordinate"), points)
    return data


def with_fits(database: hdb.HydroDatabase) -> hdb.HydroDatabase:
    """Add the radiation memory of the flaps on a fixed base, and of the free device, in the plane.

    Raises
    ------
    DatabaseError
        A fit is not possible.
    """
    everything = "base.planar,flap1.planar,flap2.planar"
    outputs = hdb.expand(everything, database.coordinates)
    for name, moving, states in (
        ("flaps_planar", "flap1.planar,flap2.planar", 130),
        ("planar", everything, 240),
    ):
        start = time.monotonic()
        inputs = hdb.expand(moving, database.coordinates)
        fit = fit_memory(database, inputs, outputs, max_states=states, name=name, progress=print)
        database.memory[name] = fit
        print(f"fit {name}: {time.monotonic() - start:.0f} s")
        for key in ("n_states", "passive", "min_eig_re_h_relative", "h_error_band", "h_error_all"):
            print(f"  {key} {fit.report[key]}")
    return database


def main() -> None:
    """Compute the database of the F3OF device and write hydro.h5."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("-o", "--output", type=Path, required=True, help="hydro.h5 to write")
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "f3of", help="kept results")
    args = parser.parse_args()
    cpt.set_logging("ERROR")
    size, surfaces = PanelSize(), bodies()
    check(surfaces)
    statics = {n: hydrostatics(p, CENTER_OF_GRAVITY[n]) for n, p in surfaces.items()}
    for name, h in statics.items():
        print(f"{name}: {len(surfaces[name])} panels, {h.displaced_volume:.3f} m3")
    netcdf = args.build / "f3of.nc"
    data = collect(run(args.build, size))
    data.to_netcdf(netcdf)
    database, report = hdb.import_database(netcdf, hydrostatics=statics)
    print(report)
    if not report.ok:
        raise SystemExit(f"{netcdf}: the checks found errors, see above")
    database = database.with_meshes(surfaces)
    with_fits(database).write(args.output, single=True)
    print(f"wrote {args.output}, {args.output.stat().st_size / 1024:.0f} KiB")


if __name__ == "__main__":
    main()
