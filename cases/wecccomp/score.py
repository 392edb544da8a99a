"""The score of the competition: sea states, controllers, evaluation criterion.

    python cases/wecccomp/score.py                          # the table, as Markdown
    python cases/wecccomp/score.py --seas 2 --controllers passive predictive
    python cases/wecccomp/score.py --search --controllers latching    # the best SETTINGS

    EC = mean(P) / (2 + |f|_98 / 60 N + |s|_98 / 0.08 m - mean|P| / |P|_98)

over what follows 25 s: f the load of the power take-off, s its stroke, P = 0.7 Pa where it takes
the power Pa, Pa / 0.7 where it gives it, _98 the value that is exceeded for 2 % of the time. A
latch is the power take-off holding with up to its limit, 60 N; it counts in f.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import minimize

import hydrodae
from hydrodae.commands.cli import guarded
from hydrodae.control import AutoregressiveForecast, KnownSea, ModelPredictive, Plant

HERE = Path(__file__).parent
FORCE, STROKE, EFFICIENCY = 60.0, 0.08, 0.7  # N, m, -
#: Significant height [m], peak period [s], gamma.
SEAS = (
    (0.0208, 0.988, 1.0),
    (0.0625, 1.412, 1.0),
    (0.1042, 1.836, 1.0),
    (0.0208, 0.988, 3.3),
    (0.0625, 1.412, 3.3),
    (0.1042, 1.836, 3.3),
)
RATE = "displacement_rate"
PERIOD = 0.04  # of the model-predictive controller [s]
HORIZON = 40  # samples
MODELS = ("predictive", "autoregressive")  # waves known ahead, or foretold
ORDER, WINDOW = 48, 1500  # samples that the waves are foretold from, and that it learns from

#: What each controller has in each sea: damping [N s/m]; damping and stiffness [N/m]; damping and
#: weight [m/(N s)] of the model-predictive one; damping and hold time [s] of latching.
SETTINGS: dict[str, tuple[tuple[float, ...], ...]] = {
    "passive": ((150.0,), (200.0,), (300.0,), (150.0,), (200.0,), (300.0,)),
    "pi": 2 * ((147.0, -415.0), (210.0, -930.0), (297.0, -1170.0)),
    "latching": (
        (150.0, 0.0135),
        (207.1, 0.1125),
        (269.9, 0.2222),
        (137.4, 0.0369),
        (210.3, 0.171),
        (304.0, 0.2566),
    ),
    "predictive": 2 * ((0.0, 1e-3), (200.0, 3e-3), (300.0, 1.5e-3)),
}
SETTINGS["autoregressive"] = SETTINGS["predictive"]

PREDICTIVE = f"""
[[controller]]
type = "python"
name = "predictive"
inputs = ["joints/slide/displacement", "joints/slide/displacement_rate"]
outputs = ["forces/pto/load"]
period = {PERIOD}
"""
LATCH = f"""
[[force]]
type = "dry_friction"
name = "latch"
joint = "slide"
static = {FORCE}
kinetic = 0.0

