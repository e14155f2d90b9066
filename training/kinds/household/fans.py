"""Fans on a stand and under a ceiling."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.electronics.controls import button
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod, rounded, tube, turned, vec
from training.kinds.wheels import lathe, upright


def blades(m: Model, count: int, radius: float, pitch: float) -> list:
    """Fan blades and a hub round the z axis."""
    style, n = m.pick("board", "leaf", "curved"), m.sections()
    found = [
        lathe([(0, -0.06 * radius), (0.18 * radius, -0.06 * radius), (0.16 * radius, 0.08 * radius), (0, 0.12 * radius)], n)
    ]
    for k in range(count):
        outline = {
            "board": [(0.1, -0.09), (1, -0.12), (1, 0.12), (0.1, 0.09)],
            "leaf": [(0.1, -0.06), (0.5, -0.2), (0.9, -0.18), (1, 0), (0.85, 0.15), (0.5, 0.15), (0.1, 0.06)],
            "curved": [(0.1, -0.1), (0.6, -0.3), (0.95, -0.25), (1, 0.1), (0.7, 0.05), (0.1, 0.1)],
        }[style]
        blade = prism(Polygon(radius * np.array(outline)), "z", (-0.006 * radius, 0.006 * radius))
        turned(blade, (1, 0, 0), pitch, (0, 0, 0))
        found.append(turned(blade, (0, 0, 1), 360 * k / count, (0, 0, 0)))
    return found


def table_fan(m: Model) -> None:
    """A foot, a neck, a head that swings and tilts, blades in a cage; perhaps keys and a timer."""
    radius, tall, n = m.number(0.12, 0.24), m.pick(0.15, 0.25, 0.9), m.sections()
    foot = (
        rod((0, 0, 0), (0, 0, 0.03), m.number(0.7, 1.0) * radius, 24)
        if m.chance(0.5)
        else prism(rounded((-0.1, 0.1), (-0.12, 0.12), 0.03), "z", (0, 0.04))
    )
    m.add(BASE, foot, rod((0, 0, 0), (0, 0, tall), 0.018, n))
    for k in range(m.pick(0, 3, 4)):
        button(m, f"key_{k}", (-0.05 + 0.025 * k, -0.03 + 0.025 * k), (-0.09, -0.07), foot.bounds[1][2], 0.008)
    neck = vec(0, 0, tall)
    pans = m.chance(0.5)
    body = "neck" if pans else BASE
    m.add(
        body,
        rod(neck, neck + vec(0, 0, 0.03), 0.022, n),
        *(box((s * 0.02, s * 0.03), (-0.015, 0.015), (tall + 0.01, tall + 0.08)) for s in (-1, 1)),
    )
    if pans:
        m.add(body, box((-0.03, 0.03), (-0.015, 0.015), (tall + 0.005, tall + 0.015)))
        m.hinge(body, neck, (0, 0, 1), (-60, 60))
    pivot, tilt = neck + vec(0, 0, 0.065), m.chance(0.8)
    head = "head" if tilt else body
    m.add(
        head,
        rod(pivot - vec(0.02, 0, 0), pivot + vec(0.02, 0, 0), 0.012, n),
        rod(pivot + vec(0, -0.03, 0.03), pivot + vec(0, 0.12, 0.03), 0.045, n),
    )
    m.add(head, ball(pivot + vec(0, 0.12, 0.03), (0.045, 0.03, 0.045), n))
    if tilt:
        m.hinge(head, pivot, (-1, 0, 0), (-15, 35), body)
    hub = pivot + vec(0, -0.08, 0.03)
    m.add(
        "blades",
        *upright(blades(m, m.pick(3, 4, 5), 0.85 * radius, m.pick(10, 25, 35)), (0, -1, 0), hub),
        rod(hub, hub + vec(0, 0.06, 0), 0.008, 8),
    )
    m.spin("blades", hub, (0, -1, 0), head)
    if m.chance(0.8):  # a cage
        bars = m.pick(12, 20, 30)
        for t in np.linspace(0, 2 * np.pi, bars, endpoint=False):
            out = vec(np.cos(t), 0, np.sin(t))
            path = [
                hub + vec(0, -0.05, 0) + 0.15 * radius * out,
                hub + vec(0, -0.04, 0) + 0.8 * radius * out,
                hub + radius * out,
            ]
            m.add(
                head,
                tube(
                    [*path, hub + vec(0, 0.04, 0) + 0.8 * radius * out, hub + vec(0, 0.05, 0) + 0.2 * radius * out], 0.0015, 4
                ),
            )
        m.add(
            head, ring(hub, (0, 1, 0), radius, 0.004, 32), rod(hub - vec(0, 0.054, 0), hub - vec(0, 0.048, 0), 0.2 * radius, n)
        )
        m.add(head, ring(hub + vec(0, 0.05, 0), (0, 1, 0), 0.25 * radius, 0.004, 16))
    if m.chance(0.4):
        at = pivot + vec(0, 0.08, 0.075)
        m.add("pin", rod(at - vec(0, 0, 0.01), at + vec(0, 0, 0.02), 0.005, 8))
        m.slide("pin", (0, 0, 1), 0.012, head)


def ceiling_fan(m: Model) -> None:
    """Blades on a motor below a rod and a canopy, perhaps with lamps and pull chains that stay."""
    radius, drop, n = m.number(0.45, 0.8), m.number(0.1, 0.5), m.pick(12, 20, 28)
    m.add(
        BASE, lathe([(0, 0), (0.07, 0), (0.06, -0.05), (0.02, -0.07), (0, -0.07)], n), rod((0, 0, -drop), (0, 0, 0), 0.012, 10)
    )
    z = -drop - 0.06
    stays = m.chance(0.6)
    motor = BASE if stays else "fan"
    m.add(motor, lathe([(0, 0.07), (0.06, 0.06), (0.13, 0.03), (0.13, -0.03), (0.08, -0.05), (0, -0.05)], n, (0, 0, z)))
    count, wide, pitch = m.pick(3, 4, 5, 6), m.number(0.1, 0.15), m.pick(8, 14)
    low, ends = z - 0.03, m.pick("square", "round")
    for k in range(count):
        plate = rounded((0.24, radius), (-wide / 2, wide / 2), 0.45 * wide if ends == "round" else 0.005)
        pieces = [
            turned(prism(plate, "z", (-0.004, 0.004)), (1, 0, 0), pitch, (0, 0, 0)),
            box((0.1, 0.28), (-0.02, 0.02), (-0.006, 0.006)),
        ]
        pieces += [rod((0.25, c, -0.008), (0.25, c, 0.01), 0.006, 6) for c in (-0.015, 0.015)] if m.chance(0.5) else []
        for piece in pieces:
            piece.apply_translation((0, 0, low))
            m.add("fan", turned(piece, (0, 0, 1), 360 * k / count, (0, 0, 0)))
    m.add("fan", rod((0, 0, low - 0.008), (0, 0, low + 0.008), 0.14, n))
    m.spin("fan", (0, 0, low), (0, 0, 1))
    if m.chance(0.7):
        m.add(BASE, rod((0, 0, low - 0.1), (0, 0, low), 0.03, n))
        lamps = m.pick(1, 3, 4)
        for k in range(lamps):
            if lamps == 1:
                m.add(BASE, ball((0, 0, low - 0.14), (0.12, 0.12, 0.08), n))
                continue
            c, s = np.cos(2 * np.pi * k / lamps), np.sin(2 * np.pi * k / lamps)
            m.add(BASE, rod((0, 0, low - 0.08), (0.12 * c, 0.12 * s, low - 0.1), 0.01, 8))
            m.add(
                BASE,
                lathe(
                    [(0.02, 0.0), (0.06, -0.09), (0.057, -0.09), (0.017, 0.0), (0.02, 0)], n, (0.12 * c, 0.12 * s, low - 0.09)
                ),
            )
        for x in (0.03, -0.03)[: m.pick(0, 1, 2)]:
            m.add(BASE, rod((x, 0, low - 0.35), (x, 0, low - 0.08), 0.0015, 5), ball((x, 0, low - 0.35), (0.008,) * 3, 8))
