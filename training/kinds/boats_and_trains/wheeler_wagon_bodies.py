"""Houses, boards, tanks and bins of rail wagons, in one artist's ways."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, loft, prism, ring, rod, vec
from training.kinds.wheeler_style import softened


@dataclass(frozen=True)
class WagonSizes:
    """A wagon's style, half length, half width, height of its floor and top."""

    style: str
    long: float
    half: float
    floor: float
    top: float


def _ribs(m: Model, w: WagonSizes, free: tuple[float, float], top: float) -> None:
    """Posts on the sides outside a doorway."""
    for y in np.linspace(-w.long + 0.25, w.long - 0.25, m.pick(5, 7, 9)):
        if not free[0] - 0.05 < y < free[1] + 0.05:
            m.add(
                BASE, *(box((s * (w.half - 0.01), s * (w.half + 0.05)), (y - 0.04, y + 0.04), (w.floor, top)) for s in (-1, 1))
            )


def covered(m: Model, w: WagonSizes) -> None:
    """A house on a floor; doors slide along its sides or swing."""
    rise, t = m.number(0.2, 0.5), 0.05
    shape = [
        (-w.half, w.floor),
        (w.half, w.floor),
        (w.half, w.top),
        (0.6 * w.half, w.top + 0.75 * rise),
        (0, w.top + rise),
        (-0.6 * w.half, w.top + 0.75 * rise),
        (-w.half, w.top),
    ]
    outline = softened(shape, 0.0 if w.style in ("low", "sheet") else 0.15)
    shell = prism(outline, "y", (-w.long, w.long))
    hollow = w.style != "low" or m.chance(0.5)
    if hollow:
        shell = cut(shell, prism(outline.buffer(-t, join_style=2), "y", (-w.long + t, w.long - t)))
    wide = m.number(0.9, 1.4)
    y0, y1, z0, z1 = -wide, wide, w.floor + 0.08, w.top - 0.12
    slides, count = m.chance(0.65), m.pick(1, 2)
    if hollow:
        shell = cut(shell, box((-2 * w.half, 2 * w.half), (y0, y1), (z0, z1)))
    m.add(BASE, shell)
    out = w.half + 0.012 if slides else w.half - t
    for s, side in ((-1, "left"), (1, "right")):
        for k in range(count):
            a = y0 + k * (y1 - y0) / count
            b = a + (y1 - y0) / count
            part = f"door_{side}" + (f"_{k}" if count > 1 else "")
            over = 0.06 if slides else -0.004
            span = (a - (over if k == 0 else -0.003), b + (over if k == count - 1 else -0.003))
            x = (s * (out if hollow or slides else w.half + 0.001), s * (out + t))
            m.add(part, box(x, span, (z0 - over, z1 + over)))
            _door_trims(m, w, part, x[1], s, span, (z0, z1))
            first = k == 0
            if slides:
                m.slide(part, (0, -1 if first and count > 1 else 1, 0), 0.95 * (b - a))
            else:
                m.hinge(part, (x[1], a if first else b, (z0 + z1) / 2), (0, 0, -s if first else s), m.number(90, 160))
        if slides:
            z = z1 + 0.07
            m.add(BASE, box((s * (w.half - 0.01), s * (w.half + 0.09)), (y0 - 0.1, y1 + 2 * wide * 0.95), (z, z + 0.06)))
            m.add(
                BASE, box((s * (w.half - 0.01), s * (w.half + 0.075)), (y0 - 0.1, y1 + 2 * wide * 0.95), (z0 - 0.12, z0 - 0.07))
            )
    if not slides:
        _ribs(m, w, (y0, y1), w.top - 0.05)


def _door_trims(m: Model, w: WagonSizes, part: str, x: float, s: int, span: Span, height: Span) -> None:
    """Bars across a door and a handle on posts at its free edge."""
    z0, z1 = height
    for z in (0.3, 0.7) if w.style != "low" else ():
        at = z0 + z * (z1 - z0)
        m.add(part, box((x - s * 0.01, x + s * 0.03), (span[0] + 0.03, span[1] - 0.03), (at, at + 0.08)))
    free = span[0] + 0.06 if part.endswith("_1") else span[1] - 0.12
    m.add(part, rod((x + s * 0.04, free, z0 + 0.7), (x + s * 0.04, free, z0 + 1.1), 0.018, 8))
    m.add(part, *(rod((x - s * 0.01, free, z0 + h), (x + s * 0.04, free, z0 + h), 0.014, 6) for h in (0.74, 1.06)))


