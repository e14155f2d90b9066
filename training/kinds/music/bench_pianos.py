"""A small upright piano with a fall board, a lid, keys and pedals."""

from __future__ import annotations

import numpy as np

from training.kinds.bench_style import STYLES, body, lathe, plane, without
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rectangle, ring, rod, rounded


def upright_piano_small(m: Model) -> None:
    """A small upright: a fall board over few keys, a lid on top, pedals, perhaps a music desk."""
    style = m.pick(*STYLES)
    w, h, d = m.number(0.8, 1.4), m.number(0.95, 1.25), m.number(0.3, 0.38)
    bed, reach, cheek = m.number(0.6, 0.68), m.number(0.2, 0.25), m.number(0.03, 0.06)
    x = (-w / 2, w / 2)
    _case(m, style, (w, h, d), bed, reach, cheek)
    inner = (x[0] + cheek + 0.002, x[1] - cheek - 0.002)
    _keys(m, style, inner, bed + 0.002, reach)
    _fall(m, style, inner, bed, reach)
    gap, out = 0.4 * m.gap(h), m.pick(0.0, 0.01, 0.02)
    lid = m.pick("back", "back", "front", "halves")
    z = (h + max(gap, 0), h + max(gap, 0) + m.number(0.015, 0.03))
    if lid == "halves":
        for k, s in enumerate((-1, 1)):
            m.add(f"lid_{k}", body(style, tuple(sorted((s * 0.001, s * (w / 2 + out)))), (-out, d), z))
            m.hinge(f"lid_{k}", (0, d, z[1]), (-1, 0, 0), m.pick(70, 95))
    else:
        m.add("lid", body(style, (x[0] - out, x[1] + out), (-out, d), z))
        m.hinge("lid", (0, d, z[1]) if lid == "back" else (0, -out, z[1]), (-1 if lid == "back" else 1, 0, 0), m.pick(70, 95))
    count = m.pick(2, 3)
    for k in range(count):
        a = 0.085 * (k - (count - 1) / 2)
        if style in ("game", "cad"):
            m.add(f"pedal_{k}", box((a - 0.018, a + 0.018), (-0.09, 0.03), (0.06, 0.07)))
        else:
            m.add(f"pedal_{k}", prism(rounded((a - 0.019, a + 0.019), (-0.1, -0.03), 0.017), "z", (0.056, 0.068)))
            m.add(f"pedal_{k}", rod((a, -0.06, 0.062), (a, 0.03, 0.062), 0.007, 8))
        m.hinge(f"pedal_{k}", (a, 0.03, 0.063), (1, 0, 0), m.pick(8, 12))


def _case(m: Model, style: str, size: tuple[float, float, float], bed: float, reach: float, cheek: float) -> None:
    """The box, the key bed with its cheeks, legs, panels and mouldings."""
    w, h, d = size
    x = (-w / 2, w / 2)
    if style in ("cad", "old", "flush") and m.chance(0.7):
        shell = cut(box(x, (0, d), (0.03, h)), box((x[0] + cheek, x[1] - cheek), (0.02, d - 0.03), (0.1, h + 1)))
        m.add(BASE, cut(shell, *(box((a - 0.03, a + 0.03), (-1, 0.019), (0.045, 0.085)) for a in (-0.085, 0, 0.085))))
        m.add(BASE, *(rod((a, 0.1, bed), (a, 0.1, h - 0.02), 0.004, 6) for a in np.linspace(0.8 * x[0], 0.8 * x[1], 9)))
        m.add(BASE, box((x[0] + cheek, x[1] - cheek), (0.085, 0.12), (bed - 0.05, bed + 0.01)))
    else:
        m.add(BASE, without(box(x, (0, d), (0.03, h)), (0, 1, 0)) if style == "sheet" else box(x, (0, d), (0.03, h)))
    m.add(BASE, body(style, x, (-reach, 0.002), (bed - 0.04, bed), (0, 1, 0)))
    top = bed + m.number(0.06, 0.09)
    side = [(-reach, bed), (0.001, bed), (0.001, top + 0.05), (-0.4 * reach, top), (-reach, top - 0.02)]
    for a in (x[0], x[1] - cheek):
        m.add(BASE, prism(side if style in ("soft", "old") else [*side[:2], (0.001, top), (-reach, top)], "x", (a, a + cheek)))
    for a in (x[0] + 0.04, x[1] - 0.04):
        y = -reach + 0.04
        if style in ("old", "soft"):
            profile = [(0.02, 0), (0.026, 0.05), (0.018, 0.1), (0.032, 0.4), (0.02, 0.45), (0.035, bed - 0.04)]
            m.add(BASE, lathe((a, y, 0), (0, 0, 1), profile, m.sections()))
        elif style != "sheet":
            m.add(BASE, body(style, (a - 0.03, a + 0.03), (y - 0.03, y + 0.03), (0.0, bed - 0.038)))
        m.add(BASE, box((a - 0.04, a + 0.04), (-reach + 0.001, 0.001), (0.0, 0.05)))
    for z in ((0.12, bed - 0.08), (top + 0.09, h - 0.04)):
        frame = rectangle((x[0] + cheek, x[1] - cheek), z, 0.05)
        if style == "old":
            m.add(BASE, prism(frame, "y", (-0.012, 0.001)), ring((0, 0, sum(z) / 2), (0, 1, 0), 0.06, 0.008, 16))
        elif style in ("soft", "cad"):
            m.add(BASE, box((x[0] + cheek, x[1] - cheek), (-0.006, 0.001), z))
    if m.chance(0.4):
        desk = (top + 0.11, min(top + 0.3, h - 0.05))
        m.add("music_desk", box((-0.3 * w, 0.3 * w), (-0.03, -0.015), desk))
        m.add(
            BASE,
            *(box((a - 0.01, a + 0.01), (-0.02, 0.001), (desk[0] - 0.008, desk[0] + 0.004)) for a in (-0.25 * w, 0.25 * w)),
        )
        m.hinge("music_desk", (0, -0.02, desk[0]), (1, 0, 0), 30)


