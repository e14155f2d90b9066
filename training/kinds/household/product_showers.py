"""Shower cabins, by one artist."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.household.product_taps import fittings
from training.kinds.model import BASE, Model
from training.kinds.product_style import UP, Look, faces, lathe
from training.kinds.solids import Span, box, cut, prism, rod, rounded, vec


def shower_cabin(m: Model) -> None:
    """A shower on a tray in a corner or free, its doors swinging, sliding, folding or running round a corner."""
    look = Look.of(m)
    wide, deep, high = m.number(0.8, 1.2), m.number(0.75, 0.95), m.number(1.85, 2.1)
    tray, post, design = m.number(0.04, 0.16), m.number(0.02, 0.035), m.pick("swing", "slide", "fold", "round")
    if design == "round":
        wide = deep = max(wide, 0.85)
    x, y, z = (0.0, wide), (0.0, deep), (tray, high)
    _walls(look, x, y, z, post)
    _tray(look, x, y, tray, design == "round")
    if design == "round":
        _round_doors(look, wide, z, post)
    else:
        m.add(BASE, *(look.block((a, a + post), (-0.002, post), z) for a in (0.0, wide - post)))
        m.add(BASE, look.block((0.0, wide), (-0.002, post), (high - 0.002, high + 0.035), leave=""))
        room = (post, wide - post)
        {"swing": _swing, "slide": _slide, "fold": _fold}[design](look, room, (tray + 0.006, high - 0.008))
    fittings(look, x, deep - 0.02, high)
    if m.chance(0.3):
        rim = prism(rounded((0.001, wide - 0.001), (0.001, deep), 0.1), "z", (high + 0.034, high + 0.07))
        if design != "round":
            m.add(BASE, rim)


def _pane(look: Look, part: str, x: Span, y: float, z: Span, framed: bool) -> None:
    """A glass door: a bare pane, or one in rails."""
    m, t, f = look.m, 0.008, 0.025
    if look.style == "sheet":
        m.add(part, faces([(x[0], y, z[0]), (x[1], y, z[0]), (x[1], y, z[1]), (x[0], y, z[1])]))
        return
    if not framed:
        m.add(part, box(x, (y - t / 2, y + t / 2), z))
        return
    m.add(part, box((x[0] + f, x[1] - f), (y - 0.003, y + 0.003), (z[0] + f, z[1] - f)))
    m.add(part, *(box((a, a + f), (y - 0.01, y + 0.01), z) for a in (x[0], x[1] - f)))
    m.add(part, *(box((x[0] + f, x[1] - f), (y - 0.01, y + 0.01), (c, c + f)) for c in (z[0], z[1] - f)))


def _walls(look: Look, x: Span, y: Span, z: Span, post: float) -> None:
    """Back and side walls: tiled walls, glass, or none at the side."""
    m = look.m
    m.add(BASE, box((x[0], x[1]), (y[1], y[1] + m.pick(0.01, 0.05)), (0.0, z[1] + m.pick(0.035, 0.2))))
    for a, b in ((x[0], x[0] + 0.008), (x[1] - 0.008, x[1])):
        m.add(BASE, box((a, b), (post if look.style != "sheet" else 0.0, y[1]), (z[0] - 0.002, z[1])))
    if look.style in ("parts", "soft", "old"):
        m.add(BASE, *(box((a, a + post), (y[1] - post, y[1]), z) for a in (x[0], x[1] - post)))
        m.add(BASE, *(box((a, a + post), (post, y[1]), (z[1] - 0.001, z[1] + 0.034)) for a in (x[0], x[1] - post)))


def _tray(look: Look, x: Span, y: Span, high: float, curved: bool) -> None:
    """A tray with a hollow and a drain."""
    m, plan = look.m, rounded(x, (y[0] - 0.02, y[1]), 0.02)
    if curved:
        plan = _quarter(x[1] + 0.02).intersection(plan.buffer(0.05))
    solid = prism(plan, "z", (0.0, high))
    m.add(BASE, cut(solid, prism(plan.buffer(-0.06), "z", (high - 0.02, high + 1))))
    drain = vec(0.5 * x[1], 0.55 * y[1], high - 0.0205)
    m.add(BASE, lathe([(0.05, 0), (0.05, 0.004), (0.03, 0.007)], look.n, drain))
    if m.chance(0.3) and not curved:
        m.add(
            BASE,
            *(
                box((x[0] + 0.08, x[1] - 0.08), (c, c + 0.02), (high - 0.021, high - 0.012))
                for c in np.linspace(0.12, y[1] - 0.12, 7)
            ),
        )


def _quarter(r: float) -> Polygon:
    """A square with one corner at the front left made round."""
    t = np.linspace(np.pi, 1.5 * np.pi, 13)
    round_part = np.c_[r + 0.62 * r * np.cos(t) - 0.38 * r, r + 0.62 * r * np.sin(t) - 0.38 * r] + 0.0
    return Polygon([*round_part, (r - 0.02, 0.0), (r - 0.02, r - 0.02), (0.0, r - 0.02)])


def _swing(look: Look, x: Span, z: Span) -> None:
    """One door or two, or one beside a still pane."""
    m, kind, y = look.m, look.m.pick("one", "two", "half"), 0.01
    middle = (x[0] + x[1]) / 2 if kind == "two" else x[0] + m.number(0.25, 0.4) * (x[1] - x[0])
    framed = m.chance(0.4)
    spans = [x] if kind == "one" else [(x[0], middle - 0.002), (middle + 0.002, x[1])]
    if kind == "half":
        m.add(BASE, box((x[0] - 0.002, middle), (y - 0.004, y + 0.004), (z[0] - 0.007, z[1] + 0.007)))
        spans = spans[1:]
    for k, (a, b) in enumerate(spans):
        part, span = f"door_{k}" if kind == "two" else "door", (a + 0.003, b - 0.003)
        left = k == 0 if kind == "two" else kind == "one" and m.chance(0.5)
        _pane(look, part, span, y, z, framed)
        edge = span[0] if left else span[1]
        if look.style in ("parts", "soft"):
            heights = (z[0] + 0.2, z[1] - 0.25)
            m.add(
                part,
                *(
                    box(
                        (edge - 0.002, edge + 0.05) if left else (edge - 0.05, edge + 0.002),
                        (y - 0.014, y + 0.014),
                        (h, h + 0.06),
                    )
                    for h in heights
                ),
            )
        at = (span[1] - 0.06 if left else span[0] + 0.06, y - (0.004 if look.style != "sheet" else 0.0), m.number(0.95, 1.1))
        look.grip(part, at, UP, m.number(0.15, 0.5), 0.04, "" if not framed else "bar")
        m.hinge(part, (edge, y - 0.004, z[0]), (0, 0, -1 if left else 1), m.pick(90, 100))


def _slide(look: Look, x: Span, z: Span) -> None:
    """A door that slides before a still pane, or two from the middle before two still panes; rollers on a rail."""
    m, two = look.m, look.m.chance(0.5)
    parts = np.linspace(*x, 5 if two else 3)
    framed, back, front = m.chance(0.5), 0.018, -0.014
    still = [(parts[0], parts[1] + 0.02), (parts[3] - 0.02, parts[4])] if two else [(parts[0], parts[1] + 0.02)]
    for span in still:
        m.add(BASE, box(span, (back - 0.004, back + 0.004), (z[0] - 0.007, z[1] + 0.007)))
    m.add(
        BASE,
        box((x[0], x[1]), (front - 0.012, 0.0), (z[0] - 0.012, z[0] - 0.001)),
        rod((x[0], front, z[1] + 0.014), (x[1], front, z[1] + 0.014), 0.012, look.n),
    )
    m.add(
        BASE, *(box((a - 0.012, a + 0.012), (front, 0.002), (z[1] + 0.004, z[1] + 0.024)) for a in (x[0] + 0.006, x[1] - 0.006))
    )
    doors = [(parts[1], parts[2] - 0.001, -1), (parts[2] + 0.001, parts[3], 1)] if two else [(parts[1], parts[2], -1)]
    for k, (a, b, s) in enumerate(doors):
        part = f"door_{k}" if two else "door"
        _pane(look, part, (a, b), front, z, framed)
        m.add(
            part,
            *(
                rod((c, front - 0.02, z[1] - 0.002), (c, front - 0.004, z[1] - 0.002), 0.02, look.n)
                for c in (a + 0.08, b - 0.08)
            ),
        )
        at = b - 0.05 if s < 0 else a + 0.05
        look.grip(part, (at, front - (0.01 if framed else 0.004), 1.0), UP, 0.25, 0.035, "bar" if framed else "")
        m.slide(part, (s, 0, 0), 0.85 * (b - a))


def _fold(look: Look, x: Span, z: Span) -> None:
    """Two panes that fold: the first on the post, the second on the first."""
    m, y, middle = look.m, 0.01, (x[0] + x[1]) / 2
    framed = m.chance(0.5)
    _pane(look, "door_0", (x[0] + 0.003, middle - 0.001), y, z, framed)
    _pane(look, "door_1", (middle + 0.001, x[1] - 0.003), y, z, framed)
    m.hinge("door_0", (x[0] + 0.003, y, z[0]), (0, 0, -1), 85)
    m.hinge("door_1", (middle, y + 0.005, z[0]), (0, 0, 1), 165, "door_0")
    if look.style != "sheet":
        m.add("door_0", rod((middle, y + 0.008, z[0] + 0.2), (middle, y + 0.008, z[1] - 0.2), 0.006, 8))
    look.grip("door_1", (x[1] - 0.06, y - (0.01 if framed else 0.004), 1.0), UP, 0.2, 0.03, "bar")


def _round_doors(look: Look, wide: float, z: Span, post: float) -> None:
    """Curved doors that run round the middle of the corner at the front left, between two still panes."""
    m, r, n = look.m, 0.62 * wide, 7
    center = vec(0.62 * wide, 0.62 * wide, 0)

    def curve(a: float, b: float, radius: float, thick: float) -> Trimesh:
        t = np.deg2rad(np.linspace(a, b, n))
        ends = [
            np.c_[center[0] + q * np.cos(s), center[1] + q * np.sin(s)] for q, s in ((radius, t), (radius - thick, t[::-1]))
        ]
        return prism(np.concatenate(ends), "z", (z[0] + 0.012, z[1] - 0.012))

    for low, high in ((z[0] - 0.001, z[0] + 0.011), (z[1] - 0.011, z[1] + 0.03)):
        t = np.deg2rad(np.linspace(180, 270, 15))
        ring = [center[:2] + q * np.c_[np.cos(s), np.sin(s)] for q, s in ((r + 0.012, t), (r - 0.022, t[::-1]))]
        m.add(BASE, prism(np.concatenate(ring), "z", (low, high)))
        m.add(BASE, box((center[0], wide), (-0.012, 0.022), (low, high)), box((-0.012, 0.022), (center[1], wide), (low, high)))
    m.add(BASE, box((center[0] - 0.01, wide), (0.006, 0.014), z), box((0.006, 0.014), (center[1] - 0.01, wide), z))
    m.add(
        BASE, *(look.block(*span, z) for span in (((wide - post, wide), (-0.01, post)), ((-0.01, post), (wide - post, wide))))
    )
    m.add(BASE, curve(180, 204, r - 0.01, 0.008), curve(246, 270, r - 0.01, 0.008))
    for k, (a, b, s) in enumerate(((201, 224.7, -1), (225.3, 249, 1))):
        part = f"door_{k}"
        m.add(part, curve(a, b, r + 0.004, 0.008))
        t = np.deg2rad(b - 3 if s < 0 else a + 3)
        p = center + (r + 0.004) * vec(np.cos(t), np.sin(t), 0) + vec(0, 0, 1.0)
        out = 0.03 * vec(np.cos(t), np.sin(t), 0)
        lift = vec(0, 0, 0.1)
        m.add(
            part,
            rod(p + out - lift, p + out + lift, 0.007, 8),
            *(rod(p + q - 0.05 * out, p + q + out, 0.006, 8) for q in (0.8 * lift, -0.8 * lift)),
        )
        m.hinge(part, center + vec(0, 0, z[0]), (0, 0, s), m.pick(17, 19))
