"""Appliances that cook: ovens, range cookers, microwaves; their control panels and racks."""

from __future__ import annotations

import itertools

import numpy as np

from training.kinds.kitchen_parts import Look, body, door, drawer, look, rack
from training.kinds.kitchen_trims import button, cable, dial, feet
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, prism, rectangle, ring, rod, tube

FRONTS = ("slab", "slab", "rounded", "pan", "liner", "glass", "glass", "raised", "sheet")
PULLS = ("bar", "rail", "merged", "rim", "groove", "recess", "none")
FRONT = (0.0, -1.0, 0.0)


def controls(m: Model, x: Span, y: float, z: Span, parent: str = BASE, most: int = 6) -> None:
    """A control panel on a face: a row of knobs, buttons beside a display, or both; the trims stay."""
    style, c = m.pick("knobs", "buttons", "both", "touch"), middle(z)
    wide, tall = x[1] - x[0], z[1] - z[0]
    split = x[0] + {"knobs": 1.0, "both": 0.6}.get(style, 0.0) * wide
    if style in ("knobs", "both"):
        count, knob = int(m.rng.integers(1, most + 1)), m.pick("plain", "bar", "stepped", "pointer")
        at = np.linspace(x[0], split, count + 2)[1:-1]
        r = min(0.3 * tall, 0.3 * (split - x[0]) / count, 0.03)
        for k, a in enumerate(at):
            dial(m, f"knob_{k}", (a, y, c), FRONT, r, parent, knob)
    if style in ("buttons", "both"):
        count = int(m.rng.integers(2, 9))
        size = min(0.35 * tall, 0.4 * (x[1] - split) / count, 0.015)
        for k, a in enumerate(np.linspace(split, x[1], count + 2)[1:-1]):
            button(m, f"button_{k}", (a, y, c - 0.2 * tall), FRONT, size, parent)
        m.add(parent, box((split + 0.2 * wide, x[1] - 0.05 * wide), (y - 0.001, y), (c + 0.1 * tall, c + 0.4 * tall)))
    if style == "touch":
        m.add(parent, box((x[0] + 0.3 * wide, x[1] - 0.3 * wide), (y - 0.001, y), (c - 0.25 * tall, c + 0.25 * tall)))


def window(m: Model, part: str, how: Look, x: Span, z: Span) -> None:
    """Lay a dark pane or a frame on a front that has no glass, or nothing."""
    if how.front in ("glass", "sheet") or m.chance(0.3):
        return
    wide, tall, y = x[1] - x[0], z[1] - z[0], how.depth[0]
    a, b = (x[0] + 0.15 * wide, x[1] - 0.15 * wide), (z[0] + 0.2 * tall, z[1] - 0.25 * tall)
    m.add(part, box(a, (y - 0.002, y), b) if m.chance(0.6) else prism(rectangle(a, b, 0.015), "y", (y - 0.004, y)))


def racks(m: Model, room: tuple[Span, Span], deep: float, start: float, name: str = "rack") -> None:
    """Racks and their runners in a hollow room: fixed or to be pulled out."""
    x, z = room
    for k, c in enumerate(np.linspace(*z, m.pick(1, 2, 3) + 2)[1:-1]):
        part = f"{name}_{k}" if m.chance(0.6) else BASE
        play = 0.025 if part != BASE else 0.016  # fixed ones reach the walls
        rack(m, part, (x[0] + play, x[1] - play), (start + 0.015, deep - 0.05), float(c))
        if part != BASE:
            m.slide(part, FRONT, 0.7 * deep)
            if m.chance(0.5):
                m.add(
                    BASE,
                    *(
                        box((a, a + 0.012), (start + 0.02, deep - 0.04), (c - 0.012, c - 0.004))
                        for a in (x[0] + 0.012, x[1] - 0.024)
                    ),
                )


