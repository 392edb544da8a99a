"""Laws of the blocks of PTO-Sim, as curves and numbers of forces."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.wecsim.m_text import NotEvaluated
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.stages import Term, term

_FASTEST = 5.0  #: m/s, the last point of a curve
_PERIOD = 0.1  #: s, between two answers of the speed controller


def linear_generator(
    pitch: float, flux: float, inductance: float, resistance: float
) -> tuple[list[float], list[float]]:
    """Load of a synchronous linear generator on resistors over its rate.

    With p = pi / pitch, w = p s' and both fluxes at rest in the moving frame:
    f = -(p flux)^2 s' / (R (1 + (w L / R)^2)).
    """
    turn = math.pi / pitch
    at = np.linspace(-_FASTEST, _FASTEST, 41)
    slip = turn * at * inductance / resistance
    loads = (turn * flux) ** 2 * at / (resistance * (1.0 + slip**2))
    return at.tolist(), loads.tolist()


def valve_curve(
    area: float, discharge: float, density: float, opening: list[float], first: float
) -> tuple[list[float], list[float]]:
    """Load of two check valves in series with a piston, over its rate.

    A valve passes Q = Cd A(p) sqrt(2 p / rho); A grows from A_min to A_max as a tanh about the
    middle of p_min and p_max, at which it is within A_min / (A_max - A_min) of its ends.
    """
    least, most, shut, full = opening
    middle, half = 0.5 * (full + shut), 0.5 * (most - least)
    steep = math.atanh((least - half) / half) / (shut - middle)
    drop = np.geomspace(1.0, 1e9, 4000)
    flow = discharge * (least + half * (1.0 + np.tanh(steep * (drop - middle))))
    flow = flow * np.sqrt(2.0 * drop / density)
    rates = np.concatenate([np.geomspace(first, 0.1, 7)[:-1], np.arange(0.1, _FASTEST, 0.2)])
    loads = 2.0 * area * np.interp(rates * area, flow, drop)
    both = [np.concatenate([-x[::-1], [0.0], x]).tolist() for x in (rates, loads)]
    return both[0], both[1]


@dataclass
class Motor:
    """A hydraulic motor on the shaft of a generator with a load resistor that holds its speed.

    J w' = T - b w - Ke i, i = Ke w / (Ra + R) (windings at rest), T = d eta_m p, Q = d w / eta_v

    Attributes
    ----------
    displacement : float
        d [m3/rad].
    volumetric, mechanical : float
        eta_v, eta_m at the set speed.
    speed : float
        Set speed [rad/s].
    resistance, constant, friction, inertia : float
        Ra [ohm], Ke [V s/rad], b [N m s], J [kg m2].
    """

    displacement: float
    volumetric: float
    mechanical: float
    speed: float
    resistance: float
    constant: float
    friction: float
    inertia: float

    @classmethod
    def of(cls, motor: Item, machine: Item, rpm: float, drop: float, read: InputFile) -> Motor:
        """Of two items of an input file.

        Raises
        ------
        NotEvaluated
            A size is missing, or the efficiencies are not those of a table.
        """
        size = motor.number_of("hydraulicMotor.displacement")
        if not size > 0.0:
            raise NotEvaluated(f"{motor.title}.hydraulicMotor.displacement is missing")
        if motor.number_of("hydraulicMotor.effModel") != 2.0:
            raise NotEvaluated(f"{motor.title}: efficiencies by formula (effModel = 1)")
        volumetric = _map(motor, "effTableVolEff", rpm, drop, read)
        mechanical = _map(motor, "effTableMechEff", rpm, drop, read)
        part = "electricGeneratorEC"
        of_machine = [machine.number_of(f"{part}.{k}", 0.1) for k in _MACHINE]
        machine.used |= {f"{part}.{k}" for k in ("La", "currentIni", "wShaftIni")}
        of_motor = (size * 1e-6 / (2.0 * math.pi), volumetric, mechanical)
        return cls(*of_motor, rpm * math.pi / 30.0, *of_machine)

    def loading(self, drop: float) -> float:
        """Ke^2 / (Ra + R) that holds the speed at a pressure drop [N m s]."""
        return self.displacement * self.mechanical * drop / self.speed - self.friction

    def conductance(self, drop: float) -> float:
        """Flow at the set speed over the pressure drop [m3/(s Pa)]."""
        return self.displacement * self.speed / (self.volumetric * drop)

    def controller(self, name: str, gains: tuple[float, float], drop: float) -> dict[str, Any]:
        """The PI on the load resistor, as one on the conductance of the motor.

        At rest G = d^2 eta_m / eta_v / (b + Ke^2 / (Ra + R)); its slope by R at the set speed
        turns the gains [ohm/rpm] into those of the flow.
        """
        y = self.loading(drop)
        if not y > 0.0:
            raise NotEvaluated("the motor does not reach its set speed at the first pressures")
        most = self.displacement**2 * self.mechanical / self.volumetric
        slope = most * (y / self.constant) ** 2 / (self.friction + y) ** 2  # by R
        slope *= self.volumetric / self.displacement * 30.0 / math.pi  # rpm of a flow
        return {
            "type": "pid",
            "name": f"{name}_speed",
            "inputs": [f"forces/{name}_fluid/motor_flow"],
            "outputs": [f"forces/{name}_fluid/motor_conductance"],
            "period": _PERIOD,
            "target": self.displacement * self.speed / self.volumetric,
            "gain_p": gains[0] * slope,
            "gain_i": gains[1] * slope,
            "lower": 0.0,
            "upper": most / self.friction if self.friction > 0.0 else None,
            "tracking_time": None if gains[0] else shaft_lag(self, drop),
            "lag": shaft_lag(self, drop),
        }

    def stages(self, channel: str) -> tuple[list[Term], list[Term]]:
        """Power of the shaft, and electric power of the load, from that of the fluid.

        P_s = eta_v eta_m P,  P_e = P_s - b w^2 - Ra i^2 with i = (P_s / w - b w) / Ke.
        """
        share, w = self.volumetric * self.mechanical, self.speed
        ratio = self.resistance / self.constant**2
        lost = self.friction * w**2
        electric = [
            {"factor": float(f"{-lost - ratio * (self.friction * w) ** 2:.12g}")},
            term(channel, share * (1.0 + 2.0 * ratio * self.friction)),
            term(channel, -ratio * (share / w) ** 2, 2),
        ]
        return [term(channel, share)], electric


def shaft_lag(motor: Motor, drop: float) -> float:
    """Time constant of the shaft at its set speed [s]: J / (b + Ke^2 / (Ra + R))."""
    return motor.inertia / (motor.friction + motor.loading(drop))


#: Fields of a generator, in the order of a Motor; 0.1 by default in WEC-Sim.
_MACHINE = ("Ra", "Ke", "bShaft", "Jem")


def _map(motor: Item, name: str, rpm: float, drop: float, read: InputFile) -> float:
    """Efficiency of a table over speed [rpm] and pressure drop [Pa], at one point."""
    from scipy.interpolate import RegularGridInterpolator

    part = "hydraulicMotor"
    axes = [motor.vector(f"{part}.effTable{axis}", []) for axis in ("ShaftSpeed", "DeltaP")]
    table = np.atleast_2d(np.asarray(motor.get(f"{part}.{name}"), dtype=float))
    if table.shape != (axes[0].size, axes[1].size):
        raise NotEvaluated(f"{motor.title}.{part}.{name} does not fit its axes")
    if np.ptp(table) > 0.0:
        read.remarks.assumed(
            read.place(motor.line_of(f"{part}.{name}")),
            f"{motor.title}: {name} at the set speed and the first pressures",
        )
    point = [np.clip(x, a[0], a[-1]) for x, a in zip((rpm, drop), axes, strict=True)]
    return float(RegularGridInterpolator(axes, table)(point)[0])
