"""Corner sofas, plain desks and benches with stools of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.furniture.still_beds import drape, feet
from training.kinds.furniture.still_seats import repeat, sizes, smooth
from training.kinds.furniture.still_upholstery import arm, soft
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rectangle, rod, rounded, tube
from training.kinds.still_cladding import FACINGS, clad, maybe_one, thing, things
from training.kinds.wheels import beam, lathe


def sofa_corner_group(m: Model) -> None:
    """Make a corner sofa of two runs with backs, arms, cushions, perhaps a table, a pouffe, a rug and things; nothing moves."""
    deep, seat, high, t = sizes(m, (0.75, 1.0), (0.36, 0.45), (0.65, 0.95), (0.12, 0.25))
    one, two, low = m.pick(2, 3, 3, 4), m.pick(1, 2, 2, 3), m.pick(0.02, m.number(0.06, 0.18))
    each, how, back = (
        m.number(0.6, 0.8),
        m.pick("piped", "swollen", "round", "plain"),
        m.pick("block", "pads", "pads", "pillows", "low"),
    )
    x, thick, kind = (0.0, deep + one * each), m.number(0.1, 0.2), m.pick("roll", "slope", "block", "pad", "none")
    side, near = (0.0, deep), -deep - two * each
    base = seat - thick
    m.add(BASE, box(x, (-deep, 0), (low, base)), box(side, (near, -deep + 0.001), (low, base)))
    top = {"low": seat + 0.15, "block": high}.get(back, high - 0.12)
    m.add(BASE, box(x, (-t, 0), (base - 0.01, top)), box((0, t), (near, -t), (base - 0.01, top)))
    cells = [((deep + k * each, deep + (k + 1) * each), (-deep, -t)) for k in range(one)]
    cells += [((t, deep), (-deep - (k + 1) * each, -deep - k * each)) for k in range(two)]
    cells.append(((t, deep), (-deep, -t)))
    for k, (a, b) in enumerate(cells):
        m.add(BASE, *soft(m, shrunk(a, 0.005), shrunk(b, 0.005), (base - 0.001, seat), how))
        if back == "block" or k == len(cells) - 1:
            continue
        tall = (seat - 0.01, seat + m.number(0.3, 0.4)) if back == "pillows" else (seat - 0.01, high)
        pad = (shrunk(a, 0.01), (-t - 0.16, -t + 0.01)) if k < one else ((t - 0.01, t + 0.16), shrunk(b, 0.01))
        m.add(BASE, *soft(m, *pad, tall, "round" if back == "pillows" else how))
    elbow = seat + m.number(0.1, 0.22)
    if kind != "none":
        arm(m, (x[1], x[1] + m.number(0.1, 0.22)), (-deep, 0), (low, elbow), kind)
        m.add(BASE, *[box((0, deep), (near - m.number(0.08, 0.2), near), (low, elbow))][: m.pick(0, 1, 1)])
    if low > 0.03:
        feet(m, shrunk(x, 0.06), (-deep + 0.06, -0.06), low + 0.005, 0.04)
        feet(m, shrunk(side, 0.06), (near + 0.06, -deep - 0.1), low + 0.005, 0.04)
    table, size = (deep + 0.35 * one * each, -deep - 0.45 * two * each - 0.15), m.number(0.25, 0.45)
    spot = (table[0] - size, table[0] + size), (table[1] - 0.7 * size, table[1] + 0.7 * size)
    extra = m.pick("table", "pouffe", "rug", "rug table", "none")
    if "rug" in extra:
        m.add(BASE, box((-0.1, x[1] + 0.3), (near - 0.3, 0.1), (-0.012, 0.003)))
    if "table" in extra:
        m.add(
            BASE,
            prism(rounded(*spot, m.pick(0.01, 0.1)), "z", (0.36, 0.4)),
            box(shrunk(spot[0], 0.1), shrunk(spot[1], 0.06), (m.pick(0.0, 0.3), 0.36)),
        )
        feet(m, shrunk(spot[0], 0.12), shrunk(spot[1], 0.08), 0.365, 0.04)
        thing(m, (*table, 0.4), 0.2)
    elif extra == "pouffe":
        m.add(BASE, *soft(m, *spot, (0.02, seat), how), box(shrunk(spot[0], 0.03), shrunk(spot[1], 0.03), (0, 0.1)))
    if m.chance(0.3):
        m.add(BASE, drape(m, shrunk(cells[0][0], 0.1), (-deep, -t - 0.2), (base, seat), 0.01))


def _support(m: Model, at: float, y: Span, top: float, how: str, t: float) -> None:
    """Make one end of a desk: a slab, a frame, a trestle, a pair of legs, an X or a solid block."""
    mid = (y[0] + y[1]) / 2
    if how == "slab":
        m.add(BASE, box((at - t, at + t), y, (0, top)))
    elif how == "frame":
        m.add(BASE, prism(rectangle(y, (0, top), 2 * t), "x", (at - t, at + t)))
    elif how == "trestle":
        m.add(
            BASE,
            *(beam((at + s * 0.03, mid, top), (at + s * 0.15, b, 0), 0.04, 0.03) for b in shrunk(y, 0.02) for s in (-1, 1)),
        )
        m.add(
            BASE,
            box((at - 0.06, at + 0.06), y, (top - 0.05, top)),
            box((at - 0.11, at + 0.11), shrunk(y, 0.17 * (y[1] - y[0])), (0.3 * top, 0.3 * top + 0.03)),
        )
    elif how == "cross":
        m.add(BASE, *(beam((at, a, 0), (at, b, top), 2 * t, 0.05) for a, b in (y, y[::-1])))
        m.add(BASE, box((at - t, at + t), y, (top - 0.03, top)))
    elif how == "tee":
        m.add(
            BASE,
            box((at - 0.04, at + 0.04), (mid - 0.05, mid + 0.05), (0, top)),
            box((at - 0.04, at + 0.04), shrunk(y, 0.02), (0, 0.03)),
        )
        m.add(BASE, box((at - 0.03, at + 0.03), shrunk(y, 0.05), (top - 0.03, top)))
    elif how == "hairpin":
        for b in shrunk(y, 0.08):
            m.add(
                BASE,
                *(rod((at + s, b, top), (at, b, 0), 0.006, 6) for s in (-0.05, 0, 0.05)),
                box((at - 0.06, at + 0.06), (b - 0.05, b + 0.05), (top - 0.006, top)),
            )
    else:
        m.add(BASE, *(rod((at, b, 0), (at, b, top), 1.2 * t, m.sections()) for b in shrunk(y, 0.05)))


def desk_plain(m: Model) -> None:
    """Make a desk without drawers: a top on ends, trestles or legs, a back panel, open shelves, a ledge; nothing moves."""
    wide, deep, high, t = sizes(m, (0.9, 2.2), (0.5, 0.9), (0.68, 0.78), (0.015, 0.05))
    x, y, top = (-wide / 2, wide / 2), (-deep / 2, deep / 2), high - t
    how = m.pick("slab", "frame", "trestle", "cross", "tee", "hairpin", "legs", "slab")
    shape = m.pick("plain", "round", "bay", "ell")
    inset = m.pick(0.02, 0.12) + (0.1 if how in ("trestle", "hairpin") else 0)
    if shape == "ell":
        reach = m.number(0.4, 0.9)
        m.add(BASE, box((x[0], x[0] + 0.6 * deep + 0.1), (y[0] - reach, y[0]), (top, high)))
        m.add(BASE, box((x[0] + 0.02, x[0] + 0.6 * deep), (y[0] - reach + 0.02, y[0] - reach + 0.06), (0, top + 0.001)))
    a = np.linspace(*x, 13)
    bay = [*np.c_[a, y[0] + 0.2 * deep * np.exp(-((3 * a / wide) ** 2))], (x[1], y[1]), (x[0], y[1])]
    m.add(BASE, prism({"round": rounded(x, y, 0.06), "bay": bay}.get(shape, rectangle(x, y)), "z", (top, high)))
    for at in shrunk(x, inset + t):
        _support(m, at, shrunk(y, 0.03), top + 0.001, how, t)
    if how not in ("trestle", "hairpin", "cross") or m.chance(0.3):
        panel = m.pick(0, 0.4, 0.9) * high
        inner = shrunk(x, inset + t)
        if panel:
            m.add(BASE, box(inner, (y[1] - 0.06, y[1] - 0.04), (high - panel, top + 0.001)))
        else:
            m.add(BASE, *(box(inner, (b - 0.015, b + 0.015), (top - 0.08, top + 0.001)) for b in shrunk(y, 0.08)))
    if how == "slab" and m.chance(0.5):
        b = x[1] - inset - m.number(0.25, 0.4)
        m.add(BASE, box((b - 0.01, b + 0.01), shrunk(y, 0.03), (0, top + 0.001)))
        m.add(
            BASE,
            *(box((b, x[1] - inset - t), shrunk(y, 0.03), (c, c + 0.02)) for c in np.linspace(0.08, 0.6 * high, m.pick(2, 3))),
        )
        things(m, (b + 0.03, x[1] - inset - 2 * t), (0, 0), 0.1, 1, 0.15)
    if m.chance(0.35):
        up, d = m.number(0.2, 0.5), m.number(0.15, 0.25)
        cuts = np.linspace(*shrunk(x, 0.02), m.pick(2, 3, 5))
        m.add(
            BASE,
            box(shrunk(x, 0.01), (y[1] - d, y[1]), (high + up, high + up + 0.02)),
            *(box((c - 0.01, c + 0.01), (y[1] - d, y[1]), (high - 0.001, high + up + 0.001)) for c in cuts),
        )
        m.add(BASE, *[box(shrunk(x, 0.01), (y[1] - 0.01, y[1]), (high, high + up))][: m.pick(0, 1)])
        things(m, x, (y[1] - d / 2, y[1] - d / 2), high + up + 0.02, m.pick(0, 1, 3), 0.18)
    elif m.chance(0.4):
        m.add(
            BASE, *(box(s, (y[1] - 0.02, y[1]), (high - 0.001, high + 0.35)) for s in pairwise(np.linspace(*x, m.pick(2, 3))))
        )
    things(m, shrunk(x, 0.15), (-0.1 * deep, 0.05 * deep), high, m.pick(0, 1, 2, 4), 0.2)
    if m.chance(0.4):
        m.add(BASE, box((-0.25, 0.25), (-0.35 * deep, -0.1 * deep), (high - 0.001, high + 0.004)))
    maybe_one(m, 0.12)


def _bench(m: Model, wide: float, deep: float, high: float, how: str) -> None:
    """Make a backless bench: planks or a pad on slabs, legs, an X, a block or a bent loop."""
    x, y, t = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.02, 0.05)
    low = high - t
    planks = m.pick(1, 1, 2, 3)
    edges = np.linspace(*y, planks + 1)
    m.add(BASE, *(box(x, (a + 0.003 * (planks > 1), b - 0.003 * (planks > 1)), (low, high)) for a, b in pairwise(edges)))
    if planks > 1:
        m.add(BASE, *(box((a - 0.03, a + 0.03), shrunk(y, 0.005), (low - 0.02, low + 0.001)) for a in shrunk(x, 0.12 * wide)))
    if how == "block":
        m.add(BASE, box(shrunk(x, 0.04), shrunk(y, 0.03), (0, low + 0.001)))
        clad(m, shrunk(x, 0.04), y[0] + 0.03, (0.03, low - 0.02), m.pick(*FACINGS), m.pick(1, 2, 3))
    elif how == "loop":
        for a in shrunk(x, 0.12 * wide):
            m.add(
                BASE,
                tube([(a, y[0] + 0.02, low), (a, y[0] + 0.02, 0.012), (a, y[1] - 0.02, 0.012), (a, y[1] - 0.02, low)], 0.012),
            )
    else:
        for a in shrunk(x, 0.12 * wide):
            _support(m, a, shrunk(y, 0.02), low + 0.001, how, 0.02)
        m.add(
            BASE,
            *[box(shrunk(x, 0.12 * wide), (-0.02, 0.02), (0.4 * low, 0.4 * low + 0.06))][
                : how in ("slab", "cross") and m.pick(0, 1)
            ],
        )
    if m.chance(0.4):
        m.add(BASE, *soft(m, shrunk(x, 0.01), shrunk(y, 0.01), (high - 0.001, high + 0.05), m.pick("piped", "round", "plain")))


def _seat(m: Model, r: float, high: float, how: str) -> None:
    """Make a stool to go with a bench: round or square on legs, a block, a waisted drum or a loop."""
    x, t, n = (-r, r), m.number(0.02, 0.05), m.sections()
    low = high - t
    if how == "block":
        m.add(
            BASE, lathe([(0, 0), (0.9 * r, 0), (m.number(0.5, 0.9) * r, high / 2), (0.9 * r, low + 0.001), (0, low + 0.001)], n)
        )
    elif how == "loop":
        m.add(
            BASE,
            *(
                tube(smooth([(-0.8 * r, b, low), (-0.8 * r, b, 0.012), (0.8 * r, b, 0.012), (0.8 * r, b, low)]), 0.01)
                for b in (-0.6 * r, 0.6 * r)
            ),
        )
    elif how in ("slab", "cross"):
        for a in shrunk(x, 0.25 * r):
            _support(m, a, shrunk(x, 0.1 * r), low + 0.001, how, 0.015)
    else:
        feet(m, (-0.6 * r, 0.6 * r), (-0.6 * r, 0.6 * r), low + 0.001, 0.035)
    m.add(
        BASE, rod((0, 0, low), (0, 0, high), r, max(n, 12)) if m.chance(0.5) else prism(rounded(x, x, 0.04), "z", (low, high))
    )


def stool_and_bench_group(m: Model) -> None:
    """Make benches and stools that stand together, round a table, in a row or upside down on each other; nothing moves."""
    wide, deep, high, r = sizes(m, (0.9, 1.8), (0.28, 0.45), (0.4, 0.48), (0.16, 0.22))
    how, form = (
        m.pick("slab", "frame", "cross", "legs", "block", "loop", "trestle"),
        m.pick("table", "row", "face", "corner", "stack"),
    )
    away = m.number(0.5, 0.8)
    benches = {
        "table": [((0, -away, 0), 0), ((0, away, 0), 0)],
        "face": [((0, -away, 0), 0), ((0, away, 0), 180)],
        "corner": [((0, 0, 0), 0), ((-wide / 2 + deep / 2, -wide / 2 - deep / 2 - 0.02, 0), 90)],
    }.get(form, [((0, 0, 0), 0)])
    repeat(m, lambda one: _bench(one, wide, deep, high, how), benches[: m.pick(1, 2, 2)])
    count = m.pick(1, 2, 3)
    if form in ("table", "face"):
        spots = [((s * (wide / 2 + r + 0.1), 0, 0), 90) for s in (-1, 1)][:count]
    elif form == "stack":
        spots = [((a, 0, 1.85 * high), 180) for a in np.linspace(-wide / 2 + r, wide / 2 - r, min(count, 2))]
    else:
        spots = [((wide / 2 + r + 0.1 + k * (2 * r + 0.1), m.number(-0.1, 0.1), 0), m.number(0, 45)) for k in range(count)]
    tall = m.pick(high, 0.8 * high, 1.5 * high) if form != "stack" else 0.85 * high
    repeat(m, lambda one: _seat(one, r, tall, how), spots, (1, 0, 0) if form == "stack" else (0, 0, 1))
    if form == "table":
        top, half = m.number(0.7, 0.76), away - deep / 2
        m.add(BASE, box((-wide / 2, wide / 2), (-half, half), (top - 0.04, top)))
        for a in (-0.35 * wide, 0.35 * wide):
            _support(m, a, (-0.8 * half, 0.8 * half), top - 0.039, how if how not in ("block", "loop") else "frame", 0.03)
        things(m, (-0.3 * wide, 0.3 * wide), (-0.05, 0.05), top, m.pick(0, 1, 3), 0.2)
    if m.chance(0.4):
        points = np.concatenate([s.bounds for _, s in m.pieces])
        low, up = points.min(0) - 0.2, points.max(0) + 0.2
        m.add(BASE, box((low[0], up[0]), (low[1], up[1]), (-0.02, 0.001)))
