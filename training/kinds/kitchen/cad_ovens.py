"""Microwave ovens as several artists model them: of boards, of sheets, cut from a block; a door at the side or a flap."""

from __future__ import annotations

import numpy as np

from training.kinds.cad_style import (
    bar,
    bevelled,
    bolt,
    convention,
    knob,
    lathed,
    open_box,
    rounds,
    sheet,
    upright_pillow,
    upright_slab,
)
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, around, box, cut, prism, rectangle, rod, tube, vec

Hole = tuple[Span, Span]


def _shell(m: Model, style: str, w: float, d: float, h: float, hole: Hole, back: float) -> None:
    """The body round the cavity that opens to the front between spans along x and z."""
    (a, b), (low, high) = hole
    if style in ("hollow", "product", "antique"):
        whole = (0, w), (0, d), (0, h)
        block = upright_pillow(*whole, 0.02) if style == "product" else bevelled(*whole, 0.004)
        m.add(BASE, cut(block, box((a, b), (-1, back), (low, high))))
    elif style == "sheet":
        m.add(BASE, open_box((0, w), (0, d), (0, h), "-y"))
        outer, inner = [(0, 0), (w, 0), (w, h), (0, h)], [(a, low), (b, low), (b, high), (a, high)]
        rim = [[(*outer[k - 1],), (*outer[k],), (*inner[k],), (*inner[k - 1],)] for k in range(4)]
        m.add(BASE, sheet(*[[(x, 0, z) for x, z in loop] for loop in rim]))
        if m.chance(0.7):
            m.add(BASE, open_box((a, b), (0, back), (low, high), "-y"))
    else:
        t = 0.004
        m.add(BASE, box((0, w), (0, d), (0, t)), box((0, w), (0, d), (h - t, h)), box((t, w - t), (d - t, d), (t, h - t)))
        m.add(BASE, *(box(x, (0, d - t), (t, h - t)) for x in ((0, t), (w - t, w))))
        m.add(BASE, prism(rectangle((t, w - t), (t, h - t), (a - t, w - t - b, low - t, h - t - high)), "y", (0.0, 0.01)))
        m.add(BASE, box((a, b), (0.01, back), (low - t, low)), box((a, b), (0.01, back), (high, high + t)))
        m.add(
            BASE,
            *(box(x, (0.01, back), (low, high)) for x in ((a - t, a), (b, b + t))),
            box((a, b), (back, back + t), (low, high)),
        )
        if style == "assembly":
            spots = [(x, y) for x in (0.1 * w, 0.9 * w) for y in (0.2 * d, 0.8 * d)]
            m.add(BASE, *(s for x, y in spots for s in bolt((x, y, h), (0, 0, 1), 0.004)))


def _door(m: Model, style: str, x: Span, z: Span, sunk: float, flap: bool, left: bool, n: int) -> None:
    """The door with its window and handle; hung at a side, or below as a flap."""
    thick = m.number(0.015, 0.03)
    y = (-thick + sunk, -0.0008 + sunk)
    frame = m.number(0.03, 0.06)
    glass = box((x[0] + frame, x[1] - frame), (y[0] + 0.3 * thick, y[0] + 0.5 * thick), (z[0] + frame, z[1] - frame))
    if style == "sheet":
        m.add(
            "door",
            open_box(x, y, z, "+y")
            if m.chance(0.5)
            else sheet([(a, y[0], b) for a, b in ((x[0], z[0]), (x[1], z[0]), (x[1], z[1]), (x[0], z[1]))]),
        )
        m.add(
            "door",
            sheet(
                [
                    (a, y[0] - 0.001, b)
                    for a, b in (
                        (x[0] + frame, z[0] + frame),
                        (x[1] - frame, z[0] + frame),
                        (x[1] - frame, z[1] - frame),
                        (x[0] + frame, z[1] - frame),
                    )
                ]
            ),
        )
    elif style == "prop":
        m.add("door", upright_slab(style, x, y, z))
        m.add("door", box((x[0] + frame, x[1] - frame), (y[0] - 0.001, y[0] + 0.001), (z[0] + frame, z[1] - frame)))
    elif style == "assembly":
        m.add("door", prism(rectangle(x, z, frame), "y", y), glass)
        m.add(
            "door",
            box((x[0] + 0.5 * frame, x[1] - 0.5 * frame), (y[1] - 0.003, y[1]), (z[0] + 0.5 * frame, z[1] - 0.5 * frame)),
        )
    else:
        leaf = upright_slab(style, x, y, z)
        m.add(
            "door", cut(leaf, box((x[0] + frame, x[1] - frame), (-1, y[0] + 0.4 * thick), (z[0] + frame, z[1] - frame))), glass
        )
    _grip(m, style, x, y[0], z, flap, left, n)
    if flap:
        m.hinge("door", ((x[0] + x[1]) / 2, y[1], z[0]), (1, 0, 0), m.pick(85, 90))
    else:
        side = x[0] if left else x[1]
        m.hinge("door", (side, y[0] if sunk else y[1], (z[0] + z[1]) / 2), (0, 0, -1 if left else 1), m.pick(95, 110, 120))


