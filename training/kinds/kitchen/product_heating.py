"""Things that cook on a worktop, by one artist: toaster oven, rice cooker."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.product_style import FRONT, UP, Look, lathe, outline
from training.kinds.solids import Span, ball, box, loft, rod, tube


def counter_oven(m: Model) -> None:
    """A toaster oven: one or two doors that fall or swing, a strip of dials beside or below, racks, a crumb tray."""
    look = Look.of(m)
    wide, deep, high, wall = m.number(0.32, 0.52), m.number(0.25, 0.38), m.number(0.2, 0.34), m.number(0.01, 0.02)
    beside = m.chance(0.6)
    strip = m.number(0.07, 0.11) if beside else m.number(0.035, 0.05)
    walls = (wall, strip, wall, wall, wall) if beside else (wall, wall, strip + 0.01, wall, wall)
    x, y, z = (0.0, wide), (0.0, deep), (0.012, 0.012 + high)
    m.add(BASE, *look.shell(x, y, z, walls))
    m.add(BASE, *(rod((a, b, 0), (a, b, 0.013), 0.012, look.n) for a in (0.03, wide - 0.03) for b in (0.03, deep - 0.03)))
    opening = (walls[0], wide - walls[1]), (z[0] + walls[2], z[1] - walls[3])
    lap, gap = m.number(0.2, 0.8) * wall, max(0.0, m.gap(0.2))
    door_x, door_z = (opening[0][0] - lap, opening[0][1] + lap), (opening[1][0] - lap, opening[1][1] + lap)
    _oven_doors(look, door_x, door_z, -gap, look.depth(m.number(0.012, 0.022)))
    _oven_inside(look, opening[0], (0.0, deep - wall), opening[1])
    if beside:
        m.add(
            BASE, *([box((wide - 0.9 * strip, wide - 0.1 * strip), (-0.002, 0.001), (z[1] - 0.06, z[1] - 0.02))] * m.pick(0, 1))
        )
        places = [(wide - strip / 2, h) for h in np.linspace(z[0] + 0.035, z[1] - 0.095, m.pick(1, 2, 3))]
    else:
        places = [(a, z[0] + (strip + 0.006) / 2) for a in np.linspace(0.12 * wide, 0.88 * wide, m.pick(2, 3, 4))]
    size = min(0.3 * strip, 0.022) if beside else 0.33 * strip
    buttons = m.chance(0.25)
    for k, (a, h) in enumerate(places):
        if buttons and k:
            look.key(f"key_{k}", (a, 0, h), FRONT, (1.2 * size, 1.2 * size, 0.005))
        else:
            look.dial(f"dial_{k}", (a, 0, h), FRONT, size, m.number(0.012, 0.022))
    if m.chance(0.5):
        slots = np.linspace(0.3 * deep, 0.7 * deep, 5)
        m.add(
            BASE,
            *(box((s - 0.0006, s + 0.0006), (b, b + 0.012), (z[0] + 0.5 * high, z[0] + 0.8 * high)) for s in x for b in slots),
        )
    if m.chance(0.4):
        m.add(BASE, tube([(0.1, deep - 0.01, 0.03), (0.1, deep + 0.05, 0.02), (0.2, deep + 0.08, 0.008)], 0.004, 6))


def _oven_doors(look: Look, x: Span, z: Span, y: float, thick: float) -> None:
    """A door that falls, one that swings, or two that swing."""
    m, frame = look.m, look.m.pick(0.02, 0.03, 0.035)
    style = m.pick("fall", "fall", "swing", "two")
    bounds = [x] if style != "two" else [(x[0], (x[0] + x[1]) / 2 - 0.0008), ((x[0] + x[1]) / 2 + 0.0008, x[1])]
    for k, span in enumerate(bounds):
        part = "door" if style != "two" else f"door_{k}"
        look.front(part, span, z, y, thick, frame)
        middle, tall, long = (span[0] + span[1]) / 2, z[1] - z[0], span[1] - span[0]
        out = m.number(0.025, 0.04)
        if style == "fall":
            look.grip(part, (middle, y - thick, z[1] - 0.5 * frame), (1, 0, 0), 0.7 * long, out)
            m.hinge(part, (middle, y, z[0]), (1, 0, 0), m.pick(90, 95, 85))
        else:
            left = k == 0 if style == "two" else m.chance(0.5)
            edge = span[1] - 0.5 * frame if left else span[0] + 0.5 * frame
            look.grip(part, (edge, y - thick, (z[0] + z[1]) / 2), UP, 0.6 * tall, out)
            m.hinge(part, (span[0] if left else span[1], y, z[0]), (0, 0, -1 if left else 1), m.pick(100, 120))


def _oven_inside(look: Look, x: Span, y: Span, z: Span) -> None:
    """Racks that pull out on rails, heating rods, a tray for crumbs."""
    m = look.m
    if m.chance(0.35):
        return
    rows = np.linspace(z[0], z[1], m.pick(3, 4))[1:-1]
    for k, h in enumerate(rows):
        m.add(BASE, *(box((a, a + s * 0.008), (0.02, y[1] - 0.01), (h - 0.006, h - 0.003)) for a, s in ((x[0], 1), (x[1], -1))))
        part, r = f"rack_{k}", 0.0018
        if look.style == "sheet" or m.chance(0.3):
            m.add(part, box((x[0] + 0.002, x[1] - 0.002), (0.015, y[1] - 0.012), (h - 0.003, h - 0.001)))
        else:
            bars = np.linspace(x[0] + 0.004, x[1] - 0.004, m.pick(8, 12, 16))
            m.add(part, *(rod((a, 0.015, h), (a, y[1] - 0.015, h), r, 6) for a in bars))
            m.add(part, *(rod((bars[0], b, h), (bars[-1], b, h), 1.3 * r, 6) for b in (0.015, y[1] - 0.02)))
        m.slide(part, FRONT, 0.75 * y[1])
    if m.chance(0.6):
        m.add(
            BASE,
            *(
                rod((x[0], b, h), (x[1], b, h), 0.004, 8)
                for b in (0.3 * y[1], 0.7 * y[1])
                for h in (z[0] + 0.015, z[1] - 0.015)
            ),
        )
    if m.chance(0.4):
        m.add("crumb_tray", box((x[0] + 0.004, x[1] - 0.004), (0.004, y[1] - 0.01), (z[0] + 0.0005, z[0] + 0.004)))
        m.slide("crumb_tray", FRONT, 0.7 * y[1])


def rice_pot_cooker(m: Model) -> None:
    """A rice cooker: a round or square body with a hinged lid, or a plain drum with a loose lid; pot, keys, carrying bow."""
    look = Look.of(m)
    r, high, n = m.number(0.11, 0.15), m.number(0.14, 0.2), max(look.n, 12)
    if m.chance(0.4):
        _drum_cooker(look, r, high)
        return
    long, square, steps = m.number(1.0, 1.3) * r, m.chance(0.5), 2 if look.style == "prop" else 5
    corner = m.number(0.35, 0.6) * r if square else 0.98 * r

    def plan(size: float, z: float) -> np.ndarray:
        return outline((-size * r, size * r), (-size * long, size * long), size * corner, z, steps)

    belly = m.number(0.0, 0.08)
    inner = [(0.8, high), (0.74, 0.03)] if look.style != "sheet" else []
    body = [(0.86, 0.0), (0.97, 0.02), (1.0 + belly, 0.45 * high), (1.0, high), *inner]
    m.add(BASE, loft(np.array([plan(*row) for row in body]), look.style != "sheet"))
    top, gap = m.number(0.035, 0.07), max(0.0005, m.gap(0.1))
    lid = [(1.0, high + gap), (1.0, high + gap + 0.3 * top), (0.9, high + 0.75 * top), (0.6, high + top)]
    m.add("lid", loft(np.array([plan(*row) for row in lid])))
    if m.chance(0.6):
        m.add("lid", lathe([(0.2 * r, 0), (0.18 * r, 0.012), (0.1 * r, 0.014)], n, (0, 0.3 * long, high + top - 0.004)))
    m.hinge("lid", (0, 0.97 * long, high), (-1, 0, 0), m.pick(75, 90, 100))
    if m.chance(0.6):
        m.add(BASE, rod((-0.3 * r, long, high), (0.3 * r, long, high), 0.008, n))
    if m.chance(0.7):
        rows = [(0.55, 0.04), (0.68, 0.06), (0.7, high - 0.002), (0.76, high - 0.002), (0.76, high), (0.67, high), (0.65, 0.06)]
        m.add("pot", loft(np.array([plan(size, z) for size, z in rows])))
        m.slide("pot", UP, 0.6 * high)
    _cooker_front(look, -long * (1.0 + 0.5 * belly), high, r)
    if m.chance(0.5):
        w, h = (1.0 + belly) * r + 0.006, high * 0.75
        path = [(w, 0, h), (w + 0.004, -0.02, 0.5 * high), (w, -0.9 * long, 0.35 * high)]
        ends = [path[0], (w, 0, high + 1.3 * top), (-w, 0, high + 1.3 * top), (-w, 0, h)]
        m.add("bow", tube(ends, 0.006, 8))
        m.add(BASE, *(rod((s * 0.9 * r, 0, h), (s * (w + 0.002), 0, h), 0.012, n) for s in (-1, 1)))
        m.hinge("bow", (0, 0, h), (-1, 0, 0), (0, m.pick(70, 80)) if m.chance(0.5) else (-70, 0))


def _cooker_front(look: Look, y: float, high: float, r: float) -> None:
    """A plate of keys, a screen and the catch of the lid, at the front of a rice cooker."""
    m, out = look.m, look.m.number(0.004, 0.01)
    m.add(BASE, look.block((-0.45 * r, 0.45 * r), (y - out, y + 0.25 * r), (0.2 * high, 0.8 * high), leave="y"))
    if m.chance(0.6):
        m.add(BASE, box((-0.25 * r, 0.25 * r), (y - out - 0.001, y), (0.55 * high, 0.72 * high)))
    row = np.linspace(-0.3 * r, 0.3 * r, m.pick(1, 2, 3, 4))
    for k, a in enumerate(row if len(row) > 1 else [0.0]):
        look.key(f"key_{k}", (a, y - out, 0.38 * high), FRONT, (0.13 * r, 0.13 * r, 0.004))
    if m.chance(0.6):
        m.add("catch", look.block((-0.012, 0.012), (y - 0.012, y + 0.02), (0.86 * high, 0.97 * high), leave="y"))
        m.slide("catch", (0, 1, 0), 0.004)


def _drum_cooker(look: Look, r: float, high: float) -> None:
    """A plain drum with two ears, a lever switch, a pot that lifts out and a loose lid."""
    m, n = look.m, max(look.n, 12)
    m.add(
        BASE,
        lathe(
            [(0.9 * r, 0), (0.95 * r, 0.01), (r, 0.015), (r, high), (0.94 * r, high), (0.94 * r, 0.03)],
            n,
            caps=look.style != "sheet",
        ),
    )
    for s in (-1, 1):
        m.add(
            BASE,
            look.block(
                *((s * a, s * b) if s > 0 else (s * b, s * a) for a, b in [(0.97 * r, 1.22 * r)]),
                (-0.3 * r, 0.3 * r),
                (0.75 * high, 0.85 * high),
            ),
        )
    m.add(
        "pot",
        lathe(
            [
                (0.8 * r, 0.035),
                (0.9 * r, 0.05),
                (0.9 * r, high + 0.002),
                (1.02 * r, high + 0.004),
                (0.88 * r, high),
                (0.86 * r, 0.05),
                (0, 0.04),
            ],
            n,
        ),
    )
    m.slide("pot", UP, 0.7 * high)
    dome = [(0.95 * r, 0.0), (0.97 * r, 0.004), (0.7 * r, 0.3 * r * m.number(0.5, 0.9)), (0.2 * r, 0.3 * r)]
    m.add("lid", lathe(dome, n, (0, 0, high + 0.005)))
    m.add(
        "lid",
        lathe(
            [(0.06 * r, 0), (0.06 * r, 0.1 * r), (0.16 * r, 0.15 * r), (0.16 * r, 0.2 * r)], n, (0, 0, high + 0.004 + 0.3 * r)
        ),
    )
    m.slide("lid", UP, 0.5 * high, "pot" if m.chance(0.5) else BASE)
    m.add(BASE, look.block((-0.3 * r, 0.3 * r), (-1.06 * r, -0.8 * r), (0.1 * high, 0.6 * high), leave="y"))
    m.add("lever", look.block((-0.1 * r, 0.1 * r), (-1.25 * r, -1.03 * r), (0.22 * high, 0.22 * high + 0.014), leave="y"))
    m.slide("lever", (0, 0, -1), 0.01) if m.chance(0.5) else m.hinge("lever", (0, -1.03 * r, 0.24 * high), (1, 0, 0), (0, 15))
    m.add(BASE, *(ball((s * 0.15 * r, -1.06 * r, 0.48 * high), (0.005, 0.003, 0.005), 8) for s in (-1, 1)))
