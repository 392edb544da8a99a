"""Bodies of WEC-Sim with generalised modes and water columns become cases."""

from __future__ import annotations

import re
import shutil
import zipfile
from pathlib import Path
from xml.sax.saxutils import escape

import numpy as np
import pytest
from tests.python.wecsim_files import LIBRARIES, left_out, tables, write_slx

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.wecsim import convert

BLOCKS = [
    ("Flex Body", "Flex Body", "body(1)"),
    ("World", "Global Reference Frame", "simu"),
    ("Floating (3DOF)", "Floating (3DOF)", "constraint(1)"),
]
INPUT = """
simu = simulationClass(); simu.simMechanicsFile = 'model.slx';
simu.endTime = 200; simu.rampTime = 50;
waves = waveClass('regular'); waves.height = 0.02; waves.period = {period};
body(1) = bodyClass('hydroData/{name}.h5'); body(1).mass = 'equilibrium';
body(1).inertia = [{inertia}];
constraint(1) = constraintClass('Constraint1'); constraint(1).location = [0 0 0];
"""
ORIFICE = """
body(1).linearDamping = zeros(7,7); body(1).linearDamping(7,7) = 100;
A1 = pi * 0.25^2; A2 = pi * 0.03^2; C = 0.62; rhoAir = 1.2;
"""


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folder with the model of one flexible body."""
    monkeypatch.setitem(LIBRARIES, "Flex Body", "WECSim_Lib_Body_Elements/Flex Body")
    folder = tmp_path / "source"
    (folder / "hydroData").mkdir(parents=True)
    write_slx(folder / "model.slx", BLOCKS, ["2r-3l", "3r-1r"])
    return folder


def copy(home: Path, stem: str, folder: Path) -> None:
    """Copy the results of WAMIT that stand in the place of the database."""
    for suffix in (".out", ".hst", ".mmx", ".cfg", ".frc", ".pot"):
        if (home / f"{stem}{suffix}").is_file():
            shutil.copy(home / f"{stem}{suffix}", folder / "hydroData")


@pytest.mark.slow
def test_bending_modes_of_a_barge(source: Path, tmp_path: Path, reference: Path) -> None:
    """Masses and stiffnesses of barge.mmx; amplitudes per metre of wave as WAMIT prints them."""
    copy(reference / "modes" / "gbm_barge", "barge", source)
    inertia = "6.667e7 2.167e9 2.167e9"
    text = INPUT.format(name="barge", period=10.05, inertia=inertia)
    (source / "wecSimInputFile.m").write_text(text)
    assert left_out(convert(source, tmp_path / "case")) == ""
    modes = {mode["name"]: mode for mode in tables(tmp_path / "case")["mode"]}
    assert list(modes) == ["mode7", "mode8", "mode9", "mode10"]
    assert modes["mode8"]["mass"] == pytest.approx(1.209976e6)
    assert modes["mode8"]["stiffness"] == pytest.approx(4.382532e7)
    model = hydrodae.linear.LinearModel(tmp_path / "case" / "case.toml")
    found = model.response(np.array([2.0 * np.pi / 10.05]))
    names = ("bodies/flex_body/heave", "modes/flex_body.mode7/amplitude")
    for name, expected in zip(names, (0.6753, 0.1275), strict=True):
        assert abs(found[name][0]) == pytest.approx(expected, rel=2e-3)


def add_function(path: Path, text: str, name: str = "law") -> None:
    """Add a MATLAB function to a model, of the block of this name."""
    with zipfile.ZipFile(path, "a") as archive:
        script = f'<C><P Name="name">{name}</P><P Name="script">{escape(text)}</P></C>'
        archive.writestr("simulink/stateflow/chart_1.xml", script)


def test_orifice_above_the_mode_of_a_moonpool(
    source: Path, tmp_path: Path, reference: Path
) -> None:
    """The mode without mass is water alone; the .out stands for a pointer of Git LFS."""
    copy(reference / "owc" / "owc_wecsim" / "test17a", "test17a", source)
    (source / "hydroData" / "test17a.h5").write_text("version https://git-lfs.github.com/spec/v1")
    text = INPUT.format(name="test17a", period=3.0, inertia="99 11 99") + ORIFICE
    (source / "wecSimInputFile.m").write_text(text)
    add_function(source / "model.slx", "function [F_ext, dP] = law(A1,A2,resp,C,rhoAir,thresh)")
    converted = convert(source, tmp_path / "case")
    assert left_out(converted) == ""
    assumed = "\n".join(map(str, converted.remarks.of("assumed")))
    assert "chamber.air.volume is for a height of 1 m" in assumed
    assert re.search(r"test17a.h5: is a pointer of Git LFS; read test17a.out", assumed)
    found = tables(tmp_path / "case")
    (mode,), (outlet,), (piston,) = found["mode"], found["outlet"], found["piston"]
    assert 0.0 < mode["mass"] < 1e-3
    assert mode["damping"] == 100.0
    assert (outlet["type"], outlet["coefficient"]) == ("orifice", 0.62)
    assert outlet["area"] == pytest.approx(np.pi * 0.03**2)
    assert (piston["mode"], piston["area"]) == ("mode7", pytest.approx(np.pi * 0.25**2))
    assert found["environment"]["air_density"] == 1.2
    held = {"solver.end_time": 10.0, "body.flex_body.motion": "heave"}
    assert hydrodae.run(tmp_path / "case" / "case.toml", set=held).status == "completed"


def test_modes_without_their_masses_are_refused(
    source: Path, tmp_path: Path, reference: Path
) -> None:
    copy(reference / "owc" / "owc_wecsim" / "test17a", "test17a", source)
    (source / "hydroData" / "test17a.mmx").unlink()
    text = INPUT.format(name="test17a", period=3.0, inertia="99 11 99")
    (source / "wecSimInputFile.m").write_text(text)
    with pytest.raises(CaseError, match=r"test17a\.mmx: is not there; it has the modal masses"):
        convert(source, tmp_path / "case")
