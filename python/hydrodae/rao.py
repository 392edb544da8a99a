"""Response amplitude operators of a case: frequency domain, and regular-wave runs beside it."""

from __future__ import annotations

import argparse
import csv
import os
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae.case import Case, parse_assignment
from hydrodae.errors import CaseError
from hydrodae.frequency import LinearModel, Response

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

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
    from hydrodae.simulate import run

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
    with ProcessPoolExecutor(max_workers=jobs or os.cpu_count()) as pool:
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


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of `hydrodae rao`."""
    parser.add_argument("case", metavar="CASE", help="case file (TOML)")
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="as in run")
    parser.add_argument(
        "--periods",
        metavar="T1,T2,...",
        help="periods [s]; default: 40 from the frequencies of the database",
    )
    parser.add_argument(
        "--heading", metavar="DEG", type=float, default=0.0, help="direction of travel, 0 = +x"
    )
    parser.add_argument(
        "--time-domain", action="store_true", help="also run regular waves and compare"
    )
    parser.add_argument(
        "--amplitude", metavar="M", type=float, default=0.01, help="of these waves (default 0.01 m)"
    )
    parser.add_argument(
        "--settle",
        metavar="S",
        type=float,
        default=100.0,
        help="time between the ramp (10 periods) and the fit (default 100 s)",
    )
    parser.add_argument("--jobs", metavar="N", type=int, help="runs at a time (default: all cores)")
    parser.add_argument("-o", "--output", metavar="FILE.csv", help="all responses as a table")


def run(arguments: argparse.Namespace) -> int:
    """Print natural periods, responses and, if the case has waves, those in its sea."""
    case = Case(path=arguments.case, values=dict(map(parse_assignment, arguments.set)))
    model = LinearModel(case)
    for note in model.notes:
        print(f"note: {note}")
    for mode in model.modes():
        main = [f"{n} {v:+.2f}" for n, v in mode.shape.items() if abs(v) >= 0.1]
        mark = " (outside the table: extrapolated)" if mode.extrapolated else ""
        print(
            f"mode {mode.period:8.3f} s{mark}, damping ratio {mode.damping_ratio:.4f}: "
            f"{', '.join(main)}"
        )
    heading = float(np.radians(arguments.heading))
    response = model.response(_frequencies(model, arguments.periods), heading)
    names = [n for n in response.names if "/reaction_" not in n]
    _print_table(response, names)
    if arguments.output:
        _write_table(Path(arguments.output), response)
        print(f"written: {arguments.output}")
    if arguments.time_domain:
        runs = time_domain(
            case,
            response.omega.tolist(),
            heading,
            names,
            amplitude=arguments.amplitude,
            settle=arguments.settle,
            jobs=arguments.jobs,
        )
        _print_comparison(response, names, runs)
    if len(model.case.scene.wave_names):
        _print_sea(model)
    return 0


def _frequencies(model: LinearModel, periods: str | None) -> Array:
    if periods is None:
        if model.database is None:
            raise CaseError("the case has no hydrodynamic database: give the --periods")
        return np.linspace(model.database.omega[0], model.database.omega[-1], 40)
    try:
        values = np.array([float(text) for text in periods.split(",")])
    except ValueError:
        raise CaseError(f"--periods {periods!r}: expected numbers with commas") from None
    if not np.all(values > 0.0):
        raise CaseError(f"--periods {periods!r}: expected numbers > 0 [s]")
    return np.asarray(2.0 * np.pi / values)


def _print_table(response: Response, names: Sequence[str]) -> None:
    units = dict(zip(response.names, response.units, strict=True))
    print("\namplitude per metre of wave amplitude")
    for name in names:
        print(f"  {name} [{units[name]}]")
    print("period, s " + " ".join(f"{name.rpartition('/')[2][:11]:>11}" for name in names))
    for k, w in enumerate(response.omega):
        row = " ".join(f"{abs(response[name][k]):11.5g}" for name in names)
        print(f"{2 * np.pi / w:9.4g} {row}")


def _write_table(path: Path, response: Response) -> None:
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        head = ["omega [rad/s]", "period [s]"]
        for name, unit in zip(response.names, response.units, strict=True):
            head += [f"{name} amplitude [{unit}]", f"{name} phase [rad]"]
        table.writerow(head + [f"{name} mean power [W/m2]" for name in response.power])
        for k, w in enumerate(response.omega):
            row = [w, 2.0 * np.pi / w]
            for value in response.values[k]:
                row += [abs(value), float(np.angle(value))]
            table.writerow([f"{x:.9g}" for x in row + [p[k] for p in response.power.values()]])


def _print_comparison(response: Response, names: Sequence[str], runs: Sequence[Harmonic]) -> None:
    print("\ntime domain against frequency domain: |difference| over amplitude, % (settled to, %)")
    print("period, s " + " ".join(f"{name.rpartition('/')[2][:15]:>15}" for name in names))
    for k, harmonic in enumerate(runs):
        cells = []
        for name in names:
            exact = response[name][k]
            error = abs(harmonic.response[name] - exact) / max(abs(exact), 1e-300)
            cells.append(f"{100 * error:8.3f} ({100 * harmonic.unsettled[name]:4.2f})")
        print(f"{2 * np.pi / response.omega[k]:9.4g} " + " ".join(f"{c:>15}" for c in cells))


def _print_sea(model: LinearModel) -> None:
    deviation, power = model.irregular()
    print("\nin the sea of the case (linear): standard deviations")
    for name, value in deviation.items():
        if "/reaction_" not in name:
            print(f"  {name:40} {value:.5g}")
    for name, value in power.items():
        print(f"  mean power of {name:26} {value:.5g} W")
