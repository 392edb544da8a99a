"""Loads after rest, and small motions, in water: the sphere in late and in low waves."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import sea, truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import case, position
from tests.stability import Scene

HEAVE = position("sphere", 2, origin=[0.0, 0.0, -sea.DRAFT])
SOURCE = "linear states of the same tables (DOP853)"


def _response(height: float, period: float) -> float:
    """Amplitude of the heave in a regular wave [m]."""
    s, w = sea.sphere(), 2.0 * np.pi / period
    radiated = s.radiation(np.array([w]))[0]
    return float(
        0.5 * height * abs(s.excitation(w) / (s.stiffness - w**2 * s.inertia + 1j * w * radiated))
    )


def _in_waves(
    title: str,
    force: Any,
    size: float,
    end: float,
    extra: dict[str, Any],
    breaks: list[float],
    settled: bool = False,
) -> Scene:
    s = sea.sphere()
    scale = np.r_[size, size, np.full(2 * len(s.poles), size)]
    exact = truth.integrated(
        rates=s.rates(force),
        start=s.start(s.lift / s.stiffness if settled else 0.0),
        place=lambda _t, y: [y[0]],
        breaks=breaks,
        scale=scale,
        longest=0.5,
        rtol=1e-10,
    )
    tables = case([sea.float_body()], end, samples=int(2.5 * end), **extra)
    if settled:  # nothing at all moves until the waves come
        tables["solver"]["start"] = "equilibrium"
    return unnamed(title, tables, size, 0.6, SOURCE, exact, HEAVE, database=sea.stored)


def _draw_group(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        height=log_uniform(g, 0.01, 2.0),
        period=g.uniform(3.5, 10.0),
        at=g.uniform(150.0, 300.0),
        settled=bool(g.integers(2)),
    )


@family("loads after rest", _draw_group)
@chosen(height=1.0, period=6.0, at=220.0)
@chosen(height=0.05, period=4.5, at=180.0)
@chosen(height=0.5, period=7.0, at=200.0, kind="ship")
@chosen(height=1.0, period=6.0, at=260.0, settled=True)
@chosen(height=0.05, period=5.0, at=220.0, settled=True)
def wave_group(height: float, period: float, at: float, settled: bool = False) -> Scene:
    """A measured group of waves after silence."""
    step, deviation, w = 0.2, 1.2 * period, 2.0 * np.pi / period
    time = step * np.arange(int((at + 120.0) / step))
    elevation = (
        0.5 * height * np.exp(-0.5 * ((time - at) / deviation) ** 2) * np.cos(w * (time - at))
    )
    elevation[np.abs(time - at) > 7.0 * deviation] = 0.0
    wave = {"name": "group", "type": "measured", "time": time, "elevation": elevation}
    return _in_waves(
        "a measured wave group after silence",
        force=sea.record(np.asarray(time), elevation),
        size=_response(height, period),
        end=at + 50.0,
        extra={"wave": [wave]},
        breaks=[max(0.0, at - 8.0 * deviation)],
        settled=settled,
    )


def _draw_low(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        height=log_uniform(g, 1e-4, 1.0), period=g.uniform(3.0, 12.0), ramp=g.uniform(5.0, 60.0)
    )


@family("small and large", _draw_low)
@chosen(height=1e-4, period=6.0, ramp=20.0)
@chosen(height=1e-3, period=5.0, ramp=20.0)
@chosen(height=1e-2, period=8.0, ramp=20.0)
@chosen(height=1.0, period=4.4, ramp=20.0)
@chosen(height=1e-3, period=6.0, ramp=20.0, kind="barge")
def low_wave(height: float, period: float, ramp: float) -> Scene:
    """A regular wave of any height."""
    wave = {"name": "swell", "type": "regular", "period": period, "height": height}
    return _in_waves(
        f"a sphere in waves of {height:g} m",
        force=sea.regular(height, period, ramp),
        size=_response(height, period),
        end=ramp + 10.0 * period,
        extra={"sea": {"ramp": ramp}, "wave": [wave]},
        breaks=[ramp],
    )


def _draw_ramp(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        height=log_uniform(g, 0.01, 1.0), period=g.uniform(3.5, 10.0), ramp=g.uniform(200.0, 800.0)
    )


@family("loads after rest", _draw_ramp)
@chosen(height=1.0, period=6.0, ramp=400.0)
@chosen(height=0.1, period=4.4, ramp=800.0)
def late_ramp(height: float, period: float, ramp: float) -> Scene:
    """A sea that grows so slowly that it begins late."""
    wave = {"name": "swell", "type": "regular", "period": period, "height": height}
    return _in_waves(
        f"a sea that grows over {ramp:g} s",
        force=sea.regular(height, period, ramp),
        size=_response(height, period),
        end=1.1 * ramp,
        extra={"sea": {"ramp": ramp}, "wave": [wave]},
        breaks=[ramp],
    )
