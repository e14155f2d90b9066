"""Goals and basketball stands of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.still_seats import smooth
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, prism, rectangle, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe


def _mesh(m: Model, corners: Point, across: int, down: int, r: float) -> list[Trimesh]:
    """Make a net between four corners: one open sheet, or cords along and across."""
    a, b, c, d = np.array(corners, float)
    if m.chance(0.25):
        return [Trimesh(np.array([a, b, c, d]), [[0, 1, 2], [0, 2, 3]], process=False)]
    up = [(a + u * (b - a), d + u * (c - d)) for u in np.linspace(0, 1, across)]
    over = [(a + u * (d - a), b + u * (c - b)) for u in np.linspace(0, 1, down)]
    return [rod(*ends, r, 4) for ends in (*up, *over) if np.linalg.norm(ends[1] - ends[0]) > 4 * r]


def _uprights(m: Model, how: str, half: float, high: float, r: float, n: int) -> None:
    """Make two tall posts with a bar between them, on the ground or on one neck."""
    tall = m.number(6, 10)
    tips = (high, tall) if how == "fork" else (0, tall)
    m.add(
        BASE,
        *(rod((s * half, 0, tips[0]), (s * half, 0, tips[1]), r, n) for s in (-1, 1)),
        rod((-half, 0, high), (half, 0, high), r, n),
    )
    pads = [box((s - 0.2, s + 0.2), (-0.2, 0.2), (0, m.number(1.2, 2))) for s in ((0,) if how == "fork" else (-half, half))]
    neck = (
        tube(smooth([(0, 0.8, 0), (0, 0.8, 0.7 * high), (0, 0.7, high), (0, 0, high)]), 1.5 * r, n)
        if m.chance(0.5)
        else rod((0, 0, 0), (0, 0, high), 1.5 * r, n)
    )
    m.add(
        BASE,
        *([neck, box((-0.4, 0.4), (-0.4, 1.2), (-0.1, 0.02))] if how == "fork" else []),
        *(pads if m.chance(0.5) and how == "rugby" else []),
    )
    m.add(
        BASE,
        *m.pick(
            [ball((s * half, 0, tall), (1.6 * r,) * 3, 8) for s in (-1, 1)],
            [box((s * half - 0.2, s * half + 0.2), (-0.2, 0.2), (-0.05, 0.02)) for s in (-1, 1) if how == "rugby"],
            [],
        ),
    )


def _nets(m: Model, half: float, high: float, top: float, deep: float, low: float) -> None:
    """Make the nets of a goal: behind, on top and at both sides."""
    cord, k = m.pick(0.006, 0.012), m.pick(4, 6, 9)
    m.add(BASE, *_mesh(m, [(-half, top, high), (half, top, high), (half, deep, low), (-half, deep, low)], 2 * k, k, cord))
    if top:
        m.add(BASE, *_mesh(m, [(-half, 0, high), (half, 0, high), (half, top, high), (-half, top, high)], 2 * k, 3, cord))
    m.add(
        BASE,
        *(
            s
            for a in (-half, half)
            for s in _mesh(m, [(a, 0, high), (a, max(top, 0.02), high), (a, deep, low), (a, 0, low)], 3, k, cord)
            if m.chance(0.9)
        ),
    )


def goal_post(m: Model) -> None:
    """Make a goal: football or handball with its net and stays, hockey, rugby posts or a fork; nothing moves."""
    how, n, r = m.pick("frame", "frame", "hockey", "rugby", "fork"), m.sections(), m.number(0.03, 0.07)
    half, high = {"frame": (m.number(1.2, 3.6), m.number(1.6, 2.5)), "hockey": (0.9, 1.2)}.get(how, (m.number(2.3, 2.9), 3.0))
    if how in ("rugby", "fork"):
        return _uprights(m, how, half, high, r, n)
    top, deep = m.pick(0.0, 0.3, 0.8) * high / 2, m.number(0.5, 0.9) * high
    square = m.chance(0.3) and how == "frame"

    def post(a: Point, b: Point) -> Trimesh:
        return beam(a, b, 2 * r, 2 * r, (1, 0, 0) if a[0] == b[0] else (0, 0, 1)) if square else rod(a, b, r, n)

    m.add(
        BASE, *(post((s * half, 0, 0), (s * half, 0, high)) for s in (-1, 1)), post((-half - r, 0, high), (half + r, 0, high))
    )
    m.add(BASE, rod((-half, deep, 0.5 * r), (half, deep, 0.5 * r), 0.5 * r, n))
    for s in (-half, half):
        m.add(BASE, rod((s, 0, 0.5 * r), (s, deep, 0.5 * r), 0.5 * r, n))
        path = [(s, 0, high), (s, top, high), (s, deep, 0.5 * r)] if top else [(s, 0, high), (s, deep, 0.5 * r)]
        m.add(BASE, *(rod(a, b, 0.45 * r, 8) for a, b in pairwise(path)))
        bands = [
            box((s - 1.05 * r, s + 1.05 * r), (-1.05 * r, 1.05 * r), (c, c + 0.2)) for c in np.arange(0.2, high - 0.3, 0.4)
        ]
        m.add(BASE, *(bands if square else []))
    _nets(m, half, high, top, deep, 0.5 * r)
    if m.chance(0.3):
        m.add(BASE, *(box((s * half - 0.2, s * half + 0.2), (deep - 0.05, deep + 0.25), (-0.02, 0.15)) for s in (-1, 1)))
    return None


def _basket_support(m: Model, how: str, wide: float, z: float, n: int) -> None:
    """Make what carries the board of a basket."""
    deep, r, mid = m.number(0.7, 1.3), m.number(0.05, 0.08), z + 0.35 * wide
    if how == "wall":
        m.add(BASE, box((-1.5 * wide, 1.5 * wide), (deep, deep + 0.15), (z - 1.0, z + 1.5)))
        return m.add(
            BASE,
            *(
                beam((s * 0.6 * wide, 0.015, c), (s * 0.8 * wide, deep + 0.01, d), 0.05, 0.05)
                for s in (-1, 1)
                for c, d in ((mid, mid), (z + 0.05, mid + 0.3))
            ),
        )
    m.add(BASE, box((-0.2, 0.2), (0.01, 0.07), (mid - 0.15, mid + 0.15)))
    if how == "posts":
        m.add(
            BASE,
            *(rod((s * 0.5 * wide, 0.08, -0.05), (s * 0.5 * wide, 0.08, z + 0.8 * wide), r, n) for s in (-1, 1)),
            rod((-0.5 * wide, 0.08, mid), (0.5 * wide, 0.08, mid), 0.7 * r, n),
        )
        return m.add(
            BASE,
            *(rod((s * 0.5 * wide, 0.08, c), (-s * 0.5 * wide, 0.08, c + 0.6), 0.4 * r, 8) for s in (-1, 1) for c in (0.6,)),
            box((-wide, wide), (-0.3, 0.4), (-0.1, 0)),
        )
    if how == "bent":
        m.add(
            BASE,
            tube(smooth([(0, deep, -0.05), (0, deep, 0.75 * mid), (0, 0.8 * deep, mid), (0, 0.03, mid)]), r, n),
            *([rod((0, deep, 0), (0, deep, 1.6), 2.2 * r, n)] if m.chance(0.5) else []),
        )
        return m.add(
            BASE,
            m.pick(rod((0, deep, -0.08), (0, deep, 0.01), 0.3, n), box((-0.3, 0.3), (deep - 0.3, deep + 0.3), (-0.08, 0.01))),
            *(
                rod((s * 0.2, deep + c, 0), (s * 0.2, deep + c, 0.03), 0.02, 6)
                for s in (-1, 1)
                for c in (-0.2, 0.2)
                if m.chance(0.9)
            ),
        )
    return _basket_box(m, deep, mid)


def _basket_box(m: Model, deep: float, mid: float) -> None:
    """Make a heavy base with a padded post and two arms to the board of a basket."""
    back = deep + 0.9
    m.add(
        BASE,
        prism([(deep, 0), (back, 0), (back, 0.7), (deep + 0.1, 0.5)], "x", (-0.5, 0.5)),
        box((-0.25, 0.25), (deep - 0.06, deep + 0.08), (0, 1.6)),
    )
    m.add(
        BASE,
        beam((0, deep + 0.3, 0.3), (0, deep, mid), 0.14, 0.14),
        *(beam((s * 0.08, deep, c), (s * 0.15, 0.03, c), 0.06, 0.06) for s in (-1, 1) for c in (mid - 0.1, mid + 0.1)),
    )
    m.add(
        BASE,
        *([beam((0, back - 0.1, 0.6), (0, deep, mid - 0.3), 0.06, 0.06)] if m.chance(0.6) else []),
        *(box((-0.55, 0.55), (c, c + 0.1), (-0.05, 0.02)) for c in (deep, back - 0.1)),
    )


def basketball_stand(m: Model) -> None:
    """Make a basket: board, ring and net on a bent pole, a padded stand, two posts or a wall; nothing moves."""
    how, n, wide, t = m.pick("bent", "box", "posts", "wall"), m.sections(), m.number(0.5, 0.9), m.number(0.02, 0.05)
    tall, z, r = 1.15 * wide, m.number(2.0, 3.05), m.number(0.18, 0.23)
    fan = [
        (-0.6 * wide, z - 0.15),
        (0.6 * wide, z - 0.15),
        (wide, z + 0.3),
        (0.7 * wide, z + tall - 0.1),
        (-0.7 * wide, z + tall - 0.1),
        (-wide, z + 0.3),
    ]
    outline = m.pick(
        rectangle((-wide, wide), (z - 0.15, z + tall - 0.15)), rounded((-wide, wide), (z - 0.15, z + tall - 0.15), 0.1), fan
    )
    m.add(BASE, prism(outline, "y", (0, t)))
    m.add(BASE, *([prism(rectangle((-0.3, 0.3), (z + 0.1, z + 0.55), 0.04), "y", (-0.004, 0.002))] if m.chance(0.7) else []))
    if m.chance(0.4):
        m.add(BASE, prism(rectangle((-wide - 0.02, wide + 0.02), (z - 0.17, z + tall - 0.13), 0.05), "y", (-0.01, t + 0.02)))
    m.add(
        BASE,
        ring((0, -r - 0.12, z), (0, 0, 1), r, 0.012, 20),
        box((-0.09, 0.09), (-0.14, 0.004), (z - 0.012, z + 0.008)),
        box((-0.1, 0.1), (-0.012, 0.004), (z - 0.1, z + 0.05)),
    )
    m.add(BASE, *(beam((s * 0.08, 0, z - 0.09), (s * 0.14, -r, z - 0.005), 0.012, 0.012) for s in (-1, 1) if m.chance(0.8)))
    cords, low, k = m.pick("cords", "cone", "none"), 0.4, m.pick(8, 12)
    if cords == "cone":
        net = lathe(
            [(r, z), (0.8 * r, z - 0.2), (0.6 * r, z - low), (0.59 * r, z - low), (0.79 * r, z - 0.2), (0.98 * r, z), (r, z)],
            12,
            (0, -r - 0.12, 0),
        )
        m.add(BASE, net)
    elif cords == "cords":
        for a, turn in ((a, s) for a in 2 * np.pi * np.arange(k) / k for s in (-1, 1)):
            ends = [
                vec(q * np.cos(b), q * np.sin(b) - r - 0.12, c)
                for q, b, c in ((r, a, z), (0.6 * r, a + turn * 4 * np.pi / k, z - low))
            ]
            m.add(BASE, rod(*ends, 0.004, 4))
    _basket_support(m, how, wide, z, n)
