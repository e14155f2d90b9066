"""Submarines."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, box, prism, rectangle, ring, rod, rounded, vec
from training.kinds.wheels import beam, lathe, upright


def propeller(m: Model, part: str, at: Point, axis: Point, radius: float, parent: str = BASE) -> None:
    """A hub with blades, straight or broad."""
    count, broad = m.pick(2, 3, 4, 5), m.chance(0.5)
    hub = lathe([(0, -0.14 * radius), (0.16 * radius, -0.14 * radius), (0.14 * radius, 0.12 * radius), (0, 0.3 * radius)], 12)
    solids = [hub]
    for k in range(count):
        a = 2 * np.pi * k / count
        c, s = np.cos(a), np.sin(a)
        side = np.array([-s, c, 0]) + np.array([0, 0, m.pick(0.4, 0.7)])
        wide = (0.42 if broad else 0.2) * radius
        solids.append(
            beam((0.08 * radius * c, 0.08 * radius * s, 0), (radius * c, radius * s, 0), wide, 0.03 * radius, side, 0.8)
        )
    m.add(part, *upright(solids, axis, at))
    m.spin(part, at, axis, parent)


def tail_fin(m: Model, name: str, root: np.ndarray, out: np.ndarray, size: Point, thick: float, moves: bool) -> None:
    """A fin that stands out from a hull, with a flap at its rear edge; size: (root length, span, flap length)."""
    long, span, flap = size
    side = np.cross(out, vec(0, 1, 0))
    for part, outline in (
        (BASE, [(0, -0.1 * span), (0.35 * long, span), (long, span), (long, -0.1 * span)]),
        (
            name if moves else BASE,
            [
                (1.02 * long, 0.08 * span),
                (1.02 * long, span),
                (1.02 * long + 0.8 * flap, span),
                (1.02 * long + flap, 0.08 * span),
            ],
        ),
    ):
        solid = prism(outline, "z", (-thick / 2, thick / 2))
        v = solid.vertices
        solid.vertices = root + np.outer(v[:, 0], (0, 1, 0)) + np.outer(v[:, 1], out) + np.outer(v[:, 2], side)
        if solid.volume < 0:
            solid.invert()
        m.add(part, solid)
    if moves:
        m.hinge(name, root + vec(0, 1.02 * long, 0) + 0.5 * span * out, out, (-30, 30))


def _sail(m: Model, y: float, z: float, r: float) -> None:
    """The tower with its planes, hatch, masts that rise, windows and rails."""
    long, half, top = m.number(1.1, 1.7) * r, m.number(0.2, 0.3) * r, z + m.number(0.7, 1.1) * r
    a = np.linspace(0, 2 * np.pi, 20, endpoint=False)
    outline = (
        Polygon(np.c_[half * np.sin(a), y + long / 2 * np.cos(a)])
        if m.chance(0.6)
        else rounded((-half, half), (y - long / 2, y + long / 2), 0.9 * half)
    )
    m.add(BASE, prism(outline, "z", (z - 0.35 * r, top)))
    for k in range(m.pick(1, 2, 3)):
        c, part = y + (0.02 + 0.13 * k) * long, f"mast_{k}"
        w, h = m.number(0.035, 0.06) * r, m.number(0.25, 0.6) * r
        m.add(
            part,
            rod((0, c, 0.45 * z + 0.55 * top), (0, c, top + h), w, 10),
            box((-1.1 * w, 1.1 * w), (c - 2.2 * w, c + w), (top + h - 2.5 * w, top + h + 0.3 * w)),
        )
        m.slide(part, (0, 0, 1), m.number(0.3, 0.4) * (top - z))
    if m.chance(0.6):
        w, c = 0.45 * half, y - 0.3 * long
        m.add(BASE, rod((0, c, top - 0.02 * r), (0, c, top + 0.03 * r), w, 14))
        m.add("sail_hatch", rod((0, c, top + 0.032 * r), (0, c, top + 0.07 * r), 1.08 * w, 14))
        m.hinge("sail_hatch", (0, c + 1.08 * w, top + 0.035 * r), (-1, 0, 0), m.pick(90, 110))
    if m.chance(0.6):
        for s in (-1, 1):
            name, c, h = f"sail_plane_{'lr'[s > 0]}", y - 0.1 * long, z + 0.55 * (top - z)
            blade = [
                (s * 1.02 * half, c - 0.18 * long),
                (s * (half + 0.6 * r), c - 0.08 * long),
                (s * (half + 0.6 * r), c + 0.14 * long),
                (s * 1.02 * half, c + 0.18 * long),
            ]
            m.add(
                name,
                prism(blade, "z", (h - 0.03 * r, h + 0.03 * r)),
                rod((s * 0.7 * half, c, h), (s * 1.1 * half, c, h), 0.025 * r, 8),
            )
            m.hinge(name, (s * half, c, h), (1, 0, 0), (-25, 25))
    if m.chance(0.4):
        m.add(BASE, *(ring((0, c, top), (0, 1, 0), 0.5 * half, 0.015 * r, 12) for c in (y + 0.25 * long, y + 0.4 * long)))


def hull_profile(long: float, r: float, nose: float, tail: float, n: int) -> list[tuple[float, float]]:
    """Radius by length of a hull with a round nose and a pointed tail."""
    a = np.linspace(0, np.pi / 2, n)
    front = [(r * np.sin(t) ** 0.9, nose * (1 - np.cos(t))) for t in a]
    back = [(r * np.cos(t) ** 1.1, long - tail + tail * np.sin(t)) for t in np.linspace(0, 0.47 * np.pi, n)]
    return [(0.0, 0.0), *front[1:], *back, (0.0, back[-1][1])]


def submarine(m: Model) -> None:
    """A boat that dives: hull, tower with masts, planes and rudders at its tail, a screw, hatches; or a small round one."""
    small = m.chance(0.4)
    r = m.number(0.8, 1.2) if small else m.number(1.6, 2.6)
    long = r * (m.number(3.2, 4.5) if small else m.number(9, 14))
    n, nose, tail = m.pick(8, 12, 16), m.pick(1.0, 1.4) * r, m.number(1.6, 2.2) * r if small else m.number(3, 4.5) * r
    m.add(BASE, *upright([lathe(hull_profile(long, r, nose, tail, n), max(m.sections(), 16))], (0, 1, 0), (0, 0, 0)))
    _sail(m, m.number(0.3, 0.42) * long, r, r)
    size, root = (0.9 * r, 0.75 * r, 0.4 * r), long - 0.55 * tail
    begin, cross = 0.42 * r, m.pick(0, 0, 45)
    for k in range(4):
        a = np.deg2rad(90 * k + cross)
        out = vec(np.cos(a), 0, np.sin(a))
        tail_fin(m, f"rudder_{k}", vec(0, root, 0) + begin * out, out, size, 0.07 * r, True)
    end = long - 0.02 * tail
    propeller(m, "screw", (0, end + 0.1 * r, 0), (0, 1, 0), m.number(0.55, 0.8) * r)
    m.add(BASE, rod((0, end - 0.4 * r, 0), (0, end + 0.05 * r, 0), 0.1 * r, 12))
    if not small and m.chance(0.5):
        m.add(BASE, prism(rounded((-0.4 * r, 0.4 * r), (1.5 * r, long - 1.2 * tail), 0.35 * r), "z", (0.85 * r, 1.04 * r)))
    for k, c in enumerate(np.linspace(0.5 * long, 0.68 * long, 0 if small else m.pick(0, 1, 2))):
        w, z = 0.18 * r, 1.05 * r
        m.add(BASE, rod((0, c, 0.9 * r), (0, c, z), w, 14))
        m.add(
            f"hatch_{k}",
            rod((0, c, z + 0.003), (0, c, z + 0.06 * r), 1.1 * w, 14),
            rod((0, c, z), (0, c, z + 0.1 * r), 0.3 * w, 8),
        )
        m.hinge(f"hatch_{k}", (0, c + 1.1 * w, z), (-1, 0, 0), m.pick(90, 110))
    _boat_trims(m, long, r, nose, small)


def _small_trims(m: Model, long: float, r: float) -> None:
    """Portholes, skids and thrusters of a small boat."""
    m.add(
        BASE,
        *(
            p
            for s in (-1, 1)
            for c in np.linspace(0.3, 0.6, m.pick(2, 3)) * long
            for p in (
                rod((s * 0.9 * r, c, 0.15 * r), (s * 1.03 * r, c, 0.15 * r), 0.18 * r, 14),
                ring((s * 1.0 * r, c, 0.15 * r), (1, 0, 0), 0.2 * r, 0.035 * r, 16),
            )
        ),
    )
    m.add(
        BASE,
        *(rod((s * 0.55 * r, 0.2 * long, -1.2 * r), (s * 0.55 * r, 0.7 * long, -1.2 * r), 0.06 * r, 8) for s in (-1, 1)),
        *(
            rod((s * 0.5 * r, c * long, -0.8 * r), (s * 0.55 * r, c * long, -1.2 * r), 0.05 * r, 8)
            for s in (-1, 1)
            for c in (0.28, 0.58)
        ),
    )
    for s in (-1, 1) if m.chance(0.6) else ():
        at = vec(s * 1.35 * r, 0.62 * long, 0)
        m.add(BASE, beam((s * 0.85 * r, at[1], 0), (s * 1.2 * r, at[1], 0), 0.1 * r, 0.2 * r, (0, 0, 1)))
        m.add(
            BASE,
            *upright(
                [lathe([(0.24 * r, 0), (0.28 * r, 0), (0.25 * r, 0.3 * r), (0.22 * r, 0.3 * r), (0.24 * r, 0)], 16)],
                (0, 1, 0),
                at - (0, 0.1 * r, 0),
            ),
            box((at[0] - 0.24 * r, at[0] + 0.24 * r), (at[1] - 0.08 * r, at[1] - 0.03 * r), (-0.03 * r, 0.03 * r)),
        )
        propeller(m, f"thruster_{'lr'[s > 0]}", at + vec(0, 0.06 * r, 0), (0, 1, 0), 0.2 * r)


def _boat_trims(m: Model, long: float, r: float, nose: float, small: bool) -> None:
    """Portholes, a window, bow planes, thrusters, skids or a cradle."""
    if small:
        _small_trims(m, long, r)
        return
    if m.chance(0.5):
        for s in (-1, 1):
            name, c = f"bow_plane_{'lr'[s > 0]}", 1.2 * nose
            blade = [
                (s * 1.0 * r, c - 0.3 * r),
                (s * 1.55 * r, c - 0.15 * r),
                (s * 1.55 * r, c + 0.2 * r),
                (s * 1.0 * r, c + 0.3 * r),
            ]
            m.add(name, prism(blade, "z", (-0.04 * r, 0.04 * r)), rod((s * 0.85 * r, c, 0), (s * 1.1 * r, c, 0), 0.035 * r, 8))
            m.hinge(name, (s * r, c, 0), (1, 0, 0), (-25, 25))
    if m.chance(0.3):
        m.add(
            BASE,
            *(
                prism(rectangle((-0.9 * r, 0.9 * r), (-1.4 * r, -0.55 * r)), "y", (c - 0.1 * r, c + 0.1 * r))
                for c in (0.3 * long, 0.6 * long)
            ),
        )
