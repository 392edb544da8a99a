"""The results of a study as one dataset."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.tables import unit_of
from hydrodae.errors import CaseError
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.means import add_means, control_columns, uncontrolled
from hydrodae.study.sweep.measures import ENDS
from hydrodae.study.sweep.plan import Study, point_key
from hydrodae.support import outputs

if TYPE_CHECKING:
    import xarray as xr

#: Of netCDF files.
ENDINGS = (".nc", ".nc4", ".netcdf", ".cdf")


def dataset(study: Study, rows: Mapping[str, Row], attributes: Mapping[str, Any]) -> xr.Dataset:
    """Every number of every run: along the keys of a grid, else along `point`.

    Runs that did not complete have NaN, their `status` and `reason`; a run that an interval did not
    need has the status "not needed". With repetitions (`over`) `NAME_mean` and `NAME_interval`,
    half the width of the 95 % confidence interval of the mean (Student's t), stand beside the
    values. `NAME_low` and `NAME_high` are the ends of the sampling
    interval of one run (`hydrodae.results.sampling`).
    """
    import xarray as xr  # which the processes that run the points do without

    shape, coordinates = _axes(study)
    dimensions = tuple(coordinates) if study.dimensions else ("point",)
    not_run: Row = {"status": "not needed", "reason": ""}
    ordered = [rows.get(point_key(point), not_run) for point in study.points]
    units: dict[str, str] = {}
    for row in ordered:
        units |= row.get("units", {})
    variables: dict[str, Any] = {
        name: (
            dimensions,
            np.array([row.get("values", {}).get(name, np.nan) for row in ordered]).reshape(shape),
            {"units": unit},
        )
        for name, unit in units.items()
    }
    for name, column in control_columns(ordered, shape).items():
        variables[name] = (dimensions, column, {"units": "W"})
    if missing := uncontrolled(ordered):
        attributes = {**attributes, "uncontrolled": missing}
    if study.repetitions.interval:
        attributes = {**attributes, "interval_asked": study.repetitions.interval}
    alone = Counter(row["alone"].splitlines()[0] for row in ordered if "alone" in row)
    if alone:
        lines = [f"{n} {reason}" for reason, n in alone.most_common()]
        attributes = {**attributes, "run_alone": "\n".join(lines)}
    for name in ("status", "reason"):
        text = np.array([row[name] for row in ordered], dtype=str).reshape(shape)
        variables[name] = (dimensions, text)
    if not study.dimensions:
        for key in study.points[0]:
            values = [point[key] for point in study.points]
            variables[study.column(key)] = ("point", _column(values), _attributes(key))
    out = xr.Dataset(variables, coordinates, dict(attributes))
    add_means(out, study)
    _add_energy(out, study)
    return out


def texts_of(case: Case) -> dict[str, str]:
    """Attributes that keep a case: its text, and a line ``key = value`` for each value replaced."""
    lines = "\n".join(f"{key} = {value}" for key, value in case.overrides.items())
    return {"case": case.text, "overrides": lines}


def _axes(study: Study) -> tuple[tuple[int, ...], dict[str, Any]]:
    if not study.dimensions:
        return (len(study.points),), {}
    names = {key: study.column(key) for key in study.dimensions}
    return tuple(map(len, study.dimensions.values())), {
        names[key]: (names[key], _column(values), _attributes(key))
        for key, values in study.dimensions.items()
    }


def _attributes(key: str) -> dict[str, str]:
    """Of a column of a key: the key, and its unit where it has one."""
    unit = unit_of(key)
    return {"key": key} | ({"units": unit} if unit not in ("", "-") else {})


def with_unit(values: xr.DataArray | xr.Dataset, dimension: str) -> str:
    """Name of a dimension or column, its unit in brackets where it has one."""
    unit = values[dimension].attrs.get("units", "")
    return f"{dimension} [{unit}]" if unit else dimension


def _column(values: list[Any]) -> Any:
    array = np.array(values)
    return array if array.dtype.kind in "biufU" and array.ndim == 1 else [str(v) for v in values]


def _add_energy(out: xr.Dataset, study: Study) -> None:
    """Annual energy [J] = sum over sea states of mean power times hours (scatter table).

    The ends of its interval are the same sums of those of the powers: it holds at least 95 % of
    all seas, also where sea states share a seed and err to the same side.
    """
    if study.scatter is None:
        return
    import xarray as xr

    s = study.scatter
    name = "mean_power_absorbed" + "_mean" * bool(study.over)
    if name not in out:
        raise CaseError(f"{study.path}: [scatter]: no run completed with a power take-off")
    axes = [study.column(key) for key in (s.height_key, s.period_key)]
    ends = interval_of(out, name)
    powers = {"": out[name]} | (dict(zip(ENDS, ends, strict=True)) if ends else {})
    for end, power in powers.items():
        energy = xr.DataArray(0.0)
        for height, period, hours in zip(s.height, s.period, s.hours, strict=True):
            place = [np.isclose(out[a], x) for a, x in zip(axes, (height, period), strict=True)]
            at = {a: int(np.argmax(p)) for a, p in zip(axes, place, strict=True)}
            energy = energy + power.isel(at) * hours * 3600.0
        out[f"annual_energy{end}"] = energy.drop_vars([a for a in axes if a in energy.coords])
        out[f"annual_energy{end}"].attrs = {"units": "J"}
    out["hours"] = ((), sum(s.hours), {"units": "h", "long_name": "hours a year in the table"})


def claim(path: str | os.PathLike[str]) -> Path:
    """Return the path of a table of a study, which may be written.

    Raises
    ------
    CaseError
        Its name does not end as one of netCDF, or a file of another kind is there.
    """
    if Path(path).suffix.lower() not in ENDINGS:
        raise CaseError(f"{path}: the table is a netCDF file: expected a name that ends in .nc")
    return outputs.claim(path, outputs.NETCDF)


def write(path: str | os.PathLike[str], results: xr.Dataset) -> Path:
    """Write the dataset as netCDF (a whole file or none)."""
    with outputs.whole(Path(path)) as beside:
        try:
            results.to_netcdf(beside, engine="netcdf4")
        except RuntimeError as error:  # of the library, as on a full disk
            raise OSError(str(error)) from None
    return Path(path)


def interval_of(results: xr.Dataset, name: str) -> tuple[xr.DataArray, xr.DataArray] | None:
    """Ends of the 95 % interval of a result: of NAME_mean over its seeds, else of each run alone.

    None where it has none: a regular wave, a linear model, a number that is no statistic.
    """
    width = name.removesuffix("_mean") + "_interval"
    if name.endswith("_mean") and width in results.data_vars:
        return results[name] - results[width], results[name] + results[width]
    ends = [f"{name}{end}" for end in ENDS]
    return (results[ends[0]], results[ends[1]]) if ends[0] in results.data_vars else None


def half_percent(results: xr.Dataset, name: str) -> xr.DataArray | None:
    """Half the width of `interval_of` in percent of the value [%]; nan where there is none."""
    ends = interval_of(results, name)
    return None if ends is None else 50.0 * (ends[1] - ends[0]) / abs(results[name])
