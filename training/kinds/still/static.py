"""Objects without any movable part: statue, rocks, brick wall, plant."""

from __future__ import annotations

import numpy as np
import trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, loft, ring, rod, tube, vec
from training.kinds.wheels import beam, lathe


def boulder(m: Model, at, radii) -> trimesh.Trimesh:
    """A bumpy stone: the hull of random points or a shaken ball."""
    if m.chance(0.5):
        points = m.rng.normal(size=(m.pick(12, 20, 40), 3))
        solid = trimesh.convex.convex_hull(points / np.linalg.norm(points, axis=1, keepdims=True))
    else:
        solid = trimesh.creation.icosphere(subdivisions=m.pick(1, 2))
        solid.vertices *= m.rng.uniform(0.8, 1.15, (len(solid.vertices), 1))
    solid.apply_scale(radii)
    return solid.apply_translation(at)


def statue(m: Model) -> None:
    """A figure, bust, urn or obelisk on a plinth with mouldings; nothing moves."""
    half, high, n = m.number(0.25, 0.5), m.number(0.4, 1.4), m.pick(12, 20, 32)
    round_ = m.chance(0.3)
    steps = [(1.0, 0, 0.08), (0.8, 0.08, high - 0.06), (0.95, high - 0.06, high)]
    for size, a, b in steps:
        s = size * half
        m.add(BASE, rod((0, 0, a), (0, 0, b), s, n) if round_ else box((-s, s), (-s, s), (a, b)))
    if m.chance(0.6) and not round_:  # a plate that looks like a door
        s = 0.8 * half
        m.add(BASE, box((-0.6 * s, 0.6 * s), (-s - 0.015, -s), (0.15, high - 0.12)))
        m.add(
            BASE,
            *(rod((x, -s - 0.025, z), (x, -s - 0.01, z), 0.012, 8) for x in (-0.5 * s, 0.5 * s) for z in (0.2, high - 0.17)),
        )
    form, z = m.pick("figure", "bust", "urn", "obelisk"), high
    if form == "obelisk":
        m.add(BASE, beam((0, 0, z), (0, 0, z + 3 * half), half, half, taper=0.6))
        m.add(BASE, beam((0, 0, z + 3 * half), (0, 0, z + 3.4 * half), 0.6 * half, 0.6 * half, taper=0.05))
    elif form == "urn":
        shape = [
            (0, 0),
            (0.3, 0),
            (0.1, 0.15),
            (0.1, 0.25),
            (0.45, 0.7),
            (0.5, 0.95),
            (0.3, 1.1),
            (0.4, 1.2),
            (0.35, 1.2),
            (0.2, 1.0),
            (0, 0.9),
        ]
        m.add(BASE, lathe(half * 1.4 * np.array(shape), n, (0, 0, z)))
        m.add(
            BASE,
            *(
                ring((s * 0.65 * half, 0, z + 1.15 * half), (0, 1, 0), 0.2 * half, 0.04 * half, 12)
                for s in (-1, 1)
                if round_ or m.chance(0.7)
            ),
        )
    else:
        u = 0.22 * half / 0.35
        tall = 0.0 if form == "bust" else 3.2 * u
        for s in (-1, 1) if tall else ():
            m.add(BASE, rod((s * 0.5 * u, m.number(-0.4, 0.4) * u, z), (s * 0.45 * u, 0, z + tall), 0.38 * u, n))
        hip = z + tall
        m.add(
            BASE,
            loft(
                np.array(
                    [
                        _oval(w * u, d * u, hip + k * u, n)
                        for w, d, k in ((0.9, 0.5, -0.2), (0.75, 0.45, 1), (1.1, 0.6, 2.2), (0.4, 0.35, 2.7))
                    ]
                )
            ),
        )
        m.add(
            BASE,
            rod((0, 0, hip + 2.5 * u), (0, 0, hip + 3.1 * u), 0.3 * u, n),
            ball((0, 0, hip + 3.6 * u), (0.5 * u, 0.6 * u, 0.7 * u), n),
        )
        for s in (-1, 1) if tall else ():
            hand = vec(s * m.number(0.8, 2.0), m.number(-1.5, 0.2), m.number(0, 3.5)) * u + vec(0, 0, hip)
            m.add(BASE, tube([vec(s * u, 0, hip + 2.2 * u), vec(s * 1.4 * u, -0.2 * u, hip + 1.3 * u), hand], 0.22 * u, 8))


def _oval(a: float, b: float, z: float, n: int):
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return np.c_[a * np.cos(t), b * np.sin(t), np.full(n, z)]


