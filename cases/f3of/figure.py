"""Flap decay test of the F3OF device against published codes (Figures 6 and 7 of Ogden et al.).

Ogden et al., "InWave+H", EWTEC 2019: flap 1 is released at 10 degrees beside flap 2 at rest, the
base is fixed. Upper panel: flap 1 over the codes' curves where the reference data is at hand, else
over the span of their extrema. Lower panel: flap 2, moved by the waves that flap 1 radiates (the
codes' series of flap 2 are not in the data).

    hydrodae run cases/f3of/flap_decay.toml -o build/f3of/flap_decay.h5
    python cases/f3of/figure.py build/f3of/flap_decay.h5
"""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

import matplotlib
import numpy as np

from hydrodae import Results
from hydrodae.commands.cli import guarded
from hydrodae.pictures.curve import Curve, read_curve
from hydrodae.pictures.plot import STYLE, draw_comparison, new_figure, save
from hydrodae.results.post import turning_points

#: Column of dt3_flap1_decay.csv and name of each code of the WEC3 comparison (Combourieu et al.,
#: EWTEC 2015) and of HydroChrono.
CODES = {
    "INW_flap1_deg": "InWave",
    "PDS_flap1_deg": "ProteusDS",
    "WDN_flap1_deg": "WaveDyn",
    "WSM_flap1_deg": "WEC-Sim",
    "HCH_flap1_deg": "HydroChrono",
}
#: Left out of the span: it has no radiation between the bodies, and its amplitude grows.
UNCOUPLED = "WSM_flap1_deg"

#: First turning points of flap 1, span of the coupled codes: earliest and latest time [s], least
#: and largest angle [deg].
PUBLISHED = np.array(
    [
        [6.82, 7.03, -9.37, -8.99],
        [13.71, 14.10, 8.73, 9.02],
        [20.61, 21.19, -9.11, -8.53],
        [27.53, 28.23, 8.34, 8.79],
        [34.38, 35.31, -8.78, -8.06],
        [41.29, 42.40, 7.81, 8.45],
    ]
)


def reference_file() -> Path | None:
    """Published series, in $HYDRODAE_REFERENCE or in shared/reference beside the repository."""
    series = Path("f3of", "dt3_flap1_decay.csv")
    named = os.environ.get("HYDRODAE_REFERENCE")
    if named:
        return Path(named) / series
    beside = Path(__file__).resolve().parents[3] / "shared" / "reference" / series
    return beside if beside.is_file() else None


def published_curves(file: Path | None) -> list[Curve]:
    """Series of the codes, or their extrema as points with bars."""
    if file is not None:
        return [read_curve(file, column, label=label) for column, label in CODES.items()]
    angles = PUBLISHED[:, 2:].T
    times = PUBLISHED[:, :2].mean(axis=1)
    return [Curve("extrema of four codes", times, angles.mean(axis=0), True, angles)]


def comparison(results: Results) -> str:
    """Table of our first turning points of flap 1 beside the span of the codes."""
    angle = np.degrees(results["joints/hinge1/angle"].to_numpy())
    rows = ["flap 1, turning points          hydrodae                coupled codes"]
    for time, value, (early, late, low, high) in zip(
        *turning_points(results.time, angle), PUBLISHED, strict=False
    ):
        rows.append(
            f"  {'maximum' if value > 0 else 'minimum'}      {value:8.2f} deg at {time:5.2f} s   "
            f"{low:6.2f} to {high:5.2f} deg at {early:5.2f} to {late:5.2f} s"
        )
    return "\n".join(rows)


@matplotlib.rc_context(STYLE)
def draw(results: Results, picture: Path, end_time: float) -> Path:
    """Draw both flaps up to `end_time` [s] into `picture`."""
    figure, (upper, lower) = new_figure(results, 2, row_height=2.8)
    end_time = min(end_time, results.end_time)
    curves = published_curves(reference_file())
    draw_comparison(upper, results, "joints/hinge1/angle", curves, end_time=end_time)
    draw_comparison(lower, results, "joints/hinge2/angle", [], end_time=end_time)
    upper.set_ylabel("flap 1 angle [deg]")
    lower.set_ylabel("flap 2 angle [deg]")
    return save(figure, picture)


def main() -> None:
    """Draw the figure and print the comparison."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("results", type=Path, help="results of cases/f3of/flap_decay.toml")
    parser.add_argument("-o", "--output", type=Path, help="picture (default: RESULTS.png)")
    parser.add_argument("--end-time", type=float, default=100.0, help="s (default: 100)")
    arguments = parser.parse_args()
    results = Results.read(arguments.results)
    print(comparison(results))
    picture = arguments.output or arguments.results.with_suffix(".png")
    print(f"picture: {draw(results, picture, arguments.end_time)}")


if __name__ == "__main__":
    sys.exit(guarded(main))
