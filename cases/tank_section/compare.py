"""Tables and picture of the section in the flume: measured against computed.

python cases/tank_section/compare.py
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import hydrodae
from hydrodae.linear import LinearModel
from hydrodae.pictures.plot import STYLE, save

Array = NDArray[np.float64]
Row = dict[str, float]

FOLDER = Path(__file__).parent
#: Natural periods of decays in the flume [s].
NATURAL = {"heave": 1.17, "pitch": 1.26, "surge": 7.5}
SPRINGS = [{"type": "pto_linear", "name": "springs", "joint": "rail", "stiffness": 59.5}]
#: Stiction of the rails beside their dry damping 8.7 N s/m: none, and as in section.toml [N].
NONE, FRICTION = 1e-9, 0.5
MOTIONS = {"along": "joints/rail/displacement", "up": "joints/slide/displacement",
           "moment": "joints/hinge/angle"}  # fmt: skip
RECORDS = {"3031_2": "wave_1031_1.csv", "3061_2": "wave_1061_1.csv", "3101_3": "wave_1101_1.csv"}


def measured(kind: str) -> dict[str, Row]:
    """Tests whose names begin with 2 (section fixed) or 3 (free), from measured.csv."""
    with (FOLDER / "measured.csv").open() as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return {
            row["test"]: {key: float(value) for key, value in row.items() if key != "test"}
            for row in rows
            if row["test"].startswith(kind)
        }


def harmonic(time: Array, values: Array, omega: float, start: float, cycles: float) -> float:
    """Amplitude of the first harmonic over whole cycles, by least squares."""
    inside = (time >= start) & (time < start + cycles * 2.0 * np.pi / omega - 1e-9)
    t = time[inside]
    basis = np.stack([np.cos(omega * t), np.sin(omega * t), np.ones(t.size)], axis=1)
    found = np.linalg.lstsq(basis, values[inside], rcond=None)[0]
    return float(np.hypot(found[0], found[1]))


def fixed_forces(period: float) -> tuple[float, float]:
    """Horizontal and vertical force per metre of wave amplitude on the fixed section [N/m]."""
    results = hydrodae.run(
        FOLDER / "fixed.toml",
        set={"wave.wave.period": period, "wave.wave.height": 2.0, "solver.end_time": 10 * period,
             "sea.ramp": 2.0 * period, "output.step": period / 40.0},
    )  # fmt: skip
    force = results["bodies/section/support_force"].values
    omega = 2.0 * np.pi / period
    x, z = (harmonic(results.time, force[:, k], omega, 5.0 * period, 4) for k in (0, 2))
    return x, z


def natural_periods() -> dict[str, float]:
    """Of the case without its friction [s]."""
    modes = LinearModel(hydrodae.Case(path=FOLDER / "section.toml", values={"force": SPRINGS}))
    out = {}
    for mode in modes.modes():
        label = max(NATURAL, key=lambda name: abs(mode.shape[f"bodies/section/{name}"]))
        out[label] = mode.period
    return out


def without_losses(periods: Array) -> Array:
    """Heave per metre of wave amplitude by linear theory, rails without any loss."""
    model = LinearModel(hydrodae.Case(path=FOLDER / "section.toml", values={"force": SPRINGS}))
    response = model.response(2.0 * np.pi / periods)
    return np.asarray(np.abs(response["joints/slide/displacement"]))


def settled(row: Row, stiction: float) -> dict[str, float]:
    """Motions that a regular wave of the height of a test settles to (spectral), per metre."""
    found = hydrodae.spectral(
        FOLDER / "section.toml",
        set={"wave.wave.period": row["period"], "wave.wave.height": 2.0 * row["incident"],
             "force.rail_friction.static": stiction, "force.slide_friction.static": stiction},
    )  # fmt: skip
    return {name: float(abs(found.channel(channel)[0])) for name, channel in MOTIONS.items()}


def in_the_record(test: str, row: Row, stiction: float | None) -> dict[str, float]:
    """Amplitudes of a run in the measured wave, over the window of the test [m, rad].

    Without a stiction the rails have no losses at all. A record that ends before the window does
    shortens it by whole cycles.
    """
    record = np.genfromtxt(FOLDER / RECORDS[test], delimiter=",", names=True)
    wave = {
        "name": "wave", "type": "measured", "time": record["time"], "point": [-1.5, 0.0],
        "elevation": record["elevation"], "taper": 1.0, "frequency_range": [1.5, 14.0],
    }  # fmt: skip
    rails: dict[str, object] = {"force": SPRINGS}
    if stiction is not None:
        rails = {f"force.{rail}_friction.static": stiction for rail in ("rail", "slide")}
    end = record["time"][-1] - 1.0
    cycles = min(row["cycles"], np.floor((end - row["window"]) / row["period"]))
    results = hydrodae.run(
        FOLDER / "section.toml",
        set={"wave": [wave], "sea.ramp": 0.0, **rails,
             "solver.end_time": row["window"] + cycles * row["period"] + 0.1},
    )  # fmt: skip
    omega = 2.0 * np.pi / row["period"]
    return {
        name: harmonic(results.time, results[channel].values, omega, row["window"], cycles)
        for name, channel in MOTIONS.items()
    }


def force_table() -> list[tuple[str, float, float, float, float, float]]:
    """Test, period, measured and computed forces along and up [N/m]."""
    out, computed = [], {}
    for test, row in measured("2").items():
        if row["period"] not in computed:
            computed[row["period"]] = fixed_forces(row["period"])
        x, z = computed[row["period"]]
        out.append(
            (test, row["period"], row["along"] / row["incident"], x, row["up"] / row["incident"], z)
        )
    return out


def report() -> str:
    """All tables."""
    lines = ["force on the fixed section per metre of wave amplitude, measured, computed [N/m]"]
    lines.append(f"{'test':8} {'T [s]':>7} {'along':>16} {'':>7} {'up':>16}")
    for test, period, fx, x, fz, z in force_table():
        lines.append(
            f"{test:8} {period:7.3f} {fx:8.0f}{x:8.0f} {100 * (x / fx - 1):+6.1f}% "
            f"{fz:8.0f}{z:8.0f} {100 * (z / fz - 1):+6.1f}%"
        )
    lines.append("\nnatural periods, measured, computed [s]")
    for name, period in natural_periods().items():
        truth = NATURAL[name]
        lines.append(f"{name:8} {truth:8.2f}{period:8.3f} {100 * (period / truth - 1):+6.1f}%")
    lines.append(
        "\nheave per metre of wave amplitude: measured; linear without losses; settled, damped by "
        "the rails without and with stiction"
    )
    for test, row in measured("3").items():
        truth = row["up"] / row["incident"]
        values = [
            float(without_losses(np.array([row["period"]]))[0]),
            settled(row, NONE)["up"],
            settled(row, FRICTION)["up"],
        ]
        cells = " ".join(f"{v:8.3f} {100 * (v / truth - 1):+6.1f}%" for v in values)
        lines.append(f"{test:8} {row['period']:7.3f} {truth:8.3f} {cells}")
    lines.append(
        "\nruns in the measured wave, window of the test: measured; computed without losses, "
        "with damped rails, and with stiction: along [mm], heave [mm], roll [deg]"
    )
    for test in RECORDS:
        row = measured("3")[test]
        runs = [in_the_record(test, row, stiction) for stiction in (None, NONE, FRICTION)]
        for name, factor in (("along", 1e3), ("up", 1e3), ("moment", 180.0 / np.pi)):
            cells = " ".join(
                f"{factor * one[name]:7.2f} {100 * (one[name] / row[name] - 1):+6.1f}%"
                for one in runs
            )
            lines.append(
                f"{test:8} {row['period']:7.3f} {name:7} {factor * row[name]:7.2f} {cells}"
            )
    return "\n".join(lines)


@matplotlib.rc_context(STYLE)
def draw(path: Path) -> Path:
    """Forces on the fixed section and heave of the free one over the period."""
    figure = Figure(figsize=(8.0, 6.0), layout="constrained")
    forces, heave = figure.subplots(2, 1, sharex=True)
    rows = sorted(force_table(), key=lambda row: row[1])
    period = np.array([row[1] for row in rows])
    for k, name, color in ((2, "along", "C0"), (4, "up", "C1")):
        forces.plot(period, [row[k] for row in rows], "o", color=color, label=f"{name}, measured")
        forces.plot(period, [row[k + 1] for row in rows], color=color, label=f"{name}, computed")
    forces.set_ylabel("force on the fixed section [N/m]")
    free = measured("3")
    points = np.array([[r["period"], r["up"] / r["incident"]] for r in free.values()])
    heave.plot(points[:, 0], points[:, 1], "ko", label="measured")
    grid = np.linspace(0.64, 1.52, 80)
    heave.plot(grid, without_losses(grid), ":", color="C3", label="linear, no losses")
    for stiction, label, style in ((NONE, "rails damped, no stiction", "--"),
                                   (FRICTION, "rails damped, stiction 0.5 N", "-")):  # fmt: skip
        height = {"incident": 0.012}
        values = [settled({"period": t, **height}, stiction)["up"] for t in grid]
        heave.plot(grid, values, style, color="C0", label=label)
    records = [free[test]["period"] for test in RECORDS]
    runs = [in_the_record(t, free[t], FRICTION)["up"] / free[t]["incident"] for t in RECORDS]
    heave.plot(records, runs, "x", color="C0", markersize=9, label="run in the measured wave")
    heave.set_ylabel("heave [m/m]")
    heave.set_xlabel("wave period [s]")
    for axes in (forces, heave):
        axes.legend(fontsize=8)
        axes.set_ylim(bottom=0.0)
    return save(figure, path)


if __name__ == "__main__":
    argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0]).parse_args()
    print(report())
    print(f"picture: {draw(FOLDER / 'tank_section.png')}")
