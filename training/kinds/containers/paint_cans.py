"""Paint tins, buckets, square cans and spray cans."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import lathe


def paint_can(m: Model) -> None:
    """A tin or a bucket with a lid and a bail, a square can with a screw cap, a spray can."""
    style = m.pick("tin", "tin", "bucket", "square", "spray")
    if style in ("tin", "bucket"):
        _tin(m, style == "bucket")
    else:
        {"square": _square, "spray": _spray}[style](m)


def _tin(m: Model, bucket: bool) -> None:
    """A round vessel, hollow or not, with paint in it."""
    r, n = m.number(0.05, 0.14), m.pick(16, 24, 32)
    high = r * m.number(1.8, 2.6)
    wall, low = 0.03 * r, (m.number(0.82, 0.92) * r if bucket else r)
    groove = 0.0 if bucket else 0.14 * r
    if m.chance(0.7):
        outside = [(0, 0), (low, 0), (r, high), (r - max(wall, groove), high), (r - max(wall, groove), high - wall)]
        m.add(BASE, lathe([*outside, (r - wall, high - 2 * wall), (low - wall, wall), (0, wall)], n))
        if m.chance(0.6):
            level = m.number(0.4, 0.85) * high
            m.add(BASE, rod((0, 0, 0.5 * wall), (0, 0, level), low - 0.5 * wall, n))
    else:
        m.add(BASE, lathe([(0, 0), (low, 0), (r, high - 0.001), (0, high - 0.001)], n))
    bands = (0.02, 0.97) if not bucket else (0.8, 0.88)
    m.add(BASE, *(ring((0, 0, b * high), (0, 0, 1), low + (r - low) * b, 0.018 * r, n) for b in bands))
    plug = r - groove - (0.004 if groove else 0.0)
    if bucket:
        lid = [
            (0, high - 0.004),
            (1.06 * r, high - 0.004),
            (1.06 * r, high + 0.05 * r),
            (0.9 * r, high + 0.05 * r),
            (0.88 * r, high + 0.01),
            (0, high + 0.01),
        ]
    else:
        lid = [
            (0, high - 0.05 * r),
            (plug, high - 0.05 * r),
            (plug, high + 0.012 * r),
            (0.9 * plug, high + 0.02 * r),
            (0.85 * plug, high - 0.01 * r),
            (0, high - 0.01 * r),
        ]
    m.add("lid", lathe(lid, n))
    m.slide("lid", (0, 0, 1), m.number(0.25, 0.8) * high)
    if m.chance(0.85):
        _bail(m, r, low, high, m.number(0.75, 0.86) if not bucket else 0.84)


def _bail(m: Model, r: float, low: float, high: float, share: float) -> None:
    """A wire from ear to ear, hanging at one side or upright, perhaps with a grip."""
    z, x = share * high, low + (r - low) * share
    wide = max(x + 0.006, 1.08 * r + 0.004 if low < r else 0.0)
    m.add(BASE, *(rod((s * 0.97 * x, 0, z), (s * wide, 0, z), 0.07 * r + 0.004, 12) for s in (-1, 1)))
    bow, upright_ = np.linspace(0, np.pi, 13), m.chance(0.4)
    tilt = 0 if upright_ else m.number(100, 135)
    lift = max(1.15 * r, high - z + 0.35 * r) if upright_ else 1.1 * wide / np.sin(np.deg2rad(tilt))
    side, up = lift * np.sin(np.deg2rad(tilt)), lift * np.cos(np.deg2rad(tilt))
    across, along = wide * np.sign(np.cos(bow)) * np.abs(np.cos(bow)) ** 0.6, np.sin(bow) ** 0.6
    path = [vec(x, -side * w, z + up * w) for x, w in zip(across, along, strict=True)]
    m.add("bail", tube([vec(wide - 0.005, 0, z), *path, vec(0.005 - wide, 0, z)], m.number(0.0015, 0.003), 6))
    if m.chance(0.5):
        m.add("bail", rod(path[6] - vec(0.04, 0, 0), path[6] + vec(0.04, 0, 0), 0.008, 10))
    m.hinge("bail", (0, 0, z), (-1, 0, 0), (-95, 95) if upright_ else (0, tilt))


def _square(m: Model) -> None:
    """A flat rectangular can with a screw cap and a strap handle."""
    wide, deep = m.number(0.08, 0.12), m.number(0.05, 0.08)
    high, n = m.number(0.14, 0.26), m.pick(12, 16, 24)
    m.add(BASE, prism(rounded((-wide, wide), (-deep, deep), 0.008), "z", (0.003, high)))
    m.add(
        BASE,
        *(
            prism(rounded((-wide - 0.002, wide + 0.002), (-deep - 0.002, deep + 0.002), 0.01), "z", z)
            for z in ((0, 0.006), (high - 0.003, high + 0.003))
        ),
    )
    x, r = m.pick(-1, 1) * m.number(0.3, 0.6) * wide, m.number(0.015, 0.022)
    m.add(BASE, rod((x, 0, high), (x, 0, high + 0.012), 0.85 * r, n))
    m.add("cap", rod((x, 0, high + 0.0062), (x, 0, high + 0.024), r, n))
    m.spin("cap", (x, 0, high), (0, 0, 1))
    a, b = -np.sign(x) * 0.85 * wide, -np.sign(x) * 0.05 * wide
    if m.chance(0.6):
        m.add(
            "handle",
            tube(
                [(a, -0.02, high + 0.004), (a, -0.02, high + 0.035), (b, -0.02, high + 0.035), (b, -0.02, high + 0.004)],
                0.003,
                6,
            ),
        )
        m.add(BASE, *(box((q - 0.008, q + 0.008), (-0.026, -0.014), (high, high + 0.009)) for q in (a, b)))
        m.hinge("handle", ((a + b) / 2, -0.02, high + 0.004), (1, 0, 0), (-75, 80))
    else:
        m.add(BASE, tube([(a, 0, high), (a, 0, high + 0.035), (b, 0, high + 0.035), (b, 0, high)], 0.005, 6))


def _spray(m: Model) -> None:
    """A spray can with a nozzle that is pressed under a cap that is taken off."""
    r, n = m.number(0.026, 0.034), m.pick(12, 16, 24)
    high = r * m.number(5, 7)
    shoulder = [
        (0, 0),
        (0.95 * r, 0),
        (r, 0.004),
        (r, high),
        (0.85 * r, high + 0.3 * r),
        (0.4 * r, high + 0.5 * r),
        (0.4 * r, high + 0.6 * r),
        (0, high + 0.6 * r),
    ]
    m.add(BASE, lathe(shoulder, n))
    up = high + 0.6 * r
    m.add(
        "nozzle",
        rod((0, 0, up - 0.001), (0, 0, up + 0.016), 0.3 * r, n),
        box((-0.002, 0.002), (-0.34 * r, 0), (up + 0.008, up + 0.012)),
    )
    m.slide("nozzle", (0, 0, -1), 0.005)
    if m.chance(0.6):
        top = up + 0.026
        wall = [
            (0.97 * r, high + 0.001),
            (r, high + 0.001),
            (0.97 * r, top),
            (0, top),
            (0, top - 0.003),
            (0.9 * r, top - 0.003),
            (0.97 * r, high + 0.001),
        ]
        m.add("cap", lathe(wall, n))
        m.slide("cap", (0, 0, 1), m.number(1.1, 2) * (top - high))
