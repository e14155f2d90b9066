"""Rowing machines with a fan, a tank of water or pistons."""

from __future__ import annotations

import numpy as np
from trimesh.creation import annulus

from training.kinds.electronics.stands import swung
from training.kinds.furniture.barber_chairs import cushion
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, ring, rod, tube, turned, vec
from training.kinds.wheels import beam, lathe, upright

X = vec(1, 0, 0)


def _seat(m: Model, at: float, top: float, rail: Span, half: float, n: int) -> None:
    """A seat on rollers that runs along the rail; at: where along the rail it stands."""
    high, wide = m.number(0.07, 0.11), m.number(0.13, 0.16)
    z = (top + high - 0.035, top + high)
    m.add("seat", *cushion(m, (-wide, wide), (at - 0.12, at + 0.12), z))
    m.add("seat", box((-half - 0.014, half + 0.014), (at - 0.09, at + 0.09), (z[0] - 0.01, z[0])))
    m.add("seat", *(box((s * (half + 0.006), s * (half + 0.014)), (at - 0.09, at + 0.09), (top - 0.02, z[0])) for s in (-1, 1)))
    for y in (at - 0.07, at + 0.07):
        m.add("seat", rod((-half - 0.01, y, top + 0.019), (half + 0.01, y, top + 0.019), 0.017, n))
    m.slide("seat", (0, 1, 0), (rail[0] + 0.14 - at, rail[1] - 0.14 - at))


def _feet_plates(m: Model, y: float, z: float, out: float) -> None:
    """Two sloping plates for the feet, fixed or turning about a bar, with straps and heels."""
    lean, turns, long = m.number(35, 50), m.chance(0.4), m.number(0.26, 0.32)
    for k, s in enumerate((-1, 1)):
        part, x = (f"foot_{k}" if turns else BASE), s * out
        solids = [box((x - 0.055, x + 0.055), (y - 0.012, y), (z - 0.3 * long, z + 0.7 * long))]
        solids += [box((x - 0.05, x + 0.05), (y, y + 0.05), (z - 0.3 * long, z - 0.3 * long + 0.012))]
        if m.chance(0.7):
            solids.append(
                tube(
                    [
                        (x - 0.055, y, z + 0.3 * long),
                        (x - 0.045, y + 0.06, z + 0.33 * long),
                        (x + 0.045, y + 0.06, z + 0.33 * long),
                        (x + 0.055, y, z + 0.3 * long),
                    ],
                    0.007,
                    6,
                )
            )
        m.add(part, *(turned(p, X, lean, (0, y, z)) for p in solids))
        if turns:
            m.hinge(part, (x, y, z), X, (-20, 25))
    m.add(BASE, rod((-out - 0.06, y - 0.012, z), (out + 0.06, y - 0.012, z), 0.012, 10))


def _console(m: Model, at: np.ndarray, tall: float) -> None:
    """A display on an arm that swings up or tilts."""
    end = at + vec(0, 0.06, tall)
    m.add(
        "console",
        beam(at, end, 0.035, 0.018),
        box((-0.09, 0.09), (end[1] - 0.015, end[1] + 0.02), (end[2] - 0.03, end[2] + 0.12)),
    )
    m.add("console", box((-0.075, 0.075), (end[1] + 0.02, end[1] + 0.022), (end[2] + 0.01, end[2] + 0.105)))
    m.add(BASE, rod(at - 0.03 * X, at + 0.03 * X, 0.018, 10))
    m.hinge("console", at, X, m.pick((-20, 40), (-70, 10), (0, 60)))


def _handle(m: Model, at: np.ndarray, travel: float) -> None:
    """A handle on a chain or strap that is pulled to the back."""
    bend = m.pick(0.0, 0.03)
    m.add(
        "handle", tube([at + vec(-0.24, bend, 0), at + vec(-0.1, 0, 0), at + vec(0.1, 0, 0), at + vec(0.24, bend, 0)], 0.012, 8)
    )
    m.add("handle", *(beam(at + vec(s * 0.11, 0, 0), at + vec(s * 0.235, bend, 0), 0.036, 0.036, (0, 0, 1)) for s in (-1, 1)))
    m.add("handle", rod(at - vec(0, 0.09, 0), at, 0.006, 6))
    m.slide("handle", (0, 1, 0), travel)


