"""Arrays of a device: copies of a scene on a layout, and databases whose far bodies are uncoupled.

A copy has a name space of its own: the body `flap` of the unit `u3` is `u3_flap`, in the scene, in
the results (`bodies/u3_flap`) and in the database (`hydro = "u3_flap"`).
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.case.scene import Scene
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.coordinates import body_name
from hydrodae.support.arrays import Array
from hydrodae.support.nearest import did_you_mean

#: Tables of which every unit has its own entries; the others are of the whole array.
OF_UNITS = (
    "body",
    "mode",
    "attachment",
    "joint",
    "constraint",
    "marker",
    "force",
    "morison",
    "chamber",
    "piston",
    "outlet",
    "gauge",
    "controller",
)
#: Keys that name entries of these tables, or channels of theirs.
REFERENCES = (
    *("name", "hydro", "body", "body_a", "body_b", "bodies", "joint", "joint_b", "marker"),
    *("mode", "chamber", "to"),
)
CHANNELS = ("inputs", "outputs")
#: Keys that are places in the world.
POINTS = ("point", "point_a", "point_b", "points")
PLACES = (*POINTS, "center_of_gravity", "center_of_buoyancy", "mesh_origin", "path")


def hexagonal(count: int, spacing: float) -> dict[str, tuple[float, float]]:
    """Places of units on a hexagonal grid, from the middle outwards in rings: 1, 7, 19, 37, ...

    Parameters
    ----------
    count : int
        Of units; of the last ring, those that are nearest to the direction of +x, turning left.
    spacing : float
        Between neighbours [m].

    Returns
    -------
    dict of (x, y)
        By the names u1, u2, ... [m].

    Raises
    ------
    CaseError
        A count that is no integer > 0, or a spacing that is not > 0 and finite.
    """
    whole = isinstance(count, int | np.integer)
    if not whole or count < 1 or not 0.0 < _number(spacing) < np.inf:
        raise CaseError(
            f"hexagonal: {count!r} units {spacing!r} m apart: expected an integer > 0 and a "
            "finite number > 0"
        )
    rings = int(np.ceil(np.sqrt(count)))
    grid = [(a, b) for a in range(-rings, rings + 1) for b in range(-rings, rings + 1)]
    points = [(a + 0.5 * b, b * np.sqrt(0.75)) for a, b in grid]
    ring = [max(abs(a), abs(b), abs(a + b)) for a, b in grid]
    angle = [round(float(np.arctan2(y, x)) % (2.0 * np.pi), 9) for x, y in points]
    order = sorted(range(len(grid)), key=lambda i: (ring[i], angle[i]))
    return {
        f"u{n}": (spacing * points[i][0], spacing * float(points[i][1]))
        for n, i in enumerate(order[:count], start=1)
    }


def place(
    device: Scene, units: Mapping[str, ArrayLike], directory: str | Path, title: str = ""
) -> Scene:
    """Place copies of a device, free of each other; join them by what is added to the scene.

    Parameters
    ----------
    device : Scene
        One device. Its waves, sea, solver, output and so on become those of the array.
    units : dict of (x, y)
        Shift of each copy by its name [m]; none is turned.
    directory : path
        Folder that relative paths of the array refer to.
    title : str
        Of the array.

    Raises
    ------
    CaseError
        A name that cannot stand before those of bodies, a shift that is not two finite numbers,
        two units at one place, or no units.
    """
    offsets = _placed_units(units)
    tables = tomllib.loads(device.to_toml())
    tables.pop("title", None)
    array = Scene(title or f"{len(units)} x {device.title}", directory=directory)
    own = {str(e["name"]) for table in OF_UNITS for e in tables.get(table, []) if "name" in e}
    for table in (t for t in tables if t not in OF_UNITS):
        for entry in _entries(tables[table]):
            _add(array, table, entry)
    for unit, offset in offsets.items():
        for table in (t for t in OF_UNITS if t in tables):
            for entry in tables[table]:
                if table == "gauge" and "marker" not in entry:
                    entry = {"point": [0.0, 0.0], **entry}
                if "mesh" in entry:
                    entry = {"mesh_origin": [0.0, 0.0, 0.0], **entry}
                keys = {key: _moved(key, value, unit, own, offset) for key, value in entry.items()}
                _add(array, table, keys)
    return array


@dataclass(frozen=True)
class Unit:
    """What belongs to one unit of an array, by the names that the device has alone.

    `unit(results, 3)["bodies/flap/position"]` is `results["bodies/u3_flap/position"]`.
    """

    results: Mapping[str, Any]
    name: str

    def __getitem__(self, channel: str) -> Any:
        """Return a channel of the unit; KeyError, with those that there are, for any other."""
        names = dict(zip(self.channels(), _of_unit(self.results, self.name), strict=True))
        if channel not in names:
            hint = did_you_mean(channel, names)
            raise KeyError(f"unit {self.name!r} has no channel {channel!r}{hint}")
        return self.results[names[channel]]

    def channels(self) -> list[str]:
        """Names of the channels, as of the device alone."""
        prefix = f"{self.name}_"
        found = []
        for channel in _of_unit(self.results, self.name):
            *path, last = channel.split("/")  # of a force on several bodies: a name in each part
            path = [part.removeprefix(prefix) for part in path]
            if path == channel.split("/")[:-1]:  # the last part is the name, no quantity
                last = last.removeprefix(prefix)
            found.append("/".join([*path, last]))
        return found


def unit(results: Mapping[str, Any], name: str | int) -> Unit:
    """Return the part of the results that belongs to one unit of an array.

    Parameters
    ----------
    results : Results
        Of a scene that `place` made.
    name : str or int
        Of the unit; 3 stands for "u3", as `hexagonal` names them.

    Raises
    ------
    CaseError
        No channel belongs to such a unit.
    """
    found = Unit(results, f"u{name}" if isinstance(name, int) else name)
    if not found.channels():
        bodies = sorted({c.split("/")[1] for c in results if c.startswith("bodies/")})
        raise CaseError(
            f"unit {found.name!r}: nothing in the results has a name '{found.name}_...'; "
            f"the bodies are {', '.join(bodies)}"
        )
    return found


def _of_unit(results: Mapping[str, Any], unit: str) -> list[str]:
    return [channel for channel in results if f"/{unit}_" in channel]


def _number(value: Any) -> float:
    """Return it as a number, nan where it is none."""
    return float(value) if isinstance(value, int | float | np.number) else float("nan")


def _places(places: Mapping[str, ArrayLike], what: str) -> dict[str, Array]:
    """Places in plan by their names, checked."""
    if not isinstance(places, Mapping) or not places:
        raise CaseError(f"an array needs at least one {what}: expected a dict of name: (x, y)")
    found: dict[str, Array] = {}
    for name, place in places.items():
        try:
            at = np.asarray(place, dtype=float)
        except (TypeError, ValueError):
            at = np.empty(0)
        if at.shape != (2,) or not np.all(np.isfinite(at)):
            raise CaseError(f"{what} {name!r}: expected x, y [m], got {place!r}")
        found[name] = at
    return found


def _placed_units(units: Mapping[str, ArrayLike]) -> dict[str, Array]:
    """Shifts of the units by their names, all checked."""
    found = _places(units, "unit")
    _check_names(found)
    names = list(found)
    for i, name in enumerate(names):
        for other in names[:i]:
            if np.array_equal(found[other], found[name]):
                raise CaseError(f"units {other!r} and {name!r} are at the same place")
    return found


def _check_names(units: Iterable[str]) -> None:
    """Refuse names of units that cannot stand before those of bodies."""
    names = list(units)
    for name in names:
        if not isinstance(name, str) or body_name(name) != name:
            raise CaseError(f"unit {name!r}: expected a name of letters, digits, _ and -")
        for other in names:
            if isinstance(other, str) and name.startswith(f"{other}_"):
                raise CaseError(
                    f"unit {name!r} begins with the name of unit {other!r}: whose would the body "
                    f"'{name}_...' be?"
                )


def _entries(table: Any) -> list[dict[str, Any]]:
    return table if isinstance(table, list) else [table]


def _add(scene: Scene, table: str, entry: Mapping[str, Any]) -> None:
    keys = dict(entry)
    add = getattr(scene, table)
    if "type" in keys:
        add = getattr(add, keys.pop("type"))
    add(keys.pop("name"), **keys) if "name" in keys else add(**keys)


def _moved(key: str, value: Any, unit: str, own: set[str], offset: Array) -> Any:
    """Value of a key in the copy."""
    if key in REFERENCES:
        if isinstance(value, list):
            return [f"{unit}_{name}" if name in own else name for name in value]
        return f"{unit}_{value}" if key == "hydro" or value in own else value
    if key in CHANNELS:
        names = value if isinstance(value, list) else [value]
        return [_moved_channel(name, unit, own) for name in names]
    if key in PLACES:
        places = np.asarray(value, dtype=float)  # of a gauge in plan
        return (places + np.array([*offset, 0.0])[: places.shape[-1]]).tolist()
    return value


def _moved_channel(channel: str, unit: str, own: set[str]) -> str:
    """Channel of the copy: "joints/hinge/angle", "energy/work/pto"; other parts are no names."""
    parts = channel.split("/")
    at = 2 if parts[:2] == ["energy", "work"] else 1
    if len(parts) > at and parts[at] in own:
        parts[at] = f"{unit}_{parts[at]}"
    return "/".join(parts)


@dataclass(frozen=True)
class Limited:
    """A database whose far bodies do not radiate into each other, and what that costs.

    Attributes
    ----------
    database : HydroDatabase
        Without fits and kernel, which held the coupling; the excitation is whole.
    left_out : float
        Share of the pairs of bodies that are uncoupled [-].
    error : float
        Largest entry of A or B that is left out, over the largest ones of the diagonals of the
        motions that it joins [-].
    smallest : float
        Smallest eigenvalue of what is left of B, scaled likewise; well below 0 the radiation can
        feed a motion [-].
    """

    database: HydroDatabase
    left_out: float
    error: float
    smallest: float

    def __str__(self) -> str:
        """One line: what is left out, and the error."""
        return (
            f"{100.0 * self.left_out:.0f} % of the pairs uncoupled: A and B miss up to "
            f"{100.0 * self.error:.2g} % of the diagonal; smallest eigenvalue of B "
            f"{self.smallest:.1e} of the largest damping"
        )


def limit(
    database: HydroDatabase,
    *,
    radius: float | None = None,
    units: Mapping[str, ArrayLike] | None = None,
) -> Limited:
    """Uncouple the radiation of bodies that are far apart, or in different units.

    Parameters
    ----------
    database : HydroDatabase
        Of the whole array.
    radius : float, optional
        Bodies whose reference points are farther apart in plan [m] do not feel each other.
    units : mapping, optional
        In place of that, names of units: only bodies of one unit, `<unit>_<body>`, feel each other.

    Raises
    ------
    DatabaseError
        Neither or both are given, a radius that is not >= 0, or a body belongs to no unit.
    CaseError
        Names of units of which one begins with another.
    """
    if (radius is None) == (units is None):
        raise DatabaseError("limit: give either a radius or units").about("option", "limit")
    if radius is not None and not _number(radius) >= 0.0:
        raise DatabaseError(f"limit: radius {radius!r}: expected a number >= 0 [m]").about(
            "option", "limit"
        )
    names = list(database.bodies)
    if radius is not None:
        points = np.array([database.reference_point(name)[:2] for name in names])
        near = np.linalg.norm(points[:, None] - points[None, :], axis=2) <= radius
    else:
        _check_names(units or {})
        owner = np.array([_unit_of(name, list(units or {})) for name in names])
        near = owner[:, None] == owner
    limited = database.without_coupling(near)
    bodies = [names.index(label.body) for label in database.labels]
    kept = near[np.ix_(bodies, bodies)]
    pairs = len(names) * (len(names) - 1)
    scaled = [_scaled(table) for table in (database.added_mass, database.radiation_damping)]
    lost = max(float(np.abs(table * ~kept).max(initial=0.0)) for table in scaled)
    smallest = float(np.linalg.eigvalsh(_scaled(database.radiation_damping) * kept).min())
    return Limited(limited, float((~near).sum()) / max(pairs, 1), lost, smallest)


def _unit_of(name: str, units: list[str]) -> str:
    """Longest unit whose prefix the name has."""
    found = [unit for unit in units if name.startswith(f"{unit}_")]
    if not found:
        raise DatabaseError(f"body {name!r} belongs to none of the units {', '.join(units)}").about(
            "label", name
        )
    return max(found, key=len)


def _scaled(table: Array) -> Array:
    """Entries over the roots of the largest diagonal entries of both motions, all frequencies.

    Motions of one kind share their scale; those without any are left out (zero).
    """
    diagonal = np.abs(np.einsum("wii->wi", table)).max(axis=0)
    size = np.sqrt(diagonal)
    scale = np.where(size > 1e-9 * size.max(initial=0.0), size, np.inf)
    return np.asarray(table / np.outer(scale, scale))


def places_of(
    bodies: Mapping[str, ArrayLike], units: Mapping[str, ArrayLike]
) -> dict[str, tuple[float, float]]:
    """Places of all bodies of an array by their names, as `hydrodae.hdb.cylinders` takes them.

    Parameters
    ----------
    bodies : dict of (x, y)
        Places of the bodies of one device [m].
    units : dict of (x, y)
        As in `place`.

    Raises
    ------
    CaseError
        As `place`.
    """
    offsets, own = _placed_units(units), _places(bodies, "body")
    return {
        f"{unit}_{body}": (float(at[0] + shift[0]), float(at[1] + shift[1]))
        for unit, shift in offsets.items()
        for body, at in own.items()
    }
