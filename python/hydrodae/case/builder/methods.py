"""The methods of `hydrodae.Scene`: one for each table, or for each type of a list with types."""

from __future__ import annotations

import inspect
import keyword
import textwrap
from collections.abc import Callable
from typing import Any

from hydrodae.case.builder.base import SceneBase, TypedList
from hydrodae.case.tables import Table, tables


class _NotGiven:
    """Default of the keys that may be left out; the kernel has the values."""

    def __repr__(self) -> str:
        return "..."


def add_tables(scene: type[SceneBase]) -> None:
    """Give the class `scene` a method for each table, or for each type of a list with types."""
    for table in tables():
        if hasattr(scene, table.name):
            raise TypeError(f"the table {table.name} has the name of a method of Scene")
        if table.types:
            setattr(scene, table.name, property(_typed_list(table), doc=table.doc))
        else:
            setattr(scene, table.name, _method(table, table, f"Scene.{table.name}", lambda s: s))


def _typed_list(table: Table) -> Callable[[SceneBase], TypedList]:
    members: dict[str, Any] = {"__doc__": table.doc}
    for kind in table.types:
        members[kind.name] = _method(
            table, kind, f"Scene.{table.name}.{kind.name}", lambda entries: entries._scene
        )
    made = type(f"{table.name.capitalize()}Types", (TypedList,), members)
    return lambda scene: made(scene, table)


def _method(
    table: Table, kind: Table, qualified: str, scene_of: Callable[[Any], SceneBase]
) -> Callable[..., str | None]:
    """The method that adds an entry of this kind."""

    def add(self: Any, /, *args: Any, **keys: Any) -> str | None:
        if args and table.is_list:
            if len(args) > 1 or "name" in keys:
                raise TypeError(f"{qualified}() takes the name first, then keys by their names")
            keys = {"name": args[0], **keys}
        elif args:
            raise TypeError(f"{qualified}() takes keys by their names only")
        if kind is not table:
            if "type" in keys:
                raise TypeError(f"{qualified}() says the type itself")
            name = {"name": keys["name"]} if "name" in keys else {}
            keys = {**name, "type": kind.name, **keys}
        return scene_of(self)._add(table, kind, keys)

    add.__name__ = kind.name
    add.__qualname__ = qualified
    add.__doc__ = docstring(table, kind)
    add.__signature__ = _signature(table, kind)  # type: ignore[attr-defined]
    return add


def docstring(table: Table, kind: Table) -> str:
    """Return the text of the method of a table or a type: meaning, keys with units, errors."""
    head = f"Add `{table.header}`" + (f' with the type "{kind.name}"' if kind is not table else "")
    lines = [f"{head}.", "", *_wrapped(kind.doc), "", "Parameters", "----------"]
    for key in kind.keys:
        if key.name == "type":
            continue
        unit = "" if key.unit == "-" else f", {key.unit}"
        default = (
            "" if key.required else f", default {key.default}" if key.default else ", optional"
        )
        allowed = f" Allowed: {key.allowed}." if key.allowed else ""
        lines += [f"{key.name} : {key.kind_text}{unit}{default}", *_wrapped(key.doc + allowed, 4)]
    for inner in kind.nested:
        names = ", ".join(
            key.name + ("" if key.unit == "-" else f" [{key.unit}]") for key in inner.keys
        )
        lines += [f"{inner.name} : dict, optional", *_wrapped(f"{inner.doc} Keys: {names}.", 4)]
    if table.is_list:
        lines += ["", "Returns", "-------", "str", "    The name, for other calls to refer to."]
    lines += ["", "Raises", "------", "CaseError", "    A key or a value is wrong."]
    return "\n".join(lines)


def _wrapped(text: str, indent: int = 0) -> list[str]:
    space = " " * indent
    return textwrap.wrap(text, 88, initial_indent=space, subsequent_indent=space)


def _signature(table: Table, kind: Table) -> inspect.Signature:
    parameters = [inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)]
    keys = sorted(kind.keys, key=lambda key: not key.required)
    for key in keys:
        if key.name == "type":
            continue
        first = table.is_list and key.name == "name"
        parameters.append(_parameter(key.name, key.required, first))
    parameters += [_parameter(inner.name, False, False) for inner in kind.nested]
    return inspect.Signature(parameters)


def _parameter(name: str, required: bool, first: bool) -> inspect.Parameter:
    if not name.isidentifier() or keyword.iskeyword(name):
        raise TypeError(f"the key {name!r} cannot be an argument in Python")
    sort = inspect.Parameter.POSITIONAL_OR_KEYWORD if first else inspect.Parameter.KEYWORD_ONLY
    return inspect.Parameter(
        name, sort, default=inspect.Parameter.empty if required else _NotGiven()
    )
