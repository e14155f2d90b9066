"""Ranked free motions of one part, computed again as in Stage B, and words that tell them apart."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Int

from anymesh.articulation.estimate import all_motions, joint_of
from anymesh.articulation.part_contexts import part_context
from anymesh.articulation.rank_motions import joint_type, motion_scores, reason
from anymesh.articulation.vetting import faults
from anymesh.correcting.corrections import ChooseMotion, vector
from anymesh.correcting.edits import choose_motion
from anymesh.correcting.tree import joint_of_part, part_number
from anymesh.geometry.boxes import straight_mesh, turned_back
from anymesh.geometry.simplify_ import simplify
from anymesh.geometry.surface import ObjectShape
from anymesh.motion.part_context import PartContext
from anymesh.prompted.pictures.sides import Sides
from anymesh.prompted.pictures.sides import told_apart as words_told_apart
from anymesh.segmentation.divide import object_shape
from anymesh.types import Asset, Brief, Joint, JointType, Mesh

MAX_MOTIONS = 8
DENSE = 60_000  # number of faces above which an asset's surface is simplified first
MIN_PART_FACES = 500  # minimum number of faces of a simplified part
ALIKE = 0.97  # cosine between axes that are equal for a user
SAME_AXIS_RATIO = 0.02  # share of the object's diagonal: distance of hinge lines that are equal for a user
# of a line from a side, by its name: how it lies, and how something moves that goes both ways
AXES = {"right": "left to right", "front": "front to back", "top": "vertical"}
BOTH = {"right": "left and right", "front": "forwards and back", "top": "up and down"}
STRAIGHT = 0.94  # cosine (20 degrees) from which a line is called by one name
BOTH_RATIO = 0.5  # range to the shorter side, relative to that to the other, from which a motion goes both ways
MIDDLE = 0.3  # offset of an axis from the part's middle, as a share of its reach, up to which it is in the middle
FLAT = 0.5  # height of a lid, relative to its shorter side
STILL = {JointType.FIXED: "does not move", JointType.FREE: "lifts off", JointType.BALL: "turns about a point"}
AT_EDGE = 0.05  # share of the object's diagonal: distance from its outside within which a part is at the outside


@dataclass(frozen=True, eq=False)
class Ready(Brief):
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
    number, parent = part_number(asset, part), joint_of_part(asset, part).parent
    context = _context(asset, ready, number)
    scored = all_motions(context, asset.segmentation.parts[number].label)
    scores = motion_scores(scored)
    free = [k for k in np.argsort(-scores, kind="stable") if scored.candidates[k].is_free]
    total = float(np.exp(scores[free] - scores.max()).sum()) if free else 1.0
    motions: list[ChooseMotion] = []
    for k in free:
        c = scored.candidates[k]
        joint = joint_of(context, part, parent, c, joint_type(c), 1.0, reason(c))
        motion = _choice(turned_back(joint, ready.T_straight), float(np.exp(scores[k] - scores.max()) / total))
        if not any(_alike(other, motion, asset.mesh.diagonal) for other in motions):
            motions.append(motion)
        if len(motions) == most:
            break
    return tuple(motions)


def _context(asset: Asset, ready: Ready, number: int) -> PartContext:
    names = [p.name for p in asset.segmentation.parts]
    hangs = {j.child: names.index(j.parent) for j in asset.joints}
    shapes = [ready.whole.of(np.flatnonzero(ready.part == k)) for k in range(len(names))]
    return part_context(ready.whole, ready.part, shapes, [hangs.get(n, -1) for n in names], number)


def motion_faults(asset: Asset, parts: Collection[str]) -> dict[str, str]:
    """Return what is wrong with the joints of some parts within their limits, in short phrases, as a run tests them."""
    joints = [j for j in asset.joints if j.child in parts and j.limits is not None]
    if not joints:
        return {}
    ready = made_ready(asset)
    contexts = {j.child: _context(asset, ready, part_number(asset, j.child)) for j in joints}
    return faults(contexts, [turned_back(j, np.linalg.inv(ready.T_straight)) for j in joints])


def _choice(joint: Joint, share: float) -> ChooseMotion:
    return ChooseMotion(joint.child, joint.type, vector(joint.axis), vector(joint.origin), joint.limits, share, joint.reason)


def _alike(a: ChooseMotion, b: ChooseMotion, diagonal: float) -> bool:
    axis = np.array(a.axis)
    if (a.type is JointType.PRISMATIC) != (b.type is JointType.PRISMATIC) or abs(float(axis @ b.axis)) < ALIKE:
        return False
    apart = np.linalg.norm(np.cross(np.subtract(b.origin, a.origin), axis))
    return a.type is JointType.PRISMATIC or float(apart) < SAME_AXIS_RATIO * diagonal


def motion_words(asset: Asset, joint: Joint) -> str:
    """Describe a joint of an asset by how its part moves: "slides out, to the front", "hinge right, vertical"."""
    return _facets(asset, joint)[0]


def told_apart(asset: Asset, motions: Sequence[ChooseMotion]) -> tuple[str, ...]:
    """Describe motions of the parts of an asset in words that differ: what two have in common is followed by what differs."""
    joints = [next(j for j in choose_motion(asset, m).joints if j.child == m.part) for m in motions]
    facets = [_facets(asset, j) for j in joints]
    words = [f[0] for f in facets]
    for level in (1, 2):
        differ = [len({f[level] for f, other in zip(facets, words, strict=True) if other == w}) > 1 for w in words]
        words = [f"{w}, {f[level]}" if d and f[level] else w for w, f, d in zip(words, facets, differ, strict=True)]
    way = _sides(asset).direction

    def further(k: int, first: int) -> str:
        off = joints[k].origin - joints[first].origin
        return f"{100 * np.linalg.norm(off):.1f} cm further {way(off)}"

    return words_told_apart(words, further)


def _sides(asset: Asset) -> Sides:
    """Return the sides of an asset; the front is where y is least, unless another one was answered."""
    return Sides(asset.front or 0.0)


def _facets(asset: Asset, joint: Joint) -> tuple[str, str, str]:
    """Return what a motion is, where it opens to, and how far, "" where that says nothing."""
    corners = asset.mesh.triangles[asset.segmentation.faces(part_number(asset, joint.child))].reshape(-1, 3)
    lower, upper = joint.limits or (0.0, 0.0)
    opening = (1.0 if upper >= -lower else -1.0) * joint.axis
    both = min(upper, -lower) > BOTH_RATIO * max(upper, -lower)
    sides = _sides(asset)
    if joint.type in STILL:
        return STILL[joint.type], "", ""
    shares = {name: abs(float(joint.axis @ way)) for way, name, _ in sides.axes}
    if joint.type is JointType.PRISMATIC:
        slides = _slides(asset, corners, opening, max(upper, -lower))
        words = f"slides, {BOTH[max(shares, key=shares.__getitem__)]}" if both else f"{slides}, {sides.direction(opening)}"
        return words, "", f"{100 * lower:.1f}..{100 * upper:.1f} cm"
    range_ = "" if joint.limits is None else f"{np.degrees(lower):.0f}..{np.degrees(upper):.0f}°"
    low, high = corners.min(0), corners.max(0)
    arm = (low + high) / 2 - joint.origin
    arm -= (arm @ joint.axis) * joint.axis
    along = next((AXES[name] for name, share in shares.items() if share > STRAIGHT), "slanted")
    off = corners - joint.origin
    reach = np.linalg.norm(off - (off @ joint.axis)[:, None] * joint.axis, axis=1).max()
    central = np.linalg.norm(arm) < MIDDLE * reach
    endless = " endlessly" if joint.type is JointType.CONTINUOUS else " as a screw" if joint.type is JointType.SCREW else ""
    if endless or central:
        return f"turns{endless}{'' if central else f' about its {sides.side(-arm)}'}, axis {along}", "", range_
    swing = "" if both else f"opens {sides.direction(np.cross(opening, arm))}"
    return _hinge(high - low, along, sides.side(-arm)), swing, range_


def _hinge(size: np.ndarray, along: str, side: str) -> str:
    """Describe a hinge at one side of a part of this size."""
    if along == AXES["top"]:
        return f"hinge {side}, vertical"
    words = f"{'lid' if size[2] < FLAT * min(size[:2]) else 'flap'}, hinge at the {side}"
    return words if along in AXES.values() else f"{words}, slanted"


def _slides(asset: Asset, corners: np.ndarray, opening: np.ndarray, travel: float) -> str:
    """Return whether a part slides out of the object, even from behind a door, is pushed into it, or slides along it."""
    part, whole = corners @ opening, asset.mesh.vertices @ opening
    near = AT_EDGE * asset.mesh.diagonal
    ahead = whole.max() - part.max()
    if ahead < near or travel > ahead + near:
        return "slides out"
    return "is pushed in" if part.min() - whole.min() < near else "slides"
