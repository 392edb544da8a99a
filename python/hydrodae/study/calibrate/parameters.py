"""What is fitted: numbers of a case within bounds, and offsets of time of records."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.study.calibrate.records import Record
from hydrodae.study.gradient.parameters import Parameter, read_parameter

Keys = str | Sequence[str]


@dataclass(frozen=True)
class Free:
    """A number to be fitted, as a caller gives it.

    Attributes
    ----------
    keys : str or sequence of str
        Dotted keys of the case that have this value: "force.brake.damping",
        "force.water.linear[2]" for a component of a list, "*" within names.
    bounds : (float, float)
        Unit of the key.
    scale : float, optional
        Size of a change that matters; by default the start, else the width of the bounds.
    start : float, optional
        By default the value of the case.
    name : str, optional
        By default the keys.
    """

    keys: Keys
    bounds: tuple[float, float] = (-np.inf, np.inf)
    scale: float | None = None
    start: float | None = None
    name: str | None = None


@dataclass(frozen=True)
class Unknown:
    """A number to be fitted, found in the case, or the offset of a record."""

    name: str
    start: float
    low: float
    high: float
    scale: float
    parameter: Parameter | None  #: None: an offset
    record: int = -1  #: of an offset


def read_free(text: str) -> Free:
    """Read KEY or KEY=LOW,HIGH of a command line.

    Raises
    ------
    CaseError
        It is something else.
    """
    key, equals, bounds = (part.strip() for part in text.partition("="))
    if not key or (equals and not bounds):
        raise CaseError(f"--parameter {text}: expected KEY or KEY=LOW,HIGH")
    if not equals:
        return Free(key)
    try:
        low, high = map(float, bounds.split(","))
    except ValueError:
        raise CaseError(f"--parameter {text}: expected KEY or KEY=LOW,HIGH") from None
    return Free(key, (low, high))


def unknowns(case: Case, free: Sequence[Free | str], records: Sequence[Record]) -> list[Unknown]:
    """Find parameters in a case, and offsets of the records that are fitted.

    Raises
    ------
    CaseError
        A key is not in the case, its value outside the bounds, a size unknown, or a record sets it.
    """
    found = [_unknown(case, Free(one) if isinstance(one, str) else one) for one in free]
    if not found:
        raise CaseError("nothing to fit: name a parameter, such as force.brake.damping")
    taken: set[Any] = set()
    for one in found:
        assert one.parameter is not None
        for place in one.parameter.places:
            if place in taken:
                raise CaseError(f"{one.name}: {place[0]} is fitted twice")
            taken.add(place)
            _check_sets(place[0], records)
    for k, record in enumerate(records):
        if record.fitted and record.offset_bounds is not None:
            low, high = record.offset_bounds
            name = f"offset of {record.name}"
            found.append(Unknown(name, record.offset, low, high, 0.1 * (high - low), None, k))
    names = [one.name for one in found]
    if len(set(names)) != len(names):
        raise CaseError(f"{max(names, key=names.count)}: two parameters have this name")
    return found


def _unknown(case: Case, free: Free) -> Unknown:
    parameter = read_parameter(case, free.keys, free.name)
    name, (low, high) = parameter.name, map(float, free.bounds)
    start = parameter.value if free.start is None else float(free.start)
    if not low < high:
        raise CaseError(f"{name}: bounds: expected least < most, got {low:g} and {high:g}")
    if not low <= start <= high:
        raise CaseError(
            f"{name}: the start {start:g} is outside the bounds {low:g} to {high:g}: give a start"
        )
    scale = free.scale if free.scale is not None else abs(start)
    if scale == 0.0 and free.scale is None:
        if not np.isfinite(high - low):
            raise CaseError(f"{name}: is 0, which gives no size: give both bounds or a scale")
        scale = 0.1 * (high - low)
    if not 0.0 < scale < np.inf:
        raise CaseError(f"{name}: scale: expected a number > 0, got {scale:g}")
    return Unknown(name, start, low, high, scale, parameter)


def _check_sets(key: str, records: Sequence[Record]) -> None:
    for record in records:
        for other in record.set:
            if key == other or key.startswith(f"{other}.") or other.startswith(f"{key}."):
                raise CaseError(f"record {record.name!r} sets {other}, of which {key} is fitted")


def spelled(values: Mapping[str, float]) -> str:
    """Names and values in one line."""
    return ", ".join(f"{name} = {value:g}" for name, value in values.items())
