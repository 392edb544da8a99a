"""Runs of WEC-Sim become cases: input files, Simulink models and databases made here."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from tests.python.wecsim_files import (
    TWO_BODIES,
    TWO_BODY_INPUT,
    append,
    left_out,
    tables,
    write_database,
    write_one_body,
    write_slx,
)

import hydrodae
from hydrodae import hdb
from hydrodae.case.callbacks.files import read_functions
from hydrodae.commands import cli
from hydrodae.errors import CaseError
from hydrodae.wecsim import convert
from hydrodae.wecsim.slx import read_slx


def test_lines_of_a_model_join_ports_through_subsystems(tmp_path: Path) -> None:
    """The body stands in a subsystem whose one port is on its left."""
    path = tmp_path / "model.slx"
    body = '<Block BlockType="Reference" Name="Buoy" SID="7"><P Name="SourceBlock">'
    body += 'WECSim_Lib/Body Elements/Rigid Body</P><P Name="body">body(1)</P></Block>'
    port = '<Block BlockType="PMIOPort" Name="In" SID="8"><P Name="Side">Left</P></Block>'
    line = (
        '<Line LineType="Connection"><P Name="Src">7#rconn:1</P><P Name="Dst">8#rconn:1</P></Line>'
    )
    frame = '<Block BlockType="Reference" Name="Frame" SID="2"><P Name="SourceBlock">'
    frame += "WECSim_Lib/Frames/Global Reference Frame</P></Block>"
    gone = frame.replace("</Block>", '<P Name="Commented">on</P></Block>').replace('"2"', '"3"')
    outer = '<Block BlockType="SubSystem" Name="Sub" SID="1"><System>'
    outer += f"{body}{port}{line}</System></Block>"
    join = (
        '<Line LineType="Connection"><P Name="Src">1#lconn:1</P><P Name="Dst">2#rconn:1</P></Line>'
    )
    with zipfile.ZipFile(path, "w") as archive:
        text = f"<M><Model><System>{outer}{frame}{gone}{join}</System></Model></M>"
        archive.writestr("simulink/blockdiagram.xml", text)
    blocks = {block.name: block for block in read_slx(path).blocks}
    assert "Frame" in blocks
    assert len([b for b in blocks.values() if b.kind == "Global Reference Frame"]) == 1
    assert blocks["Sub/Buoy"].nets["rconn:1"] == blocks["Frame"].nets["rconn:1"]


def test_two_bodies_become_a_case(two_bodies: Path, tmp_path: Path) -> None:
    converted = convert(two_bodies, tmp_path / "case")
    assert left_out(converted) == ""
    found = tables(tmp_path / "case")
    bodies = {body["name"]: body for body in found["body"]}
    assert set(bodies) == {"float", "spar_plate"}
    volume = np.pi * 5.0**2 * 4.0
    assert bodies["float"]["mass"] == "equilibrium"
    model = hydrodae.linear.LinearModel(tmp_path / "case" / "case.toml")
    assert model.mass[0, 0] == pytest.approx(1025.0 * volume, rel=1e-6)
    assert bodies["spar_plate"]["mass"] == 450000.0
    assert bodies["spar_plate"]["inertia"] == [4e6, 5e6, 6e6]
    assert bodies["float"]["motion"] == bodies["spar_plate"]["motion"] == "planar"
    assert bodies["float"]["center_of_gravity"] == pytest.approx([0.0, 0.0, -1.5])
    (joint,) = found["joint"]
    assert (joint["type"], joint["body_a"], joint["body_b"]) == ("prismatic", "spar_plate", "float")
    assert joint["point"] == [0.0, 0.0, -2.0]
    forces = {force["type"]: force for force in found["force"]}
    assert forces["pto_linear"]["damping"] == 1.2e6
    # WEC-Sim makes pretension by the place where the spring is slack
    assert forces["pto_linear"]["neutral"] == pytest.approx(-0.5)
    assert forces["viscous_damping"]["quadratic"] == [0.0, 0.0, 1e5, 0.0, 0.0, 0.0]
    assert found["hydro"]["radiation"] == "constant"
    assert found["hydro"]["frequency"] == pytest.approx(2.0 * np.pi / 8.0)
    assert found["solver"]["end_time"] == 60.0
    results = hydrodae.run(tmp_path / "case" / "case.toml", set={"solver.end_time": 20.0})
    assert results.status == "completed"


def test_heave_of_one_body_is_that_of_its_tables(tmp_path: Path) -> None:
    """At a frequency of the table."""
    source = tmp_path / "source"
    damping, stiffness, height, omega = 1.5e5, 2e4, 1.0, 1.05
    database = write_one_body(
        source,
        f"waves = waveClass('regular'); waves.height = {height}; waves.period = 2*pi/{omega};",
        f"pto(1).damping = {damping}; pto(1).stiffness = {stiffness};",
    )
    assert database.omega[6] == pytest.approx(omega)
    convert(source, tmp_path / "case")
    assert tables(tmp_path / "case")["body"][0]["motion"] == "heave"
    results = hydrodae.run(tmp_path / "case" / "case.toml")
    time, heave = np.asarray(results.time), np.asarray(results["joints/pto1/displacement"]).ravel()
    last = time > 200.0 - 4.0 * np.pi / omega
    statics = database.bodies["buoy"].hydrostatics
    assert statics is not None
    mass = 1025.0 * statics.displaced_volume + database.added_mass[6, 0, 0]
    spring = 1025.0 * database.gravity * statics.waterplane_area + stiffness
    damped = database.radiation_damping[6, 0, 0] + damping
    force = abs(database.excitation[6, 0, 0]) * height / 2.0
    expected = force / abs(spring - omega**2 * mass + 1j * omega * damped)
    assert np.ptp(heave[last]) / 2.0 == pytest.approx(expected, rel=2e-3)


def test_a_flap_on_a_fixed_base_is_planar(tmp_path: Path) -> None:
    source = tmp_path / "source"
    write_database(source, "flap")
    blocks = [
        ("Flap", "Rigid Body", "body(1)"),
        ("Base", "Rigid Body", "body(2)"),
        ("World", "Global Reference Frame", "simu"),
        ("Fixed", "Fixed", "constraint(1)"),
        ("Rotational PTO", "Rotational PTO", "pto(1)"),
    ]
    write_slx(source / "flap.slx", blocks, ["3r-4l", "4r-2r-5l", "5r-1r"])
    (source / "wecSimInputFile.m").write_text("""
