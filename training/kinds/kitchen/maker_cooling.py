"""Kitchen machines by another hand: refrigerator and bread toaster."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.maker_fronts import button, dial, door, screen, vents
from training.kinds.maker_style import Cell, Maker, cuboid, maker, soft, without
from training.kinds.model import Model
from training.kinds.solids import Span, arch, box, cut, prism, rod, rounded, vec


def refrigerator(m: Model) -> None:
    """A fridge: one door, freezer above or below, side by side, French doors over drawers, or a small rounded one."""
    k = maker(m)
    if k.way != "sheet" and m.chance(0.2):
        _round_shouldered(k, m.number(0.5, 0.68), m.number(0.8, 1.6), m.number(0.5, 0.65))
        return
    design = m.pick("one", "above", "below", "beside", "french", "small")
    wide = m.number(0.8, 0.95) if design in ("beside", "french") else m.number(0.45, 0.7)
    high = m.number(0.5, 0.9) if design == "small" else m.number(1.4, 1.95)
    deep, wall, t, g = m.number(0.5, 0.7), m.number(0.03, 0.05), k.thin(m.number(0.03, 0.07)), 0.004 + abs(m.gap(wide)) * 0.6
    foot = m.pick(0.0, 0.03, 0.06)
    side = m.pick("left", "right")
    whole, split = (0.0, wide), m.number(0.4, 0.5) * wide
    at = foot + (high - foot) * {"above": 0.72, "below": 0.38, "french": 0.42}.get(design, 0.5)
    spots = {
        "above": [(whole, (foot, at), side), (whole, (at, high), side)],
        "below": [(whole, (foot, at), m.pick(side, "drawers")), (whole, (at, high), side)],
        "beside": [((0, split), (foot, high), "left"), ((split, wide), (foot, high), "right")],
        "french": [
            (whole, (foot, at), "drawers"),
            ((0, wide / 2), (at, high), "left"),
            ((wide / 2, wide), (at, high), "right"),
        ],
    }.get(design, [(whole, (foot, high), side)])
    cells: list[Cell] = []
    for i, (x, z, hung) in enumerate(spots):
        if hung == "drawers":
            cells += _freezer_drawers(k, x, z, (wall, t, g), deep)
            continue
        cells.append(((x[0] + wall, x[1] - wall), (z[0] + wall, z[1] - wall)))
        door(k, f"door_{i}", (x[0] + g / 2, x[1] - g / 2), (z[0] + g / 2, z[1] - g / 2), (-t - 0.004, -0.004), hung)
        m.add("base", box((x[0] + wall / 3, x[1] - wall / 3), (-0.004, 0.001), (z[0] + wall / 3, z[0] + wall / 2)))
        if k.inside:
            _shelves(k, f"crisper_{i}", f"door_{i}", cells[-1], deep - wall)
        if i == 0 and design in ("beside", "one", "above") and m.chance(0.4):
            _dispenser(k, f"door_{i}", x, z, -t - 0.004)
    m.add("base", *k.case((0, wide), (0, deep), (foot, high), wall, cells))
    if foot:
        m.add("base", *k.feet((0, wide), (0.02, deep), (0, foot + 0.002), 0.02))
    if m.chance(0.3):
        m.add("base", *vents(k, (0.1 * wide, 0.9 * wide), (high - 0.03, high - 0.01), 0.001, 2))
    if m.chance(0.3):
        m.add("base", k.block((0.02, wide - 0.02), (0.02, deep), (high - 0.002, high + m.number(0.02, 0.05))))


def _round_shouldered(k: Maker, wide: float, high: float, deep: float) -> None:
    """An old-fashioned fridge with round shoulders: one door of the same outline, or a second one below it."""
    m, foot, t, wall = k.m, k.m.number(0.03, 0.1), k.m.number(0.04, 0.07), 0.045
    rise, side = m.number(0.08, 0.2) * wide, m.pick("left", "right")
    body = prism(arch((0, wide), (foot, high), rise, 2 * k.n), "y", (0, deep))
    split = m.pick(foot, foot + m.number(0.25, 0.5) * (high - foot))
    cells: list[Cell] = [((wall, wide - wall), (split + wall, high - rise - wall))]
    upper = prism(arch((0.004, wide - 0.004), (split + 0.003, high - 0.004), rise, 2 * k.n), "y", (-t, -0.003))
    leaves = [("door_0", upper, (split, high))]
    if split > foot:
        cells.append(((wall, wide - wall), (foot + wall, split - wall / 2)))
        leaves.append(("door_1", k.block((0.004, wide - 0.004), (-t, -0.003), (foot, split - 0.003)), (foot, split)))
    m.add("base", cut(body, *(box(a, (-1, deep - wall), b) for a, b in cells)) if k.inside else body)
    m.add("base", box((0.03, wide - 0.03), (-0.004, 0.001), (foot + 0.02, foot + 0.05)))
    m.add("base", *k.feet((0, wide), (0.01, deep), (0, foot + 0.005), 0.022))
    for i, (part, leaf, z) in enumerate(leaves):
        free, hung = (wide - 0.06, 0.0) if side == "left" else (0.06, wide)
        at = vec(free, -t, z[0] + 0.6 * (z[1] - z[0] - rise))
        m.add(part, leaf, *k.handle(at, 0.18, True))
        if m.chance(0.5):
            m.add(part, box((0.2 * wide, 0.8 * wide), (-t - 0.004, -t + 0.001), (z[0] + 0.1, z[0] + 0.115)))
        m.hinge(part, (hung, -t / 2, z[0]), (0, 0, -1 if side == "left" else 1), m.pick(90, 110))
        if k.inside:
            _shelves(k, f"crisper_{i}", part, cells[i], deep - wall)


def _freezer_drawers(k: Maker, x: Span, z: Span, sizes: tuple[float, float, float], deep: float) -> list[Cell]:
    """One to three drawers with tall fronts."""
    wall, t, g = sizes
    edges = np.linspace(z[0], z[1], k.m.pick(1, 2, 3) + 1)
    cells = [((x[0] + wall, x[1] - wall), (a + wall / 2, b - wall / 2)) for a, b in pairwise(edges)]
    for i, cell in enumerate(cells):
        k.drawer(f"freezer_drawer_{i}", cell, -0.004, t, deep - 2 * wall, wall / 2 - g / 2)
        k.m.add("base", box((x[0] + wall / 3, x[1] - wall / 3), (-0.004, 0.001), (cell[1][1], cell[1][1] + wall / 4)))
    return cells


def _shelves(k: Maker, crisper: str, leaf: str, cell: Cell, deep: float) -> None:
    """Shelves, boxes that pull out below them, bins on the door."""
    (a, b), (c, d) = cell
    count = max(1, round((d - c) / k.m.number(0.22, 0.34)))
    levels = np.linspace(c, d, count + 1)[1:-1]
    for z in levels:
        if k.m.chance(0.3) and k.way == "cad":
            bars = [rod((u, 0.03, z), (u, deep, z), 0.003, 6) for u in np.linspace(a + 0.02, b - 0.02, 9)]
            k.m.add("base", *bars, rod((a - 0.003, 0.1, z), (b + 0.003, 0.1, z), 0.004, 6))
        else:
            k.m.add("base", box((a - 0.002, b + 0.002), (0.05, deep), (z, z + 0.008)))
    if len(levels) and k.m.chance(0.7):
        halves = [(a, b)] if b - a < 0.4 or k.m.chance(0.4) else [(a, (a + b) / 2), ((a + b) / 2, b)]
        for i, (u, w) in enumerate(halves):
            top = c + min(0.2, 0.8 * (levels[0] - c))
            bin_ = box((u + 0.006, w - 0.006), (0.06, deep - 0.02), (c + 0.001, top))
            hole = box((u + 0.012, w - 0.012), (0.066, deep - 0.03), (c + 0.007, top + 1))
            k.m.add(f"{crisper}{i}", without(bin_, (0, 0, 1)) if k.way == "sheet" else cut(bin_, hole))
            k.m.slide(f"{crisper}{i}", (0, -1, 0), 0.6 * deep)
    if k.m.chance(0.6):
        for z in np.linspace(c + 0.3 * (d - c), d - 0.15 * (d - c), k.m.pick(1, 2, 3)):
            shell = box((a + 0.02, b - 0.02), (-0.005, 0.045), (z, z + 0.06))
            hole = box((a + 0.025, b - 0.025), (0.001, 0.04), (z + 0.006, z + 1))
            k.m.add(leaf, without(shell, (0, 0, 1)) if k.way == "sheet" else cut(shell, hole))


def _dispenser(k: Maker, leaf: str, x: Span, z: Span, y: float) -> None:
    """A water and ice station on a door: frame, screen and a paddle that is pushed."""
    w, c, low = 0.25 * (x[1] - x[0]), (x[0] + x[1]) / 2, z[0] + 0.5 * (z[1] - z[0])
    k.m.add(leaf, *(box((u, u + 0.008), (y - 0.02, y + 0.001), (low, low + 0.3)) for u in (c - w, c + w - 0.008)))
    k.m.add(
        leaf,
        box((c - w, c + w), (y - 0.03, y + 0.001), (low - 0.008, low)),
        screen(k, (c - w, c + w), (low + 0.2, low + 0.3), y - 0.02),
    )
    k.m.add(leaf, box((c - w, c + w), (y - 0.0195, y + 0.001), (low + 0.2, low + 0.3)))
    if k.m.chance(0.7):
        k.m.add("paddle", cuboid((c, y - 0.012, low + 0.15), (0.25 * w, 0.003, 0.055)))
        k.m.hinge("paddle", (c, y - 0.012, low + 0.205), (1, 0, 0), 7, leaf)


def bread_toaster(m: Model) -> None:
    """A toaster along or across: slots, a lever at an end or in front, a dial, keys, a crumb tray."""
    k = maker(m)
    long, wide, high, foot = m.number(0.24, 0.4), m.number(0.15, 0.2), m.number(0.16, 0.21), m.pick(0.0, 0.008, 0.015)
    slots = m.pick(1, 2, 2, 2)
    pairs = 2 if long > 0.33 and m.chance(0.5) else 1
    x, y, z = (0.0, long), (0.0, wide), (foot, foot + high)
    r = m.number(0.1, 0.45) * min(wide, high)
    body = _toaster_body(k, x, y, z, r)
    holes, runs = [], np.linspace(0.04, long - 0.04, pairs + 1)
    for w in np.linspace(0.34, 0.66, slots) * wide if slots > 1 else [0.5 * wide]:
        holes += [((a + 0.01 * (i > 0), b), (w - 0.014, w + 0.014)) for i, (a, b) in enumerate(pairwise(runs))]
    low = z[0] + (0.4 if k.inside else 0.85) * high
    if k.way == "low" and not k.inside:
        m.add("base", body, *(box(a, b, (z[1] - 0.002, z[1] + 0.0015)) for a, b in holes))
    elif k.way == "sheet":
        m.add("base", body, *(without(box(a, b, (low, z[1] + 0.001)), (0, 0, 1)) for a, b in holes))
    else:
        m.add("base", cut(body, *(box(a, b, (low, 1)) for a, b in holes)))
    if k.way in ("cad", "old"):
        frames = [
            cut(
                box((a[0] - 0.003, a[1] + 0.003), (b[0] - 0.003, b[1] + 0.003), (z[1] - 0.001, z[1] + 0.003)), box(a, b, (0, 1))
            )
            for a, b in holes
        ]
        m.add("base", *frames)
    if foot:
        m.add("base", *k.feet((0.1 * long, 0.9 * long), (0.1 * wide, 0.9 * wide), (0, foot + 0.02), 0.01))
    _toaster_front(k, long, wide, z, pairs)


def _toaster_body(k: Maker, x: Span, y: Span, z: Span, r: float) -> Trimesh:
    """The housing: a block, a loaf seen from the end, or a round-edged one."""
    if k.way == "sheet":
        return without(box(x, y, z), (0, 0, -1))
    if k.way == "soft":
        return soft(x, y, z, min(r, 0.06), 3)
    if k.way == "low":
        return k.block(x, y, z)
    if k.m.chance(0.5):
        return prism(arch(y, z, min(r, 0.4 * (y[1] - y[0]))), "x", x)
    return prism(rounded(x, z, min(r, 0.05)), "y", y)


def _toaster_front(k: Maker, long: float, wide: float, z: Span, pairs: int) -> None:
    """What is on an end or on the long front: levers, dial, keys, tray."""
    m, high = k.m, z[1] - z[0]
    ahead = m.chance(0.4) or pairs == 2
    spots = [vec(s * long, 0, 0) for s in ((0.28, 0.72)[:pairs] if pairs == 2 else (m.number(0.4, 0.6),))]
    out = vec(0, -1, 0) if ahead else vec(1, 0, 0)
    spots = spots if ahead else [vec(long, 0.5 * wide, 0)]
    across = vec(1, 0, 0) if ahead else vec(0, 1, 0)
    width, up = m.number(0.014, 0.028), z[0] + m.number(0.62, 0.72) * high
    for i, at in enumerate(spots):
        mid = at + vec(0, 0, up)
        m.add("base", cuboid(at + vec(0, 0, z[0] + 0.48 * high), across * 0.004 + abs(out) * 0.0012 + vec(0, 0, 0.24 * high)))
        m.add(f"lever_{i}", cuboid(mid + 0.006 * out, across * 0.003 + abs(out) * 0.0075 + vec(0, 0, 0.004)))
        half = across * width + abs(out) * 0.008 + vec(0, 0, m.number(0.005, 0.01))
        m.add(
            f"lever_{i}",
            k.block(*(tuple(c + s * h for s in (-1, 1)) for c, h in zip(mid + 0.02 * out, half, strict=True)), -out),
        )
        m.slide(f"lever_{i}", (0, 0, -1), 0.38 * high)
    if m.chance(0.75):
        for i, at in enumerate(spots):
            side = at + across * (0.3 * wide if not ahead else 0.14 * long) + vec(0, 0, z[0] + 0.3 * high)
            dial(k, f"dial_{i}", side, m.number(0.01, 0.016), 0.014, out)
    for j in range(m.pick(0, 0, 2, 3)):
        for i, at in enumerate(spots):
            spot = at - across * (0.28 * wide if not ahead else 0.12 * long) + vec(0, 0, z[0] + (0.2 + 0.13 * j) * high)
            button(k, f"key_{i}_{j}", spot, (0.008, 0.006), 0.004, out, turn=m.chance(0.5) and k.way != "sheet")
    if m.chance(0.5):
        down = z[0] - 0.002 if z[0] > 0 else 0.01
        tray = cuboid(vec(0.5 * long, 0.5 * wide, down), vec(0.42 * long, 0.27 * wide, 0.0018))
        m.add("crumb_tray", tray, cuboid(vec(0.03 * long, 0.5 * wide, down), vec(0.05 * long, 0.2 * wide, 0.003)))
        m.slide("crumb_tray", (-1, 0, 0), 0.6 * long)
    if m.chance(0.4):
        for x in (0.004, long - 0.024):
            m.add("base", k.block((x, x + 0.02), (-0.004, wide + 0.004), (z[0], z[1] + 0.003)))
