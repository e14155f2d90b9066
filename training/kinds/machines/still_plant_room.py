"""Air ducts and pipe manifolds of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.furniture.still_seats import sizes, smooth
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, prism, rectangle, ring, rod, tube, vec
from training.kinds.still_cladding import maybe_one


def _square_duct(m: Model, a: np.ndarray, b: np.ndarray, half: tuple[float, float], pitch: float) -> None:
    """Make a square duct along an axis with flanges and stiffening ribs."""
    k = int(np.argmax(np.abs(b - a)))
    sides = [i for i in range(3) if i != k]

    def block(low: float, high: float, out: float) -> None:
        """Add a box round the middle line between two places."""
        spans = [(0.0, 0.0)] * 3
        spans[k] = (low, high)
        for i, h in zip(sides, half, strict=True):
            spans[i] = (a[i] - h - out, a[i] + h + out)
        m.add(BASE, box(*spans))

    low, high = sorted((a[k], b[k]))
    low, high = low - half[0] * 0.98, high + half[0] * 0.98
    block(low, high, 0.0)
    for c in np.linspace(low + 0.03, high - 0.03, max(2, round((high - low) / pitch) + 1)):
        block(c - 0.015, c + 0.015, 0.03)


def _grille(m: Model, at: np.ndarray, wide: float, high: float, slats: int) -> None:
    """Make a fixed grille on a face towards -Y: a frame and thin bars."""
    x, z = (at[0] - wide / 2, at[0] + wide / 2), (at[2] - high / 2, at[2] + high / 2)
    m.add(BASE, prism(rectangle(x, z, 0.02), "y", (at[1] - 0.03, at[1] + 0.01)))
    m.add(BASE, *(box(x, (at[1] - 0.02, at[1] + 0.005), (c - 0.004, c + 0.004)) for c in np.linspace(*z, slats + 2)[1:-1]))


def air_duct_run(m: Model) -> None:
    """Make a run of air duct: square, round, ribbed or flat oval, with bends, branches, hangers and grilles; nothing moves."""
    r, long, up, how = (
        m.number(0.12, 0.35),
        m.number(1.5, 4.0),
        m.number(0.6, 1.6),
        m.pick("square", "square", "round", "hose", "oval"),
    )
    form = m.pick("straight", "ell", "ess", "tee", "drop")
    start, corner = np.zeros(3), np.array([long, 0, 0])
    path = {
        "ell": [start, corner, corner + vec(0, up, 0)],
        "ess": [start, corner, corner + vec(0, 0, up), corner + vec(up, 0, up)],
        "drop": [start, corner, corner - vec(0, 0, up)],
    }.get(form, [start, corner])
    if how in ("square", "oval"):
        half, pitch = (r, r if form != "straight" else r * m.number(0.5, 1.0)), m.number(0.3, 1.0)
        for a, b in pairwise(path):
            _square_duct(m, a, b, half, pitch)
        if form == "tee":
            _square_duct(m, corner / 2, corner / 2 - (0, 0, up), (0.7 * r, 0.7 * r), pitch)
    else:
        line, n = smooth(path) if len(path) > 2 else np.array(path), m.pick(10, 16, 24)
        m.add(BASE, tube(line, r, n))
        steps = np.linspace(0, 1, m.pick(3, 5, 8) if how == "round" else 24)
        total = np.r_[0, np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))]
        for s in steps * total[-1]:
            k = min(int(np.searchsorted(total, s, side="right")) - 1, len(line) - 2)
            way = line[k + 1] - line[k]
            at = line[k] + way * (s - total[k]) / (total[k + 1] - total[k])
            m.add(BASE, ring(at, way, 1.01 * r, 0.02 if how == "round" else 0.035, 16))
        if form == "tee":
            m.add(
                BASE,
                rod(corner / 2, corner / 2 - (0, 0, up), 0.7 * r, n),
                ring(corner / 2 - (0, 0, up), (0, 0, 1), 0.7 * r, 0.02),
            )
    for t in m.pick((), (0.25, 0.75), (0.15, 0.5, 0.85)):
        at, top = t * corner, r + m.number(0.3, 0.8)
        m.add(BASE, *(rod((at[0], s * (r + 0.02), -r - 0.03), (at[0], s * (r + 0.02), top), 0.01, 6) for s in (-1, 1)))
        m.add(
            BASE, *(box((at[0] - 0.025, at[0] + 0.025), (-r - 0.06, r + 0.06), (c, c + 0.04)) for c in (-r - 0.04, top - 0.03))
        )
    for t in m.pick((), (), (0.35,), (0.3, 0.6)):
        m.add(BASE, box((t * long - 0.6 * r, t * long + 0.6 * r), (-r - 0.06, 0), (-0.45 * r, 0.45 * r)))
        _grille(m, np.array([t * long, -r - 0.06, 0]), 1.2 * r, 0.9 * r, m.pick(3, 6, 9))
    maybe_one(m, 0.15)


def _header_ends(m: Model, x: Span, z: float, r: float, n: int) -> None:
    """Close both ends of a header with flanges and bolts, domes or collars."""
    for a in x:
        s = np.sign(a)
        cap = m.pick("flange", "dome", "collar")
        if cap == "dome":
            m.add(BASE, ball((a, 0, z), (0.6 * r, r, r), n))
        else:
            m.add(
                BASE,
                rod((a, 0, z), (a + s * 0.4 * r, 0, z), 1.5 * r, n),
                rod((a + s * 0.4 * r, 0, z), (a + s * 0.7 * r, 0, z), (1.5 if cap == "flange" else 0.8) * r, n),
            )
            turns = np.linspace(0, 2 * np.pi, 7)[:-1] if cap == "flange" else ()
            m.add(
                BASE,
                *(
                    rod(
                        (a, 1.25 * r * np.cos(t), z + 1.25 * r * np.sin(t)),
                        (a + s * 0.9 * r, 1.25 * r * np.cos(t), z + 1.25 * r * np.sin(t)),
                        0.12 * r,
                        6,
                    )
                    for t in turns
                ),
            )


def _manifold_mount(m: Model, x: Span, r: float, heads: list[float]) -> None:
    """Carry a manifold on a plate with brackets or on two feet, or not at all."""
    if m.chance(0.5):
        back = r + m.number(0.05, 0.15)
        m.add(BASE, box(shrunk(x, -0.1), (back, back + 0.02), (-2 * r, heads[-1] + 2 * r)))
        m.add(
            BASE,
            *(
                box((a - 0.02, a + 0.02), (0, back + 0.01), (z - 1.15 * r, z + 1.15 * r))
                for a in (0.38 * x[0], 0.38 * x[1])
                for z in heads
            ),
        )
    elif m.chance(0.6):
        low = -m.number(0.3, 0.8)
        for a in (0.42 * x[0], 0.42 * x[1]):
            m.add(
                BASE,
                box((a - 0.03, a + 0.03), (-0.03, 0.03), (low, 0)),
                box((a - 0.08, a + 0.08), (-0.12, 0.12), (low - 0.015, low)),
            )


def pipe_manifold(m: Model) -> None:
    """Make a manifold without valves: headers, branches, flanges with bolts, caps, brackets and a plate; nothing moves."""
    wide, high, r, gap = sizes(m, (0.5, 2.5), (0.3, 1.2), (0.03, 0.1), (0.15, 0.35))
    x, n, count, small = (-wide / 2, wide / 2), m.pick(10, 16, 24), m.pick(2, 3, 4, 6, 8), m.number(0.35, 0.7) * r
    heads, how = [0.0, high][: m.pick(1, 2, 2)], m.pick("straight", "bends", "loops", "fan")
    for z in heads:
        m.add(BASE, rod((x[0], 0, z), (x[1], 0, z), r, n))
        _header_ends(m, x, z, r, n)
    for k, a in enumerate(np.linspace(*shrunk(x, 0.12 * wide), count)):
        end = (a, 0, high) if len(heads) > 1 else (a, 0, m.number(0.8, 1.0) * high)
        path = [(a, 0, 0), end]
        if how == "bends":
            path = [(a, 0, 0), (a, -gap, 0), (a, -gap, end[2]), (a, 0 if len(heads) > 1 else -2 * gap, end[2])]
        elif how == "loops":
            path = [(a, 0, 0), (a, 0, 0.3 * high), (a, -gap, 0.3 * high), (a, -gap, 0.7 * high), (a, 0, 0.7 * high), end]
        elif how == "fan" and len(heads) == 1:
            path = [(a, 0, 0), (a, 0, 0.4 * high), (1.5 * a, -gap, high)]
        line = smooth(path) if len(path) > 2 else np.array(path, float)
        m.add(BASE, tube(line, small, m.pick(8, 12)))
        joint = (line[0] + line[1]) / 2 if len(path) == 2 else line[1]
        m.add(
            BASE,
            *[ring(line[len(line) // 2], line[len(line) // 2] - line[len(line) // 2 - 1], small, 0.3 * small, 12)][
                : m.pick(0, 1)
            ],
        )
        if len(heads) == 1:
            way = line[-1] - line[-2]
            m.add(BASE, rod(line[-1], line[-1] + 0.3 * r * way / np.linalg.norm(way), 1.6 * small, n))
        elif k % 2 and m.chance(0.5):
            m.add(BASE, ball(joint, (1.5 * small,) * 3, 10))
    _manifold_mount(m, x, r, heads)
    maybe_one(m, 0.15)
