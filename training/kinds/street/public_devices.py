"""Fuse boxes and server racks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import door, look
from training.kinds.kitchen_trims import button, feet, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import IN, OUT, glazed, handle, hang, middle
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, tube


def _breaker(m: Model, name: str, x: Span, y: float, z: Span, moves: bool, lying: int = 0) -> None:
    """A breaker with its switch at y; lying: 0 upright, or the side (1, -1) to which a lying switch points."""
    m.add(BASE, box(x, (y - 0.008, y + 0.01), z))
    part, a, b = (name if moves else BASE), middle(x), middle(z)
    if not moves and m.chance(0.5):
        m.add(BASE, box(shrunk(x, 0.003), (y - 0.01, y - 0.008), shrunk(z, 0.01)))
        return
    half = 0.3 * (x[1] - x[0] if lying == 0 else z[1] - z[0])
    tip = [
        (y - 0.004, b - 0.005),
        (y - 0.01, b - 0.005),
        (y - 0.022, b + 0.012),
        (y - 0.018, b + 0.016),
        (y - 0.004, b + 0.005),
    ]
    if lying:
        flat = [(a - lying * (q - b), p) for p, q in tip]
        m.add(part, prism(flat, "z", (b - half, b + half)))
    else:
        m.add(part, prism(tip, "x", (a - half, a + half)))
    if moves:
        m.hinge(part, (a, y - 0.006, b), (0, 0, -lying) if lying else (1, 0, 0), m.number(50, 75))


def _breakers(m: Model, x: Span, y: float, rows: Sequence[Span], columns: bool) -> None:
    """Rows of breakers that fill a span, or pairs of lying ones at both sides of a middle strip; some are blind."""
    share, count, k = m.number(0.4, 1.0), 0, 0
    if columns:
        c, wide = middle(x), 0.4 * (x[1] - x[0])
        m.add(BASE, box((c - 0.008, c + 0.008), (y - 0.006, y), (rows[0][0], rows[-1][1])))
        for z in rows:
            for s in (-1, 1):
                span = (c + s * 0.01, c + s * (0.01 + min(wide, 0.075)))
                _breaker(m, f"switch_{k}", (min(span), max(span)), y, z, m.chance(share) or k == 0, s)
                k += 1
        return
    for z in rows:
        at, tall = x[0], z[1] - z[0]
        m.add(BASE, box(x, (y - 0.002, y), (z[0] - 0.18 * tall, z[0] - 0.05 * tall)))
        while at < x[1] - 0.017:
            wide = m.pick(0.018, 0.018, 0.018, 0.036) if at < x[1] - 0.036 else 0.0178
            moves = count < 14 and (m.chance(share) or count == 0)
            _breaker(m, f"switch_{count}", (at, at + wide - 0.0004), y, z, moves)
            if wide > 0.02 and m.chance(0.5):
                button(m, f"test_{k}", (at + 0.028, y - 0.008, z[0] + 0.1 * tall), (0, -1, 0), 0.007)
            at, count, k = at + wide, count + moves, k + 1


def fuse_box(m: Model) -> None:
    """A box on the wall with rows or columns of breakers: one door, a flap for each row, or none; pipes, labels and blanks."""
    columns, how = m.chance(0.3), look(m, 0.3, ("slab", "pan", "rounded", "framed", "glass", "glass", "liner"))
    lines = m.pick(4, 6, 8) if columns else m.pick(1, 1, 2, 3)
    wide, pitch = (m.number(0.24, 0.3), 0.03) if columns else (m.number(0.16, 0.4), m.number(0.11, 0.15))
    rim, p = m.number(0.025, 0.04), max(how.depth[1], 0.0) + 0.028
    high, deep = lines * pitch + 2 * rim + (0.1 if columns else 0.0), p + m.number(0.04, 0.08)
    x, z, inner = (0.0, wide), (0.0, high), ((rim, wide - rim), (rim, high - rim))
    case = box(x, (0, deep), z) if m.chance(0.6) else prism(rounded(x, z, 0.02), "y", (0, deep))
    m.add(BASE, cut(case, box(inner[0], (-1, p), inner[1])))
    low = rim + (0.05 if columns else 0.0)
    tall = (0.0, 0.029) if columns else (0.5 * (pitch - 0.075), 0.5 * (pitch + 0.075))
    rows = [(low + k * pitch + tall[0], low + k * pitch + tall[1]) for k in range(lines)]
    _breakers(m, shrunk(inner[0], 0.012), p, rows, columns)
    style = "door" if columns else m.pick("door", "door", "flaps", "none")
    room = shrunk(x, 0.004), shrunk(z, 0.004)
    if style == "door":
        side = m.pick("left", "right") if high > 0.9 * wide else m.pick("left", "right", "top", "bottom")
        door(m, "door", *(room if how.sunk is None else inner), side, how, m.number(95, 170) if how.sunk is None else 95)
    elif style == "flaps":
        side = m.pick("top", "top", "bottom")
        for k in range(lines):
            span = (low + k * pitch + 0.002, low + (k + 1) * pitch - 0.002)
            if k < lines - 1:
                m.add(BASE, box(inner[0], (0, p), (span[1] - 0.0005, span[1] + 0.0035)))
            door(m, f"flap_{k}", inner[0], span, side, how, m.number(85, 95))
    if m.chance(0.6):
        for a in np.linspace(0.25, 0.75, m.pick(1, 2, 3)) * wide:
            r, end = m.number(0.008, 0.014), m.pick(-0.12, high + 0.15)
            m.add(BASE, rod((a, deep - 0.025, min(max(end, 0.01), high - 0.01)), (a, deep - 0.025, end), r, m.sections()))
            face = 0.0 if end < 0 else high
            m.add(BASE, rod((a, deep - 0.025, face - 0.008), (a, deep - 0.025, face + 0.008), 1.5 * r, 6))
    if m.chance(0.4):
        m.add(BASE, box((-0.06, wide + 0.06), (deep, deep + 0.015), (-0.06, high + 0.06)))


def _grille(m: Model, part: str, x: Span, y: Span, z: Span, bars: int, lying: bool) -> None:
    """A frame filled with slats that lie or stand."""
    w = 0.1 * min(x[1] - x[0], z[1] - z[0])
    m.add(part, prism(rectangle(x, z, w), "y", y))
    inner, at = (shrunk(x, w), shrunk(z, w)), (middle(y) - 0.003, middle(y) + 0.003)
    span = inner[1] if lying else inner[0]
    for c in np.linspace(*span, bars + 2)[1:-1]:
        t = 0.3 * (span[1] - span[0]) / bars
        m.add(part, box(inner[0], at, (c - t, c + t)) if lying else box((c - t, c + t), at, inner[1]))


def _rack_doors(m: Model, name: str, x: Span, y: Span, z: Span, way: int) -> None:
    """One door or two at the front or the back of a rack: glass, slats or plain, with handles."""
    style, two, gap = m.pick("glass", "grille", "grille", "plain"), m.chance(0.35), max(m.gap(0.5), 0.0)
    c, bars, lying = middle(x), m.pick(8, 14, 20), m.chance(0.5)
    leaves = {"left": (x[0], c - gap / 2), "right": (c + gap / 2, x[1])} if two else {m.pick("left", "right"): x}
    for side, span in leaves.items():
        part = f"{name}_{side}" if two else name
        if style == "glass":
            glazed(m, part, span, y, z, 0.12 * (span[1] - span[0]))
        elif style == "grille":
            _grille(m, part, span, y, z, bars, lying)
        else:
            m.add(part, box(span, y, z))
            trims(m, part, span, y[0], z)
        a = span[1] - 0.03 if side == "left" else span[0] + 0.03
        if m.chance(0.8):
            handle(m, part, (a, middle(z)), y, -1 if side == "left" else 1, "front" if way == OUT else "back", 0.08)
        hang(m, part, span, y, z, side, way, m.number(100, 165))


def _rack_unit(m: Model, part: str, x: Span, y: Span, z: Span, handles: str) -> None:
    """A unit of a rack: a front with ears and its box; drives, vents, lamps or ports on the front."""
    z = (z[0] + 0.0012, z[1] - 0.0012)
    m.add(part, box((x[0] - 0.015, x[1] + 0.015), (y[0], y[0] + 0.003), z))
    if part != BASE or m.chance(0.4):
        m.add(part, box(shrunk(x, 0.008), (y[0] + 0.003, y[1]), (z[0] + 0.001, z[1] - 0.001)))
    tall, what = z[1] - z[0], m.pick("drives", "vents", "ports", "plain")
    span, out = (x[0] + 0.03, x[1] - 0.03), (y[0] - 0.004, y[0])
    count = {"drives": 6, "vents": 10, "ports": 12, "plain": 0}[what]
    for k in range(count):
        a, b = (span[0] + (k + c) * (span[1] - span[0]) / count for c in (0.1, 0.85))
        m.add(part, box((a, b), out, shrunk(z, 0.3 * tall if what == "ports" else 0.12 * tall)))
    if what == "plain" and m.chance(0.6):
        m.add(part, rod((x[0] + 0.04, y[0] - 0.003, middle(z)), (x[0] + 0.04, y[0], middle(z)), 0.006, 8))
    for a in (x[0] - 0.006, x[1] + 0.006) if handles == "ears" else ():
        m.add(part, tube([(a, y[0], z[0] + 0.2 * tall), (a, y[0] - 0.025, z[0] + 0.2 * tall),
                          (a, y[0] - 0.025, z[1] - 0.2 * tall), (a, y[0], z[1] - 0.2 * tall)], 0.003, 6))  # fmt: skip


def _rack_frame(m: Model, x: Span, y: Span, z: Span, rail: Span) -> None:
    """Posts, floor and roof of a rack with its mounting rails; in some with side walls, or as one hollow body."""
    style, t = m.pick("posts", "posts", "walls", "shell"), 0.03
    if style == "shell":
        m.add(BASE, cut(box(x, y, z), box(shrunk(x, 0.02), (y[0] - 1, y[1] + 1), shrunk(z, 0.03))))
    else:
        m.add(BASE, *(box(x, y, c) for c in ((z[0], z[0] + t), (z[1] - t, z[1]))))
        m.add(
            BASE,
            *(
                box(a, b, shrunk(z, t))
                for a in ((x[0], x[0] + t), (x[1] - t, x[1]))
                for b in ((y[0], y[0] + t), (y[1] - t, y[1]))
            ),
        )
    if style == "walls":
        m.add(BASE, *(box(a, shrunk(y, t), shrunk(z, t)) for a in ((x[0] + 0.005, x[0] + 0.01), (x[1] - 0.01, x[1] - 0.005))))
    for b in (y[0] + 0.055, y[1] - 0.12):
        m.add(BASE, *(box((a, c), (b, b + 0.03), shrunk(z, t)) for a, c in ((x[0] + 0.018, rail[0]), (rail[1], x[1] - 0.018))))
    if m.chance(0.4):
        m.add(
            BASE,
            *(rod((c, middle(y), z[1]), (c, middle(y), z[1] + 0.02), 0.06, 16) for c in (middle(x) - 0.1, middle(x) + 0.1)),
        )


def server_rack(m: Model) -> None:
    """A rack with units that slide out between blank panels: open, or with single or double doors in front and behind."""
    wide, deep, step = m.number(0.56, 0.7), m.number(0.6, 1.1), 0.0445
    count, low = m.pick(9, 14, 22, 40), m.pick(0.0, 0.05, 0.08)
    z = (low, low + count * step + 0.07)
    x, rail = (-wide / 2, wide / 2), (-0.226, 0.226)
    _rack_frame(m, x, (0, deep), z, rail)
    if low:
        feet(m, x, (0, deep), low)
    at, k, handles = 0, 0, m.pick("ears", "ears", "none")
    while at < count:
        units = min(m.pick(1, 1, 2, 2, 3, 4) * (2 if count > 30 else 1), count - at)
        span = (low + 0.035 + at * step, low + 0.035 + (at + units) * step)
        kind = m.pick("slides", "slides", "blank", "empty") if k else "slides"
        if kind != "empty":
            part = f"unit_{k}" if kind == "slides" and k < 9 else BASE
            _rack_unit(
                m, part, rail, (0.05, m.number(0.55, 0.9) * deep), span, handles if part != BASE else m.pick("none", handles)
            )
            if part != BASE:
                m.slide(part, (0, -1, 0), m.number(0.4, 0.65) * deep)
        at, k = at + units, k + 1
    doors, gap = m.pick("both", "front", "back", "none"), max(m.gap(0.4), 0.0)
    if doors in ("both", "front"):
        _rack_doors(m, "door_front", x, (-0.03 - gap, -gap), z, OUT)
    if doors in ("both", "back"):
        _rack_doors(m, "door_back", x, (deep + gap, deep + 0.025 + gap), z, IN)
