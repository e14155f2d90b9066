"""Camera tripods and music stands."""

from __future__ import annotations

import numpy as np
import trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import (
    Point,
    ball,
    box,
    prism,
    rectangle,
    rod,
    rounded,
    tube,
    turned,
    vec,
)
from training.kinds.wheels import beam

AROUND = 2 * np.pi / 3 * np.arange(3)


def outward(angle: float) -> np.ndarray:
    return vec(np.cos(angle), np.sin(angle), 0)


def swung(point: Point, axis: Point, degrees: float, about: Point = (0, 0, 0)) -> np.ndarray:
    """Turn a point about a line."""
    turn = trimesh.transformations.rotation_matrix(np.deg2rad(degrees), axis, about)
    return turn[:3, :3] @ np.asarray(point, float) + turn[:3, 3]


def camera_tripod(m: Model) -> None:
    """A tripod, standing or folded up: legs that spread and slide out, a column, a pan and tilt head, perhaps a camera."""
    high, folded, n = m.number(0.7, 1.2), m.chance(0.25), m.pick(8, 12, 16)
    spread = 2.0 if folded else m.number(18, 26)
    crown = rod((0, 0, high - 0.025), (0, 0, high + 0.025), 0.035, n)
    m.add(
        BASE, crown if m.chance(0.5) else prism([(0.06, -0.035), (0, 0.07), (-0.06, -0.035)], "z", (high - 0.02, high + 0.02))
    )
    round_, slides, t = m.chance(0.6), m.chance(0.8), m.number(0.012, 0.016)
    long = high / np.cos(np.deg2rad(spread))
    for k, a in enumerate(AROUND - np.pi / 2):
        _leg(m, f"leg_{k}", a, 0.05 * outward(a) + (0, 0, high), (spread, long, t), round_, slides)
    m.add(
        "column",
        rod((0, 0, high - m.number(0.2, 0.35)), (0, 0, high + 0.12), 0.012, n),
        rod((0, 0, high + 0.11), (0, 0, high + 0.125), 0.025, n),
    )
    m.add(BASE, rod((0, 0, high - 0.16), (0, 0, high - 0.02), 0.018, n))
    m.slide("column", (0, 0, 1), m.number(0.12, 0.2))
    m.add(
        BASE,
        rod((0, 0, high + 0.02), (0, 0, high + 0.05), 0.02, n),
        rod((0, -0.01, high + 0.035), (0, -0.04, high + 0.035), 0.007, 8),
    )
    if m.chance(0.4):
        at = vec(0.034, 0, high)
        m.add(
            "crank",
            rod(at, at + vec(0.02, 0, 0), 0.012, 10),
            beam(at + vec(0.018, 0, 0), at + vec(0.018, -0.045, 0), 0.006, 0.012),
            rod(at + vec(0.018, -0.045, 0), at + vec(0.045, -0.045, 0), 0.006, 8),
        )
        m.spin("crank", at, (1, 0, 0))
    _pan_head(m, high + 0.125, n)


def _leg(
    m: Model, part: str, angle: float, top: np.ndarray, size: tuple[float, float, float], round_: bool, slides: bool
) -> None:
    spread, long, t = size
    lean, out = np.deg2rad(spread), outward(angle)
    way = np.sin(lean) * out - np.cos(lean) * vec(0, 0, 1)
    side = np.cross(out, (0, 0, 1))
    knee, foot = top + 0.55 * long * way, top + long * way
    upper = (
        [rod(top, knee, t, 10)]
        if round_
        else [beam(top + s * 0.8 * t * side, knee + s * 0.8 * t * side, 0.6 * t, 1.6 * t, side) for s in (-1, 1)]
    )
    m.add(
        part,
        *upper,
        rod(knee - 0.03 * way, knee + 0.01 * way, 1.4 * t, 8),
        rod(top - 1.5 * t * side, top + 1.5 * t * side, 0.9 * t, 10),
    )
    if m.chance(0.5):
        m.add(part, rod(top + 0.08 * way, top + 0.3 * way, 1.4 * t, 10))
    m.add(BASE, rod(top * (0, 0, 1), top - 0.012 * out, 1.2 * t, 8))
    lower = f"{part}_lower" if slides else part
    m.add(
        lower, rod(knee - 0.35 * long * way if round_ else knee - 0.2 * way, foot, 0.75 * t, 10), ball(foot, (1.3 * t,) * 3, 8)
    )
    m.hinge(
        part, top, np.cross((0, 0, -1), out), (-spread + 2 if spread > 3 else 0, m.pick(45, 60) - spread if spread > 3 else 24)
    )
    if slides:
        m.slide(lower, way, 0.3 * long, part)


