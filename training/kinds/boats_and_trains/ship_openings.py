"""Hatches, watertight doors and portholes of ships."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot
from shapely.geometry import Polygon

from training.kinds.doors.lying_doors import leaned, lying_pull
from training.kinds.kitchen_trims import lever
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, moved, prism, rectangle, ring, rod, rounded, tube, turned, vec


def ship_hatch(m: Model) -> None:
    """A hatch on a deck or a watertight door in a bulkhead: round or rounded, with a wheel, dogs or swing bolts."""
    upright = m.chance(0.5)
    shape = m.pick("oval", "oval", "round") if upright else m.pick("round", "square", "oval")
    half, long = m.number(0.3, 0.45), m.number(0.6, 0.9) if upright else m.number(0.4, 0.6)
    long = half if shape == "round" else long
    corner = {"round": 0.98 * half, "oval": 0.6 * half, "square": 0.25 * half}[shape]
    n, t, high = m.pick(4, 6, 8), m.number(0.03, 0.06), m.number(0.03, 0.09) if upright else m.number(0.1, 0.35)
    lid = rounded((-half, half), (-long, long), corner, n)
    side, wall = m.pick(-1, 1), m.number(0.2, 0.5)
    plate = rectangle((-half - wall, half + wall), (-long - wall, long + wall))
    hole, solid = lid.buffer(-0.05), m.chance(0.2)
    m.add(BASE, prism(plate if solid else plate.difference(hole), "z", (-0.02, 0)))
    m.add(BASE, prism(lid.buffer(-0.02).difference(hole), "z", (0, high)))
    for c in np.linspace(-half - wall, half + wall, m.pick(3, 5)) if m.chance(0.5) else ():
        m.add(
            BASE,
            box((c - 0.01, c + 0.01), (-long - wall, long + wall), (-0.1, -0.02))
            if abs(c) > half
            else box((c - 0.01, c + 0.01), (long, long + wall), (-0.1, -0.02)),
        )
    z = (high + 0.001, high + t)
    m.add("lid", prism(lid, "z", z))
    if m.chance(0.6):
        m.add("lid", prism(lid.buffer(-0.06).difference(lid.buffer(-0.09)), "z", (z[1], z[1] + 0.012)))
    if m.chance(0.4):
        m.add(
            "lid",
            *(box((-0.8 * half, 0.8 * half), (c - 0.008, c + 0.008), (z[1], z[1] + 0.02)) for c in (-0.45 * long, 0.45 * long)),
        )
    _hatch_hinges(m, long, shape, half, side, z)
    m.hinge("lid", (side * (half + 0.05), 0, z[1]), (0, side, 0), m.number(100, 165))
    closing = m.pick("wheel", "wheel", "dogs", "both", "bow")
    if closing in ("wheel", "both"):
        hatch_wheel(m, "wheel", (0, 0, z[1]), m.number(0.35, 0.6) * half, "lid")
    elif closing == "bow" or m.chance(0.4):
        lying_pull(m, "lid", (-side * 0.6 * half, 0), z[1], "y")
    if closing in ("dogs", "both"):
        _dogs(m, lid, (half, long), z[1], side)
    if upright:
        leaned(m, 90, (0.0, 0.0, long + wall))


def _hatch_hinges(m: Model, long: float, shape: str, half: float, side: int, z: Span) -> None:
    """Hinges with arms on the lid and eyes on the deck."""
    for b in m.pick((-0.4, 0.4), (-0.5, 0.0, 0.5)):
        c = b * (long if shape != "round" else 0.5 * long)
        m.add("lid", box((side * 0.7 * half, side * (half + 0.05)), (c - 0.025, c + 0.025), (z[1] - 0.005, z[1] + 0.015)))
        at = side * (half + 0.05)
        m.add("lid", rod((at, c - 0.026, z[1]), (at, c + 0.026, z[1]), 0.018, 10))
        m.add(BASE, *(rod((at, c + e * 0.028, z[1]), (at, c + e * 0.056, z[1]), 0.018, 10) for e in (-1, 1)))
        m.add(
            BASE,
            *(
                box((side * (half + 0.03), side * (half + 0.07)), (d - 0.01, d + 0.01), (0, z[1]))
                for d in (c - 0.045, c + 0.045)
            ),
        )


def _dogs(m: Model, lid: object, size: tuple[float, float], z: float, side: int) -> None:
    """Clamp levers on the lid's edge that turn on pins of the frame."""
    half, long = size
    places = [(-side, b) for b in m.pick((-0.5, 0.5), (-0.6, 0.0, 0.6))] + [(0, -1), (0, 1)]
    for k, (a, b) in enumerate(places):
        at = vec(a * (half + 0.045), b * (long + (0.045 if a == 0 else 0)), 0)
        inward = vec(-a, 0, 0) if a else vec(0, -b, 0)
        m.add(BASE, rod(at, at + vec(0, 0, z + 0.025), 0.014, 8))
        top = at + vec(0, 0, z + 0.012)
        lever(m, f"dog_{k}", top - 0.02 * inward, top + 0.1 * inward, 0.022)
        m.add(f"dog_{k}", rod(top - vec(0, 0, 0.01), top + vec(0, 0, 0.03), 0.024, 10))
        m.hinge(f"dog_{k}", top, (0, 0, m.pick(-1, 1)), m.pick(90, 100))


