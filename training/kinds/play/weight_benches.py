"""Weight benches."""

from __future__ import annotations

import numpy as np
from trimesh.creation import annulus

from training.kinds.electronics.stands import swung
from training.kinds.furniture.barber_chairs import UP, cushion
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, rod, tube, turned, vec
from training.kinds.wheels import beam, upright

X = vec(1, 0, 0)


def _disc(m: Model, part: str, at: np.ndarray, r: float, thick: float, n: int) -> None:
    m.add(part, *upright([annulus(0.016, r, thick, sections=n)], X, at))


def _barbell(m: Model, part: str, at: np.ndarray, long: float, n: int) -> None:
    """A bar across with discs at its ends."""
    m.add(part, rod(at - long / 2 * X, at + long / 2 * X, 0.014, 10))
    sizes = m.pick((0.22,), (0.22, 0.22), (0.2, 0.16, 0.12), (0.12,), ())
    for s in (-1, 1):
        p = at + s * (long / 2 - 0.24) * X
        m.add(part, rod(p - 0.012 * s * X, p, 0.028, n), rod(p, at + s * long / 2 * X, 0.02, n))
        for k, r in enumerate(sizes):
            _disc(m, part, p + s * (0.02 + 0.038 * k) * X, r, 0.034, n)


def _leg_curl(m: Model, at: np.ndarray, n: int, parent: str) -> None:
    """An arm with rollers below the front of the seat that swings forwards, with a peg for discs."""
    low = at - vec(0, 0.02, m.number(0.28, 0.34))
    m.add("leg_arm", beam(at + vec(0, 0, 0.02), low - vec(0, 0, 0.02), 0.045, 0.045))
    for p in (low + vec(0, -0.005, 0.02),):
        m.add("leg_arm", rod(p - 0.22 * X, p + 0.22 * X, 0.012, 8))
        m.add("leg_arm", *(rod(p + s * 0.05 * X, p + s * 0.21 * X, 0.045, n) for s in (-1, 1)))
    peg = low + vec(0, -0.02, 0.12)
    m.add("leg_arm", rod(peg, peg - vec(0, 0.13, 0), 0.013, 8))
    if m.chance(0.3):
        m.add("leg_arm", *upright([annulus(0.014, 0.11, 0.03, sections=n)], (0, 1, 0), peg - vec(0, 0.06, 0)))
    m.add(parent, *(box((s * 0.026, s * 0.034), (at[1] - 0.03, at[1] + 0.05), (at[2] - 0.03, at[2] + 0.05)) for s in (-1, 1)))
    m.add(
        parent, rod(at - 0.04 * X, at + 0.04 * X, 0.009, 8), rod(at + vec(-0.2, 0.0, 0.045), at + vec(0.2, 0.0, 0.045), 0.01, 8)
    )
    m.add(parent, *(rod(at + vec(s * 0.05, 0, 0.045), at + vec(s * 0.2, 0, 0.045), 0.04, n) for s in (-1, 1)))
    m.hinge("leg_arm", at, (-1, 0, 0), m.number(70, 95), parent)


def weight_bench(m: Model) -> None:
    """A bench whose back and seat tilt, with or without a rack with a bar, a leg arm, a rolling foot."""
    n, top, w = m.pick(12, 16, 24), m.number(0.4, 0.47), m.number(0.025, 0.035)
    wide, long = m.number(0.25, 0.32), m.number(1.1, 1.35)
    front, split, rear = -0.2, m.number(0.1, 0.18), long - 0.2
    t, flat = m.number(0.05, 0.08), m.chance(0.2)
    m.add(BASE, box((-w, w), (front + 0.05, rear - 0.1), (top - t - 0.09, top - t - 0.03)))
    m.add(BASE, box((-w, w), (front + 0.06, front + 0.06 + 2 * w), (0.04, top - t - 0.03)))
    m.add(BASE, beam((0, rear - 0.2, top - t - 0.06), (0, rear - 0.05, 0.04), 2 * w, 2 * w))
    for y, half in ((front + 0.06 + w, m.number(0.18, 0.28)), (rear - 0.05, m.number(0.22, 0.32))):
        m.add(BASE, box((-half, half), (y - w, y + w), (0.01, 0.01 + 2 * w)))
        m.add(
            BASE, *(box((s * half - 0.02, s * half + 0.02), (y - w - 0.004, y + w + 0.004), (0, 0.02 + 2 * w)) for s in (-1, 1))
        )
    under, z = top - t, (top - t, top)
    if flat:
        m.add(
            BASE,
            *cushion(m, (-wide / 2, wide / 2), (front, rear), z),
            box((-0.08, 0.08), (front + 0.1, rear - 0.1), (under - 0.032, under)),
        )
    else:
        _bench_pads(m, wide, (front, split, rear), z, w)
    at = vec(0, front + 0.02, under - 0.07)
    if m.chance(0.45):
        m.add(BASE, box((-w, w), (front + 0.02, front + 0.08), (under - 0.09, under - 0.03)))
        _leg_curl(m, at, n, BASE)
    if m.chance(0.5) or flat:
        _rack(m, rear, top, w, n)
    elif m.chance(0.5):
        m.add(BASE, *(rod((s * 0.25, rear - 0.04, 0.045), (s * 0.29, rear - 0.04, 0.045), 0.045, n) for s in (-1, 1)))
        m.add(
            BASE,
            tube(
                [
                    (-0.05, front + 0.07, 0.12),
                    (-0.05, front + 0.01, 0.14),
                    (0.05, front + 0.01, 0.14),
                    (0.05, front + 0.07, 0.12),
                ],
                0.009,
                6,
            ),
        )


