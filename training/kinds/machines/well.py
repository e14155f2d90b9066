"""Wells with a winch."""

from __future__ import annotations

import numpy as np
from shapely.geometry import MultiPolygon, Polygon
from shapely.geometry import box as window
from shapely.ops import unary_union
from trimesh import Trimesh

from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod, tube, vec
from training.kinds.wheels import beam


def well_winch(m: Model) -> None:
    """A round or square well with posts and a crank drum; the bucket hangs or stands, there may be a roof, a lid, a pawl."""
    r, high, n = m.number(0.42, 0.6), m.number(0.55, 0.85), m.pick(12, 16, 24)
    square = _well_wall(m, r, high, n)
    drum, post, wide = high + m.number(0.45, 0.65), high + m.number(0.95, 1.2), m.number(0.04, 0.06)
    x = r - m.pick(-wide, wide)
    feet = (0.0,) if m.chance(0.7) else (-0.3, 0.3)
    for s in (-1, 1):
        m.add(BASE, *(beam((s * x, b, 0.3 if abs(x) < r else 0), (s * x, 0, post), 2 * wide, 2 * wide) for b in feet))
    d = m.number(0.06, 0.1)
    _drum(m, x, x - wide - 0.02, drum, d, n)
    if m.chance(0.35):
        teeth = np.linspace(0, 2 * np.pi, 24, endpoint=False)
        q = np.where(np.arange(24) % 2, 0.13, 0.105)
        m.add("drum", prism(np.c_[q * np.cos(teeth), drum + q * np.sin(teeth)], "x", (-x - 0.075, -x - 0.055)))
        pin = vec(-x - 0.065, 0.02, drum + 0.22)
        m.add(
            "pawl", beam(pin, pin + vec(0, 0.05, -0.11), 0.018, 0.025), rod(pin - (0.02, 0, 0), pin + vec(0.065, 0, 0), 0.01, 8)
        )
        m.hinge("pawl", pin, (1, 0, 0), 60)
    lid = not square and m.chance(0.35)
    if lid or m.chance(0.35):
        at = vec(0.0, 0.5 * r, high + 0.03) if lid else vec(-0.3, -r - 0.35, 0)
        m.add(BASE, *_bucket(at, n))
        if lid:
            m.add(BASE, rod((0, 0, drum - d), at + vec(0, 0, 0.01), 0.008, 6))
        _bail(m, at)
    else:
        at = vec(m.number(-0.1, 0.1), -d - 0.01, high + m.number(-0.1, 0.05))
        m.add("bucket", *_bucket(at, n), rod(at + vec(0, 0, 0.4), (at[0], at[1], drum), 0.008, 6))
        hoop = [at + vec(a, 0, b) for a, b in ((-0.12, 0.22), (-0.08, 0.37), (0, 0.4), (0.08, 0.37), (0.12, 0.22))]
        m.add("bucket", tube(hoop, 0.006, 6))
        m.slide("bucket", (0, 0, -1), m.number(0.3, 0.55))
    if lid:
        _well_lid(m, r, high)
    if m.chance(0.6):
        _well_roof(m, x, post, wide)
    else:
        m.add(BASE, box((-x - 0.1, x + 0.1), (-wide, wide), (post - 0.04, post + 0.04)))


def _drum(m: Model, x: float, length: float, drum: float, d: float, n: int) -> None:
    m.add("drum", rod((-length, 0, drum), (length, 0, drum), d, n), rod((-x - 0.08, 0, drum), (x + 0.12, 0, drum), 0.018, 8))
    coil = m.number(0.15, 0.3)
    m.add("drum", *(ring((c, 0, drum), (1, 0, 0), d + 0.008, 0.01, 12) for c in np.arange(-coil, coil, 0.03)))
    m.add("drum", *(rod((s * length, 0, drum), (s * (length - 0.02), 0, drum), 1.5 * d, n) for s in (-1, 1) if m.chance(0.5)))
    for s in (-1, 1) if m.chance(0.2) else (1,):
        arm = vec(s * (x + 0.11), -0.3 * s, drum)
        m.add("drum", beam((arm[0], 0, drum), arm, 0.02, 0.03), rod(arm, arm + vec(s * 0.16, 0, 0), 0.018, 10))
    m.spin("drum", (0, 0, drum), (1, 0, 0))


