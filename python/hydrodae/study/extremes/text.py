"""What `hydrodae extremes` prints."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydrodae.study.extremes.rayleigh import interval
from hydrodae.support.units import displayed, prefixed

#: Units that have thousands.
LARGE = ("N", "N m", "W", "J", "Pa")


def in_unit(size: float, unit: str) -> tuple[float, str]:
    """Factor and unit in which numbers up to `size` are printed.

    Examples
    --------
    >>> in_unit(2.5e6, "N m"), in_unit(0.3, "m")
    ((1e-06, 'MN m'), (1.0, 'm'))
    """
    if unit in LARGE:
        return prefixed(size, unit)
    return displayed(unit)


def likely_wave(found: Any) -> str:
    """Crest, trough and response of the most likely wave."""
    factor, unit = in_unit(found.level, found.unit)
    lines = [f"note: {note}" for note in found.notes]
    lines.append(f"most likely wave for {found.channel}, peak at {found.time:g} s:")
    lines.append(f"  response {factor * found.level:.5g} {unit} about its value at rest")
    if found.at_rest:
        lines[-1] += f", {factor * (found.at_rest + found.level):.5g} {unit} in all"
    if found.hours is not None and found.exceedance is not None:
        ends = [factor * x for x in interval(found.narrow, found.hours)]
        lines.append(
            f"  the largest of {found.hours:g} h exceeds it with {100 * found.exceedance:.3g} %, "
            f"and lies between {ends[0]:.4g} and {ends[1]:.4g} {unit} with 95 %"
        )
    lines.append(f"  crest {found.crest:.4g} m, trough {found.trough:.4g} m at the origin")
    lines.append(
        f"  standard deviation in the sea {factor * found.narrow.deviation:.4g} {unit}, mean "
        f"period {found.narrow.period:.4g} s, {len(found.waves)} components"
    )
    return "\n".join(lines)


def design(found: Any) -> str:
    """Levels of each duration with their intervals, and how well the distribution fits."""
    fit = found.fit
    factor, unit = in_unit(max(abs(x.value) for x in found.levels), found.unit)
    sign = -1.0 if found.least else 1.0
    correlation, away = fit.qq()
    what = "blocks of" if fit.family.blocks else "clusters, one in"
    lines = [f"note: {note}" for note in found.notes]
    lines.append(
        f"{found.channel}: {fit.family.title} distribution of "
        f"{'least' if found.least else 'largest'} values, {len(fit.maxima)} {what} "
        f"{fit.span:.4g} s"
    )
    if found.clusters is not None:
        lines.append(
            f"  threshold {sign * factor * found.clusters.threshold:.4g} {unit}, "
            f"{found.clusters.exceedances} crests beyond it, extremal index "
            f"{found.clusters.extremal_index:.3f}"
        )
    lines.append(
        f"  location {sign * factor * fit.loc:.4g} {unit}, scale {factor * fit.scale:.4g} {unit}, "
        f"shape {fit.shape:.3g}"
    )
    lines.append(
        f"  quantiles: correlation {correlation:.4f}, difference {100 * away:.2g} % of the "
        "standard deviation"
    )
    lines.append(f"  {'duration':>10} {'level, ' + unit:>14}   95 % interval, exceeded with "
                 f"{100 * found.exceedance:.3g} %")  # fmt: skip
    for hours, level in zip(found.hours, found.levels, strict=True):
        ends = [factor * x for x in (level.low, level.high)]
        lines.append(
            f"  {hours:8.4g} h {factor * level.value:14.5g}   {ends[0]:.4g} to {ends[1]:.4g}"
        )
    return "\n".join(lines)


def long_term(found: Any) -> str:
    """Return levels, and the sea states that most of their crossings are from."""
    factor, unit = in_unit(float(np.abs(found.levels).max()), found.unit)
    how = "linear model" if found.source.startswith("l") else "Gumbel distributions of runs"
    lines = [f"{found.channel}: {how}, {len(found.states)} sea states, {found.hours:g} h a year"]
    head = "" if np.isnan(found.intervals).all() else "   95 % interval"
    lines.append(f"  {'years':>8} {'level, ' + unit:>14}   largest of the years, 95 %{head}")
    rows = zip(found.years, found.levels, found.ranges, found.intervals, strict=True)
    for years, level, between, ends in rows:
        line = f"  {years:8.4g} {factor * level:14.5g}   "
        line += f"{factor * between[0]:.4g} to {factor * between[1]:.4g}".ljust(26)
        if np.isfinite(ends).all():
            line += f"   {factor * ends[0]:.4g} to {factor * ends[1]:.4g}"
        lines.append(line.rstrip())
    lines.append(f"  crossings of the level of {max(found.years):g} years are from")
    for state in sorted(found.states, key=lambda one: -one["share"])[:5]:
        lines.append(
            f"    {state['height']:5.3g} m, {state['period']:5.3g} s: {100 * state['share']:5.1f} %"
        )
    return "\n".join(lines)


def contour(found: Any) -> str:
    """Joint model, and the sea states of each contour."""
    m = found.model
    lines = [f"note: {note}" for note in found.notes]
    lines.append(
        f"height: Weibull, scale {m.scale:.4g} m, shape {m.shape:.4g}, location {m.location:.4g} m"
    )
    lines.append(
        f"ln T: mean {m.a1:.4g} {m.a2:+.4g} h^{m.a3:.4g}, "
        f"deviation {m.b1:.4g} {m.b2:+.4g} e^({m.b3:.4g} h)"
    )
    for years, heights, periods in zip(found.years, found.heights, found.periods, strict=True):
        lines.append(
            f"contour of {years:g} years, sea states of {found.hours:g} h: highest "
            f"{heights.max():.4g} m at {periods[np.argmax(heights)]:.4g} s"
        )
        lines.append(f"  {'height, m':>10} {'period, s':>10}")
        lines += [f"  {h:10.4g} {t:10.4g}" for h, t in zip(heights, periods, strict=True)]
    return "\n".join(lines)
