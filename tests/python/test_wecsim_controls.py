"""Controllers in Simulink, runs of many conditions, markers and Morison elements of WEC-Sim."""

from __future__ import annotations

import tomllib
import zipfile
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat
from tests.python.wecsim_files import append, left_out, tables, write_one_body

import hydrodae
from hydrodae.wecsim import convert

ACTUATED = "Translational PTO Actuation Force"
WAVES = "waves = waveClass('regular'); waves.height = 1; waves.period = 6;"


def block(number: int | str, kind: str, inside: str = "", **parameters: str) -> str:
    """XML of a block of Simulink."""
    text = "".join(f'<P Name="{name}">{value}</P>' for name, value in parameters.items())
    return f'<Block BlockType="{kind}" Name="b{number}" SID="{number}">{text}{inside}</Block>'


def wire(source: str, *targets: str) -> str:
    """XML of a signal from "1#out:1" to "2#in:1"."""
    ends = "".join(f'<Branch><P Name="Dst">{target}</P></Branch>' for target in targets)
    return f'<Line><P Name="Src">{source}</P>{ends}</Line>'


def controller(blocks: str) -> str:
    """A subsystem 10 between the response of block 3 and its force."""
    inside = f"<System>{block(11, 'Inport')}{block(12, 'Outport')}{blocks}</System>"
    subsystem = block(10, "SubSystem", inside)
    return subsystem + wire("3#out:1", "10#in:1") + wire("10#out:1", "3#in:1")


def motion(*signals: str) -> str:
    """Blocks 13 (bus) and 21, 22, ... (selectors of z) for signals of the response."""
    text = block(13, "BusSelector", OutputSignals=",".join(signals)) + wire("11#out:1", "13#in:1")
    for number in range(1, len(signals) + 1):
        text += block(20 + number, "Selector", Indices="3")
        text += wire(f"13#out:{number}", f"{20 + number}#in:1")
    return text


PI = (
    motion("velocity", "position")
    + block(31, "Gain", Gain="-controller(1).pi.Kp")
    + block(32, "Gain", Gain="controller.pi.Ki")
    + block(33, "Sum", Inputs="|+-")
    + wire("21#out:1", "31#in:1")
    + wire("22#out:1", "32#in:1")
    + wire("31#out:1", "33#in:1")
    + wire("32#out:1", "33#in:2")
    + wire("33#out:1", "12#in:1")
)
GAINS = "pto(1).damping = 1e4; controller(1).pi.Kp = 2e5; controller(1).pi.Ki = {ki};"


@pytest.mark.parametrize(("ki", "kind"), [(3e4, "pto_linear"), (-3e4, "pto_general")])
def test_a_linear_controller_is_a_spring_and_a_damper(tmp_path: Path, ki: float, kind: str) -> None:
    """F = -Kp s' - Ki s, added to the damping of the take-off itself."""
    write_one_body(tmp_path / "source", WAVES, GAINS.format(ki=ki), controller(PI), ACTUATED)
    assert left_out(convert(tmp_path / "source", tmp_path / "case")) == ""
    (force,) = tables(tmp_path / "case")["force"]
    assert (force["type"], force["damping"], force["stiffness"]) == (kind, 2.1e5, ki)


def test_a_controller_that_is_not_understood_is_zero_and_named(tmp_path: Path) -> None:
    for name, old, new in (
        ("TransferFcn", '"Sum"', '"TransferFcn"'),
        ("takes another component", '"Indices">3', '"Indices">1'),
        ("no_such", "controller.pi.Ki", "no_such"),
    ):
        source, case = tmp_path / f"source {name}", tmp_path / f"case {name}"
        signals = controller(PI).replace(old, new)
        write_one_body(source, WAVES, GAINS.format(ki=1.0), signals, ACTUATED)
        remarks = left_out(convert(source, case))
        assert "block 'PTO': force of pto(1) from Simulink is zero as yet" in remarks
        assert name in remarks
        assert [force["damping"] for force in tables(case)["force"]] == [1e4, 0.0]


