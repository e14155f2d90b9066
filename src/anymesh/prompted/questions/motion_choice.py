"""The question that goes beyond the paper's visual prompting: which of several motions that are shown is the right one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from jaxtyping import Int

from anymesh.prompted.questions.asking import INTEGER, a_list, an_answer, an_object, one_of
from anymesh.prompted.questions.prompting import PartShown, picked_rows
from anymesh.types import JointType, Motion
from anymesh.types.exchange import Pictures


@dataclass(frozen=True, eq=False)
class MotionTable:
    """Numbered motions of one part, as drawn, and the displacement of each [rad or m]: number k is row k - 1.

    blocked: motions in which the part would hit something as modelled; moving: faces of the mesh that move, including those of
    carried parts, None for the part's own alone.
    """

    part: PartShown
    motions: tuple[Motion, ...]
    amounts: tuple[float, ...]
    blocked: tuple[bool, ...] = ()
    moving: Int[np.ndarray, " f"] | None = None

    @property
    def listed(self) -> str:
        """Return the motions in words."""
        words = []
        for k, motion in enumerate(self.motions):
            blocked = ", blocked" if k < len(self.blocked) and self.blocked[k] else ""
            words.append(f"{k + 1} ({'slides' if motion.kind is JointType.PRISMATIC else 'turns'}{blocked})")
        return ", ".join(words)


class PartFit(StrEnum):
    """Whether the coloured region is the part that moves."""

    RIGHT = "right"
    TOO_MUCH = "too_much"
    TOO_LITTLE = "too_little"


@dataclass(frozen=True)
class MotionPick:
    """Picked motion of a part.

    motion: a row of the table, None for none of them; part: whether the region shown is right.
    """

    motion: int | None
    part: PartFit = PartFit.RIGHT


@dataclass(frozen=True, eq=False)
class WhichMotions:
    """Which of the motions shown is the right one?

    One strip of pictures per part: at rest, then moved by each motion.

    ask_fit: the answer also says whether the coloured region is the whole part and nothing else.
    """

    pictures: Pictures
    tables: tuple[MotionTable, ...]
    category: str = "object"
    ask_fit: bool = False
    kind: str = "motions"

    def text(self) -> str:
        each = "; ".join(f"part {k}, a {t.part.label}, motions {t.listed}" for k, t in enumerate(self.tables, 1))
        fit = (
            f" part_is: {PartFit.TOO_MUCH} where things are coloured that do not move with it, {PartFit.TOO_LITTLE} where some "
            f"of it stays behind, else {PartFit.RIGHT}."
        )
        return (
            f"Object: {self.category}. Each picture shows one part (coloured) at rest and then moved in several "
            "numbered ways, in no particular order; grey outlines show where it was. Which is the way that it moves in the "
            "real object, 0 if none of them is? Look at where its hinge would be, which side its handle is on, and what it "
            "would hit. Blocked ways run into something; choose one all the same where only the model is in the way. "
            f"{each}.{fit if self.ask_fit else ''}"
        )

    def schema(self) -> dict[str, Any]:
        fit = {"part_is": one_of(tuple(PartFit))} if self.ask_fit else {}
        return an_answer(parts=a_list(an_object(part=INTEGER, motion=INTEGER, **fit)))

    def parse(self, answer: Mapping[str, Any]) -> tuple[MotionPick, ...]:
        """Return a pick for each table, in the order of the tables."""
        rows = picked_rows(answer["parts"], "motion", [len(t.motions) for t in self.tables], 0)
        fits = {p["part"]: PartFit(p.get("part_is", PartFit.RIGHT)) for p in answer["parts"]}
        return tuple(MotionPick(None if row < 0 else row, fits[k]) for k, row in enumerate(rows, 1))
