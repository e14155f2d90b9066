"""A landing ship of one artist, with ramp, legs, turrets, nacelles and canopies; its nose looks to -Y."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.arena_style import Look, bevelled, look
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rectangle, rod, vec


def landing_ship(m: Model) -> None:
    """A box, a wedge or a saucer on legs, with a ramp at the rear, in front or below, guns, engines and a cockpit."""
    k, style = look(m), m.pick("box", "wedge", "saucer", "long")
    w, d, h = m.number(1.4, 2.4), m.number(2.5, 4.0), m.number(0.7, 1.2)
    if style == "long":
        w, d = 0.8 * w, 1.3 * d
    z = m.number(0.8, 1.3)
    outline = {
        "box": rectangle((-w, w), (-d, d)),
        "long": Polygon([(-w, d), (w, d), (w, -0.6 * d), (0.5 * w, -d), (-0.5 * w, -d), (-w, -0.6 * d)]),
        "wedge": Polygon([(-w, d), (w, d), (w, 0.1 * d), (0.25 * w, -d), (-0.25 * w, -d), (-w, 0.1 * d)]),
        "saucer": Polygon([(w * 1.2 * np.cos(a), w * 1.2 * np.sin(a)) for a in 2 * np.pi * np.arange(16) / 16]),
    }[style]
    if style == "saucer":
        w = d = 1.2 * w
    door = m.number(0.35, 0.5) * w
    ramp = "below" if style == "saucer" else m.pick("rear", "rear", "below", "front" if style == "box" else "rear")
    hull = prism(outline, "z", (z, z + h))
    deep, top = 0.5 * d, z + 0.85 * h
    at = {"rear": d, "front": -d, "below": 0.6 * d}[ramp]
    away = -1 if ramp == "front" else 1
    if ramp == "below":
        length = m.number(0.5, 0.8) * d
        hull = cut(hull, box((-door, door), (at - length, at), (z - 1, z + 0.7 * h)))
    else:
        hull = cut(hull, box((-door, door), (at - away * deep, at + away), (z + 0.12 * h, top)))
    m.add(BASE, hull)
    t = 0.05 * h
    if ramp == "below":
        m.add("ramp", *k.plate((-0.98 * door, 0.98 * door), (at - 0.985 * length, at - 0.015 * length), (z, z + t), "-z"))
        angle = np.rad2deg(np.arcsin(min(0.9, z / length)))
        m.hinge("ramp", (0, at - 0.985 * length, z + t / 2), (-1, 0, 0), round(float(angle)))
    else:
        span = (at - away * t, at + away * 0.2 * t)
        m.add(
            "ramp",
            *k.plate((-0.98 * door, 0.98 * door), span, (z + 0.13 * h, top - 0.01 * h), ("+" if away > 0 else "-") + "y"),
        )
        m.hinge("ramp", (0, at, z + 0.13 * h), (-away, 0, 0), m.pick(90, 110, 120))
    _legs(m, k, w, d, z, style)
    deck = z + h
    if style != "wedge" and m.chance(0.6):
        deck = z + m.number(1.12, 1.4) * h
        m.add(BASE, prism(outline.buffer(-m.pick(0.1, 0.2) * w, join_style="mitre"), "z", (z + h - 0.01, deck)))
    _upper(m, k, style, w, d, deck, h)
    _engines(m, k, style, w, d, z, h)


def _legs(m: Model, k: Look, w: float, d: float, z: float, style: str) -> None:
    """Legs that fold up or slide in, each with a pad."""
    folds, wide = m.chance(0.6), 0.12 * w
    corners = (
        [(x, y) for x in (-1, 1) for y in (-0.55, 0.75)]
        if style == "box" or m.chance(0.6)
        else [(0, -0.75), (-1, 0.6), (1, 0.6)]
    )
    for i, (x, y) in enumerate(corners):
        out = 0.62 if (style in ("saucer", "wedge") and y < 0.7) or style == "long" else 0.75
        at = vec(x * out * w * (0.35 if style == "wedge" and y < 0 else 1.0), y * d * (0.75 if style == "saucer" else 0.95), z)
        part = f"landing_leg_{i}"
        foot = at * (1, 1, 0) + vec(0, 0, 0.06)
        m.add(part, *k.limb(at + vec(0, 0, 0.03), foot, wide, wide))
        m.add(part, rod(foot - vec(0, 0, 0.06), foot + vec(0, 0, 0.02), 1.3 * wide, max(6, k.n)))
        if folds:
            m.hinge(part, at, (-1 if y < 0 else 1, 0, 0), m.pick(80, 85))
            m.add(BASE, rod(at - vec(wide, 0, 0), at + vec(wide, 0, 0), 0.4 * wide, k.n))
        else:
            m.add(
                BASE,
                *(
                    box((at[0] + s * 0.6 * wide, at[0] + s * 0.8 * wide), (at[1] - wide, at[1] + wide), (0.75 * z, z))
                    for s in (-1, 1)
                ),
            )
            m.slide(part, (0, 0, 1), 0.6 * z)


def _upper(m: Model, k: Look, style: str, w: float, d: float, top: float, h: float) -> None:
    """On the roof: a cockpit with a canopy, turrets, a hatch, fins."""
    front = -0.55 * d if style != "saucer" else -0.5 * d
    c = 0.3 * w if style != "wedge" else 0.2 * w
    if m.chance(0.75):
        shape = [(front - 0.18 * d, top), (front + 0.2 * d, top), (front + 0.2 * d, top + 0.35 * h), (front, top + 0.4 * h)]
        part = "canopy" if m.chance(0.6) else BASE
        if part == BASE:
            m.add(BASE, prism(shape, "x", (-c, c)))
        else:
            shape = [(y, z + 0.002) for y, z in shape]
            m.add(part, prism(shape, "x", (-c, c)))
            m.hinge(part, (0, front + 0.2 * d, top), (-1, 0, 0), m.pick(45, 65))
    count = m.pick(0, 1, 1, 2)
    for i in range(count):
        x, y = ((i - 0.5 * (count - 1)) * 0.9 * w, 0.35 * d)
        _turret(m, k, f"turret_{i}", vec(x, y, top), 0.16 * w, 1)
    if m.chance(0.35):
        m.add("hatch", *k.plate((-0.2 * w, 0.2 * w), (-0.1 * d, 0.06 * d), (top + 0.001, top + 0.06 * h), "+z"))
        m.hinge("hatch", (0, 0.06 * d, top), (-1, 0, 0), 90)
    if m.chance(0.4) and style != "saucer":
        m.add(
            BASE,
            *(
                prism(
                    [(0.6 * d, top - 0.05), (d, top - 0.05), (d, top + 0.9 * h), (0.85 * d, top + 0.9 * h)],
                    "x",
                    (s * 0.8 * w, s * 0.86 * w),
                )
                for s in (-1, 1)
            ),
        )
    if m.chance(0.5):
        m.add(
            BASE,
            *(
                s
                for x in (-0.6, 0.6)
                for s in k.plate((x * w - 0.1 * w, x * w + 0.1 * w), (-0.05 * d, 0.15 * d), (top - 0.01, top + 0.05), "+z")
            ),
        )


def _turret(m: Model, k: Look, part: str, at: np.ndarray, r: float, up: int) -> None:
    """A drum that turns with one or two guns that pitch."""
    n = max(8, k.n)
    m.add(part, rod(at - vec(0, 0, 0.02), at + vec(0, 0, up * 0.5 * r), r, n))
    m.add(
        part,
        *k.body(
            (at[0] - 0.6 * r, at[0] + 0.6 * r), (at[1] - 0.7 * r, at[1] + 0.7 * r), (at[2] + 0.45 * r, at[2] + 1.2 * r), "-z"
        ),
    )
    m.spin(part, at, (0, 0, 1)) if m.chance(0.3) else m.hinge(part, at, (0, 0, 1), (-160, 160))
    gun, axle = part.replace("turret", "gun"), at + vec(0, 0, 0.8 * r)
    for x in m.pick((0.0,), (-0.8, 0.8)):
        a = axle + vec(x * r, -0.4 * r, 0)
        m.add(gun, rod(a, a - vec(0, 1.9 * r, 0), 0.12 * r, k.n), *k.body(*((c - 0.2 * r, c + 0.2 * r) for c in a)))
    m.hinge(gun, axle - vec(0, 0.4 * r, 0), (-1, 0, 0), m.pick((-5, 60), (-10, 45)), part)


def _engines(m: Model, k: Look, style: str, w: float, d: float, z: float, h: float) -> None:
    """Nacelles at the sides that tilt or stay, nozzles behind, doors in the sides."""
    kind = m.pick("tilting", "fixed", "none", "tilting") if style in ("box", "long") else "none"
    if kind != "none":
        r = m.number(0.3, 0.45) * h
        for i, y in enumerate(m.pick((-0.45, 0.6), (0.35,))):
            for s, side in ((-1, "right"), (1, "left")):
                part = f"engine_{side}_{i}" if kind == "tilting" else BASE
                x, at = s * (w + 1.5 * r), vec(s * (w + 1.5 * r), y * d, z + 0.6 * h)
                m.add(BASE, rod((s * 0.9 * w, y * d, at[2]), (s * (w + 0.8 * r), y * d, at[2]), 0.3 * r, max(8, k.n)))
                m.add(part, *k.body((x - r, x + r), (at[1] - 1.6 * r, at[1] + 1.6 * r), (at[2] - r, at[2] + r)))
                m.add(part, rod(at + vec(0, 1.5 * r, 0), at + vec(0, 2.1 * r, 0), 0.8 * r, max(8, k.n)))
                if part != BASE:
                    m.hinge(part, at, (1, 0, 0), m.pick((0, 90), (-20, 90)))
    if style != "saucer":
        m.add(
            BASE,
            *(
                rod((s * 0.75 * w, d - 0.05, z + 0.5 * h), (s * 0.75 * w, d + 0.3 * h, z + 0.5 * h), 0.2 * h, max(8, k.n))
                for s in m.pick((-1, 1), (-1, 1), ())
            ),
        )
    if style == "box" and kind == "none" and m.chance(0.7):
        for s, side in ((-1, "right"), (1, "left")):
            x = (s * w, s * (w + 0.05))
            m.add(
                f"door_{side}", *k.plate(x, (-0.6 * d, -0.25 * d), (z + 0.15 * h, z + 0.9 * h), ("+" if s > 0 else "-") + "x")
            )
            m.slide(f"door_{side}", (0, 1, 0), 0.34 * d)
            m.add(BASE, box((s * w, s * (w + 0.07)), (-0.65 * d, 0.2 * d), (z + 0.91 * h, z + 0.96 * h)))
    if m.chance(0.4) and k.style != "sheet":
        m.add(BASE, bevelled((-0.3 * w, 0.3 * w), (-0.35 * d, 0.0), (z - 0.15, z + 0.02), 0.04))
