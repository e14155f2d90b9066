"""Light things on wheels: bicycle, scooter, wheelbarrow, shopping trolley, rover, tractor."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, loft, prism, rod, rounded, tube, vec
from training.kinds.wheels import beam, caster, lathe, upright, wheel_maker


def bicycle(m: Model) -> None:
    """A frame, a fork that steers, two wheels, cranks with pedals; perhaps a stand."""
    r, base, n = m.number(0.25, 0.36), m.number(0.9, 1.1), m.pick(6, 8, 12)
    rear, bracket = np.array([0, base, r]), np.array([0, base - 0.42, r - 0.05])
    seat, head = bracket + vec(0, 0.16, m.number(0.35, 0.5)), np.array([0, 0.17, r + 0.42])
    low = head + vec(0, -0.05, -0.14)
    step = m.chance(0.3)
    pairs = [(bracket, seat), (bracket, low), (head, low)] + ([] if step else [(seat - (0, 0, 0.05), head)])
    m.add(BASE, *(rod(a, b, 0.018, n) for a, b in pairs))
    for x in (-0.05, 0.05):
        end = rear + vec(x, 0, 0)
        m.add(BASE, rod(end, bracket, 0.01, 6), rod(end, seat, 0.009, 6))
    m.add(BASE, rod(bracket - (0.04, 0, 0), bracket + vec(0.04, 0, 0), 0.022, n))
    top = seat + vec(0, 0.05, 0.16)
    m.add(BASE, rod(seat, top, 0.013, n), ball(top + vec(0, 0.03, 0.02), (0.07, 0.14, 0.03), n))
    spokes = m.pick(("spoked",), ("spoked",), ("rim",), ("disc",))
    make = wheel_maker(m, spokes, 0.0)
    make("rear_wheel", rear, (1, 0, 0), r, 0.035)
    way = (head - low) / np.linalg.norm(head - low)
    front, bar = np.array([0, 0, r]), head + 0.1 * way
    crown = low - 0.03 * way
    m.add(
        "fork",
        rod(crown, bar, 0.014, n),
        box((-0.06, 0.06), (crown[1] - 0.02, crown[1] + 0.02), (crown[2] - 0.02, crown[2] + 0.01)),
    )
    m.add("fork", *(rod((x, crown[1], crown[2]), (x, 0, r), 0.01, n) for x in (-0.05, 0.05)))
    wide = m.number(0.22, 0.32)
    style = m.pick("flat", "swept", "drop")
    for s in (-1, 1):
        ends = {
            "flat": [(s * wide, 0, 0)],
            "swept": [(s * 0.7 * wide, -0.02, 0.06), (s * wide, 0.18, 0.06)],
            "drop": [(s * 0.7 * wide, -0.1, 0), (s * 0.7 * wide, -0.12, -0.1), (s * 0.7 * wide, 0, -0.13)],
        }
        m.add("fork", tube([bar, *(bar + e for e in ends[style])], 0.011, n))
    m.hinge("fork", low, way, (-70, 70))
    make("front_wheel", front, (1, 0, 0), r, 0.035, "fork")
    long = 0.16
    m.add(
        "crank",
        *upright(_chainring(m), (1, 0, 0), bracket + vec(0.05, 0, 0)),
        rod(bracket - (0.08, 0, 0), bracket + vec(0.08, 0, 0), 0.01, n),
    )
    for k, (s, dy) in enumerate(((-1, -long), (1, long))):
        pedal = bracket + vec(s * 0.08, dy, 0)
        m.add(
            "crank", beam(bracket + vec(s * 0.075, 0, 0), pedal, 0.012, 0.02), rod(pedal, pedal + vec(s * 0.1, 0, 0), 0.005, 6)
        )
        m.add(
            f"pedal_{k}",
            box(
                (pedal[0] + s * 0.015, pedal[0] + s * 0.1),
                (pedal[1] - 0.04, pedal[1] + 0.04),
                (pedal[2] - 0.012, pedal[2] + 0.012),
            ),
        )
        m.spin(f"pedal_{k}", pedal, (1, 0, 0), "crank")
    m.spin("crank", bracket, (1, 0, 0))
    if m.chance(0.4):
        a = bracket + vec(-0.04, 0.1, -0.02)
        m.add("stand", rod(a, a + vec(-0.03, 0.26, 0.02), 0.008, 6))
        m.hinge("stand", a, (-1, 0, 0), 75)
    if m.chance(0.4):  # a carrier and mudguard
        m.add(BASE, box((-0.06, 0.06), (base - 0.2, base + 0.2), (2 * r + 0.05, 2 * r + 0.06)))
        m.add(BASE, *(rod((x, base, r), (x, base + 0.1, 2 * r + 0.05), 0.005, 6) for x in (-0.055, 0.055)))


def _chainring(m: Model) -> list:
    return [
        lathe([(0.05, -0.003), (0.09, -0.003), (0.09, 0.003), (0.05, 0.003), (0.05, -0.003)], 20),
        beam((-0.08, 0, 0), (0.08, 0, 0), 0.015, 0.004, (0, 1, 0)),
    ]


def scooter(m: Model) -> None:
    """A deck with a column that folds, handlebars that steer, two or three wheels, a brake over the rear one."""
    r, long, deck, wide = m.number(0.05, 0.11), m.number(0.5, 0.75), m.number(0.07, 0.13), m.number(0.1, 0.16)
    front, back = -long / 2, long / 2
    outline = rounded((-wide / 2, wide / 2), (front, back), 0.3 * wide)
    m.add(BASE, prism(outline, "z", (deck, deck + m.pick(0.015, 0.04))))
    neck, pivot = np.array([0, front - 0.14, deck + 0.2]), np.array([0, front + 0.02, deck + 0.05])
    folds = m.chance(0.7)
    stem = "stem" if folds else BASE
    m.add(BASE, *(box((s * 0.025, s * 0.035), (front - 0.02, front + 0.06), (deck, deck + 0.08)) for s in (-1, 1)))
    m.add(stem, beam(pivot, neck, 0.04, 0.03))
    up = np.array([0, 0.17, 1.0]) / np.hypot(0.17, 1.0)
    m.add(stem, rod(neck - 0.08 * up, neck + 0.06 * up, 0.026, m.sections()))
    if folds:
        m.hinge(stem, pivot, (-1, 0, 0), 75)
    tall, grip = m.number(0.55, 0.85), m.number(0.18, 0.28)
    top, n = neck + tall * up, m.sections()
    axle = np.array([0, neck[1] - 0.17 * (neck[2] - r) - 0.02, r])
    m.add(
        "column",
        rod(axle + vec(0, 0, r + 0.02), neck, 0.014, n),
        rod(neck, top, 0.016, n),
        rod(top - (grip, 0, 0), top + vec(grip, 0, 0), 0.013, n),
    )
    m.add("column", *(rod(top + vec(s * 0.6 * grip, 0, 0), top + vec(s * grip, 0, 0), 0.019, n) for s in (-1, 1)))
    m.add("column", *(beam(axle + vec(s * 0.03, 0, 0), axle + vec(s * 0.03, 0, r + 0.03), 0.006, 0.03) for s in (-1, 1)))
    m.add("column", box((-0.033, 0.033), (axle[1] - 0.015, axle[1] + 0.015), (2 * r + 0.015, 2 * r + 0.03)))
    m.hinge("column", neck, up, (-80, 80), stem)
    make = wheel_maker(m, ("disc", "rim", "tyre"), 0.0)
    make("front_wheel", axle, (1, 0, 0), r, 0.03, "column")
    ends = (-0.05, 0.05) if m.chance(0.3) else (0,)
    for k, x in enumerate(ends):
        make(f"rear_wheel_{k}", (x, back + r, r), (1, 0, 0), r, 0.03)
    reach = max(ends) + 0.022
    m.add(BASE, *(beam((s * reach, back - 0.03, deck), (s * reach, back + r + 0.01, r), 0.008, 0.03) for s in (-1, 1)))
    if m.chance(0.6):
        m.add("brake", beam((0, back + 0.005, deck + 0.04), (0, back + 1.4 * r, 2 * r + 0.03), 0.05, 0.008))
        m.hinge("brake", (0, back + 0.005, deck + 0.04), (-1, 0, 0), 12)
    if m.chance(0.4):
        m.add("stand", rod((-wide / 2, 0, deck), (-wide / 2 - 0.01, 0.12, deck - 0.0), 0.006, 6))
        m.hinge("stand", (-wide / 2, 0, deck), (-1, 0, 0), 70)


def wheelbarrow(m: Model) -> None:
    """A tray on two shafts with legs, one wheel or two."""
    r, long, half, n = m.number(0.15, 0.22), m.number(0.7, 0.95), m.number(0.27, 0.36), m.pick(6, 8, 12)
    z = 2 * r + 0.06
    rect = lambda a, b, y0, y1, h: [(-a, y0, h), (a, y0, h), (b, y1, h), (-b, y1, h)]  # noqa: E731
    rings = [rect(0.6 * half, 0.75 * half, 0.15, long - 0.1, z), rect(half, half, -0.1, long, z + m.number(0.2, 0.32))]
    if m.chance(0.5):
        rings += [
            [(0.95 * x, 0.95 * y + 0.02, h) for x, y, h in rings[1]],
            [(0.95 * x, 0.95 * y + 0.02, h + 0.02) for x, y, h in rings[0]],
        ]
        m.add(BASE, loft(np.array(rings)))
    else:
        m.add(BASE, loft(np.array(rings[::-1]), caps=False), loft(np.array([rings[0], np.array(rings[0]) + vec(0, 0, 0.004)])))
    if m.chance(0.5):
        m.add(BASE, tube([*rings[1], rings[1][0]], 0.012, 6))
    double = m.chance(0.3)
    for s in (-1, 1):
        path = [
            (s * 0.07, -0.05, r),
            (s * 0.6 * half, 0.3, z - 0.02),
            (s * 0.8 * half, long, z),
            (s * half, long + 0.45, z + 0.12),
        ]
        m.add(BASE, tube(path, 0.016, n), rod(path[3], np.array(path[3]) - (0, 0.13, 0.035), 0.022, n))
        leg = [
            (s * 0.75 * half, long - 0.25, z),
            (s * 0.8 * half, long - 0.15, 0.01),
            (s * 0.8 * half, long - 0.0, 0.01),
            (s * 0.8 * half, long, z),
        ]
        m.add(BASE, tube(leg, 0.012, n))
    m.add(BASE, rod((-0.75 * half, long - 0.12, 0.15), (0.75 * half, long - 0.12, 0.15), 0.01, 6))
    make = wheel_maker(m)
    for k, x in enumerate((-0.13, 0.13) if double else (0,)):
        make(f"wheel_{k}", (x, -0.05, r), (1, 0, 0), r, 0.07)
    m.add(BASE, rod((-0.2 if double else -0.08, -0.05, r), (0.2 if double else 0.08, -0.05, r), 0.012, 8))


def shopping_trolley(m: Model) -> None:
    """A wire basket on a frame with casters, a flap or gate at the rear, a child seat that folds."""
    half, long, low, tall = m.number(0.22, 0.28), m.number(0.7, 0.95), m.number(0.45, 0.6), m.number(0.35, 0.5)
    top, thin = low + tall, 0.006
    wires, solid = m.pick(5, 8, 11), m.chance(0.3)
    side = [(-half, 0.0), (half, 0.0), (half, long), (-half, long)]
    inset = np.array([(0.7 * x, y + 0.1 * (y == 0)) for x, y in side])
    for k in range(3):  # front and two sides; the rear is the gate
        a, b = ((3, 0), (0, 1), (1, 2))[k]
        if solid:
            corners = [(*inset[a], low), (*inset[b], low), (*side[b], top), (*side[a], top)]
            m.add(BASE, Trimesh(corners, [[0, 1, 2], [0, 2, 3]], process=False))
        else:
            for t in np.linspace(0, 1, wires + 1):
                p = inset[a] + t * (inset[b] - inset[a])
                q = np.array(side[a]) + t * (np.array(side[b]) - side[a])
                m.add(BASE, rod((*p, low), (*q, top), 0.6 * thin, 5))
        for t in np.linspace(0, 1, 2 if solid else 4):
            p, q = inset + t * (np.array(side) - inset), low + t * tall
            m.add(BASE, rod((*p[a], q), (*p[b], q), thin, 6))
    m.add(BASE, *(rod((x, inset[0][1], low), (x, long, low), thin, 5) for x in np.linspace(inset[0][0], inset[1][0], wires)))
    m.add(BASE, *(rod((inset[0][0], y, low), (inset[1][0], y, low), thin, 5) for y in np.linspace(inset[0][1], long, 4)))
    for s in (-1, 1):
        m.add(
            BASE,
            tube(
                [(s * half, long + 0.08, top + 0.03), (s * 0.7 * half, long - 0.05, 0.18), (s * 0.7 * half, 0.0, 0.18)],
                0.012,
                6,
            ),
        )
        m.add(BASE, rod((s * 0.7 * half, 0.2, 0.18), (s * 0.7 * half, 0.25, low), 0.012, 6))
    m.add(BASE, rod((-half - 0.01, long + 0.08, top + 0.03), (half + 0.01, long + 0.08, top + 0.03), m.pick(0.014, 0.02), 10))
    r, swivel = 0.06, m.pick("all", "front", "none")
    for k, (x, y) in enumerate((x, y) for x in (-0.7 * half, 0.7 * half) for y in (0.03, long - 0.1)):
        caster(m, f"caster_{k}", (x, y, 0.15), r, swivel == "all" or (swivel == "front" and y < 0.1))
    hung = m.chance(0.7)
    gate = "gate" if hung else BASE
    edge = np.array([np.append(inset[2], low), np.append(inset[3], low), (-half, long, top), (half, long, top)])
    m.add(gate, tube([*edge, edge[0]], thin, 6))
    for t in np.linspace(0.1, 0.9, wires):
        m.add(gate, rod(edge[1] + t * (edge[0] - edge[1]), edge[2] + t * (edge[3] - edge[2]), 0.6 * thin, 5))
    if hung:
        m.hinge(gate, (0, long, top), (-1, 0, 0), 65)
    if m.chance(0.5):
        m.add("seat", box((-0.6 * half, 0.6 * half), (long - 0.03, long - 0.02), (low + 0.45 * tall, top - 0.05)))
        m.hinge("seat", (0, long - 0.025, low + 0.45 * tall), (1, 0, 0), 80)
