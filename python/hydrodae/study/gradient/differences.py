"""Derivatives of a number with respect to parameters of a case, by differences."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.study.gradient.parameters import Parameter
from hydrodae.study.gradient.quantity import Found
from hydrodae.support.arrays import Array

#: Step over the value of the parameter.
STEP = 1e-3
#: Of what a second difference may be of the first one where a dependence counts as affine.
AFFINE = 1e-7
#: Of what rounding may be of the number itself.
ROUNDING = 1e-11
#: Relative change of the number that a step from zero has to make, to be seen above rounding.
SEEN = 1e-6

CENTRAL, FORWARD, BACKWARD = (-1, 0, 1), (0, 1, 2), (-2, -1, 0)
#: Nodes of the formulas of fourth order.
WIDE: dict[tuple[int, ...], tuple[int, ...]] = {
    CENTRAL: (-2, -1, 0, 1, 2),
    FORWARD: (0, 1, 2, 3, 4),
    BACKWARD: (-4, -3, -2, -1, 0),
}


def slopes_of(
    value: Callable[[Case], float], case: Case, parameters: Sequence[Parameter], unit: str
) -> Found:
    """Value of a case, and its derivatives with respect to parameters.

    Parameters
    ----------
    value : callable
    case : Case
    parameters : sequence of Parameter
    unit : str
        Of the value.

    Raises
    ------
    CaseError
        Cases with smaller and with larger values of a parameter are refused.
    """
    here, slopes, affine, calls = value(case), [], [], 1
    for parameter in parameters:

        def at(x: float, parameter: Parameter = parameter) -> float:
            return value(case.with_values(parameter.values(x)))

        slope, exact, count = derivative(at, parameter.value, here)
        slopes.append(float(slope))
        affine.append(exact)
        calls += count
    return Found(here, np.array(slopes), tuple(affine), calls, unit)


def derivative(at: Callable[[float], Any], x: float, here: Any) -> tuple[Any, bool, int]:
    """Derivative of a number, or of an array, with respect to x.

    Parameters
    ----------
    at : callable
        The number or array at x, of a shape that does not change.
    x : float
    here : float or array
        ``at(x)``.

    Returns
    -------
    derivative : float or array
    affine : bool
        The value is affine in x, and its derivative exact to rounding; else the formula is of
        fourth order with a step of a thousandth of x.
    calls : int
        Of `at`.

    Raises
    ------
    CaseError
        `at` refuses both sides of x.
    """
    seen: dict[int, Any] = {0: here}
    step, calls = _first_step(at, x, here, seen)

    def known(node: int) -> Any:
        if node not in seen:
            seen[node] = at(x + node * step)
        return seen[node]

    nodes, tried = _nodes(known), len(seen)
    affine = _is_affine([seen[n] for n in nodes])
    if not affine:
        nodes = WIDE[nodes]
    slope = sum(w * known(node) for node, w in zip(nodes, _weights(nodes), strict=True)) / step
    return slope, affine, calls + max(tried, len(seen)) - 1


def _first_step(
    at: Callable[[float], Any], x: float, here: Any, seen: dict[int, Any]
) -> tuple[float, int]:
    """A thousandth of x; from zero the first of 1e-3, 1, 1000, ... that makes a change."""
    if x != 0.0:
        return STEP * abs(x), 0
    step, calls = STEP, 0
    for step in (1e-3, 1.0, 1e3, 1e6, 1e9):
        try:
            seen[1] = at(step)
        except CaseError:
            break
        calls += 1
        if _size(seen[1] - here) > SEEN * _size(here):
            break
    return step, calls - (1 in seen)


def _nodes(value: Callable[[int], Any]) -> tuple[int, ...]:
    """Three nodes about x, on one side of it where the other one is refused."""
    refused: CaseError | None = None
    for nodes in (CENTRAL, FORWARD, BACKWARD):
        try:
            for node in nodes:
                value(node)
        except CaseError as error:
            refused = refused or error
            continue
        return nodes
    assert refused is not None
    raise refused


def _is_affine(three: list[Any]) -> bool:
    a, b, c = three
    return _size(c - 2.0 * b + a) <= AFFINE * _size(c - a) + ROUNDING * _size(b)


def _size(value: Any) -> float:
    return float(np.max(np.abs(value), initial=0.0))


def _weights(nodes: tuple[int, ...]) -> Array:
    """Weights of the first derivative, exact for polynomials of the degree len(nodes) - 1."""
    powers = np.vander(np.array(nodes, dtype=float), increasing=True).T
    return np.asarray(np.linalg.solve(powers, np.eye(len(nodes))[1]))
