"""What a case is made of, for a report: its parts, the models that it uses, a sketch."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from hydrodae.pictures.plot import COLORS, STYLE

Tables = dict[str, Any]


def parts(tables: Tables) -> Iterator[tuple[str, str, str, str]]:
    """Rows of kind, name, type and where: bodies, joints, constraints, forces, waves."""
    for body in tables.get("body", []):
        yield (
            "body",
            str(body.get("name", "")),
            _words(body.get("motion", "rigid")),
            f"{_mass(body.get('mass', 0.0))} at {_words(body.get('center_of_gravity', []))} m",
        )
    for kind in ("joint", "constraint", "force", "wave", "morison", "controller"):
        for entry in tables.get(kind, []):
            yield kind, str(entry.get("name", "")), str(entry.get("type", "")), _place(entry)


def _place(entry: Mapping[str, Any]) -> str:
    if "significant_height" in entry:
        return f"Hs {entry['significant_height']:g} m, Tp {entry.get('peak_period', 0):g} s"
    if "period" in entry and "height" in entry:
        return f"H {entry['height']:g} m, T {entry['period']:g} s"
    words = [str(entry[key]) for key in ("body_a", "body_b") if key in entry]
    if words:
        return " - ".join(words)
    return next((str(entry[key]) for key in ("joint", "body") if key in entry), "")


def rungs(tables: Tables) -> Iterator[tuple[str, str]]:
    """Rows of effect and the model that the case uses for it (docs/ladders.md)."""
    hydro = tables.get("hydro")
    forces = [str(force.get("type", "")) for force in tables.get("force", [])]
    motions = sorted({_words(b.get("motion", "rigid")) for b in tables.get("body", [])})
    yield "bodies", ", ".join(motions)
    yield "joints", "rigid, by multipliers" + (", compliant too" * ("bushing" in forces))
    if hydro is None:
        yield "water", "none"
    else:
        yield "hydrodynamics", f"linear potential flow, {hydro.get('axes', 'mean')} axes"
        yield "radiation", str(hydro.get("radiation", "exponential"))
        yield "hydrostatics", "linear, about the pose of the database"
        waves = sorted({str(wave.get("type", "")) for wave in tables.get("wave", [])})
        yield "waves", ", ".join(waves) or "still water"
    for effect, kinds in _LADDERS.items():
        used = [name for name in dict.fromkeys(forces) if name.startswith(kinds)]
        if effect == "drag" and tables.get("morison"):
            used.append("morison")
        yield effect, ", ".join(used) or "none"
    yield "motion", f"time domain, method {tables.get('solver', {}).get('method', 'auto')}"


#: How the types of forces begin that have an effect.
_LADDERS = {
    "power take-offs": ("pto_", "python_load", "library_load"),
    "moorings and ropes": ("mooring_matrix", "spring_damper", "rope", "catenary", "line"),
    "drag": ("viscous_damping",),
    "friction": ("friction_", "dry_friction"),
    "end stops": ("end_stop",),
}


@matplotlib.rc_context(STYLE)
def sketch(tables: Tables) -> Figure:
    """Draw the reference pose from the side: centres of gravity, joints, lines, water line."""
    figure = Figure(figsize=(8.0, 3.6), layout="constrained")
    axes = figure.subplots()
    axes.axhline(0.0, color=COLORS[5], linewidth=1.5, zorder=0)
    for force in tables.get("force", []):
        ends = [force.get("point_a"), force.get("point_b")]
        if all(isinstance(end, list) for end in ends):
            axes.plot(*np.array(ends, dtype=float)[:, [0, 2]].T, color="#888888", linewidth=1.0)
    for k, body in enumerate(tables.get("body", [])):
        x, _, z = body["center_of_gravity"]
        axes.plot(x, z, "o", color=COLORS[k % len(COLORS)], markersize=8)
        axes.annotate(str(body.get("name", "")), (x, z), (6, 6), textcoords="offset points")
    for joint in tables.get("joint", []):
        if isinstance(joint.get("point"), list):
            x, _, z = joint["point"]
            axes.plot(x, z, "s", color="black", markersize=5, markerfacecolor="none")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("z [m]")
    axes.margins(0.15)
    axes.set_aspect("equal", adjustable="datalim")
    return figure


def _mass(value: float | str) -> str:
    """A mass, or the word that stands for it."""
    return f"mass {value}" if isinstance(value, str) else f"{value:,.6g} kg"


def _words(value: Any) -> str:
    return (
        ", ".join(f"{x:zg}" if isinstance(x, float) else str(x) for x in value)
        if isinstance(value, list)
        else str(value)
    )
