"""Caddies for kitchen scraps."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, loft, prism, rod, rounded, tube


def _tapered(shape: Polygon, z: Span, share: float) -> Trimesh:
    """A prism over an outline that is smaller below."""
    ends = np.array(shape.exterior.coords)[:-1]
    return loft(np.stack([np.c_[ends * s, np.full(len(ends), h)] for s, h in ((share, z[0]), (1.0, z[1]))]))


def _bow(m: Model, half: float, z: float, reach: float, lean: str) -> None:
    """A bow handle on pins at both sides that lies before the front or behind the rear and swings over to the other."""
    a, r = half + 0.006, m.number(0.003, 0.006)
    side = -1 if lean == "front" else 1
    end = (side * reach, z - 0.2 * reach)
    path = [
        (-a, 0, z),
        (-a, 0.8 * end[0], z + 0.8 * (end[1] - z)),
        (-0.6 * a, *end),
        (0.6 * a, *end),
        (a, 0.8 * end[0], z + 0.8 * (end[1] - z)),
        (a, 0, z),
    ]
    if m.chance(0.5):
        m.add("handle", tube(path, r, 8))
    else:
        m.add("handle", tube([(-a, 0, z), (-a, *end), (a, *end), (a, 0, z)], r, 8))
    if m.chance(0.5):
        m.add("handle", rod((-0.3 * a, *end), (0.3 * a, *end), 2.2 * r, 10))
    for s in (-1, 1):
        m.add("handle", rod((s * (a - 0.004), 0, z), (s * (a + 0.005), 0, z), 2 * r, 10))
        m.add(BASE, rod((s * (half - 0.004), 0, z), (s * (half + 0.004), 0, z), 1.2 * r, 8))
    m.hinge("handle", (0, 0, z), (side, 0, 0), m.pick(150, 180))


def _filter(m: Model, part: str, x: float, y: float, z: float) -> None:
    """A round or a square grille for the charcoal in a lid."""
    for a in np.linspace(-0.4, 0.4, 5):
        m.add(part, box((x + a * 0.06 - 0.003, x + a * 0.06 + 0.003), (y - 0.02, y + 0.02), (z - 0.001, z + 0.0015)))


def _plastic(m: Model, half: float, deep: float, high: float) -> None:
    """A tapered bin with a hinged lid; a handle, a bag ring, an inner bucket."""
    shape = rounded((-half, half), (-deep / 2, deep / 2), m.pick(0.01, 0.03, 0.05))
    share, t = m.number(0.75, 0.95), 0.004
    m.add(BASE, cut(_tapered(shape, (0, high), share), _tapered(shape.buffer(-t), (t, high + 0.001), share)))
    if m.chance(0.6):
        m.add(
            BASE,
            prism(
                Polygon(shape.buffer(0.006).exterior.coords, [shape.buffer(-0.002).exterior.coords]), "z", (high - 0.014, high)
            ),
        )
    low, thick = high + 0.001, m.number(0.012, 0.035)
    top = shape.buffer(m.pick(0.0, 0.005))
    style = m.pick("flat", "stepped", "sloping")
    m.add("lid", prism(top, "z", (low, low + (thick if style == "flat" else 0.5 * thick))))
    if style != "flat":
        m.add("lid", _tapered(top.buffer(-0.01), (low + thick, low + 0.4 * thick), 1.15 if style == "sloping" else 1.04))
    m.add("lid", box((-0.2 * half, 0.2 * half), (-deep / 2 - 0.02, -deep / 2 + 0.01), (low + 0.001, low + 0.008)))
    if m.chance(0.5):
        _filter(m, "lid", 0.0, 0.1 * deep, low + thick)
    y = deep / 2 + m.pick(0.002, 0.008)
    m.add(m.pick("lid", BASE), rod((-0.4 * half, y, low), (0.4 * half, y, low), 0.006, 10))
    m.hinge("lid", (0, y, low), (-1, 0, 0), m.pick(95, 110, 180, 220))
    if m.chance(0.7):
        lean = m.pick("front", "rear")
        _bow(m, half, 0.85 * high, deep / 2 + 0.025, lean)
    if m.chance(0.4):
        m.add(BASE, _tapered(shape.buffer(-0.01), (0.01, 0.6 * high), share))


def _pail_lid(m: Model, r: float, high: float, n: int) -> None:
    """A domed lid that is lifted by a ball, a strap or a disc, with a plug that reaches into the pail."""
    dome, over = m.number(0.008, 0.035), m.pick(0.99, 1.02, 1.05)
    low = high + 0.0008
    m.add(
        "lid",
        lathe(
            [(over * r, low), (over * r, low + 0.008), (0.75 * r, low + 0.7 * dome + 0.006), (0.12 * r, low + dome + 0.006)], n
        ),
    )
    m.add("lid", rod((0, 0, high - 0.012), (0, 0, low + 0.002), r - 0.006, n))
    top = low + dome + 0.006
    knob = m.pick("ball", "strap", "disc")
    if knob == "ball":
        m.add("lid", rod((0, 0, top - 0.003), (0, 0, top + 0.012), 0.005, 8), ball((0, 0, top + 0.018), (0.012,) * 3, 12))
    elif knob == "strap":
        m.add(
            "lid",
            tube(
                [(-0.035, 0, top - 0.004), (-0.03, 0, top + 0.025), (0.03, 0, top + 0.025), (0.035, 0, top - 0.004)], 0.004, 8
            ),
        )
    else:
        m.add(
            "lid",
            rod((0, 0, top - 0.003), (0, 0, top + 0.008), 0.007, 10),
            rod((0, 0, top + 0.008), (0, 0, top + 0.016), 0.018, n),
        )
    if m.chance(0.5):  # holes over the charcoal
        for b in np.linspace(0, 2 * np.pi, 7)[:-1]:
            x, y = 0.5 * r * np.cos(b), 0.5 * r * np.sin(b)
            m.add("lid", rod((x, y, top - 0.45 * dome), (x, y, top - 0.2 * dome), 0.004, 6))


def _pail(m: Model, r: float, high: float) -> None:
    """A round steel or ceramic pail with a lifted lid with a knob, and a bow handle or ears."""
    n, t, share = m.pick(16, 24, 32), 0.003, m.number(0.8, 1.0)
    m.add(BASE, lathe([(share * r, 0), (r, high), (r - t, high), (share * r - t, t)], n))
    if m.chance(0.5):
        m.add(
            BASE,
            lathe([(1.03 * r, high - 0.012), (1.03 * r, high - 0.002), (0.99 * r, high - 0.002), (0.99 * r, high - 0.012)], n),
        )
    _pail_lid(m, r, high, n)
    m.slide("lid", (0, 0, 1), m.number(0.06, 0.12))
    if m.chance(0.65):
        _bow(m, r * (share + 0.85 * (1 - share)), 0.85 * high, 1.15 * r, m.pick("front", "rear"))
    else:
        m.add(
            BASE,
            *(
                tube(
                    [
                        (s * 0.98 * r, -0.03, 0.8 * high),
                        (s * (r + 0.02), -0.025, 0.8 * high),
                        (s * (r + 0.02), 0.025, 0.8 * high),
                        (s * 0.98 * r, 0.03, 0.8 * high),
                    ],
                    0.004,
                    6,
                )
                for s in (-1, 1)
            ),
        )


def _hung(m: Model, half: float, deep: float, high: float) -> None:
    """A caddy hung on a cupboard door: a panel with hooks, and a bin whose lid slides or swings open."""
    x, y = (-half, half), (-deep / 2, deep / 2)
    shape = rounded(x, y, m.pick(0.01, 0.03))
    m.add(BASE, cut(prism(shape, "z", (0, high)), prism(shape.buffer(-0.004), "z", (0.004, 1))))
    board = m.chance(0.6)
    back = deep / 2
    if board:
        m.add(BASE, box((-1.6 * half, 1.6 * half), (back + 0.02, back + 0.038), (-0.25 * high, 1.25 * high)))
    m.add(
        BASE,
        *(
            box((a - 0.01, a + 0.01), (back - 0.002, back + 0.021), (0.7 * high, 1.0 * high if not board else 0.95 * high))
            for a in (-0.5 * half, 0.5 * half)
        ),
    )
    low = high + 0.001
    if m.chance(0.5):
        for a in x:
            rail = (a - 0.004, a + 0.004)
            m.add(BASE, box(rail, shrunk(y, 0.01), (high - 0.008, high + 0.012)))
        m.add("lid", box(shrunk(x, 0.005), (y[0] - 0.004, y[1] - 0.002), (low, low + 0.006)))
        m.add("lid", box((-0.3 * half, 0.3 * half), (y[0] - 0.012, y[0] + 0.004), (low + 0.001, low + 0.016)))
        m.slide("lid", (0, -1, 0), 0.85 * deep)
        return
    m.add("lid", prism(shape.buffer(0.003), "z", (low, low + 0.012)))
    m.add("lid", box((-0.25 * half, 0.25 * half), (y[0] - 0.018, y[0]), (low + 0.002, low + 0.009)))
    m.hinge("lid", (0, y[1], low), (-1, 0, 0), m.pick(70, 85))


def kitchen_caddy(m: Model) -> None:
    """For scraps: a tapered bin with a hinged lid and a bow, a round pail with a lid to lift, or one hung on a board."""
    kind = m.pick("plastic", "plastic", "pail", "hung")
    half, high = m.number(0.09, 0.14), m.number(0.17, 0.28)
    if kind == "pail":
        _pail(m, m.number(0.075, 0.11), high)
        return
    build = _plastic if kind == "plastic" else _hung
    build(m, half, m.number(1.3, 2.1) * half, high)
