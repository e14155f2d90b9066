"""Gift boxes and matchboxes."""

from __future__ import annotations

import numpy as np
from shapely.affinity import scale
from shapely.geometry import Point as Dot
from shapely.geometry import Polygon

from training.kinds.containers.cartons import shell
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, rounded, tube, turned


def _outline(m: Model) -> tuple[Polygon, bool]:
    """The outline of a gift box about the middle, and whether it is a rectangle."""
    kind, r = m.pick("rectangle", "square", "round", "round", "hexagon", "heart"), m.number(0.06, 0.16)
    if kind in ("rectangle", "square"):
        deep = r * (1.0 if kind == "square" else m.number(0.5, 0.9))
        return rectangle((-r, r), (-deep, deep)), True
    if kind == "heart":
        lobes = [Dot(s * 0.5 * r, 0.25 * r).buffer(0.58 * r, 6) for s in (-1, 1)]
        point = Polygon([(-0.98 * r, -0.08 * r), (0, -r), (0.98 * r, -0.08 * r), (0, 0.5 * r)])
        return lobes[0].union(lobes[1]).union(point), False
    t = np.linspace(0, 2 * np.pi, 7 if kind == "hexagon" else m.pick(17, 25, 33))[:-1]
    return Polygon(r * np.c_[np.cos(t), np.sin(t)]), False


def _around(outline: Polygon, out: float, thick: float) -> Polygon:
    """A ring of a thickness that begins outside an outline at a distance."""
    inner = outline.buffer(out, join_style="mitre")
    return outline.buffer(out + thick, join_style="mitre").difference(inner)


def _bands(m: Model, part: str, outline: Polygon, z: Span, cover: bool, lines: list[Polygon]) -> None:
    """Ribbons round the sides of an outline, and across its top when it is covered."""
    for line in lines:
        for piece in _around(outline, 0.0, 0.0015).intersection(line).geoms:
            m.add(part, prism(piece, "z", z))
        if cover:
            m.add(part, prism(outline.buffer(0.0015, join_style="mitre").intersection(line), "z", (z[1], z[1] + 0.0015)))


def _bow(m: Model, part: str, z: float, size: float) -> None:
    """Loops of ribbon about a knot, and its two ends."""
    loop = scale(Dot(0, 0).buffer(1.0, 5), size, 0.45 * size)
    strip = loop.difference(scale(loop, 0.84, 0.7))
    count, wide = m.pick(2, 4, 6), m.number(0.2, 0.35) * size
    for k in range(count):
        piece = prism(strip, "y", (-wide, wide))
        piece.apply_translation([size, 0, 0])
        turned(turned(piece, (0, -1, 0), m.number(15, 30), (0, 0, 0)), (0, 0, 1), 360 * k / count + 20, (0, 0, 0))
        piece.apply_translation([0, 0, z + 0.3 * size])
        m.add(part, piece)
    m.add(part, ball((0, 0, z + 0.3 * size), (0.35 * size, 0.35 * size, 0.3 * size), 8))
    if m.chance(0.5):
        for k in (-1, 1):
            end = box((0, 1.8 * size), (-wide, wide), (z, z + 0.001))
            m.add(part, turned(end, (0, 0, 1), 90 + 35 * k, (0, 0, 0)))


def _present(m: Model, outline: Polygon, z: Span) -> None:
    """What lies in a gift box: nothing, a padded insert, wrapping with a ball, or a small box."""
    what, inner = m.pick("none", "insert", "ball", "box"), outline.buffer(-0.006)
    r = 0.3 * min(outline.bounds[2], outline.bounds[3], z[1] - z[0])
    if what in ("insert", "ball"):
        m.add(BASE, prism(inner, "z", (z[0], z[0] + 0.5 * (z[1] - z[0]))))
    if what == "ball":
        m.add(BASE, ball((0, 0, z[0] + 0.5 * (z[1] - z[0])), (r, r, r), 10))
    elif what == "box":
        m.add(BASE, box((-r, r), (-0.8 * r, 0.8 * r), (z[0], z[0] + 0.7 * (z[1] - z[0]))))


