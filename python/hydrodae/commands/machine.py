"""What commands print with --json: one object on standard output, numbers in SI units."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray

    from hydrodae.hdb.database import HydroDatabase
    from hydrodae.hdb.database.findings import CheckReport
    from hydrodae.linear import Response
    from hydrodae.linear.modes import Mode
    from hydrodae.results import Results
    from hydrodae.study.calibrate import Calibration
    from hydrodae.study.drift import Drift, Offset
    from hydrodae.study.equilibrium import Equilibrium
    from hydrodae.study.rao.responses import Rao
    from hydrodae.study.slow import SlowMotion
    from hydrodae.study.spectral import Spectral
    from hydrodae.study.spectral.seeds import Seeds
    from hydrodae.study.sweep.optimise import Optimum


def print_json(content: Mapping[str, Any]) -> None:
    """Print an object; numbers that are not finite become null."""
    print(json.dumps(plain(content), indent=1, allow_nan=False))


def plain(value: Any) -> Any:
    """Return what JSON can hold: complex numbers as [real, imaginary], arrays as lists."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, str | bytes):
        return [plain(item) for item in value]
    if isinstance(value, complex):
        return [plain(value.real), plain(value.imag)]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if isinstance(value, bool | int | float | str | None) else str(value)


def of_modes(modes: Sequence[Mode]) -> list[dict[str, Any]]:
    """Natural modes."""
    return [vars(mode) for mode in modes]


def of_equilibrium(found: Equilibrium) -> dict[str, Any]:
    """Pose, reactions, tensions, stiffness and modes."""
    stiffness = found.stiffness
    return {
        "title": found.title,
        "offsets": found.offsets,
        "rotations": found.rotations,
        "reactions": found.reactions,
        "supports": found.supports,
        "tensions": found.tensions,
        "moorings": {
            "bodies": stiffness.bodies,
            "load": stiffness.load,
            "stiffness": stiffness.stiffness,
            "damping": stiffness.damping,
        },
        "modes": of_modes(found.modes),
        "notes": found.notes,
    }


def of_rao(found: Rao) -> dict[str, Any]:
    """Modes and responses, and those in the sea of the case if it has one."""
    deviations, powers = found.in_sea() if found.model.case.scene.wave_names else ({}, {})
    return {
        "title": found.model.case.scene.title,
        "modes": of_modes(found.modes),
        "response": _of_response(found.response),
        "chosen": _of_response(found.chosen),
        "in_sea": {"standard_deviation": deviations, "mean_power": powers},
        "slow_motion": _of_slow(found.slow_motion()),
        "notes": found.notes,
    }


def _of_slow(found: SlowMotion | None) -> dict[str, Any] | None:
    from hydrodae.study.slow.text import content

    return None if found is None else content(found)


def of_drift(found: Drift, offset: Offset | None) -> dict[str, Any]:
    """Drift over frequency and pair of headings, its error, powers, and the mean offset."""
    told = {
        "title": found.title,
        "carrier": found.carrier.body,
        "omega": found.omega,
        "headings": found.heading[found.pairs],
        "surge": found.load[:, :, 0],
        "sway": found.load[:, :, 1],
        "yaw": found.load[:, :, 2],
        "along": found.along,
        "by_energy": found.by_power,
        "power": found.power,
        "mean_power": found.by_force,
        "error": found.error,
        "maruo_margin": found.margin,
    }
    if offset is not None:
        told["offset"] = {
            "load": offset.load,
            "offset": offset.offset,
            "steps": offset.steps,
            "offsets": offset.held,
            "rotations": offset.turned,
        }
    return told


def _of_response(response: Response) -> dict[str, Any]:
    """Amplitude and phase [rad] of each channel over omega [rad/s], per metre of wave amplitude."""
    columns = {
        name: {"unit": unit, "amplitude": np.abs(response[name]), "phase": np.angle(response[name])}
        for name, unit in zip(response.names, response.units, strict=True)
    }
    head = {"omega": response.omega, "heading": response.heading, "channels": columns}
    return head | {"mean_power": response.power}


def of_run(results: Results) -> dict[str, Any]:
    """How a run ended, where its results are, and its figures (costs, powers, error)."""
    return {
        "title": results.title,
        "status": results.status,
        "message": results.message,
        "end_time": results.end_time,
        "results": str(results.path),
        "statistics": results.statistics,
        "notes": results.notes,
    }


def of_spectral(found: Spectral, runs: Seeds | None) -> dict[str, Any]:
    """Standard deviations, powers and dampings; those of runs if there are any."""
    told = {
        "title": found.model.case.scene.title,
        "standard_deviation": found.standard_deviation,
        "rate": found.rate,
        "mean_power": found.power,
        "damping": found.damping,
        "iterations": found.iterations,
        "slow_motion": _of_slow(found.slow),
        "notes": found.notes,
    }
    if runs is not None:
        told["runs"] = {
            "names": runs.names,
            "standard_deviation": runs.motion,
            "rate": runs.rate,
            "mean_power": runs.power,
        }
    return told


def of_sweep(results: xarray.Dataset) -> dict[str, Any]:
    """Dimensions, coordinates and variables as `xarray.Dataset.from_dict` takes them."""
    found = results.to_dict()
    found["attrs"] = {key: found["attrs"][key] for key in ("hydrodae",) if key in found["attrs"]}
    return found


def of_optimum(found: Optimum) -> dict[str, Any]:
    """Best values, and every evaluation."""
    return {
        "values": found.values,
        "keys": found.keys,
        "value": found.value,
        "unit": found.unit,
        "evaluations": found.evaluations,
        "calls": found.calls,
        "message": found.message,
        "dataset": of_sweep(found.dataset),
    }


def of_calibration(found: Calibration) -> dict[str, Any]:
    """Fitted values, intervals, correlation, and differences before and after."""
    return {
        "title": found.before.title,
        "keys": found.keys,
        "parameters": [
            vars(one) | {"low": one.interval[0], "high": one.interval[1]} for one in found.estimates
        ],
        "correlation": found.correlation,
        "records": [
            {
                "record": one.record,
                "channel": one.channel,
                "unit": one.unit,
                "fitted": one.fitted,
                "rms_before": one.before,
                "rms_after": one.after,
                "range": one.span,
            }
            for one in found.residuals
        ],
        "decays": [
            {"record": check.record}
            | {
                name: {
                    "period": one.period,
                    "damping_ratio": one.damping_ratio,
                    "quadratic": one.quadratic,
                }
                for name, one in (
                    ("measured", check.measured),
                    ("before", check.before),
                    ("after", check.after),
                )
            }
            for check in found.checks
        ],
        "warnings": found.warnings,
        "evaluations": found.evaluations,
        "runs": found.runs,
    }


def of_database(database: HydroDatabase, report: CheckReport) -> dict[str, Any]:
    """Bodies, coordinates, fits, tables of second order and findings of a database."""
    return {
        "source": database.source,
        "bodies": list(database.bodies),
        "coordinates": database.coordinates,
        "omega": database.omega,
        "fits": {name: fit.report for name, fit in database.memory.items()},
        "second_order": {
            kind: {
                "coordinates": table.coordinates,
                "method": table.method,
                "omega": table.omega,
                "headings": [table.heading1, table.heading2],
                "computed": float(table.computed.mean()),
                "source": table.source,
            }
            for kind, table in database.second_order.items()
        },
        "findings": [
            {
                "severity": finding.severity,
                "check": finding.name,
                "message": finding.message,
                "value": finding.value,
                "omega": finding.omega,
            }
            for finding in report
        ],
        "ok": report.ok,
    }
