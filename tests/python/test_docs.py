"""Commands and code blocks of the documentation, as they stand there."""

from __future__ import annotations

import re
import shlex
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

import hydrodae
from hydrodae import _core, cli
from hydrodae.starters import create
from hydrodae.study.sweep.plan import read_study
from hydrodae.study.sweep.problem import read_problem

#: Pages whose Python blocks run from the root of the repository, one after the other; those of
#: python.md run in test_functions.py, that of tcp.md needs a program at the other end.
RUN = ("docs/results.md", "docs/forces.md", "docs/sweeps.md", "docs/view.md", "docs/databases.md")
#: Names that a page takes as given.
GIVEN = {"docs/databases.md": {"omega": [2.0, 2.5, 3.0, 3.5]}}
#: Pages whose calls of hydrodae run one after the other; `cd` changes the folder.
RUN_COMMANDS = ("docs/commands.md", "docs/first_steps.md", "docs/control.md")


def pages(repository: Path) -> list[Path]:
    found = [repository / "README.md", *(repository / "docs").glob("*.md")]
    found += (repository / "cases").glob("*/README.md")
    return [*found, repository / "python" / "hydrodae" / "starters" / "README.md"]


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", page.read_text(), re.DOTALL | re.MULTILINE)


def commands(page: Path) -> Iterator[list[str]]:
    """Arguments of every line that calls hydrodae, in a block or indented; without comments."""
    indented = re.findall(r"^    \S.*$", page.read_text(), re.MULTILINE)
    text = "\n".join([*blocks(page, "sh"), *indented]).replace("\\\n", " ")
    for line in text.splitlines():
        found = re.fullmatch(r"(?:\S*/)?hydrodae (.*)", line.strip())
        if found:
            yield shlex.split(found[1], comments=True)


def can_be_parsed(arguments: list[str]) -> bool:
    try:
        cli._parser(arguments[:1]).parse_args(arguments)
    except SystemExit as end:  # of --help and --version, or a wrong argument
        return end.code == 0
    return True


def test_every_command_of_the_pages_can_be_parsed(repository: Path) -> None:
    number = 0
    for page in pages(repository):
        for arguments in commands(page):
            told = f"{page.name}: hydrodae {shlex.join(arguments)}"
            assert can_be_parsed(arguments), told
            number += 1
    assert number > 25


def test_every_table_of_the_pages_is_one_that_the_kernel_reads(repository: Path) -> None:
    for page in pages(repository):
        for text in blocks(page, "toml"):
            if page.name != "sweeps.md":
                _core.check_tables(text)


def test_studies_of_the_pages_can_be_read(repository: Path, tmp_path: Path) -> None:
    pytest.importorskip("rainflow")
    study, *more, problem = blocks(repository / "docs" / "sweeps.md", "toml")
    squid = repository / "cases" / "4n3la" / "take_offs.toml"
    assert tomllib.loads(problem) == tomllib.loads(squid.read_text())
    assert read_problem(squid).maximise
    (tmp_path / "scatter.csv").write_text("height,period,hours\n1.0,6.0,100\n")
    (tmp_path / "study.toml").write_text(study + "\n".join(more))
    found = read_study(tmp_path / "study.toml")
    assert len(found.points) == 4 * 8 * 10
    assert {measure.name for measure in found.measures} == {"flap", "hinge_fatigue"}
    assert found.scatter is not None


@pytest.mark.parametrize("name", RUN)
def test_code_of_a_page_runs(name, repository, tmp_path, monkeypatch, capsys) -> None:
    (tmp_path / "cases").symlink_to(repository / "cases")
    monkeypatch.chdir(tmp_path)
    known: dict[str, object] = dict(GIVEN.get(name, {}))
    for text in blocks(repository / name, "python"):
        exec(compile(text, name, "exec"), known)
    assert capsys.readouterr().out.strip()


@pytest.mark.parametrize("name", RUN_COMMANDS)
def test_commands_of_a_page_run(name, repository, tmp_path, monkeypatch) -> None:
    (tmp_path / "cases").symlink_to(repository / "cases")
    monkeypatch.chdir(tmp_path)
    done = 0
    for line in "".join(blocks(repository / name, "sh")).splitlines():
        words = shlex.split(line, comments=True)
        if words[0] == "cd":
            monkeypatch.chdir(words[1])
        elif words[0] == "hydrodae":
            assert cli.main(words[1:]) == 0, line
            done += 1
    assert done > 0


def test_code_of_the_page_for_spectral_runs(repository, tmp_path, monkeypatch, capsys) -> None:
    """On a starter, whose buoy has the name that the page has."""
    case = create("point_absorber", tmp_path / "case")
    monkeypatch.chdir(case.parent)
    text = case.read_text().replace('name = "buoy"', 'name = "float"')
    case.write_text(text.replace('body_b = "buoy"', 'body_b = "float"'))
    (code,) = blocks(repository / "docs" / "spectral.md", "python")
    exec(compile(code, "spectral.md", "exec"), {})
    assert "difference" in capsys.readouterr().out


def test_code_of_the_pages_for_controllers_and_forces_runs(
    repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The case of `cases/control` with the tables that the pages show."""
    docs = repository / "docs"
    text = (repository / "cases" / "control" / "case.toml").read_text()
    own = next(block for block in blocks(docs / "control.md", "toml") if '"python"' in block)
    start, end = text.index("[[controller]]"), text.index("[solver]")
    monkeypatch.chdir(tmp_path)
    Path("case.toml").write_text(text[:start] + own + text[end:])
    known: dict[str, object] = {"hydrodae": hydrodae}
    law, device = blocks(docs / "control.md", "python")[:2]
    exec(compile(law, "control.md", "exec"), known)
    assert known["results"].status == "completed"  # type: ignore[attr-defined]
    Path("case.toml").write_text(text[:start] + text[end:])
    exec(compile(device, "control.md", "exec"), known)
    run = known["Device"]()  # type: ignore[operator]
    assert len(run.reset()) == 2
    assert run.step(-1.0e3)[2] is False
    brake = '[[force]]\nname = "brake"\ntype = "python_load"\njoint = "slide"\n'
    Path("case.toml").write_text(text[:start] + brake + text[end:])
    (call,) = blocks(docs / "extending.md", "python")
    exec(compile(call, "extending.md", "exec"), known)
