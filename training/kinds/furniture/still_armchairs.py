"""Wing chairs and pouffes of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.furniture.seating import cushion
from training.kinds.furniture.still_beds import drape, feet
from training.kinds.furniture.still_seats import repeat, sizes, smooth
from training.kinds.furniture.still_upholstery import arm, buttons, soft
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.prop_style import pillow
from training.kinds.solids import ball, box, loft, prism, ring, rod, tube, turned, vec
from training.kinds.wheels import lathe


def _tub_chair(m: Model, r: float, seat: float, high: float) -> None:
    """Make a chair whose back and wings are one bent shell round a seat."""
    span, steps = np.deg2rad(m.number(100, 140)), m.pick(9, 17, 25)
    front, thick, flare, power = m.pick(0.35, 0.6, 0.85), m.number(0.03, 0.1), m.number(1.0, 1.3), m.number(1, 3)
    rings = []
    for t in np.linspace(-span, span, steps):
        c, top = vec(np.sin(t), np.cos(t), 0), seat + (high - seat) * (1 - (1 - front) * abs(t / span) ** power)
        outer, inner = r * c, (r - thick) * c
        rings.append(
            [outer + vec(0, 0, 0.14), flare * outer + vec(0, 0, top), flare * inner + vec(0, 0, top), inner + vec(0, 0, 0.14)]
        )
    m.add(BASE, loft(np.array(rings)))
    m.add(BASE, rod((0, 0, 0.14), (0, 0, seat - 0.12), r - 0.5 * thick, 24))
    m.add(
        BASE,
        lathe([(0, -0.12), (r - thick, -0.12), (r - 0.8 * thick, -0.05), (r - 1.3 * thick, 0), (0, 0.02)], 24, (0, 0, seat)),
    )
    m.add(BASE, *[tube([ring_[1] for ring_ in rings], 0.012)][: m.pick(0, 1)])
    if m.chance(0.5):
        m.add(
            BASE,
            *(rod((s * 0.7 * r, b * r, 0), (s * 0.6 * r, 0.8 * b * r, 0.16), 0.02, 10) for s in (-1, 1) for b in (-0.6, 0.6)),
        )
    else:
        m.add(BASE, lathe([(0, 0), (0.9 * r, 0), (0.9 * r, 0.02), (0.1 * r, 0.06), (0.1 * r, 0.15), (0, 0.15)], 24))


def _wing_chair(m: Model, form: str) -> None:
    """Make one wing chair: seat, leaning back with wings, arms, cushion, legs and trims."""
    wide, deep, seat, high, t = sizes(m, (0.5, 0.62), (0.6, 0.72), (0.4, 0.46), (1.0, 1.25), (0.06, 0.14))
    if form == "tub":
        _tub_chair(m, 0.62 * wide, seat, m.pick(0.8, high))
        return
    x, y, low, lean = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.12, 0.26), m.number(3, 14)
    elbow, bulge, reach = seat + m.number(0.15, 0.24), m.number(0, 0.12), m.number(0.15, 0.4) * deep
    m.add(BASE, cushion(m, x, y, (low, seat - 0.1)))
    m.add(
        BASE,
        *soft(m, shrunk(x, 0.005), (y[0] - 0.02, y[1] - 0.08), (seat - 0.1, seat + 0.03), m.pick("piped", "swollen", "round")),
    )
    a = np.linspace(*x, 15)
    crest = high + m.pick(0.0, 0.06, 0.1) * np.cos(np.pi * a / wide)
    panel = [prism([(x[0], low), *np.c_[a, crest], (x[1], low)], "y", (y[1] - 0.1, y[1]))]
    line = smooth(
        [(y[1] - 0.08, high), (y[1] - reach, high - 0.05), (y[1] - reach - bulge, high - 0.25), (y[1] - reach, elbow)]
    )
    wing = [(y[1], low), (y[1], high), *line, (y[1] - reach, low)]
    start = len(m.pieces)
    m.add(BASE, *panel)
    for s in (-1, 1):
        m.add(BASE, prism(wing, "x", (s * wide / 2, s * (wide / 2 + t))))
        m.add(BASE, *[tube([(s * (wide / 2 + t), *p) for p in line], 0.01)][: form == "piped"])
    if form == "hood":
        top = [(x[0] - t, high - 0.02), *np.c_[a * (1 + 2 * t / wide), crest + 0.05], (x[1] + t, high - 0.02)]
        m.add(BASE, prism(top, "y", (y[1] - reach, y[1])))
    if form == "buttoned":
        buttons(m, x, y[1] - 0.1, (seat + 0.15, high - 0.08), (m.pick(3, 4), m.pick(3, 5)))
    else:
        m.add(BASE, cushion(m, shrunk(x, 0.03), (y[1] - 0.2, y[1] - 0.09), (seat + 0.02, high - m.number(0.04, 0.2))))
    for _, solid in m.pieces[start:]:
        turned(solid, (-1, 0, 0), lean, (0, y[1], low))
    how = m.pick("roll", "roll", "slope", "block", "pad")
    for s in (-1, 1):
        span = tuple(sorted((s * wide / 2, s * (wide / 2 + t + m.pick(0.0, 0.03)))))
        arm(m, span, (y[0], y[1] - 0.05), (low, elbow), how)
    feet(m, shrunk(x, 0.01), shrunk(y, 0.05), low + 0.02, 0.045)
    for k in np.linspace(x[0], x[1], m.pick(0, 0, 0, 9)):
        m.add(BASE, ball((k, y[0], low + 0.02), (0.009, 0.007, 0.009), 6))


def wing_chair_set(m: Model) -> None:
    """Make one to three wing or tub chairs, perhaps with a footstool and a small table; nothing moves."""
    form, n, turn = m.pick("plain", "piped", "buttoned", "hood", "tub"), m.pick(1, 1, 1, 2, 3), m.number(0, 35)
    places = [((1.15 * (k - (n - 1) / 2), 0, 0), -turn * (k - (n - 1) / 2)) for k in range(n)]
    repeat(m, lambda one: _wing_chair(one, form), places)
    x, high = (-0.25, 0.25), m.number(0.3, 0.42)
    if m.chance(0.5):
        y = (-1.05, -0.65)
        m.add(BASE, *soft(m, x, y, (high - 0.16, high), m.pick("piped", "round", "swollen")))
        m.add(BASE, box(shrunk(x, 0.01), shrunk(y, 0.01), (high - 0.2, high - 0.155)))
        feet(m, shrunk(x, 0.05), shrunk(y, 0.05), high - 0.19, 0.04)
        m.add(BASE, *[drape(m, x, shrunk(y, 0.05), (high - 0.1, high + 0.02), 0.012)][: m.pick(0, 1)])
    if m.chance(0.25):
        m.add(BASE, box((-0.7 * n, 0.7 * n), (-1.2, 0.6), (-0.015, 0.0)))


def _gored(m: Model, r: float, high: float, cells: int) -> list[Trimesh]:
    """Make a leather pouffe of gores with a seam between them and a patch on top."""
    t, u, pinch = np.linspace(0, 2 * np.pi, 8 * cells, endpoint=False), np.linspace(0.08, 0.92, 11), m.number(0.03, 0.12)
    lobe = 1 - pinch * np.abs(np.cos(cells * t / 2)) ** 6
    side = np.c_[r * np.sin(np.pi * u) ** m.pick(0.4, 0.6), high * (0.5 - 0.5 * np.cos(np.pi * u))]
    seam = [[(a * np.cos(s), a * np.sin(s), c) for a, c in 0.005 + side] for s in 2 * np.pi * np.arange(cells) / cells]
    body = loft(np.array([np.c_[a * lobe * np.cos(t), a * lobe * np.sin(t), np.full(len(t), c)] for a, c in side]))
    patch = lathe([(0, side[-1, 1] - 0.02), (0.3 * r, side[-1, 1] - 0.02), (0, high + 0.01)], 16)
    return [body, patch, *(tube(np.array(s) * (1 - pinch, 1 - pinch, 1), 0.006, 6) for s in seam)]


def _bag(m: Model, r: float, high: float) -> list[Trimesh]:
    """Make a beanbag that leans back, with seams and a tied top."""
    n, seams = m.pick(16, 24, 32), m.pick(0, 4, 6)
    side = smooth(
        [(0.95 * r, 0.02), (1.15 * r, 0.3 * high), (0.9 * r, 0.7 * high), (0.4 * r, 1.2 * high), (0.1 * r, 1.4 * high)]
    )
    turns = 2 * np.pi * np.arange(seams) / max(seams, 1)
    lines = [tube([(a * np.cos(t), a * np.sin(t), c) for a, c in side], 0.007, 6) for t in turns]
    solids = [lathe([(0, 0), *side, (0, 1.42 * high)], n), *lines, ring((0, 0, 1.38 * high), (0, 0, 1), 0.12 * r, 0.015)]
    for solid in solids:
        lean = 0.5 * solid.vertices[:, 2] ** 2
        solid.vertices += np.c_[0 * lean, lean, 0 * lean]
    return solids


def _pouffe(m: Model, form: str, r: float, high: float) -> None:
    """Make one pouffe: gored, knitted, tufted, banded drum, beanbag, padded on feet or a mushroom."""
    n, x, u = m.pick(16, 24, 32), (-r, r), np.linspace(0, 1, 12)
    if form == "gored":
        m.add(BASE, *_gored(m, r, high, m.pick(6, 8, 12)))
    elif form == "knitted":
        rows = m.pick(4, 6, 8)
        thick = 0.5 * high / rows
        for k in range(rows):
            wide = r * (0.8 + 0.2 * np.sin(np.pi * (k + 0.5) / rows)) - thick
            m.add(BASE, ring((0, 0, thick * (2 * k + 1)), (0, 0, 1), wide, 1.06 * thick, n))
        m.add(BASE, lathe([(0, 0), (0.8 * r, 0), (0.8 * r, high - thick), (0.5 * r, high), (0, high + 0.02)], n))
    elif form == "tufted":
        count, low = m.pick(2, 3, 4), high - m.pick(0.12, 0.2)
        edges = list(pairwise(np.linspace(*x, count + 1)))
        m.add(BASE, box(x, x, (0.03, low)), *(pillow(a, b, (low - 0.01, high), 0.04) for a in edges for b in edges))
        m.add(BASE, *(ball((a[1], b[1], high - 0.015), (0.015,) * 3, 8) for a in edges[:-1] for b in edges[:-1]))
        feet(m, shrunk(x, 0.05), shrunk(x, 0.05), 0.035, 0.05)
    elif form == "drum":
        base, bands = m.number(0.0, 0.1), m.pick(1, 2, 3)
        side = np.c_[r * (1 + m.number(-0.2, 0.12) * np.sin(np.pi * u)), base + u * (high - base)]
        m.add(BASE, lathe([(0, base), *side, (0.9 * r, high + 0.03), (0, high + 0.04)], n))
        rims = side[np.linspace(0, 11, bands + 1).astype(int)]
        m.add(BASE, *(ring((0, 0, c), (0, 0, 1), a, 0.01, n) for a, c in rims), ball((0, 0, high + 0.04), (0.03, 0.03, 0.01)))
        m.add(BASE, lathe([(0, 0), (0.8 * r, 0), (0.8 * r, base + 0.01), (0, base + 0.01)], n))
    elif form == "beanbag":
        m.add(BASE, *_bag(m, r, high))
    else:
        low = high - m.number(0.1, 0.2)
        pad = lathe([(0, low), (r, low), (1.06 * r, (low + high) / 2), (0.9 * r, high), (0, high + 0.03)], n)
        m.add(BASE, pad if form == "mushroom" else cushion(m, x, shrunk(x, 0.2 * r), (low, high)))
        stem = lathe([(0, 0), (0.6 * r, 0), (0.5 * r, 0.04), (0.35 * r, 0.5 * low), (0.6 * r, low + 0.01), (0, low + 0.01)], n)
        m.add(BASE, *[stem][: form == "mushroom"], box(shrunk(x, 0.3 * r), shrunk(x, 0.3 * r), (low - 0.05, low + 0.01)))
        if form == "feet":
            feet(m, shrunk(x, 0.35 * r), shrunk(x, 0.35 * r), low, 0.05)
        edge = [(a, b) for a in np.linspace(*shrunk(x, 0.02), m.pick(2, 5, 8)) for b in shrunk(x, 0.2 * r)]
        m.add(BASE, *(ball((a, b, low + 0.02), (0.01,) * 3, 6) for a, b in edge if form == "feet"))


def pouffe_set(m: Model) -> None:
    """Make one to four pouffes of a form and of sizes, perhaps with a tray, books or a cloth on them; nothing moves."""
    form, r, high = (
        m.pick("gored", "knitted", "tufted", "drum", "beanbag", "feet", "mushroom"),
        m.number(0.2, 0.35),
        m.number(0.3, 0.45),
    )
    n, size, here = m.pick(1, 1, 2, 3, 4), m.number(0.6, 1.0), 0.0
    for k in range(n):
        share = size ** (k % 3)
        here += 1.3 * r * share * (k > 0)
        at = (here, m.number(-0.3, 0.3) * r * (k > 0), 0)
        repeat(m, lambda one, s=share: _pouffe(one, form, s * r, s**0.5 * high), [(at, m.number(0, 40))])
        here += 1.3 * r * share
    top = high + {"drum": 0.035, "beanbag": 0.4 * high, "feet": -0.003}.get(form, 0.005)
    if form != "beanbag" and m.chance(0.5):
        tray, t = 0.6 * r, m.number(0.008, 0.02)
        m.add(BASE, lathe([(0, 0), (tray, 0), (tray, 0.04), (tray - t, 0.04), (tray - t, t), (0, t)], 24, (0, 0, top)))
        m.add(
            BASE,
            lathe(
                [(0, t), (0.04, t), (0.045, 0.09), (0.035, 0.09), (0.03, t + 0.005), (0, t + 0.005)], 16, (0.3 * tray, 0, top)
            ),
        )
        m.add(
            BASE, *(box((-0.6 * tray, 0), (-0.1, 0.1), (top + t + c, top + t + c + 0.02)) for c in (0, 0.02)[: m.pick(0, 1, 2)])
        )
        m.add(BASE, *(ring((s * tray, 0, top + 0.04), (1, 0, 0), 0.03, 0.006, 12) for s in (-1, 1) if m.chance(0.5)))
    elif form in ("tufted", "feet") and m.chance(0.6):
        m.add(BASE, drape(m, (-r, r), (-0.5 * r, 0.5 * r), (0.5 * high, high), 0.012))
