"""Wetted surface of the F3OF device from its dimensions.

The device has two planes of symmetry (x = 0 and y = 0): one quarter (x >= 0, y >= 0) is built from
convex parts and reflected. World axes, z = 0 at the still water line; panels as in
`cases.f3of.panels`.

Base and flaps meet in open interfaces at the hinge blocks, and all are open at the water plane:
only their union is watertight. The interfaces are vertical: integrals with n_z are exact for each
body.

    python -m cases.f3of.mesh    # in the root of the repository: panel counts, hydrostatics
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass

import numpy as np
from cases.f3of.panels import (
    Array,
    Point,
    breaks,
    check,
    convex,
    disc,
    graded,
    hydrostatics,
    octagon,
    rectangle,
    reflected,
    shell,
    spandrels,
)

CENTER_OF_GRAVITY: dict[str, Point] = {
    "base": (0.0, 0.0, -9.0),
    "flap1": (-12.5, 0.0, -5.5),
    "flap2": (12.5, 0.0, -5.5),
}
_ALL = range(8)
_POSITIVE_FIRST = (0, 1, 6, 7)  # octants with a positive first coordinate
_NEGATIVE_SECOND = range(4, 8)  # octants with a negative second coordinate


@dataclass(frozen=True)
class Dimensions:
    """Dimensions of the F3OF device [m].

    Octagonal sections are inscribed in a circle of the given radius, two corners on each axis. All
    tubes lie in the plane of the hinges; boxes, hinge blocks and nodes are as high as the tubes.
    """

    column_spacing: float = 12.5  # from x = 0 and y = 0 to the column axes; x of the hinge axes
    column_radius: float = 1.5  # also half the width of the box around the column
    foot_depth: float = 12.0  # underside of the columns
    hinge_depth: float = 9.0  # hinge axes and tube axes
    tube_radius: float = 1.0  # also half of: height of boxes, blocks, nodes; flap thickness
    node_spacing: float = 4.0  # from x = 0 to the transverse tubes
    flap_inner: float = 1.0  # y of the inner end of a flap panel
    flap_outer: float = 10.5  # y of the outer end of a flap panel


@dataclass(frozen=True)
class PanelSize:
    """Longest panel sides [m]: the density of the meshes with which the compared codes worked."""

    surface: float = 1.2  # at the water line, both ways
    growth: float = 1.4  # ratio of the heights of successive rows below it, -
    deep: float = 2.0  # along tubes, and the largest height of a row
    around: float = 1.5  # around tubes, on boxes, nodes, blocks and feet


def _column(d: Dimensions, size: PanelSize) -> Array:
    """Column, its foot, the box around it and the outer hinge block of the quarter."""
    c, r, t, zh = d.column_spacing, d.column_radius, d.tube_radius, d.hinge_depth
    low, high, side = -zh - t, -zh + t, size.around
    axis, tube = np.array([c, c]), np.array([c, -zh])
    ring = octagon(r) + axis
    across, height = breaks(c - r, c + r, side), breaks(low, high, side)
    levels = graded(-high, size.surface, size.growth, size.deep)
    column = convex((c, c, 0.5 * high), shell(2, ring, levels, size.surface))
    foot = convex(
        (c, c, low),
        shell(2, ring, breaks(low, -d.foot_depth, side), side),
        disc(-d.foot_depth, axis, r, side),
    )
    strips = [breaks(c - r, c - t, side), breaks(c + t, c + r, side)]
    box = convex(
        (c, c, -zh),
        *(spandrels(2, z, axis, r, _ALL, side) for z in (low, high)),
        *(rectangle(i, c + r, across, height) for i in (0, 1)),
        spandrels(0, c - r, tube, t, _ALL, side),
        *(rectangle(i, c - r, strip, height) for i in (0, 1) for strip in strips),
    )
    length, thickness = breaks(d.flap_outer, c - r, side), breaks(c - t, c + t, side)
    block = convex(
        (c, c - r, -zh),
        *(rectangle(0, x, length, height) for x in (c - t, c + t)),
        *(rectangle(2, z, thickness, length) for z in (low, high)),
        spandrels(1, d.flap_outer, tube, t, _NEGATIVE_SECOND, side),
    )
    return np.concatenate([column, foot, box, block])


def _nodes(d: Dimensions, size: PanelSize) -> Array:
    """Middle hinge block and the two nodes of the quarter (those on y = 0 are cut in half)."""
    c, t, zh, n, side = d.column_spacing, d.tube_radius, d.hinge_depth, d.node_spacing, size.around
    levels = (-zh - t, -zh + t)
    half, height = breaks(0.0, t, side), breaks(*levels, side)
    thickness, width = breaks(c - t, c + t, side), breaks(n - t, n + t, side)
    middle, node = np.array([0.0, -zh]), np.array([n, -zh])
    hinge = np.array([c, -zh])  # in (x, z); also the axis of the outer tube in (y, z)
    block = convex(
        (c, 0.0, -zh),
        *(rectangle(2, z, thickness, half) for z in levels),
        rectangle(0, c + t, half, height),
        spandrels(0, c - t, middle, t, _POSITIVE_FIRST, side),
        spandrels(1, d.flap_inner, hinge, t, _NEGATIVE_SECOND, side),
    )
    inner = convex(
        (n, 0.0, -zh),
        *(rectangle(2, z, width, half) for z in levels),
        *(spandrels(0, x, middle, t, _POSITIVE_FIRST, side) for x in (n - t, n + t)),
        spandrels(1, t, node, t, _ALL, side),
    )
    outer = convex(
        (n, c, -zh),
        *(rectangle(2, z, width, thickness) for z in levels),
        rectangle(1, c + t, width, height),
        *(spandrels(0, x, hinge, t, _ALL, side) for x in (n - t, n + t)),
        spandrels(1, c - t, node, t, _ALL, side),
    )
    return np.concatenate([block, inner, outer])


def _tubes(d: Dimensions, size: PanelSize) -> Array:
    """Tubes of the quarter; those on y = 0 are cut in half."""
    c, t, zh, n = d.column_spacing, d.tube_radius, d.hinge_depth, d.node_spacing
    ring = octagon(t)
    right = ring[[6, 7, 0, 1, 2]]
    lengthwise = [
        (ring, c, 0.0, n - t),
        (ring, c, n + t, c - d.column_radius),
        (right, 0.0, 0.0, n - t),
        (right, 0.0, n + t, c - t),
    ]
    tubes = []
    for profile, y, start, end in lengthwise:
        around = profile + np.array([y, -zh])
        side = shell(0, around, breaks(start, end, size.deep), size.around)
        tubes.append(convex((0.5 * (start + end), y, -zh), side))
    around = ring + np.array([n, -zh])
    across = shell(1, around, breaks(t, c - t, size.deep), size.around)
    tubes.append(convex((n, 0.5 * c, -zh), across))
    return np.concatenate(tubes)


def _flap(d: Dimensions, size: PanelSize) -> Array:
    """Flap panel of the quarter: flat sides and ends, half an octagon around the hinge below."""
    c, t, zh = d.column_spacing, d.tube_radius, d.hinge_depth
    ends = (d.flap_inner, d.flap_outer)
    span, thickness = breaks(*ends, size.surface), breaks(c - t, c + t, size.surface)
    levels = graded(zh - t, size.surface, size.growth, size.deep)
    below = breaks(-zh + t, -zh, size.deep)[1:]
    bottom = octagon(t)[4:] + np.array([c, -zh])
    return convex(
        (c, 0.5 * sum(ends), -0.5 * zh),
        *(rectangle(0, x, span, np.concatenate([levels, below])) for x in (c - t, c + t)),
        *(rectangle(1, y, thickness, levels) for y in ends),
        shell(1, bottom, span, size.around),
    )


def _lid(d: Dimensions, size: PanelSize) -> Array:
    """Inner water planes of the quarter (column and flap), against irregular frequencies."""
    c, t, side = d.column_spacing, d.tube_radius, size.surface
    span, thickness = breaks(d.flap_inner, d.flap_outer, side), breaks(c - t, c + t, side)
    return convex(
        (c, c, 1.0),
        rectangle(2, 0.0, thickness, span),
        disc(0.0, np.array([c, c]), d.column_radius, side),
    )


def quarter(
    dimensions: Dimensions | None = None, size: PanelSize | None = None
) -> dict[str, Array]:
    """Panels of the quarter x >= 0, y >= 0.

    Returns
    -------
    dict
        "base" and "flap" (half of flap2): wetted surface; "lid": inner water planes, normals down.
        Arrays (n, 4, 3) [m].
    """
    d, s = dimensions or Dimensions(), size or PanelSize()
    return {
        "base": np.concatenate([_column(d, s), _nodes(d, s), _tubes(d, s)]),
        "flap": _flap(d, s),
        "lid": _lid(d, s),
    }


def bodies(dimensions: Dimensions | None = None, size: PanelSize | None = None) -> dict[str, Array]:
    """Complete wetted surfaces of the bodies.

    Returns
    -------
    dict
        "base", "flap1" (x < 0, up-wave) and "flap2": arrays (n, 4, 3) [m].
    """
    part = quarter(dimensions, size)
    half = {k: np.concatenate([p, reflected(p, 1)]) for k, p in part.items()}
    return {
        "base": np.concatenate([half["base"], reflected(half["base"], 0)]),
        "flap1": reflected(half["flap"], 0),
        "flap2": half["flap"],
    }


def main() -> None:
    """Print panel counts and hydrostatics."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    default = PanelSize()
    for key in ("surface", "growth", "deep", "around"):
        parser.add_argument(f"--{key}", type=float, default=getattr(default, key))
    size = PanelSize(**vars(parser.parse_args()))
    parts = bodies(size=size)
    check(parts)
    print(f"lid: {4 * len(quarter(size=size)['lid'])} panels")
    for name, panels in parts.items():
        h = hydrostatics(panels, CENTER_OF_GRAVITY[name])
        print(f"{name}: {len(panels)} panels, displaced volume {h.displaced_volume:.4f} m3")
        print(f"  centre of buoyancy {np.round(h.center_of_buoyancy, 4) + 0.0} m")
        print(f"  water plane {h.waterplane_area:.4f} m2")
        print(f"  S_x S_y S_xx S_yy S_xy {np.round(h.waterplane_moments, 4) + 0.0} m3, m4")


if __name__ == "__main__":
    main()
