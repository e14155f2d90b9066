"""Heavy tracked machines: a tank with a turning turret, a bulldozer with blade and ripper."""

from __future__ import annotations

import numpy as np
from shapely.geometry import MultiPolygon, Point

from training.kinds.machines.machines import cab
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, loft, prism, rod, rounded, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import beam, lathe, upright, wheel_solids


def crawler(m: Model, name: str, s: int, x: float, wide: float, ys: np.ndarray, r: float, lift: float, ends: float) -> None:
    """A fixed track band round road wheels at ys and raised wheels before and behind them; all wheels turn."""
    first, last = ys[0] - 1.35 * r, ys[-1] + 1.35 * r
    small, t = ends * r, 0.16 * r
    spots = [(first, lift + small, small), (last, lift + small, small), *((y, r + t, r) for y in ys)]
    band = MultiPolygon([Point(y, z).buffer(size + t, quad_segs=5) for y, z, size in spots]).convex_hull
    band = band.difference(band.buffer(-t))
    span = tuple(sorted((s * (x - wide / 2), s * (x + wide / 2))))
    m.add(BASE, *prisms(band, "x", span))
    if m.chance(0.6):
        line = band.exterior
        for at in np.arange(0, line.length, m.pick(0.24, 0.32)):
            a, b = (np.array(line.interpolate(d).coords[0]) for d in (at, at + 0.1))
            middle, side = vec(s * x, *((a + b) / 2)), vec(span[1] - span[0] + 0.02, 0, 0) / 2
            m.add(BASE, beam(middle - side, middle + side, 0.03, 0.03, (0, *(b - a))))
    style, n = m.pick("disc", "lathed", *(["tyre"] if len(ys) < 5 else [])), m.pick(10, 12)
    for k, (y, z, size) in enumerate(spots):
        part = f"{name}_wheel_{k}"
        wheel = wheel_solids(style, size * 0.99, 0.75 * wide, n, 5, False)
        m.add(part, *upright(wheel, (s, 0, 0), (s * (x + 0.05), y, z)))
        m.spin(part, (s * x, y, z), (s, 0, 0))


def _turret(m: Model, at: np.ndarray, half: float) -> tuple[float, float]:
    """The turret's shell; returns its height and how far it reaches to the front."""
    high, style = m.number(0.5, 0.7), m.pick("cast", "wedge", "drum", "box")
    m.add("turret", rod(at, at + vec(0, 0, 0.06), 0.75 * half, 20))
    low = at[2] + 0.05
    if style in ("cast", "drum"):
        rim = 0.85 * half
        profile = [(0, 0), (rim, 0), (1.03 * rim, 0.3 * high), (0.75 * rim, 0.85 * high), (0.4 * rim, high), (0, high)]
        if style == "drum":
            profile = [(0, 0), (0.9 * rim, 0), (0.85 * rim, 0.95 * high), (0.8 * rim, high), (0, high)]
        m.add("turret", lathe(profile, m.pick(12, 20), (at[0], at[1], low)))
        return high, (0.9 if style == "cast" else 0.85) * rim
    nose, back = m.number(0.75, 1.0) * half, m.number(0.9, 1.2) * half
    thin = 0.5 if style == "wedge" else 0.8
    plan = np.array(
        [(-0.35, -nose), (0.35, -nose), (0.9, -0.2), (0.9, 0.6), (0.6, back), (-0.6, back), (-0.9, 0.6), (-0.9, -0.2)]
    )
    plan[:, 0] *= half
    plan[2:4, 1] *= half
    plan[6:, 1] *= half
    rings = [np.c_[plan * k + [0, at[1]], np.full(8, low + z * high)] for k, z in ((0.9, 0), (1.0, 0.35), (thin + 0.25, 1.0))]
    m.add("turret", loft(np.array(rings)))
    if m.chance(0.6):
        m.add(
            "turret", box((-0.55 * half, 0.55 * half), (at[1] + 0.9 * back, at[1] + 1.3 * back), (low + 0.15, low + 0.6 * high))
        )
    return high, 0.9 * nose


