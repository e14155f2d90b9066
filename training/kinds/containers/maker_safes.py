"""Steel strongboxes by another hand."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from training.kinds.maker_fronts import AXES, button, cornice, dial, screen
from training.kinds.maker_style import Cell, Maker, cuboid, maker, without
from training.kinds.model import Model
from training.kinds.solids import Span, ball, box, cut, prism, ring, rod, rounded, vec


def steel_strongbox(m: Model) -> None:
    """A safe of thick walls: one door, two beside or above each other; wheel, lever, dials, keypad; shelves or a drawer."""
    k = maker(m)
    design = m.pick("one", "one", "beside", "above", "low")
    wide = m.number(0.7, 1.1) if design == "beside" else m.number(0.3, 0.65)
    high = (
        wide
        * {"one": m.number(0.9, 1.8), "beside": m.number(0.9, 1.5), "above": m.number(1.6, 2.2), "low": m.number(0.45, 0.65)}[
            design
        ]
    )
    deep, wall, t = m.number(0.5, 0.9) * min(wide, 0.7), m.number(0.06, 0.13) * min(wide, high), m.number(0.02, 0.06)
    foot = m.pick(0.0, 0.015) if design == "low" else m.pick(0.0, 0.03, 0.08)
    side, other = m.pick(("left", "right"), ("right", "left"))
    halves = {
        "beside": [((0, wide / 2), (0, high), "left"), ((wide / 2, wide), (0, high), "right")],
        "above": [((0, wide), (0, 0.42 * high), side), ((0, wide), (0.42 * high, high), m.pick(side, other))],
    }.get(design, [((0, wide), (0, high), side)])
    cells: list[Cell] = []
    for i, (x, z, hung) in enumerate(halves):
        gap = 0.004 if design == "beside" else wall
        inner = (x[0] + (wall if x[0] == 0 else gap / 2), x[1] - (wall if x[1] == wide else gap / 2))
        up = (z[0] + wall + foot * (z[0] == 0), z[1] - wall * (0.5 if z[1] < high else 1))
        cells.append((inner, up))
        sunk = m.chance(0.5) and k.way != "low" and k.inside
        g = 0.002 + abs(m.gap(wide)) * 0.3
        y = (0.0, t) if sunk else (-t, -0.0005)
        rim = -g if sunk else 0.4 * min(wall, gap * 2 if design == "beside" else wall) - g * (design == "beside")
        xs, zs = (inner[0] - rim, inner[1] + rim), (up[0] - rim, up[1] + rim)
        m.add(f"door_{i}", *k.panel(xs, zs, y))
        edge = xs[0] if hung == "left" else xs[1]
        m.hinge(f"door_{i}", (edge, y[0] if sunk else y[0] + 0.3 * t, 0), AXES[hung], m.pick(90, 100, 120) if not sunk else 100)
        _locks(k, i, xs, zs, y, hung)
        if k.inside:
            _inside(k, i, (inner, up), deep - wall, t if sunk else 0.0)
    holes = cells if design != "beside" else [((wall, wide - wall), cells[0][1])]
    m.add("base", *k.case((0, wide), (0, deep), (foot, high), wall, holes))
    if foot:
        m.add("base", *k.feet((0, wide), (0, deep), (0, foot + 0.002), m.number(0.02, 0.04)))
    if k.way == "old":
        m.add(
            "base",
            cornice((0, wide), (0, deep), high - 0.001, 0.04, 0.02),
            box((-0.01, wide + 0.01), (-0.01, deep), (foot, foot + 0.025)),
        )


def _inside(k: Maker, i: int, cell: Cell, deep: float, front: float) -> None:
    """Shelves and perhaps a drawer below the top."""
    (a, b), (c, d) = cell
    k.m.add(
        "base",
        *(
            box((a - 0.002, b + 0.002), (front + 0.02, deep), (z, z + 0.008))
            for z in np.linspace(c, d, k.m.pick(2, 3, 4))[1:-1]
        ),
    )
    if k.m.chance(0.4):
        tray = box((a + 0.004, b - 0.004), (front + 0.02, deep - 0.01), (c + 0.002, c + 0.25 * (d - c)))
        hole = box((a + 0.01, b - 0.01), (front + 0.026, deep - 0.016), (c + 0.01, d))
        k.m.add(f"inner_drawer_{i}", without(tray, (0, 0, 1)) if k.way == "sheet" else cut(tray, hole))
        k.m.slide(f"inner_drawer_{i}", (0, -1, 0), 0.6 * deep)


def _locks(k: Maker, i: int, x: Span, z: Span, y: Span, hung: str) -> None:
    """What is on a door: a wheel or a lever, a dial or a keypad, a cover before a keyhole, hinges, bolts."""
    m, leaf, w, h = k.m, f"door_{i}", x[1] - x[0], z[1] - z[0]
    away = 1 if hung == "left" else -1
    free, mid = (x[1] if hung == "left" else x[0]), (z[0] + z[1]) / 2
    r, front = 0.13 * min(w, h, 0.7), y[0]
    at = vec(free - away * m.number(0.22, 0.45) * w, front, mid - 0.12 * h)
    design = m.pick("wheel", "lever", "lever", "none")
    if design == "wheel":
        _wheel(k, f"wheel_{i}", at, r, leaf)
    elif design == "lever":
        hub = [rod(at + vec(0, 0.002, 0), at - vec(0, 0.03, 0), 0.25 * r, k.n)]
        if m.chance(0.5):
            grip = cuboid(at - vec(away * 0.6 * r, 0.026, 0), (0.75 * r, 0.006, 0.14 * r))
        else:
            grip = rod(at - vec(0, 0.026, -0.2 * r), at - vec(0, 0.026, 1.3 * r), 0.13 * r, 8)
        m.add(f"lever_{i}", *hub, grip)
        m.hinge(f"lever_{i}", at, (0, away, 0), m.pick(60, 90), leaf)
    spot = vec(at[0], front, mid + 0.2 * h)
    if m.chance(0.5):
        dial(k, f"dial_{i}", spot, 0.5 * r, 0.025, parent=leaf)
        m.add(leaf, rod(spot + vec(0, 0.002, 0), spot - vec(0, 0.002, 0), 0.75 * r, k.n))
    elif m.chance(0.7):
        _keypad(k, i, spot, 0.3 * r)
    if k.way in ("old", "cad") and m.chance(0.5):
        hole = vec(at[0], front, mid + 0.03 * h)
        outline = rounded((hole[0] - 0.012, hole[0] + 0.012), (hole[2] - 0.03, hole[2] + 0.008), 0.007)
        m.add(f"keyhole_cover_{i}", prism(outline, "y", (front - 0.004, front - 0.0002)))
        m.hinge(f"keyhole_cover_{i}", hole, (0, -1, 0), 90, leaf)
    if k.inside and m.chance(0.5):
        back, inwards = y[1] + 0.012, -away * w
        for u in np.linspace(z[0] + 0.2 * h, z[1] - 0.2 * h, 3):
            m.add(leaf, rod((free + 0.1 * inwards, back, u), (free + 0.02 * inwards, back, u), 0.01, 8))
        bar = (free + 0.14 * inwards, free + 0.08 * inwards)
        m.add(leaf, box(bar, (back - 0.013, back + 0.012), (z[0] + 0.15 * h, z[1] - 0.15 * h)))


def _keypad(k: Maker, i: int, spot: Float[np.ndarray, " 3"], p: float) -> None:
    """Twelve keys of a size below a display, on a box on a door."""
    m, leaf, front = k.m, f"door_{i}", spot[1]
    m.add(
        leaf,
        k.block(
            (spot[0] - 1.9 * p, spot[0] + 1.9 * p),
            (front - 0.008, front + 0.001),
            (spot[2] - 2.6 * p, spot[2] + 3.4 * p),
            (0, 1, 0),
        ),
    )
    m.add(leaf, screen(k, (spot[0] - 1.5 * p, spot[0] + 1.5 * p), (spot[2] + 2.1 * p, spot[2] + 3 * p), front - 0.008))
    for n in range(12):
        key = spot + vec((n % 3 - 1) * 1.1 * p, -0.008, (1.5 - n // 3) * 1.1 * p)
        button(k, f"key_{i}_{n}", key, (0.4 * p, 0.4 * p), 0.003, parent=leaf, turn=False)


def _wheel(k: Maker, part: str, at: Float[np.ndarray, " 3"], r: float, leaf: str) -> None:
    """Spokes on a hub, with knobs at their ends or in a rim."""
    k.m.add(part, rod(at + vec(0, 0.002, 0), at - vec(0, 0.045, 0), 0.22 * r, k.n))
    count, begin = k.m.pick(3, 4, 5), k.m.number(0, 2)
    for t in begin + np.linspace(0, 2 * np.pi, count, endpoint=False):
        end = at + vec(r * np.cos(t), -0.035, r * np.sin(t))
        k.m.add(part, rod(at - vec(0, 0.035, 0), end, 0.08 * r, 8))
        if begin > 1:
            k.m.add(part, ball(end, (0.15 * r,) * 3, 8))
    if begin <= 1:
        k.m.add(part, ring(at - vec(0, 0.035, 0), (0, 1, 0), r, 0.09 * r))
    k.m.spin(part, at, (0, -1, 0), leaf)
