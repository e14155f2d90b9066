"""A person's input to one question, independent of its display. Each form becomes the JSON object that is checked."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, ClassVar

import numpy as np
from jaxtyping import Int

from anymesh.prompted.questions.grounding import WhichMarks
from anymesh.prompted.questions.prompting import (
    OTHER,
    JointAppearance,
    PartFit,
    PartShown,
    WhichArrows,
    WhichKinds,
    WhichMotions,
    WhichPoints,
)
from anymesh.prompted.questions.recognition import Recognize, RecognizeRegions, folded
from anymesh.prompted.questions.saved_question import answer_object
from anymesh.types import JointType
from anymesh.types.motion import BASE

UNNAMED = "part"
NO_LIMITS = {JointType.CONTINUOUS.value: {"lower": 0.0, "upper": 0.0}}
SPLIT = ("to be divided", 0)  # the group of marks that lie on more than one part
Group = tuple[str, int]  # label and instance of a part
MOVES = {
    "turns within limits": JointType.REVOLUTE,
    "turns round and round": JointType.CONTINUOUS,
    "slides": JointType.PRISMATIC,
}


class Form:
    """One question with its current answers, with a title and instructions that are shorter than those for models.

    touched: edited by the person, so suggestions may not replace it.
    """

    title: ClassVar[str]
    instructions: ClassVar[str] = ""
    touched: bool

    @property
    def guide(self) -> str:
        """What the person is asked to do."""
        return self.instructions

    def fill(self, answer: Mapping[str, Any]) -> None:
        """Take over an answer, such as geometry's suggestion."""
        raise NotImplementedError

    def answer(self) -> dict[str, Any]:
        """Return the object that the question checks."""
        raise NotImplementedError


@dataclass
class LabelRow:
    """One kind of moving part; limits in degrees or centimetres."""

    label: str = UNNAMED
    moves: str = JointType.REVOLUTE.value
    parent: str = BASE
    lower: float = 0.0
    upper: float = 90.0
    count: int = 0

    @property
    def words(self) -> str:
        """Description in one line."""
        moves = JointType(self.moves)
        words = next(k for k, v in MOVES.items() if v is moves)
        unit = "cm" if moves is JointType.PRISMATIC else "°"
        limits = "" if moves is JointType.CONTINUOUS else f", {self.lower:g} to {self.upper:g} {unit}"
        return f"{self.label}: {words}{limits}"


@dataclass
class RowsForm(Form):
    """Base of forms about kinds of moving parts. open_row: the expanded entry, -1 for none."""

    rows: list[LabelRow] = field(default_factory=list)
    open_row: int = -1
    touched: bool = False

    def fill(self, answer: Mapping[str, Any]) -> None:
        self.rows = [LabelRow(**p | {end: round(float(p[end]), 1) for end in ("lower", "upper")}) for p in answer["parts"]]

    def answer(self) -> dict[str, Any]:
        return {"parts": [asdict(r) | NO_LIMITS.get(r.moves, {}) for r in self.rows]}


class RecognizeForm(RowsForm):
    """The object, and its kinds of moving parts. front: number of a picture, 0 for none."""

    title = "What is this, and what moves?"
    instructions = "Name the object and give one entry for each kind of part that moves; click an entry to change it."

    def __init__(self, question: Recognize) -> None:
        super().__init__()
        self.question, self.category, self.longest, self.front, self.machine = question, "", 1.0, 0, False

    def fill(self, answer: Mapping[str, Any]) -> None:
        super().fill(answer)
        self.machine = answer.get("machine", False)
        self.category, self.longest, self.front = answer["category"], float(answer["longest_side_m"]), int(answer["front"])

    def answer(self) -> dict[str, Any]:
        own = {"category": self.category, "longest_side_m": self.longest, "front": self.front, "machine": self.machine}
        return own | super().answer()

    def look_from(self, azimuth: float) -> None:
        """Choose the picture with the nearest azimuth [deg] as the one that shows the front."""
        off = [abs((a - azimuth + 180) % 360 - 180) for a in self.question.azimuths]
        self.front, self.touched = (off.index(min(off)) + 1 if off else 0), True


class RegionsForm(RowsForm):
    """The kinds of moving parts of a machine: those found so far, to which those of a closer look are added."""

    title = "What else moves?"
    instructions = "Look closely at each region; add kinds of part that move and are not listed, remove what does not move."

    def __init__(self, question: RecognizeRegions) -> None:
        super().__init__()
        self.question = question
        self.fill({"parts": ()})

    def fill(self, answer: Mapping[str, Any]) -> None:
        """Take over an answer, which lists only what differs from what was found."""
        rows = {p["label"]: p for p in (*answer_object(self.question, self.question.known)["parts"], *answer["parts"])}
        super().fill({"parts": [p for label, p in rows.items() if label not in answer.get("withdrawn", ())]})

    def answer(self) -> dict[str, Any]:
        left = {folded(r.label) for r in self.rows}
        return answer_object(self.question, [r for r in self.question.known if r.label in left]) | super().answer()


