"""Hand tools: secateurs and shears, adjustable spanner."""

from __future__ import annotations

import numpy as np
from shapely import affinity
from shapely.geometry import LineString, Point, Polygon
from shapely.geometry import box as window
from shapely.ops import unary_union
from trimesh import Trimesh

from training.kinds.kitchen_trims import fluted
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, prism, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, upright


def secateurs(m: Model) -> None:
    """Secateurs with a hook or an anvil, long loppers, or hedge shears: two halves on a pivot, a spring, perhaps a latch."""
    style = m.pick("bypass", "anvil", "loppers", "shears")
    size = {"bypass": 1.0, "anvil": 1.0, "loppers": 1.6, "shears": 1.7}[style]
    long = {"bypass": 0.13, "anvil": 0.13, "loppers": m.number(0.45, 0.65), "shears": m.number(0.25, 0.4)}[style]
    t, z = 0.003 * size, 0.014 * size
    blade = 0.06 * size if style != "shears" else m.number(0.2, 0.28)
    for part, s, low in ((BASE, -1, z - t), ("blade", 1, z)):
        m.add(part, _jaw(m, style, part == BASE, blade, size, (low, low + t)))
        m.add(part, *_grip(m, style, s, long, size, z, low))
    m.add(m.pick(BASE, "blade"), rod((0, 0, z - 2 * t), (0, 0, z + 2.2 * t), 0.009 * size, m.pick(6, 12, 16)))
    m.hinge("blade", (0, 0, z), (0, 0, 1), m.number(28, 45) if style != "loppers" else m.number(35, 60))
    if style in ("bypass", "anvil"):
        if m.chance(0.7):
            path = [(-0.008 + 0.016 * (k % 2), -0.028 - 0.004 * k, z) for k in range(8)]
            m.add(BASE, tube(path, 0.0012, 6))
        if m.chance(0.6):
            at = vec(-0.014, -0.03, z + 2 * t)
            m.add(
                "latch",
                beam(at, at + vec(0.004, 0.032, 0), 0.008, 0.003, (1, 0, 0)),
                rod(at - (0, 0, 0.005), at + vec(0, 0, 0.004), 0.004, 8),
            )
            m.hinge("latch", at, (0, 0, 1), m.pick(40, 60))


def _jaw(m: Model, style: str, lower: bool, blade: float, size: float, z: Span) -> Trimesh:
    b, w = blade, 0.016 * size
    neck = Polygon([(-w, -w), (w, -w), (w, w), (-w, w)]).buffer(0.2 * w)
    if style == "shears":
        s = 1 if lower else -1
        shape = Polygon(
            [(-0.2 * s * w, 0), (s * 1.3 * w, 0.1 * b), (s * 1.1 * w, 0.7 * b), (-0.1 * s * w, b), (-0.25 * s * w, 0.9 * b)]
        )
    elif style == "anvil" and lower:
        shape = Polygon([(0.0, 0), (w, 0), (1.2 * w, b), (0.2 * w, b)])
    elif lower:
        shape = LineString([(0.8 * w, 0), (1.3 * w, 0.4 * b), (1.1 * w, 0.75 * b), (0.3 * w, b)]).buffer(0.35 * w)
    else:
        shape = Polygon([(0.8 * w, 0), (0.9 * w, 0.5 * b), (0.3 * w, b), (-0.7 * w, 0.75 * b), (-1.2 * w, 0.35 * b), (-w, 0)])
    return prism(unary_union([neck, shape]), "z", z)


def _grip(m: Model, style: str, s: int, long: float, size: float, z: float, low: float) -> list[Trimesh]:
    w, start, n = 0.012 * size, vec(s * 0.006 * size, -0.012 * size, z), m.pick(6, 8, 12)
    out = 0.02 if style in ("bypass", "anvil") else 0.07
    knee, end = start + vec(s * out, -0.25 * long, 0), start + vec(s * out * 0.9, -long, 0)
    tang = beam((0, 0, low + 0.0015 * size), (*knee[:2], low + 0.0015 * size), 0.018 * size, 0.003 * size, (1, 0, 0))
    if style in ("bypass", "anvil"):
        return [tang, tube([start, knee, (knee + end) / 2 + vec(s * 0.004, 0, 0), end], 0.0085, n)]
    hold = end + (knee - end) * 0.35
    return [tang, rod(knee, hold, 0.5 * w, n), rod(hold, end, 0.8 * w, n), ball(end, (0.8 * w,) * 3, 8)]


