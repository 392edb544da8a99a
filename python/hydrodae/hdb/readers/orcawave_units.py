"""Units and water of data files of OrcaFlex and OrcaWave."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.readers.orcayaml import read_yaml
from hydrodae.hdb.readers.text import read_text

#: kg in the unit of mass, by the units of length, mass and force of OrcaFlex's system "User".
USER_UNITS = {("m", "te", "kN"): 1000.0, ("m", "kg", "N"): 1.0}
STANDARD_GRAVITY = 9.80665


def kilograms_of(path: Path, settings: dict[str, Any]) -> tuple[float, float]:
    """Return kg in the unit of mass of a file, and gravity [m/s2]."""
    system = settings.get("UnitsSystem", "SI")
    if system == "SI":
        return 1000.0, STANDARD_GRAVITY
    keys = ("LengthUnits", "MassUnits", "ForceUnits")
    units = tuple(str(settings.get(key)) for key in keys)
    if system != "User" or units not in USER_UNITS:
        named = " ".join(units) if system == "User" else str(system)
        raise DatabaseError(
            f"{path}: units {named}: expected SI, or m, te, kN or m, kg, N: choose them in "
            f"OrcaFlex and save again"
        )
    gravity = settings.get("g", STANDARD_GRAVITY)
    if not isinstance(gravity, float):
        raise DatabaseError(f"{path}: g: expected a number, got {gravity!r}")
    return USER_UNITS[units], gravity


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
            unit, gravity = kilograms_of(beside, settings)
            return unit * rho, gravity, depth, [path, beside]
    unit, gravity = kilograms_of(path, model.get("General") or {})
    environment = model.get("Environment") or {}
    rho, depth = environment.get("Density"), environment.get("WaterDepth")
    if not isinstance(rho, float) or not isinstance(depth, float):
        raise DatabaseError(f"{path}: no Density and WaterDepth in Environment")
    text = (
        f"depth {depth:g} m is that of the OrcaFlex model; the diffraction analysis may have had "
        f"another one (OrcaWave's own .yml, put beside it, tells)"
    )
    findings.append(Finding("warning", "assumption", text))
    return unit * rho, gravity, depth, [path]
