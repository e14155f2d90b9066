"""Watch posts and water towers of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.buildings.still_buildings import hipped, stage
from training.kinds.model import BASE, Model
from training.kinds.solids import arch, around, ball, box, prism, rectangle, ring, rod, tube, turned, vec
from training.kinds.still.still_plants import UP, out
from training.kinds.still_structures import circle, finish, ladder, railing, roof
from training.kinds.wheels import beam, lathe


def _stand(m: Model, w: float, z: float, splay: float, tiers: int) -> None:
    """Four legs with rails and crossed braces that carry a platform."""
    t, cross = m.number(0.06, 0.12), m.pick("x", "one", "none")
    r = np.linspace(w + splay, w, tiers + 1)
    level = np.linspace(0, z, tiers + 1)
    for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
        m.add(BASE, beam((a * r[0], b * r[0], 0), (a * w, b * w, z), 1.3 * t, 1.3 * t))
        for k in range(tiers):
            p, q = vec(a * r[k], b * r[k], level[k]), vec(-b * r[k], a * r[k], level[k])
            u, v = vec(a * r[k + 1], b * r[k + 1], level[k + 1]), vec(-b * r[k + 1], a * r[k + 1], level[k + 1])
            sides = [
                beam(u, v, t, t, UP),
                *{"x": [beam(p, v, t, 0.5 * t, UP), beam(q, u, t, 0.5 * t, UP)], "one": [beam(p, v, t, t, UP)]}.get(cross, []),
            ]
            m.add(BASE, *sides)


def _bunker(m: Model, w: float) -> None:
    """A many-sided bunker with slits, perhaps behind sandbags."""
    n, r = m.pick(6, 8, 12), w * 1.6
    away = 1.1 * r + 0.15
    m.add(BASE, stage([(1.1 * r, 0), (r, 0.8)], n), stage([(0.75 * r, 0.8), (0.75 * r, 1.2)], n))
    m.add(BASE, stage([(1.1 * r, 1.15), (1.05 * r, 1.4), (0.7 * r, 1.6)], n))
    m.add(BASE, *around(box((-0.1, 0.1), (-0.98 * r * np.cos(np.pi / n), -0.6 * r), (0.7, 1.2)), n))
    m.add(
        BASE,
        *(
            ball((away * np.cos(a), away * np.sin(a), h), (0.25, 0.25, 0.11), 8)
            for h in (0.1, 0.28)[: m.pick(0, 1, 2)]
            for a in np.arange(3.5, 6.0, 0.36 / r)
        ),
    )


def _sentry_box(m: Model, w: float) -> None:
    """A box with an open front under a peaked roof."""
    t, z = 0.08, m.number(2.0, 2.6)
    m.add(
        BASE,
        box((-w / 2, w / 2), (0.4, 0.4 + t), (0, z)),
        *(box((s * w / 2 - t, s * w / 2), (-0.5, 0.4), (0, z)) for s in (-1, 1)),
    )
    front = rectangle((-w / 2 - t, w / 2), (0, z)).difference(arch((-0.35 * w, 0.35 * w - t), (-0.1, 0.85 * z), 0.3 * w))
    m.add(BASE, *[prism(front, "y", (-0.55, -0.5))][: m.pick(0, 1)], box((-0.6 * w, 0.6 * w), (-0.6, 0.55), (-0.12, 0)))
    m.add(BASE, *(beam((s * w / 2, -0.5, 0.1), (s * w / 2, 0.4, z - 0.1), 0.04, 0.1) for s in (-1, 1) if m.chance(0.5)))
    m.add(
        BASE,
        box((-0.55 * w, 0.55 * w), (-0.6, 0.55), (z - 0.02, z + 0.06)),
        hipped((-0.6 * w, 0.6 * w), (-0.65, 0.6), (z + 0.05, z + m.number(0.2, 0.9)), m.pick(0.001, 0.6), m.pick(0.001, 0.3)),
    )


def _cover(m: Model, cover: str, edge: float, top: float) -> None:
    """The roof of a guard tower."""
    if cover == "hip":
        m.add(
            BASE,
            hipped(
                (-1.2 * edge, 1.2 * edge),
                (-1.2 * edge, 1.2 * edge),
                (top + 0.03, top + m.number(0.5, 1.5)),
                *m.pick((0.001, 0.001), (0.5, 0.1)),
            ),
        )
    elif cover == "gable":
        roof(m, edge, (-edge, edge), top + 0.05, 0.7)
    elif cover == "lean":
        m.add(
            BASE,
            turned(box((-1.2 * edge, 1.2 * edge), (-1.2 * edge, 1.2 * edge), (top, top + 0.08)), (1, 0, 0), -8, (0, edge, top)),
        )


def watch_post(m: Model) -> None:
    """A guard tower on legs, a sentry box, a bunker with sandbags or a hunter's stand; nothing moves."""
    form, w, z, tiers = (
        m.pick("tower", "tower", "box", "bunker", "hunter"),
        m.number(0.8, 1.6),
        m.number(2.5, 6),
        m.pick(1, 2, 3),
    )
    if form == "bunker":
        _bunker(m, w)
        finish(m)
        return
    if form == "box":
        _sentry_box(m, w)
        finish(m)
        return
    splay = m.pick(0, 0.3, 0.6)
    _stand(m, w, z, splay, tiers)
    edge, count = w + m.number(0.05, 0.4), m.pick(1, 6, 10)
    cut = np.linspace(-edge, edge, count + 1)
    m.add(BASE, *(box((a, b - 0.02 * (count > 1)), (-edge, edge), (z, z + 0.08)) for a, b in pairwise(cut)))
    m.add(BASE, *ladder((0, -edge - m.number(0.05, 0.3) * z, 0), (0, -edge - 0.02, z + 0.6), 0.5, m.pick(6, 9, 12), 0.03))
    q = [(-0.35, -edge), (-edge, -edge), (-edge, edge), (edge, edge), (edge, -edge), (0.35, -edge)]
    side, cover, top = m.pick("rail", "boards", "none"), m.pick("hip", "gable", "lean", "none"), z + m.number(1.8, 2.3)
    inner = [(a * 0.96, b * 0.96, z + 0.05) for a, b in q]
    m.add(BASE, *(railing(inner, 0.95, 0.035, m.pick(1, 2, 3)) if side != "none" or form == "hunter" else []))
    m.add(
        BASE, *(beam(vec(*a) + UP * 0.45, vec(*b) + UP * 0.45, 0.8, 0.03, UP) for a, b in pairwise(inner) if side == "boards")
    )
    if cover != "none":
        m.add(
            BASE,
            *(
                beam((a, b, z), (a, b, top + 0.05), 0.09, 0.09)
                for a in (-0.9 * edge, 0.9 * edge)
                for b in (-0.9 * edge, 0.9 * edge)
            ),
        )
        m.add(BASE, box((-edge, edge), (-edge, edge), (top, top + 0.06)))
    _cover(m, cover, edge, top)
    finish(m)


