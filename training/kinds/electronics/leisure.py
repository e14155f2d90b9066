"""Telescopes."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh
from trimesh.creation import annulus

from training.kinds.electronics.stands import AROUND, outward, swung
from training.kinds.model import BASE, Model
from training.kinds.solids import (
    ball,
    box,
    moved,
    prism,
    ring,
    rod,
    rounded,
    tube,
    turned,
    vec,
)
from training.kinds.wheels import beam


def telescope(m: Model) -> None:
    """A reflector in a box on the ground, a refractor on a tripod, or a short tube in a fork; focuser, finder, knobs."""
    style, n = m.pick("box", "tripod", "fork"), m.pick(16, 20, 28)
    if style == "box":
        r, long, rear = m.number(0.09, 0.15), m.number(0.95, 1.3), m.number(0.32, 0.42)
        pivot = vec(0, 0, rear * long + 0.1)
        _rocker_box(m, r, pivot[2], n)
    else:
        short = style == "fork"
        r, long, rear = (
            (m.number(0.1, 0.14), m.number(0.3, 0.38), 0.5) if short else (m.number(0.04, 0.06), m.number(0.65, 1.0), 0.5)
        )
        pivot = _tripod_mount(m, r, m.number(0.85, 1.15), short, n)
    rest, up = m.pick(0.0, 20.0, 35.0, 50.0), (-1, 0, 0)
    front, back = pivot - vec(0, (1 - rear) * long, 0), pivot + vec(0, rear * long, 0)
    pieces: dict[str, list[Trimesh]] = {"tube": _tube(m, style, r, front, back, pivot, n)}
    if style == "box":
        side = vec(1, 0, 0) if m.chance(0.5) else vec(0.6, 0, 0.8)
        at, way = front + vec(0, 0.14 * long, 0) + 0.98 * r * side, side
    else:
        at, way = back, vec(0, 1, 0)
    pieces["tube"].append(rod(at - 0.01 * way, at + 0.035 * way, 0.034, n))
    pieces["focuser"] = [rod(at, at + 0.075 * way, 0.026, n)]
    end = at + 0.075 * way
    if style == "box" or m.chance(0.4):
        pieces["focuser"].append(rod(end, end + 0.05 * way, 0.018, n))
    else:
        pieces["focuser"] += [
            rod(end, end + vec(0, 0.03, 0), 0.02, n),
            beam(end + vec(0, 0.02, -0.02), end + vec(0, 0.06, 0.02), 0.035, 0.035),
        ]
        pieces["focuser"].append(rod(end + vec(0, 0.05, 0.01), end + vec(0, 0.055, 0.09), 0.017, n))
    across = vec(0, 1, 0) if style == "box" else vec(1, 0, 0)
    knob = at + 0.02 * way + (vec(0, 0, 0) if style == "box" else vec(0, 0, -0.03))
    if m.chance(0.6):
        pieces["focus_knob"] = [
            rod(knob - 0.05 * across, knob + 0.05 * across, 0.006, 8),
            *(rod(knob + s * 0.042 * across, knob + s * 0.058 * across, 0.016, n) for s in (-1, 1)),
        ]
    turn = swung(way, up, rest)
    for part, solids in pieces.items():
        m.add(part, *(turned(s, up, rest, pivot) for s in solids))
    m.hinge("tube", pivot, up, (-rest - (0 if style == "box" else 10), m.pick(75, 85) - rest), "mount")
    m.slide("focuser", turn, m.number(0.03, 0.06), "tube")
    if "focus_knob" in pieces:
        axis = swung(across, up, rest)
        m.spin("focus_knob", swung(knob, up, rest, pivot), axis, "tube")


def _tube(m: Model, style: str, r: float, front: np.ndarray, back: np.ndarray, pivot: np.ndarray, n: int) -> list[Trimesh]:
    long, y = back[1] - front[1], vec(0, 1, 0)
    if style == "tripod":
        shield = front + m.number(0.12, 0.2) * y
        found = [
            rod(shield, back - 0.12 * y, r, n),
            rod(front, shield, 1.2 * r, n),
            rod(back - 0.12 * y, back - 0.08 * y, 0.8 * r, n),
            rod(back - 0.09 * y, back, 0.65 * r, n),
        ]
    else:
        pipe = turned(annulus(0.94 * r, r, long, sections=n), (1, 0, 0), 90, (0, 0, 0))
        found = [moved(pipe, (front + back) / 2), rod(back - 0.02 * y, back, 1.03 * r, n)]
        found += [moved(turned(annulus(0.9 * r, 1.05 * r, 0.025, sections=n), (1, 0, 0), 90, (0, 0, 0)), front + 0.0125 * y)]
        if style == "fork":
            found += [
                rod(front + 0.02 * y, front + 0.026 * y, 0.95 * r, n),
                rod(front + 0.005 * y, front + 0.026 * y, 0.3 * r, n),
            ]
        elif m.chance(0.6):
            found += [
                rod(front + vec(0, 0.14 * long, 0) - vec(0.95 * r, 0, 0), front + vec(0.95 * r, 0.14 * long, 0), 0.003, 6)
            ]
    bands = m.pick((0.0,), (-0.1, 0.1)) if style != "fork" else (0.0,)
    found += [ring(pivot + b * y * long, y, r * 1.02, 0.008, n) for b in bands]
    if style == "box":
        found += [rod(pivot - vec(r + 0.045, 0, 0), pivot + vec(r + 0.045, 0, 0), 0.5 * r, n)]
    if m.chance(0.75):
        a = (
            back - vec(0, m.number(0.15, 0.3) * long, -r - 0.035)
            if style != "box"
            else front + vec(-0.3 * r, 0.1 * long, r + 0.03)
        )
        found += [
            rod(a - 0.07 * y, a + 0.09 * y, 0.016, 12),
            rod(a - 0.1 * y, a - 0.06 * y, 0.021, 12),
            box((a[0] - 0.008, a[0] + 0.008), (a[1] - 0.03, a[1] + 0.03), (a[2] - 0.05, a[2] - 0.01)),
        ]
    return found


def _rocker_box(m: Model, r: float, high: float, n: int) -> None:
    wide, floor = r + m.number(0.012, 0.025), 0.075
    disc = wide + m.number(0.08, 0.14)
    m.add(
        BASE,
        rod((0, 0, 0.03), (0, 0, 0.05), disc, n),
        *(rod(0.8 * disc * outward(a), 0.8 * disc * outward(a) + (0, 0, 0.03), 0.03, 10) for a in AROUND),
    )
    m.add(
        "mount",
        rod((0, 0, 0.053), (0, 0, floor), disc, n) if m.chance(0.6) else box((-disc, disc), (-disc, disc), (0.053, floor)),
    )
    shape = rounded((-0.85 * disc, 0.85 * disc), (floor, high + 0.2 * r), 0.3 * r).difference(
        rounded((-0.5 * r, 0.5 * r), (high - 0.5 * r, high + 1), 0.49 * r)
    )
    m.add("mount", *(prism(shape, "x", (s * wide, s * (wide + 0.02))) for s in (-1, 1)))
    m.add(
        "mount", box((-wide, wide), (-0.85 * disc, -0.85 * disc + 0.02), (floor, floor + m.number(0.3, 0.5) * (high - floor)))
    )
    if m.chance(0.5):
        m.add(
            "mount",
            tube(
                [
                    (-0.06, -0.86 * disc, floor + 0.12),
                    (-0.06, -0.93 * disc, floor + 0.12),
                    (0.06, -0.93 * disc, floor + 0.12),
                    (0.06, -0.86 * disc, floor + 0.12),
                ],
                0.008,
                6,
            ),
        )
    m.spin("mount", (0, 0, 0.052), (0, 0, 1))


def _tripod_mount(m: Model, r: float, high: float, fork: bool, n: int) -> np.ndarray:
    spread, wood = m.number(0.35, 0.48), m.chance(0.4)
    m.add(BASE, rod((0, 0, high - 0.06), (0, 0, high), 0.06, n))
    for a in AROUND - np.pi / 2 + m.pick(0, np.pi):
        top, foot = 0.06 * outward(a) + (0, 0, high - 0.03), spread * outward(a)
        knee = top + 0.6 * (foot - top)
        side = np.cross(outward(a), (0, 0, 1))
        if wood:
            m.add(
                BASE,
                *(beam(top + s * 0.025 * side, knee + s * 0.015 * side, 0.014, 0.03, side) for s in (-1, 1)),
                beam(knee + 0.3 * (top - knee), foot, 0.018, 0.028, side),
            )
        else:
            m.add(BASE, rod(top, knee, 0.018, 10), rod(knee, foot, 0.013, 10), rod(knee - 0.03 * (knee - top), knee, 0.023, 8))
        mid = top + 0.5 * (foot - top)
        m.add(BASE, rod(mid, (0, 0, mid[2] - 0.02), 0.007, 6), ball(foot, (0.02, 0.02, 0.012), 8))
    m.add(BASE, rod((0, 0, mid[2] - 0.028), (0, 0, mid[2] - 0.016), m.pick(0.03, 0.12), m.pick(3, n)))
    out, top = r + 0.025, high + (0.58 * 0.4 if fork else 0.07) + r
    m.add("mount", rod((0, 0, high + 0.002), (0, 0, high + 0.045), 0.05 if not fork else out, n))
    if fork and m.chance(0.5):
        m.add(
            "mount",
            box((out - 0.02, out + 0.05), (-0.06, 0.06), (high + 0.01, top + 0.06)),
            box((0, out), (-0.05, 0.05), (high + 0.01, high + 0.05)),
        )
    else:
        t = 0.03 if fork else 0.012
        m.add(
            "mount",
            *(box((s * out, s * (out + t)), (-0.03 - t, 0.03 + t), (high + 0.01, top + 0.03)) for s in (-1, 1)),
            box((-out - t, out + t), (-0.03, 0.03), (high + 0.01, high + 0.05)),
        )
        m.add("mount", *(rod((s * (r - 0.01), 0, top), (s * (out + t + 0.03), 0, top), 0.018, 12) for s in (-1, 1)))
    if m.chance(0.5):
        m.add(
            "mount",
            rod((0, 0.03, high + 0.03), (0.03, 0.25, high + 0.02), 0.006, 6),
            rod((0.02, 0.2, high + 0.022), (0.03, 0.25, high + 0.02), 0.012, 8),
        )
    m.spin("mount", (0, 0, high), (0, 0, 1))
    return vec(0, 0, top)
