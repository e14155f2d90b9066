"""Geometry-aware visual prompting (paper, 3.3): kinds of joint, points, arrows; beyond the paper, a choice among motions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from jaxtyping import Bool, Float, Int

from anymesh.prompted.questions.asking import BOOLEAN, INTEGER, BadAnswerError, a_list, an_answer, an_object, one_each, one_of
from anymesh.types import Brief, JointType, Motion
from anymesh.types.exchange import Pictures

OTHER = "other"  # label of a part that is none of the recognized kinds


class JointAppearance(StrEnum):
    """Appearance of a joint from outside (paper, 3.3)."""

    HINGE_ALONG = "hinge_along_edge"  # two or more points of the axis are visible where the parts meet
    HINGE_INTO = "hinge_into_surface"  # the axis enters the surface: one point of it is visible
    HINGE_HIDDEN = "hinge_hidden"  # the mechanism is under the surface
    SLIDE_OUT = "slide_in_or_out"
    SLIDE_ALONG = "slide_along_surface"
    FIXED = "fixed"

    @property
    def is_rotation(self) -> bool:
        return self in (JointAppearance.HINGE_ALONG, JointAppearance.HINGE_INTO, JointAppearance.HINGE_HIDDEN)

    @property
    def words(self) -> str:
        return self.value.replace("_", " ")


@dataclass(frozen=True, eq=False)
class PartShown(Brief):
    """A part in a question. The fields after the label are for answerers without pictures [m].

    diagonal: of the object's box, which gives the scale that an answered size may have changed; None if unknown.
    """

    label: str
    faces: Int[np.ndarray, " f"]  # of the mesh
    points: Float[np.ndarray, "n 3"]  # on its surface
    outward: Float[np.ndarray, " 3"]  # the opening direction of the object
    normal: Float[np.ndarray, " 3"]  # of the plane of the connecting area
    contact: Float[np.ndarray, "c 3"]  # points of the connecting area
    diagonal: float | None = None


@dataclass(frozen=True)
class KindAnswer:
    """Kind of joint of a part.

    endless: rotates without limits; label: the recognized kind of part, None if it was not asked for.
    """

    kind: JointAppearance
    endless: bool = False
    label: str | None = None


KINDS_IN_WORDS = (
    "hinge_along_edge: it turns about a line that runs along an edge where it meets the rest, as doors, lids and flaps "
    "do; hinge_into_surface: it turns about a line that sticks into the surface it sits on, as knobs and wheels do; "
    "hinge_hidden: it turns, but the hinge is under the surface; slide_in_or_out: it moves out of the object or into "
    "it, as drawers and push buttons do; slide_along_surface: it slides along the surface, as sliding windows "
    "and toaster levers do; fixed: it does not move. endless: it can turn round and round."
)


def kind_schema(labels: Sequence[str]) -> dict[str, Any]:
    """Return the properties of an answer about a part's kind of joint, and its label among these if there are any."""
    label = {"label": one_of((*labels, OTHER))} if labels else {}
    return {"joint": one_of(tuple(JointAppearance)), "endless": BOOLEAN, **label}


def _kind_of(part: Mapping[str, Any]) -> KindAnswer:
    kind, label = JointAppearance(part["joint"]), part.get("label")
    return KindAnswer(kind, part["endless"] and kind.is_rotation, None if label == OTHER else label)


