"""Popcorn machines."""

from __future__ import annotations

import numpy as np

from training.kinds.counter.counter_appliances import bar
from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import drawer, look
from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import glazed, middle, pane
from training.kinds.solids import Span, ball, box, cut, loft, prism, ring, rod, vec


def popcorn_machine(m: Model) -> None:
    """Make a popcorn machine: a glazed box with one or two doors and a kettle that tips; on a counter or a cart with wheels."""
    w, d, tall = m.number(0.38, 0.55), m.number(0.32, 0.42), m.number(0.4, 0.5)
    style = m.pick("counter", "counter", "cart", "stand")
    low = m.number(0.06, 0.14) if style == "counter" else m.number(0.68, 0.78)
    plinth = low - (0.0 if style == "counter" else 0.1)
    counter = style == "counter"
    foot = box((-0.005, w + 0.005), (0 if counter else -0.005, d + 0.005), (0.012 if counter else plinth, low))
    slot, drawn = ((0.25 * w, 0.75 * w), (0.025, low - 0.015)), counter and low > 0.09 and m.chance(0.7)
    m.add(BASE, cut(foot, box(slot[0], (-1, 0.85 * d), slot[1])) if drawn else foot)
    _popcorn_foot(m, style, w, d, plinth)
    top, post = low + tall, m.pick(0.012, 0.02)
    m.add(BASE, *(box((a, a + post), (b, b + post), (low, top)) for a in (0, w - post) for b in (0, d - post)))
    for a in (0.3 * post, w - 0.7 * post) if m.chance(0.8) else ():
        m.add(BASE, box((a, a + 0.004), (post, d - post), (low, top)))
    back = m.pick("doors", "back")
    room = (post, w - post), (low + 0.05, top)
    m.add(BASE, box(room[0], (0.004, 0.012), (low, low + 0.05)))
    face = (0.0, 0.01) if m.chance(0.7) else (-0.012, -0.002)
    _popcorn_doors(m, room[0], face, room[1])
    m.add(
        BASE,
        pane(m, room[0], (d - 0.01, d - 0.004), (low, top))
        if back == "doors"
        else box(room[0], (d - 0.012, d - 0.002), (low, top)),
    )
    _popcorn_roof(m, w, d, top)
    _popcorn_kettle(m, w, d, low, top)
    if drawn:
        how = look(m, w, ("slab", "rounded"), ("knob", "bar", "rim"))
        drawer(m, "drawer", *slot, 0.8 * d, how, m.pick("box", "tub"))
    if m.chance(0.6):
        m.add(BASE, box((0.15 * w, 0.85 * w), (0.03, d - 0.03), (low, low + m.number(0.005, 0.015))))


def _popcorn_doors(m: Model, x: Span, y: Span, z: Span) -> None:
    both, c, width = m.chance(0.55), m.pick(0.0, 0.002), m.pick(0.0, 0.012, 0.02)
    spans = [(x[0], middle(x)), (middle(x), x[1])] if both else [x]
    for k, a in enumerate(spans):
        side = "left" if (k == 0 and both) or (not both and m.chance(0.5)) else "right"
        part, a, b = f"door_{side}" if both else "door", shrunk(a, c), shrunk(z, c)
        if width:
            glazed(m, part, a, y, b, width)
        else:
            m.add(part, box(a, (middle(y) - 0.003, middle(y) + 0.003), b))
        edge, hinge = (a[1] - 0.018, a[0]) if side == "left" else (a[0] + 0.018, a[1])
        mid, half = middle(b), m.number(0.02, 0.06)
        if m.chance(0.5):
            m.add(
                part,
                rod((edge, y[0], mid), (edge, y[0] - 0.02, mid), 0.005, 8),
                ball((edge, y[0] - 0.022, mid), (0.01,) * 3, 10),
            )
        else:
            ends = [vec(edge, y[0] + 0.002, mid + s * half) for s in (-1, 1)]
            m.add(part, bar([ends[0], ends[0] - vec(0, 0.025, 0), ends[1] - vec(0, 0.025, 0), ends[1]], 0.004, 6))
        m.add(
            m.pick(part, BASE),
            *(rod((hinge, y[0], q - 0.015), (hinge, y[0], q + 0.015), 0.005, 8) for q in (b[0] + 0.05, b[1] - 0.05)),
        )
        m.hinge(part, (hinge, y[0], mid), (0, 0, -1 if side == "left" else 1), m.pick(90, 110, 130))


