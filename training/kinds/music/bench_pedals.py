"""The pedals of a drum set."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.bench_style import STYLES, bar, body, lathe, without
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod, rounded, tube, vec


def drum_set_pedal(m: Model) -> None:
    """A bass drum pedal, single or double, perhaps on its drum, or the pedal of a hi-hat with cymbals."""
    style, design = m.pick(*STYLES), m.pick("single", "single", "double", "hi_hat")
    n = max(12, m.sections())
    if design == "hi_hat":
        _hi_hat(m, style, n)
        return
    for k, x in enumerate((-0.09, 0.09) if design == "double" else (0.0,)):
        _bass_pedal(m, style, x, f"_{k}" if design == "double" else "")
    if design == "double":
        m.add(BASE, box((-0.09, 0.09), (0.02, 0.05), (0.002, 0.012)))
    if m.chance(0.35):
        r, long = m.number(0.22, 0.28), m.number(0.3, 0.42)
        shell = rod((0, 0.15, r), (0, 0.15 + long, r), r, 2 * n)
        m.add(BASE, without(shell, (0, 1, 0)) if style == "sheet" else shell)
        m.add(BASE, *(ring((0, y, r), (0, 1, 0), r + 0.004, 0.01, 2 * n) for y in (0.155, 0.145 + long)))
        m.add(BASE, *(rod(vec(s * (r - 0.04), 0.2, r * 0.7), vec(s * (r + 0.14), 0.13, 0.0), 0.007, 8) for s in (-1, 1)))
        m.add(BASE, box((-0.02, 0.02), (0.05, 0.16), (0.004, 0.03)))


def _board(m: Model, style: str, part: str, x: float, slope: float, long: float, heel: tuple[float, float]) -> None:
    """A foot board that is trodden down about its heel."""
    w, thick = m.number(0.038, 0.046), 0.008
    y, z = heel
    t = np.deg2rad(slope)
    end = vec(x, y + long * np.cos(t), z + long * np.sin(t))
    m.add(part, bar((x, y, z), end, 2 * w, thick) if style != "soft" else _rounded_board(x, y, z, w, long, slope))
    if style in ("cad", "flush", "old"):
        for share in (0.3, 0.5, 0.7, 0.85):
            c = vec(x, y, z) + share * (end - vec(x, y, z)) + 0.005 * vec(0, -np.sin(t), np.cos(t))
            m.add(part, bar(c - vec(0.8 * w, 0, 0), c + vec(0.8 * w, 0, 0), 0.006, 0.004, (0, 1, 0)))
    m.add(BASE, rod((x - w - 0.008, y, z), (x + w + 0.008, y, z), 0.005, 8))
    m.add(
        BASE,
        *(
            box((x + s * (w + 0.005) - 0.003, x + s * (w + 0.005) + 0.003), (y - 0.01, y + 0.01), (0.002, z + 0.006))
            for s in (-1, 1)
        ),
    )
    m.hinge(part, (x, y, z), (-1, 0, 0), 0.6 * slope)


def _rounded_board(x: float, y: float, z: float, w: float, long: float, slope: float) -> Trimesh:
    solid = prism(rounded((x - w, x + w), (y - 0.01, y + long), 0.03), "z", (z - 0.004, z + 0.004))
    solid.apply_transform(_tilt(slope, (x, y, z)))
    return solid


def _tilt(degrees: float, about: tuple[float, float, float]) -> np.ndarray:
    t = np.deg2rad(degrees)
    place = np.eye(4)
    place[1:3, 1:3] = [[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]]
    place[:3, 3] = np.array(about) - place[:3, :3] @ np.array(about)
    return place


def _bass_pedal(m: Model, style: str, x: float, end: str) -> None:
    """A base with two posts, an axle with the beater, a foot board."""
    plate, tall = m.chance(0.6), m.number(0.13, 0.16)
    w = 0.055
    if plate:
        m.add(BASE, body(style, (x - 0.045, x + 0.045), (-0.27, 0.05), (0.0, 0.008)))
    else:
        m.add(
            BASE,
            box((x - 0.04, x + 0.04), (-0.27, -0.23), (0, 0.006)),
            box((x - w - 0.008, x + w + 0.008), (0.0, 0.05), (0, 0.01)),
        )
        m.add(BASE, *(rod((x + s * 0.03, -0.25, 0.004), (x + s * 0.03, 0.03, 0.005), 0.003, 6) for s in (-1, 1)))
    m.add(BASE, box((x - w - 0.008, x + w + 0.008), (0.01, 0.045), (0.0, 0.01)))
    for s in (-1, 1):
        post = (x + s * w - 0.007, x + s * w + 0.007)
        m.add(BASE, body(style, post, (0.018, 0.038), (0.006, tall + 0.012)))
    _board(m, style, f"foot_board{end}", x, m.number(16, 22), m.number(0.22, 0.25), (-0.25, 0.016))
    part, axle = f"beater{end}", vec(x, 0.028, tall)
    lean, long = np.deg2rad(m.number(35, 50)), m.number(0.15, 0.2)
    up = vec(0, -np.sin(lean), np.cos(lean))
    tip = axle + long * up
    m.add(part, rod(axle - vec(w, 0, 0), axle + vec(w, 0, 0), 0.005, 8), rod(axle, tip, 0.0035, 8))
    m.add(part, rod(axle - vec(0.012, 0, 0), axle + vec(0.012, 0, 0), 0.014, 12))
    ahead = vec(0, up[2], -up[1])
    felt = (
        ball(tip, (0.022, 0.026, 0.024), 12)
        if style in ("soft", "old")
        else rod(tip - 0.024 * ahead, tip + 0.024 * ahead, 0.02, m.sections())
    )
    m.add(part, felt)
    m.hinge(part, axle, (-1, 0, 0), float(np.rad2deg(lean)) + 5)
    if style in ("cad", "old", "flush"):
        side = x + w + 0.012
        m.add(
            BASE,
            tube(
                [(side + 0.004 * np.cos(t), 0.028 + 0.004 * np.sin(t), 0.03 + t * 0.0012) for t in np.arange(0, 60, 0.8)],
                0.0012,
                5,
            ),
        )
        m.add(BASE, rod((side - 0.008, 0.028, 0.029), (side + 0.006, 0.028, 0.029), 0.003, 6))


def _hi_hat(m: Model, style: str, n: int) -> None:
    """A stand with three legs: the upper cymbal goes down with its rod, the pedal too, a wing nut turns."""
    h, r = m.number(0.7, 0.85), m.number(0.15, 0.19)
    m.add(BASE, rod((0, 0, 0.03), (0, 0, h), 0.011, n), rod((0, 0, 0.45), (0, 0, 0.49), 0.018, n))
    for t in np.deg2rad(np.array([90, 210, 330]) + m.pick(0, 15)):
        foot = vec(0.26 * np.cos(t), 0.26 * np.sin(t), 0.008)
        m.add(BASE, rod((0, 0, 0.34), foot, 0.008, 8), ball(foot, (0.012, 0.012, 0.008), 8))
    m.add(
        BASE,
        rod((0, 0, 0.33), (0, 0, 0.35), 0.02, n),
        box((-0.04, 0.04), (-0.27, 0.02), (0, 0.006)),
        box((-0.02, 0.02), (-0.02, 0.02), (0.004, 0.04)),
    )
    _board(m, style, "foot_board", 0, m.number(14, 20), 0.22, (-0.25, 0.014))
    bow = [(0.012, 0.0), (r, -0.035), (r, -0.037), (0.25 * r, -0.012), (0.012, -0.004)]
    m.add(
        BASE,
        lathe((0, 0, h - 0.035), (0, 0, -1), [(0.008, -0.03), *bow], 2 * n),
        rod((0, 0, h - 0.02), (0, 0, h + 0.002), 0.02, n),
    )
    high = h + 0.055
    m.add(
        "cymbal",
        lathe(
            (0, 0, high),
            (0, 0, 1),
            [
                (0.004, -0.012),
                (0.25 * r, -0.014),
                (r, -0.037),
                (r, -0.035),
                (0.25 * r, -0.01),
                (0.18 * r, 0.01),
                (0.012, 0.016),
                (0.004, 0.016),
            ],
            2 * n,
        ),
    )
    m.add(
        "cymbal", rod((0, 0, h - 0.1), (0, 0, high + 0.14), 0.0035, 8), rod((0, 0, high + 0.014), (0, 0, high + 0.03), 0.016, n)
    )
    m.slide("cymbal", (0, 0, -1), 0.035)
    if m.chance(0.7):
        m.add(
            "clutch_nut",
            box((0.008, 0.034), (-0.004, 0.004), (high + 0.034, high + 0.044)),
            rod((0, 0, high + 0.03), (0, 0, high + 0.048), 0.009, 8),
        )
        m.spin("clutch_nut", (0, 0, high + 0.04), (0, 0, 1), "cymbal")
