"""Joints that the file states, in both stages: their nodes are parts, and they replace the joints that were found for these."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.articulation.candidate_motions import ProposedMotion, hinge_about, propose
from anymesh.articulation.estimate import PartMotions, estimate_joint
from anymesh.articulation.evidence import sweep_candidates
from anymesh.articulation.rank_motions import PartMotionScores
from anymesh.loading.scene_graph import is_generic
from anymesh.names import legal_names
from anymesh.pipeline.results import JointResult, SegmentationResult, joint_result, segmentation_result
from anymesh.pipeline.solving import GeometryStages
from anymesh.types import MOVING, Joint, JointType, Mesh, Mimic, Part, Segmentation, StatedJoint
from anymesh.types.motion import with_implied_limits
from anymesh.vocabulary import recognize

MIN_SHARED = 0.5  # share of a part's area in the faces that a stated joint moves, from which they are the same


def parts_with_stated(mesh: Mesh, result: SegmentationResult) -> SegmentationResult:
    """Return the result of Stage A with the parts that stated joints move."""
    on_parts = segmentation_result(result.segmentation, "").warnings
    general = tuple(warning for warning in result.warnings if warning not in on_parts)
    return segmentation_result(with_stated_parts(mesh, result.segmentation), result.answerer, general, result.exchanges)


def joints_with_stated(
    geometry: GeometryStages, segmentation: Segmentation, estimate: Callable[[], JointResult]
) -> JointResult:
    """Return the result of Stage B with the stated joints; others are estimated, if there are any, in the frame of geometry."""
    mesh = geometry.mesh
    stated = part_of_joint(mesh, segmentation)
    whole = all(_is_whole(mesh.joints[j]) for j in stated)
    if whole and len(stated) == len(segmentation.parts) - 1:
        return joint_result(with_stated_joints(mesh, segmentation, ()), geometry.name)
    result = estimate()
    on_joints = joint_result(result.joints, "").warnings
    final, general = result.segmentation or segmentation, tuple(w for w in result.warnings if w not in on_joints)
    joints = with_stated_joints(mesh, final, result.joints, () if whole else geometry.motions(final))
    return replace(
        joint_result(joints, result.answerer, general, result.exchanges), segmentation=result.segmentation, loops=result.loops
    )


def _owner(mesh: Mesh) -> Int[np.ndarray, " F"]:
    """Return the joint that moves each face, -1 for none."""
    return np.array([node.joint for node in mesh.nodes])[mesh.face_node]


def with_stated_parts(mesh: Mesh, segmentation: Segmentation) -> Segmentation:
    """Return the parts with the faces of each stated joint as one of them; parts that mostly consist of these are left out."""
    if not mesh.joints:
        return segmentation
    owner, before = _owner(mesh), segmentation.parts
    area = np.zeros((len(before), len(mesh.joints) + 1))
    np.add.at(area, (segmentation.face_part, owner), mesh.face_areas)  # the last column is that of no joint
    still = area[:, -1]
    stated = [j for j in np.argsort(-area.sum(0), kind="stable").tolist() if j < len(mesh.joints) and (owner == j).any()]
    kept = [k for k in range(1, len(before)) if still[k] > MIN_SHARED * area[k].sum()]
    # A stated joint may move the given base; the largest still part is then the base.
    root = 0 if still[0] > 0 or not kept else max(kept, key=lambda k: still[k])
    kept = [k for k in kept if k != root]
    if not (still > 0).any():
        root, stated = 0, stated[1:]
    number, of_joint = np.zeros(len(before), np.int64), np.zeros(len(mesh.joints) + 1, np.int64)
    number[kept] = np.arange(len(kept)) + 1
    stated.sort()
    of_joint[stated] = np.arange(len(stated)) + len(kept) + 1
    parts = [replace(before[root], label="base"), *(before[k] for k in kept)]
    parts += [_stated_part(_part_name(mesh, j), mesh.joints[j].reason, area[:, j], before) for j in stated]
    names = legal_names([part.name for part in parts])
    named = tuple(replace(part, name=name) for part, name in zip(parts, names, strict=True))
    return Segmentation(np.where(owner >= 0, of_joint[owner], number[segmentation.face_part]), named)


def _part_name(mesh: Mesh, joint: int) -> str:
    """Return the name of the node that moves; of the object below it if that is its cleaned name, or the other says nothing."""
    name, below = mesh.joints[joint].name, [node.name for node in mesh.nodes if node.joint == joint]
    return below[0] if is_generic(name) or (len(below) == 1 and name.startswith(below[0])) else name


def _stated_part(name: str, reason: str, area: Float[np.ndarray, " p"], parts: Sequence[Part]) -> Part:
    """Return the part that a joint moves, labelled by its name, or as the part that was there before.

    area: of its faces in each of these parts.
    """
    word, before = recognize(name), int(area.argmax())
    same = before > 0 and area[before] > MIN_SHARED * area.sum()
    label = word.label if word else parts[before].label if same else "part"
    return Part(name or label, label, 1.0, reason)


def part_of_joint(mesh: Mesh, segmentation: Segmentation) -> dict[int, int]:
    """Return the part that each stated joint moves, by the joint's index; a joint of the base has none."""
    owner, parts = _owner(mesh), dict[int, int]()
    size = np.bincount(segmentation.face_part, mesh.face_areas)
    for j in range(len(mesh.joints)):
        mine = np.bincount(segmentation.face_part, mesh.face_areas * (owner == j), len(size))
        k = int(mine.argmax())
        if k and k not in parts.values() and mine[k] > MIN_SHARED * size[k]:
            parts[j] = k
    return parts


