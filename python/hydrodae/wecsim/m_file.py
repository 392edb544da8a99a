"""Assignments of `wecSimInputFile.m`, without MATLAB."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.wecsim.m_text import NotEvaluated, Statement, Token, statements
from hydrodae.wecsim.m_values import Expression, plain
from hydrodae.wecsim.old_names import new_name
from hydrodae.wecsim.remarks import Remarks

#: Constructors of WEC-Sim, and the kind of object that each makes.
CONSTRUCTORS = {
    "simulationClass": "simu",
    "waveClass": "waves",
    "bodyClass": "body",
    "constraintClass": "constraint",
    "ptoClass": "pto",
    "mooringClass": "mooring",
    "cableClass": "cable",
    "ptoSimClass": "ptoSim",
    "windClass": "wind",
    "windTurbineClass": "windTurbine",
}
#: Values of simulationClass that input files read before they set them.
DEFAULTS = {"rho": 1000.0, "gravity": 9.81, "rampTime": 100.0, "dt": 0.1}
_OPENERS = ("if", "for", "while", "switch", "function", "try", "parfor")
#: Statements without an effect on the model.
_IDLE = ("clear", "clc", "close", "format", "hold", "warning", "disp", "fprintf", "addpath", "end")


@dataclass
class Entry:
    """A value and the line that gave it."""

    value: Any
    line: int


@dataclass
class Item:
    """An object of the input file, such as body(1).

    Attributes
    ----------
    kind, number : str, int
        ``body`` and 1 of ``body(1)``.
    line : int
        Of its constructor.
    arguments : list
        Of its constructor; None where one could not be evaluated.
    entries : dict of Entry
        By dotted field, such as ``quadDrag.cd``.
    used : set of str
        Fields that an import asked for.
    """

    kind: str
    number: int
    line: int = 0
    arguments: list[Any] = field(default_factory=list)
    entries: dict[str, Entry] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)

    @property
    def title(self) -> str:
        """As it stands in the file: ``body(1)``, ``simu``."""
        return self.kind if self.kind == "simu" else f"{self.kind}({self.number})"

    def get(self, name: str, default: Any = None) -> Any:
        """Value of a field, which counts as used."""
        self.used.add(name)
        entry = self.entries.get(name)
        return default if entry is None else entry.value

    def text(self, name: str, default: str = "") -> str:
        """A field that is text."""
        value = self.get(name, default)
        return value if isinstance(value, str) else default

    def number_of(self, name: str, default: float = 0.0) -> float:
        """A field that is one number; of several the first."""
        value = self.get(name)
        array = np.ravel(value) if isinstance(value, float | np.ndarray) else np.zeros(0)
        return float(array[0]) if array.size else default

    def vector(self, name: str, default: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
        """A field that is numbers, as one axis."""
        value = self.get(name)
        if not isinstance(value, float | np.ndarray) or np.size(value) == 0:
            value = default
        return np.array(value, dtype=float).ravel()

    def line_of(self, name: str) -> int:
        """Line of a field, or of the constructor."""
        entry = self.entries.get(name)
        return self.line if entry is None else entry.line


@dataclass
class InputFile:
    """What an input file says.

    Attributes
    ----------
    path : Path
    items : dict of Item
        By kind and number; ``simu`` and single ``waves`` have number 1.
    variables : dict of Entry
    remarks : Remarks
        Statements that could not be evaluated, with their lines.
    """

    path: Path
    items: dict[tuple[str, int], Item] = field(default_factory=dict)
    variables: dict[str, Entry] = field(default_factory=dict)
    remarks: Remarks = field(default_factory=Remarks)

    def of(self, kind: str) -> list[Item]:
        """Objects of one kind, by number."""
        return [item for (k, _), item in sorted(self.items.items()) if k == kind]

    def get(self, kind: str, number: int = 1) -> Item | None:
        """One object, or None."""
        return self.items.get((kind, number))

    def place(self, line: int) -> str:
        """File and line, as remarks have it."""
        return f"{self.path.name}:{line}"


def read_input(path: Path) -> InputFile:
    """Read `wecSimInputFile.m`.

    Raises
    ------
    CaseError
        There is no such file, or it is no text.
    """
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise CaseError(f"{path}: cannot be read ({error.strerror})") from None
    try:
        parts = statements(text)
    except NotEvaluated as error:
        raise CaseError(f"{path}: {error}") from None
    read = InputFile(path)
    _Run(read).block(parts, 0, True)
    return read


class _Run:
    """Executes statements in order."""

    def __init__(self, read: InputFile) -> None:
        self.read = read

    def block(self, parts: list[Statement], at: int, live: bool) -> int:
        """Execute up to the `end`, `else` or `elseif` of the block; returns where that stands."""
        while at < len(parts):
            word = parts[at].tokens[0].text
            if word in ("end", "else", "elseif", "case", "otherwise", "catch"):
                return at
            if word == "if":
                at = self._choice(parts, at, live)
            elif word in _OPENERS:
                if live:
                    self._skipped(parts[at], f"the {word} block is not carried out")
                at = _end_of(parts, at)
            elif live:
                self._statement(parts[at])
            at += 1
        return at

    def _choice(self, parts: list[Statement], at: int, live: bool) -> int:
        taken = False
        while True:
            statement = parts[at]
            word = statement.tokens[0].text
            now = live and not taken and word in ("if", "elseif", "else")
            if now and word != "else":
                try:
                    now = bool(np.all(self._value(_condition(statement.tokens[1:]))))
                except NotEvaluated as error:
                    self._skipped(statement, f"condition not evaluated ({error}), taken as false")
                    now = False
            taken = taken or now
            at = self.block(parts, at + 1, now)
            if at >= len(parts) or parts[at].tokens[0].text == "end":
                return at

    def _statement(self, statement: Statement) -> None:
        equals = _assignment(statement.tokens)
        if equals is None:
            if statement.tokens[0].text not in _IDLE:
                self._skipped(statement, "not carried out")
            return
        left, right = statement.tokens[:equals], statement.tokens[equals + 1 :]
        try:
            name, path = _target(left)
            constructor = right[0].text if right and right[0].kind == "name" else ""
            if constructor in CONSTRUCTORS:
                self._construct(CONSTRUCTORS[constructor], path, right, statement)
            elif (name, _number_in(path)) in self.read.items or name in CONSTRUCTORS.values():
                self._set(name, path, self._value(right), statement.line)
            else:
                self._variable(name, path, self._value(right), statement.line)
        except NotEvaluated as error:
            self._skipped(statement, f"not evaluated ({error})")

    def _construct(
        self, kind: str, path: list[str], right: tuple[Token, ...], statement: Statement
    ) -> None:
        number = _number_in(path)
        arguments: list[Any] = []
        for tokens in _split(right[2:-1]) if len(right) > 2 else []:
            try:
                arguments.append(self._value(tokens))
            except NotEvaluated as error:
                arguments.append(None)
                self._skipped(statement, f"not evaluated ({error})")
        self.read.items[kind, number] = Item(kind, number, statement.line, arguments)

    def _set(self, kind: str, path: list[str], value: Any, line: int) -> None:
        number, rest = _number_in(path), path[1:] if path and path[0][0] == "(" else path
        item = self.read.items.setdefault((kind, number), Item(kind, number, line))
        fields = [part for part in rest if part[0] != "("]
        if not fields:
            raise NotEvaluated(f"{kind} is not made by its class")
        name = new_name(kind, ".".join(fields))
        if rest[-1][0] == "(":
            old = item.entries.get(name)
            value = _indexed(None if old is None else old.value, rest[-1], value)
        elif len(fields) < len(rest):
            name = ".".join(p if p[0] != "(" else p.strip("()") for p in rest)
        item.entries[name] = Entry(value, line)

    def _variable(self, name: str, path: list[str], value: Any, line: int) -> None:
        if path and path[-1][0] == "(":
            name, old = ".".join([name, *path[:-1]]), None
            if name in self.read.variables:
                old = self.read.variables[name].value
            self.read.variables[name] = Entry(_indexed(old, path[-1], value), line)
        else:
            self.read.variables[".".join([name, *path])] = Entry(value, line)

    def _value(self, tokens: tuple[Token, ...]) -> Any:
        return Expression(tokens, self._look_up).value()

    def _look_up(self, name: str, path: tuple[str, ...]) -> Any:
        parts = list(path)
        number = _number_in(parts)
        item = self.read.items.get((name, number))
        if item is not None:
            parts = parts[1:] if parts and parts[0][0] == "(" else parts
            index = parts.pop() if parts and parts[-1][0] == "(" else None
            entry = item.entries.get(new_name(name, ".".join(parts)))
            if entry is None and name == "simu" and ".".join(parts) in DEFAULTS:
                entry = Entry(DEFAULTS[".".join(parts)], 0)
            missing = f"{item.title}.{'.'.join(parts)} has no value yet"
        else:
            index = parts.pop() if parts and parts[-1][0] == "(" else None
            entry = self.read.variables.get(".".join([name, *parts]))
            missing = f"{name} has no value"
        if entry is None:
            raise NotEvaluated(missing)
        return entry.value if index is None else _element(entry.value, index)

    def _skipped(self, statement: Statement, why: str) -> None:
        text = statement.text if len(statement.text) < 70 else statement.text[:67] + "..."
        self.read.remarks.left_out(self.read.place(statement.line), f"{text}: {why}")


def _condition(tokens: tuple[Token, ...]) -> tuple[Token, ...]:
    return tuple(token for token in tokens if token.kind != "newline")


def _end_of(parts: list[Statement], at: int) -> int:
    depth = 0
    for index in range(at, len(parts)):
        word = parts[index].tokens[0].text
        depth += word in _OPENERS
        depth -= word == "end"
        if depth == 0:
            return index
    return len(parts)


def _assignment(tokens: tuple[Token, ...]) -> int | None:
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


def _target(tokens: tuple[Token, ...]) -> tuple[str, list[str]]:
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


def _number_in(path: list[str]) -> int:
    """Number of an object from the first index; 1 where there is none."""
    if path and path[0][0] == "(":
        inside = path[0].strip("()").split(",")[-1]
        if not inside.isdigit():
            raise NotEvaluated(f"the index {path[0]} is no number")
        return int(inside)
    return 1


def _split(tokens: tuple[Token, ...]) -> Iterator[tuple[Token, ...]]:
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


def _places(index: str, shape: tuple[int, int]) -> tuple[list[int], list[int]]:
    """Rows and columns that an index means; one index runs over a row (or a column)."""
    parts = index.strip("()").split(",")
    if len(parts) == 1:
        parts = [parts[0], "1"] if shape[1] == 1 and shape[0] > 1 else ["1", parts[0]]
    if len(parts) != 2:
        raise NotEvaluated(f"the index {index}")
    ranges = []
    for part, size in zip(parts, shape, strict=True):
        ends = part.split(":")
        if part == ":":
            ranges.append(list(range(size)))
        elif all(end.isdigit() for end in ends) and len(ends) <= 3:
            step = int(ends[1]) if len(ends) == 3 else 1
            ranges.append(list(range(int(ends[0]) - 1, int(ends[-1]), step)))
        else:
            raise NotEvaluated(f"the index {index}")
    return ranges[0], ranges[1]


def _indexed(old: Any, index: str, value: Any) -> Any:
    """An array with some of its elements replaced, larger where need be."""
    if isinstance(value, str | list):
        raise NotEvaluated("a number is needed")
    array = np.atleast_2d(np.zeros((0, 0)) if old is None else np.array(old, dtype=float))
    rows, columns = _places(index, (array.shape[0], array.shape[1]))
    shape = (
        max([array.shape[0], *(row + 1 for row in rows)]),
        max([array.shape[1], *(column + 1 for column in columns)]),
    )
    grown = np.zeros(shape)
    grown[: array.shape[0], : array.shape[1]] = array
    grown[np.ix_(rows, columns)] = np.broadcast_to(np.atleast_2d(value), (len(rows), len(columns)))
    return plain(grown)


def _element(value: Any, index: str) -> Any:
    if isinstance(value, str | list):
        raise NotEvaluated(f"the index {index} of text")
    array = np.atleast_2d(value)
    rows, columns = _places(index, (array.shape[0], array.shape[1]))
    try:
        return plain(array[np.ix_(rows, columns)])
    except IndexError:
        raise NotEvaluated(f"the index {index} is out of range") from None
