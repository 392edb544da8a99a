"""How long the period of an exchange may be: limits found by runs beside those of theory.

    python cases/control/delay.py           # prints the table, draws delay.png

The float of case.toml under a damper C or a spring K that another program closes: it reads x and x'
at k T, and its load u = -K x - C x' holds for one period T, from k T on or one period late. With
F = e^(A T) and G the answer of the float to a held load, the samples obey

    y(k+1) = F y(k) + G u(k), u(k) = -[K C] y(k)      late: u(k) = -[K C] y(k-1)

and grow where the largest eigenvalue is outside the unit circle. From the samples of a run the same
eigenvalue comes as the root of the recursion that fits them best.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import matplotlib
import matplotlib.ticker
import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

import hydrodae
from hydrodae.commands.cli import guarded
from hydrodae.pictures.plot import COLORS, STYLE

HERE = Path(__file__).parent
MASS, SPRING, DAMPING = 1000.0, 4000.0, 100.0  # of case.toml: kg, N/m, N s/m
OMEGA = float(np.sqrt(SPRING / MASS))
#: Dampers per critical damping 2 m w0, springs per that of the float.
DAMPERS = (0.2, 0.4, 0.8, 1.6, 3.0)
SPRINGS = (0.05, 0.1, 0.2, 0.5, 1.2)
SAMPLES = 40
LONGEST = 3.0  # s, about a natural period of the float

LATE = """
[[controller]]
type = "reactive"
name = "exchange"
inputs = ["joints/slide/displacement", "joints/slide/displacement_rate"]
outputs = ["forces/pto/load"]
period = {period!r}
delay = {delay!r}
stiffness = {stiffness!r}
damping = {damping!r}

[solver]
rtol = 1e-9
end_time = {end!r}

[output]
step = {period!r}
"""


def text(period: float, stiffness: float, damping: float, late: bool, end: float) -> str:
    """The float under K [N/m] and C [N s/m], exchanged every T [s], as a case file."""
    head = (HERE / "case.toml").read_text().split("[[controller]]")[0]
    delay = period if late else 0.0
    values = {"period": period, "delay": delay, "end": end}
    return head + LATE.format(stiffness=stiffness, damping=damping, **values)


def eigenvalue(period: float, stiffness: float, damping: float, late: bool) -> float:
    """Modulus of the largest eigenvalue of the sampled float: it grows above 1."""
    whole = np.zeros((3, 3))
    whole[:2] = [[0.0, 1.0, 0.0], [-SPRING / MASS, -DAMPING / MASS, 1.0 / MASS]]
    step = expm(period * whole)
    gain = -np.array([[stiffness, damping]])
    if not late:
        step = step[:2, :2] + step[:2, 2:] @ gain
    else:
        step[2] = [*gain[0], 0.0]  # what is held next
    return float(np.abs(np.linalg.eigvals(step)).max())


def run(given: str) -> hydrodae.Results:
    """The run of a case; what there is of it where the kernel ended a motion that grows."""
    try:
        return hydrodae.run(hydrodae.Case.from_text(given))
    except hydrodae.SolverError as error:
        if not isinstance(error.results, hydrodae.Results) or error.reason != "growth":
            raise
        return error.results


def measured(results: hydrodae.Results, late: bool) -> float:
    """The same from the samples of a run: the largest root of the recursion of their order."""
    x = results["joints/slide/displacement"].to_numpy()[3:]
    order = 3 if late else 2
    rows = np.lib.stride_tricks.sliding_window_view(x, order + 1)
    rows = rows / np.abs(rows).max(axis=1, keepdims=True)  # so that all samples count
    weights = np.linalg.lstsq(rows[:, :-1], rows[:, -1], rcond=None)[0]
    return float(np.abs(np.roots([1.0, *-weights[::-1]])).max())


def limit(stiffness: float, damping: float, late: bool, by_runs: bool) -> float:
    """Shortest period with which the motion grows [s]; NaN where none of up to LONGEST does."""

    def growth(period: float) -> float:
        if not by_runs:
            return float(np.log(eigenvalue(period, stiffness, damping, late)))
        given = text(period, stiffness, damping, late, SAMPLES * period)
        return float(np.log(measured(run(given), late)))

    longer = 0.01
    while growth(longer) < 0.0:
        longer *= 1.15
        if longer > LONGEST:
            return float("nan")
    return float(brentq(growth, longer / 1.15, longer, rtol=1e-4, xtol=1e-5))


def study() -> list[tuple[str, bool, float, float, float]]:
    """What, late or not, its size, limit of theory, limit of runs [s]."""
    out = []
    for kind, sizes in (("damper", DAMPERS), ("spring", SPRINGS)):
        for late in (False, True):
            for size in sizes:
                K = size * SPRING if kind == "spring" else 0.0
                C = size * 2.0 * MASS * OMEGA if kind == "damper" else 0.0
                theory, runs = (limit(K, C, late, by_runs) for by_runs in (False, True))
                out.append((kind, late, size, theory, runs))
    return out


@matplotlib.rc_context(STYLE)
def draw(rows: list[tuple[str, bool, float, float, float]], picture: Path) -> None:
    """Limits over the size of a damper and of a spring."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(8.0, 3.2), layout="constrained")
    names = {"damper": "damper, of critical damping", "spring": "spring, of that of the float"}
    for panel, (kind, label) in zip(axes, names.items(), strict=True):
        sizes = np.geomspace(*{"damper": (0.12, 4.0), "spring": (0.04, 1.4)}[kind], 60)
        for late, color in ((False, COLORS[0]), (True, COLORS[1])):
            K, C = (0.0, 2.0 * MASS * OMEGA) if kind == "damper" else (SPRING, 0.0)
            curve = [OMEGA * limit(x * K, x * C, late, by_runs=False) for x in sizes]
            name = "one period late" if late else "at once"
            panel.loglog(sizes, curve, color=color, label=f"{name}, eigenvalues")
            mine = [(row[2], OMEGA * row[4]) for row in rows if row[:2] == (kind, late)]
            panel.loglog(*np.transpose(mine), "o", color=color, label=f"{name}, runs")
        for axis in (panel.xaxis, panel.yaxis):
            axis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter("{x:g}")
            axis.set_minor_locator(matplotlib.ticker.NullLocator())
        panel.set_xlabel(label)
        panel.set_ylabel("longest period, w0 T (above: it grows)")
    axes[0].legend()
    figure.savefig(picture, dpi=150)
    pyplot.close(figure)


def main() -> None:
    """Print the limits and draw them."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("-o", "--output", type=Path, default=HERE / "delay.png")
    arguments = parser.parse_args()
    rows = study()
    print("| load | answer | size | limit of theory, s | found by runs, s |\n|---|---|---|---|---|")
    for kind, late, size, theory, found in rows:
        print(f"| {kind} | {'late' if late else 'at once'} | {size} | {theory:.4f} | {found:.4f} |")
    worst = np.nanmax([abs(row[4] / row[3] - 1.0) for row in rows])
    if any(np.isnan(row[3]) != np.isnan(row[4]) for row in rows):
        raise SystemExit("runs and eigenvalues disagree on where there is a limit")
    draw(rows, arguments.output)
    print(f"\nlargest difference {worst:.1e}; written: {arguments.output}")


if __name__ == "__main__":
    sys.exit(guarded(main))
