"""Input files of WEC-Sim: expressions, statements, names of other versions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from hydrodae.wecsim.m_file import read_input


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2*pi/8", np.pi / 4),
        ("[1 -2]", [1, -2]),
        ("[1 - 2]", [-1]),
        ("[1, 2; 3 4]", [1, 2, 3, 4]),
        ("[1 2\n 3 4]'", [1, 3, 2, 4]),
        ("-2^2", -4),
        ("30*pi/180 % degrees", np.pi / 6),
        ("sind(30)", 0.5),
        ("0:0.5:1", [0, 0.5, 1]),
        ("diag([1 2])", [1, 0, 0, 2]),
        ("2*eye(2)", [2, 0, 0, 2]),
        ("1e3*[1;2]", [1000, 2000]),
        ("zeros(1,2)", [0, 0]),
        ("a(2) + a(end_)", None),
        ("b.c/2", 3.5),
        ("a(1,2)", 20),
        ("5.", 5),
        ("-[1 2]+[3 4]", [2, 2]),
        ("reshape([1 2; 3 4],[],1)", [1, 3, 2, 4]),
        ("reshape(1:6,2,3)", [1, 3, 5, 2, 4, 6]),
        ("[[];3 4]", [3, 4]),
        ("length(a) + numel([1 2; 3 4])", 7),
    ],
)
def test_expressions_have_the_values_of_matlab(text: str, value, tmp_path: Path) -> None:
    file = tmp_path / "wecSimInputFile.m"
    file.write_text(f"a = [10 20 30]; b.c = 7;\nsimu = simulationClass();\nsimu.x = {text};\n")
    read = read_input(file)
    simu = read.get("simu")
    assert simu is not None
    if value is None:
        assert [r.place for r in read.remarks.of("left out")] == ["wecSimInputFile.m:3"]
    else:
        assert read.remarks.items == []
        np.testing.assert_allclose(np.ravel(simu.get("x")), np.ravel(value), atol=1e-14)


def test_statements_that_are_not_understood_are_listed_with_their_lines(tmp_path: Path) -> None:
    file = tmp_path / "wecSimInputFile.m"
    file.write_text(
        "%{\nsimu = broken\n%}\n"
        "simu = simulationClass();\n"
        "load('data.mat')\n"
        "if simu.rho == 1000\n  simu.dt = 0.2;\nelse\n  simu.dt = 0.3;\nend\n"
        "while simu.dt < 3\n  simu.dt = 3;\nend\n"
        "body(1).mass = someFunction(3);\n"
        "s = 'it''s % no comment';\n"
    )
    read = read_input(file)
    simu = read.get("simu")
    assert simu is not None
    assert simu.get("dt") == 0.2
    assert read.variables["s"].value == "it's % no comment"
    lines = [r.place.partition(":")[2] for r in read.remarks.of("left out")]
    assert lines == ["5", "11", "14"]


def test_names_of_version_4_are_read(tmp_path: Path) -> None:
    file = tmp_path / "wecSimInputFile.m"
    file.write_text(
        "pto(1) = ptoClass('PTO1');\npto(1).k = 3; pto(1).c = 4; pto(1).loc = [1 2 3];\n"
    )
    pto = read_input(file).get("pto")
    assert pto is not None
    assert pto.get("stiffness") == 3.0
    assert pto.get("damping") == 4.0
    assert pto.vector("location", []).tolist() == [1.0, 2.0, 3.0]


def test_markers_on_a_grid_are_read(tmp_path: Path) -> None:
    """MATLAB's meshgrid has x along rows; reshape goes down the columns."""
    file = tmp_path / "wecSimInputFile.m"
    file.write_text(
        "waves = waveClass('regular');\n"
        "[X,Y] = meshgrid(-2:2:2,[5 7]);\n"
        "waves.marker.location = [reshape(X,[],1),reshape(Y,[],1)];\nclear('X','Y')\n"
    )
    read = read_input(file)
    assert read.remarks.items == []
    waves = read.get("waves")
    assert waves is not None
    expected = [[-2, 5], [-2, 7], [0, 5], [0, 7], [2, 5], [2, 7]]
    np.testing.assert_array_equal(waves.get("marker.location"), expected)


def test_loops_are_carried_out(tmp_path: Path) -> None:
    file = tmp_path / "wecSimInputFile.m"
    file.write_text(
        "x = []; k = [1 10];\n"
        "for i = 1:3\n  for j = 1:length(k)\n    x = [x; i*k(j)];\n  end\nend\n"
        "controller(1).gain.Kp = 4; y = controller.gain.Kp;\n"
    )
    read = read_input(file)
    assert read.remarks.items == []
    np.testing.assert_array_equal(np.ravel(read.variables["x"].value), [1, 10, 2, 20, 3, 30])
    assert read.variables["y"].value == 4.0
