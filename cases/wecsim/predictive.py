"""Run WEC-Sim's example of model predictive control with the controller of hydrodae.

    python cases/wecsim/predictive.py WEC-Sim_Applications/Controls/MPC

The limits, the period and the horizon are those of its input file. Two numbers differ. Its weight
is on the rate of the load, here it is on the load. Its forecast of order 4 takes the loads at the
samples; here they are means over the periods, whose forecast needs order 16 to keep the limits.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

import numpy as np
from of_case import tables_of  # type: ignore[import-not-found] # stands beside this file

import hydrodae
from hydrodae.control import AutoregressiveForecast, ModelPredictive, Plant
from hydrodae.wecsim import convert
from hydrodae.wecsim.m_file import evaluate, read_input

ORDER, WEIGHT = 16, 1e-7  # -, m/(N s)
NAME = "pto1_actuator"  # the controller that the conversion prepares


def figures(case: Path, folder: Path, seeds: int) -> dict[str, float]:
    """Mean power [W] of the last ten periods of each sea, their mean; the largest of the others.

    Parameters
    ----------
    case : Path
        The converted case, whose controller is to be written.
    folder : Path
        Of the example.
    seeds : int
        How many seas.
    """
    read = read_input(folder / "wecSimInputFile.m")

    def given(name: str) -> float:
        return float(evaluate(read, f"controller(1).modelPredictiveControl.{name}"))

    period = given("dt")
    plant = Plant(case, "pto1")
    rows = []
    for seed in range(1, seeds + 1):
        law = ModelPredictive(
            plant,
            AutoregressiveForecast(ORDER, int(given("Ho"))),
            period=period,
            horizon=round(given("predictionHorizon") / period),
            damping=0.0,
            weight=WEIGHT,
            load_limit=given("maxPTOForce"),
            rate_limit=given("maxPTOForceChange"),
            stroke=(-given("maxPos"), given("maxPos")),
            velocity_limit=given("maxVel"),
        )
        values = {"wave.waves.seed": seed, f"controller.{NAME}.period": period}
        run = hydrodae.run(case, controllers={NAME: law}, set=values)
        time, load = np.asarray(run.time), np.asarray(run[f"controllers/{NAME}/output"])
        last = time >= time[-1] - 10.0 * tables_of(case)["wave"][0]["peak_period"]
        rows.append(
            (
                np.mean(np.asarray(run[f"forces/{NAME}/power_absorbed"])[last]),
                np.abs(run["joints/pto1/displacement"]).max(),
                np.abs(run["joints/pto1/displacement_rate"]).max(),
                np.abs(load).max(),
                np.abs(np.diff(load)).max() / period,
            )
        )
    table = np.array(rows, dtype=float)
    names = ("displacement", "velocity", "load", "rate of load")
    largest = dict(zip(names, map(float, table[:, 1:].max(axis=0)), strict=True))
    deviation = float(np.std(table[:, 0], ddof=1)) if seeds > 1 else float("nan")
    return {"power": float(np.mean(table[:, 0])), "deviation of power": deviation} | largest


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n", 1)[0])
    parser.add_argument("folder", type=Path, help="Controls/MPC of WEC-Sim's applications")
    source = parser.parse_args().folder
    with tempfile.TemporaryDirectory() as name:
        found = figures(convert(source, Path(name) / "case").case, source, 10)
    for quantity, value in found.items():
        print(f"{quantity}: {value:.5g}")
