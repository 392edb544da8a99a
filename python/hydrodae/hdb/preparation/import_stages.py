"""Stages of an import: from the files of a source to a checked database, in this order."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import DatabaseError
from hydrodae.hdb.checks.band import Band
from hydrodae.hdb.checks.check import check
from hydrodae.hdb.checks.columns import as_columns
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.all_round import closed, closing_finding, goes_round
from hydrodae.hdb.database.coordinates import check_body, expand
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.hull.mesh_statics import mesh_statics
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.hdb.labels import bodies_of
from hydrodae.hdb.preparation.mirroring import mirrored
from hydrodae.hdb.readers.finishing import finish
from hydrodae.hdb.readers.kinds import kind
from hydrodae.hdb.readers.reading import read, read_source
from hydrodae.hdb.readers.reference import without_moments
from hydrodae.hdb.readers.second_order import named
from hydrodae.hdb.readers.source import SourceData
from hydrodae.hdb.readers.stiffness_file import read_stiffness

T = TypeVar("T")


@dataclass
class Import:
    """A database on its way in: what is asked, and what the stages have made of it so far.

    Attributes
    ----------
    source ... band
        As in `hydrodae.hdb.import_database`.
    data : SourceData or None
        The tables as the reader understood them; None of a finished `hydro.h5`.
    database : HydroDatabase
        From the stage `complete` on; of a `hydro.h5` at once.
    new_names : dict
        New name of each body of the source.
    findings : list of Finding
        What the reader, the stages and the checks noticed.
    """

    source: str | Path
    names: Sequence[str] | Mapping[str, str] | None = None
    reference_points: dict[str, ArrayLike] = field(default_factory=dict)
    source_points: dict[str, ArrayLike] = field(default_factory=dict)
    hydrostatics: dict[str, Hydrostatics] = field(default_factory=dict)
    meshes: dict[str, str | Path] = field(default_factory=dict)
    stiffness: dict[str, str | Path] = field(default_factory=dict)
    volumes: dict[str, float] = field(default_factory=dict)
    rho: float | None = None
    depth: float | None = None
    gravity: float | None = None
    time_convention: str | None = None
    motions: dict[str, str] = field(default_factory=dict)
    keep: str | None = None
    cut: float | None = None
    symmetric: Sequence[str] | None = None
    columns: Sequence[str] = ()
    second_order: dict[str, Sequence[str | Path]] = field(default_factory=dict)
    band: Band | Callable[[HydroDatabase], Band] | None = None
    data: SourceData | None = None
    database: HydroDatabase = field(init=False)
    new_names: dict[str, str] = field(default_factory=dict)
    findings: list[Finding] = field(default_factory=list)


def read_tables(state: Import) -> None:
    """Take the source; add `data`, or of a finished `hydro.h5` the `database` itself.

    A file of the project holds one convention and all its frequencies: neither is asked again.
    """
    source, rho, depth, gravity = state.source, state.rho, state.depth, state.gravity
    if kind(source) != "hydro":
        convention = state.time_convention
        state.data = read_source(
            source,
            rho=rho,
            depth=depth,
            gravity=gravity,
            time_convention=convention,
            motions=state.motions,
        )
        return
    for asked, text in (
        (state.time_convention, "finished; its forces are e^(+iwt) (time_convention)"),
        (state.cut, "frequencies are cut where a source is imported (cut)"),
        (state.motions or None, "its motions have their names since its import (motions)"),
    ):
        if asked is not None:
            raise DatabaseError(text).about("option", file=source)
    database = read(source, rho=rho, depth=depth, gravity=gravity)
    if goes_round(database.heading):
        state.findings.append(closing_finding(database.heading))
    state.database = closed(database)


def cut(state: Import) -> None:
    """Take `data`; leave out its frequencies above `cut` [rad/s], before anything is estimated."""
    data, highest = state.data, state.cut
    if data is None or highest is None:
        return
    kept = data.omega <= highest * (1.0 + 1e-9)
    if kept.sum() < 4:
        raise DatabaseError(
            f"only {kept.sum()} of its frequencies ({data.omega[0]:.4g} to "
            f"{data.omega[-1]:.4g} rad/s) are not above {highest:g} rad/s; 4 are needed"
        ).about("frequencies", "cut", file=data.name)
    if kept.all():
        return
    text = f"{(~kept).sum()} frequencies above {highest:g} rad/s left out, as asked"
    data.findings.append(Finding("info", "cut", text))
    data.keep_frequencies(kept)


def name_bodies(state: Import) -> None:
    """Take the bodies of the source; add `new_names`, and the name of what "" is stated of."""
    tables = state.database if state.data is None else state.data
    bodies = bodies_of(tables.coordinates)
    state.new_names = {name: name for name in bodies} | dict(_renaming(bodies, state.names))
    new = [state.new_names[name] for name in bodies]
    state.reference_points = _of_only_body(state.reference_points, new)
    state.source_points = _of_only_body(state.source_points, new)
    state.meshes = _of_only_body(state.meshes, new)
    state.stiffness = _of_only_body(state.stiffness, new)
    state.volumes = _of_only_body(state.volumes, new)


def state_points(state: Import) -> None:
    """Take `data`; add the points [m] of its moments that it leaves out, and the user states.

    Where a body has no moments at all, any point is right: that of the scene is taken.

    Raises
    ------
    DatabaseError
        A statement contradicts the source.
    """
    data = state.data
    if data is None:
        return
    free = {state.new_names[name] for name in without_moments(data) if name in data.assumed_points}
    anywhere = {name: point for name, point in state.reference_points.items() if name in free}
    old_names = {new: old for old, new in state.new_names.items()}
    for name, value in {**anywhere, **state.source_points}.items():
        check_body(name, old_names)
        old, point = old_names[name], np.asarray(value, dtype=float)
        known = None if old in data.assumed_points else data.reference_points.get(old)
        if known is not None and not np.allclose(known, point, atol=1e-6):
            raise DatabaseError(
                f"the source says the moments of {name!r} are about {known.tolist()}, "
                f"not {point.tolist()}"
            ).about("point", name)
        data.state_point(old, point)


def complete(state: Import) -> None:
    """Take `data`; add the `database`: A and B symmetric, the excitation split, A_inf estimated."""
    if state.data is not None:
        state.database = finish(state.data)
        state.findings = state.data.findings


def add_second_order(state: Import) -> None:
    """Take the `database`; add the tables of second order of the files that are named.

    They replace those of their kinds that lay beside the source. Names of bodies are the new ones.
    """
    if not state.second_order:
        return
    old = {new: old for old, new in state.new_names.items()}
    for name in state.second_order:
        if name:
            check_body(name, old)
    files = {old.get(name, ""): paths for name, paths in state.second_order.items()}
    findings: list[Finding] = []
    found = named(files, state.data or state.database, findings)
    state.findings += findings
    for which in sorted(set(found) & set(state.database.second_order)):
        before = state.database.second_order[which].source
        text = f"{which}: {found[which].source} in place of {before}"
        state.findings.append(Finding("info", "second order", text))
    state.database = state.database.with_second_order(found)


def arrange(state: Import) -> None:
    """Take the `database`; rename its bodies and move its tables to `reference_points` [m]."""
    database = state.database
    database = database.renamed(_renaming(list(database.bodies), state.names))
    if state.reference_points:
        database = database.moved_to(state.reference_points)
    state.database = database


def add_hydrostatics(state: Import) -> None:
    """Take the `database`; add what is given of its hydrostatics, by value, mesh or matrix.

    What the reader said it lacks does not matter then.
    """
    if state.hydrostatics:
        state.database = state.database.with_hydrostatics(state.hydrostatics)
    for name, file in state.meshes.items():
        _add_mesh(state, name, file)
    if state.stiffness or state.volumes:
        state.database = _with_stiffness(state.database, state.stiffness, state.volumes)
    every = set(state.hydrostatics) == set(state.database.bodies)
    if state.meshes or state.stiffness or state.volumes or every:
        state.findings = [found for found in state.findings if found.check != "hydrostatics"]


def keep(state: Import) -> None:
    """Take the `database`; leave out the coordinates that are not kept, and mark `columns`."""
    if state.keep is not None:
        state.database = state.database.select(expand(state.keep, state.database.coordinates))
    if state.columns:
        state.database = as_columns(state.database, list(state.columns))


def mirror(state: Import) -> None:
    """Take the `database`; add the headings [rad] that the planes of symmetry give."""
    if state.symmetric is not None:
        state.database, found = mirrored(state.database, state.symmetric)
        state.findings = [*state.findings, *found]


def check_tables(state: Import) -> None:
    """Take the `database`; add what the checks find in the `band` [rad/s] to the findings."""
    judged = state.band(state.database) if callable(state.band) else state.band
    state.findings = [*state.findings, *check(state.database, judged).findings]


def _add_mesh(state: Import, name: str, file: str | Path) -> None:
    """Add panels (n, 4, 3) of the wetted hull of a body [m], and the hydrostatics they give."""
    check_body(name, state.database.bodies)
    try:
        panels = read_mesh(file)
        statics = mesh_statics(panels, state.database.reference_point(name))
    except DatabaseError as error:
        raise error.in_file(file) from None
    database = state.database.with_hydrostatics({name: statics})
    state.database = database.with_meshes({name: panels})


def _with_stiffness(
    database: HydroDatabase, files: Mapping[str, str | Path], volumes: Mapping[str, float]
) -> HydroDatabase:
    """Take hydrostatics from matrices about the centres of gravity, the reference points."""
    for name in (*files, *volumes):
        check_body(name, database.bodies)
    if alone := [name for name in volumes if name not in files]:
        raise DatabaseError(
            f"a volume of {alone[0]!r} goes with its stiffness (--stiffness FILE)"
        ).about("option", alone[0])
    made = {}
    for name, file in files.items():
        point, given = database.reference_point(name), read_stiffness(file)
        try:
            made[name] = given.hydrostatics(
                point, volumes.get(name), database.rho, database.gravity
            )
        except DatabaseError as error:
            raise error.in_file(file) from None
    return database.with_hydrostatics(made)


def _of_only_body(given: dict[str, T], bodies: Sequence[str]) -> dict[str, T]:
    """Give what is stated of the only body, "", its name."""
    if "" not in given:
        return given
    if len(bodies) != 1:
        raise DatabaseError(
            f"{given['']}: of which body? There are {', '.join(bodies)}: write {bodies[0]}=..."
        ).about("ambiguous")
    return {bodies[0] if name == "" else name: value for name, value in given.items()}


def _renaming(
    bodies: Sequence[str], names: Sequence[str] | Mapping[str, str] | None
) -> Mapping[str, str]:
    if names is None:
        return {}
    if isinstance(names, Mapping):
        return names
    if isinstance(names, str) or len(names) != len(bodies):
        raise DatabaseError(
            f"{len(bodies)} bodies in the source ({', '.join(bodies)}), "
            f"but the new names are {names}"
        ).about("label", "names")
    return dict(zip(bodies, names, strict=True))
