"""Nodes, arms, take-offs and moorings of the devices of the InWave+H paper, for any layout.

What the paper does not tell is assumed; README.md beside this file lists it.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import hydrodae
from hydrodae import hdb
from hydrodae.commands.cli import guarded
from hydrodae.support.progress import ProgressLine, StageLine

DENSITY, GRAVITY, DEPTH = 1025.0, 9.81, 10.0  # kg/m3, m/s2, m
RADIUS, DRAFT = 0.3, 0.6  # m, of a node: a vertical cylinder
NODE_DEPTH, ARM_DEPTH = 0.3, 0.4  # m, of the centres of gravity; joints are at that of the arms
TUBE_RADIUS = 0.05  # m, of an arm
BALLAST = 0.01  # m, the centre of buoyancy of an arm above that of gravity: holds its roll
JOINT_DAMPING = 0.05  # N m s/rad, of a ball joint in roll, which no take-off holds
LINE_LENGTH, LINE_STIFFNESS, PRETENSION = 3.0, 300.0, 40.0  # m, N, N: each of the two ropes
LINE_DAMPING = 30.0  # N s
BUOY_MASS, BUOY_DAMPING = 1.0, 5.0  # kg, N s/m: where the ropes of a mooring meet

STIFFNESS, DAMPING = 60.0, 20.0  # N m/rad, N m s/rad: pitch and yaw of each take-off

OMEGA = np.linspace(0.15, 12.0, 80)  # rad/s
HEADINGS = np.radians(np.arange(0.0, 360.0, 30.0))
BAND = (0.6, 7.0)  # rad/s, that a memory must fit: waves of 0.9 to 10 s


@dataclass(frozen=True)
class Layout:
    """A device in plan.

    Attributes
    ----------
    title : str
    nodes : dict of (x, y)
        Places of the nodes [m].
    arms : dict of (node, node)
        Which nodes each arm joins; its x axis goes from the first to the second.
    moored : tuple of str
        Nodes with a mooring, which goes outwards from the middle of the device.
    """

    title: str
    nodes: dict[str, tuple[float, float]]
    arms: dict[str, tuple[str, str]]
    moored: tuple[str, ...]


SQUID = Layout(
    "4N3LA: four nodes, three arms",
    nodes={"S3": (0.0, 0.0), "C1": (0.7, -1.21), "S1": (0.0, -2.42), "S2": (2.1, -1.21)},
    arms={"LA1": ("C1", "S1"), "LA2": ("C1", "S2"), "LA3": ("C1", "S3")},
    moored=("S1", "S2", "S3"),
)


def add_nodes(scene: hydrodae.Scene, layout: Layout) -> None:
    """Cylinders that displace their mass, homogeneous over their draught."""
    mass = DENSITY * math.pi * RADIUS**2 * DRAFT
    across = mass * (3.0 * RADIUS**2 + DRAFT**2) / 12.0
    for name, (x, y) in layout.nodes.items():
        scene.body(
            name,
            hydro=name,
            mass=mass,
            center_of_gravity=[x, y, -NODE_DEPTH],
            inertia=[across, across, 0.5 * mass * RADIUS**2],
        )


def add_arms(scene: hydrodae.Scene, layout: Layout, stiffness: float, damping: float) -> None:
    """Tubes that displace their mass, with a ball joint and a take-off at both ends."""
    for name, (first, second) in layout.arms.items():
        (xa, ya), (xb, yb) = layout.nodes[first], layout.nodes[second]
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
            point = [*layout.nodes[node], -ARM_DEPTH]
            scene.joint.spherical(f"{name}_{node}", body_a=name, body_b=node, point=point)
            scene.force.pto_rotary(
                f"pto_{name}_{node}",
                body_a=name,
                body_b=node,
                axis_x=[math.cos(heading), math.sin(heading), 0.0],
                stiffness=[0.0, stiffness, stiffness],
                damping=[JOINT_DAMPING, damping, damping],
            )


def add_moorings(scene: hydrodae.Scene, layout: Layout) -> None:
    """Two ropes in line from each moored node outwards, joined by a neutrally buoyant mass.

    They are as deep as the joints of the arms, so that their pretension turns no node.
    """
    x0, y0 = np.mean(list(layout.nodes.values()), axis=0)
    for node in layout.moored:
        x, y = layout.nodes[node]
        distance = math.hypot(x - x0, y - y0)
        ex, ey = (x - x0) / distance, (y - y0) / distance
        start, middle, end = (
            [x + s * ex, y + s * ey, -ARM_DEPTH]
            for s in (RADIUS, RADIUS + LINE_LENGTH, RADIUS + 2.0 * LINE_LENGTH)
        )
        buoy = scene.body(
            f"buoy_{node}",
            motion="point",
            mass=BUOY_MASS,
            center_of_gravity=middle,
            volume=BUOY_MASS / DENSITY,
        )
        drag = [BUOY_DAMPING] * 3 + [0.0] * 3
        scene.force.viscous_damping(f"drag_{node}", body=buoy, linear=drag)
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


def device(
    layout: Layout, directory: str | Path, stiffness: float = STIFFNESS, damping: float = DAMPING
) -> hydrodae.Scene:
    """Scene without waves and times.

    Parameters
    ----------
    layout : Layout
    directory : path
        Folder of its hydro.h5.
    stiffness, damping : float
        Of the take-offs in pitch and yaw [N m/rad], [N m s/rad].
    """
    scene = hydrodae.Scene(layout.title, directory=directory)
    scene.hydro(database="hydro.h5")
    add_nodes(scene, layout)
    add_arms(scene, layout, stiffness, damping)
    add_moorings(scene, layout)
    return scene


def regular(scene: hydrodae.Scene, period: float = 2.2, amplitude: float = 0.01) -> hydrodae.Scene:
    """Add small regular waves along x, and 60 s."""
    scene.sea(ramp=5.0 * period)
    scene.wave.regular("wave", height=2.0 * amplitude, period=period)
    scene.solver(end_time=60.0)
    scene.output(step=0.05)
    return scene


def irregular(
    scene: hydrodae.Scene, height: float = 0.15, period: float = 2.2, seed: int = 1
) -> hydrodae.Scene:
    """Add a wind sea along x, and 600 s."""
    scene.sea(ramp=10.0)
    scene.wave.jonswap("sea", significant_height=height, peak_period=period, seed=seed)
    scene.solver(end_time=600.0)
    scene.output(step=0.1)
    return scene


def database(layout: Layout, *, fit: bool = True) -> hdb.HydroDatabase:
    """Make the database of the nodes by interaction theory, with its radiation memory.

    Parameters
    ----------
    layout : Layout
    fit : bool
        Whether to fit the memory of all coordinates; H is right to 1 % of its largest value.
    """
    water = hdb.Water(OMEGA, DEPTH, HEADINGS, DENSITY, GRAVITY)
    node = hdb.Cylinder(RADIUS, DRAFT, -NODE_DEPTH)
    with ProgressLine(f"{len(layout.nodes)} nodes", "frequencies") as line:
        made, report = hdb.cylinders(layout.nodes, node, water, orders=3, progress=line)
    print(report)
    if not fit:
        return made
    with StageLine("memory") as stage:
        return hdb.fit(made, "all", name="all", band=BAND, uniform=0.01, progress=stage)


def main(layout: Layout, directory: Path) -> int:
    """Make what the command line names: the database of a device, its cases, figures."""
    parser = argparse.ArgumentParser()
    parser.add_argument("what", choices=["database", "cases", "checks", "pictures"])
    what = parser.parse_args().what
    return guarded(lambda: make(what, layout, directory))


def make(what: str, layout: Layout, directory: Path) -> None:
    """Make one of them in the folder of a device."""
    if what == "database":
        database(layout).write(directory / "hydro.h5")
    elif what == "cases":
        for add in (regular, irregular):
            text = add(device(layout, directory)).to_toml()
            (directory / f"{add.__name__}.toml").write_text(text)
    elif what == "checks":
        import checks

        checks.show(layout, directory)
    else:
        import pictures

        pictures.draw(layout, directory)
