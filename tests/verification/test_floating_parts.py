"""Lines at rest with a part that floats, over a seabed, against chains of least energy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.mooring.line_at_rest import Catenary
from hydrodae.support.arrays import Array


class Chain:
    """Masses on springs that only pull, over a stiff bed: its energy is convex."""

    def __init__(
        self,
        x: float,
        z: float,
        parts: Sequence[tuple[float, float, float]],
        loads: tuple[float, ...],
        per_part: int,
    ) -> None:
        self.end = np.array([x, z])
        self.l = np.repeat([length / per_part for length, _, _ in parts], per_part)
        self.EA = np.repeat([EA for _, _, EA in parts], per_part)
        half = 0.5 * self.l * np.repeat([w for _, w, _ in parts], per_part)
        self.weight = half[:-1] + half[1:]
        for k, load in enumerate(loads, 1):
            self.weight[k * per_part - 1] += load
        self.bed = 1e4 * np.abs(self.weight).max()  # N/m: it lies 1e-4 m deep
        self.places = self._start()
        for part in (1e-3, 1e-2, 1e-1, 1.0):
            self._settle(part)

    def _start(self) -> Array:
        """Along the bed and straight up, a little longer than it is."""
        length, (x, z) = 1.002 * self.l.sum(), self.end
        low, high = 0.0, x
        for _ in range(60):
            flat = 0.5 * (low + high)
            low, high = (flat, high) if flat + np.hypot(x - flat, z) < length else (low, flat)
        s = np.cumsum(self.l)[:-1] / self.l.sum() * (flat + np.hypot(x - flat, z))
        up = np.maximum(s - flat, 0.0) / np.hypot(x - flat, z)
        return np.column_stack([np.minimum(s, flat) + up * (x - flat), up * z])

    def _forces(self, places: Array, part: float) -> tuple[Array, sp.csc_matrix, float]:
        nodes = np.vstack([np.zeros(2), places, self.end])
        d = np.diff(nodes, axis=0)
        r = np.hypot(d[:, 0], d[:, 1])
        e, stretch = d / r[:, None], np.maximum(r - self.l, 0.0)
        EA, deep = part * self.EA, np.minimum(places[:, 1], 0.0)
        energy = 0.5 * np.sum(EA / self.l * stretch**2) + self.weight @ places[:, 1]
        T = EA / self.l * stretch
        f = np.diff(T[:, None] * e, axis=0)
        f[:, 1] -= self.weight + self.bed * deep
        outer = e[:, :, None] * e[:, None, :]
        k = (EA / self.l * (stretch > 0.0))[:, None, None] * outer
        k += (T / r)[:, None, None] * (np.eye(2) - outer)
        n = len(places)
        main = k[:-1] + k[1:]
        main[:, 1, 1] += self.bed * (deep < 0.0)
        rows, columns, values = [], [], []
        for a in range(2):
            for b in range(2):
                i = 2 * np.arange(n)
                rows += [i + a, i[:-1] + a, i[1:] + a]
                columns += [i + b, i[1:] + b, i[:-1] + b]
                values += [main[:, a, b], -k[1:-1, a, b], -k[1:-1, a, b]]
        K = sp.csc_matrix(
            (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
            (2 * n, 2 * n),
        )
        self.tensions = T
        return f.ravel(), K, energy + 0.5 * self.bed * np.sum(deep**2)

    def _settle(self, part: float) -> None:
        """Newton's method downhill in energy, with a shift that goes to zero."""
        shift = np.abs(self.weight).max()
        f, K, energy = self._forces(self.places, part)
        for _ in range(1000):
            step = spsolve(K + shift * sp.eye(K.shape[0], format="csc"), f).reshape(-1, 2)
            step *= min(1.0, 20.0 / np.abs(step).max())
            f_new, K_new, there = self._forces(self.places + step, part)
            if there <= energy + 1e-12 * abs(energy):
                self.places = self.places + step
                f, K, energy = f_new, K_new, there
                shift *= 0.2
                if np.abs(step).max() < 1e-7:
                    return
            else:
                shift = max(5.0 * shift, 1e-9)
        raise AssertionError("the chain does not come to rest")


EA = 4e8
#: x, z of the fairlead from the anchor; length, weight, EA of the parts; loads between them.
LINES = {
    "lazy wave": (800.0, 300.0, [(360, 700, EA), (240, -500, EA), (360, 700, EA)], ()),
    "all of the lower part off the bed": (
        950.0,
        300.0,
        [(360, 700, EA), (240, -500, EA), (400, 700, EA)],
        (),
    ),
    "with a clump at the upper end of the lower part": (
        800.0,
        300.0,
        [(360, 700, EA), (240, -900, EA), (360, 700, EA)],
        (3e4, 0.0),
    ),
    "with a clump that stands on the bed": (
        850.0,
        300.0,
        [(200, 900, EA), (200, 900, EA), (200, -400, EA), (360, 500, EA)],
        (0.0, 2e5, 0.0),
    ),
    "two floating parts and a buoy": (
        1000.0,
        300.0,
        [(300, 800, EA), (150, -600, EA), (200, 300, EA), (150, -300, EA), (300, 500, EA)],
        (0.0, -2e4, 0.0, 1e4),
    ),
}


def ours(
    x: float,
    z: float,
    parts: Sequence[tuple[float, float, float]],
    loads: tuple[float, ...],
    **more: Any,
) -> Catenary:
    length, weight, stiffness = (list(column) for column in zip(*parts, strict=True))
    return hydrodae.catenary(x, z, length, weight, stiffness, loads=loads, **more)


