"""Recognition of an object and its movable parts (paper, 3.2 and 4: labels, joint types, parents, limits by the VLM)."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from anymesh.errors import OptionError
from anymesh.prompted.questions.asking import (
    BOOLEAN,
    INTEGER,
    NUMBER,
    STRING,
    BadAnswerError,
    a_list,
    an_answer,
    an_object,
    one_each,
    one_of,
    with_category,
)
from anymesh.types import MOVING, JointType, Picture
from anymesh.types.exchange import DrawnPictures, Pictures
from anymesh.types.motion import BASE, Recognition, RecognizedLabel
from anymesh.types.questions import VisualAnswerer

MAX_LABELS = 24  # kinds of part per answer
MAX_COUNT = 400  # parts of a kind; there are no more marks
SIZES = (0.002, 200.0)  # [m] range of the size of an object
ROUGH = 1.5  # a model's size is a guess: the mesh keeps its own size if both agree within this factor
GIVEN = "--scale"  # that the scale of the user is kept
EXACT = 1.01  # the same of an answer in a file, which may be a person's measure
FAR = 10.0  # factor between the answered size and that of a file without a unit above which there is a warning
WORD = re.compile(r"(?=.{1,40}$)[a-z][a-z0-9]*([ _'-][a-z0-9]+){0,4}")


LIMITS = (
    "lower, upper: how far it can move from the pose that is shown, opening positive: degrees for revolute, centimetres for "
    "prismatic, 0 and 0 for continuous; lower <= 0 <= upper."
)
KIND = (
    "label: one short English noun in lower case. moves: revolute (turns within limits), continuous (turns endlessly) or "
    "prismatic (slides). parent: the label of the part that it is mounted on, its own label where such parts hang on each "
    f"other in a chain, or {BASE!r}. {LIMITS}"
)
COUNT = "count: how many of them the object has, on all sides together (two flaps on each wing are 4); 0 if you cannot tell."


@dataclass(frozen=True, eq=False)
class Recognize:
    """What is the object, how large is the real one, where is its front, which parts move and how?

    azimuths: of the pictures [deg]; counted: also asks how many parts of each kind there are, and whether it is a machine.
    """

    pictures: Pictures
    category: str | None = None  # if the user gave it
    azimuths: tuple[float, ...] = ()
    kind: str = "recognize"
    counted: bool = True

    def text(self) -> str:
        hint = f" The user says that it is: {self.category!r}." if self.category else ""
        count = (
            f" {COUNT} machine: true for an aircraft, ship, vehicle, robot, crane or other machine with many moving parts; "
            "close-ups of its regions are then shown next."
        )
        return (
            f"The pictures show one rigid 3D model of an object from several sides.{hint} It is to become an articulated model "
            "for a robot simulator. Name the category, estimate the length in metres of the longest side of such an object in "
            "reality, and list every kind of part that moves against the rest in the real thing: doors, lids, drawers, knobs, "
            "buttons, wheels, levers, handles that turn (not handles fixed to a door), and so on. Give one entry a kind, not "
            f"one a piece; leave out what does not move. {KIND} front: the number of the picture that looks most squarely at "
            "the object's front, the side that a user faces; 0 if it has none."
            f"{self._inside}{count if self.counted else ''}"
        )

    @property
    def _inside(self) -> str:
        """Return the text on the pictures of the inside, which come last."""
        outside = len(self.azimuths)
        if not 0 < outside < len(self.pictures):
            return ""
        return (
            f" Pictures 1..{outside} show it from outside; those after them show what is hidden inside, the rest as a ghost: "
            "list what moves in there too (drawers, trays, shelves that slide, turntables), but leave out what is fixed."
        )

    def schema(self) -> dict[str, Any]:
        machine = {"machine": BOOLEAN} if self.counted else {}
        return an_answer(
            category=STRING, longest_side_m=NUMBER, front=INTEGER, **machine, parts=a_list(_kind_schema(counted=self.counted))
        )

    def parse(self, answer: Mapping[str, Any]) -> Recognition:
        size = float(answer["longest_side_m"])
        if not SIZES[0] <= size <= SIZES[1]:
            raise BadAnswerError(f"longest_side_m must lie in {SIZES[0]}..{SIZES[1]}, found {size:g}")
        if not 0 <= answer["front"] <= len(self.azimuths):
            raise BadAnswerError(
                f"front must be the number of a picture, 1..{len(self.azimuths)}, or 0; found {answer['front']}"
            )
        front = self.azimuths[answer["front"] - 1] if answer["front"] else None
        parts = parse_kinds(answer["parts"])
        category = " ".join(answer["category"].split())[:60]
        if not category or not (category.isascii() and category.isprintable()):
            raise BadAnswerError(f"category must be one or a few English words, found {category!r}")
        return Recognition(category, size, parts, front, answer.get("machine", False))


@dataclass(frozen=True, eq=False)
class RecognizeRegions:
    """Which kinds of part of a machine move, region by region? Several pictures show each region in close-up.

    regions: of the pictures, from 1; known: kinds of part that the whole object showed.
    """

    pictures: Pictures
    regions: tuple[int, ...]
    known: tuple[RecognizedLabel, ...]
    category: str | None = None
    kind: str = "regions"

    def text(self) -> str:
        known = "; ".join(f"{r.label} ({r.count or 'how many is not known'})" for r in self.known) or "none"
        return with_category(
            self.category,
            f"The pictures show it in close-up, region by region, 1..{max(self.regions)}, each from two sides; things of the "
            "other regions may be in a picture too. The kinds of part that move found so far, by pictures of the whole: "
            f"{known}. Look at every region on its own, also at what is small, flush with the surface or retracted (flaps, "
            "rudders, hatches, doors of wheel wells, wheels, struts, hooks, antennas, wipers, levers, ramps). regions: each "
            "region once, with the labels of all kinds that move in it, found before or new. parts: the new kinds, one entry "
            "each, and those found before whose entry must change, with the right one; leave out the others and what does not "
            f"move. withdrawn: labels found before of which there is no such part, or none that moves. {KIND} {COUNT}",
        )

    def schema(self) -> dict[str, Any]:
        region = an_object(region=INTEGER, labels=a_list(STRING))
        return an_answer(regions=a_list(region), parts=a_list(_kind_schema(counted=True)), withdrawn=a_list(STRING))

    def parse(self, answer: Mapping[str, Any]) -> tuple[RecognizedLabel, ...]:
        """Return all kinds of part: those found before and not withdrawn, as changed, and the new ones."""
        one_each([r["region"] for r in answer["regions"]], max(self.regions), "region")
        kinds = parse_kinds(answer["parts"], self._kept({folded(label) for label in answer.get("withdrawn", ())}))
        seen = {folded(label) for r in answer["regions"] for label in r["labels"]}
        if lacking := sorted(seen - {r.label for r in kinds}):
            raise BadAnswerError(f"parts must have an entry for each new kind in regions; missing {lacking[:10]}")
        return kinds

    def _kept(self, withdrawn: set[str]) -> list[RecognizedLabel]:
        """Return the kinds found before that stay; what is mounted on others is mounted on what these are mounted on."""
        over = {r.label: r.parent for r in self.known}
        if unknown := sorted(withdrawn - over.keys()):
            raise BadAnswerError(f"withdrawn must be of {list(over)}, found {unknown[:10]}")
        kept = [r for r in self.known if r.label not in withdrawn]
        for k, r in enumerate(kept):
            parent = r.parent
            while parent in withdrawn:
                parent = BASE if over[parent] == parent else over[parent]
            kept[k] = replace(r, parent=parent)
        return kept


def _kind_schema(*, counted: bool) -> dict[str, Any]:
    """Return the schema of a kind of part."""
    count = {"count": INTEGER} if counted else {}
    return an_object(label=STRING, moves=one_of(MOVING), parent=STRING, lower=NUMBER, upper=NUMBER, **count)


def parse_kinds(parts: Sequence[Mapping[str, Any]], known: Sequence[RecognizedLabel] = ()) -> tuple[RecognizedLabel, ...]:
    """Return the answered kinds of part after those known before, which they replace if their label is the same."""
    named = [{**p, "label": folded(p["label"]), "parent": folded(p["parent"])} for p in parts]
    new = check_labels([p["label"] for p in named])
    labels = check_labels([*dict.fromkeys((*(r.label for r in known), *new))])
    kinds = {r.label: r for r in known} | {p["label"]: _label(p, labels) for p in named}
    _check_tree({r.label: r.parent or BASE for r in kinds.values()})
    return tuple(kinds.values())


def _label(part: Mapping[str, Any], labels: Sequence[str]) -> RecognizedLabel:
    if part["parent"] not in (*labels, BASE):
        raise BadAnswerError(f"parent must be {BASE!r} or one of {list(labels)}, found {part['parent'][:40]!r}")
    moves, count = JointType(part["moves"]), part.get("count", 0)
    lower, upper = float(part["lower"]), float(part["upper"])
    if not 0 <= count <= MAX_COUNT:
        raise BadAnswerError(f"{part['label']}: count must lie in 0..{MAX_COUNT}, found {count}")
    if moves is JointType.CONTINUOUS:
        if lower or upper:
            fits = "continuous has 0 and 0; what has limits is revolute"
            raise BadAnswerError(f"{part['label']}: {fits}; found {lower:g}, {upper:g}")
        return RecognizedLabel(part["label"], moves, part["parent"], None, count or None)
    unit, most = (3.141592653589793 / 180, 360.0) if moves is JointType.REVOLUTE else (0.01, 100 * SIZES[1])
    if not (-most <= lower <= 0 <= upper <= most and lower < upper):
        raise BadAnswerError(f"{part['label']}: valid is lower <= 0 <= upper, not both 0; found {lower:g}, {upper:g}")
    return RecognizedLabel(part["label"], moves, part["parent"], (lower * unit, upper * unit), count or None)


def check_labels(labels: Sequence[str]) -> tuple[str, ...]:
    """Return the labels, if each is a plain English noun and none occurs twice. Raise BadAnswerError otherwise."""
    for label in labels:
        if not WORD.fullmatch(label) or label == BASE:
            raise BadAnswerError(f"a label is a short English noun in lower case and not {BASE!r}, found {label[:40]!r}")
    if len(set(labels)) != len(labels) or len(labels) > MAX_LABELS:
        raise BadAnswerError(f"each label once and at most {MAX_LABELS} of them, found {len(labels)}: {list(labels)[:30]}")
    return tuple(labels)


def folded(label: str) -> str:
    """Return a label in lower case, with single spaces."""
    return " ".join(label.lower().split())


def _check_tree(parent: Mapping[str, str]) -> None:
    """Raise BadAnswerError unless the parents lead to the base; a part may depend on another one with the same label."""
    for label in parent:
        seen, at = set[str](), label
        while at != BASE and parent[at] != at:  # a label that is its own parent is a chain of such parts
            if at in seen:
                raise BadAnswerError(f"parents must lead to {BASE!r}, but those of {label!r} form a cycle")
            seen.add(at)
            at = parent[at]


def parse_labels(labels: Sequence[str]) -> tuple[str, ...]:
    """Return the labels given by a user. Raise OptionError if they are not valid."""
    try:
        return check_labels([folded(label) for label in labels])
    except BadAnswerError as error:
        raise OptionError(f"--parts-list: {error}") from None


def ask_recognition(
    pictures: Callable[[], tuple[Picture, ...]],
    answerer: VisualAnswerer,
    category: str | None,
    labels: Sequence[str],
    azimuths: Sequence[float] = (),
) -> Recognition:
    """Ask what the object is, unless the labels were given.

    azimuths: of the pictures [deg].
    """
    if labels:
        return Recognition(category or "object", None, tuple(RecognizedLabel(label, None, None, None) for label in labels))
    return answerer.ask(Recognize(DrawnPictures(pictures), category, tuple(azimuths)))


def in_size_of(recognition: Recognition, size: float) -> Recognition:
    """Return the recognition with its slides as far as the mesh is larger or smaller than the object that was answered.

    Answered centimetres are those of an object of the answered length. size: longest side that the mesh has [m].
    """
    factor = size / (recognition.size or size)
    if 1 / ROUGH <= factor <= ROUGH:
        return recognition
    labels = (
        replace(r, limits=(r.limits[0] * factor, r.limits[1] * factor)) if r.moves is JointType.PRISMATIC and r.limits else r
        for r in recognition.labels
    )
    return replace(recognition, labels=tuple(labels))


def answered_scale(
    recognition: Recognition, size: float, *, kept: str = "", measured: bool = False
) -> tuple[float, str, tuple[str, ...]]:
    """Return the scale factor from an answered size, with a note on what became of the answer, and warnings.

    size: longest side of the mesh [m]; kept: what is kept against the answer, in words, such as the unit of the file, "" for
    nothing; measured: the answer may be a measure rather than a guess.
    """
    if recognition.size is None:
        return 1.0, "", ()
    factor = recognition.size / size
    basis = f"answered: a {recognition.category} is about {recognition.size:g} m long; the mesh was {size:.3g} m"
    to_use, near = f"to use the answer, give --scale {recognition.size:g}:longest", EXACT if measured and not kept else ROUGH
    if 1 / EXACT <= factor <= EXACT or (kept == GIVEN and 1 / near <= factor <= near):
        return 1.0, "", ()
    if 1 / near <= factor <= near:
        return 1.0, f"size kept ({basis}); {to_use}", ()
    if kept:
        slides = any(label.moves is JointType.PRISMATIC for label in recognition.labels)
        return 1.0, "", (f"{kept} was kept ({basis}){', and slides fit it' if slides else ''}; {to_use}",)
    note = f"scale {factor:g} ({basis})"
    return factor, note, () if 1 / FAR <= factor <= FAR else (f"{note}; if that is wrong, give --scale",)
