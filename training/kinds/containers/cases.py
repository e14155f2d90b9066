"""Steamer trunks, and the handles of cases."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely.geometry import Polygon

from training.kinds.containers.cartons import shell
from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import drawer, look
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, tube


def drop_handle(m: Model, name: str, side: int, x: float, z: float, size: float, still: bool, y: float = 0.0) -> None:
    """A handle on the left (side -1) or right end: a bail that hangs on a plate and swings up, or one that stays."""
    part, r, low = BASE if still else name, 0.06 * size, z - 0.5 * size
    out = x + side * m.number(0.008, 0.014)
    style = m.pick("plate", "dish", "loops")
    if style == "plate":
        m.add(BASE, box((x, x + side * 0.002), (y - 0.75 * size, y + 0.75 * size), (low - 0.2 * size, z + 0.3 * size)))
    elif style == "dish":
        frame = rectangle((y - 0.8 * size, y + 0.8 * size), (low - 0.25 * size, z + 0.3 * size), 0.12 * size)
        m.add(BASE, prism(frame, "x", (x, x + side * 0.006)))
    m.add(
        BASE,
        *(
            box((x, out + side * r), (b - 1.4 * r, b + 1.4 * r), (z - 1.4 * r, z + 1.4 * r))
            for b in (y - 0.55 * size, y + 0.55 * size)
        ),
    )
    m.add(
        part,
        tube(
            [(out, y - 0.55 * size, z), (out, y - 0.5 * size, low), (out, y + 0.5 * size, low), (out, y + 0.55 * size, z)], r, 6
        ),
    )
    if m.chance(0.6):
        m.add(part, rod((out, y - 0.3 * size, low), (out, y + 0.3 * size, low), 1.6 * r, m.sections()))
    if not still:
        m.hinge(name, (out, y, z), (0, -side, 0), m.pick(80, 90))


def _slats(m: Model, part: str, x: Span, y: Span, z: Span, at: list[float], top: bool) -> None:
    """Wooden strips upright on the front and the back, and across the top."""
    for c in at:
        a = (x[0] + c * (x[1] - x[0]) - 0.02, x[0] + c * (x[1] - x[0]) + 0.02)
        m.add(part, box(a, (y[0] - 0.008, y[0]), z), box(a, (y[1], y[1] + 0.008), z))
        if top:
            m.add(part, box(a, (y[0] - 0.008, y[1] + 0.008), (z[1], z[1] + 0.008)))


def _corners(m: Model, part: str, x: Span, y: Span, z: float, size: float, out: float) -> None:
    """Metal caps at four corners; out: up (1) or down (-1), where the caps cover."""
    for a, s in ((x[0], 1), (x[1], -1)):
        for b, t in ((y[0], 1), (y[1], -1)):
            m.add(part, box((a - 0.004 * s, a + size * s), (b - 0.004 * t, b + size * t), (z + 0.004 * out, z - size * out)))


def _trunk_lid(m: Model, x: Span, y: Span, z: Span, slats: list[float]) -> None:
    """A flat hollow lid, or one that is round over its depth."""
    if m.chance(0.55):
        shell(m, "lid", x, y, z, 0.012, -1)
        _slats(m, "lid", x, y, z, slats, True)
        _corners(m, "lid", x, y, z[1], 0.05, 1)
        return
    t = np.linspace(0, np.pi, m.pick(7, 11, 15))
    half, rise, low = (y[1] - y[0]) / 2, z[1] - z[0], z[0] + 0.25 * (z[1] - z[0])

    def outline(by: float) -> Polygon:
        bow = np.c_[(half + by) * np.cos(t), low + (0.75 * rise + by) * np.sin(t)]
        return Polygon([(half + by, z[0]), *bow, (-half - by, z[0])])

    solid = prism(outline(0), "x", x)
    m.add("lid", cut(solid, prism(outline(-0.012), "x", shrunk(x, 0.012))) if m.chance(0.7) else solid)
    for c in [0.01, *slats, 0.99]:
        a = x[0] + c * (x[1] - x[0])
        m.add("lid", prism(outline(0.008).difference(outline(-0.001)), "x", (a - 0.02, a + 0.02)))


def _hasps(m: Model, x: Span, front: float, z: float) -> None:
    """A hasp that hangs from the lid, catches that fold down from the body, and the lock's plate."""
    if m.chance(0.8):
        m.add(BASE, box((-0.035, 0.035), (front - 0.003, front), (z - 0.09, z - 0.012)))
        m.add("hasp", box((-0.022, 0.022), (front - 0.013, front - 0.009), (z - 0.06, z + 0.03)))
        m.add("hasp", rod((-0.022, front - 0.011, z + 0.03), (0.022, front - 0.011, z + 0.03), 0.006, 8))
        m.add("lid", box((-0.03, 0.03), (front - 0.009, front), (z + 0.012, z + 0.045)))
        m.hinge("hasp", (0, front - 0.011, z + 0.03), (-1, 0, 0), m.pick(90, 120), "lid")
    for k, c in enumerate(m.pick((), (-0.3, 0.3), (-0.34, 0.34))):
        a = c * (x[1] - x[0])
        m.add(f"catch_{k}", box((a - 0.016, a + 0.016), (front - 0.014, front - 0.008), (z - 0.05, z + 0.016)))
        m.add(BASE, box((a - 0.022, a + 0.022), (front - 0.008, front), (z - 0.07, z - 0.01)))
        m.add(
            m.pick(BASE, f"catch_{k}"), rod((a - 0.02, front - 0.011, z - 0.05), (a + 0.02, front - 0.011, z - 0.05), 0.005, 8)
        )
        m.hinge(f"catch_{k}", (a, front - 0.011, z - 0.05), (1, 0, 0), m.pick(90, 140))


