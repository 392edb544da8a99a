"""Names that WEC-Sim had up to version 4, and those that it has now."""

from __future__ import annotations

_START = {
    "initDisp.initLinDisp": "initial.displacement",
    "initDisp.initAngularDispAxis": "initial.axis",
    "initDisp.initAngularDispAngle": "initial.angle",
}
_NEW = {
    "simu": {
        "CITime": "cicEndTime",
        "ssCalc": "stateSpace",
        "dtCITime": "cicDt",
        "dtNL": "nonlinearDt",
        "dtME": "morisonDt",
        "g": "gravity",
        "domainsize": "domainSize",
        "ParaView": "paraview.option",
    },
    "waves": {
        "T": "period",
        "H": "height",
        "waveDir": "direction",
        "waveSpread": "spread",
        "spectrumDataFile": "spectrumFile",
        "etaDataFile": "elevationFile",
        "freqDisc": "bem.option",
        "numFreq": "bem.count",
        "freqRange": "bem.range",
        "currentOption": "current.option",
        "currentSpeed": "current.speed",
        "currentDirection": "current.direction",
        "currentDepth": "current.depth",
    },
    "body": {
        "momOfInertia": "inertia",
        "cg": "centerGravity",
        "cb": "centerBuoyancy",
        "dispVol": "volume",
        "nhBody": "nonHydro",
        "nlHydro": "nonlinearHydro",
        "flexHydroBody": "flex",
        "viscDrag.Drag": "quadDrag.drag",
        "viscDrag.cd": "quadDrag.cd",
        "viscDrag.characteristicArea": "quadDrag.area",
        "morisonElement.characteristicArea": "morisonElement.area",
        **_START,
    },
    "constraint": {"loc": "location", **_START},
    "pto": {"loc": "location", "k": "stiffness", "c": "damping", **_START},
    "mooring": {
        "ref": "location",
        "matrix.k": "matrix.stiffness",
        "matrix.c": "matrix.damping",
        **_START,
    },
}
#: Types of waves that had other names.
WAVES = {"etaImport": "elevationImport", "userDefined": "elevationImport"}


def new_name(kind: str, field: str) -> str:
    """The name that a field has now."""
    return _NEW.get(kind, {}).get(field, field)
