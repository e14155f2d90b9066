"""Farm tractors and quad bikes, as one artist models them."""

from __future__ import annotations

from shapely.geometry import Point, Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rectangle, rod, tube, vec
from training.kinds.wheeler_gear import axle, seat, steering, tyre_look
from training.kinds.wheeler_style import STYLES, softened

Place = tuple[float, float, float]


def farm_tractor(m: Model) -> None:
    """Large rear wheels, a long hood, a cab with doors or a roll bar, a hitch at the rear."""
    style = m.pick(*STYLES)
    base, rear, fore = m.number(1.9, 2.5), m.number(0.62, 0.85), m.number(0.34, 0.5)
    wide, z0, top = m.number(0.28, 0.36), fore + 0.12, fore + m.number(0.75, 0.95)
    end = base - rear - 0.05
    soft = 0.0 if style in ("low", "sheet") else m.number(0.03, 0.1)
    nose = [(-0.5, z0 + 0.1), (end, z0 + 0.1), (end, top), (-0.35, top - m.number(0.0, 0.15)), (-0.5, top - 0.25)]
    bonnet = prism(softened(nose, soft), "x", (-wide, wide))
    if m.chance(0.6):
        bonnet = cut(bonnet, prism(softened(nose, soft).buffer(-0.03, join_style=2), "x", (-wide + 0.03, wide - 0.03)))
        bonnet = cut(bonnet, box((-wide + 0.03, wide - 0.03), (-0.4, end - 0.03), (z0, z0 + 0.3)))
        m.add(BASE, box((-0.6 * wide, 0.6 * wide), (-0.2, end - 0.1), (z0 + 0.02, top - 0.2)))
    part = "hood" if m.chance(0.75) else BASE
    m.add(part, bonnet)
    for z in (z0 + 0.3, z0 + 0.38, z0 + 0.46)[: m.pick(0, 2, 3)]:
        m.add(part, *(box((s * (wide - 0.01), s * (wide + 0.008)), (-0.2, 0.5 * end), (z, z + 0.03)) for s in (-1, 1)))
    m.add(part, *(rod((s * 0.6 * wide, -0.53, top - 0.35), (s * 0.6 * wide, -0.4, top - 0.35), 0.07, 12) for s in (-1, 1)))
    if part == "hood":
        m.hinge("hood", (0, end, top), (-1, 0, 0), m.number(35, 55))
    m.add(BASE, box((-0.8 * wide, 0.8 * wide), (-0.45, base + 0.3), (z0 - 0.12, z0 + 0.1)))
    m.add(BASE, box((-0.2, 0.2), (base - 0.3, base + 0.35), (rear - 0.25, rear + 0.25)))
    look = tyre_look(m, style)
    axle(m, look, "front", 0.0, wide + m.number(0.3, 0.45), (fore, 0.24))
    m.add(BASE, box((-0.1, 0.1), (-0.1, 0.1), (fore - 0.05, z0)))
    track = wide + m.number(0.45, 0.6)
    axle(m, look | {"lugs": 16}, "rear", base, track, (rear, 0.42))
    _exhaust(m, part, (wide, 0.45 * end, z0), top)
    _fenders(m, style, base, rear, track)
    floor = max(rear, z0 + 0.1)
    m.add(BASE, box((-track + 0.22, track - 0.22), (end - 0.02, base + 0.35), (floor - 0.06, floor)))
    seat(m, style, (0, base - 0.1, floor - 0.01))
    steering(m, (0, end + 0.38, floor + 0.62), 45, 0.19)
    if m.chance(0.6):
        top = max(floor + 0.9, 2 * rear + 0.5) + m.number(0.5, 0.7)
        _cab(m, style, (end, base + 0.4), track - 0.24, floor, top, (base, rear, rear))
    elif m.chance(0.7):
        bar = [(s * (track - 0.3), base + 0.3, floor - 0.05 + h) for s, h in ((-1, 0), (-1, 1.3), (1, 1.3), (1, 0))]
        m.add(BASE, tube(bar, 0.035, 8))
    _hitch(m, base + 0.3, rear)


def _exhaust(m: Model, part: str, corner: Place, top: float) -> None:
    """A pipe on the hood or beside it."""
    wide, y, z0 = corner
    if m.chance(0.7):
        stack = m.pick(BASE, part)
        x = 0.5 * wide if stack == part else wide + 0.06
        if stack != part:
            m.add(BASE, rod((0.7 * wide, y, z0), (x, y, z0), 0.035, 10), rod((x, y, z0 - 0.03), (x, y, top), 0.03, 10))
        m.add(
            stack, rod((x, y, top - 0.15), (x, y, top + 0.35), 0.05, 10), rod((x, y, top + 0.34), (x, y, top + 0.8), 0.028, 10)
        )


