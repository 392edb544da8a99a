"""Places of the points of a MoorDyn input file, and to which bodies of a case they belong."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.mooring.moordyn_deck import Deck, Point
from hydrodae.mooring.moordyn_sections import Row
from hydrodae.support.arrays import Array

#: What --body and --at say of coupled points.
COUPLED = ""
_OF_VESSEL = ("coupled",)


@dataclass(frozen=True)
class Pose:
    """Where the origin of points is in the reference pose of a case, and its axes."""

    place: Array
    rotation: Array
    given: str = ""  #: in words

    def of(self, point: Sequence[float]) -> Array:
        """Return the place in world axes of a point in these axes [m]."""
        return np.asarray(self.place + self.rotation @ np.array(point))


@dataclass
class Places:
    """Bodies of the case for what points of the file belong to, and the poses of these.

    Attributes
    ----------
    deck : Deck
        The file.
    names : mapping from str
        Bodies of the case, by COUPLED, by the number of a body of the file, or by "turbineN".
    at : mapping from str
        Poses that replace those of the file, likewise: 3 or 6 numbers [m, deg].
    """

    deck: Deck
    names: dict[str, str]
    at: dict[str, Pose]
    used: dict[str, Row] = field(default_factory=dict)  #: first row of each key
    made: set[str] = field(default_factory=set)  #: free bodies and rods with tables here

    def __post_init__(self) -> None:
        """A single coupled body stands for the vessel, if no point is coupled by itself."""
        coupled = [b.id for b in self.deck.bodies.values() if b.attachment in _OF_VESSEL]
        if len(coupled) == 1 and all(p.attachment != "coupled" for p in self.deck.points.values()):
            self.names.setdefault(coupled[0], self.names[COUPLED])

    def is_own(self, key: str) -> bool:
        """Whether this is a free body of the file, or a rod that turns freely."""
        body = self.deck.bodies.get(key)
        return body.attachment == "free" if body else key.removeprefix("rod") in self.deck.rods

    def owner(self, point: Point) -> tuple[str, Array]:
        """Return the body of the case that a point belongs to, or ground, and its place."""
        if point.attachment == "fixed":
            return "ground", np.array(point.place)
        if point.attachment == "free":
            return f"point{point.id}", np.array(point.place)
        key = self._key(point)
        body = self.deck.bodies.get(key)
        if body is not None and body.attachment == "fixed":
            return "ground", pose((*body.place, *body.angles)).of(point.place)
        if self.is_own(key) and key not in self.names:
            self.made.add(key)
            return (f"body{key}" if body else key), self.pose(key).of(point.place)
        if key not in self.names:
            row = point.row if body is None else body.row
            what = f"body {key}" if body is not None else key
            raise row.fail(
                f"{what}: which body of the case is it? Say --body {key}=NAME, in Python "
                f'bodies={{"{key}": NAME}}'
            )
        if key.startswith("turbine") and key not in self.at:
            raise point.row.fail(
                f'{key}: where is it? Say --at {key}=X,Y,Z, in Python at={{"{key}": (X, Y, Z)}}: '
                "the origin of its points in the reference pose of the case [m]"
            )
        self.used.setdefault(key, point.row)
        return self.names[key], self.pose(key).of(point.place)

    def pose(self, key: str) -> Pose:
        """Return the pose of coupled points, of a body of the file or of a turbine."""
        if key in self.at:
            return self.at[key]
        body = self.deck.bodies.get(key)
        return pose((*body.place, *body.angles) if body else (0.0, 0.0, 0.0))

    def check(self) -> None:
        """Refuse poses and names of what the file does not have.

        Raises
        ------
        CaseError
            There is one of them.
        """
        for key in self.at:
            if key in self.used or key in self.made:
                continue
            others = ", ".join(f"--at {name}=X,Y,Z" for name in sorted(self.used) if name)
            what = f"{key!r}" if key else "coupled points"
            raise CaseError(
                f"{self.deck.file}: a place is given for {what}, but no line ends there"
                + (f"; there is {others}" if others else "")
            )
        for key in self.names:
            rod = key.startswith("rod") and key[3:] in self.deck.rods
            if key and key not in self.used and key not in self.deck.bodies and not rod:
                raise CaseError(f"{self.deck.file}: no body {key!r} in the file")

    def notes(self) -> list[tuple[str, Row]]:
        """Say, with the first row of each, where points are taken to be."""
        out = []
        for key in sorted(self.used):
            name, at = self.names[key], self.pose(key)
            what = f"body {key} of the file" if key in self.deck.bodies else key or "coupled points"
            why = ", as in the file" if key in self.deck.bodies else ", the default"
            where = at.given + ("" if key in self.at else why)
            text = (
                f"points of {what} belong to {name}, whose reference pose has their origin at "
                f"{where}; --at {key + '=' if key else ''}X,Y,Z[,ROLL,PITCH,YAW] moves them"
            )
            out.append((text, self.used[key]))
        return out

    def _key(self, point: Point) -> str:
        kind = point.attachment
        if kind.startswith("turbine"):
            return kind
        if kind in _OF_VESSEL:
            return COUPLED
        if point.rod and kind == f"rod{point.rod}":
            return kind
        number = kind.removeprefix("body")
        if kind == number or number not in self.deck.bodies:
            raise point.row.fail(
                f"point {point.id}: attachment {point.row.text('attachment')!r} is not carried "
                "over; there are Fixed, Coupled (Vessel), Free (Connect), TurbineN and the bodies "
                "of the file"
            )
        return number


def pose(numbers: Sequence[float]) -> Pose:
    """Return the pose of 3 or 6 numbers: a place [m], and roll, pitch and yaw [deg].

    Raises
    ------
    CaseError
        There are not as many.
    """
    if len(numbers) not in (3, 6):
        raise CaseError(
            f"a place in the reference pose: expected x, y, z [m], or these and roll, pitch, yaw "
            f"[deg], instead of {len(numbers)} numbers"
        )
    place, angles = numbers[:3], numbers[3:]
    given = "(" + ", ".join(f"{x:g}" for x in place) + ") m"
    if any(angles):
        given += ", turned by (" + ", ".join(f"{x:g}" for x in angles) + ") deg"
    return Pose(np.array(place, float), rotation(angles or (0.0, 0.0, 0.0)), given)


def poses(at: Sequence[float] | Mapping[str, Sequence[float]] | None) -> dict[str, Pose]:
    """Return poses by what they are of; a single one is that of coupled points."""
    if at is None:
        return {}
    if not isinstance(at, Mapping):
        at = {COUPLED: at}
    return {key.lower(): pose(numbers) for key, numbers in at.items()}


def rotation(angles_deg: Sequence[float]) -> Array:
    """Rx Ry Rz of roll, pitch and yaw, as in MoorDyn."""
    (a, b, c), (x, y, z) = np.cos(np.radians(angles_deg)), np.sin(np.radians(angles_deg))
    about_x = np.array([[1, 0, 0], [0, a, -x], [0, x, a]])
    about_y = np.array([[b, 0, y], [0, 1, 0], [-y, 0, b]])
    about_z = np.array([[c, -z, 0], [z, c, 0], [0, 0, 1]])
    return np.asarray(about_x @ about_y @ about_z)
