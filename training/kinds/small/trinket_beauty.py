"""Things for a handbag by one artist: compacts, lipsticks, folding mirrors."""

from __future__ import annotations

import numpy as np
from shapely import affinity
from shapely.geometry import Point as Dot
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rod, rounded
from training.kinds.trinket_style import Look, band, bevelled, draw_look, outline, ribs, shell, slab, smooth, spun, without


def _plate_outline(m: Model, look: Look, half: float) -> Polygon:
    """A round, square, oval, eight-sided, shell-like or heart-shaped outline about the origin."""
    kind = m.pick("round", "square", "oval", "eight", "scallop", "heart")
    n = look.n + 8
    if kind == "square":
        return rounded((-half, half), (-half, half), 0.25 * half, 3 if look.plain else 6)
    if kind == "oval":
        return Polygon(half * outline(n, deep=0.75))
    if kind == "eight":
        return Polygon(half * outline(8))
    if kind == "scallop":
        return Polygon(half * outline(4 * n, lobes=12))
    if kind == "heart":
        t = np.linspace(0, 2 * np.pi, 2 * n, endpoint=False)
        y = 13 * np.cos(t) - 5 * np.cos(2 * t) - 2 * np.cos(3 * t) - np.cos(4 * t)
        return Polygon(half / 16 * np.c_[16 * np.sin(t) ** 3, y])
    return Polygon(half * outline(n))


def _plate(look: Look, shape: Polygon, z: tuple[float, float]) -> Trimesh:
    """A plate of an outline, bevelled where the look is soft, open below where it is a sheet."""
    if look.style in ("soft", "old") and shape.convex_hull.area < 1.01 * shape.area:
        return bevelled(shape, z, 0.35)
    return without(prism(shape, "z", z), (0, 0, -1)) if look.style == "sheet" else prism(shape, "z", z)


def cosmetic_compact(m: Model) -> None:
    """Two halves that hinge at the back with pans and a mirror inside, perhaps a layer that tips up and a catch."""
    look = draw_look(m)
    half, high, top = m.number(0.028, 0.05), m.number(0.006, 0.012), m.number(0.004, 0.009)
    shape = _plate_outline(m, look, half)
    low, back = shape.bounds[1], shape.bounds[3]
    rim = 0.1 * half
    inner = shape.buffer(-rim)
    whole = look.style == "sheet" or (look.style == "blocky" and m.chance(0.5))
    z = high + max(m.gap(0.03), 0.0001)
    m.add(
        BASE,
        _plate(look, shape, (0, high)) if whole else cut(_plate(look, shape, (0, high)), prism(inner, "z", (0.4 * high, 1))),
    )
    lid = _plate(look, shape, (z, z + top))
    m.add("lid", lid if whole else cut(lid, prism(inner, "z", (0, z + 0.5 * top))))
    m.hinge("lid", (0, back, z), (-1, 0, 0), m.pick(90, 110, 150, 170))
    if not whole:
        m.add("lid", prism(inner.buffer(-0.02 * half), "z", (z + 0.35 * top, z + 0.51 * top)))
        for pan in _pans(m, inner.buffer(-0.06 * half)):
            m.add(BASE, prism(pan, "z", (0.39 * high, m.number(0.6, 0.75) * high)))
    length = 0.3 * half
    for a in (-length, length) if m.chance(0.5) or shape.convex_hull.area > 1.05 * shape.area else (0.0,):
        m.add(BASE, rod((a - 0.4 * length, back, z), (a + 0.4 * length, back, z), 0.12 * high, 8))
        m.add(BASE, box((a - 0.4 * length, a + 0.4 * length), (back - 0.1 * half, back), (0.6 * high, 0.95 * high)))
    if not whole and m.chance(0.3):
        m.add(
            "layer",
            cut(
                prism(inner.buffer(-0.05 * half), "z", (0.8 * high, 0.97 * high)),
                rod((0, -0.5 * half, 0), (0, -0.5 * half, 1), 0.15 * half, 12),
            ),
        )
        m.hinge("layer", (0, inner.bounds[3] - 0.05 * half, 0.9 * high), (-1, 0, 0), m.pick(70, 90))
    if m.chance(0.5):
        w = m.number(0.1, 0.2) * half
        m.add("button", box((-w, w), (low - 0.04 * half, low + 0.05 * half), (0.25 * high, 0.8 * high)))
        m.slide("button", (0, 1, 0), 0.035 * half)
    elif m.chance(0.6):
        m.add("lid", box((-0.15 * half, 0.15 * half), (low - 0.05 * half, low + 0.08 * half), (z + 0.05 * top, z + 0.6 * top)))
    if m.chance(0.5):
        m.add(
            "lid",
            prism(affinity.scale(_plate_outline(m, look, half), 0.5, 0.5, origin=(0, 0)), "z", (z + 0.9 * top, z + 1.12 * top)),
        )


