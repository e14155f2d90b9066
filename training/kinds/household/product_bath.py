"""Things of the bathroom, by one artist: basin over a cabinet, swing-top bin."""

from __future__ import annotations

import numpy as np

from training.kinds.household.product_taps import tap
from training.kinds.model import BASE, Model
from training.kinds.product_style import FRONT, UP, Look, lathe, outline
from training.kinds.solids import Span, arch, ball, box, cut, loft, moved, prism, rod, vec


def basin_cabinet(m: Model) -> None:
    """A basin on a cabinet with doors, drawers or both, hung or on legs; taps with a lever or crosses, a plug."""
    look = Look.of(m)
    wide, deep, high = m.number(0.5, 1.2), m.number(0.38, 0.5), m.number(0.3, 0.6)
    low, wall, thick = m.pick(0.0, 0.12, 0.2), m.number(0.014, 0.02), look.depth(m.number(0.015, 0.022))
    x, y, z = (-wide / 2, wide / 2), (0.0, deep), (low, low + high)
    m.add(BASE, *look.shell(x, y, z, (wall, wall, wall, 0.6 * wall, 0.008)))
    if low:
        spots = [(a, b) for a in (x[0] + 0.04, x[1] - 0.04) for b in (0.04, deep - 0.04)]
        turned = [(0.012, 0), (0.016, 0.1 * low), (0.024, 0.6 * low), (0.018, 0.75 * low), (0.026, low)]
        legs = turned if look.style == "old" else [(0.014, 0), (0.018, low)]
        m.add(BASE, *(lathe(legs, look.n, (a, b, 0.001)) for a, b in spots))
    _vanity_fronts(look, x, (z[0] + 0.003, z[1] - 0.003), deep, thick)
    slab, top = m.number(0.015, 0.03), z[1]
    over = thick + m.number(0.005, 0.03)
    design = m.pick("bowl", "sunk", "one")
    middle = vec(m.pick(0.0, 0.0, 0.2 * wide), 0.42 * deep, top + slab)
    r = min(0.36 * deep, 0.4 * wide)
    plate = look.block((x[0] - 0.005, x[1] + 0.005), (-over, deep), (top, top + slab)) if design == "bowl" else None
    if design == "bowl":
        square = m.chance(0.5)
        tall = m.number(0.09, 0.14)
        rows = [(0.6, 0.0), (0.95, 0.5 * tall), (1.0, tall), (0.93, tall), (0.85, 0.5 * tall), (0.3, 0.015)]
        rings = [outline((-a * r, a * r), (-a * r, a * r), (0.3 if square else 0.999) * a * r, b, 6) for a, b in rows]
        m.add(BASE, plate, moved(loft(np.array(rings)), middle))
        bottom = middle + vec(0, 0, 0.016)
    else:
        slab = max(slab, 0.03) if design == "sunk" else m.number(0.08, 0.13)
        solid = box((x[0] - 0.005, x[1] + 0.005), (-over, deep), (top, top + slab))
        middle[2] = top + slab
        levels = ((r, middle[2] + 0.001), (0.75 * r, top + 0.012))
        plans = [(*((c - a, c + a) for c, a in zip(middle[:2], (1.15 * q, q), strict=True)), 0.3 * q, h) for q, h in levels]
        hollow = loft(np.array([outline(*plan, 6) for plan in plans]))
        m.add(BASE, cut(solid, hollow))
        bottom = vec(middle[0], middle[1], top + 0.012)
    m.add("plug", lathe([(0.02, -0.004), (0.024, 0.004), (0.01, 0.008)], look.n, bottom))
    m.slide("plug", UP, 0.02)
    tap(look, vec(middle[0], deep - 0.06, top + slab), m.number(0.1, 0.2), middle[1])
    if m.chance(0.3):
        m.add(BASE, box((x[0], x[1]), (deep - 0.012, deep), (top + slab - 0.001, top + slab + 0.08)))


