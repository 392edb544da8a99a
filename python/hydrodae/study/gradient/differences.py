"""Derivatives of arrays with respect to one number, by differences."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array

Arrays = dict[str, Any]

#: Step over the value of the parameter.
STEP = 1e-3
#: Of what a second difference may be of the first one where a dependence counts as affine.
AFFINE = 1e-7
#: Of what rounding may be of the size of an array.
ROUNDING = 1e-11
#: Relative change of an array that a step from zero has to make, to be seen above rounding.
SEEN = 1e-6

CENTRAL, FORWARD, BACKWARD = (-1, 0, 1), (0, 1, 2), (-2, -1, 0)
#: Nodes of the formulas of fourth order.
WIDE: dict[tuple[int, ...], tuple[int, ...]] = {
    CENTRAL: (-2, -1, 0, 1, 2),
    FORWARD: (0, 1, 2, 3, 4),
    BACKWARD: (-4, -3, -2, -1, 0),
}


def derivative(
    at: Callable[[float], Mapping[str, Any]], x: float, here: Mapping[str, Any]
) -> tuple[Arrays, bool, int]:
    """Derivatives of arrays with respect to x.

    Parameters
    ----------
    at : callable
        Arrays by name, of shapes that do not change.
    x : float
    here : mapping
        ``at(x)``.

    Returns
    -------
    derivatives : dict
    affine : bool
        The arrays are affine in x, and their derivatives exact to rounding; else the formula is of
        fourth order with a step of a thousandth of x.
    calls : int
        Of `at`.

    Raises
    ------
    CaseError
        `at` refuses both sides of x, or a shape changes.
    """
    seen: dict[int, Mapping[str, Any]] = {0: here}
    step, calls = _first_step(at, x, here, seen)

    def value(node: int) -> Mapping[str, Any]:
        if node not in seen:
            seen[node] = at(x + node * step)
            _check_shapes(here, seen[node])
        return seen[node]

    nodes, tried = _nodes(value), len(seen)
    affine = _is_affine([seen[n] for n in nodes])
    if not affine:
        nodes = WIDE[nodes]
        for node in nodes:
            value(node)
    weights = _weights(nodes)
    out = {
        name: sum(w * seen[n][name] for n, w in zip(nodes, weights, strict=True)) / step
        for name in here
    }
    return out, affine, calls + max(tried, len(seen)) - 1


def _first_step(
    at: Callable[[float], Mapping[str, Any]],
    x: float,
    here: Mapping[str, Any],
    seen: dict[int, Mapping[str, Any]],
) -> tuple[float, int]:
    """A thousandth of x; from zero the first of 1e-3, 1, 1000, ... that makes a change."""
    if x != 0.0:
        return STEP * abs(x), 0
    step, calls = STEP, 0
    for step in (1e-3, 1.0, 1e3, 1e6, 1e9):
        try:
            there = at(step)
        except CaseError:
            break
        calls += 1
        _check_shapes(here, there)
        seen[1] = there
        if any(_size(there[k] - here[k]) > SEEN * _size(here[k]) for k in here):
            break
    return step, calls - (1 in seen)


def _nodes(value: Callable[[int], Mapping[str, Any]]) -> tuple[int, ...]:
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


def _is_affine(three: list[Mapping[str, Any]]) -> bool:
    a, b, c = three
    return all(
        _size(c[k] - 2.0 * b[k] + a[k]) <= AFFINE * _size(c[k] - a[k]) + ROUNDING * _size(b[k])
        for k in b
    )


def _weights(nodes: tuple[int, ...]) -> Array:
    """Weights of the first derivative, exact for polynomials of the degree len(nodes) - 1."""
    powers = np.vander(np.array(nodes, dtype=float), increasing=True).T
    return np.asarray(np.linalg.solve(powers, np.eye(len(nodes))[1]))


def _size(array: Any) -> float:
    return float(np.max(np.abs(array), initial=0.0))


def _check_shapes(here: Mapping[str, Any], there: Mapping[str, Any]) -> None:
    for name, array in here.items():
        if np.shape(array) != np.shape(there[name]):
            raise CaseError(
                f"no derivative: the number of unknowns, constraints or waves changes with it "
                f"({name}: {np.shape(array)} and {np.shape(there[name])})"
            )
