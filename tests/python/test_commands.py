"""The vocabulary of the command line: examples, JSON, completion, grouping of long lists."""

from __future__ import annotations

import json
import shlex
import subprocess
import sys

import pytest
from tests.scenes import four_bar_windows

import hydrodae
from hydrodae.commands import cli
from hydrodae.commands.examples import EXAMPLES
from hydrodae.commands.machine import plain
from hydrodae.commands.parser import ALL, parser_of
from hydrodae.starters import create
from hydrodae.study.grouped import grouped


def commands() -> list[str]:
    parser = parser_of(ALL)
    (actions,) = [a for a in parser._actions if a.choices and a.dest != "shell"]
    assert actions.choices is not None
    return list(actions.choices)


def test_every_command_has_examples_and_they_can_be_parsed() -> None:
    assert set(commands()) <= {*EXAMPLES, "view"}
    for name, lines in EXAMPLES.items():
        for line in lines:
            program, *arguments = shlex.split(line)
            assert program == "hydrodae"
            assert arguments[0] == name
            parser_of(name).parse_args(arguments)


def test_help_shows_examples_and_exit_codes(capsys: pytest.CaptureFixture[str]) -> None:
    for arguments in (["run", "--help"], ["--help"]):
        with pytest.raises(SystemExit):
            cli.main(arguments)
    shown = capsys.readouterr().out
    assert "\nexamples:\n  hydrodae run case.toml\n" in shown
    assert "3 solver failure" in shown


@pytest.fixture(scope="module")
def moored(tmp_path_factory: pytest.TempPathFactory) -> str:
    return str(create("moored", tmp_path_factory.mktemp("commands") / "moored"))


def answer(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict:
    assert cli.main([*arguments, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert isinstance(found, dict)
    return found


def test_json_of_a_run_and_of_its_linear_equivalent(moored, tmp_path, capsys) -> None:
    results = str(tmp_path / "short.h5")
    found = answer(capsys, "run", moored, "-o", results, "--set", "solver.end_time=1")
    assert (found["status"], found["end_time"]) == ("completed", 1.0)
    assert found["results"] == results
    assert found["statistics"]["steps"] > 0
    linear = answer(capsys, "spectral", moored)
    assert linear["standard_deviation"]["sea/elevation"] > 0.1
    assert linear["rate"]["bodies/float/heave"] > 0.0


def test_json_of_check(moored, capsys) -> None:
    found = answer(capsys, "check", moored)
    assert found["bodies"] == ["float", "spar"]
    assert found["joints"] == ["slide"]
    assert found["degrees_of_freedom"] + found["constraint_rows"] == 6
    assert found["unknowns"] == sum(
        found[name] for name in ("positions", "velocities", "states", "multipliers")
    )
    assert any("weight" in line for line in found["text"])


def test_json_of_equilibrium_is_what_the_function_returns(moored, capsys) -> None:
    found = answer(capsys, "equilibrium", moored)
    rest = hydrodae.equilibrium(moored)
    assert found["offsets"]["spar"] == pytest.approx(rest.offsets["spar"].tolist())
    assert found["tensions"]["forces/bow/tension"] == pytest.approx(
        rest.tensions["forces/bow/tension"]
    )
    assert [mode["period"] for mode in found["modes"]] == pytest.approx(
        [mode.period for mode in rest.modes]
    )


def test_json_of_rao_is_what_the_function_returns(moored, capsys) -> None:
    found = answer(capsys, "rao", moored, "--periods", "7,10")
    rao = hydrodae.rao(moored, periods=[7.0, 10.0])
    heave = found["chosen"]["channels"]["bodies/float/heave"]
    assert heave["unit"] == "m/m"
    assert heave["amplitude"] == pytest.approx(abs(rao.chosen["bodies/float/heave"]).tolist())
    assert found["in_sea"]["mean_power"]
    assert cli.main(["rao", moored, "--json", "--time-domain"]) == 2
    assert "exclude each other" in capsys.readouterr().err


def test_json_of_a_database(moored, capsys) -> None:
    path = moored.replace("case.toml", "hydro.h5")
    found = answer(capsys, "hdb", "doctor", path)
    assert found["bodies"] == ["float", "spar"]
    assert found["ok"] is True
    assert {"info"} <= {finding["severity"] for finding in found["findings"]}
    assert answer(capsys, "hdb", "show", path)["findings"] == []


def test_json_knows_numbers_that_are_none() -> None:
    assert plain({"a": float("nan"), "b": 1 + 2j, "c": (1, "x")}) == {
        "a": None,
        "b": [1.0, 2.0],
        "c": [1, "x"],
    }


def test_completion_is_a_script_of_the_shell(tmp_path, capsys) -> None:
    pytest.importorskip("shtab")
    assert cli.main(["completion", "bash"]) == 0
    script = tmp_path / "hydrodae.bash"
    text = capsys.readouterr().out
    assert "--freeboard" in text  # of view, which has its arguments only when it is asked for
    script.write_text(text)
    asked = (
        f"source {script}; COMP_WORDS=(hydrodae equil); COMP_CWORD=1; "
        "_shtab_hydrodae; echo ${COMPREPLY[@]}"
    )
    done = subprocess.run(["bash", "-c", asked], capture_output=True, text=True, check=False)
    assert done.stdout.split() == ["equilibrium"], done.stderr


def test_completion_without_its_package_says_how_to_get_it(monkeypatch, capsys) -> None:
    monkeypatch.setitem(sys.modules, "shtab", None)
    assert cli.main(["completion", "bash"]) == 2
    assert "completion needs the package shtab: pip install" in capsys.readouterr().err


def test_lines_that_are_alike_are_grouped() -> None:
    lines = ["bodies:", *(f"  up{k}: planar, 1 kg" for k in range(12)), "  up12: planar, 2 kg"]
    assert grouped("\n".join(lines)).splitlines() == [
        "bodies:",
        "  up0: planar, 1 kg",
        "    ... and 11 like it, the last:",
        "  up11: planar, 1 kg",
        "  up12: planar, 2 kg",
    ]
    few = "".join(f"{line}\n" for line in lines[:8])
    assert grouped(few) == few


def test_check_of_a_long_chain_fits_on_a_page() -> None:
    case = hydrodae.Case.from_text(four_bar_windows(40))
    text = hydrodae.check(case)
    assert len(text.splitlines()) < 50
    assert len(hydrodae.check(case, every_line=True).splitlines()) > 300
