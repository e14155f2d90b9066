"""Photo cameras by another artist: compacts, system cameras, box cameras, camcorders."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.prop_style import Style, block, draw_style, spindle
from training.kinds.solids import Span, ball, box, prism, rod, rounded, tube, vec


def photo_camera(m: Model) -> None:
    """A compact, a system camera with a hump, a box camera or a camcorder, with rings, dials, buttons and flaps."""
    s = draw_style(m)
    design = m.pick("compact", "hump", "hump", "box", "camcorder")
    wide, high, deep = {
        "compact": (0.1, 0.06, 0.025),
        "hump": (0.135, 0.09, 0.05),
        "box": (0.08, 0.1, 0.12),
        "camcorder": (0.05, 0.06, 0.13),
    }[design]
    wide, high, deep = wide * m.number(0.9, 1.15), high * m.number(0.9, 1.15), deep * m.number(0.9, 1.15)
    x, y, z = (-wide / 2, wide / 2), (0.0, deep), (0.0, high)
    shell = (
        prism(rounded(x, z, 0.2 * min(wide, high)), "y", y)
        if s.way in ("round", "sunk") and m.chance(0.6)
        else block(s, x, y, z)
    )
    m.add(BASE, shell)
    if s.way in ("old", "round", "cad"):
        m.add(BASE, box((x[0] - 0.0006, x[1] + 0.0006), (y[0] - 0.0008, y[1] + 0.0006), (0.2 * high, 0.7 * high)))
    top = high
    if design == "hump":
        top = high + m.number(0.015, 0.025)
        outline = [(-0.024, high - 0.002), (0.024, high - 0.002), (0.016, top), (-0.016, top)]
        m.add(
            BASE,
            prism(outline, "y", (-0.006, 0.75 * deep)),
            box((-0.013, 0.013), (0.75 * deep - 0.001, deep + 0.006), (high, top - 0.003)),
        )
        m.add(BASE, block(s, (x[0] - 0.004, x[0] + 0.028), (-0.016, 0.6 * deep), (0.0, 0.95 * high), ""))
    _lens_barrel(s, m.pick(0.0, 0.0, 0.1) * wide, high * 0.47, min(0.38 * high, 0.42 * wide), design)
    _top_things(s, x, deep, high, design)
    if design == "camcorder" or m.chance(0.6):
        _screen(s, x, deep, high, design)
    if m.chance(0.5):
        m.add("battery_door", box((x[1] - 0.35 * wide, x[1] - 0.05 * wide), (0.2 * deep, 0.8 * deep), (-0.0015, 0.0005)))
        m.hinge("battery_door", (x[1] - 0.05 * wide, deep / 2, -0.001), (0, -1, 0), 90)
    if design in ("compact", "hump") and m.chance(0.5):
        m.add("flash", box((-0.012, 0.012), (0.005, 0.4 * deep), (top - 0.0005, top + 0.007)))
        m.hinge("flash", (0, 0.4 * deep, top), (-1, 0, 0), m.pick(45, 70))
    elif m.chance(0.5):
        m.add(BASE, box((0.25 * wide, 0.42 * wide), (-0.0015, 0.001), (0.78 * high, 0.9 * high)))


def _lens_barrel(s: Style, x: float, z: float, r: float, design: str) -> None:
    """A barrel with rings that turn, or tubes that slide out, or a fixed lens."""
    m, y = s.m, 0.0
    for k in range(m.pick(1, 2, 3) if design != "compact" else 1):
        part, long = m.pick(BASE, f"ring_{k}", f"ring_{k}"), m.number(0.008, 0.02)
        size = r * m.pick(1.0, 0.95, 0.9)
        m.add(part, rod((x, y + 0.0005, z), (x, y - long, z), size, max(12, s.n)))
        if part != BASE:
            ribs = m.pick(0, 12, 20)
            turns = np.arange(ribs) * 2 * np.pi / max(ribs, 1)
            rib = [vec(x + size * np.cos(t), 0, z + size * np.sin(t)) for t in turns]
            s.put(part, *(rod(p + vec(0, y - 0.2 * long, 0), p + vec(0, y - 0.8 * long, 0), 0.0008, 6) for p in rib))
            m.spin(part, (x, y, z), (0, -1, 0))
        y -= long
    if m.chance(0.5) or design == "compact":
        long, part = m.number(0.01, 0.025), "zoom"
        m.add(part, rod((x, y + 0.012, z), (x, y - long, z), 0.8 * r, max(12, s.n)))
        m.slide(part, (0, -1, 0), m.number(0.01, 0.02))
        y, parent = y - long, part
    else:
        parent = BASE
    rim = spindle([(0.55 * r, 0), (0.78 * r, 0), (0.78 * r, 0.006), (0.7 * r, 0.006)], max(12, s.n))
    rim.apply_transform([[1, 0, 0, x], [0, 0, -1, y + 0.0005], [0, 1, 0, z], [0, 0, 0, 1]])
    m.add(parent, rim, ball((x, y - 0.002, z), (0.6 * r, 0.005, 0.6 * r), 12))


def _top_things(s: Style, x: Span, deep: float, high: float, design: str) -> None:
    """The release, dials, a shoe, a strap lug, buttons at the back."""
    m, wide = s.m, x[1] - x[0]
    at = vec(x[0] + 0.14 * wide, 0.3 * deep, high)
    m.add(BASE, rod(at - vec(0, 0, 0.001), at + vec(0, 0, 0.0015), 0.0065, s.n))
    m.add("release", rod(at + vec(0, 0, 0.001), at + vec(0, 0, 0.0045), 0.0045, s.n))
    m.slide("release", (0, 0, -1), 0.002)
    spots = (vec(x[1] - 0.16 * wide, 0.55 * deep, high), vec(x[0] + 0.16 * wide, 0.75 * deep, high))
    for spot in spots[: m.pick(0, 1, 2)] if design in ("compact", "hump") else []:
        part, tall = s.name("dial"), m.number(0.003, 0.006)
        m.add(part, rod(spot - vec(0, 0, 0.0005), spot + vec(0, 0, tall), min(0.01, 0.22 * deep + 0.002), m.pick(16, 24)))
        m.spin(part, spot, (0, 0, 1))
    if design == "box":
        m.add("advance", rod((x[1] - 0.001, 0.7 * deep, 0.7 * high), (x[1] + 0.008, 0.7 * deep, 0.7 * high), 0.012, 16))
        m.spin("advance", (x[1], 0.7 * deep, 0.7 * high), (1, 0, 0))
        m.add(BASE, _bail(deep, high, 0.2, 0.014, 0.003))
        return
    for k in range(m.pick(0, 2, 4)):
        spot = vec(x[1] - 0.08 * wide, deep, (0.25 + 0.14 * k) * high)
        part = s.name("button")
        m.add(part, rod(spot - vec(0, 0.001, 0), spot + vec(0, 0.002, 0), 0.0035, s.n))
        m.slide(part, (0, -1, 0), 0.0015)
    if m.chance(0.5):
        m.add(BASE, *(ball((side, 0.5 * deep, 0.85 * high), (0.004, 0.002, 0.004), 8) for side in x))


def _bail(deep: float, high: float, begin: float, rise: float, radius: float) -> Trimesh:
    """A fixed carrying handle along the top, from a share of the depth at both ends."""
    ends = ((begin, 0.0), (begin + 0.1, rise), (1 - begin - 0.1, rise), (1 - begin, 0.0))
    return tube([vec(0, share * deep, high + up) for share, up in ends], radius, 8)


def _screen(s: Style, x: Span, deep: float, high: float, design: str) -> None:
    """A screen that swings out at the side or tilts, or a fixed one at the back."""
    m, wide, t = s.m, x[1] - x[0], 0.004
    if design == "camcorder":
        m.add("screen", block(s, (x[1] + 0.0005, x[1] + 0.008), (0.2 * deep, 0.75 * deep), (0.2 * high, 0.85 * high), ""))
        m.hinge("screen", (x[1] + 0.004, 0.2 * deep, high / 2), (0, 0, -1), 90)
        m.add(BASE, _bail(deep, high, 0.15, 0.02, 0.005))
        return
    span, tall = (x[0] + 0.1 * wide, x[1] - 0.25 * wide), (0.12 * high, 0.8 * high)
    plate = box(span, (deep + 0.0005, deep + t), tall)
    sort = m.pick("swing", "tilt", "fixed")
    if sort == "fixed":
        m.add(BASE, box(span, (deep - 0.001, deep + 0.001), tall))
        return
    m.add(
        "screen",
        plate,
        box((span[0] + 0.003, span[1] - 0.003), (deep + t - 0.0005, deep + t + 0.0005), (tall[0] + 0.003, tall[1] - 0.003)),
    )
    if sort == "swing":
        m.hinge("screen", (span[0], deep + t, high / 2), (0, 0, 1), m.pick(90, 170))
    else:
        m.hinge("screen", ((span[0] + span[1]) / 2, deep + t, tall[1]), (1, 0, 0), m.pick(45, 90))
