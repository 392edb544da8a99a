"""What a fit missed, in words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

PASSIVE_LIMIT = -1e-4
"""A fit is passive when the smallest eigenvalue of Re H is above this share of the largest."""
NOISY = -1e-3
"""Tables whose B has eigenvalues below this share of the largest are reported as noisy."""
CHECKS = ("passive", "target")
"""What a fit may miss, by the names under which it can be accepted all the same."""


def missed(report: Mapping[str, Any]) -> dict[str, str]:
    """Return what the fit of this report missed: name in `CHECKS`, and a sentence without subject.

    Fits of other sources, whose reports are empty, miss nothing.
    """
    found: dict[str, str] = {}
    if not report.get("passive", True):
        found["passive"] = (
            f"is not passive: Re H falls to {report['min_eig_re_h_relative']:.1e} of its largest "
            f"eigenvalue at {report['min_eig_re_h_omega']:.3g} rad/s (limit {PASSIVE_LIMIT:g}), "
            f"the data to {_lowest(report)}; a free device may be unstable"
        )
    if not report.get("target_met", True):
        found["target"] = (
            f"misses its target with {report['n_states']} states: {_errors(report)}{_why(report)}"
        )
    if report.get("time_limited", False):
        found = {key: f"{text}; the time limit ended the search" for key, text in found.items()}
    return found


def _errors(report: Mapping[str, Any]) -> str:
    """Return the errors and their targets."""
    low, high = report["band"]
    inside = f"H is off by {report['h_error_band']:.2g} (rms) in {low:.3g}..{high:.3g} rad/s"
    if "uniform" in report:
        return (
            f"{inside}, at most by {report['h_error_peak']:.2g} of its largest entry "
            f"(target {report['uniform']:g})"
        )
    return (
        f"{inside}; weighted error {report['weighted_error_band']:.1e} in the band (target "
        f"{report['target']:g}), {report['weighted_error_outside']:.1e} outside (target "
        f"{report['target_outside']:g})"
    )


def _lowest(report: Mapping[str, Any]) -> str:
    """Return the lowest eigenvalue of the tables, in the band and wherever it is."""
    lowest = f"{report['data_min_eig_relative']:.1e}"
    if "data_min_eig_band" not in report:  # a file of an earlier version
        return lowest
    return (
        f"{report['data_min_eig_band']:.1e} in the band and {lowest} at "
        f"{report['data_min_eig_omega']:.3g} rad/s"
    )


def _why(report: Mapping[str, Any]) -> str:
    """Name noise as the reason where the tables themselves give energy to the body.

    That of the band where it is there; outside only where the error outside is above its target.
    """
    lowest, omega = report["data_min_eig_relative"], report.get("data_min_eig_omega")
    where = "" if omega is None else f" at {omega:.3g} rad/s, outside the band"
    if report.get("data_min_eig_band", 0.0) < NOISY:
        lowest = report["data_min_eig_band"]
        where = f" at {report['data_min_eig_band_omega']:.3g} rad/s, in the band"
    elif omega is not None and (
        report.get("weighted_error_outside", 0.0) <= report.get("target_outside", np.inf)
    ):
        return ""
    if lowest >= NOISY:
        return ""
    return (
        f"; the tables are noisy: B has eigenvalues down to {lowest:.1e} of the largest{where}, "
        "and what gives energy to the body no passive fit follows"
    )
