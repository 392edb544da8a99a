"""What a sweep has finished so far: a file of lines that survives a kill at any moment."""

from __future__ import annotations

import fcntl
import json
import os
from pathlib import Path
from typing import Any, Self

from hydrodae.errors import CaseError

Row = dict[str, Any]
HEAD = b'{"hydrodae_sweep": 1'


class Journal:
    """Rows of finished runs in a file beside the results, each on the disk before the next.

    The first line says what the rows belong to; a last line that is cut off is left out. The file
    is locked by the sweep that writes it.

    Parameters
    ----------
    path : path
    identity : str
        Of the case, its database and what is measured.

    Raises
    ------
    CaseError
        The file belongs to something else, or another sweep is writing it.
    """

    def __init__(self, path: Path, identity: str) -> None:
        self.path = path
        self.rows: dict[str, Row] = {}  #: by `point_key`
        self._file = path.open("a+b")
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self._file.close()
            raise CaseError(f"{path}: another sweep is writing it") from None
        self._begin(identity)

    def _begin(self, identity: str) -> None:
        self._file.seek(0)
        whole, _, cut_off = self._file.read().rpartition(b"\n")
        lines = whole.splitlines()
        if not lines and not HEAD.startswith(cut_off[: len(HEAD)]):
            self._check(cut_off, None)
        if len(lines) > 1:
            self._check(lines[0], identity)
            for line in lines[1:]:
                row = json.loads(line)
                self.rows[row["key"]] = row
            self._file.truncate(len(whole) + 1)
        else:
            if lines:
                self._check(lines[0], None)
            self._file.truncate(0)
            self._write({"hydrodae_sweep": 1, "identity": identity})

    def _check(self, line: bytes, identity: str | None) -> None:
        """Refuse a file that is no journal, or of another identity (None: of any)."""
        try:
            header = json.loads(line)
            known, found = header["hydrodae_sweep"] == 1, header["identity"]
        except (ValueError, KeyError, TypeError):
            known, found = False, ""
        if known and identity in (found, None):
            return
        self._file.close()
        if not known:
            raise CaseError(f"{self.path}: is no record of a sweep; it is not replaced")
        raise CaseError(
            f"{self.path}: holds runs of another case, database or measure than this study's; "
            "write to another file, or take this one away"
        )

    def add(self, row: Row) -> None:
        """Keep a finished run."""
        self._write(row)
        self.rows[row["key"]] = row

    def _write(self, row: Row) -> None:
        self._file.write(json.dumps(row).encode() + b"\n")
        self._file.flush()
        os.fsync(self._file.fileno())

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()