simu = simulationClass(); simu.simMechanicsFile = 'flap.slx'; simu.rho = 1025; simu.endTime = 20;
waves = waveClass('irregular'); waves.height = 2; waves.period = 9; waves.spectrumType = 'PM';
waves.direction = [0 200]; waves.spread = [0.25 0.75]; waves.phaseSeed = 4;
body(1) = bodyClass('hydroData/device.h5');
body(1).mass = 150000; body(1).inertia = [2e6 2e6 2e6];
body(2) = bodyClass(''); body(2).nonHydro = 1; body(2).name = 'base';
body(2).mass = 999; body(2).inertia = [999 999 999];
body(2).centerGravity = [0 0 -10]; body(2).volume = 0;
constraint(1) = constraintClass('Constraint1'); constraint(1).location = [0 0 -10];
pto(1) = ptoClass('PTO1'); pto(1).damping = 1e4; pto(1).stiffness = 1e5;
pto(1).equilibriumPosition = 3;
pto(1).hardStops.upperLimitSpecify = 'on'; pto(1).hardStops.upperLimitBound = 40;
pto(1).location = [0 0 -9];
""")
    converted = convert(source, tmp_path / "case")
    assert left_out(converted) == ""
    found = tables(tmp_path / "case")
    motions = {body["name"]: body.get("motion", "rigid") for body in found["body"]}
    assert motions == {"flap": "planar", "base": "fixed"}
    joint = found["joint"][0]
    assert (joint["type"], joint["body_a"], joint["axis"]) == ("revolute", "ground", [0, 1, 0])
    forces = {force["type"]: force for force in found["force"]}
    # WEC-Sim's hinge turns about -y; degrees of its springs and stops are degrees
    assert forces["pto_linear"]["neutral"] == pytest.approx(-np.radians(3.0))
    assert forces["end_stop"]["lower_deg"] == pytest.approx(-40.0)
    assert forces["end_stop"]["stiffness"] == pytest.approx(1e6 * 180.0 / np.pi)
    heights = [wave["significant_height"] for wave in found["wave"]]
    assert heights == pytest.approx([1.0, 2.0 * np.sqrt(0.75)])
    assert [wave["heading_deg"] for wave in found["wave"]] == [0.0, -160.0]
    assert [wave["seed"] for wave in found["wave"]] == [4, 5]
    assert found["hydro"]["radiation"] == "exponential"
    assert hdb.read(tmp_path / "case" / "hydro.h5").memory


@pytest.mark.parametrize(
    ("x", "start", "motion"),
    [
        (0.0, "", "yaw"),
        (2.0, "", "rigid"),
        (0.0, "body(1).initial.displacement = [0 0 1];", "rigid"),
    ],
)
def test_a_body_that_turns_about_a_vertical_axis_through_its_centre_yaws(
    cylinders: Path, tmp_path: Path, x: float, start: str, motion: str
) -> None:
    source = tmp_path / "source"
    (source / "hydroData").mkdir(parents=True)
    (source / "hydroData" / "device.h5").write_bytes(cylinders.read_bytes())
    blocks = [
        ("Buoy", "Rigid Body", "body(1)"),
        ("World", "Global Reference Frame", "simu"),
        ("Rotational PTO", "Rotational PTO", "pto(1)"),
    ]
    write_slx(source / "one.slx", blocks, ["2r-3l", "3r-1r"])
    (source / "wecSimInputFile.m").write_text(f"""
