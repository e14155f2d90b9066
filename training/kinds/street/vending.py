"""Vending machine and letter boxes."""

from __future__ import annotations

from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang
from training.kinds.solids import box, cut, prism, rectangle, rod, vec
from training.kinds.wheels import lathe


def vending_machine(m: Model) -> None:
    """A cabinet with a big door or a fixed front, shelves, a take-out flap, keys, a coin lever."""
    wide, deep, high, t = m.number(0.7, 1.1), m.number(0.6, 0.85), m.number(1.6, 1.95), 0.05
    opens, solid, gap = m.chance(0.7), m.chance(0.3), abs(m.gap(0.6))
    case = box((0, wide), (0, deep), (0.06, high))
    m.add(BASE, case if solid else cut(case, box((t, wide - t), (-1, deep - t), (0.06 + t, high - t))))
    m.add(BASE, *(box((x, x + 0.06), (y, y + 0.06), (0, 0.06)) for x in (0.03, wide - 0.09) for y in (0.03, deep - 0.09)))
    front, x, z = ("door" if opens else BASE), (gap, wide - gap), (0.06 + gap, high - gap)
    split, y = 0.72 * wide, (-0.08, -0.001)
    flap = (0.12 * wide, split - 0.05), (0.2, 0.2 + m.number(0.15, 0.22))
    glass = (0.07, split), (0.55, high - 0.1)
    outline = rectangle(x, z)
    if m.chance(0.7):
        outline = outline.difference(rectangle(*glass))
        m.add(front, box((glass[0][0] - 0.002, glass[0][1] + 0.002), (-0.05, -0.045), glass[1]))
    hole = m.chance(0.6)
    m.add(front, prism(outline.difference(rectangle(*flap)) if hole else outline, "y", y))
    if opens:
        hang(m, "door", x, y, z, m.pick("left", "left", "right"), OUT, 110)
    if not solid:
        rows, cols = m.pick(4, 5, 6), m.pick(4, 6)
        for k in range(rows):
            h = 0.58 + k * (high - 0.75) / rows
            m.add(BASE, box((t, split), (0.03, deep - 0.1), (h, h + 0.015)))
            for c in range(cols):
                a = 0.09 + c * (split - 0.1) / cols
                m.add(BASE, rod((a + 0.03, 0.1, h + 0.015), (a + 0.03, 0.1, h + 0.13), 0.03, 8))
    in_y = (-0.06, -0.05) if hole else (-0.09, -0.08)
    m.add("flap", box((flap[0][0] + gap, flap[0][1] - gap), in_y, (flap[1][0] + gap, flap[1][1] - gap)))
    if m.chance(0.4):
        m.add("flap", box((0.4 * split, 0.5 * split), (in_y[0] - 0.02, in_y[0]), (flap[1][0] + 0.03, flap[1][0] + 0.05)))
    inward = m.chance(0.5) and hole
    m.hinge("flap", (wide / 2, in_y[0], flap[1][1]), (1, 0, 0) if inward else (-1, 0, 0), 70, front)
    a = split + 0.03
    for r in range(m.pick(3, 4)):
        for c in range(3):
            u, v = a + 0.045 * c, high - 0.55 - 0.05 * r
            if u + 0.035 < wide - 0.02:
                m.add(f"key_{r}{c}", box((u, u + 0.035), (-0.088, -0.078), (v, v + 0.035)))
                m.slide(f"key_{r}{c}", (0, 1, 0), 0.006, front)
    m.add(
        front,
        box((a, wide - 0.03), (-0.084, -0.08), (high - 0.45, high - 0.3)),
        box((a + 0.02, a + 0.09), (-0.1, -0.08), (0.95, 1.05)),
    )
    if m.chance(0.6):
        m.add("coins", box((a + 0.01, a + 0.11), (-0.092, -0.08), (0.62, 0.74)))
        m.hinge("coins", (a + 0.06, -0.09, 0.74), (-1, 0, 0), 50, front)
    if m.chance(0.5):
        at = vec(a + 0.05, -0.08, 0.85)
        m.add(
            "lever",
            rod(at, at + vec(0, -0.03, 0), 0.012, 10),
            box((at[0] - 0.008, at[0] + 0.05), (-0.112, -0.1), (0.842, 0.858)),
        )
        m.hinge("lever", at, (0, 1, 0), 45, front)


