"""Cannons on wheels as game artists model them."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, join, prism, ring, rod, vec
from training.kinds.wheels import beam, lathe, upright, wheel_maker

Vector = Float[np.ndarray, " 3"]
CHEEK = 0.07  # thickness of the sides of a carriage [m]


def field_cannon(m: Model) -> None:
    """A muzzle loader on a field carriage, a ship's gun on four small wheels, or a howitzer with a shield and a breech."""
    style = m.pick("field", "field", "ship", "howitzer")
    if style == "howitzer":
        _howitzer(m)
        return
    r, long, n = m.number(0.1, 0.14), m.number(1.2, 1.9), m.pick(10, 16, 24)
    ship, gap = style == "ship", 1.12 * r
    wheel = m.number(0.16, 0.22) if ship else m.number(0.5, 0.7)
    pivot = vec(0, 0, (2.2 * wheel if ship else 1.05 * wheel) + m.number(0.12, 0.2) + 0.5 * r)
    _cast_barrel(m, pivot, r, long, n)
    side = _ship_carriage(m, pivot, gap, wheel, r, 0.5 * long) if ship else _field_carriage(m, pivot, gap, wheel)
    for s in (-1, 1):
        part = side.copy().apply_translation((0 if s > 0 else -2 * gap - CHEEK, 0, 0))
        m.add(BASE, cut(part, rod((-1, 0, pivot[2]), (1, 0, pivot[2]), 0.385 * r, 12)))


def _ship_carriage(m: Model, pivot: Vector, gap: float, wheel: float, r: float, rear: float) -> Trimesh:
    """Four small wheels, axles and a bed; returns the stepped side at +x."""
    make = wheel_maker(m, ("disc", "lathed"), 0.0)
    steps = [
        (-0.3, 0.8 * wheel),
        (-0.3, pivot[2] - 0.02),
        (0.1, pivot[2] + 0.01),
        (0.12, pivot[2] - 0.11),
        (0.3, pivot[2] - 0.11),
    ]
    steps += [(0.32, pivot[2] - 0.2), (rear + 0.1, pivot[2] - 0.2), (rear + 0.1, 0.8 * wheel)]
    side, x = prism(steps, "x", (gap, gap + CHEEK)), gap + CHEEK + 0.02
    for name, at in (("front", -0.15), ("rear", rear - 0.05)):
        m.add(
            BASE,
            box((-x, x), (at - 0.05, at + 0.05), (0.7 * wheel, 1.3 * wheel)),
            rod((-x - 0.12, at, wheel), (x + 0.12, at, wheel), 0.03, 8),
        )
        for k, s in enumerate((-1, 1)):
            make(f"{name}_wheel_{k}", (s * (x + 0.05), at, wheel), (s, 0, 0), wheel, 0.08)
    m.add(
        BASE,
        box((-gap, gap), (-0.25, -0.17), (wheel, pivot[2] - 1.3 * r)),
        box((-gap, gap), (0.0, rear), (0.9 * wheel, 1.15 * wheel)),
    )
    return side


def _field_carriage(m: Model, pivot: Vector, gap: float, axle: float) -> Trimesh:
    """Two large wheels, an axle and what joins the trail; returns the side at +x."""
    y, make = m.number(0.0, 0.12), wheel_maker(m, ("spoked", "spoked", "spoked", "disc"), 0.0)
    tail, x, width = m.number(1.3, 1.8), gap + CHEEK + m.number(0.18, 0.3), m.number(0.06, 0.09)
    side = join(
        prism(
            [
                (-0.2, pivot[2] - 0.02),
                (-0.15, axle - 0.06),
                (y + 0.5, axle - 0.12),
                (tail, 0.0),
                (tail + 0.06, 0.1),
                (y + 0.6, axle + 0.04),
                (0.2, pivot[2] + 0.02),
            ],
            "x",
            (gap, gap + CHEEK),
        ),
        rod((gap, 0, pivot[2]), (gap + CHEEK, 0, pivot[2]), 0.07, 10),
    )
    m.add(
        BASE,
        rod((-x - 0.06, y, axle), (x + 0.06, y, axle), 0.035, 8),
        box((-x + 0.06, x - 0.06), (y - 0.06, y + 0.06), (axle - 0.07, axle + 0.05)),
    )
    for k, s in enumerate((-1, 1)):
        make(f"wheel_{k}", (s * x, y, axle), (s, 0, 0), axle, width)
    m.add(
        BASE,
        box((-gap, gap), (tail - 0.12, tail), (0.03, 0.09)),
        box((-gap, gap), (y + 0.5, y + 0.58), (axle - 0.18, axle - 0.1)),
    )
    if m.chance(0.6):
        m.add(BASE, ring((0, tail + 0.11, 0.05), (0, 0, 1), 0.07, 0.015, 12))
        m.add(BASE, box((-0.5 * gap, 0.5 * gap), (tail - 0.04, tail + 0.055), (0.035, 0.065)))
    return side


