"""Pencil sharpeners with a crank, a motor or a plain blade."""

from __future__ import annotations

import numpy as np
import trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import arch, ball, box, cut, moved, prism, rod, rounded, vec
from training.kinds.wheels import beam, lathe, upright


def pencil_sharpener(m: Model) -> None:
    """A desk model with a drawer, a wall model with a drum, an electric one, a block on a jar."""
    style = m.pick("desk", "desk", "wall", "electric", "jar")
    {"desk": _desk, "wall": _wall, "electric": _electric, "jar": _jar}[style](m)


def _crank(m: Model, at: np.ndarray, long: float) -> None:
    """An arm behind the body with a knob that turns on its pin in some."""
    m.add("crank", rod(at - vec(0, 0.012, 0), at + vec(0, 0.012, 0), 0.006, 10))
    a, angle = at + vec(0, 0.009, 0), np.deg2rad(m.pick(0, 90, 150))
    end = a + long * vec(np.sin(angle), 0, np.cos(angle))
    m.add("crank", beam(a, end, 0.01, 0.004, (np.cos(angle), 0, -np.sin(angle)), m.number(0.7, 1.0)))
    tip = end + vec(0, 0.028, 0)
    m.add("crank", rod(end, tip, 0.003, 8))
    if m.chance(0.7):
        round_ = ball(tip, (0.009, 0.011, 0.009), 10)
        m.add("crank_knob", round_ if m.chance(0.4) else rod(end + vec(0, 0.004, 0), tip, m.number(0.006, 0.009), 10))
        m.spin("crank_knob", end, (0, 1, 0), "crank")
    m.spin("crank", at, (0, 1, 0))


def _shell(m: Model, wide: float, deep: float, high: float, tray: float) -> None:
    """A housing with an opening in front for the drawer, or a solid one that the drawer is drawn into."""
    outline = rounded((-wide / 2, wide / 2), (0, high), m.pick(0.002, 0.007))
    if m.chance(0.5):
        outline = arch((-wide / 2, wide / 2), (0, high), m.number(0.15, 0.5) * wide)
    solid = prism(outline, "y", (0, deep))
    half = wide / 2 - 0.004
    opening = box((-half, half), (-1, deep - 0.006), (0.004, tray))
    m.add(BASE, cut(solid, opening) if m.chance(0.7) else solid)
    gap = m.gap(0.05)
    a, z = half - max(gap, 0.0003), (0.0045, tray - max(gap, 0.0003))
    m.add("drawer", box((-a, a), (-0.001, 0.0025), z))
    m.add(
        "drawer",
        box((-a, a), (0, deep - 0.008), (z[0], z[0] + 0.0015)),
        box((-a, a), (deep - 0.01, deep - 0.008), (z[0], 0.8 * z[1])),
    )
    m.add("drawer", *(box((s * a - s * 0.0015, s * a), (0, deep - 0.008), (z[0], 0.8 * z[1])) for s in (-1, 1)))
    if m.chance(0.6):
        m.add("drawer", box((-0.4 * a, 0.4 * a), (-0.007, 0), (0.6 * tray, 0.6 * tray + 0.003)))
    m.slide("drawer", (0, -1, 0), 0.85 * deep)


def _desk(m: Model) -> None:
    """A housing with a crank behind, a drawer below, in some a face plate with clips that is drawn out."""
    wide, deep, high = m.number(0.045, 0.07), m.number(0.05, 0.085), m.number(0.08, 0.12)
    tray = m.number(0.35, 0.5) * high
    _shell(m, wide, deep, high, tray)
    center = vec(0, deep, tray + 0.5 * (high - tray))
    _crank(m, center + vec(0, 0.005, 0), m.number(0.03, 0.05))
    if m.chance(0.5):
        y, half = -0.0005, 0.4 * wide
        plate = prism(rounded((-half, half), (tray + 0.003, high - 0.005), 0.006), "y", (y - 0.006, y))
        hole = rod((0, -1, center[2]), (0, 1, center[2]), 0.005, 12)
        m.add(
            "face_plate",
            cut(plate, hole),
            *(rod((s * 0.7 * half, y, center[2]), (s * 0.7 * half, 0.8 * deep, center[2]), 0.0018, 8) for s in (-1, 1)),
        )
        m.slide("face_plate", (0, -1, 0), 0.6 * deep)
    else:
        m.add(
            BASE,
            moved(
                *upright([trimesh.creation.annulus(0.0045, 0.011, 0.006, sections=16)], (0, 1, 0), (0, -0.002, center[2])),
                (0, 0, 0),
            ),
        )
    if m.chance(0.35):
        m.add(
            BASE, box((-0.02, 0.02), (0.3 * deep, deep), (-0.025, 0.0)), box((-0.02, 0.02), (0.2 * deep, deep), (-0.06, -0.055))
        )
        m.add(BASE, box((-0.02, 0.02), (deep - 0.006, deep), (-0.056, -0.02)))
        screw = vec(0, 0.45 * deep, -0.06)
        m.add(
            "clamp_screw",
            rod(screw - vec(0, 0, 0.02), screw + vec(0, 0, 0.022), 0.004, 10),
            rod(screw + vec(0, 0, 0.02), screw + vec(0, 0, 0.024), 0.009, 12),
        )
        m.add("clamp_screw", rod(screw - vec(0.014, 0, 0.02), screw - vec(-0.014, 0, 0.02), 0.003, 8))
        m.spin("clamp_screw", screw, (0, 0, 1))


