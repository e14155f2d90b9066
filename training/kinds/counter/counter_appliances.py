"""Air fryers, and the shapes that small appliances share."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from trimesh import Trimesh

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import body, door, look, rack, tray
from training.kinds.kitchen_trims import button, cable, dial, feet, lathe, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Point, Span, box, common, cut, loft, prism, ring, rod, rounded, tube, vec


def tower(x: Span, y: Span, corner: float, levels: Sequence[tuple[float, float]]) -> Trimesh:
    """A standing body with round corners; levels: how wide it is (share) at a height."""
    outline = np.array(rounded(x, y, corner).exterior.coords)[:-1]
    center = np.array([middle(x), middle(y)])
    return loft(np.stack([np.c_[center + s * (outline - center), np.full(len(outline), z)] for s, z in levels]))


def bar(path: Sequence[Point], radius: float, sections: int = 8) -> Trimesh:
    """A round bar along a path; it keeps its thickness where it stands upright."""
    points = np.asarray(path, float)
    flat = int(np.argmin(np.ptp(points, axis=0)))
    order = [(flat + 1) % 3, (flat + 2) % 3, flat]
    solid = tube(points[:, order], radius, sections)
    return Trimesh(solid.vertices[:, np.argsort(order)], solid.faces, process=False)


def hood(profile: Sequence[tuple[float, float]], wall: float, n: int) -> Trimesh:
    """A round lid that is hollow below; profile: radius and height, from its rim up."""
    inner = [(max(r - wall, 0.001), z - (wall if k else 0.0)) for k, (r, z) in enumerate(profile)]
    return lathe([*inner[::-1], *profile], n)


def back_hinge(m: Model, part: str, at: Point, half: float, degrees: float, parent: str = BASE) -> None:
    """A lid's hinge at its back edge; perhaps with barrels on the lid or on what carries it."""
    x, y, z = at
    for c in m.pick((-0.6, 0.6), (-0.4, 0.4), (0.0,), ()):
        m.add(m.pick(part, parent), rod((x + (c - 0.2) * half, y, z), (x + (c + 0.2) * half, y, z), m.pick(0.004, 0.007), 10))
    m.hinge(part, at, (-1, 0, 0), degrees, parent)


def air_fryer(m: Model) -> None:
    """Make a fryer with one or two drawers, with glass doors, or with a lid; dials, buttons or a display, round or square."""
    m.pick(_drawer_fryer, _drawer_fryer, _drawer_fryer, _oven_fryer, _lid_fryer)(m)


def _drawer_fryer(m: Model) -> None:
    way = m.pick("one", "one", "one", "beside", "stacked")
    w, d = m.number(0.36, 0.42) if way == "beside" else m.number(0.24, 0.3), m.number(0.27, 0.36)
    h = m.number(0.38, 0.44) if way == "stacked" else m.number(0.29, 0.36)
    corner, taper = m.pick(0.08, 0.25, 0.46) if way == "one" else 0.12, m.pick(1.0, 0.93, 0.82)
    x, y, top = (-w / 2, w / 2), (-d / 2, d / 2), m.number(0.55, 0.66) * h
    levels = [(0.93, 0.008), (1, 0.03), (1, top), ((1 + taper) / 2, 0.88 * h), (taper, 0.97 * h), (0.85 * taper, h)]
    whole = shell = tower(x, y, corner * min(w, d), levels)
    side, clear = (0.06 if corner < 0.4 else 0.1) * w, max(m.gap(0.3), 0.0)
    cells = [((x[0] + side, x[1] - side), (0.035, top))]
    if way == "beside":
        cells = [((x[0] + 0.02, -0.006), cells[0][1]), ((0.006, x[1] - 0.02), cells[0][1])]
    elif way == "stacked":
        cells = [(cells[0][0], (0.035, top / 2)), (cells[0][0], (top / 2 + 0.012, top))]
    deep = -d / 2 + (0.03 if corner < 0.2 else 0.3 * corner * d)
    for k, (a, b) in enumerate(cells):
        part = f"drawer_{k}" if len(cells) > 1 else "drawer"
        shell = cut(shell, box(a, (-d, deep), b), box(shrunk(a, 0.014), (-d, 0.4 * d), shrunk(b, 0.01)))
        m.add(part, common(whole, box(shrunk(a, clear), (-d, deep - 0.001), shrunk(b, clear))))
        if m.chance(0.85):
            tray(m, part, shrunk(a, 0.022), (deep - 0.002, 0.36 * d), (b[0] + 0.016, b[1] - 0.02), m.pick("tub", "tub", "box"))
        _fryer_handle(m, part, vec(middle(a), -d / 2, b[0] + 0.55 * (b[1] - b[0])), 0.3 * (a[1] - a[0]))
        m.slide(part, (0, -1, 0), m.number(0.6, 0.8) * d)
    m.add(BASE, shell, *(rod((a, b, 0), (a, b, 0.012), 0.012, 8) for a in (-0.3 * w, 0.3 * w) for b in (-0.3 * d, 0.3 * d)))
    _fryer_controls(m, w, d, h, top, taper == 1.0 and corner < 0.3)
    if m.chance(0.5):
        m.add(BASE, box((-0.2 * w, 0.2 * w), (0.4 * d * taper, d / 2 + 0.015), (0.4 * h, 0.75 * h)))
    if m.chance(0.4):
        cable(m, (0, d / 2 - 0.01, 0.05), 0.2)