@pytest.mark.parametrize("name", LINES)
def test_a_line_with_a_floating_part_lies_as_the_chain_of_least_energy(name: str) -> None:
    """Tensions of 240 segments a part within 1e-5; what remains falls with the segments."""
    x, z, parts, loads = LINES[name]
    line = ours(x, z, parts, loads, n=1 + round(10 * sum(part[0] for part in parts)))
    errors = []
    for per_part in (60, 240):
        chain = Chain(x, z, parts, loads, per_part)
        T = chain.tensions
        # Half of a segment hangs between the middle of the last one and the fairlead.
        s = np.cumsum(chain.l)
        middle = np.interp(s - 0.5 * chain.l, line.s, line.tension_along)
        errors.append(np.abs(T - middle).max() / line.tension)
        shape = np.column_stack([np.interp(s[:-1], line.s, v) for v in (line.x, line.z)])
        assert np.abs(chain.places - shape).max() < (0.05 if per_part == 60 else 0.02)
    assert errors[0] < 1e-4
    assert errors[1] < 1e-5
    assert line.z.min() > -1e-6 * line.s[-1]


def test_the_seabed_of_a_lazy_wave_tells() -> None:
    """Without it the lower part hangs below the anchor and pulls harder."""
    x, z, parts, loads = LINES["lazy wave"]
    on, off = ours(x, z, parts, loads), ours(x, z, parts, loads, seabed=False)
    assert on.on_seabed > 50.0
    assert off.tension > 1.1 * on.tension


@pytest.mark.parametrize("name", LINES)
def test_stiffness_and_energy_are_derivatives(name: str) -> None:
    x, z, parts, loads = LINES[name]
    line, h = ours(x, z, parts, loads), 1e-3
    for k, (dx, dz) in enumerate(((h, 0.0), (0.0, h))):
        a, b = (ours(x + q * dx, z + q * dz, parts, loads) for q in (-1, 1))
        found = [(b.horizontal - a.horizontal) / (2 * h), (b.vertical - a.vertical) / (2 * h)]
        size = np.abs(line.stiffness).max()
        assert found == pytest.approx(line.stiffness[:, k], abs=1e-5 * size)


def test_lines_that_come_down_above_what_floats_are_refused() -> None:
    """A sag of the upper part to the bed, a clump above, and a part that is pressed down."""
    for parts, loads in (
        ([(360, 700, EA), (100, -200, EA), (500, 900, EA)], ()),
        ([(100, 700, EA), (150, -500, EA), (360, 100, EA), (360, 100, EA)], (0.0, 0.0, 1e5)),
        ([(300, -100, EA), (700, 900, EA)], ()),
    ):
        with pytest.raises(CaseError, match=r"down on the seabed.*type 'line'"):
            ours(800.0, 300.0, parts, loads)


BUOY = """
[environment]
water_density = 1025.0
water_depth = 300.0
[[body]]
name = "buoy"
motion = ["surge"]
mass = 1e6
center_of_gravity = [0.0, 0.0, 0.0]
[[morison]]
name = "drag"
body = "buoy"
point = [0.0, 0.0, -1.0]
area = 1.0
volume = 1.0
drag_coefficient = 1.0
[[force]]
type = "catenary"
name = "lazy"
body_b = "buoy"
point_a = [-800.0, 0.0, -300.0]
point_b = [0.0, 0.0, 0.0]
length = [360.0, 240.0, 360.0]
weight = [700.0, -500.0, 700.0]
stiffness = [4e8, 4e8, 4e8]
MORE
[solver]
end_time = 40.0
rtol = 1e-6
[output]
step = 0.1
"""


def case(more: str = "") -> hydrodae.Case:
    return hydrodae.Case.from_text(BUOY.replace("MORE", more))


def test_check_names_a_line_that_hangs_below_the_seabed_it_does_not_feel() -> None:
    with_bed, without = (str(hydrodae.check(case(m))) for m in ("", "seabed = false"))
    assert "below the sea bed" not in with_bed
    assert "force 'lazy' hangs down to z = -377.8 m" in without
    assert "below the sea bed at -300 m" in without


def test_a_run_on_a_lazy_wave_keeps_its_energy() -> None:
    """The buoy is let go where the line pulls: what it gains is what the line stores less."""
    text = BUOY.replace("MORE", "").replace("drag_coefficient = 1.0", "drag_coefficient = 1e-9")
    run = hydrodae.run(hydrodae.Case.from_text(text))
    total, kinetic = run["energy/total"].values, run["energy/kinetic"].values
    assert np.ptp(total) < 1e-4 * kinetic.max()
    place = run["bodies/buoy/position"].values
    for k in (0, 200, 400):
        exact = ours(800.0 + place[k, 0], 300.0, LINES["lazy wave"][2], ())
        assert run["forces/lazy/tension"].values[k] == pytest.approx(exact.tension, rel=1e-9)


def test_a_run_that_presses_a_floating_part_down_stops_by_name() -> None:
    """It drives towards the anchor until the upper part sags to the seabed."""
    text = BUOY.replace("MORE", "").replace("-500.0", "-150.0")
    text = text.replace("[[morison]]", "initial = { velocity = [-40.0, 0.0, 0.0] }\n[[morison]]")
    with pytest.raises(hydrodae.SolverError, match=r"catenary 'lazy': .*down on the seabed"):
        hydrodae.run(hydrodae.Case.from_text(text))
