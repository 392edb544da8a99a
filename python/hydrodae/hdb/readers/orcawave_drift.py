"""Second order of OrcaWave: wave drift and sum-frequency QTFs of a vessel type in a `.yml` file.

Conventions of phases, senses, units and symmetry are those that the file states, as for the loads
of first order; QTFs are always over amplitudes.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import six_of_each
from hydrodae.hdb.readers.orcawave import Vessel, all_round, starting
from hydrodae.hdb.readers.orcawave_units import units_of
from hydrodae.hdb.readers.orcayaml import read_yaml
from hydrodae.hdb.readers.quadratic import Entries, of_coordinates
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.text import read_text
from hydrodae.support.arrays import Array, Complex

#: Keys of a draught, and the kind of their tables of pairs.
KEYS = {"WaveDrift": "difference", "SumFrequencyQTFs": "sum"}
AMPLITUDE, PAIR = "RAOPeriodOrFrequency,", "RAOPeriodOrFrequency1"
METHOD = "not stated"


def find(source: Path) -> list[Path]:
    """Return the `.yml` file if it holds such tables."""
    if source.suffix.lower() not in (".yml", ".yaml"):
        return []
    text = read_text(source)
    return [source] if "VesselTypes" in text and any(f"{key}:" in text for key in KEYS) else []


def read(path: Path, setting: Setting, findings: list[Finding]) -> list[Entries]:
    """Read a file.

    Raises
    ------
    DatabaseError
        Another number of vessel types than bodies, an unknown convention, or numbers that lack.
    """
    model = read_yaml(path)
    types = model.get("VesselTypes") or []
    if len(types) != len(setting.bodies):
        raise DatabaseError(
            f"{len(types)} vessel types, the database has {len(setting.bodies)} bodies"
        ).about("conflict", "bodies", file=path)
    units = units_of(path, model.get("General") or {})
    found: list[Entries] = []
    for body, vessel in zip(setting.bodies, types, strict=True):
        try:
            read_vessel = Vessel(path, vessel, units)
            found += _of_vessel(path, vessel, read_vessel, body, setting)
        except DatabaseError as error:
            raise error.in_file(path) from None
    return found


def _of_vessel(
    path: Path, vessel: dict[str, Any], read: Vessel, body: str, setting: Setting
) -> list[Entries]:
    if vessel.get("RAOWaveUnit", "amplitude") != "amplitude":
        raise DatabaseError(
            f"RAOWaveUnit {vessel['RAOWaveUnit']!r}: expected amplitude; change it in OrcaFlex"
        ).about("unsupported", "RAOWaveUnit")
    setting.check_point(body, read.point, path)
    sense, _ = read.phases(vessel)
    found = []
    for key, kind in KEYS.items():
        loads = read.draught.get(key) or {}
        pairs = starting(loads, PAIR)
        if not pairs and not loads.get("RAOs"):
            continue
        read.check_origin(loads)
        if pairs:
            waves, heading, values = _pairs(read, pairs, sense)
        else:
            kind = "mean"
            waves, heading, values = _diagonal(read, loads)
        values = values * read.scale * read.units.force / read.units.length**2
        waves, heading, values = _all_round(read.symmetry, waves, heading, values)
        place = read.phase_place(loads) if pairs else read.point
        labels, of = six_of_each([body]), (kind, METHOD)
        found.append(
            of_coordinates(path, of, (waves, heading), labels, values, wave_point=place[:2])
        )
    return found


def _diagonal(read: Vessel, loads: dict[str, Any]) -> tuple[Array, Array, Complex]:
    """Return frequencies (m, 2), headings (m, 2) [rad] and loads (m, 6) of mean drift."""
    waves, headings, values = [], [], []
    for block in read.entry(loads, "RAOs"):
        table = read.rows_of(starting(block, AMPLITUDE) or [], "WaveDrift", 1, 7)
        direction = read.numbers([block.get("RAODirection")], "RAODirection", (1,))
        waves.append(np.column_stack([table[:, 0], table[:, 0]]))
        headings.append(np.full((len(table), 2), np.radians(direction[0])))
        values.append(table[:, 1:].astype(complex))
    return np.concatenate(waves), np.concatenate(headings), np.concatenate(values)


def _pairs(read: Vessel, rows: list[Any], sense: float) -> tuple[Array, Array, Complex]:
    """Return frequencies (m, 2), headings (m, 2) [rad] and loads (m, 6) of pairs of waves."""
    table = read.rows_of(rows, "QTFs", 2, 16)
    values = table[:, 4::2] * np.exp(1j * sense * table[:, 5::2])
    return table[:, :2], np.radians(table[:, 2:4]), values


def _all_round(
    symmetry: str, waves: Array, heading: Array, values: Complex
) -> tuple[Array, Array, Complex]:
    """Add the mirror images, or turn the loads of a body of revolution, one pair after another."""
    if symmetry == "None":
        return waves, heading, values
    if not np.array_equal(heading[:, 0], heading[:, 1]):
        raise DatabaseError(
            f"Symmetry {symmetry!r} with pairs of headings: save all directions in OrcaFlex "
            f"(Symmetry: None)"
        ).about("unsupported", "Symmetry")
    found: list[tuple[Array, Array, Complex]] = []
    for pair in np.unique(waves, axis=0):
        here = np.all(waves == pair, axis=1)
        beta, load = heading[here, 0], values[None, here]
        beta, load = all_round(symmetry, beta, load)
        both = np.column_stack([beta, beta])
        found.append((np.tile(pair, (beta.size, 1)), both, load[0]))
    return tuple(np.concatenate(x) for x in zip(*found, strict=True))  # type: ignore[return-value]