def switching(inputs: str, constants: dict[int, str]) -> str:
    """A MATLAB function 40 with these inputs, of which the first is the velocity."""
    ports = "".join(
        f'<Block BlockType="Inport" Name="{name} " SID="40::{number}"><P Name="Port">{number}</P>'
        "</Block>"
        for number, name in enumerate(inputs.split(), 1)
    )
    text = motion("velocity")
    text += block(40, "SubSystem", f"<System>{ports}</System>", SFBlockType="MATLAB Function")
    for number, value in constants.items():
        text += block(50 + number, "Constant", Value=value)
        text += wire(f"{50 + number}#out:1", f"40#in:{number}")
    return controller(text + wire("21#out:1", "40#in:1") + wire("40#out:1", "12#in:1"))


def test_declutching_becomes_a_controller(tmp_path: Path) -> None:
    names = "vel tDeclutch tNormal velPrev declutchTime dt Kp"
    signals = switching(names, {5: "controller.d.time", 7: "controller.d.Kp"})
    pto = "pto(1).damping = 5e3; controller(1).d.time = 0.8; controller(1).d.Kp = 2e5;"
    write_one_body(tmp_path / "source", WAVES, pto, signals, ACTUATED)
    assert left_out(convert(tmp_path / "source", tmp_path / "case")) == ""
    (law,) = tables(tmp_path / "case")["controller"]
    assert (law["type"], law["engaged"], law["free"], law["free_time"]) == (
        "declutching",
        2.05e5,
        5e3,
        0.8,
    )
    results = hydrodae.run(tmp_path / "case" / "case.toml", set={"solver.end_time": 80.0})
    held = np.asarray(results["controllers/pto1_declutching/output"]).ravel()
    assert set(np.unique(held)) == {5e3, 2.05e5}


def test_latching_holds_the_joint(tmp_path: Path) -> None:
    """Held for the time of the input file from each standstill on."""
    names = "vel tLatch tNormal velPrev latchTime dt Kp forceCoeff"
    signals = switching(names, {5: "controller.l.time", 7: "5e4", 8: "1e7"})
    pto = "pto(1).damping = 0; controller(1).l.time = 1.2;"
    write_one_body(tmp_path / "source", WAVES, pto, signals, ACTUATED)
    assert left_out(convert(tmp_path / "source", tmp_path / "case")) == ""
    results = hydrodae.run(tmp_path / "case" / "case.toml", set={"solver.end_time": 80.0})
    time = np.asarray(results.time)
    rate = np.asarray(results["joints/pto1/displacement_rate"]).ravel()
    still = np.abs(rate[time > 30.0]) < 1e-9
    # twice in each of some eight periods of 6 s
    assert still.mean() == pytest.approx(2.0 * 1.2 / 6.0, rel=0.1)


def study(case: Path) -> dict:
    return dict(tomllib.loads((case / "conditions.toml").read_text())["list"])


def test_several_values_are_conditions_of_a_study(tmp_path: Path) -> None:
    """Periods vary fastest, then heights, then take-offs: the order of WEC-Sim."""
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(
        source,
        "waves = waveClass('regular'); waves.height = [1 2]; waves.period = [5 6];",
        "pto(1).damping = [1e5 2e5];",
    )
    assert left_out(convert(source, case)) == ""
    found = study(case)
    assert found["wave.waves.period"] == [5.0, 6.0] * 4
    assert found["wave.waves.height"] == [1.0, 1.0, 2.0, 2.0] * 2
    assert found["force.pto1.damping"] == [1e5] * 4 + [2e5] * 4
    np.testing.assert_allclose(found["hydro.frequency"], 2 * np.pi / np.array([5, 6] * 4))
    assert tables(case)["wave"][0]["period"] == 5.0
    done = hydrodae.sweep(case / "conditions.toml", tmp_path / "out.nc", jobs=1)
    assert (done["status"] == "completed").all()


