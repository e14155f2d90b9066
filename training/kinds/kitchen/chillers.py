"""Chest freezers and wine coolers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import body, door, look, rack, tray
from training.kinds.kitchen_trims import button, cable, dial, feet, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, rounded, tube


def _chest(m: Model, x: Span, y: Span, z: Span, wall: float) -> bool:
    """The cabinet: a cut block, walls of panels round a liner, or a closed block; return whether it is hollow."""
    style = m.pick("cut", "cut", "round", "panels", "closed")
    inner = shrunk(x, wall), shrunk(y, wall)
    if style == "closed":
        m.add(BASE, box(x, y, z))
        return False
    if style == "panels":
        t = 0.5 * wall
        m.add(BASE, *(box((a, a + t), y, z) for a in (x[0], x[1] - t)), box(x, y, (z[0], z[0] + t)))
        m.add(BASE, *(box(shrunk(x, t), (b, b + t), z) for b in (y[0], y[1] - t)))
        liner = cut(box(shrunk(x, t), shrunk(y, t), (z[0] + t, z[1] - 0.004)), box(*inner, (z[0] + 0.12, z[1] + 1)))
        m.add(BASE, liner)
        return True
    outer = box(x, y, z) if style == "cut" else prism(rounded(x, y, 0.04), "z", z)
    step = box(
        (inner[0][1] - 0.3 * (x[1] - x[0]), inner[0][1] + 0.01), (y[0] + 0.3 * wall, y[1] - 0.3 * wall), (z[0], z[0] + 0.3)
    )
    m.add(BASE, cut(outer, cut(box(*inner, (z[0] + 0.07, z[1] + 1)), step)))
    return True


def _chest_inside(m: Model, x: Span, y: Span, z: Span) -> None:
    """Hanging baskets, parcels and bags in the chest."""
    count = m.pick(0, 1, 2)
    for k in range(count):
        a = x[0] + 0.01 + k * 0.5 * (x[1] - x[0])
        tray(m, BASE, (a, a + 0.4 * (x[1] - x[0])), shrunk(y, 0.002), (z[1] - 0.2, z[1] - 0.02), m.pick("wire", "wire", "tub"))
    at = x[0] + 0.03
    while at < x[0] + 0.6 * (x[1] - x[0]):
        wide = m.number(0.08, 0.2)
        m.add(BASE, box((at, at + wide), shrunk(y, m.number(0.02, 0.1)), (z[0] - 0.005, z[0] + m.number(0.06, 0.22))))
        at += wide + 0.02


def _chest_lid(m: Model, part: str, x: Span, y: Span, z: float, shape: tuple[float, float, str], side: str) -> None:
    """A lid hinged at the rear: slab, rounded or with a plug below and a gasket; a handle in front, perhaps a lock."""
    thick, wall, style = shape
    top = (z + 0.003, z + 0.003 + thick)
    over = (y[0] - m.pick(0.0, 0.006, 0.02), y[1])
    if style == "rounded":
        m.add(part, prism(rounded(x, over, 0.03), "z", top))
    elif style == "crowned":
        c = 0.35 * thick
        outline = [
            (over[0], top[0]),
            (over[1], top[0]),
            (over[1], top[1] - c),
            (over[1] - 0.06, top[1]),
            (over[0] + 0.06, top[1]),
            (over[0], top[1] - c),
        ]
        m.add(part, prism(outline, "x", x))
    else:
        m.add(part, box(x, over, top))
    if m.chance(0.5):
        m.add(part, box(shrunk(x, 1.15 * wall), shrunk(y, 1.15 * wall), (z - 0.012, top[0] + 0.001)))
    if m.chance(0.6):
        m.add(
            part, prism(rectangle(shrunk(x, 0.2 * wall), shrunk(y, 0.2 * wall), 0.4 * wall), "z", (z + 0.0005, top[0] + 0.001))
        )
    c = {"middle": middle(x), "left": x[0] + 0.14, "right": x[1] - 0.14}[side]
    grip, h = m.pick("bar", "lip", "block", "none"), middle(top)
    if grip == "bar":
        f = over[0]
        m.add(part, tube([(c - 0.1, f, h), (c - 0.09, f - 0.035, h), (c + 0.09, f - 0.035, h), (c + 0.1, f, h)], 0.009, 8))
    elif grip == "lip":
        m.add(part, box((c - 0.12, c + 0.12), (over[0] - 0.025, over[0] + 0.01), (top[0], top[0] + 0.5 * thick)))
    elif grip == "block":
        m.add(part, box((c - 0.05, c + 0.05), (over[0] - 0.02, over[0]), (top[0] - 0.05, top[1] - 0.005)))
    if m.chance(0.4):
        m.add(part, rod((c + 0.14, over[0] - 0.004, h), (c + 0.14, over[0] + 0.002, h), 0.01, 10))
    back = y[1] + m.pick(0.0, 0.012)
    for a in (x[0] + 0.12, x[1] - 0.12):
        m.add(m.pick(part, BASE), rod((a - 0.035, back + 0.006, z + 0.004), (a + 0.035, back + 0.006, z + 0.004), 0.012, 10))
        if m.chance(0.5):
            m.add(BASE, box((a - 0.03, a + 0.03), (y[1], back + 0.012), (z - 0.12, z - 0.006)))
    m.hinge(part, (middle(x), back, z + 0.003), (-1, 0, 0), m.pick(65, 75, 85, 90))


def _sliding_glass(m: Model, x: Span, y: Span, z: float, bent: bool) -> None:
    """Two framed panes behind one another in tracks of a frame on the rim; flat or arched."""
    rise = 0.1 * (y[1] - y[0]) if bent else 0.0
    t = np.linspace(-1, 1, 9 if bent else 2)

    def plate(low: float, thick: float) -> list[tuple[float, float]]:
        half = (y[1] - y[0]) / 2 - 0.028
        top = [(middle(y) + half * u, low + thick + rise * (1 - u * u)) for u in t]
        return top + [(b, c - thick) for b, c in top[::-1]]

    m.add(BASE, *(box(x, (b, b + 0.03), (z, z + 0.045)) for b in (y[0], y[1] - 0.03)))
    m.add(BASE, *(prism(plate(z + 0.003, 0.04), "x", (a, a + 0.025)) for a in (x[0], x[1] - 0.025)))
    c, lap, inner = middle(x), 0.02, shrunk(x, 0.026)
    for k, (part, span) in enumerate({"pane_left": (inner[0], c + lap), "pane_right": (c - lap, inner[1])}.items()):
        low = z + 0.006 + 0.017 * k
        m.add(part, prism(plate(low + 0.003, 0.006), "x", shrunk(span, 0.02)))
        m.add(part, *(prism(plate(low, 0.012), "x", (a, a + 0.022)) for a in (span[0], span[1] - 0.022)))
        a = span[0] + 0.03 if k == 0 else span[1] - 0.03
        m.add(part, box((a - 0.012, a + 0.012), (middle(y) - 0.08, middle(y) + 0.08), (low + rise + 0.007, low + rise + 0.02)))
        m.slide(part, (1 - 2 * k, 0, 0), 0.85 * (span[1] - span[0] - 2 * lap))


def chest_freezer(m: Model) -> None:
    """A freezer with a lid on top, two lids side by side, or glass that slides; baskets, a control strip, grille, castors."""
    kind = m.pick("lid", "lid", "lid", "lid", "two", "two", "glass", "bent")
    wide = m.number(1.2, 1.9) if kind == "two" else m.number(0.55, 1.4)
    deep, high, foot, wall = m.number(0.52, 0.75), m.number(0.72, 0.86), m.pick(0.0, 0.025, 0.06), m.number(0.045, 0.07)
    x, y, z = (0.0, wide), (0.0, deep), (foot, foot + high)
    if _chest(m, x, y, z, wall):
        _chest_inside(m, shrunk(x, wall), shrunk(y, wall), (foot + 0.08, z[1]))
    if foot:
        feet(m, x, y, foot)
    if kind in ("glass", "bent"):
        _sliding_glass(m, x, y, z[1], kind == "bent")
    else:
        shape = m.number(0.045, 0.09), wall, m.pick("slab", "rounded", "crowned")
        side = m.pick("middle", "middle", "left", "right")
        if kind == "two":
            c = m.pick(0.5, 0.5, 0.38) * wide
            _chest_lid(m, "lid_left", (0.0, c - 0.003), y, z[1], shape, "middle")
            _chest_lid(m, "lid_right", (c + 0.003, wide), y, z[1], shape, "middle")
            m.add(BASE, box((c - 0.03, c + 0.03), shrunk(y, 0.5 * wall), (z[1] - 0.06, z[1] - 0.001)))
        else:
            _chest_lid(m, "lid", x, y, z[1], shape, side)
    low, s = foot + 0.1, m.pick(0.08, 0.6)
    if m.chance(0.7):  # grille, drain, lamps, thermostat
        a = s * wide + 0.03
        m.add(BASE, *(box((a, a + 0.2), (-0.003, 0.001), (c, c + 0.008)) for c in np.arange(low, low + 0.14, 0.02)))
        m.add(BASE, rod((a + 0.24, -0.008, low), (a + 0.24, 0.001, low), 0.016, 10))
        if m.chance(0.6):
            dial(m, "thermostat", (a + 0.1, 0, low + 0.19), (0, -1, 0), 0.022)
        m.add(BASE, *(rod((a + c, -0.003, low + 0.24), (a + c, 0.001, low + 0.24), 0.006, 8) for c in (0.06, 0.1, 0.14)))
    trims(m, BASE, (0.1 * wide, 0.9 * wide), 0.0, (0.5 * high, 0.85 * high), 1)
    if m.chance(0.3):
        cable(m, (0.9 * wide, deep, 0.2), 0.3)


def _bottles(m: Model, part: str, x: Span, y: Span, z: float, pitch: float) -> None:
    """Bottles lying on a shelf with their necks to the front, some places empty."""
    r = 0.038
    for a in np.arange(x[0] + pitch / 2, x[1] - pitch / 2 + 1e-6, pitch):
        if m.chance(0.75):
            c, n = z + r, 10
            end = min(y[0] + 0.3, y[1])
            m.add(part, rod((a, y[0] + 0.1, c), (a, end, c), r, n), rod((a, y[0] + 0.01, c), (a, y[0] + 0.1, c), 0.4 * r, n))


def _wine_shelf(m: Model, part: str, x: Span, y: Span, z: float, style: str, pitch: float) -> None:
    """A shelf: wires, beech slats or a plate, with a front of wood or steel, and its bottles."""
    if style == "wire":
        rack(m, part, x, y, z)
    elif style == "slats":
        m.add(part, *(box(x, (b, b + 0.03), (z, z + 0.012)) for b in np.linspace(y[0] + 0.03, y[1] - 0.03, 4)))
        m.add(part, *(box((a, a + 0.02), y, (z - 0.008, z + 0.002)) for a in (x[0], x[1] - 0.02)))
    else:
        m.add(part, box(x, y, (z, z + 0.008)))
    if style != "plate" or m.chance(0.5):
        m.add(part, box(x, (y[0] - 0.018, y[0] + 0.002), (z - 0.012, z + 0.025)))
    _bottles(m, part, x, y, z + 0.012, pitch)


def wine_cooler(m: Model) -> None:
    """A glass door or two before shelves of bottles that pull out; narrow, tall, built in, for the counter; one zone or two."""
    kind = m.pick("narrow", "built_in", "tall", "counter", "two")
    wide = {"narrow": m.number(0.15, 0.3), "counter": m.number(0.26, 0.5), "two": m.number(0.8, 1.0)}.get(
        kind, m.number(0.48, 0.62)
    )
    high = {"tall": m.number(1.2, 1.8), "counter": m.number(0.4, 0.66)}.get(kind, m.number(0.8, 0.88))
    deep, foot, head = m.number(0.48, 0.6), m.number(0.015, 0.1), m.pick(0.0, 0.0, 0.05, 0.08)
    z, two_zones = (foot, foot + high), m.chance(0.4) and kind != "counter"
    how = look(m, 0.5, ("glass",), ("bar", "rail", "merged", "knob", "rim", "none"))
    how = replace(
        how,
        sunk=m.pick(None, None, 0.0),
        thick=m.number(0.025, 0.045),
        clear=m.pick(0.001, 0.003),
        length=m.pick(0.3, 0.7, 0.9),
    )
    rooms = [((0.0, wide), (z[0], z[1] - head))]
    if kind == "two":
        rooms = [((0.0, wide / 2), rooms[0][1]), ((wide / 2, wide), rooms[0][1])]
    if how.sunk is not None:
        rooms = [(shrunk(a, 0.018), shrunk(b, 0.018)) for a, b in rooms]
    hollow = body(m, (0.0, wide), (0.0, deep), z, rooms, how, m.number(0.02, 0.035))
    feet(m, (0.0, wide), (0.0, deep), foot)
    style, side, pitch, every = m.pick("wire", "slats", "plate"), m.pick("left", "right"), m.pick(0.085, 0.1), m.pick(1, 1, 2)
    for k, (a, b) in enumerate(rooms):
        door(m, f"door_{k}", a, b, ("left", "right")[k] if kind == "two" else side, how, m.pick(95, 110, 130))
        inner, start = shrunk(a, 0.045), max(how.depth[1], 0.0) + 0.03
        count = int((b[1] - b[0] - 0.1) / m.pick(0.11, 0.14, 0.18))
        for n, c in enumerate(np.linspace(b[0] + 0.06, b[1] - 0.15, max(count, 2)) if hollow else ()):
            moves = n % every == 0
            part = f"shelf_{k}_{n}" if moves else BASE
            _wine_shelf(m, part, inner, (start, deep - 0.05), float(c), style, pitch)
            m.add(BASE, *(box((e, e + 0.015), (start, deep - 0.04), (c - 0.006, c)) for e in (a[0] + 0.03, a[1] - 0.045)))
            if moves:
                m.slide(part, (0, -1, 0), m.number(0.45, 0.7) * deep)
        if two_zones and hollow:
            c = middle(b) + 0.025
            m.add(BASE, box(shrunk(a, 0.02), (start, deep - 0.04), (c, c + 0.02)))
    _cooler_outside(m, wide, deep, z, head, len(rooms) == 1 and hollow)


def _cooler_outside(m: Model, wide: float, deep: float, z: Span, head: float, lamp: bool) -> None:
    """A control strip over the door, a worktop, vents at the rear, a lamp inside."""
    if head:
        c = z[1] - head / 2
        m.add(BASE, box((0.3 * wide, 0.6 * wide), (-0.003, 0.001), (c - 0.3 * head, c + 0.3 * head)))
        for k in range(m.pick(2, 3)):
            button(m, f"button_{k}", ((0.68 + 0.09 * k) * wide, 0, c), (0, -1, 0), min(0.012, 0.06 * wide))
    if m.chance(0.4):
        m.add(BASE, box((-0.01, wide + 0.01), (-0.02, deep + 0.01), (z[1], z[1] + 0.025)))
    if m.chance(0.4):
        m.add(
            BASE,
            *(
                rod((0.05, deep + 0.012, c), (wide - 0.05, deep + 0.012, c), 0.004, 6)
                for c in np.linspace(z[0] + 0.2, z[1] - 0.1, 8)
            ),
        )
        m.add(BASE, *(box((e, e + 0.008), (deep - 0.002, deep + 0.016), shrunk(z, 0.06)) for e in (0.05, wide - 0.058)))
    if lamp and m.chance(0.4):
        m.add(BASE, ball((wide / 2, 0.6 * deep, z[1] - head - 0.05), (0.015, 0.015, 0.01), 8))
