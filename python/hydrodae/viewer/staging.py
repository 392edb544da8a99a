"""From results or a case to what is drawn."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hydrodae.case.contents import case_tables
from hydrodae.viewer.bodies import make_bodies
from hydrodae.viewer.curves import make_curves
from hydrodae.viewer.lines import make_lines
from hydrodae.viewer.sea import make_sea, seabed
from hydrodae.viewer.source import Run, Source
from hydrodae.viewer.spots import make_spots
from hydrodae.viewer.stage import Joint, Stage

#: How the types of forces that take power begin: their joint is marked.
DRIVES = "pto_"
#: Most samples that a page holds; a longer run is thinned out.
MOST_SAMPLES = 4000


def make_stage(
    source: Source,
    *,
    shapes: Mapping[str, str] | None = None,
    height: float | None = None,
    channels: Sequence[str] = (),
    step: float | None = None,
) -> Stage:
    """Everything that is drawn.

    Parameters
    ----------
    source : Source
    shapes : mapping, optional
        Shapes of bodies; see `hydrodae.viewer.shapes.shape_of`.
    height : float, optional
        Of what is drawn above wetted surfaces [m].
    channels : sequence of str
        Patterns of channels to be shown beside the usual ones.
    step : float, optional
        Least time between two samples [s]; by default such that a page has at most 4000.

    Raises
    ------
    HydrodaeError
        A shape or channel that is asked for is wrong, or the database cannot be read.
    """
    tables = case_tables(source.case)
    notes = _thin_out(source, step)
    bodies = make_bodies(source, tables, shapes or {}, height)
    lines, missing = make_lines(source, tables, bodies)
    spots, hidden = make_spots(source, tables, bodies, lines)
    sea, left_out = make_sea(source, tables)
    if sea is not None and len(sea.waves):
        notes.append("the sea is that of the waves as they come, without what bodies make in it")
    return Stage(
        title=source.case.title or "scene",
        state=source.state,
        time=source.time,
        bodies=bodies,
        joints=_joints(tables),
        lines=lines,
        curves=make_curves(source, tables, bodies, channels),
        sea=sea,
        bed=seabed(sea, tables),
        notes=[*notes, *missing, *hidden, *left_out],
        spots=spots,
    )


def _thin_out(source: Source, step: float | None) -> list[str]:
    """Leave samples out that are nearer than `step`, or too many; return notes."""
    if not isinstance(source, Run) or len(source.results.time) < 2:
        return []
    all_times = source.results.time
    inside = (all_times >= source.first) & (all_times <= source.last)
    count = int(inside.sum())
    between = float(np.median(np.diff(all_times)))
    if step is not None:
        source.stride = max(1, round(step / between))
    else:
        source.stride = max(1, -(-count // MOST_SAMPLES))
    if source.stride == 1:
        return []
    return [f"one of {source.stride} samples is drawn: every {source.stride * between:g} s"]


def _joints(tables: Mapping[str, Any]) -> list[Joint]:
    driven = {f.get("joint") for f in tables.get("force", []) if f["type"].startswith(DRIVES)}
    found = []
    for joint in tables.get("joint", []):
        if joint["type"] in ("distance", "telescope"):
            continue  # drawn as lines
        point = joint.get("point", joint.get("path", [[0.0, 0.0, 0.0]])[0])
        axis = np.asarray(joint.get("axis", [0.0, 0.0, 1.0]), dtype=float)
        found.append(
            Joint(
                joint["name"],
                joint["type"],
                joint["body_a"],
                (joint["body_a"], joint["body_b"]),
                np.asarray(point, dtype=float),
                axis / np.linalg.norm(axis),
                joint["name"] in driven,
            )
        )
    return found
