"""Parts of MATLAB statements: targets of assignments, arguments, cases and ends of blocks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from hydrodae.wecsim.m_text import NotEvaluated, Statement, Token
from hydrodae.wecsim.old_names import new_name

#: Words that begin a block with an `end`.
OPENERS = ("if", "for", "while", "switch", "function", "try", "parfor")


def shown(statement: Statement) -> str:
    """The text of a statement, cut after 70 characters."""
    return statement.text if len(statement.text) < 70 else statement.text[:67] + "..."


def field_of(kind: str, path: list[str]) -> str:
    """Name of a field without indices, as the present version of WEC-Sim has it."""
    return new_name(kind, ".".join(part for part in path if part[0] != "("))


def without_newlines(tokens: tuple[Token, ...]) -> tuple[Token, ...]:
    """Tokens of a condition, which ends with its line."""
    return tuple(token for token in tokens if token.kind != "newline")


def end_of(parts: list[Statement], at: int) -> int:
    """Index of the `end` of the block that begins at `at`; the length where there is none."""
    depth = 0
    for index in range(at, len(parts)):
        word = parts[index].tokens[0].text
        depth += word in OPENERS
        depth -= word == "end"
        if depth == 0:
            return index
    return len(parts)


def cases_of(parts: list[Statement], at: int, end: int) -> Iterator[int]:
    """Where the cases of a switch block begin, `otherwise` too, those of inner blocks left out."""
    inner = at
    for index in range(at + 1, end):
        word = parts[index].tokens[0].text
        if index > inner and word in OPENERS:
            inner = end_of(parts, index)
        elif index > inner and word in ("case", "otherwise"):
            yield index


def is_equal(value: Any, wanted: Any) -> bool:
    """Whether a switch value is that of a case: equal text, or equal numbers."""
    texts = isinstance(value, str), isinstance(wanted, str)
    return texts[0] == texts[1] and bool(
        value == wanted if texts[0] else np.array_equal(value, wanted)
    )


def assignment(tokens: tuple[Token, ...]) -> int | None:
    """Index of the = of an assignment."""
    depth = 0
    for index, token in enumerate(tokens):
        if token.kind != "operator":
            continue
        depth += token.text in "([{"
        depth -= token.text in ")]}"
        if token.text == "=" and depth == 0:
            return index
    return None


def several_names(tokens: tuple[Token, ...]) -> list[str]:
    """Names of ``[X, ~]`` on the left; empty where it is something else."""
    if len(tokens) < 3 or tokens[0].text != "[" or tokens[-1].text != "]":
        return []
    inside = [token for token in tokens[1:-1] if token.text != ","]
    named = all(t.kind == "name" or t.text == "~" for t in inside)
    return [t.text for t in inside] if named else []


def target_of(tokens: tuple[Token, ...]) -> tuple[str, list[str]]:
    """Name on the left, and its indices ("(1)") and fields."""
    if not tokens or tokens[0].kind != "name":
        raise NotEvaluated("the left side is no name")
    path: list[str] = []
    at = 1
    while at < len(tokens):
        if tokens[at].text == "." and at + 1 < len(tokens) and tokens[at + 1].kind == "name":
            path.append(tokens[at + 1].text)
            at += 2
        elif tokens[at].text == "(":
            close = next((i for i in range(at, len(tokens)) if tokens[i].text == ")"), None)
            if close is None:
                raise NotEvaluated("')' is missing")
            path.append("(" + "".join(t.text for t in tokens[at + 1 : close]) + ")")
            at = close + 1
        else:
            raise NotEvaluated("the left side is not understood")
    return tokens[0].text, path


def without_first(path: list[str]) -> list[str]:
    """``controller(1).x`` is ``controller.x``: a struct of one element."""
    return path[1:] if len(path) > 1 and path[0] == "(1)" else path


def number_in(path: list[str]) -> int:
    """Number of an object from the first index; 1 where there is none."""
    if path and path[0][0] == "(":
        inside = path[0].strip("()").split(",")[-1]
        if not inside.isdecimal() or len(inside) > 9:
            raise NotEvaluated(f"the index {path[0]} is no number")
        return int(inside)
    return 1


def split_arguments(tokens: tuple[Token, ...]) -> Iterator[tuple[Token, ...]]:
    """Arguments between commas."""
    current: list[Token] = []
    depth = 0
    for token in tokens:
        if token.kind == "operator":
            depth += token.text in "([{"
            depth -= token.text in ")]}"
        if token.text == "," and token.kind == "operator" and depth == 0:
            yield tuple(current)
            current = []
        else:
            current.append(token)
    if current:
        yield tuple(current)