def oven(m: Model) -> None:
    """A built-in oven: one or two doors that fall open or swing, racks, a warming drawer, a control panel."""
    wide, deep, panel = m.number(0.55, 0.76), m.number(0.5, 0.6), m.number(0.08, 0.14)
    count, how = m.pick(1, 1, 2), look(m, 0.5, FRONTS, PULLS)
    low = m.pick(0.0, 0.0, 0.14)  # a warming drawer below
    heights = [m.number(0.35, 0.5)] if count == 1 else [m.number(0.35, 0.45), m.number(0.22, 0.4)]
    zs, beside = low + np.cumsum([0.0, *heights]), m.chance(0.2)
    high = float(zs[-1]) + (0.01 if beside else panel)
    right = wide - (0.12 if beside else 0.01)
    rooms = [((0.01, right), (float(a) + 0.008, float(b) - 0.008)) for a, b in itertools.pairwise(zs)]
    drawers = [((0.01, wide - 0.01), (0.008, low - 0.004))] if low else []
    hollow = body(m, (0, wide), (0, deep), (0, high), drawers + rooms, how, 0.03)
    side = m.pick("bottom", "bottom", "bottom", "left", "right")
    for k, (x, z) in enumerate(rooms):
        door(m, f"door_{k}", x, z, side, how, 90 if side == "bottom" else 110)
        window(m, f"door_{k}", how, x, z)
        if hollow:
            racks(m, ((x[0] + 0.01, x[1] - 0.01), z), deep, how.depth[1], f"rack_{k}")
    if low:
        drawer(m, "drawer", *drawers[0], deep, how, "box" if hollow else "none", "top")
    if beside:
        controls(m, (right + 0.01, wide), 0.0, (0.5 * high, high), most=2)
    else:
        if m.chance(0.5):
            m.add(BASE, box((0, wide), how.depth, (high - panel, high)))
        controls(m, (0.03, wide - 0.03), min(0.0, how.depth[0]) if m.pieces[-1][0] == BASE else 0.0, (high - panel, high))
    if m.chance(0.4):  # the frame of a tall unit around it
        m.add(BASE, prism(rectangle((-0.03, wide + 0.03), (-0.03, high + 0.03), 0.03), "y", (0.0, deep)))


def range_cooker(m: Model) -> None:
    """A free-standing cooker: one to four doors, drawers, a row of knobs, burners under grates, a lid or a back guard."""
    how, foot, deep = look(m, 0.5, FRONTS, PULLS), m.number(0.04, 0.14), m.number(0.55, 0.68)
    columns = m.pick(1, 1, 2, 3)
    wide, high, panel = (
        {1: m.number(0.5, 0.76), 2: m.number(0.8, 1.2), 3: m.number(1.1, 1.5)}[columns],
        m.number(0.85, 0.93),
        0.11,
    )
    xs, rooms, jobs = np.linspace(0, wide, columns + 1), [], []
    for k in range(columns):
        x, low, top = (xs[k] + 0.012, xs[k + 1] - 0.012), foot + 0.01, high - panel - 0.01
        cuts = m.pick((), (0.25,), (0.55,)) if columns > 1 else m.pick((), (0.25,), (0.3,))
        borders = [low, *(low + c * (top - low) for c in cuts), top]
        for i, (a, b) in enumerate(itertools.pairwise(borders)):
            rooms.append((x, (a, b - 0.008)))
            jobs.append(
                "drawer" if cuts and cuts[0] < 0.5 and i == 0 else m.pick("bottom", "bottom", "left" if k == 0 else "right")
            )
    hollow = body(m, (0, wide), (0, deep), (foot, high), rooms, how, 0.03)
    feet(m, (0, wide), (0, deep), foot)
    for k, ((x, z), job) in enumerate(zip(rooms, jobs, strict=True)):
        if job == "drawer":
            drawer(m, f"drawer_{k}", x, z, deep, how, "box" if hollow else "none", "top")
            continue
        door(m, f"door_{k}", x, z, job, how, 90 if job == "bottom" else 110)
        window(m, f"door_{k}", how, x, z)
        if hollow and m.chance(0.7):
            racks(m, ((x[0] + 0.02, x[1] - 0.02), z), deep, how.depth[1], f"rack_{k}")
    count, knob, r = m.pick(4, 5, 6, 7, 9), m.pick("plain", "bar", "stepped", "pointer"), m.number(0.016, 0.024)
    for k, a in enumerate(np.linspace(0, wide, count + 2)[1:-1]):
        dial(m, f"knob_{k}", (a, 0.0, high - panel / 2), FRONT, min(r, 0.3 * wide / count), style=knob)
    if m.chance(0.4):  # a fixed rail for towels
        y, z = min(how.depth[0], 0.0) - 0.09, high - panel - 0.0
        m.add(BASE, tube([(0.03, 0, z), (0.03, y, z), (wide - 0.03, y, z), (wide - 0.03, 0, z)], 0.008, 8))
    _hob(m, wide, deep, high)
    finish = m.pick("guard", "lid", "none", "shelf")
    if finish == "lid":
        t = m.pick(0.006, 0.02)
        m.add("lid", box((0, wide), (0.0, deep - 0.02), (high + 0.05, high + 0.05 + t)))
        m.add(BASE, *(box((a, a + 0.06), (deep - 0.03, deep), (high, high + 0.05)) for a in (0.08, wide - 0.14)))
        m.hinge("lid", (wide / 2, deep - 0.02, high + 0.05), (-1, 0, 0), m.pick(85, 95))
    elif finish != "none":
        m.add(BASE, box((0, wide), (deep - 0.02, deep), (high, high + m.number(0.05, 0.5))))
        if finish == "shelf":
            m.add(
                BASE,
                box((0, wide), (deep - 0.2, deep), (high + 0.4, high + 0.42)),
                box((0, wide), (deep - 0.02, deep), (high, high + 0.42)),
            )


