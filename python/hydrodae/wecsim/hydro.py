"""The hydrodynamic database of an import: where it is, and what the case needs of it."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.checks.band import felt_band
from hydrodae.hdb.checks.irregular import suspect_rows
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.preparation.fitting import fit, kernel
from hydrodae.hdb.preparation.importing import import_database
from hydrodae.hdb.readers.reading import body_names
from hydrodae.wecsim.drift import with_drift
from hydrodae.wecsim.m_file import calls
from hydrodae.wecsim.objects import InputFile

#: A file below this size is no database; repositories keep a pointer of Git LFS in its place.
SMALLEST = 1000
#: Functions of BEMIO, of which the second argument is a file or folder of results.
_READERS = ("readWAMIT", "readNEMOH", "readCAPYTAINE", "readAQWA", "readHAMS")
_RAW = ("*.out", "*.nc", "Nemoh.cal", "*/Nemoh.cal", "*.AH1", "*.h5")


def find_source(stated: str, read: InputFile) -> Path:
    """The database that an input file names, or the results that it was made from.

    These are the results that `bemio.m` beside it reads, of several those with the name of the
    database, because BEMIO names its file so; without `bemio.m` those with this name, or the only
    ones.

    Raises
    ------
    CaseError
        Neither is there, or it is open which results they are.
    """
    path = read.path.parent / stated.replace("\\", "/")
    if _is_there(path):
        return path
    missing = "is a pointer of Git LFS" if path.is_file() else "is not there"
    folder = path.parent
    if not folder.is_dir():  # a folder of another machine
        folder = read.path.parent / "hydroData"
        if _is_there(folder / path.name):
            read.remarks.assumed(stated, f"{missing}; read {folder.name}/{path.name}")
            return folder / path.name
    named = _named_by_bemio(folder)
    results = named or [p for glob in _RAW for p in sorted(folder.glob(glob)) if p != path]
    found = [p for p in results if _is_there(p)]
    same = [p for p in found if _stem(p) == path.stem.lower()]
    chosen = same or (found if len(results) == 1 else [])
    if len(chosen) == 1:
        by = "as bemio.m does" if named else "beside it"
        text = f"{missing}; read {os.path.relpath(chosen[0], folder)} {by}"
        read.remarks.assumed(stated, text)
        return chosen[0]
    names = ", ".join(os.path.relpath(p, folder) for p in results)
    told = f"; {'bemio.m reads' if named else 'beside it'} {names}" if names else ""
    if found:
        raise CaseError(
            f"{path}: {missing}{told}; write in the input file which it was made from, as in "
            f"bodyClass('{os.path.relpath(found[0], read.path.parent)}')"
        )
    raise CaseError(
        f"{path}: {missing}{f'{told}, which cannot be used either' if names else ''}; run bemio.m "
        "of WEC-Sim, fetch the file by Git LFS, or put the results of the boundary-element code "
        "there"
    )


def _is_there(path: Path) -> bool:
    return path.is_dir() or (path.is_file() and path.stat().st_size > SMALLEST)


def _stem(path: Path) -> str:
    """Name that BEMIO gives its file: of the results, or of their folder."""
    named = path.resolve().parent if path.name == "Nemoh.cal" else path.resolve()
    return (named.name if named.is_dir() else named.stem).lower()


def _named_by_bemio(folder: Path) -> list[Path]:
    """Results that `bemio.m` of a folder reads, in its order."""
    script = folder / "bemio.m"
    if not script.is_file():
        return []
    texts = [call[1] for call in calls(script, _READERS) if call[1:] and isinstance(call[1], str)]
    return list(dict.fromkeys(folder / text.replace("\\", "/") for text in texts))


def in_water(database: HydroDatabase, rho: float, gravity: float) -> HydroDatabase:
    """Scale a database to another density and gravity, as WEC-Sim does.

    A, B ~ rho; F, stiffness and loads of second order ~ rho g. Kernel and fits are left out.

    Parameters
    ----------
    database : HydroDatabase
    rho, gravity : float
        [kg/m3], [m/s2].
    """
    mass = rho / database.rho
    force = mass * gravity / database.gravity
    stiffness = {
        name: body
        if body.mode_stiffness is None
        else replace(body, mode_stiffness=force * body.mode_stiffness)
        for name, body in database.bodies.items()
    }
    return replace(
        database,
        added_mass=mass * database.added_mass,
        radiation_damping=mass * database.radiation_damping,
        added_mass_inf=mass * database.added_mass_inf,
        added_mass_inf_std=mass * database.added_mass_inf_std,
        froude_krylov=force * database.froude_krylov,
        diffraction=force * database.diffraction,
        bodies=stiffness,
        second_order={
            kind: replace(table, values=force * table.values)
            for kind, table in database.second_order.items()
        },
        rho=rho,
        gravity=gravity,
        kernel=None,
        memory={},
    )


def read_database(
    source: Path, names: Mapping[int, str], rho: float, gravity: float, file: InputFile
) -> HydroDatabase:
    """Read a source, with the names of the case for its bodies, in the water of the input file.

    Parameters
    ----------
    names : mapping from int
        Names by the number of the body, which is its place in the source.
    rho, gravity : float
        [kg/m3], [m/s2].
    """
    old = body_names(source)
    renaming: dict[str, str] = {}
    for number, name in names.items():
        if number > len(old) and not (len(names) == len(old) == 1):
            raise CaseError(
                f"{source}: {len(old)} bodies ({', '.join(old)}), but body({number}) is from it"
            )
        renaming[old[number - 1 if number <= len(old) else 0]] = name
    for name in old:
        if name not in renaming:
            renaming[name] = f"unused_{name}"
    database, report = import_database(source, names=renaming)
    if any(label.is_mode for label in database.labels) and suspect_rows(database).any():
        highest = felt_band(database)[1]
        database, report = import_database(source, names=renaming, cut=highest)
        file.remarks.assumed(
            source.name,
            f"frequencies above {highest:.3g} rad/s left out: the device does not feel them, and "
            "tables with modes of water break causality there (sloshing, irregular frequencies)",
        )
    for finding in report.left([]):
        file.remarks.assumed(
            source.name, f"check {finding.name}: {finding.message}; taken as it is"
        )
    for what, there, here in (
        ("rho", database.rho, rho),
        ("gravity", database.gravity, gravity),
    ):
        if there != here:
            text = f"simu.{what} = {here:g}, to which its {there:g} is scaled, as in WEC-Sim"
            file.remarks.assumed(source.name, text)
    return in_water(with_drift(database, source, renaming, file), rho, gravity)


def with_radiation(
    database: HydroDatabase, moving: Sequence[str], wanted: str, file: InputFile
) -> tuple[HydroDatabase, str]:
    """Prepare the radiation memory; returns the database and the kind of radiation it serves."""
    if wanted != "exponential" or not moving:
        return database, wanted
    inputs = ",".join(moving)
    band = felt_band(database)
    try:
        return fit(database, inputs, name="moving", band=band), "exponential"
    except DatabaseError as error:
        refused = str(error)
    try:
        made = kernel(database, inputs, band=band), "convolution"
    except DatabaseError as error:
        second = str(error)
    else:
        file.remarks.assumed(
            "radiation", f"by convolution, since no fit was good enough: {refused}"
        )
        return made
    file.remarks.assumed(
        "radiation",
        "a fit that misses its target was taken, since the tables allow neither a good fit "
        f"({refused}) nor a convolution ({second}); see hydrodae hdb doctor",
    )
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        taken = fit(database, inputs, name="moving", band=band, accept=("target", "passive"))
    for warning in told:
        file.remarks.assumed("radiation", str(warning.message))
    return taken, "exponential"
