"""Commands and code blocks of the documentation, as they stand there."""

from __future__ import annotations

import json
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from tests.errors import wrong
from tests.python.doc_blocks import all_blocks, blocks, command_lines, pages
from tests.python.test_tcp import free_port

import hydrodae
from hydrodae import _core
from hydrodae.commands import cli
from hydrodae.starters import create
from hydrodae.study.sweep.plan import read_study
from hydrodae.study.sweep.problem import read_problem

#: Pages whose Python blocks run from the root of the repository, one after the other.
RUN = (
    *("docs/results.md", "docs/forces.md", "docs/pto.md"),
    *("docs/sweeps.md", "docs/view.md", "docs/databases.md", "docs/flexible.md"),
    "docs/chambers.md",
)
#: Names that a page takes as given.
GIVEN = {"docs/databases.md": {"omega": [2.0, 2.5, 3.0, 3.5]}}
#: Pages whose calls of hydrodae run one after the other; `cd` changes the folder.
RUN_COMMANDS = (
    "docs/architecture.md",
    "docs/axes.md",
    "docs/cases.md",
    "docs/chambers.md",
    "docs/commands.md",
    "docs/control.md",
    "docs/conventions.md",
    "docs/databases.md",
    "docs/extremes.md",
    "docs/faq.md",
    "docs/first_steps.md",
    "docs/flexible.md",
    "docs/forces.md",
    "docs/glossary.md",
    "docs/install.md",
    "docs/ladders.md",
    "docs/limits.md",
    "docs/methods.md",
    "docs/performance.md",
    "docs/reference/README.md",
    "docs/spectral.md",
    "docs/sweeps.md",
    "docs/theory.md",
    "docs/view.md",
)
#: Blocks that a test of their own runs, by page and language: how many there are.
RUN_APART = {
    ("README.md", "toml"): 1,  # test_readme.py
    ("README.md", "python"): 1,
    ("docs/python.md", "python"): 4,  # test_functions.py
    ("docs/calibrate.md", "python"): 2,  # test_calibrate_command.py
    ("docs/calibrate.md", "sh"): 2,
    ("docs/records.md", "python"): 3,  # test_record_command.py
    ("docs/records.md", "sh"): 3,
    ("docs/spectral.md", "python"): 1,
    ("docs/drift.md", "python"): 1,
    ("docs/drift.md", "sh"): 1,
    ("docs/second_order.md", "python"): 1,
    ("docs/second_order.md", "sh"): 2,
    ("docs/control.md", "python"): 3,
    ("docs/extending.md", "python"): 1,
    ("docs/conventions.md", "python"): 1,
    ("docs/closed_loop.md", "sh"): 3,
    ("docs/closed_loop.md", "python"): 3,
    ("docs/fmu.md", "sh"): 1,
    ("docs/fmu.md", "python"): 1,
    ("docs/tcp.md", "python"): 1,
    ("docs/tcp.md", "json"): 3,
    ("docs/install.md", "cmake"): 1,
    ("docs/install.md", "cpp"): 1,
    ("docs/extending.md", "cpp"): 1,
    ("cases/plugin/README.md", "sh"): 1,
    ("python/hydrodae/starters/README.md", "sh"): 1,
}


def test_every_block_is_run_or_says_why_not(repository: Path) -> None:
    """A block of a new kind or on a new page needs a test, or `<!-- not run: REASON -->`."""
    found: dict[tuple[str, str], int] = {}
    for page in pages(repository):
        name = page.relative_to(repository).as_posix()
        assert page.read_text().count("```") == 2 * len(all_blocks(page)), name
        for block in all_blocks(page):
            where = (name, block.language)
            by_page = {"python": RUN, "sh": RUN_COMMANDS}.get(block.language, ())
            # output and equations; tables are read, those of a whole page together
            told = block.language == "text" or (block.language == "toml" and name != "README.md")
            if not (block.reason or name in by_page or told):
                found[where] = found.get(where, 0) + 1
    assert found == RUN_APART


def test_every_page_begins_with_its_purpose_and_an_example(repository: Path) -> None:
    """A paragraph, and code within one screen of text."""
    for page in [*(repository / "docs").glob("*.md"), repository / "docs/reference/README.md"]:
        text = re.sub(r"^<!--.*?-->\n\n", "", page.read_text())
        title, purpose, _ = text.split("\n\n", 2)
        assert title.startswith("# "), page.name
        assert re.match(r"[A-Z`]", purpose), page.name
        start = "\n".join(text.splitlines()[:25])
        assert re.search(r"^```(sh|python|toml)$", start, re.MULTILINE), page.name


