"""Picture of a calibration: measured, before and after."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib
from matplotlib.figure import Figure

from hydrodae.study.calibrate.parts import Residual
from hydrodae.support.style import STYLE
from hydrodae.support.units import displayed


@matplotlib.rc_context(STYLE)
def draw(residuals: Sequence[Residual]) -> Figure:
    """One panel for each channel of each record."""
    rows = len(residuals)
    figure = Figure(figsize=(8.0, 0.6 + 2.2 * rows), layout="constrained")
    panels = figure.subplots(rows, 1, squeeze=False)[:, 0]
    for axes, one in zip(panels, residuals, strict=True):
        factor, unit = displayed(one.unit)
        axes.plot(one.time, factor * one.measured, color="black", label="measured")
        axes.plot(one.time, factor * one.start, "--", color="C1", label="before")
        axes.plot(one.time, factor * one.end, color="C0", label="after")
        told = "fitted" if one.fitted else "predicted"
        before, after = (100.0 * value / one.span for value in (one.before, one.after))
        axes.set_title(
            f"{one.record} ({told}): rms {before:.2g} % of the range before, {after:.2g} % after"
        )
        axes.set_ylabel(f"{one.channel.rpartition('/')[0].rpartition('/')[2]} "
                        f"{one.channel.rpartition('/')[2]} [{unit}]")  # fmt: skip
        axes.set_xlabel("time of the record [s]")
        axes.legend(loc="upper right", ncols=3)
    return figure
