"""Joints that are too unsure to be written (`--precision`): proposals, whose parts stay fixed until a person accepts them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from anymesh.correcting.articulations import calibration
from anymesh.correcting.motions import motion_words
from anymesh.types import Asset, Joint, JointType, Part, ProposedJoint, Segmentation
from anymesh.types.motion import leaders


def probability(parts: Sequence[Part], joint: Joint) -> float:
    """Return the probability that a joint is right: that its part moves by itself, and that it moves so.

    A stated, corrected or confirmed joint has confidence 1, which also says that its part moves.
    """
    part = next(p for p in parts if p.name == joint.child)
    return 1.0 if joint.confidence == 1 else combined(part.confidence, joint.confidence, calibration())


def combined(part: float, joint: float, numbers: Mapping[str, float]) -> float:
    """Return the probability that a part and its joint are right by their confidences.

    numbers: slope and offset of the log-odds of the product of the two (benchmarks/reports/precision.md).
    """
    both = min(max(part * joint, 1e-6), 1 - 1e-6)
    return 1 / (1 + math.exp(-numbers["slope"] * math.log(both / (1 - both)) - numbers["offset"]))


def unsure(asset: Asset, precision: float) -> dict[str, float]:
    """Return the probability of the joints below a precision, by their part; a follower is as sure as its leader at most."""
    moving = (joint for joint in asset.joints if joint.type is not JointType.FIXED)
    known = {joint.child: probability(asset.segmentation.parts, joint) for joint in moving}
    left, child = {name: p for name, p in known.items() if p < precision}, {j.name: j.child for j in asset.joints}
    led = {child[name]: left[child[way.joint]] for name, way in leaders(asset.joints).items() if child[way.joint] in left}
    return led | left


def with_proposals(asset: Asset, precision: float) -> Asset:
    """Return the asset with the joints that are right with at least this probability; the others are proposals.

    The faces of their parts belong to the part that carries them, and so do parts that they carry. Warnings about them are
    dropped: each proposal has its own reason.
    """
    left = unsure(asset, precision)
    if not left:
        return asset
    parts, parent = asset.segmentation.parts, {joint.child: joint.parent for joint in asset.joints}

    def carrier(name: str) -> str:
        while name in left:
            name = parent[name]
        return name

    kept = [part.name for part in parts if part.name not in left]
    number = np.array([kept.index(carrier(part.name)) for part in parts])
    faces = {part.name: asset.segmentation.faces(k) for k, part in enumerate(parts)}
    ways = leaders(asset.joints)  # the chain of a follower may lead over one that is left out
    kept_joints = (j for j in asset.joints if j.child not in left)
    joints = tuple(replace(j, parent=carrier(j.parent), mimic=ways.get(j.name)) for j in kept_joints)
    proposed = tuple(
        ProposedJoint(next(p for p in parts if p.name == j.child), j, left[j.child], motion_words(asset, j), faces[j.child])
        for j in asset.joints
        if j.child in left
    )
    about = tuple(text for p in proposed for text in (f"joint {p.joint.name}:", f"part {p.part.name}:"))
    return replace(
        asset,
        segmentation=Segmentation(number[asset.segmentation.face_part], tuple(p for p in parts if p.name not in left)),
        joints=joints,
        loops=tuple(loop for loop in asset.loops if not {loop.first, loop.second} & {*left}),
        proposals=(*asset.proposals, *proposed),
        warnings=tuple(w for w in asset.warnings if not w.startswith(about)),
    )
