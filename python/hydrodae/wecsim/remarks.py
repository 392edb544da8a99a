"""What an import could not carry over, assumed or found unneeded: each with its place."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Remark:
    """One thing to know about an import.

    Attributes
    ----------
    kind : str
        "left out" (the case lacks it), "assumed" (a decision was taken) or "not needed".
    place : str
        File and line, or model and block.
    text : str
        What it is.
    """

    kind: str
    place: str
    text: str

    def __str__(self) -> str:
        return f"{self.place}: {self.text}"


@dataclass
class Remarks:
    """A list of remarks, in the order in which they were made."""

    items: list[Remark] = field(default_factory=list)

    def left_out(self, place: str, text: str) -> None:
        """Note what the case does not hold."""
        self._add("left out", place, text)

    def assumed(self, place: str, text: str) -> None:
        """Note a decision."""
        self._add("assumed", place, text)

    def not_needed(self, place: str, text: str) -> None:
        """Note what has no counterpart since nothing here depends on it."""
        self._add("not needed", place, text)

    def of(self, kind: str) -> list[Remark]:
        """Those of one kind."""
        return [item for item in self.items if item.kind == kind]

    def _add(self, kind: str, place: str, text: str) -> None:
        remark = Remark(kind, place, text)
        if remark not in self.items:
            self.items.append(remark)