@dataclass(frozen=True, eq=False)
class WhichKinds:
    """What kind of joint has each part? One picture per part.

    labels: recognized kinds of part to choose from, if parts are given without such a label; category: of the object.
    """

    pictures: Pictures
    parts: tuple[PartShown, ...]
    labels: tuple[str, ...] = ()
    category: str = "object"
    kind: str = "kinds"

    def text(self) -> str:
        labels = f" label: which of these it is: {', '.join(self.labels)}; else {OTHER!r}." if self.labels else ""
        return (
            f"Object: {self.category}. {_listed(self.parts)} How is each attached to the object that it belongs to? "
            f"{KINDS_IN_WORDS} The part is coloured.{labels}"
        )

    def schema(self) -> dict[str, Any]:
        return an_answer(parts=a_list(an_object(part=INTEGER, **kind_schema(self.labels))))

    def parse(self, answer: Mapping[str, Any]) -> tuple[KindAnswer, ...]:
        """Return the answers in the order of the parts."""
        one_each([p["part"] for p in answer["parts"]], len(self.parts), "part")
        by_part = {p["part"]: p for p in answer["parts"]}
        return tuple(_kind_of(p) for _, p in sorted(by_part.items()))


@dataclass(frozen=True, eq=False)
class PointTable(Brief):
    """Numbered candidate points of one part, as drawn: number k is row k - 1.

    The number of points to pick depends on the kind.

    axes: for each point the unit direction of its axis, NaN for a position only; hidden: points that lie under a surface.
    """

    part: PartShown
    points: Float[np.ndarray, "k 3"]
    kind: JointAppearance
    axes: Float[np.ndarray, "k 3"] | None = None
    hidden: Bool[np.ndarray, " k"] | None = None

    @property
    def min_points(self) -> int:
        return 2 if self.kind is JointAppearance.HINGE_ALONG and len(self.points) > 1 else 1

    @property
    def max_points(self) -> int:
        into = self.kind is JointAppearance.HINGE_INTO
        return min(len(self.points), (1 if self.axes is None else 2) if into else len(self.points))

    @property
    def wanted(self) -> str:
        if self.kind is JointAppearance.HINGE_INTO:
            one = "the one point nearest to its axis"
            return one if self.max_points == 1 else f"{one} where that comes out of the surface, or two points on its axis"
        far = "two or more points on its hinge line, far apart"
        return far if self.min_points > 1 else f"{far}, or a single point if the axis sticks out of the surface there"

    @property
    def listed(self) -> str:
        """Return the numbers that are drawn, in words."""
        hidden = np.zeros(len(self.points), bool) if self.hidden is None else self.hidden
        few = np.flatnonzero(hidden if hidden.mean() <= 0.5 else ~hidden) + 1
        numbers = f"{'' if hidden.mean() <= 0.5 else 'all but '}{', '.join(map(str, few))}" if len(few) else "all"
        under = f" (hidden: {numbers})" if hidden.any() else ""
        return f"{'point 1' if len(self.points) == 1 else f'points 1..{len(self.points)}'}{under}"


@dataclass(frozen=True, eq=False)
class WhichPoints:
    """Which numbered points lie on the axis? One picture per part."""

    pictures: Pictures
    tables: tuple[PointTable, ...]
    category: str = "object"
    kind: str = "points"
    two_views: bool = False  # of some part, beside each other

    def text(self) -> str:
        each = [f"part {k}, a {t.part.label}, {t.listed}: {t.wanted}" for k, t in enumerate(self.tables, 1)]
        sides = "Two views of a part share their numbers, and points of both can be combined. " if self.two_views else ""
        return (
            f"Object: {self.category}. Each picture shows one part (coloured) that turns about an axis, with "
            f"numbered points on it and round it; hollow dots are hidden under a surface. {sides}Think how such a part is "
            "mounted and which side its handle is on; the hinge of a door lies opposite its handle. "
            f"Give for {'; for '.join(each)}."
        )

    def schema(self) -> dict[str, Any]:
        return an_answer(parts=a_list(an_object(part=INTEGER, points=a_list(INTEGER))))

    def parse(self, answer: Mapping[str, Any]) -> tuple[tuple[int, ...], ...]:
        """Return the picked rows of each table, in the order of the tables."""
        one_each([p["part"] for p in answer["parts"]], len(self.tables), "part")
        by_part = {p["part"]: tuple(dict.fromkeys(p["points"])) for p in answer["parts"]}
        for k, table in enumerate(self.tables, 1):
            wrong = [n for n in by_part[k] if not 1 <= n <= len(table.points)]
            if wrong:
                raise BadAnswerError(f"points of part {k} are 1..{len(table.points)}, found {wrong[:10]}")
            if not table.min_points <= len(by_part[k]) <= table.max_points:
                raise BadAnswerError(f"part {k} needs {table.wanted}; found {len(by_part[k])} points")
        return tuple(tuple(n - 1 for n in by_part[k]) for k in range(1, len(self.tables) + 1))


