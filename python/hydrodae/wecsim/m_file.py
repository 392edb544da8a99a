"""Assignments of `wecSimInputFile.m`, without MATLAB."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.wecsim.m_arrays import elements, meshgrid, with_elements
from hydrodae.wecsim.m_beside import function_text, loaded, script
from hydrodae.wecsim.m_blocks import (
    OPENERS,
    assignment,
    cases_of,
    end_of,
    field_of,
    is_equal,
    number_in,
    several_names,
    shown,
    split_arguments,
    target_of,
    without_first,
    without_newlines,
)
from hydrodae.wecsim.m_calls import called, extreme
from hydrodae.wecsim.m_python import head_of
from hydrodae.wecsim.m_text import NotEvaluated, Statement, Token, statements, understood
from hydrodae.wecsim.m_values import Expression
from hydrodae.wecsim.objects import Entry, InputFile, Item
from hydrodae.wecsim.old_names import new_name
from hydrodae.wecsim.remarks import Remark

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
#: Most rounds of a loop, and most statements of a file, loops carried out.
_MOST_LOOPS = 10_000
_MOST_STATEMENTS = 10 * _MOST_LOOPS
#: Most scripts that call each other.
_MOST_SCRIPTS = 10
#: Statements without an effect on the model.
_IDLE = ("clear clearvars clc close format hold warning disp fprintf addpath end save").split()


def read_input(path: Path, define: Mapping[str, str] | None = None) -> InputFile:
    """Read `wecSimInputFile.m`.

    Parameters
    ----------
    path : Path
    define : mapping from str, optional
        Expressions of MATLAB for variables that are set before the file runs, by their names.

    Raises
    ------
    CaseError
        There is no such file, it is no text, or a variable has no value.
    """
    try:
        text = path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise CaseError(f"{path}: cannot be read ({error.strerror})") from None
    read = InputFile(path)
    for name, value in (define or {}).items():
        try:
            assign(read, name, evaluate(read, value))
        except NotEvaluated as error:
            raise CaseError(f"--define {name}={value}: {error}; write a number or 'text'") from None
    try:
        parts = statements(text)
    except NotEvaluated as error:
        raise CaseError(f"{path}: {error}") from None
    try:
        _Run(read).block(parts, 0, True)
    except RecursionError:
        raise CaseError(f"{path}: its blocks are nested too deeply") from None
    return read


def calls(path: Path, names: Collection[str]) -> list[list[Any]]:
    """Arguments of each assignment whose right side is a call of one of these functions.

    Arguments that cannot be evaluated are None.

    Raises
    ------
    CaseError
        There is no such file, or it is no text.
    """
    read = read_input(path)
    found = []
    for part in statements(path.read_text(encoding="utf-8", errors="replace")):
        right = part.tokens[(assignment(part.tokens) or -1) + 1 :]
        if len(right) > 2 and right[0].text in names and right[1].text == "(":
            found.append([_Run(read).argument(tokens) for tokens in split_arguments(right[2:-1])])
    return found


def leading_variables(path: Path) -> dict[str, Entry]:
    """Variables that a function sets before its first block; empty for other files."""
    parts = statements(path.read_text(encoding="utf-8", errors="replace"))
    if not parts or parts[0].tokens[0].text != "function":
        return {}
    body = parts[1:]
    end = next((k for k, p in enumerate(body) if p.tokens[0].text in OPENERS), len(body))
    read = InputFile(path)
    _Run(read).block(body[:end], 0, True)
    return read.variables


#: Functions with several results.
_SEVERAL = {
    "meshgrid": meshgrid,
    "min": lambda values: extreme("min", values),
    "max": lambda values: extreme("max", values),
}


class _Run:
    """Executes statements in order."""

    def __init__(self, read: InputFile) -> None:
        self.read = read
        self.left = _MOST_STATEMENTS
        self.scripts: list[tuple[str, int]] = []  # scripts at work, and the lines that call them

    def block(self, parts: list[Statement], at: int, live: bool) -> int:
        """Execute up to the `end`, `else` or `elseif` of the block; returns where that stands."""
        while at < len(parts):
            self.left -= 1
            if self.left < 0:
                raise CaseError(f"{self.read.path}: more than {_MOST_STATEMENTS} statements to do")
            word = parts[at].tokens[0].text
            if word in ("end", "else", "elseif", "case", "otherwise", "catch"):
                return at
            if word == "if":
                at = self._choice(parts, at, live)
            elif word == "for" and live:
                at = self._loop(parts, at)
            elif word == "switch" and live:
                at = self._switch(parts, at)
            elif word in OPENERS:
                end = end_of(parts, at)
                if live:
                    why = f"the {word} block is not carried out"
                    self._unread(parts[at:end], self._skipped(parts[at], why))
                at = end
            elif live:
                self._statement(parts[at])
            at += 1
        return at

    def _loop(self, parts: list[Statement], at: int) -> int:
        """Carry out a loop over the columns of a row of numbers; returns its end."""
        end = end_of(parts, at)
        tokens = without_newlines(parts[at].tokens[1:])
        equals = assignment(tokens)
        try:
            if equals != 1:
                raise NotEvaluated("the head is not understood")
            values = np.atleast_2d(self._value(tokens[2:]))
            if values.shape[0] != 1 or values.size > _MOST_LOOPS:
                raise NotEvaluated(f"at most {_MOST_LOOPS} numbers in a row")
        except NotEvaluated as error:
            why = f"the for block is not carried out ({error})"
            self._unread(parts[at:end], self._skipped(parts[at], why))
            return end
        for value in values[0]:
            self._variable(tokens[0].text, [], float(value), parts[at].line)
            self.block(parts[:end], at + 1, True)
        return end

    def _choice(self, parts: list[Statement], at: int, live: bool) -> int:
        taken = False
        while True:
            statement = parts[at]
            word = statement.tokens[0].text
            now = live and not taken and word in ("if", "elseif", "else")
            if now and word != "else":
                try:
                    value = self._value(without_newlines(statement.tokens[1:]))
                    with understood():
                        now = bool(np.all(value))
                except NotEvaluated as error:
                    why = f"condition not evaluated ({error}; --define NAME=VALUE sets a variable)"
                    why += ", taken as false"
                    self._unread(parts[at : end_of(parts, at)], self._skipped(statement, why))
                    now = False
            taken = taken or now
            at = self.block(parts, at + 1, now)
            if at >= len(parts) or parts[at].tokens[0].text == "end":
                return at

    def _switch(self, parts: list[Statement], at: int) -> int:
        """Carry out the case that a value is equal to, or is in; returns the end."""
        end = end_of(parts, at)
        try:
            value = self._value(without_newlines(parts[at].tokens[1:]))
            for begin in cases_of(parts, at, end):
                tokens = without_newlines(parts[begin].tokens[1:])
                other = parts[begin].tokens[0].text == "otherwise"
                wanted = value if other else self._value(tokens)
                listed = wanted if isinstance(wanted, list) else [wanted]
                if any(is_equal(value, one) for one in listed):
                    self.block(parts[:end], begin + 1, True)
                    break
        except NotEvaluated as error:
            why = f"the switch block is not carried out ({error})"
            self._unread(parts[at:end], self._skipped(parts[at], why))
        return end

    def _statement(self, statement: Statement) -> None:
        equals = assignment(statement.tokens)
        try:
            with understood():
                if equals is not None:
                    self._assign(statement, equals)
                elif statement.tokens[0].text not in _IDLE and not self._call(statement):
                    self._skipped(statement, "not carried out")
        except NotEvaluated as error:
            why = "not carried out" if equals is None else "not evaluated"
            if equals is None or not self._forget(statement.tokens[:equals]):
                self._unread([statement], self._skipped(statement, f"{why} ({error})"))
            else:
                text = f"{shown(statement)}: {why} ({error}); what is made of it is named beside it"
                self.read.remarks.not_needed(self._place(statement), text)

    def _forget(self, left: tuple[Token, ...]) -> bool:
        """Take the values of variables away that an assignment is to; whether all are variables."""
        inside = split_arguments(left[1:-1]) if left[0].text == "[" else iter([left])
        try:
            targets = [target_of(tokens) for tokens in inside]
        except NotEvaluated:
            return False
        for name, path in targets:
            if name in CONSTRUCTORS.values():
                return False
            fields = [part for part in path if part[0] != "("]
            self.read.unknown.add(".".join([name, *fields]))
            self.read.variables.pop(".".join([name, *fields]), None)
        return True

    def _call(self, statement: Statement) -> bool:
        """Carry out a script beside the input file, or load variables; whether it is one."""
        tokens, folder = statement.tokens, self.read.path.parent
        name = tokens[0].text
        if name == "load" and len(tokens) > 1:
            word = tokens[1].text if tokens[1].kind == "name" else None
            for key, value in loaded(folder, word or self._value(tokens[1:])).items():
                self._variable(key, [], value, self._line(statement))
            return True
        parts = script(folder, name) if len(tokens) == 1 else None
        if parts is None:
            return False
        if len(self.scripts) == _MOST_SCRIPTS:
            raise NotEvaluated(f"more than {_MOST_SCRIPTS} scripts within each other")
        self.scripts.append((f"{name}.m", self._line(statement)))
        self.block(parts, 0, True)
        self.scripts.pop()
        return True

    def _line(self, statement: Statement) -> int:
        """Line of the input file: of a script the line that calls it."""
        return self.scripts[0][1] if self.scripts else statement.line

    def _assign(self, statement: Statement, equals: int) -> None:
        """Carry out an assignment, its = at token `equals`."""
        left, right = statement.tokens[:equals], statement.tokens[equals + 1 :]
        line = self._line(statement)
        several = _SEVERAL.get(right[0].text) if [t.text for t in right[1:2]] == ["("] else None
        if several is not None and (names := several_names(left)):
            made = several([self._value(tokens) for tokens in split_arguments(right[2:-1])])
            for name, value in zip(names, made, strict=False):
                if name != "~":
                    self._variable(name, [], value, line)
            return
        name, path = target_of(left)
        constructor = right[0].text if right and right[0].kind == "name" else ""
        if constructor in CONSTRUCTORS:
            self._construct(CONSTRUCTORS[constructor], path, right, statement)
        elif name in CONSTRUCTORS.values():
            self._set(name, path, self._value(right), line)
        elif constructor == "load" and not path:
            told = loaded(self.read.path.parent, self._value(right[1:]))
            for key, value in told.items():
                self._variable(f"{name}.{key}", [], value, line)
        else:
            self._variable(name, path, self._value(right), line)

    def _unread(self, parts: list[Statement], remark: Remark) -> None:
        """Remember the fields of objects that statements set which are not carried out."""
        for part in parts:
            equals = assignment(part.tokens)
            try:
                name, path = target_of(part.tokens[:equals])
                item = self.read.items.get((name, number_in(path)))
            except NotEvaluated:
                continue
            if item is not None and equals is not None:
                item.unread.setdefault(field_of(name, path), remark)

    def _construct(
        self, kind: str, path: list[str], right: tuple[Token, ...], statement: Statement
    ) -> None:
        number = number_in(path)
        arguments: list[Any] = []
        for tokens in split_arguments(right[2:-1]) if len(right) > 2 else []:
            arguments.append(self.argument(tokens))
            if arguments[-1] is None:
                self._skipped(statement, "an argument is not evaluated")
        name = self.read.path.name
        line = self._line(statement)
        self.read.items[kind, number] = Item(kind, number, line, arguments, file=name)

    def argument(self, tokens: tuple[Token, ...]) -> Any:
        """Value of an argument; None where it cannot be evaluated."""
        try:
            return self._value(tokens)
        except NotEvaluated:
            return None

    def _set(self, kind: str, path: list[str], value: Any, line: int) -> None:
        number, rest = number_in(path), path[1:] if path and path[0][0] == "(" else path
        new = Item(kind, number, line, file=self.read.path.name)
        item = self.read.items.setdefault((kind, number), new)
        fields = [part for part in rest if part[0] != "("]
        if not fields:
            raise NotEvaluated(f"{kind} is not made by its class")
        name = field_of(kind, path)
        if rest[-1][0] == "(":
            old = item.entries.get(name)
            value = with_elements(None if old is None else old.value, rest[-1], value)
        elif len(fields) < len(rest):
            name = ".".join(p if p[0] != "(" else p.strip("()") for p in rest)
        item.entries[name] = Entry(value, line)

    def _variable(self, name: str, path: list[str], value: Any, line: int) -> None:
        path = without_first(path)
        if path and path[-1][0] == "(":
            name, old = ".".join([name, *path[:-1]]), None
            if name in self.read.unknown:
                raise NotEvaluated(f"{name} has no value")
            if name in self.read.variables:
                old = self.read.variables[name].value
            self.read.variables[name] = Entry(with_elements(old, path[-1], value), line)
        else:
            name = ".".join([name, *path])
            self.read.unknown.discard(name)
            self.read.variables[name] = Entry(value, line)

    def _value(self, tokens: tuple[Token, ...]) -> Any:
        return Expression(tokens, self._look_up, self._function).value()

    def _function(self, name: str, values: list[Any]) -> Any:
        """Value of a function beside the input file, or of MATLAB."""
        text, path = (
            function_text(self.read.path.parent, name),
            self.read.path.with_name(f"{name}.m"),
        )
        if text is not None and path == self.read.path:
            raise NotEvaluated(f"{name} calls itself")
        if text is not None:
            return result_of(text, values, path)
        if name == "exist" and len(values) == 2:
            return float(values[0] in self.read.variables)
        return called(name, values, self._function)

    def _look_up(self, name: str, path: tuple[str, ...]) -> Any:
        parts = list(path)
        number = number_in(parts)
        item = self.read.items.get((name, number))
        if item is not None:
            parts = parts[1:] if parts and parts[0][0] == "(" else parts
            index = parts.pop() if parts and parts[-1][0] == "(" else None
            entry = item.entries.get(new_name(name, ".".join(parts)))
            if entry is None and name == "simu" and ".".join(parts) in DEFAULTS:
                entry = Entry(DEFAULTS[".".join(parts)], 0)
            missing = f"{item.title}.{'.'.join(parts)} has no value yet"
        else:
            parts = without_first(parts)
            index = parts.pop() if parts and parts[-1][0] == "(" else None
            entry = self.read.variables.get(".".join([name, *parts]))
            missing = f"{name} has no value"
        if entry is None:
            raise NotEvaluated(missing)
        return entry.value if index is None else elements(entry.value, index)

    def _skipped(self, statement: Statement, why: str) -> Remark:
        return self.read.remarks.left_out(self._place(statement), f"{shown(statement)}: {why}")

    def _place(self, statement: Statement) -> str:
        """File and line of a statement."""
        name = self.scripts[-1][0] if self.scripts else self.read.path.name
        return f"{name}:{statement.line}"


def assign(read: InputFile, target: str, value: Any) -> None:
    """Set what a name with indices and fields means, such as ``pto(1).damping``.

    Raises
    ------
    NotEvaluated
        The name is not understood.
    """
    parts = statements(f"{target} = 0;")
    equals = assignment(parts[0].tokens) if len(parts) == 1 else None
    if equals is None:
        raise NotEvaluated(f"{target!r} is no name")
    name, path = target_of(parts[0].tokens[:equals])
    run = _Run(read)
    if name in CONSTRUCTORS.values():
        run._set(name, path, value, 0)
    else:
        run._variable(name, path, value, 0)


def result_of(script: str, values: list[Any], path: Path) -> Any:
    """Value of a function of MATLAB with one result, which sees its arguments alone.

    Parameters
    ----------
    script : str
        Its text.
    values : list
        Of its arguments.
    path : Path
        Its file; functions that it calls stand beside it.

    Raises
    ------
    NotEvaluated
        A statement is not understood, or it has other arguments.
    """
    output, names = head_of(script)
    if len(names) != len(values):
        raise NotEvaluated(f"{path.name} with {len(values)} arguments")
    scope = InputFile(path)
    scope.variables = {name: Entry(value, 0) for name, value in zip(names, values, strict=True)}
    _Run(scope).block(statements(script)[1:], 0, True)
    if scope.remarks.items:
        raise NotEvaluated(str(scope.remarks.items[0]))
    if output not in scope.variables:
        raise NotEvaluated(f"{path.name} sets no {output}")
    return scope.variables[output].value


def evaluate(read: InputFile, text: str) -> Any:
    """Value of an expression, with the variables and objects of an input file.

    Raises
    ------
    NotEvaluated
        It is not understood.
    """
    parts = statements(text)
    if len(parts) != 1:
        raise NotEvaluated(f"{text!r} is no expression")
    return _Run(read)._value(parts[0].tokens)
