"""Most likely waves: against WDRT's files, closed forms, and runs of the kernel in that wave."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.linear import LinearModel
from hydrodae.starters import create
from hydrodae.study.extremes import LikelyWave, likely_wave, write_case, write_components
from hydrodae.study.extremes.channels import Transfer
from hydrodae.study.extremes.likely_wave import amplitudes
from hydrodae.study.extremes.rayleigh import Narrow
from hydrodae.support.arrays import Array, Complex

LEVEL = 8.559  # m, the response that WDRT's files are of


def bretschneider(omega: Array, height: float, period: float) -> Array:
    """S [m2 s/rad] = 5/16 Hs^2 wp^4 w^-5 exp(-5/4 (wp/w)^4)."""
    peak = 2.0 * np.pi / period
    return np.asarray(
        5.0 / 16.0 * height**2 * peak**4 / omega**5 * np.exp(-1.25 * (peak / omega) ** 4)
    )


def as_wave(h: Complex, omega: Array, energy: Array, level: float) -> LikelyWave:
    """The wave with its peak at t = 0."""
    a, phase = amplitudes(h, energy, level)
    waves = np.column_stack([omega, a, phase, np.zeros_like(omega)])
    narrow = Narrow.of(omega, np.abs(h) ** 2 * energy)
    return LikelyWave("heave", "m", level, 0.0, 0.0, waves, h, narrow)


@pytest.fixture
def rm3(reference: Path) -> LikelyWave:
    """Heave of RM3's float, Hs 9 m, Tp 15.1 s, with the 500 frequencies of WDRT."""
    folder = reference / "extremes" / "mler_wdrt"
    if not folder.is_dir():
        pytest.skip("no reference data of extremes")
    period, size, delay = np.loadtxt(folder / "RAO_heave_RM3float.dat").T
    omega = 0.012592 * np.arange(1, 501)
    known = 2.0 * np.pi / period[::-1]
    real, imaginary = (size * part(delay) for part in (np.cos, np.sin))
    inside = omega <= known[-1]
    omega = omega[inside]
    h = np.interp(omega, known, real[::-1]) + 1j * np.interp(omega, known, imaginary[::-1])
    return as_wave(h, omega, bretschneider(omega, 9.0, 15.1) * 0.012592, LEVEL)


def test_heave_of_rm3_is_that_of_wdrt(rm3: LikelyWave) -> None:
    """Crest 8.544 and trough -5.632 m, within 0.2 %."""
    assert rm3.crest == pytest.approx(8.544, rel=2e-3)
    assert rm3.trough == pytest.approx(-5.632, rel=2e-3)
    assert float(rm3.motion(np.zeros(1))[0]) == pytest.approx(LEVEL, rel=1e-12)


def test_wave_of_rm3_over_time_is_that_of_wdrt(rm3: LikelyWave, reference: Path) -> None:
    file = "Test_heave_MLER_heaveOpt_heave_WaveAmpTime.txt"
    time, wave, motion = np.loadtxt(reference / "extremes" / "mler_wdrt" / file).T[:3]
    near = np.abs(time) <= 30.0
    assert np.abs(rm3.elevation(time[near]) - wave[near]).max() < 0.01 * 8.544
    assert np.abs(rm3.motion(time[near]) - motion[near]).max() < 0.01 * LEVEL


def test_response_of_one_is_the_new_wave() -> None:
    """H = 1: the crest is the level, and the shape the autocorrelation of the sea."""
    omega = np.linspace(0.3, 2.0, 400)
    energy = bretschneider(omega, 3.0, 10.0) * (omega[1] - omega[0])
    found = as_wave(np.ones(400, complex), omega, energy, 2.5)
    time = np.linspace(-20.0, 20.0, 41)
    shape = np.cos(np.outer(time, omega)) @ energy / energy.sum()
    assert found.elevation(time) == pytest.approx(2.5 * shape, rel=1e-12, abs=1e-12)
    assert found.crest == pytest.approx(2.5, rel=1e-6)


def test_no_other_wave_of_the_same_energy_gives_a_larger_response() -> None:
    """Of all waves with the same sum a^2 / E it has the largest response (Cauchy and Schwarz)."""
    random = np.random.default_rng(5)
    omega = np.linspace(0.3, 2.0, 50)
    energy = bretschneider(omega, 3.0, 10.0) * (omega[1] - omega[0])
    h = random.standard_normal(50) + 1j * random.standard_normal(50)
    a, phase = amplitudes(h, energy, 3.0)
    price = float(np.sum(a**2 / energy))
    assert price * float(np.sum(np.abs(h) ** 2 * energy)) == pytest.approx(9.0, rel=1e-12)
    for _ in range(100):
        other = a * np.exp(1j * phase) + 0.1 * energy * (
            random.standard_normal(50) + 1j * random.standard_normal(50)
        )
        other *= np.sqrt(price / np.sum(np.abs(other) ** 2 / energy))
        assert float(np.sum((h * other).real)) < 3.0


