"""Cases and chests for sockets and tools."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.bench_style import STYLES, bar, body, feet, plane, without
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, rounded, tube, vec


def socket_toolbox(m: Model) -> None:
    """A flat case with sockets, a chest with a lid and drawers, or a box with trays that swing out."""
    style = m.pick(*STYLES)
    m.pick(_flat_case, _flat_case, _chest, _cantilever)(m, style)


def _hollow(style: str, x: Span, y: Span, z: Span, wall: float) -> Trimesh:
    """A box without a top: thick, or a sheet."""
    if style == "sheet":
        return without(box(x, y, z), (0, 0, 1))
    inner = ((x[0] + wall, x[1] - wall), (y[0] + wall, y[1] - wall))
    room = (z[0] + wall, z[1] + 1)
    if style == "soft":
        return cut(prism(rounded(x, y, 0.014), "z", z), prism(rounded(*inner, 0.014 - wall), "z", room))
    return cut(box(x, y, z), box(*inner, room))


def _flat_case(m: Model, style: str) -> None:
    """A shallow base with places for sockets, a lid hinged behind, latches and a handle in front."""
    w, d, h = m.number(0.25, 0.42), m.number(0.18, 0.28), m.number(0.028, 0.045)
    x, y, lid_h = (-w / 2, w / 2), (0.0, d), m.number(0.4, 1.0) * h
    slack = max(m.gap(h), 0.0)
    z = (h + slack, h + slack + lid_h)
    if style in ("soft", "flush"):
        m.add(BASE, prism(rounded(x, y, 0.02), "z", (0, h)))
        lid = cut(
            prism(rounded(x, y, 0.02), "z", z),
            prism(rounded((x[0] + 0.006, x[1] - 0.006), (0.006, d - 0.006), 0.016), "z", (z[0] - 1, z[1] - 0.005)),
        )
    elif style == "game":
        m.add(BASE, body(style, x, y, (0, h)))
        lid = body(style, x, y, z)
    else:
        m.add(
            BASE, _hollow(style, x, y, (0, h), 0.004), box((x[0] + 0.002, x[1] - 0.002), (0.002, d - 0.002), (0.002, 0.5 * h))
        )
        lid = (
            without(box(x, y, z), (0, 0, -1))
            if style == "sheet"
            else cut(box(x, y, z), box((x[0] + 0.004, x[1] - 0.004), (0.004, d - 0.004), (0, z[1] - 0.004)))
        )
    m.add("lid", lid)
    if style in ("old", "cad", "soft"):
        m.add("lid", prism(rectangle((0.7 * x[0], 0.7 * x[1]), (0.25 * d, 0.75 * d)), "z", (z[1] - 0.001, z[1] + 0.003)))
    m.hinge("lid", (0, d, h + slack / 2), (-1, 0, 0), m.pick(95, 110, 170))
    m.add(BASE, *(rod((a - 0.02, d + 0.001, h), (a + 0.02, d + 0.001, h), 0.004, 8) for a in (0.6 * x[0], 0.6 * x[1])))
    if style != "game":
        _sockets(m, x, d, h, 0.5 * h if style in ("cad", "old", "sheet") else h, lid_h)
    _latches(m, style, w, h, z)
    if m.chance(0.7):
        path = [(-0.05, 0.002, 0.5 * h), (-0.05, -0.03, 0.5 * h), (0.05, -0.03, 0.5 * h), (0.05, 0.002, 0.5 * h)]
        swings = m.chance(0.5)
        m.add("handle" if swings else BASE, tube(path, 0.005, 8) if style != "cad" else rod(path[1], path[2], 0.007, 10))
        if style == "cad":
            m.add("handle" if swings else BASE, *(bar(a, b, 0.01, 0.006, (0, 0, 1)) for a, b in (path[:2], path[2:])))
        if swings:
            m.hinge("handle", (0, -0.001, 0.5 * h), (1, 0, 0), (-60, 80))


def _sockets(m: Model, x: Span, d: float, h: float, floor: float, room: float) -> None:
    """Sockets in rows and a ratchet; they lie loose and count as part of the case."""
    top = floor + min(0.018, h - floor + 0.7 * room)
    for row in range(m.pick(1, 2)):
        count = m.pick(5, 7, 9)
        for k, a in enumerate(np.linspace(0.78 * x[0], 0.78 * x[1], count)):
            r = 0.005 + 0.007 * k / count * (1 if row == 0 else 0.7)
            m.add(BASE, rod((a, d * (0.8 - 0.25 * row), floor - 0.002), (a, d * (0.8 - 0.25 * row), top), r, 12))
    b, c = 0.2 * d, floor + 0.5 * (top - floor)
    m.add(
        BASE,
        rod((0.7 * x[0], b, c), (0.4 * x[1], b, c), 0.5 * (top - floor), 8),
        rod((0.4 * x[1] + 0.01, b, floor - 0.001), (0.4 * x[1] + 0.01, b, top), 0.016, 12),
    )


def _latches(m: Model, style: str, w: float, h: float, z: Span) -> None:
    """Latches in front that swing down or up, or none."""
    if m.chance(0.25):
        return
    up = m.chance(0.5)
    half = 0.5 * min(h, z[1] - z[0])
    pivot = h - 0.9 * half if not up else z[0] + 0.9 * half
    for k, a in enumerate((-0.33 * w, 0.33 * w)):
        span = (pivot - 0.003, z[0] + half) if not up else (h - half, pivot + 0.003)
        part = f"latch_{k}"
        m.add(part, body(style, (a - 0.014, a + 0.014), (-0.0055, -0.0005), span, (0, 1, 0)))
        m.add(BASE if not up else "lid", rod((a - 0.016, -0.0015, pivot), (a + 0.016, -0.0015, pivot), 0.003, 8))
        m.hinge(part, (a, -0.002, pivot), (1 if not up else -1, 0, 0), m.pick(60, 100), BASE if not up else "lid")


def _chest(m: Model, style: str) -> None:
    """A chest with a lid over a well with a tray, drawers below in one or two columns."""
    w, d, h = m.number(0.4, 0.62), m.number(0.2, 0.3), m.number(0.22, 0.34)
    x, low, wall = (-w / 2, w / 2), 0.012, 0.006
    rows, columns, well = m.pick(2, 3), m.pick(1, 1, 2), 0.07
    hollow = style in ("cad", "flush", "old", "sheet")
    shell = box(x, (0, d), (low, h))
    if hollow:
        shell = cut(shell, box((x[0] + wall, x[1] - wall), (wall, d - wall), (h - well, h + 1)))
    high = (h - well - 0.01 - low - wall) / rows
    wide = (w - 2 * wall) / columns
    gap = max(m.gap(high), 0.001)
    for i in range(rows):
        for k in range(columns):
            a, b = (
                (x[0] + wall + k * wide + gap, x[0] + wall + (k + 1) * wide - gap),
                (low + wall + i * high + gap, low + wall + (i + 1) * high - gap),
            )
            if hollow and style != "sheet":
                shell = cut(shell, box(a, (-1, d - 0.02), b))
            _drawer(
                m, style, f"drawer_{i}_{k}", (a[0] + 0.0005, a[1] - 0.0005), (b[0] + 0.0005, b[1] - 0.0005), d - 0.03, hollow
            )
    m.add(BASE, shell, *feet(style, (x[0] + 0.03, x[1] - 0.03), (0.03, d - 0.03), (0, low + 0.001), 0.012))
    if hollow and m.chance(0.6):
        _tray(m, x, d, h, wall, well)
    _chest_lid(m, style, w, d, h)


def _tray(m: Model, x: Span, d: float, h: float, wall: float, well: float) -> None:
    """A tray that is lifted out, on ledges."""
    w = x[1] - x[0]
    tray = (h - 0.04, h - 0.008)
    m.add(
        "tray",
        _hollow("cad", (x[0] + wall + 0.001, x[1] - wall - 0.001), (wall + 0.001, d - wall - 0.001), tray, 0.003),
        box((x[0] + 0.01, x[1] - 0.01), (d / 2 - 0.002, d / 2 + 0.002), (tray[0] + 0.002, tray[1] + 0.002)),
    )
    m.add(
        BASE,
        *(
            box(
                tuple(sorted((s * (w / 2 - wall + 0.001), s * (w / 2 - wall - 0.008)))),
                (wall, d - wall),
                (tray[0] - 0.006, tray[0]),
            )
            for s in (-1, 1)
        ),
    )
    m.slide("tray", (0, 0, 1), well * 0.9)


def _chest_lid(m: Model, style: str, w: float, d: float, h: float) -> None:
    """The lid with its latches and perhaps a bail on top."""
    x = (-w / 2, w / 2)
    z = (h + 0.001, h + m.number(0.02, 0.05))
    m.add("lid", body(style, (x[0] - 0.002, x[1] + 0.002), (-0.002, d), z))
    m.hinge("lid", (0, d, h), (-1, 0, 0), m.pick(85, 100))
    _latches(m, style, w, h, (z[0], z[1]))
    if m.chance(0.6):
        path = [
            vec(-0.07, d / 2, z[1] + 0.004),
            vec(-0.07, d / 2 - 0.035, z[1] + 0.006),
            vec(0.07, d / 2 - 0.035, z[1] + 0.006),
            vec(0.07, d / 2, z[1] + 0.004),
        ]
        m.add("handle", tube(path, 0.0045, 8))
        m.add(
            "lid",
            *(
                box((s * 0.07 - 0.009, s * 0.07 + 0.009), (d / 2 - 0.008, d / 2 + 0.008), (z[1] - 0.002, z[1] + 0.008))
                for s in (-1, 1)
            ),
        )
        m.hinge("handle", (0, d / 2, z[1] + 0.004), (-1, 0, 0), m.pick(90, 175), "lid")


def _drawer(m: Model, style: str, part: str, x: Span, z: Span, deep: float, inside: bool) -> None:
    if style == "sheet":
        m.add(part, plane((x[0], -0.001, z[0]), (x[1], -0.001, z[0]), (x[1], -0.001, z[1]), (x[0], -0.001, z[1])))
    else:
        m.add(part, body(style, x, (-0.006, 0.0), z, (0, 1, 0)))
    if inside and style != "sheet":
        m.add(part, _hollow("cad", (x[0] + 0.002, x[1] - 0.002), (-0.001, deep), (z[0] + 0.002, z[1] - 0.004), 0.002))
    c, b = (x[0] + x[1]) / 2, (z[0] + z[1]) / 2
    if style in ("old", "soft"):
        m.add(
            part, *(ball((a, -0.011, b), (0.008, 0.008, 0.008), 8) for a in ((c,) if x[1] - x[0] < 0.3 else (c - 0.1, c + 0.1)))
        )
    else:
        m.add(part, box((c - 0.3 * (x[1] - x[0]), c + 0.3 * (x[1] - x[0])), (-0.014, -0.001), (z[1] - 0.008, z[1] - 0.004)))
    m.slide(part, (0, -1, 0), 0.8 * deep)


def _cantilever(m: Model, style: str) -> None:
    """A tub with a lid in two halves or one tray per side on links; a bar to carry it."""
    w, d, h = m.number(0.36, 0.5), m.number(0.2, 0.24), m.number(0.12, 0.16)
    x = (-w / 2, w / 2)
    m.add(BASE, _hollow(style, x, (0, d), (0, h), 0.003))
    top, slack = m.number(0.05, 0.07), 0.002
    z = (h + slack, h + slack + top)
    for k, s in enumerate((-1, 1)):
        y = tuple(sorted((d / 2 + s * 0.001, d / 2 + s * (d / 2))))
        tray, link = f"tray_{k}", f"link_{k}"
        low, high = vec(0, d / 2 + s * 0.08, h - 0.04), vec(0, d / 2 + s * 0.03, z[0] + 0.03)
        m.add(
            link,
            *(bar(low + vec(e * (w / 2 + 0.003), 0, 0), high + vec(e * (w / 2 + 0.003), 0, 0), 0.003, 0.014) for e in (-1, 1)),
        )
        m.add(
            link,
            *(
                rod(p + vec(e * (w / 2 - 0.004), 0, 0), p + vec(e * (w / 2 + 0.006), 0, 0), 0.004, 8)
                for p in (low, high)
                for e in (-1, 1)
            ),
        )
        degrees = m.pick(60, 68)
        m.hinge(link, low, (-s, 0, 0), degrees)
        m.add(tray, _hollow(style, x, y, z, 0.003))
        m.hinge(tray, high, (s, 0, 0), degrees, link)
        m.add(
            f"lid_{k}",
            body("cad" if style == "soft" else style, (x[0] - 0.001, x[1] + 0.001), y, (z[1] + 0.0005, z[1] + 0.006)),
        )
        m.hinge(f"lid_{k}", (0, d / 2 + s * d / 2, z[1]), (-s, 0, 0), 110, tray)
        m.add(
            f"lid_{k}", rod((-0.35 * w, d / 2 + s * 0.02, z[1] + 0.012), (0.35 * w, d / 2 + s * 0.02, z[1] + 0.012), 0.006, 10)
        )
        m.add(
            f"lid_{k}",
            *(
                box(
                    (e * 0.3 * w - 0.006, e * 0.3 * w + 0.006),
                    (d / 2 + s * 0.02 - 0.003, d / 2 + s * 0.02 + 0.003),
                    (z[1] + 0.004, z[1] + 0.012),
                )
                for e in (-1, 1)
            ),
        )
