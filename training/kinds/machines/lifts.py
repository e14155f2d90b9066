"""Boom lifts."""

from __future__ import annotations

import numpy as np

from training.kinds.machines.tracked import crawler
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rod, rounded, vec
from training.kinds.wheels import axled, beam, wheel_maker


def _basket(m: Model, part: str, at: np.ndarray, wide: float, deep: float, gate: bool) -> None:
    """A floor with rails round it before a point, a control box and perhaps a gate that swings inwards."""
    x, y, z, t = (-wide / 2, wide / 2), (at[1] - deep, at[1]), at[2] - 0.1, 0.022
    m.add(part, box(x, y, (z - 0.05, z)), *(box(x, (c - 0.01, c + 0.01), (z, z + 0.12)) for c in (y[0] + 0.01, y[1] - 0.01)))
    heights = (z + 0.55, z + 1.08)
    for s in (-1, 1):
        c, opened = s * (wide / 2 - t), gate and s == 1
        posts = (y[0] + t, y[1] - t, *((y[0] + 0.2, y[1] - 0.2) if opened else ()))
        m.add(part, *(rod((c, b, z - 0.02), (c, b, heights[1]), t, 8) for b in posts))
        pieces = ((y[0] + t, y[0] + 0.2), (y[1] - 0.2, y[1] - t)) if opened else ((y[0] + t, y[1] - t),)
        m.add(part, *(rod((c, a, h), (c, b, h), t, 8) for a, b in pieces for h in heights))
    m.add(part, *(rod((x[0] + t, b, h), (x[1] - t, b, h), t, 8) for b in (y[0] + t, y[1] - t) for h in heights))
    if gate:
        c, a, b = wide / 2 - t, y[0] + 0.245, y[1] - 0.245
        m.add(
            "gate",
            *(rod((c, a, h), (c, b, h), 0.018, 8) for h in heights),
            *(rod((c, e, z + 0.1), (c, e, heights[1] + 0.018), 0.018, 8) for e in (a, b)),
        )
        m.add("gate", rod((c, a, z + 0.1), (c, b, z + 0.1), 0.018, 8))
        m.hinge("gate", (c, a, z), (0, 0, 1), m.pick(85, 100), part)
    m.add(part, box((-0.2, 0.2), (y[0] + 0.03, y[0] + 0.2), (heights[1] - 0.12, heights[1] + 0.06)))
    m.add(part, *(rod((c, y[0] + 0.12, heights[1] + 0.05), (c, y[0] + 0.12, heights[1] + 0.12), 0.012, 6) for c in (-0.1, 0.1)))


def _lift_base(m: Model, half: float, long: float) -> float:
    """What a boom lift stands on: wheels, tracks or a trailer with struts; returns the height of its deck."""
    style = m.pick("wheels", "wheels", "tracks", "trailer")
    if style == "tracks":
        for s in (-1, 1):
            crawler(m, "track_" + "lr"[s > 0], s, half - 0.16, 0.28, np.linspace(-0.32, 0.32, 3) * long, 0.16, 0.06, 0.9)
        m.add(BASE, box((-half + 0.25, half - 0.25), (-0.3 * long, 0.3 * long), (0.2, 0.62)))
        return 0.62
    r = m.number(0.3, 0.42)
    make = wheel_maker(m, ("tyre", "disc", "lathed", "rim"), 0.4)
    ys = (-0.34 * long, 0.34 * long) if style == "wheels" else (0.1,)
    for k, y in enumerate(ys):
        axled(m, make, (-half, half), y, r, 0.28, f"axle_{k}")
        m.add(BASE, rod((-half + 0.25, y, r), (half - 0.25, y, r), 0.09, 8))
    high = 1.5 * r
    m.add(BASE, prism(rounded((-half + 0.32, half - 0.32), (-0.42 * long, 0.42 * long), 0.1), "z", (0.8 * r, high + 0.15)))
    if style == "trailer":
        m.add(BASE, *(beam((s * 0.35, 0.4 * long, r), (0, 0.85 * long, r), 0.08, 0.1) for s in (-1, 1)))
        m.add(
            BASE, rod((0, 0.82 * long, r), (0, 0.95 * long, r), 0.05, 8), rod((0, 0.8 * long, 0.1), (0, 0.8 * long, r), 0.03, 8)
        )
        for k, (s, e) in enumerate((s, e) for s in (-1, 1) for e in (-1, 1)):
            p = vec(s * (half - 0.3), e * 0.42 * long, high)
            foot = p + vec(s * 0.12, e * 0.08, 0.9)
            m.add(f"strut_{k}", beam(p, foot, 0.08, 0.08), rod(foot - (0, 0, 0.0), foot + vec(0, 0, 0.03), 0.12, 12))
            m.add(BASE, box((p[0] - 0.07, p[0] + 0.07), (p[1] - 0.07, p[1] + 0.07), (0.8 * r, high)))
            m.hinge(f"strut_{k}", p, (0, s, 0), 120)
    return high + 0.15


def _turntable(m: Model, floor: float, half: float, rear: float) -> None:
    """What turns on the carrier: a plate, covers at both sides, a counterweight."""
    m.add("turntable", box((-half + 0.25, half - 0.25), (-0.5, rear), (floor, floor + 0.12)))
    for s in (-1, 1):
        cover = prism(
            rounded((-0.3, rear - 0.05), (floor + 0.12, floor + m.number(0.55, 0.75)), 0.1),
            "x",
            tuple(sorted((s * 0.24, s * (half - 0.22)))),
        )
        m.add("turntable", cover)
        m.add(
            "turntable",
            *(
                box((s * (half - 0.22), s * (half - 0.21)), (c, c + 0.04), (floor + 0.25, floor + 0.45))
                for c in np.arange(0.1, 0.5, 0.09)
            ),
        )
    m.add("turntable", box((-half + 0.2, half - 0.2), (rear - 0.12, rear + 0.15), (floor, floor + 0.55)))
    m.spin("turntable", (0, 0, floor), (0, 0, 1))