def regular_waves(found: LikelyWave) -> list[dict[str, object]]:
    """The components of a wave as regular waves of a case."""
    return [
        {
            "name": f"w{k}",
            "type": "regular",
            "height": 2.0 * a,
            "period": 2.0 * np.pi / w,
            "phase_deg": float(np.degrees(phase)),
            "heading_deg": float(np.degrees(heading)),
        }
        for k, (w, a, phase, heading) in enumerate(found.waves)
    ]


@pytest.mark.parametrize(
    ("kind", "channel", "recorded"),
    [
        ("point_absorber", "bodies/buoy/heave", "joints/slide/displacement"),
        ("point_absorber", "forces/pto/force", "forces/pto/force"),
        ("moored", "forces/bow/tension", "forces/bow/tension"),
    ],
)
def test_a_run_in_the_wave_has_the_response_at_its_time(
    kind: str, channel: str, recorded: str, tmp_path: Path
) -> None:
    """A small wave of 60 components, in the kernel, at the time of its peak.

    The drag on the spar of the moored device is second order in the wave.
    """
    case = hydrodae.Case.read(create(kind, tmp_path / "case"))
    values = {"solver.start": "equilibrium", "solver.end_time": 160.0, "output.step": 0.05}
    small = {**values, "wave.sea.significant_height": 0.02}
    found = likely_wave(case, channel, time=140.0, components=60, set=small)
    run = hydrodae.run(case, set={**values, "wave": regular_waves(found)})
    k = int(np.argmin(np.abs(run.time - 140.0)))
    seen = run[recorded].to_numpy()
    assert float(run["sea/elevation"][k]) == pytest.approx(
        float(found.elevation(run.time[k : k + 1])[0]), abs=1e-9
    )
    assert seen[k] - found.at_rest == pytest.approx(found.level, rel=0.02)
    assert seen[k] == pytest.approx(seen[k - 400 :].max(), rel=1e-3)


def test_level_is_the_most_probable_maximum(tmp_path: Path) -> None:
    """s sqrt(2 ln(nu T)); exceeded with p: s sqrt(2 ln(nu T / -ln(1 - p)))."""
    case = hydrodae.Case.read(create("point_absorber", tmp_path / "case"))
    found = likely_wave(case, "bodies/buoy/heave", hours=5.0)
    deviation = LinearModel(case.with_values({"wave.sea.components": 4000})).irregular()[0]
    assert found.narrow.deviation == pytest.approx(deviation["bodies/buoy/heave"], rel=2e-3)
    count = 5.0 * 3600.0 / found.narrow.period
    s = found.narrow.deviation
    assert found.level == pytest.approx(s * np.sqrt(2.0 * np.log(count)), rel=1e-12)
    rare = likely_wave(case, "bodies/buoy/heave", hours=5.0, exceedance=0.1, least=True)
    wanted = -s * np.sqrt(2.0 * np.log(count / -np.log(0.9)))
    assert rare.level == pytest.approx(wanted, rel=1e-12)
    given = likely_wave(case, "bodies/buoy/heave", response=-1.0)
    assert float(given.motion(np.array([given.time]))[0]) == pytest.approx(-1.0, rel=1e-12)


def test_channels_of_forces_agree_with_motions(tmp_path: Path) -> None:
    """The force of a damper is -c i w s, whatever the heading."""
    model = LinearModel(hydrodae.Case.read(create("flap", tmp_path / "case")))
    transfer, found = Transfer(model), model.response([0.7, 0.9])
    torque = transfer.of("forces/pto/torque", found)
    assert torque == pytest.approx(-30e6 * 1j * found.omega * found["joints/hinge/angle"])


def test_files_hold_the_wave_and_the_same_case(tmp_path: Path) -> None:
    path = create("point_absorber", tmp_path / "case")
    case = hydrodae.Case.read(path)
    found = likely_wave(case, "bodies/buoy/heave")
    file = write_components(path.parent / "wave.csv", found)
    assert file.read_text().splitlines()[0] == (
        "omega [rad/s],amplitude [m],phase [rad],heading [deg]"
    )
    table = np.loadtxt(file, delimiter=",", skiprows=1)
    back = replace(found, waves=np.column_stack([table[:, :3], np.radians(table[:, 3])]))
    assert back.crest == pytest.approx(found.crest, rel=1e-9)
    copy = write_case(case, file, path.parent / "storm.toml").read_text()
    before, after = path.read_text().split('name = "sea"')[0], copy.split('name = "likely')[0]
    assert before == after
    assert 'type = "components"\nfile = "wave.csv"\n\n[[body]]' in copy
    assert "jonswap" not in copy
