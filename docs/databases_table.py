"""Write the table of `databases.md`: what a set of folders of other codes needs, and how far apart.

    python docs/databases_table.py REFERENCE/hdb     # or other folders, one or several

Writes the table between the marks of docs/databases.md.
Every FOLDER is one database, or holds some. Folders whose names begin alike up to the first `_`
are taken for twins: the same bodies by several codes, compared with that of WAMIT, else the first.
"""

from __future__ import annotations

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

from hydrodae.commands.cli import guarded
from hydrodae.errors import HydrodaeError
from hydrodae.hdb.checks.band import felt_band
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import CheckReport
from hydrodae.hdb.database.scales import scales
from hydrodae.hdb.preparation.importing import import_database
from hydrodae.hdb.readers.kinds import resolve

PAGE = Path(__file__).with_name("databases.md")
BEGIN, END = "<!-- table -->", "<!-- end of table -->"
HEAD = """| folder | format | options needed | A | B | F | A(inf) | hydrostatics | apart from |
|---|---|---|---|---|---|---|---|---|
"""


@dataclass
class Entry:
    """A folder, and what came of it without options."""

    path: Path
    kind: str
    needed: str
    database: HydroDatabase | None


def examine(path: Path) -> Entry | None:
    """Import a folder without options; None if it holds nothing that a code wrote."""
    try:
        kind = resolve(path)[1]
    except HydrodaeError as error:
        return Entry(path, "?", str(error).split(": ", 1)[-1], None) if _files(path) else None
    try:
        database, report = import_database(path)
    except HydrodaeError as error:
        return Entry(path, kind, str(error).split(": ", 1)[-1], None)
    return Entry(path, kind, _needed(report), database)


def _files(path: Path) -> bool:
    return path.is_file() or any(p.is_file() and p.suffix != ".md" for p in path.iterdir())


def _needed(report: CheckReport) -> str:
    left = dict.fromkeys(f"`--accept {finding.name}`" for finding in report.left([]))
    return " ".join(left) or "none"


def entries(paths: list[Path]) -> list[Entry]:
    """All databases in the given folders, one level deep."""
    found = []
    for path in paths:
        inside = sorted(p for p in path.iterdir() if p.is_dir()) if path.is_dir() else []
        try:
            resolve(path)
            inside = []
        except HydrodaeError:
            inside += sorted(p for e in ("*.nc", "*.h5") for p in path.glob(e))
        for one in inside or [path]:
            entry = examine(one)
            if entry is not None and entry.kind == "?" and one.is_dir():
                more = [e for e in entries([one]) if e.kind != "?"] if inside else []
                found += more or [entry]
            elif entry is not None:
                found.append(entry)
    return found


def apart(one: HydroDatabase, other: HydroDatabase) -> list[str]:
    """Differences of A, B, F, A(inf), hydrostatics, diagonal entries, in the band of the other.

    Rms over the frequencies of both, over the rms of the other; the median of the coordinates that
    radiate, and the worst.
    """
    one = one.renamed(dict(zip(one.bodies, other.bodies, strict=True)))
    points = {
        name: body.reference_point
        for name, body in other.bodies.items()
        if body.reference_point is not None and one.bodies[name].reference_point is not None
    }
    one = one.moved_to(points)
    active = {c for c, s in zip(other.coordinates, scales(other), strict=True) if s > 0.0}
    labels = [c for c in one.coordinates if c in active]
    one, part = one.select(labels), other.select(labels)
    low, high = felt_band(other)
    w = one.omega[(one.omega >= max(low, part.omega[0])) & (one.omega <= min(high, part.omega[-1]))]
    ratio = part.rho / one.rho  # tables are proportional to the density
    cells = []
    for name in ("added_mass", "radiation_damping"):
        x = np.einsum("wii->wi", CubicSpline(one.omega, getattr(one, name))(w)) * ratio
        y = np.einsum("wii->wi", CubicSpline(part.omega, getattr(part, name))(w))
        cells.append(_spread(x, y, labels))
    pair = [
        (i, j)
        for i, a in enumerate(one.heading)
        for j, b in enumerate(part.heading)
        if abs(np.exp(1j * a) - np.exp(1j * b)) < 1e-6
    ]
    if pair:
        i, j = pair[0]
        x = CubicSpline(one.omega, one.excitation[:, i])(w) * ratio
        y = CubicSpline(part.omega, part.excitation[:, j])(w)
        turning = np.array([c.endswith(("roll", "pitch", "yaw")) for c in labels])
        size = np.abs(y).max(axis=0)
        forced = size > 0.02 * np.where(turning, size[turning].max(), size[~turning].max())
        kept = [c for c, used in zip(labels, forced, strict=True) if used]
        cells.append(_spread(x[:, forced], y[:, forced], kept))
    else:
        cells.append("-")
    x, y = np.diag(one.added_mass_inf) * ratio, np.diag(part.added_mass_inf)
    cells.append(_median_and_worst(np.abs(x / y - 1.0), labels))
    cells.append(_statics(one, other))
    return cells


