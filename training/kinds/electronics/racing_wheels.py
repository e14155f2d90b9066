"""Racing wheels with pedals."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot
from trimesh import Trimesh

from training.kinds.electronics.controls import knob
from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rectangle, ring, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, lathe

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def racing_wheel(m: Model) -> None:
    """A steering wheel on a housing with clamps or on a stand; paddles, buttons, a gear stick; pedals."""
    r, tilt, n = m.number(0.125, 0.15), m.number(10, 30), m.pick(12, 16, 24)
    wide, deep, high = m.number(0.16, 0.24), m.number(0.16, 0.24), m.number(0.13, 0.18)
    lift = m.pick(0.0, 0.0, 0.68)  # on a desk's clamp height, or on a stand
    axis = -vec(0, np.cos(np.deg2rad(tilt)), -np.sin(np.deg2rad(tilt)))
    shape = m.pick("box", "wedge", "drum")
    drum = Dot(deep / 2, lift + high * 0.6).buffer(high * 0.45)
    line = {
        "box": rounded((0, deep), (lift, lift + high), 0.02),
        "drum": drum.union(rectangle((0.02, deep - 0.02), (lift, lift + high * 0.5))),
        "wedge": [(0, lift), (deep, lift), (deep, lift + 0.5 * high), (0.6 * deep, lift + high), (0.1 * deep, lift + high)],
    }[shape]
    m.add(BASE, prism(line, "x", (-wide / 2, wide / 2)))
    hub = vec(0, -0.01, lift + 0.62 * high + 0.01)
    m.add(BASE, rod(hub - 0.06 * axis, hub + 0.012 * axis, 0.045, n))
    center = hub + m.number(0.05, 0.08) * axis
    _rim(m, center, hub + 0.012 * axis, axis, r, n)
    top = lift + high * (1.0 if shape == "box" else 1.05)
    for k in range(m.pick(0, 2, 4) if shape != "wedge" else 0):
        button(m, f"base_button_{k}", ((k - 1.5) * 0.025, 0.5 * deep, top), Z, 0.012)
    _set_up(m, wide, deep, lift, n)


def _set_up(m: Model, wide: float, deep: float, lift: float, n: int) -> None:
    """What holds the wheel, a stand or clamps; the pedals and the gear stick."""
    clamps = not lift and m.chance(0.7)
    if lift:
        m.add(BASE, *(rod((a, 0.4 * deep, 0.02), (a, 0.4 * deep, lift + 0.002), 0.016, 10) for a in (-0.06, 0.06)))
        m.add(
            BASE,
            box((-0.2, 0.2), (0.3 * deep, 0.5 * deep), (0, 0.025)),
            *(box((a, a + 0.03), (-0.45, 0.35), (0, 0.025)) for a in (-0.2, 0.17)),
        )
    elif clamps:
        for a in (-0.35 * wide, 0.35 * wide):
            m.add(
                BASE,
                box((a - 0.015, a + 0.015), (0.02, 0.06), (-0.09, 0.002)),
                box((a - 0.015, a + 0.015), (-0.02, 0.06), (-0.1, -0.085)),
            )
            knob(m, f"clamp_{a > 0}", (a, 0.0, -0.1), (0, 0, -1), 0.014, style="fluted")
    side = m.pick(-1, 1)
    floor = 0.0 if lift or not clamps else -0.1
    if m.chance(0.85):
        place = vec(0, 0.1, 0) if lift else vec(side * m.number(0.36, 0.45), -0.1, floor)
        _pedals(m, place, m.pick(2, 3), n)
        if not lift:
            m.add(
                BASE,
                tube(
                    [
                        place + vec(0, 0.2, 0.03),
                        place + vec(-side * 0.1, 0.36, 0.006),
                        vec(side * 0.05, 0.4, 0.01),
                        vec(0, deep - 0.02, 0.03),
                    ],
                    0.004,
                    6,
                ),
            )
    if m.chance(0.4):
        _gear_stick(m, -side, wide, lift, n)


def _gear_stick(m: Model, s: int, wide: float, lift: float, n: int) -> None:
    """A stick with a ball on a box at a side of the housing."""
    at = vec(s * (wide / 2 + 0.09), 0.1, lift)
    m.add(BASE, box((at[0] - 0.05, at[0] + 0.05), (0.03, 0.17), (lift, lift + 0.06)))
    m.add(BASE, box((s * wide / 2 - s * 0.01, at[0]), (0.08, 0.12), (lift, lift + 0.03)))
    m.add(
        "gear_stick",
        rod(at + vec(0, 0, 0.062), at + vec(0, 0, 0.17), 0.007, 8),
        ball(at + vec(0, 0, 0.18), (0.02, 0.02, 0.024), n),
    )
    m.add("gear_stick", lathe([(0, 0), (0.03, 0), (0.008, 0.03), (0, 0.03)], n, at + vec(0, 0, 0.0605)))
    m.hinge("gear_stick", at + vec(0, 0, 0.05), X, (-20, 20))


def _rim(m: Model, center: np.ndarray, root: np.ndarray, axis: np.ndarray, r: float, n: int) -> None:
    """The rim with spokes, buttons and paddles, made level and then turned to the driver."""
    shape, thick = m.pick("round", "round", "flat", "open"), m.number(0.012, 0.017)
    if shape == "round":
        solids = [ring((0, 0, 0), Z, r, thick, 24)]
    else:
        t = np.linspace(-0.25 * np.pi, 1.25 * np.pi, 25) if shape == "flat" else np.linspace(-0.3, np.pi + 0.3, 21)
        points = [(r * np.cos(a), r * np.sin(a), 0) for a in t]
        if shape == "open":
            t = np.linspace(0.75, -1.0, 9)
            arcs = [[(s * r * np.cos(a), r * np.sin(a), 0) for a in t] for s in (-1, 1)]
            solids = [tube([*a, (a[-1][0] * 0.3, a[-1][1] * 0.9, 0)], thick, 8) for a in arcs]
        else:
            solids = [tube([*points, points[0]], thick, 8)]
    solids += [rod((0, 0, -0.02), (0, 0, 0.012), 0.045, n)]
    ends = {2: (0.1, np.pi - 0.1), 3: (0.1, np.pi - 0.1, -np.pi / 2)}[m.pick(2, 3) if shape == "round" else 2]
    solids += [beam((0, 0, 0), (r * np.cos(a), r * np.sin(a), 0), 0.04, 0.006, (np.sin(a), -np.cos(a), 0)) for a in ends]
    m.add("wheel", *_faced(solids, axis, center), rod(root, center - 0.015 * axis, 0.022, n))
    limit = m.pick(0, 135, 450)
    m.hinge("wheel", center, axis, (-limit, limit)) if limit else m.spin("wheel", center, axis)
    up = np.cross(axis, X) * (1 if np.cross(axis, X)[2] > 0 else -1)
    for k in range(m.pick(0, 2, 4, 6)):
        s = k % 2 * 2 - 1
        at = center + vec(s * (0.05 + 0.018 * (k // 2)), 0, 0) + 0.003 * axis + up * 0.006
        m.add(f"wheel_button_{k}", rod(at - 0.001 * axis, at + 0.006 * axis, 0.006, 10))
        m.slide(f"wheel_button_{k}", -axis, 0.003, "wheel")
    for s in (-1, 1) if m.chance(0.75) else ():
        a = center + vec(s * 0.04, 0, 0) - 0.016 * axis
        plate = [beam(a, a + vec(s * 0.05, 0, 0) + 0.005 * up, 0.05, 0.003, up)]
        m.add(f"paddle_{s}", *plate)
        m.hinge(f"paddle_{s}", a, s * np.cross(X, axis), m.number(6, 10), "wheel")


def _faced(solids: list[Trimesh], axis: np.ndarray, center: np.ndarray) -> list[Trimesh]:
    """Turn solids made level, their top at +y, so that their upper face looks along an axis in the plane x = 0."""
    lean = np.rad2deg(np.arctan2(-axis[1], axis[2]))
    return [turned(s, X, lean, (0, 0, 0)).apply_translation(center) for s in solids]


def _pedals(m: Model, at: np.ndarray, count: int, n: int) -> None:
    """Pedals that stand on or hang over a plate that leans."""
    wide, hanging = 0.1 * count + 0.06, m.chance(0.4)
    x, y = (at[0] - wide / 2, at[0] + wide / 2), (at[1], at[1] + m.number(0.24, 0.3))
    z = at[2]
    m.add(BASE, prism([(y[0], z), (y[1], z), (y[1], z + 0.07), (y[1] - 0.06, z + 0.07), (y[0], z + 0.015)], "x", x))
    for k in range(count):
        c = x[0] + 0.03 + 0.1 * (k + 0.5)
        w = 0.032 if count == 3 else 0.04
        if hanging:
            m.add(
                BASE, *(box((c + s * 0.018, c + s * 0.024), (y[1] - 0.05, y[1] - 0.005), (z + 0.06, z + 0.24)) for s in (-1, 1))
            )
            p = vec(c, y[1] - 0.03, z + 0.22)
            foot = p + vec(0, -0.09, -0.1)
            m.add(f"pedal_{k}", rod(p - vec(0.018, 0, 0), p + vec(0.018, 0, 0), 0.012, n), beam(p, foot, 0.016, 0.016))
            m.add(f"pedal_{k}", beam(foot + vec(0, -0.012, 0.035), foot + vec(0, 0.02, -0.035), 2 * w * 0.8, 0.008))
            m.hinge(f"pedal_{k}", p, X, m.number(18, 28))
            continue
        p = vec(c, y[1] - 0.1, z + 0.06)
        m.add(BASE, *(box((c + s * 0.016, c + s * 0.022), (p[1] - 0.02, p[1] + 0.02), (z + 0.03, z + 0.08)) for s in (-1, 1)))
        top = p + vec(0, -0.03, m.number(0.12, 0.15))
        m.add(f"pedal_{k}", rod(p - vec(0.016, 0, 0), p + vec(0.016, 0, 0), 0.01, n), beam(p, top, 0.016, 0.01))
        m.add(f"pedal_{k}", beam(top + vec(0, 0.012, -0.06), top + vec(0, -0.02, 0.04), 2 * w, 0.007))
        m.hinge(f"pedal_{k}", p, (-1, 0, 0), m.number(15, 25))
