"""The YAML that OrcaFlex and OrcaWave write: block mappings and lists, flow lists of one level.

A small part of YAML 1.1, enough for their data files: two-space indentation, `key: value`,
`- item`, `[a, b]` that may go on over several lines, `~` for nothing, comments on own lines.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.text import read_lines


@dataclass(frozen=True)
class _Line:
    number: int
    indent: int
    text: str


def read_yaml(path: Path) -> dict[str, Any]:
    """Read a data file of OrcaFlex or OrcaWave.

    Parameters
    ----------
    path : Path

    Returns
    -------
    dict
        Mappings, lists, numbers (float) and text; None for `~`.

    Raises
    ------
    DatabaseError
        A line is not of that kind; the message names file and line.
    """
    lines = _lines(path)
    if not lines:
        return {}
    value, end = _block(path, lines, 0, lines[0].indent)
    if end < len(lines) or not isinstance(value, dict):
        at = lines[min(end, len(lines) - 1)]
        raise DatabaseError(f"{path}:{at.number}: not the YAML of OrcaFlex: {at.text[:60]!r}")
    return value


def _lines(path: Path) -> list[_Line]:
    """Lines that say something; flow lists that go on are joined to one line."""
    found: list[_Line] = []
    open_list = False
    for count, raw in enumerate(read_lines(path), start=1):
        text = raw.strip()
        if not text or text.startswith(("#", "%")) or text in ("---", "..."):
            continue
        if open_list:
            last = found[-1]
            found[-1] = _Line(last.number, last.indent, f"{last.text} {text}")
        else:
            found.append(_Line(count, len(raw) - len(raw.lstrip()), text))
        # a list within a value may only open at its begin, never inside a name
        opened = found[-1].text
        flow = opened.startswith(("[", "- [")) or ": [" in opened
        open_list = flow and opened.count("[") > opened.count("]")
    return found


def _block(path: Path, lines: list[_Line], at: int, indent: int) -> tuple[Any, int]:
    """Value of the lines from `at` on that are indented by `indent`, and where it ends."""
    if lines[at].text.startswith("- ") or lines[at].text == "-":
        return _sequence(path, lines, at, indent)
    result: dict[str, Any] = {}
    while at < len(lines) and lines[at].indent == indent and not lines[at].text.startswith("- "):
        line = lines[at]
        key, colon, rest = line.text.partition(":")
        if not colon or (rest and not rest.startswith(" ")):
            raise DatabaseError(f"{path}:{line.number}: expected `key: value`")
        at += 1
        if rest.strip():
            result[key.strip()] = _scalar(rest.strip())
        elif at < len(lines) and lines[at].indent > indent:
            result[key.strip()], at = _block(path, lines, at, lines[at].indent)
        elif at < len(lines) and lines[at].indent == indent and lines[at].text.startswith("- "):
            result[key.strip()], at = _sequence(path, lines, at, indent)
        else:
            result[key.strip()] = None
    if at < len(lines) and lines[at].indent > indent:
        raise DatabaseError(f"{path}:{lines[at].number}: unexpected indentation")
    return result, at


def _sequence(path: Path, lines: list[_Line], at: int, indent: int) -> tuple[list[Any], int]:
    result = []
    while at < len(lines) and lines[at].indent == indent and lines[at].text.startswith("- "):
        line = lines[at]
        item = line.text[2:].strip()
        if ": " in item or item.endswith(":"):
            # a mapping whose first key stands behind the dash
            inner = indent + 2
            lines[at] = _Line(line.number, inner, item)
            value, at = _block(path, lines, at, inner)
            result.append(value)
        else:
            result.append(_scalar(item))
            at += 1
    return result, at


def _scalar(text: str) -> Any:
    if text.startswith("["):
        inner = text.strip("[]").strip()
        return [_scalar(word.strip()) for word in inner.split(",")] if inner else []
    if text == "~":
        return None
    try:
        return float(text)
    except ValueError:
        return text.strip("'\"")
