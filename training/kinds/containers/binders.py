"""Ring binders and powder compacts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely.affinity import scale, translate
from shapely.geometry import Point as Dot
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, common, cut, prism, rectangle, ring, rod, rounded, tube, vec

UPRIGHT = np.array([[0.0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]])


def _stand(m: Model, up: float) -> None:
    """Stand what lies with its spine along y upright and lift it, the spine to the front."""
    for _, s in m.pieces:
        s.apply_transform(UPRIGHT).apply_translation([0, 0, up])
    turn = UPRIGHT[:3, :3]
    for part, j in m.joints.items():
        m.joints[part] = replace(j, origin=turn @ j.origin + vec(0, 0, up), axis=turn @ j.axis)


def _cover(m: Model, part: str, x: Span, y: Span, z: Span, out: int) -> None:
    """A cover board; out: the side (1 or -1 along z) that is its outside, with a label, metal corners or a pocket."""
    style = m.pick("board", "board", "rounded", "padded")
    m.add(part, prism(rounded(x, y, 0.012), "z", z) if style == "rounded" else box(x, y, z))
    face, inside = (z[1], z[0]) if out > 0 else (z[0], z[1])
    if style == "padded":
        m.add(part, box(shrunk(x, 0.01), shrunk(y, 0.01), (face, face + out * 0.0015)))
    if m.chance(0.4):
        m.add(part, box((0.3 * x[1], 0.75 * x[1]), (0.15 * y[1], 0.55 * y[1]), (face, face + out * 0.002)))
    if m.chance(0.4):
        m.add(part, *(box((x[1] - 0.03, x[1] + 0.001), sorted((b, 0.93 * b)), shrunk(z, -0.0008)) for b in y))
    if m.chance(0.4):
        m.add(part, box((x[0] + 0.06, x[1] - 0.006), (y[0] + 0.004, 0.1 * y[0]), (inside, inside - out * 0.001)))


def _spine(m: Model, part: str, t: float, y: Span, thick: float) -> None:
    """The spine with its label and its finger hole."""
    m.add(part, box((-t, 0), y, (0, thick)) if m.chance(0.7) else prism(_bent(t, thick), "y", y))
    if m.chance(0.7):
        m.add(part, box((-t - 0.001, -t), (0.1 * y[1], 0.8 * y[1]), (0.15 * thick, 0.85 * thick)))
    if m.chance(0.7) and thick > 0.03:
        m.add(part, ring((-t, 0.6 * y[0], thick / 2), (1, 0, 0), 0.011, 0.0018, 16))


def _bent(t: float, thick: float) -> Polygon:
    """A spine that is round outwards."""
    a = np.linspace(-1, 1, 8)
    out = np.c_[-t - 0.12 * thick * (1 - a**2), thick * (a + 1) / 2]
    return Polygon([*out, (0, thick), (0, 0)])


def _rings(m: Model, at: np.ndarray, out: np.ndarray, radius: float, long: float) -> None:
    """A bar with rings of two halves that swing apart (or are fixed), or a lever arch."""
    side, y = out[[2, 1, 0]], np.linspace(-1, 1, m.pick(2, 3, 4)) * m.number(0.3, 0.42) * long
    w, reach = 0.012, np.array([0, 0.45 * long, 0])
    m.add(BASE, box(*np.sort(np.c_[at - w * side - reach, at + w * side + reach + 0.004 * out])))
    if m.chance(0.25):
        _arch(m, at, out, radius, long)
        return
    moving, r, squash = m.chance(0.6), m.pick(0.0015, 0.0025), m.pick(1.0, 1.0, 0.75)
    a = np.linspace(0, np.pi, 9)[:, None]
    for name, sign in (("rings_a", 1), ("rings_b", -1)):
        part = name if moving else BASE
        for b in y:
            path = at + 0.003 * out + radius * (1 - np.cos(a)) * out + sign * squash * radius * np.sin(a) * side + vec(0, b, 0)
            m.add(part, tube(path, r, 6))
        if moving:
            m.add(part, rod(at + 0.003 * out - reach, at + 0.003 * out + reach, 0.0015, 6))
            m.hinge(part, at + 0.003 * out, sign * np.cross(out, side), m.pick(20, 30, 40))
    if m.chance(0.5):
        m.add(BASE, *(box(*np.sort(np.c_[at + s * reach - 0.006, at + s * reach + 0.006])) for s in (-1, 1)))


def _arch(m: Model, at: np.ndarray, out: np.ndarray, radius: float, long: float) -> None:
    """Posts, arches over them that swing away on a bar, and the lever that lifts them."""
    side, r, tip = out[[2, 1, 0]], 0.0016, at + 0.004 * out
    a, high = np.linspace(0, np.pi, 7)[:, None], 1.0 * radius * out
    foot = tip - 0.7 * radius * side
    for b in (-0.04, 0.04):
        post = tip + 0.7 * radius * side + vec(0, b, 0)
        m.add(BASE, rod(post - 0.004 * out, post + high, r, 8))
        bend = foot + high + 0.7 * radius * ((1 - np.cos(a)) * side + np.sin(a) * out) + vec(0, b, 0)
        m.add("arches", tube([foot + vec(0, b, 0), *bend], r, 6))
    m.add("arches", rod(foot + vec(0, -0.05, 0), foot + vec(0, 0.05, 0), 1.2 * r, 8))
    m.hinge("arches", foot, -np.cross(out, side), m.pick(40, 60))
    pivot, end = tip + vec(0, 0.25 * long, 0), tip + vec(0, -0.02 + 0.1 * long, 0)
    lift = 0.006 * out
    m.add("lever", box(*np.sort(np.c_[end - 0.005 * side + lift, pivot + 0.005 * side + lift + 0.002 * out])))
    m.add("lever", rod(pivot - 0.008 * side + lift, pivot + 0.008 * side + lift, 0.004, 8))
    m.add(
        BASE,
        *(
            box(
                *np.sort(
                    np.c_[pivot + s * 0.008 * side - vec(0, 0.006, 0), pivot + s * 0.01 * side + vec(0, 0.006, 0) + 0.012 * out]
                )
            )
            for s in (-1, 1)
        ),
    )
    m.hinge("lever", pivot + lift, np.cross(-vec(0, 1, 0), out), m.pick(70, 90, 110))


def ring_binder(m: Model) -> None:
    """A binder, lying or upright, one or two covers hinged at the spine or over it; rings or a lever arch, still or opening."""
    long, wide, thick, t = m.number(0.22, 0.33), m.number(0.17, 0.29), m.number(0.03, 0.085), m.number(0.002, 0.004)
    y, x, mode = (-long / 2, long / 2), (0.001, wide), m.pick("back", "back", "chain", "spine")
    spine = "spine" if mode == "chain" else BASE
    _spine(m, spine, t, y, thick)
    back = "back" if mode == "spine" else BASE
    _cover(m, back, x, y, (0, t), -1)
    _cover(m, "front", x, y, (thick - t, thick), 1)
    if mode == "chain":
        m.hinge("spine", (0, 0, 0), (0, -1, 0), 90)
        m.hinge("front", (0, 0, thick), (0, -1, 0), m.pick(90, 85), "spine")
    else:
        m.hinge("front", (0, 0, thick), (0, -1, 0), m.pick(80, 100, 120) if mode == "spine" else m.pick(100, 150, 180))
    on_spine = mode == "spine" or (mode == "back" and m.chance(0.4))
    radius = (thick - 2 * t) * (0.4 if on_spine else 0.42)
    if on_spine:
        _rings(m, vec(0, 0, thick / 2), vec(1, 0, 0), min(radius, 0.035), long)
    else:
        _rings(m, vec(1.5 * radius + 0.012, 0, t), vec(0, 0, 1), radius, long)
    full = m.pick(0.0, 0.3, 0.6, 0.85) * (thick - 2 * t)
    if full:
        low = thick / 2 - full / 2 if on_spine else t + 0.001
        start = radius if on_spine else 1.5 * radius + 0.012
        m.add(BASE, box((start + 0.005, wide - m.number(0.01, 0.03)), shrunk(y, 0.012), (low, low + full)))
        for k in range(m.pick(0, 3, 5)):
            b, level = y[0] + (0.15 + 0.14 * k) * long, low + full * (k + 0.5) / 6
            m.add(BASE, box((wide - 0.035, wide - 0.004), (b, b + 0.1 * long), (level, level + 0.0006)))
    if mode == "spine":
        m.hinge("back", (0, 0, 0), (0, 1, 0), m.pick(80, 100, 120))
    if mode == "spine" or (mode == "back" and m.chance(0.4)):
        _stand(m, long / 2)


def _compact_outline(m: Model) -> Polygon:
    """The outline of a compact: round, oval, square with round corners, long, eight-sided or a shell."""
    kind, r = m.pick("round", "round", "oval", "square", "long", "octagon", "shell"), m.number(0.032, 0.045)
    if kind in ("square", "long"):
        wide = r * (0.95 if kind == "square" else m.number(1.3, 1.9))
        return rounded((-wide, wide), (-0.9 * r, 0.9 * r), m.pick(0.12, 0.3) * r)
    t = np.linspace(0, 2 * np.pi, 9 if kind == "octagon" else m.pick(21, 33))[:-1]
    if kind == "shell":
        fan = np.where(np.arange(len(t)) % 4 == 0, 0.92, 1.0) - 0.12 * np.maximum(np.sin(t), 0) ** 4
        return Polygon(r * np.c_[fan * np.cos(t), fan * np.sin(t)])
    turn = np.pi / 8 if kind == "octagon" else 0.0
    disc = Polygon(r * np.c_[np.cos(t + turn), np.sin(t + turn)])
    return scale(disc, 1.3, 0.9) if kind == "oval" else disc


def _pans(m: Model, inner: Polygon) -> list[Polygon]:
    """The outlines of the pans in a compact: one, two, or a grid of round or square ones with a slot for a brush."""
    x0, y0, x1, y1 = inner.bounds
    style = m.pick("one", "round", "two", "grid") if x1 < 1.2 * y1 else m.pick("grid", "grid", "two", "one")
    if style == "one":
        return [inner]
    if style == "round":
        return [Dot(0, 0).buffer(0.8 * y1, 5)]
    if style == "two":
        halves = [rectangle((-1, 1), (y0, -0.2 * y1 - 0.001)), rectangle((-1, 1), (-0.2 * y1 + 0.001, y1))]
        return [inner.intersection(half) for half in halves]
    count, wide = m.pick(2, 3, 4), 0.8 * (x1 - x0)
    step, found = wide / count, [rectangle((-0.4 * wide, 0.4 * wide), (0.75 * y0, 0.5 * y0))]
    pan = Dot(0, 0).buffer(0.42 * step, 4) if m.chance(0.5) else rectangle((-0.43 * step, 0.43 * step), (-0.4 * y1, 0.55 * y1))
    pan = scale(pan, 1.0, min(1.0, 0.5 * (y1 - y0) / (pan.bounds[3] - pan.bounds[1])))
    return found + [translate(pan, -0.5 * wide + (k + 0.5) * step, 0.15 * y1) for k in range(count)]


def _well(m: Model, part: str, outline: Polygon, z: Span, rim: float) -> None:
    """A body with pans of powder let into its top, or a deep well with a puff."""
    inner, floor = outline.buffer(-rim), z[0] + 0.3 * (z[1] - z[0])
    pans = [p.buffer(0) for p in _pans(m, inner)]
    m.add(part, cut(prism(outline, "z", z), *(prism(p, "z", (floor, z[1] + 1)) for p in pans)))
    for p in pans:
        if m.chance(0.85):
            m.add(part, prism(p.buffer(-m.pick(0.0002, 0.001)), "z", (floor - 0.0002, z[1] - m.number(0.0006, 0.0015))))


def powder_compact(m: Model) -> None:
    """A compact: a lid with a mirror, pans or a puff; round, square, long or a shell; perhaps a second tray, a button."""
    outline, low, top, rim = _compact_outline(m), m.number(0.006, 0.011), m.number(0.003, 0.007), m.number(0.002, 0.0035)
    _, y0, _, y1 = outline.bounds
    m.add(BASE, prism(outline.buffer(-0.002), "z", (0, 0.001)))
    _well(m, BASE, outline, (0.001, low), rim)
    z, g = low, m.pick(0.0, 0.0003, 0.0006)
    half = m.number(0.15, 0.3) * y1
    m.add(BASE, box((-half, half), (0.8 * y1, y1 + 0.001), (low - 0.003, low - 0.0003)))
    if m.chance(0.3):
        tray = m.number(0.003, 0.005)
        _well(m, "tray", outline, (z + g, z + g + tray), rim)
        m.hinge("tray", (0, y1 + 0.001, z), (-1, 0, 0), m.pick(50, 70))
        z += g + tray
    lid = prism(outline, "z", (z + g, z + g + top))
    inner = outline.buffer(-rim)
    hollow = m.chance(0.7)
    m.add("lid", cut(lid, prism(inner, "z", (z - 1, z + g + 0.5 * top))) if hollow else lid)
    level = z + g + (0.5 * top if hollow else 0.0)
    m.add("lid", prism(inner.buffer(-m.pick(0.0, 0.003)), "z", (level - 0.0008, level + 0.0002)))
    m.add("lid", box((-0.6 * half, 0.6 * half), (0.8 * y1, y1 + 0.001), (z + g + 0.0002, z + g + 0.6 * top)))
    m.hinge("lid", (0, y1 + 0.001, z + m.pick(0.0, g)), (-1, 0, 0), m.pick(90, 110, 135, 170))
    if m.chance(0.6):
        m.add(m.pick(BASE, "lid"), rod((-half, y1 + 0.001, z), (half, y1 + 0.001, z), 0.0014, 8))
    _clasp(m, y0, low, z + g + 0.5 * top)
    face = z + g + top
    deco = m.pick("none", "step", "ring", "sign", "dome")
    if deco in ("step", "dome"):
        m.add("lid", prism(outline.buffer(-0.003), "z", (face, face + 0.001)))
    if deco == "dome":
        m.add("lid", common(ball((0, 0, face), (0.8 * y1, 0.8 * y1, 0.004), 12), box((-1, 1), (-1, 1), (face, face + 1))))
    elif deco == "ring":
        m.add("lid", prism(inner.difference(inner.buffer(-0.0012)), "z", (face, face + 0.0006)))
    elif deco == "sign":
        m.add(
            "lid",
            prism(
                m.pick(Dot(0, 0).buffer(0.25 * y1, 3), rectangle((-0.3 * y1, 0.3 * y1), (-0.004, 0.004))),
                "z",
                (face, face + 0.0008),
            ),
        )


def _clasp(m: Model, front: float, low: float, high: float) -> None:
    """What opens a compact: a button that is pressed in, a lip of its lid, or nothing."""
    style, w = m.pick("button", "button", "lip", "none"), m.number(0.003, 0.006)
    if style == "button":
        m.add("button", box((-w, w), (front - 0.0015, front + 0.0015), (0.35 * low, 0.9 * low)))
        m.slide("button", (0, 1, 0), 0.0014)
    elif style == "lip":
        m.add("lid", box((-w, w), (front - 0.0015, front + 0.0015), (low - 0.001, high)))
