"""Document scanners and paper shredders."""

from __future__ import annotations

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, cable
from training.kinds.model import BASE, Model
from training.kinds.panels import sheet
from training.kinds.solids import Span, box, cut, prism, rod, rounded, tube, turned, vec
from training.kinds.wheels import caster


def document_scanner(m: Model) -> None:
    """A flat bed under a lid, one with a feeder on its lid, or an upright feeder with trays that fold out."""
    if m.chance(0.4):
        _feeder(m)
        return
    long_side = m.chance(0.5)
    x, y = ((0.0, 0.42), (0.0, 0.28)) if long_side else ((0.0, 0.28), (0.0, 0.44))
    x, y = (0.0, x[1] * m.number(0.92, 1.08)), (0.0, y[1] * m.number(0.92, 1.08))
    foot, top = 0.006, m.number(0.035, 0.09)
    front = m.pick(0.0, 0.03, 0.05)  # a strip for buttons before the lid
    body = prism(rounded(x, y, m.pick(0.003, 0.02)), "z", (foot, top))
    well = box(shrunk(x, 0.03), (y[0] + front + 0.025, y[1] - 0.035), (top - 0.004, top + 1))
    m.add(BASE, cut(body, well))
    if m.chance(0.6):
        m.add(BASE, box(shrunk(x, 0.03), (y[0] + front + 0.025, y[1] - 0.035), (top - 0.005, top - 0.003)))
    m.add(BASE, *(rod((a, b, 0), (a, b, foot), 0.012, 8) for a in shrunk(x, 0.03) for b in shrunk(y, 0.03)))
    side = "left" if long_side and m.chance(0.25) else "rear"
    lx, ly, gap = x, (y[0] + front, y[1] - m.pick(0.0, 0.01)), max(m.gap(0.3), 0.0)
    thick = m.number(0.012, 0.03)
    z = (top + gap, top + gap + thick)
    lid = prism(rounded(lx, ly, m.pick(0.003, 0.015)), "z", z)
    m.add("lid", cut(lid, box(shrunk(lx, 0.01), shrunk(ly, 0.01), (z[0] - 1, z[0] + 0.006))) if m.chance(0.4) else lid)
    if side == "rear":
        m.hinge("lid", (x[1] / 2, ly[1], top), (-1, 0, 0), m.pick(75, 90, 100))
        for a in (0.2 * x[1], 0.8 * x[1]) if m.chance(0.6) else ():
            m.add(m.pick(BASE, "lid"), rod((a - 0.02, ly[1], top), (a + 0.02, ly[1], top), 0.006, 10))
    else:
        m.hinge("lid", (lx[0], y[1] / 2, top), (0, -1, 0), m.pick(80, 95))
    if m.chance(0.5):
        m.add("lid", box((0.4 * x[1], 0.6 * x[1]), (ly[0] - 0.006, ly[0]), (z[0] + 0.002, z[1])))
    if side == "rear" and m.chance(0.45):
        _lid_feeder(m, shrunk(lx, 0.02), (ly[0] + 0.1, ly[1] - 0.02), z[1])
    elif m.chance(0.6):
        m.add("lid", box((0.1 * x[1], 0.3 * x[1]), (ly[0] + 0.04, ly[0] + 0.06), (z[1], z[1] + 0.001)))
    if front > 0:
        for k in range(m.pick(1, 3, 4, 5)):
            button(m, f"button_{k}", (x[1] - 0.04 - 0.03 * k, front / 2, top), (0, 0, 1), 0.012)
        if m.chance(0.4):
            m.add(BASE, box((0.03, 0.1), (0.006, front - 0.006), (top, top + 0.001)))
    if m.chance(0.3):
        cable(m, (0.2 * x[1], y[1], 0.5 * top), 0.15)


def _lid_feeder(m: Model, x: Span, y: Span, z: float) -> None:
    """A feeder on a lid: a hump at the left with a cover that lifts, and a tray for the sheets that lifts at its edge."""
    high, c = m.number(0.05, 0.08), x[0] + 0.35 * (x[1] - x[0])
    m.add("lid", box((x[0], c), y, (z, z + high - 0.012)))
    m.add("lid", box((c, x[1]), y, (z, z + 0.012)))
    m.add("feeder_cover", prism([(x[0], z + high - 0.012), (c - 0.002, z + high - 0.012), (c - 0.002, z + high - 0.004),
                                 (x[0] + 0.02, z + high + 0.01), (x[0], z + high)], "y", shrunk(y, 0.003)))  # fmt: skip
    m.hinge("feeder_cover", (x[0], y[0], z + high - 0.012), (0, -1, 0), m.pick(60, 85), "lid")
    s = z + high - 0.025
    tray = box((c, x[1] + 0.03), shrunk(y, 0.02), (s, s + 0.006))
    rails = [box((c + 0.03, c + 0.1), (b, b + 0.006), (s + 0.006, s + 0.02)) for b in shrunk(y, 0.05)]
    m.add("sheet_tray", *(turned(p, (0, 1, 0), -8, (c, 0, s)) for p in [tray, *rails]))
    m.hinge("sheet_tray", (c, y[0], s), (0, -1, 0), m.pick(40, 60), "lid")


