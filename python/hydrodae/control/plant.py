"""The linear model of a device of one degree of freedom, along one joint.

With the joint coordinate s about its equilibrium, y = (s, s', memory states):

    y' = S y + b (u + e)      u: load of the controller, e: load of the waves, both along s [N, N m]

so that m s'' + (radiation and other loads) = u + e. Sampled at a period T with u held and e
straight in between: y(k+1) = F y(k) + G u(k) + E0 e(k) + E1 e(k+1).
"""

from __future__ import annotations

import copy
from collections.abc import Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import expm

from hydrodae.case.case import CaseLike
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.hdb.memory import ExponentialMemory
from hydrodae.linear import LinearModel
from hydrodae.linear.states import state_matrix
from hydrodae.support.arrays import Array, Complex


class Plant:
    """A case, linearised about its equilibrium, seen along a joint.

    Parameters
    ----------
    case : Case or path
        Its mechanism must leave one free motion, and its radiation memory must be fitted.
    joint : str
        Name of a joint with one coordinate, which moves.

    Raises
    ------
    CaseError
        The case has several free motions, or the joint does not move with its one.
    """

    def __init__(self, case: CaseLike, joint: str) -> None:
        self.model = LinearModel(case)
        self.joint = joint
        if self.model.free.shape[1] != 1:
            raise CaseError(
                f"control along a joint needs a case of one free motion; this one has "
                f"{self.model.free.shape[1]}"
            )
        row = self.model.motion_row(joint)
        #: s per unit of the free motion, whose basis has any scale
        self._lever = float((row @ self.model.free).item())
        if abs(self._lever) < 1e-12 * float(np.abs(row).max(initial=0.0)) or self._lever == 0.0:
            raise CaseError(f"joint {joint!r} does not move with the free motion of the case")
        #: whether the coordinate is an angle
        self.turns = False
        #: s in the equilibrium, which is where the linear model has its zero [m, rad]
        self.rest = self._find_rest()

    def _find_rest(self) -> float:
        from hydrodae.simulation import Simulation

        case = self.model.case
        silent = dict.fromkeys(case.scene.python_controllers, lambda *_: 0.0)  # no step is made
        run = Simulation(case, set={"solver.start": "equilibrium"}, controllers=silent)
        for kind, turns in (("displacement", False), ("angle", True)):
            name = f"joints/{self.joint}/{kind}"
            if name in run.channels:
                self.turns = turns
                return float(run.read(name))
        raise CaseError(f"joint {self.joint!r} has no coordinate")

    @cached_property
    def loads(self) -> dict[str, str]:
        """Name and type of every force of the case."""
        return {f["name"]: f["type"] for f in case_tables(self.model.case).get("force", [])}

    @property
    def take_offs(self) -> tuple[str, ...]:
        """Take-offs along joints, all of which move with the one free motion of the case.

        Their types begin with ``pto_``, but for `pto_rotary`, which acts between two bodies.
        """
        forces = case_tables(self.model.case).get("force", [])
        return tuple(f["name"] for f in forces if f["type"].startswith("pto_") and "joint" in f)

    def without(self, names: Sequence[str]) -> Plant:
        """Return the same device, in the same pose, without some forces along joints."""
        other = copy.copy(self)
        for name in ("memory", "matrices"):
            other.__dict__.pop(name, None)  # cached properties of the whole device
        other.model = self.model.without_loads(names)
        return other

    @cached_property
    def memory(self) -> ExponentialMemory | None:
        """The fit with the fewest states that covers what moves; None without a database."""
        database = self.model.database
        labels = self.model.hydro_labels
        if database is None or not labels:
            return None
        fits = [fit for fit in database.memory.values() if set(labels) <= set(fit.inputs)]
        if not fits:
            raise CaseError("the database of the case has no memory fit of what moves (hdb fit)")
        return min(fits, key=lambda fit: fit.n_states)

    @cached_property
    def matrices(self) -> tuple[Array, Array]:
        """S (n, n) and b (n,)."""
        scale = self._lever
        if self.memory is None:
            free = self.model.free
            mass = (free.T @ self.model.mass @ free).item()
            damping = (free.T @ self.model.damping @ free).item()
            stiffness = (free.T @ self.model.stiffness @ free).item()
            system = np.array([[0.0, 1.0], [-stiffness / mass, -damping / mass]])
            inertia = mass / scale**2
        else:
            system = state_matrix(self.model, self.memory)
            inertia = self._inertia / scale**2
        # x = s / scale: rows of x, x' times scale, columns of them over scale
        change = np.ones(len(system))
        change[:2] = scale
        entry = np.zeros(len(system))
        entry[1] = 1.0 / inertia
        return system * change[:, None] / change[None, :], entry

    @property
    def _inertia(self) -> float:
        """Inertia of the free motion with the added mass of the fit."""
        free, moves, memory = self.model.free, self.model.hydro_map, self.memory
        assert memory is not None
        columns = [memory.inputs.index(label) for label in self.model.hydro_labels]
        rows = [memory.outputs.index(label) for label in self.model.hydro_labels]
        added = memory.added_mass_inf[np.ix_(rows, columns)]
        return float((free.T @ self.model.mass @ free + moves.T @ added @ moves).item())

    def sampled(self, period: float) -> tuple[Array, Array, Array, Array]:
        """F (n, n), G, E0, E1 (n,) for a sampling period [s]."""
        system, entry = self.matrices
        n = len(system)
        # y, the load, its slope
        whole = np.zeros((n + 2, n + 2))
        whole[:n, :n] = system * period
        whole[:n, n] = entry * period
        whole[n, n + 1] = 1.0
        step = expm(whole)
        held, slope = step[:n, n], step[:n, n + 1]
        return step[:n, :n], held, held - slope, slope

    def impedance(self, omega: ArrayLike) -> Complex:
        """Z(w) = (load along s) / s' without waves, from the tables [N s/m, N m s/rad]."""
        w = np.atleast_1d(np.asarray(omega, dtype=float))
        free = self.model.free
        stiffness = (free.T @ self.model.dynamic_stiffness_at(w) @ free)[:, 0, 0]
        return np.asarray(stiffness / (1j * w) / self._lever**2)

    def excitation(self, omega: ArrayLike, heading: float = 0.0) -> Complex:
        """Load of waves along s per metre of amplitude, phase zero at the origin [N/m, N]."""
        force = self.model.excitation(np.atleast_1d(omega), heading) @ self.model.free
        return np.asarray(force[:, 0] / self._lever)
