"""Folders of WEC-Sim that the tests make themselves: input files, models, databases."""

from __future__ import annotations

import zipfile
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
import pytest

import hydrodae
from hydrodae import hdb

LIBRARIES = {
    "Rigid Body": "WECSim_Lib_Body_Elements/Rigid Body",
    "Global Reference Frame": "WECSim_Lib_Frames/Global Reference Frame",
    "Fixed": "WECSim_Lib_Constraints/Fixed",
    "Floating (3DOF)": "WECSim_Lib_Constraints/Floating (3DOF)",
    "Spherical": "WECSim_Lib_Constraints/Spherical",
    "Translational": "WECSim_Lib_Constraints/Translational",
    "Translational PTO": "WECSim_Lib_PTOs/Translational PTO",
    "Translational PTO Actuation Force": "WECSim_Lib_PTOs/Translational PTO&#xA;Actuation Force",
    "Rotational PTO": "WECSim_Lib_PTOs/Rotational PTO",
    "MooringMatrix": "WECSim_Lib_Moorings/MooringMatrix",
    "MoorDynConnection": "WECSim_Lib_Moorings/MoorDynConnection",
    "Cable": "WECSim_Lib_Cables/Cable",
}


def write_slx(
    path: Path, blocks: list[tuple[str, str, str]], lines: list[str], extra: str = ""
) -> None:
    """A model of blocks (name, kind, mask parameter such as body(1)) and lines "1r-2l-3r".

    An end of a line is the number of a block from 1 on, and its left or right port. `extra` is XML
    of more blocks and lines.
    """
    text = "<System>"
    for number, (name, kind, parameter) in enumerate(blocks, 1):
        mask = parameter.partition("(")[0]
        text += f'<Block BlockType="Reference" Name={quoteattr(name)} SID="{number}">'
        text += f'<P Name="SourceBlock">{LIBRARIES[kind]}</P><InstanceData>'
        text += f'<P Name="{mask}">{parameter}</P></InstanceData></Block>'
    for line in lines:
        ends = [f"{end[:-1]}#{end[-1]}conn:1" for end in line.split("-")]
        text += f'<Line LineType="Connection"><P Name="Dst">{ends[-1]}</P>'
        text += "".join(f'<Branch><P Name="Src">{end}</P></Branch>' for end in ends[:-1])
        text += "</Line>"
    with zipfile.ZipFile(path, "w") as archive:
        root = '<ModelInformation><Model><System Ref="system_root"/></Model></ModelInformation>'
        archive.writestr("simulink/blockdiagram.xml", root)
        archive.writestr("simulink/systems/system_root.xml", text + extra + "</System>")


def write_database(folder: Path, kind: str) -> hdb.HydroDatabase:
    """Database of a starter, in the place of that of BEMIO (it has some coordinates only)."""
    source = Path(hydrodae.__file__).parent / "starters" / kind / "hydro.h5"
    database = hdb.read(source)
    (folder / "hydroData").mkdir(parents=True)
    database.write(folder / "hydroData" / "device.h5")
    return database


@pytest.fixture(scope="session")
def cylinders(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two cylinders of radius 5 m and draught 4 m as BEMIO writes them."""
    water = hdb.Water(omega=np.linspace(0.2, 2.6, 20), depth=50.0)
    places = {"one": (0.0, 0.0), "two": (20.0, 0.0)}
    database, _ = hdb.cylinders(places, hdb.Cylinder(5.0, 4.0, -1.5), water, orders=2, modes=6)
    path = tmp_path_factory.mktemp("bemio") / "device.h5"
    hdb.export(database, path)
    return path


TWO_BODIES = [
    ("Float", "Rigid Body", "body(1)"),
    ("Spar/Plate", "Rigid Body", "body(2)"),
    ("Global Reference Frame", "Global Reference Frame", "simu"),
    ("Floating (3DOF)", "Floating (3DOF)", "constraint(1)"),
    ("Translational PTO", "Translational PTO", "pto(1)"),
]
# ground - constraint - spar - power take-off, whose follower is on its left, - float
TWO_BODY_LINES = ["3r-4l", "4r-2r-5r", "5l-1r"]
TWO_BODY_INPUT = """
%% Simulation
simu = simulationClass();
simu.simMechanicsFile = 'model.slx';
simu.rho = 1025;  simu.rampTime = 20;
simu.endTime = 60; simu.dt = 0.1;
simu.b2b = 1;
waves = waveClass('regular');      % waves = waveClass('irregular');
waves.height = 2.5; waves.period = 8;
body(1) = bodyClass('hydroData/device.h5');
body(1).mass = 'equilibrium';
body(1).inertia = [1 2 3]*1e6;
body(2) = bodyClass('hydroData/device.h5');
body(2).mass = 450000;
body(2).inertia = [4e6, 5e6, ...
                   6e6];
body(2).quadDrag.drag(3,3) = 1e5;
constraint(1) = constraintClass('Constraint1');
constraint(1).location = [0 0 0];
pto(1) = ptoClass('PTO1');
pto(1).stiffness = 1e4;
pto(1).pretension = 5e3;
pto(1).damping = 1.2e6;
pto(1).location = [0 0 -2];
"""


@pytest.fixture
def two_bodies(tmp_path: Path, cylinders: Path) -> Path:
    folder = tmp_path / "source"
    (folder / "hydroData").mkdir(parents=True)
    (folder / "hydroData" / "device.h5").write_bytes(cylinders.read_bytes())
    write_slx(folder / "model.slx", TWO_BODIES, TWO_BODY_LINES)
    (folder / "wecSimInputFile.m").write_text(TWO_BODY_INPUT)
    return folder


def append(folder: Path, text: str) -> None:
    with (folder / "wecSimInputFile.m").open("a") as file:
        file.write(text)


def tables(folder: Path) -> dict:
    from hydrodae.case.contents import case_tables

    return case_tables(hydrodae.Case.read(folder / "case.toml"))


def left_out(converted) -> str:
    return "\n".join(map(str, converted.remarks.of("left out")))


def write_one_body(
    source: Path, waves: str, pto: str, signals: str = "", kind: str = "Translational PTO"
) -> hdb.HydroDatabase:
    """A buoy on a power take-off against the ground; `signals` is XML of its controller."""
    database = write_database(source, "point_absorber")
    blocks = [
        ("Buoy", "Rigid Body", "body(1)"),
        ("World", "Global Reference Frame", "simu"),
        ("PTO", kind, "pto(1)"),
    ]
    ground, buoy = "rl" if kind == "Translational PTO" else "lr"
    write_slx(source / "one.slx", blocks, [f"2r-3{ground}", f"3{buoy}-1r"], signals)
    (source / "wecSimInputFile.m").write_text(f"""
simu = simulationClass(); simu.simMechanicsFile = 'one.slx'; simu.rho = 1025;
simu.endTime = 200; simu.rampTime = 60;
{waves}
body(1) = bodyClass('hydroData\\device.h5');
body(1).mass = 'equilibrium'; body(1).inertia = [1e6 1e6 1e6];
pto(1) = ptoClass('PTO1'); pto(1).location = [0 0 0];
{pto}
""")
    return database
