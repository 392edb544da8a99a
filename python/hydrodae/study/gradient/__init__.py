"""Gradients of mean power, motions and loads with respect to parameters of a case."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.callbacks.files import FunctionFile
from hydrodae.case.case import CaseLike, read_case
from hydrodae.errors import CaseError
from hydrodae.linear import without_memory
from hydrodae.study.gradient.controllers import require_smooth
from hydrodae.study.gradient.linear import linear_gradient, spectral_gradient
from hydrodae.study.gradient.parameters import Parameter, read_parameter, values_of
from hydrodae.study.gradient.quantity import Found, Quantity, quantity
from hydrodae.study.gradient.runs import run_gradient
from hydrodae.support.arrays import Array

__all__ = ["Gradient", "Objective", "gradient", "objective"]

Keys = str | Sequence[str]

RUNGS: dict[str, Callable[..., Found]] = {
    "frequency": linear_gradient,
    "spectral": spectral_gradient,
    "time": run_gradient,
}


@dataclass(frozen=True)
class Gradient:
    """A quantity of a case and its gradient; printed, a table.

    Attributes
    ----------
    of : str
    value : float
    unit : str
    parameters : tuple of str
    at : (n,) array
        Values of the parameters, units of the case file.
    gradient : (n,) array
        Unit of the value over those of the parameters.
    affine : tuple of bool
        For each parameter: the value is affine in it, and the difference exact to rounding; else
        the difference is of fourth order.
    calls : int
        Linearisations or runs of the case.
    rung : str
    """

    of: str
    value: float
    unit: str
    parameters: tuple[str, ...]
    at: Array
    gradient: Array
    affine: tuple[bool, ...]
    calls: int
    rung: str

    def __str__(self) -> str:
        what = "runs" if self.rung == "time" else "linearisations"
        lines = [f"{self.of} = {self.value:.6g} {self.unit} ({self.calls} {what})"]
        rows = zip(self.parameters, self.at, self.gradient, self.affine, strict=True)
        for name, x, slope, affine in rows:
            how = "affine" if affine else "differences of fourth order"
            lines.append(f"  d/d {name:40} {slope:13.6g} at {x:g}, {how}")
        return "\n".join(lines)


def gradient(
    case: CaseLike,
    of: str,
    parameters: Sequence[Keys],
    *,
    set: Mapping[str, Any] | None = None,
    rung: str = "frequency",
    statistic: str = "std",
    component: str | None = None,
    start: float = 0.0,
) -> Gradient:
    """Gradient of a mean power, or of a statistic of a channel, with respect to keys of a case.

    All are differences of fourth order with steps of a thousandth of the value of the key. In the
    frequency domain the case is linearised again at each step, about its static equilibrium, which
    moves with the key; by statistical linearisation motion and linear equivalents are found again.
    In the time domain runs with the same fixed steps are differenced (internal numerical
    differentiation).

    Parameters
    ----------
    case : Case, Scene or path
    of : str
        "mean_power_absorbed" of all take-offs, "mean_power_absorbed.NAME" of one, or a channel.
    parameters : sequence
        Each a dotted key of the case ("force.pto.damping"; "*" in a name, "[2]" for a component
        of a list), or a sequence of keys that change together.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.
    rung : str
        "frequency", "spectral" (as `hydrodae.spectral`) or "time".
    statistic : str
        Of a channel: "std" (the amplitude over sqrt 2 in one regular wave), in runs also mean,
        max, min, range, rms, last.
    component : str, optional
        Of a channel with components, such as "z".
    start : float
        Samples of runs before it are left out [s]; powers are means after the ramp.

    Returns
    -------
    Gradient

    Raises
    ------
    CaseError
        A key is not in the case, there is no such quantity, runs without fixed steps, or the case
        has a controller that cannot be differentiated.
    SolverError
        A run failed.

    References
    ----------
    H. G. Bock, Numerical treatment of inverse problems in chemical reaction kinetics, in Modelling
    of Chemical Reaction Systems, Springer (1981) 102-125.
    """
    known = _read(case, set, rung)
    found = [read_parameter(known, keys) for keys in parameters]
    return _gradient(known, quantity(of, statistic, component, start), found, rung, None)


def _read(case: CaseLike, set: Mapping[str, Any] | None, rung: str) -> Case:
    if rung not in RUNGS:
        raise CaseError(f"rung {rung!r}: gradients are of {', '.join(map(repr, RUNGS))}")
    return read_case(case, set) if rung == "time" else without_memory(case, set)[0]


def _gradient(
    case: Case,
    what: Quantity,
    parameters: Sequence[Parameter],
    rung: str,
    functions: FunctionFile | None,
) -> Gradient:
    require_smooth(case, parameters, rung)
    called = {} if functions is None else {"functions": functions}
    found = RUNGS[rung](case, what, parameters, **called)
    names = tuple(parameter.name for parameter in parameters)
    at = np.array([parameter.value for parameter in parameters])
    return Gradient(
        what.name, found.value, found.unit, names, at, found.gradient, found.affine,
        found.calls, rung,
    )  # fmt: skip


class Objective:
    """A quantity of a case as a function of parameters, with its gradient, for optimisers.

    ``scipy.optimize.minimize(f, f.start, jac=True, bounds=...)`` with ``f = objective(...)``.

    Parameters
    ----------
    case, what, parameters, rung
        As `objective` makes them.
    sign : float
        -1 to maximise.
    functions : FunctionFile, optional
        That runs call.
    """

    def __init__(
        self,
        case: Case,
        what: Quantity,
        parameters: Sequence[Parameter],
        rung: str,
        sign: float,
        functions: FunctionFile | None = None,
    ) -> None:
        self.case, self.what, self.rung, self.sign = case, what, rung, sign
        self.parameters, self._functions = list(parameters), functions
        #: Values of the parameters in the case.
        self.start: Array = np.array([parameter.value for parameter in parameters])

    def at(self, x: Sequence[float] | Array) -> Gradient:
        """Return value and gradient at x, as they are."""
        case = self.case.with_values(values_of(self.parameters, list(x)))
        moved = [read_parameter(case, _keys(p), p.name) for p in self.parameters]
        return _gradient(case, self.what, moved, self.rung, self._functions)

    def __call__(self, x: Sequence[float] | Array) -> tuple[float, Array]:
        """Return value and gradient at x, both with the other sign to maximise."""
        found = self.at(x)
        return self.sign * found.value, self.sign * found.gradient


def _keys(parameter: Parameter) -> list[str]:
    return [key if index is None else f"{key}[{index}]" for key, index in parameter.places]


def objective(
    case: CaseLike,
    of: str,
    parameters: Mapping[str, Keys] | Sequence[Keys],
    *,
    maximise: bool = False,
    set: Mapping[str, Any] | None = None,
    rung: str = "frequency",
    statistic: str = "std",
    component: str | None = None,
    start: float = 0.0,
) -> Objective:
    """Make a function of parameters that returns a quantity and its gradient.

    Parameters
    ----------
    case, of, set, rung, statistic, component, start
        As in `gradient`.
    parameters : mapping or sequence
        As in `gradient`; a mapping names them.
    maximise : bool
        Both have the other sign.

    Raises
    ------
    CaseError
        As in `gradient`.
    """
    known = _read(case, set, rung)
    if isinstance(parameters, Mapping):
        found = [read_parameter(known, keys, name) for name, keys in parameters.items()]
    else:
        found = [read_parameter(known, keys) for keys in parameters]
    what = quantity(of, statistic, component, start)
    return Objective(known, what, found, rung, -1.0 if maximise else 1.0)
