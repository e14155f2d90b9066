"""Technical objects without any movable part: pipes, engine block, tyres, street lamp."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, lathe, tyre, upright


def pipe_assembly(m: Model) -> None:
    """Pipes with bends, flanges, tees, a tank and brackets, all fixed."""
    n, r = m.pick(8, 12, 20), m.number(0.02, 0.06)
    for k in range(m.pick(1, 2, 3)):
        at, path = vec(0.25 * k, 0, m.number(0.1, 0.3)), []
        path.append(at)
        axes = [vec(1, 0, 0), vec(0, 0, 1), vec(0, 1, 0), vec(1, 0, 0), vec(0, 0, -0.3)]
        for axis in axes[: m.pick(2, 3, 5)]:
            at = at + m.number(0.25, 0.7) * axis
            path.append(at)
        if m.chance(0.5):
            m.add(BASE, tube(path, r, n))
        else:
            m.add(
                BASE,
                *(rod(a, b, r, n) for a, b in pairwise(path)),
                *(ball(p, (1.25 * r,) * 3, n) for p in path[1:-1]),
            )
        for a, b in pairwise(path):
            way = (b - a) / np.linalg.norm(b - a)
            for t in (0.25, 0.75)[: m.pick(0, 1, 2)]:
                p = a + t * (b - a)
                m.add(
                    BASE,
                    rod(p - 0.3 * r * way, p - 0.02 * r * way, 1.9 * r, n),
                    rod(p + 0.02 * r * way, p + 0.3 * r * way, 1.9 * r, n),
                )
                side = np.cross(way, (0.3, 0.5, 0.8))
                side = 1.55 * r * side / np.linalg.norm(side)
                for q in range(6):
                    off = trimesh.transformations.rotation_matrix(q * np.pi / 3, way)[:3, :3] @ side
                    m.add(BASE, rod(p + off - 0.5 * r * way, p + off + 0.5 * r * way, 0.15 * r, 6))
        m.add(
            BASE,
            rod(path[1], path[1] * (1, 1, 0), 0.4 * r, 8),
            box((path[1][0] - 0.05, path[1][0] + 0.05), (path[1][1] - 0.05, path[1][1] + 0.05), (0, 0.01)),
        )
    if m.chance(0.6):
        m.add(
            BASE,
            rod((-0.2, 0, 0.2), (-0.2, 0, 0.7), 0.15, n),
            ball((-0.2, 0, 0.7), (0.15, 0.15, 0.07), n),
            ball((-0.2, 0, 0.2), (0.15, 0.15, 0.07), n),
        )
        m.add(
            BASE,
            *(
                rod((-0.2 + 0.1 * np.cos(t), 0.1 * np.sin(t), 0), (-0.2 + 0.1 * np.cos(t), 0.1 * np.sin(t), 0.2), 0.012, 6)
                for t in (0.5, 2.6, 4.7)
            ),
        )
    if m.chance(0.4):
        m.add(BASE, rod((0.1, -0.01, 0.6), (0.1, -0.04, 0.6), 0.05, 16), rod((0.1, 0, 0.3), (0.1, 0, 0.6), 0.008, 6))


def engine_block(m: Model) -> None:
    """A motor as one casting with head, sump, pulleys, pipes and bolts that all stay."""
    count, pitch, n = m.pick(2, 3, 4, 6), m.number(0.09, 0.12), m.pick(10, 16, 24)
    long, half, high = count * pitch + 0.04, m.number(0.1, 0.14), m.number(0.26, 0.34)
    block = box((-half, half), (0, long), (0.1, high))
    bores = [
        rod((0, 0.02 + (k + 0.5) * pitch, high - 0.15), (0, 0.02 + (k + 0.5) * pitch, 1), 0.4 * pitch, n) for k in range(count)
    ]
    open_ = m.chance(0.4)
    m.add(BASE, cut(block, *bores) if open_ else block)
    m.add(BASE, beam((0, long / 2, 0.1), (0, long / 2, 0.0), 1.9 * half, 0.95 * long, taper=0.75))
    if not open_:
        m.add(BASE, box((-0.9 * half, 0.9 * half), (0.005, long - 0.005), (high + 0.002, high + 0.08)))
        m.add(BASE, prism(rounded((-0.6 * half, 0.6 * half), (high + 0.08, high + 0.13), 0.02), "y", (0.01, long - 0.01)))
        m.add(BASE, rod((0, 0.3 * long, high + 0.12), (0, 0.3 * long, high + 0.15), 0.025, n))
    for k in range(count):
        y = 0.02 + (k + 0.5) * pitch
        m.add(
            BASE,
            tube([(half - 0.01, y, high - 0.02), (half + 0.08, y, high - 0.01), (half + 0.1, y + 0.02, high - 0.1)], 0.017, 8),
        )
        m.add(BASE, box((-half - 0.01, -half), (y - 0.4 * pitch, y + 0.4 * pitch), (0.14, high - 0.06)))
        m.add(
            BASE,
            *(rod((-half - 0.02, y + c, z), (-half, y + c, z), 0.006, 6) for c in (-0.03, 0.03) for z in (0.16, high - 0.08)),
        )
    m.add(BASE, rod((half + 0.1, 0, high - 0.1), (half + 0.1, long, high - 0.1), 0.022, n))
    pulleys = [((0, 0.14), 0.07), ((0.05, high - 0.03), 0.05), ((half + 0.05, 0.2), 0.035)]
    for (x, z), r in pulleys[: m.pick(1, 2, 3)]:
        m.add(
            BASE,
            *upright([lathe([(0, 0), (r, 0), (0.8 * r, 0.012), (r, 0.024), (0, 0.024)], n)], (0, -1, 0), (x, -0.01, z)),
            rod((x, -0.01, z), (x, 0.03, z), 0.01, 8),
        )
    if m.chance(0.6):
        m.add(
            BASE,
            rod((-half - 0.05, 0.1, 0.15), (-half - 0.05, 0.28, 0.15), 0.045, n),
            rod((-half - 0.03, 0.6 * long, 0.12), (-half - 0.1, 0.6 * long, 0.1), 0.035, n),
        )
    m.add(BASE, rod((0, long, 0.16), (0, long + 0.03, 0.16), 0.13, 28))


def tyre_stack(m: Model) -> None:
    """Tyres one on another, askew, perhaps one leaning and rims inside; nothing moves."""
    r, wide, n, count = m.number(0.28, 0.4), m.number(0.16, 0.26), m.pick(14, 24, 36), m.pick(1, 2, 3, 5)
    inner, rims = m.number(0.55, 0.65) * r, m.chance(0.4)
    for k in range(count):
        at = vec(m.number(-0.04, 0.04), m.number(-0.04, 0.04), (k + 0.5) * wide)
        m.add(BASE, tyre(r, wide, inner, n, m.chance(0.7)).apply_translation(at))
        if rims and m.chance(0.7):
            m.add(
                BASE,
                lathe([(0, -0.02), (inner, -0.04), (inner, 0.05), (0.9 * inner, 0.05), (0.8 * inner, 0.0), (0, 0.02)], n, at),
            )
        for t in np.linspace(0, 2 * np.pi, m.pick(0, 18), endpoint=False):
            m.add(
                BASE,
                turned(
                    box((0.98 * r, 1.02 * r), (-0.02, 0.02), (-0.4 * wide, 0.4 * wide)), (0, 0, 1), np.degrees(t), (0, 0, 0)
                ).apply_translation(at),
            )
    if m.chance(0.4):
        lean = tyre(r, wide, inner, n, True)
        m.add(BASE, *upright([lean], (0, -1, m.number(0.05, 0.3)), (0, -r - wide, r)))
    if m.chance(0.3):
        m.add(BASE, box((-0.6, 0.6), (-0.6, 0.6), (-0.1, -0.0)))


def street_lamp(m: Model) -> None:
    """A post with one or two lamps, a base with a plate that looks like a hatch; nothing moves."""
    tall, n, r = m.number(2.8, 7), m.pick(8, 12, 20), m.number(0.04, 0.08)
    m.add(
        BASE,
        lathe(
            [(0, 0), (3 * r, 0), (3 * r, 0.1), (1.8 * r, 0.2), (1.8 * r, 0.9), (1.2 * r, 1.0), (0.8 * r, tall), (0, tall)], n
        ),
    )
    if m.chance(0.6):
        m.add(BASE, box((-r, r), (-1.95 * r, -1.5 * r), (0.4, 0.75)), rod((0, -2.1 * r, 0.7), (0, -1.9 * r, 0.7), 0.01, 6))
    style, arms = m.pick("lantern", "arm", "globe"), m.pick(1, 2)
    if style == "arm":
        for s in (-1, 1)[:arms]:
            t = np.linspace(0, np.pi / 2, 8)
            reach = m.number(0.6, 1.6)
            path = [(s * reach * (1 - np.cos(a)), 0, tall - 0.05 + 0.5 * np.sin(a)) for a in t]
            m.add(
                BASE,
                tube(path, 0.6 * r, 8),
                prism(
                    rounded((s * reach - 0.1, s * reach + 0.5 * s + 0.1 * s), (-0.12, 0.12), 0.05),
                    "z",
                    (tall + 0.4, tall + 0.5),
                ),
            )
        return
    tops = [(0, 0)] if arms == 1 else [(-0.45, 0), (0.45, 0)]
    if arms == 2:
        m.add(BASE, rod((-0.45, 0, tall), (0.45, 0, tall), 0.6 * r, n))
    for x, y in tops:
        if style == "globe":
            m.add(
                BASE,
                ball((x, y, tall + 0.22), (0.2, 0.2, 0.2), n),
                lathe([(0, 0), (0.08, 0), (0.1, 0.08), (0, 0.08)], n, (x, y, tall)),
            )
            continue
        m.add(
            BASE,
            beam((x, y, tall), (x, y, tall + 0.4), 0.2, 0.2, taper=1.7)
            if m.chance(0.4)
            else rod((x, y, tall), (x, y, tall + 0.02), 0.12, 4),
        )
        m.add(
            BASE,
            *(
                rod((x + a * 0.08, y + b * 0.08, tall), (x + a * 0.15, y + b * 0.15, tall + 0.4), 0.01, 6)
                for a in (-1, 1)
                for b in (-1, 1)
            ),
        )
        m.add(BASE, lathe([(0, 0.4), (0.26, 0.4), (0.08, 0.55), (0, 0.62)], m.pick(4, 6, n), (x, y, tall)))
