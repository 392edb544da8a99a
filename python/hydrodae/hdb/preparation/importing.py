"""Read any source, check it, and bring it to the scene's names and points."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from numpy.typing import ArrayLike

from hydrodae.hdb.checks.band import Band
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import CheckReport
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.preparation import pipeline
from hydrodae.hdb.preparation.import_stages import Import


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
    motions: Mapping[str, str] | None = None,
    keep: str | None = None,
    cut: float | None = None,
    symmetric: Sequence[str] | None = None,
    columns: Sequence[str] = (),
    second_order: Mapping[str, Sequence[str | Path]] | None = None,
    band: Band | Callable[[HydroDatabase], Band] | None = None,
    progress: Callable[[str], None] | None = None,
) -> tuple[HydroDatabase, CheckReport]:
    """Read a source, check it, rename its bodies and move it to the scene's reference points.

    The stages are listed in `hydrodae.hdb.preparation.pipeline`.

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
    motions : dict of str, optional
        Own degrees of freedom of Capytaine that are rigid motions, surge to yaw, by their labels
        in the file, as in {"Hinge": "pitch"}.
    keep : str, optional
        Coordinates to keep, as in `hydrodae.hdb.expand`; the checks see these only.
    cut : float, optional
        Leave out the frequencies above [rad/s], before anything is estimated.
    symmetric : sequence of "y", "x", optional
        Planes y = 0, x = 0 of symmetry of the hulls, whose mirror images add headings.
    columns : sequence of str
        Bodies that are water columns, pistons inside a hull: only their heave is kept, and they are
        checked as a piston.
    second_order : dict of lists of paths, optional
        Files or folders with mean drift and loads of two waves, by the body that they are of; ""
        where the files say it. Those beside the source, of the same run, are read without it.
    band : (low, high) or function of the database, optional
        Frequencies [rad/s] that the device feels; see `hydrodae.hdb.check`.
    progress : callable, optional
        Called with the name of each stage (`hydrodae.hdb.preparation.pipeline.IMPORT`).

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
    state = Import(
        source,
        names=names,
        reference_points=dict(reference_points or {}),
        source_points=dict(source_points or {}),
        hydrostatics=dict(hydrostatics or {}),
        meshes=dict(meshes or {}),
        stiffness=dict(stiffness or {}),
        volumes=dict(volumes or {}),
        rho=rho,
        depth=depth,
        gravity=gravity,
        time_convention=time_convention,
        motions=dict(motions or {}),
        keep=keep,
        cut=cut,
        symmetric=symmetric,
        columns=columns,
        second_order=dict(second_order or {}),
        band=band,
    )
    pipeline.run(pipeline.IMPORT, state, progress)
    return state.database, CheckReport(state.findings)
