"""Golf carts."""

from __future__ import annotations

from shapely.geometry import Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rod, rounded, tube, vec
from training.kinds.vehicles.vehicles import prisms
from training.kinds.wheels import axled, beam, lathe, upright, wheel_maker


def _cart_seat(m: Model, y: float, half: float, way: int = 1) -> None:
    """A bench on its box with a back on posts; way: 1 looks to the front."""
    thick = m.number(0.07, 0.12)
    m.add(BASE, box((-half, half), (y, y + way * 0.42), (0.34, 0.6)))
    m.add(BASE, prism(rounded((-half, half), tuple(sorted((y - way * 0.05, y + way * 0.43))), 0.05), "z", (0.6, 0.6 + thick)))
    spans = m.pick(((-half, half),), ((-half, -0.03), (0.03, half)))
    for a, b in spans:
        m.add(BASE, prism(rounded((a, b), (0.78, 1.12), 0.06), "y", tuple(sorted((y + way * 0.44, y + way * 0.52)))))
    m.add(
        BASE, *(rod((s * 0.6 * half, y + way * 0.48, 0.55), (s * 0.6 * half, y + way * 0.48, 0.85), 0.02, 8) for s in (-1, 1))
    )
    if m.chance(0.7):
        for s in (-1, 1):
            m.add(
                BASE,
                tube(
                    [(s * half, y + way * 0.1, 0.6), (s * half, y + way * 0.1, 0.82), (s * half, y + way * 0.48, 0.82)],
                    0.015,
                    6,
                ),
            )


def _cart_rear(m: Model, y: float, end: float, half: float) -> None:
    """Behind the seats: bags on a rack, a seat to the rear whose cushion flips over, or a bed that tips."""
    style = m.pick("bags", "flip", "bed")
    if style == "bags":
        m.add(BASE, box((-0.8 * half, 0.8 * half), (end - 0.42, end - 0.05), (0.5, 0.54)))
        m.add(
            BASE,
            tube(
                [
                    (-0.8 * half, end - 0.4, 1.0),
                    (-0.8 * half, end - 0.02, 0.98),
                    (0.8 * half, end - 0.02, 0.98),
                    (0.8 * half, end - 0.4, 1.0),
                ],
                0.015,
                6,
            ),
        )
        for x in m.pick((-0.25, 0.25), (0.25,), (-0.25,)):
            foot, top = vec(x, end - 0.22, 0.54), vec(x, end - 0.15, 1.25)
            m.add(BASE, rod(foot, top, 0.13, 14))
            for a in m.rng.uniform(-0.07, 0.07, (4, 2)):
                tip = top + vec(*a, m.number(0.12, 0.25))
                m.add(BASE, rod(top + vec(*a, -0.02), tip, 0.008, 5), ball(tip, (0.03, 0.045, 0.025), 6))
    elif style == "flip":
        m.add(BASE, box((-half + 0.05, half - 0.05), (end - 0.55, end - 0.1), (0.45, 0.6)))
        m.add(BASE, prism(rounded((-half + 0.05, half - 0.05), (0.76, 1.1), 0.05), "y", (end - 0.66, end - 0.58)))
        m.add("flip_seat", prism(rounded((-half + 0.05, half - 0.05), (end - 0.54, end - 0.1), 0.05), "z", (0.61, 0.7)))
        m.add("flip_seat", box((-half + 0.05, half - 0.05), (end - 0.54, end - 0.1), (0.603, 0.615)))
        m.hinge("flip_seat", (0, end - 0.09, 0.6), (-1, 0, 0), 170)
        m.add(BASE, box((-half + 0.1, half - 0.1), (end - 0.1, end + 0.3), (0.28, 0.31)))
        m.add(
            BASE, *(rod((s * (half - 0.12), end + 0.28, 0.3), (s * (half - 0.12), end + 0.28, 0.5), 0.015, 6) for s in (-1, 1))
        )
        m.add(BASE, rod((-half + 0.12, end + 0.28, 0.5), (half - 0.12, end + 0.28, 0.5), 0.018, 8))
    else:
        a, b, z, tall = y + 0.12, end + 0.25, 0.62, m.number(0.2, 0.32)
        m.add("bed", box((-half, half), (a, b), (z, z + 0.03)), box((-half, half), (a, a + 0.03), (z, z + tall)))
        m.add("bed", *(box((s * half, s * (half - 0.03)), (a, b), (z, z + tall)) for s in (-1, 1)))
        m.hinge("bed", (0, b - 0.15, z), (-1, 0, 0), m.number(40, 50))
        m.add(
            "tailgate",
            box((-half + 0.035, half - 0.035), (b - 0.03, b), (z + 0.035, z + tall)),
            box((-0.06, 0.06), (b, b + 0.02), (z + tall - 0.07, z + tall - 0.03)),
        )
        m.hinge("tailgate", (0, b, z + 0.03), (-1, 0, 0), m.pick(90, 110), "bed")


