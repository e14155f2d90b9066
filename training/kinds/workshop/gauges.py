"""Calipers and micrometers."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot
from shapely.geometry import Polygon
from shapely.geometry import box as area

from training.kinds.model import BASE, Model
from training.kinds.small.slim_things import tipped
from training.kinds.solids import box, prism, rod, rounded, vec

LIP = 0.0025  # how far the slider stands over the rule [m]


def caliper(m: Model) -> None:
    """A rule with a fixed and a sliding jaw and a lock screw; plain, with a dial or digital; or a micrometer."""
    style = m.pick("vernier", "vernier", "digital", "dial", "micrometer")
    if style == "micrometer":
        _micrometer(m)
    else:
        _sliding(m, style)
    if m.chance(0.4):
        tipped(m, (1, 0, 0), -90)


def _sliding(m: Model, style: str) -> None:
    """A rule along X whose jaws point down, with small jaws above; it lies in XZ."""
    long, high, half, n = m.number(0.18, 0.3), m.number(0.013, 0.018), m.number(0.0015, 0.002), m.pick(10, 16, 24)
    deep, small = m.number(0.035, 0.05), m.number(0.012, 0.02) if m.chance(0.8) else 0.0
    start, body = m.pick(0.0, 0.0, m.number(0.01, 0.06)), m.number(0.05, 0.075)
    fixed = [(0, 0), (0, -deep), (-0.004, -deep), (-0.018, -0.008), (-0.018, high), (-0.004, high)]
    m.add(BASE, box((-0.015, long), (-half, half), (0, high)), prism(fixed, "y", (-half, half)))
    if small:
        upper = [(-0.016, high), (0, high), (0, high + 0.006), (-0.003, high + small), (-0.006, high + 0.008)]
        m.add(BASE, prism(upper, "y", (-half, 0)))
    x = start + 0.0004
    _slider(m, x, body, high, half, deep, small)
    m.slide("jaw", (1, 0, 0), (-start, 0.9 * (long - body - start)))
    if m.chance(0.7):
        m.add("jaw", box((x + 0.9 * body, long - 0.002), (half + 0.0004, half + 0.0016), (0.4 * high, 0.6 * high)))
    _screws(m, x, body, high + LIP, half, n)
    if style == "vernier":
        lines = [(x + 0.006 + k * 0.0035, x + 0.0065 + k * 0.0035) for k in range(11)]
        m.add("jaw", *(box(at, (-half - 0.0023, -half - 0.001), (0, 0.005)) for at in lines))
        marks = [(k * 0.01, k * 0.01 + 0.0006) for k in range(int(long / 0.01))]
        m.add(BASE, *(box(at, (-half - 0.00015, 0), (0.2 * high, 0.55 * high)) for at in marks))
    elif style == "dial":
        _dial(m, vec(x + 0.5 * body, -half - 0.002, high / 2 - 0.004), n)
    else:
        _display(m, x, body, high, -half - 0.002)


def _slider(m: Model, x: float, body: float, high: float, half: float, deep: float, small: float) -> None:
    """A sleeve of four plates round the rule with a long jaw below and perhaps a small one above."""
    along, top = (x, x + body), high + LIP
    m.add(
        "jaw", box(along, (-half - 0.002, -half - 0.0002), (-LIP, top)), box(along, (half + 0.0002, half + 0.0018), (-LIP, top))
    )
    for z in ((-LIP - 0.002, -0.0002), (high + 0.0002, top + 0.002)):
        m.add("jaw", box(along, (-half - 0.002, half + 0.0018), z))
    m.add("jaw", prism([(x, -LIP), (x, -deep), (x + 0.004, -deep), (x + 0.022, -0.01), (x + 0.024, -LIP)], "y", (-half, half)))
    if small:
        upper = [(x + 0.018, top), (x, top), (x, high + 0.006), (x + 0.003, high + small), (x + 0.006, high + 0.01)]
        m.add("jaw", prism(upper, "y", (0, half)))


def _screws(m: Model, x: float, body: float, top: float, half: float, n: int) -> None:
    """A lock screw above and a thumb wheel below."""
    if m.chance(0.85):
        a = vec(x + m.number(0.4, 0.7) * body, 0, top)
        m.add("lock_screw", rod(a, a + vec(0, 0, 0.006), 0.002, 8), rod(a + vec(0, 0, 0.005), a + vec(0, 0, 0.011), 0.0045, n))
        m.spin("lock_screw", a, (0, 0, 1), "jaw")
    if m.chance(0.6):
        wheel = vec(x + 0.85 * body, 0, -LIP - 0.004)
        if m.chance(0.4):
            m.add(
                "jaw",
                prism(
                    [(wheel[0] - 0.01, -LIP), (wheel[0] + 0.006, -LIP - 0.009), (wheel[0] + 0.006, -LIP)], "y", (-half, half)
                ),
            )
            return
        m.add("thumb_wheel", rod(wheel - vec(0, half, 0), wheel + vec(0, half, 0), 0.006, n))
        m.spin("thumb_wheel", wheel, (0, 1, 0), "jaw")


def _dial(m: Model, at: np.ndarray, n: int) -> None:
    r = m.number(0.017, 0.021)
    y = at[1]
    m.add("jaw", rod(at, at - vec(0, 0.006, 0), r, 24))
    ring = Dot(at[0], at[2]).buffer(1.08 * r, quad_segs=n).difference(Dot(at[0], at[2]).buffer(0.9 * r, quad_segs=n))
    m.add("bezel", prism(ring, "y", (y - 0.009, y - 0.003)))
    m.spin("bezel", at, (0, -1, 0), "jaw")
    m.add("needle", box((at[0] - 0.0005, at[0] + 0.0005), (y - 0.0075, y - 0.0065), (at[2] - 0.2 * r, at[2] + 0.8 * r)))
    m.add("needle", rod(at - vec(0, 0.006, 0), at - vec(0, 0.008, 0), 0.0018, 8))
    m.spin("needle", at, (0, -1, 0), "jaw")


def _display(m: Model, x: float, body: float, high: float, y: float) -> None:
    """A case with a screen and two or three buttons."""
    low, top, out = -0.008, high + 0.004, y - m.number(0.005, 0.008)
    m.add("jaw", prism(rounded((x + 0.002, x + body), (low, top), 0.003), "y", (out, y)))
    m.add("jaw", box((x + 0.008, x + 0.65 * body), (out - 0.0006, out), (low + 0.009, top - 0.003)))
    for k in range(m.pick(2, 3)):
        at = x + 0.2 * body + 0.22 * body * k
        m.add(f"button_{k}", rod((at, out + 0.0005, low + 0.005), (at, out - 0.0014, low + 0.005), 0.0028, m.pick(8, 14)))
        m.slide(f"button_{k}", (0, 1, 0), 0.0012, "jaw")


def _micrometer(m: Model) -> None:
    """A bow with an anvil; a thimble with its spindle turns, a ratchet at its end and a lock."""
    gap, thick, n = m.number(0.025, 0.06), m.number(0.005, 0.008), m.pick(12, 16, 24)
    r = 0.5 * gap + 0.008
    center = gap / 2
    bow: Polygon = Dot(center, 0).buffer(r + 0.014, quad_segs=8).difference(Dot(center, 0).buffer(r, quad_segs=8))
    m.add(BASE, prism(bow.intersection(area(-1, -1, 1, 0.0)), "y", (-thick / 2, thick / 2)))
    for low in (center - r - 0.014, center + r):
        m.add(BASE, box((low, low + 0.014), (-thick / 2, thick / 2), (-0.001, 0.005)))
    m.add(BASE, rod((center - r - 0.005, 0, 0), (0, 0, 0), 0.0033, n), rod((center + r, 0, 0), (gap + 0.055, 0, 0), 0.0045, n))
    shut = m.number(0.1, 0.9) * gap
    turn, a = "thimble", gap + m.number(0.03, 0.04)
    m.add(turn, rod((shut, 0, 0), (a + 0.02, 0, 0), 0.0032, n))
    m.add(turn, rod((a, 0, 0), (a + 0.03, 0, 0), 0.0068, n), rod((a + 0.03, 0, 0), (a + 0.036, 0, 0), 0.0055, n))
    m.spin(turn, (a, 0, 0), (1, 0, 0))
    if m.chance(0.7):
        m.add("ratchet", rod((a + 0.0362, 0, 0), (a + 0.047, 0, 0), m.number(0.003, 0.005), m.pick(8, 12)))
        m.spin("ratchet", (a + 0.036, 0, 0), (1, 0, 0), turn)
    if m.chance(0.6):
        x = center + r + 0.007
        lock = vec(x, -thick / 2, 0)
        m.add(
            "lock",
            rod(lock, lock - vec(0, 0.003, 0), 0.0035, 8),
            box((x - 0.0015, x + 0.0015), (-thick / 2 - 0.003, -thick / 2), (0, 0.011)),
        )
        m.hinge("lock", lock, (0, 1, 0), (0, 60))
