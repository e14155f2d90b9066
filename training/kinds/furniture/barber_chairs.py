"""Chairs of barbers, and the pads that other kinds share with them."""

from __future__ import annotations

from trimesh import Trimesh

from training.kinds.electronics.stands import swung
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, lathe

UP = vec(0, 0, 1)


def cushion(m: Model, x: Span, y: Span, z: Span, flat: str = "z") -> list[Trimesh]:
    """A pad: a box, one with round corners, with a piped edge, or of strips."""
    spans = {"x": (y, z), "y": (x, z), "z": (x, y)}[flat]
    depth = {"x": x, "y": y, "z": z}[flat]
    r = 0.25 * min(spans[0][1] - spans[0][0], spans[1][1] - spans[1][0])
    style = m.pick("box", "round", "round", "board")
    if style == "box":
        return [box(x, y, z)]
    if style == "round":
        return [prism(rounded(*spans, 0.6 * r), flat, depth)]
    cuts = 0.3 * (depth[1] - depth[0])
    inner = shrunk(spans[0], 0.01), shrunk(spans[1], 0.01)
    return [
        prism(rounded(*spans, 0.5 * r), flat, (depth[0] + cuts, depth[1])),
        prism(rounded(*inner, 0.4 * r), flat, (depth[0], depth[0] + cuts)),
    ]


def barber_chair(m: Model) -> None:
    """A chair that turns and rises on a pedestal; its back reclines, its leg rest swings up, its head rest slides."""
    n, wide, deep = m.pick(16, 24, 32), m.number(0.48, 0.6), m.number(0.46, 0.54)
    foot, seat = m.number(0.27, 0.36), m.number(0.46, 0.54)
    if m.chance(0.75):
        m.add(BASE, lathe([(0, 0), (foot, 0), (foot, 0.02), (0.35 * foot, 0.07), (0.09, 0.11), (0.09, 0.24), (0, 0.24)], n))
    else:
        m.add(BASE, prism(rounded((-foot, foot), (-foot, foot), 0.06), "z", (0, 0.03)), rod((0, 0, 0.03), (0, 0, 0.24), 0.1, n))
    m.add("lift", rod((0, 0, 0.12), (0, 0, seat - 0.13), 0.06, n), rod((0, 0, seat - 0.15), (0, 0, seat - 0.13), 0.11, n))
    m.slide("lift", UP, m.number(0.12, 0.18))
    x, y, z = (-wide / 2, wide / 2), (-deep / 2, deep / 2), (seat - 0.1, seat)
    m.add("seat", box(shrunk(x, 0.04), shrunk(y, 0.03), (seat - 0.13, seat - 0.09)), *cushion(m, shrunk(x, 0.005), y, z))
    m.spin("seat", (0, 0, seat - 0.13), UP, "lift")
    _barber_arms(m, x, y, seat)
    _barber_back(m, x, y, seat)
    _barber_legs(m, x, y, seat)
    if m.chance(0.8):
        s = m.pick(-1, 1)
        at = vec(s * 0.08, 0.03, 0.17)
        end = at + vec(s * m.number(0.18, 0.26), 0.1, 0.09)
        m.add("pedal", rod(at, end, 0.011, 8), rod(end - vec(s * 0.02, 0, 0), end + vec(s * 0.08, 0.03, 0.0), 0.018, 10))
        m.hinge("pedal", at, (0, s, 0), m.number(18, 28))


def _barber_arms(m: Model, x: Span, y: Span, seat: float) -> None:
    """Arm rests on the seat: loops of tube, closed cheeks or posts with pads."""
    high, style = seat + m.number(0.2, 0.25), m.pick("loop", "cheek", "posts")
    for s in (-1, 1):
        a = s * (x[1] + 0.03)
        if style == "cheek":
            m.add("seat", prism(rounded(y, (seat - 0.12, high), 0.06), "x", (s * x[1], s * (x[1] + 0.05))))
        elif style == "loop":
            path = [
                (a, y[0] + 0.05, seat - 0.11),
                (a, y[0] + 0.01, high - 0.03),
                (a, y[0] + 0.06, high),
                (a, y[1] - 0.03, high),
                (a, y[1] - 0.02, seat - 0.11),
            ]
            m.add(
                "seat",
                tube(path, 0.015, 8),
                beam((s * 0.1, y[0] + 0.06, seat - 0.11), (a, y[0] + 0.06, seat - 0.11), 0.03, 0.02, (0, 1, 0)),
            )
            m.add("seat", beam((s * 0.1, y[1] - 0.03, seat - 0.11), (a, y[1] - 0.03, seat - 0.11), 0.03, 0.02, (0, 1, 0)))
        else:
            m.add(
                "seat",
                *(
                    box((s * (x[1] - 0.01), s * (x[1] + 0.03)), (b - 0.02, b + 0.02), (seat - 0.1, high))
                    for b in (y[0] + 0.1, y[1] - 0.08)
                ),
            )
        pad = sorted((a - s * 0.035, a + s * 0.035))
        m.add("seat", prism(rounded((pad[0], pad[1]), shrunk(y, 0.01), 0.02), "z", (high, high + m.number(0.025, 0.05))))


