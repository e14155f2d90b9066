"""Drake: a URDF parsed into a multibody plant with implicit motors, and Drake's convex hulls of the collision meshes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.driving import STEP, Limits, Motor, engine_version, finite_limits, load_engine
from anymesh.checking.engines.robot import Robot
from anymesh.errors import InputError


class World:
    """The asset of a URDF in Drake. Raise InputError if it cannot be loaded, MissingExtraError without the engine."""

    def __init__(self, path: Path, robot: Robot, motors: Mapping[str, Motor]) -> None:
        drake = load_engine("pydrake.all", shown="Drake", extra="drake")
        self.engine = engine_version("drake", "drake")
        builder = drake.DiagramBuilder()
        plant, _ = drake.AddMultibodyPlantSceneGraph(builder, time_step=STEP)
        try:
            (model,) = drake.Parser(plant).AddModels(str(path))
        except Exception as error:  # its parser raises RuntimeError and others
            raise InputError(f"Drake cannot load {path}: {error}") from error
        self.plant, self.model = plant, model
        base = self._body(robot.roots[0])
        if base.index() != plant.world_body().index() and not any(
            plant.get_joint(j).child_body().index() == base.index() for j in plant.GetJointIndices(model)
        ):
            plant.WeldFrames(plant.world_frame(), base.body_frame())
        plant.mutable_gravity_field().set_gravity_vector(np.zeros(3))
        joints = [plant.get_joint(j) for j in plant.GetJointIndices(model)]
        joints = [j for j in joints if j.num_positions() == 1]
        for joint in joints:
            motor = motors[joint.name()]
            if not plant.HasJointActuatorNamed(f"{joint.name()}_motor", model):
                actuator = plant.AddJointActuator(f"{joint.name()}_motor", joint, motor.effort)
                actuator.set_controller_gains(drake.PdControllerGains(p=motor.stiffness, d=motor.damping))
        plant.Finalize()
        self.limits = {j.name(): _limits(j) for j in joints}
        self.root, self._drake = base, drake
        self.diagram = builder.Build()
        self.order = [j.position_start() for j in joints]
        self.commands = [plant.GetJointActuatorByName(f"{j.name()}_motor", model).index() for j in joints]
        self.velocities = [j.velocity_start() for j in joints]
        self.reset(np.zeros(len(joints)))

    def reset(self, positions: Float[np.ndarray, " n"]) -> None:
        self.simulator = self._drake.Simulator(self.diagram)
        self.context = self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        q = np.zeros(self.plant.num_positions())
        q[self.order] = positions
        self.plant.SetPositions(self.context, q)
        self.simulator.Initialize()
        self.time = 0.0

    def step(self, targets: Float[np.ndarray, " n"]) -> None:
        count = self.plant.num_actuators(self.model)
        wanted = np.zeros(2 * count)
        wanted[[int(c) for c in self.commands]] = targets
        self.plant.get_desired_state_input_port(self.model).FixValue(self.context, wanted)
        self.time += STEP
        self.simulator.AdvanceTo(self.time)

    def push(self, forces: Float[np.ndarray, " n"]) -> None:
        """Advance with a desired state that was never given since the reset, so that the motors are off."""
        applied = np.zeros(self.plant.num_velocities())
        applied[self.velocities] = forces
        self.plant.get_applied_generalized_force_input_port().FixValue(self.context, applied)
        self.time += STEP
        self.simulator.AdvanceTo(self.time)

    def positions(self) -> Float[np.ndarray, " n"]:
        return self.plant.GetPositions(self.context)[self.order]

    def _body(self, link: str) -> Any:
        """Return the body of a link; a link called world is Drake's own world."""
        known = self.plant.HasBodyNamed(link, self.model)
        return self.plant.GetBodyByName(link, self.model) if known else self.plant.world_body()

    def pose(self, link: str) -> Float[np.ndarray, "4 4"]:
        body = self._body(link)
        root = self.plant.EvalBodyPoseInWorld(self.context, self.root).GetAsMatrix4()
        return np.linalg.inv(root) @ self.plant.EvalBodyPoseInWorld(self.context, body).GetAsMatrix4()


def _limits(joint: Any) -> Limits:
    return finite_limits(joint.position_lower_limits()[0], joint.position_upper_limits()[0])
