"""The tables of a case file and their keys, as the kernel declares them.

The commands `hydrodae keys` and `hydrodae schema`, the pages of docs/reference and the methods of
`hydrodae.Scene` are all made from these.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from hydrodae.errors import CaseError

_KINDS = {
    "number": "number",
    "integer": "integer",
    "truth": "true or false",
    "word": "text",
    "words": "text or list of texts",
    "numbers": "list of numbers",
    "points": "list of points",
    "vector3": "3 numbers",
    "vector6": "6 numbers",
    "matrix6": "6 numbers or 6 x 6",
}


@dataclass(frozen=True)
class Key:
    """One key of a table.

    Attributes
    ----------
    name : str
        As written in the file; of a key in a table inside another one also ``initial.name``.
    unit : str
        Unit in the file, "-" for none.
    doc : str
        Meaning.
    kind : str
        number, integer, truth, word, words, numbers, points, vector3, vector6 or matrix6.
    required : bool
        Must every entry have it?
    minimum, maximum : float or None
        Least and largest number, in the unit of the file.
    above_minimum : bool
        Is the minimum itself excluded?
    far_maximum : bool
        Is the maximum far from all sense, of interest to nobody else?
    choices : tuple of str
        The words that are allowed; empty: any. Of numbers those that may stand instead.
    default : str
        Value where it is not given, as TOML (which is JSON as well); "" for none.
    """

    name: str
    unit: str
    doc: str
    kind: str
    required: bool
    minimum: float | None
    maximum: float | None
    above_minimum: bool
    far_maximum: bool
    choices: tuple[str, ...]
    default: str

    @property
    def kind_text(self) -> str:
        """What the value is, in words."""
        return _KINDS[self.kind] + (" or text" if self.is_number and self.choices else "")

    @property
    def is_number(self) -> bool:
        """Is the value one or more numbers? Then `choices` are words that may stand instead."""
        return self.kind not in ("truth", "word", "words")

    @property
    def allowed(self) -> str:
        """Range or words of the value: "> 0", "0 to 1", "mean, yaw, body"; "" for any."""
        if self.choices and not self.is_number:
            return ", ".join(self.choices)
        high = None if self.far_maximum else self.maximum
        if self.minimum is not None and high is not None and not self.above_minimum:
            return f"{self.minimum:g} to {high:g}"
        parts = []
        if self.minimum is not None:
            parts.append(f"{'>' if self.above_minimum else '>='} {self.minimum:g}")
        if high is not None:
            parts.append(f"<= {high:g}")
        return " or ".join([", ".join(parts), *self.choices])


@dataclass(frozen=True)
class Table:
    """A table of a case file, a table inside one, or one type of entry of a list.

    Attributes
    ----------
    name : str
        Name of the table, or the word of its key `type`.
    doc : str
        Meaning.
    is_list : bool
        Written ``[[name]]`` rather than ``[name]``?
    required : bool
        Must every case have it?
    keys : tuple of Key
        Of a list with types those that all of them have.
    nested : tuple of Table
        Tables inside it, such as `initial`.
    types : tuple of Table
        Each with all its keys; empty where all entries are of one kind.
    """

    name: str
    doc: str
    is_list: bool
    required: bool
    keys: tuple[Key, ...]
    nested: tuple[Table, ...]
    types: tuple[Table, ...]

    @property
    def header(self) -> str:
        """How it is written: ``[solver]``, ``[[body]]``."""
        return f"[[{self.name}]]" if self.is_list else f"[{self.name}]"

    @property
    def key_names(self) -> list[str]:
        """Names of its keys and of the tables inside it."""
        return [key.name for key in self.keys] + [inner.name for inner in self.nested]

    def all_keys(self) -> Iterator[Key]:
        """Its keys, then those of the tables inside it by their dotted name."""
        yield from self.keys
        for inner in self.nested:
            for key in inner.all_keys():
                yield replace(key, name=f"{inner.name}.{key.name}")


@cache
def tables() -> tuple[Table, ...]:
    """Every table of a case file, in the order in which the kernel reads them."""
    from hydrodae import _core

    return tuple(map(_table, _core.tables()))


def find(name: str, type: str | None = None) -> Table:
    """Return the table `name`, or its `type`.

    Raises
    ------
    CaseError
        No table has this name; the message names the nearest one.
    """
    from hydrodae import _core

    named = {table.name: table for table in tables()}
    if name not in named:
        owners = " and ".join(owner.header for owner in owners_of(name))
        hint = f"; it is a type of {owners}" if owners else _core.suggestion(name, list(named))
        raise CaseError(f"there is no table {name!r}{hint}")
    if type is None:
        return named[name]
    types = {kind.name: kind for kind in named[name].types}
    if not types:
        raise CaseError(f"{named[name].header} has no types")
    if type not in types:
        hint = _core.suggestion(type, list(types))
        raise CaseError(f"{named[name].header} has no type {type!r}{hint}")
    return types[type]


def unit_of(key: str) -> str:
    """Unit of a dotted key of a case, "m" of "wave.sea.significant_height".

    "-" where it has none, or where types of the table have the key in different units; empty where
    there is no such key.
    """
    name, _, rest = key.partition(".")
    table = next((table for table in tables() if table.name == name), None)
    last = rest.rpartition(".")[2].partition("[")[0]
    if table is None:
        return ""
    kinds = [table, *table.types]
    found = {k.unit for kind in kinds for k in kind.all_keys() if k.name.split(".")[-1] == last}
    return found.pop() if len(found) == 1 else "-" if found else ""


def owners_of(type: str) -> list[Table]:
    """Return the lists whose entries may have this type."""
    return [table for table in tables() if any(kind.name == type for kind in table.types)]


def _table(data: Mapping[str, Any]) -> Table:
    return Table(
        data["name"],
        data["doc"],
        data["list"],
        data["required"],
        tuple(map(_key, data["fields"])),
        tuple(map(_table, data["nested"])),
        tuple(map(_table, data["types"])),
    )


def _key(data: Mapping[str, Any]) -> Key:
    return Key(
        data["key"],
        data["unit"],
        data["doc"],
        data["kind"],
        data["required"],
        data["minimum"],
        data["maximum"],
        data["above_minimum"],
        data["far_maximum"],
        tuple(data["choices"]),
        data["default"],
    )
