"""Windows in walls and roofs: a pair of leaves, sliding sashes, shutters, roof vents."""

from __future__ import annotations

import numpy as np
import trimesh

from training.kinds.mason_openings import knuckles, portal, swing
from training.kinds.mason_style import frame, grip, leaf, lever, slab, soft, style_of
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, ring, rod, tube, turned, vec


def hinged_window_pair(m: Model) -> None:
    """Two leaves hung at the sides, to the front or the room; a fixed light above or beside; levers that turn."""
    style, wide, high = style_of(m), m.number(0.7, 1.6), m.number(0.8, 1.6)
    d, t, w = m.number(0.07, 0.16), m.number(0.03, 0.05), m.number(0.04, 0.08)
    out, gap, proud = m.chance(0.6), max(m.gap(0.4), 0.0), m.pick(0.0, 0.0, 0.01)
    portal(m, style, (0, wide), (0, high), (0, d), w, False, 0.55)
    y = (-proud, t - proud) if out else (d - t + proud, d + proud)
    top, look = high, m.pick("glass", "glass", "glass", "panels", "slats")
    if m.chance(0.35):
        top = m.number(0.7, 0.8) * high
        m.add(BASE, slab(style, (-0.002, wide + 0.002), (0, d), (top, top + w)))
        m.add(BASE, *leaf(m, style, "glass", (0, wide), (top + w, high), (0.3 * d, 0.3 * d + t)))
    post = m.pick(0.0, 0.0, w)
    if post:
        m.add(BASE, slab(style, (wide / 2 - w / 2, wide / 2 + w / 2), (0, d), (-0.002, top + 0.002)))
    split = wide * m.pick(0.5, 0.5, 0.38) if not post else wide / 2
    spans = ((gap, split - post / 2 - gap / 2), (split + post / 2 + gap / 2, wide - gap))
    c, levers = (gap, top - gap), m.chance(0.5)
    for k, (side, a) in enumerate(zip((-1, 1), spans, strict=True)):
        part = f"leaf_{k}"
        m.add(part, *leaf(m, style, look, a, c, y))
        x, free = a[(side + 1) // 2], a[(1 - side) // 2] + side * 0.035
        pin = y[0] if out else y[1]
        knuckles(m, style, part, x, pin, c, side)
        swing(m, part, x, pin, side, m.pick(70, 90, 110), out)
        if levers and (k == 1 or post):
            lever(m, f"handle_{k}", part, (free, y[1], 0.45 * high), side, 1.0, 90)
        elif not levers:
            m.add(part, *grip(m, style, free, 0.45 * high, y[1], 1.0, 0.6))


def _upright_sashes(m: Model, style: str, wide: float, high: float, d: float) -> None:
    """An outer sash above and an inner one below; both move, or the lower."""
    t, meet, gap = 0.4 * d, high * m.pick(0.5, 0.5, 0.4), max(m.gap(0.4), 0.0)
    lap, both = m.number(0.03, 0.05), m.chance(0.6)
    over, under = (0.08 * d, 0.08 * d + t), (0.52 * d, 0.52 * d + t)
    upper = leaf(m, style, "glass", (gap, wide - gap), (meet - lap / 2, high - 0.003), over)
    m.add("upper_sash" if both else BASE, *upper)
    m.add("lower_sash", *leaf(m, style, "glass", (gap, wide - gap), (0.003, meet + lap / 2), under))
    m.slide("lower_sash", (0, 0, 1), 0.85 * (high - meet - lap))
    if both:
        m.slide("upper_sash", (0, 0, -1), 0.85 * (meet - lap))
    for x in m.pick((0.25, 0.75), (0.5,)):
        at = x * wide
        m.add("lower_sash", slab(style, (at - 0.04, at + 0.04), (under[1] - 0.003, under[1] + 0.03), (0.02, 0.04)))
    if m.chance(0.4):
        m.add(BASE, *(rod((x, 0.5 * d, meet), (x, 0.5 * d, high + 0.01), 0.004, 6) for x in (0.006, wide - 0.006)))
    if m.chance(0.4):
        m.add(
            "lower_sash",
            box((wide / 2 - 0.025, wide / 2 + 0.025), (under[0] + 0.002, under[1]), (meet, meet + lap / 2 + 0.008)),
        )


def sash_sliding_window(m: Model) -> None:
    """Sashes that slide up and down, or sideways, in a box frame; some fixed."""
    style, wide, high = style_of(m), m.number(0.6, 1.8), m.number(0.8, 1.7)
    d, w = m.number(0.09, 0.16), m.number(0.05, 0.09)
    portal(m, style, (0, wide), (0, high), (0, d), w, False, 0.5)
    if style != "sheet" and m.chance(0.6):
        m.add(BASE, *(box((x, x + 0.012), (0.485 * d, 0.515 * d), (-0.002, high + 0.002)) for x in (-0.002, wide - 0.01)))
    if wide < 1.1 or m.chance(0.3):
        _upright_sashes(m, style, wide, high, d)
        return
    count, t = m.pick(2, 2, 3), 0.38 * d
    lap, fixed = m.number(0.03, 0.06), m.pick(-1, 0, 1)
    step = (wide + (count - 1) * lap) / count
    for k in range(count):
        a = (k * (step - lap), k * (step - lap) + step)
        y0 = (0.08 + 0.46 * (k % 2)) * d
        part = BASE if k == fixed else f"sash_{k}"
        m.add(part, *leaf(m, style, "glass", a, (0.003, high - 0.003), (y0, y0 + t)))
        if part == BASE:
            continue
        way = 1.0 if k < count / 2 else -1.0
        m.slide(part, (way, 0, 0), 0.85 * (step - lap))
        x = a[0] + 0.03 if k < count / 2 else a[1] - 0.03
        m.add(part, *(grip(m, style, x, high / 2, y0 + t, 1.0, 0.35) if y0 > 0.4 * d else ()))


def shuttered_window(m: Model) -> None:
    """A glazed window behind shutters: a pair, a folding pair, or one hung at its top; catches on the wall."""
    style, wide, high = style_of(m), m.number(0.7, 1.3), m.number(0.9, 1.6)
    d, t, w = m.number(0.08, 0.16), m.number(0.022, 0.04), m.number(0.05, 0.09)
    portal(m, style, (0, wide), (0, high), (0, d), w, False, 0.8)
    m.add(BASE, *leaf(m, style, "glass", (-0.002, wide + 0.002), (-0.002, high + 0.002), (0.5 * d, 0.9 * d)))
    look, gap = m.pick("slats", "slats", "boards", "panels", "flat"), max(m.gap(0.4), 0.0)
    y, c = m.pick((-0.002, t - 0.002), (-t - 0.001, -0.001)), (gap, high - gap)
    design = m.pick("pair", "pair", "folding", "top")
    if design == "top":
        m.add("shutter", *leaf(m, style, look, (gap, wide - gap), c, y))
        m.hinge("shutter", (wide / 2, y[0], c[1]), (-1, 0, 0), m.pick(40, 60, 80))
        m.add("shutter", *grip(m, style, wide / 2, 0.08 * high, y[0], -1.0, 0.5))
        return
    for k, side in enumerate((-1, 1)):
        a = (gap, wide / 2 - gap / 2) if side < 0 else (wide / 2 + gap / 2, wide - gap)
        x, part = a[(side + 1) // 2], f"shutter_{k}"
        free, inner = a[(1 - side) // 2], a
        if design == "folding":
            middle = (a[0] + a[1]) / 2
            a, inner = ((a[0], middle), (middle, a[1])) if side < 0 else ((middle, a[1]), (a[0], middle))
            m.add(f"fold_{k}", *leaf(m, style, look, inner, c, y))
            m.hinge(f"fold_{k}", (middle, y[0], 0), (0, 0, side), m.pick(150, 170), part)
        m.add(part, *leaf(m, style, look, a, c, y))
        knuckles(m, style, part, x, y[0], c, side)
        swing(m, part, x, y[0], side, m.pick(90, 130, 165) if design == "pair" else 80)
        if m.chance(0.5):
            pull = part if design == "pair" else f"fold_{k}"
            m.add(pull, *grip(m, style, free + side * 0.04, 0.5 * high, y[0], -1.0, 0.5))
    if m.chance(0.5):
        post = 0.5 * w
        m.add(BASE, *(box((x - 0.01, x + 0.01), (-0.02, 0.02), (-0.5 * w, 0)) for x in (-post, wide + post)))


def _dome_vent(m: Model, style: str) -> None:
    """A curb on a flat roof with a lid of glass, or a dome, on its edge; a crank, a fan beneath."""
    wide, deep, h = m.number(0.4, 1.2), m.number(0.4, 1.2), m.number(0.08, 0.25)
    w, lip = m.number(0.03, 0.06), m.number(0.01, 0.03)
    curb = cut(box((0, wide), (0, deep), (0, h)), box((w, wide - w), (w, deep - w), (-1, 1)))
    m.add(BASE, curb)
    if m.chance(0.6):
        roof = box((-0.3, wide + 0.3), (-0.3, deep + 0.3), (-0.04, 0.001))
        m.add(BASE, cut(roof, box((w, wide - w), (w, deep - w), (-1, 1))))
    z = h + max(m.gap(0.4), 0.0)
    m.add("lid", slab(style, (-lip, wide + lip), (-lip, deep + lip), (z, z + 0.025)))
    if style in ("round", "old", "prop") and m.chance(0.7):
        half = ball((wide / 2, deep / 2, z + 0.024), (0.47 * wide, 0.47 * deep, 0.22 * wide), m.pick(8, 16))
        m.add("lid", cut(half, box((-1, 3), (-1, 3), (-1, z + 0.02))))
    elif m.chance(0.5):
        m.add("lid", soft((w, wide - w), (w, deep - w), (z + 0.022, z + 0.07), 0.03, style == "round"))
    m.hinge("lid", (wide / 2, deep + lip, z), (-1, 0, 0), m.pick(35, 60, 85))
    if m.chance(0.4):
        m.add(BASE, box((w - 0.002, wide - w + 0.002), (deep / 2 - 0.01, deep / 2 + 0.01), (0.2 * h, 0.35 * h)))
        m.add("fan", rod((wide / 2, deep / 2, 0.35 * h), (wide / 2, deep / 2, 0.8 * h), 0.05, m.sections()))
        r, hub = 0.42 * (min(wide, deep) - 2 * w), (wide / 2, deep / 2)
        m.add("fan", box((hub[0] - r, hub[0] + r), (hub[1] - 0.02, hub[1] + 0.02), (0.55 * h, 0.6 * h)))
        m.add("fan", box((hub[0] - 0.02, hub[0] + 0.02), (hub[1] - r, hub[1] + r), (0.55 * h, 0.6 * h)))
        m.spin("fan", (*hub, 0), (0, 0, 1))


def _tiles(m: Model, style: str, right: float, top: float, more: float, y: tuple[float, float], low: float) -> None:
    """Rows of tiles on the roof about a window."""
    row, wide = m.number(0.12, 0.25), m.pick(0.15, 0.3, 3.0)
    for z in np.arange(low - more, top + more - row, row):
        for a in ((low - more, low), (right, right + more)):
            for x in np.arange(a[0], a[1] - 0.02, wide):
                tile = slab(
                    "prop" if style == "sheet" else style, (x + 0.002, min(x + wide, a[1]) - 0.002), y, (z, z + 0.93 * row)
                )
                m.add(BASE, tile)


def roof_vent_window(m: Model) -> None:
    """A roof light: a sash in a slope that turns at its middle or its top, or a lid on a curb."""
    style = style_of(m)
    if m.chance(0.45):
        _dome_vent(m, style)
        return
    wide, high, slope = m.number(0.5, 1.1), m.number(0.7, 1.4), m.pick(25, 35, 45)
    d, t, w, gap = m.number(0.08, 0.14), m.number(0.035, 0.055), m.number(0.04, 0.07), max(m.gap(0.4), 0.0)
    m.add(BASE, *frame(style, (-w, wide + w), (-w, high + w), (0, d), w))
    if m.chance(0.7):
        more = m.number(0.2, 0.6)
        m.add(
            BASE, *frame("prop", (-w - more, wide + w + more), (-w - more, high + w + more), (0.55 * d, 0.9 * d), more + 0.002)
        )
        if m.chance(0.6):
            _tiles(m, style, wide + w, high + w, more, (0.35 * d, 0.56 * d), -w)
    if m.chance(0.4):
        m.add(BASE, slab(style, (-w, wide + w), (-0.02, 0.01), (high + 0.3 * w, high + w)))
    y = (0.0, t)
    m.add("sash", *leaf(m, style, "glass", (gap, wide - gap), (gap, high - gap), y))
    pivot = m.chance(0.5)
    at = vec(wide / 2, t / 2, high * 0.5) if pivot else vec(wide / 2, 0, high - gap)
    if m.chance(0.6):
        bar = high - 0.06 if pivot else 0.05
        path = [
            (0.25 * wide, t - 0.003, bar),
            (0.25 * wide, t + 0.03, bar),
            (0.75 * wide, t + 0.03, bar),
            (0.75 * wide, t - 0.003, bar),
        ]
        m.add("sash", tube(path, 0.008, 8))
    if pivot and style != "sheet":
        m.add(BASE, *(rod((x, t / 2, high / 2), (x + s * 0.03, t / 2, high / 2), 0.012, 10) for x, s in ((0, 1), (wide, -1))))
    if m.chance(0.3):
        m.add(BASE, ring((wide / 2, 0.003, -0.5 * w), (0, 1, 0), 0.015, 0.004, 12))
    m.hinge("sash", at, (-1, 0, 0), m.pick(30, 45) if not pivot else m.pick(35, 60))
    _lean_back(m, slope)


def _lean_back(m: Model, slope: float) -> None:
    """Lays an upright sash and its frame into a slope."""
    for _, solid in m.pieces:
        turned(solid, (1, 0, 0), slope - 90, (0, 0, 0))
    joint = m.joints["sash"]
    origin = trimesh.transformations.rotation_matrix(np.deg2rad(slope - 90), (1, 0, 0))[:3, :3] @ joint.origin
    m.hinge("sash", origin, joint.axis, (0.0, float(np.rad2deg(joint.limits[1]))))