def _grip(m: Model, style: str, x: Span, y: float, z: Span, flap: bool, left: bool, n: int) -> None:
    """A bar, a bow or none, away from the hinges."""
    form = m.pick("bar", "bow", "none") if style != "assembly" else m.pick("bar", "bow")
    if form == "none":
        return
    inset = 0.02
    if flap:
        a, b = vec(x[0] + 0.2 * (x[1] - x[0]), y, z[1] - inset), vec(x[1] - 0.2 * (x[1] - x[0]), y, z[1] - inset)
    else:
        at = x[1] - inset if left else x[0] + inset
        a, b = vec(at, y, z[0] + 0.15 * (z[1] - z[0])), vec(at, y, z[1] - 0.15 * (z[1] - z[0]))
    out = vec(0, -m.number(0.02, 0.035), 0)
    if form == "bow":
        m.add("door", tube([a - 0.1 * out, a + out, b + out, b - 0.1 * out], 0.006, 6 if style == "prop" else 10))
        return
    u = (b - a) / np.linalg.norm(b - a)
    m.add(
        "door",
        bar(a + out, b + out, 0.014, 0.01, (0, 1, 0)) if style in ("prop", "hollow") else rod(a + out, b + out, 0.007, n),
    )
    m.add("door", *(rod(p + s * 0.02 * u - 0.1 * out, p + s * 0.02 * u + out, 0.005, 8) for p, s in ((a, 1), (b, -1))))