def _pan_head(m: Model, z: float, n: int) -> None:
    m.add(
        "pan",
        rod((0, 0, z), (0, 0, z + 0.03), 0.025, n),
        *(box((s * 0.018, s * 0.028), (-0.015, 0.015), (z + 0.02, z + 0.065)) for s in (-1, 1)),
    )
    m.spin("pan", (0, 0, z), (0, 0, 1), "column")
    at, top = vec(0, 0, z + 0.055), z + 0.085
    m.add(
        "tilt",
        rod(at - vec(0.017, 0, 0), at + vec(0.017, 0, 0), 0.017, n),
        box((-0.015, 0.015), (-0.015, 0.015), (z + 0.055, top)),
    )
    m.add("tilt", box((-0.035, 0.035), (-0.04, 0.04), (top, top + 0.012)))
    if m.chance(0.8):
        end = at + vec(m.pick(0, 0.05), m.number(0.18, 0.26), -m.number(0.05, 0.1))
        m.add("tilt", rod(at, end, 0.005, 8), rod(at + 0.6 * (end - at), end, 0.012, n))
    if m.chance(0.5):
        wide, tall = m.number(0.1, 0.14), m.number(0.07, 0.1)
        body = (top + 0.012, top + 0.012 + tall)
        m.add(
            "tilt",
            box((-wide / 2, wide / 2), (-0.025, 0.035), body),
            rod((0, -0.1, body[0] + 0.45 * tall), (0, -0.02, body[0] + 0.45 * tall), 0.4 * tall, n),
        )
        m.add(
            "tilt",
            box((-0.02, 0.02), (-0.02, 0.03), (body[1], body[1] + 0.02)),
            rod((0.4 * wide, 0, body[1]), (0.4 * wide, 0, body[1] + 0.012), 0.009, 8),
        )
    m.hinge("tilt", at, (-1, 0, 0), (-m.pick(30, 60), m.pick(60, 80)), "pan")
    m.add("pan", rod((0.028, 0, at[2]), (0.05, 0, at[2]), 0.01, 8))