def rowing_machine(m: Model) -> None:
    """A rail with a seat that runs, a handle that is pulled from a flywheel in air or water, or two arms with pistons."""
    style, n = m.pick("air", "air", "water", "piston"), m.pick(12, 16, 24)
    long, top = m.number(1.1, 1.45), m.number(0.2, 0.38)
    half, rail = m.number(0.03, 0.05), (0.0, long)
    if style == "water":
        half = m.number(0.08, 0.11)
        m.add(BASE, *(box((s * half - 0.015, s * half + 0.015), (-0.75, long), (top - 0.09, top)) for s in (-1, 1)))
        m.add(BASE, *(box((-half - 0.1, half + 0.1), (y - 0.02, y + 0.02), (0.0, 0.05)) for y in (-0.7, long - 0.05)))
        m.add(
            BASE,
            *(
                box((s * half - 0.015, s * half + 0.015), (y - 0.03, y + 0.03), (0.03, top - 0.05))
                for s in (-1, 1)
                for y in (-0.7, long - 0.05)
            ),
        )
        half += 0.015
    else:
        m.add(BASE, box((-half, half), (-0.6 if style == "air" else -0.35, long), (top - 0.08, top)))
        m.add(BASE, *(box((s * half - 0.004, s * half + 0.004), (0.0, long), (top - 0.03, top)) for s in (-1, 1)))
        m.add(
            BASE,
            beam((0, long - 0.05, top - 0.06), (0, long + 0.0, 0.03), 0.06, 0.04),
            box((-0.2, 0.2), (long - 0.03, long + 0.03), (0, 0.04)),
        )
    _seat(m, m.number(0.3, 0.7) * long, top, rail, half, n)
    _feet_plates(m, -0.12, top + m.number(0.0, 0.05), half + 0.075)
    {"air": _air, "water": _water, "piston": _pistons}[style](m, top, half, n)
    if m.chance(0.5) and style != "water":
        m.add(BASE, box((-half - 0.02, half + 0.02), (long - 0.03, long + 0.02), (top - 0.09, top + 0.02)))


def _air(m: Model, top: float, half: float, n: int) -> None:
    """A fan in a cage, its stand, the chain guide and the console."""
    r, w = m.number(0.22, 0.28), m.number(0.05, 0.075)
    hub = vec(0, -0.62, max(top + m.number(0.05, 0.18), r + 0.05))
    m.add(BASE, *upright([annulus(0.94 * r, r, 2 * w, sections=n + 12)], X, hub))
    for s in (-1, 1):
        p = hub + s * w * X
        m.add(BASE, rod(p - 0.004 * X, p + 0.004 * X, 0.3 * r, n), *(ring(p, X, f * r, 0.004, n + 8) for f in (0.5, 0.7, 0.88)))
        ways = [vec(0, np.cos(a), np.sin(a)) for a in 2 * np.pi * np.arange(8) / 8]
        m.add(BASE, *(rod(p + 0.28 * r * q, p + 0.97 * r * q, 0.004, 6) for q in ways))
    blades = m.pick(8, 12)
    for a in 2 * np.pi * np.arange(blades) / blades:
        q = vec(0, np.cos(a), np.sin(a))
        m.add("fan", beam(hub + 0.2 * r * q, hub + 0.88 * r * q, 1.4 * w, 0.006))
    m.add("fan", rod(hub - 0.85 * w * X, hub + 0.85 * w * X, 0.24 * r, n))
    m.spin("fan", hub, X)
    m.add(BASE, beam((0, -0.4, top - 0.05), (0, hub[1] + 0.1, hub[2] - 0.05), 0.05, 0.1))
    m.add(BASE, *(beam(hub + vec(s * w, 0, 0), (s * 0.22, hub[1] - 0.03, 0.03), 0.03, 0.04, (0, 1, 0)) for s in (-1, 1)))
    m.add(BASE, *(rod((s * 0.2, hub[1] - 0.03, 0.03), (s * 0.27, hub[1] - 0.03, 0.03), 0.03, 12) for s in (-1, 1)))
    z = max(top + 0.16, hub[2])
    m.add(
        BASE,
        box((-0.03, 0.03), (hub[1] + 0.93 * r, -0.27), (z - 0.035, z + 0.035)),
        beam((0, -0.3, z - 0.02), (0, -0.34, top - 0.02), 0.05, 0.05),
    )
    _handle(m, vec(0, -0.2, z), m.number(0.9, 1.2))
    _console(m, vec(0, -0.33, z + 0.05), m.number(0.25, 0.4))
    if m.chance(0.6):
        at = hub + vec(w + 0.004, 0, 0)
        m.add(
            "damper",
            beam(at + vec(0.006, 0, 0), at + vec(0.006, 0.1, 0.12), 0.02, 0.01, (0, 1, 0)),
            rod(at, at + 0.012 * X, 0.03, 12),
        )
        m.hinge("damper", at, X, (-40, 40))