def _cast_barrel(m: Model, pivot: Vector, r: float, long: float, n: int) -> None:
    """A turned barrel with rings, a knob behind and trunnions; it pitches."""
    rear, muzzle = 0.42 * long, 0.58 * long
    slim, flare = m.number(0.6, 0.75) * r, m.number(0.75, 0.95) * r
    bore = 0.4 * r
    profile = [(0, 0), (0.7 * r, 0), (r, 0.05 * long)]
    for t in m.pick((0.1, 0.35), (0.08, 0.3, 0.62), ()):
        s = r + (slim - r) * t
        profile += [
            (s, (t - 0.012) * long),
            (s + 0.1 * r, (t - 0.01) * long),
            (s + 0.1 * r, (t + 0.01) * long),
            (s, (t + 0.012) * long),
        ]
    profile += [
        (slim, 0.92 * long),
        (flare, 0.97 * long),
        (0.85 * flare, long),
        (bore, long),
        (bore, 0.8 * long),
        (0, 0.8 * long),
    ]
    m.add("barrel", *upright([lathe(profile, n)], (0, -1, 0), pivot + vec(0, rear, 0)))
    end = pivot + vec(0, rear, 0)
    if m.chance(0.85):
        m.add("barrel", rod(end, end + vec(0, 0.7 * r, 0), 0.2 * r, 8), ball(end + vec(0, 0.8 * r, 0), (0.36 * r,) * 3, 10))
    m.add("barrel", rod(pivot - vec(1.1 * r + 0.075, 0, 0), pivot + vec(1.1 * r + 0.075, 0, 0), 0.38 * r, 12))
    if m.chance(0.4):
        for y in (-0.15, 0.12):
            m.add("barrel", ring(pivot + vec(0, y * muzzle, 1.05 * r), (1, 0, 0), 0.4 * r, 0.09 * r, 12))
    m.hinge("barrel", pivot, (-1, 0, 0), m.pick((-3, 12), (-4, 9), (0, 14)))


def _howitzer(m: Model) -> None:
    """A gun in a cradle with a shield, trails that may spread, a breech and hand wheels."""
    n, wheel = m.pick(10, 16), m.number(0.38, 0.55)
    gap, axle, x = 0.2, wheel, m.number(0.65, 0.8)
    pivot, rear = vec(0, -0.05, wheel + m.number(0.3, 0.4)), m.number(0.5, 0.65)
    make = wheel_maker(m, ("tyre", "rim", "spoked", "disc"), 0.2)
    for k, s in enumerate((-1, 1)):
        make(f"wheel_{k}", (s * x, 0, axle), (s, 0, 0), wheel, 0.16)
        m.add(
            BASE,
            prism(
                [(-0.2, axle - 0.1), (0.25, axle - 0.1), (0.1, pivot[2] + 0.12), (-0.15, pivot[2] + 0.12)],
                "x",
                (s * gap, s * (gap + 0.05)),
            ),
        )
    m.add(
        BASE,
        box((-x + 0.08, x - 0.08), (-0.1, 0.1), (axle - 0.08, axle + 0.02)),
        rod((-x - 0.06, 0, axle), (x + 0.06, 0, axle), 0.05, 10),
    )
    _gun(m, pivot, rear, n)
    splits, tail = m.chance(0.6), m.number(1.6, 2.2)
    for s, side in ((-1, "right"), (1, "left")):
        part, at = (f"trail_{side}" if splits else BASE), vec(s * 0.3, 0.16, axle - 0.08)
        end = vec(s * m.pick(0.3, 0.34), tail, 0.08)
        m.add(
            BASE,
            box((s * 0.22, s * 0.38), (0.05, 0.14), (axle - 0.15, axle + 0.01)),
            rod(at - vec(0, 0.005, 0.07), at + vec(0, -0.005, 0.08), 0.028, 8),
        )
        m.add(part, beam(at, end, 0.09, 0.12), box((end[0] - 0.06, end[0] + 0.06), (tail - 0.02, tail + 0.02), (-0.08, 0.2)))
        if splits:
            m.hinge(part, at, (0, 0, -s), m.pick(25, 35))
    _shield_and_hand_wheels(m, pivot, axle, gap, x)


