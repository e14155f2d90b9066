"""Light switches by another hand."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot

from training.kinds.maker_fronts import button, dial
from training.kinds.maker_style import Maker, cuboid, lathe, maker, plate, soft, without
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rod, rounded, turned, vec


def light_switch(m: Model) -> None:
    """A plate on a wall with rockers, toggles, push keys, a dimmer or a knob, in one frame or several; perhaps a socket."""
    k = maker(m)
    count, unit, t = m.pick(1, 1, 2, 3, 4), m.number(0.07, 0.086), m.number(0.006, 0.012)
    upright = m.chance(0.3)
    style = m.pick("rocker", "rocker", "toggle", "push", "slider", "knob")
    size = (unit, unit * count) if upright else (unit * count, unit * m.pick(1.0, 1.0, 1.5))
    share, round_plate = m.number(0.08, 0.5), count == 1 and m.chance(0.25)
    size = (unit, unit) if round_plate else size
    outline = (
        Spot(size[0] / 2, size[1] / 2).buffer(unit / 2)
        if round_plate
        else rounded((0, size[0]), (0, size[1]), share * unit / 3)
    )
    middles = [(0.5 * unit, (i + 0.5) * unit) if upright else ((i + 0.5) * unit, 0.5 * size[1]) for i in range(count)]
    socket = count > 1 and m.chance(0.35)
    hole = outline
    if k.way in ("cut", "cad", "old") and style in ("rocker", "push"):
        for x, z in middles[socket:]:
            hole = hole.difference(rounded((x - 0.31 * unit, x + 0.31 * unit), (z - 0.36 * unit, z + 0.36 * unit), 0.002))
        m.add(BASE, prism(outline, "y", (-0.002, 0)))
    m.add(BASE, plate(hole, "y", (-t, -0.0005 if hole is not outline else 0), k))
    if k.way == "soft" and not round_plate:
        m.add(
            BASE,
            soft((0.03 * unit, size[0] - 0.03 * unit), (-1.3 * t, -0.2 * t), (0.03 * unit, size[1] - 0.03 * unit), 0.4 * t),
        )
    if k.way == "old":
        m.add(BASE, prism(outline.buffer(0.004), "y", (-0.3 * t, 0)))
    front = -1.3 * t if k.way == "soft" and not round_plate else -t
    for i, (x, z) in enumerate(middles):
        if socket and i == 0:
            _socket(k, x, z, front, 0.27 * unit)
        else:
            _switch(k, style if m.chance(0.8) else m.pick("rocker", "toggle", "knob"), i, vec(x, front, z), unit)
    if k.way in ("cad", "old") or m.chance(0.2):
        spots = [(size[0] / 2, 0.06 * unit), (size[0] / 2, size[1] - 0.06 * unit)]
        m.add(BASE, *(rod((x, front + 0.001, z), (x, front - 0.0012, z), 0.0028, 10) for x, z in spots))
    if k.inside:
        m.add(
            BASE,
            *(box((x - 0.3 * unit, x + 0.3 * unit), (-0.0005, 0.03), (z - 0.3 * unit, z + 0.3 * unit)) for x, z in middles),
        )


def _socket(k: Maker, x: float, z: float, y: float, r: float) -> None:
    """A round socket with two dark holes, which does not move."""
    k.m.add(BASE, k.knob((x, y, z), (0, -1, 0), r, 0.002))
    k.m.add(BASE, *(rod((x + s * 0.3 * r, y, z), (x + s * 0.3 * r, y - 0.003, z), 0.1 * r, 8) for s in (-1, 1)))


def _switch(k: Maker, style: str, i: int, at: np.ndarray, unit: float) -> None:
    """One thing to switch with, on a plate at `at`."""
    x, y, z = at
    a, b = 0.29 * unit, 0.34 * unit
    if style == "rocker":
        parts = [(-a, -0.0006), (0.0006, a)] if k.m.chance(0.25) else [(-a, a)]
        for n, (p, q) in enumerate(parts):
            lean = k.m.pick(-1, 1) * 0.0025
            shape = [
                (y + 0.004, z - b),
                (y + 0.004, z + b),
                (y - 0.004 - lean, z + b),
                (y - 0.003, z),
                (y - 0.004 + lean, z - b),
            ]
            solid = prism(shape, "x", (x + p, x + q))
            k.m.add(f"rocker_{i}_{n}", without(solid, (0, 1, 0)) if k.way == "sheet" else solid)
            limits = (-9.0, 0.0) if lean < 0 else (0.0, 9.0)
            k.m.hinge(f"rocker_{i}_{n}", (x, y, z), (1, 0, 0), limits if k.m.chance(0.8) else (-6, 6))
    elif style == "toggle":
        k.m.add(BASE, *k.panel((x - 0.11 * unit, x + 0.11 * unit), (z - 0.16 * unit, z + 0.16 * unit), (y - 0.0015, y + 0.001)))
        lever = lathe([(0.0045, -0.003), (0.003, 0.006), (0.005, 0.016), (0.003, 0.019)], k.n)
        if k.way in ("low", "sheet", "cut"):
            lever = cuboid((0, 0, 0.008), (0.0045, 0.003, 0.011), (0, 0, -1) if k.way == "sheet" else None)
        down = k.m.pick(True, False)
        lever = turned(lever, (1, 0, 0), 90 + (25 if down else -25), (0, 0, 0)).apply_translation((x, y, z))
        k.m.add(f"toggle_{i}", lever)
        k.m.hinge(f"toggle_{i}", at, (-1, 0, 0), (0, 50) if down else (-50, 0))
    elif style == "push":
        button(k, f"push_key_{i}", at, (a, 0.9 * b), 0.004, turn=k.m.chance(0.3) and k.way != "sheet")
    elif style == "slider":
        k.m.add(BASE, box((x - 0.003, x + 0.003), (y - 0.0012, y + 0.001), (z - b, z + b)))
        k.m.add(
            f"slider_{i}", k.block((x - 0.01, x + 0.01), (y - 0.01, y - 0.0011), (z - 0.9 * b, z - 0.9 * b + 0.008), (0, 1, 0))
        )
        k.m.slide(f"slider_{i}", (0, 0, 1), 1.5 * b)
    else:
        dial(k, f"knob_{i}", at, k.m.number(0.6, 0.95) * a, k.m.number(0.012, 0.02))