def _fenders(m: Model, style: str, base: float, rear: float, track: float) -> None:
    ring = Point((base, rear)).buffer(rear + 0.1)
    hoop = ring.difference(ring.buffer(-0.035)).intersection(rectangle((base - 2, base + rear * 0.8), (rear + 0.15, rear + 3)))
    parts = [hoop] if isinstance(hoop, Polygon) else list(hoop.geoms)
    for s in (-1, 1):
        m.add(BASE, *(prism(p, "x", (s * (track - 0.26), s * (track + 0.2))) for p in parts))
        if style != "sheet":
            plate = ring.intersection(rectangle((base - 2, base + rear * 0.8), (rear + 0.15, rear + 3)))
            m.add(BASE, prism(plate, "x", (s * (track - 0.27), s * (track - 0.24))))


def _cab(m: Model, style: str, span: tuple[float, float], half: float, floor: float, top: float, wheel: Place) -> None:
    """Posts, a roof, glass and doors; a rear window that swings up."""
    a, b = span
    p = m.number(0.04, 0.07)
    posts = [(x, y) for x in (-half, half - p) for y in (a, b - p)]
    m.add(BASE, *(box((x, x + p), (y, y + p), (floor - 0.01, top)) for x, y in posts))
    roof = softened(rectangle((-half - 0.08, half + 0.08), (a - 0.1, b + 0.1)), 0.0 if style == "low" else 0.12)
    m.add(BASE, prism(roof, "z", (top, top + m.number(0.08, 0.18))))
    if m.chance(0.6):
        m.add(BASE, box((-half + p, half - p), (a + 0.4 * p, a + 0.6 * p), (floor, top)))
    for s, side in ((-1, "left"), (1, "right")):
        if not m.chance(0.85):
            continue
        whole = rectangle((a + p + 0.005, b - p - 0.005), (floor + 0.005, top - 0.005))
        outline = whole.difference(Point(wheel[:2]).buffer(wheel[2] + 0.13))
        frame = outline.difference(outline.buffer(-0.05, join_style=2))
        solid = style in ("low", "sheet") and m.chance(0.5)
        part = f"door_{side}"
        m.add(part, prism(outline if solid else frame, "x", (s * (half - 0.035), s * half)))
        if not solid and m.chance(0.7):
            m.add(part, prism(outline.buffer(-0.048, join_style=2), "x", (s * (half - 0.02), s * (half - 0.014))))
        rear_hung = m.chance(0.6)
        y = b - p if rear_hung else a + p
        m.hinge(part, (s * half, y, floor + 0.5), (0, 0, s if rear_hung else -s), m.number(60, 85))
        free = a + p + 0.05 if rear_hung else b - p - 0.1
        m.add(part, box((s * (half - 0.01), s * (half + 0.03)), (free, free + 0.05), (top - 0.5, top - 0.38)))
    if m.chance(0.6):
        m.add("rear_window", box((-half + p + 0.004, half - p - 0.004), (b - 0.03, b - 0.01), (floor + 0.45, top - 0.005)))
        m.hinge("rear_window", (0, b - 0.02, top - 0.005), (1, 0, 0), m.number(35, 60))
        m.add(BASE, box((-half + p, half - p), (b - p, b - 0.01), (floor, floor + 0.44)))


def _hitch(m: Model, y: float, rear: float) -> None:
    z = rear - 0.3
    m.add(BASE, box((-0.3, 0.3), (y - 0.1, y + 0.06), (z - 0.06, z + 0.12)))
    if m.chance(0.6):
        for s, side in ((-1, "left"), (1, "right")):
            part = f"lift_arm_{side}"
            m.add(
                part,
                box((s * 0.26, s * 0.3), (y + 0.03, y + 0.7), (z - 0.03, z + 0.03)),
                ball((s * 0.28, y + 0.7, z), (0.05, 0.05, 0.05), 8),
            )
            m.hinge(part, (s * 0.28, y + 0.03, z), (1, 0, 0), (-10, 35))
    if m.chance(0.5):
        m.add(
            "power_shaft",
            rod((0, y, z + 0.05), (0, y + 0.16, z + 0.05), 0.025, 6),
            rod((0, y + 0.06, z + 0.05), (0, y + 0.08, z + 0.05), 0.04, 12),
        )
        m.spin("power_shaft", (0, y, z + 0.05), (0, 1, 0))
    m.add(BASE, box((-0.05, 0.05), (y, y + 0.2), (z - 0.12, z - 0.05)))


