"""Fishing reels: spinning, bait casting and fly reels, with or without a rod."""

from __future__ import annotations

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, ring, rod, tube, vec
from training.kinds.wheels import beam, lathe, upright

X, FRONT = vec(1, 0, 0), vec(0, -1, 0)


def fishing_reel(m: Model) -> None:
    """A spinning, a bait casting or a fly reel by itself or under a rod."""
    style, scale, n = m.pick("spinning", "spinning", "casting", "fly"), m.number(0.8, 1.3), m.pick(12, 16, 24)
    {"spinning": _spinning, "casting": _casting, "fly": _fly}[style](m, scale, n)
    if m.chance(0.35):
        _rod(m, style == "casting", scale)


def _rod(m: Model, under: bool, scale: float) -> None:
    """A rod along Y at the foot of the reel with rings and a grip."""
    z, long = (-0.04 if under else 0.06) * scale, m.number(0.35, 0.8)
    turn = 1 if under else -1
    m.add(BASE, *upright([lathe([(0, 0), (0.0065, 0), (0.003, long), (0, long)], 8)], FRONT, (0, -0.05, z)))
    m.add(BASE, rod((0, -0.14, z), (0, 0.3, z), 0.011, 12), rod((0, 0.1, z), (0, 0.3, z), 0.014, 12))
    for k in range(m.pick(3, 4, 5)):
        y, size = -0.25 - k * (long - 0.25) / 5, 0.016 / (1 + 0.5 * k)
        m.add(BASE, ring((0, y, z + turn * (size + 0.003)), FRONT, size, 0.0014, 12))


def _handle(m: Model, at: Point, s: int, long: float, double: bool) -> None:
    """A crank at the flank whose knob turns on its end."""
    m.add("crank", rod(at - s * 0.02 * X, at + s * 0.006 * X, 0.005, 10))
    for k, w in enumerate((1, -1) if double else (1,)):
        end = at + vec(s * 0.008, 0, -w * long)
        m.add("crank", beam(at, end, 0.009, 0.004, (0, 1, 0)))
        knob = f"knob_{k}"
        m.add(knob, rod(end - s * 0.002 * X, end + s * 0.008 * X, 0.003, 8))
        m.add(
            knob,
            ball(end + s * 0.016 * X, (0.012, 0.008, 0.008), 10)
            if k or m.chance(0.5)
            else rod(end, end + s * 0.024 * X, 0.008, 10),
        )
        m.spin(knob, end, (s, 0, 0), "crank")
    m.spin("crank", at, (s, 0, 0))


def _spinning(m: Model, c: float, n: int) -> None:
    """Foot and gear case; a rotor with a bail arm round the spool; a crank at the side; a drag knob in front."""
    s, r = m.pick(-1, 1), 0.024 * c
    m.add(
        BASE,
        beam((0, 0, 0), (0, 0.005, 0.055 * c), 0.012, 0.016, taper=0.8),
        box((-0.008, 0.008), (-0.035, 0.04), (0.05 * c, 0.056 * c)),
    )
    m.add(BASE, ball((0, 0.006, -0.004), (0.016 * c, 0.03 * c, 0.022 * c), n), rod((0, 0, 0), (0, -0.03 * c, 0), 0.015 * c, n))
    front = -0.03 * c
    cup = lathe([(0, 0), (0.8 * r, 0), (r, 0.012 * c), (r, 0.018 * c), (0, 0.018 * c)], n)
    m.add("rotor", *upright([cup], FRONT, (0, front, 0)))
    arms = [box((e * r * 0.95, e * r * 1.35), (front - 0.045 * c, front - 0.008 * c), (-0.006 * c, 0.006 * c)) for e in (-1, 1)]
    m.add("rotor", *arms, box((-1.35 * r, 1.35 * r), (front - 0.014 * c, front - 0.007 * c), (-0.006 * c, 0.006 * c)))
    m.spin("rotor", (0, front, 0), FRONT)
    y = front - 0.019 * c
    spool = [
        (0, 0),
        (r, 0),
        (r, 0.004 * c),
        (0.75 * r, 0.006 * c),
        (0.75 * r, 0.024 * c),
        (r, 0.027 * c),
        (0.9 * r, 0.03 * c),
        (0, 0.03 * c),
    ]
    m.add("spool", *upright([lathe(spool, n)], FRONT, (0, y, 0)))
    m.spin("spool", (0, y, 0), FRONT)
    if m.chance(0.7):
        m.add(
            "drag_knob",
            *upright(
                [lathe([(0, 0), (0.5 * r, 0), (0.4 * r, 0.009 * c), (0, 0.009 * c)], m.pick(6, 12))],
                FRONT,
                (0, y - 0.03 * c, 0),
            ),
        )
        m.spin("drag_knob", (0, y - 0.03 * c, 0), FRONT)
    pivot, t = y - 0.018 * c, np.linspace(0, np.pi, 9)
    wire = [vec(1.42 * r * np.cos(a), pivot - 0.012 * c * np.sin(a), 1.5 * r * np.sin(a)) for a in t]
    m.add(
        "bail", tube(wire, 0.0014, 6), *(rod((e * 1.33 * r, pivot, 0), (e * 1.5 * r, pivot, 0), 0.005 * c, 10) for e in (-1, 1))
    )
    m.hinge("bail", (0, pivot, 0), (1, 0, 0), m.pick(80, 110), "rotor")
    _handle(m, vec(s * 0.026 * c, 0.008, 0), s, m.number(0.035, 0.055) * c, m.chance(0.2))