def _bench_pads(m: Model, wide: float, y: tuple[float, float, float], z: Span, w: float) -> None:
    """Seat and back pad on their plates; the back rises about its lower end from flat or from a slope."""
    front, split, rear = y
    lean, axis, x = m.pick(0.0, 0.0, 15.0, 30.0, 45.0), (1, 0, 0), (-wide / 2, wide / 2)
    pivot = vec(0, split + 0.03, z[0] - 0.045)
    back = [
        *cushion(
            m, (-wide / 2 * m.pick(1.0, 0.85), wide / 2 * m.pick(1.0, 0.85)) if m.chance(0.3) else x, (split + 0.006, rear), z
        )
    ]
    back += [box((s * 0.045 - 0.012, s * 0.045 + 0.012), (split + 0.015, rear - 0.25), (z[0] - 0.055, z[0])) for s in (-1, 1)]
    m.add("back", *(turned(p, axis, lean, pivot) for p in back))
    m.add(BASE, rod(pivot - 0.065 * X, pivot + 0.065 * X, 0.011, 10))
    m.hinge("back", pivot, axis, (-lean if m.chance(0.5) else 0.0, m.number(75, 85) - lean))
    if lean > 5:
        at, end = swung(vec(0, split + 0.35, z[0] - 0.05), axis, lean, pivot), vec(0, split + 0.42, z[0] - 0.06)
        if m.chance(0.6):
            m.add(BASE, beam(end - vec(0, 0, 0.02), at - vec(0, 0, 0.004), 0.03, 0.02))
    seat = cushion(m, x, (front, split - 0.006), z)
    tilts = m.chance(0.6)
    part = "seat" if tilts else BASE
    m.add(part, *seat, box((-0.06, 0.06), (front + 0.05, split - 0.03), (z[0] - 0.032, z[0])))
    if tilts:
        m.hinge("seat", (0, split - 0.04, z[0] - 0.03), (-1, 0, 0), m.number(12, 30))


def _rack(m: Model, rear: float, top: float, w: float, n: int) -> None:
    """Uprights with hooks behind the head that carry a bar, which lifts off."""
    y, half, high = rear - m.number(0.2, 0.32), m.number(0.3, 0.52), top + m.number(0.42, 0.6)
    m.add(
        BASE,
        box((-half, half), (y - w, y + w), (0.01, 0.01 + 2 * w)),
        box((-half, half), (y - w, y + w), (top - 0.17, top - 0.17 + 2 * w)),
    )
    for s in (-1, 1):
        a = s * half
        m.add(BASE, box((a - w, a + w), (y - w, y + w), (0.0, high)), box((a - w, a + w), (y - 0.2, y + 0.2), (0, 0.05)))
        m.add(
            BASE,
            box((a - w, a + w), (y - w - 0.07, y - w), (high - 0.1, high - 0.08)),
            box((a - w, a + w), (y - w - 0.07, y - w - 0.055), (high - 0.1, high - 0.04)),
        )
        if m.chance(0.4):
            m.add(BASE, box((a - w, a + w), (y - w - 0.25, y - w), (high - 0.32, high - 0.29)))
    if m.chance(0.75):
        at = vec(0, y - w - 0.03, high - 0.0665)
        _barbell(m, "barbell", at, m.number(1.5, 2.1) if half > 0.4 else m.number(1.2, 1.5), n)
        m.slide("barbell", UP, m.number(0.3, 0.45))
