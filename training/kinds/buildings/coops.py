"""Chicken coops."""

from __future__ import annotations

import numpy as np

from training.kinds.buildings.hutches import swing_leaf
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, vec
from training.kinds.wheels import beam


def chicken_coop(m: Model) -> None:
    """A raised house with a pop door that slides up, a ramp, a nest box with a lid, a door for cleaning, a tray, a run."""
    half, deep, high, low = m.number(0.4, 0.7), m.number(0.6, 1.0), m.number(0.55, 0.8), m.pick(0.1, 0.35, 0.55)
    t, top, rise = 0.018, low + high, m.number(0.15, 0.35)
    roof, gable = m.number(0.04, 0.12), m.chance(0.6)
    pop = m.number(0.22, 0.28), m.number(0.28, 0.34)
    c = m.pick(-1, 1) * m.number(0.1, 0.5) * (half - pop[0] / 2) if half < 0.55 else m.pick(-1, 1) * (half - pop[0] / 2 - 0.08)
    floor = low + 0.03
    hole = rectangle((c - pop[0] / 2, c + pop[0] / 2), (floor + 0.03, floor + 0.03 + pop[1]))
    front = [(-half, low), (half, low), (half, top), *([(0, top + rise)] if gable else []), (-half, top)]
    face = rectangle((-half, half), (low, top)) if not gable else prism(front, "y", (0, t))
    wall = prism(face, "y", (0, t)) if not gable else face
    m.add(
        BASE,
        cut(wall, prism(hole, "y", (-1, 1))),
        prism(front, "y", (deep - t, deep)) if gable else box((-half, half), (deep - t, deep), (low, top)),
    )
    m.add(BASE, box((-half, half), (0, deep), (low, low + 0.018)))
    _coop_sides(m, (half, deep, t), (low, top))
    _coop_roof(m, (half, deep, roof), (top, rise), gable)
    if low > 0.1:
        m.add(
            BASE, *(box((s * half, s * (half - 0.045)), (b, b + 0.045), (0, low)) for s in (-1, 1) for b in (0, deep - 0.045))
        )
        _coop_ramp(m, c, low, floor)
    else:
        m.add(BASE, *(box((-half, half), (b, b + 0.06), (0, low)) for b in (0.03, deep - 0.09)))
    y = (-0.014, -0.002)
    m.add("pop_door", box((c - pop[0] / 2 - 0.015, c + pop[0] / 2 + 0.015), y, (floor + 0.02, floor + pop[1] + 0.045)))
    m.add("pop_door", rod((c, -0.03, floor + pop[1]), (c, -0.014, floor + pop[1]), 0.01, 8))
    rails = min(2 * pop[1] + 0.08, top - floor - 0.02)
    m.add(
        BASE,
        *(
            box((s + c - 0.012, s + c + 0.012), (-0.02, 0), (floor, floor + rails))
            for s in (-pop[0] / 2 - 0.028, pop[0] / 2 + 0.028)
        ),
    )
    m.slide("pop_door", (0, 0, 1), min(0.95 * pop[1], top - floor - pop[1] - 0.06))
    if low > 0.1 and m.chance(0.5):
        m.add(
            "tray",
            box((-half + 0.055, half - 0.055), (0.03, deep + 0.02), (low - 0.035, low - 0.004)),
            box((-0.08, 0.08), (deep + 0.02, deep + 0.035), (low - 0.03, low - 0.015)),
        )
        m.slide("tray", (0, 1, 0), 0.7 * deep)
    if m.chance(0.45):
        _coop_run(m, half, deep, top)


def _coop_sides(m: Model, size: tuple[float, float, float], z: Span) -> None:
    """Side walls: one carries a nest box whose lid or front opens, the other a door for cleaning or a window."""
    (half, deep, t), (low, top) = size, z
    s = m.pick(-1, 1)
    m.add(BASE, box((s * half, s * (half - t)), (t, deep - t), (low, top)))
    reach, y, a = m.number(0.25, 0.35), (0.12 * deep, 0.88 * deep), low + m.number(0.03, 0.12)
    x = tuple(sorted((s * half, s * (half + reach))))
    lid = a + m.number(0.3, 0.36), a + m.number(0.22, 0.28)
    shape = [(s * half, a), (s * (half + reach), a), (s * (half + reach), lid[1]), (s * half, lid[0])]
    room = [(s * (half + t - t), a + t), (s * (half + reach - t), a + t), (s * (half + reach - t), 2), (s * half, 2)]
    m.add(BASE, cut(prism(shape, "y", y), prism(room, "y", (y[0] + t, y[1] - t))))
    m.add(
        BASE,
        *(box((x[0] + t, x[1] - t), (b - 0.006, b + 0.006), (a + t, a + 0.15)) for b in np.linspace(*y, m.pick(3, 4))[1:-1]),
    )
    d = 0.02
    slope = (lid[1] - lid[0]) / reach
    out = half + reach + 0.04
    end = lid[0] + slope * (out - half)
    m.add(
        "nest_lid",
        prism(
            [
                (s * (half + 0.002), lid[0] + 0.001),
                (s * out, end + 0.001),
                (s * out, end + d),
                (s * (half + 0.002), lid[0] + d),
            ],
            "y",
            (y[0] - 0.03, y[1] + 0.03),
        ),
    )
    m.hinge("nest_lid", (s * half, sum(y) / 2, lid[0] + d), (0, -s, 0), m.number(70, 95))
    v = (0.15 * deep, 0.85 * deep), (low + 0.06, top - 0.08)
    other = -s
    _coop_side_door(m, other, size, z, v)


