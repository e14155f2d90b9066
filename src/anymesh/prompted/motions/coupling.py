"""Parts that move together, as answered: the joints of some follow that of another one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from anymesh.pipeline.results import PLEASE_CHECK
from anymesh.prompted.motions.cases import MAX_PART_PICTURES
from anymesh.prompted.questions.prompting import MotionPick
from anymesh.types import MOVING, Joint, Mimic
from anymesh.types.motion import with_implied_limits


def with_leading_parts(picks: Mapping[int, MotionPick]) -> dict[int, MotionPick]:
    """Return picks by part number, in the order of the question, with the numbers of leading parts in place of their rows."""
    numbers, named = list(picks), {}
    for k, (n, pick) in enumerate(picks.items()):
        shown = numbers[k - k % MAX_PART_PICTURES :]
        named[n] = pick if pick.leader is None else replace(pick, leader=shown[pick.leader])
    return named


def coupled(
    shapes: Mapping[int, Sequence[int]], joints: Sequence[Joint], leads: Mapping[int, int]
) -> tuple[tuple[Joint, ...], tuple[str, ...]]:
    """Return the joints, with those that follow another one as answered, and warnings.

    The ratio is that of their ranges, 1 if one is endless. Of parts that are said to lead each other, the first leads.

    shapes: the parts of the shape of each part, by number, in the order of the joints; leads: number of the leading part, by
    that of a part that was asked about, for all of its shape; a part that leads itself leads the others of its shape.
    """
    of, made, warnings = {n: k for k, n in enumerate(shapes)}, list(joints), []
    for n, leader in leads.items():
        for follower in (k for k in shapes[n] if k in of and k != leader):
            one, other = made[of[follower]], made[of[leader]]
            root, by_name = other, {j.name: j for j in made}
            while root.mimic is not None:
                root = by_name[root.mimic.joint]
            if root.name == one.name or one.mimic is not None:
                continue
            if one.type not in MOVING or root.type not in MOVING:
                still = one if one.type not in MOVING else root
                told = f"it was answered to move together with {other.child}, but {still.child} does not move"
                warnings.append(f"joint {one.name}: {told}{PLEASE_CHECK}")
                continue
            spans = [0.0 if j.limits is None else j.limits[1] - j.limits[0] for j in (one, other)]
            ratio = spans[0] / spans[1] if all(spans) else 1.0
            if not all(spans):
                told = f"it moves together with {other.child}, as answered, by the same amount, since one of them has no end"
                warnings.append(f"joint {one.name}: {told}{PLEASE_CHECK}")
            reason = f"{one.reason}; answered: it moves together with {other.child}"
            made[of[follower]] = replace(one, mimic=Mimic(other.name, ratio), reason=reason)
    return with_implied_limits(made), tuple(warnings)