class MarksForm(Form):
    """Marks by part; each mark belongs to at most one group.

    current: the group that clicks apply to; hide_given: hide marks of other groups, so that those behind can be clicked.
    """

    title = "Which faces are which part?"
    instructions = "Choose a part below, then click its regions; click again to take one back. Leave what does not move."

    def __init__(self, question: WhichMarks, face_mark: Int[np.ndarray, " F"]) -> None:
        self.question, self.face_mark = question, face_mark
        self.asked = frozenset(np.unique(np.concatenate([r[r > 0] for r in question.regions])).tolist())
        self._label_rank = {label: k for k, label in enumerate(question.labels)}
        self.groups: dict[Group, set[int]] = {(p.label, p.instance): set() for p in question.found}
        self._add_missing()
        self.unsure: set[Group] = set()
        self.current = next(iter(self.groups))
        self.touched = self.hide_given = False

    def hidden(self) -> set[int]:
        """Return the marks that are not shown."""
        if not self.hide_given:
            return set()
        return set[int]().union(*(marks for group, marks in self.groups.items() if group != self.current)) & self.asked

    def _add_missing(self) -> None:
        """Add each label at least once, and a group of marks to be divided if the question accepts them."""
        for label in self.question.labels:
            if not any(group[0] == label for group in self.groups):
                self.groups[label, 1] = set()
        if self.question.splittable:
            self.groups.setdefault(SPLIT, set())
        self.groups = dict(sorted(self.groups.items(), key=lambda item: (self._label_rank.get(item[0][0], 99), item[0][1])))

    def add(self, label: str) -> None:
        """Add one more part of a label, and make it current."""
        instance = 1 + max((k for name, k in self.groups if name == label), default=0)
        self.groups[label, instance] = set()
        self._add_missing()
        self.current, self.touched = (label, instance), True

    def toggle(self, mark: int) -> bool:
        """Add a mark to the current group, or remove it; return False if the question does not include it."""
        if mark not in self.asked:
            return False
        self.touched = True
        mine = mark in self.groups[self.current]
        for marks in self.groups.values():
            marks.discard(mark)
        if not mine:
            self.groups[self.current].add(mark)
        return True

    def set_marks(self, text: str) -> list[int]:
        """Set the marks of the current group from typed text; return the numbers that the question does not include."""
        numbers = {int(n) for n in re.findall(r"\d{1,9}", text)}
        self.groups[self.current] = set()
        for mark in numbers & self.asked:
            self.toggle(mark)
        self.touched = True
        return sorted(numbers - self.asked)

    def group_of(self, mark: int) -> Group | None:
        """Return the group of a mark."""
        return next((group for group, marks in self.groups.items() if mark in marks), None)

    def fill(self, answer: Mapping[str, Any]) -> None:
        for marks in self.groups.values():
            marks.clear()
        for p in answer["parts"]:
            self.groups.setdefault((p["label"], p["instance"]), set()).update(set(p["marks"]) & self.asked)
        if self.question.splittable:
            self.groups.setdefault(SPLIT, set()).update(set(answer.get("split", ())) & self.asked)
        self._add_missing()
        self.current = next(iter(self.groups))

    def answer(self) -> dict[str, Any]:
        rows = [
            {"label": label, "instance": k, "marks": sorted(marks)}
            for (label, k), marks in self.groups.items()
            if marks and (label, k) != SPLIT
        ]
        unsure = sorted(set[int]().union(*(self.groups[g] for g in self.unsure if g in self.groups)))
        split = {"split": sorted(self.groups.get(SPLIT, set()))} if self.question.splittable else {}
        return {"parts": rows, "unsure": unsure, **split}


@dataclass
class PartsForm(Form):
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

    @property
    def place(self) -> str:
        """Which of several parts is in question."""
        return f"Part {self.step + 1} of {len(self.parts)}: {self.part.label}"


@dataclass
class KindRow:
    """Attachment of one part."""

    joint: str = JointAppearance.HINGE_ALONG.value
    endless: bool = False
    label: str = OTHER

    @classmethod
    def of(cls, part: Mapping[str, Any]) -> KindRow:
        """Return the row of an answer about a part."""
        return cls(part["joint"], part["endless"], part.get("label", OTHER))

    def answer(self, labels: Sequence[str]) -> dict[str, Any]:
        """Return the answer; labels: as in `KindsForm`."""
        return {"joint": self.joint, "endless": self.endless, **({"label": self.label} if labels else {})}


