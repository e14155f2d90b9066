"""Chests and boxes by another artist: flat, skirted and arched lids, pairs of flaps."""

from __future__ import annotations

from training.kinds.model import BASE, Model
from training.kinds.prop_fronts import legs
from training.kinds.prop_style import Style, bevelled, block, draw_style, grip, sheet
from training.kinds.solids import Span, arch, box, cut, prism, tube, vec


def lidded_chest(m: Model) -> None:
    """A box with a lid at its back edge, an arched treasure chest, or a box under two flaps or half a lid."""
    s = draw_style(m)
    wide = m.number(0.25, 1.2)
    deep, high = wide * m.number(0.4, 0.9), wide * m.number(0.3, 0.75)
    w = min(0.025, 0.04 * wide) * m.number(0.6, 1.2)
    x, y, foot = (0.0, wide), (0.0, deep), m.pick(0.0, 0.03, 0.06)
    z = (foot, foot + high)
    _chest_body(s, x, y, z, w)
    legs(s, x, y, z[0], m.pick("blocks", "turned", "runners", "plinth"))
    design = m.pick("slab", "slab", "arch", "arch", "cap", "flaps", "half")
    if design == "arch":
        _arched_lid(s, x, y, z[1], w)
    elif design == "cap":
        g, skirt = max(0.001, m.gap(0.3)), m.number(0.06, 0.3) * high
        outer, deeper = (x[0] - g - w, x[1] + g + w), (y[0] - g - w, y[1] + g + w)
        lid = block(s, outer, deeper, (z[1] - skirt, z[1] + w), "d")
        hole = box((x[0] - g, x[1] + g), (y[0] - g, y[1] + g), (z[1] - 1, z[1] + 0.0005))
        s.put("lid", lid if s.way == "sheet" else cut(lid, hole))
        m.hinge("lid", (wide / 2, deeper[1], z[1] - skirt), (-1, 0, 0), m.pick(80, 100))
    elif design == "slab":
        over = m.pick(0.0, 0.0, w, -w) if s.way != "low" or s.inside else m.pick(0.0, w)
        top = (z[1], z[1] + 1.2 * w) if over >= 0 else (z[1] - 1.2 * w, z[1] + 0.001)
        s.put("lid", block(s, (x[0] - over, x[1] + over), (y[0] - over, y[1] - max(0, -over)), top, "d"))
        if over >= 0:
            s.put("lid", *grip(s, (wide / 2, y[0] - over, top[0] + 0.6 * w), min(0.12, 0.2 * wide), False)[:3])
        m.hinge("lid", (wide / 2, y[1] - max(0, -over), top[1] if over < 0 else top[0]), (-1, 0, 0), m.pick(80, 95, 110))
    else:
        _flaps(s, x, y, (z[1], z[1] + w), design == "half")
    _chest_trims(s, x, y, z)


def _chest_body(s: Style, x: Span, y: Span, z: Span, w: float) -> None:
    inner = (x[0] + w, x[1] - w)
    if s.way == "sheet":
        s.m.add(BASE, sheet(x, y, z, "u"))
    elif s.way == "cad" and s.inside:
        s.m.add(BASE, *(box(side, y, z) for side in ((x[0], inner[0]), (inner[1], x[1]))))
        s.m.add(BASE, *(box(inner, side, z) for side in ((y[0], y[0] + w), (y[1] - w, y[1]))))
        s.m.add(BASE, box(inner, (y[0] + w, y[1] - w), (z[0], z[0] + w)))
    elif s.inside or s.way == "sunk":
        s.m.add(BASE, cut(block(s, x, y, z), box(inner, (y[0] + w, y[1] - w), (z[0] + w, z[1] + 1))))
    else:
        s.m.add(BASE, block(s, x, y, z))


