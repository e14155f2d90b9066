"""Objects of an environment: which joint a task moves, where a hand takes hold, and how the object stands."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.asset_ import ArticulatedObject, description, open_object
from anymesh.applications.plan.robot_ import single_joints
from anymesh.applications.policy.tasks import AJAR, MAX_OPENING, MAX_TURN, JointGoal, PolicyTask, joint_goal
from anymesh.checking.engines.locate import kind_of
from anymesh.checking.engines.mujoco_ import read_spec
from anymesh.errors import InputError, OptionError
from anymesh.mujoco_ import load_mujoco
from anymesh.types import Brief, JointType, Motion
from anymesh.types.triangles import face_cross

FAR = 0.9  # share of the largest lever; surface beyond it is the free edge, whose middle is the handle point
LYING = 0.5  # largest vertical component of the axis of a lid or a bucket's handle
LEAST_LID = np.deg2rad(30)  # range of a lid between lying and upright that is needed
FALLEN = np.deg2rad(50)  # largest lean of a bucket's handle at the start; farther down, fingers pinch the wall with it
UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, eq=False)
class TaskObject(Brief):
    """An asset with the joint that a task moves.

    handle: the point to take hold of, in the asset frame at rest [m]; T_world_asset: the object on the floor z = 0 with its
    front to -y; box: (2, 3) bounds in the world frame where the joint is at the start [m], centred at x = y = 0.
    """

    thing: ArticulatedObject
    goal: JointGoal
    handle: Float[np.ndarray, " 3"]
    T_world_asset: Float[np.ndarray, "4 4"]
    box: Float[np.ndarray, "2 3"]

    @property
    def name(self) -> str:
        """Name of the asset."""
        return self.thing.name

    @property
    def points(self) -> Float[np.ndarray, "n 3"]:
        """Corners of all visible surfaces at rest, in the asset frame [m]."""
        return np.concatenate([self.thing.part_triangles, self.thing.other_triangles]).reshape(-1, 3)


def find_assets(sources: str | Path | Sequence[str | Path]) -> list[Path]:
    """Return assets: the given folders of assets, URDF and MJCF files, and all assets below a folder of several, by name.

    Raise InputError if there is none.
    """
    given = [sources] if isinstance(sources, str | Path) else list(sources)
    assets: list[Path] = []
    for path in map(Path, given):
        if not path.exists():
            raise InputError(f"{path} is not there; valid are a folder of assets, an asset, a URDF or an MJCF")
        if path.is_file() or _is_asset(path):
            assets.append(path)
        else:
            assets += sorted((p.parent for p in path.rglob("asset.json")), key=lambda p: (p.name, str(p)))
    if not assets:
        raise InputError(
            f"no asset in {', '.join(map(str, given))}: an asset is a folder with one URDF or MJCF, or such a file"
        )
    return assets


def _is_asset(folder: Path) -> bool:
    if (folder / "asset.json").is_file():
        return True
    return any(kind_of(p) is not None for p in folder.iterdir() if p.suffix.lower() in (".urdf", ".xml", ".mjcf"))


def moving_joints(path: Path) -> tuple[str, ...]:
    """Return the names of the hinges and slides of an asset. Raise InputError if it cannot be read."""
    mujoco = load_mujoco()
    file = description(path)
    try:
        model = read_spec(mujoco, file).compile()
    except (ValueError, mujoco.FatalError) as error:
        raise InputError(f"MuJoCo cannot load {file}: {' '.join(str(error).split())}") from error
    return tuple(model.joint(j).name for j in single_joints(model))


def task_object(path: str | Path, task: PolicyTask, joint: str | None = None, opening: float | None = None) -> TaskObject:
    """Read an asset and choose the joint: the given one, else that with the largest part that fits the task.

    opening: see `joint_goal`. Raise OptionError if the asset has no joint for the task.
    """
    names = moving_joints(Path(path)) if joint is None else (joint,)
    things = [open_object(path, name) for name in names]
    if task is PolicyTask.LIFT:
        things = [t for t in things if t.turns and abs(t.motion.axis[2]) < LYING]
    if not things:
        needed = "a hinge with a horizontal axis" if task is PolicyTask.LIFT else "a joint that moves"
        raise OptionError(f"{Path(path).name} has no joint for {task}: found {', '.join(names) or 'none'}, needs {needed}")
    thing = max(things, key=lambda t: float(np.linalg.norm(face_cross(t.part_triangles), axis=1).sum()))
    handle = handle_point(thing)
    if task is PolicyTask.LIFT:
        return _lifted(thing, handle)
    goal = lid_goal(task, thing, handle, opening) or joint_goal(task, thing.limits, not thing.turns, opening)
    closed = goal.start if task is PolicyTask.OPEN else goal.goal
    return TaskObject(thing, goal, handle, *_placed(thing, goal.start, _front(thing.motion, handle, closed)))


def object_at_rest(path: str | Path, joint: str, opened: tuple[tuple[str, float], ...] = ()) -> TaskObject:
    """Read an asset with a joint to move from rest to the farther end of its range, or by at most 90 degrees.

    opened: values of other joints [rad or m]. Raise OptionError if the range is empty.
    """
    thing = open_object(path, joint, opened)
    low, high = thing.limits if thing.limits is not None else (0.0, MAX_TURN)
    far = high if high >= -low else low
    goal = float(np.clip(far, -MAX_OPENING, MAX_OPENING)) if thing.turns else far
    if abs(goal) < 1e-6:
        raise OptionError(f"{joint} of {thing.name} has an empty range")
    handle = handle_point(thing)
    return TaskObject(thing, JointGoal(0.0, goal), handle, *_placed(thing, 0.0, _front(thing.motion, handle, 0.0)))


def handle_point(thing: ArticulatedObject) -> Float[np.ndarray, " 3"]:
    """Return the middle of the part's free edge at rest [m]: of the surface farthest from the axis, or outermost on a slide."""
    triangles = thing.part_triangles
    area = np.linalg.norm(face_cross(triangles), axis=1)
    weight = np.repeat(area / 3, 3) + 1e-12
    points = triangles.reshape(-1, 3)
    if thing.turns:
        lever = _lever_arms(thing.motion, points)
        height = np.linalg.norm(lever, axis=1)
        edge = height >= FAR * height.max()
    else:
        along = points @ thing.motion.axis
        edge = along >= along.max() - (1 - FAR) * max(float(np.ptp(along)), 1e-9)
    return np.average(points[edge], axis=0, weights=weight[edge])


