"""A database of equal floating cylinders without a boundary-element run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import DatabaseError
from hydrodae.hdb.checks.check import check
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.all_round import closed, closing_finding
from hydrodae.hdb.database.extra import SourceTable
from hydrodae.hdb.database.findings import CheckReport, Finding
from hydrodae.hdb.database.kochin import DIFFRACTION, RADIATION
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.interaction.array import Solution, solve
from hydrodae.hdb.interaction.cylinder import Cylinder
from hydrodae.hdb.interaction.far import kochin as kochin_functions
from hydrodae.hdb.interaction.vertical import outside
from hydrodae.hdb.labels import DOFS, six_of_each
from hydrodae.support.arrays import Array, Complex

#: Eigenfunctions over one draught, if not given; and the most that are taken by default.
MODES_PER_DRAFT, MOST_MODES = 18, 600


@dataclass(frozen=True)
class Water:
    """Water and waves of a database of cylinders.

    Attributes
    ----------
    omega : (nw,) array
        Frequencies [rad/s], at least 4, finite and > 0, ascending; w = inf is always added.
    depth : float
        [m], finite: the eigenfunctions are those of a finite depth. Ten draughts are nearly deep.
    heading : (nh,) array
        Directions of travel [rad]; those that go all round are closed with the first, a turn on.
    rho, gravity : float
        [kg/m3], [m/s2].
    """

    omega: Array
    depth: float
    heading: Array = field(default_factory=lambda: np.zeros(1))
    rho: float = 1025.0
    gravity: float = 9.81

    def __post_init__(self) -> None:
        w = np.asarray(self.omega, dtype=float)
        object.__setattr__(self, "omega", w)
        object.__setattr__(self, "heading", np.asarray(self.heading, dtype=float))
        ascending = w.ndim == 1 and w.size >= 4 and w.min() > 0.0 and np.all(np.diff(w) > 0.0)
        if not (ascending and np.all(np.isfinite(w))):
            raise DatabaseError(
                "needs at least 4 frequencies > 0 in ascending order [rad/s]"
            ).about("frequencies")
        if not (self.rho > 0.0 and self.gravity > 0.0):
            raise DatabaseError("rho and gravity must be > 0").about("value", "water")
        if not (0.0 < self.depth < np.inf):
            raise DatabaseError(
                f"depth {self.depth:g} m: the interaction theory needs a finite depth; for deep "
                "water take half of the longest wave that matters"
            ).about("value", "depth")


def cylinders(
    places: Mapping[str, ArrayLike],
    body: Cylinder,
    water: Water,
    *,
    orders: int = 4,
    modes: int | None = None,
    kochin: int = 0,
    progress: Callable[[float, float], None] | None = None,
) -> tuple[HydroDatabase, CheckReport]:
    """Compute a database of equal vertical cylinders by interaction theory; `hydrodae hdb array`.

    The isolated cylinder is solved by eigenfunction matching, the array by the interaction theory
    of Kagemoto and Yue, which is exact within linear theory up to the truncation stated in the
    report. Yaw neither radiates nor is excited: its rows are zero.

    Parameters
    ----------
    places : dict of (2,) arrays
        Axis of each body by its name [m].
    body : hydrodae.hdb.Cylinder
        Radius, draught, height of the reference point.
    water : Water
    orders : int
        Highest order of e^{i n theta} about each body.
    modes : int, optional
        Vertical eigenfunctions; default: 18 over a draught, at most 600. Their number decides the
        cost and most of the error.
    kochin : int
        Angles around the circle at which Kochin functions are kept; 0 for none.
    progress : callable, optional
        Called with (frequencies done, of) after each frequency.

    Returns
    -------
    database : HydroDatabase
    report : CheckReport
        With the error of truncation, from twice the modes and two more orders at the frequency in
        the middle.

    Raises
    ------
    DatabaseError
        Bodies that touch each other or the seabed, a bad count, or an infinite depth.
    """
    points = _points(places, body, water)
    count = _count(body, water) if modes is None else modes
    if orders < 2 or count < 4:
        raise DatabaseError(f"orders {orders}, modes {count}: expected at least 2 and 4").about(
            "option", "orders"
        )
    if kochin < 0:
        raise DatabaseError(f"kochin {kochin}: expected a number of angles").about(
            "option", "kochin"
        )
    omega = np.append(water.omega, np.inf)
    solved: list[Solution] = []
    for i, w in enumerate(omega):
        solved.append(_solve(points, body, water, float(w), orders, count))
        if progress is not None:
            progress(float(i + 1), float(omega.size))
    how = f"{orders} orders, {count} modes"
    loads = [_scaled(one, water, float(w)) for one, w in zip(solved, omega, strict=True)]
    asked = _collect(list(places), points, body, water, loads, how)
    if kochin:
        asked = replace(asked, extra=_kochin(list(places), points, body, water, solved, kochin))
    database = closed(asked)
    middle = water.omega.size // 2
    w = float(omega[middle])
    finer = _solve(points, body, water, w, orders + 2, 2 * count)
    error = _distance(loads[middle], _scaled(finer, water, w))
    text = (
        f"twice the modes and two more orders change A, B and F by at most {error:.1e} of "
        "the largest entry of their kind"
    )
    found = [Finding("info", "truncation", text, error, w)]
    found += [] if database is asked else [closing_finding(asked.heading)]
    return database, CheckReport([*found, *check(database).findings])


def _points(places: Mapping[str, ArrayLike], body: Cylinder, water: Water) -> Array:
    """Places (n, 2), after the checks of the geometry."""
    if not (body.radius > 0.0 and 0.0 < body.draft < water.depth):
        raise DatabaseError(
            f"a cylinder of radius {body.radius:g} m and draught {body.draft:g} m: expected a "
            f"radius > 0 and a draught between 0 and the depth {water.depth:g} m"
        ).about("geometry", "cylinder")
    if not places:
        raise DatabaseError("no bodies: give at least one place").about("option", "places")
    for name, place in places.items():
        if np.shape(place) != (2,) or not np.all(np.isfinite(np.asarray(place, dtype=float))):
            raise DatabaseError(f"place of {name!r}: expected x, y [m]").about("shape", name)
    names, points = list(places), np.array([np.asarray(p, float) for p in places.values()])
    for i in range(len(names)):
        for j in range(i):
            distance = float(np.hypot(*(points[i] - points[j])))
            if distance <= 2.0 * body.radius:
                raise DatabaseError(
                    f"{names[j]!r} and {names[i]!r} are {distance:g} m apart, less than a diameter"
                ).about("geometry", names[i])
    return points


def _count(body: Cylinder, water: Water) -> int:
    return min(MOST_MODES, max(40, int(np.ceil(MODES_PER_DRAFT * water.depth / body.draft))))


def _solve(
    points: Array, body: Cylinder, water: Water, omega: float, orders: int, count: int
) -> Solution:
    """Return the solution at a frequency, which may be infinite."""
    modes = outside(omega, water.depth, water.gravity, count)
    headings = [] if np.isinf(omega) else list(water.heading)
    return solve(body, points, modes, orders, headings)


def _scaled(found: Solution, water: Water, omega: float) -> tuple[Complex, Complex, Complex]:
    """Return A - iB/w (6 n, 6 n), and Froude-Krylov and diffraction (nh, 6 n)."""
    # the loads of plane waves: phi = i g/w Z_0(z)/Z_0(0), F = i w rho int phi n dS
    height = water.rho * water.gravity / _surface(water, omega)
    return -water.rho * found.radiation, -height * found.undisturbed, -height * found.scattered


def _surface(water: Water, omega: float) -> float:
    """Z_0(0) at a frequency."""
    return float(outside(omega, water.depth, water.gravity, 1).at(water.depth)[0])


def _kochin(
    names: Sequence[str],
    points: Array,
    body: Cylinder,
    water: Water,
    solved: Sequence[Solution],
    count: int,
) -> dict[str, SourceTable]:
    """Return Kochin functions at so many angles, as Capytaine names and scales them."""
    theta = 2.0 * np.pi * np.arange(count) / count
    motions = len(DOFS) * len(names)
    found = np.empty((water.omega.size, motions + water.heading.size, count), dtype=complex)
    for row, (w, one) in enumerate(zip(water.omega, solved[:-1], strict=True)):
        sent = one.sent.copy()
        # potential of unit velocity to elevation of unit motion, -i w (i w) / g; that of a plane
        # wave of unit elevation holds Z_0(z) / Z_0(0)
        sent[:motions] *= w**2 / water.gravity * _surface(water, float(w))
        far = (body.radius, float(w), water.depth, water.gravity, theta)
        found[row] = kochin_functions(sent, points, *far)
    dofs = tuple(f"{name}__{dof.capitalize()}" for name in names for dof in DOFS)
    axes: dict[str, Array | tuple[str, ...]] = {"omega": water.omega, "theta": theta}
    radiation = {**axes, "radiating_dof": dofs}
    waves = {**axes, "wave_direction": water.heading}
    return {
        RADIATION: SourceTable(found[:, :motions], ("omega", "radiating_dof", "theta"), radiation),
        DIFFRACTION: SourceTable(found[:, motions:], ("omega", "wave_direction", "theta"), waves),
    }


def _distance(one: tuple[Complex, ...], other: tuple[Complex, ...]) -> float:
    """Largest change of a table, entries scaled by the largest ones of the motions they join."""
    inertia, reference = one[0], other[0]
    size = np.sqrt(np.abs(np.diag(reference)))
    scale = np.where(size > 0.0, size, np.inf)
    loads = sum(one[1:]) - sum(other[1:])
    largest = np.abs(sum(other[1:])).reshape(-1, len(DOFS)).max(axis=0, initial=0.0)
    largest = np.where(largest > 0.0, largest, np.inf)
    change = np.abs(inertia - reference) / np.outer(scale, scale)
    part = np.abs(loads).reshape(-1, len(DOFS)) / largest
    return float(max(change.max(), part.max(initial=0.0)))


def _collect(
    names: Sequence[str],
    points: Array,
    body: Cylinder,
    water: Water,
    solved: Sequence[tuple[Complex, Complex, Complex]],
    how: str,
) -> HydroDatabase:
    """Put the tables together; they are symmetric, to rounding."""
    table = np.array([0.5 * (one[0] + one[0].T) for one in solved])
    n = table.shape[1]
    area = np.pi * body.radius**2
    moment = area * body.radius**2 / 4.0
    bodies = {}
    for name, (x, y) in zip(names, points, strict=True):
        statics = Hydrostatics(
            area * body.draft,
            np.array([x, y, -0.5 * body.draft]),
            area,
            np.array([0.0, 0.0, moment, moment, 0.0]),
        )
        bodies[name] = Body(name, np.array([x, y, body.point]), statics)
    return HydroDatabase(
        coordinates=six_of_each(names),
        omega=water.omega,
        added_mass=table[:-1].real,
        radiation_damping=-table[:-1].imag * water.omega[:, None, None],
        added_mass_inf=table[-1].real,
        added_mass_inf_std=np.zeros((n, n)),
        heading=water.heading,
        froude_krylov=np.array([one[1] for one in solved[:-1]]),
        diffraction=np.array([one[2] for one in solved[:-1]]),
        bodies=bodies,
        rho=water.rho,
        gravity=water.gravity,
        water_depth=water.depth,
        source=f"cylinders of radius {body.radius:g} m and draught {body.draft:g} m",
        generator=f"hydrodae, interaction theory, {how}",
        title=f"{len(names)} equal vertical cylinders",
    )
