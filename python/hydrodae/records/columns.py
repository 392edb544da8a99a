"""What readers of files return."""

from __future__ import annotations

from dataclasses import dataclass, field

from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Columns:
    """Names and (n_row, n_column) values of a table; "1", "2", ... where it is not `named`."""

    names: list[str]
    values: Array
    named: bool = True
    notes: list[str] = field(default_factory=list)


def numbered(count: int) -> list[str]:
    """Names of columns that have none."""
    return [str(k + 1) for k in range(count)]
