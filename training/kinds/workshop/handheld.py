"""Hand tools: pliers, hole punch, drill, lever clamp."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rod, rounded, vec
from training.kinds.wheels import beam, lathe


def pliers(m: Model) -> None:
    """Two crossing halves on a pin; one half is the base; perhaps with grips, a spring and a notch."""
    scale, thick, n = m.number(0.8, 1.4), m.number(0.006, 0.011), m.sections()
    jaw, grip, spread = m.number(0.03, 0.08) * scale, m.number(0.1, 0.15) * scale, m.number(0.02, 0.035) * scale
    opened = m.pick(0, 0, 10, 20)
    layered = m.chance(0.5)
    for s, part in ((1, BASE), (-1, "half")):
        tip = [(0, 0), (0, jaw), (s * 0.004, jaw), (s * 0.014 * scale, 0.0)]
        arm = LineString([(0, 0), (-s * 0.5 * spread, -0.3 * grip), (-s * spread, -0.6 * grip), (-s * 0.8 * spread, -grip)])
        outline = (
            Polygon(tip)
            .union(arm.buffer(0.006 * scale, quad_segs=3))
            .union(Point(0, 0).buffer(0.013 * scale, quad_segs=n // 2))
        )
        z = (0, thick) if not layered else ((0, 0.5 * thick) if s > 0 else (0.5 * thick + 0.0002, thick))
        pieces = [prism(outline, "z", z)]
        if layered:
            pieces.append(prism(Polygon(tip).difference(Point(0, 0).buffer(0.014 * scale)).buffer(0), "z", (0, thick)))
        if m.chance(0.6):
            grips = LineString([(-s * 0.8 * spread, -0.5 * grip), (-s * spread, -0.6 * grip), (-s * 0.8 * spread, -grip)])
            pieces.append(prism(grips.buffer(0.008 * scale, quad_segs=3), "z", (-0.002, thick + 0.002)))
        for piece in pieces:
            if s < 0:
                turn = np.deg2rad(opened)
                c, d = np.cos(turn), np.sin(turn)
                piece.vertices = piece.vertices @ np.array([[c, -d, 0], [d, c, 0], [0, 0, 1]]).T
            m.add(part, piece)
    m.add(m.pick(BASE, "half"), rod((0, 0, -0.0015), (0, 0, thick + 0.0015), 0.007 * scale, n))
    m.hinge("half", (0, 0, 0), (0, 0, 1), (-opened, 45 - opened))


def hole_punch(m: Model) -> None:
    """A foot with a lever that is pressed, punch pins that go down, a guide that slides, a tray."""
    wide, deep, n = m.number(0.1, 0.16), m.number(0.09, 0.13), m.sections()
    m.add(BASE, prism(rounded((0, wide), (0, deep), 0.008), "z", (0, 0.012)))
    m.add(BASE, *(box((x, x + 0.004), (0.45 * deep, 0.95 * deep), (0.012, 0.045)) for x in (0.12 * wide, 0.88 * wide - 0.004)))
    m.add(BASE, *(box((x - 0.012, x + 0.012), (0.3 * deep, 0.55 * deep), (0.012, 0.028)) for x in (0.25 * wide, 0.75 * wide)))
    pivot = vec(wide / 2, 0.88 * deep, 0.036)
    lever = [(0.95 * deep, 0.03), (0.95 * deep, 0.045), (0.3 * deep, 0.065), (-0.02, 0.075), (-0.02, 0.07), (0.3 * deep, 0.055)]
    m.add("lever", prism(lever, "x", (0.16 * wide, 0.84 * wide)))
    if m.chance(0.6):
        m.add("lever", prism([(0.1, 0.07), (-0.024, 0.079), (-0.024, 0.073)], "x", (0.2 * wide, 0.8 * wide)))
    m.add(m.pick(BASE, "lever"), rod((0.1 * wide, pivot[1], pivot[2]), (0.9 * wide, pivot[1], pivot[2]), 0.003, n))
    m.hinge("lever", pivot, (1, 0, 0), m.pick(12, 16))
    if m.chance(0.6):
        for k, x in enumerate((0.25 * wide, 0.75 * wide)):
            m.add(f"pin_{k}", rod((x, 0.42 * deep, 0.02), (x, 0.42 * deep, 0.045), 0.003, n))
            m.slide(f"pin_{k}", (0, 0, -1), 0.012)
    if m.chance(0.6):
        m.add(
            "guide",
            box((-0.04, 0.3 * wide), (0.2 * deep, 0.26 * deep), (0.013, 0.015)),
            box((-0.044, -0.04), (0.15 * deep, 0.31 * deep), (0.008, 0.02)),
        )
        m.slide("guide", (-1, 0, 0), 0.06)
    if m.chance(0.5):
        m.add("tray", box((0.002, wide - 0.002), (0.01, deep - 0.002), (-0.004, -0.0005)))
        m.hinge("tray", (wide / 2, deep - 0.002, -0.001), (1, 0, 0), 70)


def power_drill(m: Model) -> None:
    """A body with a grip, a trigger, a chuck that spins, a collar, a battery that slides off, a switch on top."""
    r, long, n = m.number(0.025, 0.035), m.number(0.14, 0.19), m.pick(12, 16, 24)
    profile = [(0, 0), (0.6 * r, 0), (0.95 * r, 0.03), (r, 0.06), (r, long - 0.02), (0.8 * r, long), (0, long)]
    body = lathe(profile, n)
    body.vertices = body.vertices[:, [0, 2, 1]] * (1, 1, 1)
    body.invert()
    m.add(BASE, body)
    lean = m.number(0.0, 0.05)
    m.add(BASE, beam((0, 0.6 * long, 0), (0, 0.6 * long + lean, -0.13), 0.038, 0.045))
    trigger = vec(0, 0.6 * long - 0.03, -r - 0.012)
    m.add("trigger", beam(trigger + vec(0, 0.012, 0.006), trigger + vec(0, 0.016, -0.025), 0.016, 0.022))
    if m.chance(0.6):
        m.slide("trigger", (0, 1, 0), 0.008)
    else:
        m.hinge("trigger", trigger + vec(0, 0.012, 0.006), (1, 0, 0), 12)
    at = vec(0, -0.001, 0)
    m.add("chuck", rod(at, at - vec(0, 0.03, 0), 0.8 * r, n), rod(at - vec(0, 0.03, 0), at - vec(0, 0.045, 0), 0.5 * r, n))
    m.add(
        "chuck",
        *(
            rod(
                at + 0.8 * r * vec(np.cos(t), 0, np.sin(t)) - vec(0, 0.004, 0),
                at + 0.8 * r * vec(np.cos(t), 0, np.sin(t)) - vec(0, 0.026, 0),
                0.0012,
                5,
            )
            for t in np.linspace(0, 6, 12)
        ),
    )
    if m.chance(0.6):
        m.add("chuck", rod(at - vec(0, 0.045, 0), at - vec(0, m.number(0.08, 0.14), 0), 0.003, 8))
    m.spin("chuck", at, (0, -1, 0))
    if m.chance(0.5):
        m.add("collar", cut(rod((0, 0.012, 0), (0, 0.03, 0), 1.05 * r, n), rod((0, -1, 0), (0, 1, 0), 0.9 * r, n)))
        m.spin("collar", (0, 0.02, 0), (0, -1, 0))
    low, y = -0.13, 0.6 * long + lean
    m.add(BASE, box((-0.03, 0.03), (y - 0.045, y + 0.045), (low - 0.01, low + 0.005)))
    m.add("battery", box((-0.034, 0.034), (y - 0.05, y + 0.05), (low - m.number(0.045, 0.065), low - 0.011)))
    m.slide("battery", m.pick((0, -1, 0), (0, 0, -1)), 0.07)
    if m.chance(0.5):
        m.add("gear", box((-0.008, 0.008), (0.45 * long, 0.45 * long + 0.014), (r - 0.002, r + 0.006)))
        m.slide("gear", (0, 1, 0), 0.015)
    m.add(
        BASE,
        *(
            box(
                (s * r * 0.9, s * 1.02 * r),
                (0.8 * long, 0.8 * long + 0.003 + 0.006 * (k % 2)),
                (-0.012 + 0.008 * k, -0.008 + 0.008 * k),
            )
            for s in (-1, 1)
            for k in range(4)
        ),
    )
    if m.chance(0.4):
        m.add("reverse", box((-0.03, 0.03), (0.6 * long - 0.03, 0.6 * long - 0.018), (-r - 0.002, -r + 0.005)))
        m.slide("reverse", (1, 0, 0), (-0.006, 0.006))


def lever_clamp(m: Model) -> None:
    """A bar with a fixed and a sliding jaw and a screw, or a toggle clamp on a plate."""
    n = m.pick(8, 12, 16)
    if m.chance(0.5):
        long, jaw = m.number(0.2, 0.5), m.number(0.06, 0.1)
        m.add(BASE, box((-0.004, 0.004), (0, 0.022), (0, long)), box((-0.007, 0.007), (-jaw, 0.025), (long - 0.022, long)))
        m.add(BASE, rod((0, -jaw + 0.01, long - 0.03), (0, -jaw + 0.01, long - 0.022), 0.01, n))
        z = m.number(0.3, 0.7) * long
        slider = box((-0.009, 0.009), (-jaw, 0.032), (z, z + 0.03))
        m.add("jaw", cut(slider, box((-0.0045, 0.0045), (-0.0005, 0.0225), (-1, 1))))
        m.slide("jaw", (0, 0, 1), (-z + 0.01, max(0.01, long - z - 0.1)), BASE)
        a = vec(0, -jaw + 0.01, z)
        m.add(
            "screw",
            rod(a - vec(0, 0, 0.08), a + vec(0, 0, 0.045), 0.004, n),
            rod(a + vec(0, 0, 0.045), a + vec(0, 0, 0.052), 0.01, n),
        )
        if m.chance(0.5):
            m.add("screw", rod(a - vec(0, 0, 0.14), a - vec(0, 0, 0.05), 0.012, n))
        else:
            m.add("screw", rod(a - vec(0.03, 0, 0.075), a + vec(0.03, 0, -0.075), 0.003, 8))
        m.spin("screw", a, (0, 0, 1), "jaw")
        if m.chance(0.4):
            m.add("lever", beam(vec(0, 0.03, z + 0.015), vec(0, 0.1, z - 0.02), 0.012, 0.008))
            m.hinge("lever", (0, 0.03, z + 0.015), (-1, 0, 0), 35, "jaw")
        return
    m.add(
        BASE,
        box((-0.03, 0.03), (0, 0.06), (0, 0.004)),
        *(box((s * 0.012, s * 0.015), (0.005, 0.05), (0.004, 0.05)) for s in (-1, 1)),
    )
    m.add(BASE, *(rod((x, y, 0), (x, y, 0.006), 0.004, 6) for x in (-0.023, 0.023) for y in (0.01, 0.05)))
    a, b = vec(0, 0.012, 0.042), vec(0, 0.04, 0.042)
    reach = m.number(0.06, 0.1)
    m.add(
        "arm",
        box((-0.011, 0.011), (-reach, 0.018), (0.036, 0.048)),
        rod((0, 0.01 - reach, 0.008), (0, 0.01 - reach, 0.056), 0.004, n),
        rod((0, 0.01 - reach, 0.004), (0, 0.01 - reach, 0.012), 0.008, n),
    )
    m.hinge("arm", a, (-1, 0, 0), 90)
    m.add(
        "lever",
        beam(b, b + vec(0, 0.02 + m.number(0.05, 0.1), 0.03), 0.016, 0.008),
        rod(b - vec(0.018, 0, 0), b + vec(0.018, 0, 0), 0.004, n),
    )
    if m.chance(0.5):
        m.add("lever", ball(b + vec(0, 0.09, 0.035), (0.012, 0.03, 0.011), n))
    m.hinge("lever", b, (1, 0, 0), 70)
