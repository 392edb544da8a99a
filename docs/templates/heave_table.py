"""Read a table of one body in heave: `NAME.heave`, a header and rows w, A33, B33, Re F3, Im F3.

The header states the water and the reference point::

    # density=1025 gravity=9.81 depth=inf point=0,0,-2

w is in rad/s, A33 in kg, B33 in N s/m, F3 in N per metre of amplitude at heading 0. A motion is
Re(X exp(i w t)), the convention of the project.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.formats import Format
from hydrodae.hdb.readers.source import SourceData, without_hydrostatics


def heave_file(path: Path) -> Path | None:
    """Return the `.heave` file that a file or folder means; None if there is none.

    Raises
    ------
    DatabaseError
        Several such files.
    """
    paths = [path] if path.is_file() else sorted(path.iterdir())
    found = [p for p in paths if p.suffix == ".heave"]
    if len(found) > 1:
        names = ", ".join(p.name for p in found)
        raise DatabaseError(f"which one is meant? {names}").about("ambiguous", file=path)
    return found[0] if found else None


def read_heave(path: Path) -> SourceData:
    """Read a `.heave` file.

    Raises
    ------
    DatabaseError
        The header or a row cannot be read; the message names the file.
    """
    lines = path.read_text().splitlines()
    try:
        header = dict(word.split("=", 1) for word in lines[0].lstrip("# ").split())
        density, gravity, depth = (float(header[k]) for k in ("density", "gravity", "depth"))
        point = np.array([float(x) for x in header["point"].split(",")])
        omega, a, b, real, imaginary = np.loadtxt(lines[1:], ndmin=2, unpack=True)
    except (KeyError, ValueError, IndexError) as error:
        raise DatabaseError(
            f"{error}; expected '# density=... gravity=... depth=... point=x,y,z' and rows "
            "of w, A33, B33, Re F3, Im F3"
        ).about("format", file=path) from error
    name = path.stem
    return SourceData(
        coordinates=(f"{name}.heave",),
        omega=omega,
        added_mass=a[:, None, None],
        radiation_damping=b[:, None, None],
        heading=np.zeros(1),
        froude_krylov=None,
        diffraction=None,
        excitation=(real + 1j * imaginary)[:, None, None],
        reference_points={name: point},
        rho=density,
        gravity=gravity,
        water_depth=depth,
        name="heave table",
        title=name,
        files=[path],
        findings=[without_hydrostatics("the table has no hydrostatics", [name])],
    )


FORMAT = Format(".heave of one body", heave_file, read_heave)