def _tank(m: Model, form: str, r: float, z: float, n: int) -> float:
    """The vessel of a water tower above a height; returns its half width where a gallery goes."""
    tall = r * m.number(1.0, 1.9)
    if form == "wood":
        m.add(BASE, rod((0, 0, z), (0, 0, z + tall), r, n), rod((0, 0, z - 0.06 * r), (0, 0, z), 1.1 * r, n))
        m.add(BASE, *(ring((0, 0, z + u * tall), UP, r, 0.02 * r) for u in np.linspace(0.06, 0.92, m.pick(3, 5, 7))))
        m.add(
            BASE,
            lathe([(0, 0), (1.12 * r, 0), (0.02 * r, m.number(0.3, 0.9) * r), (0, m.number(0.9, 1) * r)], n, (0, 0, z + tall)),
        )
        slats = around(box((-0.1 * r, 0.1 * r), (-1.02 * r, -0.95 * r), (z, z + tall)), m.pick(16, 20))
        m.add(BASE, *slats[:: m.pick(1, 1, 99)])
    elif form == "steel":
        cup = [(r * np.cos(a), 0.5 * r * np.sin(a)) for a in np.linspace(-np.pi / 2, 0, 6)]
        m.add(BASE, lathe([*cup, (r, tall), (0.06 * r, tall + m.number(0.3, 0.6) * r), (0, tall + 0.6 * r)], n, (0, 0, z)))
        m.add(BASE, *(ring((0, 0, z + u * tall), UP, r, 0.015 * r) for u in m.pick((), (0.0, 1.0), (0.33, 0.66))))
        m.add(BASE, rod((0, 0, z + tall + 0.4 * r), (0, 0, z + tall + 0.75 * r), 0.12 * r, 8))
    else:
        flat = m.number(0.55, 1.0)
        m.add(BASE, ball((0, 0, z + 0.8 * flat * r), (r, r, flat * r), max(n, 12)))
        m.add(BASE, *[rod((0, 0, z + 1.7 * flat * r), (0, 0, z + 1.95 * flat * r), 0.3 * r, 12)][: m.pick(0, 1)])
        m.add(BASE, *[ring((0, 0, z + 0.8 * flat * r), UP, r, 0.02 * r)][: m.pick(0, 1)])
    return r


