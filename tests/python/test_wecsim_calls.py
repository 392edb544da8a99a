"""Functions of MATLAB beside input files, and bodies with several databases."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.python.wecsim_files import append, left_out, tables

from hydrodae.errors import CaseError
from hydrodae.wecsim import convert
from hydrodae.wecsim.m_file import read_input

FILES = """
if ~exist('directions','var')
    directions = -1:0.25:1;
end
theta = wrapTo360(directions);
files = strcat('hydro_', arrayfun(@num2str, theta, 'UniformOutput', 0), '.h5');
start = find(directions==0.5);
[~, near] = min(abs(directions - 0.6));
same = isequal('regular', 'regular');
back = wrapTo180(theta);
called = nearest(0.3, directions);
"""
NEAREST = """function index = nearest(x, at)
% [~, index] = max(x)
[~, index] = min(abs(at - x));
if index > 6
    index = 6;
end
end
"""


def test_functions_that_build_the_names_of_databases(tmp_path: Path) -> None:
    (tmp_path / "wecSimInputFile.m").write_text(FILES)
    (tmp_path / "nearest.m").write_text(NEAREST)
    read = read_input(tmp_path / "wecSimInputFile.m")
    found = {name: entry.value for name, entry in read.variables.items()}
    assert not read.remarks.items
    assert [found[name] for name in ("start", "near", "same", "called")] == [7.0, 7.0, 1.0, 6.0]
    assert found["files"][:2] == ["hydro_359.h5", "hydro_359.25.h5"]
    assert found["files"][-1] == "hydro_1.h5"
    np.testing.assert_allclose(found["back"], found["directions"])
    defined = read_input(tmp_path / "wecSimInputFile.m", {"directions": "[0 0.5]"})
    assert defined.variables["start"].value == 2.0


LOGICAL = """
a = exist('x','var') && isequal(x, [1 2; 3 4]) && -x(3) > unknown(2).field;
b = ~exist('x','var') || x.part == 'one' || [1:x, @x];
if exist('x','var') && x > 2
    c = 1;
else
    c = 2;
end
d = 1 || 0 && x;
e = 0 && 1 | 1;
f = 1 && isequal(2, 2);
g = 0 || 1 & 0;
h = (0 && x) == 0;
k = [0 && 0/0, 3];
"""


def test_logical_operators_evaluate_what_decides(tmp_path: Path) -> None:
    """As MATLAB: && and || leave out their right operands; | binds before &&, & before |."""
    (tmp_path / "wecSimInputFile.m").write_text(LOGICAL)
    read = read_input(tmp_path / "wecSimInputFile.m")
    assert not read.remarks.items
    found = {name: entry.value for name, entry in read.variables.items()}
    np.testing.assert_array_equal(np.ravel(found.pop("k")), [0.0, 3.0])
    expected = {"a": 0, "b": 1, "c": 2, "d": 1, "e": 0, "f": 1, "g": 0, "h": 1}
    assert found == expected
    with (tmp_path / "wecSimInputFile.m").open("a") as file:
        file.write("m = 1 && x;\n")
    assert [str(item) for item in read_input(tmp_path / "wecSimInputFile.m").remarks.items]


def test_a_function_that_is_not_understood_has_no_value(tmp_path: Path) -> None:
    (tmp_path / "wecSimInputFile.m").write_text(
        "directions = 1:3; called = nearest(2, directions);"
    )
    (tmp_path / "nearest.m").write_text(NEAREST.replace("index > 6", "unknown > 6"))
    read = read_input(tmp_path / "wecSimInputFile.m")
    assert "called" not in read.variables
    assert "nearest.m:4" in str(read.remarks.items[0])


@pytest.mark.parametrize("option", [0, 1])
def test_a_body_with_several_databases_starts_with_that_of_its_index(
    two_bodies: Path,
    tmp_path: Path,
    option: int,
) -> None:
    text = (two_bodies / "wecSimInputFile.m").read_text()
    name = "'hydroData/device.h5'"
    several = text.replace(f"bodyClass({name})", f"bodyClass({{'none.h5', {name}}})", 1)
    (two_bodies / "wecSimInputFile.m").write_text(several)
    append(two_bodies, f"body(1).variableHydro.option = {option};\n")
    append(two_bodies, "body(1).variableHydro.hydroForceIndexInitial = 2;\n")
    converted = convert(two_bodies, tmp_path / "case")
    assert ("body(1): variable hydrodynamics" in left_out(converted)) == bool(option)
    assert [body["hydro"] for body in tables(tmp_path / "case")["body"]]
    append(two_bodies, "body(1).variableHydro.hydroForceIndexInitial = 3;\n")
    with pytest.raises(CaseError, match=r"is 3, but the body has 2 databases"):
        convert(two_bodies, tmp_path / "other")


def test_a_function_that_calls_itself_has_no_value(tmp_path: Path) -> None:
    (tmp_path / "wecSimInputFile.m").write_text("called = again(2);\n")
    (tmp_path / "again.m").write_text("function y = again(n)\ny = again(n - 1);\nend\n")
    read = read_input(tmp_path / "wecSimInputFile.m")
    assert "called" not in read.variables
    assert "again calls itself" in str(read.remarks.items[0])
