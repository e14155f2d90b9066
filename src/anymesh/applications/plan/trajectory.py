"""Conversion of a route to a trajectory: motions timed within the limits, with gripper commands between them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from jaxtyping import Float

from anymesh.applications.plan.approach_ import straight_is_free
from anymesh.applications.plan.attempt import Route
from anymesh.applications.plan.plans import GripperContact, Phase, Trajectory
from anymesh.applications.plan.robot_ import RobotArm
from anymesh.applications.plan.timing import STEP, Curve, Timed, stand, time_curve

CLOSING, HOLDING, OPENING = 1.0, 0.8, 0.8  # [s] pauses of the arm while the fingers move, and at the end of the part's motion
TOUCHING = 0.4  # share of the speed for the motion to the part and along its joint
SLOWEST = 1.5  # [s] shortest duration of the part's motion
DENSE = 0.02  # [rad] between the points used to round corners
ROUNDINGS = (0.8, 0.4, 0.2, 0.1)  # [rad] length of the path over which a corner is rounded, tried in this order
KNOTS = 0.08  # [rad] between the postures that define a curve
Valid = Callable[[Float[np.ndarray, " J"]], bool]
Piece = tuple[Phase, Timed, float, np.ndarray]  # with the fingers' gap and the joint's values


def build_trajectory(route: Route, robot: RobotArm, speed: float, free: Valid) -> Trajectory:
    """Sample every 10 ms from home to beside the part, with each joint below `speed` times its limits.

    free: whether a posture on the approach is collision-free, used to check rounded corners.
    """
    velocity, push = robot.velocity * speed, robot.acceleration * speed
    slow = (velocity * TOUCHING, push * TOUCHING)
    held = route.values[-1]
    grasped, opened = route.target.contact is GripperContact.GRASP, route.open_gap
    none = np.zeros(1)
    pieces: list[Piece] = [(Phase.APPROACH, timed, opened, none) for timed in rounded(route.approach, velocity, push, free)]
    pieces.append((Phase.REACH, time_curve(Curve(route.reach), *slow), opened, none))
    if grasped:
        pieces.append((Phase.CLOSE, stand(route.move[0], CLOSING), 0.0, none))
    share = np.linspace(0, 1, len(route.move))
    moved = time_curve(Curve(route.move, share), *slow, least=SLOWEST)
    pieces.append((Phase.MOVE, moved, 0.0, np.interp(moved.share, share, route.values)))
    pieces.append((Phase.HOLD, stand(route.move[-1], HOLDING), 0.0, np.array([held])))
    if grasped:
        pieces.append((Phase.OPEN, stand(route.move[-1], OPENING), opened, np.array([held])))
    if len(route.retreat) > 1:
        pieces.append((Phase.RETREAT, time_curve(Curve(route.retreat), *slow), opened, np.array([held])))
    return _joined(pieces, robot.joints)


def rounded(path: Float[np.ndarray, "k J"], velocity: np.ndarray, push: np.ndarray, free: Valid) -> list[Timed]:
    """Return one motion along a path with rounded corners if that is collision-free, else motions that stop at each corner."""
    if len(path) > 2:
        dense = _dense(path)
        for width in ROUNDINGS:
            curve = Curve(_smoothed(dense, width))
            checked = curve.at(np.linspace(0, 1, 4 * len(dense)))
            if all(free(posture) for posture in checked):
                return [time_curve(curve, velocity, push)]
    return [time_curve(Curve(path[k : k + 2]), velocity, push) for k in range(len(path) - 1)]


def _dense(path: np.ndarray) -> Float[np.ndarray, "n J"]:
    """Return points about `DENSE` apart along a path of straight segments."""
    length = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
    count = max(2, int(np.ceil(length[-1] / DENSE)) + 1)
    at = np.linspace(0, length[-1], count)
    return np.stack([np.interp(at, length, column) for column in path.T], 1)


def _smoothed(dense: Float[np.ndarray, "n J"], width: float) -> Float[np.ndarray, "m J"]:
    """Return the moving average over a window that narrows towards the ends, which stay fixed; thinned to knots."""
    count, half = len(dense), max(1, round(width / DENSE / 2))
    sums = np.concatenate([np.zeros((1, dense.shape[1])), np.cumsum(dense, 0)])
    k = np.arange(count)
    reach = np.minimum(np.minimum(k, count - 1 - k), half)
    mean = (sums[k + reach + 1] - sums[k - reach]) / (2 * reach + 1)[:, None]
    knots = np.unique(np.round(np.linspace(0, count - 1, max(3, round(count * DENSE / KNOTS)))).astype(int))
    return mean[knots]


def _joined(pieces: Sequence[Piece], joints: tuple[str, ...]) -> Trajectory:
    """Concatenate motions to one trajectory; samples at rest where two motions meet are kept once."""
    columns: dict[str, list[np.ndarray]] = {k: [] for k in ("time", "position", "velocity", "acceleration", "gap", "value")}
    phases: list[Phase] = []
    end = 0.0
    for number, (phase, timed, gap, values) in enumerate(pieces):
        first = 0 if number == 0 else 1
        count = len(timed.time)
        rows = slice(first, None)
        columns["time"].append(timed.time[rows] + end)
        for name in ("position", "velocity", "acceleration"):
            columns[name].append(getattr(timed, name)[rows])
        columns["gap"].append(np.full(count - first, gap))
        columns["value"].append(np.broadcast_to(values, count)[rows] if len(values) == 1 else values[rows])
        phases += [phase] * (count - first)
        end += timed.time[-1]
    whole = {name: np.concatenate(rows) for name, rows in columns.items()}
    whole["time"] = np.arange(len(whole["time"])) * STEP
    return Trajectory(joints, phase=tuple(phases), **whole)


__all__ = ["build_trajectory", "rounded", "straight_is_free"]