@pytest.mark.parametrize("made", ["mat", "script"])
def test_conditions_of_a_table(tmp_path: Path, made: str) -> None:
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(source, WAVES, GAINS.format(ki=1e4), controller(PI), ACTUATED)
    append(source, "simu.mcrMatFile = 'mcrCases.mat';\n")
    if made == "mat":
        header = np.array(["controller(1).pi.Kp", "pto(1).damping"], dtype=object)
        cases = np.array([[1e5, 0.0], [3e5, 5e4]])
        savemat(source / "mcrCases.mat", {"mcr": {"header": header, "cases": cases}})
    else:
        (source / "build.m").write_text(
            "clear all; mcr = struct();\n"
            'mcr.header = ["controller(1).pi.Kp","pto(1).damping"];\n'
            "Kp = [1e5 3e5]; x = [];\nfor i = 1:2\n  x = [x; Kp(i) 5e4*(i-1)];\nend\n"
            "mcr.cases = x;\nsave mcrCases mcr\n"
        )
    assert left_out(convert(source, case)) == ""
    assert study(case) == {"force.pto1.damping": [1e5, 3.5e5]}
    assert tables(case)["force"][0]["damping"] == 2.1e5  # of the input file


def test_conditions_of_a_sheet(tmp_path: Path) -> None:
    """Sea states whose hours are above zero."""
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(source, "waves = waveClass('regularCIC');", "pto(1).damping = 1e5;")
    append(source, "simu.mcrExcelFile = 'states.xlsx';\n")
    cells = {"B1": 5, "C1": 6, "A2": 1, "B2": 0, "C2": 3, "A3": 2, "B3": 4, "C3": 1}
    space = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
    text = "".join(f'<c r="{name}"><v>{value}</v></c>' for name, value in cells.items())
    sheet = f'<worksheet xmlns="{space}"><sheetData><row>{text}</row></sheetData></worksheet>'
    with zipfile.ZipFile(source / "states.xlsx", "w") as archive:
        archive.writestr("xl/worksheets/sheet1.xml", sheet)
    assert left_out(convert(source, case)) == ""
    assert study(case) == {
        "wave.waves.height": [1.0, 2.0, 2.0],
        "wave.waves.period": [6.0, 5.0, 6.0],
    }


def test_a_table_of_conditions_that_is_missing_is_left_out(tmp_path: Path) -> None:
    source = tmp_path / "source"
    write_one_body(source, WAVES, "pto(1).damping = 1e5;")
    append(source, "simu.mcrMatFile = 'absent.mat';\n")
    assert "simu.mcrMatFile: 'absent.mat' cannot be read" in left_out(
        convert(source, tmp_path / "case")
    )
    assert not (tmp_path / "case" / "conditions.toml").exists()


@pytest.mark.parametrize(
    ("header", "cases", "why"),
    [
        (["extra", "waves.period"], [[1.0, 5.0], [2.0, 6.0]], "nothing in the case depends on ext"),
        (["waves.period"], [[[5.0, 6.0]], [[6.0, 7.0]]], "its cases hold arrays"),
    ],
)
def test_conditions_that_the_case_cannot_have_are_left_out(
    tmp_path: Path, header: list[str], cases: list, why: str
) -> None:
    source = tmp_path / "source"
    write_one_body(source, WAVES, "pto(1).damping = 1e5;")
    append(source, "simu.mcrMatFile = 'mcr.mat';\n")
    cells = np.empty((2, len(header)), dtype=object)
    for row, values in enumerate(cases):
        for column, value in enumerate(values):
            cells[row, column] = np.array(value)
    savemat(source / "mcr.mat", {"mcr": {"header": np.array(header, dtype=object), "cases": cells}})
    assert why in left_out(convert(source, tmp_path / "case"))


