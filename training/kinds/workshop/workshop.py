"""Mitre saws, and the blade of circular saws."""

from __future__ import annotations

import numpy as np
import trimesh
from shapely.geometry import LineString, Point, Polygon
from shapely.geometry import box as window
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import box, moved, prism, rectangle, rod, tube, turned, vec
from training.kinds.wheels import beam, upright


def saw_blade(radius: float, thick: float, teeth: int) -> Trimesh:
    """A toothed disc round the z axis."""
    t = np.linspace(0, 2 * np.pi, 2 * teeth, endpoint=False)
    r = np.where(np.arange(2 * teeth) % 2, radius, 0.94 * radius)
    return prism(Polygon(np.c_[r * np.cos(t), r * np.sin(t)]), "z", (-thick / 2, thick / 2))


def mitre_saw(m: Model) -> None:
    """A head on a pivot over a turntable with a fence: chop saw, compound saw whose head also leans, or one on rails."""
    style, r, n = m.pick("chop", "compound", "sliding"), m.number(0.105, 0.15), m.pick(16, 24, 32)
    top, half, disc = m.number(0.06, 0.09), m.number(0.24, 0.36), m.number(0.13, 0.17)
    _saw_foot(m, half, disc, top)
    m.add("turntable", rod((0, 0, 0.025), (0, 0, top), disc, n), box((-0.035, 0.035), (-disc - 0.1, 0), (0.03, top)))
    m.add("turntable", box((-0.01, 0.01), (-disc - 0.09, 0.9 * disc), (top, top + 0.002)))
    grip = vec(0, -disc - 0.1, 0.5 * (top + 0.03))
    m.add(
        "turntable", rod(grip, grip - vec(0, 0.06, 0), 0.012, 12), rod(grip - vec(0, 0.03, 0), grip - vec(0, 0.07, 0), 0.021, 6)
    )
    m.add("turntable", box((-0.05, 0.05), (0.8 * disc, disc + 0.09), (0.025, top)))
    m.hinge("turntable", (0, 0, top), (0, 0, 1), (-m.pick(45, 50), m.pick(45, 50)))
    pivot, mount = vec(0, disc + m.number(0.05, 0.08), top + m.number(0.13, 0.2)), "turntable"
    if style != "chop":
        mount = "arm"
        m.add("turntable", rod((0, disc + 0.05, top), (0, disc + 0.09, top), 0.045, n))
        m.hinge("arm", (0, disc, top), (0, -1, 0), (0, 45) if m.chance(0.6) else (-45, 45), "turntable")
    y = pivot[1] + (m.number(0.02, 0.06) if style == "sliding" else 0)
    m.add(mount, beam((0, y + 0.005, top - 0.01), (0, y, pivot[2] - 0.02), 0.07, 0.035))
    if style == "sliding":
        z = pivot[2] - 0.03
        m.add(mount, box((-0.06, 0.06), (y - 0.06, y + 0.14), (z - 0.025, z + 0.025)))
        m.add("carriage", *(rod((s * 0.04, y - 0.06, z), (s * 0.04, y + 0.36, z), 0.013, 12) for s in (-1, 1)))
        m.add("carriage", box((-0.06, 0.06), (y + 0.35, y + 0.37), (z - 0.02, z + 0.02)))
        m.add("carriage", box((-0.05, 0.05), (y - 0.12, y - 0.065), (z - 0.02, z + 0.05)))
        m.slide("carriage", (0, -1, 0), m.number(0.17, 0.21), mount)
        mount, pivot = "carriage", vec(0, y - 0.095, z + 0.05)
    for s in (-1, 1):
        m.add(mount, rod((s * 0.032, pivot[1], pivot[2]), (s * 0.05, pivot[1], pivot[2]), 0.028, n))
        m.add(mount, box((s * 0.034, s * 0.046), (pivot[1] - 0.02, pivot[1] + 0.02), (pivot[2] - 0.06, pivot[2])))
    _saw_head(m, mount, pivot, vec(0, 0.01, top + r - 0.006), r, n)


