"""Conversion of a route to a trajectory: motions timed within the limits, with gripper commands between them.

A smooth curve through the postures is timed so that every joint stays within its limits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.interpolate import CubicSpline

from anymesh.applications.plan.approach_ import Valid
from anymesh.applications.plan.attempt import Route
from anymesh.applications.plan.plans import GripperContact, Phase, Trajectory
from anymesh.applications.plan.robot_ import RobotArm
from anymesh.types import Brief

STEP = 0.01  # [s] between samples
CHECKED = 400  # places along a curve where limits are checked; samples lie between them, hence `SHARE`
SHARE = 0.98  # of every limit that is used
MIN_DURATION_S = 0.3  # [s] shortest motion
SAME = 1e-9  # [rad] below which two postures are equal
CLOSING, HOLDING, OPENING = 1.0, 0.8, 0.8  # [s] pauses of the arm while the fingers move, and at the end of the part's motion
TOUCHING = 0.4  # share of the speed for the motion to the part and along its joint
SLOWEST = 1.5  # [s] shortest duration of the part's motion
DENSE = 0.02  # [rad] between the points used to round corners
ROUNDINGS = (0.8, 0.4, 0.2, 0.1)  # [rad] length of the path over which a corner is rounded, tried in this order
KNOTS = 0.08  # [rad] between the postures that define a curve


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


@dataclass(frozen=True, eq=False)
class Timed(Brief):
    """Samples of one motion from rest to rest.

    time: (n,) from 0 [s]; position, velocity, acceleration: (n, J); share: (n,) of the path, 0 to 1.
    """

    time: Float[np.ndarray, " n"]
    position: Float[np.ndarray, "n J"]
    velocity: Float[np.ndarray, "n J"]
    acceleration: Float[np.ndarray, "n J"]
    share: Float[np.ndarray, " n"]


class Curve:
    """Path through postures as a twice differentiable function of the share of its length, 0 to 1."""

    def __init__(self, path: Float[np.ndarray, "k J"], share: Float[np.ndarray, " k"] | None = None) -> None:
        """Fit the curve. share: of each posture, rising from 0 to 1; by the distances between postures if None."""
        if share is None:
            length = np.linalg.norm(np.diff(path, axis=0), axis=1)
            path = path[np.r_[True, length > SAME]]
            length = length[length > SAME]
            share = np.r_[0.0, np.cumsum(length)] / max(float(length.sum()), SAME)
        self.spline = CubicSpline(share, path, bc_type="natural") if len(path) > 1 else None
        self.path = path

    def at(self, share: Float[np.ndarray, " n"], order: int = 0) -> Float[np.ndarray, "n J"]:
        """Return postures, or their derivatives with respect to the share."""
        if self.spline is None:
            return np.tile(self.path[0], (len(share), 1)) * (order == 0)
        return self.spline(share, order)


def time_curve(
    curve: Curve,
    velocity: Float[np.ndarray, " J"],
    acceleration: Float[np.ndarray, " J"],
    *,
    least: float = MIN_DURATION_S,
) -> Timed:
    """Time a curve from rest to rest, quintic in time, as fast as the limits allow.

    velocity, acceleration: limits of each joint [rad/s, rad/s2]; least: shortest duration [s]. At every sample |q'| and |q''|
    are within the limits.
    """
    u = np.linspace(0, 1, CHECKED)
    s, ds, dds = _quintic(u)
    first, second = curve.at(s, 1), curve.at(s, 2)
    speed = np.abs(first * ds[:, None]).max(0) / velocity
    push = np.abs(second * ds[:, None] ** 2 + first * dds[:, None]).max(0) / acceleration
    duration = max(least, float(speed.max()) / SHARE, float(np.sqrt(push.max() / SHARE)))
    while True:
        timed = _sampled(curve, int(np.ceil(duration / STEP)) + 1)
        over = max(
            float((np.abs(timed.velocity).max(0) / velocity).max()),
            float(np.sqrt((np.abs(timed.acceleration).max(0) / acceleration).max())),
        )
        if over <= 1:
            return timed
        duration *= over / SHARE  # a sharp bend between the checked places may exceed a limit


def _sampled(curve: Curve, count: int) -> Timed:
    """Sample the whole curve `count` times, `STEP` apart."""
    duration, time = (count - 1) * STEP, np.arange(count) * STEP
    s, ds, dds = _quintic(time / duration)
    first, second = curve.at(s, 1), curve.at(s, 2)
    ds, dds = ds[:, None] / duration, dds[:, None] / duration**2
    return Timed(time, curve.at(s), first * ds, second * ds**2 + first * dds, s)


def stand(posture: Float[np.ndarray, " J"], seconds: float) -> Timed:
    """Return samples of an arm at rest."""
    count = max(2, round(seconds / STEP) + 1)
    zero = np.zeros((count, len(posture)))
    return Timed(np.arange(count) * STEP, np.tile(posture, (count, 1)), zero, zero, np.linspace(0, 1, count))


def _quintic(u: Float[np.ndarray, " n"]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the quintic share of the path at a share of the time, with two derivatives, which vanish at both ends."""
    return u**3 * (10 - 15 * u + 6 * u**2), 30 * u**2 * (1 - u) ** 2, 60 * u * (1 - u) * (1 - 2 * u)


Piece = tuple[Phase, Timed, float, np.ndarray]  # with the fingers' gap and the joint's values


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
