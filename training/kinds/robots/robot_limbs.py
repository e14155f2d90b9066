"""Limbs and body pieces of humanoid robots."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from trimesh import Trimesh

from training.kinds.model import Model
from training.kinds.solids import ball, box, moved, prism, ring, rod, rounded, vec
from training.kinds.wheels import beam, lathe


@dataclass(frozen=True)
class Body:
    """How a robot is drawn; h: its height [m] but for the head, w: half the width of its chest."""

    style: str
    h: float
    w: float
    limb: float
    n: int
    joint: str


def block(b: Body, x: tuple[float, float], y: tuple[float, float], z: tuple[float, float]) -> list[Trimesh]:
    """A piece of the body in its style between coordinates."""
    center, size = np.array([sum(x), sum(y), sum(z)]) / 2, np.array([abs(x[1] - x[0]), abs(y[1] - y[0]), abs(z[1] - z[0])])
    if b.style == "round":
        solid = prism(
            rounded((-size[0] / 2, size[0] / 2), (-size[1] / 2, size[1] / 2), 0.45 * min(size[:2]), 4),
            "z",
            (-size[2] / 2, size[2] / 2),
        )
        return [moved(solid, center)]
    if b.style == "tin":
        radius = 0.5
        solid = lathe([(0, -0.5), (radius, -0.5), (radius, 0.46), (0.8 * radius, 0.5), (0, 0.5)], max(b.n, 12))
        solid.vertices = solid.vertices * size + center
        return [solid]
    if b.style == "armour":
        c = 0.18 * min(size[0], size[2])
        a, q = size[0] / 2, size[2] / 2
        outline = [(-a + c, -q), (a - c, -q), (a, -q + c), (a, q - c), (a - c, q), (-a + c, q), (-a, q - c), (-a, -q + c)]
        return [moved(prism(outline, "y", (-size[1] / 2, size[1] / 2)), center)]
    return [box(x, y, z)]


def _limb(b: Body, a: np.ndarray, end: np.ndarray, thick: float) -> list[Trimesh]:
    """A limb between two joints, not quite from one to the other."""
    way = end - a
    a, end = a + 0.06 * way, end - 0.06 * way
    if b.style == "round":
        return [rod(a, end, 0.8 * thick, b.n), *(ball(p, (0.8 * thick,) * 3, 10) for p in (a, end))]
    if b.style == "tin":
        found: list[Trimesh] = [rod(a, end, 0.55 * thick, b.n)]
        found += [ring(a + q * (end - a), way, 0.55 * thick, 0.16 * thick, 12) for q in (0.2, 0.4, 0.6, 0.8)]
        return found
    if b.style == "armour":
        return [beam(a, end, 1.25 * thick, 1.25 * thick, taper=1.35)]
    return [beam(a, end, 1.7 * thick, 1.7 * thick)]


def _pin(b: Body, at: np.ndarray, thick: float, wide: float) -> Trimesh:
    """What is drawn at a joint across x."""
    return (
        ball(at, (0.9 * thick,) * 3, 10)
        if b.joint == "ball"
        else rod(at - vec(wide, 0, 0), at + vec(wide, 0, 0), 0.7 * thick, b.n)
    )


def arm(m: Model, b: Body, s: int, side: str, torso: str, z: float, joints: str, fist: str, bulk: float, length: float) -> None:
    """An arm that swings at the shoulder and bends at the elbow."""
    h, t = b.h, b.limb
    shoulder = vec(s * (b.w + 1.15 * t), 0, z)
    elbow = shoulder - vec(0, 0, 0.2 * h * length)
    hand = elbow - vec(0, 0, 0.19 * h * length)
    upper, lower = f"arm_{side}", (f"forearm_{side}" if joints == "two" else f"arm_{side}")
    inner = vec(s * (0.8 * b.w), 0, z)
    m.add(torso, rod(inner, vec(s * (b.w + 0.28 * t), 0, z), 0.6 * t, b.n))
    if b.style == "armour":
        m.add(upper, box((shoulder[0] - s * 0.9 * t, shoulder[0] + s * 1.3 * t), (-1.3 * t, 1.3 * t), (z - t, z + 1.2 * t)))
    m.add(
        upper,
        ball(shoulder, (1.1 * t,) * 3, 10)
        if b.style == "round"
        else rod(shoulder - vec(t, 0, 0), shoulder + vec(t, 0, 0), t, b.n),
    )
    m.add(upper, *_limb(b, shoulder, elbow, 0.85 * t))
    m.hinge(upper, shoulder, (-1, 0, 0), m.pick((-60, 160), (-45, 90), (-180, 180)), torso)
    m.add(lower, _pin(b, elbow, 0.9 * t, 0.95 * t), *_limb(b, elbow, hand, 0.85 * t * bulk))
    if joints == "two":
        m.hinge(lower, elbow, (-1, 0, 0), m.pick(100, 120), upper)
    m.add(lower, *_hand(fist, hand, t, s))


def _hand(fist: str, at: np.ndarray, t: float, s: int) -> Sequence[Trimesh]:
    """A ball, a fist with a thumb or a claw of two prongs at the end of an arm."""
    if fist == "ball":
        return [ball(at, (1.0 * t,) * 3, 10)]
    x, _, z = at
    if fist == "fist":
        return [
            box((x - 0.7 * t, x + 0.7 * t), (-0.9 * t, 0.9 * t), (z - 1.7 * t, z + 0.2 * t)),
            box((x - 0.5 * t, x - 0.9 * s * t), (-1.3 * t, -0.5 * t), (z - t, z - 0.4 * t)),
        ]
    prongs = [
        prism(
            [(k * 0.1 * t, z + 0.1 * t), (k * 1.0 * t, z - 0.6 * t), (k * 0.5 * t, z - 2.0 * t), (k * 0.5 * t, z - 0.7 * t)],
            "x",
            (x - 0.35 * t, x + 0.35 * t),
        )
        for k in (-1, 1)
    ]
    return [*prongs, rod((x, 0, z - 0.3 * t), (x, 0, z + 0.4 * t), 0.6 * t, 10)]


def leg(m: Model, b: Body, s: int, side: str, x: float, hip: float, joints: str, feet: bool, bulk: float) -> None:
    """A leg that swings at the hip and bends at the knee; the foot turns in some."""
    h, t = b.h, min(1.15 * b.limb, 0.92 * x)
    top, ankle = vec(s * x, 0, hip - 0.03 * h - 0.7 * t), vec(s * x, 0, 0.055 * h)
    knee = 0.5 * (top + ankle)
    upper, lower = f"leg_{side}", (f"shin_{side}" if joints == "two" else f"leg_{side}")
    m.add(upper, _pin(b, top, 1.1 * t, 0.9 * t), *_limb(b, top, knee, 0.9 * t))
    m.hinge(upper, top, (-1, 0, 0), m.pick((-30, 90), (-45, 60)))
    m.add(lower, _pin(b, knee, 0.9 * t, t), *_limb(b, knee, ankle, 0.9 * t * min(bulk, 1.2)))
    if joints == "two":
        m.hinge(lower, knee, (1, 0, 0), m.pick(90, 120), upper)
    foot = f"foot_{side}" if feet else lower
    solid = prism(
        [(-2.4 * t, 0), (1.3 * t, 0), (1.3 * t, 0.03 * h), (0.5 * t, 0.06 * h), (-0.5 * t, 0.06 * h), (-2.4 * t, 0.02 * h)],
        "x",
        (s * x - t, s * x + t),
    )
    m.add(foot, solid if b.style != "boxy" else box((s * x - t, s * x + t), (-2.2 * t, 1.3 * t), (0, 0.045 * h)))
    m.add(foot, _pin(b, ankle, 0.7 * t, 0.8 * t))
    if feet:
        m.hinge(foot, ankle, (-1, 0, 0), (-25, 25), lower)
