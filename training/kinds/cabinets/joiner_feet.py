"""What the joiner's furniture stands on and ends with: feet, legs, castors, tops, mouldings, rounded end shelves."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.joiner_style import Look, castor, moulding, open_box, parted, shrunk, slab, turned_post
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rod

# (radius, height) of turned feet and legs, of radius and height 1
FOOT = [(0, 0), (0.4, 0), (0.6, 0.1), (0.5, 0.25), (0.9, 0.5), (1, 0.65), (0.6, 0.8), (0.9, 0.9), (0.9, 1), (0, 1)]
LEG = [(0, 0), (0.5, 0), (0.7, 0.05), (0.5, 0.1), (0.9, 0.5), (0.6, 0.62), (1, 0.66), (0.7, 0.7), (1, 0.75), (1, 1), (0, 1)]
CORNICE = [(0, 0), (0.1, 0.2), (0.35, 0.3), (0.5, 0.6), (1, 0.8), (1, 1)]  # (overhang, height)


def feet(m: Model, look: Look, x: Span, y: Span, high: float, sort: str = "") -> None:
    """What a body whose underside is at `high` stands on."""
    if high <= 0:
        return
    modern = ("plinth", "tapered", "blocks", "sled", "runners", "frame", "gables")
    choices = ("plinth", "blocks", "turned", "bracket") if look.way == "old" else modern
    sort = sort or m.pick(*choices)
    e = 0.05
    inner_x, inner_y = shrunk(x, 0.03), shrunk(y, 0.03)
    corners = [(a, b) for a in (x[0] + e, x[1] - e) for b in (y[0] + e, y[1] - e)]
    if sort == "castors":
        for a, b in corners:
            castor(m, look, (a, b, high), high)
    elif sort == "plinth":
        m.add(BASE, box(inner_x, (y[0] + m.pick(0.0, 0.03, 0.06), inner_y[1]), (0, high)))
    elif sort == "blocks":
        m.add(BASE, *(box((a - 0.025, a + 0.025), (b - 0.025, b + 0.025), (0, high)) for a, b in corners))
    elif sort == "turned":
        m.add(BASE, *(turned_post((a, b, 0), [(0.034 * r, h * high) for r, h in FOOT], look.n) for a, b in corners))
    elif sort == "tapered":
        cone = [(0, 0), (0.011, 0), (0.02, high), (0, high)]
        m.add(BASE, *(turned_post((a, b, 0), cone, look.n) for a, b in corners))
    elif sort == "runners":
        m.add(BASE, *(box(s, y, (0, high)) for s in parted(shrunk(x, 0.02), (1, 12, 1), 0)[::2]))
    else:
        m.add(BASE, *{"bracket": _brackets, "sled": _sled, "frame": _frame, "gables": _gables}[sort](x, y, high))


def _brackets(x: Span, y: Span, high: float) -> list[Trimesh]:
    """Slanted feet at the corners, as on old chests."""
    spread = min(0.12, 0.3 * (x[1] - x[0]))
    shape = [(x[0], 0), (x[0] + 0.4 * spread, 0), (x[0] + spread, high), (x[0], high)]
    other = [(x[0] + x[1] - a, b) for a, b in shape[::-1]]
    found = [prism(o, "y", s) for o in (shape, other) for s in ((y[0], y[0] + 0.02), (y[1] - 0.02, y[1]))]
    return found + [box(s, shrunk(y, 0.02), (0.6 * high, high)) for s in ((x[0], x[0] + 0.02), (x[1] - 0.02, x[1]))]


def _sled(x: Span, y: Span, high: float) -> list[Trimesh]:
    """Two upright rectangles of bars."""
    depth = shrunk(y, 0.03)
    ends = ((depth[0], depth[0] + 0.02), (depth[1] - 0.02, depth[1]))
    found = []
    for a in (x[0] + 0.05, x[1] - 0.05):
        wide = (a - 0.01, a + 0.01)
        found += [box(wide, depth, s) for s in ((0, 0.015), (high - 0.015, high))]
        found += [box(wide, s, (0.015, high - 0.015)) for s in ends]
    return found


def _frame(x: Span, y: Span, high: float) -> list[Trimesh]:
    """Posts outside the body that carry it, tied by bars below."""
    t, tall = 0.022, high + 0.12
    ends = ((y[0] + 0.002, y[0] + 0.002 + t), (y[1] - t, y[1]))
    found = [box(a, b, (0, tall)) for a in ((x[0] - t, x[0]), (x[1], x[1] + t)) for b in ends]
    found += [box(x, b, (high - t, high)) for b in ends]
    return found + [box(a, (ends[0][1], ends[1][0]), (high - t, high)) for a in ((x[0] - t, x[0]), (x[1], x[1] + t))]


def _gables(x: Span, y: Span, high: float) -> list[Trimesh]:
    """Sides that reach the floor, with a board set back between them."""
    sides = [box(s, y, (0, high)) for s in ((x[0], x[0] + 0.02), (x[1] - 0.02, x[1]))]
    return [*sides, box(shrunk(x, 0.02), (y[0] + 0.05, y[0] + 0.066), (0.2 * high, high))]


def cornice(m: Model, look: Look, x: Span, y: Span, z: float) -> float:
    """What closes a body above, wider than it: a slab or a moulding; returns how high it ends."""
    high = look.wall + m.number(0.0, 0.015) if look.way != "sheet" else 0.02
    front = y[0] - (look.thick + 0.006 if not look.inset else 0.004)
    over = m.pick(0.0, 0.01, 0.025)
    a, b = shrunk(x, -over), (front - over, y[1])
    if look.way == "old" and m.chance(0.6):
        tall = m.number(0.03, 0.08)
        shape = [(0.04 * a, z + tall * h) for a, h in CORNICE]
        m.add(BASE, moulding(x, (front, y[1] - 0.04), shape))
        return z + tall
    m.add(BASE, slab(look, a, b, (z, z + high)))
    return z + high


def legs(m: Model, look: Look, x: Span, y: Span, z: Span, thick: float) -> None:
    """Four tall legs of a table or a desk: square, round, turned or tapered."""
    sort = m.pick("turned", "square") if look.way == "old" else m.pick("square", "round", "tapered")
    t, (low, high) = thick / 2, z
    for a in (x[0] + t, x[1] - t):
        for b in (y[0] + t, y[1] - t):
            if sort == "square":
                m.add(
                    BASE,
                    slab(look, (a - t, a + t), (b - t, b + t), z, "y")
                    if look.way != "sheet"
                    else open_box((a - t, a + t), (b - t, b + t), z, "+z-z"),
                )
            elif sort == "round":
                m.add(BASE, rod((a, b, low), (a, b, high), t, look.n))
            else:
                long = high - low
                shape = [(0, 0), (0.5 * t, 0), (t, long), (0, long)]
                if sort == "turned":
                    shape = [(r * t, h * long) for r, h in LEG]
                m.add(BASE, turned_post((a, b, low), shape, look.n))


def end_shelves(m: Model, look: Look, x: float, side: int, y: Span, z: Span) -> None:
    """Open shelves with a round front at one end of a body; side: -1 left of x, 1 right of it."""
    reach, deep = m.number(0.18, 0.3), y[1] - y[0]
    t = np.linspace(0, np.pi / 2, max(4, look.n // 2))
    outline = [(x, y[1]), *np.c_[x + side * reach * np.cos(t), y[1] - deep * np.sin(t)]]
    w = 0.018
    for a in np.linspace(z[0], z[1] - w, max(2, round((z[1] - z[0]) / m.number(0.25, 0.4)))):
        m.add(BASE, prism(outline, "z", (a, a + w)))
    m.add(BASE, box((x, x + side * reach), (y[1] - 0.006, y[1]), z))
