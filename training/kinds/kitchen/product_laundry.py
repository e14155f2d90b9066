"""Things of the laundry room, by one artist: washer and dryer as a pair, steam iron with its station."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.product_style import FRONT, UP, Look, lathe, outline
from training.kinds.solids import Span, box, cut, loft, ring, rod, tube, vec


def washing_line_machine(m: Model) -> None:
    """A washer and a dryer side by side or stacked, perhaps one alone: portholes or top lids, drawers, dials, keys."""
    look = Look.of(m)
    wide, deep, high = m.number(0.55, 0.64), m.number(0.5, 0.62), m.number(0.8, 0.9)
    places = m.pick([(0.0, 0.0)], [(0.0, 0.0), (wide + 0.01, 0.0)], [(0.0, 0.0), (0.0, high + 0.01)])
    stacked = places[-1][1] > 0
    top_lid = not stacked and m.chance(0.3)
    for k, (left, low) in enumerate(places):
        name = "" if len(places) == 1 else ("_washer", "_dryer")[k]
        _machine(look, name, (left, left + wide), deep, (low + 0.015, low + high), top_lid, dryer=k == 1)
    if stacked:
        m.add(BASE, box((0.0, wide), (0.0, deep), (high - 0.002, high + 0.03)))
    elif len(places) == 2:
        m.add(BASE, box((0.0, 2 * wide + 0.01), (0.02, deep), (high - 0.002, high + m.pick(0.0, 0.03))))
    across = places[-1][0] + wide
    m.add(BASE, *(rod((a, b, 0), (a, b, 0.016), 0.02, 8) for a in (0.06, across - 0.06) for b in (0.06, deep - 0.06)))


def _machine(look: Look, name: str, x: Span, deep: float, z: Span, top_lid: bool, dryer: bool) -> None:
    """One machine with its front, its strip of controls and its door."""
    m, high = look.m, z[1] - z[0]
    strip, middle = m.number(0.1, 0.13), (x[0] + x[1]) / 2
    if top_lid:
        m.add(BASE, look.block(x, (0.0, deep), (z[0], z[1] - 0.02)))
        m.add(BASE, box((x[0], x[1]), (0.78 * deep, deep), (z[1] - 0.021, z[1] + 0.1)))
        lid = ((x[0] + 0.03, x[1] - 0.03), (0.03, 0.76 * deep), (z[1] - 0.0195, z[1] + 0.004))
        m.add(f"lid{name}", look.block(*lid))
        m.hinge(f"lid{name}", (middle, lid[1][1], lid[2][0]), (-1, 0, 0), m.pick(80, 95))
        row, out, size = 0.78 * deep, FRONT, 0.025
        for k, a in enumerate(np.linspace(x[0] + 0.1, x[1] - 0.1, m.pick(2, 3, 4))):
            look.dial(f"dial{name}_{k}", (a, row, z[1] + 0.05), out, size, 0.022)
        return
    r, at = m.number(0.15, 0.2), vec(middle, 0.0, z[0] + 0.52 * (high - strip))
    body = look.block(x, (0.0, deep), z)
    inside = look.style in ("parts", "soft", "sunk") and m.chance(0.7)
    if inside:
        body = cut(body, rod(at + vec(0, -1, 0), at + vec(0, 0.8 * deep, 0), 0.86 * r, 24))
        tub = [(0.84 * r, 0.0), (0.84 * r, -0.72 * deep), (0.8 * r, -0.72 * deep), (0.8 * r, -0.01)]
        m.add(
            f"drum{name}",
            lathe(
                [(0.6 * r, -0.74 * deep), *tub[1::-1], *tub[:1:-1], (0.5 * r, -0.7 * deep)], 24, at + vec(0, 0.012, 0), FRONT
            ),
        )
        m.spin(f"drum{name}", at, (0, 1, 0))
    m.add(BASE, body)
    _porthole(look, name, at, r, m.pick("disc", "disc", "square"), m.chance(0.65))
    face_z = z[1] - strip / 2
    if look.style != "sunk":
        m.add(BASE, box((x[0] + 0.01, x[1] - 0.01), (-0.004, 0.01), (z[1] - strip, z[1] - 0.012)))
    else:
        m.add(BASE, box((x[0] + 0.22, x[1] - 0.06), (-0.004, 0.01), (z[1] - 0.8 * strip, z[1] - 0.3 * strip)))
    if not dryer or m.chance(0.3):
        drawer = (x[0] + 0.02, x[0] + 0.18)
        m.add(f"drawer{name}", look.block(drawer, (-0.02, 0.002), (z[1] - 0.85 * strip, z[1] - 0.2 * strip), leave="y"))
        m.add(
            f"drawer{name}",
            box((drawer[0] + 0.01, drawer[1] - 0.01), (0.0, 0.3 * deep), (z[1] - 0.75 * strip, z[1] - 0.6 * strip)),
        )
        m.slide(f"drawer{name}", FRONT, 0.25 * deep)
    look.dial(f"dial{name}", (middle + m.pick(0.0, 0.08), -0.004, face_z), FRONT, 0.028, m.number(0.018, 0.03))
    for k, a in enumerate(np.linspace(middle + 0.14, x[1] - 0.04, m.pick(2, 3, 4))[: m.pick(0, 3, 4)]):
        look.key(f"key{name}_{k}", (a, -0.004, face_z), FRONT, (0.016, 0.016, 0.006))
    if m.chance(0.4):
        flap = ((x[1] - 0.17, x[1] - 0.04), (z[0] + 0.02, z[0] + 0.12))
        look.front(f"flap{name}", *flap, 0.0, 0.006)
        m.hinge(f"flap{name}", (flap[0][0], 0.0, flap[1][0]), (1, 0, 0), m.pick(80, 100))


def _porthole(look: Look, name: str, at: np.ndarray, r: float, shape: str, left: bool) -> None:
    """A round door with a glass bowl, or a square one with a round pane."""
    m, part, n = look.m, f"door{name}", 8 if look.style == "prop" else look.m.pick(16, 24, 32)
    thick, side = m.number(0.02, 0.045), -1 if left else 1
    if shape == "disc":
        rim = [(1.05 * r, 0.0), (1.05 * r, 0.6 * thick), (0.95 * r, thick), (0.75 * r, thick)]
        glass = [(0.75 * r, 0.5 * thick), (0.5 * r, 0.3 * thick)] if look.style != "prop" else []
        m.add(part, lathe(rim + glass, n, at, FRONT))
        if m.chance(0.5) and look.style not in ("prop", "sheet"):
            m.add(part, lathe([(0.72 * r, 0.02), (0.7 * r, -0.03), (0.4 * r, -0.06)], n, at, FRONT))
    else:
        half = 1.12 * r
        plate = loft(
            np.array([outline(*((a - half, a + half) for a in at[[0, 2]]), 0.05, h) for h in (0.0, 0.8 * thick, thick)])[
                :, :, [0, 2, 1]
            ]
        )
        plate.vertices[:, 1] *= -1
        plate.invert()
        m.add(part, plate, lathe([(0.7 * r, 0), (0.66 * r, 0.008)], n, at + vec(0, -thick, 0), FRONT))
    if m.chance(0.7):
        m.add(
            part,
            box(
                *(sorted((at[0] - side * 0.9 * r, at[0] - side * 1.0 * r))[k : k + 2] for k in (0,)),
                (-thick - 0.012, -0.4 * thick),
                (at[2] - 0.05, at[2] + 0.05),
            ),
        )
    m.add(BASE, ring(at, FRONT, 0.95 * r, 0.006, 16))
    edge = at + vec(side * (1.05 if shape == "disc" else 1.12) * r, 0, 0)
    m.hinge(part, edge, (0, 0, side), m.pick(100, 130, 150))


def steam_iron_station(m: Model) -> None:
    """A steam iron on its station or alone: a tank that pulls out, a lid, a dial, keys, a trigger; the iron lifts off."""
    look = Look.of(m)
    if m.chance(0.3):
        _iron(look, BASE, vec(0, 0, 0), alone=True)
        return
    w, long, high = m.number(0.1, 0.13), m.number(0.16, 0.2), m.number(0.09, 0.14)
    m.add(BASE, look.block((-w, w), (-long, long), (0.006, high)))
    m.add(BASE, *(rod((a, b, 0), (a, b, 0.008), 0.012, 8) for a in (-0.7 * w, 0.7 * w) for b in (-0.7 * long, 0.7 * long)))
    m.add(BASE, box((-0.75 * w, 0.75 * w), (-0.75 * long, 0.72 * long), (high - 0.001, high + 0.008)))
    m.add(BASE, box((-0.6 * w, 0.6 * w), (0.72 * long, 0.78 * long), (high - 0.002, high + 0.03)))
    _iron(look, "iron", vec(0, -0.02, high + 0.008), alone=False)
    m.slide("iron", UP, 0.1)
    count, z = m.pick(1, 2, 3), 0.55 * high
    look.dial("dial", (0.45 * w, -long, z), FRONT, 0.018, 0.014)
    for k in range(count):
        look.key(f"key_{k}", (-0.55 * w + 0.028 * k, -long, z), FRONT, (0.016, 0.016, 0.004))
    tank = m.pick("tank", "lid", "none")
    if tank == "tank":
        m.add("tank", look.block((-0.8 * w, 0.8 * w), (long + 0.0005, long + 0.06), (0.012, 0.9 * high)))
        m.add("tank", box((-0.3 * w, 0.3 * w), (long + 0.058, long + 0.07), (0.6 * high, 0.7 * high)))
        m.slide("tank", (0, 1, 0), 0.08)
    elif tank == "lid":
        m.add("lid", look.block((-0.6 * w, 0.6 * w), (0.82 * long, 0.99 * long), (high + 0.0005, high + 0.012)))
        m.hinge("lid", (0, 0.99 * long, high), (-1, 0, 0), m.pick(70, 90))
    if m.chance(0.5):
        path = [
            (0.9 * w, long - 0.004, 0.03),
            (0.9 * w, long + 0.12, 0.02),
            (1.3 * w, 0.8 * long, 0.015),
            (1.3 * w, -0.4 * long, 0.015),
        ]
        m.add(BASE, tube(path, 0.007, 8))
    if m.chance(0.4):
        m.add("bolt", box((-0.02, 0.02), (-long + 0.004, -long + 0.03), (high - 0.003, high + 0.012)))
        m.slide("bolt", (0, 1, 0), 0.012)


def _iron(look: Look, part: str, at: np.ndarray, alone: bool) -> None:
    """A sole, a body that narrows to the tip, a handle; a dial, a trigger or keys, a small lid for water."""
    m, n = look.m, look.n
    w, long, high = m.number(0.05, 0.062), m.number(0.12, 0.14), m.number(0.055, 0.08)
    half = np.array([(0.55, 1.0), (0.95, 0.9), (1.0, 0.4), (0.9, -0.2), (0.55, -0.75), (0.12, -1.0)])
    plan = np.concatenate([half, half[::-1] * (-1, 1)]) * (w, long)

    def level(size: float, z: float, shift: float = 0.0) -> np.ndarray:
        return np.c_[plan * size + (0, shift), np.full(len(plan), z)] + at

    m.add(part, loft(np.array([level(0.98, 0.0), level(1.0, 0.004), level(1.0, 0.008)])))
    m.add(
        part,
        loft(np.array([level(0.94, 0.008), level(0.92, 0.3 * high), level(0.6, 0.75 * high, 0.01), level(0.4, high, 0.025)])),
    )
    top, y0, y1 = at[2] + high + 0.06, at[1] - 0.45 * long, at[1] + 0.75 * long
    low = at[2] + 0.72 * high
    posts = [(0, y1, low - 0.02), (0, y1 + 0.005, top - 0.02), (0, y1 - 0.03, top), (0, y0 + 0.01, top - 0.005)]
    if look.style in ("prop", "sheet"):
        m.add(part, box((-0.014, 0.014), (y0, y1), (top - 0.022, top)))
        m.add(
            part,
            *(
                box((-0.012, 0.012), (b, b + 0.022), (low - 0.03, top - 0.021))
                for b in (y1 - 0.022, *[y0 + 0.015] * m.pick(0, 1))
            ),
        )
    else:
        closed = m.chance(0.6)
        m.add(
            part,
            tube(
                [*posts, *([(0, y0 - 0.01, top - 0.03), (0, y0 + 0.02, low - 0.012)] if closed else [])], 0.014, max(8, n // 2)
            ),
        )
    parent = part
    m.add("steam_key", rod((0, y0 + 0.03, top - 0.012), (0, y0 + 0.03, top + 0.006), 0.008, n))
    m.slide("steam_key", (0, 0, -1), 0.005, parent)
    if alone or m.chance(0.3):
        mid = (y0 + y1) / 2
        look.dial("temperature_dial", (0, mid, at[2] + 0.97 * high), UP, 0.02, 0.01, parent)
    if m.chance(0.5):
        m.add("trigger", box((-0.006, 0.006), (y0 + 0.045, y0 + 0.08), (top - 0.028, top - 0.012)))
        m.slide("trigger", UP, 0.005, parent)
    if alone and m.chance(0.6):
        y, z = at[1] - 0.52 * long, at[2] + 0.82 * high
        m.add("water_lid", box((-0.012, 0.012), (y - 0.01, y + 0.014), (z - 0.004, z + 0.005)))
        m.hinge("water_lid", (0, y + 0.014, z + 0.003), (-1, 0, 0), 80, parent)
    if alone and m.chance(0.6):
        m.add(part, tube([(0, y1 - 0.005, low), (0, y1 + 0.06, low + 0.01), (0.05, y1 + 0.12, at[2] + 0.006)], 0.005, 6))
