"""Hose reels in frames, on carts and on the wall."""

from __future__ import annotations

import numpy as np
import trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, ring, rod, vec
from training.kinds.wheels import beam, upright, wheel_maker

X = vec(1, 0, 0)


def hose_reel(m: Model) -> None:
    """A reel in a floor frame, on a cart, on a wall bracket or on an arm that swings; a crank on its flank."""
    style = m.pick("frame", "cart", "wall", "swing", "swing")
    r, half, s = m.number(0.13, 0.28), m.number(0.06, 0.16), m.pick(-1, 1)
    center = vec(0, 0, r + m.number(0.06, 0.15))
    parent = BASE
    if style == "swing":
        center, parent = vec(0, -r - 0.14, r + 0.1), "arm"
        _swinging(m, center, r, half)
    elif style == "wall":
        center = vec(0, -r - 0.05, r + 0.1)
        _bracket(m, center, r, half)
    else:
        _stand(m, center, r, half, style == "cart")
    hollow = m.chance(0.5)
    n, pipe = m.pick(12, 16, 24, 32), m.number(0.007, 0.012)
    drum, full = m.number(0.3, 0.5) * r, m.number(0.7, 0.93) * r
    m.add("reel", rod(center - half * X, center + half * X, drum, n))
    m.add("reel", rod(center - (half + 0.03) * X, center + (half + 0.03) * X, 0.014, 10))
    for e in (-1, 1):
        at = center + e * (half - 0.004) * X
        if hollow:
            m.add("reel", ring(at, X, 0.96 * r, 0.04 * r, n))
            turn = np.linspace(0, 2 * np.pi, m.pick(4, 5, 6), endpoint=False)
            m.add("reel", *(rod(at, at + 0.96 * r * vec(0, np.cos(a), np.sin(a)), 0.03 * r, 6) for a in turn))
        else:
            m.add("reel", rod(at, at + e * 0.008 * X, r, n))
    _hose(m, center, half - 0.006 - pipe, drum, full, pipe)
    _crank(m, "reel", center + s * (half + 0.028) * X, s, m.number(0.35, 0.75) * r)
    m.spin("reel", center, X, parent)


def _hose(m: Model, center: Point, half: float, drum: float, full: float, pipe: float) -> None:
    """What is wound up: nothing, one thick roll, or rings side by side."""
    style = m.pick("none", "roll", "rings", "rings")
    if style == "roll":
        roll = trimesh.creation.annulus(0.98 * drum, full, 2 * half, sections=24)
        m.add("reel", *upright([roll], X, center))
    elif style == "rings":
        count = max(2, int(2 * half / (2 * pipe)))
        radius = drum + pipe
        while radius < min(full, drum + 6 * pipe):
            m.add("reel", *(ring(center + x * X, X, radius, pipe, 16) for x in np.linspace(-half, half, count)))
            radius += 2 * pipe


def _crank(m: Model, part: str, at: Point, s: int, long: float) -> None:
    """An arm on the axle's end with a grip, which turns on its pin in some."""
    end = at + vec(s * 0.012, 0, -long)
    m.add(part, beam(at, end, 0.016, 0.008, (0, 1, 0)), rod(at - 0.01 * s * X, at + 0.012 * s * X, 0.016, 10))
    if m.chance(0.5):
        m.add(part, rod(end, end + s * 0.09 * X, m.number(0.006, 0.009), 8))
        if m.chance(0.5):
            m.add(part, ball(end + s * 0.09 * X, (0.014, 0.014, 0.014), 8))
        return
    m.add(part, rod(end, end + s * 0.088 * X, 0.005, 8))
    m.add("grip", rod(end + s * 0.006 * X, end + s * 0.084 * X, m.number(0.011, 0.015), m.pick(8, 12)))
    m.spin("grip", end, X, part)


