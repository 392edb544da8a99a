"""Errors that tests expect, by their fields: the words are free to change."""

from __future__ import annotations

from pathlib import Path

import pytest

from hydrodae.errors import CaseError, DatabaseError, SolverError


def wrong(key: str) -> pytest.RaisesExc[CaseError]:
    """Expect a CaseError about this key of the case."""
    return pytest.RaisesExc(CaseError, check=lambda error: error.key == key)


def stopped(reason: str, subject: str | None = None) -> pytest.RaisesExc[SolverError]:
    """Expect a SolverError for this reason, about this subject if one is given."""

    def meant(error: SolverError) -> bool:
        return error.reason == reason and subject in (None, error.subject)

    return pytest.RaisesExc(SolverError, check=meant)


def refused(
    reason: str, subject: str | None = None, *, file: str | None = None, line: int | None = None
) -> pytest.RaisesExc[DatabaseError]:
    """Expect a DatabaseError for this reason, with the subject, name of file and line given."""

    def meant(error: DatabaseError) -> bool:
        found = (error.reason, error.subject, Path(error.file).name, error.line)
        wanted = (reason, subject, file, line)
        return all(one in (None, other) for one, other in zip(wanted, found, strict=True))

    return pytest.RaisesExc(DatabaseError, check=meant)
