"""Folding seats of theatres."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, moved, prism, rod, rounded, turned, vec


def theatre_seats(m: Model) -> None:
    """Rows of seats whose pans tip up: on standards, beams or steps, with arms, backs, numbers; writing tables on some."""
    rows, count = m.pick(1, 1, 2, 3), m.pick(2, 3, 4, 5, 6)
    pitch, deep = m.number(0.5, 0.6), m.number(0.42, 0.5)
    step, rise = m.number(0.85, 1.0), m.pick(0.0, 0.15, 0.3) if rows > 1 else 0.0
    how = {
        "up": m.chance(0.65),
        "arm": m.pick("wood", "pad", "none", "panel"),
        "back": m.pick("plain", "pad", "round", "slats"),
        "pan": m.pick("pad", "board", "cushion"),
        "stand": m.pick("standard", "standard", "beam", "riser"),
        "seat": m.number(0.42, 0.46),
        "high": m.number(0.82, 1.02),
        "fold": m.number(70, 85),
        "table": m.chance(0.25),
        "cup": m.chance(0.2),
        "lean": m.number(5, 14),
    }
    for row in range(rows):
        z, y = row * rise, row * step
        if rise or m.chance(0.3):
            m.add(BASE, box((-0.1, count * pitch + 0.1), (y - 0.45, y + step - 0.45), (z - max(rise, 0.05), z)))
        n = len(m.pieces)
        for k in range(count):
            _theatre_seat(m, f"{row}_{k}" if rows > 1 else f"{k}", (k * pitch, (k + 1) * pitch), deep, how)
        _seat_ends(m, count, pitch, deep, how)
        for _, solid in m.pieces[n:]:
            moved(solid, (0, y, z))
        for k in range(count):
            name = f"{row}_{k}" if rows > 1 else f"{k}"
            for part in (f"seat_{name}", f"table_{name}"):
                if part in m.joints:
                    j = m.joints[part]
                    m.hinge(part, j.origin + vec(0, y, z), j.axis, tuple(np.rad2deg(j.limits)))


def _seat_ends(m: Model, count: int, pitch: float, deep: float, how: dict) -> None:
    """What stands between the seats and at the ends of a row: standards, arms, beams."""
    for k in range(count + 1):
        x, w, end = k * pitch, 0.025, k in (0, count)
        arm = how["seat"] + 0.2
        if how["arm"] == "panel" or (end and how["stand"] == "standard" and how["arm"] != "none"):
            m.add(
                BASE,
                prism(
                    [(-deep + 0.08, 0.0), (0.1, 0.0), (0.16, arm), (-deep + 0.03, arm), (-deep + 0.03, arm - 0.12)],
                    "x",
                    (x - w, x + w),
                ),
            )
        elif how["stand"] == "standard":
            m.add(
                BASE,
                prism([(-0.16, 0.0), (0.06, 0.0), (0.12, arm), (0.0, arm)], "x", (x - w, x + w)),
                box((x - 0.05, x + 0.05), (-0.22, 0.1), (0, 0.012)),
            )
        elif how["stand"] == "riser":
            m.add(BASE, box((x - w, x + w), (-0.06, 0.12), (0.25, arm)))
        else:
            m.add(BASE, box((x - w, x + w), (-0.1, 0.08), (0.3, arm)))
        if how["arm"] in ("wood", "pad", "panel"):
            m.add(
                BASE, box((x - 0.032, x + 0.032), (-deep + 0.03, 0.1), (arm, arm + (0.025 if how["arm"] == "wood" else 0.045)))
            )
        if how["cup"] and not end:
            m.add(BASE, rod((x, -deep + 0.05, arm - 0.04), (x, -deep + 0.05, arm + 0.03), 0.045, 14))
        if end and how["arm"] == "panel":
            m.add(BASE, rod((x - 0.03, -deep / 2, 0.3), (x + 0.03, -deep / 2, 0.3), 0.025, 10))
    wide = count * pitch
    if how["stand"] == "beam":
        m.add(BASE, box((0.0, wide), (-0.04, 0.06), (0.28, 0.36)))
        m.add(
            BASE,
            *(
                box((a - 0.04, a + 0.04), (-0.04, 0.06), (0, 0.28))
                for a in np.linspace(0.3 * pitch, wide - 0.3 * pitch, max(2, count // 2 + 1))
            ),
        )
    elif how["stand"] == "riser":
        m.add(BASE, box((-0.05, wide + 0.05), (0.1, 0.2), (0.0, 0.42)))


def _theatre_seat(m: Model, name: str, x: Span, deep: float, how: dict) -> None:
    """A fixed back and a pan, made flat, that rests up or down."""
    a, b, seat, high = x[0] + 0.03, x[1] - 0.03, how["seat"], how["high"]
    back = [rod((a, 0.02, seat - 0.05), (b, 0.02, seat - 0.05), 0.012, 8)] if m.chance(0.1) else []
    if how["back"] == "slats":
        back += [box((a, b), (0.03, 0.05), (c, c + 0.05)) for c in np.arange(seat - 0.02, high - 0.05, 0.075)]
        back += [box((c, c + 0.03), (0.05, 0.07), (seat - 0.05, high)) for c in (a, b - 0.03)]
    elif how["back"] == "round":
        shape = rounded((a, b), (seat - 0.06, high), 0.18 * (b - a))
        back += [prism(shape, "y", (0.045, 0.065)), prism(shape.buffer(-0.02), "y", (0.01, 0.045))]
    else:
        back += [box((a, b), (0.04, 0.06), (seat - 0.08, high))]
        if how["back"] == "pad":
            back += [prism(rounded((a + 0.01, b - 0.01), (seat + 0.0, high - 0.01), 0.03), "y", (0.0, 0.04))]
    m.add(BASE, *(turned(s, (1, 0, 0), -how["lean"], (0, 0.04, seat)) for s in back))
    if m.chance(0.5):
        m.add(BASE, box(((a + b) / 2 - 0.02, (a + b) / 2 + 0.02), (0.055, 0.075), (seat - 0.04, seat - 0.01)))
    pivot, t = vec((a + b) / 2, -0.06, seat - 0.02), 0.02
    y = (-deep, -0.035)
    pan: list[Trimesh] = [box((a + 0.004, b - 0.004), y, (seat - 0.06, seat - 0.06 + t))]
    if how["pan"] == "pad":
        pan.append(box((a + 0.008, b - 0.008), (y[0] + 0.005, y[1] - 0.02), (seat - 0.04, seat + 0.02)))
    elif how["pan"] == "cushion":
        shape = rounded((a + 0.008, b - 0.008), (y[0] - 0.005, y[1] - 0.01), 0.05)
        pan += [prism(shape, "z", (seat - 0.045, seat + 0.0)), prism(shape.buffer(-0.02), "z", (seat, seat + 0.025))]
    pan += [box((c - 0.008, c + 0.008), (-0.12, -0.04), (seat - 0.07, seat - 0.01)) for c in (a + 0.012, b - 0.012)]
    part, turn = f"seat_{name}", how["fold"]
    if how["up"]:
        pan = [turned(s, (1, 0, 0), -turn, pivot) for s in pan]
    m.add(part, *pan)
    m.add(
        BASE,
        *(rod((c, pivot[1], pivot[2]), (d, pivot[1], pivot[2]), 0.016, 10) for c, d in ((x[0], a + 0.004), (b - 0.004, x[1]))),
    )
    m.hinge(part, pivot, (1, 0, 0) if how["up"] else (-1, 0, 0), turn)
    if how["table"] and how["up"]:
        _seat_table(m, f"table_{name}", x[1], deep, seat + 0.2)


def _seat_table(m: Model, part: str, x: float, deep: float, arm: float) -> None:
    """A small table that hangs folded beside the arm and turns up about its front-to-back edge."""
    z, t, y = arm - 0.02, 0.012, (-deep - 0.02, -deep + 0.24)
    m.add(
        part,
        box((x - 0.048, x - 0.036), y, (z - 0.26, z)),
        rod((x - 0.042, y[0] + 0.04, z), (x - 0.042, y[1] - 0.04, z), 0.008, 8),
    )
    m.add(BASE, box((x - 0.045, x), (y[0] + 0.1, y[0] + 0.15), (z - 0.004, z + 0.02 + t)))
    m.hinge(part, (x - 0.042, sum(y) / 2, z), (0, 1, 0), m.number(85, 95))
