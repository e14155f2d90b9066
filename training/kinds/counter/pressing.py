"""Sandwich presses and contact grills."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import cable, dial
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, cut, prism, rod, rounded, tube


def _grill_plate(m: Model, part: str, x: Span, y: Span, z: float, up: int, style: str) -> None:
    """A heating plate at z: flat, ribbed, or with raised edges that cut triangles."""
    t = 0.005
    m.add(part, box(x, y, (z - up * 0.006, z)))
    if style == "ribbed":
        count = m.pick(8, 12)
        for a in np.linspace(x[0] + 0.01, x[1] - 0.015, count):
            m.add(part, box((a, a + 0.005), shrunk(y, 0.008), (z, z + up * 0.6 * t)))
    elif style == "triangles":
        m.add(part, prism(Polygon(rounded(x, y, 0.01).exterior.coords, [shrunk_ring(x, y, 0.008)]), "z", (z, z + up * t)))
        a, b = middle(x), middle(y)
        m.add(part, box((a - 0.004, a + 0.004), y, (z, z + up * t)), box(x, (b - 0.002, b + 0.002), (z, z + up * 0.8 * t)))


def shrunk_ring(x: Span, y: Span, by: float) -> list[tuple[float, float]]:
    """The corners of a rectangle within another."""
    return [(x[0] + by, y[0] + by), (x[1] - by, y[0] + by), (x[1] - by, y[1] - by), (x[0] + by, y[1] - by)]


def _shell(m: Model, part: str, x: Span, y: Span, z: Span, style: str, up: int) -> None:
    """A half of a press with a recess for its plate: box, round, stepped or tapered; up: which way it bulges."""
    face, end = (z[0], z[1]) if up > 0 else (z[1], z[0])
    recess = box(shrunk(x, 0.02), shrunk(y, 0.03), (face - up * 0.01, face + up * 0.009))
    if style == "box":
        m.add(part, cut(box(x, y, z), recess))
    elif style == "round":
        m.add(part, cut(prism(rounded(x, y, 0.2 * (y[1] - y[0])), "z", z), recess))
    elif style == "steps":
        m.add(part, cut(prism(rounded(x, y, 0.03), "z", (face, face + 0.6 * (end - face))), recess))
        m.add(part, prism(rounded(shrunk(x, 0.012), shrunk(y, 0.012), 0.03), "z", (face + 0.6 * (end - face), end)))
    else:
        c = 0.15 * (y[1] - y[0])
        m.add(part, cut(prism([(y[0], face), (y[1], face), (y[1] - 0.3 * c, end), (y[0] + c, end)], "x", x), recess))


def _press_handle(m: Model, part: str, x: Span, y: float, z: Span, style: str) -> None:
    """What a press is opened by: a lip, a bow across the front, side arms with a bar, or a knob."""
    c, h = middle(x), middle(z)
    if style == "lip":
        m.add(
            part,
            prism(
                rounded((c - 0.05, c + 0.05), (y - 0.035, y + 0.01), 0.01),
                "z",
                (h - 0.3 * (z[1] - z[0]), h + 0.2 * (z[1] - z[0])),
            ),
        )
    elif style == "bow":
        m.add(
            part,
            tube(
                [(c - 0.07, y + 0.004, h), (c - 0.065, y - 0.04, h), (c + 0.065, y - 0.04, h), (c + 0.07, y + 0.004, h)],
                0.008,
                8,
            ),
        )
    elif style == "arms":
        a, b = x[0] - 0.008, x[1] + 0.008
        m.add(
            part,
            *(
                prism(
                    [(y + 0.12, h - 0.01), (y + 0.12, h + 0.012), (y - 0.035, z[1] + 0.02), (y - 0.035, z[1])],
                    "x",
                    (e - 0.007, e + 0.007),
                )
                for e in (a, b)
            ),
        )
        m.add(part, rod((a, y - 0.03, z[1] + 0.01), (b, y - 0.03, z[1] + 0.01), 0.011, m.sections()))
    else:
        m.add(part, rod((c, y - 0.02, h), (c, y + 0.004, h), 0.006, 8), ball((c, y - 0.022, h), (0.014,) * 3, 12))


def sandwich_press(m: Model) -> None:
    """Two hot halves hinged at the rear: sandwich toaster, panini press with a bow, contact grill with a drip tray."""
    kind = m.pick("toaster", "toaster", "panini", "grill", "single")
    wide = {"single": m.number(0.14, 0.17), "toaster": m.number(0.22, 0.28)}.get(kind, m.number(0.28, 0.42))
    deep, low = m.number(0.17, 0.24) if kind != "grill" else m.number(0.26, 0.34), m.number(0.012, 0.025)
    x, y, style = (-wide / 2, wide / 2), (0.0, deep), m.pick("box", "round", "steps", "taper")
    seam, high = low + m.number(0.04, 0.07), m.number(0.035, 0.06)
    plate = m.pick("ribbed", "ribbed", "flat") if kind in ("panini", "grill") else m.pick("triangles", "triangles", "ribbed")
    inset, gap = (shrunk(x, 0.02), shrunk(y, 0.03)), m.pick(0.001, 0.004, 0.01)
    top = (seam + gap, seam + gap + high)
    _shell(m, BASE, x, y, (low, seam), style, -1)
    _shell(m, "lid", x, y, top, style, 1)
    _grill_plate(m, BASE, *inset, seam - 0.006, 1, plate)
    _grill_plate(m, "lid", *inset, top[0] + 0.006, -1, plate)
    m.add(BASE, *(rod((a, b, 0), (a, b, low + 0.004), 0.012, 10) for a in shrunk(x, 0.035) for b in shrunk(y, 0.04)))
    handle = m.pick("lip", "bow", "knob") if kind in ("toaster", "single") else m.pick("arms", "arms", "bow")
    _press_handle(m, "lid", x, y[0], top, handle)
    if handle in ("lip", "bow") and m.chance(0.5):
        _press_handle(m, BASE, x, y[0], (low + 0.01, seam - 0.004), "lip")
    back = deep + m.pick(0.0, 0.006)
    for a in (x[0] + 0.25 * wide, x[1] - 0.25 * wide) if m.chance(0.7) else (0.0,):
        half = 0.08 * wide if m.chance(0.5) else 0.12 * wide
        m.add(BASE, box((a - half, a + half), (deep - 0.004, back + 0.003), (low + 0.01, seam + 0.5 * gap - 0.003)))
        m.add(
            m.pick("lid", BASE),
            rod((a - half, back + 0.004, seam + gap / 2), (a + half, back + 0.004, seam + gap / 2), 0.007, 10),
        )
    m.hinge(
        "lid", (0, back + 0.004, seam + gap / 2), (-1, 0, 0), m.pick(75, 90, 100) if kind != "grill" else m.pick(85, 95, 175)
    )
    _press_details(m, kind, x, y, low, seam, top)


def _press_details(m: Model, kind: str, x: Span, y: Span, low: float, seam: float, top: Span) -> None:
    """Lamps, a latch, a thermostat, a drip tray, a logo, a cable."""
    c, h = 0.5 * x[1], middle(top)
    if m.chance(0.7):
        m.add(
            "lid",
            *(
                rod((a, middle(y) - 0.2 * y[1], top[1] - 0.002), (a, middle(y) - 0.2 * y[1], top[1] + 0.003), 0.007, 10)
                for a in m.pick((-0.02, 0.02), (0.0,))
            ),
        )
    if kind in ("toaster", "single") and m.chance(0.5):
        m.add("latch", box((c + 0.005, c + 0.03), (-0.012, -0.003), (seam - 0.012, h)))
        m.add("lid", rod((c, -0.006, h), (c + 0.035, -0.006, h), 0.004, 8))
        m.hinge("latch", (c + 0.0175, -0.006, h), (-1, 0, 0), m.pick(60, 80, 100), "lid")
    if kind in ("panini", "grill"):
        if m.chance(0.6):
            dial(m, "thermostat", (0.3 * x[1], 0, (low + seam) / 2), (0, -1, 0), 0.016)
        if m.chance(0.5):
            z = (low + 0.004 - 0.018, low - 0.001)
            m.add("drip_tray", box((-0.3 * x[1], 0.3 * x[1]), (0.006, 0.7 * y[1]), (max(z[0], 0.001), z[1])))
            m.add("drip_tray", box((-0.32 * x[1], 0.32 * x[1]), (-0.006, 0.006), (max(z[0], 0.001), low + 0.0)))
            m.slide("drip_tray", (0, -1, 0), 0.55 * y[1])
    if m.chance(0.4):
        m.add("lid", box((-0.04, 0.04), (0.6 * y[1], 0.75 * y[1]), (top[1] - 0.002, top[1] + 0.0015)))
    if m.chance(0.3):
        cable(m, (0.2 * x[1], y[1], low + 0.015), 0.15)