def _mushroom(m: Model, r: float, z: float, n: int) -> None:
    """A concrete bowl on a stalk."""
    w, tall = 0.3 * r, 0.8 * r
    m.add(
        BASE,
        stage([(w, 0), (0.8 * w, 0.5 * z), (w, z)], n),
        stage([(w, z), (1.2 * r, z + tall), (1.2 * r, z + 1.2 * tall), (0.2 * r, z + 1.5 * tall)], n),
    )
    m.add(
        BASE, *around(box((-0.05 * r, 0.05 * r), (-1.2 * r, -w), (z + 0.9 * tall, z + tall)), m.pick(8, 12))[:: m.pick(1, 99)]
    )
    m.add(BASE, *around(box((-0.05 * r, 0.05 * r), (-1.2 * w, -0.5 * w), (0, z)), m.pick(4, 6, 8))[:: m.pick(1, 99)])


def water_tower(m: Model) -> None:
    """A tank of staves or steel on braced legs, a sphere on a stalk or a concrete mushroom; nothing moves."""
    form, r, n = m.pick("wood", "steel", "sphere", "mushroom"), m.number(1.5, 3), m.pick(8, 12, 16, 24)
    z, k, tiers = r * m.number(1.5, 4), m.pick(4, 6, 8), m.pick(1, 2, 3)
    if form == "mushroom":
        _mushroom(m, r, z, n)
    elif form == "sphere" and m.chance(0.6):
        m.add(
            BASE,
            lathe(
                [(0, 0), (0.7 * r, 0), (0.3 * r, 0.25 * z), (0.25 * r, 0.8 * z), (0.5 * r, z + 0.1 * r), (0, z + 0.1 * r)], n
            ),
        )
        _tank(m, form, r, z, n)
    else:
        foot, top, cross = r * m.number(0.9, 1.3), 0.85 * r, m.pick("x", "ring", "one")
        up, t = z + (0.3 * r if form in ("steel", "sphere") else 0), 0.04 * r
        for a in 2 * np.pi * (np.arange(k) + 0.5) / k:
            u, v = out(a), out(a + 2 * np.pi / k)
            m.add(
                BASE,
                beam(foot * u, top * u + up * UP, 2 * t, 2 * t),
                box(*((q - 3 * t, q + 3 * t) for q in foot * u[:2]), (-0.1, 0.1)),
            )
            for i in range(tiers):
                p, q = ((foot + (top - foot) * j / tiers, UP * up * j / tiers) for j in (i, i + 1))
                m.add(BASE, rod(q[0] * u + q[1], q[0] * v + q[1], 0.7 * t, 6))
                m.add(
                    BASE,
                    *[rod(p[0] * u + p[1], q[0] * v + q[1], 0.4 * t, 6), rod(p[0] * v + p[1], q[0] * u + q[1], 0.4 * t, 6)][
                        : {"x": 2, "one": 1}.get(cross, 0)
                    ],
                )
        _tank(m, form, r, z, n)
        if m.chance(0.6):
            level = z if form == "wood" else up
            m.add(
                BASE,
                lathe([(0.8 * r, 0), (1.3 * r, 0), (1.3 * r, 0.03 * r), (0.8 * r, 0.03 * r), (0.8 * r, 0)], n, (0, 0, level)),
            )
            m.add(BASE, *railing(circle(1.27 * r, level, m.pick(8, 12)), 0.4 * r, 0.02 * r, m.pick(1, 2)))
        m.add(BASE, *[rod((0, 0, 0), (0, 0, z + 0.1), m.number(0.05, 0.15) * r, 12)][: m.pick(0, 1)])
        pipe = [(0.5 * r, 0, z + 0.1), (0.5 * r, 0, 0.6 * z), (0.2 * r, 0, 0.5 * z), (0.2 * r, 0, 0)]
        m.add(
            BASE,
            *[tube(pipe, 0.05 * r)][: m.pick(0, 0, 1)],
            *ladder((0, -1.32 * r, 0), (0, -0.92 * r, z + 0.8 * r), 0.5, m.pick(8, 14), 0.03)[: m.pick(0, 99, 99)],
        )
    m.add(BASE, *[box((-1.6 * r, 1.6 * r), (-1.6 * r, 1.6 * r), (-0.2, 0))][: m.pick(0, 1)])
    finish(m)