def quad_bike(m: Model) -> None:
    """Four balloon wheels, a saddle, a handlebar that turns, racks, at times a box, a seat or fuel lid that opens."""
    style = m.pick(*STYLES)
    base, r, w = m.number(1.1, 1.35), m.number(0.26, 0.33), m.number(0.2, 0.28)
    track, z = m.number(0.38, 0.48), r + m.number(0.1, 0.16)
    soft = 0.0 if style == "low" else m.number(0.03, 0.07)
    m.add(BASE, box((-0.12, 0.12), (-0.2, base + 0.15), (r - 0.06, z + 0.05)))
    tank = [(-0.1, z), (0.75 * base, z), (0.6 * base, z + 0.25), (0.35 * base, z + 0.36), (0.1, z + 0.32), (-0.25, z + 0.15)]
    m.add(BASE, prism(softened(tank, soft), "x", (-0.14, 0.14)))
    saddle = [
        (0.42 * base, z + 0.24),
        (base + 0.1, z + 0.2),
        (base + 0.12, z + 0.32),
        (0.7 * base, z + 0.3),
        (0.45 * base, z + 0.38),
    ]
    part = "seat" if m.chance(0.4) else BASE
    m.add(part, prism(softened(saddle, 0.5 * soft), "x", (-0.16, 0.16)))
    m.add(BASE, box((-0.12, 0.12), (0.5 * base, base + 0.08), (z, z + 0.22)))
    if part == "seat":
        m.hinge("seat", (0, 0.42 * base, z + 0.26), (1, 0, 0), 60)
    look = tyre_look(m, style) | {"lugs": m.pick(0, 16)}
    for name, y in (("front", 0.0), ("rear", base)):
        axle(m, look, name, y, track, (r, w))
        _mudguards(m, y, r, track, w, z)
    _bar(m, 0.18 * base, z + 0.3)
    m.add(BASE, *(rod((s * 0.1, -0.28, z + 0.1), (s * 0.1, -0.12, z + 0.1), 0.06, 12) for s in (-1, 1)))
    m.add(BASE, *(box((s * 0.1, s * 0.4), (0.35 * base, 0.65 * base), (r - 0.06, r - 0.02)) for s in (-1, 1)))
    for y0, y1 in ((-0.4, 0.12), (base - 0.1, base + 0.4)):
        if m.chance(0.6):
            _rack(m, y0, y1, z + 0.36)
    if m.chance(0.4):
        y0, y1, a = base - 0.08, base + 0.38, z + 0.37
        m.add(
            BASE, cut(box((-0.35, 0.35), (y0, y1), (a, a + 0.2)), box((-0.33, 0.33), (y0 + 0.02, y1 - 0.02), (a + 0.02, a + 1)))
        )
        m.add(BASE, *(rod((s * 0.2, base + 0.1, z + 0.1), (s * 0.2, base + 0.1, a + 0.01), 0.02, 8) for s in (-1, 1)))
        m.add("box_lid", prism(softened(rectangle((-0.355, 0.355), (y0 - 0.005, y1 + 0.005)), soft), "z", (a + 0.2, a + 0.24)))
        m.hinge("box_lid", (0, y0, a + 0.2), (1, 0, 0), 80)


def _mudguards(m: Model, y: float, r: float, track: float, w: float, z: float) -> None:
    low, far = r + 0.06, r + 0.12
    shape = [(y - far, low), (y - 0.6 * far, r + far), (y + 0.6 * far, r + far), (y + far, low)]
    inside = [(y + 0.9 * far, low), (y + 0.52 * far, r + 0.85 * far), (y - 0.52 * far, r + 0.85 * far), (y - 0.9 * far, low)]
    plate = Polygon(shape + inside)
    for s in (-1, 1):
        m.add(BASE, prism(plate, "x", (s * 0.12, s * (track + 0.4 * w))))
    m.add(BASE, box((-0.13, 0.13), (y - 0.1, y + 0.1), (z, r + 0.95 * far)))


def _rack(m: Model, y0: float, y1: float, z: float) -> None:
    m.add(BASE, *(rod((x, y0, z), (x, y1, z), 0.01, 6) for x in (-0.3, -0.15, 0, 0.15, 0.3)))
    m.add(BASE, *(rod((-0.3, y, z), (0.3, y, z), 0.012, 6) for y in (y0, y1)))
    m.add(BASE, *(rod((s * 0.1, (y0 + y1) / 2, z - 0.4), (s * 0.15, (y0 + y1) / 2, z), 0.012, 6) for s in (-1, 1)))


def _bar(m: Model, y: float, z: float) -> None:
    """The handlebar on its stem, with levers for the brake and at times a thumb throttle."""
    stem = vec(0, y - 0.04, z - 0.06)
    top = vec(0, y + 0.04, z + 0.16)
    m.add("handlebar", rod(stem, top, 0.02, 10))
    path = [
        (-0.38, y + 0.12, z + 0.2),
        (-0.2, y + 0.05, z + 0.22),
        (0, y + 0.04, z + 0.15),
        (0.2, y + 0.05, z + 0.22),
        (0.38, y + 0.12, z + 0.2),
    ]
    m.add("handlebar", tube(path, 0.012, 8))
    m.hinge("handlebar", stem, top - stem, (-35, 35))
    for s, side in ((-1, "left"), (1, "right")):
        m.add("handlebar", rod((s * 0.27, y + 0.08, z + 0.212), (s * 0.38, y + 0.12, z + 0.2), 0.018, 8))
        if m.chance(0.5):
            a = vec(s * 0.22, y + 0.03, z + 0.215)
            m.add(f"brake_lever_{side}", rod(a + vec(0, 0.02, 0), a + vec(s * 0.13, -0.005, -0.01), 0.008, 6))
            m.hinge(f"brake_lever_{side}", a, (0, 0, s), 18, "handlebar")
    if m.chance(0.5):
        m.add("handlebar", box((-0.06, 0.06), (y - 0.03, y + 0.06), (z + 0.14, z + 0.2)))
