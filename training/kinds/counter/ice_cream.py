"""Ice cream makers."""

from __future__ import annotations

import numpy as np

from training.kinds.counter.counter_appliances import back_hinge, bar, tower
from training.kinds.counter.table_appliances import vessel
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, cable, dial, feet, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, ring, rod, rounded, vec


def ice_cream_maker(m: Model) -> None:
    """Make an ice cream maker: a bowl with its motor on top, a box with a well and a lid, or soft serve with levers."""
    m.pick(_canister, _cooler, _cooler, _soft_serve)(m)


def _paddle(m: Model, at: np.ndarray, r: float, high: float) -> None:
    """Blades that turn in a bowl."""
    m.add("paddle", rod(at, at + vec(0, 0, high), 0.008, 10))
    style = m.pick("frame", "wings")
    for s in (-1, 1):
        if style == "frame":
            path = [
                at + vec(0, 0, 0.01),
                at + vec(s * 0.85 * r, 0, 0.01),
                at + vec(s * 0.85 * r, 0, 0.7 * high),
                at + vec(0, 0, 0.75 * high),
            ]
            m.add("paddle", bar(path, 0.004, 6))
        else:
            x = tuple(sorted((at[0], at[0] + s * 0.85 * r)))
            m.add(
                "paddle",
                prism(
                    [(x[0], at[2] + 0.006), (x[1], at[2] + 0.006), (x[1], at[2] + 0.05), (x[0], at[2] + 0.02)],
                    "y",
                    (at[1] - 0.002, at[1] + 0.002),
                ),
            )
    m.spin("paddle", at, (0, 0, 1))


def _canister(m: Model) -> None:
    r, tall, n = m.number(0.09, 0.11), m.number(0.14, 0.18), m.pick(16, 24, 32)
    m.add(BASE, vessel(r, 0.0, tall, m.pick(0.012, 0.02), n, m.pick(1.0, 0.9)))
    if m.chance(0.6):
        m.add(BASE, *(ring((0, 0, z), (0, 0, 1), r, 0.004, n) for z in m.pick((0.006, tall - 0.006), (0.3 * tall,))))
    if m.chance(0.6):
        for s in (-1, 1):
            x, out = s * 0.94 * r, s * (r + 0.035)
            m.add(BASE, bar([(x, 0, 0.85 * tall), (out, 0, 0.82 * tall), (out, 0, 0.4 * tall), (x, 0, 0.35 * tall)], 0.008, 8))
    _paddle(m, vec(0, 0, 0.024), r - 0.022, tall - 0.03)
    lid, z = m.pick("lid", "lid", BASE), tall + m.number(0.02, 0.05)
    m.add(lid, lathe([(1.02 * r, tall + 0.001), (1.02 * r, tall + 0.01), (0.9 * r, z)], n))
    if lid != BASE:
        m.slide("lid", (0, 0, 1), m.number(0.08, 0.14))
    wide, deep, up = m.number(0.035, 0.05), m.pick(0.04, 0.6 * r), m.number(0.05, 0.08)
    m.add(lid, tower((-wide, wide), (-deep + 0.02, deep + 0.02), 0.02, [(1.05, z), (1, z + 0.01), (0.9, z + up)]))
    m.add("flap", prism(rounded((-0.03, 0.03), (-0.9 * r, -0.055), 0.008), "z", (z + 0.001, z + 0.006)))
    m.add("flap", box((-0.01, 0.01), (-0.9 * r - 0.006, -0.85 * r), (z + 0.004, z + 0.009)))
    back_hinge(m, "flap", (0, -0.055, z + 0.004), 0.02, m.pick(70, 85), lid)
    if m.chance(0.5):
        dial(m, "dial", (0, 0.02, z + up), (0, 0, 1), 0.02, lid)
    else:
        button(m, "switch", (0, 0.02, z + up), (0, 0, 1), 0.022, lid)


