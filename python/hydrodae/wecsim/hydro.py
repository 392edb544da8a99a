"""The hydrodynamic database of an import: where it is, and what the case needs of it."""

from __future__ import annotations

import os
import re
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.checks.band import felt_band
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.preparation.fitting import fit, kernel
from hydrodae.hdb.preparation.importing import import_database
from hydrodae.hdb.readers.reading import read
from hydrodae.wecsim.objects import InputFile

#: A file below this size is no database; repositories keep a pointer of Git LFS in its place.
SMALLEST = 1000
_CALL = re.compile(
    r"^\s*(?:\w+\s*=\s*)?read(WAMIT|NEMOH|CAPYTAINE|AQWA|HAMS)\s*\((.*)\)", re.IGNORECASE | re.M
)
_RAW = ("*.out", "*.nc", "Nemoh.cal", "*/Nemoh.cal", "*.AH1", "*.h5")


def find_source(stated: str, read: InputFile) -> Path:
    """The database that an input file names, or the results that it was made from.

    Raises
    ------
    CaseError
        Neither is there.
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
    tried: list[str] = []
    for candidate in _candidates(folder):
        tried.append(candidate.name)
        if _is_there(candidate):
            read.remarks.assumed(
                stated, f"{missing}; read {os.path.relpath(candidate, folder)} beside it"
            )
            return candidate
    found = f"; beside it {', '.join(tried)} cannot be used either" if tried else ""
    raise CaseError(
        f"{path}: {missing}{found}; run bemio.m of WEC-Sim, fetch the file by Git LFS, or put the "
        "results of the boundary-element code there"
    )


def _is_there(path: Path) -> bool:
    return path.is_dir() or (path.is_file() and path.stat().st_size > SMALLEST)


def _candidates(folder: Path) -> list[Path]:
    found: list[Path] = []
    script = folder / "bemio.m"
    if script.is_file():
        for call in _CALL.finditer(script.read_text(encoding="utf-8", errors="replace")):
            if call.group(0).lstrip().startswith("%"):
                continue
            for name in re.findall(r"'([^']+)'", call.group(2)):
                found.append(folder / name.replace("\\", "/"))
    if folder.is_dir():
        for pattern in _RAW:
            found += sorted(folder.glob(pattern))
    return list(dict.fromkeys(found))


def read_database(
    source: Path, names: Mapping[int, str], rho: float, gravity: float, file: InputFile
) -> HydroDatabase:
    """Read a source, with the names of the case for its bodies.

    Parameters
    ----------
    names : mapping from int
        Names by the number of the body, which is its place in the source.
    """
    try:
        old = list(read(source, rho=rho, gravity=gravity).bodies)
    except DatabaseError as error:
        if error.subject not in ("rho", "density"):
            raise
        old = list(read(source).bodies)
        file.remarks.assumed(source.name, f"density and gravity of the source, since {error}")
        rho = gravity = 0.0
    renaming = {}
    for number, name in names.items():
        if number > len(old) and not (len(names) == len(old) == 1):
            raise CaseError(
                f"{source}: {len(old)} bodies ({', '.join(old)}), but body({number}) is from it"
            )
        renaming[old[number - 1 if number <= len(old) else 0]] = name
    for name in old:
        if name not in renaming:
            renaming[name] = f"unused_{name}"
    database, report = import_database(
        source, names=renaming, rho=rho or None, gravity=gravity or None
    )
    for finding in report.left([]):
        file.remarks.assumed(
            source.name, f"check {finding.name}: {finding.message}; taken as it is"
        )
    return database


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
