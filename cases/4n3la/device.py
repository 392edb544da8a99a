"""The 4N3LA device ("Squid") of the InWave+H paper: four floating nodes joined by three arms.

    python cases/4n3la/device.py irregular -o cases/4n3la/irregular.toml

Written for any layout of nodes and arms, so that larger devices take a few lines: `NODES` are
places in plan, `ARMS` pairs of nodes. What the paper does not tell is assumed; README.md beside
this file lists it.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path

import hydrodae

HERE = Path(__file__).resolve().parent

NODES = {"S3": (0.0, 0.0), "C1": (0.7, -1.21), "S1": (0.0, -2.42), "S2": (2.1, -1.21)}  # m
ARMS = {"LA1": ("C1", "S1"), "LA2": ("C1", "S2"), "LA3": ("C1", "S3")}
MOORED = ("S1", "S2", "S3")

DENSITY = 1025.0  # kg/m3
RADIUS, DRAFT = 0.3, 0.6  # m, of a node: a vertical cylinder
NODE_DEPTH, ARM_DEPTH = 0.3, 0.4  # m, of the centres of gravity; joints are at that of the arms
TUBE_RADIUS = 0.05  # m, of an arm
BALLAST = 0.01  # m, its centre of buoyancy above that of gravity: or nothing would hold its roll
LINE_LENGTH, LINE_STIFFNESS, PRETENSION = 3.0, 500.0, 15.0  # m, N, N: each of the two ropes
LINE_DAMPING = 100.0  # N s
BUOY_MASS = 1.0  # kg, where the ropes of a mooring meet

STIFFNESS, DAMPING = 60.0, 20.0  # N m/rad, N m s/rad: pitch and yaw of each take-off


def add_nodes(scene: hydrodae.Scene) -> None:
    """Cylinders that displace their mass, homogeneous over their draught."""
    mass = DENSITY * math.pi * RADIUS**2 * DRAFT
    across = mass * (3.0 * RADIUS**2 + DRAFT**2) / 12.0
    for name, (x, y) in NODES.items():
        scene.body(
            name,
            hydro=name,
            mass=mass,
            center_of_gravity=[x, y, -NODE_DEPTH],
            inertia=[across, across, 0.5 * mass * RADIUS**2],
        )


def add_arms(scene: hydrodae.Scene, stiffness: float, damping: float) -> None:
    """Tubes that displace their mass, with a ball joint and a take-off at both ends.

    The principal axes of an arm are its own: x along it, from the first node to the second.
    """
    for name, (first, second) in ARMS.items():
        (xa, ya), (xb, yb) = NODES[first], NODES[second]
        length, heading = math.hypot(xb - xa, yb - ya), math.atan2(yb - ya, xb - xa)
        volume = math.pi * TUBE_RADIUS**2 * length
        mass = DENSITY * volume
        along, across = 0.5 * mass * TUBE_RADIUS**2, mass * length**2 / 12.0
        x, y = 0.5 * (xa + xb), 0.5 * (ya + yb)
        scene.body(
            name,
            mass=mass,
            center_of_gravity=[x, y, -ARM_DEPTH],
            inertia=[along, across, across],
            principal_axes_deg=[0.0, 0.0, math.degrees(heading)],
            volume=volume,
            center_of_buoyancy=[x, y, BALLAST - ARM_DEPTH],
        )
        for node in (first, second):
            point = [*NODES[node], -ARM_DEPTH]
            scene.joint.spherical(f"{name}_{node}", body_a=name, body_b=node, point=point)
            scene.force.pto_rotary(
                f"pto_{name}_{node}",
                body_a=name,
                body_b=node,
                axis_x=[math.cos(heading), math.sin(heading), 0.0],
                stiffness=[0.0, stiffness, stiffness],
                damping=[0.0, damping, damping],
            )


def add_moorings(scene: hydrodae.Scene) -> None:
    """Two ropes in line from each outer node outwards, joined by a neutrally buoyant mass."""
    x0 = sum(x for x, _ in NODES.values()) / len(NODES)
    y0 = sum(y for _, y in NODES.values()) / len(NODES)
    for node in MOORED:
        x, y = NODES[node]
        distance = math.hypot(x - x0, y - y0)
        ex, ey = (x - x0) / distance, (y - y0) / distance
        start, middle, end = (
            [x + s * ex, y + s * ey, -NODE_DEPTH]
            for s in (RADIUS, RADIUS + LINE_LENGTH, RADIUS + 2.0 * LINE_LENGTH)
        )
        buoy = scene.body(
            f"buoy_{node}",
            motion="point",
            mass=BUOY_MASS,
            center_of_gravity=middle,
            volume=BUOY_MASS / DENSITY,
        )
        for name, bodies, points in (
            (f"rope_{node}", [node, buoy], [start, middle]),
            (f"anchor_rope_{node}", [buoy, "ground"], [middle, end]),
        ):
            scene.force.rope(
                name,
                bodies=bodies,
                points=points,
                stiffness=LINE_STIFFNESS,
                damping=LINE_DAMPING,
                pretension=PRETENSION,
            )


def device(stiffness: float = STIFFNESS, damping: float = DAMPING) -> hydrodae.Scene:
    """Scene without waves and times: what is made of it adds these.

    Parameters
    ----------
    stiffness
        Of the take-offs in pitch and yaw [N m/rad].
    damping
        [N m s/rad].
    """
    scene = hydrodae.Scene("4N3LA: four nodes, three arms", directory=HERE)
    scene.hydro(database="hydro.h5")
    add_nodes(scene)
    add_arms(scene, stiffness, damping)
    add_moorings(scene)
    return scene


def regular(period: float = 2.2, amplitude: float = 0.01) -> hydrodae.Scene:
    """Small regular waves along x."""
    scene = device()
    scene.sea(ramp=5.0 * period)
    scene.wave.regular("wave", height=2.0 * amplitude, period=period)
    scene.solver(end_time=60.0)
    scene.output(step=0.05)
    return scene


def irregular(height: float = 0.15, period: float = 2.2, seed: int = 1) -> hydrodae.Scene:
    """A wind sea along x."""
    scene = device()
    scene.sea(ramp=10.0)
    scene.wave.jonswap("sea", significant_height=height, peak_period=period, seed=seed)
    scene.solver(end_time=600.0)
    scene.output(step=0.1)
    return scene


def main() -> int:
    """Write one of the cases."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("which", choices=["regular", "irregular"])
    parser.add_argument("-o", "--output", type=Path, required=True)
    given = parser.parse_args()
    scene = regular() if given.which == "regular" else irregular()
    given.output.write_text(scene.to_toml())
    return 0


if __name__ == "__main__":
    sys.exit(main())
