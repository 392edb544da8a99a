"""MoorDyn's input files as tables of a case: lines at rest (`catenary`) or dynamic (`line`)."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.mooring.imported import Imported
from hydrodae.mooring.line_at_rest import catenary
from hydrodae.mooring.moordyn_chains import Chain, find_chains
from hydrodae.mooring.moordyn_deck import Deck, Line, Point, read_deck
from hydrodae.mooring.moordyn_lines import CARRIED, is_zero, line_keys, lost_of
from hydrodae.mooring.moordyn_places import COUPLED, Places, poses
from hydrodae.mooring.moordyn_rigid import add_rigid_bodies, note_clamps
from hydrodae.mooring.moordyn_seabed import SEABED_OPTIONS, seabed_of
from hydrodae.support.arrays import Array

_CARRIED = ("g", "rho", *SEABED_OPTIONS)


def read_moordyn(
    path: str | os.PathLike[str],
    *,
    body: str = "platform",
    at: Sequence[float] | Mapping[str, Sequence[float]] | None = None,
    bodies: Mapping[str, str] | None = None,
    type: Literal["line", "catenary"] = "line",
) -> Imported:
    """Read a MoorDyn input file, version 1 or 2, as tables of a case.

    Lines in series from an anchor to a body become one force of type `line` or `catenary`, with the
    masses and floats between them as its attachments or loads. A free point where more than two
    lines meet becomes a point mass, and so does one with a mass at the end of a line. Free bodies
    and rods that lines end at become rigid bodies. What cannot be carried over is in
    `Imported.notes`.

    Parameters
    ----------
    path : path
        The file.
    body : str
        Body of the case that coupled points (those of a vessel) belong to, or the only coupled body
        of the file.
    at : (3,) or (6,) floats, or mapping from str to them, optional
        Where the origin of the coupled points is in the reference pose of the case, world axes [m],
        and how it is turned: roll, pitch, yaw [deg]. Of bodies of the file by their numbers:
        ``{"1": (0, 0, -2)}``; by default they are where the file has them. Key "": coupled points.
    bodies : mapping from str, optional
        Bodies of the case for those of the file, by their numbers there: ``{"1": "float"}``; for
        turbines of a farm ``{"turbine1": "float"}``, for rods ``{"rod1": "float"}``.
    type : {"line", "catenary"}
        Dynamic lines with the segments, damping, drag, added mass, bending and seabed of the file,
        or lines at rest at each instant.

    Raises
    ------
    CaseError
        The file cannot be read, or it has something without which its moorings would be others:
        several tables of stiffness in one line, a table or a seabed that is not flat for a
        `catenary`, free bodies or rods at the surface, or stiff lines that a rod clamps. A line at
        rest lies in a way that `catenary` does not know.
    """
    if type not in _DYNAMIC:
        raise CaseError(f"type: expected 'catenary' or 'line' instead of {type!r}")
    deck = read_deck(path)
    names = {COUPLED: body} | {key.lower(): name for key, name in (bodies or {}).items()}
    return _Conversion(deck, Places(deck, names, poses(at)), _DYNAMIC[type]).run()


#: Types of lines that there are, and whether they have a motion of their own.
_DYNAMIC = {"catenary": False, "line": True}


class _Conversion:
    """From a deck to tables."""

    def __init__(self, deck: Deck, places: Places, dynamic: bool) -> None:
        self.deck, self.places, self.dynamic = deck, places, dynamic
        self.out = Imported(deck.file.name)
        self.depth, self.assumed_depth = self._depth()

    def run(self) -> Imported:
        deck = self.deck
        chains, junctions = find_chains(deck)
        note = self.out.note
        for text in deck.notes:
            note(text)
        if self.dynamic:
            note(
                f"lines are in water of {deck.density:g} kg/m3 (water_density); g = "
                f"{deck.gravity:g} m/s2 in the file, the case has its own in [environment]"
            )
            note(
                "damping as in MoorDyn: of segments in slack ones too (damps_slack), "
                "of the seabed on the way up too (seabed_damps_up)"
            )
        else:
            note(
                f"weights in water of {deck.density:g} kg/m3 with g = {deck.gravity:g} m/s2; the "
                "case sets its own in [environment]"
            )
        if not self.depth and not self.out.seabed:
            note("no depth in the file, and no anchor: the seabed is that of the case")
        elif self.assumed_depth:
            note(
                f"no depth down to the lowest anchor in the file: the seabed is there, at z = "
                f"{-self.depth:g} m"
            )
        hanging = [chain.ends[1].id for chain in chains if chain.hangs and self.dynamic]
        for point in junctions:
            if point.id not in hanging:
                self._junction(point)
        for chain in chains:
            self._chain(chain)
        add_rigid_bodies(deck, self.places, self.out)
        self.places.check()
        for text, row in self.places.notes():
            note(text, row.number)
        self._note_types()
        if self.dynamic and not deck.option("wavekin", 0.0):
            note("lines feel no waves, as in the file; waves = true lets them")
        self._note_bodies()
        self._note_rest()
        return self.out

    def _depth(self) -> tuple[float, bool]:
        """Depth of the seabed, and whether it is that of the lowest anchor, as in MoorDyn."""
        deck = self.deck
        if bed := seabed_of(deck):
            if not self.dynamic:
                raise bed.row.fail(
                    "the seabed is not flat, and a line at rest has a flat one; import it as a "
                    "dynamic line, --type line, or write one depth [m] as WtrDpth in place of the "
                    "file"
                )
            self.out.seabed = bed.table()
            text = "seabed: smooth between the points of its file, in MoorDyn bilinear"
            self.out.note(text, bed.row.number)
            return 0.0, False
        depth = deck.option("wtrdpth", 0.0)
        fixed = [p.place[2] for p in deck.points.values() if p.attachment == "fixed"]
        lowest = -min(fixed, default=0.0)
        return max(depth, lowest), depth < lowest

    def _net_weight(self, point: Point, density: float) -> float:
        """Weight in water, or in air of density 0, less the force that the file gives [N]."""
        return (point.mass - density * point.volume) * self.deck.gravity - point.force[2]

    def _chain(self, chain: Chain) -> None:
        (body_a, place_a), (body_b, place_b) = map(self.places.owner, chain.ends)
        label = ("line " if len(chain.lines) == 1 else "lines ") + ", ".join(
            line.id for line in chain.lines
        )
        if self.dynamic:
            self._dynamic_line(chain, label, (body_a, place_a), (body_b, place_b))
            return
        self._line_at_rest(chain, label, (body_a, place_a), (body_b, place_b))

    def _dynamic_line(
        self, chain: Chain, label: str, a: tuple[str, Array], b: tuple[str, Array]
    ) -> None:
        first, note = chain.lines[0].row.number, self.out.note
        for text, row in note_clamps(chain, self.deck):
            note(text, row.number)
        table: dict[str, Any] = {
            "type": "line",
            "name": "line" + "_".join(line.id for line in chain.lines),
            "body_a": a[0],
            "body_b": b[0],
            "point_a": a[1].tolist(),
            "point_b": b[1].tolist(),
            **line_keys(self.deck, chain, self.depth),
        }
        if chain.hangs:
            del table["body_b"]
            table["free_end"] = True
            text = f"{label}: point {chain.ends[1].id} is a free end, at rest at the start"
            note(text, chain.ends[1].row.number)
        if table["segments"] != [line.segments for line in chain.lines]:
            note(f"{label}: two segments in place of one, the fewest that a line has", first)
        if "curve_strain" in table:
            note(
                f"{label}: tension from a table, by a smooth curve through its points that goes on "
                "with its last slope; MoorDyn goes straight from point to point, and holds the "
                "last tension",
                next(line.type.row.number for line in chain.lines if line.type.curve),
            )
        self.out.forces.append(table)

    def _line_at_rest(
        self, chain: Chain, label: str, a: tuple[str, Array], b: tuple[str, Array]
    ) -> None:
        for line in chain.lines:
            if line.type.curve:
                raise line.row.fail(
                    f"{label}: a line at rest has one stiffness, and type {line.type.name!r} has a "
                    "table; import it as a dynamic line, --type line, or write a number as EA"
                )
        on_bed = abs(a[1][2] + self.depth) <= 1e-3 * self.depth
        lies = self.depth > 0.0 and a[0] == "ground" and on_bed
        table: dict[str, Any] = {
            "type": "catenary",
            "name": "line" + "_".join(line.id for line in chain.lines),
            "body_a": a[0],
            "body_b": b[0],
            "point_a": a[1].tolist(),
            "point_b": b[1].tolist(),
            "length": [line.length for line in chain.lines],
            "weight": [self._weight(line, self.deck.density) for line in chain.lines],
            "dry_weight": [self._weight(line, 0.0) for line in chain.lines],
            "stiffness": [line.type.stiffness for line in chain.lines],
        }
        for key, density in (("loads", self.deck.density), ("dry_loads", 0.0)):
            loads = [self._net_weight(point, density) for point in chain.between]
            if any(loads):
                table[key] = loads
        if not lies:
            table["seabed"] = False
        self._check_at_rest(chain, label, table)
        self.out.forces.append(table)
        for point in chain.between:
            self._note_between(point)

    def _check_at_rest(self, chain: Chain, label: str, table: dict[str, Any]) -> None:
        """Refuse what a line at rest cannot do where its ends are, or say how far it hangs."""
        row = chain.lines[0].row
        way = np.subtract(table["point_b"], table["point_a"])
        given = ("loads", "dry_weight", "dry_loads", "seabed")
        keys = {key: table[key] for key in given if key in table}
        keys["surface"] = -table["point_a"][2]
        parts = (table["length"], table["weight"], table["stiffness"])
        try:
            line = catenary(float(np.hypot(way[0], way[1])), float(way[2]), *parts, **keys, n=1001)
        except CaseError as error:
            raise row.fail(f"{label}: {error}; import it as a dynamic line, --type line") from None
        if table.get("seabed", True):
            return
        lowest = table["point_a"][2] + float(line.z.min())
        guessed = any(point.attachment == "free" for point in chain.ends)
        if lowest < -1.001 * self.depth and self.depth > 0.0 and not guessed:
            raise row.fail(
                f"{label}: between its ends it hangs down to z = {lowest:.4g} m, the seabed is at "
                f"{-self.depth:g} m, which a line at rest feels only at its anchor; import it as a "
                "dynamic line, --type line"
            )
        self.out.note(
            f"{label}: end A is not on the seabed, z = {-self.depth:g} m, which is not felt; it "
            f"hangs down to z = {lowest:.4g} m where its ends are",
            row.number,
        )

    def _weight(self, line: Line, density: float) -> float:
        area = 0.25 * math.pi * line.type.diameter**2
        return (line.type.mass - density * area) * self.deck.gravity

    def _note_between(self, point: Point) -> None:
        lost = [
            f"{what} {value:g}{unit}"
            for what, value, unit in (
                ("inertia of", point.mass, " kg"),
                ("drag area", point.drag_area, " m2"),
                ("added mass coefficient", point.added_mass, ""),
            )
            if value
        ]
        if lost:
            self.out.note(
                f"point {point.id}: without {', '.join(lost)}: loads between parts of a line at "
                "rest have weight only",
                point.row.number,
            )

    def _junction(self, point: Point) -> None:
        """A free point as a point mass, with half of the segments next to it, as in MoorDyn."""
        lumped = sum(
            0.5 * line.type.mass * line.length / line.segments
            for line in self.deck.lines
            for end in line.ends
            if end == point.id
        )
        name = f"point{point.id}"
        body: dict[str, Any] = {
            "name": name,
            "motion": "point",
            "mass": point.mass + lumped,
            "center_of_gravity": list(point.place),
        }
        if point.volume:
            body["volume"] = point.volume
        self.out.bodies.append(body)
        force = [point.force[0], point.force[1], lumped * self.deck.gravity + point.force[2]]
        self.out.forces.append(
            {"type": "constant_load", "name": f"{name}_lift", "body": name, "force": force}
        )
        self.out.note(
            f"point {point.id} is body {name}, with {lumped:g} kg of the segments next to it "
            f"({name}_lift: their weight, which the lines hold)",
            point.row.number,
        )
        if not (point.drag_area or point.added_mass * point.volume):
            return
        table: dict[str, Any] = {
            "name": f"{name}_water",
            "body": name,
            "point": list(point.place),
            "area": point.drag_area,
            "volume": point.volume,
            "drag_coefficient": 1.0,
        }
        if point.added_mass * point.volume:
            table["added_mass_coefficient"] = point.added_mass
        self.out.morison.append(table)

    def _note_types(self) -> None:
        for line in {line.type.name: line for line in self.deck.lines}.values():
            kind = line.type
            lost = [f"{key} {text}" for key, text in kind.others.items() if not is_zero(text)]
            why = ": a line at rest has no damping, bending, drag or added mass"
            if self.dynamic:
                lost, why = lost_of(line), ""
            if lost:
                text = f"line type {kind.name}: without {', '.join(lost)}{why}"
                self.out.note(text, kind.row.number)

    def _is_part(self, point: Point) -> bool:
        """Whether its mass and volume are in the tables of a free body."""
        return point.attachment.removeprefix("body") in self.places.made

    def _note_bodies(self) -> None:
        for body in self.deck.bodies.values():
            if body.attachment != "fixed" and body.id not in self.places.made:
                known = body.id in self.places.used and self.places.names[body.id]
                lost = ": left out, no line ends at it"
                text = f" is {known}: mass, volume and drag are those of the case"
                self.out.note(f"body {body.id}{text if known else lost}", body.row.number)

    def _note_rest(self) -> None:
        deck, note = self.deck, self.out.note
        ends = {end for line in deck.lines for end in line.ends}
        for point in deck.points.values():
            if point.rod or self._is_part(point):
                continue
            if point.id not in ends:
                note(f"point {point.id}: left out, no line ends at it", point.row.number)
            elif point.attachment != "free" and (point.mass or point.volume or point.drag_area):
                note(
                    f"point {point.id}: mass {point.mass:g} kg, volume {point.volume:g} m3 and "
                    f"drag area {point.drag_area:g} m2 left out: they are those of its body",
                    point.row.number,
                )
        carried = _CARRIED + (CARRIED if self.dynamic else ())
        if not self.dynamic and deck.option("frictioncoefficient", 0.0):
            note(
                f"friction of the seabed {deck.options['frictioncoefficient']}: left out; it acts "
                "against a velocity in MoorDyn, and is zero at rest",
                deck.rows["frictioncoefficient"].number,
            )
            carried += ("frictioncoefficient",)
        unused = [key for key in deck.options if key not in carried]
        others = [f"{key} {deck.options[key]}" for key in unused]
        if others:
            note(
                f"options of dynamic lines, not used: {', '.join(others)}",
                deck.rows[unused[0]].number,
            )
        for name, rows in deck.unread.items():
            note(f"section {name.upper()}: left out ({len(rows)} lines)", rows[0].number)
        if deck.outputs:
            note(
                f"outputs: left out ({', '.join(deck.outputs)}); forces/NAME/tension is at end B "
                "(FAIRTEN), tension_anchor at end A (ANCHTEN)",
                deck.rows["outputs"].number,
            )
