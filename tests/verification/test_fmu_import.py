"""FMUs as controllers, against the kernel's own PI."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from tests import scenes
from tests.verification.fmu_cart import CART, CHANNELS, FMU, OWN, cart
from tests.verification.fmu_of_c import description, with_units, write_fmu

import hydrodae
from hydrodae import Case, CaseError, RunInterrupted, Simulation, SolverError
from hydrodae.fmu import export


def test_an_fmu_equals_the_kernels_own_pi(fmi: int, tmp_path: Path) -> None:
    own = hydrodae.run(Case.from_text(CART.replace("KEYS", OWN)))
    other = hydrodae.run(cart(tmp_path))
    for name in CHANNELS:
        scale = float(abs(own[name]).max())
        np.testing.assert_allclose(other[name], own[name], atol=1e-9 * scale)
    assert other.statistics["controller_calls.pi"] == 50
    assert "fmu): every 0.1 s joints/slide/displacement_rate [m/s]" in hydrodae.check(
        cart(tmp_path)
    )


def rest(run: Simulation, end: float = 3.0) -> list[float]:
    out = []
    while run.time < end:
        run.advance(end)
        out += [float(run.read(name)) for name in CHANNELS]
    return out


def test_rollback_and_another_process_go_on_bit_for_bit(fmi: int, tmp_path: Path) -> None:
    simulation = Simulation(cart(tmp_path))
    begin = simulation.state()
    rest(simulation, 2.13)
    saved = simulation.state()
    went_on = rest(simulation)
    simulation.restore(saved)
    assert rest(simulation) == went_on
    other = Simulation(cart(tmp_path))
    other.restore(saved)
    assert rest(other) == went_on
    fresh, other_way = Simulation(cart(tmp_path)), []
    fresh.restore(begin)
    simulation.restore(begin)
    other_way = rest(simulation)
    assert rest(fresh) == other_way


def test_a_resumed_run_equals_one_that_was_not_cut_off(fmi: int, tmp_path: Path) -> None:
    whole = hydrodae.run(cart(tmp_path), tmp_path / "a.h5", checkpoint=0)
    with pytest.raises(RunInterrupted):
        hydrodae.run(cart(tmp_path), tmp_path / "b.h5", checkpoint=0, progress=lambda t, _: t < 2.4)
    resumed = hydrodae.run(cart(tmp_path), tmp_path / "b.h5", checkpoint=0, resume=True)
    for name in CHANNELS:
        np.testing.assert_array_equal(resumed[name], whole[name])


def test_an_fmu_without_states_has_no_checkpoints(fmi: int, tmp_path: Path) -> None:
    write_fmu(tmp_path / "pi.fmu", fmi, description(fmi, states=False))
    assert hydrodae.run(cart(tmp_path)).end_time == 5.0
    with pytest.raises(CaseError, match="'pi': its FMU cannot save and serialise its state"):
        hydrodae.run(cart(tmp_path), tmp_path / "a.h5", checkpoint=0)
    with pytest.raises(CaseError, match="its FMU cannot save and serialise its state"):
        Simulation(cart(tmp_path)).state()


def test_another_fmu_is_another_run(tmp_path: Path) -> None:
    write_fmu(tmp_path / "pi.fmu", 2)
    saved = Simulation(cart(tmp_path)).state()
    write_fmu(tmp_path / "pi.fmu", 3)
    with pytest.raises(CaseError, match=r"pi\.fmu has changed since"):
        Simulation(cart(tmp_path)).restore(saved)


def test_a_step_that_is_not_made_ends_the_run(fmi: int, tmp_path: Path) -> None:
    for key, status in (("discard_at", "Discard: the step is too long"), ("fail_at", "Error: it")):
        keys = FMU.replace('"ki"]', f'"ki", "{key}"]').replace("0.7]", "0.7, 1.95]")
        text = " has ended in status " + status
        with pytest.raises(SolverError, match=text) as caught:
            hydrodae.run(cart(tmp_path, keys), tmp_path / "r.h5")
        assert f"stopped at t = 2 s: controller 'pi': {tmp_path}/pi.fmu: fmi{fmi}DoStep" in str(
            caught.value
        )
        kept = hydrodae.Results.read(tmp_path / "r.h5")
        assert kept.status == "failed"
        assert 1.9 <= kept.end_time <= 2.0


def test_an_fmu_may_end_the_run(fmi: int, tmp_path: Path) -> None:
    keys = FMU.replace('"ki"]', '"ki", "end_at"]').replace("0.7]", "0.7, 1.95]")
    with pytest.raises(RunInterrupted, match="controller 'pi': its FMU ends the run"):
        hydrodae.run(cart(tmp_path, keys), tmp_path / "r.h5")


def test_the_executable_loads_fmus(fmi: int, tmp_path: Path, executable: str) -> None:
    own = hydrodae.run(cart(tmp_path))
    out = tmp_path / "results.h5"
    command = [executable, str(tmp_path / "case.toml"), "-o", str(out)]
    subprocess.run(command, check=True, capture_output=True)
    found = hydrodae.Results.read(out)
    for name in CHANNELS:
        np.testing.assert_array_equal(found[name], own[name])


SECOND = scenes.cart(
    "stiffness = 27.0\ndamping = 0.6",
    body="float",
    mass=3.0,
    initial={"displacement": [0.0, 0.0, 0.0]},
    solver="end_time = 1.0\nrtol = 1e-9",
)


def test_a_second_device_answers(fmi: int, tmp_path: Path) -> None:
    """A case as the FMU of another: each is pushed by the force of the other at the instants.

    The two feed each other: from 4.4 s on, 1e5 N, the run would be stopped for that.
    """
    x, load, force = "joints/slide/displacement", "forces/pto/load", "forces/pto/force"
    export(
        Case.from_text(SECOND),
        tmp_path / "b.fmu",
        fmi=fmi,
        inputs=[load],
        outputs=[force],
        parameters=["body.float.mass"],
    )
    keys = f"""type = "fmu"
