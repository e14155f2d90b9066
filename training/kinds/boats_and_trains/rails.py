"""Railway wheels, tracks and mine carts."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, loft, prism, rectangle, rod, tube, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import beam, lathe, upright


def flanged(m: Model, r: float, wide: float, spokes: int) -> list[Trimesh]:
    """A railway wheel round the z axis, its flange at -z; solid, or with spokes."""
    h, t = wide / 2, 0.14 * r
    n = 20
    tread = lathe([(r - t, -h), (1.1 * r, -h), (1.1 * r, -0.4 * h), (r, -0.4 * h), (r, h), (r - t, h), (r - t, -h)], n)
    hub = rod((0, 0, -h), (0, 0, 1.2 * h), 0.22 * r, 12)
    if not spokes:
        return [tread, rod((0, 0, -0.4 * h), (0, 0, 0.3 * h), r - t, n), hub]
    turns = 2 * np.pi * np.arange(spokes) / spokes
    bars = [
        beam(
            (0, 0, 0), ((r - 0.9 * t) * np.cos(a), (r - 0.9 * t) * np.sin(a), 0), 0.09 * r, 0.7 * h, (-np.sin(a), np.cos(a), 0)
        )
        for a in turns
    ]
    return [tread, hub, *bars]


def wheelset(m: Model, name: str, y: float, r: float, gauge: float, spokes: int, parent: str = BASE) -> None:
    """Two wheels and their axle as one part that turns."""
    for s in (-1, 1):
        m.add(name, *upright(flanged(m, r, 0.25 * r if r < 0.3 else 0.13, spokes), (s, 0, 0), (s * gauge, y, r)))
    m.add(name, rod((-gauge, y, r), (gauge, y, r), 0.13 * r, 10))
    m.spin(name, (0, y, r), (1, 0, 0), parent)


def track(m: Model, gauge: float, y: Span, size: float) -> None:
    """Two rails on sleepers."""
    m.add(BASE, *(box((s * gauge - 0.3 * size, s * gauge + 0.3 * size), y, (-size, 0)) for s in (-1, 1)))
    m.add(
        BASE,
        *(
            box((-1.5 * gauge, 1.5 * gauge), (c - 0.6 * size, c + 0.6 * size), (-1.8 * size, -size))
            for c in np.arange(y[0] + size, y[1], 4.5 * size)
        ),
    )


def _walled(m: Model, part: str, half: float, y: Span, z: Span, style: str) -> None:
    """A tub with straight or leaning walls, a rim and ribs."""
    t, low = 0.02, z[0]
    lean = 0.0 if style == "straight" else m.number(0.04, 0.1)
    rings = []
    for d, h in ((-lean, low), (0.0, z[1]), (-t, z[1]), (-lean - t, low + t)):
        rings.append([(s * (half + d), e, h) for s, e in ((-1, y[0] - d), (1, y[0] - d), (1, y[1] + d), (-1, y[1] + d))])
    m.add(part, loft(np.array(rings)))
    m.add(
        part,
        *(
            prism(rectangle((-half - g, half + g), (y[0] - g, y[1] + g), t + g), "z", (h, h + 0.04))
            for h, g in ((z[1] - 0.04, 0.012),)
        ),
    )
    count = m.pick(0, 3, 4)
    for c in np.linspace(y[0] + 0.1, y[1] - 0.1, count) if count else ():
        m.add(
            part, *(beam((s * (half - lean + 0.01), c, low + 0.02), (s * (half + 0.01), c, z[1]), 0.02, 0.05) for s in (-1, 1))
        )


def _tub(m: Model, part: str, half: float, y: Span, z: Span, style: str) -> None:
    """An open tub: straight walls, walls that lean out, or a trough with a round or pointed bottom; bands and load."""
    t, low = 0.02, z[0]
    if style in ("v", "round"):
        if style == "v":
            line = [
                (-half, z[1]),
                (-half, z[1] - 0.12),
                (-0.3 * half, low),
                (0.3 * half, low),
                (half, z[1] - 0.12),
                (half, z[1]),
            ]
        else:
            line = [
                (-half, z[1]),
                *((half * np.cos(a), z[1] - 0.1 + (z[1] - 0.1 - low) * np.sin(a)) for a in np.linspace(-np.pi, 0, 13)),
                (half, z[1]),
            ]
        wall = LineString(line).buffer(t, cap_style=2, join_style=2)
        m.add(part, *prisms(wall, "y", y), *(prism(Polygon(line), "y", (c, c + t)) for c in (y[0], y[1] - t)))
        if m.chance(0.6):
            m.add(
                part,
                *(
                    p
                    for c in np.linspace(y[0] + 0.1, y[1] - 0.15, m.pick(2, 3))
                    for p in prisms(
                        LineString(line).buffer(2 * t, cap_style=2, join_style=2).difference(Polygon(line)), "y", (c, c + 0.05)
                    )
                ),
            )
        return
    _walled(m, part, half, y, z, style)


def _load(m: Model, part: str, half: float, z: Span, y: Span, style: str) -> None:
    """Lumps that fill a tub."""
    low, base, long = z[0], z[1] - z[0], y[0] + y[1]
    if m.chance(0.5):
        m.add(
            part,
            *(
                ball(
                    (m.number(-0.5, 0.5) * half, m.number(0.25, 0.75) * long, low + 0.8 * base),
                    (0.4 * half, 0.22 * long, 0.15 * base),
                    8,
                )
                for _ in range(5)
            ),
        )
        m.add(
            part,
            box(
                (-0.8 * half, 0.8 * half) if style != "v" else (-0.5 * half, 0.5 * half),
                (y[0] + 0.12, y[1] - 0.12),
                (low + 0.5 * base, low + 0.78 * base),
            ),
        )


def _chassis(m: Model, ends: Span, r: float, y: Span, z: float) -> None:
    """Two beams on the axles, cross bars and buffers."""
    for s in (-1, 1):
        m.add(BASE, box((s * 0.12, s * 0.2), (y[0] + 0.02, y[1] - 0.02), (z - 0.1, z)))
        m.add(BASE, *(box((s * 0.13, s * 0.19), (c - 0.05, c + 0.05), (r - 0.05, z - 0.05)) for c in ends))
    m.add(BASE, *(box((-0.25, 0.25), (c, c + 0.07), (z - 0.1, z + 0.01)) for c in (y[0], y[1] - 0.07)))
    m.add(BASE, *(rod((0, c, z - 0.05), (0, c + s * 0.12, z - 0.05), 0.06, 10) for s, c in ((-1, y[0]), (1, y[1]))))


def mine_cart(m: Model) -> None:
    """A cart on rails: a tub that tips to a side or the front, or a fixed tub with a door at its end or its side."""
    half, long, r, gauge = m.number(0.38, 0.55), m.number(0.95, 1.5), m.number(0.13, 0.2), m.number(0.28, 0.36)
    spokes, base = m.pick(0, 0, 5, 6), m.number(0.62, 0.75)
    y, way = (0.0, long), m.pick("side", "front", "fixed", "door")
    ends = (0.2 * long, 0.8 * long)
    for k, c in enumerate(ends):
        wheelset(m, f"wheels_{k}", c, r, gauge, spokes)
    z = 2 * r + 0.05
    _chassis(m, ends, r, y, z)
    style = m.pick("v", "round", "straight") if way == "side" else m.pick("straight", "lean", "lean")
    part, low = ("tub" if way in ("side", "front") else BASE), z + (0.12 if way == "side" else 0.01 if way == "front" else 0.0)
    tub = (y[0] + 0.06, y[1] - 0.06)
    _tub(m, part, half, tub, (low, low + base), style)
    _load(m, part, half, (low, low + base), tub, style)
    if way == "side":
        s = m.pick(-1, 1)
        m.add(
            BASE,
            *(
                prism(Polygon([(-0.26, z), (0.26, z), (0.06, low - 0.0), (-0.06, low)]), "y", (c, c + 0.05))
                for c in (y[0] + 0.02, y[1] - 0.07)
            ),
        )
        m.add("tub", *(prism(rectangle((-0.3 * half, 0.3 * half), (low - 0.025, low + 0.01)), "y", c) for c in (tub,)))
        m.hinge("tub", (s * 0.1, long / 2, low - 0.02), (0, s, 0), m.pick(40, 50))
    elif way == "front":
        m.hinge("tub", (0, y[0] + 0.08, z), (1, 0, 0), m.pick(55, 70))
    elif way == "door":
        _end_gate(m, half, y, low, base)
    if m.chance(0.6):
        track(m, gauge, (y[0] - m.number(0.1, 0.8), y[1] + m.number(0.1, 0.8)), m.number(0.06, 0.09))
    if way != "side" and m.chance(0.5):
        back = y[1] - 0.05
        m.add(
            part,
            tube(
                [
                    vec(-0.7 * half, back, low + 0.7 * base),
                    vec(-0.7 * half, back + 0.18, low + base),
                    vec(0.7 * half, back + 0.18, low + base),
                    vec(0.7 * half, back, low + 0.7 * base),
                ],
                0.016,
                8,
            ),
        )


def _end_gate(m: Model, half: float, y: Span, low: float, high: float) -> None:
    """A flap over the front of a fixed tub, hung from a bar above, or a chute below it that swings down."""
    w, c = half - 0.02, y[0] + 0.06
    z = (low + 0.03, low + high + 0.06)
    m.add(
        "gate",
        box((-w, w), (c - 0.05, c - 0.022), (z[0], z[1])),
        *(box((s * 0.6 * w - 0.03, s * 0.6 * w + 0.03), (c - 0.065, c - 0.05), (z[0] + 0.02, z[1])) for s in (-1, 1)),
    )
    m.add("gate", rod((-w - 0.05, c - 0.03, z[1]), (w + 0.05, c - 0.03, z[1]), 0.02, 8))
    m.add(BASE, *(box((s * (w + 0.02), s * (w + 0.05)), (c - 0.06, c + 0.1), (z[1] - 0.12, z[1] + 0.03)) for s in (-1, 1)))
    if m.chance(0.6):
        m.add(
            "gate",
            tube(
                [
                    vec(-0.15, c - 0.05, low + 0.15),
                    vec(-0.15, c - 0.1, low + 0.15),
                    vec(0.15, c - 0.1, low + 0.15),
                    vec(0.15, c - 0.05, low + 0.15),
                ],
                0.012,
                8,
            ),
        )
    m.hinge("gate", (0, c - 0.03, z[1]), (-1, 0, 0), m.pick(70, 90))
