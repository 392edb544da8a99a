"""Frequency domain of a case: the same scene, linearised at its static equilibrium.

With virtual displacements xi (translations in world axes, rotations in body axes), the velocities
U = T xi' of the hydrodynamic coordinates and phasors x(t) = Re(X e^{+iwt}):

    [-w^2 (M + T^T A(w) T) + iw (C + T^T B(w) T) + K] xi - G^T lambda = T^T F(w),    G xi = 0

A(w), B(w) and F(w) come from the database itself, without any memory fit; F(w) is that of the
heading relative to the mean yaw of each body, with the phase of its place. A force along a joint
coordinate s that acts tau late enters exactly, as (k + iw c) e^{-iw tau} s.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline
from scipy.linalg import eigh, null_space

from hydrodae.case import Case, CaseLike, read_case
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.dispersion import wavenumber

#: What the messages of the kernel say where a database lacks a fit or a radiation kernel.
MISSING_MEMORY = ("holds no exponential fit", "holds no radiation kernel")

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True)
class Mode:
    """A mode of free motion.

    Attributes
    ----------
    period : float
        Undamped natural period with the added mass at that period [s].
    damping_ratio : float
        Im w / |w| [-] of the complex frequency w of the damped mode, with A(w) and B(w) continued
        by their Taylor series off the real axis. Of a mode that hardly swings (a ratio above 0.5 to
        first order), and where Newton's method finds no damped mode beside the undamped one, the
        first-order value c / (2 w m + w^2 dA/dw) of this mode alone.
    shape : dict
        Share of each coordinate [m or rad], the largest is 1; of the undamped mode.
    extrapolated : bool
        The period is outside the frequencies of the database: below them A is that of the lowest
        and B falls with w^3, above them A goes to that at infinite frequency, and B to zero.
    """

    period: float
    damping_ratio: float
    shape: dict[str, float]
    extrapolated: bool = False


@dataclass(frozen=True)
class Response:
    """Response per metre of wave amplitude.

    Attributes
    ----------
    omega : (nw,) array
        Frequencies [rad/s].
    heading : float
        Direction of travel [rad].
    names : tuple of str
        Coordinates of bodies and joints and reactions, as channels.
    units : tuple of str
        Unit of each per metre of amplitude.
    values : (nw, n) complex array
        Phasors; phase zero when the crest passes the origin.
    power : dict of (nw,) arrays
        Mean power that each damper takes [W/m2].
    excitation_power, radiated_power : (nw,) arrays
        Mean power from the waves, and into radiated waves [W/m2].
    """

    omega: Array
    heading: float
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: Complex
    power: dict[str, Array]
    excitation_power: Array
    radiated_power: Array

    def __getitem__(self, name: str) -> Complex:
        """Phasors (nw,) of one channel."""
        if name not in self.names:
            raise CaseError(f"no response {name!r}; there are: {', '.join(self.names)}")
        return np.asarray(self.values[:, self.names.index(name)])


class LinearModel:
    """Linear model of a case about its static equilibrium in still water.

    Parameters
    ----------
    case : Case
        The scene; its waves and its start beyond the equilibrium do not matter.

    Raises
    ------
    CaseError
        There is no equilibrium near the start of the case.
    """

    def __init__(self, case: CaseLike) -> None:
        from hydrodae import _core

        self._given_database: HydroDatabase | None = None
        self.case, self.memory_missing = without_memory(case)
        model: dict[str, Any] = _core.linearize(self.case.scene)
        self.coordinates: list[str] = model["coordinates"]
        self.mass: Array = model["mass"]
        self.damping: Array = model["damping"]
        self.stiffness: Array = model["stiffness"]
        self.constraints: Array = model["constraints"]
        self.offsets = dict(zip(model["bodies"], np.array(model["offsets"]), strict=True))
        self.rotations = dict(zip(model["bodies"], np.array(model["rotations"]), strict=True))
        self.places = dict(zip(model["bodies"], np.array(model["places"]), strict=True))
        self.moorings: list[dict[str, Any]] = model["moorings"]
        self.reactions = dict(zip(model["reactions"], model["reaction"], strict=True))
        self.notes: list[str] = model["notes"]
        self._model = model
        # A basis of the motions that the constraints leave, coordinates in their own units.
        n = len(self.coordinates)
        self._free: Array = null_space(self.constraints) if len(self.constraints) else np.eye(n)
        self._constraints_inverse: Array = np.linalg.pinv(self.constraints.T)

    @cached_property
    def database(self) -> HydroDatabase | None:
        """The hydrodynamic database of the case."""
        if self._given_database is not None:
            return self._given_database
        path = self.case.scene.database_path
        return HydroDatabase.read(path) if path else None

    def with_database(self, database: HydroDatabase) -> LinearModel:
        """Return the same linearised case with the tables of another database of the same bodies.

        Hydrostatics and the equilibrium stay those of the case.
        """
        other = copy.copy(self)
        for name in ("database", "_labels", "_radiation", "_smooth_excitation"):
            other.__dict__.pop(name, None)  # cached properties of the old tables
        other._given_database = database
        return other

    @property
    def hydro_labels(self) -> tuple[str, ...]:
        """Labels of the hydrodynamic coordinates that move."""
        return tuple(self._model["hydro_labels"])

    @property
    def free(self) -> Array:
        """Basis of the motions that the constraints leave, (n_coordinates, n_free)."""
        return self._free

    @property
    def hydro_map(self) -> Array:
        """Rates of the hydrodynamic coordinates from those of the free motions."""
        return np.asarray(self._model["hydro_map"] @ self._free)

    @cached_property
    def _labels(self) -> NDArray[np.intp]:
        assert self.database is not None
        return self.database.index(self._model["hydro_labels"])

    @cached_property
    def _radiation(self) -> CubicSpline:
        """A and B of the moving coordinates over frequency, side by side."""
        db = self.database
        assert db is not None
        i = self._labels
        tables = np.stack([m[:, i][:, :, i] for m in (db.added_mass, db.radiation_damping)], axis=1)
        return CubicSpline(db.omega, tables, bc_type="natural")

    def _added(self, omega: Array) -> tuple[Array, Array]:
        """T^T A T and T^T B T at frequencies inside the database; (nw, n_u, n_u) each."""
        n = len(self.coordinates)
        if self.database is None or not self._model["hydro_labels"]:
            return np.zeros((omega.size, n, n)), np.zeros((omega.size, n, n))
        self._check_frequencies(omega)
        tables = self._radiation(omega)
        t = self._model["hydro_map"]
        moved = t.T @ tables @ t
        return moved[:, 0], moved[:, 1]

    def _continued(self, omega: complex) -> tuple[Complex, Complex]:
        """T^T A T and T^T B T, (n_u, n_u), near the real axis, also outside the database.

        Below it A = A(w_min) and B = B(w_min) (w/w_min)^3, as heave in deep water (the others fall
        faster); above it A = A_inf + (A(w_max) - A_inf) (w_max/w)^2 and B the same
        with (w_max/w)^3. Off the real axis by the Taylor series, to second order inside the
        database and to first order outside.
        """
        n = len(self.coordinates)
        if self.database is None or not self._model["hydro_labels"]:
            return np.zeros((n, n), dtype=complex), np.zeros((n, n), dtype=complex)
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

    def _late(self, omega: Array) -> Complex:
        """What delays and states of forces add to the dynamic stiffness; (nw, n_u, n_u).

        Delays: W^T [(k + iw c) e^{-iw tau} - k] W; the stiffness holds k already, as the static
        pose needs it. States, z' = A z + B xi + D xi': -F_z (iw - A)^-1 (B + iw D).
        """
        m = self._model
        n = len(self.coordinates)
        out = np.zeros((omega.size, n, n), dtype=complex)
        if len(m["state_by_state"]):
            s = 1j * omega[:, None, None]
            resolved = s * np.eye(len(m["state_by_state"])) - m["state_by_state"]
            driven = m["state_by_xi"] + s * m["state_by_rate"]
            out -= m["load_by_state"] @ np.linalg.solve(resolved, driven)
        for k, c, tau, row in zip(
            m["damper_stiffness"],
            m["damper_damping"],
            m["damper_delay"],
            m["damper_map"],
            strict=True,
        ):
            if tau > 0.0:
                factor = (k + 1j * omega * c) * np.exp(-1j * omega * tau) - k
                out += factor[:, None, None] * np.outer(row, row)
        return out

    def _check_frequencies(self, omega: Array) -> None:
        assert self.database is not None
        low, high = self.database.omega[0], self.database.omega[-1]
        if omega.size == 0 or omega.min() < low * (1 - 1e-9) or omega.max() > high * (1 + 1e-9):
            raise DatabaseError(
                f"frequencies {omega.min():g} to {omega.max():g} rad/s are outside the database, "
                f"{low:g} to {high:g} rad/s (periods {2 * np.pi / high:g} to "
                f"{2 * np.pi / low:g} s)"
            )

    def _lag(self, omega: Array, heading: Array, points: Array) -> Array:
        """Phase k.x of the waves at points (m, 3), (nw, nh, m) [rad]."""
        db = self.database
        assert db is not None
        along = np.multiply.outer(np.cos(heading), points[:, 0])
        along += np.multiply.outer(np.sin(heading), points[:, 1])
        return np.asarray(wavenumber(omega, db.water_depth, db.gravity)[:, None, None] * along)

    @cached_property
    def _smooth_excitation(self) -> CubicSpline:
        """Excitation over frequency with the phase at the reference points taken off."""
        db = self.database
        assert db is not None
        points = np.array(
            [db.reference_point(label.rpartition(".")[0]) for label in self._model["hydro_labels"]]
        )
        lag = self._lag(db.omega, db.heading, points)
        smooth = db.excitation[:, :, self._labels] * np.exp(1j * lag)
        return CubicSpline(db.omega, smooth, bc_type="natural")

    def excitation(self, omega: ArrayLike, heading: float) -> Complex:
        """T^T F, loads (nw, n_u) per metre of wave amplitude, phase zero at the origin.

        Of the database: the phase at each body's reference point is taken off, natural cubic
        splines go through the tables in frequency and heading, those of the heading relative to the
        mean yaw of the body are taken, and the phase is put in where the body stands. Of the
        Morison elements: inertia, and the slope that a current gives to the drag.

        Raises
        ------
        DatabaseError
            A frequency or the heading is outside the database, or nothing in the case feels waves.
        """
        w = np.asarray(omega, dtype=float)
        if self.database is not None and self.database.heading.size == 0:
            raise DatabaseError(
                f"the database of the case, {self.database.source or 'no source stated'}, holds no "
                f"excitation, because its source has none: import one with the forces of waves "
                f"(.3 of WAMIT, ExcitationForce.tec of Nemoh); natural modes need none"
            )
        if self.database is None and not self._model["water_points"]:
            raise DatabaseError("the case has neither a hydrodynamic database nor Morison elements")
        force = self._morison_excitation(w, heading)
        return force if self.database is None else force + self._database_excitation(w, heading)

    def _morison_excitation(self, w: Array, heading: float) -> Complex:
        """Loads (nw, n_u) of the water on the Morison elements, as in sea/kinematics.h."""
        if not self._model["water_points"]:
            return np.zeros((w.size, len(self.coordinates)), dtype=complex)
        points, depth = np.array(self._model["water_points"]), self._model["water_depth"]
        k = wavenumber(w, depth, self._model["gravity"])[:, None]
        z = np.minimum(points[:, 2], 0.0)
        wet = np.exp(k * z) * (z >= -depth) / (1.0 - np.exp(-2.0 * k * depth))
        back = np.exp(-2.0 * k * (np.maximum(z, -depth) + depth))
        c, s = np.cos(heading), np.sin(heading)
        eta = np.exp(-1j * k * (points[:, 0] * c + points[:, 1] * s))
        along, up = w[:, None] * wet * (1 + back) * eta, 1j * w[:, None] * wet * (1 - back) * eta
        velocity = np.stack([along * c, along * s, up], axis=2)
        water = np.concatenate(
            [velocity, 1j * w[:, None, None] * velocity, eta[:, :, None]], axis=2
        )
        return np.asarray(np.einsum("wpc,puc->wu", water, np.array(self._model["water_loads"])))

    def _database_excitation(self, w: Array, heading: float) -> Complex:
        db = self.database
        assert db is not None
        self._check_frequencies(w)
        yaws = np.asarray(self._model["hydro_yaws"], dtype=float)
        points = np.asarray(self._model["hydro_points"], dtype=float).reshape(-1, 3)
        tables = self._smooth_excitation(w)
        force = np.empty((w.size, yaws.size), dtype=complex)
        for yaw in np.unique(yaws):
            mine = yaws == yaw
            relative = _covered_heading(db, heading - yaw)
            if db.heading.size > 1:
                spline = CubicSpline(db.heading, tables[:, :, mine], axis=1, bc_type="natural")
                force[:, mine] = spline(relative)
            else:
                force[:, mine] = tables[:, 0, mine]
        force *= np.exp(-1j * self._lag(w, np.array([heading]), points))[:, 0]
        return np.asarray(force @ self._model["hydro_map"])

    def response(self, omega: ArrayLike, heading: float = 0.0) -> Response:
        """Response to waves of unit amplitude.

        Parameters
        ----------
        omega : (nw,) array
            Frequencies [rad/s].
        heading : float
            Direction of travel [rad].

        Raises
        ------
        DatabaseError
            Outside the database.
        """
        w = np.atleast_1d(np.asarray(omega, dtype=float))
        force = self.excitation(w, heading)
        added, radiation = self._added(w)
        free, iw = self._free, 1j * w[:, None, None]
        z = -(w**2)[:, None, None] * (self.mass + added) + iw * (self.damping + radiation)
        z = z + self.stiffness + self._late(w)
        reduced = free.T @ z @ free
        xi = np.linalg.solve(reduced, (force @ free)[:, :, None])[:, :, 0] @ free.T
        # G^T lambda = Z xi - F has a solution: the constraints left are independent.
        multipliers = ((z @ xi[:, :, None])[:, :, 0] - force) @ self._constraints_inverse.T
        m = self._model
        joints = xi @ m["motion_map"].T
        reactions = xi @ m["reaction_by_xi"].T + multipliers @ m["reaction_by_lambda"].T
        squares = np.abs(xi @ m["damper_map"].T) ** 2
        power = {
            name: 0.5 * squares[:, n] * _power_factor(w, k, c, tau)
            for n, (name, k, c, tau) in enumerate(
                zip(
                    m["dampers"],
                    m["damper_stiffness"],
                    m["damper_damping"],
                    m["damper_delay"],
                    strict=True,
                )
            )
            if c != 0.0 or tau > 0.0
        }
        velocity = 1j * w[:, None] * xi
        return Response(
            omega=w,
            heading=heading,
            names=(*self.coordinates, *m["motions"], *m["reactions"]),
            units=tuple(map(_unit, (*self.coordinates, *m["motions"], *m["reactions"]))),
            values=np.hstack([xi, joints, reactions]),
            power=power,
            excitation_power=0.5 * np.sum(force.conj() * velocity, axis=1).real,
            radiated_power=0.5
            * np.einsum("wi,wij,wj->w", velocity.conj(), radiation, velocity).real,
        )

    def modes(self) -> list[Mode]:
        """Natural modes of the constrained system, longest period first.

        Each frequency is found together with the added mass at that frequency (fixed point). Modes
        without restoring force are left out; those outside the frequencies of the database are
        marked.
        """
        found: list[Mode] = []
        count = self._free.shape[1]
        for k in range(count):
            mode = self._mode(k)
            if mode is not None:
                found.append(mode)
        return sorted(found, key=lambda mode: -mode.period)

    def _mode(self, k: int) -> Mode | None:
        """Mode with the k-th eigenvalue, added mass at its own frequency."""
        free = self._free
        stiffness = free.T @ self.stiffness @ free
        omega = 1.0
        if self.database is not None:
            low, high = self.database.omega[[0, -1]]
            omega = float(np.sqrt(low * high))
        for _ in range(200):
            added, _ = self._continued(complex(omega))
            mass = free.T @ (self.mass + added.real) @ free
            late = self._late(np.array([omega]))[0]
            spring = stiffness + free.T @ late.real @ free
            values, vectors = eigh(0.5 * (spring + spring.T), 0.5 * (mass + mass.T))
            if values[k] <= 1e-9 * np.abs(values).max():
                return None
            new = float(np.sqrt(values[k]))
            if abs(new - omega) <= 1e-10 * new:
                break
            omega = 0.5 * (omega + new)
        shape = free @ vectors[:, k]
        scaled = shape / shape[np.argmax(np.abs(shape))]
        return Mode(
            period=2.0 * np.pi / omega,
            damping_ratio=self._damping_ratio(omega, vectors[:, k]),
            shape=dict(zip(self.coordinates, scaled.tolist(), strict=True)),
            extrapolated=self.database is not None and not low <= omega <= high,
        )

    def _dynamic_stiffness(self, omega: complex) -> Complex:
        """Z(w) of the free motions; Z xi = 0 in a damped mode."""
        added, radiation = self._continued(omega)
        z = -(omega**2) * (self.mass + added) + 1j * omega * (self.damping + radiation)
        z = z + self.stiffness + self._late(np.array([omega]))[0]
        return np.asarray(self._free.T @ z @ self._free)

    def _damping_ratio(self, omega: float, shape: Array) -> float:
        """Im w / |w| of the damped mode next to an undamped one (omega, shape).

        Newton's method on Z(w) v = 0, v0^T v = 1, from the undamped mode.
        """
        n = shape.size

        def slope(w: complex) -> Complex:
            h = 1e-5 * abs(w)
            return (self._dynamic_stiffness(w + h) - self._dynamic_stiffness(w - h)) / (2.0 * h)

        # First order: w - w0 = -v^T Z v / (v^T Z' v), whose real part is of no matter here.
        z0, z1 = self._dynamic_stiffness(omega), slope(omega)
        first = float((-(shape @ z0 @ shape) / (shape @ z1 @ shape).real).imag / omega)
        if abs(first) > 0.5:
            return first
        size = np.abs(shape).max() / np.maximum(np.abs(shape), 1e-3 * np.abs(shape).max())
        left = shape * size**2 / np.sum((shape * size) ** 2)  # of mixed units
        w, v = complex(omega), shape.astype(complex)
        for _ in range(30):
            z = self._dynamic_stiffness(w)
            jacobian = np.block([[z, (slope(w) @ v)[:, None]], [left[None, :], np.zeros((1, 1))]])
            step = np.linalg.solve(jacobian, np.append(-z @ v, 1.0 - left @ v))
            w, v = w + step[-1], v + step[:n]
            if not abs(w - omega) < 0.5 * omega:
                return first
            if abs(step[-1]) <= 1e-9 * abs(w):
                return float(w.imag / abs(w))
        return first

    def irregular(self) -> tuple[dict[str, float], dict[str, float]]:
        """Response in the sea of the case, from the same components as in the time domain.

        Returns
        -------
        standard_deviation : dict
            Of every channel of `Response` and of "sea/elevation" [m].
        power : dict
            Mean power of every damper [W].

        Raises
        ------
        CaseError
            The case has no waves.
        """
        from hydrodae import _core

        waves = np.asarray(_core.wave_components(self.case.scene))
        if len(waves) == 0:
            raise CaseError("the case has no [[wave]]: there is no sea to respond to")
        variance: dict[str, float] = {"sea/elevation": 0.5 * float(np.sum(waves[:, 2] ** 2))}
        power: dict[str, float] = {}
        for heading in np.unique(waves[:, 1]):
            mine = waves[waves[:, 1] == heading]
            response = self.response(mine[:, 0], float(heading))
            squares = 0.5 * (mine[:, 2] ** 2) @ np.abs(response.values) ** 2
            for name, value in zip(response.names, squares, strict=True):
                variance[name] = variance.get(name, 0.0) + float(value)
            for name, per_square in response.power.items():
                power[name] = power.get(name, 0.0) + float(mine[:, 2] ** 2 @ per_square)
        return {name: float(np.sqrt(value)) for name, value in variance.items()}, power


def without_memory(
    case: CaseLike, values: Mapping[str, Any] | None = None
) -> tuple[Case, CaseError | None]:
    """Read a case for the frequency domain, which needs no memory fit and no kernel.

    Parameters
    ----------
    case : Case, Scene or path
    values : dict, optional
        By dotted key, as in `read_case`.

    Returns
    -------
    case : Case
        As it is, or with `hydro.radiation` "none" where its database lacks what its radiation in
        the time domain needs.
    missing : CaseError or None
        What is missing for a run.

    Raises
    ------
    CaseError
        The case cannot be used for another reason.
    """
    try:
        return read_case(case, values), None
    except CaseError as error:
        if not any(words in str(error) for words in MISSING_MEMORY):
            raise
        return read_case(case, {**(values or {}), "hydro.radiation": "none"}), error


def _power_factor(omega: Array, k: float, c: float, tau: float) -> Array:
    """Re[(k + iw c) e^{-iw tau} conj(iw)]: twice the mean power over |s|^2."""
    return omega**2 * c * np.cos(omega * tau) - omega * k * np.sin(omega * tau)


def _covered_heading(db: HydroDatabase, heading: float) -> float:
    low, high = db.heading[0], db.heading[-1]
    turned = heading - 2.0 * np.pi * np.floor((heading - low + 1e-9) / (2.0 * np.pi))
    if turned > high + 1e-9:
        raise DatabaseError(
            f"heading {np.degrees(heading):g} deg is outside the headings of the database, "
            f"{np.degrees(low):g} to {np.degrees(high):g} deg"
        )
    return float(np.clip(turned, low, high))


def _unit(name: str) -> str:
    last = name.rpartition("/")[2]
    if last.startswith("reaction_force"):
        return "N/m"
    if last.startswith("reaction_moment"):
        return "N m/m"
    angle = last.startswith("angle") or last in ("roll", "pitch", "yaw")
    return "rad/m" if angle else "m/m"
