"""Fans as several artists model them: on a stem, in a yoke, in a box, as a tower."""

from __future__ import annotations

import numpy as np

from training.kinds.cad_style import (
    aimed,
    baluster,
    band,
    bar,
    bolt,
    convention,
    facing,
    knob,
    lathed,
    open_box,
    rounds,
    slab,
    upright_slab,
)
from training.kinds.household.cad_fan_parts import cage, motor, rotor
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, around, ball, box, cut, loft, rod, rounded, tube, vec


def _controls(m: Model, style: str, at: Point, wide: float, n: int, axis: Point = (0, 0, 1)) -> None:
    """Push keys in a row, or a knob, on a face with a normal axis."""
    p, d = np.asarray(at, float), np.asarray(axis, float)
    if m.chance(0.55):
        count = m.pick(3, 4, 5)
        for k in range(count):
            c, half = p + vec((k - (count - 1) / 2) * wide / count, 0, 0), 0.38 * wide / count
            size = vec(half, half, half) * (1 - np.abs(d)) + 0.5 * half * np.abs(d)
            low, high = c - size - 0.2 * half * d, c + size - 0.2 * half * d
            m.add(f"button_{k}", slab(style, *zip(low, high, strict=True)))
            m.slide(f"button_{k}", -d, 0.5 * half)
    elif m.chance(0.8):
        m.add("knob", *knob(style, p - 0.001 * d, d, 0.16 * wide, 0.14 * wide, n))
        m.spin("knob", p, d)


def _head(m: Model, style: str, at: Point, r: float, n: int, post: float) -> None:
    """Cage, motor and rotor on a neck that may sway; the post below ends at a height."""
    c = np.asarray(at, float)
    m.add("head", *facing(cage(m, style, r, n) + motor(style, r, n), c))
    m.add("rotor", *facing(rotor(m, style, r, n), c))
    m.spin("rotor", c, (0, -1, 0), "head")
    pivot, sways = c + vec(0, 0.48 * r, -0.36 * r), m.chance(0.5)
    holder = "neck" if sways else BASE
    m.add("head", box((-0.05 * r, 0.05 * r), (c[1] + 0.4 * r, c[1] + 0.56 * r), (pivot[2] - 0.05 * r, c[2] - 0.2 * r)))
    for s in (-1, 1):
        x = (s * 0.052 * r, s * 0.11 * r)
        m.add(holder, slab(style, x, (pivot[1] - 0.08 * r, pivot[1] + 0.08 * r), (pivot[2] - 0.17 * r, pivot[2] + 0.07 * r)))
    y = (pivot[1] - 0.09 * r, pivot[1] + 0.09 * r)
    m.add(holder, slab(style, (-0.12 * r, 0.12 * r), y, (post, pivot[2] - 0.1 * r)))
    m.add(m.pick(holder, "head"), rod(pivot - vec(0.13 * r, 0, 0), pivot + vec(0.13 * r, 0, 0), 0.03 * r, 8))
    if style == "assembly":
        m.add(holder, *bolt(pivot + vec(0.13 * r, 0, 0), (1, 0, 0), 0.03 * r))
    m.hinge("head", pivot, (-1, 0, 0), (-15, m.pick(20, 35)), holder)
    if sways:
        m.hinge("neck", pivot, (0, 0, 1), (-45, 45))
        if m.chance(0.5):
            back = c + vec(0, 0.45 * r, 0.25 * r)
            m.add(
                "pull", rod(back, back + vec(0, 0, 0.14 * r), 0.02 * r, 6), ball(back + vec(0, 0, 0.15 * r), (0.04 * r,) * 3, 8)
            )
            m.slide("pull", (0, 0, 1), 0.05 * r, "head")


