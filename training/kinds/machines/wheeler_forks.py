"""Fork trucks, as one artist models them: a mast that tilts, stages and a carriage that rise, forks, a seat lid."""

from __future__ import annotations

from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rectangle, rod, tube, vec
from training.kinds.wheeler_gear import axle, seat, steering, tyre_look, wheel
from training.kinds.wheeler_style import STYLES, softened


def fork_truck(m: Model) -> None:
    """A counterweight truck, or a reach truck with outriggers; the load is at -y."""
    style = m.pick(*STYLES)
    half, base = m.number(0.48, 0.62), m.number(1.3, 1.7)
    fore, rear = m.number(0.28, 0.36), m.number(0.2, 0.27)
    deck, top = m.number(0.42, 0.55), m.number(1.95, 2.2)
    back = base + rear + m.number(0.15, 0.35)
    soft = 0.0 if style in ("low", "sheet") else m.number(0.03, 0.1)
    look = tyre_look(m, style)
    if m.chance(0.25):
        _outriggers(m, look, half)
    else:
        axle(m, look, "front", 0.0, half + 0.02, (fore, 0.22))
    if m.chance(0.25):
        wheel(m, look, "wheel_rear", (0, base, rear), 1, (rear, 0.2))
        m.add(BASE, *(box((s * 0.12, s * 0.16), (base - 0.06, base + 0.06), (rear - 0.04, deck)) for s in (-1, 1)))
        m.add(BASE, *(rod((0, base, rear), (s * 0.15, base, rear), 0.03, 8) for s in (-1, 1)))
    else:
        axle(m, look, "rear", base, half - 0.1, (rear, 0.17))
    m.add(BASE, prism(rectangle((-0.05, back - 0.1), (0.18, deck - 0.08)), "x", (-0.6 * half, 0.6 * half)))
    room = (0.5, base - 0.35)
    m.add(BASE, prism(softened([(0.12, deck - 0.1), (back, deck - 0.1), (back, deck), (0.12, deck)], 0), "x", (-half, half)))
    heavy = [
        (base - 0.1, deck - 0.01),
        (back, deck - 0.01),
        (back + 0.04, deck + 0.35),
        (back - 0.1, deck + 0.5),
        (base - 0.1, deck + 0.52),
    ]
    m.add(BASE, prism(softened(heavy, soft), "x", (-half, half)))
    m.add(
        BASE,
        prism(
            [(0.14, deck - 0.01), (0.3, deck - 0.01), (0.42, deck + 0.5), (0.3, deck + 0.55), (0.14, deck + 0.3)],
            "x",
            (-0.8 * half, 0.8 * half),
        ),
    )
    _seat_box(m, style, half, base, deck, soft)
    steering(m, (0, room[0] + 0.08, deck + 0.62), 55, 0.16)
    for k in range(m.pick(0, 2, 3)):
        part, x = f"lever_{k}", 0.14 + 0.07 * k
        a = vec(x, 0.38, deck + 0.48)
        m.add(part, rod(a, a + vec(0, 0.03, 0.17), 0.007, 6), rod(a + vec(0, 0.028, 0.15), a + vec(0, 0.034, 0.19), 0.016, 8))
        m.hinge(part, a, (1, 0, 0), (-15, 15))
    if m.chance(0.85):
        _guard(m, style, half, base, deck, top)
    _mast(m, style, half, deck, top - m.number(0.0, 0.15))


def _seat_box(m: Model, style: str, half: float, base: float, deck: float, soft: float) -> None:
    """The box below the seat; its lid swings back with the seat."""
    y0, y1 = base - 0.75, base - 0.11
    shell = prism(softened(rectangle((-0.75 * half, 0.75 * half), (y0, y1)), soft), "z", (deck - 0.01, deck + 0.32))
    lid = prism(softened(rectangle((-0.75 * half, 0.75 * half), (y0, y1)), soft), "z", (deck + 0.32, deck + 0.37))
    part = "seat_lid" if m.chance(0.6) else BASE
    if part != BASE and m.chance(0.6):
        shell = cut(shell, box((-0.7 * half, 0.7 * half), (y0 + 0.03, y1 - 0.03), (deck + 0.04, deck + 1)))
    m.add(BASE, shell)
    m.add(part, lid)
    seat(m, style, (0, base - 0.45, deck + 0.2), part=part)
    if part != BASE:
        back = m.chance(0.5)
        y, degrees = (y1, m.number(20, 30)) if back else (y0, m.number(40, 60))
        m.hinge(part, (0, y, deck + 0.32), (-1 if back else 1, 0, 0), degrees)


