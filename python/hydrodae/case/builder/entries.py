"""Tables of a scene with the calls that made them, and the messages that name these."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from hydrodae.case.case import to_toml
from hydrodae.case.tables import Key, Table
from hydrodae.errors import CaseError


@dataclass(frozen=True)
class Entry:
    """One table of a scene that is being built.

    Attributes
    ----------
    call : str
        What messages name it by: ``scene.joint.revolute("hinge1")``.
    path : str
        Of its keys: ``joint.hinge1``.
    label : str
        What the kernel calls it: ``[[joint]] 'hinge1'``.
    text : str
        The table as TOML.
    """

    call: str
    path: str
    label: str
    text: str

    def locate(self, error: CaseError) -> CaseError:
        """Return what the kernel says about this entry as an error that names the call."""
        text = error.fault.replace(f" in {self.label}", "", 1).replace(f" of {self.label}", "", 1)
        table, _, name = self.label.strip("[]").partition("]] ")
        fault = text.removeprefix(f"{table} {name}: ")
        return CaseError(fault, key=error.key, file=self.call)


class Calls:
    """Names the calls where the kernel names places in a text that nobody wrote."""

    def __init__(self, entries: Sequence[Entry]) -> None:
        self._entries = tuple(entries)

    def error(self, error: CaseError) -> CaseError:
        """Return the error with the call in place of the file, as far as one is meant."""
        if error.file.startswith("--set "):
            return error
        entry = self._at(error.line)
        if entry is None:
            return CaseError(error.fault, key=error.key, file="scene")
        return entry.locate(error)

    def place(self, place: tuple[str, int, int]) -> tuple[str, int, int]:
        """Return the call in place of a line of the text."""
        entry = self._at(place[1])
        return place if entry is None else (entry.call, 0, 0)

    def _at(self, line: int) -> Entry | None:
        last = 2  # the title and an empty line
        for entry in self._entries:
            first, last = last, last + entry.text.count("\n") + 1
            if first < line <= last:
                return entry
        return None


def make_entry(table: Table, kind: Table, keys: Mapping[str, Any]) -> Entry:
    """Return the entry with these keys, unchecked."""
    name = keys.get("name")
    call = f"scene.{table.name}" + (f".{kind.name}" if kind is not table else "")
    call += f'("{name}")' if name is not None else "()"
    label = f"{table.header} '{name}'" if table.is_list else table.header
    path = table.name if name is None else f"{table.name}.{name}"
    lines = [table.header]
    for key, value in keys.items():
        try:
            lines.append(f"{key} = {to_toml(value, key)}")
        except CaseError as error:
            raise CaseError(error.fault, key=f"{path}.{key}", file=call) from None
    return Entry(call, path, label, "\n".join(lines) + "\n")


def check_entry(entry: Entry, kind: Table, keys: Mapping[str, Any]) -> None:
    """Refuse keys that such an entry has not, keys that it must have, and wrong values."""
    from hydrodae import _core

    for name in keys:
        if name not in kind.key_names:
            near = hint(name, [other for other in kind.key_names if other != "type"])
            raise CaseError(
                f"unknown key {name!r}{near}", key=f"{entry.path}.{name}", file=entry.call
            )
    for key in kind.keys:
        if key.required and key.name not in keys:
            raise CaseError(
                f"missing key {key.name!r} ({_meaning(key)})",
                key=f"{entry.path}.{key.name}",
                file=entry.call,
            )
    try:
        _core.check_tables(entry.text)
    except CaseError as error:
        raise entry.locate(error) from None


def hint(wanted: str, names: list[str]) -> str:
    """Return the end of a message about an unknown name: the nearest one and all valid ones."""
    from hydrodae import _core

    return _core.suggestion(wanted, names)


def _meaning(key: Key) -> str:
    return key.doc.rstrip(".") + ("" if key.unit == "-" else f" [{key.unit}]")
