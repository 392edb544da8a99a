"""What an import could not carry over, assumed or found unneeded: each with its place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from hydrodae.errors import CaseError


@dataclass
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
    part : str
        What the device is without, as `accept` names it: "waves", "pto", "joint", "mooring",
        "cable", "body", "modes", "controller", "force", "current" or "wind"; empty for the rest.
    """

    kind: str
    place: str
    text: str
    part: str = ""

    def __str__(self) -> str:
        return f"{self.place}: {self.text}"


@dataclass
class Remarks:
    """A list of remarks, in the order in which they were made."""

    items: list[Remark] = field(default_factory=list)

    def left_out(self, place: str, text: str, part: str = "") -> Remark:
        """Note what the case does not hold; `part` as in `Remark`."""
        return self._add("left out", place, text, part)

    def assumed(self, place: str, text: str) -> None:
        """Note a decision."""
        self._add("assumed", place, text)

    def not_needed(self, place: str, text: str) -> None:
        """Note what has no counterpart since nothing here depends on it."""
        self._add("not needed", place, text)

    def of(self, kind: str) -> list[Remark]:
        """Those of one kind."""
        return [item for item in self.items if item.kind == kind]

    def check(self, accepted: Sequence[str]) -> None:
        """Refuse parts of the device that are missing and not accepted.

        Raises
        ------
        CaseError
            A part is missing, or `accepted` names one that is not.
        """
        missing: dict[str, list[str]] = {}
        for remark in self.of("left out"):
            if remark.part:
                missing.setdefault(remark.part, []).append(str(remark))
        for word in accepted:
            if word not in missing:
                found = ", ".join(missing) or "nothing"
                raise CaseError(f"--accept {word!r}: this is not missing (missing: {found})")
        left = {part: found for part, found in missing.items() if part not in accepted}
        if left:
            told = "; ".join(f"no {part} ({', '.join(found)})" for part, found in left.items())
            options = " ".join(f"--accept {part}" for part in left)
            raise CaseError(
                f"the case lacks parts of its source: {told}; {options} writes it anyway"
            )

    def _add(self, kind: str, place: str, text: str, part: str = "") -> Remark:
        remark = Remark(kind, place, text, part)
        if remark not in self.items:
            self.items.append(remark)
        return self.items[self.items.index(remark)]
