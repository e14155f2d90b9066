"""STAGE B (paper, 3.3) with someone who sees: kinds of joint, candidate points and arrows, then motions to choose from.

All parts are asked about together, so that an object takes one call a kind of question.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from anymesh.articulation.candidates import cluster_points, superpoint_centres, with_more
from anymesh.articulation.cases import Case, ask_each, make_cases
from anymesh.articulation.decode import hinge, slide, surface_directions
from anymesh.articulation.estimate import joint_of
from anymesh.articulation.evidence import weigh_all
from anymesh.articulation.limits import answered_range
from anymesh.articulation.verify import Choice, choose, is_free, words
from anymesh.config import Config
from anymesh.geometry.pieces import ObjectShape
from anymesh.progress import Progress, silent
from anymesh.reasoning.asking import Seer
from anymesh.reasoning.geometry import turns_freely
from anymesh.reasoning.prompting import ArrowTable, JointKind, PointTable, WhichArrows, WhichKinds, WhichPoints
from anymesh.rendering.studio import Studio
from anymesh.types import Joint, JointType, Motion, MotionKind, Segmentation
from anymesh.types.recognition import Recognition

GUIDED = 0.4  # share of the ways sideways in which what slides out is held


def prompt_joints(
    studio: Studio,
    whole: ObjectShape,
    segmentation: Segmentation,
    seer: Seer,
    config: Config,
    *,
    recognition: Recognition | None = None,
    verify: bool = True,
    progress: Progress = silent,
) -> tuple[Joint, ...]:
    """One joint for every part but the root, in the order of the parts. verify: choose among free motions at the end."""
    cases = make_cases(whole, segmentation, recognition, config)
    labels = segmentation.face_part
    progress("joints", "kinds", 0, 4)
    kinds = ask_each(
        seer,
        cases,
        lambda c, title: studio.card(labels, c.number, title),
        lambda p, some: WhichKinds(p, tuple(c.shown for c in some)),
    )
    cases = [replace(c, answer=kinds[c.number]) for c in cases]
    progress("joints", "points and arrows", 1, 4)
    asked = {**_hinges(cases, whole, studio, labels, seer, config), **_surface_slides(cases, studio, labels, seer)}
    asked |= {c.number: way_out(c) for c in cases if c.kind is JointKind.SLIDE_OUT}
    cases = [replace(c, asked=asked.get(c.number)) for c in cases]
    progress("joints", "motions", 2, 4)
    chosen = choose(cases, studio, labels, seer, config.prompts.motions) if verify else {c.number: _taken(c) for c in cases}
    progress("joints", "limits", 3, 4)
    return tuple(_joint(c, chosen[c.number], verify) for c in cases)


def _hinges(
    cases: list[Case], whole: ObjectShape, studio: Studio, labels: np.ndarray, seer: Seer, config: Config
) -> dict[int, Motion]:
    """Hinges, by part number: points are clustered, shown, picked, and their line taken."""
    turning = [c for c in cases if c.kind.turns]
    shots = {c.number: studio.shot(labels, c.number) for c in turning}
    tables = {}
    for case in turning:
        project = shots[case.number].project
        points = cluster_points(case.shown.contact, project, config.prompts)
        if case.kind is JointKind.HINGE_HIDDEN:
            samples = case.around.part.samples
            colors = studio.face_colors[whole.source[samples.faces]]
            points = with_more(points, superpoint_centres(samples, colors, config.grounding), project, config.prompts)
        tables[case.number] = PointTable(case.shown, points, case.kind)
    picks = ask_each(
        seer,
        turning,
        lambda c, title: shots[c.number].with_points(tables[c.number].points, title),
        lambda p, some: WhichPoints(p, tuple(tables[c.number] for c in some)),
    )
    return {c.number: hinge(tables[c.number].points[list(picks[c.number])], c.shown.normal) for c in turning}


def _surface_slides(cases: list[Case], studio: Studio, labels: np.ndarray, seer: Seer) -> dict[int, Motion]:
    """Slides along the surface, by part number: arrows in its plane are shown, and one is picked."""
    sliding = [c for c in cases if c.kind is JointKind.SLIDE_ALONG]
    tables = {c.number: ArrowTable(c.shown, surface_directions(c.around)) for c in sliding}
    rows = ask_each(
        seer,
        sliding,
        lambda c, title: studio.arrows(labels, c.number, title, c.around.part.box.center, tables[c.number].directions),
        lambda p, some: WhichArrows(p, tuple(tables[c.number] for c in some)),
    )
    return {c.number: slide(tables[c.number].directions[rows[c.number]], c.around, "arrow picked") for c in sliding}


def way_out(case: Case) -> Motion:
    """In and outward: the plane's normal where the part is free and held along it, else the way out that is held best.

    On real drawers the connecting area is rim and sides, and its plane's normal alone may be off by 80 degrees and more.
    """
    around, normal = case.around, case.shown.normal
    outward = around.outward
    normal = normal if normal @ outward >= 0 else -normal
    directions = [s * a for a in around.core.axes for s in (1.0, -1.0) if s * a @ outward > 0.5] + [outward]
    ways = [slide(normal, around, "normal of the connecting area's plane")]
    ways += [slide(d, around, "free way out") for d in directions]
    found = weigh_all(around, [("asked", way) for way in ways])
    if is_free(found[0]) and found[0].outward > 0.7 and found[0].guided > GUIDED:
        return ways[0]
    return ways[max(range(1, len(ways)), key=lambda k: (found[k].guided, found[k].opening, -k))]


def _taken(case: Case) -> Choice:
    """The paper's method, pure: the answer as it is."""
    motion = case.asked or slide(case.around.outward, case.around, "nothing moves")
    best = weigh_all(case.around, [("asked", motion)])[0]
    return Choice(best, f"answered: {words(case.kind)}; {motion.source}", 0.7 if is_free(best) else 0.3)


def _joint(case: Case, choice: Choice, verify: bool) -> Joint:
    kind = JointType.FIXED
    if case.kind is not JointKind.FIXED:
        turns = choice.best.motion.kind is MotionKind.TURN
        endless = case.answer.endless and (turns_freely(choice.best) or not verify)
        kind = JointType.PRISMATIC if not turns else JointType.CONTINUOUS if endless else JointType.REVOLUTE
    answered = answered_range(case.recognized, kind)
    return joint_of(case.around, case.name, case.parent, choice.best, kind, choice.confidence, choice.reason, answered)
