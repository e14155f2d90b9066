"""Controls that move and trims that do not, for kitchen and bathroom kinds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, ball, box, loft, prism, ring, rod, tube, vec


def dial(m: Model, part: str, at: Point, axis: Point, radius: float, parent: str = BASE, style: str = "") -> None:
    """A knob that turns about an axis (unit, outwards) at a point of a surface; perhaps with a fixed ring round it."""
    at, axis = np.asarray(at, float), np.asarray(axis, float)
    up = vec(0, 0, 1) if abs(axis[2]) < 0.9 else vec(0, 1, 0)
    style, n, high = style or m.pick("plain", "bar", "stepped", "pointer", "ball"), m.sections(), radius * m.number(0.7, 1.4)
    top = at + high * axis
    if style == "stepped":
        m.add(part, rod(at, at + 0.4 * high * axis, radius, n), rod(at + 0.4 * high * axis, top, 0.65 * radius, n))
    elif style == "ball":
        m.add(part, rod(at, top, 0.4 * radius, 8), ball(top, (radius,) * 3, n))
    else:
        m.add(part, rod(at, top, radius, n))
    if style in ("bar", "pointer"):
        side, length = 0.15 * radius * np.abs(np.cross(axis, up)), (0.95 if style == "bar" else 0.0) * radius
        a, b = top - length * up - side, top + 0.95 * radius * up + side + 0.25 * high * axis
        m.add(part, box(*np.c_[a, b]))
    if m.chance(0.3):
        m.add(parent, ring(at, axis, 1.2 * radius, 0.08 * radius, 16))
    if m.chance(0.5):
        m.spin(part, at, axis, parent)
    else:
        m.hinge(part, at, -axis, m.pick(90, 270, 300), parent)


def button(m: Model, part: str, at: Point, axis: Point, size: float, parent: str = BASE) -> None:
    """A button that is pressed in against an axis (unit, outwards)."""
    at, axis = np.asarray(at, float), np.asarray(axis, float)
    if m.chance(0.5):
        m.add(part, rod(at, at + 0.5 * size * axis, size / 2, m.sections()))
    else:
        side = (1 - np.abs(axis)) * size / 2 * np.array([m.pick(1.0, 1.6), 1, 1])
        m.add(part, box(*np.c_[at - side, at + side + 0.5 * size * axis]))
    m.slide(part, -axis, 0.4 * size, parent)


def lever(m: Model, part: str, at: Point, end: Point, thick: float) -> None:
    """A lever arm from a pivot to its end: round, flat, or with a ball at its end."""
    at, end = np.asarray(at, float), np.asarray(end, float)
    style = m.pick("round", "flat", "ball")
    if style == "flat":
        m.add(part, box(*np.c_[np.minimum(at, end) - thick / 2, np.maximum(at, end) + thick / 2]))
        return
    m.add(part, rod(at, end, thick / 2, m.sections()))
    if style == "ball":
        m.add(part, ball(end, (0.9 * thick,) * 3, 10))


def trims(m: Model, part: str, x: Span, y: float, z: Span, most: int = 2) -> None:
    """Things on a face to the front that never move: a sign, a display, vents, screws, a strip."""
    wide, tall = x[1] - x[0], z[1] - z[0]
    for style in m.rng.permutation(["sign", "display", "vents", "screws", "strip"])[: int(m.rng.integers(most + 1))]:
        a, b = x[0] + m.number(0.1, 0.6) * wide, z[0] + m.number(0.2, 0.6) * tall
        if style in ("sign", "display"):
            out = 0.003 if style == "sign" else 0.001
            m.add(part, box((a, a + 0.25 * wide), (y - out, y), (b, b + m.pick(0.15, 0.3) * tall)))
        elif style == "vents":
            m.add(
                part,
                *(box((a, a + 0.3 * wide), (y - 0.002, y), (c, c + 0.03 * tall)) for c in np.linspace(b, b + 0.3 * tall, 4)),
            )
        elif style == "screws":
            r = 0.03 * min(wide, tall)
            m.add(
                part,
                *(
                    rod((c, y - r / 2, d), (c, y, d), r, 8)
                    for c in (x[0] + 2 * r, x[1] - 2 * r)
                    for d in (z[0] + 2 * r, z[1] - 2 * r)
                ),
            )
        else:
            m.add(part, box(x, (y - 0.002, y), (b, b + 0.03 * tall)))


def cable(m: Model, at: Point, reach: float) -> None:
    """A cable from the back of an object down to the floor and away, with a plug."""
    x, y, z = at
    low, r = 0.004, 0.004
    path = [(x, y, z), (x, y + 0.15 * reach, z), (x, y + 0.3 * reach, low), (x + 0.5 * reach, y + 0.4 * reach, low)]
    m.add(
        BASE,
        tube(path, r, 6),
        box((x + 0.5 * reach, x + 0.65 * reach), (y + 0.4 * reach - 0.012, y + 0.4 * reach + 0.012), (0, 0.02)),
    )


def feet(m: Model, x: Span, y: Span, high: float) -> None:
    """What an object stands on: a plinth, round or square feet, casters, skids."""
    style, d = m.pick("plinth", "round", "square", "casters", "skids"), 0.1 * min(x[1] - x[0], y[1] - y[0])
    if style == "plinth":
        m.add(BASE, box((x[0] + 0.3 * d, x[1] - 0.3 * d), (y[0] + d, y[1]), (0, high)))
        return
    if style == "skids":
        m.add(BASE, *(box((a - d / 2, a + d / 2), (y[0] + d, y[1] - d), (0, high)) for a in (x[0] + d, x[1] - d)))
        return
    for a in (x[0] + d, x[1] - d):
        for b in (y[0] + d, y[1] - d):
            if style == "square":
                m.add(BASE, box((a - d / 3, a + d / 3), (b - d / 3, b + d / 3), (0, high)))
            elif style == "round":
                m.add(BASE, rod((a, b, 0), (a, b, high), d / 3, m.sections()))
            else:
                r = 0.4 * high
                m.add(
                    BASE,
                    rod((a - d / 5, b, r), (a + d / 5, b, r), r, 12),
                    box((a - d / 4, a + d / 4), (b - r, b + r), (r, high)),
                )


def lathe(profile: Sequence[tuple[float, float]], n: int, at: Point = (0.0, 0.0, 0.0), caps: bool = True) -> Trimesh:
    """Turn a profile of (radius, height) about a vertical line; one that returns inside makes a vessel."""
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    rings = np.stack([np.c_[r * np.cos(t), r * np.sin(t), np.full(n, h)] for r, h in profile])
    return loft(rings + np.asarray(at, float), caps)


def fluted(radius: float, teeth: int, z: Span, at: Point = (0.0, 0.0, 0.0)) -> Trimesh:
    """A ribbed cylinder about a vertical line."""
    t = np.linspace(0, 2 * np.pi, 2 * teeth, endpoint=False)
    r = np.where(np.arange(2 * teeth) % 2, radius, 0.92 * radius)
    solid = prism(Polygon(np.c_[r * np.cos(t), r * np.sin(t)]), "z", z)
    solid.apply_translation(np.asarray(at, float))
    return solid
