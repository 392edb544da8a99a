"""What a calibration found."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from hydrodae.case import Case
from hydrodae.study.calibrate.decay import Decay
from hydrodae.study.calibrate.parts import Check, Estimate, Residual
from hydrodae.study.calibrate.picture import draw
from hydrodae.study.calibrate.writing import write_case
from hydrodae.support.arrays import Array
from hydrodae.support.units import displayed


@dataclass(frozen=True)
class Calibration:
    """Fitted parameters of a case; printed, a report.

    Attributes
    ----------
    before, case : Case
        As it was, and with the fitted values.
    keys : dict
        Fitted values by dotted key, as `set` takes them.
    estimates : list of Estimate
    correlation : (n, n) array
        Of the estimates; nan where there is no interval.
    residuals : list of Residual
    checks : list of Check
        Of decays.
    warnings : list of str
    evaluations, runs : int
        Of the search, and of the case.
    """

    before: Case
    case: Case
    keys: dict[str, Any]
    estimates: list[Estimate]
    correlation: Array
    residuals: list[Residual]
    checks: list[Check]
    warnings: list[str]
    evaluations: int
    runs: int

    @property
    def values(self) -> dict[str, float]:
        """Fitted values by name."""
        return {one.name: one.value for one in self.estimates}

    def __str__(self) -> str:
        lines = [f"{self.before.title}: {self.evaluations} evaluations, {self.runs} runs", ""]
        lines += _table_of_estimates(self.estimates)
        if len(self.estimates) > 1 and not np.all(np.isnan(self.correlation)):
            lines += ["", "correlation"]
            for k, one in enumerate(self.estimates):
                row = " ".join(f"{c:7.3f}" for c in self.correlation[k, : k + 1])
                lines.append(f"  {one.name:36} {row}")
        lines += ["", *_table_of_residuals(self.residuals)]
        if self.checks:
            lines += ["", *_table_of_decays(self.checks)]
        lines += [f"warning: {line}" for line in self.warnings]
        return "\n".join(lines)

    def draw(self) -> Figure:
        """Draw each channel of each record: measured, before and after."""
        return draw(self.residuals)

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Write a copy of the case file in which the fitted values stand.

        Raises
        ------
        CaseError
            A value cannot be replaced where it stands, or the copy would not be the same case.
        """
        return write_case(self.before, self.case, self.keys, path)


def _table_of_estimates(estimates: Sequence[Estimate]) -> list[str]:
    lines = [
        f"  {'parameter':36} {'before':>11} {'after':>11}   95 % interval (independent samples)"
    ]
    for one in estimates:
        told = "no interval"
        if np.isfinite(one.half):
            low, high = one.interval
            told = f"{low:.5g} to {high:.5g} ({one.independent:.0f})"
        lines.append(f"  {one.name:36} {one.start:11.5g} {one.value:11.5g}   {told}")
    return lines


def _table_of_residuals(residuals: Sequence[Residual]) -> list[str]:
    lines = [
        "root mean square of the difference (of the measured range)",
        f"  {'record':16} {'channel':36} {'before':>20} {'after':>20}",
    ]
    for one in residuals:
        factor, unit = displayed(one.unit)
        cells = " ".join(
            f"{factor * value:10.4g} ({100 * value / one.span:5.2f} %)"
            for value in (one.before, one.after)
        )
        told = "" if one.fitted else " (predicted, not fitted)"
        lines.append(f"  {one.record:16} {f'{one.channel} [{unit}]':36} {cells}{told}")
    return lines


def _table_of_decays(checks: Sequence[Check]) -> list[str]:
    lines = ["decay by successive peaks: period, damping ratio of the linear part, quadratic part"]
    for check in checks:
        for name in ("measured", "before", "after"):
            found: Decay = getattr(check, name)
            lines.append(
                f"  {check.record:16} {name:10} {found.period:9.5g} s "
                f"{found.damping_ratio:9.4g} {found.quadratic:9.4g} 1/{found.unit}"
            )
    return lines
