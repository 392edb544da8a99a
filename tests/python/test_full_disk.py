"""What a run leaves on a full disk."""

from __future__ import annotations

import re
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from tests.python.output_runs import spring_case, springs

from hydrodae.results import Results, partial_path


@pytest.fixture
def case(tmp_path: Path) -> Path:
    return spring_case(tmp_path)


def limited(kilobytes: int) -> Callable[[], None]:
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (1024 * kilobytes, 1024 * kilobytes))

    return limit


@pytest.mark.parametrize("way", ["solve", "cli"])
@pytest.mark.parametrize("kilobytes", [1, 60, 400, 1500, 5000])
def test_a_full_disk_is_one_message_and_keeps_what_was_written(
    executable, tmp_path, way, kilobytes
):
    case, output = tmp_path / "case.toml", tmp_path / "out.h5"
    case.write_text(springs(4, 100.0, 0.01))
    command = [executable] if way == "solve" else [sys.executable, "-m", "hydrodae", "run"]
    run = subprocess.run(
        [*command, case, "-o", output, "--quiet"],
        check=False,
        capture_output=True,
        text=True,
        preexec_fn=limited(kilobytes),
    )
    assert "File too large" in run.stderr
    assert run.stderr.count("\n") <= 2
    if run.returncode == 2:  # not even a file without samples has room
        assert not output.exists()
        assert not partial_path(output).exists()
        assert kilobytes <= 60
        return
    assert run.returncode == 3
    results = Results.read(output)
    assert results.status == "failed"
    assert "File too large" in results.message
    if len(results.time) == 0:
        assert "it keeps no sample" in run.stderr
        assert kilobytes <= 400
        return
    found = re.search(r"samples up to t = (\S+) s", run.stderr)
    assert found
    assert results.end_time == float(found[1])
    for name in results:
        assert np.all(np.isfinite(results[name]))


@pytest.mark.parametrize("way", ["solve", "cli"])
def test_standard_output_that_is_full_is_told(case, executable, tmp_path, way):
    command = [executable] if way == "solve" else [sys.executable, "-m", "hydrodae", "run"]
    with open("/dev/full", "w") as full:
        run = subprocess.run(
            [*command, case, "-o", tmp_path / "out.h5"],
            check=False,
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
        )
    assert run.returncode == 2
    assert len(run.stderr.strip().splitlines()) == 1
    assert Results.read(tmp_path / "out.h5").status == "completed"


def test_a_page_that_does_not_fit_is_named_and_leaves_the_older_one(tmp_path):
    page = tmp_path / "page.html"
    page.write_text("older")
    script = (
        "from pathlib import Path\n"
        "from hydrodae.commands.cli import guarded\n"
        "from hydrodae.support import outputs\n"
        f"code = guarded(lambda: outputs.write_text(Path({str(page)!r}), 'x' * 100_000))\n"
        "raise SystemExit(code)\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", script],
        check=False,
        capture_output=True,
        text=True,
        preexec_fn=limited(20),
    )
    assert run.returncode == 2
    assert run.stderr == f"hydrodae: {page}: File too large\n"
    assert [path.name for path in tmp_path.iterdir()] == ["page.html"]
    assert page.read_text() == "older"
