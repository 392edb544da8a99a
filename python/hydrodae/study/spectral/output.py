"""Files of what `hydrodae.spectral` found."""

from __future__ import annotations

import csv
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from hydrodae.study.rao.output import CONVENTION, write_either
from hydrodae.study.slow import SlowMotion
from hydrodae.support import outputs
from hydrodae.support.arrays import Array, Complex

if TYPE_CHECKING:
    import xarray


class Found(Protocol):
    """What a file has of `Spectral`."""

    waves: Array
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: Complex
    standard_deviation: dict[str, float]
    rate: dict[str, float]
    power: dict[str, float]
    iterations: int
    slow: SlowMotion | None


def write(path: str | os.PathLike[str], found: Any) -> Path:
    """Write .csv (components and channels), .nc or .h5 (netCDF: deviations and powers as well).

    Raises
    ------
    CaseError
        Another ending, or a file of another kind is there.
    """
    return write_either(path, lambda file: _write_csv(file, found), lambda: dataset(found))


def dataset(found: Any) -> xarray.Dataset:
    """Phasors over the components of the sea, deviations over channels, powers over forces."""
    import xarray

    omega, heading, amplitude, phase = found.waves.T
    names, forces = list(found.names), list(found.power)
    data = xarray.Dataset(
        {
            "wave_amplitude": ("component", amplitude, {"unit": "m"}),
            "wave_phase": ("component", phase, {"unit": "rad"}),
            "amplitude": (("component", "response"), np.abs(found.values)),
            "phase": (("component", "response"), np.angle(found.values), {"unit": "rad"}),
            "standard_deviation": ("response", [found.standard_deviation[n] for n in names]),
            "rate_standard_deviation": ("response", [found.rate.get(n, np.nan) for n in names]),
            "mean_power": ("force", [found.power[n] for n in forces], {"unit": "W"}),
        },
        {
            "omega": ("component", omega, {"unit": "rad/s"}),
            "heading": ("component", heading, {"unit": "rad"}),
            "response": names,
            "unit": ("response", [unit.removesuffix("/m") for unit in found.units]),
            "force": forces,
        },
        {"iterations": found.iterations, "convention": CONVENTION},
    )
    if found.slow is None:
        return data
    slow = found.slow
    return data.assign_coords(
        difference=("difference", slow.omega, {"unit": "rad/s"}), loaded=list(slow.labels)
    ).assign(
        mean_offset=("response", [slow.offset.get(n, np.nan) for n in names]),
        slow_standard_deviation=(
            "response",
            [slow.standard_deviation.get(n, np.nan) for n in names],
        ),
        slow_load_mean=("loaded", slow.mean),
        slow_load_standard_deviation=("loaded", slow.load_deviation),
        slow_load_spectrum=(("difference", "loaded"), slow.spectrum),
    )


def _write_csv(path: Path, found: Found) -> None:
    with outputs.whole(path) as beside, beside.open("w", newline="") as file:
        rows = csv.writer(file)
        head = ["omega [rad/s]", "heading [rad]", "wave amplitude [m]", "wave phase [rad]"]
        for name, unit in zip(found.names, found.units, strict=True):
            head += [f"{name} amplitude [{unit}]", f"{name} phase [rad]"]
        rows.writerow(head)
        for wave, values in zip(found.waves, found.values, strict=True):
            pairs = np.stack([np.abs(values), np.angle(values)], axis=1).ravel()
            rows.writerow([f"{x:.9g}" for x in [*wave, *pairs]])
