"""Bread makers and hand mixers."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.counter.counter_appliances import back_hinge, bar, tower
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, cable, dial, lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, loft, prism, ring, rod, rounded, vec


def bread_maker(m: Model) -> None:
    """Make a bread maker: lid over all of it or beside a panel, with a window or vents, a pan with bail and blade, buttons."""
    place = m.pick("front", "side", "slope", "whole")
    w, d, h = m.number(0.34, 0.4) if place == "side" else m.number(0.23, 0.29), m.number(0.26, 0.36), m.number(0.24, 0.32)
    x, y = (-w / 2, w / 2), (-d / 2, d / 2)
    if place == "slope":
        outline = [(y[0], 0.01), (y[1], 0.01), (y[1], h), (y[0] + 0.06, h), (y[0], h - m.number(0.06, 0.12))]
        shell = prism(outline, "x", x)
    else:
        corner = 0.1 if place == "whole" else m.pick(0.1, 0.25)
        shell = tower(x, y, corner * min(w, d), [(0.95, 0.008), (1, 0.03), (1, h - 0.015), (0.96, h)])
    a = (x[0] + 0.012, x[1] - (0.32 * w if place == "side" else 0.012))
    b = (y[0] + {"front": 0.09, "side": 0.012, "slope": 0.065, "whole": 0.006}[place], y[1] - 0.02)
    center, hollow = (middle(a), middle(b)), m.chance(0.75)
    room = shrunk(a, 0.03), shrunk(b, 0.03)
    if hollow:
        shell = cut(shell, prism(rounded(*room, 0.02), "z", (0.05, h + 0.1)))
        _bread_pan(m, shrunk(room[0], 0.012), shrunk(room[1], 0.012), h)
    m.add(BASE, shell, *(rod((c, e, 0), (c, e, 0.012), 0.012, 8) for c in (-0.35 * w, 0.35 * w) for e in (-0.38 * d, 0.38 * d)))
    _bread_lid(m, a, b, h, center)
    _bread_panel(m, place, w, d, h, a, b)
    if m.chance(0.4):
        cable(m, (0, d / 2 - 0.01, 0.04), 0.2)


def _bread_pan(m: Model, x: Span, y: Span, h: float) -> None:
    top, c = h - 0.03, (middle(x), middle(y))
    m.add(BASE, cut(box(x, y, (0.055, top)), box(shrunk(x, 0.003), shrunk(y, 0.003), (0.06, h))))
    if m.chance(0.6):
        m.add(
            "bail",
            bar(
                [
                    (x[0], c[1], top - 0.012),
                    (x[0], y[1] - 0.02, top - 0.004),
                    (x[1], y[1] - 0.02, top - 0.004),
                    (x[1], c[1], top - 0.012),
                ],
                0.002,
                6,
            ),
        )
        m.hinge("bail", (c[0], c[1], top - 0.012), (1, 0, 0), 90)
    if m.chance(0.7):
        m.add(
            "blade",
            rod((*c, 0.058), (*c, 0.09), 0.009, 10),
            box((c[0], c[0] + 0.04), (c[1] - 0.003, c[1] + 0.003), (0.065, 0.095)),
        )
        m.spin("blade", (*c, 0.06), (0, 0, 1))


def _bread_lid(m: Model, a: Span, b: Span, h: float, c: tuple[float, float]) -> None:
    z, low = h + m.number(0.025, 0.05), h + m.pick(0.0, 0.001, 0.003)
    lid = tower(a, b, 0.12 * (a[1] - a[0]), [(1, low), (1, z - 0.012), (m.pick(0.97, 0.85), z)])
    wx, wy = 0.22 * (a[1] - a[0]), 0.2 * (b[1] - b[0])
    spread = (c[0] - wx, c[0] + wx), (c[1] - wy, c[1] + wy)
    kind = m.pick("window", "pane", "vents", "dispenser", "plain")
    if kind == "window":
        lid = cut(lid, box(*spread, (h - 1, h + 1)))
        m.add("lid", box(*spread, (z - 0.015, z - 0.011)))
    elif kind == "pane":
        m.add("lid", prism(rounded(*spread, 0.01), "z", (z - 0.001, z + 0.002)))
    elif kind == "vents":
        m.add(
            "lid",
            *(
                box((c[0] + k * 0.012 - 0.003, c[0] + k * 0.012 + 0.003), spread[1], (z - 0.001, z + 0.002))
                for k in range(-3, 4)
            ),
        )
    elif kind == "dispenser":
        m.add(
            "flap",
            box(*spread, (z, z + 0.008)),
            box((c[0] - 0.015, c[0] + 0.015), (spread[1][0] - 0.01, spread[1][0]), (z + 0.003, z + 0.008)),
        )
        back_hinge(m, "flap", (c[0], spread[1][1], z + 0.002), wx, m.pick(80, 100), "lid")
    m.add("lid", lid)
    if m.chance(0.8):
        m.add("lid", box((c[0] - 0.04, c[0] + 0.04), (b[0] - 0.012, b[0] + 0.01), (low + 0.004, low + 0.016)))
    back_hinge(m, "lid", (c[0], b[1], low), 0.5 * (a[1] - a[0]), m.pick(75, 90, 100))


def _bread_panel(m: Model, place: str, w: float, d: float, h: float, a: Span, b: Span) -> None:
    count, y = m.pick(2, 3, 5), -d / 2
    if place == "side":
        c, spread, normal = (a[1] + w / 2) / 2, 0.6 * d, (0, 0, 1)
        spots = [(c, -0.35 * d + k * spread / count, h - 0.001) for k in range(count)]
        m.add(BASE, box((c - 0.03, c + 0.03), (0.25 * d, 0.4 * d), (h - 0.01, h + 0.002)))
    elif place == "front":
        normal, c = (0, 0, 1), y + 0.03
        spots = [(-0.36 * w + k * 0.42 * w / count, c, h - 0.001) for k in range(count)]
        m.add(BASE, box((0.12 * w, 0.38 * w), (c - 0.012, c + 0.03), (h - 0.01, h + 0.002)))
    else:
        normal = (0, -1, 0)
        spots = [(-0.36 * w + k * 0.42 * w / count, y, 0.4 * h) for k in range(count)]
        m.add(BASE, box((0.1 * w, 0.4 * w), (y - 0.002, y + 0.01), (0.34 * h, 0.5 * h)))
    for k, at in enumerate(spots):
        if m.chance(0.9):
            button(m, f"button_{k}", at, normal, m.pick(0.012, 0.015))
        else:
            m.add(BASE, rod(at, np.asarray(at) + 0.004 * np.asarray(normal), 0.006, 8))


def hull(stations: Sequence[tuple[float, float, float, float]], n: int) -> Trimesh:
    """A body that lies along y; stations: y, half its width, half its height, the height of its middle."""
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return loft(np.stack([np.c_[a * np.cos(t), np.full(n, y), z + b * np.sin(t)] for y, a, b, z in stations]))


def hand_mixer(m: Model) -> None:
    """Make a hand mixer: closed or open handle, on its beaters or on a stand with a bowl; beaters, hooks or one whisk."""
    stand, n = m.chance(0.3), m.pick(10, 14, 20)
    part = "head" if stand else BASE
    long, z = m.number(0.16, 0.21), (0.25 if stand else m.number(0.19, 0.23))
    a, b, front, back = m.number(0.034, 0.044), m.number(0.03, 0.04), -0.45 * long, 0.55 * long
    nose = m.pick(0.5, 0.8)
    ends = (front - 0.02, nose * a, nose * b, z), (front, 0.9 * a, 0.9 * b, z)
    tail = (back, 0.95 * a, b, z), (back + 0.012, 0.7 * a, 0.7 * b, z)
    m.add(part, hull([*ends, (front + 0.05, a, b, z), *tail], n))
    top = z + b + m.number(0.04, 0.055)
    style = m.pick("closed", "closed", "open", "post")
    start = front + (0.03 if style != "post" else 0.22 * long)
    _mixer_handle(m, part, style, (start, back - 0.01), z + 0.8 * b, top)
    _mixer_controls(m, part, start, top)
    y, low = front + 0.035, z - b
    kind = m.pick("beaters", "beaters", "hooks", "whisk")
    for k, x in enumerate((0.0,) if kind == "whisk" else (-0.022, 0.022)):
        _beater(m, f"beater_{k}", kind, vec(x, y, low), 0.045 if stand else 0.002, part)
    if m.chance(0.6):
        m.add(part, *(box((s * 0.96 * a, s * a), (0, 0.05), (z + c, z + c + 0.003)) for s in (-1, 1) for c in (-0.01, 0, 0.01)))
    if m.chance(0.5):
        m.add(part, rod((0, y, low - 0.012), (0, y, low + 0.02), 0.034, n))
    if stand:
        _mixer_stand(m, y, back, z, b, n)
    elif m.chance(0.5):
        path = [(0, back, z), (0, back + 0.06, z - 0.02), (0, back + 0.1, 0.01), (0.03, back + 0.16, 0.006)]
        m.add(BASE, bar(path, 0.004, 6))


def _mixer_handle(m: Model, part: str, style: str, y: Span, low: float, top: float) -> None:
    r = m.number(0.012, 0.016)
    path = [(y[0], top), (y[1] - 0.02, top), (y[1], low - 0.01)]
    if style == "open":
        path = [(y[0] - 0.01, low - 0.01), (y[0], top), (y[1], top - 0.006)]
    elif style == "closed":
        path = [(y[0] - 0.01, low - 0.01), *path]
    if m.chance(0.5):
        m.add(part, bar([(0, *p) for p in path], r, 8))
        return
    for a, b in pairwise(np.array(path)):
        more = np.array([0, r] if abs(b[1] - a[1]) < 0.02 else [r, 0])
        m.add(part, prism([a - more, b - more, b + more, a + more], "x", (-1.1 * r, 1.1 * r)))


def _mixer_controls(m: Model, part: str, front: float, top: float) -> None:
    z, eject = top + 0.011, m.pick("button", "lever", "none")
    if eject == "button":
        button(m, "eject", (0, front + 0.004, z), (0, 0, 1), 0.016, part)
    elif eject == "lever":
        m.add("eject", box((-0.01, 0.01), (front - 0.028, front + 0.008), (z + 0.001, z + 0.008)))
        m.add(part, rod((-0.012, front + 0.006, z + 0.002), (0.012, front + 0.006, z + 0.002), 0.005, 10))
        m.hinge("eject", (0, front + 0.006, z + 0.003), (-1, 0, 0), m.pick(20, 35), part)
    speed, y = m.pick("slider", "dial", "trigger"), front + 0.035
    if speed == "slider":
        m.add(part, box((-0.007, 0.007), (y - 0.008, y + 0.04), (z - 0.004, z + 0.005)))
        m.add("speed", box((-0.005, 0.005), (y - 0.006, y + 0.006), (z + 0.004, z + 0.013)))
        m.slide("speed", (0, 1, 0), 0.028, part)
    elif speed == "dial":
        dial(m, "speed", (0, y + 0.01, z), (0, 0, 1), 0.012, part)
    else:
        m.add("trigger", box((-0.007, 0.007), (y, y + 0.03), (top - 0.026, top - 0.008)))
        m.slide("trigger", (0, 0, 1), 0.008, part)


def _beater(m: Model, part: str, kind: str, at: np.ndarray, tip: float, parent: str) -> None:
    long, r = at[2] - tip, {"beaters": 0.019, "hooks": 0.014, "whisk": 0.028}[kind]
    m.add(part, rod(at + vec(0, 0, 0.01), at - vec(0, 0, 0.5 * long), 0.0035, 8))
    if kind == "hooks":
        t = np.linspace(0, m.pick(7.0, 10.0), 24)
        path = np.c_[r * np.cos(t), r * np.sin(t), np.linspace(-0.5 * long, 0.005 - long, 24)]
        m.add(part, bar([at - vec(0, 0, 0.48 * long), *(at + path)], 0.003, 5))
    else:
        outline = [(0.0, 0.4), (0.75, 0.55), (1.0, 0.75), (0.7, 0.95), (0.0, 0.985)]
        if kind == "whisk":
            outline = [(0.1, 0.3), (0.5, 0.5), (1.0, 0.75), (0.8, 0.93), (0.0, 0.985)]
        for k in range(4 if kind == "beaters" else 8):
            a = 2 * np.pi * k / (4 if kind == "beaters" else 8)
            m.add(part, bar([at + vec(r * s * np.cos(a), r * s * np.sin(a), -c * long) for s, c in outline], 0.0016, 5))
    if m.chance(0.5):
        m.add(part, ring(at - vec(0, 0, m.number(0.08, 0.12) * long), (0, 0, 1), 0.005, 0.0025, 12))
    m.spin(part, at, (0, 0, 1), parent)


def _mixer_stand(m: Model, y: float, back: float, z: float, b: float, n: int) -> None:
    low, rear = z - b, back + 0.03
    m.add(BASE, prism(rounded((-0.08, 0.08), (y - 0.1, rear + 0.02), 0.03), "z", (0, 0.02)))
    m.add(BASE, prism(rounded((-0.03, 0.03), (back - 0.05, rear), 0.012), "z", (0.015, low - 0.014)))
    m.add("head", box((-0.032, 0.032), (back - 0.09, rear), (low - 0.012, low + 0.008)))
    m.add(BASE, *(box((s * 0.033, s * 0.04), (rear - 0.03, rear), (low - 0.05, low)) for s in (-1, 1)))
    m.hinge("head", (0, rear - 0.012, low - 0.01), (-1, 0, 0), m.pick(40, 55))
    r = min(0.085, back - 0.055 - y)
    bowl = [(0.5 * r, 0.022), (0.85 * r, 0.05), (r, 0.12), (r - 0.004, 0.12), (0.82 * r, 0.054), (0.46 * r, 0.027)]
    m.add(BASE, lathe(bowl, n, (0, y, 0)))