def _guard(m: Model, style: str, half: float, base: float, deck: float, top: float) -> None:
    """The overhead guard: posts and bars."""
    w, thick = half - 0.04, 0.035
    y0, y1 = 0.3, base - 0.02
    for s in (-1, 1):
        if style in ("low", "sheet"):
            for y in (y0, y1):
                m.add(BASE, box((s * (w - 0.03), s * (w + 0.03)), (y - 0.03, y + 0.03), (deck - 0.02, top)))
        else:
            path = [
                (s * w, y0 - 0.12, deck - 0.02),
                (s * w, y0 + 0.1, top - 0.03),
                (s * w, y1 - 0.05, top - 0.03),
                (s * w, y1, deck + 0.2),
            ]
            m.add(BASE, tube(path, thick, 8))
    m.add(BASE, prism(rectangle((-w - 0.03, w + 0.03), (y0, y1), 0.05), "z", (top - 0.05, top)))
    for k in range(m.pick(3, 5, 7)):
        x = -0.75 * w + 1.5 * w * k / 6
        m.add(BASE, box((x - 0.015, x + 0.015), (y0 + 0.04, y1 - 0.04), (top - 0.04, top)))
    if m.chance(0.5):
        m.add(BASE, rod((0.6 * w, y1 - 0.03, top - 0.02), (0.6 * w, y1 - 0.03, top + 0.12), 0.05, 12))


def _outriggers(m: Model, look: dict, half: float) -> None:
    for s, side in ((-1, "left"), (1, "right")):
        x = s * (half + 0.06)
        m.add(BASE, box((x - 0.06, x + 0.06), (-0.9, 0.2), (0.2, 0.32)), box((x - s * 0.3, x), (0.05, 0.2), (0.2, 0.4)))
        m.add(BASE, rod((x - 0.06, -0.8, 0.12), (x + 0.06, -0.8, 0.12), 0.02, 8))
        m.add(BASE, *(box((x + d, x + d + 0.02), (-0.84, -0.76), (0.09, 0.22)) for d in (-0.06, 0.04)))
        wheel(m, look | {"way": "disc"}, f"wheel_front_{side}", (x, -0.8, 0.12), s, (0.12, 0.07))


def _mast(m: Model, style: str, half: float, deck: float, top: float) -> None:
    """Outer rails that tilt, an inner stage, a carriage with its rest and two forks."""
    w, y = 0.62 * half, -0.38
    tilts = m.chance(0.7)
    outer = "mast" if tilts else BASE
    for s in (-1, 1):
        m.add(outer, box((s * w, s * (w + 0.05)), (y, y + 0.13), (0.1, top)))
    m.add(outer, box((-w, w), (y + 0.09, y + 0.13), (top - 0.16, top - 0.06)), box((-w, w), (y + 0.08, y + 0.13), (0.16, 0.28)))
    m.add(BASE, *(box((s * 0.3 * half, s * 0.5 * half), (y + 0.12, 0.0), (0.2, 0.32)) for s in (-1, 1)))
    if tilts:
        m.hinge("mast", (0, y + 0.12, 0.24), (-1, 0, 0), (-4, 8))
    stage = outer
    if m.chance(0.65):
        stage = "inner_mast"
        for s in (-1, 1):
            m.add(stage, box((s * (w - 0.045), s * (w - 0.003)), (y + 0.005, y + 0.075), (0.12, top - 0.02)))
        m.add(
            stage,
            box((-w + 0.045, w - 0.045), (y + 0.045, y + 0.075), (top - 0.12, top - 0.03)),
            box((-w + 0.045, w - 0.045), (y + 0.045, y + 0.075), (0.3, 0.38)),
        )
        m.slide(stage, (0, 0, 1), 0.55 * top, outer)
    for x in m.pick((0.0,), (-0.25 * half, 0.25 * half)):
        m.add(outer, rod((x, y + 0.1, 0.2), (x, y + 0.1, top - 0.2), 0.018 if style == "cad" else 0.028, 10))
    z = m.number(0.12, 0.5)
    wide = min(half, w + 0.25)
    m.add(
        "carriage",
        box((-wide, wide), (y - 0.045, y - 0.003), (z + 0.02, z + 0.1)),
        box((-wide, wide), (y - 0.045, y - 0.003), (z + 0.38, z + 0.46)),
    )
    m.add("carriage", *(box((s * (w - 0.08), s * (w - 0.046)), (y - 0.01, y + 0.06), (z, z + 0.48)) for s in (-1, 1)))
    if m.chance(0.7):
        rest = z + m.number(0.8, 1.1)
        bars = [x * wide for x in (-0.96, -0.5, 0, 0.5, 0.96)]
        m.add("carriage", *(box((x - 0.015, x + 0.015), (y - 0.04, y - 0.01), (z + 0.45, rest)) for x in bars))
        m.add("carriage", box((-wide, wide), (y - 0.04, y - 0.01), (rest, rest + 0.03)))
    m.slide("carriage", (0, 0, 1), 0.6 * (top - z), stage)
    _forks(m, y, z, wide)


def _forks(m: Model, y: float, z: float, wide: float) -> None:
    """Two forks that shift along the carriage, or are one with it."""
    apart, own = m.number(0.18, 0.3), m.chance(0.5)
    long = m.number(0.85, 1.15)
    for s, side in ((-1, "left"), (1, "right")):
        part = f"fork_{side}" if own else "carriage"
        a, b = s * (apart - 0.055), s * (apart + 0.055)
        fork = [
            (y - 0.045, z + 0.5),
            (y - 0.085, z + 0.5),
            (y - 0.085, z),
            (y - 0.09 - long, z - 0.045),
            (y - 0.09 - long, z - 0.055),
            (y - 0.045, z - 0.055),
        ]
        m.add(part, prism(fork, "x", (a, b)))
        if own:
            m.slide(part, (s, 0, 0), (-0.08, wide - apart - 0.06), "carriage")
