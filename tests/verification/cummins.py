"""Linear Cummins model in reduced coordinates, solved without cutting the radiation memory.

    (M + A_inf) q'' + int_0^t K(t - s) q'(s) ds + C q = 0,   q(0) = q0, q'(0) = 0

In the Laplace domain, with the stored added mass A and radiation damping B,

    V(s) = L{q'} = -Z(s)^-1 C q0 / s,   Z(s) = s M + R(s) + C / s,   R(iw) = B(w) + iw A(w),   q =
    q0 + L^-1{V / s},

inverted on the line s = sigma + iw (Bromwich). No kernel, no A_inf and no fitted memory enter the
band of the data: A and B are natural cubic splines of the stored points, and R on the line is the
analytic continuation of the local cubic (argument w - i sigma). Beyond the data A tends to A_inf as
w^-2 and B to 0 as w^-3, which the motion of a floating body does not feel. This is the independent
truth for fitted memories and for time-domain runs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

import h5py
import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicSpline, PPoly

from hydrodae.hdb.labels import DOFS
from hydrodae.linear import LinearModel
from hydrodae.support.arrays import Array

ComplexArray = npt.NDArray[np.complex128]


class RadiationData(Protocol):
    """What the model needs of a hydrodynamic database (`HydroDatabase` has it)."""

    @property
    def coordinates(self) -> Sequence[str]: ...
    @property
    def omega(self) -> Array: ...
    @property
    def added_mass(self) -> Array: ...
    @property
    def radiation_damping(self) -> Array: ...
    @property
    def added_mass_inf(self) -> Array: ...


@dataclass
class Radiation:
    """Stored radiation data in SI; `coordinates` are labels "<body>.<dof>"."""

    coordinates: tuple[str, ...]
    omega: Array
    added_mass: Array
    radiation_damping: Array
    added_mass_inf: Array


@dataclass
class Body:
    """Mass data and buoyancy-only hydrostatics of one body about its centre of gravity."""

    mass: float
    pitch_inertia: float
    center_of_gravity: Array
    displaced_volume: float
    hydrostatic_stiffness: Array
    """(6, 6) SI."""


@dataclass
class CumminsModel:
    """Reduced linear model: T^T (M, A, B, C) T with q the reduced coordinates.

    Shapes: mass, stiffness (m, m); omega (nw,); added_mass, radiation_damping (nw, m, m);
    added_mass_inf (m, m).
    """

    mass: Array
    stiffness: Array
    omega: Array
    added_mass: Array
    radiation_damping: Array
    added_mass_inf: Array
    _splines: tuple[PPoly, PPoly] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Spline A (even in w) and B (even in w, zero at w = 0)."""
        w = self.omega
        mirrored = np.concatenate([-w[::-1], w])
        even = np.concatenate([self.added_mass[::-1], self.added_mass])
        zero = np.zeros((1, *self.added_mass.shape[1:]))
        self._splines = (
            CubicSpline(mirrored, even, bc_type="natural"),
            CubicSpline(np.concatenate([[0.0], w]), np.concatenate([zero, self.radiation_damping])),
        )

    def radiation(self, s: ComplexArray) -> ComplexArray:
        """Return R(s) = B + s A on the line, (ns, m, m), for Im s >= 0."""
        added, damping = self._splines
        last = self.omega[-1]
        result = np.empty((s.size, *self.mass.shape), dtype=complex)
        inside = s.imag < last
        argument = s[inside] / 1j  # w - i sigma
        result[inside] = _continue(damping, argument) + s[inside, None, None] * _continue(
            added, argument
        )
        tail = s[~inside, None, None] / 1j
        a_last, b_last = self.added_mass[-1], self.radiation_damping[-1]
        a_tail = self.added_mass_inf + (a_last - self.added_mass_inf) * (last / tail) ** 2
        result[~inside] = b_last * (last / tail) ** 3 + 1j * tail * a_tail
        return result

    def free_decay(
        self, q0: npt.ArrayLike, time: Array, *, sigma: float | None = None, omega_max: float = 40.0
    ) -> Array:
        """Return q(t), (nt, m), after a release from q0 at rest in still water.

        Parameters
        ----------
        q0
            (m,) initial coordinates [m or rad].
        time
            (nt,) [s].
        sigma
            Real part of the line [1/s]; default 2 / max(time), at most 0.005.
        omega_max
            End of the line [rad/s]; the neglected tail of q is of order q0 (w_resonance /
            omega_max)^2 / pi.
        """
        time = np.asarray(time, dtype=float)
        release = np.asarray(q0, dtype=float)
        line = sigma if sigma is not None else min(0.005, 2.0 / time.max())
        omega, weight = self._quadrature(line, omega_max, time.max())
        result = np.zeros((time.size, release.size))
        for part in np.array_split(np.arange(omega.size), 1 + omega.size // 4000):
            s = np.asarray(line + 1j * omega[part], dtype=complex)
            impedance = (
                s[:, None, None] * self.mass + self.radiation(s) + self.stiffness / s[:, None, None]
            )
            load = np.broadcast_to((self.stiffness @ release)[:, None], (s.size, release.size, 1))
            position = -np.linalg.solve(impedance, load)[..., 0] / s[:, None] ** 2
            result += (
                np.exp(1j * np.outer(time, omega[part])) @ (weight[part, None] * position)
            ).real
        return release + np.exp(line * time)[:, None] * result / np.pi

    def _quadrature(self, line: float, omega_max: float, duration: float) -> tuple[Array, Array]:
        """Gauss-Legendre panels: 3 sigma wide inside the data, 4 radians of w t beyond."""
        last = self.omega[-1]
        fine = np.linspace(0.0, last, 1 + int(np.ceil(last / min(3.0 * line, 4.0 / duration))))
        coarse = np.linspace(
            last, omega_max, 1 + int(np.ceil((omega_max - last) / min(0.5, 4.0 / duration)))
        )
        edges = np.concatenate([fine, coarse[1:]])
        node, weight = np.polynomial.legendre.leggauss(6)
        half = np.diff(edges)[:, None] / 2.0
        return (edges[:-1, None] + half * (1.0 + node)).ravel(), (half * weight).ravel()


def _continue(spline: PPoly, argument: ComplexArray) -> ComplexArray:
    """Evaluate the cubic that holds at Re(argument) at the complex argument."""
    index = np.clip(
        np.searchsorted(spline.x, argument.real, side="right") - 1, 0, spline.x.size - 2
    )
    offset = (argument - spline.x[index])[:, None, None]
    c = spline.c
    value = ((c[0, index] * offset + c[1, index]) * offset + c[2, index]) * offset + c[3, index]
    return np.asarray(value, dtype=complex)


def reduce(
    data: RadiationData,
    bodies: Mapping[str, Body],
    transform: Array,
    labels: Sequence[str],
    lift_stiffness: Array,
    *,
    spring: Array | None = None,
) -> CumminsModel:
    """Project the multibody data on reduced coordinates.

    Parameters
    ----------
    data
        Radiation data about the centres of gravity.
    bodies
        Mass and hydrostatics by body name.
    transform
        (n, m): small motions of the coordinates `labels` per unit of the reduced coordinates.
    labels
        (n,) planar labels "<body>.<dof>".
    lift_stiffness
        (m, m) second-order stiffness of the constant net lift (rho V - m) g at the centres of
        gravity.
    spring
        (m, m) further stiffness.
    """
    index = [list(data.coordinates).index(label) for label in labels]
    pick = np.ix_(index, index)
    mass = np.zeros(len(labels))
    stiffness = np.zeros((len(labels), len(labels)))
    for i, label in enumerate(labels):
        body, dof = label.split(".")
        mass[i] = bodies[body].pitch_inertia if dof == "pitch" else bodies[body].mass
        for j, other in enumerate(labels):
            if other.split(".")[0] == body:
                row, column = DOFS.index(dof), DOFS.index(other.split(".")[1])
                stiffness[i, j] = bodies[body].hydrostatic_stiffness[row, column]
    t = np.asarray(transform, dtype=float)
    total = t.T @ stiffness @ t + lift_stiffness + (0.0 if spring is None else spring)
    return CumminsModel(
        mass=t.T @ np.diag(mass) @ t,
        stiffness=total,
        omega=np.asarray(data.omega, dtype=float),
        added_mass=t.T @ np.asarray(data.added_mass)[:, pick[0], pick[1]] @ t,
        radiation_damping=t.T @ np.asarray(data.radiation_damping)[:, pick[0], pick[1]] @ t,
        added_mass_inf=t.T @ np.asarray(data.added_mass_inf)[pick] @ t,
    )


def of_case(model: LinearModel) -> CumminsModel:
    """Return the model of a case, linearised at its equilibrium, in its free motions."""
    data = model.database
    assert data is not None
    index, moves, free = data.index(model.hydro_labels), model.hydro_map, model.free

    def projected(table: Array) -> Array:
        return np.asarray(moves.T @ table[..., index, :][..., :, index] @ moves)

    return CumminsModel(
        mass=free.T @ model.mass @ free,
        stiffness=free.T @ model.stiffness @ free,
        omega=data.omega,
        added_mass=projected(data.added_mass),
        radiation_damping=projected(data.radiation_damping),
        added_mass_inf=projected(data.added_mass_inf),
    )


def decay_of_case(model: LinearModel, start: npt.ArrayLike, time: Array) -> Array:
    """Return the coordinates (nt, n) after a release at rest, without damping but the waves'."""
    begin = np.linalg.lstsq(model.free, np.asarray(start, dtype=float), rcond=None)[0]
    return np.asarray(of_case(model).free_decay(begin, time) @ model.free.T)


# --- the F3OF device

RHO, GRAVITY = 1025.0, 9.81
HINGE_Z, PLANAR = -9.0, ("surge", "heave", "pitch")
FLAP_LABELS = tuple(f"{body}.{dof}" for body in ("flap1", "flap2") for dof in PLANAR)
ALL_LABELS = tuple(f"{body}.{dof}" for body in ("base", "flap1", "flap2") for dof in PLANAR)
MASS = {"base": 1_089_825.0, "flap1": 179_250.0, "flap2": 179_250.0}
PITCH_INERTIA = {"base": 76.3e6, "flap1": 1.3e6, "flap2": 1.3e6}


def read_reference(path: Path | str, group: str = "capytaine") -> tuple[Radiation, dict[str, Body]]:
    """Read the statics and one group of the F3OF reference `hdb.h5`."""
    with h5py.File(path, "r") as file:
        labels = tuple(name.decode().replace("_", ".") for name in file["dof_names"][:])
        data = {
            key: file[group][key][:].astype(float)
            for key in ("omega", "added_mass", "radiation_damping", "added_mass_inf")
        }
        statics = {
            key: file["statics"][key][:]
            for key in ("cog", "displaced_volume", "hydrostatic_stiffness")
        }
    bodies = {
        name: Body(
            MASS[name],
            PITCH_INERTIA[name],
            statics["cog"][i],
            float(statics["displaced_volume"][i]),
            statics["hydrostatic_stiffness"][6 * i : 6 * i + 6, 6 * i : 6 * i + 6],
        )
        for i, name in enumerate(("base", "flap1", "flap2"))
    }
    return Radiation(labels, **data), bodies


def f3of_dt3(data: RadiationData, bodies: Mapping[str, Body]) -> CumminsModel:
    """F3OF DT3: base fixed, q = the two flap angles about their hinges [rad]."""
    transform, lift = np.zeros((6, 2)), np.zeros((2, 2))
    for i, name in enumerate(("flap1", "flap2")):
        body = bodies[name]
        lever = body.center_of_gravity[2] - HINGE_Z
        transform[3 * i : 3 * i + 3, i] = lever, 0.0, 1.0
        lift[i, i] = _net_lift(body) * lever
    return reduce(data, bodies, transform, FLAP_LABELS, lift)


def f3of_dt1(data: RadiationData, bodies: Mapping[str, Body], spring: float = 1e5) -> CumminsModel:
    """F3OF DT1: flaps locked to the base, q = surge, heave, pitch of the base [m, rad]."""
    transform, lift = np.zeros((9, 3)), np.zeros((3, 3))
    origin = bodies["base"].center_of_gravity
    for i, name in enumerate(("base", "flap1", "flap2")):
        x, _, z = bodies[name].center_of_gravity - origin
        transform[3 * i : 3 * i + 3] = [[1.0, 0.0, z], [0.0, 1.0, -x], [0.0, 0.0, 1.0]]
        lift[2, 2] += _net_lift(bodies[name]) * z
    return reduce(data, bodies, transform, ALL_LABELS, lift, spring=np.diag([spring, 0.0, 0.0]))


def _net_lift(body: Body) -> float:
    """Return (rho V - m) g [N]."""
    return (RHO * body.displaced_volume - body.mass) * GRAVITY


def nrms(series: Array, reference: Array) -> float:
    """Return rms(series - reference) / rms(reference)."""
    return float(np.sqrt(np.mean((series - reference) ** 2) / np.mean(reference**2)))