def _cooler(m: Model) -> None:
    w, d, h, r = m.number(0.36, 0.44), m.number(0.24, 0.3), m.number(0.2, 0.27), m.number(0.085, 0.1)
    upright, n = m.chance(0.35), m.pick(16, 24, 32)
    if upright:
        w, h = 0.26, m.number(0.28, 0.34)
    x, y, c = (0.0, w), (0.0, d), vec((w - 0.13) if not upright else w / 2, d / 2, 0)
    body = tower(x, y, m.pick(0.02, 0.05), [(0.97, 0.012), (1, 0.03), (1, h - 0.01), (0.98, h)])
    hollow = m.chance(0.8)
    if hollow:
        body = cut(body, rod((c[0], c[1], 0.07), (c[0], c[1], h + 1), r, n))
        m.add(
            BASE, lathe([(0.94 * r, 0.075), (0.96 * r, h - 0.006), (0.92 * r, h - 0.006), (0.9 * r, 0.08)], n, (c[0], c[1], 0))
        )
        _paddle(m, vec(c[0], c[1], 0.082), 0.88 * r, h - 0.09)
    m.add(BASE, body)
    feet(m, shrunk(x, 0.02), shrunk(y, 0.02), 0.014)
    low, top = h + 0.001, h + m.number(0.02, 0.045)
    m.add("lid", lathe([(1.12 * r, low), (1.12 * r, low + 0.01), (m.pick(0.95, 1.08) * r, top)], n, (c[0], c[1], 0)))
    if m.chance(0.6):
        m.add("lid", rod((c[0], c[1], top - 0.002), (c[0], c[1], top + 0.02), m.pick(0.02, 0.5 * r), n))
    if m.chance(0.5):
        m.slide("lid", (0, 0, 1), m.number(0.08, 0.14))
    else:
        back = c[1] + 1.12 * r + 0.008
        m.add("lid", box((c[0] - 0.025, c[0] + 0.025), (back - 0.03, back), (low + 0.001, low + 0.012)))
        back_hinge(m, "lid", (c[0], back, low + 0.003), 0.03, m.pick(75, 90, 100))
    _cooler_controls(m, w, d, h, upright)
    for k in range(m.pick(0, 6, 8)):
        m.add(BASE, box((-0.002, 0.004), (0.15 * d, 0.85 * d), (0.2 * h + 0.016 * k, 0.2 * h + 0.016 * k + 0.006)))
    if m.chance(0.4):
        cable(m, (w / 2, d - 0.002, 0.05), 0.2)


def _cooler_controls(m: Model, w: float, d: float, h: float, upright: bool) -> None:
    count, style = m.pick(1, 2, 3), m.pick("dial", "buttons")
    at, axis = (
        (vec(0.5 * w, 0, 0.55 * h), vec(0, -1, 0)) if upright or m.chance(0.4) else (vec(0.2 * w, 0.35 * d, h), vec(0, 0, 1))
    )
    up = vec(0, 0, 1) if axis[2] == 0 else vec(0, 1, 0)
    corner, far = at + vec(-0.045, 0, 0) + 0.035 * up, at + vec(0.045, 0, 0) + 0.07 * up + 0.002 * axis
    m.add(BASE, box(*np.c_[corner - 0.003 * axis, far]))
    if style == "dial":
        dial(m, "dial", at, axis, 0.024)
    for k in range(count if style == "buttons" else 0):
        button(m, f"button_{k}", at + vec(0.03 * (k - (count - 1) / 2), 0, 0), axis, 0.016)


