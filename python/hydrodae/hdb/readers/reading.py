"""Read any source as it is, and refuse what no run can have written."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import bodies_of
from hydrodae.hdb.readers.bemio import read_bemio
from hydrodae.hdb.readers.capytaine import read_capytaine
from hydrodae.hdb.readers.finishing import finish
from hydrodae.hdb.readers.formats import formats
from hydrodae.hdb.readers.headings import FORCES, settle_headings
from hydrodae.hdb.readers.kinds import others, resolve
from hydrodae.hdb.readers.reference import settle_points
from hydrodae.hdb.readers.second_order import attach
from hydrodae.hdb.readers.source import LARGEST, SourceData, Water
from hydrodae.hdb.readers.time_sense import correct_time_sense

#: Depths beyond [m] stand for infinitely deep water.
DEEPEST = 12e3


def read_source(
    source: str | Path,
    *,
    rho: float | None = None,
    depth: float | None = None,
    gravity: float | None = None,
    time_convention: str | None = None,
    motions: Mapping[str, str] | None = None,
) -> SourceData:
    """Read files of Nemoh, Capytaine, BEMIO, WAMIT, HAMS, AQWA or OrcaWave, as they are.

    Parameters
    ----------
    source : path
        File or folder.
    rho, depth, gravity : float, optional
        Of the water [kg/m3, m, m/s2], where the source does not say (WAMIT's tables).
    time_convention : str, optional
        "format", the convention that is the format's own, or "other", of all forces or of each, as
        in "froude-krylov=other,diffraction=other"; default: what the long waves say.
    motions : dict of str, optional
        Own degrees of freedom of Capytaine that are rigid motions, as in {"Hinge": "pitch"}.

    Raises
    ------
    DatabaseError
        Missing or wrong files, or an argument contradicts the source; the message names file and
        line.
    """
    path, what = resolve(source)
    water = Water(rho, depth, gravity)
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # rows that hold inf are reported below
            data = _read(path, what, water, motions or {})
        _check_tables(path, data)
        settle_points(data)
        correct_time_sense(data, time_convention)
        attach(path, what, data)
    except DatabaseError as error:
        raise _naming(path, error) from None
    if what not in formats() or not formats()[what].takes_water:
        _check_water(path, data, water)
    left = others(Path(source), what)
    if left:
        text = f"{path.name} is read, not what is beside it: {', '.join(left)}; name the file"
        data.findings.append(Finding("warning", "source", text))
    return data


def _naming(path: Path, error: DatabaseError) -> DatabaseError:
    """Return the error with the file in front, where it names none."""
    text = str(error)
    named = path.name in text or str(path.parent) in text
    return error if named else error.in_file(path)


def _read(path: Path, what: str, water: Water, motions: Mapping[str, str]) -> SourceData:
    """Read a kind of source."""
    if motions and what != "capytaine":
        raise DatabaseError(
            "--motion names own degrees of freedom of Capytaine's .nc; the motions of other "
            "formats are surge to yaw already"
        ).about("option", "motion", file=path)
    if what in formats():
        format = formats()[what]
        return format.read(path, water) if format.takes_water else format.read(path)
    if what == "nemoh":
        from hydrodae.hdb.readers.nemoh import read_nemoh as reader
    elif what == "bemio":
        return read_bemio(path)
    elif what == "capytaine":
        return read_capytaine(path, motions)
    else:
        raise DatabaseError("a finished hydro.h5, not a source").about("unsupported", file=path)
    return reader(path)


def _check_tables(path: Path, data: SourceData) -> None:
    """Refuse what no run can have written: frequencies out of order, water without weight."""
    w = data.omega
    wrong = np.flatnonzero(~(np.diff(w, prepend=0.0) > 0.0) | ~np.isfinite(w))
    if wrong.size or not w.size:
        where = f", {w[wrong[0]]:g} rad/s at place {wrong[0] + 1}" if wrong.size else ""
        raise DatabaseError(
            f"{w.size} frequencies{where}; expected some > 0, each above the one before: "
            f"is the column of frequencies another, or the file cut short?"
        ).about("frequencies", file=path)
    for name in ("added_mass", "radiation_damping", *FORCES):
        table = getattr(data, name)
        if table is not None:
            table[~(np.abs(table) < LARGEST)] = np.nan  # such rows are dropped, and reported
    settle_headings(data)
    if DEEPEST < data.water_depth < np.inf:
        text = f"no sea is {data.water_depth:g} m deep: taken as infinitely deep water"
        data.findings.append(Finding("info", "assumption", text))
        data.water_depth = np.inf
    limit = data.added_mass_inf
    if limit is not None and not np.all(np.abs(limit) < LARGEST):
        data.added_mass_inf = None
        text = "it holds values that are not finite: estimated instead"
        data.findings.append(Finding("warning", "added_mass_inf of the source", text))
    for what, value, low, high, unit in (
        ("density", data.rho, 500.0, 2000.0, "kg/m3"),
        ("gravity", data.gravity, 9.7, 9.9, "m/s2"),
        ("water depth", data.water_depth, 0.0, np.inf, "m"),
    ):
        if not value > 0.0 or (what != "water depth" and not np.isfinite(value)):
            raise DatabaseError(f"{what} {value:g} {unit}: expected a number > 0").about(
                "value", what, file=path
            )
        if not low <= value <= high:
            text = f"{what} {value:g} {unit}: not of water on earth ({low:g} to {high:g})"
            data.findings.append(Finding("warning", "water", text, value=float(value)))


def _check_water(path: Path, stated: SourceData | HydroDatabase, given: Water) -> None:
    """Refuse a statement about the water that contradicts the source."""
    for what, known, value, unit in (
        ("density", stated.rho, given.density, "kg/m3"),
        ("depth", stated.water_depth, given.depth, "m"),
        ("gravity", stated.gravity, given.gravity, "m/s2"),
    ):
        if value is not None and value != known and not np.isclose(value, known, rtol=1e-3):
            raise DatabaseError(f"the {what} there is {known:g} {unit}, not {value:g}").about(
                "conflict", what, file=path
            )


def read(
    source: str | Path,
    *,
    rho: float | None = None,
    depth: float | None = None,
    gravity: float | None = None,
    time_convention: str | None = None,
) -> HydroDatabase:
    """Read any supported source: `hydro.h5`, or what `read_source` reads, with its arguments.

    Returns
    -------
    HydroDatabase
        In the project convention, A and B symmetrised. Use `import_database` to see the checks.

    Raises
    ------
    DatabaseError
        Missing or wrong files.
    """
    path, what = resolve(source)
    if what == "hydro":
        database = HydroDatabase.read(path)
        _check_water(path, database, Water(rho, depth, gravity))
        return database
    return finish(
        read_source(path, rho=rho, depth=depth, gravity=gravity, time_convention=time_convention)
    )


def body_names(source: str | Path) -> list[str]:
    """Return the names of the bodies of a source, in its order, without what `read` estimates."""
    path, what = resolve(source)
    if what == "hydro":
        return list(HydroDatabase.read(path).bodies)
    return list(bodies_of(read_source(path).coordinates))
