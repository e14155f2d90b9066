"""Doors that lie or lean: cellar doors and trapdoors."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import trimesh

from training.kinds.model import BASE, Link, Model
from training.kinds.solids import Span, ball, box, prism, rectangle, ring, rod, tube, vec


def leaned(m: Model, degrees: float, by: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
    """Turn all that a model has so far about the x axis, joints included, and move it."""
    turn = trimesh.transformations.rotation_matrix(np.deg2rad(degrees), (1, 0, 0))
    turn[:3, 3] = by
    for _, solid in m.pieces:
        solid.apply_transform(turn)
    for part, j in list(m.joints.items()):
        origin = trimesh.transform_points([j.origin], turn)[0]
        m.joints[part] = Link(j.type, j.parent, origin, turn[:3, :3] @ j.axis, j.limits)


def lying_leaf(m: Model, part: str, x: Span, y: Span, z: Span, style: str) -> None:
    """A leaf that lies in the ground plane: boards on battens, a plate with a pattern, a pan with ribs, a slab, a frame."""
    wide, t = x[1] - x[0], z[1] - z[0]
    if style == "boards":
        cs = np.linspace(*x, max(3, round(wide / 0.13)) + 1)
        m.add(part, *(box((a, b - 0.004), y, (z[0] + 0.4 * t, z[1])) for a, b in pairwise(cs)))
        inner = (x[0] + 0.08 * wide, x[1] - 0.08 * wide)
        m.add(part, *(box(inner, (c - 0.04, c + 0.04), (z[0] - 0.01, z[0] + 0.4 * t)) for c in _shares(y, 0.18, 0.82)))
    elif style == "pan":
        m.add(part, box(x, y, (z[1] - 0.25 * t, z[1])))
        m.add(part, *(box((a - 0.004, a + 0.004), y, (z[0], z[1] - 0.2 * t)) for a in (x[0] + 0.004, x[1] - 0.004)))
        m.add(part, *(box(x, (b - 0.004, b + 0.004), (z[0], z[1] - 0.2 * t)) for b in (y[0] + 0.004, y[1] - 0.004)))
        if m.chance(0.6):
            m.add(part, *(box((a - 0.012, a + 0.012), y, (z[1], z[1] + 0.008)) for a in np.linspace(*x, 6)[1:-1]))
    elif style == "frame":
        m.add(part, prism(rectangle(x, y, 0.16 * wide), "z", z))
        m.add(
            part, box((x[0] + 0.15 * wide, x[1] - 0.15 * wide), (y[0] + 0.1 * wide, y[1] - 0.1 * wide), (z[0], z[1] - 0.4 * t))
        )
    else:
        m.add(part, box(x, y, z))
        for a in np.linspace(*x, 7)[1:-1] if style == "pattern" else ():
            m.add(
                part,
                *(box((a - 0.02, a + 0.02), (b - 0.004, b + 0.004), (z[1], z[1] + 0.003)) for b in np.linspace(*y, 9)[1:-1]),
            )


def _shares(span: Span, *shares: float) -> list[float]:
    return [span[0] + s * (span[1] - span[0]) for s in shares]


def lying_pull(m: Model, part: str, at: tuple[float, float], z: float, along: str) -> None:
    """A handle on top of a lying leaf: a ring on a plate, a bow, a knob, a sunk plate, or none."""
    style, (a, b) = m.pick("ring", "bow", "bow", "knob", "plate", "none"), at
    if style == "ring":
        m.add(part, box((a - 0.04, a + 0.04), (b - 0.04, b + 0.04), (z, z + 0.006)))
        m.add(
            part,
            ring((a, b, z + 0.012), (0, 0, 1), 0.05, 0.007, 16),
            rod((a, b - 0.06, z + 0.012), (a, b - 0.03, z + 0.012), 0.012, 8),
        )
    elif style == "bow":
        d = (0.08, 0, 0) if along == "x" else (0, 0.08, 0)
        p, q, up = vec(a, b, z) - d, vec(a, b, z) + d, vec(0, 0, 0.045)
        m.add(part, tube([p, p + up, q + up, q], 0.008, 8))
    elif style == "knob":
        m.add(part, rod((a, b, z), (a, b, z + 0.03), 0.01, 8), ball((a, b, z + 0.04), (0.022, 0.022, 0.018), 10))
    elif style == "plate":
        m.add(part, box((a - 0.06, a + 0.06), (b - 0.035, b + 0.035), (z - 0.001, z + 0.004)))
        m.add(part, rod((a - 0.04, b, z + 0.006), (a + 0.04, b, z + 0.006), 0.006, 8))


def hinge_straps(m: Model, part: str, x: Span, y: Span, z: float, side: int) -> None:
    """Strap hinges or barrels at the left (-1) or right (1) edge of a lying leaf."""
    edge, style = (x[0] if side < 0 else x[1]), m.pick("straps", "barrels", "none")
    for b in _shares(y, *m.pick((0.15, 0.85), (0.12, 0.5, 0.88))) if style != "none" else ():
        if style == "straps":
            m.add(part, box((edge, edge - side * 0.6 * (x[1] - x[0])), (b - 0.02, b + 0.02), (z, z + 0.006)))
        m.add(m.pick(part, BASE), rod((edge, b - 0.05, z), (edge, b + 0.05, z), 0.012, 8))


def cellar_door(m: Model) -> None:
    """Two sloping leaves (or one) over steps that lead down beside a house wall: concrete, brick, boarded or sheet cheeks."""
    half, long, t = m.number(0.55, 0.85), m.number(1.3, 2.1), m.number(0.025, 0.05)
    slope, low, w = m.number(18, 38), m.number(0.12, 0.3), m.number(0.06, 0.12)
    style, lap = m.pick("boards", "boards", "pan", "pattern", "slab", "frame"), m.chance(0.6)
    frame = rectangle((-half, half), (0, long), w)
    m.add(BASE, prism(frame, "z", (-0.05, 0.0)))
    edge, z = (0.3 * w, (0.012, 0.012 + t)) if lap else (w + 0.004, (-t, 0.004))
    spans = {-1: (-half + edge, -0.002), 1: (0.002, half - edge)}
    if m.chance(0.15):
        spans = {m.pick(-1, 1): (-half + edge, half - edge)}
    y, strip = (edge, long - edge), m.chance(0.6)
    for side, x in spans.items():
        part, free = f"leaf_{'left' if side < 0 else 'right'}", x[1] if side < 0 else x[0]
        lying_leaf(m, part, x, y, z, style)
        hinge_straps(m, part, x, y, z[1], side)
        lying_pull(m, part, (free + side * 0.11, y[0] + m.pick(0.3, 0.5) * (y[1] - y[0])), z[1], "y")
        if strip and len(spans) == 2 and side < 0:
            m.add(part, box((free - 0.03, free + 0.03), y, (z[1] + 0.001, z[1] + 0.008)))
        m.hinge(part, (x[0] if side < 0 else x[1], 0, z[1]), (0, side, 0), m.number(95, 150))
    leaned(m, slope, (0.0, 0.0, low))
    deep, high = long * np.cos(np.deg2rad(slope)), low + long * np.sin(np.deg2rad(slope))
    drop = -0.045 / np.cos(np.deg2rad(slope))
    profile = [(0, 0), (deep, 0), (deep, high + drop), (0, low + drop)]
    cheek = m.pick("concrete", "brick", "sheet")
    side = 0.02 if cheek == "sheet" else w
    m.add(BASE, *(prism(profile, "x", (s * half, s * (half - side))) for s in (-1, 1)))
    m.add(BASE, box((-half + side, half - side), (0.0, side), (0, low + drop)))
    if cheek == "brick":
        for row in np.arange(0.0, low + 0.3 * (high - low), 0.075):
            start = max(0.0, (row + 0.07 - low) / np.tan(np.deg2rad(slope)) + 0.1) if row + 0.1 > low else 0.0
            m.add(BASE, *(box((s * half, s * (half + 0.008)), (start, deep), (row, row + 0.065)) for s in (-1, 1)))
    if m.chance(0.7):
        tall = m.number(1.1, 2.0) * high
        m.add(BASE, box((-half - m.number(0.1, 0.5), half + m.number(0.1, 0.5)), (deep, deep + 0.2), (0, tall)))
    if m.chance(0.5):
        n = m.pick(3, 4, 5)
        m.add(
            BASE,
            *(
                box((-half + side, half - side), (0.2 + 0.7 * k * (deep - 0.2) / n, deep), (-0.18 * k - 0.18, -0.18 * k))
                for k in range(n)
            ),
        )
    if m.chance(0.5):
        m.add(BASE, box((-half - 0.25, half + 0.25), (-m.number(0.1, 0.4), 0.0), (-0.05, 0.0)))


def trapdoor(m: Model) -> None:
    """A hatch in a floor (one leaf or two, ring, ladder below, curb, rails) or in a loft's floor, which opens downwards."""
    wide, deep, t = m.number(0.6, 1.2), m.number(0.7, 1.4), m.number(0.02, 0.05)
    x, y, floor = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.08, 0.2)
    margin = m.number(0.15, 0.6)
    hole, out = rectangle(x, y), rectangle((x[0] - margin, x[1] + margin), (y[0] - margin, y[1] + margin))
    loft, gap = m.chance(0.3), 0.004
    if m.chance(0.5):
        cs = np.arange(x[0] - margin, x[1] + margin, 0.14)
        for c in cs:
            plank = rectangle((c, min(c + 0.137, x[1] + margin)), (y[0] - margin, y[1] + margin)).difference(hole)
            m.add(BASE, *(prism(g, "z", (-0.03, 0)) for g in getattr(plank, "geoms", [plank]) if g.area > 1e-4))
        m.add(BASE, prism(rectangle((x[0] - 0.06, x[1] + 0.06), (y[0] - 0.06, y[1] + 0.06), 0.06), "z", (-floor, -0.03)))
    else:
        m.add(BASE, prism(out.difference(hole), "z", (-floor, 0)))
    two, style = m.chance(0.35), m.pick("boards", "boards", "pan", "pattern", "slab", "frame")
    curb = 0.0 if loft else m.pick(0.0, 0.0, 0.04, 0.12)
    if curb:
        m.add(BASE, prism(rectangle((x[0] - 0.07, x[1] + 0.07), (y[0] - 0.07, y[1] + 0.07), 0.07), "z", (0, curb)))
    lap = -0.04 if curb and m.chance(0.5) else gap
    z = (curb + 0.012, curb + 0.012 + t) if lap < 0 else (curb - t, curb + 0.002)
    if loft:
        z = (-floor - 0.002, -floor + t)
    x, y = (x[0] + lap, x[1] - lap), (y[0] + lap, y[1] - lap)
    spans = {-1: (x[0], -gap / 2), 1: (gap / 2, x[1])} if two and not loft else {m.pick(-1, 1): x}
    for side, span in spans.items():
        part, edge = (
            ("leaf" if len(spans) == 1 else f"leaf_{'left' if side < 0 else 'right'}"),
            span[0] if side < 0 else span[1],
        )
        free, sign = span[1] if side < 0 else span[0], -1 if loft else 1
        if loft:
            _loft_leaf(m, part, span, y, z, side)
        else:
            lying_leaf(m, part, span, y, z, style)
            hinge_straps(m, part, span, y, z[1], side)
            lying_pull(m, part, (free + side * 0.12, m.pick(0.0, 0.0, 0.2 * deep)), z[1], "y")
        m.hinge(
            part, (edge, 0, z[0] if loft else z[1]), (0, sign * side, 0), m.number(85, 110) if not loft else m.number(70, 90)
        )
    if m.chance(0.6) and not loft:
        _ladder(m, y[1] - 0.1, -m.number(1.0, 2.2), min(0.4 * wide, 0.22), floor)
    if m.chance(0.3):
        _guard(m, (x[0] - 0.1, x[1] + 0.1), y[1] + 0.1, m.number(0.7, 1.0))


