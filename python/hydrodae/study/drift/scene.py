"""Waves that leave a scene as it moves: diffraction, and radiation by the motions of `rao`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.kochin import kochin_of
from hydrodae.hdb.database.second_order import SAME_HEADING
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.hdb.relations.far_field import Water, radiated_damping
from hydrodae.linear import LinearModel
from hydrodae.linear.response import power_factor
from hydrodae.support.arrays import Array, Complex

#: Damping by Kochin functions against that of the database, over its size: pressures and sources of
#: one mesh differ by up to 5 % (200 panels of a hemisphere); functions about other points, of other
#: bodies or in other units by their whole size.
SAME_DAMPING = 0.2


@dataclass(frozen=True)
class Leaving:
    """Waves that leave a scene, in axes that stand and are turned as those of its database.

    Attributes
    ----------
    kochin : (nw, nh, nt) complex array
        H, e^{-iwt} [m2/s].
    heading : (nh,) array
        Directions of travel in these axes [rad].
    power : (nw, nh) array
        Mean power that the waves lose to the scene, by loads and radiation damping of the database
        [W/m2].
    by_force : dict of (nw, nh) arrays
        Mean power of each damper and rotary take-off [W/m2].
    """

    kochin: Complex
    heading: Array
    power: Array
    by_force: dict[str, Array]


class Surroundings:
    """The water around a linearised case.

    Parameters
    ----------
    model : LinearModel

    Raises
    ------
    CaseError
        No body of the case is in the water, or its bodies are turned differently.
    DatabaseError
        The database has no Kochin functions, or not those of its own tables.
    """

    def __init__(self, model: LinearModel) -> None:
        if model.database is None or model.tables is None:
            raise CaseError("far-field drift needs a body that moves and has `hydro` of a database")
        self.model = model
        self.database: HydroDatabase = model.database
        self.functions = kochin_of(self.database)
        known = self.functions.labels
        missing = [label for label in model.hydro_labels if label not in known]
        if missing:
            raise DatabaseError(
                f"no Kochin functions of {', '.join(missing)}: far-field drift needs them of every "
                f"coordinate that moves"
            ).about("missing", missing[0])
        self._rows = [known.index(label) for label in model.hydro_labels]
        yaws, places = model.hydro_places
        if np.ptp(yaws) > SAME_HEADING:
            low, high = np.degrees([yaws.min(), yaws.max()])
            raise CaseError(
                f"bodies are turned by {low:.4g} to {high:.4g} deg in the equilibrium: far-field "
                f"drift takes one angle for all"
            )
        self.yaw = float(yaws[0])
        points = np.array([self.database.reference_point(b) for b in self._owners])
        self.shift: Array = np.mean(places - points @ turned(self.yaw).T, axis=0)[:2]
        self._check_damping()

    @property
    def water(self) -> Water:
        """Density, gravity and depth of the database."""
        db = self.database
        return Water(db.rho, db.gravity, db.water_depth)

    @property
    def _owners(self) -> list[str]:
        return [label.rpartition(".")[0] for label in self.model.hydro_labels]

    def _check_damping(self) -> None:
        """Raise DatabaseError if the functions radiate another damping than the tables have."""
        omega = self.functions.omega
        rows = np.abs(self.database.omega[:, None] - omega).argmin(axis=0)
        i = self.database.index(self.model.hydro_labels)
        tables = self.database.radiation_damping[rows][:, i][:, :, i]
        far = radiated_damping(self.functions.radiation[:, self._rows], omega, self.water)
        own = np.einsum("wii->wi", tables)
        largest = own.max(axis=0)
        size = np.sqrt(np.outer(largest, largest))
        error = np.abs(far - tables).max(axis=0) / np.where(size > 0.0, size, np.inf)
        worst = float(error.max())
        if worst > SAME_DAMPING:
            a, b = np.unravel_index(int(error.argmax()), error.shape)
            labels = self.model.hydro_labels
            raise DatabaseError(
                f"the Kochin functions radiate another damping than the database has, by "
                f"{worst:.2g} of its size at {labels[a]}, {labels[b]}: the database was moved, "
                f"turned or renamed since, or its mesh is too coarse; compute it about the points "
                f"that it is used with"
            ).about("conflict", "kochin")

    def columns(self, headings: Array) -> list[int]:
        """Return the place of each heading (nh,) [rad], world axes, among those of the functions.

        Raises
        ------
        DatabaseError
            One is not there.
        """
        own = np.exp(1j * self.functions.heading)
        found = []
        for heading in headings:
            apart = np.abs(own - np.exp(1j * (heading - self.yaw)))
            if apart.min() > SAME_HEADING:
                known = ", ".join(f"{x:.4g}" for x in np.degrees(self.functions.heading + self.yaw))
                raise DatabaseError(
                    f"no Kochin functions of heading {np.degrees(heading):.4g} deg; there are "
                    f"those of {known} deg: compute the database with --heading-deg"
                ).about("range", "headings")
            found.append(int(apart.argmin()))
        return found

    @cached_property
    def headings(self) -> Array:
        """Headings that the functions have, world axes, each once, ascending [rad]."""
        turns = np.exp(1j * (self.functions.heading + self.yaw))
        angles: list[float] = []
        for turn, angle in zip(turns, self.functions.heading + self.yaw, strict=True):
            if all(abs(turn - np.exp(1j * known)) > SAME_HEADING for known in angles):
                angles.append(float(angle))
        return np.sort(np.array(angles))

    def leaving(self, omega: Array, headings: Array) -> Leaving:
        """Return the waves that leave the scene in waves of these headings (nh,) [rad].

        Raises
        ------
        DatabaseError
            A frequency or a heading is outside the functions.
        """
        low, high = self.functions.omega[[0, -1]]
        if omega.min() < low * (1 - 1e-9) or omega.max() > high * (1 + 1e-9):
            raise DatabaseError(
                f"frequencies {omega.min():g} to {omega.max():g} rad/s are outside the Kochin "
                f"functions, {low:g} to {high:g} rad/s"
            ).about("range", "frequencies")
        relative = headings - self.yaw
        out = self._diffraction(omega)[:, self.columns(headings)].copy()
        radiation = self._radiation(omega)
        k = self._wavenumber(omega)
        power = np.empty((omega.size, headings.size))
        by_force: dict[str, list[Array]] = {}
        tables = self.model.tables
        assert tables is not None
        damping = self.model.added(omega)[1]
        for h, heading in enumerate(headings):
            free = self._motion(omega, float(heading))
            xi, motions = free @ self.model.free.T, free @ self.model.hydro_map.T
            ahead = np.array([np.cos(heading), np.sin(heading)])
            motions = (
                motions * np.exp(1j * k * (self.shift @ ahead))[:, None]
            )  # as if not displaced
            out[:, h] += np.einsum("wi,wit->wt", motions.conj(), radiation)
            rate = 1j * omega[:, None] * xi
            given = np.sum(tables.excitation(omega, float(heading)).conj() * rate, axis=1).real
            lost = np.einsum("wi,wij,wj->w", rate.conj(), damping, rate).real
            power[:, h] = 0.5 * (given - lost)
            for name, value in self._powers(omega, xi).items():
                by_force.setdefault(name, []).append(value)
        stacked = {name: np.stack(values, axis=1) for name, values in by_force.items()}
        return Leaving(out, relative, power, stacked)

    def _motion(self, omega: Array, heading: float) -> Complex:
        """Return the free motions (nw, n_free) per metre of wave amplitude, e^{+iwt}."""
        free = self.model.free
        stiffness = free.T @ self.model.dynamic_stiffness_at(omega) @ free
        load = self.model.excitation(omega, heading) @ free
        return np.asarray(np.linalg.solve(stiffness, load[:, :, None])[:, :, 0])

    def _powers(self, omega: Array, xi: Complex) -> dict[str, Array]:
        """Return the mean power (nw,) of each damper and rotary take-off, of xi (nw, n_u)."""
        found = {
            d.name: 0.5
            * np.abs(xi @ d.row) ** 2
            * power_factor(omega, d.stiffness, d.damping, d.delay)
            for d in self.model.dampers
            if d.damping != 0.0 or d.delay > 0.0
        }
        return found | {each.name: each.power(omega, xi) for each in self.model.rotary}

    def _wavenumber(self, omega: Array) -> Array:
        return wavenumber(omega, self.water.depth, self.water.gravity)

    @cached_property
    def _ahead(self) -> Array:
        """Unit vectors (2, nt) of the angles."""
        count = self.functions.diffraction.shape[-1]
        theta = 2.0 * np.pi * np.arange(count) / count
        return np.stack([np.cos(theta), np.sin(theta)])

    def _lag(self, omega: Array, place: Array) -> Array:
        """Phase k p.(cos theta, sin theta) of waves that leave a place (2,), (nw, nt) [rad]."""
        return np.asarray(self._wavenumber(omega)[:, None] * (place @ self._ahead))

    def _arrival(self, omega: Array, place: Array) -> Array:
        """Phase k p.(cos beta, sin beta) of waves that reach a place (2,), (nw, nh) [rad]."""
        heading = self.functions.heading
        along = place @ np.stack([np.cos(heading), np.sin(heading)])
        return np.asarray(self._wavenumber(omega)[:, None] * along)

    @cached_property
    def _middle(self) -> Array:
        """Mean of the places of the bodies (2,) [m]."""
        points = [self.database.phase_point(body)[:2] for body in self.database.bodies]
        return np.asarray(np.mean(points, axis=0))

    @cached_property
    def _smooth_diffraction(self) -> CubicSpline:
        w = self.functions.omega
        phase = self._lag(w, self._middle)[:, None] - self._arrival(w, self._middle)[:, :, None]
        return CubicSpline(w, self.functions.diffraction * np.exp(1j * phase))

    def _diffraction(self, omega: Array) -> Complex:
        phase = self._lag(omega, self._middle)[:, None]
        phase = phase - self._arrival(omega, self._middle)[:, :, None]
        return np.asarray(self._smooth_diffraction(omega) * np.exp(-1j * phase))

    @cached_property
    def _phases_of(self) -> Array:
        """Places (m, 2) at which the phase of each coordinate is taken off [m]."""
        return np.array([self.database.phase_point(body)[:2] for body in self._owners])

    def _radiation_lag(self, omega: Array) -> Array:
        return np.stack([self._lag(omega, place) for place in self._phases_of], axis=1)

    @cached_property
    def _smooth_radiation(self) -> CubicSpline:
        w = self.functions.omega
        values = self.functions.radiation[:, self._rows]
        return CubicSpline(w, values * np.exp(1j * self._radiation_lag(w)))

    def _radiation(self, omega: Array) -> Complex:
        return np.asarray(self._smooth_radiation(omega) * np.exp(-1j * self._radiation_lag(omega)))


def turned(angle: float) -> Array:
    """Return the rotation matrix (3, 3) about the vertical axis."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