def twins(one: HydroDatabase, other: HydroDatabase) -> bool:
    """Tell whether two databases are of the same bodies: as many, of the same added mass."""
    if len(one.bodies) != len(other.bodies):
        return False
    for mine, theirs in zip(one.bodies, other.bodies, strict=True):
        a, b = (
            d.added_mass_inf[i, i] / d.rho
            for d, i in (
                (one, one.index(f"{mine}.heave")[0]),
                (other, other.index(f"{theirs}.heave")[0]),
            )
        )
        if not 0.6 < a / b < 1.6:
            return False
    return True


def _spread(x: np.ndarray, y: np.ndarray, labels: list[str]) -> str:
    if not x.size:
        return "-"
    rest = np.sqrt(np.mean(np.abs(x - y) ** 2, axis=0) / np.mean(np.abs(y) ** 2, axis=0))
    return _median_and_worst(rest, labels)


def _median_and_worst(rest: np.ndarray, labels: list[str]) -> str:
    return f"{np.median(rest):.1%}, {rest.max():.1%} {labels[int(rest.argmax())].split('.')[-1]}"


def _statics(one: HydroDatabase, other: HydroDatabase) -> str:
    """Largest difference of the displaced volumes."""
    errors = []
    for name, body in other.bodies.items():
        mine = one.bodies.get(name)
        if mine is None or mine.hydrostatics is None or body.hydrostatics is None:
            continue
        errors.append(mine.hydrostatics.displaced_volume / body.hydrostatics.displaced_volume - 1.0)
    return f"{max(map(abs, errors)):.1%}" if errors else "-"


def table(found: list[Entry]) -> str:
    """Return the table and the count of what came in without options, format by format."""
    groups: dict[str, list[Entry]] = {}
    for entry in found:
        groups.setdefault(entry.path.name.split("_")[0], []).append(entry)
    rows = []
    for group in groups.values():
        read = [e for e in group if e.database is not None]
        read.sort(key=lambda e: e.kind != "wamit")
        for entry in group:
            cells, name = ["-"] * 5, "-"
            mine = entry.database
            for other in read:
                if mine is None or other is entry or entry.kind == "wamit":
                    break
                assert other.database is not None
                if twins(mine, other.database):
                    cells, name = apart(mine, other.database), other.path.name
                    break
            needed = entry.needed.replace("|", "/")
            rows.append(
                f"| {entry.path.name} | {entry.kind} | {needed} | {' | '.join(cells)} | {name} |"
            )
    kinds = sorted({e.kind for e in found})
    counts = [
        f"{k} {sum(e.needed == 'none' for e in found if e.kind == k)} of "
        f"{sum(e.kind == k for e in found)}"
        for k in kinds
    ]
    return HEAD + "\n".join(rows) + f"\n\nWithout options: {', '.join(counts)}.\n"


def main() -> None:
    """Write the table into the page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folders", nargs="+", type=Path, metavar="FOLDER")
    folders = parser.parse_args().folders
    text = PAGE.read_text()
    before, _, rest = text.partition(BEGIN)
    after = rest.partition(END)[2]
    made = table(entries(folders))
    PAGE.write_text(f"{before}{BEGIN}\n{made}{END}{after}")
    print(made)


if __name__ == "__main__":
    sys.exit(guarded(main))