def music_stand(m: Model) -> None:
    """A stand for sheet music: a plate, a frame of bars or a lattice as desk, a post that slides up, feet, paper clips."""
    high, n, t = m.number(0.65, 0.8), m.pick(8, 12, 16), m.number(0.009, 0.013)
    foot = m.pick("legs", "legs", "disc", "curved")
    if foot == "disc":
        m.add(BASE, rod((0, 0, 0), (0, 0, 0.02), m.number(0.15, 0.2), 2 * n))
    for a in AROUND - np.pi / 2 if foot != "disc" else ():
        end, up = m.number(0.24, 0.26) * outward(a), m.number(0.26, 0.3)
        if foot == "legs":
            m.add(
                BASE,
                beam(end, (0, 0, up), 0.012, 0.008, np.cross(outward(a), (0, 0, 1))),
                beam(0.55 * end + (0, 0, 0.45 * up), (0, 0, 0.06), 0.012, 0.005, np.cross(outward(a), (0, 0, 1))),
            )
        else:
            m.add(
                BASE,
                tube([(0, 0, 0.16), 0.3 * end + (0, 0, 0.15), 0.75 * end + (0, 0, 0.04), end + vec(0, 0, 0.012)], 0.011, 6),
            )
        m.add(BASE, ball(end + vec(0, 0, 0.008), (0.013,) * 3, 6))
    m.add(
        BASE,
        rod((0, 0, 0.012 if foot == "disc" else 0.05), (0, 0, high), t, n),
        rod((0, 0, high - 0.04), (0, 0, high), 1.5 * t, n),
    )
    m.add(BASE, rod((0, 0, high - 0.02), (0, -0.05, high - 0.02), 0.005, 6), ball((0, -0.05, high - 0.02), (0.012,) * 3, 8))
    top = high + m.number(0.12, 0.3)
    m.add("post", rod((0, 0, 0.3 * high), (0, 0, top), 0.65 * t, n), box((-0.02, 0.02), (-0.012, 0.012), (top - 0.03, top)))
    m.slide("post", (0, 0, 1), (-m.pick(0, 0.1), m.number(0.2, 0.3)))
    _music_desk(m, top, n)


def _music_desk(m: Model, top: float, n: int) -> None:
    half, tall, style = m.number(0.21, 0.27), m.number(0.3, 0.36), m.pick("plate", "plate", "holes", "bars")
    low, y, lean = top - 0.08, -0.02, m.number(15, 35)
    pivot, x, z = vec(0, -0.012, top - 0.012), (-half, half), (low, low + tall)
    desk = [
        box((-0.03, 0.03), (y, -0.008), (top - 0.03, top + 0.01)),
        box(x, (y - m.number(0.04, 0.06), y), (low - 0.006, low)),
    ]
    desk.append(box(x, (desk[1].bounds[0, 1] - 0.003, desk[1].bounds[0, 1]), (low - 0.006, low + 0.012)))
    plate = m.pick(rectangle(x, z), rounded(x, z, 0.05), rounded((-half, half), z, 0.12))
    if style == "holes":
        spots = [(a, b) for a in np.linspace(-0.7, 0.7, 4) * half for b in low + np.array([0.25, 0.5, 0.75]) * tall]
        for a, b in spots:
            plate = plate.difference(rounded((a - 0.022, a + 0.022), (b - 0.022, b + 0.022), 0.02, 3))
    if style == "bars":
        desk += [
            beam((-half, y - 0.002, c), (half, y - 0.002, c), 0.014, 0.004, (0, 0, 1))
            for c in np.linspace(low + 0.01, low + tall, 4)
        ]
        desk += [
            beam((a, y - 0.002, low), (a * 0.9, y - 0.002, low + tall), 0.014, 0.004)
            for a in np.linspace(-half, half, m.pick(3, 4, 5))
        ]
    else:
        desk.append(prism(plate, "y", (y - 0.004, y)))
    m.add("desk", *(turned(s, (-1, 0, 0), lean, pivot) for s in desk))
    m.hinge("desk", pivot, (-1, 0, 0), (-lean, m.pick(40, 55)), "post")
    for s in (-1, 1) if m.chance(0.6) else ():
        at, part = vec(s * 0.55 * half, y - 0.008, low + 0.004), f"clip_{(s + 1) // 2}"
        wire = tube([at, at + vec(s * 0.3 * half, 0, 0.05), at + vec(s * 0.3 * half, 0, 0.11)], 0.003, 6)
        pieces = [wire, rod(at - vec(0, 0.002, 0), at + vec(0, 0.008, 0), 0.007, 8)]
        m.add(part, *(turned(p, (-1, 0, 0), lean, pivot) for p in pieces))
        way = swung((0, -1, 0), (-1, 0, 0), lean)
        foot = swung(at, (-1, 0, 0), lean, pivot)
        m.hinge(part, foot, s * way, m.pick(40, 60), "desk")