def _popcorn_roof(m: Model, w: float, d: float, top: float) -> None:
    style, h = m.pick("awning", "box", "pyramid", "sign"), m.number(0.05, 0.09)
    m.add(BASE, box((-0.01, w + 0.01), (-0.01, d + 0.01), (top, top + 0.02)))
    z = top + 0.02
    if style == "awning":
        m.add(BASE, prism([(-0.05, z), (d, z), (d, z + h), (0.1, z + h)], "x", (0, w)))
        m.add(BASE, *(box((k * w / 6, (k + 0.5) * w / 6), (-0.052, -0.03), (z - 0.02, z + 0.002)) for k in range(6)))
    elif style == "pyramid":
        rings = [[(a, b, z), (w - a, b, z), (w - a, d - b, z), (a, d - b, z)] for a, b in ((0, 0), (0.3 * w, 0.3 * d))]
        rings[1] = [(x, y, z + h) for x, y, _ in rings[1]]
        m.add(BASE, loft(np.array(rings, float)), ball((w / 2, d / 2, z + h + 0.01), (0.015,) * 3, 10))
    else:
        m.add(BASE, box((0.02, w - 0.02), (0.02, d - 0.02), (z, z + h)))
    if style == "sign":
        m.add(BASE, prism([(0.1 * w, z), (0.9 * w, z), (0.8 * w, z + 1.8 * h), (0.2 * w, z + 1.8 * h)], "y", (0.0, 0.012)))
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                box((0.6 * w + c, 0.6 * w + c + 0.02), (0.01 if style != "awning" else 0.0, 0.024), (top + 0.004, top + 0.016))
                for c in (0, 0.04)
            ),
        )


def _popcorn_kettle(m: Model, w: float, d: float, low: float, top: float) -> None:
    r, n, x, y = m.number(0.075, 0.09), m.pick(12, 16, 24), w * m.pick(0.4, 0.5, 0.6), 0.52 * d
    z, tall = top - m.number(0.1, 0.13), m.number(0.07, 0.09)
    m.add(BASE, box((x - r - 0.03, x + r + 0.03), (y - 0.016, y + 0.016), (top - 0.02, top)))
    m.add(
        BASE,
        *(
            box((x + s * (r + 0.02) - 0.006, x + s * (r + 0.02) + 0.006), (y - 0.008, y + 0.008), (z - 0.03, top))
            for s in (-1, 1)
        ),
    )
    wall = [(0.9 * r, z - tall), (r, z - tall + 0.015), (r, z)]
    m.add("kettle", lathe([*wall, (r - 0.004, z), (r - 0.005, z - tall + 0.012)] if m.chance(0.7) else wall, n, (x, y, 0)))
    pivot = vec(x, y, z - 0.02)
    m.add("kettle", *(rod(pivot + vec(s * 0.97 * r, 0, 0), pivot + vec(s * (r + 0.03), 0, 0), 0.007, 10) for s in (-1, 1)))
    grip = pivot + vec(r + 0.03, 0, 0)
    m.add(
        "kettle",
        bar([grip, grip + vec(0.012, 0, 0), grip + vec(0.012, -0.04, -0.05)], 0.005, 6),
        ball(grip + vec(0.012, -0.042, -0.052), (0.011,) * 3, 10),
    )
    m.hinge("kettle", pivot, (1, 0, 0), m.pick(90, 110))
    for s, name in ((-1, "flap_front"), (1, "flap_back")) if m.chance(0.5) else ():
        t = np.linspace(0, np.pi, 9) if s > 0 else np.linspace(np.pi, 2 * np.pi, 9)
        half = np.c_[x + 0.98 * r * np.cos(t), y + s * 0.002 + 0.98 * r * np.sin(t)]
        m.add(name, prism(half, "z", (z + 0.001, z + 0.005)))
        m.hinge(name, (x, y + s * 0.002, z + 0.003), (s, 0, 0), m.pick(40, 55), "kettle")


def _popcorn_foot(m: Model, style: str, w: float, d: float, plinth: float) -> None:
    if style == "counter":
        m.add(BASE, *(rod((a, b, 0), (a, b, 0.014), 0.014, 10) for a in (0.04, w - 0.04) for b in (0.04, d - 0.04)))
        return
    if style == "stand":
        m.add(BASE, *(box((a, a + 0.025), (b, b + 0.025), (0, plinth)) for a in (0, w - 0.025) for b in (0, d - 0.025)))
        m.add(BASE, box((0.01, w - 0.01), (0.01, d - 0.01), (0.2, 0.22)))
        return
    m.add(BASE, box((0.0, w), (0.0, d), (0.34, plinth)))
    m.add(BASE, *(box((a, a + 0.022), (0.0, 0.022), (0, 0.34)) for a in (0.0, w - 0.022)))
    m.add(
        BASE,
        rod((-0.05, d - 0.08, 0.2), (w + 0.05, d - 0.08, 0.2), 0.008, 10),
        *(box((a, a + 0.02), (d - 0.095, d - 0.065), (0.19, 0.36)) for a in (0.01, w - 0.03)),
    )
    spokes = m.pick(6, 8, 10)
    for name, x in (("wheel_left", -0.035), ("wheel_right", w + 0.035)):
        at = vec(x, d - 0.08, 0.2)
        m.add(name, ring(at, (1, 0, 0), 0.19, 0.01, 28), rod(at - vec(0.014, 0, 0), at + vec(0.014, 0, 0), 0.022, 12))
        m.add(
            name,
            *(
                rod(at, at + 0.19 * vec(0, np.cos(t), np.sin(t)), 0.005, 6)
                for t in np.linspace(0, 2 * np.pi, spokes, endpoint=False)
            ),
        )
        m.spin(name, at, (1, 0, 0))
    y = d + 0.12
    m.add(
        BASE,
        bar(
            [(0.03, d, plinth - 0.03), (0.03, y, plinth + 0.02), (w - 0.03, y, plinth + 0.02), (w - 0.03, d, plinth - 0.03)],
            0.009,
            8,
        ),
    )
