"""Folders of Nemoh 2, Nemoh 3, and of programs that write the same files (Capytaine, SeaFEM).

Nemoh's phasors are e^{-iwt}, elevation Re e^{i(k x' - wt)}: forces are conjugated here. Zones of
RadiationCoefficients.tec are the radiating motions, columns the forces. IRF.tec, Fe.dat, CA.dat and
CM.dat are not read: what they hold is redundant, rounded, or (often) of another run.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import unique_names
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.readers import nemoh_hydrostatics as nh
from hydrodae.hdb.readers import tecplot
from hydrodae.hdb.readers.mesh_beside import statics_of_mesh
from hydrodae.hdb.readers.nemoh_cal import CalBody, NemohCal, read_cal
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.source import SourceData
from hydrodae.support.arrays import Array, Complex
from hydrodae.support.naming import names_file

Mode = tuple[int, int]  # body, degree of freedom

_MOTION = re.compile(r"body\s+(\d+)\s+in\s+DoF\s+(\d+)", re.IGNORECASE)
_NUMBER = r"\s*=\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)(?![\w.+-])"
_BETA = re.compile("beta" + _NUMBER, re.IGNORECASE)
_ANGLE = re.compile("angle" + _NUMBER, re.IGNORECASE)
FORCE_FILES = {
    "excitation": "ExcitationForce.tec",
    "diffraction": "DiffractionForce.tec",
    "froude_krylov": "FKForce.tec",
}


def read_nemoh(path: Path) -> SourceData:
    """Read a Nemoh folder.

    Parameters
    ----------
    path : Path
        The folder that holds `Nemoh.cal`, or that file.

    Raises
    ------
    DatabaseError
        A file is missing or wrong; the message names file and line.
    """
    root = path.parent if path.is_file() else path
    cal_file = path if path.is_file() else nh.find(root, "Nemoh.cal")
    if cal_file is None:
        raise DatabaseError("no Nemoh.cal in it").about("missing", "Nemoh.cal", file=root)
    cal = read_cal(cal_file)
    names = unique_names([body.mesh for body in cal.bodies])
    radiation = nh.find(root, "RadiationCoefficients.tec")
    if radiation is None:
        raise DatabaseError(
            "no RadiationCoefficients.tec in it or in its results folder: an input without "
            "results; run preProc, solver and postProc of Nemoh on it"
        ).about("missing", "RadiationCoefficients.tec", file=root)
    data = _read_tables(root, cal, names, [cal_file, radiation])
    _compare_grid(data, cal)
    meshes = [body.mesh for body in cal.bodies]
    _attach_hydrostatics(data, root, names, meshes)
    data.meshes = nh.wetted_meshes(root, dict(zip(names, meshes, strict=True)))
    return data


def _read_tables(root: Path, cal: NemohCal, names: list[str], files: list[Path]) -> SourceData:
    """Read A, B and the forces; `files` holds Nemoh.cal and RadiationCoefficients.tec."""
    motions = [(b, m.dof) for b, body in enumerate(cal.bodies) for m in body.motions]
    forces = [(b, m.dof) for b, body in enumerate(cal.bodies) for m in body.forces]
    findings: list[Finding] = []
    omega, a, b, order = _read_radiation(files[1], motions, forces)
    kept = [mode for mode in motions if mode in forces]
    rows = [forces.index(mode) for mode in kept]
    columns = [motions.index(mode) for mode in kept]
    if len(kept) < max(len(motions), len(forces)):
        lost = ", ".join(f"{names[i]}.{DOFS[d]}" for i, d in sorted(set(motions) ^ set(forces)))
        text = f"motion or force only, left out: {lost}"
        findings.append(Finding("warning", "coordinates", text))
    up = np.argsort(omega)
    tables: dict[str, Complex | None] = {}
    heading_deg = np.zeros(0)
    for key, name in FORCE_FILES.items():
        force_file = nh.find(root, name)
        tables[key] = None
        if force_file is not None:
            values, heading_deg = _read_forces(force_file, omega, len(forces), cal, heading_deg)
            values = values if order is None else values[:, :, order]
            tables[key] = values[up][:, :, rows]
            files.append(force_file)
    data = SourceData(
        coordinates=tuple(f"{names[i]}.{DOFS[d]}" for i, d in kept),
        omega=omega[up],
        added_mass=a[up][:, rows][:, :, columns],
        radiation_damping=b[up][:, rows][:, :, columns],
        heading=np.radians(heading_deg),
        froude_krylov=tables["froude_krylov"],
        diffraction=tables["diffraction"],
        excitation=tables["excitation"],
        reference_points={n: _point(n, body) for n, body in zip(names, cal.bodies, strict=True)},
        rho=cal.rho,
        gravity=cal.gravity,
        water_depth=cal.depth,
        name=root.name,
        title=f"Nemoh folder {root.name}",
        files=files,
        findings=findings,
        setting=Setting(tuple(f"{names[i]}.{DOFS[d]}" for i, d in forces), wave_point=cal.origin),
    )
    data.to_origin(dict.fromkeys(names, cal.origin))
    return data


@names_file
def _read_radiation(
    path: Path, motions: list[Mode], forces: list[Mode]
) -> tuple[Array, Array, Array, list[int] | None]:
    """Return omega, A, B as (nw, force, motion), and how columns were reordered, if at all."""
    header, blocks = tecplot.read_blocks(path)
    if len(blocks) != len(motions):
        raise DatabaseError(
            f"{len(blocks)} zones, but Nemoh.cal has {len(motions)} degrees of freedom"
        ).about("shape")
    columns = 1 + 2 * len(forces)
    meaning = f"frequency and (A, B) of the {len(forces)} forces of Nemoh.cal"
    tables = [tecplot.table(path, block, columns, meaning) for block in blocks]
    omega = tecplot.to_omega(path, header, blocks[0], tables[0])
    for block, values in zip(blocks, tables, strict=True):
        found = tecplot.to_omega(path, header, block, values)
        _same_grid(path, block, columns, found, omega, blocks[0])
    a = np.stack([t[:, 1::2] for t in tables], axis=2)
    b = np.stack([t[:, 2::2] for t in tables], axis=2)
    order = _zone_order(blocks, motions)
    if order is None:
        return omega, a, b, None
    if motions != forces:
        raise DatabaseError("zones are not in the order of Nemoh.cal").about("order")
    return omega, a[:, order][:, :, order], b[:, order][:, :, order], order


def _zone_order(blocks: list[tecplot.Block], motions: list[Mode]) -> list[int] | None:
    """Position of each motion among the zones by their titles; None if they are in order."""
    named = [b.title.rpartition("__") for b in blocks]
    if all(dof.lower() in DOFS for _, _, dof in named):
        bodies = list(dict.fromkeys(body for body, _, _ in named))
        zones = [(bodies.index(body), DOFS.index(dof.lower())) for body, _, dof in named]
        if sorted(zones) != sorted(motions):
            raise DatabaseError("the zones are not the degrees of freedom of Nemoh.cal").about(
                "order"
            )
        return None if zones == motions else [zones.index(m) for m in motions]
    count: dict[int, int] = {}
    for (body, _), block in zip(motions, blocks, strict=True):
        count[body] = count.get(body, 0) + 1
        found = _MOTION.search(block.title)
        if found and (int(found[1]), int(found[2])) != (body + 1, count[body]):
            raise DatabaseError(
                f"zone of body {found[1]}, DoF {found[2]}, where "
                f"Nemoh.cal has body {body + 1}, DoF {count[body]}"
            ).about("order", line=block.line - 1)
    return None


@names_file
def _read_forces(
    path: Path, omega: Array, count: int, cal: NemohCal, known_deg: Array
) -> tuple[Complex, Array]:
    """Return forces (nw, nh, n) of e^{+iwt}, phase zero at XEFF, YEFF, and the headings [deg]."""
    header, blocks = tecplot.read_blocks(path)
    meaning = f"frequency and (amplitude, phase) of the {count} forces of Nemoh.cal"
    values = np.empty((omega.size, len(blocks), count), dtype=complex)
    for h, block in enumerate(blocks):
        t = tecplot.table(path, block, 1 + 2 * count, meaning)
        _same_grid(path, block, t.shape[1], tecplot.to_omega(path, header, block, t), omega)
        values[:, h] = t[:, 1::2] * np.exp(-1j * t[:, 2::2])
    heading_deg = _headings(blocks, cal)
    if known_deg.size and not np.allclose(known_deg, heading_deg, atol=2e-3):
        raise DatabaseError("headings differ from those of the other force files").about(
            "conflict", "headings"
        )
    return values, heading_deg


def _headings(blocks: list[tecplot.Block], cal: NemohCal) -> Array:
    titles = []
    for block in blocks:
        degrees, radians = _BETA.search(block.title), _ANGLE.search(block.title)
        if degrees:
            titles.append(float(degrees[1]))
        elif radians:
            angle = float(radians[1])
            if abs(angle) > 4.0 * np.pi:
                raise DatabaseError(f"angle {angle:g}: expected radians; degrees?").about(
                    "units", "headings", line=block.line - 1
                )
            titles.append(float(np.degrees(angle)))
        else:
            raise DatabaseError(f"no heading in {block.title!r}").about(
                "missing", "headings", line=block.line - 1
            )
    stated = np.array(titles)
    # titles carry three decimals, Nemoh.cal all of them
    if cal.heading_deg.size == stated.size and np.allclose(cal.heading_deg, stated, atol=2e-3):
        return cal.heading_deg
    return stated


def _same_grid(
    path: Path,
    block: tecplot.Block,
    columns: int,
    found: Array,
    omega: Array,
    first: tecplot.Block | None = None,
) -> None:
    """Refuse a zone whose frequencies are not those of the `first` one of the radiation."""
    if found.shape != omega.shape:
        raise DatabaseError(
            f"the frequencies of this zone are not those of the first one of "
            f"RadiationCoefficients.tec ({found.size} and {omega.size}): files of different runs?"
        ).about("conflict", "frequencies", file=path, line=block.line)
    wrong = np.flatnonzero(~np.isclose(found, omega, rtol=1e-5))
    if not wrong.size:
        return
    row = int(wrong[0])
    place = "RadiationCoefficients.tec" if first is None else f"line {first.line_of(row, columns)}"
    raise DatabaseError(
        f"{found[row]:g} rad/s, but {omega[row]:g} in "
        f"{place}; so in {wrong.size} of {omega.size} rows: "
        + ("is one of them garbled?" if wrong.size < 3 else "files of different runs?")
    ).about("conflict", "frequencies", file=path, line=block.line_of(row, columns))


def _point(name: str, body: CalBody) -> Array | None:
    """Point of the rotations, which all lines of a body must share."""
    lines = [m for m in (*body.motions, *body.forces) if m.dof >= 3]
    points = {m.point for m in lines or (*body.motions, *body.forces)}
    if lines and len(points) > 1:
        raise DatabaseError(f"body {name!r}: moments about several points: {sorted(points)}").about(
            "point", name
        )
    return np.array(points.pop()) if len(points) == 1 else None


def _compare_grid(data: SourceData, cal: NemohCal) -> None:
    asked, found = np.sort(cal.omega), data.omega
    if asked.size != found.size or not np.allclose(asked, found, rtol=2e-3):
        text = (
            f"Nemoh.cal asks for {asked.size} equal steps in {asked[0]:.4g}..{asked[-1]:.4g} "
            f"rad/s (or in period), the results hold {found.size} frequencies "
            f"{found[0]:.4g}..{found[-1]:.4g}, which are used: another run?"
        )
        data.findings.append(Finding("warning", "frequency grid", text))
    headings, wanted = np.degrees(data.heading), cal.heading_deg
    if headings.size and (headings.size != wanted.size or not np.allclose(headings, wanted)):
        text = f"Nemoh.cal asks for {wanted.tolist()} deg, the results hold {headings.tolist()}"
        data.findings.append(Finding("warning", "headings", text))


def _attach_hydrostatics(data: SourceData, root: Path, names: list[str], meshes: list[str]) -> None:
    found, findings = nh.read_all(root, len(names), data.rho, data.gravity)
    data.findings += findings
    data.files += [file for f in found if f is not None for file in f.files]
    for name, mesh, f in zip(names, meshes, found, strict=True):
        if f is None:
            statics_of_mesh(data, root, name, mesh)
    force = data.excitation if data.excitation is not None else data.froude_krylov
    heave = None
    if force is not None:
        heave = np.full(len(names), np.nan)
        for i, name in enumerate(names):
            if f"{name}.heave" in data.coordinates:
                heave[i] = abs(force[0, 0, data.coordinates.index(f"{name}.heave")])
    refused = nh.total_of_all_bodies(found, heave, data.rho, data.gravity)
    if refused is not None:
        points = [data.reference_points[name] for name in names]
        by_mesh = None
        if found[0] is not None and all(p is not None for p in points):
            known = [p for p in points if p is not None]
            by_mesh = nh.from_meshes(root, meshes, found[0].hydrostatics, known)
        if by_mesh is None:
            data.findings.append(refused)
            return
        for name, point, (statics, path) in zip(names, points, by_mesh, strict=True):
            assert point is not None
            data.hydrostatics[name] = (statics, point)
            data.files.append(path)
        shown = ", ".join(path.name for _, path in by_mesh)
        text = (
            f"the files hold the sum of all bodies (a defect of Nemoh 3); taken body by body from "
            f"the meshes {shown}, which add up to it"
        )
        data.findings.append(Finding("info", "assumption", text))
        return
    for name, f in zip(names, found, strict=True):
        if f is None:
            continue
        if data.reference_points[name] is None:
            data.reference_points[name] = f.center_of_gravity
        data.hydrostatics[name] = (f.hydrostatics, f.center_of_gravity)
