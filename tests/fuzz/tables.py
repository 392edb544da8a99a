"""Databases of other programs, and mutations of their numbers, words and lines."""

from __future__ import annotations

import os
import re
import shutil
from pathlib import Path
from random import Random

import h5py
import numpy as np
from tests.fuzz import hdf5
from tests.python.nemoh_writer import NemohFolder

WORDS = (
    *("nan", "inf", "-inf", "1e308", "-1e308", "1e400", "0", "-1", "1", "2", "7", "1e9", "0.5"),
    *("99999999999999999999", "", "x", "жук", "1.0D+02", "0.1-100", "*****", '"', "\0", "3,5"),
)
NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:[EeDd][-+]?\d+)?")
BINARY = (".nc", ".h5")
LARGEST = 600_000  #: bytes of a folder; larger ones take long


def collect(folder: Path) -> list[Path]:
    """Folders to start from: written ones, and those of the reference where it is there."""
    from hydrodae import hdb
    from hydrodae.hdb.database import writers

    root = Path(__file__).resolve().parents[2]
    sphere = hdb.read(root / "cases" / "sphere" / "hydro.h5")
    for name, write in (("sphere.nc", writers.write_capytaine), ("sphere.h5", writers.write_bemio)):
        place = folder / f"source {name}"
        place.mkdir()
        write(sphere, place / name)
    nemoh = Path(NemohFolder(bodies=2).write(folder / "source nemoh"))
    for i in range(2):
        np.savetxt(nemoh / f"KH_{i}.dat", np.diag([0.0, 0.0, 39240.0, 9810.0, 9810.0, 0.0]))
        (nemoh / f"Hydrostatics_{i}.dat").write_text(
            " XF =   0.000 - XG =   0.000\n YF =   0.000 - YG =   0.000\n"
            " ZF =  -1.000 - ZG =  -1.000\n Displacement = 8.0\n Waterplane area = 4.0\n"
        )
    given = os.environ.get("HYDRODAE_REFERENCE", root.parent / "shared" / "reference")
    found = [p for p in sorted((Path(given) / "hdb").glob("*")) if p.is_dir()]
    small = [p for p in found if sum(f.stat().st_size for f in p.rglob("*")) < LARGEST]
    return [*sorted(folder.glob("source *")), *small]


def _change(lines: list[str], random: Random) -> None:
    """Change one line, more often one of the head of a file."""
    at = random.randrange(min(len(lines), random.choice((15, len(lines)))))
    how = random.randrange(7)
    numbers = list(NUMBER.finditer(lines[at]))
    if how <= 3 and numbers:
        one = random.choice(numbers)
        lines[at] = lines[at][: one.start()] + random.choice(WORDS) + lines[at][one.end() :]
    elif how == 4:
        del lines[at]
    elif how == 5:
        lines.insert(at, random.choice(lines))
    else:
        lines[at] = random.choice(("", "x", lines[at][: random.randrange(len(lines[at]) + 1)]))


def mutated(sources: list[Path], place: Path, random: Random) -> Path:
    """A folder with one file changed."""
    copy = place / "tables"
    shutil.copytree(random.choice(sources), copy)
    path = random.choice([p for p in sorted(copy.rglob("*")) if p.is_file()])
    if path.suffix.lower() in BINARY:
        if h5py.is_hdf5(path):
            hdf5.mutate(path, random)
        else:
            hdf5.damage(path, random)  # netCDF-3
    else:
        lines = path.read_text(errors="replace").split("\n")
        for _ in range(random.choice((1, 1, 2, 5))):
            if lines:
                _change(lines, random)
        path.write_text("\n".join(lines), errors="replace")
    return copy
