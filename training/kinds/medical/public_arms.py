"""Operating lamps, and screens on wall arms."""

from __future__ import annotations

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, ring, rod, rounded, tube, vec


def _lamp_head(m: Model, part: str, at: np.ndarray, r: float) -> None:
    """A lamp that shines down from a point: a dome with a ring, a flat disc with bulbs, or petals; a grip below."""
    style, n = m.pick("dome", "disc", "petals", "ring"), m.pick(16, 24, 32)
    x, y, z = at
    if style == "dome":
        m.add(
            part,
            lathe(
                [(0.0, 0.0), (0.5 * r, -0.02), (r, -0.1), (r, -0.13), (0.95 * r, -0.13), (0.5 * r, -0.06), (0.0, -0.05)], n, at
            ),
        )
    elif style == "disc":
        m.add(part, rod((x, y, z - 0.08), (x, y, z), r, n))
    elif style == "ring":
        m.add(
            part,
            ring(at - vec(0, 0, 0.05), (0, 0, 1), 0.8 * r, 0.2 * r, 24),
            box((x - r, x + r), (y - 0.03, y + 0.03), (z - 0.06, z)),
        )
        m.add(part, rod((x, y, z - 0.07), (x, y, z), 0.25 * r, 16))
    count = m.pick(4, 6, 7) if style == "disc" else 5
    turn = 2 * np.pi * np.arange(count) / count
    for a in turn if style in ("disc", "petals") else ():
        c = at + 0.62 * r * vec(np.cos(a), np.sin(a), 0)
        if style == "petals":
            m.add(part, rod(c - vec(0, 0, 0.09), c - vec(0, 0, 0.01), 0.37 * r, 16))
        m.add(part, rod(c - vec(0, 0, 0.1), c - vec(0, 0, 0.07), 0.16 * r, 12))
    if style == "petals":
        m.add(part, rod((x, y, z - 0.06), (x, y, z), 0.4 * r, 16))
    m.add(part, rod((x, y, z - 0.2), (x, y, z - 0.04), 0.018, 10), rod((x, y, z - 0.2), (x, y, z - 0.12), 0.024, 10))


def _lamp_arm(m: Model, k: str, hub: np.ndarray, a: float, long: float, drop: float, r: float, walled: bool) -> None:
    """An arm from a hub towards an angle: it turns, its second part lifts, a yoke turns below its end, the lamp tilts."""
    out, side, up = vec(np.cos(a), np.sin(a), 0), vec(-np.sin(a), np.cos(a), 0), vec(0, 0, 1)
    elbow, two = hub + long * out, m.chance(0.7)
    m.add(f"arm{k}", rod(hub - 0.05 * up, hub + 0.05 * up, 0.055, 16), rod(hub, elbow, m.number(0.022, 0.035), 10))
    if walled:
        m.hinge(f"arm{k}", hub, (0, 0, 1), (-80, 80))
    else:
        m.spin(f"arm{k}", hub, (0, 0, 1))
    end, holder = elbow, f"arm{k}"
    if two:
        fold, holder = elbow - 0.07 * up, f"boom{k}"
        end = fold + 0.7 * long * out - 0.1 * up
        m.add(f"arm{k}", rod(elbow + 0.04 * up, fold - 0.02 * up, 0.032, 12))
        m.add(holder, rod(fold - 0.04 * side, fold + 0.04 * side, 0.034, 12), rod(fold, end, 0.026, 10))
        m.hinge(holder, fold, np.cross(out, up), (-30, m.number(25, 45)), f"arm{k}")
    m.add(holder, rod(end + 0.03 * up, end - 0.05 * up, 0.03, 12))
    low = end - drop * up
    yoke, head, w = f"yoke{k}", f"lamp{k}", m.pick(0.0, 0.0, 1.02) * r
    if w:
        m.add(yoke, rod(end - 0.05 * up, end - 0.1 * up, 0.022, 10))
        m.add(yoke, tube([low - w * side, end - w * side - 0.1 * up, end + w * side - 0.1 * up, low + w * side], 0.013, 8))
    else:
        m.add(yoke, rod(end - 0.05 * up, low, 0.02, 10), rod(low - 0.03 * side, low + 0.03 * side, 0.026, 12))
    m.spin(yoke, end - 0.05 * up, (0, 0, 1), holder)
    top = low + (0.05 if w else -0.02) * up
    ends = (low - 1.05 * w * side, low + 1.05 * w * side) if w else (low, low - 0.04 * up)
    m.add(head, rod(*ends, 0.012 if w else 0.035, 10))
    _lamp_head(m, head, top, r)
    m.hinge(head, low, side, (-m.number(30, 60), m.number(60, 90)), yoke)


