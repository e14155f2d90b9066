"""Gantry cranes."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, rod, tube, vec
from training.kinds.wheels import beam


def _legs(m: Model, x: float, wide: float, top: float, low: float, t: float) -> None:
    """The two legs of a gantry at x: A frames, posts with struts or a portal, on a sill."""
    style = m.pick("frame", "posts", "portal")
    lean = 0.35 * wide if style == "frame" else wide * 0.9
    for s in (-1, 1):
        m.add("gantry", beam((x, s * wide, low), (x, s * (wide - lean if style == "frame" else wide), top), 2 * t, 2 * t))
        if style == "posts":
            m.add("gantry", beam((x, s * wide, 0.5 * top), (x, 0, top), t, t))
    m.add("gantry", box((x - t, x + t), (-wide - t, wide + t), (low - t, low + t)))
    m.add("gantry", box((x - t, x + t), (-wide - t * 0.9, wide + t * 0.9), (top - 2 * t, top)))
    if style != "posts":
        m.add(
            "gantry",
            box((x - 0.6 * t, x + 0.6 * t), (-wide, wide), (0.45 * top, 0.45 * top + 1.2 * t))
            if style == "portal"
            else beam((x, -0.8 * wide, 0.45 * top), (x, 0.8 * wide, 0.45 * top), t, t),
        )
    if style == "posts" and m.chance(0.5):
        m.add("gantry", *(rod((x, 0.25 * s * wide, low), (x, 0.25 * s * wide, top - t), 0.3 * t, 6) for s in (-1, 1)))


def _hook(m: Model, x: float, size: float, hangs: float, low: float) -> None:
    """A hook or a spreader on ropes."""
    top, drop = low - 0.55 * size * hangs, m.number(1.0, 2.0) * size
    for c in (-0.15 * size, 0.15 * size):
        m.add("hook", rod((x + c, 0, top), (x + c, 0, top - drop), 0.025 * size, 6))
    end = top - drop
    m.add("hook", box((x - 0.3 * size, x + 0.3 * size), (-0.14 * size, 0.14 * size), (end - 0.5 * size, end)))
    if m.chance(0.6):
        t = np.linspace(np.pi / 2, -np.pi, 10)
        path = [
            vec(x, 0, end - 0.5 * size),
            *(vec(x + 0.28 * size * np.cos(a), 0, end - 0.9 * size + 0.28 * size * np.sin(a)) for a in t),
        ]
        m.add("hook", tube(path, 0.07 * size, 8))
    else:
        m.add("hook", box((x - 1.2 * size, x + 1.2 * size), (-0.3 * size, 0.3 * size), (end - 0.75 * size, end - 0.45 * size)))
        m.add(
            "hook",
            *(
                box((x + s * 1.2 * size, x + s * 1.05 * size), (-0.3 * size, 0.3 * size), (end - 0.95 * size, end - 0.5 * size))
                for s in (-1, 1)
            ),
        )


def _trolley(m: Model, x: float, y: float, z: float, size: float, hangs: bool) -> None:
    """A carriage on or under the beams with a drum or a chain hoist, and the hook or spreader that it lowers."""
    low = z - 0.9 * size if hangs else z
    m.add("trolley", box((x - size, x + size), (-y, y), (low, low + 0.35 * size)))
    if hangs:
        m.add(
            "trolley",
            *(
                box((x + c - 0.1 * size, x + c + 0.1 * size), (s * (y - 0.06 * size), s * y), (low, z + 0.3 * size))
                for c in (-0.6 * size, 0.6 * size)
                for s in (-1, 1)
            ),
        )
    m.add(
        "trolley",
        rod(
            (x - 0.6 * size, 0, low + 0.3 * size * (-1 if hangs else 2)),
            (x + 0.6 * size, 0, low + 0.3 * size * (-1 if hangs else 2)),
            0.32 * size,
            14,
        ),
    )
    m.add(
        "trolley",
        box(
            (x + 0.6 * size, x + 0.95 * size),
            (-0.3 * size, 0.3 * size),
            (low - 0.4 * size * hangs, low + 0.8 * size * (not hangs) + 0.1 * size),
        ),
    )
    _hook(m, x, size, hangs, low)


def _wheeled_legs(m: Model, r: float, rails: bool, span: float, t: float, top: float, wide: float) -> None:
    """The legs at both ends of the bridge, on wheels; with rails below."""
    for k, x in enumerate((-span, span)):
        _legs(m, x, wide, top, 2.1 * r + t, t)
        if rails:
            m.add(
                BASE,
                box((x - 0.25 * r, x + 0.25 * r), (-3.2 * wide, 3.2 * wide), (-0.5 * r, 0)),
                box((x - r, x + r), (-3.3 * wide, 3.3 * wide), (-0.8 * r, -0.5 * r)),
            )
        for i, s in enumerate((-1, 1)):
            owner, part = "gantry" if rails else BASE, f"wheel_{k}{i}"
            m.add(
                owner,
                *(
                    box(
                        (x + c - 0.12 * r, x + c + 0.12 * r),
                        (s * wide - 0.5 * r, s * wide + 0.5 * r),
                        (0.8 * r, 2.4 * r + 0.2 * t),
                    )
                    for c in (-0.6 * r, 0.6 * r)
                ),
            )
            m.add(
                part,
                rod((x - 0.4 * r, s * wide, r), (x + 0.4 * r, s * wide, r), r, 16),
                rod((x - 0.75 * r, s * wide, r), (x + 0.75 * r, s * wide, r), 0.25 * r, 10),
            )
            m.spin(part, (x, s * wide, r), (1, 0, 0), owner)


def gantry_crane(m: Model) -> None:
    """A bridge on legs that runs on rails or wheels, a trolley along it and a hook below; cab, ladder, load."""
    small = m.chance(0.4)
    size = 0.16 if small else m.number(0.55, 0.8)
    span, top = (m.number(1.2, 2.0), m.number(2.2, 3.2)) if small else (m.number(5, 8), m.number(6, 9))
    wide, over = 0.22 * top, m.pick(0.0, 0.0, 0.25) * span
    rails, two = not small or m.chance(0.2), not small and m.chance(0.6)
    r, t = (0.075, 0.02 * top) if small else (0.05 * top, 0.035 * top)
    _wheeled_legs(m, r, rails, span, t, top, wide)
    ends, h = (-span - over - 0.05 * top, span + over + 0.05 * top), 0.07 * top
    if two:
        m.add("gantry", *(box(ends, (s * 0.9 * size, s * 1.5 * size), (top, top + h)) for s in (-1, 1)))
        m.add(
            "gantry",
            *(
                box((c, c + 0.3 * size) if c < 0 else (c - 0.3 * size, c), (-1.5 * size, 1.5 * size), (top, top + h))
                for c in ends
            ),
        )
    else:
        m.add(
            "gantry",
            box(ends, (-0.3 * size, 0.3 * size), (top, top + h)),
            *(box(ends, (-0.6 * size, 0.6 * size), (c, c + 0.2 * size)) for c in (top - 0.02 * size, top + h)),
        )
    at = m.number(-0.5, 0.5) * span
    if two:
        _trolley(m, at, 1.45 * size, top + h, size, False)
    else:
        _trolley(m, at, 0.75 * size, top - 0.05 * size, size, True)
    m.slide("trolley", (1, 0, 0), (-(at + span - 2 * size), span - 2 * size - at), "gantry")
    m.slide("hook", (0, 0, -1), min(0.35 * top, size), "trolley")  # the ropes, which are rigid, stay at the drum
    if rails:
        m.slide("gantry", (0, -1, 0), (-1.8 * wide, 1.8 * wide))
    else:
        m.pieces = [(BASE if p == "gantry" else p, s) for p, s in m.pieces]
        m.joints = {
            p: j if j.parent != "gantry" else type(j)(j.type, BASE, j.origin, j.axis, j.limits) for p, j in m.joints.items()
        }
    if not small and m.chance(0.6):
        side = m.pick(-1, 1)
        m.add(
            "gantry",
            box((side * (span - 0.3), side * (span - 1.6)), (-0.7 - size, 0.7 - size), (top - 2.2, top - 0.4)),
            box((side * (span - 0.2), side * (span - 1.7)), (-0.8 - size, 0.8 - size), (top - 0.4, top - 0.02)),
        )
    if m.chance(0.4) and rails:
        load = 1.2 * size
        m.add(BASE, box((at - 2 * load, at + 2 * load), (-load, load), (-0.8 * r, 1.5 * load)))
