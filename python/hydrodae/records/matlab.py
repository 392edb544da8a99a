"""Tables in MATLAB's files: vectors and matrices, in structures as well."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records.columns import Columns, numbered
from hydrodae.records.mat_elements import check
from hydrodae.support.damaged import reading

#: Fewest numbers that are a column; shorter ones are settings.
_FEWEST = 4
_ADVICE = "save vectors of equal length, or a matrix: save('record.mat', 'time', 'elevation')"


def read_matlab(path: Path) -> Columns:
    """Read a .mat file of version 4 to 7.

    Raises
    ------
    CaseError
        It cannot be read, or holds no vectors or matrices of numbers.
    """
    arrays: dict[str, np.ndarray] = {}
    _gather(load(path), "", arrays)
    return _table(path, arrays)


def load(path: Path) -> dict[str, Any]:
    """Variables of a .mat file of version 4 to 7; structures are dicts.

    Raises
    ------
    CaseError
        It cannot be read.
    """
    from scipy.io import loadmat

    try:
        check(path.read_bytes())
        return dict(loadmat(path, simplify_cells=True))
    except MemoryError:
        raise CaseError(f"{path}: its arrays are larger than the memory") from None
    except Exception as error:  # of a damaged file, scipy raises whatever its bytes lead to
        raise CaseError(f"{path}: is no .mat file that can be read: {error}") from None


def read_hdf5(path: Path) -> Columns:
    """Read a .mat file of version 7.3, or another HDF5 file.

    Raises
    ------
    CaseError
        It cannot be read, or holds no vectors or matrices of numbers.
    """

    def fault(file: Path, text: str) -> CaseError:
        return CaseError(f"{file}: {text}")

    return _table(path, reading(path, fault, "cannot be read", _numbers, search=True))


def _numbers(file: h5py.File) -> dict[str, np.ndarray]:
    """Arrays of numbers of an HDF5 file, in the order of MATLAB."""
    arrays: dict[str, np.ndarray] = {}

    def take(name: str, item: h5py.Group | h5py.Dataset) -> None:
        if name.startswith("#") or not isinstance(item, h5py.Dataset):
            return
        kind = item.attrs.get("MATLAB_class", b"")
        if item.dtype.kind in "fiu" and kind not in (b"char", b"cell", "char", "cell"):
            arrays[name.replace("/", ".")] = np.asarray(item[()]).T

    file.visititems(take)
    return arrays


def _gather(found: Mapping[str, Any], prefix: str, arrays: dict[str, np.ndarray]) -> None:
    for name, value in found.items():
        if name.startswith("__"):
            continue
        if isinstance(value, Mapping):
            _gather(value, f"{prefix}{name}.", arrays)
        elif isinstance(value, np.ndarray) and value.dtype.kind in "fiu":
            arrays[prefix + name] = value


def _table(path: Path, arrays: Mapping[str, np.ndarray]) -> Columns:
    """Columns of the length that most of them have; a matrix gives several: "data(:,2)"."""
    columns: dict[str, np.ndarray] = {}
    matrices = 0
    for name, array in arrays.items():
        values = np.squeeze(array)
        if values.ndim == 2 and min(values.shape) > 1:
            upright = values if values.shape[0] >= values.shape[1] else values.T
            matrices += 1
            for k in range(upright.shape[1]):
                columns[f"{name}(:,{k + 1})"] = upright[:, k]
        elif values.ndim == 1:
            columns[name] = values
    columns = {name: column for name, column in columns.items() if len(column) >= _FEWEST}
    if not columns:
        raise CaseError(f"{path}: no vectors or matrices of numbers in it; {_ADVICE}")
    lengths = Counter(len(column) for column in columns.values()).most_common()
    if len(lengths) > 1 and lengths[0][1] == lengths[1][1]:
        sizes = ", ".join(f"{name} ({len(column)})" for name, column in columns.items())
        raise CaseError(f"{path}: columns of several lengths: {sizes}; {_ADVICE}")
    kept = {name: column for name, column in columns.items() if len(column) == lengths[0][0]}
    others = [name for name in columns if name not in kept]
    notes = [f"of another length and left out: {', '.join(others)}"] if others else []
    values = np.column_stack(list(kept.values())).astype(float)
    if matrices == 1 and all("(:," in name for name in kept):
        return Columns(numbered(len(kept)), values, False, notes)  # one matrix: no names
    return Columns(list(kept), values, True, notes)
