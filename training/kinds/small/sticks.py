"""USB sticks."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, loft, prism, rectangle, rod, rounded, vec

PLUG = (0.012, 0.0045)  # how wide and high the metal end is


def _plug(m: Model, part: str, begin: float, z: float) -> float:
    """The metal end from x = begin to the right about a height: hollow with contacts, holed, or a block; gives its end."""
    (wide, high), long, style = PLUG, m.pick(0.012, 0.014), m.pick("hollow", "holes", "block")
    x, y, h = (begin - 0.004, begin + long), (-wide / 2, wide / 2), (z - high / 2, z + high / 2)
    shell = box(x, y, h)
    if style == "hollow":
        shell = cut(shell, box((begin, 1), shrunk(y, 0.0004), shrunk(h, 0.0004)))
        m.add(part, box((begin - 0.001, begin + long - 0.001), shrunk(y, 0.0006), (h[0] + 0.0005, z)))
        m.add(
            part,
            *(
                box((begin + 0.003, begin + long - 0.002), (c - 0.0005, c + 0.0005), (z - 0.0001, z + 0.0003))
                for c in (-0.0035, -0.0012, 0.0012, 0.0035)
            ),
        )
    if style != "block":
        at = begin + 0.55 * long
        shell = cut(
            shell,
            *(box((at - 0.001, at + 0.001), (c - 0.001, c + 0.001), (z + 0.5 * high - 0.0003, 1)) for c in (-0.003, 0.003)),
        )
    m.add(part, shell)
    return begin + long


def _case(m: Model, outline: Polygon, z: Span) -> None:
    """A body with an outline between two heights: straight, with chamfers, or in two halves with a seam."""
    style, tall = m.pick("plain", "chamfer", "seam", "band"), z[1] - z[0]
    if style == "chamfer":
        c = 0.15 * tall
        points = np.array(outline.simplify(2e-5).exterior.coords)[:-1]
        mid = points.mean(0)
        inner = mid + (points - mid) * (1 - 2 * c / np.ptp(points, axis=0))
        levels = [(inner, z[0]), (points, z[0] + c), (points, z[1] - c), (inner, z[1])]
        m.add(BASE, loft(np.array([np.c_[p, np.full(len(p), h)] for p, h in levels])))
    elif style == "seam":
        at, inner = z[0] + m.number(0.4, 0.6) * tall, outline.buffer(-0.0005)
        m.add(
            BASE,
            prism(outline, "z", (z[0], at - 0.0002)),
            prism(outline, "z", (at + 0.0002, z[1])),
            prism(inner, "z", (z[0] + 0.001, z[1] - 0.001)),
        )
    else:
        m.add(BASE, prism(outline, "z", z))
    if style == "band":
        a = outline.bounds
        m.add(
            BASE,
            prism(
                rectangle((a[0] + 0.3 * (a[2] - a[0]), a[2] - 0.2 * (a[2] - a[0])), (0.7 * a[1], 0.7 * a[3])),
                "z",
                (z[0] + 0.001, z[1] + 0.0004),
            ),
        )


def _capped(m: Model) -> None:
    """A cap that is drawn off its metal end."""
    long, wide, high = m.number(0.035, 0.055), m.number(0.016, 0.022), m.number(0.007, 0.011)
    z, corner = (0.0, high), m.number(0.1, 0.45)
    y = (-wide / 2, wide / 2)
    outline = rounded((-long, 0), y, corner * wide, 5)
    square = rectangle((-0.4 * long, 0), y)
    outline = outline.union(square) if m.chance(0.7) else outline
    if m.chance(0.4):
        outline = outline.difference(Point(-long + 0.005, 0).buffer(0.0022, quad_segs=4))
    outline = outline.simplify(2e-5)
    holed = bool(outline.interiors)
    m.add(BASE, prism(outline, "z", z)) if holed else _case(m, outline, z)
    end = _plug(m, BASE, 0.0, high / 2)
    gap, shape = m.pick(0.0001, 0.0004, 0.001), m.pick("same", "round", "clear")
    x = (gap, end + m.number(0.002, 0.006))
    w = {"same": 0.0, "round": 0.0, "clear": 0.0015}[shape]
    cap = rounded((x[0] - 0.004, x[1]), shrunk(y, w), (0.08 if shape == "same" else corner) * wide, 5).intersection(
        rectangle((x[0], 1), (-1, 1))
    )
    solid = prism(cap, "z", shrunk(z, 0.5 * w))
    if m.chance(0.7):
        solid = cut(solid, box((-1, end + 0.0008), (-0.0063, 0.0063), (high / 2 - 0.0026, high / 2 + 0.0026)))
    m.add("cap", solid)
    if m.chance(0.3):
        a = x[0] + 0.4 * (x[1] - x[0])
        m.add(
            "cap",
            *(box((a + c, a + c + 0.0008), (0.6 * y[0], 0.6 * y[1]), (high - 0.001, high + 0.0005)) for c in (0, 0.002, 0.004)),
        )
    m.slide("cap", (1, 0, 0), m.number(0.5, 0.9) * long)
    if m.chance(0.3):
        m.add(BASE, ball((-0.6 * long, 0, high), (0.0015, 0.0015, 0.0006), 8))


def _swivel(m: Model) -> None:
    """A bent metal strip over the body that turns about a pin near its rear end."""
    long, wide, high = m.number(0.036, 0.046), m.number(0.017, 0.02), m.number(0.008, 0.0105)
    y, t, gap, rear = (-wide / 2, wide / 2), m.pick(0.0006, 0.001), m.pick(0.0002, 0.0005), m.number(0.009, 0.012)
    outline = rectangle((-long + wide / 2, 0), y).union(Point(-long + wide / 2, 0).buffer(wide / 2, quad_segs=6))
    _case(m, outline, (0, high))
    end = _plug(m, BASE, 0.0, high / 2)
    pin, tip = -long + rear, end + m.number(0.0014, 0.003)
    half = wide / 2 + m.pick(0.0, 0.0004)
    strip = rectangle((pin, tip), (-half, half)).union(Point(pin, 0).buffer(half, quad_segs=6))
    if m.chance(0.3):
        strip = strip.difference(rounded((pin + 0.012, tip - 0.012), (-0.3 * wide, 0.3 * wide), 0.002, 3))
    for z in ((-gap - t, -gap), (high + gap, high + gap + t)):
        m.add("cover", prism(strip, "z", z))
    m.add("cover", box((tip - t, tip), (-half, half), (-gap - t, high + gap + t)))
    r = m.number(0.0015, 0.003)
    for z in ((-gap - t - 0.0003, -gap), (high + gap, high + gap + t + 0.0003)):
        m.add(m.pick(BASE, "cover"), rod((pin, 0, z[0]), (pin, 0, z[1]), r, m.sections()))
    m.add(BASE, rod((pin, 0, -gap), (pin, 0, high + gap), 0.0012, 8))
    limit = m.pick("spin", "half", "half")
    if limit == "spin":
        m.spin("cover", (pin, 0, high / 2), (0, 0, 1))
    else:
        m.hinge("cover", (pin, 0, high / 2), (0, 0, m.pick(-1, 1)), m.pick(180, 180, 270))


def _sliding(m: Model) -> None:
    """A body out of which a thumb piece pushes the metal end."""
    long, wide, high = m.number(0.05, 0.062), m.number(0.017, 0.021), m.number(0.009, 0.011)
    x, y, z = (-long, 0.0), (-wide / 2, wide / 2), (0.0, high)
    outline = rounded(x, y, m.number(0.001, 0.006), 4)
    mid, travel = high / 2, 0.0135
    body = cut(prism(outline, "z", z), box((-long + 0.006, 1), (-0.0066, 0.0066), (mid - 0.0028, mid + 0.0028)))
    at = -0.5 * long - 0.004
    side, along, deep = m.pick("top", "edge"), (at, at + 0.009), 0.003
    room = (at - 0.0006, at + 0.009 + travel + 0.001)
    if side == "top":
        body = cut(body, box(room, (-deep, deep), (mid, 1)))
        m.add("connector", box(along, shrunk((-deep, deep), 0.0004), (mid + 0.001, high + 0.0012)))
        ribs = [
            box((at + c, at + c + 0.0008), (-deep + 0.0004, deep - 0.0004), (high + 0.001, high + 0.0018))
            for c in (0.001, 0.004, 0.007)
        ]
    else:
        body = cut(body, box(room, (0, 1), (mid - 0.0015, mid + 0.0015)))
        m.add("connector", box(along, (0.004, y[1] + 0.0015), shrunk((mid - 0.0015, mid + 0.0015), 0.0003)))
        ribs = []
    m.add(BASE, body)
    m.add("connector", box((at - 0.002, -0.0155), (-0.006, 0.006), (mid - 0.0018, mid + 0.0018)))
    m.add("connector", *(r for r in ribs if m.chance(0.8)))
    _plug(m, "connector", -0.0145, mid)
    m.slide("connector", (1, 0, 0), travel)
    if m.chance(0.4):
        m.add(
            BASE,
            prism(
                rounded((-long - 0.006, -long + 0.004), (-0.005, 0.005), 0.003, 3).difference(
                    Point(-long - 0.0025, 0).buffer(0.0018, quad_segs=3)
                ),
                "z",
                (0.3 * high, 0.7 * high),
            ),
        )


def _folding(m: Model) -> None:
    """A metal end that folds out of its handle like a blade of a knife."""
    long, wide, high, gap = m.number(0.045, 0.055), m.number(0.018, 0.022), m.number(0.009, 0.012), 0.0004
    z, y, pin = (0.0, high), (-wide / 2, wide / 2), m.number(-0.008, -0.006)
    body, t = rounded((-long, 0), y, 0.4 * wide, 5), m.number(0.0015, 0.0022)
    m.add(BASE, prism(body, "z", (0, t)), prism(body, "z", (high - t, high)))
    stop = body.intersection(rectangle((-long, pin - 0.032), (-1, 1)))
    m.add(BASE, prism(stop, "z", z))
    m.add(BASE, rod((pin, 0, -0.0004), (pin, 0, high + 0.0004), 0.002, m.sections()))
    inner, mid = shrunk(z, t + gap), high / 2
    blade = rectangle((pin - 0.016, pin), (-0.007, 0.007)).union(Point(pin, 0).buffer(0.007, quad_segs=5))
    m.add("connector", prism(blade, "z", inner))
    begin = len(m.pieces)
    _plug(m, "connector", -pin + 0.016, mid)
    for _, piece in m.pieces[begin:]:
        piece.vertices *= (-1, -1, 1)
    m.hinge("connector", (pin, 0, mid), (0, 0, m.pick(-1, 1)), 180)
    m.add(BASE, ball(vec(-0.7 * long, 0, high), (0.004, 0.004, 0.0004), 12))


def usb_stick(m: Model) -> None:
    """A memory stick: a cap drawn off, a cover that swivels, a connector that slides or folds out."""
    style = m.pick("cap", "cap", "swivel", "swivel", "slide", "fold")
    {"cap": _capped, "swivel": _swivel, "slide": _sliding, "fold": _folding}[style](m)