def _yoke(m: Model, style: str, r: float, n: int, floor: float) -> float:
    """A round housing that tilts in a bow; returns the height of its middle."""
    z, wide = floor + 1.25 * r, m.number(0.08, 0.2) * r
    shell = [band(r, 1.06 * r, (-0.34 * r, 0.26 * r), n)]
    if style == "sheet":
        shell = [lathed([(1.03 * r, -0.34 * r), (1.03 * r, 0.26 * r)], n)]
    inner = cage(m, style, 0.97 * r, n)
    m.add("head", *facing(shell + inner + [rod((0, 0, -0.38 * r), (0, 0, -0.2 * r), 0.24 * r, n)], (0, 0, z)))
    m.add("rotor", *facing(rotor(m, style, 0.97 * r, n), (0, 0, z)))
    m.spin("rotor", (0, 0, z), (0, -1, 0), "head")
    bow = [vec(1.14 * r * np.cos(t), 0, z + 1.14 * r * np.sin(t)) for t in np.linspace(np.pi, 2 * np.pi, 7 if n < 12 else 17)]
    if m.chance(0.4):
        bow = [vec(s * 1.14 * r, 0, z - h * r) for s, h in ((-1, 0), (-1, 0.9), (-0.8, 1.14), (0.8, 1.14), (1, 0.9), (1, 0))]
    y = vec(0, 0.5 * wide, 0)
    rings = [
        [p - y, p + y, o + y, o - y]
        for p, o in ((p, p + 0.04 * r * (p - vec(0, 0, z)) / np.linalg.norm(p - vec(0, 0, z))) for p in bow)
    ]
    m.add(BASE, loft(np.array(rings)))
    for s in (-1, 1):
        m.add(m.pick(BASE, "head"), rod((s * 1.03 * r, 0, z), (s * 1.22 * r, 0, z), 0.06 * r, n))
    m.hinge("head", (0, 0, z), (-1, 0, 0), (-30, m.pick(45, 90)))
    return z


def _boxed(m: Model, style: str, r: float, n: int) -> None:
    """A square housing on feet, with a handle on top."""
    w, d = 1.12 * r, m.number(0.28, 0.4) * r
    z = w + 0.08 * r
    if style in ("hollow", "product"):
        body = cut(upright_slab(style, (-w, w), (-d, d), (z - w, z + w)), rod((0, -1, z), (0, 1, z), 1.03 * r, 2 * n))
        m.add(BASE, body)
    else:
        side = open_box if style == "sheet" else lambda x, y, q, *_: slab(style, x, y, q)
        m.add(BASE, *(side((s * 1.03 * r, s * w), (-d, d), (z - w, z + w), "+y") for s in (-1, 1)))
        m.add(BASE, *(side((-1.03 * r, 1.03 * r), (-d, d), (z + s * 1.03 * r, z + s * w), "+y") for s in (-1, 1)))
    m.add(BASE, *facing([*cage(m, style, r, n), rod((0, 0, -0.3 * r), (0, 0, -0.2 * r), 0.2 * r, n)], (0, 0, z)))
    m.add("rotor", *facing(rotor(m, style, 0.98 * r, n), (0, 0, z)))
    m.spin("rotor", (0, 0, z), (0, -1, 0))
    m.add(BASE, *(slab(style, (s * 0.9 * r, s * 0.6 * r), (-1.3 * d, 1.3 * d), (0, 0.1 * r), "+z") for s in (-1, 1)))
    if m.chance(0.5):
        grip = [(s * 0.3 * r, 0, z + w + h * r) for s, h in ((-1, -0.05), (-1, 0.1), (1, 0.1), (1, -0.05))]
        m.add(BASE, tube(grip, 0.02 * r))
    if m.chance(0.7):
        at = vec(0.5 * r, 0, z + w)
        m.add("knob", *knob(style, at, (0, 0, 1), 0.1 * r, 0.1 * r, n))
        m.spin("knob", at, (0, 0, 1))


