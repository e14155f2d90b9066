"""Paths to trajectories: a smooth curve through the postures, at a speed that keeps every joint within its limits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.interpolate import CubicSpline

STEP = 0.01  # [s] between samples
CHECKED = 400  # places along a curve at which limits are held; samples lie between them, so a share is left
SHARE = 0.98  # of every limit that is used
MIN_DURATION_S = 0.3  # [s] of the shortest motion
SAME = 1e-9  # [rad] postures nearer than this are one


@dataclass(frozen=True, eq=False)
class Timed:
    """Samples of one motion from rest to rest: time (n,) from 0 [s]; position, velocity, acceleration (n, J); share: (n,) of
    the way along the path, 0 to 1."""

    time: Float[np.ndarray, " n"]
    position: Float[np.ndarray, "n J"]
    velocity: Float[np.ndarray, "n J"]
    acceleration: Float[np.ndarray, "n J"]
    share: Float[np.ndarray, " n"]


class Curve:
    """A path through postures as a function of a share of its way, 0 to 1; twice differentiable."""

    def __init__(self, path: Float[np.ndarray, "k J"], share: Float[np.ndarray, " k"] | None = None) -> None:
        """share: where each posture lies, rising from 0 to 1; by the distance between them when None."""
        if share is None:
            length = np.linalg.norm(np.diff(path, axis=0), axis=1)
            path = path[np.r_[True, length > SAME]]
            length = length[length > SAME]
            share = np.r_[0.0, np.cumsum(length)] / max(float(length.sum()), SAME)
        self.spline = CubicSpline(share, path, bc_type="natural") if len(path) > 1 else None
        self.path = path

    def at(self, share: Float[np.ndarray, " n"], order: int = 0) -> Float[np.ndarray, "n J"]:
        """Return postures, or their derivatives by the share."""
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
    """Run along a curve from rest to rest, quintic in time, as fast as limits allow.

    velocity, acceleration: limits of each joint [rad/s, rad/s2]; least: duration [s]. At every sample |q'| and |q''| are
    within the limits.
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
        duration *= over / SHARE  # a sharp bend between the places that were checked


def _sampled(curve: Curve, count: int) -> Timed:
    """Return `count` samples of the whole curve, `STEP` apart."""
    duration, time = (count - 1) * STEP, np.arange(count) * STEP
    s, ds, dds = _quintic(time / duration)
    first, second = curve.at(s, 1), curve.at(s, 2)
    ds, dds = ds[:, None] / duration, dds[:, None] / duration**2
    return Timed(time, curve.at(s), first * ds, second * ds**2 + first * dds, s)


def stand(posture: Float[np.ndarray, " J"], seconds: float) -> Timed:
    """Return the arm stands."""
    count = max(2, round(seconds / STEP) + 1)
    zero = np.zeros((count, len(posture)))
    return Timed(np.arange(count) * STEP, np.tile(posture, (count, 1)), zero, zero, np.linspace(0, 1, count))


def _quintic(u: Float[np.ndarray, " n"]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the share of the way at a share of the time, with two derivatives; both vanish at both ends."""
    return u**3 * (10 - 15 * u + 6 * u**2), 30 * u**2 * (1 - u) ** 2, 60 * u * (1 - u) * (1 - 2 * u)
