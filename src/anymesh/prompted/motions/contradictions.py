"""Warnings about contradictory answers on one part."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from anymesh.prompted.motions.cases import PartCase
from anymesh.prompted.questions.prompting import JointAppearance
from anymesh.types import Joint, JointType

TURNING = (JointType.REVOLUTE, JointType.CONTINUOUS)


def contradictions(cases: Sequence[PartCase], joints: Sequence[Joint]) -> tuple[str, ...]:
    """Return a warning for each part whose answers (recognition, kind of joint, motion) contradict each other."""
    warnings = []
    for case, joint in zip(cases, joints, strict=True):
        answered = list(_answered_motion(case))
        kinds = {kind for kind, _ in answered} | {_motion(joint.type)}
        if len(kinds) > 1:
            answers = ", then ".join(words for _, words in answered)
            warnings.append(f"{case.name}: the answers contradict each other ({answers}); it became {joint.type}: please check")
    return tuple(warnings)


def _answered_motion(case: PartCase) -> Iterator[tuple[str, str]]:
    moves = case.recognized.moves if case.recognized else None
    if moves is not None:
        yield ("slides" if moves is JointType.PRISMATIC else "turns"), f"recognized as {moves}"
    kind = case.kind
    yield "fixed" if kind is JointAppearance.FIXED else "turns" if kind.is_rotation else "slides", kind.words


def _motion(kind: JointType) -> str:
    return "turns" if kind in TURNING else "slides" if kind is JointType.PRISMATIC else "fixed"
