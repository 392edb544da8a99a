"""One PI law of a sphere and of a flap of F3OF: in the kernel, in Python, over TCP, beside an FMU.

Sampled alike, all give the same motion within 1e-9; so does the law inside the FMU.
"""

from __future__ import annotations

import threading
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from tests.python.test_tcp import free_port

import hydrodae
from hydrodae import Case, Results, tcp

END = 6.0
SHORT = {"solver.end_time": END, "sea.ramp": 2.0}


@dataclass(frozen=True)
class Device:
    """A case without controller, and the law that it gets."""

    case: str
    joint: str
    motion: str  #: channel of the joint
    pto: str
    gain_p: float  #: N s/m, N m s/rad
    gain_i: float  #: N/m, N m/rad
    period: float  #: s

    @property
    def rate(self) -> str:
        return f"joints/{self.joint}/{self.motion}_rate"

    @property
    def load(self) -> str:
        return f"forces/{self.pto}/load"

    @property
    def watched(self) -> tuple[str, ...]:
        """Channels that are compared."""
        return (f"joints/{self.joint}/{self.motion}", "controllers/pi/output", self.work)

    @property
    def work(self) -> str:
        return f"energy/work/{self.pto}"

    def case_with(self, folder: Path, controller: str) -> Case:
        path = folder / self.case
        head, tail = path.read_text().split("[solver]")
        head = head.split("[[controller]]")[0]
        return Case.from_text(f"{head}{controller}\n[solver]{tail}", path.parent)

    def bare(self, folder: Path) -> Case:
        return self.case_with(folder, "")

    def controlled(self, folder: Path, kind: str, keys: str = "") -> Case:
        return self.case_with(
            folder,
            f"""
[[controller]]
type = "{kind}"
name = "pi"
inputs = ["{self.rate}"]
outputs = ["{self.load}"]
period = {self.period}
{keys}""",
        )

    def own(self, folder: Path) -> Case:
        return self.controlled(folder, "pid", f"gain_p = {self.gain_p}\ngain_i = {self.gain_i}")


DEVICES = {
    "sphere": Device(
        "sphere/control.toml", "guide", "displacement", "pto", 9.567e4, -2.096e5, 0.05
    ),
    "flap": Device("f3of/waves.toml", "hinge1", "angle", "pto1", 4.0e7, -2.0e7, 0.1),
}


class Pi:
    """The law in Python: u = Kp e + Ki sum of T e, e = -rate."""

    def __init__(self, device: Device) -> None:
        self.device, self.integral = device, 0.0

    def __call__(self, _: float, rate: float) -> float:
        load = -self.device.gain_p * rate + self.integral
        self.integral -= self.device.period * self.device.gain_i * rate
        return load


@pytest.fixture(scope="module")
def folder(repository: Path) -> Path:
    return repository / "cases"


@pytest.fixture(scope="module", params=DEVICES)
def device(request: pytest.FixtureRequest) -> Device:
    return DEVICES[request.param]


@pytest.fixture(scope="module")
def own(device: Device, folder: Path) -> Results:
    """The run with the controller of the kernel."""
    results = hydrodae.run(device.own(folder), set=SHORT)
    assert abs(results["controllers/pi/output"]).max() > 0.0  # else all would be equal
    return results


def agree(other: Results, own: Results, device: Device) -> None:
    for name in device.watched:
        scale = float(abs(own[name]).max())
        np.testing.assert_allclose(other[name], own[name], atol=1e-9 * scale)


def test_in_python(device: Device, folder: Path, own: Results) -> None:
    given = device.controlled(folder, "python")
    agree(hydrodae.run(given, set=SHORT, controllers={"pi": Pi(device)}), own, device)


@pytest.mark.parametrize("protocol", ["hydrodae", "hotint"])
def test_over_tcp(device: Device, folder: Path, own: Results, protocol: str) -> None:
    port = free_port()

    def peer() -> None:
        law = Pi(device)
        with tcp.connect(port=port, hotint=(1, 1) if protocol == "hotint" else None) as run:
            for t, (rate,) in run:
                run.answer(law(t, rate))

    thread = threading.Thread(target=peer)
    thread.start()
    keys = f'port = {port}\nprotocol = "{protocol}"'
    other = hydrodae.run(device.controlled(folder, "tcp", keys), set=SHORT)
    thread.join(5.0)
    agree(other, own, device)


def driven(device: Device, path: Path, where: Path, law: Pi | None) -> list[float]:
    """Motion at the sampling instants under FMPy; the law, if any, is in the importer."""
    from tests.verification.fmu_device import Device as Unit

    motion, found = device.watched[0], [0.0]
    with Unit(path, where) as unit:
        unit.begin()
        for k in range(round(END / device.period)):
            if law:
                unit.set(device.load, law(0.0, *unit.get(device.rate)))
            unit.step(k * device.period, device.period)
            found += unit.get(motion)
    return found


@pytest.mark.parametrize("where", ["importer", "unit"])
def test_as_an_fmu(device: Device, folder: Path, own: Results, tmp_path: Path, where: str) -> None:
    """The law in the importer beside a bare device, and in the unit with the device."""
    pytest.importorskip("fmpy", reason="needs the extra cosim")
    from hydrodae.fmu import export

    law = Pi(device) if where == "importer" else None
    given = device.bare(folder) if law else device.own(folder)
    path = export(given, tmp_path / "device.fmu", set=SHORT)
    found = driven(device, path, tmp_path / "unit", law)
    motion = own[device.watched[0]]
    expected = motion.interp(time=device.period * np.arange(len(found))).to_numpy()
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())
