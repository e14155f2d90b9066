"""Wheels whose teeth mesh: one of them leads, the others follow.

Outlines of many parts repeat about their axes, as those of fluted knobs do; that two of them also have teeth of one size and
lie so near that the teeth reach into each other is rare. Of 713 pairs of parts side by side that turn about parallel axes, in
311 objects of Articraft without gears, 3 have such outlines (two knobs each), and none meshes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
from jaxtyping import Float

from anymesh.types import Joint, JointType, Mesh, Mimic, Segmentation
from anymesh.types.motion import with_implied_limits

TURNING = (JointType.REVOLUTE, JointType.CONTINUOUS)
BINS = 1440  # angles of an outline
FINE = 300  # points along edges over the diagonal of a part
MAX_POINTS = 2_000_000  # of a part
TEETH = (6, 200)  # least and most teeth of a wheel; BINS show no more
MIN_SHARE = 0.8  # of the variance of an outline in waves of its number of teeth; .85 and more for trapezoids of 8 to 80 teeth
DEPTH = (0.8, 3.5)  # depth of teeth in modules; ISO 53 has 2.25
SAME_MODULE = 1.1  # ratio of two modules that mesh
MESHED = (0.2, 1.2)  # by how much the tips reach over each other, in depths of teeth
PARALLEL = 0.999  # cosine of axes
Points = Float[np.ndarray, "n 3"]
Vector = Float[np.ndarray, " 3"]


@dataclass(frozen=True)
class Teeth:
    """A toothed outline: the number of teeth, and the radii of their tips and roots [m]."""

    count: int
    tip: float
    root: float

    @property
    def module(self) -> float:
        """Diameter over the number of teeth [m]."""
        return (self.tip + self.root) / self.count

    def meshes(self, other: Teeth, distance: float) -> bool:
        """Return whether wheels with these teeth mesh. distance: of their axes [m]."""
        depth = min(self.tip - self.root, other.tip - other.root)
        ratio = self.module / other.module
        return 1 / SAME_MODULE < ratio < SAME_MODULE and MESHED[0] * depth < self.tip + other.tip - distance < MESHED[1] * depth


def teeth(points: Points, origin: Vector, axis: Vector) -> Teeth | None:
    """Return the teeth of an outline about an axis, None if it has none. points: along edges of the surface, dense."""
    across = np.linalg.svd(axis[None])[2][1:]
    x, y = across @ (points - origin).T
    outline = np.zeros(BINS)
    np.maximum.at(outline, (np.arctan2(y, x) / (2 * np.pi) * BINS).astype(int) % BINS, np.hypot(x, y))
    seen = np.flatnonzero(outline)
    if len(seen) < BINS / 2:
        return None
    outline = np.interp(np.arange(BINS), seen, outline[seen], period=BINS)
    power = np.abs(np.fft.rfft(outline - outline.mean())) ** 2
    count = int(power[: TEETH[1] + 1].argmax())
    wheel = Teeth(max(count, 1), *(float(np.quantile(outline, q)) for q in (0.95, 0.05)))
    repeats = count >= TEETH[0] and power[count::count].sum() > MIN_SHARE * power.sum()
    return wheel if repeats and DEPTH[0] < (wheel.tip - wheel.root) / wheel.module < DEPTH[1] else None


def _edge_points(triangles: Float[np.ndarray, "F 3 3"]) -> Points:
    """Return points along the edges of triangles, up to a limit."""
    step = float(np.linalg.norm(np.ptp(triangles.reshape(-1, 3), axis=0))) / FINE
    start, end = np.concatenate([triangles[:, k] for k in (0, 1, 2)]), np.concatenate([triangles[:, k] for k in (1, 2, 0)])
    count = np.ceil(np.linalg.norm(end - start, axis=1) / step).astype(int)
    edge = np.repeat(np.arange(len(count)), count)[:MAX_POINTS]
    share = (np.arange(len(edge)) - (np.cumsum(count) - count)[edge]) / count[edge]
    return start[edge] + share[:, None] * (end - start)[edge]


def with_gears(mesh: Mesh, segmentation: Segmentation, joints: Sequence[Joint]) -> tuple[Joint, ...]:
    """Return the joints, those of wheels that mesh following one of them; joints that follow others already are kept.

    The wheel with the largest part beside its teeth leads, such as that with a crank.
    """
    turning = [j for j in joints if j.type in TURNING and j.mimic is None]
    number = segmentation.numbers
    faces = {j.name: mesh.triangles[segmentation.faces(number[j.child])] for j in turning}
    size = {name: float(np.linalg.norm(np.ptp(triangles.reshape(-1, 3), axis=0))) for name, triangles in faces.items()}
    near = [(a, b) for a, b in combinations(turning, 2) if _apart(a, b) < (size[a.name] + size[b.name]) / 2]
    points = {name: _edge_points(faces[name]) for name in {j.name for pair in near for j in pair}}
    ratios: dict[str, dict[str, float]] = {}
    for a, b in near:
        if (ratio := _ratio(a, b, points[a.name], points[b.name])) is not None:
            ratios.setdefault(a.name, {})[b.name] = ratio
            ratios.setdefault(b.name, {})[a.name] = 1 / ratio
    return _led(joints, ratios, size)


def _apart(a: Joint, b: Joint) -> float:
    """Return the distance of two axes [m], infinite unless they are parallel."""
    off = b.origin - a.origin
    return float(np.linalg.norm(off - (off @ a.axis) * a.axis)) if abs(float(a.axis @ b.axis)) > PARALLEL else np.inf


def _ratio(a: Joint, b: Joint, of_a: Points, of_b: Float[np.ndarray, "m 3"]) -> float | None:
    """Return how much b turns for a turn of a, None if they do not mesh."""
    heights = of_a @ a.axis, of_b @ a.axis
    low, high = max(h.min() for h in heights), min(h.max() for h in heights)
    wheels = []
    for joint, points, height in zip((a, b), (of_a, of_b), heights, strict=True):
        beside = points[(height >= low) & (height <= high)]
        wheels.append(teeth(beside, joint.origin, a.axis) if len(beside) >= BINS else None)
    first, second = wheels
    if first is None or second is None or not first.meshes(second, _apart(a, b)):
        return None
    return -first.count / second.count * (1.0 if a.axis @ b.axis > 0 else -1.0)


def _led(joints: Sequence[Joint], ratios: dict[str, dict[str, float]], size: dict[str, float]) -> tuple[Joint, ...]:
    """Let each train of wheels follow its largest part, as far as it turns about unbroken ways."""
    follows: dict[str, Mimic] = {}
    waiting = sorted(ratios, key=lambda name: -size[name])
    while waiting:
        lead, train = waiting[0], {waiting[0]: 1.0}
        for name in (ring := [lead]):
            ring += [n for n in ratios[name] if n not in train]
            train |= {n: train[name] * r for n, r in ratios[name].items() if n not in train}
        follows |= {n: Mimic(lead, r) for n, r in train.items() if n != lead}
        waiting = [n for n in waiting if n not in train]
    led = (replace(j, mimic=follows[j.name], reason=f"{j.reason}; its teeth mesh") if j.name in follows else j for j in joints)
    return with_implied_limits(tuple(led))
