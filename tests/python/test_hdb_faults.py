"""Files of other programs with one fault each: the source, the change, the error and its place."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.errors import refused
from tests.python.nemoh_writer import NemohFolder
from tests.python.test_hdb_mesh_of_run import write_pnl
from tests.python.test_hdb_wamit import write_run

from hydrodae import hdb
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.hdb.readers.orcayaml import read_yaml
from hydrodae.hdb.readers.stiffness_file import read_stiffness

Change = Callable[[str], str]
AH1 = "* head\n  1  1   1  0.0\n     0.5\nGENERAL\n  1   10.0  1000.0  9.81 0 0\n"
YAML = "General:\n  Depth: [1, 2\nNext: 3\n"


def old(pattern: str, new: str) -> Change:
    """Replace the first match of a pattern, which must be there."""

    def change(text: str) -> str:
        changed, count = re.subn(pattern, new, text, count=1)
        assert count
        return changed

    return change


def line(number: int, pattern: str, new: str = "") -> Change:
    """Replace the first match of a pattern in a line, counted from 1."""

    def change(text: str) -> str:
        lines = text.splitlines()
        lines[number - 1] = old(pattern, new)(lines[number - 1])
        return "\n".join(lines) + "\n"

    return change


def words(number: int, place: int, new: str) -> Change:
    """Replace one word of a line; places are counted from 0."""

    def change(text: str) -> str:
        lines = text.splitlines()
        found = lines[number - 1].split()
        found[place] = new
        lines[number - 1] = " ".join(found)
        return "\n".join(lines) + "\n"

    return change


def without_a_force(text: str) -> str:
    """Nemoh.cal with five motions or forces of body 1, where the tables have six."""
    short = text.replace("2 0 0 1 0 0 -1 ! a 6 DoF 99 comment\n", "")
    return short.replace("6 ! number", "5 ! number")


def exchanged(text: str) -> str:
    """Modulus and real part of the forces in each other's places."""
    rows = [row.split() for row in text.splitlines()]
    return "\n".join(" ".join([*r[:3], r[5], r[4], r[3], *r[6:]]) for r in rows)


def other_order(text: str) -> str:
    """The second pair of lines of a table before the first."""
    lines = text.splitlines()
    at = lines.index("FORCERAO") + 1
    lines[at : at + 4] = lines[at + 2 : at + 4] + lines[at : at + 2]
    return "\n".join(lines)


def cut_short(text: str) -> str:
    return text[: text.index("Wave period", int(0.7 * len(text)))]


