"""Objects of an input file of WEC-Sim: their fields, and which of them were asked for."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.wecsim.remarks import Remarks


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
