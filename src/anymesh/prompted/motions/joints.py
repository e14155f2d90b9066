"""Stage B (paper, 3.3) with a visual answerer: kinds of joint, candidate points and arrows, then motions to choose from.

All parts are asked about together, so that an object takes one call per kind of question.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from anymesh.articulation.candidate_motions import Candidate
from anymesh.articulation.estimate import joint_of
from anymesh.articulation.limits import (
    FINE_STEPS,
    away_from_closed,
    free_within,
    pressed,
)
from anymesh.articulation.vetting import faults
from anymesh.config import ALONG_COSINE, Config
from anymesh.geometry.surface import ObjectShape
from anymesh.pipeline.results import PLEASE_CHECK
from anymesh.prompted.motions.cases import (
    TURNING,
    PartCase,
    answered_range,
    ask_each,
    contradictions,
    labels_by_name,
    make_cases,
    opening_as_answered,
    relabelled,
    unchanged,
    unlabelled,
)
from anymesh.prompted.motions.coupling import coupled
from anymesh.prompted.motions.lines import (
    MAX_POINTS,
    axis_points,
    cluster_points,
    followed,
    hinge,
    hinge_candidates,
    pivots,
    prismatic,
    superpoint_centres,
    surface_directions,
    with_more,
)
from anymesh.prompted.motions.offers import lines_of_copies, normal_outwards, opening_slide
from anymesh.prompted.motions.verify import (
    BLOCKED_RATIO,
    Choice,
    MotionQuestioner,
    as_answered,
    ask_motions,
)
from anymesh.prompted.pictures.sides import Sides
from anymesh.prompted.pictures.visual_prompts import Shot, VisualPrompts
from anymesh.prompted.questions.prompting import (
    ArrowTable,
    JointAppearance,
    PartFit,
    PointTable,
    WhichArrows,
    WhichKinds,
    WhichPoints,
)
from anymesh.runtime import Progress, silent
from anymesh.types import Joint, JointType, Motion, Segmentation
from anymesh.types.motion import Recognition, RecognizedLabel
from anymesh.types.questions import VisualAnswerer

MIN_KEPT = 0.9  # share of an answered range that is free; less gets a warning. Answers are round numbers
ON_AXIS_RATIO = 0.02  # of the part's diagonal: two points so near to the axis of a pin replace its ends, if they are
MIN_APART_RATIO = 0.2  # of the part's diagonal apart; both are estimates
INTO_POINTS = 8  # candidates for an axis into the surface, half of which stand for axes


ShapeOf = Callable[[Segmentation], ObjectShape]
Reground = Callable[[Mapping[str, PartFit]], Segmentation | None]  # parts by name that have too much or too little surface


@dataclass(frozen=True, eq=False)
class PromptedJoints:
    """One joint for every part but the root, in the order of the parts.

    segmentation: with the answered labels, and the parts as grounded again; warnings: contradictions between answers; doubts:
    what tests of the joints found, by the child's name.
    """

    joints: tuple[Joint, ...]
    segmentation: Segmentation
    warnings: tuple[str, ...] = ()
    doubts: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Questions:
    """Settings of the questions about the joints of one object.

    recognition: of the object, None without one.
    """

    visual_prompts: VisualPrompts
    answerer: VisualAnswerer
    config: Config
    recognition: Recognition | None = None
    progress: Progress = silent

    @property
    def category(self) -> str:
        """Return the category of the object."""
        return self.recognition.category if self.recognition else self.config.category or "object"

    @property
    def labels(self) -> tuple[str, ...]:
        """Return the recognized part labels."""
        return tuple(r.label for r in self.recognition.labels) if self.recognition else ()


@dataclass(frozen=True, eq=False)
class _ChosenMotions:
    """Parts that were asked about, with the motion chosen for each by number.

    leads: as in `coupling.coupled`.
    """

    cases: list[PartCase]
    chosen: dict[int, Choice]
    segmentation: Segmentation
    leads: Mapping[int, int] = field(default_factory=dict)

    def wrong(self) -> dict[str, PartFit]:
        """Return the parts, by name, that answers call too much or too little."""
        fits = {c.name: self.chosen[c.number].fit for c in self.cases}
        return {name: fit for name, fit in fits.items() if fit is not PartFit.RIGHT}

    def with_changed(self, later: _ChosenMotions) -> _ChosenMotions:
        """Return these results updated with those of parts that were asked about again, by number."""
        cases = {c.number: c for c in (*self.cases, *later.cases)}
        some = [cases[c.number] for c in self.cases]
        return _ChosenMotions(some, {**self.chosen, **later.chosen}, later.segmentation, self.leads)


def prompt_joints(
    questions: Questions, shape_of: ShapeOf, segmentation: Segmentation, reground: Reground | None = None
) -> PromptedJoints:
    """Ask how each part moves and build its joint, by the method in `config.verify`.

    The methods are: off, the paper's method; free, which also replaces motions that are blocked; motion, which shows motions to
    choose from.

    shape_of: prepares the object for these parts; reground: grounds parts again, once, that the answers call too much or too
    little, with the same names in the same order. Only these parts are asked about again. None keeps the parts.
    """
    chosen_motions = _ask(questions, shape_of, labels_by_name(segmentation, questions.labels), fits=reground is not None)
    wrong, before = chosen_motions.wrong(), chosen_motions.segmentation
    again = reground(wrong) if reground is not None and wrong else None
    if again is not None:
        chosen_motions = chosen_motions.with_changed(_ask(questions, shape_of, again, fits=False, only=set(wrong)))
    questions.progress("joints", "limits", 3, 4)
    verify = questions.config.verify
    made = [_joint(c, chosen_motions.chosen[c.number], verify) for c in chosen_motions.cases]
    joints = tuple(joint for joint, _ in made)
    follow, led = coupled({c.number: c.shape or (c.number,) for c in chosen_motions.cases}, joints, chosen_motions.leads)
    doubts = faults({c.name: c.context for c in chosen_motions.cases}, joints)
    kept = unchanged(wrong, before, again or before)
    warnings = (*contradictions(chosen_motions.cases, joints), *kept, *(told for _, some in made for told in some), *led)
    return PromptedJoints(follow, chosen_motions.segmentation, warnings, doubts)


def _ask(
    questions: Questions, shape_of: ShapeOf, segmentation: Segmentation, *, fits: bool, only: Collection[str] | None = None
) -> _ChosenMotions:
    """Ask about the parts.

    fits: also ask whether the region shown is the part; only: names of parts, None for all.
    """
    whole, config, progress = shape_of(segmentation), questions.config, questions.progress
    cases = [c for c in make_cases(whole, segmentation, questions.recognition, config) if only is None or c.name in only]
    progress("joints", "kinds", 0, 4)
    if config.verify == "motion":
        return _ask_motions(questions, cases, whole, segmentation, fits=fits)
    cases, segmentation = _with_kinds(questions, cases, whole, segmentation)
    progress("joints", "points and arrows", 1, 4)
    cases = _with_lines(questions, cases, whole, segmentation)
    return _ChosenMotions(cases, {c.number: as_answered(c, config.probed) for c in cases}, segmentation)


def _ask_motions(
    questions: Questions, cases: list[PartCase], whole: ObjectShape, segmentation: Segmentation, *, fits: bool
) -> _ChosenMotions:
    """Ask for kinds of joint and motions together, then for the lines of parts with none of the motions shown."""
    choices = questions.labels if unlabelled(segmentation, questions.labels) else ()
    labels, config = segmentation.face_part, questions.config
    sides = Sides(questions.recognition.front if questions.recognition else None)
    asking = MotionQuestioner(
        questions.visual_prompts, labels, questions.answerer, questions.category, fits, sides, choices, config.ask == "all"
    )
    asked = ask_motions(cases, asking, config)
    questions.progress("joints", "motions", 1, 4)
    told = {n: a.offers.case.answer for n, a in asked.answers.items()}
    named = {n: answer.label for n, answer in told.items() if answer is not None and answer.label is not None}
    if named:
        segmentation = relabelled(segmentation, named, questions.labels)
        made = {c.number: c for c in make_cases(whole, segmentation, questions.recognition, config)}
        asked = asked.renewed([replace(made[n], answer=told[n]) for n in told], config.seed)
    questions.progress("joints", "points and arrows", 2, 4)
    lines = [c for c in _with_lines(questions, asked.lost(), whole, segmentation) if c.asked is not None]
    others = {n: a.offers.case for n, a in asked.answers.items() if n not in asked.picks}
    asked = asked.renewed([*lines, *lines_of_copies(lines, others)], config.seed)
    leads = {n: pick.leader for n, pick in asked.picks.items() if pick.leader is not None}
    return _ChosenMotions([asked.answers[c.number].offers.case for c in cases], asked.chosen(), segmentation, leads)


def _with_lines(questions: Questions, cases: list[PartCase], whole: ObjectShape, segmentation: Segmentation) -> list[PartCase]:
    """Return the cases with the motions that picked points, arrows and the way out stand for."""
    asked = {**_hinges(questions, cases, whole, segmentation), **_surface_directions(questions, cases, segmentation)}
    out = normal_outwards if questions.config.verify == "off" else opening_slide
    asked |= {c.number: out(c) for c in cases if c.kind is JointAppearance.SLIDE_OUT}
    return [replace(c, asked=asked.get(c.number)) for c in cases]


def _with_kinds(
    questions: Questions, cases: list[PartCase], whole: ObjectShape, segmentation: Segmentation
) -> tuple[list[PartCase], Segmentation]:
    """Ask for the kind of joint of each part and, if its label was not recognized, which recognized label it has."""
    pictures, labels = questions.visual_prompts, segmentation.face_part
    choices = questions.labels if unlabelled(segmentation, questions.labels) else ()
    kinds = ask_each(
        questions.answerer,
        cases,
        lambda c, title: pictures.card(labels, c.number, title, c.shown.contact, c.drawn_alike),
        lambda p, some: WhichKinds(p, tuple(c.shown for c in some), choices, questions.category),
    )
    answered = {n: a.label for n, a in kinds.items() if a.label is not None}
    if answered:
        segmentation = relabelled(segmentation, answered, questions.labels)
        numbers = {c.number for c in cases}
        cases = [c for c in make_cases(whole, segmentation, questions.recognition, questions.config) if c.number in numbers]
    return [replace(c, answer=kinds[c.number]) for c in cases], segmentation


def _hinges(questions: Questions, cases: list[PartCase], whole: ObjectShape, segmentation: Segmentation) -> dict[int, Motion]:
    """Return the hinges by part number: points are shown and picked, and give a line."""
    labels, pictures = segmentation.face_part, questions.visual_prompts
    turning = [c for c in cases if c.kind is not None and c.kind.is_rotation]
    paper = questions.config.verify == "off"
    candidates = {c.number: None if paper else hinge_candidates(c.context, c.pins) for c in turning}
    shots = {c.number: pictures.shot(labels, c.number, c.drawn_alike, candidates[c.number]) for c in turning}
    tables = {c.number: _points(questions, c, shots[c.number], whole) for c in turning}
    picks = ask_each(
        questions.answerer,
        turning,
        lambda c, title: shots[c.number].with_points(tables[c.number].points, title),
        lambda p, some: WhichPoints(
            p,
            tuple(tables[c.number] for c in some),
            questions.category,
            two_views=any(len(shots[c.number].views) > 1 for c in some),
        ),
    )
    hinges = {}
    for case in turning:
        table, rows = tables[case.number], list(picks[case.number])
        axis = None if table.axes is None else table.axes[rows[0]]
        hinges[case.number] = hinge(table.points[rows], case.shown.normal, axis)
    return hinges


def _points(questions: Questions, case: PartCase, shot: Shot, whole: ObjectShape) -> PointTable:
    """Return the candidate points of a rotating part; the paper's method has clusters and superpoints only."""
    assert case.kind is not None  # asked for before
    config, pictures = questions.config, questions.visual_prompts
    shaped = case.kind is JointAppearance.HINGE_INTO and config.verify != "off"
    project, most = shot.project, INTO_POINTS if shaped else MAX_POINTS
    points = shot.inside(cluster_points(case.shown.contact, project, most))
    axes, entering, outline = np.zeros((0, 3)), [], case.context.outline
    middle = Motion(JointType.REVOLUTE, outline.axis, outline.center, "axis of its round outline")
    own = [middle] if case.context.is_round else []
    if shaped:
        motions = [m for _, m in pivots(case.context, case.shown.normal, case.frame)]
        entering = [*case.circles, *own, *motions]
    if case.kind is JointAppearance.HINGE_HIDDEN:
        samples = case.context.part.samples
        colors = pictures.face_colors[whole.source[samples.faces]]
        points = with_more(points, shot.inside(superpoint_centres(samples, colors)), project, most)
    size = case.context.part.box.diagonal
    on_axis = [(m, points[m.distance(points) <= ON_AXIS_RATIO * size] @ m.axis) for m in case.pins]
    pins = [m for m, along in on_axis if len(along) < 2 or np.ptp(along) < MIN_APART_RATIO * size]
    inwards = [shaped and abs(float(m.axis @ case.context.opening_direction)) >= ALONG_COSINE for m in (*own, *pins)]
    ends = [(m, 1 if one else 2) for m, one in zip((*own, *pins), inwards, strict=True)]
    if config.verify != "off" and (entering or ends):
        first, axes = axis_points(case.context, entering, project, most, ends)
        inside = shot.is_inside(first)
        axes = axes[inside] if shaped else axes[:0]
        points = followed(first[inside], points, project, most) if inside.any() else points
    if len(axes):
        axes = np.concatenate([axes, np.full((len(points) - len(axes), 3), np.nan)])
    return PointTable(case.shown, points, case.kind, axes if len(axes) else None, shot.hidden(points))


