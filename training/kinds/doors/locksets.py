"""Lever handle sets of doors, socket and switch plates on a wall."""

from __future__ import annotations

import numpy as np
import trimesh
from shapely.geometry import Point

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rod, rounded, tube, vec
from training.kinds.wheels import beam


def door_lever_set(m: Model) -> None:
    """A door leaf section, a plate or a mortise case with levers, a turn for the lock and bolts."""
    s, style, thick = m.pick(-1, 1), m.pick("leaf", "leaf", "plate", "case"), m.number(0.035, 0.05)
    front, drop = -thick / 2, m.number(0.07, 0.1)
    faces = (front,) if style == "plate" else ((front, -front) if m.chance(0.7) else (front,))
    if style == "leaf":
        wide, high = m.number(0.12, 0.35), m.number(0.25, 0.5)
        m.add(BASE, box((-s * 0.06, s * wide), (front, -front), (-0.6 * high, 0.4 * high)))
    elif style == "case":
        m.add(BASE, box((-s * 0.058, s * 0.035), (-0.008, 0.008), (-0.13, 0.06)))
        m.add(BASE, box((-s * 0.06, -s * 0.057), (-0.012, 0.012), (-0.16, 0.09)))
        m.add(BASE, *(rod((0, 0, z), (0, f, z), 0.011, m.sections()) for z in (0.0, -drop) for f in faces))
    plates = "long" if style == "plate" else m.pick("long", "round", "square")
    shape, locked = m.pick("bar", "tube", "flat", "curve"), m.chance(0.75)
    _plates(m, plates, faces, drop, locked)
    one, n = style == "case" and m.chance(0.5), m.pick(8, 12, 16)
    for k, y in enumerate(faces):
        part = "lever" if one or len(faces) == 1 else f"lever_{k}"
        m.add(part, *_lever(m, shape, s, y, n))
        m.hinge(part, (0, y, 0), (0, s, 0), m.pick(35, 45, 60))
    if one:
        m.add("lever", box((-0.004, 0.004), (min(faces), max(0.008, max(faces))), (-0.004, 0.004)))
    if locked:
        _locks(m, faces, drop, s)
    if style != "plate" and m.chance(0.85):
        _bolts(m, s, drop if locked else 0.0, style == "case")


def _plates(m: Model, style: str, faces: tuple[float, ...], drop: float, locked: bool) -> None:
    half, thin, n = m.number(0.019, 0.027), m.number(0.003, 0.009), m.pick(12, 20, 32)
    for y in faces:
        out = y + (thin if y > 0 else -thin)
        if style == "long":
            m.add(BASE, prism(rounded((-half, half), (-drop - 0.08, 0.07), m.pick(0.003, 0.9 * half)), "y", (y, out)))
            m.add(BASE, *(rod((0, y, z), (0, 1.15 * out - 0.15 * y, z), 0.004, 8) for z in (0.055, -drop - 0.065)))
            continue
        for z in (0.0, -drop)[: 1 + locked]:
            outline = rounded((-half, half), (z - half, z + half), 0.003)
            m.add(BASE, rod((0, y, z), (0, out, z), half, n) if style == "round" else prism(outline, "y", (y, out)))


def _lever(m: Model, shape: str, s: int, y: float, n: int) -> list[trimesh.Trimesh]:
    w, far, long = (1 if y > 0 else -1), m.number(0.04, 0.055), m.number(0.09, 0.13)
    a = vec(0, y + w * far, 0)
    neck = rod((0, y, 0), a, 0.009, n)
    if shape == "bar":
        found = [neck, box((-s * 0.011, s * long), (a[1] - 0.006, a[1] + 0.006), (-0.011, 0.011))]
    elif shape == "flat":
        found = [neck, beam(a - vec(s * 0.015, 0, 0), a + vec(s * long, 0, 0), 0.03, 0.006, (0, 0, 1), 0.6)]
    elif shape == "tube":
        end = a + vec(s * long, 0, 0)
        path = [(0, y, 0), a - vec(0, w * 0.012, 0), a + vec(s * 0.012, 0, 0), end, end - vec(-s * 0.012, w * 0.03, 0)]
        return [tube(path, 0.009, n)]
    else:
        t = np.linspace(0, 1, 8)
        points = [a + vec(s * long * u, 0, 0.012 * np.sin(2 * np.pi * u)) for u in t]
        found = [neck, ball(a, (0.012, 0.012, 0.012), n), tube(points, 0.008, n), ball(points[-1], (0.01, 0.01, 0.01), n)]
    return found


