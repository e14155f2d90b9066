"""Crates, generators, columns and wall panels of science fiction of which nothing moves [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.buildings.still_buildings import stage
from training.kinds.clay import curve
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, around, ball, box, moved, prism, rectangle, ring, rod, tube, turned, vec
from training.kinds.still.still_plants import UP
from training.kinds.still_structures import finish
from training.kinds.wheels import beam, lathe


def _chamfered(a: Span, b: Span, by: float) -> Polygon:
    """A rectangle with cut corners."""
    return Polygon(rectangle((a[0] + by, a[1] - by), (b[0] + by, b[1] - by)).buffer(by, quad_segs=1).exterior.coords)


def _greeble_more(m: Model, form: str, x: Span, y: float, z: Span, t: float) -> None:
    """A coil, a dish, steps or a cross as a detail on a wall."""
    w, h, a, c = x[1] - x[0], z[1] - z[0], (x[0] + x[1]) / 2, (z[0] + z[1]) / 2
    s = min(w, h)
    if form == "coil":
        m.add(
            BASE,
            rod((a, y, z[0]), (a, y, z[1]), 0.15 * s, 10),
            *(ring((a, y, q), UP, 0.2 * s, 0.06 * s, 14) for q in np.linspace(*z, 6)),
        )
    elif form == "dish":
        m.add(
            BASE,
            rod((a, y - t, c), (a, y + 0.01, c), 0.45 * s, m.pick(6, 8, 20)),
            rod((a, y - 1.6 * t, c), (a, y, c), 0.28 * s, 12),
        )
    elif form == "steps":
        m.add(
            BASE,
            *(
                box(
                    (x[0] + 0.1 * k * w, x[1] - 0.1 * k * w),
                    (y - t * (k + 1) / 2, y + 0.01),
                    (z[0] + 0.1 * k * h, z[1] - 0.1 * k * h),
                )
                for k in range(3)
            ),
        )
    elif form == "cross":
        m.add(BASE, *(beam((x[0], y, p), (x[1], y, q), 0.5 * t, 0.1 * s, (0, 1, 0)) for p, q in (z, z[::-1])))


def _greeble(m: Model, x: Span, y: float, z: Span) -> None:
    """One fixed detail in a cell of a wall that faces -Y at depth y."""
    form = m.pick("plate", "vents", "tank", "pipes", "bolts", "ribs", "screen", "coil", "dish", "steps", "cross", "none")
    w, h, a, c = x[1] - x[0], z[1] - z[0], (x[0] + x[1]) / 2, (z[0] + z[1]) / 2
    s, t = min(w, h), m.number(0.08, 0.28) * min(w, h)
    if form == "plate":
        m.add(BASE, prism(_chamfered(x, z, m.number(0.05, 0.25) * s), "y", (y - t, y + 0.01)))
    elif form == "vents":
        m.add(BASE, *(box(x, (y - t, y + 0.01), (q, q + 0.4 * h / 6)) for q in np.linspace(z[0], z[1] - 0.4 * h / 6, 6)))
    elif form == "tank":
        ends = ((x[0], y, c), (x[1], y, c)) if w > h else ((a, y, z[0]), (a, y, z[1]))
        m.add(BASE, rod(*ends, 0.28 * s, 12), *(ball(e, (0.28 * s,) * 3, 10) for e in ends))
        m.add(
            BASE,
            *(
                ring(np.array(ends[0]) + u * (np.array(ends[1]) - ends[0]), np.subtract(*ends), 0.29 * s, 0.03 * s, 14)
                for u in (0.25, 0.75)
            ),
        )
    elif form == "pipes":
        for q in np.linspace(x[0] + 0.1 * w, x[1] - 0.1 * w, m.pick(2, 3, 5)):
            m.add(BASE, tube([(q, y + 0.01, z[0]), (q, y - t, z[0]), (q, y - t, z[1]), (q, y + 0.01, z[1])], 0.05 * s, 6))
    elif form == "bolts":
        m.add(BASE, box(x, (y - 0.4 * t, y + 0.01), z))
        m.add(
            BASE,
            *(
                rod((p, y - 0.7 * t, q), (p, y, q), 0.07 * s, 6)
                for p in (x[0] + 0.12 * w, x[1] - 0.12 * w)
                for q in (z[0] + 0.12 * h, z[1] - 0.12 * h)
            ),
        )
    elif form == "ribs":
        m.add(BASE, *(box((q - 0.04 * w, q + 0.04 * w), (y - t, y + 0.01), z) for q in np.linspace(x[0], x[1], m.pick(4, 6))))
    elif form == "screen":
        m.add(BASE, prism(rectangle(x, z, 0.1 * s), "y", (y - t, y + 0.01)), box(x, (y - 0.3 * t, y + 0.005), z))
    _greeble_more(m, form, x, y, z, t)


def _cells(m: Model, x: Span, z: Span, deep: int) -> list[tuple[Span, Span]]:
    """Divide a wall into cells of unlike sizes."""
    if deep == 0:
        g = 0.06 * min(x[1] - x[0], z[1] - z[0])
        return [((x[0] + g, x[1] - g), (z[0] + g, z[1] - g))]
    u = m.number(0.3, 0.7)
    if (x[1] - x[0]) > (z[1] - z[0]) * m.number(0.6, 1.5):
        c = x[0] + u * (x[1] - x[0])
        return _cells(m, (x[0], c), z, deep - m.pick(1, 1, 1, deep)) + _cells(m, (c, x[1]), z, deep - 1)
    c = z[0] + u * (z[1] - z[0])
    return _cells(m, x, (z[0], c), deep - m.pick(1, 1, 1, deep)) + _cells(m, x, (c, z[1]), deep - 1)


def _side(m: Model, x: Span, y: float, z: Span, deep: int, turn: float) -> None:
    """Details on a wall that faces -Y at depth y, then turned about the vertical."""
    start = len(m.pieces)
    for a, c in _cells(m, x, z, deep):
        _greeble(m, a, y, c)
    for _, s in m.pieces[start:]:
        turned(s, UP, turn, (0, 0, 0))


def _sci_crate(m: Model) -> None:
    """A container with cut edges, corner pieces, frames, skids and details on its sides."""
    w, d, h = m.number(0.4, 1.0), m.number(0.35, 0.7), m.number(0.5, 1.2)
    by, t = m.number(0.03, 0.15) * h, m.number(0.03, 0.07)
    way = m.pick("x", "z")
    span = ((-d, d), (0, h), (-w, w)) if way == "x" else ((-w, w), (-d, d), (0, h))
    m.add(BASE, prism(_chamfered(span[0], span[1], by), way, span[2]))
    for turn, a, b in ((0, w, d), (90, d, w), (180, w, d), (270, d, w)):
        if m.chance(0.85):
            _side(m, (-0.8 * a, 0.8 * a), -b, (0.15 * h, 0.85 * h), m.pick(0, 1, 2), turn)
    if m.chance(0.6):
        corner = box((w - 3 * t, w + t), (d - 3 * t, d + t), (-t, 3 * t))
        for s in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
            one = corner.copy().apply_transform(np.diag([*s, 1.0, 1.0]))
            m.add(BASE, one, *[moved(one.copy(), (0, 0, h - 2 * t))][: m.pick(1, 1, 0)])
    else:
        m.add(BASE, *(box((s * 0.7 * w - t, s * 0.7 * w + t), (-1.02 * d, 1.02 * d), (-2 * t, 0.01)) for s in (-1, 1)))
    for q in m.pick((), (0,), (-0.5, 0.5)):
        m.add(BASE, prism(rectangle((-d - t, d + t), (-0.01, h + t), (t, t, 0.01, t)), "x", (q * w - t, q * w + t)))
    m.add(BASE, *[prism(_chamfered((-0.6 * w, 0.6 * w), (-0.6 * d, 0.6 * d), by), "z", (h - 0.01, h + t))][: m.pick(0, 1)])


def _generator(m: Model) -> None:
    """A lying or standing drum with bands, fins, cables and a bed."""
    r, long, n, k = m.number(0.25, 0.5), m.number(0.8, 1.8), m.pick(6, 8, 16, 24), m.pick(0, 6, 8, 12)
    start = len(m.pieces)
    m.add(BASE, lathe([(0, 0), (0.8 * r, 0), (r, 0.12 * long), (r, 0.88 * long), (0.8 * r, long), (0, long)], n))
    m.add(
        BASE,
        *(
            rod((0, 0, (u - 0.03) * long), (0, 0, (u + 0.03) * long), 1.08 * r, n)
            for u in m.pick((0.2, 0.8), (0.15, 0.38, 0.62, 0.85), (0.5,))
        ),
    )
    m.add(BASE, *around(box((-0.03 * r, 0.03 * r), (-1.25 * r, -0.8 * r), (0.25 * long, 0.75 * long)), max(k, 1))[: k or 0])
    m.add(
        BASE,
        rod((0, 0, -0.1 * long), (0, 0, 1.08 * long), 0.45 * r, n),
        *around(rod((0, -0.65 * r, -0.03 * long), (0, -0.65 * r, 1.03 * long), 0.06 * r, 6), 8)[:: m.pick(1, 2, 99)],
    )
    if m.chance(0.6):
        for _, s in m.pieces[start:]:
            moved(turned(s, (0, 1, 0), 90, (0, 0, 0)), (-long / 2, 0, 1.25 * r))
        m.add(BASE, box((-0.6 * long, 0.6 * long), (-1.1 * r, 1.1 * r), (-0.15, 0.05)))
        m.add(BASE, *(box((u * long - 0.06 * long, u * long + 0.06 * long), (-0.8 * r, 0.8 * r), (0, r)) for u in (-0.3, 0.3)))
        _side(m, (-0.55 * long, 0.55 * long), -1.1 * r, (-0.14, 0.04), 2, 0)
        m.add(
            BASE,
            *(
                tube(
                    curve((u * long, -0.9 * r, 0.0), (u * long, -1.6 * r, 1.2 * r), (0.8 * u * long, -0.9 * r, 1.4 * r), 8),
                    0.06 * r,
                )
                for u in m.pick((), (-0.2, 0.1), (-0.3, -0.1, 0.1, 0.3))
            ),
        )
    else:
        m.add(
            BASE,
            stage([(1.5 * r, -0.2 * long), (1.3 * r, -0.05 * long)], n),
            *around(beam((0, -1.4 * r, -0.15 * long), (0, -0.95 * r, 0.4 * long), 0.12 * r, 0.2 * r), m.pick(3, 4)),
        )
        m.add(
            BASE,
            *around(
                tube(curve((0, -1.3 * r, -0.1 * long), (0, -2.0 * r, 0.5 * long), (0, -0.6 * r, 1.0 * long), 8), 0.05 * r),
                m.pick(2, 4, 6),
            )[:: m.pick(1, 99)],
        )


def _column(m: Model) -> None:
    """A reactor or power column: a core in rings between a floor and a ceiling piece."""
    r, high, n = m.number(0.2, 0.4), m.number(1.4, 2.6), m.pick(6, 8, 12, 24)
    for z, s in ((0, 1), (high, -1)):
        m.add(
            BASE,
            *(
                stage([(a * r, z + s * u * high), (b * r, z + s * v * high)], n)
                for a, b, u, v in ((2, 1.8, 0, 0.06), (1.7, 1.2, 0.06, 0.16), (1.2, 1.1, 0.16, 0.22))
            ),
        )
    m.add(BASE, rod((0, 0, 0.1 * high), (0, 0, 0.9 * high), m.number(0.4, 0.8) * r, n))
    m.add(BASE, *(ring((0, 0, u * high), UP, r, 0.1 * r, 20) for u in np.linspace(0.3, 0.7, m.pick(2, 3, 5))))
    m.add(BASE, *around(box((-0.08 * r, 0.08 * r), (-1.1 * r, -0.95 * r), (0.2 * high, 0.8 * high)), m.pick(3, 4, 6)))
    m.add(
        BASE,
        *around(tube([(0, -1.5 * r, 0.02), (0, -1.5 * r, 0.3 * high), (0, -1.0 * r, 0.35 * high)], 0.06 * r), m.pick(1, 4, 5)),
    )
    m.add(
        BASE,
        *around(
            prism([(-1.9 * r, 0), (-0.4 * r, 0), (-0.4 * r, 0.4 * high), (-1.0 * r, 0.15 * high)], "x", (-0.07 * r, 0.07 * r)),
            m.pick(3, 4, 6),
            30,
        )[:: m.pick(1, 99)],
    )


def space_prop(m: Model) -> None:
    """A crate, generator, column, machine block or wall panel of a space station, full of fixed details; nothing moves."""
    form = m.pick("crate", "crate", "generator", "column", "panel", "panel", "block")
    if form in ("crate", "generator", "column"):
        {"crate": _sci_crate, "generator": _generator, "column": _column}[form](m)
    elif form == "panel":
        w, h, t = m.number(0.75, 1.5), m.number(1.6, 2.8), m.number(0.08, 0.2)
        m.add(
            BASE, box((-w, w), (0, t), (0, h)) if m.chance(0.5) else prism(_chamfered((-w, w), (0, h), 0.15 * w), "y", (0, t))
        )
        _side(m, (-0.85 * w, 0.85 * w), 0, (0.1 * h, 0.9 * h), m.pick(3, 4, 4), 0)
        frame = prism(
            rectangle((-1.03 * w, 1.03 * w), (-0.01, h + 0.05), m.number(0.05, 0.12) * w),
            "y",
            (-m.number(0.03, 0.12), t + 0.01),
        )
        m.add(
            BASE,
            *[frame][: m.pick(0, 1)],
            *(beam((s * 1.1 * w, 0.1, 0), (s * 0.9 * w, 0.1, h), 0.12, 0.3) for s in (-1, 1) if m.chance(0.4)),
        )
    else:
        w, h = m.number(0.4, 0.7), m.number(0.7, 1.3)
        z = 0.0
        for k in range(m.pick(2, 3)):
            a, z1 = w * (1 - 0.18 * k), z + h * (0.7 if k else 1)
            m.add(BASE, box((-a, a), (-a, a), (z - 0.01, z1)))
            for turn in (0, 90, 180, 270):
                _side(m, (-0.9 * a, 0.9 * a), -a, (z + 0.05, z1 - 0.05), m.pick(1, 2), turn)
            z = z1
        m.add(BASE, *(rod((s * 0.3 * w, 0, z - 0.02), (s * 0.3 * w, 0, z + m.number(0.1, 0.6)), 0.03, 8) for s in (-1, 1)))
        m.add(BASE, ball((0.0, 0, z), vec(0.2, 0.2, 0.15) * w, 12), stage([(1.7 * w, -0.1), (1.6 * w, 0)], m.pick(4, 8)))
    finish(m)
