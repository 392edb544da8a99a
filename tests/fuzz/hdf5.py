"""Mutated HDF5 files: contents through the library, and damaged bytes."""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import Any

import h5py
import numpy as np

NUMBERS = (np.nan, np.inf, -np.inf, 0.0, -1.0, 1e308, -1e308, 5e-324, 1e-300, 1e9, 1.0)
ATTRIBUTES: tuple[Any, ...] = (
    *(0, 1, 2, -1, 1.0, np.nan, np.inf, 2**62, "", "x", "hydrodae-hydro", "жук", b"\xff\xfe"),
    *([], [1.0], [1.0, 2.0, 3.0], [[1.0]], ["a", "b"], True, 1 + 2j, h5py.Empty("f8")),
    *(np.float32(1.0), np.int8(1), np.zeros(3), np.zeros((2, 2))),
)


def _objects(file: h5py.File) -> list[str]:
    names: list[str] = []
    file.visit(names.append)
    return names


def _datasets(file: h5py.File) -> list[str]:
    """Those that can be read whole: `_oversize` makes others."""
    found = ((name, file.get(name)) for name in _objects(file))
    return [name for name, node in found if isinstance(node, h5py.Dataset) and node.size < 10**7]


def _replace(file: h5py.File, name: str, data: Any, **how: Any) -> None:
    attributes = dict(file[name].attrs)
    del file[name]
    made = file.create_dataset(name, data=data, **how)
    for key, value in attributes.items():
        made.attrs[key] = value


def _change_values(file: h5py.File, random: Random) -> None:
    name = random.choice(_datasets(file))
    data = file[name][()]
    if not isinstance(data, np.ndarray) or data.size == 0 or data.dtype.kind not in "fci":
        return
    flat = data.reshape(-1)
    how = random.randrange(6)
    some = [random.randrange(flat.size) for _ in range(random.choice((1, 1, 5)))]
    with np.errstate(all="ignore"):
        if how == 0:
            flat[some] = np.array(random.choice(NUMBERS)).astype(flat.dtype)
        elif how == 1:
            flat[:] = np.array(random.choice(NUMBERS)).astype(flat.dtype)
        elif how == 2:
            flat *= random.choice((-1, 2, 0)) if flat.dtype.kind == "i" else flat.dtype.type(-1.0)
        elif how == 3:
            flat[:] = flat[::-1].copy()
        elif how == 4:
            flat[some] = flat[some] * 1000
        else:
            np.random.default_rng(random.randrange(2**32)).shuffle(flat)
    _replace(file, name, data)


def _change_shape(file: h5py.File, random: Random) -> None:
    name = random.choice(_datasets(file))
    data = np.asarray(file[name][()])
    how = random.randrange(8)
    if how == 0 and data.ndim:
        data = data[:-1]
    elif how == 1 and data.ndim:
        data = np.concatenate([data, data[-1:]])
    elif how == 2:
        data = data.reshape(-1)
    elif how == 3:
        data = data[None]
    elif how == 4:
        data = data[:0] if data.ndim else data
    elif how == 5:
        data = data.T
    elif how == 6 and data.size:
        data = data.reshape(-1)[0]
    else:
        data = np.repeat(data, 3, axis=-1) if data.ndim else data
    _replace(file, name, data)


def _change_type(file: h5py.File, random: Random) -> None:
    name = random.choice(_datasets(file))
    data = np.asarray(file[name][()])
    kinds = ("f4", "f2", "i4", "u1", "i8", "c16", "c8", "S3", "?", ">f8")
    shape = data.shape
    if random.random() < 0.3:
        texts = np.full(shape, random.choice(("a", "жук", "", "1.0")), dtype=object)
        _replace(file, name, texts, dtype=h5py.string_dtype())
    elif random.random() < 0.15:
        pair = np.dtype([("r", "f8"), ("i", random.choice(("f8", "i4", "S2")))])
        _replace(file, name, np.zeros(shape, dtype=pair))
    else:
        _replace(file, name, np.zeros(shape, dtype=random.choice(kinds)))


def _oversize(file: h5py.File, random: Random) -> None:
    """Sizes that the file does not hold: storage that was never written."""
    name = random.choice(_datasets(file))
    rank = max(1, file[name].ndim)
    size = random.choice((10**5, 10**9, 2**31, 2**40, 2**62)) if rank == 1 else 10**6
    attributes = dict(file[name].attrs)
    kind = file[name].dtype
    del file[name]
    made = file.create_dataset(name, shape=(size,) * rank, chunks=(100,) * rank, dtype=kind)
    for key, value in attributes.items():
        made.attrs[key] = value


def _change_attribute(file: h5py.File, random: Random) -> None:
    owners = [file, *(file[name] for name in _objects(file))]
    owners = [owner for owner in owners if len(owner.attrs)]
    if not owners:
        return
    owner = random.choice(owners)
    key = random.choice(list(owner.attrs))
    how = random.randrange(4)
    if how == 0:
        del owner.attrs[key]
    elif how == 1:
        owner.attrs[random.choice(("unit", "x", ""))] = owner.attrs[key]
    else:
        owner.attrs[key] = random.choice(ATTRIBUTES)


def _change_link(file: h5py.File, random: Random) -> None:
    names = _objects(file)
    name = random.choice(names)
    how = random.randrange(6)
    if how == 0:
        del file[name]
    elif how == 1:
        file.move(name, random.choice((name + "x", "x", "жук")))
    elif how == 2:
        file[name + " again"] = file[name]
    elif how == 3:
        del file[name]
        file[name] = h5py.SoftLink(random.choice(("/nowhere", "/", name, ".")))
    elif how == 4:
        del file[name]
        file[name] = h5py.ExternalLink("nowhere.h5", "/")
    else:
        other = random.choice(names)
        if not name.startswith(other) and not other.startswith(name):
            node = file[other]
            del file[name]
            file[name] = node


def _change_kind(file: h5py.File, random: Random) -> None:
    """A group where a dataset was, and the other way round."""
    name = random.choice(_objects(file))
    group = isinstance(file.get(name), h5py.Group)
    del file[name]
    if group:
        file[name] = np.arange(3.0)
    else:
        file.create_group(name)


CONTENTS = (
    *(_change_values, _change_values, _change_values, _change_shape, _change_type, _oversize),
    *(_change_attribute, _change_attribute, _change_attribute, _change_link, _change_kind),
)


def damage(path: Path, random: Random) -> None:
    """Cut the file, or change some of its bytes."""
    data = bytearray(path.read_bytes())
    how = random.randrange(4)
    if how == 0:
        del data[random.randrange(len(data)) :]
    else:
        reach = random.choice((2048, len(data)))  # the head holds most of the structure
        for _ in range(random.choice((1, 1, 4, 30))):
            at = random.randrange(min(reach, len(data)))
            if how == 1:
                data[at] ^= 1 << random.randrange(8)
            elif how == 2:
                data[at] = random.choice((0, 255, 127, 128, random.randrange(256)))
            else:
                data[at : at + 16] = bytes(len(data[at : at + 16]))
    path.write_bytes(data)


def mutate(path: Path, random: Random) -> None:
    """Change a file in place."""
    if random.random() < 0.35:
        return damage(path, random)
    with h5py.File(path, "r+") as file:
        for _ in range(random.choice((1, 1, 2, 4))):
            try:
                random.choice(CONTENTS)(file, random)
            except (
                *(KeyError, ValueError, TypeError, OSError),
                IndexError,
                RuntimeError,
                MemoryError,
            ):
                pass  # what an earlier change left cannot be changed so
    return None
