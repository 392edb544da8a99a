"""All that the response of a linearised case in its own sea is made of, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import null_space

from hydrodae.linear.model import LinearModel
from hydrodae.linear.response import power_factor
from hydrodae.linear.sea import wave_components
from hydrodae.support.arrays import Array, Complex


@dataclass(frozen=True)
class SeaSystem:
    """Linear system of a case at the frequency of each component of its sea.

        Z xi - G^T lambda = F,    G xi = 0,    y = Y xi + L lambda

    Attributes
    ----------
    arrays : dict
        "amplitude" (nw,) [m]; "stiffness" Z (nw, n, n); "force" F (nw, n) per metre of amplitude;
        "constraints" G (m, n); "by_xi" Y (nc, n) and "by_lambda" L (nc, m) of the channels;
        "damper_map" (nd, n), "damper_power" (nd, nw): twice the mean power over the square of
        the damper's coordinate; "one" (1, nw).
    channels : tuple of str
        Coordinates, joints and reactions, as in `Response`.
    dampers : tuple of str
        Names of the forces; a rotary take-off has three.
    """

    arrays: dict[str, Array | Complex]
    channels: tuple[str, ...]
    dampers: tuple[str, ...]


def sea_system(model: LinearModel) -> SeaSystem:
    """Evaluate a linearised case in the waves of its case.

    Raises
    ------
    CaseError
        The case has no waves.
    DatabaseError
        A wave is outside the database.
    """
    waves = wave_components(model.case)
    w, channels = waves[:, 0], model.channels
    force = np.zeros((len(waves), len(model.coordinates)), dtype=complex)
    for heading in np.unique(waves[:, 1]):
        mine = waves[:, 1] == heading
        force[mine] = model.excitation(w[mine], float(heading))
    dampers, rows, power = _dampers(model, w)
    return SeaSystem(
        {
            "amplitude": waves[:, 2],
            "stiffness": model.dynamic_stiffness_at(w),
            "force": force,
            "constraints": model.constraints.reshape(-1, len(model.coordinates)),
            "by_xi": channels.by_xi,
            "by_lambda": channels.by_lambda,
            "damper_map": rows,
            "damper_power": power,
            "one": np.ones((1, len(waves))),
        },
        channels.names,
        dampers,
    )


def _dampers(model: LinearModel, w: Array) -> tuple[tuple[str, ...], Array, Array]:
    """Names, rows (nd, n) and factors (nd, nw) of the dampers along joints and the rotary ones."""
    names, rows, power = [], [], []
    for damper in model.dampers:
        names.append(damper.name)
        rows.append(damper.row)
        power.append(power_factor(w, damper.stiffness, damper.damping, damper.delay))
    for each in model.rotary:
        names += [each.name] * 3
        rows += list(each.map)
        power += list(np.outer(each.damping, w**2))
    n = len(model.coordinates)
    return tuple(names), np.reshape(rows, (-1, n)), np.reshape(power, (-1, w.size))


@dataclass(frozen=True)
class Solved:
    """Solution of a `SeaSystem`, and of the linear systems that its derivatives need.

    Attributes
    ----------
    xi : (nw, n) complex array
    multipliers : (nw, m) complex array
    """

    system: SeaSystem
    xi: Complex
    multipliers: Complex
    _free: Array
    _inverse: Array  # of G, (n, m)

    @classmethod
    def of(cls, system: SeaSystem) -> Solved:
        """Solve a system."""
        a = system.arrays
        constraints = np.asarray(a["constraints"].real)
        n = constraints.shape[1]
        free: Array = (
            np.asarray(null_space(constraints), dtype=float) if len(constraints) else np.eye(n)
        )
        empty = np.zeros((len(a["force"]), n), dtype=complex)
        zero = np.zeros((len(a["force"]), len(constraints)), dtype=complex)
        inverse = np.asarray(np.linalg.pinv(constraints), dtype=float)
        blank = cls(system, empty, zero, free, inverse)
        xi, multipliers = blank.solve(a["force"], zero)
        return cls(system, xi, multipliers, free, inverse)

    def solve(self, load: Array | Complex, gap: Complex) -> tuple[Complex, Complex]:
        """Solve Z x - G^T l = load, G x = gap; arrays (nw, n) and (nw, m)."""
        z, free = self.system.arrays["stiffness"], self._free
        x = gap @ self._inverse.T
        rest = (load - _times(z, x)) @ free
        x = x + np.linalg.solve(free.T @ z @ free, rest[:, :, None])[:, :, 0] @ free.T
        return x, (_times(z, x) - load) @ self._inverse

    def derivative(self, d: dict[str, Array | Complex]) -> tuple[Complex, Complex]:
        """Derivatives of xi and lambda from those of the arrays.

        Z dxi - G^T dlambda = dF - dZ xi + dG^T lambda,    G dxi = -dG xi
        """
        load = d["force"] - _times(d["stiffness"], self.xi) + self.multipliers @ d["constraints"]
        return self.solve(load, -self.xi @ d["constraints"].T)


def _times(matrices: Array | Complex, vectors: Complex) -> Complex:
    return np.asarray(np.einsum("wij,wj->wi", matrices, vectors))
