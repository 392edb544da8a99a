"""Parameters of a case: one number that one key has, or several keys together."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import Any

from hydrodae import _core
from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError

_INDEX = re.compile(r"(?P<key>.+?)\[(?P<index>\d+)\]")


@dataclass(frozen=True)
class Parameter:
    """A number that stands at one place of a case, or at several.

    Attributes
    ----------
    name : str
    value : float
        In the case, unit of the key in the file.
    places : tuple of (str, int or None)
        Dotted keys, and the component where the value there is a list.
    lists : dict
        Values of the keys that are lists.
    """

    name: str
    value: float
    places: tuple[tuple[str, int | None], ...]
    lists: dict[str, list[Any]]

    def values(self, x: float) -> dict[str, Any]:
        """Values of the keys that make the parameter x."""
        out: dict[str, Any] = {}
        for key, index in self.places:
            if index is None:
                out[key] = x
            else:
                out[key] = out.get(key, list(self.lists[key]))
                out[key][index] = x
        return out


def values_of(parameters: Sequence[Parameter], x: Sequence[float]) -> dict[str, Any]:
    """Values of the keys of several parameters, which may be components of one list."""
    out: dict[str, Any] = {}
    for parameter, number in zip(parameters, x, strict=True):
        for key, value in parameter.values(float(number)).items():
            if key in out:
                for place, index in parameter.places:
                    if place == key and index is not None:
                        out[key][index] = float(number)
            else:
                out[key] = value
    return out


def read_parameter(case: Case, keys: str | Sequence[str], name: str | None = None) -> Parameter:
    """Find a parameter in a case.

    Parameters
    ----------
    case : Case
    keys : str or sequence of str
        Dotted keys, as "force.pto.damping"; a name may have the wildcard "*", and a component of a
        list is "body.float.inertia[2]". Several keys are one parameter: they have the same value.
    name : str, optional
        Default: the keys.

    Raises
    ------
    CaseError
        A key is not in the case, has no number, or the keys have different values.
    """
    given, found, lists = _numbers(case, keys)
    values = {*found.values()}
    if len(values) != 1:
        told = ", ".join(f"{key} = {value:g}" for (key, _), value in found.items())
        raise CaseError(f"{', '.join(given)}: one parameter has one value, not {told or 'none'}")
    return Parameter(name or ", ".join(given), values.pop(), tuple(found), lists)


def started(case: Case, keys: str | Sequence[str], x: float) -> Case:
    """Return a case in which all keys of a parameter, whatever they are there, have a value.

    Raises
    ------
    CaseError
        As in `read_parameter`.
    """
    _, found, lists = _numbers(case, keys)
    return case.with_values(Parameter("", x, tuple(found), lists).values(x))


def _numbers(
    case: Case, keys: str | Sequence[str]
) -> tuple[list[str], dict[tuple[str, int | None], float], dict[str, list[Any]]]:
    """The keys as a list, the numbers at their places, and the lists that these are in."""
    given = [keys] if isinstance(keys, str) else list(keys)
    tables = case_tables(case)
    found: dict[tuple[str, int | None], float] = {}
    lists: dict[str, list[Any]] = {}
    for key in given:
        match = _INDEX.fullmatch(key)
        index = int(match["index"]) if match else None
        for dotted, value in _places(tables, match["key"] if match else key, key).items():
            if index is not None:
                if not isinstance(value, list) or index >= len(value):
                    raise CaseError(f"{key!r}: {dotted} = {value!r} has no component {index}")
                lists[dotted], value = value, value[index]
            if isinstance(value, bool) or not isinstance(value, int | float):
                told = "; name a component, such as [0]" if isinstance(value, list) else ""
                raise CaseError(f"{key!r}: expected a number, {dotted} is {value!r}{told}")
            found[dotted, index] = float(value)
    return given, found, lists


def _places(tables: dict[str, Any], key: str, told: str) -> dict[str, Any]:
    """Dotted keys that a key with wildcards means, and their values."""
    nodes: dict[str, Any] = {"": tables}
    for part in key.split("."):
        below = {}
        for head, node in nodes.items():
            children = _children(node)
            for name in [n for n in children if fnmatchcase(n, part)]:
                below[f"{head}.{name}" if head else name] = children[name]
        if not below:
            known = sorted({name for node in nodes.values() for name in _children(node)})
            raise CaseError(
                f"{told!r}: the case has no {part!r}{_core.suggestion(part, known)}: a parameter "
                "is a key that the case file gives a number"
            )
        nodes = below
    return nodes


def _children(node: Any) -> dict[str, Any]:
    if isinstance(node, dict):
        return node
    if isinstance(node, list):
        return {item["name"]: item for item in node if isinstance(item, dict) and "name" in item}
    return {}
