"""Files that commands write: nothing is replaced but a file of the same kind.

The content decides the kind of a file that is there; its ending only where it is plain text.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from hydrodae.errors import CaseError
from hydrodae.support.damaged import reading

if TYPE_CHECKING:
    import h5py

DATABASE = "hydrodynamic database"
RESULTS = "results file"
NETCDF = "netCDF file"
#: What WEC-Sim reads.
BEMIO = "BEMIO file"
HDF5 = "HDF5 file of another program"
PICTURE = "picture"
VIDEO = "video"
PAGE = "page"
TABLES = "file of mooring tables"
CSV = "CSV file"
JSON = "JSON file"
TEXT = "text file"
OTHER = "file of another kind"

#: First bytes of pictures; SVG, EPS and PGF are text.
_PICTURES = (b"\x89PNG", b"\xff\xd8", b"%PDF", b"%!PS", b"GIF8", b"RIFF", b"II*", b"MM\0")
_ENDINGS = {
    ".csv": CSV,
    ".json": JSON,
    ".html": PAGE,
    ".htm": PAGE,
    ".svg": PICTURE,
    ".svgz": PICTURE,
    ".eps": PICTURE,
    ".pgf": PICTURE,
    ".raw": PICTURE,
    ".rgba": PICTURE,
    ".mp4": VIDEO,
    ".webm": VIDEO,
}
#: First lines of what `hydrodae mooring` writes.
_MOORINGS = ("# Moorings of", ": moorings linearised about the static equilibrium.")


def claim(path: str | os.PathLike[str], kind: str) -> Path:
    """Return the path of a file of this kind that may be written; its folder is made.

    Raises
    ------
    CaseError
        As `spare`, or no folder can be made for it.
    """
    target = spare(path, kind)
    claim_folder(target.parent)
    return target


def spare(path: str | os.PathLike[str], kind: str) -> Path:
    """Return the path of a file of this kind that may be written.

    Parameters
    ----------
    path : path
    kind : str
        One of the kinds of this module.

    Raises
    ------
    CaseError
        There is a folder of that name, or a file of another kind, which is not replaced.
    """
    target = Path(path)
    if target.is_dir():
        raise CaseError(f"{target}: is a folder; name a file for the {kind}")
    found = kind_of(target)
    if found is not None and not (found == kind or {found, kind} == {PICTURE, VIDEO}):
        raise CaseError(
            f"{target}: is a {found}, which a {kind} does not replace; name another file"
        )
    return target


def claim_folder(path: str | os.PathLike[str]) -> Path:
    """Make a folder if there is none.

    Raises
    ------
    CaseError
        A file stands in its place, or it cannot be made.
    """
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise CaseError(f"{folder}: is a file; name a folder") from None
    except OSError as error:
        raise CaseError(f"{folder}: no folder can be made there: {error.strerror}") from None
    return folder


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Give a path to write to, which becomes `path` when all is written; else nothing is left.

    Raises
    ------
    OSError
        It cannot be written, as on a full disk; `filename` names it.
    """
    if path.exists() and not path.is_file():  # a device or a pipe
        yield path
        return
    target = Path(os.path.realpath(path))
    beside = target.with_name(f"{target.stem}.writing{target.suffix}")
    try:
        yield beside
        beside.replace(target)
    except OSError as error:
        if error.filename in (None, str(beside)):
            raise OSError(error.errno, error.strerror or str(error), str(path)) from None
        raise
    finally:
        beside.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write a whole text file, or leave what is there; raises OSError as `whole`."""
    with whole(path) as beside:
        beside.write_text(text, encoding="utf-8")


def kind_of(path: Path) -> str | None:
    """The kind of a file; None for a missing or empty file."""
    if not path.exists():
        return None
    try:
        if path.stat().st_size == 0:
            return None
        with path.open("rb") as file:
            head = file.read(4096)
    except OSError as error:
        raise CaseError(f"{path}: {error.strerror}") from None
    import h5py  # with numpy, longer to load than a short run takes

    if h5py.is_hdf5(path):
        return _kind_of_hdf5(path)
    if head.startswith(b"CDF"):
        return NETCDF
    if head.startswith(_PICTURES):
        return PICTURE
    return _kind_of_text(path, head)


def _kind_of_hdf5(path: Path) -> str:

    try:
        return reading(path, _unknown, HDF5, _kind_of_open)
    except CaseError:
        return HDF5


def _unknown(path: Path, fault: str) -> CaseError:
    return CaseError(f"{path}: {fault}")


def _kind_of_open(file: h5py.File) -> str:
    if "_NCProperties" in file.attrs:  # a copy of results too, with their attributes
        return NETCDF
    marks = file.attrs.get("format", "")
    made = marks.decode() if isinstance(marks, bytes) else str(marks)
    if made == "hydrodae-hydro":
        return DATABASE
    if made == "hydrodae-results":
        return RESULTS
    return BEMIO if "simulation_parameters" in file else HDF5


def _kind_of_text(path: Path, head: bytes) -> str:
    ending = path.suffix.lower()
    first = head.splitlines()[0].decode("utf-8", "replace") if head.splitlines() else ""
    if any(words in first for words in _MOORINGS):
        return TABLES
    if ending == ".toml":
        return "TOML file"
    if b"\0" in head and ending not in (".mp4", ".webm"):
        return OTHER
    return _ENDINGS.get(ending, TEXT)
