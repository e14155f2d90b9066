"""Ranked free motions of one part, computed again as in Stage B."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.articulation.estimate import all_motions, joint_of
from anymesh.articulation.part_contexts import part_context
from anymesh.articulation.rank_motions import joint_type, motion_scores, reason
from anymesh.correcting.corrections import ChooseMotion, vector
from anymesh.correcting.edits import joint_of_part, part_number
from anymesh.geometry.boxes import straight_mesh, turned_back
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.surface import ObjectShape
from anymesh.segmentation.divide import object_shape
from anymesh.types import Asset, Joint, JointType, Mesh

MAX_MOTIONS = 8
DENSE = 60_000  # number of faces above which an asset's surface is simplified first
MIN_PART_FACES = 500  # minimum number of faces of a simplified part
ALIKE = 0.97  # cosine between axes that are equal for a user
SAME_AXIS_RATIO = 0.02  # share of the object's diagonal: distance of hinge lines that are equal for a user


@dataclass(frozen=True, eq=False)
class Ready:
    """An asset's mesh prepared for both stages, simplified so that no face lies in two parts.

    part: of each face; T_straight: (4, 4), the rotation of the mesh, as in stage B.
    """

    whole: ObjectShape
    part: Int[np.ndarray, " n"]
    T_straight: Float[np.ndarray, "4 4"]


def made_ready(asset: Asset) -> Ready:
    """Prepare all current parts for `ranked_motions`, which is the slow step. Dense parts are simplified first."""
    mesh, T_straight = straight_mesh(asset.mesh)
    label, dense = asset.segmentation.face_part, len(mesh.faces) > DENSE
    if dense:
        mesh, label = _lighter(mesh, label)
    whole = object_shape(mesh, labels=label, soft=not dense)  # parts are known: soft creases need not be searched again
    return Ready(whole, label[whole.source], T_straight)


def _lighter(mesh: Mesh, label: np.ndarray) -> tuple[Mesh, np.ndarray]:
    """Simplify the surface to about DENSE triangles, part by part, and return the part of each triangle."""
    groups = [mesh.triangles[label == k] for k in range(int(label.max()) + 1)]
    few = [simplify(t, max(MIN_PART_FACES, DENSE * len(t) // len(label))) for t in groups]
    triangles, count = np.concatenate(few), sum(len(t) for t in few)
    nothing = np.zeros(count, np.int64)
    light = Mesh(triangles.reshape(-1, 3), np.arange(3 * count).reshape(-1, 3), nothing, mesh.nodes[:1], nothing - 1)
    return light, np.repeat(np.arange(len(few)), [len(t) for t in few])


def ranked_motions(asset: Asset, part: str, *, ready: Ready | None = None, most: int = MAX_MOTIONS) -> tuple[ChooseMotion, ...]:
    """Return the free motions of a part, most likely first, as corrections.

    They are swept against the other parts in the current tree. confidence: share of the likelihood of all free motions; limits:
    from the sweep; reason: the evidence in words. Motions that a user could not distinguish are returned once.
    Raise CorrectionError for the root.
    """
    joint_of_part(asset, part)
    ready = ready or made_ready(asset)
    names = [p.name for p in asset.segmentation.parts]
    hangs = {j.child: names.index(j.parent) for j in asset.joints}
    whole, label = ready.whole, ready.part
    shapes = [whole.of(np.flatnonzero(label == k)) for k in range(len(names))]
    number = part_number(asset, part)
    context = part_context(whole, label, shapes, [hangs.get(n, -1) for n in names], number)
    scored = all_motions(context, asset.segmentation.parts[number].label)
    scores = motion_scores(scored)
    free = [k for k in np.argsort(-scores, kind="stable") if scored.candidates[k].is_free]
    total = float(np.exp(scores[free] - scores.max()).sum()) if free else 1.0
    motions: list[ChooseMotion] = []
    for k in free:
        c = scored.candidates[k]
        joint = joint_of(context, part, names[hangs[part]], c, joint_type(c), 1.0, reason(c))
        motion = _choice(turned_back(joint, ready.T_straight), float(np.exp(scores[k] - scores.max()) / total))
        if not any(_alike(other, motion, asset.mesh.diagonal) for other in motions):
            motions.append(motion)
        if len(motions) == most:
            break
    return tuple(motions)


def _choice(joint: Joint, share: float) -> ChooseMotion:
    return ChooseMotion(joint.child, joint.type, vector(joint.axis), vector(joint.origin), joint.limits, share, joint.reason)


def _alike(a: ChooseMotion, b: ChooseMotion, diagonal: float) -> bool:
    axis = np.array(a.axis)
    if (a.type is JointType.PRISMATIC) != (b.type is JointType.PRISMATIC) or abs(float(axis @ b.axis)) < ALIKE:
        return False
    apart = np.linalg.norm(np.cross(np.subtract(b.origin, a.origin), axis))
    return a.type is JointType.PRISMATIC or float(apart) < SAME_AXIS_RATIO * diagonal