class KindsForm(PartsForm):
    """Attachment of each part. labels: options, empty if labels are not asked for."""

    title = "How is it attached?"
    instructions = "Look at the coloured part and say how it moves."

    def __init__(self, question: WhichKinds) -> None:
        super().__init__(question.parts)
        self.labels: tuple[str, ...] = (*question.labels, OTHER) if question.labels else ()
        self.rows = [KindRow() for _ in question.parts]

    def fill(self, answer: Mapping[str, Any]) -> None:
        for p in answer["parts"]:
            self.rows[p["part"] - 1] = KindRow.of(p)

    def answer(self) -> dict[str, Any]:
        return {"parts": [{"part": k, **row.answer(self.labels)} for k, row in enumerate(self.rows, 1)]}


class TableForm(PartsForm):
    """A choice for each part from a table of its own. KEY: of the choice in an answer."""

    KEY: ClassVar[str]

    def __init__(self, tables: Sequence[Any], chosen: Any) -> None:
        super().__init__(tuple(t.part for t in tables))
        self.tables = tables
        self.chosen = [chosen for _ in tables]

    @property
    def table(self) -> Any:
        """The table of the part that is shown."""
        return self.tables[self.step]

    def choose(self, choice: Any) -> None:
        """Choose for the part that is shown."""
        self.chosen[self.step], self.touched = choice, True

    def fill(self, answer: Mapping[str, Any]) -> None:
        for p in answer["parts"]:
            self.chosen[p["part"] - 1] = p[self.KEY]

    def answer(self) -> dict[str, Any]:
        return {"parts": [{"part": k, self.KEY: choice} for k, choice in enumerate(self.chosen, 1)]}


class PointsForm(TableForm):
    """Points on the axis of each part."""

    KEY = "points"
    title = "Where does it turn?"

    def __init__(self, question: WhichPoints) -> None:
        super().__init__(question.tables, [])

    @property
    def guide(self) -> str:
        return f"Click, on the object: {self.table.wanted}. Pale points lie under a surface."

    @property
    def words(self) -> str:
        """The chosen points of the part that is shown."""
        return ", ".join(map(str, self.chosen[self.step])) or "none"

    def toggle(self, number: int) -> None:
        """Select or deselect a point of the part that is shown; beyond the maximum, the oldest is deselected."""
        now = self.chosen[self.step]
        now = [n for n in now if n != number] if number in now else [*now, number]
        self.choose(now[-self.table.max_points :])


class ArrowsForm(TableForm):
    """Slide direction of each part, by arrow."""

    KEY = "arrow"
    title = "Which way does it slide?"
    instructions = "Choose the arrow along which the coloured part opens."

    def __init__(self, question: WhichArrows) -> None:
        super().__init__(question.tables, 1)

    @property
    def words(self) -> str:
        """The chosen arrow of the part that is shown."""
        return f"Arrow {self.chosen[self.step]}."


class MotionsForm(TableForm):
    """Motion of each part, 0 for none of those shown."""

    KEY = "motion"
    title = "Which motion is right?"
    instructions = "Each number plays a motion of the coloured part. Leave the right one playing."

    def __init__(self, question: WhichMotions) -> None:
        super().__init__(question.tables, 1)
        self.labels: tuple[str, ...] = (*question.labels, OTHER) if question.labels else ()
        self.rows = [KindRow() for _ in question.tables] if question.ask_kind else []
        self.fits = [PartFit.RIGHT.value] * len(question.tables) if question.ask_fit else []
        self.leads = [0] * len(question.tables) if question.ask_with else []  # parts that they move together with

    @property
    def words(self) -> str:
        """Description of the chosen motion of the part that is shown."""
        number, table = self.chosen[self.step], self.table
        if number == 0:
            return "None of these."
        return f"Motion {number} of {len(table.motions)}: it {table.described[number - 1]}."

    def fill(self, answer: Mapping[str, Any]) -> None:
        super().fill(answer)
        if self.rows:
            self.rows = [KindRow.of(p) for p in sorted(answer["parts"], key=lambda p: p["part"])]
        self.leads = self.leads and [p["with"] for p in sorted(answer["parts"], key=lambda p: p["part"])]

    def answer(self) -> dict[str, Any]:
        answer = super().answer()
        for key, some in (("part_is", self.fits), ("with", self.leads)):
            for row, value in zip(answer["parts"], some, strict=False):
                row[key] = value
        for row, kind in zip(answer["parts"], self.rows, strict=False):
            row |= kind.answer(self.labels)
        return answer
