"""A person's input to one question, independent of its display. Each form becomes the JSON object that is checked."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
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

SPLIT = ("to be divided", 0)  # the group of marks that lie on more than one part
Group = tuple[str, int]  # label and instance of a part


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

    @property
    def place(self) -> str:
        alike = self.table.alike
        return super().place + (f", one of {alike} that move alike" if alike > 1 else "")

    def leaders(self, step: int) -> dict[str, int]:
        """What a part may move together with, in words, with the number in the answer; its own stands for those like it."""
        others = {f"part {k}: {t.part.label}": k for k, t in enumerate(self.tables, 1) if k != step + 1}
        return {"nothing": 0, **({"those like it": step + 1} if self.tables[step].alike > 1 else {}), **others}

    def fill(self, answer: Mapping[str, Any]) -> None:
        super().fill(answer)
        for p in answer["parts"]:
            k = p["part"] - 1
            if self.rows:
                self.rows[k] = KindRow.of(p)
            if self.fits:
                self.fits[k] = p.get("part_is", PartFit.RIGHT.value)
            if self.leads:
                lead = p.get("with", 0)
                self.leads[k] = lead if lead in self.leaders(k).values() else 0

    def answer(self) -> dict[str, Any]:
        answer = super().answer()
        for key, some in (("part_is", self.fits), ("with", self.leads)):
            for row, value in zip(answer["parts"], some, strict=False):
                row[key] = value
        for row, kind in zip(answer["parts"], self.rows, strict=False):
            row |= kind.answer(self.labels)
        return answer
