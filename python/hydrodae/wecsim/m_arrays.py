"""Arrays of MATLAB: indices, growth, meshgrid and reshape."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.m_values import plain, sized


def meshgrid(values: list[Any]) -> list[Any]:
    """X and Y of ``[X, Y] = meshgrid(x, y)``."""
    if not 1 <= len(values) <= 2 or any(isinstance(v, str | list) for v in values):
        raise NotEvaluated("meshgrid takes one or two arrays of numbers here")
    sized(np.size(values[0]), np.size(values[-1]))
    return [np.asarray(a) for a in np.meshgrid(np.ravel(values[0]), np.ravel(values[-1]))]


def places(index: str, shape: tuple[int, int]) -> tuple[list[int], list[int]]:
    """Rows and columns that an index means; one index runs over a row (or a column)."""
    parts = index.strip("()").split(",")
    if len(parts) == 1:
        parts = [parts[0], "1"] if shape[1] == 1 and shape[0] > 1 else ["1", parts[0]]
    if len(parts) != 2:
        raise NotEvaluated(f"the index {index}")
    ranges = []
    for part, size in zip(parts, shape, strict=True):
        ends = [int(end) for end in part.split(":") if end.isdecimal() and int(end) > 0]
        if part == ":":
            ranges.append(list(range(size)))
        elif len(ends) == part.count(":") + 1 <= 3:
            found = range(ends[0] - 1, ends[-1], ends[1] if len(ends) == 3 else 1)
            sized(len(found))
            ranges.append(list(found))
        else:
            raise NotEvaluated(f"the index {index}")
    sized(len(ranges[0]), len(ranges[1]))
    return ranges[0], ranges[1]


def with_elements(old: Any, index: str, value: Any) -> Any:
    """An array with some of its elements replaced, larger where need be."""
    if isinstance(value, str | list):
        raise NotEvaluated("a number is needed")
    array = np.atleast_2d(np.zeros((0, 0)) if old is None else np.array(old, dtype=float))
    rows, columns = places(index, (array.shape[0], array.shape[1]))
    shape = (
        max([array.shape[0], *(row + 1 for row in rows)]),
        max([array.shape[1], *(column + 1 for column in columns)]),
    )
    sized(*shape)
    grown = np.zeros(shape)
    grown[: array.shape[0], : array.shape[1]] = array
    grown[np.ix_(rows, columns)] = np.broadcast_to(np.atleast_2d(value), (len(rows), len(columns)))
    return plain(grown)


def elements(value: Any, index: str) -> Any:
    """Elements of an array by an index such as ``(2,:)``."""
    if isinstance(value, str | list):
        raise NotEvaluated(f"the index {index} of text")
    array = np.atleast_2d(value)
    rows, columns = places(index, (array.shape[0], array.shape[1]))
    try:
        return plain(array[np.ix_(rows, columns)])
    except IndexError:
        raise NotEvaluated(f"the index {index} is out of range") from None
