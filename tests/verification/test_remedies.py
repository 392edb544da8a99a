"""Messages that name what helps: coordinates without stiffness, commands that work, own keys."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
from tests.attack.parts import Table, body, case, joint
from tests.errors import wrong
from tests.verification.blocks import case_of, run_tables

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.coordinates import expand
from hydrodae.linear import LinearModel


def test_no_equilibrium_names_the_coordinate_without_stiffness() -> None:
    def run(motion: str) -> None:
        weight = body("weight", motion, 1.25, inertia=[1, 1, 1])
        run_tables(case([weight], 1.0), start="equilibrium")

    with pytest.raises(hydrodae.CaseError) as error:
        run("heave")
    message = str(error.value)
    assert "is off by -12.2625 N;" in message
    assert "no stiffness in heave of body 'weight'" in message
    assert "mooring" in message
    with pytest.raises(hydrodae.CaseError) as error:  # what no force drives is not blamed
        run("rigid")
    assert "no stiffness in heave of body 'weight':" in str(error.value)


def test_no_equilibrium_of_joined_bodies_names_all_that_drift() -> None:
    bodies = [body(n, "planar", 1.0, [x, 0, 0], [1, 1, 1]) for n, x in (("a", 0), ("b", 2))]
    hinge = joint("hinge", "revolute", "a", "b", [1, 0, 0], [0, 1, 0])
    with pytest.raises(hydrodae.CaseError) as error:
        run_tables(case(bodies, 1.0, joints=[hinge]), start="equilibrium")
    assert "no stiffness in heave of body 'a', heave of body 'b':" in str(error.value)


def test_ladder_says_how_to_get_the_rows_that_lack(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The command that it names is run, and then the row is there."""
    import shutil
    from dataclasses import replace

    from hydrodae.hdb.database import HydroDatabase

    db = HydroDatabase.read(repository / "cases" / "sphere" / "hydro.h5")
    replace(db, kernel=None).write(tmp_path / "hydro.h5")
    shutil.copy(repository / "cases" / "sphere" / "decay.toml", tmp_path / "case.toml")
    command = ["ladder", str(tmp_path / "case.toml"), "--repeat", "1", "--set"]
    assert main([*command, "solver.end_time=2"]) == 0
    told = capsys.readouterr().out
    found = re.search(r"convolution: .*make it with: (hydrodae hdb kernel .*)", told)
    assert found
    assert main(shlex.split(found[1])[1:]) == 0
    capsys.readouterr()
    assert main([*command, "solver.end_time=2"]) == 0
    assert "did not run" not in capsys.readouterr().out


def test_a_missing_fit_is_made_by_the_command_that_is_named(
    repository: Path, tmp_path: Path
) -> None:
    import shutil
    from dataclasses import replace

    from hydrodae.hdb.database import HydroDatabase

    db = HydroDatabase.read(repository / "cases" / "sphere" / "hydro.h5")
    replace(db, memory={}).write(tmp_path / "hydro.h5")
    shutil.copy(repository / "cases" / "sphere" / "decay.toml", tmp_path / "case.toml")
    case = hydrodae.Case.read
    with pytest.raises(hydrodae.CaseError) as error:
        hydrodae.run(case(tmp_path / "case.toml"))
    found = re.search(r"make one with: (hydrodae hdb fit \S+ \S+?),? or", str(error.value))
    assert found
    assert found[1].endswith(" all=sphere.heave")


LABELS = ["flap1.surge", "flap1.heave", "flap1.pitch", "flap1.sway", "base.heave"]


@pytest.mark.parametrize("spec", ["flap1", "flap11", "flap1.planr", "flap1.yaw", "bsae"])
def test_a_wrong_spec_suggests_what_works(spec: str) -> None:
    with pytest.raises(DatabaseError) as error:
        expand(spec, LABELS)
    message = str(error.value)
    offered = re.findall(r"[a-z0-9]+\.[a-z]+", message.replace(repr(spec), ""))
    assert offered
    for name in offered:
        assert expand(name, LABELS)
    if spec == "flap1":
        assert "'flap1' is a body; name what moves: flap1.all, flap1.planar" in message
    if spec == "flap1.planr":
        assert "did you mean 'flap1.planar'" in message