def rock_pile(m: Model) -> None:
    """Stones of many sizes on a heap, perhaps with a slab or a post; nothing moves."""
    count, spread = m.pick(1, 4, 9, 16), m.number(0.3, 1.2)
    for _ in range(count):
        t, away = m.number(0, 2 * np.pi), spread * m.number(0, 1) * (count > 1)
        size = m.number(0.1, 0.4) * (1.2 - 0.6 * away / spread)
        radii = size * np.array([m.number(0.7, 1.3), m.number(0.7, 1.3), m.number(0.5, 1.0)])
        m.add(
            BASE,
            boulder(
                m, (away * np.cos(t), away * np.sin(t), 0.6 * radii[2] + 0.3 * max(0, spread - away) * m.number(0, 1)), radii
            ),
        )
    if m.chance(0.4):
        m.add(BASE, boulder(m, (0, 0, -0.05), (1.4 * spread, 1.4 * spread, 0.1)))
    if m.chance(0.3):
        m.add(BASE, box((-0.05, 0.05), (-0.04, 0.04), (0, 1.1)), box((-0.3, 0.3), (-0.06, -0.04), (0.8, 1.05)))


def brick_wall(m: Model) -> None:
    """A piece of wall of single bricks or blocks with a coping, perhaps a pillar and a blind arch; nothing moves."""
    length, high, each = m.number(0.22, 0.4), m.number(0.065, 0.19), m.number(0.003, 0.012)
    rows, cols, deep = m.pick(4, 6, 9), m.pick(3, 4, 6), 0.5 * length
    whole = m.chance(0.4)
    for r in range(rows):
        z = (r * high, (r + 1) * high - each)
        start = -0.5 * length * (r % 2)
        for c in range(cols + r % 2):
            x = max(0.0, start + c * length), min(cols * length, start + (c + 1) * length) - each
            y = m.number(-0.004, 0.004)
            if not whole or m.chance(0.97):
                m.add(BASE, box(x, (y, y + deep), z))
    wide, tall = cols * length, rows * high
    if m.chance(0.6):
        m.add(BASE, box((0, wide), (0.02, deep - 0.02), (0, tall - each)))  # mortar
    if m.chance(0.6):
        m.add(BASE, box((-0.03, wide + 0.03), (-0.04, deep + 0.04), (tall, tall + 0.06)))
    for x in (0, wide)[: m.pick(0, 1, 2)]:
        m.add(
            BASE,
            box((x - 0.15, x + 0.15), (deep / 2 - 0.2, deep / 2 + 0.2), (0, tall + 0.15)),
            ball((x, deep / 2, tall + 0.28), (0.14,) * 3, 12),
        )
    if m.chance(0.4):
        m.add(BASE, box((0.3 * wide, 0.6 * wide), (-0.03, 0.0), (0.2 * tall, 0.8 * tall)))


def potted_plant(m: Model) -> None:
    """A pot with earth, a saucer, and leaves on stems or a trunk with a crown; nothing moves."""
    r, high, n = m.number(0.08, 0.2), m.number(0.12, 0.35), m.pick(4, 8, 16, 24)
    m.add(
        BASE,
        lathe(
            [
                (0, 0),
                (0.7 * r, 0),
                (0.95 * r, 0.8 * high),
                (1.1 * r, 0.82 * high),
                (1.1 * r, high),
                (0.95 * r, high),
                (0.85 * r, 0.85 * high),
                (0, 0.85 * high),
            ],
            n,
        ),
    )
    if m.chance(0.5):
        m.add(BASE, lathe([(0, -0.015), (r, -0.015), (1.15 * r, 0.02), (1.1 * r, 0.02), (0.95 * r, 0), (0, 0)], n))
    style, top = m.pick("leaves", "tree", "cactus"), 0.85 * high
    if style == "cactus":
        tall = m.number(0.2, 0.6)
        m.add(BASE, rod((0, 0, top), (0, 0, top + tall), 0.35 * r, 10), ball((0, 0, top + tall), (0.35 * r,) * 3, 10))
        for s in (-1, 1)[: m.pick(0, 1, 2)]:
            m.add(
                BASE,
                tube(
                    [(0, 0, top + 0.4 * tall), (s * r, 0, top + 0.45 * tall), (s * r, 0, top + m.number(0.6, 0.9) * tall)],
                    0.2 * r,
                    8,
                ),
            )
        return
    crown = top
    if style == "tree":
        crown = top + m.number(0.3, 1.0)
        m.add(BASE, rod((0, 0, top), (0.02, 0, crown), 0.02, 8))
        if m.chance(0.5):
            m.add(
                BASE,
                *(
                    boulder(m, (m.number(-r, r), m.number(-r, r), crown + m.number(0, r)), (r, r, 0.8 * r))
                    for _ in range(m.pick(1, 3, 5))
                ),
            )
            return
    for _ in range(m.pick(8, 14, 24)):
        t, reach, rise = m.number(0, 2 * np.pi), m.number(1.0, 2.2) * r, m.number(0.1, 0.5)
        a, out = vec(0, 0, crown), vec(np.cos(t), np.sin(t), 0)
        b, c = a + 0.5 * reach * out + vec(0, 0, rise), a + reach * out + vec(0, 0, 0.8 * rise)
        side, w = vec(-np.sin(t), np.cos(t), 0), m.number(0.15, 0.35) * r
        points = [a, b + w * side, b - w * side, c]
        m.add(BASE, trimesh.Trimesh(points, [[0, 1, 2], [1, 3, 2]], process=False))
        if m.chance(0.5):
            m.add(BASE, rod(a, b, 0.003, 5))
