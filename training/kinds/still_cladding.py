"""Fixed facings, mouldings and loose things on ledges that objects of which nothing moves share [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.joinery import fuse, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, arch, ball, box, moved, prism, rectangle, ring, rod
from training.kinds.wheels import lathe

FACINGS = (
    "frames",
    "planks",
    "boards",
    "tiles",
    "stones",
    "reeds",
    "diamonds",
    "arches",
    "pilasters",
    "bolts",
    "none",
)


def courses(m: Model, x: Span, y: Span, z: Span, size: tuple[float, float], joint: float) -> list[Trimesh]:
    """Lay stones in courses with broken joints over an upright face, from y[0] to y[1]."""
    rows, out = max(2, round((z[1] - z[0]) / size[1])), []
    for k, (low, high) in enumerate(pairwise(np.linspace(*z, rows + 1))):
        cuts = np.arange(x[0] + size[0] * (0.5 if k % 2 else 1.0), x[1] - 0.2 * size[0], size[0])
        for a, b in pairwise([x[0], *cuts, x[1]]):
            front = y[0] + m.number(0, 0.4) * (y[1] - y[0])
            out.append(box((a + joint, b - joint), (front, y[1] + 0.01), (low + joint, high - joint)))
    return out


def _bay(how: str, x: Span, y: float, z: Span, rim: float, t: float) -> list[Trimesh]:
    """Make the facing of one bay of a front."""
    inner = shrunk(x, rim), shrunk(z, rim)
    deep, mid, height = (y - t, y + 0.01), (sum(x) / 2, sum(z) / 2), z[1] - z[0]
    if how == "frames":
        return [prism(rectangle(*inner, 0.35 * rim), "y", deep)]
    if how == "diamonds":
        a, c = (inner[0][1] - inner[0][0]) / 2, (inner[1][1] - inner[1][0]) / 2
        plate = [(mid[0] - a, mid[1]), (mid[0], mid[1] - c), (mid[0] + a, mid[1]), (mid[0], mid[1] + c)]
        return [prism(plate, "y", deep), ball((mid[0], y - t, mid[1]), (0.3 * rim, t, 0.3 * rim), 8)]
    if how == "arches":
        shape = arch(*inner, min(0.5 * (inner[0][1] - inner[0][0]), 0.6 * height))
        return [prism(shape.difference(shape.buffer(-0.4 * rim)), "y", deep)]
    if how == "pilasters":
        column = (mid[0] - 0.5 * rim, mid[0] + 0.5 * rim)
        ends = [box(shrunk(column, -0.3 * rim), (y - 1.6 * t, y + 0.01), e) for e in ((z[0], z[0] + rim), (z[1] - rim, z[1]))]
        return [box(column, deep, z), *ends]
    plate = box(shrunk(x, 0.1 * rim), (y - 0.5 * t, y + 0.01), shrunk(z, 0.1 * rim))
    heads = [(a, c) for a in shrunk(x, 0.6 * rim) for c in shrunk(z, 0.6 * rim)]
    return [plate, *(rod((a, y - t, c), (a, y, c), 0.2 * rim, 6) for a, c in heads)]


def clad(m: Model, x: Span, y: float, z: Span, how: str, bays: int) -> None:
    """Face an upright front at y with fixed pieces, in a number of bays."""
    wide, t = (x[1] - x[0]) / bays, m.number(0.012, 0.03)
    height = z[1] - z[0]
    rim = min(wide, height) * m.number(0.08, 0.15)
    if how == "none":
        return
    if how in ("planks", "reeds"):
        edges = np.linspace(*x, bays * m.pick(2, 3, 4) + 1)
        for a, b in pairwise(edges):
            if how == "planks":
                m.add(BASE, box((a + 0.003, b - 0.003), (y - t, y + 0.01), z))
            else:
                m.add(BASE, rod(((a + b) / 2, y, z[0]), ((a + b) / 2, y, z[1]), 0.45 * (b - a), 10))
    elif how == "boards":
        step = m.pick(0.0, 0.004, 0.01)
        m.add(BASE, *(box(x, (y - t, y + 0.01), (a + step, b)) for a, b in pairwise(np.linspace(*z, m.pick(4, 6, 8)))))
    elif how in ("tiles", "stones"):
        size = wide / m.pick(1, 2), height / m.pick(2, 3, 4)
        lay = courses(m, x, (y - t, y), z, size, 0.004)
        m.add(BASE, *lay[:60])
    else:
        for a, b in pairwise(np.linspace(*x, bays + 1)):
            m.add(BASE, *_bay(how, (a, b), y, z, rim, t))


def moulding(x: Span, y: Span, z: Span, steps: int, out: float) -> list[Trimesh]:
    """Stack slabs that step out towards the top on the front and both sides."""
    levels = np.linspace(*z, steps + 1)
    return [
        box(shrunk(x, -out * (k + 1) / steps), (y[0] - out * (k + 1) / steps, y[1]), span)
        for k, span in enumerate(pairwise(levels))
    ]


def thing(m: Model, at: tuple[float, float, float], size: float) -> None:
    """Stand one thing on a ledge: a vase, a bowl, books, a jar, a candle, a block or fruit."""
    how, n = m.pick(*"vase bowl books jar candle block fruit sign".split()), m.sections()
    if how == "vase":
        u = np.linspace(0, 1, 9)
        m.add(BASE, lathe([(0, 0), *np.c_[size * (0.3 + 0.13 * np.sin(5.5 * u)), u * size], (0, size)], n, at))
    elif how == "bowl":
        m.add(
            BASE, lathe([(0, 0), (0.3, 0), (0.7, 0.35), (0.65, 0.35), (0.27, 0.04), (0, 0.04)], n, (0, 0, 0)).apply_scale(size)
        )
        moved(m.pieces[-1][1], at)
    elif how == "books":
        for k in range(m.pick(1, 2, 4)):
            low = at[2] + 0.12 * size * k
            m.add(
                BASE,
                box(
                    (at[0] - 0.4 * size, at[0] + m.number(0.3, 0.5) * size),
                    (at[1] - 0.3 * size, at[1] + 0.3 * size),
                    (low, low + 0.12 * size),
                ),
            )
    elif how in ("jar", "candle"):
        r = (0.35 if how == "jar" else 0.12) * size
        m.add(
            BASE,
            rod(at, (at[0], at[1], at[2] + size), r, n),
            ring((at[0], at[1], at[2] + 0.03 * size), (0, 0, 1), r, 0.04 * size),
        )
    elif how == "block":
        m.add(
            BASE,
            box(
                (at[0] - 0.4 * size, at[0] + 0.4 * size), (at[1] - 0.3 * size, at[1] + 0.3 * size), (at[2], at[2] + 0.8 * size)
            ),
        )
    elif how == "fruit":
        r = 0.25 * size
        m.add(
            BASE,
            *(ball((at[0] + a * r, at[1] + b * r, at[2] + 0.95 * r), (r,) * 3, 10) for a, b in ((-1, 0), (1, 0), (0, 1.6))),
        )
    else:
        m.add(
            BASE,
            box((at[0] - 0.3 * size, at[0] + 0.3 * size), (at[1] - 0.02 * size, at[1] + 0.02 * size), (at[2], at[2] + size)),
        )


def things(m: Model, x: Span, y: Span, top: float, count: int, size: float) -> None:
    """Stand a row of things on a ledge."""
    for a in np.linspace(*x, 2 * count + 1)[1::2]:
        thing(m, (float(a), m.number(*y), top), min(size, 0.9 * (x[1] - x[0]) / max(count, 1)) * m.number(0.5, 1.0))


def maybe_one(m: Model, share: float) -> None:
    """Unite all closed pieces into one solid now and then, as printed and exported objects come."""
    if m.chance(share):
        fuse(m, BASE)
