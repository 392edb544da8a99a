"""Report what a source is by its content, and find it in a folder."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path

import h5py

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import files
from hydrodae.hdb.database.coordinates import nearest
from hydrodae.hdb.readers.bemio import is_bemio_file
from hydrodae.hdb.readers.foreign import foreign, foreign_in
from hydrodae.hdb.readers.formats import expected_files, formats
from hydrodae.hdb.readers.hydrodyn import tables_of
from hydrodae.hdb.readers.text import files_named, only
from hydrodae.support.damaged import reading

#: How far below the folder that was named, and in how many folders, runs are looked for.
DEEPEST, MOST = 5, 2000


def resolve(source: str | Path) -> tuple[Path, str]:
    """Return the file or folder to read, and what it is.

    Parameters
    ----------
    source : path
        A file, or a folder that holds one database.

    Returns
    -------
    path : Path
        The source itself, or the one file of a folder that is meant.
    kind : str
        "hydro", "nemoh", "capytaine", "bemio" or the name of one of the `formats`.

    Raises
    ------
    DatabaseError
        No such file, nothing that can be read, or several files that could be meant.
    """
    path = Path(source)
    if path.is_dir():
        return _folder(path)
    if not path.is_file():
        raise DatabaseError(f"no such file or folder{_similar(path)}").about("missing", file=path)
    path = tables_of(path) or path
    return path, _file(path)


def kind(source: str | Path) -> str:
    """Return what a source is; see `resolve`."""
    return resolve(source)[1]


def _folder(path: Path) -> tuple[Path, str]:
    if _nemoh(path):
        return path, "nemoh"
    for name, format in formats().items():
        found = format.find(path)
        if found is not None:
            return found, name
    if (table := only(_tables(path))) is not None:
        return resolve(table)
    below = runs_below(path, _holds_one)
    if len(below) == 1:
        return _folder(below[0])
    if below:
        names = ", ".join(str(p.relative_to(path)) for p in below[:8])
        more = f" and {len(below) - 8} more" if len(below) > 8 else ""
        raise DatabaseError(f"databases are in the folders {names}{more}: name one of them").about(
            "ambiguous", file=path
        )
    only([p for p in sorted(path.iterdir()) if p.suffix == ".1"])
    lost = next(iter(files_named(path, "RadiationCoefficients.tec")), None)
    if lost is not None:
        raise DatabaseError(
            f"{lost.relative_to(path)} without the Nemoh.cal of its run, which holds the "
            f"water, the bodies and their reference points"
        ).about("missing", "Nemoh.cal", file=path)
    unread = foreign_in(path)
    if unread is not None:
        raise DatabaseError(unread).about("unsupported")
    raise DatabaseError(
        f"no database in it; expected Nemoh.cal, a .nc of Capytaine, a .h5 of BEMIO, "
        f"{expected_files()}"
    ).about("missing", "database", file=path)


def _nemoh(path: Path) -> bool:
    """Return whether a folder is that of a Nemoh run: with Nemoh.cal, and results there or below.

    A Nemoh.cal in a folder beside the results belongs to it; one above its own results does not.
    """
    cals = files_named(path, "Nemoh.cal")
    if len(cals) != 1:
        return False
    if cals[0].parent == path:
        return bool(files_named(path, "RadiationCoefficients.tec")) or not _tables(path)
    results = files_named(path, "RadiationCoefficients.tec")
    return len(results) == 1


def _holds_one(path: Path) -> bool:
    """Return whether a folder itself holds a database."""
    if _tables(path) or _nemoh(path):
        return True
    try:
        return any(format.find(path) is not None for format in formats().values())
    except DatabaseError:  # several of a kind
        return True


def runs_below(root: Path, holds_one: Callable[[Path], bool]) -> list[Path]:
    """Return the folders below `root` that hold a run, copies of others left out.

    Parameters
    ----------
    root : Path
    holds_one : function of a folder
        Whether it holds a run by itself; folders within such a one are not looked at.

    Returns
    -------
    list of Path
        In alphabetical order. Of folders whose files of results are byte for byte among those of
        another one, that other one only.
    """
    found: list[Path] = []
    waiting = [(child, 1) for child in _folders(root)]
    seen = 0
    while waiting and seen < MOST:
        folder, depth = waiting.pop(0)
        seen += 1
        if holds_one(folder):
            found.append(folder)
        elif depth < DEEPEST:
            waiting += [(child, depth + 1) for child in _folders(folder)]
    return _without_copies(sorted(found))


def _folders(path: Path) -> list[Path]:
    try:
        children = sorted(path.iterdir())
    except OSError:  # not ours to look into
        return []
    return [p for p in children if p.is_dir() and not p.is_symlink() and p.name[0] not in "._"]


def _without_copies(folders: list[Path]) -> list[Path]:
    if len(folders) < 2:
        return folders
    prints = [_prints(folder) for folder in folders]
    kept = []
    for i, own in enumerate(prints):
        within = [
            j
            for j, other in enumerate(prints)
            if j != i and own <= other and (own < other or j < i)
        ]
        if not within or not own:
            kept.append(folders[i])
    return kept


def _prints(folder: Path) -> frozenset[str]:
    """Hashes of the files in and below a folder that are not empty."""
    files = [p for p in folder.rglob("*") if p.is_file() and p.stat().st_size > 0]
    return frozenset(hashlib.sha256(p.read_bytes()).hexdigest() for p in files)


def others(source: Path, what: str) -> list[str]:
    """Names of the databases of other kinds than `what` beside each other in a folder."""
    if not source.is_dir():
        return []
    names = {}
    for kind_of, format in formats().items():
        try:
            found = format.find(source)
        except DatabaseError:  # several of a kind
            continue
        if found is not None:
            names[kind_of] = [found.name if found.is_file() else format.files]
    if what != "bemio":
        names["capytaine"] = [p.name for p in _tables(source)]
    return [name for kind_of, listed in names.items() if kind_of != what for name in listed]


def _tables(path: Path) -> list[Path]:
    """Files of a folder that hold a database by themselves."""
    found = [p for p in sorted(path.iterdir()) if p.suffix.lower() in (".nc", ".h5")]
    return [p for p in found if p.is_file()]


def _file(path: Path) -> str:
    if path.suffix.lower() == ".cal":
        return "nemoh"
    with open(path, "rb") as f:
        magic = f.read(8)
    if magic[:3] == b"CDF":
        return "capytaine"
    if h5py.is_hdf5(path):
        return reading(
            path, files.damaged, "not a readable HDF5 file", lambda f: _hdf5(path, f), search=True
        )
    for name, format in formats().items():
        if format.find(path) is not None:
            return name
    unread = foreign(path)
    if unread is not None:
        raise DatabaseError(unread).about("unsupported")
    raise DatabaseError(
        f"not a Nemoh folder, a netCDF file of Capytaine, a BEMIO .h5, "
        f"{expected_files()} or a hydro.h5 of hydrodae"
    ).about("unsupported", file=path)


def _hdf5(path: Path, f: h5py.File) -> str:
    if files.holds_format(f):
        return "hydro"
    if "added_mass" in f and "radiating_dof" in f:
        return "capytaine"
    if is_bemio_file(f):
        return "bemio"
    holds = ", ".join(sorted(f)[:6]) or "nothing"
    raise DatabaseError(f"an HDF5 file of another kind (it holds {holds})").about(
        "unsupported", file=path
    )


def _similar(path: Path) -> str:
    if not path.parent.is_dir():
        return f"; nor is there a folder {path.parent}"
    beside = sorted(p.name for p in path.parent.iterdir())
    return nearest(path.name, beside) or f"; the folder {path.parent} is empty"
