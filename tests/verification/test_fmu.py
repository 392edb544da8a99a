"""FMUs under FMPy, an importer that others wrote: validity, motion, states, mistakes."""

from __future__ import annotations

import ctypes
import subprocess
import sys
import threading
import zipfile
from pathlib import Path

import numpy as np
import pytest
from tests import scenes
from tests.python.test_tcp import free_port
from tests.verification.fmu_device import Device, problems, simulate

import hydrodae
from hydrodae import CaseError, Simulation, tcp
from hydrodae.commands.cli import main
from hydrodae.fmu import export

CART = scenes.cart("stiffness = 200.0", solver="end_time = 2.0\nrtol = 1e-9")
X, V, LOAD = "joints/slide/displacement", "joints/slide/displacement_rate", "forces/pto/load"
VERSIONS = [2, 3]


def cart(**values: object) -> hydrodae.Case:
    return hydrodae.Case.from_text(CART).with_values(values)


@pytest.fixture(scope="module", params=VERSIONS)
def fmu(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("fmu")
    return export(
        cart(), folder / "cart.fmu", fmi=request.param, parameters=["body.cart.mass", "solver.rtol"]
    )


@pytest.mark.parametrize("version", VERSIONS)
def test_fmpy_finds_no_problem(version: int, repository: Path, tmp_path: Path) -> None:
    for name in ("sphere/control.toml", "f3of/waves.toml"):
        path = export(repository / "cases" / name, tmp_path / "3 devices.fmu", fmi=version)
        assert problems(path) == []


def test_the_importer_of_fmpy_sees_an_oscillation(fmu: Path) -> None:
    result = simulate(
        fmu, stop_time=2.0, output_interval=0.05, output=[X, V], start_values={LOAD: 20.0}
    )
    t = result["time"]
    assert len(t) == 41
    # a constant load of 20 N against a spring of 200 N/m
    assert result[X] == pytest.approx(0.1 + 0.4 * np.cos(10.0 * t), abs=1e-7)
    assert result[V] == pytest.approx(-4.0 * np.sin(10.0 * t), abs=1e-6)


def test_steps_are_those_of_a_simulation(fmu: Path, tmp_path: Path) -> None:
    run = Simulation(cart())
    with Device(fmu, tmp_path) as device:
        device.begin()
        for k in range(40):
            t = k * 0.05
            load = -7.0 * device.get(V)[0]
            assert load == -7.0 * run.read(V)
            device.set(LOAD, load)
            run.write(LOAD, load)
            device.step(t, 0.05)
            while run.time < t + 0.05:
                run.advance(t + 0.05)
            assert device.get("time", X) == [t + 0.05, run.read(X)]


def test_a_hundred_rollbacks_change_nothing(fmu: Path, tmp_path: Path) -> None:
    with Device(fmu, tmp_path) as device:
        device.begin()
        device.step(0.0, 0.3)
        saved = device.save()
        device.load(saved)
        found = []
        for _ in range(100):
            device.set(LOAD, 5.0)
            device.step(0.3, 0.05)
            found.append(device.get(X, V, LOAD))
            device.set(LOAD, -3.0)
            device.step(0.35, 0.01)
            device.load(saved)
            assert device.get("time", LOAD) == [0.3, 0.0]
        assert found == [found[0]] * 100


CONTINUE = """
import sys
from pathlib import Path
from tests.python.test_tcp import free_port
from tests.verification.fmu_device import Device, problems, simulate
path, folder, state = map(Path, sys.argv[1:])
with Device(path, folder) as device:
    device.load(state.read_bytes())
    device.step(0.3, 0.05)
    print(*(x.hex() for x in device.get("time", "joints/slide/displacement")))
"""


def test_a_state_goes_on_in_a_new_process(fmu: Path, tmp_path: Path, repository: Path) -> None:
    with Device(fmu, tmp_path / "a") as device:
        device.set("body.cart.mass", 3.0)
        device.begin(stop=2.5)
        device.set(LOAD, 11.0)
        device.step(0.0, 0.3)
        (tmp_path / "state").write_bytes(device.save())
        device.step(0.3, 0.05)
        expected = [x.hex() for x in device.get("time", X)]
    arguments = [str(fmu), str(tmp_path / "b"), str(tmp_path / "state")]
    out = subprocess.run(
        [sys.executable, "-c", CONTINUE, *arguments],
        cwd=repository,
        capture_output=True,
        text=True,
        check=True,
    )
    assert out.stdout.split() == expected


def test_a_reset_begins_anew(fmu: Path, tmp_path: Path) -> None:
    with Device(fmu, tmp_path) as device:
        device.set("body.cart.mass", 8.0)
        device.begin()
        device.step(0.0, 0.1)
        # 200 N/m and 8 kg: 5 rad/s
        assert device.get(X)[0] == pytest.approx(0.5 * np.cos(0.5), abs=1e-7)
        device.fmu.reset()
        assert device.get("body.cart.mass", LOAD) == [2.0, 0.0]
        device.begin()
        assert device.get("time", X) == [0.0, 0.5]


def test_the_run_goes_on_to_a_later_stop_time(fmu: Path, tmp_path: Path) -> None:
    with Device(fmu, tmp_path) as device:
        device.begin(stop=3.0)
        device.step(0.0, 3.0)
        assert device.get(X)[0] == pytest.approx(0.5 * np.cos(30.0), abs=1e-6)


def begin_only(device: Device) -> bool:
    device.fmu.enterInitializationMode()
    return True


def free_twice(device: Device) -> None:
    device.begin()
    state = device.fmu.getFMUState()
    again = ctypes.c_void_p(state.value)
    device.fmu.freeFMUState(state)
    device.fmu.freeFMUState(again)


def into_ten_bytes(device: Device) -> None:
    device.begin()
    state, room = device.fmu.getFMUState(), ctypes.create_string_buffer(10)
    if device.fmi == 2:
        device.fmu.fmi2SerializeFMUstate(device.fmu.component, state, room, 10)
    else:
        place = ctypes.cast(room, ctypes.POINTER(ctypes.c_ubyte))
        device.fmu.fmi3SerializeFMUState(device.fmu.component, state, place, 10)


MISTAKES = {
    "a run begins at t = 0 s": lambda d: d.begin(start=1.0),
    "the run has not begun": lambda d: d.step(0.0, 0.1),
    "has no value before the run begins": lambda d: d.get(X),
    "is an output": lambda d: d.set(X, 1.0),
    "no variable with the reference 9999": lambda d: d.set_references([9999], [1.0]),
    "is fixed since": lambda d: (d.begin(), d.set("solver.rtol", 1e-3)),
    "the case ends at 2 s": lambda d: (d.begin(), d.step(0.0, 2.1)),
    "but the run is at 0 s": lambda d: (d.begin(), d.step(0.1, 0.1)),
    "expected > 0": lambda d: (d.begin(), d.step(0.0, -0.1)),
    "forces/pto/load": lambda d: (d.begin(), d.set(LOAD, float("nan"))),
    "these bytes are no state": lambda d: d.load(b"nothing of the kind"),
    "mass": lambda d: (d.set("body.cart.mass", -1.0), d.begin()),
    "from t = nan s, but the run is at 0 s": lambda d: (d.begin(), d.step(float("nan"), 0.1)),
    "step of nan s: expected > 0": lambda d: (d.begin(), d.step(0.0, float("nan"))),
    "step of inf s: expected > 0": lambda d: (d.begin(), d.step(0.0, float("inf"))),
    "from t = 0 s, but the run is at 0.1 s": lambda d: (
        d.begin(),
        d.step(0.0, 0.1),
        d.step(0.0, 0.1),
    ),
    "stop time of inf s": lambda d: d.begin(stop=float("inf")),
    "DoStep is for an instance behind it": lambda d: (begin_only(d), d.step(0.0, 0.1)),
    "EnterInitializationMode is for": lambda d: (d.begin(), begin_only(d)),
    "ExitInitializationMode is for": lambda d: d.fmu.exitInitializationMode(),
    "this one is terminated": lambda d: (d.begin(), d.fmu.terminate(), d.step(0.0, 0.1)),
    "as the run is terminated": lambda d: (d.begin(), d.fmu.terminate(), d.set(LOAD, 1.0)),
    "there is no such state": lambda d: free_twice(d),
    "bytes of room, not 10": lambda d: into_ten_bytes(d),
}


@pytest.mark.parametrize("message", MISTAKES)
def test_mistakes_are_told(
    message: str, fmu: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with Device(fmu, tmp_path) as device:
        with pytest.raises(Exception, match="failed with status"):
            MISTAKES[message](device)
        assert message in capfd.readouterr().out


def test_two_instances_at_once_do_not_hear_each_other(fmu: Path, tmp_path: Path) -> None:
    with Device(fmu, tmp_path / "a") as one, Device(fmu, tmp_path / "b") as two:
        one.begin()
        two.set("body.cart.mass", 8.0)
        two.begin()
        for k in range(10):
            one.step(0.01 * k, 0.01)
            two.step(0.01 * k, 0.01)
        assert one.get(X)[0] == pytest.approx(0.5 * np.cos(1.0), abs=1e-7)
        assert two.get(X)[0] == pytest.approx(0.5 * np.cos(0.5), abs=1e-7)
        two.load(one.save())  # the mass comes with it
        one.step(0.1, 0.1)
        two.step(0.1, 0.1)
        assert two.get(X, "body.cart.mass") == one.get(X, "body.cart.mass")


def test_a_damaged_state_is_refused(fmu: Path, tmp_path: Path) -> None:
    with Device(fmu, tmp_path) as device:
        device.begin()
        device.step(0.0, 0.1)
        saved = device.save()
        for k in range(0, len(saved), len(saved) // 20):
            wrong = bytearray(saved)
            wrong[k] ^= 0x10
            for data in (bytes(wrong), saved[:k]):
                with pytest.raises(Exception, match="failed with status"):
                    device.load(data)
        device.load(saved)
        device.step(0.1, 0.1)
        assert device.get(X)[0] == pytest.approx(0.5 * np.cos(2.0), abs=1e-7)


def test_resources_of_another_fmu_are_refused(
    fmu: Path, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(tmp_path / "parts")
    other = tmp_path / "parts" / "resources" / "variables.txt"
    other.write_text(other.read_text().replace("token\t", "token\tx"))
    mixed = tmp_path / "mixed.fmu"
    with zipfile.ZipFile(mixed, "w") as archive:
        for file in (tmp_path / "parts").rglob("*.*"):
            archive.write(file, file.relative_to(tmp_path / "parts"))
    with pytest.raises(Exception, match="instantiate"):
        Device(mixed, tmp_path / "mixed")
    assert "of different FMUs" in capfd.readouterr().out


def test_a_controller_of_the_case_runs_inside(repository: Path, tmp_path: Path) -> None:
    case = repository / "cases" / "control" / "case.toml"
    path = tmp_path / "float.fmu"
    assert main(["fmu", str(case), "-o", str(path), "--outputs", "joints/*", "controllers/*"]) == 0
    with pytest.raises(CaseError, match="input 'forces/pto/load' is written by controller 'pi' of"):
        export(case, path, inputs=[LOAD])
    assert path.exists()
    results = hydrodae.run(case)
    with Device(path, tmp_path / "float") as device:
        assert LOAD not in device.references  # the controller has it
        device.begin()
        for k in range(200):
            device.step(k * 0.05, 0.05)
        found = device.get(X, "controllers/pi/output")
    last = [float(results[name][-1]) for name in (X, "controllers/pi/output")]
    assert found == pytest.approx(last, rel=1e-6)


@pytest.mark.parametrize("kind", ["own", "hydrodae", "hotint"])
def test_controllers_inside_go_back_with_a_state(
    kind: str, repository: Path, tmp_path: Path
) -> None:
    """A PI with its integral, or a program over TCP/IP that remembers nothing."""
    port = free_port()
    name = "case.toml" if kind == "own" else "case_tcp.toml"
    told = {} if kind == "own" else {"controller.pi.port": port, "controller.pi.protocol": kind}
    path = export(repository / "cases" / "control" / name, tmp_path / "float.fmu", set=told)

    def peer() -> None:
        with tcp.connect(port=port, hotint=(1, 1) if kind == "hotint" else None) as run:
            for _, (rate,) in run:
                run.answer(-600.0 * rate)

    thread = threading.Thread(target=peer)
    with Device(path, tmp_path / "float") as device:
        if kind != "own":
            thread.start()
        device.begin()
        for k in range(6):
            device.step(k * 0.05, 0.05)
        saved = device.save()
        device.load(saved)
        found = []
        for _ in range(5):
            for k in range(6, 16):
                device.step(k * 0.05, 0.05)
            found.append(device.get(X, V))
            device.load(saved)
        assert found == [found[0]] * 5
    if kind != "own":
        thread.join(10.0)


def test_a_state_of_another_end_finds_the_port_free(repository: Path, tmp_path: Path) -> None:
    """The run that it replaces listens there."""
    told = {"controller.pi.port": free_port()}
    given = repository / "cases" / "control" / "case_tcp.toml"
    path = export(given, tmp_path / "float.fmu", set=told)
    with Device(path, tmp_path / "float") as device:
        device.begin(stop=3.0)
        saved = device.save()
        device.fmu.reset()
        device.begin(stop=4.0)
        device.load(saved)
        assert device.get("time") == [0.0]


def test_what_cannot_be_in_an_fmu_is_refused(tmp_path: Path) -> None:
    controller = """
    [[controller]]
    type = "python"
    name = "law"
    inputs = ["joints/slide/displacement"]
    outputs = ["forces/pto/load"]
    period = 0.05
    """
    with pytest.raises(CaseError, match="'law' is a Python function"):
        export(hydrodae.Case.from_text(CART + controller), tmp_path / "x.fmu")
    with pytest.raises(CaseError, match="no input 'forces/pto/laod'; did you mean"):
        export(cart(), tmp_path / "x.fmu", inputs=["forces/pto/laod"])
    with pytest.raises(CaseError, match=r"solver\.atol: a parameter must be a number"):
        export(cart(), tmp_path / "x.fmu", parameters=["solver.atol"])
    with pytest.raises(CaseError, match=r"case.toml: an FMU needs a name that ends in .fmu"):
        export(cart(), tmp_path / "case.toml")
    assert not (tmp_path / "case.toml").exists()
    with pytest.raises(CaseError, match="there are 2 and 3"):
        export(cart(), tmp_path / "x.fmu", fmi=1)