@dataclass(frozen=True, eq=False)
class ArrowTable(Brief):
    """Numbered arrows of one part, as drawn: unit directions, number k is row k - 1."""

    part: PartShown
    directions: Float[np.ndarray, "k 3"]


@dataclass(frozen=True, eq=False)
class WhichArrows:
    """Along which arrow does the part open or move from its position? One picture per part."""

    pictures: Pictures
    tables: tuple[ArrowTable, ...]
    category: str = "object"
    kind: str = "arrows"

    def text(self) -> str:
        each = "; ".join(f"part {k}, a {t.part.label}, arrows 1..{len(t.directions)}" for k, t in enumerate(self.tables, 1))
        return (
            f"Object: {self.category}. "
            "Each picture shows one part (coloured) that slides along the surface of the object, and numbered arrows. Which "
            f"arrow shows the way it slides when it is opened or used? {each}."
        )

    def schema(self) -> dict[str, Any]:
        return an_answer(parts=a_list(an_object(part=INTEGER, arrow=INTEGER)))

    def parse(self, answer: Mapping[str, Any]) -> tuple[int, ...]:
        """Return the picked row of each table, in the order of the tables."""
        return picked_rows(answer["parts"], "arrow", [len(t.directions) for t in self.tables], 1)


def picked_rows(parts: list[Mapping[str, Any]], name: str, counts: Sequence[int], least: int) -> tuple[int, ...]:
    """Return the row that each part's answer picks by its number, -1 for 0.

    counts: number of rows of each part; least: lowest valid number.
    """
    one_each([p["part"] for p in parts], len(counts), "part")
    by_part = {p["part"]: p[name] for p in parts}
    for k, count in enumerate(counts, 1):
        if not least <= by_part[k] <= count:
            raise BadAnswerError(f"{name} of part {k} must be of {least}..{count}, found {by_part[k]}")
    return tuple(by_part[k] - 1 for k in range(1, len(counts) + 1))


def _listed(parts: Sequence[PartShown]) -> str:
    return f"The pictures show, in this order, {', '.join(f'part {k}: a {p.label}' for k, p in enumerate(parts, 1))}."


@dataclass(frozen=True, eq=False)
class MotionTable(Brief):
    """Numbered motions of one part, as drawn, and the displacement of each [rad or m]: number k is row k - 1.

    blocked: motions in which the part would hit something as modelled; moving: faces of the mesh that move, including those of
    carried parts, None for the part's own alone; words: of each motion, () for whether it turns or slides; alike: number of
    parts of this shape, which the answer holds for.
    """

    part: PartShown
    motions: tuple[Motion, ...]
    amounts: tuple[float, ...]
    blocked: tuple[bool, ...] = ()
    moving: Int[np.ndarray, " f"] | None = None
    words: tuple[str, ...] = ()
    alike: int = 1

    @property
    def described(self) -> tuple[str, ...]:
        """Return each motion in words, with those that are blocked."""
        words = self.words or tuple("slides" if m.kind is JointType.PRISMATIC else "turns" for m in self.motions)
        blocked = (*self.blocked, *[False] * len(words))
        return tuple(f"{word} (blocked)" if stop else word for word, stop in zip(words, blocked, strict=False))

    @property
    def listed(self) -> str:
        """Return the motions in words, with their numbers."""
        return ", ".join(f"{k} {word}" for k, word in enumerate(self.described, 1))


