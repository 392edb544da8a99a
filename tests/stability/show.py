"""The map as a table, a picture and a JSON document."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from tests.stability.grid import PASS, REFUSED, STOPPED, WRONG, Cell

from hydrodae.support import outputs

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from rich.table import Table

STYLES = {PASS: "green", STOPPED: "yellow", REFUSED: "bright_black", WRONG: "bold white on red"}
COLOURS = {PASS: "#8fca8f", STOPPED: "#f3d27a", REFUSED: "#d5d5d5", WRONG: "#d9534f"}


def _names(cells: Sequence[Cell]) -> tuple[list[str], list[str]]:
    scenes = list(dict.fromkeys(cell.scene for cell in cells))
    return scenes, list(dict.fromkeys(cell.method for cell in cells))


def label(cell: Cell) -> str:
    """Return the few characters of a cell: its error if it passed, else its outcome."""
    if cell.outcome == PASS and cell.error is not None:
        return f"{cell.error:.0e}"
    if cell.outcome == STOPPED:
        return "limit" if cell.reason == "time limit" else "stops"
    if cell.outcome == WRONG and cell.error is not None:
        return f"WRONG {cell.error:.0e}"
    return {REFUSED: "-", WRONG: "WRONG"}.get(cell.outcome, cell.outcome)


def tables(cells: Sequence[Cell], width: int) -> list[Table]:
    """Return the map as tables of scenes down and methods across.

    Parameters
    ----------
    cells : sequence of Cell
    width : int
        Characters in a line of the terminal; methods that do not fit go to the next table.
    """
    from rich.table import Table
    from rich.text import Text

    scenes, methods = _names(cells)
    found = {(cell.scene, cell.method): cell for cell in cells}

    def heading(method: str) -> str:
        return method.replace(":", "\n").replace("_", "\n")

    def room(method: str) -> int:
        texts = [label(cell) for cell in cells if cell.method == method]
        return max(map(len, [*heading(method).splitlines(), *texts])) + 3

    names = max((len(scene) for scene in scenes), default=0) + 4
    blocks: list[list[str]] = []
    left = 0
    for method in methods:
        if not blocks or room(method) > left:
            blocks.append([])
            left = width - names
        blocks[-1].append(method)
        left -= room(method)
    made = []
    for block in blocks:
        shown = Table()
        shown.add_column("scene", no_wrap=True)
        for method in block:
            shown.add_column(heading(method), justify="right", no_wrap=True)
        for scene in scenes:
            row = [found.get((scene, method)) for method in block]
            shown.add_row(
                scene, *(Text(label(c), style=STYLES[c.outcome]) if c else Text() for c in row)
            )
        made.append(shown)
    made[0].title = "Methods against hard scenes"
    made[-1].caption = legend(cells)
    return made


def legend(cells: Sequence[Cell]) -> str:
    """Return how many cells there are of each outcome."""
    counts = {name: sum(cell.outcome == name for cell in cells) for name in STYLES}
    return ", ".join(f"{count} {name}" for name, count in counts.items())


def reasons(cells: Sequence[Cell]) -> list[str]:
    """Return one line for each cell that is neither a plain pass nor a time limit."""
    quiet = ("", "time limit")
    return [
        f"{c.scene}, {c.method}: "
        + ("" if c.reason.startswith(c.outcome) else f"{c.outcome}: ")
        + c.reason
        for c in cells
        if c.reason not in quiet
    ]


def write_json(cells: Sequence[Cell], path: str | Path) -> None:
    """Write the cells as JSON."""
    document = {"cells": [cell.record() for cell in cells]}
    text = json.dumps(document, indent=1, allow_nan=False) + "\n"
    outputs.write_text(outputs.claim(path, outputs.JSON), text)


def write_picture(
    cells: Sequence[Cell], path: str | Path, *, panels: int = 1, text: Callable[[Cell], str] = label
) -> None:
    """Draw the map as a coloured grid.

    Parameters
    ----------
    cells : sequence of Cell
    path : path
    panels : int
        Grids side by side among which the scenes are shared out.
    text : callable
        What a cell says.
    """
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch

    scenes, methods = _names(cells)
    panels = max(1, min(panels, len(scenes)))
    rows = -(-len(scenes) // panels)
    figure = Figure(
        figsize=(panels * (2.0 + 0.62 * len(methods)), 1.9 + 0.34 * rows), layout="constrained"
    )
    grids = figure.subplots(1, panels, squeeze=False)[0]
    for k, axes in enumerate(grids):
        _draw_grid(axes, cells, scenes[k * rows : (k + 1) * rows], methods, rows, text)
    figure.legend(
        handles=[Patch(color=colour, label=name) for name, colour in COLOURS.items()],
        loc="outside lower center", ncols=4, frameon=False,
    )  # fmt: skip
    figure.savefig(outputs.claim(path, outputs.PICTURE), dpi=150 if panels == 1 else 80)


def _draw_grid(
    axes: Axes,
    cells: Sequence[Cell],
    scenes: Sequence[str],
    methods: Sequence[str],
    rows: int,
    text: Callable[[Cell], str],
) -> None:
    """Draw the cells of some scenes; `rows` high, so that all grids have the same scale."""
    from matplotlib.patches import Rectangle

    for cell in cells:
        if cell.scene not in scenes:
            continue
        x, y = methods.index(cell.method), scenes.index(cell.scene)
        box = Rectangle((x, y), 1, 1, facecolor=COLOURS[cell.outcome], edgecolor="white")
        axes.add_patch(box)
        axes.text(x + 0.5, y + 0.5, text(cell).replace(" ", "\n"), ha="center", va="center",
                  fontsize=6.5)  # fmt: skip
    axes.set(xlim=(0, len(methods)), ylim=(rows, 0))
    axes.set_xticks([i + 0.5 for i in range(len(methods))], methods, rotation=45, ha="left")
    axes.set_yticks([i + 0.5 for i in range(len(scenes))], scenes)
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
