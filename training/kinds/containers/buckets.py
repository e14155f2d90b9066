"""Buckets: pails, tubs, mop buckets with a wringer."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, box, loft, moved, prism, ring, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, caster


def oblong(wide: float, deep: float, corner: float, fine: int = 4) -> np.ndarray:
    """The outline of a rectangle about the middle; corner: 0 sharp to 1 as round as it goes."""
    r = max(0.02, 0.5 * min(0.999, corner)) * min(wide, deep)
    return np.array(rounded((-wide / 2, wide / 2), (-deep / 2, deep / 2), r, fine).exterior.coords)[:-1]


def circle(n: int, radius: float = 1.0) -> np.ndarray:
    turn = 2 * np.pi * (np.arange(n) + 0.5) / n
    return radius * np.c_[np.cos(turn), np.sin(turn)]


def vessel(outline: np.ndarray, levels: Sequence[tuple[float, float]]) -> Trimesh:
    """A body of outlines scaled by a share at heights, from below; one that comes back down inside is hollow."""
    return loft(np.array([np.c_[s * outline, np.full(len(outline), z)] for s, z in levels]))


def band(outline: np.ndarray, shares: tuple[float, float], z: tuple[float, float]) -> Trimesh:
    """A ring round a body between two shares of its outline."""
    return prism(Polygon(shares[1] * outline, [shares[0] * outline]), "z", z)


def bow(style: str, half: float, reach: float, n: int = 16) -> list[tuple[float, float]]:
    """The path (x, up) of a bail between two pivots at +-half."""
    if style == "round":
        t = np.linspace(np.pi, 0, n)
        return list(zip(half * np.cos(t), reach * np.sin(t), strict=True))
    if style == "square":
        return [(-half, 0), (-half, reach), (half, reach), (half, 0)]
    return [(-half, 0), (-half, 0.55 * reach), (-0.3 * half, reach), (0.3 * half, reach), (half, 0.55 * reach), (half, 0)]


def bail(m: Model, half: float, reach: float, pivot: Point, thick: float, leans: Sequence[float], part: str = "bail") -> None:
    """A bail between two sides that swings about x; leans: the angles forwards from upright in which it may be left."""
    style, lean, at = m.pick("round", "round", "square", "peak"), m.pick(*leans), np.asarray(pivot, float)
    grip, peg = m.pick("none", "wood", "plastic"), m.chance(0.7)
    path = [at + vec(x, 0, z) for x, z in bow(style, half, reach)]
    pieces = [tube(path, thick, m.pick(6, 8))]
    pieces += [rod(at + vec(s * half, 0, 0), at + vec(s * (half - 2.5 * thick), 0, 0), thick, 8) for s in (-1, 1) if peg]
    if grip != "none":
        top, long = at + vec(0, 0, reach), min(0.055, 0.28 * half)
        fat = m.number(2.0, 3.2) * thick
        pieces.append(
            rod(top - vec(long, 0, 0), top + vec(long, 0, 0), fat, m.sections())
            if grip == "wood"
            else box((-long, long), (at[1] - fat, at[1] + fat), (top[2] - 1.2 * fat, top[2] + 0.8 * fat))
        )
    m.add(part, *(turned(s, (1, 0, 0), lean, at) for s in pieces))
    if lean >= 45:
        m.hinge(part, at, (-1, 0, 0), (0.0, lean + m.pick(60, 90)))
    else:
        m.hinge(part, at, (1, 0, 0), (-90.0 - lean, 90.0 - lean))


def _ears(m: Model, half: float, z: float, thick: float) -> None:
    """What a bail hangs in at both sides: plates, bosses or loops."""
    style = m.pick("plate", "boss", "loop")
    for s in (-1, 1):
        inner, outer = s * (half - 0.016), s * (half - 1.2 * thick)
        if style == "plate":
            m.add(BASE, box((inner, outer), (-3.5 * thick, 3.5 * thick), (z - 5 * thick, z + 3 * thick)))
        elif style == "boss":
            m.add(BASE, rod((inner, 0, z), (outer, 0, z), 3 * thick, m.sections()))
        else:
            m.add(BASE, ring((s * (half - 3 * thick), 0, z), (1, 0, 0), 2.2 * thick, 0.9 * thick, 12))
            m.add(BASE, box((inner, s * (half - 3.5 * thick)), (-thick, thick), (z - 2.6 * thick, z - 1.4 * thick)))


def _body(m: Model, outline: np.ndarray, low: float, high: float, foot: float, wall: float) -> None:
    """The bucket itself with bands, a rim and what is in it."""
    size = float(np.abs(outline).max())
    t = wall / size
    steps = [(low, foot), (1, high), (1 - t, high), (low - t, foot + wall)]
    kind = m.pick("plain", "rim", "foot", "ribs", "steps")
    if kind == "foot":
        steps[:1] = [(low - 0.03, foot), (low - 0.03, foot + 0.06 * high), (low + 0.01, foot + 0.07 * high)]
    elif kind == "steps":
        mid = 0.55 * high
        share = low + (1 - low) * (mid - foot) / (high - foot)
        steps[1:1] = [(share - 0.01, mid), (share + 0.015, mid + 0.004)]
    m.add(BASE, vessel(outline, steps))
    if kind in ("rim", "ribs"):
        for a in (high - 0.012,) if kind == "rim" else (high - 0.012, 0.72 * high, 0.3 * high):
            s = low + (1 - low) * (a - foot) / (high - foot)
            m.add(BASE, band(outline, (s - 0.3 * t, s + 0.03), (a - 0.006, a + 0.008)))
    if m.chance(0.25):
        a = m.number(0.5, 0.85) * high
        m.add(BASE, vessel((low + (1 - low) * (a - foot) / (high - foot) - 0.5 * t) * outline, [(1, a - 0.004), (1, a)]))


def _wringer(m: Model, wide: float, deep: float, high: float) -> None:
    """A sieve that is pressed by a lever, one that spins over a pedal, or a funnel that lifts out."""
    style, c = m.pick("press", "press", "spin", "funnel"), m.pick(-1, 1) * 0.24 * wide
    if style == "spin":
        r = min(0.23 * wide, 0.4 * deep)
        outline = circle(m.sections() + 8, r)
        shape = vessel(outline, [(0.8, high - 0.1), (1, high + 0.02), (0.94, high + 0.02), (0.74, high - 0.09)])
        m.add("basket", moved(shape, (c, 0, 0)))
        m.add("basket", rod((c, 0, high - 0.12), (c, 0, high - 0.09), 0.2 * r, 12))
        m.add(
            BASE,
            rod((c, 0, 0.04), (c, 0, high - 0.12), 0.1 * r, 10),
            box((c - 0.008, c + 0.008), (-0.5 * deep, 0.5 * deep), (0.04, 0.06)),
        )
        m.spin("basket", (c, 0, high), (0, 0, 1))
        y = -0.46 * deep
        m.add(
            "pedal",
            box((c - 0.05, c + 0.05), (y - 0.1, y - 0.04), (0.075, 0.09)),
            beam((c, y + 0.04, 0.082), (c, y - 0.05, 0.082), 0.03, 0.012),
        )
        m.hinge("pedal", (c, y + 0.02, 0.082), (1, 0, 0), m.pick(15, 22))
        return
    x, y, z = (c - 0.2 * wide, c + 0.2 * wide), (-0.4 * deep, 0.4 * deep), (high - 0.12, high + 0.06)
    part = BASE if style == "press" else "wringer"
    size = np.array([c, 0, 0])
    shape = vessel(oblong(x[1] - x[0], y[1] - y[0], 0.4), [(0.75, z[0]), (1, z[1]), (0.92, z[1]), (0.68, z[0] + 0.008)])
    m.add(part, moved(shape, size))
    m.add(part, *(box(x, (s * 0.4 * deep, s * 0.515 * deep), (high, high + 0.012)) for s in (-1, 1)))
    if style == "funnel":
        m.slide("wringer", (0, 0, 1), m.number(0.15, 0.22))
        return
    at, up, s = vec(c, 0.36 * deep, z[1] + 0.012), m.number(0.25, 0.45), 0.2 * wide + 0.006
    m.add(
        BASE, *(box((c + k * s, c + k * (s - 0.012)), (0.2 * deep, 0.4 * deep), (z[1] - 0.03, z[1] + 0.025)) for k in (-1, 1))
    )
    m.add("lever", rod(at - vec(s, 0, 0), at + vec(s, 0, 0), 0.009, 10))
    m.add(
        "lever",
        beam(at, at + vec(0, 0.03, up), 0.03, 0.014),
        rod(at + vec(-0.05, 0.03, up), at + vec(0.05, 0.03, up), 0.014, 10),
    )
    if m.chance(0.6):
        m.add("lever", beam(at, at + vec(0, -0.02, -0.09), 0.26 * wide, 0.01))
    m.hinge("lever", at, (1, 0, 0), m.pick(40, 55))


def _lid(m: Model, outline: np.ndarray, high: float, hinged: bool) -> None:
    """A lid with an edge and a knob that lifts off or turns up about its rear."""
    gap, thick, edge = m.pick(0.0005, 0.001, 0.003), m.number(0.006, 0.015), m.pick(1.0, 1.03)
    dome, deep = m.pick(0.0, 0.02, 0.05), float(outline[:, 1].max())
    levels = [(edge, high + gap), (edge, high + gap + thick)]
    m.add("lid", vessel(outline, [*levels, (0.75, high + thick + dome)] if dome else levels))
    top = high + thick + dome
    if m.chance(0.7):
        m.add(
            "lid",
            rod((0, 0, top - 0.01), (0, 0, top + 0.012), 0.008, 8),
            rod((0, 0, top + 0.01), (0, 0, top + 0.022), 0.022, m.sections()),
        )
    elif m.chance(0.5):
        m.add("lid", box((-0.05, 0.05), (-deep - 0.015, -deep + 0.01), (high + gap, high + gap + 0.006)))
    if hinged:
        y = edge * deep + 0.004
        m.add(m.pick("lid", BASE), rod((-0.04, y, high), (0.04, y, high), 0.006, 10))
        m.add("lid", box((-0.03, 0.03), (0.8 * deep, y), (high + gap, high + gap + 0.005)))
        m.add(BASE, box((-0.04, 0.04), (0.9 * deep, y), (high - 0.03, high - 0.003)))
        m.hinge("lid", (0, y, high), (-1, 0, 0), m.pick(95, 110))
    else:
        m.slide("lid", (0, 0, 1), m.number(0.5, 0.9) * high)


def _mop_bucket(m: Model) -> None:
    wide, deep, high = m.number(0.4, 0.6), m.number(0.26, 0.34), m.number(0.26, 0.36)
    foot, wheels = m.pick(0.0, 0.075), m.chance(0.8)
    outline = oblong(wide, deep, m.pick(0.25, 0.5, 1.0))
    _body(m, outline, m.number(0.78, 0.92), high, foot, 0.008)
    if foot > 0:
        for k, (a, b) in enumerate((a, b) for a in (-0.3 * wide, 0.3 * wide) for b in (-0.28 * deep, 0.28 * deep)):
            if wheels:
                caster(m, f"caster_{k}", (a, b, foot + 0.003), foot / 2.5, True)
            else:
                m.add(BASE, rod((a, b, 0), (a, b, foot + 0.004), 0.03, 10))
    _wringer(m, wide, deep, high)
    if m.chance(0.6):
        half = wide / 2 + 0.014
        _ears(m, half, 0.85 * high, 0.005)
        bail(m, half, 0.5 * deep + 0.1, (0, 0, 0.85 * high), 0.005, (90, 100))


def bucket(m: Model) -> None:
    """A bucket with a bail that turns: a round or square pail, a champagne tub, or a mop bucket; perhaps with a lid."""
    style = m.pick("pail", "pail", "pail", "square", "tub", "mop", "mop")
    if style == "mop":
        _mop_bucket(m)
        return
    r, low = m.number(0.1, 0.18), m.number(0.68, 0.95)
    high = r * (m.number(1.5, 2.4) if style != "tub" else m.number(0.9, 1.3))
    outline = oblong(2 * r, m.number(1.5, 2.0) * r, 0.3) if style == "square" else circle(m.pick(10, 14, 20, 32), r)
    _body(m, outline, low, high, 0.0, m.pick(0.003, 0.006, 0.012))
    thick, lid = m.pick(0.003, 0.004, 0.006), m.pick("none", "none", "none", "lifted", "hinged")
    half, z = r + 0.012 + 2 * thick, high * m.number(0.84, 0.93)
    _ears(m, half, z, thick)
    reach = max(half * m.number(1.0, 1.25), float(outline[:, 1].max()) + 0.02)
    bail(m, half, reach, (0, 0, z), thick, (0, 0, 30, 75, 90, 100) if lid == "none" else (90, 100))
    if lid != "none":
        _lid(m, outline, high, lid == "hinged")
    if style != "square" and m.chance(0.2):  # a lip to pour from
        m.add(BASE, prism([(-0.05, -0.85 * r), (0.05, -0.85 * r), (0, -r - 0.03)], "z", (high - 0.006, high)))
