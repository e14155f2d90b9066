"""Plank doors by another artist: doors of sheds and barns that swing or hang on a rail, with bolts and buttons."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import LineString, Polygon
from shapely.geometry import box as area
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.prop_style import Style, block, draw_style, sheet
from training.kinds.solids import Span, box, cut, join, prism, rod, vec


def plank_doors(m: Model) -> None:
    """Plank doors in a wall, in the gable of a small building, or before a wall on a rail; with bolts, buttons, pulls."""
    s = draw_style(m, "low", "low", "sheet", "cad", "old", "sunk")
    wide, high, t = m.number(0.8, 1.6), m.number(1.8, 2.6), m.number(0.025, 0.05)
    double, hung, g = m.chance(0.5), m.chance(0.35), m.pick(0.003, 0.008)
    wide *= 1.5 if double else 1.0
    beside = wide if hung else m.number(0.15, 0.8)
    _wall(s, (0.0, wide), high, beside)
    face = -0.03 - t if hung else m.pick(0.0, 0.0, -t)
    y, reach = (face, face + t), 0.06 if hung else 0.0
    middle = wide / 2 if double else wide
    spans = [((-reach + g, middle - g), True), ((middle + g, wide + reach - g), False)][: 1 + double]
    brace = m.pick("z", "x", "z", "ledges", "none")
    for k, (x, left) in enumerate(spans):
        part = f"door_{k}"
        _planks(s, part, x, y, (0.02, high - 0.005 + reach), brace, left)
        if hung:
            _hang(s, part, x, y, high, left)
        else:
            edge = x[0] if left else x[1]
            _straps(s, part, x, y[0] - 0.02 if brace != "none" else y[0], high, left)
            front = float(m.of(part).bounds[0, 1])
            m.hinge(part, (edge, front, high / 2), (0, 0, -1 if left else 1), m.pick(90, 110, 120))
        _pull(s, part, x[1] - 0.1 if left else x[0] + 0.1, y[0] - (0.02 if brace != "none" else 0.0), left)
    if hung:
        rail = (-beside - 0.05, wide + beside + 0.05) if double or m.chance(0.3) else (-beside - 0.05, wide + 0.1)
        m.add(BASE, box(rail, (-0.025 - t / 2, -0.015 - t / 2), (high + 0.12, high + 0.17)))
        m.add(
            BASE,
            *(rod((v, 0.001, high + 0.145), (v, -0.02 - t / 2, high + 0.145), 0.012, 8) for v in np.linspace(*rail, 6)[1:-1]),
        )
    elif m.chance(0.6):
        _fasten(s, spans, y[0] - (0.02 if brace != "none" else 0.0))


def _wall(s: Style, x: Span, high: float, beside: float) -> None:
    """A wall with the opening: plain, of boards, or the front of a small building with a roof."""
    m, outer, above = s.m, (x[0] - beside, x[1] + beside), above_opening(s, beside)
    y, top = (0.0, m.pick(0.04, 0.1, 0.2)), high + above
    gable = m.chance(0.4)
    peak = top + (0.35 * (outer[1] - outer[0]) if gable else 0.0)
    outline = Polygon([(outer[0], 0), (outer[1], 0), (outer[1], top), ((outer[0] + outer[1]) / 2, peak), (outer[0], top)])
    outline = (outline if gable else area(outer[0], 0, outer[1], top)).difference(area(x[0], -1, x[1], high))
    if s.way == "cad" and not gable:
        count = m.pick(7, 11)
        strips = [outline.intersection(area(a + 0.001, 0, b, peak)) for a, b in pairwise(np.linspace(*outer, count + 1))]
        m.add(BASE, *(prism(p, "y", y) for strip in strips for p in getattr(strip, "geoms", [strip])))
        m.add(BASE, *(box((a, b), (y[1], y[1] + 0.05), h) for a, b in (outer,) for h in ((top - 0.2, top - 0.12),)))
    else:
        m.add(BASE, prism(outline, "y", y))
    if m.chance(0.5) and s.way != "sheet":
        frame = area(x[0] - 0.08, 0, x[1] + 0.08, high + 0.08).difference(area(x[0], -1, x[1], high))
        m.add(BASE, prism(frame, "y", (-0.001, y[1] + 0.02)))
    if gable:
        _house(s, outer, y[1], top, peak)


def above_opening(s: Style, beside: float) -> float:
    """How high the wall is over its opening."""
    return max(0.25, s.m.number(0.2, 0.5), 0.1 * beside)


def _house(s: Style, x: Span, front: float, top: float, peak: float) -> None:
    """The rest of a small building: three walls and a roof."""
    m, back, middle = s.m, s.m.number(0.8, 1.6) * (x[1] - x[0]), (x[0] + x[1]) / 2
    if s.way == "sheet":
        m.add(BASE, *(sheet((a, a), (front, back), (0, top)) for a in x))
    else:
        m.add(BASE, *(box(a, (front, back), (0, top)) for a in ((x[0], x[0] + 0.04), (x[1] - 0.04, x[1]))))
    m.add(BASE, prism([(x[0], 0), (x[1], 0), (x[1], top), (middle, peak), (x[0], top)], "y", (back, back + 0.04)))
    over = 0.15
    slope = (peak - top) / (middle - x[0])
    line = LineString([(x[0] - over, top - over * slope), (middle, peak), (x[1] + over, top - over * slope)])
    m.add(BASE, prism(line.buffer(0.03, cap_style="flat", join_style="mitre"), "y", (front - over, back + over)))


def _planks(s: Style, part: str, x: Span, y: Span, z: Span, brace: str, left: bool) -> None:
    """A leaf of boards with ledges and braces on its front."""
    m, count = s.m, s.m.pick(3, 5, 7)
    edges = np.linspace(*x, count + 1)
    if s.way == "sheet":
        m.add(part, sheet(x, (y[0], y[0]), z))
    elif s.way == "low":
        m.add(part, block(s, x, y, z))
    elif s.way == "sunk":
        grooves = [box((a - 0.004, a + 0.004), (y[0] - 1, y[0] + 0.3 * (y[1] - y[0])), (-1, 9)) for a in edges[1:-1]]
        m.add(part, cut(box(x, y, z), *grooves))
    else:
        s.put(part, *(block(s, (a + 0.001, b), y, z) for a, b in pairwise(edges)))
    if brace == "none":
        return
    w, front = min(0.12, 0.14 * (x[1] - x[0])), (y[0] - 0.02, y[0] + 0.0005)
    rows = [(z[0] + 0.15, z[0] + 0.15 + w), (z[1] - 0.15 - w, z[1] - 0.15)]
    pieces = [box((x[0] + 0.01, x[1] - 0.01), front, row) for row in rows]
    inner = area(x[0] + 0.01, rows[0][1], x[1] - 0.01, rows[1][0])
    rising = [(x[0], rows[0][1]), (x[1], rows[1][0])]
    falling = [(x[0], rows[1][0]), (x[1], rows[0][1])]
    lines = {"z": [rising if left else falling], "x": [rising], "ledges": []}[brace]
    pieces += [prism(LineString(line).buffer(w / 2, cap_style="flat").intersection(inner), "y", front) for line in lines]
    if brace == "x":
        half = LineString(falling).buffer(w / 2, cap_style="flat").intersection(inner)
        rest = half.difference(LineString(rising).buffer(w / 2, cap_style="flat"))
        pieces += [prism(p, "y", front) for p in getattr(rest, "geoms", [rest])]
    s.put(part, *([join(*pieces)] if s.way == "sunk" else pieces))


def _straps(s: Style, part: str, x: Span, y: float, high: float, left: bool) -> None:
    """Long strap hinges, with their pins where an artist draws them."""
    if s.way == "sheet":
        return
    edge, to = (x[0], 1) if left else (x[1], -1)
    for h in (0.2 * high, 0.82 * high):
        s.m.add(part, box((edge, edge + to * 0.5 * (x[1] - x[0])), (y - 0.004, y + 0.0005), (h - 0.02, h + 0.02)))
        s.m.add(part, rod((edge, y - 0.004, h - 0.02), (edge, y - 0.004, h + 0.02), 0.007, 8))


def _hang(s: Style, part: str, x: Span, y: Span, high: float, left: bool) -> None:
    """Hangers over the rail with rollers, and a sliding joint to the side."""
    m, middle = s.m, (y[0] + y[1]) / 2
    wheels, r = m.chance(0.6), 0.045
    for share in (0.15, 0.85):
        at = x[0] + share * (x[1] - x[0])
        m.add(part, box((at - 0.025, at + 0.025), (y[0] - 0.006, y[0] + 0.0005), (high - 0.15, high + 0.26)))
        if wheels:
            roller, hub = s.name("roller"), vec(at, middle, high + 0.17 + r)
            m.add(roller, rod(hub - vec(0, 0.012, 0), hub + vec(0, 0.012, 0), r, s.n))
            m.spin(roller, hub, (0, 1, 0), part)
            m.add(part, rod(hub - vec(0, middle - y[0] + 0.008, 0), hub + vec(0, 0.016, 0), 0.008, 8))
        else:
            m.add(part, box((at - 0.025, at + 0.025), (y[0] - 0.006, y[1]), (high + 0.172, high + 0.26)))
    m.slide(part, (-1 if left else 1, 0, 0), m.number(0.8, 0.98) * (x[1] - x[0]))


def _pull(s: Style, part: str, x: float, y: float, left: bool) -> None:
    """A fixed pull or plate."""
    sort, at = s.m.pick("bow", "block", "none"), s.m.number(0.9, 1.15)
    if sort == "bow":
        feet = [vec(x, y + 0.021, at + v) for v in (-0.09, 0.09)]
        s.m.add(part, *(rod(f, f - vec(0, 0.06, 0), 0.008, 8) for f in feet))
        s.m.add(part, rod(feet[0] - vec(0, 0.06, 0.01), feet[1] - vec(0, 0.06, -0.01), 0.009, 8))
    elif sort == "block":
        s.m.add(part, block(s, (x - 0.02, x + 0.02), (y - 0.03, y + 0.021), (at - 0.1, at + 0.1)))


def _fasten(s: Style, spans: list[tuple[Span, bool]], y: float) -> None:
    """A bolt that slides into its neighbour, or a turning button on the frame."""
    m, (x, left) = s.m, spans[0]
    edge, h = x[1] if left else x[0], m.number(0.6, 0.8)
    if m.chance(0.5):
        m.add("door_0", box((edge - 0.17, edge - 0.01), (y - 0.004, y + 0.021), (h - 0.03, h + 0.03)))
        bolt = rod((edge - 0.16, y - 0.013, h), (edge + 0.01, y - 0.013, h), 0.008, s.n)
        m.add("bolt", bolt, rod((edge - 0.1, y - 0.013, h), (edge - 0.1, y - 0.045, h), 0.006, 8))
        loops = [box((edge + v, edge + v + 0.015), (y - 0.025, y - 0.003), (h - 0.016, h + 0.016)) for v in (-0.15, -0.05)]
        m.add("door_0", *(_bored(loop, (y - 0.013, h)) for loop in loops))
        m.slide("bolt", (-1, 0, 0), 0.045, "door_0")
    else:
        at = edge + 0.035
        hold = "door_1" if len(spans) > 1 else BASE
        m.add("button", block(s, (at - 0.09, at + 0.03), (y - 0.022, y - 0.004), (h + 0.3, h + 0.34)))
        m.add(hold, rod((at, y + 0.1 if hold == BASE else y + 0.03, h + 0.32), (at, y - 0.003, h + 0.32), 0.012, 8))
        m.hinge("button", (at, y, h + 0.32), (0, 1, 0), 90, hold)


def _bored(solid: Trimesh, at: tuple[float, float]) -> Trimesh:
    return cut(solid, rod((-9, *at), (9, *at), 0.0085, 12))