def adjustable_spanner(m: Model) -> None:
    """A spanner whose jaw slides as a worm turns: angled or straight head, plain, sunk or sleeved handle; or a pipe wrench."""
    size = m.number(0.7, 1.6)
    if m.chance(0.3):
        _pipe_wrench(m, size)
        return
    s, lean, t = size, m.pick(15, 22, 30), 0.012 * size
    long, z = m.number(0.15, 0.22) * s, (0.0, t)
    worm = window(-0.017 * s, -0.013 * s, 0.003 * s, 0.001 * s)
    head = Polygon(
        [
            (-0.02 * s, 0.012 * s),
            (-0.024 * s, -0.012 * s),
            (-0.01 * s, -0.03 * s),
            (0.012 * s, -0.03 * s),
            (0.022 * s, -0.01 * s),
        ]
    )
    fixed = Polygon([(0.0, 0.01 * s), (0.02 * s, -0.012 * s), (0.024 * s, 0.01 * s), (0.015 * s, 0.045 * s), (0.0, 0.048 * s)])
    head = unary_union([head.buffer(0.004 * s, quad_segs=3), fixed]).difference(worm)
    m.add(BASE, prism(affinity.rotate(head, -lean, origin=(0, 0)), "z", z))
    _spanner_handle(m, s, long, t)
    jaw = Polygon([(-0.001, 0.017 * s), (-0.001, 0.048 * s), (-0.012 * s, 0.044 * s), (-0.02 * s, 0.017 * s)])
    pieces = [prism(jaw, "z", (0.0, t)), prism(window(-0.022 * s, 0.013 * s, 0.0, 0.019 * s), "z", (0.15 * t, 0.85 * t))]
    teeth = [window(x, 0.001 * s, x + 0.0016 * s, 0.004 * s) for x in np.arange(-0.02, 0.0, 0.0032) * s]
    rack = unary_union([window(-0.022 * s, 0.003 * s, 0.0, 0.015 * s), *teeth])
    pieces.append(prism(rack, "z", (-0.04 * t, 1.04 * t)))
    m.add("jaw", *(turned(p, (0, 0, 1), -lean, (0, 0, 0)) for p in pieces))
    way = vec(-np.cos(np.deg2rad(lean)), np.sin(np.deg2rad(lean)), 0)
    m.slide("jaw", way, m.number(0.016, 0.021) * s)
    center = vec(-0.007 * s, -0.006 * s, t / 2)
    ribs = [
        fluted(0.0058 * s, m.pick(8, 12), (-0.008 * s, 0.008 * s)),
        rod((0, 0, -0.0105 * s), (0, 0, 0.0105 * s), 0.002 * s, 8),
    ]
    m.add("worm", *(turned(p, (0, 0, 1), -lean, (0, 0, 0)) for p in upright(ribs, (1, 0, 0), center)))
    spot = turned(Trimesh([center], process=False), (0, 0, 1), -lean, (0, 0, 0)).vertices[0]
    m.spin("worm", spot, way)


def _spanner_handle(m: Model, s: float, long: float, t: float) -> None:
    style, w, end = m.pick("plain", "sunk", "sleeve"), 0.009 * s, -0.02 * s - long
    shape = Polygon([(-w, -0.02 * s), (w, -0.02 * s), (1.4 * w, end), (-1.4 * w, end)]).union(Point(0, end).buffer(1.4 * w))
    hole = Point(0, end).buffer(0.6 * w, quad_segs=4)
    shape = shape.difference(hole) if m.chance(0.7) else shape
    z = (0.1 * t, 0.9 * t)
    if style != "sunk":
        m.add(BASE, prism(shape, "z", z))
    else:
        m.add(BASE, prism(shape, "z", (0.35 * t, 0.65 * t)))
        inner = window(-0.6 * w, end + 0.03 * s, 0.6 * w, -0.04 * s).buffer(0.2 * w)
        m.add(BASE, prism(shape.difference(inner), "z", z))
    if style == "sleeve":
        grip = rounded((-1.6 * w, 1.6 * w), (end - 1.6 * w, -0.35 * long), 1.2 * w)
        m.add(BASE, prism(grip, "z", (-0.2 * t, 1.2 * t)))
        ridges = np.linspace(end + 0.01 * s, -0.45 * long, m.pick(4, 6, 8))
        m.add(BASE, *(box((-1.7 * w, 1.7 * w), (y, y + 0.003 * s), (-0.28 * t, 1.28 * t)) for y in ridges))


def _pipe_wrench(m: Model, s: float) -> None:
    long, t = m.number(0.2, 0.35) * s, 0.018 * s
    w = 0.011 * s
    handle = Polygon([(-w, -0.02 * s), (w, -0.02 * s), (1.1 * w, -long), (-1.1 * w, -long)]).union(
        Point(0, -long).buffer(1.1 * w)
    )
    m.add(BASE, prism(handle.difference(Point(0, -long).buffer(0.5 * w)), "z", (0.15 * t, 0.85 * t)))
    heel = Polygon(
        [(-0.018 * s, -0.03 * s), (0.016 * s, -0.03 * s), (0.03 * s, 0.02 * s), (0.03 * s, 0.034 * s), (-0.018 * s, 0.034 * s)]
    )
    m.add(BASE, prism(heel.difference(window(-0.012 * s, -0.014 * s, 0.04 * s, 0.004 * s)), "z", (0.0, t)))
    m.add(BASE, *(box((0.004 * s, 0.032 * s), (0.034 * s, 0.04 * s), c) for c in ((0.0, t),)))
    shank = box((-0.008 * s, 0.002 * s), (-0.045 * s, 0.08 * s), (0.2 * t, 0.8 * t))
    hook = Polygon(
        [
            (-0.012 * s, 0.05 * s),
            (-0.012 * s, 0.085 * s),
            (0.02 * s, 0.082 * s),
            (0.036 * s, 0.062 * s),
            (0.036 * s, 0.046 * s),
            (0.006 * s, 0.046 * s),
            (0.004 * s, 0.05 * s),
        ]
    )
    m.add("jaw", shank, prism(hook, "z", (0.0, t)))
    teeth = np.linspace(0.008, 0.032, m.pick(5, 7)) * s
    m.add("jaw", *(box((x, x + 0.002 * s), (0.043 * s, 0.046 * s), (0.05 * t, 0.95 * t)) for x in teeth))
    m.slide("jaw", (0, 1, 0), m.number(0.025, 0.035) * s)
    nut = upright([fluted(0.0125 * s, m.pick(10, 14), (-0.008 * s, 0.008 * s))], (0, 1, 0), (-0.003 * s, -0.005 * s, t / 2))
    m.add("nut", *nut)
    m.spin("nut", (-0.003 * s, -0.005 * s, t / 2), (0, 1, 0))
