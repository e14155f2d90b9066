"""Theodolites."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.electronics.controls import knob
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe, upright

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def theodolite(m: Model) -> None:
    """A surveyor's instrument: a head that turns between levelling screws and telescope, on a tripod or in the hand's reach."""
    n, r, high = m.pick(16, 24), m.number(0.06, 0.08), 0.0
    if m.chance(0.35):
        high = m.number(1.0, 1.3)
        _survey_tripod(m, high, m.pick("wood", "metal"))
    m.add(
        BASE,
        prism(rounded((-r, r), (-r, r), 0.45 * r), "z", (high, high + 0.008)),
        prism(rounded((-r, r), (-r, r), 0.6 * r), "z", (high + 0.03, high + 0.042)),
    )
    for k in range(3):
        a = np.deg2rad(90 + 120 * k)
        p = vec(0.75 * r * np.cos(a), 0.75 * r * np.sin(a), high + 0.008)
        m.add(f"screw_{k}", rod(p, p + vec(0, 0, 0.022), 0.012, 12), rod(p + vec(0, 0, 0.005), p + vec(0, 0, 0.015), 0.016, 8))
        m.spin(f"screw_{k}", p, Z)
    z = high + 0.042
    m.add(BASE, lathe([(0, 0), (0.9 * r, 0), (0.7 * r, 0.03), (0, 0.03)], n, (0, 0, z)))
    z += 0.0305
    shape, half, tall = m.pick("modern", "modern", "classic"), m.number(0.065, 0.085), m.number(0.17, 0.21)
    axle = vec(0, 0, z + 0.8 * tall)
    head = _uprights(m, shape, half, tall, axle, (z, r), n)
    m.add("head", *head)
    m.spin("head", (0, 0, z), Z)
    knob(
        m,
        "pan_screw",
        (half, 0, z + 0.065) if shape == "modern" else (half + 0.01, 0, z + 0.019),
        X,
        0.011,
        "head",
    )
    if shape == "modern":
        knob(m, "tilt_screw", (half, -0.02, axle[2]), X, 0.012, "head")
    _telescope(
        m, axle, half - (0.031 if shape == "modern" else 0.009), n, 2 * (axle[2] - z - (0.077 if shape == "modern" else 0.06))
    )


def _uprights(m: Model, shape: str, half: float, tall: float, axle: np.ndarray, low: Span, n: int) -> list[Trimesh]:
    """The two posts that carry the telescope, with a keypad and a handle on new ones; low: height and radius of the foot."""
    z, r = low
    head = [rod((0, 0, z), (0, 0, z + 0.025), min(r, 0.055), n)]
    if shape == "modern":
        line = rounded((-0.05, 0.05), (z + 0.024, z + tall), 0.015)
        head += [prism(line, "x", (s * half, s * (half - 0.03))) for s in (-1, 1)]
        head.append(box((-half, half), (-0.05, 0.05), (z + 0.02, z + 0.05)))
        faces = (-1, 1) if m.chance(0.6) else (-1,)
        head += [box((-0.045, 0.045), (s * 0.05, s * 0.062), (z + 0.004, z + 0.05)) for s in faces]
        for k in range(m.pick(4, 6, 8)):
            p = vec(0.01 + 0.012 * (k % 3), -0.062, z + 0.014 + 0.012 * (k // 3))
            m.add(f"key_{k}", box((p[0] - 0.004, p[0] + 0.004), (p[1] - 0.0025, p[1] + 0.001), (p[2] - 0.004, p[2] + 0.004)))
            m.slide(f"key_{k}", Y, 0.002, "head")
    else:
        head += [beam((s * half, b, z + 0.02), (s * half, 0, axle[2]), 0.012, 0.016) for s in (-1, 1) for b in (-0.05, 0.05)]
        head += [
            box((-half - 0.01, half + 0.01), (-0.055, 0.055), (z + 0.012, z + 0.026)),
            rod((0.03, -0.03, z + 0.03), (0.03, 0.03, z + 0.03), 0.008, 10),
        ]
        head += [rod(axle + vec(s * (half - 0.008), 0, 0), axle + vec(s * (half + 0.008), 0, 0), 0.018, n) for s in (-1, 1)]
    if m.chance(0.6) and shape == "modern":
        head.append(
            tube(
                [
                    (-half + 0.015, 0, z + tall - 0.004),
                    (-half + 0.015, 0, z + tall + 0.06),
                    (half - 0.015, 0, z + tall + 0.06),
                    (half - 0.015, 0, z + tall - 0.004),
                ],
                0.009,
                8,
            )
        )
    return head


def _telescope(m: Model, axle: np.ndarray, half: float, n: int, long: float) -> None:
    """The telescope on its axle, with a ring to focus and an eyepiece that turns."""
    r = min(0.022, half - 0.008)
    profile = [
        (0, -0.5 * long),
        (0.55 * r, -0.5 * long),
        (0.7 * r, -0.2 * long),
        (r, -0.1 * long),
        (r, 0.35 * long),
        (1.15 * r, 0.4 * long),
        (1.15 * r, 0.5 * long),
        (0, 0.5 * long),
    ]
    m.add("telescope", *upright([lathe(profile, n)], Y, axle), rod(axle - vec(half, 0, 0), axle + vec(half, 0, 0), 0.7 * r, n))
    if m.chance(0.5):
        m.add("telescope", rod(axle + vec(0, -0.03, 1.2 * r), axle + vec(0, 0.03, 1.2 * r), 0.004, 8))
    if half > 0.055 and m.chance(0.7):
        m.add("telescope", ring(axle + vec(half - 0.006, 0, 0), X, 2.2 * r, 0.003, 24))
    m.spin("telescope", axle, X, "head")
    eye = axle - vec(0, 0.5 * long, 0)
    m.add(
        "eyepiece", rod(eye - vec(0, 0.018, 0), eye, 0.6 * r, n), rod(eye - vec(0, 0.02, 0), eye - vec(0, 0.014, 0), 0.7 * r, n)
    )
    m.spin("eyepiece", eye, Y, "telescope")
    at = axle - vec(0, 0.15 * long, 0)
    m.add(
        "focus_ring",
        *upright(
            [lathe([(0.8 * r, -0.012), (1.1 * r, -0.012), (1.1 * r, 0.012), (0.8 * r, 0.012), (0.8 * r, -0.012)], n)], Y, at
        ),
    )
    m.spin("focus_ring", at, Y, "telescope")


def _survey_tripod(m: Model, high: float, how: str) -> None:
    """Legs of a tripod hinged below a round plate, each of an upper part and a foot that slides out of it."""
    m.add(BASE, rod((0, 0, high - 0.025), (0, 0, high), 0.085, 24), rod((0, 0, high - 0.08), (0, 0, high - 0.02), 0.02, 10))
    spread, w = m.number(0.36, 0.45), 0.022
    for k in range(3):
        a = np.deg2rad(90 + 120 * k)
        out, side = vec(np.cos(a), np.sin(a), 0), vec(-np.sin(a), np.cos(a), 0)
        p, foot = 0.07 * out + vec(0, 0, high - 0.035), (spread + 0.07) * out
        mid = p + 0.55 * (foot - p)
        m.add(
            f"leg_{k}",
            *(beam(p + s * 0.025 * side, mid + s * 0.02 * side, w, w, side) for s in (-1, 1))
            if how == "wood"
            else (rod(p, mid, 0.017, 12),),
        )
        m.add(
            f"leg_{k}",
            beam(mid - 0.032 * side, mid + 0.032 * side, 0.03, 0.03, Z),
            rod(p - 0.04 * side, p + 0.04 * side, 0.012, 8),
        )
        m.hinge(f"leg_{k}", p, -side, (-m.number(12, 18), 10))
        inner = p + 0.3 * (foot - p)
        m.add(
            f"foot_{k}",
            beam(inner, foot, 0.02, 0.018, side) if how == "wood" else rod(inner, foot, 0.011, 10),
            ball(foot + vec(0, 0, 0.01), (0.02, 0.02, 0.02), 8),
        )
        m.slide(f"foot_{k}", foot - p, (-0.25, 0.2), f"leg_{k}")