def test_no_code_stands_in_indented_blocks(repository: Path) -> None:
    for page in pages(repository):
        text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.DOTALL | re.MULTILINE)
        assert not re.findall(r"\n\n    \S.*", text), page.name


def test_every_table_of_the_pages_is_one_that_the_kernel_reads(repository: Path) -> None:
    for page in pages(repository):
        for text in blocks(page, "toml"):
            if page.name not in ("sweeps.md", "calibrate.md"):  # studies, and files of tests
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


def run_lines(lines: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Run calls of hydrodae; every line has to be one, or to change the folder."""
    assert lines
    for line in lines:
        words = shlex.split(line, comments=True)
        if words[0] == "cd":
            monkeypatch.chdir(words[1])
        else:
            assert words[0] == "hydrodae", line
            assert cli.main(words[1:]) == 0, line


@pytest.mark.parametrize("name", RUN_COMMANDS)
def test_commands_of_a_page_run(name, repository, tmp_path, monkeypatch) -> None:
    (tmp_path / "cases").symlink_to(repository / "cases")
    monkeypatch.chdir(tmp_path)
    run_lines(command_lines(repository / name), monkeypatch)


def test_commands_of_the_page_in_every_starter_run(repository, tmp_path, monkeypatch) -> None:
    """But for the sweep, which takes minutes; test_starters.py has one of few points."""
    monkeypatch.chdir(create("point_absorber", tmp_path / "case").parent)
    lines = command_lines(repository / "python" / "hydrodae" / "starters" / "README.md")
    assert sum("sweep" in line for line in lines) == 1
    run_lines([line for line in lines if "sweep" not in line], monkeypatch)


def test_commands_of_the_page_for_plugins_run(repository, tmp_path, monkeypatch) -> None:
    if shutil.which("c++") is None:
        pytest.skip("needs a C++ compiler")
    shutil.copytree(repository / "cases" / "plugin", tmp_path / "cases" / "plugin")
    (tmp_path / "cpp").symlink_to(repository / "cpp")
    monkeypatch.chdir(tmp_path)
    compiler, *lines = command_lines(repository / "cases" / "plugin" / "README.md")
    subprocess.run(shlex.split(compiler), check=True)
    run_lines(lines, monkeypatch)


def test_page_for_closed_loops_runs(repository, tmp_path, monkeypatch, capsys) -> None:
    """Its blocks in their order; its case file is what its Python writes."""
    monkeypatch.chdir(tmp_path)
    page = repository / "docs" / "closed_loop.md"
    known: dict[str, object] = {}
    said, expected, case = "", [], {}
    for block in all_blocks(page):
        if block.language == "text" and block.text.startswith("  "):
            expected += block.text.splitlines()
        elif block.language == "toml":
            case = tomllib.loads(block.text)
        elif block.language == "python":
            exec(compile(block.text, page.name, "exec"), known)
        elif block.language == "sh" and not block.reason:
            run_lines(block.text.splitlines(), monkeypatch)
        said += capsys.readouterr().out
    assert case == tomllib.loads(Path("cylinder.toml").read_text())
    assert len(expected) == 9
    assert set(expected) <= set(said.splitlines())
    load, apart = re.findall(r"pin (\d+) kN.*\n(\S+)$", said, re.MULTILINE)[0]
    assert float(apart) < 1e-4 * 1e3 * float(load)  # N, kN
    with wrong("joint.pin"):
        hydrodae.check("cylinder.toml", set={"joint.cylinder.initial.displacement": 1.0})


def test_page_for_drift_runs(tmp_path, repository, monkeypatch, capsys) -> None:
    """Its Python reads the database that its commands make; `check` accepts its table."""
    monkeypatch.chdir(tmp_path)
    page = repository / "docs" / "drift.md"
    run_lines(command_lines(page), monkeypatch)
    assert "that of this device" in capsys.readouterr().out
    known: dict[str, object] = {}
    exec(compile(blocks(page, "python")[0], "drift.md", "exec"), known)
    assert known["found"].error < 1e-3  # type: ignore[attr-defined]


def test_page_for_second_order_runs(repository, tmp_path, monkeypatch, capsys) -> None:
    """Its commands on its case; what it shows is printed."""
    monkeypatch.chdir(tmp_path)
    page = repository / "docs" / "second_order.md"
    *before, drift, rao = command_lines(page)
    run_lines(before, monkeypatch)
    (case,) = blocks(page, "toml")
    Path("moored.toml").write_text(case)
    run_lines([drift], monkeypatch)
    capsys.readouterr()
    run_lines([rao], monkeypatch)
    said = capsys.readouterr().out.splitlines()
    shown = next(text for text in blocks(page, "text") if "mean offset" in text)
    assert set(shown.splitlines()) <= set(said)
    known: dict[str, object] = {}
    exec(compile(blocks(page, "python")[0], page.name, "exec"), known)
    assert known["found"].offset["bodies/buoy/surge"] > 0.0  # type: ignore[attr-defined]


def test_page_for_fmus_runs(repository, tmp_path, monkeypatch) -> None:
    pytest.importorskip("fmpy", reason="needs the extra cosim")
    (tmp_path / "cases").symlink_to(repository / "cases")
    monkeypatch.chdir(tmp_path)
    page = repository / "docs" / "fmu.md"
    run_lines(command_lines(page), monkeypatch)
    known: dict[str, object] = {}
    exec(compile(blocks(page, "python")[0], "fmu.md", "exec"), known)
    assert known["result"]["time"][-1] == 100.0  # type: ignore[index]


def test_page_for_tcp_runs(repository, tmp_path) -> None:
    """Its controller beside a run of `cases/control` with its table; its handshakes are JSON."""
    page, port = repository / "docs" / "tcp.md", free_port()
    (code,), (table,) = blocks(page, "python"), blocks(page, "toml")
    hello, *answers = map(json.loads, blocks(page, "json"))
    assert {said["protocol"] for said in (hello, *answers)} == {"hydrodae"}
    assert "port = 50000" in table
    assert "port=50000" in code
    text = (repository / "cases" / "control" / "case.toml").read_text()
    start, end = text.index("[[controller]]"), text.index("[solver]")
    case = tmp_path / "case.toml"
    case.write_text(text[:start] + table.replace("50000", str(port)) + text[end:])
    other = [sys.executable, "-c", code.replace("50000", str(port))]
    with subprocess.Popen(other, stderr=subprocess.PIPE, text=True) as controller:
        results = hydrodae.run(case)
        _, said = controller.communicate(timeout=60)
    assert results.status == "completed"
    assert controller.returncode == 0, said


def test_page_for_conventions_runs(repository, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = (repository / "README.md").read_text().split("```toml\n")[1].split("```")[0]
    case = hydrodae.Case.from_text(text, directory=repository)
    hydrodae.run(case, "run.h5", set={"solver.end_time": 2.0})
    known: dict[str, object] = {}
    (code,) = blocks(repository / "docs" / "conventions.md", "python")
    exec(compile(code, "conventions.md", "exec"), known)
    assert known["in_world"].shape[1] == 3  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("page", "language", "sources"),
    [
        ("install", "cmake", ["tests/package/CMakeLists.txt"]),
        ("install", "cpp", ["tests/package/main.cpp"]),
        ("extending", "cpp", ["cpp/hydrodae/joint/types.h"]),
    ],
)
def test_code_in_other_languages_stands_in_the_sources(page, language, sources, repository) -> None:
    """`tests/package/run.sh` and the build compile it there."""

    def bare(text: str) -> str:
        return re.sub(r"\s+", "", re.sub(r"(//|#(?!include)).*", "", text))

    shown = blocks(repository / "docs" / f"{page}.md", language)
    source = bare("\n".join((repository / name).read_text() for name in sources))
    for line in "\n".join(shown).splitlines():
        assert bare(line) in source, line


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
    law, device, predictive = blocks(docs / "control.md", "python")
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
    pytest.importorskip("osqp", reason="needs the extra control")
    Path("case.toml").write_text(text[:start] + own.replace("0.05", "0.1") + text[end:])
    exec(compile(predictive, "control.md", "exec"), known)
    assert known["results"].status == "completed"  # type: ignore[attr-defined]


def test_the_page_of_the_tests_names_what_is_there(repository):
    """Its folders are those of tests/, and the files that its tables name exist."""
    tests = repository / "tests"
    text = (tests / "README.md").read_text()
    named = set(re.findall(r"^\| `(\w+)/` \|", text, re.M))
    assert named == {p.name for p in tests.iterdir() if p.is_dir() and p.name[0] not in "_."}
    files = {p.stem for p in tests.rglob("*.py")}
    assert set(re.findall(r"`(test_\w+)`", text)) <= files
    assert {f"test_hdb{name}" for name in re.findall(r"`(_\w+)`", text)} <= files
