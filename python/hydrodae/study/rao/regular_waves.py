"""Runs of a case in regular waves, and the harmonics that they settle to."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from hydrodae.case import Case
from hydrodae.case.case import parse_assignment
from hydrodae.errors import CaseError
from hydrodae.simulation import run
from hydrodae.support import processes
from hydrodae.support.arrays import Array

RAMP_PERIODS, FITTED_PERIODS, SAMPLES = 10, 5, 40


@dataclass(frozen=True)
class Harmonic:
    """What a run in a regular wave settles to.

    Attributes
    ----------
    response : dict of complex
        First harmonic of each coordinate over that of the elevation [per m].
    unsettled : dict of float
        Change of the amplitude between the last two stretches of five periods, relative.
    """

    response: dict[str, complex]
    unsettled: dict[str, float]


def regular_wave_run(
    case: Case, omega: float, heading: float, amplitude: float, names: Sequence[str], settle: float
) -> Harmonic:
    """Run a case in one regular wave and fit its first harmonic.

    Parameters
    ----------
    case : Case
        Its waves are replaced; it starts from its equilibrium.
    omega : float
        Frequency of the wave [rad/s].
    heading : float
        Direction of travel [rad].
    amplitude : float
        Of the wave [m].
    names : sequence of str
        Coordinates such as "bodies/flap1/pitch" and "joints/hinge1/angle".
    settle : float
        Time after the ramp before the fit [s], rounded up to whole periods.
    """
    period = 2.0 * np.pi / omega
    settled = RAMP_PERIODS + int(np.ceil(settle / period))
    wave = {
        "name": "regular",
        "type": "regular",
        "period": period,
        "height": 2.0 * amplitude,
        "heading_deg": float(np.degrees(heading)),
    }
    results = run(
        case,
        set={
            "wave": [wave],
            "sea.ramp": RAMP_PERIODS * period,
            "solver.start": "equilibrium",
            "solver.accuracy": "none",
            "solver.end_time": (settled + 2 * FITTED_PERIODS + 0.5 / SAMPLES) * period,
            "output.step": period / SAMPLES,
        },
    )
    count = FITTED_PERIODS * SAMPLES
    carrier = 2.0 / count * np.exp(-1j * omega * results.time[-2 * count :])

    def harmonics(values: Array) -> tuple[complex, complex]:
        x = values[-2 * count :] - values[-count:].mean()
        first, second = (x * carrier)[:count].sum(), (x * carrier)[count:].sum()
        return complex(first), complex(second)

    _, elevation = harmonics(results["sea/elevation"].values)
    response, unsettled = {}, {}
    for name in names:
        before, after = harmonics(_channel(results, name))
        response[name] = after / elevation
        unsettled[name] = float(abs(after - before) / max(abs(after), 1e-300))
    return Harmonic(response, unsettled)


def _channel(results: object, name: str) -> Array:
    """Time series of a coordinate of a body or joint."""
    head, _, last = name.rpartition("/")
    dofs = ("surge", "sway", "heave", "roll", "pitch", "yaw")
    if not name.startswith("bodies/"):
        return np.asarray(results[name].values)  # type: ignore[index]
    k = dofs.index(last)
    channel = f"{head}/position" if k < 3 else f"{head}/rotation"
    return np.asarray(results[channel].values[:, k % 3])  # type: ignore[index]


def time_domain(
    case: Case,
    omega: Sequence[float],
    heading: float,
    names: Sequence[str],
    *,
    amplitude: float = 0.01,
    settle: float = 100.0,
    jobs: int | None = None,
) -> list[Harmonic]:
    """Regular-wave runs in parallel, one for each frequency; see `regular_wave_run`."""
    if case.path is None:
        raise CaseError("runs in parallel need a case that is in a file")
    work = partial(
        _run_one,
        case.path,
        case.overrides,
        heading=heading,
        amplitude=amplitude,
        names=tuple(names),
        settle=settle,
    )
    with ProcessPoolExecutor(jobs or os.cpu_count(), processes.context(anew=False)) as pool:
        return list(pool.map(work, map(float, omega)))


def _run_one(
    path: Path,
    overrides: dict[str, str],
    omega: float,
    *,
    heading: float,
    amplitude: float,
    names: tuple[str, ...],
    settle: float,
) -> Harmonic:
    values = dict(parse_assignment(f"{key}={value}") for key, value in overrides.items())
    case = Case(path=path, values=values)
    return regular_wave_run(case, omega, heading, amplitude, names, settle)
