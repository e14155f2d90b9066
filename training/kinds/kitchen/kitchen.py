"""Kitchen furniture: wall and corner cabinets, tall pantries, runs of base units."""

from __future__ import annotations

import itertools

import numpy as np
from shapely.geometry import Polygon
from shapely.geometry import box as square

from training.kinds.kitchen_parts import blind, body, door, drawer, fill, look, rack, swing, tray
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rod, vec


def _shares(m: Model, count: int, least: float) -> np.ndarray:
    """Borders from 0 to 1 of columns or rows of drawn widths."""
    sizes = np.ones(count) if m.chance(0.6) else m.rng.uniform(least, 1, count)
    return np.concatenate([[0.0], np.cumsum(sizes / sizes.sum())])


def wall_unit(m: Model) -> None:
    """Wall cupboards with flaps that lift up, some in two halves that fold, some fixed, some a plain shelf."""
    columns, rows = m.pick(1, 2, 3, 4), m.pick(1, 1, 2)
    wide, high, deep, how = columns * m.number(0.45, 0.9), rows * m.number(0.35, 0.5), m.number(0.28, 0.4), look(m, 0.4)
    xs, zs = wide * _shares(m, columns, 0.5), 1.4 + high * _shares(m, rows, 0.6)
    rooms = [((a, b), (c, d)) for a, b in itertools.pairwise(xs) for c, d in itertools.pairwise(zs)]
    rooms = [((a + 0.01, b - 0.01), (c + 0.01, d - 0.01)) for (a, b), (c, d) in rooms]
    hollow = body(m, (0, wide), (0, deep), (1.4, 1.4 + high), rooms, how)
    fixed = int(m.rng.integers(len(rooms))) if len(rooms) > 1 and m.chance(0.5) else -1
    folds = m.chance(0.35)
    for k, (x, z) in enumerate(rooms):
        half = (z[0] + z[1]) / 2
        if k == fixed:
            blind(m, x, how.depth, z, how)
        elif folds:
            fill(
                m,
                f"upper_{k}",
                (x[0] + how.clear, x[1] - how.clear),
                how.depth,
                (half + 0.002, z[1]),
                look(m, 0.4, (how.front,), ("none",)),
            )
            swing(m, f"upper_{k}", x, how.depth, (half + 0.002, z[1]), "top", m.pick(80, 100))
            fill(m, f"lower_{k}", (x[0] + how.clear, x[1] - how.clear), how.depth, (z[0], half - 0.002), how, "bottom")
            at = vec((x[0] + x[1]) / 2, how.depth[m.pick(0, 1)], half)
            m.hinge(f"lower_{k}", at, (-1, 0, 0), (-150, 30), f"upper_{k}")
        else:
            door(m, f"flap_{k}", x, z, "top", how, m.pick(80, 95, 110))
        if hollow and m.chance(0.4):
            m.add(BASE, box(x, (0.04, deep - 0.03), (half, half + 0.016)))
    if m.chance(0.5):  # a light strip below and a cornice above
        m.add(BASE, box((0, wide), (0.01, 0.03), (1.37, 1.4)))
        m.add(BASE, box((-0.02, wide + 0.02), (-0.04, deep), (1.4 + high, 1.44 + high)))


