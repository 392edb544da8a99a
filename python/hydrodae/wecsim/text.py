"""The text of a case file, with comments."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from typing import Any

from hydrodae.case.case import to_toml


class CaseText:
    """Lines of a case file."""

    def __init__(self) -> None:
        self.lines: list[str] = []

    def comment(self, text: str) -> None:
        """Add a comment, wrapped."""
        self.lines += [f"# {line}" for line in textwrap.wrap(text, 98)]

    def value(self, key: str, value: Any) -> None:
        """Add a key."""
        self.lines.append(f"{key} = {to_toml(_rounded(value), key)}")

    def table(self, header: str, keys: Mapping[str, Any], *comments: str) -> None:
        """Add a table below comments; keys whose value is None are left out."""
        if self.lines:
            self.lines.append("")
        for text in comments:
            self.comment(text)
        self.lines.append(header)
        for key, value in keys.items():
            if value is not None:
                self.value(key, value)

    def head(self, key: str, values: list[str]) -> None:
        """Add a key with texts, a line each, below the title; none where there are no texts."""
        if values:
            lines = [f"    {to_toml(value, key)}," for value in values]
            at = 1 + next(i for i, line in enumerate(self.lines) if line.startswith("title = "))
            self.lines[at:at] = [f"{key} = [", *lines, "]"]

    def __str__(self) -> str:
        return "\n".join(self.lines) + "\n"


def _rounded(value: Any) -> Any:
    """Numbers without the last digits of an arithmetic; -0 as 0."""
    if isinstance(value, float):
        return float(f"{value:.12g}") + 0.0
    if hasattr(value, "tolist"):
        return _rounded(value.tolist())
    if isinstance(value, list | tuple):
        return [_rounded(item) for item in value]
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    return value
