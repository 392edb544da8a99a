"""Errors that tests expect, by their fields: the words are free to change."""

from __future__ import annotations

import pytest

from hydrodae.errors import CaseError, SolverError


def wrong(key: str) -> pytest.RaisesExc[CaseError]:
    """Expect a CaseError about this key of the case."""
    return pytest.RaisesExc(CaseError, check=lambda error: error.key == key)


def stopped(reason: str, subject: str | None = None) -> pytest.RaisesExc[SolverError]:
    """Expect a SolverError for this reason, about this subject if one is given."""

    def meant(error: SolverError) -> bool:
        return error.reason == reason and subject in (None, error.subject)

    return pytest.RaisesExc(SolverError, check=meant)
