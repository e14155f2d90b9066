"""Collision checks in MuJoCo: the object with the robot, and the object at rest with the gripper alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Bool, Float

from anymesh.applications.plan.asset_ import ArticulatedObject
from anymesh.applications.plan.hand_ import PAD, Hand
from anymesh.applications.plan.plans import BasePose, GripperContact, Target
from anymesh.applications.plan.robot_ import RobotArm, bodies_below, finger_bodies, positions_of, quaternion, without_visuals
from anymesh.mujoco_ import load_mujoco

OBJECT, ROBOT = "object/", "robot/"  # prefixes of names
PEDESTAL = "pedestal"
THICK = 0.02  # [m] thickness of the ground slab
THINGS, ARM = 1, 2  # collision bits: ground and object; robot
FOOT = 0.05  # share of the object's height; vertices below it define the stand
BACK, BACK_STEP = 0.08, 0.01  # [m] length of the straight motion to the part; step of the test
WIDER = (0.002, 0.005, 0.009, 0.014)  # [m] by which collision shapes may be thicker than the visible surface
OPENING = 0.024  # [m] by which the open fingers are wider than what they grasp
TOUCH = 1e-3  # [m] that a finger may penetrate the part


def compose(
    thing: ArticulatedObject,
    robot: RobotArm,
    *,
    base: BasePose | None = None,
    T_world_asset: Float[np.ndarray, "4 4"] | None = None,
    visuals: bool = False,
) -> Any:
    """Return the spec of both: the object stands on the ground z = 0, or on a stand if the robot's base is lower.

    base: of the robot, the origin if None; T_world_asset: of the object, the identity if None.
    """
    mujoco = load_mujoco()
    spec = mujoco.MjSpec()
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = 10.0  # keeps friction contacts from creeping
    spec.option.timestep = 0.002
    height = 0.0 if base is None else base.z
    box = mujoco.mjtGeom.mjGEOM_BOX
    ground = min(height, 0.0)
    floor = spec.worldbody.add_geom(name="floor", type=box, size=[3, 3, THICK / 2], pos=[0, 0, ground - THICK / 2])
    floor.rgba = [0.82, 0.82, 0.8, 1]
    if height > 0 and base is not None:
        spec.worldbody.add_geom(name=PEDESTAL, type=box, size=[0.1, 0.1, height / 2], pos=[base.x, base.y, height / 2 - 1e-3])
    if height < 0:
        corners = np.concatenate([thing.part_triangles, thing.other_triangles]).reshape(-1, 3)
        foot = corners[corners[:, 2] < corners[:, 2].min() + FOOT * np.ptp(corners[:, 2])]
        low, high = foot.min(0), foot.max(0)
        half = [*((high - low)[:2] / 2), -height / 2]
        spec.worldbody.add_geom(name="stand", type=box, size=half, pos=[*((low + high)[:2] / 2), height / 2 - 1e-3])
    for child, T, prefix in (
        (thing.spec, np.eye(4) if T_world_asset is None else T_world_asset, OBJECT),
        (robot.spec, np.eye(4) if base is None else base.transform, ROBOT),
    ):
        frame = spec.worldbody.add_frame(pos=T[:3, 3], quat=quaternion(T[:3, :3]))
        spec.attach(child.copy() if visuals else without_visuals(child), frame=frame, prefix=prefix)
    for geom in spec.geoms:
        if geom.contype or geom.conaffinity:
            mine = geom.parent.name.startswith(ROBOT)
            geom.contype = ARM if mine else THINGS
            geom.conaffinity = ARM | THINGS if mine else ARM
    return spec


def bodies_of(model: Any, prefix: str, names: Sequence[str] | None = None) -> Bool[np.ndarray, " b"]:
    """Return whether each body's name has a prefix; names: without it, of those that count, None for all."""
    own = [model.body(b).name for b in range(model.nbody)]
    return np.array([n.startswith(prefix) and (names is None or n.removeprefix(prefix) in names) for n in own])


@dataclass(frozen=True)
class Touch:
    """Pair of shapes nearer than allowed: names of their links, and the distance [m]."""

    a: str
    b: str
    distance: float