def _hob(m: Model, wide: float, deep: float, z: float) -> None:
    """Burners or plates that stay, perhaps under grates."""
    count, n = max(2, round(wide / 0.28)), m.sections()
    grates = m.chance(0.6)
    for a in np.linspace(0, wide, count + 1)[:-1] + wide / count / 2:
        for b in (0.28 * deep, 0.7 * deep):
            r = m.number(0.045, 0.09)
            m.add(BASE, rod((a, b, z), (a, b, z + 0.012), r, n), rod((a, b, z + 0.012), (a, b, z + 0.02), 0.6 * r, n))
            if grates:
                m.add(
                    BASE,
                    *(box((a - c, a + c), (b - d, b + d), (z + 0.03, z + 0.04)) for c, d in ((0.11, 0.005), (0.005, 0.11))),
                )
                m.add(BASE, prism(rectangle((a - 0.12, a + 0.12), (b - 0.12, b + 0.12), 0.01), "z", (z, z + 0.04)))


def microwave(m: Model) -> None:
    """A door beside or below its controls, a plate that turns, feet, vents."""
    wide, high, deep, foot = m.number(0.42, 0.6), m.number(0.25, 0.36), m.number(0.3, 0.45), m.pick(0.0, 0.012, 0.02)
    how, side = look(m, 0.3, FRONTS, PULLS), m.pick("left", "left", "right", "bottom", "top")
    panel = wide * m.number(0.18, 0.3) if side in ("left", "right") else high * 0.22
    x, z = (0.008, wide - 0.008), (foot + 0.008, foot + high - 0.008)
    field = (x, (z[1] - panel, z[1]))
    if side == "left":
        x, field = (x[0], x[1] - panel), ((x[1] - panel, x[1]), z)
    elif side == "right":
        x, field = (x[0] + panel, x[1]), ((x[0], x[0] + panel), z)
    else:
        z = (z[0], z[1] - panel)
    hollow = body(m, (0, wide), (0, deep), (foot, foot + high), [(x, z)], how, 0.02)
    door(m, "door", x, z, side, how, m.pick(90, 100, 120))
    window(m, "door", how, x, z)
    if foot:
        feet(m, (0, wide), (0, deep), foot)
    if side in ("left", "right") and m.chance(0.5):  # a keyboard
        rows, columns, c = m.pick(3, 4, 5), m.pick(2, 3), middle(field[0])
        d = min(0.8 * panel / columns, 0.09 * high)
        for k in range(rows * columns):
            at = (c + d * 1.15 * (k % columns - (columns - 1) / 2), 0.0, z[0] + 0.1 * high + 1.2 * d * (k // columns))
            m.add(f"key_{k}", box((at[0] - d / 2, at[0] + d / 2), (-0.004, 0), (at[2] - d / 2, at[2] + d / 2)))
            m.slide(f"key_{k}", (0, 1, 0), 0.003)
        m.add(BASE, box((c - 0.4 * panel, c + 0.4 * panel), (-0.001, 0), (z[1] - 0.2 * high, z[1] - 0.06 * high)))
    elif side in ("left", "right"):
        count, r = m.pick(1, 2), m.number(0.15, 0.28) * panel
        for k in range(count):
            dial(m, f"knob_{k}", (middle(field[0]), 0.0, z[0] + (0.35 + 0.35 * k) * high), FRONT, r)
        button(m, "opener", (middle(field[0]), 0.0, z[0] + 0.1 * high), FRONT, 0.12 * high)
    else:
        controls(m, (0.03, wide - 0.03), 0.0, field[1], most=2)
    if hollow:
        at, r, low = (middle(x), 0.55 * deep), 0.38 * min(x[1] - x[0], deep), z[0] + 0.022
        plate = m.pick("disc", "rim", "none")
        if plate != "none":
            m.add("plate", rod((*at, low), (*at, low + 0.006), r, 24), rod((*at, low - 0.008), (*at, low), 0.02, 10))
            if plate == "rim":
                m.add("plate", ring((*at, low + 0.006), (0, 0, 1), r, 0.005, 24))
            m.spin("plate", (*at, low), (0, 0, 1))
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                box((wide, wide + 0.002), (c, c + 0.006), (foot + 0.5 * high, foot + 0.8 * high))
                for c in np.linspace(0.4 * deep, 0.8 * deep, 7)
            ),
        )
    if m.chance(0.3):
        cable(m, (0.8 * wide, deep, foot + 0.05), 0.3)
