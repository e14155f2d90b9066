"""Foosball tables and gumball machines."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, ball, box, cut, prism, rectangle, rod, tube
from training.kinds.wheels import beam, lathe, upright


def foosball_table(m: Model) -> None:
    """A table with rods of players that turn and slide; legs, goals, counters, cup holders, a frame below."""
    rods = m.pick(4, 6, 8, 8, 8)
    long, wide = {4: 0.7, 6: 1.0, 8: m.number(1.2, 1.45)}[rods] * m.number(0.95, 1.05), {4: 0.42, 6: 0.55, 8: 0.75}[rods]
    table = rods > 4 or m.chance(0.4)
    high = m.number(0.82, 0.92) if table else m.number(0.14, 0.2)
    deep, wall, k = (m.number(0.2, 0.3) if table else high - 0.02), m.number(0.018, 0.03), wide / 0.75
    x, y, z = (-long / 2, long / 2), (-wide / 2, wide / 2), (high - deep, high)
    field, axle = high - 0.14 * (0.6 + 0.4 * k), high - 0.035 * (0.5 + 0.5 * k)
    holes = [
        rod((c, y[0] - 1, axle), (c, y[1] + 1, axle), 0.012 * k, 8) for c in np.linspace(-1, 1, rods) * (long / 2 - 0.09 * k)
    ]
    for c, s in ((y[0], 1), (y[1], -1)):
        m.add(BASE, cut(box(x, (c, c + s * wall), z), *holes))
    goal = 0.13 * k
    for a, s in ((x[0], 1), (x[1], -1)):
        end = box((a, a + s * wall), shrunk(y, wall), z)
        m.add(
            BASE,
            cut(end, box((a - 1, a + 1), (-goal, goal), (field + 0.002, field + 0.07 * k + 0.01))) if m.chance(0.8) else end,
        )
        if m.chance(0.5):
            m.add(BASE, box((a - s * 0.03, a), (-goal - 0.02, goal + 0.02), (field - 0.08 * k, field - 0.02)))
    m.add(BASE, box(shrunk(x, wall), shrunk(y, wall), (field - 0.01, field)))
    if m.chance(0.5):
        m.add(BASE, prism(rectangle(x, y, wall + 0.01), "z", (high, high + 0.012)))
    _field_marks(m, wide, field, k)
    teams, bar, n, grip = _teams(rods), 0.0075 * (0.5 + 0.5 * k), m.sections(), m.pick("round", "taper", "hex")
    for i, c in enumerate(np.linspace(-1, 1, rods) * (long / 2 - 0.09 * k)):
        s = -1 if i in _near(rods) else 1
        _player_rod(m, f"rod_{i}", (c, wide, axle), (teams[i], s, bar, k, axle - field), grip, n, wall)
    _table_legs(m, x, y, z, table)
    for s in (-1, 1) if m.chance(0.6) else ():  # counters: beads on a wire
        b, top = s * 0.12 * wide, high + 0.035
        m.add(BASE, tube([(-long / 2 + 0.01, b - 0.1 * k, high), (-long / 2 + 0.01, b - 0.1 * k, top),
                          (-long / 2 + 0.01, b + 0.1 * k, top), (-long / 2 + 0.01, b + 0.1 * k, high)], 0.003, 6))  # fmt: skip
        beads, a = np.arange(10) * 0.013 * k - 0.09 * k + b, (-long / 2, -long / 2 + 0.02)
        m.add(BASE, *(box(a, (c, c + 0.01 * k), (top - 0.01, top + 0.01)) for c in beads))


def _field_marks(m: Model, wide: float, z: float, k: float) -> None:
    """The line across the field and the circle in its middle."""
    if m.chance(0.7):
        m.add(BASE, box((-0.004, 0.004), (-0.42 * wide, 0.42 * wide), (z, z + 0.001)))
        m.add(BASE, prism(Dot(0, 0).buffer(0.1 * k).difference(Dot(0, 0).buffer(0.093 * k)), "z", (z, z + 0.001)))


def _near(rods: int) -> tuple[int, ...]:
    """The rods whose handles lie at the near side."""
    return {4: (0, 2), 6: (0, 1, 3), 8: (0, 1, 3, 5)}[rods]


def _teams(rods: int) -> list[int]:
    return {4: [1, 3, 3, 1], 6: [1, 2, 3, 3, 2, 1], 8: [1, 2, 3, 5, 5, 3, 2, 1]}[rods]


def _player_rod(
    m: Model, part: str, at: Point, look: tuple[int, int, float, float, float], grip: str, n: int, wall: float
) -> None:
    """A rod through both walls with its players, stops and a grip; it turns in bearings."""
    c, wide, z = (float(v) for v in at)
    count, s, r, k, drop = look
    pitch = {1: 0.0, 2: 0.32, 3: 0.25, 5: 0.16}[count] * wide
    reach = (wide - 2 * wall - pitch * (count - 1)) / 2 - 0.035 * k
    reach = min(reach, 0.14 * k)
    out = wide / 2 + reach + 0.01
    solids = [rod((c, -s * (out + 0.03 * k), z), (c, s * (out + 0.02), z), r, n)]
    g = 0.12 * (0.5 + 0.5 * k)
    thick = {"round": 0.016, "taper": 0.018, "hex": 0.017}[grip] * (0.5 + 0.5 * k)
    if grip == "taper":
        solids += upright(
            [lathe([(0, 0), (0.8 * thick, 0), (thick, 0.7 * g), (0.7 * thick, g), (0, g)], n)], (0, s, 0), (c, s * out, z)
        )
    else:
        solids.append(rod((c, s * out, z), (c, s * (out + g), z), thick, 6 if grip == "hex" else n))
    solids.append(rod((c, -s * (out + 0.03 * k), z), (c, -s * (out + 0.045 * k), z), 1.5 * r, 10))
    foot = drop - 0.008
    for b in (np.arange(count) - (count - 1) / 2) * pitch:
        w = 0.014 * k + 0.003
        solids.append(box((c - 0.5 * w, c + 0.5 * w), (b - w, b + w), (z - 0.75 * foot, z + 0.25 * foot)))
        solids.append(beam((c, b, z - 0.7 * foot), (c, b, z - foot), 0.9 * w, 1.6 * w, (1, 0, 0)))
        solids.append(ball((c, b, z + 0.25 * foot + 0.6 * w), (0.75 * w,) * 3, 8))
    m.add(part, *solids)
    m.add(BASE, *(rod((c, t * wide / 2, z), (c, t * (wide / 2 + 0.006), z), 2.2 * r, 12) for t in (-1, 1)))
    m.spin(part, (c, 0, z), (0, s, 0))


def _table_legs(m: Model, x: Span, y: Span, z: Span, table: bool) -> None:
    """Legs of one of four kinds, or feet for one that stands on a table."""
    if not table:
        m.add(BASE, *(rod((a, b, 0), (a, b, z[0] + 0.002), 0.02, 10) for a in shrunk(x, 0.05) for b in shrunk(y, 0.05)))
        m.add(BASE, box(shrunk(x, 0.01), shrunk(y, 0.01), (z[0], z[0] + 0.006)))
        return
    style, w = m.pick("posts", "slabs", "splayed", "steel"), m.number(0.07, 0.12)
    for a, s in ((x[0], 1), (x[1], -1)):
        if style == "slabs":
            m.add(BASE, box((a + s * 0.05, a + s * 0.09), shrunk(y, 0.04), (0.0, z[0] + 0.001)))
        for b, t in ((y[0], 1), (y[1], -1)):
            if style == "posts":
                m.add(BASE, box((a + s * 0.01, a + s * (0.01 + w)), (b + t * 0.01, b + t * (0.01 + w)), (0.02, z[0] + 0.05)))
                m.add(BASE, rod((a + s * 0.06, b + t * 0.06, 0), (a + s * 0.06, b + t * 0.06, 0.03), 0.025, 10))
            elif style == "splayed":
                m.add(BASE, beam((a + s * 0.12, b + t * 0.08, z[0] + 0.02), (a + s * 0.02, b, 0), w, w, taper=0.6))
            elif style == "steel":
                m.add(BASE, rod((a + s * 0.07, b + t * 0.06, 0.02), (a + s * 0.07, b + t * 0.06, z[0] + 0.001), 0.03, 12))
                m.add(BASE, rod((a + s * 0.07, b + t * 0.06, 0), (a + s * 0.07, b + t * 0.06, 0.03), 0.05, 12))
    if style in ("posts", "slabs") and m.chance(0.6):
        m.add(BASE, box((x[0] + 0.06, x[1] - 0.06), (-0.03, 0.03), (0.15, 0.22)) if style == "slabs"
              else box((x[0] + 0.03, x[1] - 0.03), (y[0] + 0.03, y[0] + 0.06), (0.2, 0.25)))  # fmt: skip


def gumball_machine(m: Model) -> None:
    """A globe or a box of glass full of sweets on a body with a crank, a chute with a flap, a lid; on a stand or a foot."""
    style, n = m.pick("globe", "globe", "square", "jar"), m.pick(12, 16, 24)
    r, low = m.number(0.09, 0.16), 0.0
    stand = m.chance(0.4)
    if stand:
        low = m.number(0.55, 0.8)
        m.add(BASE, lathe([(0, 0), (1.2 * r, 0), (1.15 * r, 0.02), (0.25 * r, 0.05), (0, 0.05)], n))
        m.add(BASE, rod((0, 0, 0.04), (0, 0, low + 0.002), m.number(0.02, 0.03), n))
    tall, square = m.number(1.0, 1.5) * r, style == "square" or m.chance(0.25)
    top = low + tall + 0.02
    if square:
        m.add(BASE, box((-0.8 * r, 0.8 * r), (-0.8 * r, 0.8 * r), (low, top)))
        face = skirt = 0.8 * r
    else:
        flare = m.number(0.75, 1.15)
        m.add(
            BASE,
            lathe(
                [
                    (0, 0),
                    (flare * r, 0),
                    (flare * r, 0.015),
                    (0.7 * r, 0.5 * tall),
                    (0.75 * r, tall),
                    (0.75 * r, tall + 0.02),
                    (0, tall + 0.02),
                ],
                n,
                (0, 0, low),
            ),
        )
        face, skirt = 0.74 * r, (flare - 0.1 * (flare - 0.7)) * r
    _crank(m, face, low, tall, skirt)
    wide, roof = _glass(m, style, r, top, n)
    _lid(m, style, wide, roof, n)


def _lid(m: Model, style: str, wide: float, roof: float, n: int) -> None:
    """The lid: it lifts off, swings up or is fixed; perhaps with a lock."""
    lid = [
        (0, 0),
        (1.12 * wide, 0),
        (1.12 * wide, 0.012),
        (0.8 * wide, 0.03),
        (0.15 * wide, 0.04),
        (0.15 * wide, 0.055),
        (0, 0.06),
    ]
    solids = (
        [lathe(lid, n, (0, 0, roof))]
        if style != "square"
        else [box((-1.05 * wide, 1.05 * wide), (-1.05 * wide, 1.05 * wide), (roof, roof + 0.025))]
    )
    if m.chance(0.6):  # the lock on the lid
        z = roof + (0.025 if style == "square" else 0.055)
        solids.append(rod((0, 0, z - 0.005), (0, 0, z + 0.012), 0.011, 10))
    how = m.pick("lift", "hinge", "fixed")
    part = BASE if how == "fixed" else "lid"
    m.add(part, *solids)
    if how == "lift":
        m.slide("lid", (0, 0, 1), m.number(0.04, 0.1))
    elif how == "hinge":
        m.hinge("lid", (0, (1.05 if style == "square" else 1.12) * wide, roof), (-1, 0, 0), m.number(80, 110))


def _glass(m: Model, style: str, r: float, z: float, n: int) -> tuple[float, float]:
    """The glass and the sweets in it; returns the half width and the height of its mouth."""
    t = np.linspace(-1.1, 1.15, 12)
    if style == "square":
        a = 0.8 * r
        m.add(
            BASE,
            *(box((s * a, s * a - s * 0.006), (q * a, q * a - q * 0.006), (z, z + 1.8 * r)) for s in (-1, 1) for q in (-1, 1)),
        )
        m.add(BASE, *(box((s * (a - 0.001), s * (a - 0.004)), (-a + 0.006, a - 0.006), (z, z + 1.8 * r)) for s in (-1, 1)))
        m.add(BASE, *(box((-a + 0.006, a - 0.006), (s * (a - 0.001), s * (a - 0.004)), (z, z + 1.8 * r)) for s in (-1, 1)))
        mouth, roof, fill = a, z + 1.8 * r, a - 0.012
    elif style == "globe":
        profile = [(r * np.cos(a), r * (np.sin(a) + np.sin(1.1))) for a in t]
        mouth, roof, fill = profile[-1][0], z + profile[-1][1], 0.7 * r
        m.add(BASE, lathe([*profile, *((max(p - 0.004, 0.01), q) for p, q in profile[::-1]), profile[0]], n, (0, 0, z)))
    else:
        h = m.number(1.6, 2.4) * r
        profile = [(0.7 * r, 0), (0.85 * r, 0.1 * h), (0.85 * r, 0.75 * h), (0.55 * r, 0.95 * h), (0.55 * r, h)]
        mouth, roof, fill = 0.55 * r, z + h, 0.7 * r
        m.add(BASE, lathe([*profile, *((p - 0.004, q) for p, q in profile[::-1]), profile[0]], n, (0, 0, z)))
    if m.chance(0.8):
        size = 0.11 * r
        for _ in range(m.pick(14, 24)):
            a, b = m.number(-0.6, 0.6) * fill, m.number(-0.6, 0.6) * fill
            m.add(BASE, ball((a, b, z + m.number(0.9, 5) * size), (size,) * 3, 6))
    return mouth, roof


def _crank(m: Model, face: float, low: float, tall: float, skirt: float) -> None:
    """The coin plate with its crank, and the chute below with a flap."""
    w, z = 0.42 * face + 0.012, low + 0.66 * tall
    y = -face
    m.add(BASE, box((-w, w), (y - 0.012, y + 0.02), (z - 0.8 * w, z + 0.9 * w)))
    y -= 0.012
    if m.chance(0.6):
        crank = [
            rod((0, y, z), (0, y - 0.012, z), 0.55 * w, 16),
            box((-0.6 * w, 0.6 * w), (y - 0.03, y - 0.01), (z - 0.14 * w, z + 0.14 * w)),
        ]
    else:
        crank = [
            rod((0, y, z), (0, y - 0.02, z), 0.2 * w, 10),
            rod((0, y - 0.016, z), (0.6 * w, y - 0.016, z + 0.3 * w), 0.1 * w, 8),
        ]
        crank.append(rod((0.6 * w, y - 0.012, z + 0.3 * w), (0.6 * w, y - 0.045, z + 0.3 * w), 0.17 * w, 10))
    m.add("crank", *crank)
    m.spin("crank", (0, y, z), (0, 1, 0))
    m.add(BASE, box((-0.3 * w, -0.15 * w), (y - 0.006, y), (z + 0.6 * w, z + 0.85 * w)))
    c, h = m.number(0.6, 0.9) * w, 0.25 * tall
    b = low + 0.08 * tall
    out = min(y, -skirt) - m.number(0.002, 0.02)
    rear = -0.5 * face
    m.add(BASE, *(box((s * c, s * (c - 0.004)), (out, rear), (b, b + h)) for s in (-1, 1)))
    m.add(BASE, box((-c, c), (out, rear), (b, b + 0.004)), box((-c, c), (out, rear), (b + h - 0.004, b + h)))
    if m.chance(0.85):
        m.add("flap", box((-c, c), (out - 0.004, out - 0.0005), (b, b + h)))
        if m.chance(0.5):
            m.add("flap", box((-0.3 * c, 0.3 * c), (out - 0.012, out - 0.004), (b + 0.1 * h, b + 0.2 * h)))
        m.hinge("flap", (0, out - 0.002, b + h), (-1, 0, 0), m.number(50, 90))
