"""Boxes of one artist that are carried or filled: lunch boxes, pill organizers."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, box, cut, prism, rod, rounded, tube, vec
from training.kinds.trinket_style import Look, draw_look, slab, tray, without


def lunch_box(m: Model) -> None:
    """A bento box with clips, a tin with a domed lid, or stacked tiers; perhaps with a handle and an insert."""
    look = draw_look(m)
    wide, deep = m.number(0.15, 0.24), m.number(0.1, 0.16)
    kind = m.pick("bento", "dome", "tiers", "bento")
    x, y, wall = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.002, 0.004)
    radius = m.pick(0.0, 0.15, 0.3) * deep if kind != "dome" else 0.0
    high, z = m.number(0.045, 0.09), 0.0
    count = m.pick(2, 3) if kind == "tiers" else 1
    for k in range(count):
        part = f"tier_{k}" if k else BASE
        m.add(part, *tray(look, x, y, (z, z + high), wall, radius))
        if k:
            m.slide(part, (0, 0, 1), 0.8 * high, f"tier_{k - 1}" if k > 1 else BASE)
        z += high + 0.0004
    last = f"tier_{count - 1}" if count > 1 else BASE
    top = _lunch_lid(m, look, kind, (x, y), z, radius)
    lifted = kind == "tiers" or m.chance(0.3)
    if lifted:
        m.slide("lid", (0, 0, 1), m.number(0.5, 0.9) * high, last)
    else:
        m.hinge("lid", (0, y[1] + wall, z), (-1, 0, 0), m.pick(95, 110, 140))
        m.add(
            BASE,
            *(
                rod((a - 0.1 * wide, y[1] + wall, z), (a + 0.1 * wide, y[1] + wall, z), wall, 8)
                for a in (-0.3 * wide, 0.3 * wide)
            ),
        )
    if m.chance(0.75):
        _clips(m, (wide, deep), z, top, (1, -1) if lifted else (-1,))
    if kind == "dome" or m.chance(0.3):
        _folding_handle(m, look, 0.35 * wide, top, wall)
    if kind == "bento" and look.style in ("hollowed", "assembly", "soft") and m.chance(0.6):
        a = (x[0] + 2 * wall, m.number(0.0, 0.1) * wide)
        m.add("insert", *tray(look, a, (y[0] + 2 * wall, y[1] - 2 * wall), (0.4 * high, 0.97 * high), 0.7 * wall, 0.7 * radius))
        m.slide("insert", (0, 0, 1), 0.9 * high)


def _lunch_lid(m: Model, look: Look, kind: str, span: tuple[Span, Span], z: float, radius: float) -> float:
    """A flat, a stepped or a domed lid; returns its top."""
    x, y = span
    if kind == "dome":
        rise = m.number(0.4, 0.6) * (y[1] - y[0])
        solid = prism(arch(y, (z, z + rise), 0.8 * rise, 8 if look.plain else 20), "x", x)
        if look.style == "sheet":
            solid = without(solid, (0, 0, -1))
        elif look.style != "blocky":
            t = 0.003
            solid = cut(
                solid, prism(arch((y[0] + t, y[1] - t), (z - t, z + rise - t), 0.8 * rise, 20), "x", (x[0] + t, x[1] - t))
            )
        m.add("lid", solid)
        return z + rise
    thick = m.number(0.008, 0.02)
    edge = m.pick(0.0, 0.002, 0.004)
    a, b = (x[0] - edge, x[1] + edge), (y[0] - edge, y[1] + edge)
    m.add("lid", *slab(look, a, b, (z, z + thick), radius + edge if radius else 0.0))
    if m.chance(0.5):
        m.add(
            "lid",
            *slab(
                look,
                (0.8 * x[0], 0.8 * x[1]),
                (0.75 * y[0], 0.75 * y[1]),
                (z + 0.8 * thick, z + 1.25 * thick),
                0.1 * radius + 0.004,
            ),
        )
    return z + thick


def _clips(m: Model, size: tuple[float, float], z: float, top: float, sides: tuple[int, ...]) -> None:
    """Clips that hang on the lid and hold under a rim of the box."""
    wide, deep = size
    reach, thick = m.number(0.018, 0.028), m.number(0.003, 0.005)
    fall = min(top - z, 0.012)
    places = m.pick((0.0,), (-0.28, 0.28)) if len(sides) == 1 or m.chance(0.5) else (0.0,)
    clip = 0 if len(sides) == 1 else m.pick(0, 1)
    for side in sides:
        for at in places:
            name = f"clip_{sum(p.startswith('clip') for p in m.joints)}"
            half, edge = 0.09 * wide, (deep if clip == 0 else wide) / 2 + 0.004
            a = at * (wide if clip == 0 else deep)
            pivot = vec(a, side * (edge + thick / 2), z + 0.6 * fall)
            parts = [box((a - half, a + half), (side * edge, side * (edge + thick)), (z - reach, z + 0.9 * fall))]
            parts.append(
                box(
                    (a - 0.8 * half, a + 0.8 * half), (side * edge, side * (edge + 1.8 * thick)), (z - reach, z - reach + thick)
                )
            )
            hook = box((a - half, a + half), (side * (edge - 0.004), side * edge), (z - 0.6 * reach, z - 0.6 * reach + 0.004))
            pin = rod(
                (a - 0.9 * half, side * (edge - 0.003), pivot[2]), (a + 0.9 * half, side * (edge - 0.003), pivot[2]), 0.003, 8
            )
            axis = vec(side, 0, 0)
            if clip == 1:
                for solid in (*parts, hook, pin):
                    solid.vertices = solid.vertices[:, [1, 0, 2]] * (1, -1, 1)
                pivot, axis = vec(pivot[1], -pivot[0], pivot[2]), vec(0, -side, 0)
            m.add(name, *parts)
            m.add(BASE if m.joints["lid"].parent == BASE else m.joints["lid"].parent, hook)
            m.add("lid", pin)
            m.hinge(name, pivot, axis, m.pick(60, 90, 110), "lid")


def _folding_handle(m: Model, look: Look, half: float, top: float, wall: float) -> None:
    """A bail on the lid, lying or standing."""
    r, rise = max(wall, 0.003), m.number(0.035, 0.05)
    path = [vec(-half, 0, top + r), vec(-half, -rise, top + r), vec(half, -rise, top + r), vec(half, 0, top + r)]
    if not look.plain:
        path = [
            path[0],
            vec(-half, -0.75 * rise, top + r),
            vec(-0.85 * half, -rise, top + r),
            vec(0.85 * half, -rise, top + r),
            vec(half, -0.75 * rise, top + r),
            path[-1],
        ]
    m.add("handle", tube(path, r, 8))
    m.hinge("handle", (0, 0, top + r), (-1, 0, 0), m.pick(90, 110, 170), "lid")
    m.add(
        "lid",
        *(box((s * half - 2 * r, s * half + 2 * r), (-1.5 * r, 1.5 * r), (top - 0.3 * r, top + 1.2 * r)) for s in (-1, 1)),
    )


def pill_organizer(m: Model) -> None:
    """A row or a grid of small boxes, or a wheel of them, each with a lid of its own."""
    look = draw_look(m)
    if m.chance(0.25):
        _pill_wheel(m, look)
        return
    columns, rows = m.pick(3, 4, 5, 7, 7), m.pick(1, 1, 2, 3)
    w, d, high = m.number(0.02, 0.034), m.number(0.024, 0.04), m.number(0.014, 0.026)
    wall, thick = 0.0012, m.number(0.0012, 0.003)
    long, radius = columns * w, m.pick(0.0, 0.15, 0.4) * w
    _pill_body(m, look, (columns, rows), (w, d, high), wall, radius)
    gap, lip, angle = m.pick(0.0002, 0.0006, 0.001), m.chance(0.6), m.pick(90, 110, 150)
    dome = m.chance(0.3) and not look.plain
    for i in range(columns):
        for j in range(rows):
            name = f"lid_{i * rows + j}"
            x, y = (i * w + gap, (i + 1) * w - gap), (j * d + gap, (j + 1) * d - gap)
            m.add(name, *slab(look, x, y, (high + 0.0001, high + thick), radius))
            if lip:
                m.add(
                    name,
                    box((x[0] + 0.3 * w, x[1] - 0.3 * w), (y[0], y[0] + 0.12 * d), (high + 0.6 * thick, high + 1.9 * thick)),
                )
            if dome:
                m.add(
                    name,
                    *slab(
                        look,
                        (x[0] + 0.2 * w, x[1] - 0.2 * w),
                        (y[0] + 0.25 * d, y[1] - 0.15 * d),
                        (high + 0.9 * thick, high + 1.5 * thick),
                        0.2 * w,
                    ),
                )
            m.hinge(name, ((x[0] + x[1]) / 2, y[1], high + thick / 2), (-1, 0, 0), angle if rows == 1 else min(angle, 90))
    if look.style in ("assembly", "old"):
        m.add(BASE, *(rod((0, (j + 1) * d, high), (long, (j + 1) * d, high), 0.0009, 8) for j in range(rows)))


def _pill_wheel(m: Model, look: Look) -> None:
    """Wedges round a middle, their lids hung at the middle."""
    count, r, high = m.pick(6, 7, 8), m.number(0.04, 0.065), m.number(0.014, 0.025)
    hub, thick, n = 0.25 * r, m.number(0.0015, 0.003), max(look.n, 24)
    drum = rod((0, 0, 0), (0, 0, high), r, n)
    wedges = [_wedge(k, count, 1.15 * hub, 0.94 * r) for k in range(count)]
    m.add(BASE, drum if look.plain else cut(drum, *(prism(w.buffer(-0.0008), "z", (0.0015, 1)) for w in wedges)))
    m.add(BASE, rod((0, 0, 0), (0, 0, high + 1.5 * thick), 0.95 * hub, n))
    for k in range(count):
        name = f"lid_{k}"
        m.add(name, prism(_wedge(k, count, 1.1 * hub, 0.97 * r), "z", (high + 0.0001, high + thick)))
        middle = 2 * np.pi * (k + 0.5) / count
        c, s = np.cos(middle), np.sin(middle)
        if look.style in ("soft", "old", "assembly"):
            m.add(name, rod((0.85 * r * c, 0.85 * r * s, high), (0.85 * r * c, 0.85 * r * s, high + 2 * thick), 0.06 * r, 10))
        m.hinge(name, (1.1 * hub * c, 1.1 * hub * s, high + thick), (s, -c, 0), 100)


def _wedge(k: int, count: int, inner: float, outer: float) -> Polygon:
    """The k-th of the equal pieces of a ring."""
    t = np.linspace(2 * np.pi * (k + 0.03) / count, 2 * np.pi * (k + 0.97) / count, 6)
    arc = np.c_[np.cos(t), np.sin(t)]
    return Polygon(np.concatenate([outer * arc, inner * arc[::-1]]))


def _pill_body(
    m: Model, look: Look, grid: tuple[int, int], cell: tuple[float, float, float], wall: float, radius: float
) -> None:
    """The box below the lids, with partitions or with a hole a lid."""
    (columns, rows), (w, d, high) = grid, cell
    long, deep, edge = columns * w, rows * d, m.pick(0.0, 0.002)
    if look.style in ("blocky", "sheet"):
        m.add(BASE, *tray(look, (-edge, long + edge), (-edge, deep + edge), (0, high), wall))
        m.add(BASE, *(box((k * w - wall / 2, k * w + wall / 2), (0, deep), (0, high)) for k in range(1, columns)))
        m.add(BASE, *(box((0, long), (k * d - wall / 2, k * d + wall / 2), (0, high)) for k in range(1, rows)))
    else:
        holes = [
            prism(
                rounded((i * w + wall, (i + 1) * w - wall), (j * d + wall, (j + 1) * d - wall), max(radius - wall, 0.001)),
                "z",
                (wall, high + 1),
            )
            for i in range(columns)
            for j in range(rows)
        ]
        m.add(BASE, cut(prism(rounded((-edge, long + edge), (-edge, deep + edge), radius + 0.001), "z", (0, high)), *holes))
