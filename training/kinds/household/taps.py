"""Soap dispensers, taps, and showers."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_trims import button, dial, fluted, lathe, lever
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, join, prism, rod, rounded, tube, vec


def soap_dispenser(m: Model) -> None:
    """A bottle whose pump is pressed and turned, or a box on the wall with a lever, a button, and a lid."""
    n = m.pick(8, 12, 16, 24, 32)
    if m.chance(0.65):
        r, high = m.number(0.025, 0.045), m.number(0.1, 0.18)
        square = m.chance(0.3)
        profile = [(r, 0), (m.number(0.85, 1.1) * r, 0.6 * high), (0.8 * r, 0.85 * high), (0.014, high)]
        bottle = prism(rounded((-r, r), (-r, r), 0.3 * r), "z", (0, high)) if square else lathe(profile, n)
        m.add(BASE, bottle)
        if m.chance(0.4):
            m.add(BASE, box((-0.6 * r, 0.6 * r), (-r - 0.001, -0.5 * r), (0.2 * high, 0.6 * high)))
        shape = (high - 0.004, high + 0.018)
        ribbed = m.chance(0.5)  # then it is screwed
        m.add(
            "collar" if ribbed else BASE,
            fluted(0.015, 12, shape) if ribbed else rod((0, 0, shape[0]), (0, 0, shape[1]), 0.015, n),
        )
        if ribbed:
            m.spin("collar", (0, 0, high), (0, 0, 1))
        top = high + m.number(0.035, 0.05)
        long, width = m.number(0.035, 0.06), 0.005
        m.add("pump", rod((0, 0, high + 0.01), (0, 0, top), 0.004, 8), rod((0, 0, top), (0, 0, top + 0.01), 0.012, n))
        nozzle = [(0, 0, top + 0.005), (0, -0.8 * long, top + 0.006), (0, -long, top - 0.006)]
        m.add("pump", tube(nozzle, width, 8) if m.chance(0.6) else box((-width, width), (-long, 0), (top + 0.002, top + 0.01)))
        m.slide("pump", (0, 0, -1), m.number(0.012, 0.02))
        return
    wide, deep, high, z = m.number(0.08, 0.13), m.number(0.08, 0.12), m.number(0.16, 0.28), 1.0
    style, split = m.pick("lever", "button", "sensor"), z + high * m.number(0.2, 0.35)
    back = box((0, wide), (deep - 0.012, deep), (z, z + high))
    cover, outline = m.pick("cover", "cover", BASE), rounded((0, wide), (split, z + high), m.pick(0.004, 0.02))
    if cover == BASE:
        m.add(BASE, join(back, prism(outline, "y", (0, deep - 0.01))))
    else:
        m.add(BASE, back)
        m.add(cover, prism(outline, "y", (0, deep - 0.013)))
        m.hinge("cover", (wide / 2, deep - 0.013, split), (1, 0, 0), m.pick(90, 110))
    m.add(cover, box((0.4 * wide, 0.6 * wide), (-0.001, 0.001), (split + 0.2 * high, z + 0.8 * high)))
    m.add(BASE, rod((wide / 2, 0.5 * deep, split - 0.02), (wide / 2, 0.5 * deep, split), 0.008, 8))
    if style == "lever":
        m.add(
            "lever",
            prism(rounded((0.05 * wide, 0.95 * wide), (z, split - 0.002), 0.01), "y", (-0.004, m.pick(0.006, 0.6 * deep))),
        )
        m.hinge("lever", (wide / 2, 0.2 * deep, split), (-1, 0, 0), 15)
    else:
        m.add(BASE, box((0.1 * wide, 0.9 * wide), (0.01, deep - 0.012), (z, split - 0.001)))
        if style == "button":
            button(m, "button", (wide / 2, 0.01, (z + split) / 2), (0, -1, 0), 0.03)
    if m.chance(0.4):
        m.add(
            BASE,
            prism(rounded((0.0, wide), (0.0, deep), 0.02), "z", (z - 0.06, z - 0.05)),
            box((0.4 * wide, 0.6 * wide), (deep - 0.01, deep), (z - 0.06, z)),
        )


def _handle(m: Model, part: str, at: np.ndarray, style: str, n: int, outward: int) -> None:
    """What a valve is turned by, standing on a point: a cross, a lever to one side, or a knob."""
    top = at + vec(0, 0, 0.03)
    m.add(part, rod(at, top, 0.011, n))
    if style == "cross":
        for a, b in ((vec(0.03, 0, 0), vec(-0.03, 0, 0)), (vec(0, 0.03, 0), vec(0, -0.03, 0))):
            m.add(part, rod(top + a, top + b, 0.006, 8))
    elif style == "lever":
        m.add(part, box(*np.c_[top + vec(-0.008, -0.008, -0.005), top + vec(0.008, 0.008, 0.005)]))
        lever(m, part, top, top + vec(outward * 0.06, 0, m.pick(0.0, 0.01)), 0.009)
    else:
        m.add(part, fluted(0.022, m.pick(5, 8, 12), (0.0, 0.025), top - vec(0, 0, 0.01)))


def tap(m: Model) -> None:
    """A mixer with one lever, or two valves beside a spout; the spout may swivel, a rod lifts the waste."""
    n, r, tall, reach = m.pick(10, 16, 24), m.number(0.016, 0.026), m.number(0.06, 0.3), m.number(0.1, 0.22)
    two, spout = m.chance(0.4), m.pick("spout", "spout", BASE)
    m.add(BASE, rod((0, 0, 0), (0, 0, 0.008), 1.4 * r, n), rod((0, 0, 0), (0, 0, 0.05), r, n))
    z, style = 0.05 + tall, m.pick("arc", "square", "straight", "slab")
    if style == "arc":
        t = np.linspace(0, np.pi, m.pick(6, 10, 16))
        path = [
            (0, 0, 0.05),
            *((0, -reach / 2 * (1 - np.cos(a)), z + reach / 2 * np.sin(a)) for a in t),
            (0, -reach, z - 0.3 * tall),
        ]
    elif style == "square":
        path = [(0, 0, 0.05), (0, 0, z), (0, -reach, z), (0, -reach, z - 0.03)]
    else:
        z = 0.05 + min(tall, 0.08)
        path = [(0, 0, 0.05), (0, 0, z), (0, -reach, z + (0.02 if style == "straight" else 0.0))]
    if style == "slab":
        m.add(spout, rod((0, 0, 0.0502), (0, 0, z), 0.9 * r, n), box((-0.8 * r, 0.8 * r), (-reach, 0), (z - 0.014, z)))
        m.add(spout, rod((0, -reach + 0.014, z - 0.02), (0, -reach + 0.014, z - 0.01), 0.008, 8))
    else:
        m.add(spout, tube(path, 0.6 * r, m.pick(8, 12)))
        if spout != BASE:  # the collar that turns
            m.add(spout, rod((0, 0, 0.0502), (0, 0, 0.07), 0.95 * r, n))
    if spout != BASE:
        m.hinge("spout", (0, 0, 0.05), (0, 0, m.pick(-1, 1)), (-90, 90)) if m.chance(0.7) else m.spin(
            "spout", (0, 0, 0.05), (0, 0, 1)
        )
    if two:
        apart, grip, joined = m.number(0.08, 0.12), m.pick("cross", "lever", "knob"), m.chance(0.5)
        for s, name in ((-1, "hot"), (1, "cold")):
            at = vec(s * apart, 0, 0.045)
            m.add(BASE, lathe([(1.3 * r, 0), (0.9 * r, 0.02), (0.8 * r, 0.045)], n, at * [1, 1, 0]))
            _handle(m, f"{name}_handle", at, grip, n, s)
            m.hinge(f"{name}_handle", at, (0, 0, s), m.pick(90, 180)) if m.chance(0.6) else m.spin(
                f"{name}_handle", at, (0, 0, 1)
            )
        if joined:
            m.add(BASE, rod((-apart, 0, 0.025), (apart, 0, 0.025), 0.6 * r, n))
    elif m.chance(0.6):  # a lever at the side of the body
        s = m.pick(-1, 1)
        at = vec(s * r, 0, 0.03)
        m.add(BASE, rod((0, 0, 0.03), at + vec(s * 0.014, 0, 0), 0.6 * r, n))
        m.add("lever", rod(at + vec(s * 0.0145, 0, 0), at + vec(s * 0.035, 0, 0), 0.65 * r, n))
        tip = at + vec(s * 0.025, 0, 0)
        lever(m, "lever", tip, tip + m.pick(vec(0, 0, 0.09), vec(s * 0.02, 0, 0.08), vec(0, -0.07, 0.02)), 0.008)
        m.hinge("lever", at, (s, 0, 0), (-30, 60) if m.chance(0.5) else 60)
    else:  # a lever on the top: it tilts on a cap that turns
        on = spout if style == "slab" and spout != BASE and m.chance(0.5) else BASE
        at = vec(0, 0, z) if style == "slab" else vec(0, 1.9 * r, 0.04)
        if style != "slab":
            m.add(BASE, rod((0, 1.9 * r, 0), at, 0.8 * r, n))
        m.add("cap", lathe([(0.85 * r, 0.001), (0.85 * r, 0.016), (0.4 * r, 0.026)], n, at))
        m.hinge("cap", at, (0, 0, 1), (-45, 45), on)
        tip = at + vec(0, 0, 0.018)
        lever(m, "lever", tip, tip + vec(0, -m.pick(-0.09, 0.09), 0.025), 0.009)
        m.hinge("lever", tip, (-1, 0, 0) if m.of("lever").bounds[0, 1] < tip[1] - 0.05 else (1, 0, 0), 25, "cap")
    if m.chance(0.4):
        m.add("waste_rod", rod((0, 0.035, 0.0), (0, 0.035, 0.08), 0.003, 8), ball((0, 0.035, 0.085), (0.007,) * 3, 8))
        m.slide("waste_rod", (0, 0, 1), 0.025)
    if m.chance(0.3):
        m.add(BASE, prism(rounded((-0.14, 0.14), (-0.06, 0.06), 0.03), "z", (-0.02, 0)))


def shower_mixer(m: Model) -> None:
    """A bar of valves on a wall: knobs at its ends or a lever, a rail with a slider and a hand shower, an overhead rose."""
    wide, r, z, n = m.number(0.22, 0.34), m.number(0.018, 0.028), 1.0, m.pick(10, 16, 24)
    wall = m.pick(0.0, 0.02)
    m.add(
        BASE,
        rod((-wide / 2, -0.06, z), (wide / 2, -0.06, z), r, n)
        if m.chance(0.7)
        else box((-wide / 2, wide / 2), (-0.06 - r, -0.06 + r), (z - r, z + r)),
    )
    for s in (-1, 1):
        m.add(
            BASE,
            rod((s * 0.075, -0.06, z), (s * 0.075, 0, z), 0.6 * r, n),
            rod((s * 0.075, -0.012, z), (s * 0.075, 0, z), 1.3 * r, n),
        )
    if m.chance(0.65):
        style = m.pick("fluted", "plain", "stop")
        for s, name in ((-1, "flow"), (1, "heat")):
            a, b = s * (wide / 2 + 0.001), s * (wide / 2 + 0.045)
            knob = fluted(1.15 * r, 8, (0, 0.044)).apply_transform(
                [[0, 0, s, a], [0, 1, 0, -0.06], [-s, 0, 0, z], [0, 0, 0, 1]]
            )
            m.add(f"{name}_knob", knob if style == "fluted" else rod((a, -0.06, z), (b, -0.06, z), 1.1 * r, n))
            if style == "stop":
                m.add(f"{name}_knob", box((min(a, b) + 0.01, max(a, b) - 0.01), (-0.065, -0.055), (z + r, z + 1.6 * r)))
            m.hinge(f"{name}_knob", (a, -0.06, z), (s, 0, 0), m.pick(90, 180)) if m.chance(0.6) else m.spin(
                f"{name}_knob", (a, -0.06, z), (s, 0, 0)
            )
    else:
        at = vec(0, -0.06 - r, z)
        m.add("lever", rod(at, at - vec(0, 0.02, 0), 0.9 * r, n))
        lever(m, "lever", at - vec(0, 0.015, 0), at + vec(0, -0.06, m.pick(-0.06, 0.06)), 0.012)
        m.hinge("lever", at, *m.pick([(0, -1, 0), (-60, 60)], [(0, -1, 0), 120]))
    if m.chance(0.5):
        dial(m, "diverter", (0.04, -0.06, z + r), (0, 0, 1), 0.014)
    rail, top = m.chance(0.75), z + m.number(0.6, 1.1)
    if rail:
        y = -0.06
        m.add(BASE, rod((0, y, z + r + 0.12), (0, y, top), 0.01, n))
        m.add(BASE, *(rod((0, y, c), (0, 0, c), 0.008, 8) for c in (z + r + 0.15, top - 0.03)))
        c = m.number(z + 0.35, top - 0.15)
        m.add(
            "slider",
            box((-0.02, 0.02), (y - 0.025, y + 0.018), (c - 0.025, c + 0.025))
            if m.chance(0.5)
            else rod((0, y, c - 0.03), (0, y, c + 0.03), 0.022, n),
        )
        m.slide("slider", (0, 0, 1), (z + r + 0.2 - c, top - 0.08 - c))
        p, head = vec(0, y - 0.035, c), m.pick("head", "head", "slider")
        m.add("slider", rod((0, y, c), p, 0.01, 8))
        tip = p + vec(0, -0.07, 0.16)
        m.add(
            head, rod(p - vec(0, -0.01, 0.03), tip, 0.011, n), rod(tip, tip + vec(0, -0.02, -0.015), m.number(0.03, 0.055), n)
        )
        if head == "head":
            m.hinge("head", p, (1, 0, 0), (-30, 30), "slider")
        if m.chance(0.5):
            hose = [(0, -0.06, z - r), (0.05, -0.08, z - 0.2), (0.15, -0.1, z - 0.25), (0.18, -0.1, z), (0.06, -0.1, c - 0.1)]
            m.add(BASE, tube(hose, 0.007, 8))
    if m.chance(0.5) or not rail:
        far, side = m.number(0.25, 0.4), -0.06 if not rail else -0.03
        path = [(0, side, z + r), (0, side, top + 0.15), (0, -far, top + 0.15), (0, -far, top + 0.1)]
        m.add(BASE, tube(path, 0.011, 8))
        m.add("rose", ball((0, -far, top + 0.1), (0.016,) * 3, 10))
        wide_ = m.number(0.07, 0.13)
        m.add(
            "rose",
            rod((0, -far, top + 0.08), (0, -far, top + 0.092), wide_, n)
            if m.chance(0.6)
            else prism(rounded((-wide_, wide_), (-far - wide_, -far + wide_), 0.01), "z", (top + 0.08, top + 0.09)),
        )
        m.hinge("rose", (0, -far, top + 0.1), (1, 0, 0), (-25, 25))
    if wall:
        m.add(BASE, box((-0.3, 0.3), (0, wall), (z - 0.3, top + 0.3)))
