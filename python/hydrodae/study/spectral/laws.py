"""Loads along a joint that depend on its rate alone, as the case file has them.

The equations are those of cpp/hydrodae/element: pto_general.h, friction_stribeck.h,
friction_lugre.h, dry_friction.h. Each is turned round: a positive load is against the motion.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.study.spectral.factors import Law
from hydrodae.support.arrays import Array
from hydrodae.support.curve import monotone_curve

Table = Mapping[str, Any]


def law_of(force: Table) -> Law | None:
    """The law of a force along a joint; None for one that the linear model has as it is.

    Raises
    ------
    CaseError
        The force is nonlinear, and not by the rate of its joint alone.
    """
    if "static_coefficient" in force:
        raise CaseError(
            f"force {force['name']!r}: friction pressed by the reaction of its joint has no linear "
            "equivalent here; give a constant 'static' load, or run it in the time domain"
        )
    make = _LAWS.get(force["type"])
    return None if make is None else make(force)


def _hydraulic(force: Table) -> Law:
    raise CaseError(
        f"force {force['name']!r}: type 'pto_hydraulic' has no linear equivalent here, as its "
        "pressures follow the sea; run it in the time domain"
    )


def _dry(force: Table) -> Law:
    kinetic = float(force.get("kinetic", force["static"]))
    return lambda v: kinetic * np.sign(v)


def _stribeck(force: Table) -> Law:
    """g(v) v / sqrt(v^2 + v_0^2) + sigma v, g = F_c + (F_s - F_c) exp(-(v / v_s)^2).

    Bristles that slip are the same with v_0 = 0; their own stretch is left out.
    """
    stick = float(force["static"])
    slip = float(force.get("kinetic", stick))
    creep = float(force.get("creep_rate", 0.0))
    rate = float(force.get("stribeck_rate", 10.0 * creep))
    viscous = float(force.get("viscous", 0.0))

    def law(v: Array) -> Array:
        g = slip + (stick - slip) * np.exp(-((v / rate) ** 2))
        direction = v / np.hypot(v, creep) if creep > 0.0 else np.sign(v)
        return np.asarray(g * direction + viscous * v)

    return law


def _general(force: Table) -> Law | None:
    """Damper c |v|^(n-1) v + F_0 v / sqrt(v^2 + v_0^2) + F_c(v), within its limits."""
    c, n = float(force.get("damping", 0.0)), float(force.get("exponent", 1.0))
    constant, reversal = float(force.get("constant", 0.0)), float(force.get("reversal_rate", 0.0))
    most = float(force.get("load_limit", np.inf))
    power = float(force.get("power_limit", np.inf))
    limited = np.isfinite(most) or np.isfinite(power)
    at = np.asarray(force.get("damper_at", []), dtype=float)
    springs = [key for key in ("stiffness", "spring_at") if np.any(force.get(key, 0.0))]
    if limited and springs:
        raise CaseError(
            f"force {force['name']!r}: a limit of load or power on a force with {springs[0]!r} has "
            "no linear equivalent here; run it in the time domain"
        )
    if n == 1.0 and not constant and not at.size and not limited:
        return None
    curve = monotone_curve(at, force["damper_load"]) if at.size else None

    def law(v: Array) -> Array:
        load = c * np.abs(v) ** (n - 1.0) * v
        if constant:
            load = load + constant * v / np.hypot(v, reversal)
        if curve is not None:
            load = load + curve(v)
        limit = np.minimum(most, power / np.maximum(np.abs(v), 1e-300))
        return np.asarray(np.clip(load, -limit, limit))

    return law


_LAWS: Mapping[str, Callable[[Table], Law | None]] = {
    "pto_hydraulic": _hydraulic,
    "pto_general": _general,
    "dry_friction": _dry,
    "friction_stribeck": _stribeck,
    "friction_lugre": _stribeck,
}
