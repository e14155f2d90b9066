"""Every question that a page puts to a person, about the cabinet of `assets`, with a good answer."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from assets import cabinet, checker

from anymesh.prompted.questions.grounding import WhichMarks
from anymesh.prompted.questions.prompting import (
    ArrowTable,
    JointAppearance,
    MotionTable,
    PartShown,
    PointTable,
    WhichArrows,
    WhichKinds,
    WhichMotions,
    WhichPoints,
)
from anymesh.prompted.questions.recognition import Recognize, RecognizeRegions
from anymesh.types import JointType, Motion, Picture
from anymesh.types.motion import RecognizedLabel

ASSET = cabinet()
MESH = ASSET.mesh
FACE_PART = ASSET.segmentation.face_part  # marks are the part's number: 1 door, 2 drawer, 3 knob
X, Y, Z = np.eye(3)
PICTURE = Picture(checker(), "picture 1: from the front")


def part(number: int, scale: float = 1.0) -> PartShown:
    """A part, in a question whose lengths are `scale` times those of the mesh."""
    faces = np.flatnonzero(number == FACE_PART)
    points = scale * MESH.triangles[faces].reshape(-1, 3)
    return PartShown(ASSET.segmentation.parts[number].label, faces, points, -Y, Y, points[:1], diagonal=scale * MESH.diagonal)


def marks(**changes: Any) -> WhichMarks:
    regions = (np.array([[1, 2], [3, -1]]),)
    fields = {"face_mark": FACE_PART, "splittable": True} | changes
    return WhichMarks((PICTURE,), ("door", "drawer", "knob"), True, regions, regions, "cabinet", **fields)


def points(scale: float = 1.0) -> WhichPoints:
    line = np.array([[0.6, 0, 0.05], [0.6, 0, 0.3], [0.6, 0, 0.55], [0.0, 0, 0.3]])
    hidden = np.array([False, True, False, False])
    return WhichPoints((PICTURE,), (PointTable(part(1, scale), scale * line, JointAppearance.HINGE_ALONG, None, hidden),))


def motions(scale: float = 1.0) -> WhichMotions:
    hinge = Motion(JointType.REVOLUTE, Z, scale * np.array([0.6, 0, 0.3]), "hinge")
    out = Motion(JointType.PRISMATIC, -Y, np.zeros(3), "out")
    door = MotionTable(part(1, scale), (out, hinge), (0.2 * scale, 1.0), (False, True))
    both = np.flatnonzero(np.isin(FACE_PART, [2, 3]))
    return WhichMotions((PICTURE,) * 2, (door, MotionTable(part(2, scale), (out,), (0.2 * scale,), (False,), both)))


def coupled() -> WhichMotions:
    """Motions with all that can be asked besides; the second part is one of two of its shape."""
    door, drawer = motions().tables
    tables = (door, replace(drawer, alike=2))
    return replace(motions(), tables=tables, ask_fit=True, ask_kind=True, labels=("door", "drawer"), ask_with=True)


def regions() -> RecognizeRegions:
    """A foot on a leg, and a closer look at two regions."""
    over = (("leg", "base"), ("foot", "leg"))
    return RecognizeRegions(
        (PICTURE,) * 2, (1, 2), tuple(RecognizedLabel(n, JointType.REVOLUTE, o, (0.0, 1.0), 2) for n, o in over)
    )


def questions() -> dict[str, tuple[Any, dict[str, Any]]]:
    """Kind of question -> the question, and an answer that it takes."""
    door = {"label": "door", "moves": "revolute", "parent": "base", "lower": 0.0, "upper": 90.0, "count": 2}
    hinge, slide = {"joint": "hinge_along_edge", "endless": False}, {"joint": "slide_in_or_out", "endless": False}
    knob = {"label": "knob", "moves": "continuous", "parent": "door", "lower": 0.0, "upper": 0.0, "count": 0}
    return {
        "recognize": (
            Recognize((PICTURE,) * 4, None, (0.0, 90.0, 180.0, 270.0)),
            {"category": "cabinet", "longest_side_m": 1.2, "front": 1, "machine": False, "parts": [door, knob]},
        ),
        "marks": (
            marks(),
            {
                "parts": [{"label": "door", "instance": 1, "marks": [1]}, {"label": "drawer", "instance": 1, "marks": [2]}],
                "unsure": [],
                "split": [3],
            },
        ),
        "kinds": (
            WhichKinds((PICTURE,) * 2, (part(1), part(2)), ("door", "drawer")),
            {
                "parts": [
                    {"part": 1, "joint": "hinge_along_edge", "endless": False, "label": "door"},
                    {"part": 2, "joint": "slide_in_or_out", "endless": False, "label": "drawer"},
                ]
            },
        ),
        "points": (points(), {"parts": [{"part": 1, "points": [1, 3]}]}),
        "arrows": (
            WhichArrows((PICTURE,), (ArrowTable(part(2), np.stack([X, -Y])),)),
            {"parts": [{"part": 1, "arrow": 2}]},
        ),
        "motions": (motions(), {"parts": [{"part": 1, "motion": 2}, {"part": 2, "motion": 0}]}),
        "coupled": (
            coupled(),
            {
                "parts": [
                    {"part": 1, "motion": 2, "part_is": "too_much", "with": 2, "label": "door", **hinge},
                    {"part": 2, "motion": 1, "part_is": "right", "with": 2, "label": "other", **slide},
                ]
            },
        ),
        "regions": (
            regions(),
            {
                "regions": [{"region": 1, "labels": []}, {"region": 2, "labels": []}],
                "parts": [{**knob, "label": "foot", "parent": "base"}, {**door, "label": "hatch"}],
                "withdrawn": ["leg"],
            },
        ),
    }