def _gun(m: Model, at: np.ndarray, long: float) -> None:
    """A mantlet and barrel that tilt about trunnions in the turret."""
    r, style = m.number(0.055, 0.08), m.pick("plain", "brake", "sleeve")
    m.add("gun", m.pick(box((-0.3, 0.3), (at[1] - 0.3, at[1] + 0.05), (at[2] - 0.2, at[2] + 0.2)),
                        rod(at - (0.3, 0.1, 0), at + vec(0.3, -0.1, 0), 0.2, 14)))  # fmt: skip
    m.add("gun", rod(at - (0, 0.2, 0), at - (0, long, 0), r, 12), rod(at - (0, 0.2, 0), at - (0, 0.7, 0), 1.5 * r, 12))
    if style != "plain":
        c = 0.6 if style == "sleeve" else 1.0
        m.add("gun", rod(at - (0, c * long - 0.35, 0), at - (0, c * long + 0.02, 0), 1.7 * r, 12))
    m.hinge("gun", at, (-1, 0, 0), (-m.pick(5, 8), m.pick(15, 20, 30)), "turret")


def _hatches(m: Model, at: np.ndarray, top: float, half: float) -> None:
    """Round or square lids on the turret, each hinged at one edge; perhaps a machine gun on a ring."""
    spots = [(-0.3, 0.25), (0.3, 0.3)][: m.pick(1, 2, 2)]
    for k, (x, y) in enumerate(spots):
        x, y, r = x * half, at[1] + y * half, m.number(0.2, 0.25)
        rise = m.pick(0.03, 0.15)
        m.add("turret", rod((x, y, top - 0.1), (x, y, top + rise), 1.15 * r, 16))
        lid = rod((x, y, top + rise + 0.002), (x, y, top + rise + 0.045), r, m.pick(6, 12, 16))
        m.add(f"hatch_{k}", lid, box((x - 0.04, x + 0.04), (y - 0.6 * r, y - 0.5 * r), (top + rise + 0.04, top + rise + 0.09)))
        m.add("turret", box((x - 0.08, x + 0.08), (y + 0.95 * r, y + 1.12 * r), (top + rise - 0.02, top + rise + 0.03)))
        m.hinge(f"hatch_{k}", (x, y + r, top + rise + 0.02), (-1, 0, 0), m.pick(90, 110), "turret")
    if m.chance(0.5):
        a = vec(spots[0][0] * half, at[1] + 0.25 * half - 0.32, top)
        m.add("turret", rod(a - (0, 0, 0.2), a + vec(0, 0, 0.14), 0.025, 8))
        m.add("turret", box((a[0] - 0.04, a[0] + 0.04), (a[1] - 0.2, a[1] + 0.2), (a[2] + 0.13, a[2] + 0.22)))
        m.add("turret", rod(a + vec(0, -0.2, 0.18), a + vec(0, -0.8, 0.18), 0.015, 8))
    for _ in range(m.pick(0, 1, 2)):
        b = vec(m.pick(-1, 1) * 0.45 * half, at[1] + m.number(0.35, 0.6) * half, top - 0.25)
        m.add("turret", rod(b, b + vec(0, 0.1, m.number(0.9, 1.4)), 0.01, 6))


def _tank_trims(m: Model, half: float, inner: float, ends: tuple[float, float], deck: float) -> None:
    """Mudguards, boxes, skirts, grilles, lamps and drums that stay."""
    for s in (-1, 1):
        x = tuple(sorted((s * inner, s * half)))
        m.add(BASE, box(x, ends, (deck - 0.05, deck)))
        for y in m.rng.uniform(ends[0] + 0.4, ends[1] - 1.0, m.pick(1, 2, 3)):
            m.add(BASE, box((x[0] + 0.06, x[1] - 0.06), (y, y + 0.7), (deck, deck + m.number(0.12, 0.25))))
        if m.chance(0.4):
            for y in np.arange(ends[0] + 0.3, ends[1] - 0.9, 0.8):
                m.add(BASE, box((s * half, s * (half + 0.02)), (y, y + 0.78), (deck - m.number(0.4, 0.5), deck)))
        m.add(
            BASE, rod((s * 0.7 * inner, ends[0] + 0.45, deck + 0.02), (s * 0.7 * inner, ends[0] + 0.3, deck + 0.02), 0.09, 12)
        )
        if m.chance(0.4):
            m.add(BASE, rod((s * 0.1, ends[1] + 0.1, deck + 0.1), (s * 0.9 * inner, ends[1] + 0.1, deck + 0.1), 0.2, 14))
    m.add(
        BASE,
        *(
            box((-0.7 * inner, 0.7 * inner), (y, y + 0.06), (deck + 0.2, deck + 0.24))
            for y in np.arange(ends[1] - 1.0, ends[1] - 0.3, 0.12)
        ),
    )


