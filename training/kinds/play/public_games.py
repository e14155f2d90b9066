"""Arcade cabinets and parking meters."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, lathe, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, middle
from training.kinds.solids import Span, arch, ball, box, prism, rectangle, ring, rod, rounded, turned, vec


def _stick(m: Model, part: str, at: np.ndarray, n: np.ndarray) -> None:
    """A joystick that tilts to and from the player: a ball, a bat or a grip with a trigger on a shaft."""
    high, style = m.number(0.06, 0.09), m.pick("ball", "ball", "bat", "grip")
    m.add(part, rod(at - 0.01 * n, at + high * n, 0.006, 8))
    m.add(m.pick(part, BASE), rod(at, at + 0.004 * n, 0.025, 16))
    if style == "ball":
        m.add(part, ball(at + high * n, (0.019,) * 3, 12))
    else:
        m.add(part, rod(at + 0.3 * high * n, at + 1.3 * high * n, 0.013 if style == "bat" else 0.018, 12))
    if style == "grip":
        m.add(part, box(*np.c_[at + high * n - (0.006, 0.03, 0.008), at + high * n + (0.006, -0.014, 0.008)]))
    m.hinge(part, at, (1, 0, 0), (-m.number(12, 22), m.number(12, 22)))


def _controls(m: Model, x: Span, a: np.ndarray, b: np.ndarray) -> None:
    """What a player holds on a panel from a line a to a line b (points at x = 0): sticks or a wheel, and buttons."""
    n = np.cross((1, 0, 0), (b - a) / np.linalg.norm(b - a))
    players, wheel = (m.pick(1, 2) if x[1] - x[0] > 0.5 else 1), m.chance(0.2)
    if wheel:
        at, n = 0.5 * (a + b), np.array((0, -0.8, 0.6))
        hub = at + 0.15 * n
        m.add(BASE, rod(at - 0.03 * n, hub, 0.02, 12))
        m.add("wheel", ring(hub, n, 0.12, 0.013, 20), rod(hub - 0.012 * n, hub + 0.012 * n, 0.03, 12))
        m.add(
            "wheel",
            *(
                box((min(0, c), max(0, c)), (hub[1] - 0.006, hub[1] + 0.006), (hub[2] - 0.01, hub[2] + 0.01))
                for c in (-0.12, 0.12)
            ),
        )
        m.spin("wheel", hub, n)
    count = 0
    for k in range(0 if wheel else players):
        left = x[0] + (k + 0.22) * (x[1] - x[0]) / players
        _stick(m, f"stick_{k}", 0.5 * (a + b) + vec(left, 0, 0), n)
        for i in range(m.pick(2, 3, 6)):
            at = a + (0.6 - 0.3 * (i // 3)) * (b - a) + vec(left + 0.075 + 0.04 * (i % 3), 0, 0)
            m.add(BASE, rod(at, at + 0.003 * n, 0.017, 12))
            m.add(f"button_{count}", rod(at, at + 0.01 * n, 0.013, 12))
            m.slide(f"button_{count}", -n, 0.006)
            count += 1
    for k in range(m.pick(0, 1, 2)):
        at = a + 0.9 * (b - a) + vec((k - 0.5) * 0.05, 0, 0)
        m.add(f"start_{k}", rod(at, at + 0.008 * n, 0.01, 10))
        m.slide(f"start_{k}", -n, 0.005)


def _coin_door(m: Model, part: str, x: Span, y: float, z: Span) -> None:
    """A steel door with coin slots, reject buttons and a lock, in a fixed frame."""
    m.add(BASE, prism(rectangle(shrunk(x, -0.02), shrunk(z, -0.02), 0.018), "y", (y - 0.012, y + 0.001)))
    m.add(part, box(x, (y - 0.01, y + 0.004), z))
    c, side = middle(x), m.pick("left", "right")
    for k, a in enumerate(m.pick((c,), (c - 0.06, c + 0.06))):
        top = z[1] - 0.25 * (z[1] - z[0])
        m.add(part, box((a - 0.025, a + 0.025), (y - 0.016, y - 0.01), (top - 0.05, top + 0.04)))
        button(m, f"reject_{k}", (a, y - 0.016, top), (0, -1, 0), 0.02, part)
        m.add(part, box((a - 0.025, a + 0.025), (y - 0.013, y - 0.01), (z[0] + 0.03, z[0] + 0.08)))
    m.add(
        part,
        rod(
            (x[1] - 0.02 if side == "left" else x[0] + 0.02, y - 0.016, middle(z)),
            (x[1] - 0.02 if side == "left" else x[0] + 0.02, y - 0.01, middle(z)),
            0.01,
            12,
        ),
    )
    hang(m, part, x, (y - 0.01, y + 0.004), z, side, OUT, m.number(95, 120))


def _arcade_line(m: Model, style: str, high: float, deep: float) -> tuple[list[tuple[float, float]], float]:
    """The side view (y, z) of a cabinet from its front foot up and round, with 9 points from the panel on; what is cut off."""
    f, p, s = m.number(0.08, 0.18), m.number(0.84, 0.95), m.number(0.25, 0.32)
    low = p - m.number(0.12, 0.25) if style == "tabletop" else 0.0
    foot = [(0.02, low)] if style == "tabletop" else [(f, low), (f, p - 0.14)]
    screen, hood = (s + m.number(0.08, 0.16), high - 0.32), m.pick(0.06, 0.14, 0.2)
    if style == "slim":
        screen, hood = (s + 0.03, high - 0.22), 0.0
    head = [screen, (screen[0] - hood, high - 0.24), (screen[0] - hood - 0.01, high)]
    back = [(deep - m.number(0, 0.1), high), (deep, p), (deep, low)]
    line = [*foot, (0.0, p - 0.06), (0.0, p), (s, p + 0.05), *head, *back]
    return [(b, c - low) for b, c in line], low


def _lower_front(m: Model, f: float, p: float, wide: float) -> None:
    """The face below the panel at y = f: a coin door, a service door, small signs."""
    if m.chance(0.85):
        _coin_door(m, "coin_door", (-0.13, 0.13), f, (p - m.number(0.49, 0.56), p - 0.2))
    if m.chance(0.3):
        z = (0.06, 0.26)
        m.add("service_door", box((-0.15, 0.15), (f - 0.012, f), z))
        hang(m, "service_door", (-0.15, 0.15), (f - 0.012, f), z, m.pick("left", "bottom"), OUT, 95)
    trims(m, BASE, (-wide / 2 + 0.02, wide / 2 - 0.02), f, (0.02, 0.1), 1)


def arcade_cabinet(m: Model) -> None:
    """An upright, a slim or a table-top game: sticks or a wheel, buttons, a coin door or none, a marquee, side walls."""
    style, wide = m.pick("upright", "upright", "slim", "tabletop"), m.number(0.42, 0.75)
    high, deep = m.number(1.6, 1.85), m.number(0.6, 0.8)
    line, low = _arcade_line(m, style, high, deep)
    t, x, k = m.number(0.012, 0.025), (-wide / 2 + 0.02, wide / 2 - 0.02), len(line) - 9
    m.add(BASE, prism(line, "x", (-wide / 2, wide / 2)))
    if m.chance(0.8):
        around = Polygon(line).buffer(m.number(0.012, 0.03), join_style=m.pick("round", "mitre"), quad_segs=2)
        out = around.intersection(rectangle((-1, 2), (0, 3)))
        m.add(BASE, *(prism(out, "x", (c, c + t)) for c in (-wide / 2 - t, wide / 2)))
    edge, lower, upper = (vec(0, *line[k + c]) for c in (1, 2, 3))
    _controls(m, x, edge, lower)
    corners = ((lower + 0.08 * (upper - lower), 0.006), (upper, 0.006), (upper, -0.01), (lower, -0.01))
    m.add(BASE, prism([(c[1] - d, c[2] + 0.003) for c, d in corners], "x", shrunk(x, 0.03)))
    top, y = high - low, line[k + 4][0]
    if style != "slim" or m.chance(0.5):
        m.add(BASE, box(shrunk(x, -0.005), (y - 0.012, y + 0.01), (top - 0.21, top - 0.02)))
    if style != "tabletop":
        _lower_front(m, line[0][0], line[k + 1][1], wide)
    if m.chance(0.5):
        slots, z = np.linspace(-0.1, 0.1, 6), (0.3 * top, 0.4 * top)
        m.add(BASE, *(box((a, a + 0.012), (deep - 0.01, deep + 0.003), z) for a in slots))


def _meter_head(m: Model, name: str, c: float, z: float, style: str) -> None:
    """The head of a meter at x = c: a domed or boxed case with a window, a coin slot, a dial and a vault door."""
    r, deep, tall = m.number(0.065, 0.085), m.number(0.045, 0.06), m.number(0.2, 0.28)
    x, mid = (c - r, c + r), z + m.number(0.35, 0.45) * tall
    outline = arch(x, (z, z + tall), {"dome": r, "low": 0.4 * r, "box": 0.1 * r}[style])
    m.add(BASE, prism(outline, "y", (-deep, deep)))
    top = arch(shrunk(x, 0.2 * r), (mid + 0.02, z + tall - 0.2 * r), {"dome": 0.8 * r, "low": 0.3 * r, "box": 0.02 * r}[style])
    m.add(BASE, prism(top, "y", (-deep - 0.004, -deep + 0.001)))
    if m.chance(0.5):
        m.add(BASE, prism(top.difference(top.buffer(-0.006)), "y", (-deep - 0.01, -deep)))
    side = m.pick(-1, 1)
    if m.chance(0.75):
        at = vec(c + side * 0.35 * r, -deep, mid - 0.02)
        m.add(
            f"dial{name}",
            rod(at, at - (0, 0.022, 0), 0.02, 14),
            box(*np.c_[at - (0.006, 0.034, 0.026), at + vec(0.006, -0.018, 0.026)]),
        )
        m.hinge(f"dial{name}", at, (0, 1, 0), m.pick(90, 180))
    slot = (c - side * 0.45 * r - 0.01, c - side * 0.45 * r + 0.01)
    m.add(BASE, box(slot, (-deep - 0.006, -deep), (mid - 0.035, mid + 0.002)))
    low = (z + 0.015, mid - 0.055)
    if m.chance(0.8):
        y, hinged = (-deep - 0.008, -deep - max(m.gap(0.1), 0.0)), m.pick("left", "right", "bottom")
        m.add(f"vault{name}", prism(rounded(shrunk(x, 0.25 * r), low, 0.006), "y", y))
        lock = (c, y[0], middle(low))
        m.add(f"vault{name}", rod(lock, (c, y[0] - 0.008, lock[2]), 0.009, 12))
        hang(m, f"vault{name}", shrunk(x, 0.25 * r), y, low, hinged, OUT, m.number(85, 110))


def _ticket_machine(m: Model, x: Span, deep: float, high: float) -> None:
    """A post for a whole street: a tall case with a screen, keys, a ticket flap, a coin door and a solar roof."""
    m.add(BASE, box(x, (0, deep), (0.1, high)), box(shrunk(x, 0.03), (0.03, deep - 0.03), (0, 0.1)))
    m.add(BASE, box(shrunk(x, 0.06), (-0.006, 0), (high - 0.35, high - 0.18)))
    if m.chance(0.6):
        roof = box(shrunk(x, -0.04), (-0.08, deep + 0.06), (high + 0.03, high + 0.05))
        m.add(
            BASE,
            turned(roof, (1, 0, 0), 15, (0, deep / 2, high)),
            rod((middle(x), deep / 2, high), (middle(x), deep / 2, high + 0.05), 0.03),
        )
    else:
        m.add(BASE, prism([(0, high), (deep, high), (deep, high + 0.1), (-0.06, high + 0.06)], "x", x))
    for k in range(m.pick(3, 4, 6)):
        button(m, f"key_{k}", (x[0] + 0.08 + 0.04 * (k % 3), 0, high - 0.42 - 0.04 * (k // 3)), (0, -1, 0), 0.022)
    a, z = (x[0] + 0.07, x[1] - 0.07), (0.66 * high - 0.08, 0.66 * high - 0.01)
    m.add(BASE, prism(rectangle(shrunk(a, -0.01), shrunk(z, -0.01), 0.01), "y", (-0.02, 0)))
    m.add("flap", box(a, (-0.014, -0.01), z))
    hang(m, "flap", a, (-0.014, -0.01), z, "top", OUT, m.number(50, 80))
    for name, span in m.pick(
        (("coin_door", (0.16, 0.55 * high)),), (("coin_door", (0.16, 0.3 * high)), ("door", (0.32 * high, 0.55 * high)))
    ):
        b, y = shrunk(x, 0.02), (-0.022, -max(m.gap(0.2), 0.0))
        m.add(
            name, box(b, y, span), rod((b[1] - 0.04, y[0] - 0.01, middle(span)), (b[1] - 0.04, y[0], middle(span)), 0.014, 12)
        )
        hang(m, name, b, y, span, "left", OUT, m.number(95, 120))


def parking_meter(m: Model) -> None:
    """A meter on a post with one head or two, domed or boxed, or a ticket machine: dials, vault doors, a flap, keys."""
    if m.chance(0.3):
        _ticket_machine(m, (0.0, m.number(0.3, 0.42)), m.number(0.2, 0.3), m.number(1.35, 1.6))
        return
    high, r, style = m.number(1.0, 1.2), m.number(0.022, 0.035), m.pick("dome", "dome", "low", "box")
    m.add(BASE, rod((0, 0, 0), (0, 0, high), r, m.sections()), rod((0, 0, high - 0.06), (0, 0, high), 1.5 * r, 12))
    foot = m.pick("plate", "block", "none")
    if foot == "plate":
        m.add(BASE, rod((0, 0, 0), (0, 0, 0.012), 0.11, 16))
        m.add(BASE, *(rod((a, b, 0), (a, b, 0.022), 0.01, 6) for a in (-0.06, 0.06) for b in (-0.06, 0.06)))
    elif foot == "block":
        m.add(BASE, lathe([(0.14, 0.0), (0.14, 0.06), (0.05, 0.2)], 16))
    if m.chance(0.3):
        m.add(BASE, box((-0.07, 0.07), (-r - 0.004, -r), (0.75 * high, 0.75 * high + 0.18)))
    if m.chance(0.35):
        m.add(BASE, box((-0.15, 0.15), (-0.02, 0.02), (high - 0.02, high + 0.015)))
        for k, c in enumerate((-0.1, 0.1)):
            _meter_head(m, f"_{k}", c, high + 0.01, style)
    else:
        _meter_head(m, "", 0.0, high, style)
