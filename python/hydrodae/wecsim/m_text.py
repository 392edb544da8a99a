"""Statements of a MATLAB file: comments, continuations and strings taken apart."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import numpy as np

from hydrodae.errors import HydrodaeError

_TOKEN = re.compile(
    r"(?P<space>[ \t]+)"
    r"|(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+)?)"
    r"|(?P<name>[A-Za-z]\w*)"
    r"|(?P<operator>\.\^'?|\.\*|\./|\.'|==|~=|!=|<=|>=|&&|\|\||[-+*/\\^(){}\[\],;:=<>~!@.&|?])"
    r"|(?P<newline>\n)"
)


class NotEvaluated(HydrodaeError):
    """An expression that is not understood here."""


@contextmanager
def understood() -> Iterator[None]:
    """Turn what Python and NumPy raise at values that do not fit into NotEvaluated."""
    try:
        with np.errstate(all="ignore"):
            yield
    except HydrodaeError:
        raise
    except RecursionError:
        raise NotEvaluated("it is nested too deeply") from None
    except (
        ArithmeticError,
        AttributeError,
        LookupError,
        MemoryError,
        TypeError,
        ValueError,
    ) as why:
        raise NotEvaluated(f"the values do not fit: {why}") from None


class Quoted(str):
    """A string in double quotes: several in brackets are an array, not one string."""

    __slots__ = ()


@dataclass(frozen=True)
class Token:
    """A piece of a statement; `spaced`: white space stands before it."""

    kind: str
    text: str
    line: int
    spaced: bool


@dataclass(frozen=True)
class Statement:
    """Tokens of one statement, the line where it starts and its text."""

    tokens: tuple[Token, ...]
    line: int
    text: str


def statements(text: str) -> list[Statement]:
    """Split a file into statements, comments taken out."""
    found: list[Statement] = []
    current: list[Token] = []
    depth = 0
    for token in _tokens(_without_block_comments(text)):
        if token.kind == "operator" and token.text in "([{":
            depth += 1
        elif token.kind == "operator" and token.text in ")]}":
            depth -= 1
        ends = token.kind == "newline" or token.text in (";", ",")
        if depth <= 0 and ends and token.kind != "string":
            depth = 0
            _close(current, found)
        else:
            current.append(token)
    _close(current, found)
    return found


def _close(tokens: list[Token], found: list[Statement]) -> None:
    if tokens:
        text = "".join((" " if t.spaced else "") + _shown(t) for t in tokens).strip()
        found.append(Statement(tuple(tokens), tokens[0].line, " ".join(text.split())))
        tokens.clear()


def _shown(token: Token) -> str:
    return f"'{token.text}'" if token.kind == "string" else token.text


def _without_block_comments(text: str) -> str:
    """Lines within %{ and %} emptied, so that line numbers stay."""
    lines, depth = [], 0
    for line in text.replace("\r\n", "\n").replace("\r", "\n").split("\n"):
        if line.strip() in ("%{", "#{"):
            depth += 1
        lines.append("" if depth else line)
        if line.strip() in ("%}", "#}"):
            depth = max(depth - 1, 0)
    return "\n".join(lines)


def _tokens(text: str) -> list[Token]:
    tokens: list[Token] = []
    brackets: list[str] = []
    at, line, spaced = 0, 1, False
    while at < len(text):
        character = text[at]
        if character == "%" or text.startswith("...", at):
            end = text.find("\n", at)
            end = len(text) if end < 0 else end
            if character != "%":
                end, line, spaced = min(end + 1, len(text)), line + 1, True
            at = end
            continue
        if character in "'\"" and not (character == "'" and _transposes(tokens, spaced, brackets)):
            begin = at
            string, at = _string(text, at, line)
            double = text[begin] == '"'
            tokens.append(Token("string", Quoted(string) if double else string, line, spaced))
            spaced = False
            continue
        if character == "'":
            tokens.append(Token("operator", "'", line, spaced))
            at, spaced = at + 1, False
            continue
        match = _TOKEN.match(text, at)
        if match is None:
            tokens.append(Token("unknown", character, line, spaced))
            at, spaced = at + 1, False
            continue
        at = match.end()
        kind = match.lastgroup or ""
        if kind == "space":
            spaced = True
            continue
        tokens.append(Token(kind, match.group(), line, spaced))
        _follow(brackets, match.group())
        line += kind == "newline"
        spaced = False
    return tokens


def _follow(brackets: list[str], text: str) -> None:
    if text in ("(", "[", "{"):
        brackets.append(text)
    elif text in (")", "]", "}") and brackets:
        brackets.pop()


def _transposes(tokens: list[Token], spaced: bool, brackets: list[str]) -> bool:
    """Whether a quote at this place is the transpose and does not open a string."""
    if not tokens or (spaced and brackets and brackets[-1] in "[{"):
        return False
    last = tokens[-1]
    if last.kind == "name" and last.text in ("case", "switch", "if", "elseif", "while"):
        return False
    return last.kind in ("number", "name", "string") or last.text in (")", "]", "}", "'", ".'")


def _string(text: str, start: int, line: int) -> tuple[str, int]:
    quote, at = text[start], start + 1
    out: list[str] = []
    while at < len(text) and text[at] != "\n":
        if text[at] == quote:
            if text[at + 1 : at + 2] != quote:
                return "".join(out), at + 1
            at += 1
        out.append(text[at])
        at += 1
    raise NotEvaluated(f"line {line}: a string has no end")