def tank(m: Model) -> None:
    """Make a battle tank: four to seven road wheels a side, cast, angular or drum turret, gun, hatches, skirts, boxes."""
    count, r, half = m.pick(4, 5, 6, 7), m.number(0.3, 0.42), m.number(1.45, 1.75)
    pitch, wide = r * m.number(2.1, 2.35), m.number(0.45, 0.6)
    ys, lift = (np.arange(count) - (count - 1) / 2) * pitch, m.number(0.45, 0.8) * r
    for name, s in (("left", -1), ("right", 1)):
        crawler(m, name, s, half - wide / 2, wide, ys, r, lift, m.number(0.65, 0.8))
    reach = ys[-1] + 2.1 * r
    ends, inner, deck = (-reach - 0.1, reach + 0.15), half - wide - 0.05, 2.35 * r + lift * 0.3 + 0.1
    side = [
        (ends[0] + 0.5, 0.4),
        (ends[1] - 0.3, 0.4),
        (ends[1], deck),
        (ends[1] - 0.1, deck + 0.2),
        (ends[0] + m.number(1.0, 1.5), deck + 0.2),
        (ends[0], deck - 0.25),
    ]
    m.add(BASE, prism(side, "x", (-inner, inner)))
    _tank_trims(m, half, inner, ends, deck)
    at = vec(0, m.number(-0.25, 0.25), deck + 0.2)
    if m.chance(0.6):
        x, y = m.pick(-1, 1) * 0.4 * inner, ends[0] + 1.5
        if at[1] - y > inner + 0.75:
            m.add("driver_hatch", box((x - 0.25, x + 0.25), (y, y + 0.4), (deck + 0.2, deck + 0.24)))
            m.hinge("driver_hatch", (x + 0.25 * np.sign(x), y, deck + 0.2), (0, np.sign(x), 0), 90)
    high, nose = _turret(m, at, inner + 0.15)
    _gun(m, at + vec(0, -nose + 0.1, 0.05 + 0.4 * high), m.number(2.2, 4.2) - 0.6)
    m.spin("turret", at, (0, 0, 1))
    _hatches(m, at, at[2] + 0.05 + high, inner + 0.15)


def _blade(m: Model, half: float, y: float, low: float, long: float) -> None:
    """Push arms along both tracks with a curved blade; the blade may be pitched against the arms."""
    wide, tall, back = half + m.number(0.15, 0.35), m.number(0.8, 1.1), y - m.number(0.35, 0.5)
    t = np.linspace(-0.5, 0.5, 7)
    curve = np.c_[back - 0.25 * (4 * t**2) + 0.05, 0.06 + (t + 0.5) * tall]
    outline = [*curve, *(curve[::-1] + np.array([0.06, 0.0]))]
    part = "blade" if m.chance(0.5) else "arms"
    m.add(part, prism(outline, "x", (-wide, wide)))
    m.add(
        part,
        *(prism([*curve, (back + 0.12, 0.8 * tall), (back + 0.12, 0.2)], "x", (s * wide, s * wide + 0.04)) for s in (-1, 1)),
    )
    pivot, x = vec(0, long * 0.12, low), half + 0.09
    tip = vec(0, back + 0.16, 0.32)
    for s in (-1, 1):
        m.add(
            "arms",
            beam(pivot + vec(s * x, 0, 0), tip + vec(s * x, 0, 0), 0.12, 0.2),
            rod(pivot + vec(s * (half - 0.05), 0, 0), pivot + vec(s * (x + 0.09), 0, 0), 0.09, 12),
        )
        m.add("arms", rod(tip + vec(s * (x - 0.08), 0, 0), tip + vec(s * (x + 0.08), 0, 0), 0.1, 12))
        m.add(part, box((s * x - 0.07, s * x + 0.07), (back + 0.05, back + 0.16), (0.22, 0.42)))
        if m.chance(0.7):
            m.add("arms", beam(tip + vec(s * x, 0.5, 0.1), (s * (x - 0.15), back + 0.14, 0.75 * tall), 0.07, 0.07))
    m.add("arms", beam((-x, tip[1] + 0.12, 0.35), (x, tip[1] + 0.12, 0.35), 0.12, 0.12, (0, 1, 0)))
    m.hinge("arms", pivot, (-1, 0, 0), (-m.pick(0, 5), m.number(18, 28)))
    if part == "blade":
        m.hinge("blade", tip, (-1, 0, 0), (-8, 12), "arms")