def test_the_command_for_an_extra_is_one_that_pip_can_follow(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    from hydrodae.support import extras

    (tmp_path / "my sources").mkdir()
    sources = tmp_path / "my sources"
    monkeypatch.setattr(extras, "source_folder", lambda: sources)
    assert shlex.split(extras.install_command("bem"))[-1] == f"{sources}[bem]"
    monkeypatch.setattr(extras, "source_folder", lambda: None)
    words = shlex.split(extras.install_command("bem"))
    assert words[:2] == ["pip", "install"]
    assert "capytaine>=3" in words
    assert not any(word.startswith("hydrodae") for word in words)


def test_the_source_folder_is_one_with_a_project(repository: Path) -> None:
    from hydrodae.support.extras import source_folder

    folder = source_folder()
    assert folder is None or (folder / "pyproject.toml").is_file()


ENDS = {"body_a": "ground", "body_b": "a"}


def case_with(kind: str, entry: Table) -> hydrodae.Case:
    """Return the case of one body with one entry more."""
    return case_of(case([body("a", "rigid", 1.0, inertia=[1, 1, 1])], 1.0) | {kind: [entry]})


@pytest.mark.parametrize(
    ("kind", "entry", "own", "foreign"),
    [
        (
            "joint",
            {"type": "revolute", **ENDS, "pitc": 1.0},
            "axis axis_x initial",
            "pitch path one_sided",
        ),
        (
            "joint",
            {"type": "distance", **ENDS, "lenth": 1},
            "length point_b one_sided",
            "axis_x pitch initial",
        ),
        (
            "constraint",
            {"type": "stop", "joint": "j", "uper": 1.0},
            "upper lower_deg restitution",
            "ratio drive joint_b body",
        ),
        (
            "constraint",
            {"type": "coupler", "joint": "j", "lower": 1.0},
            "ratio joint_b",
            "upper drive level",
        ),
        (
            "wave",
            {"type": "regular", "heigth": 1.0},
            "height period phase_deg",
            "gamma taper significant_height spreading",
        ),
        (
            "wave",
            {"type": "jonswap", "height": 1.0},
            "gamma peak_period seed",
            "period taper shape phase_deg",
        ),
        (
            "force",
            {"type": "pto_linear", "body": "a"},
            "damping delay joint",
            "pretension quadratic static point_a",
        ),
    ],
)
def test_messages_list_the_keys_of_the_own_type_only(
    kind: str, entry: Table, own: str, foreign: str
) -> None:
    with pytest.raises(hydrodae.CaseError) as error:
        case_with(kind, {"name": "n", **entry})
    listed = re.split(r"valid: |it has: ", str(error.value))[-1]
    words = set(re.findall(r"\w+", listed))
    assert set(own.split()) <= words, str(error.value)
    assert not set(foreign.split()) & words, str(error.value)


def test_an_unknown_type_is_told_before_its_keys() -> None:
    with wrong("joint.j.type"):
        case_with("joint", {"name": "j", "type": "revolut", **ENDS})


def test_frequency_domain_notes_what_it_leaves_out(repository: Path) -> None:
    text = (repository / "cases" / "f3of" / "rao.toml").read_text()
    assert LinearModel(repository / "cases" / "f3of" / "rao.toml").notes == []
    more = """
[[constraint]]
name = "bumper"
type = "stop"
joint = "hinge1"
lower_deg = -30.0
upper_deg = 30.0
[[force]]
type = "viscous_damping"
name = "skin"
body = "base"
quadratic = [1e4, 0, 1e4, 0, 0, 0]
"""
    case = hydrodae.Case.from_text(text + more, directory=repository / "cases" / "f3of")
    notes = LinearModel(case).notes
    assert any("open in the linear model" in note and "bumper" in note for note in notes)
    assert any("quadratic viscous_damping" in note and "skin" in note for note in notes)
