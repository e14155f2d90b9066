"""Things on wheels by another artist: push carts, and chairs that turn on a star of castors."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.prop_style import Style, block, draw_style, sheet
from training.kinds.solids import box, cut, prism, ring, rod, rounded, tube, vec

Place = Float[np.ndarray, " 3"]


def wheel(s: Style, at: Place, r: float, wide: float, spokes: int = 0) -> list[Trimesh]:
    """A wheel on an axle along x: a disc, a tyre on a rim, or a rim with spokes."""
    side = vec(wide / 2, 0, 0)
    if s.way in ("low", "sheet") and not spokes:
        return [rod(at - side, at + side, r, s.n)]
    if spokes:
        rim = cut(rod(at - side, at + side, r, 24), rod(at - 2 * side, at + 2 * side, 0.86 * r, 24))
        turns = np.arange(spokes) * 2 * np.pi / spokes
        thick = 0.035 * r
        bars = [rod(at, at + 0.9 * r * vec(0, np.cos(t), np.sin(t)), thick, 6) for t in turns]
        return [rim, *bars, rod(at - 1.2 * side, at + 1.2 * side, 0.16 * r, s.n)]
    if s.way == "round":
        return [
            ring(at, (1, 0, 0), r - 0.45 * wide, 0.45 * wide, 24),
            rod(at - 0.6 * side, at + 0.6 * side, r - 0.4 * wide, 24),
        ]
    tyre = cut(rod(at - side, at + side, r, 24), rod(at - 2 * side, at + 2 * side, 0.72 * r, 24))
    return [tyre, rod(at - 0.7 * side, at + 0.7 * side, 0.73 * r, 24), rod(at - 1.1 * side, at + 1.1 * side, 0.2 * r, 12)]


def castor(s: Style, under: Place, r: float, parent: str = BASE) -> None:
    """A fork that turns about the vertical below a point, with its wheel; twin wheels or one."""
    m, fork, name = s.m, s.name("castor"), s.name("wheel")
    hub = vec(under[0], under[1] + 0.4 * r, r)
    twin = s.way in ("round", "old") or s.n == 8
    m.add(fork, rod(vec(under[0], under[1], 1.9 * r), under + vec(0, 0, 0.002), 0.25 * r, s.n))
    if twin:
        m.add(fork, box((hub[0] - 0.12 * r, hub[0] + 0.12 * r), (under[1] - 0.3 * r, hub[1] + 0.3 * r), (0.8 * r, 2.1 * r)))
        m.add(name, *(solid for v in (-0.42, 0.42) for solid in wheel(s, hub + vec(v * r, 0, 0), r, 0.5 * r)))
        m.add(name, rod(hub - vec(0.4 * r, 0, 0), hub + vec(0.4 * r, 0, 0), 0.15 * r, 8))
    else:
        cheeks = ((hub[0] + v * r, hub[0] + (v + 0.1) * r) for v in (-0.5, 0.4))
        m.add(fork, *(box(x, (under[1] - 0.3 * r, hub[1] + 0.3 * r), (0.8 * r, 2.2 * r)) for x in cheeks))
        m.add(fork, box((hub[0] - 0.5 * r, hub[0] + 0.5 * r), (under[1] - 0.3 * r, hub[1] + 0.3 * r), (2.15 * r, 2.3 * r)))
        m.add(name, *wheel(s, hub, r, 0.6 * r))
        m.add(name, rod(hub - vec(0.5 * r, 0, 0), hub + vec(0.5 * r, 0, 0), 0.12 * r, 8))
    m.spin(fork, under, (0, 0, 1), parent)
    m.spin(name, hub, (1, 0, 0), fork)


def push_cart(m: Model) -> None:
    """A platform with a folding handle, a trolley of shelves, a wooden cart on two wheels, or a tub with a drawbar."""
    s = draw_style(m)
    design = m.pick("platform", "trolley", "market", "wagon")
    {"platform": _platform, "trolley": _trolley, "market": _market, "wagon": _wagon}[design](s)


def _platform(s: Style) -> None:
    m, wide, long, r = s.m, s.m.number(0.45, 0.7), s.m.number(0.7, 1.1), s.m.number(0.05, 0.08)
    deck, high = (2.6 * r, 2.6 * r + s.m.number(0.025, 0.06)), s.m.number(0.7, 0.95)
    m.add(BASE, block(s, (0, wide), (0, long), deck, "d"))
    for x in (0.12 * wide, 0.88 * wide):
        castor(s, vec(x, 0.12 * long, deck[0]), r)
        name, hub = s.name("wheel"), vec(x, 0.88 * long, r)
        m.add(name, *wheel(s, hub, r, 0.6 * r))
        m.spin(name, hub, (1, 0, 0))
        m.add(
            BASE,
            *(
                box((x + v * r, x + (v + 0.12) * r), (hub[1] - 0.4 * r, hub[1] + 0.4 * r), (0.7 * r, deck[0]))
                for v in (-0.5, 0.38)
            ),
        )
        m.add(BASE, rod(hub - vec(0.5 * r, 0, 0), hub + vec(0.5 * r, 0, 0), 0.15 * r, 8))
    foot = vec(0.05, long - 0.03, deck[1] + 0.012)
    top = foot + vec(0, m.pick(0.0, 0.08), high)
    across = vec(wide - 0.1, 0, 0)
    m.add(
        "handle",
        tube(
            [
                foot,
                0.06 * foot + 0.94 * top,
                top + 0.08 * across,
                top + 0.92 * across,
                0.06 * foot + 0.94 * top + across,
                foot + across,
            ],
            0.014,
            8,
        ),
    )
    for share in m.pick((), (0.5,), (0.3, 0.6)):
        at = (1 - share) * foot + share * top
        m.add("handle", rod(at, at + across, 0.01, 8))
    brackets = ((foot[0] + v, foot[0] + v + 0.006) for v in (-0.021, 0.015, across[0] - 0.021, across[0] + 0.015))
    m.add(BASE, *(box(x, (foot[1] - 0.025, foot[1] + 0.025), (deck[1] - 0.002, deck[1] + 0.04)) for x in brackets))
    m.hinge("handle", foot + across / 2, (1, 0, 0), m.pick(80, 86))


def _trolley(s: Style) -> None:
    m, wide, long, r = s.m, s.m.number(0.4, 0.6), s.m.number(0.55, 0.9), s.m.number(0.03, 0.06)
    low, high, post = 2.5 * r, s.m.number(0.7, 0.95), s.m.number(0.011, 0.018)
    corners = [vec(x, y, 0) for x in (post, wide - post) for y in (post, long - post)]
    for corner in corners:
        a, b = corner + vec(0, 0, low), corner + vec(0, 0, high)
        square = s.way in ("low", "sheet", "old")
        m.add(BASE, box(*np.c_[a - vec(post, post, 0), b + vec(post, post, 0)]) if square else rod(a, b, post, s.n))
        castor(s, a, r)
    for at in np.linspace(low + 0.03, high - m.pick(0.0, 0.08), m.pick(2, 3, 4)):
        rim = m.number(0.03, 0.07)
        board = s.way in ("cad", "old") or s.n == 16
        if s.way == "sheet":
            m.add(BASE, sheet((0, wide), (0, long), (at, at + rim), "u"))
        elif board:
            m.add(BASE, block(s, (0, wide), (0, long), (at - 0.02, at)))
        else:
            outer = prism(rounded((0, wide), (0, long), 0.03), "z", (at, at + rim))
            m.add(BASE, cut(outer, prism(rounded((0.008, wide - 0.008), (0.008, long - 0.008), 0.024), "z", (at + 0.008, 9))))
    if m.chance(0.7):
        a = vec(post, long - post, high - 0.04)
        out, across = vec(0, m.number(0.05, 0.12), 0.03), vec(wide - 2 * post, 0, 0)
        m.add(BASE, tube([a, a + out, a + out + across, a + across], 0.011, 8))


def _market(s: Style) -> None:
    """Two large wheels, a box or an open deck, a pair of shafts, a leg; perhaps a tailboard and an awning."""
    m, wide, long, r = s.m, s.m.number(0.7, 1.0), s.m.number(1.0, 1.6), s.m.number(0.25, 0.42)
    deck, side, t = (r + 0.06, r + 0.1), s.m.number(0.15, 0.4), 0.025
    m.add(BASE, block(s, (0, wide), (0, long), deck, ""))
    axle = vec(wide / 2, m.number(0.35, 0.5) * long, r)
    reach, spokes = vec(wide / 2 + 0.07, 0, 0), 0 if s.way == "low" and s.n < 12 else m.pick(6, 8, 10)
    m.add(
        BASE,
        rod(axle - reach, axle + reach, 0.025, s.n),
        box((0.1, wide - 0.1), (axle[1] - 0.04, axle[1] + 0.04), (r, deck[0])),
    )
    for sign in (-1, 1):
        name = s.name("wheel")
        m.add(name, *wheel(s, axle + sign * reach, r, 0.05, spokes))
        m.spin(name, axle + sign * reach, (1, 0, 0))
    walls = [((x, x + t), (0, long)) for x in (0, wide - t)] + [((t, wide - t), (long - t, long))]
    m.add(BASE, *(block(s, x, y, (deck[1], deck[1] + side), "d") for x, y in walls))
    if m.chance(0.6):
        m.add("tailboard", block(s, (t + 0.003, wide - t - 0.003), (0, t), (deck[1] + 0.002, deck[1] + side), ""))
        m.hinge("tailboard", (wide / 2, 0, deck[1] + 0.002), (1, 0, 0), m.pick(90, 100))
    else:
        m.add(BASE, block(s, (t, wide - t), (0, t), (deck[1], deck[1] + side), "d"))
    for x in (0.1 * wide, 0.9 * wide):
        end = vec(x, long + m.number(0.5, 0.7), deck[1] + m.pick(0.0, 0.1))
        m.add(BASE, tube([vec(x, 0.6 * long, deck[0] - 0.018), vec(x, long, deck[0] - 0.018), end], 0.02, 8))
        m.add(BASE, rod((x, long - 0.08, 0), (x, long - 0.08, deck[0]), 0.022, s.n))
    if m.chance(0.4):
        top = deck[1] + m.number(0.9, 1.2)
        m.add(
            BASE,
            *(rod((x, y, deck[1]), (x, y, top + 0.02), 0.016, 8) for x in (0.04, wide - 0.04) for y in (0.05, long - 0.05)),
        )
        roof = [
            (-0.1, top),
            (wide / 2, top + 0.2),
            (wide + 0.1, top),
            (wide + 0.1, top + 0.02),
            (wide / 2, top + 0.22),
            (-0.1, top + 0.02),
        ]
        m.add(BASE, prism(roof, "y", (-0.1, long + 0.1)))


def _wagon(s: Style) -> None:
    """A tub on a fixed and a steered axle, with a drawbar."""
    m, wide, long, r = s.m, s.m.number(0.35, 0.5), s.m.number(0.7, 1.0), s.m.number(0.09, 0.14)
    low, side = 2 * r + 0.05, s.m.number(0.1, 0.3)
    if s.way == "sheet":
        m.add(BASE, sheet((0, wide), (0, long), (low, low + side), "u"))
    else:
        m.add(
            BASE,
            cut(
                block(s, (0, wide), (0, long), (low, low + side)),
                box((0.015, wide - 0.015), (0.015, long - 0.015), (low + 0.015, 9)),
            ),
        )
    front, rear = vec(wide / 2, 0.2 * long, r), vec(wide / 2, 0.8 * long, r)
    reach = vec(wide / 2 + 0.03, 0, 0)
    m.add("steering", rod(front + vec(0, 0, 0.03), vec(front[0], front[1], low + 0.005), 0.02, s.n))
    m.add(
        "steering",
        box((front[0] - 0.4 * wide, front[0] + 0.4 * wide), (front[1] - 0.02, front[1] + 0.02), (r - 0.02, r + 0.035)),
    )
    m.hinge("steering", front, (0, 0, 1), (-40, 40))
    m.add(BASE, box((rear[0] - 0.4 * wide, rear[0] + 0.4 * wide), (rear[1] - 0.02, rear[1] + 0.02), (r - 0.02, low)))
    for at, parent in ((front, "steering"), (rear, BASE)):
        m.add(parent, rod(at - reach, at + reach, 0.009, 8))
        for sign in (-1, 1):
            name = s.name("wheel")
            m.add(name, *wheel(s, at + sign * reach, r, 0.045))
            m.spin(name, at + sign * reach, (1, 0, 0), parent)
    pivot = vec(wide / 2, -0.03, r + 0.01)
    tip = pivot + vec(0, -m.number(0.35, 0.6), m.number(0.2, 0.45))
    m.add(
        "steering",
        *(
            box((pivot[0] + v, pivot[0] + v + 0.008), (pivot[1] - 0.015, front[1]), (r - 0.005, r + 0.025))
            for v in (-0.024, 0.016)
        ),
    )
    m.add("drawbar", rod(pivot, tip, 0.012, 8), rod(tip - vec(0.07, 0, 0), tip + vec(0.07, 0, 0), 0.013, s.n))
    m.add("drawbar", rod(pivot - vec(0.016, 0, 0), pivot + vec(0.016, 0, 0), 0.012, 8))
    m.hinge("drawbar", pivot, (-1, 0, 0), (-20, 45), "steering")