def _feeder(m: Model) -> None:
    """A feeder that stands upright: its lid unfolds to a chute, its front folds down to catch the sheets."""
    wide, deep, high = m.number(0.27, 0.32), m.number(0.13, 0.18), m.number(0.13, 0.18)
    x, lean, low = (0.0, wide), m.number(0.03, 0.06), m.number(0.5, 0.8)
    side = [(0, 0.004), (deep, 0.004), (deep, high), (deep - 0.03, high), (lean, low * high)]
    m.add(BASE, prism(side, "x", x))
    m.add(BASE, box((0.02, wide - 0.02), (0.02, deep - 0.02), (0, 0.005)))
    t, d = m.number(0.006, 0.012), vec(0, deep - 0.03 - lean, (1 - low) * high)
    d = d / (d[1] ** 2 + d[2] ** 2) ** 0.5
    n = vec(0, -d[2], d[1])
    a, b = vec(0, lean, low * high) + 0.001 * n, vec(0, deep - 0.03, high) + 0.001 * n
    plate = [p[1:] for p in (a, b, b + t * n, a + t * n)]
    m.add("chute", prism(plate, "x", shrunk(x, m.pick(0.0, 0.015))))
    m.hinge("chute", (0, *(b + t * n)[1:]), (-1, 0, 0), m.number(95, 120))
    if m.chance(0.6):
        inner = shrunk(x, 0.06)
        c = [p[1:] for p in (a + 0.03 * d + t * n, b - 0.01 * d + t * n, b - 0.01 * d + (t + 0.003) * n,
                             a + 0.03 * d + (t + 0.003) * n)]  # fmt: skip
        m.add("extension", prism(c, "x", inner))
        m.slide("extension", -d, m.number(0.05, 0.08), "chute")
    f = vec(0, lean, low * high - 0.004)
    up = f / (f[1] ** 2 + f[2] ** 2) ** 0.5
    out = vec(0, -up[2], up[1])
    p, q = 0.04 * up + 0.001 * out, 0.98 * f + 0.001 * out
    p, q = p + vec(0, 0, 0.004), q + vec(0, 0, 0.004)
    m.add("catcher", prism([s[1:] for s in (p, q, q + t * out, p + t * out)], "x", shrunk(x, m.pick(0.02, 0.04))))
    m.hinge("catcher", (0, *(p + t * out)[1:]), (1, 0, 0), m.number(75, 100))
    for k in range(m.pick(1, 2)):
        button(m, f"button_{k}", 0.4 * f + vec(wide - 0.012, 0, k * 0.025), (0, -1, 0), 0.012)
    if m.chance(0.5):
        cable(m, (0.3 * wide, deep, 0.03), 0.15)


def paper_shredder(m: Model) -> None:
    """A cutting head on a bin: it lifts off, or the bin pulls out like a drawer or stands behind a door; slots, switches."""
    style = m.pick("lift", "lift", "drawer", "drawer", "door", "basket")
    big = style == "door" or (style == "drawer" and m.chance(0.4))
    wide, deep = (m.number(0.4, 0.55), m.number(0.32, 0.45)) if big else (m.number(0.28, 0.38), m.number(0.17, 0.28))
    high, head = (m.number(0.6, 0.95), m.number(0.12, 0.18)) if big else (m.number(0.34, 0.48), m.number(0.08, 0.12))
    low, x, y = 0.06 if big or m.chance(0.4) else 0.008, (0.0, wide), (0.0, deep)
    z, top = (low, high - head), high
    if low > 0.02:
        for k, (a, b) in enumerate((a, b) for a in shrunk(x, 0.05) for b in shrunk(y, 0.05)):
            caster(m, f"caster_{k}", (a, b, low), 0.022, m.chance(0.5))
    else:
        m.add(BASE, *(rod((a, b, 0), (a, b, low), 0.015, 8) for a in shrunk(x, 0.03) for b in shrunk(y, 0.03)))
    part = BASE if style in ("drawer", "door") else "head"
    if style in ("lift", "basket"):
        _bin(m, BASE, shrunk(x, 0.006), shrunk(y, 0.006), z, style == "basket")
        m.slide("head", (0, 0, 1), m.number(0.1, 0.25))
    else:
        wall = 0.006
        m.add(BASE, cut(box(x, y, z), box(shrunk(x, wall), (-1, deep - wall), shrunk(z, wall))))
        _bin_front(m, style, shrunk(x, wall), deep, shrunk(z, wall))
    _head(m, part, x, y, (z[1], top))
    if m.chance(0.4):
        cable(m, (0.7 * wide, deep, 0.8 * high if part == BASE else 0.5 * low + 0.02), 0.2)