def hatch_wheel(m: Model, part: str, at: tuple[float, float, float], radius: float, parent: str) -> None:
    """A hand wheel over a lying face, on a hub, that spins."""
    x, y, z = at
    rise, n, spokes = m.number(0.05, 0.09), m.pick(16, 24, 32), m.pick(3, 4, 5, 6)
    m.add(parent, rod(at, (x, y, z + 0.4 * rise), 0.3 * radius, n))
    m.add(part, rod((x, y, z + 0.4 * rise), (x, y, z + rise + 0.012), 0.16 * radius, n))
    m.add(part, ring((x, y, z + rise), (0, 0, 1), radius, 0.07 * radius, n))
    out = m.pick(1.0, 1.0, 1.3)
    for a in 2 * np.pi * np.arange(spokes) / spokes:
        d = vec(np.cos(a), np.sin(a), 0)
        m.add(part, rod(vec(x, y, z + rise), vec(x, y, z + rise) + out * radius * d, 0.055 * radius, 8))
    m.spin(part, (x, y, z), (0, 0, 1), parent)


def porthole_wall(m: Model) -> None:
    """A ship's wall with round or rounded windows: a glass in a hinged ring, a blind cover behind or before it, wing screws."""
    rows, cols, r = m.pick(1, 1, 2), m.pick(1, 2, 3, 4), m.number(0.13, 0.24)
    pitch, n = r * m.number(3.2, 4.5), m.pick(16, 24, 32)
    shape = m.pick("round", "round", "round", "oblong")
    tall = r * (m.number(1.3, 1.7) if shape == "oblong" else 1.0)
    wide, high = (cols - 1) * pitch + 2 * r * m.number(2.0, 3.0), (rows - 1) * 1.3 * pitch + 2 * tall * m.number(1.8, 3.0)
    skin, thick = m.pick("flat", "flat", "planks", "ribs"), m.number(0.01, 0.06)

    def outline(by: float) -> Polygon:
        if shape == "round":
            return Spot(0, 0).buffer(r + by, quad_segs=n // 4)
        return rounded((-r - by, r + by), (-tall - by, tall + by), 0.6 * r + 0.5 * by)

    places = [
        ((c - (cols - 1) / 2) * pitch, high / 2 + (k - (rows - 1) / 2) * 1.3 * pitch) for k in range(rows) for c in range(cols)
    ]
    plate = rectangle((-wide / 2, wide / 2), (0, high))
    for a, b in places:
        plate = plate.difference(Polygon([(p + a, q + b) for p, q in outline(0.005).exterior.coords]))
    m.add(BASE, prism(plate, "y", (0, thick)))
    if skin == "planks":
        _planked(m, high, plate, wide)
    elif skin == "ribs":
        m.add(
            BASE,
            *(
                box((c - 0.015, c + 0.015), (thick, thick + 0.1), (0, high))
                for c in (np.arange(cols + 1) - cols / 2) * pitch
                if abs(c) < wide / 2
            ),
        )
    if m.chance(0.4):
        m.add(
            BASE,
            *(
                rod((s * (wide / 2 - 0.03), -0.006, b), (s * (wide / 2 - 0.03), 0.0, b), 0.01, 8)
                for s in (-1, 1)
                for b in np.arange(0.05, high, 0.1)
            ),
        )
    how = {
        "side": m.pick("left", "right", "top"),
        "cover": m.chance(0.45),
        "dogs": m.pick(0, 1, 2, 3),
        "fixed": m.chance(0.2),
        "bolts": m.pick(0, 8, 12),
    }
    for k, at in enumerate(places):
        _porthole(m, k, at, (outline, r, tall, n), how)


def _planked(m: Model, high: float, plate: Polygon, wide: float) -> None:
    """Planks on the wall, clear of the windows."""
    far = plate.buffer(-0.05)
    for b in np.arange(0.0, high, 0.13):
        band = far.intersection(rectangle((-wide / 2, wide / 2), (b, b + 0.12)))
        m.add(
            BASE,
            *(prism(g, "y", (-0.008, 0)) for g in getattr(band, "geoms", [band]) if isinstance(g, Polygon) and g.area > 1e-4),
        )


def _porthole(m: Model, k: int, at: tuple[float, float], size: tuple, how: dict) -> None:
    """One window at the front of the wall: flange, hinged glass, perhaps a hinged cover over it, and screws that swing."""
    outline, r, tall, _ = size
    a, b = at
    rim = m.number(0.03, 0.04) if k == 0 else 0.035
    begin = len(m.pieces)
    m.add(BASE, prism(outline(rim).difference(outline(-0.012)), "y", (-0.014, 0.0)))
    m.add(BASE, prism(outline(0.004).difference(outline(-0.012)), "y", (0.0, 0.05)))
    for c in np.arange(how["bolts"]) * 2 * np.pi / how["bolts"] if how["bolts"] and tall == r else ():
        p = (r + 0.8 * rim) * np.array([np.cos(c), np.sin(c)])
        m.add(BASE, rod((p[0], -0.018, p[1]), (p[0], -0.014, p[1]), 0.006, 6))
    glass, y = (BASE if how["fixed"] and how["cover"] else f"window_{k}"), (-0.034, -0.0155)
    m.add(glass, prism(outline(0.012).difference(outline(-0.022)), "y", y), prism(outline(-0.02), "y", (-0.028, -0.022)))
    side = how["side"]
    toward = {"left": vec(1, 0, 0), "right": vec(-1, 0, 0), "top": vec(0, 0, -1)}[side]
    hinge = vec(0, y[0], 0) - toward * ((tall if side == "top" else r) + 0.028)
    joints = {}
    if glass != BASE:
        _lug(m, glass, hinge, toward, y)
        joints[glass] = (hinge, np.cross(toward, (0, -1, 0)), m.number(95, 150) if side != "top" else m.number(80, 120))
    if how["cover"]:
        other = toward if side == "top" or m.chance(0.3) else -toward
        cover, depth = f"cover_{k}", (-0.05, -0.0355)
        m.add(cover, prism(outline(0.008), "y", depth))
        if m.chance(0.6):
            m.add(cover, prism(outline(-0.03).difference(outline(-0.05)), "y", (depth[0] - 0.006, depth[0])))
        pivot = vec(0, depth[0], 0) - other * ((tall if side == "top" else r) + (0.028 if other is not toward else 0.05))
        _lug(m, cover, pivot, other, depth)
        joints[cover] = (pivot, np.cross(other, (0, -1, 0)), m.number(95, 130))
    front = -0.05 if how["cover"] else y[0]
    _screws(m, k, size, how, toward, front, joints)
    for _, solid in m.pieces[begin:]:
        moved(solid, (a, 0, b))
    for part, (origin, axis, degrees) in joints.items():
        m.hinge(part, origin + vec(a, 0, b), axis, degrees)


def _screws(m: Model, k: int, size: tuple, how: dict, toward: np.ndarray, front: float, joints: dict) -> None:
    """Wing screws that hold a window and swing out."""
    _, r, tall, _ = size
    for i, c in enumerate(np.linspace(-1, 1, how["dogs"]) * 0.9 if how["dogs"] > 1 else [0.0] * how["dogs"]):
        d = turned(rod((0, 0, 0), toward, 0.01, 4), (0, 1, 0), np.rad2deg(c), (0, 0, 0)).vertices.mean(0) * 2
        edge = r + 0.024 if tall == r or abs(d[0]) > 0.7 else tall + 0.024
        foot = vec(d[0] * edge, -0.02, d[2] * edge)
        part = f"screw_{k}_{i}"
        m.add(
            BASE,
            *(
                rod(
                    foot + s * np.cross(d, (0, 1, 0)) * 0.014 - vec(0, 0.008, 0),
                    foot + s * np.cross(d, (0, 1, 0)) * 0.008 - vec(0, 0.008, 0),
                    0.01,
                    8,
                )
                for s in (-1, 1)
            ),
        )
        head = foot + vec(0, front - 0.03 + 0.02, 0)
        m.add(part, rod(foot - vec(0, 0.005, 0), head, 0.006, 8), rod(head + vec(0, 0.012, 0), head, 0.013, 10))
        wing = np.cross(d, (0, 1, 0)) * 0.026
        m.add(part, tube([head - wing - vec(0, 0.012, 0), head, head + wing - vec(0, 0.012, 0)], 0.005, 6))
        joints[part] = (foot - vec(0, 0.008, 0), np.cross((0, -1, 0), d), m.number(80, 100))


def _lug(m: Model, part: str, hinge: np.ndarray, toward: np.ndarray, y: Span) -> None:
    """Knuckles at a hinge: one pair on the wall, one on the leaf."""
    along = np.abs(np.cross(toward, (0, 1, 0)))
    m.add(part, rod(hinge - 0.018 * along, hinge + 0.018 * along, 0.009, 10))
    low, high = hinge - 0.015 * along, hinge + 0.015 * along + 0.034 * toward
    p = np.sort(np.c_[low, high], axis=1)
    m.add(part, box(tuple(p[0]), (y[0], y[1] - 0.002), tuple(p[2])))
    for s in (-1, 1):
        c = hinge + s * 0.027 * along
        m.add(BASE, rod(c - 0.008 * along, c + 0.008 * along, 0.01, 10))
        q = np.sort(np.c_[c - 0.008 * along - 0.006 * toward, c + 0.008 * along + 0.006 * toward], axis=1)
        m.add(BASE, box(tuple(q[0]), (hinge[1], -0.0), tuple(q[2])))
