"""Figure 18 of the paper: pitch of nodes against their arms, for several take-offs.

    python cases/9n9la/figure18.py frequency     # the linear model: seconds
    python cases/9n9la/figure18.py spectral      # in the irregular sea, by linear statistics
    python cases/9n9la/figure18.py time          # regular waves of 1 mm: minutes

S2 against LA2 of the 4N3LA; S2 against LA5 and D1 against LA2 of the 9N9LA. Both databases have to
be there (`four_nodes.py database`, `nine_nodes.py database`). `frequency` and `time` draw
figure18.png, where points are those of `time`; `spectral` prints a table.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from nine_nodes import HERE
from nine_nodes import LAYOUT as HEX
from numpy.typing import NDArray

from hydrodae import Scene
from hydrodae.commands.cli import guarded

SQUID_FOLDER = HERE.parent / "4n3la"

import parts  # noqa: E402
import study  # noqa: E402

from hydrodae.linear import LinearModel  # noqa: E402

Array = NDArray[np.float64]
SQUID = parts.SQUID
#: Device, arm and node of each curve.
CURVES = (
    ("4N3LA, S2 - LA2", SQUID, SQUID_FOLDER, "LA2", "S2"),
    ("9N9LA, S2 - LA5", HEX, HERE, "LA5", "S2"),
    ("9N9LA, D1 - LA2", HEX, HERE, "LA2", "D1"),
)
#: Stiffness and damping over those of the baseline.
VARIANTS = {
    "baseline": (1.0, 1.0),
    "stiffness x 0.25": (0.25, 1.0),
    "stiffness x 4": (4.0, 1.0),
    "damping x 0.25": (1.0, 0.25),
    "damping x 4": (1.0, 4.0),
}
PERIODS = np.linspace(1.0, 5.0, 161)  # s
POINTS = (1.4, 1.8, 2.4, 3.2)  # s, of runs


def scene(layout: parts.Layout, folder: Path, variant: str) -> Scene:
    """Device with the take-offs of a variant, without waves and times."""
    stiffness, damping = VARIANTS[variant]
    return parts.device(layout, folder, stiffness * parts.STIFFNESS, damping * parts.DAMPING)


def pitch(found: study.Linear, layout: parts.Layout, arm: str, node: str) -> Array:
    """Amplitude of the pitch of a node against its arm (nw,) [deg/m]."""
    return np.asarray(np.degrees(np.abs(study.turns(found, layout, arm, node)[:, 1])))


def linear(variant: str) -> dict[str, Array]:
    """Curves of a variant over PERIODS, each device linearised once."""
    found = {
        layout.title: study.linear(
            parts.regular(scene(layout, folder, variant)), 2.0 * np.pi / PERIODS[::-1]
        )
        for layout, folder in ((SQUID, SQUID_FOLDER), (HEX, HERE))
    }
    return {
        name: pitch(found[layout.title], layout, arm, node)[::-1]
        for name, layout, _, arm, node in CURVES
    }


def draw(points: dict[str, dict[str, list[float]]]) -> None:
    """Draw the curves of all variants, and points of runs by variant and curve."""
    curves = {variant: linear(variant) for variant in VARIANTS}
    figure = Figure(figsize=(11.0, 7.0), layout="constrained")
    axes = figure.subplots(2, 3, sharex=True, sharey="col")
    for row, word in enumerate(("stiffness", "damping")):
        for axis, (name, *_) in zip(axes[row], CURVES, strict=True):
            for variant, values in curves.items():
                if variant != "baseline" and not variant.startswith(word):
                    continue
                (line,) = axis.plot(PERIODS, values[name], label=variant)
                seen = points.get(variant, {}).get(name, [])
                axis.plot(POINTS[: len(seen)], seen, "o", color=line.get_color(), markersize=4)
            axis.set_title(name if row == 0 else "")
            axis.set_xlabel("period, s" if row else "")
            axis.grid(alpha=0.3)
        axes[row][0].set_ylabel("relative pitch, deg/m")
        axes[row][0].legend()
    figure.savefig(HERE / "figure18.png", dpi=90)
    print(f"picture: {HERE / 'figure18.png'}")


def runs() -> dict[str, dict[str, list[float]]]:
    """Points of all curves at POINTS, from runs in waves of 1 mm of the baseline."""
    points: dict[str, list[float]] = {name: [] for name, *_ in CURVES}
    for layout, folder in ((SQUID, SQUID_FOLDER), (HEX, HERE)):
        baseline = parts.regular(scene(layout, folder, "baseline"))
        light = study.light_modes(baseline)
        known = study.linear(baseline, 2.0 * np.pi / np.array(POINTS))
        for i, period in enumerate(POINTS):
            results = study.regular_wave_run(baseline, period, 1e-3, 30.0)
            for name, other, _, arm, node in CURVES:
                if other is layout:
                    channel = f"forces/pto_{arm}_{node}/rotation"
                    seen = study.harmonic(results, channel, period, 8.0 * period + 5.0, light)[1]
                    points[name].append(float(np.degrees(abs(seen))))
                    line = pitch(known, layout, arm, node)[i]
                    print(f"{name}, {period:g} s: {points[name][-1]:.2f}, linear {line:.2f} deg/m")
    return {"baseline": points}


def statistics() -> None:
    """Print standard deviations in the irregular sea of the cases, by linear superposition."""
    print("standard deviation of relative pitch, deg, sea of 0.15 m and 2.2 s")
    print(f"{'':18s}" + "".join(f"{name:>18s}" for name, *_ in CURVES))
    for variant in VARIANTS:
        line = f"{variant:18s}"
        for _, layout, folder, arm, node in CURVES:
            model = LinearModel(parts.irregular(scene(layout, folder, variant)).case())
            line += f"{study.deviation(model, layout, arm, node):18.2f}"
        print(line)


def main() -> int:
    """Draw the figure, or print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("way", choices=["frequency", "spectral", "time"])
    way = parser.parse_args().way
    if way == "spectral":
        statistics()
    else:
        draw(runs() if way == "time" else {})
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