def _surface_directions(questions: Questions, cases: list[PartCase], segmentation: Segmentation) -> dict[int, Motion]:
    """Return the slides along the surface by part number: arrows in its plane are shown, and one is picked."""
    pictures, labels = questions.visual_prompts, segmentation.face_part
    sliding = [c for c in cases if c.kind is JointAppearance.SLIDE_ALONG]
    tables = {c.number: ArrowTable(c.shown, surface_directions(c.context)) for c in sliding}
    rows = ask_each(
        questions.answerer,
        sliding,
        lambda c, title: pictures.arrows(
            labels, c.number, title, c.context.part.box.center, tables[c.number].directions, c.drawn_alike
        ),
        lambda p, some: WhichArrows(p, tuple(tables[c.number] for c in some), questions.category),
    )
    return {c.number: prismatic(tables[c.number].directions[rows[c.number]], c.context, "arrow picked") for c in sliding}


def _joint(case: PartCase, choice: Choice, verify: str) -> tuple[Joint, tuple[str, ...]]:
    """Return the joint of a part, and a warning for each answer that it does not keep."""
    kind, twice = JointType.FIXED, False
    if choice.moves:
        turns = choice.best.motion.kind is JointType.REVOLUTE
        twice = case.answer is not None and case.endless and case.moves is JointType.CONTINUOUS
        endless = case.endless and (twice or verify != "motion" or choice.best.is_endless)
        kind = JointType.PRISMATIC if not turns else JointType.CONTINUOUS if endless else JointType.REVOLUTE
    answered = answered_range(case.recognized, kind)
    best = away_from_closed(case.context, choice.best) if answered is None else opening_as_answered(choice.best, answered)
    joint = joint_of(case.context, case.name, case.parent, best, kind, choice.confidence, choice.reason, answered)
    if answered is None:
        ranged = _unused(kind, case.recognized)
    else:
        joint, ranged = _as_answered(case, best, joint, answered)
    told = (choice.warning, _endless_words(case, best, kind, twice=twice), ranged)
    return joint, tuple(f"joint {joint.name}: {words}{PLEASE_CHECK}" for words in told if words)


