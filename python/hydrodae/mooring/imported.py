"""Tables of a case that stand for the moorings of another program."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from hydrodae.case.case import to_toml


@dataclass
class Imported:
    """Tables of a case that stand for the input file of another program.

    Attributes
    ----------
    source : str
        The file.
    seabed : dict
        Keys of `[seabed]`; empty: none.
    bodies, joints, forces, morison : list of dict
        Keys of each `[[body]]`, `[[joint]]`, `[[force]]` and `[[morison]]`.
    notes : list of str
        What the tables do not hold of the file, and what was assumed, each below the file and the
        line that it is about.
    """

    source: str
    seabed: dict[str, Any] = field(default_factory=dict)
    bodies: list[dict[str, Any]] = field(default_factory=list)
    joints: list[dict[str, Any]] = field(default_factory=list)
    forces: list[dict[str, Any]] = field(default_factory=list)
    morison: list[dict[str, Any]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def note(self, text: str, line: int | None = None) -> None:
        """Add a note about a line of the file, or about all of it."""
        self.notes.append(f"{self.source}{'' if line is None else f':{line}'}: {text}")

    def __str__(self) -> str:
        return self.to_toml()

    def to_toml(self) -> str:
        """Return the tables as they stand in a case file, with the notes above them."""
        lines = [f"# Moorings of {self.source}", *(f"# - {note}" for note in self.notes)]
        for header, tables in (
            ("[seabed]", [self.seabed] if self.seabed else []),
            ("[[body]]", self.bodies),
            ("[[joint]]", self.joints),
            ("[[force]]", self.forces),
            ("[[morison]]", self.morison),
        ):
            for table in tables:
                lines += ["", header]
                lines += [f"{key} = {to_toml(value, key)}" for key, value in table.items()]
        return "\n".join(lines) + "\n"
