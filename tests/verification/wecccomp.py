"""The arm of cases/wecccomp as one equation for its angle, with the links' masses.

With q the angle of the arm about A (positive turns z into x), every point and angle is a function
of q, and the equation of motion is the projection of all loads on the one motion that the loop
leaves:

    M(q) q'' + h(q) q'^2 = Q(q, q', z, t),      z' = p z + B U,  U = j(q) q'
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from hydrodae.hdb.database import HydroDatabase

Array = np.ndarray
LINK = 1e-4  # kg, kg m2


class Arm:
    """The device in a sea, under a damper.

    Parameters
    ----------
    model : path
        model.json of the reference data.
    database : HydroDatabase
        With the fit "planar".
    waves : (n, 4) array
        Components: frequency, heading 0, amplitude, phase.
    force : (n, 3) complex array
        Loads of the waves on surge, heave, pitch of the float per metre.
    ramp, damping : float
        s, N s/m.
    """

    def __init__(
        self,
        model: Path,
        database: HydroDatabase,
        waves: Array,
        force: Array,
        ramp: float,
        damping: float,
    ) -> None:
        told: dict[str, Any] = json.loads(model.read_text())
        plane = [0, 2]
        self.at = {name: np.array(point)[plane] for name, point in told["points"].items()}
        bodies = told["bodies"]
        self.masses = [bodies["float"]["mass"], bodies["arm"]["mass"], LINK]
        self.points = [
            np.array(told["bem_cg"])[plane],
            np.array(bodies["arm"]["cg"])[plane],
            self.at["C"],
        ]
        self.inertia = bodies["float"]["Iyy"] + bodies["arm"]["Iyy"]
        self.gravity, self.lift = told["g"], told["rho"] * told["g"] * told["displaced_volume"]
        self.buoyancy = np.array(told["cb"])[plane]
        hydrostatic = np.array(told["K_hydrostatic"])[np.ix_([2, 4], [2, 4])]
        self.stiffness = hydrostatic
        self.memory = database.memory["planar"]
        self.drag = bodies["float"]["linear_damping_55"]
        self.waves, self.force, self.ramp, self.damping = waves, force, ramp, damping

    def point(self, k: int, q: float) -> tuple[Array, Array, Array]:
        """A point of the arm and its first two derivatives by q."""
        x, z = self.points[k] - self.at["A"]
        c, s = np.cos(q), np.sin(q)
        r = np.array([c * x + s * z, -s * x + c * z])
        first = np.array([-s * x + c * z, -c * x - s * z])
        return self.at["A"] + r, first, -r

    def slide(self, q: float) -> tuple[float, float, float, float]:
        """Length of BC, its derivative, and the first two of the angle of BC."""
        c, first, second = self.point(2, q)
        d = c - self.at["B"]
        length = float(np.hypot(*d))
        along, across = d @ first, d[0] * first[1] - d[1] * first[0]
        curl = d[0] * second[1] - d[1] * second[0]
        turn = curl / length**2 - 2.0 * across * along / length**4
        return length, float(along) / length, across / length**2, turn

    def inertias(self, q: float) -> tuple[float, float]:
        """M and h."""
        mass, centrifugal = self.inertia, 0.0
        for k, m in enumerate(self.masses):
            _, first, second = self.point(k, q)
            mass += m * first @ first
            centrifugal += m * first @ second
        _, _, turn, bend = self.slide(q)
        mass += 2.0 * LINK * turn**2
        centrifugal += 2.0 * LINK * turn * bend
        _, first, second = self.point(0, q)
        j, j1, added = np.append(first, 1.0), np.append(second, 0.0), self.memory.added_mass_inf
        return mass + j @ added @ j, centrifugal + j @ added @ j1

    def load(self, t: float, q: float, rate: float, memory: Array) -> float:
        """Q."""
        total = -self.drag * rate
        for k, m in enumerate(self.masses):
            total -= m * self.gravity * self.point(k, q)[1][1]
        place, first, _ = self.point(0, q)
        j, rise = np.append(first, 1.0), place[1] - self.points[0][1]
        arm = self.buoyancy[0] - self.points[0][0]
        water = np.array([0.0, self.lift, -arm * self.lift])
        water[1:] -= self.stiffness @ [rise, q]
        water = water - (self.memory.output_matrix @ memory).real
        if self.ramp > 0.0 and t > 0.0:
            x = min(t / self.ramp, 1.0)
            growth = x**4 * (35.0 - 84.0 * x + 70.0 * x**2 - 20.0 * x**3)
            swing = self.waves[:, 2] * np.exp(1j * (self.waves[:, 0] * t + self.waves[:, 3]))
            water = water + growth * (swing @ self.force).real
        slope = self.slide(q)[1]
        pto = np.clip(-self.damping * slope * rate, -60.0, 60.0)
        return float(total + water @ j + pto * slope)

    def run(self, times: Array) -> tuple[Array, Array]:
        """Stroke [m] and its rate [m/s] from the equilibrium on."""
        size = self.memory.poles.size

        def rates(t: float, y: Array) -> Array:
            q, rate = y[0].real, y[1].real
            mass, centrifugal = self.inertias(q)
            moved = np.append(self.point(0, q)[1], 1.0) * rate
            push = self.load(t, q, rate, y[2:]) - centrifugal * rate**2
            memory = self.memory.poles * y[2:] + self.memory.input_matrix @ moved
            return np.concatenate([[rate, push / mass], memory])

        rest = brentq(lambda q: self.load(0.0, q, 0.0, np.zeros(size)), -0.2, 0.2, xtol=1e-14)
        start = np.concatenate([[rest, 0.0], np.zeros(size)]).astype(complex)
        found = solve_ivp(
            rates, times[[0, -1]], start, "DOP853", t_eval=times, rtol=1e-10, atol=1e-12
        )
        slides = [self.slide(q) for q in found.y[0].real]
        stroke = np.array([s[0] for s in slides]) - self.slide(0.0)[0]
        return stroke, np.array([s[1] for s in slides]) * found.y[1].real