def _foot(m: Model, style: str, wide: float, y: float, n: int) -> float:
    """A base on the floor around (0, y); returns its height."""
    tall = wide * m.number(0.08, 0.2)
    form = m.pick("round", "block", "cross")
    if style == "antique":
        m.add(
            BASE,
            lathed(
                [
                    (0, 0),
                    (wide, 0),
                    (wide, 0.2 * tall),
                    (0.85 * wide, 0.4 * tall),
                    (0.8 * wide, 0.7 * tall),
                    (0.5 * wide, tall),
                    (0, tall),
                ],
                n,
                (0, y, 0),
            ),
        )
    elif style == "sheet" and form == "round":
        m.add(BASE, lathed([(wide, 0), (0.9 * wide, tall), (0, tall)], n, (0, y, 0)))
    elif form == "round":
        m.add(BASE, lathed([(0, 0), (wide, 0), (wide, 0.6 * tall), (0.92 * wide, tall), (0, tall)], n, (0, y, 0)))
    else:
        m.add(BASE, slab(style, (-wide, wide), (y - 0.8 * wide, y + 0.8 * wide), (0, tall)))
    return tall


def desk_fan(m: Model) -> None:
    """A small fan on a stem whose head tilts and may sway, in a bow, or in a box; keys or a knob."""
    style = convention(m)
    r, n = m.number(0.07, 0.19), rounds(m, style)
    form = m.pick("stem", "stem", "yoke", "box")
    if form == "box":
        _boxed(m, style, r, n)
        return
    wide = r * m.number(0.6, 0.85)
    if form == "yoke":
        tall = _foot(m, style, wide, 0, n)
        _yoke(m, style, r, n, tall - 0.08 * r)
        _controls(m, style, (0, -0.6 * wide, tall), 0.9 * wide, n)
        return
    y = 0.48 * r
    tall, post = _foot(m, style, wide, y, n), m.number(0.55, 0.9) * r
    z = tall + post + 0.65 * r
    if style == "antique":
        m.add(BASE, baluster(tall - 0.002, tall + post, 0.16 * r, n, (0, y, 0)))
    else:
        m.add(BASE, slab(style, (-0.1 * r, 0.1 * r), (y - 0.08 * r, y + 0.08 * r), (tall - 0.002, tall + post)))
    _head(m, style, (0, 0, z), r, n, tall + post - 0.001)
    _controls(m, style, (0, y - 0.55 * wide, tall), 0.9 * wide, n)


def _tower(m: Model, n: int) -> None:
    """A slim column that sways on its base; a drum turns behind its slots in some."""
    tall, w = m.number(0.7, 1.1), m.number(0.055, 0.08)
    m.add(BASE, lathed([(0, 0), (1.9 * w, 0), (1.8 * w, 0.02), (1.0 * w, 0.035), (0, 0.035)], n))
    z, column = (0.036, tall), rounded((-w, w), (-w, w), 0.6 * w)
    open_front = m.chance(0.6)
    part = "column" if m.chance(0.7) or not open_front else BASE
    outline = np.array(column.exterior.coords)[:-1]
    solid = loft(np.array([np.c_[outline * k, np.full(len(outline), h)] for k, h in ((1, z[0]), (m.number(0.8, 1), z[1]))]))
    low, high = z[0] + 0.16 * tall, z[1] - 0.16 * tall
    if open_front:
        solid = cut(solid, box((-0.62 * w, 0.62 * w), (-1, 0.45 * w), (low, high)))
        m.add("drum", *around(box((0.3 * w, 0.5 * w), (-0.01, -0.006), (low + 0.004, high - 0.004)), 9))
        m.add("drum", *(rod((0, 0, h), (0, 0, h + 0.006), 0.52 * w, n) for h in (low, 0.5 * (low + high), high - 0.006)))
        m.spin("drum", (0, 0, low), (0, 0, 1), part)
    m.add(part, solid)
    y = -0.8 * w
    for x in np.linspace(-0.5, 0.5, m.pick(4, 6, 8)) * w:
        m.add(
            part, box((x - 0.002, x + 0.002), (y - (0.0 if open_front else 0.25 * w), y + 0.004), (low - 0.002, high + 0.002))
        )
    if part == "column":
        m.hinge("column", (0, 0, z[0]), (0, 0, 1), (-45, 45))
    if m.chance(0.5):
        for k, x in enumerate((-0.3 * w, 0, 0.3 * w)):
            m.add(f"button_{k}", rod((x, 0, tall - 0.004), (x, 0, tall + 0.003), 0.11 * w, 10))
            m.slide(f"button_{k}", (0, 0, -1), 0.003, part)


