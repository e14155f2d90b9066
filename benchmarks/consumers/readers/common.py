"""What all readers share: the asset that they are given, and the record that they write. Needs numpy alone.

A reader runs as `python READER.py VARIANT ASSET RECORD [ASSET RECORD ...]` in the consumer's own interpreter. It loads the
files of each ASSET (a folder with asset.json) as a user would, and writes what the consumer then holds to RECORD, as JSON:

version: of the consumer. said: its warnings and errors. joints: name -> `type`, `parent`, `child`, `limits` (null: none),
`effort`, `velocity`, `damping`, `friction`, `armature`, `stiffness` and `reference` of a spring, and either `moved` (4x4,
what moving the joint alone by `amount` does to its child) or `axis` and `origin`. links: name -> `mass`, `center`, `inertia`
(3x3 about the center), `place` (of its frame), `box` (corners of what is drawn). faults: of a validator. Lengths and
directions are in the asset frame at rest [m, kg, rad]; a key that is left out is one that the consumer does not hold.
"""

from __future__ import annotations

import json
import sys
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

TARGETS = {  # files of the folders for a project, which end in the name where it is not given
    "robosuite": "model.xml", "robocasa": "model.xml", "maniskill": "mobility_cvx.urdf", "genesis": ".xml", "isaaclab": ".usdc",
}  # fmt: skip
TURN, SLIDE = 0.1, 0.01  # [rad], [m]: what joints without limits are moved by


@dataclass(frozen=True)
class Asset:
    """A written asset."""

    folder: Path
    content: dict  # of asset.json

    def file(self, kind: str) -> Path:
        """Return the file to open for a format or target; "simready" is that of the SimReady profile."""
        name = self.content["name"]
        if kind in TARGETS:
            return self.folder / kind / name / (name * TARGETS[kind].startswith(".") + TARGETS[kind])
        if kind == "simready":
            return self.folder / kind / name / "simready_usd" / f"{name}.usda"
        return self.folder / self.content["files"][kind]

    def enabled(self, engine: str, place: Path) -> Path:
        """Write a file to `place` that opens what the SimReady profile wrote with the variant of an engine."""
        name, whole = self.content["name"], self.file("simready").resolve()
        path = place / f"{self.folder.name}.usda"  # OpenUSD does not read a file again that was written anew
        head = f'#usda 1.0\n(\n    subLayers = [@{whole}@]\n    defaultPrim = "{name}"\n)'
        path.write_text(f'{head}\nover "{name}" (variants = {{ string {engine} = "Enabled" }}) {{}}\n', encoding="utf-8")
        return path

    @property
    def root(self) -> str:
        """Name of the root link, whose frame is the asset frame."""
        return next(p["name"] for p in self.content["parts"] if p["parent"] is None)

    @property
    def joints(self) -> dict[str, dict]:
        return {j["name"]: j for j in self.content["joints"]}

    def amount(self, joint: str) -> float:
        """Return a position within the limits of a joint [rad or m], small and not 0."""
        said = self.joints[joint]
        if said["limits"] is None:
            return TURN if said["type"] != "prismatic" else SLIDE
        lower, upper = said["limits"]
        return 0.2 * (upper if upper >= -lower else lower)


def frame(place: object = (0, 0, 0), turn: object = None) -> np.ndarray:
    """Return a 4x4 of a place and of a rotation (3x3)."""
    T = np.eye(4)
    T[:3, 3] = np.asarray(place, float).reshape(3)
    if turn is not None:
        T[:3, :3] = np.asarray(turn, float).reshape(3, 3)
    return T


