"""Wind turbines: three blades on a tower, a small one with a vane, one that stands upright."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from jaxtyping import Float
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, loft, prism, ring, rod, rounded, turned, vec
from training.kinds.wheels import beam, lathe, upright

Vector = Float[np.ndarray, " 3"]


def wind_turbine(m: Model) -> None:
    """A rotor on a nacelle that turns into the wind, on a tower or a pole; or a rotor about an upright shaft."""
    form = m.pick("large", "large", "small", "upright")
    n = m.pick(8, 12, 16, 24)
    high = {"large": m.number(40, 90), "small": m.number(5, 12), "upright": m.number(2.5, 7)}[form]
    _tower(m, form, high, n)
    if form == "upright":
        _standing_rotor(m, high, n)
        return
    reach = (m.number(0.4, 0.6) if form == "large" else m.number(0.12, 0.22)) * high
    size = reach * (m.number(0.05, 0.075) if form == "large" else m.number(0.1, 0.16))
    axis = vec(0, 0, high + (1.0 if form == "large" else 1.1) * size)
    shape = m.pick("box", "round", "drop")
    rear = m.number(1.6, 2.6) * size
    if shape == "box":
        outline = rounded((-0.8 * size, 0.8 * size), (high + 0.02 * size, high + 1.9 * size), 0.3 * size, 3)
        m.add("nacelle", prism(outline, "y", (-size, rear)))
    else:
        profile = {
            "round": [(0, 0), (0.8, 0), (0.95, 0.6), (0.8, rear / size + 1), (0, rear / size + 1)],
            "drop": [(0, 0), (0.75, 0), (0.9, 0.8), (0.3, rear / size + 0.8), (0, rear / size + 1)],
        }[shape]
        m.add("nacelle", *upright([lathe(size * np.array(profile), n)], (0, 1, 0), axis - vec(0, size, 0)))
    m.add("nacelle", rod((0, 0, high + 0.005 * size), (0, 0, axis[2] - 0.3 * size), 0.5 * size, n))
    m.spin("nacelle", (0, 0, high), (0, 0, 1))
    if form == "large":
        _roof_things(m, size, axis, rear, shape)
    else:
        _vane(m, size, axis, rear, reach)
    _rotor(m, form, reach, size, axis, n)


def _tower(m: Model, form: str, high: float, n: int) -> None:
    """A tapered tube, a lattice or a pole with stays; in some with a door at the foot."""
    r = {"large": 0.022, "small": 0.008, "upright": 0.015}[form] * high * m.number(0.9, 1.3)
    kind = m.pick("tube", "tube", "lattice") if form != "small" else m.pick("pole", "pole", "lattice")
    if kind == "lattice":
        slim = 0.5 if form == "large" else 1.0
        foot, top = slim * m.number(0.06, 0.08) * high, slim * 1.3 * r
        m.add(
            BASE,
            *(
                beam((a * foot, b * foot, 0), (a * top, b * top, high - 0.02 * high), 0.4 * r, 0.4 * r)
                for a in (-1, 1)
                for b in (-1, 1)
            ),
        )
        levels = np.linspace(0, 0.97, m.pick(5, 7))
        for k, q in enumerate(levels[1:], 1):
            s, t = foot + (top - foot) * q, foot + (top - foot) * levels[k - 1]
            z, low = q * high, levels[k - 1] * high
            for turn in range(4):
                bars = [
                    beam((-s, -s, z), (s, -s, z), 0.3 * r, 0.3 * r, (0, 1, 0)),
                    beam((-t, -t, low), (s, -s, z), 0.3 * r, 0.3 * r, (0, 1, 0)),
                ]
                m.add(BASE, *(turned(b, (0, 0, 1), 90 * turn, (0, 0, 0)) for b in bars))
        m.add(BASE, rod((0, 0, 0.96 * high), (0, 0, high), 1.5 * top, n))
        return
    m.add(BASE, lathe([(0, 0), (r, 0), (m.number(0.5, 0.75) * r, high), (0, high)], n))
    m.add(BASE, rod((0, 0, -0.02 * high), (0, 0, 0.005 * high), m.number(1.5, 3.0) * r, max(n, 8)))
    if kind == "pole" and m.chance(0.6):
        far, z, stays = 0.4 * high, m.number(0.55, 0.7) * high, m.pick(3, 4)
        m.add(
            BASE,
            *around(rod((0.6 * r, 0, z), (far, 0, 0), 0.0015 * high, 6), stays, 30),
            *around(
                box((far - 0.02 * high, far + 0.02 * high), (-0.02 * high, 0.02 * high), (-0.01 * high, 0.01 * high)), stays, 30
            ),
        )
    elif form == "large" and m.chance(0.6):
        w, h = 0.35 * r, 1.4 * r
        y, z = -1.0 * r, 0.35 * r
        m.add(BASE, box((-w - 0.06 * r, w + 0.06 * r), (y - 0.04 * r, -0.5 * r), (0.0, z + h + 0.06 * r)))
        m.add("door", prism(rounded((-w, w), (z, z + h), m.pick(0.05, 0.9) * w), "y", (y - 0.1 * r, y - 0.045 * r)))
        m.hinge("door", (w, y - 0.1 * r, z + h / 2), (0, 0, 1), m.pick(90, 110))
        for k in range(3):
            m.add(BASE, box((-1.4 * w, 1.4 * w), (y - 0.3 * r * (3 - k), y), (0.0, (k + 1) * z / 3 - 0.02 * r)))


def _blade(m: Model, reach: float, size: float, flat: bool) -> Trimesh:
    """A blade along z from the hub: a twisted wing or a flat panel."""
    chord = m.number(0.08, 0.12) * reach
    if flat:
        outline = Polygon(
            [
                (-0.3 * chord, 0.3 * size),
                (0.3 * chord, 0.3 * size),
                (0.75 * chord, 0.22 * reach),
                (0.15 * chord, reach),
                (-0.15 * chord, reach),
                (-0.35 * chord, 0.25 * reach),
            ]
        )
        return turned(prism(outline, "y", (-0.06 * chord, 0.06 * chord)), (0, 0, 1), m.number(8, 20), (0, 0, 0))
    turn = np.linspace(0, 2 * np.pi, 10, endpoint=False)
    sections = []
    for q, wide, thick, twist in (
        (0.02, 0.35, 0.35, 40),
        (0.1, 0.4, 0.38, 35),
        (0.22, 1.0, 0.24, 18),
        (0.6, 0.6, 0.1, 6),
        (0.97, 0.22, 0.03, 0),
        (1.0, 0.08, 0.02, 0),
    ):
        a, b = wide * chord * (np.cos(turn) * 0.5 + 0.12), thick * chord * np.sin(turn) * 0.5
        c, s = np.cos(np.deg2rad(twist)), np.sin(np.deg2rad(twist))
        sections.append(np.c_[c * a - s * b, s * a + c * b, np.full(10, 0.1 * size + q * reach)])
    return loft(np.array(sections))


def _rotor(m: Model, form: str, reach: float, size: float, axis: Vector, n: int) -> None:
    """Hub with a nose and two to six blades before the nacelle."""
    hub = axis - vec(0, 2.2 * size, 0)
    count = m.pick(3, 3, 3, 2) if form == "large" else m.pick(3, 3, 5, 6)
    nose = m.pick(1.0, 1.4)
    profile = [
        (0, 0),
        (0.66 * size, 0),
        (0.7 * size, 0.8 * size),
        (0.4 * size, (0.5 + 0.6 * nose) * size),
        (0, (0.7 + 0.7 * nose) * size),
    ]
    m.add("rotor", *upright([lathe(profile, n)], (0, -1, 0), hub + vec(0, 0.7 * size, 0)))
    blade, begin = _blade(m, reach, size, m.chance(0.35)), m.number(0, 120)
    for k in range(count):
        m.add("rotor", turned(blade.copy(), (0, 1, 0), begin + 360 * k / count, (0, 0, 0)).apply_translation(hub))
    if m.chance(0.3):
        m.add(
            "rotor",
            *(
                turned(
                    rod((0, 0, 0.2 * size), (0, 0, 0.95 * size), 0.3 * size, n), (0, 1, 0), begin + 360 * k / count, (0, 0, 0)
                ).apply_translation(hub)
                for k in range(count)
            ),
        )
    m.add("rotor", rod(hub + vec(0, 0.6 * size, 0), axis - vec(0, 0.5 * size, 0), 0.45 * size, n))
    m.spin("rotor", hub, (0, -1, 0), "nacelle")


def _roof_things(m: Model, size: float, axis: Vector, rear: float, shape: str) -> None:
    """A mast with a wind sensor, a cooler, a rail."""
    top = axis[2] + (0.88 if shape == "box" else 0.3) * size
    if m.chance(0.6):
        a = vec(0, 0.6 * rear, top)
        m.add(
            "nacelle",
            rod(a, a + vec(0, 0, 1.3 * size), 0.04 * size, 6),
            rod(a + vec(-0.3 * size, 0, 1.25 * size), a + vec(0.3 * size, 0, 1.25 * size), 0.03 * size, 6),
        )
    if m.chance(0.4):
        m.add("nacelle", box((-0.7 * size, 0.7 * size), (0.75 * rear, 0.85 * rear), (top - 0.02 * size, top + 1.0 * size)))


def _vane(m: Model, size: float, axis: Vector, rear: float, reach: float) -> None:
    """A tail that turns the nacelle into the wind."""
    end = axis + vec(0, rear + m.number(0.3, 0.7) * reach, 0)
    m.add("nacelle", rod(axis + vec(0, 0.5 * rear, 0), end, 0.12 * size, 8))
    q = m.number(0.15, 0.3) * reach
    y, z = end[1], end[2]
    outline = m.pick(
        [(y - 0.3 * q, z - 0.2 * q), (y + q, z - q), (y + q, z + q), (y - 0.3 * q, z + 0.2 * q)],
        [(y - 0.2 * q, z - 0.3 * q), (y + 0.8 * q, z - 0.3 * q), (y + q, z + 1.3 * q), (y + 0.4 * q, z + 1.2 * q)],
    )
    m.add("nacelle", prism(outline, "x", (-0.04 * size, 0.04 * size)))


def _standing_rotor(m: Model, high: float, n: int) -> None:
    """Bowed blades, straight ones on arms, a helix, or half drums about the upright shaft."""
    form, count = m.pick("bowed", "straight", "helix", "drums"), m.pick(2, 3, 3)
    r, tall = m.number(0.18, 0.3) * high, m.number(0.5, 0.9) * high
    low, thin = high + 0.02 * high, 0.01 * high
    m.add(
        "rotor",
        rod((0, 0, high + 0.002 * high), (0, 0, low + tall), 1.3 * thin, n),
        rod((0, 0, high + 0.001 * high), (0, 0, low), 2.2 * thin, n),
    )
    t = np.linspace(0, 1, 15)
    for k in range(count):
        turn = 2 * np.pi * k / count
        c, s = np.cos(turn), np.sin(turn)
        if form == "drums":
            q = np.linspace(0, np.pi, 9)
            half = np.c_[0.5 * r * (1 - np.cos(q)), 0.5 * r * np.sin(q)] @ np.array([[c, s], [-s, c]])
            inner = np.c_[0.5 * r - 0.46 * r * np.cos(q), 0.46 * r * np.sin(q)] @ np.array([[c, s], [-s, c]])
            m.add("rotor", prism(Polygon([*half, *inner[::-1]]), "z", (low, low + tall)))
            continue
        bend = 2.0 if form == "helix" else 0.0
        out = r * (np.sin(np.pi * t) + 0.02) if form == "bowed" else np.full(15, r)
        path = np.c_[out * np.cos(turn + bend * t), out * np.sin(turn + bend * t), low + 0.03 * high + t * (tall - 0.06 * high)]
        for a, b in pairwise(path) if form != "straight" else [(path[0], path[-1])]:
            way = np.arctan2(a[1] + b[1], a[0] + b[0])
            m.add("rotor", beam(a, b + 0.02 * (b - a), 5 * thin, 1.2 * thin, (-np.sin(way), np.cos(way), 0)))
        if form != "bowed":
            for q in (2, 12):
                m.add("rotor", rod((0, 0, path[q][2]), path[q], 0.7 * thin, 6))
    if form == "drums":
        m.add("rotor", *(rod((0, 0, z), (0, 0, z + thin), 1.02 * r, 2 * n) for z in (low - thin / 2, low + tall - thin / 2)))
    elif m.chance(0.3):
        m.add("rotor", ball((0, 0, low + tall), (3 * thin,) * 3, 10), ring((0, 0, low), (0, 0, 1), 2.2 * thin, 0.6 * thin, 12))
    m.spin("rotor", (0, 0, high), (0, 0, 1))