def _vanity_fronts(look: Look, x: Span, z: Span, deep: float, thick: float) -> None:
    """Doors, drawers or a drawer over doors, with boxes behind the drawers."""
    m, gap = look.m, 0.003
    wide, tall = x[1] - x[0], z[1] - z[0]
    columns = 1 if wide < 0.55 else m.pick(2, 2, 3) if wide > 0.8 else m.pick(1, 2)
    edges, design = np.linspace(*x, columns + 1), m.pick("doors", "doors", "drawers", "both")
    boxed, kind, back = m.chance(0.7), m.pick("bar", "knob", "slab", "none", ""), -max(0.0005, min(m.gap(0.3), 0.003))
    for k in range(columns):
        span = (edges[k] + gap / 2, edges[k + 1] - gap / 2)
        drawers = m.pick(1, 2, 3) if design == "drawers" else int(design == "both")
        split = z[0] if design == "drawers" else z[1] - 0.3 * tall if drawers else z[1]
        levels = np.linspace(split, z[1], drawers + 1)
        for j in range(drawers):
            part, rows = f"drawer_{k}_{j}", (levels[j] + gap / 2, levels[j + 1] - gap / 2)
            look.front(part, span, rows, back, thick)
            if boxed:
                inner = (span[0] + 0.025, span[1] - 0.025)
                m.add(part, box(inner, (back, 0.75 * deep), (rows[0] + 0.025, rows[0] + 0.03)))
                m.add(
                    part,
                    *(
                        box((a, a + 0.01), (back, 0.75 * deep), (rows[0] + 0.03, rows[1] - 0.03))
                        for a in (inner[0], inner[1] - 0.01)
                    ),
                )
            if kind != "none":
                look.grip(part, ((span[0] + span[1]) / 2, back - thick, (rows[0] + rows[1]) / 2), (1, 0, 0), 0.12, 0.025, kind)
            m.slide(part, FRONT, 0.6 * deep)
        if design == "drawers":
            continue
        part, left = f"door_{k}", k % 2 == 0
        look.front(part, span, (z[0], split - gap), back, thick)
        if kind != "none":
            at = span[1] - 0.03 if left else span[0] + 0.03
            look.grip(part, (at, back - thick, 0.7 * split + 0.3 * z[0]), UP, 0.1, 0.025, kind)
        m.hinge(part, (span[0] if left else span[1], back, z[0]), (0, 0, -1 if left else 1), m.pick(95, 110, 120))


def bathroom_scale_bin(m: Model) -> None:
    """A bin whose flap swings both ways in a gabled or round hood that lifts off, or with two flaps on its top."""
    look = Look.of(m)
    w, d, high = m.number(0.09, 0.17), m.number(0.08, 0.13), m.number(0.22, 0.5)
    design, foot = m.pick("gable", "gable", "dome", "twin"), m.number(0.7, 0.95)
    if design == "dome":
        d = w
    r = (0.999 if design == "dome" else m.number(0.05, 0.5)) * d
    steps, wall = 2 if look.style == "prop" else 5, 0.004

    def plan(s: float, z: float, inset: float = 0.0) -> np.ndarray:
        a, b = s * w - inset, s * d - inset
        return outline((-a, a), (-b, b), min(s * r, 0.999 * min(a, b)), z, steps)

    inner = [plan(1.0, high, wall), plan(foot, 0.005, wall)] if look.style != "sheet" else []
    m.add(BASE, loft(np.array([plan(foot, 0.0), plan(1.0, high), *inner]), look.style != "sheet"))
    if m.chance(0.4):
        m.add(
            BASE,
            loft(
                np.array([plan(1.02, high - 0.03), plan(1.02, high - 0.012), plan(1.0, high - 0.012), plan(1.0, high - 0.03)]),
                True,
            ),
        )
    hood = BASE if m.chance(0.35) else "hood"
    if hood != BASE:
        m.slide(hood, UP, m.number(0.1, 0.4) * high)
    z = high + 0.0005
    if design == "dome":
        _dome(look, hood, 1.02 * w, z)
    elif design == "gable":
        _gable(look, hood, (1.02 * w, 1.02 * d), z)
    else:
        frame = loft(np.array([plan(1.03, z - 0.012), plan(1.03, z + 0.02)]))
        hole = ((-0.8 * w, 0.8 * w), (-0.75 * d, 0.75 * d))
        m.add(hood, cut(frame, box(*hole, (z - 1, z + 1))))
        for k, s in enumerate((-1, 1)):
            side = sorted((s * 0.0008, s * (0.8 * w - 0.001)))
            m.add(f"flap_{k}", box((side[0], side[1]), (-0.745 * d, 0.745 * d), (z + 0.012, z + 0.017)))
            m.hinge(f"flap_{k}", (s * (0.8 * w - 0.001), 0, z + 0.014), (0, -s, 0), 75, hood)
    if m.chance(0.3):
        m.add(
            BASE,
            *(ball((s * foot * 0.6 * w, t * foot * 0.6 * d, 0.0), (0.01, 0.01, 0.006), 8) for s in (-1, 1) for t in (-1, 1)),
        )