def _well_roof(m: Model, x: float, post: float, wide: float) -> None:
    out, deep, up = x + 0.2, m.number(0.5, 0.8), m.number(0.3, 0.45)
    for s in (-1, 1):
        m.add(BASE, beam((0, s * deep, post - 0.02), (0, 0, post + up), 2 * out, 0.03))
        m.add(
            BASE,
            *(beam((c, s * deep * 0.8, post - 0.04 + 0.2 * up), (c, 0, post + up - 0.04), 0.05, 0.05) for c in (-x, x)),
        )
        m.add(
            BASE,
            *(
                beam(
                    (0, s * deep * f, post + up * (1 - f) + 0.02),
                    (0, s * deep * (f - 0.06), post + up * (1.06 - f) + 0.02),
                    2 * out,
                    0.03,
                )
                for f in (0.35, 0.68, 1.0)
            ),
        )
    m.add(BASE, *(box((c - wide, c + wide), (-wide, wide), (post - 0.05, post + up - 0.03)) for c in (-x, x)))


def _well_wall(m: Model, r: float, high: float, n: int) -> bool:
    style, t = m.pick("smooth", "stones", "square"), m.number(0.1, 0.16)
    if style == "square":
        for k, z in enumerate(np.arange(0.0, high - 0.01, high / 5)):
            span = (z, z + 0.95 * high / 5)
            lap = 0.06 * (k % 2)
            m.add(BASE, *(box((-r - lap, r + lap), sorted((s * r, s * (r - t))), span) for s in (-1, 1)))
            m.add(BASE, *(box(sorted((s * r, s * (r - t))), (-r + t - lap, r - t + lap), span) for s in (-1, 1)))
        return True
    if style == "smooth":
        m.add(
            BASE, lathe([(r, 0), (r, high - 0.06), (r + 0.04, high - 0.06), (r + 0.04, high), (r - t, high), (r - t, 0.02)], n)
        )
        return False
    rows, count = m.pick(4, 5, 6), m.pick(12, 14, 16)
    for k in range(rows):
        for a in 2 * np.pi * (np.arange(count) + 0.5 * (k % 2)) / count:
            c, s = np.cos(a), np.sin(a)
            wide, z = 2 * np.pi * r / count * m.number(0.85, 0.97), (k + 0.5) * high / rows
            m.add(
                BASE,
                beam(
                    ((r - t) * c, (r - t) * s, z),
                    ((r + m.number(0, 0.03)) * c, (r + 0.02) * s, z),
                    wide,
                    0.97 * high / rows,
                    (-s, c, 0),
                ),
            )
    return False


def _bucket(at: np.ndarray, n: int) -> list[Trimesh]:
    rim = [(0.1, 0), (0.13, 0.24), (0.12, 0.24), (0.092, 0.012)]
    return [lathe(rim, n, at), *(ring(at + vec(0, 0, z), (0, 0, 1), q, 0.006, n) for z, q in ((0.05, 0.107), (0.2, 0.126)))]


def _bail(m: Model, at: np.ndarray) -> None:
    arc = [at + vec(0.136 * np.cos(t), -0.136 * np.sin(t), 0.215 + 0.02 * np.sin(t)) for t in np.linspace(0, np.pi, 9)]
    m.add("bail", tube(arc, 0.005, 6), *(ball(end, (0.01,) * 3, 6) for end in (arc[0], arc[-1])))
    m.hinge("bail", at + vec(0, 0, 0.215), (-1, 0, 0), m.pick(90, 160))


def _well_lid(m: Model, r: float, high: float) -> None:
    for part, s in ((BASE, 1), ("lid", -1)):
        t = np.linspace(0, np.pi, 13)
        disc = Polygon(np.c_[1.02 * r * np.cos(t), s * 1.02 * r * np.sin(t) + s * 0.003])
        boards = disc.difference(
            unary_union([window(c - 0.004, -2, c + 0.004, 2) for c in np.linspace(-0.6, 0.6, m.pick(4, 6)) * r])
        )
        m.add(
            part,
            *(
                prism(g, "z", (high + 0.002, high + 0.027))
                for g in (boards.geoms if isinstance(boards, MultiPolygon) else [boards])
            ),
        )
        m.add(part, box((-0.7 * r, 0.7 * r), sorted((s * 0.25 * r, s * 0.38 * r)), (high + 0.027, high + 0.045)))
    m.add("lid", ring((0, -0.8 * r, high + 0.035), (1, 0, 0), 0.04, 0.007, 12))
    m.add(BASE, *(rod((c - 0.05, 0, high + 0.027), (c + 0.05, 0, high + 0.027), 0.01, 8) for c in (-0.5 * r, 0.5 * r)))
    m.hinge("lid", (0, 0, high + 0.027), (-1, 0, 0), m.pick(50, 60))
