"""Winged corkscrews."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot
from shapely.geometry import Polygon

from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, tube


def _bell(m: Model, style: str, r: float, high: float, n: int) -> None:
    """The ring that sits on the neck of a bottle: a bell, a ring on two arms, or a slotted skirt, from z = 0 to high."""
    if style == "bell":
        wall = 0.003
        m.add(
            BASE,
            lathe(
                [
                    (r, 0),
                    (r, 0.3 * high),
                    (0.75 * r, 0.9 * high),
                    (0.62 * r, high),
                    (0.5 * r, 0.95 * high),
                    (0.75 * r - wall, 0.85 * high),
                    (r - wall, 0.3 * high),
                    (r - wall, 0),
                    (r, 0),
                ],
                n,
                caps=False,
            ),
        )
    elif style == "arms":
        m.add(BASE, cut(rod((0, 0, 0), (0, 0, 0.018), r, n), rod((0, 0, -1), (0, 0, 1), r - 0.004, n)))
        outline = [
            (r - 0.005, 0.012),
            (r, 0.012),
            (0.75 * r, high),
            (0.52 * r, high + 0.006),
            (0.52 * r, high),
            (0.62 * r, high - 0.004),
        ]
        for s in (-1, 1):
            m.add(BASE, prism([(s * a, b) for a, b in outline], "y", (-0.35 * r, 0.35 * r)))
    else:
        skirt = cut(rod((0, 0, 0), (0, 0, high), r, n), rod((0, 0, -1), (0, 0, high - 0.004), r - 0.003, n))
        slot = box((-2 * r, 2 * r), (-0.4 * r, 0.4 * r), (0.25 * high, 0.75 * high))
        m.add(BASE, cut(skirt, slot, rod((0, 0, -1), (0, 0, 1), 0.0075, n)))


def _wing(m: Model, s: int, pivot: tuple[float, float], long: float, thick: float, style: str) -> None:
    """A lever with a toothed head that hangs beside the bell: flat, tapered, with a ring or with a paddle at its end."""
    part, (a, b), lean = ("wing_right" if s > 0 else "wing_left"), pivot, 0.16
    head, depth = 0.013, (-thick / 2, thick / 2)
    t = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    gear = Polygon(np.c_[np.cos(t), np.sin(t)] * np.where(np.arange(40) % 4 < 2, head, 0.82 * head)[:, None])
    end = np.array([lean * long, -long])
    side = np.array([1.0, lean]) / np.hypot(1, lean)
    w0, w1 = (0.5 * head, 0.75 * head) if style not in ("tapered", "ball") else (0.8 * head, 0.35 * head)
    arm = Polygon([w0 * side, -w0 * side, end - w1 * side, end + w1 * side])
    shape = gear.union(arm)
    if style == "ring":
        shape = shape.union(Dot(*end).buffer(1.3 * head, 8)).difference(Dot(*end).buffer(0.7 * head, 8))
    elif style == "paddle":
        shape = shape.union(Dot(*(0.82 * end)).buffer(1.15 * head, 8)).union(Dot(*end).buffer(1.05 * head, 8))
    outline = Polygon(
        [(s * (p + abs(a)), q + b) for p, q in shape.exterior.coords],
        [[(s * (p + abs(a)), q + b) for p, q in i.coords] for i in shape.interiors],
    )
    m.add(part, prism(outline, "y", depth))
    if style == "ball":
        m.add(part, ball((s * (end[0] + abs(a)), 0, end[1] + b), (0.011,) * 3, 12))
    m.hinge(part, (a, 0, b), (0, -s, 0), m.number(105, 130))


def _worm(m: Model, part: str, top: float, low: float) -> None:
    """The screw: a wire wound round a line, drawn as a coil, or a threaded rod."""
    r, turns = m.number(0.0025, 0.0035), 6
    t = np.linspace(0, 2 * np.pi * turns, 8 * turns)
    path = np.c_[r * np.cos(t), r * np.sin(t), np.linspace(top, low, len(t))]
    m.add(part, tube(path, 0.0016, 5))


def corkscrew(m: Model) -> None:
    """A bell for the neck, a screw that goes down through it, two levers that rise as it does; a key on top."""
    n, r, bell = m.pick(16, 24, 32), m.number(0.014, 0.018), m.number(0.055, 0.07)
    _bell(m, m.pick("bell", "arms", "arms", "skirt"), r, bell, n)
    box_half, high, thick = m.number(0.011, 0.013), m.number(0.03, 0.036), m.number(0.006, 0.009)
    z, pivot = (bell, bell + high), box_half + 0.009
    y0, plate = thick / 2 + 0.0005, m.number(0.002, 0.003)
    cheek = rounded((-pivot - 0.008, pivot + 0.008), (bell - 0.002, z[1]), 0.006)
    for s in (-1, 1):
        m.add(BASE, prism(cheek, "y", (s * y0, s * (y0 + plate))))
        m.add(
            BASE,
            rod(
                (s * pivot, -y0 - plate - 0.001, bell + 0.5 * high),
                (s * pivot, y0 + plate + 0.001, bell + 0.5 * high),
                0.003,
                10,
            ),
        )
    m.add(BASE, cut(rod((0, 0, bell - 0.004), (0, 0, bell + 0.002), 0.009, n), rod((0, 0, -1), (0, 0, 1), 0.0072, n)))
    m.add(
        BASE,
        cut(rod((0, 0, z[1] - 0.006), (0, 0, z[1] + m.number(0.002, 0.01)), 0.0105, n), rod((0, 0, -1), (0, 0, 1), 0.0075, n)),
    )
    style, long = m.pick("flat", "tapered", "ball", "ring", "paddle"), m.number(0.075, 0.1)
    for s in (-1, 1):
        _wing(m, s, (s * pivot, bell + 0.5 * high), long, thick, style)
    shaft, travel = z[1] + m.number(0.028, 0.036), m.number(0.025, 0.03)
    m.add("screw", rod((0, 0, bell - 0.004), (0, 0, shaft), 0.005, 12))
    m.add("screw", *(rod((0, 0, c), (0, 0, c + 0.0018), 0.0068, 12) for c in np.arange(bell, shaft - 0.006, 0.0042)))
    _worm(m, "screw", bell, 0.018)
    key = m.pick("opener", "bar", "butterfly", "ring")
    if key == "opener":
        shape = Dot(0, shaft + 0.014).buffer(0.018, 12).difference(Dot(0, shaft + 0.016).buffer(0.01, 10))
        m.add("screw", prism(shape, "y", (-0.003, 0.003)))
    elif key == "bar":
        m.add("screw", rod((-0.032, 0, shaft + 0.004), (0.032, 0, shaft + 0.004), 0.007, m.sections()))
    elif key == "butterfly":
        m.add(
            "screw",
            prism(
                [(-0.026, shaft + 0.02), (-0.022, shaft), (0.022, shaft), (0.026, shaft + 0.02), (0, shaft + 0.01)],
                "y",
                (-0.003, 0.003),
            ),
        )
    else:
        m.add("screw", ring((0, 0, shaft + 0.013), (0, 1, 0), 0.014, 0.003, 20))
    m.slide("screw", (0, 0, -1), travel)
