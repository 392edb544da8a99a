"""Reports: a run, a sweep or an optimisation on one HTML page that needs no other file."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from hydrodae.results import Results, ResultsError
from hydrodae.support import outputs
from hydrodae.support.damaged import apart

if TYPE_CHECKING:
    import xarray

__all__ = ["report"]


def report(source: str | os.PathLike[str], output: str | os.PathLike[str] | None = None) -> Path:
    """Write a report: what was run, with which models, what came out, and how far to trust it.

    Parameters
    ----------
    source : path
        Results file of a run (HDF5), or of a sweep or an optimisation (netCDF).
    output : path, optional
        Ends in .html; default: that of `source` with _report.html in place of its ending.

    Returns
    -------
    Path
        The HTML file. It holds its figures and needs no other file and no network.

    Raises
    ------
    ResultsError
        `source` is none of these, or `output` is not named as a page.
    """
    path = Path(source)
    target = Path(output) if output is not None else path.with_name(f"{path.stem}_report.html")
    if target.suffix != ".html":
        raise ResultsError(f"{target}: a report needs a name that ends in .html")
    outputs.claim(target, outputs.PAGE)
    text = _page(path)
    outputs.write_text(target, text)
    return target


def _refused(path: Path, fault: str) -> ResultsError:
    return ResultsError(f"{path}: {fault}")


def _load(path: Path) -> xarray.Dataset:
    import xarray

    return xarray.load_dataset(path, engine="netcdf4", lock=False)


def _page(path: Path) -> str:
    from hydrodae.report.optimum import report_of_optimum
    from hydrodae.report.run import report_of_run
    from hydrodae.report.study import report_of_study

    if path.suffix == ".nc":
        study = apart(path, _refused, "not a readable netCDF file", lambda: _load(path))
        if "study" in study.attrs and "best" in study and "goal" in study.attrs:
            return report_of_optimum(path, study)
        if "status" not in study or "study" not in study.attrs:
            raise ResultsError(f"{path}: is not the results file of a sweep or an optimisation")
        return report_of_study(path, study)
    return report_of_run(Results.read(path))