def boarded(m: Model, w: WagonSizes) -> None:
    """A floor with boards round it that drop, or stakes that swing."""
    z, high, t = w.floor, m.number(0.5, 1.1), 0.06
    m.add(BASE, box((-w.half, w.half), (-w.long, w.long), (z - 0.1, z)))
    count = m.pick(1, 2, 3)
    wide = (2 * w.long - 2 * t) / count
    for y in [-w.long + t + k * wide for k in range(count + 1)]:
        m.add(
            BASE, *(box((s * (w.half - 0.03), s * (w.half + 0.05)), (y - 0.05, y + 0.05), (z - 0.1, z + high)) for s in (-1, 1))
        )
    for s, side in ((-1, "left"), (1, "right")):
        for k in range(count):
            y = -w.long + t + k * wide
            part = f"side_board_{side}_{k}"
            rows = m.pick(1, 3, 4) if w.style != "low" else 1
            for n in range(rows):
                m.add(
                    part,
                    box(
                        (s * (w.half - 0.02), s * (w.half + 0.03)),
                        (y + 0.06, y + wide - 0.06),
                        (z + 0.005 + n * high / rows, z - 0.005 + (n + 1) * high / rows),
                    ),
                )
            if rows > 1 or m.chance(0.5):
                m.add(
                    part,
                    *(
                        box(
                            (s * (w.half + 0.025), s * (w.half + 0.05)),
                            (y + f * wide - 0.05, y + f * wide + 0.05),
                            (z + 0.005, z + high - 0.01),
                        )
                        for f in (0.2, 0.8)
                    ),
                )
            m.hinge(part, (s * (w.half + 0.03), y + wide / 2, z), (0, s, 0), m.number(150, 175))
    for e, end in ((-1, "front"), (1, "rear")):
        part = f"end_board_{end}" if m.chance(0.6) else BASE
        m.add(part, box((-w.half + 0.04, w.half - 0.04), (e * (w.long - t), e * w.long), (z + 0.002, z + high)))
        if part != BASE:
            m.hinge(part, (0, e * w.long, z), (-e, 0, 0), 90)


def tank(m: Model, w: WagonSizes) -> None:
    """A boiler on saddles with manholes, a walkway, a valve wheel."""
    r, n = m.number(1.1, 1.35), 12 if w.style == "low" else m.pick(24, 36)
    z, long = w.floor + r + 0.1, w.long - m.number(0.3, 0.6)
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    rows = [
        (-long, 0.45 * r),
        (-long + 0.12, 0.8 * r),
        (-long + 0.35, r),
        (long - 0.35, r),
        (long - 0.12, 0.8 * r),
        (long, 0.45 * r),
    ]
    m.add(BASE, loft(np.array([np.c_[q * np.cos(t), np.full(n, y), z + q * np.sin(t)] for y, q in rows])))
    for y in (-0.6 * long, 0.6 * long):
        m.add(
            BASE,
            cut(
                box((-0.9 * r, 0.9 * r), (y - 0.2, y + 0.2), (w.floor - 0.15, z - 0.5 * r)),
                rod((0, y - 1, z), (0, y + 1, z), 0.99 * r, n),
            ),
        )
    for k, y in enumerate(m.pick((0.0,), (-0.4 * long, 0.4 * long), (-0.5 * long, 0.0, 0.5 * long))):
        neck = z + r + 0.15
        m.add(BASE, rod((0, y, z + 0.9 * r), (0, y, neck), 0.3, 20))
        m.add(f"manhole_lid_{k}", rod((0, y, neck), (0, y, neck + 0.06), 0.34, 20))
        if w.style != "low":
            m.add(f"manhole_lid_{k}", box((-0.04, 0.04), (y - 0.4, y + 0.3), (neck + 0.05, neck + 0.09)))
        m.hinge(f"manhole_lid_{k}", (0, y + 0.36, neck + 0.02), (-1, 0, 0), m.number(90, 110))
    if m.chance(0.6):
        m.add(BASE, *(rod((x, long - 0.2, w.floor - 0.2), (x, long - 0.2, z + r), 0.02, 6) for x in (-0.2, 0.2)))
        m.add(BASE, *(rod((-0.2, long - 0.2, h), (0.2, long - 0.2, h), 0.015, 6) for h in np.arange(w.floor, z + r, 0.33)))
    if m.chance(0.6):
        c = vec(w.half - 0.1, 0.3, w.floor - 0.05)
        m.add(BASE, rod((0.4, 0.3, w.floor - 0.05), c, 0.05, 10))
        m.add(
            "valve_wheel",
            ring(c, (1, 0, 0), 0.14, 0.015, 16),
            rod(c - vec(0, 0.14, 0), c + vec(0, 0.14, 0), 0.012, 6),
            rod(c - vec(0.03, 0, 0), c + vec(0.03, 0, 0), 0.03, 10),
        )
        m.spin("valve_wheel", c, (1, 0, 0))


