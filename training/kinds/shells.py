"""Open shells with rooms, what fills the rooms, castors, and wings turned about the vertical [m, front at -Y]."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import trimesh

from training.kinds.kitchen_parts import FRONTS, PULLS, Look, door, drawer, fill, look
from training.kinds.model import BASE, Link, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, rod

Room = tuple[Span, Span]  # its spans along x and z


def manner(m: Model, fronts: Sequence[str] = FRONTS, pulls: Sequence[str] = PULLS) -> Look:
    """Draw a look whose fronts never overlap one another."""
    how = look(m, 0.5, fronts, pulls)
    return replace(how, clear=max(how.clear, 0.001))


def shell(
    m: Model, x: Span, y: Span, z: Span, layout: Sequence[tuple[float, Sequence[float]]], t: float = 0.018
) -> list[list[Room]]:
    """Build a body of boards, columns of (width, heights from below) as shares; return the rooms of every column."""
    over, back = m.chance(0.5), m.chance(0.8)
    across, upright = (x, (z[0] + t, z[1] - t)) if over else ((x[0] + t, x[1] - t), z)
    m.add(BASE, *(box((a, a + t), y, upright) for a in (x[0], x[1] - t)))
    m.add(BASE, *(box(across, y, (c, c + t)) for c in (z[0], z[1] - t)))
    if back:
        m.add(BASE, box((x[0] + t, x[1] - t), (y[1] - 0.006, y[1]), (z[0] + t, z[1] - t)))
    xs = _ends(x, [width for width, _ in layout], t)
    m.add(BASE, *(box((a, a + t), (y[0], y[1] - 0.006), (z[0] + t, z[1] - t)) for a in xs[1:-1]))
    rooms = []
    for (a, b), (_, heights) in zip(pairwise(xs), layout, strict=True):
        zs = _ends(z, heights, t)
        m.add(BASE, *(box((a + t, b), (y[0], y[1] - 0.006), (c, c + t)) for c in zs[1:-1]))
        rooms.append([((a + t, b), (c + t, d)) for c, d in pairwise(zs)])
    return rooms


def _ends(span: Span, shares: Sequence[float], t: float) -> list[float]:
    """Where the boards between rooms of these shares begin."""
    ends = span[0] + (span[1] - t - span[0]) * np.concatenate([[0.0], np.cumsum(shares) / np.sum(shares)])
    return [float(e) for e in ends]


def place(m: Model, part: str, what: str, room: Room, how: Look, deep: float, t: float = 0.018) -> None:
    """Fill a room: a door hinged left, right, top or bottom, a pair, a drawer, sliders, shelf things, a false front."""
    x, z = room
    if what == "sliders":
        sliders(m, part, x, z, how)
        return
    if what == "open":
        things(m, BASE, x, (0.05, deep - 0.03), z)
        return
    if how.sunk is None:
        lap = t / 2 - 0.001
        x, z = (x[0] - lap, x[1] + lap), (z[0] - lap, z[1] + lap)
    if what == "drawer":
        drawer(m, part, x, z, deep, how, m.pick("box", "box", "tub", "none"))
    elif what == "pair":
        half = middle(x)
        door(m, f"{part}_left", (x[0], half), z, "left", how, m.pick(95, 105, 110))
        door(m, f"{part}_right", (half, x[1]), z, "right", how, m.pick(95, 105, 110))
    elif what == "false":
        fill(m, BASE, x, how.depth, z, replace(how, pull="none"), "middle")
    else:
        door(m, part, x, z, what, how, m.pick(85, 90) if what in ("top", "bottom") else m.pick(95, 110))


def sliders(m: Model, part: str, x: Span, z: Span, how: Look) -> None:
    """Two or three leaves behind one another in tracks, each sliding along the body."""
    count, thick = (3 if x[1] - x[0] > 1.2 and m.chance(0.5) else 2), min(how.thick, 0.02)
    lap = m.number(0.015, 0.04)
    leaf = (x[1] - x[0] + (count - 1) * lap) / count
    style = replace(how, pull=m.pick("none", "recess", "groove"), thick=thick)
    for k in range(count):
        a = x[0] + k * (leaf - lap)
        y = 0.004 + (k % 2) * (thick + 0.004)
        span, edge = (a + 0.001, a + leaf - 0.001), ("left", "right")[k % 2]
        fill(m, f"{part}_slider_{k}", span, (y, y + thick), (z[0] + 0.003, z[1] - 0.003), style, edge)
        if style.pull == "none":
            at = (span[0] + 0.04, y, middle(z)) if k == 0 else (span[1] - 0.04, y, middle(z))
            m.add(f"{part}_slider_{k}", rod((at[0], y - 0.001, at[2]), (at[0], y + 0.002, at[2]), 0.015, m.sections()))
        m.slide(f"{part}_slider_{k}", (-1 if k == count - 1 else 1, 0, 0), leaf - lap)
    tracks = (0.0, 0.012 + 2 * thick)
    m.add(BASE, *(box(x, tracks, (c, c + 0.003)) for c in (z[0] - 0.001, z[1] - 0.002)))


def things(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """Stand fixed things on a shelf: books, a crate, an appliance, bowls, or nothing."""
    style, tall = m.pick("none", "none", "books", "crate", "device", "jars"), z[1] - z[0]
    wide, floor = x[1] - x[0], z[0]
    if style == "books":
        at = x[0] + 0.01
        while at < x[0] + 0.6 * wide:
            thick = m.number(0.015, 0.05)
            m.add(part, box((at, at + thick), (y[0] + 0.02, y[1] - 0.02), (floor, floor + m.number(0.5, 0.85) * tall)))
            at += thick + 0.001
    elif style == "crate":
        m.add(part, box((x[0] + 0.1 * wide, x[1] - 0.15 * wide), y, (floor, floor + 0.6 * tall)))
    elif style == "device":
        side = (middle(x) - 0.35 * wide, middle(x) + 0.35 * wide)
        m.add(part, box(side, y, (floor + 0.006, floor + 0.5 * tall)))
        m.add(part, box((side[0] + 0.02, middle(x)), (y[0] - 0.002, y[0]), (floor + 0.2 * tall, floor + 0.4 * tall)))
        m.add(part, *(box((a, a + 0.02), (y[0], y[0] + 0.02), (floor, floor + 0.006)) for a in (side[0], side[1] - 0.02)))
    elif style == "jars":
        r = min(0.12 * wide, 0.4 * (y[1] - y[0]), 0.08)
        for a in np.linspace(x[0] + 1.5 * r, x[1] - 1.5 * r, m.pick(2, 3)):
            m.add(part, rod((a, middle(y), floor), (a, middle(y), floor + 0.6 * tall), r, m.sections()))
            m.add(part, ball((a, middle(y), floor + 0.6 * tall), (0.6 * r, 0.6 * r, 0.08 * tall), 8))


def castors(m: Model, x: Span, y: Span, high: float, inset: float = 0.05) -> None:
    """Put a castor below each corner: a fork that swivels about the vertical with a wheel, or a fixed one."""
    r, moves, spoke = 0.42 * high, m.chance(0.7), m.pick(0.4, 0.6)
    for k, (a, b) in enumerate((a, b) for a in (x[0] + inset, x[1] - inset) for b in (y[0] + inset, y[1] - inset)):
        fork, wheel = (f"castor_{k}", f"wheel_{k}") if moves else (BASE, BASE)
        m.add(BASE, box((a - r, a + r), (b - r, b + r), (high - 0.06 * high, high)))
        m.add(fork, rod((a, b, 0.85 * high), (a, b, 0.96 * high), 0.5 * r, 10))
        m.add(fork, box((a - 0.6 * r, a + 0.6 * r), (b - 0.4 * r, b + 0.9 * r), (1.75 * r, 0.88 * high)))
        m.add(fork, *(box((a + c, a + c + 0.1 * r), (b, b + 0.8 * r), (0.8 * r, 0.88 * high)) for c in (-0.6 * r, 0.5 * r)))
        at = b + spoke * r
        m.add(wheel, rod((a - 0.45 * r, at, r), (a + 0.45 * r, at, r), r, m.pick(12, 16, 24)))
        if moves:
            m.spin(fork, (a, b, high), (0, 0, 1))
            m.spin(wheel, (a, at, r), (1, 0, 0), fork)


def wing(m: Model, other: Model, degrees: float, shift: tuple[float, float, float], name: str) -> None:
    """Put another object into this one, turned about the vertical and moved; its parts get a name before theirs."""
    turn = trimesh.transformations.rotation_matrix(np.deg2rad(degrees), [0, 0, 1])
    turn[:3, 3] = shift
    names = {BASE: BASE, **{part: f"{name}_{part}" for part in other.joints}}
    for part, solid in other.pieces:
        m.add(names[part], solid.copy().apply_transform(turn))
    for part, j in other.joints.items():
        origin, axis = turn[:3, :3] @ j.origin + turn[:3, 3], turn[:3, :3] @ j.axis
        m.joints[names[part]] = Link(j.type, names[j.parent], origin, axis, j.limits)
