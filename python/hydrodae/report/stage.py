"""The scene of a run as a picture: hulls, lines and sea, from the side of the viewer's page."""

from __future__ import annotations

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from hydrodae.hdb.bem.cutting import cut_at_water
from hydrodae.hdb.hull.closed import enclosed_volume
from hydrodae.pictures.plot import COLORS, STYLE
from hydrodae.support.arrays import Array
from hydrodae.viewer.framing import VIEWS, Frame
from hydrodae.viewer.stage import Sea, Stage

#: Panels of the sea along each side.
CELLS = 40
#: Order of drawing of what is below the sea, the sea, and what is above it.
BELOW, SURFACE, ABOVE = 2.0, 2.5, 2.7
#: Where the light comes from, world axes.
LIGHT = np.array([-0.4, -0.6, 0.7]) / np.linalg.norm([-0.4, -0.6, 0.7])


@matplotlib.rc_context(STYLE)
def scene_picture(stage: Stage, frame: Frame, time: float) -> Figure:
    """Draw a stage at the sample nearest to a time, by parallel projection.

    Parameters
    ----------
    stage : Stage
    frame : Frame
        What is shown.
    time : float
        [s].
    """
    at = int(np.abs(stage.time - time).argmin())
    figure = Figure(figsize=(8.0, 4.6), layout="constrained")
    axes = figure.subplots()
    for k, body in enumerate(stage.bodies):
        color = COLORS[k % len(COLORS)]
        axes.plot([], [], "s", color=color, label=body.name)
    _draw_bodies(axes, stage, at)
    for line in stage.lines:
        axes.plot(
            *_seen(line.points[at])[:, :2].T, color="#333333", linewidth=1.0, zorder=SURFACE - 0.1
        )
    if stage.sea is not None:
        _draw_sea(axes, stage.sea, frame, float(stage.time[at]))
    middle = _seen(frame.center[None])[0]
    width = 1.15 * frame.radius
    axes.set_xlim(middle[0] - 1.6 * width, middle[0] + 1.6 * width)
    axes.set_ylim(middle[1] - width, middle[1] + width)
    axes.set_aspect("equal")
    axes.set_axis_off()
    if stage.bodies:
        axes.legend(loc="upper left", fontsize="small", ncols=1 + len(stage.bodies) // 12)
    return figure


def _draw_bodies(axes: Axes, stage: Stage, at: int) -> None:
    """Draw what is below the waves beneath their surface, the rest above it."""
    parts: dict[float, list[tuple[Array, Array]]] = {BELOW: [], ABOVE: []}
    for k, body in enumerate(stage.bodies):
        placed = body.at(at).bent().reshape(-1, 3, 3)
        if enclosed_volume(placed) < 0.0:
            placed = placed[:, ::-1]
        panels = np.concatenate([placed, placed[:, 2:]], axis=1)
        water = np.zeros(panels.shape)
        if stage.sea is not None:
            x, y = body.position[at][:2]
            water[..., 2] = stage.sea.elevation(float(stage.time[at]), x, y)
        for order, turn in ((BELOW, 1.0), (ABOVE, -1.0)):
            sense = np.array([1.0, 1.0, turn])
            cut = cut_at_water((panels - water) * sense) * sense + water[0, 0]
            parts[order].append((cut, _shaded(cut, COLORS[k % len(COLORS)])))
    for order, found in parts.items():
        if found:
            cells, colors = (np.concatenate(part) for part in zip(*found, strict=True))
            _draw(axes, cells, colors, order)


def _seen(points: Array) -> Array:
    """Points (n, 3) to the right, up and towards a camera in the oblique view."""
    azimuth, elevation = np.radians(VIEWS["oblique"])
    toward = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    up = np.cos(elevation) * np.eye(3)[2] - np.sin(elevation) * toward
    depth = np.cos(elevation) * toward + np.sin(elevation) * np.eye(3)[2]
    return np.asarray(points @ np.stack([right, up, depth], axis=1))


def _shaded(triangles: Array, color: str) -> Array:
    """Colours (n, 4) of panels by their slope to the light."""
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    size = np.linalg.norm(normal, axis=1)
    light = 0.75 + 0.25 * (normal @ LIGHT) / np.where(size > 0.0, size, 1.0)
    paint = np.array(matplotlib.colors.to_rgb(color))
    return np.column_stack([light[:, None] * paint, np.ones(len(triangles))])


def _draw(axes: Axes, cells: Array, colors: Array, order: float) -> None:
    """Draw polygons (n, k, 3), those that face away first, then those behind."""
    seen = _seen(cells.reshape(-1, 3)).reshape(cells.shape)
    facing = np.cross(seen[:, 1] - seen[:, 0], seen[:, 2] - seen[:, 0])[:, 2] > 0.0
    behind = np.lexsort((seen[..., 2].mean(axis=1), facing))
    patches = PolyCollection(
        list(seen[behind][..., :2]), facecolors=colors[behind], linewidths=0.2, zorder=order
    )
    patches.set_edgecolor("face")
    patches.set_rasterized(True)
    axes.add_collection(patches)


def _draw_sea(axes: Axes, sea: Sea, frame: Frame, time: float) -> None:
    """Draw the sea as a translucent net over what it covers."""
    side = np.linspace(-frame.water, frame.water, CELLS + 1)
    x, y = np.meshgrid(frame.center[0] + side, frame.center[1] + side, indexing="ij")
    corners = np.stack([x, y, sea.elevation(time, x, y)], axis=-1)
    cells = np.stack(
        [corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]], axis=2
    )
    cells = cells.reshape(-1, 4, 3)
    colors = _shaded(cells[:, :3], "#5aa9d6")
    # waves are flat: their slopes are shown three times as steep
    colors[:, :3] = np.clip(0.9 + 3.0 * (colors[:, :3] / colors[:, :3].mean(axis=0) - 1.0), 0, 1)
    colors[:, :3] *= np.array(matplotlib.colors.to_rgb("#5aa9d6"))
    colors[:, 3] = 0.35
    _draw(axes, cells, colors, SURFACE)
