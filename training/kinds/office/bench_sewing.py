"""Sewing machines with a crank."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon

from training.kinds.bench_style import STYLES, add_button, add_knob, bar, body, front, lathe, without
from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, cut, prism, ring, rod, tube, vec


def sewing_hand_machine(m: Model) -> None:
    """A small sewing machine on a board: a wheel with a crank, a needle, a foot, perhaps plates, knobs and a box."""
    style, design = m.pick(*STYLES), m.pick("cast", "cast", "modern", "toy")
    scale = 0.55 if design == "toy" else 1.0
    w, deep, base = m.number(0.36, 0.42) * scale, m.number(0.17, 0.2) * scale, m.number(0.025, 0.06) * scale
    high, arm, half = m.number(0.24, 0.28) * scale, m.number(0.045, 0.06) * scale, m.number(0.025, 0.035) * scale
    x, bed, middle = (-w / 2, w / 2), base + 0.02 * scale, 0.5 * deep
    _board(m, style, x, deep, base)
    m.add(BASE, body(style, (x[0] + 0.01, x[1] - 0.01), (0.12 * deep, 0.88 * deep), (base - 0.001, bed)))
    nose, post, top = x[0] + 0.045 * scale, x[1] - 0.075 * scale, bed + high
    side = Polygon(
        [
            (nose - 0.025 * scale, top - 1.7 * arm),
            (nose - 0.025 * scale, top),
            (post + 0.03 * scale, top),
            (post + 0.04 * scale, bed - 0.002),
            (post - 0.05 * scale, bed - 0.002),
            (post - 0.03 * scale, top - arm),
            (nose + 0.03 * scale, top - arm),
            (nose + 0.025 * scale, top - 1.7 * arm),
        ]
    )
    if style in ("soft", "old") and design != "modern":
        spine = LineString(
            [(nose, top - arm), (nose + 0.02 * scale, top - 0.5 * arm), (post, top - 0.6 * arm), (post, bed + 0.1 * scale)]
        )
        side = side.buffer(-0.012 * scale).union(spine.buffer(0.4 * arm)).buffer(0.012 * scale, quad_segs=3)
        side = side.intersection(Polygon([(-1, bed - 0.002), (1, bed - 0.002), (1, 1), (-1, 1)]))
    arch = prism(side, "y", (middle - half, middle + half))
    m.add(BASE, without(arch, (0, 1, 0)) if style == "sheet" else arch)
    if style in ("old", "cad"):
        m.add(
            BASE,
            prism(
                side.buffer(0.003).difference(side.buffer(-0.004)).buffer(0),
                "y",
                (middle - half - 0.002, middle - half + 0.003),
            ),
        )
    _needle(m, style, design, (nose, middle), (top, arm, bed), scale)
    _crank(m, style, (post, middle, top - 0.55 * arm), scale)
    _trims(m, style, (nose, post), (middle - half, middle), (top, arm, bed), scale)


def _board(m: Model, style: str, x: tuple[float, float], deep: float, base: float) -> None:
    """The foot: a slab or a wooden box, perhaps with a drawer."""
    drawer = base > 0.035 and m.chance(0.6)
    inside = drawer and style in ("cad", "flush", "soft")
    slab = box(x, (0, deep), (0.004, base)) if style == "old" else body(style, x, (0, deep), (0, base))
    if inside:
        slab = cut(slab, box((x[0] + 0.024, x[0] + 0.136), (-1, 0.11), (0.33 * base, 0.87 * base)))
    m.add(BASE, slab)
    if style == "old":
        m.add(BASE, box((x[0] - 0.008, x[1] + 0.008), (-0.008, deep + 0.008), (0, 0.4 * base)))
    if drawer:
        low = 0.42 if style == "old" else 0.3
        m.add("drawer", box((x[0] + 0.02, x[0] + 0.14), (-0.0045, -0.0005), (low * base, 0.9 * base)))
        m.add("drawer", *front(-0.0035).put(rod((x[0] + 0.08, 0.65 * base, 0), (x[0] + 0.08, 0.65 * base, 0.014), 0.006, 10)))
        if inside:
            tray = box((x[0] + 0.026, x[0] + 0.134), (-0.0015, 0.1), (0.35 * base, 0.8 * base))
            m.add("drawer", cut(tray, box((x[0] + 0.029, x[0] + 0.131), (0.003, 0.097), (0.4 * base, 1))))
        m.slide("drawer", (0, -1, 0), 0.08)


def _needle(
    m: Model, style: str, design: str, at: tuple[float, float], levels: tuple[float, float, float], scale: float
) -> None:
    """Bars with the needle and the foot, the lever of the foot."""
    a, y = at
    top, arm, bed = levels
    low = top - 1.7 * arm
    m.add(
        "needle_bar",
        rod((a, y, low - 0.03 * scale), (a, y, low + 0.02 * scale), 0.0035 * scale, 8),
        rod((a, y, bed + 0.035 * scale), (a, y, low - 0.03 * scale), 0.001, 6),
    )
    m.add("needle_bar", rod((a, y, low - 0.032 * scale), (a, y, low - 0.022 * scale), 0.006 * scale, 8))
    m.slide("needle_bar", (0, 0, -1), 0.028 * scale)
    b = y + 0.012 * scale
    foot = [rod((a, b, bed + 0.012 * scale), (a, b, low + 0.02 * scale), 0.003 * scale, 8)]
    foot += [
        box(
            (a - 0.008 * scale, a + 0.008 * scale),
            (b - 0.03 * scale, b + 0.006 * scale),
            (bed + 0.009 * scale, bed + 0.013 * scale),
        )
    ]
    foot[1] = cut(foot[1], box((a - 0.003 * scale, a + 0.003 * scale), (0, b - 0.006 * scale), (0, 1)))
    m.add("presser_foot", *foot)
    m.slide("presser_foot", (0, 0, -1), 0.008 * scale)
    if m.chance(0.6):
        back = top - 1.2 * arm
        c = vec(a, y + 0.03 * scale, back)
        m.add(BASE, rod((a, y, back), c + vec(0, 0.006, 0) * scale, 0.005 * scale, 8))
        m.add(
            "foot_lever",
            bar(c, c + vec(0.005, 0.004, -0.05) * scale, 0.009 * scale, 0.005 * scale),
            ball(c, np.full(3, 0.007 * scale), 8),
        )
        m.hinge("foot_lever", c, (0, -1, 0), 70)
    _plates(m, style, design, at, (low, top, bed), scale)


def _plates(
    m: Model, style: str, design: str, at: tuple[float, float], levels: tuple[float, float, float], scale: float
) -> None:
    """The plate below the needle, one that slides beside it, a plate at the end of the arm that opens."""
    a, y = at
    low, top, bed = levels
    m.add(BASE, box((a - 0.02 * scale, a + 0.02 * scale), (y - 0.03 * scale, y + 0.03 * scale), (bed - 0.001, bed + 0.0015)))
    if m.chance(0.6):
        m.add(
            "slide_plate",
            box((a - 0.045 * scale, a - 0.0205 * scale), (y - 0.03 * scale, y + 0.03 * scale), (bed - 0.0005, bed + 0.0015)),
        )
        m.slide("slide_plate", (-1, 0, 0), 0.02 * scale)
    if m.chance(0.4) and style != "sheet":
        end = a - 0.025 * scale
        m.add(
            "face_plate",
            body(
                "flush" if design != "modern" else "soft",
                (end - 0.006, end - 0.0005),
                (y - 0.022 * scale, y + 0.022 * scale),
                (low + 0.006, top - 0.006),
            ),
        )
        m.hinge("face_plate", (end - 0.003, y + 0.022 * scale, low), (0, 0, -1), 110)


def _crank(m: Model, style: str, at: tuple[float, float, float], scale: float) -> None:
    """The hand wheel with its crank and grip."""
    n, r = max(12, m.sections()), m.number(0.05, 0.062) * scale
    a = np.array(at) + vec(0.03, 0, 0) * scale
    m.add(BASE, rod(a - vec(0.02, 0, 0) * scale, a + vec(0.014, 0, 0) * scale, 0.018 * scale, n))
    x = a[0] + 0.012 * scale
    if style in ("game", "sheet"):
        m.add("hand_wheel", rod((x, a[1], a[2]), (x + 0.014 * scale, a[1], a[2]), r, n))
    elif style in ("cad", "flush"):
        profile = [
            (0.3 * r, 0),
            (0.5 * r, 0),
            (0.8 * r, 0.004),
            (r, 0),
            (r, 0.016),
            (0.8 * r, 0.012),
            (0.5 * r, 0.02),
            (0.3 * r, 0.02),
        ]
        m.add("hand_wheel", lathe((x, a[1], a[2]), (1, 0, 0), [(q, h * scale) for q, h in profile], 2 * n))
    else:
        c = vec(x + 0.008 * scale, a[1], a[2])
        m.add(
            "hand_wheel",
            ring(c, (1, 0, 0), r, 0.008 * scale, 2 * n),
            rod((x, a[1], a[2]), (x + 0.02 * scale, a[1], a[2]), 0.02 * scale, n),
        )
        spokes = around(rod((0.01 * scale, 0, 0), (r, 0, 0), 0.004 * scale, 6), m.pick(4, 5, 6))
        place = np.array([[0, 0, 1, c[0]], [0, 1, 0, c[1]], [-1, 0, 0, c[2]], [0, 0, 0, 1.0]])
        m.add("hand_wheel", *(s.apply_transform(place) or s for s in spokes))
    t = m.number(0, 2 * np.pi)
    out = x + 0.024 * scale
    end = vec(out, a[1] + 0.9 * r * np.cos(t), a[2] + 0.9 * r * np.sin(t))
    m.add(
        "hand_wheel",
        rod((x, a[1], a[2]), (out + 0.005 * scale, a[1], a[2]), 0.012 * scale, n),
        bar((out, a[1], a[2]), end, 0.006 * scale, 0.014 * scale),
    )
    m.add("hand_wheel", rod(end - vec(0.003, 0, 0), end + vec(0.045, 0, 0) * scale, 0.004 * scale, 8))
    m.spin("hand_wheel", (x, a[1], a[2]), (1, 0, 0))
    m.add(
        "crank_grip",
        lathe(
            end + vec(0.005, 0, 0) * scale,
            (1, 0, 0),
            [(q * scale, h * scale) for q, h in ((0.008, 0), (0.013, 0.015), (0.01, 0.035), (0.006, 0.042))],
            n,
        ),
    )
    m.spin("crank_grip", end, (1, 0, 0), "hand_wheel")


def _trims(
    m: Model, style: str, x: tuple[float, float], y: tuple[float, float], levels: tuple[float, float, float], scale: float
) -> None:
    """Knobs for stitch and tension, a spool on its pin, a button for reverse, a handle on top."""
    top, arm, bed = levels
    panel = front(y[0] - 0.001, 0, 0)
    if m.chance(0.7):
        add_knob(m, "stitch_knob", panel, x[1], bed + 0.45 * (top - bed), 0.014 * scale, style)
    if m.chance(0.6):
        add_knob(m, "tension_knob", panel, x[0] + 0.004 * scale, top - 0.8 * arm, 0.01 * scale, style)
    if m.chance(0.4):
        add_button(
            m, "reverse_button", panel, x[1], bed + 0.25 * (top - bed), (0.018 * scale, 0.012 * scale, 0.006 * scale), style
        )
    a = 0.3 * x[0] + 0.7 * x[1]
    m.add(BASE, rod((a, y[1], top - 0.01), (a, y[1], top + 0.05 * scale), 0.002, 6))
    if m.chance(0.6):
        m.add(
            "spool",
            lathe(
                (a, y[1], top + 0.001),
                (0, 0, 1),
                [
                    (q * scale, h * scale)
                    for q, h in ((0.013, 0), (0.013, 0.004), (0.009, 0.007), (0.01, 0.03), (0.013, 0.033), (0.013, 0.037))
                ],
                12,
            ),
        )
        m.spin("spool", (a, y[1], top), (0, 0, 1))
    if m.chance(0.35):
        b = 0.7 * x[0] + 0.3 * x[1]
        path = [
            vec(b - 0.04, y[1], top - 0.002),
            vec(b - 0.035, y[1], top + 0.03),
            vec(b + 0.035, y[1], top + 0.03),
            vec(b + 0.04, y[1], top - 0.002),
        ]
        m.add(BASE, tube([b * vec(1, 0, 0) + (p - b * vec(1, 0, 0)) * (scale, 1, 1) for p in path], 0.005, 8))