class CollisionWorld:
    """Collision checker of the arm's postures, with the object posed anywhere along its joint.

    The robot may be moved to another base of the same height (`move`). clearance: [m] that the arm and the open gripper keep
    from everything; touch: [m] that fingers may penetrate the part while they hold it.
    """

    def __init__(
        self,
        thing: ArticulatedObject,
        robot: RobotArm,
        hand: Hand,
        base: BasePose,
        *,
        clearance: float = 0.008,
        touch: float = 1e-3,
    ) -> None:
        self.mujoco = load_mujoco()
        self.thing, self.robot, self.hand = thing, robot, hand
        spec = compose(thing, robot, base=base)
        spec.option.disableflags |= int(self.mujoco.mjtDisableBit.mjDSBL_GRAVITY)
        self.model = model = spec.compile()
        self.data = self.mujoco.MjData(model)
        self.clearance, self.touch = clearance, touch
        self.arm, self.fingers = positions_of(model, robot.joints, ROBOT), positions_of(model, robot.fingers, ROBOT)
        self.joint = int(model.joint(OBJECT + thing.joint).qposadr[0])
        self.is_robot, self._is_object = bodies_of(model, ROBOT), bodies_of(model, OBJECT)
        self.is_part = bodies_of(model, OBJECT, thing.carried)
        self.is_finger = finger_bodies(model, robot.fingers, ROBOT)
        self.is_hand = bodies_below(model, [int(model.body(ROBOT + robot.wrist).id)])
        model.geom_margin[self.is_robot[model.geom_bodyid]] = clearance
        self._root = int(model.body(ROBOT + robot.root).id)
        self._T_base_root = np.linalg.inv(base.transform) @ _transform(model.body_pos[self._root], model.body_quat[self._root])
        self._ignored = self._always(hand)

    def move(self, base: BasePose) -> None:
        """Move the robot to another base of the same height."""
        T = base.transform @ self._T_base_root
        self.model.body_pos[self._root] = T[:3, 3]
        self.model.body_quat[self._root] = quaternion(T[:3, :3])
        for geom in range(self.model.ngeom):
            if self.model.geom(geom).name == PEDESTAL:
                self.model.geom_pos[geom, :2] = base.x, base.y

    def _always(self, hand: Hand) -> set[tuple[int, int]]:
        """Return the pairs of robot links that touch at home, and the base with the ground; these contacts are by design."""
        ignored: set[tuple[int, int]] = set()
        for gap in (0.0, hand.stroke):
            self.pose(self.robot.home, gap, 0.0)
            ignored |= {p for p, _ in self._pairs() if self.is_robot[p[0]] and self.is_robot[p[1]]}
        root = int(self.model.body(ROBOT + self.robot.root).id)
        first = int(self.model.joint(ROBOT + self.robot.joints[0]).bodyid[0])
        return ignored | {(a, b) for k in (root, first) for a, b in ((0, k), (k, 0))}

    def pose(self, posture: Float[np.ndarray, " J"], gap: float, value: float) -> None:
        """Set the posture of the arm, the gap of the fingers and the value of the part's joint."""
        self.data.qpos[self.arm] = posture
        self.data.qpos[self.fingers] = self.hand.posture_at(gap)
        self.data.qpos[self.joint] = value
        self.mujoco.mj_kinematics(self.model, self.data)
        self.mujoco.mj_collision(self.model, self.data)

    def _pairs(self) -> list[tuple[tuple[int, int], float]]:
        body = self.model.geom_bodyid
        contacts = self.data.contact
        if self.data.ncon == 0:
            return []
        geoms, distance = contacts.geom, contacts.dist
        return [((int(body[a]), int(body[b])), float(d)) for (a, b), d in zip(geoms, distance, strict=True)]

    def touching(
        self, posture: Float[np.ndarray, " J"], gap: float, value: float, *, holding: bool = False, pressed: float = 0.0
    ) -> Touch | None:
        """Return the first pair that is too near, None if there is none.

        holding: fingers may touch the part, and penetrate it up to `touch`; pressed: additional penetration of the part, and
        penetration allowed for the rest of the object [m].
        """
        self.pose(posture, gap, value)
        for (a, b), distance in self._pairs():
            if (a, b) in self._ignored:
                continue
            fingers = self.is_finger[a] or self.is_finger[b]
            part = self.is_part[a] or self.is_part[b]
            own = self.is_robot[a] and self.is_robot[b]
            if own and self.is_hand[a] and self.is_hand[b]:
                continue
            allowed = 0.0 if own else self.clearance
            if holding and fingers:
                allowed = -self.touch - pressed if part else -pressed if self._is_object[a] or self._is_object[b] else 0.0
            if distance < allowed:
                return Touch(self.model.body(a).name, self.model.body(b).name, distance)
        return None


