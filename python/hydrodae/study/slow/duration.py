"""Length of a run against the periods of slow motions, which few cycles do not sample."""

from __future__ import annotations

from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import HydrodaeError
from hydrodae.linear import LinearModel

#: Cycles of the slowest motion that a run has at least: fewer give no standard deviation.
CYCLES = 5.0
VARYING = ("newman", "difference")


def short_run(case: Case) -> list[str]:
    """Return what `hydrodae check` says of slow motions with too few cycles; empty without any."""
    loads = case_tables(case).get("second_order", {}).get("loads", [])
    if not set(loads) & set(VARYING):
        return []
    try:
        modes = LinearModel(case).modes()
    except HydrodaeError as error:
        return [f"slow motion: its periods are not checked, {error}"]
    if not modes or modes[0].period <= case.end_time / CYCLES:
        return []
    period, moves = modes[0].period, max(modes[0].shape, key=lambda name: abs(modes[0].shape[name]))
    return [
        f"look at: slow motion: {moves} swings with {period:.3g} s, and the run of "
        f"{case.end_time:g} s has {case.end_time / period:.2g} cycles; set end_time = "
        f"{CYCLES * period:.3g} or more"
    ]
