"""Inputs of OpenFAST's HydroDyn, which name the tables of WAMIT that they use."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path, PureWindowsPath

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.text import NUMBER, number, read_text

#: No input is longer [bytes].
LARGEST = 2_000_000
#: An input stands in one of so many folders, from that of the tables up [-].
FOLDERS = 3
_VALUE = r"^\s*({number})\s+{key}\b"


@dataclass(frozen=True)
class Input:
    """An input: what its PotMod is, the tables of its PotFile, and what it takes these for.

    Attributes
    ----------
    mode : int or None
    files : list of str
        Names of tables without suffix, one of each body.
    rho, depth, length : float or None
        Density, water depth and length scale of the tables [kg/m3, m, m].
    """

    mode: int | None
    files: list[str]
    rho: float | None
    depth: float | None
    length: float | None


def read_input(path: Path) -> Input | None:
    """Read an input of HydroDyn, whose lines are `value KEY - what it means`; None of other files.

    DEFAULT stands where another input says it.
    """
    if not path.is_file() or path.suffix.lower() != ".dat" or path.stat().st_size > LARGEST:
        return None
    text = read_text(path)
    line = re.search(r"^(.*?)\s+PotFile\b", text, re.MULTILINE)
    if line is None:
        return None

    def value(key: str) -> float | None:
        found = re.search(_VALUE.format(number=NUMBER, key=key), text, re.MULTILINE | re.IGNORECASE)
        return None if found is None else number(found[1])

    files = re.findall(r'"([^"]*)"', line[1]) or [line[1].strip()]
    mode = re.search(_VALUE.format(number=r"\d+", key="PotMod"), text, re.MULTILINE)
    return Input(
        None if mode is None else int(mode[1]),
        files,
        value("WtrDens"),
        value("WtrDpth"),
        value("WAMITULEN"),
    )


def tables_of(path: Path) -> Path | None:
    """Return the tables, `.1`, that an input of HydroDyn names; None if a file is no such input.

    Raises
    ------
    DatabaseError
        It uses no tables, names several, or they are not there.
    """
    read = read_input(path)
    if read is None:
        return None
    if read.mode is not None and read.mode != 1:
        raise DatabaseError(
            f"an input of HydroDyn with PotMod {read.mode}: it uses no tables of WAMIT; name a run "
            f"of a boundary-element code, or compute one with hdb compute"
        ).about("missing", "tables", file=path)
    names = dict.fromkeys(read.files)
    stems = [path.parent.joinpath(*PureWindowsPath(name).parts) for name in names]
    if len(stems) != 1:
        listed = ", ".join(f"{stem}.1" for stem in stems)
        raise DatabaseError(
            f"an input of HydroDyn that names {len(stems)} tables, of a body each: import {listed} "
            f"one by one"
        ).about("ambiguous", file=path)
    tables = stems[0].parent / f"{stems[0].name}.1"
    if not tables.is_file():
        raise DatabaseError(
            f"an input of HydroDyn, whose PotFile {read.files[0]!r} is not there: put "
            f"{tables.name}, .3 and .hst into {tables.parent}, or name the tables themselves"
        ).about("missing", "PotFile", file=path)
    return tables


def input_of(stem: Path) -> tuple[Path, Input] | None:
    """Return the input that uses the tables of one body, in their folder or above.

    Several that differ in what they take the tables for say nothing.
    """
    for folder in (stem.parent, *stem.parent.parents[: FOLDERS - 1]):
        found = {p: r for p in sorted(folder.glob("*.dat")) if (r := read_input(p)) is not None}
        found = {p: r for p, r in found.items() if _uses(r, stem)}
        if found:
            path, first = next(iter(found.items()))
            meant = {(r.rho, r.depth, r.length) for r in found.values()}
            return (path, first) if len(meant) == 1 else None
    return None


def _uses(read: Input, stem: Path) -> bool:
    target = PureWindowsPath(read.files[0])
    above = target.parent.name.lower()
    if len(read.files) != 1 or target.name.lower() != stem.name.lower():
        return False
    return above in ("", stem.parent.name.lower())
