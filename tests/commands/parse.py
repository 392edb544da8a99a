"""Whether a command can be parsed: program, script, options and words are known; nothing runs."""

from __future__ import annotations

import argparse
import contextlib
import io
import re
import runpy
import shlex
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn
from unittest import mock

from tests.commands.find import Command

#: Programs whose words are not checked.
OTHERS = (".", "cd", "cmake", "ctest", "git", "pip", "pipx", "python3", "c++")


class _Parsed(BaseException):
    """Ends a script where it has parsed its arguments."""


def parts(command: Command) -> Iterator[list[str]]:
    """Words of each program that a command calls, without variables and redirections."""
    for text in re.split(r" (?:&&?|\||;) ", command.plain):
        words = shlex.split(text, comments=True)
        while words and re.fullmatch(r"\w+=\S*", words[0]):
            words = words[1:]
        if ">" in words:
            words = words[: words.index(">")]
        yield [words[0].removeprefix(".venv/bin/"), *words[1:]]


def problem(command: Command, repository: Path) -> str:
    """What is wrong with a command; nothing if it can be parsed."""
    for program, *words in parts(command):
        more = set(re.findall(r"\[(--?[\w-]+)", command.text)) if command.usage else set()
        if program == "hydrodae":
            wrong = of_hydrodae(words, loosely=command.sentence)
        elif program == "python":
            wrong = of_script(words, repository, more, loosely=command.sentence)
        elif program == "hydrodae-solve":
            wrong = ""
        elif program in ("bash", "pytest"):
            paths = [word for word in words if "/" in word]
            wrong = ", ".join(f"no {p}" for p in paths if not (repository / p).exists())
        else:
            wrong = "" if program in OTHERS else f"unknown program {program}"
        if wrong:
            return wrong
    return ""


def of_hydrodae(words: list[str], *, loosely: bool) -> str:
    """Problem of a call of hydrodae; `loosely`: only its command and its options count."""
    from hydrodae.commands.parser import parser_of

    if loosely and words[:1] and words[0].isupper():  # `hydrodae COMMAND --help`
        return ""
    error = io.StringIO()
    try:
        with contextlib.redirect_stderr(error), contextlib.redirect_stdout(io.StringIO()):
            parser = parser_of(words[0] if words else "")
            parser.parse_args(words)
    except SystemExit as end:
        told = error.getvalue().strip().splitlines()
        if end.code == 0 or (loosely and "are required" in told[-1]):
            return ""
        return told[-1]
    return ""


def script_of(words: list[str], repository: Path) -> tuple[Path, list[str]]:
    """File that `python WORDS` runs, and its arguments."""
    if words[0] != "-m":
        return repository / words[0], words[1:]
    path = repository.joinpath(*words[1].split("."))
    return (path / "__main__.py" if path.is_dir() else path.with_suffix(".py")), words[2:]


def of_script(words: list[str], repository: Path, more: set[str], *, loosely: bool) -> str:
    """Problem of a call of a script of the repository: it runs as far as its parser.

    Parameters
    ----------
    words : list of str
        After `python`.
    repository : path
    more : set of str
        Options that its usage line has in brackets.
    loosely : bool
        Whether words in capitals may stand for others.
    """
    path, arguments = script_of(words, repository)
    if loosely and re.search(r"\b[A-Z]{3,}\b", words[0]):
        return ""
    if not path.is_file():
        return f"no {path.relative_to(repository)}"
    if not parses_arguments(path):
        return f"{path.name} does not parse its arguments"
    seen: set[str] = set()

    def stop(parser: argparse.ArgumentParser, *given: Any, **named: Any) -> NoReturn:
        parse(parser, *given, **named)
        seen.update(parser._option_string_actions)
        raise _Parsed

    parse = argparse.ArgumentParser.parse_args
    error = io.StringIO()
    before = dict(sys.modules)
    try:
        with (
            mock.patch.object(argparse.ArgumentParser, "parse_args", stop),
            mock.patch.object(sys, "argv", [str(path), *arguments]),
            mock.patch.object(sys, "path", [str(path.parent), *sys.path]),
            contextlib.redirect_stderr(error),
            contextlib.redirect_stdout(io.StringIO()),
        ):
            runpy.run_path(str(path), run_name="__main__")
    except _Parsed:
        unknown = sorted(more - seen)
        return f"{path.name} has no option {', '.join(unknown)}" if unknown else ""
    except SystemExit:
        told = (error.getvalue().strip().splitlines() or ["ends before it has parsed"])[-1]
        return "" if "pip install" in told else told  # an extra is missing
    finally:
        for name in set(sys.modules) - set(before):  # modules beside scripts have like names
            origin = getattr(sys.modules[name], "__file__", None) or ""
            if Path(origin).is_relative_to(repository / "cases"):
                del sys.modules[name]
    return f"{path.name} ends without an error before it parses its arguments"


def parses_arguments(path: Path) -> bool:
    """Whether a script parses arguments, itself or by that of the devices in cases."""
    text = path.read_text()
    return "parse_args(" in text or "parts.main(" in text
