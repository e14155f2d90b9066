"""Factory robots by another hand: jointed arms of boxes or tubes, a SCARA arm, a gantry; each with a hand or a tool."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString
from trimesh import Trimesh

from training.kinds.game_style import Look, bolts, look
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rectangle, rod, vec

Spot = tuple[float, float, float]


def industrial_manipulator(m: Model) -> None:
    """A robot arm: a chain of turning links, a SCARA arm, or sliding axes, with fingers, a cup or a welding tool."""
    a = look(m)
    m.pick(_boxy, _boxy, _tubes, _tubes, _scara, _gantry)(a)


def _foot(a: Look, size: float, tall: float) -> float:
    """A plate with bolts and a plinth; returns where the arm begins."""
    m = a.m
    plate = 0.04 * size
    a.put(
        BASE,
        a.block((-0.3 * size, 0.3 * size), (-0.3 * size, 0.3 * size), (0, plate))
        if m.chance(0.5)
        else rod((0, 0, 0), (0, 0, plate), 0.32 * size, a.n),
    )
    a.put(BASE, rod((0, 0, plate - 0.002), (0, 0, tall), m.number(0.17, 0.24) * size, a.n))
    if a.way in ("cad", "old"):
        a.put(BASE, *bolts((0, 0, plate), "z", 0.26 * size, 0.012 * size, 8))
    return tall


def _boxy(a: Look) -> None:
    """A turning column, two arm plates or beams, a forearm and a wrist of two or three axes."""
    m = a.m
    size = m.number(0.4, 1.6)
    z = _foot(a, size, m.number(0.15, 0.4) * size)
    w = m.number(0.09, 0.14) * size
    shoulder = (0.0, -m.number(0.0, 0.2) * size, z + m.number(0.25, 0.35) * size)
    a.put("column", rod((0, 0, z + 0.002), (0, 0, z + 0.12 * size), 0.22 * size, a.n))
    body = LineString([(0, z + 0.1 * size), (shoulder[1], shoulder[2])]).buffer(0.13 * size, quad_segs=2)
    outer = m.chance(0.5)
    a.put("column", *(prism(body, "x", (s * 1.05 * w, s * 1.7 * w)) for s in (-1, 1)) if outer else [prism(body, "x", (-w, w))])
    m.hinge("column", (0, 0, z), (0, 0, 1), (-m.number(150, 180), m.number(150, 180)))
    lean = m.number(-0.2, 0.3)
    elbow = (0.0, shoulder[1] + lean * size, shoulder[2] + m.number(0.7, 1.0) * size)
    arm = LineString([shoulder[1:], elbow[1:]]).buffer(0.11 * size, quad_segs=1 if a.way == "low" else 4)
    a.put(
        "upper_arm", *([prism(arm, "x", (-w, w))] if outer else [prism(arm, "x", (s * 1.05 * w, s * 1.5 * w)) for s in (-1, 1)])
    )
    pin = 1.75 * w
    a.put("column", rod((-pin, *shoulder[1:]), (pin, *shoulder[1:]), 0.07 * size, a.n))
    a.put("upper_arm", rod((-pin, *elbow[1:]), (pin, *elbow[1:]), 0.065 * size, a.n))
    m.hinge("upper_arm", shoulder, (1, 0, 0), (-m.number(40, 60), m.number(60, 90)), "column")
    reach = m.number(0.6, 0.95) * size
    wrist = np.array([0.0, elbow[1] - reach, elbow[2] + m.number(-0.15, 0.15) * size])
    fore = LineString(
        [(elbow[1] + 0.15 * size, elbow[2]), (elbow[1] - 0.45 * reach, elbow[2] + 0.45 * (wrist[2] - elbow[2]))]
    ).buffer(0.1 * size, quad_segs=2)
    a.put(
        "forearm", *([prism(fore, "x", (s * 1.05 * w, s * 1.5 * w)) for s in (-1, 1)] if outer else [prism(fore, "x", (-w, w))])
    )
    middle = np.array([0, elbow[1] - 0.45 * reach, elbow[2] + 0.45 * (wrist[2] - elbow[2])])
    way = (wrist - middle) / np.linalg.norm(wrist - middle)
    start = middle + 0.1 * size * way
    if outer:
        a.put(
            "forearm",
            rod(middle - 0.04 * size * way, start, 0.09 * size, a.n),
            box(
                (-1.2 * w, 1.2 * w),
                (middle[1] - 0.03 * size, middle[1] + 0.03 * size),
                (middle[2] - 0.05 * size, middle[2] + 0.05 * size),
            ),
        )
    m.hinge("forearm", elbow, (1, 0, 0), (-m.number(60, 100), m.number(60, 120)), "upper_arm")
    parent = "forearm"
    if m.chance(0.6):
        parent = "roll"
        m.hinge("roll", start, way, (-180, 180), "forearm")
    a.put(parent, rod(start + 0.002 * way, wrist, 0.055 * size, a.n))
    _wrist(a, wrist, parent, 0.055 * size)


def _tubes(a: Look) -> None:
    """Round joints with tubes beside each other, as arms that work beside people have."""
    m = a.m
    size, r = m.number(0.3, 0.9), m.number(0.07, 0.1)
    r *= size
    a.put(BASE, rod((0, 0, 0), (0, 0, 0.6 * r), 1.3 * r, a.n), rod((0, 0, 0.5 * r), (0, 0, 1.2 * r), r, a.n))
    z = 1.2 * r
    parent, at = BASE, np.array([0.0, 0.0, z])
    a.put("link_0", rod(at + vec(0, 0, 0.001), at + vec(0, 0, 1.9 * r), 0.98 * r, a.n), *_cap(a, at + vec(0, 0, 1.9 * r), r))
    m.hinge("link_0", at, (0, 0, 1), (-180, 180))
    parent, at = "link_0", at + vec(0, 0, 1.2 * r)
    side, direction = 1.0, np.array([0.0, 0.0, 1.0])
    lengths = [m.number(0.5, 0.7) * size, m.number(0.4, 0.6) * size] + [0.3 * size] * m.pick(0, 1)
    angles = np.cumsum([m.number(-20, 25), m.number(40, 80), m.number(20, 60)])
    for k, length in enumerate(lengths, 1):
        thin = r * 0.88**k
        hub = at + vec(side * (0.95 * r + thin), 0, 0)
        t = np.deg2rad(angles[k - 1])
        direction = np.array([0, -np.sin(t), np.cos(t)])
        name = f"link_{k}"
        end = hub + length * direction
        a.put(name, rod(hub - vec(side * thin, 0, 0), hub + vec(side * thin, 0, 0), thin, a.n), rod(hub, end, 0.8 * thin, a.n))
        a.put(name, rod(end - vec(thin, 0, 0), end + vec(thin, 0, 0), 0.95 * thin, a.n), *_cap(a, end, 0.95 * thin))
        m.hinge(name, hub, (1, 0, 0), (-m.number(90, 170), m.number(90, 170)), parent)
        parent, at, side, r = name, end, -side, thin
    hub = at + vec(side * 1.75 * r, 0, 0)
    a.put(
        "wrist",
        rod(hub - vec(0, 0, 1.2 * r), hub + vec(0, 0, r), 0.8 * r, a.n),
        rod(at + vec(side * 1.001 * r, 0, 0), hub, 0.75 * r, a.n),
    )
    m.hinge("wrist", hub, (1, 0, 0), (-120, 120), parent)
    _tool(a, hub - vec(0, 0, 1.2 * r), np.array([0, 0, -1.0]), "wrist", 0.8 * r)


def _cap(a: Look, at: np.ndarray, radius: float) -> list[Trimesh]:
    return [ball(at, [radius] * 3, max(a.n, 8))] if a.way in ("round", "old") else []


def _wrist(a: Look, at: np.ndarray, parent: str, r: float) -> None:
    """A pitching block and a turning flange."""
    a.put(
        "pitch",
        rod(at - vec(1.3 * r, 0, 0), at + vec(1.3 * r, 0, 0), 0.9 * r, a.n),
        rod(at, at - vec(0, 2.0 * r, 0), 0.7 * r, a.n),
    )
    a.m.hinge("pitch", at, (1, 0, 0), (-a.m.number(80, 115), a.m.number(80, 115)), parent)
    _tool(a, at - vec(0, 2.0 * r, 0), np.array([0, -1.0, 0]), "pitch", 0.75 * r)


def _tool(a: Look, at: np.ndarray, way: np.ndarray, parent: str, r: float) -> None:
    """A flange that turns and carries two fingers, a suction cup, a torch or nothing."""
    m = a.m
    a.put("flange", rod(at + 0.001 * way, at + 0.5 * r * way, r, a.n))
    m.hinge("flange", at, way, (-180, 180), parent)
    tip = at + 0.5 * r * way
    kind = m.pick("fingers", "fingers", "cup", "torch", "none")
    if kind == "fingers":
        cross = np.array([1.0, 0, 0])
        third = np.cross(way, cross)
        a.put("flange", _bar(tip - 0.01 * r * way, tip + 0.8 * r * way, cross * 1.6 * r + np.abs(third) * 0.7 * r))
        for k, s in enumerate((-1, 1)):
            root = tip + 0.8 * r * way + s * 1.2 * r * cross
            a.put(f"finger_{k}", _bar(root, root + 2.2 * r * way, cross * 0.25 * r + np.abs(third) * 0.4 * r))
            m.slide(f"finger_{k}", -s * cross, 0.85 * r, "flange")
    elif kind == "cup":
        a.put(
            "flange",
            rod(tip - 0.01 * r * way, tip + 1.5 * r * way, 0.3 * r, a.n),
            rod(tip + 1.4 * r * way, tip + 1.8 * r * way, 0.8 * r, a.n),
        )
    elif kind == "torch":
        bend = tip + 1.5 * r * way
        a.put(
            "flange",
            rod(tip - 0.01 * r * way, bend, 0.35 * r, a.n),
            rod(bend, bend + 1.5 * r * way - 0.9 * r * np.array([0, 0, 1.0]) * abs(way[1]), 0.2 * r, 8),
        )


def _bar(p: np.ndarray, q: np.ndarray, half: np.ndarray) -> Trimesh:
    """A box along the line between two points, half as wide as given across it."""
    low, high = np.minimum(p, q) - np.abs(half), np.maximum(p, q) + np.abs(half)
    return box(*((u, v) for u, v in zip(low, high, strict=True)))


def _scara(a: Look) -> None:
    """Two arms that turn level and a spindle that sinks and turns."""
    m = a.m
    size = m.number(0.3, 0.7)
    tall, w = m.number(0.5, 0.9) * size, 0.09 * size
    _foot(a, 0.7 * size, tall)
    one, two = m.number(0.4, 0.6) * size, m.number(0.35, 0.5) * size
    p, q = np.array([0, -one]), np.array([m.number(-0.1, 0.1) * size, -one - two])
    outline = LineString([(0, 0), p]).buffer(0.13 * size, quad_segs=2 if a.way == "low" else 6)
    a.put("first_arm", prism(outline, "z", (tall + 0.002, tall + w)))
    m.hinge("first_arm", (0, 0, tall), (0, 0, 1), (-m.number(110, 140), m.number(110, 140)))
    up = tall + w + 0.003
    outline = LineString([p, q]).buffer(0.11 * size, quad_segs=2 if a.way == "low" else 6)
    a.put("second_arm", prism(outline, "z", (up, up + w)))
    hood = m.number(2.5, 3.5) * w
    a.put("second_arm", prism(outline.buffer(-0.02 * size), "z", (up + w - 0.002, up + hood)))
    m.hinge("second_arm", (*p, up), (0, 0, 1), (-m.number(120, 150), m.number(120, 150)), "first_arm")
    reach, r = m.number(0.25, 0.4) * size, 0.03 * size
    top = np.array([*q, up + 4 * w])
    low = np.array([*q, up - 0.3 * w])
    a.put("spindle", rod(low, top, r, a.n))
    m.slide("spindle", (0, 0, -1), min(reach, 0.95 * hood), "second_arm")
    _tool(a, low, np.array([0, 0, -1.0]), "spindle", 1.6 * r)


def _gantry(a: Look) -> None:
    """A portal or a table with sliding axes along, across and down."""
    m = a.m
    half, long, tall = m.number(0.3, 0.9), m.number(0.4, 1.2), m.number(0.5, 1.2)
    t = 0.06 * tall + 0.02
    legs = [(sx * half, sy * long) for sx in (-1, 1) for sy in (-1, 1)]
    a.put(BASE, *(a.block((x - t, x + t), (y - t, y + t), (0, tall)) for x, y in legs))
    a.put(
        BASE, *(a.block((s * half - t, s * half + t), (-long - t, long + t), (tall - 0.001, tall + 1.5 * t)) for s in (-1, 1))
    )
    if m.chance(0.6):
        a.put(BASE, box((-half - t, half + t), (-long - t, long + t), (0.25 * tall, 0.25 * tall + t)))
    else:
        a.put(BASE, prism(rectangle((-half - t, half + t), (-long - t, long + t), 2 * t), "z", (0.0, t)))
    y, z = m.number(-0.3, 0.3) * long, tall + 1.5 * t + 0.002
    a.put("bridge", a.block((-half - t, half + t), (y - t, y + t), (z, z + 2 * t)))
    a.put("bridge", *(box((s * half - 1.2 * t, s * half + 1.2 * t), (y - 2 * t, y + 2 * t), (z, z + 0.5 * t)) for s in (-1, 1)))
    room = 0.95 * (long - t)
    m.slide("bridge", (0, 1, 0), (-room - y, room - y))
    reach = m.number(0.3, 0.5) * tall
    x, face = m.number(-0.3, 0.3) * half, y - t - 0.002
    a.put(
        "carriage", a.block((x - 1.5 * t, x + 1.5 * t), (face - 1.2 * t, face), (z - 0.3 * t, z + max(2.5 * t, 0.75 * reach)))
    )
    span = half - 2.8 * t
    m.slide("carriage", (1, 0, 0), (-span - x, span - x), "bridge")
    front = face - 1.2 * t - 0.002
    a.put("ram", box((x - 0.7 * t, x + 0.7 * t), (front - 1.2 * t, front), (z - 0.5 * t, z + reach)))
    m.slide("ram", (0, 0, -1), 0.75 * reach, "carriage")
    at = np.array([x, front - 0.6 * t, z - 0.5 * t])
    if m.chance(0.5):
        _tool(a, at, np.array([0, 0, -1.0]), "ram", 0.55 * t)
    else:
        a.put("ram", rod(at + vec(0, 0, 0.01), at - vec(0, 0, 1.5 * t), 0.3 * t, a.n))
