"""Lines whose tension over strain is a table, against quadratures and the linear line."""

from __future__ import annotations

import re

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq, fsolve
from tests.verification.line_scenes import IDLE, at_rest, case, line, span

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel

STRAIN = [0.0, 0.01, 0.03, 0.06]
TENSION = [0.0, 2e4, 9e4, 3e5]  # N, a rope that stiffens
SLACK = [0.0, 1.0, 9e4, 3e5]  # one that hardly pulls at first


def table(tension: list[float]) -> str:
    return f"curve_strain = {STRAIN}\ncurve_tension = {tension}"


CURVE = table(TENSION)


def keys(end: list[float], length: float, segments: int, curve: str = CURVE) -> str:
    linear = span(end, length, segments, 10.0, 1.0)
    return linear.replace("stiffness = [1.0]", curve)


def spline(tension: list[float] = TENSION) -> CubicHermiteSpline:
    """Slopes of Fritsch and Butland (1984) inside, of the chords at both ends."""
    x, y = np.array(STRAIN), np.array(tension)
    h, chord = np.diff(x), np.diff(y) / np.diff(x)
    part = (h[:-1] + 2.0 * h[1:]) / (3.0 * (h[:-1] + h[1:]))
    inside = chord[:-1] * chord[1:] / (part * chord[1:] + (1.0 - part) * chord[:-1])
    return CubicHermiteSpline(x, y, [chord[0], *inside, chord[-1]])


@pytest.mark.parametrize("strain", [0.005, 0.01, 0.02, 0.045, 0.06, 0.08])
def test_a_straight_pull(strain: float) -> None:
    weightless = "[environment]\ngravity = 0.0\n"
    text = weightless + IDLE + line(keys([10.0 * (1.0 + strain), 0.0, 0.0], 10.0, 4))
    law = spline()
    beyond = max(strain - 0.06, 0.0)
    pull = float(law(strain - beyond)) + beyond * float(law.derivative()(0.06))
    assert float(at_rest(text, "forces/line/tension")) == pytest.approx(pull, rel=1e-9)


@pytest.mark.parametrize("tension", [TENSION, SLACK])
def test_a_hanging_line_tends_to_the_quadrature_of_its_catenary(tension: list[float]) -> None:
    """Irvine, Cable Structures (1981), section 2.3, with the strain of the curve."""
    length, weight, chord = 100.0, 98.1, 101.5
    law = spline(tension)

    def strain(T: float) -> float:
        return float(brentq(lambda e: float(law(e)) - T, 0.0, 0.06))

    def reach(H: float) -> float:
        def dx(s: float) -> float:
            T = float(np.hypot(H, weight * (s - 0.5 * length)))
            return H / T * (1.0 + strain(T))

        return float(quad(dx, 0.0, length, epsabs=1e-10)[0])

    H = float(fsolve(lambda h: [reach(float(h[0])) - chord], [4e4])[0])
    exact = np.hypot(H, 0.5 * weight * length)
    errors = []
    for n in (20, 40):
        text = IDLE + line(keys([chord, 0.0, 0.0], length, n, table(tension)))
        errors.append(float(at_rest(text, "forces/line/tension")) / exact - 1.0)
    assert abs(errors[-1]) < 2e-4
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def weight_on(curve: str, length: float) -> hydrodae.Results:
    """Fall of 2 t, 10 m below the anchor, into the line."""
    text = (
        '[[body]]\nname = "weight"\nmotion = "point"\nmass = 2000.0\n'
        "center_of_gravity = [0.0, 0.0, 0.0]\n"
        + line(
            keys([0.0, 0.0, 0.0], length, 5, curve).replace(
                "point_a = [0.0, 0.0, 0.0]", 'body_b = "weight"\npoint_a = [0.0, 0.0, 10.0]'
            )
        )
    )
    return hydrodae.run(case(text, "end_time = 3.0\nrtol = 1e-9", 0.05))


@pytest.mark.parametrize("tension", [TENSION, SLACK])
def test_the_line_stores_what_is_given_to_it(tension: list[float]) -> None:
    """Work on the weight against stretch, height and motion of the line."""
    found = weight_on(table(tension), 10.5)
    stored = found["forces/line/energy"].values
    given = -found["energy/work/line"].values
    assert np.ptp(given) > 5e3  # J
    assert given == pytest.approx(stored - stored[0], abs=1e-6 * np.ptp(given))


def test_a_straight_table_is_the_linear_line() -> None:
    law = "curve_strain = [0.0, 0.004, 0.02]\ncurve_tension = [0.0, 4e3, 2e4]"
    bent, linear = (weight_on(each, 9.95) for each in (law, "stiffness = [1e6]"))
    for channel in ("bodies/weight/position", "forces/line/tension"):
        a, b = bent[channel].values, linear[channel].values
        assert np.abs(a - b).max() < 1e-8 * np.abs(b).max()
    at = "forces/line/tension"
    end = [10.1, 0.0, 0.0]
    straight = at_rest(IDLE + line(span(end, 10.0, 4, 10.0, 1e6)), at)
    assert at_rest(IDLE + line(keys(end, 10.0, 4, law)), at) == pytest.approx(straight, rel=1e-12)


def test_slow_frequencies_follow_from_the_slope() -> None:
    """A mass between two lines: w^2 = (2 T'(strain) / l) / m at every mean strain."""
    for strain in (0.01, 0.02, 0.05):
        text = "[environment]\ngravity = 0.0\n" + (
            '[[body]]\nname = "mass"\nmotion = ["surge"]\nmass = 1e8\n'
            "center_of_gravity = [0.0, 0.0, 0.0]\n"
        )
        for name, x in (("left", -10.0), ("right", 10.0)):
            there = f'body_b = "mass"\npoint_a = [{x * (1.0 + strain)}, 0.0, 0.0]'
            pull = keys([0.0, 0.0, 0.0], 10.0, 2)
            text += line(pull.replace("point_a = [0.0, 0.0, 0.0]", there), name)
        period = LinearModel(case(text)).modes()[0].period
        slope = float(spline().derivative()(strain))
        assert period == pytest.approx(2.0 * np.pi / np.sqrt(2.0 * slope / 10.0 / 1e8), rel=1e-4)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("[0.0, 0.01", "[0.0, 0.04"), r"'curve_strain' must ascend"),
        (("20000.0", "99999.0"), r"'curve_tension' must ascend"),
        (("[0.0, 0.01", "[0.001, 0.01"), r"begins at strain 0 and tension 0"),
        ((", 0.06]", "]"), r"'curve_strain' has not as many numbers as 'curve_tension'"),
        (("curve_strain", "stiffness = [1e6]\ncurve_strain"), r"leave out 'stiffness'"),
        (("curve_strain", "curve_parts = [2]\ncurve_strain"), r"no part 2"),
        ((CURVE, "curve_parts = [1]\nstiffness = [1e6]"), r"parts of which curve"),
        ((CURVE, ""), r"part 1 needs a stiffness above 0, or the curve"),
    ],
)
def test_curves_that_are_wrong(change: tuple[str, str], message: str) -> None:
    text = IDLE + line(keys([10.1, 0.0, 0.0], 10.0, 4))
    assert change[0] in text
    with pytest.raises(CaseError, match=message):
        hydrodae.Simulation(case(re.sub(re.escape(change[0]), change[1], text, count=1)))
