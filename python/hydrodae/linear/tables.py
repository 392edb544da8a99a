"""The tables of a database at any frequency, for the coordinates that move."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from hydrodae import _core
from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.labels import read_labels
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array, Complex


class WaterTables:
    """Added mass, radiation damping and excitation of a linearised case.

    Parameters
    ----------
    database : HydroDatabase
    model : dict
        What the kernel shows of the case: `hydro_labels`, `hydro_map` (T), `hydro_yaws`,
        `hydro_points`.
    follows_yaw : bool
        Axes that turn with the bodies: headings that the database lacks follow from its symmetry.
    """

    def __init__(
        self, database: HydroDatabase, model: dict[str, Any], *, follows_yaw: bool = False
    ) -> None:
        self.database = database
        self._model = model
        self._follows_yaw = follows_yaw

    def share(self, other: WaterTables) -> None:
        """Take over the splines of other tables of the same database and coordinates."""
        if self._model["hydro_labels"] == other._model["hydro_labels"]:
            names = ["_radiation"]
            if self._follows_yaw == other._follows_yaw:
                names += ["_waves", "_smooth_excitation"]
            self.__dict__.update({name: getattr(other, name) for name in names})

    @cached_property
    def _labels(self) -> NDArray[np.intp]:
        return self.database.index(self._model["hydro_labels"])

    @cached_property
    def _radiation(self) -> CubicSpline:
        """A and B of the moving coordinates over frequency, side by side."""
        db, i = self.database, self._labels
        tables = np.stack([m[:, i][:, :, i] for m in (db.added_mass, db.radiation_damping)], axis=1)
        return CubicSpline(db.omega, tables, bc_type="natural")

    def added(self, omega: Array) -> tuple[Array, Array]:
        """T^T A T and T^T B T at frequencies inside the database; (nw, n_u, n_u) each."""
        self.check_frequencies(omega)
        t = self._model["hydro_map"]
        moved = t.T @ self._radiation(omega) @ t
        return moved[:, 0], moved[:, 1]

    def continued(self, omega: complex) -> tuple[Complex, Complex]:
        """T^T A T and T^T B T, (n_u, n_u), near the real axis, also outside the database.

        Below it A = A(w_min) and B = B(w_min) (w/w_min)^3, as heave in deep water (the others fall
        faster); above it A = A_inf + (A(w_max) - A_inf) (w_max/w)^2 and B the same
        with (w_max/w)^3. Off the real axis by the Taylor series, to second order inside the
        database and to first order outside.
        """
        low, high = self.database.omega[[0, -1]]
        w, aside = omega.real, 1j * omega.imag
        if w < low:
            added, damping = self._radiation(low)
            damping = damping * ((w / low) ** 3 + aside * 3.0 * w**2 / low**3)
        elif w > high:
            i = self._labels
            at_inf = self.database.added_mass_inf[np.ix_(i, i)]
            added, damping = self._radiation(high)
            falls = (high / w) ** 2 - aside * 2.0 * high**2 / w**3
            added = at_inf + (added - at_inf) * falls
            damping = damping * ((high / w) ** 3 - aside * 3.0 * high**3 / w**4)
        else:
            slope, curvature = self._radiation(w, 1), self._radiation(w, 2)
            added, damping = self._radiation(w) + aside * slope + 0.5 * aside**2 * curvature
        t = self._model["hydro_map"]
        return np.asarray(t.T @ added @ t, complex), np.asarray(t.T @ damping @ t, complex)

    def check_frequencies(self, omega: Array) -> None:
        """Raise DatabaseError for a frequency outside the database [rad/s]."""
        low, high = self.database.omega[0], self.database.omega[-1]
        if omega.size == 0 or omega.min() < low * (1 - 1e-9) or omega.max() > high * (1 + 1e-9):
            raise DatabaseError(
                f"frequencies {omega.min():g} to {omega.max():g} rad/s are outside the database, "
                f"{low:g} to {high:g} rad/s (periods {2 * np.pi / high:g} to {2 * np.pi / low:g} s)"
            ).about("range", "frequencies")

    def _lag(self, omega: Array, heading: Array, points: Array) -> Array:
        """Phase k.x of the waves at points (m, 3), (nw, nh, m) [rad]."""
        db = self.database
        along = np.multiply.outer(np.cos(heading), points[:, 0])
        along += np.multiply.outer(np.sin(heading), points[:, 1])
        return np.asarray(wavenumber(omega, db.water_depth, db.gravity)[:, None, None] * along)

    def _points(self, of: Callable[[HydroDatabase, str], Array]) -> Array:
        """A point of the body of each label, (m, 3) [m]."""
        labels = read_labels(self._model["hydro_labels"])
        return np.array([of(self.database, label.body) for label in labels])

    @cached_property
    def _waves(self) -> tuple[Array, Complex]:
        """Headings (nh,) and the excitation there, (nw, nh, n)."""
        db = self.database
        if not self._follows_yaw:
            return db.heading, db.excitation
        points = {name: db.reference_point(name) for name in db.bodies}
        heading, tables = _core.with_images(
            list(db.coordinates),
            points,
            db.added_mass_inf,
            db.omega,
            list(db.radiation_damping),
            db.heading,
            list(np.moveaxis(db.excitation, 1, 0)),
            [db.rho, db.gravity, db.water_depth],
        )
        return heading, np.stack(tables, axis=1)

    @cached_property
    def _smooth_excitation(self) -> CubicSpline:
        """Excitation over frequency with the phase at the bodies taken off."""
        db, (heading, tables) = self.database, self._waves
        lag = self._lag(db.omega, heading, self._points(HydroDatabase.phase_point))
        smooth = tables[:, :, self._labels] * np.exp(1j * lag)
        return CubicSpline(db.omega, smooth, bc_type="natural")

    def excitation(self, w: Array, heading: float) -> Complex:
        """T^T F of the database, (nw, n_u) per metre of wave amplitude, phase zero at the origin.

        Raises
        ------
        DatabaseError
            A frequency or the heading is outside the database.
        """
        self.check_frequencies(w)
        yaws = np.asarray(self._model["hydro_yaws"], dtype=float)
        points = np.asarray(self._model["hydro_points"], dtype=float).reshape(-1, 3)
        tables = self._smooth_excitation(w)
        force = np.empty((w.size, yaws.size), dtype=complex)
        for yaw in np.unique(yaws):
            mine = yaws == yaw
            relative = self._covered(heading - yaw)
            weights = self._headings.weights(relative)
            phase = self._lag(w, np.array([relative]), self._places[mine])[:, 0]
            force[:, mine] = np.einsum("h,whc->wc", weights, tables[:, :, mine])
            force[:, mine] *= np.exp(-1j * phase)
        force *= np.exp(-1j * self._lag(w, np.array([heading]), points))[:, 0]
        return np.asarray(force @ self._model["hydro_map"])

    @cached_property
    def _headings(self) -> _core.Headings:
        return _core.Headings(self._waves[0])

    @cached_property
    def _places(self) -> Array:
        """From the reference points to where the phase is taken off, (m, 3) [m]."""
        return self._points(HydroDatabase.phase_point) - self._points(HydroDatabase.reference_point)

    def _covered(self, heading: float) -> float:
        """The heading within those of the database."""
        covered = self._headings.covered(heading)
        if covered is None:
            low, high = np.degrees(self._waves[0][[0, -1]])
            raise DatabaseError(
                f"heading {np.degrees(heading):g} deg is outside the headings of the database, "
                f"{low:g} to {high:g} deg"
            ).about("range", "headings")
        return covered
