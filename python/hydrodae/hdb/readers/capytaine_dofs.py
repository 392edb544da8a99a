"""Degrees of freedom in netCDF files of Capytaine: rigid motions, and own ones of any shape."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import nearest, unique_names
from hydrodae.hdb.database.extra import label_text
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.readers.capytaine_statics import (
    has_inertia,
    is_rigid,
    mode_name,
    with_stiffness,
)

#: The Python line that makes modes of a body of Capytaine. The tables of waves stay as they are.
ADD_STIFFNESS = 'dataset["hydrostatic_stiffness"] = body.compute_hydrostatic_stiffness(rho=...)'


def with_motions(ds: xr.Dataset, motions: Mapping[str, str], findings: list[Finding]) -> None:
    """Give own degrees of freedom the names of the rigid motions that they are.

    Parameters
    ----------
    ds : Dataset
        Its labels become plain text, in place.
    motions : dict of str
        Motion, surge to yaw, of degrees of freedom by their labels in the file.
    findings : list of Finding
        Gets what is taken for what.

    Raises
    ------
    DatabaseError
        No such degree of freedom, no such motion, or the body has that motion already.
    """
    both = "influenced_dof", "radiating_dof"
    labels = {axis: [label_text(d) for d in np.atleast_1d(ds[axis].values)] for axis in both}
    known = list(dict.fromkeys(labels[both[0]] + labels[both[1]]))
    for dof, motion in motions.items():
        if dof not in known:
            raise DatabaseError(
                f"--motion {dof}={motion}: no degree of freedom {dof!r} in it{nearest(dof, known)}"
            ).about("label", dof)
        if motion.lower() not in DOFS:
            raise DatabaseError(
                f"--motion {dof}={motion}: expected one of {', '.join(DOFS)}"
            ).about("label", dof)
        prefix, bar, _ = dof.rpartition("__")
        taken = f"{prefix}{bar}{motion.capitalize()}"
        if taken.lower() in (d.lower() for d in known if d != dof):
            raise DatabaseError(
                f"--motion {dof}={motion}: the file has a {taken!r} of its own; name one of the "
                f"two only"
            ).about("label", dof)
        labels = {axis: [taken if d == dof else d for d in names] for axis, names in labels.items()}
        findings.append(Finding("info", "coordinates", f"{dof} is read as {motion} (--motion)"))
    for axis, names in labels.items():
        ds[axis] = names


def coordinates_of(
    path: Path, ds: xr.Dataset, findings: list[Finding]
) -> tuple[list[str], tuple[str, ...]]:
    """Names of the degrees of freedom in the file, and their labels here, in the same order."""
    influenced, radiating = (list(ds[axis].values) for axis in ("influenced_dof", "radiating_dof"))
    both = [str(d) for d in influenced if d in radiating]
    rigid = [d for d in both if is_rigid(d)]
    stiff = with_stiffness(ds, rigid)
    own = [d for d in both if not is_rigid(d) and d in stiff]
    without = [d for d in both if d not in rigid + own]
    half = [str(d) for d in dict.fromkeys(influenced + radiating) if d not in both]
    if not rigid + own:
        raise DatabaseError(f"none of {both} is one of {', '.join(DOFS)}; {_way(without)}").about(
            "label"
        )
    if without:
        said = f"left out (no rigid motion, no hydrostatic_stiffness): {without}; {_way(without)}"
        findings.append(Finding("warning", "coordinates", said))
    if half:
        said = f"left out (motion or force only): {half}; solve both problems for each"
        findings.append(Finding("warning", "coordinates", said))
    if own:
        findings.append(Finding("info", "coordinates", f"modes of their bodies: {own}"))
    if turned := [d for d in own if has_inertia(ds, d)]:
        said = (
            f"modes with an inertia: {turned}; Capytaine has it of rigid motions, whose stiffness "
            f"holds the weight: name these, as in --motion {turned[0]}=pitch"
        )
        findings.append(Finding("warning", "coordinates", said))
    prefixes = list(dict.fromkeys(d.rpartition("__")[0] for d in rigid + own))
    names = unique_names([p or _single_body(path, ds) for p in prefixes])
    labels = []
    for dof in rigid + own:
        prefix, _, word = dof.rpartition("__")
        motion = word.lower() if dof in rigid else mode_name(word)
        labels.append(f"{names[prefixes.index(prefix)]}.{motion}")
    return rigid + own, tuple(labels)


def _way(dofs: list[str]) -> str:
    """Say how own degrees of freedom come into a database."""
    first = dofs[0] if dofs else "NAME"
    return (
        f"a rigid motion of a body is named by --motion, as in --motion {first}=pitch (about a "
        f"hinge: with --origin, if the file has no rotation_center); any other shape becomes a "
        f"mode where the file has its stiffness: {ADD_STIFFNESS}"
    )


def _single_body(path: Path, ds: xr.Dataset) -> str:
    for key in ("body", "body_name"):
        if key in ds.coords and ds[key].size == 1:
            return label_text(ds[key].values.item())
    return path.stem
