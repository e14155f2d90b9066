"""Film cameras on tripods: the legs, the head that pans and tilts, the camera on it."""

from __future__ import annotations

import numpy as np

from training.kinds.bench_style import STYLES, bar, body
from training.kinds.electronics.bench_cameras import CAMERAS
from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, cut, rod, vec


def film_camera_on_tripod(m: Model) -> None:
    """Three legs that fold and may be drawn out, a column, a head that pans and tilts with a film camera on it."""
    style, n = m.pick(*STYLES), max(10, m.sections())
    h, spread = m.number(0.55, 1.2), np.deg2rad(m.number(18, 26))
    r = m.number(0.012, 0.016)
    hub = 0.042
    if style in ("game", "sheet"):
        m.add(BASE, rod((0, 0, h - 0.025), (0, 0, h + 0.025), hub, 6 if style == "game" else n))
    else:
        m.add(BASE, cut(rod((0, 0, h - 0.025), (0, 0, h + 0.025), hub, n), rod((0, 0, 0), (0, 0, 3), r + 0.0005, n)))
        m.add(
            BASE,
            *(
                s.apply_translation((0, 0, h)) or s
                for s in around(box((hub - 0.008, hub + 0.01), (-0.017, 0.017), (-0.02, 0.012)), 3, 90)
            ),
        )
    for k, t in enumerate(np.deg2rad([90, 210, 330])):
        _leg(m, style, k, vec(np.cos(t), np.sin(t), 0), hub + 0.008, h - 0.006, spread, n)
    top, parent = h + m.number(0.06, 0.14), BASE
    if m.chance(0.6):
        parent, drop = "column", m.number(0.1, 0.2) * h + 0.06
        m.add("column", rod((0, 0, h - drop), (0, 0, top), r, n), rod((0, 0, h - drop - 0.008), (0, 0, h - drop), 1.2 * r, n))
        m.slide("column", (0, 0, 1), (-0.4 * (top - h - 0.03), 0.45 * drop))
        sleeve = rod((0, 0, h - 0.03 - 0.3 * drop), (0, 0, h - 0.02), r + 0.004, n)
        m.add(BASE, cut(sleeve, rod((0, 0, 0), (0, 0, 3), r + 0.0005, n)))
        if m.chance(0.5):
            _column_crank(m, h, hub)
    else:
        m.add(BASE, rod((0, 0, h), (0, 0, top), r, n))
    _head(m, style, top, parent, n)


def _column_crank(m: Model, h: float, hub: float) -> None:
    """A small crank at the hub for the column."""
    a = vec(hub - 0.006, 0, h + 0.012)
    m.add(
        "column_crank",
        rod(a, a + vec(0.022, 0, 0), 0.006, 8),
        bar(a + vec(0.019, 0, 0), a + vec(0.019, 0.0, 0.035), 0.009, 0.005, (0, 1, 0)),
    )
    m.add("column_crank", rod(a + vec(0.018, 0, 0.031), a + vec(0.036, 0, 0.031), 0.005, 8))
    m.spin("column_crank", a, (1, 0, 0))


def _leg(m: Model, style: str, k: int, out: np.ndarray, hub: float, z: float, spread: float, n: int) -> None:
    """A leg from the hub to the floor: one tube or two strips, a lower piece that is pushed in."""
    a = hub * out + vec(0, 0, z)
    along = np.sin(spread) * out - vec(0, 0, np.cos(spread))
    long = z / np.cos(spread) - 0.006
    side = np.cross(out, vec(0, 0, 1))
    drawn = m.joints.get("lower_leg_0") is not None if k else m.chance(0.6)
    share = 0.58 if drawn else 1.0
    mid, end, part = a + share * long * along, a + long * along, f"leg_{k}"
    strips = style in ("old", "cad")
    if strips:
        m.add(part, *(bar(a + s * 0.011 * side, mid + s * 0.011 * side, 0.018, 0.006, out) for s in (-1, 1)))
        m.add(
            part,
            *(
                bar(p - 0.014 * side, p + 0.014 * side, 0.012, 0.006, out)
                for p in (a + 0.12 * long * along, mid - 0.01 * along)
            ),
        )
        m.add(part, rod(a - 0.018 * side, a + 0.018 * side, 0.005, 8))
    else:
        m.add(part, rod(a - 0.006 * along, mid, 0.011, n if style != "game" else 6))
        m.add(part, rod(mid - 0.03 * along, mid, 0.014, 8))
    m.hinge(part, a, side, (-float(np.rad2deg(spread)) + 2, 20))
    foot = part
    if drawn:
        foot = f"lower_leg_{k}"
        begin = mid - 0.15 * long * along
        m.add(foot, bar(begin, end, 0.014, 0.0155, out) if strips else rod(begin, end, 0.008, n))
        m.slide(foot, -along, (-0.08 * long, 0.36 * long), part)
    m.add(foot, ball(end, (0.012, 0.012, 0.012), 8))


def _head(m: Model, style: str, z: float, parent: str, n: int) -> None:
    """A turntable, a fork or a block that tilts, a handle to steer it."""
    m.add("pan_head", rod((0, 0, z - 0.002), (0, 0, z + 0.022), 0.03, n))
    m.spin("pan_head", (0, 0, z), (0, 0, 1), parent)
    c = vec(0, 0, z + 0.046)
    if style in ("game", "sheet"):
        m.add("pan_head", box((-0.016, 0.016), (-0.018, 0.018), (z + 0.02, c[2] + 0.008)))
    else:
        m.add(
            "pan_head",
            *(box((s * 0.022 - 0.005, s * 0.022 + 0.005), (-0.018, 0.018), (z + 0.02, c[2] + 0.014)) for s in (-1, 1)),
        )
        m.add(
            "camera",
            rod(c - vec(0.017, 0, 0), c + vec(0.017, 0, 0), 0.016, n),
            rod(c - vec(0.03, 0, 0), c + vec(0.03, 0, 0), 0.006, 8),
        )
    plate = c[2] + 0.024
    m.add("camera", box((-0.01, 0.01), (-0.012, 0.012), (c[2] - 0.004, plate - 0.004)))
    m.add("camera", body(style, (-0.032, 0.032), (-0.04, 0.04), (plate - 0.008, plate)))
    m.hinge("camera", c, (1, 0, 0), m.pick((-30, 35), (-25, 60)), "pan_head")
    if m.chance(0.6):
        a, b = vec(0.012, 0.036, plate - 0.005), vec(0.05, 0.2, c[2] - 0.07)
        m.add("camera", rod(a, b, 0.005, 8), rod(a + 0.55 * (b - a), b + 0.05 * (b - a), 0.011, n))
    if m.chance(0.5):
        k = vec(-0.027, 0, z + 0.011)
        m.add(
            "pan_lock",
            rod(k, k - vec(0.016, 0, 0), 0.004, 8),
            rod(k - vec(0.014, 0, 0), k - vec(0.026, 0, 0), 0.009, m.pick(6, 12)),
        )
        m.spin("pan_lock", k, (-1, 0, 0), "pan_head")
    m.pick(*CAMERAS)(m, style, plate, n)
