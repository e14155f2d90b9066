"""Robots of an environment by name."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.applications.policy.arms_ import arm_robot
from anymesh.applications.policy.hands_ import floating_gripper, floating_shadow
from anymesh.applications.policy.robot import TaskRobot
from anymesh.errors import OptionError

HANDS = {"gripper": floating_gripper, "shadow": floating_shadow}
ARMS = ("panda", "ur5e")
NAMES = (*HANDS, *ARMS)


def make_robot(name: str, R_world_tool: Float[np.ndarray, "3 3"]) -> TaskRobot:
    """Return a robot by name. R_world_tool: orientation of a floating hand at the start.

    Raise OptionError for an unknown name, MissingExtraError if its files are not installed.
    """
    if name in HANDS:
        return HANDS[name](R_world_tool)
    if name in ARMS:
        return arm_robot(name)
    raise OptionError(f"--robot: found {name!r}; valid are {', '.join(NAMES)}")
