"""Runs that write a file: masses on springs, other processes, ways to be refused."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

import hydrodae
from hydrodae.commands import cli
from hydrodae.errors import CaseError


def springs(count: int, end_time: float, step: float) -> str:
    """Masses on springs of their own: a case of as many channels as are wanted."""
    text = 'title = "springs"\n'
    for i in range(count):
        text += f"""
[[body]]
name = "b{i}"
motion = "heave"
mass = 10.0
center_of_gravity = [{i}, 0, 0]
initial = {{ displacement = [0, 0, 1] }}

[[force]]
name = "s{i}"
type = "mooring_matrix"
body = "b{i}"
stiffness = [0, 0, 90, 0, 0, 0]
pretension = [0, 0, 98.1, 0, 0, 0]
"""
    return text + f"\n[solver]\nend_time = {end_time}\n\n[output]\nstep = {step}\n"


def spring_case(folder: Path) -> Path:
    """A case of four seconds."""
    path = folder / "spring.toml"
    path.write_text(springs(1, 4.0, 0.5))
    return path


def run_child(
    case: Path, output: Path, progress: str = "None", log: Path | None = None
) -> subprocess.Popen[str]:
    """A Python process that runs `case`; `progress` is an expression in `t` and `write`."""
    code = f"""
import os, sys, time
import hydrodae

log = os.open({str(log or os.devnull)!r}, os.O_WRONLY | os.O_CREAT | os.O_APPEND)

def write(*words):
    os.write(log, (" ".join(map(str, words)) + "\\n").encode())

def progress(t, end):
    return {progress}

try:
    hydrodae.run({str(case)!r}, {str(output)!r}, progress=progress)
except hydrodae.HydrodaeError as error:
    sys.exit(f"{{type(error).__name__}}: {{error}}")
"""
    return subprocess.Popen([sys.executable, "-c", code], stderr=subprocess.PIPE, text=True)


def wait_for(condition: Callable[[], object]) -> None:
    """Wait until something is so; a minute at most."""
    for _ in range(6000):
        if condition():
            return
        time.sleep(0.01)
    pytest.fail("waited for a minute")


def refused(way, case, output, executable, capsys):
    """Run the case by one of three ways, which has to fail; returns the message."""
    if way == "run":
        with pytest.raises(CaseError) as caught:
            hydrodae.run(case, output)
        return str(caught.value)
    if way == "cli":
        assert cli.main(["run", str(case), "-o", str(output)]) == 2
        return capsys.readouterr().err
    process = subprocess.run(
        [executable, case, "-o", output], check=False, capture_output=True, text=True
    )
    assert process.returncode == 2
    assert process.stdout == ""
    return process.stderr
