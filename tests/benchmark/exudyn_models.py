"""Benchmark cases as Exudyn models, built from the same case files.

Redundant coordinates with Lagrange multipliers, as in the cases themselves. Point and planar bodies
have Exudyn's two-dimensional items: its y is our z, its angles turn about our -y. Knows what the
cases of peers.py hold, no more.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

vars(sys)["exudynFast"] = True  # Exudyn's build without range checks; its default is slower

import exudyn as exu  # noqa: E402
import exudyn.itemInterface as items  # noqa: E402

Array = NDArray[np.float64]

VERSION = str(exu.__version__)
GRAVITY = 9.81
COMPARED = {  # body and the joint at whose point it is compared
    "simple_pendulum": ("bob", "rod"),
    "n_four_bar_2": ("up0", "B0r"),
    "andrews": ("K1", "F"),
    "bricard": ("rod3", "hinge4"),
}
HINGE = [1, 1, 1, 1, 1, 0]  # translations, then rotations: z is free
LAST_HINGE = [1, 1, 1, 0, 1, 0]  # without the redundant row, which stops Exudyn's sparse solver


class Model:
    """One case in Exudyn."""

    def __init__(self, case: Path) -> None:
        document = tomllib.loads(case.read_text())
        self.end_time = float(document["solver"]["end_time"])
        self.output_step = float(document["output"]["step"])
        self.gravity = float(document.get("environment", {}).get("gravity", GRAVITY))
        self.planar = document["body"][0]["motion"] != "rigid"
        self.container = exu.SystemContainer()
        self.system = self.container.AddSystem()
        self.bodies = {"ground": self.system.AddObject(items.ObjectGround())}
        self.centres = {"ground": np.zeros(3)}
        for body in document["body"]:
            self.add_body(body)
        joints = document["joint"]
        for joint in joints:
            self.add_joint(joint, HINGE if joint is not joints[-1] else LAST_HINGE)
        for force in document.get("force", []):
            self.add_force(force)
        name, where = COMPARED[case.stem]
        joint = next(j for j in joints if j["name"] == where)
        self.sensor = self.system.AddSensor(
            items.SensorBody(
                bodyNumber=self.bodies[name],
                localPosition=self.on(name, joint.get("point_b", joint["point"])),
                writeToFile=False,
                outputVariableType=exu.OutputVariableType.Position,
                storeInternal=True,
            )
        )
        self.system.Assemble()

    def axes(self, vector: Any) -> list[float]:
        """Vector of ours in the axes of the model."""
        x, y, z = (float(v) for v in vector)
        return [x, z, 0.0] if self.planar else [x, y, z]

    def on(self, body: str, point: Any) -> list[float]:
        """Place on a body of a point of the start pose."""
        return self.axes(np.asarray(point) - self.centres[body])

    def marker(self, body: str, point: Any, rigid: bool = False) -> Any:
        kind = items.MarkerBodyRigid if rigid else items.MarkerBodyPosition
        place = self.on(body, point)
        return self.system.AddMarker(kind(bodyNumber=self.bodies[body], localPosition=place))

    def add_body(self, body: dict[str, Any]) -> None:
        initial = body.get("initial", {})
        centre, mass = body["center_of_gravity"], body["mass"]
        velocity = self.axes(initial.get("velocity", (0.0, 0.0, 0.0)))
        rates = initial.get("angular_velocity", (0.0, 0.0, 0.0))
        system, node, item = self.system, None, None
        if body["motion"] == "point":
            node = items.NodePoint2D(
                referenceCoordinates=self.axes(centre)[:2], initialVelocities=velocity[:2]
            )
            item = items.ObjectMassPoint2D(mass=mass, nodeNumber=system.AddNode(node))
        elif body["motion"] == "planar":
            node = items.NodeRigidBody2D(
                referenceCoordinates=self.axes(centre),
                initialVelocities=[*velocity[:2], -rates[1]],
            )
            item = items.ObjectRigidBody2D(
                mass=mass, inertia=body["inertia"][1], nodeNumber=system.AddNode(node)
            )
        elif not initial:
            node = items.NodeRigidBodyEP(referenceCoordinates=[*centre, 1.0, 0.0, 0.0, 0.0])
            item = items.ObjectRigidBody(
                mass=mass,
                inertia=[*body["inertia"], 0.0, 0.0, 0.0],
                nodeNumber=system.AddNode(node),
            )
        else:
            raise NotImplementedError(f"initial rates of the rigid body {body['name']}")
        number = system.AddObject(item)
        self.bodies[body["name"]], self.centres[body["name"]] = number, np.array(centre)
        if self.gravity:
            marker = system.AddMarker(items.MarkerBodyMass(bodyNumber=number))
            weight = self.axes((0.0, 0.0, -self.gravity))
            system.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=weight))

    def add_joint(self, joint: dict[str, Any], hinge: list[int]) -> None:
        a, b, point = joint["body_a"], joint["body_b"], joint["point"]
        item: Any
        if joint["type"] == "distance":
            end = joint["point_b"]
            item = items.ObjectConnectorDistance(
                markerNumbers=[self.marker(a, point), self.marker(b, end)],
                distance=float(np.linalg.norm(np.subtract(end, point))),
            )
        elif self.planar:
            ends = [self.marker(a, point), self.marker(b, point)]
            item = items.ObjectJointRevolute2D(markerNumbers=ends)
        else:
            axis = np.array(joint["axis"])
            turn = np.column_stack([np.roll(axis, 1), np.roll(axis, 2), axis])
            item = items.ObjectJointGeneric(
                markerNumbers=[
                    self.marker(a, point, rigid=True),
                    self.marker(b, point, rigid=True),
                ],
                constrainedAxes=hinge,
                rotationMarker0=turn,
                rotationMarker1=turn,
            )
        self.system.AddObject(item)

    def add_force(self, force: dict[str, Any]) -> None:
        if force["type"] == "spring_damper":
            ends = [self.marker(force[f"body_{side}"], force[f"point_{side}"]) for side in "ab"]
            item = items.ObjectConnectorSpringDamper(
                markerNumbers=ends, referenceLength=force["length"], stiffness=force["stiffness"]
            )
            self.system.AddObject(item)
        elif force["type"] == "constant_load" and self.planar:
            marker = self.marker(force["body"], self.centres[force["body"]], rigid=True)
            moment = [0.0, 0.0, -force["moment"][1]]
            self.system.AddLoad(items.LoadTorqueVector(markerNumber=marker, loadVector=moment))
        else:
            raise NotImplementedError(force["type"])

    def run(self, step: float, solver: str, modified_newton: bool) -> tuple[Array, float]:
        """Path of the compared point in our axes, and the processor time of SolveDynamic, s.

        The time holds the start (accelerations, first factorisation), all steps, and the point's
        position kept in memory at the output times; nothing is written to files.
        """
        settings = exu.SimulationSettings()
        settings.timeIntegration.endTime = self.end_time
        settings.timeIntegration.numberOfSteps = round(self.end_time / step)
        settings.timeIntegration.adaptiveStep = False
        settings.timeIntegration.automaticStepSize = False
        settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
        settings.timeIntegration.newton.useModifiedNewton = modified_newton
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = self.output_step
        settings.linearSolver.solverType = (
            exu.LinearSolverType.EXUdense if self.planar else exu.LinearSolverType.EigenSparse
        )
        kind = getattr(exu.DynamicSolverType, solver)
        before = time.process_time()
        self.system.SolveDynamic(settings, solverType=kind)
        seconds = time.process_time() - before
        rows = np.asarray(self.system.GetSensorStoredData(self.sensor))
        times = np.arange(len(rows)) * self.output_step
        if not np.allclose(rows[:, 0], times, rtol=0.0, atol=1e-3 * step):
            raise ValueError("Exudyn kept other times than those of the output")
        return rows[:, 1:3] if self.planar else rows[:, 1:4], seconds


def settle() -> None:
    """Go where Exudyn may leave its files: it makes a folder for solver messages."""
    os.chdir(tempfile.mkdtemp(prefix="exudyn_"))