def _pans(m: Model, inside: Polygon) -> list[Polygon]:
    """The inside in one piece, in halves, in quarters, or as a row of discs."""
    kind = m.pick("one", "halves", "quarters", "discs")
    x0, y0, x1, y1 = inside.bounds
    gap = 0.03 * (x1 - x0)
    if kind == "one":
        return [inside]
    if kind == "discs":
        r = 0.19 * (x1 - x0)
        return [Dot(s * r * 1.1, t * r * 1.1).buffer(r, quad_segs=5) for s in (-1, 1) for t in (-1, 1)]
    across = [(x0, -gap), (gap, x1)]
    along = [(y0, y1)] if kind == "halves" else [(y0, -gap), (gap, y1)]
    return [inside.intersection(Polygon([(a, c), (b, c), (b, d), (a, d)])) for a, b in across for c, d in along]


def lipstick_tube(m: Model) -> None:
    """A tube with a cap that is pulled off, a stick that is wound out and a foot that winds it; or a wand in a bottle."""
    look = draw_look(m)
    r, n = m.number(0.008, 0.012), look.n
    line = outline(n, m.pick(2.0, 2.0, 6.0))
    foot, inner, cap = m.number(0.018, 0.03), m.number(0.012, 0.02), m.number(0.03, 0.045)
    if m.chance(0.25):
        _gloss(m, look, r, line)
        return
    m.add(
        BASE,
        spun(
            [
                (0, foot),
                (0.85 * r, foot),
                (0.85 * r, foot + inner),
                (0.75 * r, foot + inner),
                (0.75 * r, foot + 0.004),
                (0, foot + 0.004),
            ],
            line,
        ),
    )
    turning = m.chance(0.6)
    low = "twist" if turning else BASE
    m.add(low, *([spun([(0, 0), (0.96 * r, 0), (r, 0.05 * foot), (r, foot - 0.0002), (0, foot - 0.0002)], line)]))
    if look.style in ("old", "assembly", "soft"):
        m.add(low, *band(look, r, m.number(0.6, 0.9) * foot, 0.05 * r, line))
    if turning:
        m.spin("twist", (0, 0, foot / 2), (0, 0, 1))
    end = foot + inner + m.number(0.3, 1.0) * cap * 0.5
    stick, slant = 0.68 * r, m.pick("slant", "dome", "flat", "slant")
    m.add("stick", rod((0, 0, foot + 0.0045), (0, 0, foot + 0.6 * inner), 0.72 * r, n))
    solid = rod((0, 0, foot + 0.4 * inner), (0, 0, end), stick, n)
    if slant == "slant":
        solid.vertices[:, 2] -= np.where(solid.vertices[:, 2] > end - 0.001, 0.9 * (stick + solid.vertices[:, 1]), 0)
    m.add("stick", solid)
    if slant == "dome":
        m.add("stick", ball((0, 0, end), (stick, stick, 0.6 * stick), max(8, n)))
    m.slide("stick", (0, 0, 1), m.number(0.5, 0.9) * inner)
    if m.chance(0.8):
        top = max(foot + cap, end + 0.8 * r) + 0.001
        profile = [(r, foot + 0.0002), (r, top - 0.1 * r), (0.93 * r, top), (0, top)]
        m.add("cap", shell(Look(m, "hollowed", n) if look.style == "blocky" else look, profile, 0.1 * r, line, down=True))
        if m.chance(0.4):
            m.add("cap", *slab(look, (-0.5 * r, 0.5 * r), (-0.5 * r, 0.5 * r), (top - 0.0004, top + 0.001), 0.2 * r))
        m.slide("cap", (0, 0, 1), m.number(0.7, 1.0) * inner)


def _gloss(m: Model, look: Look, r: float, line: np.ndarray) -> None:
    """A bottle of gloss whose long cap, with a wand in it, is unscrewed."""
    foot, cap = m.number(0.04, 0.06), m.number(0.03, 0.05)
    m.add(BASE, shell(look, [(0, 0), (r, 0), (r, 0.95 * foot), (0.7 * r, foot)], 0.12 * r, line))
    m.add(BASE, rod((0, 0, 0.85 * foot), (0, 0, foot + 0.006), 0.5 * r, look.n))
    z = foot + 0.0006
    profile = [(0.9 * r, z), (0.9 * r, z + 0.9 * cap), (0.7 * r, z + cap), (0, z + cap)]
    m.add("cap", shell(look, profile, 0.1 * r, line, down=True))
    if not look.plain:
        m.add(
            "cap",
            rod((0, 0, 0.2 * foot), (0, 0, z + 0.95 * cap), 0.1 * r, 8),
            ball((0, 0, 0.2 * foot), (0.18 * r, 0.18 * r, 0.15 * foot), 10),
        )
        m.add("cap", *ribs(m.pick(12, 18), 0.9 * r, (z + 0.1 * cap, z + 0.5 * cap), 0.06 * r))
    m.spin("cap", (0, 0, z + cap / 2), (0, 0, 1))


