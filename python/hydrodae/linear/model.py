"""The linear model of a case about its static equilibrium."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import null_space

from hydrodae import _core
from hydrodae.case.case import CaseLike, read_case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.poses import blended
from hydrodae.linear.air import air_of, open_outlets_at_rest
from hydrodae.linear.kinematics import water_motion
from hydrodae.linear.modes import Mode, find_modes
from hydrodae.linear.reading import without_memory
from hydrodae.linear.response import (
    Channels,
    Damper,
    Response,
    bristles,
    channels_of,
    make_response,
)
from hydrodae.linear.rotary import RotaryTakeOff, rotary_take_offs
from hydrodae.linear.sea import in_waves, wave_components
from hydrodae.linear.tables import WaterTables
from hydrodae.support.arrays import Array, Complex


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
        self.supports = dict(zip(model["supports"], model["support"], strict=True))
        self.notes: list[str] = model["notes"]
        self._model = model
        self.air, shut = air_of(self, case_tables(self.case))
        self.notes = [*self.notes, *shut, *open_outlets_at_rest(self.air)]
        # A basis of the motions that the constraints leave, coordinates in their own units.
        n = len(self.coordinates)
        self._free: Array = null_space(self.constraints) if len(self.constraints) else np.eye(n)
        self._constraints_inverse: Array = np.linalg.pinv(self.constraints.T)

    @classmethod
    def of(
        cls, case: CaseLike | LinearModel, values: Mapping[str, Any] | None = None
    ) -> LinearModel:
        """Return a model as it is, or that of a case with `values` by dotted key replaced."""
        if not isinstance(case, LinearModel):
            return cls(read_case(case, values))
        if values:
            raise TypeError("`set` needs a case: the model was linearised without it")
        return case

    @cached_property
    def database(self) -> HydroDatabase | None:
        """The hydrodynamic database of the case."""
        if self._given_database is not None:
            return self._given_database
        path = self.case.scene.database_path
        return self._at_pose(HydroDatabase.read(path)) if path else None

    def _at_pose(self, database: HydroDatabase) -> HydroDatabase:
        """Return the database with tables over poses blended at the equilibrium."""
        for table in case_tables(self.case).get("pose_table", []):
            body, turns = table["body"], table["coordinate"] != "heave"
            values = np.radians(table["values_deg"]) if turns else np.array(table["values"])
            place = (self.rotations if turns else self.offsets)[body]
            pose = float(place[("roll", "pitch", "yaw").index(table["coordinate"]) if turns else 2])
            paths = (self.case.directory / name for name in table["databases"])
            sources = [HydroDatabase.read(path) for path in paths]
            wet = next(b["hydro"] for b in case_tables(self.case)["body"] if b["name"] == body)
            database = blended(database, wet, values, sources, pose)
        return database

    def with_database(self, database: HydroDatabase) -> LinearModel:
        """Return the same linearised case with the tables of another database of the same bodies.

        Hydrostatics and the equilibrium stay those of the case.
        """
        other = copy.copy(self)
        for name in ("database", "tables"):
            other.__dict__.pop(name, None)  # cached properties of the old tables
        other._given_database = database
        return other

    def sharing_tables_of(self, other: LinearModel) -> LinearModel:
        """Return this model, which reads nothing again that the other one has of its database."""
        if self.case.scene.database_path != other.case.scene.database_path:
            return self
        shared = self.with_database(other.database) if other.database is not None else self
        if shared.tables is not None and other.tables is not None:
            shared.tables.share(other.tables)
        return shared

    def without_loads(self, names: Sequence[str]) -> LinearModel:
        """Return the same linearised case, in the same pose, without some forces along joints.

        Their springs, dampers and states are gone; what they hold the device with at rest stays.
        """
        m = self._model
        states = [k for k, owner in enumerate(m["state_of"]) if owner in names]
        other = self._with_laws_changed(names, states)
        for d in self.dampers:
            if d.name in names:
                square = np.outer(d.row, d.row)
                other.stiffness = other.stiffness - d.stiffness * square
                if d.delay <= 0.0:  # else C does not hold it
                    other.damping = other.damping - d.damping * square
        return other

    def with_law_slopes_taken_out(self, names: Sequence[str]) -> LinearModel:
        """Return the same linearised case without the dampers, and bristles, of some forces.

        Parameters
        ----------
        names : sequence of str
            Of forces along joints.
        """
        other = self._with_laws_changed(names, bristles(self._model, names))
        for d in self.dampers:
            if d.name in names:
                other.damping = other.damping - d.damping * np.outer(d.row, d.row)
        return other

    def with_outlets(self, slopes: Mapping[str, float]) -> LinearModel:
        """Return the same linearised case with other slopes of outlets of chambers.

        Parameters
        ----------
        slopes : mapping from str
            Mass flow over drop of pressure [kg/(s Pa)] by the name of the outlet.
        """
        other = copy.copy(self)
        other.air = [air.with_slopes(slopes) for air in self.air]
        for air in other.air:
            other._model = air.replaced(other._model)
        return other

    def drops(self, w: Array, xi: Complex) -> dict[str, Complex]:
        """Drop of pressure (nw,) [Pa] over each outlet, from the motion (nw, n_u)."""
        out: dict[str, Complex] = {}
        for air in self.air:
            each = air.pressures(self._model, w, xi) @ air.ways.T
            out |= {one.name: each[:, k] for k, one in enumerate(air.outlets)}
        return out

    def _with_laws_changed(self, names: Sequence[str], states: Sequence[int]) -> LinearModel:
        """Return a copy that does not list some forces as dampers, nor has some states."""
        other = copy.copy(self)
        m = other._model = dict(self._model)
        m["load_by_state"] = np.delete(m["load_by_state"], states, axis=1)
        m["state_by_state"] = np.delete(np.delete(m["state_by_state"], states, 0), states, 1)
        for key in ("state_by_xi", "state_by_rate"):
            m[key] = np.delete(m[key], states, axis=0)
        m["state_of"] = [owner for k, owner in enumerate(m["state_of"]) if k not in states]
        keep = [k for k, name in enumerate(m["dampers"]) if name not in names]
        for key in ("dampers", "damper_damping", "damper_stiffness", "damper_delay"):
            m[key] = [m[key][k] for k in keep]
        m["damper_map"] = m["damper_map"][keep]
        return other

    @property
    def owners_of_states(self) -> tuple[str, ...]:
        """Names of the forces that have states, one for each state."""
        return tuple(self._model["state_of"])

    @property
    def water_points(self) -> list[Array]:
        """Points of the Morison elements that move, one a segment, world axes [m]."""
        return [np.asarray(point, dtype=float) for point in self._model["water_points"]]

    @property
    def water(self) -> tuple[float, float]:
        """Depth [m], may be infinite, and gravity [m/s2]."""
        return float(self._model["water_depth"]), float(self._model["gravity"])

    def motion_row(self, joint: str, coordinate: str | None = None) -> Array:
        """Row (n_u,) of a joint coordinate over xi; without `coordinate` its only one."""
        head = f"joints/{joint}/{coordinate or ''}"
        names = list(self._model["motions"])
        found = [k for k, n in enumerate(names) if n == head or (not coordinate and head in n)]
        if len(found) != 1:
            wanted = f"{coordinate!r}" if coordinate else "that is its only one"
            known = ", ".join(name.removeprefix("joints/") for name in names)
            raise CaseError(
                f"joint {joint!r} has no coordinate {wanted}{_core.suggestion(head, names)}; "
                f"there are: {known}"
            )
        return np.asarray(self._model["motion_map"][found[0]])

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

    @property
    def hydro_places(self) -> tuple[Array, Array]:
        """Mean yaw (m,) [rad] and place (m, 3) [m] of the body of each of `hydro_labels`."""
        m = self._model
        points = np.asarray(m["hydro_points"], dtype=float)
        return np.asarray(m["hydro_yaws"], dtype=float), points.reshape(-1, 3)

    @cached_property
    def tables(self) -> WaterTables | None:
        """What the database shows of the coordinates that move; None where none of them does."""
        if self.database is None or not self._model["hydro_labels"]:
            return None
        hydro = case_tables(self.case).get("hydro", {})
        return WaterTables(self.database, self._model, follows_yaw=hydro.get("axes") == "yaw")

    @property
    def dampers(self) -> list[Damper]:
        """Forces with damping along a joint coordinate."""
        m = self._model
        keys = ("dampers", "damper_stiffness", "damper_damping", "damper_delay", "damper_map")
        return [Damper(*values) for values in zip(*(m[key] for key in keys), strict=True)]

    @property
    def channels(self) -> Channels:
        """How the channels of a response follow from the motion and the multipliers."""
        return channels_of(self._model)

    @cached_property
    def rotary(self) -> list[RotaryTakeOff]:
        """Take-offs on the relative rotations of two bodies."""
        return rotary_take_offs(self, case_tables(self.case))

    def added(self, omega: Array) -> tuple[Array, Array]:
        """T^T A T and T^T B T at frequencies inside the database; (nw, n_u, n_u) each."""
        if self.tables is None:
            shape = (omega.size, len(self.coordinates), len(self.coordinates))
            return np.zeros(shape), np.zeros(shape)
        return self.tables.added(omega)

    def continued(self, omega: complex) -> tuple[Complex, Complex]:
        """T^T A T and T^T B T, (n_u, n_u), near the real axis, also outside the database."""
        if self.tables is None:
            shape = (len(self.coordinates), len(self.coordinates))
            return np.zeros(shape, dtype=complex), np.zeros(shape, dtype=complex)
        return self.tables.continued(omega)

    def late(self, omega: Array) -> Complex:
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
        for d in self.dampers:
            if d.delay > 0.0:
                late = np.exp(-1j * omega * d.delay)
                factor = (d.stiffness + 1j * omega * d.damping) * late - d.stiffness
                out += factor[:, None, None] * np.outer(d.row, d.row)
        return out

    def excitation(self, omega: ArrayLike, heading: float) -> Complex:
        """T^T F, loads (nw, n_u) per metre of wave amplitude, phase zero at the origin.

        From the database, without the phase at each body's reference point: natural cubic splines
        in frequency and heading, at the heading relative to the mean yaw of the body. The phase
        where the body stands is then put in. Of the Morison elements: inertia, and the slope that a
        current gives to the drag.

        Raises
        ------
        DatabaseError
            A frequency or the heading is outside the database, or nothing in the case feels waves.
        """
        w = np.asarray(omega, dtype=float)
        if self.database is not None and self.database.heading.size == 0:
            raise DatabaseError(
                f"the database of the case, {self.database.source or 'no source stated'}, holds no "
                f"excitation, because its source lacks it: import one with the forces of waves "
                f"(.3 of WAMIT, ExcitationForce.tec of Nemoh); natural modes need no excitation"
            ).about("missing", "excitation")
        if self.database is None and not self._model["water_points"]:
            raise DatabaseError(
                "the case has neither a hydrodynamic database nor Morison elements"
            ).about("missing", "database")
        force = self._morison_excitation(w, heading)
        return force if self.tables is None else force + self.tables.excitation(w, heading)

    def _morison_excitation(self, w: Array, heading: float) -> Complex:
        """Loads (nw, n_u) of the water on the Morison elements."""
        m = self._model
        if not m["water_points"]:
            return np.zeros((w.size, len(self.coordinates)), dtype=complex)
        points = np.array(m["water_points"])
        water = water_motion(w, heading, points, m["water_depth"], m["gravity"])
        return np.asarray(np.einsum("wpc,puc->wu", water, np.array(m["water_loads"])))

    def dynamic_stiffness_at(self, w: Array) -> Complex:
        """Z(w) = -w^2 (M + A) + iw (C + B) + K of all coordinates, (nw, n_u, n_u)."""
        (added, radiation), iw = self.added(w), 1j * w[:, None, None]
        z = -(w**2)[:, None, None] * (self.mass + added) + iw * (self.damping + radiation)
        return np.asarray(z + self.stiffness + self.late(w))

    def response(
        self,
        omega: ArrayLike,
        heading: float = 0.0,
        *,
        damping: Array | None = None,
        force: Complex | None = None,
    ) -> Response:
        """Response to waves of unit amplitude.

        Parameters
        ----------
        omega : (nw,) array
            Frequencies [rad/s].
        heading : float
            Direction of travel [rad].
        damping : (n_u, n_u) array, optional
            Damping beside that of the model.
        force : (nw, n_u) complex array, optional
            Loads beside those of the waves, per metre of their amplitude.

        Raises
        ------
        DatabaseError
            Outside the database.
        """
        w = np.atleast_1d(np.asarray(omega, dtype=float))
        load = self.excitation(w, heading)
        if force is not None:
            load = load + force
        free, z = self._free, self.dynamic_stiffness_at(w)
        if damping is not None:
            z = z + 1j * w[:, None, None] * damping
        xi = np.linalg.solve(free.T @ z @ free, (load @ free)[:, :, None])[:, :, 0] @ free.T
        # G^T lambda = Z xi - F has a solution: the constraints left are independent.
        rest = (z @ xi[:, :, None])[:, :, 0] - load
        multipliers = rest @ self._constraints_inverse.T
        found = make_response(
            self._model, w, heading, xi, multipliers, force=load, radiation=self.added(w)[1]
        )
        found.power.update({each.name: each.power(w, xi) for each in self.rotary})
        for air in self.air:
            found.power.update(air.powers(self._model, w, xi))
            found = found.with_channels(air.channels(self._model, w, xi))
        return found

    def modes(self) -> list[Mode]:
        """Natural modes of the constrained system, longest period first.

        Each frequency is found together with the added mass at that frequency (fixed point). Modes
        without restoring force are left out; those outside the frequencies of the database are
        marked.
        """
        return find_modes(self)

    def dynamic_stiffness(self, omega: complex) -> Complex:
        """Z(w) of the free motions; Z xi = 0 in a damped mode."""
        added, radiation = self.continued(omega)
        z = -(omega**2) * (self.mass + added) + 1j * omega * (self.damping + radiation)
        z = z + self.stiffness + self.late(np.array([omega]))[0]
        return np.asarray(self._free.T @ z @ self._free)

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
        return in_waves(self.response, wave_components(self.case))
