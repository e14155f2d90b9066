"""Easels."""

from __future__ import annotations

import numpy as np

from training.kinds.electronics.controls import knob
from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import drawer, look
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rectangle, rod, tube, vec
from training.kinds.wheels import beam

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def easel(m: Model) -> None:
    """An easel on three legs, a studio easel with a mast, or a box for a table: a tray and a clamp that slide, a picture."""
    {"tripod": _tripod_easel, "studio": _studio_easel, "box": _box_easel}[m.pick("tripod", "studio", "studio", "box")](m)


def _tripod_easel(m: Model) -> None:
    """Two front legs and a middle bar that lean, a rear leg hinged at the top."""
    high, half, w, lean = m.number(1.3, 1.8), m.number(0.28, 0.4), m.number(0.022, 0.04), m.number(10, 16)
    back = high * np.tan(np.deg2rad(lean))
    top = vec(0, back, high)
    for s in (-1, 1):
        m.add(BASE, beam((s * half, 0, 0), top + vec(s * 0.05, 0, 0), w, 0.7 * w))
    m.add(BASE, box((-0.07, 0.07), (back - 0.012, back + 0.012), (high - 0.05, high)))
    up = vec(0, back, high) / np.hypot(back, high)
    c = m.number(0.35, 0.45)
    at = c * top
    reach = half * (1 - c) + 0.05
    m.add(BASE, beam(at - vec(reach, 0, 0), at + vec(reach, 0, 0), 0.04, 0.014, up))
    m.add(
        BASE,
        beam(0.2 * top, top, w, 0.8 * w),
        beam(0.2 * top - vec(half * 0.82, 0, 0), 0.2 * top + vec(half * 0.82, 0, 0), w, 0.012, up),
    )
    out = vec(0, -up[2], up[1])
    pivot = top - 0.02 * up - 0.02 * out
    foot = vec(0, back + m.number(0.35, 0.55) * high * 0.9, 0)
    m.add("rear_leg", beam(pivot, foot, w, 0.7 * w), rod(pivot - vec(0.03, 0, 0), pivot + vec(0.03, 0, 0), 0.008, 8))
    m.hinge("rear_leg", pivot, X, (-m.number(15, 30), m.number(4, 10)))
    front = at + 0.02 * out
    m.add("tray", box((-half * 0.9, half * 0.9), (front[1] - 0.07, front[1] - 0.001), (front[2], front[2] + 0.015)))
    m.add("tray", box((-half * 0.9, half * 0.9), (front[1] - 0.078, front[1] - 0.07), (front[2], front[2] + 0.035)))
    m.slide("tray", up, (-0.15 * high, 0.2 * high) if m.chance(0.5) else 0.25 * high)
    tall = m.number(0.3, 0.45) * high
    if m.chance(0.6):
        low = front + 0.018 * up
        m.add("tray", beam(low, low + tall * up, m.number(0.4, 0.8), 0.02))
        if m.chance(0.5):
            a = low + tall * up - 0.02 * out
            m.add(
                "clamp",
                beam(a + 0.002 * up, a + 0.06 * up, 0.07, 0.03),
                beam(a - 0.01 * up + 0.045 * out, a + 0.03 * up + 0.045 * out, 0.04, 0.02),
            )
            m.slide("clamp", up, 0.5 * (high / np.cos(np.deg2rad(lean)) - np.linalg.norm(a)))


