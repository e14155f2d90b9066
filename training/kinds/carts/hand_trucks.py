"""Hand trucks: upright carts on two wheels with a toe plate."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, rod, rounded, tube, vec
from training.kinds.wheels import beam, wheel_maker


def _frame(m: Model, half: float, tall: float, tubes: float) -> None:
    """Two uprights joined by bars, straps or a curved back."""
    n = m.pick(6, 8, 12)
    square = m.chance(0.3)
    for s in (-1, 1):
        a, b = (s * half, 0, 0.03), (s * half, 0, tall)
        m.add(BASE, beam(a, b, 2 * tubes, 2 * tubes) if square else rod(a, b, tubes, n))
    style = m.pick("bars", "bowed", "slats", "plate")
    levels = np.linspace(0.14, tall - m.number(0.15, 0.35), m.pick(3, 4, 5))
    for z in levels if style in ("bars", "bowed") else ():
        dip = 0.06 if style == "bowed" else 0.0
        m.add(BASE, tube([(-half, 0, z), (-0.5 * half, dip, z), (0.5 * half, dip, z), (half, 0, z)], 0.8 * tubes, 6))
    if style == "slats":
        m.add(
            BASE,
            *(
                box((x - 0.015, x + 0.015), (-tubes, 0), (0.05, tall - 0.1))
                for x in np.linspace(-0.5, 0.5, m.pick(1, 2, 3)) * half
            ),
        )
        m.add(BASE, *(rod((-half, 0, z), (half, 0, z), 0.8 * tubes, n) for z in (0.1, tall - 0.1)))
    elif style == "plate":
        m.add(BASE, prism(rounded((-half, half), (0.1, 0.45 * tall), 0.05), "y", (-0.004, 0.004)))
        m.add(BASE, *(rod((-half, 0, z), (half, 0, z), 0.8 * tubes, n) for z in (0.6 * tall, tall - 0.06)))


def _grips(m: Model, half: float, tall: float, tubes: float) -> None:
    """Handles: a loop that may run out of the uprights, two grips to the rear, one loop in the middle."""
    style = m.pick("telescope", "telescope", "grips", "loop", "pin")
    if style == "telescope":
        high, r, back = m.number(0.1, 0.25), 0.7 * tubes, m.pick(0.0, 0.08)
        path = [(-half, 0, 0.45 * tall), (-half, 0, tall + 0.5 * high), (-half + 0.02, back, tall + high)]
        path += [(-x, y, z) for x, y, z in path[::-1]]
        m.add("handle", tube(path, r, 8))
        if m.chance(0.6):
            m.add("handle", rod((-0.5 * half, back, tall + high), (0.5 * half, back, tall + high), 1.6 * r, 10))
        m.add(BASE, *(rod((s * half, 0, tall - 0.05), (s * half, 0, tall + 0.015), 1.5 * tubes, 10) for s in (-1, 1)))
        m.slide("handle", (0, 0, 1), m.number(0.35, 0.45) * tall)
    elif style == "loop":
        m.add(BASE, tube([(-half, 0, tall), (-half, 0.03, tall + 0.06), (half, 0.03, tall + 0.06), (half, 0, tall)], tubes, 8))
        if m.chance(0.5):
            m.add(BASE, rod((-0.6 * half, 0.03, tall + 0.06), (0.6 * half, 0.03, tall + 0.06), 1.4 * tubes, 10))
    elif style == "grips":
        for s in (-1, 1):
            bend = vec(s * half, 0.1, tall + 0.06)
            m.add(
                BASE,
                tube([(s * half, 0, tall), bend, bend + vec(0, 0.12, 0.02)], tubes, 8),
                rod(bend, bend + vec(0, 0.14, 0.023), 1.35 * tubes, 10),
            )
        m.add(BASE, rod((-half, 0, tall - 0.02), (half, 0, tall - 0.02), 0.8 * tubes, 8))
    else:
        m.add(BASE, rod((-half, 0, tall), (half, 0, tall), tubes, 8))
        m.add(
            BASE,
            tube([(-0.07, 0, tall), (-0.07, 0.08, tall + 0.16), (0.07, 0.08, tall + 0.16), (0.07, 0, tall)], 0.8 * tubes, 8),
        )


def _toe(m: Model, half: float, tubes: float) -> None:
    """The plate that loads stand on: hinged to fold up, drawn down or folded; a fixed one may carry a flap that turns out."""
    wide, deep, thick = half * m.number(0.9, 1.3), m.number(0.18, 0.32), m.pick(0.006, 0.012, 0.02)
    front, style = -tubes - 0.004, m.pick("fold", "fold", "folded", "flap")
    taper = m.pick(0.0, 0.15) * wide
    plate = Polygon([(-wide, front), (wide, front), (wide - taper, front - deep), (-wide + taper, front - deep)])
    if m.chance(0.35):
        plate = plate.difference(rectangle((-0.5 * wide, 0.5 * wide), (front - 0.75 * deep, front - 0.3 * deep)))
    if style == "flap":
        m.add(BASE, prism(plate, "z", (0.002, 0.002 + thick)), box((-wide, wide), (front, front + 0.012), (0.002, 0.14)))
        x, edge = 0.85 * (wide - taper), front - deep
        m.add("flap", box((-x, x), (edge + 0.01, edge + 0.9 * deep), (0.006 + thick, 0.012 + thick)))
        m.add(
            "flap",
            *(rod((c * x - 0.03, edge, 0.005 + thick), (c * x + 0.03, edge, 0.005 + thick), 0.006, 8) for c in (-0.7, 0.7)),
        )
        m.hinge("flap", (0, edge, 0.005 + thick), (1, 0, 0), 180)
        return
    pivot = vec(0, front, 0.012 + thick)
    low = pivot[2] - thick / 2
    m.add(BASE, *(box((s * half - 0.02, s * half + 0.02), (front, tubes), (0.004, 0.07)) for s in (-1, 1)))
    m.add(
        "toe_plate", *(rod((s * 0.6 * half - 0.05, *pivot[1:]), (s * 0.6 * half + 0.05, *pivot[1:]), 0.01, 8) for s in (-1, 1))
    )
    m.add(BASE, rod((-half, *pivot[1:]), (half, *pivot[1:]), 0.006, 8))
    if style == "fold":
        m.add("toe_plate", prism(plate, "z", (low, low + thick)))
        m.add(
            "toe_plate",
            *(box((c * wide - 0.012, c * wide + 0.012), (front - 0.8 * deep, front), (low - 0.005, low)) for c in (-0.4, 0.4)),
        )
        m.hinge("toe_plate", pivot, (-1, 0, 0), 88)
    else:
        upright = Polygon(
            [(x, pivot[2] - (y - front)) for x, y in plate.exterior.coords],
            [[(x, pivot[2] - (y - front)) for x, y in h.coords] for h in plate.interiors],
        )
        m.add("toe_plate", prism(upright, "y", (front - thick / 2, front + thick / 2)))
        m.hinge("toe_plate", pivot, (1, 0, 0), 90)


def _rolling(m: Model, half: float, tubes: float) -> None:
    """Wheels behind the frame: one a side, or three a side on stars that turn, with struts and an axle."""
    stair, r = m.chance(0.25), m.number(0.08, 0.15)
    make, wide = wheel_maker(m, ("tyre", "rim", "lathed", "disc"), 0.2), m.number(0.03, 0.06)
    if stair:
        r = m.number(0.055, 0.075)
    reach = 1.3 * r if stair else 0.0
    out = half + tubes + wide * 0.6 + 0.015
    y, z = tubes + (r + reach if stair else r * m.pick(0.2, 1.05)) + 0.01, 0.5 * reach + r
    if not stair and y < r:
        out += 0.01
    x = out + (0.03 if stair else 0.0)
    m.add(BASE, rod((-x, y, z), (x, y, z), 0.011, 8))
    for s in (-1, 1):
        m.add(
            BASE,
            beam((s * half, 0, z + 0.01), (s * half, y + 0.01, z), 0.012, 0.05),
            beam((s * half, 0, z + 0.3), (s * half, y, z), 0.012, 0.03),
        )
        if not stair:
            make(f"wheel_{'lr'[s > 0]}", (s * out, y, z), (s, 0, 0), r, wide)
            continue
        star, hub = f"star_{'lr'[s > 0]}", vec(s * (half + tubes + 0.012), y, z)
        m.add(star, rod(hub - vec(0.012, 0, 0), hub + vec(0.012, 0, 0), 0.03, 12))
        m.spin(star, hub, (s, 0, 0))
        for k, t in enumerate(np.deg2rad([210, 330, 90])):
            end = hub + reach * vec(0, np.cos(t), np.sin(t))
            m.add(star, beam(hub, end, 0.01, 0.035), rod(end, end + vec(s * 0.02, 0, 0), 0.01, 8))
            make(f"{star}_wheel_{k}", end + vec(s * (0.012 + wide / 2), 0, 0), (s, 0, 0), r, wide, star)


def hand_truck(m: Model) -> None:
    """Make a hand truck: wheels or stair stars, toe plate that folds or a flap on it, handle that runs out or fixed grips."""
    half, tall, tubes = m.number(0.14, 0.24), m.number(0.8, 1.25), m.number(0.011, 0.017)
    _frame(m, half, tall, tubes)
    _grips(m, half, tall, tubes)
    _toe(m, half, tubes)
    _rolling(m, half, tubes)
    if m.chance(0.4):
        m.add(BASE, box((-half, half), (-tubes - 0.003, 0), (0.6 * tall, 0.6 * tall + 0.06)))