def _panel(m: Model, style: str, x: Span, z: Span, y: float, n: int) -> None:
    """Display, keys, dials, and the key that frees the door."""
    wide, mid = x[1] - x[0], (x[0] + x[1]) / 2
    top = z[1] - 0.02
    if style != "hollow":
        m.add(BASE, upright_slab("assembly" if style == "product" else style, x, (y - 0.012, y), z))
        y -= 0.012
    if m.chance(0.7):
        m.add(BASE, box((x[0] + 0.15 * wide, x[1] - 0.15 * wide), (y - 0.001, y + 0.002), (top - 0.03, top)))
        top -= 0.045
    low = z[0] + 0.02
    if m.chance(0.6):
        m.add(
            "door_button",
            upright_slab(style, (x[0] + 0.15 * wide, x[1] - 0.15 * wide), (y - 0.005, y + 0.001), (low, low + 0.03)),
        )
        m.slide("door_button", (0, 1, 0), 0.004)
        low += 0.045
    dials = m.chance(0.4)
    if dials:
        count = m.pick(1, 2, 2)
        for k, h in enumerate(np.linspace(low, top, 2 * count + 1)[1::2]):
            r = min(0.32 * wide, 0.35 * (top - low) / count)
            m.add(f"dial_{k}", *knob(style, (mid, y + 0.001, h), (0, -1, 0), r, 0.018, n))
            m.spin(f"dial_{k}", (mid, y, h), (0, -1, 0))
        return
    rows, across = m.pick(3, 4, 5, 6), m.pick(2, 3, 3)
    pitch, rise = 0.8 * wide / across, (top - low) / rows
    for k in range(rows * across):
        a, b = x[0] + 0.1 * wide + (k % across) * pitch, low + (k // across) * rise
        part = (a + 0.1 * pitch, a + 0.9 * pitch), (y - 0.0025, y + 0.001), (b + 0.15 * rise, b + 0.85 * rise)
        m.add(f"key_{k}", box(*part) if style in ("assembly", "hollow") else upright_slab(style, *part))
        m.slide(f"key_{k}", (0, 1, 0), 0.002)


def microwave_oven(m: Model) -> None:
    """A cavity with a glass plate that turns, a door at the left or a flap, keys or dials."""
    style = convention(m)
    n, w, d, h = rounds(m, style), m.number(0.42, 0.56), m.number(0.3, 0.42), m.number(0.24, 0.34)
    flap = m.chance(0.2)
    left = flap or m.chance(0.85)
    strip = m.number(0.05, 0.07) if flap else m.number(0.09, 0.14)
    edge = 0.02
    if flap:
        hole = ((edge + 0.02, w - edge - 0.02), (edge, h - strip - edge))
        door, panel = ((0.003, w - 0.003), (0.003, h - strip)), ((0.003, w - 0.003), (h - strip + 0.003, h - 0.003))
    else:
        hole = ((edge + 0.02, w - strip - edge), (edge + 0.01, h - edge - 0.01))
        door, panel = ((0.002, w - strip), (0.003, h - 0.003)), ((w - strip + 0.003, w - 0.002), (0.003, h - 0.003))
        if not left:
            hole, door, panel = (((w - s[0][1], w - s[0][0]), s[1]) for s in (hole, door, panel))
    back = m.number(0.8, 0.92) * d
    _shell(m, style, w, d, h, hole, back)
    _door(m, style, *door, 0.0, flap, left, n)
    if flap:
        _flap_panel(m, style, *panel, n)
    else:
        _panel(m, style, *panel, 0.0, n)
    mid = vec(sum(hole[0]) / 2, 0.5 * back, hole[1][0])
    if m.chance(0.7):
        r = 0.42 * min(hole[0][1] - hole[0][0], back)
        dish = [(0, 0.006), (0.9 * r, 0.006), (r, 0.014), (0.97 * r, 0.016), (0.88 * r, 0.01), (0, 0.01)]
        m.add(
            "turntable",
            lathed(dish if style != "sheet" else dish[:3], max(n, 12), mid),
            rod(mid, mid + vec(0, 0, 0.007), 0.012, 8),
        )
        m.add(
            "turntable",
            *(s.apply_translation(mid) for s in around(box((0.3 * r, 0.32 * r), (-0.005, 0.005), (0.001, 0.0065)), 3)),
        )
        m.spin("turntable", mid, (0, 0, 1))
    if m.chance(0.6):
        spots = [(x, y) for x in (0.1 * w, 0.9 * w) for y in (0.12 * d, 0.88 * d)]
        m.add(BASE, *(rod((x, y, -0.012), (x, y, 0.001), 0.014, n) for x, y in spots))
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                box((w - 0.001, w + 0.0015), (0.3 * d + 0.012 * k, 0.306 * d + 0.012 * k), (0.55 * h, 0.8 * h))
                for k in range(8)
            ),
        )


def _flap_panel(m: Model, style: str, x: Span, z: Span, n: int) -> None:
    """A strip above a flap with dials or a row of keys."""
    m.add(BASE, box(x, (-0.012, 0), z))
    mid, r = (z[0] + z[1]) / 2, 0.35 * (z[1] - z[0])
    m.add(BASE, box((0.4 * x[1], 0.6 * x[1]), (-0.013, -0.01), (mid - 0.6 * r, mid + 0.6 * r)))
    for k, f in enumerate(m.pick((0.15, 0.85), (0.85,), (0.1, 0.25, 0.75, 0.9))):
        m.add(f"dial_{k}", *knob(style, (f * x[1], -0.011, mid), (0, -1, 0), 0.9 * r, 0.018, n))
        m.spin(f"dial_{k}", (f * x[1], -0.012, mid), (0, -1, 0))
