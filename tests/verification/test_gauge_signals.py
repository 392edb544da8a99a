"""Elevations and their forecasts to controllers of the older protocol, to FMUs and out of FMUs."""

from __future__ import annotations

import threading
from pathlib import Path

import numpy as np
import pytest
from tests.python.test_gauges import AHEAD, LINE, case, law
from tests.python.test_tcp import free_port
from tests.verification.fmu_of_c import write_fmu

import hydrodae
from hydrodae import Simulation, tcp
from hydrodae.fmu import export

X = "joints/slide/displacement"
SIGNALS = (AHEAD, "controllers/law/output", X)


def assert_as_the_kernels_own(found: hydrodae.Results) -> None:
    own = hydrodae.run(case(controller=LINE))
    for name in SIGNALS:
        np.testing.assert_allclose(found[name], own[name], rtol=1e-12, atol=1e-9)


def test_over_the_protocol_hotint() -> None:
    port = free_port()

    def peer() -> None:
        with tcp.connect(port=port, hotint=(1, 1), timeout=10.0) as run:
            for _, (ahead,) in run:
                run.answer(1000.0 * ahead)

    thread = threading.Thread(target=peer)
    thread.start()
    found = hydrodae.run(case(controller=law("tcp", port=port, protocol="hotint")))
    thread.join(10.0)
    assert_as_the_kernels_own(found)


@pytest.mark.parametrize("fmi", [2, 3])
def test_an_fmu_reads_them(fmi: int, tmp_path: Path) -> None:
    write_fmu(tmp_path / "pi.fmu", fmi)
    keys = dict(fmu_inputs=["rate"], fmu_outputs=["load"], fmu_factors=[-1.0])
    keys |= dict(parameters=["kp", "ki"], parameter_values=[1000.0, 0.0])
    unit = law("fmu", file="pi.fmu", **keys)
    assert_as_the_kernels_own(hydrodae.run(case(controller=unit, folder=tmp_path)))


def test_an_fmu_of_a_case_tells_them(tmp_path: Path) -> None:
    """As a Simulation does, also behind a state that was set; the law closes outside or inside."""
    pytest.importorskip("fmpy", reason="needs the extra cosim")
    from tests.verification.fmu_device import Device, problems, simulate

    outside = export(case(), tmp_path / "a.fmu")
    assert problems(outside) == []
    run = Simulation(case())
    with Device(outside, tmp_path / "a") as device:
        device.begin()
        for k in range(8):
            t, ahead = 0.25 * k, device.get(AHEAD)[0]
            assert ahead == run.read(AHEAD)
            device.set("forces/pto/load", 1000.0 * ahead)
            run.write("forces/pto/load", 1000.0 * ahead)
            device.step(t, 0.25)
            while run.time < t + 0.25:
                run.advance(t + 0.25)
            if k == 3:
                device.load(device.save())
        names = ("gauges/with/elevation", "gauges/with/ahead_1", AHEAD)
        told = np.array([float(run.read(name)) for name in names])
        np.testing.assert_allclose(np.array(device.get(*names)), told, rtol=1e-6)
    inside = export(case(controller=LINE), tmp_path / "b.fmu")
    assert problems(inside) == []
    own = hydrodae.run(case(controller=LINE))
    found = simulate(inside, stop_time=6.0, output_interval=0.25, output=[X, AHEAD])
    for name in (X, AHEAD):
        np.testing.assert_array_equal(found[name], own[name])
