"""hydrodae-solve: what it prints, what is wrong with a command line, exit codes."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import pytest
from tests.python.small_database import CASE, write_case

from hydrodae import _core
from hydrodae.starters import create


@pytest.fixture
def case(tmp_path: Path) -> Path:
    return write_case(tmp_path)


def solve(executable: str, *arguments: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [executable, *map(str, arguments)], capture_output=True, text=True, check=False
    )


def test_the_executable_runs_a_case(executable, case):
    output = case.parent / "results.h5"
    run = solve(executable, case, "-o", output, "--set", "solver.end_time=2", "--quiet")
    assert run.returncode == 0, run.stderr
    done, method, error = run.stdout.splitlines()
    assert done.startswith("completed at t = 2 s: ")
    assert done.endswith(f"results in {output}")
    assert method.startswith("method auto: ")
    assert error == "at rest"
    assert run.stderr == ""
    with h5py.File(output) as file:
        assert file["time"][-1] == pytest.approx(2.0)
        assert len(file.attrs["hydro_sha256"]) == 64


def test_the_executable_checks_a_case(executable, case):
    run = solve(executable, "--check", case)
    assert run.returncode == 0
    scene = _core.load_case(str(case), {})
    assert run.stdout == _core.examine(scene, {})
    assert run.stdout.startswith(scene.summary())
    assert "mobility: 1 degrees of freedom" in run.stdout


@pytest.mark.parametrize("flag", ["--help", "--version"])
def test_the_executable_tells_about_itself(executable, flag):
    run = solve(executable, flag)
    assert run.returncode == 0
    assert "hydrodae" in run.stdout


def test_the_executable_lists_keys(executable):
    assert "  force " in solve(executable, "--keys").stdout
    assert "pto_linear" in solve(executable, "--keys", "force").stdout
    run = solve(executable, "--keys", "force", "pto_linear")
    assert run.returncode == 0
    assert "  damping [N s/m or N m s/rad] (default 0, >= 0)\n      Damping c.\n" in run.stdout


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["--keys", "sover"], "there is no table 'sover'; did you mean 'solver'?"),
        (["--keys", "joint", "revolut"], "did you mean 'revolute'?"),
        (["--keys", "solver", "ida"], "the table 'solver' has no types"),
        (["--keys", "joint", "fixed", "x"], "unexpected argument 'x'"),
        ([], "a case file is missing"),
        (["CASE"], "-o RESULTS is missing"),
        (["CASE", "-o"], "-o: a value is missing"),
        (["CASE", "-o", "x.h5", "--sett", "a=1"], "unexpected argument '--sett'"),
        (["CASE", "-o", "x.h5", "--set", "solver.rtol"], "expected KEY=VALUE"),
        (["CASE", "-o", "x.h5", "--set", "solver.rtl=1"], "did you mean 'rtol'?"),
        (["none.toml", "-o", "x.h5"], "none.toml: cannot read the case file"),
    ],
)
def test_a_wrong_command_line_is_exit_code_2(executable, case, arguments, expected):
    run = solve(executable, *[str(case) if a == "CASE" else a for a in arguments])
    assert run.returncode == 2
    assert run.stdout == ""
    assert run.stderr.startswith("hydrodae-solve: ")
    assert expected in run.stderr


def test_a_solver_failure_is_exit_code_3(executable, case):
    anti_spring = """
[[force]]
name = "anti"
type = "mooring_matrix"
body = "buoy"
stiffness = [0, 0, -1e9, 0, 0, 0]
"""
    case.write_text(CASE + anti_spring)
    output = case.parent / "results.h5"
    values = ["body.buoy.initial.displacement=[0,0,1]", "solver.method=explicit_rk"]
    run = solve(executable, case, "-o", output, *(w for v in values for w in ("--set", v)))
    assert run.returncode == 3, run.stdout
    assert "stopped at t = " in run.stderr
    with h5py.File(output) as file:
        assert file.attrs["status"] == "failed"


def test_an_interrupt_is_exit_code_4(executable, case):
    output = case.parent / "results.h5"
    command = [executable, str(case), "-o", str(output), "--set", "solver.end_time=1e8", "--quiet"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        while not output.with_name("results.partial.h5").exists():
            time.sleep(0.01)
        time.sleep(0.1)
        process.send_signal(signal.SIGINT)
        said, _ = process.communicate(timeout=20)
    assert process.returncode == 4
    assert said.startswith("interrupted at t = ")
    with h5py.File(output) as file:
        assert file.attrs["status"] == "interrupted"
        assert len(file["time"]) > 1


def test_the_memory_does_not_grow_with_the_length_of_a_run(executable, tmp_path):
    case = create("flap", tmp_path / "flap")
    peaks = []
    for end in (500, 10000):
        words = [executable, str(case), "--quiet", "-o", str(tmp_path / "r.h5")]
        run = subprocess.Popen([*words, "--set", f"solver.end_time={end}"])
        _, status, usage = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
        assert run.returncode == 0
        peaks.append(usage.ru_maxrss / (1e6 if sys.platform == "darwin" else 1e3))  # MB
    assert peaks[1] < peaks[0] + 16.0, peaks  # tables over the whole time: 120 MB more
