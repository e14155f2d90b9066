"""Film cameras built on a plate at a height: a still camera, one with two lenses, a cine camera, one with bellows."""

from __future__ import annotations

import numpy as np

from training.kinds.bench_style import Panel, add_knob, bar, body, front, lathe
from training.kinds.model import Model
from training.kinds.solids import ball, box, cut, loft, prism, rectangle, ring, rod, rounded, vec

CAMERA = "camera"


def _lens(m: Model, style: str, at: np.ndarray, r: float, long: float, n: int, parent: str = CAMERA, rings: int = 2) -> None:
    """A tube to the front with rings that turn on it and glass in its end."""
    tip = at - vec(0, long, 0)
    tube = rod(at + vec(0, 0.002, 0), tip, r, 2 * n)
    m.add(
        parent, cut(tube, rod(tip - vec(0, 1, 0), tip + vec(0, 0.25 * long, 0), 0.82 * r, 2 * n)) if style != "game" else tube
    )
    m.add(parent, ball(tip + vec(0, 0.3 * long, 0), (0.81 * r, 0.12 * long, 0.81 * r), 12))
    for k in range(rings):
        y = at[1] - long * (0.2 + 0.4 * k)
        band = cut(
            rod((at[0], y, at[2]), (at[0], y - 0.26 * long, at[2]), 1.1 * r, 2 * n),
            rod((at[0], 1, at[2]), (at[0], -1, at[2]), 0.995 * r, 2 * n),
        )
        part = ("focus_ring", "aperture_ring")[k] if parent == CAMERA else f"{parent}_ring"
        m.add(
            part,
            band,
            box((at[0] - 0.001, at[0] + 0.001), (y - 0.2 * long, y - 0.05 * long), (at[2] + 1.05 * r, at[2] + 1.16 * r)),
        )
        m.hinge(part, (at[0], y, at[2]), (0, -1, 0), m.pick(90, (-60, 60), 180), parent)


def _top_controls(m: Model, style: str, w: float, top: float) -> None:
    """A button, dials, the lever to wind on and the crank to wind back."""
    panel = front(0.0, 0, top, 90)
    a = -0.36 * w
    m.add("shutter_button", rod((a, 0.012, top - 0.001), (a, 0.012, top + 0.005), 0.005, 12))
    m.slide("shutter_button", (0, 0, -1), 0.003, CAMERA)
    if m.chance(0.7):
        add_knob(m, "speed_dial", panel, -0.24 * w, 0.02, 0.009, style, 0.006, CAMERA)
    if m.chance(0.7):
        c = vec(-0.36 * w, 0.03, top)
        m.add(
            "wind_lever",
            rod(c - vec(0, 0, 0.001), c + vec(0, 0, 0.006), 0.008, 12),
            bar(c + vec(0, 0, 0.004), c + vec(-0.026, 0.006, 0.004), 0.004, 0.007, (0, 0, 1)),
        )
        m.hinge("wind_lever", c, (0, 0, 1), 130, CAMERA)
    if m.chance(0.7):
        c = vec(0.36 * w, 0.02, top)
        m.add(
            "rewind_crank",
            rod(c - vec(0, 0, 0.001), c + vec(0, 0, 0.006), 0.009, 12),
            bar(c + vec(0, 0, 0.007), c + vec(0.013, 0, 0.007), 0.003, 0.005, (0, 0, 1)),
            rod(c + vec(0.012, 0, 0.005), c + vec(0.012, 0, 0.012), 0.002, 8),
        )
        m.spin("rewind_crank", c, (0, 0, -1), CAMERA)


def _back_door(m: Model, style: str, w: float, z: tuple[float, float], y: float, inside: bool) -> None:
    """A door behind, hinged at one side."""
    s = m.pick(-1, 1)
    m.add("back_door", body("cad" if inside else style, (-0.47 * w, 0.47 * w), (y + 0.0005, y + 0.006), z, (0, -1, 0)))
    m.hinge("back_door", (s * 0.47 * w, y + 0.001, sum(z) / 2), (0, 0, -s), m.pick(100, 150), CAMERA)


