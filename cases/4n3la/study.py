"""Responses of the take-offs of a device: in the frequency domain, and of runs.

The coordinates of a take-off are the turns of the node against the arm about the axes of the arm:
roll, which is free, pitch and yaw.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from parts import ARM_DEPTH, DAMPING, NODE_DEPTH, STIFFNESS, Layout
from scipy.spatial.transform import Rotation

from hydrodae import Results, Scene, run
from hydrodae.linear import LinearModel, Response
from hydrodae.linear.sea import wave_components

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
TURNS = ("roll", "pitch", "yaw")


def take_offs(layout: Layout) -> list[tuple[str, str]]:
    """Arm and node of every take-off."""
    return [(arm, node) for arm, nodes in layout.arms.items() for node in nodes]


@dataclass(frozen=True)
class Linear:
    """Response per metre of wave amplitude, and how the bodies are turned at rest."""

    response: Response
    rotations: Mapping[str, Array]  # rotation vectors from the reference pose [rad]


def turns(found: Linear, layout: Layout, arm: str, node: str) -> Complex:
    """Turns (nw, 3) of a node against an arm, axes of the arm [rad/m].

    They are small changes of the rotation vector of the node against the arm as it is at rest,
    where moorings may have turned both.
    """
    first, second = (np.array(layout.nodes[name]) for name in layout.arms[arm])
    x = (second - first) / np.linalg.norm(second - first)
    axes = np.array([[x[0], x[1], 0.0], [-x[1], x[0], 0.0], [0.0, 0.0, 1.0]])
    rest = {body: Rotation.from_rotvec(found.rotations[body]) for body in (arm, node)}

    def turned(body: str, angles: Array) -> Array:
        now = dict(rest)
        now[body] = rest[body] * Rotation.from_rotvec(angles)
        return np.asarray(axes @ (now[arm].inv() * now[node]).as_rotvec())

    total = np.zeros((found.response.omega.size, 3), dtype=complex)
    step = 1e-5
    for body in (arm, node):
        for column, turn in enumerate(TURNS):
            angles = step * np.eye(3)[column]
            slope = (turned(body, angles) - turned(body, -angles)) / (2.0 * step)
            total += np.outer(found.response[f"bodies/{body}/{turn}"], slope)
    return total


def linear(scene: Scene, omega: Sequence[float] | Array, heading: float = 0.0) -> Linear:
    """Response of a scene linearised about its equilibrium, per metre of wave amplitude."""
    model = LinearModel(scene.case())
    return Linear(model.response(np.asarray(omega, dtype=float), heading), model.rotations)


def deviation(model: LinearModel, layout: Layout, arm: str, node: str) -> float:
    """Return the standard deviation of the relative pitch in the sea of the case [deg]."""
    waves = wave_components(model.case)
    found = Linear(model.response(waves[:, 0], float(waves[0, 1])), model.rotations)
    pitch = np.abs(turns(found, layout, arm, node)[:, 1])
    return float(np.degrees(np.sqrt(0.5 * np.sum((waves[:, 2] * pitch) ** 2))))


def light_modes(scene: Scene, slowest: float = 60.0) -> list[complex]:
    """Return i w - z w of the modes that ring for long, damped by less than a twentieth [1/s]."""
    found = LinearModel(scene.case()).modes()
    return [
        2.0 * np.pi / mode.period * (1j - mode.damping_ratio)
        for mode in found
        if mode.damping_ratio < 0.05 and mode.period < slowest
    ]


def harmonic(
    results: Results, channel: str, period: float, start: float, light: Sequence[complex] = ()
) -> Complex:
    """First harmonic of a channel after `start` [s], over that of the elevation.

    A least-squares fit of a mean, the harmonic, and what still rings in the light modes.
    """
    keep = results.time > start
    time = results.time[keep]
    ringing = np.exp(np.outer(time - start, np.array([2j * np.pi / period, *light])))
    basis = np.column_stack([np.ones(time.size), ringing.real, ringing.imag])
    column = 1 + ringing.shape[1]

    def phasor(values: Array) -> Complex:
        found = np.linalg.lstsq(basis, values[keep], rcond=1e-10)[0]
        return np.asarray(found[1] - 1j * found[column])

    return np.asarray(phasor(results[channel].values) / phasor(results["sea/elevation"].values))


def regular_wave_run(scene: Scene, period: float, amplitude: float, settle: float) -> Results:
    """Run in one regular wave along x, from the equilibrium, until `settle` [s] after its ramp."""
    ramp = 8.0 * period
    wave = {"name": "wave", "type": "regular", "height": 2.0 * amplitude, "period": period}
    return run(
        scene,
        set={
            "wave": [wave],
            "sea.ramp": ramp,
            "solver.start": "equilibrium",
            "solver.end_time": ramp + settle,
            "output.step": period / 20.0,
        },
    )


def gap(results: Results, layout: Layout) -> float:
    """Largest distance of the two points of a ball joint over all samples [m]."""
    largest = 0.0
    for arm, node in take_offs(layout):
        point = np.array([*layout.nodes[node], -ARM_DEPTH])
        ends = [layout.nodes[name] for name in layout.arms[arm]]
        centers = {
            arm: np.array([*np.mean(ends, axis=0), -ARM_DEPTH]),
            node: np.array([*layout.nodes[node], -NODE_DEPTH]),
        }
        places = [_carried(results, body, point - center) for body, center in centers.items()]
        largest = max(largest, float(np.linalg.norm(places[0] - places[1], axis=1).max()))
    return largest


def power(
    results: Results, layout: Layout, stiffness: float = STIFFNESS, damping: float = DAMPING
) -> Array:
    """Power of the damping moments of all take-offs (nt,) [W]: what the springs lend is left out.

    With the moment m = -K theta - C omega of pitch and yaw it is (m + K theta)^2 / C.
    """
    total = np.zeros(results.time.size)
    for arm, node in take_offs(layout):
        channel = f"forces/pto_{arm}_{node}"
        moment = (
            results[f"{channel}/moment"].values + stiffness * results[f"{channel}/rotation"].values
        )
        total += np.sum(np.asarray(moment)[:, 1:] ** 2, axis=1) / damping
    return total


def _carried(results: Results, body: str, lever: Array) -> Array:
    """Course (nt, 3) of the point of a body at this lever from its centre of gravity [m]."""
    position = results[f"bodies/{body}/position"].values
    w, *vector = results[f"bodies/{body}/orientation"].values.T
    axis = np.stack(vector, axis=1)
    turn = 2.0 * np.cross(axis, lever)
    return np.asarray(position + lever + w[:, None] * turn + np.cross(axis, turn))
