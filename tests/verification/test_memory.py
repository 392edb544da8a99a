"""Radiation by convolution with the history of accepted steps, against the exponential memory."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest
from tests.errors import wrong

import hydrodae
from hydrodae.hdb.database import HydroDatabase

CONVOLUTION = {"hydro.radiation": "convolution"}
#: Settings by which every method meets 1e-6 of the sphere's release.
METHODS = {
    "ida": {"solver.rtol": 1e-8},
    "radau": {"solver.rtol": 1e-8},
    "explicit_rk": {"solver.rtol": 1e-8},
    "gauss": {"solver.step": 0.02},
    "lobatto_iiic": {"solver.step": 0.02},
    "generalized_alpha": {"solver.step": 0.0025},
}


def sphere(repository: Path, **values: object) -> hydrodae.Results:
    """Decay of the sphere by convolution; keywords with __ for the dot."""
    given = {key.replace("__", "."): value for key, value in values.items()}
    return hydrodae.run(
        repository / "cases" / "sphere" / "decay.toml",
        set={**CONVOLUTION, "solver.end_time": 20.0, "output.step": 0.1, **given},
    )


def heave(results: hydrodae.Results) -> np.ndarray:
    return np.asarray(results["bodies/sphere/position"].values[:, 2] + 2.0)


@pytest.fixture(scope="module")
def tight(repository: Path) -> np.ndarray:
    """Heave of the sphere by the fifth-order method in short steps."""
    return heave(sphere(repository, solver__method="radau", solver__order=5, solver__step=0.01))


def test_sphere_decay_agrees_with_the_exponential_memory(repository: Path) -> None:
    """Both within what is known of H: 4e-4 (kernel) and 1e-4 (fit) around the resonance."""
    values = {"solver.end_time": 20.0, "output.step": 0.1, "solver.rtol": 1e-8}
    case = repository / "cases" / "sphere" / "decay.toml"
    exponential = heave(hydrodae.run(case, set=values))
    convolution = heave(hydrodae.run(case, set={**values, **CONVOLUTION}))
    assert np.sqrt(np.mean((convolution - exponential) ** 2)) <= 1e-3 * exponential.std()


def test_sphere_decay_against_inwaveh(repository: Path, reference: Path) -> None:
    table = np.genfromtxt(reference / "sphere" / "decay_1m.csv", delimiter=",", names=True)
    early = table["t_s"] <= 20.0
    results = sphere(repository, output__step=0.02)
    ours = np.interp(table["t_s"][early], results.time, heave(results))
    assert np.sqrt(np.mean((ours - table["InWaveH_m"][early]) ** 2)) <= 0.006


def test_error_falls_with_the_fourth_power_of_the_step(repository: Path, tight: np.ndarray) -> None:
    """The history is interpolated with order 4; the method itself is of order 5."""
    errors = [
        np.abs(
            heave(sphere(repository, solver__method="radau", solver__order=5, solver__step=h))
            - tight
        ).max()
        for h in (0.2, 0.1, 0.05)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert errors[0] <= 2e-3
    assert orders.min() >= 3.7, (errors, orders)


@pytest.mark.parametrize("method", METHODS)
def test_every_method_agrees(repository: Path, tight: np.ndarray, method: str) -> None:
    results = sphere(repository, **{"solver.method": method, **METHODS[method]})
    assert np.abs(heave(results) - tight).max() <= (2e-5 if method == "generalized_alpha" else 3e-6)
    assert results.statistics["relative_balance_error"] <= 2e-5


def test_output_leaves_no_trace(repository: Path) -> None:
    """Samples, which ask the history at other times, change nothing."""
    for method in ("ida", "radau", "explicit_rk"):
        coarse = sphere(repository, solver__method=method, output__step=1.0)
        fine = sphere(repository, solver__method=method, output__step=0.05)
        np.testing.assert_array_equal(heave(fine)[::20], heave(coarse))


def test_rejected_steps_leave_no_trace(repository: Path) -> None:
    """A sea that sets in at once makes ida reject steps; short fixed steps are never rejected.

    The exponential memory, which has no history, tells what error the tolerance allows.
    """
    values = {
        "sea.ramp": 0.2,
        "wave.swell.period": 2.0,
        "wave.swell.height": 1.0,
        "solver.end_time": 10.0,
        "output.step": 0.1,
    }
    case = hydrodae.Case.read(repository / "cases" / "sphere" / "wave.toml").with_values(values)
    errors = []
    for radiation in ("exponential", "convolution"):
        model = case.with_values({"hydro.radiation": radiation})
        fixed = heave(hydrodae.run(model, set={"solver.method": "radau", "solver.step": 0.01}))
        results = hydrodae.run(model, set={"solver.method": "ida", "solver.rtol": 1e-4})
        assert results.statistics["error_test_failures"] > 0
        errors.append(np.abs(heave(results) - fixed).max())
    assert errors[1] <= 2.0 * errors[0]


def test_limit_of_the_step_is_told(repository: Path) -> None:
    results = sphere(repository, solver__end_time=1.0, solver__rtol=1e-6)
    assert "what the history of the convolution carries" in "\n".join(results.notes)
    with wrong("solver.step"):
        sphere(repository, solver__method="radau", solver__step=1.0)


def test_work_of_the_memory_closes_the_balance(repository: Path) -> None:
    """Kinetic, potential energy and the work of the radiation, to the method's accuracy."""
    results = sphere(repository, solver__method="radau", solver__rtol=1e-9)
    radiated = results["energy/work/radiation"].values
    total = results["energy/total"].values
    assert radiated[-1] < -0.5 * total[0]
    assert np.abs(total - total[0] - radiated).max() <= 1e-6 * abs(radiated[-1])


