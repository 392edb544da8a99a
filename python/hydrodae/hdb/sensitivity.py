"""What a result of a case owes to its database: step, range, length of memory, fit, coupling.

Each variant replaces A and B of the database and goes through the same linear model of the case
(`hydrodae.frequency`). A memory cut at time T, and a fit, count by the A and B that they stand for:

    memory cut at T:  B - int_T^inf K cos(wt) dt,   A + (1/w) int_T^inf K sin(wt) dt
    fit:              B = Re H,                     A = A_inf + Im(H)/w

K(t) of a table that ends earlier, and its A_inf, come from what is left of B and A.
"""

from __future__ import annotations

import argparse
import json
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from hydrodae import irf
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.kernels import memory_length, resolved_time

if TYPE_CHECKING:
    from hydrodae.case import Case
    from hydrodae.frequency import LinearModel
    from hydrodae.memory import ExponentialMemory

Array = NDArray[np.float64]
Values = dict[str, float]
STEPS, RANGES, LENGTHS = (2, 4), (0.75, 0.5), (1.0, 0.5, 0.25)


@dataclass(frozen=True)
class Row:
    """One result with one variant of the database.

    Attributes
    ----------
    variant : str
    result : str
        With its unit.
    value : float
        NaN where the variant cannot give it.
    change : float
        Against the base [%].
    """

    variant: str
    result: str
    value: float
    change: float


def every(database: HydroDatabase, step: int) -> HydroDatabase:
    """Keep every `step`-th frequency, and the last."""
    keep = np.arange(database.omega.size) % step == 0
    keep[-1] = True
    return _kept(database, keep)


def up_to(database: HydroDatabase, share: float) -> HydroDatabase:
    """Keep the frequencies up to `share` of the highest; K(t) and A_inf come from these alone.

    A = A_inf - (1/w) int K sin(wt) dt with both of the shorter table (Ogilvie's relation).
    """
    part = _kept(database, database.omega <= share * database.omega[-1] * (1.0 + 1e-9))
    w, b = part.omega, part.radiation_damping
    infinite, _ = irf.added_mass_inf(w, part.added_mass, b)
    return replace(part, added_mass=infinite - irf.kramers_kronig(w, b), added_mass_inf=infinite)


def cut_memory(database: HydroDatabase, length: float) -> HydroDatabase:
    """Return A and B without what K(t) holds after `length` [s], at the same frequencies."""
    w, n = database.omega, len(database.coordinates)
    count = 2 * int(np.ceil(length * w[-1] / 0.25)) + 1
    time = np.linspace(0.0, length, max(count, 101))
    kernel = database.radiation_kernel(time, extrapolate=True).reshape(time.size, -1)
    kept = _fourier(time, kernel, w).reshape(w.size, n, n)
    # (1/w) int_0^inf K sin(wt) dt = A_inf - A
    whole = irf.kramers_kronig(w, database.radiation_damping)
    added = database.added_mass + whole + kept.imag / w[:, None, None]
    return replace(database, radiation_damping=kept.real, added_mass=added)


def fitted(database: HydroDatabase, fit: ExponentialMemory) -> HydroDatabase:
    """Return A and B of a fit, on the coordinates that it moves."""
    part = database.select(fit.inputs)
    rows = [fit.outputs.index(label) for label in fit.inputs]
    h = fit.transfer(part.omega)[:, rows]
    added = fit.added_mass_inf[rows] + h.imag / part.omega[:, None, None]
    return replace(part, radiation_damping=h.real, added_mass=added)


def variants(
    database: HydroDatabase, moving: Sequence[str], states: Sequence[int], band: Array | None
) -> Iterator[tuple[str, HydroDatabase]]:
    """Yield name and database of each variant; `moving` are the coordinates that move."""
    from hydrodae.memory import MemoryFitWarning, fit_memory

    yield "base: tables as stored", database
    for step in STEPS:
        yield f"every {step}. frequency", every(database, step)
    for share in RANGES:
        yield f"up to {share:g} w_max", up_to(database, share)
    part = database.select(moving)
    longest = min(memory_length(part), resolved_time(part))
    for share in LENGTHS:
        yield f"memory cut at {share * longest:.3g} s", cut_memory(part, share * longest)
    for name, fit in database.memory.items():
        if set(moving) <= set(fit.inputs):
            yield f"fit '{name}', {fit.n_states} states", fitted(database, fit)
    for count in states:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", MemoryFitWarning)
            fit = fit_memory(
                database,
                moving,
                band=None if band is None else (float(band[0]), float(band[1])),
                max_states=count,
            )
        passive = "" if fit.report["passive"] else ", NOT passive"
        yield f"fit, {fit.n_states} states{passive}", fitted(database, fit)
    if len(database.bodies) > 1:
        yield "no coupling of bodies", database.without_coupling()


