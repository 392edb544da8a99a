"""F3OF with its base free: decays in surge (DT1) and pitch (DT2), and responses in waves.

    python cases/f3of/free_base.py          # decays.png and rao.png beside this file

Curves of other codes are drawn where the reference data is at hand ($HYDRODAE_REFERENCE, or
shared/reference beside the repository): the surge decay of four, the responses of InWave. They
have none of the pitch decay. Responses are those of the linear model.
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import matplotlib
import matplotlib.figure
import numpy as np

import hydrodae
from hydrodae import HydrodaeError
from hydrodae.commands.cli import guarded
from hydrodae.linear import LinearModel
from hydrodae.pictures.curve import Curve, read_curve
from hydrodae.pictures.plot import COLORS, STYLE, draw_comparison, new_figure, outside_legend, save

HERE = Path(__file__).resolve().parent
CODES = {"INW": "InWave", "PDS": "ProteusDS", "WDN": "WaveDyn", "WSM": "WEC-Sim"}
#: Channel of the response, column of rao_inw.csv, label with unit, factor from SI.
DEGREES = float(np.degrees(1.0))
RESPONSES = (
    ("bodies/base/surge", "surge_m_per_m", "base surge [m/m]", 1.0),
    ("bodies/base/heave", "heave_m_per_m", "base heave [m/m]", 1.0),
    ("bodies/base/pitch", "pitch_deg_per_m", "base pitch [deg/m]", DEGREES),
    ("joints/hinge1/angle", "flap1_rel_deg_per_m", "flap 1 [deg/m]", DEGREES),
    ("joints/hinge2/angle", "flap2_rel_deg_per_m", "flap 2 [deg/m]", DEGREES),
)
PERIODS = np.linspace(4.0, 15.0, 221)  # s


def reference(name: str) -> Path | None:
    """File of the reference data, if it is there."""
    named = os.environ.get("HYDRODAE_REFERENCE")
    folder = Path(named) if named else HERE.parents[2] / "shared" / "reference"
    file = folder / "f3of" / name
    return file if file.is_file() else None


def published(column: str) -> list[Curve]:
    """Curves of the codes in the surge decay."""
    file = reference("dt1_surge_decay.csv")
    return [
        read_curve(file, f"{code}_{column}", label=label)
        for code, label in CODES.items()
        if file is not None
    ]


@matplotlib.rc_context(STYLE)
def draw_decays(picture: Path, end_time: float = 100.0) -> Path:
    """Draw surge, heave and pitch of DT1 and pitch of DT2, from runs."""
    times = {"solver.end_time": end_time}
    surge = hydrodae.run(HERE / "surge_decay.toml", set=times)
    pitch = hydrodae.run(HERE / "pitch_decay.toml", set=times)
    figure, axes = new_figure(surge, 4, row_height=1.9)
    for axis, channel, column, label in (
        (axes[0], "bodies/base/position.x", "surge_m", "DT1: surge [m]"),
        (axes[1], "bodies/base/position.z", "heave_m", "DT1: height [m]"),
        (axes[2], "bodies/base/rotation.y", "pitch_deg", "DT1: pitch [deg]"),
        (axes[3], "bodies/base/rotation.y", "", "DT2: pitch [deg]"),
    ):
        curves = published(column) if column else []
        draw_comparison(axis, surge if column else pitch, channel, curves, end_time=end_time)
        axis.set_ylabel(label)
    figure.suptitle("F3OF, flaps locked, base free: released 5 m down-wave (DT1), at 10 deg (DT2)")
    return save(figure, picture)


@matplotlib.rc_context(STYLE)
def draw_responses(picture: Path) -> Path:
    """Draw what the base and the flaps do in waves of 4 to 15 s."""
    model = LinearModel(hydrodae.Case.read(HERE / "rao.toml"))
    response = model.response(2.0 * np.pi / PERIODS[::-1], 0.0)
    file = reference("rao_inw.csv")
    figure = matplotlib.figure.Figure(figsize=(8.0, 9.0), layout="constrained")
    axes = figure.subplots(len(RESPONSES), 1, sharex=True)
    for axis, (channel, column, label, scale) in zip(axes, RESPONSES, strict=True):
        values = scale * np.abs(response[channel])[::-1]
        axis.plot(PERIODS, values, color=COLORS[0], label="hydrodae")
        if file is not None:
            table = np.genfromtxt(file, delimiter=",", names=True)
            axis.plot(table["period_s"], table[column], "o", color=COLORS[1], ms=3, label="InWave")
        axis.set_ylabel(label)
        axis.set_ylim(0.0, 1.3 * np.percentile(values, 95.0))
        outside_legend(axis)
    axes[-1].set_xlabel("wave period [s]")
    axes[-1].set_xlim(PERIODS[0], PERIODS[-1])
    figure.suptitle("F3OF, all bodies free, a damper in each hinge")
    return save(figure, picture)


def main() -> int:
    """Draw both pictures; returns the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("-o", "--output", type=Path, default=HERE, help="folder of the pictures")
    folder = parser.parse_args().output
    try:
        print(f"picture: {draw_decays(folder / 'decays.png')}")
        print(f"picture: {draw_responses(folder / 'rao.png')}")
    except HydrodaeError as error:
        print(f"free_base.py: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