def _shield_and_hand_wheels(m: Model, pivot: Vector, axle: float, gap: float, x: float) -> None:
    """A shield with a gap for the gun in most; hand wheels that spin."""
    if m.chance(0.75):
        wide, top = x - 0.1, pivot[2] + m.number(0.35, 0.5)
        shield = Polygon(
            [(-wide, axle), (wide, axle), (wide, top - 0.15), (wide - 0.15, top), (0.15 - wide, top), (-wide, top - 0.15)]
        )
        hole = Polygon([(-0.17, pivot[2] - 0.28), (0.17, pivot[2] - 0.28), (0.17, top - 0.06), (-0.17, top - 0.06)])
        m.add(
            BASE,
            prism(shield.difference(hole), "y", (-0.24, -0.22)),
            *(box((s * 0.2, s * 0.25), (-0.23, 0.0), (axle, axle + 0.1)) for s in (-1, 1)),
        )
    for k in range(m.pick(0, 1, 2)):
        s = (-1, 1)[k]
        at = vec(s * (gap + 0.05), 0.06, pivot[2] - 0.06)
        hub = at + vec(s * 0.09, 0, 0)
        m.add(
            f"hand_wheel_{k}",
            ring(hub, (1, 0, 0), 0.1, 0.012, 16),
            rod(at - vec(s * 0.02, 0, 0), hub + vec(s * 0.01, 0, 0), 0.014, 8),
        )
        m.add(
            f"hand_wheel_{k}",
            beam(hub - vec(0, 0, 0.1), hub + vec(0, 0, 0.1), 0.02, 0.012),
            beam(hub - vec(0, 0.1, 0), hub + vec(0, 0.1, 0), 0.012, 0.02),
        )
        m.spin(f"hand_wheel_{k}", hub, (s, 0, 0))


def _gun(m: Model, pivot: Vector, rear: float, n: int) -> None:
    """Barrel, recoil tubes and cradle that pitch together; the breech swings aside or drops in some."""
    r, long = m.number(0.07, 0.1), m.number(1.3, 2.2)
    end = pivot + vec(0, rear, 0)
    m.add(
        "barrel",
        *upright([lathe([(0, 0), (1.2 * r, 0), (1.2 * r, 0.5), (r, 0.55), (0.7 * r, long), (0, long)], n)], (0, -1, 0), end),
    )
    m.add(
        "barrel",
        rod(pivot - vec(0.24, 0, 0), pivot + vec(0.24, 0, 0), 0.05, 10),
        box((-0.13, 0.13), (pivot[1] - 0.3, pivot[1] + 0.3), (pivot[2] - 1.9 * r, pivot[2] - 0.5 * r)),
    )
    for s in m.pick((0,), (-1, 1)):
        m.add(
            "barrel",
            rod(pivot + vec(0.5 * s * r, 0.35, 1.6 * r), pivot + vec(0.5 * s * r, -m.number(0.4, 0.7), 1.6 * r), 0.5 * r, n),
        )
    if m.chance(0.5):
        a = end - vec(0, long, 0)
        m.add("barrel", rod(a - vec(0, 0.12, 0), a + vec(0, 0.02, 0), 1.05 * r, n))
    form, q = m.pick("block", "door", "none"), 1.5 * r
    if form == "door":
        m.add(
            "breech",
            rod(end + vec(0, 0.001, 0), end + vec(0, 0.06, 0), 1.1 * r, n),
            box((-0.3 * r, 1.3 * r), (end[1] + 0.01, end[1] + 0.04), (pivot[2] - 0.3 * r, pivot[2] + 0.3 * r)),
        )
        m.add("breech", rod(end + vec(-0.5 * r, 0.05, 0), end + vec(-0.5 * r, 0.13, 0), 0.012, 8))
        m.hinge("breech", end + vec(1.3 * r, 0.002, 0), (0, 0, -1), m.pick(90, 120), "barrel")
    elif form == "block":
        frame = box((-q, q), (end[1] - 0.02, end[1] + 0.15), (pivot[2] - q, pivot[2] + q))
        slot = box((-0.7 * q, 0.7 * q), (end[1] + 0.03, end[1] + 0.11), (pivot[2] - 2 * q, pivot[2] + 0.8 * q))
        m.add("barrel", cut(frame, slot))
        m.add(
            "breech", box((-0.68 * q, 0.68 * q), (end[1] + 0.033, end[1] + 0.107), (pivot[2] - 0.98 * q, pivot[2] + 0.78 * q))
        )
        m.add(
            "breech", rod((-0.02, end[1] + 0.07, pivot[2] - 1.15 * q), (0.02, end[1] + 0.07, pivot[2] - 1.15 * q), 0.2 * q, 8)
        )
        m.slide("breech", (0, 0, -1), 1.1 * r, "barrel")
    m.hinge("barrel", pivot, (-1, 0, 0), m.pick((-5, 15), (0, 20)))
