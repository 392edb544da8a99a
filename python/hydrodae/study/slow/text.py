"""Slow loads and motions in words and tables, and what files and JSON have of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from hydrodae.hdb.labels import read_labels
from hydrodae.study.slow.motion import SlowMotion, units
from hydrodae.support.units import displayed

#: A coordinate that moves less than this share of the largest of its unit is not listed.
NOTHING = 1e-9


def table(found: SlowMotion, first_order: Mapping[str, float]) -> str:
    """Return mean and standard deviation of loads, then motions beside those of first order.

    Parameters
    ----------
    found : SlowMotion
    first_order : mapping from str
        Standard deviations of channels in the same sea [m, rad].
    """
    lines = [f"note: slow drift: {note}" for note in found.notes]
    lines.append(
        f"loads of pairs of waves by {found.word!r}: mean and standard deviation of the slow load"
    )
    lines += _loads(found)
    if not found.offset:
        return "\n".join(lines)
    lines.append(
        "mean offset, and standard deviations: slow motion about it, motion in the waves (first "
        "order)"
    )
    names = tuple(found.offset)
    largest: dict[str, float] = {}
    for name, unit in zip(names, units(names), strict=True):
        size = abs(found.offset[name]) + found.standard_deviation.get(name, 0.0)
        largest[unit] = max(largest.get(unit, 0.0), size)
    for name, unit in zip(names, units(names), strict=True):
        slow = found.standard_deviation.get(name, np.nan)
        if abs(found.offset[name]) <= NOTHING * largest[unit] >= slow:
            continue
        factor, shown = displayed(unit)
        cells = (found.offset[name], slow, first_order.get(name, np.nan))
        lines.append(
            f"  {'.'.join(name.split('/')[1:]):38} "
            + " ".join(f"{factor * x:12.5g}" for x in cells)
            + f"  {shown}"
        )
    return "\n".join(lines)


def _loads(found: SlowMotion) -> list[str]:
    lines = []
    turns = [label.is_rotation for label in read_labels(found.labels)]
    sizes = np.abs(found.mean) + found.load_deviation
    for k, (label, turning) in enumerate(zip(found.labels, turns, strict=True)):
        same = [size for size, other in zip(sizes, turns, strict=True) if other == turning]
        if sizes[k] > 1e-6 * max(same):
            lines.append(
                f"  {label:38} {1e-3 * found.mean[k]:12.5g} "
                f"{1e-3 * found.load_deviation[k]:12.5g}  {'kN m' if turning else 'kN'}"
            )
    return lines


def content(found: SlowMotion) -> dict[str, Any]:
    """Return all of it by name, SI units."""
    return {
        "load": found.word,
        "coordinates": found.labels,
        "mean_load": found.mean,
        "load_standard_deviation": found.load_deviation,
        "omega": found.omega,
        "spectrum": found.spectrum,
        "offset": found.offset,
        "standard_deviation": found.standard_deviation,
        "notes": found.notes,
    }
