"""A roller coaster car of one artist."""

from __future__ import annotations

from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.arena_style import Look, look, superbox
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rod, tube, vec


def roller_coaster_car(m: Model) -> None:
    """A tub, a floorless beam or a mine cart with rows of seats, bars or harnesses that rise, and wheels round a track."""
    k, style, rows = look(m), m.pick("tub", "tub", "beam", "cart"), m.pick(1, 2, 2, 3)
    pitch, seats = m.number(0.8, 1.0), m.pick(2, 2, 3, 4) if style == "beam" else m.pick(1, 2, 2)
    w = 0.28 * seats + 0.08
    d, wall, t = 0.5 * rows * pitch + 0.1, m.number(0.35, 0.6), 0.04
    floor = 0.4
    m.add(BASE, box((-0.3, 0.3), (-d, d), (floor - 0.14, floor)))
    if style != "beam":
        m.add(BASE, box((-w, w), (-d, d), (floor - 0.001, floor + t)))
        side = [
            (-d, floor),
            (d, floor),
            (d, floor + 1.3 * wall),
            (0.6 * d, floor + wall),
            (-0.7 * d, floor + 0.8 * wall),
            (-d, floor + wall),
        ]
        for s in (-1, 1):
            m.add(BASE, *k.panel(Polygon(side), "x", (s * w, s * (w + t))))
        m.add(BASE, box((-w, w), (d - t, d), (floor, floor + 1.2 * wall)), box((-w, w), (-d, t - d), (floor, floor + wall)))
        if style == "tub" and m.chance(0.6):
            m.add(BASE, _nose(m, k, w, d, floor, wall))
    _rows(m, k, style, rows, pitch, seats, w, d, floor)
    _bogies(m, k, d, floor)


def _nose(m: Model, k: Look, w: float, d: float, floor: float, wall: float) -> Trimesh:
    """A rounded or wedged front."""
    if k.style in ("round", "cut"):
        return superbox((-w, w), (-d - 0.4, -d + 0.05), (floor - 0.1, floor + 0.95 * wall), 3.0)
    high = floor + wall
    return prism(
        [(-d - m.number(0.2, 0.5), floor), (-d + 0.01, floor - 0.1), (-d + 0.01, high), (-d - 0.08, high)], "x", (-w, w)
    )


def _rows(m: Model, k: Look, style: str, rows: int, pitch: float, seats: int, w: float, d: float, floor: float) -> None:
    """Benches or single seats and what holds the riders: a bar per row or seat, or a harness per seat."""
    hold = "harness" if style == "beam" and m.chance(0.8) else m.pick("bar", "bar", "single", "harness")
    base, rest = floor + 0.34, m.number(0.6, 0.85)
    for i in range(rows):
        y = -d + 0.1 + (i + 0.55) * pitch
        cell = 2 * (w - 0.06) / seats
        for j in range(seats):
            x = -w + 0.06 + (j + 0.5) * cell
            a = (x - 0.46 * cell, x + 0.46 * cell)
            m.add(
                BASE,
                *k.body(a, (y - 0.25, y + 0.2), (base - 0.14, base)),
                *k.body(a, (y + 0.14, y + 0.26), (base - 0.1, base + rest)),
            )
            m.add(BASE, box((a[0] + 0.05, a[1] - 0.05), (y - 0.2, y + 0.2), (floor - 0.01, base - 0.1)))
            if hold == "harness":
                _harness(m, k, f"harness_{i}_{j}", x, 0.3 * cell, y + 0.2, base, rest)
            elif hold == "single":
                _lap_bar(m, k, f"lap_bar_{i}_{j}", x, 0.34 * cell, y, base, floor)
        if style == "beam":
            m.add(BASE, box((-w, w), (y - 0.15, y + 0.15), (floor - 0.1, floor + 0.002)))
        if hold == "bar":
            _lap_bar(m, k, f"lap_bar_{i}", 0, w - 0.03, y, base, floor)


