"""Contexts, facts and candidate motions made by hand."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any
from unittest.mock import patch

import numpy as np
from geometry.rigid import shape_of

from anymesh.articulation.candidate_motions import Candidate, PartFacts, Role
from anymesh.motion.part_context import PartContext
from anymesh.prompted.grounding import views
from anymesh.prompted.pictures import views as pictures
from anymesh.types import JointType, Motion, Sweep

X, Y, Z = np.eye(3)
PLATE = PartFacts("part", size=0.7, roundness=0.3)


def context_of(part: list, rest: list, *siblings: list, **changes: Any) -> PartContext:
    """Return the context of a part of pieces (vertices, faces) on static pieces, beside other movable parts of pieces."""
    other = [piece for some in siblings for piece in some]
    corners = np.concatenate([v for v, _ in [*part, *rest, *other]])
    low, high = corners.min(0), corners.max(0)
    return PartContext(
        part=shape_of(*part), parent=shape_of(*rest), rest=shape_of(*rest), other_surface=shape_of(*other) if other else None,
        without_part=shape_of(*rest, *other), diagonal=float(np.linalg.norm(high - low)), center=(low + high) / 2,
        **{
            "barrel_candidates": (), "other_parts": tuple(shape_of(*s) for s in siblings),
            **changes,
        },
    )  # fmt: skip


def turn(axis: np.ndarray, origin=(0.0, 0, 0)) -> Motion:
    return Motion(JointType.REVOLUTE, np.asarray(axis, float), np.asarray(origin, float), "a line")


def slide(axis: np.ndarray, origin=(0.0, 0, 0)) -> Motion:
    return Motion(JointType.PRISMATIC, np.asarray(axis, float), np.asarray(origin, float), "a direction")


def candidate(role: Role, kind: JointType, axis: np.ndarray, **changes: Any) -> Candidate:
    """Return a candidate that is free along its axis."""
    free = np.pi if kind is JointType.REVOLUTE else 0.5
    sweep = Sweep(free, 0.0, True, False)
    made = Candidate(Motion(kind, axis, np.zeros(3), role), sweep, role, 1, free, 0.0, outward=1.0)
    return replace(made, **changes)


EDGE = candidate("edge", JointType.REVOLUTE, Z, hinge_support=1.0)
FAR_EDGE = replace(EDGE, motion=Motion(JointType.REVOLUTE, Z, X, "other edge"))
PULL = candidate("slide", JointType.PRISMATIC, Y)
ROUND = candidate("round", JointType.REVOLUTE, Y, closing=np.pi)


@contextmanager
def smaller(px: int, points: int, mask_points: int | None = None) -> Iterator[None]:
    """Draw pictures of `px` pixels, and sample fewer points of surfaces: faster, and as good in these tests."""
    count = {"EXACT_POINTS": points, "MASK_POINTS": mask_points or points}
    with patch.object(pictures, "PICTURE_PX", px), patch.multiple(views, **count):
        yield
