"""Mean drift that BEMIO keeps in its `.h5` by the methods of WAMIT, over rho g.

`body<i>/hydro_coeffs/mean_drift/<method>/val` has shape (motion, heading, frequency); moments are
about `cg`. BEMIO takes the part at the phase of the wave, which is the whole of a mean.
"""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.files import DAMAGED, damaged
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.second_order import OF_ALL_BODIES
from hydrodae.hdb.readers.bemio import is_bemio_file
from hydrodae.hdb.readers.quadratic import Entries, of_coordinates
from hydrodae.hdb.readers.setting import Setting
from hydrodae.support.damaged import reading

#: Names of the groups, and the methods that they stand for.
METHODS = {
    "control_surface": "control surface",
    "momentum_conservation": "momentum",
    "pressure_integration": "pressure",
}


def find(source: Path) -> list[Path]:
    """Return the file itself, if it is one of BEMIO."""
    if not (source.is_file() and h5py.is_hdf5(source)):
        return []
    known = reading(source, damaged, DAMAGED, lambda f: is_bemio_file(f))
    return [source] if known else []


def read(path: Path, setting: Setting, findings: list[Finding]) -> list[Entries]:
    """Read one file, without loads that belong to no single body.

    Raises
    ------
    DatabaseError
        A table of another shape.
    """
    tables = reading(path, damaged, DAMAGED, lambda f: _tables(path, f, setting))
    found = []
    for (body, method), table in tables.items():
        if method in OF_ALL_BODIES and len(setting.bodies) > 1:
            text = f"{path.name}, mean drift of {body} by {method}: of all bodies, not read"
            findings.append(Finding("info", "second order", text))
        else:
            found.append(table)
    return found


def _tables(path: Path, f: h5py.File, setting: Setting) -> dict[tuple[str, str], Entries]:
    """Return the loads of each body by each method."""
    omega = f["simulation_parameters/w"][()].ravel()
    heading = np.radians(f["simulation_parameters/wave_dir"][()].ravel())
    scaled = bool(f["simulation_parameters/scaled"][()].ravel()[0])
    found = {}
    for number, body in enumerate(setting.bodies, 1):
        labels = [label for label in setting.labels if label.startswith(f"{body}.")][:6]
        for group, method in METHODS.items():
            name = f"body{number}/hydro_coeffs/mean_drift/{group}/val"
            if name not in f:
                continue
            value = f[name][()][:6]
            if value.shape != (6, heading.size, omega.size):
                raise DatabaseError(
                    f"{name}: expected shape (6, {heading.size}, {omega.size}), not {value.shape}"
                ).about("shape", name, file=path)
            h, w = np.indices(value.shape[1:]).reshape(2, -1)
            loads = (1.0 if scaled else setting.rho * setting.gravity) * value.reshape(6, -1).T
            of, waves = ("mean", method), (omega[w], heading[h])
            found[body, method] = of_coordinates(path, of, waves, labels, loads.astype(complex))
    return found
