"""Loads on bodies whose pressure is taken on a mesh: one panel for each direction, load by load."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from hydrodae.case.contents import tables_of
from hydrodae.pictures.panels import Panel, scaled, select

if TYPE_CHECKING:
    from hydrodae.results import Results

#: Names of the components x, y, z.
DIRECTIONS = {"force": ("surge", "sway", "heave"), "moment": ("roll", "pitch", "yaw")}
#: Loads that are the sum of others, one of which is named.
SUMS = {"pressure": "static_pressure", "excitation": "diffraction"}
#: What the weight rests on: each alone is far larger than what moves the body.
STATIC = ("static_pressure", "hydrostatic")
LABELS = {"wave_pressure": "wave pressure (Froude-Krylov)", "added_mass_inf": "added mass"}
#: These come first, so that a load has one colour in all panels.
FIRST = (*STATIC, "wave_pressure", "diffraction", "excitation", "radiation", "added_mass_inf")
#: Lines of a smaller part of the largest span of the forces (or moments) on a body are left out.
LEAST = 1e-3


def load_panels(results: Results) -> list[Panel]:
    """Panels of the loads on each body that has a mesh: surge, sway, heave, roll, pitch, yaw.

    The lines of a panel add up to the whole load but for reactions of joints. Weight and static
    pressure are one line. Directions and lines in which hardly anything changes are left out.
    """
    tables = tables_of(results.case_text, str(results.header.get("case_overrides", "")))
    names = [body["name"] for body in tables.get("body", []) if "mesh" in body]
    return [
        panel for name in names for kind in DIRECTIONS for panel in _panels(results, name, kind)
    ]


def _panels(results: Results, body: str, kind: str) -> list[Panel]:
    """Panels of the forces or moments on a body, in the order of the axes."""
    loads = {name.split("/")[1]: name for name in results.channels(f"forces/*/{body}/{kind}")}
    order = [load for load in FIRST if load in loads]
    order += [load for load in loads if load not in (*FIRST, "weight")]
    parts = [load for load in order if SUMS.get(load) not in loads]
    if not parts:
        return []
    panels = []
    for i, direction in enumerate(DIRECTIONS[kind]):
        lines = []
        for load in parts:
            line = replace(select(results, loads[load])[i], label=_label(load, loads))
            if load in STATIC and "weight" in loads:
                line = replace(line, values=line.values + results[loads["weight"]].to_numpy()[:, i])
            lines.append(line)
        panels.append(Panel(f"{body}\n{direction} {kind}", lines[0].unit, lines))
    least = LEAST * max(line.span for panel in panels for line in panel.lines)
    kept = [[line for line in panel.lines if line.span > least] for panel in panels]
    return [
        scaled(replace(panel, lines=lines))
        for panel, lines in zip(panels, kept, strict=True)
        if lines
    ]


def _label(load: str, loads: dict[str, str]) -> str:
    """Name of a load in the legend."""
    if load in STATIC and "weight" in loads:
        return f"{load.replace('_', ' ')} and weight"
    if load == "excitation" and "wave_pressure" in loads:
        return "diffraction"  # the pressure on the mesh has the rest of it
    return LABELS.get(load, load.replace("_", " "))
