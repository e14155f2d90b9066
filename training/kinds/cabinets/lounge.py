"""Furniture for sound and pictures: media consoles, record cabinets, racks for hi-fi."""

from __future__ import annotations

import numpy as np

from training.kinds.carcass import clutter
from training.kinds.kitchen_parts import pull
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import glazed, hang, middle
from training.kinds.shells import castors, manner, place, shell, things
from training.kinds.solids import Span, box, cut, prism, rectangle, ring, rod, rounded, tube


def hairpins(m: Model, x: Span, y: Span, high: float) -> None:
    """Bent wire legs, splayed round legs, or feet below a body."""
    style = m.pick("hairpin", "splayed", "feet", "sled")
    if style == "feet":
        feet(m, x, y, high)
        return
    if style == "sled":
        for a in (x[0] + 0.06, x[1] - 0.06):
            b, c, r = y[0] + 0.03, y[1] - 0.03, 0.01
            m.add(BASE, tube([(a, b, high), (a, b, r), (a, c, r), (a, c, high)], r, m.pick(4, 8)))
        return
    for a, sx in ((x[0] + 0.09, -1), (x[1] - 0.09, 1)):
        for b, sy in ((y[0] + 0.07, -1), (y[1] - 0.07, 1)):
            if style == "hairpin":
                m.add(BASE, tube([(a - 0.04, b, high), (a + 0.02 * sx, b + 0.02 * sy, 0.004), (a + 0.04, b, high)], 0.005, 6))
                m.add(BASE, box((a - 0.05, a + 0.05), (b - 0.03, b + 0.03), (high - 0.004, high)))
            else:
                m.add(BASE, rod((a + 0.05 * sx, b + 0.04 * sy, 0), (a, b, high), 0.018, m.sections()))


def media_console(m: Model) -> None:
    """A long low cabinet with flaps that drop, sliding doors, drawers and open rooms; perhaps hung on a wall."""
    wide, high, deep = m.number(1.2, 2.4), m.number(0.28, 0.5), m.number(0.36, 0.48)
    foot, how, t = m.pick(0.0, 0.1, 0.15, 0.22), manner(m), m.pick(0.016, 0.02, 0.03)
    plan = m.pick("flaps", "sliders", "mixed", "mixed", "bridge")
    if plan == "sliders":
        layout, jobs = [(m.number(1.8, 3.0), [1.0]), (1.0, [1.0, 1.0])], [["sliders"], ["open", m.pick("open", "drawer")]]
        if m.chance(0.4):
            layout, jobs = layout[::-1], jobs[::-1]
    elif plan == "flaps":
        count = m.pick(2, 3)
        layout, jobs = [(1.0, m.pick([1.0], [1.0, 0.7]))] * count, [["bottom", "open"]] * count
    else:
        sides = m.pick([["left"], ["right"]], [["drawer"] * 2] * 2, [["bottom"], ["bottom"]], [["drawer", "open"], ["bottom"]])
        centre = m.pick(["open", "open"], ["bottom", "open"], ["drawer", "open"], ["sliders"])
        jobs = [sides[0], centre, sides[1]]
        layout = [(1.0, [1.0] * len(jobs[0])), (m.number(1.2, 2.2), [1.0] * len(centre)), (1.0, [1.0] * len(jobs[2]))]
    z = (foot, foot + high)
    rooms = shell(m, (0, wide), (0, deep), z, layout, t)
    for k, (column, cells) in enumerate(zip(jobs, rooms, strict=True)):
        for i, (what, room) in enumerate(zip(column, cells, strict=False)):
            place(m, f"{'flap' if what == 'bottom' else what}_{k}_{i}", what, room, how, deep, t)
    if foot:
        hairpins(m, (0, wide), (0, deep), foot)
    else:
        m.add(BASE, box((0.1, wide - 0.1), (deep, deep + 0.02), (0.4 * high, 0.6 * high)))  # the rail on the wall
    if plan == "bridge":  # a lower shelf above the top
        m.add(BASE, *(box((a, a + 0.02), (0.08, deep), (z[1], z[1] + 0.14)) for a in (0.2 * wide, 0.8 * wide - 0.02)))
        m.add(BASE, box((0.2 * wide, 0.8 * wide), (0.08, deep), (z[1] + 0.14, z[1] + 0.16)))
    elif m.chance(0.4):
        m.add(BASE, box((0.2 * wide, 0.8 * wide), (0.5 * deep, 0.5 * deep + 0.03), (z[1] + 0.07, z[1] + 0.07 + 0.35 * wide)))
        m.add(BASE, *(box((a, a + 0.03), (0.25 * deep, 0.8 * deep), (z[1], z[1] + 0.075)) for a in (0.3 * wide, 0.68 * wide)))
    else:
        clutter(m, (0.1, wide - 0.1), (0.05, deep), z[1])


