"""Portable computers as several artists model them, open or shut; their keys are part of the base, as for `laptop`."""

from __future__ import annotations

from training.kinds.cad_style import convention, open_box, rounds, slab
from training.kinds.electronics.cad_keys import add_keys, layout
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, rod, turned, vec


def _screen(m: Model, style: str, w: float, d: float, z: float, thick: float, back: float, angle: float) -> None:
    """The lid with its picture, hung at the back edge and turned to an angle."""
    solids = [slab(style, (-w, w), (back - d, back), (z, z + thick), "+z" if style == "sheet" and m.chance(0.4) else "-z")]
    if style == "sheet":
        solids = [open_box((-w, w), (back - d, back), (z, z + thick))]
    rim, chin = m.pick(0.006, 0.012, 0.02), m.pick(0.012, 0.025)
    glass = (-w + rim, w - rim), (back - d + rim, back - chin)
    if style == "hollow":
        solids = [cut(solids[0], box(*glass, (z - 0.01, z + 0.25 * thick)))]
    else:
        solids.append(box(*glass, (z - 0.0006, z + 0.001)))
    if style in ("assembly", "antique"):
        solids += [
            rod((s * (w - 0.004), y, z - 0.0012), (s * (w - 0.004), y, z + 0.001), 0.003, 8)
            for s in (-1, 1)
            for y in (back - d + 0.004, back - 0.02)
        ]
    if m.chance(0.5):
        solids.append(
            rod(
                (0, back - 0.6 * d, z + thick - 0.001),
                (0, back - 0.6 * d, z + thick + 0.0006),
                0.09 * d,
                5 if style == "prop" else 20,
            )
        )
    form = m.pick("long", "pair", "pair")
    pivot = vec(0, back, z)
    spans = [(-0.8 * w, 0.8 * w)] if form == "long" else [(-0.85 * w, -0.6 * w), (0.6 * w, 0.85 * w)]
    for a, b in spans:
        m.add(BASE, rod((a - 0.008, back, z), (a, back, z), 0.0045, 10), rod((b, back, z), (b + 0.008, back, z), 0.0045, 10))
        solids.append(rod((a + 0.0003, back, z), (b - 0.0003, back, z), 0.0045, 10))
    m.add("screen", *(turned(s, (-1, 0, 0), angle, pivot) for s in solids))
    m.hinge("screen", pivot, (-1, 0, 0), (-angle, m.pick(135, 180, 180 if angle else 150) - angle))


def _fittings(
    m: Model, style: str, x: Span, y: Span, pad: tuple[Span, Span], right: float, rows: float, thick: float, n: int
) -> None:
    """A touch pad, a power button, a disc tray, ports and feet."""
    presses = m.chance(0.5)
    m.add(
        "touch_pad" if presses else BASE, slab("prop" if style == "product" else style, *pad, (thick - 0.002, thick + 0.0005))
    )
    if presses:
        m.slide("touch_pad", (0, 0, -1), 0.0015)
    if m.chance(0.4):
        m.add(
            "power_button",
            rod((right - 0.01, rows + 0.007, thick - 0.001), (right - 0.01, rows + 0.007, thick + 0.001), 0.005, n),
        )
        m.slide("power_button", (0, 0, -1), 0.001)
    if thick > 0.015 and m.chance(0.4):
        z = (0.3 * thick, 0.6 * thick)
        m.add(
            "disc_tray",
            box((x[1] - 0.13, x[1] + 0.0015), (0.02, 0.15), z),
            rod((x[1], 0.08, z[0]), (x[1] + 0.003, 0.08, z[0]), 0.002, 6),
        )
        m.slide("disc_tray", (1, 0, 0), 0.12)
    m.add(
        BASE,
        *(
            box((x[0] - 0.0005, x[0] + 0.001), (0.01 + 0.022 * k, 0.022 + 0.022 * k), (0.4 * thick, 0.7 * thick))
            for k in range(m.pick(1, 2, 3))
        ),
    )
    if m.chance(0.6):
        spots = [(a, b) for a in (x[0] + 0.02, x[1] - 0.02) for b in (y[0] + 0.02, y[1] - 0.02)]
        m.add(BASE, *(rod((a, b, -0.003), (a, b, 0.001), 0.006, n) for a, b in spots))


def notebook_computer(m: Model) -> None:
    """A lower half with keys, a touch pad, a screen; a disc tray in some."""
    style = convention(m)
    n, pitch = rounds(m, style), m.pick(0.017, 0.019)
    form = m.pick("short", "simple", "wide")
    caps, thick = layout(m, form), m.pick(0.012, 0.018, 0.03)
    right, rows = (max(v) * pitch for v in zip(*((a + w, r + 1) for a, r, w in caps), strict=True))
    x, y = (-0.02, right + 0.02), (-m.number(0.08, 0.1), rows + m.number(0.015, 0.03))
    deep = 0.004 if style in ("hollow", "assembly", "product") else 0.0
    body = slab(style, x, y, (0, thick))
    if deep:
        body = cut(body, box((0, right), (0, rows), (thick - deep, 1)))
    pad = ((0.5 * right - 0.055, 0.5 * right + 0.045), (y[0] + 0.012, -0.012))
    if deep and m.chance(0.5):
        body = cut(body, box(*((a - 0.0005, b + 0.0005) for a, b in pad), (thick - 0.0025, 1)))
    m.add(BASE, body)
    if m.chance(0.8):
        add_keys(m, style, caps, pitch, (thick - deep + 0.0005, thick + 0.003 - 0.6 * deep), 0.0, n, moves=False)
    elif m.chance(0.85):
        m.add(BASE, box((0, right), (0, rows), (thick - deep - 0.001, thick + 0.0008 - deep)))
    _fittings(m, style, x, y, pad, right, rows, thick, n)
    middle = 0.5 * (x[0] + x[1])
    count = len(m.pieces)
    _screen(
        m,
        style,
        0.5 * (x[1] - x[0]) - 0.001,
        y[1] - y[0] - 0.004,
        thick + 0.0045,
        m.number(0.005, 0.009),
        y[1] - 0.002,
        m.pick(0, 95, 105, 115),
    )
    for _, solid in m.pieces[count:]:
        solid.apply_translation((middle, 0, 0))
