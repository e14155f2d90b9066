"""Things of streets, squares and camps of which nothing moves: signs, crosses, bollards, fountains, stalls, tents."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from jaxtyping import Float
from shapely.geometry import LineString, Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, around, ball, box, loft, moved, prism, rectangle, ring, rod, tube, turned, vec
from training.kinds.still.static import boulder, statue
from training.kinds.wheels import beam

GLYPHS = ("602", "618", "6802", "0628", "06482", "60428", "71", "8602", "6028", "863520", "60286", "06853", "681")


def ngon(n: int, r: float, turn: float = 0.0) -> Float[np.ndarray, "n 2"]:
    """Corners of a regular polygon about the origin with a flat side below; r: from the middle to a side."""
    t = 2 * np.pi * (np.arange(n) + 0.5) / n - np.pi / 2 + np.deg2rad(turn)
    return r / np.cos(np.pi / n) * np.c_[np.cos(t), np.sin(t)]


def spun(n: int, profile: Point, at: Point = (0, 0, 0)) -> Trimesh:
    """A profile of (radius, z) about the vertical with n flat sides."""
    return moved(loft(np.array([np.c_[ngon(n, r), np.full(n, z)] for r, z in profile])), at)


def gores(n: int, profile: Point) -> list[Trimesh]:
    """The same without its ends, one sheet a side."""
    rings = np.array([np.c_[ngon(n, r), np.full(n, z)] for r, z in profile])
    faces = [f for k in range(0, 2 * len(profile) - 2, 2) for f in ([k, k + 1, k + 3], [k, k + 3, k + 2])]
    return [Trimesh(rings[:, [k, (k + 1) % n]].reshape(-1, 3), faces, process=False) for k in range(n)]


def letters(m: Model, x: Span, y: Span, z: Span) -> list[Trimesh]:
    """Letters side by side, as many as fit."""
    high = z[1] - z[0]
    count = max(1, int((x[1] - x[0]) / (0.95 * high)))
    a = (x[0] + x[1]) / 2 - 0.95 * high * (count / 2 - 0.2)
    words = [np.array([divmod(int(c), 3) for c in m.pick(*GLYPHS)])[:, ::-1] * (0.3, 0.5) + (0.95 * k, 0) for k in range(count)]
    lines = [LineString(high * w + (a, z[0])) for w in words]
    return [prism(line.buffer(0.09 * high, cap_style="flat", join_style="mitre"), "y", y) for line in lines]


def _plate(m: Model, z: float, r: float, front: float) -> None:
    n, turn = m.pick((24, 0), (24, 0), (3, 0), (3, 180), (8, 0), (4, 0), (4, 45))
    outline = Polygon(np.add(ngon(n, r, turn), (0, z))).buffer(-0.15 * r).buffer(0.15 * r, quad_segs=3)
    m.add(BASE, prism(outline, "y", (front, front + 0.012)))
    y, mark = (front - 0.005, front + m.pick(0.0, 0.003)), m.pick("letters", "arrow", "none")
    m.add(BASE, prism(outline.buffer(-0.03 * r).difference(outline.buffer(-0.16 * r)), "y", y))
    if mark == "letters":
        m.add(BASE, *letters(m, (-0.6 * r, 0.6 * r), y, (z - 0.2 * r, z + 0.15 * r)))
    elif mark == "arrow":
        line = [(0.1, -0.5), (0.1, 0.1), (0.3, 0.1), (0, 0.45), (-0.3, 0.1), (-0.1, 0.1), (-0.1, -0.5)]
        m.add(BASE, moved(turned(prism(r * np.array(line), "y", y), (0, 1, 0), m.pick(0, 90, -90), (0, 0, 0)), (0, 0, z)))


def road_sign(m: Model) -> None:
    """A road sign: plates with rims and marks clamped to a post, a board on two posts, or a fingerpost; nothing moves."""
    style, r, high, n = m.pick("plates", "plates", "board", "fingers"), m.number(0.025, 0.05), m.number(2.0, 3.2), m.sections()
    wide, tall, square, foot = m.number(1.0, 2.6), m.number(0.6, 1.4), m.chance(0.3), m.pick(0.0, 0.015, 0.1)
    for x in (-0.35 * wide, 0.35 * wide) if style == "board" else (0.0,):
        post = around(rod((4 * r, 0, 0), (4 * r, 0, foot + 0.02), 0.4 * r, 6), m.pick(0, 4) if foot else 0, 45)
        post += [spun(4 if square else n, [(r, 0), (r, high)]), ball((0, 0, high), (1.2 * r, 1.2 * r, r), 8)]
        post += [spun(k, [(c * r, 0), (c * r, z)]) for k, c, z in ((4, 5, foot), (8, 1.5, foot + 3 * r)) if foot]
        m.add(BASE, *(moved(s, (x, 0, 0)) for s in post))
    z, front = high - 0.2, -r - 0.03
    for size in [m.number(0.2, 0.4) for _ in range(m.pick(1, 1, 2, 3))] if style == "plates" else ():
        m.add(BASE, *(box((-0.5 * size, 0.5 * size), (front, 0), (z + c, z + c + 0.03)) for c in (-0.12, 0.1)))
        _plate(m, z, size, front - 0.012)
        z -= size + 0.35
    for _ in range(m.pick(2, 3, 5)) if style == "fingers" else ():
        turn, long, tall, tip = m.number(0, 360), m.number(0.4, 0.8), m.number(0.06, 0.1), m.pick(0.04, 0.08, -0.03)
        line = [(0.8 * r, z - tall), (long, z - tall), (long + tip, z), (long, z + tall), (0.8 * r, z + tall)]
        arm = [prism(line, "y", (-0.012, 0.012)), rod((0, 0, z - 0.12), (0, 0, z + 0.12), 1.2 * r, n)]
        arm += letters(m, (r + 0.05, long), (-0.018, 0.018), (z - 0.4 * tall, z + 0.4 * tall))
        m.add(BASE, *(turned(s, (0, 0, 1), turn, (0, 0, 0)) for s in arm))
        z -= m.number(0.15, 0.3)
    if style == "board":
        x, y, z = (-wide / 2, wide / 2), (-r - 0.02, -r), (high - tall, high - 0.02)
        m.add(BASE, box(x, y, z), prism(rectangle(x, z, 0.04), "y", (y[0] - 0.006, y[0] + 0.002)))
        for c in np.linspace(z[0] + 0.12, z[1] - 0.25, m.pick(1, 2, 3)):
            m.add(BASE, *letters(m, (x[0] + 0.1, x[1] - m.number(0.1, 0.9)), (y[0] - 0.005, y[0] + 0.002), (c, c + 0.14)))


def pedestal(m: Model, n: int, r: float, high: float, shrink: float) -> tuple[float, float]:
    """Lay steps and perhaps a die with letters between them and a cornice; returns the radius and height of its top."""
    count, step = m.pick(1, 2, 3, 4), m.number(0.1, 0.2)
    m.add(BASE, *(spun(n, [(r * shrink**k, k * step), (r * shrink**k, (k + 1) * step)]) for k in range(count)))
    half, top, y = r * shrink**count, count * step + high, -r * shrink**count - 0.02
    if m.chance(0.35):
        return half / shrink, top - high
    m.add(BASE, spun(n, [(half, top - high - 0.01), (0.9 * half, top)]))
    m.add(BASE, spun(n, [(half, top - 0.03), (1.12 * half, top), (1.12 * half, top + 0.06), (half, top + 0.06)]))
    m.add(BASE, box((-0.6 * half, 0.6 * half), (y, -0.9 * half), (top - 0.75 * high, top - 0.2 * high)))
    for c in top - high * np.linspace(0.65, 0.4, m.pick(1, 2, 3)):
        m.add(BASE, *letters(m, (-0.55 * half, 0.55 * half), (y - 0.01, y + 0.005), (c, c + 0.1 * high)))
    if m.chance(0.4):
        wreath = [*around(ball((half / 2, 0, 0), (0.15 * half,) * 3, 8), 10), ring((0, 0, 0), (0, 0, 1), half / 2, half / 10)]
        m.add(BASE, *(moved(turned(s, (1, 0, 0), 75, (0, 0, 0)), (0, y, top - 0.6 * high)) for s in wreath))
    return half, top + 0.06


def monument_cross(m: Model) -> None:
    """A stone or iron cross on steps, a pedestal or boulders, with ring, knobs, letters and wreath; nothing moves."""
    r, high, w = m.number(0.35, 1.2), m.number(1.0, 3.0), m.number(0.1, 0.25)
    if m.chance(0.3):
        top = 0.75 * r
        m.add(BASE, *(boulder(m, (0.6 * r * x, 0.2 * r * x, 0.45 * r), (0.7 * r, 0.6 * r, 0.5 * r)) for x in (-0.7, 0, 0.8)))
    else:
        top = pedestal(m, m.pick(4, 4, 6, 8, 24), r, m.number(0.5, 1.2), m.number(0.7, 0.85))[1]
    d, across, arm = w * m.number(0.5, 1.0), top + m.number(0.62, 0.75) * high, 0.3 * high
    m.add(BASE, beam((0, 0, top - 0.03), (0, 0, top + high), w, d, taper=m.pick(1.0, 0.75)))
    m.add(BASE, *(beam((s * m.gap(w), 0, across), (s * arm, 0, across), w, d, (0, 0, 1), m.pick(0.8, 1.5)) for s in (-1, 1)))
    style = m.pick("plain", "ring", "knobs", "bars")
    if style == "ring":
        hoop = LineString(np.add(ngon(24, 0.6 * arm), (0, across))[[*range(24), 0]]).buffer(0.3 * w, quad_segs=1)
        m.add(BASE, prism(hoop, "y", (-0.35 * d, 0.35 * d)), ball((0, -0.5 * d, across), (0.3 * w,) * 3, 8))
    elif style == "knobs":
        ends = [(-arm, across), (arm, across), (0, top + high)]
        m.add(BASE, *(ball((x + a, 0, z + b), (w / 2,) * 3, 9) for x, z in ends for a in (-w / 2, w / 2) for b in (0, w / 2)))
    elif style == "bars":
        m.add(BASE, *(beam((-arm * c, 0, top + c * high), (arm * c, 0, top + 0.9 * c * high), w, d) for c in (0.3, 0.9)))


def _bollard(m: Model, style: str, r: float, high: float, n: int) -> list[Trimesh]:
    if style == "cast":
        size = [(1.6, 0), (1.6, 0.1), (1.1, 0.16), (0.8, 0.75), (1.1, 0.78), (1.1, 0.82), (0.7, 0.85), (0.5, 0.9)]
        return [spun(n, np.array(size) * (r, high)), ball((0, 0, 0.92 * high), (0.6 * r, 0.6 * r, 0.08 * high), n)]
    if style == "stone":
        return [spun(8, [(1.3 * r, 0), (1.3 * r, 0.1)]), ball((0, 0, 0.1 + 1.8 * r), (2 * r,) * 3, n)]
    if style == "hoop":
        path = [(3 * r * np.cos(t), 0, high - 3 * r * (1 - np.sin(t))) for t in np.linspace(0, np.pi, 9)]
        return [tube([(3 * r, 0, 0), *path, (-3 * r, 0, 0)], 0.45 * r), spun(4, [(r, 0), (r, 0.02)], (3 * r, 0, 0))]
    k, bands = 4 if style == "block" else n, high * np.array(m.pick((0.7,), (0.65, 0.8), (0.1, 0.8)))
    solids = [spun(k, [(r, 0), (r, high - m.pick(0.01, 0.3 * r)), (0.6 * r, high)]), spun(k, [(1.6 * r, 0), (1.6 * r, 0.015)])]
    return [*solids, *(spun(k, [(1.06 * r, c), (1.06 * r, c + 0.07)]) for c in bands)]


def bollard_row(m: Model) -> None:
    """Bollards, stone balls or hoops in a straight or bent row, perhaps with rails, on pavement; nothing moves."""
    style, count, ground = m.pick("cast", "steel", "block", "stone", "hoop"), m.pick(2, 3, 4, 6), m.pick(0, 0.12)
    r, high, pitch, bend = m.number(0.06, 0.12), m.number(0.6, 1.1), m.number(0.8, 1.6), m.pick(0.0, 0.0, m.number(0.03, 0.12))
    one = _bollard(m, style, r, high, m.sections())
    spots = [vec(x, bend * x * x, ground) for x in pitch * (np.arange(count) - (count - 1) / 2)]
    m.add(BASE, *(moved(s.copy(), at) for at in spots for s in one))
    if style != "stone" and m.chance(0.5):
        for z in high * np.array(m.pick((0.8,), (0.4, 0.75), (0.2, 0.5, 0.8))):
            m.add(BASE, *(rod(a + vec(0, 0, z), b + vec(0, 0, z), 0.25 * r, 8) for a, b in pairwise(spots)))
    slabs = np.linspace(-pitch * count / 2, pitch * count / 2, m.pick(2, count + 1, 2 * count + 1))
    for y in ((-0.3, spots[0][1] + 0.5), (-0.45, -0.305)) if ground else ():
        m.add(BASE, *(box((a, b - 0.005), y, (0, ground)) for a, b in pairwise(slabs)))


def statue_fountain(m: Model) -> None:
    """A fountain: a basin with water, stacked bowls on turned stems, and a knop or figure on top; nothing moves."""
    n, k, R, h = m.pick(16, 24, 32), m.pick(4, 6, 8, 24, 24), m.number(0.7, 2.5), m.number(0.35, 0.7)
    base, spouts = m.pick(0.0, 0.12, 0.2), m.pick(0, 4, 6, 8)
    m.add(BASE, *(spun(k, [(c * R, 0), (c * R, base / c)]) for c in (1.35, 1.15) if base))
    wall = [(0, 0), (1, 0), (1, 0.2), (0.94, 0.3), (0.94, 0.8), (1.04, 0.9), (1.04, 1), (0.86, 1), (0.86, 0.2), (0, 0.2)]
    m.add(BASE, spun(k, np.array(wall) * (R, h), (0, 0, base)))
    m.add(BASE, spun(k, [(0.87 * R, 0), (0.87 * R, 0.02)], (0, 0, base + m.number(0.6, 0.85) * h)))
    r, z, stem = m.number(0.45, 0.65) * R, base + 0.15 * h, m.pick([(0.3, 0), (0.2, 0.15), (0.12, 0.3)], [(0.2, 0), (0.1, 0.2)])
    cup = [(0, 0), (0.2, 0), (0.6, 0.1), (0.95, 0.25), (1, 0.32), (0.9, 0.32), (0.55, 0.18), (0, 0.15)]
    for _ in range(m.pick(1, 2, 2, 3)):
        tall = m.number(0.8, 1.4) * max(r, 0.4 * h)
        solids = [spun(n, r * np.array(cup)), spun(n, [(0.8 * r, 0.26 * r), (0.8 * r, 0.27 * r)])]
        solids += around(ball((r, 0, 0.26 * r), (0.08 * r, 0.07 * r, 0.09 * r), 8), spouts)
        m.add(BASE, spun(n, np.array([*stem, (0.24, 0.6), (0.14, 0.85), (0.22, 1)]) * (r, tall), (0, 0, z)))
        m.add(BASE, *(moved(s, (0, 0, z + tall - 0.02 * r)) for s in solids))
        z, r = z + tall + 0.12 * r, r * m.number(0.5, 0.7)
    statue(top := Model(m.rng))
    m.add(BASE, *(moved(s.apply_scale(1.2 * r), (0, 0, z)) for _, s in top.pieces))


def market_stall(m: Model) -> None:
    """A market stall: counter or trestle, posts, striped roof with a scalloped edge, boxes of fruit, a sign; nothing moves."""
    wide, deep, high, top = m.number(1.4, 3.0), m.number(0.8, 1.3), m.number(0.75, 0.95), m.number(2.0, 2.6)
    x, y, r, over = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.02, 0.045), m.number(0.0, 0.4)
    rise, front, square, strips = m.number(0.2, 0.6), -deep / 2 - over, m.pick(4, 8, 12), m.pick(1, 4, 7, 9)
    m.add(BASE, *(spun(square, [(r, 0), (r, top + 0.2 * rise * (b > 0))], (a, b, 0)) for a in x for b in y))
    m.add(BASE, *(box(x, (b - r, b + r), (top - 2 * r, top)) for b in y), box(x, y, (high - 0.04, high)))
    if m.chance(0.5):
        planks = np.linspace(*x, m.pick(2, 6, 10))
        m.add(BASE, *(box((a, b - 0.006), (y[0] - 0.02, y[0]), (0.05, high - 0.04)) for a, b in pairwise(planks)))
    else:
        legs = [((a - 0.2, b, 0), (a, 0, high - 0.03)) for a in (0.7 * x[0], 0, 0.7 * x[1]) for b in y]
        m.add(BASE, *(beam(a, b, 0.05, 0.04) for a, b in legs), box(x, (-0.04, 0.04), (0.35, 0.4)))
    bow = [(front * np.cos(t), rise * np.sin(t)) for t in np.linspace(0, np.pi, 9)]
    roof = np.add(m.pick([(front, 0), (y[1] + 0.1, rise)], [(front, 0), (0, rise), (-front, 0)], bow), (0, top))
    for a, b in pairwise(np.linspace(x[0] - 0.1, x[1] + 0.1, strips + 1)):
        m.add(BASE, prism(LineString(roof).buffer(0.012, cap_style="flat", join_style="mitre"), "x", (a, b)))
        lobes = [((a + b) / 2 - (b - a) / 2 * np.cos(t), top - 0.12 - 0.06 * np.sin(t)) for t in np.linspace(0, np.pi, 7)]
        m.add(BASE, prism([(b, top + 0.01), (a, top + 0.01), *lobes], "y", (front - 0.01, front + 0.01)))
    for a, b in pairwise(np.linspace(*x, m.pick(3, 4, 5)) if m.chance(0.8) else ()):
        tilt, c = m.pick(0, 12), m.number(0.03, 0.05)
        outline = rectangle((a + 0.05, b - 0.05), (y[0] + 0.05, y[1] - 0.2), 0.02)
        spots = [(p, q, high + c) for q in np.linspace(y[0] + 0.12, 0, 3) for p in np.arange(a + 0.12, b - 0.1, 2.1 * c)]
        goods = [ball(p, (c, c, c * m.number(0.9, 1.1)), 6) for p in spots[: m.pick(0, 9, 24)]]
        tray = [prism(outline, "z", (high, high + 0.1)), prism(outline.envelope, "z", (high, high + 0.02))]
        m.add(BASE, *(turned(s, (1, 0, 0), tilt, (0, y[0] + 0.05, high)) for s in [*tray, *goods]))
    if m.chance(0.4):
        sign = letters(m, (-0.38, 0.38), (front - 0.04, front - 0.025), (top - 0.03, top + 0.09))
        m.add(BASE, box((-0.4, 0.4), (front - 0.03, front - 0.005), (top - 0.1, top + 0.15)), *sign)


def _guys(m: Model, ends: list[Point], reach: float) -> None:
    for x, y, z in ends if m.chance(0.7) else []:
        away = vec(x, y, 0) * (1 + reach / np.hypot(x, y))
        m.add(BASE, rod((x, y, z), away, 0.008, 5), rod(away, away + vec(0, 0, 0.08), 0.015, 6))


def tent(m: Model) -> None:
    """A tent: ridge, dome, tipi, bell or pavilion, with poles, guys, pegs and groundsheet, open in front; nothing moves."""
    style, n = m.pick("ridge", "dome", "tipi", "bell", "pavilion"), m.pick(8, 10, 12)
    h, w = m.number(1.1, 1.6), m.number(0.8, 1.2)
    if style == "ridge":
        long, t = m.number(1.0, 1.6), m.pick(0.008, 0.02)
        for c in m.pick((0.0,), (0.0, 0.15)):
            line = LineString([(-w - c, 0.6 * c), (0, h + c), (w + c, 0.6 * c)]).buffer(t, join_style="mitre", cap_style="flat")
            m.add(BASE, prism(line, "y", (-long - c, long + c)))
        m.add(BASE, prism([(-w, 0), (w, 0), (0, h)], "y", (long - 0.02, long)), box((-w, w), (-long, long), (0, 0.01)))
        for s in (-1, 1):
            m.add(BASE, prism([(s * w, 0.01), (s * 0.55 * w, 0.01), (0, h)], "y", (-long, -long + 0.02)))
            m.add(BASE, rod((0, s * long * 1.02, 0), (0, s * long * 1.02, h + 0.25), 0.015, 8))
        _guys(m, [(s * w * 0.5, y, h / 2) for s in (-1, 1) for y in (-long, 0.01, long)], m.number(0.5, 1.0))
        return
    arc = [(1.3 * w * np.cos(t), h * np.sin(t)) for t in np.linspace(0, np.pi / 2, 7)]
    size = {"tipi": [(w, 0), (w / 2, h), (0.1, 2 * h)], "bell": [(1.6 * w, 0), (1.6 * w, 0.8), (0.02, 2 * h)], "dome": arc}
    if style == "pavilion":
        n, wall = m.pick(4, 6, 8), m.number(1.9, 2.3)
        size["pavilion"] = [(1.7 * w, wall - 0.25), (1.7 * w, wall), *m.pick([(0.7 * w, wall + 0.3)], []), (0.02, wall + h)]
        corner = vec(*ngon(n, 1.65 * w)[0], 0)
        m.add(BASE, *around(rod(corner, corner + vec(0, 0, wall), 0.03, 8), n), ball((0, 0, wall + h), (0.08,) * 3, 8))
        m.add(BASE, *around(box((-0.6 * w, 0.6 * w), (-1.62 * w, -1.6 * w), (0, wall)), n, 360 / n)[: m.pick(0, n - 1, n // 2)])
    profile = size[style]
    m.add(BASE, *gores(n, profile)[:-1], *gores(n, profile[{"dome": 3, "pavilion": 0}.get(style, 1) :])[-1:])
    if style == "tipi":
        m.add(BASE, *around(rod((-w, 0, 0), (0.3 * w, 0, 2.6 * h), 0.02, 6), m.pick(6, 9), 10))
    elif style == "dome":
        bow = tube([(s * a * 1.01, 0, 1.01 * b) for s, p in ((-1, arc), (1, arc[-2::-1])) for a, b in p], 0.015, 6)
        m.add(BASE, *around(bow, m.pick(2, 3), m.pick(0, 45)))
    _guys(m, [(*p, profile[1][1]) for p in ngon(n, profile[1][0])] if style != "tipi" else [], m.number(0.4, 1.0))