def _water(m: Model, top: float, half: float, n: int) -> None:
    """A round tank with a paddle in it, a post with a pulley, and a display."""
    r, high = m.number(0.22, 0.27), m.number(0.13, 0.18)
    c, low = vec(0, -0.5, 0), top + 0.005
    m.add(
        BASE,
        lathe(
            [
                (0, low),
                (r, low),
                (r, low + high),
                (0.9 * r, low + high + 0.02),
                (0.2 * r, low + high + 0.02),
                (0.2 * r, low + high + 0.012),
                (0.95 * r, low + high - 0.006),
                (0.96 * r, low + 0.008),
                (0, low + 0.008),
            ],
            n + 8,
            c,
        ),
    )
    for a in np.pi * np.arange(m.pick(3, 4)) / m.pick(3, 4):
        q = vec(np.cos(a), np.sin(a), 0)
        m.add(
            "paddle",
            beam(
                c - 0.85 * r * q + vec(0, 0, low + 0.06),
                c + 0.85 * r * q + vec(0, 0, low + 0.06),
                0.005,
                0.06,
                np.cross(q, (0, 0, 1)),
            ),
        )
    m.add(
        "paddle",
        rod(c + vec(0, 0, low + 0.02), c + vec(0, 0, low + high + 0.06), 0.02, n),
        rod(c + vec(0, 0, low + high + 0.028), c + vec(0, 0, low + high + 0.06), 0.07, n),
    )
    m.spin("paddle", c + vec(0, 0, low), (0, 0, 1))
    z = low + high + m.number(0.07, 0.12)
    m.add(BASE, *(beam((s * 0.055, -0.2, top - 0.02), (s * 0.045, -0.24, z + 0.1), 0.02, 0.06) for s in (-1, 1)))
    m.add(BASE, *(box((s * 0.05, s * half), (-0.23, -0.17), (top - 0.07, top - 0.01)) for s in (-1, 1)))
    pulley = vec(0, -0.24, z + 0.05)
    m.add("pulley", *upright([annulus(0.012, 0.045, 0.035, sections=n)], X, pulley))
    m.add(BASE, rod(pulley - 0.055 * X, pulley + 0.055 * X, 0.01, 8))
    m.spin("pulley", pulley, X)
    _handle(m, vec(0, -0.1, z + 0.05), m.number(0.9, 1.2))
    m.add(BASE, box((-0.07, 0.07), (-0.265, -0.225), (z + 0.1, z + 0.2)))


def _pistons(m: Model, top: float, half: float, n: int) -> None:
    """Two arms that are pulled back, each with a piston beside the rail; a cross foot in front."""
    m.add(BASE, box((-0.3, 0.3), (-0.36, -0.3), (0, 0.05)), beam((0, -0.33, 0.04), (0, -0.3, top - 0.04), 0.06, 0.05))
    reach, tall = m.number(0.22, 0.3), m.number(0.5, 0.62)
    m.add(BASE, box((-reach - 0.03, reach + 0.03), (-0.25, -0.2), (top - 0.1, top - 0.05)))
    lean = m.number(0, 12)
    for k, s in enumerate((-1, 1)):
        pivot, part = vec(s * reach, -0.225, top - 0.075), f"arm_{k}"
        way = swung(vec(0, 0, 1), X, lean)
        end = pivot + tall * way
        m.add(
            part,
            rod(pivot - 0.03 * X, pivot + 0.03 * X, 0.026, n),
            rod(pivot, end, 0.014, 10),
            rod(end - 0.02 * way, end - 0.15 * way, 0.02, 10),
        )
        if m.chance(0.5):
            m.add(part, rod(end - vec(s * 0.11, 0, 0), end, 0.018, 10))
        m.hinge(part, pivot, (-1, 0, 0), m.number(60, 85) + lean)
        m.add(
            BASE,
            rod((s * reach, 0.1, top - 0.15), (s * reach * 0.98, -0.2, top - 0.1), 0.02, n),
            rod((s * half, 0.1, top - 0.06), (s * reach, 0.1, top - 0.15), 0.012, 8),
        )
    if m.chance(0.6):
        _console(m, vec(0, -0.3, top + 0.02), m.number(0.2, 0.4))
