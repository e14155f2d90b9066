"""Playground slides of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.buildings.still_buildings import hipped
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, ball, box, loft, moved, prism, ring, rod, tube, turned, vec
from training.kinds.still.static import boulder
from training.kinds.still.still_plants import UP, bent, out
from training.kinds.still_structures import finish, ladder
from training.kinds.wheels import beam, lathe


def _chute(path: np.ndarray, w: float, rim: float, look: str) -> Trimesh:
    """A slide bed along a side view of (y, z): a flat trough, a round half pipe or a thick slab with sides."""
    t = 0.02
    u = np.linspace(-np.pi / 2, np.pi / 2, 9)
    inner = {"round": np.c_[w * np.sin(u), rim * 1.4 * (1 - np.cos(u))]}.get(
        look, np.array([(-w, rim), (-w, 0), (w, 0), (w, rim)])
    )
    shell = inner * (1 + t / w) + (0, -t)
    line = np.concatenate([inner, shell[::-1]])
    along = np.gradient(path, axis=0)
    normal = np.c_[-along[:, 1], along[:, 0]] / np.linalg.norm(along, axis=1, keepdims=True)
    normal *= np.sign(normal[:, 1:])
    return loft(np.array([np.c_[line[:, 0], p + line[:, 1:] * q] for p, q in zip(path, normal, strict=True)]))


def _spiral(m: Model, z: float, w: float, look: str) -> None:
    """A slide that winds round a post: a trough or a closed pipe."""
    turns, r, steps, way = m.number(0.6, 1.3), 2.2 * w, 28, m.pick(-1, 1)
    a = np.linspace(0, way * 2 * np.pi * turns, steps)
    middle = np.c_[r * np.cos(a), r * np.sin(a), np.linspace(z - 0.1, 0.35, steps)]
    u = (
        np.linspace(0, 2 * np.pi, 12, endpoint=False)
        if look == "pipe"
        else np.r_[np.linspace(-2.8, -0.3, 8), np.linspace(-0.3, -2.8, 8)]
    )
    size = np.full(len(u), w) if look == "pipe" else np.r_[np.full(8, w), np.full(8, 0.93 * w)]
    rings = [q + np.outer(size * np.cos(u), out(b)) + np.outer(size * np.sin(u), UP) for q, b in zip(middle, a, strict=True)]
    parts = m.pick(1, 4, 7)
    for k in range(parts):
        low, high = k * (steps - 1) // parts, (k + 1) * (steps - 1) // parts
        m.add(BASE, loft(np.array(rings[low : high + 1]), caps=look != "pipe"))
        if look == "pipe":
            m.add(BASE, ring(middle[low], np.cross(out(a[low]), UP), w, 0.03, 16))
    m.add(BASE, rod((0, 0, 0), (0, 0, z + m.number(-0.1, 1)), 0.08, 10))
    for k in np.linspace(2, steps - 3, m.pick(3, 5)).astype(int):
        foot = middle[k] - (0, 0, 0.95 * w)
        m.add(BASE, rod((0, 0, foot[2]), foot, 0.04, 8))
    m.add(BASE, box((r - w, r + w), (-way * 1.2, 0), (z - 0.12 - w, z - w + 0.08)))
    m.add(
        BASE,
        *(
            rod((r + s * 0.9 * w, -way * b, 0), (r + s * 0.9 * w, -way * b, z - w + 0.9), 0.04, 8)
            for s in (-1, 1)
            for b in (0.1, 1.1)
        ),
    )
    m.add(
        BASE,
        *(
            rod((r + s * 0.9 * w, -way * 0.1, z - w + 0.9), (r + s * 0.9 * w, -way * 1.1, z - w + 0.9), 0.03, 8)
            for s in (-1, 1)
        ),
    )
    side = 0 if way > 0 else 180
    rungs = ladder((0, -1.2 - 0.25 * z, 0), (0, -1.2, z - w + 0.1), 1.6 * w, m.pick(5, 8), 0.03)
    m.add(BASE, *(moved(turned(s, UP, side, (0, 0, 0)), (r, 0, 0)) for s in rungs))


def _tower(m: Model, w: float, y: Span, z: float, roofed: bool) -> None:
    """The platform of a slide on four posts with panels, a roof and a ladder, steps or a climbing wall behind."""
    t, top, fill = (
        m.number(0.03, 0.06),
        z + (m.number(1.5, 2) if roofed else m.number(0.5, 0.9)),
        m.pick("bars", "panel", "none"),
    )
    round_ = m.chance(0.5)
    for a in (-w, w):
        for b in y:
            m.add(BASE, rod((a, b, 0), (a, b, top), t, 10) if round_ else box((a - t, a + t), (b - t, b + t), (0, top)))
        m.add(BASE, *(rod((a, y[0], z + h), (a, y[1], z + h), 0.6 * t, 8) for h in ((0.45,) if not roofed else (0.4, 0.8))))
        bars = [rod((a, b, z - 0.02), (a, b, z + 0.45), 0.4 * t, 6) for b in np.linspace(*y, 6)[1:-1]]
        m.add(BASE, *{"bars": bars, "panel": [box((a - 0.012, a + 0.012), y, (z, z + 0.5))]}.get(fill, []))
    m.add(BASE, box((-w - t, w + t), (y[0] - t, y[1] + t), (z - 0.06, z)))
    if roofed:
        edge, mid, half = 1.25 * w, np.mean(y), 0.65 * (y[1] - y[0])
        lot = (mid - half, mid + half)
        m.add(
            BASE,
            hipped(
                (-edge, edge), lot, (top - 0.02, top + m.number(0.3, 0.8)), *m.pick((0.001, 0.001), (0.99, 0.001), (0.5, 0.5))
            ),
        )
    how, back = m.pick("ladder", "ladder", "steps", "climb"), m.number(0.15, 0.5) * z
    if how == "steps":
        n = m.pick(4, 6, 8)
        m.add(
            BASE,
            *(box((-w, w), (y[1] + (n - k - 1) * 0.2, y[1] + (n - k) * 0.2), (k * z / n, (k + 1) * z / n)) for k in range(n)),
        )
    elif how == "climb":
        m.add(BASE, beam((0, y[1] + back, 0), (0, y[1] + t, z), 2 * w, 0.04))
        for _ in range(m.pick(5, 9)):
            u = m.number(0.1, 0.9)
            at = vec(m.number(-0.8, 0.8) * w, y[1] + t + back * (1 - u) + 0.03, u * z)
            m.add(BASE, ball(at, (0.05, 0.04, 0.04), 8))
    else:
        m.add(BASE, *ladder((0, y[1] + back, 0), (0, y[1] + t, z + 0.02), 1.6 * w, m.pick(4, 6, 9), 0.025))
        m.add(
            BASE,
            *(
                tube(bent((s * 0.8 * w, y[1] + 0.6 * back, 0.4 * z), (s * w, y[1], z + 0.45), (0, 0.1, 0.1)), 0.02)
                for s in (-1, 1)
            ),
        )


def playground_slide(m: Model) -> None:
    """A straight, wavy or spiral slide from a ladder, a roofed tower, a mound or an animal's body; nothing moves."""
    form, z, w = m.pick("plain", "tower", "tower", "spiral", "mound", "figure"), m.number(0.9, 2.2), m.number(0.22, 0.4)
    look, rim, u = m.pick("flat", "round"), m.number(0.08, 0.2), np.linspace(0, 1, 25)
    if form == "spiral":
        _spiral(m, max(z, 1.5), w, m.pick("trough", "pipe"))
        finish(m)
        return
    long, wave = z * m.number(1.3, 2.0), m.pick(0, 0, 0.08)
    fall = (1 - u) * z - 0.12 * z * np.sin(2 * np.pi * u) + wave * z * np.sin(4 * np.pi * u) * u * (1 - u) * 4 + 0.2 * u**4
    path = np.r_[[(0.25, z + 0.01)], np.c_[-long * u, np.maximum(fall, 0.12) + 0.01], [(-long - 0.3, 0.21)]]
    m.add(BASE, _chute(path, w, rim, look))
    if look == "flat" and m.chance(0.6):
        m.add(BASE, *(tube([(s * w, p[0], p[1] + rim) for p in path[1:-1:2]], 0.025) for s in (-1, 1)))
    m.add(
        BASE,
        *(
            rod((s * 0.8 * w, path[k, 0], 0), (s * 0.8 * w, *path[k]), 0.03, 8)
            for s in (-1, 1)
            for k in m.pick((24,), (14, 24))
        ),
    )
    if form == "mound":
        m.add(
            BASE,
            lathe(
                [(0, -0.05), (1.6 * z, -0.05), (1.2 * z, 0.45 * z), (0.5 * z, 0.92 * z), (0, 0.97 * z)],
                m.pick(8, 14, 24),
                (0, 0.5, 0),
            ),
        )
        m.add(
            BASE, *(box((-w, w), (0.7 + 0.22 * k, 1.1 + 0.22 * k), (0, z * (0.92 - 0.15 * k))) for k in range(m.pick(0, 4, 6)))
        )
        m.add(
            BASE,
            *(boulder(m, 1.5 * z * out(t) + vec(0, 0.5, 0.05), (0.2, 0.25, 0.18)) for t in np.arange(0.2, 3, m.pick(0.5, 9))),
        )
    else:
        _tower(m, w + 0.05, (0.05, m.number(0.5, 1.1)), z, form == "tower")
    if form == "figure":
        head = m.number(0.3, 0.45)
        m.add(BASE, *(prism(arch((-0.3, 1.0), (0, z + 0.8), 0.5), "x", (s * (w + 0.06), s * (w + 0.1))) for s in (-1, 1)))
        m.add(BASE, ball((0, 0.5, z + 0.7 + 0.5 * head), (max(head, w + 0.12), head, head), 14))
        m.add(BASE, *(ball((s * 0.5 * head, 0.5 - 0.8 * head, z + 0.7 + 0.8 * head), (0.07,) * 3, 8) for s in (-1, 1)))
        ears = [ball((s * 0.75 * head, 0.5, z + 0.72 + 1.3 * head), (0.3 * head, 0.2 * head, 0.5 * head), 8) for s in (-1, 1)]
        m.add(BASE, *(ears if m.chance(0.7) else []))
    m.add(BASE, *[box((-2 * w, 2 * w), (-long - 0.6, 1.6), (-0.05, 0.0))][: m.pick(0, 1)])
    finish(m)
