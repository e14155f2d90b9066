"""Turntable, camera and monitor."""

from __future__ import annotations

import numpy as np

from training.kinds.electronics.controls import button, knob
from training.kinds.model import BASE, Model
from training.kinds.panels import sheet
from training.kinds.solids import box, cut, prism, rectangle, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam


def turntable(m: Model) -> None:
    """A plinth with a platter, a tone arm, a dust lid hinged at the rear, a knob or two."""
    wide, deep, high, r = m.number(0.4, 0.48), m.number(0.33, 0.38), m.number(0.05, 0.12), m.number(0.13, 0.155)
    m.add(BASE, prism(rounded((0, wide), (0, deep), m.pick(0.002, 0.02)), "z", (0.015, high)))
    m.add(BASE, *(rod((x, y, 0), (x, y, 0.02), 0.025, m.sections()) for x in (0.05, wide - 0.05) for y in (0.05, deep - 0.05)))
    at, n = vec(0.02 + 0.17, deep / 2, high), m.pick(16, 32, 48)
    m.add("platter", rod(at + vec(0, 0, 0.002), at + vec(0, 0, 0.015), r, n), rod(at, at + vec(0, 0, 0.025), 0.0035, 8))
    if m.chance(0.5):
        m.add(
            "platter",
            rod(at + vec(0, 0, 0.015), at + vec(0, 0, 0.018), 0.97 * r, n),
            rod(at + vec(0, 0, 0.018), at + vec(0, 0, 0.0185), 0.05, 16),
        )
    m.spin("platter", at, (0, 0, 1))
    pivot = vec(wide - 0.05, deep - 0.08, high)
    m.add(BASE, rod(pivot, pivot + vec(0, 0, 0.012), 0.03, n))
    up = pivot + vec(0, 0, 0.04)
    end = vec(wide - 0.065, 0.07, up[2] - 0.01)
    path = (
        [up + vec(0, 0.05, 0), up, end]
        if m.chance(0.5)
        else [up + vec(0, 0.05, 0), up, 0.6 * up + 0.4 * end + vec(0.015, 0, 0), 0.3 * up + 0.7 * end, end]
    )
    m.add(
        "arm",
        tube(path, 0.004, 8),
        rod(up + vec(0, 0.03, 0), up + vec(0, 0.065, 0), 0.014, n),
        rod(pivot + vec(0, 0, 0.012), up + vec(0, 0, 0.006), 0.01, n),
    )
    m.add("arm", box((end[0] - 0.01, end[0] + 0.008), (end[1] - 0.02, end[1] + 0.01), (end[2] - 0.012, end[2] + 0.004)))
    m.hinge("arm", pivot, (0, 0, -1), 35)
    if m.chance(0.5):
        button(m, "start", (0.02, 0.05), (0.02, 0.05), high, 0.004, style=m.pick("box", "disc"))
    if m.chance(0.6):
        m.add(BASE, box((wide - 0.03, wide - 0.028), (0.05, 0.15), (high, high + 0.001)))
        m.add("pitch", box((wide - 0.04, wide - 0.018), (0.09, 0.105), (high + 0.001, high + 0.012)))
        m.slide("pitch", (0, 1, 0), (-0.04, 0.04))
    else:
        knob(m, "speed", (wide - 0.03, 0.04, high), (0, 0, 1), 0.013)
    if m.chance(0.7):
        lid = box((0, wide), (0, deep), (high + 0.001, high + 0.07))
        thin = m.pick(0.003, 0.01)
        m.add("lid", cut(lid, box((thin, wide - thin), (thin, deep - thin), (0, high + 0.07 - thin))))
        m.hinge("lid", (wide / 2, deep, high), (-1, 0, 0), m.pick(60, 80))
        if m.chance(0.5):
            m.add(
                m.pick(BASE, "lid"),
                *(box((x, x + 0.03), (deep, deep + 0.012), (high - 0.02, high + 0.02)) for x in (0.2 * wide, 0.75 * wide)),
            )


