"""Where a robot may stand before an object."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.plans import BasePose

DISTANCES = (0.55, 0.45, 0.65, 0.38, 0.75)  # [m] from the part's middle, the most useful first
ANGLES = np.deg2rad([0, 25, -25, 50, -50, 80, -80, 110, -110])  # about the part, from its front
USUAL_REACH = 1.0  # [m] for which the distances are
HEIGHTS = (0.35, 0.5)  # [m] of the part above the base, where the ground is too low or too high


def base_poses(middle: Float[np.ndarray, " 3"], outwards: Float[np.ndarray, " 3"], reach: float) -> list[BasePose]:
    """Return poses round the place where the part is worked on, each turned towards it; the most promising first.

    middle: of the tool's path [m]; outwards: from where the tool comes; reach: of the arm [m].
    """
    flat = outwards[:2] if np.linalg.norm(outwards[:2]) > 0.2 else np.array([0.0, -1.0])  # objects face -y
    front = float(np.arctan2(flat[1], flat[0]))
    heights = [0.0] + [z for h in HEIGHTS if abs(z := round(float(middle[2]) - h, 2)) > 0.05 and z > -0.6]
    found: list[tuple[float, BasePose]] = []
    for level, z in enumerate(heights):
        rise = float(middle[2]) - z - 0.3  # an arm's shoulder is about so high
        for far, distance in enumerate(DISTANCES):
            if np.hypot(distance * reach / USUAL_REACH, rise) > reach:
                continue
            for side, turn in enumerate(ANGLES):
                angle = front + turn
                x, y = middle[:2] + distance * reach / USUAL_REACH * np.array([np.cos(angle), np.sin(angle)])
                yaw = float(np.arctan2(middle[1] - y, middle[0] - x))
                pose = BasePose(round(float(x), 3), round(float(y), 3), z, round(yaw, 4))
                found.append((far + 0.7 * side + 2 * level, pose))
    return [pose for _, pose in sorted(found, key=lambda f: f[0])]
