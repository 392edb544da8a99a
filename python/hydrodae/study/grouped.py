"""Text with many lines that differ in numbered names only: the first of each kind and a count."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import groupby

#: So many lines of a kind are shown as they are.
FEW = 8

#: A number inside a name, such as that of hinge12 or B3r.
_NUMBERED = re.compile(r"(?<=[A-Za-z_])\d+")


def grouped(text: str, few: int = FEW) -> str:
    """Replace lines that are alike by the first of them, their number and the last.

    Lines are alike that stand under one heading and differ in numbers inside names only: "up1:
    planar, 1 kg" and "up2: planar, 1 kg", but not "up3: planar, 2 kg".

    Parameters
    ----------
    text : str
    few : int
        So many alike lines are left as they are.
    """
    lines: list[str] = []
    for depth, block in groupby(text.splitlines(), key=_depth):
        lines += _of_block(list(block), depth, few)
    return "".join(f"{line}\n" for line in lines)


def _depth(line: str) -> int:
    return len(line) - len(line.lstrip())


def _kind(line: str) -> str:
    """The line with the numbers in its names, and the widths of its columns, left out."""
    return " ".join(_NUMBERED.sub("#", line).split())


def _of_block(lines: list[str], depth: int, few: int) -> Iterable[str]:
    alike: dict[str, list[str]] = {}
    for line in lines:
        alike.setdefault(_kind(line), []).append(line)
    shown = set()
    for line in lines:
        same = alike[_kind(line)]
        if len(same) <= few:
            yield line
        elif _kind(line) not in shown:
            shown.add(_kind(line))
            yield line
            yield f"{' ' * (depth + 2)}... and {len(same) - 1} like it, the last:"
            yield same[-1]
