"""Building machines by another hand: digger."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.game_style import Look, carve, look, wheel
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rectangle, rod
from training.kinds.vehicles.game_coach import axle


def digger(m: Model) -> None:
    """An excavator on tracks or wheels: swing, boom, stick, bucket, cab door, perhaps a blade and a swinging boom foot."""
    a = look(m)
    size, wheeled = m.number(0.5, 1.2), m.chance(0.3)
    half, long = 0.95 * size, m.number(1.4, 1.8) * size
    r = 0.42 * size
    deck = (2.1 if wheeled else 2.0) * r + 0.05
    if wheeled:
        for name, y in (("front_wheel", -0.65 * long), ("rear_wheel", 0.65 * long)):
            axle(a, name, y, r, 0.36 * size, half)
        a.put(BASE, a.block((-0.5 * size, 0.5 * size), (-0.85 * long, 0.85 * long), (0.7 * r, deck - 0.12)))
    else:
        _tracks(a, half, long, r, 0.42 * size)
        a.put(BASE, a.block((-half + 0.1 * size, half - 0.1 * size), (-0.45 * long, 0.45 * long), (0.6 * r, deck - 0.1)))
    a.put(BASE, rod((0, 0, deck - 0.2), (0, 0, deck - 0.01), 0.5 * size, 2 * a.n))
    if m.chance(0.4) or wheeled:
        y = -long - (0.1 if wheeled else r) - 0.15 * size
        a.put("blade", a.block((-half - 0.15, half + 0.15), (y - 0.06, y), (0.02, 0.5 * size), (0, 0, 1)))
        a.put(
            "blade",
            *(
                box((s * 0.3 * size - 0.05, s * 0.3 * size + 0.05), (y - 0.01, -0.5 * long), (0.6 * r, 0.6 * r + 0.1))
                for s in (-1, 1)
            ),
        )
        a.put(
            BASE,
            *(
                box((s * 0.3 * size - 0.08, s * 0.3 * size + 0.08), (-0.52 * long, -0.4 * long), (0.5 * r, 0.6 * r + 0.2))
                for s in (-1, 1)
            ),
        )
        m.hinge("blade", (0, -0.5 * long, 0.6 * r + 0.05), (-1, 0, 0), (0, m.number(12, 25)))
    _house(a, size, deck)
    _arm(a, size, deck)


def _tracks(a: Look, half: float, long: float, r: float, wide: float) -> None:
    """A belt a side round a driven wheel and an idler; the wheels spin where they are modelled."""
    m, shown = a.m, a.m.chance(0.6)
    outline = LineString([(-long + r, r), (long - r, r)]).buffer(r, quad_segs=2 if a.way == "low" else 6)
    for s, side in ((1, "left"), (-1, "right")):
        x = (s * half - wide / 2, s * half + wide / 2)
        belt = outline.difference(outline.buffer(-0.16 * r)) if shown else outline
        a.put(BASE, prism(belt, "x", x))
        if a.way in ("cad", "old") or m.chance(0.4):
            for y in np.arange(-long + r, long - r, 0.28 * r):
                a.put(BASE, *(box(x, (y, y + 0.12 * r), (z - 0.04 * r, z + 0.04 * r)) for z in (0.0, 2 * r)))
        if shown:
            count = m.pick(2, 4) if s > 0 else 2
            a.put(
                BASE,
                box((s * half - 0.15 * wide, s * half + 0.05 * wide), (-long + 1.9 * r, long - 1.9 * r), (0.6 * r, 1.4 * r)),
            )
            a.put(BASE, box((s * 0.5 * half, s * half), (-0.3 * long, 0.3 * long), (0.65 * r, 1.3 * r)))
            for k, y in enumerate((-long + r, long - r, -0.2 * long, 0.2 * long)[:count]):
                small = k > 1
                hub = (s * half + (s * 0.3 * wide if small else 0), y, 0.45 * r if small else r)
                a.put(
                    f"track_wheel_{side}_{k}",
                    *wheel(a, hub, 0.26 * r if small else 0.83 * r, 0.3 * wide if small else 0.8 * wide, s),
                )
                m.spin(f"track_wheel_{side}_{k}", hub, (s, 0, 0))
        else:
            a.put(BASE, *(rod((s * half, y, r), (s * (half + 0.55 * wide), y, r), 0.6 * r, a.n) for y in (-long + r, long - r)))


def _house(a: Look, size: float, deck: float) -> None:
    """What swings: platform, engine cover, counterweight, cab or canopy."""
    m, side = a.m, a.m.pick(-1, 1)
    wide, z = 0.95 * size, deck + 0.1 * size
    a.put("house", a.block((-wide, wide), (-0.9 * size, 1.3 * size), (deck, z), (0, 1, 0)))
    a.put("house", a.block((-wide, wide), (0.35 * size, 1.2 * size), (z - 0.01, z + 0.75 * size)))
    t = np.linspace(0, np.pi, 9)
    weight = Polygon(
        [*np.c_[wide * np.cos(t), 1.2 * size + 0.35 * size * np.sin(t)], (-wide, 1.1 * size), (wide, 1.1 * size)]
    ).convex_hull
    a.put("house", prism(weight, "z", (deck, z + 0.6 * size)))
    m.spin("house", (0, 0, deck), (0, 0, 1))
    x, y, top = (side * 0.28 * size, side * wide), (-0.88 * size, 0.33 * size), z + m.number(1.35, 1.6) * size
    if m.chance(0.2):
        a.put(
            "house",
            *(rod((u, v, z - 0.01), (u, v, top), 0.04 * size, 8) for u in x for v in y),
            box((x[0] - side * 0.05, x[1]), (y[0] - 0.05, y[1] + 0.05), (top, top + 0.06)),
        )
    else:
        _cab(a, x, y, (z, top), side)
    low = z + 0.45 * size
    mid = (x[0] + x[1]) / 2
    a.put("house", a.block((mid - 0.2 * size, mid + 0.2 * size), (-0.2 * size, 0.22 * size), (z - 0.01, low)))
    a.put("house", a.block((mid - 0.2 * size, mid + 0.2 * size), (0.12 * size, 0.24 * size), (low - 0.05, low + 0.5 * size)))
    if m.chance(0.5):
        hood = box((-0.85 * wide, 0.85 * wide), (0.45 * size, 1.15 * size), (z + 0.75 * size, z + 0.82 * size))
        a.put("engine_hood", hood)
        m.hinge("engine_hood", (0, 0.45 * size, z + 0.76 * size), (1, 0, 0), m.number(45, 75), "house")
    else:
        a.put(
            "house",
            rod(
                (-side * 0.6 * wide, 0.8 * size, z + 0.7 * size),
                (-side * 0.6 * wide, 0.8 * size, z + 1.1 * size),
                0.06 * size,
                a.n,
            ),
        )


def _cab(a: Look, x: Span, y: Span, z: Span, side: int) -> None:
    """A box with windows and a door on its outer side."""
    m = a.m
    slope = m.number(0.0, 0.25) * (y[1] - y[0])
    view = Polygon([(y[0], z[0] - 0.01), (y[1], z[0] - 0.01), (y[1], z[1]), (y[0] + slope, z[1]), (y[0], (z[0] + z[1]) / 2)])
    body = prism(view, "x", x)
    wall = 0.05
    inner = view.buffer(-wall, join_style=2)
    body = cut(body, prism(inner, "x", (x[0] + side * wall, x[1] - side * wall)))
    door = inner.buffer(-0.02, join_style=2).intersection(rectangle((y[0], y[1] - m.number(0.0, 0.3)), (0, 99)))
    piece, body = carve(body, door, "x", (x[1] - side * 0.1, x[1] + side), 0.004)
    pane, piece = carve(
        piece,
        door.intersection(rectangle((-99, 99), (z[0] + m.number(0.1, 0.6), 99))).buffer(-0.05, join_style=2),
        "x",
        (-99, 99),
        0.002,
    )
    a.put("cab_door", piece, *([pane] if m.chance(0.5) else []))
    back = m.chance(0.7)
    low, high = piece.bounds[:, 1]
    m.hinge(
        "cab_door",
        (x[1], high if back else low, (z[0] + z[1]) / 2),
        (0, 0, side if back else -side),
        m.number(70, 160),
        "house",
    )
    inside = tuple(sorted((x[0] + side * 0.1, x[1] - side * 0.1)))
    if m.chance(0.8):
        body = cut(
            body, prism(rectangle(inside, (z[0] + 0.4 * (z[1] - z[0]), z[1] - 0.12)), "y", (y[0] - 1, y[0] + slope + 0.1))
        )
    a.put("house", body)


def _arm(a: Look, size: float, deck: float) -> None:
    """Boom, stick and bucket in front of the house, with their rams."""
    m, foot = a.m, np.array([-0.75 * size, deck + 0.45 * size])
    parent, wide = "house", 0.13 * size
    post = [
        (foot[0] + 0.2 * size, deck + 0.02),
        (foot[0] - 0.15 * size, deck + 0.02),
        (foot[0] - 0.1 * size, foot[1] + 0.1 * size),
        (foot[0] + 0.1 * size, foot[1] + 0.1 * size),
    ]
    a.put("house", *(prism(post, "x", (s * (wide + 0.002), s * (wide + 0.06 * size))) for s in (-1, 1)))
    if a.way != "low":
        a.put("house", rod((-wide - 0.08 * size, *foot), (wide + 0.08 * size, *foot), 0.05 * size, 12))
    knee = foot + np.array([-m.number(0.7, 1.0), m.number(1.2, 1.6)]) * size
    elbow = knee + np.array([-m.number(1.1, 1.6), m.number(-0.3, 0.1)]) * size
    wrist = elbow + np.array([-m.number(0.1, 0.5), -m.number(1.3, 1.7)]) * size
    if wrist[1] < 0.55 * size:
        wrist[1] = 0.55 * size
    boom = LineString([foot, knee, elbow]).buffer(0.14 * size, quad_segs=2)
    stick = LineString([elbow + 0.2 * (elbow - wrist), elbow, wrist]).buffer(0.09 * size, quad_segs=2)
    a.put("boom", prism(boom, "x", (-wide, wide)))
    m.hinge("boom", (0, *foot), (-1, 0, 0), (-m.number(10, 20), m.number(25, 40)), parent)
    a.put(
        "stick",
        *(prism(stick, "x", (s * (wide + 0.004), s * (wide + 0.05 * size))) for s in (-1, 1))
        if a.way in ("cad", "sunk")
        else [prism(stick, "x", (-0.6 * wide, 0.6 * wide))],
    )
    if a.way in ("cad", "sunk"):
        a.put(
            "stick",
            rod((-wide - 0.06 * size, *elbow), (wide + 0.06 * size, *elbow), 0.05 * size, 12),
            rod((-wide - 0.06 * size, *wrist), (wide + 0.06 * size, *wrist), 0.05 * size, 12),
        )
        low = wrist + 0.25 * (elbow - wrist)
        a.put("stick", box((-wide - 0.01, wide + 0.01), (low[0] - 0.05, low[0] + 0.05), (low[1], low[1] + 0.4 * size)))
    m.hinge("stick", (0, *elbow), (-1, 0, 0), (-m.number(20, 40), m.number(30, 60)), "boom")
    if m.chance(0.7):
        up = np.array([0, 0.2 * size])
        a.put(
            "boom",
            rod((0, *(knee + up)), (0, *(0.4 * knee + 0.6 * elbow + up)), 0.06 * size, 10),
            *(
                box((-0.05 * size, 0.05 * size), (p[0] - 0.05 * size, p[0] + 0.05 * size), (p[1], p[1] + 0.24 * size))
                for p in (knee, 0.4 * knee + 0.6 * elbow)
            ),
        )
    _bucket(a, size, wrist)


def _bucket(a: Look, size: float, wrist: np.ndarray) -> None:
    m, wide = a.m, a.m.number(0.3, 0.5) * size
    t = np.linspace(-0.4 * np.pi, 0.75 * np.pi, 8)
    r = m.number(0.26, 0.36) * size
    centre = wrist + np.array([0.1 * size, -0.1 * size - 0.9 * r])
    shell = centre + r * np.c_[-np.cos(t), np.sin(t)]
    curve = LineString(shell).buffer(0.025 * size, quad_segs=1)
    a.put("bucket", prism(curve, "x", (-wide, wide)))
    a.put("bucket", *(prism(Polygon(shell), "x", (s * wide, s * (wide - 0.03 * size))) for s in (-1, 1)))
    ears = Polygon(
        [
            wrist + np.array([-0.07 * size, 0.05 * size]),
            wrist + np.array([0.07 * size, 0.05 * size]),
            centre + np.array([0.05 * size, 0.97 * r]),
            centre + np.array([-0.5 * r, 0.85 * r]),
        ]
    ).convex_hull
    inner = 0.13 * size + 0.052 * size
    a.put("bucket", *(prism(ears, "x", (s * inner, s * (inner + 0.04 * size))) for s in (-1, 1)))
    a.put("bucket", rod((-inner - 0.03 * size, *wrist), (inner + 0.03 * size, *wrist), 0.04 * size, 10))
    tip, along = shell[0], shell[0] - shell[1]
    for x in np.linspace(-wide + 0.05 * size, wide - 0.05 * size, m.pick(3, 4, 5)):
        a.put("bucket", rod((x, *(tip - 0.2 * along)), (x, *(tip + 0.7 * along)), 0.03 * size, 6))
    m.hinge("bucket", (0, *wrist), (-1, 0, 0), (-m.number(40, 70), m.number(20, 40)), "stick")