def _studio_easel(m: Model) -> None:
    """Two posts on runners with cross bars; a mast slides between them and carries a clamp; the frame may tilt."""
    high, half, w = m.number(1.5, 2.1), m.number(0.25, 0.35), m.number(0.04, 0.06)
    deep, tilts = m.number(0.5, 0.65), m.chance(0.5)
    frame = "frame" if tilts else BASE
    for s in (-1, 1):
        m.add(BASE, box((s * half - w / 2, s * half + w / 2), (-0.15, deep), (0.05, 0.05 + w)))
        m.add(BASE, *(rod((s * half, y, 0), (s * half, y, 0.051), 0.025, 12) for y in (-0.11, deep - 0.05)))
    m.add(BASE, box((-half, half), (deep - w, deep), (0.05, 0.05 + w)), box((-half, half), (0.1, 0.1 + w), (0.05, 0.05 + w)))
    zs = (0.05 + w + 0.001, 0.72 * high)
    m.add(frame, *(box((s * half - w / 2, s * half + w / 2), (0, w), zs) for s in (-1, 1)))
    m.add(frame, *(box((-half, half), (0.004, w - 0.004), (z, z + 0.07)) for z in (zs[0] + 0.12, zs[1] - 0.08)))
    if tilts:
        m.hinge("frame", (0, w / 2, zs[0] + 0.02), X, (-m.number(5, 10), m.number(15, 30)))
        m.add("frame", rod((-half - 0.04, w / 2, zs[0] + 0.02), (half + 0.04, w / 2, zs[0] + 0.02), 0.008, 8))
        m.add(
            BASE, *(box((s * (half + w / 2 + 0.002), s * (half + w / 2 + 0.02)), (0, w), (0.06, zs[0] + 0.05)) for s in (-1, 1))
        )
    else:
        m.add(BASE, *(beam((s * half, w, 0.55 * high), (s * half, deep - w, 0.05 + w), 0.6 * w, 0.6 * w) for s in (-1, 1)))
    mast = (zs[0] + 0.25, high)
    m.add("mast", box((-w / 2, w / 2), (-0.022, 0.003), mast))
    m.add("mast", box((-0.05, 0.05), (-0.05, -0.02), (high - 0.12, high - 0.09)))
    m.slide("mast", Z, m.number(0.25, 0.5), frame)
    z = m.number(0.42, 0.6)
    tray = [box((-0.45, 0.45), (-0.14, -0.024), (z, z + 0.018)), box((-0.45, 0.45), (-0.15, -0.14), (z, z + 0.04))]
    if m.chance(0.35):
        tray.append(box((-0.2, 0.2), (-0.13, -0.025), (z - 0.07, z)))
    m.add("tray", *tray, box((-half - 0.03, half + 0.03), (-0.024, -0.001), (z - 0.02, z + 0.03)))
    m.slide("tray", Z, m.number(0.25, 0.45), frame)
    if m.chance(0.5):
        knob(m, "crank", (half + w / 2, w / 2, 0.6 * high), X, 0.03, frame)
    if m.chance(0.6):
        top = high - 0.125
        m.add(
            "tray",
            box((-m.number(0.25, 0.5), m.number(0.25, 0.5)), (-0.06, -0.028), (z + 0.018, min(z + m.number(0.5, 0.9), top))),
        )


def _box_easel(m: Model) -> None:
    """A box with a drawer; its lid rises to hold the picture, with a ledge and a stay that slides."""
    wide, deep, high = m.number(0.34, 0.46), m.number(0.26, 0.38), m.number(0.09, 0.14)
    x, wall, legs = (-wide / 2, wide / 2), 0.01, m.chance(0.35)
    base = m.number(0.6, 0.75) if legs else 0.0
    how = look(m, 0.3, ("slab", "liner", "framed"), ("knob", "bar", "groove", "cup"))
    body = box(x, (0, deep), (base, base + high))
    dz = (base + 0.015, base + 0.06)
    m.add(
        BASE,
        cut(body, box(shrunk(x, 0.02), (-1, deep - 0.02), dz), box(shrunk(x, wall), (wall, deep - wall), (dz[1] + 0.008, 2))),
    )
    drawer(m, "drawer", shrunk(x, 0.02), dz, deep - 0.02, how)
    z = base + high
    m.add("lid", prism(rectangle(x, (0.0, deep), m.pick(0.0, 0.05)), "z", (z + 0.001, z + 0.014)))
    m.hinge("lid", (0, deep, z), (-1, 0, 0), m.number(70, 105))
    mast = m.number(0.5, 0.9) * deep
    m.add(
        "mast",
        box((-0.02, 0.02), (0.02, 0.02 + mast), (z + 0.014, z + 0.026)),
        box((-0.05, 0.05), (0.02, 0.05), (z + 0.026, z + 0.04)),
    )
    m.slide("mast", (0, -1, 0), 0.7 * mast, "lid")
    if m.chance(0.7):
        m.add("lid", box((-0.45 * wide, 0.45 * wide), (deep - 0.06, deep - 0.04), (z + 0.014, z + 0.034)))
    if m.chance(0.6):
        ends = [(0, 0.4), (0.03, 0.4), (0.03, 0.65), (0, 0.65)]
        m.add("handle", tube([(x[0] - a, deep * b, z - 0.03) for a, b in ends], 0.006, 8))
        m.hinge("handle", (x[0], deep / 2, z - 0.03), Y, 80)
    for k, (a, b) in enumerate(((-1, 0.03), (1, 0.03), (0, deep - 0.03)) if legs else ()):
        p = vec(a * (wide / 2 - 0.03), b, base)
        foot = p + vec(a * 0.15, 0.25 if not a else -0.08, -base)
        m.add(f"leg_{k}", beam(p, foot, 0.028, 0.02))
        m.hinge(f"leg_{k}", p, X if not a else (-1, 0, 0), (-m.number(20, 40), 8))
