"""Coffee machines for pods."""

from __future__ import annotations

import numpy as np

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, cable, lathe
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import box, cut, prism, rod, rounded, tube


def _cup(m: Model, at: tuple[float, float], z: float) -> None:
    """A cup or a glass on the grid."""
    r, h = m.number(0.026, 0.036), m.number(0.05, 0.075)
    m.add(BASE, lathe([(0.75 * r, 0), (r, h), (0.92 * r, h), (0.68 * r, 0.006)], 16, (*at, z)))
    if m.chance(0.6):
        m.add(
            BASE,
            tube(
                [
                    (at[0] + 0.9 * r, at[1], z + 0.75 * h),
                    (at[0] + 1.5 * r, at[1], z + 0.7 * h),
                    (at[0] + 1.5 * r, at[1], z + 0.35 * h),
                    (at[0] + 0.8 * r, at[1], z + 0.3 * h),
                ],
                0.003,
                6,
            ),
        )


def _column(m: Model, half: float, deep: float, high: float, head: float, style: str) -> float:
    """The body: a column behind with a head that reaches over the cup; returns where the column begins in y."""
    y = 0.48 * deep
    if style == "round":
        r = half
        m.add(BASE, rod((0, deep - r, 0), (0, deep - r, high), r, 24))
        m.add(BASE, prism(rounded((-0.8 * half, 0.8 * half), (0.02, deep - r), 0.3 * half), "z", (high - head, high)))
        return deep - 2 * r + 0.25 * r
    outline = [(0.0, high - head), (0.0, high), (deep, high), (deep, 0.0), (y, 0.0), (y, high - head)]
    if style == "curved":
        t = np.linspace(0, np.pi / 2, 7)
        front = [(0.06 - 0.06 * np.cos(a), high - 0.06 + 0.06 * np.sin(a)) for a in t]
        outline = [
            (0.0, high - head),
            *front,
            (deep - 0.02, high),
            (deep, 0.5 * high),
            (deep - 0.015, 0.0),
            (y, 0.0),
            (y - 0.01, high - head),
        ]
    elif style == "slanted":
        outline = [
            (0.03, high - head),
            (0.0, high - 0.3 * head),
            (0.02, high),
            (deep, 0.9 * high),
            (deep, 0.0),
            (y + 0.02, 0.0),
            (y, high - head),
        ]
    m.add(BASE, prism(outline, "x", (-half, half)))
    return y


def pod_coffee_machine(m: Model) -> None:
    """A machine for pods: a lever over the top, a head that lifts, or a pod drawer; drip tray, water tank, its lid, buttons."""
    kind, style = m.pick("lever", "lever", "head", "drawer"), m.pick("box", "curved", "slanted", "round")
    half, deep, high = m.number(0.05, 0.085), m.number(0.22, 0.32), m.number(0.22, 0.31)
    head = m.number(0.09, 0.12)
    y = _column(m, half, deep, high, head, style)
    roof = 0.9 * high if style == "slanted" else high
    under, c = high - head, 0.42 * y
    tray_x, low = shrunk((-half, half), m.pick(0.0, 0.006, -0.01)), m.pick(0.02, 0.035, 0.05)
    m.add(BASE, box((-half, half), (0.03, y + 0.01), (0, 0.008)))
    m.add(
        "drip_tray",
        cut(box(tray_x, (0.0, y - 0.002), (0.009, low)), box(shrunk(tray_x, 0.004), (0.004, y - 0.006), (0.013, 1))),
    )
    m.add(
        "drip_tray",
        *(
            box((a, a + 0.004), (0.003, y - 0.004), (low - 0.006, low - 0.001))
            for a in np.linspace(tray_x[0] + 0.008, tray_x[1] - 0.012, 9)
        ),
    )
    m.slide("drip_tray", (0, -1, 0), 0.8 * y)
    m.add(BASE, rod((0, c, under - m.number(0.012, 0.03)), (0, c, under + 0.004), m.number(0.012, 0.02), 12))
    if m.chance(0.5):
        _cup(m, (0, c), low)
    if kind == "lever":
        _brew_lever(m, half, y, high, roof)
    elif kind == "head":
        _brew_head(m, half, y, high, style)
    else:
        z = (high - 0.7 * head, high - 0.3 * head)
        front = 0.02 if style in ("round", "slanted") else 0.0
        hole = box((-0.56 * half, 0.56 * half), (-1, front + 0.085), (z[0] - 0.001, z[1] + 0.001))
        m.pieces = [(p, cut(s, hole) if p == BASE and s.is_volume else s) for p, s in m.pieces]
        m.add("pod_drawer", box((-0.55 * half, 0.55 * half), (front - 0.016, front + 0.08), z))
        m.add("pod_drawer", box((-0.7 * half, 0.7 * half), (front - 0.022, front - 0.008), (z[0] - 0.004, z[1] + 0.004)))
        m.slide("pod_drawer", (0, -1, 0), 0.05)
    _tank(m, half, deep, high, style)
    for k in range(m.pick(1, 2, 3)):
        button(
            m,
            f"button_{k}",
            (-0.3 * half + 0.3 * half * k, 0.75 * deep, 0.925 * high if style == "slanted" else high),
            (0, 0, 1),
            0.012,
        )
    if m.chance(0.3):
        cable(m, (0.5 * half, deep, 0.03), 0.2)


