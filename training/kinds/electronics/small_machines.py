"""Label printers and walkie-talkies."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot

from training.kinds.electronics.controls import button as key
from training.kinds.electronics.controls import knob
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, cable, feet, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, rectangle, rod, rounded, tube, vec
from training.kinds.wheels import lathe, upright


def label_printer(m: Model) -> None:
    """A desk printer whose lid lifts off a roll, a large one with a side that folds up, or a hand-held one with keys."""
    {"desk": _desk_printer, "side": _side_printer, "hand": _hand_printer}[m.pick("desk", "desk", "side", "hand")](m)


def _roll(m: Model, part: str, x: Span, y: float, z: float, radius: float) -> None:
    """A roll of labels that turns on a spindle along x."""
    core = Dot(0, 0).buffer(0.3 * radius)
    m.add(part, *upright([prism(Dot(0, 0).buffer(radius).difference(core), "z", x)], (1, 0, 0), (0, y, z)))
    m.add(BASE, rod((x[0] - 0.01, y, z), (x[1] + 0.01, y, z), 0.25 * radius, 10))
    m.spin(part, (middle(x), y, z), (1, 0, 0))


def _desk_printer(m: Model) -> None:
    """The upper half of the case is hinged at the rear; the label leaves through a slot in front."""
    wide, deep, high = m.number(0.12, 0.24), m.number(0.17, 0.26), m.number(0.13, 0.2)
    x, y, part_line, wall = (0.0, wide), (0.0, deep), m.number(0.4, 0.6) * high, 0.006
    bend, gap = m.number(0.15, 0.5) * deep, max(m.gap(0.2), 0.0005)
    lower = [(0.0, 0.006), (deep, 0.006), (deep, part_line), (0.0, part_line)]
    m.add(BASE, cut(prism(lower, "x", x), box(shrunk(x, wall), (0.03, deep - wall), (0.015, 1))))
    m.add(BASE, *(rod((a, b, 0), (a, b, 0.008), 0.008, 8) for a in shrunk(x, 0.02) for b in shrunk(y, 0.02)))
    low = part_line + gap
    line = [(0.0, low), (deep, low), (deep, high - 0.01), (deep - 0.02, high), (bend, high), (0.012, low + 0.3 * (high - low))]
    hollow = [
        (0.03, low - 1),
        (deep - wall, low - 1),
        (deep - wall, high - 0.02),
        (bend + 0.01, high - wall),
        (0.03, low + 0.01),
    ]
    m.add("lid", cut(prism(line, "x", x), prism(hollow, "x", shrunk(x, wall))))
    m.hinge("lid", (wide / 2, deep, low), (-1, 0, 0), m.number(60, 90))
    radius = min(0.3 * deep, 0.42 * (high - 0.03))
    _roll(m, "roll", shrunk(x, m.number(0.016, 0.03)), 0.58 * deep, 0.02 + radius, radius)
    m.add(BASE, rod((0.012, 0.034, part_line - 0.004), (wide - 0.012, 0.034, part_line - 0.004), 0.006, 12))
    m.add(BASE, box(shrunk(x, 0.02), (-0.03, 0.0), (part_line - 0.001, part_line)) if m.chance(0.3)
          else box(shrunk(x, 0.02), (-0.001, 0.0), (part_line - 0.006, part_line - 0.002)))  # fmt: skip
    trims(m, BASE, x, 0.0, (0.01, part_line - 0.01))
    if m.chance(0.4):
        m.add("front_bar", box(shrunk(x, 0.015), (-0.006, -0.0005), (0.03, part_line - 0.01)))
        m.hinge("front_bar", (wide / 2, -0.003, 0.03), (1, 0, 0), m.number(70, 95))
    for k in range(m.pick(1, 1, 2, 3)):
        if bend > 0.3 * deep:
            at = vec(wide - 0.02 - 0.022 * k, 0.7 * deep, high)
            button(m, f"button_{k}", at, (0, 0, 1), 0.013, "lid")
        else:
            button(m, f"button_{k}", (wide - 0.012 - 0.018 * k, 0, 0.02), (0, -1, 0), 0.012)
    for k, a in enumerate((0.0, wide)) if m.chance(0.6) else ():  # latches at both sides
        s = 2 * k - 1
        m.add(f"latch_{k}", box((a, a + s * 0.005), (0.03, 0.055), (part_line - 0.02, part_line + 0.012)))
        m.slide(f"latch_{k}", (0, -1, 0), 0.01)
    if m.chance(0.4):
        cable(m, (0.3 * wide, deep, 0.03), 0.12)


def _side_printer(m: Model) -> None:
    """A steel case whose right half is a cover hinged along the top; behind it a roll, a spindle and a lever for the head."""
    wide, deep, high = m.number(0.24, 0.3), m.number(0.4, 0.5), m.number(0.3, 0.4)
    wall, keep, s = 0.012, m.number(0.08, 0.12), 1
    m.add(BASE, box((0, keep), (0, deep), (0.02, high)), box((keep, wide), (0, deep), (0.02, 0.035)))
    feet(m, (0, wide), (0, deep), 0.021)
    gap, drop = max(m.gap(0.2), 0.001), m.number(0.0, 0.05)
    x, z = (keep + gap, wide), (0.036, high)
    cover = cut(box(x, (0, deep), z), box((keep - 1, wide - wall), (wall, deep - wall), (0, high - wall)),
                box((keep - 1, wide - 0.03), (-1, wall + 0.01), (0, 0.09 + drop)))  # fmt: skip
    window = box((0, wide + 1), (0.12, deep - 0.1), (0.12, high - 0.08))
    m.add("cover", cut(cover, window) if m.chance(0.6) else cover)
    m.hinge("cover", (keep + gap, deep / 2, high), (0, -s, 0), m.number(95, 150))
    r = m.number(0.07, 0.1)
    _roll(m, "roll", (keep + 0.012, wide - 0.03), deep - r - 0.03, 0.5 * high, r)
    m.add(
        BASE,
        box((keep, wide - 0.03), (0.03, 0.1), (0.035, 0.1)),
        rod((keep, 0.06, 0.105), (wide - 0.035, 0.06, 0.105), 0.012, 12),
    )
    m.add("head_lever", box((wide - 0.045, wide - 0.02), (0.05, 0.065), (0.11, 0.17)), rod((keep, 0.057, 0.13),
          (wide - 0.02, 0.057, 0.13), 0.008, 8))  # fmt: skip
    m.hinge("head_lever", (keep, 0.057, 0.125), (1, 0, 0), m.number(45, 80))
    m.add(BASE, box((0.012, keep - 0.012), (-0.002, 0), (high - 0.1, high - 0.04)))
    for k in range(m.pick(3, 4, 6)):
        button(m, f"button_{k}", (0.025 + 0.025 * (k % 3), 0, high - 0.13 - 0.025 * (k // 3)), (0, -1, 0), 0.014)


def _hand_printer(m: Model) -> None:
    """A label maker held in two hands: rows of keys, a screen, a lever that cuts, a cover over the cassette at the back."""
    wide, long, thick = m.number(0.09, 0.12), m.number(0.16, 0.21), m.number(0.035, 0.05)
    x, y = (0.0, wide), (0.0, long)
    tall = m.pick(True, False)
    if not tall:
        x, y = (0.0, long), (0.0, 0.9 * wide)
    outline = rounded(x, y, m.number(0.008, 0.03))
    m.add(BASE, prism(outline, "z", (0.012, thick)))
    b = y[1] - 0.3 * (y[1] - y[0])
    m.add(BASE, box(shrunk(x, 0.2 * x[1]), (b, y[1] - 0.02), (thick, thick + m.pick(0.001, 0.004))))
    columns, rows = (6, 5) if tall else (10, 3)
    across, down = shrunk(x, 0.012), (0.012, b - 0.01)
    skipped, k, style = m.rng.random((columns, rows)) < 0.1, 0, m.pick("box", "rounded", "disc", "taper")
    for i in range(columns):
        for j in range(rows):
            a, c = (across[0] + (across[1] - across[0]) * (i + t) / columns for t in (0.12, 0.88))
            d, e = (down[0] + (down[1] - down[0]) * (j + t) / rows for t in (0.15, 0.85))
            if not skipped[i, j]:
                key(m, f"key_{k}", (a, c), (d, e), thick, 0.003, BASE, style)
                k += 1
    cover = shrunk(x, 0.008), (y[0] + m.number(0.3, 0.5) * y[1], y[1] - 0.008)
    m.add("cover", prism(rounded(*cover, 0.006), "z", (0.0, 0.0118)))
    m.add(BASE, box(shrunk(x, 0.006), (y[0] + 0.012, cover[1][0] - 0.001), (0, 0.0118)))
    m.hinge("cover", (middle(x), cover[1][0], 0.0), (-1, 0, 0), m.number(90, 120))
    side = m.pick(0, 1)
    a = x[side]
    m.add(
        "cutter",
        box(
            (a - 0.003, a + 0.008) if side else (a - 0.008, a + 0.003),
            (y[1] - 0.04, y[1] - 0.012),
            (thick - 0.016, thick - 0.006),
        ),
    )
    m.slide("cutter", (1 - 2 * side, 0, 0), 0.007)
    m.add(
        BASE, box((middle(x) - 0.01, middle(x) + 0.01), (y[1], y[1] + m.pick(0.001, 0.04)), (0.5 * thick, 0.5 * thick + 0.0006))
    )


def walkie_talkie(m: Model) -> None:
    """A hand-held radio: a body with a grille, an aerial, knobs on its top, a key to talk at its side, a clip, a battery."""
    wide, deep, high = m.number(0.05, 0.065), m.number(0.028, 0.04), m.number(0.1, 0.15)
    x, z, n = (0.0, wide), (0.0, high), m.sections()
    shape = m.pick("straight", "waist", "round")
    waist = [(0.004, 0), (wide - 0.004, 0), (wide - 0.004, 0.62 * high), (wide, 0.72 * high), (wide, high - 0.006),
             (wide - 0.006, high), (0.006, high), (0, high - 0.006), (0, 0.72 * high), (0.004, 0.62 * high)]  # fmt: skip
    outline = {"straight": rectangle(x, z), "waist": waist, "round": rounded(x, z, 0.012)}[shape]
    pack = m.pick("slides", "swings", "fixed")
    back = 0.6 * deep
    body = prism(outline, "y", (0, back if pack != "fixed" else deep))
    right, r = m.chance(0.5), m.number(0.004, 0.006)
    root, pulls_out = vec(wide - 0.012 if right else 0.012, 0.3 * deep, high), m.chance(0.25)
    m.add(BASE, cut(body, rod(root + vec(0, 0, 0.1), root - vec(0, 0, 0.8 * high), r, 12)) if pulls_out else body)
    if pack != "fixed":  # the battery, or the cover over the cells
        m.add(BASE, box((0.004, wide - 0.004), (back, deep), (0.8 * high, high - 0.006)))
        m.add("battery", prism(rounded((0.004, wide - 0.004), (0.0, 0.8 * high - 0.0015), 0.003), "y", (back + 0.0005, deep)))
        if pack == "slides":
            m.slide("battery", (0, 0, -1), m.number(0.3, 0.6) * high)
        else:
            m.hinge("battery", (wide / 2, deep, 0.0), (-1, 0, 0), m.number(60, 90))
    _talk_front(m, wide, high)
    if pulls_out:
        low, out = root - vec(0, 0, 0.78 * high), m.number(0.004, 0.03)
        m.add("aerial", *(rod(low, root + vec(0, 0, f * out), g * r, 10) for f, g in ((0.3, 0.8), (0.6, 0.6), (1.0, 0.4))))
        m.add("aerial", rod(root + vec(0, 0, out), root + vec(0, 0, out + 0.004), 0.7 * r, 10))
        m.slide("aerial", (0, 0, 1), 0.7 * high)
    else:
        length = m.number(0.05, 0.17)
        profile = [(0, 0), (1.4 * r, 0), (1.4 * r, 0.014), (r, 0.018), (0.7 * r, length), (0, length)]
        m.add(BASE, lathe(profile, n, root))
    for k in range(m.pick(1, 1, 2)):
        a = (0.012 if right else wide - 0.012) + (1 if right else -1) * 0.017 * k
        knob(m, f"knob_{k}", (a, 0.4 * deep, high), (0, 0, 1), m.number(0.005, 0.007))
    _talk_side(m, (wide, deep, high), shape, pack, back)


def _talk_side(m: Model, size: tuple[float, float, float], shape: str, pack: str, back: float) -> None:
    """The key to talk, a cover over the jacks, a clip or a loop at the back."""
    wide, deep, high = size
    s, low = m.pick(-1, 1), m.number(0.6, 0.68) * high
    face = (0.0 if shape != "waist" else 0.002) if s < 0 else wide - (0.0 if shape != "waist" else 0.002)
    m.add(
        "talk_key",
        box(
            (face - 0.002, face + 0.003) if s > 0 else (face - 0.003, face + 0.002),
            (0.006, back - 0.004),
            (low, low + m.number(0.02, 0.035)),
        ),
    )
    m.slide("talk_key", (-s, 0, 0), 0.002)
    if m.chance(0.6):
        _clip(m, wide, deep, high, "battery" if pack == "slides" and m.chance(0.5) else BASE, pack)
    elif m.chance(0.5):
        ends = [
            (-0.006, deep - 0.002, 0.01),
            (-0.012, deep + 0.012, 0.05),
            (0.012, deep + 0.012, 0.05),
            (0.006, deep - 0.002, 0.01),
        ]
        m.add(BASE, tube([(wide / 2 + c, d, high - e) for c, d, e in ends], 0.0015, 6))
    if m.chance(0.4):
        m.add(
            "jack_cover",
            box((wide if s < 0 else -0.002, wide + 0.002 if s < 0 else 0.0), (0.006, 0.02), (0.72 * high, 0.72 * high + 0.02)),
        )
        m.hinge("jack_cover", (wide if s < 0 else 0.0, 0.02, 0.72 * high), (0, 0, 1 if s < 0 else -1), m.number(80, 110))


def _clip(m: Model, wide: float, deep: float, high: float, part: str, pack: str) -> None:
    """A belt clip at the back that is pressed open against its spring."""
    top = (0.78 if part == "battery" else 0.9) * high
    c, low = wide / 2, top - m.number(0.4, 0.55) * high
    lug = (top - 0.012, top)
    m.add(part, box((c - 0.01, c + 0.01), (deep - 0.001, deep + 0.005), lug))
    m.add("clip", box((c - 0.008, c + 0.008), (deep + 0.005, deep + 0.008), (low, top + 0.008)))
    m.add("clip", rod((c - 0.012, deep + 0.006, top - 0.006), (c + 0.012, deep + 0.006, top - 0.006), 0.002, 8))
    m.hinge("clip", (c, deep + 0.006, top - 0.006), (1, 0, 0), m.number(12, 25), part)


def _talk_front(m: Model, wide: float, high: float) -> None:
    """The front: holes or slats for the loudspeaker, a screen and keys or none, a label."""
    low = 0.0
    if m.chance(0.6):
        m.add(BASE, box(shrunk((0.0, wide), 0.012), (-0.001, 0), (0.62 * high, 0.78 * high)))
        rows, columns = m.pick((4, 3), (2, 3), (1, 4))
        style, k = m.pick("box", "disc"), 0
        for i in range(columns):
            for j in range(rows):
                a = 0.012 + (wide - 0.024) * (i + 0.5) / columns
                b = 0.58 * high - (0.4 * high) * (j + 0.5) / 4
                w = 0.35 * (wide - 0.024) / columns
                m.add(f"key_{k}", box((a - w, a + w), (-0.002, 0.001), (b - 0.004, b + 0.004)) if style == "box"
                      else rod((a, 0.001, b), (a, -0.002, b), min(w, 0.004), 10))  # fmt: skip
                m.slide(f"key_{k}", (0, 1, 0), 0.0015)
                k += 1
        low = 0.82 * high
    span = (low + 0.006, high - 0.012) if low else (0.35 * high, 0.85 * high)
    for c in np.linspace(*span, 3 if low else m.pick(5, 8)):
        m.add(BASE, box(shrunk((0.0, wide), 0.014), (-0.0015, 0), (c - 0.0012, c + 0.0012)))
    if not low and m.chance(0.7):
        m.add(BASE, box(shrunk((0.0, wide), 0.018), (-0.0008, 0), (0.12 * high, 0.22 * high)))
