"""An assault rifle of one artist; the muzzle looks to -Y."""

from __future__ import annotations

from shapely.geometry import Polygon

from training.kinds.arena_style import Look, look
from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rectangle, rod, vec
from training.kinds.weapons.arena_arms import grip, slab, trigger


def assault_rifle(m: Model) -> None:
    """A receiver with a barrel, a stock, a magazine ahead of or behind the trigger, handles and sights."""
    k, style = look(m), m.pick("long", "long", "flat", "bullpup")
    long, h, half = m.number(0.2, 0.3), m.number(0.026, 0.04), m.number(0.014, 0.021)
    rear = 0.0 if style == "bullpup" else long
    body = [(0, -h), (long, -h), (long, h * m.pick(0.8, 1.0)), (0.8 * long, h), (0, h)]
    m.add(BASE, *slab(k, Polygon(body), half))
    gun = m.number(0.16, 0.4)
    n = max(8, k.n)
    m.add(BASE, rod((0, 0.002, 0.2 * h), (0, -gun, 0.2 * h), m.number(0.006, 0.01), n))
    guard = m.number(0.4, 0.75) * gun
    m.add(BASE, *k.body((-0.95 * half, 0.95 * half), (-guard, 0.001), (-0.75 * h, m.pick(0.75, 1.0) * h)))
    if m.chance(0.6):
        m.add(BASE, rod((0, -gun - m.number(0.02, 0.12), 0.2 * h), (0, -gun + 0.01, 0.2 * h), m.number(0.011, 0.018), n))
    y = 0.1 * long if style == "bullpup" else m.number(0.62, 0.7) * long
    m.add(BASE, *grip(m, k, y + 0.02, -h, 0.8 * half, 0.09))
    trigger(m, y - 0.012, -h, half)
    _magazine(m, k, 0.6 * long if style == "bullpup" else y - 0.105, h, half)
    _stock(m, k, style, long, rear, h, half)
    _handles(m, k, long, h, half, guard)


def _magazine(m: Model, k: Look, y: float, h: float, half: float) -> None:
    """A straight, bent or drum magazine that is pulled down, in a well."""
    deep, wide = m.number(0.07, 0.16), m.number(0.04, 0.06)
    z, bend = -h + 0.012, m.pick(0.0, 0.01, 0.03)
    outline = [(y, z), (y + wide, z), (y + wide - 0.4 * bend, z - 0.5 * deep), (y + wide - 2 * bend, z - deep)]
    outline += [(y - 2 * bend, z - deep - 0.3 * bend), (y - 0.4 * bend, z - 0.5 * deep)]
    if m.chance(0.12):
        m.add("magazine", rod((-0.03, y + 0.5 * wide, z - 0.07), (0.03, y + 0.5 * wide, z - 0.07), 0.05, max(12, k.n)))
        outline = [(y, z), (y + wide, z), (y + wide, z - 0.04), (y, z - 0.04)]
    m.add("magazine", *slab(k, Polygon(outline), 0.7 * half))
    m.slide("magazine", (0, 0, -1), 0.6 * h)
    well = rectangle((y - 0.006, y + wide + 0.006), (-h - 0.012, -h + 0.001))
    m.add(BASE, *(prism(well, "x", (s * 0.85 * half, s * half)) for s in (-1, 1)))
    if m.chance(0.4):
        m.add("magazine_catch", box((-0.005, 0.005), (y + wide + 0.0065, y + wide + 0.011), (-h - 0.016, -h + 0.002)))
        m.hinge("magazine_catch", (0, y + wide + 0.009, -h), (-1, 0, 0), 20)