def gift_box(m: Model) -> None:
    """A gift box: a lid that lifts off, a hinged lid, or a drawer; any outline, ribbons, a bow, a tag, a present."""
    style = m.pick("lift", "lift", "hinged", "drawer")
    if style == "drawer":
        _gift_drawer(m)
        return
    outline, square = _outline(m)
    while style == "hinged" and not square:
        outline, square = _outline(m)
    x0, y0, x1, y1 = outline.bounds
    high, t, gap = m.number(0.4, 1.6) * y1, m.number(0.0015, 0.003), m.pick(0.0, 0.0005, 0.001)
    m.add(BASE, prism(_around(outline, -t, t), "z", (0, high)), prism(outline, "z", (0, t)))
    _present(m, outline, (t, high))
    skirt = m.pick(0.2, 0.3, 0.5, 0.9) * high if style == "lift" else m.pick(0.0, 0.25, 0.9) * high
    lid = outline.buffer(gap + t, join_style="mitre")
    rim = _around(outline, gap, t)
    if style == "hinged":
        lid, rim = outline, rim.intersection(rectangle((x0 - 1, x1 + 1), (y0 - 1, y0)))
        m.hinge("lid", (0, y1, high), (-1, 0, 0), m.pick(90, 110, 180))
    else:
        m.slide("lid", (0, 0, 1), min(skirt + m.number(0.15, 0.5) * high, 1.05 * high))
    m.add("lid", prism(lid, "z", (high, high + t)))
    if skirt > 0:
        m.add("lid", prism(rim, "z", (high - skirt, high + (t if style == "hinged" else 0.0))))
    w = m.number(0.08, 0.2) * x1
    lines = [rectangle((x0 - 1, x1 + 1), (-w, w)), rectangle((-w, w), (y0 - 1, y1 + 1))]
    lines = m.pick(lines, lines, lines[1:], [])
    if style == "lift":
        _bands(m, BASE, outline, (0, high - skirt), False, lines)
        _bands(m, "lid", lid, (high - skirt, high + t), True, lines)
    elif lines:
        m.add("lid", box((-w, w), (y0, y1), (high + t, high + t + 0.001)))
        m.add("lid", box((-w, w), (y0 - 0.003 - gap - t, y0 - gap - t), (high - max(skirt, 0.02), high + t)))
    if m.chance(0.7):
        _bow(m, "lid", high + t + 0.001, 0.3 * min(x1, y1))
    if m.chance(0.3):
        m.add(BASE, box((0.3 * x1, 0.3 * x1 + 0.03), (y0 - 0.003, y0 - 0.0015), (0.1 * high, 0.1 * high + 0.02)))


def _gift_drawer(m: Model) -> None:
    """A sleeve with a tray that is drawn out by a ribbon, a knob or a notch."""
    wide, deep, high, t = m.number(0.08, 0.2), m.number(0.08, 0.16), m.number(0.03, 0.1), 0.002
    x, y, z = (-wide / 2, wide / 2), (-deep / 2, deep / 2), (0.0, high)
    m.add(BASE, prism(rectangle(x, z, t), "y", y), box(shrunk(x, t), (y[1] - t, y[1]), shrunk(z, t)))
    c = m.pick(0.0002, 0.0006)
    x, z, y = shrunk(x, t + c), shrunk(z, t + c), (y[0] - m.pick(0.0, 0.002), y[1] - t)
    shell(m, "drawer", x, y, z, t)
    m.slide("drawer", (0, -1, 0), m.number(0.6, 0.9) * deep)
    pull = m.pick("loop", "knob", "band")
    if pull == "loop":
        path = [
            (-0.008, y[0], high / 2),
            (-0.008, y[0] - 0.02, high / 2),
            (0.008, y[0] - 0.02, high / 2),
            (0.008, y[0], high / 2),
        ]
        m.add("drawer", tube(path, 0.0015, 6))
    elif pull == "knob":
        m.add("drawer", ball((0, y[0] - 0.005, high / 2), (0.006,) * 3, 10))
    else:
        m.add("drawer", box((-0.02, 0.02), (y[0] - 0.002, y[0]), (0.35 * high, 0.65 * high)))
    if m.chance(0.85):
        m.add(BASE, box((-0.08 * wide, 0.08 * wide), (y[0] + 0.003, y[1]), (high, high + 0.001)))
        if m.chance(0.85):
            _bow(m, BASE, high + 0.001, 0.12 * min(wide, deep))
    if m.chance(0.5):
        m.add("drawer", prism(rounded(shrunk(x, 0.004), shrunk(y, 0.004), 0.003), "z", (t + 0.001, 0.5 * high)))


