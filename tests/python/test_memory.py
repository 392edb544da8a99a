"""Exponential memory: closed-form kernels, loads on fixed bodies, bad input."""

from __future__ import annotations

import warnings
from dataclasses import replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from tests.errors import refused
from tests.python.resonances import (
    ADDED_MASS_INF,
    LABELS,
    RESONANCES,
    exact_kernel,
    exact_transfer,
    table,
)
from tests.verification.point_absorbers import Table

from hydrodae.errors import DatabaseError
from hydrodae.hdb.memory import ExponentialMemory, MemoryFitWarning, fit_memory
from hydrodae.hdb.memory.clock import Clock
from hydrodae.hdb.memory.modes import Modes, Problem
from hydrodae.hdb.memory.passivity import eigenvalues, is_passive, local_minima


@pytest.fixture(scope="module")
def exact() -> Table:
    omega = np.arange(0.05, 5.01, 0.05)
    return table(exact_transfer(omega), omega)


@pytest.fixture(scope="module")
def fitted(exact: Table) -> ExponentialMemory:
    return fit_memory(exact, LABELS, name="exact")


def test_damped_cosines_are_recovered(fitted: ExponentialMemory) -> None:
    # also beyond the data, and the kernel that no fit saw
    omega, time = np.linspace(0.0, 12.0, 500), np.linspace(0.0, 40.0, 801)
    scale = np.sqrt(np.einsum("wii->wi", exact_transfer(omega).real).max(axis=0))
    off = (fitted.transfer(omega) - exact_transfer(omega)) / scale / scale[:, None]
    assert np.abs(off).max() < 1e-6
    kernel = exact_kernel(time)
    assert np.abs(fitted.kernel(time) - kernel).max() < 1e-6 * np.abs(kernel).max()
    assert fitted.added_mass_inf == pytest.approx(ADDED_MASS_INF, rel=1e-6, abs=1.0)


def test_damped_cosines_need_only_their_own_poles(fitted: ExponentialMemory) -> None:
    exact_poles = [-a + 1j * np.sqrt(w0**2 - a**2) for a, w0, _, _ in RESONANCES]
    assert fitted.n_states == 6
    assert np.sort_complex(fitted.poles) == pytest.approx(np.sort_complex(exact_poles), rel=1e-5)


def test_report_of_a_passive_fit(fitted: ExponentialMemory) -> None:
    report = fitted.report
    assert report["passive"] is True
    assert report["target_met"] is True
    assert report["n_states"] == fitted.n_states
    assert report["h_error_band"] < 1e-6
    assert report["max_real_pole"] == fitted.poles.real.max() < 0
    assert report["min_eig_re_h_relative"] == pytest.approx(0.0, abs=1e-9)


def test_states_reproduce_the_load_in_time(fitted: ExponentialMemory) -> None:
    # z' = p z + B U with U = U0 e^{iwt} settles to z = B U / (iw - p); f = -Re(C z)
    omega = 0.7
    velocity = np.array([1.0, -0.5, 0.1])
    time = np.linspace(0.0, 2 * np.pi / omega, 9)
    load = np.zeros((time.size, 3))
    for pole, row, column in zip(
        fitted.poles, fitted.input_matrix, fitted.output_matrix.T, strict=True
    ):
        # the real part of U0 e^{iwt} drives the complex state: both signs of w
        drive = row @ velocity / 2
        state = drive * np.exp(1j * omega * time) / (1j * omega - pole)
        state = state + drive * np.exp(-1j * omega * time) / (-1j * omega - pole)
        load -= (column * state[:, None]).real
    expected = -(
        np.exp(1j * omega * time)[:, None] * (exact_transfer(np.array([omega]))[0] @ velocity)
    ).real
    assert load == pytest.approx(expected, rel=1e-5, abs=1e-5 * np.abs(expected).max())


