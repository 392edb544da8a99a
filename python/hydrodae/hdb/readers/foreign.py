"""Files of other codes that are not read: what they are, and the way from there to one that is."""

from __future__ import annotations

from pathlib import Path

from hydrodae.hdb.readers.text import read_text

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
#: Beside a database they are read.
DRIFT = "its tables of second order are read with --second-order"
#: What files are by suffix, and what to do.
FOREIGN = {
    ".hdb": ("Diodore", CONVERTER),
    ".hdf": ("Diodore or HydroStar", f"{OWN_TABLES}; of Diodore's .hdb, {CONVERTER}"),
    ".rao": ("HydroStar", f"{OWN_TABLES}; {DRIFT}"),
    ".hyd": ("MOSES", f"no converter of it is known here: {OWN_TABLES}"),
    ".mat": ("MATLAB", CONVERTER),
    ".foam": ("FOAMM", CONVERTER),
    ".bem": ("BEMRosetta", "save it as WAMIT tables (.1, .3, .hst) there"),
    ".qtf": ("AQWA (quadratic transfer functions)", f"{NO_TABLES}; {DRIFT}"),
    ".ah2": ("AQWA (drift forces)", NO_TABLES),
    ".owr": ("OrcaWave (its results, binary)", ORCAFLEX),
    ".owd": ("OrcaWave (a model without results)", f"run it; then {ORCAFLEX}"),
}


def foreign(path: Path) -> str | None:
    """Return what a file that is not read here is and what to do, as a message; None if unknown."""
    suffix = path.suffix.lower()
    if suffix in FOREIGN:
        code, advice = FOREIGN[suffix]
        return f"{path}: a file of {code}, not read here; {advice}"
    if suffix in (".yml", ".yaml") and "# Type: Diffraction" in read_text(path)[:400]:
        return f"{path}: OrcaWave's model, without results; run it; then {ORCAFLEX}"
    if suffix not in (".csv", ".xlsx"):
        return None
    if suffix == ".xlsx" or "OrcaWave" in read_text(path)[:4000]:
        return f"{path}: a spreadsheet of OrcaWave, not read here; {ORCAFLEX}"
    return (
        f"{path}: a spreadsheet that does not say what stands in which column, not read here; give "
        f"tables in WAMIT's format (.1: period, I, J, A, B)"
    )


def foreign_in(folder: Path) -> str | None:
    """Return the same of the files of a folder; spreadsheets count if they are of OrcaWave."""
    order = [*FOREIGN, ".yml", ".yaml", ".csv", ".xlsx"]
    known = [p for p in folder.iterdir() if p.is_file() and p.suffix.lower() in order]
    for path in sorted(known, key=lambda p: (order.index(p.suffix.lower()), p)):
        text = foreign(path)
        if text is not None and "which column" not in text:
            return text
    return None
