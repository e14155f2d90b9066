"""Entrances: front doors with sidelights, fanlights, handles that turn and letter flaps."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import alike, face, shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import IN, OUT, glazed, handle, hang, opening, pane
from training.kinds.solids import Span, ball, box, prism, rectangle, ring, rod, rounded, tube


def panelled(m: Model, part: str, x: Span, y: Span, z: Span, rows: int, columns: int, lights: int = 0) -> None:
    """Make a door of stiles, rails and panels with mouldings; lights: how many of the upper rows are glass."""
    stile, out = m.number(0.09, 0.13), 0.25 * (y[1] - y[0])
    share = np.array([m.number(0.7, 1.3) for _ in range(rows)])
    low, step = z[0] + 0.2, (z[1] - z[0] - 0.2) * share / share.sum()
    wide = (x[1] - x[0] - stile) / columns
    fields = []
    for height in step:
        fields += [((x[0] + stile + k * wide, x[0] + (k + 1) * wide), (low, low + height - stile)) for k in range(columns)]
        low += height
    outer = rectangle(x, z)
    if m.chance(0.6):  # one slab with holes
        m.add(part, prism(Polygon(outer.exterior.coords, [rectangle(a, b).exterior.coords for a, b in fields]), "y", y))
    else:
        m.add(part, *(box(a, y, z) for a in ((x[0], x[0] + stile), (x[1] - stile, x[1]))))
        for k in range(rows + 1):
            b = (z[0], z[0] + 0.2) if k == 0 else (fields[(k - 1) * columns][1][1], fields[(k - 1) * columns][1][1] + stile)
            m.add(part, box((x[0] + stile, x[1] - stile), y, b))
        for a, b in fields:
            if a[1] < x[1] - 1.1 * stile:
                m.add(part, box((a[1], a[1] + stile), y, b))
    how = m.pick("flat", "raised", "moulded")
    for k, (a, b) in enumerate(fields):
        if k >= (rows - lights) * columns:
            m.add(part, pane(m, a, y, b))
            continue
        m.add(part, box(a, shrunk(y, out), b))
        if how == "raised":
            m.add(part, box(shrunk(a, 0.03), shrunk(y, 0.3 * out), shrunk(b, 0.03)))
        elif how == "moulded":
            m.add(part, prism(rectangle(a, b, 0.02), "y", (y[0] - 0.006, y[0] + out)))


def latch(m: Model, door: str, at: tuple[float, float], y: Span, inward: int) -> None:
    """Put a lever or knob that turns, or a fixed bar, on both faces of a door."""
    how, size, n = m.pick("lever", "lever", "knob", "bar"), m.number(0.1, 0.14), m.pick(8, 12, 16)
    x, z = at
    sides = list(zip(y, (-1, 1), strict=True))
    if m.chance(0.7):
        plate = m.pick(
            rectangle((x - 0.025, x + 0.025), (z - 0.1, z + 0.1)), rounded((x - 0.026, x + 0.026), (z - 0.026, z + 0.026), 0.02)
        )
        m.add(door, *(prism(plate, "y", (f, f + 0.006 * s)) for f, s in sides))
    if m.chance(0.6):  # a lock
        m.add(door, rod((x, y[0] - 0.012, z - 0.14), (x, y[1] + 0.012, z - 0.14), 0.014, n))
    if how == "bar":
        handle(m, door, at, y, inward, m.pick("front", "both"), 0.16)
        return
    for face_at, s in sides:
        end = face_at + 0.055 * s
        m.add("handle", rod((x, face_at + 0.003 * s, z), (x, end, z), 0.01, n))
        if how == "knob":
            m.add("handle", ball((x, end, z), (0.028, 0.02, 0.028), n))
        else:
            m.add(
                "handle",
                m.pick(
                    box((x - 0.012 * inward, x + size * inward), (end - 0.008, end + 0.008), (z - 0.012, z + 0.012)),
                    tube([(x, end, z), (x + 0.7 * size * inward, end, z), (x + size * inward, end - 0.03 * s, z)], 0.01, 8),
                ),
            )
    m.hinge("handle", (x, 0, z), (0, inward, 0), m.number(30, 60), door)


def _doorway(m: Model, wide: float, high: float, y: Span, wall: bool = True) -> None:
    """Add what stands round an entrance and does not move."""
    if m.chance(0.4):
        m.add(BASE, box((-0.3, wide + 0.3), (y[0] - m.number(0.3, 0.9), y[1]), (-0.15, 0)))
    if m.chance(0.3):  # a canopy on brackets
        m.add(BASE, box((-0.3, wide + 0.3), (y[0] - 0.8, y[0]), (high + 0.3, high + 0.36)))
        m.add(BASE, *(tube([(a, y[0], high + 0.05), (a, y[0] - 0.5, high + 0.3)], 0.02, 6) for a in (-0.2, wide + 0.2)))
    if wall and m.chance(0.6):  # a wall piece with a lamp, a number, a bell
        around = Polygon(rectangle((-1.0, wide + 1.0), (0, high + 0.6)).exterior.coords)
        hole = rectangle((-0.07, wide + 0.07), (-1, high + 0.07))
        m.add(BASE, prism(around.difference(hole), "y", (y[0] + 0.01, y[1] + m.number(0, 0.2))))
        at = m.pick(-0.3, wide + 0.3)
        m.add(BASE, box((at - 0.05, at + 0.05), (y[0] - 0.03, y[0] + 0.01), (1.2, 1.35)))
        m.add(BASE, rod((at, y[0] - 0.04, 1.25), (at, y[0] - 0.03, 1.25), 0.012, 10))
        m.add(
            BASE,
            box((at - 0.05, at + 0.05), (y[0] - 0.12, y[0] + 0.01), (1.8, 2.0)),
            ball((at, y[0] - 0.06, 1.78), (0.03,) * 3, 8),
        )


def front_door(m: Model) -> None:
    """Make a panelled front door between sidelights, with a handle that turns and a letter flap."""
    wide, high, thick, frame = m.number(0.85, 1.05), m.number(2.0, 2.2), m.number(0.04, 0.06), m.number(0.05, 0.08)
    lights, way, side, gap = m.pick((), (-1,), (1,), (-1, 1)), m.pick(IN, OUT), m.pick("left", "right"), m.gap(0.8)
    x, z, y = (gap, wide - gap), (0.005, high - gap), (0.0, thick)
    jamb = (-0.01, thick + 0.04) if m.chance(0.5) else (0.0, thick)
    opening(m, (0, wide), jamb, (0, high), frame, sill=False)
    rows = m.pick(2, 3, 4)
    panelled(m, "door", x, y, z, rows, m.pick(1, 2), m.pick(0, 0, 1))
    for s in lights:  # glazed or panelled like the door, fixed
        a = (wide + frame, wide + frame + m.number(0.25, 0.45))
        a = a if s > 0 else (wide - a[1], wide - a[0])
        low = m.pick(0.0, 0.5)
        glazed(m, BASE, a, y, (low, high), 0.05, (0, m.pick(0, 2, 4)))
        if low:
            face(m, BASE, a, y, (0, low), m.pick("moulded", "framed", "sunk", "raised"))
        edge = a[1] if s > 0 else a[0]
        m.add(BASE, box((edge, edge + s * frame), jamb, (0, high + frame)), box(a, jamb, (high, high + frame)))
    transom = m.chance(0.4)
    if transom:
        glazed(m, BASE, (-frame, wide + frame), y, (high + frame, high + frame + 0.4), 0.05, (m.pick(0, 2), 0))
    inward = 1 if side == "right" else -1
    latch(m, "door", (x[0] + 0.07 if side == "right" else x[1] - 0.07, m.number(0.95, 1.1)), y, inward)
    if m.chance(0.5):
        slot, at = (wide / 2 - 0.14, wide / 2 + 0.14), m.pick(0.12, 0.85, 1.0)
        m.add("door", prism(rectangle(slot, (at - 0.04, at + 0.04), 0.015), "y", (y[0] - 0.012, y[0])))
        flap = shrunk(slot, 0.016), (at - 0.024, at + 0.024)
        m.add("flap", box(flap[0], (y[0] - 0.01, y[0] - 0.004), flap[1]))
        m.hinge("flap", (wide / 2, y[0] - 0.007, flap[1][1]), (-1, 0, 0), 70, "door")
    if m.chance(0.4):
        m.add(
            "door",
            ring((wide / 2, y[0] - 0.02, 1.45), (0, 1, 0), 0.05, 0.008, 12),
            rod((wide / 2, y[0], 1.5), (wide / 2, y[0] - 0.03, 1.5), 0.02, 10),
        )
    if m.chance(0.3):
        m.add("door", box(shrunk(x, 0.03), (y[0] - 0.004, y[0]), (z[0] + 0.02, z[0] + 0.18)))
    hang(m, "door", x, y, z, side, way, 100)
    _doorway(m, wide, high, (min(jamb[0], y[0]), jamb[1]), not lights and not transom)


def fanlight_doors(m: Model) -> None:
    """Make a double front door under a fixed arched window, between pilasters."""
    half, high, thick, frame = m.number(0.6, 0.9), m.number(2.1, 2.5), m.number(0.045, 0.07), m.number(0.06, 0.12)
    wide, way, gap, rise = 2 * half, m.pick(IN, OUT), m.gap(1.0), m.number(0.5, 1.0) * half
    rows, lights, seed = m.pick(2, 3), m.pick(0, 0, 1), int(m.rng.integers(1 << 30))
    opening(m, (0, wide), (-0.02, thick + 0.03), (0, high), frame, sill=False)
    t, n = np.linspace(0, np.pi, 17), m.pick(0, 3, 5)
    curve = np.c_[half + half * np.cos(t), high + frame + rise * np.sin(t)]
    outer = np.c_[half + (half + frame) * np.cos(t), high + frame + (rise + frame) * np.sin(t)]
    m.add(
        BASE, prism(Polygon([*outer, *curve[::-1]]), "y", (-0.02, thick + 0.03)), prism(curve, "y", (0.4 * thick, 0.6 * thick))
    )
    for k in range(n):
        a = np.pi * (k + 1) / (n + 1)
        end = (half + half * np.cos(a), thick / 2, high + frame + rise * np.sin(a))
        m.add(BASE, rod((half, thick / 2, high + frame), end, 0.012, 6))
    for k, side in enumerate(("left", "right")):
        part, x, z = f"leaf_{k}", ((gap, half - gap / 2), (half + gap / 2, wide - gap))[k], (0.004, high - gap)
        panelled(alike(m, seed), part, x, (0, thick), z, rows, 1, lights)
        at = (x[1] - 0.06 if k == 0 else x[0] + 0.06, 1.02)
        if k == 1 and m.chance(0.6):
            latch(m, part, at, (0, thick), 1)
        else:
            handle(alike(m, seed), part, at, (0, thick), -1 if k == 0 else 1)
        hang(alike(m, seed), part, x, (0, thick), z, side, way, 95)
    if m.chance(0.5):
        for a in (-frame - 0.25, wide + frame):
            m.add(BASE, box((a, a + 0.25), (-0.08, thick), (0, high)), box((a - 0.03, a + 0.28), (-0.11, thick), (0, 0.2)))
            m.add(BASE, box((a - 0.03, a + 0.28), (-0.11, thick), (high, high + 0.1)))
    if m.chance(0.4):
        _doorway(m, wide, high + frame + rise, (-0.02, thick + 0.03))