def _locks(m: Model, faces: tuple[float, ...], drop: float, s: int) -> None:
    """On every face a thumb turn, a key or a bare cylinder."""
    n = m.pick(10, 16)
    for k, y in enumerate(faces):
        w = 1 if y > 0 else -1
        if len(faces) > k + 1 and m.chance(0.3):
            m.add(BASE, rod((0, y, -drop), (0, y + w * 0.013, -drop), 0.009, n))
            continue
        part, at = ("thumb_turn" if k else m.pick("thumb_turn", "key")), (0, y, -drop)
        if part == "thumb_turn":
            m.add(part, rod(at, (0, y + w * 0.014, -drop), 0.011, n))
            m.add(part, box((-0.004, 0.004), (y + w * 0.012, y + w * 0.03), (-drop - 0.016, -drop + 0.016)))
        else:
            m.add(part, box((-0.0015, 0.0015), (y - w * 0.001, y + w * 0.03), (-drop - 0.004, -drop + 0.004)))
            m.add(BASE, rod((0, y, -drop), (0, y + w * 0.011, -drop), 0.009, n))
            bow = Point(y + w * 0.038, -drop).buffer(0.013, quad_segs=4)
            m.add(part, prism(bow.difference(Point(y + w * 0.044, -drop).buffer(0.003)), "x", (-0.0013, 0.0013)))
        m.hinge(part, at, (0, -s * w, 0), m.pick(90, 180))


def _bolts(m: Model, s: int, drop: float, case: bool) -> None:
    """A sprung latch with a slope and perhaps a dead bolt, which slide into the edge."""
    edge, out, half = -s * 0.06, m.number(0.009, 0.013), 0.006
    slope = m.pick(-1, 1)
    tip = [(edge + s * 0.02, -half), (edge + s * 0.02, half), (edge, half), (edge - s * out, slope * half), (edge, -half)]
    m.add("latch", prism(tip, "z", (-0.012, 0.012)))
    m.slide("latch", (s, 0, 0), 0.9 * out)
    if not case and m.chance(0.6):
        m.add(BASE, box((edge - s * 0.001, edge + s * 0.003), (-0.011, 0.011), (-drop - 0.05, 0.05)))
    if drop and m.chance(0.7):
        throw = m.number(0.012, 0.02)
        shown = m.chance(0.5)
        m.add(
            "bolt",
            box((edge + s * 0.03, edge - s * (throw if shown else 0.002)), (-half, half), (-drop - 0.016, -drop + 0.016)),
        )
        m.slide("bolt", (s if shown else -s, 0, 0), throw)


def wall_socket(m: Model) -> None:
    """A plate or a box on the wall with a row of sockets, rockers, dimmers and flaps."""
    style = m.pick("switches", "flaps", "mixed", "british")
    if style == "british":
        _british(m)
        return
    count, face, frame = m.pick(1, 2, 2, 3, 4), m.number(0.045, 0.06), m.number(0.006, 0.016)
    deep = m.pick(0.009, 0.012, m.number(0.03, 0.055))
    step = face if m.chance(0.3) else face + 2 * frame
    half, along = (count - 1) / 2 * step, m.chance(0.7)
    big, small = half + face / 2 + frame, face / 2 + frame
    x, z = ((-big, big), (-small, small)) if along else ((-small, small), (-big, big))
    m.add(BASE, prism(rounded(x, z, m.pick(0.001, 0.005, 0.3 * frame)), "y", (-deep, 0)))
    if m.chance(0.3):
        m.add(BASE, box((x[0] - 0.1, x[1] + 0.1), (0, 0.01), (z[0] - 0.1, z[1] + 0.1)))
    one = m.pick("rocker", "rocker", "rocker", "dimmer")
    for k in range(count):
        at = -half + k * step
        make = {"switches": one, "flaps": "flap"}.get(style) or ("flap", "rocker", "dimmer", "socket")[int(m.rng.integers(4))]
        if style == "mixed" and k == 0:
            make = m.pick("flap", "rocker", "dimmer")
        _module(m, make, k, at if along else 0, 0 if along else at, face / 2, -deep)


