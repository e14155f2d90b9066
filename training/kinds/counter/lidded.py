"""Lidded things for the worktop: butter dishes with their companions, and caddies for scraps."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rod, rounded, tube

SHAPES = ("oblong", "oblong", "round", "bell", "roll", "hinged")


def _knob(m: Model, part: str, at: tuple[float, float, float], size: float) -> None:
    """What a lid is lifted by: a ball, a cone, a bow, a strip, an acorn, or a bird."""
    x, y, z = at
    style = m.pick("ball", "cone", "bow", "strip", "acorn", "bird")
    if style == "ball":
        m.add(
            part,
            rod((x, y, z - 0.002), (x, y, z + 0.4 * size), 0.3 * size, 10),
            ball((x, y, z + 0.8 * size), (0.6 * size,) * 3, m.sections()),
        )
    elif style == "cone":
        m.add(part, lathe([(0.35 * size, -0.002), (0.7 * size, size), (0.5 * size, 1.2 * size)], 12, at))
    elif style == "bow":
        m.add(
            part,
            tube(
                [
                    (x - size, y, z - 0.001),
                    (x - 0.9 * size, y, z + size),
                    (x + 0.9 * size, y, z + size),
                    (x + size, y, z - 0.001),
                ],
                0.22 * size,
                8,
            ),
        )
    elif style == "strip":
        m.add(part, box((x - size, x + size), (y - 0.3 * size, y + 0.3 * size), (z - 0.001, z + 0.9 * size)))
    elif style == "acorn":
        m.add(
            part,
            lathe([(0.2 * size, -0.002), (0.2 * size, 0.3 * size), (0.6 * size, 0.6 * size), (0.1 * size, 1.4 * size)], 12, at),
        )
    else:
        m.add(
            part,
            ball((x, y, z + 0.5 * size), (size, 0.5 * size, 0.6 * size), 10),
            ball((x + 0.9 * size, y, z + 1.1 * size), (0.4 * size,) * 3, 8),
        )


def _butter(m: Model, c: float, z: float, long: float, wide: float) -> None:
    """A piece of butter."""
    if m.chance(0.6):
        m.add(
            BASE, box((c - 0.36 * long, c + m.number(0.0, 0.36) * long), (-0.3 * wide, 0.3 * wide), (z - 0.001, z + 0.4 * wide))
        )


def _oblong(m: Model, k: int, c: float, z: float, size: float) -> float:
    """A plate with a rim under a box with round edges, straight or tapered; gives half its width."""
    long, wide, high = 1.5 * size, 0.85 * size, m.number(0.42, 0.55) * size
    x, y = (c - long / 2, c + long / 2), (-wide / 2, wide / 2)
    plate = rounded(x, y, 0.15 * wide)
    m.add(BASE, prism(plate.buffer(-0.01), "z", (z, z + 0.006)), prism(plate, "z", (z + 0.005, z + 0.011)))
    if m.chance(0.5):
        m.add(BASE, prism(Polygon(plate.exterior.coords, [plate.buffer(-0.005).exterior.coords]), "z", (z + 0.01, z + 0.017)))
    if m.chance(0.4):
        m.add(
            BASE,
            *(
                tube(
                    [
                        (s_x, -0.02, z + 0.008),
                        (s_x + s * 0.018, -0.015, z + 0.01),
                        (s_x + s * 0.018, 0.015, z + 0.01),
                        (s_x, 0.02, z + 0.008),
                    ],
                    0.004,
                    6,
                )
                for s, s_x in ((-1, x[0] + 0.003), (1, x[1] - 0.003))
            ),
        )
    low, part, inner = z + 0.0115, f"lid_{k}", plate.buffer(-0.012)
    top, t = low + high, 0.005
    if m.chance(0.5):
        m.add(part, cut(prism(inner, "z", (low, top)), prism(inner.buffer(-t), "z", (low - 1, top - t))))
    else:
        a, b = shrunk(x, 0.014), shrunk(y, 0.014)
        slope = [(b[0], low), (b[1], low), (b[1] - 0.15 * wide, top), (b[0] + 0.15 * wide, top)]
        hollow = [
            (b[0] + t, low - 1),
            (b[1] - t, low - 1),
            (b[1] - t, low),
            (b[1] - 0.15 * wide - t, top - t),
            (b[0] + 0.15 * wide + t, top - t),
            (b[0] + t, low),
        ]
        m.add(part, cut(prism(slope, "x", a), prism(hollow, "x", shrunk(a, t))))
    _butter(m, c, z + 0.011, 0.8 * long, 0.5 * wide)
    _knob(m, part, (c, 0, top), 0.12 * size)
    m.slide(part, (0, 0, 1), m.number(0.6, 1.2) * high)
    return long / 2


def _round(m: Model, k: int, c: float, z: float, size: float, bell: bool) -> float:
    """A pot or a plate with a turned lid: a bell over a plate, or a flat or domed lid on a bowl."""
    r, n = m.number(0.45, 0.62) * size, m.pick(16, 24, 32)
    part, t = f"lid_{k}", 0.005
    if bell:
        m.add(BASE, lathe([(0.7 * r, 0), (1.15 * r, 0.012), (1.15 * r, 0.016), (0.7 * r, 0.007)], n, (c, 0, z)))
        rim, h = z + 0.0135, m.number(0.7, 1.1) * r
        turn = np.linspace(0, 0.5 * np.pi, 6)[:-1]
        outer = [(r * np.cos(a), 0.3 * h + 0.7 * h * np.sin(a)) for a in turn] + [(0.1 * r, h)]
        profile = [(r, 0), *outer, *((max(p - t, 0.05 * r), q - t) for p, q in outer[::-1]), (r - t, 0), (r, 0)]
        m.add(part, lathe(profile, n, (c, 0, rim), caps=False))
        top, travel = rim + h, 1.1 * h
        _butter(m, c, z + 0.01, r, r)
    else:
        h = m.number(0.8, 1.5) * r
        waist = m.number(0.75, 1.1)
        body = [(0.7 * r, 0), (waist * r, 0.5 * h), (r, h), (r - t, h), (waist * r - t, 0.5 * h), (0.65 * r, t)]
        m.add(BASE, lathe(body, n, (c, 0, z)))
        dome, over = m.number(0.1, 0.4) * r, m.pick(0.96, 1.0, 1.06)
        m.add(part, lathe([(over * r, 0.0008), (over * r, 0.006), (0.5 * r, dome), (0.1 * r, dome + 0.004)], n, (c, 0, z + h)))
        m.add(part, rod((c, 0, z + h - 0.008), (c, 0, z + h + 0.003), 0.82 * r, n))
        top, travel = z + h + dome + 0.003, m.number(0.04, 0.07)
        if m.chance(0.4):
            m.add(
                BASE,
                tube(
                    [
                        (c + 0.9 * r, 0, z + 0.8 * h),
                        (c + 1.5 * r, 0, z + 0.7 * h),
                        (c + 1.4 * r, 0, z + 0.35 * h),
                        (c + 0.85 * r, 0, z + 0.3 * h),
                    ],
                    0.004,
                    6,
                ),
            )
    _knob(m, part, (c, 0, top), 0.12 * size)
    m.slide(part, (0, 0, 1), travel)
    return 1.2 * r


def _roll(m: Model, k: int, c: float, z: float, size: float) -> float:
    """A dish between two discs in whose axle a half drum turns down below the dish."""
    r, half, n, part = 0.5 * size, 0.75 * size, 14, f"lid_{k}"
    at = z + r + 0.006
    m.add(BASE, *(rod((c + s * half, 0, z), (c + s * half, 0, z + 0.012), 0.35 * r, 10) for s in (-0.85, 0.85)))
    t = np.linspace(np.pi + 0.05, 2 * np.pi - 0.05, n)
    bowl = [(0.86 * r * np.cos(a), at + 0.86 * r * np.sin(a)) for a in t] + [
        (0.8 * r * np.cos(a), at + 0.8 * r * np.sin(a)) for a in t[::-1]
    ]
    m.add(BASE, prism(bowl, "x", (c - 0.94 * half, c + 0.94 * half)))
    m.add(BASE, box((c - 0.94 * half, c + 0.94 * half), (-0.8 * r, 0.8 * r), (at - 0.3 * r, at - 0.25 * r)))
    disc = Polygon([(0.86 * r * np.cos(a), at + 0.86 * r * np.sin(a)) for a in t])
    m.add(BASE, *(prism(disc, "x", (a - 0.003, a)) for a in (c - 0.94 * half + 0.003, c + 0.94 * half)))
    m.add(
        BASE,
        *(box((a - 0.006, a + 0.006), (-0.3 * r, 0.3 * r), (z + 0.01, at - 0.8 * r)) for a in (c - 0.8 * half, c + 0.8 * half)),
    )
    u = np.linspace(0.02, np.pi - 0.02, n)
    drum = [(p * np.cos(a), at + p * np.sin(a)) for p, way in ((r, u), (r - 0.004, u[::-1])) for a in way]
    m.add(part, prism(drum, "x", (c - half, c + half)))
    cap = Polygon([(r * np.cos(a), at + r * np.sin(a)) for a in u])
    m.add(part, *(prism(cap, "x", tuple(sorted((c + s * half, c + s * (half - 0.003))))) for s in (-1, 1)))
    m.add(
        part,
        *(rod((c + s * (half - 0.004), 0, at + 0.006), (c + s * (half + 0.006), 0, at + 0.006), 0.006, 10) for s in (-1, 1)),
    )
    m.add(part, box((c - 0.15 * half, c + 0.15 * half), (-r - 0.014, -r + 0.001), (at + 0.08 * r, at + 0.16 * r)))
    _butter(m, c, at - 0.25 * r, 1.5 * half, r)
    m.hinge(part, (c, 0, at), (-1, 0, 0), m.pick(120, 150, 170))
    return half


def _hinged(m: Model, k: int, c: float, z: float, size: float) -> float:
    """A box with a lid hinged at its long side behind."""
    long, wide, high, part = 1.4 * size, 0.9 * size, 0.4 * size, f"lid_{k}"
    x, y, t = (c - long / 2, c + long / 2), (-wide / 2, wide / 2), 0.005
    shape = rounded(x, y, m.pick(0.004, 0.02))
    m.add(BASE, cut(prism(shape, "z", (z, z + high)), prism(shape.buffer(-t), "z", (z + t, 1))))
    top = (z + high + 0.0008, z + high + m.number(0.01, 0.03))
    m.add(part, prism(shape.buffer(m.pick(0.0, 0.003)), "z", top))
    m.add(part, box((c - 0.015, c + 0.015), (y[0] - 0.012, y[0] + 0.004), (top[0] + 0.001, top[0] + 0.007)))
    m.add(
        m.pick(part, BASE),
        *(
            rod((c + a - 0.012, y[1] + 0.003, top[0]), (c + a + 0.012, y[1] + 0.003, top[0]), 0.004, 8)
            for a in (-0.3 * long, 0.3 * long)
        ),
    )
    m.hinge(part, (c, y[1] + 0.003, top[0]), (-1, 0, 0), m.pick(80, 100, 115))
    return long / 2


def butter_dish_set(m: Model) -> None:
    """One to three lidded dishes on the table or a tray: boxes, bells, pots, a roll-top, a hinged one."""
    count, at = m.pick(1, 1, 2, 3), 0.0
    z = 0.008 if count > 1 and m.chance(0.6) else 0.0
    spare = 0.0
    for k in range(count):
        style, size = m.pick(*SHAPES), m.number(0.085, 0.13)
        center = at + (0.8 * size if k else 0.0)
        build = {"oblong": _oblong, "roll": _roll, "hinged": _hinged}.get(style)
        half = build(m, k, center, z, size) if build else _round(m, k, center, z, size, style == "bell")
        spare = max(spare, 0.68 * size)
        at = center + half + 0.02
    if z:
        shape = rounded((-0.115, at + 0.015), (-spare - 0.02, spare + 0.02), 0.03)
        m.add(BASE, prism(shape, "z", (-0.002, z + 0.001)))
        m.add(BASE, prism(Polygon(shape.exterior.coords, [shape.buffer(-0.005).exterior.coords]), "z", (z, z + 0.012)))
    elif count > 1:
        m.add(BASE, prism(rounded((-0.115, at + 0.015), (-spare - 0.01, spare + 0.01), 0.02), "z", (-0.012, 0.001)))
