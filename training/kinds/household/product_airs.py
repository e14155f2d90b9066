"""Cleaners of air, by one artist."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.product_style import FRONT, UP, Look, lathe, outline
from training.kinds.solids import around, box, loft, moved, prism, ring, rod, tube, vec


def air_purifier(m: Model) -> None:
    """A cleaner of air: a round tower with a ring to turn, a box with a front that comes off, or a drum on legs."""
    look = Look.of(m)
    m.pick(_tower, _tower, _slab, _slab, _drum)(look)


def _tower(look: Look) -> None:
    """A round or square tower with slots, an open top with a fan, a ring or keys, a door at its back and a filter."""
    m, n = look.m, max(look.n, 16) if look.style != "prop" else 10
    r, high, square = m.number(0.1, 0.16), m.number(0.35, 0.75), m.chance(0.3)
    corner = 0.3 if square else 0.999

    def plan(s: float, h: float) -> np.ndarray:
        return outline((-s, s), (-s, s), corner * s, h, n // 3)

    rows = [(0.94, 0.0), (1.0, 0.015), (1.0, high - 0.03), (0.95, high), (0.8, high), (0.75, high - 0.08)]
    m.add(BASE, loft(np.array([plan(a * r, b) for a, b in rows])))
    hub = high - 0.05
    if m.chance(0.7):
        m.add("fan", lathe([(0.2 * r, -0.035), (0.22 * r, 0.0), (0.1 * r, 0.01)], n, (0, 0, hub)))
        blade = prism(
            [(0.15 * r, -0.01), (0.68 * r, -0.02), (0.68 * r, 0.02), (0.15 * r, 0.01)], "z", (hub - 0.012, hub - 0.008)
        )
        m.add("fan", *around(blade, m.pick(5, 7, 9)))
        m.spin("fan", (0, 0, hub), UP)
    _tower_top(look, r, high, square)
    low, up = 0.1 * high, m.number(0.5, 0.75) * high
    if square:
        look.front("cover", (-0.62 * r, 0.62 * r), (low, up), -r - 0.0005, look.depth(0.012))
        m.hinge("cover", (-0.62 * r, -r, low), (0, 0, -1), 100) if m.chance(0.5) else m.slide("cover", FRONT, 0.06)
        m.add(BASE, *(box((-r - 0.002, -r + 0.003), (-0.6 * r, 0.6 * r), (h, h + 0.006)) for h in np.arange(low, up, 0.025)))
    else:
        m.add(BASE, *(ring((0, 0, h), UP, r, 0.0035, n) for h in np.arange(low, up, m.pick(0.015, 0.03))))
        m.add("filter", lathe([(0.88 * r, -0.03), (0.88 * r, -0.0005), (0.8 * r, -0.0005)], n, (0, 0, 0)))
        m.slide("filter", (0, 0, -1), 0.3 * high)
    if m.chance(0.3):
        w, z = r + 0.004, high - 0.04
        m.add("handle", tube([(-w, 0, z), (-w, 0, z + 0.13), (w, 0, z + 0.13), (w, 0, z)], 0.006))
        m.hinge("handle", (0, 0, z), (1, 0, 0), (-80, 80))


def _tower_top(look: Look, r: float, high: float, square: bool) -> None:
    """What closes the tower: a grille, a ring that turns, or a plate on posts with keys."""
    m, n = look.m, max(look.n, 12)
    top = m.pick("grille", "ring", "plate")
    if top == "grille":
        m.add(
            BASE,
            *(ring((0, 0, high - 0.006), UP, q * r, 0.003, n) for q in (0.3, 0.5, 0.7)),
            *(
                rod(-0.82 * r * e, 0.82 * r * e, 0.003, 6).apply_translation((0, 0, high - 0.006))
                for e in (vec(1, 0, 0), vec(0, 1, 0))
            ),
        )
    elif top == "ring" and not square:
        m.add(
            "ring",
            lathe([(0.96 * r, 0.0005), (0.96 * r, 0.03), (0.8 * r, 0.034), (0.78 * r, 0.0005)], n, (0, 0, high)),
            box((0.82 * r, 0.92 * r), (-0.003, 0.003), (high + 0.028, high + 0.038)),
        )
        m.hinge("ring", (0, 0, high), UP, m.pick(270, 330))
    else:
        m.add(
            BASE,
            look.block((-0.55 * r, 0.55 * r), (-0.55 * r, 0.55 * r), (high + 0.012, high + 0.022), leave=""),
            *(
                rod((a, b, high - 0.075), (a, b, high + 0.014), 0.006, 8)
                for a in (-0.3 * r, 0.3 * r)
                for b in (-0.3 * r, 0.3 * r)
            ),
        )
        for k, a in enumerate((-0.25 * r, 0.0, 0.25 * r)[: m.pick(1, 2, 3)]):
            look.key(f"key_{k}", (a, -0.3 * r, high + 0.022), UP, (0.016, 0.016, 0.003))


def _slab(look: Look) -> None:
    """A flat upright body: a front cover over filters, a louvre on top, keys or dials, castors."""
    m, w = look.m, look.m.number(0.17, 0.23)
    deep, high, low = m.number(0.15, 0.22), m.number(0.45, 0.65), 0.03
    castors = m.chance(0.4)
    room = m.chance(0.6)
    x, y, z = (-w, w), (0.0, deep), (low, high)
    if room:
        m.add(BASE, *look.shell(x, y, z, (0.02, 0.02, 0.03, 0.09, 0.3 * deep)))
        for k in range(m.pick(1, 2)):
            begin = 0.006 + 0.25 * deep * k
            m.add(f"filter_{k}", box((-w + 0.022, w - 0.022), (begin, begin + 0.22 * deep), (low + 0.0305, high - 0.092)))
            m.add(f"filter_{k}", box((-0.03, 0.03), (begin - 0.004, begin), (low + 0.2, low + 0.23)))
            m.slide(f"filter_{k}", FRONT, 0.9 * deep)
    else:
        m.add(BASE, look.block(x, y, z))
    cover = ((-w + 0.008, w - 0.008), (low + 0.012, high - 0.06))
    look.front("cover", *cover, -0.0005, look.depth(0.014))
    style = m.pick("off", "left", "top", "bottom")
    if style == "off":
        m.slide("cover", FRONT, m.number(0.05, 0.1))
    elif style == "left":
        m.hinge("cover", (cover[0][0], -0.0005, low), (0, 0, -1), 100)
    else:
        m.hinge("cover", (0, -0.0005, cover[1][int(style == "top")]), (-1 if style == "top" else 1, 0, 0), m.pick(45, 70))
    if m.chance(0.5):
        m.add("louvre", look.block((-0.8 * w, 0.8 * w), (0.55 * deep, 0.9 * deep), (high + 0.0005, high + 0.008), leave=""))
        m.hinge("louvre", (0, 0.9 * deep, high), (-1, 0, 0), m.pick(45, 70))
    else:
        m.add(
            BASE,
            *(
                box((-0.8 * w, 0.8 * w), (b, b + 0.006), (high - 0.002, high + 0.004))
                for b in np.linspace(0.5 * deep, 0.9 * deep, 5)
            ),
        )
    dials = m.chance(0.3)
    for k, a in enumerate(np.linspace(-0.5 * w, 0.5 * w, m.pick(2, 3, 4))):
        at = (a, 0.25 * deep, high)
        look.dial(f"dial_{k}", at, UP, 0.016, 0.014) if dials and k == 0 else look.key(
            f"key_{k}", at, UP, (0.018, 0.018, 0.004)
        )
    for k, (a, b) in enumerate((a, b) for a in (-0.8 * w, 0.8 * w) for b in (0.03, deep - 0.03)):
        if castors:
            m.add(BASE, box((a - 0.008, a + 0.008), (b - 0.006, b + 0.006), (0.018, low + 0.002)))
            m.add(f"castor_{k}", rod((a - 0.012, b, 0.014), (a + 0.012, b, 0.014), 0.014, max(look.n, 10)))
            m.spin(f"castor_{k}", (a, b, 0.014), (1, 0, 0))
        else:
            m.add(BASE, rod((a, b, 0.0), (a, b, low + 0.002), 0.016, 8))


def _drum(look: Look) -> None:
    """A lying drum on a foot that tilts, with a grille, a fan behind it and a dial."""
    m, n = look.m, max(look.n, 16)
    r, deep, up = m.number(0.13, 0.18), m.number(0.1, 0.15), m.number(0.05, 0.09)
    c = vec(0, 0, r + up)
    m.add(BASE, look.block((-0.8 * r, 0.8 * r), (-0.9 * deep, 0.9 * deep), (0, 0.025)))
    m.add(
        BASE,
        *(
            look.block((s * (r + 0.012) - 0.006, s * (r + 0.012) + 0.006), (-0.02, 0.02), (0.0, c[2] + 0.02), leave="")
            for s in (-1, 1)
        ),
    )
    m.add(BASE, box((-r - 0.018, r + 0.018), (-0.02, 0.02), (0.0, 0.02)))
    shell = [(r, -deep / 2), (r, deep / 2), (0.9 * r, deep / 2), (0.88 * r, -deep / 2 + 0.03)]
    m.add("drum", lathe([(0.9 * r, -deep / 2 - 0.01), *shell], n, c, FRONT))
    m.add(
        "drum",
        rod(c - vec(r + 0.014, 0, 0), c - vec(0.98 * r, 0, 0), 0.012, n),
        rod(c + vec(0.98 * r, 0, 0), c + vec(r + 0.014, 0, 0), 0.012, n),
    )
    m.hinge("drum", c, (1, 0, 0), (-30, 45))
    face = c - vec(0, deep / 2 - 0.006, 0)
    m.add("drum", *(ring(face, FRONT, q * r, 0.003, n) for q in np.linspace(0.2, 0.85, m.pick(4, 6))))
    m.add("drum", *(rod(face - 0.91 * r * e, face + 0.91 * r * e, 0.003, 6) for e in (vec(1, 0, 0), vec(0, 0, 1))))
    hub = c - vec(0, deep / 2 - 0.035, 0)
    m.add("fan", lathe([(0.22 * r, -0.02), (0.22 * r, 0.01), (0.1 * r, 0.016)], n, hub, FRONT))
    blade = prism([(0.15 * r, -0.012), (0.8 * r, -0.03), (0.8 * r, 0.03), (0.15 * r, 0.012)], "z", (-0.002, 0.002))
    for piece in around(blade, m.pick(3, 5, 7)):
        piece.vertices = piece.vertices[:, [0, 2, 1]]
        piece.invert()
        m.add("fan", moved(piece, hub))
    m.spin("fan", hub, FRONT, "drum")
    m.add("drum", rod(hub + vec(0, 0.012, 0), c + vec(0, deep / 2 - 0.005, 0), 0.16 * r, n))
    look.dial("dial", (0, -0.68 * deep, 0.025), UP, 0.018, 0.014)
    if m.chance(0.5):
        m.add(
            "back_cover", lathe([(0.86 * r, 0.0105), (0.86 * r, 0.022), (0.4 * r, 0.03)], n, c + vec(0, deep / 2, 0), (0, 1, 0))
        )
        m.slide("back_cover", (0, 1, 0), 0.06, "drum")
