"""The jumper of Lowe and Langley: at rest, with a top that moves, in waves."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.scenes import driven
from tests.verification.line_scenes import IDLE, case, line

import hydrodae


def test_a_jumper_with_bending_hangs_as_that_of_lowe_and_langley() -> None:
    """Published loads at rest: top (11.40, 45.71) kN, bottom (11.40, 24.04) kN, within 0.2 kN."""
    keys = (
        "point_a = [-100.0, 0.0, -55.0]\npoint_b = [0.0, 0.0, -5.0]\nlength = [170.0]\n"
        "segments = [68]\nmass = [165.0]\ndiameter = [0.396]\nstiffness = [5e8]\n"
        "bending_stiffness = [1.208e5]"
    )
    environment = "[environment]\nwater_density = 1000.0\nwater_depth = 100.0\ngravity = 9.807\n"
    simulation = hydrodae.Simulation(case(environment + IDLE + line(keys)))
    top, bottom = math.hypot(11400.0, 45710.0), math.hypot(11400.0, 24040.0)
    assert float(simulation.read("forces/line/tension")) == pytest.approx(top, abs=200.0)
    assert float(simulation.read("forces/line/tension_anchor")) == pytest.approx(bottom, abs=200.0)


JUMPER = (
    "length = [170.0]\nsegments = [{n}]\nmass = [165.0]\ndiameter = [0.396]\nstiffness = [5e8]\n"
    "bending_stiffness = [1.208e5]\ndrag = [1.0]\nadded_mass = [1.0]\ndamping_ratio = [0.5]"
)


def jumper(water: str, keys: str, end: float, n: int = 68, deeper: float = 0.0) -> hydrodae.Results:
    """The run of a jumper of Lowe and Langley, `deeper` [m] than theirs."""
    text = f"[environment]\nwater_density = 1000.0\nwater_depth = {100.0 + deeper}\n"
    text += f"gravity = 9.807\n{water}"
    ends = f"point_a = [-100.0, 0.0, {-55.0 - deeper}]\npoint_b = [0.0, 0.0, {-5.0 - deeper}]\n"
    forces = line(keys + ends + JUMPER.format(n=n))
    return hydrodae.run(case(text + forces, f"end_time = {end}\nrtol = 1e-3"))


def beside_lowe_and_langley(
    run: hydrodae.Results, reference: Path, number: int, start: float
) -> tuple[float, float]:
    """Largest difference of the tension at the top [kN]: as it is, and at the best shift of time
    by up to 0.1 s, a step of their table, which is read off a printed graph."""
    path = reference / "lines" / f"lowe_langley_case{number}.csv"
    theirs = np.loadtxt(path, delimiter=",", skiprows=1)
    theirs = theirs[theirs[:, 0] + start <= run.time[-1] - 0.1]
    ours = run["forces/line/tension"].values / 1e3
    differences = [
        float(np.abs(np.interp(theirs[:, 0] + start + by, run.time, ours) - theirs[:, 1]).max())
        for by in np.arange(-0.1, 0.101, 0.02)
    ]
    return differences[5], min(differences)


@pytest.mark.parametrize(
    ("number", "coordinate", "deeper", "n", "bar", "shifted_bar"),
    [
        (1, "surge", 20.0, 68, 0.5, 0.27),
        (2, "sway", 20.0, 68, 0.5, 0.23),
        (3, "heave", 0.0, 136, 0.7, 0.46),
    ],
)
def test_a_jumper_whose_top_moves_of_lowe_and_langley(
    reference: Path,
    number: int,
    coordinate: str,
    deeper: float,
    n: int,
    bar: float,
    shifted_bar: float,
) -> None:
    """10 m in 27 s [kN], of 11, 5 and 21 kN from least to most. Up and down, the top of 5 m comes
    out of the water and dips in again: there it takes twice their segments. All three graphs agree
    best if they are taken to be 0.1 s early."""
    at = [0.0, 0.0, -5.0 - deeper]
    moves = driven("top", coordinate, 1e6, at, amplitude=10.0, period=27.0, ramp=27.0)
    run = jumper(moves, 'body_b = "top"\n', 27.0 + 30.0, n, deeper)
    found, shifted = beside_lowe_and_langley(run, reference, number, 27.0)
    assert found < bar
    assert shifted < shifted_bar


@pytest.mark.parametrize(
    ("number", "heading", "phase", "ramp", "bar", "shifted_bar"),
    [
        (4, 0.0, 230.0, 10.0, 0.45, 0.45),
        (5, 45.0, 165.0, 20.0, 0.99, 0.46),
        (6, 90.0, 0.0, 10.0, 0.41, 0.41),
    ],
)
def test_a_jumper_in_waves_of_lowe_and_langley(
    reference: Path,
    number: int,
    heading: float,
    phase: float,
    ramp: float,
    bar: float,
    shifted_bar: float,
) -> None:
    """Tension at the top in regular waves of 5 m [kN], of 12 kN from least to most.

    Theirs is under water throughout, though its top is where the troughs are: here all is 4 m
    deeper, in waves that move the water as much there. They grow over one or two periods. Their
    phases were chosen in steps of 5 degrees, 0.14 s, to fit the graphs. Without the pressure of
    the waves along the line the range would be half of that.
    """
    deeper, k = 4.0, (2.0 * math.pi / 10.0) ** 2 / 9.807
    height = 10.0 * math.cosh(k * (100.0 + deeper)) / math.cosh(k * 100.0)
    waves = (
        f'[sea]\nramp = {ramp}\n[[wave]]\nname = "w"\ntype = "regular"\nheight = {height!r}\n'
        f"period = 10.0\nheading_deg = {heading}\nphase_deg = {-phase}\n"
    )
    run = jumper(waves + IDLE, "", ramp + 30.0, deeper=deeper)
    found, shifted = beside_lowe_and_langley(run, reference, number, ramp)
    assert found < bar
    assert shifted < shifted_bar