def _stand(m: Model, center: Point, r: float, half: float, cart: bool) -> None:
    """Two flanks that hold the axle, on feet or with two wheels and a handle behind."""
    _, y, z = center
    out = half + 0.018
    for e in (-1, 1):
        for w in (-1, 1):
            m.add(BASE, rod((e * out, y, z), (e * out, y + w * 0.8 * r, 0.012), 0.011, 8))
        m.add(BASE, rod((e * out - 0.012, y, z), (e * out + 0.008, y, z), 0.022, 12))
    m.add(BASE, *(rod((-out, y + w * 0.8 * r, 0.012), (out, y + w * 0.8 * r, 0.012), 0.011, 8) for w in (-1, 1)))
    if not cart:
        return
    make, wheel = wheel_maker(m), m.number(0.07, 0.11)
    back, top = y + 0.8 * r, z + r + m.number(0.15, 0.4)
    for k, e in enumerate((-1, 1)):
        make(f"wheel_{k}", (e * (out + 0.045), back, wheel - 0.02), (e, 0, 0), wheel, 0.04)
        m.add(BASE, rod((e * out, back, 0.012), (e * out, back + 0.12, top), 0.011, 8))
    m.add(BASE, rod((-out - 0.06, back, wheel - 0.02), (out + 0.06, back, wheel - 0.02), 0.01, 8))
    m.add(BASE, *(box((e * out - 0.009, e * out + 0.009), (back - 0.015, back + 0.05), (0.0, wheel)) for e in (-1, 1)))
    m.add(BASE, rod((-out, back + 0.12, top), (out, back + 0.12, top), 0.013, 8))


def _bracket(m: Model, center: Point, r: float, half: float) -> None:
    """A plate on the wall with two arms that hold the axle."""
    _, y, z = center
    out = half + 0.02
    m.add(BASE, box((-out - 0.01, out + 0.01), (-0.008, 0), (z - 0.5 * r, z + 0.5 * r)))
    arms = [[(e * out, 0, z + w * 0.35 * r), (e * out, y, z)] for e in (-1, 1) for w in ((-1, 1) if m.chance(0.5) else (0,))]
    m.add(BASE, *(beam(a, b, 0.03, 0.01, (0, 0, 1)) for a, b in arms))
    m.add(BASE, *(rod((e * out - 0.012, y, z), (e * out + 0.008, y, z), 0.024, 12) for e in (-1, 1)))


def _swinging(m: Model, center: Point, r: float, half: float) -> None:
    """A wall plate with a hinge pin, and an arm or a fork on it that carries the reel."""
    _, y, z = center
    m.add(BASE, box((-0.05, 0.05), (0, 0.01), (z - 0.4 * r - 0.05, z + 0.4 * r + 0.05)))
    pin = vec(0, -0.03, z)
    for w in (-1, 1):
        a = z + w * (0.4 * r + 0.02)
        m.add(BASE, box((-0.02, 0.02), (-0.048, 0), (a - 0.01, a + 0.01)))
    m.add(m.pick(BASE, "arm"), rod((0, -0.03, z - 0.4 * r - 0.035), (0, -0.03, z + 0.4 * r + 0.035), 0.008, 10))
    m.add("arm", rod((0, -0.03, z - 0.4 * r + 0.01), (0, -0.03, z + 0.4 * r - 0.01), 0.016, 12))
    out = half + 0.02
    m.add("arm", box((-out - 0.005, out + 0.005), (-0.1, -0.08), (z - 0.12 * r, z + 0.12 * r)))
    m.add("arm", box((-0.012, 0.012), (-0.09, -0.03), (z - 0.1 * r, z + 0.1 * r)))
    m.add("arm", *(beam((e * out, -0.09, z), (e * out, y - 0.02, z), 0.035, 0.008, (0, 0, 1)) for e in (-1, 1)))
    m.hinge("arm", pin, (0, 0, 1), m.pick((-80, 80), (0, 90), (-60, 60)))