def _lever_arms(motion: Motion, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "n 3"]:
    """Return the vectors from the axis to points, perpendicular to it."""
    offset = points - motion.origin
    return offset - (offset @ motion.axis)[:, None] * motion.axis


def apply(T: Float[np.ndarray, "4 4"], point: Float[np.ndarray, " 3"]) -> Float[np.ndarray, " 3"]:
    """Transform a point."""
    return T[:3, :3] @ point + T[:3, 3]


def lid_goal(
    task: PolicyTask, thing: ArticulatedObject, handle: Float[np.ndarray, " 3"], opening: float | None = None
) -> JointGoal | None:
    """Return start and goal of a lid, None for other parts.

    A lid turns about a horizontal axis and lies on the object at one end of its range. Its angle is measured from lying on the
    object, as DexArt does by hand, whatever the sign of the joint: the lid of a laptop that was modelled open turns both ways.
    Raise OptionError if it turns by less than `LEAST_LID`.
    """
    motion = thing.motion
    if not thing.turns or thing.limits is None or abs(motion.axis[2]) > LYING or not len(thing.other_triangles):
        return None
    across = np.cross(motion.axis, UP)
    across /= np.linalg.norm(across)
    across *= np.sign((thing.other_triangles.mean((0, 1)) - motion.origin) @ across) or 1.0
    up = np.cross(motion.axis, across)
    sign = float(np.sign(up @ UP))
    lever = _lever_arms(motion, handle[None])[0]
    rest = float(np.arctan2(sign * (lever @ up), lever @ across))
    rest += 2 * np.pi * (rest < -0.75 * np.pi)
    angles = sorted(rest + sign * limit for limit in thing.limits)
    if abs(angles[0]) > np.pi / 4:
        return None  # it does not lie on the object, as the door of an oven or a flap that hangs
    closed, opened = max(angles[0], 0.0), min(angles[1], MAX_OPENING if opening is None else opening)
    if opened - closed < LEAST_LID:
        raise OptionError(
            f"{thing.joint} of {thing.name} turns from {np.rad2deg(angles[0]):.0f} to {np.rad2deg(angles[1]):.0f} deg above "
            f"the object; a lid needs {np.rad2deg(LEAST_LID):.0f} deg up to {np.rad2deg(MAX_OPENING):.0f}"
        )
    ajar = max(closed, AJAR)
    start, goal = (ajar, opened) if task is PolicyTask.OPEN else (opened, closed)
    return JointGoal(sign * (start - rest), sign * (goal - rest))