def corner_cabinet(m: Model) -> None:
    """A cupboard in a corner: two fronts that fold, one slanted front, or one front beside a blind panel; a carousel."""
    side, deep, high, how = (
        m.number(0.75, 1.0),
        m.number(0.5, 0.6),
        m.pick(m.number(0.6, 0.8), m.number(0.5, 0.9)),
        look(m, 0.3),
    )
    foot, c, t = m.pick(0.0, 0.08, 0.12), side - deep, how.thick
    z = (foot + 0.012, foot + high - 0.012)
    slanted = m.chance(0.3)
    cornered = [(c, 0), (side, 0), (side, side), (0, side), (0, c)]
    plan = Polygon(cornered if slanted else [*cornered, (c, c)])
    solid = prism(plan, "z", (foot, foot + high))
    hollow = m.chance(0.6)
    if hollow:
        inner = plan.buffer(-0.02, join_style="mitre")
        mouth = (
            Polygon([(0.03, c), (c, 0.03), (c + 0.1, 0.1), (0.1, c + 0.1)]) if slanted else square(0.03, 0.03, c + 0.1, c + 0.1)
        )
        solid = cut(solid, prism(inner.union(mouth), "z", (z[0] + 0.01, z[1] - 0.01)))
    m.add(BASE, solid)
    if foot:
        m.add(BASE, prism(plan.buffer(-0.05, join_style="mitre"), "z", (0, foot)))
    if m.chance(0.6):
        m.add(BASE, prism(plan.buffer(0.02, join_style="mitre"), "z", (foot + high, foot + high + 0.03)))
    if slanted:
        long = float(np.hypot(c, c))
        part = Model(m.rng)
        fill(part, "door", (0.004, long - 0.004), (-t, 0), z, how, "right")
        for _, solid in part.pieces:
            solid.apply_transform([[0.7071, 0.7071, 0, 0], [-0.7071, 0.7071, 0, c], [0, 0, 1, 0], [0, 0, 0, 1]])
            m.add("door", solid)
        m.hinge("door", (-0.7 * t, c - 0.7 * t, z[0]), (0, 0, -1), 110)
    else:
        fill(m, "first", (0.004, c - t - 0.002), (c - t, c), z, how, "right")
        swing(m, "first", (0.004, c - t - 0.002), (c - t, c), z, "left", m.pick(100, 150))
        part = Model(m.rng)
        fill(part, "second", (0.004, c - 0.002), (-t, 0), z, how, "left" if m.chance(0.5) else "right")
        for _, solid in part.pieces:  # turn it to face -X, from the inner corner to the front
            solid.apply_transform([[0, 1, 0, c], [-1, 0, 0, c], [0, 0, 1, 0], [0, 0, 0, 1]])
            m.add("second", solid)
        m.hinge("second", (c - t, c - t, z[0]), (0, 0, -1), m.pick(85, 90), "first")
    if hollow and m.chance(0.6):
        at, r = (c + 0.4 * deep, c + 0.4 * deep), 0.36 * deep
        heights = m.pick((0.08,), (0.08, 0.5)) if m.chance(0.7) else (0.3,)
        m.add("carousel", rod((*at, z[0] + 0.012), (*at, z[1] - 0.012), 0.012, 10))
        m.add("carousel", *(rod((*at, foot + s * high), (*at, foot + s * high + 0.02), r, 24) for s in heights))
        m.spin("carousel", (*at, z[0]), (0, 0, 1))


def tall_pantry(m: Model) -> None:
    """A tall cupboard: pull-out fronts with baskets, doors side by side, or doors above drawers."""
    style, how = m.pick("pull_out", "doors", "mixed"), look(m, 0.5)
    wide, high = (
        {"pull_out": m.number(0.3, 0.45), "doors": m.number(0.6, 1.1), "mixed": m.number(0.5, 0.9)}[style],
        m.number(1.7, 2.3),
    )
    deep, foot = m.number(0.5, 0.62), m.pick(0.05, 0.1, 0.15)
    rows = np.array([0, 1]) if m.chance(0.3) else np.array([0, m.number(0.35, 0.6), 1])
    zs, top = foot + (high - foot) * rows, high
    filler = m.pick(0.0, 0.0, 0.08)  # a fixed panel beside the fronts
    rooms = [((0.01, wide - 0.01), (a + 0.008, b - 0.008)) for a, b in itertools.pairwise(zs)]
    hollow = body(m, (-filler, wide), (0, deep), (foot, top), rooms, how)
    if filler:
        m.add(BASE, box((-filler, 0), how.depth, (foot + 0.008, top - 0.008)))
    feet(m, (-filler, wide), (0, deep), foot)
    for k, (x, z) in enumerate(rooms):
        if style == "pull_out":
            drawer(m, f"pull_out_{k}", x, z, deep, how, "none", "middle" if m.chance(0.5) else "top")
            for c in np.linspace(z[0] + 0.05, z[1] - 0.3, 3) if hollow else []:
                tray(
                    m,
                    f"pull_out_{k}",
                    (x[0] + 0.03, x[1] - 0.03),
                    (how.depth[1], deep - 0.06),
                    (c, c + 0.1),
                    m.pick("wire", "tub"),
                )
        elif style == "mixed" and k == 0:
            count = m.pick(2, 3, 4)
            cells = [
                (a + 0.002, b - 0.002)
                for a, b in zip(*(np.linspace(*z, count + 1)[s] for s in (slice(-1), slice(1, None))), strict=True)
            ]
            for i, cell in enumerate(cells):
                drawer(m, f"drawer_{i}", x, cell, deep, how, "box" if hollow else "none")
        else:
            half, single = (x[0] + x[1]) / 2, wide < 0.65
            for i, (span, side) in enumerate(
                [(x, m.pick("left", "right"))] if single else [((x[0], half), "left"), ((half, x[1]), "right")]
            ):
                door(m, f"door_{k}_{i}", span, z, side, how, m.pick(95, 110, 150))
            for c in np.linspace(*z, m.pick(3, 4, 5))[1:-1] if hollow else []:
                m.add(BASE, box(x, (0.04, deep - 0.03), (c - 0.009, c + 0.009)))
    if m.chance(0.4):
        m.add(BASE, box((-filler - 0.03, wide + 0.03), (-0.04, deep), (high, high + m.number(0.03, 0.08))))


