"""The command line: exit codes, messages on stderr, progress."""

from __future__ import annotations

import errno
import io
import os
import re
import warnings

import pytest
from rich.console import Console

from hydrodae.commands import cli
from hydrodae.results import Results
from hydrodae.support import progress
from hydrodae.support.progress import ProgressLine

REFERENCE_CURVE = "t_s,a_deg,b_deg\n0,10,\n7,-9,8\n14,8.5,7\n"


def test_run_prints_a_summary_and_the_path(kernel, case_file, tmp_path, capsys):
    output = tmp_path / "out" / "decay.h5"
    assert cli.main(["run", str(case_file), "-o", str(output), "--set", "solver.rtol=1e-8"]) == 0
    printed = capsys.readouterr()
    lines = printed.out.splitlines()
    assert lines[0] == "Flap decay: 10 s simulated"
    assert any("joints/hinge1/angle" in line and "deg" in line for line in lines)
    assert lines[-1] == f"  results in {output}"
    assert printed.err == ""  # a short run shows no progress
    assert kernel.overrides == {"solver.rtol": "1e-08"}


def test_run_writes_beside_the_case_by_default_and_can_be_quiet(kernel, case_file, capsys):
    assert cli.main(["run", str(case_file), "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")
    assert Results.read(case_file.with_suffix(".h5")).status == "completed"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "{folder}/flap_deacy.toml"], "did you mean {folder}/flap_decay.toml?"),
        (["run", "{case}", "--set", "solver.rtol"], "expected key=value"),
        (["run", "{case}", "--set", "slover.rtol=1"], "unknown key slover.rtol; the nearest"),
        (["run", "{case}", "-o", "{case}/out.h5"], "flap_decay.toml"),
        (["run", "{case}", "-o", "{folder}/a.png"], "then hydrodae plot {folder}/a.h5 -o"),
        (["run", "{case}", "-o", "{folder}/a.mat"], "then MATLAB reads it: h5read('{folder}/a.h5'"),
        (["run", "{case}", "-o", "{folder}/a.html"], "then hydrodae report {folder}/a.h5 -o"),
        (["plot", "{folder}/none.h5"], "no such results file"),
        (["plot", "{results}", "joints/hinge1/angel"], "nearest name is 'joints/hinge1/angle'"),
        (["plot", "{results}", "joints/*/torque"], "no channel matches 'joints/*/torque'"),
        (["plot", "{results}", "bodies/base/position.w"], "no component 'w'; it has x, y, z"),
        (["plot", "{results}", "-o", "{folder}/a.gif2"], "no such kind of picture"),
        (["plot", "{results}", "--compare", "{csv}:a_deg"], "exactly one CHANNEL"),
        (["plot", "{results}", "{angle}", "--compare", "{csv}"], "expected file.csv:column"),
        (["plot", "{results}", "{angle}", "--compare", "{csv}:a_dg"], "did you mean 'a_deg'?"),
        (["plot", "{results}", "{angle}", "--compare", "{csv}:a_deg:A:x"], "'x' is not a number"),
        (
            ["plot", "{results}", "{angle}", "--compare", "{folder}/no.csv:a"],
            "no.csv: no such file",
        ),
        (["plot", "{results}", "bodies/base/position", "--compare", "{csv}:a_deg"], "3 lines"),
    ],
)
def test_bad_input_is_one_block_on_stderr_and_exit_code_2(
    kernel, case_file, results_file, tmp_path, capsys, arguments, message
):
    csv = tmp_path / "curves.csv"
    csv.write_text(REFERENCE_CURVE)
    names = {
        "folder": tmp_path,
        "case": case_file,
        "results": results_file,
        "csv": csv,
        "angle": "joints/hinge1/angle",
    }
    assert cli.main([argument.format(**names) for argument in arguments]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("hydrodae: ")
    assert message.format(**names) in printed.err
    assert "Traceback" not in printed.err


def test_solver_failure_is_exit_code_3_and_says_what_is_kept(kernel, case_file, tmp_path, capsys):
    kernel.fail_at = 5.0
    output = tmp_path / "out.h5"
    assert cli.main(["run", str(case_file), "-o", str(output)]) == 3
    assert capsys.readouterr().err == (
        "hydrodae: t = 5.0 s: IDA_CONV_FAIL in joint hinge1\n"
        f"  results up to t = 5 s are in {output}\n"
    )


def test_interruption_is_exit_code_4(kernel, case_file, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(ProgressLine, "__call__", lambda self, time, end_time: time < 3)
    output = tmp_path / "out.h5"
    assert cli.main(["run", str(case_file), "-o", str(output)]) == 4
    assert capsys.readouterr().err == (
        f"hydrodae: stopped at t = 3 s of 10 s\n  results up to t = 3 s are in {output}\n"
    )


def test_a_file_that_cannot_be_written_is_named(results_file, capsys, monkeypatch):
    full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "run.png")
    monkeypatch.setattr("matplotlib.figure.Figure.savefig", lambda *_, **__: throw(full))
    assert cli.main(["plot", str(results_file)]) == 2
    assert capsys.readouterr().err == f"hydrodae: run.png: {full.strerror}\n"


def throw(error: BaseException) -> None:
    raise error


def test_our_own_bugs_are_not_hidden(kernel, case_file, monkeypatch):
    monkeypatch.setattr(kernel, "simulate", lambda *a: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        cli.main(["run", str(case_file)])


@pytest.mark.parametrize("arguments", [[], ["fly"], ["run"]])
def test_usage_errors_are_exit_code_2(arguments, capsys):
    with pytest.raises(SystemExit) as caught:
        cli.main(arguments)
    assert caught.value.code == 2
    assert "usage: hydrodae" in capsys.readouterr().err


def test_plot_writes_the_picture_that_it_names(results_file, tmp_path, capsys):
    assert cli.main(["plot", str(results_file)]) == 0
    assert capsys.readouterr().out == f"{results_file.with_suffix('.png')}\n"
    picture = tmp_path / "pictures" / "angle.svg"
    assert cli.main(["plot", str(results_file), "joints/hinge1/angle", "-o", str(picture)]) == 0
    assert picture.read_text().startswith("<?xml")


def test_plot_lists_channels_with_units(results_file, capsys):
    assert cli.main(["plot", str(results_file), "--list"]) == 0
    lines = [line.split() for line in capsys.readouterr().out.splitlines()]
    assert ["joints/hinge1/angle_rate", "rad/s"] in lines
    assert len(lines) == 17


def test_version(kernel, capsys):
    assert cli.main(["version"]) == 0
    assert re.fullmatch(
        r"hydrodae \S.* \(kernel 0\.1\.0, Python 3\.\d+\.\S+\)\n", capsys.readouterr().out
    )


class Clock:
    """Wall clock that jumps 2 s at every look."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        self.now += 2.0
        return self.now


def test_long_run_prints_plain_lines_now_and_then(monkeypatch, capsys):
    monkeypatch.setattr(progress, "monotonic", Clock())
    with ProgressLine("Flap decay") as line:
        for time in (10.0, 20.0, 30.0, 40.0):
            line(time, 100.0)
    # 6 s of wall time after the start 30 of 100 s are done
    assert capsys.readouterr().err == "Flap decay: 30 of 100 s, about 14 s to go\n"


def test_long_run_in_a_terminal_shows_a_bar(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(progress, "monotonic", Clock())
    console = Console(file=stream, force_terminal=True, width=100)
    monkeypatch.setattr("rich.console.Console", lambda **_: console)
    with ProgressLine("Flap decay") as line:
        line(10.0, 100.0)
        line(55.0, 100.0)
    assert "Flap decay" in stream.getvalue()
    assert "55 of 100 s" in stream.getvalue()


def test_warnings_are_one_line_each_without_a_place_in_the_source(capsys):
    from hydrodae.hdb.memory import MemoryFitWarning

    def work() -> None:
        warnings.simplefilter("always")
        for _ in range(2):
            warnings.warn("the first line\n  and the second", RuntimeWarning, stacklevel=1)
        warnings.warn("a fit is poor", MemoryFitWarning, stacklevel=1)

    assert cli.guarded(work) == 0
    assert capsys.readouterr().err == (
        "hydrodae: warning: the first line and the second\nhydrodae: note: a fit is poor\n"
    )
