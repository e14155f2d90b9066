"""Parts whose joints are being estimated, and questions about all of them at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from anymesh.articulation.part_contexts import part_context
from anymesh.articulation.repeated_parts import same_size, share_opening_directions
from anymesh.articulation.tree import descendants, parents
from anymesh.config import Config
from anymesh.geometry.patches import ObjectShape
from anymesh.motion.part_context import PartContext
from anymesh.prompted.motions.decode import plane_normal
from anymesh.prompted.motions.own_axes import round_patches
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer, PartShown
from anymesh.types import Motion, Picture, Segmentation
from anymesh.types.exchange import DrawnPictures
from anymesh.types.motion import BASE, Recognition, RecognizedLabel
from anymesh.types.questions import Answer, Question, VisualAnswerer

MAX_PART_PICTURES = 8  # pictures per call


@dataclass(frozen=True, eq=False)
class PartCase:
    """A part whose joint is being estimated.

    number: index in the segmentation; carried: parts that depend on it; circles: axes of round patches; recognized:
    recognition of its label; asked: the answered motion.
    """

    number: int
    name: str
    parent: str
    carried: tuple[int, ...]
    context: PartContext
    shown: PartShown
    circles: tuple[Motion, ...] = ()
    recognized: RecognizedLabel | None = None
    answer: KindAnswer = KindAnswer(JointAppearance.FIXED)  # noqa: RUF009 - frozen
    asked: Motion | None = None

    @property
    def kind(self) -> JointAppearance:
        return self.answer.kind

    @property
    def label(self) -> str:
        return self.shown.label


def make_cases(
    whole: ObjectShape, segmentation: Segmentation, recognition: Recognition | None, config: Config
) -> list[PartCase]:
    """Make a case for every part but the root, in the order of the parts."""
    label = segmentation.face_part[whole.source]
    shapes = [whole.of(np.flatnonzero(label == i)) for i in range(len(segmentation.parts))]
    recognized = {r.label: r for r in recognition.labels} if recognition else {}
    parent = parents(shapes, whole.diagonal, _answered_parents(segmentation, recognized))
    contexts = {}
    for numbers in same_size(shapes, parent):
        some = [part_context(whole, label, shapes, parent, i, config.articulation) for i in numbers]
        contexts |= zip(numbers, share_opening_directions(some), strict=True)
    cases = []
    for i, part in enumerate(segmentation.parts[1:], start=1):
        context = contexts[i]
        contact = context.contact
        shown = PartShown(
            label=part.label,
            faces=segmentation.faces(i),
            points=context.part.samples.points,
            outward=context.opening_direction,
            normal=plane_normal(contact, config.prompts.plane * whole.diagonal, config.seed),
            contact=contact,
            diagonal=whole.diagonal,
        )
        carried = tuple(descendants(parent, i))
        circles = round_patches(whole, shapes[i], shapes[parent[i]])
        cases.append(
            PartCase(
                i, part.name, segmentation.parts[parent[i]].name, carried, context, shown, circles, recognized.get(part.label)
            )
        )
    return cases


def _answered_parents(segmentation: Segmentation, recognized: Mapping[str, RecognizedLabel]) -> list[set[int]]:
    """Return the indices of possible parents of each part according to the answers; empty without an answer.

    A label that names itself as parent marks a chain: such parts depend on each other, and the first of them on any other part.
    """
    numbers = range(len(segmentation.parts))
    possible_parents: list[set[int]] = []
    for i, part in enumerate(segmentation.parts):
        over = recognized[part.label].parent if part.label in recognized else None
        if over == BASE:
            possible_parents.append({0})
        elif over == part.label:
            possible_parents.append(set(numbers) - {i})
        else:
            possible_parents.append({j for j in numbers if j > 0 and segmentation.parts[j].label == over})
    return possible_parents


def ask_each(
    answerer: VisualAnswerer,
    cases: Sequence[PartCase],
    picture: Callable[[PartCase, str], Picture],
    question: Callable[[DrawnPictures, Sequence[PartCase]], Question[tuple[Answer, ...]]],
) -> dict[int, Answer]:
    """Ask about all cases, MAX_PART_PICTURES per call, and return the answers by part number.

    Each case has one picture, titled with its position in the call.
    """
    answers_by_number: dict[int, Answer] = {}
    for begin in range(0, len(cases), MAX_PART_PICTURES):
        some = cases[begin : begin + MAX_PART_PICTURES]
        answers = answerer.ask(question(_numbered(some, picture), some))
        answers_by_number |= {case.number: answer for case, answer in zip(some, answers, strict=True)}
    return answers_by_number


def _numbered(cases: Sequence[PartCase], picture: Callable[[PartCase, str], Picture]) -> DrawnPictures:
    return DrawnPictures(lambda: tuple(picture(case, f"part {k}: {case.label}") for k, case in enumerate(cases, 1)))
