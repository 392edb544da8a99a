"""Functions that a caller gives for what a case declares: their names, and what they are."""

from __future__ import annotations

import contextlib
import dis
import functools
import hashlib
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import CodeType, FunctionType, MethodType
from typing import TYPE_CHECKING, Any

from hydrodae.errors import CaseError
from hydrodae.support.nearest import did_you_mean

if TYPE_CHECKING:
    from hydrodae._core import Scene

#: Files of functions that are not of the caller.
_LIBRARY = re.compile(r"(site|dist)-packages[/\\]|[/\\]lib(64)?[/\\]python3|^<frozen")


def check_names(
    given: Mapping[str, Any],
    declared: Sequence[str],
    *,
    argument: str,
    kind: str,
    owner: str,
    signature: str = "function",
) -> None:
    """Check that there is a function for every declared name, and none for another.

    Parameters
    ----------
    given : mapping from str to callable
    declared : sequence of str
        Names in the case that need a function.
    argument : str
        Name of the argument that they are given in, such as "forces".
    kind : str
        What a declared name is, such as "force of type python_load".
    owner : str
        What it is called in the case, such as "force".
    signature : str
        How such a function is called.

    Raises
    ------
    CaseError
        A name is none of the declared ones, one of these has no function, or what it has is none.
    """
    for name, function in given.items():
        if name not in declared:
            raise CaseError(
                f"{argument}: {name!r} is no {kind}{did_you_mean(name, declared)} "
                f"(valid: {', '.join(declared) or 'none in this case'})"
            )
        if not callable(function):
            raise CaseError(f"{argument}: {name!r} needs a {signature}, got {function!r}")
    for name in declared:
        if name not in given:
            raise CaseError(
                f"{owner} {name!r} is a Python function, which nobody gave; run the case as "
                f'hydrodae.run(case, {argument}={{"{name}": function}}), or give `hydrodae run` or '
                "`hydrodae sweep` the option --functions FILE.py"
            )


def with_functions(scene: Scene, **given: Mapping[str, Callable[..., Any]] | None) -> Scene:
    """Return a copy of a scene that counts the functions of a run among its files.

    A function counts by its compiled source, by that of the functions which it calls by name, and
    by the constants that it takes from outside and does not change. An object counts by the source
    of its class: its attributes are state.

    Parameters
    ----------
    scene : Scene
    given : mapping from str to callable, or None
        By the argument of `hydrodae.run`, such as ``forces={"spring": law}``.
    """
    digests = {
        f"{argument}.{name}": _digest(function)
        for argument, functions in given.items()
        for name, function in (functions or {}).items()
    }
    return scene.with_functions(digests) if digests else scene


def _digest(function: Callable[..., Any]) -> str:
    return hashlib.sha256("\0".join(_parts(function, set())).encode()).hexdigest()


def _parts(of: Any, seen: set[int]) -> Iterator[str]:
    """Texts that change with the source of a function or object."""
    if id(of) in seen:
        return
    seen.add(id(of))
    if isinstance(of, functools.partial):
        yield from map(repr, filter(_is_plain, [*of.args, *of.keywords.values()]))
        yield from _parts(of.func, seen)
    elif isinstance(of, MethodType):
        yield from _parts(of.__func__, seen)
        yield from _parts(of.__self__, seen)
    elif isinstance(of, FunctionType):
        codes = list(_codes(of.__code__))
        for code in codes:
            yield from (code.co_code.hex(), repr(code.co_names), *map(_constant, code.co_consts))
        yield from _held(of, codes, seen)
    else:
        for kind in type(of).__mro__:
            yield kind.__qualname__
            for member in vars(kind).values():
                if isinstance(member, FunctionType):
                    yield from _parts(member, seen)


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


def _constant(value: Any) -> str:
    """A constant of compiled source as text, the same in each process."""
    if isinstance(value, CodeType):
        return ""
    return repr(sorted(map(repr, value))) if isinstance(value, frozenset) else repr(value)


def _held(function: FunctionType, codes: list[CodeType], seen: set[int]) -> Iterator[str]:
    """Constants and functions that a function takes from outside and does not change."""
    changed = {
        step.argval
        for code in codes
        for step in dis.get_instructions(code)
        if step.opname in ("STORE_GLOBAL", "STORE_DEREF")
    }
    names = sorted({name for code in codes for name in code.co_names})
    outside = {name: function.__globals__[name] for name in names if name in function.__globals__}
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        with contextlib.suppress(ValueError):  # a cell without content
            outside[name] = cell.cell_contents
    defaults = [*(function.__defaults__ or ()), *(function.__kwdefaults__ or {}).values()]
    yield from map(repr, filter(_is_plain, defaults))
    for name, value in outside.items():
        if name not in changed and _is_plain(value):
            yield f"{name} = {value!r}"
        elif isinstance(value, FunctionType) and not _LIBRARY.search(value.__code__.co_filename):
            yield from _parts(value, seen)


def _is_plain(value: Any) -> bool:
    if isinstance(value, tuple):
        return all(map(_is_plain, value))
    return isinstance(value, type(None) | bool | int | float | complex | str | bytes)
