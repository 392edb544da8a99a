"""Pictures of results: overview, channels, comparison with other codes' curves.

Angles are drawn in degrees, and only where the label has deg. Nothing here touches pyplot: a figure
belongs to the one who asked for it.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from hydrodae.errors import CaseError
from hydrodae.pictures.curve import Curve
from hydrodae.pictures.hulls import load_panels
from hydrodae.pictures.panels import (
    Line,
    Panel,
    gather,
    highest_frequency,
    most_moving,
    overview,
    scaled,
    select,
    spectra,
)
from hydrodae.support import outputs
from hydrodae.support.arrays import Array
from hydrodae.support.style import COLORS as COLORS
from hydrodae.support.style import STYLE as STYLE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from hydrodae.results import Results

#: Lines that differ by less, relative to their span, look alike in a picture.
_SAME = 0.005


def plot_overview(results: Results) -> Figure:
    """Draw the standard set of a run, one panel each, and spectra below where there are waves.

    Elevation, joint coordinates, motions of the bodies, absorbed powers with their means, loads of
    the power take-offs, reactions and tensions, energies, and the loads on each body with a mesh,
    load by load. The spectrum of the elevation has the
    target of the case beside it.

    Raises
    ------
    CaseError
        The results have none of these channels.
    """
    return _draw(results, [*overview(results), *load_panels(results), *spectra(results)])


def plot_channels(results: Results, names: Iterable[str]) -> Figure:
    """Draw channels by name or shell pattern; those of one quantity and unit share a panel.

    Parameters
    ----------
    results : Results
    names : iterable of str
        Such as "joints/*/angle", "bodies/base/position" or "bodies/base/position.z".

    Raises
    ------
    ChannelError
        There is no channel of that name.
    CaseError
        A component does not exist, or a pattern matches nothing.
    """
    lines = (line for name in names for line in select(results, name))
    return _draw(results, [scaled(panel) for panel in gather(lines)])


@matplotlib.rc_context(STYLE)
def plot_comparison(
    results: Results,
    channel: str,
    curves: Sequence[Curve],
    *,
    label: str = "hydrodae",
    end_time: float | None = None,
) -> Figure:
    """Draw one channel over the curves or marked points of others.

    Parameters
    ----------
    results : Results
    channel : str
        A scalar channel, or a component such as "bodies/base/position.z".
    curves : sequence of Curve
        In the unit of the axis: degrees for angles.
    label : str
        Name of our curve.
    end_time : float, s, optional
        Right end of the time axis; by default that of the results.
    """
    figure, (axes,) = new_figure(results, 1, row_height=3.6)
    draw_comparison(axes, results, channel, curves, label=label, end_time=end_time)
    return figure


def draw_comparison(
    axes: Axes,
    results: Results,
    channel: str,
    curves: Sequence[Curve],
    *,
    label: str = "hydrodae",
    end_time: float | None = None,
) -> None:
    """Draw the comparison of `plot_comparison` into given axes.

    Raises
    ------
    CaseError
        The channel is a vector, or a pattern of several channels.
    """
    lines = select(results, channel)
    if len(lines) != 1:
        raise CaseError(
            f"{channel} is {len(lines)} lines and only one can be compared; "
            "name one channel, or one component such as bodies/base/position.z"
        )
    end = results.end_time if end_time is None else end_time
    for i, curve in enumerate(curves):
        _draw_curve(axes, curve.until(end), COLORS[i % len(COLORS)])
    ours = Curve(label, results.time, lines[0].values).until(end)
    axes.plot(ours.time, ours.values, label=label, color="black", linewidth=1.8)
    axes.set_xlim(results.time[0], end)
    axes.set_ylabel(f"{lines[0].label} {lines[0].quantity} [{lines[0].unit}]")
    outside_legend(axes)


def new_figure(
    results: Results, rows: int, *, width: float = 8.0, row_height: float = 2.1, spectra: int = 0
) -> tuple[Figure, list[Axes]]:
    """Make a figure of `rows` panels over one time axis, titled after the run.

    Parameters
    ----------
    results : Results
    rows : int
    width, row_height : float, inch
    spectra : int
        So many of them, the last ones, are over frequency instead.

    Returns
    -------
    figure : matplotlib.figure.Figure
    axes : list of matplotlib.axes.Axes
    """
    figure = Figure(figsize=(width, rows * row_height + 0.6), layout="constrained")
    axes = list(figure.subplots(rows, 1, squeeze=False)[:, 0])
    for group in (axes[: rows - spectra], axes[rows - spectra :]):
        for other in group[:-1]:
            other.sharex(group[-1])
            other.tick_params(labelbottom=False)
    title = results.title
    if results.status != "completed":
        title += f" ({results.status} at t = {results.end_time:g} s)"
    axes[0].set_title(title)
    axes[-1].set_xlabel("angular frequency [rad/s]" if spectra else "time [s]")
    if spectra and rows > spectra:
        axes[rows - spectra - 1].set_xlabel("time [s]")
    return figure, axes


def save(figure: Figure, path: str | os.PathLike[str]) -> Path:
    """Write a figure; the ending of `path` says the format (png, pdf, svg, ...).

    Raises
    ------
    CaseError
        The ending is none that matplotlib can write, or a file of another kind is there.
    """
    path = Path(path)
    known = figure.canvas.get_supported_filetypes()
    if path.suffix[1:].lower() not in known:
        raise CaseError(f"{path}: no such kind of picture; known are {', '.join(sorted(known))}")
    with outputs.whole(outputs.claim(path, outputs.PICTURE)) as beside:
        figure.savefig(beside)
    return path


@matplotlib.rc_context(STYLE)
def _draw(results: Results, panels: list[Panel]) -> Figure:
    if not panels or not len(results.time):
        raise CaseError(f"{results.path}: there is nothing to draw")
    spectral = [panel for panel in panels if panel.omega is not None]
    figure, all_axes = new_figure(
        results, len(panels), row_height=2.1 if len(panels) < 6 else 1.7, spectra=len(spectral)
    )
    for axes, panel in zip(all_axes, map(most_moving, panels), strict=True):
        _draw_panel(axes, panel, results.time if panel.omega is None else panel.omega)
    if results.end_time > results.time[0]:
        all_axes[0].set_xlim(results.time[0], results.end_time)
    if spectral:
        all_axes[-1].set_xlim(0.0, 1.2 * highest_frequency(spectral))
    return figure


def _draw_panel(axes: Axes, panel: Panel, at: Array) -> None:
    for k, line in enumerate(panel.lines):
        below = sum(_falls_on(line, other) for other in panel.lines[:k])
        style = (0.0, (5.0, 5.0 * below)) if below else "-"
        (drawn,) = axes.plot(at, line.values, label=line.label, linestyle=style)
        if line.level is not None:
            axes.axhline(line.level, color=drawn.get_color(), linestyle="--", linewidth=1.0)
    if panel.target is not None:
        axes.plot(*panel.target, label=panel.note, color="black", linestyle="--", linewidth=1.0)
    axes.set_ylabel(panel.label)
    if panel.decades:
        axes.set_yscale("log")
    if panel.omega is not None:
        axes.set_ylim(bottom=0.0)
    if [line.label for line in panel.lines] != [panel.quantity.partition("\n")[0]]:
        outside_legend(axes, "" if panel.target is not None else panel.note)


def _falls_on(line: Line, other: Line) -> bool:
    """Whether a line would hide another one: it is dashed then, and both colours are seen."""
    near = _SAME * max(line.span, other.span)
    return bool(np.all(np.abs(line.values - other.values) <= near))


def _draw_curve(axes: Axes, curve: Curve, color: str) -> None:
    if not curve.points:
        axes.plot(curve.time, curve.values, label=curve.label, color=color, linewidth=1.0)
        return
    bars = None if curve.spread is None else np.abs(curve.spread - curve.values)
    axes.errorbar(
        curve.time,
        curve.values,
        yerr=bars,
        label=curve.label,
        color=color,
        fmt="o",
        markersize=5,
        markerfacecolor="none",
        capsize=3,
        zorder=3,
    )


def outside_legend(axes: Axes, title: str = "") -> None:
    """Legend beside the axes, where it hides nothing."""
    axes.legend(
        loc="upper left",
        bbox_to_anchor=(1.01, 1.03),
        borderaxespad=0.0,
        title=title or None,
        title_fontsize=8,
        alignment="left",
    )