def _saw_foot(m: Model, half: float, disc: float, top: float) -> None:
    wing = rectangle((-half, half), (-0.09, 0.09)).union(Point(0, 0).buffer(disc + 0.02, quad_segs=6))
    m.add(BASE, prism(wing.difference(Point(0, 0).buffer(disc + 0.004, quad_segs=8)), "z", (0.015, top)))
    m.add(BASE, prism(wing, "z", (0.012, 0.022)))
    tall, gap = top + m.number(0.06, 0.1), m.number(0.04, 0.06)
    for s in (-1, 1):
        outline = [
            (s * gap, top),
            (s * half, top),
            (s * half, 0.75 * tall + 0.25 * top),
            (s * 0.6 * half, tall),
            (s * (gap + 0.02), tall),
        ]
        m.add(BASE, prism(outline, "y", (0.03, 0.042)), box((s * half * 0.5, s * half * 0.6), (0.03, 0.08), (top, top + 0.03)))
        m.add(BASE, *(rod((s * half * 0.85, y, 0), (s * half * 0.85, y, 0.02), 0.018, 10) for y in (-0.07, 0.07)))
        if m.chance(0.5):
            m.add(BASE, rod((s * half * 0.7, -0.06, top), (s * half * 0.7, -0.06, top + 0.09), 0.007, 8))
    if m.chance(0.5):
        t = np.linspace(-0.75, 0.75, 10)
        scale = (disc + 0.035) * np.c_[np.sin(t), -np.cos(t)]
        m.add(BASE, prism(LineString(scale).buffer(0.014), "z", (0.014, 0.026)))


def _saw_head(m: Model, mount: str, pivot: np.ndarray, low: np.ndarray, r: float, n: int) -> None:
    """Build the head where it cuts, then lift it."""
    lift, center, x = m.number(28, 42), low, (1, 0, 0)
    head = [
        beam(pivot, center + vec(0, 0.3 * r, 0.45 * r), 0.045, 0.06),
        rod(pivot - (0.032, 0, 0), pivot + vec(0.032, 0, 0), 0.024, n),
    ]
    cover = Point(0, 0).buffer(1.1 * r, quad_segs=8).intersection(window(-2 * r, -0.12 * r, 2 * r, 2 * r))
    head.append(moved(prism(cover, "x", (-0.03, 0.03)), center))
    head.append(rod(center, center + vec(0.05, 0, 0), 0.3 * r, n))
    head.append(
        rod(center + vec(0.05, 0, 0.1), center + vec(0.05 + m.number(0.1, 0.16), 0, 0.1), 0.045, n)
        if m.chance(0.5)
        else rod(center + vec(0.03, 0.02, 0.03), center + vec(0.2, 0.02, 0.03), 0.05, n)
    )
    front = center + vec(0, -0.75 * r, 0.7 * r)
    if m.chance(0.5):
        head.append(
            tube([front, front + vec(0, -0.07, 0.09), front + vec(0, 0.02, 0.13), front + vec(0, 0.06, 0.07)], 0.014, 8)
        )
    else:
        head += [
            rod(front, front + vec(0, -0.08, 0.03), 0.012, 8),
            rod(front + vec(-0.06, -0.08, 0.03), front + vec(0.06, -0.08, 0.03), 0.016, 10),
        ]
    if m.chance(0.4):
        head.append(
            tube([center + vec(0, 0.9 * r, 0.4 * r), center + vec(0, 1.4 * r, 0.3 * r), center + vec(0, 1.5 * r, 0)], 0.02, 8)
        )
    m.add("head", *(turned(s, x, -lift, pivot) for s in head))
    m.hinge("head", pivot, x, lift, mount)
    turn = trimesh.transformations.rotation_matrix(np.deg2rad(-lift), x, pivot)
    lifted = trimesh.transform_points([center], turn)[0]
    m.add(
        "blade", *upright([saw_blade(r, 0.003, m.pick(16, 24, 30)), rod((0, 0, -0.012), (0, 0, 0.012), 0.2 * r, n)], x, lifted)
    )
    m.spin("blade", lifted, x, "head")
    if m.chance(0.75):
        _saw_guard(m, lifted, r, lift)


def _saw_guard(m: Model, lifted: np.ndarray, r: float, lift: float) -> None:
    x = (1, 0, 0)
    lower = Point(0, 0).buffer(1.06 * r, quad_segs=8).intersection(window(-2 * r, -2 * r, 2 * r, -0.14 * r))
    if m.chance(0.5):
        lower = lower.difference(Point(0, 0).buffer(0.6 * r, quad_segs=6))
        m.add(
            "guard",
            *(
                turned(beam(lifted + vec(a, 0, 0), lifted + vec(a, 0.9 * r * c, -0.6 * r), 0.003, 0.03), x, -lift, lifted)
                for a in (-0.02, 0.02)
                for c in (-1, 1)
            ),
        )
    plates = [moved(prism(lower, "x", (a - 0.0015, a + 0.0015)), lifted) for a in (-0.02, 0.02)]
    m.add(
        "guard",
        *(turned(p, x, -lift, lifted) for p in plates),
        rod(lifted - (0.024, 0, 0), lifted + vec(0.024, 0, 0), 0.02, 10),
    )
    m.hinge("guard", lifted, (-1, 0, 0), m.number(80, 110), "head")