def sensitivity(
    case: Case,
    result: str,
    *,
    periods: Sequence[float] = (),
    channels: Sequence[str] = (),
    heading: float = 0.0,
    states: Sequence[int] = (),
    band: Array | None = None,
) -> list[Row]:
    """How a result of a case depends on its database.

    Parameters
    ----------
    case : Case
    result : str
        "period" (natural modes: period and damping ratio), "rao" (amplitudes of `channels` at
        `periods`), "power" (mean power of all dampers in the sea of the case).
    periods : sequence of float
        [s], of "rao".
    channels : sequence of str
        Responses of "rao", such as joints/slide/displacement; all coordinates by default.
    heading : float
        Direction of travel [rad], of "rao".
    states : sequence of int
        Also refit the memory with at most these numbers of states.
    band : (2,) array, optional
        Of these fits [rad/s].

    Returns
    -------
    list of Row

    Raises
    ------
    HydrodaeError
        No database, an unknown result or channel, a period outside the database, no waves, no
        damper.
    """
    from hydrodae.frequency import LinearModel

    model = LinearModel(case)
    if model.database is None:
        raise CaseError("the case has no hydrodynamic database")
    measure = _measure(model, result, periods, channels, heading)
    rows: list[Row] = []
    base: Values = {}
    for name, database in variants(model.database, model.hydro_labels, states, band):
        try:
            values = measure(model.with_database(database))
        except DatabaseError:
            if not base:
                raise
            values = {}  # the variant does not reach the frequencies of the result
        base = base or values
        for key, reference in base.items():
            value = values.get(key, np.nan)
            rows.append(Row(name, key, value, 100.0 * (value / reference - 1.0)))
    return rows


def _measure(
    model: LinearModel,
    result: str,
    periods: Sequence[float],
    channels: Sequence[str],
    heading: float,
) -> Callable[[LinearModel], Values]:
    """Return the function that takes the values of a result from a linear model."""
    if result == "period":
        shapes = [mode.shape for mode in model.modes() if not mode.extrapolated]
        if not shapes:
            raise CaseError("no mode of the case has a period inside the database")
        return lambda other: _periods(other, shapes)
    if result == "power":
        if not len(model.case.scene.wave_names):
            raise CaseError("--result power: the case has no [[wave]]")
        _, power = model.irregular()
        if not power:
            raise CaseError("--result power: the case has no damper that takes power")
        return lambda other: {
            f"mean power of {name} [W]": value for name, value in other.irregular()[1].items()
        }
    if result != "rao":
        raise CaseError(f"--result {result}: expected period, rao or power")
    if not periods:
        raise CaseError("--result rao: give --periods")
    omega = 2.0 * np.pi / np.asarray(periods, dtype=float)
    first = model.response(omega, heading)
    names = list(channels) or [n for n in first.names if "/reaction_" not in n]
    for name in names:
        first[name]  # raises for an unknown one, with those that there are
    largest = {unit: 0.0 for unit in first.units}
    units = dict(zip(first.names, first.units, strict=True))
    for name in names:
        largest[units[name]] = max(largest[units[name]], float(np.abs(first[name]).max()))

    def amplitudes(other: LinearModel) -> Values:
        response = other.response(omega, heading)
        return {
            f"{name} at {period:g} s [{units[name]}]": float(abs(response[name][k]))
            for name in names
            for k, period in enumerate(periods)
            if abs(first[name][k]) > 1e-6 * largest[units[name]]
        }

    return amplitudes


def _periods(model: LinearModel, shapes: Sequence[dict[str, float]]) -> Values:
    """Periods and damping ratios of the modes whose shapes are nearest to those given."""
    found = model.modes()
    values: Values = {}
    for k, shape in enumerate(shapes):
        if not found:
            break
        mine = np.array(list(shape.values()))
        likeness = [
            abs(mine @ (v := np.array(list(mode.shape.values())))) / np.linalg.norm(v)
            for mode in found
        ]
        mode = found.pop(int(np.argmax(likeness)))
        main = max(shape, key=lambda name: abs(shape[name]))
        name = f"mode {k + 1} ({main.removeprefix('bodies/')})"
        values[f"{name}: period [s]"] = mode.period
        values[f"{name}: damping ratio [-]"] = mode.damping_ratio
    return values


def _fourier(time: Array, values: Array, omega: Array) -> NDArray[np.complex128]:
    """Return int_0^T f(t) e^{-iwt} dt, (nw, m), of the cubic spline of f, integrated exactly."""
    spline = CubicSpline(time, values)
    z = -1j * omega
    result = np.zeros((omega.size, values.shape[1]), dtype=complex)
    # by parts: sum over the ends of [f/z - f'/z2 + f''/z3] e^{zt} and the jumps of f'''
    for order in range(3):
        ends = spline(time[[0, -1]], order)
        factor = (-1.0) ** order / z[:, None] ** (order + 1)
        result += factor * (np.exp(z * time[-1])[:, None] * ends[1] - ends[0])
    third = 6.0 * spline.c[0]
    growth = np.exp(z[:, None] * time)
    result -= (growth[:, 1:] - growth[:, :-1]) @ third / z[:, None] ** 4
    return result


