"""Every command of the documentation can be parsed; the quick ones of scripts run."""

from __future__ import annotations

import re
import runpy
import sys
from pathlib import Path

import pytest
from tests.commands.find import Command, all_commands, of_page, of_script, scripts
from tests.commands.parse import parses_arguments, problem
from tests.commands.run import bare, run_group, to_run

#: Scripts whose commands take seconds: they run here. All others: python -m tests.commands.
QUICK = (
    "cases/benchmarks/four_bar.py",
    "cases/f3of/compute_database.py",  # ends at once where Capytaine is missing
    "cases/f3of/mesh.py",
    "docs/axes_figure.py",
    "docs/reference.py",
    "tests/benchmark/lines_beside_moordyn.py",  # likewise without MoorDyn
)


@pytest.fixture(scope="module")
def commands(repository: Path) -> list[Command]:
    return all_commands(repository)


def test_commands_are_found_in_pages_docstrings_and_sentences(commands: list[Command]) -> None:
    found = {(c.source, c.plain.split("  #")[0].strip()) for c in commands}
    assert (
        "docs/performance.md",
        ".venv/bin/python tests/benchmark/hexagonal_arrays.py -o docs/arrays.png",
    ) in found
    assert ("cases/f3of/free_base.py", "python cases/f3of/free_base.py") in found
    assert ("docs/fmu.md", "hydrodae fmu") in found
    assert len(commands) > 200


def test_every_command_can_be_parsed(commands: list[Command], repository: Path) -> None:
    """Programs, scripts, options and words are known; a file of one's own need not be there."""
    wrong = {f"{c.source}:{c.line}: {c.plain}": problem(c, repository) for c in commands}
    assert {place: why for place, why in wrong.items() if why} == {}


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("hydrodae run case.toml --output-file x.h5", "unrecognized arguments"),
        ("hydrodae steer case.toml", "invalid choice"),
        ("python cases/control/delay.py --picture x.png", "unrecognized arguments"),
        ("python cases/4n3la/four_nodes.py figures", "invalid choice"),
        ("python cases/control/no_such.py", "no cases/control/no_such.py"),
        ("pytest tests/python/test_no_such.py", "no tests/python/test_no_such.py"),
        ("python tests/conftest.py", "does not parse its arguments"),
        ("hydrodea run case.toml", "unknown program"),
    ],
)
def test_a_renamed_option_or_script_is_found(text: str, why: str, repository: Path) -> None:
    assert why in problem(Command("page.md", 1, text), repository)


def test_every_script_names_its_command_and_parses_its_arguments(repository: Path) -> None:
    for script in scripts(repository):
        text = script.read_text()
        name = script.relative_to(repository).as_posix()
        if 'if __name__ == "__main__"' in text and not re.match(
            "tests/(attack|fuzz|stability)/", name
        ):
            assert list(of_script(script, name)), name
            assert parses_arguments(script), name


def test_quick_commands_run(commands: list[Command], repository: Path, tmp_path: Path) -> None:
    """Each passes, or says in one line which extra it lacks; all in one copy of the repository."""
    chosen = [c for c in commands if c.source in QUICK]
    assert {c.source for c in chosen} == set(QUICK)
    for outcome in run_group(chosen, repository, tmp_path / "copy", limit=60.0):
        assert outcome.status in ("passed", "lacks"), str(outcome)


@pytest.mark.parametrize(
    ("command", "says"),
    [
        ("tests/benchmark/memory_fits.py cubes_heave", "no reference data in"),
        ("tests/benchmark/bem_codes.py cylinder", "no reference data in"),
        ("tests/benchmark/radiation_ladder.py rm3", "rm3 left out: no reference data in"),
        ("cases/wecccomp/make_database.py REFERENCE", "No such file or directory"),
        ("cases/tank_section/reduce.py REFERENCE", "No such file or directory"),
        ("cases/9n9la/nine_nodes.py checks", "hydro.h5"),
        ("cases/wecccomp/score.py --seas 1 --database none.h5", "none.h5"),
    ],
)
def test_what_is_missing_is_one_line(
    command: str,
    says: str,
    repository: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfd: pytest.CaptureFixture[str],
) -> None:
    """In a clone without reference data and databases; no exception but the end of the script."""
    script, *words = command.split()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HYDRODAE_REFERENCE", str(tmp_path / "none"))
    monkeypatch.syspath_prepend(str((repository / script).parent))
    monkeypatch.setattr(sys, "argv", [str(repository / script), *words])
    code: object = 0
    try:
        runpy.run_path(str(repository / script), run_name="__main__")
    except SystemExit as end:
        code = end.code
    assert says in "".join(capfd.readouterr())
    assert code in ((0, None) if "left out" in says else (2,))


def test_a_page_has_all_that_its_commands_need(commands: list[Command]) -> None:
    """A command that another page has too runs in both; that of a docstring once."""
    groups = to_run(commands)
    database = "python cases/4n3la/four_nodes.py database"
    for name in ("cases/4n3la", "cases/9n9la", "docs/sweeps.md"):
        assert [bare(c) for c in groups[name]].count(database) == 1, name
    assert "tests/benchmark/hexagonal_arrays.py" not in groups  # docs/performance.md


def test_line_numbers_are_those_of_the_page(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "# A\n\n<!-- not run: minutes -->\n\n```sh\nhydrodae run a \\\n  -o b\n\n"
        "python c.py\n```\n\nSee `hydrodae keys`.\n"
    )
    found = [(c.line, " ".join(c.text.split()), c.reason) for c in of_page(page, "page.md")]
    assert found == [
        (7, "hydrodae run a -o b", "minutes"),
        (9, "python c.py", "minutes"),
        (12, "hydrodae keys", ""),
    ]
