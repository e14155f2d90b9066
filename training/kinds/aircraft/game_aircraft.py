"""Aircraft by another hand: propeller plane with cut control surfaces."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.aircraft.game_wings import Wing, hull
from training.kinds.game_style import Look, carve, circle, look, skin, wheel
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, join, prism, rectangle, rod


def propeller_plane(m: Model) -> None:
    """A plane with one or two propellers: high, low or double wing; nose or tail wheel; canopy, doors or an open seat."""
    a = look(m)
    long, style = m.number(5.5, 9.5), m.pick("high", "high", "low", "low", "double")
    wide = m.number(0.42, 0.62)
    tall, n = wide * m.number(1.0, 1.3), {"low": m.pick(8, 12), "sheet": 8}.get(a.way, 16)
    twin, slim = style != "double" and m.chance(0.25), m.number(0.12, 0.25)
    deck = m.number(1.1, 1.35)
    rise = 0.25 * tall
    stations = [
        (0.0, 0.3 * wide, 0.3 * tall, deck),
        (0.04 * long, 0.7 * wide, 0.65 * tall, deck),
        (0.16 * long, 0.9 * wide, 0.85 * tall, deck),
    ]
    stations += [
        (0.28 * long, wide, tall, deck),
        (0.48 * long, 0.95 * wide, tall, deck + 0.02),
        (0.75 * long, 0.5 * wide, 0.5 * tall, deck + rise),
        (long, slim * wide, slim * tall + 0.04, deck + 1.6 * rise),
    ]
    body = hull(a, stations, m.number(2.0, 2.6) if n > 8 else m.pick(2.0, 6.0), n)
    gap = m.pick(0.002, 0.008, 0.02)
    _cockpit(a, body, style, (0.24 * long, 0.46 * long), wide, tall, deck)
    _wings(a, style, long, wide, tall, deck, gap)
    _tail(a, long, deck + 1.6 * rise, slim * tall, gap)
    size = m.number(0.7, 1.0)
    if twin:
        for s, side in ((1, "left"), (-1, "right")):
            x, z = s * 1.5, deck + (0.85 if style == "high" else -0.55) * tall
            pod = hull(
                a,
                [
                    (0.16 * long, 0.15, 0.15, z),
                    (0.2 * long, 0.24, 0.24, z),
                    (0.38 * long, 0.22, 0.2, z),
                    (0.5 * long, 0.05, 0.05, z),
                ],
                2.0,
                n,
            )
            pod.apply_translation((x, 0, 0))
            a.put(BASE, pod)
            _propeller(a, f"propeller_{side}", (x, 0.16 * long, z), 0.8 * size)
    else:
        _propeller(a, "propeller", (0, 0, deck), size)
    _gear(a, long, wide, deck - tall, deck + 1.6 * rise, size if not twin else 0.0)


def _propeller(a: Look, part: str, at: tuple[float, float, float], radius: float) -> None:
    """Blades and a spinner on the nose."""
    m, (x, y, z) = a.m, at
    count, hub = m.pick(2, 2, 3, 4), 0.15 * radius
    blade = prism(
        [
            (-0.04 * radius, 0),
            (0.05 * radius, 0),
            (0.09 * radius, 0.5 * radius),
            (0.03 * radius, radius),
            (-0.05 * radius, radius),
        ],
        "y",
        (y - 0.07, y - 0.05),
    )
    for k in range(count):
        one = blade.copy()
        one.apply_transform(_spin(360 * k / count, (x, z)))
        a.put(part, a.panel(one, (0, -1, 0)))
    if m.chance(0.7):
        a.put(
            part,
            ball((x, y - 0.06, z), (hub, 2.0 * hub, hub), max(8, a.n))
            if a.way != "low"
            else rod((x, y - 0.2, z), (x, y + 0.01, z), hub, 8),
        )
    else:
        a.put(part, rod((x, y - 0.1, z), (x, y + 0.02, z), 0.6 * hub, a.n))
    m.spin(part, (x, y - 0.06, z), (0, -1, 0))


def _spin(degrees: float, at: tuple[float, float]) -> np.ndarray:
    t, done = np.deg2rad(degrees), np.eye(4)
    done[[0, 0, 2, 2], [0, 2, 0, 2]] = [np.cos(t), np.sin(t), -np.sin(t), np.cos(t)]
    done[[0, 2], 3] = at
    return done


def _cockpit(a: Look, body: Trimesh, style: str, y: Span, wide: float, tall: float, deck: float) -> None:
    """Doors with panes under a high wing; else a canopy, or open seats behind screens."""
    cover = {"high": _cabin, "low": _canopy, "double": _open_seats}[style]
    whole, body = cover(a, body, y, wide, tall, deck)
    a.put(BASE, skin(body, whole) if a.way == "sheet" else body)


def _cabin(a: Look, body: Trimesh, y: Span, wide: float, tall: float, deck: float) -> tuple[Trimesh, Trimesh]:
    m, roof, mid = a.m, deck + tall, (y[0] + y[1]) / 2
    view = [(y[0] - 0.25, roof - 0.5 * tall), (y[0] + 0.1, roof + 0.22), (y[1], roof + 0.2), (y[1] + 0.7, roof - 0.4 * tall)]
    body = whole = join(body, prism(view, "x", (-0.85 * wide, 0.85 * wide)))
    if a.inside or a.way == "sheet":
        body = cut(body, box((-0.72 * wide, 0.72 * wide), (y[0] + 0.05, y[1]), (deck - 0.6 * tall, roof + 0.1)))
        z = (deck - 0.61 * tall, deck - 0.3 * tall)
        a.put(BASE, *(a.block((x - 0.17, x + 0.17), (mid, mid + 0.4), z) for x in (-0.2, 0.2)))
    low, front, back = deck - 0.5 * tall, y[0] + 0.14, y[1] - 0.25
    outline = Polygon([(front, low), (back, low), (back + 0.1, roof + 0.05), (front + 0.06, roof + 0.05)])
    above = outline.intersection(rectangle((-9, 99), (deck + 0.35 * tall, 9))).buffer(-0.05)
    for s, side in ((1, "left"), (-1, "right"))[: m.pick(1, 2, 2)]:
        piece, body = carve(body, outline, "x", (s * 0.66 * wide, s * 3 * wide), 0.006)
        pane, piece = carve(piece, above, "x", (-9, 9), 0.002)
        pieces = [pane, piece] if m.chance(0.7) else [piece]
        a.put(f"door_{side}", *(skin(p, whole) if a.way == "sheet" else p for p in pieces))
        m.hinge(f"door_{side}", (s * wide, front, deck), (0, 0, -s), m.number(60, 85))
    return whole, body


def _canopy(a: Look, body: Trimesh, y: Span, wide: float, tall: float, deck: float) -> tuple[Trimesh, Trimesh]:
    m, n, mid = a.m, 12 if a.way == "low" else 20, (y[0] + y[1]) / 2
    centre = (0, mid, deck + 0.75 * tall)
    inner = ball(centre, (0.64 * wide, 0.57 * (y[1] - y[0]), 0.69 * tall), n)
    shell = cut(ball(centre, (0.7 * wide, 0.62 * (y[1] - y[0]), 0.75 * tall), n), inner, body)
    shell = max(shell.split(only_watertight=False), key=lambda s: s.bounds[1, 2])
    body = cut(body, inner)
    chair = a.block((-0.2, 0.2), (mid, mid + 0.4), (deck, deck + 0.25 * tall))
    a.put(BASE, chair, a.block((-0.2, 0.2), (mid + 0.35, mid + 0.45), (deck, deck + tall)))
    if m.chance(0.6):
        screen, shell = carve(shell, rectangle((-9, 9), (-9, y[0] + 0.1)), "z", (-9, 99), 0.004)
        a.put(BASE, screen)
        m.slide("canopy", (0, 1, 0), 0.6 * shell.extents[1])
    else:
        m.hinge("canopy", (-shell.bounds[1, 0], mid, shell.bounds[0, 2] + 0.1), (0, -1, 0), m.number(60, 90))
    a.put("canopy", shell)
    return body, body


def _open_seats(a: Look, body: Trimesh, y: Span, wide: float, tall: float, deck: float) -> tuple[Trimesh, Trimesh]:
    mid = (y[0] + y[1]) / 2
    for at in [mid, mid - 0.9] if a.m.chance(0.5) else [mid]:
        body = cut(body, prism(circle(0.6 * wide, max(a.n, 8), at=(0, at)), "z", (deck + 0.1, deck + 3)))
        z = (deck + 0.85 * tall, deck + 1.35 * tall)
        a.put(BASE, box((-0.4 * wide, 0.4 * wide), (at - 0.75 * wide, at - 0.7 * wide), z))
        a.put(BASE, a.block((-0.2, 0.2), (at, at + 0.3), (deck + 0.08, deck + 0.3)))
    return body, body


def _wings(a: Look, style: str, long: float, wide: float, tall: float, deck: float, gap: float) -> None:
    """Main wings with ailerons and perhaps flaps; two wings have struts between them."""
    m = a.m
    span, chord, lift = m.number(0.48, 0.68) * long, m.number(0.16, 0.22) * long, m.number(0.0, 0.06)
    tip, begin = chord * m.number(0.55, 1.0), 0.27 * long
    low, high = deck - 0.55 * tall, deck + tall
    levels = {"high": [high + 0.2], "low": [low], "double": [low, high + 0.45]}[style]
    flaps, both = m.chance(0.6) and style != "double", m.chance(0.4)
    for k, z in enumerate(levels):
        inner = 0.0 if z > deck + tall else 0.5 * wide
        for s, side in ((1, "left"), (-1, "right")):
            end = np.array([s * span, begin + 0.4 * (chord - tip), z + lift * span])
            wing = Wing(a, np.array([s * inner, begin, z]), end, (chord, tip))
            if k == 0 or both:
                part = f"aileron_{side}" if k == 0 else f"upper_aileron_{side}"
                wing.flap(part, (0.6, 0.95), m.number(0.72, 0.78), (-25, 25), gap)
            if flaps:
                wing.flap(f"flap_{side}", (0.18 if inner else 0.25, 0.57), 0.76, (0, m.number(30, 45)), gap)
            wing.finish()
    tops = [z + lift * 0.7 * span for z in levels]
    if style == "double":
        for f in (0.15, 0.6):
            y = begin + f * chord
            a.put(BASE, *(rod((x, y, tops[0]), (x, y, tops[1] + 0.02), 0.025, 8) for x in (-0.7 * span, 0.7 * span)))
            feet = [(s * 0.4 * wide, y, deck + 0.6 * tall) for s in (-1, 1)]
            a.put(BASE, *(rod(p, (1.75 * p[0], y, levels[1] + 0.03), 0.022, 8) for p in feet))
    elif style == "high" and m.chance(0.7):
        y = begin + 0.3 * chord
        ends = [(s * 0.7 * span, y, tops[0]) for s in (-1, 1)]
        a.put(BASE, *(rod((np.sign(p[0]) * 0.8 * wide, y, deck - 0.4 * tall), p, 0.03, 8) for p in ends))


def _tail(a: Look, long: float, z: float, thick: float, gap: float) -> None:
    """Tailplane with one or two elevators a side, fin with a rudder, at the fuselage or on top of the fin."""
    m = a.m
    span, chord, high = m.number(0.16, 0.22) * long, m.number(0.1, 0.14) * long, m.number(0.14, 0.2) * long
    fin = Wing(
        a,
        np.array([0, long - 1.25 * chord, z]),
        np.array([0, long - 0.55 * chord, z + high]),
        (1.25 * chord, m.number(0.55, 0.9) * chord),
        True,
    )
    top = m.chance(0.2)
    fin.flap("rudder", (0.12, 0.92 if top else 1.1), m.number(0.58, 0.66), (-25, 25), gap)
    fin.finish()
    level = z + high if top else z + 0.4 * thick
    y = long - (0.55 if top else 1.1) * chord
    for s, side in ((1, "left"), (-1, "right")):
        root = 0.0 if top else 0.01
        plane = Wing(a, np.array([s * root, y, level]), np.array([s * span, y + 0.25 * chord, level]), (chord, 0.7 * chord))
        plane.flap(f"elevator_{side}", (0.2, 1.1), m.number(0.58, 0.66), (-25, 25), gap)
        plane.finish()


def _gear(a: Look, long: float, wide: float, belly: float, tail: float, propeller: float) -> None:
    """Main wheels on legs and a nose or tail wheel."""
    m, r = a.m, a.m.number(0.18, 0.27)
    nose = m.chance(0.5)
    y, x = (0.42 if nose else 0.26) * long, wide + m.number(0.15, 0.4)
    floor = min(belly - 0.35, belly + 0.4 - propeller * 0.2)
    for s, side in ((1, "left"), (-1, "right")):
        hub = (s * x, y, floor)
        a.put(
            BASE,
            rod((s * 0.35 * wide, y, belly + 0.35), (s * (x - 0.06), y, floor), 0.035, 8),
            rod((s * (x - 0.075), y, floor), (s * (x - 0.02), y, floor), 0.03, 8),
        )
        a.put(f"wheel_{side}", *wheel(a, hub, r, 0.12, s))
        m.spin(f"wheel_{side}", hub, (s, 0, 0))
        if m.chance(0.2):
            a.put(BASE, ball((s * x, y, floor + 0.12), (0.09, 1.4 * r, 0.7 * r), 10))
    small = (0.8 if nose else 0.5) * r
    at, top = (0.1 * long, belly + 0.6) if nose else (0.9 * long, tail)
    hub = (0.0, at, floor - r + small if nose else tail - 0.5)
    part = "nose_wheel" if nose else "tail_wheel"
    a.put(part, *wheel(a, hub, small, 0.09, 1))
    m.spin(part, hub, (1, 0, 0))
    a.put(BASE, *(rod((u * 0.06, at, hub[2]), (u * 0.06, at, hub[2] + small + 0.03), 0.015, 6) for u in (-1, 1)))
    a.put(
        BASE,
        box((-0.075, 0.075), (at - 0.02, at + 0.02), (hub[2] + small + 0.02, hub[2] + small + 0.05)),
        rod((0, at, hub[2] + small + 0.03), (0, at, top), 0.025, 8),
    )
