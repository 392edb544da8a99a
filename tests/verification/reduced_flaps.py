"""The two F3OF flaps in two angles: the kernel's physics, derived and integrated apart from it.

A flap turns about its hinge, the centre of gravity a distance l above it. In axes carried by the
flap its velocity is U = S theta' with the constant S = (l, 0, 1), so that added mass, Kirchhoff's
terms and memory reduce to constant matrices:

    (J + S^T A_inf S) theta'' + S^T y(z) + dV/dtheta = 0,     z' = A_r z + B_r S theta',   y = C_r z

with V of weight, lift and linear hydrostatics in the finite displacement
xi = (l sin theta, l (cos theta - 1), theta).
"""

from __future__ import annotations

from dataclasses import dataclass

import h5py
import numpy as np
from scipy.integrate import solve_ivp

from hydrodae.support.arrays import Array

MASS, INERTIA, LEVER, GRAVITY = 179_250.0, 1.3e6, 3.5, 9.81
PLANAR = ("surge", "heave", "pitch")
FLAPS = ("flap1", "flap2")


@dataclass
class ReducedFlaps:
    """Constant matrices of the two-angle model; m memory states."""

    inertia: Array
    """(2, 2) kg m2, with added mass."""
    state_matrix: Array
    """(m, m) 1/s."""
    input_matrix: Array
    """(m, 2) of theta'."""
    output_matrix: Array
    """(2, m) N m."""
    hydrostatics: list[tuple[Array, Array]]
    """Per flap: constant load (3,) and stiffness (3, 3) of surge, heave, pitch."""

    def moment(self, flap: int, theta: float) -> float:
        """Return -dV/dtheta of weight and hydrostatics [N m]."""
        constant, stiffness = self.hydrostatics[flap]
        xi = np.array([LEVER * np.sin(theta), LEVER * (np.cos(theta) - 1.0), theta])
        slope = np.array([LEVER * np.cos(theta), -LEVER * np.sin(theta), 1.0])
        weight = np.array([0.0, -MASS * GRAVITY, 0.0])
        return float(slope @ (weight + constant - stiffness @ xi))

    def decay(self, theta0: tuple[float, float], time: Array, rtol: float = 1e-11) -> Array:
        """Return the two angles (nt, 2) after a release at rest."""
        m = len(self.state_matrix)
        inverse = np.linalg.inv(self.inertia)

        def rate(_t: float, y: Array) -> Array:
            theta, omega, z = y[:2], y[2:4], y[4:]
            load = np.array([self.moment(0, theta[0]), self.moment(1, theta[1])])
            load -= self.output_matrix @ z
            return np.concatenate(
                [omega, inverse @ load, self.state_matrix @ z + self.input_matrix @ omega]
            )

        start = np.concatenate([theta0, np.zeros(2 + m)])
        solution = solve_ivp(
            rate, (0.0, time[-1]), start, method="DOP853", t_eval=time, rtol=rtol, atol=1e-13
        )
        assert solution.success, solution.message
        return np.asarray(solution.y[:2].T)


def read(path: str, fit: str) -> ReducedFlaps:
    """Build the model from one exponential fit of a hydro.h5 by its documented layout."""
    with h5py.File(path, "r") as file:
        group = file["memory"][fit]
        labels = [x.decode() for x in group["inputs"][:]]
        outputs = [x.decode() for x in group["outputs"][:]]
        columns = [labels.index(f"{flap}.{dof}") for flap in FLAPS for dof in PLANAR]
        rows = [outputs.index(f"{flap}.{dof}") for flap in FLAPS for dof in PLANAR]
        poles, b = group["poles"][:], group["input_matrix"][:][:, columns]
        c = group["output_matrix"][:][rows]
        added_mass = group["added_mass_inf"][:][np.ix_(rows, columns)]
        lift = float(file.attrs["rho"] * file.attrs["gravity"])
        hydrostatics = []
        for flap in FLAPS:
            body = file["bodies"][flap]
            arm = body.attrs["center_of_buoyancy"] - body.attrs["reference_point"]
            force = lift * body.attrs["displaced_volume"]
            pick = np.ix_([0, 2, 4], [0, 2, 4])
            stiffness = body["hydrostatic_stiffness"][:][pick]
            hydrostatics.append((np.array([0.0, force, -arm[0] * force]), stiffness))
    directions = np.kron(np.eye(2), np.array([[LEVER], [0.0], [1.0]]))  # S for both flaps, (6, 2)
    # z = x + i y: x' = a x - b y + Re(B) u, y' = b x + a y + Im(B) u, f = Re C x - Im C y
    state_matrix = np.block(
        [[np.diag(poles.real), -np.diag(poles.imag)], [np.diag(poles.imag), np.diag(poles.real)]]
    )
    return ReducedFlaps(
        inertia=(INERTIA + MASS * LEVER**2) * np.eye(2) + directions.T @ added_mass @ directions,
        state_matrix=state_matrix,
        input_matrix=np.vstack([b.real, b.imag]) @ directions,
        output_matrix=directions.T @ np.hstack([c.real, -c.imag]),
        hydrostatics=hydrostatics,
    )
