"""Kitchen machines by another hand: oven in a wall, free-standing stove, refrigerator, bread toaster."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot

from training.kinds.maker_fronts import button, dial, door, screen, wires
from training.kinds.maker_style import Cell, Maker, lathe, maker, without
from training.kinds.model import Model
from training.kinds.solids import Span, box, cut, prism, ring, rod, rounded, vec


def built_in_oven(m: Model) -> None:
    """One or two cavities with drop-down or side-hung doors, a control strip, perhaps racks and a warming drawer."""
    k = maker(m)
    wide, deep, wall, t = m.number(0.54, 0.76), m.number(0.5, 0.6), m.number(0.025, 0.05), k.thin(m.number(0.015, 0.04))
    highs = m.pick([m.number(0.33, 0.5)], [m.number(0.33, 0.45)], [m.number(0.28, 0.34), m.number(0.32, 0.4)])
    warm, strip = m.number(0.12, 0.16) * m.chance(0.35), m.number(0.08, 0.13)
    below = m.chance(0.2) and len(highs) == 1
    z = wall + warm + strip * below
    cells: list[Cell] = [((wall, wide - wall), (wall, warm + 0.1 * wall - 0.004))] if warm else []
    if below:
        cells = [(c[0], (c[1][0] + strip, c[1][1] + strip)) for c in cells]
    hung = "below" if m.chance(0.75) else m.pick("left", "right")
    for i, high in enumerate(highs):
        cell = ((wall, wide - wall), (z, z + high))
        cells.append(cell)
        g = abs(m.gap(wide)) * 0.5
        span, zs = (g + 0.003, wide - g - 0.003), (z - wall * 0.5, z + high + wall * 0.5)
        pane = ((0.16 * wide, 0.84 * wide), (z + 0.15 * high, z + 0.72 * high)) if m.chance(0.85) else None
        door(k, f"door_{i}", span, zs, (-t, -0.0005), hung, pane)
        if k.inside:
            _racks(k, f"rack_{i}", cell, deep - wall)
        z += high + wall + 0.005
    if warm:
        k.drawer("warming_drawer", cells[0], -0.0005, t, deep - 2 * wall, 0.35 * wall)
    top = z + (0.0 if below else strip)
    k.m.add("base", *k.case((0, wide), (0, deep), (0, top), wall, cells))
    _controls(k, (0.02, wide - 0.02), (0.012, strip - 0.012) if below else (z + 0.012, top - 0.012), m.pick(0, 2, 3, 5))
    if m.chance(0.4):
        f = m.number(0.008, 0.02)
        frame = prism(
            rounded((-f, wide + f), (-f, top + f), 0.004).difference(rounded((0, wide), (0, top), 0.002)), "y", (-f, f)
        )
        m.add("base", frame)


def _racks(k: Maker, part: str, cell: Cell, deep: float) -> None:
    """Racks or trays in a cavity that pull out, on ledges; or ledges alone."""
    (a, b), (c, d) = cell
    for i, s in enumerate((0.3, 0.6)[: k.m.pick(1, 2, 2)]):
        z = c + s * (d - c)
        k.m.add("base", *(box((u, u + 0.012), (0.02, deep - 0.01), (z - 0.012, z - 0.005)) for u in (a, b - 0.012)))
        if k.m.chance(0.3):
            continue
        if k.m.chance(0.5):
            k.m.add(f"{part}{i}", *wires((a + 0.005, b - 0.005), (0.02, deep - 0.03), z - 0.001, k.m.pick(7, 11, 15)))
        else:
            tray = box((a + 0.004, b - 0.004), (0.02, deep - 0.03), (z - 0.004, z + 0.02))
            hollow = box((a + 0.01, b - 0.01), (0.026, deep - 0.036), (z, z + 1))
            k.m.add(f"{part}{i}", without(tray, (0, 0, 1)) if k.way == "sheet" else cut(tray, hollow))
        k.m.slide(f"{part}{i}", (0, -1, 0), 0.6 * deep)


def _controls(k: Maker, x: Span, z: Span, knobs: int, y: float = 0.0) -> None:
    """A strip with knobs, a display and keys."""
    mid, half, wide = (z[0] + z[1]) / 2, (z[1] - z[0]) / 2, x[1] - x[0]
    proud = 0.006 if k.m.chance(0.6) else 0.0
    if proud:
        k.m.add("base", k.block(x, (y - proud, y + 0.001), z, (0, 1, 0)))
    spots = np.linspace(x[0] + 0.08 * wide, x[1] - 0.08 * wide, max(knobs, 2))
    if knobs > 2 and k.m.chance(0.5):
        spots = np.r_[spots[: knobs // 2] * 0.85, 0, spots[knobs // 2 :]][: knobs + 1]
        spots = np.delete(spots, knobs // 2)
    r = min(0.5 * half, 0.02)
    for i in range(knobs):
        dial(k, f"knob_{i}", vec(spots[i], y - proud, mid), r, k.m.number(0.015, 0.028))
    if knobs in (0, 2):
        c = (x[0] + x[1]) / 2
        k.m.add("base", screen(k, (c - 0.12 * wide, c + 0.12 * wide), (mid - 0.5 * half, mid + 0.5 * half), y - proud))
        for i in range(k.m.pick(0, 0, 3, 4)):
            button(k, f"button_{i}", vec(c + (0.15 + 0.05 * i) * wide, y - proud, mid), (0.014 * wide, 0.25 * half), 0.004)


def freestanding_stove(m: Model) -> None:
    """A stove on the floor: hob with knobs in front or on a splash back, one or two ovens, a drawer, perhaps a lid."""
    k = maker(m)
    range_wide = m.chance(0.3)
    wide, deep, high = m.number(0.9, 1.2) if range_wide else m.number(0.5, 0.76), m.number(0.55, 0.66), m.number(0.78, 0.9)
    wall, t, foot = (
        m.number(0.025, 0.045),
        k.thin(m.number(0.02, 0.04)),
        m.pick(0.0, 0.05, 0.14) if k.way == "old" else m.pick(0.0, 0.03),
    )
    drawer, strip = m.number(0.14, 0.2) * m.chance(0.6), 0.1
    low, up = foot + wall + drawer, high - strip - wall * 0.5
    split = m.number(0.45, 0.68) * wide if range_wide else 0.0
    spans = [(wall, split - wall / 2), (split + wall / 2, wide - wall)] if range_wide else [(wall, wide - wall)]
    cells: list[Cell] = [(s, (low, up)) for s in spans]
    if drawer:
        drawers = spans if m.chance(0.4) else [(wall, wide - wall)]
        for i, s in enumerate(drawers):
            cell = (s, (foot + wall * 0.5, low - wall * 0.7))
            cells.append(cell)
            k.drawer(f"drawer_{i}", cell, -0.0005, t, deep - 2 * wall, 0.3 * wall)
    side = m.pick("left", "right") if m.chance(0.3) or k.way == "old" else "below"
    for i, s in enumerate(spans):
        hung = side if len(spans) == 1 or side == "below" else ("left", "right")[i]
        w = s[1] - s[0]
        pane = ((s[0] + 0.17 * w, s[1] - 0.17 * w), (low + 0.2 * (up - low), low + 0.75 * (up - low)))
        xs, zs = (s[0] - 0.4 * wall, s[1] + 0.4 * wall), (low - 0.25 * wall, up + 0.25 * wall)
        door(k, f"oven_door_{i}", xs, zs, (-t, -0.0005), hung, pane if m.chance(0.75) else None)
        if k.inside:
            _racks(k, f"rack_{i}", cells[i], deep - wall)
    m.add("base", *k.case((0, wide), (0, deep), (foot, high), wall, cells))
    if foot:
        m.add("base", *k.feet((0, wide), (0.02, deep), (0, foot + 0.001), m.number(0.018, 0.03)))
    _hob(k, wide, deep, high)
    _splash(k, wide, deep, high, t)


def _hob(k: Maker, wide: float, deep: float, high: float) -> None:
    """Burners or plates, and perhaps grates, on top."""
    design, columns = k.m.pick("gas", "plates", "glass"), 3 if wide > 0.85 else 2
    top = high + (0.004 if design == "glass" else 0.012)
    k.m.add("base", k.block((-0.004, wide + 0.004), (-0.004, deep), (high - 0.001, top)))
    for i, x in enumerate(np.linspace(0.26, 0.74, columns) * wide):
        for j, y in enumerate((0.28 * deep, 0.7 * deep)):
            r = (0.07, 0.09)[(i + j) % 2]
            if design == "glass":
                k.m.add(
                    "base",
                    prism(Spot(x, y).buffer(r).difference(Spot(x, y).buffer(0.92 * r)), "z", (top - 0.0005, top + 0.0006)),
                )
            elif design == "plates" and k.way == "cad":
                k.m.add("base", *(ring((x, y, top + 0.002), (0, 0, 1), s * r, 0.005, 16) for s in (0.3, 0.6, 0.9)))
            else:
                shape = (
                    [(r, 0), (0.96 * r, 0.008)] if design == "plates" else [(0.5 * r, 0), (0.5 * r, 0.008), (0.4 * r, 0.014)]
                )
                k.m.add("base", lathe(shape, k.n).apply_translation((x, y, top - 0.0005)))
        if design == "gas":
            bars = [((x - 0.1, x + 0.1), (w - 0.005, w + 0.005)) for w in (0.12 * deep, 0.28 * deep, 0.7 * deep, 0.86 * deep)]
            bars += [((u - 0.005, u + 0.005), (0.1 * deep, 0.88 * deep)) for u in (x - 0.1, x, x + 0.1)]
            k.m.add("base", *(box(a, b, (top + 0.016 + 0.0005 * n, top + 0.026 + 0.0005 * n)) for n, (a, b) in enumerate(bars)))
            feet = [(x + a, b * deep) for a in (-0.1, 0.1) for b in (0.12, 0.86)]
            k.m.add("base", *(rod((a, b, top - 0.001), (a, b, top + 0.02), 0.005, 6) for a, b in feet))


def _splash(k: Maker, wide: float, deep: float, high: float, t: float) -> None:
    """Knobs on the front or on a splash back; a glass lid, a rail or a flue pipe."""
    knobs, back = k.m.pick(3, 4, 5, 6), k.m.pick("panel", "lid", "none", "none")
    z = high + 0.012
    if k.way == "old" and k.m.chance(0.5):
        k.m.add("base", rod((wide / 2, 0.85 * deep, high), (wide / 2, 0.85 * deep, high + 0.7), 0.06, k.n))
        k.m.add("base", ring((wide / 2, 0.85 * deep, high + 0.02), (0, 0, 1), 0.062, 0.01))
        back = "none"
    if back == "panel":
        y, up = deep - 0.06, k.m.number(0.12, 0.22)
        k.m.add("base", k.block((0, wide), (y, deep), (high, z + up)))
        if k.m.chance(0.6):
            _controls(k, (0.01, wide - 0.01), (z + 0.02, z + up - 0.01), knobs, y)
            return
    elif back == "lid":
        up = z + 0.035
        k.m.add("base", *(box((x, x + 0.03), (deep - 0.02, deep), (high, up)) for x in (0.1 * wide, 0.9 * wide - 0.03)))
        k.m.add("lid", k.block((0.004, wide - 0.004), (0.02, deep - 0.002), (up, up + k.m.pick(0.006, 0.02)), (0, 0, -1)))
        k.m.hinge("lid", (0, deep - 0.002, up), (-1, 0, 0), k.m.pick(90, 95))
    elif k.m.chance(0.3):
        posts = [vec(x, -0.06, high - 0.02) for x in (0.04, wide - 0.04)]
        k.m.add("base", rod((0.02, -0.06, high - 0.02), (wide - 0.02, -0.06, high - 0.02), 0.009, k.n))
        k.m.add("base", *(rod(p, p + vec(0, 0.062, 0), 0.007, 8) for p in posts))
    _controls(k, (0.01, wide - 0.01), (high - 0.095, high - 0.005), knobs)
