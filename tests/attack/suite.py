"""The scenes and methods of the attack suite, and what its cells come to."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import numpy as np
from tests.attack import (  # noqa: F401  the modules register their families
    bounces,
    buoyancy,
    chains,
    coasts,
    contacts,
    control,
    driven,
    drives,
    geared,
    hinges,
    impacts,
    light,
    lines,
    long,
    mechanisms,
    memories,
    moorings,
    parting,
    poses,
    ptos,
    rest,
    scales,
    snaps,
    starts,
    turns,
    waves,
)
from tests.attack.family import FAMILIES, log_uniform
from tests.stability import Cell, Method, Scene, show
from tests.stability.grid import PASS, WRONG

#: Relative error that the truths themselves may have.
FLOOR = 1e-9
#: Default settings; `rtol` is the default of the solver, given here for the allowance.
DEFAULTS = tuple(
    Method(name, {"method": name, "rtol": 1e-6}) for name in ("auto", "ida", "radau", "explicit_rk")
)
#: Methods with error control at other tolerances.
TOLERANCES = tuple(
    Method(f"{name}:{rtol:.0e}", {"method": name, "rtol": rtol})
    for rtol in (1e-4, 1e-8)
    for name in ("auto", "ida", "radau")
)
RANDOM = tuple(
    f"{name}:random"
    for name in ("ida", "radau", "explicit_rk", "gauss", "lobatto_iiic", "generalized_alpha")
)


@cache
def all_scenes(seeds: tuple[int, ...] = ()) -> dict[str, Scene]:
    """Return the scenes of the suite by name; with `seeds` one of each family and seed instead."""
    found = []
    for entry in FAMILIES.values():
        found += [entry.drawn(seed) for seed in seeds] if seeds else entry.scenes()
    return {scene.name: scene for scene in found}


def kind_of(name: str) -> str:
    """Return the kind of attack of a scene."""
    return FAMILIES[name.rpartition("_")[0]].kind


def random_method(column: str, scene: Scene, seed: int) -> Method:
    """Return a method at a tolerance, or a fixed step and order, drawn for the scene.

    Parameters
    ----------
    column : str
        One of `RANDOM`.
    seed : int
        Of the draw; scene and column are mixed in.
    """
    name = column.split(":")[0]
    g = np.random.default_rng([seed, zlib.crc32(scene.name.encode()), zlib.crc32(name.encode())])
    if name in ("ida", "radau", "explicit_rk"):
        return Method(column, {"method": name, "rtol": log_uniform(g, 1e-8, 1e-3)})
    solver: dict[str, object] = {"method": name}
    if name != "generalized_alpha":
        solver["order"] = int(g.choice([2, 4, 6]))
    return Method(column, solver, log_uniform(g, 5.0, 200.0))


def methods_of(scene: Scene, columns: Sequence[str], seed: int) -> list[Method]:
    """Return the methods of the columns for a scene."""
    known = {method.name: method for method in (*DEFAULTS, *TOLERANCES)}
    return [known.get(c) or random_method(c, scene, seed) for c in columns]


def described(scene: Scene, method: Method) -> str:
    """Return the settings of a method for a scene in words."""
    keys = method.keys(scene)
    order = f", order {keys['order']}" if "order" in keys else ""
    if "step" in keys:
        return f"step {keys['step']:.3g} s{order}"
    return f"rtol {keys['rtol']:.2g}{order}"


def columns() -> list[str]:
    """Return the names of all columns."""
    return [*(m.name for m in (*DEFAULTS, *TOLERANCES)), *RANDOM]


def ratio(cell: Cell) -> float | None:
    """Return the true error over the run's own estimate, both relative to the size of the motion.

    An error below `FLOOR` is not told from that of the truth, and counts as `FLOOR`; None where a
    run did not complete or has no estimate.
    """
    if cell.outcome not in (PASS, WRONG) or cell.error is None or not cell.size:
        return None
    if cell.estimate is None:
        return None
    return max(cell.error / cell.size, FLOOR) / max(cell.estimate, FLOOR)


def label(cell: Cell) -> str:
    """Return the characters of a cell of the map, with the true error over the estimate."""
    known = ratio(cell)
    return show.label(cell) + ("" if known is None else f" x{known:.1g}")


def figures(cells: Sequence[Cell]) -> dict[str, float]:
    """Return what the suite is asked for.

    wrong: number of cells. default_share: of the default runs of scenes that some method passes,
    the part that pass. estimated: completed runs with an estimate; within_share: the part of them
    whose true error is a tenth of the estimate to ten times it; far: those beyond a hundredth and a
    hundred times it.
    """
    possible = {cell.scene for cell in cells if cell.outcome == PASS}
    names = {method.name for method in DEFAULTS}
    default = [c for c in cells if c.method in names and c.scene in possible]
    ratios = [r for r in map(ratio, cells) if r is not None]
    return {
        "wrong": sum(c.outcome == WRONG for c in cells),
        "default_runs": len(default),
        "default_share": sum(c.outcome == PASS for c in default) / max(1, len(default)),
        "estimated": len(ratios),
        "within_share": sum(0.1 <= r <= 10.0 for r in ratios) / max(1, len(ratios)),
        "far": sum(not 0.01 <= r <= 100.0 for r in ratios),
    }


def short(cell: Cell, setting: str) -> Cell:
    """Return the cell with its setting in front of the reason."""
    return replace(cell, reason=f"[{setting}] {cell.reason}".strip())
