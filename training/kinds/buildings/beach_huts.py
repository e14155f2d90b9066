"""Beach huts."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.buildings.greenhouses import _parts
from training.kinds.buildings.hutches import board_leaf
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, handle, hang, leaf
from training.kinds.solids import Span, box, prism, rectangle, rod
from training.kinds.wheels import beam


def beach_hut(m: Model) -> None:
    """A small hut with a gable: a pair of doors, a door with a window, a shutter that is a counter; porch, steps, cladding."""
    half, deep, t, low = m.number(0.8, 1.2), m.number(1.6, 2.6), 0.03, m.pick(0.05, 0.2, 0.45)
    eaves, rise = low + m.number(1.75, 2.0), m.number(0.45, 0.9)
    lap, porch = m.number(0.08, 0.25), m.pick(0.0, 0.0, m.number(0.6, 1.1))
    gable = Polygon([(-half, low), (half, low), (half, eaves), (0, eaves + rise), (-half, eaves)])
    style = m.pick("pair", "pair", "single", "counter")
    top, floor = eaves - m.number(-0.1, 0.05), low + 0.03
    wide = m.number(1.0, 1.3) if style == "pair" else m.number(0.7, 0.8)
    c = 0.0 if style == "pair" else -half + wide / 2 + 0.12 if style == "counter" else m.pick(0.0, 0.3 * half)
    rooms = {"door": ((c - wide / 2, c + wide / 2), (floor, top))}
    if style == "counter":
        rooms["shutter"] = ((c + wide / 2 + 0.12, half - 0.12), (low + 0.9, top - 0.05))
    holes = [rectangle(*room) for room in rooms.values()]
    front = gable
    for hole in holes:
        front = front.difference(hole)
    m.add(BASE, prism(front, "y", (0, t)), prism(gable, "y", (deep - t, deep)))
    m.add(
        BASE,
        *(box((s * half, s * (half - t)), (t, deep - t), (low, eaves)) for s in (-1, 1)),
        box((-half, half), (0, deep), (low, low + 0.025)),
    )
    _hut_clad(m, front, half, deep, (low, eaves))
    _hut_roof(m, half, deep, (eaves, rise), (lap, porch))
    if porch:
        _hut_porch(m, half, porch, low, eaves)
    _hut_doors(m, rooms, style)
    _hut_foot(m, low, c, porch, half, deep)


def _hut_porch(m: Model, half: float, porch: float, low: float, eaves: float) -> None:
    """A deck before the hut with posts and rails."""
    m.add(BASE, box((-half, half), (-porch, 0), (low - 0.05, low + 0.02)))
    m.add(BASE, *(box((s * (half - 0.04), s * (half - 0.12)), (-porch + 0.02, -porch + 0.1), (low, eaves)) for s in (-1, 1)))
    for s in (-1, 1) if m.chance(0.6) else ():
        m.add(BASE, box((s * (half - 0.05), s * (half - 0.1)), (-porch + 0.1, 0), (low + 0.75, low + 0.82)))
        m.add(
            BASE,
            *(
                box((s * (half - 0.06), s * (half - 0.09)), (b, b + 0.03), (low, low + 0.76))
                for b in np.linspace(-porch + 0.15, -0.1, 5)
            ),
        )


def _hut_foot(m: Model, low: float, c: float, porch: float, half: float, deep: float) -> None:
    """Legs and steps."""
    m.add(
        BASE,
        *(
            box((a, a + 0.1), (b, b + 0.1), (0, low))
            for a in (-half + 0.02, -0.05, half - 0.12)
            for b in (0.05 - porch, deep - 0.15)
        ),
    )
    steps = round(low / 0.17)
    m.add(
        BASE,
        *(
            box(
                (c - 0.4, c + 0.4),
                (-porch - 0.25 * (k + 1), -porch - 0.25 * k),
                (low - 0.17 * (k + 1) - 0.04, low - 0.17 * (k + 1)),
            )
            for k in range(steps)
        ),
    )
    for s in (-1, 1) if steps > 1 else ():
        m.add(
            BASE,
            beam(
                (c + s * 0.38, -porch, low - 0.1), (c + s * 0.38, -porch - 0.25 * steps, low - 0.17 * steps - 0.05), 0.03, 0.12
            ),
        )


def _hut_doors(m: Model, rooms: dict[str, tuple[Span, Span]], style: str) -> None:
    """The leaves in the front's openings, and the shutter of a counter, which falls or lifts."""
    (x, z), gap, proud = rooms["door"], 0.004, m.pick(0.0, -0.015)
    y = (proud, proud + 0.03)
    spans = [(x[0], sum(x) / 2), (sum(x) / 2, x[1])] if style == "pair" else [x]
    hand, seed = m.pick("left", "right"), int(m.rng.integers(1 << 30))
    for k, span in enumerate(spans):
        side, part = (("left", "right")[k], f"door_{k}") if style == "pair" else (hand, "door")
        inner, tall = (span[0] + gap, span[1] - gap), (z[0] + gap, z[1] - gap)
        leaf(Model(np.random.default_rng(seed), m.pieces, m.joints), part, inner, y, tall)
        hang(m, part, inner, y, tall, side, OUT, m.number(95, 170) if proud else m.number(90, 110))
        edge, inward = (inner[1] - 0.07, -1) if side == "left" else (inner[0] + 0.07, 1)
        if k == 0 or m.chance(0.3):
            handle(m, part, (edge, z[0] + 0.95), y, inward, "front", 0.1)
    if "shutter" in rooms:
        x, z = rooms["shutter"]
        inner, tall = (x[0] + gap, x[1] - gap), (z[0] + gap, z[1] - gap)
        board_leaf(m, "shutter", inner, y, tall)
        side = m.pick("top", "bottom", "top")
        hang(m, "shutter", inner, y, tall, side, OUT, m.number(75, 95) if side == "bottom" else m.number(70, 110))
        m.add(BASE, box((x[0] - 0.03, x[1] + 0.03), (0.032, 0.3), (z[0] - 0.03, z[0])))


