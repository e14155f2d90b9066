"""Tool trolleys and serving carts, and the castors and leaves that other furniture shares with them."""

from __future__ import annotations

from dataclasses import replace

from training.kinds.cabinets.drawers import rows_of
from training.kinds.carcass import clutter
from training.kinds.joinery import Style, drawer, shrunk, style
from training.kinds.kitchen_parts import Look, body, door, fill, look
from training.kinds.kitchen_parts import drawer as pull_out
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, tube, vec
from training.kinds.wheels import caster, wheel_maker

EDGES = {"left": (-1, 0), "right": (1, 0), "back": (0, 1), "front": (0, -1)}
STEEL = ("slab", "slab", "pan", "rounded", "liner")


def castors(m: Model, x: Span, y: Span, high: float, still: bool = True) -> None:
    """Put four castors under a box: all swivel, two swivel, none swivels but all roll, or none moves."""
    how, r = m.pick("all", "all", "two", "two", "rolling", "still" if still else "all"), high / 2.5
    inset = 1.2 * r + 0.01
    for k, (a, b) in enumerate((a, b) for a in shrunk(x, inset) for b in shrunk(y, inset)):
        if how == "still":
            m.add(BASE, rod((a - 0.3 * r, b, r), (a + 0.3 * r, b, r), r, 12), rod((a, b, r), (a, b, high), 0.35 * r, 8))
        else:
            caster(m, f"castor_{k}", (a, b, high), r, how == "all" or (how == "two" and a < middle(x)))


def drop_leaf(m: Model, part: str, edge: str, x: Span, y: Span, z: Span, reach: float) -> None:
    """A leaf that hangs below an edge of a top (x, y, z) and lifts level with it; its hinges lie under the edge."""
    (a, b), thick = EDGES[edge], z[1] - z[0]
    at = vec(x[a > 0] if a else middle(x), y[b > 0] if b else middle(y), z[0])
    over = m.pick(0.0, 0.004, 0.01)
    down, along = (z[0] - reach, z[0] - 0.001), shrunk(y if a else x, over)
    outline = rectangle if m.chance(0.6) else (lambda u, v: rounded(u, v, 0.05))
    depth = sorted((at @ (abs(a), b, 0), at @ (abs(a), b, 0) + (a + b) * thick))
    m.add(part, prism(outline(along, down), "x" if a else "y", (depth[0], depth[1])))
    for c in m.pick((0.2, 0.8), (0.15, 0.5, 0.85), ()):
        p = at.copy()
        p[1 if a else 0] = along[0] + c * (along[1] - along[0])
        side = 0.03 * vec(b, abs(a), 0)
        m.add(m.pick(BASE, part), rod(p - side, p + side, 0.005, 8))
    m.hinge(part, at, (b, -a, 0), m.pick(85, 90))


def apron(m: Model, x: Span, y: Span, z: Span, post: float, s: Style) -> None:
    """A case for one or two drawers between four posts under a top."""
    inner = shrunk(x, post)
    m.add(BASE, *(box((a, a + 0.02), shrunk(y, post), z) for a in (x[0] + 0.01, x[1] - 0.03)))
    m.add(BASE, box(inner, (y[1] - 0.03, y[1] - 0.01), z), box(inner, shrunk(y, 0.03), (z[0] - 0.012, z[0] - 0.001)))
    for k, a in enumerate(rows_of(inner, [1.0] * m.pick(1, 2), 0.004)):
        drawer(m, f"drawer_{k}", a, (y[0] + 0.004, y[0] + 0.004 + s.thick), shrunk(z, 0.004), s, y[1] - y[0] - 0.08)


def _top_chest(m: Model, x: Span, y: Span, z: float, how: Look) -> None:
    """A tool chest with a lid hinged at its rear and small drawers below."""
    high, lid = m.number(0.25, 0.38), m.number(0.03, 0.09)
    inner, count = shrunk(x, 0.015), m.pick(1, 2, 3)
    tops = (z + 0.015, z + 0.75 * high)
    m.add(BASE, cut(box(x, y, (z, z + high)), box(inner, shrunk(y, 0.015), (tops[1], z + high + 1))))
    for k, b in enumerate(rows_of(tops, [1.0] * count, 0.004)):
        halves = [inner] if k < count - 1 or m.chance(0.5) else [(inner[0], middle(x) - 0.004), (middle(x) + 0.004, inner[1])]
        for n, a in enumerate(halves):
            part = f"chest_drawer_{k}_{n}"
            fill(m, part, a, (y[0] - 0.012, y[0] - 0.001), b, how, "top")
            m.slide(part, (0, -1, 0), 0.7 * (y[1] - y[0]))
    shell = box(x, y, (z + high + 0.001, z + high + lid))
    hollow = box(inner, shrunk(y, 0.015), (z, z + high + lid - 0.012))
    m.add("lid", cut(shell, hollow) if m.chance(0.6) else shell)
    if m.chance(0.6):
        m.add(
            "lid", box((middle(x) - 0.05, middle(x) + 0.05), (y[0] - 0.015, y[0]), (z + high + 0.3 * lid, z + high + 0.8 * lid))
        )
    m.hinge("lid", (middle(x), y[1], z + high + 0.001), (-1, 0, 0), m.pick(70, 85, 95))


