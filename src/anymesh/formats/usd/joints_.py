"""Joints of UsdPhysics, as stated joints of a mesh: a tree from the body that is the base."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.formats.usd.geometry_ import kind_of, value
from anymesh.loading.files import Folder
from anymesh.stated.animated import NodeTrack, SceneNode, animated_joints
from anymesh.types import Brief, JointType, Mesh, StatedJoint

WORLD = ""  # path of what no rigid body holds
KINDS = {
    "PhysicsRevoluteJoint": JointType.REVOLUTE,
    "PhysicsPrismaticJoint": JointType.PRISMATIC,
    "PhysicsSphericalJoint": JointType.BALL,
    "PhysicsFixedJoint": JointType.FIXED,
}
AXES = ("X", "Y", "Z")
TURNING = (JointType.REVOLUTE, JointType.CONTINUOUS)
ALONG = 0.999  # least cosine of two axes that are one
MIMICS = [("newton:mimicJoint", "newton:mimicCoef1", 1.0)]
MIMICS += [(f"physxMimicJoint:rot{a}:referenceJoint", f"physxMimicJoint:rot{a}:gearing", -1.0) for a in AXES]
Motion = tuple[JointType | None, int, tuple[float, float]]  # what moves, the axis of the frame, limits [rad or units]
Warn = Callable[[str], None]
NOISE = 1e-3  # [rad, or of APART] smaller distances from position 0 are rounding
APART = 1e-3  # of the object's diagonal; frames of a joint that are further apart do not meet


@dataclass(frozen=True, eq=False)
class UsdJoint(Brief):
    """A joint of the file. a, b: paths of its bodies; T_a, T_b: its frame, by either, in the stage; limits [rad or units].

    follows: name of the joint that leads it, "" for none; ratio: of their positions [rad or units].
    """

    name: str
    type: JointType
    a: str
    b: str
    axis: int
    T_a: Float[np.ndarray, "4 4"]
    T_b: Float[np.ndarray, "4 4"]
    limits: tuple[float, float]
    excluded: bool
    follows: str = ""
    ratio: float = 1.0


def add_joints(
    pxr: Any, stage: Any, mesh: Mesh, paths: Sequence[str], to_stage: Callable[[Any], np.ndarray], warn: Warn
) -> Mesh:
    """Return a mesh with the joints that the stage states.

    paths: of the prims of its nodes; to_stage: gives the transform of a prim.
    """
    prims = [p for p in stage.Traverse(pxr.Usd.TraverseInstanceProxies()) if p.IsA(pxr.UsdPhysics.Joint)]
    reader = _Reader(pxr, stage, to_stage, warn)
    stated = [joint for prim in prims if (joint := reader.read(prim)) is not None]
    if not stated:
        return mesh
    bodies = {b for joint in stated for b in (joint.a, joint.b)} | reader.bodies
    body_of = [_owner(path, bodies) for path in paths]
    roots = [str(p.GetPath()) for p in stage.Traverse() if p.HasAPI(pxr.UsdPhysics.ArticulationRootAPI)]
    joints, of_body = _tree(stated, roots, body_of, APART * mesh.diagonal, warn)
    up = np.array([0.0, 1.0, 0.0] if pxr.UsdGeom.GetStageUpAxis(stage) == "Y" else [0.0, 0.0, 1.0])
    for body in sorted((reader.bodies & set(body_of)) - {*of_body}):
        prim = stage.GetPrimAtPath(body)
        if not value(pxr.UsdPhysics.RigidBodyAPI(prim).GetKinematicEnabledAttr()):
            of_body[body], place = len(joints), to_stage(prim)[:3, 3]
            reason = "from a body of the file that no joint holds"
            joints.append(StatedJoint(JointType.FREE, place, up, None, name=str(prim.GetName()), reason=reason))
    nodes = tuple(replace(node, joint=of_body.get(body, -1)) for node, body in zip(mesh.nodes, body_of, strict=True))
    return replace(mesh, nodes=nodes, joints=tuple(joints))


def _owner(path: str, bodies: set[str]) -> str:
    """Return the innermost body that holds a prim."""
    while path and path not in bodies:
        path = path.rpartition("/")[0]
    return path


def add_animated_joints(
    pxr: Any, stage: Any, mesh: Mesh, paths: Sequence[str], to_stage: Callable[[Any], np.ndarray], folder: Folder
) -> Mesh:
    """Return a mesh with the joints that time samples of transforms state. paths, to_stage: as for `add_joints`."""
    numbers: dict[str, int] = {}
    nodes: dict[int, SceneNode] = {}
    tracks: dict[int, NodeTrack] = {}
    for path in paths:
        for prim in (stage.GetPrimAtPath(p) for p in pxr.Sdf.Path(path).GetPrefixes()):
            key, above = str(prim.GetPath()), prim.GetParent()
            if key in numbers:
                continue
            parent = numbers.get(str(above.GetPath()))
            T_parent = np.eye(4) if parent is None else to_stage(above)
            numbers[key] = len(numbers)
            nodes[numbers[key]] = SceneNode(str(prim.GetName()), parent, T_parent, to_stage(prim))
            if (track := _track(pxr.UsdGeom.Xformable(prim))) is not None:
                tracks[numbers[key]] = track
    home = [numbers[path] for path in paths]
    return animated_joints(mesh, home, nodes, [("timeSamples", tracks)], folder) if tracks else mesh


def _track(xform: Any) -> NodeTrack | None:
    """Return how time samples move a prim; None if they do not, or if it does not move with the one above it."""
    times = np.unique(xform.GetTimeSamples()) if xform else np.zeros(0)
    if len(times) < 2 or xform.GetResetXformStack():
        return None

    def sample(when: Float[np.ndarray, " k"]) -> Float[np.ndarray, "k 4 4"]:
        return np.array([np.array(xform.GetLocalTransformation(float(t))).T for t in when])

    return NodeTrack(times.astype(np.float64), sample)


class _Reader:
    def __init__(self, pxr: Any, stage: Any, to_stage: Callable[[Any], np.ndarray], warn: Warn) -> None:
        self._pxr, self._stage, self._to_stage, self._warn = pxr, stage, to_stage, warn
        everything = stage.Traverse(pxr.Usd.TraverseInstanceProxies())
        self.bodies = {str(p.GetPath()) for p in everything if p.HasAPI(pxr.UsdPhysics.RigidBodyAPI)}

    def read(self, prim: Any) -> UsdJoint | None:
        """Return a joint; None, with a warning, for one that is switched off or that is no hinge, slide or ball."""
        joint, name = self._pxr.UsdPhysics.Joint(prim), str(prim.GetName())
        if value(joint.GetJointEnabledAttr()) is False:
            self._warn(f"joint {name!r} left out: it is switched off in the file")
            return None
        kind, axis, limits = self._motion(prim)
        if kind is None:
            self._warn(f"joint {name!r} left out: a {kind_of(prim).removeprefix('Physics')} is no hinge, slide or ball")
            return None
        ends = [self._end(rel) for rel in (joint.GetBody0Rel(), joint.GetBody1Rel())]
        (a, T_a), (b, T_b) = ends
        T_a = T_a @ _frame(joint.GetLocalPos0Attr(), joint.GetLocalRot0Attr())
        T_b = T_b @ _frame(joint.GetLocalPos1Attr(), joint.GetLocalRot1Attr())
        if a == b or not (np.isfinite(T_a).all() and np.isfinite(T_b).all()):
            self._warn(f"joint {name!r} left out: it does not connect two bodies by finite frames")
            return None
        return UsdJoint(
            name, kind, a, b, axis, T_a, T_b, limits, bool(value(joint.GetExcludeFromArticulationAttr())), *self._leader(prim)
        )

    def _leader(self, prim: Any) -> tuple[str, float]:
        """Return the joint that leads one, and the ratio of their positions; PhysX states its opposite."""
        for relationship, factor, sign in MIMICS:
            targets = prim.GetRelationship(relationship).GetTargets() if prim.GetRelationship(relationship) else []
            ratio = value(prim.GetAttribute(factor))
            ratio = sign * (1.0 if ratio is None else float(ratio))
            if targets and math.isfinite(ratio) and ratio:
                return str(targets[0].name), ratio
        return "", 1.0

    def _end(self, rel: Any) -> tuple[str, np.ndarray]:
        """Return the body that a relationship means, and the transform of its target to the stage."""
        targets = rel.GetForwardedTargets()
        prim = self._stage.GetPrimAtPath(targets[0]) if targets else None
        if not prim:
            return WORLD, np.eye(4)
        return _owner(str(prim.GetPath()), self.bodies), self._to_stage(prim)

    def _motion(self, prim: Any) -> Motion:
        kind = KINDS.get(kind_of(prim))
        if kind is JointType.FIXED:
            return kind, 0, (0.0, 0.0)
        if kind is None:
            return self._general(prim) if kind_of(prim) == "PhysicsJoint" else (None, 0, (0.0, 0.0))
        schema = self._pxr.UsdPhysics
        if kind is JointType.BALL:
            ball = schema.SphericalJoint(prim)
            cones = [value(a) for a in (ball.GetConeAngle0LimitAttr(), ball.GetConeAngle1LimitAttr())]
            axis, known = str(value(ball.GetAxisAttr())), [math.radians(c) for c in cones if c is not None and 0 < c <= 180]
            return kind, AXES.index(axis) if axis in AXES else 0, (0.0, min(known, default=math.inf))
        joint = (schema.RevoluteJoint if kind is JointType.REVOLUTE else schema.PrismaticJoint)(prim)
        axis = str(value(joint.GetAxisAttr()))
        low, high = value(joint.GetLowerLimitAttr()), value(joint.GetUpperLimitAttr())
        return _limited(kind, AXES.index(axis) if axis in AXES else 0, low, high)

    def _general(self, prim: Any) -> Motion:
        """Return the motion of a joint with limits for each degree of freedom, if at most one is free."""
        free = []
        for group, kind in (("trans", JointType.PRISMATIC), ("rot", JointType.REVOLUTE)):
            for k, axis in enumerate(AXES):
                limit = self._pxr.UsdPhysics.LimitAPI.Get(prim, f"{group}{axis}")
                motion = _limited(kind, k, value(limit.GetLowAttr()), value(limit.GetHighAttr()))
                free += [motion] if motion[0] is not JointType.FIXED else []
        return (JointType.FIXED, 0, (0.0, 0.0)) if not free else free[0] if len(free) == 1 else (None, 0, (0.0, 0.0))


def _limited(kind: JointType, axis: int, low: float | None, high: float | None) -> Motion:
    """Return the motion between two limits of the file [degrees or units]; none is no limit, no range is no motion."""
    low = -math.inf if low is None or math.isnan(low) else float(low)
    high = math.inf if high is None or math.isnan(high) else float(high)
    if low >= high:
        return JointType.FIXED, axis, (0.0, 0.0)
    turns = kind is JointType.REVOLUTE
    return kind, axis, (math.radians(low), math.radians(high)) if turns else (low, high)


def _frame(position: Any, rotation: Any) -> np.ndarray:
    """Return the transform that a joint's localPos and localRot state."""
    T, q = np.eye(4), value(rotation)
    q = np.array((1.0, 0, 0, 0)) if q is None else np.array((q.GetReal(), *q.GetImaginary()), float)
    w, x, y, z = q / max(float(np.linalg.norm(q)), 1e-12)
    T[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    place = value(position)
    T[:3, 3] = (0, 0, 0) if place is None else place
    return T


def _tree(
    joints: Sequence[UsdJoint], roots: Sequence[str], used: Sequence[str], apart: float, warn: Warn
) -> tuple[list[StatedJoint], dict[str, int]]:
    """Return the joints of a tree, parents first, and the joint of each body. used: the body of each node of the mesh."""
    tree = {body for j in joints if not j.excluded for body in (j.a, j.b)}
    loops = [j for j in joints if j.excluded and {j.a, j.b} <= tree]
    waiting = [j for j in joints if j not in loops]
    bodies = list(dict.fromkeys(body for j in joints for body in (j.a, j.b)))
    children = {j.b for j in joints}

    def rank(body: str) -> tuple[bool, bool, bool, int]:
        rooted = any(body and (root == body or root.startswith(body + "/")) for root in roots)
        return body != WORLD, not rooted, body in children, -used.count(body)

    stated: list[StatedJoint] = []
    read: list[tuple[UsdJoint, str]] = []
    of_body: dict[str, int] = {}
    for root in sorted(bodies, key=rank):
        if root in of_body:
            continue
        of_body[root], front = -1, [root]
        while front:
            here = front.pop(0)
            for joint in [j for j in waiting if here in (j.a, j.b)]:
                waiting.remove(joint)
                other = joint.b if here == joint.a else joint.a
                if other in of_body:
                    loops.append(joint)
                    continue
                front.append(other)
                if joint.type is JointType.FIXED and of_body[here] < 0:  # a part of the base
                    of_body[other] = -1
                    continue
                of_body[other] = len(stated)
                stated.append(_stated(joint, other, of_body[here], apart, warn))
                read.append((joint, other))
    for joint in loops:
        warn(f"joint {joint.name!r} left out: it closes a loop of joints")
    return _coupled(stated, read, used, warn), of_body


def _coupled(
    stated: Sequence[StatedJoint], read: Sequence[tuple[UsdJoint, str]], used: Sequence[str], warn: Warn
) -> list[StatedJoint]:
    """Return joints with what they follow; a slide that follows the turn of a body without a mesh, on its axis, is a screw.

    read: each joint as in the file, and the body that it moves.
    """
    number, made = {joint.name: k for k, (joint, _) in enumerate(read)}, list(stated)
    for k, (joint, _) in enumerate(read):
        leader, seen = number.get(joint.follows), {k}
        while leader is not None and leader not in seen and read[leader][0].follows in number:
            seen.add(leader)
            leader = number[read[leader][0].follows]
        if leader is None or leader in seen:
            continue
        own, lead = stated[k], stated[leader]
        if own.type is JointType.PRISMATIC and own.parent == leader and read[leader][1] not in used and lead.type in TURNING:
            along = float(own.axis @ lead.axis)
            turn = replace(lead, name=own.name, reason=own.reason, type=JointType.SCREW)
            made[k] = replace(turn, pitch=2 * math.pi * joint.ratio * math.copysign(1.0, along)) if abs(along) > ALONG else own
        elif (own.type in TURNING and lead.type in TURNING) or own.type is lead.type is JointType.PRISMATIC:
            made[k] = replace(own, follows=leader, ratio=_whole_ratio(k, number, read))
        else:
            warn(f"joint {joint.name!r} is read without what it follows: a {lead.type} joint cannot lead a {own.type} one")
    return made


def _whole_ratio(k: int, number: dict[str, int], read: Sequence[tuple[UsdJoint, str]]) -> float:
    """Return the ratio of a follower to the end of its chain."""
    ratio = 1.0
    while read[k][0].follows in number:
        ratio, k = ratio * read[k][0].ratio, number[read[k][0].follows]
    return ratio


def _stated(joint: UsdJoint, moved: str, parent: int, apart: float, warn: Warn) -> StatedJoint:
    """Return a joint from the shown pose of the body that it moves, which need not be its position 0."""
    R_a, R_b = (T[:3, :3] / np.maximum(np.linalg.norm(T[:3, :3], axis=0), 1e-12) for T in (joint.T_a, joint.T_b))
    axis, offset = R_a[:, joint.axis], joint.T_b[:3, 3] - joint.T_a[:3, 3]
    along = float(offset @ axis)
    slides, limits = joint.type is JointType.PRISMATIC, joint.limits
    across = float(np.linalg.norm(offset - along * axis)) if slides else float(np.linalg.norm(offset))
    tilt = float(np.arccos(np.clip(axis @ R_b[:, joint.axis], -1, 1)))
    if joint.type is not JointType.FIXED and (across > apart or tilt > math.radians(1)):
        warn(f"joint {joint.name!r}: its frames at both bodies do not meet; the one at {joint.a.rpartition('/')[2]!r} is used")
        now = 0.0
    elif slides:
        now = along
    else:
        k = (joint.axis + 1) % 3
        now = math.atan2(float(np.cross(R_a[:, k], R_b[:, k]) @ axis), float(R_a[:, k] @ R_b[:, k]))
    now = 0.0 if abs(now) < NOISE * (apart if slides else 1.0) else now
    if joint.type is JointType.BALL:
        now, axis = 0.0, R_a[:, joint.axis]
    finite = bool(np.isfinite(limits).all())
    kind = JointType.CONTINUOUS if joint.type is JointType.REVOLUTE and not finite else joint.type
    sign = 1.0 if moved == joint.b else -1.0
    return StatedJoint(
        kind, joint.T_a[:3, 3], sign * axis,
        (limits[0] - now, limits[1] - now) if finite and kind is not JointType.FIXED else None,
        range_known=finite or kind in (JointType.CONTINUOUS, JointType.BALL),
        name=moved.rpartition("/")[2], reason=f"from the joint {joint.name} of the file", parent=None if parent < 0 else parent,
    )  # fmt: skip
