"""Several unconnected mechanisms: each must move as if it were alone."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from tests.attack import scales
from tests.attack.family import chosen, family, log_uniform
from tests.attack.parts import beside, both
from tests.stability import Scene, all_scenes

KIND = "unconnected mechanisms"
NEIGHBOURS = ("ship", "barge", "rotor", "swing")
HARD = ("four_bar", "dead_point", "door", "bricard", "mass_ratio", "pendulum", "snap", "stick_slip")


def _draw(g: np.random.Generator) -> dict[str, Any]:
    return dict(which=HARD[g.integers(len(HARD))], kind=NEIGHBOURS[g.integers(len(NEIGHBOURS))])


@family(KIND, _draw, alone=True)
@chosen(which="four_bar", kind="ship")
@chosen(which="four_bar", kind="barge")
@chosen(which="four_bar", kind="rotor")
@chosen(which="dead_point", kind="ship")
@chosen(which="dead_point", kind="barge")
@chosen(which="dead_point", kind="swing")
@chosen(which="door", kind="ship")
@chosen(which="bricard", kind="rotor")
@chosen(which="snap", kind="ship")
@chosen(which="stick_slip", kind="swing")
def hard_beside(which: str, kind: str) -> Scene:
    """A hard scene of the stability map with an unrelated mechanism beside it."""
    return beside(all_scenes()[which], kind)


def _draw_two(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        small=log_uniform(g, 1e-4, 0.1),
        large=log_uniform(g, 10.0, 1e5),
        angle=log_uniform(g, 1e-3, 1.5),
    )


@family(KIND, _draw_two, alone=True)
@chosen(small=1e-2, large=100.0, angle=1.0)
@chosen(small=1e-3, large=1e4, angle=0.01)
def two_pendulums(small: float, large: float, angle: float) -> Scene:
    """A small and a large pendulum, each judged by its own size."""
    one = scales.pendulum(small, small**3, angle)
    two = scales.pendulum(large, large**3, angle)
    tables = dict(one.tables)
    for key in ("body", "joint"):
        for entry in two.tables[key]:
            renamed = dict(entry)
            renamed["name"] += "_2"
            if "body_b" in renamed:
                renamed["body_b"] += "_2"
            tables[key] = [*tables[key], renamed]
    end = 3.0 * float(two.time_scale)
    tables["solver"], tables["output"] = {"end_time": end}, {"step": end / 400}
    measured_one, exact_one, exact_two = one.measured, one.truth, two.truth
    assert measured_one is not None
    assert exact_one is not None
    assert exact_two is not None
    start = two.tables["body"][0]["center_of_gravity"]

    def second(results: Any) -> Any:
        values = np.asarray(results["bodies/bob_2/position"].values) - start
        return values[:, [0, 2]] / large

    return replace(
        one,
        title="a small and a large pendulum",
        tables=tables,
        size=min(2.0, angle),
        unit="of L",
        measured=both(lambda r: measured_one(r) / small, second),
        truth=lambda t: np.column_stack([exact_one(t) / small, exact_two(t) / large]),
    )
