"""When a joint is right, and published success criteria. Missing joints are failures.

Revolute and continuous joints are treated alike. Lengths of a score are in units of half the object's diagonal.
"""

from __future__ import annotations

from anymesh.evaluation.score import JointScore, ObjectScore
from anymesh.types import JointType

RIGHT_ANGLE, RIGHT_PLACE = 10.0, 0.1  # [deg], half the object's diagonal
AA_ANGLE, AA_ORIGIN = 14.3239, 0.05  # .25 rad [deg], and 50 mm for a diagonal of 2 m
OPD_ANGLE, OPD_ORIGIN = 10.0, 0.25  # [deg], share of the object's diagonal
S2O_ANGLE, S2O_ORIGIN = 5.0, 0.1  # [deg], share of the part's diagonal
DIAGONAL = 2.0  # of the object, in units of half of it


def right(joint: JointScore) -> bool:
    """Return whether a user need not correct a joint but for its limits.

    Right type, axis within 10 degrees and, level with the part, within .1 of half the diagonal, and it opens to the true side.
    """
    line = _line(joint, joint.at_part, RIGHT_PLACE)
    return joint.type_right and _within(joint.angle, RIGHT_ANGLE) and line and joint.opens_right is not False


def articulate_anything(joint: JointScore) -> bool:
    """Articulate-Anything (Le et al., ICLR 2025, arXiv 2410.13882): right type, axis within .25 rad, origin within .05.

    The origin error of a rotating joint is the distance of the two axes; slides have none. The authors measure in units of
    PartNet-Mobility, whose objects fill a sphere of radius 1, so the diagonal is about 2 as here, and call .05 50 mm.
    Their code averages this with the angle between the joints' frames, which a mesh does not provide, and tolerates a
    difference of rotation ranges of up to 1.6 rad; as in ArticulateArena (arXiv 2609.33931), neither is used here.
    """
    return joint.type_right and _within(joint.angle, AA_ANGLE) and _line(joint, joint.line_distance, AA_ORIGIN)


def opd(joint: JointScore) -> bool:
    """OPD (Jiang et al., ECCV 2022, arXiv 2203.16421), "+MAO": type, axis within 10 degrees, origin within .25.

    The origin counts for rotating joints: its distance from the true axis, relative to the object's diagonal.
    The authors match parts by 2D masks with an IoU of .5; here the IoU is that of the parts' surfaces.
    """
    return joint.type_right and _within(joint.angle, OPD_ANGLE) and _line(joint, joint.origin, OPD_ORIGIN * DIAGONAL)


def s2o(joint: JointScore) -> bool:
    """S2O (Iliash et al., WACV 2026, arXiv 2409.18896), "MAO": type, axis within 5 degrees, origin within .1, at IoU .5.

    The origin counts for rotating joints: its distance from the true axis, relative to the part's diagonal.
    The authors use the IoU of the parts' axis-aligned boxes; here it is that of their surfaces.
    """
    return joint.type_right and _within(joint.angle, S2O_ANGLE) and _line(joint, joint.origin, S2O_ORIGIN * joint.part_size)


def motion_anymesh(score: ObjectScore) -> bool | None:
    """MotionAnymesh (arXiv 2603.12936), physical executability of an object; None if not tested.

    Every joint is driven through its full range in a simulator in 100 steps, and must neither penetrate, nor detach, nor
    freeze. See `executability`; the authors' simulator and tolerances are not published.
    """
    return score.executable


def _within(value: float | None, limit: float) -> bool:
    return value is not None and value <= limit


def _line(joint: JointScore, value: float | None, limit: float) -> bool:
    """Return whether the origin error is within the limit; slides have none."""
    return joint.type_true is JointType.PRISMATIC or _within(value, limit)
