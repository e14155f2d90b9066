"""Plan how a robot arm opens, pushes or turns a joint of an asset, and replay the plan (paper, 4.2: real-to-sim-to-real)."""

from typing import TYPE_CHECKING

from anymesh.entry_points import on_first_use

if TYPE_CHECKING:
    from anymesh.applications.plan.planner import plan
    from anymesh.applications.plan.plans import (
        BasePose,
        GripperContact,
        MotionPlan,
        Phase,
        PlanError,
        PlanFormat,
        Target,
        Trajectory,
        gripper_commands,
        read_plan,
        write_plan,
    )

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
__getattr__ = on_first_use(
    __name__,
    {
        **dict.fromkeys(__all__, "plans"),
        "plan": "planner",
    },
)
