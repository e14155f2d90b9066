"""Skateboards and tricycles."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, loft, prism, rod, tube, vec
from training.kinds.wheels import beam, wheel_maker


def skateboard(m: Model) -> None:
    """A deck with kicked ends on two trucks that lean on their bushings, and four wheels; long, short or cruiser."""
    style = m.pick("popsicle", "popsicle", "long", "cruiser", "flat")
    long = {"long": m.number(0.95, 1.15), "cruiser": m.number(0.55, 0.65)}.get(style, m.number(0.76, 0.84))
    half, r = m.number(0.095, 0.115), m.number(0.024, 0.038)
    top, n = 2 * r + m.number(0.045, 0.07), m.pick(12, 20, 30)
    t = np.linspace(0, 2 * np.pi, 4 * n, endpoint=False)
    power = m.number(2.5, 5.0)
    nose = 0.35 if style == "cruiser" else 1.0
    x = half * np.sign(np.cos(t)) * np.abs(np.cos(t)) ** (2 / power)
    y = long / 2 * np.sign(np.sin(t)) * np.abs(np.sin(t)) ** (2 / power)
    flat, kick = 0.29 * long, 0.0 if style == "flat" else m.number(0.18, 0.4)
    rise = kick * np.maximum(np.abs(y) - flat, 0) * np.where(y < 0, nose, 1.0)
    dish, layers = m.pick(0.0, 0.006) * (x / half) ** 2, []
    for scale, z in ((0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (1.0, 0.011), (0.5, 0.011), (0.0, 0.011)):
        h = kick * np.maximum(scale * np.abs(y) - flat, 0) * np.where(y < 0, nose, 1.0) if scale < 1 else rise
        layers.append(np.c_[scale * x, scale * y, top + z + h + scale**2 * dish])
    m.add(BASE, loft(np.stack(layers)))
    make = wheel_maker(m, ("disc", "lathed", "disc", "tyre"), 0.0)
    at, wide = 0.5 * long * m.number(0.5, 0.58), m.number(0.8, 0.95) * half
    for k, s in enumerate((-1, 1)):
        _truck(m, f"truck_{k}", s, s * at, top, r, wide)
        for i, e in enumerate((-1, 1)):
            make(
                f"wheel_{k}{i}",
                (e * wide, s * at, r),
                (e, 0, 0),
                r,
                m.number(0.03, 0.034) if style != "long" else 0.045,
                f"truck_{k}",
            )
    for s in (-1, 1):
        m.add(
            BASE,
            *(
                rod((a, s * at + b, top + 0.008), (a, s * at + b, top + 0.0125), 0.004, 6)
                for a in (-0.02, 0.02)
                for b in (-0.03, 0.03)
            ),
        )
    if m.chance(0.3):
        m.add(
            BASE,
            *(
                rod((e * 0.6 * half, -0.18 * long, top - 0.006), (e * 0.6 * half, 0.18 * long, top - 0.006), 0.006, 8)
                for e in (-1, 1)
            ),
        )


def _truck(m: Model, part: str, s: int, y: float, top: float, r: float, wide: float) -> None:
    """The plate under the deck, and the hanger that leans about its slanted kingpin axis."""
    m.add(BASE, box((-0.028, 0.028), (y - 0.042, y + 0.042), (top - 0.012, top + 0.001)))
    m.add(BASE, beam((0, y - s * 0.035, top - 0.01), (0, y - s * 0.03, r + 0.012), 0.022, 0.02))
    low, high = vec(0, y - s * 0.035, r + 0.01), vec(0, y + s * 0.02, top - 0.012)
    m.add(
        part,
        prism(
            Polygon(
                [
                    (-0.75 * wide, r - 0.007),
                    (0.75 * wide, r - 0.007),
                    (0.75 * wide, r + 0.007),
                    (0.018, r + 0.022),
                    (-0.018, r + 0.022),
                    (-0.75 * wide, r + 0.007),
                ]
            ),
            "y",
            (y - 0.01, y + 0.01),
        ),
    )
    m.add(
        part,
        rod((-wide - 0.022, y, r), (wide + 0.022, y, r), 0.004, 8),
        beam((0, y, r + 0.008), low + vec(0, s * 0.012, 0), 0.018, 0.012),
    )
    m.add(part, rod((0, y - s * 0.004, r + 0.012), (0, y + s * 0.004, top - 0.02), 0.012, 10))
    m.hinge(part, (0, y, r + 0.01), high - low, (-20, 20))


def _fork(m: Model, axle: Point, radius: float, head: np.ndarray, grip: float) -> None:
    """A steered fork round the front wheel with its stem, handlebar, grips; head: its upper end."""
    a = np.asarray(axle, float)
    way = (head - a) / np.linalg.norm(head - a)
    crown, w = a + way * (radius + 0.03), m.number(0.035, 0.05)
    for s in (-1, 1):
        m.add("fork", beam(a + vec(s * w, 0, 0) - 0.01 * way, crown + vec(s * w, 0, 0), 0.012, 0.028))
    m.add("fork", box((-w - 0.008, w + 0.008), (crown[1] - 0.02, crown[1] + 0.02), (crown[2] - 0.012, crown[2] + 0.012)))
    m.add("fork", rod(crown, head, 0.014, 10))
    back, rise = m.number(0.02, 0.1), m.number(0.0, 0.1)
    path = [
        head + vec(s * x, b, z)
        for s, x, b, z in (
            (-1, grip, back, rise),
            (-1, 0.4 * grip, 0.3 * back, rise),
            (-1, 0.12 * grip, 0, 0),
            (1, 0.12 * grip, 0, 0),
            (1, 0.4 * grip, 0.3 * back, rise),
            (1, grip, back, rise),
        )
    ]
    m.add("fork", tube(path, 0.011, 8))
    for p, q in ((path[0], path[1]), (path[-1], path[-2])):
        m.add("fork", rod(p, p + 0.4 * (q - p), 0.017, 10), *([ball(p, (0.02, 0.02, 0.02), 8)] if m.chance(0.4) else []))
    if m.chance(0.4):
        m.add("fork", ball(head + vec(0.4 * grip, 0.02, rise + 0.03), (0.03, 0.03, 0.025), 10))
    m.hinge("fork", a, way, (-50, 50))
    if m.chance(0.4):
        guard = LineString(
            [(a[1] + (radius + 0.02) * np.cos(t), a[2] + (radius + 0.02) * np.sin(t)) for t in np.linspace(0.7, 2.2, 10)]
        ).buffer(0.006)
        m.add("fork", prism(guard, "x", (-0.03, 0.03)))


def _tricycle_frame(m: Model, back: float, long: float, mid: np.ndarray, seat: np.ndarray, style: str) -> None:
    """The frame behind the head, the seat and its back."""
    if style == "two":
        m.add(
            BASE,
            *(tube([mid, vec(s * 0.05, 0.4 * long, seat[2] - 0.06), vec(s * 0.12, long, back)], 0.012, 8) for s in (-1, 1)),
        )
    else:
        m.add(
            BASE,
            tube(
                [mid, vec(0, 0.3 * long, seat[2] - 0.1 if style == "one" else back + 0.05), vec(0, long + 0.01, back + 0.005)],
                m.number(0.014, 0.022),
                10,
            ),
        )
    post = vec(0, seat[1], back) if style == "step" else vec(0, seat[1], seat[2] - 0.14)
    m.add(
        BASE,
        rod(post, seat, 0.014, 8),
        prism(
            Polygon(
                [
                    (-0.04, seat[1] - 0.15),
                    (0.04, seat[1] - 0.15),
                    (0.11, seat[1] + 0.03),
                    (0.1, seat[1] + 0.11),
                    (-0.1, seat[1] + 0.11),
                    (-0.11, seat[1] + 0.03),
                ]
            ).buffer(0.012),
            "z",
            (seat[2] - 0.005, seat[2] + 0.03),
        ),
    )
    if m.chance(0.5):
        m.add(BASE, box((-0.1, 0.1), (seat[1] + 0.1, seat[1] + 0.125), (seat[2], seat[2] + 0.17)))


def tricycle(m: Model) -> None:
    """A child's tricycle: steered front wheel with pedals, two wheels behind, a seat; push bar, step, basket or tipping box."""
    r, back = m.number(0.13, 0.19), m.number(0.1, 0.14)
    long, half, y0 = m.number(0.42, 0.56), m.number(0.19, 0.25), 0.0
    make = wheel_maker(m, ("tyre", "disc", "spoked", "lathed", "rim"), 0.15)
    head, axle = vec(0, m.number(0.12, 0.18), m.number(0.48, 0.6)), vec(0, y0, r)
    _fork(m, axle, r, head, m.number(0.17, 0.22))
    make("front", axle, (1, 0, 0), r, m.number(0.03, 0.045), "fork")
    arm = m.number(0.07, 0.095)
    m.add("front", rod((-0.085, 0, r), (0.085, 0, r), 0.009, 8))
    for s in (-1, 1):
        pin = vec(s * 0.08, s * arm * 0.8, r + s * arm * 0.6)
        m.add("front", beam((s * 0.08, 0, r), pin, 0.014, 0.018), rod(pin, pin + vec(s * 0.1, 0, 0), 0.006, 6))
        part = f"pedal_{'lr'[s > 0]}"
        m.add(
            part, box((pin[0] + s * 0.02, pin[0] + s * 0.1), (pin[1] - 0.035, pin[1] + 0.035), (pin[2] - 0.011, pin[2] + 0.011))
        )
        m.spin(part, pin, (1, 0, 0), "front")
    for k, s in enumerate((-1, 1)):
        make(f"rear_{k}", (s * half, long, back), (s, 0, 0), back, 0.036)
    m.add(BASE, rod((-half - 0.02, long, back), (half + 0.02, long, back), 0.011, 8))
    way = (head - axle) / np.linalg.norm(head - axle)
    low, high = axle + way * (r + 0.07), axle + way * (r + 0.16)
    m.add(BASE, rod(low, high, 0.024, 12))
    style, mid, seat = (
        m.pick("one", "two", "step"),
        (low + high) / 2 + vec(0, 0.02, 0),
        vec(0, 0.62 * long, m.number(0.3, 0.36)),
    )
    _tricycle_frame(m, back, long, mid, seat, style)
    _tricycle_rear(m, half, long, back, seat, style)


