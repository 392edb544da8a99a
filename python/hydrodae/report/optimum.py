"""The report of an optimisation."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from hydrodae.pictures.plot import STYLE
from hydrodae.report import page
from hydrodae.report.study import about

#: A parameter within this part of the width of its bounds from one of them counts as being there.
_AT_BOUND = 1e-6


def report_of_optimum(path: str | os.PathLike[str], found: xr.Dataset) -> str:
    """Return the page of an optimisation: best values, the search, case, versions, hashes."""
    title = f"Optimisation {Path(path).stem}"
    return page.page(title, filter(None, _sections(Path(path), found)))


def _sections(path: Path, found: xr.Dataset) -> Iterator[str]:
    values, best = found[found.attrs["quantity"]], int(found["best"])
    unit = str(values.attrs.get("units", "-"))
    rows: list[tuple[str, object]] = [
        ("asked", f"{found.attrs['goal']} {values.name}"),
        (f"at the start [{unit}]", float(values[0])),
        (f"best [{unit}]", float(values[best])),
        ("evaluations", int(values.size)),
        ("linearisations or runs", int(found["calls"].sum())),
        ("model of the motion", str(found.attrs["rung"])),
        ("search", f"{found.attrs['method']}: {found.attrs['message']}"),
    ]
    yield page.section("Outcome", page.table([], rows))
    names = [str(name) for name in found.data_vars if "least" in found[name].attrs]
    yield page.section(
        "Best values",
        page.table(
            ["parameter", "keys of the case", "least", "start", "best", "most", "", "slope"],
            [_row(found, name, best) for name in names],
        ),
        page.paragraph(f"Units are those of the keys; slope: that of {values.name} at the best."),
    )
    yield page.section("The search", page.picture(search(found, names), "the search"))
    yield from about(path, found, rung=str(found.attrs["rung"]))


def _row(found: xr.Dataset, name: str, best: int) -> list[object]:
    values = found[name]
    low, high = (float(values.attrs[bound]) for bound in ("least", "most"))
    at, near = float(values[best]), _AT_BOUND * (high - low)
    where = "at a bound" * (at - low < near or high - at < near)
    slope = float(found[f"gradient_{name}"][best])
    return [name, str(values.attrs["key"]), low, float(values[0]), at, high, where, slope]


@matplotlib.rc_context(STYLE)
def search(found: xr.Dataset, names: list[str]) -> Figure:
    """Draw the quantity and the parameters over the evaluations; the best one is marked."""
    shown, best = [str(found.attrs["quantity"]), *names], int(found["best"])
    figure = Figure(figsize=(7.0, 1.0 + 1.5 * len(shown)), layout="constrained")
    columns = figure.subplots(len(shown), sharex=True, squeeze=False)[:, 0]
    for axes, name in zip(columns, shown, strict=True):
        values = found[name].to_numpy()
        axes.plot(np.arange(1, len(values) + 1), values, "o-", markersize=3)
        axes.plot(best + 1, values[best], "s", color="black", markerfacecolor="none")
        axes.set_title(f"{name.replace('_', ' ')} [{found[name].attrs.get('units', 'SI')}]")
    columns[-1].set_xlabel("evaluation")
    columns[-1].xaxis.get_major_locator().set_params(integer=True)
    return figure