def camera(m: Model) -> None:
    """A body with a lens whose rings turn, a dial, a release, a flash or screen that opens, a battery door."""
    wide, high, deep, n = m.number(0.11, 0.15), m.number(0.07, 0.1), m.number(0.035, 0.06), m.pick(16, 24, 32)
    m.add(BASE, prism(rounded((0, wide), (0, high), m.pick(0.003, 0.012)), "y", (0, deep)))
    x, z, r = m.pick(0.45, 0.55) * wide, 0.48 * high, m.number(0.024, 0.033)
    hump = m.chance(0.6)
    if hump:
        m.add(
            BASE,
            prism(
                [(x - 0.025, high), (x + 0.025, high), (x + 0.014, high + 0.022), (x - 0.014, high + 0.022)], "y", (0.0, deep)
            ),
        )
    m.add(BASE, box((0, 0.22 * wide), (-0.012, 0.001), (0, 0.95 * high)))
    at = vec(x, 0, z)
    y = 0.0
    m.add(BASE, rod(at, at + vec(0, -0.01, 0), 1.1 * r, n))
    rings = m.pick(1, 2, 3)
    m.add(BASE, rod(at, at + vec(0, -0.01 - 0.024 * rings, 0), 0.85 * r, n))
    for k in range(rings):
        y = -0.011 - 0.024 * k
        edges = rod(at + vec(0, y, 0), at + vec(0, y - 0.021, 0), r, n)
        m.add(f"ring_{k}", cut(edges, rod(at + vec(0, 1, 0), at + vec(0, -1, 0), 0.86 * r, n)))
        ribs = np.linspace(0, 2 * np.pi, m.pick(12, 20), endpoint=False)
        outs = [r * vec(np.cos(t), 0, np.sin(t)) for t in ribs]
        m.add(f"ring_{k}", *(rod(at + o + vec(0, y - 0.004, 0), at + o + vec(0, y - 0.017, 0), 0.0015, 5) for o in outs))
        m.spin(f"ring_{k}", at + vec(0, y, 0), (0, -1, 0))
    if m.chance(0.5):
        front = at + vec(0, -0.012 - 0.024 * rings, 0)
        m.add("cap", rod(front, front + vec(0, -0.006, 0), 0.95 * r, n))
        m.slide("cap", (0, -1, 0), 0.04)
    knob(m, "dial", (0.85 * wide, deep / 2, high), (0, 0, 1), 0.009, style="fluted")
    button(m, "release", (0.08 * wide, 0.08 * wide + 0.01), (0.01, 0.02), high, 0.004, style="disc")
    if hump and m.chance(0.5):
        m.add("flash", box((x - 0.013, x + 0.013), (-0.008, 0.6 * deep), (high + 0.0225, high + 0.032)))
        m.hinge("flash", (x, 0.6 * deep, high + 0.0225), (-1, 0, 0), 60)
    else:
        m.add(BASE, box((x - 0.01, x + 0.01), (0.2 * deep, 0.7 * deep), (high, high + 0.004 + 0.02 * hump)))
    if m.chance(0.7):
        m.add("screen", box((0.15 * wide, 0.75 * wide), (deep + 0.001, deep + 0.008), (0.12 * high, 0.85 * high)))
        if m.chance(0.5):
            m.hinge("screen", (0.75 * wide, deep + 0.001, z), (0, 0, -1), 160)
        else:
            m.hinge("screen", (0.45 * wide, deep + 0.001, 0.12 * high), (-1, 0, 0), 90)
        m.add(BASE, ring((0.88 * wide, deep, 0.4 * high), (0, 1, 0), 0.008, 0.002, 16))
    if m.chance(0.5):
        m.add("battery", box((0.05 * wide, 0.35 * wide), (0.006, deep - 0.006), (-0.002, -0.0001)))
        m.hinge("battery", (0.05 * wide, deep / 2, -0.001), (0, 1, 0), 90)
    for side in (0.0, wide):
        m.add(BASE, ring((side, deep / 2, 0.85 * high), (0, 1, 0), 0.004, 0.001, 10))