def with_stated_joints(
    mesh: Mesh, segmentation: Segmentation, joints: Sequence[Joint], motions: Sequence[PartMotions] = ()
) -> tuple[Joint, ...]:
    """Return the joints of all parts but the base: the stated ones, and those that were estimated for other parts.

    motions: of each part by geometry, which completes joints whose axis or range is not stated.
    """
    moved, names = part_of_joint(mesh, segmentation), [part.name for part in segmentation.parts]
    of_part, by_part = {joint.child: joint for joint in joints}, {m.part: m for m in motions}
    for j, k in moved.items():
        stated, parent = mesh.joints[j], mesh.joints[j].parent
        while parent is not None and parent not in moved:
            parent = mesh.joints[parent].parent
        parent_name = names[0 if parent is None else moved[parent]]
        if _is_whole(stated):
            axis, name = stated.axis / np.linalg.norm(stated.axis), f"{names[k]}_joint"
            limits = None if stated.limits is None else (min(stated.limits[0], 0.0), max(stated.limits[1], 0.0))
            kind = JointType.FIXED if limits == (0.0, 0.0) else stated.type
            limits = None if kind is JointType.FIXED else limits
            pitch = stated.pitch if kind is JointType.SCREW else 0.0
            joint = Joint(name, kind, parent_name, names[k], stated.origin, axis, limits, 1.0, stated.reason, pitch=pitch)
        else:
            joint = _completed(stated, by_part[k], segmentation, parent_name)
        of_part[names[k]] = joint
    leads = {k: moved[leader] for j, k in moved.items() if (leader := mesh.joints[j].follows) in moved}
    for j, k in moved.items():
        own, lead = of_part[names[k]], of_part.get(names[leads.get(k, 0)])
        if lead is not None and {own.type, lead.type} <= {*MOVING}:
            of_part[names[k]] = replace(own, mimic=Mimic(lead.name, mesh.joints[j].ratio))
    return with_implied_limits([of_part[name] for name in names[1:]])


def _is_whole(joint: StatedJoint) -> bool:
    """Return whether nothing of a joint is left to geometry."""
    return joint.axis_known and joint.range_known


def _completed(stated: StatedJoint, part: PartMotions, segmentation: Segmentation, parent: str) -> Joint:
    """Return the joint that geometry chooses among those that agree with what is stated."""
    context, motion = part.context, stated.opening_motion
    proposed: list[ProposedMotion] = [("asked", motion)]
    if not stated.axis_known:
        slides = [(role, m) for role, m in propose(context) if m.kind is JointType.PRISMATIC]
        proposed = [*(("edge", hinge_about(a, stated.origin, "line through its bone")) for a in context.body_obb.axes), *slides]
    chosen = segmentation.parts[part.part]
    motions = PartMotionScores(context, chosen.label, sweep_candidates(context, proposed)).averaged()
    joint = estimate_joint(context, chosen.name, parent, motions)
    return replace(joint, reason=f"{stated.reason}; {joint.reason}")
