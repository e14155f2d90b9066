"""Furniture of halls: benches for shoes, hall stands, padded boxes to sit on."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot
from shapely.geometry import Polygon

from training.kinds.cabinets.drawers import flap
from training.kinds.carcass import clutter
from training.kinds.furniture.seating import cushion
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, middle
from training.kinds.shells import manner, place, shell, wing
from training.kinds.solids import Span, arch, ball, box, cut, prism, rectangle, rod, rounded, tube


def _shoes(m: Model, x: Span, y: Span, z: float, count: int) -> None:
    """Pairs of shoes side by side on a shelf."""
    share = (x[1] - x[0]) / max(count, 1)
    for k in range(count):
        for a in (x[0] + (k + 0.3) * share, x[0] + (k + 0.62) * share):
            half, long = min(0.045, 0.14 * share), min(0.28, y[1] - y[0])
            low = [(y[0], z), (y[0] + long, z), (y[0] + long, z + 0.07), (y[0] + 0.5 * long, z + 0.06), (y[0], z + 0.03)]
            m.add(BASE, prism(low, "x", (a - half, a + half)))


def shoe_bench(m: Model) -> None:
    """A low bench over fronts that tilt out, drawers, doors or open racks; a pad or a lid to sit on, perhaps arms."""
    wide, deep, high, foot = m.number(0.6, 1.3), m.number(0.3, 0.4), m.number(0.36, 0.46), m.pick(0.0, 0.05, 0.1)
    how, t, style = manner(m), 0.018, m.pick("tilt", "tilt", "lid", "drawers", "mixed")
    x, y, z, columns = (0.0, wide), (0.0, deep), (foot, foot + high), m.pick(1, 2) if wide < 0.8 else m.pick(2, 3)
    tray = m.number(0.1, 0.14) if style == "lid" else 0.0
    jobs = {"tilt": ["tilt"], "lid": ["open"], "drawers": ["drawer"]}.get(style, ["open", "left", "tilt"])
    shares = m.pick([1.0], [1.0, 1.0]) if style in ("lid", "drawers") else [1.0]
    rooms = shell(m, x, y, (z[0], z[1] - tray), [(1.0, shares)] * columns, t)
    for k, cells in enumerate(rooms):
        for i, (a, b) in enumerate(cells):
            job = jobs[k % len(jobs)]
            if job == "tilt":
                lap = t / 2 - 0.001 if how.sunk is None else 0.0
                span, tall = (a[0] - lap, a[1] + lap), (b[0] - lap, b[1] + lap)
                flap(m, f"flap_{k}", span, tall, deep, how, m.pick("bucket", "racks", "none"), m.pick(30, 40, 50))
            elif job == "open":
                _shoes(m, a, (0.03, deep - 0.02), b[0], m.pick(0, 1, 2))
            else:
                place(m, f"{'drawer' if job == 'drawer' else 'door'}_{k}_{i}", job, (a, b), how, deep, t)
    if foot:
        feet(m, x, y, foot)
    top = z[1]
    if tray:
        m.add(BASE, prism(rectangle(x, y, t), "z", (top - tray, top)))
        m.add("seat", box((x[0], x[1]), (m.pick(0.0, -0.015), deep), (top + 0.001, top + 0.02)))
        if m.chance(0.7):
            m.add("seat", cushion(m, (0.01, wide - 0.01), (0.0, deep - 0.01), (top + 0.02, top + m.number(0.05, 0.08))))
        m.hinge("seat", (wide / 2, deep, top + 0.001), (-1, 0, 0), m.pick(70, 85, 95))
    else:
        m.add(BASE, box((-0.01, wide + 0.01), (-0.01, deep), (top, top + 0.02)))
        pads = m.pick(0, 1, 2)
        for k in range(pads):
            span = (k * wide / pads + 0.005, (k + 1) * wide / pads - 0.005)
            m.add(BASE, cushion(m, span, (0.0, deep - 0.005), (top + 0.02, top + 0.07)))
    if not tray and m.chance(0.3):  # an arm or two
        for a in m.pick((0.0,), (0.0, wide - 0.03)):
            m.add(BASE, prism(rectangle(y, (top, top + 0.2), 0.03), "x", (a, a + 0.03)))
    elif m.chance(0.3):
        m.add(BASE, prism(rectangle(x, (top, top + 0.3), 0.04), "y", (deep, deep + 0.02)))


def hall_stand(m: Model) -> None:
    """A tall back with hooks and a mirror over a seat with a lid, a drawer or doors; a shelf above, a ring for umbrellas."""
    wide, deep, high, seat = m.number(0.6, 1.2), m.number(0.32, 0.42), m.number(1.75, 2.1), m.number(0.4, 0.5)
    style, how, t, foot = m.pick("lid", "drawer", "console", "doors"), manner(m), 0.02, m.pick(0.03, 0.08)
    x, y = (0.0, wide), (0.0, deep)
    seat = m.number(0.72, 0.82) if style == "console" else seat
    if style == "lid":
        m.add(BASE, prism(rectangle(x, y, t), "z", (foot, seat)), box(x, y, (foot, foot + t)))
        m.add("seat", box((-0.01, wide + 0.01), (-0.015, deep - 0.022), (seat + 0.001, seat + 0.022)))
        m.hinge("seat", (wide / 2, deep - 0.022, seat + m.pick(0.001, 0.022)), (-1, 0, 0), m.pick(70, 85))
        m.add(BASE, prism(rectangle((0.05, wide - 0.05), (foot + 0.05, seat - 0.05), 0.02), "y", (-0.006, 0.0)))
    elif style == "console":
        low, n = seat - m.number(0.12, 0.16), m.pick(1, 2)
        for k, (room,) in enumerate(shell(m, x, y, (low, seat), [(1.0, [1.0])] * n, t)):
            place(m, f"drawer_{k}", "drawer", room, how, deep, t)
        m.add(BASE, *(box((a, a + 0.04), (b, b + 0.04), (0, low)) for a in (0.0, wide - 0.04) for b in (0.0, deep - 0.04)))
        m.add(BASE, box(x, y, (0.12, 0.14)))
    else:
        jobs = ["drawer"] if style == "drawer" else m.pick(["pair"], ["left"])
        shares = [1.0, 1.3] if style == "drawer" else [1.0]
        cells = shell(m, x, y, (foot, seat), [(1.0, shares)], t)[0]
        place(m, "front", jobs[0], cells[-1], how, deep, t)
        if len(cells) > 1:
            _shoes(m, cells[0][0], (0.03, deep - 0.02), cells[0][1][0], m.pick(0, 2, 3))
    if style != "console":
        feet(m, x, y, foot)
    _back(m, x, deep, seat, high)
    if m.chance(0.4) and style != "lid":
        m.add(BASE, cushion(m, (0.01, wide - 0.01), (0.0, deep - 0.03), (seat, seat + 0.05)))
    if m.chance(0.5):  # an umbrella in a ring beside it
        c, b = wide + 0.09, deep - 0.1
        m.add(BASE, prism(Spot(c, b).buffer(0.085).difference(Spot(c, b).buffer(0.075)), "z", (0.45, 0.47)))
        m.add(BASE, rod((c, b, 0), (c, b, 0.025), 0.09, 16), box((wide - 0.002, c - 0.07), (b - 0.01, b + 0.01), (0.45, 0.47)))
        m.add(
            BASE,
            rod((c, b + 0.02, 0.02), (c, b + 0.04, 0.7), 0.022, 8),
            tube([(c, b + 0.04, 0.7), (c, b + 0.045, 0.85)], 0.008),
        )


def _back(m: Model, x: Span, deep: float, low: float, high: float) -> None:
    """The tall back of a hall stand: a board, slats or posts, with a mirror, hooks, a shelf or a cupboard."""
    y, wide, style = (deep - 0.022, deep), x[1] - x[0], m.pick("board", "arched", "slats", "posts")
    if style == "board":
        m.add(BASE, box(x, y, (low, high)))
    elif style == "arched":
        m.add(BASE, prism(arch(x, (low, high), m.number(0.06, 0.15)), "y", y))
    else:
        count = m.pick(4, 6, 8) if style == "slats" else 2
        for a in np.linspace(x[0], x[1] - 0.07, count):
            m.add(BASE, box((a, a + 0.07), y, (low, high)))
        m.add(BASE, *(box(x, (y[0] + 0.005, y[1] + 0.01), (c, c + 0.09)) for c in (high - 0.12, 0.65 * high, low + 0.02)))
    half, c = m.number(0.22, 0.36) * wide, 0.72 * high
    tall = (c - m.number(0.15, 0.22), c + m.number(0.15, 0.22))
    span = (middle(x) - half, middle(x) + half)
    how = m.pick("fixed", "oval", "door", "none")
    if how == "oval":
        disc = Polygon([(middle(x) + half * np.cos(s), c + 0.2 * np.sin(s)) for s in np.linspace(0, 6.1, 24)])
        m.add(BASE, prism(disc, "y", (y[0] - 0.012, y[0] + 0.002)), prism(disc.buffer(-0.03), "y", (y[0] - 0.014, y[0] - 0.01)))
    elif how == "fixed":
        m.add(BASE, prism(rectangle(span, tall, 0.03), "y", (y[0] - 0.015, y[0])), box(span, (y[0] - 0.004, y[0]), tall))
    elif how == "door":  # a cupboard for keys behind the mirror
        m.add(
            BASE,
            cut(
                box(span, (y[0] - 0.07, y[0]), tall),
                box((span[0] + 0.012, span[1] - 0.012), (-1, y[0] - 0.01), (tall[0] + 0.012, tall[1] - 0.012)),
            ),
        )
        face, side = (y[0] - 0.09, y[0] - 0.071), m.pick("left", "right")
        m.add("mirror", prism(rectangle(span, tall, 0.03), "y", face), box(span, (face[0] + 0.006, face[1]), tall))
        hang(m, "mirror", span, face, tall, side, OUT, m.pick(100, 120))
    _hooks(m, x, y[0], 0.88 * high if how != "none" else 0.8 * high)
    if m.chance(0.5):
        m.add(BASE, box(x, (y[0] - m.number(0.12, 0.22), y[1]), (high, high + 0.02)))
        clutter(m, x, (y[0] - 0.12, y[1]), high + 0.02)
    elif style == "board" and m.chance(0.5):
        m.add(BASE, prism(arch(x, (high, high + 0.08), 0.07), "y", y))


def _hooks(m: Model, x: Span, y: float, row: float) -> None:
    """A row of pegs or of bent hooks with plates."""
    hook = m.pick("peg", "bent", "double")
    for a in np.linspace(x[0] + 0.04, x[1] - 0.04, m.pick(3, 4, 5)):
        if hook == "peg":
            m.add(
                BASE,
                rod((a, y, row), (a, y - 0.08, row + 0.02), 0.008, 8),
                ball((a, y - 0.08, row + 0.02), (0.014,) * 3, 8),
            )
        else:
            reach = [(a, y, row), (a, y - 0.05, row - 0.02), (a, y - 0.07, row + 0.03)]
            m.add(BASE, tube(reach, 0.006, 6), box((a - 0.012, a + 0.012), (y - 0.004, y), (row - 0.03, row + 0.04)))
            if hook == "double":
                m.add(BASE, tube([(a, y, row + 0.03), (a, y - 0.1, row + 0.06)], 0.006, 6))


def _pouf(m: Model, wide: float, deep: float, high: float, style: str, job: str) -> Model:
    """One padded box on feet: its lid hinged at the back, a drawer or a flap in front, or nothing that moves."""
    one, t, foot = Model(m.rng), 0.022, m.pick(0.02, 0.05, 0.09)
    thick, x, y = m.number(0.05, 0.09), (-wide / 2, wide / 2), (0.0, deep)
    flat = Spot(0, deep / 2).buffer(wide / 2, quad_segs=m.pick(4, 8)) if style == "round" else rounded(x, y, 0.04)
    top = high - thick
    m_lid = flat.buffer(m.pick(0.0, 0.008))
    if job == "lid":
        one.add(BASE, prism(Polygon(flat.exterior.coords, [flat.buffer(-t).exterior.coords]), "z", (foot, top)))
        one.add(BASE, prism(flat.buffer(-0.5 * t), "z", (foot, foot + t)))
    elif job == "none" or style == "round":
        one.add(BASE, prism(flat, "z", (foot, top)))
    else:
        ((room,),) = shell(one, x, y, (foot, top), [(1.0, [1.0])], t)
        place(one, "drawer" if job == "drawer" else "flap", job, room, manner(m, ("slab", "rounded", "raised")), deep, t)
    part = "lid" if job == "lid" else BASE
    one.add(part, prism(m_lid, "z", (top + 0.001, top + 0.3 * thick)))
    if style == "tufted":
        one.add(part, cushion(one, (x[0] - 0.005, x[1] + 0.005), y, (top + 0.3 * thick, high)))
        spots = [(a, b) for a in np.linspace(x[0], x[1], m.pick(4, 5))[1:-1] for b in (0.3 * deep, 0.7 * deep)]
        one.add(part, *(ball((a, b, high), (0.012, 0.012, 0.006), 8) for a, b in spots))
    else:
        one.add(part, prism(flat.buffer(-0.004), "z", (top + 0.3 * thick, high - 0.012)))
        one.add(part, prism(flat.buffer(-0.018), "z", (high - 0.012, high)))
    if part == "lid":
        if m.chance(0.5):  # a loop to lift it by
            one.add("lid", box((-0.02, 0.02), (-0.03, 0.004), (top + 0.004, top + 0.008)))
        one.hinge("lid", (0.0, deep, top + 0.001), (-1, 0, 0), m.pick(75, 90, 100))
    for a in (0.7 * x[0], 0.7 * x[1]):
        one.add(BASE, *(rod((a, b, 0), (a, b, foot + 0.004), 0.02, m.sections()) for b in (0.2 * deep, 0.8 * deep)))
    if style == "seamed":
        one.add(BASE, *(rod((a, -0.002, foot), (a, -0.002, top), 0.005, 6) for a in (x[0] + 0.04, x[1] - 0.04)))
    return one


def storage_ottoman_set(m: Model) -> None:
    """A padded bench and smaller boxes beside it, with hinged lids, drawers or flaps; some of them do not open."""
    style, wide, deep, high = (
        m.pick("plain", "tufted", "seamed", "round"),
        m.number(0.9, 1.3),
        m.number(0.38, 0.5),
        m.number(0.4, 0.48),
    )
    cube, at = m.number(0.34, 0.42), 0.0
    plan = m.pick("bench", "bench", "cubes", "row")
    if plan in ("bench", "row"):
        job = m.pick("lid", "lid", "drawer", "bottom")
        wing(m, _pouf(m, wide, deep, high, "plain" if style == "round" else style, job), 0, (0, 0, 0), "bench")
        at = wide / 2 + m.pick(0.01, 0.15)
    for k in range(m.pick(1, 2) if plan == "bench" else m.pick(2, 3)):
        size, job = cube * m.pick(1.0, 1.0, 0.85), "lid" if k == 0 else m.pick("lid", "lid", "none", "drawer")
        shift = (at + size / 2, m.pick(0.0, 0.05) if plan == "row" else m.pick(0.0, -0.2), 0)
        wing(m, _pouf(m, size, size, size * m.pick(1.0, 1.1), style, job), 0, shift, f"cube_{k}")
        at += size + m.pick(0.02, 0.08)
