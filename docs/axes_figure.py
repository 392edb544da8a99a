"""Axes of the world, a body, a joint's marker and a marker, as a results file states them.

Runs a small scene and writes docs/axes.png:

    python docs/axes_figure.py
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

import hydrodae
from hydrodae.pictures.plot import COLORS, STYLE, save

CASE = """
title = "axes"

[[body]]
name = "base"
motion = "fixed"
mass = 1.0e5
center_of_gravity = [0.0, 0.0, -9.5]

[[body]]
name = "flap"
motion = "planar"
mass = 1.0e5
center_of_gravity = [0.0, 0.0, -5.5]
inertia = [1.0e6, 1.3e6, 1.0e6]

[[joint]]
name = "hinge"
type = "revolute"
body_a = "base"
body_b = "flap"
point = [0.0, 0.0, -9.0]
axis = [0.0, 1.0, 0.0]
initial.angle_deg = 25.0

[[marker]]
name = "top"
body = "flap"
point = [0.0, 0.0, -1.0]
axes = "body"

[solver]
end_time = 0.1
"""

Array = NDArray[np.float64]


#: What the colours mean.
KINDS = {
    "world": "#555555",
    "body axes of the flap": COLORS[0],
    "marker A of the hinge, carried by the base": COLORS[1],
    "marker 'top', axes = \"body\"": COLORS[2],
}
WORLD, BODY, HINGE, TOP = KINDS.values()


def arrow(axes: Axes, start: Array, along: Array, color: str, label: str) -> None:
    """Draw a vector of the x-z plane; one across the plane as a circle, seen along +y."""
    if np.hypot(along[0], along[2]) < 1e-9:
        mark = "x" if along[1] > 0 else "."
        axes.plot(start[0], start[2], "o", color=color, markersize=9, markerfacecolor="white")
        axes.plot(start[0], start[2], mark, color=color, markersize=5)
        end = start + np.array([-0.5, 0.0, -0.45])
    else:
        tip = start + along
        axes.annotate(
            "",
            (tip[0], tip[2]),
            (start[0], start[2]),
            arrowprops={"arrowstyle": "-|>", "color": color, "linewidth": 1.6},
        )
        end = tip + 0.4 * along / np.linalg.norm(along)
    axes.text(end[0], end[2], label, color=color, ha="center", va="center", weight="bold")


def rotation(quaternion: Array) -> Array:
    """Rotation matrix of a unit quaternion (w, x, y, z)."""
    w, x, y, z = quaternion
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def draw_pose(axes: Axes, results: hydrodae.Results, moved: bool) -> None:
    """Draw the reference pose, or that of the start."""
    reaction = results["joints/hinge/reaction_force"].attrs
    velocity = results["markers/top/velocity"].attrs
    hinge, top = np.array(reaction["origin"]), np.array(velocity["origin"])
    center = np.array([0.0, 0.0, -5.5])
    turn = rotation(results["bodies/flap/orientation"].to_numpy()[0]) if moved else np.eye(3)
    if moved:
        center = results["bodies/flap/position"].to_numpy()[0]
        top = results["markers/top/position"].to_numpy()[0]
    outline = np.array([[-0.7, 0, -3.5], [0.7, 0, -3.5], [0.7, 0, 5.0], [-0.7, 0, 5.0]])
    flap = center + outline @ turn.T
    axes.fill(flap[:, 0], flap[:, 2], color="#DCE9F3", zorder=0)
    axes.fill([-3, 3, 3, -3], [-9.2, -9.2, -10.2, -10.2], color="#E4E4E4", zorder=0)
    axes.axhline(0.0, color=COLORS[5], linewidth=1.0)
    axes.text(-6.4, 0.15, "z = 0, still water", color=COLORS[5], fontsize=8)
    for k, name in enumerate("xyz"):
        arrow(axes, np.array([-5.5, 0, -9.5]), 1.5 * np.eye(3)[k], WORLD, name)
        marker = np.array(reaction[f"axis_{name}"])  # carried by the base, which is fixed
        arrow(axes, hinge, 2.0 * marker, HINGE, name)
        arrow(axes, center, 1.7 * turn[:, k], BODY, name)
        if moved:
            along = turn @ np.array(velocity[f"axis_{name}"])
            arrow(axes, top, 1.4 * along, TOP, name)
    if moved:
        angle = float(results["joints/hinge/angle"][0])
        arc = np.linspace(0.0, angle, 30)
        axes.plot(2.4 * np.sin(arc), -9 + 2.4 * np.cos(arc), color=COLORS[3])
        axes.plot([0, 0], [-9, -6.0], color=COLORS[3], linestyle=":")
        axes.text(-0.2, -7.0, f"angle +{np.degrees(angle):.0f} deg", color=COLORS[3], ha="right")
    axes.set_aspect("equal")
    axes.set_xlim(-7, 7)
    axes.set_ylim(-12, 1.5)
    axes.set_xlabel("x [m]")
    axes.set_title("pose of the start" if moved else "reference pose")
    axes.grid(visible=False)


@matplotlib.rc_context(STYLE)
def draw(picture: Path) -> Path:
    """Run the scene of this figure and draw its axes."""
    results = hydrodae.run(hydrodae.Case.from_text(CASE))
    figure = Figure(figsize=(9.0, 5.4), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    draw_pose(left, results, moved=False)
    draw_pose(right, results, moved=True)
    left.set_ylabel("z [m]")
    marks = [Line2D([], [], color=color, label=kind) for kind, color in KINDS.items()]
    figure.legend(handles=marks, loc="outside lower center", ncols=2)
    return save(figure, picture)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).with_name("axes.png"))
    print(draw(parser.parse_args().output))
