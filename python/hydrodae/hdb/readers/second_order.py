"""Tables of second order of any program: which files hold them, which of several is taken.

A new format: a module here with `find(path)`, its files, and `read(file, setting, findings)`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import ModuleType

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.coordinates import check_body
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.second_order import KINDS, SecondOrderTable
from hydrodae.hdb.labels import bodies_of, six_of_each
from hydrodae.hdb.readers import (
    aqwa_drift,
    bemio_drift,
    capytaine_drift,
    hydrostar_drift,
    nemoh_drift,
    orcawave_drift,
    wamit_drift,
)
from hydrodae.hdb.readers.quadratic import Entries, joined, tabulate
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.source import SourceData

READERS: dict[str, ModuleType] = {
    "wamit": wamit_drift,
    "bemio": bemio_drift,
    "nemoh": nemoh_drift,
    "aqwa": aqwa_drift,
    "orcawave": orcawave_drift,
    "hydrostar": hydrostar_drift,
}
EXPECTED = (
    ".7 to .12 or .out of WAMIT, .h5 of BEMIO, OUT_QTFM_N*.dat of Nemoh, "
    ".rao of HydroStar with #QTFTYPE, .QTF of AQWA, .yml of OrcaFlex"
)
#: Readers of tables that stand in files of their own, and suffixes of files of first order.
SEPARATE = (wamit_drift, nemoh_drift, aqwa_drift, hydrostar_drift)
FIRST_ORDER = (".1", ".out", ".ah1", ".lis", ".nc", ".h5", ".cal")
#: The better ones first: pressures need the finest mesh, and the quadratic part is not all.
METHODS = (
    "control surface", "momentum", "direct", "indirect", "not stated", "pressure", "quadratic part",
)  # fmt: skip
CHECK = "second order"


def attach(path: Path, what: str, data: SourceData) -> None:
    """Add the tables that lie beside a source; report what is taken and what is not.

    A table that is wrong is an error of the report: the tables of first order may still be right.
    """
    setting, entries = setting_of(data), list[Entries]()
    taken = list[Path]()
    try:
        if what == "capytaine":
            entries = capytaine_drift.read(path, data.extra, setting, data.findings)
        elif what in READERS:
            taken = READERS[what].find(path)
            for file in taken:
                entries += _read(READERS[what], file, setting, data.findings)
        found = _tables(entries, setting, data.findings)
    except DatabaseError as error:
        text = f"{error}; without it: --accept second-order"
        data.findings.append(Finding("error", CHECK, text))
        return
    data.second_order = _kept(found, data.coordinates, data.findings)
    if left := unread_beside(path, taken):
        names = ", ".join(p.name for p in left[:6]) + (", ..." if len(left) > 6 else "")
        text = f"beside the source, not read: {names}; --second-order {left[0]} adds it"
        data.findings.append(Finding("info", CHECK, text))


def unread_beside(path: Path, taken: Sequence[Path]) -> list[Path]:
    """Return the tables of second order in the folder of a source that it does not take itself.

    Those of another run, beside whose tables of first order they stand, are left out.
    """
    folder = path if path.is_dir() else path.parent
    files = [p for p in sorted(folder.iterdir()) if p.is_file()]
    runs = {p.stem.lower() for p in files if p.suffix.lower() in FIRST_ORDER}
    runs -= {path.stem.lower()}
    alone = [p for p in files if p.stem.lower() not in runs and p.suffix.lower() not in FIRST_ORDER]
    found = [p for p in alone if any(r.NAMES.search(p.name) and r.find(p) for r in SEPARATE)]
    found += [p for p in nemoh_drift.find(folder) if p not in found]
    return [p for p in found if p not in taken and p != path]


def named(
    files: Mapping[str, Sequence[str | Path]],
    owner: SourceData | HydroDatabase,
    findings: list[Finding],
    methods: Sequence[str] = METHODS,
) -> dict[str, SecondOrderTable]:
    """Return the tables of files that the user names.

    Parameters
    ----------
    files : dict of lists of paths
        By the name of the body whose loads they hold; "" where the files say it themselves.
    owner : SourceData or HydroDatabase
        What they belong to; findings about them go to `findings`.
    methods : sequence of str
        Of `METHODS`, the better ones first; loads by other methods are left out.

    Raises
    ------
    DatabaseError
        No file of a known format, a wrong file, or one of another run than the owner.
    """
    whole, entries = setting_of(owner), list[Entries]()
    for body, paths in files.items():
        setting = whole
        if body:
            check_body(body, whole.bodies)
            setting = replace(whole, labels=six_of_each([body]))
        for given in paths:
            for reader, path in _known(Path(given)):
                own = setting
                if reader is wamit_drift and (length := wamit_drift.length_of(path)) is not None:
                    own = replace(setting, length=length)
                entries += _read(reader, path, own, findings)
    chosen = [e for e in entries if e.method in methods]
    return _kept(_tables(chosen, whole, findings), owner.coordinates, findings)


def setting_of(owner: SourceData | HydroDatabase) -> Setting:
    """Return what tables of second order take from the database that they belong to."""
    setting = owner.setting if isinstance(owner, SourceData) else Setting()
    if isinstance(owner, SourceData):
        points = dict(owner.reference_points)
    else:
        points = {name: body.reference_point for name, body in owner.bodies.items()}
    return replace(
        setting,
        labels=setting.labels or six_of_each(bodies_of(owner.coordinates)),
        rho=owner.rho,
        gravity=owner.gravity,
        depth=owner.water_depth,
        points=points,
    )


def _known(path: Path) -> list[tuple[ModuleType, Path]]:
    """Return the files of second order that a name stands for, each with its reader."""
    if not path.exists():
        raise DatabaseError("no such file or folder").about("missing", file=path)
    for reader in READERS.values():
        if files := reader.find(path):
            return [(reader, file) for file in files]
    raise DatabaseError(f"no table of second order; expected {EXPECTED}").about(
        "unsupported", file=path
    )


def _read(
    reader: ModuleType, path: Path, setting: Setting, findings: list[Finding]
) -> list[Entries]:
    return [entries.phased(setting) for entries in reader.read(path, setting, findings)]


def _tables(
    entries: list[Entries], setting: Setting, findings: list[Finding]
) -> dict[str, SecondOrderTable]:
    """Return one table of each kind, of the best method; of mean drift the others fill its gaps."""
    result: dict[str, SecondOrderTable] = {}
    for kind in KINDS:
        of_kind = [e for e in entries if e.kind == kind]
        tables: list[SecondOrderTable] = []
        for method in sorted({e.method for e in of_kind}, key=METHODS.index):
            whole = joined([e for e in of_kind if e.method == method])
            table = tabulate(whole, setting)
            if table is None:
                names = ", ".join(p.name for p in whole.files)
                text = f"{names}: zeros only, which stand for not computed: left out"
                findings.append(Finding("info", CHECK, text))
                continue
            if whole.about_origin:
                shifts = {b: -p for b, p in setting.points.items() if p is not None}
                table = table.moved(shifts)
            tables.append(table)
        if tables:
            result[kind] = _best(tables, findings)
    return result


def _best(tables: list[SecondOrderTable], findings: list[Finding]) -> SecondOrderTable:
    """Return the first table, with the coordinates that it lacks from the others of mean drift."""
    best, beside = tables[0], []
    for other in tables[1:]:
        lacking = [c for c in other.coordinates if c not in best.coordinates]
        more = other.selected(lacking) if best.of.axes == 1 and lacking else None
        if more is not None and best.same_waves(more):
            best = best.beside(more)
            names = ", ".join(lacking)
            beside.append(f"{other.source} ({other.method[0]}), for {names} only")
        else:
            beside.append(f"{other.source} ({other.method[0]}), not used")
    text = f"{best.kind} of {tables[0].source} ({tables[0].method[0]}) taken"
    text += f"; beside it {'; '.join(beside)}" if beside else ""
    if not best.computed.all():
        text += f"; {1.0 - best.computed.mean():.0%} of it is not computed"
    findings.append(Finding("info", CHECK, text))
    if "quadratic part" in best.method:
        text = f"{best.source} lacks the potential of second order: use .11 or .12 of WAMIT"
        findings.append(Finding("warning", CHECK, text))
    return best


def _kept(
    tables: Mapping[str, SecondOrderTable], coordinates: Sequence[str], findings: list[Finding]
) -> dict[str, SecondOrderTable]:
    """Return the tables with the coordinates of the database only."""
    kept = {}
    for kind, table in tables.items():
        lost = [c for c in table.coordinates if c not in coordinates]
        if lost:
            text = f"{kind}: {', '.join(lost)} left out, no coordinates of the database"
            findings.append(Finding("info", CHECK, text))
        order = [c for c in coordinates if c in table.coordinates]
        selected = table.selected(order)
        if selected is not None:
            kept[kind] = selected
    return kept