def _barber_back(m: Model, x: Span, y: Span, seat: float) -> None:
    """The back with its head rest, leaning a little at rest."""
    lean, tall, thick = m.number(4, 14), m.number(0.42, 0.58), m.number(0.07, 0.1)
    pivot, x_axis = vec(0, y[1], seat - 0.03), (-1, 0, 0)
    back, room = (y[1] - 0.01, y[1] + thick), shrunk(x, m.number(0.005, 0.03))
    solids = cushion(m, room, back, (seat + 0.015, seat + tall), "y")
    solids += [
        box((s * 0.12 - 0.02, s * 0.12 + 0.02), (back[1] - 0.02, back[1] + 0.012), (seat - 0.06, seat + 0.3)) for s in (-1, 1)
    ]
    if m.chance(0.4):
        solids.append(box(shrunk(room, 0.04), (back[1], back[1] + 0.015), (seat + 0.08, seat + tall - 0.06)))
    m.add("back", *(turned(s, x_axis, lean, pivot) for s in solids))
    m.hinge("back", pivot, x_axis, m.number(40, 75), "seat")
    if m.chance(0.85):
        top, w = seat + tall, m.number(0.11, 0.15)
        rest = cushion(m, (-w, w), (back[0] - 0.005, back[1] - 0.015), (top + 0.03, top + m.number(0.14, 0.2)), "y")
        rest += [box((-0.02, 0.02), (back[1] - 0.035, back[1] - 0.02), (top - 0.12, top + 0.08))]
        m.add("head_rest", *(turned(s, x_axis, lean, pivot) for s in rest))
        m.slide("head_rest", swung(UP, x_axis, lean), m.number(0.08, 0.13), "back")


def _barber_legs(m: Model, x: Span, y: Span, seat: float) -> None:
    """A leg rest that swings up with a foot plate, or a fixed bar for the feet."""
    pivot, low, style = vec(0, y[0] + 0.015, seat - 0.1), m.number(0.14, 0.18), m.pick("swings", "swings", "fixed")
    part, w = ("leg_rest" if style == "swings" else "seat"), 0.42 * (x[1] - x[0])
    lean, solids = m.number(10, 25), []
    front = y[0] - 0.02
    long = seat - 0.1 - low
    solids += [
        box((s * 0.5 * w - 0.012, s * 0.5 * w + 0.012), (front + 0.012, front + 0.04), (low, seat - 0.09)) for s in (-1, 1)
    ]
    if m.chance(0.7):
        solids += cushion(m, (-w, w), (front - 0.03, front + 0.012), (low + 0.3 * long, seat - 0.115), "y")
    plate = box((-0.8 * w, 0.8 * w), (front - 0.16, front + 0.03), (low - 0.006, low + 0.012))
    ribs = [
        box((-0.7 * w, 0.7 * w), (front - 0.14 + 0.03 * k, front - 0.128 + 0.03 * k), (low + 0.012, low + 0.017))
        for k in range(m.pick(0, 4))
    ]
    m.add(part, *(turned(s, (-1, 0, 0), lean, pivot) for s in solids))
    carrier = "foot_plate" if style == "swings" and m.chance(0.4) else part
    m.add(carrier, *(turned(s, (-1, 0, 0), lean, pivot) for s in (plate, *ribs)))
    if style == "swings":
        m.hinge("leg_rest", pivot, (-1, 0, 0), m.number(40, 65), "seat")
    if carrier == "foot_plate":
        at = swung(vec(0, front + 0.012, low), (-1, 0, 0), lean, pivot)
        m.hinge("foot_plate", at, (-1, 0, 0), 80, "leg_rest")