def test_passivity_finds_a_narrow_dip() -> None:
    # 1/(s + a) minus a narrow resonance: Re H(i w0) = a/(a^2 + w0^2) - g/(2 d)
    a, w0, d, g = 1.0, 3.0, 1e-3, 4e-4
    memory = ExponentialMemory(
        "dip",
        ("b.heave",),
        ("b.heave",),
        np.array([-a, -d + 1j * w0]),
        np.ones((2, 1), dtype=complex),
        np.array([[1.0, -g]], dtype=complex),
        np.zeros((1, 1)),
    )
    assert memory.n_states == 3  # one of the real pole, two of the pair
    dip = memory.passivity()
    s = 1j * dip.omega
    exact_dip = (1 / (s + a) - g / 2 * (1 / (s + d - 1j * w0) + 1 / (s + d + 1j * w0))).real
    assert dip.omega == pytest.approx(w0, abs=1e-4)
    assert dip.relative == pytest.approx(exact_dip, rel=1e-6)
    assert dip.relative == pytest.approx(a / (a**2 + w0**2) - g / (2 * d), rel=1e-3)


@pytest.mark.parametrize(("below", "passive"), [(4e-5, True), (6e-5, False), (1e-3, False)])
def test_the_limit_of_passivity(below: float, passive: bool) -> None:
    """Re H of 1/(s + a) is a/(a^2 + w^2), at most 1/a; a narrow mode of residue -r digs r/d.

    A dip to 5e-5 of the largest damping below zero is what the fit takes for rounding.
    """
    a, w0, d = 1.0, 3.0, 1e-3
    r = d * (a / (a**2 + w0**2) + below / a)
    poles = np.array([-a, -d + 1j * w0])
    vectors = np.array([[1.0], [1j * np.sqrt(r)]])
    modes = Modes(poles, vectors, np.ones(2), np.zeros(1))
    found = local_minima(modes, 5.0)
    assert found.lowest / found.largest == pytest.approx(-below, abs=2e-6)
    problem = cast(Problem, SimpleNamespace(samples=SimpleNamespace(omega=np.array([5.0]))))
    assert is_passive(modes, problem) is passive


@pytest.mark.parametrize(
    ("options", "reason", "subject"),
    [({"uniform": 0.0}, "option", "uniform")],
)
def test_bad_options_of_a_fit(exact: Table, options: dict, reason: str, subject: str) -> None:
    with refused(reason, subject):
        fit_memory(exact, LABELS, **options)


def test_max_states_is_kept(exact: Table) -> None:
    with pytest.warns(MemoryFitWarning, match="misses its target with 4 states"):
        memory = fit_memory(exact, LABELS, max_states=4)
    assert memory.n_states == 4
    assert memory.report["target_met"] is False


def test_loads_on_a_body_that_does_not_move(exact: Table) -> None:
    memory = fit_memory(exact, LABELS[:1], LABELS, target=1e-6, target_outside=1e-6)
    assert memory.outputs == LABELS
    assert memory.output_matrix.shape == (3, memory.poles.size)
    omega = np.linspace(0.0, 8.0, 200)
    expected = exact_transfer(omega)[:, :, :1]
    off = np.abs(memory.transfer(omega) - expected).max(axis=0)
    assert np.all(off < 1e-5 * np.abs(expected).max(axis=0))
    assert memory.added_mass_inf == pytest.approx(ADDED_MASS_INF[:, :1], rel=1e-5, abs=1.0)
    assert memory.report["h_error_outputs"] < 1e-5


def test_coordinate_without_radiation_is_left_out(exact: Table) -> None:
    n = 4
    added_mass, damping = np.zeros((exact.omega.size, n, n)), np.zeros((exact.omega.size, n, n))
    added_mass[:, :3, :3], damping[:, :3, :3] = exact.added_mass, exact.radiation_damping
    rng = np.random.default_rng(1)
    added_mass[:, 3, 3] = 7.0
    damping[:, 3, 3] = 1e-9 * damping[:, 2, 2].max() * rng.standard_normal(exact.omega.size)
    labels = (*LABELS, "float.yaw")
    data = Table(labels, exact.omega, added_mass, damping)
    with pytest.warns(MemoryFitWarning, match=r"no radiation in float\.yaw"):
        memory = fit_memory(data, labels)
    assert memory.report["dropped_inputs"] == "float.yaw"
    assert not np.any(memory.input_matrix[:, 3])
    assert not np.any(memory.output_matrix[3])
    assert memory.added_mass_inf[3] == pytest.approx([0.0, 0.0, 0.0, 7.0])
    assert memory.report["h_error_band"] < 1e-5