file = "b.fmu"
fmu_inputs = ["{load}"]
fmu_outputs = ["{force}"]
parameters = ["body.float.mass"]
parameter_values = [2.5]"""
    given = CART.replace("joints/slide/displacement_rate", force).replace("KEYS", keys)
    (tmp_path / "case.toml").write_text(given)
    found = hydrodae.run(tmp_path / "case.toml", set={"solver.end_time": 3.0})

    def stepper(mass: float, stiffness: float, damping: float) -> np.ndarray:
        A = np.zeros((3, 3))
        A[:2] = [[0.0, 1.0, 0.0], [-stiffness / mass, -damping / mass, 1.0 / mass]]
        return np.asarray(expm(0.1 * A))

    own, other = stepper(2.0, 8.0, 0.0), stepper(2.5, 27.0, 0.6)
    of_own, of_other = np.array([-8.0, 0.0, 1.0]), np.array([-27.0, -0.6, 1.0])
    a, b, expected = np.array([0.5, 0.0, 0.0]), np.zeros(3), [0.5]
    for _ in range(30):
        b[2] = of_own @ a
        a[2] = of_other @ b  # which feels its load at once
        a, b = own @ a, other @ b
        expected.append(a[0])
    np.testing.assert_allclose(found[x][::2], expected, rtol=1e-6, atol=1e-7)
    assert float(abs(found["controllers/pi/output"]).max()) > 0.01


def test_nothing_stays_behind(tmp_path: Path, repository: Path) -> None:
    """Temporary folders go with the run, also with one that fails."""
    write_fmu(tmp_path / "pi.fmu", 2)
    cart(tmp_path)
    script = "import sys, hydrodae; hydrodae.run(sys.argv[1])"
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    subprocess.run(
        [sys.executable, "-c", script, str(tmp_path / "case.toml")],
        env={**os.environ, "TMPDIR": str(scratch)},
        cwd=repository,
        check=True,
    )
    assert list(scratch.iterdir()) == []


@pytest.mark.parametrize(
    ("rate", "load", "gains", "notes"),
    [
        ("m/s", "N", "1.3, 0.7", []),
        ("mm/s", "kN", "1.3e-6, 0.7e-6", ["1 mm/s = 0.001 m/s", "1 kN = 1000 N"]),
        ("", "", "1.3, 0.7", []),
        ("furlong", "N", "1.3, 0.7", ["'furlong', which it does not explain: taken for 'm/s'"]),
    ],
)
def test_units_that_differ_by_a_factor_are_converted(
    rate: str, load: str, gains: str, notes: list[str], fmi: int, tmp_path: Path
) -> None:
    """kN is explained in the FMU, mm/s is not: it is known."""
    write_fmu(tmp_path / "pi.fmu", fmi, with_units(description(fmi), fmi, rate, load))
    found = hydrodae.run(cart(tmp_path, FMU.replace("1.3, 0.7", gains)))
    own = hydrodae.run(Case.from_text(CART.replace("KEYS", OWN)))
    for name in CHANNELS:
        scale = float(abs(own[name]).max())
        np.testing.assert_allclose(found[name], own[name], atol=1e-9 * scale)
    text = hydrodae.check(cart(tmp_path))
    told = [note for note in found.notes if "of its FMU" in note]
    assert len(told) == len(notes)
    for note, expected in zip(told, notes, strict=True):
        assert expected in note
        assert note in text
        assert note in found.summary()
