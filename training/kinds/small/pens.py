"""Ball pens."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh

from training.kinds.kitchen_trims import lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rod, vec
from training.kinds.wheels import beam


def _barrel(m: Model, part: str, profile: list[tuple[float, float]], n: int) -> None:
    m.add(part, lathe(profile, n))


def _clip(m: Model, part: str, r: float, top: float, n: int) -> None:
    """A clip down the side, flat, bent or with a ball; held by a collar or a bridge."""
    style, long, y = m.pick("flat", "ball", "wire", "taper"), m.number(0.028, 0.045), -r - 0.0022
    end = top - long
    m.add(part, box((-0.0018, 0.0018), (y - 0.0006, -0.5 * r), (top - 0.002, top)))
    if style == "taper":
        m.add(part, prism([(-0.002, top), (0.002, top), (0.001, end), (-0.001, end)], "y", (y - 0.0006, y + 0.0004)))
    elif style == "wire":
        m.add(part, *(rod((s * 0.0014, y, end), (s * 0.0014, y, top - 0.001), 0.0005, 6) for s in (-1, 1)))
        m.add(part, rod((-0.0018, y, end), (0.0018, y, end), 0.0005, 6))
    else:
        m.add(part, box((-0.0016, 0.0016), (y - 0.0005, y + 0.0004), (end, top)))
    if style in ("ball", "flat"):
        m.add(part, ball((0, y + 0.0008, end + 0.0015), (0.0014, 0.0014, 0.0014), 8))
    if m.chance(0.4):
        m.add(part, rod((0, 0, top - 0.0025), (0, 0, top), 1.06 * r, n))


def _rings(m: Model, part: str, r: float, heights: tuple[float, ...], n: int) -> None:
    m.add(part, *(rod((0, 0, z), (0, 0, z + m.number(0.0008, 0.002)), 1.04 * r, n) for z in heights))


def _grip(m: Model, r: float, low: float, n: int) -> None:
    """What fingers hold: a sleeve, ribs or nothing."""
    style, long = m.pick("sleeve", "ribs", "none", "none"), 0.03
    if style == "sleeve":
        _barrel(
            m,
            BASE,
            [(r, low), (1.1 * r, low + 0.003), (1.05 * r, low + 0.5 * long), (1.1 * r, low + long), (r, low + long + 0.001)],
            n,
        )
    elif style == "ribs":
        _rings(m, BASE, 1.01 * r, tuple(low + long * k / 7 for k in range(8)), n)


def _tip(r: float, long: float) -> list[tuple[float, float]]:
    """The profile of a point that ends at z = 0 and widens to a radius."""
    return [
        (0.0003, 0.0),
        (0.0006, 0.0006),
        (0.0012, 0.0025),
        (0.0013, 0.0045),
        (0.35 * r, 0.0048),
        (0.8 * r, 0.7 * long),
        (r, long),
    ]


def _clicker(m: Model) -> None:
    r, long, n, cone = m.number(0.0042, 0.0062), m.number(0.118, 0.132), m.pick(6, 10, 16, 24), m.number(0.012, 0.025)
    shoulder = long - m.number(0.003, 0.012)
    _barrel(m, BASE, [*_tip(r, cone), (m.number(0.95, 1.1) * r, 0.5 * long), (r, shoulder), (0.65 * r, long)], n)
    out, thick, h = m.number(0.007, 0.013), m.number(0.4, 0.58) * r, m.pick(0.004, 0.005)
    head = m.pick("flat", "round", "broad")
    m.add("clicker", rod((0, 0, long - 0.004), (0, 0, long + out), thick, n))
    if head == "round":
        m.add("clicker", ball((0, 0, long + out), (thick, thick, 0.6 * thick), max(n, 8)))
    elif head == "broad":
        m.add("clicker", rod((0, 0, long + out), (0, 0, long + out + 0.002), 1.3 * thick, n))
    m.slide("clicker", (0, 0, -1), h)
    _grip(m, r, cone + 0.003, n)
    if m.chance(0.8):
        _clip(m, BASE, r, shoulder - 0.002, n)
    _rings(m, BASE, 1.03 * r, m.pick((), (0.55 * long,), (cone, 0.55 * long)), n)


def _colours(m: Model) -> None:
    """A fat pen with slides round its rear, one for each colour."""
    r, long, n, count = m.number(0.006, 0.0075), m.number(0.125, 0.14), m.pick(12, 16, 24), m.pick(3, 4, 4, 6)
    _barrel(m, BASE, [*_tip(r, 0.028), (r, long), (0.8 * r, long + 0.003)], n)
    begin, travel = long - 0.022, m.number(0.01, 0.016)
    clip = m.chance(0.5)
    for k in range(count):
        t = 2 * np.pi * (k + (0.5 if clip else 0.0)) / count - np.pi / 2
        c = vec(np.cos(t), np.sin(t), 0)
        side = (-c[1], c[0], 0)
        m.add(
            f"slide_{k}", beam(0.85 * r * c + vec(0, 0, begin), 0.85 * r * c + vec(0, 0, begin + 0.012), 0.0028, 0.0055, side)
        )
        if m.chance(0.5):
            m.add(f"slide_{k}", ball(1.2 * r * c + vec(0, 0, begin + 0.003), (0.0015, 0.0015, 0.003), 8))
        m.slide(f"slide_{k}", (0, 0, -1), travel)
    if clip:
        _clip(m, BASE, 1.2 * r, long + 0.002, n)
    _grip(m, r, 0.03, n)
    _rings(m, BASE, r, m.pick((), (0.5 * long,)), n)


def _capped(m: Model) -> None:
    """A barrel with a cap drawn off over its point; six-sided, round, or with a nib."""
    r, long, n = m.number(0.0036, 0.006), m.number(0.12, 0.142), m.pick(6, 6, 12, 20)
    cap, gap, fat = m.number(0.045, 0.06), m.pick(0.0002, 0.0006, 0.0012), m.number(1.12, 1.3)
    flush = n != 6 and m.chance(0.5)
    neck, rc = (0.75 * r if flush else r), (r if flush else fat * r)
    _barrel(
        m,
        BASE,
        [*_tip(0.9 * neck, 0.014), (neck, 0.016), (neck, cap - 0.0001), (r, cap), (r, long), (0.7 * r, long + 0.001)],
        n,
    )
    if n == 6:
        m.add(BASE, rod((0, 0, long - 0.004), (0, 0, long + 0.003), 0.7 * r, 10))
    low, inner = -m.number(0.003, 0.008), 1.03 * neck
    profile = [(0.75 * rc, low), (rc, low + 0.003), (rc, cap - gap)]
    if m.chance(0.7):
        profile += [(inner, cap - gap), (inner, 0.0), (0.2 * inner, -0.0008)]
    _barrel(m, "cap", profile, max(n, 10))
    begin = len(m.pieces)
    _clip(m, "cap", rc, cap - gap - 0.001, max(n, 10))
    mid = 0.5 * (low + cap)
    for _, piece in m.pieces[begin:]:
        piece.vertices = piece.vertices * (1, 1, -1) + (0, 0, 2 * mid)
        piece.invert()
    m.slide("cap", (0, 0, -1), m.number(0.6, 1.0) * cap)
    _rings(m, BASE, r, m.pick((), (long - 0.012,)), max(n, 10))


def _twisting(m: Model) -> None:
    """Two halves on one line; the rear one turns."""
    r, long, n, cone = m.number(0.0045, 0.0065), m.number(0.125, 0.142), m.pick(12, 16, 24), m.number(0.02, 0.03)
    split, gap = m.number(0.48, 0.6) * long, m.pick(0.0001, 0.0004, 0.0008)
    _barrel(m, BASE, [*_tip(0.92 * r, cone), (r, split)], n)
    m.add(BASE, rod((0, 0, split - 0.002), (0, 0, split + 0.006), 0.5 * r, n))
    _barrel(m, "upper", [(r, split + gap), (1.05 * r, 0.8 * long), (0.9 * r, long - 0.003), (0.4 * r, long)], n)
    _rings(m, m.pick(BASE, "upper"), r, (split - 0.002,) if m.chance(0.3) else (), n)
    _rings(m, "upper", 1.02 * r, m.pick((split + gap,), (split + gap, split + 0.004), ()), n)
    _clip(m, "upper", 1.05 * r, long - 0.006, n)
    if m.chance(0.4):
        m.add("upper", ball((0, 0, long), (0.4 * r, 0.4 * r, 0.3 * r), 10))
    m.hinge("upper", (0, 0, split), (0, 0, 1), m.pick(90, 120, 180))


def _lay(m: Model, r: float) -> None:
    """The same pen lying with its point to the left."""
    turn = trimesh.transformations.rotation_matrix(np.pi / 2, (0, 1, 0))
    turn[:3, 3] = (0, 0, r)
    for _, piece in m.pieces:
        piece.apply_transform(turn)
    for part, j in list(m.joints.items()):
        m.joints[part] = replace(j, origin=turn[:3, :3] @ j.origin + turn[:3, 3], axis=turn[:3, :3] @ j.axis)


def ball_pen(m: Model) -> None:
    """A pen with a button that clicks, slides for several colours, a cap, or halves that twist; upright or lying."""
    m.pick(_clicker, _clicker, _capped, _capped, _twisting, _colours)(m)
    if m.chance(0.6):
        _lay(m, 0.007)