def steamer_trunk(m: Model) -> None:
    """A travel trunk: lying with a flat or round lid, hasp and catches, or upright, opening like a book on drawers."""
    if m.chance(0.35):
        _wardrobe_trunk(m)
        return
    wide, deep, high, rise = m.number(0.7, 1.1), m.number(0.4, 0.55), m.number(0.28, 0.42), m.number(0.1, 0.22)
    x, y, foot = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.pick(0.0, 0.03)
    top, g = foot + high, m.pick(0.0, 0.001, 0.003)
    shell(m, BASE, x, y, (foot, top), 0.012)
    slats = m.pick([], [0.25, 0.75], [0.18, 0.82], [0.2, 0.5, 0.8])
    _slats(m, BASE, x, y, (foot, top), [c for c in slats if c != 0.5], False)
    _trunk_lid(m, x, y, (top + g, top + rise), slats)
    m.hinge("lid", (0, y[1], top), (-1, 0, 0), m.pick(80, 95, 110))
    _corners(m, BASE, x, y, foot, 0.05, -1)
    if m.chance(0.6):
        m.add(BASE, prism(rectangle(shrunk(x, -0.003), shrunk(y, -0.003), 0.004), "z", (top - 0.03, top)))
    _hasps(m, x, y[0], top)
    still = m.chance(0.4)
    for name, s in (("handle_left", -1), ("handle_right", 1)):
        drop_handle(m, name, s, s * wide / 2, foot + 0.7 * high, m.number(0.09, 0.12), still)
    if m.chance(0.5):
        shell(m, BASE, shrunk(x, 0.02), shrunk(y, 0.02), (top - 0.1, top - 0.01), 0.006, 1, "boards")
        m.add(BASE, box((0.1, 0.106), shrunk(y, 0.026), (top - 0.09, top - 0.01)))
    if foot:
        m.add(BASE, *(box((a - 0.03, a + 0.03), shrunk(y, 0.02), (0, foot)) for a in shrunk(x, 0.08)))


