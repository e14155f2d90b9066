"""Drones with four or six rotors."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, loft, prism, ring, rod, rounded, vec
from training.kinds.wheels import beam, lathe


def _rotor(m: Model, part: str, at: np.ndarray, size: float, count: int, wide: float, way: int, parent: str) -> None:
    """A hub with flat twisted blades about the vertical."""
    m.add(part, rod(at, at + vec(0, 0, 0.06 * size + 0.006), 0.09 * size, 10))
    z = 0.04 * size
    for k in range(count):
        t = 2 * np.pi * k / count
        out, across = vec(np.cos(t), np.sin(t), 0), way * vec(-np.sin(t), np.cos(t), 0)
        rings = []
        for r, w, lean in ((0.05, 0.6, 0.5), (0.3, 1.2, 0.35), (0.7, 0.9, 0.2), (1.0, 0.4, 0.1)):
            up = vec(0, 0, lean)
            corners = [
                wide * w * u * (across + up) + vec(0, 0, v * 0.012) for u, v in ((-0.5, 0), (0.1, 0.5), (0.5, 0.1), (0.1, -0.3))
            ]
            rings.append([at + vec(0, 0, z) + size * (r * out + c) for c in corners])
        m.add(part, loft(np.array(rings)))
    m.spin(part, at, (0, 0, way), parent)


def _drone_body(m: Model, r: float, z: float) -> tuple[float, float, float]:
    """The trunk; returns half its width, half its length, half its height."""
    style, n = m.pick("pod", "brick", "plates", "disc"), m.pick(8, 12, 16)
    wide, deep, high = {"pod": (0.3, 0.5, 0.16), "brick": (0.28, 0.55, 0.14), "plates": (0.3, 0.42, 0.12)}.get(
        style, (0.36, 0.36, 0.13)
    )
    wide, deep, high = wide * r, deep * r, high * r * m.number(0.8, 1.2)
    if style == "pod":
        m.add(BASE, ball((0, 0, z), (1.15 * wide, 1.1 * deep, 1.3 * high), n))
    elif style == "brick":
        m.add(BASE, prism(rounded((-wide, wide), (-deep, deep), 0.4 * wide), "z", (z - high, z + high)))
        m.add(
            BASE,
            prism(rounded((-0.6 * wide, 0.6 * wide), (-0.5 * deep, 0.8 * deep), 0.2 * wide), "z", (z + high, z + 1.3 * high)),
        )
    elif style == "plates":
        for c in (-1, 1):
            m.add(
                BASE,
                prism(rounded((-wide, wide), (-deep, deep), 0.5 * wide, 1), "z", (z + c * high - 0.004, z + c * high + 0.004)),
            )
        spots = [(a * 0.75 * wide, b * 0.75 * deep) for a in (-1, 1) for b in (-1, 0, 1)]
        m.add(BASE, *(rod((a, b, z - high), (a, b, z + high), 0.006, 6) for a, b in spots))
        m.add(BASE, box((-0.4 * wide, 0.4 * wide), (-0.7 * deep, 0.7 * deep), (z + high + 0.004, z + 2.2 * high)))
    else:
        m.add(BASE, lathe([(0, -high), (0.8 * wide, -high), (wide, 0), (0.7 * wide, high), (0, 1.2 * high)], n + 4, (0, 0, z)))
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                rod((s * 0.5 * wide, 0.6 * deep, z + 0.5 * high), (s * 0.5 * wide, 0.7 * deep, z + 3.5 * high), 0.006, 6)
                for s in (-1, 1)
            ),
        )
    return wide, deep, high


def _gimbal(m: Model, y: float, z: float, size: float) -> None:
    """A yoke that turns below the body and a camera that tilts in it."""
    m.add(BASE, box((-0.5 * size, 0.5 * size), (y - 0.5 * size, y + 0.5 * size), (z, z + 0.5 * size)))
    m.add("gimbal", rod((0, y, z - 0.3 * size), (0, y, z), 0.3 * size, 12))
    sides = m.pick((-1,), (-1, 1))
    m.add(
        "gimbal",
        box(
            (-0.75 * size, (0.75 if len(sides) > 1 else 0.3) * size),
            (y - 0.2 * size, y + 0.2 * size),
            (z - 0.45 * size, z - 0.3 * size),
        ),
    )
    m.add(
        "gimbal",
        *(
            box((s * 0.62 * size, s * 0.75 * size), (y - 0.2 * size, y + 0.2 * size), (z - 1.2 * size, z - 0.3 * size))
            for s in sides
        ),
    )
    m.hinge("gimbal", (0, y, z), (0, 0, 1), (-90, 90))
    at = vec(0, y, z - 1.0 * size)
    m.add(
        "camera",
        m.pick(
            ball(at, (0.5 * size,) * 3, 12),
            box((-0.5 * size, 0.5 * size), (y - 0.4 * size, y + 0.4 * size), (at[2] - 0.4 * size, at[2] + 0.4 * size)),
        ),
    )
    m.add(
        "camera",
        rod(at - (0, 0.3 * size, 0), at - (0, 0.65 * size, 0), 0.25 * size, 12),
        rod(at - (0.62 * size, 0, 0), at, 0.12 * size, 8),
    )
    m.hinge("camera", at, (1, 0, 0), (-30, 90), "gimbal")


def _drone_legs(m: Model, wide: float, deep: float, z: float, size: float) -> None:
    """Two skids or frames below the body, fixed or folding up to the sides."""
    folds, spread = m.chance(0.4), 0.35 * wide + 0.3 * z
    for s, side in ((-1, "left"), (1, "right")):
        part = f"leg_{side}" if folds else BASE
        top, foot = vec(s * 0.8 * wide, 0, z), vec(s * (0.8 * wide + spread), 0, 0.012)
        for y in m.pick((0,), (-0.5 * deep, 0.5 * deep)):
            m.add(part, rod(top + vec(0, y, 0), foot + vec(0, y, 0), 0.011, 8))
            m.add(
                BASE,
                rod(top + vec(0, y - 0.02, 0), top + vec(0, y + 0.02, 0), 0.016, 8),
                rod(top + vec(0, y, 0), (0, y, z + size), 0.012, 6),
            )
        m.add(part, rod(foot - (0, 0.9 * deep, 0), foot + vec(0, 0.9 * deep, 0), 0.012, 8))
        if folds:
            m.hinge(part, top, (0, -s, 0), m.number(55, 75))


def drone(m: Model) -> None:
    """Make a drone of four or six rotors: arms fixed or folding, guards, skids, legs that fold, a camera on a gimbal."""
    count, reach, folds = m.pick(4, 4, 4, 6, 6), m.number(0.22, 0.5), m.chance(0.5)
    z, guard, legs = m.number(0.3, 0.55) * reach, m.chance(0.35), m.chance(0.6) or (folds and count > 4)
    wide, deep, high = _drone_body(m, reach, z)
    size = reach * min(0.55, 0.88 * np.sin(np.pi / count)) * m.number(0.85, 1.0)
    blade, wing, round_, thick = m.pick(2, 2, 3), m.number(0.14, 0.2), m.chance(0.5), m.number(0.035, 0.06) * reach
    for k in range(count):
        t = 2 * np.pi * (k + 0.5) / count + np.pi / 2
        out, low = vec(np.cos(t), np.sin(t), 0), 0.3 * high * (1 if k % 2 else -1) * (folds and count == 4)
        root, end = vec(0.85 * wide * np.cos(t), 0.75 * deep * np.sin(t), z + low), vec(0, 0, z + low) + reach * out
        part = f"arm_{k}" if folds else BASE
        m.add(
            part, rod(root, end, thick, 10) if round_ else beam(root, end, 1.6 * thick, 2 * thick, vec(-out[1], out[0], 0), 0.7)
        )
        m.add(part, rod(end - (0, 0, thick), end + vec(0, 0, 0.09 * reach), 0.07 * reach, 12))
        if folds:
            m.add(part, rod(root - (0, 0, 1.3 * thick), root + vec(0, 0, 1.3 * thick), 1.5 * thick, 10))
            level = (0, 0, 1 if out[0] * out[1] < 0 else -1)
            m.hinge(part, root, level if count == 4 else (-out[1], out[0], 0), m.pick(90, 100, 110) if count == 4 else 80)
        if not legs:
            m.add(part, beam(end, (end[0], end[1], 0), 0.05 * reach, 0.04 * reach, (1, 0, 0), 0.6))
        hub = end + vec(0, 0, 0.09 * reach)
        if guard and not folds:
            m.add(part, ring(hub, (0, 0, 1), 1.1 * size, 0.012 * reach, 20))
            m.add(
                part,
                *(
                    beam(end, hub + 1.1 * size * vec(np.cos(a), np.sin(a), 0), 0.02 * reach, 0.02 * reach, (0, 0, 1))
                    for a in (t + 1, t - 1, t)
                ),
            )
        _rotor(m, f"rotor_{k}", hub, size, blade, wing, 1 if k % 2 else -1, part)
    if legs:
        _drone_legs(m, wide, deep, z - 0.75 * high, 0.4 * high)
    if m.chance(0.7):
        _gimbal(m, -0.55 * deep, z - 0.95 * high, min(0.14 * reach, 0.4 * (z - high)))
    else:
        m.add(BASE, rod((0, -0.8 * deep, z), (0, -1.12 * deep, z), 0.5 * high, 10))
