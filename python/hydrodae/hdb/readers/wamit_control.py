"""What WAMIT's tables leave out, from `.pot`, `.cfg`, `.frc`, `.mmx`, `.gdf`, `.out` beside them.

Depth and body axes stand in `.pot` or `.out`, gravity and the length scale in `.mmx`, `.out` or the
`.gdf`, volumes and centres in `.mmx` or `.out`, the density in `.frc` (alternative form 2). HAMS,
which writes the same tables, has depth and reference point in `ControlFile.in`; the input of
OpenFAST's HydroDyn shows what it takes them for.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path, PureWindowsPath

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.hydrodyn import input_of
from hydrodae.hdb.readers.rows import FIRST
from hydrodae.hdb.readers.text import (
    NUMBER,
    beside,
    leading,
    lines_beside,
    named,
    number,
    read_lines,
    read_text,
)
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file

_NUMBERS = re.compile(NUMBER)
#: WAMIT prints the density 1 when it was not given one.
LEAST_DENSITY = 100.0
#: HAMS: 1, 2 wavenumber in deep and finite depth, 3 frequency, 4 period (5 wavelength).
HAMS = {"1": 3, "2": 4, "3": 2, "4": 1}
WAVELENGTH = 5
#: Suffixes of the text files of a run, and what they hold: path and lines.
BESIDE = (".cfg", ".pot", ".mmx", ".out", ".frc")
Texts = Mapping[str, tuple[Path, list[str]]]


@dataclass(frozen=True)
class Asked:
    """Frequencies, and motions of each body, of a control file.

    Attributes
    ----------
    where : Path
    values : (m,) array
        Periods, frequencies or wavenumbers.
    kind : int or None
        Which of them (IPERIN); None where no file says.
    modes : list of list of int
        1 (surge) to 6 (yaw) of each body; none: not said.
    """

    where: Path
    values: Array
    kind: int | None
    modes: list[list[int]]


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

    `new_modes` are the numbers of generalised modes (NEWMDS) of bodies from 1.
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
    new_modes: dict[int, int] = field(default_factory=dict)

    def starts(self, bodies: int, most: int) -> Array:
        """Modes before those of each body, and of all (bodies + 1,): 6 and NEWMDS of each.

        Parameters
        ----------
        bodies, most : int
            Number of bodies, and largest mode in the tables, which an only body has.
        """
        extra = [self.new_modes.get(i + 1, 0) for i in range(bodies)]
        counts = [6 + n for n in extra] if any(extra) or bodies > 1 else [max(6, most)]
        return np.cumsum([0, *counts], dtype=float)


def read_control(stem: Path, texts: Texts | None = None) -> Control:
    """Read what is there of `BESIDE`, and the `.gdf` files they name.

    `texts` are the files `BESIDE` with their lines, where they have been read.

    Raises
    ------
    DatabaseError
        A file is wrong; the message names file and line.
    """
    control = Control()
    texts = lines_beside(stem, BESIDE) if texts is None else texts
    for suffix, reader in ((".cfg", _cfg), (".pot", _pot), (".mmx", _listing), (".out", _listing)):
        if suffix in texts:
            reader(*texts[suffix], control)
            control.files.append(texts[suffix][0])
    if ".frc" in texts and ".mmx" in texts:
        _frc(*texts[".frc"], texts[".mmx"][1], control)
    hams = hams_file(stem, "ControlFile.in") if control.depth is None else None
    if hams is not None:
        _hams(hams, control)
        control.files.append(hams)
    if control.depth is None:
        _hydrodyn(stem, control)
    if control.gravity is None or control.length is None:
        meshes = (beside(stem.with_name(name), ".gdf") for name in control.names or [stem.name])
        if (mesh := next((path for path in meshes if path is not None), None)) is not None:
            _gdf(mesh, control)
            control.files.append(mesh)
    return control


def hams_file(stem: Path, name: str) -> Path | None:
    """An input of HAMS in the folder of the tables, above it, or in `Input` beside it."""
    for folder in (stem.parent, *stem.parent.parents[:2]):
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
        if (path := beside(stem.with_name(file), ".gdf")) is not None:
            return path, True
    path = hams_file(stem, "HullMesh.pnl") if alone else None
    return None if path is None else (path, False)


def _numbers(text: str) -> list[float]:
    return [float(n.upper().replace("D", "E")) for n in _NUMBERS.findall(text)]


def _deep(depth: float) -> float:
    """Depth of files where 0 or a negative one stands for deep water."""
    return np.inf if depth <= 0.0 else depth


def _steps(count: int, numbers: list[float]) -> Array:
    """Values of a list, or -count of them from a first one by steps."""
    if count >= 0:
        return np.array(numbers[:count])
    if len(numbers) < 2:
        return np.zeros(0)
    return np.asarray(numbers[0] + numbers[1] * np.arange(-count, dtype=float))


@names_file
def _cfg(path: Path, lines: list[str], control: Control) -> None:
    """Read a configuration file: what the periods are (0 is 1), and the numbers of new modes."""
    found = {"IPEROUT": 1, "IPERIN": 1}
    for count, line in enumerate(lines, start=1):
        if stated := re.match(r"\s*(IPEROUT|IPERIN)\s*=\s*(\d+)", line, re.IGNORECASE):
            key, option = stated[1].upper(), int(stated[2]) or 1
            if option not in FIRST:
                raise DatabaseError(f"{key} = {option}: expected 1 to {max(FIRST)}").about(
                    "format", key, line=count
                )
            found[key] = option
        if stated := re.match(r"\s*NEWMDS\s*(?:\((\d+)\))?\s*=\s*(\d+)", line, re.IGNORECASE):
            control.new_modes[int(stated[1] or 1)] = int(stated[2])
    control.first_column, control.first_input = found["IPEROUT"], found["IPERIN"]


@names_file
def _pot(path: Path, lines: list[str], control: Control) -> None:
    """Read a potential control file: form 2 (with NBODY), or form 1 (one body)."""
    values: list[list[float]] = [[]]  # of the title
    for n, line in enumerate(lines[1:], start=2):
        values.append(leading(line, n))

    def expect(row: int, count: int, what: str) -> list[float]:
        if row >= len(lines) or len(values[row]) < count:
            raise DatabaseError(f"expected {count} numbers: {what}").about("format", line=row + 1)
        return values[row][:count]

    def after(row: int, count: int) -> int:
        """Row after a list of so many numbers, or after its first one and its step."""
        left = count if count > 0 else 2 * (count < 0)
        while left > 0 and row < len(values):
            left -= len(values[row])
            row += 1
        return row

    control.depth = _deep(expect(1, 1, "HBOT")[0])
    if len(values[1]) >= 5:
        control.points.append(_point(1, values[1][1:5]))
        return
    count = int(expect(3, 1, "NPER")[0])
    control.frequencies = abs(count)
    wanted = _steps(count, [x for line in values[4 : 4 + abs(count)] for x in line])
    row = after(4, count)
    row = after(row + 1, int(expect(row, 1, "NBETA")[0]))
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


def _point(row: int, xbody: list[float]) -> Array:
    if xbody[3] != 0.0:
        raise DatabaseError(
            f"body axes turned by XBODY(4) = {xbody[3]:g} deg; run it with 0"
        ).about("unsupported", "XBODY", line=row + 1)
    return np.array(xbody[:3])


@names_file
def _listing(path: Path, lines: list[str], control: Control) -> None:
    """Read `.mmx` or `.out`; bodies are counted by their lines of volumes."""
    seen, known = 0, bool(control.points)
    suffix = path.suffix.lower()
    for count, line in enumerate(lines, start=1):
        _water(line, control)
        place = re.search(rf"XBODY =\s*({NUMBER})\s+YBODY =\s*({NUMBER})\s+ZBODY =", line)
        if place and not known:
            found = _numbers(line)
            if len(found) != 4 or found[3] != 0.0:
                raise DatabaseError(f"body axes turned: {line.strip()!r}; run it with 0").about(
                    "unsupported", "XBODY", line=count
                )
            control.points.append(np.array(found[:3]))
        row = re.match(r"\s*C\((\d),\d\)[C(),\d]*:(.*)", line)
        if seen and row and suffix == ".out":
            _stiffness_row(control, seen, int(row[1]), _numbers(row[2]))
        if "VOLX,VOLY,VOLZ" in line:
            seen += 1
            if len(control.statics) < seen:
                control.statics.append(Statics())
            control.statics[seen - 1].volume = float(np.median(_three(count, line)))
        elif seen and "Center of Buoyancy" in line:
            control.statics[seen - 1].center_of_buoyancy = _three(count, line)
        elif seen and "Center of Gravity" in line:
            control.statics[seen - 1].center_of_gravity = _three(count, line)
        elif seen and suffix == ".mmx" and re.match(r"\s*3\s+3\s+\S+\s*$", line):
            control.statics[seen - 1].mass_over_rho = _numbers(line)[2]


def _water(line: str, control: Control) -> None:
    """Take gravity, length scale, density and depth from a line of a listing that holds them."""
    if line.strip().startswith("Gravity:"):
        control.gravity, *length = _numbers(line.split("Gravity:")[1])[:2]
        control.length = length[0] if length else control.length
    density = re.search(rf"Water density:\s*({NUMBER})", line)
    if density and float(density[1]) > LEAST_DENSITY:
        control.rho = float(density[1])
    depth = re.search(rf"Water depth:\s*(infinite|{NUMBER})", line, re.IGNORECASE)
    if depth and control.depth is None:
        control.depth = np.inf if depth[1].lower() == "infinite" else float(depth[1])


def _three(count: int, line: str) -> Array:
    """Three numbers behind the brackets and the colon."""
    found = _numbers(line[max(line.rfind(":"), line.rfind(")")) + 1 :])
    if len(found) != 3:
        raise DatabaseError(f"expected 3 numbers in {line.strip()!r}").about("format", line=count)
    return np.array(found)


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
def _frc(path: Path, lines: list[str], listing: list[str], control: Control) -> None:
    """Density of alternative form 2: the third line is one number, followed by centres."""
    form = re.search(r"IALTFRC\s*=\s*(\d)", "\n".join(listing))
    if form and form[1] != "1" and len(lines) > 2:
        found = leading(lines[2], 3)
        if found and found[0] > LEAST_DENSITY:
            control.rho = found[0]
            control.files.append(path)


@names_file
def _gdf(path: Path, control: Control) -> None:
    lines = read_lines(path)
    found = leading(lines[1], 2) if len(lines) > 1 else []
    if len(found) < 2:
        raise DatabaseError("expected 2 numbers: ULEN and GRAV").about("format", line=2)
    control.length, control.gravity = found[0], found[1]


@names_file
def _hams(path: Path, control: Control) -> None:
    """Depth (negative: infinite), reference point and length of HAMS; its tables hold periods."""
    text = read_text(path)
    depth = re.search(rf"Waterdepth\s+({NUMBER})(?!,)", text, re.IGNORECASE)
    if depth is None:
        raise DatabaseError("no line Waterdepth with a number").about("missing", "Waterdepth")
    control.depth = _deep(_numbers(depth[1])[0])
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
    control.asked = _asked_of_hams(path, text)


def _asked_of_hams(path: Path, text: str) -> Asked | None:
    """Frequencies and motions that a ControlFile.in of HAMS asks for; it computes all six."""
    kind = re.search(r"Input_frequency_type\s+(\d)", text)
    count = re.search(rf"Number_of_frequencies\s+({NUMBER})(.*)", text)
    if kind is None or count is None or int(kind[1]) not in (*HAMS.values(), WAVELENGTH):
        return None
    wanted = int(number(count[1]))
    if wanted < 0:
        first = re.search(rf"Minimum_frequency_Wmin\s+({NUMBER})", text)
        step = re.search(rf"Frequency_step\s+({NUMBER})", text)
        if first is None or step is None:
            return None
        values = _steps(wanted, [number(first[1]), number(step[1])])
    else:
        lines = text[count.end() :].splitlines()
        row = next((line.split("!")[0] for line in lines if line.strip()), "")
        values = np.array([number(word) for word in re.findall(NUMBER, row)])
    return Asked(path, values, HAMS.get(kind[1], WAVELENGTH), [list(range(1, 7))])


def _hydrodyn(stem: Path, control: Control) -> None:
    """Water, length and reference point of the input of HydroDyn that uses these tables.

    Moments are about the origin. The depth is what the program takes the tables for.
    """
    found = input_of(stem)
    if found is None:
        return
    path, read = found
    control.files.append(path)
    control.likely_depth = None if read.depth is None else _deep(read.depth)
    control.rho = read.rho if control.rho is None else control.rho
    control.length = read.length if control.length is None else control.length
    if not control.points:
        control.points.append(np.zeros(3))
