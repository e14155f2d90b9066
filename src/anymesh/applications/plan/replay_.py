"""Open-loop replay of a trajectory in MuJoCo, with servos, contacts and friction, on an object other than the planned one."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.asset_ import ArticulatedObject
from anymesh.applications.plan.hand_ import Hand
from anymesh.applications.plan.plans import BasePose, Phase, Trajectory
from anymesh.applications.plan.robot_ import RobotArm, finger_bodies, positions_of
from anymesh.applications.plan.scene_ import OBJECT, ROBOT, bodies_of, compose
from anymesh.errors import OptionError
from anymesh.mujoco_ import is_unstable, load_mujoco
from anymesh.types import Brief
from anymesh.types.triangles import about_z

FIRM = 0.9  # share of the requested motion at which a task counts as done
HIT = 20.0  # [N] between the arm and anything else that counts as a collision
PRIORITY = 3  # contact priority of the object, so that its friction applies and not the gripper's
TORSION, ROLLING = 0.005, 1e-4  # [m] torsional and rolling friction
SAMPLED = 5  # simulation steps between evaluations of contacts


class ReplayFailure(StrEnum):
    """Reason for which a replay failed."""

    MISSED = "never touched the part"
    SLIPPED = "lost the part on the way"
    SHORT = "held the part, which moved too little"
    OVER = "moved the part too far"
    HIT = "the arm hit something"
    UNSTABLE = "the simulation became unstable"


@dataclass(frozen=True)
class Physics:
    """Physical properties of the true object, unknown to the plan.

    friction: coefficient of its surface; mass, damping, joint_friction: factors; spring: stiffness of the joint towards rest
    [N/m or N m/rad]; shift, yaw: error of its pose, x y z [m] and angle [rad].
    """

    friction: float = 0.8
    mass: float = 1.0
    damping: float = 1.0
    joint_friction: float = 1.0
    spring: float = 0.0
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)
    yaw: float = 0.0


@dataclass(frozen=True, eq=False)
class ReplayResult(Brief):
    """Outcome of a replay.

    value: of the joint when the arm holds it [rad or m]; failure: None if the task was done; penetration: deepest of a finger
    in the part [m]; lag: largest distance of a joint from its command [rad]; force: largest between the arm without its
    fingers and anything else [N]; states: (k, q) at `times` for pictures.
    """

    value: float
    failure: ReplayFailure | None
    penetration: float
    lag: float
    force: float
    times: Float[np.ndarray, " k"]
    states: Float[np.ndarray, "k q"]


def replay(
    trajectory: Trajectory,
    thing: ArticulatedObject,
    robot: RobotArm,
    hand: Hand,
    base: BasePose,
    wanted: float,
    *,
    physics: Physics = Physics(),
    rate: float = 0.0,
) -> ReplayResult:
    """Run a trajectory with position servos, open loop: the object is not observed.

    thing: the true object; wanted: target value of its joint [rad or m]; rate: states kept per second, 0 for none.
    Raise OptionError if `wanted` is 0, the value at rest, or not finite: success is a share of it.
    """
    if wanted == 0 or not np.isfinite(wanted):
        raise OptionError(f"wanted: found {wanted:g}; valid is a finite value of {thing.joint} other than 0, its value at rest")
    stage = ReplaySimulation(thing, robot, hand, base, physics)
    return stage.run(trajectory, wanted, rate)


class ReplaySimulation:
    """Simulation of the true object and the robot."""

    def __init__(self, thing: ArticulatedObject, robot: RobotArm, hand: Hand, base: BasePose, physics: Physics) -> None:
        self.mujoco = load_mujoco()
        self.robot, self.hand, self.thing = robot, hand, thing
        spec = compose(thing, robot, base=base, T_world_asset=moved(physics))
        _give_physics(spec, thing, physics)
        self.model = model = spec.compile()
        self.data = self.mujoco.MjData(model)
        for name in thing.carried:
            body = int(model.body(OBJECT + name).id)
            model.body_mass[body] *= physics.mass
            model.body_inertia[body] *= physics.mass
        self.mujoco.mj_setConst(model, self.data)
        self.mujoco.mj_resetData(model, self.data)
        self.arm, self.fingers = positions_of(model, robot.joints, ROBOT), positions_of(model, robot.fingers, ROBOT)
        self.joint = int(model.joint(OBJECT + thing.joint).qposadr[0])
        at_joint = int(self.mujoco.mjtTrn.mjTRN_JOINT)
        target = {
            model.joint(int(model.actuator_trnid[a, 0])).name: a
            for a in range(model.nu)
            if int(model.actuator_trntype[a]) == at_joint
        }
        self.arm_motors = np.array([target[ROBOT + n] for n in robot.joints])
        self.hand_motors = np.setdiff1d(np.arange(model.nu), self.arm_motors)
        self.is_part, self.is_robot = bodies_of(model, OBJECT, thing.carried), bodies_of(model, ROBOT)
        self.is_finger = finger_bodies(model, robot.fingers, ROBOT)
        self.foot = {int(model.body(ROBOT + robot.root).id), int(model.joint(ROBOT + robot.joints[0]).bodyid[0])}

    def run(self, trajectory: Trajectory, wanted: float, rate: float) -> ReplayResult:
        """Run a trajectory once, from its start."""
        model, data, dt = self.model, self.data, float(self.model.opt.timestep)
        data.qpos[self.arm] = trajectory.position[0]
        data.qpos[self.fingers] = self.hand.posture_at(float(trajectory.gap[0]))
        command = trajectory.position + self.robot.lag * trajectory.velocity  # compensates the lag due to the servos' damping
        low, high = model.actuator_ctrlrange[self.arm_motors].T
        limited = model.actuator_ctrllimited[self.arm_motors].astype(bool)
        command = np.where(limited, np.clip(command, low, high), command)
        grips = np.array([self.hand.control_at(float(g)) for g in trajectory.gap])
        watch = _Watch(self)
        times, states = [], []
        count = int(np.ceil(trajectory.duration / dt)) + 1
        every = max(1, round(1 / (rate * dt))) if rate else count + 1
        for step in range(count):
            t = step * dt
            row = min(int(np.searchsorted(trajectory.time, t + 1e-9)), len(trajectory.time) - 1)
            data.ctrl[self.arm_motors], data.ctrl[self.hand_motors] = command[row], grips[row]
            self.mujoco.mj_step(model, data)
            if step % SAMPLED == 0:
                watch.look(trajectory.phase[row], trajectory.position[row])
            if step % every == 0:
                times.append(t)
                states.append(data.qpos.copy())
        unstable = is_unstable(data)
        failure = ReplayFailure.UNSTABLE if unstable else watch.failure(wanted)
        kept = np.array(states) if states else np.zeros((0, model.nq))
        return ReplayResult(watch.value, failure, watch.penetration, watch.lag, watch.force, np.array(times), kept)


class _Watch:
    """Record of contacts, forces and lag while a trajectory runs."""

    def __init__(self, stage: ReplaySimulation) -> None:
        self.stage = stage
        self.value = self.penetration = self.lag = self.force = 0.0
        self.touched, self.holding = False, False

    def look(self, phase: Phase, posture: np.ndarray) -> None:
        stage, data = self.stage, self.stage.data
        self.lag = max(self.lag, float(np.abs(data.qpos[stage.arm] - posture).max()))
        if phase is Phase.HOLD:
            self.value = float(data.qpos[stage.joint])
        if data.ncon == 0:
            self.holding = self.holding and phase not in (Phase.MOVE, Phase.HOLD)
            return
        body = stage.model.geom_bodyid[data.contact.geom]
        fingers, part = stage.is_finger[body].any(1), stage.is_part[body].any(1)
        held = fingers & part
        if held.any():
            self.penetration = max(self.penetration, float(-data.contact.dist[held].min()))
        if phase in (Phase.MOVE, Phase.HOLD):
            self.touched |= bool(held.any())
            self.holding = bool(held.any())
        own = stage.is_robot[body].all(1)
        foot = np.isin(body, sorted(stage.foot)).any(1)
        arm = stage.is_robot[body].any(1) & ~own & ~fingers & ~foot
        for k in np.flatnonzero(arm):
            wrench = np.zeros(6)
            stage.mujoco.mj_contactForce(stage.model, data, int(k), wrench)
            self.force = max(self.force, float(np.linalg.norm(wrench[:3])))

    def failure(self, wanted: float) -> ReplayFailure | None:
        share = self.value / wanted
        if self.force > HIT:
            return ReplayFailure.HIT
        if share > 2 - FIRM and self.stage.thing.limits is None:
            return ReplayFailure.OVER
        if share >= FIRM:
            return None
        if not self.touched:
            return ReplayFailure.MISSED
        return ReplayFailure.SHORT if self.holding else ReplayFailure.SLIPPED


def moved(physics: Physics) -> Float[np.ndarray, "4 4"]:
    """Return the pose of the true object in the planned frame."""
    T = about_z(physics.yaw)
    T[:3, 3] = physics.shift
    return T


def _give_physics(spec: Any, thing: ArticulatedObject, physics: Physics) -> None:
    for body in spec.bodies:
        if body.name.startswith(ROBOT):
            body.gravcomp = 1.0  # gravity compensation, as arms have it
    for geom in spec.geoms:
        if geom.parent.name.startswith(OBJECT) and (geom.contype or geom.conaffinity):
            geom.friction, geom.condim, geom.priority = [physics.friction, TORSION, ROLLING], 4, PRIORITY
            geom.solref, geom.solimp = [0.01, 1.0], [0.95, 0.99, 0.001, 0.5, 2.0]
    joint = spec.joint(OBJECT + thing.joint)
    joint.damping = [float(np.ravel(joint.damping)[0]) * physics.damping, 0, 0]
    joint.frictionloss = float(joint.frictionloss) * physics.joint_friction
    joint.stiffness = [physics.spring, 0, 0]
    joint.solref_limit, joint.solimp_limit = [0.004, 1.0], [0.95, 0.99, 0.001, 0.5, 2.0]  # a stiff stop
