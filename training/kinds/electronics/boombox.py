"""Boomboxes, and the doors of cassette wells."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot
from trimesh import Trimesh

from training.kinds.electronics.controls import knob
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, cable
from training.kinds.model import BASE, Model
from training.kinds.panels import middle, sheet
from training.kinds.solids import Point, Span, box, cut, prism, rectangle, ring, rod, rounded, tube, vec


def _speaker(m: Model, at: Point, radius: float) -> list[Trimesh]:
    """A loudspeaker in a face to the front: a ring with a cone, a grille of bars, or a plain round plate."""
    x, y, z = (float(v) for v in at)
    style, n = m.pick("cone", "grille", "plate"), m.sections() + 8
    solids = [ring(at, (0, 1, 0), radius, 0.07 * radius, n)]
    if style == "plate":
        return [*solids, rod(at, (x, y - 0.05 * radius, z), radius, n)]
    if style == "cone":
        return [
            *solids,
            rod(at, (x, y - 0.02 * radius, z), 0.9 * radius, n),
            rod(at, (x, y - 0.15 * radius, z), 0.3 * radius, n),
        ]
    for c in np.linspace(-0.8, 0.8, 9):
        half = radius * (1 - c * c) ** 0.5
        solids.append(box((x - half, x + half), (y - 0.05 * radius, y), (z + c * radius - 0.002, z + c * radius + 0.002)))
    return solids


def cassette_door(m: Model, part: str, x: Span, y: float, z: Span, thick: float) -> Trimesh:
    """A door that tips forward at its foot with the holder of the cassette behind; returns the room it needs in the body."""
    depth, style = 0.016, m.pick("window", "window", "plain", "clear", "frame")
    gap = 0.0012
    a, b, plate = shrunk(x, gap), shrunk(z, gap), (y - thick, y)
    hole = rectangle(a, b).difference(rectangle(shrunk(a, 0.022), (b[0] + 0.022, b[1] - 0.014)))
    if style in ("window", "frame"):
        m.add(part, prism(hole, "y", plate))
        m.add(part, sheet(shrunk(a, 0.02), y - 0.3 * thick, (b[0] + 0.02, b[1] - 0.012)))
    else:
        m.add(part, prism(rounded(a, b, 0.004), "y", plate))
    if style == "plain":
        m.add(part, box(shrunk(a, 0.03), (y - thick - 0.001, y - thick), (b[0] + 0.025, b[0] + 0.03)))
    if style != "frame":  # the holder, or the cassette in it
        m.add(part, *(box((c, c + 0.002), (y, y + 0.012), (b[0] + 0.002, b[0] + 0.02)) for c in (a[0] + 0.002, a[1] - 0.004)))
        if m.chance(0.6):
            tape = (middle(a) - 0.049, middle(a) + 0.049), (b[0] + 0.003, min(b[0] + 0.064, b[1] - 0.004))
            m.add(part, box(tape[0], (y + 0.002, y + 0.011), tape[1]))
    else:
        ends = [vec(middle(a) + s * 0.021, y + 0.004, middle(b)) for s in (-1, 1)]
        m.add(BASE, *(rod(e, e + vec(0, depth - 0.004, 0), 0.004, 6) for e in ends))
    m.hinge(part, (middle(x), y - m.pick(0.0, 0.5) * thick, b[0]), (1, 0, 0), m.number(25, 50))
    return box(x, (y - 1, y + depth), z)


def boombox(m: Model) -> None:
    """A carried radio with loudspeakers, one cassette door or two, or a round lid on top; a handle, an aerial, keys, knobs."""
    wide, deep, high = m.number(0.38, 0.68), m.number(0.12, 0.2), m.number(0.2, 0.3)
    style = m.pick("square", "round", "three")
    x, z, y = (-wide / 2, wide / 2), (0.008, high), 0.0
    r = min(0.4 * high, 0.5 * (wide / 2 - 0.135))
    holes, doors = [], m.pick(0, 1, 1, 2, 2) if wide > 0.55 else m.pick(0, 1, 1)
    low = z[0] + m.number(0.02, 0.05)
    for k in range(doors):
        c = (k - (doors - 1) / 2) * 0.125
        holes.append(cassette_door(m, f"door_{k}", (c - 0.058, c + 0.058), y, (low, low + 0.08), m.number(0.003, 0.008)))
    r = min(r, (wide / 2 - 0.065 * max(doors, 1) - 0.01) / 2)
    if style == "three":
        inner = wide / 2 - 2.15 * r
        body = box((-inner, inner), (y, deep), z)
        m.add(BASE, *(box((s * inner, s * wide / 2), (y - 0.01, 0.85 * deep), (z[0], 0.97 * high)) for s in (-1, 1)))
    else:
        body = prism(rounded(x, z, 0.01 if style == "square" else 0.3 * high, 8), "y", (y, deep))
    m.add(BASE, cut(body, *holes) if holes else body)
    m.add(BASE, *(box((s * 0.3 * wide - 0.02, s * 0.3 * wide + 0.02), (0.02, deep - 0.02), (0, z[0] + 0.002)) for s in (-1, 1)))
    front = y - 0.01 if style == "three" else y
    for s in (-1, 1):
        m.add(BASE, *_speaker(m, (s * (wide / 2 - r - 0.012), front, max(0.45 * high, r + 0.015)), 0.92 * r))
    _tuner(m, (-wide / 2 + 2 * r + 0.03, wide / 2 - 2 * r - 0.03), (low + 0.09 if doors else 0.3 * high, high - 0.015), y)
    flat = 0.5 * wide - (0.02 if style == "square" else 0.32 * high) if style != "three" else wide / 2 - 2.2 * r
    _top(m, flat, deep, high, not doors)
    _carrying(m, wide, deep, high, style)


def _tuner(m: Model, x: Span, z: Span, y: float) -> None:
    """The dial of the radio above the doors with knobs, sliders or a display."""
    wide, tall = x[1] - x[0], z[1] - z[0]
    if tall < 0.03 or wide < 0.05:
        return
    m.add(BASE, box(shrunk(x, 0.08 * wide), (y - 0.002, y), (z[0] + 0.6 * tall, z[1])))
    what, n, b = m.pick("knobs", "sliders", "buttons"), m.pick(2, 3, 4), z[0] + 0.25 * tall
    for k in range(n):
        a = x[0] + (k + 0.5) * wide / n
        if what == "knobs":
            knob(m, f"knob_{k}", (a, y, b), (0, -1, 0), min(0.012, 0.2 * tall, 0.3 * wide / n))
        elif what == "sliders":
            span = (z[0] + 0.02 * tall, z[0] + 0.5 * tall)
            m.add(BASE, box((a - 0.001, a + 0.001), (y - 0.001, y), span))
            m.add(
                f"slider_{k}",
                box((a - 0.005, a + 0.005), (y - 0.009, y - 0.0005), (middle(span) - 0.003, middle(span) + 0.003)),
            )
            m.slide(f"slider_{k}", (0, 0, 1), (-0.17 * tall, 0.17 * tall))
        else:
            button(m, f"button_{k}", (a, y, b), (0, -1, 0), 0.01)


def _top(m: Model, half: float, deep: float, high: float, disc: bool) -> None:
    """What lies on top: a round or square lid over a disc, a row of keys, knobs."""
    if disc or (m.chance(0.3) and deep > 0.14):
        r = min(0.068, 0.42 * deep, 0.8 * half)
        at, n = vec(0, deep / 2, high), m.pick(16, 24)
        plate = Dot(0, deep / 2).buffer(r, quad_segs=n // 4)
        plate = plate if m.chance(0.6) else rectangle((-r, r), (deep / 2 - r, deep / 2 + r))
        m.add("lid", prism(plate, "z", (high + 0.001, high + 0.01)))
        m.add(BASE, rod(at, at + vec(0, 0, 0.001), 0.9 * r, n))
        m.hinge("lid", (0, deep / 2 + r, high + 0.001), (-1, 0, 0), m.number(60, 85))
        keys = (-half, -r - 0.01)
    else:
        keys = shrunk((-half, half), 0.3 * half)
    n = int(min(m.pick(4, 5, 6, 7), (keys[1] - keys[0]) / 0.016))
    for k in range(n):
        a = keys[0] + k * 0.02 if n * 0.02 < keys[1] - keys[0] else keys[0] + k * (keys[1] - keys[0]) / n
        m.add(f"key_{k}", box((a, a + 0.015), (0.002, 0.025), (high - 0.001, high + m.pick(0.006, 0.01))))
        m.slide(f"key_{k}", (0, 0, -1), 0.005)
    if keys[1] < 0 and half > 0.13:
        knob(m, "volume", (half - 0.03, 0.3 * deep, high), (0, 0, 1), m.number(0.012, 0.022))


def _carrying(m: Model, wide: float, deep: float, high: float, style: str) -> None:
    """The handle (swinging, fixed or none), the aerial and the cover of the batteries."""
    pivot, s = vec(0, deep / 2, (0.7 if style == "round" else m.number(0.8, 0.9)) * high), m.pick(0.006, 0.01)
    reach = float(np.hypot(deep / 2, high - pivot[2])) + m.number(0.015, 0.04)
    a = wide / 2 + s * 0.9
    how = m.pick("swing", "swing", "swing", "fixed", "none")
    if how != "none":
        part, up = ("handle" if how == "swing" else BASE), pivot + vec(0, 0, reach)
        c, side = vec(a, 0, 0), vec(a - s, 0, 0)
        if m.chance(0.5):
            m.add(part, tube([pivot - c, up - c, up + c, pivot + c], 0.9 * s, 8))
        else:
            arms = [
                box((t * a - s, t * a + s), (deep / 2 - 1.3 * s, deep / 2 + 1.3 * s), (pivot[2] - s, up[2])) for t in (-1, 1)
            ]
            m.add(part, *arms, box((-a - s, a + s), (deep / 2 - 1.6 * s, deep / 2 + 1.6 * s), (up[2] - s, up[2] + s)))
        m.add(part, *(rod(pivot + t * side * 0.98, pivot + t * (c + vec(1.2 * s, 0, 0)), 1.8 * s, 12) for t in (-1, 1)))
        if how == "swing":
            m.hinge(part, pivot, (-1, 0, 0), m.pick(90, 95, (-90, 90)))
    if m.chance(0.75):
        t = m.pick(-1, 1)
        root, length = vec(t * 0.35 * wide, deep + 0.007, high - 0.02), m.number(0.4, 0.66) * wide
        if style == "round":
            root[2] -= 0.02
        m.add("aerial", *(rod(root, root - vec(t * f * length, 0, 0), r, 8)
                          for f, r in ((0.5, 0.004), (0.8, 0.003), (1.0, 0.002))))  # fmt: skip
        m.add("aerial", rod(root - vec(0, 0.007, 0), root + vec(0, 0.006, 0), 0.007, 10))
        m.hinge("aerial", root, (0, t, 0), m.pick(90, 120))
    if m.chance(0.4):
        m.add("battery_cover", box((-0.09, 0.09), (deep, deep + 0.003), (0.3 * high, 0.6 * high)))
        m.slide("battery_cover", (0, 0, -1), 0.05)
    elif m.chance(0.4):
        cable(m, (0.1, deep, 0.3 * high), 0.2)