def monitor(m: Model) -> None:
    """A screen on a foot: it tilts, and may turn, rise and pivot upright; or a foot of fixed legs."""
    wide, thick = m.number(0.45, 0.9), m.number(0.02, 0.06)
    high, z = wide * m.pick(0.56, 0.62, 0.42), m.number(0.3, 0.42)
    low, n = z - high / 2, m.sections()
    if low < 0.06:
        z, low = high / 2 + 0.08, 0.08
    foot = m.pick("plate", "disc", "vee")
    if foot == "plate":
        m.add(BASE, prism(rounded((-0.13, 0.13), (-0.06, 0.14), 0.02), "z", (0, 0.012)))
    elif foot == "disc":
        m.add(BASE, rod((0, 0.06, 0), (0, 0.06, 0.015), 0.13, 28))
    else:
        m.add(BASE, *(beam((0, 0.1, 0.012), (s * 0.22, -0.08, 0.012), 0.03, 0.02, (0, 0, 1)) for s in (-1, 1)))
    parent = BASE
    if m.chance(0.4):
        parent = "swivel"
        m.add(parent, rod((0, 0.08, 0.012), (0, 0.08, 0.025), 0.06, 20))
        m.spin(parent, (0, 0.08, 0.012), (0, 0, 1))
    rises = m.chance(0.5)
    m.add(parent, box((-0.03, 0.03), (0.06, 0.1), (0.01, z - 0.02 if rises else z)))
    if rises:
        m.add("carriage", box((-0.036, 0.036), (0.045, 0.105), (z - 0.06, z + 0.04)))
        m.slide("carriage", (0, 0, 1), (-min(0.1, low - 0.03), 0.08), parent)
        parent = "carriage"
    pivot = vec(0, 0.05, z)
    m.add(parent, rod(pivot - vec(0.03, 0, 0), pivot + vec(0.03, 0, 0), 0.014, n))
    m.add(
        "head", box((-0.02, 0.02), (0.02, 0.05), (z - 0.02, z + 0.02)), box((-0.06, 0.06), (0.01, 0.022), (z - 0.06, z + 0.06))
    )
    m.hinge("head", pivot, (-1, 0, 0), (-5, 25), parent)
    body, face = "head", 0.01 - thick
    if m.chance(0.4):
        body = "screen"
        m.hinge(body, (0, 0.01, z), (0, 1, 0), (0, 90), "head")
    back = rounded((-wide / 2, wide / 2), (low, low + high), 0.01)
    m.add(body, prism(back, "y", (face + 0.004, 0.01)))
    bezel = rectangle((-wide / 2, wide / 2), (low, low + high), (0.01, 0.01, 0.02, 0.01))
    m.add(
        body,
        prism(bezel, "y", (face, face + 0.004)),
        sheet((-wide / 2 + 0.01, wide / 2 - 0.01), face + 0.003, (low + 0.02, low + high - 0.01)),
    )
    for k in range(m.pick(0, 3, 5)):
        x = wide / 2 - 0.03 - 0.02 * k
        m.add(f"key_{k}", box((x - 0.006, x + 0.006), (face + 0.005, face + 0.01), (low - 0.003, low + 0.001)))
        m.slide(f"key_{k}", (0, 0, 1), 0.002, body)
    if m.chance(0.4):
        m.add(
            body,
            box((-0.03, 0.03), (face, 0.0), (low + high, low + high + 0.02)),
            rod((0, face - 0.004, low + high + 0.01), (0, face, low + high + 0.01), 0.006, 10),
        )
    m.add(BASE, tube([(0, 0.1, 0.05), (0.02, 0.18, 0.02), (0.08, 0.25, 0.004)], 0.004, 6))