def _tricycle_rear(m: Model, half: float, long: float, back: float, seat: np.ndarray, style: str) -> None:
    """What a tricycle carries behind: a step, a box that tips, a push bar."""
    what = m.pick("step", "box", "none") if style != "step" else "step"
    inner = half - 0.04
    if what == "step":
        m.add(BASE, box((-inner, inner), (long - 0.07, long + 0.09), (back + 0.008, back + 0.025)))
    elif what == "box":
        z, y = back + 0.03, (long - 0.03, long + 0.2)
        m.add(
            "box",
            box((-inner, inner), y, (z, z + 0.012)),
            *(box((s * inner, s * (inner - 0.012)), y, (z, z + 0.12)) for s in (-1, 1)),
        )
        m.add("box", *(box((-inner, inner), (c, c + 0.012), (z, z + 0.12)) for c in (y[0], y[1] - 0.012)))
        m.add(BASE, *(box((s * 0.08, s * 0.12), (long - 0.02, long + 0.08), (back - 0.005, z)) for s in (-1, 1)))
        m.hinge("box", (0, long + 0.08, z), (-1, 0, 0), m.pick(50, 70))
    if m.chance(0.4):
        top = vec(0, long + 0.35, 0.95)
        m.add(
            BASE,
            rod((0, seat[1] + 0.1, seat[2] - 0.02), top, 0.012, 8),
            rod((0, seat[1], seat[2] - 0.02), (0, seat[1] + 0.12, seat[2] - 0.02), 0.012, 8),
            rod(top - (0.12, 0, 0), top + vec(0.12, 0, 0), 0.015, 10),
        )
