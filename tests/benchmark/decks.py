"""Input files of MoorDyn: which are of use at the first try.

    .venv/bin/python tests/benchmark/decks.py FOLDER ... [--type catenary] [--moordyn]

Every input file of MoorDyn below the folders is imported without other arguments, into a case whose
platform is fixed. It is of use if its tables make a case, the lines find their rest and a run of
2 s ends. Where a message asks for a body or a place (--body, --at), that is given, and the file
counts as asked. `--moordyn` compares the tension at anchors with MoorDyn's at rest, of segments
(`GetLineNodeTen`, without the weight of half a segment, which ours have).
"""

from __future__ import annotations

import argparse
import collections
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.mooring import Imported, read_moordyn
from hydrodae.mooring.moordyn_chains import find_chains
from hydrodae.mooring.moordyn_deck import read_deck

HEADING = re.compile(r"^-+.*LINE (TYPES|DICTIONARY)", re.MULTILINE | re.IGNORECASE)
#: Options of the start at rest that replace those of the file, and those that go.
AT_REST = (
    "0 writeLog\n300 TmaxIC\n1e-7 threshIC\n1.0 dtIC\n10 CdScaleIC\n1 disableOutput\n"
    "1 ICgenDynamic\n"
)
GONE = (
    "writelog tmaxic icthresh threshic dtic wavekin currents cdscaleic icdfac icgendynamic fileic "
    "waterkin disableoutput"
)
PATIENCE = 60  # [s]


def main() -> None:
    parser = argparse.ArgumentParser(description="Input files of MoorDyn at the first try.")
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--type", choices=("line", "catenary"), default="line")
    parser.add_argument("--moordyn", action="store_true", help="compare tensions at anchors")
    parser.add_argument("--rest", type=Path, help=argparse.SUPPRESS)  # one deck, in a process
    given = parser.parse_args()
    if given.rest:
        print(json.dumps(tensions_of_moordyn(given.rest)))
        return
    counts: collections.Counter[str] = collections.Counter()
    for file in found(given.folders):
        verdict, message, imported = judge(file, given.type)
        counts[verdict] += 1
        if given.moordyn and imported is not None and given.type == "line":
            message += "  " + beside_moordyn(file, imported)
        print(f"{verdict:12s} {'/'.join(file.parts[-4:])}  {message}", flush=True)
    print(", ".join(f"{count} {verdict}" for verdict, count in counts.most_common()))


def found(folders: list[Path]) -> list[Path]:
    files = {f for folder in folders for kind in ("txt", "dat") for f in folder.rglob(f"*.{kind}")}
    return [f for f in sorted(files) if HEADING.search(f.read_text(errors="replace"))]


def judge(file: Path, kind: Any) -> tuple[str, str, Imported | None]:
    """Verdict, the message of what failed, and the tables."""
    bodies: dict[str, str] = {}
    at: dict[str, list[float]] = {}
    asked = ""
    while True:
        try:
            imported = read_moordyn(file, type=kind, bodies=bodies, at=at)
            break
        except CaseError as error:
            name = re.search(r"--body (\w+)=NAME", str(error))
            place = re.search(r"--at (\w+)=X,Y,Z", str(error))
            if place and place[1] not in at:
                at[place[1]] = [1600.0 * len(at), 0.0, 0.0]
            elif name and name[1] not in bodies:
                bodies[name[1]] = f"hull{name[1]}"
            else:
                return "refused", str(error), None
            asked = asked or str(error)
    try:
        case = case_of(file, imported)
        hydrodae.equilibrium(case)
        hydrodae.run(case)
    except CaseError as error:
        return "no rest", str(error), None
    return ("asked" if asked else "of use"), asked, imported


def case_of(file: Path, imported: Imported) -> hydrodae.Case:
    """The tables with fixed bodies, in the water of the file."""
    own = {body["name"] for body in imported.bodies} | {"ground"}
    tables = [*imported.forces, *imported.morison, *imported.joints]
    used = {t[key] for t in tables for key in ("body", "body_a", "body_b") if key in t}
    text = "".join(
        f'[[body]]\nname = "{name}"\nmotion = "fixed"\nmass = 1.0\n'
        "center_of_gravity = [0.0, 0.0, 0.0]\n"
        for name in sorted(used - own)
    )
    deck = read_deck(file)
    text += f"{imported.to_toml()}\n[environment]\nwater_density = {deck.density or 1025.0}\n"
    if deck.gravity:
        text += f"gravity = {deck.gravity}\n"
    if depth := deck.option("wtrdpth", 0.0):
        text += f"water_depth = {depth}\n"
    return hydrodae.Case.from_text(text + "[solver]\nend_time = 2.0\n")


def beside_moordyn(file: Path, imported: Imported) -> str:
    """Largest difference of the tension at anchors."""
    command = [sys.executable, __file__, ".", "--rest", str(file)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=True)
    except (subprocess.TimeoutExpired, subprocess.CalledProcessError) as error:
        return f"MoorDyn: {type(error).__name__}"
    theirs = json.loads(run.stdout.splitlines()[-1])
    ours = hydrodae.equilibrium(case_of(file, imported)).tensions
    deck, worst, told = read_deck(file), 0.0, "no anchor"
    for chain in find_chains(deck)[0]:
        if chain.ends[0].attachment == "fixed":
            line = chain.lines[0]
            end = 0 if line.ends[0] == chain.ends[0].id else 1
            mine = ours[f"forces/line{'_'.join(k.id for k in chain.lines)}/tension_anchor"]
            other = theirs[deck.lines.index(line)][end]
            if abs(mine / other - 1.0) >= worst:
                worst = abs(mine / other - 1.0)
                told = f"{100 * worst:.3f} %: line {line.id} {mine:.6g}, MoorDyn {other:.6g} N"
    return told


def tensions_of_moordyn(file: Path) -> list[list[float]]:
    """Tensions at ends A and B of each line at rest [N]."""
    import moordyn
    import numpy as np

    rows = [row for row in file.read_text(errors="replace").splitlines()
            if len(row.split()) < 2 or row.split()[1].lower() not in GONE.split()]  # fmt: skip
    options = next(k for k, row in enumerate(rows) if row[:3] == "---" and "OPTION" in row.upper())
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "lines.txt"
        deck.write_text("\n".join([*rows[: options + 1], AT_REST.strip(), *rows[options + 1 :]]))
        system = moordyn.Create(str(deck))
    x: list[float] = []
    for k in range(moordyn.GetNumberBodies(system)):
        body = moordyn.GetBody(system, k + 1)
        if moordyn.GetBodyType(body) == -1:
            x += list(moordyn.GetBodyState(body)[0])
    for k in range(moordyn.GetNumberPoints(system)):
        point = moordyn.GetPoint(system, k + 1)
        if moordyn.GetPointType(point) == -1:
            x += list(moordyn.GetPointPos(point))
    moordyn.Init(system, x, [0.0] * len(x))
    lines = [moordyn.GetLine(system, k + 1) for k in range(moordyn.GetNumberLines(system))]
    return [
        [float(np.linalg.norm(moordyn.GetLineNodeTen(line, node))) for node in
         (0, moordyn.GetLineN(line))]
        for line in lines
    ]  # fmt: skip


if __name__ == "__main__":
    main()