def _bin(m: Model, part: str, x: Span, y: Span, z: Span, wire: bool) -> None:
    """An open bin of thin walls, or one of wire."""
    if wire:
        m.add(part, box(x, y, (z[0], z[0] + 0.005)))
        n, r = m.pick(6, 9), 0.002
        ends = [(x[0] + (x[1] - x[0]) * k / n, b) for k in range(n + 1) for b in y]
        ends += [(a, y[0] + (y[1] - y[0]) * k / 4) for k in (1, 2, 3) for a in x]
        m.add(part, *(rod((a, b, z[0]), (a, b, z[1]), r, 6) for a, b in ends))
        for c in (z[0] + 0.5 * (z[1] - z[0]), z[1] - 0.004):
            m.add(part, tube([(x[0], y[0], c), (x[1], y[0], c), (x[1], y[1], c), (x[0], y[1], c), (x[0], y[0], c)], r, 6))
        return
    body = cut(prism(rounded(x, y, 0.015), "z", z), box(shrunk(x, 0.004), shrunk(y, 0.004), (z[0] + 0.004, z[1] + 1)))
    m.add(part, body)
    if m.chance(0.5):
        a = (x[0] + x[1]) / 2
        m.add(part, box((a - 0.03, a + 0.03), (y[0] - 0.001, y[0]), (z[0] + 0.3 * (z[1] - z[0]), z[0] + 0.8 * (z[1] - z[0]))))


def _bin_front(m: Model, style: str, x: Span, deep: float, z: Span) -> None:
    """What shuts the room below the head: a bin with a front that slides out, or a door before a loose bin."""
    c, y = max(m.gap(0.3), 0.001), m.pick((-0.012, 0.0), (0.0, 0.012))
    a, b = (x, z) if y[0] == 0 else ((x[0] - 0.006, x[1] + 0.006), (z[0] - 0.006, z[1]))
    a, b, mid = shrunk(a, c), shrunk(b, c), (x[0] + x[1]) / 2
    part = "bin" if style == "drawer" else "door"
    m.add(part, box(a, y, b))
    if style == "drawer":
        if m.chance(0.8):
            _bin(m, part, shrunk(x, 0.012), (y[1], deep - 0.02), (z[0] + 0.004, z[0] + 0.85 * (z[1] - z[0])), m.chance(0.1))
        m.slide(part, (0, -1, 0), m.number(0.5, 0.85) * deep)
        m.add(part, box((mid - 0.05, mid + 0.05), (y[0] - 0.012, y[0]), (b[1] - 0.03, b[1] - 0.015)))
    else:
        _bin(m, BASE, shrunk(x, 0.02), (0.03, deep - 0.02), (z[0], z[0] + 0.75 * (z[1] - z[0])), False)
        s = m.pick(-1, 1)
        h, e = (a[0], a[1] - 0.03) if s < 0 else (a[1], a[0] + 0.03)
        m.hinge(part, (h, y[0], z[0]), (0, 0, s), m.number(95, 120))
        m.add(part, box((e - 0.008, e + 0.008), (y[0] - 0.02, y[0]), (b[1] - 0.14, b[1] - 0.04)))
    if m.chance(0.5):
        m.add(part, sheet((mid - 0.03, mid + 0.03), y[0] - 0.001, (b[0] + 0.3 * (b[1] - b[0]), b[0] + 0.6 * (b[1] - b[0]))))


def _head(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """The cutting head: slots for sheets and cards, a switch or keys, a grip, perhaps a cover over the slot."""
    mid, c = (y[0] + y[1]) / 2, m.number(0.45, 0.6)
    body = prism(rounded(x, y, m.pick(0.004, 0.025)), "z", z)
    slot = y[0] + c * (y[1] - y[0])
    holes = [box(shrunk(x, 0.03), (slot - 0.004, slot + 0.004), (z[1] - 0.05, z[1] + 1))]
    if m.chance(0.4):
        holes.append(box((x[0] + 0.08, x[0] + 0.21), (slot - 0.045, slot - 0.04), (z[1] - 0.03, z[1] + 1)))
    m.add(part, cut(body, *holes))
    for k in range(m.pick(1, 2, 3)):
        button(m, f"key_{k}", (x[1] - 0.035 - 0.03 * k, y[0] + 0.03, z[1]), (0, 0, 1), 0.016, part)
    if m.chance(0.4):
        m.add(part, box((x[0] + 0.03, x[0] + 0.09), (y[0] - 0.001, y[0]), (z[0] + 0.03, z[0] + 0.045)))
    if m.chance(0.35):
        at = (slot + 0.016, z[1])
        m.add("slot_cover", box(shrunk(x, 0.025), (slot - 0.016, at[0]), (z[1] + 0.0005, z[1] + 0.006)))
        m.hinge("slot_cover", (mid, *at), (-1, 0, 0), m.pick(80, 100), part)
