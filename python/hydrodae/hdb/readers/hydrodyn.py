"""Input of OpenFAST's HydroDyn: what it says of the WAMIT tables that it names.

Lines are `value KEY - what it means`. `PotFile` names the tables without suffix; several bodies
have several names, which are not read here. Moments are about the platform's reference point, the
origin on the still water.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path, PureWindowsPath

import numpy as np

from hydrodae.hdb.readers.text import NUMBER, number, read_text

#: Larger files are no input of HydroDyn [bytes].
LARGEST_FILE = 1_000_000
#: How far above the tables the input is looked for.
ABOVE = 2


@dataclass(frozen=True)
class HydroDyn:
    """Settings of an input; None where it says DEFAULT, that is where another input says it.

    Attributes
    ----------
    path : Path
    rho, depth, length : float or None
        [kg/m3], [m], the length scale of the tables [m].
    """

    path: Path
    rho: float | None
    depth: float | None
    length: float | None


def hydrodyn_of(stem: Path) -> HydroDyn | None:
    """Return the input of HydroDyn whose `PotFile` is `stem`, from its folder or one above it.

    Parameters
    ----------
    stem : Path
        Tables without suffix.

    Returns
    -------
    HydroDyn or None
        None without one, or with several that differ.
    """
    folder = stem.parent
    for _ in range(ABOVE + 1):
        found = [h for p in sorted(folder.glob("*.dat")) if (h := _read(p, stem)) is not None]
        if found:
            alike = {(h.rho, h.depth, h.length) for h in found}
            return found[0] if len(alike) == 1 else None
        folder = folder.parent
    return None


def _read(path: Path, stem: Path) -> HydroDyn | None:
    if not path.is_file() or path.stat().st_size > LARGEST_FILE:
        return None
    text = read_text(path)
    named = re.search(r"^(.*?)\s+PotFile\b", text, re.MULTILINE)
    if named is None:
        return None
    files = re.findall(r'"([^"]*)"', named[1]) or [named[1].strip()]
    if len(files) != 1:
        return None
    target = PureWindowsPath(files[0])
    above = target.parent.name.lower()
    if target.name.lower() != stem.name.lower() or above not in ("", stem.parent.name.lower()):
        return None

    def value(key: str) -> float | None:
        found = re.search(rf"^\s*({NUMBER})\s+{key}\b", text, re.MULTILINE | re.IGNORECASE)
        return None if found is None else number(found[1])

    depth = value("WtrDpth")
    return HydroDyn(
        path,
        value("WtrDens"),
        np.inf if depth is not None and depth <= 0.0 else depth,
        value("WAMITULEN"),
    )