def _open_cart(m: Model, x: Span, y: Span, z: float, how: Look) -> None:
    """A cart of trays between posts with drawers under its top tray."""
    high, r = m.number(0.6, 0.75), m.pick(0.012, 0.018)
    posts = [(a, b) for a in shrunk(x, 2 * r) for b in shrunk(y, 2 * r)]
    m.add(BASE, *(rod((a, b, z), (a, b, z + high), r, 8) for a, b in posts))
    for c in m.pick((0.0, 0.85), (0.0, 0.4, 0.85)):
        low = z + c * high
        m.add(BASE, cut(box(x, y, (low, low + 0.08)), box(shrunk(x, 0.01), shrunk(y, 0.01), (low + 0.01, low + 1))))
    count, low = m.pick(1, 1, 2), z + 0.85 * high
    for k, a in enumerate(rows_of(shrunk(x, 0.05), [1.0] * count, 0.004)):
        pull_out(m, f"drawer_{k}", a, (low - 0.13, low - 0.005), y[1], replace(how, sunk=None), m.pick("tub", "box"), "top")
    m.add(BASE, *(box((a, a + 0.01), (0.0, y[1] - 0.02), (low - 0.14, low)) for a in (x[0] + 0.04, x[1] - 0.05)))
    at, side = z + 0.92 * high, x[1] + 0.06
    m.add(
        BASE, tube([(x[1], y[0] + 0.04, at), (side, y[0] + 0.04, at), (side, y[1] - 0.04, at), (x[1], y[1] - 0.04, at)], 0.012)
    )


def tool_trolley(m: Model) -> None:
    """A steel cabinet of drawers on castors; a chest with a lid on it, a door beside the drawers, or an open cart of trays."""
    kind, wide, deep = m.pick("cabinet", "chest", "chest", "door", "cart"), m.number(0.55, 1.1), m.number(0.38, 0.52)
    foot, tall, how = m.number(0.09, 0.17), m.number(0.5, 0.72), look(m, 0.5, STEEL, ("bar", "rail", "rim", "groove", "none"))
    x, y = (0.0, wide), (0.0, deep)
    castors(m, x, y, foot)
    if kind == "cart":
        _open_cart(m, x, y, foot, how)
        return
    split = 0.62 * wide if kind == "door" else wide - 0.012
    shares = m.pick([2.0, 1.5, 1, 1, 1], [1.0] * 6, [3.0, 2, 1, 1], [2.0, 2, 1, 1, 1, 1, 1])
    rooms = [((0.02, split), b) for b in rows_of((foot + 0.02, foot + tall - 0.02), shares, 0.004)]
    beside = ((split + 0.015, wide - 0.02), (foot + 0.024, foot + tall - 0.024))
    hollow = body(m, x, y, (foot, foot + tall), [*rooms, beside] if kind == "door" else rooms, how, 0.015)
    edge, inside = m.pick("top", "middle"), m.pick("box", "tub", "none") if hollow else "none"
    for k, (a, b) in enumerate(rooms):
        pull_out(m, f"drawer_{k}", a, b, deep, how, inside, edge)
    if kind == "door":
        door(m, "door", *beside, "right", how, 110)
    level = foot + tall
    if kind == "chest":
        _top_chest(m, shrunk(x, m.pick(0.0, 0.02)), (0.03, deep), level, how)
    elif m.chance(0.5):
        m.add(BASE, box(x, (-0.03, deep), (level, level + 0.03)))
    else:
        m.add(BASE, prism(rectangle(shrunk(x, -0.01), (-0.03, deep), 0.015), "z", (level, level + 0.04)))
    at = foot + 0.85 * tall
    if m.chance(0.7):
        m.add(BASE, tube([(0, 0.06, at), (-0.06, 0.06, at), (-0.06, deep - 0.06, at), (0, deep - 0.06, at)], 0.012))
    if m.chance(0.4):  # a rack for bottles at the other side
        m.add(
            BASE,
            cut(
                box((wide, wide + 0.1), shrunk(y, 0.06), (at - 0.2, at)),
                box((wide + 0.004, wide + 0.096), shrunk(y, 0.064), (at - 0.19, at + 1)),
            ),
        )
    if m.chance(0.5):
        m.add(BASE, *(rod((a, 0.0, foot), (a, 0.0, level), 0.014, 8) for a in x))


