"""Statistical linearisation against closed forms, other integrals and the time domain."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.verification.drag_scenes import rm3_with_drag, spar

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.study.spectral import Spectral
from hydrodae.study.spectral.factors import gauss_drag, gauss_law, lorentz_drag, lorentz_law

GAUSS, LORENTZ = np.sqrt(8.0 / np.pi), 8.0 / (3.0 * np.pi)
MASS, VOLUME, DEPTH, K = 5.0e4, 10.0, 5.0, 6.0e4
INERTIA = MASS + 500.0 * VOLUME  # C_a = 0.5, rho 1000

BALL = """
[environment]
water_density = 1000.0
[[body]]
name = "ball"
motion = "heave"
mass = 5.0e4
center_of_gravity = [0.0, 0.0, -5.0]
[[force]]
type = "constant_load"
name = "lift"
body = "ball"
force = [0.0, 0.0, 490500.0]
[[joint]]
name = "guide"
type = "prismatic"
body_a = "ground"
body_b = "ball"
point = [0.0, 0.0, -5.0]
axis = [0.0, 0.0, 1.0]
[[force]]
type = "pto_linear"
name = "spring"
joint = "guide"
stiffness = 6.0e4
[[morison]]
name = "water"
body = "ball"
point = [0.0, 0.0, -5.0]
volume = 10.0
added_mass_coefficient = 0.5
"""
REGULAR = '[[wave]]\nname = "w"\ntype = "regular"\nheight = 2.0\nperiod = 6.0\n'
JONSWAP = '[[wave]]\nname = "w"\ntype = "jonswap"\nsignificant_height = 2.0\npeak_period = 6.0\n'


def along(kind: str, **values: float) -> str:
    """A force along the guide."""
    lines = [f"{key} = {value}" for key, value in values.items()]
    return f'[[force]]\ntype = "{kind}"\nname = "law"\njoint = "guide"\n' + "\n".join(lines) + "\n"


def solve(*parts: str, iterations: int = 2000) -> Spectral:
    case = hydrodae.Case.from_text(BALL + "\n".join(parts) + "\n[solver]\nend_time = 10.0\n")
    return hydrodae.spectral(case, iterations=iterations)


def wave_force(omega: float) -> float:
    """rho V (1 + C_a) a_f of a metre of amplitude."""
    return 1500.0 * VOLUME * omega**2 * float(np.exp(-(omega**2) / 9.81 * DEPTH))


def test_a_linear_damper_is_exact() -> None:
    found = solve(JONSWAP, along("pto_linear", damping=2.0e4))
    deviation, power = LinearModel(found.model.case).irregular()
    assert found.iterations == 1
    assert found.standard_deviation == pytest.approx(deviation, rel=1e-12)
    assert found.power == pytest.approx(power, rel=1e-12)
    # the mean power of a linear damper is c times the variance of its rate
    assert power["law"] == pytest.approx(2.0e4 * found.rate["joints/guide/displacement"] ** 2)


def test_quadratic_damping_in_a_regular_wave() -> None:
    """V^2 (k/w - w m)^2 + (8/(3 pi) b V^2)^2 = F^2."""
    b = 5.0e4
    found = solve(REGULAR, along("pto_general", damping=b, exponent=2.0))
    omega = 2.0 * np.pi / 6.0
    reactance, resistance = K / omega - omega * INERTIA, LORENTZ * b
    square = np.roots([resistance**2, reactance**2, -(wave_force(omega) ** 2)]).max()
    speed = np.sqrt(2.0) * found.rate["joints/guide/displacement"]
    assert speed == pytest.approx(np.sqrt(square), rel=1e-5)
    assert found.damping["law"] == pytest.approx(LORENTZ * b * speed, rel=1e-5)
    assert found.power["law"] == pytest.approx(4.0 / (3.0 * np.pi) * b * speed**3, rel=1e-5)


def test_coulomb_friction_in_a_regular_wave() -> None:
    """V^2 (k/w - w m)^2 + (4 R / pi)^2 = F^2; above F it holds the joint."""
    omega, load = 2.0 * np.pi / 6.0, 3.0e3
    found = solve(REGULAR, along("dry_friction", static=load))
    reactance = K / omega - omega * INERTIA
    speed = np.sqrt(wave_force(omega) ** 2 - (4.0 / np.pi * load) ** 2) / abs(reactance)
    assert np.sqrt(2.0) * found.rate["bodies/ball/heave"] == pytest.approx(speed, rel=1e-3)
    held = solve(REGULAR, along("dry_friction", static=2.0 * wave_force(omega)))
    assert held.rate["bodies/ball/heave"] < 1e-4 * speed
    assert any("holds its joint" in note for note in held.notes)


def test_white_noise_on_a_quadratic_damper() -> None:
    """With S_F all over, sigma_v^2 = pi S_F / (2 c m), and c = b sqrt(8/pi) sigma_v."""
    b, density = 4.0e3, 2.0e6  # N s2/m2, N2 s/rad
    omega = np.linspace(0.1, 8.0, 1500)
    force = np.array([wave_force(w) for w in omega])
    wave = (
        '[[wave]]\nname = "w"\ntype = "table"\nspacing = "frequency"\ncomponents = 8000\n'
        f"frequency_range = [0.1, 8.0]\nfrequency = {omega.tolist()}\n"
        f"density = {(density / force**2).tolist()}\n"
    )
    found = solve(wave, along("pto_general", damping=b, exponent=2.0))
    sigma = (np.pi * density / (2.0 * b * GAUSS * INERTIA)) ** (1.0 / 3.0)
    assert b * GAUSS * sigma / (2.0 * np.sqrt(K * INERTIA)) < 0.1  # narrow: the ends do not matter
    assert found.rate["bodies/ball/heave"] == pytest.approx(sigma, rel=0.02)
    assert found.damping["law"] == pytest.approx(b * GAUSS * sigma, rel=0.02)


@pytest.mark.parametrize("sigma", [1e-3, 2.0])
def test_drag_along_one_axis_is_exact(sigma: float) -> None:
    """B = sqrt(8/pi) sigma (Borgman) and 8/(3 pi) |U| (Lorentz): as a vector and as a law."""
    assert gauss_drag(np.array([[[sigma**2]]]))[0, 0, 0] == pytest.approx(GAUSS * sigma)
    assert lorentz_drag(np.array([[sigma * 1j]]))[0, 0, 0] == pytest.approx(LORENTZ * sigma)
    for law_of, factor in ((gauss_law, GAUSS), (lorentz_law, LORENTZ)):
        damping, mean = law_of(lambda v: v * np.abs(v), sigma)
        assert damping == pytest.approx(factor * sigma)
        assert abs(mean) < 1e-9 * sigma**2


def test_drag_of_vectors() -> None:
    """Along an axis, in all directions alike (4/3 and 3/2 times), on a circle, and by samples."""
    one = gauss_drag(np.diag([4.0, 0.0, 0.0])[None])[0]
    assert one[0, 0] == pytest.approx(2.0 * GAUSS, rel=1e-3)
    assert gauss_drag(np.eye(3)[None])[0] == pytest.approx(4.0 / 3.0 * GAUSS * np.eye(3))
    assert gauss_drag(np.eye(2)[None])[0] == pytest.approx(1.5 * np.sqrt(np.pi / 2) * np.eye(2))
    assert lorentz_drag(np.array([[3.0, 0.0]]))[0, 0, 0] == pytest.approx(3.0 * LORENTZ, rel=1e-4)
    circle = lorentz_drag(np.array([[2.0, 2.0j]]))[0]
    assert circle == pytest.approx(2.0 * np.eye(2))
    root = np.array([[1.0, 0.2, 0.0], [0.4, 0.7, 0.1], [0.0, 0.3, 0.2]])
    u = np.random.default_rng(1).standard_normal((400_000, 3)) @ root.T
    f = np.linalg.norm(u, axis=1)[:, None] * u
    by_samples = np.linalg.solve(u.T @ u, u.T @ f).T
    assert gauss_drag((root @ root.T)[None])[0] == pytest.approx(by_samples, abs=0.01)
    phasor = np.array([1.0 + 0.3j, -0.4 + 0.8j])
    angle = 2.0 * np.pi * np.arange(2000) / 2000
    v = np.real(np.exp(1j * angle)[:, None] * phasor)
    f = np.linalg.norm(v, axis=1)[:, None] * v
    by_samples = np.linalg.solve(v.T @ v, v.T @ f).T
    assert lorentz_drag(phasor[None])[0] == pytest.approx(by_samples, abs=1e-5)


def test_laws_of_friction_agree_where_they_are_the_same() -> None:
    load = 2.0e3
    found = [
        solve(JONSWAP, along("dry_friction", static=load)),
        solve(JONSWAP, along("friction_stribeck", static=load, creep_rate=1e-5)),
        solve(
            JONSWAP,
            along(
                "friction_lugre",
                static=load,
                stribeck_rate=1.0,
                bristle_stiffness=1e7,
                bristle_damping=1e3,
            ),
        ),
        solve(JONSWAP, along("pto_general", constant=load, reversal_rate=1e-5)),
    ]
    rates = [one.rate["bodies/ball/heave"] for one in found]
    assert rates == pytest.approx([rates[0]] * 4, rel=1e-3)
    damping = np.sqrt(2.0 / np.pi) * load / rates[0]
    assert [one.damping["law"] for one in found] == pytest.approx([damping] * 4, rel=1e-3)
    free = solve(JONSWAP)
    assert rates[0] < 0.95 * free.rate["bodies/ball/heave"]


def test_drag_on_a_body_and_along_its_guide_are_the_same() -> None:
    b = 3.0e4
    whole = '[[force]]\ntype = "viscous_damping"\nname = "law"\nbody = "ball"\n'
    body = solve(JONSWAP, whole + f"quadratic = [0.0, 0.0, {b}, 0.0, 0.0, 0.0]\n")
    joint = solve(JONSWAP, along("pto_general", damping=b, exponent=2.0))
    assert body.standard_deviation == pytest.approx(joint.standard_deviation, rel=1e-4)
    assert body.power["law"] == pytest.approx(joint.power["law"], rel=1e-4)
    edges, density = body.spectrum("bodies/ball/heave")
    variance = float(density @ np.diff(edges))
    assert variance == pytest.approx(body.standard_deviation["bodies/ball/heave"] ** 2)


def test_what_has_no_equivalent_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(CaseError, match="there is no sea"):
        solve(along("pto_general", damping=1.0, exponent=2.0))
    with pytest.raises(CaseError, match="'law': a limit of load or power on a force with 'stiff"):
        solve(JONSWAP, along("pto_general", damping=1.0, stiffness=2.0, load_limit=3.0))
    text = BALL.replace("volume = 10.0", "volume = 10.0\ndrag_coefficient = 1.0\narea = 5.0")
    current = hydrodae.Case.from_text(
        text + JONSWAP + "[sea]\ncurrent = [1.0, 0.0, 0.0]\n[solver]\nend_time = 1.0\n"
    )
    with pytest.raises(CaseError, match=r"sea\.current"):
        hydrodae.spectral(current)
    with pytest.raises(CaseError, match="did not settle in 2 iterations"):
        solve(JONSWAP, along("pto_general", damping=1e5, exponent=2.0), iterations=2)
    assert main(["spectral", "no_such.toml"]) == 2
    assert "no such case file" in capsys.readouterr().err


def test_command_prints_and_writes(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case = str(repository / "cases" / "f3of" / "waves.toml")
    for ending in (".csv", ".nc"):
        assert main(["spectral", case, "-o", str(tmp_path / f"out{ending}")]) == 0
    text = capsys.readouterr().out
    assert "standard deviation" in text
    assert "mean power of pto1" in text
    assert len((tmp_path / "out.csv").read_text().splitlines()) == 201


def test_rm3_with_drag_against_runs(rm3: Path) -> None:
    """Two seeds, five minutes each: the long study of ten is `slow`."""
    case = rm3_with_drag(rm3, 3.0).with_values({"solver.end_time": 400.0})
    found = hydrodae.spectral(case)
    runs = found.time_domain(2, settle=100.0)
    for name in runs.names:
        assert found.standard_deviation[name] == pytest.approx(runs.mean(name), rel=0.12), name
    assert (
        found.standard_deviation["joints/slide/displacement"]
        < 0.98 * (LinearModel(case).irregular()[0]["joints/slide/displacement"])
    )
    assert "times for one of them" in found.comparison(runs)


@pytest.mark.slow
@pytest.mark.parametrize("height", [1.0, 2.0, 3.0, 4.0])
@pytest.mark.parametrize("device", ["rm3", "spar"])
def test_ten_seeds(request: pytest.FixtureRequest, device: str, height: float) -> None:
    if device == "spar":
        case = spar(height)
    else:
        case = rm3_with_drag(request.getfixturevalue("rm3"), height)
    case = case.with_values({"solver.end_time": 1100.0})
    hydrodae.spectral(case)  # what is loaded at the first call is no cost of the method
    found = hydrodae.spectral(case)
    runs = found.time_domain(10, settle=150.0)
    for name in runs.names:
        assert found.standard_deviation[name] == pytest.approx(runs.mean(name), rel=0.05), name
    assert runs.solver_time.sum() > 200.0 * found.time
