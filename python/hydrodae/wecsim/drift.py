"""Mean drift of bodies: which table of the source `meanDrift` of an input file means.

WEC-Sim adds T(w, w) a^2 of each wave to the excitation: in a regular wave T a^2. In its random seas
the sum is of S(w) dw, half of a^2; here each component has a^2.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.readers.kinds import kind
from hydrodae.hdb.readers.reading import read_source
from hydrodae.hdb.readers.second_order import named
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.text import CaseText

#: Methods of the values of `meanDrift`.
METHODS = {1: "control surface", 2: "momentum", 3: "pressure"}


def drifting(read: InputFile) -> list[Item]:
    """Bodies of an input file with mean drift; WEC-Sim turns it off beside QTFs.

    Raises
    ------
    CaseError
        A value that WEC-Sim does not have.
    """
    found = []
    for item in read.of("body"):
        option = item.whole("meanDrift")
        place = read.place(item.line_of("meanDrift"))
        if option not in (0, *METHODS):
            names = ", ".join(f"{value} ({name})" for value, name in METHODS.items())
            raise CaseError(
                f"{place}: {item.title}.meanDrift is {option}; expected 0 (none), {names}"
            )
        if option and item.whole("QTFs"):
            text = f"{item.title}.meanDrift (WEC-Sim turns it off beside QTFs)"
            read.remarks.not_needed(place, text)
        elif option and item.whole("nonlinearHydro"):
            text = f"{item.title}: mean drift forces, which the pressure on the mesh counts too"
            read.remarks.left_out(place, text)
        elif option:
            found.append(item)
    return found


def add_drift(text: CaseText, read: InputFile, database: HydroDatabase) -> None:
    """Add [second_order] where bodies drift in waves."""
    bodies = drifting(read)
    if bodies and "mean" in database.second_order and "[[wave]]" in text.lines:
        titles = ", ".join(item.title for item in bodies)
        text.table("[second_order]", {"loads": ["mean"]}, f"meanDrift of {titles}")


def with_drift(
    database: HydroDatabase, source: Path, names: Mapping[str, str], read: InputFile
) -> HydroDatabase:
    """Return the database with a table of mean drift of those bodies alone that drift.

    Parameters
    ----------
    database : HydroDatabase
        In the water of its source.
    source : Path
        Files of the database.
    names : mapping of str
        Name of each body of the source, in its order.
    """
    bodies = drifting(read)
    if not bodies:
        return database
    mean: SecondOrderTable | None = None
    of_source = list(names.values())
    for item in bodies:
        method = METHODS[item.whole("meanDrift")]
        body = of_source[item.number - 1 if item.number <= len(of_source) else 0]
        labels = [f"{body}.{dof}" for dof in DOFS]
        table, why = _tables(source, names, method)
        found = None if table is None else table.selected(labels)
        if found is None or set(found.method) != {method}:
            place = read.place(item.line_of("meanDrift"))
            text = f"{item.title}: mean drift by {method}, of which {source.name} has no table"
            read.remarks.left_out(place, f"{text}{why}")
        else:
            mean = found if mean is None else mean.beside(found)
    tables = {kind: table for kind, table in database.second_order.items() if kind != "mean"}
    return replace(database, second_order=tables | ({} if mean is None else {"mean": mean}))


def _tables(
    source: Path, names: Mapping[str, str], method: str
) -> tuple[SecondOrderTable | None, str]:
    """Return the mean drift that a source holds by a method, and why there is none."""
    if kind(source) == "hydro":
        return HydroDatabase.read(source).renamed(names).second_order.get("mean"), ""
    findings: list[Finding] = []
    try:
        table = named({"": [source]}, read_source(source), findings, (method,)).get("mean")
    except DatabaseError as error:
        return None, f" ({error})"
    if table is None:
        return None, "".join(f" ({finding.message})" for finding in findings)
    parts = [label.split(".") for label in table.coordinates]
    return replace(table, coordinates=tuple(f"{names[b]}.{dof}" for b, dof in parts)), ""