def _front(motion: Motion, handle: np.ndarray, closed: float) -> Float[np.ndarray, " 3"]:
    """Return the horizontal direction that faces the robot: where a door or drawer opens to, or a lid's free edge is."""
    if motion.kind is JointType.PRISMATIC:
        way = motion.axis
    else:
        way = np.cross(motion.axis, apply(motion.transform(closed), handle) - motion.origin)
    flat = way * [1, 1, 0]
    if np.linalg.norm(flat) < 0.7 * np.linalg.norm(way):
        lever = _lever_arms(motion, apply(motion.transform(closed), handle)[None])[0]
        flat = lever * [1, 1, 0]
    length = float(np.linalg.norm(flat))
    return flat / length if length > 1e-9 else np.array([0.0, -1.0, 0.0])


def _placed(
    thing: ArticulatedObject, start: float, front: Float[np.ndarray, " 3"]
) -> tuple[Float[np.ndarray, "4 4"], Float[np.ndarray, "2 3"]]:
    """Return the pose in which the front faces -y and the object, with its joint at the start, is centred; and its bounds."""
    T = np.eye(4)
    c, s = -front[1], -front[0]  # turns the front to -y
    T[:2, :2] = [[c, -s], [s, c]]
    moved = thing.motion.transform(start)
    part = thing.part_triangles.reshape(-1, 3) @ moved[:3, :3].T + moved[:3, 3]
    rest = thing.other_triangles.reshape(-1, 3) if len(thing.other_triangles) else part
    points = np.concatenate([part, rest]) @ T[:3, :3].T
    low, high = points.min(0), points.max(0)
    T[:3, 3] = [*(-(low + high)[:2] / 2), -rest[:, 2].min()]
    return T, np.stack([low, high]) + T[:3, 3]


def _lifted(thing: ArticulatedObject, handle: np.ndarray) -> TaskObject:
    """Return the object with its handle fallen to the robot's side, and upright as the goal."""
    motion = thing.motion
    lever = _lever_arms(motion, handle[None])[0]
    side = np.cross(motion.axis, lever)
    upright = float(np.arctan2(side @ UP, lever @ UP))
    low, high = thing.limits if thing.limits is not None else (upright - np.pi / 2, upright + np.pi / 2)
    upright = min((upright + k * 2 * np.pi for k in (-1, 0, 1)), key=lambda v: abs(v - (low + high) / 2))
    goal = float(np.clip(upright, low, high))
    start = low if abs(low - goal) >= abs(high - goal) else high
    if abs(start - goal) < 1e-3:
        raise OptionError(f"{thing.joint} of {thing.name} has no room to fall to a side")
    start = goal + float(np.clip(start - goal, -FALLEN, FALLEN))
    fallen = apply(motion.transform(start), handle) - motion.origin
    flat = (fallen - (fallen @ motion.axis) * motion.axis) * [1, 1, 0]
    length = float(np.linalg.norm(flat))
    front = flat / length if length > 1e-6 else np.array([0.0, -1.0, 0.0])
    return TaskObject(thing, JointGoal(start, goal), handle, *_placed(thing, start, front))