def _wardrobe_trunk(m: Model) -> None:
    """A trunk that stands: its front half swings aside; drawers in the back half, a rail with hangers in the front."""
    wide, deep, high, w, foot = m.number(0.5, 0.65), m.number(0.26, 0.34), m.number(0.95, 1.2), 0.014, 0.025
    x, z, s = (-wide / 2, wide / 2), (foot, high), m.pick(-1, 1)
    inner, up = shrunk(x, w), shrunk(z, w)
    m.add(BASE, cut(box(x, (0, deep), z), box(inner, (-1, deep - w), up)))
    g = m.pick(0.0, 0.002)
    m.add("front", cut(box(x, (-deep, -g), z), box(inner, (-deep + w, 1), up)))
    m.hinge("front", (s * wide / 2, 0, high / 2), (0, 0, s), m.pick(90, 120, 160))
    how = replace(look(m, 0.3, ("slab", "slab", "raised", "shaker"), ("bar", "knob", "recess", "cup")), sunk=0.008, length=0.25)
    count, split = m.pick(3, 4, 5), m.pick(1.0, 1.0, 0.6)
    edge = inner[0] + split * (inner[1] - inner[0])
    levels = np.linspace(up[0], up[1] - m.pick(0.0, 0.25), count + 1)
    for k in range(count):
        drawer(
            m,
            f"drawer_{k}",
            (inner[0] + 0.003, edge - 0.003),
            (levels[k] + 0.004, levels[k + 1] - 0.004),
            deep - w,
            how,
            m.pick("box", "tub"),
        )
        m.add(BASE, box((inner[0], edge), (0.01, deep - w), (levels[k + 1] - 0.003, levels[k + 1] + 0.003)))
    if split < 1:
        m.add(BASE, box((edge - 0.003, edge + 0.006), (0.004, deep - w), up))
    m.add("front", rod((inner[0], -deep / 2, up[1] - 0.05), (inner[1], -deep / 2, up[1] - 0.05), 0.008, 8))
    for a in np.linspace(inner[0] + 0.08, inner[1] - 0.08, m.pick(0, 3, 5)):
        coat = [(-deep + 0.03, up[1] - 0.16), (-deep / 2, up[1] - 0.06), (-0.02, up[1] - 0.16)]
        m.add("front", prism(coat, "x", (a - 0.006, a + 0.006)))
    if m.chance(0.5):
        m.add("front", box(inner, (-deep + w, -0.02), (up[0], up[0] + 0.15)))
    _wardrobe_trims(m, x, deep, z, -s)
    m.add(BASE, *(box((a - 0.03, a + 0.03), (0.03, deep - 0.03), (0, foot)) for a in shrunk(x, 0.07)))


def _wardrobe_trims(m: Model, x: Span, deep: float, z: Span, side: int) -> None:
    """Corners, strips, a handle on top, and catches on the side that opens."""
    for part, y in ((BASE, (0.001, deep)), ("front", (-deep, -0.001))):
        far = (y[1] - 0.06, y[1] + 0.004) if part == BASE else (y[0] - 0.004, y[0] + 0.06)
        m.add(
            part,
            *(
                box(shrunk(a, 0), far, (c - 0.004, c + 0.06) if c == z[0] else (c - 0.06, c + 0.004))
                for a in ((x[0] - 0.004, x[0] + 0.06), (x[1] - 0.06, x[1] + 0.004))
                for c in z
            ),
        )
        for c in m.pick((0.33, 0.67), (0.5,), ()):
            at = z[0] + c * (z[1] - z[0])
            face = (y[1], y[1] + 0.008) if part == BASE else (y[0] - 0.008, y[0])
            m.add(part, box(x, face, (at - 0.025, at + 0.025)))
    a = side * x[1]
    for k, c in enumerate(m.pick((0.5,), (0.25, 0.75), (0.2, 0.5, 0.8))):
        at = z[0] + c * (z[1] - z[0])
        m.add(f"catch_{k}", box((a + side * 0.006, a + side * 0.012), (-0.035, 0.03), (at - 0.016, at + 0.016)))
        m.add(BASE, box((a, a + side * 0.006), (0.012, 0.05), (at - 0.02, at + 0.02)))
        m.add("front", box((a, a + side * 0.006), (-0.045, -0.012), (at - 0.012, at + 0.012)))
        m.hinge(f"catch_{k}", (a + side * 0.009, 0.03, at), (0, 0, side), m.pick(90, 130))
    if m.chance(0.7):
        path = [
            (-0.09, deep / 2, z[1]),
            (-0.08, deep / 2, z[1] + 0.035),
            (0.08, deep / 2, z[1] + 0.035),
            (0.09, deep / 2, z[1]),
        ]
        m.add(BASE, tube(path, 0.008, 6))
