"""Scripts, .mat files, switch blocks and variables that input files of WEC-Sim rely on."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat
from tests.python.wecsim_files import append, left_out, tables, write_one_body

from hydrodae.commands.cli import main
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.wecsim import convert
from hydrodae.wecsim.m_file import read_input

WAVES = "waves = waveClass('regular'); waves.height = 1; waves.period = 6;"


def read(folder: Path, text: str):
    file = folder / "wecSimInputFile.m"
    file.write_text("simu = simulationClass();\n" + text)
    return read_input(file)


def test_a_script_is_carried_out_and_its_faults_have_its_lines(tmp_path: Path) -> None:
    (tmp_path / "setup.m").write_text("% gains\ngain = 2;\nsimu.rampTime = clock();\n")
    (tmp_path / "law.m").write_text("function y = law(x)\ny = x;\nend\n")
    found = read(tmp_path, "setup\nsimu.dt = gain/10;\nlaw;\n")
    simu = found.get("simu")
    assert simu is not None
    assert simu.get("dt") == 0.2
    assert [r.place for r in found.remarks.of("left out")] == ["setup.m:3", "wecSimInputFile.m:4"]


def test_a_script_that_calls_itself_ends(tmp_path: Path) -> None:
    (tmp_path / "again.m").write_text("again\n")
    (remark,) = read(tmp_path, "again\n").remarks.of("left out")
    assert "more than 10 scripts within each other" in remark.text


@pytest.mark.parametrize(
    "statement", ["load('device')", "load device.mat", "s = load('device.mat');"]
)
def test_masses_come_from_structures_of_mat_files(tmp_path: Path, statement: str) -> None:
    savemat(tmp_path / "device.mat", {"float": {"mass": 5.0, "inertia": [1.0, 2.0, 3.0]}})
    before = "s." if statement.startswith("s") else ""
    body = f"body(1) = bodyClass(''); body(1).mass = {before}float.mass;"
    found = read(tmp_path, f"{statement}\n{body} body(1).inertia = {before}float.inertia;\n")
    assert found.remarks.items == []
    item = found.get("body")
    assert item is not None
    assert item.get("mass") == 5.0
    assert item.vector("inertia", []).tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("value", "result"), [("2", 20.0), ("5", 30.0), ("'PM'", 40.0), ("9", 50.0), ("[1 2]", 50.0)]
)
def test_the_case_of_a_switch_block_is_carried_out(
    tmp_path: Path, value: str, result: float
) -> None:
    text = """
switch(kind)
    case 1 ; x = 10; switch x
        case 10
            x = 11;
        otherwise
            x = 12;
        end
    case 2 ; x = 20;
    case { 4, 5 }
        x = 30;
    case 'PM'
        x = 40;
    otherwise
        x = 50;
end
simu.dt = x;
"""
    found = read(tmp_path, f"kind = {value};\n{text}")
    assert found.remarks.items == []
    assert found.variables["x"].value == result


def test_a_variable_without_a_value_is_named_where_it_is_used(tmp_path: Path) -> None:
    """Its old value must not stand in: MATLAB has another one there."""
    text = "a = 1; b = 2; c = [1 2];\na = f(3);\nb = f(3);\nc(2) = f(1);\nc(1) = 4;\n"
    found = read(tmp_path, text + "simu.dt = a;\nsimu.rampTime = c(1);\nb = 6; simu.endTime = b;\n")
    told = {
        kind: [r.place.partition(":")[2] for r in found.remarks.of(kind)]
        for kind in ("not needed", "left out")
    }
    assert told == {"not needed": ["3", "4", "5", "6"], "left out": ["7", "8"]}
    simu = found.get("simu")
    assert simu is not None
    assert (simu.get("endTime"), simu.get("dt"), simu.get("rampTime")) == (6.0, None, None)


@pytest.mark.parametrize(
    ("text", "kind"), [("x(1,:) = f(1);", "not needed"), ("x{1} = f(1);", "left out")]
)
def test_an_element_without_a_value_is_named(tmp_path: Path, text: str, kind: str) -> None:
    (remark,) = read(tmp_path, f"x = [1 2];\n{text}\n").remarks.items
    assert (remark.kind, remark.place) == (kind, "wecSimInputFile.m:3")


def test_variables_of_a_script_of_the_user_are_defined(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(source, WAVES, "if strong == 1 && kind == 'a'\npto(1).damping = 3e4;\nend\n")
    with pytest.raises(CaseError, match=r"no pto .*--define NAME=VALUE sets a variable"):
        convert(source, case)
    given = ["--define", "strong=2-1", "--define", "kind='a'"]
    assert main(["new", str(case), "--from", "wecsim", str(source), *given]) == 0
    assert "not in the case: nothing" in capsys.readouterr().out
    assert tables(case)["force"][0]["damping"] == 3e4
    for wrong, why in (("strong", "expected NAME=VALUE"), ("x=no_such", "not known here; write")):
        options = ["--from", "wecsim", str(source), "--define", wrong]
        assert main(["new", str(tmp_path / "other"), *options]) != 0
        assert why in capsys.readouterr().err


def test_what_the_database_overwrites_is_named(tmp_path: Path) -> None:
    write_one_body(tmp_path / "source", WAVES, "pto(1).damping = 1e4;")
    more = "body(1).centerBuoyancy = [0 0 -1];\npto(1).hardStops.upperLimitTransitionRegion = 1;\n"
    append(tmp_path / "source", more + "waves.phaseSeed = 3.3;\n")
    converted = convert(tmp_path / "source", tmp_path / "case")
    assert left_out(converted) == ""
    text = "body(1).centerBuoyancy is that of buoy in the database, as in WEC-Sim"
    assert text in [r.text for r in converted.remarks.of("assumed")]
    assert "which has hardStops.upperLimitTransitionRegionWidth" in str(
        converted.remarks.of("not needed")
    )
    assert np.isclose(tables(tmp_path / "case")["force"][0]["damping"], 1e4)


def test_the_comment_of_the_radiation_says_what_stands_below_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise DatabaseError("no good fit")

    monkeypatch.setattr("hydrodae.wecsim.hydro.fit", refuse)
    waves = WAVES.replace("regular", "regularCIC")
    write_one_body(tmp_path / "source", waves, "pto(1).damping = 1e4;")
    lines = convert(tmp_path / "source", tmp_path / "case").case.read_text().splitlines()
    above = lines[lines.index("[hydro]") - 1]
    assert above == "# regularCIC: convolution, since no fit was good enough."
    assert 'radiation = "convolution"' in lines
