"""Powers of a take-off of PTO-Sim from its own equations, at the motion that a run has.

These are the equations of the blocks in WECSim_Lib_PTOSim.slx, integrated by scipy without the
kernel: both chambers of the cylinder, four check valves, accumulators, motor, shaft, armature and
the controller of its load; the fluxes of a linear generator; in one regular wave, a gear with its
generator together with linear theory of the body.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from hydrodae.results import Results
from hydrodae.wecsim.case import _input_file, _model_file
from hydrodae.wecsim.m_file import read_input
from hydrodae.wecsim.ptosim_trace import Chain, find_chain
from hydrodae.wecsim.slx import read_slx

_RAD = math.pi / 30.0  # of rpm


def chain_of(folder: Path) -> Chain:
    """The chain of the first take-off of an example that blocks of PTO-Sim drive."""
    read = read_input(_input_file(folder))
    for block in read_slx(_model_file(read)).blocks:
        kind = "Rotational" if block.kind.startswith("Rotational") else "Translational"
        if " PTO Actuation" in block.kind and (chain := find_chain(block, kind, read)):
            return chain
    raise ValueError(f"{folder}: no take-off of PTO-Sim")


def sizes(chain: Chain, kind: str) -> dict[str, Any]:
    """Fields of an item by their last name."""
    return {k.rpartition(".")[2]: e.value for k, e in chain.items[kind].entries.items()}


def stroke(chain: Chain, results: Results, joint: str) -> np.ndarray:
    """Position of the piston [m], by the geometry of crank and rod; WEC-Sim turns about -y."""
    for kind, rod in (("linCrank", "rodLength"), ("adjustableRod", "rodInit")):
        if kind in chain.items:
            p, angle = sizes(chain, kind), -np.asarray(results[f"joints/{joint}/angle"])
            c, length, across = p["crank"], p[rod], p["crank"] * np.cos(angle) - p["offset"]
            far = math.sqrt(length**2 - (c - p["offset"]) ** 2)
            if kind == "linCrank":
                return np.asarray(c * np.sin(angle) + np.sqrt(length**2 - across**2) - far)
            return np.asarray(np.hypot(across, far - c * np.sin(angle)) - length)
    return np.asarray(results[f"joints/{joint}/displacement"])


def hydraulic(chain: Chain, results: Results, joint: str) -> dict[str, float]:
    """Mean powers after the ramp [W] of cylinder, rectifier, accumulators, motor and generator."""
    c, v = sizes(chain, "hydraulicCyl"), sizes(chain, "rectCheckValve")
    m = sizes(chain, "hydraulicMotor")
    e = {"bShaft": 0.1, "wShaftIni": 0.0} | sizes(chain, "electricGen")
    gas = [sizes(chain, side) for side in ("high", "low")]
    time = np.asarray(results.time)
    place = CubicSpline(time, stroke(chain, results, joint))
    rate = place.derivative()
    d = m["displacement"] * 1e-6 / (2.0 * math.pi)
    vol, mech = float(m["effTableVolEff"][0, 0]), float(m["effTableMechEff"][0, 0])
    half = 0.5 * (v["Amax"] - v["Amin"])

    def valve(p: float) -> float:
        area = v["Amin"] + half * (1.0 + math.tanh(v["k2"] * (p - 0.5 * (v["pMax"] + v["pMin"]))))
        return float(v["Cd"] * area * math.sqrt(2.0 * p * math.tanh(v["k1"] * p) / v["rho"]))

    def pressures(y: Any) -> list[Any]:
        return [
            g["pIprecharge"] * (g["vI0"] / (g["vI0"] - y[2 + i])) ** 1.4 for i, g in enumerate(gas)
        ]

    def slope(t: float, y: np.ndarray) -> list[float]:
        x, s = float(place(t)), float(rate(t))
        high, low = pressures(y)
        out = valve(y[0] - high), valve(y[1] - high)
        into = valve(low - y[0]), valve(low - y[1])
        flow, error = d * y[4] / vol, chain.speed - y[4] / _RAD
        load = chain.gains[0] * error + chain.gains[1] * y[6]
        at_a, at_b = c["Ap_A"] * (c["xi_piston"] - x), c["pistonStroke"] - c["xi_piston"] + x
        at_b *= c["Ap_B"]
        return [
            c["bulkModulus"] / at_a * (c["Ap_A"] * s - out[0] + into[0]),
            c["bulkModulus"] / at_b * (-c["Ap_B"] * s - out[1] + into[1]),
            out[0] + out[1] - flow,
            flow - into[0] - into[1],
            (e["Ke"] * y[5] - e["bShaft"] * y[4] + d * mech * (high - low)) / e["Jem"],
            (-e["Ke"] * y[4] - (e["Ra"] + load) * y[5]) / e["La"],
            error,
        ]

    start = [c["pAi"], c["pBi"], 0.0, 0.0, e["wShaftIni"] * _RAD, 0.0, 0.0]
    loose = [10.0, 10.0, 1e-8, 1e-8, 1e-5, 1e-5, 1e-4]
    found = solve_ivp(
        slope, (0.0, time[-1]), start, "LSODA", time[::5], rtol=1e-6, atol=loose, max_step=0.05
    )
    kept = found.t >= results.settled
    y, t = found.y[:, kept], found.t[kept]
    high, low = pressures(y)
    load = chain.gains[0] * (chain.speed - y[4] / _RAD) + chain.gains[1] * y[6]
    powers = {
        "absorbed": (c["Ap_A"] * y[0] - c["Ap_B"] * y[1]) * rate(t),
        "hydraulic": d * y[4] / vol * (high - low),
        "shaft": d * mech * (high - low) * y[4],
        "electric": load * y[5] ** 2,
    }
    return {name: float(np.mean(power)) for name, power in powers.items()}


def linear_generator(chain: Chain, results: Results, joint: str) -> dict[str, float]:
    """Mean powers after the ramp [W] of the fluxes of a linear generator on resistors."""
    p = sizes(chain, "ddLinearGen")
    time, turn = np.asarray(results.time), math.pi / p["tau_p"]
    rate = CubicSpline(time, results[f"joints/{joint}/displacement_rate"])
    ohm = p["Rs"] - p["Rload"]

    def slope(t: float, y: np.ndarray) -> list[float]:
        w = turn * float(rate(t))
        currents = (y[0] - p["lambda_fd"]) / p["Ls"], y[1] / p["Ls"]
        return [w * y[1] - ohm * currents[0], -w * y[0] - ohm * currents[1]]

    kept = time[time >= results.settled]
    start = [p["lambda_fd"], 0.0]
    begin = max(0.0, results.settled - 1.0)
    found = solve_ivp(slope, (begin, time[-1]), start, "LSODA", kept, rtol=1e-8, max_step=0.05)
    along, across = (found.y[0] - p["lambda_fd"]) / p["Ls"], found.y[1] / p["Ls"]
    shaft = -turn * p["lambda_fd"] * across * rate(kept)
    powers = {
        "absorbed": shaft - p["Bfric"] * rate(kept) ** 2,
        "shaft": shaft,
        "electric": -p["Rload"] * (along**2 + across**2),
    }
    return {name: float(np.mean(power)) for name, power in powers.items()}


def direct_drive(chain: Chain, omega: float, rest: complex, force: complex) -> dict[str, float]:
    """Mean powers [W] of a gear and generator on a body of impedance `rest` [N s/m] at `omega`."""
    p = sizes(chain, "simpleDDPTO")
    law, gear = chain.law, p["gearRatio"]
    assert law is not None
    ohm = p["windingResistance"]
    answer = (law.damping + law.stiffness / (1j * omega)) / (
        1.0 + 1j * omega * p["windingInductance"] / ohm
    )
    train = gear**2 * (1j * omega * p["drivetrainInertia"] + p["drivetrainFriction"])
    square = abs(force / (rest + train + answer)) ** 2
    shaft = 0.5 * square * answer.real
    current = math.sqrt(square) * abs(answer) / gear / p["torqueConstant"]
    return {
        "absorbed": shaft + 0.5 * square * train.real,
        "shaft": shaft,
        "electric": shaft - 0.5 * ohm * current**2,
    }
