"""Parts whose joints are being estimated: their labels, questions about all of them at once, and contradictory answers."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.limits import MIN_HINGE_RANGE_RAD, Range
from anymesh.articulation.part_contexts import (
    descendants,
    in_a_row,
    parents,
    part_context,
    same_size,
    share_opening_directions,
    touching_distance,
)  # fmt: skip
from anymesh.config import SAME_AXIS_COSINE, Config
from anymesh.geometry.boxes import straightening
from anymesh.geometry.surface import ObjectShape
from anymesh.geometry.triangle_set import TriangleSet
from anymesh.motion.part_context import PartContext
from anymesh.pipeline.results import PLEASE_CHECK
from anymesh.prompted.motions.lines import plane_normal, round_patches
from anymesh.prompted.pictures.visual_prompts import Facing
from anymesh.prompted.questions.prompting import JointAppearance, KindAnswer, PartFit, PartShown
from anymesh.types import Brief, Joint, JointType, Motion, Picture, Segmentation
from anymesh.types.exchange import DrawnPictures
from anymesh.types.motion import BASE, Recognition, RecognizedLabel
from anymesh.types.questions import Answer, Question, VisualAnswerer
from anymesh.vocabulary import words_of

PLANE_RATIO = 0.001  # of the diagonal: tolerance of the connecting area's plane; 0.002 for a diagonal of 2
MAX_PART_PICTURES = 16  # pictures per call
MAX_ASKED_EACH = 4  # copies that turn within limits are asked about each, as doors are, unless there are more: keys
COPY_RATIO = 0.01  # of the part's diagonal: mean distance of the surfaces of two copies, shifted onto each other
# free shares of an answered range for reversing the axis: the maximum before, and the minimum after
MAX_BLOCKED_RATIO, MIN_REVERSED_FREE_RATIO = 0.5, 0.8
TURNING = (JointType.REVOLUTE, JointType.CONTINUOUS)


@dataclass(frozen=True, eq=False)
class PartCase(Brief):
    """A part whose joint is being estimated.

    number: index in the segmentation; carried: parts that depend on it; circles: axes of its largest round patches; recognized:
    recognition of its label; answer: its kind of joint, None if it was not asked for; asked: the answered motion; pins: axes of
    round patches in contact; frame: rows are the object's axes; copies: indices of its copies beside it, which open to the same
    side; shape: indices of the parts that one answer holds for, the part among them; alone: asked about in a call of its own.
    """

    number: int
    name: str
    parent: str
    carried: tuple[int, ...]
    context: PartContext
    shown: PartShown
    circles: tuple[Motion, ...] = ()
    recognized: RecognizedLabel | None = None
    answer: KindAnswer | None = None
    asked: Motion | None = None
    pins: tuple[Motion, ...] = ()
    frame: np.ndarray | None = None
    copies: tuple[int, ...] = ()
    shape: tuple[int, ...] = ()
    alone: bool = False

    @property
    def drawn_alike(self) -> Facing | None:
        """Return the parts that are drawn from one side, this one and its copies, and their opening direction."""
        return ((self.number, *self.copies), self.context.opening_direction) if self.copies else None

    @property
    def kind(self) -> JointAppearance | None:
        return self.answer.kind if self.answer else None

    @property
    def moves(self) -> JointType | None:
        """Return how it was recognized to move."""
        return self.recognized.moves if self.recognized else None

    @property
    def endless(self) -> bool:
        """Return whether it was answered that it turns endlessly, by its kind of joint or else by what its label does."""
        return self.answer.endless if self.answer else self.moves is JointType.CONTINUOUS

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
    parent = parents_as_answered(shapes, whole.diagonal, _possible_parents(segmentation, recognized))
    contexts: dict[int, PartContext] = {}
    copies: dict[int, tuple[int, ...]] = {}
    shape: dict[int, tuple[int, ...]] = {}
    for numbers in same_size(shapes, parent):
        some = [part_context(whole, label, shapes, parent, i) for i in numbers]
        contexts |= zip(numbers, share_opening_directions(some), strict=True)
        copies |= {i: tuple(k for k in numbers if k != i and _are_alike(contexts[i], contexts[k])) for i in numbers}
        shape |= _asked_once(numbers, shapes, [p.label for p in segmentation.parts], recognized)
    shape = _mirror_images(shapes, [(p.label, over) for p, over in zip(segmentation.parts, parent, strict=True)]) | shape
    frame = straightening(whole.shape.normals, whole.shape.areas)[:3, :3]
    cases = []
    for i, part in enumerate(segmentation.parts[1:], start=1):
        context = contexts[i]
        contact = context.contact
        shown = PartShown(
            label=part.label,
            faces=segmentation.faces(i),
            points=context.part.samples.points,
            outward=context.opening_direction,
            normal=plane_normal(contact, PLANE_RATIO * whole.diagonal, config.seed),
            contact=contact,
            diagonal=whole.diagonal,
        )
        carried = tuple(descendants(parent, i))
        circles, pins = round_patches(whole, shapes[i], shapes[parent[i]])
        over, told = segmentation.parts[parent[i]].name, recognized.get(part.label)
        cases.append(
            PartCase(
                i, part.name, over, carried, context, shown, circles, told,
                pins=pins, frame=frame, copies=copies[i], shape=shape.get(i, (i,)),
                alone=config.pictures == "few",
            )
        )  # fmt: skip
    return cases


def _asked_once(
    numbers: Sequence[int], shapes: Sequence[TriangleSet], labels: Sequence[str], recognized: Mapping[str, RecognizedLabel]
) -> dict[int, tuple[int, ...]]:
    """Return, for parts of one size, those of the same label and shape whose motions one answer names.

    Doors of one shape may turn about either side, so few of them are asked about each; drawers, wheels and keys are not.
    """
    groups: list[list[int]] = []
    for i in numbers:
        alike = [g for g in groups if labels[g[0]] == labels[i] and is_copy(shapes[g[0]], shapes[i])]
        (alike[0] if alike else groups.append([]) or groups[-1]).append(i)
    told = {i: recognized[labels[i]].moves if labels[i] in recognized else None for i in numbers}
    each = {i: told[i] in (None, JointType.REVOLUTE) for i in numbers}
    return {i: tuple(g) for g in groups if len(g) > MAX_ASKED_EACH or not each[g[0]] for i in g}


def _mirror_images(shapes: Sequence[TriangleSet], kinds: Sequence[tuple[str, int]]) -> dict[int, tuple[int, ...]]:
    """Return, for parts that are mirror images alone, such as the flaps of two wings, the parts whose motions one answer names.

    kinds: label and parent of each part.
    """
    once: dict[int, tuple[int, ...]] = {}
    for i in range(1, len(shapes)):
        rest = [k for k in range(i + 1, len(shapes)) if kinds[k] == kinds[i] and k not in once and i not in once]
        size = {k: abs(np.log(shapes[k].area / shapes[i].area)) for k in rest}
        near = [k for k in rest if size[k] < COPY_RATIO and _is_mirrored(shapes[i], shapes[k])]
        mirrored = [k for k in near if not is_copy(shapes[i], shapes[k])]
        once |= dict.fromkeys((i, *mirrored), (i, *mirrored)) if mirrored else {}
    return once


def is_copy(a: TriangleSet, b: TriangleSet) -> bool:
    """Return whether a part is another one moved along."""
    return _fits(b, a.samples.points[::4] + b.box.center - a.box.center)


def _is_mirrored(a: TriangleSet, b: TriangleSet) -> bool:
    """Return whether a part is another one mirrored, across the plane midway."""
    shift = b.box.center - a.box.center
    across = shift / max(float(np.linalg.norm(shift)), 1e-12)
    points = a.samples.points[::4] - a.box.center
    return _fits(b, points - 2 * (points @ across)[:, None] * across + b.box.center)


def _fits(shape: TriangleSet, points: Float[np.ndarray, "n 3"]) -> bool:
    """Return whether points lie on a part of this shape."""
    return float(shape.tree.distance(points).mean()) < COPY_RATIO * shape.box.diagonal


def _are_alike(a: PartContext, b: PartContext) -> bool:
    return bool(a.opening_direction @ b.opening_direction > SAME_AXIS_COSINE) and in_a_row(a, b)


def _possible_parents(segmentation: Segmentation, recognized: Mapping[str, RecognizedLabel]) -> list[set[int]]:
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


def parents_as_answered(shapes: Sequence[TriangleSet], diagonal: float, answered: Sequence[set[int]]) -> list[int]:
    """Return `parents`, with the nearest touching one of the possible parents of each part that were answered.

    answered: the indices of possible parents of each part, which may be empty.
    """
    named = _answered_parents(shapes, answered, touching_distance(shapes, diagonal))
    return _without_cycles([named.get(i, over) for i, over in enumerate(parents(shapes, diagonal))], named)


def _answered_parents(
    shapes: Sequence[TriangleSet], answered: Sequence[set[int]], reach: Float[np.ndarray, " p"]
) -> dict[int, int]:
    """Return the answered parents that touch their part, by part.

    Parts that name each other, such as the arms of a lamp, form a chain. Those that touch a part outside of it come first, then
    those that touch them. All other parts take the nearest part that they name.
    """
    parent: dict[int, int] = {}
    placed = {j for j in range(len(shapes)) if j == 0 or not answered[j]}
    while True:
        ready = {}
        for i in sorted(set(range(len(shapes))) - placed):
            chain = {j for j in answered[i] if i in answered[j]}
            if chain or answered[i] <= placed:
                nearest = _nearest(shapes[i].samples.points[::6], shapes, (answered[i] - {i}) & placed, reach[i])
                if nearest is not None or not chain:
                    ready[i] = nearest
        if not ready:
            return parent
        parent |= {i: j for i, j in ready.items() if j is not None}
        placed |= ready.keys()


def _nearest(points: np.ndarray, shapes: Sequence[TriangleSet], among: set[int], reach: float) -> int | None:
    """Return the part nearest to these points, None if none is within reach [m]."""
    off = {j: float(shapes[j].tree.distance(points).min()) for j in sorted(among)}
    best = min(off, key=lambda j: off[j], default=None)
    return best if best is not None and off[best] < reach else None


def _without_cycles(parent: list[int], answered: Collection[int]) -> list[int]:
    """Return the parents with the root as parent of one part of each circle, which is not an answered one."""
    for i in sorted(range(1, len(parent)), key=lambda i: i in answered):
        seen, at = set(), parent[i]
        while at > 0 and at != i and at not in seen:
            seen.add(at)
            at = parent[at]
        if at == i:
            parent[i] = 0
    return parent


def ask_each(
    answerer: VisualAnswerer,
    cases: Sequence[PartCase],
    picture: Callable[[PartCase, str], Picture],
    question: Callable[[DrawnPictures, Sequence[PartCase]], Question[tuple[Answer, ...]]],
) -> dict[int, Answer]:
    """Ask about all cases, MAX_PART_PICTURES per call or each alone, and return the answers by part number.

    Each case has one picture, titled with its position in the call.
    """
    answers_by_number: dict[int, Answer] = {}
    each = 1 if any(c.alone for c in cases) else MAX_PART_PICTURES
    for begin in range(0, len(cases), each):
        some = cases[begin : begin + each]
        answers = answerer.ask(question(_numbered(some, picture), some))
        answers_by_number |= {case.number: answer for case, answer in zip(some, answers, strict=True)}
    return answers_by_number


def _numbered(cases: Sequence[PartCase], picture: Callable[[PartCase, str], Picture]) -> DrawnPictures:
    return DrawnPictures(lambda: tuple(picture(case, f"part {k}: {case.label}") for k, case in enumerate(cases, 1)))


def contradictions(cases: Sequence[PartCase], joints: Sequence[Joint]) -> tuple[str, ...]:
    """Return a warning for each part whose answers (recognition, kind of joint, motion) contradict each other or its parent."""
    warnings, labels = [], {case.name: case.label for case in cases}
    for case, joint in zip(cases, joints, strict=True):
        over = case.recognized.parent if case.recognized else None
        if over not in (None, case.label, labels.get(case.parent, BASE)):
            why = f"it touches no {over}" if over in (BASE, *labels.values()) else f"no {over} was found"
            told = f"it was answered to be mounted on the {over}"
            warnings.append(f"joint {joint.name}: {told}, but {why}; it is on {case.parent}{PLEASE_CHECK}")
        answered = list(_answered_motion(case))
        kinds = {kind for kind, _ in answered}
        if len(kinds | {_motion(joint.type)}) > 1:
            answers = ", then ".join(words for _, words in answered)
            why = (
                f"the answers contradict each other ({answers})" if len(kinds) > 1 else f"it was answered to move so: {answers}"
            )
            warnings.append(f"joint {joint.name}: {why}; it became {joint.type}{PLEASE_CHECK}")
    return tuple(warnings)


def unchanged(wrong: Mapping[str, PartFit], before: Segmentation, after: Segmentation) -> tuple[str, ...]:
    """Return a warning for each part, by name, that was called too much or too little and has the same faces after that."""
    return tuple(
        f"part {name}: its region was called {fit.words}, but its marks stayed{PLEASE_CHECK}"
        for name, fit in wrong.items()
        if np.array_equal(before.face_part == before.numbers[name], after.face_part == before.numbers[name])
    )


def _answered_motion(case: PartCase) -> Iterator[tuple[str, str]]:
    if case.moves is not None:
        yield ("slides" if case.moves is JointType.PRISMATIC else "turns"), f"recognized as {case.moves}"
    kind = case.kind
    if kind is not None:
        yield "fixed" if kind is JointAppearance.FIXED else "turns" if kind.is_rotation else "slides", kind.words


def _motion(kind: JointType) -> str:
    return "turns" if kind in TURNING else "slides" if kind is JointType.PRISMATIC else "fixed"


def labels_by_name(segmentation: Segmentation, labels: Sequence[str]) -> Segmentation:
    """Give each part with an unrecognized label the recognized label that its name ends with ("rudder_left": rudder).

    Names are only compared here and never shown to an answerer. Of several labels, the one whose last word comes last in the
    name is used.
    """
    new_label = {}
    for number, part in enumerate(segmentation.parts[1:], start=1):
        if part.label not in labels:
            name = words_of(part.name)
            places = {label: _last_place(name, words_of(label)) for label in labels}
            best = max(places, key=lambda label: (places[label], len(label)), default=None)
            if best is not None and places[best] >= 0:
                new_label[number] = best
    return relabelled(segmentation, new_label, labels)


def relabelled(segmentation: Segmentation, answered: Mapping[int, str], labels: Sequence[str]) -> Segmentation:
    """Give parts, by number, the answered label if their own was not recognized. Return the same object if no label changes."""
    if not any(segmentation.parts[k].label not in labels for k in answered):
        return segmentation
    parts = [
        replace(part, label=answered[k]) if k in answered and part.label not in labels else part
        for k, part in enumerate(segmentation.parts)
    ]
    return replace(segmentation, parts=tuple(parts))


def unlabelled(segmentation: Segmentation, labels: Sequence[str]) -> bool:
    """Return whether labels were recognized and some part has none of them."""
    return bool(labels) and any(part.label not in labels for part in segmentation.parts[1:])


def _last_place(name: Sequence[str], label: Sequence[str]) -> int:
    """Return the index in a name of the last word of a label, -1 if not all of its words occur."""
    if not label or not set(label) <= set(name):
        return -1
    return len(name) - 1 - list(reversed(name)).index(label[-1])


def answered_range(recognized: RecognizedLabel | None, kind: JointType) -> Range | None:
    """Return the answered range [rad or m] for a joint of this type, None if there is none or it is unusable."""
    if recognized is None or recognized.limits is None:
        return None
    lower, upper = recognized.limits
    if kind is JointType.REVOLUTE and recognized.moves is JointType.REVOLUTE:
        return recognized.limits if upper - lower >= MIN_HINGE_RANGE_RAD else None
    if kind is JointType.PRISMATIC and recognized.moves is JointType.PRISMATIC:
        return recognized.limits if upper > lower else None
    return None


def opening_as_answered(c: Candidate, answered: Range | None) -> Candidate:
    """Return the candidate with the opening direction that fits an answered range [rad].

    A lid modelled open closes further than it opens (-105..20 deg). The direction suggested by geometry is reversed only in
    this case, and only if the sweep leaves more of the range free with the axis reversed.
    """
    if answered is None or -answered[0] <= answered[1] or c.motion.kind is JointType.PRISMATIC:
        return c
    lower, upper = -answered[0], answered[1]
    kept, other = min(upper, c.opening) + min(lower, c.closing), min(upper, c.closing) + min(lower, c.opening)
    if kept > MAX_BLOCKED_RATIO * (lower + upper) or other < MIN_REVERSED_FREE_RATIO * (lower + upper):
        return c
    return c.reversed()
