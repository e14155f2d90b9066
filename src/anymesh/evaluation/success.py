"""When a joint counts as a success, as others have published it. What is missing is no success.

Turning joints are alike whether they turn endlessly or not. Lengths of a score are in units of half the object's diagonal.
"""

from __future__ import annotations

from anymesh.evaluation.score import JointScore, ObjectScore
from anymesh.types import JointType

AA_ANGLE, AA_ORIGIN = 14.3239, 0.05  # .25 rad [deg], and 50 mm where the diagonal is 2 m
OPD_ANGLE, OPD_ORIGIN = 10.0, 0.25  # [deg], share of the object's diagonal
S2O_ANGLE, S2O_ORIGIN = 5.0, 0.1  # [deg], share of the part's diagonal
DIAGONAL = 2.0  # of the object, in units of half of it


def articulate_anything(joint: JointScore) -> bool:
    """Articulate-Anything (Le et al., ICLR 2025, arXiv 2410.13882): the right type, axis within .25 rad, origin within .05.

    The origin of a turning joint is off by the distance of the two axes; a slide's does not count. They measure in the units
    of PartNet-Mobility, whose objects fill a sphere of radius 1, so the diagonal is about 2 as it is here, and call .05 50 mm.
    Their code takes the mean of this and of the angle between the joints' frames, which a mesh does not tell, and lets a
    turning range differ by up to 1.6 rad; as in ArticulateArena (arXiv 2609.33931), neither counts here.
    """
    return joint.type_right and _within(joint.angle, AA_ANGLE) and _line(joint, joint.line_distance, AA_ORIGIN)


def opd(joint: JointScore) -> bool:
    """OPD (Jiang et al., ECCV 2022, arXiv 2203.16421), their "+MAO": type, axis within 10 degrees, and where it turns, origin
    within .25 of the object's diagonal of the true axis.

    They match parts by 2D masks with an IoU of .5; here the IoU is that of the parts' surfaces.
    """
    return joint.type_right and _within(joint.angle, OPD_ANGLE) and _line(joint, joint.origin, OPD_ORIGIN * DIAGONAL)


def s2o(joint: JointScore) -> bool:
    """S2O (Iliash et al., WACV 2026, arXiv 2409.18896), their "MAO": type, axis within 5 degrees, and where it turns, origin
    within .1 of the part's diagonal of the true axis, at IoU .5.

    Their IoU is of the parts' axis-aligned boxes; here it is that of their surfaces.
    """
    return joint.type_right and _within(joint.angle, S2O_ANGLE) and _line(joint, joint.origin, S2O_ORIGIN * joint.part_size)


def motion_anymesh(score: ObjectScore) -> bool | None:
    """MotionAnymesh (arXiv 2603.12936), physical executability: every joint of the object, driven through its full range in a
    simulator in 100 steps, neither penetrates, nor comes off, nor freezes. None where it was not tried.

    See `executability`; their simulator and tolerances are not published.
    """
    return score.executable


def _within(value: float | None, limit: float) -> bool:
    return value is not None and value <= limit


def _line(joint: JointScore, value: float | None, limit: float) -> bool:
    """A slide has no place that counts."""
    return joint.type_true is JointType.PRISMATIC or _within(value, limit)