def _fryer_handle(m: Model, part: str, at: np.ndarray, half: float) -> None:
    out, style = m.number(0.04, 0.1), m.pick("pistol", "pistol", "bar", "loop", "wide")
    y = at[1]
    if style == "pistol":
        r, low = m.number(0.013, 0.018), m.pick(0.0, 0.03)
        grip = [(y + 0.02, -r), (y - out, -r - low), (y - out, r - low), (y + 0.02, 1.2 * r)]
        m.add(part, prism([(b, at[2] + c) for b, c in grip], "x", (at[0] - r, at[0] + r)))
        if low == 0.0 and m.chance(0.5):
            button(m, f"{part}_release", at + vec(0, -0.5 * out, 1.02 * r), (0, 0, 1), 0.014, part)
        return
    if style == "wide":
        m.add(part, box((at[0] - half, at[0] + half), (y - 0.4 * out, y + 0.02), (at[2] + 0.01, at[2] + 0.032)))
        return
    along = vec(half, 0, 0) if style == "bar" else vec(0, 0, 0.035)
    path = [at - along + vec(0, 0.015, 0), at - along + vec(0, -out, 0), at + along + vec(0, -out, 0)]
    m.add(part, bar([*path, at + along + vec(0, 0.015, 0)], 0.008, m.pick(6, 8)))


def _fryer_controls(m: Model, w: float, d: float, h: float, top: float, flat: bool) -> None:
    style, level = m.pick("dials", "dials", "display", "both"), (top + 0.96 * h) / 2
    axis = (0, -1, 0) if flat else (0, 0, 1)
    r = min(0.026, 0.3 * (h - top))
    spots = m.pick((0.0,), (-0.2, 0.2)) if style == "dials" else (0.24,)
    if style != "display":
        for k, c in enumerate(spots):
            dial(m, f"dial_{k}", (c * w, -d / 2, level) if flat else (c * w, -0.1 * d, h), axis, r)
    if style != "dials":
        a = (-0.28 * w, 0.28 * w) if style == "display" else (-0.28 * w, 0.1 * w)
        m.add(
            BASE,
            box(a, (-d / 2 - 0.002, 0), shrunk((level - r, level + r), 0.004))
            if flat
            else box(a, (-0.2 * d, -0.05 * d), (h - 0.01, h + 0.002)),
        )
    elif m.chance(0.4):
        m.add(BASE, ring((0, 0.25 * d, h), (0, 0, 1), 0.1 * w, 0.004, 16))


