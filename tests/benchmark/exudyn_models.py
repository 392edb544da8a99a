"""Benchmark cases as Exudyn models, built from the same case files.

Point and planar bodies lie in our x-z plane; there Exudyn's y is our z and its angles turn about
our -y. Redundant coordinates with Lagrange multipliers throughout, as in the case itself. Knows
only what the cases of peers.py hold; anything else is an error.
"""

from __future__ import annotations

import sys
import time
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

vars(sys)["exudynFast"] = True  # Exudyn's build without range checks, with AVX2

import exudyn as exu  # noqa: E402
import exudyn.itemInterface as items  # noqa: E402

Array = NDArray[np.float64]

GRAVITY = 9.81
END = {  # where the compared point lies on its body, from the centre of gravity
    "simple_pendulum": ("bob", (0.0, 0.0, 0.0)),
    "n_four_bar_2": ("up0", (0.0, 0.0, 0.5)),
    "andrews": (
        "K1",
        (0.006986674115451445 - 0.0009182485980307614, 0.0, -0.0004317230645688955 + 5.674074562905483e-5),
    ),
    "bricard": ("rod3", (0.5, 0.0, 0.0)),
}


class Model:
    """One case in Exudyn, ready to be run more than once."""

    def __init__(self, case: Path, drop_row: bool = False) -> None:
        document = tomllib.loads(case.read_text())
        self.system = exu.SystemContainer().AddSystem()
        self.end_time = float(document["solver"]["end_time"])
        self.output_step = float(document["output"]["step"])
        self.planar = document["body"][0]["motion"] != "rigid"
        self.gravity = -float(document.get("environment", {}).get("gravity", GRAVITY))
        self.drop_row = drop_row
        self.origins = {"ground": np.zeros(3)}
        self.bodies = {"ground": self.system.AddObject(items.ObjectGround())}
        for body in document["body"]:
            self.add_body(body)
        for joint in document["joint"]:
            self.add_joint(joint, last=joint is document["joint"][-1])
        for force in document.get("force", []):
            self.add_force(force)
        name, point = END[case.stem]
        self.sensor = self.system.AddSensor(
            items.SensorBody(
                bodyNumber=self.bodies[name],
                localPosition=self.local(np.array(point)),
                writeToFile=False,
                outputVariableType=exu.OutputVariableType.Position,
                storeInternal=True,
            )
        )
        self.system.Assemble()

    def local(self, vector: Array) -> list[float]:
        """Vector of ours in the axes of the model."""
        return [vector[0], vector[2], 0.0] if self.planar else [float(v) for v in vector]

    def add_body(self, body: dict[str, Any]) -> None:
        initial = body.get("initial", {})
        centre = np.array(body["center_of_gravity"])
        velocity = np.array(initial.get("velocity", np.zeros(3)))
        rates = np.array(initial.get("angular_velocity", np.zeros(3)))
        mass, system = body["mass"], self.system
        number: int
        if body["motion"] == "point":
            node = system.AddNode(
                items.NodePoint2D(
                    referenceCoordinates=self.local(centre)[:2],
                    initialVelocities=self.local(velocity)[:2],
                )
            )
            number = system.AddObject(items.ObjectMassPoint2D(mass=mass, nodeNumber=node))
        elif body["motion"] == "planar":
            node = system.AddNode(
                items.NodeRigidBody2D(
                    referenceCoordinates=self.local(centre),
                    initialVelocities=[*self.local(velocity)[:2], -rates[1]],
                )
            )
            number = system.AddObject(
                items.ObjectRigidBody2D(mass=mass, inertia=body["inertia"][1], nodeNumber=node)
            )
        elif body["motion"] == "rigid" and not rates.any() and not velocity.any():
            node = system.AddNode(NODE(centre))
            number = system.AddObject(
                items.ObjectRigidBody(
                    mass=mass, inertia=[*body["inertia"], 0.0, 0.0, 0.0], nodeNumber=node
                )
            )
        else:
            raise NotImplementedError(body)
        self.bodies[body["name"]] = number
        self.origins[body["name"]] = centre
        if self.gravity:
            mass_marker = system.AddMarker(items.MarkerBodyMass(bodyNumber=number))
            weight = self.local(np.array([0.0, 0.0, self.gravity]))
            system.AddLoad(items.LoadMassProportional(markerNumber=mass_marker, loadVector=weight))

    def marker(self, body: str, point: list[float], rigid: bool = False) -> int:
        """Marker on a body at a point given in the world at the start."""
        kind = items.MarkerBodyRigid if rigid else items.MarkerBodyPosition
        place = self.local(np.array(point) - self.origins[body])
        marker: int = self.system.AddMarker(kind(bodyNumber=self.bodies[body], localPosition=place))
        return marker

    def add_joint(self, joint: dict[str, Any], last: bool) -> None:
        sides, point = (joint["body_a"], joint["body_b"]), joint["point"]
        if joint["type"] == "distance":
            length = float(np.linalg.norm(np.subtract(joint["point_b"], point)))
            ends = [self.marker(b, p) for b, p in zip(sides, (point, joint["point_b"]), strict=True)]
            self.system.AddObject(items.ObjectConnectorDistance(markerNumbers=ends, distance=length))
        elif self.planar:
            ends = [self.marker(body, point) for body in sides]
            self.system.AddObject(items.ObjectJointRevolute2D(markerNumbers=ends))
        else:
            ends = [self.marker(body, point, rigid=True) for body in sides]
            axis = np.array(joint["axis"])
            turn = np.column_stack([np.roll(axis, 1), np.roll(axis, 2), axis])
            self.system.AddObject(
                items.ObjectJointGeneric(
                    markerNumbers=ends,
                    constrainedAxes=DROP if last and self.drop_row else [1, 1, 1, 1, 1, 0],
                    rotationMarker0=turn,
                    rotationMarker1=turn,
                )
            )

    def add_force(self, force: dict[str, Any]) -> None:
        if force["type"] == "spring_damper":
            ends = [self.marker(force[f"body_{s}"], force[f"point_{s}"]) for s in "ab"]
            self.system.AddObject(
                items.ObjectConnectorSpringDamper(
                    markerNumbers=ends, referenceLength=force["length"], stiffness=force["stiffness"]
                )
            )
        elif force["type"] == "constant_load" and self.planar:
            centre = list(self.origins[force["body"]])
            marker = self.marker(force["body"], centre, rigid=True)
            moment = [0.0, 0.0, -force["moment"][1]]
            self.system.AddLoad(items.LoadTorqueVector(markerNumber=marker, loadVector=moment))
        else:
            raise NotImplementedError(force)

    def run(self, step, solver, change=None):
        s = exu.SimulationSettings()
        s.timeIntegration.endTime = self.end_time
        s.timeIntegration.numberOfSteps = round(self.end_time / step)
        s.timeIntegration.adaptiveStep = False
        s.timeIntegration.automaticStepSize = False
        s.timeIntegration.verboseMode = 0
        s.solution.file.write = False
        s.solution.sensors.writePeriod = self.output_step
        s.displayComputationTime = False
        if change: change(s)
        before = time.perf_counter(), time.process_time()
        ok = self.system.SolveDynamic(s, solverType=solver, storeSolver=True, showCausingItems=False)
        after = time.perf_counter(), time.process_time()
        rows = self.system.GetSensorStoredData(self.sensor)
        return ok, after[0]-before[0], after[1]-before[1], rows

DROP = [1,1,1,1,0,0]
def NODE(centre):
    return items.NodeRigidBodyEP(referenceCoordinates=[*centre, 1,0,0,0])
