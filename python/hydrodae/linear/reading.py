"""A case as the frequency domain needs it: without any memory of radiation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from hydrodae.case import Case
from hydrodae.case.case import CaseLike, read_case
from hydrodae.errors import CaseError


def without_memory(
    case: CaseLike, values: Mapping[str, Any] | None = None
) -> tuple[Case, CaseError | None]:
    """Read a case for the frequency domain, which needs no memory fit and no kernel.

    Parameters
    ----------
    case : Case, Scene or path
    values : dict, optional
        By dotted key, as in `read_case`.

    Returns
    -------
    case : Case
        As it is, or with `hydro.radiation` "none" where its database lacks what its radiation in
        the time domain needs.
    missing : CaseError or None
        What is missing for a run.

    Raises
    ------
    CaseError
        The case cannot be used for another reason.
    """
    try:
        return read_case(case, values), None
    except CaseError as error:
        if error.key != "hydro.database":  # which lacks a fit or a kernel, or cannot be read
            raise
        return read_case(case, {**(values or {}), "hydro.radiation": "none"}), error
