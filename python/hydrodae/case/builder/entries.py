"""Tables of a scene with the calls that made them, and the messages that name these."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from hydrodae.case.case import to_toml
from hydrodae.case.tables import Key, Table
from hydrodae.errors import CaseError

_PLACE = re.compile(r"<case>:(\d+):\d+: ")


@dataclass(frozen=True)
class Entry:
    """One table of a scene that is being built.

    Attributes
    ----------
    call : str
        What messages name it by: ``scene.joint.revolute("hinge1")``.
    label : str
        What the kernel calls it: ``[[joint]] 'hinge1'``.
    text : str
        The table as TOML.
    """

    call: str
    label: str
    text: str

    def tell(self, message: str) -> str:
        """Return what the kernel says about this entry with the call in front."""
        text = message.replace(f" in {self.label}", "", 1).replace(f" of {self.label}", "", 1)
        table, _, name = self.label.strip("[]").partition("]] ")
        return f"{self.call}: {text.removeprefix(f'{table} {name}: ')}"


class Teller:
    """Names the calls where a message of the kernel names places in a text that nobody wrote."""

    def __init__(self, entries: Sequence[Entry]) -> None:
        self._entries = tuple(entries)

    def __call__(self, message: str) -> str:
        """Return the message with the call in front, as far as one is meant."""
        place = _PLACE.match(message)
        if place is None:
            return message if message.startswith("--set ") else f"scene: {message}"
        line, said = int(place[1]), message[place.end() :]
        last = 2  # the title and an empty line
        for entry in self._entries:
            first, last = last, last + entry.text.count("\n") + 1
            if first < line <= last:
                return entry.tell(said)
        return f"scene: {said}"


def make_entry(table: Table, kind: Table, keys: Mapping[str, Any]) -> Entry:
    """Return the entry with these keys, unchecked."""
    name = keys.get("name")
    call = f"scene.{table.name}" + (f".{kind.name}" if kind is not table else "")
    call += f'("{name}")' if name is not None else "()"
    label = f"{table.header} '{name}'" if table.is_list else table.header
    lines = [table.header, *(f"{key} = {to_toml(v, f'{call}: {key}')}" for key, v in keys.items())]
    return Entry(call, label, "\n".join(lines) + "\n")


def check_entry(entry: Entry, kind: Table, keys: Mapping[str, Any]) -> None:
    """Refuse keys that such an entry has not, keys that it must have, and wrong values."""
    from hydrodae import _core

    for name in keys:
        if name not in kind.key_names:
            near = hint(name, [other for other in kind.key_names if other != "type"])
            raise CaseError(f"{entry.call}: unknown key {name!r}{near}")
    for key in kind.keys:
        if key.required and key.name not in keys:
            raise CaseError(f"{entry.call}: missing key {key.name!r} ({_meaning(key)})")
    try:
        _core.check_tables(entry.text)
    except CaseError as error:
        raise CaseError(entry.tell(_PLACE.sub("", str(error), count=1))) from None


def hint(wanted: str, names: list[str]) -> str:
    """Return the end of a message about an unknown name: the nearest one and all valid ones."""
    from hydrodae import _core

    return _core.suggestion(wanted, names)


def _meaning(key: Key) -> str:
    return key.doc.rstrip(".") + ("" if key.unit == "-" else f" [{key.unit}]")
