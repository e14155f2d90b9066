"""Candidate poses of the robot's base before an object."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.plans import BasePose

DISTANCES = (0.55, 0.45, 0.65, 0.38, 0.75)  # [m] from the middle of the tool's path, the most promising first
ANGLES = np.deg2rad([0, 25, -25, 50, -50, 80, -80, 110, -110])  # about the part, relative to its front
USUAL_REACH = 1.0  # [m] reach of the arm for which `DISTANCES` are stated
HEIGHTS = (0.35, 0.5)  # [m] of the part above the base, for bases that are not on the ground


def base_poses(middle: Float[np.ndarray, " 3"], outwards: Float[np.ndarray, " 3"], reach: float) -> list[BasePose]:
    """Return base poses around the tool's path, each facing it, the most promising first.

    middle: of the tool's path [m]; outwards: direction from which the tool comes; reach: of the arm [m].
    """
    flat = outwards[:2] if np.linalg.norm(outwards[:2]) > 0.2 else np.array([0.0, -1.0])  # objects face -y
    front = float(np.arctan2(flat[1], flat[0]))
    heights = [0.0] + [z for h in HEIGHTS if abs(z := round(float(middle[2]) - h, 2)) > 0.05 and z > -0.6]
    candidates: list[tuple[float, BasePose]] = []
    for level, z in enumerate(heights):
        rise = float(middle[2]) - z - 0.3  # approximate height of an arm's shoulder above its base
        for far, distance in enumerate(DISTANCES):
            if np.hypot(distance * reach / USUAL_REACH, rise) > reach:
                continue
            for side, turn in enumerate(ANGLES):
                angle = front + turn
                x, y = middle[:2] + distance * reach / USUAL_REACH * np.array([np.cos(angle), np.sin(angle)])
                yaw = float(np.arctan2(middle[1] - y, middle[0] - x))
                pose = BasePose(round(float(x), 3), round(float(y), 3), z, round(yaw, 4))
                candidates.append((far + 0.7 * side + 2 * level, pose))
    return [pose for _, pose in sorted(candidates, key=lambda f: f[0])]
