"""Reader of MoorDyn's input files, versions 1 and 2 (moordyn.readthedocs.io, "Input Files")."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

from hydrodae.errors import CaseError
from hydrodae.mooring.moordyn_columns import LINES_BY_PLACE, OPTIONS, TYPES_BY_PLACE
from hydrodae.mooring.moordyn_sections import Row, Section, named_file, number, read_sections

#: Other spellings of the options that are read.
_SPELLINGS = {
    "rhow": "rho",
    "wtrdnsty": "rho",
    "wtrdens": "rho",
    "depth": "wtrdpth",
    "wtrdepth": "wtrdpth",
    "waterdepth": "wtrdpth",
    "gravity": "g",
    "kb": "kbot",
    "cb": "cbot",
    "mu_ka": "frictioncoefficient",
}
_ATTACHMENTS = {
    **dict.fromkeys(("fixed", "fix", "anchor"), "fixed"),
    **dict.fromkeys(("coupled", "cpld", "vessel", "ves", "fairlead"), "coupled"),
    **dict.fromkeys(("free", "point", "connect", "con"), "free"),
}
#: Of points that belong to something with a number.
_OWNERS = {"body": "body", "b": "body", "turbine": "turbine", "t": "turbine"}


@dataclass(frozen=True)
class Type:
    """Properties of a line: those that a line at rest has, and all others by their names."""

    name: str
    diameter: float  #: of a cylinder of the same volume [m]
    mass: float  #: [kg/m]
    stiffness: float  #: EA [N]; of a table: tension over strain at its end
    others: dict[str, str]  #: by the names of version 2
    row: Row
    curve: tuple[tuple[float, float], ...] = ()  #: of a table: strain [-] and tension [N]


@dataclass(frozen=True)
class Point:
    """An end of lines."""

    id: str
    attachment: str  #: lower case: fixed, coupled, free, bodyN, turbineN, or what else is there
    place: tuple[float, float, float]  #: [m], of bodies: from their reference points
    mass: float  #: [kg]
    volume: float  #: [m3]
    force: tuple[float, float, float]  #: of version 1 [N]
    drag_area: float  #: [m2]
    added_mass: float
    row: Row
    rod: str = ""  #: whose end this is

    @property
    def is_bare(self) -> bool:
        """Whether it is free, and nothing is there."""
        loads = (self.mass, self.volume, self.drag_area, *self.force)
        return self.attachment == "free" and not any(loads)


@dataclass(frozen=True)
class Line:
    """A line of one type between two points."""

    id: str
    type: Type
    ends: tuple[str, str]  #: points A and B
    length: float  #: unstretched [m]
    segments: int
    row: Row


@dataclass(frozen=True)
class Body:
    """A body of the file."""

    id: str
    attachment: str  #: lower case
    place: tuple[float, float, float]  #: [m]
    angles: tuple[float, float, float]  #: roll, pitch, yaw [deg]
    mass: float  #: [kg]
    centre: tuple[float, float, float]  #: of gravity, from the place in axes of the body [m]
    inertia: tuple[float, float, float]  #: moments about that centre, axes of the body [kg m2]
    volume: float  #: [m3]
    drag_area: float  #: [m2]
    added_mass: float
    row: Row


@dataclass(frozen=True)
class Rod:
    """A rigid cylinder between two points, or the clamp of lines where its length is zero."""

    id: str
    attachment: str  #: as that of a point; with "pinned" after it: only its place is held
    type: Row
    ends: tuple[tuple[float, float, float], tuple[float, float, float]]  #: A and B [m]
    row: Row


@dataclass
class Deck:
    """A MoorDyn input file."""

    file: Path
    version: int
    points: dict[str, Point] = field(default_factory=dict)
    lines: list[Line] = field(default_factory=list)
    bodies: dict[str, Body] = field(default_factory=dict)
    rods: dict[str, Rod] = field(default_factory=dict)
    options: dict[str, str] = field(default_factory=dict)  #: by lower-case key
    outputs: list[str] = field(default_factory=list)
    unread: dict[str, list[Row]] = field(default_factory=dict)  #: rows of other sections
    rows: dict[str, Row] = field(default_factory=dict)  #: of options; of the first "outputs"
    notes: list[str] = field(default_factory=list)  #: on how it was read

    def option(self, key: str, default: float) -> float:
        """Return a number among the options."""
        try:
            return float(self.options.get(key, default))
        except ValueError:
            raise CaseError(
                f"{self.file}: option {key}: expected a number instead of {self.options[key]!r}"
            ) from None

    @property
    def gravity(self) -> float:
        """Acceleration of gravity [m/s2]."""
        return self.option("g", 9.80665 if self.version == 1 else 9.81)

    @property
    def density(self) -> float:
        """Density of the water [kg/m3]."""
        return self.option("rho", 1025.0)


def read_deck(path: str | os.PathLike[str]) -> Deck:
    """Read a MoorDyn input file.

    Raises
    ------
    CaseError
        It is none, or a line of it cannot be understood; with the number of the line.
    """
    file = Path(path)
    if not file.is_file():
        raise CaseError(f"{file}: no such file")
    sections = read_sections(file)
    for needed in ("types", "points", "lines"):
        if needed not in sections:
            raise CaseError(
                f"{file}: no section with the {needed} of a MoorDyn input file; what has no lines "
                "is no mooring: write its bodies and rods as [[body]] and [[morison]] of the case"
            )
    old = "DICTIONARY" in sections["types"].heading or "NODE PROP" in sections["points"].heading
    deck = Deck(file, 1 if old or "fx" in sections["points"].columns else 2)
    types = _by_id((t.name, row, t) for row in sections["types"].rows for t in [_type(row)])
    deck.points = _by_id((p.id, p.row, p) for p in map(_point, sections["points"].rows))
    rod_types = {row.text("name"): row for row in sections.get("rod types", Section("")).rows}
    rods = sections.get("rods", Section("")).rows
    deck.rods = _by_id((r.id, r.row, r) for r in (_rod(row, rod_types) for row in rods))
    deck.points |= {p.id: p for rod in deck.rods.values() for p in _rod_ends(rod)}
    joined = [rod.id for rod in deck.rods.values() if rod.ends[0] == rod.ends[1]]
    lines = _by_id(
        (n.id, n.row, n) for n in (_line(r, types, joined) for r in sections["lines"].rows)
    )
    deck.lines = list(lines.values())
    bodies = sections.get("bodies", Section(""))
    deck.bodies = _by_id((b.id, b.row, b) for b in map(_body, bodies.rows))
    for row in sections.get("options", Section("")).rows:
        key, value = _option(row)
        deck.options[key], deck.rows[key] = value, row
    outputs = [word for row in sections.get("outputs", Section("")).rows for word in row.words]
    deck.outputs = [word for word in outputs if word.upper() != "END"]
    read = ("types", "points", "lines", "bodies", "rod types", "rods", "options", "outputs")
    if deck.outputs:
        deck.rows["outputs"] = sections["outputs"].rows[0]
    deck.unread = {n: s.rows for n, s in sections.items() if n not in read and s.rows}
    if deck.version > 1:
        deck.notes = _other_order(sections)
    return deck


_T = TypeVar("_T")


def _by_id(found: Iterable[tuple[str, Row, _T]]) -> dict[str, _T]:
    out: dict[str, _T] = {}
    for id, row, what in found:
        if id in out:
            raise row.fail(f"{id!r} is there twice")
        out[id] = what
    return out


def _option(row: Row) -> tuple[str, str]:
    """Key and value of an option: the value comes first."""
    if len(row.words) < 2:
        raise row.fail(f"expected the key of an option after {row.words[0]!r}")
    key = row.words[1].strip(",:").lower()
    if key not in OPTIONS:
        near = difflib.get_close_matches(key, sorted(OPTIONS), 1)
        raise row.fail(
            f"unknown option {row.words[1]!r}; a value comes first, then its key"
            + (f"; is it {near[0]}?" if near else "")
        )
    return _SPELLINGS.get(key, key), row.words[0].strip("\"'")


def _other_order(sections: dict[str, Section]) -> list[str]:
    """Say where MoorDyn 2, which takes columns by their places, reads other numbers."""
    out = []
    for name, by_place in (("types", TYPES_BY_PLACE), ("lines", LINES_BY_PLACE)):
        section = sections[name]
        order = section.columns[: len(by_place)]
        if section.rows and tuple(order) != by_place:
            out.append(
                f"{section.heading}: columns are taken by their names "
                f"({' '.join(section.written)}); MoorDyn 2 takes them by place, in another order"
            )
    return out


_OTHERS = ("BA", "EI", "Cd", "Ca", "CdAx", "CaAx", "Cl", "dF", "cF")


def _type(row: Row) -> Type:
    static, *dynamic = row.text("EA").split("|")
    if dynamic and not is_number(static):
        raise row.fail(
            f"line type {row.text('name')!r}: the stiffness {row.text('EA')!r} follows the history "
            "of the rope; a line takes one number EA [N]: write the slope of its tension over "
            "strain at the mean tension, or a file of strain and tension"
        )
    curve = () if is_number(static) else _curve(row, static)
    further = {key: row.text(key) for key in _OTHERS if row.has(key)}
    further["BA"], *viscous = further["BA"].split("|")
    if dynamic:
        further["dynamic EA"] = "|".join(dynamic)
    if viscous:
        further["dynamic BA"] = "|".join(viscous)
    return Type(
        row.text("name"),
        row.value("diameter", "the diameter"),
        row.value("mass", "the mass per length"),
        curve[-1][1] / curve[-1][0] if curve else number(row, static, "the stiffness EA"),
        further,
        row,
        curve,
    )


def _curve(row: Row, name: str) -> tuple[tuple[float, float], ...]:
    """Read the file of a line type: rows of strain [-] and tension [N] below a head."""
    file = named_file(row.file, name)
    label = f"line type {row.text('name')!r}: the table {name!r} of strain and tension"
    try:
        rows = file.read_text().splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise row.fail(f"{label} cannot be read: {error}") from None
    found = list[tuple[float, float]]()
    for place, text in enumerate(rows, start=1):
        words = text.replace(",", " ").split()
        if len(words) == 2 and all(is_number(word) for word in words):
            found.append((float(words[0]), float(words[1])))
        elif words and found:
            raise CaseError(
                f"{file}:{place}: {text.strip()!r}: expected a strain and a tension [N]"
            )
    if len(found) < 2 or found[0] != (0.0, 0.0):
        raise row.fail(f"{label} needs two rows or more, the first of them '0 0'")
    return tuple(found)


def is_number(text: str) -> bool:
    """Whether this is a number."""
    try:
        float(text)
    except ValueError:
        return False
    return True


def _point(row: Row) -> Point:
    return Point(
        row.text("id"),
        _attachment(row.text("attachment").lower()),
        _three(row, "xyz", "a coordinate"),
        row.value("mass", "the mass"),
        row.value("volume", "the volume"),
        _three(row, ("fx", "fy", "fz"), "a force", 0.0),
        row.value("CdA", "the drag area"),
        row.value("Ca", "the added mass coefficient"),
        row,
    )


def _attachment(word: str) -> str:
    owner = re.fullmatch(r"([a-z]+)(\d+)", word)
    if owner and owner[1] in _OWNERS:
        return _OWNERS[owner[1]] + owner[2]
    return _ATTACHMENTS.get(word, word)


def _rod(row: Row, types: dict[str, Row]) -> Rod:
    kind, word = row.text("type"), row.text("attachment").lower()
    if kind not in types:
        raise row.fail(f"no rod type {kind!r}; there are: {', '.join(types)}")
    held, pinned, rest = word.partition("pinned")
    if rest or (pinned and _attachment(held) in ("", "free")):
        raise row.fail(f"rod {row.text('id')}: unknown attachment {row.text('attachment')!r}")
    a, b = (_three(row, [axis + end for axis in "xyz"], "a coordinate") for end in "ab")
    # ends of a rod without segments are one place, whatever B is
    ends = (a, b if row.value("segments", "the number of segments") else a)
    return Rod(row.text("id"), _attachment(held) + pinned, types[kind], ends, row)


def _rod_ends(rod: Rod) -> list[Point]:
    """Points that lines end at: both ends of a rod, or one for a rod of no length."""
    names = [f"R{rod.id}A", f"R{rod.id}B"]
    attachment = rod.attachment
    if rod.ends[0] == rod.ends[1]:
        names, attachment = [f"R{rod.id}"], attachment.removesuffix("pinned")
    elif attachment == "free" or attachment.endswith("pinned"):
        attachment = f"rod{rod.id}"
    none = (0.0, 0.0, 0.0)
    return [
        Point(name, attachment, place, 0.0, 0.0, none, 0.0, 0.0, rod.row, rod.id)
        for name, place in zip(names, rod.ends, strict=False)
    ]


def _line(row: Row, types: dict[str, Type], joined: list[str]) -> Line:
    kind = row.text("type")
    if kind not in types:
        raise row.fail(f"no line type {kind!r}; there are: {', '.join(types)}")
    segments = row.value("segments", "the number of segments")
    length = row.value("length", "the unstretched length")
    if segments != int(segments) or segments < 1:
        raise row.fail(f"expected a whole number of segments instead of {row.text('segments')!r}")
    if length <= 0.0:
        raise row.fail(f"expected an unstretched length above 0 instead of {row.text('length')!r}")
    ends = (_end(row.text("a"), joined), _end(row.text("b"), joined))
    return Line(row.text("id"), types[kind], ends, length, int(segments), row)


def _end(word: str, joined: list[str]) -> str:
    """Number of the point that a line ends at, as 4, P4, Point4, C4, Con4; or R1A of a rod."""
    if rod := re.fullmatch(r"(?:r|rod)(\d+)([ab])", word.lower()):
        return f"R{rod[1]}" + ("" if rod[1] in joined else rod[2].upper())
    found = re.fullmatch(r"(?:c|con|p|point)?(\d+)", word.lower())
    return found[1] if found else word


def _body(row: Row) -> Body:
    word = row.text("attachment").lower()
    return Body(
        row.text("id"),
        _ATTACHMENTS.get(word, word),
        _three(row, "xyz", "a coordinate"),
        _three(row, ("rx", "ry", "rz"), "an angle"),
        row.value("mass", "the mass", 0.0),
        _centre(directions(row, "CG")),
        _three_of(directions(row, "I")),
        row.value("volume", "the volume", 0.0),
        _mean(directions(row, "CdA")),
        _mean(directions(row, "Ca")),
        row,
    )


def directions(row: Row, column: str) -> list[float]:
    """Return the numbers of a column of a body that takes several, as 1|2|3."""
    if not row.has(column):
        return [0.0]
    return [number(row, word, f"{column} of the body") for word in row.text(column).split("|")]


def _three_of(values: list[float]) -> tuple[float, float, float]:
    x, y, z = values if len(values) == 3 else 3 * values[:1]
    return (x, y, z)


def _centre(values: list[float]) -> tuple[float, float, float]:
    """A single number is z."""
    return _three_of(values) if len(values) == 3 else (0.0, 0.0, values[0])


def _mean(values: list[float]) -> float:
    """Mean of three directions; numbers of rotation may follow them."""
    return sum(values[:3]) / 3 if len(values) > 2 else values[0]


def _three(
    row: Row, columns: Iterable[str], what: str, default: float | None = None
) -> tuple[float, float, float]:
    x, y, z = (row.value(column, what, default) for column in columns)
    return (x, y, z)