def _loft_leaf(m: Model, part: str, x: Span, y: Span, z: Span, side: int) -> None:
    """A panel that hangs, with the ladder's sections folded on it."""
    m.add(part, box(x, y, z))
    if m.chance(0.5):
        m.add(part, prism(rectangle((x[0] + 0.08, x[1] - 0.08), (y[0] + 0.08, y[1] - 0.08), 0.02), "z", (z[0] - 0.008, z[0])))
    free = x[1] if side < 0 else x[0]
    m.add(part, rod((free + side * 0.06, 0, z[0]), (free + side * 0.06, 0, z[0] - 0.02), 0.012, 8))
    inner = (x[0] + 0.1, x[1] - 0.1)
    for k in range(m.pick(0, 1, 2)):
        at = z[1] + 0.05 * k
        m.add(part, *(box(inner, (c - 0.012, c + 0.012), (at, at + 0.045)) for c in (-0.17, 0.17)))
        m.add(
            part,
            *(box((a, a + 0.05), (-0.16, 0.16), (at + 0.01, at + 0.03)) for a in np.linspace(inner[0], inner[1] - 0.05, 5)),
        )


def _ladder(m: Model, y: float, low: float, half: float, floor: float) -> None:
    m.add(BASE, *(box((a - 0.02, a + 0.02), (y, y + 0.06), (low, -floor)) for a in (-half, half)))
    m.add(BASE, *(rod((-half, y + 0.03, c), (half, y + 0.03, c), 0.016, 8) for c in np.arange(low + 0.2, -floor, 0.26)))
    m.add(BASE, *(box((a - 0.02, a + 0.02), (y, y + 0.2), (-floor - 0.03, -floor)) for a in (-half, half)))


def _guard(m: Model, x: Span, y: float, high: float) -> None:
    """A fixed rail at the back of an opening."""
    m.add(BASE, *(rod((a, y, 0), (a, y, high), 0.02, 8) for a in x))
    m.add(BASE, *(rod((x[0], y, c), (x[1], y, c), 0.018, 8) for c in (0.5 * high, high)))
