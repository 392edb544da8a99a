"""The command of the attack suite: `python -m tests.attack`."""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

from tests.attack import suite
from tests.stability import Cell, run_cell, show
from tests.stability.grid import PASS, REFUSED, STOPPED, WRONG

RANK = {WRONG: 0, STOPPED: 1, REFUSED: 2, PASS: 3}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the suite; returns 1 if a cell is wrong, else 0."""
    options = _options(arguments)
    first, count = options.draw or (0, 0)
    scenes = suite.all_scenes(tuple(range(first, first + count)))
    names = [n for n in scenes if any(fnmatchcase(n, p) for p in options.scenes)]
    columns = [c for c in suite.columns() if any(fnmatchcase(c, p) for p in options.methods)]
    if options.list:
        for name in names:
            print(f"{suite.kind_of(name):24} {name:22} {scenes[name].title}")
        print(f"{len(names)} scenes; methods: " + " ".join(columns))
        return 0
    if not names or not columns:
        print("no scene or no method of that name; --list tells them", file=sys.stderr)
        return 2
    jobs = [(name, columns, options.seed, options.draw, options.time_limit) for name in names]
    cells: list[Cell] = []
    with ProcessPoolExecutor(options.jobs) as pool:
        for made in pool.map(_row, jobs):
            cells += made
            print(
                f"{made[0].scene:22} " + "  ".join(f"{suite.label(c):>11}" for c in made),
                flush=True,
            )
            if options.json:  # after every scene, so that a run that is cut leaves what it has
                _write(cells, options.json)
    _report(cells, options)
    return int(any(cell.outcome == WRONG for cell in cells))


def _options(arguments: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.attack", description=__doc__)
    parser.add_argument("scenes", nargs="*", default=["*"], help="patterns of names (default: all)")
    parser.add_argument("--methods", nargs="+", default=["*"], metavar="NAME", help="patterns")
    parser.add_argument("--seed", type=int, default=1, help="of the tolerances and steps (1)")
    parser.add_argument(
        "--draw",
        type=int,
        nargs=2,
        metavar=("FIRST", "COUNT"),
        help="draw COUNT new scenes of each family, from seed FIRST",
    )
    parser.add_argument(
        "--time-limit", type=float, default=10.0, metavar="S", help="CPU time of a run [s] (10)"
    )
    parser.add_argument("--jobs", type=int, default=1, help="processes (1)")
    parser.add_argument("--list", action="store_true", help="list scenes and methods, run nothing")
    parser.add_argument("--json", metavar="FILE", help="write cells and figures")
    parser.add_argument("--picture", metavar="FILE", help="draw the map (PNG, SVG, PDF)")
    return parser.parse_args(arguments)


def _row(job: tuple[str, list[str], int, list[int] | None, float]) -> list[Cell]:
    name, columns, seed, draw, limit = job
    seeds = range(draw[0], draw[0] + draw[1]) if draw else ()
    scene = suite.all_scenes(tuple(seeds))[name]
    cells = []
    with tempfile.TemporaryDirectory(prefix="hydrodae-attack-") as folder:
        for method in suite.methods_of(scene, columns, seed):
            cell = run_cell(scene, method, Path(folder), limit)
            cells.append(suite.short(cell, suite.described(scene, method)))
    return cells


def _report(cells: Sequence[Cell], options: argparse.Namespace) -> None:
    print()
    for cell in sorted(cells, key=lambda c: (RANK[c.outcome], -(c.error or 0.0) / (c.size or 1.0))):
        plain = cell.outcome == PASS and cell.reason.endswith("]")
        if not plain:
            print(f"{cell.outcome:8} {cell.scene}, {cell.method} {cell.reason}")
    print()
    print(show.legend(cells))
    figures = suite.figures(cells)
    print(
        f"{figures['wrong']:.0f} wrong; {100 * figures['default_share']:.1f} % of "
        f"{figures['default_runs']:.0f} default runs of scenes that some method passes pass; "
        "true error a tenth to ten times the estimate in "
        f"{100 * figures['within_share']:.1f} % of {figures['estimated']:.0f} runs with "
        "an estimate, beyond a hundred times in "
        f"{figures['far']:.0f}"
    )
    if options.picture:
        show.write_picture(cells, options.picture, panels=4, text=suite.label)


def _write(cells: Sequence[Cell], path: str) -> None:
    document: dict[str, Any] = dict(figures=suite.figures(cells), cells=[_record(c) for c in cells])
    Path(path).write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def _record(cell: Cell) -> dict[str, Any]:
    return (
        asdict(cell) | cell.record() | dict(kind=suite.kind_of(cell.scene), ratio=suite.ratio(cell))
    )


if __name__ == "__main__":
    sys.exit(main())
