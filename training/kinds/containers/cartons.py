"""Shipping cartons and pizza boxes."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot
from shapely.geometry import Polygon

from training.kinds.joinery import quad, shrunk
from training.kinds.kitchen_parts import without
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, cut, prism, rectangle, rod


def shell(m: Model, part: str, x: Span, y: Span, z: Span, wall: float, mouth: int = 1, how: str = "") -> None:
    """A box without its top (mouth 1) or its bottom (-1): cut from a block, of boards, or of single sheets."""
    how = how or m.pick("cut", "boards", "sheet")
    floor, inner = ((z[0], z[0] + wall) if mouth > 0 else (z[1] - wall, z[1])), (shrunk(x, wall), shrunk(y, wall))
    if how == "cut":
        m.add(part, cut(box(x, y, z), box(*inner, (floor[1], z[1] + 1) if mouth > 0 else (z[0] - 1, floor[0]))))
    elif how == "boards":
        m.add(part, prism(rectangle(x, y, wall), "z", z), box(*inner, floor))
    else:
        m.add(part, without(box(x, y, z), (0, 0, mouth)))


def flap(m: Model, part: str, a: Point, b: Point, size: Point, z: float, degrees: float, up: int = 1) -> None:
    """A leaf to the left of the line from a to b, where it hinges; size: its reach, taper and thickness (0: a sheet)."""
    a, b, (reach, taper, thick) = np.array(a, float), np.array(b, float), size
    along = (b - a) / np.linalg.norm(b - a)
    into = np.array([-along[1], along[0]])
    outline = [a, b, b + reach * into - taper * along, a + reach * into + taper * along]
    floor = 180 + float(np.rad2deg(np.arcsin(min(1.0, 0.95 * z / reach))))
    m.add(part, prism(outline, "z", (z, z + thick)) if thick > 0 else quad(*((*p, z) for p in outline)))
    m.hinge(part, (*(a + b) / 2, z), up * np.cross([*into, 0], [0, 0, 1]), min(degrees, floor))


def _flaps(m: Model, x: Span, y: Span, z: float, thick: float, style: str, up: int = 1) -> None:
    """Four flaps at one level or in pairs over each other; up: -1 for those of the bottom."""
    wide, deep, name = x[1] - x[0], y[1] - y[0], "flap" if up > 0 else "bottom_flap"
    reach = {"meet": 0.5, "overlap": m.number(0.8, 0.98), "short": m.number(0.25, 0.42), "mitred": m.number(0.3, 0.5)}[style]
    taper = reach * deep if style == "mitred" else m.pick(0.0, 0.004, 0.02)
    minor, major = m.pick((90, 100), (120, 110), (180, 180), (150, 200), (200, 230)) if up > 0 else (90, 90)
    level = 0.0 if style == "mitred" else up * max(thick, m.pick(0.001, 0.003))
    under = min(deep * (0.5 if style == "overlap" else reach), 0.49 * wide)
    c = m.pick(0.0, 0.001)
    flap(m, f"{name}_right", (x[1], y[0] + c), (x[1], y[1] - c), (under - c, min(taper, under), thick), z, minor, up)
    flap(m, f"{name}_left", (x[0], y[1] - c), (x[0], y[0] + c), (under - c, min(taper, under), thick), z, minor, up)
    long, z = deep * reach - c, z + level
    flap(m, f"{name}_back", (x[1], y[1]), (x[0], y[1]), (long, min(taper, 0.49 * wide), thick), z, major, up)
    z += level if style == "overlap" else 0.0
    flap(m, f"{name}_front", (x[0], y[0]), (x[1], y[0]), (long, min(taper, 0.49 * wide), thick), z, major, up)
    if up > 0 and style == "meet" and m.chance(0.4):
        tape, w = m.pick("flap_front", "flap_back"), min(0.025, 0.1 * deep)
        m.add(tape, box(x, (-w, w), (z + thick, z + thick + 0.0008)))


def _lid_and_tuck(m: Model, x: Span, y: Span, z: float, thick: float) -> None:
    """A lid as deep as the carton, hinged at its back, with a tongue that hinges at its front, over two side flaps."""
    t, deep = max(thick, 0.002), y[1] - y[0]
    for name, a, sign in (("flap_right", x[1], 1), ("flap_left", x[0], -1)):
        ends = [(a, sign * y[0]), (a, sign * y[1])] if sign > 0 else [(a, y[1]), (a, y[0])]
        flap(m, name, *ends, (min(0.4 * deep, 0.4 * (x[1] - x[0])), 0.02, thick), z, m.pick(90, 110))
    z += max(thick, 0.002)
    m.add("lid", box(x, y, (z, z + t)))
    m.hinge("lid", (0, y[1], z), (-1, 0, 0), m.pick(110, 140, 180))
    inside = y[0] + m.pick(-t - 0.001, 0.006)
    m.add("tongue", box(shrunk(x, 0.008), (inside, inside + t), (z - m.number(0.12, 0.3) * deep, z)))
    m.hinge("tongue", (0, inside, z), (-1, 0, 0), m.pick(90, 60), "lid")


def _carton_body(m: Model, x: Span, y: Span, z: Span, open_below: bool) -> None:
    """The walls, with a floor or without; perhaps with hand holes, a tray, boxes inside or a solid filling."""
    wall, holes = 0.004, []
    if m.chance(0.5) and z[1] - z[0] > 0.16:
        at = z[1] - m.number(0.07, 0.1)
        holes = [box((x[0] - 1, x[1] + 1), (-0.04, 0.04), (at - 0.014, at + 0.014))]
    inner = shrunk(x, wall), shrunk(y, wall), (z[0] - 1 if open_below else z[0] + wall, z[1] + 1)
    if m.chance(0.25) and not open_below:
        m.add(BASE, box(x, y, (z[0], z[1] - 0.001)))
    elif holes or m.chance(0.4):
        m.add(BASE, cut(box(x, y, z), box(*inner), *holes))
    elif open_below:
        m.add(BASE, prism(rectangle(x, y, wall), "z", z))
    else:
        shell(m, BASE, x, y, z, wall)
    fill = m.pick("none", "none", "tray", "boxes", "cross") if not open_below else m.pick("none", "cross")
    x, y, top = shrunk(x, 0.008), shrunk(y, 0.008), z[0] + m.number(0.4, 0.9) * (z[1] - z[0] - 0.01)
    if fill == "tray":
        shell(m, BASE, x, y, (top - 0.4 * (top - z[0]), top), 0.004)
    elif fill == "boxes":
        for k in range(2):
            part = x[0] + k * (x[1] - x[0]) / 2, x[0] + (k + m.number(0.7, 0.97)) * (x[1] - x[0]) / 2
            m.add(BASE, box(part, y, (z[0] + wall, top - 0.03 * k)))
    elif fill == "cross":
        m.add(BASE, box(x, (-0.002, 0.002), (z[0] + wall, top)), box((-0.002, 0.002), y, (z[0] + wall, top)))


def shipping_carton(m: Model) -> None:
    """A cardboard carton: four top flaps that meet, overlap, stop short or are mitred, or a tuck lid; sheets or solids."""
    wide, high = m.number(0.25, 0.6), m.number(0.1, 0.4)
    deep, thick = wide * m.number(0.55, 1.0), m.pick(0.0, 0.0, 0.003, 0.005)
    x, y, pallet = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.chance(0.2)
    below = not pallet and m.chance(0.2)
    low = 0.12 if pallet else 0.0
    _carton_body(m, x, y, (low + (0.012 if below else 0), low + high), below)
    style = m.pick("meet", "meet", "overlap", "short", "mitred", "tuck")
    if style == "tuck":
        _lid_and_tuck(m, x, y, low + high, thick)
    else:
        _flaps(m, x, y, low + high, thick, style)
    if below:
        _flaps(m, x, y, 0.006, thick, "meet", -1)
    if pallet:
        over = shrunk(x, -0.06), shrunk(y, -0.06)
        m.add(BASE, *(box(over[0], (c - 0.04, c + 0.04), (0.1, 0.12)) for c in np.linspace(y[0], y[1], 4)))
        m.add(BASE, *(box((c - 0.04, c + 0.04), over[1], (0, 0.1)) for c in (x[0], 0, x[1])))
    if m.chance(0.6):
        a, b = x[0] + m.number(0.1, 0.5) * wide, low + m.number(0.2, 0.5) * high
        m.add(BASE, box((a, a + 0.3 * wide), (y[0] - 0.001, y[0]), (b, b + 0.3 * high)))
    if m.chance(0.4):
        m.add(BASE, *(box((a, a + 0.001), (-0.025, 0.025), (low + 0.4 * high, low + high)) for a in (x[0] - 0.001, x[1])))


def _pizza(m: Model, r: float, z: float) -> None:
    """A pizza with a crust and toppings, cut or whole, perhaps with the small stand in its middle."""
    n = m.pick(16, 24)
    m.add(BASE, lathe([(0.95 * r, z), (r, z + 0.006), (0.96 * r, z + 0.015), (0.88 * r, z + 0.008), (0, z + 0.008)], n))
    for t in np.linspace(0, 6.28, m.pick(4, 7, 9))[:-1]:
        c = m.number(0.3, 0.75) * r * np.array([np.cos(t), np.sin(t)])
        m.add(BASE, rod((*c, z + 0.006), (*c, z + 0.011), 0.1 * r, 10))
    if m.chance(0.4):
        m.add(BASE, rod((0, 0, z + 0.024), (0, 0, z + 0.027), 0.018, 10))
        m.add(
            BASE,
            *(
                rod((0.014 * a, 0.014 * b, z + 0.006), (0.014 * a, 0.014 * b, z + 0.025), 0.0015, 5)
                for a, b in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))
            ),
        )


def pizza_box(m: Model) -> None:
    """A low box with a lid hinged at its back: square, half or with cut corners; lips, a tuck flap, a pizza, boxes below."""
    wide, high, t = m.number(0.25, 0.45), m.number(0.035, 0.055), m.pick(0.002, 0.003, 0.004)
    deep, z = wide * m.pick(1.0, 1.0, 1.0, 0.55), 0.0
    x, y, chop = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.pick(0.0, 0.0, 0.15, 0.25) * deep
    outline = Polygon(
        [(x[0] + chop, y[0]), (x[1] - chop, y[0]), (x[1], y[0] + chop), (x[1], y[1]), (x[0], y[1]), (x[0], y[0] + chop)]
    )
    for _ in range(m.pick(0, 0, 0, 1, 2)):
        m.add(BASE, prism(outline, "z", (z, z + high)))
        z += high + 0.002
    walls = outline.difference(outline.buffer(-t, join_style="mitre"))
    m.add(BASE, prism(walls, "z", (z, z + high)), prism(outline, "z", (z, z + t)))
    top = z + high
    m.add("lid", prism(outline, "z", (top, top + t)))
    m.hinge("lid", (0, y[1], top), (-1, 0, 0), m.pick(95, 110, 130, 180))
    lip, drop = m.pick("outer", "inner", "front", "tuck", "none"), m.number(0.4, 0.95) * high
    if lip in ("outer", "inner"):
        edge = outline.buffer(0.0015 + t if lip == "outer" else -t - 0.0015, join_style="mitre")
        around = edge.difference(edge.buffer(-t, join_style="mitre")).difference(rectangle((-1, 1), (y[1] - 0.02, 1)))
        m.add("lid", prism(around, "z", (top - drop, top + (t if lip == "outer" else 0))))
    elif lip != "none":
        front = y[0] + m.pick(-t - 0.001, t + 0.001)
        part = "lid" if lip == "front" else "tuck_flap"
        m.add(part, box((x[0] + chop + 0.012, x[1] - chop - 0.012), (front, front + t), (top - drop, top)))
        if lip == "tuck":
            m.hinge("tuck_flap", (0, front, top), (-1, 0, 0), m.pick(90, 70), "lid")
            m.add("tuck_flap", box((-0.03, 0.03), (front, front + t), (top - drop - 0.004, top - drop)))
    if m.chance(0.6):
        _pizza(m, 0.45 * deep if deep == wide else 0.42 * deep, z + t)
    if m.chance(0.5):
        m.add(
            "lid",
            prism(
                Dot(0, 0).buffer(0.35 * deep, 6).difference(Dot(0, 0).buffer(0.3 * deep, 6)), "z", (top + t, top + t + 0.0006)
            ),
        )
    if m.chance(0.4):
        m.add("lid", box((-0.2 * wide, 0.2 * wide), (-0.04, 0.04), (top + t, top + t + 0.001)))
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                rod((s * wide / 2, c, z + 0.5 * high), (s * (wide / 2 + 0.001), c, z + 0.5 * high), 0.006, 10)
                for s in (-1, 1)
                for c in (-0.06, 0.06)
            ),
        )
