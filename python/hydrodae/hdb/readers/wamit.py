"""Output of WAMIT: the numeric files `.1`, `.3` (or `.2`), `.3fk`, `.3sc`, `.hst` of one run.

WAMIT's phasors are e^{+iwt} with the phase zero at the origin of the world, as here. Tables are
dimensionless: A/(rho L^k), B/(rho w L^k), F/(rho g L^m), C/(rho g L^j).
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import unique_names
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.labels import DOFS, bodies_of, read_labels, rigid, six_of_each
from hydrodae.hdb.readers import wamit_tables as tables
from hydrodae.hdb.readers.formats import Format
from hydrodae.hdb.readers.mesh_beside import statics_of_file
from hydrodae.hdb.readers.source import Scales, SourceData, Water, without_hydrostatics
from hydrodae.hdb.readers.text import LARGEST_COUNT
from hydrodae.hdb.readers.wamit_asked import asked_findings
from hydrodae.hdb.readers.wamit_control import Control, beside, mesh_of, read_control
from hydrodae.hdb.readers.wamit_listing import is_listing, read_listing
from hydrodae.hdb.readers.wamit_settled import at_infinity, first_column, settled
from hydrodae.hdb.relations.depth import depth_of_bodies
from hydrodae.support.arrays import Array, Complex

FORCE_ROW = "period, heading, mode, modulus, phase, real and imaginary part"
SUFFIXES = (".1", ".2", ".3", ".3fk", ".3sc", ".hst", ".pot", ".cfg", ".mmx", ".out", ".frc")


def wamit_stem(path: Path) -> Path | None:
    """Return the common part of the names of a run, `rm3` of `rm3.1`; None if it is none.

    Parameters
    ----------
    path : Path
        Any file of the run, or a folder that holds one run.
    """
    if path.is_dir():
        found = [p for p in sorted(path.iterdir()) if p.suffix == ".1"]
        if not found:
            found = [p for p in sorted(path.iterdir()) if is_listing(p)]
        return found[0].with_suffix("") if len(found) == 1 else None
    if path.suffix.lower() not in SUFFIXES:
        return None
    stem = path.with_suffix("")
    listing = beside(stem, ".out")
    if beside(stem, ".1") is not None or (listing is not None and is_listing(listing)):
        return stem
    return None


def read_wamit(path: Path, water: Water | None = None) -> SourceData:
    """Read one run of WAMIT.

    Parameters
    ----------
    path : Path
        Any file of the run (`rm3.1`), or its folder.
    water : Water, optional
        What no file says. The depth is asked for; density and gravity are assumed and reported.

    Returns
    -------
    SourceData
        The row at w = 0 is left out; the row at w = inf becomes `added_mass_inf`.

    Raises
    ------
    DatabaseError
        A file is missing or wrong; the message names file and line.
    """
    stem = wamit_stem(path)
    if stem is None:
        raise DatabaseError("no WAMIT output file .1 or .out beside it").about("missing", file=path)
    control = read_control(stem)
    findings: list[Finding] = []
    water = water or Water()
    if control.depth is None and water.depth is None and _holds_waves(stem):
        water = _of_told_depth(path, control, water, findings)
    rho, depth, gravity, length = settled(
        stem, control, water, findings, waves=lambda: _holds_waves(stem)
    )
    numeric, listed = beside(stem, ".1"), beside(stem, ".out")
    radiation = numeric or listed
    assert radiation is not None  # that is what makes a stem
    listing = None
    if numeric is None:
        listing = read_listing(radiation)
        rows, lines, option = listing.radiation, listing.radiation_lines, 1
        text = f"read from {radiation.name}, whose phases are whole degrees: there is no .1 file"
        findings.append(Finding("info", "excitation", text))
    else:
        rows, lines = tables.read_rows(radiation, 4, 5, "period, I, J, A [, B]")
        constants = (length, depth, gravity)
        option = first_column(stem, control, rows, constants, lambda: _waves(stem), findings)
    every = np.unique(rows[:, 1:3])
    modes, names, coordinates = _modes(radiation, rows, control, stem, findings)
    rows, lines = _of_modes(rows, lines, (1, 2), modes)
    omega_of = tables.to_omega(radiation, rows[:, 0], option, length, depth, gravity)
    rows[:, 0] = omega_of
    at = np.unique(omega_of)
    finite = np.isfinite(at) & (at > 0.0)
    usual = np.isfinite(omega_of) & (omega_of > 0.0)
    if np.isnan(rows[usual, 4]).any():
        line = lines[int(np.flatnonzero(usual & np.isnan(rows[:, 4]))[0])]
        raise DatabaseError("no damping: expected period, I, J, A, B").about(
            "shape", file=radiation, line=line
        )
    known = at[finite]
    scales = (length, depth, gravity)
    findings += asked_findings(control.asked, radiation, known, modes, names, scales, option)
    axes = (at, modes, modes)
    a = np.real(tables.scatter(radiation, rows, lines, (0, 1, 2), axes, rows[:, 3]))
    damping = np.nan_to_num(rows[:, 4])
    b = np.real(tables.scatter(radiation, rows, lines, (0, 1, 2), axes, damping))
    alone = tables.without_mate(rows[:, 1:3], modes)
    if alone.any():
        i, j = (modes[k] for k in np.argwhere(alone)[0])
        text = (
            f"{radiation.name} holds one half of A and B ({i:g} {j:g}, not {j:g} {i:g}): the other "
            f"is taken from it, by reciprocity"
        )
        findings.append(Finding("info", "assumption", text))
        for table in (a, b):
            table.transpose(0, 2, 1)[:, alone] = table[:, alone]
    omega = at[finite]
    rotation = np.array([label.is_rotation for label in read_labels(coordinates)])
    scale = rho * length ** (3.0 + rotation[:, None] + rotation)
    forces: dict[str, Complex | None] = {}
    heading = np.zeros(0)
    files = [radiation, *control.files]
    for key, suffixes in (
        ("excitation", (".3", ".2")),
        ("froude_krylov", (".3fk",)),
        ("diffraction", (".3sc",)),
    ):
        file = next((f for s in suffixes if (f := beside(stem, s)) is not None), None)
        forces[key] = None
        printed = listing is not None and key == "excitation" and len(listing.force) > 0
        if printed and listing is not None:
            found = (listing.force, listing.force_lines)
            file = radiation
        elif file is not None:
            found = tables.read_rows(file, 7, 7, FORCE_ROW)
            files.append(file)
        else:
            continue
        if file.suffix == ".2":
            text = f"taken from {file.name}, by Haskind's relation: there is no .3 file"
            findings.append(Finding("info", "excitation", text))
        tables.check_indices(file, *found, (2,), every)
        if not printed:
            tables.check_parts(file, *found, findings)
        read = _forces(file, found, modes, option, (length, depth, gravity), omega)
        forces[key] = rho * gravity * length ** (2.0 + rotation) * read[0]
        if heading.size and not np.array_equal(heading, read[1]):
            raise DatabaseError("headings differ from those of the other force files").about(
                "conflict", "headings", file=file
            )
        heading = read[1]
    if control.frequencies is not None and control.frequencies != at.size:
        text = f"{stem.name}.pot asks for {control.frequencies}, {radiation.name} holds {at.size}"
        findings.append(Finding("warning", "frequency grid", text))
    data = SourceData(
        coordinates=coordinates,
        omega=omega,
        added_mass=scale * a[finite],
        radiation_damping=scale * omega[:, None, None] * b[finite],
        heading=np.radians(heading),
        froude_krylov=forces["froude_krylov"],
        diffraction=forces["diffraction"],
        excitation=forces["excitation"],
        reference_points=dict.fromkeys(names),
        rho=rho,
        gravity=gravity,
        water_depth=depth,
        name=radiation.name,
        title=f"WAMIT {stem.name}",
        added_mass_inf=None,
        files=files,
        findings=findings,
        scales=Scales(six_of_each(names), length, option),
    )
    limit = at_infinity(at, a, b, findings)
    data.added_mass_inf = None if limit is None else scale * limit
    data.reference_points.update(zip(names, control.points, strict=False))
    _attach_hydrostatics(data, stem, control, names, length, every)
    if len(rigid(coordinates)) < len(coordinates):
        name, file = names[0], beside(stem, ".hst")
        stiffness = _stiffness(file, control, np.r_[1.0:7.0, modes[modes > 6.0]], every)
        turns = np.isin(np.arange(len(stiffness)), (3, 4, 5))
        units = length ** (2.0 + turns[:, None] + turns)
        data.mode_stiffness[name] = rho * gravity * units * stiffness
    return data


def _of_told_depth(path: Path, control: Control, water: Water, findings: list[Finding]) -> Water:
    """Enter the depth that damping and force of heave show, else what HydroDyn takes it for."""
    deep = read_wamit(path, replace(water, depth=np.inf))
    told = depth_of_bodies(
        deep.coordinates,
        deep.omega,
        deep.radiation_damping,
        deep.heading,
        deep.excitation,
        deep.rho,
        deep.gravity,
    )
    likely = control.likely_depth
    if likely is not None and (told is None or told.agrees(likely)):
        return replace(water, depth=likely)
    if told is None or not told.decided:
        return water
    said = "no file says the depth" if likely is None else f"HydroDyn takes {likely:g} m"
    best = f"{told.depth:.4g} m" if np.isfinite(told.depth) else f"infinite (over {told.low:.3g} m)"
    text = f"water depth {best}: with that damping and force of heave agree; {said} (--depth)"
    findings.append(Finding("warning", "assumption", text))
    return replace(water, depth=told.depth)


def _holds_waves(stem: Path) -> bool:
    """Return whether a run has forces of waves, in tables or in its listing alone."""
    tables_of = (".2", ".3", ".3fk", ".3sc")
    listed = beside(stem, ".1") is None
    return listed or any(beside(stem, suffix) is not None for suffix in tables_of)


def _waves(stem: Path) -> Array | None:
    """Lines (m, 7) of the exciting forces of a run, or None."""
    path = beside(stem, ".3") or beside(stem, ".2")
    return None if path is None else tables.read_rows(path, 7, 7, FORCE_ROW)[0]


def _modes(
    path: Path, rows: Array, control: Control, stem: Path, findings: list[Finding]
) -> tuple[Array, list[str], tuple[str, ...]]:
    """Modes that are kept (from 1), names of the bodies, and coordinates."""
    modes = np.unique(rows[:, 1:3])
    wrong = ~((modes >= 1) & (modes <= LARGEST_COUNT) & (modes == np.round(modes)))
    if wrong.any():
        raise DatabaseError(
            f"{modes[wrong][0]:g} is no mode: columns 2 and 3 must be modes 1, 2, ..."
        ).about("label", "modes", file=path)
    bodies = len(control.points) or int((modes.max() + 5) // 6)
    extra = modes[modes > 6 * bodies]
    flexible = bodies == 1 and beside(stem, ".hst") is not None
    if extra.size and flexible:
        text = f"modes {extra[0]:g} to {extra[-1]:g} are generalised: mode7 and so on"
        findings.append(Finding("info", "coordinates", text))
    elif extra.size:
        text = f"left out (not rigid): modes {', '.join(f'{m:g}' for m in extra)}"
        findings.append(Finding("warning", "coordinates", text))
    modes = modes if flexible else modes[modes <= 6 * bodies]
    raw = control.names or [stem.name if bodies == 1 else f"body{i + 1}" for i in range(bodies)]
    names = unique_names(raw)
    lost = [name for i, name in enumerate(names) if not np.any((modes - 1) // 6 == i)]
    if lost:
        text = f"{path.name} holds no modes of {', '.join(lost)}, which the control files name"
        findings.append(Finding("warning", "coordinates", text))
    numbers = modes.astype(int)
    labels = [f"{names[(m - 1) // 6]}.{DOFS[(m - 1) % 6]}" for m in numbers if m <= 6 * bodies]
    labels += [f"{names[0]}.mode{m}" for m in numbers if m > 6 * bodies]
    return modes, names, tuple(labels)


def _of_modes(
    rows: Array, lines: list[int], columns: tuple[int, ...], modes: Array
) -> tuple[Array, list[int]]:
    kept = np.all([np.isin(rows[:, c], modes) for c in columns], axis=0)
    return rows[kept].copy(), [n for n, k in zip(lines, kept, strict=True) if k]


def _forces(
    path: Path,
    found: tuple[Array, list[int]],
    modes: Array,
    option: int,
    constants: tuple[float, float, float],
    omega: Array,
) -> tuple[Complex, Array]:
    """Return dimensionless forces (nw, nh, n) and headings [deg] of rows and their lines."""
    rows, lines = _of_modes(*found, (2,), modes)
    length, depth, gravity = constants
    rows[:, 0] = tables.to_omega(path, rows[:, 0], option, length, depth, gravity)
    usual = np.isfinite(rows[:, 0]) & (rows[:, 0] > 0.0)
    rows, lines = rows[usual], [n for n, k in zip(lines, usual, strict=True) if k]
    grid, heading = np.unique(rows[:, 0]), np.unique(rows[:, 1])
    if grid.size != omega.size or not np.allclose(grid, omega, rtol=1e-5):
        raise DatabaseError(
            f"{grid.size} frequencies, not the {omega.size} of the .1 file: "
            f"files of different runs?"
        ).about("conflict", "frequencies", file=path)
    values = rows[:, 5] + 1j * rows[:, 6]
    axes = (grid, heading, modes)
    return np.asarray(tables.scatter(path, rows, lines, (0, 1, 2), axes, values)), heading


def _attach_hydrostatics(
    data: SourceData, stem: Path, control: Control, names: list[str], length: float, every: Array
) -> None:
    """Waterplane from `.hst`, whose K44 and K55 hold the weight too: - m g z_G in body axes."""
    path = beside(stem, ".hst")
    missing: list[str] = []
    if path is None and len(control.stiffness) != len(names):
        missing = names
    else:
        stiffness = _stiffness(path, control, np.arange(1.0, 6.0 * len(names) + 1.0), every)
        data.files += [] if path is None else [path]
        for i, name in enumerate(names):
            point = data.reference_points[name]
            statics = control.statics[i] if i < len(control.statics) else None
            if (
                point is None
                or statics is None
                or statics.volume is None
                or statics.center_of_buoyancy is None
                or statics.center_of_gravity is None
            ):
                missing.append(name)
                continue
            rotation = np.arange(6) >= 3
            block = stiffness[6 * i : 6 * i + 6, 6 * i : 6 * i + 6].copy()
            block *= length ** (2.0 + rotation[:, None] + rotation)
            mass = statics.volume if statics.mass_over_rho is None else statics.mass_over_rho
            block[[3, 4], [3, 4]] += mass * statics.center_of_gravity[2]
            center = point + statics.center_of_buoyancy
            rho_g = data.rho * data.gravity
            hydrostatics = Hydrostatics.from_stiffness(
                rho_g * block, point, statics.volume, center, data.rho, data.gravity
            )
            data.hydrostatics[name] = (hydrostatics, point)
    rows = np.arange(1.0, 6.0 * len(names) + 1.0)
    table = None if path is None else _stiffness(path, control, rows, every)
    for i, name in enumerate(names):
        if name not in missing or name not in bodies_of(data.coordinates):
            continue
        text = f"{name}: no complete .hst and .mmx files"
        mesh = mesh_of(stem, name, len(names) == 1)
        if mesh is None:
            data.findings.append(without_hydrostatics(text, [name]))
            continue
        area = None if table is None else float(table[6 * i + 2, 6 * i + 2]) * length**2
        shift = data.reference_points[name] if mesh[1] else None
        statics_of_file(data, name, mesh[0], text, shift=shift, area=area or None)


def _stiffness(path: Path | None, control: Control, modes: Array, every: Array) -> Array:
    """C/(rho g) of some modes, (n, n): from `.hst`, else the blocks of `.out`."""
    if path is None:
        result = np.zeros((modes.size, modes.size))
        for i, block in enumerate(control.stiffness):
            result[6 * i : 6 * i + 6, 6 * i : 6 * i + 6] = block
        return result
    rows, lines = tables.read_rows(path, 3, 3, "I, J, C(I,J)")
    known = np.union1d(modes, every)
    used = _of_modes(rows, lines, (0, 1), modes)
    if len(used[0]) < modes.size**2:  # a garbled index leaves a gap; whole tables may hold more
        tables.check_indices(path, rows, lines, (0, 1), known)
    rows, lines = used
    flat = np.column_stack([np.zeros(len(rows)), rows])
    axes = (np.zeros(1), modes, modes)
    table = tables.scatter(path, flat, lines, (0, 1, 2), axes, rows[:, 2])
    return np.asarray(np.real(table)[0])


FORMAT = Format(
    ".1 or .out of WAMIT", lambda path: path if wamit_stem(path) else None, read_wamit, True
)
