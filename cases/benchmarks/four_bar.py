"""Write the case of a chain of N four-bar windows.

    python cases/benchmarks/four_bar.py 40 [-o CASE.toml]

N + 1 uprights and N couplers, uniform bars of 1 m and 1 kg, upright, B0 at +1 m/s (IFToMM A02 has
N = 40). All bars lie in one line when the uprights are level: a singular pose.
"""

from __future__ import annotations

import argparse
from pathlib import Path

HEADER = """\
# Chain of {n} four-bar windows: {uprights} uprights and {n} couplers, uniform bars of 1 m and 1 kg,
# upright, B0 (the top of the first upright) at +1 m/s. Written by four_bar.py {n}.
# Source: {source}.
# Tests: singular poses (level uprights), where the mechanism may fork; all uprights stay parallel.
# Compared: B0, twice the position x, z of up0, with B0x, B0y.
# The reference is in the x-y plane; its y is our z, so that its angles turn about our -y.
title = "Chain of {n} four-bar windows"
"""

BODY = """
[[body]]
name = "{name}"
motion = "planar"
mass = 1.0
center_of_gravity = [{x}, 0.0, {z}]
inertia = [{inertia}, {inertia}, {inertia}]
initial.velocity = [{speed}, 0.0, 0.0]
"""

JOINT = """
[[joint]]
name = "{name}"
type = "revolute"
body_a = "{a}"
body_b = "{b}"
point = [{x}, 0.0, {z}]
axis = [0.0, -1.0, 0.0]
"""


def four_bar(n: int, end_time: float = 10.0, step: float = 0.05) -> str:
    """Text of the case."""
    stored = "tests/verification/truths/n_four_bar_2.json (DOP853, one angle)"
    source = stored if n == 2 else "by definition, by convergence of two methods"
    text = HEADER.format(n=n, uprights=n + 1, source=source)
    inertia = repr(1.0 / 12.0)
    for i in range(n + 1):
        text += BODY.format(name=f"up{i}", x=float(i), z=0.5, inertia=inertia, speed=0.5)
        text += "initial.angular_velocity = [0.0, 1.0, 0.0]\n"
    for i in range(n):
        text += BODY.format(name=f"top{i}", x=i + 0.5, z=1.0, inertia=inertia, speed=1.0)
    for i in range(n + 1):
        text += JOINT.format(name=f"A{i}", a="ground", b=f"up{i}", x=float(i), z=0.0)
        if i > 0:
            text += JOINT.format(name=f"B{i}l", a=f"up{i}", b=f"top{i - 1}", x=float(i), z=1.0)
        if i < n:
            text += JOINT.format(name=f"B{i}r", a=f"up{i}", b=f"top{i}", x=float(i), z=1.0)
    return text + f"\n[solver]\nend_time = {end_time}\n\n[output]\nstep = {step}\n"


def main() -> None:
    """Write the case that the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("windows", type=int, help="number of windows N")
    parser.add_argument("-o", "--output", type=Path, help="default: n_four_bar_N.toml here")
    arguments = parser.parse_args()
    default = Path(__file__).with_name(f"n_four_bar_{arguments.windows}.toml")
    (arguments.output or default).write_text(four_bar(arguments.windows), encoding="utf-8")


if __name__ == "__main__":
    main()
