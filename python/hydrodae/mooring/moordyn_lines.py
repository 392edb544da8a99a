"""Lines of a MoorDyn input file on the rung of dynamic lines (`line`)."""

from __future__ import annotations

import math
from typing import Any

from hydrodae.mooring.moordyn_chains import Chain
from hydrodae.mooring.moordyn_deck import Deck, Line, Point
from hydrodae.mooring.moordyn_sections import number

#: Options that these tables hold, beside those of lines at rest.
CARRIED = ("kbot", "cbot", "wavekin", "frictioncoefficient")
#: Keys of a part by the names of MoorDyn.
_COEFFICIENTS = {
    "drag": "Cd",
    "drag_axial": "CdAx",
    "added_mass": "Ca",
    "added_mass_axial": "CaAx",
    "bending_stiffness": "EI",
}
_KNOWN = {*_COEFFICIENTS.values(), "BA"}
_BED_STIFFNESS, _BED_DAMPING = 3.0e6, 3.0e5  # MoorDyn's defaults [Pa/m, Pa s/m]


def line_keys(deck: Deck, chain: Chain, depth: float) -> dict[str, Any]:
    """Return the keys of a `line` beside its name and ends.

    Parameters
    ----------
    deck : Deck
        The file.
    chain : Chain
        Lines in series.
    depth : float
        Of the seabed [m]; 0: that of the case.

    Raises
    ------
    CaseError
        A coefficient is no number, or a force of the file pulls at a point between two lines.
    """
    table: dict[str, Any] = {
        "length": [line.length for line in chain.lines],
        "segments": [line.segments for line in chain.lines],
        "mass": [line.type.mass for line in chain.lines],
        "diameter": [line.type.diameter for line in chain.lines],
        "stiffness": [line.type.stiffness for line in chain.lines],
        "damping": [_damping(line) for line in chain.lines],
    }
    table |= _curve(chain, table)
    if table["segments"] == [1]:
        table["segments"] = [2]  # the fewest
    for key, name in _COEFFICIENTS.items():
        values = [_coefficient(line, name) for line in chain.lines]
        if any(values):
            table[key] = values
    if any(table["damping"]):
        table["damps_slack"] = True
    table |= _attachments(chain)
    if depth > 0.0:
        table["seabed_depth"] = depth
    table["seabed_stiffness"] = deck.option("kbot", _BED_STIFFNESS)
    table["seabed_damping"] = deck.option("cbot", _BED_DAMPING)
    if table["seabed_damping"]:
        table["seabed_damps_up"] = True
    if friction := deck.option("frictioncoefficient", 0.0):
        table["seabed_friction"] = friction
    if deck.density > 0.0:
        table["water_density"] = deck.density
    else:  # no water: only the width on the seabed is left of the diameter
        table["contact_diameter"] = table.pop("diameter")
        dry = ("drag", "drag_axial", "added_mass", "added_mass_axial")
        wet = ("attachment_volume", "attachment_drag_area", "attachment_added_mass")
        table = {key: value for key, value in table.items() if key not in dry + wet}
    if not deck.option("wavekin", 0.0):
        table["waves"] = False
    return {key: value for key, value in table.items() if value != []}


def _curve(chain: Chain, table: dict[str, Any]) -> dict[str, Any]:
    """Return the curve of the parts whose types have a table; it takes their stiffness."""
    curved = [i for i, line in enumerate(chain.lines) if line.type.curve]
    if not curved:
        return {}
    curves = {chain.lines[i].type.curve for i in curved}
    if len(curves) > 1:
        raise chain.lines[curved[1]].row.fail(
            "lines in series with two tables of strain and tension: a line takes one; give one of "
            "the types a number as EA, its slope at the mean tension"
        )
    keys: dict[str, Any] = {}
    keys["curve_strain"], keys["curve_tension"] = (
        list(axis) for axis in zip(*curves.pop(), strict=True)
    )
    if len(curved) == len(chain.lines):
        keys["stiffness"] = []
        return keys
    keys["curve_parts"] = [i + 1 for i in curved]
    keys["stiffness"] = [0.0 if i in curved else EA for i, EA in enumerate(table["stiffness"])]
    return keys


def lost_of(line: Line) -> list[str]:
    """Name the properties of the type of a line that a `line` does not hold."""
    return [
        f"{key} {text}"
        for key, text in line.type.others.items()
        if key not in _KNOWN and not is_zero(text)
    ]


def is_zero(text: str) -> bool:
    """Whether this is the number 0."""
    try:
        return float(text) == 0.0
    except ValueError:
        return False


def _damping(line: Line) -> float:
    """C [N s]; a negative BA is a part of the critical damping of a segment."""
    ba = _coefficient(line, "BA")
    if ba >= 0.0:
        return ba
    segment = line.length / line.segments
    return -ba * segment * math.sqrt(line.type.stiffness * line.type.mass)


def _coefficient(line: Line, name: str) -> float:
    text = line.type.others.get(name, "0")
    return number(line.row, text, f"{name} of line type {line.type.name!r}")


def _attachments(chain: Chain) -> dict[str, list[float]]:
    """What is at the points between the lines."""
    at, found = 0.0, list[tuple[float, Point]]()
    for line, point in zip(chain.lines, chain.between, strict=False):
        at += line.length
        if any(point.force):
            raise point.row.fail(
                f"point {point.id}: its force is not carried over to a line; make it a mass or a "
                "volume, or import lines at rest (--type catenary)"
            )
        if point.mass or point.volume or point.drag_area:
            found.append((at, point))
    if not found:
        return {}
    return {
        "attachment_at": [place for place, _ in found],
        "attachment_mass": [point.mass for _, point in found],
        "attachment_volume": [point.volume for _, point in found],
        "attachment_drag_area": [point.drag_area for _, point in found],
        "attachment_added_mass": [point.added_mass for _, point in found],
    }
