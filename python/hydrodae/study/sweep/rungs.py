"""One point of a study by each model of the motion: frequency domain, spectral, time domain."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from time import perf_counter
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.hdb.relations.dispersion import group_velocity
from hydrodae.linear import LinearModel, without_memory
from hydrodae.linear.air import absorbers
from hydrodae.linear.sea import wave_components
from hydrodae.simulation import run
from hydrodae.study.spectral import spectral
from hydrodae.study.sweep.measures import ENDS, Measure, measure

#: Name to value and unit.
Found = dict[str, tuple[float, str]]

#: The model that runs: it needs memory fits, and calls functions.
TIME = "time"

#: The coordinate of a body that a component of its position or rotation is.
_COORDINATES = {
    "position": {"x": "surge", "y": "sway", "z": "heave"},
    "rotation": {"x": "roll", "y": "pitch", "z": "yaw"},
}


def open_case(
    path: str | os.PathLike[str], values: Mapping[str, Any], rungs: Sequence[str]
) -> Case:
    """Read the case of a study; only runs need the memory fit of its database.

    Raises
    ------
    CaseError
        The case cannot be used.
    """
    if TIME in rungs:
        return Case(path=path, values=values)
    return without_memory(path, values)[0]


def run_rung(
    rung: str,
    case: Case,
    measures: tuple[Measure, ...],
    timed: bool,
    functions: Mapping[str, Any] | None = None,
) -> Found:
    """Measure a case by a model of its motion.

    Parameters
    ----------
    rung : str
        One of `RUNGS`.
    case : Case
    measures : tuple of Measure
        The linear rungs know standard deviations only.
    timed : bool
        Report the wall time [s] as well.
    functions : mapping from str, optional
        Arguments of `hydrodae.run` with functions, for the rung "time".

    Raises
    ------
    HydrodaeError
        The case cannot be run so.
    """
    start = perf_counter()
    found = with_capture_width(case, RUNGS[rung](case, measures, **(functions or {})))
    return found | ({"wall_time": (perf_counter() - start, "s")} if timed else {})


def with_capture_width(case: Case, found: Found) -> Found:
    """Add the width of crest whose power is absorbed, and the ends of its interval [m]."""
    out = dict(found)
    if "mean_power_absorbed" in found and case.scene.wave_names and case.scene.database_path:
        flux = energy_flux(case)
        if flux > 0.0:
            for end in ("", *ENDS):
                if power := found.get(f"mean_power_absorbed{end}"):
                    out[f"capture_width{end}"] = (power[0] / flux, "m")
    return out


def energy_flux(case: Case) -> float:
    """Power that the waves of a case carry along each metre of their crests [W/m].

        J = sum over the components of rho g a^2 c_g / 2

    Raises
    ------
    CaseError
        The case has no waves.
    """
    waves = wave_components(case)
    rho, gravity, depth = case.scene.database_water
    speed = group_velocity(waves[:, 0], depth, gravity)
    return float(0.5 * rho * gravity * np.sum(waves[:, 2] ** 2 * speed))


def _time(case: Case, measures: tuple[Measure, ...], **functions: Any) -> Found:
    return measure(run(case, **functions), measures)


def _frequency(case: Case, measures: tuple[Measure, ...]) -> Found:
    model = LinearModel(without_memory(case)[0])
    return _linear(case, measures, *model.irregular())


def _spectral(case: Case, measures: tuple[Measure, ...]) -> Found:
    found = spectral(case)
    return _linear(case, measures, found.standard_deviation, found.power)


def _linear(
    case: Case, measures: tuple[Measure, ...], deviation: dict[str, float], power: dict[str, float]
) -> Found:
    """Standard deviations of what is measured, and mean powers of take-offs and of air."""
    found: Found = {}
    each = {name: power[name] for name in absorbers(case_tables(case)) if name in power}
    if each:
        found["mean_power_absorbed"] = (sum(each.values()), "W")
        found |= {f"mean_power_absorbed.{name}": (value, "W") for name, value in each.items()}
    for wanted in measures:
        value = deviation.get(linear_name(wanted))
        if wanted.statistic == "mean" and wanted.channel in power and not wanted.over:
            found[wanted.name] = (power[wanted.channel], "W")
        if wanted.statistic == "std" and value is not None and not wanted.over:
            found[wanted.name] = (value, unit_of(wanted))
    return found


def linear_name(wanted: Measure) -> str:
    """What linear models call the channel of a measure: bodies/float/heave for position z."""
    group, _, last = wanted.channel.rpartition("/")
    coordinate = _COORDINATES.get(last, {}).get(wanted.component or "")
    return wanted.channel if coordinate is None else f"{group}/{coordinate}"


def unit_of(wanted: Measure) -> str:
    """Unit of a coordinate, its rate or a reaction, by the name of its channel."""
    last = linear_name(wanted).rpartition("/")[2]
    turning = ("angle", "rotation", "roll", "pitch", "yaw")
    if last.startswith("reaction"):
        return "N m" if "moment" in last else "N"
    if last in ("pressure", "mass_flow"):
        return "Pa" if last == "pressure" else "kg/s"
    if last.startswith("power"):
        return "W"
    base = "rad" if last.startswith(turning) else "m"
    return f"{base}/s" if last.endswith("rate") else base


RUNGS: dict[str, Callable[..., Found]] = {
    "frequency": _frequency,
    "spectral": _spectral,
    TIME: _time,
}


#: Of a study that names none.
DEFAULT = (TIME,)


def check_rungs(rungs: object, file: object) -> tuple[str, ...]:
    """Return the rungs that a study names, cheapest first.

    Raises
    ------
    CaseError
        They are no list of rungs.
    """
    if isinstance(rungs, list) and rungs and all(rung in RUNGS for rung in rungs):
        return tuple(rung for rung in RUNGS if rung in rungs)
    raise CaseError(f"{file}: key 'rungs': expected a list of {', '.join(RUNGS)}, got {rungs!r}")


def check_runs(functions: object, rungs: Sequence[str], file: object) -> None:
    """Refuse functions for rungs that call none.

    Raises
    ------
    CaseError
    """
    if TIME not in rungs:
        raise CaseError(
            f"{file}: key 'rungs': linear models call no functions: expected {TIME!r} among them "
            f"with --functions {functions}, got {', '.join(rungs)}"
        )
