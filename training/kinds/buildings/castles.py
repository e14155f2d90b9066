"""Castle gates: a portcullis, two doors, a winch."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import arch, ball, box, cut, prism, rectangle, ring, rod, vec
from training.kinds.wheels import beam, lathe


def portcullis_gate(m: Model) -> None:
    """A wall or a gatehouse with a gateway: a grid that is raised in a slot or behind the wall, doors, a winch wheel."""
    half, high = m.number(1.2, 2.0), m.number(2.8, 4.2)
    form = m.pick("grid", "grid", "both", "doors")
    thick, up = m.number(1.0, 1.8), m.number(0.85, 1.0) * high
    wide, top = half + m.number(0.8, 2.5), high + m.number(1.0, 1.6)
    rise = m.pick(0.0, 0.5, 1.0) * half
    way = arch((-half, half), (-1, high), rise, m.pick(6, 10, 16)) if rise else rectangle((-half, half), (-1, high))
    slot, deep = m.chance(0.6) and form != "doors", m.number(0.08, 0.16)
    at = m.number(0.3, 0.5) * thick if slot else thick + 0.5 * deep + 0.03
    winch = form != "doors" and m.chance(0.5)
    if winch:
        wide = max(wide, half + 1.4)
    if slot:
        top = max(top, high + 0.55 * up)
    wall = cut(box((-wide, wide), (0, thick), (0, top)), prism(way, "y", (-1, thick + 1)))
    if slot:
        wall = cut(wall, box((-half - 0.12, half + 0.12), (at - 0.5 * deep - 0.01, at + 0.5 * deep + 0.01), (-1, top + 1)))
    m.add(BASE, wall)
    if form != "doors":
        _grid(m, half if slot else half + 0.12, high, at, deep, up)
        if not slot:
            for s in (-1, 1):
                m.add(
                    BASE, box((s * (half + 0.05), s * (half + 0.25)), (thick - 0.01, at - 0.5 * deep - 0.005), (0, high + 0.4))
                )
                m.add(
                    BASE, box((s * (half + 0.14), s * (half + 0.25)), (thick - 0.01, at + 0.5 * deep + 0.08), (0, high + 0.4))
                )
    if form != "grid":
        if form == "doors" and not rise and m.chance(0.6):
            _doors(m, half - 0.105, high - 0.11, m.number(0.05, 0.5) * thick, rise, None)
        else:
            _doors(m, half, high, thick + (2 * deep + 0.14 if form == "both" and not slot else 0.02), rise, thick)
    _battlements(m, wide, thick, top, at if slot else None, deep)
    if m.chance(0.75):
        _towers(m, wide, thick, top)
    if winch:
        _winch(m, half, thick, wide)
    if m.chance(0.4):
        m.add(
            BASE,
            cut(
                prism(way.buffer(0.22, join_style="mitre"), "y", (-0.08, 0.02)),
                prism(way, "y", (-1, 1)),
                box((-9, 9), (-9, 9), (-9, 0)),
            ),
        )


def _grid(m: Model, half: float, high: float, y: float, deep: float, up: float) -> None:
    """Bars with points below; round or square, with plates over the crossings in some."""
    count, rows, r = m.pick(5, 7, 9), m.pick(4, 6, 8), 0.36 * deep
    timber, pointed = m.chance(0.5), m.chance(0.85)
    thin = r if timber else 0.5 * r
    xs = np.linspace(-half + 0.06, half - 0.06, count)
    end = high + m.number(0.05, 0.2)
    for x in xs:
        bar = box((x - thin, x + thin), (y - 0.5 * deep, y), (0.25, end)) if timber else rod((x, y, 0.25), (x, y, end), thin, 8)
        m.add("portcullis", bar)
        if pointed:
            m.add(
                "portcullis",
                lathe(
                    [(0, 0.02), (1.3 * thin, 0.26), (0, 0.26)], 4 if timber else 8, (x, y - (0.25 * deep if timber else 0), 0)
                ),
            )
    for z in np.linspace(0.45, high - 0.1, rows):
        m.add(
            "portcullis",
            box(
                (xs[0] - 0.05, xs[-1] + 0.05),
                (y - (0.02 if timber else 0.6 * r), y + 0.48 * deep),
                (z - 0.8 * thin, z + 0.8 * thin),
            ),
        )
        if m.chance(0.3):
            m.add("portcullis", *(ball((x, y - (0.5 * deep if timber else thin), z), (0.6 * thin,) * 3, 6) for x in xs))
    m.slide("portcullis", (0, 0, 1), 0.95 * up)


def _doors(m: Model, half: float, high: float, y: float, rise: float, wall: float | None) -> None:
    """Two leaves that swing inwards, behind a wall that ends at `wall` or in the gateway, of planks with straps and rings."""
    t, gap, planks = m.number(0.08, 0.14), 0.004 + m.gap(1.0), m.pick(1, 4, 6)
    wide, rim = half + 0.1, high + 0.1
    studs, straps = m.chance(0.4), m.pick(0, 2, 3)
    for s, side in ((-1, "left"), (1, "right")):
        part = f"door_{side}"
        edges = np.linspace(abs(gap), wide, planks + 1)
        for a, b in pairwise(edges):
            b -= 0.01 if planks > 1 else 0.0
            m.add(part, box((s * a, s * b), (y, y + t), (0.03, rim)))
        if planks > 1:
            for z in (0.2 * high, 0.85 * high):
                m.add(part, box((s * abs(gap), s * (wide - 0.01)), (y + 0.9 * t, y + 1.5 * t), (z - 0.1, z + 0.1)))
        for z in np.linspace(0.15, 0.9, straps) * (high - 0.4 * rise) if straps else ():
            m.add(part, box((s * 0.25 * half, s * (half - 0.02)), (y - 0.015, y + 0.002), (z - 0.05, z + 0.05)))
            if studs:
                m.add(part, *(ball((s * q * half, y - 0.015, z), (0.03, 0.02, 0.03), 6) for q in (0.35, 0.55, 0.75)))
        if m.chance(0.7):
            m.add(
                part,
                ring((s * 0.15 * half, y - 0.03, 0.42 * high), (0, 1, 0), 0.1, 0.018, 12),
                box((s * 0.11 * half, s * 0.19 * half), (y - 0.04, y + 0.002), (0.42 * high + 0.07, 0.42 * high + 0.14)),
            )
        back = y + (1.5 * t if wall is None and planks > 1 else t)
        m.hinge(part, (s * wide, back, 0.5 * high), (0, 0, -s), 90 if wall is None else m.pick(90, 100))
        if wall is None:
            continue
        m.add(
            BASE,
            *(
                rod((s * (wide + 0.03), y + t, z - 0.1), (s * (wide + 0.03), y + t, z + 0.1), 0.04, 8)
                for z in (0.2 * high, 0.85 * high)
            ),
        )
        m.add(
            BASE,
            *(
                box((s * (wide + 0.02), s * (wide + 0.2)), (wall - 0.01, y + t), (z - 0.04, z + 0.04))
                for z in (0.2 * high, 0.85 * high)
            ),
        )


def _battlements(m: Model, wide: float, thick: float, top: float, slot: float | None, deep: float) -> None:
    """Merlons along the front of the top, and the back in some, or a plain coping."""
    count, size = m.pick(3, 4, 6), m.number(0.3, 0.6)
    step = 2 * wide / (2 * count - 1)
    if m.chance(0.85):
        behind = m.chance(0.7)
        for k in range(count):
            x = -wide + 2 * k * step
            m.add(BASE, box((x, x + step), (0, 0.22), (top - 0.01, top + size)))
            if behind:
                m.add(BASE, box((x, x + step), (thick - 0.22, thick), (top - 0.01, top + size)))
    else:
        m.add(
            BASE,
            *(
                box((-wide - 0.05, wide + 0.05), y, (top - 0.01, top + 0.15))
                for y in ((-0.08, 0.25), (thick - 0.25, thick + 0.08))
            ),
        )
    if slot is not None and m.chance(0.3):
        m.add(
            BASE,
            *(box((s * 0.75 * wide, s * 0.9 * wide), (slot - deep, slot + deep), (top - 0.01, top + 0.8)) for s in (-1, 1)),
        )


def _towers(m: Model, wide: float, thick: float, top: float) -> None:
    """A tower on either side: round or square, with a roof or merlons, and slits."""
    r, n, tall = m.number(0.7, 1.1) * thick, m.pick(8, 12, 20), top + m.number(0.6, 2.5)
    round_, roof = m.chance(0.55), m.chance(0.45)
    for s in (-1, 1):
        x, y = s * (wide + 0.8 * r), 0.5 * thick
        body = (
            lathe([(0, 0), (1.1 * r, 0), (r, 0.3 * tall), (r, tall), (0, tall)], n, (x, y, 0))
            if round_
            else box((x - r, x + r), (y - r, y + r), (0, tall))
        )
        m.add(BASE, body)
        if roof and round_:
            m.add(BASE, lathe([(0, -0.001), (1.2 * r, -0.001), (0, 1.6 * r)], n, (x, y, tall)))
        elif roof:
            q = 1.15 * r
            m.add(
                BASE, prism(Polygon([(x - q, tall - 0.001), (x + q, tall - 0.001), (x, tall + 1.2 * r)]), "y", (y - q, y + q))
            )
        elif round_:
            m.add(
                BASE,
                *(
                    rod(
                        (x + 0.85 * r * np.cos(t), y + 0.85 * r * np.sin(t), tall - 0.02),
                        (x + 0.85 * r * np.cos(t), y + 0.85 * r * np.sin(t), tall + 0.5),
                        0.14 * r,
                        6,
                    )
                    for t in np.arange(6)
                ),
            )
        else:
            m.add(
                BASE,
                *(
                    box((x + a * 0.55 * r, x + a * r), (y + b * 0.55 * r, y + b * r), (tall - 0.01, tall + 0.5))
                    for a in (-1, 1)
                    for b in (-1, 1)
                ),
            )
        if m.chance(0.5):
            m.add(BASE, box((x - 0.06, x + 0.06), (y - 1.1 * r - 0.03, y - 0.8 * r), (0.6 * top, 0.6 * top + 0.7)))


def _winch(m: Model, half: float, thick: float, wide: float) -> None:
    """A drum with a spoked wheel or crossed bars, on posts at the back of the wall or on a bracket beside the gateway."""
    z, y, n = m.number(1.0, 1.3), thick + m.number(0.5, 0.7), m.pick(8, 12, 16)
    x = half + 0.72
    far = max(wide - 0.1, x + 0.5)
    for a in (x, far):
        m.add(
            BASE,
            box((a - 0.06, a + 0.06), (y - 0.1, y + 0.1), (0, z + 0.12)),
            box((a - 0.05, a + 0.05), (thick - 0.01, y), (z - 0.3, z - 0.2)),
        )
    hub = vec(far + 0.18, y, z)
    m.add("winch", rod((x - 0.08, y, z), hub + vec(0.05, 0, 0), 0.045, n), rod((x + 0.08, y, z), (far - 0.08, y, z), 0.13, n))
    r, count = m.number(0.4, 0.6), m.pick(4, 6, 8)
    for t in np.arange(count) * 2 * np.pi / count:
        m.add("winch", beam(hub, hub + r * vec(0, np.cos(t), np.sin(t)), 0.04, 0.04))
    if m.chance(0.7):
        m.add("winch", ring(hub, (1, 0, 0), 0.85 * r, 0.035, n + 6))
    m.spin("winch", hub, (1, 0, 0))
