"""The command `hydrodae record`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from hydrodae.errors import CaseError

if TYPE_CHECKING:
    from hydrodae.records import Table

#: Notes and the keys of the wave systems.
Found: TypeAlias = tuple[list[str], list[dict[str, Any]]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("file", metavar="FILE", help="record (.mat, .csv, .txt, HDF5)")
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="elevation: the record of the case, .csv"
    )
    parser.add_argument(
        "--kind",
        choices=tuple(KINDS),
        help="what the file holds (default: by the names of its columns)",
    )
    parser.add_argument(
        "--columns",
        metavar="NAME,...",
        help="names of all columns, units in brackets: 'time [s],eta [mm]'",
    )
    parser.add_argument("--column", metavar="COLUMN[:UNIT]", help="column of the elevation")
    parser.add_argument("--time", metavar="COLUMN[:UNIT]", help="column of the time")
    parser.add_argument(
        "--rate", metavar="HZ", type=float, help="samples a second, where there is no time"
    )
    parser.add_argument(
        "--heading", metavar="DEG", type=float, help="direction of travel, 0 = +x (default 0)"
    )
    parser.add_argument("--name", default="sea", help="name of the wave system (default sea)")
    parser.add_argument(
        "--list", action="store_true", help="list the columns with their ranges, and do no more"
    )


def run(arguments: argparse.Namespace) -> int:
    """Read a record and print its [[wave]] tables; returns 0."""
    from hydrodae.records import read_table

    names = None
    if arguments.columns:
        names = [name.strip() for name in arguments.columns.split(",")]
    table = read_table(arguments.file, names)
    if arguments.list:
        _list(table)
        return 0
    kind = arguments.kind or _kind_of(table)
    _refuse_idle(arguments, kind)
    _print(*KINDS[kind].read(arguments, table))
    return 0


def _kind_of(table: Table) -> str:
    from hydrodae.records.quantities import find
    from hydrodae.records.units import is_density

    if find(table, "phase") is not None:
        return "components"
    timed, density = find(table, "time") is not None, find(table, "density")
    if not timed or density is not None:
        if find(table, "frequency") is not None or find(table, "omega") is not None:
            return "spectrum"
    # "T" is a period and a time: the unit of the density decides.
    if density is not None and find(table, "period") is not None:
        if not timed or is_density(table.names[density]):
            return "spectrum"
    if not table.named and not (table.values[:, -1] < 0.0).any():
        raise CaseError(
            f"{table.path}: names no columns, and its last column is never negative: give --kind "
            "elevation or --kind spectrum, or names of all columns by --columns"
        )
    return "elevation"


def _refuse_idle(arguments: argparse.Namespace, kind: str) -> None:
    """Refuse options that do nothing for what the file holds."""
    if KINDS[kind].writes:
        if arguments.output is None:
            raise CaseError(
                f"{arguments.file}: an elevation needs -o FILE.csv, which the case reads"
            )
        return
    for option in ("column", "time", "rate", "output"):
        if getattr(arguments, option) is not None:
            name = "-o" if option == "output" else f"--{option}"
            raise CaseError(f"{name}: is for an elevation, and {arguments.file} holds a {kind}")


def _of_elevation(arguments: argparse.Namespace, table: Table) -> Found:
    from hydrodae.records import read_elevation

    record = read_elevation(
        table, column=arguments.column or "", time=arguments.time or "", rate=arguments.rate
    )
    written = record.write(arguments.output)
    print(f"written: {written}", file=sys.stderr)
    notes = [
        f"{len(record.time)} samples over {record.length:g} s; significant height "
        f"{record.significant_height:.4g} m, mean {record.elevation.mean():.3g} m",
        *record.notes,
        "`file` is relative to the folder of the case. The run must end before the record.",
    ]
    keys = {
        "name": arguments.name,
        "type": "measured",
        "file": str(written),
        "heading_deg": arguments.heading or 0.0,
        "taper": min(30.0, float(f"{0.1 * record.length:.3g}")),
    }
    return notes, [keys]


def _of_spectrum(arguments: argparse.Namespace, table: Table) -> Found:
    from hydrodae.records import read_spectrum

    found = read_spectrum(table)
    if found.heading is not None and arguments.heading is not None:
        raise CaseError(f"--heading: {arguments.file} has directions of its own")
    waves = found.waves(arguments.name, arguments.heading or 0.0)
    notes = [
        f"significant height {found.significant_height:.4g} m, peak period "
        f"{found.peak_period:.4g} s, {len(waves)} direction{'s' if len(waves) > 1 else ''}",
        *found.notes,
    ]
    return notes, waves


def _of_components(arguments: argparse.Namespace, table: Table) -> Found:
    from hydrodae.records import read_components

    found = read_components(table, heading_deg=arguments.heading or 0.0)
    height = 4.0 * (0.5 * sum(one.amplitude**2 for one in found)) ** 0.5
    notes = [f"{len(found)} components; significant height {height:.4g} m", *table.notes]
    return notes, [one.wave(f"{arguments.name}_{k}") for k, one in enumerate(found, 1)]


@dataclass(frozen=True)
class Kind:
    """What a file may hold: how it becomes wave systems, and whether a file is written for them."""

    read: Callable[[argparse.Namespace, Table], Found]
    writes: bool = False


KINDS = {
    "elevation": Kind(_of_elevation, writes=True),
    "spectrum": Kind(_of_spectrum),
    "components": Kind(_of_components),
}


def _print(notes: list[str], waves: list[dict[str, Any]]) -> None:
    from hydrodae.case.case import to_toml

    lines = [f"# {line}" for line in notes]
    for keys in waves:
        lines += ["", "[[wave]]"]
        for key, value in keys.items():
            lines.append(f"{key} = {to_toml(_rounded(value), key)}")
    print("\n".join(lines))


def _rounded(value: Any) -> Any:
    """Ten digits of a number."""
    if isinstance(value, float):
        return float(f"{value:.10g}") + 0.0
    if hasattr(value, "tolist"):
        return [_rounded(item) for item in value.tolist()]
    return value


def _list(table: Table) -> None:
    for name, values in zip(table.names, table.values.T, strict=True):
        known = values[values == values]
        span = f"{known.min():g} to {known.max():g}" if len(known) else "empty"
        print(f"{name:44} {span}")
    for note in table.notes:
        print(f"note: {note}")
    print(f"{len(table.values)} rows in {Path(table.path).name}")
