"""Design values of a response from maxima of runs."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.study.extremes.distributions import FAMILIES
from hydrodae.study.extremes.fit import Fit, Level, fit_maxima
from hydrodae.study.extremes.peaks import Clusters, block_maxima, clusters
from hydrodae.study.extremes.rayleigh import HOUR, crossings_of, once
from hydrodae.study.extremes.samples import SWEEP, read_records, read_sweep
from hydrodae.support.nearest import did_you_mean

#: Blocks of one duration that default to this number: fits of 30 maxima cover as they should.
BLOCKS = 30


@dataclass(frozen=True)
class Design:
    """A level for each duration, from a fitted distribution; printed, what the command prints.

    Attributes
    ----------
    channel, unit : str
    fit : Fit
    hours : tuple of float
        Durations [h].
    levels : tuple of Level
        Of each duration, in the unit of the channel.
    exceedance : float
        Probability that the largest of a duration exceeds its level.
    least : bool
        Least values: the fit is of the values with their sign turned round.
    clusters : Clusters or None
        Of peaks over a threshold.
    notes : list of str
    """

    channel: str
    unit: str
    fit: Fit
    hours: tuple[float, ...]
    levels: tuple[Level, ...]
    exceedance: float
    least: bool = False
    clusters: Clusters | None = None
    notes: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        from hydrodae.study.extremes.text import design

        return design(self)


def design_value(
    paths: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    channel: str,
    *,
    distribution: str = "gev",
    block: float | None = None,
    threshold: float | None = None,
    hours: float | Sequence[float] = 3.0,
    exceedance: float | None = None,
    least: bool = False,
    start: float | None = None,
    progress: Callable[[float, float], None] | None = None,
) -> Design:
    """Fit a distribution to extremes of runs, and return levels with 95 % intervals.

    Parameters
    ----------
    paths : path or sequence of path
        Results files of runs in one sea state (one long run, or several seeds), or the table of a
        sweep (.nc) whose result `channel` is a max or min, one block a run.
    channel : str
        Such as "joints/hinge/angle", "bodies/buoy/position.z"; of a sweep the name of a result.
    distribution : str
        "gev" or "gumbel" of block maxima, "gpd" of clusters of crests over a threshold.
    block : float, optional
        Duration of a block [s]; default: the records have 30.
    threshold : float, optional
        Default: a tenth of the crests exceed it. Of least values that below which they lie.
    hours : float or sequence of float
        Durations [h].
    exceedance : float, optional
        Probability that the largest of a duration exceeds the level; default 1 - 1/e, the most
        probable largest, which is exceeded once on average.
    least : bool
        Least values in place of the largest; those of a sweep follow its statistic.
    start : float, optional
        First sample that counts [s]; default: the end of the ramp.
    progress : callable, optional
        Called with the numbers of read and of all files.

    Raises
    ------
    CaseError
        There are too few maxima, the threshold is too high, a value cannot be used.
    ChannelError, ResultsError
        There is no such channel, or a file cannot be read.
    """
    files = [paths] if isinstance(paths, str | os.PathLike) else list(paths)
    durations = [float(h) for h in np.atleast_1d(np.asarray(hours, dtype=float))]
    if not files or not all(0.0 < h < math.inf for h in durations):
        raise CaseError("hours: expected numbers > 0") if files else CaseError("no results file")
    if distribution not in FAMILIES:
        raise CaseError(
            f"distribution {distribution!r}: expected one of {', '.join(FAMILIES)}"
            + did_you_mean(distribution, FAMILIES)
        )
    family = FAMILIES[distribution]
    if family.blocks and threshold is not None:
        raise CaseError(f"threshold belongs to gpd; {distribution} takes the maxima of blocks")
    if not family.blocks and block is not None:
        raise CaseError("block belongs to gev and gumbel; gpd takes crests over a threshold")
    if block is not None and not 0.0 < block < math.inf:
        raise CaseError(f"block {block:g} s: expected a number > 0")
    share = once() if exceedance is None else exceedance
    crossings = crossings_of(share)
    found: Clusters | None = None
    if any(os.fspath(path).lower().endswith(SWEEP) for path in files):
        if len(files) > 1 or not family.blocks or block is not None or start is not None or least:
            raise CaseError(
                "the table of a sweep stands alone, one block a run: gev or gumbel, without block, "
                "start or least"
            )
        sweep = read_sweep(files[0], channel)
        unit, least = sweep.unit, sweep.sign < 0.0
        _check_one_sea(sweep.keys, sweep.values.dims)
        values = sweep.values.to_numpy().ravel()
        fit = fit_maxima(values[np.isfinite(values)], sweep.seconds, distribution)
    else:
        records, unit = read_records(files, channel, least=least, start=start, progress=progress)
        if family.blocks:
            total = sum(record.duration for record in records)
            span = total / BLOCKS if block is None else block
            span = min(span, min(r.duration for r in records)) if block is None else span
            fit = fit_maxima(block_maxima(records, span), span, distribution)
        else:
            limit = threshold if threshold is None or not least else -threshold
            found = clusters(records, limit)
            count = max(1, len(found.peaks))
            fit = fit_maxima(found.peaks, found.duration / count, distribution, found.threshold)
    levels = [fit.level(h * HOUR, crossings) for h in durations]
    if least:
        levels = [Level(-x.value, -x.high, -x.low) for x in levels]
    notes = []
    if fit.at_end:
        notes.append(
            f"the shape, {fit.shape:.2g}, is at the end of the range of the fit: the maxima do not "
            "follow this distribution"
        )
    return Design(channel, unit, fit, tuple(durations), tuple(levels), share, least, found, notes)


def _check_one_sea(keys: dict[str, str], dims: Sequence[object]) -> None:
    """Only seeds vary in a sweep that is one sample."""
    varies = [keys.get(str(d), str(d)) for d in dims if not keys.get(str(d), "").endswith(".seed")]
    if varies:
        raise CaseError(
            f"the sweep varies {', '.join(varies)}: its maxima are of several sea states; "
            "'hydrodae extremes years' takes them with a scatter table"
        )
