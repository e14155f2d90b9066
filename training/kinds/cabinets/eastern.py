"""Cabinets in styles of the East."""

from __future__ import annotations

from collections.abc import Sequence

from shapely.geometry import Point as Spot
from shapely.geometry import Polygon

from training.kinds.carcass import clutter
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, hang, middle
from training.kinds.solids import Span, box, prism, rectangle, ring, rod

Row = tuple[str, float]  # what it holds and its height [m]


def _leaf(m: Model, part: str, x: Span, y: Span, z: Span, style: str) -> None:
    """A lacquered leaf: plain, a frame with a panel, a lattice, or painted with a raised border."""
    rim = min(0.05, 0.14 * (x[1] - x[0]))
    if style == "lattice":
        glazed(m, part, x, y, z, rim, (m.pick(1, 2, 3), m.pick(3, 5)))
        return
    if style == "framed":
        m.add(part, prism(rectangle(x, z, rim), "y", y))
        inner = (x[0] + rim, x[1] - rim), (z[0] + rim, z[1] - rim)
        m.add(part, box(inner[0], (y[0] + 0.006, y[1] - 0.003), inner[1]))
        return
    m.add(part, box(x, y, z))
    if style == "border":
        m.add(part, prism(rectangle((x[0] + rim, x[1] - rim), (z[0] + rim, z[1] - rim), 0.01), "y", (y[0] - 0.003, y[0])))


def brass(m: Model, part: str, x: Span, at: tuple[float, float], side: str, style: str, size: float) -> None:
    """The fittings of one leaf of a pair: half a plate at its free edge, a hanging pull, plaques of hinges."""
    (y, z), (free, way) = at, (x[1], -1) if side == "left" else (x[0], 1)
    plate = (
        Spot(free, z).buffer(size, quad_segs=m.pick(4, 8))
        if style == "round"
        else rectangle((free - size, free + size), (z - 0.8 * size, z + 0.8 * size))
    )
    if style != "none":
        half = plate.intersection(rectangle(x, (z - 1, z + 1)))
        m.add(part, prism(half, "y", (y - 0.003, y)))
    c = free + 0.3 * way * size
    m.add(part, rod((c, y - 0.012, z + 0.2 * size), (c, y, z + 0.2 * size), 0.005, 8))
    if style == "round":
        m.add(part, box((c - 0.006, c + 0.006), (y - 0.012, y - 0.007), (z - 0.5 * size, z + 0.2 * size)))
    else:
        m.add(part, ring((c, y - 0.008, z), (0, 1, 0), 0.2 * size, 0.003, 12))


def _pair(m: Model, name: str, x: Span, y: Span, z: Span, styles: tuple[str, str], post: float) -> None:
    """Two leaves in an opening, with or without a fixed post between them."""
    mid, gap = middle(x), m.pick(0.001, 0.002, 0.004)
    if post:
        m.add(BASE, box((mid - post / 2, mid + post / 2), y, z))
    size = min(0.1, 0.3 * (x[1] - x[0]), 0.3 * (z[1] - z[0]))
    for side, span in (("left", (x[0] + gap, mid - post / 2 - gap)), ("right", (mid + post / 2 + gap, x[1] - gap))):
        part, tall = f"{name}_{side}", (z[0] + gap, z[1] - gap)
        _leaf(m, part, span, y, tall, styles[0])
        brass(m, part, span, (y[0], middle(z)), side, styles[1], size)
        hang(m, part, span, y, tall, side, OUT, m.pick(95, 110, 150))


def _drawers(m: Model, name: str, x: Span, y: Span, z: Span, count: int, deep: float) -> None:
    """Drawers side by side with a ring, a knob or a small plate each."""
    gap, share, style = m.pick(0.001, 0.003), (x[1] - x[0]) / count, m.pick("ring", "plate", "knob")
    for k in range(count):
        a, b, part = x[0] + k * share + gap, x[0] + (k + 1) * share - gap, f"{name}_{k}"
        low, high, c = z[0] + gap, z[1] - gap, x[0] + (k + 0.5) * share
        m.add(part, box((a, b), y, (low, high)))
        m.add(part, box((a + 0.012, b - 0.012), (y[1], deep), (low + 0.006, low + 0.014)))
        m.add(part, *(box((d, d + 0.008), (y[1], deep), (low + 0.006, high - 0.02)) for d in (a + 0.012, b - 0.02)))
        if style == "ring":
            m.add(part, ring((c, y[0] - 0.008, middle(z) - 0.01), (0, 1, 0), 0.022, 0.003, 12))
        elif style == "plate":
            m.add(part, prism(Spot(c, middle(z)).buffer(0.3 * (high - low), quad_segs=3), "y", (y[0] - 0.003, y[0])))
        m.add(part, rod((c, y[0] - 0.012, middle(z) + 0.012), (c, y[0], middle(z) + 0.012), 0.006, 8))
        m.slide(part, (0, -1, 0), m.number(0.6, 0.85) * deep)


