"""One small question of every kind, an answer to it as a model would write it, and its parsed value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from assets import checker
from hypothesis import strategies as st

from anymesh.prompted.questions.grounding import EqualMarks, MarkedPart, MarksAnswer, WhichMarks, WhichViews
from anymesh.prompted.questions.prompting import (
    ArrowTable,
    JointAppearance,
    KindAnswer,
    MotionPick,
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
from anymesh.types.motion import Recognition, RecognizedLabel
from anymesh.types.questions import Question

X, Y, Z = np.eye(3)
PICTURE = Picture(checker(), "view 1, from the front")


@dataclass(frozen=True, eq=False)
class Asked:
    """A question with an answer.

    found: a valid answer object; means: its parsed value.
    """

    question: Question[Any]
    found: dict[str, Any]
    means: Any


def part(label: str = "door", faces: range = range(2), **changes: Any) -> PartShown:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 1], [1, 0, 1]])
    facts = {"faces": np.array(faces), "points": points, "outward": -Y, "normal": Y, "contact": points[[0, 2]]}
    return PartShown(label, **(facts | changes))


def table(kind: JointAppearance, count: int) -> PointTable:
    return PointTable(part(), np.arange(3.0 * count).reshape(count, 3), kind)


def parts(*rows: dict[str, Any]) -> dict[str, Any]:
    return {"parts": list(rows)}


def marks(*rows: tuple[str, int, int, list[int]], **more: list[int]) -> dict[str, Any]:
    """Return an answer from label, instance, view (0 if marks are the same in all pictures) and marks of each part."""
    named = [dict(zip(("label", "instance", "view", "marks"), row, strict=True)) for row in rows]
    return {**parts(*({k: v for k, v in row.items() if (k, v) != ("view", 0)} for row in named)), "unsure": [], **more}


def picks(name: str, *rows: Any) -> dict[str, Any]:
    """Return an answer that gives the first row to part 1, and so on."""
    return parts(*({"part": k, name: row} for k, row in enumerate(rows, 1)))


TURNS = tuple(Motion(JointType.REVOLUTE, axis, np.zeros(3), "built so") for axis in (X, Z))
REGIONS = (np.array([[1, 2], [3, -1]]), np.array([[2, 4], [-1, -1]]))  # the marks of two pictures
FACES = (np.zeros((2, 2), int), np.zeros((2, 2), int))
WHEEL = RecognizedLabel("wheel", JointType.CONTINUOUS, "base", None, 4)
WHEELS = (np.array([[1, 2], [3, -1]]), np.array([[4, 5], [6, 7]]))
"""Marks of three tyres, 1 to 3, and of three hubs, the last of which, 6, lies off its tyre; 7 is as large as a hub."""
PLACES = np.array([[0.0, 0, 0], [4, 0, 0], [8, 0, 0], [4, 0.1, 0], [0, 0.1, 0], [8, 3, 0], [2, 5, 0]])
EQUAL = EqualMarks(np.arange(1, 8), np.array([0, 0, 0, 1, 1, 1, 1]), PLACES)
DOOR = {"label": "door", "moves": "revolute", "parent": "base", "lower": 0, "upper": 90}
KNOB = {"label": "knob", "moves": "continuous", "parent": "door", "lower": 0, "upper": 0}
TRAY = {"label": "tray", "moves": "prismatic", "parent": "base", "lower": -5, "upper": 30.5}

ASKED = {
    "recognize": Asked(
        Recognize((PICTURE,) * 3, None, (0.0, 45.0, 90.0)),
        {"category": "kitchen cabinet", "longest_side_m": 1.5, "front": 2, **parts(DOOR, KNOB, TRAY)},
        Recognition(
            "kitchen cabinet",
            1.5,
            (
                RecognizedLabel("door", JointType.REVOLUTE, "base", (0.0, 90 * 3.141592653589793 / 180)),
                RecognizedLabel("knob", JointType.CONTINUOUS, "door", None),
                RecognizedLabel("tray", JointType.PRISMATIC, "base", (-0.05, 0.305)),
            ),
            45.0,
        ),
    ),
    "regions": Asked(
        RecognizeRegions((PICTURE,) * 3, (1, 2, 2), (WHEEL,), "truck"),
        {
            "regions": [{"region": 2, "labels": ["Wheel", "flap"]}, {"region": 1, "labels": []}],
            **parts(
                {"label": "flap", "moves": "revolute", "parent": "base", "lower": 0, "upper": 90, "count": 2},
                {"label": "wheel", "moves": "continuous", "parent": "base", "lower": 0, "upper": 0, "count": 6},
            ),
        },
        (
            RecognizedLabel("wheel", JointType.CONTINUOUS, "base", None, 6),
            RecognizedLabel("flap", JointType.REVOLUTE, "base", (0.0, 90 * 3.141592653589793 / 180), 2),
        ),
    ),
    "views": Asked(
        WhichViews((PICTURE,) * 2, ("door", "knob"), FACES),
        parts({"label": "knob", "views": []}, {"label": "door", "views": [2, 1, 2]}),
        {"door": (0, 1), "knob": ()},
    ),
    "marks": Asked(
        WhichMarks((PICTURE,) * 2, ("door", "knob"), True, REGIONS, FACES, "cabinet"),
        {"reason": "one of them is round", **marks(("door", 1, 0, [4, 1]), ("knob", 1, 0, [2]), unsure=[4])},
        MarksAnswer((MarkedPart("door", 1, None, (1, 4)), MarkedPart("knob", 1, None, (2,))), unsure=(4,)),
    ),
    "marks that can be split": Asked(
        WhichMarks((PICTURE,) * 2, ("door", "knob"), True, REGIONS, FACES, None, (MarkedPart("lid", 1, None, (9,)),), True),
        marks(("door", 1, 0, [4, 1]), split=[1]),
        MarksAnswer((MarkedPart("door", 1, None, (4,)),), split=(1,)),  # marks to split belong to no part yet
    ),
    "marks of kinds that only close-ups show": Asked(
        WhichMarks((PICTURE,) * 2, ("door", "knob"), True, REGIONS, FACES, extensible=True),
        marks(("Door", 1, 0, [4, 1]), ("Hose reel", 1, 0, [2])),
        MarksAnswer((MarkedPart("door", 1, None, (1, 4)), MarkedPart("hose reel", 1, None, (2,)))),
    ),
    "marks of which one stands for its equals": Asked(
        WhichMarks((PICTURE,) * 2, ("wheel", "knob"), True, WHEELS, FACES, equal=EQUAL, counts=(3, 0)),
        parts(
            {"label": "wheel", "instance": 1, "marks": [1, 5], "all_equal": True},
            {"label": "knob", "instance": 1, "marks": [7], "all_equal": False},
        )
        | {"unsure": []},
        MarksAnswer(
            (
                MarkedPart("wheel", 1, None, (1, 5)),
                MarkedPart("knob", 1, None, (7,)),
                MarkedPart("wheel", 2, None, (2, 4)),
                MarkedPart("wheel", 3, None, (3,)),
            )
        ),
    ),
    "marks of each view": Asked(
        WhichMarks((PICTURE,) * 2, ("door", "knob"), False, REGIONS, FACES),
        marks(("door", 1, 1, [2]), ("knob", 1, 2, [2])),
        MarksAnswer((MarkedPart("door", 1, 0, (2,)), MarkedPart("knob", 1, 1, (2,)))),
    ),
    "kinds": Asked(
        WhichKinds((PICTURE,) * 2, (part(), part("tray"))),
        parts(
            {"part": 2, "joint": "slide_in_or_out", "endless": True},  # a slide has no endless rotation
            {"part": 1, "joint": "hinge_into_surface", "endless": True},
        ),
        (KindAnswer(JointAppearance.HINGE_INTO, True), KindAnswer(JointAppearance.SLIDE_OUT, False)),
    ),
    "points": Asked(
        WhichPoints((PICTURE,) * 3, tuple(table(kind, 4) for kind in JointAppearance if kind.is_rotation)),
        parts({"part": 3, "points": [2]}, {"part": 1, "points": [4, 1, 4]}, {"part": 2, "points": [3]}),
        ((3, 0), (2,), (1,)),
    ),
    "arrows": Asked(
        WhichArrows((PICTURE,), (ArrowTable(part(), np.stack([X, -X, Z, -Z])),)), parts({"part": 1, "arrow": 4}), (3,)
    ),
    "motions": Asked(
        WhichMotions((PICTURE,) * 2, (MotionTable(part(), TURNS, (1.0, 1.0)),) * 2),
        parts({"part": 1, "motion": 0}, {"part": 2, "motion": 2}),
        (MotionPick(None), MotionPick(1)),
    ),
}  # fmt: skip


def satisfying(schema: dict[str, Any]) -> st.SearchStrategy[Any]:
    """Return a strategy of values that satisfy a schema: small numbers, hostile words."""
    match schema["type"]:
        case "object":
            return st.fixed_dictionaries({name: satisfying(s) for name, s in schema["properties"].items()})
        case "array":
            return st.lists(satisfying(schema["items"]), max_size=3)
        case "string" if "enum" in schema:
            return st.sampled_from(schema["enum"])
        case "string":
            return st.sampled_from(["door", "base", "tray", ""]) | st.text() | st.just("ignore this. " * 400)
        case "integer":
            return st.integers(-1, 5) | st.integers(-(10**9) + 1, 10**9 - 1)
        case "number":
            return st.integers(-5, 5) | st.floats(-1e9, 1e9, exclude_min=True, exclude_max=True)
    return st.booleans()
