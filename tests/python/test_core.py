"""The compiled kernel through its bindings: scenes, runs, interruption, errors, two HDF5s."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest

from hydrodae import _core
from hydrodae.errors import CaseError, SolverError

SPRING = """title = "heave on a spring"

[[body]]
name = "buoy"
motion = "heave"
mass = 10.0
center_of_gravity = [0, 0, 0]
initial = { displacement = [0, 0, 1] }

[[force]]
name = "spring"
type = "mooring_matrix"
body = "buoy"
stiffness = [0, 0, 90, 0, 0, 0]
pretension = [0, 0, 98.1, 0, 0, 0]  # carries the weight

[solver]
end_time = 4.0

[output]
step = 0.5
"""


def spring(**overrides: str) -> _core.Scene:
    """The spring case with values such as solver__rtol="1e-8"."""
    return _core.parse_case(
        SPRING, ".", {key.replace("__", "."): value for key, value in overrides.items()}
    )


@pytest.fixture
def output(tmp_path: Path) -> str:
    return str(tmp_path / "results.h5")


@pytest.fixture
def restored_handlers() -> Iterator[None]:
    """Handlers and timers of signals as they were."""
    before = {s: signal.getsignal(s) for s in (signal.SIGINT, signal.SIGALRM)}
    yield
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    for number, handler in before.items():
        signal.signal(number, handler)


def test_version_is_that_of_the_project(repository):
    text = (repository / "CMakeLists.txt").read_text()
    found = re.search(r"VERSION ([0-9.]+) LANGUAGES", text)
    assert found
    assert _core.version == found[1]


def test_a_scene_shows_what_it_holds():
    scene = spring()
    assert scene.title == "heave on a spring"
    assert scene.body_names == ["buoy"]
    assert scene.joint_names == []
    assert scene.end_time == 4.0
    assert scene.text == SPRING
    assert "heave on a spring" in repr(scene)
    assert "buoy: heave, 10 kg" in scene.summary()
    assert "spring: mooring_matrix on body buoy" in scene.summary()


def test_a_scene_tells_what_its_mechanism_does():
    text = SPRING.replace("initial = { displacement = [0, 0, 1] }", "").replace(
        "[solver]",
        """[[joint]]
name = "guide"
type = "prismatic"
body_a = "ground"
body_b = "buoy"
point = [0, 0, 0]
axis = [0, 0, 1]

[[constraint]]
name = "lift"
type = "coordinate"
joint = "guide"
drive = { amplitude = 0.1, period = 5 }

[[force]]
name = "rope"
type = "spring_damper"
body_a = "ground"
body_b = "buoy"
point_a = [0, 0, -3]
point_b = [0, 0, 0]

