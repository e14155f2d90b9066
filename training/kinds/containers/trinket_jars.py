"""Vessels of one artist: cookie jars, tea pots, casseroles."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, ring, rod, tube, turned, vec
from training.kinds.trinket_style import Look, band, draw_look, ear, knob, outline, shell, slab, spun


def cookie_jar(m: Model) -> None:
    """A belly, a cylinder, a square jar or a sitting animal, with a lid that lifts off or hangs on a hinge."""
    look = draw_look(m)
    r, high, t = m.number(0.06, 0.11), m.number(0.12, 0.24), m.number(0.003, 0.006)
    kind = m.pick("belly", "straight", "square", "animal")
    line = outline(look.n, m.pick(4.0, 6.0)) if kind == "square" else outline(look.n, deep=m.pick(1.0, 1.0, 0.85))
    neck = m.number(0.65, 0.9) * r if kind != "square" else 0.95 * r
    if kind in ("belly", "animal"):
        body = [(0, 0), (0.65 * r, 0), (0.95 * r, 0.25 * high), (r, 0.5 * high), (0.95 * r, 0.75 * high), (neck, high)]
    else:
        body = [(0, 0), (0.9 * r, 0), (r, 0.05 * high), (r, 0.9 * high), (neck, high)]
    m.add(BASE, shell(look, body, t, line))
    gap = max(m.gap(0.04), 0.0)
    z = high + gap
    rise = m.number(0.15, 0.5) * r if kind != "animal" else 1.1 * neck
    over = 1.01 if look.style == "sheet" else 1.05
    lid = [(over * neck, z), (over * neck, z + 0.25 * rise), (0.8 * neck, z + 0.75 * rise), (0, z + rise)]
    if kind == "animal":
        lid = [(neck, z), (1.15 * neck, z + 0.4 * rise), (0.9 * neck, z + 0.8 * rise), (0, z + rise)]
    m.add("lid", shell(look, lid, t, line, down=True))
    if kind == "animal":
        _face(m, look, neck, z, rise, line[:, 1].max())
        m.add(
            BASE,
            *(
                ball((s * 0.55 * r, -0.75 * r * line[:, 1].max(), 0.05 * high), (0.3 * r, 0.4 * r, 0.08 * high), 10)
                for s in (-1, 1)
            ),
        )
    else:
        m.add("lid", *knob(look, (0, 0, z + rise), 0.25 * neck, 0.35 * neck))
        if m.chance(0.4):
            m.add(BASE, *(ear(look, s, (s * 0.93 * r, 0, 0.6 * high), 0.35 * r, 0.3 * high, 0.06 * r) for s in (-1, 1)))
        if look.style in ("old", "assembly"):
            m.add(BASE, *band(look, r, 0.5 * high, 0.03 * r, line))
    if not look.plain and m.chance(0.6):
        inner = [(0, z - 0.1 * neck), (neck - 1.2 * t, z - 0.1 * neck), (neck - 1.2 * t, z + 0.5 * t), (0, z + 0.5 * t)]
        m.add("lid", spun(inner, line))
    m.slide("lid", (0, 0, 1), m.number(0.3, 0.8) * high)


def _face(m: Model, look: Look, r: float, z: float, rise: float, deep: float) -> None:
    """The ears, the nose and the eyes on a lid that is a head."""
    n = max(8, look.n // 2)
    for s in (-1, 1):
        m.add("lid", ball((s * 0.7 * r, 0, z + 0.9 * rise), (0.3 * r, 0.15 * r, 0.35 * r), n))
        m.add("lid", ball((s * 0.35 * r, -0.98 * deep * r, z + 0.55 * rise), (0.08 * r, 0.1 * r, 0.1 * r), n))
    m.add("lid", ball((0, -1.1 * deep * r, z + 0.3 * rise), (0.25 * r, 0.2 * r, 0.18 * r), n))


def tea_pot(m: Model) -> None:
    """A belly with a spout and an ear or a bail over the top; a lid that lifts or tips; perhaps an infuser."""
    look = draw_look(m)
    r, t = m.number(0.05, 0.09), m.number(0.002, 0.004)
    high = m.number(0.9, 1.9) * r
    line = outline(look.n, m.pick(2.0, 2.0, 3.5), lobes=m.pick(0, 0, 8))
    neck = m.number(0.4, 0.65) * r
    tall = m.chance(0.4)
    wide = 0.75 * r if tall else r
    body = [(0, 0), (0.7 * r, 0), (r, 0.15 * high), (wide, 0.6 * high), (1.1 * neck, 0.9 * high), (neck, high)]
    m.add(BASE, shell(look, body, t, line))
    if m.chance(0.5):
        m.add(BASE, spun([(0, -0.05 * r), (0.6 * r, -0.05 * r), (0.55 * r, 0.03 * r), (0, 0.03 * r)], line))
    _spout(m, look, wide, high)
    z, rise = high + max(m.gap(0.03), 0), m.number(0.15, 0.5) * neck
    lid = [(1.06 * neck, z), (1.06 * neck, z + 0.2 * rise), (0.7 * neck, z + 0.8 * rise), (0, z + rise)]
    m.add("lid", shell(look, lid, t, line, down=True), *knob(look, (0, 0, z + rise), 0.22 * neck, 0.4 * neck))
    if m.chance(0.35):
        m.hinge("lid", (-1.06 * neck, 0, z), (0, -1, 0), m.pick(80, 100))
        m.add(BASE, rod((-1.06 * neck, -0.2 * neck, z), (-1.06 * neck, 0.2 * neck, z), 0.07 * neck, 8))
        m.add(BASE, box((-1.15 * neck, -0.97 * neck), (-0.15 * neck, 0.15 * neck), (z - 0.15 * neck, z)))
    else:
        m.slide("lid", (0, 0, 1), m.number(0.3, 0.8) * high)
        if not look.plain and m.chance(0.5):
            cup = [(0, 0.35 * high), (0.7 * neck, 0.35 * high), (0.85 * neck, high), (0.98 * neck, high + 0.002)]
            m.add("infuser", shell(look, cup, 0.001, line))
            m.slide("infuser", (0, 0, 1), 0.6 * high)
    if m.chance(0.4):
        _bail(m, look, 0.99 * wide, 0.62 * high, z + rise + 0.6 * neck)
    else:
        m.add(BASE, ear(look, -1, (-0.9 * wide, 0, 0.5 * high), 0.65 * r, 0.55 * high, 0.07 * r))


def _spout(m: Model, look: Look, r: float, high: float) -> None:
    """A spout that leans out at the right, a tapering bar or a bent tube."""
    end = vec(r + m.number(0.5, 0.9) * r, 0, m.number(0.85, 1.05) * high)
    start = vec(0.75 * r, 0, 0.3 * high)
    if look.plain or m.chance(0.3):
        solid = spun([(0, 0), (0.26 * r, 0), (0.12 * r, 1), (0, 1)], outline(max(6, look.n // 2)))
        way = end - start
        points = solid.vertices
        points[:] = start + points * (1, 1, 0) + points[:, 2:] * way
        m.add(BASE, solid)
        return
    path = [
        start,
        start + vec(0.35 * r, 0, 0.02 * high),
        start + 0.5 * (end - start) + vec(0.12 * r, 0, 0),
        end - vec(0.1 * r, 0, 0),
        end,
    ]
    bow = tube(path, 0.16 * r, 12)
    m.add(BASE, bow, ball(path[0], (0.25 * r, 0.25 * r, 0.2 * high), 12), ring(end, (1, 0, 0.6), 0.15 * r, 0.03 * r, 12))


def _bail(m: Model, look: Look, r: float, low: float, top: float) -> None:
    """A handle over the whole pot that tips to the side."""
    if look.plain:
        path = [(-r, low), (-r, top), (r, top), (r, low)]
    else:
        path = [(-r * np.cos(a), low + (top - low) * np.sin(a) ** 0.7) for a in np.linspace(0, np.pi, 13)]
    m.add("bail", tube([vec(0, x, z) for x, z in path], 0.045 * r, 8))
    if not look.plain:
        m.add("bail", rod((0, -0.35 * r, top), (0, 0.35 * r, top), 0.075 * r, 10))
    m.add(BASE, *(ball((0, s * r, low), (0.1 * r, 0.14 * r, 0.1 * r), 10) for s in (-1, 1)))
    m.hinge("bail", (0, 0, low), (0, -1, 0), (-75, 75) if m.chance(0.5) else (0, 80))


def casserole_pot(m: Model) -> None:
    """A low pot, round, oval or square, with two ears and a lid that lifts; perhaps clips over the lid and a vent."""
    look = draw_look(m)
    r, t = m.number(0.09, 0.15), m.number(0.002, 0.006)
    high = m.number(0.45, 1.0) * r
    line = outline(look.n + 8, m.pick(2.0, 2.0, 5.0), deep=m.pick(1.0, 1.0, 0.7))
    m.add(BASE, shell(look, [(0, 0), (0.9 * r, 0), (0.98 * r, 0.12 * high), (r, high)], t, line))
    if not look.plain:
        m.add(BASE, *band(look, r, 0.97 * high, 0.012 * r, line))
    z, rise = high + 0.02 * r + max(m.gap(0.05), 0), m.number(0.1, 0.35) * r
    lid = [(1.01 * r, z), (1.01 * r, z + 0.1 * rise), (0.85 * r, z + 0.6 * rise), (0.4 * r, z + 0.95 * rise), (0, z + rise)]
    m.add(BASE, shell(look, [(0, high), (0.98 * r, high), (0.98 * r, z)], t, line)) if look.style == "blocky" else None
    m.add("lid", shell(look, lid, t, line, down=True))
    m.add("lid", *knob(look, (0, 0, z + rise), 0.14 * r, 0.2 * r))
    m.slide("lid", (0, 0, 1), m.number(0.4, 0.9) * high)
    _pot_ears(m, look, r, high)
    if m.chance(0.3):
        foot = vec(0.55 * r, 0, z + 0.82 * rise)
        m.add("lid", rod(foot - vec(0, 0, 0.4 * rise), foot + vec(0, 0, 0.03 * r), 0.05 * r, 12))
        m.add("vent", rod(foot + vec(0, 0, 0.03 * r), foot + vec(0, 0, 0.06 * r), 0.06 * r, 12))
        m.add(
            "vent",
            box((foot[0] - 0.02 * r, foot[0] + 0.1 * r), (-0.015 * r, 0.015 * r), (foot[2] + 0.055 * r, foot[2] + 0.08 * r)),
        )
        m.spin("vent", foot + vec(0, 0, 0.04 * r), (0, 0, 1), "lid")


def _pot_ears(m: Model, look: Look, r: float, high: float) -> None:
    """Two fixed handles of one sort at the sides of a pot."""
    kind = m.pick("bar", "plate", "bow")
    for s in (-1, 1):
        x = s * 0.985 * r
        if kind == "plate":
            m.add(
                BASE,
                *slab(
                    look,
                    (x, x + s * 0.22 * r) if s > 0 else (x - 0.22 * r, x),
                    (-0.25 * r, 0.25 * r),
                    (0.72 * high, 0.82 * high),
                    0.06 * r,
                ),
            )
        elif kind == "bow":
            m.add(
                BASE, turned(ear(look, s, (x, 0, 0.78 * high), 0.2 * r, 0.5 * r, 0.035 * r), (1, 0, 0), 90, (x, 0, 0.78 * high))
            )
        else:
            m.add(
                BASE,
                *(
                    box(sorted((x, x + s * 0.2 * r)), sorted((y, y + 0.06 * r)), (0.72 * high, 0.8 * high))
                    for y in (-0.3 * r, 0.24 * r)
                ),
            )
            m.add(
                BASE, rod((x + s * 0.2 * r, -0.35 * r, 0.76 * high), (x + s * 0.2 * r, 0.35 * r, 0.76 * high), 0.05 * r, look.n)
            )