def _wall(m: Model) -> None:
    """A plate with a stand, a drum for the shavings that turns off, a disc with holes that turns, a crank behind."""
    r, long, n = m.number(0.024, 0.032), m.number(0.05, 0.07), m.pick(16, 24)
    axis = m.number(0.05, 0.065)
    if m.chance(0.5):
        m.add(BASE, prism(rounded((-0.04, 0.04), (-0.01, long + 0.02), 0.01), "z", (0, 0.004)))
    else:
        m.add(
            BASE,
            box((-0.045, -0.04), (-0.01, long + 0.02), (0, axis + 0.03)),
            box((-0.041, 0.0), (0.03 * long, 0.25 * long), (axis - 0.02, axis)),
        )
    m.add(BASE, beam((0, 0.15 * long, 0.002), (0, 0.15 * long, axis), 0.02, 0.01, taper=0.7))
    if m.chance(0.5):
        m.add(BASE, box((-0.04, 0.04), (0.1 * long, long), (0, 0.006)))
    m.add(
        BASE,
        *upright(
            [lathe([(0, 0), (0.6 * r, 0), (r, 0.1 * long), (r, 0.28 * long), (0, 0.28 * long)], n)], (0, 1, 0), (0, 0, axis)
        ),
    )
    drum = lathe([(0, 0.29 * long), (0.98 * r, 0.29 * long), (0.98 * r, 0.85 * long), (0.75 * r, long), (0, long)], n)
    m.add("drum", *upright([drum], (0, 1, 0), (0, 0, axis)))
    m.spin("drum", (0, 0.3 * long, axis), (0, 1, 0))
    if m.chance(0.7):
        disc = [rod((0, -0.004, axis), (0, -0.0003, axis), 0.9 * r, n)]
        holes = [
            rod(
                (0.6 * r * np.cos(a), -1, axis + 0.6 * r * np.sin(a)),
                (0.6 * r * np.cos(a), 1, axis + 0.6 * r * np.sin(a)),
                q,
                12,
            )
            for a, q in zip(np.arange(6) * np.pi / 3, np.linspace(0.0025, 0.006, 6), strict=True)
        ]
        m.add("guide_disc", cut(disc[0], *holes), rod((0, -0.006, axis), (0, -0.002, axis), 0.004, 8))
        m.spin("guide_disc", (0, -0.002, axis), (0, -1, 0))
    _crank(m, vec(0, long + 0.004, axis), m.number(0.035, 0.055))


def _electric(m: Model) -> None:
    """A housing with a motor inside: only its drawer, perhaps a guide disc on its top or front."""
    wide, deep, high = m.number(0.06, 0.09), m.number(0.07, 0.12), m.number(0.07, 0.11)
    tray = m.number(0.35, 0.55) * high
    _shell(m, wide, deep, high, tray)
    at = vec(0, 0, tray + 0.5 * (high - tray))
    r = min(0.28 * (high - tray) + 0.006, 0.35 * wide)
    m.add("guide_disc", rod(at + vec(0, 0.001, 0), at - vec(0, 0.006, 0), r, m.pick(12, 20)))
    m.add("guide_disc", box((-0.0015, 0.0015), (-0.0075, -0.005), (at[2], at[2] + 0.9 * r)))
    m.spin("guide_disc", at, (0, -1, 0))
    m.add(
        BASE,
        *(
            box((s * 0.35 * wide - 0.006, s * 0.35 * wide + 0.006), (0.1 * deep, 0.1 * deep + 0.012), (-0.003, 0.001))
            for s in (-1, 1)
        ),
    )


def _jar(m: Model) -> None:
    """A jar for the shavings with a lid that holds the blade block; in some a flap over the hole."""
    r, high, n = m.number(0.017, 0.028), m.number(0.035, 0.06), m.pick(12, 16, 24)
    m.add(BASE, lathe([(0, 0), (r, 0), (r, high), (0.92 * r, high), (0.92 * r, 0.003), (0, 0.003)], n))
    top = high + m.number(0.008, 0.016)
    lid = cut(rod((0, 0, high + 0.0003), (0, 0, top), 1.04 * r, n), rod((0, 0, 0), (0, 0, 1), 0.0042, 12))
    m.add(
        "lid",
        lid,
        prism(
            [(-0.006, high + 0.002), (0.006, high + 0.002), (0.004, 0.4 * high), (-0.004, 0.4 * high)], "y", (-0.012, -0.0045)
        ),
    )
    m.slide("lid", (0, 0, 1), 0.8 * high)
    if m.chance(0.6):
        m.add("flap", prism(rounded((-0.008, 0.008), (-0.009, 0.75 * r), 0.003), "z", (top + 0.0003, top + 0.002)))
        m.add("lid", box((-0.006, 0.006), (0.75 * r, 0.75 * r + 0.003), (top - 0.001, top + 0.002)))
        m.hinge("flap", (0, 0.75 * r, top + 0.001), (-1, 0, 0), m.pick(100, 150), "lid")