def _ripper(m: Model, y: float, z: float) -> None:
    """A beam behind with one to three teeth that tilts down from its raised rest."""
    count, arm = m.pick(1, 2, 3), m.number(0.6, 0.8)
    for s in (-1, 1):
        m.add(BASE, box((s * 0.35 - 0.05, s * 0.35 + 0.05), (y - 0.05, y + 0.12), (z - 0.25, z + 0.12)))
        m.add("ripper", beam((s * 0.35, y + 0.05, z), (s * 0.4, y + arm, z + 0.25), 0.1, 0.14))
    m.add("ripper", box((-0.75, 0.75), (y + arm - 0.1, y + arm + 0.15), (z + 0.1, z + 0.38)))
    for x in np.linspace(-0.6, 0.6, count) if count > 1 else (0.0,):
        m.add(
            "ripper",
            beam((x, y + arm + 0.03, z + 0.38), (x, y + arm + 0.03, z - 0.3), 0.08, 0.2),
            beam((x, y + arm + 0.05, z - 0.25), (x, y + arm - 0.18, z - 0.45), 0.08, 0.12),
        )
    m.hinge("ripper", (0, y + 0.05, z), (-1, 0, 0), m.number(20, 32))


def bulldozer(m: Model) -> None:
    """Make a crawler dozer: blade arms, perhaps a blade that pitches, ripper or weight, cab or canopy, engine doors."""
    count, r, half = m.pick(5, 6, 7), m.number(0.16, 0.22), m.number(0.95, 1.25)
    wide, ys = m.number(0.4, 0.5), (np.arange(count) - (count - 1) / 2) * r * 2.3
    for name, s in (("left", -1), ("right", 1)):
        crawler(m, name, s, half - wide / 2, wide, ys, r, m.number(0.2, 0.8) * r, m.number(1.6, 2.0))
    reach, inner = ys[-1] + 1.8 * r, half - wide - 0.03
    long, deck = 2 * reach, 0.55 + 2 * r
    m.add(BASE, box((-inner, inner), (-reach, reach + 0.2), (0.35, deck)))
    x, nose, split, top = m.number(0.35, 0.5), -reach - 0.25, -0.05 * long, deck + m.number(0.5, 0.7)
    hood = prism(rounded((-x, x), (deck - 0.2, top), m.pick(0.02, 0.12)), "y", (nose, split))
    doors = m.chance(0.6)
    span, z = (nose + 0.2, split - 0.15), (deck + 0.02, top - 0.16)
    if doors and m.chance(0.6):
        hood = cut(
            hood,
            *(box((s * (x - 0.2), s * (x + 1)), (span[0] + 0.04, span[1] - 0.04), (z[0] + 0.04, z[1] - 0.04)) for s in (-1, 1)),
        )
    m.add(
        BASE,
        hood,
        *(box((-0.8 * x, 0.8 * x), (nose - 0.02, nose), (c, c + 0.03)) for c in np.arange(deck - 0.1, top - 0.1, 0.09)),
    )
    for s, name in ((-1, "engine_door_left"), (1, "engine_door_right")):
        part = name if doors else BASE
        m.add(
            part,
            box((s * (x + 0.002), s * (x + 0.03)), span, z),
            box((s * (x + 0.03), s * (x + 0.05)), (span[1] - 0.12, span[1] - 0.06), (z[0] + 0.1, z[0] + 0.25)),
        )
        if doors:
            m.hinge(part, (s * (x + 0.03), span[0], z[0]), (0, 0, -s), m.pick(90, 120))
    m.add(BASE, rod((0.2, nose + 0.5, top - 0.05), (0.2, nose + 0.5, top + m.number(0.3, 0.6)), 0.05, 10))
    m.add(
        BASE, *(box((s * inner, s * half), (-0.1 * long, reach), (deck - 0.02, deck + 0.05)) for s in (-1, 1) if half > inner)
    )
    cab(
        m,
        BASE,
        (-0.75, 0.75),
        (split + 0.02, split + 1.3),
        (deck + 0.05, deck + m.number(1.45, 1.65)),
        "cab_door" if m.chance(0.7) else None,
    )
    _blade(m, half, nose, 0.45, long)
    if m.chance(0.7):
        _ripper(m, reach + 0.2, 0.75)
    else:
        m.add(BASE, prism(rounded((-0.7, 0.7), (0.5, deck), 0.06), "y", (reach + 0.2, reach + 0.5)))
