"""Cost of a dynamic mooring line against its number of segments, by method.

    python tests/benchmark/lines.py [N ...]

A chain on the seabed whose fairlead heaves by 2 m in 10 s. For each method and N: steps and time a
simulated second, and the largest error of the tension over its range against radau at rtol 1e-6.
"""

from __future__ import annotations

import argparse
import time

import numpy as np

import hydrodae

CASE = """
[environment]
water_density = 1025.0
water_depth = 50.0
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
point_a = [-385.0, 0.0, -50.0]
point_b = [0.0, 0.0, 0.0]
length = [400.0]
segments = [{n}]
mass = [140.0]
diameter = [0.15]
stiffness = [5e8]
damping_ratio = [0.5]
drag = [1.3]
drag_axial = [0.1]
added_mass = [1.0]
seabed_damping = 1e4
[solver]
end_time = {end}
method = "{method}"
rtol = {rtol}
[output]
step = 0.1
"""
RUNS = [("radau", 1e-3), ("ida", 1e-4), ("ida", 1e-3), ("radau", 1e-4)]


def run(n: int, method: str, rtol: float, end: float = 30.0) -> tuple[np.ndarray, float, float]:
    """Tension, steps and time [ms] a simulated second."""
    case = hydrodae.Case.from_text(CASE.format(n=n, method=method, rtol=rtol, end=end))
    start = time.perf_counter()
    result = hydrodae.run(case)
    spent = 1e3 * (time.perf_counter() - start) / end
    steps = float(result.statistics["steps"]) / end
    return np.asarray(result["forces/line/tension"].values), steps, spent


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("segments", nargs="*", type=int, metavar="N", default=[20, 40, 80, 160])
    segments = parser.parse_args().segments
    print("   N  method       rtol   steps/s    ms/s   error")
    for n in segments:
        exact, _, _ = run(n, "radau", 1e-6)
        for method, rtol in RUNS:
            try:
                tension, steps, spent = run(n, method, rtol)
            except hydrodae.HydrodaeError as reason:
                print(f"{n:4d}  {method:11s} {rtol:g}: {reason}")
                continue
            error = float(np.abs(tension - exact).max() / np.ptp(exact))
            print(f"{n:4d}  {method:11s} {rtol:6g} {steps:8.1f} {spent:7.2f} {error:9.1e}")


if __name__ == "__main__":
    main()