def _stock(m: Model, k: Look, style: str, long: float, rear: float, h: float, half: float) -> None:
    """A fixed, folding or sliding stock, or a butt plate behind a bullpup."""
    if style == "bullpup":
        m.add(BASE, *k.plate((-half, half), (long, long + 0.015), (-1.3 * h, h), "+y"))
        return
    reach, kind = m.number(0.16, 0.24), m.pick("fixed", "folding", "sliding", "none")
    shape = Polygon(
        [(rear, 0.5 * h), (rear + reach, 0.6 * h), (rear + reach, -2.4 * h), (rear + 0.75 * reach, -2.2 * h), (rear, -0.6 * h)]
    )
    if m.chance(0.4):
        shape = shape.difference(shape.buffer(-0.22 * h * 2))
    if kind == "fixed":
        m.add(BASE, *slab(k, shape, 0.75 * half))
    elif kind == "folding":
        x = half
        m.add(BASE, rod((x, rear + 0.003, -0.9 * h), (x, rear + 0.003, 0.9 * h), 0.007, 8))
        m.add("stock", *slab(k, shape, 0.6 * half))
        m.hinge("stock", (x, rear + 0.003, 0), (0, 0, -1), m.pick(160, 175))
    elif kind == "sliding":
        m.add(BASE, rod((0, rear - 0.002, 0.1 * h), (0, rear + 0.75 * reach, 0.1 * h), 0.011, max(8, k.n)))
        start = rear + m.number(0.3, 0.5) * reach
        butt = Polygon(
            [
                (start, 0.6 * h),
                (rear + reach, 0.6 * h),
                (rear + reach, -2.2 * h),
                (rear + 0.85 * reach, -2.2 * h),
                (start, -0.5 * h),
            ]
        )
        m.add("stock", *slab(k, butt, 0.8 * half))
        m.slide("stock", (0, 1, 0), (-0.25 * reach, 0.2 * reach))


def _handles(m: Model, k: Look, long: float, h: float, half: float, guard: float) -> None:
    """A bolt handle, a selector, a cover, sights that fold, a grip in front, a bipod, a scope."""
    y, z = m.number(0.1, 0.3) * long, m.number(0.3, 0.7) * h
    if m.chance(0.8):
        side = m.pick(1, -1)
        m.add("bolt_handle", rod((side * 0.9 * half, y, z), (side * (half + 0.022), y, z), 0.004, 8))
        m.add("bolt_handle", box((side * half, side * (half + 0.003)), (y - 0.01, y + 0.03), (z - 0.006, z + 0.006)))
        m.slide("bolt_handle", (0, 1, 0), 0.35 * long)
    if m.chance(0.5):
        a = vec(-half - 0.002, 0.75 * long, -0.4 * h)
        m.add(
            "selector",
            rod(a, a + vec(0.004, 0, 0), 0.006, 8),
            box((a[0] - 0.001, a[0] + 0.0015), (a[1] - 0.02, a[1]), (a[2] - 0.003, a[2] + 0.003)),
        )
        m.hinge("selector", a, (-1, 0, 0), m.pick(90, (-45, 45)))
    top = m.pick("scope", "folding", "folding", "posts", "none")
    if top == "scope":
        m.add(BASE, rod((0, 0.1 * long, 1.9 * h), (0, 0.7 * long, 1.9 * h), 0.5 * h, max(8, k.n)))
        m.add(BASE, *(box((-0.004, 0.004), (q * long, q * long + 0.012), (0.98 * h, 1.6 * h)) for q in (0.2, 0.55)))
    elif top == "folding":
        for name, at in (("rear_sight", 0.6 * long), ("front_sight", 0.05 * long)):
            m.add(BASE, box((-0.006, 0.006), (at - 0.008, at + 0.008), (0.9 * h, h + 0.006)))
            m.add(name, box((-0.004, 0.004), (at - 0.002, at + 0.002), (h + 0.004, h + 0.034)))
            m.hinge(name, (0, at, h + 0.006), (-1, 0, 0), 90)
    elif top == "posts":
        m.add(BASE, *(box((-0.002, 0.002), (q, q + 0.008), (0.7 * h, h + 0.02)) for q in (-0.8 * guard, 0.7 * long)))
    under = m.pick("grip", "bipod", "rail", "none")
    if under == "grip":
        m.add(BASE, *k.limb((0, -0.6 * guard, -0.7 * h), (0, -0.6 * guard, -0.7 * h - 0.07), 0.022, 0.026))
    elif under == "bipod":
        m.add(BASE, box((-half, half), (-0.92 * guard, -0.92 * guard + 0.02), (-0.95 * h, -0.5 * h)))
        for s, name in ((-1, "right"), (1, "left")):
            a = vec(s * 0.8 * half, -0.92 * guard + 0.01, -0.9 * h)
            m.add(f"bipod_{name}", *k.limb(a, a + vec(s * 0.05, 0, -0.17), 0.01, 0.01))
            m.hinge(f"bipod_{name}", a, (1, 0, 0), 90)