def mailbox_post(m: Model) -> None:
    """A pillar box or a locker bank of letter boxes: slot flaps, doors, a sign and feet that stay."""
    if m.chance(0.5):
        r, high, n = m.number(0.2, 0.3), m.number(1.1, 1.6), m.pick(16, 24, 40)
        square = m.chance(0.4)
        body = box((-r, r), (-r, r), (0, high)) if square else rod((0, 0, 0), (0, 0, high), r, n)
        m.add(
            BASE,
            body,
            *(
                [box((-1.06 * r, 1.06 * r), (-1.06 * r, 1.06 * r), (high, high + 0.06))]
                if square
                else [lathe([(0, 0), (1.1 * r, 0), (1.1 * r, 0.05), (0.6 * r, 0.14), (0, 0.17)], n, (0, 0, high))]
            ),
        )
        m.add(BASE, rod((0, 0, 0), (0, 0, 0.1), 1.45 * r if square else 1.1 * r, n))
        front = -r - 0.012
        z, w = high - 0.25, 0.6 * r
        m.add(BASE, box((-w - 0.02, w + 0.02), (front - 0.01, -0.7 * r), (z - 0.06, z + 0.08)))
        m.add("slot", box((-w, w), (front - 0.025, front - 0.012), (z - 0.04, z + 0.05)))
        m.hinge("slot", (0, front - 0.025, z + 0.05), (-1, 0, 0), 60)
        x, low = (-0.65 * r, 0.65 * r), 0.3
        m.add("door", box(x, (front, -0.7 * r), (low, high - 0.4)))
        m.add("door", rod((0.5 * r, front - 0.01, 0.5 * high), (0.5 * r, front, 0.5 * high), 0.02, 10))
        if m.chance(0.5):
            m.add("door", box((-0.4 * r, 0.4 * r), (front - 0.006, front), (0.4, 0.55)))
        side = m.pick(-1, 1)
        m.hinge("door", (side * 0.65 * r, front, 0.6), (0, 0, side), 110)
        return
    rows, cols, w, h = m.pick(1, 2, 4), m.pick(1, 2, 3), m.number(0.28, 0.4), m.number(0.12, 0.35)
    low, deep = m.number(0.6, 1.0), m.number(0.25, 0.4)
    wide, top = cols * w, low + rows * h
    case = box((0, wide), (0, deep), (low, top))
    if m.chance(0.6):
        case = cut(
            case,
            *(
                box((c * w + 0.015, (c + 1) * w - 0.015), (-1, deep - 0.02), (low + r * h + 0.012, low + (r + 1) * h - 0.012))
                for r in range(rows)
                for c in range(cols)
            ),
        )
    m.add(BASE, case)
    side, slot, gap = m.pick("left", "right", "bottom", "top"), m.chance(0.6), abs(m.gap(0.3))
    for r in range(rows):
        for c in range(cols):
            x, z, name = (
                (c * w + 0.008 + gap, (c + 1) * w - 0.008),
                (low + r * h + 0.006, low + (r + 1) * h - 0.006 - gap),
                f"door_{r}{c}",
            )
            m.add(
                name, box(x, (-0.012, 0), z), rod((sum(x) / 2, -0.02, z[0] + 0.03), (sum(x) / 2, -0.012, z[0] + 0.03), 0.008, 8)
            )
            m.add(name, box((x[0] + 0.05, x[0] + 0.12), (-0.015, -0.012), (z[0] + 0.02, z[0] + 0.04)))
            hang(m, name, x, (-0.012, 0), z, side, OUT, 100)
            if slot:
                m.add(f"slot_{r}{c}", box((x[0] + 0.04, x[1] - 0.04), (-0.019, -0.0125), (z[1] - 0.05, z[1] - 0.015)))
                m.hinge(f"slot_{r}{c}", (sum(x) / 2, -0.019, z[1] - 0.015), (-1, 0, 0), 60, name)
    m.add(
        BASE,
        *(
            box((x - 0.025, x + 0.025), (deep / 2 - 0.025, deep / 2 + 0.025), (0, low))
            for x in ((0.15 * wide, 0.85 * wide) if cols > 1 else (wide / 2,))
        ),
    )
    if m.chance(0.5):
        m.add(BASE, prism([(-0.04, top), (deep, top), (deep, top + 0.1), (-0.04, top + 0.03)], "x", (-0.03, wide + 0.03)))
