"""Results files of other processes, which may be damaged.

h5py has a newer HDF5 library than the kernel, which survives more.
"""

from __future__ import annotations

from typing import Any

import h5py
import numpy as np

#: Attributes of references to dimension scales.
_REFERENCES = ("DIMENSION_LIST", "REFERENCE_LIST")


class Reader:
    """An open results file, with the methods of the kernel's `ResultsReader`.

    What the contents of the file make impossible raises whatever h5py and NumPy raise.
    """

    def __init__(self, file: h5py.File) -> None:
        self._file = file

    def datasets(self) -> list[bytes]:
        """Paths of all datasets."""
        names: list[bytes] = []

        def note(name: bytes, node: h5py.h5o.ObjInfo) -> None:
            if node.type == h5py.h5o.TYPE_DATASET:
                names.append(name)

        h5py.h5o.visit(self._file.id, note, info=True)  # without an object of h5py for each
        return names

    def has(self, member: str) -> bool:
        """Whether there is such a member of the root."""
        return self._file.get(member) is not None

    def attributes(self, object: str) -> dict[str, Any]:
        """Attributes of a group or dataset: texts, numbers, lists of numbers."""
        found = {_name(key): value for key, value in self._file[object].attrs.items()}
        return {name: _plain(found[name]) for name in found if name not in _REFERENCES}

    def shape(self, dataset: str) -> tuple[int, ...]:
        """Shape of a dataset."""
        return tuple(self._file[dataset].shape)

    def read(self, dataset: str, rows: int) -> tuple[bytearray, tuple[int, ...]]:
        """The first rows of a dataset as float64 numbers, and their shape."""
        table = self._file[dataset]
        found = np.asarray(table[:rows] if table.shape else table[()])
        if found.dtype.kind not in "fiu":
            raise TypeError(f"expected numbers, found {found.dtype}")
        return bytearray(found.astype(np.float64).tobytes()), found.shape


def _name(key: str | bytes) -> str:
    """Name of an attribute; damaged ones come as bytes."""
    return key.decode("utf-8", "replace") if isinstance(key, bytes) else key


def _plain(value: Any) -> Any:
    """Attribute as plain Python: str, int, float, bool or list."""
    if isinstance(value, bytes):
        return value.decode()
    return value.tolist() if isinstance(value, np.generic | np.ndarray) else value
