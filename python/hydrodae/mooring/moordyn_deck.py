"""Reader of MoorDyn's input files, versions 1 and 2 (moordyn.readthedocs.io, "Input Files")."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

from hydrodae.errors import CaseError
from hydrodae.mooring.moordyn_sections import Row, number, read_sections

#: Other spellings of the options that are read.
_SPELLINGS = {
    "rhow": "rho",
    "wtrdnsty": "rho",
    "depth": "wtrdpth",
    "wtrdepth": "wtrdpth",
    "gravity": "g",
    "kb": "kbot",
    "cb": "cbot",
}


@dataclass(frozen=True)
class Type:
    """Properties of a line: those that a line at rest has, and all others by their names."""

    name: str
    diameter: float  #: of a cylinder of the same volume [m]
    mass: float  #: [kg/m]
    stiffness: float  #: EA [N]
    others: dict[str, str]


@dataclass(frozen=True)
class Point:
    """An end of lines."""

    id: str
    attachment: str  #: lower case: fixed, coupled, free, or bodyN
    place: tuple[float, float, float]  #: [m], of bodies: from their reference points
    mass: float  #: [kg]
    volume: float  #: [m3]
    force: tuple[float, float, float]  #: of version 1 [N]
    drag_area: float  #: [m2]
    added_mass: float
    row: Row


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
    row: Row


@dataclass
class Deck:
    """A MoorDyn input file."""

    file: Path
    version: int
    points: dict[str, Point] = field(default_factory=dict)
    lines: list[Line] = field(default_factory=list)
    bodies: dict[str, Body] = field(default_factory=dict)
    options: dict[str, str] = field(default_factory=dict)  #: by lower-case key
    outputs: list[str] = field(default_factory=list)
    unread: dict[str, int] = field(default_factory=dict)  #: other sections: number of lines

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
    sections, headings, columns = read_sections(file)
    for needed in ("types", "points", "lines"):
        if needed not in sections:
            raise CaseError(f"{file}: no section with the {needed} of a MoorDyn input file")
    types = [_type(row) for row in sections["types"]]
    old_points = "NODE PROP" in headings["points"] or any(
        len(row.words) >= 12 for row in sections["points"]
    )
    old = old_points or "DICTIONARY" in headings["types"]
    deck = Deck(file, 1 if old else 2)
    deck.points = {p.id: p for p in (_point(row, old_points) for row in sections["points"])}
    by_name = {t.name: t for t in types}
    length_first = columns.get("lines", [])[2:3] == ["unstrlen"]  # in version 1
    deck.lines = [_line(row, by_name, length_first) for row in sections["lines"]]
    deck.bodies = {b.id: b for b in map(_body, sections.get("bodies", []))}
    for row in sections.get("options", []):
        key = row.word(1, "the key of an option").lower()
        deck.options[_SPELLINGS.get(key, key)] = row.words[0].strip("\"'")
    deck.outputs = [word for row in sections.get("outputs", []) for word in row.words]
    deck.outputs = [word for word in deck.outputs if word.upper() != "END"]
    read = ("types", "points", "lines", "bodies", "options", "outputs")
    deck.unread = {name: len(rows) for name, rows in sections.items() if name not in read and rows}
    return deck


_OTHERS_1 = ("BA", "Can", "Cat", "Cdn", "Cdt")
_OTHERS_2 = ("BA", "EI", "Cd", "Ca", "CdAx", "CaAx", "Cl", "dF", "cF")


def _type(row: Row) -> Type:
    others = _OTHERS_1 if len(row.words) <= 9 else _OTHERS_2
    stiffness = row.word(3, "the stiffness EA")
    static, *dynamic = stiffness.split("|")
    try:
        float(static)
    except ValueError:
        raise row.fail(
            f"line type {row.words[0]!r}: the stiffness {static!r} is a file; a line at rest "
            "takes one number EA"
        ) from None
    further = dict(zip(others, row.words[4:], strict=False))
    if dynamic:
        further["dynamic EA"] = "|".join(dynamic)
    return Type(
        row.words[0],
        row.value(1, "the diameter"),
        row.value(2, "the mass per length"),
        number(row, static, "the stiffness EA"),
        further,
    )


def _point(row: Row, old: bool) -> Point:
    place = _three(row, 2, "a coordinate")
    mass, volume = row.value(5, "the mass"), row.value(6, "the volume")
    force = _three(row, 7, "a force") if old else (0.0, 0.0, 0.0)
    last = 10 if old else 7
    word = row.words[1].lower()
    known = {"fix": "fixed", "anchor": "fixed", "vessel": "coupled", "ves": "coupled"}
    known |= {"cpld": "coupled", "con": "free", "connect": "free", "point": "free"}
    return Point(
        row.words[0],
        known.get(word, word),
        place,
        mass,
        volume,
        force,
        row.value(last, "the drag area"),
        row.value(last + 1, "the added mass coefficient"),
        row,
    )


def _line(row: Row, types: dict[str, Type], length_first: bool) -> Line:
    kind = row.word(1, "the type of the line")
    if kind not in types:
        raise row.fail(f"no line type {kind!r}; there are: {', '.join(types)}")
    length, segments, a, b = (2, 3, 4, 5) if length_first else (4, 5, 2, 3)
    count = row.value(segments, "the number of segments")
    return Line(
        row.words[0],
        types[kind],
        (row.word(a, "end A"), row.word(b, "end B")),
        row.value(length, "the unstretched length"),
        int(count),
        row,
    )


def _body(row: Row) -> Body:
    return Body(
        row.words[0],
        row.word(1, "the attachment").lower(),
        _three(row, 2, "a coordinate"),
        _three(row, 5, "an angle"),
        row,
    )


def _three(row: Row, first: int, what: str) -> tuple[float, float, float]:
    return (row.value(first, what), row.value(first + 1, what), row.value(first + 2, what))
