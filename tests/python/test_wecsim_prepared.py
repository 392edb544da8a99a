"""Controllers of Simulink that wait to be written: prepared functions, and files of functions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.python.test_wecsim_controls import ACTUATED, WAVES, block, controller, motion, wire
from tests.python.wecsim_files import LIBRARIES, append, left_out, tables, write_one_body, write_slx

import hydrodae
from hydrodae.case.callbacks.files import read_functions
from hydrodae.commands import cli
from hydrodae.errors import CaseError
from hydrodae.wecsim import convert

UNKNOWN = (
    motion("velocity")
    + block(31, "TransferFcn", Numerator="[5]", Denominator="[1 2]")
    + block(32, "FromWorkspace", VariableName="waves.waveAmpTimeViz(:,[1,2])")
    + block(33, "Sum", Inputs="++")
    + wire("21#out:1", "31#in:1")
    + wire("31#out:1", "33#in:1")
    + wire("32#out:1", "33#in:2")
    + wire("33#out:1", "12#in:1")
)


def test_what_is_not_converted_is_prepared(tmp_path: Path, capsys) -> None:
    """The case runs with a load of zero; head, terminal and summary name it."""
    source, case = tmp_path / "source", tmp_path / "case"
    waves = (
        WAVES.replace("'regular'", "'irregular'")
        + " waves.spectrumType = 'PM'; waves.marker.location = [-5 0];"
    )
    write_one_body(source, waves, "pto(1).damping = 1e4;", controller(UNKNOWN), ACTUATED)
    assert cli.main(["new", str(case), "--from", "wecsim", str(source)]) == 0
    told = "force of pto(1) from Simulink is zero as yet: write pto1_actuator of functions.py"
    assert told in capsys.readouterr().out
    (law,) = tables(case)["controller"]
    assert law["inputs"] == [
        "joints/pto1/displacement",
        "joints/pto1/displacement_rate",
        "gauges/marker1/elevation",
    ]
    assert (
        "sweep power_matrix.toml --functions functions.py"
        in (case / "power_matrix.toml").read_text()
    )
    text = (case / "functions.py").read_text()
    assert "def pto1_actuator(t, pto1_displacement, pto1_displacement_rate, marker1_ele" in text
    assert "b10/b31 (TransferFcn): Numerator = [5]; Denominator = [1 2]; in:1 < 'b21'" in text
    command = ["run", str(case / "case.toml"), "--set", "solver.end_time=2"]
    assert cli.main([*command, "--functions", str(case / "functions.py")]) == 0
    assert told in " ".join(capsys.readouterr().out.split())
    assert any(told in line for line in tables(case)["missing"])
    text = text.replace("return 0.0", "return -3e4 * pto1_displacement_rate")
    (case / "functions.py").write_text(text)
    run = hydrodae.run(case / "case.toml", **read_functions(case / "functions.py"))
    work = [np.asarray(run[f"energy/work/{name}"])[-1] for name in ("pto1_actuator", "pto1")]
    assert work[0] == pytest.approx(3.0 * work[1], rel=1e-2)  # dampings 3e4 and 1e4


def test_an_actuated_joint_of_three_degrees_of_freedom(
    two_bodies: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Loads along surge, heave and pitch, each in the direction of WEC-Sim."""
    kind, case = "Floating (3DOF) Actuation Force", tmp_path / "case"
    monkeypatch.setitem(LIBRARIES, kind, f"WECSim_Lib_Constraints/{kind}")
    blocks = [
        ("Body", "Rigid Body", "body(1)"),
        ("World", "Global Reference Frame", "simu"),
        ("Held", kind, "constraint(1)"),
    ]
    write_slx(two_bodies / "model.slx", blocks, ["2r-3l", "3r-1r"])
    append(two_bodies, "waves = waveClass('noWave'); waves.period = 6;\n")
    converted = convert(two_bodies, case, accept=None)
    assert "force of constraint(1) from Simulink is zero as yet" in left_out(converted)
    found = tables(case)
    forces = [force["name"] for force in found["force"]]
    assert forces == ["constraint1_surge", "constraint1_heave", "constraint1_pitch"]
    moved = []
    for sign in (1.0, -1.0):
        loads = (3e5 * sign, -2e5 * sign, 5e6 * sign)
        run = hydrodae.run(
            case / "case.toml",
            controllers={"constraint1_actuator": lambda t, *inputs, loads=loads: loads},
            set={"solver.end_time": 0.5},
        )
        body = f"bodies/{found['body'][0]['name']}"
        moved.append([np.asarray(run[f"{body}/{c}"])[-1] for c in ("position", "rotation")])
    place, turn = (moved[0][k] - moved[1][k] for k in range(2))
    assert place[0] > 1e-3 > -1e-3 > place[2]
    assert turn[1] > 1e-3
    assert abs(place[1]) + abs(turn[0]) + abs(turn[2]) < 1e-9


@pytest.mark.parametrize(
    ("text", "why"),
    [
        (None, "no such file"),
        ("x = 1", "sets no dictionary of functions"),
        ("x = 1\nforces = [1]", "sets no dictionary of functions"),
        ("x = 1\ny = = 2", r"laws\.py:2: SyntaxError"),
        ("x = 1\n\n1 / 0", r"laws\.py:3: ZeroDivisionError"),
    ],
)
def test_a_file_of_functions_that_cannot_be_used(
    tmp_path: Path, text: str | None, why: str
) -> None:
    path = tmp_path / "laws.py"
    if text is not None:
        path.write_text(text)
    with pytest.raises(CaseError, match=why):
        read_functions(path)
