"""Jacks for cars: scissors, bottles, trolleys."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.bench_style import STYLES, bar, body, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod, rounded, tube, vec

UP = (0, 0, 1)


def car_jack(m: Model) -> None:
    """A scissor jack with its screw, a bottle jack with its ram and pump, or a trolley jack with arm, lever and wheels."""
    style = m.pick(*STYLES)
    m.pick(_scissor, _scissor, _bottle, _trolley)(m, style, max(12, m.sections()))


def _scissor(m: Model, style: str, n: int) -> None:
    """Four arms that rise together; the screw lies between the two joints at the sides."""
    long, t = m.number(0.14, 0.19), np.deg2rad(m.number(12, 22))
    up = float(60 - np.rad2deg(t))
    w, thick = m.number(0.036, 0.046), m.number(0.02, 0.026)
    foot, half = 0.03, 0.022
    m.add(BASE, body(style, (-0.05, 0.05), (-0.04, 0.04), (0, 0.008)))
    m.add(
        BASE,
        *(
            box((-0.04, 0.04), (s * (w / 2 + 0.003) - 0.002, s * (w / 2 + 0.003) + 0.002), (0.006, foot + 0.014))
            for s in (-1, 1)
        ),
    )
    high = foot + 2 * long * np.sin(t)
    for side, s in (("left", -1), ("right", 1)):
        a = vec(s * half, 0, foot)
        b = a + long * vec(s * np.cos(t), 0, np.sin(t))
        c = vec(s * half, 0, high)
        for part, p, q in ((f"lower_{side}", a, b), (f"upper_{side}", b, c)):
            if style == "game":
                m.add(part, bar(p, q, 0.9 * w, thick, (0, 1, 0)))
            else:
                y = 0.5 * w - 0.003 if part[0] == "l" else 0.5 * w - 0.007
                m.add(part, *(bar(p + vec(0, e * y, 0), q + vec(0, e * y, 0), 0.003, thick, (0, 1, 0)) for e in (-1, 1)))
                m.add(part, rod(p - vec(0, w / 2, 0), p + vec(0, w / 2, 0), 0.3 * thick, n))
                m.add(part, bar(p + 0.25 * (q - p), p + 0.75 * (q - p), 2 * y, 0.003, (0, 1, 0)))
        m.hinge(f"lower_{side}", a, (0, -s, 0), up)
        m.hinge(f"upper_{side}", b, (0, s, 0), 2 * up, f"lower_{side}")
    m.add("saddle", body(style, (-0.035, 0.035), (-0.03, 0.03), (high + 0.012, high + 0.02)))
    m.add(
        "saddle",
        *(
            box((-0.032, 0.032), (s * (w / 2 + 0.003) - 0.002, s * (w / 2 + 0.003) + 0.002), (high - 0.01, high + 0.013))
            for s in (-1, 1)
        ),
    )
    m.add("saddle", *(rod((s * half, -w / 2 - 0.004, high), (s * half, w / 2 + 0.004, high), 0.004, 8) for s in (-1, 1)))
    if m.chance(0.5):
        m.add(
            "saddle", *(box((-0.03, 0.03), (s * 0.02 - 0.004, s * 0.02 + 0.004), (high + 0.019, high + 0.026)) for s in (-1, 1))
        )
    m.hinge("saddle", (-half, 0, high), (0, 1, 0), up, "upper_left")
    _screw(m, style, half + long * np.cos(t), foot + long * np.sin(t), up, n)


def _screw(m: Model, style: str, x: float, z: float, up: float, n: int) -> None:
    """The block that carries the screw, the screw with its eye, perhaps a crank."""
    m.add("block", box((-x - 0.011, -x + 0.011), (-0.012, 0.012), (z - 0.011, z + 0.011)))
    m.hinge("block", (-x, 0, z), (0, -1, 0), up, "lower_left")
    m.add("screw", rod((-x - 0.02, 0, z), (x + 0.02, 0, z), 0.006, n), rod((x - 0.009, 0, z), (x + 0.009, 0, z), 0.0105, 6))
    m.add("screw", ring((-x - 0.028, 0, z), (0, 1, 0), 0.009, 0.003, 12), rod((-x - 0.02, 0, z), (-x - 0.012, 0, z), 0.011, 8))
    m.spin("screw", (-x, 0, z), (1, 0, 0), "block")
    if m.chance(0.5):
        e = -x - 0.028
        m.add("screw", tube([(e, 0, z), (e - 0.05, 0, z), (e - 0.055, 0, z - 0.07), (e - 0.11, 0, z - 0.07)], 0.004, 8))
    if style in ("cad", "old"):
        m.add("screw", *(ring((a, 0, z), (1, 0, 0), 0.006, 0.0012, 10) for a in np.linspace(-0.7 * x, 0.7 * x, 16)))


def _bottle(m: Model, style: str, n: int) -> None:
    """A body on a foot; the ram goes up, the screw in it turns and is drawn out, a pump lever, a valve."""
    r, h = m.number(0.03, 0.05), m.number(0.13, 0.2)
    m.add(
        BASE,
        prism(rounded((-1.5 * r, 1.5 * r), (-1.3 * r, 1.3 * r), 0.2 * r), "z", (0, 0.014))
        if style != "game"
        else box((-1.5 * r, 1.5 * r), (-1.3 * r, 1.3 * r), (0, 0.014)),
    )
    profile = [(r, 0), (r, 0.8 * h), (0.8 * r, 0.85 * h), (0.8 * r, h)] if m.chance(0.5) else [(r, 0), (r, h)]
    m.add(BASE, lathe((0, 0, 0.012), UP, profile, n if style != "game" else 8))
    top = 0.012 + h
    if style in ("cad", "old", "soft"):
        m.add(BASE, rod((0, 0, top - 0.02), (0, 0, top + 0.004), 0.9 * r, 6))
        top += 0.004
    m.add("ram", rod((0, 0, 0.04), (0, 0, top + 0.012), 0.5 * r, n))
    m.slide("ram", UP, 0.7 * h)
    m.add(
        "screw",
        rod((0, 0, 0.08), (0, 0, top + 0.024), 0.32 * r, n),
        lathe((0, 0, top + 0.022), UP, [(0.4 * r, 0), (0.62 * r, 0.004), (0.62 * r, 0.014), (0.5 * r, 0.016)], n),
    )
    m.spin("screw", (0, 0, top), UP, "ram")
    x = -1.3 * r - 0.008
    m.add(BASE, rod((x, 0, 0.012), (x, 0, 0.07), 0.014, n), box((x, -0.9 * r), (-0.012, 0.012), (0.012, 0.04)))
    pivot = vec(x - 0.016, 0, 0.085)
    m.add(BASE, *(box((x - 0.022, x + 0.004), (s * 0.011 - 0.0025, s * 0.011 + 0.0025), (0.05, 0.092)) for s in (-1, 1)))
    out = m.pick(0.07, 0.3)
    end = pivot + out * vec(-np.cos(0.3), 0, np.sin(0.3))
    m.add("pump_lever", rod(pivot, end, 0.0075, n), rod(pivot - vec(0, 0.016, 0), pivot + vec(0, 0.016, 0), 0.004, 8))
    m.add("pump_lever", bar(pivot, pivot + vec(0.03, 0, -0.006), 0.012, 0.01, (0, 1, 0)))
    if out > 0.1:
        m.add("pump_lever", rod(end - 0.3 * (end - pivot), end, 0.011, n))
    m.hinge("pump_lever", pivot, (0, 1, 0), (-20, 35))
    m.add(
        "release_valve",
        rod((0.7 * r, -1.2 * r, 0.028), (0.7 * r, -1.55 * r - 0.01, 0.028), 0.006, 8),
        box((0.7 * r - 0.009, 0.7 * r + 0.009), (-1.55 * r - 0.014, -1.55 * r - 0.006), (0.024, 0.032)),
    )
    m.add(BASE, box((0.4 * r, r), (-1.25 * r, -0.4 * r), (0.012, 0.04)))
    m.spin("release_valve", (0.7 * r, -1.3 * r, 0.028), (0, -1, 0))


def _trolley(m: Model, style: str, n: int) -> None:
    """Two side plates on wheels; the arm with the saddle rises, the lever is pulled down, castors turn behind."""
    long, w, h = m.number(0.45, 0.6), m.number(0.18, 0.24), m.number(0.1, 0.13)
    side = Polygon([(-0.1, 0.02), (-0.1, 0.06), (0.5 * long, h), (long - 0.1, h + 0.03), (long - 0.1, 0.05)])
    side = side.buffer(-0.008).buffer(0.008, quad_segs=3) if style in ("soft", "old") else side
    for s in (-1, 1):
        m.add(BASE, prism(side, "x", (s * w / 2 - 0.004, s * w / 2 + 0.004)))
    m.add(
        BASE,
        box((-w / 2, w / 2), (-0.095, -0.07), (0.028, 0.05)),
        body(style, (-w / 2 + 0.002, w / 2 - 0.002), (0.6 * long, long - 0.11), (0.055, h)),
    )
    m.add(BASE, rod((0, 0.25 * long, 0.07), (0, 0.65 * long, 0.085), 0.028, n))
    for k, s in enumerate((-1, 1)):
        a = vec(s * (w / 2 + 0.004), -0.07, 0.032)
        m.add(f"wheel_{k}", rod(a, a + vec(s * 0.028, 0, 0), 0.032, n))
        m.add(BASE, rod(a - vec(s * 0.01, 0, 0), a + vec(s * 0.031, 0, 0), 0.008, 8))
        m.spin(f"wheel_{k}", a, (1, 0, 0))
        c = vec(s * (w / 2 - 0.02), long - 0.13, 0.056)
        m.add(
            f"castor_{k}",
            rod(c, c - vec(0, 0, 0.006), 0.016, 10),
            *(
                box((c[0] + e * 0.012 - 0.002, c[0] + e * 0.012 + 0.002), (c[1] - 0.008, c[1] + 0.026), (0.014, 0.052))
                for e in (-1, 1)
            ),
        )
        m.spin(f"castor_{k}", c, UP)
        b = c + vec(0, 0.016, 0.022 - c[2])
        m.add(
            f"castor_wheel_{k}",
            rod(b - vec(0.0095, 0, 0), b + vec(0.0095, 0, 0), 0.022, n),
            rod(b - vec(0.012, 0, 0), b + vec(0.012, 0, 0), 0.004, 8),
        )
        m.spin(f"castor_wheel_{k}", b, (1, 0, 0), f"castor_{k}")
    _lift(m, style, (long, w, h), n)


def _lift(m: Model, style: str, size: tuple[float, float, float], n: int) -> None:
    """The arm with its saddle, and the lever in its socket."""
    long, w, h = size
    a, b = vec(0, 0.5 * long, h - 0.03), vec(0, -0.04, 0.075)
    half = w / 2 - 0.014
    m.add("arm", *(bar(a + vec(s * half, 0, 0), b + vec(s * 0.5 * half, 0, 0), 0.008, 0.035) for s in (-1, 1)))
    m.add(
        "arm",
        rod(a - vec(w / 2 - 0.002, 0, 0), a + vec(w / 2 - 0.002, 0, 0), 0.01, n),
        rod(b - vec(0, 0, 0.02), b + vec(0, 0, 0.02), 0.55 * half, n),
    )
    m.hinge("arm", a, (-1, 0, 0), m.pick(40, 50))
    m.add(
        "saddle",
        lathe(
            b + vec(0, 0, 0.019),
            UP,
            [(0.02, 0), (0.04, 0.008), (0.045, 0.02), (0.04, 0.02), (0.034, 0.012), (0, 0.01)],
            n if style != "game" else 8,
        ),
    )
    m.spin("saddle", b + vec(0, 0, 0.02), UP, "arm")
    c = vec(0, 0.78 * long, h + 0.012)
    lean = np.deg2rad(m.number(40, 75))
    along = vec(0, np.cos(lean), np.sin(lean))
    m.add(
        BASE,
        *(box((s * 0.026 - 0.004, s * 0.026 + 0.004), (c[1] - 0.02, c[1] + 0.02), (h - 0.01, c[2] + 0.016)) for s in (-1, 1)),
    )
    m.add(
        "lever", rod(c - 0.012 * along, c + 0.14 * along, 0.018, n), rod(c - vec(0.028, 0, 0), c + vec(0.028, 0, 0), 0.008, 8)
    )
    end = c + m.number(0.5, 0.8) * along
    m.add("lever", rod(c + 0.13 * along, end, 0.012, n))
    m.add(
        "lever",
        rod(end - 0.14 * along, end + 0.01 * along, 0.017, n) if m.chance(0.6) else ball(end, (0.017, 0.017, 0.017), 10),
    )
    if m.chance(0.4):
        m.add("lever", rod(end - vec(0.14, 0, 0), end + vec(0.14, 0, 0), 0.011, n))
    m.hinge("lever", c, (-1, 0, 0), (-(85 - float(np.rad2deg(lean))), float(np.rad2deg(lean)) - 10))