def _cart_wheels(m: Model, x: Span, y: Span) -> tuple[float, float]:
    """Wheels under a cart: four castors, or two large ones at its right end; gives where the left and right posts begin."""
    foot = m.number(0.06, 0.1)
    if m.chance(0.5):
        castors(m, x, y, foot, still=False)
        return foot, foot
    r, make, thick = m.number(0.1, 0.18), wheel_maker(m, ("spoked", "spoked", "disc", "lathed"), 0.0), m.number(0.015, 0.03)
    at = x[1] - 0.02
    for k, (b, way) in enumerate(((y[0] - 0.012, -1), (y[1] + 0.012, 1))):
        make(f"wheel_{k}", (at, b, r), (0, way, 0), r, thick)
    m.add(BASE, rod((at, y[0] - 0.02, r), (at, y[1] + 0.02, r), 0.01, 8))
    how = m.pick("castor", "castor", "foot")
    for k, b in enumerate(shrunk(y, 0.02)):
        if how == "castor":
            caster(m, f"castor_{k}", (x[0] + 0.02, b, foot), foot / 2.5, True)
    return (foot if how == "castor" else 0.0), r - 0.012


def _gallery(m: Model, x: Span, y: Span, z: float, how: str) -> None:
    """A shelf of a cart: a board, a tray with a rim, or glass in a frame with a rail above."""
    if how == "tray":
        m.add(BASE, cut(box(x, y, (z, z + 0.05)), box(shrunk(x, 0.012), shrunk(y, 0.012), (z + 0.012, z + 1))))
    elif how == "glass":
        m.add(
            BASE,
            prism(rectangle(x, y, 0.015), "z", (z, z + 0.018)),
            box(shrunk(x, 0.015), shrunk(y, 0.015), (z + 0.006, z + 0.012)),
        )
        m.add(BASE, prism(rectangle(x, y, 0.008), "z", (z + 0.06, z + 0.068)))
    else:
        m.add(BASE, box(x, y, (z, z + 0.018)))


def serving_cart(m: Model) -> None:
    """A tea trolley or bar cart: side flaps that hang down, a drawer or none, trays or glass, castors or two large wheels."""
    kind, long, deep, high = (
        m.pick("flaps", "flaps", "bar", "drawer"),
        m.number(0.55, 0.85),
        m.number(0.38, 0.5),
        m.number(0.7, 0.82),
    )
    x, y, s, post, round_ = (0.0, long), (0.0, deep), style(m), m.number(0.024, 0.04), m.chance(0.5)
    starts = _cart_wheels(m, x, y)
    for a, c in zip((x[0] + post / 2, x[1] - post / 2), starts, strict=True):
        for b in shrunk(y, post / 2):
            square = box((a - post / 2, a + post / 2), (b - post / 2, b + post / 2), (c, high))
            m.add(BASE, rod((a, b, c), (a, b, high), 0.5 * post, m.sections()) if round_ else square)
    shelf, low = m.pick("tray", "glass", "board"), max(starts) + 0.08
    for c in (low, (low + high) / 2 - 0.03) if m.chance(0.4) else (low,):
        _gallery(m, x, y, c, shelf)
    thick = m.number(0.016, 0.03)
    if kind == "bar":
        _gallery(m, x, y, high - 0.018, shelf)
    else:
        over = m.pick(0.0, 0.02)
        tops = shrunk(x, -over), (-0.012 if kind == "flaps" else -0.02, deep + 0.012)
        m.add(BASE, prism(rectangle(*tops), "z", (high, high + thick)))
        if kind == "drawer" or m.chance(0.5):
            apron(m, x, y, (high - m.number(0.09, 0.13), high), post, s)
        for edge in m.pick(("left", "right"), ("left", "right"), ("right",), ("back",)) if kind == "flaps" else ():
            drop_leaf(m, f"flap_{edge}", edge, *tops, (high, high + thick), m.number(0.2, 0.32))
    if kind != "flaps" or "flap_left" not in m.joints:
        at, up = x[0] - 0.09, high + m.number(-0.05, 0.1)
        ends = [(x[0] + post / 2, b, high - 0.06) for b in shrunk(y, post / 2)]
        m.add(BASE, tube([ends[0], (at, ends[0][1], up), (at, ends[1][1], up), ends[1]], 0.009, 8))
    clutter(m, x, y, high + (thick if kind != "bar" else 0.0))
