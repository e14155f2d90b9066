"""Bathroom furniture: mirror cabinets and vanity units."""

from __future__ import annotations

import itertools

import numpy as np

from training.kinds.kitchen_parts import blind, body, door, drawer, look
from training.kinds.kitchen_trims import feet, lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import sheet
from training.kinds.solids import ball, box, cut, rod, tube


def mirror_cabinet(m: Model) -> None:
    """A cabinet of mirror doors that swing, slide or lift, some fields fixed; lamps and a shelf that stay."""
    count, high, deep, z, style = (
        m.pick(1, 2, 3),
        m.number(0.5, 0.8),
        m.number(0.1, 0.17),
        1.2,
        m.pick("swing", "swing", "slide", "lift"),
    )
    wide = count * m.number(0.3, 0.45)
    how = look(m, 0.5, ("slab", "slab", "sheet", "liner", "framed", "glass"), ("none", "none", "groove", "knob", "rim"))
    xs = np.linspace(0, wide, count + 1)
    rooms = [((float(a) + 0.002, float(b) - 0.002), (z + 0.004, z + high - 0.004)) for a, b in itertools.pairwise(xs)]
    if style == "slide" and count > 1:
        m.add(
            BASE,
            cut(
                box((0, wide), (0, deep), (z, z + high)),
                box((0.015, wide - 0.015), (-1, deep - 0.01), (z + 0.015, z + high - 0.015)),
            ),
        )
        for k, (x, _) in enumerate(rooms):
            x, y = (max(x[0] - 0.01, 0.017), min(x[1] + 0.01, wide - 0.017)), (0.003, 0.009) if k % 2 else (0.012, 0.018)
            part = BASE if count == 3 and k == 1 and m.chance(0.4) else f"leaf_{k}"
            m.add(part, box(x, y, (z + 0.017, z + high - 0.017)))
            if part != BASE:
                m.add(part, rod((x[0] + 0.04, y[0] - 0.002, z + high / 2), (x[0] + 0.04, y[0], z + high / 2), 0.012, 12))
                m.slide(part, (1 if k == 0 else -1, 0, 0), 0.85 * wide / count)
    else:
        hollow = body(
            m,
            (0, wide),
            (0, deep),
            (z, z + high),
            rooms if style != "lift" else [((0.002, wide - 0.002), rooms[0][1])],
            how,
            0.014,
        )
        if style == "lift":
            door(m, "mirror", (0.002, wide - 0.002), rooms[0][1], "top", how, m.pick(80, 100))
        for k, (x, b) in enumerate(rooms if style != "lift" else []):
            part = f"door_{k}"
            if count == 3 and k == 1 and m.chance(0.4):
                part = BASE
                blind(m, x, how.depth, b, how)
            else:
                door(
                    m,
                    part,
                    x,
                    b,
                    m.pick("left", "right") if count == 1 else ("left" if k == 0 or (count == 3 and k == 1) else "right"),
                    how,
                    110,
                )
            if m.chance(0.7):
                m.add(part, sheet((x[0] + 0.01, x[1] - 0.01), how.depth[0] - 0.0005, (b[0] + 0.01, b[1] - 0.01)))
        for c in np.linspace(z, z + high, m.pick(3, 4))[1:-1] if hollow else []:
            m.add(BASE, box((0.014, wide - 0.014), (0.03, deep - 0.03), (c, c + 0.005)))
    if m.chance(0.5):
        lamp = m.pick("bar", "spots")
        if lamp == "bar":
            m.add(
                BASE,
                box((0.2 * wide, 0.8 * wide), (-0.1, -0.06), (z + high + 0.02, z + high + 0.04)),
                box((0.48 * wide, 0.52 * wide), (-0.08, 0.05), (z + high, z + high + 0.02)),
            )
        else:
            m.add(
                BASE,
                *(
                    rod((a, 0.04, z + high), (a, -0.05, z + high + 0.07), 0.006, 8)
                    for a in np.linspace(0, wide, count + 2)[1:-1]
                ),
            )
            m.add(BASE, *(ball((a, -0.06, z + high + 0.07), (0.03,) * 3, 10) for a in np.linspace(0, wide, count + 2)[1:-1]))
    if m.chance(0.4):
        m.add(BASE, box((0, wide), (-0.06, deep), (z - 0.03, z - 0.015)))


