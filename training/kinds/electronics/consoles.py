"""Things full of buttons and knobs: game controller, telephone, radio."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point

from training.kinds.electronics.controls import button, knob
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam


def game_controller(m: Model) -> None:
    """A pad with two sticks that tilt, a cross, buttons and triggers."""
    half, n = m.number(0.065, 0.08), m.pick(6, 10, 16)
    body = rounded((-half, half), (-0.025, 0.035), 0.02)
    for s in (-1, 1):
        body = body.union(Point(s * 0.7 * half, -0.01).buffer(0.035, quad_segs=n // 2))
    high = m.number(0.025, 0.035)
    if m.chance(0.6):
        m.add(BASE, prism(body, "z", (0, high)))
    else:
        m.add(BASE, prism(body, "z", (0, 0.5 * high)), prism(body.buffer(-0.002), "z", (0.5 * high, high)))
    for s in (-1, 1):
        m.add(BASE, ball((s * 0.85 * half, -0.045, 0.4 * high), (0.018, 0.045, 0.5 * high), n))
    spots = [(-0.35 * half, -0.02), (0.35 * half, -0.02)] if m.chance(0.5) else [(-0.7 * half, 0.012), (0.35 * half, -0.02)]
    for k, (x, y) in enumerate(spots):
        name, at = f"stick_{k}", vec(x, y, high)
        m.add(BASE, ring(at, (0, 0, 1), 0.013, 0.0015, 16))
        m.add(
            name,
            rod(at - vec(0, 0, 0.005), at + vec(0, 0, 0.01), 0.004, n),
            rod(at + vec(0, 0, 0.009), at + vec(0, 0, 0.014), 0.009, n),
        )
        m.hinge(name, at - vec(0, 0, 0.003), m.pick((1, 0, 0), (0, 1, 0)), (-20, 20))
    cross = vec(-0.7 * half if spots[0][0] > -0.5 * half else -0.35 * half, 0.012 if spots[0][0] > -0.5 * half else -0.02, high)
    if m.chance(0.5):
        arms = box((-0.012, 0.012), (-0.004, 0.004), (-0.002, 0.004)), box((-0.004, 0.004), (-0.012, 0.012), (-0.002, 0.0035))
        m.add("cross", *(a.apply_translation(cross) for a in arms))
        m.hinge("cross", cross, (1, 0, 0), (-8, 8))
    else:
        for k, (dx, dy) in enumerate(((0.009, 0), (-0.009, 0), (0, 0.009), (0, -0.009))):
            x, y = cross[0] + dx, cross[1] + dy
            button(m, f"arrow_{k}", (x - 0.004, x + 0.004), (y - 0.004, y + 0.004), high, 0.003)
    style = m.pick("disc", "dome", "disc")
    for k, (dx, dy) in enumerate(((0.011, 0), (-0.011, 0), (0, 0.011), (0, -0.011))):
        x, y = 0.7 * half + dx, 0.012 + dy
        button(m, f"button_{k}", (x - 0.005, x + 0.005), (y - 0.005, y + 0.005), high, 0.004, style=style)
    for k in range(m.pick(0, 1, 2)):
        x = (-0.012, 0.012)[k]
        button(m, f"menu_{k}", (x - 0.004, x + 0.004), (0.02, 0.024), high, 0.0015, style="rounded")
    for s, side in ((-1, "left"), (1, "right")):
        x = tuple(sorted((s * 0.5 * half, s * 0.9 * half)))
        m.add(f"shoulder_{side}", box(x, (0.033, 0.042), (0.62 * high, 0.95 * high)))
        m.hinge(f"shoulder_{side}", (s * 0.5 * half, 0.035, 0.8 * high), (0, 0, -s), 6)
        if m.chance(0.7):
            m.add(f"trigger_{side}", beam((s * 0.7 * half, 0.03, 0.5 * high), (s * 0.7 * half, 0.055, 0.1 * high), 0.02, 0.01))
            m.hinge(f"trigger_{side}", (s * 0.7 * half, 0.03, 0.5 * high), (-1, 0, 0), 18)
    if m.chance(0.4):
        m.add(BASE, box((-0.02, 0.02), (0.005, 0.018), (high, high + 0.001)))


def telephone(m: Model) -> None:
    """A desk set: a handset on its cradle, keys or a dial."""
    wide, deep, high = m.number(0.16, 0.24), m.number(0.18, 0.24), m.number(0.05, 0.08)
    m.add(BASE, prism(rounded((0, wide), (0, deep), m.pick(0.003, 0.02)), "z", (0, 0.6 * high)))
    top, side = 0.6 * high, m.chance(0.6)
    right = wide - 0.01
    x0 = 0.075 if side else 0.02
    if m.chance(0.65):
        pitch, style = min((right - x0) / 3, 0.028), m.pick("box", "rounded", "disc", "taper")
        for r in range(4):
            for c in range(3):
                x, y = x0 + c * pitch, 0.015 + r * 0.8 * pitch
                button(m, f"key_{r}{c}", (x + 0.002, x + pitch - 0.003), (y, y + 0.65 * pitch), top, 0.004, style=style)
    else:
        at, r = vec((x0 + right) / 2, 0.07, top), min(0.045, (right - x0) / 2)
        turns = np.linspace(0.2, 5.2, 10)
        holes = [
            rod(
                at + vec(0.72 * r * np.cos(t), 0.72 * r * np.sin(t), -1),
                at + vec(0.72 * r * np.cos(t), 0.72 * r * np.sin(t), 1),
                0.15 * r,
                10,
            )
            for t in turns
        ]
        m.add("dial", cut(rod(at, at + vec(0, 0, 0.006), r, 32), *holes), rod(at, at + vec(0, 0, 0.01), 0.4 * r, 20))
        m.spin("dial", at, (0, 0, 1))
        m.add(BASE, rod(at - vec(0, 0, 0.005), at + vec(0, 0, 0.001), 1.08 * r, 24))
    a, b = (
        (vec(0.037, 0.03, top + 0.03), vec(0.037, deep - 0.03, top + 0.03))
        if side
        else (vec(-0.01, deep - 0.04, top + 0.03), vec(wide + 0.01, deep - 0.04, top + 0.03))
    )
    m.add("handset", beam(a, b, 0.03 if side else 0.025, 0.02, (1, 0, 0) if side else (0, 1, 0)))
    for end in (a, b):
        m.add("handset", rod(end - vec(0, 0, 0.025), end + vec(0, 0, 0.012), 0.024, m.sections()))
    m.slide("handset", (0, 0, 1), 0.03)
    if m.chance(0.5):
        y = deep - 0.04
        x = (0.03, 0.045) if side else (wide / 2 - 0.01, wide / 2 + 0.01)
        button(m, "hook", x, (y - 0.04, y - 0.02), top, 0.012)
    if side and m.chance(0.7):
        m.add("display", box((x0, right), (deep - 0.06, deep - 0.015), (top, top + 0.006)))
        m.hinge("display", (wide / 2, deep - 0.015, top), (-1, 0, 0), 60)
    t = np.linspace(0, 10 * np.pi, 90)
    m.add(BASE, tube(np.c_[0.005 * np.cos(t) - 0.02, 0.05 + 0.003 * t, 0.008 + 0.005 * np.sin(t)], 0.0015, 5))


def radio(m: Model) -> None:
    """A case with a grille, knobs, perhaps a row of keys, an antenna that swings up and a handle."""
    wide, deep, high, n = m.number(0.18, 0.4), m.number(0.06, 0.14), m.number(0.12, 0.24), m.sections()
    case = rounded((0, wide), (0, high), m.pick(0.005, 0.02, 0.05))
    m.add(BASE, prism(case, "y", (0, deep)))
    x, r = m.pick(0.3, 0.7) * wide, 0.36 * min(high, 0.5 * wide)
    style = m.pick("ring", "slats", "dots")
    if style == "ring":
        m.add(BASE, ring((x, 0, high / 2), (0, 1, 0), r, 0.006, 24), rod((x, -0.003, high / 2), (x, 0.001, high / 2), r, 20))
    elif style == "slats":
        m.add(
            BASE, *(box((x - r, x + r), (-0.004, 0.001), (z, z + 0.004)) for z in np.arange(high / 2 - r, high / 2 + r, 0.01))
        )
    else:
        m.add(
            BASE,
            *(
                rod((x + a, -0.003, high / 2 + b), (x + a, 0.001, high / 2 + b), 0.005, 6)
                for a in np.linspace(-r, r, 6)
                for b in np.linspace(-r, r, 6)
            ),
        )
    other = wide - x
    m.add(BASE, box((other - 0.2 * wide, other + 0.2 * wide), (-0.002, 0.001), (0.65 * high, 0.85 * high)))
    size = min(m.number(0.08, 0.13) * high + 0.002, 0.052 * wide)
    for k in range(m.pick(1, 2, 3)):
        knob(m, f"knob_{k}", (other + (k - 1) * 0.14 * wide, 0, 0.3 * high), (0, -1, 0), size)
    if m.chance(0.4):
        for k in range(m.pick(3, 5)):
            a = 0.25 * wide + k * 0.1 * wide
            button(m, f"key_{k}", (a, a + 0.08 * wide), (0.25 * deep, 0.7 * deep), high, 0.006)
    if m.chance(0.8):
        s, y = m.pick(-1, 1), deep + 0.004
        a = vec(wide / 2 + s * 0.42 * wide, y, 0.93 * high)
        b = a - vec(s * 0.8 * wide, 0, 0)
        m.add(
            "antenna",
            rod(a, b, 0.003, 8),
            rod(0.4 * a + 0.6 * b, b - vec(s * 0.01, 0, 0), 0.002, 8),
            rod(a - vec(0, 0.004, 0), a + vec(0, 0.004, 0), 0.005, n),
        )
        m.hinge("antenna", a, (0, s, 0), m.pick(90, 150))
    if m.chance(0.6):
        path = [
            (-0.004, deep / 2, 0.8 * high),
            (-0.004, deep / 2, high + 0.03),
            (wide + 0.004, deep / 2, high + 0.03),
            (wide + 0.004, deep / 2, 0.8 * high),
        ]
        moves = m.chance(0.7)
        m.add("handle" if moves else BASE, tube(path, 0.005, 8))
        if moves:
            m.hinge("handle", path[0], (1, 0, 0), (-80, 80))
    if m.chance(0.4):
        m.add("battery", box((0.2 * wide, 0.7 * wide), (deep - 0.002, deep + 0.002), (0.1 * high, 0.5 * high)))
        m.slide("battery", (0, 0, -1), 0.1 * high)