def _module(m: Model, make: str, k: int, x: float, z: float, half: float, y: float) -> None:
    if make == "rocker":
        w, pair, h = 0.92 * half, m.chance(0.3), 0.92 * half
        for j, (a, b) in enumerate(((-w, -0.0008), (0.0008, w)) if pair else ((-w, w),)):
            outline = [(y + 0.003, z - h), (y + 0.003, z + h), (y - 0.003, z + h), (y - 0.0055, z), (y - 0.008, z - h)]
            part = f"rocker_{2 * k + j}"
            m.add(part, prism(outline, "x", (x + a, x + b)))
            m.hinge(part, (x + (a + b) / 2, y, z), (-1, 0, 0), m.pick(7, 10))
    elif make == "dimmer":
        r, out, n = m.number(0.45, 0.75) * half, m.number(0.009, 0.016), m.pick(12, 16, 24)
        m.add(f"knob_{k}", rod((x, y, z), (x, y - out, z), r, n))
        m.add(f"knob_{k}", box((x - 0.001, x + 0.001), (y - out - 0.001, y - out + 0.001), (z + 0.3 * r, z + 0.95 * r)))
        m.hinge(f"knob_{k}", (x, y, z), (0, 1, 0), m.pick(270, 300))
    else:
        _socket(m, x, z, 0.85 * half, y)
    if make == "flap":
        thin, w = m.number(0.003, 0.008), m.number(0.93, 1.0) * half
        m.add(f"flap_{k}", prism(rounded((x - w, x + w), (z - w, z + w), 0.003), "y", (y - 0.002 - thin, y - 0.002)))
        if m.chance(0.6):
            m.add(f"flap_{k}", box((x - 0.3 * w, x + 0.3 * w), (y - 0.004 - thin, y - 0.002), (z - 1.05 * w, z - 0.85 * w)))
        m.add(f"flap_{k}", rod((x - 0.7 * w, y - 0.002, z + w), (x + 0.7 * w, y - 0.002, z + w), 0.0025, 8))
        m.hinge(f"flap_{k}", (x, y - 0.002, z + w), (-1, 0, 0), m.pick(90, 110, 150))


def _socket(m: Model, x: float, z: float, r: float, y: float) -> None:
    """A raised ring or an inset with contact holes drawn as dark dimples."""
    disc = rod((x, y + 0.003, z), (x, y - 0.0015, z), r, m.pick(16, 24))
    holes = [rod((x + s * 0.0095, y - 0.01, z), (x + s * 0.0095, y + 0.001, z), 0.0026, 8) for s in (-1, 1)]
    m.add(BASE, cut(disc, *holes) if m.chance(0.7) else disc)


def _british(m: Model) -> None:
    """A plate of one or two sockets, each with slots and a small rocker."""
    count, high, deep = m.pick(1, 2, 2), 0.043, m.pick(0.008, 0.01, 0.035)
    wide = 0.043 * count if count == 1 else 0.073
    m.add(BASE, prism(rounded((-wide, wide), (-high, high), 0.004), "y", (-deep, 0)))
    m.add(BASE, *(rod((s * 0.03 * count, -deep, 0), (s * 0.03 * count, -deep - 0.001, 0), 0.003, 8) for s in (-1, 1)))
    for k in range(count):
        x = 0.0 if count == 1 else (k - 0.5) * 0.07
        block = box((x - 0.024, x + 0.024), (-deep - 0.002, -deep + 0.002), (-0.035, 0.012))
        slots = [box((x + a - 0.0035, x + a + 0.0035), (-0.1, -deep + 0.001), (-0.024, -0.019)) for a in (-0.011, 0.011)]
        slots.append(box((x - 0.002, x + 0.002), (-0.1, -deep + 0.001), (-0.006, 0.003)))
        m.add(BASE, cut(block, *slots))
        at = x + (0.0 if count == 1 else (k - 0.5) * 0.016)
        outline = [(-deep + 0.003, 0.018), (-deep + 0.003, 0.034), (-deep - 0.002, 0.034), (-deep - 0.006, 0.018)]
        m.add(f"rocker_{k}", prism(outline, "x", (at - 0.006, at + 0.006)))
        m.hinge(f"rocker_{k}", (at, -deep, 0.026), (-1, 0, 0), 14)