def still_camera(m: Model, style: str, z: float, n: int) -> None:
    """A body with a lens, a hump or a window above it."""
    w, h, d = m.number(0.12, 0.15), m.number(0.075, 0.09), m.number(0.035, 0.045)
    shell = (
        body(style, (-w / 2, w / 2), (-0.005, d), (z - 0.001, z + h))
        if style in ("game", "sheet", "flush")
        else prism(rounded((-w / 2, w / 2), (-0.005, d), 0.018), "z", (z - 0.001, z + h))
    )
    inside = style in ("cad", "flush", "old")
    if inside:
        shell = cut(shell, box((-0.44 * w, 0.44 * w), (0.014, 1), (z + 0.012, z + h - 0.012)))
    m.add(CAMERA, shell)
    if inside:
        m.add(
            CAMERA,
            *(rod((s * 0.36 * w, 0.5 * d, z + 0.011), (s * 0.36 * w, 0.5 * d, z + h - 0.011), 0.006, 10) for s in (-1, 1)),
        )
    if m.chance(0.65):
        hump = [(-0.2 * w, z + h - 0.001), (0.2 * w, z + h - 0.001), (0.1 * w, z + h + 0.018), (-0.1 * w, z + h + 0.018)]
        m.add(CAMERA, prism(hump, "y", (-0.008, 0.8 * d)))
        top = z + h
    else:
        m.add(CAMERA, prism(rectangle((0.1 * w, 0.3 * w), (z + 0.75 * h, z + 0.93 * h), 0.003), "y", (-0.008, -0.003)))
        m.add(CAMERA, box((-0.05 * w, 0.02 * w), (-0.007, -0.003), (z + 0.78 * h, z + 0.9 * h)))
        top = z + h
    _lens(m, style, vec(0, -0.005, z + 0.47 * h), m.number(0.024, 0.032), m.number(0.03, 0.07), n)
    _top_controls(m, style, w, top)
    if m.chance(0.6):
        _back_door(m, style, w, (z + 0.006, z + h - 0.006), d, inside)


def twin_camera(m: Model, style: str, z: float, n: int) -> None:
    """An upright box with two lenses, a hood that opens on top, a knob and a crank at the side."""
    w, h, d = m.number(0.075, 0.09), m.number(0.11, 0.13), m.number(0.07, 0.09)
    m.add(CAMERA, body(style, (-w / 2, w / 2), (-0.5 * d, 0.5 * d), (z - 0.001, z + h)))
    m.add(
        "lens_board", body("flush", (-0.42 * w, 0.42 * w), (-0.5 * d - 0.008, -0.5 * d - 0.0004), (z + 0.08 * h, z + 0.95 * h))
    )
    m.slide("lens_board", (0, -1, 0), 0.015, CAMERA)
    for k, share in enumerate((0.3, 0.72)):
        _lens(m, style, vec(0, -0.5 * d - 0.008, z + share * h), 0.26 * w, 0.016, n, "lens_board", 1 if k == 0 else 0)
    top = z + h
    m.add(
        "hood",
        body(
            "cad" if style in ("sheet", "old") else style,
            (-0.45 * w, 0.45 * w),
            (-0.45 * d, 0.45 * d),
            (top + 0.0005, top + 0.008),
        ),
    )
    m.hinge("hood", (0, 0.45 * d, top), (-1, 0, 0), 90, CAMERA)
    side = Panel(vec(w / 2, 0, z), vec(0, 1, 0), vec(0, 0, 1))
    add_knob(m, "focus_knob", side, -0.2 * d, 0.4 * h, 0.014, style, 0.014, CAMERA)
    if m.chance(0.7):
        c = vec(w / 2, 0.15 * d, z + 0.7 * h)
        m.add(
            "wind_crank",
            rod(c - vec(0.001, 0, 0), c + vec(0.008, 0, 0), 0.009, 12),
            bar(c + vec(0.007, 0, 0), c + vec(0.007, 0.0, -0.03), 0.008, 0.004, (0, 1, 0)),
            rod(c + vec(0.006, 0, -0.027), c + vec(0.018, 0, -0.027), 0.004, 8),
        )
        m.spin("wind_crank", c, (1, 0, 0), CAMERA)


def cine_camera(m: Model, style: str, z: float, n: int) -> None:
    """A box with reels above it or behind it, a crank at the side, a turret or one lens, a side door."""
    w, h, d = m.number(0.07, 0.1), m.number(0.12, 0.16), m.number(0.16, 0.22)
    x = (-w / 2, w / 2)
    m.add(CAMERA, body(style, x, (-0.5 * d, 0.5 * d), (z - 0.001, z + h)))
    _reels(m, w, d, z + h, n)
    c = vec(w / 2, 0.2 * d, z + 0.45 * h)
    m.add(
        "crank",
        rod(c - vec(0.001, 0, 0), c + vec(0.014, 0, 0), 0.01, n),
        bar(c + vec(0.011, 0, 0), c + vec(0.011, 0.03, -0.035), 0.006, 0.011),
        rod(c + vec(0.009, 0.028, -0.033), c + vec(0.045, 0.028, -0.033), 0.006, n),
    )
    m.spin("crank", c, (1, 0, 0), CAMERA)
    if m.chance(0.4):
        a = vec(0, -0.5 * d, z + 0.5 * h)
        m.add("turret", rod(a + vec(0, -0.0003, 0), a - vec(0, 0.008, 0), 0.46 * w, 2 * n))
        for t in np.deg2rad([90, 210, 330]):
            b = a + 0.26 * w * vec(np.cos(t), 0, np.sin(t)) - vec(0, 0.007, 0)
            m.add(
                "turret",
                lathe(b, (0, -1, 0), [(0.15 * w, 0), (0.15 * w, 0.02), (0.19 * w, 0.03), (0.19 * w, m.number(0.034, 0.05))], n),
            )
        m.spin("turret", a, (0, -1, 0), CAMERA)
    else:
        _lens(m, style, vec(0, -0.5 * d, z + 0.5 * h), 0.3 * w, m.number(0.04, 0.08), n)
    if m.chance(0.6):
        y = (-0.4 * d, 0.4 * d)
        m.add("side_door", body("flush", (x[0] - 0.006, x[0] - 0.0005), y, (z + 0.08 * h, z + 0.92 * h)))
        m.hinge("side_door", (x[0] - 0.001, y[1], z + 0.5 * h), (0, 0, -1), 110, CAMERA)


