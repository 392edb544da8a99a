"""F3OF in irregular waves: elevation, angles of the flaps, power that the take-offs absorb.

Made after a run of the case:

    hydrodae run cases/f3of/waves.toml -o build/f3of/waves.h5
    python cases/f3of/waves_figure.py build/f3of/waves.h5
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import matplotlib
import numpy as np

from hydrodae import Results
from hydrodae.commands.cli import guarded
from hydrodae.pictures.plot import COLORS, STYLE, new_figure, outside_legend, save
from hydrodae.results.post import absorbed_power, mean_absorbed_power

FLAPS = {"flap 1": ("hinge1", "pto1"), "flap 2": ("hinge2", "pto2")}
#: The mean power is taken from here on [s]: the ramp of the waves is over.
SETTLED = 30.0


def report(results: Results) -> str:
    """Mean absorbed power of each flap and in all."""
    power = {flap: mean_absorbed_power(results, pto, SETTLED) for flap, (_, pto) in FLAPS.items()}
    parts = ", ".join(f"{flap} {1e-3 * value:.1f} kW" for flap, value in power.items())
    return (
        f"mean absorbed power from {SETTLED:g} s to {results.end_time:g} s: {parts}, "
        f"together {1e-3 * sum(power.values()):.1f} kW"
    )


@matplotlib.rc_context(STYLE)
def draw(results: Results, picture: Path) -> Path:
    """Draw the three panels into `picture`."""
    figure, (sea, angles, powers) = new_figure(results, 3, row_height=1.9)
    sea.plot(results.time, results["sea/elevation"], color=COLORS[-3], label="at the origin")
    sea.set_ylabel("wave elevation [m]")
    for color, (flap, (hinge, pto)) in zip(COLORS, FLAPS.items(), strict=False):
        angle = np.degrees(results[f"joints/{hinge}/angle"])
        angles.plot(results.time, angle, color=color, label=flap)
        power = 1e-3 * absorbed_power(results, pto)
        mean = 1e-3 * mean_absorbed_power(results, pto, SETTLED)
        powers.plot(results.time, power, color=color, linewidth=0.8, label=flap)
        powers.axhline(mean, color=color, linestyle="--", label=f"mean {mean:.1f} kW")
    angles.set_ylabel("flap angle [deg]")
    powers.set_ylabel("absorbed power [kW]")
    powers.set_ylim(bottom=0.0)
    for axes in (sea, angles, powers):
        outside_legend(axes)
    sea.set_xlim(results.time[0], results.end_time)
    return save(figure, picture)


def main() -> None:
    """Draw the figure and print the mean powers."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("results", type=Path, help="results of cases/f3of/waves.toml")
    parser.add_argument("-o", "--output", type=Path, help="picture (default: RESULTS.png)")
    arguments = parser.parse_args()
    results = Results.read(arguments.results)
    print(report(results))
    picture = arguments.output or arguments.results.with_suffix(".png")
    print(f"picture: {draw(results, picture)}")


if __name__ == "__main__":
    sys.exit(guarded(main))
