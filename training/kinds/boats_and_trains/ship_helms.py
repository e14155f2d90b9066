"""Steering stands of ships."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh
from trimesh.creation import annulus

from training.kinds.kitchen_parts import door, look
from training.kinds.kitchen_trims import lathe, lever
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod, rounded, vec
from training.kinds.wheels import beam, upright

Y = vec(0, 1, 0)


def _spoked_wheel(m: Model, r: float, n: int) -> list[Trimesh]:
    """A wooden wheel round the z axis whose spokes end in handles, or a steel one without."""
    wood, w = m.chance(0.7), m.number(0.025, 0.04)
    count = m.pick(6, 8, 8, 10) if wood else m.pick(3, 5, 6)
    solids = [rod((0, 0, -0.8 * w), (0, 0, 1.1 * w), 0.17 * r, n), rod((0, 0, w), (0, 0, 1.6 * w), 0.08 * r, n)]
    rim = m.number(0.68, 0.75) * r if wood else r
    if wood:
        solids.append(annulus(0.86 * rim, rim, w, sections=max(n, 16) + 8))
        if m.chance(0.5):
            solids.append(annulus(0.9 * rim, 0.96 * rim, 1.3 * w, sections=max(n, 16) + 8))
    else:
        solids.append(ring((0, 0, 0), (0, 0, 1), rim, 0.4 * w, max(n, 16) + 8))
    for k in range(count):
        a = 2 * np.pi * k / count
        way = vec(np.cos(a), np.sin(a), 0)
        end = 0.8 * r if wood else rim
        solids.append(rod(0.1 * r * way, end * way, 0.012 if wood else 0.007, 8))
        if wood:
            solids += [
                rod(0.78 * r * way, 0.98 * r * way, m.pick(0.016, 0.018), 8),
                ball(0.98 * r * way, (0.018,) * 3, 8),
                rod(0.35 * r * way, 0.55 * r * way, 0.019, 8),
            ]
    return solids


def ship_helm(m: Model) -> None:
    """A wheel on a pedestal, a box or a frame, with a compass under a hood and perhaps levers for the engines."""
    style, n, r = m.pick("pedestal", "box", "frame", "console"), m.pick(12, 16, 24), m.number(0.35, 0.6)
    axle = m.number(0.85, 1.05) if style != "console" else m.number(0.95, 1.1)
    r = min(r, axle - 0.12) if style != "console" else min(r, 0.36)
    wide, deep = m.number(0.24, 0.34), m.number(0.24, 0.4)
    front = -0.5 * deep
    if style == "pedestal":
        m.add(BASE, lathe([(0, 0), (0.24, 0), (0.24, 0.03), (0.12, 0.1), (0.08, 0.4), (0.085, axle - 0.1), (0, axle - 0.1)], n))
        m.add(BASE, rod((0, front + 0.03, axle), (0, 0.12, axle), 0.1, n), rod((0, 0, axle - 0.16), (0, 0, axle), 0.085, n))
    elif style == "box":
        shell = (
            box((-wide / 2, wide / 2), (front + 0.02, deep / 2), (0.04, axle + 0.15))
            if m.chance(0.5)
            else prism(rounded((-wide / 2, wide / 2), (front + 0.02, deep / 2), 0.05), "z", (0.04, axle + 0.15))
        )
        m.add(BASE, shell, box((-wide / 2 - 0.04, wide / 2 + 0.04), (front - 0.01, deep / 2 + 0.04), (0, 0.05)))
        m.add(BASE, box((-wide / 2 - 0.02, wide / 2 + 0.02), (front, deep / 2 + 0.02), (axle + 0.15, axle + 0.18)))
    elif style == "frame":
        m.add(
            BASE,
            *(
                beam((s * 0.25, y, 0.03), (s * 0.05, y, axle + 0.03), 0.06, 0.05)
                for s in (-1, 1)
                for y in (front + 0.06, deep / 2)
            ),
        )
        m.add(
            BASE,
            *(box((-0.3, 0.3), (y - 0.05, y + 0.05), (0, 0.05)) for y in (front + 0.06, deep / 2)),
            box((-0.04, 0.04), (front + 0.06, deep / 2), (0.05, 0.1)),
        )
        m.add(
            BASE,
            rod((0, front + 0.03, axle), (0, deep / 2 + 0.04, axle), 0.04, n),
            rod((0, front + 0.12, axle), (0, deep / 2 - 0.05, axle), 0.09, n),
        )
    else:
        wide = m.number(0.8, 1.3)
        _console(m, wide, front, axle)
    _helm_wheel(m, style, axle, front, wide, r, n)


def _helm_wheel(m: Model, style: str, axle: float, front: float, wide: float, r: float, n: int) -> None:
    """The wheel, the compass and the levers."""
    hub = vec(0, front - 0.06, axle) if style != "console" else vec(m.pick(-0.2, 0, 0.2) * wide, front - 0.1, axle - 0.12)
    m.add(BASE, rod(hub, hub + 0.12 * Y, 0.025, 10))
    m.add("wheel", *upright(_spoked_wheel(m, r, n), -Y, hub))
    m.spin("wheel", hub, -Y)
    top = axle + {"pedestal": 0.09, "box": 0.18, "frame": 0.05, "console": 0.13}[style]
    if style != "frame":
        _compass(m, vec(0.0, 0.02 if style != "console" else 0.12, top), n)
    if style in ("pedestal", "box", "console") and m.chance(0.6):
        _engine_levers(m, wide, top, axle, style)
    if m.chance(0.35) and style != "console":
        m.add(BASE, box((-0.6, 0.6), (front - 0.7, 0.5), (-0.04, 0.001)))


def _console(m: Model, wide: float, front: float, axle: float) -> None:
    """A cabinet with a sloping panel and doors below."""
    x, back = (-wide / 2, wide / 2), front + 0.6
    outline = [(front, 0.08), (back, 0.08), (back, axle + 0.14), (front + 0.3, axle + 0.14), (front, axle - 0.04 - 0.2)]
    how = look(m, 0.5)
    m.add(BASE, prism(outline, "x", x), box((x[0] + 0.03, x[1] - 0.03), (front + 0.05, back), (0, 0.08)))
    for k in range(2):
        a = (x[0] + 0.03, -0.003) if k == 0 else (0.003, x[1] - 0.03)
        shifted = Model(m.rng)
        door(shifted, f"door_{k}", a, (0.12, axle - 0.5), ("left", "right")[k], how, 100)
        for part, solid in shifted.pieces:
            solid.apply_translation((0, front - max(how.depth[1], 0.0), 0))
            m.add(part, solid)
        for part, j in shifted.joints.items():
            j.origin[1] += front - max(how.depth[1], 0.0)
            m.joints[part] = j
    for s in (-1, 1):
        at = vec(s * 0.36 * wide, front + 0.15, axle - 0.05)
        up = vec(0, 0.3, 0.38) / np.linalg.norm([0.3, 0.38])
        m.add(BASE, beam(at - 0.09 * up, at + 0.09 * up, 0.16, 0.02))


def _compass(m: Model, at: np.ndarray, n: int) -> None:
    """A compass bowl under a hood that opens, or in a gimbal ring that tilts."""
    r, style = m.number(0.08, 0.11), m.pick("hood", "hood", "gimbal")
    high = m.number(0.04, 0.1)
    m.add(BASE, lathe([(0, -0.03), (1.15 * r, -0.03), (1.15 * r, high), (0.95 * r, high), (0.95 * r, 0.01), (0, 0.01)], n, at))
    m.add(
        BASE,
        *(ball(at + vec(s * 1.6 * r, 0, 0.6 * high), (0.5 * r,) * 3, 12) for s in (-1, 1)),
        rod(at + vec(-1.6 * r, 0, 0.6 * high), at + vec(1.6 * r, 0, 0.6 * high), 0.01, 8),
    ) if m.chance(0.4) else None
    _compass_cover(m, high, at, style, n, r)


def _compass_cover(m: Model, high: float, at: np.ndarray, style: str, n: int, r: float) -> None:
    """The hood that opens, or the ring and bowl that tilt."""
    top = at[2] + high
    if style == "hood":
        dome = lathe(
            [
                (1.12 * r, 0),
                (1.1 * r, 0.5 * r),
                (0.85 * r, 0.9 * r),
                (0.3 * r, 1.1 * r),
                (0, 1.12 * r),
                (0.0, 1.05 * r),
                (0.8 * r, 0.8 * r),
                (1.02 * r, 0.02),
            ],
            n,
            (at[0], at[1], top + 0.001),
        )
        m.add("hood", dome, ball((at[0], at[1], top + 1.14 * r), (0.012,) * 3, 8))
        m.add(
            "hood", box((-0.5 * r, 0.5 * r), (at[1] - 1.16 * r, at[1] - 0.96 * r), (top + 0.15 * r, top + 0.5 * r))
        ) if m.chance(0.6) else None
        m.add(BASE, rod((at[0] - 0.03, at[1] + 1.17 * r, top), (at[0] + 0.03, at[1] + 1.17 * r, top), 0.007, 8))
        m.hinge("hood", (at[0], at[1] + 1.17 * r, top), (-1, 0, 0), m.number(80, 110))
        m.add(BASE, rod((at[0], at[1], at[2] + 0.01), (at[0], at[1], top - 0.008), 0.85 * r, n))
    else:
        m.add(
            "gimbal",
            ring((at[0], at[1], top + 0.005), (0, 0, 1), 0.86 * r, 0.006, 24),
            rod((at[0] - 1.0 * r, at[1], top + 0.003), (at[0] - 0.8 * r, at[1], top + 0.003), 0.005, 6),
            rod((at[0] + 0.8 * r, at[1], top + 0.003), (at[0] + 1.0 * r, at[1], top + 0.003), 0.005, 6),
        )
        m.hinge("gimbal", (at[0], at[1], top + 0.005), (1, 0, 0), (-20, 20))
        m.add(
            "bowl",
            lathe([(0, -0.35 * r), (0.5 * r, -0.28 * r), (0.72 * r, 0), (0.72 * r, 0.02), (0, 0.02)], n, (at[0], at[1], top)),
        )
        m.add(
            "bowl",
            *(
                rod((at[0], at[1] + s * 0.7 * r, top + 0.005), (at[0], at[1] + s * 0.86 * r, top + 0.005), 0.005, 6)
                for s in (-1, 1)
            ),
        )
        m.hinge("bowl", (at[0], at[1], top + 0.005), (0, 1, 0), (-20, 20), "gimbal")


def _engine_levers(m: Model, wide: float, top: float, axle: float, style: str) -> None:
    """A quadrant at a side with one or two levers that go ahead and astern, or a telegraph with a round dial."""
    s, count = m.pick(-1, 1), 1 if style == "box" else m.pick(1, 2)
    if style == "pedestal":
        c = vec(s * 0.16, 0, axle + 0.02)
        m.add(BASE, rod(c - vec(s * 0.1, 0, 0), c, 0.03, 10))
    elif style == "box":
        c = vec(s * (wide / 2 + 0.03), 0, axle - 0.05)
    else:
        c = vec(s * 0.28 * wide, 0.1, top)
    half = 0.032
    m.add(BASE, rod(c - half * vec(1, 0, 0), c + half * vec(1, 0, 0), 0.075, 20))
    for k in range(count):
        a = c + vec((half + 0.008) * (1, -1)[k] * s, 0, 0)
        m.add(f"lever_{k}", rod(a - vec(0.007, 0, 0), a + vec(0.007, 0, 0), 0.03, 12))
        lever(m, f"lever_{k}", a, a + vec(0, 0, m.number(0.15, 0.2)), 0.012)
        m.add(f"lever_{k}", ball(a + vec(0, 0, 0.19), (0.018,) * 3, 10))
        m.hinge(f"lever_{k}", a, (1, 0, 0), m.pick((-60, 60), (-50, 70)))
