"""What a check found: severity, numbers, and the frequency where it hurts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

SEVERITIES = ("error", "warning", "info")


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

    def __str__(self) -> str:
        """All findings, worst first, and a count."""
        lines = [str(f) for s in SEVERITIES for f in self.of(s)]
        counts = ", ".join(f"{len(self.of(s))} {s}" for s in SEVERITIES)
        return "\n".join([*lines, f"checks: {counts}"])