def _records(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """A row of record sleeves, some leaning out a little."""
    count = m.pick(0, 8, 14)
    for a in np.linspace(x[0] + 0.01, x[1] - 0.03, count) if count else []:
        m.add(part, box((a, a + 0.006), (y[0] + m.number(0, 0.01), y[1]), (z[0], z[0] + min(0.315, z[1] - z[0] - 0.01))))


def player(m: Model, x: float, y: float, z: float, parent: str = BASE) -> None:
    """A record player with a platter that turns, an arm, and perhaps a dust cover hinged at its back."""
    plinth, r = (x - 0.22, x + 0.22), 0.15
    m.add(parent, prism(rounded(plinth, (y - 0.17, y + 0.17), 0.02), "z", (z + 0.02, z + 0.07)))
    m.add(parent, *(rod((a, b, z), (a, b, z + 0.021), 0.02, 10) for a in (x - 0.17, x + 0.17) for b in (y - 0.12, y + 0.12)))
    at = (x - 0.05, y, z + 0.072)
    m.add("platter", rod(at, (at[0], at[1], at[2] + 0.016), r, m.pick(20, 32)))
    m.add("platter", rod(at, (at[0], at[1], at[2] + 0.025), 0.004, 8))
    m.spin("platter", at, (0, 0, 1), parent)
    pivot = (x + 0.17, y + 0.11, z + 0.07)
    m.add("arm", rod(pivot, (pivot[0], pivot[1], pivot[2] + 0.035), 0.02, 12))
    m.add(
        "arm",
        tube([(pivot[0], pivot[1] + 0.04, z + 0.1), (pivot[0], pivot[1] - 0.17, z + 0.1), (x + 0.13, y - 0.1, z + 0.1)], 0.005),
    )
    m.hinge("arm", pivot, (0, 0, -1), m.pick(30, 45), parent)
    if m.chance(0.5):
        cover = box(plinth, (y - 0.17, y + 0.17), (z + 0.072, z + 0.15))
        m.add("dust_cover", cut(cover, box((x - 0.216, x + 0.216), (y - 0.166, y + 0.166), (z, z + 0.146))))
        m.hinge("dust_cover", (x, y + 0.17, z + 0.072), (-1, 0, 0), m.pick(60, 75, 90), parent)


def vinyl_cabinet(m: Model) -> None:
    """A record cabinet: a top that flips up over a player or a bin of sleeves, rooms for records, bins that tip out."""
    wide, deep, foot, how = m.number(0.75, 1.3), m.number(0.4, 0.48), m.pick(0.06, 0.16, 0.22), manner(m)
    style, t, high = m.pick("flip", "flip", "tip", "player"), 0.018, m.number(0.55, 0.85)
    well = m.number(0.2, 0.3) if style == "flip" else 0.0
    x, y, z = (0.0, wide), (0.0, deep), (foot, foot + high - well)
    count = m.pick(2, 3) if wide > 0.95 else 2
    what = m.pick(["pair", "open"], ["left", "right", "open"], ["open", "drawer", "open"], ["bottom", "bottom", "bottom"])
    what = ["tip" for _ in range(count)] if style == "tip" else (what * 2)[:count]
    if style == "player" and "open" in what:
        what[0] = "left"
    layout = [(1.0, [1.0]) for _ in range(count)]
    for k, ((room,), job) in enumerate(zip(shell(m, x, y, z, layout, t), what, strict=True)):
        if job == "tip":
            _tip(m, f"bin_{k}", *room, deep, how.clear)
        else:
            place(m, f"{'flap' if job == 'bottom' else job}_{k}", job, room, how, deep, t)
            _records(m, BASE, room[0], (0.06, deep - 0.03), room[1])
    hairpins(m, x, y, foot)
    if style == "flip":
        low, top = z[1], z[1] + well
        m.add(BASE, prism(rectangle(x, y, t), "z", (low, top)))
        lid, split = m.number(0.016, 0.025), m.chance(0.35)
        parts = ((0.0, 0.5), (0.5, 1.0)) if split else ((0.0, 1.0),)
        for k, (a, b) in enumerate(parts):
            span = (a * wide + 0.001, b * wide - 0.001)
            m.add(f"lid_{k}", box(span, (y[0] - m.pick(0.0, 0.015), y[1]), (top + 0.001, top + lid)))
            if m.chance(0.5):
                c = middle(span)
                m.add(f"lid_{k}", box((c - 0.04, c + 0.04), (-0.03, 0.002), (top + 0.002, top + 0.01)))
            m.hinge(f"lid_{k}", (middle(span), deep, top + m.pick(0.0, lid)), (-1, 0, 0), m.pick(75, 90, 100))
        _records(m, BASE, (t, 0.5 * wide), (0.06, deep - 0.05), (low, low + well - 0.01))
    else:
        player(m, wide * m.pick(0.35, 0.5, 0.6), deep / 2, z[1])


def _tip(m: Model, part: str, x: Span, z: Span, deep: float, clear: float) -> None:
    """A bin that tips out about its lower edge, open above, with sleeves in it."""
    x, z, t = (x[0] + clear, x[1] - clear), (z[0] + 0.002, z[1] - 0.002), 0.012
    reach = min(0.6 * deep, 0.28)
    m.add(part, box(x, (0.0, 0.016), z), box((x[0] + 0.01, x[1] - 0.01), (0.016, reach), (z[0], z[0] + t)))
    side = [(0.016, z[0] + t), (reach, z[0] + t), (reach, z[0] + 0.35 * (z[1] - z[0])), (0.016, z[1] - 0.05)]
    m.add(part, *(prism(side, "x", (a, a + 0.008)) for a in (x[0] + 0.01, x[1] - 0.018)))
    m.add(part, box((middle(x) - 0.05, middle(x) + 0.05), (-0.02, 0.0), (z[1] - 0.04, z[1] - 0.03)))
    for b in np.linspace(0.05, 0.6 * reach, m.pick(0, 3, 6)):
        m.add(part, box((x[0] + 0.03, x[1] - 0.03), (b, b + 0.005), (z[0] + t, z[0] + 0.5 * (z[1] - z[0]))))
    m.hinge(part, (middle(x), 0.0, z[0]), (1, 0, 0), m.pick(25, 30, 35))


def hi_fi_rack(m: Model) -> None:
    """A tall narrow rack with a door of glass before shelves of devices, a player on top, perhaps on castors."""
    wide, deep, high, foot = m.number(0.46, 0.62), m.number(0.38, 0.48), m.number(0.7, 1.15), m.pick(0.05, 0.07, 0.09)
    t, count, how = m.pick(0.015, 0.02), m.pick(3, 4, 5), manner(m, ("glass",), ("knob", "none", "bar", "rim"))
    x, z = (0.0, wide), (foot, foot + high)
    style = m.pick("frameless", "framed", "pair", "drawer")
    shares = [m.number(0.8, 1.4) for _ in range(count)]
    cells = shell(m, x, (0, deep), z, [(1.0, shares)], t)[0]
    low = cells[1][1][0] - t / 2 if style == "drawer" else z[0]
    for a, b in cells[1 if style == "drawer" else 0 :]:
        things(m, BASE, a, (0.05, deep - 0.04), b)
        if m.chance(0.5):
            m.add(
                BASE,
                *(rod((c, 0.046, middle(b) - 0.01), (c, 0.052, middle(b) - 0.01), 0.01, 10) for c in (0.3 * wide, 0.6 * wide)),
            )
    if style == "drawer":
        place(m, "drawer", "drawer", cells[0], how if m.chance(0.2) else manner(m, ("slab", "rounded", "shaker")), deep, t)
    thick, side = 0.006 if style == "frameless" else 0.018, m.pick("left", "right")
    y, tall = (-thick - 0.001, -0.001), (low + 0.004, z[1] - 0.004)
    leaves = (("door", x, side),)
    if style == "pair":
        leaves = (("door_left", (0.0, wide / 2 - 0.001), "left"), ("door_right", (wide / 2 + 0.001, wide), "right"))
    for part, span, at in leaves:
        if style == "frameless":
            m.add(part, box(span, y, tall))
            c = span[1] - 0.03 if at == "left" else span[0] + 0.03
            m.add(part, rod((c, y[0] - 0.012, middle(tall)), (c, y[0], middle(tall)), 0.01, m.sections()))
            e = span[0] if at == "left" else span[1] - 0.03
            m.add(part, *(box((e, e + 0.03), (y[0] - 0.004, y[0]), (d, d + 0.04)) for d in (tall[0] + 0.02, tall[1] - 0.06)))
        else:
            glazed(m, part, span, y, tall, m.number(0.02, 0.05))
            pull(m, part, how, span, y[0], tall, "right" if at == "left" else "left")
        hang(m, part, span, y, tall, at, -1, m.pick(100, 120))
    if m.chance(0.5):
        castors(m, x, (0, deep), foot)
    else:
        feet(m, x, (0, deep), foot)
    if m.chance(0.5):
        player(m, wide / 2, deep / 2, z[1])
    elif m.chance(0.4):
        m.add(BASE, ring((wide / 2, 0.5 * deep, z[1] + 0.01), (0, 0, 1), 0.08, 0.01))
