"""Flight cases."""

from __future__ import annotations

from training.kinds.containers.cartons import shell
from training.kinds.containers.cases import drop_handle
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import trims
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, ring, rod


def _edges(m: Model, part: str, x: Span, y: Span, z: Span, w: float, corners: tuple[float, ...]) -> None:
    """Metal edges round a box, and balls or blocks on its corners at the heights given."""
    o, out = 0.003, (shrunk(x, -0.003), shrunk(y, -0.003))
    m.add(part, *(prism(rectangle(*out, 2 * o), "z", s) for s in ((z[0], z[0] + w), (z[1] - w, z[1]))))
    for a, s in ((x[0], 1), (x[1], -1)):
        for b, t in ((y[0], 1), (y[1], -1)):
            m.add(part, box((a - s * o, a + s * w), (b - t * o, b + t * w), (z[0] + w, z[1] - w)))
    style, r = m.pick("ball", "block", "none"), 0.9 * w
    for c in corners:
        for a in x:
            for b in y:
                if style == "ball":
                    m.add(part, ball((a, b, c), (r, r, r), 8))
                elif style == "block":
                    m.add(part, box((a - 0.7 * r, a + 0.7 * r), (b - 0.7 * r, b + 0.7 * r), (c - 0.7 * r, c + 0.7 * r)))


def _butterfly(m: Model, name: str, upper: str, x: float, front: float, z: float) -> None:
    """A butterfly latch on the front over the seam: plates on both halves, a key that turns."""
    w, t = m.number(0.04, 0.055), 0.004
    m.add(BASE, prism(rectangle((x - w, x + w), (z - 0.065, z - 0.002), 0.01), "y", (front - t, front)))
    m.add(upper, prism(rectangle((x - w, x + w), (z + 0.002, z + 0.04), 0.01), "y", (front - t, front)))
    m.add(upper, box((x - 0.015, x + 0.015), (front - 2 * t, front), (z + 0.008, z + 0.016)))
    at = z - 0.03
    m.add(name, rod((x, front - 2.6 * t, at), (x, front, at), 0.012, 12))
    m.add(name, box((x - 0.85 * w, x + 0.85 * w), (front - 2.6 * t, front - 2 * t), (at - 0.007, at + 0.007)))
    for s in (-1, 1):
        m.add(name, ring((x + s * 0.6 * w, front - 2.3 * t, at), (0, 1, 0), 0.012, 0.003, 12))
    m.hinge(name, (x, front - t, at), (0, -1, 0), m.pick(90, 180))


def _wheels(m: Model, x: Span, y: Span, high: float) -> None:
    """Casters: forks, and wheels that turn or not."""
    rolls, r, k = m.chance(0.5), 0.36 * high, 0
    for a in shrunk(x, 0.07):
        for b in shrunk(y, 0.07):
            part = f"wheel_{k}" if rolls else BASE
            m.add(part, rod((a - 0.013, b, r), (a + 0.013, b, r), r, 12))
            m.add(BASE, box((a - 0.035, a + 0.035), (b - 0.035, b + 0.035), (high - 0.006, high)))
            m.add(
                BASE,
                *(box((c - 0.003, c + 0.003), (b - 0.5 * r, b + 0.5 * r), (r - 0.4 * r, high)) for c in (a - 0.018, a + 0.018)),
            )
            if rolls:
                m.spin(part, (a, b, r), (1, 0, 0))
            k += 1


def flight_case(m: Model) -> None:
    """A case for stage gear: a lid that hinges or lifts off, or covers before a rack; butterfly latches, handles, wheels."""
    style, wheels = m.pick("hinged", "lift", "rack"), m.chance(0.5)
    wide, deep, foot, w = m.number(0.5, 1.1), m.number(0.4, 0.6), 0.12 if wheels else 0.0, m.number(0.02, 0.03)
    if style == "rack":
        wide = 0.55
    high = m.number(0.3, 0.6)
    x, y, z, t = (-wide / 2, wide / 2), (-deep / 2, deep / 2), (foot, foot + high), 0.01
    if style == "rack":
        _rack(m, x, y, z, w)
    else:
        shell(m, BASE, x, y, z, t)
        _edges(m, BASE, x, y, z, w, (z[0],))
        g, rise = m.pick(0.0, 0.002), m.number(0.08, 0.25)
        shell(m, "lid", x, y, (z[1] + g, z[1] + rise), t, -1)
        _edges(m, "lid", x, y, (z[1] + g, z[1] + rise), w, (z[1] + rise,))
        if style == "hinged":
            m.add(
                BASE, *(box((c - 0.03, c + 0.03), (y[1], y[1] + 0.006), (z[1] - 0.05, z[1])) for c in (0.6 * x[0], 0.6 * x[1]))
            )
            m.hinge("lid", (0, y[1] + 0.005, z[1]), (-1, 0, 0), m.pick(90, 100, 110))
        else:
            m.slide("lid", (0, 0, 1), m.number(0.6, 0.95) * high)
        for k, c in enumerate(m.pick((0.0,), (-0.3, 0.3), (-0.33, 0.33))):
            _butterfly(m, f"latch_{k}", "lid", c * wide, y[0] - 0.003, z[1])
        _foam(m, shrunk(x, t), shrunk(y, t), (foot + t, z[1]))
        if m.chance(0.4):
            m.add(
                "lid",
                *(
                    rod((a, b, z[1] + rise), (a, b, z[1] + rise + 0.006), 0.05, 12)
                    for a in shrunk(x, 0.1)
                    for b in shrunk(y, 0.1)
                ),
            )
    still = m.chance(0.25)
    for name, s in (("handle_left", -1), ("handle_right", 1)):
        drop_handle(m, name, s, s * wide / 2, foot + 0.6 * high, m.number(0.08, 0.11), still)
    if wheels:
        _wheels(m, x, y, foot)
    trims(m, BASE, (0.5 * x[0], 0.5 * x[1]), y[0], (foot + 0.1 * high, foot + 0.6 * high), 1 if style != "rack" else 0)


