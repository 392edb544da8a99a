"""Output of WAMIT: the numeric files `.1`, `.3` (or `.2`), `.3fk`, `.3sc`, `.hst` of one run.

WAMIT's phasors are e^{+iwt} with the phase zero at the origin of the world, as here. Tables are
dimensionless: A/(rho L^k), B/(rho w L^k), F/(rho g L^m), C/(rho g L^j).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import unique_names
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import DOFS, bodies_of, read_labels, six_of_each
from hydrodae.hdb.readers.formats import Format
from hydrodae.hdb.readers.mesh_beside import statics_of_file
from hydrodae.hdb.readers.rows import (
    COLUMNS,
    Rows,
    check_modes,
    check_parts,
    read_rows,
    tabulate,
    to_omega,
    unit,
)
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.source import SourceData, Water, without_hydrostatics
from hydrodae.hdb.readers.text import LARGEST_COUNT, beside, lines_beside
from hydrodae.hdb.readers.wamit_control import BESIDE, Control, Statics, mesh_of, read_control
from hydrodae.hdb.readers.wamit_guesses import (
    asked_findings,
    first_column,
    settled,
    told_depth,
)
from hydrodae.hdb.readers.wamit_listing import is_listing, read_listing
from hydrodae.support.arrays import Array, Complex

SUFFIXES = (".1", ".2", ".3", ".3fk", ".3sc", ".hst", ".pot", ".cfg", ".mmx", ".out", ".frc")
#: Files of each force, the better one first.
FORCES = {"excitation": (".3", ".2"), "froude_krylov": (".3fk",), "diffraction": (".3sc",)}
TABLES = (".1", ".3", ".2", ".3fk", ".3sc", ".hst")


@dataclass(frozen=True)
class Run:
    """Files of one run as they stand there.

    Attributes
    ----------
    stem : Path
        Their common name.
    control : Control
        What the files beside the tables say.
    radiation : Rows
        Of `.1`, or of the listing.
    forces : dict of Rows
        Those of `FORCES` that are there.
    stiffness : Rows or None
        Of `.hst`.
    listed : bool
        Whether A, B and the excitation are from the listing.
    """

    stem: Path
    control: Control
    radiation: Rows
    forces: dict[str, Rows]
    stiffness: Rows | None
    listed: bool

    @property
    def files(self) -> list[Path]:
        """Those that were read; the listing once."""
        of_forces = [f.path for f in self.forces.values() if f.path != self.radiation.path]
        return [self.radiation.path, *self.control.files, *of_forces]


@dataclass(frozen=True)
class Motions:
    """Modes of a run, from 1: `every` one of the tables, and those `kept`; bodies, coordinates.

    `starts` are the modes before those of each body, and of all (bodies + 1,).
    """

    every: Array
    kept: Array
    starts: Array
    names: list[str]
    coordinates: tuple[str, ...]


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
    stem, water = wamit_stem(path), water or Water()
    if stem is None:
        raise DatabaseError("no WAMIT output file .1 or .out beside it").about("missing", file=path)
    run = _read_run(stem)
    findings: list[Finding] = []
    if run.control.depth is None and water.depth is None and (run.forces or run.listed):
        deep, _ = _tables(run, replace(water, depth=np.inf), [])
        water = replace(water, depth=told_depth(deep, run.control, findings))
    data, motions = _tables(run, water, findings)
    _attach_hydrostatics(data, run, motions)
    return data


def _read_run(stem: Path) -> Run:
    """Read all files of a run, each once."""
    texts = lines_beside(stem, (*BESIDE, *TABLES))
    control = read_control(stem, texts)
    files = {key: next((s for s in wanted if s in texts), "") for key, wanted in FORCES.items()}
    force = None
    if listed := ".1" not in texts:
        radiation, force = read_listing(*texts[".out"])  # one of both makes a stem
    else:
        path, lines = texts[".1"]
        radiation = read_rows(path, COLUMNS[".1"], lines)
    forces = {} if force is None else {"excitation": force}
    for key, suffix in files.items():
        if suffix and key not in forces:
            path, lines = texts[suffix]
            forces[key] = read_rows(path, COLUMNS[suffix], lines)
    hst = texts.get(".hst")
    stiffness = None if hst is None else read_rows(hst[0], COLUMNS[".hst"], hst[1])
    return Run(stem, control, radiation, forces, stiffness, listed)


def _tables(run: Run, water: Water, findings: list[Finding]) -> tuple[SourceData, Motions]:
    """Coefficients in SI units of what the files of a run hold, without hydrostatics."""
    control, name = run.control, run.radiation.path.name
    setting = settled(
        run.stem, control, water, findings, waves=bool(run.forces or run.listed)
    )  # fmt: skip
    option = control.first_column
    if run.listed:
        option = 1
        text = f"read from {name}, whose phases are whole degrees: there is no .1 file"
        findings.append(Finding("info", "excitation", text))
    elif option is None:
        force = run.forces.get("excitation")
        option = first_column(run.stem.name, run.radiation, force, setting, findings)
    setting = replace(setting, first_column=option)
    motions = _motions(run, findings)
    at, a, b = _radiation(run, motions, setting, findings)
    usual = np.isfinite(at) & (at > 0.0)
    omega, heading = at[usual], np.zeros(0)
    turns = np.array([float(label.is_rotation) for label in read_labels(motions.coordinates)])
    forces: dict[str, Complex] = {}
    for key, rows in run.forces.items():
        check_modes(rows, motions.every)
        known = heading
        values, heading = _forces(rows, motions, setting, omega, findings)
        forces[key] = unit(rows.columns, setting, turns) * values
        if known.size and not np.array_equal(known, heading):
            raise DatabaseError("headings differ from those of the other force files").about(
                "conflict", "headings", file=rows.path
            )
    if control.frequencies is not None and control.frequencies != at.size:
        text = f"{run.stem.name}.pot asks for {control.frequencies}, {name} holds {at.size}"
        findings.append(Finding("warning", "frequency grid", text))
    scale = unit(run.radiation.columns, setting, turns[:, None] + turns)
    limits = {w: scale * a[at == w][0] for w in (0.0, np.inf) if w in at}
    names = motions.names
    data = SourceData(
        coordinates=motions.coordinates,
        omega=omega,
        added_mass=scale * a[usual],
        radiation_damping=scale * omega[:, None, None] * b[usual],
        heading=np.radians(heading),
        reference_points=dict.fromkeys(names) | dict(zip(names, control.points, strict=False)),
        rho=setting.rho,
        gravity=setting.gravity,
        water_depth=setting.depth,
        name=name,
        title=f"WAMIT {run.stem.name}",
        added_mass_inf=limits.get(np.inf),
        added_mass_zero=limits.get(0.0),
        files=run.files,
        findings=findings,
        setting=replace(setting, labels=six_of_each(names)),
        froude_krylov=forces.get("froude_krylov"),
        diffraction=forces.get("diffraction"),
        excitation=forces.get("excitation"),
    )
    return data, motions


def _motions(run: Run, findings: list[Finding]) -> Motions:
    """Sort out the modes of A and B: which belong to which body, which are left out."""
    path, control = run.radiation.path, run.control
    every = np.unique(run.radiation.modes)
    wrong = ~((every >= 1) & (every <= LARGEST_COUNT) & (every == np.round(every)))
    if wrong.any():
        raise DatabaseError(
            f"{every[wrong][0]:g} is no mode: columns 2 and 3 must be modes 1, 2, ..."
        ).about("label", "modes", file=path)
    bodies = len(control.points) or int((every.max() + 5) // 6)
    starts = control.starts(bodies, int(every.max()))
    inside = every[every <= starts[-1]]
    body = np.searchsorted(starts, inside - 1.0, side="right") - 1
    place = (inside - starts[body]).astype(int)
    kept = np.ones(inside.size, dtype=bool) if run.stiffness is not None else place <= 6
    if np.any(place[kept] > 6):
        text = (
            f"modes {_listed(inside[place > 6])} are generalised: mode7 and so on of their bodies"
        )
        findings.append(Finding("info", "coordinates", text))
    lost_modes = np.setdiff1d(every, inside[kept])
    if lost_modes.size:
        text = f"left out (not rigid): modes {_listed(lost_modes)}"
        findings.append(Finding("warning", "coordinates", text))
    modes, body, place = inside[kept], body[kept], place[kept]
    stem = run.stem.name
    raw = control.names or [stem if bodies == 1 else f"body{i + 1}" for i in range(bodies)]
    names = unique_names(raw)
    lost = [name for i, name in enumerate(names) if i not in body]
    if lost:
        text = f"{path.name} holds no modes of {', '.join(lost)}, which the control files name"
        findings.append(Finding("warning", "coordinates", text))
    words = [DOFS[m - 1] if m <= 6 else f"mode{m}" for m in place]
    labels = [f"{names[i]}.{word}" for i, word in zip(body, words, strict=True)]
    return Motions(every, modes, starts, names, tuple(labels))


def _listed(modes: Array) -> str:
    return ", ".join(f"{m:g}" for m in modes)


def _radiation(
    run: Run, motions: Motions, setting: Setting, findings: list[Finding]
) -> tuple[Array, Array, Array]:
    """Frequencies, 0 and inf among them, and dimensionless A, B (nw, n, n) of the modes kept."""
    modes, rows = motions.kept, run.radiation.of_modes(motions.kept)
    omega = to_omega(rows.waves[:, 0], setting)
    added, damping = rows.values.T
    at, usual = np.unique(omega), np.isfinite(omega) & (omega > 0.0)
    lacking = np.flatnonzero(usual & np.isnan(damping))
    if lacking.size:
        raise DatabaseError("no damping: expected period, I, J, A, B").about(
            "shape", file=rows.path, line=int(rows.lines[lacking[0]])
        )
    known = at[np.isfinite(at) & (at > 0.0)]
    asked, names, starts = run.control.asked, motions.names, motions.starts
    findings += asked_findings(asked, rows, known, modes, names, setting, starts)
    keys, axes = (omega, *rows.modes.T), (at, modes, modes)
    a = np.real(tabulate(rows, keys, axes, added))
    b = np.real(tabulate(rows, keys, axes, np.nan_to_num(damping)))
    there = np.zeros((modes.size, modes.size), dtype=bool)
    there[np.searchsorted(modes, keys[1]), np.searchsorted(modes, keys[2])] = True
    alone = there & ~there.T
    if alone.any():
        i, j = (modes[k] for k in np.argwhere(alone)[0])
        text = (
            f"{rows.path.name} holds one half of A and B ({i:g} {j:g}, not {j:g} {i:g}): the other "
            f"is taken from it, by reciprocity"
        )
        findings.append(Finding("info", "assumption", text))
        for table in (a, b):
            table.transpose(0, 2, 1)[:, alone] = table[:, alone]
    return at, a, b


def _forces(
    rows: Rows, motions: Motions, setting: Setting, omega: Array, findings: list[Finding]
) -> tuple[Complex, Array]:
    """Return dimensionless forces (nw, nh, n) and headings [deg] of the modes kept."""
    if rows.path.suffix == ".2":
        text = f"taken from {rows.path.name}, by Haskind's relation: there is no .3 file"
        findings.append(Finding("info", "excitation", text))
    if rows.path.suffix.lower() != ".out":
        check_parts(rows, findings)
    rows = rows.of_modes(motions.kept)
    at = to_omega(rows.waves[:, 0], setting)
    usual = np.isfinite(at) & (at > 0.0)
    rows, at = rows.where(usual), at[usual]
    grid, heading = np.unique(at), np.unique(rows.headings)
    if grid.size != omega.size or not np.allclose(grid, omega, rtol=1e-5):
        raise DatabaseError(
            f"{grid.size} frequencies, not the {omega.size} of the .1 file: "
            f"files of different runs?"
        ).about("conflict", "frequencies", file=rows.path)
    keys = (at, rows.headings[:, 0], rows.modes[:, 0])
    return np.asarray(tabulate(rows, keys, (grid, heading, motions.kept), rows.loads)), heading


def _attach_hydrostatics(data: SourceData, run: Run, motions: Motions) -> None:
    """Waterplane from `.hst` or the listing, or from meshes; stiffness of generalised modes."""
    control, names, rows = run.control, motions.names, run.stiffness
    length = data.setting.length
    table: Array | None = None
    if rows is not None:
        data.files.append(rows.path)
        firsts = motions.starts[:-1]
        rigid_modes = np.concatenate([first + np.arange(1.0, 7.0) for first in firsts])
        table = _stiffness(rows, rigid_modes, motions.every)
        others = {*rows.modes.ravel()} - {*rigid_modes} - {*motions.every}
        if more := sorted(others):
            text = f"{rows.path.name}: left out, modes {_listed(np.array(more))}"
            text += ", which the run does not have"
            data.findings.append(Finding("info", "hydrostatics", text))
    for i, name in enumerate(names):
        statics = control.statics[i] if i < len(control.statics) else Statics()
        own = slice(6 * i, 6 * i + 6)
        block = None if table is None else table[own, own]
        if block is None and len(control.stiffness) == len(names):
            block = control.stiffness[i]
        if _attach_waterplane(data, name, statics, block) or name not in bodies_of(
            data.coordinates
        ):
            continue
        text = f"{name}: no complete .hst and .mmx files"
        mesh = mesh_of(run.stem, name, len(names) == 1)
        if mesh is None:
            data.findings.append(without_hydrostatics(text, [name]))
            continue
        area = None if table is None else float(table[6 * i + 2, 6 * i + 2]) * length**2
        shift = data.reference_points[name] if mesh[1] else None
        statics_of_file(data, name, mesh[0], text, shift=shift, area=area or None)
    for i, name in enumerate(names):
        first, last = motions.starts[i : i + 2]
        mine = motions.kept[(motions.kept > first + 6) & (motions.kept <= last)]
        if rows is None or not mine.size:
            continue
        modes = np.r_[first + np.arange(1.0, 7.0), mine]
        turns = np.isin(np.arange(modes.size), (3, 4, 5))
        scale = data.rho * data.gravity * (length ** (2.0 + turns[:, None] + turns))
        data.mode_stiffness[name] = scale * _stiffness(rows, modes, motions.every)


def _attach_waterplane(data: SourceData, name: str, statics: Statics, block: Array | None) -> bool:
    """Add the waterplane of C/(rho g) (6, 6), if all that it needs is there.

    K44 and K55 hold the weight too: - m g z_G in body axes.
    """
    point, volume = data.reference_points[name], statics.volume
    buoyancy, gravity = statics.center_of_buoyancy, statics.center_of_gravity
    if block is None or point is None or volume is None or buoyancy is None or gravity is None:
        return False
    turns = np.arange(6) >= 3
    block = block * data.setting.length ** (2.0 + turns[:, None] + turns)
    mass = volume if statics.mass_over_rho is None else statics.mass_over_rho
    block[[3, 4], [3, 4]] += mass * gravity[2]
    data.add_statics(name, data.rho * data.gravity * block, point, volume, point + buoyancy)
    return True


def _stiffness(rows: Rows, modes: Array, every: Array) -> Array:
    """C/(rho g) of some modes, (n, n), from `.hst`."""
    used = rows.of_modes(modes)
    if used.lines.size < modes.size**2:  # a garbled index leaves a gap; tables may hold more modes
        check_modes(rows, np.union1d(modes, every))
    keys, axes = (np.zeros(used.lines.size), *used.modes.T), (np.zeros(1), modes, modes)
    return np.asarray(np.real(tabulate(used, keys, axes, used.values[:, 0]))[0])


FORMAT = Format(
    ".1 or .out of WAMIT", lambda path: path if wamit_stem(path) else None, read_wamit, True
)
