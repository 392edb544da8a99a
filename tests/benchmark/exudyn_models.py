"""Benchmark cases as Exudyn models, built from the same case files.

Redundant coordinates with Lagrange multipliers, as in the cases themselves. Cases without a rigid
body have Exudyn's two-dimensional items: its y is our z, its angles turn about our -y. Knows what
the cases of peers.py hold, no more.
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from tests.benchmark.peer_problems import EACH_STEP, FULL, Compared, Setting

from hydrodae.support.arrays import Array

vars(sys)["exudynFast"] = True  # Exudyn's build without range checks; its default is slower

import exudyn as exu  # noqa: E402
import exudyn.itemInterface as items  # noqa: E402
import exudyn.utilities as tools  # noqa: E402

VERSION = str(exu.__version__)
GRAVITY = 9.81
# constrained translations, then rotations, of a joint whose axis is z
FIXED = {"revolute": (1, 1, 1, 1, 1, 0), "prismatic": (1, 1, 0, 1, 1, 1)}


class Model:
    """One case in Exudyn."""

    def __init__(self, case: Path, compared: Compared, setting: Setting) -> None:
        document = tomllib.loads(case.read_text())
        self.setting = setting
        self.end_time = float(document["solver"]["end_time"])
        self.output_step = float(document["output"]["step"])
        self.gravity = float(document.get("environment", {}).get("gravity", GRAVITY))
        bodies, joints = document["body"], document.get("joint", [])
        self.planar = all(body.get("motion", "rigid") != "rigid" for body in bodies)
        self.container = exu.SystemContainer()
        self.system = self.container.AddSystem()
        self.bodies = {"ground": self.system.AddObject(items.ObjectGround())}
        self.centres = {"ground": np.zeros(3)}
        self.turns = {"ground": np.eye(3)}
        self.nodes: dict[str, Any] = {}
        for body in bodies:
            self.add_body(body)
        for joint in joints:
            self.add_joint(joint)
        for force in document.get("force", []):
            self.add_force(force)
        place = [0.0, 0.0, 0.0]
        if compared.joint:
            joint = next(j for j in joints if j["name"] == compared.joint)
            place = self.on(compared.body, joint.get("point_b", joint["point"]))
        self.sensor = self.system.AddSensor(
            items.SensorBody(
                bodyNumber=self.bodies[compared.body],
                localPosition=place,
                writeToFile=False,
                outputVariableType=getattr(exu.OutputVariableType, compared.quantity),
                storeInternal=True,
            )
        )
        self.system.Assemble()

    def axes(self, vector: Any) -> list[float]:
        """Vector of ours in the axes of the model."""
        x, y, z = (float(v) for v in vector)
        return [x, z, 0.0] if self.planar else [x, y, z]

    def on(self, body: str, point: Any) -> list[float]:
        """Place on a body, in its axes, of a point of the reference pose."""
        return self.axes(self.turns[body].T @ (np.asarray(point) - self.centres[body]))

    def marker(self, body: str, point: Any, rigid: bool = False) -> Any:
        kind = items.MarkerBodyRigid if rigid else items.MarkerBodyPosition
        place = self.on(body, point)
        return self.system.AddMarker(kind(bodyNumber=self.bodies[body], localPosition=place))

    def add_body(self, body: dict[str, Any]) -> None:
        name, motion = body["name"], body.get("motion", "rigid")
        centre, mass = np.array(body["center_of_gravity"]), body["mass"]
        initial = body.get("initial", {})
        if initial.keys() - {"displacement", "velocity", "angular_velocity"}:
            raise NotImplementedError(f"initial.* of the body {name}")
        displacement = self.axes(initial.get("displacement", np.zeros(3)))
        velocity = self.axes(initial.get("velocity", np.zeros(3)))
        rates = np.array(initial.get("angular_velocity", np.zeros(3)))
        self.centres[name], self.turns[name] = centre, np.eye(3)
        system, item = self.system, None
        at = self.axes(centre)
        if motion == "point":
            node = items.NodePoint2D(
                referenceCoordinates=at[:2],
                initialCoordinates=displacement[:2],
                initialVelocities=velocity[:2],
            )
            item = items.ObjectMassPoint2D(mass=mass, nodeNumber=system.AddNode(node))
        elif motion == "planar":
            node = items.NodeRigidBody2D(
                referenceCoordinates=at,
                initialCoordinates=displacement,
                initialVelocities=[*velocity[:2], -rates[1]],
            )
            item = items.ObjectRigidBody2D(
                mass=mass, inertia=body["inertia"][1], nodeNumber=system.AddNode(node)
            )
        elif motion == "surge":
            node = items.Node1D(
                referenceCoordinates=[0.0],
                initialCoordinates=displacement[:1],
                initialVelocities=velocity[:1],
            )
            self.nodes[name] = system.AddNode(node)
            item = items.ObjectMass1D(mass=mass, nodeNumber=self.nodes[name], referencePosition=at)
        elif motion == "rigid":
            vector = np.radians(body.get("principal_axes_deg", np.zeros(3)))
            turn = self.turns[name] = np.asarray(tools.RotationVector2RotationMatrix(vector))
            if self.setting.lie_group:
                node = items.NodeRigidBodyRotVecLG(
                    referenceCoordinates=[*at, *vector],
                    initialCoordinates=[*displacement, 0.0, 0.0, 0.0],
                    initialVelocities=[*velocity, *(turn.T @ rates)],
                )
            else:
                parameters = tools.RotationMatrix2EulerParameters(turn)
                change = tools.AngularVelocity2EulerParameters_t(rates, parameters)
                node = items.NodeRigidBodyEP(
                    referenceCoordinates=[*at, *parameters],
                    initialCoordinates=[*displacement, 0.0, 0.0, 0.0, 0.0],
                    initialVelocities=[*velocity, *change],
                )
            item = items.ObjectRigidBody(
                mass=mass,
                inertia=[*body["inertia"], 0.0, 0.0, 0.0],
                nodeNumber=system.AddNode(node),
            )
        else:
            raise NotImplementedError(f"motion {motion} of the body {name}")
        number = self.bodies[name] = system.AddObject(item)
        if self.gravity and motion != "surge":
            marker = system.AddMarker(items.MarkerBodyMass(bodyNumber=number))
            weight = self.axes((0.0, 0.0, -self.gravity))
            system.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=weight))

    def add_joint(self, joint: dict[str, Any]) -> None:
        a, b, point, kind = joint["body_a"], joint["body_b"], joint["point"], joint["type"]
        item: Any
        if kind == "distance":
            end = joint["point_b"]
            item = items.ObjectConnectorDistance(
                markerNumbers=[self.marker(a, point), self.marker(b, end)],
                distance=joint.get("length", float(np.linalg.norm(np.subtract(end, point)))),
            )
        elif self.planar and kind == "revolute":
            ends = [self.marker(a, point), self.marker(b, point)]
            item = items.ObjectJointRevolute2D(markerNumbers=ends)
        elif kind == "spherical":
            ends = [self.marker(a, point), self.marker(b, point)]
            item = items.ObjectJointSpherical(markerNumbers=ends)
        else:
            axis = np.array(joint["axis"])
            side = np.cross(axis, np.eye(3)[np.argmin(abs(axis))])
            side /= np.linalg.norm(side)
            turn = np.column_stack([side, np.cross(axis, side), axis])
            left_out = [row for name, row in self.setting.left_out if name == joint["name"]]
            fixed = [0 if row in left_out else one for row, one in enumerate(FIXED[kind])]
            if not any(fixed):
                return
            item = items.ObjectJointGeneric(
                markerNumbers=[
                    self.marker(a, point, rigid=True),
                    self.marker(b, point, rigid=True),
                ],
                constrainedAxes=fixed,
                rotationMarker0=self.turns[a].T @ turn,
                rotationMarker1=self.turns[b].T @ turn,
            )
        self.system.AddObject(item)

    def add_force(self, force: dict[str, Any]) -> None:
        kind = force["type"]
        if kind == "spring_damper":
            ends = [self.marker(force[f"body_{side}"], force[f"point_{side}"]) for side in "ab"]
            item = items.ObjectConnectorSpringDamper(
                markerNumbers=ends,
                referenceLength=force["length"],
                stiffness=force["stiffness"],
                damping=force.get("damping", 0.0),
            )
            self.system.AddObject(item)
        elif kind == "constant_load" and self.planar:
            marker = self.marker(force["body"], self.centres[force["body"]], rigid=True)
            moment = [0.0, 0.0, -force["moment"][1]]
            self.system.AddLoad(items.LoadTorqueVector(markerNumber=marker, loadVector=moment))
        elif kind == "mooring_matrix" and force["body"] in self.nodes:  # a body in surge
            ground = items.MarkerNodeCoordinate(
                nodeNumber=self.system.AddNode(items.NodePointGround()), coordinate=0
            )
            moving = items.MarkerNodeCoordinate(nodeNumber=self.nodes[force["body"]], coordinate=0)
            item = items.ObjectConnectorCoordinateSpringDamper(
                markerNumbers=[self.system.AddMarker(ground), self.system.AddMarker(moving)],
                stiffness=force["stiffness"][0],
            )
            self.system.AddObject(item)
        else:
            raise NotImplementedError(kind)

    def run(self, parts: int, end_time: float | None, verbose: bool = False) -> tuple[Array, float]:
        """Path of the compared point in our axes, and the processor time of SolveDynamic, s.

        A step is the output step over `parts`. The time holds the start (accelerations, first
        factorisation), all steps, and the point kept in memory at the output times; nothing is
        written to files.
        """
        setting, end_time = self.setting, end_time or self.end_time
        settings = exu.SimulationSettings()
        integration = settings.timeIntegration
        integration.endTime = end_time
        integration.numberOfSteps = round(end_time / self.output_step) * parts
        integration.adaptiveStep = False
        integration.automaticStepSize = False
        integration.newton.useModifiedNewton = setting.newton != FULL
        integration.newton.modifiedNewtonJacUpdatePerStep = setting.newton == EACH_STEP
        integration.newton.relativeTolerance = setting.tolerance
        integration.explicitIntegration.computeEndOfStepAccelerations = False
        integration.verboseMode = 1 if verbose else 0
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = self.output_step
        settings.linearSolver.solverType = getattr(exu.LinearSolverType, setting.linear)
        kind = getattr(exu.DynamicSolverType, setting.solver)
        before = time.process_time()
        self.system.SolveDynamic(settings, solverType=kind)
        seconds = time.process_time() - before
        rows = np.asarray(self.system.GetSensorStoredData(self.sensor))
        times = np.arange(len(rows)) * self.output_step
        if not np.allclose(rows[:, 0], times, rtol=0.0, atol=1e-3 * self.output_step / parts):
            raise ValueError("Exudyn kept other times than those of the output")
        return rows[:, 1:3] if self.planar else rows[:, 1:4], seconds


def reason(run: Callable[[], object]) -> str:
    """Exudyn's words on a run that stops, which it prints, or raises."""
    log = Path("messages.txt")
    exu.SetWriteToFile(str(log), flagFlushAlways=True)
    told = [""]
    try:
        run()
    except RuntimeError as stop:
        told = str(stop).splitlines()
    finally:
        exu.SetWriteToFile("", False)
    told = [*log.read_text().splitlines(), *told]
    lines = [line.strip() for line in told]
    return next((x for x in lines if "converge" in x or "singular" in x), lines[-1])


def settle() -> None:
    """Go where Exudyn may leave its files, and keep its messages off the screen."""
    os.chdir(tempfile.mkdtemp(prefix="exudyn_"))
    exu.config.printToConsole = False