def kitchen_run(m: Model) -> None:
    """A run of base units below one worktop: doors, drawers, false fronts, open shelves, a sink or a hob."""
    count, how = m.pick(2, 3, 4, 6), look(m, 0.5)
    deep, foot, high = m.number(0.55, 0.65), m.number(0.08, 0.16), m.number(0.82, 0.92)
    xs = np.concatenate([[0], np.cumsum([m.pick(0.3, 0.4, 0.5, 0.6, 0.8) for _ in range(count)])])
    rooms: list[tuple[Span, Span]] = []
    todo: list[tuple[str, int, str]] = []  # (kind, its room, side)
    for a, b in itertools.pairwise(xs):
        x, style = (float(a) + 0.006, float(b) - 0.006), m.pick("door", "drawers", "both", "false", "open", "pair")
        cuts = {"drawers": m.pick((0.5,), (0.33, 0.66), (0.2, 0.6), (0.25, 0.5, 0.75)), "both": (0.78,), "false": (0.78,)}.get(
            style, ()
        )
        zs = foot + (high - foot) * np.array([0, *cuts, 1])
        cells = [(x, (float(c) + 0.006, float(d) - 0.006)) for c, d in itertools.pairwise(zs)]
        kinds = {"drawers": ["drawer"] * len(cells), "both": ["door", "drawer"], "false": ["door", "false"]}.get(style, [style])
        todo += [(kind, len(rooms) + i, m.pick("left", "right")) for i, kind in enumerate(kinds)]
        rooms += cells
    if all(kind in ("open", "false") for kind, _, _ in todo):
        todo[0] = ("door", *todo[0][1:])
    body(m, (0, xs[-1]), (0, deep), (foot, high), rooms, how)
    for kind, k, side in todo:
        x, z = rooms[k]
        half = (x[0] + x[1]) / 2
        if kind == "drawer":
            drawer(m, f"drawer_{k}", x, z, deep, how, m.pick("box", "none"))
        elif kind == "pair":
            door(m, f"door_{k}", (x[0], half), z, "left", how, 110)
            door(m, f"door_{k}_b", (half, x[1]), z, "right", how, 110)
        elif kind == "door":
            door(m, f"door_{k}", x, z, side, how, 110)
        elif kind == "false":
            blind(m, x, how.depth, z, how)
        else:
            rack(m, BASE, x, (0.01, deep - 0.05), (z[0] + z[1]) / 2)
    feet(m, (0, xs[-1]), (0, deep), foot)
    top = box((-0.01, xs[-1] + 0.01), (-0.04, deep), (high, high + m.number(0.015, 0.04)))
    hole = ((0.15, 0.15 + min(0.5, xs[-1] - 0.3)), (0.1, deep - 0.1))
    if m.chance(0.4):
        top = cut(top, box(hole[0], hole[1], (high - 1, high + 1)))
        m.add(
            BASE,
            cut(box(*hole, (high - 0.18, high + 0.02)), box(*((a + 0.01, b - 0.01) for a, b in hole), (high - 0.17, high + 1))),
        )
    elif m.chance(0.4):
        m.add(
            BASE,
            *(rod((c, d, high), (c, d, high + 0.045), 0.08, 20) for c in (0.3, 0.5)[: 1 + (count > 2)] for d in (0.17, 0.42)),
        )
    m.add(BASE, top)
    if m.chance(0.4):
        m.add(BASE, box((0, xs[-1]), (deep - 0.02, deep), (high, high + m.pick(0.1, 0.5))))
