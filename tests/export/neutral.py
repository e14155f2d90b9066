"""What the readers of all formats return: bodies, joints and poses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

Poses = Callable[[dict[str, float]], dict[str, np.ndarray]]  # joint positions -> link frames in the asset frame
KINDS = {"revolute": "turn", "continuous": "turn", "prismatic": "slide", "fixed": "none"}


@dataclass
class Body:
    """mass, center in the link frame, tensor about it along the link frame's axes; collision: supports in the link frame."""

    mass: float
    center: np.ndarray
    tensor: np.ndarray
    supports: list[Callable[[np.ndarray], float]] = field(default_factory=list)


@dataclass
class Read:
    """Content of a file. joints: name -> values; absent keys are those that the format cannot express."""

    joints: dict[str, dict]
    bodies: dict[str, Body]
    poses: Poses
    fixed: bool | None


def frame(place=(0, 0, 0), rotation=np.eye(3)) -> np.ndarray:  # noqa: B008 - not changed
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation, place
    return T


def motion(kind: str, axis: np.ndarray, q: float) -> np.ndarray:
    if kind == "slide":
        return frame(np.asarray(axis) * q)
    return frame(rotation=Rotation.from_rotvec(np.asarray(axis) * q).as_matrix()) if kind == "turn" else np.eye(4)


def cloud(points: np.ndarray) -> Callable[[np.ndarray], float]:
    return lambda d: float((points @ d).max())


def box(T: np.ndarray, size: np.ndarray) -> Callable[[np.ndarray], float]:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * np.asarray(size) / 2
    return cloud(corners @ T[:3, :3].T + T[:3, 3])


def cylinder(T: np.ndarray, radius: float, length: float) -> Callable[[np.ndarray], float]:
    def support(d: np.ndarray) -> float:
        along = float(d @ T[:3, 2])
        return float(d @ T[:3, 3]) + abs(along) * length / 2 + radius * np.sqrt(max(0.0, 1 - along**2))

    return support


def obj_points(path: Path) -> np.ndarray:
    return np.array([line.split()[1:4] for line in path.read_text().splitlines() if line.startswith("v ")], float)


def chain(joints: dict[str, dict], root: str, local: Callable[[dict, float], np.ndarray]) -> Poses:
    """Return poses down a tree of joints; `local` maps parent frame to child frame at a position."""

    def poses(positions: dict[str, float]) -> dict[str, np.ndarray]:
        found, waiting = {root: np.eye(4)}, dict(joints)
        while waiting:
            for name, j in list(waiting.items()):
                if j["parent"] in found:
                    found[j["child"]] = found[j["parent"]] @ local(j, positions.get(name, 0.0))
                    del waiting[name]
        return found

    return poses
