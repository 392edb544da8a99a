"""Damaged files: one error instead of what h5py and NumPy make of them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from hydrodae.errors import HydrodaeError
from hydrodae.support.child import ChildEnded, in_child

if TYPE_CHECKING:
    import h5py

Result = TypeVar("Result")

#: Start of a collection of texts of variable length: HDF5 File Format Specification, III.E.
_COLLECTION = re.compile(rb"GCOL\x01\0\0\0(.{8})", re.DOTALL)
_HEADER = 16  # bytes, of a collection and of an object in it
_PART = 16 << 20  # bytes at either end of a file, where texts are written


def _damaged_texts(path: Path) -> int | None:
    """Place of a collection whose objects do not follow each other up to its end."""
    size = path.stat().st_size
    with path.open("rb") as file:
        for start in sorted({0, max(0, size - _PART)}):
            file.seek(start)
            part = file.read(_PART)
            for found in _COLLECTION.finditer(part):
                length = int.from_bytes(found[1], "little")
                if length < _HEADER or start + found.start() + length > size:
                    return start + found.start()
                objects = part[found.start() + _HEADER : found.start() + length]
                if len(objects) == length - _HEADER and not _sound(objects):
                    return start + found.start()
    return None


def _sound(objects: bytes) -> bool:
    at, end = 0, len(objects)
    while end - at >= _HEADER:
        index = int.from_bytes(objects[at : at + 2], "little")
        length = int.from_bytes(objects[at + 8 : at + _HEADER], "little")
        # index 0 is the free space, header included; others are padded to eight bytes
        taken = length if index == 0 else _HEADER + (length + 7) // 8 * 8
        if not _HEADER <= taken <= end - at:
            return False
        at += taken
    return True


def reading(
    path: Path,
    error: Callable[[Path, str], HydrodaeError],
    what: str,
    read: Callable[[h5py.File], Result],
    *,
    search: bool = False,
    sound: bool = False,
) -> Result:
    """Return what a function reads of an HDF5 file.

    Parameters
    ----------
    path : Path
        An existing file.
    error : callable
        Makes of the path and a text what is raised for everything that its contents make
        impossible: it is cut off, bytes have changed, a dataset has another shape or type,
        something is missing.
    what : str
        Said of the file then, for example "not a readable results file".
    read : callable
        Takes the open file. It runs in a child process: what it changes is lost, and what it
        returns must not belong to the file.
    search : bool
        Search it for what the HDF5 library would read for ever.
    sound : bool
        This process has written the file: no search, and no child.
    """
    import h5py

    def work() -> Result:
        with h5py.File(path, "r") as file:
            return read(file)

    if sound:
        with guarded(path, error, what):
            return work()
    if search and (at := _damaged_texts(path)) is not None:
        raise error(path, f"{what}: a collection of texts at byte {at} is damaged")
    return apart(path, error, what, work)


def apart(
    path: Path, error: Callable[[Path, str], HydrodaeError], what: str, work: Callable[[], Result]
) -> Result:
    """Return what a function returns that calls the HDF5 library, in a child process.

    On damaged files, libraries that are written in C read and write beyond their memory. The child
    ends then, or its memory is spoilt; this process never takes a damaged file into its own.

    Parameters
    ----------
    path, error, what
        As `reading`.
    work : callable
        It returns objects of Python and arrays, which must not belong to an open file.
    """

    def guard() -> Result:
        with guarded(path, error, what):
            return work()

    try:
        return in_child(guard)
    except ChildEnded as end:
        if end.fault:
            fault = f"is damaged: reading it ended the HDF5 library by {end}; export it again"
        else:
            fault = f"reading it was ended by {end}; is memory short?"
        raise error(path, fault) from None


@contextmanager
def guarded(path: Path, error: Callable[[Path, str], HydrodaeError], what: str) -> Iterator[None]:
    """Raise one error for everything that the contents of a file make impossible, as `reading`."""
    try:
        yield
    except HydrodaeError:
        raise
    except (
        *(ArithmeticError, AttributeError, LookupError, MemoryError),
        *(OSError, RuntimeError, TypeError, ValueError),
    ) as cause:
        # str() of a KeyError is its text in quotes
        text = cause.args[0] if isinstance(cause, KeyError) and cause.args else cause
        raise error(path, f"{what}: {text or type(cause).__name__}") from cause
