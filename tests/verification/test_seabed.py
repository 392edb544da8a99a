"""Dynamic lines on a seabed whose depth is a table: closed forms, energy, symmetries, bad input."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.errors import wrong
from tests.verification.line_scenes import WATER, at_rest, case, chain, line, moving

import hydrodae

X, Y = [-500.0, -250.0, -60.0, 100.0], [-80.0, -10.0, 90.0]
#: Hills and hollows below a chain from x = -385 to a buoy at the origin.
HILLS = np.array([[52.0, 49.0, 54.0, 40.0], [53.0, 47.0, 58.0, 45.0], [50.0, 48.0, 49.0, 43.0]])


def seabed(x: Any, y: Any, depth: Any) -> str:
    """Return the table; depths (n_y, n_x)."""
    rows = {"x": x, "y": y, "depth": np.ravel(depth)}
    return "[seabed]\n" + "".join(
        f"{key} = {[float(v) for v in values]}\n" for key, values in rows.items()
    )


def buoy_on(bed: str, more: str = "", anchor: float = -48.0) -> str:
    """Return a chain to a moved buoy, over a bed."""
    keys = chain(20, f"seabed_friction = 0.3\n{more}").replace("-385.0, 0.0, -50.0",
                                                              f"-385.0, 0.0, {anchor}")  # fmt: skip
    return WATER + bed + moving(8.0) + line(keys)


def test_a_line_on_a_smooth_slope_hangs_on_its_upper_end() -> None:
    """T(s) = w sin(angle) (L - s), along the slope; the bed carries w cos(angle).

    The bed pushes with k s(d) / cos(angle) along its normal, s(d) by its depth d beneath a node.
    """
    slope, mass, diameter, n, length = math.tan(0.3), 100.0, 0.1, 20, 80.0
    w = mass * 9.81 - 1025.0 * 9.81 * 0.25 * math.pi * diameter**2
    width = 0.1 * diameter
    roots = np.roots([-0.0625, 0.0, 0.375, 0.5, 0.1875 - math.cos(0.3) ** 2])
    depth = width * next(r.real for r in roots if abs(r.imag) < 1e-12 and -1.0 < r.real < 1.0)
    bed = seabed(
        [0.0, 30.0, 200.0], [-10.0, 10.0], np.tile(20.0 + slope * np.array([0, 30, 200]), 2)
    )
    keys = (
        f"point_a = [10.0, 0.0, {-20.0 - 10.0 * slope - depth}]\nfree_end = true\n"
        f"point_b = [100.0, 0.0, 0.0]\nlength = [{length}]\nsegments = [{n}]\nmass = [{mass}]\n"
        f"diameter = [{diameter}]\nstiffness = [1e9]\n"
    )
    text = "[environment]\nwater_density = 1025.0\nwater_depth = 90.0\n" + bed + line(keys)
    start = hydrodae.Simulation(case(text))
    middle = length * (np.arange(n) + 0.5) / n
    tension = w * math.sin(0.3) * (length - middle)
    np.testing.assert_allclose(start.read("forces/line/tension_along"), tension, rtol=1e-6)
    places = np.reshape(start.read("forces/line/position"), (-1, 3))
    np.testing.assert_allclose(places[:, 2], -20.0 - places[:, 0] * slope - depth, atol=1e-6)


def test_a_level_table_is_a_flat_bed() -> None:
    flat, table = (
        hydrodae.run(case(text, "end_time = 4.0", 0.1))
        for text in (
            buoy_on("", "seabed_depth = 50.0\nseabed_damping = 1e4", -50.0),
            buoy_on(seabed(X, Y, np.full((3, 4), 50.0)), "seabed_damping = 1e4", -50.0),
        )
    )
    for name, size in (("tension_along", 5e7), ("position", 385.0), ("energy", 1e6)):  # EA, L, J
        a, b = (run[f"forces/line/{name}"].values for run in (flat, table))
        np.testing.assert_allclose(b, a, rtol=0, atol=1e-12 * size)


@pytest.mark.parametrize("spent", ["", "seabed_damping = 1e4\nseabed_friction = 0.4\n"])
def test_what_goes_in_is_stored_or_spent_over_hills(spent: str) -> None:
    keys = chain(10, spent).replace("-50.0]", "-48.0]").replace("diameter = [0.15]\n", "")
    text = WATER + seabed(X, Y, HILLS) + moving(4.0) + line(keys)
    run = hydrodae.run(case(text, "end_time = 8.0\nrtol = 1e-8", 0.005))
    stored = run["forces/line/energy"].values
    power = run["forces/line/power_seabed"].values
    lost = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * 0.005)])
    given = -run["energy/work/line"].values
    size = np.abs(given).max()
    assert given == pytest.approx(stored - stored[0] + lost, abs=(1e-4 if spent else 1e-6) * size)
    assert power.min() >= -1e-12 * power.max()
    assert bool(lost[-1] > 1e-3 * size) == bool(spent)


def test_a_mirrored_bed_and_one_with_exchanged_axes() -> None:
    """Places turn with the bed: mirrored in the plane x-z, and x and y exchanged."""
    keys = "{}\nlength = [110.0]\nsegments = [20]\nmass = [50.0]\nstiffness = [1e7]\n"
    beds = ((X, Y, HILLS, [0, 1, 2], [1, 1, 1]),
            (X, [-y for y in Y[::-1]], HILLS[::-1], [0, 1, 2], [1, -1, 1]),
            (Y, X, HILLS.T, [1, 0, 2], [1, 1, 1]))  # fmt: skip
    found = []
    for x, y, depth, order, sign in beds:
        ends = [
            (np.array(end)[order] * sign).tolist()
            for end in ([-120.0, 5.0, -40.0], [-30.0, 25.0, -40.0])
        ]
        text = (
            WATER
            + seabed(x, y, depth)
            + line(keys.format(f"point_a = {ends[0]}\npoint_b = {ends[1]}"))
        )
        start = hydrodae.Simulation(case(text))
        places = np.reshape(start.read("forces/line/position"), (-1, 3)) * sign
        found.append((places[:, order], np.array(start.read("forces/line/tension_along"))))
    assert found[0][0][:, 2].min() < -48.0
    for places, tension in found[1:]:
        np.testing.assert_allclose(places, found[0][0], atol=1e-7)
        np.testing.assert_allclose(tension, found[0][1], rtol=1e-7)


def test_a_deeper_bed_carries_less() -> None:
    """The table is felt: the chain of a flat bed in 50 m is nowhere as over hills."""
    tensions = [
        float(at_rest(buoy_on(seabed(X, Y, depth)), "forces/line/tension_anchor"))
        for depth in (HILLS, HILLS + 4.0)
    ]
    assert tensions[1] > 1.01 * tensions[0]


@pytest.mark.parametrize(
    ("x", "y", "depth", "more", "key"),
    [
        ([0.0, 10.0, 10.0], [0.0, 1.0], [[50.0] * 3] * 2, "", "seabed.x"),
        ([0.0, 10.0], [0.0], [[50.0] * 2], "", "seabed.y"),
        ([0.0, 10.0], [0.0, 1.0], [50.0] * 3, "", "seabed.depth"),
        ([0.0, 10.0], [0.0, 1.0], [[-50.0] * 2] * 2, "", "seabed.depth"),
        (X, Y, np.full((3, 4), 45.0), "", "force.line.point_a"),
        (X, Y, HILLS, "seabed_depth = 50.0", "force.line.seabed_depth"),
    ],
)
def test_what_is_no_seabed_is_refused(x: Any, y: Any, depth: Any, more: str, key: str) -> None:
    with wrong(key):
        hydrodae.Simulation(case(buoy_on(seabed(x, y, depth), more)))


def test_a_seabed_without_lines_is_refused() -> None:
    with wrong("seabed"):
        hydrodae.Simulation(case(seabed(X, Y, HILLS) + moving(8.0)))