def _casting(m: Model, c: float, n: int) -> None:
    """Two flanks with the spool between them, a crank with a star drag, a thumb bar."""
    r, half, s = 0.022 * c, m.number(0.015, 0.024) * c, m.pick(-1, 1)
    flat = m.number(1.0, 1.5)
    for e in (-1, 1):
        side = rod((e * half, 0, 0), (e * (half + 0.012 * c), 0, 0), r, n)
        side.vertices = side.vertices * (1, flat, 1)
        m.add(BASE, side)
    m.add(
        BASE,
        *(rod((-half, y, z), (half, y, z), 0.0035, 8) for y, z in ((-0.8 * r, -0.4 * r), (0.8 * r, -0.4 * r), (-0.95 * r, 0))),
    )
    m.add(
        BASE,
        box((-0.006, 0.006), (-0.9 * r, 0.9 * r), (-0.5 * r, -0.35 * r)),
        box((-0.006, 0.006), (-0.6 * r, 0.6 * r), (-0.033 * c, -0.4 * r)),
    )
    m.add(BASE, box((-0.007, 0.007), (-0.035, 0.035), (-0.034 * c, -0.029 * c)))
    q = 0.75 * r
    spool = [
        (0, -half),
        (q, -half),
        (q, 2.5e-3 - half),
        (0.4 * q, 4e-3 - half),
        (0.4 * q, half - 4e-3),
        (q, half - 2.5e-3),
        (q, half),
        (0, half),
    ]
    m.add("spool", *upright([lathe(spool, n)], X, (0, 0, 0)))
    m.spin("spool", (0, 0, 0), X)
    end = s * (half + 0.012 * c)
    if m.chance(0.7):
        m.add(
            "star_drag",
            *(
                beam((end + s * 0.005, 0, 0), (end + s * 0.005, 0.016 * c * np.cos(a), 0.016 * c * np.sin(a)), 0.006, 0.003)
                for a in np.arange(5) * 1.2566
            ),
        )
        m.add("star_drag", rod((end, 0, 0), (end + s * 0.008, 0, 0), 0.006, 10))
        m.spin("star_drag", (end, 0, 0), (s, 0, 0))
    _handle(m, vec(end + s * 0.014, 0, 0), s, m.number(0.025, 0.04) * c, m.chance(0.8))
    if m.chance(0.6):
        m.add("thumb_bar", box((-half, half), (0.75 * r, 1.05 * r), (0.1 * r, 0.3 * r)))
        m.slide("thumb_bar", (0, 0, -1), 0.006)


def _fly(m: Model, c: float, n: int) -> None:
    """A frame with a foot; a perforated or plain spool with a handle on its face."""
    r, half = m.number(0.035, 0.05) * c, 0.012 * c
    m.add(BASE, rod((-half - 0.004, 0, 0), (-half - 0.001, 0, 0), r, n + 8))
    for a in np.pi / 2 + np.arange(m.pick(2, 3, 4)) * np.pi / 2:
        m.add(
            BASE,
            rod(
                (-half - 0.003, 1.03 * r * np.cos(a), 1.03 * r * np.sin(a)),
                (half + 0.002, 1.03 * r * np.cos(a), 1.03 * r * np.sin(a)),
                0.0035,
                8,
            ),
        )
    m.add(
        BASE, box((-half, half), (-0.007, 0.007), (r, 0.06 * c)), box((-0.006, 0.006), (-0.035, 0.035), (0.055 * c, 0.06 * c))
    )
    spool: list[Trimesh] = [rod((-half, 0, 0), (half, 0, 0), 0.4 * r, n)]
    spool += [rod((e * half, 0, 0), (e * (half - 0.002), 0, 0), 0.93 * r, n + 8) for e in (-1, 1)]
    if m.chance(0.6):
        spool += upright([trimesh.creation.annulus(0.38 * r, m.number(0.6, 0.85) * r, 1.8 * half, sections=n)], X, (0, 0, 0))
    m.add("spool", *spool)
    for w in (1, -1)[: m.pick(1, 1, 2)]:
        m.add("spool", rod((half, 0, w * 0.7 * r), (half + 0.024, 0, w * 0.7 * r), 0.006, 10))
    m.add("spool", rod((half, 0, 0), (half + 0.004, 0, 0), 0.012, n))
    m.spin("spool", (0, 0, 0), X)
    if m.chance(0.5):
        m.add("drag_knob", rod((-half - 0.004, 0, 0), (-half - 0.014, 0, 0), 0.014 * c, m.pick(8, 12)))
        m.spin("drag_knob", (-half - 0.004, 0, 0), -X)