def vanity_unit(m: Model) -> None:
    """A wash-stand: doors, drawers and fixed fields below a basin, with a tap that stays or turns, perhaps on legs."""
    wide, high, deep = m.number(0.45, 1.4), m.number(0.4, 0.65), m.number(0.4, 0.52)
    foot, how = m.pick(0.0, 0.1, 0.2), look(m, 0.5)
    low, columns = foot if foot else 0.3, max(1, round(wide / 0.5))
    xs, rooms, jobs = np.linspace(0, wide, columns + 1), [], []
    for k, (a, b) in enumerate(itertools.pairwise(xs)):
        cuts = m.pick((), (0.5,), (0.75,), (0.33, 0.66))
        borders = low + high * np.array([0, *cuts, 1])
        for i, (c, d) in enumerate(itertools.pairwise(borders)):
            rooms.append(((float(a) + 0.008, float(b) - 0.008), (float(c) + 0.008, float(d) - 0.008)))
            jobs.append(
                "fixed" if i == len(cuts) and cuts and m.chance(0.3) else m.pick("drawer", "left" if k == 0 else "right")
            )
    hollow = body(m, (0, wide), (0, deep), (low, low + high), rooms, how)
    if foot:
        feet(m, (0, wide), (0, deep), foot)
    for k, ((x, z), job) in enumerate(zip(rooms, jobs, strict=True)):
        if job == "fixed":
            blind(m, x, how.depth, z, how)
        elif job == "drawer":
            drawer(m, f"drawer_{k}", x, z, deep, how, "box" if hollow and m.chance(0.7) else "none")
        else:
            door(m, f"door_{k}", x, z, job, how, m.pick(95, 110))
    top, n = low + high + 0.02, m.pick(12, 20, 32)
    m.add(BASE, box((-0.01, wide + 0.01), (-0.02, deep), (low + high, top)))
    for c in (wide / 2,) if wide < 1.1 else (0.27 * wide, 0.73 * wide):
        r, up = 0.18, m.number(0.06, 0.14)
        style = m.pick("bowl", "block", "flat")
        if style == "bowl":
            bowl = lathe([(0.5 * r, 0), (r, up), (0.93 * r, up), (0.45 * r, 0.012)], n, (c, 0.45 * deep, top))
            m.add(BASE, bowl)
        else:
            up = up if style == "block" else 0.012
            m.add(
                BASE,
                cut(
                    box((c - r, c + r), (0.02, deep - 0.1), (top, top + up)),
                    box((c - 0.9 * r, c + 0.9 * r), (0.035, deep - 0.115), (top + 0.006, top + 1)),
                ),
            )
        y, t = deep - 0.05, top + 0.1
        m.add(
            BASE,
            rod((c, y, top), (c, y, t), 0.015, 12),
            tube([(c, y, t - 0.02), (c, y - 0.12, t), (c, y - 0.13, t - 0.02)], 0.009, 8),
        )
        if m.chance(0.5):
            part = f"tap_lever_{round(c, 2)}".replace(".", "_")
            m.add(
                part,
                rod((c, y, t + 0.001), (c, y, t + 0.015), 0.013, 12),
                box((c - 0.006, c + 0.006), (y - 0.06, y), (t + 0.012, t + 0.019)),
            )
            m.hinge(part, (c, y, t), (0, 0, 1), (-45, 45))
    if m.chance(0.4):
        m.add(BASE, box((0, wide), (deep, deep + 0.012), (top, top + m.pick(0.08, 0.9))))