simu = simulationClass(); simu.simMechanicsFile = 'one.slx'; simu.rho = 1025; simu.endTime = 20;
waves = waveClass('regular'); waves.height = 2; waves.period = 9;
body(1) = bodyClass('hydroData/device.h5'); body(1).mass = 'equilibrium';
body(1).inertia = [1e6 1e6 1e6]; {start}
pto(1) = ptoClass('PTO1'); pto(1).damping = 1e4; pto(1).location = [{x} 0 -9];
pto(1).orientation.y = [0 0 1]; pto(1).orientation.z = [0 1 0];
""")
    convert(source, tmp_path / "case")
    found = tables(tmp_path / "case")
    assert found["body"][0].get("motion", "rigid") == motion
    assert [abs(part) for part in found["joint"][0]["axis"]] == [0, 0, 1]


def test_a_mooring_matrix_moves_to_the_centre_of_gravity(two_bodies: Path, tmp_path: Path) -> None:
    blocks = [*TWO_BODIES, ("Mooring", "MooringMatrix", "mooring(1)")]
    write_slx(two_bodies / "model.slx", blocks, ["3r-4l", "4r-2r-5r-6l", "5l-1r"])
    append(
        two_bodies,
        "mooring(1) = mooringClass('Lines'); mooring(1).location = [0 0 8.5];\n"
        "mooring(1).matrix.stiffness = zeros(6,6); mooring(1).matrix.stiffness(1,1) = 1e5;\n"
        "mooring(1).matrix.preTension = [0 0 -2e4 0 0 0];\n",
    )
    convert(two_bodies, tmp_path / "case")
    mooring = {f["type"]: f for f in tables(tmp_path / "case")["force"]}["mooring_matrix"]
    stiffness = np.array(mooring["stiffness"])
    arm = 10.0  # above the centre of gravity, at -1.5: pitch moves the point by it
    assert stiffness[0, 0] == 1e5
    assert stiffness[0, 4] == stiffness[4, 0] == pytest.approx(1e5 * arm)
    assert stiffness[4, 4] == pytest.approx(1e5 * arm**2)
    assert mooring["pretension"] == pytest.approx(
        [0, 0, -2e4, 0, -4e5, 0]
    )  # at x = 0, the body at 20


def test_what_the_case_does_not_hold_is_listed(two_bodies: Path, tmp_path: Path, capsys) -> None:
    blocks = [*TWO_BODIES, ("Rope", "Cable", "cable(1)")]
    blocks[4] = ("PTO", "Translational PTO Actuation Force", "pto(1)")
    write_slx(two_bodies / "model.slx", blocks, ["3r-4l", "4r-2r-5l-6l", "5r-1r"])
    append(
        two_bodies,
        "body(1).nonlinearHydro = 2;\nbody(1).unknownField = 3;\nbody(1).viz.color = [1 0 0];\n"
        "ptoSim(1) = ptoSimClass('motor');\nsimu.mcrMatFile = 'mcr.mat';\n",
    )
    lines = TWO_BODY_INPUT.count("\n")
    case = str(tmp_path / "case")
    command = ["new", case, "--from", "wecsim", str(two_bodies)]
    assert cli.main(command) == 2
    assert "--accept cable writes it anyway" in capsys.readouterr().err
    assert not Path(case).exists()
    command += ["--accept", "cable"]
    assert cli.main([*command, "--accept", "current"]) == 2
    assert "--accept 'current': this is not missing" in capsys.readouterr().err
    assert cli.main(command) == 0
    out = capsys.readouterr().out
    assert f"wecSimInputFile.m:{lines + 1}: body(1): nonlinear hydrodynamics" in out
    assert f"wecSimInputFile.m:{lines + 2}: body(1).unknownField" in out
    assert f"body(1).viz.color ({lines + 3})" in out
    assert f"wecSimInputFile.m:{lines + 4}: ptoSim(1): PTO-Sim" in out
    assert f"wecSimInputFile.m:{lines + 5}: simu.mcrMatFile" in out
    assert "model.slx, block 'Rope': cable(1) is not in wecSimInputFile.m" in out
    assert "model.slx, block 'PTO': force of pto(1) from Simulink" in out
    assert f"next: hydrodae run {case}" in out
    functions = read_functions(Path(case) / "functions.py")
    shorter = {"solver.end_time": 1.0}
    notes = hydrodae.run(Path(case) / "case.toml", set=shorter, **functions).notes
    for part in ("block 'Rope': cable(1)", "body(1).unknownField", "force of pto(1)"):
        assert any(note.startswith("missing in the case: ") and part in note for note in notes)


def test_results_beside_a_missing_database_are_read(two_bodies: Path, tmp_path: Path) -> None:
    data = two_bodies / "hydroData"
    (data / "raw.h5").write_bytes((data / "device.h5").read_bytes())
    (data / "device.h5").write_text("version https://git-lfs.github.com/spec/v1\n")
    converted = convert(two_bodies, tmp_path / "case")
    assert "is a pointer of Git LFS; read raw.h5 beside it" in "\n".join(
        map(str, converted.remarks.of("assumed"))
    )
    (data / "raw.h5").unlink()
    with pytest.raises(CaseError, match="Git LFS"):
        convert(two_bodies, tmp_path / "second")
    assert not (tmp_path / "second").exists()


def test_an_imported_elevation_becomes_a_file(tmp_path: Path) -> None:
    source = tmp_path / "source"
    text = "waves = waveClass('elevationImport'); waves.elevationFile = 'eta.txt';"
    write_one_body(source, text, "pto(1).damping = 1e5;")
    time = np.arange(0.0, 300.0, 0.25)
    table = np.column_stack([time, 0.5 * np.cos(0.8 * time)])
    np.savetxt(source / "eta.txt", table)
    convert(source, tmp_path / "case")
    (wave,) = tables(tmp_path / "case")["wave"]
    assert wave["type"] == "measured"
    data = np.loadtxt(tmp_path / "case" / wave["file"], delimiter=",", skiprows=1)
    np.testing.assert_allclose(data, table, atol=1e-8)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("simu.simMechanicsFile = 'other.slx';", "other.slx: there is no such file"),
        ("body(1).mass = unknown;", "mass could not be read"),
        ("body(2) = bodyClass('hydroData/second.h5'); body(2).mass = 1;", "2 databases"),
    ],
)
def test_what_cannot_be_converted_is_one_error(
    change: str, message: str, two_bodies: Path, tmp_path: Path
) -> None:
    path = two_bodies / "wecSimInputFile.m"
    text = path.read_text()
    if "mass = unknown" in change:
        text = text.replace("body(1).mass = 'equilibrium';", "")
    path.write_text(f"{text}{change}\n")
    with pytest.raises(CaseError, match=message):
        convert(two_bodies, tmp_path / "case")
    assert not (tmp_path / "case").exists()


def test_command_wants_one_folder_and_a_known_program(tmp_path: Path, capsys) -> None:
    assert cli.main(["new", "a", "b", "--from", "wecsim", str(tmp_path)]) == 2
    assert cli.main(["new", "a", "--from", "other", str(tmp_path)]) == 2
    assert cli.main(["new", str(tmp_path / "a"), "--from", "wecsim", str(tmp_path)]) == 2
    assert "there is no wecSimInputFile.m" in capsys.readouterr().err


def test_comparison_of_examples(two_bodies: Path, repository: Path, tmp_path: Path) -> None:
    """One row that runs, with its figure beside linear theory, and one that is not there."""
    examples = tmp_path / "examples.json"
    examples.write_text('[{"folder": "source", "figure": "pitch"}, {"folder": "absent"}]')
    output = tmp_path / "table.md"
    script = repository / "cases" / "wecsim" / "compare.py"
    command = [sys.executable, str(script), str(two_bodies.parent)]
    command += ["--examples", str(examples), "--output", str(output)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    rows = output.read_text().splitlines()
    assert rows[2].startswith("| source | "), done.stderr
    assert "largest pitch, deg" in rows[2]
    assert rows[3].startswith("| absent | no: not in these clones |")
    assert rows[5].startswith("Of 2: ")


DECK = """
---------------------- LINE TYPES ----------------------
TypeName   Diam    Mass/m     EA     BA/-zeta   EI   Cd   Ca   CdAx  CaAx
(name)     (m)     (kg/m)     (N)    (N-s/-)    (N-m^2)  (-)  (-)  (-)  (-)
chain      0.1     100.0      5e8    -0.8       0    1.6  1.0  0.1   0.0
---------------------- BODIES ----------------------
ID   Attachment   X0   Y0   Z0   r0   p0   y0   Mass  CG   I   Volume  CdA  Ca
(#)  (word)       (m)  (m)  (m)  (deg) (deg) (deg) (kg) (m) (kg-m^2) (m^3) (m^2) (-)
1    Coupled      0    0    -9   0    0    0    0     0    0   0       0    0
---------------------- POINTS ----------------------
ID   Attachment   X     Y    Z     Mass   Volume   CdA   Ca
(#)  (word/ID)    (m)   (m)  (m)   (kg)   (m^3)    (m^2) (-)
1    Body1        3.0   0    1.0   0      0        0     0
2    Fixed        90.0  0    -50   0      0        0     0
---------------------- LINES ----------------------
ID   LineType   AttachA   AttachB   UnstrLen   NumSegs   Outputs
(#)  (name)     (#)       (#)       (m)        (-)       (-)
1    chain      1         2         105        20        -
---------------------- OPTIONS ----------------------
50   WtrDpth
--------------------- need this line ------------------
"""


def test_body_of_a_mooring_deck_is_where_the_input_file_says(
    two_bodies: Path, tmp_path: Path
) -> None:
    blocks = [*TWO_BODIES, ("Lines", "MoorDynConnection", "mooring(1)")]
    write_slx(two_bodies / "model.slx", blocks, ["3r-4l", "4r-2r-5r-6l", "5l-1r"])
    (two_bodies / "lines.txt").write_text(DECK)
    append(
        two_bodies,
        "mooring(1) = mooringClass('chain'); mooring(1).moorDyn = 1;\n"
        "mooring(1).moorDynInputFile = 'lines.txt';\n"
        "mooring(1).initial.displacement = [20 0 -1.5];\n",
    )
    converted = convert(two_bodies, tmp_path / "case")
    assert left_out(converted) == ""
    (line,) = (f for f in tables(tmp_path / "case")["force"] if f["type"] == "line")
    ends = {line["body_a"]: line["point_a"], line["body_b"]: line["point_b"]}
    assert ends["spar_plate"] == pytest.approx([23.0, 0.0, -0.5])
    assert ends["ground"] == pytest.approx([90.0, 0.0, -50.0])
    notes = [str(note) for note in converted.remarks.of("assumed") if "lines.txt" in note.place]
    assert notes
    assert {note.count("lines.txt") for note in notes} == {1}


@pytest.mark.parametrize("wet", [True, False])
def test_depth_of_the_waves_is_that_of_a_case_without_a_database(
    two_bodies: Path, tmp_path: Path, wet: bool
) -> None:
    append(two_bodies, "waves.waterDepth = 30;\nwaves.spread = 1;\n")
    file = two_bodies / "wecSimInputFile.m"
    if not wet:
        dry = "bodyClass(''); body({n}).nonHydro = 1; body({n}).centerGravity = [0 0 {n}];"
        dry += " body({n}).centerBuoyancy = [0 0 {n}];"
        dry += " body({n}).morisonElement.option = 1; body({n}).morisonElement.cd = [1 1 1];"
        dry += " body({n}).morisonElement.ca = [1 1 1]; body({n}).morisonElement.area = [2 2 2];"
        dry += " body({n}).morisonElement.VME = 3; body({n}).morisonElement.rgME = [0 0 -5];"
        text = file.read_text().replace("'equilibrium'", "1e5")
        for n in (1, 2):
            text = text.replace(
                f"body({n}) = bodyClass('hydroData/device.h5');", f"body({n}) = {dry.format(n=n)}"
            )
        file.write_text(text)
    converted = convert(two_bodies, tmp_path / "case")
    assert left_out(converted) == ""
    environment = tables(tmp_path / "case")["environment"]
    assert environment.get("water_depth") == (None if wet else 30.0)
    unneeded = str(converted.remarks.of("not needed"))
    assert ("waterDepth (the database is for 50 m)" in unneeded) == wet
    assert ("body(1).centerBuoyancy (no volume)" in unneeded) != wet
