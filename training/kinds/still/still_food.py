"""Food and drink on the table, modelled in pieces of which none moves: cakes, fruit, burgers, bottles, tea sets."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import trimesh
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.clay import Clay, curve, skin
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, cut, loft, moved, prism, ring, rod, rounded, turned, vec
from training.kinds.wheels import lathe


def _around(count: int, r: float, z: float) -> list[Float[np.ndarray, " 3"]]:
    """Points on a level circle about the z axis."""
    return [vec(r * np.cos(t), r * np.sin(t), z) for t in 0.4 + 2 * np.pi * np.arange(count) / max(count, 1)]


def _dish(r: float, high: float, foot: float, n: int, at: Point = (0, 0, 0), thick: float = 0.004) -> Trimesh:
    """A plate, bowl or cup, open above."""
    bend, t = 0.75 * r + 0.25 * foot, thick
    inside = [(r - t, high), (bend - t, 0.4 * high + t), (0.9 * foot, t), (0, t)]
    return lathe([(0, 0), (foot, 0), (bend, 0.4 * high), (r, high), *inside], n, at)


def _tier(m: Model, r: float, z: float, high: float, n: int) -> list[Trimesh]:
    """A cake of layers, with icing that drips and a border of cream."""
    levels, square = np.linspace(z, z + high, m.pick(2, 2, 4, 6)), m.chance(0.2)
    solids = [rod((0, 0, a), (0, 0, b), r * m.pick(1, 0.98), n) for a, b in pairwise(levels)]
    if square:
        return [box((-0.75 * r, 0.75 * r), (-0.75 * r, 0.75 * r), z) for z in pairwise(levels)]
    for q in _around(m.pick(0, 12, 20), 1.02 * r, z + high):
        solids.append(skin([q, q - vec(0, 0, m.number(0.2, 0.8) * high)], [0.006, 0.008], 6))
    size, cream = m.number(0.006, 0.014), m.pick("cones", "rope", "none")
    if cream == "rope":
        solids += [ring((0, 0, a), (0, 0, 1), r, 0.6 * size, n) for a in (z + 0.4 * size, z + high)]
    for q in _around(int(5 * r / size), r, z) if cream == "cones" else ():
        solids.append(lathe([(0, 0), (size, 0), (0, 2 * size)], 6, q))
    return [*solids, rod((0, 0, z + high - 0.004), (0, 0, z + high + 0.006), 1.02 * r, n)]


def cake_stand_cake(m: Model) -> None:
    """A cake or cupcakes on a stand or a plate, with icing, cream, candles and berries; nothing moves."""
    n, r, high, size = m.pick(16, 24, 32), m.number(0.1, 0.16), m.pick(0.012, m.number(0.06, 0.15)), m.number(0.008, 0.014)
    z = high
    if z > 0.02:
        m.add(BASE, lathe([(0, 0), (0.6 * r, 0), (0.15 * r, 0.2 * z), (0.1 * r, 0.7 * z), (0.3 * r, z), (0, z)], n))
    m.add(
        BASE, rod((0, 0, z - 0.012), (0, 0, z), 1.3 * r, n) if m.chance(0.7) else _dish(1.5 * r, 0.02, r, n, (0, 0, z - 0.012))
    )
    for q in [vec(0, 0, z), *_around(m.pick(5, 6), 0.85 * r, z)] if m.chance(0.25) else ():
        swirl = [(0, 0.38), (0.33, 0.38), (0.33, 0.5), (0.22, 0.55), (0.24, 0.65), (0.1, 0.7), (0, 0.85)]
        m.add(BASE, lathe([(0, 0), (0.2 * r, 0), (0.28 * r, 0.4 * r), (0, 0.4 * r)], 10, q), lathe(r * np.array(swirl), 10, q))
        m.add(BASE, ball(q + vec(0, 0, 0.85 * r), (0.08 * r,) * 3, 8))
    if len(m.pieces) > 5:
        return
    wedge = prism([(0, 0), (1, -m.number(1, 2.5)), (-0.6, -2)], "z", (0, 1)) if m.chance(0.25) else None
    for _ in range(m.pick(1, 1, 2, 3)):
        high = m.number(0.05, 0.12)
        solids = [cut(s, wedge) if wedge and s.is_watertight else s for s in _tier(m, r, z, high, n)]
        m.add(BASE, *(s for s in solids if len(s.faces)))
        z, r = z + high, m.number(0.6, 0.75) * r
    what = "none" if wedge else m.pick("candles", "berries", "dollops", "none")
    for q in _around(m.pick(3, 6, 9), r, z + 0.004) if what != "none" else ():
        m.add(BASE, lathe(size * np.array([(0, 0), (1.4, 0), (1.2, 0.5), (0.6, 0.9), (0, 1.6)]), 8, q))
        if what == "candles":
            m.add(BASE, rod(q, q + vec(0, 0, 0.07), 0.004, 8), ball(q + vec(0, 0, 0.075), (0.003, 0.003, 0.009), 6))
        elif what == "berries":
            m.add(BASE, ball(q + vec(0, 0, 1.6 * size), (0.8 * size,) * 3, 8))


def _fruit(m: Model, kind: str, at: Point, r: float, n: int) -> None:
    """A piece of fruit about a point."""
    stem = skin(r * curve((0, 0, 0.5), (0, 0, 1.1), (0.2, 0, 1.3), 4), [0.06 * r] * 4, 5)
    apple = [(0, -0.7), (0.4, -0.9), (0.85, -0.5), (1, 0.1), (0.8, 0.7), (0.4, 0.85), (0, 0.6)]
    if kind == "banana":
        bow = r * curve((-1.8, 0, 0.3), (0, 0, -1.2), (1.8, 0, 0.3), 8)
        solids = [skin(bow, np.array([0.12, 0.3, 0.42, 0.48, 0.48, 0.42, 0.3, 0.15]) * r, m.pick(5, 8))]
        solids += [moved(solids[0].copy(), (0, 0.7 * r * k, 0.1 * r * k)) for k in range(1, m.pick(1, 3))]
    elif kind == "grapes":
        spots = m.rng.uniform(-1, 1, size=(m.pick(12, 20), 3)) * (r, 0.6 * r, 0.5 * r)
        solids = [*(ball(q, (0.32 * r,) * 3, 7) for q in spots), stem]
    elif kind in ("orange", "lemon"):
        solids = [ball((0, 0, 0), (r, r, r) if kind == "orange" else (0.75 * r, 0.75 * r, r), n)]
        solids += [ball((0, 0, s * r), (0.2 * r,) * 3, 6) for s in (-1, 1)[: m.pick(0, 1, 2)]]
    else:
        pear = [(0, -0.9), (0.6, -0.9), (1, -0.3), (0.85, 0.3), (0.45, 0.7), (0.3, 0.95), (0, 1)]
        solids = [lathe(r * np.array(pear if kind == "pear" else apple), n), stem]
        if m.chance(0.4):
            leaf = np.array([(0.1, 0.03), (0.25, 0.03), (0.05, 0.03)]) * r
            solids.append(skin(r * np.array([(0, 0, 0.9), (0.4, 0, 1.1), (0.9, 0, 1.1)]), leaf, 6))
    axis, by = m.rng.normal(size=3), m.number(0, 60)
    m.add(BASE, *(moved(turned(s, axis, by, (0, 0, 0)), at) for s in solids))


def fruit_bowl(m: Model) -> None:
    """Fruit heaped in a bowl, in a basket or on a board; nothing moves."""
    n, r, high, how = m.pick(10, 14, 16), m.number(0.12, 0.18), m.number(0.05, 0.1), m.pick("bowl", "bowl", "basket", "board")
    if how == "bowl":
        m.add(BASE, _dish(1.1 * r, high, m.number(0.4, 0.7) * r, n + 8))
    elif how == "basket":
        m.add(BASE, *(ring((0, 0, z), (0, 0, 1), (0.8 + 3 * z) * r, 0.007, n) for z in np.arange(0.007, high, 0.016)))
        m.add(BASE, *(rod(0.75 * q, 1.1 * q + vec(0, 0, high), 0.004, 6) for q in _around(n, r, 0.005)))
    if how != "bowl" or m.chance(0.4):
        m.add(BASE, rod((0, 0, 0), (0, 0, 0.01), (1.3 if how == "board" else 0.8) * r, n))
    every, size = ("apple", "pear", "orange", "lemon", "banana", "grapes"), 0.34 * r
    kinds = every if m.chance(0.8) else (m.pick(*every[:4]),)
    for count, away, up in ((5, 0.6, 0), (1, 0, 0.3), (3, 0.35, 1.3), (1, 0, 2.2))[: m.pick(1, 2, 3, 4)]:
        for q in _around(count, away * r, 0.015 + (up + 1) * size):
            _fruit(m, m.pick(*kinds), q, size * m.number(0.85, 1.1), n)
    Clay(m, "round", n).done(1.0, 0)


def _burger(m: Model, r: float, z: float, n: int) -> None:
    """A bun with layers of patty, cheese, salad, tomato and onion, perhaps sesame and a pick."""
    m.add(BASE, lathe([(0, z), (0.9 * r, z), (r, z + 0.008), (r, z + 0.018), (0, z + 0.02)], n))
    z += 0.02
    for what in m.rng.permutation(["patty", "cheese", "leaf", "tomato", "onion", "patty"])[: m.pick(2, 4, 6)]:
        if what == "patty":
            m.add(BASE, lathe([(0, z), (0.95 * r, z), (1.03 * r, z + 0.008), (0.95 * r, z + 0.016), (0, z + 0.016)], n))
        elif what == "cheese":
            square = box((-0.85 * r, 0.85 * r), (-0.85 * r, 0.85 * r), (z, z + 0.003))
            m.add(BASE, turned(square, (0, 0, 1), m.number(0, 90), (0, 0, 0)))
        elif what == "leaf":
            edge = (
                np.array(_around(36, 1.1 * r, z)) + np.c_[np.zeros((36, 2)), 0.005 * np.sin(np.arange(36) * m.pick(1.2, 1.6))]
            )
            m.add(BASE, loft(np.array([edge * (0.6, 0.6, 0) + vec(0, 0, z), edge, edge + vec(0, 0, 0.002)])))
        else:
            slices = (rod(q, q + vec(0, 0, 0.006), 0.5 * r, 14) for q in _around(3, 0.45 * r, z))
            rings = (ring(q, (0, 0, 1), 0.4 * r, 0.003, 14) for q in _around(3, 0.45 * r, z + 0.002))
            m.add(BASE, *(slices if what == "tomato" else rings))
        z += {"patty": 0.016, "tomato": 0.006}.get(what, 0.004)
    m.add(BASE, lathe([(0, z), (r, z), (1.02 * r, z + 0.012), (0.8 * r, z + 0.03), (0.4 * r, z + 0.04), (0, z + 0.042)], n))
    m.add(BASE, *(ball(q, (0.003, 0.002, 0.0015), 6) for q in _around(m.pick(0, 9, 14), 0.6 * r, z + 0.036)))
    if m.chance(0.3):
        m.add(BASE, rod((0, 0, z), (0, 0, z + 0.09), 0.001, 6), box((0, 0.025), (-0.0005, 0.0005), (z + 0.07, z + 0.088)))


def burger_plate(m: Model) -> None:
    """A burger on a plate, board or tray with chips, a bowl of sauce and gherkins; nothing moves."""
    n, how, a, b = m.pick(12, 16, 24), m.pick("plate", "board", "tray"), m.number(0.12, 0.16), m.number(0.09, 0.13)
    outline = rounded((-a, a), (-b, b), 0.02)
    _burger(m, m.number(0.045, 0.06), 0.004, n)
    for _, s in m.pieces:
        s.apply_translation((0.06 - a, 0, 0))
    m.add(BASE, _dish(a, 0.018, 0.6 * a, n + 8) if how == "plate" else prism(outline, "z", (-0.01, 0.004)))
    if how == "tray":
        m.add(BASE, prism(outline.exterior.buffer(0.004), "z", (-0.01, 0.015)))
    for k in range(m.pick(0, 10, 18, 26)):
        w, long = m.number(0.004, 0.006), m.number(0.025, 0.04)
        chip = turned(box((-long, long), (-w, w), (-w, w)), (m.number(-0.3, 0.3), 0, 1), m.number(0, 180), (0, 0, 0))
        m.add(BASE, moved(chip, (0.45 * a + m.number(-0.02, 0.02), m.number(-0.4, 0.4) * b, 0.012 + 0.0015 * k)))
    at = vec(0.3 * a, 0.65 * b, 0.004)
    if m.chance(0.5):
        m.add(BASE, _dish(0.025, 0.02, 0.02, n, at, 0.002), rod(at + vec(0, 0, 0.003), at + vec(0, 0, 0.015), 0.0205, n))
    for q in _around(m.pick(0, 2, 3), 0.02, 0.004):
        m.add(BASE, rod(q + vec(0.3 * a, -0.65 * b, 0), q + vec(0.3 * a, -0.65 * b, 0.006), 0.016, 12))
    Clay(m, "round", n).done(1.0, 0)


def _bottle(m: Model, at: Point, high: float, n: int) -> None:
    """An open bottle with a lip, a label and bands, a handle, or a candle or stems in its neck."""
    r, form, top = high * m.number(0.13, 0.2), m.pick("wine", "hock", "flask", "square", "jug"), at + vec(0, 0, high)
    shape = {"hock": [(1, 0.45), (0.7, 0.65)], "flask": [(1.3, 0.25), (0.4, 0.6)], "jug": [(1.2, 0.3), (0.5, 0.75)]}
    body = [(0, 0), (0.95, 0), (1, 0.03), *shape.get(form, [(1, 0.6), (0.85, 0.67), (0.45, 0.73)])]
    outline = np.array([*body, (0.32, 0.78), (0.3, 1.0), (0.2, 1.0), (0.2, 0.75), (0, 0.7)]) * (r, high)
    m.add(
        BASE, trimesh.creation.revolve(outline, sections=4).apply_translation(at) if form == "square" else lathe(outline, n, at)
    )
    m.add(BASE, *(ring(at + vec(0, 0, k * high), (0, 0, 1), 0.3 * r, 0.07 * r, 14) for k in m.pick((), (0.98,), (0.98, 0.93))))
    for low, end, wide in ((0.1, m.number(0.25, 0.42), 1.01), (0.84, 0.9, 0.35))[: m.pick(0, 1, 2)]:
        if form in ("wine", "hock"):
            m.add(BASE, rod(at + vec(0, 0, low * high), at + vec(0, 0, end * high), wide * r, n))
    if form == "jug":
        bow = curve((0.9 * r, 0, 0.6 * high), (1.8 * r, 0, 0.85 * high), (0.3 * r, 0, 0.92 * high), 8)
        m.add(BASE, moved(skin(bow, [0.1 * r] * 8, 8), at))
    stuck = m.pick("candle", "stems", "none", "none", "none")
    if stuck == "candle":
        m.add(BASE, rod(top - vec(0, 0, 0.05), top + vec(0, 0, 0.1), 0.25 * r, 10))
        m.add(
            BASE,
            *(skin([q, q - vec(0, 0, m.number(0.02, 0.06))], [0.1 * r] * 2, 6) for q in np.array(_around(5, 0.3 * r, 0)) + top),
        )
    for q in _around(m.pick(3, 5), m.number(0.04, 0.1), m.number(0.1, 0.2)) if stuck == "stems" else ():
        m.add(BASE, skin(top + curve((0, 0, -0.08), (0, 0, 0.05), q), [0.002] * 6, 5), ball(top + q, (0.012, 0.012, 0.02), 8))


def bottle_group(m: Model) -> None:
    """One to six open bottles and jugs, alone, on a tray or in a crate of slats; nothing moves."""
    count, n, like, seed = m.pick(1, 2, 3, 4, 6), m.pick(12, 16, 24), m.chance(0.4), int(m.rng.integers(1 << 30))
    gap, columns, how = m.number(0.14, 0.17), m.pick(2, 3), m.pick("none", "tray", "crate")
    for k in range(count):
        one = Model(np.random.default_rng(seed + k * (not like)))
        _bottle(one, vec(gap * (k % columns), gap * (k // columns), 0), one.number(0.18, 0.36), n)
        m.pieces += one.pieces
    x, y = (-0.1, gap * (columns - 1) + 0.1), (-0.1, gap * ((count - 1) // columns) + 0.1)
    if how != "none":
        m.add(BASE, box(x, y, (-0.012, 0.002)))
    for z in {"crate": (0.02, 0.08), "tray": (-0.012,)}.get(how, ()):
        m.add(BASE, *(box(x, (b - 0.006, b + 0.006), (z, z + 0.04)) for b in y))
        m.add(BASE, *(box((a - 0.006, a + 0.006), y, (z, z + 0.04)) for a in x))
    m.add(BASE, *(box((a - 0.01, a + 0.01), (b - 0.01, b + 0.01), (-0.012, 0.14)) for a in x for b in y if how == "crate"))
    Clay(m, "round", n).done(1.0, 0)


def _cup(m: Model, at: Point, r: float, high: float, n: int, look: int) -> None:
    """A cup with a handle, perhaps on a saucer, with tea and a spoon."""
    one, turn = Model(np.random.default_rng(look)), m.number(0, 360)
    foot, wide, w, saucer = one.number(0.5, 0.9) * r, one.number(1.8, 2.4) * r, one.number(0.003, 0.005), one.chance(0.8)
    up = 0.006 * saucer
    bow = curve((0.9 * r, 0, up + 0.8 * high), (wide, 0, up + 0.7 * high), (0.8 * r, 0, up + 0.25 * high), 8)
    solids = [_dish(r, high, foot, n, (0, 0, up), 0.002), skin(bow, [(w, 0.7 * w)] * 8, 6)]
    if saucer:
        solids.append(_dish(1.8 * r, 0.012, r, n))
    if m.chance(0.6):
        solids.append(rod((0, 0, up + 0.6 * high), (0, 0, up + 0.75 * high), 0.88 * r, n))
    if m.chance(0.5) and saucer:
        solids += [rod((-1.2 * r, -1.3 * r, 0.013), (1.2 * r, -1.3 * r, 0.012), 0.0015, 6)]
        solids += [ball((1.3 * r, -1.3 * r, 0.012), (0.012, 0.007, 0.003), 8)]
    m.add(BASE, *(moved(turned(s, (0, 0, 1), turn, (0, 0, 0)), at) for s in solids))


def tea_set(m: Model) -> None:
    """Cups on saucers, a pot without a lid, an open milk jug and a sugar bowl, perhaps on a tray; nothing moves."""
    n, r, high, look, cups = (
        m.pick(12, 18, 24),
        m.number(0.035, 0.045),
        m.number(0.04, 0.08),
        m.pick(1, 2, 3, 4),
        m.pick(1, 2, 4, 6),
    )
    away, w, tall, tray = 0.11 + 0.022 * cups, m.number(0.05, 0.07), m.number(0.08, 0.16), m.pick("none", "round", "square")
    if tray != "none":
        m.add(BASE, rod((0, 0, -0.012), (0, 0, 0), 1.4 * (away + 0.03), 32 if tray == "round" else 4))
    for q in _around(cups, away, 0):
        _cup(m, q, r, high, n, look)
    if m.chance(0.75):
        belly = [(0, 0), (0.7, 0), (1, 0.4), (0.85, 0.8), (0.6, 0.95), (0.65, 1), (0.55, 1), (0.55, 0.9), (0, 0.1)]
        m.add(BASE, lathe(np.array(belly) * (w, tall), n))
        spout = curve((0.9 * w, 0, 0.3 * tall), (1.6 * w, 0, 0.4 * tall), (1.9 * w, 0, tall))
        grip = curve((-0.8 * w, 0, 0.8 * tall), (-2.6 * w, 0, 0.9 * tall), (-0.9 * w, 0, 0.3 * tall), 8)
        m.add(BASE, skin(spout, np.linspace(0.28, 0.12, 6) * w, 8), skin(grip, [0.11 * w] * 8, 8))
    if m.chance(0.5):
        m.add(BASE, _dish(0.032, 0.04, 0.02, n, (0, 0.095, 0), 0.002))
        for _ in range(m.pick(4, 9)):
            c = vec(m.number(-0.013, 0.013), 0.095 + m.number(-0.013, 0.013), m.number(0.01, 0.042))
            m.add(BASE, turned(box(*((v - 0.006, v + 0.006) for v in c)), (0, 0, 1), m.number(0, 90), c))
    if m.chance(0.5):
        _cup(m, vec(-0.02, -0.095, 0), 0.025, 0.07, n, 5)
    Clay(m, "round", n).done(1.0, 0)
