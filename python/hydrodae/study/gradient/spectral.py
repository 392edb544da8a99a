"""Gradients of the motion in a sea by statistical linearisation: its fixed point differentiated.

The equivalents B of the nonlinear loads and the motion xi that they see agree,

    Z(B) xi - G^T lambda = F(B),    G xi = 0,    B = b(u(xi), p)

    Z(B) = Z + iw sum of J^T B J,    F(B) = F + sum of J^T B u_water,    u = u_water - iw J xi

so that their derivatives with respect to a parameter p solve one linear system (implicit function
theorem), dB = b_u du(dB) + b_p, here by GMRES. Arrays are differenced as in the frequency domain;
b along a change of the motion by a difference of fourth order.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.linear.sea import wave_components
from hydrodae.linear.system import SeaSystem, Solved, sea_system
from hydrodae.study.gradient.differences import derivative
from hydrodae.study.gradient.linear import make_form
from hydrodae.study.gradient.parameters import Parameter
from hydrodae.study.gradient.quantity import Found, Quantity
from hydrodae.study.spectral.linearise import nonlinear_loads
from hydrodae.study.spectral.loads import AlongJoint, Load
from hydrodae.study.spectral.solve import equivalents, motion_of, water_velocity
from hydrodae.support.arrays import Array, Complex

Arrays = dict[str, Any]

#: Change of the equivalents that ends their iteration, and of the linear system for their slopes.
TOLERANCE, LINEAR = 1e-11, 1e-12
MOST = 5000
#: Step over what a load sees, along a change of it, and the difference of fourth order.
STEP = 1e-3
NODES, WEIGHTS = (-2.0, -1.0, 1.0, 2.0), (1.0 / 12.0, -2.0 / 3.0, 2.0 / 3.0, -1.0 / 12.0)


def spectral_gradient(case: Case, what: Quantity, parameters: Sequence[Parameter]) -> Found:
    """Value and gradient of a quantity of the motion that `hydrodae.spectral` finds.

    Raises
    ------
    CaseError
        There is no such quantity here, the case cannot be linearised nearby, the equivalents do
        not settle, or they have no derivative.
    """
    model = LinearModel(case)
    point = _FixedPoint.of(model)
    form, unit = make_form(case, point.solved.system, what)
    value = form.value(point.solved)
    mine: list[int] = []
    if what.measure is None:
        chosen = what.take_offs(case)
        mine = [
            k for k, load in enumerate(point.loads) if load.axes is None and load.name in chosen
        ]
        value += point.power(mine)
    slopes, affine, calls = [], [], 1
    for parameter in parameters:

        def at(x: float, parameter: Parameter = parameter) -> Arrays:
            there = LinearModel(case.with_values(parameter.values(x)))
            return point.arrays_of(there.sharing_tables_of(model))

        d, exact, count = derivative(at, parameter.value, point.arrays)
        moved = point.moved(d)
        slopes.append(form.slope(point.solved, moved.arrays) + point.power_slope(moved, mine))
        affine.append(exact)
        calls += count
    return Found(value, np.array(slopes), tuple(affine), calls, unit)


@dataclass(frozen=True)
class _Moved:
    """Derivatives: of the arrays of the whole linear system, of B, and of what the loads see."""

    arrays: Arrays
    factors: list[Array]
    seen: list[Complex]


@dataclass(frozen=True)
class _FixedPoint:
    """Equivalents and motion that agree, and the linear systems of their derivatives.

    Attributes
    ----------
    loads : list of Load
    factors : list of (n, d, d) arrays
        B of each.
    seen : list of (n, nw, d) complex arrays
        u of each in the waves of the sea.
    arrays : dict
        Of `SeaSystem` without the loads, "omega" (nw,), and of each load its map J, the water's
        velocity and B for this motion.
    solved : Solved
        The system with the loads.
    """

    loads: list[Load]
    factors: list[Array]
    seen: list[Complex]
    arrays: Arrays
    solved: Solved

    @classmethod
    def of(cls, model: LinearModel) -> _FixedPoint:
        """Iterate to the fixed point."""
        loads, plain = nonlinear_loads(model)
        waves = wave_components(plain.case)
        found = equivalents(plain, loads, waves, TOLERANCE, MOST)
        system = sea_system(plain)
        factors = list(found.factors)
        first = cls(loads, factors, [], {}, Solved.of(system))
        arrays = first._base(plain, loads, waves, system)
        whole = dict(system.arrays)
        damping, drag = first._together(arrays, factors)
        whole["stiffness"] = whole["stiffness"] + _iw(waves[:, 0]) * damping
        whole["force"] = whole["force"] + drag
        solved = Solved.of(SeaSystem(whole, system.channels, system.dampers))
        amplitude = np.asarray(arrays["amplitude"])
        seen = [
            amplitude[:, None] * first._velocity(arrays, k, 1j * waves[:, 0][:, None] * solved.xi)
            for k in range(len(loads))
        ]
        point = replace(first, seen=seen, solved=solved)
        return replace(point, arrays=arrays | point._laws(loads))

    def arrays_of(self, model: LinearModel) -> Arrays:
        """`arrays` of another case, B for the motion of this one.

        Raises
        ------
        CaseError
            It has other nonlinear loads.
        """
        loads, plain = nonlinear_loads(model)
        if [load.name for load in loads] != [load.name for load in self.loads]:
            raise CaseError(
                "no derivative: the nonlinear loads change with it "
                f"({', '.join(load.name for load in self.loads) or 'none'} and "
                f"{', '.join(load.name for load in loads) or 'none'})"
            )
        waves = wave_components(plain.case)
        return self._base(plain, loads, waves, sea_system(plain)) | self._laws(loads)

    def power(self, which: Sequence[int]) -> float:
        """Mean power of loads, the sum of B <u u^T> [W]."""
        return float(
            sum(np.sum(self.factors[k] * motion_of(self.seen[k]).covariance) for k in which)
        )

    def power_slope(self, moved: _Moved, which: Sequence[int]) -> float:
        """Derivative of `power`."""
        total = 0.0
        for k in which:
            square = motion_of(self.seen[k]).covariance
            cross = 0.5 * (np.swapaxes(self.seen[k], 1, 2) @ moved.seen[k].conj()).real
            total += float(np.sum(moved.factors[k] * square))
            total += float(np.sum(self.factors[k] * (cross + np.swapaxes(cross, 1, 2))))
        return total

    def moved(self, d: Mapping[str, Any]) -> _Moved:
        """Derivatives of the fixed point from those of `arrays`.

        Raises
        ------
        CaseError
            The linear system is singular: another solution branches off.
        """
        still = [np.zeros_like(factor) for factor in self.factors]
        given = self._answer(d, still)
        if not self.loads:
            return self._move(d, still)
        scale = np.concatenate(
            [np.full(f.size, max(float(np.abs(f).max(initial=0.0)), 1e-300)) for f in self.factors]
        )
        none = {name: np.zeros_like(array) for name, array in self.arrays.items()}

        def apply(x: Array) -> Array:
            changed = self._answer(none, self._split(x.ravel() * scale))
            return np.asarray(x.ravel() - _flat(changed) / scale)

        size = len(scale)
        operator = LinearOperator((size, size), matvec=apply, dtype=float)
        x, failed = gmres(
            operator, _flat(given) / scale, rtol=LINEAR, atol=0.0, restart=min(size, 300), maxiter=5
        )
        if failed or not np.all(np.isfinite(x)):
            raise CaseError(
                "no derivative: the linear equivalents of "
                f"{', '.join(dict.fromkeys(load.name for load in self.loads))} are at a turning "
                "point of the sea or of a parameter"
            )
        return self._move(d, self._split(x * scale))

    def _split(self, values: Array) -> list[Array]:
        ends = np.cumsum([factor.size for factor in self.factors])[:-1]
        parts = np.split(values, ends)
        return [p.reshape(f.shape) for p, f in zip(parts, self.factors, strict=True)]

    def _answer(self, d: Mapping[str, Any], factors: list[Array]) -> list[Array]:
        """Derivatives of b(u, p) where those of B are `factors`."""
        seen = self._move(d, factors).seen
        return [
            d[f"law {k}"] + _along(load, u, du)
            for k, (load, u, du) in enumerate(zip(self.loads, self.seen, seen, strict=True))
        ]

    def _move(self, d: Mapping[str, Any], factors: list[Array]) -> _Moved:
        """Derivatives of system and motion where those of B are `factors`."""
        a, iw = self.arrays, _iw(self.arrays["omega"])
        d_damping, d_drag = self._together_moved(d, factors)
        damping, _ = self._together(a, self.factors)
        whole = {name: d[name] for name in self.solved.system.arrays}
        whole["stiffness"] = whole["stiffness"] + iw * d_damping + _iw(d["omega"]) * damping
        whole["force"] = whole["force"] + d_drag
        d_xi = self.solved.derivative(whole)[0]
        iw, d_iw = iw[:, :, 0], _iw(d["omega"])[:, :, 0]
        rate, d_rate = iw * self.solved.xi, iw * d_xi + d_iw * self.solved.xi
        amplitude, d_amplitude = a["amplitude"][:, None], np.asarray(d["amplitude"])[:, None]
        seen = []
        for k in range(len(self.loads)):
            turned = -(rate @ np.swapaxes(d[f"map {k}"], 1, 2)) + d[f"water {k}"]
            per_metre = self._velocity(a, k, rate)
            change = -(d_rate @ np.swapaxes(a[f"map {k}"], 1, 2)) + turned
            seen.append(amplitude * change + d_amplitude * per_metre)
        return _Moved(whole, factors, seen)

    def _together(self, a: Mapping[str, Any], factors: list[Array]) -> tuple[Array, Complex]:
        """Sums of J^T B J (n_u, n_u) and J^T B u_water (nw, n_u)."""
        force = np.zeros_like(a["force"], dtype=complex)
        damping = np.zeros((force.shape[1],) * 2)
        for k, factor in enumerate(factors):
            acting = np.swapaxes(a[f"map {k}"], 1, 2) @ factor
            damping += (acting @ a[f"map {k}"]).sum(axis=0)
            force += (a[f"water {k}"] @ np.swapaxes(acting, 1, 2)).sum(axis=0)
        return damping, force

    def _together_moved(self, d: Mapping[str, Any], factors: list[Array]) -> tuple[Array, Complex]:
        """Derivatives of `_together`."""
        damping, force = self._together(self.arrays, factors)
        for k, factor in enumerate(self.factors):
            j, dj = self.arrays[f"map {k}"], d[f"map {k}"]
            acting, moved = np.swapaxes(j, 1, 2) @ factor, np.swapaxes(dj, 1, 2) @ factor
            damping = damping + (moved @ j + acting @ dj).sum(axis=0)
            force = force + (self.arrays[f"water {k}"] @ np.swapaxes(moved, 1, 2)).sum(axis=0)
            force = force + (d[f"water {k}"] @ np.swapaxes(acting, 1, 2)).sum(axis=0)
        return damping, force

    @staticmethod
    def _velocity(a: Mapping[str, Any], k: int, rate: Complex) -> Complex:
        """What a load sees per metre of amplitude, (n, nw, d)."""
        return np.asarray(a[f"water {k}"] - rate @ np.swapaxes(a[f"map {k}"], 1, 2))

    def _laws(self, loads: list[Load]) -> Arrays:
        """B of loads for the motion of this fixed point."""
        return {
            f"law {k}": load.equivalent(motion_of(u))
            for k, (load, u) in enumerate(zip(loads, self.seen, strict=True))
        }

    @staticmethod
    def _base(model: LinearModel, loads: list[Load], waves: Array, system: SeaSystem) -> Arrays:
        out: Arrays = dict(system.arrays) | {"omega": waves[:, 0]}
        for k, load in enumerate(loads):
            flow = water_velocity(model, load, waves)
            out[f"map {k}"] = load.map
            shape = (len(load.map), len(waves), load.map.shape[1])
            out[f"water {k}"] = np.zeros(shape, dtype=complex) if flow is None else flow
        return out


def _along(load: Load, seen: Complex, change: Complex) -> Array:
    """Derivative of B along a change of what a load sees; of friction that holds its joint none."""
    size, length = np.linalg.norm(seen), np.linalg.norm(change)
    here = load.equivalent(motion_of(seen))
    stuck = isinstance(load.equivalent, AlongJoint) and load.equivalent.sticks
    if size == 0.0 or length == 0.0 or stuck:
        return np.zeros_like(here)
    h = STEP * size / length
    total = sum(
        weight * load.equivalent(motion_of(seen + node * h * change))
        for node, weight in zip(NODES, WEIGHTS, strict=True)
    )
    return np.asarray(total / h)


def _iw(omega: Any) -> Complex:
    return 1j * np.asarray(omega)[:, None, None]


def _flat(arrays: list[Array]) -> Array:
    return np.concatenate([array.ravel() for array in arrays])
