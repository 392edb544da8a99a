"""Exact gradients in the frequency domain."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.linear.system import SeaSystem, Solved, sea_system
from hydrodae.study.gradient.differences import derivative
from hydrodae.study.gradient.parameters import Parameter
from hydrodae.study.gradient.quantity import Found, Quantity
from hydrodae.study.sweep.rungs import linear_name, unit_of
from hydrodae.support.arrays import Array, Complex


def linear_gradient(case: Case, what: Quantity, parameters: Sequence[Parameter]) -> Found:
    """Value and gradient of a quantity of the linear response in the sea of a case.

    Raises
    ------
    CaseError
        There is no such quantity here, or the case cannot be linearised nearby.
    """
    model = LinearModel(case)
    system = sea_system(model)
    solved = Solved.of(system)
    form, unit = make_form(case, system, what)
    value = form.value(solved)
    slopes, affine, calls = [], [], 1
    for parameter in parameters:

        def at(x: float, parameter: Parameter = parameter) -> dict[str, Any]:
            there = LinearModel(case.with_values(parameter.values(x)))
            return sea_system(there.sharing_tables_of(model)).arrays

        d, exact, count = derivative(at, parameter.value, system.arrays)
        slopes.append(form.slope(solved, d))
        affine.append(exact)
        calls += count
    return Found(value, np.array(slopes), tuple(affine), calls, unit)


@dataclass(frozen=True)
class Form:
    """S = sum over waves and rows of a^2/2 f |R xi + L lambda|^2, or its root.

    Attributes
    ----------
    rows : callable
        R (r, n), L (r, m) and f (r, nw) from the arrays of a system, linear in them.
    root : bool
    """

    rows: Callable[[Mapping[str, Any]], tuple[Array, Array, Array]]
    root: bool

    def value(self, solved: Solved) -> float:
        """Return the sum, or its root."""
        total = self._sum(solved)
        return float(np.sqrt(total)) if self.root else total

    def _sum(self, solved: Solved) -> float:
        a = solved.system.arrays
        factor = self.rows(a)[2]
        return float(np.sum(0.5 * a["amplitude"].real ** 2 * factor * self._squares(solved)))

    def _phasor(self, solved: Solved, arrays: Mapping[str, Any]) -> Complex:
        """Sum R xi + L lambda, (r, nw), with the rows of these arrays."""
        by_xi, by_lambda, _ = self.rows(arrays)
        return np.asarray(by_xi @ solved.xi.T + by_lambda @ solved.multipliers.T)

    def _squares(self, solved: Solved) -> Array:
        return np.abs(self._phasor(solved, solved.system.arrays)) ** 2

    def slope(self, solved: Solved, d: dict[str, Any]) -> float:
        """Derivative of the value from those of the arrays."""
        a = solved.system.arrays
        by_xi, by_lambda, factor = self.rows(a)
        xi, multipliers = solved.derivative(d)
        moved = by_xi @ xi.T + by_lambda @ multipliers.T + self._phasor(solved, d)
        squares = self._squares(solved)
        changed = 2.0 * (self._phasor(solved, a).conj() * moved).real
        half, d_half = 0.5 * a["amplitude"].real ** 2, a["amplitude"].real * d["amplitude"].real
        total = np.sum(
            half * (factor * changed + self.rows(d)[2] * squares) + d_half * factor * squares
        )
        if not self.root:
            return float(total)
        value = self.value(solved)
        return float(total / (2.0 * value)) if value > 0.0 else 0.0


def make_form(case: Case, system: SeaSystem, what: Quantity) -> tuple[Form, str]:
    """Form and unit of a quantity: of powers what linear take-offs take."""
    if what.measure is None:
        chosen = what.take_offs(case)
        rows = [k for k, name in enumerate(system.dampers) if name in chosen]
        none = np.zeros((len(rows), len(system.arrays["constraints"])))
        return Form(lambda a: (a["damper_map"][rows], none, a["damper_power"][rows]), False), "W"
    row = [_channel(system, what)]
    return Form(lambda a: (a["by_xi"][row], a["by_lambda"][row], a["one"]), True), unit_of(
        what.measure
    )


def _channel(system: SeaSystem, what: Quantity) -> int:
    assert what.measure is not None
    name = linear_name(what.measure)
    if name not in system.channels:
        raise CaseError(
            f"{what.name}: the frequency domain has no channel {name!r}; there are: "
            f"{', '.join(system.channels)}"
        )
    if what.measure.statistic != "std":
        raise CaseError(
            f"{what.name}: the frequency domain knows the statistic 'std' only, not "
            f"{what.measure.statistic!r}"
        )
    return system.channels.index(name)