def _hut_clad(m: Model, front: Polygon, half: float, deep: float, z: Span) -> None:
    """Boards on the front and sides, lying or upright, clear of the leaves."""
    low, eaves = z
    style = m.pick("none", "lying", "lying", "upright")
    free = front.buffer(-0.012, join_style="mitre")
    if style == "lying":
        for b in np.arange(low, eaves + 0.8, 0.125):
            band = free.intersection(rectangle((-half, half), (b, b + 0.118)))
            m.add(BASE, *(prism(g, "y", (-0.012, 0)) for g in _parts(band)))
        for s in (-1, 1):
            m.add(
                BASE,
                *(box((s * half, s * (half + 0.012)), (0, deep), (b, b + 0.118)) for b in np.arange(low, eaves - 0.1, 0.125)),
            )
    elif style == "upright":
        for a in np.arange(-half, half, 0.15):
            m.add(
                BASE,
                *(prism(g, "y", (-0.012, 0)) for g in _parts(free.intersection(rectangle((a, a + 0.05), (low, eaves + 1))))),
            )


def _hut_roof(m: Model, half: float, deep: float, z: Span, reach: tuple[float, float]) -> None:
    """Two slopes with barge boards, a knob or a flag on top in some, a name over the door."""
    (eaves, rise), (lap, porch) = z, reach
    y, edge, t = (-porch - lap, deep + lap), half + lap, 0.035
    drop = eaves - lap * rise / half
    for s in (-1, 1):
        line = [(0, eaves + rise), (s * edge, drop), (s * edge, drop + t), (0, eaves + rise + t)]
        m.add(BASE, prism(line, "y", y))
        if m.chance(0.7):
            m.add(
                BASE,
                prism(
                    [(0, eaves + rise - 0.09), (s * edge, drop - 0.09), (s * edge, drop + t), (0, eaves + rise + t)],
                    "y",
                    (y[0] - 0.025, y[0]),
                ),
            )
    if m.chance(0.4):
        tall = m.number(0.2, 0.9)
        m.add(BASE, rod((0, y[0] + 0.02, eaves + rise), (0, y[0] + 0.02, eaves + rise + tall), 0.018, 8))
        if tall > 0.6:
            m.add(
                BASE,
                prism(
                    [(0.018, eaves + rise + tall - 0.25), (0.4, eaves + rise + tall - 0.12), (0.018, eaves + rise + tall)],
                    "y",
                    (y[0] + 0.018, y[0] + 0.022),
                ),
            )
    if m.chance(0.5):
        m.add(BASE, box((-0.25, 0.25), (-0.03, 0), (eaves + 0.15 * rise, eaves + 0.15 * rise + 0.14)))