def test_wrong_keys_are_one_clear_error(repository: Path, tmp_path: Path) -> None:
    case = hydrodae.Case.read(repository / "cases" / "sphere" / "decay.toml")
    with wrong("hydro.memory_length"):
        case.with_values({"hydro.memory_length": 5.0})
    with wrong("hydro.memory_length"):
        case.with_values({**CONVOLUTION, "hydro.memory_length": 500.0})
    for name in ("decay.toml", "hydro.h5"):
        shutil.copy(repository / "cases" / "sphere" / name, tmp_path)
    with h5py.File(tmp_path / "hydro.h5", "r+") as file:
        file["radiation_kernel/time"][5] += 0.01
    with pytest.raises(hydrodae.CaseError, match=r"radiation_kernel/time: must be equally spaced"):
        hydrodae.Case.read(tmp_path / "decay.toml").with_values(CONVOLUTION)
    flaps = hydrodae.Case.read(repository / "cases" / "f3of" / "flap_decay.toml")
    with pytest.raises(hydrodae.CaseError, match=r"no radiation kernel .* hydrodae hdb kernel"):
        flaps.with_values(CONVOLUTION)


def test_a_shorter_memory_costs_accuracy(repository: Path, tight: np.ndarray) -> None:
    errors = [
        np.abs(heave(sphere(repository, hydro__memory_length=t, solver__force=True)) - tight).max()
        for t in (2.0, 5.0, 10.0)
    ]
    assert errors[0] > errors[1] > errors[2] > 1e-6
    assert errors[2] <= 5e-3


def test_a_memory_cut_too_short_is_refused(repository: Path) -> None:
    with wrong("hydro.memory_length"):
        sphere(repository, hydro__memory_length=1.0)


def test_f3of_flaps_agree_with_the_exponential_memory(repository: Path, tmp_path: Path) -> None:
    """Six coupled coordinates and a memory of 100 s, loads on the base too.

    Against the exact linear motion both fits of such a memory err by 1e-3 (flap 1) and 5e-3 (flap
    2) over 50 s: the tables themselves say no more.
    """
    for name in ("flap_decay.toml", "hydro.h5"):
        shutil.copy(repository / "cases" / "f3of" / name, tmp_path)
    database = HydroDatabase.read(tmp_path / "hydro.h5")
    moving = [f"{body}.{dof}" for body in ("flap1", "flap2") for dof in ("surge", "heave", "pitch")]
    base = [f"base.{dof}" for dof in ("surge", "heave", "pitch")]
    database.with_kernel(moving, moving + base, length=100.0).write(tmp_path / "hydro.h5")
    values = {"solver.end_time": 50.0, "solver.rtol": 1e-6, "solver.accuracy": "none"}
    runs = [
        hydrodae.run(tmp_path / "flap_decay.toml", set={**values, "hydro.radiation": radiation})
        for radiation in ("exponential", "convolution")
    ]
    for hinge, share in (("hinge1", 5e-3), ("hinge2", 1e-2)):
        fit, kernel = (run[f"joints/{hinge}/angle"].values for run in runs)
        assert np.sqrt(np.mean((fit - kernel) ** 2)) <= share * fit.std()
    fit, kernel = (run["bodies/base/support_force"].sel(component="x").values for run in runs)
    assert np.sqrt(np.mean((fit - kernel) ** 2)) <= 3e-2 * fit.std()
    assert runs[1].statistics["relative_balance_error"] <= 1e-3
