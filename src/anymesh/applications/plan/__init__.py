"""Plan how a robot arm opens, pushes or turns a joint of an asset, and replay the plan (paper, 4.2: real-to-sim-to-real)."""

from anymesh.applications.plan.formats import PlanFormat, gripper_commands, read_plan, write_plan
from anymesh.applications.plan.planner import plan
from anymesh.applications.plan.plans import BasePose, GripperContact, MotionPlan, Phase, PlanError, Target, Trajectory

__all__ = [
    "BasePose",
    "GripperContact",
    "MotionPlan",
    "Phase",
    "PlanError",
    "PlanFormat",
    "Target",
    "Trajectory",
    "gripper_commands",
    "plan",
    "read_plan",
    "write_plan",
]
