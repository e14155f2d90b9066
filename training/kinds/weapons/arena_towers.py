"""A siege tower of one artist."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.arena_style import Look, look
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rod, vec


def siege_tower_ramp(m: Model) -> None:
    """A timber tower on wheels, straight, tapered or stepped, with a ramp that falls forwards, doors, shutters, a winch."""
    k, taper = look(m), m.pick(1.0, 0.8, 0.65)
    w, h, floors = m.number(1.2, 1.8), m.number(4.5, 7.5), m.pick(2, 3, 4)
    lift, wide, t = m.number(0.4, 0.6), w * taper, 0.1
    gate_low, gate_high = 0.72 * h + lift, 0.72 * h + lift + m.number(1.2, 1.9)
    top = max(h, gate_high) + lift * 0.5
    corners = [(x, y) for x in (-1, 1) for y in (-1, 1)]
    m.add(BASE, box((-w - 0.15, w + 0.15), (-w - 0.15, w + 0.15), (lift, lift + 0.22)))
    for x, y in corners:
        m.add(BASE, *k.limb((x * w, y * w, lift), (x * wide, y * wide, top), 0.22, 0.22, (1, 0, 0)))
    share = (gate_low - lift) / (top - lift)
    front = w + (wide - w) * share
    for i in range(floors):
        z = lift + (gate_low - lift) * (i + 1) / floors
        a = w + (wide - w) * (z - lift) / (top - lift)
        m.add(BASE, box((-a, a), (-a, a), (z - 0.12, z)))
    _skins(m, k, w, front, lift, gate_low, t)
    door = 0.75 * wide
    hinge_y = -front - 0.14
    m.add(BASE, box((-front, front), (-front - 0.12, -front + 0.1), (gate_low - 0.16, gate_low)))
    high = gate_high - gate_low + m.number(0, 0.6)
    leaf = ((-door, door), (hinge_y - 0.1, hinge_y), (gate_low + 0.01, gate_low + high))
    m.add("ramp", *k.plate(*leaf, "-y"))
    if m.chance(0.6):
        m.add(
            "ramp",
            *(
                prism(
                    [(hinge_y - 0.1, gate_low + high), (hinge_y, gate_low + high), (hinge_y - 0.1, gate_low + high + 0.25)],
                    "x",
                    (x * door - 0.08, x * door + 0.08),
                )
                for x in (-0.8, -0.27, 0.27, 0.8)
            ),
        )
    m.add(
        BASE,
        *(
            box((x * door - 0.06, x * door + 0.06), (hinge_y - 0.02, -front + 0.05), (gate_low - 0.1, gate_low + 0.008))
            for x in (-0.8, 0.8)
        ),
    )
    m.hinge("ramp", (0, hinge_y, gate_low), (1, 0, 0), m.pick(90, 100, 120))
    _roof(m, wide, top)
    _running(m, k, w, lift)
    _extras(m, k, w, front, lift, gate_low)


def _skins(m: Model, k: Look, w: float, a: float, lift: float, high: float, t: float) -> None:
    """Walls of planks, hides or cross braces up to the gate; some sides stay open."""
    sides = m.pick(("x-", "x+", "y-"), ("x-", "x+", "y-", "y+"), ("y-",), ())
    outline = Polygon([(-w, lift + 0.2), (w, lift + 0.2), (a, high), (-a, high)])
    lean = np.arctan2(w - a, high - lift)
    for side in sides:
        wall = k.panel(outline, side[0], (-t / 2, t / 2) if side[1] == "+" else (t / 2, -t / 2))
        s = 1 if side[1] == "+" else -1
        for piece in wall:
            shift = s * (w - 0.02 - np.tan(lean) * (piece.vertices[:, 2] - lift))
            piece.vertices[:, "xy".index(side[0])] += shift
        m.add(BASE, *wall)
    for s in (-1, 1):
        if f"x{'+' if s > 0 else '-'}" not in sides:
            m.add(BASE, *k.limb((s * w, -0.9 * w, lift + 0.2), (s * a, 0.9 * a, high - 0.1), 0.12, 0.14))


def _roof(m: Model, wide: float, top: float) -> None:
    """A deck with battlements, a ridged roof or nothing."""
    kind = m.pick("deck", "ridge", "beams")
    a = wide + 0.12
    if kind == "ridge":
        m.add(BASE, prism([(-a - 0.15, top - 0.05), (a + 0.15, top - 0.05), (0, top + 0.8 * wide)], "y", (-a, a)))
        return
    if kind == "beams":
        m.add(BASE, *(box((-a, a), (q * wide - 0.1, q * wide + 0.1), (top - 0.2, top)) for q in (-1, 1)))
        m.add(BASE, *(box((q * wide - 0.1, q * wide + 0.1), (-a, a), (top - 0.2, top)) for q in (-1, 1)))
        return
    m.add(BASE, box((-a, a), (-a, a), (top - 0.1, top + 0.02)))
    for i in range(4):
        x = -a + 0.05 + (2 * a - 0.3) * i / 3
        m.add(BASE, *(box((x, x + 0.2), (q * a, q * (a - 0.1)), (top, top + 0.5)) for q in (-1, 1)))
        m.add(BASE, *(box((q * a, q * (a - 0.1)), (x, x + 0.2), (top, top + 0.3)) for q in (-1, 1)))


def _running(m: Model, k: Look, w: float, lift: float) -> None:
    """Four or six wheels on axles."""
    r = lift + m.number(-0.05, 0.2)
    for i, y in enumerate(m.pick((-0.7, 0.7), (-0.8, 0.0, 0.8))):
        m.add(
            BASE,
            rod((-w - 0.4, y * w, r), (w + 0.4, y * w, r), 0.07, 8),
            box((-0.9 * w, 0.9 * w), (y * w - 0.1, y * w + 0.1), (r - 0.1, lift + 0.1)),
        )
        for s, side in ((-1, "right"), (1, "left")):
            at = vec(s * (w + 0.28), y * w, r)
            m.add(f"wheel_{side}_{i}", *k.wheel(at, (1, 0, 0), r if r < 0.48 * w else 0.48 * w, 0.09))
            m.spin(f"wheel_{side}_{i}", at, (1, 0, 0))


def _extras(m: Model, k: Look, w: float, a: float, lift: float, high: float) -> None:
    """A ladder, a door behind, a winch drum, a ram that hangs."""
    if m.chance(0.6):
        y = w + 0.12
        m.add(BASE, *(k.limb((x, y, lift), (x, a + 0.1, high), 0.07, 0.07)[0] for x in (-0.3, 0.3)))
        for q in np.linspace(0.06, 0.94, 9):
            z = lift + q * (high - lift)
            m.add(BASE, rod((-0.32, y + q * (a + 0.1 - y), z), (0.32, y + q * (a + 0.1 - y), z), 0.03, 6))
    if m.chance(0.5):
        z = lift + 0.8
        m.add(BASE, *(box((s * 0.5, s * 0.58), (0.2, 0.4), (lift + 0.2, z + 0.15)) for s in (-1, 1)))
        m.add("winch", rod((-0.7, 0.3, z), (0.7, 0.3, z), 0.05, 8), rod((-0.45, 0.3, z), (0.45, 0.3, z), 0.16, max(8, k.n)))
        m.add("winch", *(box((s * 0.62, s * 0.7), (0.26, 0.34), (z - 0.35, z + 0.35)) for s in (-1, 1)))
        m.spin("winch", (0, 0.3, z), (1, 0, 0))
