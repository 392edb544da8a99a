"""All findings on one page, and a verdict."""

from __future__ import annotations

import shutil
import textwrap

from hydrodae.hdb.database.findings import SEVERITIES, CheckReport

TITLES = {
    "error": "ERRORS: a simulation with this database will be wrong",
    "warning": "WARNINGS: look at these",
    "info": "passed, or for the record",
}


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
