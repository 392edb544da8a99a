"""Units and water of data files of OrcaFlex and OrcaWave."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.orcayaml import read_yaml
from hydrodae.hdb.readers.text import read_text

#: By the words of OrcaFlex's system "User" [m], [kg], [N].
LENGTHS = {"m": 1.0, "km": 1e3, "mm": 1e-3, "ft": 0.3048, "in": 0.0254}
MASSES = {"kg": 1.0, "te": 1e3, "t": 1e3, "lb": 0.45359237, "lbm": 0.45359237}
FORCES = {"N": 1.0, "kN": 1e3, "MN": 1e6, "lbf": 4.4482216152605, "kip": 4448.2216152605}
STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True)
class Units:
    """Units of a file: of length [m], mass [kg] and force [N], each by itself; and gravity.

    Added masses are masses times lengths; damping, stiffness and loads are forces times lengths.
    The unit of time is the second.

    Attributes
    ----------
    length, mass, force : float
        [m], [kg], [N].
    gravity : float
        [m/s2].
    """

    length: float = 1.0
    mass: float = 1e3
    force: float = 1e3
    gravity: float = STANDARD_GRAVITY

    @property
    def density(self) -> float:
        """[kg/m3]."""
        return self.mass / self.length**3


def units_of(path: Path, settings: dict[str, Any]) -> Units:
    """Return the units of a file: SI, which is m, t and kN, or those of the system "User".

    Raises
    ------
    DatabaseError
        Another system or unit.
    """
    system = settings.get("UnitsSystem", "SI")
    if system == "SI":
        return Units()
    if system != "User":
        raise DatabaseError(
            f"UnitsSystem {system}: expected SI or User: choose one in OrcaFlex and save again"
        ).about("units", "UnitsSystem", file=path)
    found = []
    for key, known in (("LengthUnits", LENGTHS), ("MassUnits", MASSES), ("ForceUnits", FORCES)):
        word = str(settings.get(key))
        if word not in known:
            raise DatabaseError(
                f"{key} {word}: expected {', '.join(known)}: choose one in OrcaFlex and save again"
            ).about("units", key, file=path)
        found.append(known[word])
    gravity = settings.get("g", STANDARD_GRAVITY / found[0])
    if not isinstance(gravity, float):
        raise DatabaseError(f"g: expected a number, got {gravity!r}").about(
            "format", "g", file=path
        )
    return Units(found[0], found[1], found[2], gravity * found[0])


def water_of(
    path: Path, model: dict[str, Any], findings: list[Finding]
) -> tuple[float, float, float, list[Path]]:
    """Density, gravity and depth: of OrcaWave's own input beside the file, else of the model.

    A model that imports results keeps its own depth (100 m unless changed), whatever the depth of
    the diffraction analysis was.
    """
    for beside in sorted(path.parent.iterdir()):
        if beside == path or beside.suffix.lower() not in (".yml", ".yaml"):
            continue
        head = read_text(beside)[:400]
        if "# Type: Diffraction" not in head:
            continue
        settings = read_yaml(beside)
        rho, depth = settings.get("WaterDensity"), settings.get("WaterDepth")
        if isinstance(rho, float) and isinstance(depth, float):
            text = f"density and depth from {beside.name} beside it"
            findings.append(Finding("info", "assumption", text))
            units = units_of(beside, settings)
            return units.density * rho, units.gravity, units.length * depth, [path, beside]
    units = units_of(path, model.get("General") or {})
    environment = model.get("Environment") or {}
    rho, depth = environment.get("Density"), environment.get("WaterDepth")
    if not isinstance(rho, float) or not isinstance(depth, float):
        raise DatabaseError("no Density and WaterDepth in Environment").about(
            "missing", "water", file=path
        )
    depth *= units.length
    text = (
        f"depth {depth:g} m is that of the OrcaFlex model; the diffraction analysis may have had "
        f"another one (OrcaWave's own .yml, put beside it, states it)"
    )
    findings.append(Finding("warning", "assumption", text))
    return units.density * rho, units.gravity, depth, [path]
