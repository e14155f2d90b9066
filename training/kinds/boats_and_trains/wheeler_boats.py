"""Speed boats, as one artist models them: an outboard that steers and tilts or a shaft, lids, a windscreen, a ladder."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, loft, prism, rectangle, rod, tube, turned, vec
from training.kinds.wheeler_gear import seat, steering
from training.kinds.wheeler_style import STYLES, softened


@dataclass(frozen=True)
class BoatSizes:
    """Length, half width and height of a boat; where its cockpit begins."""

    style: str
    long: float
    half: float
    deck: float
    begin: float


def speed_boat(m: Model) -> None:
    """A hull with a cockpit: bow rider, covered bow or an open launch; the bow is at -y."""
    style = m.pick(*STYLES)
    b = BoatSizes(style, m.number(4.8, 7.5), m.number(0.9, 1.2), m.number(0.95, 1.2), m.number(0.36, 0.45))
    n = m.pick(5, 7) if style == "low" else 24
    skin = _skin(b, n)
    y0, y1, w = b.begin * b.long, 0.86 * b.long, 0.8 * b.half
    floor = 0.42 * b.deck
    soft = 0.0 if style == "low" else 0.15
    rooms = [prism(softened(rectangle((-w, w), (y0, y1)), soft), "z", (floor, 3))]
    bow = m.pick("cover", "rider", "cover")
    if bow == "rider":
        x = 0.5 * b.half
        rooms.append(
            prism(
                softened([(-x, y0 - 0.15), (x, y0 - 0.15), (0.5 * x, 0.17 * b.long), (-0.5 * x, 0.17 * b.long)], soft),
                "z",
                (floor + 0.25, 3),
            )
        )
    m.add(BASE, cut(skin, *rooms))
    if m.chance(0.6):
        m.add(
            BASE,
            *(
                box((s * 0.97 * b.half, s * 1.03 * b.half), (0.5 * b.long, b.long), (0.72 * b.deck, 0.78 * b.deck))
                for s in (-1, 1)
            ),
        )
    _helm(m, b, y0, floor, w)
    _windscreen(m, b, y0, w)
    if bow == "cover" and m.chance(0.7):
        _bow_hatch(m, b, soft)
    inboard = m.chance(0.35)
    if inboard:
        _shaft(m, b)
    else:
        for k, x in enumerate(m.pick((0.0,), (0.0,), (-0.32, 0.32))):
            _outboard(m, b, x, k)
    _stern(m, b, y1, w, inboard)
    if m.chance(0.5):
        _rail(m, b)


def _rail(m: Model, b: BoatSizes) -> None:
    """A rail round the bow."""
    path = [
        (s * x * b.half, y * b.long, b.deck + z)
        for s, x, y, z in (
            (-1, 0.75, 0.36, 0),
            (-1, 0.66, 0.28, 0.25),
            (-1, 0.25, 0.07, 0.32),
            (1, 0.25, 0.07, 0.32),
            (1, 0.66, 0.28, 0.25),
            (1, 0.75, 0.36, 0),
        )
    ]
    m.add(BASE, tube(path, 0.016, 8))


def _bow_hatch(m: Model, b: BoatSizes, soft: float) -> None:
    """A lid in the deck over the bow."""
    y, x, z = 0.25 * b.long, 0.26, b.deck + 0.15 * 0.75**2
    m.add("bow_hatch", prism(softened(rectangle((-x, x), (y, y + 0.5)), 0.5 * soft), "z", (z - 0.04, z + 0.02)))
    front = m.chance(0.5)
    m.hinge("bow_hatch", (0, y if front else y + 0.5, z), (1 if front else -1, 0, 0), 80)


def _skin(b: BoatSizes, n: int) -> Trimesh:
    """The hull as one solid, of n frames."""
    rings = []
    for u in np.linspace(0, 1, n):
        w = b.half * max(0.02, np.sin(np.pi / 2 * min(1, 0.03 + 1.5 * u)) ** 0.8)
        keel, rise = 0.65 * b.deck * max(0, 1 - 2.6 * u) ** 1.6, 0.15 * (1 - u) ** 2
        chine = keel + 0.3 * (b.deck - keel) * min(1, 0.5 + u)
        y, top = u * b.long, b.deck + rise
        mid = 0.75 * top + 0.25 * chine
        right = [(0.9 * w, chine), (w, mid), (0.94 * w, top)]
        rings.append([(x, y, z) for x, z in [(0, keel), *right, *((-x, z) for x, z in right[::-1])]])
    return loft(np.array(rings))


def _helm(m: Model, b: BoatSizes, y0: float, floor: float, w: float) -> None:
    side = m.pick(-1, 1)
    x = side * 0.45 * w
    m.add(
        BASE,
        prism(
            [(y0 - 0.02, floor), (y0 + 0.3, floor), (y0 + 0.42, b.deck + 0.02), (y0 - 0.02, b.deck + 0.08)],
            "x",
            (x - 0.3, x + 0.3),
        ),
    )
    steering(m, (x, y0 + 0.5, b.deck - 0.02), 30, 0.17)
    for s in (-1, 1):
        if m.chance(0.85) or s == side:
            seat(m, b.style, (s * 0.45 * w, y0 + 1.15, floor - 0.01))
    if m.chance(0.6):
        a = vec(side * (w + 0.01), y0 + 0.75, b.deck - 0.15)
        m.add(BASE, box((a[0] - side * 0.05, a[0] + side * 0.03), (a[1] - 0.1, a[1] + 0.1), (a[2] - 0.08, a[2] + 0.08)))
        h = a - side * vec(0.06, 0, 0)
        m.add(
            "throttle",
            rod(h + side * vec(0.02, 0, 0), h - side * vec(0.01, 0, 0), 0.04, 12),
            rod(h, h + vec(0, 0.02, 0.2), 0.012, 8),
            ball(h + vec(0, 0.02, 0.2), (0.03, 0.03, 0.03), 8),
        )
        m.hinge("throttle", h, (1, 0, 0), (-35, 55))
    if m.chance(0.5):
        m.add(
            BASE,
            box(
                (-0.3 * w, 0.3 * w) if m.chance(0.5) else (-w, w),
                (0.78 * b.long, 0.86 * b.long + 0.01),
                (floor - 0.01, floor + 0.36),
            ),
        )


def _windscreen(m: Model, b: BoatSizes, y0: float, w: float) -> None:
    way = m.pick("panes", "panes", "visor", "none")
    z, h, lean = b.deck, m.number(0.28, 0.42), m.number(0.15, 0.4)
    slab = [(y0 - 0.14, z - 0.01), (y0 - 0.115, z - 0.01), (y0 - 0.115 + lean, z + h), (y0 - 0.14 + lean, z + h)]
    if way == "visor":
        m.add(BASE, prism(slab, "x", (-0.85 * w, 0.85 * w)))
    elif way == "panes":
        gap = 0.26
        for s in (-1, 1):
            m.add(BASE, prism(slab, "x", (s * gap, s * w)))
            m.add(
                BASE,
                prism(
                    [(y0 - 0.13, z - 0.01), (y0 + 0.7, z - 0.01), (y0 + 0.7, z + 0.3 * h), (y0 - 0.13 + lean, z + h)],
                    "x",
                    (s * (w - 0.02), s * w),
                ),
            )
        m.add("windscreen_door", prism(slab, "x", (-gap + 0.004, gap - 0.004)))
        side = m.pick(-1, 1)
        m.hinge("windscreen_door", (side * gap, y0 - 0.12 + lean / 2, z + h / 2), (0, side * lean, side * h), m.number(80, 120))


def _outboard(m: Model, b: BoatSizes, x: float, k: int) -> None:
    """A clamp, a swivel that tilts, a motor that steers, a propeller."""
    y, z, n = b.long, b.deck, 8 if b.style == "low" else 20
    tilt, motor, prop = (f"{name}_{k}" for name in ("tilt_bracket", "outboard_motor", "propeller"))
    m.add(BASE, *(box((x + s * 0.09, x + s * 0.13), (y - 0.06, y + 0.1), (z - 0.3, z + 0.06)) for s in (-1, 1)))
    m.add(BASE, rod((x - 0.13, y + 0.05, z), (x + 0.13, y + 0.05, z), 0.02, 10))
    m.add(tilt, box((x - 0.08, x + 0.08), (y + 0.02, y + 0.2), (z - 0.28, z + 0.03)))
    m.hinge(tilt, (x, y + 0.05, z), (1, 0, 0), m.number(50, 70))
    cowl = softened(
        [(y + 0.02, z + 0.1), (y + 0.55, z + 0.1), (y + 0.6, z + 0.3), (y + 0.5, z + 0.56), (y + 0.12, z + 0.6), (y, z + 0.4)],
        0.0 if b.style == "low" else 0.08,
    )
    m.add(motor, prism(cowl, "x", (x - 0.19, x + 0.19)), box((x - 0.12, x + 0.12), (y + 0.1, y + 0.42), (z + 0.03, z + 0.11)))
    m.add(
        motor,
        prism(
            [(y + 0.2, z + 0.05), (y + 0.42, z + 0.05), (y + 0.4, z - 1.05), (y + 0.22, z - 1.05)], "x", (x - 0.05, x + 0.05)
        ),
    )
    m.add(
        motor,
        rod((x, y + 0.1, z - 0.92), (x, y + 0.5, z - 0.92), 0.075, n),
        box((x - 0.12, x + 0.12), (y + 0.2, y + 0.55), (z - 0.78, z - 0.765)),
    )
    pivot = (x, y + 0.2, z - 0.2)
    m.hinge(motor, pivot, (0, 0, 1), (-35, 35), tilt)
    _propeller(m, prop, vec(x, y + 0.56, z - 0.92), 0.17, motor)


def _propeller(m: Model, part: str, at: np.ndarray, r: float, parent: str = BASE) -> None:
    count = m.pick(3, 3, 4)
    blade = turned(ball((0, 0, 0.58 * r), (0.32 * r, 0.05 * r, 0.46 * r), 10), (0, 0, 1), 35, (0, 0, 0))
    solids = [
        rod((0, -0.4 * r, 0), (0, 0.4 * r, 0), 0.28 * r, 12),
        *(turned(blade.copy(), (0, 1, 0), 360 * k / count, (0, 0, 0)) for k in range(count)),
    ]
    m.add(part, *(s.apply_translation(at) for s in solids))
    m.spin(part, at, (0, 1, 0), parent)


def _shaft(m: Model, b: BoatSizes) -> None:
    """A shaft under the hull with a propeller and a rudder behind it."""
    y = 0.9 * b.long
    m.add(BASE, rod((0, y - 0.9, 0.05), (0, y, -0.12), 0.022, 8), box((-0.015, 0.015), (y - 0.2, y - 0.1), (-0.12, 0.1)))
    _propeller(m, "propeller", vec(0, y + 0.05, -0.12), 0.17)
    m.add(
        "rudder",
        prism([(y + 0.18, 0.0), (y + 0.42, 0.0), (y + 0.38, -0.32), (y + 0.2, -0.32)], "x", (-0.015, 0.015)),
        rod((0, y + 0.26, -0.3), (0, y + 0.26, 0.06), 0.018, 8),
    )
    m.hinge("rudder", (0, y + 0.26, 0), (0, 0, 1), (-35, 35))


def _stern(m: Model, b: BoatSizes, y1: float, w: float, inboard: bool) -> None:
    """A lid over the engine or lids of lockers in the rear deck, a platform with a ladder."""
    z = b.deck + 0.0
    if inboard or m.chance(0.5):
        names = ["engine_lid"] if inboard else ["locker_lid_left", "locker_lid_right"]
        for k, name in enumerate(names):
            x0, x1 = (-0.7 * w, 0.7 * w) if inboard else ((-0.85 * w, -0.05) if k == 0 else (0.05, 0.85 * w))
            a, c = y1 + 0.03, b.long - 0.14
            m.add(
                name,
                prism(
                    softened(rectangle((x0, x1), (a, c)), 0.0 if b.style == "low" else 0.05),
                    "z",
                    (z - 0.01, z + m.number(0.02, 0.08)),
                ),
            )
            m.hinge(name, (0.5 * (x0 + x1), c, z), (-1, 0, 0), m.number(60, 85))
    if inboard and m.chance(0.6):
        m.add(BASE, box((-0.8 * b.half, 0.8 * b.half), (b.long - 0.02, b.long + 0.5), (0.3 * b.deck, 0.36 * b.deck)))
        if m.chance(0.7):
            x, y, h = 0.5 * b.half, b.long + 0.46, 0.36 * b.deck + 0.015
            m.add("ladder", *(rod((x + d, y, h), (x + d, y - 0.42, h), 0.014, 8) for d in (-0.15, 0.15)))
            m.add("ladder", *(rod((x - 0.15, y - d, h), (x + 0.15, y - d, h), 0.014, 8) for d in (0.02, 0.2, 0.4)))
            m.hinge("ladder", (x, y, h), (-1, 0, 0), 170)
