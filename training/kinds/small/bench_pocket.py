"""Compasses for the pocket."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.bench_style import STYLES, bar, body, lathe, plane
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, vec

UP = (0, 0, 1)


def pocket_compass(m: Model) -> None:
    """A round case with a lid, a plate with a dial, or a wooden box with a bowl in rings; the needle turns."""
    style = m.pick(*STYLES)
    m.pick(_round_case, _round_case, _base_plate, _boxed)(m, style, max(16, m.sections()))


def _needle(m: Model, style: str, at: np.ndarray, r: float, parent: str = BASE) -> None:
    """A needle on its pin: a rhombus, an arrow or a card."""
    part = "needle"
    turn = m.number(0, 2 * np.pi)
    if m.chance(0.2):
        pieces = [rod((0, 0, 0), (0, 0, 0.0008), 0.8 * r, 24), box((-0.002, 0.002), (0, 0.75 * r), (0.0007, 0.0012))]
    elif style in ("game", "sheet"):
        pieces = [prism(Polygon([(0, 0.85 * r), (0.12 * r, 0), (0, -0.85 * r), (-0.12 * r, 0)]), "z", (0, 0.0008))]
    else:
        pieces = [prism(Polygon([(0, s * 0.85 * r), (s * 0.1 * r, 0), (-s * 0.1 * r, 0)]), "z", (0, 0.0008)) for s in (1, -1)]
        pieces += [lathe((0, 0, 0), UP, [(0.1 * r, -0.0002), (0.1 * r, 0.001), (0.04 * r, 0.002)], 12)]
    c, s = np.cos(turn), np.sin(turn)
    for p in pieces:
        p.vertices = p.vertices @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T + at
    m.add(part, *pieces)
    m.add(parent, rod(at - vec(0, 0, 0.004), at, 0.03 * r, 8))
    m.spin(part, at, UP, parent)


def _round_case(m: Model, style: str, n: int) -> None:
    """A case like that of a watch; lid behind, crown and bow in front, perhaps a ring that turns and a sight."""
    r, h = m.number(0.022, 0.035), m.number(0.008, 0.014)
    n = 10 if style == "game" else 2 * n
    case = rod((0, 0, 0), (0, 0, h), r, n)
    if style == "soft":
        case = lathe((0, 0, 0), UP, [(0.8 * r, 0), (0.95 * r, 0.15 * h), (r, 0.5 * h), (0.97 * r, h)], n)
    m.add(BASE, cut(case, rod((0, 0, 0.3 * h), (0, 0, 1), 0.86 * r, n)))
    _needle(m, style, vec(0, 0, 0.3 * h + 0.003), 0.8 * r)
    m.add(
        BASE,
        *(
            box((c - 0.0005, c + 0.0005), (s - 0.0005, s + 0.0005), (0.25 * h, 0.3 * h + 0.0006))
            for c, s in (0.7 * r * np.array([np.cos(t), np.sin(t)]) for t in np.arange(0, 6.28, np.pi / 6))
        ),
    )
    top = h
    if m.chance(0.4):
        bezel = cut(rod((0, 0, h + 0.0002), (0, 0, h + 0.003), 0.98 * r, n), rod((0, 0, 0), (0, 0, 1), 0.84 * r, n))
        m.add("bezel", bezel, box((-0.001, 0.001), (-0.97 * r, -0.85 * r), (h + 0.0025, h + 0.004)))
        m.spin("bezel", (0, 0, h), UP)
        top = h + 0.004
    slack = max(m.gap(h), 0.0002)
    z, back = (top + slack, top + slack + m.number(0.002, 0.004)), r + 0.0025
    lid = rod((0, 0, z[0]), (0, 0, z[1]), r, n)
    if style in ("old", "soft", "flush"):
        lid = lathe(
            (0, 0, z[0]), UP, [(r, 0), (r, 0.4 * (z[1] - z[0])), (0.85 * r, z[1] - z[0]), (0.1 * r, 1.2 * (z[1] - z[0]))], n
        )
    if m.chance(0.3):
        lid = cut(lid, box((-0.1 * r, 0.1 * r), (-0.7 * r, 0.7 * r), (0, 1)))
        m.add("lid", rod((0, -0.72 * r, (z[0] + z[1]) / 2), (0, 0.72 * r, (z[0] + z[1]) / 2), 0.0003, 6))
    m.add("lid", lid, box((-0.004, 0.004), (0.9 * r, back), (z[0], z[1] - 0.0005)))
    m.add(
        BASE,
        box((-0.008, 0.008), (0.9 * r, back - 0.0005), (0.3 * h, h - 0.0005)),
        box((-0.008, 0.008), (0.99 * r, back - 0.0005), (0.3 * h, top - 0.0005)),
        rod((-0.008, back, top - 0.0005), (0.008, back, top - 0.0005), 0.0015, 8),
    )
    m.hinge("lid", (0, back, top), (-1, 0, 0), m.pick(95, 130, 180))
    _bow(m, r, h)


def _bow(m: Model, r: float, h: float) -> None:
    """A neck with a bow that swings, and a crown or catch that is pressed."""
    y, z = -r, h / 2
    if m.chance(0.6):
        m.add(BASE, rod((0, y + 0.002, z), (0, y - 0.006, z), 0.003, 10))
        m.add("bow", ring((0, y - 0.013, z), UP, 0.009, 0.0012, 16))
        m.hinge("bow", (0, y - 0.005, z), (-1, 0, 0), (-80, 80))
        if m.chance(0.5):
            m.add("crown", rod((0, y - 0.0062, z), (0, y - 0.009, z), 0.0026, 12))
            m.slide("crown", (0, 1, 0), 0.002)
    elif m.chance(0.6):
        m.add("catch", box((-0.004, 0.004), (y - 0.0025, y + 0.12 * r), (z - 0.0025, z + 0.0025)))
        m.slide("catch", (0, 1, 0), 0.0015)


def _base_plate(m: Model, style: str, n: int) -> None:
    """A flat plate with a turning dial, the needle in it, perhaps a lid with a mirror."""
    w, long, thick = m.number(0.05, 0.065), m.number(0.09, 0.12), m.number(0.003, 0.005)
    y = (-long + 0.4 * w, 0.55 * w)
    plate = (
        body(style, (-w / 2, w / 2), y, (0, thick))
        if style in ("game", "sheet")
        else prism(rounded((-w / 2, w / 2), y, 0.008), "z", (0, thick))
    )
    m.add(
        BASE,
        plate,
        prism([(0, y[0] + 0.008), (0.004, y[0] + 0.02), (-0.004, y[0] + 0.02)], "z", (thick - 0.001, thick + 0.0006)),
    )
    r, h = 0.4 * w, m.number(0.006, 0.01)
    n = 12 if style == "game" else 2 * n
    m.add("dial", cut(rod((0, 0, thick + 0.0002), (0, 0, thick + h), r, n), rod((0, 0, thick + 0.002), (0, 0, 1), 0.84 * r, n)))
    ticks = [box((0.99 * r, 1.04 * r), (-0.001, 0.001), (thick + 0.001, thick + h - 0.001)) for _ in range(18)]
    for k, tick in enumerate(ticks):
        c, s = np.cos(k * np.pi / 9), np.sin(k * np.pi / 9)
        tick.vertices = tick.vertices @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T
    if style in ("cad", "old", "soft"):
        m.add("dial", *ticks)
    m.spin("dial", (0, 0, thick), UP)
    _needle(m, style, vec(0, 0, thick + 0.0055), 0.75 * r, "dial")
    if m.chance(0.5):
        z = (thick + h + 0.0005, thick + h + 0.0045)
        m.add("lid", body("flush", (-w / 2, w / 2), (-0.5 * w, y[1]), z))
        m.add(
            "lid",
            plane(
                (-0.4 * w, -0.4 * w, z[0] - 0.0002),
                (-0.4 * w, 0.4 * w, z[0] - 0.0002),
                (0.4 * w, 0.4 * w, z[0] - 0.0002),
                (0.4 * w, -0.4 * w, z[0] - 0.0002),
            ),
        )
        m.add(
            BASE,
            *(
                box((s * 0.42 * w - 0.004, s * 0.42 * w + 0.004), (y[1] - 0.004, y[1] + 0.001), (thick - 0.001, z[0]))
                for s in (-1, 1)
            ),
        )
        m.add("lid", rod((-0.3 * w, y[1], z[0]), (0.3 * w, y[1], z[0]), 0.0015, 8))
        m.hinge("lid", (0, y[1], z[0]), (-1, 0, 0), m.pick(120, 180))


def _boxed(m: Model, style: str, n: int) -> None:
    """A wooden box with a lid; a bowl that tips in a ring that tips, as on ships."""
    w, h = m.number(0.07, 0.11), m.number(0.035, 0.05)
    x, wall = (-w / 2, w / 2), 0.005
    m.add(
        BASE,
        cut(
            body("cad" if style == "sheet" else style, x, x, (0, h)),
            box((x[0] + wall, x[1] - wall), (x[0] + wall, x[1] - wall), (wall, 1)),
        ),
    )
    r, z = 0.5 * w - wall - 0.004, h - 0.01
    m.add("gimbal", cut(rod((0, 0, z - 0.002), (0, 0, z + 0.002), r, 2 * n), rod((0, 0, 0), (0, 0, 1), r - 0.0025, 2 * n)))
    m.add("gimbal", *(rod((s * (r - 0.001), 0, z), (s * (r + 0.006), 0, z), 0.001, 8) for s in (-1, 1)))
    m.hinge("gimbal", (0, 0, z), (1, 0, 0), (-20, 20))
    b = r - 0.005
    m.add(
        "bowl",
        lathe(
            (0, 0, z),
            UP,
            [(0.5 * b, -0.016), (b, -0.008), (b, 0.002), (0.9 * b, 0.002), (0.88 * b, -0.004), (0, -0.004)],
            2 * n,
        ),
    )
    m.add("bowl", *(rod((0, s * (b - 0.001), z), (0, s * (r - 0.001), z), 0.001, 8) for s in (-1, 1)))
    m.hinge("bowl", (0, 0, z), (0, 1, 0), (-20, 20), "gimbal")
    _needle(m, style, vec(0, 0, z - 0.001), 0.8 * b, "bowl")
    top = (h + 0.0005, h + m.number(0.006, 0.015))
    m.add("lid", body("cad" if style == "sheet" else style, x, x, top))
    m.add(
        BASE,
        *(rod((s * 0.3 * w - 0.008, x[1] + 0.0005, h), (s * 0.3 * w + 0.008, x[1] + 0.0005, h), 0.0015, 8) for s in (-1, 1)),
    )
    m.hinge("lid", (0, x[1], h), (-1, 0, 0), m.pick(95, 120))
    if m.chance(0.6):
        m.add(
            "hook",
            bar((0, x[0] - 0.002, h + 0.004), (0.014, x[0] - 0.002, h - 0.003), 0.0025, 0.002, (0, 0, 1)),
            ball((0, x[0] - 0.002, h + 0.004), (0.0022, 0.002, 0.0022), 8),
        )
        m.hinge("hook", (0, x[0] - 0.002, h + 0.004), (0, -1, 0), 110, "lid")
        m.add(BASE, ball((0.014, x[0], h - 0.004), (0.0018, 0.003, 0.0018), 8))
