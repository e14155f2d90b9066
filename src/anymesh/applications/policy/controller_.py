"""Scripted controller that moves a joint of an asset with the floating gripper by the grasps and pushes of `anymesh plan`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.plans import GripperContact, Target
from anymesh.applications.plan.targets import PartSurfaces, sample_targets
from anymesh.applications.policy.objects_ import TaskObject
from anymesh.applications.policy.robots_ import GRIPPER, PRESS, REACH
from anymesh.applications.policy.simulation_ import TaskSimulation
from anymesh.applications.policy.tasks import NOMINAL, PolicyTask, SceneSample

DONE = 0.9  # share of the motion that counts as done
SHORT = 0.03  # [m] of a slide below which it is pushed first, as a button is
TRIES = 12  # targets per joint
BACK = 0.10  # [m] before the target, where an attempt begins
ROOM = 0.014  # [m] that the open fingers are wider than what they pass
DEPTH = 0.004  # [m] by which a push aims behind the surface
REACHING, CLOSING, HOLDING = 10, 10, 4  # steps of 50 ms
SPEED, TURN_SPEED = 0.25, 0.8  # [m/s], [rad/s] of the motion
STEP = 0.05  # [s]
MARGIN = 1.03  # of the goal that is commanded, since servos lag


class InteractionFailure(StrEnum):
    """Why a joint was not moved."""

    NO_PLACE = "no place where the gripper fits"
    MISSED = "never touched the part"
    SHORT = "moved too little"
    UNSTABLE = "the simulation became unstable"


@dataclass(frozen=True, eq=False)
class Attempt:
    """Best attempt at a joint.

    share: of the intended motion that was made; tries: attempts; simulation: at its end; slip: of the tool along the part
    since the fingers closed [m].
    """

    share: float
    failure: InteractionFailure | None
    contact: GripperContact | None
    tries: int
    simulation: TaskSimulation | None
    slip: float = 0.0


def move_joint(object_: TaskObject, *, seed: int = 0, tries: int = TRIES) -> Attempt:
    """Try grasps and pushes, the most promising first, until one moves the joint to its goal."""
    best = Attempt(0.0, InteractionFailure.NO_PLACE, None, 0, None)
    for number, target in enumerate(_targets(object_, seed, tries)[:tries], start=1):
        made = follow_target(object_, target)
        if best.simulation is None or made.failure is None or made.share > best.share:
            best = made
        best = Attempt(best.share, best.failure, best.contact, number, best.simulation)
        if best.failure is None:
            break
    return best


def _targets(object_: TaskObject, seed: int, tries: int) -> list[Target]:
    """Return targets of both kinds in turn; those of short motions begin with a push, all others with a grasp."""
    thing, goal = object_.thing, object_.goal.goal
    surfaces = PartSurfaces(thing.part_triangles, thing.other_triangles)
    kinds = [GripperContact.GRASP, GripperContact.PUSH]
    if not thing.turns and abs(goal) < SHORT:
        kinds.reverse()
    lists = [sample_targets(surfaces, thing.motion, goal, GRIPPER.stroke, seed, (kind,), tries) for kind in kinds]
    longest = max(map(len, lists))
    return [some[k] for k in range(longest) for some in lists if k < len(some)]


def follow_target(
    object_: TaskObject, target: Target, simulation: TaskSimulation | None = None, sample: SceneSample = NOMINAL
) -> Attempt:
    """Move the gripper to a target, close it, and lead it along the joint.

    simulation: of the object with a floating gripper, to use again; sample: a displacement of the object that the gripper does
    not know of, and physics.
    """
    pushes = target.contact is GripperContact.PUSH
    T = object_.T_world_asset @ target.T_asset_tool
    s = simulation or TaskSimulation(object_, PolicyTask.OPEN)
    s.aim(T[:3, :3])
    s.reset(sample)
    wide = open_gap(s, target)
    offset = -REACH if pushes else 0.0
    s.command_tool(*_pose(T, offset - BACK), wide, jump=True)
    s.mujoco.mj_forward(s.model, s.data)
    for k in range(1, REACHING + 1):
        s.command_tool(*_pose(T, offset - BACK * (1 - k / REACHING)), wide)
        s.advance()
    gap = wide if pushes else -2 * PRESS
    for _ in range(0 if pushes else CLOSING):
        s.command_tool(*_pose(T, offset), gap)
        s.advance()
    touched, goal, begun = False, object_.goal.goal, s.tool_in_part
    size = abs(goal) * (float(np.linalg.norm(object_.handle - object_.thing.motion.origin)) if object_.thing.turns else 1.0)
    steps = int(np.ceil(max(size / SPEED, abs(goal) / TURN_SPEED if object_.thing.turns else 0.0) / STEP)) + 5
    for k in range(1, steps + HOLDING + 1):
        moved = (
            object_.T_world_asset @ object_.thing.motion.transform(MARGIN * goal * min(k / steps, 1.0)) @ target.T_asset_tool
        )
        s.command_tool(*_pose(moved, offset + (DEPTH if pushes else 0.0)), gap)
        touched |= s.advance().fingers > 0
    share = float(np.clip(s.value / goal, -1.0, 2.0))
    if not np.isfinite(s.data.qpos).all():
        return Attempt(0.0, InteractionFailure.UNSTABLE, target.contact, 1, s)
    failure = None if share >= DONE else InteractionFailure.SHORT if touched else InteractionFailure.MISSED
    return Attempt(share, failure, target.contact, 1, s, float(np.linalg.norm(s.tool_in_part - begun)))


def open_gap(simulation: TaskSimulation, target: Target) -> float:
    """Return how wide the fingers are open before a target [m]."""
    wide = 2 * float(simulation.robot.high[-1])
    return 0.0 if target.contact is GripperContact.PUSH else min(target.width + ROOM, wide)


def _pose(T: Float[np.ndarray, "4 4"], along: float) -> tuple[Float[np.ndarray, " 3"], Float[np.ndarray, "3 3"]]:
    """Return the position of a tool moved along its approach, and its orientation."""
    return T[:3, 3] + along * T[:3, 2], T[:3, :3]
