"""What a chart looks like: the table, the picture, and the file with everything."""

from __future__ import annotations

import json
import os
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib
from matplotlib.figure import Figure
from rich.table import Table

from hydrodae.pictures.plot import COLORS, STYLE
from hydrodae.study.chart.records import Chart, Run
from hydrodae.support import outputs

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MARKERS = "osD^vP*Xh<>p"


def write_json(chart: Chart, path: str | os.PathLike[str]) -> Path:
    """Write all values of the chart, with the machine and the Pareto front.

    Parameters
    ----------
    chart : Chart
    path : path
        Replaced if it exists.

    Returns
    -------
    Path
    """
    path = outputs.claim(path, outputs.JSON)
    front = chart.front()
    document = {"format": "hydrodae-chart", "format_version": 1, **asdict(chart)}
    document["runs"] = [{**asdict(run), "on_front": run in front} for run in chart.runs]
    outputs.write_text(path, json.dumps(document, indent=1, default=str) + "\n")
    return path


def table(chart: Chart) -> Table:
    """One line a run, by method; a star marks the Pareto front."""
    out = Table(show_edge=False, pad_edge=False)
    out.add_column("method", no_wrap=True)
    for heading in ("rtol or step", "error", "solver", "steps"):
        out.add_column(heading, justify="right", no_wrap=True)
    out.add_column("outcome", overflow="fold")
    front = chart.front()
    for method in chart.methods():
        runs = [run for run in chart.runs if run.method == method]
        for run in runs:
            failed = "" if run.outcome == "ok" else f"{run.outcome} at t = {run.reached:.3g} s"
            out.add_row(
                method if run is runs[0] else "",
                _setting(run),
                "-" if run.error is None else f"{run.error:.1e}",
                "-" if run.time is None else f"{1e3 * run.time:.1f} ms",
                str(int(run.statistics["steps"])) if "steps" in run.statistics else "-",
                failed or ("ok *" if run in front else "ok"),
                end_section=run is runs[-1],
            )
    return out


def heading(chart: Chart) -> str:
    """Lines above the table: what was run, what the error is, what it is measured against."""
    shown = ", ".join(chart.channels[:4]) or "none"
    more = f" and {len(chart.channels) - 4} more" if len(chart.channels) > 4 else ""
    lines = [
        f"{chart.title}, {chart.end_time:g} s on one core of {chart.machine['processor']}",
        f"  channels: {shown}{more}",
        "  error: largest difference over time and channels, relative to the largest excursion",
    ]
    if not chart.references:
        return "\n".join([*lines, "  no reference: no tight run came to the end of the case"])
    if len(chart.references) == 1:
        return "\n".join([*lines, f"  reference: {chart.references[0]}; nothing else checks it"])
    first, second = chart.references
    lines += [
        f"  reference: {first}; where that is the method itself, {second}",
        f"  the two differ by {chart.agreement:.1e}: smaller errors mean nothing",
    ]
    return "\n".join(lines)


def footing(chart: Chart) -> str:
    """Lines below the table: the star, and the first reason of each kind of failure."""
    lines = ["* Pareto front: no other run is both faster and more exact"] if chart.front() else []
    kinds: dict[str, Run] = {}
    for run in chart.runs:
        if run.outcome != "ok":
            kinds.setdefault(run.outcome, run)
    lines += [
        f"{name}: first {run.method} at {run.knob} {run.setting:.3g}, {run.reason}"
        for name, run in kinds.items()
    ]
    return "\n".join(lines)


@matplotlib.rc_context(STYLE)
def draw(chart: Chart) -> Figure:
    """Error against solver time, one line a method, failures as crosses at the right margin."""
    figure = Figure(figsize=(8.0, 4.8), layout="constrained")
    axes = figure.subplots()
    failures: list[tuple[str, list[Run]]] = []
    for i, method in enumerate(chart.methods()):
        runs = [run for run in chart.runs if run.method == method]
        good = [run for run in runs if run.measured and (run.error or 0.0) > 0]
        bad = [run for run in runs if run.outcome != "ok"]
        label = method
        if bad:
            failures.append((COLORS[i % len(COLORS)], bad))
            kinds = Counter(run.outcome for run in bad)
            label += "".join(f"\n  \N{MULTIPLICATION SIGN} {n} {k}" for k, n in kinds.items())
        axes.plot(
            [1e3 * (run.time or 0.0) for run in good],
            [run.error or 0.0 for run in good],
            marker=_MARKERS[i % len(_MARKERS)],
            markersize=4,
            color=COLORS[i % len(COLORS)],
            label=label,
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    _draw_front(axes, chart)
    if chart.agreement:
        axes.axhspan(0, chart.agreement, color="#F0F0F0", zorder=0, label="references differ")
    _draw_failures(axes, failures)
    axes.set_title(f"{chart.title}, {chart.end_time:g} s")
    axes.set_xlabel("solver time [ms]")
    axes.set_ylabel("error, relative to the largest excursion [-]")
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), borderaxespad=0.0)
    return figure


def _draw_front(axes: Axes, chart: Chart) -> None:
    front = [run for run in chart.front() if (run.error or 0.0) > 0]
    axes.plot(
        [1e3 * (run.time or 0.0) for run in front],
        [run.error or 0.0 for run in front],
        drawstyle="steps-post",
        color="#AAAAAA",
        linewidth=3.5,
        alpha=0.6,
        zorder=1,
        label="Pareto front",
    )


def _draw_failures(axes: Axes, failures: list[tuple[str, list[Run]]]) -> None:
    """One cross a failed run at the right margin, a row a method."""
    for row, (color, bad) in enumerate(failures):
        for column, run in enumerate(reversed(bad)):
            axes.plot(
                0.985 - 0.02 * column,
                0.97 - 0.04 * row,
                "x",
                color=color,
                markersize=6,
                markeredgewidth=1.6,
                transform=axes.transAxes,
                gid=f"failed {run.method} {run.setting:g}",
            )


def _setting(run: Run) -> str:
    return f"{run.setting:.0e}" if run.knob == "rtol" else f"{1e3 * run.setting:.3g} ms"
