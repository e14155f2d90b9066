"""A person's assignment of surface marks to parts."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

import numpy as np
from jaxtyping import Int

from anymesh.prompted.questions.grounding import WhichMarks

SPLIT = ("to be divided", 0)  # the group of marks that lie on more than one part
Group = tuple[str, int]  # label and instance of a part


class MarksForm:
    """Marks by part; each mark belongs to at most one group.

    current: the group that clicks apply to; hide_given: hide marks of other groups, so that those behind can be clicked.
    """

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