def _keys(m: Model, style: str, x: tuple[float, float], z: float, reach: float) -> None:
    """White keys, the black ones in twos and threes."""
    count = m.pick(7, 10, 14)
    w = (x[1] - x[0]) / count
    slack = m.pick(0.001, 0.003)
    back, nose, high = -0.07, -reach + 0.03, 0.014
    for k in range(count):
        a = x[0] + k * w
        m.add(f"key_{k}", box((a + slack, a + w - slack), (nose, back), (z + 0.006, z + 0.006 + high)))
        m.hinge(f"key_{k}", (a + w / 2, back, z + 0.006), (1, 0, 0), 2.5)
        if k % 7 in (0, 1, 3, 4, 5) and k + 1 < count:
            b, part = a + w, f"black_key_{k}"
            rise = box if style in ("game", "sheet") else (lambda *c: body("game", *c))
            m.add(part, rise((b - 0.25 * w, b + 0.25 * w), (nose + 0.4 * (back - nose), back), (z + 0.0205, z + 0.031)))
            m.hinge(part, (b, back, z + 0.021), (1, 0, 0), 2)
    m.add(
        BASE,
        box(x, (back + 0.002, 0.001), (z - 0.003, z + 0.02)),
        box(x, (-reach + 0.004, nose - 0.002), (z - 0.003, z + 0.012)),
    )


def _fall(m: Model, style: str, x: tuple[float, float], bed: float, reach: float) -> None:
    """The board over the keys: a plain flap, one with a lip, a folded one or a sheet."""
    z, back, nose = bed + 0.045, -0.012, -reach + 0.008
    slack = max(m.gap(x[1] - x[0]) / 4, 0.0005)
    x = (x[0] + slack, x[1] - slack)
    design = m.pick("flap", "lip", "folded")
    part = "fall_board"
    if style == "sheet":
        m.add(part, plane((x[0], nose, z), (x[1], nose, z), (x[1], back, z), (x[0], back, z)))
    elif design == "lip":
        m.add(
            part,
            prism(
                [
                    (back, z),
                    (back, z + 0.012),
                    (nose + 0.01, z + 0.012),
                    (nose, z),
                    (nose, bed + 0.03),
                    (nose + 0.008, bed + 0.03),
                    (nose + 0.012, z),
                ],
                "x",
                x,
            ),
        )
    elif design == "flap":
        m.add(part, body(style, x, (nose, back), (z, z + 0.014)))
    else:
        middle = nose + 0.4 * (back - nose)
        m.add(part, box(x, (middle, back), (z, z + 0.012)))
        m.add("fall_front", box(x, (nose, middle - 0.001), (z, z + 0.012)))
        m.hinge("fall_front", (0, middle, z + 0.012), (-1, 0, 0), 165, part)
    if m.chance(0.5):
        owner = "fall_front" if design == "folded" and style != "sheet" else part
        m.add(owner, *(ball((a, nose + 0.012, z + 0.016), (0.008, 0.008, 0.008), 8) for a in (0.6 * x[0], 0.6 * x[1])))
    m.add(BASE, box(x, (back + 0.001, 0.001), (bed + 0.015, z + 0.01)))
    m.hinge(part, (0, back, z + 0.012), (-1, 0, 0), m.pick(85, 95))
