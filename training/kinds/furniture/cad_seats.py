"""Folding seats as several artists model them: of tube, of slats, as a stool, on a wall, with a writing tablet."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from trimesh import Trimesh

from training.kinds.cad_style import bar, bevelled, bolt, convention, pillow, rounds, sheet, slab
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, arch, ball, box, prism, rod, turned, vec

Slope = Callable[[float], float]  # from a height to where the frame is along y


def _limb(style: str, a: Point, b: Point, n: int, thick: float) -> Trimesh:
    """A leg or a rail between two points: a tube, a flat bar or a strip."""
    if style == "sheet":
        p, q = np.asarray(a, float), np.asarray(b, float)
        along = (q - p) / np.linalg.norm(q - p)
        side = np.cross(along, (1, 0, 0) if abs(along[0]) < 0.5 else (0, 1, 0)) * thick
        return sheet((p - side, q - side, q + side, p + side))
    if style in ("prop", "hollow", "antique"):
        return bar(a, b, 1.6 * thick, 2.4 * thick)
    return rod(a, b, thick, n)


def _board(style: str, x: Span, y: Span, z: Span, slats: int) -> list[Trimesh]:
    """A seat: one board, or slats on two battens."""
    if not slats:
        return [slab(style, x, y, z, "-z")]
    edges = np.linspace(y[0], y[1], slats + 1)
    gap, low = 0.12 * (edges[1] - edges[0]), z[0]
    boards = [slab(style, x, (a + gap, b - gap), z, "-z") for a, b in pairwise(edges)]
    battens = [box((s * 0.8 * x[1], s * 0.65 * x[1]), y, (low - 0.014, low + 0.001)) for s in (-1, 1)]
    return boards + battens


def _chair(m: Model, style: str, n: int) -> None:
    """Front legs and back in one frame, rear legs and seat hung on it; a tablet or arms in some."""
    w, high, seat = m.number(0.19, 0.24), m.number(0.74, 0.9), m.number(0.42, 0.46)
    thick = m.number(0.009, 0.013)
    front, top = m.number(-0.24, -0.2), m.number(0.16, 0.24)

    def on_frame(z: float) -> float:
        return front + (top - front) * z / high

    m.add(BASE, *(_limb(style, (s * w, front, 0), (s * w, top, high), n, thick) for s in (-1, 1)))
    m.add(BASE, _limb(style, (-w, on_frame(0.17), 0.17), (w, on_frame(0.17), 0.17), n, 0.8 * thick))
    _back(m, style, w, on_frame, seat, high, thick, n)
    pivot = vec(0, on_frame(seat), seat)
    inner, slats = w - 2.4 * thick, m.pick(0, 0, 5, 7)
    wide = m.number(0.17, 0.2)
    m.add("seat", *_board(style, (-inner, inner), (pivot[1] - wide - 0.02, pivot[1] + wide), (seat, seat + 0.018), slats))
    m.add(
        m.pick("seat", BASE),
        *(
            rod((s * (inner - 0.02), pivot[1], seat + 0.006), (s * (w + thick), pivot[1], seat + 0.006), 0.005, 8)
            for s in (-1, 1)
        ),
    )
    m.hinge("seat", pivot + vec(0, 0, 0.006), (1, 0, 0), m.number(55, 65))
    hub = seat - m.number(0.08, 0.12) if m.chance(0.5) else seat - 0.05
    joint, foot = vec(0, on_frame(hub), hub), m.number(0.2, 0.26)
    rear = w - 2.2 * thick if style != "sheet" else 0.93 * w
    m.add("rear_legs", *(_limb(style, (s * rear, joint[1], joint[2]), (s * rear, foot, 0), n, 0.9 * thick) for s in (-1, 1)))
    z = 0.12
    y = joint[1] + (foot - joint[1]) * (1 - z / hub)
    m.add("rear_legs", _limb(style, (-rear, y, z), (rear, y, z), n, 0.7 * thick))
    m.add(
        m.pick("rear_legs", BASE),
        *(rod((s * (rear - thick), joint[1], hub), (s * (w + 1.1 * thick), joint[1], hub), 0.005, 8) for s in (-1, 1)),
    )
    if style == "assembly":
        m.add(BASE, *(b for s in (-1, 1) for b in bolt((s * (w + thick), joint[1], hub), (s, 0, 0), 0.006)))
    m.hinge("rear_legs", joint, (-1, 0, 0), m.number(35, 45))
    if m.chance(0.35):
        _tablet(m, style, w, on_frame, seat, thick, n)


def _back(m: Model, style: str, w: float, on_frame: Slope, seat: float, high: float, thick: float, n: int) -> None:
    """Slats, a panel, spindles or cloth between the stiles."""
    lean = -np.rad2deg(np.arctan2(on_frame(1.0) - on_frame(0.0), 1.0))
    form = m.pick("panel", "slats", "upright", "panel")

    def leaned(low: float, top: float, x: float = w, deep: float = 0.006) -> Trimesh:
        mid = vec(0, on_frame((low + top) / 2), (low + top) / 2)
        flat = (-x, x), (mid[1] - deep, mid[1] + deep), (low, top)
        board = (
            sheet([(a, mid[1], b) for a, b in ((-x, low), (x, low), (x, top), (-x, top))])
            if style == "sheet"
            else bevelled(*flat, 0.003)
        )
        return turned(board, (1, 0, 0), lean, mid)

    top, low = high - m.number(0.0, 0.02), high - m.number(0.16, 0.24)
    if form == "panel":
        m.add(BASE, leaned(low, top))
    elif form == "slats":
        m.add(BASE, *(leaned(z, z + 0.035) for z in np.linspace(seat + 0.13, top - 0.035, m.pick(3, 4, 5))))
    else:
        m.add(BASE, leaned(top - 0.06, top), leaned(seat + 0.1, seat + 0.13))
        for x in np.linspace(-0.8, 0.8, m.pick(3, 5, 7)) * w:
            m.add(
                BASE,
                _limb(style, (x, on_frame(seat + 0.12), seat + 0.12), (x, on_frame(top - 0.03), top - 0.03), n, 0.5 * thick),
            )
    if style == "antique":
        crest = prism(arch((-w, w), (top - 0.03, top + 0.05), 0.05), "y", (on_frame(top) - 0.01, on_frame(top) + 0.01))
        m.add(BASE, crest, *(ball((s * w, on_frame(high), high + 0.01), (0.016, 0.016, 0.02), 10) for s in (-1, 1)))


def _tablet(m: Model, style: str, w: float, on_frame: Slope, seat: float, thick: float, n: int) -> None:
    """A writing board on an arm at the right that turns up and aside."""
    z, x = seat + 0.22, w + 2 * thick
    y = on_frame(z)
    m.add(BASE, rod((w - 0.001, y, z), (x + 0.03, y, z), 0.008, n), rod((x + 0.022, y, z), (x + 0.022, y - 0.3, z), 0.008, n))
    board = pillow((x + 0.02 - 0.24, x + 0.022), (y - 0.42, y - 0.1), (z + 0.008, z + 0.024), 0.03)
    m.add(
        "tablet",
        board
        if style in ("product", "hollow", "assembly")
        else slab(style, (x - 0.22, x + 0.022), (y - 0.42, y - 0.1), (z + 0.008, z + 0.022)),
    )
    m.hinge("tablet", (x + 0.022, y - 0.2, z + 0.009), (0, 1, 0), m.pick(90, 100))


def _stool(m: Model, style: str, n: int) -> None:
    """Two crossed frames with a pin between them; a top hung on one of them."""
    w, d, high, thick = m.number(0.15, 0.2), m.number(0.14, 0.2), m.number(0.38, 0.5), m.number(0.008, 0.012)
    inner = w - 2.6 * thick
    for part, x, s in ((BASE, w, 1), ("inner_legs", inner, -1)):
        m.add(part, *(_limb(style, (k * x, -s * d, 0), (k * x, s * d, high), n, thick) for k in (-1, 1)))
        ends = ((-s * 0.75 * d, 0.125 * high), (s * d, high - 0.5 * thick))
        m.add(part, *(_limb(style, (-x, y, z), (x, y, z), n, 0.8 * thick) for y, z in ends))
    m.add(
        m.pick(BASE, "inner_legs"),
        *(rod((k * (inner - thick), 0, high / 2), (k * (w + 1.2 * thick), 0, high / 2), 0.006, 8) for k in (-1, 1)),
    )
    m.hinge("inner_legs", (0, 0, high / 2), (1, 0, 0), 2 * np.rad2deg(np.arctan(d / (high / 2))) * 0.45)
    z = high + 0.7 * thick if style != "sheet" else high
    m.add("top", *_board(style, (-w, w), (-d - 0.02, d + 0.015), (z, z + 0.016), 0))
    m.hinge("top", (0, d, z), (-1, 0, 0), 85)


def _wall_seat(m: Model, style: str, n: int) -> None:
    """A seat that folds down from a wall plate, with a leg or brackets; a back that stays."""
    w, deep, z = m.number(0.17, 0.23), m.number(0.32, 0.4), 0.0
    m.add(BASE, slab(style, (-w, w), (0, 0.015), (z - 0.12, z + m.pick(0.05, 0.45, 0.5)), "+y"))
    m.add(BASE, *(box((s * (w - 0.02), s * (w - 0.032)), (-0.03, 0.001), (z - 0.05, z + 0.02)) for s in (-1, 1)))
    inner, hole = w - 0.034, vec(0, -0.02, z)
    slats, open_now = m.pick(0, 0, 4, 6), m.chance(0.7)
    solids = _board(style, (-inner, inner), (-deep, -0.012), (z - 0.01, z + 0.012), slats)
    m.add(m.pick(BASE, "seat"), *(rod((s * (inner - 0.02), -0.02, z), (s * (w - 0.015), -0.02, z), 0.006, 10) for s in (-1, 1)))
    if style == "assembly":
        spots = [(s * 0.7 * w, h) for s in (-1, 1) for h in (z - 0.1, z - 0.06)]
        m.add(BASE, *(b for x, h in spots for b in bolt((x, 0, h), (0, -1, 0), 0.007)))
    up = 0 if open_now else 88
    m.add("seat", *(turned(s, (-1, 0, 0), up, hole) for s in solids))
    m.hinge("seat", hole, (-1, 0, 0) if open_now else (1, 0, 0), 88)
    if open_now and m.chance(0.6):
        y, tall = -0.8 * deep, 0.42
        x, floor = 0.7 * inner, z - 0.01 - (0.014 if slats else 0)
        m.add("leg", *(_limb(style, (s * x, y, floor), (s * x, y, floor - tall), n, 0.009) for s in (-1, 1)))
        m.add(
            "leg",
            _limb(style, (-x, y, floor - 0.8 * tall), (x, y, floor - 0.8 * tall), n, 0.007),
            rod((-x, y, floor - 0.006), (x, y, floor - 0.006), 0.006, 8),
        )
        m.hinge("leg", (0, y, floor - 0.006), (1, 0, 0), 85, "seat")


def folding_seat(m: Model) -> None:
    """A chair whose seat and rear legs fold to its frame, a crossed stool, or a seat hung on a wall."""
    style = convention(m)
    m.pick(_chair, _chair, _chair, _stool, _wall_seat)(m, style, rounds(m, style))
