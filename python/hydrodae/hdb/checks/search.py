"""The search: where a table breaks a law of physics, which one change would make it obey all.

A law is a function of a database whose findings are errors or warnings where a dimensionless
residual exceeds its limit. Every change (`hydrodae.hdb.checks.changes`) is tried against all laws.
One mends a finding that is gone after it, where no other finding is new or worse; of several those
that leave least are named.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np

from hydrodae.hdb.checks.changes import Change, changes, factors, of_depth
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import SEVERITIES, Finding

Law = Callable[[HydroDatabase], list[Finding]]
#: Checks whose value is a ratio of two sizes: a factor may be fitted to them.
RATIOS = (
    "damping from one heading",
    "damping from hull",
    "units of frequency",
    "added mass from force",
)
#: Checks that say nothing where they pass, and judge every table.
SILENT = (
    "sign of A",
    "sign of B",
    "added mass of zero",
    "damping of zero",
    "size of the hull",
    "motions of a body",
    "hydrostatics",
)
#: Level of errors.
ERROR = len(SEVERITIES) - 1
#: Most changes that are named.
NAMED = 3


def law_findings(db: HydroDatabase, laws: Sequence[Law]) -> list[Finding]:
    """Judge a database by laws; what breaks one says which change would mend it.

    Parameters
    ----------
    db : HydroDatabase
    laws : sequence of functions
        Each returns the findings of a database; one that passes is there as "info": a law
        without a finding does not judge the table (but `SILENT`).
    """
    by_law = [law(db) for law in laws]
    found = [f for findings in by_law for f in findings]
    before = _levels(found)
    if not any(before.values()):
        return found
    order = sorted(range(len(laws)), key=lambda n: -max(_levels(by_law[n]).values(), default=0))
    broken = sum(any(_levels(findings).values()) for findings in by_law)
    tried = [laws[n] for n in order]
    errors = max(before.values()) == ERROR
    # warnings are a few per cent, which no other unit or label is
    mends = list(_mends(changes(db) if errors else of_depth(db), tried, broken, before))
    if errors and not mends:
        mends = list(_mends(_fitted(db, found), tried, broken, before))
    return [replace(f, message=f.message + _hint(f, mends)) for f in found]


def _levels(found: Iterable[Finding]) -> dict[str, int]:
    """Return the worst level of each check: 2 of errors, 1 of warnings, 0 of what passes."""
    levels: dict[str, int] = {}
    for f in found:
        level = ERROR - SEVERITIES.index(f.severity)
        levels[f.check] = max(level, levels.get(f.check, 0))
    return levels


def _mends(
    tried: Iterator[Change], laws: list[Law], broken: int, before: dict[str, int]
) -> Iterator[tuple[int, str, set[str]]]:
    """Yield what each change that makes nothing worse leaves, its text, and the checks it mends.

    The first laws, `broken` of them, are those that the database breaks.
    """
    wrong = {check for check, level in before.items() if level}
    for text, changed in tried:
        after = _levels_after(changed, laws[:broken], before)
        if after is None:
            continue
        mended = {c for c in wrong if not after.get(c, 0) and (c in after or c in SILENT)}
        if not mended:
            continue
        others = _levels_after(changed, laws[broken:], before)
        # a law that does not judge the changed table is not obeyed
        if others is not None and before.keys() - wrong <= after.keys() | others.keys():
            yield sum(after.values()), text, mended


def _levels_after(
    db: HydroDatabase, laws: list[Law], before: dict[str, int]
) -> dict[str, int] | None:
    """Return the levels of a changed database by some laws; None where one is worse."""
    after: dict[str, int] = {}
    for law in laws:
        after |= _levels(law(db))
        if any(level > before.get(check, 0) for check, level in after.items()):
            return None
    return after


def _fitted(db: HydroDatabase, found: list[Finding]) -> Iterator[Change]:
    """Yield the tables with factors that residuals give."""
    for f in found:
        if f.severity == "info" or f.check not in RATIOS or not 0.0 < f.value < np.inf:
            continue
        for power in (1.0, -1.0, 0.5, -0.5):
            factor = f.value**power
            yield from factors(db, factor, f"{factor:.3g} (fitted)")


def _hint(finding: Finding, mends: list[tuple[int, str, set[str]]]) -> str:
    """Return the changes that mend a finding and leave least else."""
    if finding.severity == "info":
        return ""
    able = [(left, text) for left, text, mended in mends if finding.check in mended]
    if not able:
        return "; nothing tried here mends it" if finding.severity == "error" else ""
    least = min(able)[0]
    best = dict.fromkeys(text for left, text in able if left == least)
    return f"; right if {', or if '.join(islice(best, NAMED))}"