def hopper(m: Model, w: WagonSizes) -> None:
    """A bin with sloping ends; flaps below its sides, lids on its roof."""
    t, z0 = 0.05, w.floor
    ends = [(-w.long, w.top), (-0.5 * w.long, z0 + 0.3), (0.5 * w.long, z0 + 0.3), (w.long, w.top)]
    shell = prism(ends, "x", (-w.half, w.half))
    roofed = m.chance(0.6)
    shell = cut(
        shell,
        prism(
            [(y * (1 - t / 3), z + 2 * t if z < w.top else z + 0.3 * (not roofed) - t * roofed) for y, z in ends],
            "x",
            (-w.half + t, w.half - t),
        ),
    )
    m.add(BASE, shell, box((-0.6, 0.6), (-w.long, w.long), (z0 - 0.12, z0 - 0.05)))
    for e in (-1, 1):
        m.add(
            BASE,
            *(
                rod(
                    (s * 0.8 * w.half, e * (w.long - 0.15), z0 - 0.1),
                    (s * 0.8 * w.half, e * (w.long - 0.15), w.top - 0.1),
                    0.05,
                    8,
                )
                for s in (-1, 1)
            ),
        )
    m.add(
        BASE,
        prism([(-0.9, z0 + 0.32), (0.9, z0 + 0.32), (0.2, z0 - 0.08), (-0.2, z0 - 0.08)], "y", (-0.45 * w.long, 0.45 * w.long)),
    )
    count = m.pick(1, 2)
    wide = 0.9 * w.long / count
    for s, side in ((-1, "left"), (1, "right")):
        for k in range(count):
            y = -0.45 * w.long + k * wide
            part = f"discharge_flap_{side}_{k}"
            plate = [(s * 0.92, z0 + 0.33), (s * 0.22, z0 - 0.07), (s * 0.24, z0 - 0.12), (s * 0.96, z0 + 0.3)]
            m.add(part, prism(plate, "y", (y + 0.02, y + wide - 0.02)))
            m.hinge(part, (s * 0.94, y + wide / 2, z0 + 0.31), (0, -s, 0), m.number(35, 60))
    if roofed:
        _roof_lids(m, w)
    for y in np.linspace(-0.45, 0.45, m.pick(3, 5)) * w.long:
        m.add(
            BASE, *(box((s * (w.half - 0.01), s * (w.half + 0.06)), (y - 0.05, y + 0.05), (z0 + 0.35, w.top)) for s in (-1, 1))
        )


def _roof_lids(m: Model, w: WagonSizes) -> None:
    """Lids on frames along the roof."""
    lids = m.pick(2, 3, 4)
    for k in range(lids):
        y = -0.8 * w.long + (k + 0.5) * 1.6 * w.long / lids
        m.add(BASE, box((-0.5, 0.5), (y - 0.45, y + 0.45), (w.top - 0.01, w.top + 0.08)))
        m.add(f"roof_lid_{k}", box((-0.54, 0.54), (y - 0.48, y + 0.48), (w.top + 0.08, w.top + 0.12)))
        m.hinge(f"roof_lid_{k}", (0.54, y, w.top + 0.08), (0, 1, 0), m.number(90, 120))
