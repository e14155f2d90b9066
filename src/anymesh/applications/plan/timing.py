"""Time parametrization: a smooth curve through the postures, timed so that every joint stays within its limits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from scipy.interpolate import CubicSpline

STEP = 0.01  # [s] between samples
CHECKED = 400  # places along a curve where limits are checked; samples lie between them, hence `SHARE`
SHARE = 0.98  # of every limit that is used
MIN_DURATION_S = 0.3  # [s] shortest motion
SAME = 1e-9  # [rad] below which two postures are equal


@dataclass(frozen=True, eq=False)
class Timed:
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
