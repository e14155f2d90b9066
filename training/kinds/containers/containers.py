"""Small things that open: flip bottle, spray bottle, pen case, binoculars."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe


def flip_bottle(m: Model) -> None:
    """A bottle with a flip cap on a screw collar, a straw or a bail; perhaps with a carrying loop."""
    r, high, n = m.number(0.025, 0.045), m.number(0.1, 0.25), m.pick(12, 16, 24)
    neck = m.number(0.35, 0.95) * r
    m.add(BASE, lathe([(0, 0), (0.95 * r, 0), (r, 0.01), (r, 0.75 * high), (neck, 0.92 * high), (neck, high), (0, high)], n))
    if m.chance(0.4):
        m.add(BASE, *(ring((0, 0, z), (0, 0, 1), r, 0.0015, n) for z in np.linspace(0.2, 0.6, m.pick(1, 3)) * high))
    c, tall = 1.1 * neck + 0.001, m.number(0.012, 0.025)
    screws = m.chance(0.5)
    collar = "collar" if screws else BASE
    z = high - 0.004 if screws else high
    m.add(
        collar,
        cut(rod((0, 0, z), (0, 0, z + tall), c, n), rod((0, 0, z - 1), (0, 0, high + 0.0005), 1.02 * neck, n))
        if screws
        else rod((0, 0, z), (0, 0, z + tall), c, n),
    )
    if screws:
        m.spin(collar, (0, 0, z), (0, 0, 1))
        turns = np.linspace(0, 2 * np.pi, 15)[:-1]
        m.add(
            collar,
            *(
                rod((c * np.cos(t), c * np.sin(t), z + 0.001), (c * np.cos(t), c * np.sin(t), z + tall - 0.001), 0.0008, 5)
                for t in turns
            ),
        )
    top = z + tall
    m.add(collar, rod((0, -0.3 * c, top), (0, -0.3 * c, top + 0.003), 0.2 * c, 10))
    form = m.pick("disc", "cup", "straw")
    if form == "straw":
        a = vec(0, 0.5 * c, top + 0.004)
        m.add(
            "straw",
            tube([a, a + vec(0, -1.3 * c, 0), a + vec(0, -1.6 * c, 0.004)], 0.004, 8),
            rod(a - vec(0.006, 0, 0), a + vec(0.006, 0, 0), 0.005, 10),
        )
        m.hinge("straw", a, (-1, 0, 0), 90, collar)
        m.add(collar, *(box((s * 0.007, s * 0.01), (a[1] - 0.005, a[1] + 0.005), (top, top + 0.009)) for s in (-1, 1)))
    else:
        deep = 0.004 if form == "disc" else m.number(0.01, 0.03)
        cap = rod((0, 0, top + 0.0005), (0, 0, top + 0.004 + deep), c, n)
        m.add("cap", cut(cap, rod((0, 0, 0), (0, 0, top + deep), 0.85 * c, n)))
        if m.chance(0.6):
            m.add("cap", box((-0.25 * c, 0.25 * c), (-1.15 * c, -0.9 * c), (top + 0.001, top + 0.004)))
        m.hinge("cap", (0, c, top), (-1, 0, 0), m.pick(110, 150), collar)
        if m.chance(0.5):
            m.add(m.pick("cap", collar), rod((-0.3 * c, c, top), (0.3 * c, c, top), 0.0018, 8))
    if m.chance(0.3):
        path = [
            (-c - 0.002, 0, top - 0.006),
            (-c - 0.002, 0, top + 0.03),
            (c + 0.002, 0, top + 0.03),
            (c + 0.002, 0, top - 0.006),
        ]
        m.add("loop", tube([(x, y + 0.9 * (h - top + 0.006), top - 0.006) for x, y, h in path], 0.002, 6))
        m.hinge("loop", (0, 0, top - 0.006), (1, 0, 0), 60, collar)


def spray_bottle(m: Model) -> None:
    """A bottle with a screw collar, a head with a trigger and a nozzle that turns."""
    wide, high, n = m.number(0.06, 0.1), m.number(0.14, 0.2), m.pick(12, 16, 24)
    if m.chance(0.5):
        m.add(
            BASE, lathe([(0, 0), (wide / 2, 0), (wide / 2, 0.6 * high), (0.3 * wide, 0.8 * high), (0.014, high), (0, high)], n)
        )
    else:
        m.add(BASE, prism(rounded((-wide / 2, wide / 2), (-0.35 * wide, 0.35 * wide), 0.2 * wide), "z", (0, 0.65 * high)))
        m.add(BASE, beam((0, 0, 0.65 * high), (0, 0, high), 0.9 * wide, 0.6 * wide, taper=0.35))
    turns = m.chance(0.5)
    m.add("collar" if turns else BASE, rod((0, 0, high - 0.004), (0, 0, high + 0.014), 0.016, n))
    if turns:
        m.spin("collar", (0, 0, high), (0, 0, 1))
    z = high + 0.014
    shape = [
        (0.03, z),
        (0.035, z + 0.03),
        (-0.035, z + 0.045),
        (-0.045, z + 0.042),
        (-0.045, z + 0.026),
        (-0.012, z + 0.02),
        (-0.01, z),
    ]
    m.add(BASE, prism(shape, "x", (-0.011, 0.011)))
    a = vec(0, -0.022, z + 0.022)
    line = LineString([(a[1], a[2]), (a[1] - 0.008, a[2] - 0.02), (a[1] - 0.004, a[2] - 0.045), (a[1] - 0.012, a[2] - 0.06)])
    for piece in [prism(line.buffer(0.003, quad_segs=2), "x", (-0.007, 0.007))]:
        m.add("trigger", piece)
    m.add(m.pick(BASE, "trigger"), rod(a - vec(0.012, 0, 0), a + vec(0.012, 0, 0), 0.002, 8))
    m.hinge("trigger", a, (1, 0, 0), m.pick(15, 22))
    tip = vec(0, -0.0455, z + 0.034)
    m.add(
        "nozzle",
        rod(tip, tip - vec(0, 0.012, 0), 0.008, n)
        if m.chance(0.5)
        else box((-0.008, 0.008), (tip[1] - 0.012, tip[1]), (tip[2] - 0.008, tip[2] + 0.008)),
    )
    m.add("nozzle", rod(tip - vec(0, 0.012, 0), tip - vec(0, 0.014, 0), 0.002, 8))
    m.spin("nozzle", tip, (0, -1, 0))
    if m.chance(0.5):
        m.add(BASE, rod((0.004, 0, 0.01), (0.002, 0, high), 0.0025, 6))
    if m.chance(0.5):
        m.add(BASE, box((-0.3 * wide, 0.3 * wide), (-0.36 * wide, -0.35 * wide), (0.15 * high, 0.5 * high)))


def pen_case(m: Model) -> None:
    """A long box with a hinged or a sliding lid, or a tray in a sleeve, with pens and partitions that stay."""
    long, wide, high, t = m.number(0.17, 0.24), m.number(0.05, 0.1), m.number(0.025, 0.05), m.number(0.0015, 0.004)
    outline = rounded((0, long), (0, wide), m.pick(0.002, 0.01))
    style = m.pick("hinged", "sliding", "sleeve")
    hollow = m.chance(0.75)
    body = prism(outline, "z", (0, high))
    if style == "sleeve":
        m.add(
            BASE,
            prism(
                rounded((0, wide), (0, high), 0.003).difference(rounded((t, wide - t), (t, high - t), 0.002)), "x", (0, long)
            ),
        )
        gap = abs(m.gap(wide))
        tray = box((0.004, long + 0.004), (t + gap, wide - t - gap), (t + gap, high - t - gap))
        m.add("tray", cut(tray, box((0.008, long), (2 * t + gap, wide - 2 * t - gap), (2.5 * t, 1))))
        m.slide("tray", (1, 0, 0), 0.85 * long)
        if m.chance(0.5):
            m.add("tray", rod((long + 0.004, wide / 2, high / 2), (long + 0.009, wide / 2, high / 2), 0.005, 12))
    else:
        m.add(BASE, cut(body, prism(outline.buffer(-t), "z", (t, 1))) if hollow else body)
        if style == "hinged":
            tall = m.pick(0.003, 0.4 * high)
            lid = prism(outline, "z", (high + 0.0003, high + tall))
            if tall > 0.005:
                lid = cut(lid, prism(outline.buffer(-t), "z", (0, high + tall - t)))
            m.add("lid", lid)
            m.hinge("lid", (long / 2, wide, high), (-1, 0, 0), m.pick(110, 170))
            m.add(
                m.pick(BASE, "lid"),
                *(rod((x, wide, high), (x + 0.1 * long, wide, high), 0.002, 10) for x in (0.15 * long, 0.75 * long)),
            )
            if m.chance(0.6):
                m.add("clasp", box((0.46 * long, 0.54 * long), (-0.003, -0.0003), (high - 0.008, high + tall)))
                m.hinge("clasp", (long / 2, -0.001, high + tall), (-1, 0, 0), 60, "lid")
        else:
            m.add("lid", box((0.002, long + 0.001), (0.7 * t, wide - 0.7 * t), (high + 0.0003, high + 0.004)))
            m.add(BASE, *(box((0, long), y, (high, high + 0.007)) for y in ((0, 0.6 * t), (wide - 0.6 * t, wide))))
            m.add(BASE, *(box((0, long), y, (high + 0.0045, high + 0.007)) for y in ((0, 2 * t), (wide - 2 * t, wide))))
            if m.chance(0.6):
                m.add("lid", rod((0.9 * long, wide / 2, high + 0.004), (0.9 * long, wide / 2, high + 0.0055), 0.008, 12))
            m.slide("lid", (1, 0, 0), 0.85 * long)
    if hollow or style == "sleeve":
        for k in range(m.pick(0, 2, 3)):
            y = (k + 1) * wide / 4
            owner = "tray" if style == "sleeve" else BASE
            m.add(
                owner,
                rod((0.012, y, t + 0.008), (0.85 * long, y, t + 0.008), 0.004, m.pick(6, 10)),
                ball((0.86 * long, y, t + 0.008), (0.008, 0.003, 0.003), 6),
            )
    m.add(BASE, *(box((x, x + 0.01), (y, y + 0.01), (-0.001, 0)) for x in (0.01, long - 0.02) for y in (0.01, wide - 0.02)))


def binoculars(m: Model) -> None:
    """Two tubes on a bridge: one side folds, eyecups turn, a focus wheel between them, caps that hinge down."""
    r, long, n = m.number(0.015, 0.028), m.number(0.09, 0.16), m.pick(12, 16, 24)
    apart, eye = 2.4 * r, 0.6 * r
    for s, part in ((-1, BASE), (1, "right")):
        x = s * apart / 2
        tube_ = lathe([(0, 0), (r, 0), (r, 0.35 * long), (0.75 * r, 0.6 * long), (eye, 0.8 * long), (eye, long), (0, long)], n)
        tube_.vertices = tube_.vertices[:, [0, 2, 1]] + (x, 0, 0)
        tube_.invert()
        m.add(part, tube_, ring((x, 0.001, 0), (0, 1, 0), 0.97 * r, 0.0015, n))
        for y in ((0.3, 0.42), (0.6, 0.72)):
            mid = 0.5 * (y[0] + y[1]) * long + (0.02 * long if s < 0 else -0.02 * long)
            m.add(part, box((0, x), (mid - 0.04 * long, mid + 0.035 * long), (-0.004, 0.004)))
        if m.chance(0.7):
            name = f"eyecup_{part}"
            m.add(
                name,
                cut(rod((x, long + 0.0005, 0), (x, long + 0.012, 0), 1.15 * eye, n), rod((x, 0, 0), (x, 1, 0), 0.9 * eye, n)),
            )
            m.spin(name, (x, long, 0), (0, 1, 0), part)
        if m.chance(0.4):
            name = f"cap_{part}"
            m.add(name, rod((x, -0.006, 0), (x, -0.001, 0), 1.05 * r, n))
            m.hinge(name, (x, -0.001, -1.05 * r), (1, 0, 0), 120, part)
    m.add(BASE, rod((0, 0.25 * long, 0), (0, 0.8 * long, 0), 0.006, n))
    m.hinge("right", (0, 0.5 * long, 0), (0, 1, 0), (-5, 25))
    focus = vec(0, 0.82 * long, 0)
    m.add("focus", rod(focus, focus + vec(0, 0.015, 0), 0.009, n))
    m.spin("focus", focus, (0, 1, 0))
    if m.chance(0.4):
        m.add(
            BASE,
            tube(
                [
                    (-apart / 2 - r, 0.6 * long, 0),
                    (-2 * r - apart / 2, long, -0.01),
                    (-apart, 1.6 * long, -0.01),
                    (0, 1.9 * long, -0.01),
                ],
                0.002,
                5,
            ),
        )