def _arched_lid(s: Style, x: Span, y: Span, at: float, w: float) -> None:
    m, g = s.m, s.m.pick(0.0, 0.002, 0.004)
    rise = m.number(0.25, 0.5) * (y[1] - y[0])
    edge = m.pick(0.0, 0.2) * rise
    outer = arch(y, (at + g, at + g + edge + rise), rise, s.n)
    inner = arch((y[0] + w, y[1] - w), (at + g - 0.001, at + g + edge + rise - w), rise - w, s.n)
    s.put("lid", prism(outer.difference(inner), "x", (x[0] + w, x[1] - w)) if s.inside else prism(outer, "x", x))
    if s.inside:
        s.put("lid", *(prism(outer, "x", side) for side in ((x[0], x[0] + w), (x[1] - w, x[1]))))
    for share in m.pick((), (0.15, 0.85), (0.0, 0.5, 1.0), (0.1, 0.9)):
        band = x[0] + share * (x[1] - x[0])
        shell = arch((y[0] - 0.005, y[1] + 0.005), (at + g, at + g + edge + rise + 0.005), rise, s.n)
        span = (band - 0.02, band + 0.02)
        s.put("lid", prism(shell.difference(outer), "x", span))
        m.add(BASE, *(box(span, side, (at - 0.9 * rise, at)) for side in ((y[0] - 0.005, y[0]), (y[1], y[1] + 0.005))))
    m.hinge("lid", ((x[0] + x[1]) / 2, y[1] + 0.005, at + g), (-1, 0, 0), m.pick(70, 90, 105))


def _flaps(s: Style, x: Span, y: Span, z: Span, half: bool) -> None:
    """Two flaps that meet in the middle, or one beside a fixed top."""
    g, middle = s.m.pick(0.001, 0.003), (x[0] + x[1]) / 2
    s.put("flap_0", block(s, (x[0], middle - g), y, z, "d"))
    s.m.hinge(
        "flap_0",
        (x[0], (y[0] + y[1]) / 2, z[1] if half else z[0]),
        (0, -1, 0),
        s.m.pick(95, 150) if half else s.m.pick(95, 180),
    )
    s.put(BASE if half else "flap_1", block(s, (middle + g, x[1]), y, z, "d"))
    if not half:
        s.m.hinge("flap_1", (x[1], (y[0] + y[1]) / 2, z[0]), (0, 1, 0), s.m.pick(95, 180))


def _chest_trims(s: Style, x: Span, y: Span, z: Span) -> None:
    """A lock plate, corner irons and a bail at either side."""
    m, middle, high = s.m, (x[0] + x[1]) / 2, z[1] - z[0]
    if s.way == "old":
        count, low, up = m.pick(1, 2, 3), z[0] + 0.15 * high, z[0] + m.pick(0.5, 0.75) * high
        for k in range(count):
            a = x[0] + (k + 0.12) / count * (x[1] - x[0])
            span = (a, a + 0.76 / count * (x[1] - x[0]))
            m.add(BASE, bevelled(span, (y[0] - 0.008, y[0] + 0.004), (low, up), 0.005))
    if "lid" in m.joints and m.chance(0.4):
        r = 0.06 * high
        front = float(m.of("lid").bounds[0, 1])
        if front > y[0] - 0.01:
            m.add(BASE, box((middle - 1.4 * r, middle + 1.4 * r), (y[0] - 0.003, y[0]), (z[1] - 4.5 * r, z[1] - 1.2 * r)))
            m.add("hasp", box((middle - r, middle + r), (front - 0.006, front - 0.003), (z[1] - 4 * r, z[1] + 0.5 * r)))
            m.hinge("hasp", (middle, front - 0.0045, z[1] + 0.5 * r), (-1, 0, 0), m.pick(90, 120), "lid")
    if m.chance(0.4):
        for sign, side in ((-1, x[0]), (1, x[1])):
            part, at = s.name("bail"), z[0] + 0.6 * high
            reach, half = 0.14 * high, 0.15 * (y[1] - y[0])
            spot = vec(side + sign * 0.008, (y[0] + y[1]) / 2, at)
            arm = vec(0, half, 0)
            m.add(part, tube([spot - arm, spot - arm - vec(0, 0, reach), spot + arm - vec(0, 0, reach), spot + arm], 0.005, 6))
            ends = (float(spot[1]) - half, float(spot[1]) + half)
            m.add(BASE, *(box((side, side + sign * 0.014), (v - 0.01, v + 0.01), (at - 0.008, at + 0.008)) for v in ends))
            m.hinge(part, spot, (0, -sign, 0), 85)
