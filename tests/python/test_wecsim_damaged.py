"""Damaged or hostile input files, models and tables of WEC-Sim: one error, little memory."""

from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat
from tests.python.test_wecsim_controls import WAVES
from tests.python.wecsim_files import append, left_out, write_one_body

from hydrodae.errors import CaseError
from hydrodae.wecsim import archive, convert
from hydrodae.wecsim.m_file import read_input
from hydrodae.wecsim.slx import read_slx


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("(" * 5000 + "1" + ")" * 5000, "nested too deeply"),
        ("-" * 5000 + "1", "nested too deeply"),
        ("0:1e-9:1e9", "an array of 1e+18 numbers"),
        ("1:Inf", "an array of inf numbers"),
        ("ones(1e5)", "an array of 1e+10 numbers"),
        ("linspace(0,1,1e9)", "an array of 1e+09 numbers"),
        ("diag(1:1e5)", "an array of 1e+10 numbers"),
        ("(1:1e5)'*(1:1e5)", "an array of 1e+10 numbers"),
        ("(1:1e5)'+(1:1e5)", "an array of 1e+10 numbers"),
        ("(-8)^(1/3)", "complex"),
        ("sqrt(-1)", "complex"),
        ("[1 2; 3 4]^2", "'^' of matrices"),
        ("sqrt('a')", "a number is needed"),
        ("[1 2 3] + [1 2]", "do not fit"),
    ],
)
def test_an_expression_without_a_value_is_left_out(text: str, why: str, tmp_path: Path) -> None:
    file = tmp_path / "wecSimInputFile.m"
    file.write_text(f"simu = simulationClass();\nsimu.x = {text};\n")
    (remark,) = read_input(file).remarks.of("left out")
    assert remark.place == "wecSimInputFile.m:2"
    assert why in remark.text


@pytest.mark.parametrize(
    ("text", "value"), [("10^400", np.inf), ("1/0", np.inf), ("-(1 == 1)", -1.0), ("2^0.5", 2**0.5)]
)
def test_numbers_beyond_the_largest_are_infinite(text: str, value: float, tmp_path: Path) -> None:
    file = tmp_path / "wecSimInputFile.m"
    file.write_text(f"x = {text};\n")
    assert read_input(file).variables["x"].value == value


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("for i = 1:10000\nfor j = 1:10000\nk = 1;\nend\nend\n", "more than 100000 statements"),
        ("if 1\n" * 5000, "nested too deeply"),
    ],
)
def test_an_input_file_ends(text: str, why: str, tmp_path: Path) -> None:
    file = tmp_path / "wecSimInputFile.m"
    file.write_text(text)
    with pytest.raises(CaseError, match=why):
        read_input(file)


SUB = '<Block BlockType="SubSystem" Name="s" SID="{n}"><System{ref}>{inside}</System></Block>'


def model(path: Path, **systems: str) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        root = '<M><Model><System Ref="root"/></Model></M>'
        file.writestr("simulink/blockdiagram.xml", root)
        for name, text in systems.items():
            file.writestr(f"simulink/systems/{name}.xml", f"<System>{text}</System>")
    return path


def reference(name: str, number: int = 1) -> str:
    return SUB.format(n=number, ref=f' Ref="{name}"', inside="")


@pytest.mark.parametrize(
    ("systems", "why"),
    [
        ({"root": reference("root")}, "root.xml is referred to twice"),
        ({"root": reference("a") + reference("a", 2), "a": ""}, "a.xml is referred to twice"),
        ({"root": reference("absent")}, "no item named 'simulink/systems/absent.xml'"),
        ({"root": "<Block" * 9}, "its XML is damaged"),
        (
            {"root": '<Block SID="1"><System>' * 3000 + "</System></Block>" * 3000},
            "nested too deeply",
        ),
        ({"root": " " * (archive.LARGEST + 1)}, f"more than {archive.LARGEST} bytes of XML"),
    ],
)
def test_a_model_without_an_end_is_one_error(
    systems: dict[str, str], why: str, tmp_path: Path
) -> None:
    with pytest.raises(CaseError, match=f"model.slx: .*{why}"):
        read_slx(model(tmp_path / "model.slx", **systems))


@pytest.mark.parametrize("kind", ["sheet", "numbers", "damaged", "no struct"])
def test_a_table_of_conditions_that_cannot_be_read_is_left_out(tmp_path: Path, kind: str) -> None:
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(source, WAVES, "pto(1).damping = 1e5;")
    path = source / ("mcr.xlsx" if kind == "sheet" else "mcr.mat")
    if kind == "sheet":
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
            file.writestr("xl/worksheets/sheet1.xml", "<a>" + " " * archive.LARGEST + "</a>")
    elif kind == "no struct":
        savemat(path, {"mcr": np.eye(3)})
    else:
        names = np.array(["waves.height"], dtype=object)
        savemat(path, {"mcr": {"header": names, "cases": np.arange(20_000.0)[:, None] + 1.0}})
    if kind == "damaged":  # the size of the text in its cell: scipy reads beyond its memory
        data = bytearray(path.read_bytes())
        data[data.index(b"waves.height") - 3] = 130
        path.write_bytes(data)
    field = "mcrExcelFile" if kind == "sheet" else "mcrMatFile"
    append(source, f"simu.{field} = '{path.name}';\n")
    assert f"simu.{field}: '{path.name}' cannot be read" in left_out(convert(source, case))


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ("body(1).initial.displacement = [0 1];", "displacement: expected 3 numbers, got 2"),
        ("body(1).nonHydro = 0.5;", "nonHydro: expected a whole number, got 0.5"),
        ("body(1).mass = 10^400;", "its values make a case that is refused: .*'mass'"),
    ],
)
def test_values_that_no_case_can_have_are_one_error(change: str, why: str, tmp_path: Path) -> None:
    write_one_body(tmp_path / "source", WAVES, "pto(1).damping = 1e5;")
    append(tmp_path / "source", change + "\n")
    with pytest.raises(CaseError, match=f"wecSimInputFile.m.*{why}"):
        convert(tmp_path / "source", tmp_path / "case")
    assert not (tmp_path / "case").exists()
