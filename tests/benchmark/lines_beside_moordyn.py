"""A mooring chain beside MoorDyn: equal segments, motion and coefficients; one core, no output.

    .venv/bin/pip install ".[peers]"
    .venv/bin/python tests/benchmark/lines_beside_moordyn.py [--end SECONDS] [N ...]

500 m of chain, 230 m of it on the bed, whose fairlead heaves by 2 m in 10 s. For each N:

- how far the converged tensions of both differ (rms over the range), and from that of our 320
  segments, as the discretisation does,
- rungs of both (steps of MoorDyn's schemes, methods and tolerances of ours): rms error over the
  range against the finest rung of the same code, processor time in ms a simulated second (the
  shortest of three runs), and of MoorDyn's, how many times that of our cheapest rung with an error
  no larger. MoorDyn estimates no error, so these runs of ours do not either; a run with the
  estimate, by a second run, is a rung of its own.

MoorDyn's rk2 is its fastest scheme that holds here: with 1.5 times the coarsest step it is wrong
or stops, as do its others.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib.util
import math
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import hydrodae
from hydrodae.support.extras import install_command

Series = NDArray[np.float64]
EXCHANGE = 0.01  # between calls of MoorDyn, which keeps the velocity within one [s]
AFTER = 10.0  # tensions count from here, grown motion [s]
FINEST = 320
REPEATS = 3
ANCHOR, DEPTH, LENGTH = -475.0, 100.0, 500.0
CHAIN = {"mass": 140.0, "diameter": 0.15, "stiffness": 5e8, "drag": 1.3, "drag_axial": 0.1}
RATIO, BED, BED_DAMPING = 0.5, 1e5, 1e4

OURS = """
[environment]
water_density = 1025.0
water_depth = {depth}
[[body]]
name = "buoy"
motion = ["heave"]
mass = 2e5
center_of_gravity = [0.0, 0.0, 0.0]
[[constraint]]
name = "moves"
type = "coordinate"
body = "buoy"
coordinate = "heave"
drive = {{ amplitude = 2.0, period = 10.0, ramp = 10.0 }}
[[force]]
type = "line"
name = "line"
body_b = "buoy"
point_a = [{anchor}, 0.0, -{depth}]
point_b = [0.0, 0.0, 0.0]
length = [{length}]
segments = [{n}]
{chain}
damping_ratio = [{ratio}]
added_mass = [1.0]
seabed_stiffness = {bed}
seabed_damping = {bed_damping}
[solver]
accuracy = "{accuracy}"
end_time = {end}
method = "{method}"
rtol = {rtol}
order = {order}
[output]
step = {step}
"""
THEIRS = """MoorDyn input file
chain
---- LINE TYPES ----
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx
(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)
chain {diameter} {mass} {stiffness} -{ratio} 0.0 {drag} 1.0 {drag_axial} 0.0
---- POINTS ----
Node Type X Y Z M V CdA CA
(-) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)
1 Fixed {anchor} 0.0 -{depth} 0 0 0 0
2 Coupled 0.0 0.0 0.0 0 0 0 0
---- LINES ----
Line LineType NodeA NodeB UnstrLen NumSegs Outputs
(-) (-) (-) (-) (m) (-) (-)
1 chain 1 2 {length} {n} -
---- OPTIONS ----
0 writeLog
{dt} dtM
{scheme} tScheme
{bed} kb
{bed_damping} cb
{depth} WtrDpth
200.0 TmaxIC
1e-5 threshIC
9.81 g
1025 rho
---- END ----
"""
COMMON = {
    **{"anchor": ANCHOR, "depth": DEPTH, "length": LENGTH},
    **{"ratio": RATIO, "bed": BED, "bed_damping": BED_DAMPING},
}


# Method, order (0: it chooses) and tolerance; auto with the tolerance that a case has by default.
RUNGS = [("radau", 5, r) for r in (1e-1, 3e-2, 5e-3)] + [("radau", 9, 1e-3), ("auto", 0, 1e-4)]


def run_ours(
    n: int,
    method: str,
    rtol: float,
    end: float,
    step: float = 0.1,
    order: int = 0,
    accuracy: str = "none",
) -> tuple[hydrodae.Results, float]:
    """Results and processor time of the whole run [ms/s]."""
    chain = "\n".join(f"{key} = [{value}]" for key, value in CHAIN.items())
    solver = {"method": method, "rtol": rtol, "order": order, "end": end, "step": step}
    solver["accuracy"] = accuracy
    text = OURS.format(n=n, chain=chain, **solver, **COMMON)
    start = time.process_time()
    results = hydrodae.run(hydrodae.Case.from_text(text))
    return results, 1e3 * (time.process_time() - start) / end


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Nothing that a library writes by itself."""
    sys.stdout.flush()
    kept, nothing = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nothing)


