"""Channels that are shown beside the scene, by what they are about."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array
from hydrodae.viewer.bodies import bodies_of_rope
from hydrodae.viewer.source import Source
from hydrodae.viewer.stage import Body, Curve

#: Shown without being asked for.
USUAL = ("bodies/*/position", "bodies/*/rotation", "bodies/*/velocity", "joints/*", "sea/elevation")


def make_curves(
    source: Source, tables: Mapping[str, Any], bodies: Sequence[Body], more: Sequence[str] = ()
) -> list[Curve]:
    """The usual channels, and those that match the patterns of `more`.

    Raises
    ------
    CaseError
        A pattern matches no channel.
    """
    for pattern in more:
        if not any(fnmatchcase(name, pattern) for name in source.names):
            raise CaseError(f"no channel matches {pattern!r}")
    owners = _owners(tables)
    centers = {body.name: body.center for body in bodies}
    curves = list[Curve]()
    for name in source.names:
        asked = any(fnmatchcase(name, pattern) for pattern in more)
        if asked or _usual(name):
            values = source.values(name)
            if values.ndim == 1 or values.shape[1] == 3:
                curves += _curves(name, values, source.unit(name), owners, centers)
    return curves


def _usual(name: str) -> bool:
    """Scalars of forces, and what else is usual; loads of a force by body are not."""
    parts = name.split("/")
    if parts[0] == "forces":
        return len(parts) == 3 and parts[2] not in ("position", "tension_along")
    return any(fnmatchcase(name, pattern) for pattern in USUAL)


#: Groups of channels that are about one thing, whatever the channel.
_ABOUT = {"sea": ("sea",)}


def _curves(
    name: str,
    values: Array,
    unit: str,
    owners: Mapping[str, tuple[str, ...]],
    centers: Mapping[str, Array],
) -> Iterator[Curve]:
    kind, owner, *rest = name.split("/")
    about = _ABOUT.get(kind, (owner, *owners.get(f"{kind}/{owner}", ())))
    quantity = "/".join(rest).replace("_", " ") or owner
    if unit.startswith("rad"):
        values, unit = np.degrees(values), unit.replace("rad", "deg")
    if name == f"bodies/{owner}/position":
        values, quantity = values - centers[owner], "displacement"
    title = quantity if kind in ("bodies", "sea") else f"{owner}: {quantity}"
    if values.ndim == 1:
        yield Curve(name, about, title, quantity, unit, values)
        return
    for i, axis in enumerate("xyz"):
        yield Curve(f"{name}.{axis}", about, title, axis, unit, values[:, i])


def _owners(tables: Mapping[str, Any]) -> dict[str, tuple[str, ...]]:
    """Bodies and joints that each joint and force is about, by ``joints/NAME``, ``forces/NAME``."""
    found: dict[str, tuple[str, ...]] = {}
    for joint in tables.get("joint", []):
        found[f"joints/{joint['name']}"] = (joint["body_a"], joint["body_b"])
    for force in tables.get("force", []):
        named = [force[key] for key in ("body", "body_a", "body_b", "joint") if key in force]
        if force["type"] == "rope":
            named += bodies_of_rope(force)
        for name in list(named):
            named += found.get(f"joints/{name}", ())
        found[f"forces/{force['name']}"] = tuple(dict.fromkeys(named))
    return found
