"""Threads of the linear algebra: on small matrices they cost more than they save."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

_NAMES = tuple(
    f"{prefix}openblas_{{}}_num_threads{suffix}"
    for prefix in ("scipy_", "")
    for suffix in ("64_", "")
)


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Let OpenBLAS, which wheels of numpy and scipy bring, work with one thread for a while.

    Its threads wait in a busy loop: on matrices of some hundred rows two threads save little time,
    and many times the processor time is lost where other programs run. Other libraries keep theirs.
    """
    before = [(change, read()) for change, read in _pools()]
    try:
        for change, _ in before:
            change(1)
        yield
    finally:
        for change, number in before:
            change(number)


def _pools() -> list[tuple[Callable[[int], object], Callable[[], int]]]:
    """Return what sets and reads the number of threads of each OpenBLAS that is loaded."""
    loaded = {
        line.split(maxsplit=5)[5].strip()
        for line in Path("/proc/self/maps").read_text(encoding="utf-8").splitlines()
        if "openblas" in line and ".so" in line
    }
    found = []
    for library in (ctypes.CDLL(path) for path in sorted(loaded)):
        name = next((name for name in _NAMES if hasattr(library, name.format("set"))), None)
        if name is not None:
            found.append(
                (getattr(library, name.format("set")), getattr(library, name.format("get")))
            )
    return found
