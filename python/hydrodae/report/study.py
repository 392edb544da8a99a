"""The report of a sweep."""

from __future__ import annotations

import hashlib
import os
import platform
from collections.abc import Iterator
from pathlib import Path

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from hydrodae.case.contents import tables_of
from hydrodae.pictures.plot import STYLE
from hydrodae.report import page
from hydrodae.report.scene import parts, rungs
from hydrodae.study.sweep import text
from hydrodae.study.sweep.measures import ENDS
from hydrodae.study.sweep.table import half_percent, with_unit
from hydrodae.support.units import percent_text, prefixed
from hydrodae.support.version import version

#: What is drawn first, if it is there.
_FIRST = ("mean_power_absorbed_mean", "mean_power_absorbed", "capture_width")
#: What models of the motion but the time domain are called in tables.
_LINEAR = {"frequency": "frequency domain", "spectral": "frequency domain, linearised in the sea"}
#: Cost and trust: their ranges are enough.
_TOLD_ONLY = ("estimated_error", "steps")


def report_of_study(path: str | os.PathLike[str], study: xr.Dataset) -> str:
    """Return the page of a sweep: outcome, matrices, failures, study, case, versions, hashes."""
    return page.page(f"Study {Path(path).stem}", filter(None, _sections(Path(path), study)))


def _sections(path: Path, study: xr.Dataset) -> Iterator[str]:
    yield page.section("Outcome", page.text_block(text(study)))
    names = [str(name) for name in study.data_vars if np.issubdtype(study[name].dtype, np.floating)]
    ends = [f"{name}{end}" for name in names for end in ENDS]
    names.sort(key=lambda name: _FIRST.index(name) if name in _FIRST else len(_FIRST))
    for name in names:
        values = study[name]
        if values.ndim == 2 and min(values.shape) > 1 and name not in (*_TOLD_ONLY, *ends):
            drawn = page.picture(matrix(values, name, half_percent(study, name)), name)
            yield page.section(_title(name, values), drawn)
    yield page.section(
        "Ranges",
        page.table(
            ["result", "unit", "least", "mean", "largest"],
            [
                [name, str(study[name].attrs.get("units", "-")), *_range(study[name])]
                for name in names
                if np.isfinite(study[name]).any()
            ],
        ),
    )
    yield page.section("Runs that did not complete", _failures(study))
    yield from about(path, study)


def about(path: Path, study: xr.Dataset, rung: str = "") -> Iterator[str]:
    """Sections of what was run: scene, models, versions and hashes, files.

    `rung` names the model of the motion where the study has one that is not the time domain.
    """
    case, overrides = (str(study.attrs.get(key, "")) for key in ("case", "overrides"))
    tables = tables_of(case, overrides)
    models = dict(rungs(tables))
    if rung in _LINEAR:
        models["motion"] = _LINEAR[rung]
        if "radiation" in models:
            models["radiation"] = "A(w) and B(w) of the database"
    yield page.section("Scene", page.table(["part", "name", "type", "where"], parts(tables)))
    yield page.section("Models used", page.table(["effect", "model"], models.items()))
    yield page.section("Versions and hashes", page.table([], _provenance(path, study)))
    yield page.section(
        "Files",
        page.folded("study", str(study.attrs.get("study", ""))),
        page.folded("case", case),
        page.folded("replaced values", overrides) if overrides else "",
    )


@matplotlib.rc_context(STYLE)
def matrix(values: xr.DataArray, name: str, half: xr.DataArray | None = None) -> Figure:
    """Draw a quantity over two keys as coloured cells with their numbers.

    Below a number stands half the width of its 95 % interval [%], where `half` has it.
    """
    down, across = (str(d) for d in values.dims)
    numbers = values.to_numpy()
    largest = float(np.nanmax(np.abs(numbers), initial=0.0))
    factor, unit = prefixed(largest, values.attrs.get("units", "-"))
    figure = Figure(
        figsize=(
            min(10.0, 2.5 + 0.75 * numbers.shape[1]),
            1.4 + (0.32 if half is None else 0.48) * numbers.shape[0],
        ),
        layout="constrained",
    )
    axes = figure.subplots()
    image = axes.imshow(numbers * factor, cmap="viridis", aspect="auto", origin="lower")
    axes.grid(visible=False)
    if half is not None and np.isfinite(half.to_numpy()).any():
        axes.set_title("\u00b1 half of the 95 % interval", loc="right", fontsize=8)
    middle = 0.4 * np.nanmin(numbers * factor) + 0.6 * np.nanmax(numbers * factor)
    percent = np.full(numbers.shape, np.nan) if half is None else half.to_numpy()
    for (i, j), value in np.ndenumerate(numbers * factor):
        near = f"\n\u00b1{percent_text(float(percent[i, j]))}" if np.isfinite(percent[i, j]) else ""
        color = "black" if value > middle else "white"
        axes.text(j, i, f"{value:.3g}{near}", ha="center", va="center", fontsize=8, color=color)
    axes.set_xticks(range(numbers.shape[1]), [_short(v) for v in values[across].to_numpy()])
    axes.set_yticks(range(numbers.shape[0]), [_short(v) for v in values[down].to_numpy()])
    axes.set_xlabel(with_unit(values, across).replace("_", " "))
    axes.set_ylabel(with_unit(values, down).replace("_", " "))
    figure.colorbar(image, label=f"{name.replace('_', ' ')} [{unit}]")
    return figure


def _short(value: object) -> str:
    return f"{value:g}" if isinstance(value, float | np.floating) else str(value)


def _title(name: str, values: xr.DataArray) -> str:
    return f"{name.replace('_', ' ')} [{values.attrs.get('units', '-')}]"


def _range(values: xr.DataArray) -> tuple[float, float, float]:
    found = values.to_numpy()
    return float(np.nanmin(found)), float(np.nanmean(found)), float(np.nanmax(found))


def _failures(study: xr.Dataset) -> str:
    flat = study[["status", "reason"]].stack(run=list(study["status"].dims), create_index=False)
    rows = []
    for k in range(flat.sizes["run"]):
        one = flat.isel(run=k)
        if str(one["status"].item()) != "completed":
            place = ", ".join(
                f"{d} {_short(one[d].item())}" for d in study["status"].dims if d in one
            )
            rows.append([place, str(one["status"].item()), str(one["reason"].item())])
    return page.table(["point", "status", "reason"], rows)


def _provenance(path: Path, study: xr.Dataset) -> Iterator[tuple[str, str]]:
    yield "results file", str(path)
    yield "its sha256", hashlib.sha256(path.read_bytes()).hexdigest()
    yield "made by hydrodae", str(study.attrs.get("hydrodae", ""))
    case = str(study.attrs.get("case", ""))
    yield "sha256 of the case", hashlib.sha256(case.encode()).hexdigest()
    yield "report by", f"hydrodae {version()}, Python {platform.python_version()}"