def test_markers_become_gauges_with_the_elevation_there(tmp_path: Path) -> None:
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(
        source, WAVES + " waves.marker.location = [0 0; 12 -3];", "pto(1).damping = 1e5;"
    )
    assert left_out(convert(source, case)) == ""
    assert [gauge["point"] for gauge in tables(case)["gauge"]] == [[0.0, 0.0], [12.0, -3.0]]
    results = hydrodae.run(case / "case.toml", set={"solver.end_time": 90.0})
    database = hydrodae.hdb.read(case / "hydro.h5")
    omega = 2.0 * np.pi / 6.0
    number = omega**2 / database.gravity
    for _ in range(100):
        water = np.tanh(min(number * database.water_depth, 50.0))
        number = 0.5 * (number + omega**2 / (database.gravity * water))
    time = np.asarray(results.time)
    last = time > 70.0
    elevation = np.asarray(results["gauges/marker2/elevation"]).ravel()[last]
    airy = 0.5 * np.cos(omega * time[last] - number * 12.0)
    np.testing.assert_allclose(elevation, airy, atol=1e-6)


def test_a_morison_element_with_drag_along_z_only(tmp_path: Path) -> None:
    """Of a decay without radiation: |F| = rho Cd A s'^2 / 2 along z, none along x."""
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(source, WAVES, "pto(1).damping = 1e5;")
    append(
        source,
        "body(1).morisonElement.option = 1; body(1).morisonElement.cd = [0 0 2];\n"
        "body(1).morisonElement.ca = [0 0 0]; body(1).morisonElement.area = [0 0 7];\n"
        "body(1).morisonElement.VME = 0; body(1).morisonElement.rgME = [0 0 -1e4];\n",
    )
    assert left_out(convert(source, case)) == ""
    results = hydrodae.run(case / "case.toml", set={"solver.end_time": 90.0})
    (name,) = [n for n in results if "morison1_z" in n and n.endswith("/force")]
    force = np.asarray(results[name])
    rate = np.asarray(results["joints/pto1/displacement_rate"]).ravel()
    expected = -0.5 * 1025.0 * 2.0 * 7.0 * np.abs(rate) * rate  # deep below the waves
    np.testing.assert_allclose(force[:, 2], expected, atol=1e-6 * np.abs(expected).max())
    assert np.abs(force[:, :2]).max() < 1e-9


def test_a_spectrum_with_phases_is_a_sea_of_its_components(tmp_path: Path) -> None:
    """Of sqrt(2 S df) cos(2 pi f t + phase); outside the database, and rows of zeros: nothing."""
    source, case = tmp_path / "source", tmp_path / "case"
    write_one_body(source, "waves = waveClass('spectrumImport'); waves.spectrumFile = 's.mat';", "")
    band = hydrodae.hdb.read(next(source.rglob("*.h5"))).omega[[0, -1]] / (2.0 * np.pi)
    rates = np.linspace(band[0] + 0.01, band[0] + 0.09, 5)
    rows = [(f, s, p) for f, s, p in zip(rates, (0.0, 2.0, 5.0, 1.0, 0.0), range(5), strict=True)]
    savemat(source / "s.mat", {"s": np.array([*rows, (2.0 * band[1], 1.0, 0.5), (0.0, 0.0, 0.0)])})
    remarks = convert(source, case).remarks
    assert [str(r) for r in remarks.of("left out")] == []
    assert any("1 frequencies are outside" in r.text for r in remarks.of("assumed"))
    waves = tables(case)["wave"]
    assert [1.0 / wave["period"] for wave in waves] == pytest.approx(rates[1:4])
    sizes = np.sqrt(2.0 * np.array([2.0, 5.0, 1.0]) * 0.02)
    assert [0.5 * wave["height"] for wave in waves] == pytest.approx(sizes)
    assert [wave["phase_deg"] % 360.0 for wave in waves] == pytest.approx(np.degrees([1, 2, 3]))