def _transform(pos: Float[np.ndarray, " 3"], quat: Float[np.ndarray, " 4"]) -> Float[np.ndarray, "4 4"]:
    mujoco, turn, T = load_mujoco(), np.zeros(9), np.eye(4)
    mujoco.mju_quat2Mat(turn, quat)
    T[:3, :3], T[:3, 3] = turn.reshape(3, 3), pos
    return T


class HandWorld:
    """Collision model of the gripper as a free body and the object at rest."""

    def __init__(self, thing: ArticulatedObject, robot: RobotArm, hand: Hand) -> None:
        self.mujoco = load_mujoco()
        self.hand = hand
        spec = compose(thing, _without_arm(robot))
        spec.body(ROBOT + robot.root).mocap = True
        self.model = model = spec.compile()
        self.data = data = self.mujoco.MjData(model)
        self.mujoco.mj_kinematics(model, data)
        wrist = int(model.body(ROBOT + robot.wrist).id)
        self._T_wrist_root = np.linalg.inv(self._frame(wrist)) @ self._frame(int(model.body(ROBOT + robot.root).id))
        self.fingers = positions_of(model, robot.fingers, ROBOT)
        self._finger, self._part = finger_bodies(model, robot.fingers, ROBOT), bodies_of(model, OBJECT, thing.carried)
        robot_geoms = bodies_of(model, ROBOT)[model.geom_bodyid]
        outside = robot_geoms & ~bodies_below(model, [wrist])[model.geom_bodyid]
        model.geom_contype[outside] = model.geom_conaffinity[outside] = 0
        model.geom_conaffinity[robot_geoms] = 0  # no collisions within the robot

    def _frame(self, body: int) -> Float[np.ndarray, "4 4"]:
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = self.data.xmat[body].reshape(3, 3), self.data.xpos[body]
        return T

    def _clear(self, T_asset_tool: Float[np.ndarray, "4 4"], gap: float) -> bool:
        """Return whether fingers penetrate the part by at most `TOUCH` and nothing else of the hand touches anything."""
        T = T_asset_tool @ np.linalg.inv(self.hand.T_wrist_tool) @ self._T_wrist_root
        self.data.mocap_pos[0], self.data.mocap_quat[0] = T[:3, 3], quaternion(T[:3, :3])
        self.data.qpos[self.fingers] = self.hand.posture_at(gap)
        self.mujoco.mj_kinematics(self.model, self.data)
        self.mujoco.mj_collision(self.model, self.data)
        if self.data.ncon == 0:
            return True
        body = self.model.geom_bodyid[self.data.contact.geom]
        touching = self._finger[body].any(1) & self._part[body].any(1)
        return bool((self.data.contact.dist >= np.where(touching, -TOUCH, 0.0)).all())

    def fitted(self, targets: Sequence[Target]) -> list[Target]:
        """Return the targets where the hand fits, with the width of the collision shapes there."""
        return [fitted_target for target in targets if (fitted_target := self._fit(target)) is not None]

    def _fit(self, target: Target) -> Target | None:
        push = target.contact is GripperContact.PUSH
        for wider in (0.0,) if push else WIDER:
            width = target.width + wider
            if width > self.hand.stroke:
                return None
            if self._clear(tool_pose(target, self.hand, -TOUCH if push else 0.0), width):
                opened = 0.0 if push else min(self.hand.stroke, width + OPENING)
                fitted = replace(target, width=width)
                ways = -np.arange(TOUCH if push else 0.0, BACK + 1e-9, BACK_STEP)
                return fitted if all(self._clear(tool_pose(fitted, self.hand, float(w)), opened) for w in ways) else None
        return None


def tool_pose(target: Target, hand: Hand, along: float) -> Float[np.ndarray, "4 4"]:
    """Return the tool's pose at a target, in the asset frame at rest; along: offset along its z [m].

    The fingertips are `PAD` beyond the grasped place, or at the pushed one.
    """
    ahead = np.eye(4)
    reach = hand.reach_at(target.width)
    ahead[2, 3] = along + (PAD - reach if target.contact is GripperContact.GRASP else -reach)
    return target.T_asset_tool @ ahead


def _without_arm(robot: RobotArm) -> RobotArm:
    """Return the robot with the arm's joints fixed."""
    spec = robot.spec.copy()
    for motor in list(spec.actuators):
        spec.delete(motor)
    for name in robot.joints:
        spec.delete(spec.joint(name))
    return replace(robot, spec=spec)
