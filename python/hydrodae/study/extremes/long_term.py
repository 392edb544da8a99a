"""Return levels over years: the largest response of all sea states of a scatter table.

The crossings of a level x in a year are the sum over the sea states i,

    n(x) = sum_i t_i c_i(x)

with t_i its time in a year and c_i(x) the rate at which maxima exceed x there: of the linear model
Rice's rate nu_i exp(-x^2 / (2 s_i^2)), of runs -ln G_i(x) / D, G_i the Gumbel distribution of the
largest of a duration D. The level of N years has n(x) = 1 / N; the largest of N years is below x
with probability exp(-N n(x)) (Naess and Moan, Stochastic Dynamics of Marine Structures, 2013,
ch. 12: all sea states, all short-term maxima).
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from hydrodae.case.case import CaseLike
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.study.extremes.channels import Transfer
from hydrodae.study.extremes.gumbel import fit_gumbel, random_gumbel
from hydrodae.study.extremes.likely_wave import spectral_components
from hydrodae.study.extremes.rayleigh import HOUR, Narrow
from hydrodae.study.extremes.samples import read_sweep
from hydrodae.study.extremes.scatter import ScatterTable, read_scatter
from hydrodae.support.arrays import Array

#: Hours of a year on average.
YEAR = 8766.0
#: Copies of the parameters: the 2.5 % end is then the 25th smallest, +-5.
COPIES = 1000
#: Fewest seeds of a sea state: intervals of so few cover 90 to 99 of 100, as
#: tests/verification/test_extremes_years.py measures; nothing is known of fewer.
FEWEST = 5
_SEED = "seed"
#: Columns of sea states of the table.
State = dict[str, float]


@dataclass(frozen=True)
class LongTerm:
    """Return levels; printed, what the command prints.

    Attributes
    ----------
    channel, unit : str
    years : tuple of float
        Return periods.
    levels : (n,) array
        Level of each [unit], about the value at rest for a linear model.
    intervals : (n, 2) array
        95 % interval of each level; nan of the linear model, which has no sampling
        error.
    ranges : (n, 2) array
        Levels between which the largest of so many years lies with 95 %.
    states : list of dict
        Each sea state with its height [m], period [s], hours a year, and share [-] of the crossings
        of the level of the longest return period.
    hours : float
        Hours a year of the table.
    source : str
        "linear" or "runs".
    """

    channel: str
    unit: str
    years: tuple[float, ...]
    levels: Array
    intervals: Array
    ranges: Array
    states: list[State]
    hours: float
    source: str
    least: bool = False

    def __str__(self) -> str:
        from hydrodae.study.extremes.text import long_term

        return long_term(self)


def _level(crossings: Callable[[float], float], wanted: float, low: float, high: float) -> float:
    """Level with a number of crossings; they fall with the level."""
    width = high - low
    while crossings(high) > wanted:
        high += width
    while crossings(low) < wanted:
        low -= width
    return float(brentq(lambda x: math.log(crossings(x) / wanted), low, high, xtol=1e-10 * width))


def check_years(years: float | Sequence[float]) -> tuple[float, ...]:
    """Return the return periods [years]; raises CaseError if one is not positive."""
    found = tuple(float(y) for y in np.atleast_1d(np.asarray(years, dtype=float)))
    if not found or not all(0.0 < y < math.inf for y in found):
        raise CaseError(f"years {list(found)}: expected numbers > 0", key="years")
    return found


def linear_long_term(
    case: CaseLike,
    channel: str,
    scatter: str | os.PathLike[str] | ScatterTable,
    *,
    years: float | Sequence[float] = (1.0, 10.0, 50.0),
    wave: str | None = None,
    components: int = 500,
    set: Mapping[str, Any] | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> LongTerm:
    """Return levels of a linear response over all sea states of a scatter table.

    Parameters
    ----------
    case : Case, Scene or path
        With an irregular wave that has a height and a period.
    channel : str
        Of the linear model, as for `likely_wave`.
    scatter : path or ScatterTable
        CSV with the columns height [m], peak period [s], hours a year.
    years : float or sequence of float
        Return periods.
    wave : str, optional
        Name of the wave whose height and period the table gives; default: the only one.
    components : int
    set : mapping from str, optional
    progress : callable, optional
        Called with the numbers of finished and of all periods.

    Raises
    ------
    CaseError
        No such channel or wave, or the table cannot be used.
    DatabaseError
        Waves are outside the database.
    """
    table = scatter if isinstance(scatter, ScatterTable) else read_scatter(scatter)
    wanted = check_years(years)
    model = LinearModel.of(case, set)
    transfer = Transfer(model)
    transfer.check(channel)
    name = _wave_name(model, wave)
    by_period: dict[float, Narrow] = {}
    periods = np.unique(table.period)
    for k, period in enumerate(periods.tolist(), 1):
        keys = {f"wave.{name}.significant_height": 1.0, f"wave.{name}.peak_period": period}
        waves = spectral_components(model.case.with_values(keys), components)
        energy = 0.5 * waves[:, 2] ** 2 * np.abs(transfer.in_waves(channel, waves)) ** 2
        by_period[period] = Narrow.of(waves[:, 0], energy)
        if progress is not None:
            progress(k, len(periods))
    rate = np.array([by_period[t].rate for t in table.period.tolist()])
    deviation = table.height * [by_period[t].deviation for t in table.period.tolist()]
    seconds = table.hours * HOUR

    def crossings(level: float) -> Array:
        return np.asarray(seconds * rate * np.exp(-0.5 * (level / deviation) ** 2))

    top = 3.0 * float(deviation.max())
    levels, ranges = [], []
    for n in wanted:
        if float((seconds * rate).sum()) * n <= 1.0:
            raise CaseError(f"{n:g} years: not one crossing of the mean; the hours are too few")
        levels.append(_level(lambda x: float(crossings(x).sum()), 1.0 / n, 0.0, top))
        ranges.append(_range(lambda x: float(crossings(x).sum()), n, top))
    states = _states(table, crossings(levels[int(np.argmax(wanted))]))
    unit = transfer.units[channel]
    none = np.full((len(wanted), 2), np.nan)
    return LongTerm(
        channel, unit, wanted, np.array(levels), none, np.array(ranges), states,
        float(table.hours.sum()), "linear",
    )  # fmt: skip


def _range(crossings: Callable[[float], float], years: float, top: float) -> tuple[float, float]:
    """Levels that the largest of so many years is below with 2.5 and with 97.5 %."""
    low, high = (-math.log(p) / years for p in (0.025, 0.975))
    return _level(crossings, low, 0.0, top), _level(crossings, high, 0.0, top)


def _wave_name(model: LinearModel, wave: str | None) -> str:
    from hydrodae.case.contents import case_tables
    from hydrodae.support.nearest import did_you_mean

    waves = {w["name"]: w for w in case_tables(model.case).get("wave", [])}
    if not waves:
        raise CaseError("the case has no [[wave]]: the scatter table needs one to give its values")
    if wave is None and len(waves) > 1:
        raise CaseError(f"name the wave that the table is of: {', '.join(waves)}")
    name = next(iter(waves)) if wave is None else wave
    if name not in waves:
        known = f"; there are: {', '.join(waves)}"
        raise CaseError(f"the case has no wave {name!r}{did_you_mean(name, waves, known)}")
    if "peak_period" not in waves[name]:
        raise CaseError(
            f"wave {name!r} is of type {waves[name]['type']}, without a peak_period; the table "
            "needs one such as jonswap or bretschneider"
        )
    return name


def _states(table: ScatterTable, crossings: Array) -> list[State]:
    share = crossings / crossings.sum()
    rows = zip(table.height, table.period, table.hours, share, strict=True)
    names = ("height", "period", "hours", "share")
    return [dict(zip(names, map(float, row), strict=True)) for row in rows]


def runs_long_term(
    sweep: str | os.PathLike[str],
    result: str,
    scatter: str | os.PathLike[str] | ScatterTable,
    *,
    years: float | Sequence[float] = (1.0, 10.0, 50.0),
    copies: int = COPIES,
    progress: Callable[[float, float], None] | None = None,
) -> LongTerm:
    """Return levels from the runs of a sweep over height, period and seed.

    The largest values of the seeds of a sea state have a Gumbel distribution. The interval is a
    generalised one (Weerahandi, JASA 88, 1993): with loc', scale' of fits to standard samples of as
    many seeds, scale / scale' and loc - loc' scale / scale' stand for the true parameters. For one
    sea state it is exact, as the distribution has a location and a scale only.

    Parameters
    ----------
    sweep : path
        Its table, with a [grid] of significant_height, peak_period and seed.
    result : str
        Name of a result with the statistic max or min.
    scatter : path or ScatterTable
        Sea states that the grid has; CSV with the columns height [m], period [s], hours a year.
    years : float or sequence of float
        Return periods.
    copies : int
        Of the parameters, for the interval.
    progress : callable, optional
        Called with the numbers of finished and of all copies.

    Raises
    ------
    CaseError
        The sweep has no such result or sea state, or too few runs in one.
    """
    table = scatter if isinstance(scatter, ScatterTable) else read_scatter(scatter)
    wanted = check_years(years)
    found = read_sweep(sweep, result)
    samples = _of_states(found.values, found.keys, table)
    kinds = sorted({len(x) for x in samples})
    seconds = table.hours * HOUR / found.seconds
    fitted = np.array([[*fit_gumbel(x)] for x in samples], dtype=float)

    def level_of(gumbel: Array, n: float) -> float:
        loc, scale = gumbel.T

        def crossings(x: float) -> float:
            return float(np.sum(seconds * np.exp(-np.clip((x - loc) / scale, -500.0, 500.0))))

        top = float((loc + 10.0 * scale).max())
        return _level(crossings, 1.0 / n, float(loc.min()), top)

    levels = np.array([level_of(fitted, n) for n in wanted])
    generator = np.random.default_rng(1)
    drawn = np.empty((copies, len(samples), 2))
    for count in kinds:
        mine = np.array([len(x) == count for x in samples])
        loc, scale = fit_gumbel(random_gumbel(generator, (copies, int(mine.sum()), count)))
        scales = fitted[mine, 1] / scale
        drawn[:, mine] = np.stack([fitted[mine, 0] - scales * loc, scales], axis=-1)
    copied = np.empty((copies, len(wanted)))
    for k in range(copies):
        copied[k] = [level_of(drawn[k], n) for n in wanted]
        if progress is not None and k % 20 == 19:
            progress(k + 1, copies)
    intervals = np.quantile(copied, [0.025, 0.975], axis=0).T
    ranges = np.array(
        [[level_of(fitted, n / -math.log(p)) for p in (0.025, 0.975)] for n in wanted]
    )
    rate = seconds * np.exp(-(levels[int(np.argmax(wanted))] - fitted[:, 0]) / fitted[:, 1])
    least = found.sign < 0.0
    if least:
        levels, intervals, ranges = -levels, -intervals[:, ::-1], -ranges[:, ::-1]
    hours = float(table.hours.sum())
    states = _states(table, rate)
    return LongTerm(
        result, found.unit, wanted, levels, intervals, ranges, states, hours, "runs", least
    )


def _of_states(values: Any, keys: Mapping[str, str], table: ScatterTable) -> list[Array]:
    """Values of the runs of each sea state of the table."""
    axes = {}
    for what in ("significant_height", "peak_period"):
        named = [d for d, key in keys.items() if key.rpartition(".")[2] == what]
        if len(named) != 1:
            raise CaseError(f"the sweep needs one key {what} in its [grid], and has {len(named)}")
        axes[what] = named[0]
    others = [d for d in values.dims if d not in axes.values()]
    strange = [str(d) for d in others if not keys.get(str(d), "").endswith(".seed")]
    if strange:
        raise CaseError(f"the sweep varies {', '.join(strange)} as well: select one of it")
    ordered = values.transpose(*axes.values(), *others)
    heights, periods = (np.asarray(values[d], dtype=float) for d in axes.values())
    samples = []
    for h, t in zip(table.height, table.period, strict=True):
        i, j = np.flatnonzero(np.isclose(heights, h)), np.flatnonzero(np.isclose(periods, t))
        if not len(i) or not len(j):
            raise CaseError(f"the sweep lacks the sea state of {h:g} m and {t:g} s")
        runs = np.asarray(ordered[i[0], j[0]], dtype=float).ravel()
        runs = runs[np.isfinite(runs)]
        if len(runs) < FEWEST:
            raise CaseError(
                f"{len(runs)} runs of {h:g} m and {t:g} s: a distribution needs at least {FEWEST} "
                "seeds of each sea state",
                key=_SEED,
            )
        samples.append(runs)
    return samples