def _lap_bar(m: Model, k: Look, part: str, x: float, half: float, y: float, base: float, floor: float) -> None:
    """A bar over the thighs on a post before the seat or on two arms from the floor."""
    foot, top = vec(x, y - 0.42, floor + 0.06), base + 0.17
    r = m.number(0.018, 0.026)
    for s in (-1, 1) if half > 0.2 else (0,):
        m.add(
            part,
            tube(
                [(x + s * half, foot[1], foot[2]), (x + s * half, y - 0.36, top - 0.08), (x + s * half, y - 0.14, top)],
                r,
                max(6, k.n // 2),
            ),
        )
    if half > 0.2:
        m.add(
            BASE,
            rod((x - half, foot[1], foot[2]), (x + half, foot[1], foot[2]), 0.7 * r, 8),
            box((x - 0.05, x + 0.05), (foot[1] - 0.03, foot[1] + 0.03), (floor - 0.01, foot[2])),
        )
    else:
        m.add(BASE, box((x - 0.05, x + 0.05), (foot[1] - 0.03, foot[1] + 0.03), (floor - 0.01, foot[2])))
    m.add(part, rod((x - half, y - 0.14, top), (x + half, y - 0.14, top), 1.4 * r, k.n))
    m.hinge(part, foot, (1, 0, 0), m.pick(30, 40))


def _harness(m: Model, k: Look, part: str, x: float, half: float, y: float, base: float, rest: float) -> None:
    """A yoke over the shoulders that swings up on an axle behind the head."""
    high = base + rest + 0.04
    r = m.number(0.03, 0.045)
    for s in (-1, 1):
        path = [
            (x + s * half, y, high),
            (x + s * half, y - 0.18, high),
            (x + s * half, y - 0.32, base + 0.55 * rest),
            (x + s * half, y - 0.32, base + 0.2),
        ]
        m.add(part, tube(path, r, max(6, k.n // 2)))
    m.add(part, rod((x - half, y - 0.32, base + 0.2), (x + half, y - 0.32, base + 0.2), r, k.n))
    m.add(
        BASE,
        rod((x - 1.1 * half, y, high), (x + 1.1 * half, y, high), 0.7 * r, k.n),
        box((x - 0.04, x + 0.04), (y - 0.02, y + 0.02), (base + 0.5 * rest, high)),
    )
    m.hinge(part, (x, y, high), (-1, 0, 0), m.pick(75, 100))


def _bogies(m: Model, k: Look, d: float, floor: float) -> None:
    """Wheels that run on, beside and below a rail, with their brackets; a coupling."""
    r, gauge = m.number(0.09, 0.14), 0.36
    kinds = m.pick(("road",), ("road", "side"), ("road", "side", "under"))
    for i, y in enumerate((-0.75 * d, 0.75 * d)):
        for s, side in ((-1, "right"), (1, "left")):
            x = s * gauge
            m.add(BASE, box((s * 0.28, s * 0.30), (y - 0.16, y + 0.16), (floor - 0.36, floor - 0.05)))
            spots = {
                "road": (vec(x + s * 0.01, y, floor - 0.16), (1, 0, 0), r),
                "side": (vec(s * 0.37, y - 0.02, floor - 0.31), (0, 0, 1), 0.055),
                "under": (vec(x, y + 0.1, floor - 0.42), (1, 0, 0), 0.05),
            }
            for kind in kinds:
                at, axis, radius = spots[kind]
                m.add(f"{kind}_wheel_{side}_{i}", *k.wheel(at, axis, radius, 0.035))
                m.spin(f"{kind}_wheel_{side}_{i}", at, axis)
                if kind == "road":
                    m.add(BASE, rod((s * 0.28, y, at[2]), at + vec(s * 0.03, 0, 0), 0.02, 8))
                elif kind == "side":
                    m.add(BASE, box((s * 0.29, s * 0.39), (y - 0.05, y + 0.01), (at[2] - 0.055, at[2] - 0.036)))
                    m.add(BASE, rod(at - vec(0, 0, 0.05), at + vec(0, 0, 0.03), 0.012, 8))
                else:
                    m.add(
                        BASE,
                        box((s * 0.28, s * 0.30), (y + 0.06, y + 0.16), (at[2] - 0.02, floor - 0.3)),
                        rod((s * 0.28, at[1], at[2]), at, 0.012, 8),
                    )
    if m.chance(0.5):
        m.add(BASE, *k.limb((0, d - 0.02, floor - 0.08), (0, d + 0.3, floor - 0.08), 0.06, 0.06))
