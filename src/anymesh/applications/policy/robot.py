"""Description of a robot of an environment."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float

SLIDERS, HINGES = ("move_x", "move_y", "move_z"), ("turn_z", "turn_y", "turn_x")  # servos of a floating hand
LIMIT = 10.0  # [m] or [rad] of commands whose servo has no range


@dataclass(frozen=True, eq=False)
class TaskRobot:
    """Robot as a MuJoCo spec, with its tool and the meaning of an action.

    tool: site, z along the approach and y along the closing direction; fingers: bodies of each finger; floating: whether six
    servos move the hand in the world frame; servos: actuators of each dimension of an action; rate: change of their command
    per step, 0 where an action sets the command between low and high; positions: values of joints at the start.
    """

    name: str
    spec: Any
    tool: str
    fingers: tuple[tuple[str, ...], ...]
    floating: bool
    servos: tuple[tuple[str, ...], ...]
    rate: Float[np.ndarray, " a"]
    low: Float[np.ndarray, " a"]
    high: Float[np.ndarray, " a"]
    positions: tuple[tuple[str, float], ...] = ()
