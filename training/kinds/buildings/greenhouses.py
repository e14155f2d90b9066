"""Greenhouses."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, handle, hang
from training.kinds.solids import Span, box, prism, rod, vec
from training.kinds.wheels import beam


def greenhouse(m: Model) -> None:
    """A glazed frame with a gable or lean-to roof: one or two doors that slide or swing, roof vents, louvres, staging."""
    half, deep, eaves, rise = m.number(0.9, 1.6), m.number(1.8, 3.6), m.number(1.3, 1.8), m.number(0.5, 0.8)
    lean, w, base = m.chance(0.25), m.number(0.025, 0.045), m.pick(0.0, 0.1, 0.5)
    ridge = (half if lean else 0.0, eaves + rise)
    bays = max(3, round(deep / 0.62))
    gable = [(-half, 0), (half, 0), (half, ridge[1] if lean else eaves), ridge, (-half, eaves)]
    gable = gable if not lean else [(-half, 0), (half, 0), ridge, (-half, eaves)]
    wide, tall = m.pick(0.62, 0.75, 1.2), min(eaves + 0.2, 1.9) if not lean else min(eaves, 1.8)
    c = 0.0 if not lean else -0.1 * half
    door = (c - wide / 2, c + wide / 2), (0.03, tall)
    _greenhouse_ends(m, gable, deep, w, door)
    for s in (-1,) if lean else (-1, 1):
        x, ys = s * half, np.linspace(0, deep, bays + 1)
        m.add(BASE, *(box((x - s * w, x), (b - w / 2, b + w / 2), (0, eaves)) for b in ys))
        m.add(BASE, *(box((x - s * w, x), (0, deep), (d, d + w)) for d in (base, eaves - w)))
        for k in range(bays):
            _pane_or_louvre(m, k, (x, s), (ys[k] + w / 2, ys[k + 1] - w / 2), (base + w, eaves - w), w)
        if base:
            m.add(BASE, box((x, x - s * 0.08), (0, deep), (0, base)))
    if lean and m.chance(0.7):
        m.add(BASE, box((half, half + 0.1), (-0.2, deep + 0.2), (0, ridge[1] + m.number(0.0, 0.5))))
    else:
        m.add(BASE, box((ridge[0] - w, ridge[0] + 0.3 * w), (0, deep), (ridge[1] - w, ridge[1] + 0.3 * w)))
    _roof_side(m, (-half, eaves), ridge, (deep, bays, w), "left")
    if not lean:
        _roof_side(m, (half, eaves), ridge, (deep, bays, w), "right")
    _greenhouse_door(m, door, w, half)
    if m.chance(0.6):
        z, x = m.number(0.65, 0.8), -half + w + 0.03
        m.add(BASE, *(box((x, x + 0.45), (0.15, deep - 0.15), (d, d + 0.02)) for d in m.pick((z,), (0.35, z))))
        m.add(BASE, *(box((a, a + 0.03), (b, b + 0.03), (0, z)) for a in (x, x + 0.42) for b in (0.2, deep / 2, deep - 0.25)))
        for b in np.linspace(0.3, deep - 0.3, m.pick(3, 5, 7)):
            m.add(BASE, rod((x + 0.2, b, z + 0.019), (x + 0.2, b, z + 0.14), m.number(0.05, 0.09), 10))
    if m.chance(0.4):
        m.add(BASE, box((-half - 0.1, half + 0.1), (-0.1, deep + 0.1), (-0.08, 0)))


def _greenhouse_ends(m: Model, gable: list, deep: float, w: float, door: tuple[Span, Span]) -> None:
    """The two ends: rims, posts and panes; the front with an opening."""
    shape, ((a, b), (_, tall)) = Polygon(gable), door
    rim = shape.difference(shape.buffer(-w, join_style="mitre"))
    room = Polygon([(a, -1), (b, -1), (b, tall), (a, tall)])
    frame = Polygon([(a - w, 0), (b + w, 0), (b + w, tall + w), (a - w, tall + w)]).intersection(shape)
    m.add(
        BASE,
        *(prism(g, "y", (0, w)) for g in _parts(rim.union(frame).difference(room))),
    )
    m.add(BASE, prism(rim, "y", (deep - w, deep)))
    glass = shape.buffer(-0.5 * w, join_style="mitre")
    m.add(BASE, *(prism(g, "y", (0.4 * w, 0.6 * w)) for g in _parts(glass.difference(frame))))
    m.add(BASE, prism(glass, "y", (deep - 0.6 * w, deep - 0.4 * w)))
    low, high = min(p[0] for p in gable), max(p[0] for p in gable)
    for c in np.linspace(low, high, m.pick(4, 5, 6))[1:-1]:
        post = Polygon([(c - w / 2, 0), (c + w / 2, 0), (c + w / 2, 5), (c - w / 2, 5)]).intersection(shape)
        m.add(BASE, prism(post, "y", (deep - w, deep)))
        m.add(BASE, *(prism(g, "y", (0, w)) for g in _parts(post.difference(frame))))


def _parts(shape: Polygon) -> list[Polygon]:
    return [g for g in getattr(shape, "geoms", [shape]) if isinstance(g, Polygon) and g.area > 1e-4]


def _pane_or_louvre(m: Model, k: int, wall: tuple[float, int], y: Span, z: Span, w: float) -> None:
    """A pane in a side wall, or a few slats low in the bay that turn."""
    x, s = wall
    mid = x - s * w / 2
    low = z[0]
    if k == 1 and m.chance(0.4) and z[1] - z[0] > 0.9:
        n, high, turns = m.pick(4, 5), 0.11, m.chance(0.8)
        low = z[0] + n * high + 0.02
        m.add(BASE, box((x - s * w, x), y, (low - 0.02, low)))
        for i in range(n):
            part, c = (f"slat_{'left' if s < 0 else 'right'}_{i}" if turns else BASE), z[0] + (i + 0.5) * high
            m.add(part, box((mid - 0.003, mid + 0.003), (y[0] + 0.006, y[1] - 0.006), (c - 0.53 * high, c + 0.45 * high)))
            if turns:
                m.hinge(part, (mid, sum(y) / 2, c), (0, s, 0), m.number(60, 85))
    m.add(BASE, box((mid - 0.003, mid + 0.003), y, (low, z[1])))


def _roof_side(
    m: Model, foot: tuple[float, float], top: tuple[float, float], size: tuple[float, int, float], name: str
) -> None:
    """One slope: rafters, panes, and vents that are hinged at the ridge."""
    (deep, bays, w), a, b = size, np.array(foot), np.array(top)
    ys, along = np.linspace(0, deep, bays + 1), (b - a) / np.linalg.norm(b - a)
    long, s = float(np.linalg.norm(b - a)), float(np.sign(a[0] - b[0]))
    up = vec(s * along[1], 0, abs(along[0]))

    def at(q: float, y: float) -> np.ndarray:
        p = a + q * along
        return vec(p[0], y, p[1])

    for y in ys:
        m.add(BASE, beam(at(0, y), at(long, y), w, w, (0, 1, 0)))
    vents = set(m.rng.permutation(np.arange(bays))[: m.pick(0, 1, 1, 2)].tolist())
    share, bar = m.pick(0.4, 0.5), 0.02
    for k in range(bays):
        y, span = (ys[k] + ys[k + 1]) / 2, ys[k + 1] - ys[k] - w - 0.004
        end = (1 - share) * long if k in vents else long - 0.02
        m.add(BASE, beam(at(0.02, y), at(end, y), span, 0.006, (0, 1, 0)))
        if k not in vents:
            continue
        part, high = f"vent_{name}_{k}", 0.5 * w + 0.012
        m.add(BASE, beam(at(end - 0.02, y), at(end + 0.02, y), span, 0.02, (0, 1, 0)))
        m.add(part, beam(at(end - 0.03, y) + high * up, at(long - 0.03, y) + high * up, span + 0.5 * w, 0.006, (0, 1, 0)))
        for c in (-1, 1):
            m.add(
                part,
                beam(
                    at(end - 0.03, y + c * span / 2) + high * up,
                    at(long - 0.03, y + c * span / 2) + high * up,
                    bar,
                    bar,
                    (0, 1, 0),
                ),
            )
        m.add(
            part,
            *(
                beam(at(q - bar / 2, y) + high * up, at(q + bar / 2, y) + high * up, span, bar, (0, 1, 0))
                for q in (end - 0.02, long - 0.04)
            ),
        )
        toward = -vec(along[0], 0, along[1])
        m.hinge(part, at(long - 0.03, y) + (high + bar / 2) * up, np.cross(toward, up), m.number(35, 60))


def _greenhouse_door(m: Model, door: tuple[Span, Span], w: float, half: float) -> None:
    """Sliding leaves on a rail before the front, or hinged ones in the frame."""
    (a, b), z = door
    two = b - a > 1.0 or m.chance(0.15)
    spans = [(a, (a + b) / 2), ((a + b) / 2, b)] if two else [(a, b)]
    slides = m.chance(0.5) and (b - a) < half * (2 if two else 0.95)
    bars = (0, m.pick(1, 2, 3))
    for k, x in enumerate(spans):
        part = f"door_{k}" if two else "door"
        if slides:
            s = (-1, 1)[k] if two else m.pick(-1, 1)
            span, y = (x[0] - 0.01 * (k == 0), x[1] + 0.01 * (k == len(spans) - 1)), (-w - 0.006, -0.006)
            glazed(m, part, span, y, z, w + 0.01, bars)
            m.slide(part, (s, 0, 0), 0.92 * (x[1] - x[0]))
            far = x[1] + s * (x[1] - x[0]) if s > 0 else x[0] - (x[1] - x[0])
            rail = tuple(sorted((x[0] if s > 0 else x[1], far)))
            m.add(BASE, box(rail, (-w - 0.01, 0), (z[1] + 0.003, z[1] + 0.03)), box(rail, (-w - 0.01, 0), (0.0, 0.025)))
        else:
            side = ("left", "right")[k] if two else m.pick("left", "right")
            span, y = (x[0] + 0.005, x[1] - 0.005), (0.0, w)
            glazed(m, part, span, y, (z[0], z[1] - 0.005), w + 0.01, bars)
            hang(m, part, span, y, (z[0], z[1] - 0.005), side, OUT, m.number(90, 150))
            s = 1 if side == "left" else -1
        edge = (x[1] - 0.02 if s < 0 else x[0] + 0.02) if slides else (x[1] - 0.02 if side == "left" else x[0] + 0.02)
        if m.chance(0.8):
            handle(m, part, (edge, 0.95), y, -1 if edge > sum(x) / 2 else 1, "front", 0.08)