def hand_mirror_folding(m: Model) -> None:
    """A mirror on a handle that folds, a pair of mirrors like a book, or a mirror that tilts on a folding foot."""
    look = draw_look(m)
    half, thick = m.number(0.04, 0.08), m.number(0.005, 0.011)
    shape = _plate_outline(m, look, half)
    if shape.convex_hull.area > 1.02 * shape.area:
        shape = Polygon(half * outline(look.n + 8, deep=m.pick(1.0, 1.25)))
    glass = shape.buffer(-m.number(0.08, 0.15) * half)
    kind = m.pick("handle", "book", "stand")
    m.add(BASE, _plate(look, shape, (0, thick)))
    sunk = look.style == "hollowed"
    if kind == "book":
        back, z = shape.bounds[3], thick + max(m.gap(0.03), 0.0001)
        m.add("lid", _plate(look, shape, (z, z + 0.8 * thick)))
        if not look.plain:
            m.add(BASE, rod((-0.4 * half, back, z), (0.4 * half, back, z), 0.2 * thick, 10))
        if m.chance(0.5):
            m.add("lid", prism(shape.buffer(-0.3 * half), "z", (z + 0.75 * thick, z + 0.9 * thick)))
        m.hinge("lid", (0, back, z), (-1, 0, 0), m.pick(120, 150, 180))
        return
    if sunk:
        m.pieces.pop()
        m.add(BASE, cut(prism(shape, "z", (0, thick)), prism(glass, "z", (0.7 * thick, 1))))
    m.add(BASE, prism(glass.buffer(-0.01 * half), "z", (0.3 * thick, (0.85 if sunk else 1.06) * thick)))
    if kind == "stand":
        low = shape.bounds[1]
        m.add(
            "foot",
            prism(
                Polygon(
                    [(-0.3 * half, 0.2 * half), (0.3 * half, 0.2 * half), (0.4 * half, 0.85 * low), (-0.4 * half, 0.85 * low)]
                ),
                "z",
                (-0.004, -0.0002),
            ),
        )
        m.hinge("foot", (0, 0.2 * half, -0.001), (1, 0, 0), m.pick(40, 60))
        m.add(BASE, rod((-0.35 * half, 0.22 * half, -0.001), (0.35 * half, 0.22 * half, -0.001), 0.002, 8))
        return
    _handle(m, look, shape, half, thick)


def _handle(m: Model, look: Look, shape: Polygon, half: float, thick: float) -> None:
    """A grip on a pin below the mirror, which folds behind it or swings to the side over it."""
    low, w, long = shape.bounds[1], m.number(0.15, 0.25) * half, m.number(1.2, 1.8) * half
    z = (0.1 * thick, 0.9 * thick)
    y = low - 0.12 * half
    m.add(BASE, *(box((s * 1.05 * w, s * 1.5 * w), (y - 0.05 * half, low + 0.12 * half), z) for s in (-1, 1)))
    m.add(BASE, rod((-1.5 * w, y, thick / 2), (1.5 * w, y, thick / 2), 0.25 * thick, 10))
    side = [
        (-0.8 * w, y + 0.05 * half),
        (0.8 * w, y + 0.05 * half),
        (0.8 * w, y - 0.2 * long),
        (1.1 * w, y - 0.8 * long),
        (0.7 * w, y - long),
        (-0.7 * w, y - long),
        (-1.1 * w, y - 0.8 * long),
        (-0.8 * w, y - 0.2 * long),
    ]
    grip = Polygon(side) if look.plain else Polygon(smooth([*side, side[0]]))
    if m.chance(0.4):
        grip = grip.difference(Dot(0, y - 0.85 * long).buffer(0.5 * w))
    m.add("handle", prism(grip, "z", z))
    if look.style == "old":
        m.add(
            "handle",
            *(
                rod((0, y - a * long, z[0] - 0.1 * thick), (0, y - a * long, z[1] + 0.1 * thick), 0.4 * w, 12)
                for a in (0.35, 0.6)
            ),
        )
    m.hinge("handle", (0, y, thick / 2), (-1, 0, 0), m.pick(90, 150))
