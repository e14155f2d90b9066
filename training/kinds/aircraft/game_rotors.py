"""Helicopters by another hand: a bubble with a boom, a cabin with a boom, or a long hull under two rotors."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.aircraft.game_wings import hull
from training.kinds.game_style import Look, carve, look, skin, wheel
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, around, box, cut, prism, rectangle, rod, tube


def rotorcraft(m: Model) -> None:
    """A helicopter: main and tail rotor, two rotors in a row or above each other; doors; skids or wheels."""
    a = look(m)
    style = m.pick("boom", "boom", "bubble", "tandem", "coaxial")
    long, wide = m.number(2.6, 4.0), m.number(0.65, 0.9)
    tall, n = wide * m.number(0.95, 1.2), {"low": 8, "sheet": 12}.get(a.way, 16)
    deck = tall + m.number(0.45, 0.7)
    if style == "tandem":
        long = m.number(5.5, 8.0)
    if style == "bubble":
        long = m.number(2.0, 2.5)
    nose = 0.25 if a.way != "low" else 0.5
    stations = [
        (0, nose * wide, nose * tall, deck - 0.2 * tall),
        (0.12 * long, 0.75 * wide, 0.75 * tall, deck - 0.1 * tall),
        (0.32 * long, wide, tall, deck),
    ]
    stations += [
        (0.7 * long, wide, tall, deck),
        (0.92 * long, 0.7 * wide, 0.7 * tall, deck + 0.15 * tall),
        (long, 0.3 * wide, 0.3 * tall, deck + 0.3 * tall),
    ]
    body = whole = hull(a, stations, m.number(2.0, 4.0), n)
    if a.inside or a.way == "sheet" or style == "bubble":
        inner = [(y * 0.84 + 0.08 * long, 0.9 * w, 0.9 * h, z) for y, w, h, z in stations]
        body = cut(body, hull(a, inner, 2.5, n))
        a.put(BASE, box((-0.7 * wide, 0.7 * wide), (0.25 * long, 0.75 * long), (deck - 0.75 * tall, deck - 0.7 * tall)))
        a.put(
            BASE,
            *(
                a.block((x - 0.2, x + 0.2), y, (deck - 0.71 * tall, deck + t * tall))
                for x in (-0.27, 0.27)
                for y, t in (((0.33 * long, 0.33 * long + 0.4), -0.4), ((0.33 * long + 0.35, 0.33 * long + 0.45), 0.2))
            ),
        )
    body = _doors(a, body, whole, style, long, wide, tall, deck)
    screen = rectangle((-0.6 * wide, 0.6 * wide), (deck - 0.05 * tall, deck + 0.55 * tall))
    pane, body = carve(body, screen, "y", (-1, 0.2 * long), 0.004)
    a.put(BASE, *(skin(p, whole) if a.way == "sheet" else p for p in (body, pane)))
    _rotors(a, style, long, tall, deck)
    if style in ("boom", "bubble"):
        _boom(a, style, long, wide, tall, deck)
    elif style == "coaxial":
        _twin_fins(a, long, tall, deck)
    _feet(a, long, wide, deck - tall)


def _doors(a: Look, body: Trimesh, whole: Trimesh, style: str, long: float, wide: float, tall: float, deck: float) -> Trimesh:
    """Front doors on hinges; perhaps a sliding door behind."""
    m = a.m
    front, stop = (0.22 * long, 0.5 * long) if style != "tandem" else (0.1 * long, 0.22 * long)
    z = (deck - 0.6 * tall, deck + 0.62 * tall)
    slide = long > 3.0 and m.chance(0.6)
    for s, side in ((1, "left"), (-1, "right")):
        outline = Polygon([(front, z[0]), (stop, z[0]), (stop, z[1]), (front + 0.25 * (stop - front), z[1]), (front, deck)])
        found = _side_piece(a, body, whole, f"door_{side}", outline, s, wide, deck)
        body = found
        m.hinge(f"door_{side}", (s * 0.97 * wide, front, deck), (0, 0, -s), m.number(55, 90))
        if slide:
            begin = stop + 0.03
            after = rectangle((begin, min(begin + 1.2, 0.74 * long)), z)
            body = _side_piece(a, body, whole, f"sliding_door_{side}", after, s, wide, deck)
            m.slide(f"sliding_door_{side}", (0, 1, 0), 0.8 * (after.bounds[2] - after.bounds[0]))
    return body


def _side_piece(
    a: Look, body: Trimesh, whole: Trimesh, part: str, outline: Polygon, s: int, wide: float, deck: float
) -> Trimesh:
    piece, body = carve(body, outline, "x", (s * 0.55 * wide, s * 3 * wide), a.m.pick(0.002, 0.008))
    above = outline.intersection(rectangle((-9, 99), (deck, 99))).buffer(-0.06, join_style=2)
    pane, piece = carve(piece, above, "x", (-9, 9), 0.002)
    pieces = [piece, pane] if a.m.chance(0.7) else [piece]
    a.put(part, *(skin(p, whole) if a.way == "sheet" else p for p in pieces))
    return body


def _rotors(a: Look, style: str, long: float, tall: float, deck: float) -> None:
    """Masts, hubs and blades."""
    m = a.m
    top, mast = deck + tall, m.number(0.25, 0.5)
    if style == "tandem":
        radius = 0.55 * long
        for name, y, extra in (("front_rotor", 0.14 * long, 0.1), ("rear_rotor", 0.86 * long, m.number(0.5, 0.9))):
            pylon = [(y - 0.3, deck), (y + 0.3, deck), (y + 0.2, top + extra), (y - 0.2, top + extra)]
            a.put(BASE, prism(pylon, "x", (-0.25, 0.25)))
            _rotor(a, name, (0, y, top + extra), 0.25, radius)
        return
    y, radius = 0.5 * long, m.number(1.3, 1.7) * max(long, 2.5)
    a.put(BASE, a.block((-0.35, 0.35), (y - 0.4, y + 0.6), (top - 0.3, top + 0.12)))
    if style == "coaxial":
        _rotor(a, "lower_rotor", (0, y, top + 0.1), mast, radius)
        _rotor(a, "upper_rotor", (0, y, top + 0.1 + mast), 0.4, radius)
        return
    _rotor(a, "main_rotor", (0, y, top + 0.1), mast, radius)


def _rotor(a: Look, part: str, foot: tuple[float, float, float], mast: float, radius: float) -> None:
    m, (x, y, z) = a.m, foot
    at, count, wide = z + mast, m.pick(2, 3, 4, 5), radius * m.number(0.03, 0.05)
    a.put(BASE, rod((x, y, z - 0.05), (x, y, at - 0.02), 0.06, a.n))
    a.put(part, rod((0, y, at - 0.06), (0, y, at + 0.08), 0.15, a.n))
    blade = a.panel(box((0.05, radius), (-wide, wide), (at, at + 0.03)), (0, 0, 1))
    blades = around(blade, count, m.number(0, 90))
    root = around(rod((0.1, 0, at + 0.015), (0.2 * radius, 0, at + 0.015), 0.035, 8), count, 0) if a.way == "cad" else []
    for solid in [*blades, *root]:
        solid.apply_translation((x, y, 0))
    a.put(part, *blades)
    m.spin(part, (x, y, at), (0, 0, 1))


def _boom(a: Look, style: str, long: float, wide: float, tall: float, deck: float) -> None:
    """A tail boom or lattice with a fin, a tailplane and a tail rotor."""
    m = a.m
    end, z = long + m.number(2.4, 3.6), deck + 0.35 * tall
    if style == "bubble" and a.way != "sheet":
        corners = [(-0.2, 0.15), (0.2, 0.15), (0, -0.2)]
        tips = [(0.25 * u, end, z + 0.25 * v) for u, v in corners]
        roots = [(u, 0.8 * long, z - 0.1 + v) for u, v in corners]
        a.put(BASE, *(rod(p, q, 0.03, 6) for p, q in zip(roots, tips, strict=True)))
        for f in np.linspace(0.1, 0.9, 6):
            ring = [np.array(p) + f * (np.array(q) - p) for p, q in zip(roots, tips, strict=True)]
            a.put(BASE, *(rod(ring[i], ring[(i + 1) % 3], 0.015, 6) for i in range(3)))
        a.put(BASE, box((-0.1, 0.1), (end - 0.1, end + 0.1), (z - 0.12, z + 0.12)))
    else:
        a.put(BASE, hull(a, [(0.85 * long, 0.3 * wide, 0.3 * tall, z), (end, 0.12, 0.14, z + 0.1)], 2.0, max(8, a.n)))
    z += 0.1
    fin = [(end - 0.25, z - 0.25), (end + 0.15, z - 0.25), (end + 0.5, z + 0.9), (end + 0.2, z + 0.9)]
    a.put(BASE, prism(fin, "x", (-0.04, 0.04)), box((-0.7, 0.7), (end - 0.9, end - 0.55), (z - 0.02, z + 0.02)))
    s, radius, at = m.pick(-1, 1), m.number(0.4, 0.6), (end + 0.2, z + m.pick(0.05, 0.55))
    a.put("tail_rotor", rod((s * 0.03, *at), (s * 0.2, *at), 0.05, a.n))
    count = m.pick(2, 2, 4)
    for k in range(count):
        t = 2 * np.pi * k / count + 0.3
        tip = (at[0] + radius * np.cos(t), at[1] + radius * np.sin(t))
        side = np.array([-np.sin(t), np.cos(t)]) * 0.06
        blade = Polygon([np.array(at) - side, np.array(tip) - side, np.array(tip) + side, np.array(at) + side])
        a.put("tail_rotor", prism(blade, "x", (s * 0.14, s * 0.165)))
    m.spin("tail_rotor", (s * 0.15, *at), (s, 0, 0))


def _twin_fins(a: Look, long: float, tall: float, deck: float) -> None:
    """A short tail with two fins, each perhaps with a rudder."""
    m, z = a.m, deck + 0.3 * tall
    end = long + 1.4
    a.put(BASE, hull(a, [(0.85 * long, 0.25, 0.25, z), (end, 0.1, 0.12, z)], 2.0, max(8, a.n)))
    a.put(BASE, box((-1.0, 1.0), (end - 0.4, end), (z - 0.02, z + 0.03)))
    steered = m.chance(0.6)
    for s, side in ((1, "left"), (-1, "right")):
        x = (s * 0.98, s * 1.03)
        a.put(BASE, box(x, (end - 0.45, end + 0.1), (z - 0.3, z + 0.6)))
        if steered:
            a.put(f"rudder_{side}", box(x, (end + 0.105, end + 0.4), (z - 0.28, z + 0.58)))
            m.hinge(f"rudder_{side}", (s * 1.005, end + 0.1, z), (0, 0, 1), (-25, 25))


def _feet(a: Look, long: float, wide: float, belly: float) -> None:
    """Skids on bows, or three wheels."""
    m = a.m
    y: Span = (0.25 * long, 0.7 * long)
    if m.chance(0.65):
        x, low = wide + m.number(0.0, 0.25), belly - m.number(0.35, 0.5)
        for s in (-1, 1):
            path = [(s * x, y[0] - 0.7, low + 0.2), (s * x, y[0] - 0.45, low), (s * x, y[1] + 0.5, low)]
            a.put(BASE, tube(path, 0.04, 6 if a.way == "low" else 10))
            a.put(BASE, *(rod((s * x, at, low), (s * 0.4 * wide, at, belly + 0.25), 0.035, 8) for at in y))
        return
    r = m.number(0.18, 0.26)
    for s, side in ((1, "left"), (-1, "right")):
        hub = (s * (0.8 * wide + 0.1), y[1], belly - 0.2)
        a.put(BASE, rod(hub, (s * 0.5 * wide, y[1], belly + 0.3), 0.04, 8))
        hub = (hub[0] + s * 0.06, hub[1], hub[2])
        a.put(f"wheel_{side}", *wheel(a, hub, r, 0.13, s))
        m.spin(f"wheel_{side}", hub, (s, 0, 0))
    hub = (0.0, y[0], belly - 0.2)
    a.put("nose_wheel", *wheel(a, hub, r, 0.1, 1))
    m.spin("nose_wheel", hub, (1, 0, 0))
    a.put(BASE, *(rod((u * 0.065, y[0], hub[2]), (u * 0.065, y[0], belly + 0.3), 0.018, 6) for u in (-1, 1)))
