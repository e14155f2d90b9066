"""Things for the pocket: knife, padlock, flashlight."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon

from training.kinds.electronics.controls import button
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, ring, rod, rounded, tube, vec
from training.kinds.wheels import lathe


def pocket_knife(m: Model) -> None:
    """Blades and tools side by side between scales, shut or half open."""
    long, wide, n = m.number(0.07, 0.11), m.number(0.015, 0.024), m.pick(3, 5, 8)
    outline = (
        rounded((0, long), (0, wide), 0.49 * wide, n)
        if m.chance(0.6)
        else Polygon([(0, 0), (long, 0.1 * wide), (long, 0.8 * wide), (0.5 * long, wide), (0, 0.9 * wide)])
    )
    count, each = m.pick(1, 2, 4), m.number(0.0022, 0.0035)
    x = 0.0
    m.add(BASE, prism(outline, "z", (-0.004, -0.0003)))
    solid = m.chance(0.3) and count == 1
    for k in range(count):
        z, left = (k * each + 0.0003, (k + 1) * each - 0.0003), k % 2 == 0 or count < 3
        pin = vec(0.12 * long if left else 0.88 * long, 0.5 * wide, z[0])
        reach, s = m.number(0.5, 0.72) * long, (1 if left else -1)
        form = m.pick("blade", "file", "hook") if k else "blade"
        y0, y1 = (0.5 * wide, 1.06 * wide)
        points = {
            "blade": [
                (0, y0 - 0.004),
                (0.85 * reach, y0 - 0.002),
                (reach, y0 + 0.3 * (y1 - y0)),
                (0.7 * reach, y1),
                (0.1 * reach, y1),
                (-0.004, y0 + 0.003),
            ],
            "file": [(0, y0 - 0.003), (reach, y0 - 0.002), (reach, 0.97 * y1), (0, 0.97 * y1)],
            "hook": [
                (0, y0 - 0.003),
                (0.8 * reach, y0),
                (0.8 * reach, y1),
                (0.7 * reach, y1),
                (0.65 * reach, 0.85 * y1),
                (0, y1),
            ],
        }[form]
        blade = prism(Polygon([(pin[0] + s * a, b) for a, b in points]).buffer(0), "z", z)
        opened = m.pick(0, 0, 0, 60, 175)
        turn = np.deg2rad(opened * s)
        c, d = np.cos(turn), np.sin(turn)
        blade.vertices = (blade.vertices - pin) @ np.array([[c, -d, 0], [d, c, 0], [0, 0, 1]]).T + pin
        m.add(f"tool_{k}", blade)
        m.hinge(f"tool_{k}", pin, (0, 0, s), (-opened, 178 - opened))
        x = z[1]
        m.add(BASE, box((0.1 * long, 0.9 * long), (0.02 * wide, 0.12 * wide), z))
    m.add(BASE, prism(outline, "z", (x + 0.0006, x + 0.0045)))
    if solid:
        m.add(BASE, ring((long, 0.5 * wide, 0), (0, 0, 1), 0.005, 0.0008, 14))
    m.add(BASE, *(rod((a * long, 0.5 * wide, -0.005), (a * long, 0.5 * wide, x + 0.005), 0.0016, 10) for a in (0.12, 0.88)))


def padlock(m: Model) -> None:
    """A body with a shackle that rises or swings, a keyhole cover, wheels of numbers."""
    wide, high, thick, n = m.number(0.035, 0.06), m.number(0.03, 0.06), m.number(0.012, 0.025), m.pick(6, 8, 12)
    body = (
        rounded((-wide / 2, wide / 2), (0, high), m.pick(0.002, 0.01))
        if m.chance(0.7)
        else Point(0, high / 2).buffer(0.55 * wide)
    )
    if body.bounds[3] > high:
        high = body.bounds[3]
    layers = m.pick(1, 1, 5)
    if layers == 1:
        m.add(BASE, prism(body, "y", (0, thick)))
    else:
        m.add(BASE, *(box((-wide / 2, wide / 2), (0, thick), (k * high / 5, (k + 0.93) * high / 5)) for k in range(5)))
    t, r = np.linspace(0, np.pi, 12), 0.33 * wide
    tall, y = m.number(0.4, 1.6) * r, thick / 2
    path = [
        (-r, y, high - 0.006),
        *((-r * np.cos(a), y, high + tall + r * np.sin(a)) for a in t),
        (r, y, high - 0.3 * m.pick(0.0, 0.02)),
    ]
    m.add("shackle", tube(path, m.number(0.08, 0.12) * wide, n))
    if m.chance(0.6):
        m.slide("shackle", (0, 0, 1), 0.014)
    else:
        m.hinge("shackle", (-r, y, high), (0, 0, 1), (0, 150))
    style = m.pick("cover", "wheels", "plain")
    if style == "cover":
        m.add(
            "cover",
            rod((0, -0.003, 0.3 * high), (0, -0.0002, 0.3 * high), 0.008, 12),
            box((-0.003, 0.003), (-0.003, -0.0002), (0.3 * high, 0.3 * high + 0.016)),
        )
        m.hinge("cover", (0, 0, 0.3 * high + 0.013), (0, 1, 0), (0, 100))
    elif style == "wheels":
        for k in range(m.pick(3, 4)):
            z = (0.12 + 0.18 * k) * high
            m.add(
                f"wheel_{k}",
                rod((-0.15 * wide, 0.002, z + 0.06 * high), (-0.15 * wide, 0.002, z - 0.06 * high), 0.008, m.pick(10, 16)),
            )
            m.spin(f"wheel_{k}", (-0.15 * wide, 0.002, z), (0, 0, 1))
    else:
        m.add(BASE, rod((0, -0.001, 0.3 * high), (0, 0, 0.3 * high), 0.006, 14))
    m.add(
        BASE,
        box((-0.3 * wide, 0.3 * wide), (-0.0008, 0.0), (0.55 * high, 0.75 * high))
        if style != "wheels"
        else rod((0, y, -0.001), (0, y, 0), 0.004, 10),
    )


def flashlight(m: Model) -> None:
    """A tube with a head that turns or slides, a sliding switch or push button, a tail cap, a clip that stays."""
    r, long, n = m.number(0.012, 0.022), m.number(0.08, 0.22), m.pick(12, 16, 24)
    big = m.number(1.05, 1.8) * r
    m.add(BASE, rod((0, 0, 0), (0, long, 0), r, n))
    m.add(BASE, *(ring((0, y, 0), (0, 1, 0), r, 0.0012, n) for y in np.linspace(0.6 * long, 0.9 * long, m.pick(1, 4, 8))))
    head = lathe(
        [(0.7 * big, 0.0), (big, 0.0), (big, 0.025), (r, 0.045), (0.8 * r, 0.045), (0.7 * big, 0.005), (0.7 * big, 0)], n
    )
    head.vertices = head.vertices[:, [0, 2, 1]] + (0, -0.046, 0)
    head.invert()
    m.add("head", head, rod((0, -0.044, 0), (0, -0.042, 0), 0.95 * big, n))
    m.spin("head", (0, 0, 0), (0, -1, 0)) if m.chance(0.6) else m.slide("head", (0, -1, 0), 0.015)
    y = m.number(0.15, 0.4) * long
    if m.chance(0.7):
        m.add(BASE, box((-0.4 * r, 0.4 * r), (y - 0.015, y + 0.018), (0.9 * r, 1.06 * r)))
        m.add(
            "switch",
            box((-0.35 * r, 0.35 * r), (y, y + 0.011), (1.0 * r, 1.25 * r)),
            *(box((-0.3 * r, 0.3 * r), (y + q, y + q + 0.001), (1.2 * r, 1.32 * r)) for q in (0.002, 0.005, 0.008)),
        )
        m.slide("switch", (0, -1, 0), 0.011)
    else:
        button(m, "switch", (-0.4 * r, 0.4 * r), (y - 0.4 * r, y + 0.4 * r), 0.97 * r, 0.003, style=m.pick("disc", "dome"))
    if m.chance(0.7):
        m.add("tail", rod((0, long + 0.0005, 0), (0, long + 0.016, 0), 1.04 * r, n))
        m.spin("tail", (0, long, 0), (0, 1, 0))
    if m.chance(0.5):
        m.add(
            BASE,
            box((-0.003, 0.003), (0.4 * long, 0.9 * long), (-r - 0.004, -r - 0.003)),
            box((-0.003, 0.003), (0.88 * long, 0.9 * long), (-r - 0.004, -0.9 * r)),
        )
