"""The messages of docs/troubleshooting.md are what the program prints."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from tests.python.test_tcp import free_port

from hydrodae.commands import cli
from hydrodae.starters import create

HINGE = """
[[joint]]
name = "hinge2"
type = "revolute"
body_a = "ground"
body_b = "flap"
point = [0.0, 0.0, -9.0]
axis = [0.0, 1.0, 0.0]
"""
FRICTION = """
[[force]]
name = "friction"
type = "friction_stribeck"
joint = "hinge"
static_coefficient = 0.1
kinetic_coefficient = 0.1
creep_rate = 1e-3
"""
LAW = '\n[[force]]\nname = "law"\ntype = "python_load"\njoint = "hinge"\n'
OPEN = HINGE.replace("[0.0, 0.0, -9.0]", "[1.0, 0.0, -9.0]") + "initial = { angle_deg = 20 }\n"
CONTROLLER = """
[[controller]]
type = "tcp"
name = "law"
inputs = ["joints/slide/displacement_rate"]
outputs = ["forces/pto/loud"]
period = 0.1
port = PORT
connect_timeout = 0.1
"""
FLAP, BUOY, DISC, WINDOWS = "flap", "point_absorber", "fast_rotor", "n_four_bar_2"
CHECK, RUN = "check case.toml", "run case.toml"

#: By heading: the scene, (old, new) in its text or what is appended to it, and the command.
Change = tuple[str, str] | str | None
RECIPES: dict[str, tuple[str, Change, str]] = {
    "Unknown key": (BUOY, ("damping = 150", "dampng = 150"), CHECK),
    "Unknown table": (FLAP, ("[[wave]]", "[[waves]]"), CHECK),
    "One bracket in place of two": (FLAP, ("[[joint]]", "[joint]"), CHECK),
    "Broken TOML": (BUOY, ("[solver]", "[solver"), CHECK),
    "Unknown value": (BUOY, None, CHECK + " --set solver.method=radua"),
    "Text in place of a number": (BUOY, None, CHECK + " --set body.buoy.mass=heavy"),
    "Value out of range": (BUOY, None, CHECK + " --set solver.rtol=10"),
    "Name that does not exist": (BUOY, ('joint = "slide"', 'joint = "slyde"'), CHECK),
    "Key of another type of wave": (BUOY, None, CHECK + " --set wave.sea.type=regular"),
    "Inertia is missing": (BUOY, None, CHECK + " --set body.buoy.motion=planar"),
    "Fixed steps of an adaptive method": (
        BUOY,
        None,
        CHECK + " --set solver.method=ida --set solver.step=0.1",
    ),
    "A Python function is missing": (FLAP, LAW, RUN),
    "Database is not there": (BUOY, ("hydro.h5", "hydroo.h5"), CHECK),
    "Body is not in the database": (BUOY, ('hydro = "buoy"', 'hydro = "boy"'), CHECK),
    "Database lacks motions": (FLAP, None, CHECK + " --set body.flap.motion=rigid"),
    "No kernel for the convolution": (FLAP, None, CHECK + " --set hydro.radiation=convolution"),
    "Wave outside the headings": (BUOY, None, CHECK + " --set wave.sea.heading_deg=45"),
    "Sea outside the frequencies": (BUOY, None, CHECK + " --set wave.sea.peak_period=2"),
    "Gravity of case and database differ": (BUOY, None, CHECK + " --set environment.gravity=9.7"),
    "Fit misses its target": (FLAP, None, "hdb fit hydro.h5 a=flap.planar --target 1e-9"),
    "Joints do not close": (FLAP, OPEN, CHECK),
    "Nothing can move": (FLAP, HINGE, CHECK),
    "Power take-off without motion": (FLAP, HINGE, CHECK),
    "Redundant rows": (FLAP, HINGE, CHECK),
    "Tonnes in place of kilograms": (FLAP, None, CHECK + " --set body.flap.mass=150"),
    "Body rests elsewhere": (BUOY, None, CHECK + " --set body.buoy.mass=322.5e3"),
    "Equilibrium is unstable": (FLAP, None, "equilibrium case.toml --set body.flap.mass=450e3"),
    "Friction needs a bearing": (FLAP, FRICTION, CHECK),
    "Channel does not exist": (BUOY, CONTROLLER, CHECK),
    "Nobody connects": (BUOY, CONTROLLER.replace("loud", "load"), RUN),
    "Run stops at the energy balance": (WINDOWS, None, RUN + " --method ida"),
    "Constraints drift": (
        WINDOWS,
        None,
        RUN + " --method ida --set solver.formulation=index_1 --set solver.rtol=1e-3",
    ),
    "Motion is not reproducible": (
        DISC,
        None,
        RUN + " --method generalized_alpha --set solver.step=0.05",
    ),
    "Beyond linear theory": (
        FLAP,
        None,
        RUN + " --set joint.hinge.initial.angle_deg=40 --set solver.end_time=20",
    ),
    "Waves that break": (FLAP, None, CHECK + " --set wave.sea.significant_height=12"),
    "Too short for an interval": (FLAP, None, RUN + " --set solver.end_time=40"),
    "Nothing to resume": (BUOY, None, RUN + " --resume"),
    "File stands in the way": (BUOY, None, RUN + " -o hydro.h5"),
    "Folder exists": (FLAP, None, "new flap"),
    "No such channel": (
        FLAP,
        None,
        RUN + " -q --set solver.end_time=1; plot case.h5 joints/hinj/angle",
    ),
}


def entries(repository: Path) -> dict[str, str]:
    """Heading and message of each entry that can be produced."""
    text = (repository / "docs" / "troubleshooting.md").read_text()
    found = re.findall(r"^### (.*)\n\n```text\n(.*)\n```$", text, re.MULTILINE)
    assert len(found) == text.count("```text\n") - text.count("<!-- not run: printed only")
    return dict(found)


def test_every_entry_has_a_recipe(repository: Path) -> None:
    assert set(entries(repository)) == set(RECIPES)


@pytest.mark.parametrize("heading", RECIPES)
def test_message_is_printed(
    heading: str,
    repository: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture,
) -> None:
    """If this fails, write the message that is printed now into the page."""
    scene, change, commands = RECIPES[heading]
    monkeypatch.chdir(tmp_path)
    if scene in (DISC, WINDOWS):
        shutil.copy(repository / "cases" / "benchmarks" / f"{scene}.toml", "case.toml")
    else:
        create(scene, tmp_path / "flap")
        for path in (tmp_path / "flap").iterdir():
            shutil.copy(path, tmp_path)
    text = Path("case.toml").read_text()
    if isinstance(change, tuple):
        assert change[0] in text
        text = text.replace(*change)
    elif change:
        text += change.replace("PORT", str(free_port()))
    Path("case.toml").write_text(text)
    for command in commands.split(";"):
        cli.main(command.split())
    printed = "".join(capsys.readouterr())
    message = entries(repository)[heading]
    pattern = ".*".join(re.escape(part) for part in message.split("..."))
    assert re.search(f"^{pattern}", printed, re.MULTILINE), f"{message}\n--- printed:\n{printed}"
