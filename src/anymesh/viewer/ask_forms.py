"""A person's input to one question, independent of its display. Each form becomes the JSON object that is checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol, runtime_checkable

from anymesh.prompted.questions.grounding import WhichMarks
from anymesh.prompted.questions.prompting import (
    OTHER,
    JointAppearance,
    MotionTable,
    PartFit,
    PartShown,
    PointTable,
    WhichArrows,
    WhichKinds,
    WhichMotions,
    WhichPoints,
)
from anymesh.prompted.questions.recognition import Recognize
from anymesh.types import JointType
from anymesh.types.motion import BASE
from anymesh.types.questions import Question
from anymesh.viewer.ask_marks import MarksForm

UNNAMED = "part"


@runtime_checkable
class Form(Protocol):
    """Protocol of one question with its current answers. touched: edited by the person, so suggestions may not replace it."""

    touched: bool

    def fill(self, answer: Mapping[str, Any]) -> None:
        """Take over an answer, such as geometry's suggestion."""
        ...

    def answer(self) -> dict[str, Any]:
        """Return the object that the question checks."""
        ...


@dataclass
class LabelRow:
    """One kind of moving part; limits in degrees or centimetres."""

    label: str = UNNAMED
    moves: str = JointType.REVOLUTE.value
    parent: str = BASE
    lower: float = 0.0
    upper: float = 90.0


@dataclass
class RecognizeForm:
    """The object, and its kinds of moving parts.

    front: number of a picture, 0 for none; open_row: the expanded entry, -1 for none.
    """

    question: Recognize
    category: str = ""
    longest: float = 1.0
    front: int = 0
    rows: list[LabelRow] = field(default_factory=list)
    open_row: int = -1
    touched: bool = False

    def fill(self, answer: Mapping[str, Any]) -> None:
        self.category, self.longest, self.front = answer["category"], float(answer["longest_side_m"]), int(answer["front"])
        self.rows = [
            LabelRow(p["label"], p["moves"], p["parent"], round(p["lower"], 1), round(p["upper"], 1)) for p in answer["parts"]
        ]

    def answer(self) -> dict[str, Any]:
        rows = [{"label": r.label, "moves": r.moves, "parent": r.parent, "lower": r.lower, "upper": r.upper} for r in self.rows]
        return {"category": self.category, "longest_side_m": self.longest, "front": self.front, "parts": rows}

    def look_from(self, azimuth: float) -> None:
        """Choose the picture with the nearest azimuth [deg] as the one that shows the front."""
        off = [abs((a - azimuth + 180) % 360 - 180) for a in self.question.azimuths]
        self.front, self.touched = (off.index(min(off)) + 1 if off else 0), True


@dataclass
class PartsForm:
    """Base of forms that ask the same question about several parts in turn.

    see_through: parts for which the rest of the object is drawn transparent.
    """

    parts: tuple[PartShown, ...]
    step: int = 0
    touched: bool = False
    see_through: dict[int, bool] = field(default_factory=dict)

    @property
    def part(self) -> PartShown:
        """The part that is shown."""
        return self.parts[self.step]

    def go(self, by: int) -> None:
        """Show another part."""
        self.step = min(max(self.step + by, 0), len(self.parts) - 1)


@dataclass
class KindRow:
    """Attachment of one part."""

    joint: str = JointAppearance.HINGE_ALONG.value
    endless: bool = False
    label: str = OTHER


class KindsForm(PartsForm):
    """Attachment of each part. labels: options, empty if labels are not asked for."""

    def __init__(self, question: WhichKinds) -> None:
        super().__init__(question.parts)
        self.labels: tuple[str, ...] = (*question.labels, OTHER) if question.labels else ()
        self.rows = [KindRow() for _ in question.parts]

    def fill(self, answer: Mapping[str, Any]) -> None:
        for p in answer["parts"]:
            self.rows[p["part"] - 1] = KindRow(p["joint"], p["endless"], p.get("label", OTHER))

    def answer(self) -> dict[str, Any]:
        return {
            "parts": [
                {"part": k, "joint": row.joint, "endless": row.endless, **({"label": row.label} if self.labels else {})}
                for k, row in enumerate(self.rows, 1)
            ]
        }


class PointsForm(PartsForm):
    """Points on the axis of each part."""

    def __init__(self, question: WhichPoints) -> None:
        super().__init__(tuple(t.part for t in question.tables))
        self.tables = question.tables
        self.chosen: list[list[int]] = [[] for _ in question.tables]

    @property
    def table(self) -> PointTable:
        """The points of the part that is shown."""
        return self.tables[self.step]

    def toggle(self, number: int) -> None:
        """Select or deselect a point of the part that is shown; beyond the maximum, the oldest is deselected."""
        now = self.chosen[self.step]
        now = [n for n in now if n != number] if number in now else [*now, number]
        self.chosen[self.step], self.touched = now[-self.table.max_points :], True

    def fill(self, answer: Mapping[str, Any]) -> None:
        for p in answer["parts"]:
            self.chosen[p["part"] - 1] = list(p["points"])

    def answer(self) -> dict[str, Any]:
        return {"parts": [{"part": k, "points": list(chosen)} for k, chosen in enumerate(self.chosen, 1)]}


class ArrowsForm(PartsForm):
    """Slide direction of each part, by arrow."""

    def __init__(self, question: WhichArrows) -> None:
        super().__init__(tuple(t.part for t in question.tables))
        self.tables = question.tables
        self.chosen = [1] * len(question.tables)

    def choose(self, number: int) -> None:
        """Choose an arrow for the part that is shown."""
        self.chosen[self.step], self.touched = number, True

    def fill(self, answer: Mapping[str, Any]) -> None:
        for p in answer["parts"]:
            self.chosen[p["part"] - 1] = p["arrow"]

    def answer(self) -> dict[str, Any]:
        return {"parts": [{"part": k, "arrow": arrow} for k, arrow in enumerate(self.chosen, 1)]}


class MotionsForm(PartsForm):
    """Motion of each part, 0 for none of those shown."""

    def __init__(self, question: WhichMotions) -> None:
        super().__init__(tuple(t.part for t in question.tables))
        self.tables, self.ask_fit = question.tables, question.ask_fit
        self.chosen = [1] * len(question.tables)
        self.fits = [PartFit.RIGHT.value] * len(question.tables)

    @property
    def table(self) -> MotionTable:
        """The motions of the part that is shown."""
        return self.tables[self.step]

    def choose(self, number: int) -> None:
        """Choose a motion for the part that is shown."""
        self.chosen[self.step], self.touched = number, True

    def fill(self, answer: Mapping[str, Any]) -> None:
        for p in answer["parts"]:
            self.chosen[p["part"] - 1] = p["motion"]

    def answer(self) -> dict[str, Any]:
        return {
            "parts": [
                {"part": k, "motion": motion, **({"part_is": fit} if self.ask_fit else {})}
                for k, (motion, fit) in enumerate(zip(self.chosen, self.fits, strict=True), 1)
            ]
        }


def form_of(question: Question[Any]) -> Form | None:
    """Return the empty form of a question; None if it cannot be answered on the object itself."""
    match question:
        case Recognize():
            return RecognizeForm(question)
        case WhichMarks() if question.face_mark is not None:
            return MarksForm(question, question.face_mark)
        case WhichKinds():
            return KindsForm(question)
        case WhichPoints():
            return PointsForm(question)
        case WhichArrows():
            return ArrowsForm(question)
        case WhichMotions():
            return MotionsForm(question)
    return None
