"""Pictures of a device: regular.png after Figure 14 of the paper, irregular.png after Figure 15."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import parts
import study
from matplotlib.figure import Figure

from hydrodae import Results, run


def draw(layout: parts.Layout, directory: Path) -> None:
    """Run the regular case and 120 s of the irregular one, and draw them."""
    regular = run(directory / "regular.toml")
    irregular = run(directory / "irregular.toml", set={"solver.end_time": 120.0})
    for figure, name in (
        (draw_regular(regular, layout), "regular.png"),
        (draw_irregular(irregular, layout), "irregular.png"),
    ):
        figure.savefig(directory / name, dpi=90)
        print(f"picture: {directory / name}")


def draw_regular(results: Results, layout: parts.Layout) -> Figure:
    """Pitch of S2 and of its arm against it."""
    arm = next(arm for arm, nodes in layout.arms.items() if "S2" in nodes)
    figure = Figure(figsize=(8.0, 3.2), layout="constrained")
    axis = figure.subplots()
    for values, label in (
        (results["bodies/S2/rotation"].values[:, 1], "S2"),
        (results[f"forces/pto_{arm}_S2/rotation"].values[:, 1], f"S2 against {arm}"),
    ):
        axis.plot(results.time, np.degrees(values), label=label)
    axis.set(xlabel="time, s", ylabel="pitch, deg", title=results.title)
    figure.legend(loc="outside right upper")
    axis.grid(alpha=0.3)
    return figure


def draw_irregular(results: Results, layout: parts.Layout) -> Figure:
    """Elevation above, power of all take-offs below."""
    figure = Figure(figsize=(8.0, 4.5), layout="constrained")
    above, below = figure.subplots(2, 1, sharex=True)
    above.plot(results.time, results["sea/elevation"].values, linewidth=0.8)
    above.set(ylabel="elevation, m", title=results.title)
    power = study.power(results, layout)
    mean = power[results.time > 20.0].mean()
    below.plot(results.time, power, linewidth=0.8)
    below.axhline(mean, color="C1", label=f"mean after 20 s: {mean:.1f} W")
    below.set(xlabel="time, s", ylabel="power, W")
    below.legend()
    for axis in (above, below):
        axis.grid(alpha=0.3)
    return figure