def _foam(m: Model, x: Span, y: Span, z: Span) -> None:
    """Foam with a bed for the load, compartments, or nothing."""
    fill, top = m.pick("foam", "walls", "none"), z[0] + m.number(0.5, 0.95) * (z[1] - z[0])
    if fill == "foam":
        beds = [
            box((0.8 * x[0], 0.1 * x[1]), (0.7 * y[0], 0.7 * y[1]), (z[0] + 0.05, 2)),
            rod((0.5 * x[1], 0, z[0] + 0.08), (0.5 * x[1], 0, 2), 0.08, 12),
        ]
        m.add(BASE, cut(box(x, y, (z[0], top)), *beds))
    elif fill == "walls":
        m.add(BASE, box((-0.006, 0.006), y, (z[0], top)), box((0.006, x[1]), (-0.006, 0.006), (z[0], top)))


def _rack(m: Model, x: Span, y: Span, z: Span, w: float) -> None:
    """A tube of boards with units screwed to its rails, and covers that pull off its front and perhaps its back."""
    t, c = 0.01, 0.07
    m.add(BASE, prism(rectangle(x, z, t), "y", y))
    for b in (y[0], y[1] - w):
        m.add(BASE, prism(rectangle(shrunk(x, -0.003), shrunk(z, -0.003), 0.006), "y", (b, b + w)))
    back = m.chance(0.5)
    if not back:
        m.add(BASE, box(shrunk(x, t), (y[1] - t, y[1]), shrunk(z, t)))
    inner, level = shrunk(x, t + 0.005), z[0] + t + 0.004
    while level < z[1] - 0.06:
        high = m.pick(0.0445, 0.089)
        if level + high < z[1] - t:
            face = y[0] + 0.03
            m.add(BASE, box(inner, (face, face + 0.004), (level, level + high - 0.002)))
            m.add(BASE, box(shrunk(inner, 0.02), (face, 0.3 * y[1]), (level + 0.004, level + high - 0.006)))
            for k in range(m.pick(0, 2, 5)):
                a = inner[0] + 0.08 + 0.07 * k
                m.add(BASE, rod((a, face - 0.015, level + 0.02), (a, face, level + 0.02), 0.009, 10))
        level += high
    for name, on, s in (("front_cover", y[0], -1), ("back_cover", y[1], 1))[: 2 if back else 1]:
        far = on + s * c
        m.add(name, cut(box(x, (on, far), z), box(shrunk(x, t), (on - s, far - s * t), shrunk(z, t))))
        m.add(name, prism(rectangle(shrunk(x, -0.003), shrunk(z, -0.003), 0.006), "y", (far, far - s * w)))
        m.add(name, *(ball((a, far, h), (0.9 * w,) * 3, 8) for a in x for h in z))
        m.slide(name, (0, s, 0), m.number(0.3, 0.6) * (y[1] - y[0]))
        k = 0 if s < 0 else 2
        for a, side in ((x[0], -1), (x[1], 1)):
            at, out = z[0] + 0.5 * (z[1] - z[0]), a + side * 0.004
            m.add(BASE, box((a, out), (on - s * 0.06, on - s * 0.003), (at - 0.05, at + 0.05)))
            m.add(name, box((a, out), (on + s * 0.003, on + s * 0.04), (at - 0.04, at + 0.04)))
            hub = on - s * 0.03
            m.add(f"latch_{k}", rod((a, hub, at), (a + side * 0.01, hub, at), 0.012, 10))
            m.add(f"latch_{k}", box((a + side * 0.008, a + side * 0.012), (hub - 0.006, hub + 0.006), (at - 0.04, at + 0.04)))
            m.hinge(f"latch_{k}", (a, hub, at), (side, 0, 0), m.pick(90, 180))
            k += 1
