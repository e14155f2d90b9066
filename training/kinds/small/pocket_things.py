"""Flip phones, and lighters with lids."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, cut, prism, rod, rounded, vec


def _phone_keys(m: Model, x: Span, y: Span, z: float, move: bool) -> None:
    """Keys in rows with a round pad behind or beside them; they are pressed in, or stay."""
    broad = x[1] - x[0] > y[1] - y[0]
    cols, rows, style = (8 if broad else 3), (3 if broad else 4), m.pick("box", "round", "oval")
    area = ((x[0], x[1] - 0.02) if broad else x, y if broad else (y[0], y[0] + 0.68 * (y[1] - y[0])))
    wide, tall = ((s[1] - s[0]) / n for s, n in zip(area, (cols, rows), strict=True))
    for k in range(cols * rows):
        a, b = x[0] + (k % cols + 0.5) * wide, y[0] + (k // cols + 0.5) * tall
        half = (0.42 * wide, 0.38 * tall) if style != "round" else (0.38 * min(wide, tall),) * 2
        flat = rounded((a - half[0], a + half[0]), (b - half[1], b + half[1]), (0.1 if style == "box" else 0.9) * min(half), 2)
        part = f"key_{k}" if move and k < 12 else BASE
        m.add(part, prism(flat, "z", (z - 0.0005, z + 0.0009)))
        if part != BASE:
            m.slide(part, (0, 0, -1), 0.0008)
    c, r = ((x[1] - 0.009, middle(y)), 0.007) if broad else ((middle(x), y[1] - 0.16 * (y[1] - y[0])), 0.13 * (y[1] - y[0]))
    m.add(BASE, rod((*c, z), (*c, z + 0.0005), r, 16), rod((*c, z), (*c, z + 0.0009), 0.5 * r, 12))
    for s in () if broad else (-1, 1):
        m.add(BASE, box((c[0] + s * 0.8 * wide, c[0] + s * 1.4 * wide), (c[1] - 0.5 * r, c[1] + 0.5 * r), (z, z + 0.0008)))


def _phone_extras(m: Model, x: Span, long: float, thick: float) -> None:
    """An aerial that pulls out or stays, keys at the side, a cover over the battery."""
    if m.chance(0.5):
        a, part = (x[1] - 0.006) * m.pick(-1, 1), m.pick("aerial", "aerial", BASE)
        m.add(BASE, rod((a, long - 0.004, thick / 2), (a, long + 0.012, thick / 2), 0.0035, 12))
        m.add(part, rod((a, 0.4 * long, thick / 2), (a, long + 0.016, thick / 2), 0.0014, 8))
        m.add(part, ball((a, long + 0.017, thick / 2), (0.0025,) * 3, 8))
        if part != BASE:
            m.slide("aerial", (0, 1, 0), 0.5 * long)
    for k in range(m.pick(0, 1, 2)):
        b = (0.5 + 0.16 * k) * long
        m.add(f"side_key_{k}", box((x[0] - 0.001, x[0] + 0.001), (b, b + 0.1 * long), (0.3 * thick, 0.6 * thick)))
        m.slide(f"side_key_{k}", (1, 0, 0), 0.0008)
    if m.chance(0.4):
        m.add("battery_cover", prism(rounded(shrunk(x, 0.004), (0.1 * long, 0.75 * long), 0.004), "z", (-0.0015, 0.0)))
        m.slide("battery_cover", (0, -1, 0), 0.3 * long)


def _phone_lid(m: Model, x: Span, y: Span, z: Span) -> None:
    """A lid with a screen inside; a window, a camera, a grille outside."""
    wide, long = x[1] - x[0], y[1] - y[0]
    m.add("lid", prism(rounded(x, y, 0.12 * min(wide, long)), "z", z))
    m.add("lid", box(shrunk(x, 0.12 * wide), (y[0] + 0.12 * long, y[1] - 0.2 * long), (z[0] - 0.0002, z[0] + 0.001)))
    if m.chance(0.7):
        d = (y[0] + 0.5 * long, y[0] + 0.76 * long)
        m.add("lid", prism(rounded(shrunk(x, 0.26 * wide), d, 0.003), "z", (z[1], z[1] + 0.0008)))
    if m.chance(0.6):
        b = y[0] + 0.87 * long
        m.add(
            "lid",
            rod((0, b, z[1]), (0, b, z[1] + 0.0015), 0.05 * long, 14),
            rod((0.01, b, z[1]), (0.01, b, z[1] + 0.0008), 0.0015, 8),
        )
    if m.chance(0.5):
        m.add(
            "lid",
            *(box((-0.007, 0.007), (c, c + 0.001), (z[1], z[1] + 0.0006)) for c in y[0] + np.array([0.1, 0.14, 0.18]) * long),
        )


def _speaking_flap(m: Model, wide: float, long: float, thick: float) -> None:
    """An old phone: a screen and an aerial above, keys below under a short flap that is hinged at the bottom."""
    x, long, r = (-wide / 2, wide / 2), 1.45 * long, 0.0028
    m.add(BASE, prism(rounded(x, (0, long), 0.008), "z", (0, thick)))
    m.add(BASE, prism(rounded(shrunk(x, 0.007), (0.62 * long, 0.84 * long), 0.003), "z", (thick, thick + 0.001)))
    m.add(BASE, *(box((-0.008, 0.008), (c, c + 0.0012), (thick, thick + 0.0006)) for c in np.array([0.9, 0.92, 0.94]) * long))
    _phone_keys(m, shrunk(x, 0.005), (0.05 * long, 0.6 * long), thick, m.chance(0.5))
    flap = (0.003, m.number(0.3, 0.56) * long)
    m.add("flap", prism(rounded(shrunk(x, 0.002), flap, 0.004), "z", (thick + 0.0013, thick + 0.0045)))
    if m.chance(0.6):
        m.add(
            "flap",
            *(
                rod((a, flap[1] - 0.008, thick + 0.004), (a, flap[1] - 0.008, thick + 0.005), 0.001, 8)
                for a in (-0.004, 0.0, 0.004)
            ),
        )
    axis, mid = vec(0, 0, thick + 0.001), 0.3 * wide
    m.add("flap", rod(axis - vec(mid, 0, 0), axis + vec(mid, 0, 0), r, 12))
    m.add(BASE, *(rod(axis + vec(s * mid, 0, 0), axis + vec(s * 0.49 * wide, 0, 0), r, 12) for s in (-1, 1)))
    m.hinge("flap", axis, (1, 0, 0), m.number(120, 150))
    _phone_extras(m, x, long, thick)


def flip_phone(m: Model) -> None:
    """A phone that flips open: upright, broad, or with a short flap over its keys; keys, knuckles, an aerial, side keys."""
    wide, long, thick, lid = m.number(0.042, 0.052), m.number(0.082, 0.1), m.number(0.009, 0.013), m.number(0.006, 0.01)
    style = m.pick("upright", "upright", "short", "broad", "flap")
    if style == "flap":
        _speaking_flap(m, wide, long, thick + 0.006)
        return
    if style == "broad":
        wide, long = m.number(0.11, 0.14), m.number(0.055, 0.068)
    x, corner, gap = (-wide / 2, wide / 2), m.number(0.004, 0.014), m.pick(0.0011, 0.0015, 0.0025)
    fat = m.chance(0.4)
    axis, r = vec(0, long, thick + gap / 2), (0.5 * lid + 0.0015 if fat else 0.5 * lid)
    m.add(BASE, prism(rounded(x, (0, long), corner), "z", (0, thick)))
    low = 0.3 * long if style == "short" else 0.0
    _phone_lid(m, shrunk(x, m.pick(0.0, 0.0, 0.0015)), (low, long - 0.001), (thick + gap, thick + gap + lid))
    mid, joint = m.pick(0.2, 0.3, 0.38) * wide, m.pick(0.0, 0.0004)
    m.add("lid", rod(axis - vec(mid, 0, 0), axis + vec(mid, 0, 0), r, 16))
    m.add(BASE, *(rod(axis + vec(s * (mid + joint), 0, 0), axis + vec(s * wide / 2, 0, 0), r, 16) for s in (-1, 1)))
    m.hinge("lid", axis, (-1, 0, 0), m.number(150, 172))
    _phone_keys(m, shrunk(x, 0.005), (0.006, long - 0.012), thick, m.chance(0.5))
    _phone_extras(m, x, long, thick)


def _lighter_works(m: Model, x: Span, y: Span, z: float, cam: bool) -> None:
    """The insert of a lighter: a chimney with holes, a wick, a wheel that turns, a cam that snaps over."""
    w, d = x[1] - x[0], y[1] - y[0]
    m.add(BASE, box(shrunk(x, 0.03 * w), shrunk(y, 0.06 * d), (z - 0.004, z + 0.002)))
    c, r = (x[0] + 0.22 * w, x[0] + 0.6 * w), 0.14 * w
    tall, b = 0.36 * w, (middle(y) - 0.32 * d, middle(y) + 0.32 * d)
    chimney = cut(box(c, b, (z, z + tall)), box(shrunk(c, 0.001), shrunk(b, 0.001), (z + 0.001, z + 1)))
    holes = [
        rod((a, b[0] - 1, z + h * tall), (a, b[1] + 1, z + h * tall), 0.05 * w, 8)
        for a in np.linspace(*c, 4)[1:-1]
        for h in (0.35, 0.7)
    ]
    m.add(BASE, cut(chimney, *holes), rod((middle(c), middle(y), z), (middle(c), middle(y), z + 0.7 * tall), 0.05 * w, 8))
    at = vec(x[1] - 0.24 * w, middle(y), z + 0.22 * w)
    m.add(
        BASE,
        *(
            box(
                (at[0] - 0.03 * w, at[0] + 0.03 * w),
                (at[1] + s * 0.24 * d - 0.0005, at[1] + s * 0.24 * d + 0.0005),
                (z, at[2] + 0.03 * w),
            )
            for s in (-1, 1)
        ),
    )
    half = vec(0, 0.18 * d, 0)
    turn = np.linspace(0, 2 * np.pi, 32, endpoint=False)
    edge = np.where(np.arange(32) % 2, 0.88 * r, r)
    m.add(
        "wheel",
        prism(
            Polygon(np.c_[at[0] + edge * np.cos(turn), at[2] + edge * np.sin(turn)]), "y", (at[1] - half[1], at[1] + half[1])
        ),
    )
    m.add("wheel", rod(at - 1.5 * half, at + 1.5 * half, 0.25 * r, 8))
    m.spin("wheel", at, (0, 1, 0))
    if cam:
        p = vec(x[0] + 0.1 * w, middle(y), z + 0.06 * w)
        m.add(
            "cam",
            prism(
                [(p[0] - 0.05 * w, p[2] - 0.02 * w), (p[0] + 0.08 * w, p[2] - 0.02 * w), (p[0] - 0.02 * w, p[2] + 0.16 * w)],
                "y",
                (p[1] - 0.1 * d, p[1] + 0.1 * d),
            ),
        )
        m.hinge("cam", p, (0, -1, 0), 40)


def _hollow(outline: Polygon, z: Span, wall: float, above: bool) -> Trimesh:
    """A case of an outline, open above or below."""
    inside = (z[0] + wall, z[1] + 1) if above else (z[0] - 1, z[1] - wall)
    return cut(prism(outline, "z", z), prism(outline.buffer(-wall), "z", inside))


def zippo_lighter(m: Model) -> None:
    """A lighter with a hinged lid: pocket, slim or table size, sharp or round, a wheel under the lid, emblems, a plinth."""
    size = m.pick(1.0, 1.0, 1.8)
    wide, deep, high = m.number(0.028, 0.039) * size, m.number(0.01, 0.014) * size, m.number(0.05, 0.058) * size
    x, y, split, wall = (-wide / 2, wide / 2), (-deep / 2, deep / 2), high * m.number(0.58, 0.64), 0.0008 * size
    corner, foot = m.pick(0.05, 0.2, 0.45) * deep, (m.number(0.006, 0.012) if size > 1.5 else 0.0)
    outline, gap = rounded(x, y, corner), m.pick(0.0, 0.0002, 0.0006) * size
    if foot:
        m.add(BASE, prism(rounded(shrunk(x, -0.006), shrunk(y, -0.006), corner + 0.003), "z", (0, foot)))
    z = (foot, foot + split, foot + high)
    m.add(BASE, prism(outline, "z", z[:2]) if m.chance(0.5) else _hollow(outline, z[:2], wall, True))
    m.add("lid", _hollow(outline, (z[1] + gap, z[2]), wall, False))
    if m.chance(0.4):
        crown = outline.buffer(-0.12 * deep)
        m.add("lid", prism(crown, "z", (z[2], z[2] + 0.001 * size)))
    _lighter_works(m, shrunk(x, wall + 0.0005), shrunk(y, wall + 0.0003), z[1], m.chance(0.6))
    r, side = m.pick(0.0008, 0.0013) * size, -1
    axis = vec(side * (wide / 2 + m.pick(0.0, 1.0) * r), 0, z[1])
    for k, b in enumerate(np.linspace(-0.36, 0.36, 5) * deep):
        m.add("lid" if k % 2 else BASE, rod(axis + vec(0, b - 0.08 * deep, 0), axis + vec(0, b + 0.08 * deep, 0), r, 10))
    m.hinge("lid", axis, (0, side, 0), m.number(110, 150))
    for part, span in ((BASE, (z[0] + 0.15 * split, z[1] - 0.15 * split)), ("lid", (z[1] + 0.004, z[2] - 0.004))):
        style = m.pick("none", "none", "plate", "disc", "lines")
        face, c = (y[0] - 0.0005 * size, y[0]), middle(span)
        if style == "plate":
            m.add(part, box(shrunk(x, 0.2 * wide), face, span))
        elif style == "disc":
            m.add(part, rod((0, face[0], c), (0, face[1], c), 0.4 * min(span[1] - span[0], wide), 16))
        elif style == "lines":
            m.add(part, *(box((a - 0.0006, a + 0.0006), face, span) for a in np.linspace(*shrunk(x, 0.2 * wide), 6)))
