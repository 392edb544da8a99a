"""What the README of a device states: gaps, energy, tolerances, and responses by two ways."""

from __future__ import annotations

from pathlib import Path
from time import process_time

import numpy as np
import parts
import study

from hydrodae import Results, Scene, run

PERIODS = (1.3, 1.5, 2.2, 3.2, 4.0)  # s, off the light resonances at 1.7 and 2.7 s


def errors(results: Results, layout: parts.Layout) -> str:
    """Gap and energy balance of a run."""
    balance = results["energy/balance_error"].values
    kinetic = results["energy/kinetic"].values + results["energy/kinetic_added_mass"].values
    share = np.abs(balance).max() / kinetic.max()
    return f"gap {study.gap(results, layout):.1e} m, energy balance {share:.1e} of the kinetic"


def responses(scene: Scene, layout: parts.Layout, periods: tuple[float, ...]) -> None:
    """Print take-off responses in waves of 1 mm by both ways, of runs and of the linear model."""
    found = study.linear(scene, 2.0 * np.pi / np.array(periods))
    print("period, s; largest response, rad/m; largest difference of all take-offs over it")
    light = study.light_modes(scene)
    for i, period in enumerate(periods):
        results = study.regular_wave_run(scene, period, 1e-3, 40.0)
        start = 8.0 * period + 5.0
        worst, largest = 0.0, 0.0
        for arm, node in study.take_offs(layout):
            known = study.turns(found, layout, arm, node)[i, 1:]
            seen = study.harmonic(
                results, f"forces/pto_{arm}_{node}/rotation", period, start, light
            )[1:]
            worst = max(worst, float(np.abs(seen - known).max()))
            largest = max(largest, float(np.abs(known).max()))
        print(f"{period:g}  {largest:.3f}  {worst / largest:.1e}", flush=True)


def tolerances(scene: Scene, layout: parts.Layout) -> None:
    """Print how far a run at rtol 1e-4 is from one at 1e-7, 60 s of the irregular sea."""
    coarse, fine = (
        run(scene, set={"solver.end_time": 60.0, "solver.rtol": rtol}) for rtol in (1e-4, 1e-7)
    )
    worst = 0.0
    for arm, node in study.take_offs(layout):
        turns = [r[f"forces/pto_{arm}_{node}/rotation"].values[:, 1:] for r in (coarse, fine)]
        worst = max(worst, float(np.abs(turns[0] - turns[1]).max() / np.abs(turns[1]).max()))
    power = [study.power(r, layout).mean() for r in (coarse, fine)]
    print(f"rtol 1e-4 against 1e-7: turns {worst:.1e}, mean power {power[0] / power[1] - 1.0:.1e}")
    print("rtol 1e-4:", errors(coarse, layout))


def show(layout: parts.Layout, directory: Path) -> None:
    """Print the figures of a device."""
    start = process_time()
    results = run(directory / "regular.toml")
    print(f"regular: {errors(results, layout)}, {process_time() - start:.1f} s of one core")
    responses(parts.regular(parts.device(layout, directory)), layout, PERIODS)
    tolerances(parts.irregular(parts.device(layout, directory)), layout)
