"""Files of tests: records and parameters of a calibration in TOML."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hydrodae.errors import CaseError
from hydrodae.study.calibrate.parameters import Free
from hydrodae.study.calibrate.records import Record, read_record
from hydrodae.study.sweep.points import is_number, known, read_file

RECORD = (
    "name", "file", "time", "channels", "from", "to", "offset", "offset_bounds", "set", "level",
    "noise", "fitted",
)  # fmt: skip
PARAMETER = ("keys", "bounds", "scale", "start")


def read_tests(path: str | os.PathLike[str]) -> tuple[list[Record], list[Free]]:
    """Read [[record]] and [parameter.NAME] of a file of tests (docs/calibrate.md).

    Raises
    ------
    CaseError
        Something in it is wrong; the message shows what and where.
    """
    file = Path(path)
    _, given = read_file(file)
    known(file, "", given, ("record", "parameter"))
    records, parameters = given.get("record", []), given.get("parameter", {})
    if not isinstance(records, list) or not records:
        raise CaseError(f"{file}: expected tables [[record]]")
    if not isinstance(parameters, dict):
        raise CaseError(f"{file}: expected tables [parameter.NAME]")
    return (
        [_record(file, table) for table in records],
        [_parameter(file, name, table) for name, table in parameters.items()],
    )


def _parameter(file: Path, name: str, table: Any) -> Free:
    where = f"parameter.{name}"
    known(file, where, table, PARAMETER)
    keys = table.get("keys")
    keys = [keys] if isinstance(keys, str) else keys
    if not isinstance(keys, list) or not keys or not all(isinstance(key, str) for key in keys):
        raise CaseError(f"{file}: [{where}]: key 'keys': expected keys of the case")
    options: dict[str, Any] = {}
    if "bounds" in table:
        options["bounds"] = _pair(file, where, table, "bounds")
    for key in ("scale", "start"):
        if key in table:
            options[key] = _number(file, where, table, key)
    return Free(keys, name=name, **options)


def _record(file: Path, table: Any) -> Record:
    known(file, "[record]", table, RECORD)
    where = "[record]"
    for key in ("file", "name", "time"):
        if not isinstance(table.get(key, ""), str):
            raise CaseError(f"{file}: [{where}]: key {key!r}: expected a text")
    if "file" not in table:
        raise CaseError(f"{file}: [{where}]: key 'file': the path of a record is needed")
    channels = table.get("channels")
    if not isinstance(channels, dict) or not all(isinstance(c, str) for c in channels.values()):
        raise CaseError(
            f'{file}: [{where}]: key \'channels\': expected {{ "CHANNEL" = "COLUMN:UNIT" }}'
        )
    options: dict[str, Any] = {}
    for key, argument in (("from", "start"), ("to", "end"), ("offset", "offset")):
        if key in table:
            options[argument] = _number(file, where, table, key)
    if "offset_bounds" in table:
        options["offset_bounds"] = _pair(file, where, table, "offset_bounds")
    for key in ("level", "fitted"):
        if key in table:
            if not isinstance(table[key], bool):
                raise CaseError(f"{file}: [{where}]: key {key!r}: expected true or false")
            options[key] = table[key]
    for key in ("set", "noise"):
        if key in table:
            if not isinstance(table[key], dict):
                raise CaseError(f"{file}: [{where}]: key {key!r}: expected a table")
            options[key] = table[key]
    if not all(map(is_number, options.get("noise", {}).values())):
        raise CaseError(f"{file}: [{where}]: key 'noise': expected numbers in SI units")
    return read_record(
        file.parent / table["file"], channels, name=table.get("name", ""),
        time=table.get("time", ""), **options,
    )  # fmt: skip


def _number(file: Path, where: str, table: Mapping[str, Any], key: str) -> float:
    if not is_number(table[key]):
        raise CaseError(f"{file}: [{where}]: key {key!r}: expected a number, got {table[key]!r}")
    return float(table[key])


def _pair(file: Path, where: str, table: Mapping[str, Any], key: str) -> tuple[float, float]:
    pair = table[key]
    if not isinstance(pair, list) or len(pair) != 2 or not all(map(is_number, pair)):
        raise CaseError(f"{file}: [{where}]: key {key!r}: expected [least, most], got {pair!r}")
    return float(pair[0]), float(pair[1])
