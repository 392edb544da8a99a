"""The command `hydrodae keys`."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import rich.table

    from hydrodae.case.tables import Key, Table


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument("table", metavar="TABLE", nargs="?", help="solver, body, joint, ...")
    parser.add_argument("type", metavar="TYPE", nargs="?", help="revolute, pto_linear, ...")


def run(arguments: argparse.Namespace) -> int:
    """Print tables, types or keys; returns 0."""
    from rich.console import Console

    from hydrodae.case.tables import find, tables

    class Output(Console):
        def on_broken_pipe(self) -> None:
            raise BrokenPipeError  # which is no failure, as in other commands

    console = Output(highlight=False, markup=False)
    if arguments.table is None:
        console.print(_tables(tables()))
        return 0
    table = find(arguments.table, arguments.type)
    header = find(arguments.table).header
    kind = f' type = "{arguments.type}"' if arguments.type else ""
    console.print(f"{header}{kind}: {table.doc}")
    if table.types:
        console.print(_types(table))
        console.print(f"keys of every type (of one: hydrodae keys {table.name} TYPE)")
    console.print(_keys(table.all_keys()))
    return 0


def _grid(*columns: str) -> rich.table.Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    for name in columns:
        table.add_column(name, overflow="fold", no_wrap=name in ("key", "table", "type"))
    return table


def _tables(tables: Iterable[Table]) -> rich.table.Table:
    grid = _grid("table", "meaning")
    for table in tables:
        types = ", ".join(kind.name for kind in table.types)
        grid.add_row(table.header, table.doc + (f" Types: {types}." if types else ""))
    return grid


def _types(table: Table) -> rich.table.Table:
    grid = _grid("type", "meaning")
    for kind in table.types:
        grid.add_row(kind.name, kind.doc)
    return grid


def _keys(keys: Iterable[Key]) -> rich.table.Table:
    grid = _grid("key", "unit", "default", "allowed", "meaning")
    for key in keys:
        default = "required" if key.required else key.default or "-"
        grid.add_row(key.name, key.unit, default, key.allowed or key.kind_text, key.doc)
    return grid