def _coop_side_door(m: Model, other: int, size: tuple[float, float, float], z: Span, v: tuple[Span, Span]) -> None:
    """The wall with a door for cleaning, or with slots."""
    (half, deep, t), (low, top) = size, z
    if m.chance(0.7):
        m.add(
            BASE,
            cut(
                box((other * half, other * (half - t)), (t, deep - t), (low, top)),
                box((other * (half - 1), other * (half + 1)), *v),
            ),
        )
        board = (
            tuple(sorted((other * half, other * (half + t)))),
            (v[0][0] - 0.015, v[0][1] + 0.015),
            (v[1][0] - 0.015, v[1][1] + 0.015),
        )
        m.add(
            "side_door",
            box(*board),
            *(
                box(tuple(sorted((other * (half + t), other * (half + t + 0.012)))), board[1], (b - 0.03, b + 0.03))
                for b in (v[1][0] + 0.05, v[1][1] - 0.05)
            ),
        )
        f = m.pick(-1, 1)
        edge = board[1][0] if f < 0 else board[1][1]
        m.add(
            "side_door",
            rod(
                (other * (half + t), -f * 0.3 * deep + deep / 2, sum(v[1]) / 2),
                (other * (half + t + 0.03), -f * 0.3 * deep + deep / 2, sum(v[1]) / 2),
                0.012,
                8,
            ),
        )
        m.hinge("side_door", (other * (half + t), edge, low), np.cross((0, -f, 0), (other, 0, 0)), m.number(90, 120))
    else:
        m.add(BASE, box((other * half, other * (half - t)), (t, deep - t), (low, top)))
        m.add(
            BASE,
            *(
                box((other * half, other * (half + 0.01)), (0.3 * deep, 0.7 * deep), (c, c + 0.02))
                for c in np.linspace(top - 0.25, top - 0.1, 4)
            ),
        )


def _coop_roof(m: Model, size: tuple[float, float, float], z: Span, gable: bool) -> None:
    """Two slopes, of which one may open at the ridge, or a pent roof hinged behind or fixed."""
    (half, deep, lap), (top, rise), t = size, z, 0.02
    y = (-lap, deep + lap)
    if not gable:
        part = m.pick("roof", BASE)
        m.add(
            part,
            prism(
                [(y[0], top + 0.2 * rise), (y[1], top), (y[1], top + t), (y[0], top + 0.2 * rise + t)],
                "x",
                (-half - lap, half + lap),
            ),
        )
        m.add(part, prism([(0, top + 0.003), (deep - 0.02, top + 0.003), (0, top + 0.19 * rise)], "x", (-half, half)))
        if part != BASE:
            m.hinge(part, (0, deep, top), (-1, 0, 0), m.number(50, 80))
        return
    opens = m.pick(0, 0, -1, 1)
    for s in (-1, 1):
        part, slope = ("roof" if s == opens else BASE), rise / half
        edge = half + lap
        m.add(
            part,
            prism(
                [
                    (s * 0.004, top + rise),
                    (s * edge, top - lap * slope),
                    (s * edge, top - lap * slope + t),
                    (s * 0.004, top + rise + t),
                ],
                "y",
                y,
            ),
        )
        for c in np.linspace(0.2, 0.9, 4) * edge if m.chance(0.5) else ():
            at = top + rise - slope * c + t
            m.add(part, box((s * c - 0.008, s * c + 0.008), y, (at - 0.008, at + 0.012)))
        if s == opens:
            m.hinge(part, (0, deep / 2, top + rise + t), (0, -s, 0), m.number(60, 90))
    m.add(BASE if not opens else "roof", box((-0.03, 0.03), y, (top + rise + 0.6 * t, top + rise + 1.6 * t)))


def _coop_ramp(m: Model, c: float, low: float, floor: float) -> None:
    """A board with cleats to the ground, hinged at the sill in most."""
    long, part = m.number(1.5, 1.9) * low, m.pick("ramp", "ramp", BASE)
    foot = -np.sqrt(long**2 - low**2) - 0.03
    a, b = vec(c, -0.03, low + 0.005), vec(c, foot, 0.015)
    m.add(part, beam(a, b, 0.2, 0.014))
    m.add(
        part,
        *(
            beam(p + vec(-0.1, 0, 0.012), p + vec(0.1, 0, 0.012), 0.015, 0.015, (0, 1, 0))
            for p in (a + k * (b - a) for k in np.linspace(0.1, 0.95, m.pick(5, 8)))
        ),
    )
    m.add(BASE, box((c - 0.12, c + 0.12), (-0.03, 0), (low - 0.02, low + 0.006)))
    if part != BASE:
        m.hinge(part, a, (-1, 0, 0), m.number(60, 100))


def _coop_run(m: Model, half: float, deep: float, top: float) -> None:
    """A fenced run before the house, its gate at the far end."""
    long, high, w = m.number(0.9, 1.6), m.pick(0.7, 1.0) * top, 0.04
    y0 = -long - 0.06
    for s in (-1, 1):
        a = s * (half - w / 2)
        m.add(BASE, *(box((a - w / 2, a + w / 2), (y0, -0.06), (c, c + w)) for c in (0.0, high - w)))
        m.add(BASE, *(box((a - w / 2, a + w / 2), (b, b + w), (0, high)) for b in (y0, -0.06 - w)))
        m.add(BASE, *(rod((a, b, w), (a, b, high - w), 0.002, 4) for b in np.arange(y0 + 0.06, -0.1, 0.06)))
    m.add(BASE, *(box((-half, half), (y0, y0 + w), (c, c + w)) for c in (0.0, high - w)))
    x, z = (-half + w + 0.004, half - w - 0.004), (w + 0.004, high - w - 0.004)
    swing_leaf(m, "run_gate", x, (y0, y0 + 0.025), z, m.pick("left", "right"), True)
