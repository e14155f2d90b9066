"""Gun turrets as game artists model them."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, loft, prism, rod, vec
from training.kinds.wheels import beam, lathe, upright

Vector = Float[np.ndarray, " 3"]
Outline = Float[np.ndarray, "n 2"]


def gun_turret(m: Model) -> None:
    """A turret that turns on a foot: of plates, a dome, an open mount with cheeks, or a pod of later days."""
    style = m.pick("plates", "dome", "cheeks", "pod")
    n, r = m.pick(8, 12, 20, 32), m.number(0.6, 1.2)
    foot = m.number(0.2, 0.8) * r
    _foot(m, r, foot, n)
    z, high = foot + 0.006 * r, m.number(0.6, 0.9) * r
    pivot = _house(m, style, r, z, high, n)
    m.spin("turret", (0, 0, z), (0, 0, 1))
    _barrels(m, style, r, pivot, n)
    top = z + high * (0.9 if style == "pod" else 1.0)
    if style in ("plates", "dome") and m.chance(0.65):
        _hatch(m, style, r, top, n)
    if style != "cheeks" and m.chance(0.4):
        a = vec(0.3 * r, 0.4 * r, z + 0.5 * high)
        m.add("turret", rod(a, a + vec(0, 0.05 * r, m.number(0.8, 1.4) * r), 0.015 * r, 6))


def _house(m: Model, style: str, r: float, z: float, high: float, n: int) -> Vector:
    """What turns on the foot; returns where the barrels pitch."""
    if style == "plates":
        k, c = m.number(0.7, 0.85), 0.55 * r
        low = np.array(
            [
                (c, -r),
                (r, -0.3 * r),
                (r, 0.6 * r),
                (0.6 * r, 1.1 * r),
                (-0.6 * r, 1.1 * r),
                (-r, 0.6 * r),
                (-r, -0.3 * r),
                (-c, -r),
            ]
        )
        m.add("turret", _tapered(low, k * low + (0, 0.1 * r), z, z + high))
        return vec(0, -0.93 * r, z + 0.45 * high)
    if style == "dome":
        m.add(
            "turret",
            lathe([(0, 0), (r, 0), (r, 0.3 * high), (0.85 * r, 0.7 * high), (0.5 * r, 0.95 * high), (0, high)], n, (0, 0, z)),
        )
        return vec(0, -0.82 * r, z + 0.42 * high)
    if style == "cheeks":
        m.add("turret", rod((0, 0, z), (0, 0, z + 0.12 * r), 0.9 * r, n))
        cheek = [(-0.5 * r, z + 0.1 * r), (0.5 * r, z + 0.1 * r), (0.25 * r, z + high), (-0.25 * r, z + high)]
        m.add("turret", *(prism(cheek, "x", (s * 0.5 * r, s * 0.62 * r)) for s in (-1, 1)))
        return vec(0, 0, z + 0.8 * high)
        if m.chance(0.5):
            m.add(
                "turret",
                box((-0.2 * r, 0.2 * r), (0.5 * r, 0.85 * r), (z + 0.3 * r, z + 0.36 * r)),
                box((-0.05 * r, 0.05 * r), (0.5 * r, 0.8 * r), (z + 0.1 * r, z + 0.31 * r)),
            )
    m.add(
        "turret",
        m.pick(
            ball((0, 0, z + 0.48 * high), (0.6 * r, 0.7 * r, 0.5 * high), n),
            box((-0.55 * r, 0.55 * r), (-0.6 * r, 0.7 * r), (z, z + 0.9 * high)),
        ),
    )
    m.add("turret", rod((0, 0, z), (0, 0, z + 0.2 * high), 0.4 * r, n))
    return vec(0, 0, z + 0.45 * high)


def _tapered(low: Outline, high: Outline, z0: float, z1: float) -> Trimesh:
    """A solid between two outlines of equal counts at two heights."""
    return loft(np.stack([np.c_[low, np.full(len(low), z0)], np.c_[high, np.full(len(high), z1)]]))


def _foot(m: Model, r: float, foot: float, n: int) -> None:
    """What stays: a drum, a block of concrete, a column on a plate, or legs."""
    form = m.pick("drum", "block", "column", "legs")
    if form == "drum":
        m.add(BASE, lathe([(0, 0), (m.number(1.1, 1.4) * r, 0), (1.05 * r, foot), (0, foot)], n))
    elif form == "block":
        wide = m.number(1.3, 1.8) * r
        m.add(BASE, box((-wide, wide), (-wide, wide), (0, 0.85 * foot)), rod((0, 0, 0.8 * foot), (0, 0, foot), 1.0 * r, n))
    elif form == "column":
        m.add(BASE, rod((0, 0, 0), (0, 0, 0.2 * foot), 1.2 * r, n), rod((0, 0, 0.1 * foot), (0, 0, foot), 0.55 * r, n))
        m.add(BASE, *around(rod((1.05 * r, 0, 0), (1.05 * r, 0, 0.26 * foot), 0.06 * r, 6), m.pick(6, 8)))
    else:
        m.add(BASE, rod((0, 0, 0.5 * foot), (0, 0, foot), 0.55 * r, n))
        leg = beam((0.35 * r, 0, 0.75 * foot), (m.number(1.2, 1.6) * r, 0, 0.03 * r), 0.16 * r, 0.12 * r, (0, 1, 0))
        m.add(BASE, *around(leg, m.pick(3, 4), 90))


def _barrels(m: Model, style: str, r: float, pivot: Vector, n: int) -> None:
    """One to four barrels on a shaft that pitch, beside a pod or between cheeks or through the front."""
    count, long, thin = m.pick(1, 2, 2, 3), m.number(1.2, 2.6) * r, m.number(0.06, 0.1) * r
    outside = style == "pod"
    reach = {"pod": 0.6 * r, "cheeks": 0.55 * r}.get(style, 0.5 * r)
    m.add("barrels", rod(pivot - vec(reach, 0, 0), pivot + vec(reach, 0, 0), 0.17 * r, max(n, 10)))
    if outside:
        xs = [s * 0.8 * r for s in (-1, 1)]
        for x in xs:
            m.add(
                "barrels",
                box(
                    (x - 0.2 * r, x + 0.2 * r),
                    (pivot[1] - 0.5 * r, pivot[1] + 0.6 * r),
                    (pivot[2] - 0.2 * r, pivot[2] + 0.2 * r),
                ),
            )
        start = pivot[1] - 0.45 * r
    else:
        xs = np.linspace(-0.3, 0.3, count) * r if count > 1 else [0.0]
        start = pivot[1]
        if style == "cheeks":
            m.add("barrels", box((-0.42 * r, 0.42 * r), (-0.3 * r, 0.4 * r), (pivot[2] - 0.14 * r, pivot[2] + 0.14 * r)))
    tip, sleeve = m.pick("plain", "brake", "flare"), m.chance(0.5)
    for x in xs:
        a, b = vec(x, start, pivot[2]), vec(x, start - long, pivot[2])
        m.add("barrels", rod(a, b, thin, n))
        if sleeve:
            m.add("barrels", rod(a, a + 0.45 * (b - a), 1.4 * thin, n))
        if tip == "brake":
            m.add("barrels", rod(b, b - vec(0, 0.2 * r, 0), 1.45 * thin, n))
        elif tip == "flare":
            m.add("barrels", *upright([lathe([(0, 0), (thin, 0), (1.6 * thin, 0.18 * r), (0, 0.18 * r)], n)], (0, -1, 0), b))
    m.hinge(
        "barrels", pivot, (-1, 0, 0), m.pick((-5, 30), (-10, 20)) if not outside else m.pick((-20, 60), (-10, 45)), "turret"
    )


def _hatch(m: Model, style: str, r: float, top: float, n: int) -> None:
    """A round or square lid on the roof, in some on a rim, in some with a handle or of two leaves."""
    q, y = m.number(0.17, 0.24) * r, 0.3 * r if style == "plates" else 0.0
    rim = top + m.pick(0.02, 0.1) * r
    low = top - (0.2 * r if style == "dome" else 0.02 * r)
    at = vec(0.0, y, rim)
    if m.chance(0.6):
        m.add("turret", rod((0, y, low), at, 1.12 * q, max(n, 10)))
        m.add("hatch", rod(at + vec(0, 0, 0.002 * r), at + vec(0, 0, 0.06 * r), q, max(n, 10)))
    else:
        m.add("turret", box((-1.12 * q, 1.12 * q), (y - 1.12 * q, y + 1.12 * q), (low, rim)))
        m.add("hatch", box((-q, q), (y - q, y + q), (rim + 0.002 * r, rim + 0.06 * r)))
    edge = at + vec(0, q, 0.02 * r)
    m.add("hatch", rod(edge - vec(0.4 * q, 0, 0), edge + vec(0.4 * q, 0, 0), 0.03 * r, 8))
    if m.chance(0.5):
        m.add("hatch", box((-0.3 * q, 0.3 * q), (y - 0.7 * q, y - 0.6 * q), (rim + 0.05 * r, rim + 0.09 * r)))
    m.hinge("hatch", edge, (-1, 0, 0), m.pick(95, 120), "turret")
