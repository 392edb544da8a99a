"""Results of OrcaWave as a vessel type of an OrcaFlex data file (`.yml`).

Units are those that the file says; OrcaFlex's SI are t, kN and m. Amplitudes and phases follow the
conventions stated in the file; they are turned into x(t) = Re(X e^{+iwt}) with the phase zero of
the wave at the origin. Directions are those of travel; where the file states a symmetry, it holds
one part of them, and the others follow.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import unique_names
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import six_of_each
from hydrodae.hdb.readers.foreign import CONVERTER
from hydrodae.hdb.readers.formats import Format
from hydrodae.hdb.readers.orcawave_units import Units, units_of, water_of
from hydrodae.hdb.readers.orcayaml import read_yaml
from hydrodae.hdb.readers.source import SourceData, without_hydrostatics
from hydrodae.hdb.readers.symmetric import mirrored_forces, turned_forces
from hydrodae.hdb.readers.text import line_of, only, read_text
from hydrodae.support.arrays import Array, Complex
from hydrodae.support.naming import names_file

#: Positive senses that agree with right-handed axes, x forward, z up; others change the sign.
SENSES = {
    "SurgePositive": "forward",
    "SwayPositive": "port",
    "HeavePositive": "up",
    "RollPositiveStarboard": "down",
    "PitchPositiveBow": "down",
    "YawPositiveBow": "port",
}
#: Planes of symmetry by OrcaFlex's words: y = 0 (across), x = 0 (along).
SYMMETRIES = {
    "None": {},
    "xz plane": {"across": True},
    "yz plane": {"along": True},
    "xz and yz planes": {"across": True, "along": True},
    "Circular": {},
}
_TABLES = "FrequencyDependentAddedMassAndDamping"


def orcawave_file(path: Path) -> Path | None:
    """Return the `.yml` file with hydrodynamic tables that is meant by a file or folder, or None.

    Raises
    ------
    DatabaseError
        Several such files.
    """
    paths = [path] if path.is_file() else sorted(path.iterdir())
    found = [p for p in paths if p.suffix.lower() in (".yml", ".yaml") and _has_tables(p)]
    return only(found)


def _has_tables(path: Path) -> bool:
    return _TABLES in read_text(path)


@names_file
def read_orcawave(path: Path) -> SourceData:
    """Read the vessel types of an OrcaFlex data file.

    Returns
    -------
    SourceData
        The matrix at infinite frequency becomes `added_mass_inf`, that at zero is left out. Bodies
        have no coupling: vessel types hold their own matrices only.

    Raises
    ------
    DatabaseError
        Something is missing, or a convention is unknown.
    """
    model = read_yaml(path)
    if "MultibodyGroups" in model:
        raise DatabaseError(
            f"a multibody group, whose coupling is not read here; {CONVERTER}"
        ).about("unsupported")
    types = model.get("VesselTypes")
    if not isinstance(types, list) or not types:
        raise DatabaseError("no VesselTypes in it").about("missing", "VesselTypes")
    findings: list[Finding] = []
    units = units_of(path, model.get("General") or {})
    rho, gravity, depth, files = water_of(path, model, findings)
    bodies = [Vessel(path, vessel, units) for vessel in types]
    names = unique_names([str(b.name).removesuffix(" type") for b in bodies])
    omega, heading = bodies[0].omega, bodies[0].heading
    for body in bodies[1:]:
        if not np.array_equal(body.omega, omega) or not np.array_equal(body.heading, heading):
            raise DatabaseError("vessel types with different frequencies or directions").about(
                "conflict"
            )
    size = 6 * len(bodies)
    a, b = np.zeros((omega.size, size, size)), np.zeros((omega.size, size, size))
    inf = np.zeros((size, size))
    force = np.zeros((omega.size, heading.size, size), dtype=complex)
    for i, body in enumerate(bodies):
        own = slice(6 * i, 6 * i + 6)
        a[:, own, own], b[:, own, own], force[:, :, own] = body.added_mass, body.damping, body.force
        if body.at_infinity is not None:
            inf[own, own] = body.at_infinity
    if len(bodies) > 1:
        text = "vessel types hold no coupling between bodies: each is taken to radiate alone"
        findings.append(Finding("warning", "coordinates", text))
    data = SourceData(
        coordinates=six_of_each(names),
        omega=omega,
        added_mass=a,
        radiation_damping=b,
        heading=heading,
        excitation=force,
        reference_points={name: b.point for name, b in zip(names, bodies, strict=True)},
        rho=rho,
        gravity=gravity,
        water_depth=depth,
        name=path.name,
        title=f"OrcaWave {path.stem}",
        added_mass_inf=inf if all(b.at_infinity is not None for b in bodies) else None,
        files=files,
        findings=findings,
    )
    data.to_origin({name: b.wave_point for name, b in zip(names, bodies, strict=True)})
    for name, body in zip(names, bodies, strict=True):
        statics = body.hydrostatics()
        if statics is None:
            text = f"{name}: the stiffness is not about the centre of mass; left out"
            findings.append(without_hydrostatics(text, [name]))
        else:
            data.add_statics(name, *statics)
    return data


def starting(block: dict[str, Any], word: str) -> Any:
    """Return the value of the first key that begins with a word; None without one."""
    return next((value for key, value in block.items() if key.startswith(word)), None)


def all_round(symmetry: str, heading: Array, force: Complex) -> tuple[Array, Complex]:
    """Add the headings [rad] that a symmetry of OrcaFlex gives to a force (nw, nh, 6)."""
    if symmetry == "Circular":
        return turned_forces(heading, force)
    return mirrored_forces(heading, force, **SYMMETRIES[symmetry])


class Vessel:
    """Tables of one vessel type, at its first draught, in SI units, and what reads its numbers."""

    def __init__(self, path: Path, vessel: dict[str, Any], units: Units) -> None:
        self.path, self.name, self.units = path, vessel.get("Name", "vessel"), units
        self.sign = np.array(
            [1.0 if vessel.get(key, word) == word else -1.0 for key, word in SENSES.items()]
        )
        self.symmetry = str(vessel.get("Symmetry", "None"))
        if self.symmetry not in SYMMETRIES:
            raise DatabaseError(
                f"{self.name}: Symmetry {self.symmetry!r}: expected one of "
                f"{', '.join(SYMMETRIES)}; save all directions in OrcaFlex (Symmetry: None)"
            ).about("unsupported", "Symmetry")
        draught = self.entry(vessel, "Draughts")[0]
        self.draught = draught
        self.waves = vessel.get("WavesReferredToBy", "period (s)")
        entries = self.entry(draught, _TABLES)
        w = np.array([self.omega_of(e.get("AMDPeriodOrFrequency")) for e in entries])
        a = np.array([self._square(e, "AddedMassMatrixX", units.mass) for e in entries])
        b = np.array([self._square(e, "DampingX", units.force / units.length) for e in entries])
        usual = np.isfinite(w) & (w > 0.0)
        order = np.flatnonzero(usual)[np.argsort(w[usual])]
        self.omega, self.added_mass, self.damping = w[order], a[order], b[order]
        self.at_infinity = a[np.isinf(w)][0] if np.isinf(w).any() else None
        self.point = self.vector(draught, "ReferenceOrigin")
        self.heading, self.force = self._forces(vessel)

    def entry(self, where: dict[str, Any], key: str) -> list[Any]:
        """Return a list that must be there."""
        value = where.get(key)
        if not isinstance(value, list) or not value:
            raise DatabaseError(f"{self.name}: no {key}").about("missing", key)
        return value

    def vector(self, where: dict[str, Any], key: str) -> Array:
        """Return a place (3,) [m]."""
        return self.units.length * self.numbers(where.get(key), key, (3,))

    def numbers(self, value: Any, key: str, shape: tuple[int, ...]) -> Array:
        """Return a list, or a list of rows, as an array of that shape."""
        rows = value if isinstance(value, list) else []
        flat = [v for row in rows for v in (row if isinstance(row, list) else [row])]
        size = " x ".join(str(n) for n in shape)
        for wrong in (v for v in flat if not isinstance(v, float)):
            raise DatabaseError(
                f"{self.name}: {key}: {wrong!r} is not a number; expected {size}"
            ).about("format", key, line=line_of(self.path, str(wrong)))
        even = all(isinstance(row, list) and len(row) == shape[-1] for row in rows)
        if len(rows) != shape[0] or (len(shape) > 1 and not even):
            raise DatabaseError(f"{self.name}: {key}: expected {size} numbers").about("shape", key)
        return np.array(rows, dtype=float)

    def omega_of(self, value: Any) -> float:
        """Return a period or frequency of the file as a frequency [rad/s]."""
        if isinstance(value, str) and value.lower() == "infinity":
            value = np.inf
        if not isinstance(value, float) or np.isnan(value):
            raise DatabaseError(f"{self.name}: {value!r} is no period or frequency").about(
                "format", line=line_of(self.path, str(value))
            )
        if self.waves.startswith("frequency (rad"):
            return value
        if self.waves.startswith("frequency (Hz"):
            return float(2.0 * np.pi * value)
        if value == 0.0:
            return float(np.inf)
        return float(2.0 * np.pi / value)

    def rows_of(self, rows: list[Any], key: str, waves: int, columns: int) -> Array:
        """Return rows of periods of waves and values, without those of w = 0 and inf; [rad/s]."""
        given = [
            [*(self.omega_of(w) for w in row[:waves]), *row[waves:]]
            for row in rows
            if isinstance(row, list) and row
        ]
        table = self.numbers(given, key, (len(rows), columns))
        return table[np.all(np.isfinite(table[:, :waves]) & (table[:, :waves] > 0.0), axis=1)]

    def _square(self, entry: dict[str, Any], first: str, unit: float) -> Array:
        table = self.numbers(starting(entry, first), first, (6, 6))
        return unit * table * np.outer(self.scale, self.scale)

    @property
    def scale(self) -> Array:
        """Signs of the axes, and the length by which moments and angles are another unit."""
        return self.sign * self.units.length ** np.array([0.0, 0.0, 0.0, 1.0, 1.0, 1.0])

    def phases(self, vessel: dict[str, Any]) -> tuple[float, float]:
        """Return the factor of phases to those of e^{+iwt} [rad], and the sign of the wave.

        Raises
        ------
        DatabaseError
            An unknown convention.
        """
        unit = vessel.get("RAOPhaseUnitsConvention", "degrees")
        relative = vessel.get("RAOPhaseRelativeToConvention", "crest")
        if unit not in ("degrees", "radians") or relative not in ("crest", "trough"):
            raise DatabaseError(f"{self.name}: phases in {unit} about the {relative}").about(
                "unsupported", "phases"
            )
        sense = 1.0 if vessel.get("RAOPhaseConvention", "leads") == "leads" else -1.0
        sense *= np.pi / 180.0 if unit == "degrees" else 1.0
        return sense, 1.0 if relative == "crest" else -1.0

    def _forces(self, vessel: dict[str, Any]) -> tuple[Array, Complex]:
        """Headings [rad] and excitation (nw, nh, 6), with its phase zero at `wave_point`."""
        loads = self.draught.get("LoadRAOs") or {}
        blocks = self.entry(loads, "RAOs")
        self.check_origin(loads)
        sense, crest = self.phases(vessel)
        factor = crest * self.units.force / self.units.length
        if vessel.get("RAOWaveUnit", "amplitude") != "amplitude":
            factor *= 2.0
        stated = [block.get("RAODirection") for block in blocks]
        heading = self.numbers(stated, "RAODirection", (len(blocks),))
        result = np.empty((self.omega.size, heading.size, 6), dtype=complex)
        for h, block in enumerate(blocks):
            table = self.rows_of(starting(block, "RAOPeriod") or [], "LoadRAOs", 1, 13)
            table = table[np.argsort(table[:, 0])]
            if table.shape != (self.omega.size, 13) or not np.allclose(table[:, 0], self.omega):
                raise DatabaseError(
                    f"{self.name}: LoadRAOs at other frequencies than added mass"
                ).about("conflict", "frequencies")
            result[:, h] = factor * table[:, 1::2] * np.exp(1j * sense * table[:, 2::2])
        self.wave_point = self.phase_place(loads)
        result *= self.scale
        beta = np.radians(heading)
        beta, result = all_round(self.symmetry, beta, result)
        order = np.argsort(beta)
        return beta[order], result[:, order]

    def check_origin(self, loads: dict[str, Any]) -> None:
        """Refuse loads about another point than the reference origin."""
        if not np.allclose(self.vector(loads, "RAOOrigin"), self.point, atol=1e-6):
            raise DatabaseError(
                f"{self.name}: RAOOrigin {loads.get('RAOOrigin')} is not ReferenceOrigin "
                f"{self.point.tolist()}: export both about one point"
            ).about("point", self.name)

    def phase_place(self, loads: dict[str, Any]) -> Array:
        """Return where the wave has its phase zero, (3,) [m]; `~` stands for the RAO origin."""
        stated = loads.get("PhaseOrigin")
        if stated is None or any(v is None for v in stated):
            return self.point
        return self.vector(loads, "PhaseOrigin")

    def hydrostatics(self) -> tuple[Array, Array, float, Array] | None:
        """Stiffness of heave, roll and pitch, its point, volume and centre of buoyancy.

        None if it is about another point: then the weight may or may not be in it.
        """
        rows = starting(self.draught, "HydrostaticStiffnessz")
        block = self.numbers(rows, "HydrostaticStiffness", (3, 3))
        stiffness = np.zeros((6, 6))
        scale = self.scale[2:5]
        unit = self.units.force / self.units.length
        stiffness[2:5, 2:5] = unit * block * np.outer(scale, scale)
        mass_center = self.vector(self.draught, "CentreOfMass")
        if abs(mass_center[2] - self.point[2]) > 1e-6:
            return None  # the file does not say whether the weight is in the stiffness
        volume = self.draught.get("DisplacedVolume")
        if not isinstance(volume, float):
            raise DatabaseError(f"{self.name}: DisplacedVolume: expected a number").about(
                "format", "DisplacedVolume"
            )
        volume *= self.units.length**3
        return stiffness, self.point, volume, self.vector(self.draught, "CentreOfBuoyancy")


FORMAT = Format(".yml with OrcaWave's results", orcawave_file, read_orcawave)
