"""Read any source, check it, and bring it to the scene's names and points."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import DatabaseError
from hydrodae.hdb.checks.band import Band
from hydrodae.hdb.checks.check import check
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.all_round import closed, closing_finding, goes_round
from hydrodae.hdb.database.coordinates import bodies_of, check_body, expand
from hydrodae.hdb.database.findings import CheckReport, Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.hull.mesh_statics import mesh_statics
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.hdb.preparation.mirroring import mirrored
from hydrodae.hdb.readers.finishing import finish
from hydrodae.hdb.readers.headings import FORCES
from hydrodae.hdb.readers.kinds import kind
from hydrodae.hdb.readers.reading import read, read_source
from hydrodae.hdb.readers.reference import without_moments
from hydrodae.hdb.readers.source import SourceData
from hydrodae.hdb.readers.stiffness_file import read_stiffness

T = TypeVar("T")


def import_database(
    source: str | Path,
    *,
    names: Sequence[str] | Mapping[str, str] | None = None,
    reference_points: Mapping[str, ArrayLike] | None = None,
    source_points: Mapping[str, ArrayLike] | None = None,
    hydrostatics: Mapping[str, Hydrostatics] | None = None,
    meshes: Mapping[str, str | Path] | None = None,
    stiffness: Mapping[str, str | Path] | None = None,
    volumes: Mapping[str, float] | None = None,
    rho: float | None = None,
    depth: float | None = None,
    gravity: float | None = None,
    time_convention: str | None = None,
    keep: str | None = None,
    cut: float | None = None,
    symmetric: Sequence[str] | None = None,
    band: Band | Callable[[HydroDatabase], Band] | None = None,
) -> tuple[HydroDatabase, CheckReport]:
    """Read a source, check it, rename its bodies and move it to the scene's reference points.

    Parameters
    ----------
    source : path
        As in `read`.
    names : list or dict, optional
        New body names, in the order of the source, or {old: new}. All other arguments use the new
        names; the name "" is that of the only body.
    reference_points : dict of (3,) arrays, optional
        Points to move to, usually the centres of gravity, world [m].
    source_points : dict of (3,) arrays, optional
        Points about which the moments of the source are, where the source does not say [m].
    hydrostatics : dict of Hydrostatics, optional
        Where the source has none, or wrong ones; waterplane moments about `reference_points`.
    meshes : dict of path, optional
        Mesh files of the wetted hulls (STL, OBJ, GDF, PNL, Nemoh, GMSH), from which the
        hydrostatics of a body follow, where the source has none or wrong ones.
    stiffness : dict of path, optional
        Files with the hydrostatic stiffness of a body about its centre of gravity: six rows of six
        numbers [N/m, N, N m], or a `Hydrostatic.in` of HAMS.
    volumes : dict of float, optional
        Displaced volumes [m3] that go with `stiffness`; by default by the masses in the files.
    rho, depth, gravity : float, optional
        Of the water [kg/m3, m, m/s2], where the source does not say (WAMIT's tables).
    time_convention : str, optional
        Of the forces, as in `read`.
    keep : str, optional
        Coordinates to keep, as in `hydrodae.hdb.expand`; the checks see these only.
    cut : float, optional
        Leave out the frequencies above [rad/s], before anything is estimated.
    symmetric : sequence of "y", "x", optional
        Planes y = 0, x = 0 of symmetry of the hulls, whose mirror images add headings.
    band : (low, high) or function of the database, optional
        Frequencies [rad/s] that the device feels; see `hydrodae.hdb.check`.

    Returns
    -------
    database : HydroDatabase
    report : CheckReport
        Findings of the reader and of `hydrodae.hdb.check`.

    Raises
    ------
    DatabaseError
        Missing or wrong files, unknown bodies, points that cannot be moved.
    """
    if kind(source) == "hydro":
        if time_convention is not None:
            raise DatabaseError(f"{source}: finished; its forces are e^(+iwt) (time_convention)")
        if cut is not None:
            raise DatabaseError(f"{source}: frequencies are cut where a source is imported (cut)")
        database = read(source, rho=rho, depth=depth, gravity=gravity)
        noticed = [closing_finding(database.heading)] if goes_round(database.heading) else []
        database = closed(database)
        renamed = database.renamed(_renaming(list(database.bodies), names))
        reference_points = _of_only_body(reference_points, list(renamed.bodies))
        meshes = _of_only_body(meshes, list(renamed.bodies))
        stiffness = _of_only_body(stiffness, list(renamed.bodies))
        volumes = _of_only_body(volumes, list(renamed.bodies))
    else:
        data = read_source(
            source, rho=rho, depth=depth, gravity=gravity, time_convention=time_convention
        )
        if cut is not None:
            _cut(data, cut)
        new = {name: name for name in bodies_of(data.coordinates)}
        new.update(_renaming(list(new), names))
        bodies = [new[name] for name in bodies_of(data.coordinates)]
        reference_points = _of_only_body(reference_points, bodies)
        source_points = _of_only_body(source_points, bodies)
        meshes = _of_only_body(meshes, bodies)
        stiffness = _of_only_body(stiffness, bodies)
        volumes = _of_only_body(volumes, bodies)
        free = {new[name] for name in without_moments(data) if name in data.assumed_points}
        anywhere = {k: v for k, v in (reference_points or {}).items() if k in free}
        stated = {**anywhere, **(source_points or {})}
        _state_points(data, {v: k for k, v in new.items()}, stated)
        database = finish(data)
        noticed = data.findings
    database = database.renamed(_renaming(list(database.bodies), names))
    if reference_points:
        database = database.moved_to(reference_points)
    if hydrostatics:
        database = database.with_hydrostatics(hydrostatics)
        if set(hydrostatics) == set(database.bodies):  # what the source lacks does not matter
            noticed = [f for f in noticed if f.check != "hydrostatics"]
    for name, file in (meshes or {}).items():
        check_body(name, database.bodies)
        try:
            panels = read_mesh(file)
            statics = mesh_statics(panels, database.reference_point(name))
        except DatabaseError as error:
            raise DatabaseError(f"{file}: {error}".replace(f"{file}: {file}", f"{file}")) from None
        database = database.with_hydrostatics({name: statics}).with_meshes({name: panels})
        noticed = [f for f in noticed if f.check != "hydrostatics"]
    if stiffness or volumes:
        database = _with_stiffness(database, stiffness or {}, volumes or {})
        noticed = [f for f in noticed if f.check != "hydrostatics"]
    if keep is not None:
        database = database.select(expand(keep, database.coordinates))
    if symmetric is not None:
        database, mirrors = mirrored(database, symmetric)
        noticed = [*noticed, *mirrors]
    judged = band(database) if callable(band) else band
    return database, CheckReport([*noticed, *check(database, judged).findings])


def _with_stiffness(
    database: HydroDatabase, files: Mapping[str, str | Path], volumes: Mapping[str, float]
) -> HydroDatabase:
    """Take hydrostatics from matrices about the centres of gravity, the reference points."""
    for name in (*files, *volumes):
        check_body(name, database.bodies)
    if alone := [name for name in volumes if name not in files]:
        raise DatabaseError(f"a volume of {alone[0]!r} goes with its stiffness (--stiffness FILE)")
    made = {}
    for name, file in files.items():
        point, given = database.reference_point(name), read_stiffness(file)
        try:
            made[name] = given.hydrostatics(
                point, volumes.get(name), database.rho, database.gravity
            )
        except DatabaseError as error:
            raise DatabaseError(f"{file}: {error}") from None
    return database.with_hydrostatics(made)


def _of_only_body(given: Mapping[str, T] | None, bodies: Sequence[str]) -> Mapping[str, T] | None:
    """Give what is stated of the only body, "", its name."""
    if not given or "" not in given:
        return given
    if len(bodies) != 1:
        raise DatabaseError(
            f"{given['']}: of which body? There are {', '.join(bodies)}: write {bodies[0]}=..."
        )
    return {bodies[0] if name == "" else name: value for name, value in given.items()}


def _cut(data: SourceData, highest: float) -> None:
    """Leave out the frequencies above `highest` [rad/s]."""
    kept = data.omega <= highest * (1.0 + 1e-9)
    if kept.sum() < 4:
        raise DatabaseError(
            f"{data.name}: only {kept.sum()} of its frequencies ({data.omega[0]:.4g} to "
            f"{data.omega[-1]:.4g} rad/s) are not above {highest:g} rad/s; 4 are needed"
        )
    if kept.all():
        return
    text = f"{(~kept).sum()} frequencies above {highest:g} rad/s left out, as asked"
    data.findings.append(Finding("info", "cut", text))
    data.omega = data.omega[kept]
    for name in ("added_mass", "radiation_damping", *FORCES):
        value = getattr(data, name)
        if value is not None:
            setattr(data, name, value[kept])


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
        )
    return dict(zip(bodies, names, strict=True))


def _state_points(
    data: SourceData, old_names: Mapping[str, str], points: Mapping[str, ArrayLike]
) -> None:
    """Enter reference points that the source leaves out; contradicting the source is an error."""
    for name, value in points.items():
        check_body(name, old_names)
        old, point = old_names[name], np.asarray(value, dtype=float)
        known = data.reference_points.get(old)
        if old in data.assumed_points:
            known = None
        if known is not None and not np.allclose(known, point, atol=1e-6):
            raise DatabaseError(
                f"the source says the moments of {name!r} are about {known.tolist()}, "
                f"not {point.tolist()}"
            )
        data.state_point(old, point)
