"""What a sweep has finished so far: a file of lines that survives a kill at any moment."""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import zlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Self

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.support.version import version

Row = dict[str, Any]
HEAD = b'{"hydrodae_sweep": 1'


#: What a line can be instead of JSON of ours: damaged, or written by something else.
_DAMAGE = (ValueError, KeyError, TypeError, AttributeError, RecursionError)


def identity_of(case: Case, measured: Iterable[object], more: str = "") -> dict[str, str]:
    """Return what the numbers of a row depend on, but for its point, by name.

    Parameters
    ----------
    case : Case
        Its text counts, and every file that it reads (`Scene.text_of_files`).
    measured : iterable
        What is measured, as objects whose texts show all of it.
    more : str
        Lines of further files, as in `Scene.text_of_files`.
    """
    return {
        "version of hydrodae": version(),
        "case": _digest(case.text),
        "measure": _digest("\0".join(map(str, measured))),
        "files": case.scene.text_of_files + more,
    }


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


class Journal:
    """Rows of finished runs in a file beside the results, each on the disk before the next.

    The first line says what the rows belong to; a last line that is cut off is left out. Each row
    has a checksum. The file is locked by the sweep that writes it.

    Parameters
    ----------
    path : path
    identity : mapping from str to str
        Of `identity_of`.

    Raises
    ------
    CaseError
        The file belongs to something else, is damaged, or another sweep is writing it.
    """

    def __init__(self, path: Path, identity: Mapping[str, str]) -> None:
        self.path = path
        self.rows: dict[str, Row] = {}  #: by `point_key`
        self._file = path.open("a+b")
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._file.close()
            raise CaseError(f"{path}: another sweep is writing it") from None
        try:
            self._begin(identity)
        except BaseException:
            self._file.close()
            raise

    def _begin(self, identity: Mapping[str, str]) -> None:
        self._file.seek(0)
        whole, _, cut_off = self._file.read().rpartition(b"\n")
        lines = whole.splitlines()
        if not lines and not HEAD.startswith(cut_off[: len(HEAD)]):
            self._check(cut_off, None)
        if len(lines) > 1:
            self._check(lines[0], identity)
            for number, line in enumerate(lines[1:], 2):
                row = self._row(line, number)
                self.rows[row["key"]] = row
            self._file.truncate(len(whole) + 1)
        else:
            if lines:
                self._check(lines[0], None)
            self._file.truncate(0)
            self._write({"hydrodae_sweep": 1, "identity": dict(identity)})

    def _check(self, line: bytes, identity: Mapping[str, str] | None) -> None:
        """Refuse a file that is no journal, or of another identity (None: of any)."""
        try:
            header = json.loads(line)
            known, found = header["hydrodae_sweep"] == 1, header["identity"]
        except _DAMAGE:
            known, found = False, ""
        if not known:
            raise CaseError(f"{self.path}: is no record of a sweep; it is not replaced")
        if identity is not None and (difference := _difference(found, identity)):
            raise CaseError(
                f"{self.path}: holds runs of {difference}; write to another file, or take this one "
                "away"
            )

    def _row(self, line: bytes, number: int) -> Row:
        """The row of a line, which is as it was written."""
        try:
            row: Row = json.loads(line)
            if row.pop("crc32") == _checksum(row) and isinstance(row["key"], str):
                return row
        except _DAMAGE:
            pass
        raise CaseError(
            f"{self.path}:{number}: this line is damaged; remove the line, and its run is made "
            "again"
        )

    def add(self, row: Row) -> None:
        """Keep a finished run."""
        self._write(row | {"crc32": _checksum(row)})
        self.rows[row["key"]] = row

    def _write(self, row: Row) -> None:
        self._file.write(json.dumps(row).encode() + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()


def _checksum(row: Row) -> int:
    return zlib.crc32(json.dumps(row).encode())


def _difference(found: Any, identity: Mapping[str, str]) -> str:
    """What runs are of that have another identity; empty: they have this one."""
    from hydrodae import _core

    if not isinstance(found, dict):
        return "another version of hydrodae"
    for what, now in identity.items():
        before = str(found.get(what, ""))
        if before == now:
            continue
        if what == "files":
            return f"other inputs than this study's: {_core.changed_file(before, now)}"
        return f"another {what} than this study's"
    return ""