def _tier(m: Model, name: str, x: Span, deep: float, low: float, rows: Sequence[Row], leaves: tuple[str, str]) -> float:
    """Rails, panels and fronts of one tier above a height; return where it ends."""
    t, rail, y = 0.02, m.number(0.025, 0.04), (m.pick(0.0, 0.004, 0.01), 0.0)
    y = (y[0], y[0] + m.number(0.016, 0.024))
    end = low + sum(h for _, h in rows) + rail * (len(rows) + 1)
    post = m.number(0.03, 0.05)
    for a in (x[0], x[1] - post):
        for b in (0.0, deep - post):
            m.add(BASE, box((a, a + post), (b, b + post), (low, end)))
        m.add(BASE, box((a + 0.3 * post, a + 0.3 * post + 0.012), (post, deep - post), (low, end)))
    m.add(BASE, box((x[0] + post, x[1] - post), (deep - 0.012, deep - 0.002), (low, end)))
    inner, at = (x[0] + post, x[1] - post), low
    for k, (what, high) in enumerate(rows):
        m.add(BASE, box(inner, (0.0, m.pick(post, deep - 0.012)), (at, at + rail)))
        z = (at + rail, at + rail + high)
        if what == "pair":
            _pair(m, f"{name}_door_{k}", inner, y, z, leaves, m.pick(0.0, 0.025))
            if high > 0.5 and m.chance(0.6):
                m.add(BASE, box(inner, (y[1] + 0.01, deep - 0.012), (middle(z), middle(z) + 0.015)))
        elif what == "apron":
            m.add(BASE, box(inner, (0.006, 0.02), z))
        else:
            _drawers(m, f"{name}_drawer_{k}", inner, y, z, int(what), deep - 0.03)
        at = z[1]
    m.add(BASE, box(inner, (0.0, deep - 0.012), (at, at + t)), box(inner, (0.0, deep - 0.012), (low, low + 0.6 * rail)))
    return at + rail


def chinese_cabinet(m: Model) -> None:
    """Two tiers of double doors with brass plates and rows of drawers between posts; a cornice, an apron, flared ends."""
    style = m.pick("wedding", "wedding", "compound", "coffer", "low")
    wide = {"coffer": m.number(1.1, 1.6), "low": m.number(0.7, 1.1)}.get(style, m.number(0.85, 1.2))
    deep, foot, n = m.number(0.38, 0.55), m.number(0.08, 0.2), m.pick(2, 3)
    leaves = (m.pick("plain", "framed", "border", "lattice"), m.pick("round", "round", "square", "none"))
    row = (str(n), m.number(0.1, 0.16))
    rows: list[Row] = [("pair", m.number(0.45, 0.65))]
    if style == "wedding":
        rows = [*m.pick([("apron", 0.14)], []), *rows, row, ("pair", m.number(0.45, 0.6))]
        rows = rows if m.chance(0.6) else [*rows[:-2], ("pair", 0.4)]
    elif style == "coffer":
        rows = [("pair", m.number(0.35, 0.45)), (str(m.pick(3, 4)), row[1])]
    elif style == "low":
        rows = m.pick([("pair", 0.4), row], [row, ("pair", 0.45)], [row, row, ("pair", 0.35)])
    else:
        rows = [row, *rows, *m.pick([row], [])]
    end, x = _tier(m, "lower", (0.0, wide), deep, foot, rows, leaves), (0.0, wide)
    if style == "compound":
        end = _tier(m, "upper", (0.0, wide), deep, end, [("pair", m.number(0.32, 0.45))], leaves)
    over = m.pick(0.0, 0.02) if style != "coffer" else m.number(0.06, 0.14)
    m.add(BASE, box((-over, wide + over), (-min(over, 0.03), deep), (end, end + 0.03)))
    if style == "coffer" and m.chance(0.7):
        for a, way in ((-over, -1), (wide + over, 1)):
            m.add(BASE, prism([(a - 0.05 * way, end + 0.03), (a, end + 0.03), (a + 0.03 * way, end + 0.09)], "y", (0, deep)))
    elif style in ("wedding", "compound") and m.chance(0.5):
        m.add(BASE, box((-0.04, wide + 0.04), (-0.04, deep), (end + 0.03, end + 0.055)))
    legs = [(a, b) for a in (0.0, wide - 0.04) for b in (0.0, deep - 0.04)]
    m.add(BASE, *(box((a, a + 0.04), (b, b + 0.04), (0, foot)) for a, b in legs))
    drop = 0.5 * foot
    curve = [(0.04, foot), (wide - 0.04, foot), (wide - 0.04, foot - drop), (0.75 * wide, foot - 0.3 * drop)]
    apron = Polygon([*curve, (0.5 * wide, foot - 0.6 * drop), (0.25 * wide, foot - 0.3 * drop), (0.04, foot - drop)])
    m.add(BASE, prism(apron, "y", (0.006, 0.022)))
    if style in ("coffer", "low"):
        clutter(m, x, (0, deep), end + 0.03)
