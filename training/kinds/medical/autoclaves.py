"""Autoclaves."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_parts import rack
from training.kinds.kitchen_trims import dial, feet
from training.kinds.medical.upright_vessels import upright_vessel
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam


def _port(m: Model, at: np.ndarray, r: float, long: float, n: int) -> None:
    """The chamber behind a point of the front, with its flange and its racks."""
    back = at + vec(0, long, 0)
    m.add(BASE, cut(rod(at - vec(0, 0.02, 0), back, r + 0.008, n), rod(at - vec(0, 1, 0), back - vec(0, 0.01, 0), r, n)))
    flange = cut(
        rod(at - vec(0, 0.025, 0), at - vec(0, 0.002, 0), r + 0.03, n), rod(at - vec(0, 1, 0), at + vec(0, 1, 0), r, n)
    )
    m.add(BASE, flange)
    half = 0.8 * r
    for k in range(m.pick(1, 2, 3)):
        z = at[2] + (-0.45 + 0.38 * k) * r
        if k == 0 or m.chance(0.7):
            rack(m, f"tray_{k}", (-half, half), (at[1] + 0.02, at[1] + 0.8 * long), z)
            m.add(f"tray_{k}", box((-half, half), (at[1] + 0.015, at[1] + 0.02), (z, z + 0.025)))
            m.add(
                BASE,
                *(
                    box(
                        (s * half, s * 0.97 * np.sqrt(r * r - (z - at[2]) ** 2)),
                        (at[1] + 0.03, at[1] + 0.85 * long),
                        (z - 0.006, z - 0.001),
                    )
                    for s in (-1, 1)
                ),
            )
            m.slide(f"tray_{k}", (0, -1, 0), 0.6 * long)


def _port_door(m: Model, at: np.ndarray, r: float, n: int) -> None:
    """A thick round or square door that swings on an arm, with a wheel, a lever or a grab handle."""
    s, part, t, front = m.pick(-1, 1), "door", m.number(0.03, 0.05), vec(0, -0.026, 0)
    y = at[1] + front[1]
    if m.chance(0.6):
        m.add(
            part,
            rod(at + front, at + front - vec(0, t, 0), r + 0.035, n),
            rod(at + front - vec(0, t, 0), at + front - vec(0, t + 0.015, 0), 0.7 * r, n),
        )
    else:
        w = r + 0.045
        m.add(part, prism(rounded((at[0] - w, at[0] + w), (at[2] - w, at[2] + w), 0.25 * r), "y", (y - t, y)))
    pivot = vec(at[0] + s * (r + 0.075), y - 0.5 * t, at[2])
    m.add(part, box((at[0] + s * 0.5 * r, pivot[0]), (y - t - 0.018, y - t + 0.004), (at[2] - 0.16 * r, at[2] + 0.16 * r)))
    m.add(part, box((pivot[0] - 0.012, pivot[0] + 0.012), (y - t - 0.018, pivot[1]), (at[2] - 0.16 * r, at[2] + 0.16 * r)))
    m.add(BASE, *(rod(pivot + vec(0, 0, a * r), pivot + vec(0, 0, b * r), 0.016, 10) for a, b in ((-0.4, -0.17), (0.17, 0.4))))
    m.add(
        BASE,
        *(
            box((pivot[0] - 0.01, pivot[0] + 0.01), (pivot[1], at[1]), (at[2] + c * r - 0.02, at[2] + c * r + 0.02))
            for c in (-0.3, 0.3)
        ),
    )
    m.hinge(part, pivot, (0, 0, s), m.number(95, 130))
    _port_lock(m, at, t, y, part, r, s)


def _port_lock(m: Model, at: np.ndarray, t: float, y: float, part: str, r: float, s: int) -> None:
    """The wheel, bar, lever or grab handle of a door."""
    hub, style = at + vec(0, y - at[1] - t - 0.018, 0), m.pick("wheel", "bar", "grab", "lever")
    if style == "grab":
        c = at[0] - s * 0.85 * r
        m.add(
            part,
            tube(
                [
                    (c, y - t, at[2] - 0.05),
                    (c, y - t - 0.05, at[2] - 0.05),
                    (c, y - t - 0.05, at[2] + 0.05),
                    (c, y - t, at[2] + 0.05),
                ],
                0.01,
                8,
            ),
        )
        return
    out, e = hub - vec(0, 0.06, 0), m.number(0.5, 0.75) * r
    m.add("lock", rod(hub, out, 0.014, 10))
    if style == "wheel":
        m.add("lock", ring(out, (0, 1, 0), e, 0.01, 20))
        ways = [e * vec(np.cos(a), 0, np.sin(a)) for a in np.pi * np.arange(m.pick(2, 3)) / 3]
        m.add("lock", *(rod(out - w, out + w, 0.007, 6) for w in ways))
        m.spin("lock", hub, (0, -1, 0), part)
    elif style == "bar":
        m.add(
            "lock",
            rod(out - vec(0.8 * e, 0, 0), out + vec(0.8 * e, 0, 0), 0.011, 8),
            *(ball(out + vec(c * 0.8 * e, 0, 0), (0.018,) * 3, 8) for c in (-1, 1)),
        )
        m.spin("lock", hub, (0, -1, 0), part)
    else:
        m.add("lock", beam(out, out - vec(s * e, 0.01, 0), 0.03, 0.016, (0, 0, 1)))
        m.hinge("lock", hub, (0, s, 0), m.pick(45, 90), part)


def _drum(m: Model, at: np.ndarray, r: float, deep: float, n: int) -> None:
    """The frame of a drum, and the gauge and the valve on it."""
    m.add(BASE, *(rod(at + vec(0, c * deep, 0), at + vec(0, c * deep + 0.04, 0), r + 0.025, n) for c in (0.2, 0.7)))
    m.add(
        BASE,
        *(box((a - 0.025, a + 0.025), (b, b + 0.05), (0, at[2] - 0.3 * r)) for a in (-r, r) for b in (0.2 * deep, 0.7 * deep)),
    )
    m.add(BASE, *(box((a - 0.02, a + 0.02), (0.2 * deep, 0.7 * deep), (0.15, 0.19)) for a in (-r, r)))
    m.add(
        BASE,
        rod(at + vec(0, 0.4 * deep, r), at + vec(0, 0.4 * deep, r + 0.09), 0.012, 8),
        rod(at + vec(0, 0.4 * deep - 0.012, r + 0.12), at + vec(0, 0.4 * deep + 0.012, r + 0.12), 0.05, n),
    )
    top = at + vec(0, 0.55 * deep, r)
    m.add(BASE, rod(top, top + vec(0, 0, 0.06), 0.014, 8))
    dial(m, "valve", top + vec(0, 0, 0.06), (0, 0, 1), 0.035)


def autoclave(m: Model) -> None:
    """A bench autoclave, a drum on a frame, or one that stands upright; a heavy door or lid, trays, gauges and knobs."""
    style = m.pick("bench", "bench", "drum", "upright")
    if style == "upright":
        upright_vessel(m)
        return
    r, n = m.number(0.11, 0.17) if style == "bench" else m.number(0.2, 0.32), m.sections() + 8
    if style == "bench":
        half, side, deep = r + m.number(0.09, 0.13), m.number(0.0, 0.14), m.number(0.45, 0.6)
        low, z = 0.03, m.number(0.4, 0.52)
        x, lift = (-half, half + side), m.number(r + 0.07, r + 0.1)
        at = vec(0, 0, low + lift)
        z = max(z, lift + r + 0.06 + (0.09 if side < 0.1 else 0.0))
        case = box(x, (0, deep), (low, low + z)) if m.chance(0.5) else prism(rounded(x, (low, low + z), 0.03), "y", (0, deep))
        m.add(BASE, cut(case, rod(at - vec(0, 1, 0), at + vec(0, deep - 0.05, 0), r + 0.007, n)))
        feet(m, x, (0, deep), low)
        wall = (half + 0.02, half + side) if side > 0.1 else (0.02, half - 0.02)
        span = (low + 0.08, low + z - 0.02) if side > 0.1 else (low + lift + r + 0.055, low + z - 0.01)
        for k in range(m.pick(1, 2, 3) if side > 0.1 else 1):
            dial(
                m,
                f"dial_{k}",
                (middle(wall), 0, span[0] + (k + 0.5) * (span[1] - span[0]) / 4),
                (0, -1, 0),
                min(0.022, 0.4 * (span[1] - span[0])),
            )
        m.add(BASE, box((wall[0], wall[1]) if side > 0.1 else (-half + 0.03, -0.02), (-0.003, 0), (span[1] - 0.06, span[1])))
        if m.chance(0.6):
            m.add("filler", rod((0.3 * half, 0.3 * deep, low + z), (0.3 * half, 0.3 * deep, low + z + 0.02), 0.03, n))
            m.spin("filler", (0.3 * half, 0.3 * deep, low + z), (0, 0, 1))
        _port(m, at, r, deep - 0.07, n)
    else:
        deep, at = m.number(0.7, 1.1), vec(0, 0, m.number(0.8, 1.0))
        _drum(m, at, r, deep, n)
        _port(m, at, r, deep, n)
    _port_door(m, at, r, n)