def _reels(m: Model, w: float, d: float, top: float, n: int) -> None:
    """Two bare reels that turn, or a closed housing for them."""
    r = 0.24 * d
    bare = m.chance(0.6)
    for k, y in enumerate((-0.255 * d, 0.255 * d)):
        c = vec(0, y, top + r - 0.002)
        if bare:
            m.add(CAMERA, bar((0, 0, top - 0.005), c, 0.012, 0.012), rod(c - vec(0.015, 0, 0), c + vec(0.015, 0, 0), 0.004, 8))
            disc = cut(
                rod(c - vec(0.001, 0, 0), c + vec(0.001, 0, 0), 0.94 * r, 2 * n),
                *(
                    rod(
                        c + 0.55 * r * vec(0, np.cos(t), np.sin(t)) - vec(1, 0, 0),
                        c + 0.55 * r * vec(0, np.cos(t), np.sin(t)) + vec(1, 0, 0),
                        0.2 * r,
                        10,
                    )
                    for t in np.arange(5) * 1.2566
                ),
            )
            m.add(
                f"reel_{k}",
                *(disc.copy().apply_translation((s * 0.012, 0, 0)) for s in (-1, 1)),
                rod(c + vec(0.0065, 0, 0), c + vec(0.013, 0, 0), 0.3 * r, n),
            )
            m.spin(f"reel_{k}", c, (1, 0, 0), CAMERA)
        else:
            m.add(
                CAMERA,
                rod(c - vec(0.3 * w, 0, 0), c + vec(0.3 * w, 0, 0), r, 2 * n),
                ring(c + vec(0.3 * w, 0, 0), (1, 0, 0), 0.8 * r, 0.003, n),
            )


def bellows_camera(m: Model, style: str, z: float, n: int) -> None:
    """A wooden camera on a rail: the front standard slides, the bellows are drawn as a static skin of the back."""
    w, long = m.number(0.12, 0.18), m.number(0.12, 0.2)
    m.add(CAMERA, box((-0.3 * w, 0.3 * w), (-long - 0.02, 0.06), (z - 0.001, z + 0.012)))
    low, high = z + 0.013, z + 0.013 + w
    back = (
        prism(rectangle((-w / 2, w / 2), (low - 0.002, high), 0.012), "y", (0.0, 0.035))
        if style != "game"
        else box((-w / 2, w / 2), (0, 0.035), (low - 0.002, high))
    )
    m.add(CAMERA, back)
    m.add("back_frame", box((-0.48 * w, 0.48 * w), (0.0355, 0.042), (low, high - 0.002)))
    m.hinge("back_frame", (0, 0.036, low), (-1, 0, 0), 90, CAMERA)
    y, c = -long, (low + high) / 2
    m.add("front_standard", body(style, (-0.42 * w, 0.42 * w), (y - 0.012, y), (low, high - 0.08 * w)))
    m.add("front_standard", box((-0.25 * w, 0.25 * w), (y - 0.02, y + 0.012), (z + 0.0122, z + 0.02)))
    m.slide("front_standard", (0, 1, 0), (-0.012, 0.02), CAMERA)
    folds = 2 * m.pick(4, 6, 8) + 1
    rings = []
    for k in range(folds):
        t = k / (folds - 1)
        half = (0.46 * (1 - t) + 0.36 * t) * w * (1.0 if k % 2 == 0 else 0.88)
        at = 0.001 - t * (long)
        rings.append([(-half, at, c - half), (half, at, c - half), (half, at, c + half), (-half, at, c + half)])
    m.add(CAMERA, loft(np.array(rings)))
    _lens(m, style, vec(0, y - 0.012, c), 0.16 * w, 0.03, n, "front_standard", 1)
    add_knob(
        m, "rail_knob", Panel(vec(0.3 * w, 0, z), vec(0, 1, 0), vec(0, 0, 1)), -0.5 * long, 0.006, 0.01, style, 0.016, CAMERA
    )


CAMERAS = (still_camera, still_camera, twin_camera, cine_camera, bellows_camera)
