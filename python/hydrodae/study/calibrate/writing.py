"""A copy of a case file in which the fitted values stand, comments and order kept."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from hydrodae.case import Case
from hydrodae.case.case import to_toml
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.support.outputs import claim, write_text

_ASSIGNMENT = re.compile(r"^(?P<head>\s*[A-Za-z0-9_.\"'-]+\s*=\s*)(?P<value>.*)$")


def write_case(
    before: Case, fitted: Case, keys: Mapping[str, Any], path: str | os.PathLike[str]
) -> Path:
    """Write the text of a case with the values of keys replaced; its `--set` values as well.

    Raises
    ------
    CaseError
        A value does not stand by itself on a line of the file, or the copy is not the same case.
    """
    target = Path(path)
    folder = before.directory
    if target.parent.resolve() != folder.resolve():
        raise CaseError(
            f"{target}: files that the case names are relative to it: write it into {folder}"
        )
    if before.path is not None and target.exists() and target.samefile(before.path):
        raise CaseError(f"{target}: is the case itself; name another file")
    lines = before.text.splitlines()
    given = {key: tomllib.loads(f"x = {text}")["x"] for key, text in before.overrides.items()}
    for key, value in {**given, **keys}.items():
        replace_value(lines, before, key, value)
    text = "\n".join(lines) + "\n"
    copy = Case.from_text(text, folder, libraries=before.libraries)
    if case_tables(copy) != case_tables(fitted):
        raise CaseError(f"{target}: the copy would not be the same case; write the values by hand")
    write_text(claim(target, "TOML file"), text)
    return target


def replace_value(lines: list[str], case: Case, key: str, value: Any) -> None:
    """Replace the value of a key in the lines of a case; raises CaseError where it cannot."""
    file, line, column = case.scene.places.get(key, ("", 0, 0))
    by_hand = f"write it by hand: {key} = {to_toml(value, key)}"
    match = _ASSIGNMENT.match(lines[line - 1]) if line else None
    if match is None:
        raise CaseError(f"{key} stands in no line of its own in the case file; {by_hand}")
    old, comment = _split(match["value"])
    if old is None:
        raise CaseError(
            f"the value of {key} is not on one line; {by_hand}",
            key=key,
            file=file,
            line=line,
            column=column,
        )
    lines[line - 1] = match["head"] + to_toml(value, key) + comment


def _split(text: str) -> tuple[str | None, str]:
    """Value and what follows it (blanks, a comment); None if it goes on in the next line."""
    for end in range(len(text), 0, -1):
        rest = text[end:].strip()
        if rest and not rest.startswith("#"):
            continue
        try:
            tomllib.loads(f"x = {text[:end]}")
        except tomllib.TOMLDecodeError:
            continue
        value = text[:end]
        if "#" in value and not rest:  # the comment was read with the value
            shorter = [k for k in range(1, end) if text[k] == "#" and _is_value(text[:k])]
            if shorter:
                value = text[: shorter[0]]
        value = value.rstrip()
        return value, text[len(value) :]
    return None, ""


def _is_value(text: str) -> bool:
    try:
        tomllib.loads(f"x = {text}")
    except tomllib.TOMLDecodeError:
        return False
    return True
