"""What WAMIT's tables leave out, from `.pot`, `.cfg`, `.frc`, `.mmx`, `.gdf`, `.out` beside them.

Depth and body axes stand in `.pot` or `.out`, gravity and the length scale in `.mmx`, `.out` or the
`.gdf`, volumes and centres in `.mmx` or `.out`, the density in `.frc` (alternative form 2). HAMS,
which writes the same tables, has depth and reference point in `ControlFile.in`; the input of
OpenFAST's HydroDyn shows what it takes them for.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path, PureWindowsPath

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.hydrodyn import hydrodyn_of
from hydrodae.hdb.readers.text import NUMBER, read_lines, read_text, words
from hydrodae.hdb.readers.wamit_asked import HAMS, Asked, of_hams, steps
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file

_NUMBERS = re.compile(NUMBER)
#: WAMIT prints the density 1 when it was not given one.
LEAST_DENSITY = 100.0


@dataclass
class Statics:
    """Of one body, in its own axes: volume [m3], centres [m], mass over the density [m3]."""

    volume: float | None = None
    center_of_buoyancy: Array | None = None
    center_of_gravity: Array | None = None
    mass_over_rho: float | None = None


@dataclass
class Control:
    """Settings of a run; None where no file says.

    `likely_depth` is that of a program that uses the tables, which may be of another depth.
    """

    depth: float | None = None
    likely_depth: float | None = None
    gravity: float | None = None
    length: float | None = None
    rho: float | None = None
    first_column: int | None = None
    points: list[Array] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    statics: list[Statics] = field(default_factory=list)
    frequencies: int | None = None
    first_input: int | None = None
    asked: Asked | None = None
    stiffness: list[Array] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)


def read_control(stem: Path) -> Control:
    """Read what is there of `<stem>.pot`, `.cfg`, `.mmx`, `.out`, and the `.gdf` files they name.

    Raises
    ------
    DatabaseError
        A file is wrong; the message names file and line.
    """
    control = Control()
    for suffix, reader in ((".cfg", _cfg), (".pot", _pot), (".mmx", _listing), (".out", _listing)):
        path = beside(stem, suffix)
        if path is not None:
            reader(path, control)
            control.files.append(path)
    frc, listing = beside(stem, ".frc"), beside(stem, ".mmx")
    if frc is not None and listing is not None:
        _frc(frc, listing, control)
    hams = hams_file(stem, "ControlFile.in")
    if hams is not None and control.depth is None:
        _hams(hams, control)
        control.files.append(hams)
    if control.depth is None:
        _hydrodyn(stem, control)
    if control.gravity is None or control.length is None:
        for name in control.names or [stem.name]:
            path = beside(stem.with_name(name), ".gdf")
            if path is not None:
                _gdf(path, control)
                control.files.append(path)
                break
    return control


def _hydrodyn(stem: Path, control: Control) -> None:
    """Water, length and reference point of the input of HydroDyn that names these tables."""
    found = hydrodyn_of(stem)
    if found is None:
        return
    control.likely_depth, control.files = found.depth, [*control.files, found.path]
    control.rho = found.rho if control.rho is None else control.rho
    control.length = found.length if control.length is None else control.length
    if not control.points:
        control.points.append(np.zeros(3))


def beside(stem: Path, suffix: str) -> Path | None:
    """Return the file `<stem><suffix>` whatever the case of its name, or None."""
    return named(stem.parent, stem.name + suffix)


def named(folder: Path | None, name: str) -> Path | None:
    """Return what is called `name` in a folder, whatever the case, or None."""
    if folder is None or not folder.is_dir():
        return None
    return next((p for p in sorted(folder.iterdir()) if p.name.lower() == name.lower()), None)


def _numbers(text: str) -> list[float]:
    return [float(n.upper().replace("D", "E")) for n in _NUMBERS.findall(text)]


def _leading(line: str, count: int) -> list[float]:
    """Numbers at the start of line `count` of a file, up to the first word that is not a number."""
    found = []
    try:
        separate = words(line)
    except ValueError as error:
        raise DatabaseError(f"{error}").about("format", line=count) from None
    for word in separate:
        if not re.fullmatch(NUMBER, word):
            break
        found.append(float(word.upper().replace("D", "E")))
    return found


def _cfg(path: Path, control: Control) -> None:
    for line in read_lines(path):
        found = re.match(r"\s*IPEROUT\s*=\s*(\d+)", line, re.IGNORECASE)
        if found:
            control.first_column = int(found[1])
        found = re.match(r"\s*IPERIN\s*=\s*(\d+)", line, re.IGNORECASE)
        if found:
            control.first_input = int(found[1])
    control.first_column = control.first_column or 1
    control.first_input = control.first_input or 1


@names_file
def _pot(path: Path, control: Control) -> None:
    """Read a potential control file: form 2 (with NBODY), or form 1 (one body)."""
    lines = read_lines(path)
    values = [_leading(line, n) for n, line in enumerate(lines[1:], start=2)]
    values.insert(0, [])  # a title

    def expect(row: int, count: int, what: str) -> list[float]:
        if row >= len(lines) or len(values[row]) < count:
            raise DatabaseError(f"expected {count} numbers: {what}").about("format", line=row + 1)
        return values[row][:count]

    (depth,) = expect(1, 1, "HBOT")
    control.depth = np.inf if depth <= 0.0 else depth
    if len(values[1]) >= 5:
        control.points.append(_point(1, values[1][1:5]))
        return
    row = 3
    count = int(expect(row, 1, "NPER")[0])
    control.frequencies = abs(count)
    wanted = steps(count, [x for line in values[row + 1 : row + 1 + abs(count)] for x in line])
    row = _skip(values, row + 1, abs(count) if count > 0 else 2 * (count < 0))
    headings = int(expect(row, 1, "NBETA")[0])
    row = _skip(values, row + 1, abs(headings) if headings > 0 else 2 * (headings < 0))
    bodies = int(expect(row, 1, "NBODY")[0])
    row += 1
    all_six = values[2][:1] == [1.0]  # IRAD: of all motions, whatever their MODE
    modes: list[list[int]] = []
    for _ in range(bodies):
        if row >= len(lines) or not lines[row].strip():
            raise DatabaseError("expected the .gdf file of a body").about("format", line=row + 1)
        control.names.append(PureWindowsPath(lines[row].split()[0]).stem)
        control.points.append(_point(row + 1, expect(row + 1, 4, "XBODY(1-4)")))
        chosen = expect(row + 2, 6, "MODE(1-6)")
        modes.append([i for i, wanted_one in enumerate(chosen, 1) if all_six or wanted_one])
        row += 3
        # form 2 may hold lines of new modes (NEWMDS) between the bodies
        while row < len(lines) and len(values[row]) == 1:
            row += 1
    control.asked = Asked(path, wanted, control.first_input, modes)


def _skip(values: list[list[float]], row: int, count: int) -> int:
    """Row after the next `count` numbers."""
    while count > 0 and row < len(values):
        count -= len(values[row])
        row += 1
    return row


def _point(row: int, xbody: list[float]) -> Array:
    if xbody[3] != 0.0:
        raise DatabaseError(
            f"body axes turned by XBODY(4) = {xbody[3]:g} deg; run it with 0"
        ).about("unsupported", "XBODY", line=row + 1)
    return np.array(xbody[:3])


@names_file
def _listing(path: Path, control: Control) -> None:
    """Read `.mmx` or `.out`; bodies are counted by their lines of volumes."""
    seen = 0
    known = bool(control.points)
    for count, line in enumerate(read_lines(path), start=1):
        if line.strip().startswith("Gravity:"):
            found = _numbers(line.split("Gravity:")[1])
            control.gravity = found[0]
            if len(found) > 1:
                control.length = found[1]
        density = re.search(rf"Water density:\s*({NUMBER})", line)
        if density and float(density[1]) > LEAST_DENSITY:
            control.rho = float(density[1])
        depth = re.search(rf"Water depth:\s*(infinite|{NUMBER})", line, re.IGNORECASE)
        if depth and control.depth is None:
            infinite = depth[1].lower() == "infinite"
            control.depth = np.inf if infinite else float(depth[1])
        place = re.search(rf"XBODY =\s*({NUMBER})\s+YBODY =\s*({NUMBER})\s+ZBODY =", line)
        if place and not known:
            found = _numbers(line)
            if len(found) != 4 or found[3] != 0.0:
                raise DatabaseError(f"body axes turned: {line.strip()!r}; run it with 0").about(
                    "unsupported", "XBODY", line=count
                )
            control.points.append(np.array(found[:3]))
        row = re.match(r"\s*C\((\d),\d\)[C(),\d]*:(.*)", line)
        if seen and row and path.suffix.lower() == ".out":
            _stiffness_row(control, seen, int(row[1]), _numbers(row[2]))
        if "VOLX,VOLY,VOLZ" in line:
            seen += 1
            if len(control.statics) < seen:
                control.statics.append(Statics())
            control.statics[seen - 1].volume = float(np.median(_after(count, line)))
        elif seen and "Center of Buoyancy" in line:
            control.statics[seen - 1].center_of_buoyancy = _after(count, line)
        elif seen and "Center of Gravity" in line:
            control.statics[seen - 1].center_of_gravity = _after(count, line)
        elif seen and re.match(r"\s*3\s+3\s+\S+\s*$", line) and path.suffix.lower() == ".mmx":
            control.statics[seen - 1].mass_over_rho = _numbers(line)[2]


def _stiffness_row(control: Control, body: int, row: int, values: list[float]) -> None:
    """Enter C(3,3..5), C(4,4..6) or C(5,5..6) over rho g, upper triangle, of body 1, 2, ..."""
    while len(control.stiffness) < body:
        control.stiffness.append(np.zeros((6, 6)))
    k = control.stiffness[body - 1]
    for column, value in enumerate(values, start=row - 1):
        k[row - 1, column] = value
        if column < 5:  # K46 and K56 stand in the upper half only
            k[column, row - 1] = value


@names_file
def _frc(path: Path, listing: Path, control: Control) -> None:
    """Density of alternative form 2: the third line is one number, followed by centres."""
    form = re.search(r"IALTFRC\s*=\s*(\d)", read_text(listing))
    lines = read_lines(path)
    if form and form[1] != "1" and len(lines) > 2:
        found = _leading(lines[2], 3)
        if found and found[0] > LEAST_DENSITY:
            control.rho = found[0]
            control.files.append(path)


def hams_file(stem: Path, name: str) -> Path | None:
    """An input of HAMS in the folder of the tables, above it, or in `Input` beside it."""
    for folder in (stem.parent, stem.parent.parent, stem.parent.parent.parent):
        for place in (folder, named(folder, "Input")):
            path = named(place, name)
            if path is not None and path.is_file():
                return path
    return None


def mesh_of(stem: Path, name: str, alone: bool) -> tuple[Path, bool] | None:
    """Mesh of a body of WAMIT (`.gdf`, in body axes: True) or HAMS (`HullMesh.pnl`), or None.

    One that is `alone` may have its mesh under the name of the run.
    """
    for file in dict.fromkeys((name, stem.name) if alone else (name,)):
        path = beside(stem.with_name(file), ".gdf")
        if path is not None:
            return path, True
    path = hams_file(stem, "HullMesh.pnl") if alone else None
    return None if path is None else (path, False)


@names_file
def _hams(path: Path, control: Control) -> None:
    """Depth (negative: infinite), reference point and length of HAMS; its tables hold periods."""
    text = read_text(path)
    depth = re.search(rf"Waterdepth\s+({NUMBER})(?!,)", text, re.IGNORECASE)
    if depth is None:
        raise DatabaseError("no line Waterdepth with a number").about("missing", "Waterdepth")
    (value,) = _numbers(depth[1])
    control.depth = np.inf if value <= 0.0 else value
    center = re.search(rf"Reference_body_center((?:\s+{NUMBER}){{3}})", text)
    if center and not control.points:
        control.points.append(np.array(_numbers(center[1])))
    length = re.search(rf"Reference_body_length\s+({NUMBER})", text)
    if length and control.length is None:
        control.length = _numbers(length[1])[0]
    kind = re.search(r"Output_frequency_type\s+(\d)", text)
    if kind and control.first_column is None:
        if kind[1] not in HAMS:
            raise DatabaseError(f"Output_frequency_type {kind[1]}: expected 1 to 4").about(
                "format", "Output_frequency_type"
            )
        control.first_column = HAMS[kind[1]]
    control.asked = of_hams(path, text)


def _after(count: int, line: str) -> Array:
    """Three numbers behind the brackets and the colon."""
    found = _numbers(line[max(line.rfind(":"), line.rfind(")")) + 1 :])
    if len(found) != 3:
        raise DatabaseError(f"expected 3 numbers in {line.strip()!r}").about("format", line=count)
    return np.array(found)


@names_file
def _gdf(path: Path, control: Control) -> None:
    lines = read_lines(path)
    found = _leading(lines[1], 2) if len(lines) > 1 else []
    if len(found) < 2:
        raise DatabaseError("expected 2 numbers: ULEN and GRAV").about("format", line=2)
    control.length, control.gravity = found[0], found[1]