def run_theirs(
    n: int, scheme: str, dt: float, motion: tuple[Series, Series]
) -> tuple[Series, float]:
    """Tension every 0.1 s [N] and processor time of the steps [ms/s]."""
    import moordyn

    place, velocity = motion
    every = round(0.1 / EXCHANGE)
    text = THEIRS.format(n=n, scheme=scheme, dt=dt, **CHAIN, **COMMON)
    with tempfile.TemporaryDirectory() as folder, quiet():
        path = Path(folder) / "lines.txt"
        path.write_text(text)
        system = moordyn.Create(str(path))
        moordyn.Init(system, [0.0, 0.0, float(place[0])], [0.0, 0.0, float(velocity[0])])
        fairlead = moordyn.GetPoint(system, 2)
        tension = [math.hypot(*moordyn.GetPointForce(fairlead))]
        spent = 0.0
        for k in range(len(place) - 1):
            start = time.process_time()
            state = [0.0, 0.0, float(place[k])], [0.0, 0.0, float(velocity[k])]
            load = moordyn.Step(system, *state, k * EXCHANGE, EXCHANGE)
            spent += time.process_time() - start
            if (k + 1) % every == 0:
                tension.append(math.hypot(*load))
        moordyn.Close(system)
    return np.asarray(tension), 1e3 * spent / ((len(place) - 1) * EXCHANGE)


def rms(a: Series, b: Series) -> float:
    """Of the difference, over the range of b, after the ramp."""
    late = slice(round(AFTER / 0.1), None)
    return float(np.sqrt(np.mean((a[late] - b[late]) ** 2)) / np.ptp(b[late]))


def row(n: int, what: str, error: float, spent: float, ratio: float = math.nan) -> None:
    more = "" if math.isnan(ratio) else f" {ratio:6.1f}"
    print(f"{n:4d}  {what:26s} {error:9.1e} {spent:9.2f}{more}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description="A mooring chain beside MoorDyn.")
    parser.add_argument("segments", nargs="*", type=int, metavar="N")
    parser.add_argument("--end", type=float, default=30.0, help="[s]")
    arguments = parser.parse_args()
    if importlib.util.find_spec("moordyn") is None:
        print(f"the comparison needs MoorDyn: {install_command('peers')}", file=sys.stderr)
        sys.exit(2)
    end = arguments.end

    def tension(results: hydrodae.Results) -> Series:
        return np.asarray(results["forces/line/tension"].values)

    finest = tension(run_ours(FINEST, "radau", 1e-5, end)[0])
    moves, _ = run_ours(10, "radau", 1e-6, end, EXCHANGE)
    place, velocity = (
        np.asarray(moves[f"bodies/buoy/{key}"].values[:, 2]) for key in ("position", "velocity")
    )
    print("   N  code and rung                  error      ms/s  ratio")
    for n in arguments.segments or [20, 40, 80, 160]:
        exact = tension(run_ours(n, "radau", 1e-6, end)[0])
        ours = []
        for method, order, rtol in RUNGS:
            for accuracy in ("none", "two_runs"):
                runs = [
                    run_ours(n, method, rtol, end, order=order, accuracy=accuracy)
                    for _ in range(REPEATS)
                ]
                ours.append((rms(tension(runs[0][0]), exact), min(spent for _, spent in runs)))
                what = f"{method} {order or ''} {rtol:g}"
                row(n, what + (" estimated" if accuracy == "two_runs" else ""), *ours[-1])
        rungs = [0.2 / n, 0.1 / n, 0.05 / n]  # steps [s], stable ones fall as 1 / N
        theirs = []
        for dt in rungs:
            again = [run_theirs(n, "rk2", dt, (place, velocity)) for _ in range(REPEATS)]
            theirs.append((again[0][0], min(spent for _, spent in again)))
        for dt, (series, spent) in zip(rungs, theirs, strict=True):
            error = rms(series, theirs[-1][0])
            best = min((cost for off, cost in ours if off <= error), default=math.nan)
            row(n, f"MoorDyn rk2 {dt:.2g}", error, spent, spent / best)
        print(f"{n:4d}  MoorDyn beside hydrodae {rms(theirs[-1][0], exact):.1e}", end="; ")
        print(
            f"beside {FINEST} segments: {rms(theirs[-1][0], finest):.1e}, {rms(exact, finest):.1e}"
        )


if __name__ == "__main__":
    main()
