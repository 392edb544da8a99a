"""Tell what a source is by its content, read it and check it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import ArrayLike

from hydrodae.damaged import opened
from hydrodae.errors import DatabaseError
from hydrodae.hdb import files
from hydrodae.hdb.checks.check import check
from hydrodae.hdb.coordinates import bodies_of, check_body, nearest
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.findings import CheckReport, Finding
from hydrodae.hdb.hydrostatics import Hydrostatics
from hydrodae.hdb.readers.bemio import is_bemio_file, read_bemio
from hydrodae.hdb.readers.nemoh_hydrostatics import find
from hydrodae.hdb.readers.source import SourceData, finish
from hydrodae.hdb.readers.wamit import read_wamit, wamit_stem


def kind(source: str | Path) -> str:
    """Return "hydro", "nemoh", "capytaine", "bemio" or "wamit" for a source, by its content.

    Raises
    ------
    DatabaseError
        No such file, or nothing that can be read.
    """
    path = Path(source)
    if path.is_dir():
        if find(path, "Nemoh.cal") is not None:
            return "nemoh"
        if wamit_stem(path) is not None:
            return "wamit"
        inside = sorted(p.name for e in ("*.nc", "*.h5", "*.1") for p in path.glob(e))
        hint = f"; did you mean {path / inside[0]}?" if inside else ""
        raise DatabaseError(f"{path}: a folder without Nemoh.cal or one WAMIT run{hint}")
    if not path.is_file():
        near = _similar(path)
        raise DatabaseError(f"{path}: no such file or folder{near}")
    if path.suffix.lower() == ".cal":
        return "nemoh"
    with open(path, "rb") as f:
        magic = f.read(8)
    if magic[:3] == b"CDF":
        return "capytaine"
    if h5py.is_hdf5(path):
        if files.is_hydro_file(path):
            return "hydro"
        with opened(path, DatabaseError, "not a readable HDF5 file") as f:
            if "added_mass" in f and "radiating_dof" in f:
                return "capytaine"
            if is_bemio_file(f):
                return "bemio"
            holds = ", ".join(sorted(f)[:6]) or "nothing"
        raise DatabaseError(f"{path}: an HDF5 file of another kind (it holds {holds})")
    if wamit_stem(path) is not None:
        return "wamit"
    raise DatabaseError(
        f"{path}: not a Nemoh folder, a netCDF file of Capytaine, a BEMIO .h5, a WAMIT .1 or a "
        f"hydro.h5 of hydrodae"
    )


def read_source(source: str | Path, *, rho: float | None = None) -> SourceData:
    """Read a Nemoh folder, or files of Capytaine, BEMIO or WAMIT, as they are.

    Parameters
    ----------
    source : path
        File or folder.
    rho : float, optional
        Density of the water [kg/m3], where the source does not say (WAMIT).

    Raises
    ------
    DatabaseError
        Missing or wrong files, or `rho` contradicts the source; the message names file and line.
    """
    path = Path(source)
    what = kind(path)
    if what == "wamit":
        return read_wamit(path, rho)
    if what == "nemoh":
        from hydrodae.hdb.readers.nemoh import read_nemoh

        data = read_nemoh(path)
    elif what == "bemio":
        data = read_bemio(path)
    elif what == "capytaine":
        from hydrodae.hdb.readers.capytaine import read_capytaine

        data = read_capytaine(path)
    else:
        raise DatabaseError(f"{path}: a finished hydro.h5, not a source")
    _check_density(path, data.rho, rho)
    return data


def _check_density(path: Path, stated: float, given: float | None) -> None:
    if given is not None and not np.isclose(given, stated, rtol=1e-3):
        raise DatabaseError(f"{path}: the density there is {stated:g} kg/m3, not {given:g}")


def read(source: str | Path, *, rho: float | None = None) -> HydroDatabase:
    """Read any supported source: `hydro.h5`, Nemoh folder, Capytaine, BEMIO or WAMIT files.

    Parameters
    ----------
    source : path
        File or folder.
    rho : float, optional
        Density of the water [kg/m3], where the source does not say (WAMIT).

    Returns
    -------
    HydroDatabase
        In the project convention, A and B symmetrised. Use `import_database` to see the checks.

    Raises
    ------
    DatabaseError
        Missing or wrong files.
    """
    if kind(source) == "hydro":
        database = HydroDatabase.read(source)
        _check_density(Path(source), database.rho, rho)
        return database
    return finish(read_source(source, rho=rho))


def import_database(
    source: str | Path,
    *,
    names: Sequence[str] | Mapping[str, str] | None = None,
    reference_points: Mapping[str, ArrayLike] | None = None,
    source_points: Mapping[str, ArrayLike] | None = None,
    hydrostatics: Mapping[str, Hydrostatics] | None = None,
    rho: float | None = None,
) -> tuple[HydroDatabase, CheckReport]:
    """Read a source, check it, rename its bodies and move it to the scene's reference points.

    Parameters
    ----------
    source : path
        As in `read`.
    names : list or dict, optional
        New body names, in the order of the source, or {old: new}. All other arguments use the new
        names.
    reference_points : dict of (3,) arrays, optional
        Points to move to, usually the centres of gravity, world [m].
    source_points : dict of (3,) arrays, optional
        Points about which the moments of the source are, where the source does not say [m].
    hydrostatics : dict of Hydrostatics, optional
        Where the source has none, or wrong ones; waterplane moments about `reference_points`.
    rho : float, optional
        Density of the water [kg/m3], where the source does not say (WAMIT).

    Returns
    -------
    database : HydroDatabase
    report : CheckReport
        Findings of the reader and of `hydrodae.hdb.check`.

    Raises
    ------
    DatabaseError
        Missing or wrong files, unknown bodies, points that cannot be moved.
    """
    if kind(source) == "hydro":
        database, noticed = read(source, rho=rho), list[Finding]()
    else:
        data = read_source(source, rho=rho)
        new = {name: name for name in bodies_of(data.coordinates)}
        new.update(_renaming(list(new), names))
        _state_points(data, {v: k for k, v in new.items()}, source_points or {})
        database = finish(data)
        noticed = data.findings
    database = database.renamed(_renaming(list(database.bodies), names))
    if reference_points:
        database = database.moved_to(reference_points)
    if hydrostatics:
        database = database.with_hydrostatics(hydrostatics)
        if set(hydrostatics) == set(database.bodies):  # what the source lacks does not matter
            noticed = [f for f in noticed if f.check != "hydrostatics"]
    return database, CheckReport([*noticed, *check(database).findings])


def _renaming(
    bodies: Sequence[str], names: Sequence[str] | Mapping[str, str] | None
) -> Mapping[str, str]:
    if names is None:
        return {}
    if isinstance(names, Mapping):
        return names
    if isinstance(names, str) or len(names) != len(bodies):
        raise DatabaseError(
            f"{len(bodies)} bodies in the source ({', '.join(bodies)}), "
            f"but the new names are {names}"
        )
    return dict(zip(bodies, names, strict=True))


def _state_points(
    data: SourceData, old_names: Mapping[str, str], points: Mapping[str, ArrayLike]
) -> None:
    """Enter reference points that the source leaves out; contradicting the source is an error."""
    for name, value in points.items():
        check_body(name, old_names)
        old, point = old_names[name], np.asarray(value, dtype=float)
        known = data.reference_points.get(old)
        if known is not None and not np.allclose(known, point, atol=1e-6):
            raise DatabaseError(
                f"the source says the moments of {name!r} are about {known.tolist()}, "
                f"not {point.tolist()}"
            )
        data.reference_points[old] = point


def _similar(path: Path) -> str:
    if not path.parent.is_dir():
        return ""
    return nearest(path.name, sorted(p.name for p in path.parent.iterdir()))
