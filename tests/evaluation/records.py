"""Scores written by hand."""

from dataclasses import replace

from anymesh.evaluation.particulate_metrics import ParticulateMetrics
from anymesh.evaluation.record import Record
from anymesh.evaluation.score import JointScore, ObjectScore
from anymesh.types import JointType

DOOR = JointScore(
    "door", 0.9, JointType.REVOLUTE, JointType.REVOLUTE, angle=2.0, line_distance=0.02, at_part=0.03, displacement=0.01,
    opens_right=True, range_iou=0.8, parent_right=True, confidence=0.7, part_size=1.0, origin=0.02, found="part_1",
)  # fmt: skip
DRAWER = replace(
    DOOR, part="drawer", type_true=JointType.PRISMATIC, type_found=JointType.PRISMATIC, angle=4.0, line_distance=None,
    at_part=None, displacement=0.03, opens_right=False, range_iou=0.4, origin=None,
)  # fmt: skip
KNOB = replace(
    DOOR, part="knob", type_true=JointType.CONTINUOUS, type_found=JointType.CONTINUOUS, opens_right=None, range_iou=1.0
)
MISSING = JointScore("lid", 0.2, JointType.REVOLUTE, part_size=0.5)
ALIKE = ParticulateMetrics(0.8, 0.7, 0.01)


def record(*joints: JointScore, name: str = "cabinet", error: str = "", **more) -> Record:
    """All parts were found but those of missing joints; `more` are fields of the score or of the record."""
    found = sum(j.type_found is not None for j in joints)
    own = {k: more.pop(k) for k in ("category", "change", "seconds", "pictures") if k in more}
    told = {"predicted": found, "true": len(joints), "matched": found, "part_miou": 0.9, "tree_right": True, **more}
    return Record(ObjectScore(name, joints, **told), error=error, **own)