def boom_lift(m: Model) -> None:
    """A platform on a boom: a turntable, one boom that runs out or two that fold, a jib, a basket that turns, a gate."""
    half, long = m.number(0.85, 1.2), m.number(2.2, 3.2)
    deck = _lift_base(m, half, long)
    floor, rear = deck + 0.08, 0.5 * long
    m.add(BASE, rod((0, 0, deck - 0.05), (0, 0, floor - 0.005), 0.42, 20))
    _turntable(m, floor, half, rear)
    pivot, w = vec(0, rear - 0.2, floor + 0.95), 0.2
    m.add(
        "turntable",
        *(box((s * 0.14, s * 0.2), (pivot[1] - 0.14, pivot[1] + 0.14), (floor + 0.1, pivot[2] + 0.12)) for s in (-1, 1)),
    )
    last, tip = "boom", pivot - vec(0, m.number(2.6, 3.6), 0)
    if m.chance(0.45):  # a lower boom that lies below the upper one, which folds back over it
        end = pivot - vec(0, m.number(1.5, 2.0), 0)
        m.add("riser", beam(pivot, end, w, 0.18), rod(pivot - (0.18, 0, 0), pivot + vec(0.18, 0, 0), 0.05, 10))
        m.add(
            "riser", *(box((s * 0.1, s * 0.14), (end[1] - 0.1, end[1] + 0.12), (end[2] - 0.12, end[2] + 0.42)) for s in (-1, 1))
        )
        m.hinge("riser", pivot, (-1, 0, 0), m.pick(65, 75), "turntable")
        start = end + vec(0, 0, 0.32)
        tip = start + vec(0, m.number(2.0, 2.6), 0)
        m.add("boom", beam(start, tip, w, 0.16), rod(start - (0.14, 0, 0), start + vec(0.14, 0, 0), 0.05, 10))
        m.hinge("boom", start, (1, 0, 0), m.pick(120, 150), "riser")
        _boom_end(m, tip, 1, last)
        return
    m.add(
        "boom",
        beam(pivot + vec(0, 0.1, 0), tip, w, m.number(0.2, 0.26)),
        rod(pivot - (0.2, 0, 0), pivot + vec(0.2, 0, 0), 0.05, 10),
    )
    m.add(
        "boom",
        *(
            box((-w / 2 - 0.02, w / 2 + 0.02), (c, c + 0.06), (pivot[2] - 0.14, pivot[2] + 0.14))
            for c in (tip[1], tip[1] + 0.9)
        ),
    )
    m.hinge("boom", pivot, (-1, 0, 0), m.pick(65, 75), "turntable")
    for k in range(m.pick(0, 1, 1, 2)):
        part, size = f"section_{k}", w - 0.04 * (k + 1)
        m.add(part, beam(tip + vec(0, 1.8, 0), tip - (0, 0.22, 0), size, size))
        m.slide(part, (0, -1, 0), 1.4, last)
        tip, last = tip - vec(0, 0.22, 0), part
    _boom_end(m, tip, -1, last)


def _boom_end(m: Model, tip: np.ndarray, way: int, last: str) -> None:
    """A jib that tilts, in some, and the basket on its pin; way: the side of y at which they lie."""
    if m.chance(0.5):
        end = tip + vec(0, way * m.number(0.6, 1.0), -0.12)
        m.add(
            "jib",
            *(beam(tip + vec(0, 0, c), end + vec(0, 0, c), 0.12, 0.06) for c in (-0.06, 0.06)),
            rod(tip - (0.1, 0, 0), tip + vec(0.1, 0, 0), 0.07, 10),
        )
        m.hinge("jib", tip, (way, 0, 0), (-50, 60), last)
        tip, last = end, "jib"
    wide, deep = m.number(1.0, 1.9), m.number(0.75, 0.95)
    pin = tip + vec(0, way * 0.08, 0)
    m.add(last, box((-0.08, 0.08), tuple(sorted((tip[1], pin[1]))), (tip[2] - 0.08, tip[2] + 0.08)))
    inner = Model(m.rng)
    m.add("basket", rod(pin - (0, 0, 0.3), pin + vec(0, 0, 0.14), 0.06, 10))
    m.add("basket", box((-0.3, 0.3), tuple(sorted((pin[1] - 0.03, pin[1] + way * 0.12))), (pin[2] - 0.32, pin[2] - 0.16)))
    m.add("basket", box((-0.05, 0.05), tuple(sorted((pin[1], pin[1] + way * 0.12))), (pin[2] - 0.22, pin[2] + 0.1)))
    if m.chance(0.65):
        m.hinge("basket", pin, (0, 0, 1), (-80, 80), last)
    else:  # it is kept level
        m.hinge("basket", pin, (way, 0, 0), (-40, 70), last)
    _basket(inner, "basket", vec(0, -0.12, -0.22), wide, deep, m.chance(0.6))
    flip = np.array([1.0, 1, 1]) if way < 0 else np.array([-1.0, -1, 1])
    for part, solid in inner.pieces:
        solid.vertices = solid.vertices * flip + pin
        m.add(part, solid)
    for part, j in inner.joints.items():
        m.hinge(part, j.origin * flip + pin, j.axis * flip, tuple(np.degrees(j.limits)), "basket")
