"""Screens and computer cases of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.electronics.still_devices import FORWARD, heads, slots
from training.kinds.furniture.still_seats import repeat, sizes
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, moved, prism, rectangle, ring, rod, rounded, turned
from training.kinds.wheels import beam


def _tv_foot(m: Model, how: str, wide: float, low: float) -> None:
    """Make what a screen stands on or hangs from; the screen begins at a height."""
    t, n, deep = m.number(0.006, 0.02), m.sections() + 4, m.number(0.1, 0.16)
    if how == "pedestal":
        oval = ball((0, 0, 0), (0.3 * wide, deep, 0.02), n)
        oval.vertices[:, 2] = np.maximum(oval.vertices[:, 2], 0)
        m.add(BASE, m.pick(oval, box((-0.3 * wide, 0.3 * wide), (-deep, deep), (0, t)), rod((0, 0, 0), (0, 0, t), deep, n)))
        neck = m.number(0.02, 0.06)
        m.add(BASE, m.pick(box((-neck, neck), (0.01, 0.03), (0, low + 0.1)), rod((0, 0.02, 0), (0, 0.02, low + 0.1), 0.025, n)))
    elif how == "feet":
        for s in (-0.7 * wide, 0.7 * wide):
            m.add(BASE, *(beam((s, 0.01, low + 0.02), (s, y, t / 2), 0.02, t) for y in (-deep, deep)))
            m.add(
                BASE,
                *(box((s - 0.012, s + 0.012), (y - 0.015, y + 0.015), (-0.004, t)) for y in (-deep, deep) if m.chance(0.7)),
            )
    elif how == "wall":
        z = (low + 0.15, low + 0.4)
        m.add(
            BASE,
            box((-0.35 * wide, 0.35 * wide), (0.09, 0.1), z),
            *heads((-0.3 * wide, 0.3 * wide), shrunk(z, 0.03), 0.09, 0.01),
        )
        m.add(BASE, *(box((s - 0.02, s + 0.02), (0.02, 0.095), shrunk(z, -0.03)) for s in (-0.2 * wide, 0.2 * wide)))
        m.add(
            BASE, *([box((-1.6 * wide, 1.6 * wide), (0.1, 0.14), (low - 0.4, low + 1.1 * wide + 0.5))] if m.chance(0.5) else [])
        )
    else:
        m.add(
            BASE,
            *(
                beam((s * 0.2 * wide, 0.02, low + 0.2), (s * 0.6 * wide, y, -0.5), 0.03, 0.03)
                for s in (-1, 1)
                for y in (-0.2, 0.25)
            ),
        )


def flat_tv(m: Model) -> None:
    """Make a flat or bent screen with its bezel and back, on a foot, two feet, four legs or a wall plate; nothing moves."""
    wide, low, edge, thick = sizes(m, (0.3, 0.7), (0.05, 0.12), (0.006, 0.04), (0.008, 0.03))
    tall, n = 2 * wide * m.pick(0.5625, 0.5625, 0.43, 0.62), m.pick(2, 2, 2, 9)
    x, z, bend = (-wide, wide), (low, low + tall), 0.0 if n == 2 else m.number(0.05, 0.15) * wide
    how = m.pick("pedestal", "feet", "wall", "legs")
    _tv_foot(m, how if n == 2 else "pedestal", wide, low)
    u = np.linspace(-1, 1, n)
    arc, thin = np.c_[wide * u, -bend * u**2], np.array([0, thick])
    m.add(BASE, prism(np.r_[arc, (arc + thin)[::-1]], "z", z))
    for c in ((z[0], z[0] + edge * m.pick(1, 2)), (z[1] - edge, z[1])):
        m.add(BASE, prism(np.r_[arc - np.array([0, 0.004]), (arc + np.array([0, 0.001]))[::-1]], "z", c))
    y = arc[0, 1]
    m.add(BASE, *(box((s * wide, s * (wide - edge)), (y - 0.004, y + 0.002), z) for s in (-1, 1)))
    if m.chance(0.7):
        back = (shrunk(x, 0.25 * wide), (low + 0.1, low + 0.6 * tall))
        m.add(BASE, box(back[0], (thick - 0.002 - bend / 3, 0.02 + thick), back[1]))
        m.add(
            BASE,
            *(
                turned(s, (0, 0, 1), 180, (0, 0.0, 0))
                for s in slots(m, shrunk(back[0], 0.03), shrunk(back[1], 0.05), -0.02 - thick)
            ),
        )
        m.add(
            BASE,
            *(
                box((a, a + 0.015), (thick, 0.023 + thick), (low + 0.11, low + 0.12))
                for a in np.linspace(-0.1, 0.1, m.pick(2, 4))
            ),
        )
    badge = box((-0.03, 0.03), (-0.006, 0.002), (low + 0.001, low + 0.008))
    bar = box((-0.6 * wide, 0.6 * wide), (-0.05, 0.02), (low - 0.03, low + 0.01))
    m.add(BASE, *m.pick([badge], [bar], [], [badge, *[box((0.05 * wide, 0.1 * wide), (-0.006, 0.001), (low, low + 0.004))]]))


def _case_front(m: Model, x: Span, z: Span) -> None:
    """Make the front of a case: blank bay plates, a vent, a lit strip, a logo and sockets."""
    wide, tall, y = x[1] - x[0], z[1] - z[0], (-0.006, 0.002)
    how, inner = m.pick("bays", "vent", "plate", "strips"), shrunk(x, 0.12 * wide)
    m.add(
        BASE, *([prism(rectangle(shrunk(x, -0.004), shrunk(z, -0.004), 0.014), "y", (-0.012, 0.01))] if m.chance(0.5) else [])
    )
    split = z[0] + m.number(0.35, 0.65) * tall
    if how == "bays":
        levels = np.linspace(split, z[1] - 0.03, m.pick(3, 4, 6))
        m.add(BASE, *(box(inner, y, (a + 0.002, b - 0.002)) for a, b in pairwise(levels)))
        m.add(BASE, *slots(m, inner, (z[0] + 0.05, split - 0.03), 0))
    elif how == "vent":
        m.add(BASE, *slots(m, inner, shrunk(z, 0.1 * tall), 0))
        rows = [ring((0, -0.002, z[0] + tall * (0.5 + 0.28 * k)), FORWARD, 0.38 * wide, 0.004, 20) for k in (-1, 0, 1)]
        m.add(BASE, *rows[: m.pick(0, 2, 3)])
    elif how == "plate":
        m.add(BASE, prism(rounded(inner, shrunk(z, 0.06 * tall), 0.02), "y", (-0.012, 0.001)))
        m.add(
            BASE, *m.pick([rod((0, -0.014, split), (0, 0, split), 0.02, 16)], [box(inner, (-0.014, 0), (split, split + 0.004))])
        )
    else:
        m.add(
            BASE,
            *(
                box((a - 0.006, a + 0.006), y, shrunk(z, 0.08 * tall))
                for a in np.linspace(*shrunk(x, 0.2 * wide), m.pick(2, 4))
            ),
        )
    for k in range(m.pick(0, 2, 4)):
        m.add(
            BASE,
            box(
                (x[0] + 0.15 * wide + 0.02 * k, x[0] + 0.15 * wide + 0.02 * k + 0.013),
                (-0.008, 0),
                (z[1] - 0.022, z[1] - 0.016),
            ),
        )


def computer_tower_case(m: Model) -> None:
    """Make a closed computer case: tower, lying desktop, cube or slab, its sides screwed on, with vents; nothing moves."""
    how, t = m.pick("tower", "tower", "cube", "slab"), m.number(0.004, 0.012)
    wide, deep, tall = {"tower": (0.1, 0.45, 0.45), "cube": (0.12, 0.28, 0.22), "slab": (0.045, 0.36, 0.33)}[how]
    wide, deep, tall = (s * m.number(0.85, 1.15) for s in (wide, deep, tall))
    one, x, z = Model(m.rng), (-wide, wide), (0.0, tall)
    one.add(
        BASE,
        m.pick(box(x, (0, deep), z), prism(rounded(x, z, 0.02), "y", (0, deep)), prism(rounded((0, deep), z, 0.03), "x", x)),
    )
    _case_front(one, x, z)
    panel = shrunk((0, deep), 0.02), shrunk(z, 0.02)
    for s in m.pick((-1, 1), (1,), ()):
        sheet = rounded(*panel, 0.01) if one.chance(0.5) else rectangle(*panel, one.pick(0.0, 0.02, 0.05))
        one.add(BASE, prism(sheet, "x", (s * (wide - 0.001), s * (wide + t))))
        spots = [(b, c) for b in shrunk(panel[0], 0.015) for c in shrunk(panel[1], 0.015)] if one.chance(0.7) else []
        one.add(BASE, *(rod((s * wide, b, c), (s * (wide + t + 0.003), b, c), 0.006, 6) for b, c in spots))
    back = [turned(b, (0, 0, 1), 180, (0, 0, 0)) for b in slots(m, shrunk(x, 0.25 * wide), (0.6 * tall, 0.85 * tall), -deep)]
    back += [
        box(shrunk(x, 0.3 * wide), (deep, deep + 0.003), (c, c + 0.012)) for c in np.linspace(0.15, 0.5, m.pick(2, 5, 7)) * tall
    ]
    one.add(BASE, *(back if one.chance(0.8) else []))
    tops = slots(m, shrunk(x, 0.2 * wide), shrunk((0, deep), 0.2 * deep), 0)
    one.add(BASE, *([moved(turned(b, (1, 0, 0), -90, (0, 0, 0)), (0, 0, tall)) for b in tops] if m.chance(0.4) else []))
    feet = m.pick(
        *(
            [rod((a, b, -0.015), (a, b, 0.005), r, 12) for a in (-0.7 * wide, 0.7 * wide) for b in (0.12 * deep, 0.88 * deep)]
            for r in (0.01, 0.02)
        )
    )
    rails = [box((a - 0.012, a + 0.012), shrunk((0, deep), 0.03), (-0.015, 0.002)) for a in (-0.8 * wide, 0.8 * wide)]
    lying = how == "slab" and m.chance(0.5)
    one.add(BASE, *([] if lying else m.pick(feet, rails)))
    repeat(m, lambda own: own.add(BASE, *(s for _, s in one.pieces)), [((0, 0, 0), 90 if lying else 0)], (0, 1, 0))
