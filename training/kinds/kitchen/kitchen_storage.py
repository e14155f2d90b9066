"""Smaller kitchen storage: waste sorters, bread boxes, blocks of spice drawers."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.kitchen_parts import blind, body, door, drawer, fill, look, tray
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, common, cut, prism, rectangle, rod, vec


def waste_sorter(m: Model) -> None:
    """A base unit whose front comes out with bins, some under lids; or bins that tip out."""
    wide, deep, high, foot, how = m.number(0.3, 0.6), 0.55, m.number(0.7, 0.8), m.pick(0.05, 0.1), look(m, 0.5)
    room = ((0.01, wide - 0.01), (foot + 0.01, foot + high - m.pick(0.01, 0.15)))
    hollow = body(m, (0, wide), (0, deep), (foot, foot + high), [room], how)
    feet(m, (0, wide), (0, deep), foot)
    if room[1][1] < foot + high - 0.1:
        above = ((0.01, wide - 0.01), (room[1][1] + 0.02, foot + high - 0.01))
        blind(m, above[0], how.depth, above[1], how)
    if m.chance(0.3):
        door(m, "flap", *room, "bottom", how, m.pick(30, 45))
        return
    drawer(m, "pull_out", *room, deep, how, m.pick("box", "wire") if hollow else "none", "top")
    count, z = m.pick(1, 2, 3), (room[1][0] + 0.04, foot + 0.65 * high)
    ys, lidded = np.linspace(0.04, deep - 0.06, count + 1), m.pick(0, 1, count)
    for k in range(count if hollow else 0):
        y = (ys[k] + 0.006, ys[k + 1] - 0.006)
        tray(m, "pull_out", (0.05, wide - 0.05), y, z, "tub")
        if k < lidded:
            m.add(f"lid_{k}", box((0.048, wide - 0.048), y, (z[1] + 0.001, z[1] + 0.012)))
            m.add(f"lid_{k}", box((0.4 * wide, 0.6 * wide), (y[0] - 0.004, y[0] + 0.01), (z[1] + 0.012, z[1] + 0.02)))
            m.hinge(f"lid_{k}", (wide / 2, y[1], z[1]), (-1, 0, 0), m.pick(80, 110), "pull_out")
    if hollow and m.chance(0.5):
        m.add(BASE, *(box((a, a + 0.012), (0.04, deep - 0.05), (z[0], z[0] + 0.03)) for a in (0.02, wide - 0.032)))


def bread_box(m: Model) -> None:
    """A bread box with a rolling front, a front that falls open, a lid, or two doors."""
    wide, deep, high, n = m.number(0.3, 0.45), m.number(0.2, 0.3), m.number(0.16, 0.24), m.pick(10, 16, 24)
    style, t, how = m.pick("roll", "roll", "fall", "lid"), 0.008, look(m, 0.3, pulls=("knob", "rail", "cup", "bar"))
    if style == "roll":
        high = min(high, 0.75 * deep)
        about, r = (deep / 2, 0.3 * high), 0.5 * deep
        turn = np.linspace(0, np.pi, n)
        disc = Polygon([(about[0] - r * np.cos(a), about[1] + r * np.sin(a)) for a in turn] + [(deep, 0), (0, 0)])
        m.add(BASE, *(prism(disc, "x", s) for s in ((0, 0.012), (wide - 0.012, wide))))
        steps = np.linspace(0, np.deg2rad(100), n)
        path = [
            (about[0] - c * np.cos(a), about[1] + c * np.sin(a))
            for c, turns in ((r, steps), (r - t, steps[::-1]))
            for a in turns
        ]
        m.add("cover", prism(Polygon(path), "x", (0.014, wide - 0.014)))
        tail = np.linspace(np.deg2rad(95), np.pi, n)
        path = [
            (about[0] - c * np.cos(a), about[1] + c * np.sin(a))
            for c, turns in ((r - t - 0.002, tail), (r - 2 * t, tail[::-1]))
            for a in turns
        ]
        m.add(BASE, prism(Polygon(path), "x", (0.012, wide - 0.012)), box((0, wide), (0, deep), (0, 0.012)))
        m.add(
            BASE,
            box((0.012, wide - 0.012), (deep - t, deep), (0, about[1])),
            box((0.012, wide - 0.012), (0, t), (0, about[1] - 0.002)),
        )
        at = vec(wide / 2, 0.0, about[1] + 0.02)
        m.add(
            "cover",
            *m.pick(
                [ball(at - vec(0, 0.01, 0), (0.012,) * 3, 10)],
                [box((0.3 * wide, 0.7 * wide), (-0.015, 0.004), (at[2], at[2] + 0.012))],
            ),
        )
        m.hinge("cover", (wide / 2, *about), (-1, 0, 0), m.pick(70, 80))
        return
    shell = box((0, wide), (0, deep), (0, high))
    if style == "lid":
        m.add(BASE, cut(shell, box((t, wide - t), (t, deep - t), (t, 1))) if m.chance(0.7) else shell)
        m.add("lid", box((-0.004, wide + 0.004), (-0.006, deep), (high + 0.001, high + 0.015)))
        m.add(
            "lid",
            m.pick(
                ball((wide / 2, 0.05, high + 0.025), (0.015,) * 3, 12),
                box((0.4 * wide, 0.6 * wide), (-0.02, 0), (high, high + 0.01)),
            ),
        )
        m.hinge("lid", (wide / 2, deep, high), (-1, 0, 0), m.pick(80, 100))
    else:
        slant = m.pick(0.0, 0.35 * deep)  # a slanted front when > 0
        side = Polygon([(0, 0), (deep, 0), (deep, high), (slant, high)])
        body_, hole = prism(side, "x", (0, wide)), prism(side.buffer(-t, join_style="mitre"), "x", (t, wide - t))
        mouth = prism([(-1, t), (deep / 2, t), (deep / 2, high - t), (-1, high - t)], "x", (t, wide - t))
        m.add(BASE, cut(body_, hole, common(mouth, prism(Polygon(side.exterior.coords).buffer(0.001), "x", (0, wide)))))
        part, long = Model(m.rng), float(np.hypot(slant, high))
        fill(part, "flap", (0, wide), (-0.01, -0.001), (0.004, long - 0.002), how, "top")
        tilt = np.arctan2(slant, high)
        T = np.array([[1, 0, 0, 0], [0, np.cos(tilt), np.sin(tilt), 0], [0, -np.sin(tilt), np.cos(tilt), 0], [0, 0, 0, 1]])
        for _, solid in part.pieces:
            solid.apply_transform(T)
            m.add("flap", solid)
        m.hinge("flap", (wide / 2, -0.005, 0.002), (1, 0, 0), m.pick(90, 110))
    if m.chance(0.5):
        m.add(BASE, *(rod((a, b, -0.012), (a, b, 0), 0.01, 10) for a in (0.03, wide - 0.03) for b in (0.03, deep - 0.03)))


def spice_drawers(m: Model) -> None:
    """A block of many small drawers, some of the fields fixed or open."""
    columns, rows, how = m.pick(3, 4, 5, 6), m.pick(2, 3, 4, 5), look(m, 0.1, pulls=("knob", "cup", "none", "rim", "recess"))
    a, b, deep, foot = m.number(0.08, 0.14), m.number(0.06, 0.12), m.number(0.1, 0.25), m.pick(0.0, 0.03)
    rooms = [
        ((a * i + 0.006, a * (i + 1) - 0.006), (foot + b * k + 0.006, foot + b * (k + 1) - 0.006))
        for i in range(columns)
        for k in range(rows)
    ]
    body(m, (0, columns * a), (0, deep), (foot, foot + rows * b), rooms, how, 0.008)
    inside, dead = m.pick("none", "none", "box"), m.pick(0.0, 0.0, 0.2)
    for k, (x, z) in enumerate(rooms):
        if k and m.chance(dead):
            continue
        drawer(m, f"drawer_{k}", x, z, deep, how, inside, "middle")
    if foot:
        feet(m, (0, columns * a), (0, deep), foot)
    if m.chance(0.5):
        m.add(BASE, box((-0.01, columns * a + 0.01), (-0.02, deep), (foot + rows * b, foot + rows * b + 0.015)))
    if m.chance(0.3):
        m.add(BASE, prism(rectangle((0, columns * a), (foot, foot + rows * b + 0.05), 0.004), "y", (deep, deep + 0.01)))