def turn_of(x: float, y: float, z: float, w: float) -> np.ndarray:
    """Return the 3x3 of a quaternion."""
    x, y, z, w = np.array([x, y, z, w], float) / np.linalg.norm([x, y, z, w])
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def placed(T: np.ndarray, mass: float, center: object, tensor: object, turn: object = None) -> dict:
    """Return the record of a link's mass. T: of the link, in the asset frame; tensor: 3x3 or diagonal, in turned axes."""
    I = np.asarray(tensor, float)  # noqa: E741
    I = np.diag(I) if I.size == 3 else I.reshape(3, 3)  # noqa: E741
    R = T[:3, :3] @ (np.eye(3) if turn is None else np.asarray(turn, float))
    at = T[:3, :3] @ np.asarray(center, float).reshape(3) + T[:3, 3]
    return {"mass": float(mass), "center": at.tolist(), "inertia": (R @ I @ R.T).tolist()}


def motion(rest: np.ndarray, moved: np.ndarray, amount: float) -> dict:
    """Return the record of what a joint did to its child, from the child's pose before and after."""
    return {"moved": (moved @ np.linalg.inv(rest)).tolist(), "amount": float(amount)}


def swept(parent: np.ndarray, poses: list[np.ndarray], slides: bool, axis: object) -> dict:
    """Return the record of an animated joint: its motion at the largest excursion, and the limits that the animation reaches.

    parent: pose of the parent at rest; poses: of the child in the parent, the first at rest; axis: tells which way is positive,
    which is not in an animation. A joint that passes a whole turn is continuous.
    """
    moves = [parent @ pose @ np.linalg.inv(poses[0]) @ np.linalg.inv(parent) for pose in poses]
    if slides:
        shifts = np.array([T[:3, 3] for T in moves])
        way = shifts[np.argmax((shifts**2).sum(1))]
        amounts = shifts @ way / max(np.linalg.norm(way), 1e-12)
    else:
        steps = [np.linalg.inv(a) @ b for a, b in pairwise(moves)]
        turns = np.array([[T[2, 1] - T[1, 2], T[0, 2] - T[2, 0], T[1, 0] - T[0, 1]] for T in steps]) / 2
        way = turns[np.argmax((turns**2).sum(1))]
        cosines = [(np.trace(T[:3, :3]) - 1) / 2 for T in steps]
        angles = np.arctan2(turns @ way / max(np.linalg.norm(way), 1e-12), cosines)
        amounts = np.concatenate([[0.0], np.cumsum(angles)])
    amounts = amounts if way @ np.asarray(axis, float) > 0 else -amounts
    far = np.abs(amounts)
    best = int(np.argmax(np.where(far < 3, far, 0)))  # of a turn, less than half
    endless = not slides and amounts.max() - amounts.min() > 2 * np.pi - 0.1
    limits = None if endless else [amounts.min(), amounts.max()]
    return {"moved": moves[best].tolist(), "amount": amounts[best], "limits": limits}


def finite(lower: float, upper: float, most: float = 1e6) -> list[float] | None:
    """Return limits, None if they are infinite or so wide that they mean none."""
    return [float(lower), float(upper)] if max(abs(lower), abs(upper)) < most and lower <= upper else None


def plain(value: object) -> object:
    """Return numbers of numpy as those of Python."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, list | tuple):
        return [plain(v) for v in value]
    if isinstance(value, np.ndarray):
        return value.tolist()
    return value.item() if isinstance(value, np.generic) else value


def serve(read: Callable[[Asset, str], dict]) -> None:
    """Read each asset that the command line names, and write its record; an error is a record too."""
    variant, *rest = sys.argv[1:]
    for folder, record in zip(rest[::2], rest[1::2], strict=True):
        begin = time.perf_counter()
        asset = Asset(Path(folder), json.loads((Path(folder) / "asset.json").read_text(encoding="utf-8")))
        try:
            content = read(asset, variant)
        except Exception as error:  # consumers raise all kinds
            traceback.print_exc()
            content = {"error": f"{type(error).__name__}: {error}"}
        content["seconds"] = round(time.perf_counter() - begin, 2)
        fresh = Path(record).with_suffix(".part")
        fresh.write_text(json.dumps(plain(content)), encoding="utf-8")
        fresh.rename(record)
