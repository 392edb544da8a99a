"""What a check found: severity, numbers, and the frequency where it hurts."""

from __future__ import annotations

import math
import re
import shutil
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from hydrodae.errors import DatabaseError

#: Severities, worst first, and their titles.
TITLES = {
    "error": "ERRORS: a simulation with this database will be wrong",
    "warning": "WARNINGS: look at these",
    "info": "passed, or for the record",
}
SEVERITIES = tuple(TITLES)


@dataclass(frozen=True)
class Finding:
    """One line of a report.

    Attributes
    ----------
    severity : str
        "error": a simulation with it will be wrong; "warning": look at it; "info": for the record.
    check : str
        What was checked.
    message : str
        What came out, in words.
    value : float
        The number that decided; NaN if there is none.
    omega : float or None
        Where it hurts most [rad/s].
    """

    severity: str
    check: str
    message: str
    value: float = math.nan
    omega: float | None = None

    @property
    def name(self) -> str:
        """The check as one word for a command line: `b-positive-semidefinite`."""
        return "-".join(re.findall(r"[a-z0-9]+", self.check.lower()))

    def __str__(self) -> str:
        """One line: severity, check, message, frequency."""
        at = "" if self.omega is None else f" [w = {self.omega:.4g} rad/s]"
        return f"{self.severity:8s}{self.check}: {self.message}{at}"


@dataclass
class CheckReport:
    """Findings of one import, worst first when printed."""

    findings: list[Finding] = field(default_factory=list)

    def __iter__(self) -> Iterator[Finding]:
        """Iterate over the findings in the order of the checks."""
        return iter(self.findings)

    def of(self, severity: str) -> list[Finding]:
        """Findings of one severity."""
        return [f for f in self.findings if f.severity == severity]

    def find(self, check: str) -> list[Finding]:
        """Findings whose check begins with the given words."""
        return [f for f in self.findings if f.check.startswith(check)]

    @property
    def ok(self) -> bool:
        """True if there is no error."""
        return not self.of("error")

    def left(self, accepted: Sequence[str]) -> list[Finding]:
        """Errors that `accepted`, a list of names of checks, does not name.

        Raises
        ------
        DatabaseError
            A name that no error of the report has.
        """
        names = [f.name for f in self.of("error")]
        for word in accepted:
            if word not in names:
                found = ", ".join(dict.fromkeys(names)) or "none"
                raise DatabaseError(
                    f"--accept {word!r}: no error of that name (errors: {found})"
                ).about("option", word)
        return [f for f in self.of("error") if f.name not in accepted]

    def __str__(self) -> str:
        """All findings, worst first, and a count."""
        lines = [str(f) for s in SEVERITIES for f in self.of(s)]
        counts = ", ".join(f"{len(self.of(s))} {s}" for s in SEVERITIES)
        return "\n".join([*lines, f"checks: {counts}"])


def examination(report: CheckReport, width: int | None = None) -> str:
    """Return the findings as text, worst first, wrapped to the terminal.

    Parameters
    ----------
    report : CheckReport
    width : int, optional
        Columns; by default those of the terminal, at most 100.
    """
    columns = width or min(100, shutil.get_terminal_size((100, 24)).columns)
    lines: list[str] = []
    for severity in SEVERITIES:
        found = report.of(severity)
        if not found:
            continue
        lines.append(TITLES[severity])
        for finding in found:
            at = "" if finding.omega is None else f" [w = {finding.omega:.4g} rad/s]"
            text = f"{finding.check}: {finding.message}{at}"
            lines += textwrap.wrap(text, columns, initial_indent="  - ", subsequent_indent="    ")
        lines.append("")
    counts = f"{len(report.of('error'))} errors, {len(report.of('warning'))} warnings"
    verdict = "fit for use" if report.ok else "NOT fit for use as it is"
    if report.ok and report.of("warning"):
        verdict = "usable with care"
    return "\n".join([*lines, f"verdict: {verdict} ({counts})"])
