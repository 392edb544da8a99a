"""Buoys and clumps on lines, markers, gauges and moored points over time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hydrodae.viewer.lines import each, places_of
from hydrodae.viewer.source import Source
from hydrodae.viewer.stage import Body, Line, Spot

#: Density by which what hangs on a line floats or sinks where the case names none [kg/m3].
_WATER = 1000.0


def make_spots(
    source: Source, tables: Mapping[str, Any], bodies: Sequence[Body], lines: Sequence[Line]
) -> tuple[list[Spot], list[str]]:
    """Everything that is a point, and notes of what cannot be drawn.

    Parameters
    ----------
    source : Source
    tables : mapping
        The case file.
    bodies : sequence of Body
    lines : sequence of Line
        On which buoys and clumps hang; what hangs on a line that is not drawn is not drawn.
    """
    known = {body.name: body for body in bodies}
    drawn = {line.name: line for line in lines}
    spots, notes = list[Spot](), list[str]()
    water = float(tables.get("environment", {}).get("water_density", _WATER))
    for force in tables.get("force", []):
        line = drawn.get(force["name"])
        if force["type"] == "mooring_matrix" and force["body"] in known:
            places = known[force["body"]].position
            spots.append(Spot(force["name"], "mooring matrix", (force["body"],), places))
        elif line is not None and force["type"] == "catenary":
            spots += _between_parts(line, force)
        elif line is not None and force["type"] == "line":
            if force.get("attachment_at") and line.arc is None:
                notes.append(
                    f"buoys and clumps of line {line.name} are not drawn: a pretension gives its "
                    "length"
                )
            else:
                spots += _attached(line, force, water)
    markers = {}
    for marker in tables.get("marker", []):
        name, body = marker["name"], marker["body"]
        places = places_of(source, known, body, marker["point"])
        markers[name] = Spot(name, "marker", (body,), places)
    spots += markers.values()
    spots += [_gauge(source, gauge, markers) for gauge in tables.get("gauge", [])]
    return spots, notes


def _between_parts(line: Line, force: Mapping[str, Any]) -> list[Spot]:
    """Loads between the parts of a catenary; each is where one part ends and the next begins."""
    found = []
    for number, load in enumerate(force.get("loads", []), 1):
        if load:
            # lengths count from B, whose parts do not change with a pretension
            beyond = sum(force["length"][number:])
            kind = "buoy" if load < 0.0 else "clump"
            found.append(_on(line, f"{line.name} {kind} {number}", kind, -beyond))
    return found


def _attached(line: Line, force: Mapping[str, Any], water: float) -> list[Spot]:
    at = force.get("attachment_at", [])
    masses = each(force.get("attachment_mass", [0.0]), len(at))
    volumes = each(force.get("attachment_volume", [0.0]), len(at))
    found = []
    for number, (place, mass, volume) in enumerate(zip(at, masses, volumes, strict=True), 1):
        kind = "buoy" if water * volume > mass else "clump"
        found.append(_on(line, f"{line.name} {kind} {number}", kind, float(place)))
    return found


def _on(line: Line, name: str, kind: str, along: float) -> Spot:
    """A point of a line at an unstretched length from A; from B if it is negative."""
    assert line.arc is not None
    at = along if along >= 0.0 else float(line.arc[-1]) + along
    k = int(np.clip(np.searchsorted(line.arc, at) - 1, 0, len(line.arc) - 2))
    part = float(np.clip((at - line.arc[k]) / (line.arc[k + 1] - line.arc[k]), 0.0, 1.0))
    places = (1.0 - part) * line.points[:, k] + part * line.points[:, k + 1]
    return Spot(name, kind, line.bodies, places)


def _gauge(source: Source, gauge: Mapping[str, Any], markers: Mapping[str, Spot]) -> Spot:
    """At the surface, above or beneath its marker."""
    places = np.zeros((len(source.time), 3))
    carrier = markers.get(gauge.get("marker", ""))
    if carrier is not None:
        places[:, :2] = carrier.points[:, :2]
    else:
        places[:, :2] = gauge.get("point", [0.0, 0.0])
    channel = f"gauges/{gauge['name']}/elevation"
    if channel in source.names:
        places[:, 2] = source.values(channel)
    return Spot(gauge["name"], "gauge", carrier.bodies if carrier else (), places)