class PartFit(StrEnum):
    """Whether the coloured region is the part that moves."""

    RIGHT = "right"
    TOO_MUCH = "too_much"
    TOO_LITTLE = "too_little"

    @property
    def words(self) -> str:
        return self.value.replace("_", " ")


@dataclass(frozen=True)
class MotionPick:
    """Picked motion of a part.

    motion: a row of the table, None for none of them; part: whether the region shown is right; attached: the kind of joint,
    None if it was not asked for; leader: what it moves together with, None for nothing: the row of the table of that part, or
    its own, which stands for the parts of its shape.
    """

    motion: int | None
    part: PartFit = PartFit.RIGHT
    attached: KindAnswer | None = None
    leader: int | None = None


TOGETHER = (
    " with: the number of the part that it cannot move without, such as a gear that meshes or the stage of a telescope; its "
    "own number where the parts of its shape move only together, such as two leaves on one lever; 0 if it moves by itself."
)


@dataclass(frozen=True, eq=False)
class WhichMotions:
    """Which of the motions shown is the right one?

    One strip of pictures per part: at rest, then moved by each motion.

    ask_fit: the answer also says whether the coloured region is the whole part and nothing else; ask_kind: it also says what
    kind of joint the part has, and which of the labels, if parts are given without a recognized one; ask_with: it also says
    which part each one moves together with.
    """

    pictures: Pictures
    tables: tuple[MotionTable, ...]
    category: str = "object"
    ask_fit: bool = False
    kind: str = "motions"
    ask_kind: bool = False
    labels: tuple[str, ...] = ()
    ask_with: bool = False

    def text(self) -> str:
        alike = [f" (one of {t.alike} of its shape that move alike)" if t.alike > 1 else "" for t in self.tables]
        each = "; ".join(f"part {k}, a {t.part.label}{alike[k - 1]}, motions {t.listed}" for k, t in enumerate(self.tables, 1))
        fit = (
            f" part_is: {PartFit.TOO_MUCH} where things are coloured that do not move with it, {PartFit.TOO_LITTLE} where some "
            f"of it stays behind, else {PartFit.RIGHT}."
        )
        label = f" label: which of these it is: {', '.join(self.labels)}; else {OTHER!r}." if self.labels else ""
        return (
            f"Object: {self.category}. Each picture shows one part (coloured) at rest and then moved in several "
            "numbered ways, in no particular order; grey outlines show where it was. Which is the way that it moves in the "
            "real object, 0 if none of them is? Look at where its hinge would be, which side its handle is on, and what it "
            "would hit. Blocked ways run into something; choose one all the same where only the model is in the way. "
            f"{each}.{f' joint: how it is attached. {KINDS_IN_WORDS}' if self.ask_kind else ''}{label}"
            f"{fit if self.ask_fit else ''}{TOGETHER if self.ask_with else ''}"
        )

    def schema(self) -> dict[str, Any]:
        kind = kind_schema(self.labels) if self.ask_kind else {}
        fit = {"part_is": one_of(tuple(PartFit))} if self.ask_fit else {}
        coupled = {"with": INTEGER} if self.ask_with else {}
        return an_answer(parts=a_list(an_object(part=INTEGER, motion=INTEGER, **kind, **fit, **coupled)))

    def parse(self, answer: Mapping[str, Any]) -> tuple[MotionPick, ...]:
        """Return a pick for each table, in the order of the tables."""
        rows = picked_rows(answer["parts"], "motion", [len(t.motions) for t in self.tables], 0)
        leads = picked_rows(answer["parts"], "with", [len(self.tables)] * len(rows), 0) if self.ask_with else (-1,) * len(rows)
        told = {p["part"]: p for p in answer["parts"]}
        return tuple(
            MotionPick(
                None if row < 0 else row,
                PartFit(told[k].get("part_is", PartFit.RIGHT)),
                _kind_of(told[k]) if self.ask_kind else None,
                None if lead < 0 else lead,
            )
            for k, (row, lead) in enumerate(zip(rows, leads, strict=True), 1)
        )