def pedestal_fan(m: Model) -> None:
    """A fan on a column that may be drawn out, with a head that tilts and sways; a drum in a bow on wheels; a tower."""
    style = convention(m)
    r, n = m.number(0.16, 0.26), rounds(m, style)
    form = m.pick("column", "column", "drum", "tower")
    if form == "tower":
        _tower(m, max(n, 12))
    elif form == "drum":
        m.add(BASE, *(rod((s * 0.8 * r, -0.6 * r, 0.14 * r), (s * 0.8 * r, 0.55 * r, 0.14 * r), 0.04 * r, 8) for s in (-1, 1)))
        m.add(BASE, *(rod((-r, y * r, 0.14 * r), (r, y * r, 0.14 * r), 0.04 * r, 8) for y in (-0.5, 0.45)))
        m.add(BASE, slab(style, (-0.3 * r, 0.3 * r), (-0.5 * r, 0.45 * r), (0.1 * r, 0.16 * r)))
        _yoke(m, style, r, n, 0.06 * r)
        for s, name in ((-1, "left"), (1, "right")):
            m.add(f"wheel_{name}", rod((s * r, 0.45 * r, 0.14 * r), (s * 1.1 * r, 0.45 * r, 0.14 * r), 0.14 * r, n))
            m.add(f"wheel_{name}", aimed(band(0.04 * r, 0.08 * r, (0, 0.13 * r), n), (s, 0, 0), (s * r, 0.45 * r, 0.14 * r)))
            m.spin(f"wheel_{name}", (s * r, 0.45 * r, 0.14 * r), (1, 0, 0))
        m.add(BASE, *(slab(style, (s * 0.95 * r, s * 0.75 * r), (-0.6 * r, -0.45 * r), (0, 0.14 * r), "+z") for s in (-1, 1)))
    else:
        _column(m, style, r, n)


def _column(m: Model, style: str, r: float, n: int) -> None:
    """A foot or legs, a post with a clamp, keys on a box, the head."""
    y, tall, wide = 0.48 * r, m.number(0.75, 1.1), r * m.number(0.8, 1.1)
    if m.chance(0.4):
        feet = [bar((0.04, 0, 0.3 * tall), (wide, 0, 0.012), 0.025, 0.025, (0, 1, 0))] if m.chance(0.5) else []
        feet = feet or [slab(style, (0.01, 1.2 * wide), (-0.025, 0.025), (0, 0.03))]
        for s in around(feet[0], m.pick(3, 4), 45):
            m.add(BASE, s.apply_translation((0, y, 0)))
        m.add(BASE, rod((0, y, 0.012), (0, y, 0.32 * tall), 0.045, n))
    else:
        _foot(m, style, wide, y, n)
    top = 0.55 * tall
    m.add(BASE, baluster(0.01, top, 0.05, n, (0, y, 0)) if style == "antique" else rod((0, y, 0.01), (0, y, top), 0.02, n))
    m.add(BASE, rod((0, y, top - 0.03), (0, y, top + 0.02), 0.03, n), rod((0, y, 0.3 * tall), (0, y, tall), 0.014, n))
    if m.chance(0.5):
        at = vec(0.028, y, top)
        m.add("clamp", *knob("hollow", at, (1, 0, 0), 0.016, 0.03, n))
        m.spin("clamp", at, (1, 0, 0))
    panel = m.chance(0.5)
    if panel:
        m.add(BASE, upright_slab(style, (-0.05, 0.05), (y - 0.035, y + 0.03), (tall - 0.2, tall - 0.03)))
        _controls(m, style, (0, y - 0.035, tall - 0.1), 0.08, n, (0, -1, 0))
    _head(m, style, (0, 0, tall + 0.65 * r), r, n, tall - 0.001)
