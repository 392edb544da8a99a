"""Parametric pitch: heave changes the righting moment of a spar, and at half the pitch period
pitch grows. Linear hydrostatics do not see it.

A body with vertical sides that is raised by z has the righting coefficient (about G, V its
displaced volume, I its water plane, all exact)

  K(z) = rho g (I + V(z) (z_B - z_G)),   dK/dz = rho g A z_G at z = 0,   d2K/dz2 = rho g A

so a driven heave a cos(w t) gives J p'' + c p' + K(a cos w t) p = 0 for small pitch p: Hill's
equation, Mathieu's but for the small quadratic part (A. H. Nayfeh and D. T. Mook, Nonlinear
Oscillations, 1979, section 5.3).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from tests.verification import hulls

import hydrodae
from hydrodae import hdb

RHO, GRAVITY, SIDES = 1000.0, 9.81, 24
RADIUS, DRAUGHT, CENTER = 3.0, 20.0, -11.0
AREA = 0.5 * SIDES * RADIUS**2 * np.sin(2.0 * np.pi / SIDES)
PLANE = AREA * RADIUS**2 * (2.0 + np.cos(2.0 * np.pi / SIDES)) / 12.0
INERTIA = 4.0e7
STIFFNESS = RHO * GRAVITY * (PLANE + AREA * DRAUGHT * (-0.5 * DRAUGHT - CENTER))
PITCH = float(np.sqrt(STIFFNESS / INERTIA))  # natural frequency of pitch [rad/s]
DAMPING = 2.0 * 0.01 * PITCH * INERTIA  # 1 % of critical


def _righting(z: float) -> float:
    """K(z) [N m]."""
    wet = DRAUGHT - z
    return float(RHO * GRAVITY * (PLANE + AREA * wet * (-0.5 * wet - CENTER - z)))


def _growth(amplitude: float, omega: float) -> float:
    """ln of the largest Floquet multiplier of pitch over one period of heave."""

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        k = _righting(amplitude * np.sin(omega * t))
        m = np.array([[0.0, 1.0], [-k / INERTIA, -DAMPING / INERTIA]])
        return np.asarray((m @ y.reshape(2, 2)).ravel())

    end = solve_ivp(rates, (0.0, 2.0 * np.pi / omega), np.eye(2).ravel(), rtol=1e-11, atol=1e-13)
    return float(np.log(np.abs(np.linalg.eigvals(end.y[:, -1].reshape(2, 2))).max()))


def _spar(folder: Path) -> hydrodae.Scene:
    profile = np.array([0.0, RADIUS, RADIUS, 0.0]), np.array([-DRAUGHT, -DRAUGHT, 10.0, 10.0])
    hulls.write_obj(folder / "spar.obj", hulls.revolved(*profile, SIDES))
    return hydrodae.Scene("spar", directory=folder)


def _driven(folder: Path, amplitude: float, omega: float, periods: int) -> np.ndarray:
    """Pitch [rad] at each period of a driven heave, its start along the growing mode."""
    scene = _spar(folder)
    scene.environment(water_density=RHO, gravity=GRAVITY)
    scene.body(
        "spar", motion=["heave", "pitch"], mass="equilibrium",
        center_of_gravity=[0.0, 0.0, CENTER], inertia=[INERTIA] * 3, mesh="spar.obj",
        hydrostatics="mesh", initial={"rotation_deg": [0.0, 1e-3, 0.0]},
    )  # fmt: skip
    scene.force.viscous_damping("loss", body="spar", linear=[0, 0, 0, 0, DAMPING, 0])
    period = 2.0 * np.pi / omega
    scene.constraint.coordinate(
        "drive",
        body="spar",
        coordinate="heave",
        drive={"amplitude": amplitude, "period": period, "phase_deg": 180.0},
    )
    scene.solver(end_time=periods * period, rtol=1e-9)
    scene.output(step=period)
    return np.asarray(hydrodae.run(scene)["bodies/spar/rotation"].values[:, 1])


@pytest.mark.parametrize("amplitude", [0.5, 1.0])
def test_pitch_grows_as_hill_says(tmp_path: Path, amplitude: float) -> None:
    pitch = np.abs(_driven(tmp_path, amplitude, 2.0 * PITCH, 14))
    rate = float(np.log(pitch[14] / pitch[8])) / 6.0
    assert rate == pytest.approx(_growth(amplitude, 2.0 * PITCH), rel=1e-3)


def test_onset_is_at_the_boundary_of_mathieu(tmp_path: Path) -> None:
    onset = float(brentq(lambda a: _growth(a, 2.0 * PITCH), 0.01, 1.0, xtol=1e-8))
    # first order: K_1 a / K_0 = 4 c / (2 J w)
    first = 2.0 * DAMPING / (INERTIA * PITCH) * STIFFNESS / (RHO * GRAVITY * AREA * -CENTER)
    assert onset == pytest.approx(first, rel=0.01)
    for factor, grows in ((0.97, False), (1.03, True)):
        pitch = np.abs(_driven(tmp_path, factor * onset, 2.0 * PITCH, 60))
        assert (pitch[60] > pitch[30]) == grows


def test_no_growth_away_from_the_resonance(tmp_path: Path) -> None:
    pitch = np.abs(_driven(tmp_path, 1.0, 1.5 * PITCH, 60))
    assert pitch[60] < 0.1 * pitch[:10].max()


def _subharmonic(results: hydrodae.Results, start: float, omega: float) -> float:
    """Amplitude of pitch [rad] at half the frequency of the wave, over four periods from `start`.

    The response at the frequency of the wave itself is fitted beside it.
    """
    time = results.time
    part = (time >= start) & (time < start + 8.0 * np.pi / (0.5 * omega))
    pitch = results["bodies/spar/rotation"].values[part, 1]
    both = [f(w * time[part]) for w in (0.5 * omega, omega) for f in (np.cos, np.sin)]
    terms = np.linalg.lstsq(np.stack(both, axis=1), pitch, rcond=None)[0]
    return float(np.hypot(*terms[:2]))


@pytest.mark.parametrize("surface", ["mesh", "linear"])
def test_only_the_wetted_surface_makes_a_spar_pitch_in_waves(tmp_path: Path, surface: str) -> None:
    """Waves at the resonance of heave, which is at half the pitch period."""
    grid, round_radius = np.linspace(0.3, 1.0, 29), float(np.sqrt(AREA / np.pi))
    places, water = {"spar": (0.0, 0.0)}, hdb.Water(grid, 200.0, rho=RHO, gravity=GRAVITY)
    cylinder = hdb.Cylinder(round_radius, DRAUGHT, CENTER)
    database = hdb.cylinders(places, cylinder, water, modes=60)[0]
    database.write(tmp_path / "hydro.h5", single=True)
    rows = database.index(["spar.heave", "spar.pitch"])
    heave, pitch = (database.added_mass[:, i, i] for i in rows)
    mass = RHO * AREA * DRAUGHT
    stiff = RHO * GRAVITY * AREA
    omega = brentq(lambda w: stiff - w**2 * (mass + np.interp(w, grid, heave)), 0.5, 0.8)
    inertia = STIFFNESS / (0.5 * omega) ** 2 - np.interp(0.5 * omega, grid, pitch)

    more: dict[str, Any] = {}
    if surface == "mesh":
        more = {"mesh": "spar.obj", "hydrostatics": "mesh", "froude_krylov": "mesh"}
    scene = _spar(tmp_path)
    scene.hydro(database="hydro.h5", radiation="constant", frequency=omega)
    scene.body(
        "spar", hydro="spar", motion=["heave", "pitch"], mass="equilibrium",
        center_of_gravity=[0.0, 0.0, CENTER], inertia=[inertia] * 3,
        initial={"rotation_deg": [0.0, 0.01, 0.0]}, **more,
    )  # fmt: skip
    scene.wave.regular("swell", height=0.1, period=2.0 * np.pi / omega)
    scene.sea(ramp=30.0)
    scene.solver(end_time=420.0, rtol=1e-6)
    results = hydrodae.run(scene)
    early, late = (_subharmonic(results, start, omega) for start in (40.0, 340.0))
    assert (late > 10.0 * early) if surface == "mesh" else late < 1.1 * early
