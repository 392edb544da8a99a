"""Inputs of OpenFAST's HydroDyn, which name the tables of WAMIT that they use."""

from __future__ import annotations

import re
from pathlib import Path, PureWindowsPath

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.text import read_text

#: No input is longer [bytes].
LARGEST = 2_000_000


def tables_of(path: Path) -> Path | None:
    """Return the tables, `.1`, that an input of HydroDyn names; None if a file is no such input.

    Raises
    ------
    DatabaseError
        It uses no tables, names several, or they are not there.
    """
    if path.suffix.lower() != ".dat" or path.stat().st_size > LARGEST:
        return None
    text = read_text(path)
    line = re.search(r"^(.*?)\s+PotFile\b", text, re.MULTILINE)
    if line is None:
        return None
    mode = re.search(r"^\s*(\d+)\s+PotMod\b", text, re.MULTILINE)
    if mode is not None and int(mode[1]) != 1:
        raise DatabaseError(
            f"an input of HydroDyn with PotMod {mode[1]}: it uses no tables of WAMIT; name a run "
            f"of a boundary-element code, or compute one with hdb compute"
        ).about("missing", "tables", file=path)
    names = re.findall(r'"([^"]*)"', line[1]) or [line[1].strip()]
    stems = [path.parent.joinpath(*PureWindowsPath(name).parts) for name in dict.fromkeys(names)]
    if len(stems) != 1:
        listed = ", ".join(f"{stem}.1" for stem in stems)
        raise DatabaseError(
            f"an input of HydroDyn that names {len(stems)} tables, of a body each: import {listed} "
            f"one by one"
        ).about("ambiguous", file=path)
    tables = stems[0].parent / f"{stems[0].name}.1"
    if not tables.is_file():
        raise DatabaseError(
            f"an input of HydroDyn, whose PotFile {names[0]!r} is not there: put {tables.name}, "
            f".3 and .hst into {tables.parent}, or name the tables themselves"
        ).about("missing", "PotFile", file=path)
    return tables
