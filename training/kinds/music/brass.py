"""Trumpets and a few other instruments with valves, slides, keys and pedals."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, loft, prism, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe, upright


def trumpet(m: Model) -> None:
    """A trumpet with three valves; in some a trombone, an accordion or the pedal of a bass drum."""
    style = m.pick("trumpet", "trumpet", "trumpet", "trombone", "accordion", "pedal")
    {"trumpet": _trumpet, "trombone": _trombone, "accordion": _accordion, "pedal": _pedal}[style](m)


def _bell(m: Model, at: Point, pipe: float, flare: float, long: float, n: int) -> None:
    """A flaring tube, open in some, whose wide end points to -Y."""
    t = np.linspace(0, 1, m.pick(5, 8))
    skin = [(pipe + (flare - pipe) * (0.12 * u + 0.88 * u**6), long * u) for u in t]
    inner = [(0.9 * r, z) for r, z in skin[::-1]] if m.chance(0.6) else [(0, long)]
    closing = [(0, 0.3 * long)] if len(inner) > 1 else []
    m.add(BASE, *upright([lathe([(0, 0), *skin, *inner[: -1 if closing else None], *closing], n)], (0, -1, 0), at))


def _trumpet(m: Model) -> None:
    """Bell and lead pipe along Y with bends before and behind, valves between them, slides that are drawn."""
    c, n = m.pick(1.0, 0.75, m.number(0.8, 1.1)), m.pick(12, 16, 24)
    pipe, fine = 0.006, m.pick(6, 8, 12)
    high, back, front = m.number(0.055, 0.075), 0.14 * c, -0.17 * c
    _bell(m, (0, back, high), 1.1 * pipe, m.number(0.055, 0.065), 0.14 * c + 0.29 * c, n)
    t = np.linspace(0, np.pi, 8)
    rear = [vec(0, back + 0.5 * high * np.sin(a), high / 2 + 0.5 * high * np.cos(a)) for a in t]
    m.add(BASE, tube([(0, back - 0.02, high), *rear, (0, 0, 0)], pipe, fine))
    x = -0.028
    m.add(BASE, tube([(x, back + 0.08 * c, high), (x, front + 0.045, high)], 0.9 * pipe, fine))
    m.add(
        BASE,
        *upright(
            [lathe([(0, 0), (0.5 * pipe, 0), (0.008, 0.05), (0.0135, 0.062), (0.0135, 0.07), (0, 0.066)], n)],
            (0, 1, 0),
            (x, back + 0.07 * c, high),
        ),
    )
    m.add(BASE, tube([(x, front + 0.045, 0.0), (x, 0.0, 0.0)], 0.9 * pipe, fine), rod((x, 0, 0), (0, 0, 0), 0.9 * pipe, fine))
    low = [vec(x, front + 0.04 - 0.5 * high * np.sin(a), high / 2 + 0.5 * high * np.cos(a)) for a in t]
    m.add("tuning_slide", tube([(x, front + 0.095 * c, high), *low, (x, front + 0.095 * c, 0)], 1.1 * pipe, fine))
    m.slide("tuning_slide", (0, -1, 0), 0.045 * c)
    if m.chance(0.5):
        spot, out, along = low[5], vec(0, -np.sin(t[5]), np.cos(t[5])), vec(0, -np.cos(t[5]), -np.sin(t[5]))
        at = spot + 0.0085 * out
        m.add("tuning_slide", rod(spot, at, 0.0025, 8))
        m.add("water_key", beam(at - 0.016 * along, at + 0.013 * along, 0.005, 0.0025))
        m.hinge("water_key", at, (1, 0, 0), 14, "tuning_slide")
    m.add(BASE, *(rod((x, y, high), (0, y, high), 0.003, 6) for y in (0.085 * c, -0.07 * c)))
    _valves(m, c, high, n)
    if m.chance(0.6):
        y, far = 0.025 * c, 0.075 * c
        m.add("third_slide", *(tube([(0.012, -y - 0.008, z), (far, -y - 0.008, z)], 0.8 * pipe, fine) for z in (0.012, 0.035)))
        m.add("third_slide", rod((far, -y - 0.008, 0.008), (far, -y - 0.008, 0.039), pipe, fine))
        m.slide("third_slide", (1, 0, 0), 0.05 * c)


def _valves(m: Model, c: float, high: float, n: int) -> None:
    """Three casings with caps; the stems with their buttons go down."""
    r, top = 0.0115, high + m.number(0.015, 0.03)
    out = m.number(0.014, 0.022)
    for k, y in enumerate((-0.027 * c, 0.0, 0.027 * c)):
        m.add(BASE, rod((0, y, -0.045), (0, y, top), r, n), rod((0, y, top - 0.004), (0, y, top + 0.004), 1.1 * r, n))
        m.add(BASE, lathe([(0, -0.056), (0.3 * r, -0.056), (1.1 * r, -0.049), (1.1 * r, -0.04), (0, -0.04)], n, (0, y, 0)))
        m.add(f"valve_{k}", rod((0, y, top - 0.005), (0, y, top + out), 0.003, 8))
        m.add(f"valve_{k}", rod((0, y, top + out), (0, y, top + out + 0.003), 0.0085, n))
        m.slide(f"valve_{k}", (0, 0, -1), 0.8 * (out - 0.004))


def _trombone(m: Model) -> None:
    """A bell section and a long slide of two tubes that is pushed out to the front."""
    n, pipe, wide = m.pick(12, 16, 24), 0.007, m.number(0.04, 0.055)
    long, t = m.number(0.55, 0.7), np.linspace(0, np.pi, 8)
    _bell(m, (-2 * wide, 0.3, 0), pipe, m.number(0.09, 0.12), 0.55, n)
    bend = [vec(-wide - wide * np.cos(a), 0.3 + wide * np.sin(a), 0) for a in t]
    if m.chance(0.5):
        m.add(BASE, rod((0, 0, 0), (0, 0.3, 0), pipe, 8), rod((-2 * wide, 0.25, 0), (-2 * wide, 0.3, 0), pipe, 8))
        m.add("tuning_slide", tube([(-2 * wide, 0.25, 0), *bend, (0, 0.25, 0)], 1.25 * pipe, 8))
        m.slide("tuning_slide", (0, 1, 0), 0.045)
    else:
        m.add(BASE, tube([(0, 0.0, 0), *bend[::-1], (-2 * wide, 0.28, 0)], pipe, 8))
    m.add(BASE, rod((-2 * wide, 0.1, 0), (0, 0.1, 0), 0.004, 8), rod((-0.004, 0.01, 0), (2 * wide, 0.01, 0), 0.006, 8))
    m.add(
        BASE,
        *upright(
            [lathe([(0, 0), (0.005, 0), (0.009, 0.05), (0.016, 0.065), (0.016, 0.07), (0, 0.066)], n)],
            (0, 1, 0),
            (2 * wide, 0.0, 0),
        ),
    )
    m.add(BASE, *(rod((x, 0.02, 0), (x, 0.05 - long, 0), 0.85 * pipe, 10) for x in (0, 2 * wide)))
    bow = [vec(wide + wide * np.cos(a), -long - wide * np.sin(a), 0) for a in t]
    m.add(
        "slide",
        tube([(2 * wide, -0.03, 0), *bow, (0, -0.03, 0)], 1.15 * pipe, 8),
        rod((0, -0.045, 0), (2 * wide, -0.045, 0), 0.006, 8),
    )
    m.slide("slide", (0, -1, 0), 0.8 * long)


def _accordion(m: Model) -> None:
    """Two ends with bellows between; piano keys or buttons at the right, bass buttons at the left."""
    deep, high, gap = m.number(0.16, 0.2), m.number(0.32, 0.4), m.number(0.1, 0.2)
    folds = m.pick(6, 9, 12)
    steps = np.linspace(0, gap, 2 * folds + 1)
    inset = 0.006 + 0.012 * (np.arange(2 * folds + 1) % 2)
    square = np.array([(-1, 0), (1, 0), (1, 1), (-1, 1)])
    half = vec(deep / 2, 0, high)
    rings = [
        np.c_[np.full(4, x), square[:, 0] * (half[0] - i), i + square[:, 1] * (high - 2 * i)]
        for x, i in zip(steps, inset, strict=True)
    ]
    m.add(BASE, loft(np.array(rings)))
    for a, b in ((-0.1, 0.001), (gap - 0.001, gap + 0.1)):
        m.add(BASE, prism(rounded((-deep / 2, deep / 2), (0, high), m.pick(0.004, 0.02)), "x", (a, b)))
    if m.chance(0.6):
        _piano_keys(m, -0.1, deep, high)
    else:
        _buttons(
            m,
            "button",
            vec(-0.1, -0.3 * deep, 0.1 * high),
            vec(0, 0, 0.82 * high),
            vec(0, 0.022, 0),
            (m.pick(8, 10), m.pick(2, 3)),
            vec(1, 0, 0),
        )
    _buttons(
        m,
        "bass",
        vec(gap + 0.1, -0.2 * deep, 0.2 * high),
        vec(0, 0, 0.6 * high),
        vec(0, 0.018, 0),
        (6, m.pick(1, 2)),
        vec(-1, 0, 0),
    )
    if m.chance(0.5):
        m.add(
            BASE,
            tube(
                [
                    (gap + 0.095, 0.3 * deep, 0.1 * high),
                    (gap + 0.14, 0.3 * deep, 0.3 * high),
                    (gap + 0.14, 0.3 * deep, 0.7 * high),
                    (gap + 0.095, 0.3 * deep, 0.9 * high),
                ],
                0.008,
                4,
            ),
        )


def _piano_keys(m: Model, x: float, deep: float, high: float) -> None:
    """White keys one above another on the left flank, which tip in at their far end, and shorter black ones."""
    count = m.pick(10, 14, 17)
    step = 0.94 * high / count
    m.add(BASE, box((x - 0.02, x + 0.001), (-0.1 * deep, 0.35 * deep), (0.02 * high, 0.98 * high)))
    front, back = -0.75 * deep, -0.1 * deep
    m.add(BASE, box((x - 0.008, x + 0.001), (front, back), (0.02 * high, 0.98 * high)))
    for k in range(count):
        z = 0.03 * high + k * step
        m.add(f"key_{k}", box((x - 0.02, x - 0.0135), (front, back - 0.0005), (z + 0.0004, z + step - 0.0004)))
        m.hinge(f"key_{k}", (x - 0.017, back, z + step / 2), (0, 0, -1), 3)
        if k % 7 not in (2, 6) and k < count - 1:
            up = z + step
            m.add(
                f"black_key_{k}",
                box((x - 0.026, x - 0.0195), (0.55 * front, back - 0.0005), (up - 0.3 * step, up + 0.3 * step)),
            )
            m.hinge(f"black_key_{k}", (x - 0.022, back, up), (0, 0, -1), 3)


def _buttons(m: Model, name: str, at: Point, along: Point, across: Point, counts: tuple[int, int], inward: Point) -> None:
    """Rows of round buttons that are pressed inwards."""
    n = m.pick(8, 12)
    for i in range(counts[0]):
        for j in range(counts[1]):
            p = at + along * (i + 0.5 * (j % 2)) / counts[0] + across * j
            part = f"{name}_{i * counts[1] + j}"
            m.add(part, rod(p + 0.001 * inward, p - 0.006 * inward, 0.006, n))
            m.slide(part, inward, 0.005)


def _pedal(m: Model) -> None:
    """A foot plate on a floor plate, two posts with an axle, a beater on it."""
    long, wide, high = m.number(0.24, 0.3), m.number(0.075, 0.095), m.number(0.15, 0.2)
    half, y, out = m.pick(wide / 2, 0.012), long + 0.03, wide / 2 + 0.02
    m.add(BASE, box((-half, half), (0, long + 0.06), (0, 0.006)))
    m.add(BASE, box((-out - 0.01, out + 0.01), (y - 0.025, y + 0.03), (0, 0.008)))
    post = [(y - 0.02, 0), (y + 0.02, 0), (y + 0.01, high + 0.012), (y - 0.01, high + 0.012)]
    m.add(BASE, *(prism(post, "x", (s * out - 0.007, s * out + 0.007)) for s in (-1, 1)))
    m.add(BASE, box((-0.4 * wide, 0.4 * wide), (-0.01, 0.05), (0.004, 0.016)))
    heel, rise = vec(0, 0.045, 0.018), np.deg2rad(m.number(12, 20))
    plate, side = 0.82 * long * vec(0, np.cos(rise), np.sin(rise)), vec(0.42 * wide, 0, 0)
    m.add(
        "pedal", beam(heel, heel + plate, 0.85 * wide, 0.006, taper=m.pick(1.0, 0.8)), rod(heel - side, heel + side, 0.004, 8)
    )
    if m.chance(0.6):
        ribs = [heel + u * plate + vec(0, 0, 0.004) for u in (0.3, 0.45, 0.6, 0.75)]
        m.add("pedal", *(beam(at - 0.7 * side, at + 0.7 * side, 0.006, 0.004, (0, 1, 0)) for at in ribs))
    m.hinge("pedal", heel, (-1, 0, 0), float(np.rad2deg(rise)) - 3)
    _beater(m, vec(0, y, high), vec(out + 0.004, 0, 0))


def _beater(m: Model, axle: Point, side: Point) -> None:
    """An axle with a stick that leans back and a felt ball or block on it."""
    lean = np.deg2rad(m.number(20, 40))
    end = axle + m.number(0.14, 0.18) * vec(0, -np.sin(lean), np.cos(lean))
    m.add("beater", rod(axle - side, axle + side, 0.006, 10), rod(axle, end, 0.004, 8))
    block = rod(end - vec(0, 0.025, 0), end + vec(0, 0.025, 0), 0.022, 16)
    m.add("beater", ball(end, (0.025, 0.025, 0.025), 12) if m.chance(0.5) else block)
    m.add("beater", rod(axle - vec(0.01, 0, 0), axle + vec(0.01, 0, 0), 0.016, 12))
    m.hinge("beater", axle, (-1, 0, 0), float(np.rad2deg(lean)) + 15)
