"""Functions of MATLAB on text, cell arrays and positions in arrays."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.m_values import Handle, function_value, plain

Call = Callable[[str, list[Any]], Any]


def called(name: str, values: list[Any], call: Call) -> Any:
    """Value of a function of MATLAB.

    Parameters
    ----------
    name : str
    values : list
        Of its arguments.
    call : function
        Value of a function that an argument names.

    Raises
    ------
    NotEvaluated
        It is not known here, or its arguments are others than it takes here.
    """
    if name == "arrayfun" and len(values) == 4 and isinstance(values[0], Handle):
        if values[2] != "UniformOutput" or values[3]:
            raise NotEvaluated("arrayfun without 'UniformOutput', false")
        return [call(values[0], [plain(value)]) for value in np.ravel(values[1], order="F")]
    if name in ("strcat", "append") and any(isinstance(value, list) for value in values):
        return _joined_each(values)
    if name == "isequal" and len(values) == 2:
        texts = {isinstance(value, str) for value in values}
        same = values[0] == values[1] if texts == {True} else np.array_equal(*values)
        return float(len(texts) == 1 and bool(same))
    if name in _ONE and len(values) == 1 and not isinstance(values[0], str | list):
        return _ONE[name](values[0])
    return function_value(name, values)


def extreme(name: str, values: list[Any]) -> list[Any]:
    """Value and index of ``[value, index] = min(x)`` or max; the first of equal ones.

    Raises
    ------
    NotEvaluated
        The argument is no row or column of numbers.
    """
    array = np.atleast_2d(values[0]) if len(values) == 1 else np.zeros((2, 2))
    if array.dtype.kind not in "bif" or 1 not in array.shape or not array.size:
        raise NotEvaluated(f"[value, index] = {name} of something else than a row of numbers")
    at = int(np.argmin(array) if name == "min" else np.argmax(array))
    return [float(array.flat[at]), float(at + 1)]


def _joined_each(values: list[Any]) -> list[str]:
    """Texts of ``strcat`` with cell arrays, element by element."""
    counts = {len(value) for value in values if isinstance(value, list)}
    parts = [value if isinstance(value, list) else [value] * max(counts) for value in values]
    if len(counts) != 1 or not all(isinstance(text, str) for part in parts for text in part):
        raise NotEvaluated("strcat of cell arrays that differ in length, or hold numbers")
    return ["".join(texts) for texts in zip(*parts, strict=True)]


def _num2str(value: Any) -> str:
    """A number with four digits after the point at least, as MATLAB writes it."""
    if np.size(value) != 1 or not np.isfinite(value):
        raise NotEvaluated("num2str of something else than one number")
    number = float(np.ravel(value)[0])
    digits = math.floor(math.log10(abs(number))) + 5 if number else 5
    return f"{number:.{min(max(digits, 5), 16)}g}"


def _find(value: Any) -> Any:
    return plain(np.flatnonzero(np.ravel(value, order="F"))[None, :] + 1.0)


def _wrap_to_360(value: Any) -> Any:
    wrapped = np.mod(value, 360.0)
    return plain(np.where((wrapped == 0.0) & (np.asarray(value) > 0.0), 360.0, wrapped))


def _wrap_to_180(value: Any) -> Any:
    array = np.asarray(value, dtype=float)
    wrapped = _wrap_to_360(array + 180.0) - 180.0
    return plain(np.where(np.abs(array) <= 180.0, array, wrapped))


_ONE: dict[str, Callable[[Any], Any]] = {
    "num2str": _num2str,
    "find": _find,
    "wrapTo360": _wrap_to_360,
    "wrapTo180": _wrap_to_180,
    "isempty": lambda value: float(np.size(value) == 0),
}