def _soft_serve(m: Model) -> None:
    w, d, h, nozzles = m.number(0.26, 0.4), m.number(0.4, 0.55), m.number(0.55, 0.75), m.pick(1, 2, 3)
    w = max(w, 0.12 * nozzles)
    foot, face = m.pick(0.02, 0.05), m.number(0.45, 0.55) * h
    outline = [
        (0, foot),
        (d, foot),
        (d, h),
        (0.1, h),
        (0.0, h - 0.1),
        (0.0, face),
        (0.1, face - 0.03),
        (0.1, foot + 0.1),
        (0, foot + 0.1),
    ]
    m.add(BASE, prism(outline if m.chance(0.6) else [*outline[:3], (0, h)], "x", (0, w)))
    y, z = 0.0, face + 0.07
    feet(m, (0, w), (0, d), foot)
    for k in range(nozzles):
        _nozzle(m, f"lever_{k}", vec(w * (k + 0.5) / nozzles, y, z))
    tray = m.pick("tray", "tray", BASE)
    m.add(tray, box((0.15 * w, 0.85 * w), (-0.1, 0.0), (foot + 0.1, foot + 0.12)))
    m.add(tray, *(box((0.2 * w, 0.8 * w), (c, c + 0.006), (foot + 0.12, foot + 0.123)) for c in np.linspace(-0.09, -0.02, 5)))
    if tray != BASE:
        m.slide("tray", (0, -1, 0), m.number(0.05, 0.1))
    _hoppers(m, w, d, h, 2 if nozzles == 3 else 1)
    if m.chance(0.6):
        m.add(BASE, box((0.3 * w, 0.7 * w), (-0.003, 0.002), (h - 0.2, h - 0.13)))
    for k in range(m.pick(0, 5, 8)):
        m.add(BASE, box((w - 0.002, w + 0.003), (0.35 * d, 0.9 * d), (0.2 * h + 0.02 * k, 0.2 * h + 0.02 * k + 0.008)))


def _nozzle(m: Model, part: str, at: np.ndarray) -> None:
    m.add(BASE, box((at[0] - 0.035, at[0] + 0.035), (at[1] - 0.05, at[1] + 0.002), (at[2] - 0.035, at[2] + 0.04)))
    m.add(BASE, rod(at + vec(0, -0.028, -0.034), at + vec(0, -0.028, -0.06), 0.016, 12))
    pivot = at + vec(0, -0.052, 0.03)
    end, n = pivot + m.pick(vec(0, -0.03, 0.09), vec(0, -0.012, 0.12), vec(0, -0.09, 0.03)), m.pick(8, 12, 16)
    m.add(
        BASE,
        *(
            box(
                (pivot[0] + s * 0.016 - 0.003, pivot[0] + s * 0.016 + 0.003),
                (pivot[1] - 0.012, at[1] - 0.04),
                (pivot[2] - 0.012, pivot[2] + 0.012),
            )
            for s in (-1, 1)
        ),
    )
    m.add(part, rod(pivot, end, 0.006, 8), rod(pivot - vec(0.013, 0, 0), pivot + vec(0.013, 0, 0), 0.009, 12))
    m.add(part, m.pick(ball(end, (0.016,) * 3, 12), rod(pivot + 0.5 * (end - pivot), end + 0.1 * (end - pivot), 0.011, n)))
    m.hinge(part, pivot, (1, 0, 0), m.pick(40, 55, 70))


def _hoppers(m: Model, w: float, d: float, h: float, count: int) -> None:
    for k in range(count):
        part, x = f"hopper_lid_{k}" if count > 1 else "hopper_lid", (w * k / count + 0.025, w * (k + 1) / count - 0.025)
        y: Span = (0.16, d - 0.06)
        m.add(BASE, prism(rounded(shrunk(x, -0.006), shrunk(y, -0.006), 0.02), "z", (h - 0.002, h + 0.006)))
        m.add(part, tower(x, y, 0.02, [(1, h + 0.007), (1, h + 0.018), (0.85, h + m.number(0.02, 0.035))]))
        c = (sum(x) / 2, sum(y) / 2)
        m.add(
            part,
            m.pick(
                box((c[0] - 0.035, c[0] + 0.035), (c[1] - 0.008, c[1] + 0.008), (h + 0.018, h + 0.046)),
                rod((*c, h + 0.016), (*c, h + 0.05), 0.014, 12),
            ),
        )
        if m.chance(0.5):
            m.slide(part, (0, 0, 1), m.number(0.06, 0.12))
        else:
            back_hinge(m, part, (c[0], y[1], h + 0.008), 0.06, m.pick(75, 95))
