"""Files of other codes that are not read: what they are, and the way from there to one that is."""

from __future__ import annotations

from pathlib import Path

BEMROSETTA = "BEMRosetta (github.com/BEMRosetta/BEMRosetta)"
#: Reads them, and saves what is read here.
CONVERTER = f"{BEMROSETTA} reads it and saves WAMIT tables (.1, .3, .hst)"
#: OrcaWave saves its results as .owr only; OrcaFlex opens these, and saves models as text.
ORCAFLEX = (
    "open its results (.owr) in OrcaFlex and save the model as a text data file (.yml), which is "
    f"read here; or, where OrcaWave is installed, {BEMROSETTA} turns .owr into WAMIT tables (.1, "
    ".3, .hst)"
)
OWN_TABLES = (
    "let it write tables in WAMIT's format (.1, .3, .hst, or its .out), which are read here"
)
NO_TABLES = "holds no added mass and damping; name the .AH1 or .LIS of the run"
#: What files are by suffix, and what to do.
FOREIGN = {
    ".hdb": ("Diodore", CONVERTER),
    ".hdf": ("Diodore or HydroStar", f"{OWN_TABLES}; of Diodore's .hdb, {CONVERTER}"),
    ".rao": ("HydroStar", OWN_TABLES),
    ".hyd": ("MOSES", f"no converter of it is known here: {OWN_TABLES}"),
    ".mat": ("MATLAB", CONVERTER),
    ".foam": ("FOAMM", CONVERTER),
    ".bem": ("BEMRosetta", "save it as WAMIT tables (.1, .3, .hst) there"),
    ".qtf": ("AQWA (quadratic transfer functions)", NO_TABLES),
    ".ah2": ("AQWA (drift forces)", NO_TABLES),
    ".owr": ("OrcaWave (its results, binary)", ORCAFLEX),
    ".owd": ("OrcaWave (a model without results)", f"run it; then {ORCAFLEX}"),
    ".csv": ("", ""),
    ".xlsx": ("", ""),
}


def foreign(path: Path) -> str | None:
    """Return what a file that is not read here is and what to do, as a message; None if unknown."""
    suffix = path.suffix.lower()
    if suffix not in FOREIGN:
        return None
    code, advice = FOREIGN[suffix]
    if suffix in (".csv", ".xlsx"):
        code, advice = _sheet(path)
    return f"{path}: a file of {code}, not read here; {advice}"


def _sheet(path: Path) -> tuple[str, str]:
    """Tell of which code a spreadsheet is; OrcaWave's say so in their first line."""
    with open(path, "rb") as file:
        head = file.read(4000)
    if b"OrcaWave" in head or path.suffix.lower() == ".xlsx":
        return "OrcaWave (a spreadsheet)", ORCAFLEX
    return (
        "a spreadsheet that does not say what stands in which column",
        f"give tables in WAMIT's format (.1: period, I, J, A, B); if it is of OrcaWave, {ORCAFLEX}",
    )
