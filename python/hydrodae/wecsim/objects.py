"""Objects of an input file of WEC-Sim: their fields, and which of them were asked for."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.wecsim.remarks import Remark, Remarks


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
    unread : dict of Remark
        Fields whose values could not be evaluated.
    file : str
        Name of the input file.
    """

    kind: str
    number: int
    line: int = 0
    arguments: list[Any] = field(default_factory=list)
    entries: dict[str, Entry] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    unread: dict[str, Remark] = field(default_factory=dict)
    file: str = ""

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

    def whole(self, name: str, default: int = 0) -> int:
        """A field that is a whole number.

        Raises
        ------
        CaseError
            It is another number.
        """
        value = self.number_of(name, float(default))
        if not value.is_integer():
            raise CaseError(
                f"{self.file}:{self.line_of(name)}: {self.title}.{name}: expected a whole number, "
                f"got {value:g}"
            )
        return int(value)

    def vector(self, name: str, default: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
        """A field that is numbers, as one axis.

        Raises
        ------
        CaseError
            The default has three numbers, and the field another count.
        """
        value = self.get(name)
        if not isinstance(value, float | np.ndarray) or np.size(value) == 0:
            value = default
        found = np.array(value, dtype=float).ravel()
        if np.size(default) == 3 != found.size:
            raise CaseError(
                f"{self.file}:{self.line_of(name)}: {self.title}.{name}: expected 3 numbers, "
                f"got {found.size}"
            )
        return found

    def matrix(self, name: str) -> np.ndarray[Any, np.dtype[np.float64]]:
        """A field that is numbers, as rows; one zero where there are none."""
        value = self.get(name)
        good = isinstance(value, float | np.ndarray) and np.size(value) > 0
        return np.atleast_2d(np.asarray(value if good else 0.0, dtype=float))

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
    unknown : set of str
        Variables whose last assignment could not be evaluated.
    remarks : Remarks
        Statements that could not be evaluated, with their lines.
    """

    path: Path
    items: dict[tuple[str, int], Item] = field(default_factory=dict)
    variables: dict[str, Entry] = field(default_factory=dict)
    unknown: set[str] = field(default_factory=set)
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