def _cart_front(m: Model, half: float, arch: Polygon) -> None:
    """Cowl, dashboard, steering wheel, pedals, lamps."""
    nose, deck = m.number(-0.1, 0.05), m.number(0.72, 0.84)
    cowl = [(nose, 0.3), (nose, 0.5), (nose + 0.14, deck - 0.08), (0.5, deck + 0.06), (0.64, deck + 0.06), (0.6, 0.3)]
    m.add(BASE, *prisms(Polygon(cowl).difference(arch), "x", (-half, half)))
    m.add(BASE, box((-half + 0.05, half - 0.05), (0.58, 0.7), (deck - 0.1, deck + 0.1)))
    for s in (-1, 1):
        m.add(
            BASE,
            m.pick(
                ball((s * 0.7 * half, nose + 0.04, 0.55), (0.1, 0.07, 0.07), 10),
                box((s * 0.5 * half, s * 0.9 * half), (nose - 0.015, nose), (0.42, 0.5)),
            ),
        )
    m.add(BASE, box((-half - 0.02, half + 0.02), (nose - 0.08, nose), (0.26, 0.36)))
    at, way = vec(-0.45 * half, 0.86, deck + 0.2), vec(0, 0.62, 0.78)
    rim = lathe([(0.15, -0.013), (0.175, -0.013), (0.175, 0.013), (0.15, 0.013), (0.15, -0.013)], 18)
    m.add(
        "steering",
        *upright(
            [rim, box((-0.155, 0.155), (-0.015, 0.015), (-0.01, 0.01)), rod((0, 0, -0.28), (0, 0, 0.01), 0.022, 8)], way, at
        ),
    )
    if m.chance(0.5):
        m.add("steering", *upright([box((-0.015, 0.015), (-0.155, 0), (-0.01, 0.01))], way, at))
    m.spin("steering", at, way)
    m.add(BASE, *(beam((x * half, 0.66, 0.42), (x * half, 0.72, 0.55), 0.07, 0.015) for x in (-0.55, -0.25)))


def golf_cart(m: Model) -> None:
    """Make a golf cart: one or two rows, bags, a rear seat that flips or a bed that tips; roof, folding windscreen."""
    half, r, rows = m.number(0.55, 0.64), m.number(0.2, 0.25), m.pick(1, 1, 2)
    seats = [1.2 + 0.85 * k for k in range(rows)]
    back, end = seats[-1] + 0.55, seats[-1] + 1.25
    axles = (0.3, end - 0.5)
    front, rear = (Point(y, r).buffer(1.25 * r, quad_segs=6) for y in axles)
    m.add(BASE, box((-half + 0.06, half - 0.06), (0.5, end - 0.5 - 1.3 * r), (0.26, 0.34)))
    tail = Polygon([(seats[-1] + 0.05, 0.3), (seats[-1] + 0.05, 0.58), (end - 0.55, 0.58), (end, 0.45), (end, 0.28)])
    m.add(BASE, *prisms(tail.difference(rear), "x", (-half, half)))
    _cart_front(m, half, front)
    for y in seats:
        _cart_seat(m, y, half - 0.06)
    _cart_rear(m, back, end, half - 0.04)
    make = wheel_maker(m, ("tyre", "rim", "lathed", "disc"), 0.3)
    for name, y in zip(("front", "rear"), axles, strict=True):
        axled(m, make, (-half + 0.0, half - 0.0), y, r, 0.17, name)
    if m.chance(0.85):
        top, x, last = m.number(1.8, 1.95), half - 0.05, back + m.pick(0.0, 0.05)
        for s in (-1, 1):
            m.add(
                BASE,
                rod((s * x, 0.62, 0.85), (s * x, 0.72, top), 0.02, 8),
                rod((s * x, last, 0.5), (s * x, last + 0.03, top), 0.02, 8),
            )
        m.add(BASE, prism(rounded((-half, half), (0.45, last + 0.25), 0.12), "z", (top, top + m.pick(0.04, 0.09))))
        if m.chance(0.7):
            middle, y = 0.5 * (top + 0.9), 0.62
            screen = box((-x + 0.03, x - 0.03), (y - 0.008, y), (middle + 0.004, top - 0.02))
            m.add(BASE, box((-x + 0.03, x - 0.03), (y - 0.008, y), (0.86, middle - 0.004)))
            m.add(
                "windscreen",
                screen,
                *(box((s * 0.4 - 0.05, s * 0.4 + 0.05), (y - 0.02, y), (middle + 0.004, middle + 0.03)) for s in (-1, 1)),
            )
            m.hinge("windscreen", (0, y - 0.012, middle), (1, 0, 0), m.pick(150, 165))
