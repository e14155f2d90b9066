"""Things that stand beside roads and pipes: barrier, traffic light, valve."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point

from training.kinds.electronics.controls import tilted
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang
from training.kinds.solids import ball, box, join, prism, rectangle, ring, rod, rounded, tube, vec


def parking_barrier(m: Model) -> None:
    """A cabinet with a boom that rises, perhaps with a skirt, a counterweight, a rest, a service door."""
    wide, deep, high = m.number(0.25, 0.4), m.number(0.25, 0.4), m.number(0.9, 1.2)
    m.add(BASE, prism(rounded((0, wide), (0, deep), m.pick(0.005, 0.05)), "z", (0, high)))
    m.add(
        BASE,
        box((-0.03, wide + 0.03), (-0.03, deep + 0.03), (high, high + 0.03))
        if m.chance(0.5)
        else ball((wide / 2, deep / 2, high), (0.06, 0.06, 0.08), 10),
    )
    long, z, r = m.number(2.0, 4.5), high - 0.15, m.number(0.03, 0.05)
    y = -0.06
    way, n = m.pick(-1, 1), m.sections()
    a = vec(wide / 2, y, z)
    m.add("boom", rod(a, a + vec(0, 0.06, 0), 0.06, n), rod(a, a + vec(0, -0.03, 0), 0.08, n))
    x = tuple(sorted((a[0] - way * m.number(0.1, 0.4), a[0] + way * long)))
    round_ = m.chance(0.4)
    m.add(
        "boom",
        rod((x[0], y - 0.02, z), (x[1], y - 0.02, z), r, n) if round_ else box(x, (y - 0.04, y), (z - 1.3 * r, z + 1.3 * r)),
    )
    if m.chance(0.5):
        m.add(
            "boom",
            *(
                box((a[0] + way * q - 0.15, a[0] + way * q + 0.15), (y - 0.06, y + 0.02), (z - 1.4 * r, z + 1.4 * r))
                for q in np.arange(0.6, long, 0.8)
            ),
        )
    if m.chance(0.3):
        m.add(
            "boom",
            *(
                rod((a[0] + way * q, y - 0.02, z), (a[0] + way * q, y - 0.02, 0.25), 0.008, 6)
                for q in np.linspace(0.5, long - 0.2, 12)
            ),
        )
        m.add("boom", rod((a[0] + way * 0.5, y - 0.02, 0.25), (a[0] + way * (long - 0.2), y - 0.02, 0.25), 0.012, 6))
    if m.chance(0.4):
        b = a - vec(way * 0.35, 0.02, 0)
        m.add("boom", box((b[0] - 0.12, b[0] + 0.12), (y - 0.08, y + 0.04), (z - 0.12, z + 0.12)))
    m.hinge("boom", a, (0, -way, 0), m.pick(80, 90))
    if m.chance(0.6):
        at = a[0] + way * (long - 0.1)
        m.add(
            BASE,
            box((at - 0.04, at + 0.04), (y - 0.06, y + 0.02), (0, z - 1.4 * r)),
            *(box((at - 0.04, at + 0.04), (s - 0.01, s + 0.01), (z - 0.1, z + 0.03)) for s in (y - 0.07, y + 0.04)),
        )
    if m.chance(0.6):
        span = (0.04, wide - 0.04), (deep + 0.001, deep + 0.015), (0.15, high - 0.2)
        m.add("service", box(*span), rod((wide - 0.07, deep + 0.015, 0.6), (wide - 0.07, deep + 0.025, 0.6), 0.015, 8))
        m.hinge("service", (0.04, deep + 0.015, 0.5), (0, 0, 1), 110)
    m.add(
        BASE,
        box((-0.05, wide + 0.05), (-0.05, deep + 0.05), (-0.02, 0)),
        rod((wide / 2, -0.012, 0.4), (wide / 2, 0.01, 0.4), 0.08, 16),
    )


def traffic_light(m: Model) -> None:
    """Heads of lamps with visors, each lamp in a hinged door, on a post or an arm; perhaps a walk light and a button."""
    tall, r, n = m.number(2.2, 3.5), m.number(0.09, 0.15), m.pick(12, 20, 28)
    m.add(BASE, rod((0, 0, 0), (0, 0, tall), 0.055, n), rod((0, 0, 0), (0, 0, 0.04), 0.16, n))
    m.add(
        BASE,
        *(rod((0.12 * c, 0.12 * s, 0.04), (0.12 * c, 0.12 * s, 0.07), 0.015, 6) for c, s in ((1, 0), (0, 1), (-1, 0), (0, -1))),
    )
    heads = [(0.0, tall - 6.6 * r)]
    if m.chance(0.4):
        arm = m.number(1.5, 3.0)
        m.add(BASE, rod((0, 0, tall - 0.1), (arm, 0, tall - 0.1), 0.04, n))
        heads.append((arm, tall - 6.6 * r))
    side, visors, one = m.pick("left", "right"), m.pick("tube", "half", "none"), m.chance(0.3)
    for i, (x, low) in enumerate(heads):
        lamps, w = 3 if i or m.chance(0.7) else 2, 1.25 * r
        z = (low, low + lamps * 2.2 * r)
        back = -0.06
        m.add(
            BASE, box((x - w, x + w), (back - 0.15, back), z), box((x - 0.03, x + 0.03), (back, 0.02), (low + 0.1, low + 0.18))
        )
        if m.chance(0.4):
            m.add(
                BASE,
                prism(
                    rounded((x - 1.8 * w, x + 1.8 * w), (z[0] - w, z[1] + w), 0.3 * w).difference(rectangle((x - w, x + w), z)),
                    "y",
                    (back - 0.08, back - 0.07),
                ),
            )
        for k in range(lamps):
            name = f"door_{i}" if one else f"door_{i}{k}"
            span = (low + k * 2.2 * r + 0.006, low + (k + 1) * 2.2 * r - 0.006)
            at = vec(x, back - 0.175, low + (k + 0.5) * 2.2 * r)
            m.add(
                name,
                box(
                    (x - w + 0.005, x + w - 0.005),
                    (back - 0.175, back - 0.152),
                    span if not one else (span[0] - 0.006, span[1] + 0.006),
                ),
                ball(at, (0.85 * r, 0.04, 0.85 * r), min(n, 14)),
            )
            if visors != "none":
                hood = prism(_hood(r, n, visors == "half"), "y", (at[1] - 1.6 * r, at[1]))
                m.add(name, hood.apply_translation((x, 0, at[2])))
            if k == 0 or not one:
                hang(m, name, (x - w, x + w), (back - 0.175, back - 0.152), z if one else span, side, OUT, 110)
    if m.chance(0.6):
        m.add(BASE, box((-0.06, 0.06), (-0.13, -0.05), (1.0, 1.2)), box((-0.04, 0.04), (-0.133, -0.13), (1.11, 1.18)))
        m.add("button", rod((0, -0.145, 1.06), (0, -0.12, 1.06), 0.025, n))
        m.slide("button", (0, 1, 0), 0.01)
    if m.chance(0.5):
        m.add("hatch", box((-0.03, 0.03), (-0.062, -0.05), (0.4, 0.7)))
        m.hinge("hatch", (-0.03, -0.062, 0.5), (0, 0, -1), 110)


def _hood(r: float, n: int, half: bool):
    found = Point(0, 0).buffer(r, quad_segs=n // 4).difference(Point(0, 0).buffer(0.93 * r, quad_segs=n // 4))
    return found.difference(rectangle((-9, 9), (-9, -0.1 * r if half else -0.75 * r)))


def valve(m: Model) -> None:
    """A pipe with flanges and a handwheel, a lever or a butterfly key; a gauge and bolts stay."""
    r, n, long = m.number(0.02, 0.06), m.pick(10, 16, 24), m.number(5, 8)
    x = long * r
    m.add(BASE, rod((-x, 0, 0), (x, 0, 0), r, n))
    for s in (-1, 1):
        for at in (s * 0.35 * x, s * x)[: m.pick(1, 2)]:
            m.add(BASE, rod((at - 0.2 * r, 0, 0), (at + 0.2 * r, 0, 0), 2 * r, n))
            m.add(
                BASE,
                *(
                    rod(
                        (at - 0.4 * r, 1.6 * r * np.cos(t), 1.6 * r * np.sin(t)),
                        (at + 0.4 * r, 1.6 * r * np.cos(t), 1.6 * r * np.sin(t)),
                        0.2 * r,
                        6,
                    )
                    for t in np.linspace(0, 2 * np.pi, 7)[:-1]
                ),
            )
    body = ball((0, 0, 0), (1.8 * r, 1.5 * r, 1.5 * r), n)
    neck, top = rod((0, 0, 0), (0, 0, 2.6 * r), 0.9 * r, n), vec(0, 0, 3.2 * r)
    m.add(
        BASE,
        *([join(body, neck)] if m.chance(0.5) else [body, neck]),
        rod((0, 0, 2.3 * r), (0, 0, 2.6 * r), 1.5 * r, m.pick(6, n)),
        rod((0, 0, 2.6 * r), top, 0.5 * r, n),
    )
    style = m.pick("wheel", "wheel", "lever", "wing")
    up = top + vec(0, 0, m.number(0.5, 2.0) * r)
    m.add("handle", rod(top - vec(0, 0, 0.3 * r), up, 0.25 * r, 8))
    if style == "wheel":
        big, spokes = m.number(2, 4) * r, m.pick(3, 4, 5)
        m.add(
            "handle", ring(up, (0, 0, 1), big, 0.2 * r, 28), rod(up - vec(0, 0, 0.2 * r), up + vec(0, 0, 0.3 * r), 0.5 * r, n)
        )
        m.add(
            "handle",
            *(rod(up, up + big * vec(np.cos(t), np.sin(t), 0), 0.15 * r, 6) for t in 2 * np.pi * np.arange(spokes) / spokes),
        )
        m.spin("handle", top, (0, 0, 1))
    else:
        reach = (m.number(4, 6) if style == "lever" else 1.8) * r
        m.add(
            "handle",
            box((-reach if style == "wing" else -0.5 * r, reach), (-0.35 * r, 0.35 * r), (up[2] - 0.15 * r, up[2] + 0.2 * r)),
        )
        m.hinge("handle", top, (0, 0, m.pick(-1, 1)), 90)
    if m.chance(0.5):
        a = vec(-0.65 * x, 0, r)
        m.add(
            BASE,
            rod(a, a + vec(0, 0, 1.5 * r), 0.3 * r, 8),
            rod(a + vec(0, -0.4 * r, 2.5 * r), a + vec(0, 0.4 * r, 2.5 * r), 1.2 * r, n),
        )
    if m.chance(0.3):
        m.add(BASE, tube([(x, 0, 0), (x + 2 * r, 0, 0), (x + 2 * r, 0, -4 * r)], r, n))
    if m.chance(0.3):
        tilted(m, m.pick(30, 90), (0, 0, 0))
