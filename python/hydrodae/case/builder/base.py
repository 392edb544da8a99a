"""What a scene does whatever its tables are."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydrodae.case import Case
from hydrodae.case.builder.entries import Calls, Entry, check_entry, hint, make_entry
from hydrodae.case.case import to_toml
from hydrodae.case.tables import Table, owners_of, tables
from hydrodae.errors import CaseError


class SceneBase:
    """What `hydrodae.Scene` does apart from the methods that are named as tables."""

    def __init__(self, title: str = "", *, directory: str | os.PathLike[str] = ".") -> None:
        self._title = title
        self._directory = Path(directory)
        self._entries: list[Entry] = []

    @property
    def title(self) -> str:
        """Title of the case."""
        return self._title

    def to_toml(self) -> str:
        """Return the case file of the calls so far, in their order."""
        return "\n".join([f"title = {to_toml(self._title)}\n", *(e.text for e in self._entries)])

    def case(self, values: Mapping[str, Any] | None = None) -> Case:
        """Check the whole scene and return it as a case.

        Parameters
        ----------
        values : mapping from str, optional
            Values that replace those of the scene, by dotted key: ``{"solver.rtol": 1e-8}``.

        Raises
        ------
        CaseError
            The scene cannot be used; the message names the call that is wrong.
        """
        return Case(
            self.to_toml(), directory=self._directory, values=values, origin=Calls(self._entries)
        )

    def save(self, path: str | os.PathLike[str]) -> Case:
        """Write the scene as a case file, and return the case that is then read from it.

        Relative paths in the scene refer to the folder of the file from then on.

        Raises
        ------
        CaseError
            The scene cannot be used, also with the paths that it has there. The file is written
            only if the scene can be used where it was made.
        """
        self.case()
        Path(path).write_text(self.to_toml(), encoding="utf-8")
        return Case.read(path)

    def __repr__(self) -> str:
        return f"<hydrodae.Scene {self._title!r}: {len(self._entries)} entries>"

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_"):
                raise AttributeError(name)
            near = hint(name, [table.name for table in tables()])
            calls = [f"scene.{owner.name}.{name}" for owner in owners_of(name)]
            said = f"; did you mean {' or '.join(calls)}?" if calls else near
            raise AttributeError(f"a scene has no {name!r}{said}")

    def _add(self, table: Table, kind: Table, keys: Mapping[str, Any]) -> str | None:
        """Check one entry by itself and keep it; returns its name, if it has one."""
        entry = make_entry(table, kind, keys)
        if not table.is_list and any(entry.call == other.call for other in self._entries):
            raise CaseError(f"called before; a case has one {table.header}", file=entry.call)
        check_entry(entry, kind, keys)
        self._entries.append(entry)
        return keys.get("name")


class TypedList:
    """A list of a scene whose entries have types: one method for each."""

    def __init__(self, scene: SceneBase, table: Table) -> None:
        self._scene = scene
        self._table = table

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            if name.startswith("_"):
                raise AttributeError(name)
            near = hint(name, [kind.name for kind in self._table.types])
            raise AttributeError(f"scene.{self._table.name} has no type {name!r}{near}")

    def __repr__(self) -> str:
        return f"<{self._table.header} of a scene: {', '.join(k.name for k in self._table.types)}>"