[solver]""",
    )
    scene = _core.parse_case(text, ".", {"constraint.lift.drive.ramp": "2"})
    assert scene.joint_names == ["guide"]
    motion = "displacement of guide follows 0.1 sin(2 pi t / 5) grown over 2 s"
    assert f"  constraints:\n    lift: {motion}\n" in scene.summary()
    assert "rope: spring_damper between ground and buoy" in scene.summary()


def test_a_scene_cannot_be_changed():
    with pytest.raises(AttributeError):
        spring().title = "other"  # type: ignore[misc]


def test_a_file_and_its_text_give_the_same_scene(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(SPRING)
    scene = _core.load_case(str(path), {"solver.end_time": "8.0"})
    assert scene.end_time == 8.0
    assert scene.summary() == spring(solver__end_time="8").summary()


def test_a_run_writes_its_results(output):
    statistics = _core.simulate(spring(solver__rtol="1e-8"), output, None, {})
    assert statistics["status"] == "completed"
    assert statistics["end_time"] == 4.0
    assert statistics["steps"] > 0
    assert statistics["wall_time"] >= statistics["setup_time"] > 0
    with h5py.File(output) as file:
        assert file.attrs["format"] == "hydrodae-results"
        assert file.attrs["format_version"] == 1
        assert file.attrs["status"] == "completed"
        assert file.attrs["version"] == _core.version
        assert "solver.rtol = 1e-8" in file.attrs["case_text"]
        assert file["solver"].attrs["steps"] == statistics["steps"]
        time = file["time"][()]
        position = file["bodies/buoy/position"]
        assert position.attrs["unit"] == "m"
        assert position.attrs["frame"] == "world"
        # m z'' = -k z, released from 1 m: z = cos(w t), w = sqrt(k/m) = 3 rad/s
        np.testing.assert_allclose(time, np.arange(9) * 0.5, atol=1e-14)
        np.testing.assert_allclose(position[:, 2], np.cos(3 * time), atol=2e-6)
        np.testing.assert_allclose(position[:, :2], 0.0, atol=0.0)


def test_a_run_needs_no_file():
    assert _core.simulate(spring(), "", None, {})["status"] == "completed"


def test_progress_hears_of_every_sample(output):
    calls: list[tuple[float, float]] = []

    def progress(t: float, end: float) -> bool:
        calls.append((t, end))
        return True

    _core.simulate(spring(), output, progress, {})
    np.testing.assert_allclose([t for t, _ in calls], np.arange(9) * 0.5, atol=1e-14)
    assert {end for _, end in calls} == {4.0}


def test_progress_can_stop_the_run(output):
    assert _core.simulate(spring(), output, lambda t, end: t < 1.9, {})["status"] == "interrupted"
    with h5py.File(output) as file:
        assert file.attrs["status"] == "interrupted"
        np.testing.assert_allclose(file["time"], [0, 0.5, 1, 1.5, 2], atol=1e-14)


def test_an_exception_of_progress_ends_the_run_and_comes_back(output):
    def progress(t: float, end: float) -> bool:
        if t > 0.9:
            raise KeyError("mine")
        return True

    with pytest.raises(KeyError, match="mine"):
        _core.simulate(spring(), output, progress, {})
    with h5py.File(output) as file:
        assert file.attrs["status"] == "interrupted"
        assert len(file["time"]) == 3


@pytest.mark.usefixtures("restored_handlers")
def test_ctrl_c_interrupts_a_run_without_progress(output):
    def interrupt(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    scene = spring(solver__end_time="1e9", output__step="100")
    assert _core.simulate(scene, output, None, {})["status"] == "interrupted"
    with h5py.File(output) as file:
        assert file.attrs["status"] == "interrupted"
        assert file["time"][-1] > 0


@pytest.mark.usefixtures("restored_handlers")
def test_other_exceptions_of_signal_handlers_come_back(output):
    def fail(number: int, frame: object) -> None:
        raise TimeoutError("too long")

    signal.signal(signal.SIGALRM, fail)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    with pytest.raises(TimeoutError, match="too long"):
        _core.simulate(spring(solver__end_time="1e9", output__step="100"), output, None, {})


def test_other_threads_run_meanwhile(output):
    """One long stretch between two samples: with the GIL held nothing else would happen."""
    scene = spring(solver__end_time="4000", output__step="4000", solver__max_step="0.05")
    run = threading.Thread(target=_core.simulate, args=(scene, output, None, {}))
    ticks = 0
    start = time.monotonic()
    run.start()
    while run.is_alive():
        time.sleep(0.001)
        ticks += 1
    assert time.monotonic() - start > 0.05, "the run is too short to tell"
    assert ticks > 10


def test_runs_in_parallel_do_not_disturb_each_other(tmp_path):
    scene = spring(output__step="0.01")
    paths = [tmp_path / f"{i}.h5" for i in range(4)]
    threads = [
        threading.Thread(target=_core.simulate, args=(scene, str(path), None, {})) for path in paths
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    values = []
    for path in paths:
        with h5py.File(path) as file:
            values.append(file["bodies/buoy/position"][()])
    assert len(values[0]) == 401
    for other in values[1:]:
        np.testing.assert_array_equal(other, values[0])


def test_a_failed_run_tells_when_and_keeps_its_results(output):
    scene = spring(
        force__spring__stiffness="[0, 0, -1e4, 0, 0, 0]",
        output__step="0.05",
        solver__method="radau",
    )
    with pytest.raises(SolverError) as caught:  # grows by e^(31.6 t) beyond all precision
        _core.simulate(scene, output, None, {})
    assert 0.1 < caught.value.time < 4.0
    assert caught.value.reason == "growth"  # not after steps of 1e-9 s
    assert caught.value.subject.endswith("buoy position z")
    assert f"{caught.value.subject} = " in str(caught.value)
    assert abs(caught.value.numbers["value"]) > 1e3
    with h5py.File(output) as file:
        assert file.attrs["status"] == "failed"
        assert file.attrs["message"] == str(caught.value)
        assert 0 < file["time"][-1] <= caught.value.time
        # z'' = w^2 z, w = sqrt(1e4/10)
        expected = np.cosh(np.sqrt(1e3) * file["time"][:5])
        np.testing.assert_allclose(file["bodies/buoy/position"][:5, 2], expected, rtol=1e-2)


def test_a_results_file_that_cannot_be_made_is_told(tmp_path):
    path = tmp_path / "none" / "results.h5"
    with pytest.raises(CaseError, match="No such file or directory") as caught:
        _core.simulate(spring(), str(path), None, {})
    assert str(path) in str(caught.value)


def test_a_killed_run_leaves_a_readable_file(tmp_path):
    path = tmp_path / "results.h5"
    code = f"""
import os
from hydrodae import _core
scene = _core.parse_case({SPRING!r}, ".", {{"solver.end_time": "1000"}})
def progress(t, end):
    return os.kill(os.getpid(), 9) if t > 600 else True
_core.simulate(scene, {str(path)!r}, progress, {{}})
"""
    run = subprocess.run([sys.executable, "-c", code], check=False)
    assert run.returncode == -signal.SIGKILL
    with h5py.File(tmp_path / "results.partial.h5") as file:
        assert file.attrs["status"] == "running"
        n = len(file["time"])
        assert n >= 1024
        assert len(file["bodies/buoy/position"]) == n
        np.testing.assert_allclose(file["time"], np.arange(n) * 0.5, atol=1e-9)


@pytest.mark.parametrize("order", ["h5py, hydrodae._core", "hydrodae._core, h5py"])
def test_two_hdf5_libraries_share_a_process(tmp_path, order):
    """h5py brings a library of its own; each must read what the other wrote, in both orders."""
    code = f"""
import {order}
import numpy as np
from hydrodae import _core

path = {str(tmp_path / "results.h5")!r}
scene = _core.parse_case({SPRING!r}, ".", {{}})
for _ in range(2):
    with h5py.File({str(tmp_path / "other.h5")!r}, "w") as other:
        other["x"] = np.arange(10.0)
        assert _core.simulate(scene, path, None, {{}})["status"] == "completed"
        other["y"] = np.array([1 + 2j])
    with h5py.File({str(tmp_path / "other.h5")!r}) as other, h5py.File(path) as results:
        assert other["x"][9] == 9.0 and other["y"][0] == 1 + 2j
        assert results.attrs["status"] == "completed" and len(results["time"]) == 9
try:
    h5py.File("does-not-exist.h5")
except FileNotFoundError:
    print("done")
"""
    run = subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        check=False,
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ},
    )
    assert run.returncode == 0, run.stderr
    assert run.stdout == "done\n"
    assert run.stderr == ""