def operating_lamp(m: Model) -> None:
    """One lamp or two on jointed arms, under a ceiling plate, from a wall, or on a stand with castors."""
    r, long, drop, style = (
        m.number(0.22, 0.35),
        m.number(0.5, 0.8),
        m.number(0.25, 0.4),
        m.pick("ceiling", "ceiling", "wall", "stand"),
    )
    hub, count = (
        vec(0, 0, 0.9 if style == "ceiling" else 1.1 if style == "wall" else 1.75),
        (m.pick(1, 2) if style == "ceiling" else 1),
    )
    if style == "ceiling":
        top = hub[2] + m.number(0.35, 0.6)
        m.add(
            BASE,
            rod((0, 0, top), (0, 0, top + 0.03), m.number(0.15, 0.25), 24),
            rod((0, 0, hub[2] - 0.08), (0, 0, top), 0.038, 16),
        )
        m.add(BASE, lathe([(0.14, top), (0.12, top - 0.06), (0.05, top - 0.1)], 20))
        hub = hub + vec(0, 0, 0.12 * (count - 1))
    elif style == "wall":
        m.add(
            BASE,
            box((-0.12, 0.12), (0.12, 0.15), (0.9, 1.3)),
            *(box((-0.05, 0.05), (-0.05, 0.12), (c - 0.02, c + 0.02)) for c in (1.03, 1.17)),
        )
        m.add(BASE, rod((0, 0, 1.0), (0, 0, 1.2), 0.03, 12))
    else:
        m.add(BASE, rod((0, 0, 0.1), (0, 0, 1.78), 0.03, 12), rod((0, 0, 0.1), (0, 0, 0.6), 0.045, 12))
        n = m.pick(4, 5)
        for c in 2 * np.pi * np.arange(n) / n + 0.4:
            e = vec(0.42 * np.cos(c), 0.42 * np.sin(c), 0.09)
            m.add(BASE, rod((0, 0, 0.12), e, 0.022, 8), rod(e - vec(0, 0.014, 0.05), e + vec(0, 0.014, -0.05), 0.04, 14))
    first = -np.pi / 2 if style == "wall" else m.number(0, 6.28)
    for k in range(count):
        _lamp_arm(
            m,
            f"_{k}" if count > 1 else "",
            hub - vec(0, 0, 0.12 * k),
            first + 2.6 * k,
            long,
            drop,
            r * (1 - 0.15 * k),
            style == "wall",
        )


def _screen(m: Model, at: np.ndarray, parent: str) -> None:
    """A screen before a point, on a plate with uprights, that tilts."""
    wide, thick, z = m.number(0.6, 1.15), m.number(0.025, 0.06), at[2]
    tall, y = wide * m.number(0.55, 0.62), at[1] - m.number(0.05, 0.08)
    x, span = (at[0] - wide / 2, at[0] + wide / 2), (z - tall / 2, z + tall / 2)
    m.add("screen", prism(rounded(x, span, 0.01), "y", (y - thick, y)) if m.chance(0.5) else box(x, (y - thick, y), span))
    if m.chance(0.6):
        m.add("screen", prism(rectangle(x, span, 0.015), "y", (y - thick - 0.005, y - thick)))
    if m.chance(0.5):
        m.add("screen", box(shrunk(x, 0.2 * wide), (y, y + 0.02), shrunk(span, 0.2 * tall)))
    m.add(
        "screen", *(box((c - 0.015, c + 0.015), (y, y + 0.03), shrunk(span, 0.15 * tall)) for c in (at[0] - 0.1, at[0] + 0.1))
    )
    m.add("screen", box((at[0] - 0.13, at[0] + 0.13), (y + 0.02, y + 0.035), (z - 0.06, z + 0.06)))
    m.add(
        "screen",
        *(box((c - 0.006, c + 0.006), (y + 0.03, at[1] + 0.02), (z - 0.025, z + 0.025)) for c in (at[0] - 0.05, at[0] + 0.05)),
    )
    m.hinge("screen", at, (1, 0, 0), (-m.number(3, 10), m.number(12, 20)), parent)


def tv_wall_arm(m: Model) -> None:
    """A wall bracket for a screen: no arm, one or two arms (folded or half out, single or twin bars), a head, a screen."""
    s, arms, out, twin = m.pick(-1.0, 1.0), m.pick(0, 1, 2, 2), np.deg2rad(m.pick(4, 4, 30, 55)), m.chance(0.4)
    c, high, long, r = 0.4, m.number(0.12, 0.25), m.number(0.2, 0.4), m.number(0.014, 0.02)
    at, up, holder = vec(-s * m.pick(0.0, 0.5 * long) if arms else 0.0, -0.05, c), vec(0, 0, 1), BASE
    wide = m.number(0.05, 0.2)
    m.add(BASE, box((at[0] - wide, at[0] + wide), (0, 0.012), (c - high, c + high)))
    m.add(
        BASE,
        *(
            rod((at[0] + a, -0.006, c + b), (at[0] + a, 0.0, c + b), 0.01, 6)
            for a in (-0.6 * wide, 0.6 * wide)
            for b in (-0.8 * high, 0.8 * high)
        ),
    )
    m.add(BASE, *(box((at[0] - 0.02, at[0] + 0.02), (-0.05, 0), (c + b - 0.006, c + b + 0.006)) for b in (-0.075, 0.075)))
    for k in range(arms):
        side = s if k == 0 else -s
        way, part = vec(side * np.cos(out), -np.sin(out), 0), f"arm_{k}"
        end = at + long * way * (1.0 if k == 0 else m.number(0.85, 1.0))
        bars = (-0.05, 0.05) if twin else (0.03 if k == 0 else -0.03,)
        bars = tuple(b * (0.6 if twin and k else 1.0) for b in bars)
        m.add(part, *(rod(at + b * up, end + b * up, r, m.pick(4, 8, 12)) for b in bars))
        m.add(part, *(rod(p - 0.068 * up, p + 0.068 * up, 1.2 * r, 12) for p in (at, end)))
        m.hinge(part, at, (0, 0, -side), float(np.rad2deg(np.pi * (k + 1) / 2 - out * (k + 1))), holder)
        at, holder = end, part
    if arms:
        m.add(
            "head",
            rod(at - 0.085 * up, at + 0.085 * up, 1.35 * r, 12),
            box((at[0] - 0.05, at[0] + 0.05), (at[1] - 0.035, at[1] - 0.01), (c - 0.03, c + 0.03)),
        )
        m.hinge("head", at, (0, 0, 1), (-m.number(40, 80), m.number(40, 80)), holder)
        holder = "head"
    _screen(m, at - vec(0, 0.03, 0), holder)
