"""Fits of the radiation memory: time, states, memory and error of H, one table after the other.

    python tests/benchmark/memory_fits.py [NAME ...]

Tables of the reference data ($HYDRODAE_REFERENCE) and arrays of point absorbers. Each fit runs in
a process of its own with one BLAS thread; time is that of the processor.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
NAMES = """
    sphere sphere_nemoh f3of_flaps cubes_heave oswec_flap rm3_heave rm3_planar rm3_planar_40
    4n3la star ring hexagon
""".split()


def problem(name: str) -> tuple[Any, list[str], dict[str, Any]]:
    """Return the table, the coordinates that move, and the options of the fit."""
    import numpy as np
    from tests import reference_data
    from tests.verification.point_absorbers import array_table, hexagon, star

    from hydrodae import hdb

    planar = ("surge", "heave", "pitch")
    if name == "sphere":
        options: dict[str, Any] = {"band": (0.3, 3.0), "target": 1e-4}
        return hdb.read(ROOT / "cases" / "sphere" / "hydro.h5"), ["sphere.heave"], options
    if name == "f3of_flaps":
        labels = [f"flap{i}.{dof}" for i in (1, 2) for dof in planar]
        return hdb.read(ROOT / "cases" / "f3of" / "hydro.h5"), labels, {}
    if name in ("star", "ring", "hexagon"):
        layout = {"star": star(), "ring": hexagon()[:6], "hexagon": hexagon()}[name]
        table: Any = array_table(layout, np.arange(0.1, 8.01, 0.1))
        return table, list(table.coordinates), {"band": (1.0, 6.0), "uniform": 0.01}
    if name == "4n3la":
        table = hdb.read(reference_data.required("hdb", "own", "4n3la.nc"))
        return table, list(table.coordinates), {"band": (1.0, 8.0), "uniform": 0.01}
    if name.startswith("rm3"):
        table = hdb.read(reference_data.required("hdb", "rm3_wamit"), rho=1000.0)
        moving = ("heave",) if name == "rm3_heave" else planar
        options = {"band": (0.1, 1.6)}
        if name != "rm3_planar":
            options["max_states"] = 16 if name == "rm3_heave" else 40
        return table, [f"{body}.{dof}" for body in ("float", "spar") for dof in moving], options
    source, dof = {
        "sphere_nemoh": ("sphere_nemoh_v3.0.2", ""),
        "cubes_heave": ("cubes_nemoh_v3.0.2", "heave"),
        "oswec_flap": ("oswec_nemoh_v3.0.2", "pitch"),
    }[name]
    table = hdb.read(reference_data.required("hdb", source))
    labels = [label for label in table.coordinates if label.endswith(dof)]
    return table, labels[:1] if name == "oswec_flap" else labels, {}


def measure(name: str) -> None:
    """Fit one table and print its line."""
    import resource
    import time
    import warnings

    import numpy as np

    from hydrodae.hdb.memory import fit_memory

    table, labels, options = problem(name)
    warnings.simplefilter("ignore")
    start = time.process_time()
    fit = fit_memory(table, labels, **options)
    spent = time.process_time() - start
    fastest = float(np.abs(fit.poles).max() / table.omega[-1])
    report, peak = fit.report, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e6
    print(
        f"{name:14s} {len(labels):4d} {spent:8.1f} {fit.n_states:7d} {report['passive']!s:>8} "
        f"{report['h_error_band']:9.1e} {report['h_error_peak']:9.1e} "
        f"{report['target_met']!s:>6} {peak:7.2f} {fastest:7.2f}",
        flush=True,
    )


def main() -> int:
    """Measure the tables that are named, or all; exit code 2 if data of one is missing."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(NAMES)}")
    parser.add_argument("--one", choices=NAMES, help=argparse.SUPPRESS)  # in this process
    options = parser.parse_args()
    if unknown := sorted(set(options.names) - set(NAMES)):
        parser.error(f"no table {', '.join(unknown)}: {', '.join(NAMES)}")
    if options.one:
        measure(options.one)
        return 0
    print(
        f"{'table':14s} {'n':>4s} {'CPU s':>8s} {'states':>7s} {'passive':>8s} {'rms band':>9s} "
        f"{'peak':>9s} {'target':>6s} {'GB':>7s} {'fastest':>7s}",
        flush=True,
    )
    path = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": path}
    code = 0
    for name in options.names or NAMES:
        command = [sys.executable, __file__, "--one", name]
        code = max(code, subprocess.run(command, env=environment, check=False).returncode)
    return code


if __name__ == "__main__":
    sys.exit(main())
