"""Files of all responses, and their picture."""

from __future__ import annotations

import csv
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.linear import Response
from hydrodae.study.rao.text import NOTHING, coordinates, name_of_power, short_name
from hydrodae.support import outputs
from hydrodae.support.arrays import Array
from hydrodae.support.units import displayed

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure


#: Endings of the files that `write` knows.
CSV, NETCDF = (".csv",), (".nc", ".h5", ".hdf5")
CONVENTION = (
    "x(t) = Re(X e^{+i omega t}) per metre of wave amplitude; the phase of the wave is zero at the "
    "origin"
)
#: What the picture shows, s: longer waves carry little.
LONGEST_PERIOD = 25.0


#: Values (nw,) beside a response, by name, each with its unit.
Beside = Mapping[str, tuple[str, Array]]


def write(path: str | os.PathLike[str], response: Response, beside: Beside | None = None) -> Path:
    """Write all responses; the ending says how: .csv, or .nc and .h5 (netCDF, which is HDF5).

    Parameters
    ----------
    path : path
    response : Response
    beside : mapping
        Values over the same frequencies and their units, by name.

    Raises
    ------
    CaseError
        Another ending, or a file of another kind is there.
    """
    return write_either(
        path,
        lambda file: _write_csv(file, response, beside or {}),
        lambda: dataset(response, beside),
    )


def write_either(
    path: str | os.PathLike[str],
    write_csv: Callable[[Path], None],
    data: Callable[[], xarray.Dataset],
) -> Path:
    """Write CSV or netCDF, as the ending says, and return the path; errors as `check_output`."""
    path = check_output(path)
    if path.suffix.lower() in CSV:
        write_csv(path)
    else:
        data().to_netcdf(path, engine="netcdf4", invalid_netcdf=False)
    return path


def check_output(path: str | os.PathLike[str]) -> Path:
    """Return the path of a file that may be written.

    Raises
    ------
    CaseError
        Its ending says no kind of file, or a file of another kind is there.
    """
    path = Path(path)
    if path.suffix.lower() not in (*CSV, *NETCDF):
        raise CaseError(
            f"{path}: the ending says the kind of file, {', '.join((*CSV, *NETCDF))}, "
            f"not {path.suffix!r}"
        )
    return outputs.claim(path, outputs.CSV if path.suffix.lower() in CSV else outputs.NETCDF)


def dataset(response: Response, beside: Beside | None = None) -> xarray.Dataset:
    """All responses over the frequency: amplitude, phase, the mean powers, and what is beside.

    Returns
    -------
    xarray.Dataset
        `amplitude` (per metre of wave amplitude) and `phase` [rad] over `omega` [rad/s] and
        `response` (the channel names), the coordinate `unit` beside it; `mean_power` [W/m2] over
        `omega` and `force`; `period` [s].
    """
    import xarray

    forces = list(response.power)
    power = np.stack([response.power[name] for name in forces], axis=1) if forces else None
    variables = {
        "amplitude": (("omega", "response"), np.abs(response.values)),
        "phase": (("omega", "response"), np.angle(response.values), {"unit": "rad"}),
        "excitation_power": ("omega", response.excitation_power, {"unit": "W/m2"}),
        "radiated_power": ("omega", response.radiated_power, {"unit": "W/m2"}),
    }
    for name, (unit, values) in (beside or {}).items():
        variables[name.replace(" ", "_")] = ("omega", values, {"unit": unit})
    coords = {
        "omega": ("omega", response.omega, {"unit": "rad/s"}),
        "period": ("omega", 2 * np.pi / response.omega, {"unit": "s"}),
        "response": list(response.names),
        "unit": ("response", list(response.units)),
    }
    if power is not None:
        variables["mean_power"] = (("omega", "force"), power, {"unit": "W/m2"})
        coords["force"] = forces
    return xarray.Dataset(
        variables,
        coords,
        {"heading_deg": float(np.degrees(response.heading)), "convention": CONVENTION},
    )


def _write_csv(path: Path, response: Response, beside: Beside) -> None:
    with outputs.whole(path) as partial, partial.open("w", newline="") as file:
        rows = csv.writer(file)
        head = ["omega [rad/s]", "period [s]"]
        for name, unit in zip(response.names, response.units, strict=True):
            head += [f"{name} amplitude [{unit}]", f"{name} phase [rad]"]
        head += [f"{name} mean power [W/m2]" for name in response.power]
        rows.writerow(head + [f"{name} [{unit}]" for name, (unit, _) in beside.items()])
        for k, w in enumerate(response.omega):
            row = [w, 2.0 * np.pi / w]
            for value in response.values[k]:
                row += [abs(value), float(np.angle(value))]
            row += [p[k] for p in response.power.values()]
            rows.writerow([f"{x:.9g}" for x in row + [v[k] for _, v in beside.values()]])


def draw(response: Response, title: str, names: Sequence[str] | None = None) -> Figure:
    """Draw amplitudes over the period, one panel for each unit, and the power of the dampers.

    Parameters
    ----------
    response : Response
    title : str
    names : sequence of str, optional
        Responses to show; by default all bodies and joints that move.
    """
    import matplotlib
    from matplotlib.figure import Figure

    from hydrodae.pictures.plot import STYLE, outside_legend

    panels: dict[str, list[tuple[str, Array]]] = {}
    units = dict(zip(response.names, response.units, strict=True))
    for name in names if names is not None else coordinates(response):
        factor, unit = displayed(units[name])
        panels.setdefault(unit, []).append((short_name(name), factor * np.abs(response[name])))
    for name, power in response.power.items():
        panels.setdefault("kW/m2", []).append((f"{name_of_power(name)} mean power", 1e-3 * power))
    for unit, lines in panels.items():
        least = NOTHING * max(float(np.abs(values).max()) for _, values in lines)
        panels[unit] = [line for line in lines if np.abs(line[1]).max() > least]
    panels = {unit: lines for unit, lines in panels.items() if lines}
    if not panels:
        raise CaseError("nothing moves: there is nothing to draw")
    period = 2 * np.pi / response.omega
    shown = period <= max(LONGEST_PERIOD, 1.2 * period.min())
    with matplotlib.rc_context(STYLE):
        figure = Figure(figsize=(8.0, 2.5 * len(panels) + 0.6), layout="constrained")
        all_axes = list(figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0])
        for axes, (unit, lines) in zip(all_axes, panels.items(), strict=True):
            for label, values in lines:
                axes.plot(period[shown], values[shown], label=label)
            kind = "mean power" if unit == "kW/m2" else "amplitude"
            axes.set_ylabel(f"{kind} [{unit}]")
            axes.set_ylim(bottom=0.0)
            outside_legend(axes)
        all_axes[0].set_title(f"{title}: response per metre of wave amplitude")
        all_axes[-1].set_xlabel("wave period [s]")
        all_axes[-1].set_xlim(period[shown].min(), period[shown].max())
    return figure
