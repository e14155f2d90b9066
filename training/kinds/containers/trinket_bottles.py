"""Bottles of one artist: screw caps, trigger sprayers, pumps."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rod, tube, vec
from training.kinds.trinket_style import Look, band, draw_look, outline, pebble, ribs, shell, slab, spun


def bottle(m: Model, look: Look, r: float, high: float, neck: float) -> None:
    """A body with a neck that ends at a height, round, square or flat; perhaps with a label."""
    shape = m.pick("round", "square", "flat", "round")
    power, deep = (2.0, 1.0) if shape == "round" else (5.0, 1.0) if shape == "square" else (3.0, 0.6)
    line = outline(look.n + (6 if power > 2 else 0), power, deep)
    shoulder = m.number(0.6, 0.85) * high
    waist = m.pick(1.0, 1.0, 0.85) * r
    low = [
        (0, 0),
        (0.92 * r, 0),
        (r, 0.04 * high),
        (waist, 0.4 * high),
        (r, shoulder),
        (0.9 * r, shoulder + 0.3 * (high - shoulder)),
    ]
    top = 0.96 * high
    around = m.pick(0.55, 0.75)
    profile = [
        *low,
        (around * r if around * r > neck else 1.05 * neck, 0.9 * high),
        (1.02 * neck, 0.92 * high),
        (1.0 * neck, top),
    ]
    m.add(BASE, shell(look, profile, 0.03 * r, line))
    m.add(BASE, rod((0, 0, 0.88 * high), (0, 0, high), 0.97 * min(1.0, 1.2 * deep) * neck, look.n))
    if waist == r and m.chance(0.5):
        m.add(
            BASE,
            spun(
                [(1.0 * r, 0.15 * high), (1.015 * r, 0.15 * high), (1.015 * r, 0.5 * high), (r, 0.5 * high), (r, 0.15 * high)],
                line,
            ),
        )


def screw_bottle(m: Model) -> None:
    """A bottle with a screwed cap; perhaps a ring below it, a drinking spout to pull, a dropper or a cup over it."""
    look = draw_look(m)
    r, high = m.number(0.025, 0.05), m.number(0.1, 0.28)
    neck = m.number(0.35, 0.6) * r
    bottle(m, look, r, high, neck)
    low, top, cap = 0.93 * high, high + 0.04 * r, 1.12 * neck
    kind = m.pick("plain", "sport", "dropper", "cup", "loop", "plain")
    tall = m.pick(0.0, 0.5, 1.2) * neck if kind in ("plain", "loop") else 0.1 * neck
    top += tall
    if kind == "cup":
        cap, top = 1.7 * neck, top + 1.5 * neck
    profile = [(cap, low), (cap, top - 0.15 * cap), (0.9 * cap, top), (0, top)]
    m.add("cap", shell(look, profile, 0.08 * neck, outline(look.n), down=True))
    if kind == "cup":
        m.add(BASE, rod((0, 0, low - 0.15 * neck), (0, 0, low), 1.6 * neck, look.n))
    if not look.plain or m.chance(0.3):
        m.add("cap", *ribs(m.pick(12, 20, 28), cap, (low + 0.03 * neck, top - 0.25 * cap), 0.05 * cap))
    if m.chance(0.5) and kind != "cup":
        m.add(BASE, *band(look, 1.1 * neck, low - 0.15 * neck, 0.05 * neck, outline(look.n)))
    m.spin("cap", (0, 0, (low + top) / 2), (0, 0, 1))
    _cap_top(m, look, kind, (cap, top, neck), (low, high))


def _cap_top(m: Model, look: Look, kind: str, size: tuple[float, float, float], z0: tuple[float, float]) -> None:
    """What stands on a cap: a spout that is pulled, the bulb of a dropper, a loop."""
    (cap, top, neck), (low, high) = size, z0
    if kind == "sport":
        m.add(
            "cap",
            spun(
                [(0, top - 0.1 * neck), (0.7 * neck, top - 0.1 * neck), (0.45 * neck, top + 0.8 * neck), (0, top + 0.8 * neck)],
                outline(look.n),
            ),
        )
        z = top + 0.55 * neck
        shape = [
            (0.0, z + 0.3 * neck),
            (0.52 * neck, z),
            (0.6 * neck, z),
            (0.55 * neck, z + 0.6 * neck),
            (0.65 * neck, z + 0.9 * neck),
            (0, z + 0.9 * neck),
        ]
        m.add("spout", spun([(0, z + 0.28 * neck), *shape[1:]], outline(look.n)))
        m.slide("spout", (0, 0, 1), 0.4 * neck, "cap")
    elif kind == "dropper":
        bulb = [
            (0, top - 0.1 * neck),
            (0.6 * neck, top - 0.1 * neck),
            (0.6 * neck, top + 0.6 * neck),
            (0.55 * neck, top + 1.5 * neck),
            (0, top + 1.9 * neck),
        ]
        m.add("cap", shell(look, bulb, 0.1 * neck, outline(look.n)) if look.style == "soft" else spun(bulb, outline(look.n)))
        m.add("cap", rod((0, 0, 0.35 * high), (0, 0, low + 0.3 * neck), 0.2 * neck, 8))
    elif kind == "loop":
        path = [
            vec(1.1 * cap * np.cos(a), 0, top - 0.1 * cap + 1.3 * cap * np.sin(a)) for a in np.linspace(0.1, np.pi - 0.1, 9)
        ]
        m.add("cap", tube(path, 0.14 * cap, 8))


def _collar(m: Model, look: Look, profile: list[tuple[float, float]], neck: float, z: float) -> None:
    """Add the collar that is screwed on a neck, with its middle at z."""
    m.add("collar", shell(look, profile, 0.1 * neck, outline(look.n), down=True))
    m.spin("collar", (0, 0, z), (0, 0, 1))


def trigger_sprayer(m: Model) -> None:
    """A bottle with a spray head: a trigger, a collar that is screwed, a nozzle that is turned."""
    look = draw_look(m)
    r, high = m.number(0.03, 0.05), m.number(0.13, 0.2)
    neck = m.number(0.3, 0.42) * r
    bottle(m, look, r, high, neck)
    low, up = 0.93 * high, high + 0.3 * neck
    collar = 1.25 * neck
    _collar(m, look, [(collar, low), (collar, up - 0.2 * neck), (0.9 * collar, up), (0, up)], neck, (low + up) / 2)
    if not look.plain:
        m.add("collar", *ribs(20, collar, (low + 0.1 * neck, up - 0.3 * neck), 0.05 * neck))
    w, tall = m.number(0.55, 0.8) * neck, m.number(1.4, 2.2) * neck
    front, back = -m.number(2.2, 3.5) * neck, m.number(0.9, 2.6) * neck
    z0, z1 = up + 0.8 * neck, up + 0.8 * neck + tall
    m.add(BASE, rod((0, 0, up - 0.1 * neck), (0, 0, z0 + 0.3 * neck), 0.75 * w, look.n))
    _spray_head(m, look, w, (front, back), (z0, z1))
    _trigger(m, look, w, (0.45 * front, z0 + 0.15 * tall), neck)
    if m.chance(0.85):
        z, out, size = z0 + 0.58 * tall, front - 0.55 * neck, 0.55 * w
        if look.plain or m.chance(0.5):
            m.add("nozzle", box((-size, size), (out, front + 0.1 * neck), (z - size, z + size)))
        else:
            m.add("nozzle", rod((0, out, z), (0, front + 0.1 * neck, z), size, look.n))
        m.add("nozzle", rod((0, out - 0.12 * neck, z), (0, out + 0.02 * neck, z), 0.3 * size, 8))
        m.spin("nozzle", (0, front, z), (0, -1, 0))
    if look.style in ("assembly", "hollowed"):
        m.add(BASE, rod((0, 0, 0.06 * high), (0, 0, low), 0.1 * neck, 8))


def _spray_head(m: Model, look: Look, w: float, along: tuple[float, float], up: tuple[float, float]) -> None:
    """The body of the head, with a strip at either side."""
    (front, back), (z0, z1) = along, up
    tall = z1 - z0
    kind = m.pick("wedge", "box", "round")
    if kind == "wedge" or look.style == "old":
        side = [
            (back, z0 + 0.2 * tall),
            (back, z0 + 0.6 * tall),
            (0.3 * back, z1),
            (front, z0 + 0.85 * tall),
            (front, z0 + 0.35 * tall),
            (0.2 * front, z0),
        ]
        m.add(BASE, prism(side, "x", (-w, w)))
    elif kind == "round" or look.style == "soft":
        m.add(BASE, pebble((-w, w), (front, back), (z0, z1), 4))
    else:
        m.add(BASE, box((-w, w), (front, back), (z0, z1)))
    m.add(
        BASE,
        *(box((s * w * 0.98, s * w * 1.06), (0.6 * front, 0.5 * back), (z0 + 0.4 * tall, z0 + 0.6 * tall)) for s in (-1, 1)),
    )


def _trigger(m: Model, look: Look, w: float, at: tuple[float, float], neck: float) -> None:
    """The lever below the nozzle, straight, bent or hooked."""
    y, z = at
    long = m.number(2.2, 3.5) * neck
    bend = m.pick(-0.5, -0.9, -0.2) * neck
    thick = 0.35 * neck
    side = [
        (y - thick, z + 0.5 * neck),
        (y + thick, z + 0.5 * neck),
        (y + thick + 0.6 * bend, z - 0.55 * long),
        (y + 0.5 * thick + 0.2 * bend, z - long),
    ]
    side += [(y - 0.5 * thick + 0.2 * bend, z - long), (y - thick + bend, z - 0.5 * long)]
    m.add("trigger", prism(side, "x", (-0.7 * w, 0.7 * w)))
    m.hinge("trigger", (0, y, z + 0.3 * neck), (1, 0, 0), m.pick(12, 16))
    if look.style in ("assembly", "old"):
        m.add("trigger", rod((-1.1 * w, y, z + 0.3 * neck), (1.1 * w, y, z + 0.3 * neck), 0.18 * neck, 10))


def pump_bottle(m: Model) -> None:
    """A bottle with a pump: a head that is pressed, a collar that is screwed, perhaps a clear cover that lifts off."""
    look = draw_look(m)
    r, high = m.number(0.025, 0.045), m.number(0.08, 0.18)
    neck = m.number(0.35, 0.55) * r
    bottle(m, look, r, high, neck)
    low, up = 0.93 * high, high + 0.35 * neck
    collar = 1.25 * neck
    _collar(m, look, [(collar, low), (collar, up), (0.6 * collar, up + 0.1 * neck), (0, up + 0.1 * neck)], neck, (low + up) / 2)
    if not look.plain and m.chance(0.6):
        m.add("collar", *ribs(24, collar, (low + 0.1 * neck, up - 0.1 * neck), 0.04 * neck))
    press = m.number(0.7, 1.3) * neck
    z = up + 0.1 * neck + press
    m.add("pump", rod((0, 0, up - 0.3 * neck), (0, 0, z + 0.2 * neck), 0.3 * neck, look.n))
    kind = m.pick("spout", "airless", "beak")
    _pump_head(m, look, kind, neck, z)
    m.slide("pump", (0, 0, -1), 0.85 * press)
    if kind == "airless" and m.chance(0.7):
        wide, end = 1.2 * neck, z + 1.15 * neck
        m.add("cover", shell(look, [(wide, up + 0.12 * neck), (wide, end), (0, end)], 0.05 * neck, outline(look.n), down=True))
        m.slide("cover", (0, 0, 1), m.number(0.7, 1.2) * (end - up))


def _pump_head(m: Model, look: Look, kind: str, neck: float, z: float) -> None:
    """What is pressed: a button with a hole, a disc with a bent spout, or a flat beak."""
    if kind == "airless":
        m.add(
            "pump",
            spun(
                [(0, z), (0.95 * neck, z), (0.95 * neck, z + 0.9 * neck), (0.8 * neck, z + neck), (0, z + 0.9 * neck)],
                outline(look.n),
            ),
        )
        m.add("pump", rod((0, -1.05 * neck, z + 0.55 * neck), (0, -0.6 * neck, z + 0.55 * neck), 0.2 * neck, 10))
    elif kind == "spout":
        m.add("pump", rod((0, 0, z), (0, 0, z + 0.6 * neck), m.number(0.6, 0.9) * neck, look.n))
        out = m.number(1.6, 2.6) * neck
        path = [
            vec(0, 0, z + 0.3 * neck),
            vec(0, -0.8 * out, z + 0.35 * neck),
            vec(0, -out, z + 0.2 * neck),
            vec(0, -1.1 * out, z - 0.15 * neck),
        ]
        m.add("pump", tube(path, 0.22 * neck, 6 if look.plain else 12))
    else:
        m.add(
            "pump",
            *slab(look, (-0.55 * neck, 0.55 * neck), (-m.number(1.3, 2.2) * neck, 0.8 * neck), (z, z + 0.5 * neck), 0.4 * neck),
        )