def _brew_lever(m: Model, half: float, y: float, high: float, roof: float) -> None:
    """A handle that lies over the top and swings up to the rear: a bow at both sides or a flat lever."""
    pivot, z, reach = 0.9 * y + 0.02, high - 0.03, -m.pick(0.0, 0.012, 0.03)
    if m.chance(0.6):
        for s in (-1, 1):
            a = s * (half + 0.005)
            m.add("lever", box((a - 0.004, a + 0.004), (reach, pivot + 0.012), (z - 0.008, z + 0.01)))
            m.add("lever", rod((a - s * 0.006, pivot, z), (a + s * 0.006, pivot, z), 0.014, 16))
        m.add("lever", box((-half - 0.009, half + 0.009), (reach - 0.016, reach + 0.001), (z - 0.012, z + 0.014)))
        m.hinge("lever", (0, pivot, z), (-1, 0, 0), m.pick(60, 75, 90))
        return
    wide = m.number(0.4, 0.8) * half
    m.add("lever", box((-wide, wide), (reach - 0.01, pivot + 0.01), (high + 0.002, high + 0.016)))
    m.add(
        BASE,
        *(
            box((a - 0.005, a + 0.005), (pivot - 0.012, pivot + 0.012), (roof - 0.01, high + 0.02))
            for a in (-wide - 0.006, wide + 0.006)
        ),
    )
    m.hinge("lever", (0, pivot, high + 0.01), (-1, 0, 0), m.pick(70, 90, 110))


def _brew_head(m: Model, half: float, y: float, high: float, style: str) -> None:
    """A head on the top that lifts at its front with a handle across."""
    tall, r = m.number(0.035, 0.06), min(0.8 * half, 0.04)
    x, z, back = (-0.92 * half, 0.92 * half), (high + 0.001, high + 0.001 + tall), y + 0.02
    m.add(
        "head",
        prism(rounded(x, (0.012, back), r), "z", z)
        if m.chance(0.5)
        else prism([(0.01, z[0]), (back, z[0]), (back, z[1]), (0.05, z[1]), (0.01, z[0] + 0.5 * tall)], "x", x),
    )
    if m.chance(0.7):
        m.add(
            "head",
            tube(
                [
                    (x[0], 0.08, middle(z)),
                    (x[0] - 0.01, -0.01, middle(z)),
                    (x[1] + 0.01, -0.01, middle(z)),
                    (x[1], 0.08, middle(z)),
                ],
                0.006,
                8,
            ),
        )
    else:
        m.add("head", box((-0.4 * half, 0.4 * half), (-0.012, 0.025), (z[0] + 0.003, z[0] + 0.016)))
    m.hinge("head", (0, back, z[0]), (-1, 0, 0), m.pick(50, 65, 80))


def _tank(m: Model, half: float, deep: float, high: float, style: str) -> None:
    """A water tank behind or beside the body that lifts out, with a hinged or a lifted lid."""
    where, tall = m.pick("rear", "side", "rear"), m.number(0.65, 0.85) * high
    if where == "rear":
        x, y = shrunk((-half, half), 0.004), (deep + 0.001, deep + m.number(0.06, 0.09))
    else:
        s, a = m.pick(-1, 1), half + 0.001
        x, y = tuple(sorted((s * a, s * (a + m.number(0.05, 0.075))))), (0.45 * deep, deep)
    m.add(BASE, box(x, y, (0, 0.02)))
    if where == "side":
        m.add(BASE, box((-half, half), (0.5 * deep, deep), (0, 0.02)))
    shape = rounded(x, y, 0.015)
    m.add("tank", cut(prism(shape, "z", (0.021, tall)), prism(shape.buffer(-0.003), "z", (0.025, 1))))
    m.slide("tank", (0, 0, 1), m.pick(0.06, 0.1))
    lid = prism(shape, "z", (tall + 0.0005, tall + 0.012))
    m.add("tank_lid", lid)
    if where == "rear" and m.chance(0.6):
        m.hinge("tank_lid", (0, y[1], tall + 0.003), (-1, 0, 0), m.pick(80, 95), "tank")
    else:
        m.slide("tank_lid", (0, 0, 1), 0.05, "tank")