def _endless_words(case: PartCase, best: Candidate, kind: JointType, *, twice: bool) -> str:
    """Return in words what became of the answer that a part turns endlessly, if another or geometry is against it, else ""."""
    recognized = case.moves is JointType.CONTINUOUS
    if best.is_endless or kind not in TURNING:
        return (
            "endless was recognized, but a joint with limits was answered" if recognized and kind is JointType.REVOLUTE else ""
        )
    stop = f"geometry stops it after {np.degrees(best.closing):.0f} degrees back and {np.degrees(best.opening):.0f} ahead"
    if kind is JointType.CONTINUOUS:
        return f"endless was answered twice and is kept, though {stop}" if twice else ""
    return f"endless was answered, but {stop}" if recognized or case.endless else ""


def _unused(kind: JointType, recognized: RecognizedLabel | None) -> str:
    """Return in words that a joint does not have an answered range, else "".

    Other kinds contradict the answer, which has a warning of its own.
    """
    if recognized is None or recognized.limits is None or recognized.moves is None:
        return ""
    endless = kind is JointType.CONTINUOUS and recognized.moves is JointType.REVOLUTE
    if not endless and kind is not recognized.moves:
        return ""
    why = "is not used, it turns endlessly" if endless else "is no range"
    return f"the answer {_range_words(recognized.moves, recognized.limits)} {why}"


def _as_answered(case: PartCase, best: Candidate, joint: Joint, answered: tuple[float, float]) -> tuple[Joint, str]:
    """Return the joint with less confidence if less than the answered range is free, and both in words."""
    written = joint.limits or answered
    asked, told = answered[1] - answered[0], _range_words(joint.type, answered)
    if written[1] - written[0] < MIN_KEPT * asked:
        share, end = (written[1] - written[0]) / asked, f"{_range_words(joint.type, written)} is free and was written"
    elif pressed(best, answered):
        return joint, ""
    else:
        share = sum(free_within(case.context, best, -answered[0], answered[1], 2 * FINE_STEPS)) / asked
        end = "it was kept, though geometry blocks it"
    if share >= MIN_KEPT:
        return joint, ""
    confidence = joint.confidence * max(share, BLOCKED_RATIO if best.is_free else 1.0)
    return replace(joint, confidence=confidence), f"{told} was answered, {end}"


def _range_words(kind: JointType, limits: tuple[float, float]) -> str:
    factor, unit = (100.0, "cm") if kind is JointType.PRISMATIC else (180 / np.pi, "degrees")
    return f"{factor * limits[0]:.3g} to {factor * limits[1]:.3g} {unit}"
