"""Keyboards and portable computers as several artists model them, key by key."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from trimesh import Trimesh

from training.kinds.cad_style import bevelled, convention, knob, lathed, pillow, rounds, sheet, slab
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, loft, prism, rod, vec

Cap = tuple[float, float, float]  # where a key begins, the row it is in, its width [key pitches]
ROWS = (
    (1.25, 1.25, 1.25, 6.25, 1.25, 1.25, 1.25, 1.25),
    (2.25, *(1.0,) * 10, 2.75),
    (1.75, *(1.0,) * 11, 2.25),
    (1.5, *(1.0,) * 12, 1.5),
    (*(1.0,) * 13, 2.0),
)


def _row(widths: Sequence[float], row: float, begin: float = 0.0) -> list[Cap]:
    starts = begin + np.cumsum([0.0, *widths[:-1]])
    return [(float(s), row, w) for s, w in zip(starts, widths, strict=True)]


def layout(m: Model, form: str) -> list[Cap]:
    """The keys of a form, the front row first."""
    if form == "pad":
        across, deep = m.pick(3, 4, 5), m.pick(2, 3, 4, 5)
        return [c for k in range(deep) for c in _row((1.0,) * across, k)]
    if form == "simple":
        across, deep = m.pick(8, 10, 12), m.pick(3, 4)
        caps = [c for k in range(deep) for c in _row((1.0,) * across, k + 1)]
        return [*caps, *_row((1.5, across - 3.0, 1.5), 0)]
    if form == "halves":
        left = [c for k, row in enumerate(ROWS[1:]) for c in _row((*row[:1], *(1.0,) * 5), k + 1)]
        right = [c for k, row in enumerate(ROWS[1:]) for c in _row((*(1.0,) * 5, row[-1]), k + 1, 10.0 + 2.25 - row[-1])]
        return [*left, *right, *_row((1.25, 1.25, 3.75), 0), *_row((3.75, 1.25, 1.25), 0, 9.5)]
    caps = [c for k, row in enumerate(ROWS) for c in _row(row, k)]
    if form in ("wide", "office"):
        caps += [c for g in (0, 2, 6.5, 11) for c in _row((1.0,) * (1 if g == 0 else 4), 5.3, g)]
    if form == "office":
        caps += [*_row((1.0,) * 3, 0, 15.3), *_row((1.0,), 1, 16.3), *_row((1.0,) * 3, 3, 15.3), *_row((1.0,) * 3, 4, 15.3)]
    if form == "office" and m.chance(0.7):
        caps += [*_row((2.0, 1.0), 0, 18.6), *(c for k in (1, 2, 3, 4) for c in _row((1.0,) * 4, k, 18.6))]
    return caps


def cap(style: str, x: Span, y: Span, z: Span, n: int) -> list[Trimesh]:
    """One key between its sides; its upper face is smaller."""
    in_x, in_y = 0.12 * min(x[1] - x[0], 0.019), 0.12 * (y[1] - y[0])
    if style == "prop":
        return [bevelled(x, y, z, 0.0015)]
    if style == "antique" and x[1] - x[0] < 1.6 * (y[1] - y[0]):
        c, r = ((x[0] + x[1]) / 2, (y[0] + y[1]) / 2, 0), 0.47 * (y[1] - y[0])
        head = lathed([(0, z[1] - 0.003), (r, z[1] - 0.003), (r, z[1]), (0.8 * r, z[1] - 0.001), (0, z[1] - 0.001)], n, c)
        return [head, rod(vec(*c) + vec(0, 0, z[0]), vec(*c) + vec(0, 0, z[1] - 0.002), 0.2 * r, 6)]
    if style in ("product", "antique"):
        return [pillow(x, y, z, 0.25 * (y[1] - y[0]))]
    corners = [[(p[0], p[1], h) for p in ((a, c), (b, c), (b, d), (a, d))] for a, b, c, d, h in (
        (x[0], x[1], y[0], y[1], z[0]), (x[0] + in_x, x[1] - in_x, y[0] + in_y, y[1] - in_y, z[1]))]  # fmt: skip
    if style == "sheet":
        low, high = corners
        return [sheet(high, *[(low[k - 1], low[k], high[k], high[k - 1]) for k in range(4)])]
    solid = loft(np.array(corners, float))
    if style == "assembly":
        mid = vec((x[0] + x[1]) / 2, (y[0] + y[1]) / 2, z[0])
        return [solid, box(*((v - 0.002, v + 0.002) for v in mid[:2]), (z[0] - 0.003, z[0]))]
    return [solid]


def add_keys(
    m: Model,
    style: str,
    caps: Sequence[Cap],
    pitch: float,
    z: Span,
    slope: float,
    n: int,
    seam: float = np.inf,
    moves: bool = True,
) -> None:
    """A joint a key; those right of a seam hang on the right half. moves: False for keys that are only drawn."""
    gap = pitch * m.pick(0.04, 0.08, 0.14)
    for k, (a, row, wide) in enumerate(caps):
        x, y = (a * pitch + gap, (a + wide) * pitch - gap), (row * pitch + gap, (row + 1) * pitch - gap)
        lift = slope * (y[0] + y[1]) / 2
        name, parent = f"key_{k}" if moves else BASE, "right_half" if a > seam else BASE
        m.add(name, *cap(style, x, y, (z[0] + lift, z[1] + lift), n))
        if style == "assembly" and len(caps) < 40:
            mid = ((x[0] + x[1]) / 2, (y[0] + y[1]) / 2)
            m.add(parent, box(*((v - 0.006, v + 0.006) for v in mid), (z[0] + lift - 0.006, z[0] + lift - 0.001)))
        if moves:
            m.slide(name, (0, -slope, -1) if slope else (0, 0, -1), 0.4 * (z[1] - z[0]), parent)


def _tray(
    m: Model, style: str, part: str, x: Span, y: Span, high: float, slope: float, caps: Sequence[Cap], pitch: float
) -> None:
    """The body under the keys; a wedge when it slopes, with a well for the keys when it is cut."""
    outline = [(y[0], 0), (y[1], 0), (y[1], high + slope * y[1]), (y[0], high + slope * y[0])]
    if style == "sheet":
        ends = [[(s, *p) for p in outline] for s in x]
        m.add(part, sheet(*[(ends[0][k - 1], ends[0][k], ends[1][k], ends[1][k - 1]) for k in (0, 2, 3)], *ends))
    elif style == "product" and not slope:
        m.add(part, pillow(x, y, (0, high), 0.5 * pitch))
    elif style in ("hollow", "assembly"):
        body = prism([(a, b + (0.005 if b > 0 else 0)) for a, b in outline], "x", x)
        for row in sorted({c[1] for c in caps}):
            spans = sorted((c[0], c[0] + c[2]) for c in caps if c[1] == row and x[0] <= c[0] * pitch + 1e-6 <= x[1])
            if spans:
                low = high + slope * row * pitch
                body = cut(
                    body, box((spans[0][0] * pitch, spans[-1][1] * pitch), (row * pitch, (row + 1) * pitch + 1e-4), (low, 1))
                )
        m.add(part, body)
    else:
        m.add(part, prism(outline, "x", x))


def _fold(m: Model, seam: float, back: float, high: float, pitch: float) -> None:
    """The right half turns up a little, or under the left one."""
    z, axis, most = m.pick((high, (0, -1, 0), 70), (0.0, (0, 1, 0), 175))
    spans = [(f * back, f * back + pitch) for f in (0.1, 0.7)]
    m.add(m.pick(BASE, "right_half"), *(rod((seam, a, z), (seam, b, z), 0.2 * high, 8) for a, b in spans))
    m.hinge("right_half", (seam, 0, z), axis, most)


def typing_keyboard(m: Model) -> None:
    """A board of keys that are pressed, from a pad to a full one or in two halves; feet that fold out, a knob, a roller."""
    style = convention(m)
    n, pitch = rounds(m, style), 0.019 * m.pick(0.85, 1.0, 1.0, 1.2)
    form = m.pick("pad", "simple", "short", "short", "wide", "office", "halves")
    caps, slope = layout(m, form), m.pick(0.0, 0.0, 0.05, 0.1)
    edge, high = pitch * m.number(0.15, 0.7), m.number(0.007, 0.02)
    right, back = (max(v) * pitch for v in zip(*((a + w, r + 1) for a, r, w in caps), strict=True))
    folds = form == "halves"
    extra = 0.0 if folds else m.pick(0.0, 0.0, 1.2) * pitch
    x, y = (-edge, right + edge), (-edge * m.pick(1, 1, 4), back + edge + extra)
    if folds:
        seam = 8.2 * pitch
        slope = 0.0
        _tray(m, style, BASE, (x[0], seam), y, high, slope, caps, pitch)
        _tray(m, style, "right_half", (seam + 0.0005, x[1]), y, high, slope, caps, pitch)
        _fold(m, seam, back, high, pitch)
    else:
        _tray(m, style, BASE, x, y, high, slope, caps, pitch)
    add_keys(
        m, style, caps, pitch, (high + 0.001, high + 0.001 + m.pick(0.003, 0.006, 0.009)), slope, n, 8.0 if folds else np.inf
    )
    rim = 0.005 if style in ("hollow", "assembly") else 0.0
    top = back + 0.5 * (edge + extra)
    level = high + rim + slope * top
    if extra:
        at = vec(right - pitch * m.number(0.6, 1.5), top, level - 0.001)
        if m.chance(0.6):
            m.add("knob", *knob(style, at, (0, 0, 1), 0.45 * pitch, 0.012, n))
            m.spin("knob", at, (0, 0, 1))
        else:
            m.add("roller", rod(at - vec(0.5 * pitch, 0, 0), at + vec(0.5 * pitch, 0, 0), 0.2 * pitch, n))
            m.spin("roller", at, (1, 0, 0))
        m.add(
            BASE,
            *(
                box(
                    (0.3 * pitch + s * pitch, s * pitch + 0.8 * pitch),
                    (top - 0.002, top + 0.002),
                    (level - 0.001, level + 0.0006),
                )
                for s in range(3)
            ),
        )
    if form not in ("pad", "halves") and m.chance(0.5):
        for s, name in ((0.12, "left"), (0.82, "right")):
            m.add(f"foot_{name}", slab(style, (s * right, s * right + 0.03), (y[1] - 0.028, y[1] - 0.004), (-0.005, -0.0003)))
            m.hinge(f"foot_{name}", (s * right, y[1] - 0.005, -0.0015), (1, 0, 0), m.pick(80, 100))
    if not folds and m.chance(0.25):
        m.add(BASE, slab(style, x, (y[0] - 0.06, y[0] - 0.0002), (0, 0.7 * high)))
    if not folds and m.chance(0.3):
        m.add(BASE, rod((0.5 * right, y[1] - 0.002, 0.5 * high), (0.5 * right, y[1] + 0.03, 0.5 * high), 0.003, 8))
