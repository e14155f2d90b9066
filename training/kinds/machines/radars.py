"""Radar and radio dishes and the bar of a ship's radar."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, cut, prism, rod, rounded, turned, vec
from training.kinds.wheels import beam, lathe, upright


def radar_dish(m: Model) -> None:
    """A dish on a mount that turns and tilts, a screen of bars, or a bar that only spins; on a foot, a mast or a hut."""
    form, n = m.pick("dish", "dish", "screen", "bar"), m.pick(12, 16, 24, 32)
    r = m.number(0.4, 4.0)
    high = _foot(m, r, n)
    if form == "bar":
        _bar(m, r, high, n)
        return
    lift = m.pick("yoke", "yoke", "post")
    axis = vec(0, 0, high + (m.number(0.75, 1.05) * r if lift == "yoke" else m.number(0.5, 1.0) * r))
    table = m.number(0.3, 0.45) * r
    m.add("azimuth", rod((0, 0, high + 0.005 * r), (0, 0, high + 0.15 * r), table, n))
    reach = m.number(0.3, 0.42) * r
    if lift == "yoke":
        for s in (-1, 1):
            m.add(
                "azimuth",
                prism(
                    [
                        (-0.25 * r, high + 0.1 * r),
                        (0.3 * r, high + 0.1 * r),
                        (0.12 * r, axis[2] + 0.1 * r),
                        (-0.1 * r, axis[2] + 0.1 * r),
                    ],
                    "x",
                    (s * reach, s * (reach + 0.08 * r)),
                ),
            )
        m.add("azimuth", box((-reach - 0.08 * r, reach + 0.08 * r), (-0.25 * r, 0.3 * r), (high + 0.08 * r, high + 0.2 * r)))
    else:
        reach = 0.14 * r
        m.add(
            "azimuth",
            rod((0, 0, high + 0.1 * r), axis, 0.09 * r, n),
            rod(axis - vec(0.13 * r, 0, 0), axis + vec(0.13 * r, 0, 0), 0.1 * r, n),
        )
    m.spin("azimuth", (0, 0, high), (0, 0, 1))
    reach_up = (axis[2] - high) / ((0.82 if form == "screen" else 1.05) * r)
    least = float(np.degrees(np.arccos(min(reach_up, 1.0))))  # so that its lower edge clears the foot
    lean, front = least + m.number(0, 40), (0.3 if lift == "yoke" else 0.42)
    solids = _screen(m, r, n, front, reach) if form == "screen" else _dish(m, r, n, front, reach)
    m.add("dish", *(turned(s, (-1, 0, 0), lean, (0, 0, 0)).apply_translation(axis) for s in solids))
    m.hinge("dish", axis, (-1, 0, 0), (least - lean, max(m.pick(70, 90) - lean, 15.0)), "azimuth")
    if lift == "yoke" and m.chance(0.35):
        m.add("azimuth", box((-0.2 * r, 0.2 * r), (0.28 * r, 0.5 * r), (high + 0.1 * r, high + 0.35 * r)))


def _foot(m: Model, r: float, n: int) -> float:
    """What stands: a column, a lattice mast, legs or a hut; its height."""
    form = m.pick("column", "mast", "hut", "legs", "block")
    high = {"column": 1.0, "mast": 3.0, "hut": 1.2, "legs": 1.0, "block": 0.4}[form] * r * m.number(0.8, 1.4)
    w = 0.5 * r
    if form == "column":
        m.add(BASE, lathe([(0, 0), (m.number(0.5, 0.9) * r, 0), (0.35 * r, 0.7 * high), (0.4 * r, high), (0, high)], n))
    elif form == "block":
        m.add(BASE, prism(rounded((-1.1 * w, 1.1 * w), (-1.1 * w, 1.1 * w), 0.1 * w), "z", (0, high)))
    elif form == "hut":
        m.add(
            BASE,
            box((-1.2 * r, 1.2 * r), (-r, r), (0, 0.85 * high)),
            box((-1.3 * r, 1.3 * r), (-1.1 * r, 1.1 * r), (0.84 * high, 0.92 * high)),
        )
        m.add(BASE, rod((0, 0, 0.9 * high), (0, 0, high), 0.5 * r, n))
        if m.chance(0.5):
            m.add("door", box((-0.2 * r, 0.2 * r), (-1.03 * r, -1.003 * r), (0.02 * r, 0.6 * high)))
            m.hinge("door", (-0.2 * r, -1.03 * r, 0.3 * high), (0, 0, -1), m.pick(90, 110))
    elif form == "legs":
        m.add(BASE, rod((0, 0, 0.5 * high), (0, 0, high), 0.3 * r, n))
        m.add(
            BASE,
            *around(
                beam((0.1 * r, 0, 0.85 * high), (m.number(0.8, 1.1) * r, 0, 0.02 * r), 0.12 * r, 0.1 * r, (0, 1, 0)),
                m.pick(3, 4),
                90,
            ),
        )
    else:
        top = 0.6 * w
        m.add(BASE, *around(beam((w, w, 0), (top, top, 0.99 * high), 0.08 * r, 0.08 * r), 4))
        levels = np.linspace(0, 1, 6)
        for a, b in pairwise(levels):
            p, q = w + (top - w) * a, w + (top - w) * b
            m.add(BASE, *around(beam((-p, -p, a * high), (q, -q, b * high), 0.04 * r, 0.04 * r, (0, 1, 0)), 4))
            m.add(
                BASE,
                *around(beam((-q, -q, b * high - 0.03 * r), (q, -q, b * high - 0.03 * r), 0.05 * r, 0.05 * r, (0, 1, 0)), 4),
            )
        m.add(BASE, box((-1.2 * top, 1.2 * top), (-1.2 * top, 1.2 * top), (0.98 * high, high)))
    return high


def _dish(m: Model, r: float, n: int, front: float, reach: float) -> list[Trimesh]:
    """A bowl that looks at -Y before the tilt axis, with a feed on struts, and the shaft behind it."""
    deep, t = m.number(0.25, 0.4) * r, m.number(0.02, 0.05) * r
    s = np.linspace(0, 1, 7)
    inside, outside = np.c_[r * s, deep * s**2], np.c_[r * s, deep * s**2 - t]
    found = [lathe([*outside, *inside[::-1]], n)]
    focus = m.number(0.75, 1.1) * r
    feed = m.pick("struts", "struts", "arm", "horn")
    if feed == "struts":
        count, turn = m.pick(3, 4), 0.5
        for k in range(count):
            c, q = np.cos(turn + 2 * np.pi * k / count), np.sin(turn + 2 * np.pi * k / count)
            found.append(rod((0.7 * r * c, 0.7 * r * q, 0.48 * deep), (0.06 * r * c, 0.06 * r * q, focus), 0.018 * r, 6))
        found.append(
            m.pick(rod((0, 0, focus - 0.05 * r), (0, 0, focus + 0.1 * r), 0.1 * r, n), ball((0, 0, focus), (0.1 * r,) * 3, 10))
        )
    elif feed == "arm":
        found += [
            beam((0, -0.8 * r, 0.6 * deep), (0, -0.1 * r, focus), 0.05 * r, 0.05 * r),
            box((-0.09 * r, 0.09 * r), (-0.16 * r, 0.06 * r), (focus - 0.05 * r, focus + 0.15 * r)),
        ]
    else:
        found += [
            rod((0, 0, -0.01 * r), (0, 0, focus), 0.05 * r, n),
            lathe([(0, 0), (0.05 * r, 0), (0.16 * r, 0.12 * r), (0, 0.12 * r)], n, (0, 0, focus - 0.05 * r)),
        ]
    if m.chance(0.4):
        found += [
            beam(
                (0.15 * r * c, 0.15 * r * q, -t - 0.05 * r),
                (0.8 * r * c, 0.8 * r * q, 0.64 * deep - t),
                0.03 * r,
                0.08 * r,
                (-q, c, 0),
            )
            for c, q in ((np.cos(a), np.sin(a)) for a in np.arange(8) * np.pi / 4)
        ]
    found.append(rod((0, 0, -front * r), (0, 0, 0.0), m.number(0.1, 0.18) * r, n))
    found = upright(found, (0, -1, 0), (0, -front * r, 0))
    found.append(rod((-reach - 0.06 * r, 0, 0), (reach + 0.06 * r, 0, 0), 0.07 * r, n))
    if reach > 0.2 * r:
        found.append(box((-reach + 0.02 * r, reach - 0.02 * r), (-front * r - 0.02 * r, 0.12 * r), (-0.1 * r, 0.1 * r)))
    return found


def _screen(m: Model, r: float, n: int, front: float, reach: float) -> list[Trimesh]:
    """A curved screen of bars or a sheet that is wider than high, with a horn before it."""
    wide, tall, bars = m.number(1.0, 1.5) * r, m.number(0.5, 0.8) * r, m.pick(0, 6, 9)
    bend = m.number(0.2, 0.45) * r
    xs = np.linspace(-1, 1, 13)
    line = np.c_[wide * xs, -front * r - bend * xs**2]
    found = []
    t = 0.03 * r
    outline = np.concatenate([line, line[::-1] + np.array([0, t])])
    spans = [(-tall, tall)] if not bars else [(z - 0.02 * r, z + 0.02 * r) for z in np.linspace(-tall, tall, bars)]
    found += [prism(outline, "z", span) for span in spans]
    for k in (0, 3, 6, 9, 12) if bars else (3, 9):
        x, y = line[k]
        found.append(box((x - t, x + t), (y + 0.5 * t, y + 2 * t), (-tall, tall)))
    found.append(beam((0, -front * r, -0.9 * tall), (0, -front * r - 0.8 * r, -0.15 * r), 0.06 * r, 0.06 * r))
    found.append(box((-0.1 * r, 0.1 * r), (-front * r - 0.9 * r, -front * r - 0.65 * r), (-0.2 * r, 0.06 * r)))
    found.append(rod((0, -front * r, 0), (0, 0.02 * r, 0), 0.12 * r, n))
    found.append(rod((-reach - 0.06 * r, 0, 0), (reach + 0.06 * r, 0, 0), 0.07 * r, n))
    if reach > 0.2 * r:
        found.append(box((0.02 * r - reach, reach - 0.02 * r), (-front * r + 0.01 * r, 0.12 * r), (-0.1 * r, 0.1 * r)))
    return found


def _bar(m: Model, r: float, high: float, n: int) -> None:
    """A long flat antenna on a gear box."""
    m.add(
        BASE,
        m.pick(
            box((-0.3 * r, 0.3 * r), (-0.4 * r, 0.4 * r), (high - 0.01 * r, high + 0.3 * r)),
            rod((0, 0, high - 0.01 * r), (0, 0, high + 0.3 * r), 0.32 * r, n),
        ),
    )
    z, half, tall = high + 0.305 * r, m.number(0.9, 1.6) * r, m.number(0.12, 0.25) * r
    m.add("antenna", lathe([(0, 0), (0.2 * r, 0), (0.1 * r, 0.16 * r), (0, 0.16 * r)], n, (0, 0, z)))
    q = m.pick(0.1, 0.2) * r
    shape = m.pick(
        rounded((-q, q), (z + 0.14 * r, z + 0.14 * r + tall), 0.4 * min(q, tall)),
        rounded((-q, 0.5 * q), (z + 0.14 * r, z + 0.14 * r + tall), 0.01 * r),
    )
    m.add("antenna", prism(shape, "x", (-half, half)))
    if m.chance(0.4):
        face = box((-half + 0.03 * r, half - 0.03 * r), (-q - 0.02 * r, -q + 0.01 * r), (z + 0.17 * r, z + 0.11 * r + tall))
        m.add(
            "antenna",
            face
            if m.chance(0.5)
            else cut(
                face,
                *(
                    box((x - 0.01 * r, x + 0.01 * r), (-9 * r, 9 * r), (0, z + 0.1 * r + tall))
                    for x in np.linspace(-0.8, 0.8, 9) * half
                ),
            ),
        )
    if m.chance(0.4):
        m.add("antenna", box((-0.5 * half, 0.5 * half), (0.4 * q, 0.4 * q + 0.1 * r), (z + 0.15 * r, z + 0.2 * r)))
    m.spin("antenna", (0, 0, z), (0, 0, 1))
