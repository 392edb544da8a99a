"""Python functions of time that coordinate constraints follow."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from hydrodae.case.callbacks.names import check_names
from hydrodae.errors import CaseError

if TYPE_CHECKING:
    from hydrodae._core import Scene

#: A function of time t [s]: its value [m or rad], or (value, rate, rate of the rate).
Drive = Callable[[float], Any]
Kernel = Callable[[float], tuple[float, float, float]]

# Samples of a function that gives its value only: what it does between the first ones nobody sees.
_FEWEST, _MOST, _MOST_BY_OUTPUT = 2049, 2**17 + 1, 2**15 + 1
_AGREES = 1e-9  # spline against function between the samples, of the function's range


def kernel_drives(scene: Scene, drives: Mapping[str, Drive] | None) -> dict[str, Kernel]:
    """Check the names and bring every function to (value, rate, rate of the rate).

    Parameters
    ----------
    scene : Scene
        Its constraints with ``drive = { python = true }`` need a function each.
    drives : mapping from str to callable, or None
        Functions by the name of the constraint. One that returns a single number is sampled before
        the run, and a quintic spline through the samples gives its rates.

    Raises
    ------
    CaseError
        A name is not that of such a constraint, one has no function, or a function that returns its
        value only is not smooth enough for a spline.
    """
    given = dict(drives or {})
    check_names(
        given,
        scene.python_drives,
        argument="drives",
        kind="constraint with drive = { python = true }",
        owner="drive of constraint",
        signature="function of time",
    )
    return {name: _kernel(name, drive, scene) for name, drive in given.items()}


def _kernel(name: str, drive: Drive, scene: Scene) -> Kernel:
    width = np.size(drive(0.0))
    if width == 1:
        by_output = min(2.0 * scene.end_time / scene.output_step + 1.0, _MOST_BY_OUTPUT)
        return _splined(name, drive, scene.end_time, max(_FEWEST, int(by_output)))
    if width != 3:
        raise CaseError(
            f"drives: the function of {name!r} must return its value, or value, rate and rate of "
            f"the rate; it returned {width} numbers"
        )

    def values(time: float) -> tuple[float, float, float]:
        value, rate, acceleration = (float(x) for x in drive(time))
        return _finite(name, time, (value, rate, acceleration))

    return values


def _finite(
    name: str, time: float, values: tuple[float, float, float]
) -> tuple[float, float, float]:
    if not np.isfinite(values).all():
        raise CaseError(f"drives: the function of {name!r} returned {values} at t = {time:g} s")
    return values


def _splined(name: str, drive: Drive, end_time: float, fewest: int) -> Kernel:
    """Quintic spline through samples of the function, doubled until they represent it."""
    from scipy.interpolate import make_interp_spline

    def sample(times: Any) -> Any:
        values = np.array([float(np.squeeze(drive(float(t)))) for t in times])
        if not np.isfinite(values).all():
            time = float(times[~np.isfinite(values)][0])
            raise CaseError(f"drives: the function of {name!r} is not finite at t = {time:g} s")
        return values

    time = np.linspace(0.0, end_time, fewest)
    values = sample(time)
    while True:
        spline = make_interp_spline(time, values, k=5)
        middle = 0.5 * (time[1:] + time[:-1])
        between = sample(middle)
        size = max(float(np.ptp(np.r_[values, between])), 1e-12 * float(abs(values).max()), 1e-300)
        if float(abs(spline(middle) - between).max()) <= _AGREES * size:
            break
        if time.size > _MOST:
            raise CaseError(
                f"drives: the function of {name!r} is not smooth enough to find its rates from its "
                f"values; let it return value, rate and rate of the rate"
            )
        time, values = _merged(time, middle), _merged(values, between)
    rates = [spline, spline.derivative(1), spline.derivative(2)]

    def at(t: float) -> tuple[float, float, float]:
        value, rate, acceleration = (float(f(t)) for f in rates)
        return value, rate, acceleration

    return at


def _merged(nodes: Any, middle: Any) -> Any:
    merged = np.empty(nodes.size + middle.size)
    merged[::2], merged[1::2] = nodes, middle
    return merged
