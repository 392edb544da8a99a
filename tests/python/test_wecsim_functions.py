"""Laws of Simulink that become Python."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.python.test_wecsim_columns import add_function
from tests.python.test_wecsim_controls import (
    ACTUATED,
    GAINS,
    PI,
    WAVES,
    block,
    controller,
    motion,
    wire,
)
from tests.python.wecsim_files import left_out, tables, write_one_body

import hydrodae
from hydrodae.case.callbacks.files import read_functions
from hydrodae.commands import cli
from hydrodae.wecsim import convert
from hydrodae.wecsim.m_python import head_of, python_lines
from hydrodae.wecsim.m_text import NotEvaluated

FRICTION = """function t = friction(vel, time, coulomb, width)
    %{ block comments
    %}
    w = -vel(5);   % about -y
    if (1 < time) && (time < 20) || w == 7
        t = coulomb' * tanh(w/width) ...
            + 2e-1*w.^2*sign(w) - min(abs(w), pi);
    elseif w > 3
        t = 0;
    else
        t = -w^2;
    end
end
"""


def translated(script: str, vectors: dict[str, dict[int, str]], *known: str):
    """The function of Python of a script."""
    lines = python_lines(script, known, vectors)
    arguments = [*known, *(x for elements in vectors.values() for x in elements.values())]
    text = "\n".join([f"def law({', '.join(arguments)}):", *(f"    {x}" for x in lines)])
    names = {"math": math, "sign": np.sign}
    exec(f"{text}\n    return {head_of(script)[0]}", names)
    return names["law"]


@pytest.mark.parametrize(
    ("time", "rate", "expected"),
    [
        (5.0, 0.3, 4.0 * math.tanh(-0.6) - 0.2 * 0.09 - 0.3),
        (5.0, -4.0, 4.0 * math.tanh(8.0) + 0.2 * 16.0 - math.pi),
        (30.0, -4.0, 0.0),
        (30.0, -2.5, -6.25),
    ],
)
def test_a_matlab_function_becomes_python(time: float, rate: float, expected: float) -> None:
    """-w^2 is -(w^2) in both languages; the closed form is written by hand."""
    law = translated(FRICTION, {"vel": {5: "_rate"}}, "time", "coulomb", "width")
    assert law(time, 4.0, 0.5, rate) == pytest.approx(expected)


@pytest.mark.parametrize(
    "statement",
    [
        "y = x(3)",
        "y = [x 1]",
        "y = 1 < x < 2",
        "y = x^2^3",
        "y(2) = x",
        "y = unknown*x",
        "y = besselj(0, x)",
        "for i = 1:3, y = x; end",
        "y = ~x",
        "persistent n",
    ],
)
def test_what_is_no_plain_arithmetic_is_refused(statement: str) -> None:
    with pytest.raises(NotEvaluated, match="MATLAB function"):
        python_lines(f"function y = f(x)\n{statement};\nend", ["x"], {})


SATURATED = PI.replace(wire("33#out:1", "12#in:1"), "") + (
    block(34, "Saturate", LowerLimit="-3e4", UpperLimit="5e4")
    + wire("33#out:1", "34#in:1")
    + wire("34#out:1", "12#in:1")
)
TABLE = (
    motion("velocity")
    + block(31, "Lookup_n-D", BreakpointsForDimension1="[-1 0 2]", Table="[7 0 -4]*1e3")
    + wire("21#out:1", "31#in:1")
    + wire("31#out:1", "12#in:1")
)
PID = (
    motion("velocity")
    + block(31, "PID Controller", Controller="PI", P="-2e5", I="-3e4", D="9")
    + wire("21#out:1", "31#in:1")
    + wire("31#out:1", "12#in:1")
)


@pytest.mark.parametrize(
    ("blocks", "law"),
    [
        (SATURATED, lambda s, v: np.clip(-2e5 * v - 3e4 * s, -3e4, 5e4)),
        (TABLE, lambda s, v: np.interp(v, [-1.0, 0.0, 2.0], [7e3, 0.0, -4e3])),
        (PI.replace("-controller(1)", "controller(1)"), lambda s, v: 2e5 * v - 3e4 * s),
    ],
)
def test_blocks_without_memory_become_python(tmp_path: Path, blocks: str, law) -> None:
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(source, WAVES, GAINS.format(ki=3e4), controller(blocks), ACTUATED)
    converted = convert(source, case)
    assert left_out(converted) == ""
    given = read_functions(case / "functions.py")["forces"]
    for s, v in ((0.1, 0.2), (-0.3, -0.9), (0.5, 1.9), (0.0, 0.0)):
        assert given["pto1_actuator"](0.0, s, v) == pytest.approx(law(s, v))
    names = {force["name"]: force["type"] for force in tables(case)["force"]}
    assert names == {"pto1_actuator": "python_load", "pto1": "pto_linear"}


def test_a_pi_of_the_velocity_is_a_damper_and_a_spring(tmp_path: Path) -> None:
    write_one_body(tmp_path / "source", WAVES, "", controller(PID), ACTUATED)
    assert left_out(convert(tmp_path / "source", tmp_path / "case")) == ""
    (force,) = tables(tmp_path / "case")["force"]
    assert (force["damping"], force["stiffness"]) == (2e5, 3e4)


def test_a_function_of_matlab_runs_with_the_case(tmp_path: Path, capsys) -> None:
    """A drag by a power, with its number in the mask: the command line runs what it wrote."""
    script = "function F = drag(vel, c)\nF = -c*vel(3)*abs(vel(3));\nend"
    mask = "<Mask><MaskParameter Name='c'><Value>2e4</Value></MaskParameter></Mask>"
    port = f"<System>{block('40::1', 'Inport', Port='1').replace('b40::1', 'vel')}</System>"
    blocks = motion("velocity") + wire("13#out:1", "40#in:1") + wire("40#out:1", "12#in:1")
    blocks += block(40, "SubSystem", mask + port, SFBlockType="MATLAB Function")
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(source, WAVES, "pto(1).damping = 0;", controller(blocks), ACTUATED)
    add_function(source / "one.slx", script, "b10/b40")
    assert cli.main(["new", str(case), "--from", "wecsim", str(source)]) == 0
    assert f"next: hydrodae run {case}/case.toml --functions {case}/functions.py" in (
        capsys.readouterr().out
    )
    law = read_functions(case / "functions.py")["forces"]["pto1_actuator"]
    assert law(0.0, 9.0, -1.5) == pytest.approx(2e4 * 1.5**2)
    command = ["run", str(case / "case.toml"), "--set", "solver.end_time=30"]
    assert cli.main(command) == 2
    assert "--functions FILE.py" in capsys.readouterr().err
    assert cli.main([*command, "--functions", str(case / "functions.py")]) == 0
    results = hydrodae.Results.read(case / "case.h5")
    v = np.asarray(results["joints/pto1/displacement_rate"])
    expected = -2e4 * v * np.abs(v)
    assert np.abs(np.asarray(results["forces/pto1_actuator/force"]) - expected).max() < 1e-6