def test_coordinate_with_little_radiation_is_kept(exact: Table) -> None:
    """A millionth of the damping of the others is no noise: the same poles, scaled residues."""
    size = np.array([1.0, 1e-3, 1.0])
    scale = np.outer(size, size)
    data = Table(LABELS, exact.omega, scale * exact.added_mass, scale * exact.radiation_damping)
    memory = fit_memory(data, LABELS)
    largest = scale * np.abs(exact_transfer(exact.omega)).max(axis=0)
    off = np.abs(memory.transfer(exact.omega) - scale * exact_transfer(exact.omega))
    assert (off / largest).max() < 1e-5


def test_eigenvalues_of_two_coordinates_are_those_of_any_number() -> None:
    matrices = np.random.default_rng(1).standard_normal((50, 2, 2))
    matrices += matrices.transpose(0, 2, 1)
    np.testing.assert_allclose(eigenvalues(matrices), np.linalg.eigvalsh(matrices), atol=1e-12)


def test_uncoupled_coordinates_are_fitted_apart(exact: Table) -> None:
    coupling = np.array([[1.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 1.0]])
    data = replace(
        exact,
        added_mass=exact.added_mass * coupling,
        radiation_damping=exact.radiation_damping * coupling,
    )
    memory = fit_memory(data, LABELS)
    assert memory.report["groups"] == "float.surge, float.pitch; float.heave"
    heave = memory.input_matrix[:, 1] != 0
    assert np.all(memory.input_matrix[heave][:, [0, 2]] == 0)
    assert memory.report["passive"] is True


def test_fit_is_deterministic(exact: Table, fitted: ExponentialMemory) -> None:
    again = fit_memory(exact, LABELS)
    assert np.array_equal(again.poles, fitted.poles)
    assert np.array_equal(again.output_matrix, fitted.output_matrix)


@pytest.mark.parametrize(
    ("arguments", "reason", "subject"),
    [
        ({"inputs": ("float.sway",)}, "label", "float.sway"),
        ({"inputs": ()}, "option", "inputs"),
        ({"inputs": LABELS[:1] * 2}, "option", "inputs"),
        ({"inputs": LABELS, "band": (6.0, 9.0)}, "frequencies", "band"),
        ({"inputs": LABELS, "band": (1.0, 0.1)}, "frequencies", "band"),
    ],
)
def test_bad_arguments(exact: Table, arguments: dict, reason: str, subject: str) -> None:
    with refused(reason, subject):
        fit_memory(exact, **arguments)


def test_bad_data(exact: Table) -> None:
    damping = exact.radiation_damping.copy()
    damping[3, 0, 0] = np.nan
    with refused("not_finite"):
        fit_memory(replace(exact, radiation_damping=damping), LABELS)
    with refused("missing", "radiation_damping"):
        fit_memory(replace(exact, radiation_damping=0 * exact.radiation_damping), LABELS)
    short = replace(
        exact,
        omega=exact.omega[:6],
        added_mass=exact.added_mass[:6],
        radiation_damping=exact.radiation_damping[:6],
    )
    with refused("frequencies"):
        fit_memory(short, LABELS)


def test_eight_frequencies_are_enough(exact: Table) -> None:
    omega = np.linspace(0.3, 3.0, 8)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", MemoryFitWarning)
        memory = fit_memory(table(exact_transfer(omega), omega), LABELS)
    assert memory.report["passive"]
    assert memory.n_states >= 1


