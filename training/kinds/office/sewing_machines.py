"""Sewing machines."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.electronics.controls import knob
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe, upright

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)


def sewing_machine(m: Model) -> None:
    """An arm over a bed with a wheel at its right: new or old; needle, foot and its lever, dials, covers, a spool, a table."""
    old, n = m.chance(0.35), m.pick(16, 24)
    wide, deep, high = m.number(0.36, 0.44), m.number(0.13, 0.18), m.number(0.25, 0.31)
    bed = m.number(0.045, 0.075)
    post, arm, head = 0.28 * wide, m.number(0.06, 0.08), m.number(0.075, 0.1)
    x, y = (0.0, wide), (0.0, deep)
    line = [(0, high), (0, bed + 0.075), (head, bed + 0.075), (head, high - arm), (wide - post, high - arm), (wide - post, bed),
            (wide, bed), (wide, high)]  # fmt: skip
    outline = Polygon(line)
    outline = outline.buffer(-0.015).buffer(0.015) if m.chance(0.4) else outline
    if old:
        outline = outline.intersection(rounded((0, wide), (bed - 0.1, high), 0.045))
        y = (0.25 * deep, 0.75 * deep)
        m.add(BASE, box((-0.03, wide + 0.01), (0, deep), (0.012, bed)))
        m.add(BASE, box((-0.045, wide + 0.025), (-0.012, deep + 0.012), (0, 0.014)))
    elif m.chance(0.5):
        outline = outline.intersection(rounded((0, wide), (bed - 0.1, high), 0.03))
    m.add(BASE, prism(outline, "y", y))
    if not old:
        _new_bed(m, wide, deep, bed, post)
    _needle(m, 0.5 * head, deep / 2, bed, bed + 0.075, n)
    _hand_wheel(m, wide, deep / 2, high - 0.45 * arm, old, n)
    _dials(m, (head, wide), y, (bed, high), arm, post, old)
    _covers(m, x, y, (bed, high), head, arm, old)


def _new_bed(m: Model, wide: float, deep: float, bed: float, post: float) -> None:
    """The foot of a new machine; on some, half of the bed slides off."""
    free = m.chance(0.6)
    m.add(BASE, box((wide - post - 0.01, wide), (0, deep), (0.006, bed + 0.001)))
    m.add(
        BASE,
        box((0.02, wide - post), (0.3 * deep if free else 0.0, 0.8 * deep if free else deep), (0.02 if free else 0.006, bed)),
    )
    m.add(
        BASE,
        *(rod((a, b, 0), (a, b, 0.007), 0.012, 8) for a in (wide - post + 0.02, wide - 0.03) for b in shrunk((0, deep), 0.025)),
    )
    if free:  # the part of the bed that slides off
        m.add(
            "table",
            box((-0.02, wide - post - 0.012), (-0.01, 0.3 * deep - 0.001), (0.004, bed)),
            box((-0.02, 0.018), (0.3 * deep - 0.001, deep), (0.004, bed)),
        )
        m.slide("table", (-1, 0, 0), m.number(0.08, 0.15))
        if m.chance(0.5):
            a = (0.02, wide - post - 0.05)
            m.add("table_lid", box(a, (-0.014, -0.0105), (0.012, bed - 0.006)))
            m.hinge("table_lid", (a[0], -0.014, 0.012), X, m.number(70, 90), "table")


def _needle(m: Model, a: float, y: float, bed: float, low: float, n: int) -> None:
    """The needle bar, the presser foot on its bar with a lever behind, the plate below."""
    m.add(BASE, box((a - 0.03, a + 0.03), (y - 0.03, y + 0.03), (bed, bed + 0.0015)))
    m.add(
        "needle_bar",
        rod((a, y, low + 0.001), (a, y, bed + 0.045), 0.0035, n),
        rod((a, y, bed + 0.05), (a, y, bed + 0.04), 0.006, 8),
    )
    m.add(
        "needle_bar",
        rod((a, y, bed + 0.041), (a, y, bed + 0.012), 0.0009, 6),
        rod((a, y, bed + 0.045), (a + 0.012, y, bed + 0.045), 0.0025, 6),
    )
    m.slide("needle_bar", (0, 0, -1), m.number(0.02, 0.03))
    b = y + 0.012
    m.add(
        "presser",
        rod((a, b, low + 0.001), (a, b, bed + 0.012), 0.0035, n),
        box((a - 0.006, a + 0.006), (y - 0.016, b), (bed + 0.006, bed + 0.009)),
    )
    m.add("presser", box((a - 0.006, a + 0.006), (b - 0.004, b + 0.004), (bed + 0.008, bed + 0.02)))
    m.slide("presser", Z, m.number(0.005, 0.009))
    m.add(
        "presser_lever",
        beam((a + 0.004, b, low - 0.004), (a + 0.03, b + 0.035, low - 0.018), 0.008, 0.004, Z),
        rod((a, b, low - 0.008), (a, b, low), 0.006, 8),
    )
    m.hinge("presser_lever", (a, b, low - 0.004), (-0.8, 0.6, 0), m.number(40, 70))


def _hand_wheel(m: Model, wide: float, y: float, z: float, old: bool, n: int) -> None:
    """The wheel at the right end: a disc or one with spokes and a crank."""
    r = m.number(0.05, 0.07) if old else m.number(0.028, 0.042)
    if old and m.chance(0.6):
        solids = [ring((0, 0, 0.015), Z, r, 0.007, 24), rod((0, 0, 0.0005), (0, 0, 0.026), 0.016, n)]
        solids += [
            beam((0, 0, 0.015), (r * np.cos(t), r * np.sin(t), 0.015), 0.008, 0.006, Z)
            for t in np.linspace(0, 2 * np.pi, 6)[:5]
        ]
    else:
        solids = [
            lathe(
                [
                    (0, 0.0005),
                    (0.8 * r, 0.0005),
                    (r, 0.006),
                    (r, 0.018),
                    (0.7 * r, 0.024),
                    (0.4 * r, 0.024),
                    (0.4 * r, 0.032),
                    (0, 0.032),
                ],
                n,
            )
        ]
    m.add("hand_wheel", *upright(solids, X, (wide, y, z)))
    m.spin("hand_wheel", (wide, y, z), X)
    if old and m.chance(0.5):
        a, b = vec(wide + 0.035, y, z), vec(wide + 0.045, y - 0.075, z + 0.01)
        m.add("hand_wheel", rod((wide, y, z), a, 0.007, 8), beam(a, b, 0.012, 0.006, Z), rod(b, b + vec(0.05, 0, 0), 0.01, 10))


def _dials(m: Model, x: Span, y: Span, z: Span, arm: float, post: float, old: bool) -> None:
    """Dials and keys on the front, a screen, a lever to sew backwards."""
    c, front = x[1] - post / 2, y[0]
    low = z[0] + 0.3 * (z[1] - z[0])
    for k in range(1 if old else m.pick(1, 2, 3)):
        at = (c, front, low + 0.05 * k) if k < 2 else (x[1] - post - 0.05, front, z[1] - 0.5 * arm)
        knob(m, f"dial_{k}", at, (0, -1, 0), m.number(0.014, 0.02))
    m.add("reverse_lever", box((c - 0.03, c - 0.005), (front - 0.016, front + 0.001), (z[0] + 0.012, z[0] + 0.022)))
    m.hinge("reverse_lever", (c - 0.03, front, z[0] + 0.022), X, m.number(12, 25))
    if not old and m.chance(0.5):
        m.add(BASE, box((x[0] + 0.06, x[1] - post - 0.08), (front - 0.001, front), (z[1] - arm + 0.015, z[1] - 0.015)))
    for k in range(0 if old else m.pick(0, 2, 4)):
        button(m, f"key_{k}", (x[0] - 0.02, front, z[0] + 0.085 + 0.02 * k), (0, -1, 0), 0.012)
    knob(m, "tension", (x[0] - 0.02, front, z[1] - 0.02), (0, -1, 0), 0.012, style="fluted")


def _covers(m: Model, x: Span, y: Span, z: Span, head: float, arm: float, old: bool) -> None:
    """The plate over the end of the head, a lid on the arm or spool pins with thread, a handle, the winder."""
    mid, tall = (y[0] + y[1]) / 2, (z[0] + 0.08, z[1] - (0.05 if old else 0.035))
    m.add("face_plate", box((-0.007, -0.0005), shrunk(y, 0.008), tall))
    if m.chance(0.7):
        m.hinge("face_plate", (-0.007, y[1] - 0.008, tall[0]), (0, 0, -1), m.number(90, 140))
    else:
        m.slide("face_plate", (-1, 0, 0), 0.02)
    top, inside = z[1], (head, x[1] - 0.06)
    if not old and m.chance(0.45):
        m.add("top_lid", box(inside, shrunk(y, 0.006), (top + 0.0005, top + 0.014)))
        m.hinge("top_lid", (inside[0], y[1] - 0.006, top), (-1, 0, 0), m.number(80, 110))
        return
    for k in range(m.pick(1, 2)):
        p, r, long = vec(inside[1] - 0.04 - 0.06 * k, mid + 0.01, top), m.number(0.012, 0.018), m.number(0.035, 0.05)
        m.add(BASE, rod(p - vec(0, 0, 0.002), p + vec(0, 0, long + 0.015), 0.002, 6))
        if m.chance(0.8):
            line = [(0.003, 0.001), (r, 0.001), (r, 0.004), (0.75 * r, 0.006), (0.75 * r, long - 0.006), (r, long - 0.004)]
            m.add(f"spool_{k}", lathe([*line, (r, long), (0.003, long), line[0]], 16, p))
            m.spin(f"spool_{k}", p, Z)
    w = vec(x[1] - 0.03, mid - 0.012, top)
    m.add("winder", rod(w, w + vec(0, 0, 0.016), 0.002, 6), rod(w, w + vec(0, 0, 0.004), 0.009, 12))
    m.spin("winder", w, Z)
    if not old and m.chance(0.7):
        a, s = (0.25 * x[1], 0.6 * x[1]), 0.006
        m.add(
            "handle",
            tube(
                [
                    (a[0], y[1] - 0.012, top - 0.003),
                    (a[0], y[1] - 0.012, top + 0.035),
                    (a[1], y[1] - 0.012, top + 0.035),
                    (a[1], y[1] - 0.012, top - 0.003),
                ],
                s,
                8,
            ),
        )
        m.hinge("handle", (a[0], y[1] - 0.012, top), (-1, 0, 0), m.pick(80, 90))