def _gable(look: Look, hood: str, half: tuple[float, float], z: float) -> None:
    """A hood with two gables and a flap like a roof, or a sloping plate, that swings between them."""
    m, (w, d) = look.m, half
    tall, t = m.number(0.09, 0.14), 0.006
    ridge = m.chance(0.6)
    side = [(-d, z), (d, z), (d, z + 0.02), (0.15 * d, z + tall), (-0.15 * d, z + tall), (-d, z + 0.02)]
    if not ridge:
        side = arch((-d, d), (z, z + tall), tall - 0.01, 10)
    m.add(hood, *(prism(side, "x", span) for span in ((-w, -w + t), (w - t, w))))
    m.add(hood, *(box((-w + t, w - t), span, (z, z + 0.018)) for span in ((-d, -d + t), (d - t, d))))
    inner, axle = (-w + t + 0.001, w - t - 0.001), vec(0, 0, z + 0.86 * tall)
    slope = np.array([(0.92 * d, z + 0.024), (0.13 * d, z + tall - 0.004), (0.0, z + tall)])
    roof = np.concatenate([slope * (-1, 1), slope[-2::-1]])
    if look.style == "sheet" or m.chance(0.5):
        lowered = roof[::-1] - (0, 0.004)
        m.add("flap", prism(np.concatenate([roof, lowered]), "x", inner))
    else:
        m.add("flap", prism(roof, "x", inner))
    m.add("flap", rod((inner[0] - 0.003, 0, axle[2]), (inner[1] + 0.003, 0, axle[2]), 0.003, 8))
    m.hinge("flap", axle, (1, 0, 0), (-60, 60))


def _dome(look: Look, hood: str, r: float, z: float) -> None:
    """A round hood with a slanting mouth that a flap closes."""
    m, n = look.m, 16
    tall = m.number(0.8, 1.1) * r
    rows = [(r, 0), (r, 0.1 * tall), (0.92 * r, 0.5 * tall), (0.7 * r, 0.85 * tall), (0.3 * r, tall)]
    inside = [
        (0.3 * r, tall - 0.006),
        (0.66 * r, 0.85 * tall - 0.006),
        (0.88 * r, 0.5 * tall - 0.004),
        (r - 0.006, 0.1 * tall),
        (r - 0.006, 0),
    ]
    shell = lathe([*rows, *inside], n, (0, 0, z))
    a, low, top = 0.55 * r, z + 0.2 * tall, z + 0.72 * tall
    m.add(
        hood,
        cut(lathe(rows, n, (0, 0, z)), lathe(inside[::-1], n, (0, 0, z)), box((-a, a), (-2 * r, -0.2 * r), (low, top)))
        if shell.is_volume
        else shell,
    )
    y, back = -0.56 * r, -0.8 * r
    plate = [(back, low + 0.001), (y, top - 0.001), (y + 0.006, top - 0.001), (back + 0.006, low + 0.001)]
    m.add("flap", prism(plate, "x", (-a + 0.001, a - 0.001)))
    m.add("flap", rod((-a - 0.004, y + 0.004, top - 0.006), (a + 0.004, y + 0.004, top - 0.006), 0.003, 8))
    m.hinge("flap", (0, y + 0.003, top - 0.006), (1, 0, 0), (0, m.pick(50, 65)), hood)
