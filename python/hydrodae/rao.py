"""Response amplitude operators of a case: frequency domain, and regular-wave runs beside it."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydrodae import rao_output
from hydrodae.case import Case, parse_assignment
from hydrodae.errors import CaseError
from hydrodae.frequency import LinearModel, Response
from hydrodae.post import displayed

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

RAMP_PERIODS, FITTED_PERIODS, SAMPLES = 10, 5, 40
FREQUENCIES = 400


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
        help="periods whose values are printed [s]; default: a few within the database",
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
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="all responses, reactions too, over all frequencies (or at the --periods): .csv, or "
        ".nc, .h5 (netCDF, which is HDF5)",
    )
    parser.add_argument("--picture", metavar="FILE", help="amplitudes over the period (.png, ...)")


def run(arguments: argparse.Namespace) -> int:
    """Print natural periods, responses and, if the case has waves, those in its sea."""
    case = Case(path=arguments.case, values=dict(map(parse_assignment, arguments.set)))
    model = LinearModel(case)
    for note in model.notes:
        print(f"note: {note}")
    for mode in model.modes():
        main = [
            f"{rao_output.short_name(n)} {v:+.2f}" for n, v in mode.shape.items() if abs(v) >= 0.1
        ]
        mark = " (outside the table: extrapolated)" if mode.extrapolated else ""
        print(
            f"mode {mode.period:8.3f} s{mark}, damping ratio {mode.damping_ratio:.4f}: "
            f"{', '.join(main)}"
        )
    heading = float(np.radians(arguments.heading))
    if arguments.output:
        rao_output.check_ending(Path(arguments.output))
    chosen = model.response(_chosen(model, arguments.periods), heading)
    response = _curves(model, chosen.omega, heading)
    names = rao_output.coordinates(response)
    print("\n" + rao_output.table(response, chosen))
    if arguments.output:
        written = response if arguments.periods is None else chosen
        print(f"written: {rao_output.write(arguments.output, written)}")
    if arguments.picture:
        from hydrodae import plot

        figure = rao_output.draw(response, case.title or Path(arguments.case).stem)
        print(f"picture: {plot.save(figure, arguments.picture)}")
    if arguments.time_domain:
        runs = time_domain(
            case,
            chosen.omega.tolist(),
            heading,
            names,
            amplitude=arguments.amplitude,
            settle=arguments.settle,
            jobs=arguments.jobs,
        )
        _print_comparison(chosen, names, runs)
    if len(model.case.scene.wave_names):
        _print_sea(model, response)
    return 0


def _chosen(model: LinearModel, periods: str | None) -> Array:
    """Frequencies [rad/s] of the periods asked for; else six whole ones within the database."""
    if periods is None:
        if model.database is None:
            raise CaseError("the case has no hydrodynamic database: give the --periods")
        shortest, longest = 2.0 * np.pi / model.database.omega[[-1, 0]]
        usual = np.array([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20], dtype=float)
        inside = usual[(usual >= shortest) & (usual <= longest)]
        if len(inside) == 0:
            inside = np.linspace(shortest, longest, 6)
        pick = np.linspace(0, len(inside) - 1, min(6, len(inside))).round().astype(int)
        return np.asarray(2.0 * np.pi / inside[pick])
    try:
        values = np.array([float(text) for text in periods.split(",")])
    except ValueError:
        raise CaseError(f"--periods {periods!r}: expected numbers with commas") from None
    if not np.all(values > 0.0):
        raise CaseError(f"--periods {periods!r}: expected numbers > 0 [s]")
    return np.asarray(2.0 * np.pi / values)


def _curves(model: LinearModel, chosen: Array, heading: float) -> Response:
    """Responses over the whole database, frequencies ascending; without one at those chosen.

    Each peak lies between points that are close enough to read it off: they are added about the
    highest point of every response, three times.
    """
    if model.database is None:
        return model.response(np.sort(chosen), heading)
    low, high = model.database.omega[[0, -1]]
    w = np.union1d(np.linspace(low, high, FREQUENCIES), chosen)
    for mode in model.modes():  # a lightly damped one may fall between two points
        own = 2.0 * np.pi / mode.period
        w = np.union1d(w, own * (1.0 + max(mode.damping_ratio, 1e-4) * np.linspace(-4, 4, 33)))
    w = w[(w >= low) & (w <= high)]
    for _ in range(3):
        response = model.response(w, heading)
        heights = np.hstack(
            [np.abs(response.values), np.stack([*response.power.values()] or [w]).T]
        )
        more = []
        for k in set(np.argmax(heights, axis=0).tolist()):
            more.append(np.linspace(w[max(k - 1, 0)], w[min(k + 1, len(w) - 1)], 9))
        w = np.union1d(w, np.concatenate(more))
    return model.response(w, heading)


def _print_comparison(response: Response, names: Sequence[str], runs: Sequence[Harmonic]) -> None:
    print("\ntime domain against frequency domain: |difference| over amplitude, % (settled to, %)")
    width = max([15] + [len(rao_output.short_name(name)) for name in names])
    print("period, s " + " ".join(f"{rao_output.short_name(name):>{width}}" for name in names))
    for k, harmonic in enumerate(runs):
        cells = []
        for name in names:
            exact = response[name][k]
            error = abs(harmonic.response[name] - exact) / max(abs(exact), 1e-300)
            cells.append(f"{100 * error:8.3f} ({100 * harmonic.unsettled[name]:4.2f})")
        print(f"{2 * np.pi / response.omega[k]:9.4g} " + " ".join(f"{c:>{width}}" for c in cells))


def _print_sea(model: LinearModel, response: Response) -> None:
    deviation, power = model.irregular()
    units = {n: u.removesuffix("/m") for n, u in zip(response.names, response.units, strict=True)}
    print("\nin the sea of the case (linear): standard deviations")
    shown = {name: value for name, value in deviation.items() if "/reaction_" not in name}
    largest: dict[str, float] = {}
    for name, value in shown.items():
        unit = units.get(name, "m")
        largest[unit] = max(value, largest.get(unit, 0.0))
    for name, value in shown.items():
        held = (
            value <= rao_output.NOTHING * largest[units.get(name, "m")]
        )  # by constraints or symmetry
        factor, unit = displayed(units.get(name, "m"))
        print(f"  {name:40} {0.0 if held else factor * value:.5g} {unit}")
    for name, value in power.items():
        print(f"  mean power of {name:26} {value:.5g} W")