TEC, CAL = "Results/RadiationCoefficients.tec", "Nemoh.cal"
SPHERES, HAMS, SPHERE = "twospheres_capytaine_legacy", "cylinder_hams", "sphere_nemoh_v2.3"
RADIATION = "results/RadiationCoefficients.tec"
#: Source, file, change, and the fields of the error: reason, subject, line.
FAULTS: list[tuple[str, str, Change, str, str | None, int | None]] = [
    ("nemoh", TEC, line(10, r"\s+\S+\s*$"), "shape", None, 10),
    ("nemoh", TEC, words(11, 3, "garbage"), "format", None, 11),
    ("nemoh", TEC, words(9, 2, "*******"), "format", None, 9),
    ("nemoh", TEC, line(14, "DoF   2", "DoF   5"), "order", None, 14),
    ("nemoh", CAL, without_a_force, "shape", None, None),
    ("nemoh", CAL, old("1000.0 ! RHO", "water ! RHO"), "format", None, 2),
    ("nemoh", CAL, old("1 ! Number of bodies", "1.5 ! Number"), "format", None, 7),
    ("nemoh", CAL, old("1 1 0 0 0 0 -1", "1 1 1 0 0 0 -1"), "unsupported", None, 12),
    ("nemoh", CAL, old("5 0.5 2.5 ! Number of wave", "5 0.5 ! Number of wave"), "format", None, 27),
    ("nemoh", CAL, old("5 0.5 2.5 ! Number of wave", "7 5 0.5 2.5 ! Number"), "units", None, 27),
    ("nemoh", CAL, words(4, 0, "-1."), "value", None, 4),
    (SPHERES, CAL, words(2, 0, "0.0"), "value", None, 2),
    (SPHERES, CAL, words(2, 0, "nan"), "format", None, 2),
    ("wamit", "run.1", line(5, ".*", " 1.0 1 oops 2.0"), "format", None, 5),
    ("wamit", "run.1", line(5, ".*", " 1.0 1"), "shape", None, 5),
    ("wamit", "run.1", line(300, ".*", " 6.2831853072 1 1 2.0"), "shape", None, 300),
    ("wamit", "run.1", words(4, 1, "1e308"), "label", "modes", None),
    ("wamit", "run.1", words(4, 1, "1.5"), "label", "modes", None),
    ("wamit", "run.1", words(4, 1, "0"), "label", "modes", None),
    ("wamit", "run.3", line(9, ".*", " 1.0 0.0 1 2.0"), "shape", None, 9),
    ("wamit", "run.pot", line(8, ".*", " NBODY"), "format", None, 8),
    ("wamit", "run.pot", line(10, ".*", " 0 0 -1 30 XBODY"), "unsupported", None, 10),
    ("wamit", "run.cfg", old("IPEROUT=1", "IPEROUT=7"), "format", "IPEROUT", 1),
    ("wamit", "A.GDF", line(2, ".*", " one two"), "format", None, 2),
    ("sphere_wamit", "sphere.hst", old(" 3     3 ", " 7     3 "), "label", "modes", None),
    (HAMS, "Wamit_format/Buoy.3", words(3, 2, "40"), "label", "modes", 3),
    (HAMS, "Wamit_format/Buoy.hst", words(3, 0, "40"), "label", "modes", 3),
    (HAMS, "Wamit_format/Buoy.3", exchanged, "conflict", "modulus", 1),
    *(
        (HAMS, "ControlFile.in", old(r"(Waterdepth\s+)\S+", rf"\g<1>{wrong}"), "missing",
         "Waterdepth", None)
        for wrong in ("-1.#IND", "1x0", "1.2.3", "NaN")
    ),
    ("cylinder_wamit_out", "cyl.out", cut_short, "cut_short", None, None),
    ("cylinder_aqwa", "cylinder.AH1", other_order, "order", "FORCERAO", None),
    ("text", "tiny.AH1", lambda _: f"{AH1}COG\n  1   0.0 0.0 oops\n", "format", None, 7),
    ("text", "tiny.AH1", lambda _: f"{AH1}COG\n  1   0.0 0.0 -1.0\n", "missing", None, 0),
    ("text", "model.yml", lambda _: YAML, "format", None, 3),
    ("text", "model.yml", lambda _: "no colon here\n", "format", None, None),
    ("text", "stiffness.txt", lambda _: "1 2 3 4 5 6\n1 2 x\n", "format", None, 2),
    ("text", "stiffness.txt", lambda _: "1 0 0 0 0 0\n" * 4, "shape", None, None),
    ("mesh", "HullMesh.pnl", old("   5   8   0   0", "   5   9   0   0"), "shape", "", 0),
    ("mesh", "HullMesh.pnl", old("  1  4  1", "  1  4  x"), "format", "", 18),
    ("mesh", "HullMesh.pnl", old("  1  4  1", "  1  4  77"), "missing", "point 77", 18),
]  # fmt: skip
READERS = {"HullMesh.pnl": read_mesh, "model.yml": read_yaml, "stiffness.txt": read_stiffness}


def source(name: str, folder: Path, request: pytest.FixtureRequest) -> Path:
    """Write a sound source, or copy one of the reference data; returns what is to be read."""
    own: dict[str, Callable[[Path], object]] = {
        "nemoh": lambda at: NemohFolder().write(at),
        "wamit": write_run,
        "mesh": lambda at: write_pnl(at / "HullMesh.pnl"),
        "text": Path.touch,
    }
    if name in own:
        if name != "nemoh":
            folder.mkdir()
        own[name](folder)
        return folder / "run.1" if name == "wamit" else folder
    leave = shutil.ignore_patterns("*.png", "*.pdf", "*.LIS")
    reference: Path = request.getfixturevalue("reference")
    return Path(shutil.copytree(reference / "hdb" / name, folder, ignore=leave))


@pytest.mark.parametrize(("name", "file", "change", "reason", "subject", "place"), FAULTS)
def test_refused(
    name: str,
    file: str,
    change: Change,
    reason: str,
    subject: str | None,
    place: int | None,
    tmp_path: Path,
    request: pytest.FixtureRequest,
) -> None:
    path = source(name, tmp_path / "run", request)
    changed = tmp_path / "run" / file
    text = changed.read_text() if changed.exists() else ""
    changed.write_text(change(text))
    told = Path(TEC).name if change is without_a_force else changed.name
    with refused(reason, subject, file=told, line=place):
        read = READERS.get(file)
        hdb.read(path, rho=1000.0 if name == "wamit" else None) if read is None else read(changed)
