"""What flies, in parts or otherwise: half a wing, fins that turn as a whole, a helicopter."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from training.kinds.aircraft.aircraft import body, doors
from training.kinds.aircraft.wings import AFT, Control, Foil, fly, making, slanted
from training.kinds.model import BASE, Model
from training.kinds.solids import box, loft, rod, vec


def wing_panel(m: Model) -> None:
    """Half a wing alone: aileron, one or two flaps, perhaps a slat before it and a spoiler on it."""
    chord = m.number(0.8, 1.6)
    foil = slanted(
        np.zeros(3),
        m.number(2, 4),
        m.number(0, 35),
        m.number(-3, 8),
        (chord, chord * m.number(0.4, 1)),
        m.number(0.09, 0.15),
        0.015,
    )
    foil = replace(foil, points=m.pick(4, 7, 10))
    fold = m.number(0.4, 0.6)
    cut_at = m.number(0.68, 0.8)
    controls = [
        Control("aileron", (fold, m.number(0.85, 0.97)), cut_at, 25, 25),
        Control("flap", (m.pick(0.0, 0.08), fold), cut_at, 40, 0),
    ]
    fly(m, foil, making(m), controls)
    if m.chance(0.5):  # a plate that lies on the upper side and turns up about its front edge
        rim = [foil.at(s, c, 1.0) for s, c in ((0.15, 0.5), (fold - 0.05, 0.5), (fold - 0.05, 0.64), (0.15, 0.64))]
        up = 0.004 * chord * foil.normal
        m.add("spoiler", loft(np.array([[p + up for p in rim], [p + 3 * up for p in rim]])))
        along = rim[1] - rim[0]
        m.hinge("spoiler", rim[0] + up, along if np.cross(along, AFT) @ foil.normal > 0 else -along, 60)


def moving_fins(m: Model) -> None:
    """A body with fins that turn as a whole, each about a line across it."""
    radius, length, count = m.number(0.1, 0.2), m.number(1.5, 3), m.pick(3, 4, 6)
    skin = body(radius, length, -length / 2, m.pick(12, 16, 24))
    m.add(BASE, skin)
    chord, sweep = m.number(0.3, 0.5), m.number(10, 40)
    for k in range(count):
        turn = 2 * np.pi * k / count + (np.pi / 4 if count == 4 else 0)
        out, across = np.array([np.cos(turn), 0, np.sin(turn)]), np.array([-np.sin(turn), 0, np.cos(turn)])
        root = np.array([0, 0.22 * length, 0.05 * radius]) + 0.95 * radius * out
        tip = root + m.number(0.3, 0.5) * (out + np.tan(np.deg2rad(sweep)) * AFT)
        foil = Foil(root, tip, (chord, 0.5 * chord), 0.08, 0.0, across, 5)
        m.add(f"fin_{k}", foil.part((0.0, 1.0), (0.0, 1.0)))
        at = foil.at(0.0, 0.5, 0.0)
        m.add(f"fin_{k}", rod(at - 0.3 * radius * out, at + 0.05 * out, 0.02, 8))
        m.hinge(f"fin_{k}", at, out, (-25, 25))


def helicopter(m: Model) -> None:
    """A cabin with doors, a boom, a main rotor on a mast and a tail rotor."""
    size, n = m.number(0.8, 1.2), m.pick(10, 16, 24)
    skin = body(size, 5.5 * size, -1.8 * size, n)
    skin = doors(m, skin, size, -1.8 * size, 5.5 * size)
    mast = np.array([0, -0.2 * size, 1.15 * size])
    m.add(BASE, skin, rod(mast - vec(0, 0, 0.3), mast + vec(0, 0, 0.35 * size), 0.08 * size, 8))
    hub, blades, reach = mast + vec(0, 0, 0.4 * size), m.pick(2, 3, 4, 5), 4 * size
    m.add("rotor", rod(hub - vec(0, 0, 0.05 * size), hub + vec(0, 0, 0.1 * size), 0.15 * size, n))
    for k in range(blades):
        turn = 2 * np.pi * k / blades + 0.3
        along, wide = np.array([np.cos(turn), np.sin(turn), 0]), 0.12 * size * np.array([-np.sin(turn), np.cos(turn), 0])
        thin = np.array([0, 0, 0.015 * size])
        m.add(
            "rotor",
            loft(
                np.array(
                    [[hub + r * along + u * wide + v * thin for u, v in ((-1, 0), (0, 1), (1, 0), (0, -1))] for r in (0, reach)]
                )
            ),
        )
    m.spin("rotor", hub, (0, 0, 1))
    tail = np.array([0.45 * size, 3.5 * size, 0.7 * size])
    m.add(BASE, rod(tail - vec(0.4 * size, 0, 0), tail, 0.04 * size, 8))
    for k in range(2):
        m.add(
            "tail_rotor",
            box(
                (tail[0], tail[0] + 0.03),
                *((tail[i] - r * size, tail[i] + r * size) for i, r in zip((1, 2), ((0.7, 0.06), (0.06, 0.7))[k], strict=True)),
            ),
        )
    m.spin("tail_rotor", tail, (1, 0, 0))
    for s in (-1, 1):  # skids
        z, x = -1.6 * size, s * 0.9 * size
        m.add(BASE, rod((x, -1.5 * size, z), (x, 1.5 * size, z), 0.05 * size, 8))
        m.add(BASE, *(rod((0.5 * x, y * size, -0.9 * size), (x, y * size, z), 0.04 * size, 8) for y in (-0.7, 0.7)))