[[controller]]
type = "latching"
name = "latching"
inputs = ["joints/slide/displacement_rate"]
outputs = ["forces/latch/static"]
hold_load = {FORCE}
hold_time = 0.1
period = 0.1
"""


@dataclass(frozen=True)
class Score:
    """What a run earns, and with what."""

    ec: float  #: evaluation criterion [W]
    power: float  #: mean(P) [W]
    force: float  #: |f|_98 [N]
    stroke: float  #: |s|_98 [m]
    most_force: float  #: [N]
    most_stroke: float  #: [m]
    seconds: float = 0.0  #: CPU time of the run


def evaluate(t: np.ndarray, f: np.ndarray, s: np.ndarray, rate: np.ndarray) -> Score:
    """Score time series at equal steps."""
    kept = t > 25.0
    f, s, rate = f[kept], s[kept], rate[kept]
    absorbed = -f * rate
    power = np.where(absorbed > 0.0, EFFICIENCY * absorbed, absorbed / EFFICIENCY)
    force, stroke, high = (float(np.percentile(np.abs(x), 98)) for x in (f, s, power))
    fee = 2.0 + force / FORCE + stroke / STROKE - float(np.abs(power).mean()) / high
    most = float(np.abs(f).max()), float(np.abs(s).max())
    return Score(float(power.mean()) / fee, float(power.mean()), force, stroke, *most)


def case_of(sea: int, controller: str, settings: tuple[float, ...], database: str) -> hydrodae.Case:
    """The case in sea 1 ... 6 with what its controller needs."""
    height, peak, gamma = SEAS[sea - 1]
    text = (HERE / "case.toml").read_text().replace("hydro.h5", database)
    text += {"latching": LATCH, **dict.fromkeys(MODELS, PREDICTIVE)}.get(controller, "")
    values: dict[str, Any] = {
        "wave.sea.significant_height": height,
        "wave.sea.peak_period": peak,
        "wave.sea.gamma": gamma,
        "sea.ramp": 5.0 * peak,
        "solver.end_time": 100.0 * peak,
    }
    if controller not in MODELS:
        values["force.pto.damping"] = settings[0]
    if controller == "pi":
        values["force.pto.stiffness"] = settings[1]
    if controller == "latching":
        values["controller.latching.hold_time"] = settings[1]
        # some mm off the equilibrium, so that it swings, not creeps, when it is first let go
        values["solver.start"] = "given"
    return hydrodae.Case.from_text(text, HERE).with_values(values)


def law_of(
    sea: int, controller: str, settings: tuple[float, ...], database: str
) -> dict[str, Callable[..., float]]:
    """The Python controller of a case, if it has one."""
    if controller not in MODELS:
        return {}
    plant = Plant(case_of(sea, "passive", (0.0,), database), "slide")
    known = controller == "predictive"
    peak = SEAS[sea - 1][1]
    law = ModelPredictive(
        plant,
        KnownSea(plant, PERIOD, 5.0 * peak) if known else AutoregressiveForecast(ORDER, WINDOW),
        period=PERIOD,
        horizon=HORIZON,
        damping=settings[0],
        weight=settings[1],
        load_limit=FORCE,
        stroke=(-STROKE, STROKE),
    )
    return {"predictive": law}


def run(
    sea: int, controller: str, settings: tuple[float, ...] | None = None, database: str = "hydro.h5"
) -> Score:
    """Score the closed loop in sea 1 ... 6 under a controller of SETTINGS."""
    chosen = SETTINGS[controller][sea - 1] if settings is None else settings
    case = case_of(sea, controller, chosen, database)
    law = law_of(sea, controller, chosen, database)
    before = time.process_time()
    results = hydrodae.run(case, controllers=law)
    seconds = time.process_time() - before
    force = results["forces/pto/force"].to_numpy()
    if controller == "latching":  # what it holds with, at a standstill
        force = force + results["constraints/latch/reaction"].to_numpy()
    slide = (results[f"joints/slide/{name}"].to_numpy() for name in ("displacement", RATE))
    score = evaluate(results.time, force, *slide)
    return replace(score, seconds=seconds)


def search(
    sea: int, controller: str, runs: int = 10, database: str = "hydro.h5"
) -> tuple[tuple[float, ...], float]:
    """Best settings of a controller in sea 1 ... 6 and their EC [W].

    By Nelder and Mead from SETTINGS on, in the logarithms of the settings, which keeps signs.

    Parameters
    ----------
    sea : int
    controller : str
    runs : int
        Most runs.
    database : str
        Relative to the folder of the case.
    """
    start = np.array(SETTINGS[controller][sea - 1])

    def loss(logarithms: np.ndarray) -> float:
        return -float(run(sea, controller, tuple(start * np.exp(logarithms)), database).ec)

    corners = np.vstack([np.zeros(start.size), 0.4 * np.eye(start.size)])
    how = {"initial_simplex": corners, "maxfev": runs, "xatol": 0.02, "fatol": 1e-5}
    found = minimize(loss, corners[0], method="Nelder-Mead", options=how)
    return tuple(float(x) for x in start * np.exp(found.x)), -float(found.fun)


def table(seas: list[int], controllers: list[str], database: str) -> None:
    """Print the scores as Markdown."""
    print("| sea | controller | EC, W | mean P, W | f98, N | s98, m | f, s at most | CPU, s |")
    print("|---|---|---|---|---|---|---|---|")
    for sea in seas:
        for controller in controllers:
            s = run(sea, controller, database=database)
            most = f"{s.most_force:.0f} N, {s.most_stroke:.3f} m"
            row = f"{s.ec:.5f} | {s.power:.4f} | {s.force:.1f} | {s.stroke:.4f} | {most}"
            print(f"| {sea} | {controller} | {row} | {s.seconds:.1f} |", flush=True)


def main() -> None:
    """Print the table, or settings."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seas", type=int, nargs="+", default=[1, 2, 3, 4, 5, 6])
    parser.add_argument("--controllers", nargs="+", choices=[*SETTINGS], default=[*SETTINGS])
    parser.add_argument("--database", default="hydro.h5", help="relative to this folder")
    parser.add_argument("--search", action="store_true", help="find the settings that score most")
    arguments = parser.parse_args()
    if not arguments.search:
        table(arguments.seas, arguments.controllers, arguments.database)
        return
    for sea in arguments.seas:
        for controller in arguments.controllers:
            best, ec = search(sea, controller, database=arguments.database)
            told = ", ".join(f"{x:.4g}" for x in best)
            print(f"sea {sea}, {controller}: ({told}), EC {ec:.5f} W", flush=True)


if __name__ == "__main__":
    sys.exit(guarded(main))
