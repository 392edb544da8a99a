"""Every dataset of `hydro.h5`: its dimensions, type and unit; what reads and writes them.

Letters name lengths that several datasets share; where one of them stands for the first time in a
group, it is what the file says: n coordinates, w frequencies, h headings, i what moves, o what is
loaded, t times, p poles, m panels, j modes. Units of tables are those of translations, of their
coupling with rotations, and of rotations. cpp/hydrodae/io/hydro_file.cpp checks the same shapes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import h5py
import numpy as np

from hydrodae.errors import DatabaseError, Refusal

MASS, RATE, FORCE = "kg, kg m, kg m2", "N s/m, N s, N m s", "N/m, N m/m"
STIFFNESS = "N/m, N, N m"


@dataclass(frozen=True)
class Kind:
    """What a dataset may hold, in NumPy's letters, how an error names it, and as what it is read.

    `types` are those of numbers in double and single precision; labels have none.
    """

    letters: str
    called: str
    types: tuple[type, type] | None = None

    @property
    def is_text(self) -> bool:
        """Whether it holds labels."""
        return self.types is None

    def number(self, single: bool = False) -> type:
        """Type of its numbers; labels have none."""
        assert self.types is not None
        return self.types[single]


TEXT = Kind("SO", "text")
REAL = Kind("fiu", "numbers", (np.float64, np.float32))
COMPLEX = Kind("fiuc", "numbers", (np.complex128, np.complex64))


@dataclass(frozen=True)
class Entry:
    """A dataset: its dimensions (letters, or lengths that never differ), kind and unit."""

    dims: tuple[str | int, ...]
    kind: Kind = REAL
    unit: str = ""


TABLES = {
    "coordinates": Entry(("n",), TEXT),
    "omega": Entry(("w",), unit="rad/s"),
    "added_mass": Entry(("w", "n", "n"), unit=MASS),
    "radiation_damping": Entry(("w", "n", "n"), unit=RATE),
    "added_mass_inf": Entry(("n", "n"), unit=MASS),
    "added_mass_inf_std": Entry(("n", "n"), unit=MASS),
    "heading": Entry(("h",), unit="rad"),
    "excitation/froude_krylov": Entry(("w", "h", "n"), COMPLEX, FORCE),
    "excitation/diffraction": Entry(("w", "h", "n"), COMPLEX, FORCE),
}
BODY = {
    "hydrostatic_stiffness": Entry((6, 6), unit=STIFFNESS),
    "mesh": Entry(("m", 4, 3), unit="m"),
    "mode_shapes": Entry(("j", "m", 4, 3), unit="-"),
    "mode_stiffness": Entry(("k", "k"), unit=STIFFNESS),
}
KERNEL = {
    "inputs": Entry(("i",), TEXT),
    "outputs": Entry(("o",), TEXT),
    "time": Entry(("t",), unit="s"),
    "kernel": Entry(("t", "o", "i"), unit=STIFFNESS),
    "added_mass_inf": Entry(("o", "i"), unit=MASS),
}
FIT = {
    "inputs": Entry(("i",), TEXT),
    "outputs": Entry(("o",), TEXT),
    "poles": Entry(("p",), COMPLEX),
    "input_matrix": Entry(("p", "i"), COMPLEX),
    "output_matrix": Entry(("o", "p"), COMPLEX),
    "added_mass_inf": Entry(("o", "i"), unit=MASS),
}
#: Numbers of a body that are attributes of its group.
BODY_NUMBERS: dict[str, tuple[int, ...]] = {
    "reference_point": (3,),
    "displaced_volume": (),
    "center_of_buoyancy": (3,),
    "waterplane_area": (),
    "waterplane_moments": (5,),
}


def read_group(group: h5py.Group, layout: Mapping[str, Entry]) -> dict[str, Any]:
    """Read the datasets of a group, float or complex, labels as tuples of str.

    Parameters
    ----------
    group : h5py.Group
    layout : dict of Entry
        Those that the group lacks are left out.

    Raises
    ------
    DatabaseError
        Another type or shape than declared, or numbers that are not finite.
    """
    sizes: dict[str, int] = {}
    return {
        name: _read(group, name, entry, sizes) for name, entry in layout.items() if name in group
    }


def read_numbers(group: h5py.Group, name: str, shape: tuple[int, ...]) -> Any:
    """Read an attribute that holds numbers of a shape.

    Raises
    ------
    DatabaseError
        It is missing, or of another type or shape.
    """
    if name not in group.attrs:
        raise refused(group, name, "missing", "missing", ": attribute ")
    values = np.asarray(group.attrs[name])
    if values.dtype.kind not in "fiu":
        raise refused(
            group, name, "format", f"expected numbers, found {values.dtype}", ": attribute "
        )
    if values.shape != shape:
        raise refused(
            group, name, "shape", f"expected shape {shape}, found {values.shape}", ": attribute "
        )
    return float(values) if shape == () else values.astype(float)


def refused(
    group: h5py.Group, name: str, reason: Refusal, fault: str, between: str = "/"
) -> DatabaseError:
    """Return the error about a dataset of a group, or, with ": attribute ", an attribute."""
    place = f"{group.name}{between}{name}".replace("//", "/")
    return DatabaseError(f"{place}: {fault}").about(reason, name, file=group.file.filename)


def write_dataset(group: h5py.Group, name: str, entry: Entry, value: Any) -> None:
    """Write a dataset as it is declared; labels as texts of 32 characters."""
    if entry.kind.is_text:
        group.create_dataset(name, data=_labels(value))
        return
    data = np.asarray(value)
    options = {"compression": "gzip", "shuffle": True} if data.size > 64 else {}
    dataset = group.create_dataset(name, data=data, **options)
    if entry.unit:
        dataset.attrs["unit"] = entry.unit


def _read(group: h5py.Group, name: str, entry: Entry, sizes: dict[str, int]) -> Any:
    node = group[name]
    if not isinstance(node, h5py.Dataset) or node.shape is None:
        raise refused(group, name, "format", "expected a dataset")
    if node.dtype.kind not in entry.kind.letters:
        raise refused(group, name, "format", f"expected {entry.kind.called}, found {node.dtype}")
    if len(node.shape) == len(entry.dims):
        for dim, length in zip(entry.dims, node.shape, strict=True):
            if isinstance(dim, str):
                sizes.setdefault(dim, length)
    wanted = tuple(sizes.get(d, d) if isinstance(d, str) else d for d in entry.dims)
    if node.shape != wanted:
        text = ", ".join(map(str, wanted)) + ("," if len(wanted) == 1 else "")
        raise refused(group, name, "shape", f"expected shape ({text}), found {node.shape}")
    values = np.asarray(node[()])
    if entry.kind.is_text:
        return tuple(v.decode("ascii") if isinstance(v, bytes) else str(v) for v in values)
    if not np.all(np.isfinite(values)):
        raise refused(group, name, "not_finite", "holds values that are not finite")
    return values.astype(entry.kind.number())


def _labels(labels: Any) -> np.ndarray[Any, Any]:
    labels = list(labels)
    long = [label for label in labels if len(label.encode("ascii", "replace")) > 32]
    if long:
        raise DatabaseError(
            f"label {long[0]!r} is longer than 32 characters: rename the body"
        ).about("label", long[0])
    return np.array(labels, dtype="S32")
