"""A load that falls into its cable, where waves then run along it."""

from __future__ import annotations

import numpy as np

import hydrodae
from hydrodae.simulation import Simulation

CASE = """
[environment]
gravity = 9.81
water_density = 1.0

[[body]]
name = "load"
motion = "point"
mass = 200.0
center_of_gravity = [0.0, 0.0, -9.0]

[[force]]
type = "line"
name = "cable"
body_a = "ground"
point_a = [0.0, 0.0, 0.0]
body_b = "load"
point_b = [0.0, 0.0, -9.0]
length = [10.0]
segments = [10]
mass = [2.0]
diameter = [0.02]
stiffness = [2e6]
damping_ratio = [0.3]
seabed = false

[solver]
end_time = 3.0
rtol = 1e-4
accuracy = "none"

[output]
step = 0.01
"""


def _run(**values: object) -> hydrodae.Results:
    case = hydrodae.Case.from_text(CASE)
    return hydrodae.run(case.with_values({f"solver.{k}": v for k, v in values.items()}))


def test_a_cable_that_snaps_is_left_to_explicit_rk() -> None:
    """radau takes the fall, and explicit_rk the snaps; both find the same motion.

    At 1e-5: each snap magnifies errors. At 1e-4 tolerances that differ by 2 % leave the load 0.05
    to 2 % of its way apart.
    """
    auto, tight = _run(rtol=1e-5), _run(method="radau", rtol=1e-7)
    methods = str(auto.statistics["methods"]).splitlines()
    assert methods[:2] == ["radau", "explicit_rk"]
    z = [run["bodies/load/position"].values[:, 2] for run in (auto, tight)]
    assert np.ptp(z[1]) > 1.0
    assert np.abs(z[0] - z[1]).max() < 5e-3 * np.ptp(z[1])


def test_states_over_turns_of_the_methods() -> None:
    """Going back to a time before a turn, and on again, is the same run."""
    simulation = Simulation(hydrodae.Case.from_text(CASE))
    before = simulation.state()
    ways = []
    for _ in range(2):
        times = [simulation.advance() for _ in range(600)]
        ways.append((times, simulation.state()))
        simulation.restore(before)
    assert ways[0] == ways[1]
    simulation.restore(ways[0][1])
    other = Simulation(hydrodae.Case.from_text(CASE))
    other.restore(ways[0][1])
    assert [other.advance() for _ in range(100)] == [simulation.advance() for _ in range(100)]
