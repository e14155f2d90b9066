"""A lever or wheel on a wall of one artist."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from shapely.geometry import Point as Spot
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.arena_style import Look, look
from training.kinds.model import BASE, Model
from training.kinds.robots.arena_controls import Plane
from training.kinds.solids import arch, ball, box, cut, prism, rectangle, ring, rod, rounded, vec


def wall_lever(m: Model) -> None:
    """A plate or box on a wall with a lever in a slot, a knife switch, a side lever, a floor-like quadrant or a wheel."""
    k = look(m)
    p = Plane(m, k, vec(0, 0, m.pick(0.0, 1.2)), 90)
    w, h, t = m.number(0.06, 0.14), m.number(0.1, 0.22), m.number(0.012, 0.08)
    outline = m.pick(
        rectangle((-w, w), (-h, h)),
        rounded((-w, w), (-h, h), 0.3 * w),
        Polygon([(-w, -h), (w, -h), (w, h - 0.5 * w), (0.5 * w, h), (-0.5 * w, h), (-w, h - 0.5 * w)]),
        arch((-w, w), (-h, h), w),
        Spot(0, 0).buffer(max(w, 0.7 * h), quad_segs=max(2, k.n // 4)),
    )
    m.pick(_slotted, _slotted, _knife, _beside, _wheel)(m, p, outline, w, h, t)
    if m.chance(0.5):
        low, r = outline.bounds[1], 0.012
        p.put(BASE, rod((0, low + 0.02, 0.5 * t), (0, low - m.number(0.1, 0.4), 0.5 * t), r, k.n))
    if m.chance(0.4):
        spots = [vec(q * 0.6 * w, 0.8 * h, t) for q in m.pick((-1, 1), (1,))]
        p.put(BASE, *(ball(at, (0.012, 0.012, 0.008), 8) for at in spots if outline.contains(Spot(at[0], at[1]))))
    if m.chance(0.25):
        p.put(BASE, box((-2 * w - 0.1, 2 * w + 0.1), (-1.6 * h, 1.6 * h), (-0.1, 0)))


def _plate(k: Look, outline: Polygon, t: float, slots: Sequence[Polygon] = ()) -> list[Trimesh]:
    """A plate with a slot through its front, or the panel of the style."""
    if not slots or k.style in ("low", "sheet"):
        return k.panel(outline, "z", (0, t)) if k.style != "sheet" else [prism(outline, "z", (0, t))]
    found = [cut(prism(outline, "z", (0, t)), *(prism(s, "z", (0.3 * t, 1)) for s in slots))]
    if k.style in ("cad", "old"):
        found.append(prism(outline.difference(outline.buffer(-0.01)), "z", (t - 0.001, t + 0.006)))
    return found


def _grip(m: Model, k: Look, end: np.ndarray, across: bool) -> list[Trimesh]:
    way = vec(1, 0, 0) if across else vec(0, 0, 1)
    kind = m.pick("ball", "bar", "grip", "ring", "none")
    if kind == "ball":
        return [ball(end, (m.number(0.018, 0.03),) * 3, max(8, k.n))]
    if kind == "bar":
        return [rod(end - 0.04 * way, end + 0.04 * way, 0.012, k.n)]
    if kind == "ring":
        return [ring(end + vec(0, 0, 0.02), (1, 0, 0) if across else (0, 1, 0), 0.024, 0.007, 16)]
    return [rod(end - vec(0, 0, 0.001), end + vec(0, 0, 0.07), 0.015, k.n)] if kind == "grip" and across else []


def _slotted(m: Model, p: Plane, outline: Polygon, w: float, h: float, t: float) -> None:
    """A lever that swings up and down, or sideways, in a slot of the plate."""
    k, count = p.k, m.pick(1, 1, 1, 2, 3)
    begin, reach = m.pick(0, 45, -45), m.number(0.1, 0.22)
    r = 0.012 if count > 1 else m.number(0.01, 0.018)
    spots = [w * 0.8 * (2 * i + 1 - count) / count for i in range(count)]
    slots = [rectangle((x - 1.3 * r, x + 1.3 * r), (-0.6 * h, 0.6 * h)) for x in spots]
    p.put(BASE, *_plate(k, outline, t, slots))
    for i, x in enumerate(spots):
        name = "lever" if count == 1 else f"lever_{i}"
        a = np.deg2rad(begin)
        pivot = vec(x, 0, 0.35 * t)
        end = pivot + reach * vec(0, np.sin(a), np.cos(a))
        p.put(name, *k.limb(pivot, end, 2 * r, 2 * r))
        p.put(name, *_grip(m, k, end, True))
        p.hinge(name, pivot, (-1, 0, 0) if begin <= 0 else (1, 0, 0), (-45, 45) if begin == 0 else m.pick(70, 90))
        if k.style in ("cad", "old") or m.chance(0.3):
            p.put(BASE, *(box((x + s * 1.4 * r, x + s * 2.0 * r), (-0.4 * h, 0.4 * h), (0.9 * t, t + 0.02)) for s in (-1, 1)))


def _knife(m: Model, p: Plane, outline: Polygon, w: float, h: float, t: float) -> None:
    """A knife switch: blades with a bar across that fall from the upper into the lower contacts."""
    k = p.k
    p.put(BASE, *_plate(k, outline, t))
    b, z, long = 0.5 * w, t + 0.03, 1.1 * h
    for s in (-1, 1):
        x = s * b
        p.put(
            BASE,
            *(
                box((x + q * 0.0045, x + q * 0.009), (y - 0.014, y + 0.014), (0.8 * t, z + 0.012))
                for q in (-1, 1)
                for y in (-0.55 * h, 0.55 * h)
            ),
        )
        p.put(BASE, rod((x - 0.012, -0.55 * h, z), (x + 0.012, -0.55 * h, z), 0.005, k.n))
        p.put("lever", box((x - 0.004, x + 0.004), (-0.55 * h - 0.01, -0.55 * h + long + 0.03), (z - 0.008, z + 0.008)))
    top = -0.55 * h + long + 0.03
    p.put("lever", box((-b - 0.012, b + 0.012), (top - 0.002, top + 0.018), (z - 0.01, z + 0.01)))
    p.put("lever", *k.limb((0, top + 0.009, z), (0, top + 0.009, z + 0.09), 0.028, 0.022))
    p.hinge("lever", (0, -0.55 * h, z), (1, 0, 0), m.pick(90, 120, 150))


def _beside(m: Model, p: Plane, outline: Polygon, w: float, h: float, t: float) -> None:
    """A lever on a boss that turns in the plane of the wall, or on the side of a box as on a breaker."""
    k = p.k
    p.put(BASE, *_plate(k, outline, t))
    reach = m.number(0.7, 1.5) * h
    if m.chance(0.5):
        a = np.deg2rad(m.pick(90, 60, 120, 0))
        z = t + 0.022
        end = vec(reach * np.cos(a), reach * np.sin(a), z)
        p.put(
            "lever",
            *k.limb((0, 0, z), end, 0.035, 0.02, (0, 0, 1), 0.7),
            rod((0, 0, t - 0.001), (0, 0, z + 0.02), 0.032, max(8, k.n)),
        )
        p.put("lever", *_grip(m, k, end, True))
        p.hinge("lever", (0, 0, t), (0, 0, m.pick(1, -1)), m.pick(90, 60, 120))
        return
    x, z = outline.bounds[2], 0.5 * max(t, 0.03)
    p.put(BASE, rod((0, 0, z), (x + 0.012, 0, z), 0.02, max(8, k.n)))
    p.put("lever", *k.limb((x + 0.022, 0, z), (x + 0.022, 0.7 * reach, z + 0.05), 0.02, 0.03))
    p.put("lever", rod((x + 0.010, 0, z), (x + 0.034, 0, z), 0.024, max(8, k.n)))
    p.put("lever", *_grip(m, k, vec(x + 0.022, 0.7 * reach, z + 0.05), True))
    p.hinge("lever", (x + 0.022, 0, z), (1, 0, 0), m.pick(110, 90, 140))


def _wheel(m: Model, p: Plane, outline: Polygon, w: float, h: float, t: float) -> None:
    """A hand wheel on a spindle, with spokes and perhaps a crank grip, or a star."""
    k, r, z = p.k, m.number(0.07, 0.16), t + m.number(0.03, 0.06)
    p.put(BASE, *_plate(k, outline, t), rod((0, 0, 0), (0, 0, z - 0.02), 0.022, max(8, k.n)))
    p.put("wheel", rod((0, 0, z - 0.021), (0, 0, z + 0.015), 0.02, max(8, k.n)))
    star = m.chance(0.25)
    spokes = m.pick(3, 4, 5, 6)
    for i in range(spokes):
        a = 2 * np.pi * i / spokes
        end = vec(r * np.cos(a), r * np.sin(a), z)
        p.put("wheel", *k.limb((0, 0, z), end, 0.018, 0.014, (0, 0, 1)))
        if star:
            p.put("wheel", ball(end, (0.02,) * 3, max(8, k.n)))
    if not star:
        p.put("wheel", ring((0, 0, z), (0, 0, 1), r, m.number(0.007, 0.014), max(16, 2 * k.n)))
        if m.chance(0.4):
            p.put("wheel", rod((r, 0, z), (r, 0, z + 0.07), 0.011, k.n))
    m.spin("wheel", p.at(0, 0, z), p.turn() @ vec(0, 0, 1))