def _kept(database: HydroDatabase, keep: NDArray[np.bool_]) -> HydroDatabase:
    if keep.sum() < 4:
        raise DatabaseError("fewer than 4 frequencies would be left")
    return replace(
        database,
        omega=database.omega[keep],
        added_mass=database.added_mass[keep],
        radiation_damping=database.radiation_damping[keep],
        froude_krylov=database.froude_krylov[keep],
        diffraction=database.diffraction[keep],
    )


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand sensitivity."""
    parser = actions.add_parser(
        "sensitivity",
        help="what a result of a case owes to its database",
        description="A result of a case (natural periods, responses, mean power; all linear) with "
        "a coarser or shorter table, a shorter or fitted memory, and bodies that radiate each for "
        "itself, against the tables as they stand.",
    )
    parser.add_argument("case", metavar="CASE", help="case file (TOML)")
    parser.add_argument("--result", choices=("period", "rao", "power"), required=True)
    parser.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="as in run")
    parser.add_argument("--periods", metavar="T1,T2,...", help="of --result rao [s]")
    parser.add_argument(
        "--channel",
        metavar="NAME",
        action="append",
        default=[],
        help="of --result rao, such as joints/slide/displacement; may be repeated",
    )
    parser.add_argument("--heading", metavar="DEG", type=float, default=0.0, help="of --result rao")
    parser.add_argument(
        "--states", metavar="N1,N2,...", help="also refit the memory with these numbers of states"
    )
    parser.add_argument("--band", metavar="LO,HI", help="frequencies [rad/s] of these fits")
    parser.add_argument("-o", "--output", metavar="NAME", help="write NAME.json and NAME.png")


def run(args: argparse.Namespace) -> int:
    """Print the table; returns 0.

    Raises
    ------
    HydrodaeError
        Bad arguments or data.
    """
    from hydrodae.case import Case, parse_assignment

    case = Case(path=args.case, values=dict(map(parse_assignment, args.set)))
    band = None if args.band is None else _numbers("--band", args.band)
    if band is not None and band.size != 2:
        raise CaseError(f"--band {args.band!r}: expected LO,HI")
    states = [] if args.states is None else _numbers("--states", args.states).astype(int).tolist()
    rows = sensitivity(
        case,
        args.result,
        periods=[] if args.periods is None else _numbers("--periods", args.periods).tolist(),
        channels=args.channel,
        heading=float(np.radians(args.heading)),
        states=states,
        band=band,
    )
    print(table(case.title, rows))
    if args.output:
        for path in _write(Path(args.output), case.title, rows):
            print(f"written: {path}")
    return 0


def table(title: str, rows: Sequence[Row]) -> str:
    """Return the rows as text, one block for each result."""
    lines = [title]
    for result in dict.fromkeys(row.result for row in rows):
        lines.append(f"\n{result}")
        for row in rows:
            if row.result == result:
                known = not np.isnan(row.value)
                value = f"{row.value:12.6g} {row.change:+9.3f} %" if known else f"{'-':>12}"
                lines.append(f"  {row.variant:32} {value}")
    return "\n".join(lines)


def _numbers(option: str, text: str) -> Array:
    try:
        values = np.array([float(v) for v in text.split(",")])
    except ValueError:
        values = np.zeros(1)
    if not np.all(np.isfinite(values)) or not np.all(values > 0.0):
        raise CaseError(f"{option} {text!r}: expected numbers > 0 with commas")
    return values


def _write(base: Path, title: str, rows: Sequence[Row]) -> list[Path]:
    """Write the rows as JSON and draw their changes."""
    from matplotlib.figure import Figure

    data = base.with_suffix(".json")
    entries = [
        {k: None if isinstance(v, float) and np.isnan(v) else v for k, v in asdict(row).items()}
        for row in rows
    ]
    data.write_text(json.dumps({"case": title, "rows": entries}, indent=1) + "\n")
    names = list(dict.fromkeys(row.variant for row in rows))[1:]
    results = list(dict.fromkeys(row.result for row in rows))
    figure = Figure(figsize=(8.0, 1.5 + 0.3 * len(names)), layout="constrained")
    axes = figure.add_subplot()
    for result in results:
        change = {row.variant: row.change for row in rows if row.result == result}
        axes.plot([change[name] for name in names], range(len(names)), "o", label=result)
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.set_xscale("symlog", linthresh=0.1)
    axes.axvline(0.0, color="0.5", linewidth=0.8)
    axes.set_xlabel("change against the tables as stored, %")
    axes.set_title(title)
    axes.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=2, fontsize="small")
    picture = base.with_suffix(".png")
    figure.savefig(picture, dpi=120)
    return [data, picture]