def _match(m: Model, part: str, a: tuple[float, float, float], length: float, thick: float) -> None:
    """A match from a point along y, with its head."""
    end = np.array(a) + np.array([0, length, 0])
    m.add(part, box(*np.c_[np.array(a) - thick / 2, end + thick / 2]), ball(end, (0.9 * thick,) * 3, 6))


def _sleeve(m: Model, x: Span, y: Span, z: Span, t: float) -> None:
    """The sleeve of a matchbox with striking strips, a label, and perhaps a notch for the thumb."""
    wide, long, high = x[1] - x[0], y[1] - y[0], z[1] - z[0]
    sleeve = prism(rectangle(x, z, t), "y", y)
    if m.chance(0.35):
        sleeve = cut(sleeve, *(rod((0, y[0], c - 0.1 * high), (0, y[0], c + 0.1 * high), 0.22 * wide, 16) for c in z))
    m.add(BASE, sleeve)
    if m.chance(0.8):
        strip = shrunk(y, m.pick(0.0, 0.003)), (z[0] + 0.15 * high, z[1] - 0.15 * high)
        m.add(BASE, *(box((a, a + 0.0006), *strip) for a in (x[0] - 0.0006, x[1])))
    if m.chance(0.6):
        m.add(BASE, box(shrunk(x, 0.12 * wide), (y[0] + 0.3 * wide, y[1] - 0.12 * long), (z[1], z[1] + 0.0005)))
    if m.chance(0.5):
        sign = m.pick(Dot(0, 0).buffer(0.2 * wide, 5), rectangle((-0.2 * wide, 0.2 * wide), (-0.15 * long, 0.25 * long)))
        m.add(BASE, prism(sign, "z", (z[1], z[1] + 0.0012)))


def matchbox(m: Model) -> None:
    """A sleeve with a tray that slides out at one or either end: common, kitchen or long, flat or on its side, on others."""
    long, wide, high = m.pick(
        (0.052, 0.036, 0.016), (0.11, 0.065, 0.026), (0.2, 0.065, 0.03), (0.1, 0.1, 0.025), (0.05, 0.05, 0.01)
    )
    t, low = m.number(0.0006, 0.0016), 0.0
    long, wide, high = long * m.number(0.9, 1.15), wide * m.number(0.9, 1.1), high * m.number(0.8, 1.3)
    side = m.chance(0.25)
    x, y = (-wide / 2, wide / 2), (-long / 2, long / 2)
    for _ in range(0 if side else m.pick(0, 0, 0, 1, 2)):
        m.add(BASE, turned(box(x, y, (low, low + high)), (0, 0, 1), m.number(-12, 12), (0, 0, 0)))
        low += high
    begin, z = len(m.pieces), (low, low + high)
    _sleeve(m, x, y, z, t)
    c, out = m.pick(0.0001, 0.0003, 0.0008), m.pick(0.0, 0.0, 0.001)
    inner, body, thick = shrunk(x, t + c), shrunk(z, t + c), min(0.003, 0.05 * wide, 0.15 * high)
    shell(m, "tray", inner, shrunk(y, -out), body, t)
    if m.chance(0.4):
        m.add(
            "tray", box((-0.25 * wide, 0.25 * wide), (y[0] - out - 0.0012, y[0] - out), (low + 0.25 * high, low + 0.75 * high))
        )
    for a in np.linspace(inner[0] + 2 * thick, inner[1] - 2 * thick, m.pick(0, 5, 8, 10)):
        at = (a, y[0] + t + 2 * thick, body[0] + t + m.pick(1, 2.2) * thick)
        _match(m, "tray", at, m.number(0.75, 0.85) * long, thick)
    if side:
        for _, s in m.pieces[begin:]:
            turned(s, (0, 1, 0), 90, (0, 0, 0)).apply_translation([0, 0, wide / 2])
    m.slide("tray", (0, -1, 0), m.pick((0.0, 0.8 * long), (-0.8 * long, 0.8 * long), (0.0, 0.6 * long)))
    for _ in range(m.pick(0, 0, 2, 4)):
        _match(m, BASE, (m.number(1.1, 1.8) * wide, m.number(-0.6, 0.0) * long, thick), 0.8 * long, thick)