def test_froude_scaling_keeps_the_dimensionless_fit(
    exact: Table, fitted: ExponentialMemory
) -> None:
    """Lengths times 1/40: frequencies times sqrt(40), H = K t of each entry by its dimension."""
    length = 1.0 / 40.0
    faster = length**-0.5
    arm = np.array([1.0, 1.0, length])  # forces by displacements, moments by angles
    mass = length**3 * np.outer(arm, arm)
    model = replace(
        exact,
        omega=exact.omega * faster,
        added_mass=exact.added_mass * mass,
        radiation_damping=exact.radiation_damping * mass * faster,
    )
    memory = fit_memory(model, LABELS)
    assert memory.report["band"] == pytest.approx(np.array(fitted.report["band"]) * faster)
    assert memory.n_states == fitted.n_states
    omega = np.linspace(0.0, 6.0, 100)
    expected = fitted.transfer(omega) * mass * faster
    off = np.abs(memory.transfer(omega * faster) - expected).max(axis=0)
    assert np.all(off <= 1e-5 * np.abs(expected).max(axis=0))
    assert memory.added_mass_inf == pytest.approx(
        fitted.added_mass_inf * mass, rel=1e-5, abs=1e-5 * mass.min()
    )


def test_time_limit_is_checked_and_told(exact: Table) -> None:
    with refused("option", "time_limit"):
        fit_memory(exact, LABELS, time_limit=-1.0)
    assert not fit_memory(exact, LABELS).report["time_limited"]


def _noisy(table: Table) -> Table:
    """Return the table with B that gives energy at some frequencies."""
    size = np.sqrt(np.einsum("wii->wi", table.radiation_damping).max(axis=0))
    noise = np.random.default_rng(1).standard_normal(table.radiation_damping.shape)
    noise = 0.01 * (noise + noise.transpose(0, 2, 1)) * size * size[:, None]
    return replace(table, radiation_damping=table.radiation_damping + noise)


def test_no_moment_of_the_time_limit_gives_a_fit_that_is_not_passive(
    exact: Table, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The clock ends after so many looks at it: some stop the search before any fit is passive."""
    noisy = _noisy(exact)
    ends: list[str] = []
    for most in (0, 3, 10, 30, 100, 300):
        looks = 0

        def over(self: Clock, share: float = 1.0, most: int = most) -> bool:
            nonlocal looks
            looks += 1
            return looks > share * most

        monkeypatch.setattr(Clock, "over", over)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", MemoryFitWarning)
            try:
                memory = fit_memory(noisy, LABELS, max_states=12)
            except DatabaseError as error:
                ends.append(str(error))
                continue
        assert memory.passivity().relative >= -1e-4
        ends.append("")
    assert "" in ends
    assert any('run with radiation = "convolution"' in end for end in ends)
    assert all("ended the search" in end for end in ends if end)


@pytest.mark.parametrize("late", [0, 1])
def test_one_group_without_time_is_enough_to_refuse_a_fit_that_is_not_passive(
    exact: Table, monkeypatch: pytest.MonkeyPatch, late: int
) -> None:
    """Each uncoupled group has a part of the time; that of one is over, and the whole is not."""
    apart = np.ones((3, 3))
    apart[1, [0, 2]] = apart[[0, 2], 1] = 0.0
    noisy = _noisy(exact)
    noisy = replace(
        noisy,
        added_mass=noisy.added_mass * apart,
        radiation_damping=noisy.radiation_damping * apart,
    )
    given: list[Clock] = []
    part = Clock.part

    def short(self: Clock, share: float) -> Clock:
        given.append(Clock(0.0) if len(given) == late else part(self, share))
        return given[-1]

    monkeypatch.setattr(Clock, "part", short)
    with refused("time_limit"):
        fit_memory(noisy, LABELS, max_states=12)
    assert len(given) == 2


def test_inconsistent_shapes_are_refused(fitted: ExponentialMemory) -> None:
    with refused("shape", "exact"):
        replace(fitted, poles=fitted.poles[:-1])
    with refused("label", "exact"):
        replace(fitted, outputs=("a.surge", "a.heave", "a.pitch"))
    with refused("value", "poles"):
        replace(fitted, poles=-fitted.poles.conj())
