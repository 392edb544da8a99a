"""Starters: folders with a commented case that runs at once, and its database."""

from __future__ import annotations

import difflib
import os
import shutil
from pathlib import Path

from hydrodae.errors import CaseError

#: Kinds of devices, and what each shows.
KINDS = {
    "point_absorber": "a buoy that heaves against the seabed through a power take-off",
    "flap": "a flap on a hinge at the seabed",
    "attenuator": "three hinged pontoons with a power take-off in each hinge",
    "array": "three buoys that radiate into each other",
    "moored": "a float on a submerged body that is held by mooring lines",
    "owc": "a fixed water column whose air drives a Wells turbine",
    "spar_owc": "a moored spar with a water column, whose air drives a turbine with a rotor",
    "flexible_barge": "a barge with a hinge as its mode, and a power take-off on its bend",
}
#: What every starter has beside its own files.
SHARED = ("README.md", "power_matrix.toml")


def create(kind: str, folder: str | os.PathLike[str] | None = None) -> Path:
    """Write a starter: case.toml, hydro.h5, database.sh, power_matrix.toml, README.md.

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    folder : path, optional
        A new or empty folder; default: one with the name of the kind.

    Returns
    -------
    Path
        The case file.

    Raises
    ------
    CaseError
        There is no such kind, or the folder is not empty.
    """
    if kind not in KINDS:
        near = difflib.get_close_matches(kind, KINDS, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise CaseError(f"no starter {kind!r}{hint} (valid: {', '.join(KINDS)})")
    target = Path(folder if folder is not None else kind)
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise CaseError(f"{target}: is there already; name a new or empty folder")
    target.mkdir(parents=True, exist_ok=True)
    home = Path(__file__).parent
    for file in [*sorted((home / kind).iterdir()), *(home / name for name in SHARED)]:
        shutil.copyfile(file, target / file.name)
    return target / "case.toml"
