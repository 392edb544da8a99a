"""The command of the stability map: `python -m tests.stability`.

A cell shows the error of a run that passed, or that it stopped, was refused (-), or returned
success with a wrong motion. Exit code 1 if one did.
"""

from __future__ import annotations

import argparse
import difflib
import sys
from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from tests.stability import grid, show

from hydrodae.commands.cli import guarded
from hydrodae.errors import CaseError


def main(arguments: Sequence[str] | None = None) -> int:
    """Make the map that the arguments ask for; returns 1 if a cell is wrong, else 0."""
    return guarded(lambda: _run(_options(arguments)))


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.stability", description=__doc__)
    parser.add_argument(
        "--scenes", metavar="NAME", nargs="+", help="rows (default: all; see --list)"
    )
    parser.add_argument("--methods", metavar="NAME", nargs="+", help="columns (default: all)")
    parser.add_argument("--list", action="store_true", help="list scenes and methods, run nothing")
    parser.add_argument(
        "--time-limit", metavar="S", type=float, default=5.0, help="CPU time of a run [s] (5)"
    )
    parser.add_argument("--json", metavar="FILE", help="write the cells")
    parser.add_argument("--picture", metavar="FILE", help="draw the map (PNG, SVG, PDF)")
    return parser.parse_args(arguments)


def _run(arguments: argparse.Namespace) -> int:
    scenes, methods = grid.all_scenes(), grid.all_methods()
    console = Console(emoji=False)
    if arguments.list:
        for name, scene in scenes.items():
            console.print(f"{name:16} {scene.title}", markup=False, highlight=False)
        console.print("methods: " + " ".join(methods), markup=False, highlight=False)
        return 0
    rows = _chosen(arguments.scenes, scenes, "scene")
    columns = _chosen(arguments.methods, methods, "method")
    with console.status("") as status:
        cells = grid.stability_map(
            rows,
            columns,
            time_limit=arguments.time_limit,
            report=lambda cell: status.update(f"{cell.scene}, {cell.method}: {cell.outcome}"),
        )
    for shown in show.tables(cells, console.width):
        console.print(shown)
    for line in show.reasons(cells):
        console.print("  " + line, markup=False, highlight=False, soft_wrap=True)
    if arguments.json:
        show.write_json(cells, arguments.json)
    if arguments.picture:
        show.write_picture(cells, arguments.picture)
    return int(any(cell.outcome == grid.WRONG for cell in cells))


def _chosen(
    names: Sequence[str] | None, items: Mapping[str, Any], kind: str
) -> list[Any]:  # of what `items` holds
    if names is None:
        return list(items.values())
    for name in names:
        if name not in items:
            near = difflib.get_close_matches(name, items, n=1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise CaseError(f"there is no {kind} {name!r}{hint}; --list prints all")
    return [items[name] for name in names]


if __name__ == "__main__":
    sys.exit(main())