def _oven_fryer(m: Model) -> None:
    w, d, h, foot = m.number(0.3, 0.42), m.number(0.28, 0.38), m.number(0.3, 0.42), m.pick(0.015, 0.025)
    how = look(m, w, ("glass", "glass", "framed", "slab"), ("bar", "rail", "merged", "rim"))
    aside = m.chance(0.3)
    room = ((0.025, w - (0.09 if aside else 0.025)), (foot + 0.03, foot + h - (0.025 if aside else 0.09)))
    hollow = body(m, (0, w), (0, d), (foot, foot + h), [room], how)
    side = m.pick("bottom", "bottom", "left", "french")
    if side == "french":
        half = middle(room[0])
        door(m, "door_left", (room[0][0], half), room[1], "left", how, 110)
        door(m, "door_right", (half, room[0][1]), room[1], "right", how, 110)
    else:
        door(m, "door", *room, side, how, 90 if side == "bottom" else 120)
    inner, low = shrunk(room[0], 0.004), room[1][0]
    if hollow and m.chance(0.35):
        z, r = middle(room[1]), 0.4 * (room[1][1] - room[1][0])
        m.add("cage", *(ring((a, d / 2, z), (1, 0, 0), r, 0.003, 16) for a in shrunk(inner, 0.03)))
        m.add(
            "cage",
            *(
                rod(
                    (inner[0], d / 2 + r * np.cos(t), z + r * np.sin(t)),
                    (inner[1], d / 2 + r * np.cos(t), z + r * np.sin(t)),
                    0.002,
                    5,
                )
                for t in np.arange(0, 6.2, 0.8)
            ),
            rod((inner[0], d / 2, z), (inner[1], d / 2, z), 0.003, 6),
        )
        m.spin("cage", (w / 2, d / 2, z), (1, 0, 0))
    elif hollow:
        for k in range(m.pick(1, 2)):
            rack(m, BASE, inner, (how.depth[1] + 0.02, d - 0.035), low + (0.25 + 0.35 * k) * (room[1][1] - low))
    spots = m.pick((0.25, 0.5, 0.75), (0.5,), (0.2, 0.8), ())
    for k, c in enumerate(spots):
        at = (w - 0.045, 0, foot + c * h) if aside else (c * w, 0, foot + h - 0.045)
        dial(m, f"dial_{k}", at, (0, -1, 0), m.number(0.016, 0.024))
    if not spots:
        trims(m, BASE, (w - 0.08, w - 0.01) if aside else (0.05, w - 0.05), 0, (foot + h - 0.08, foot + h - 0.01), 3)
    feet(m, (0, w), (0, d), foot)


def _lid_fryer(m: Model) -> None:
    r, h, n = m.number(0.13, 0.16), m.number(0.2, 0.26), m.pick(20, 28, 36)
    m.add(BASE, lathe([(0.9 * r, 0), (r, 0.03), (r, h), (0.85 * r, h), (0.82 * r, 0.05)], n))
    z = h + m.number(0.05, 0.11)
    m.add(
        "lid", lathe([(r, h + m.pick(0.0, 0.002)), (1.01 * r, h + 0.02), (m.pick(0.95, 0.75) * r, z - 0.01), (0.5 * r, z)], n)
    )
    m.add(
        "lid",
        m.pick(
            box((-0.05, 0.05), (-r - 0.035, -0.9 * r), (h + 0.006, h + 0.024)),
            bar(
                [
                    (-0.05, -0.3 * r, z - 0.01),
                    (-0.05, -0.3 * r, z + 0.03),
                    (0.05, -0.3 * r, z + 0.03),
                    (0.05, -0.3 * r, z - 0.01),
                ],
                0.007,
                8,
            ),
        ),
    )
    m.add(BASE, box((-0.04, 0.04), (0.9 * r, r + 0.03), (0.5 * h, h)))
    m.add("lid", box((-0.03, 0.03), (0.85 * r, r + 0.025), (h + 0.002, h + 0.022)))
    back_hinge(m, "lid", (0, r + 0.02, h + 0.002), 0.04, m.pick(80, 95, 105))
    m.add(BASE, box((-0.07, 0.07), (-r - 0.012, -0.8 * r), (0.15 * h, 0.7 * h)))
    if m.chance(0.6):
        dial(m, "dial", (0, -r - 0.012, 0.42 * h), (0, -1, 0), 0.03)
    else:
        m.add(BASE, box((-0.05, 0.05), (-r - 0.014, -r), (0.4 * h, 0.62 * h)))
        for k in range(3):
            button(m, f"button_{k}", (0.035 * (k - 1), -r - 0.012, 0.27 * h), (0, -1, 0), 0.016)
    for s in (-1, 1) if m.chance(0.7) else ():
        m.add(BASE, box(tuple(sorted((0.95 * s * r, s * (r + 0.03)))), (-0.04, 0.04), (0.7 * h, 0.7 * h + 0.02)))
