"""Building parts in six ways of modelling: props, open sheets, assemblies, rounded, cut from one block, old joinery."""

from __future__ import annotations

import itertools

import numpy as np
import trimesh
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import Model
from training.kinds.solids import Point, Span, ball, box, cut, prism, rectangle, ring, rod, tube, turned

STYLES = ("prop", "sheet", "assembly", "round", "block", "old")


def style_of(m: Model) -> str:
    return m.pick(*STYLES)


def quad(*corners: Point) -> Trimesh:
    """A flat surface without thickness."""
    return Trimesh(np.array(corners, float), [(0, k, k + 1) for k in range(1, len(corners) - 1)], process=False)


def without_side(solid: Trimesh, *sides: Point) -> Trimesh:
    """A solid without the faces that look in some directions."""
    keep = np.ones(len(solid.faces), bool)
    for side in sides:
        keep &= solid.face_normals @ np.asarray(side, float) < 0.9
    return Trimesh(solid.vertices, solid.faces[keep], process=False)


def soft(x: Span, y: Span, z: Span, radius: float, fine: bool = True) -> Trimesh:
    """A box with round edges, or cut ones."""
    low, high = np.sort(np.array([x, y, z], float), axis=1).T
    radius = min(radius, 0.49 * float((high - low).min()))
    way = trimesh.creation.icosphere(subdivisions=1).vertices if fine else np.concatenate([np.eye(3), -np.eye(3)])
    corners = np.array(np.meshgrid(*np.c_[low + radius, high - radius])).reshape(3, -1).T
    return trimesh.convex.convex_hull((corners[:, None] + radius * way[None]).reshape(-1, 3))


def slab(style: str, x: Span, y: Span, z: Span) -> Trimesh:
    """A box in a style; as a sheet it is one surface, or a box without a bottom."""
    size = np.abs(np.array([np.diff(s)[0] for s in (x, y, z)]))
    thin = int(size.argmin())
    if style == "round":
        return soft(x, y, z, 0.3 * size.min())
    if style == "old":
        return soft(x, y, z, 0.14 * size.min(), fine=False)
    if style != "sheet":
        return box(x, y, z)
    if size[thin] > 0.3 * np.sort(size)[1]:
        return without_side(box(x, y, z), (0, 0, -1))
    if thin == 0:
        at = (x[0] + x[1]) / 2
        return quad((at, y[0], z[0]), (at, y[1], z[0]), (at, y[1], z[1]), (at, y[0], z[1]))
    if thin == 1:
        at = min(y)
        return quad((x[0], at, z[0]), (x[1], at, z[0]), (x[1], at, z[1]), (x[0], at, z[1]))
    at = max(z)
    return quad((x[0], y[0], at), (x[1], y[0], at), (x[1], y[1], at), (x[0], y[1], at))


def plate(style: str, outline: Polygon | list[tuple[float, float]], y: Span) -> Trimesh:
    """An outline of (x, z) as a board, or as a surface."""
    solid = prism(outline, "y", y)
    return without_side(solid, (0, 1, 0)) if style == "sheet" else solid


def frame(style: str, a: Span, c: Span, y: Span, w: float | tuple[float, float, float, float]) -> list[Trimesh]:
    """A frame of (x, z); w: its widths, or (left, right, below, above)."""
    left, right, below, above = w if isinstance(w, tuple) else (w,) * 4
    if style in ("assembly", "round"):
        high = (c[0], c[1])
        made = [slab(style, (a[0], a[0] + left), y, high), slab(style, (a[1] - right, a[1]), y, high)]
        inner = (a[0] + left - 0.002, a[1] - right + 0.002)
        made += [slab(style, inner, y, z) for z in ((c[0], c[0] + below), (c[1] - above, c[1])) if z[1] > z[0]]
        return made
    hole = rectangle((a[0] + left, a[1] - right), (c[0] + below - (0.1 if below == 0 else 0), c[1] - above))
    made = [plate(style, rectangle(a, c).difference(hole), y)]
    if style == "old":
        edge, step = 0.3 * min(left, right, above), 0.25 * (y[1] - y[0])
        inner = (a[0] + left - edge, a[1] - right + edge), (c[0] + below - (edge if below else -0.001), c[1] - above + edge)
        ringed = rectangle(*inner).difference(hole.buffer(-0.15 * edge, join_style="mitre"))
        made.append(prism(ringed, "y", (y[0] - step, y[0] + step)))
    return made


def _filled(m: Model, style: str, look: str, a: Span, c: Span, y: Span) -> list[Trimesh]:
    """What a leaf has inside its frame: glass with bars, panels, or slats."""
    deep, wide, high = y[1] - y[0], a[1] - a[0], c[1] - c[0]
    middle, tongue = (y[0] + y[1]) / 2, 0.01 * min(wide, high)
    if look == "slats":
        count, lean = m.pick(6, 9, 14), m.pick(25, 40)
        made = []
        for k in range(count):
            z = c[0] + (k + 0.5) * high / count
            flat = slab(style, (a[0] - tongue, a[1] + tongue), (y[0] + 0.1 * deep, y[1] - 0.1 * deep), (z, z + 0.15 * deep))
            made.append(turned(flat, (1, 0, 0), lean, (0, middle, z)))
        return made
    if look == "panels":
        inner = (a[0] - tongue, a[1] + tongue), (c[0] - tongue, c[1] + tongue)
        made = [slab("prop" if style != "sheet" else style, inner[0], (middle - 0.15 * deep, middle + 0.15 * deep), inner[1])]
        columns, rows, bar = m.pick(1, 2), m.pick(1, 2, 3), 0.06 * wide
        raised = style in ("old", "round") or m.chance(0.3)
        for i in range(columns if raised else 0):
            for j in range(rows):
                x0, z0 = a[0] + i * wide / columns + 0.7 * bar, c[0] + j * high / rows + 0.7 * bar
                x1, z1 = a[0] + (i + 1) * wide / columns - 0.7 * bar, c[0] + (j + 1) * high / rows - 0.7 * bar
                made.append(soft((x0, x1), (middle - 0.4 * deep, middle + 0.4 * deep), (z0, z1), 0.2 * deep, fine=False))
    else:
        inner = (a[0] - tongue, a[1] + tongue), (c[0] - tongue, c[1] + tongue)
        made = [slab("sheet", inner[0], (middle, middle + 0.001), inner[1])]
        if style != "sheet":
            made = [box(inner[0], (middle - 0.08 * deep, middle + 0.08 * deep), inner[1])]
        columns, rows, bar = *m.pick((1, 1), (1, 1), (1, 2), (2, 3), (2, 2), (1, 3)), 0.05 * min(wide, high)
    span = (y[0] + 0.15 * deep, y[1] - 0.15 * deep)
    made += [
        slab(style, (x - bar / 2, x + bar / 2), span, (c[0] - tongue, c[1] + tongue))
        for x in np.linspace(a[0], a[1], columns + 1)[1:-1]
    ]
    return made + [
        slab(style, (a[0] - tongue, a[1] + tongue), span, (z - bar / 2, z + bar / 2))
        for z in np.linspace(c[0], c[1], rows + 1)[1:-1]
    ]


def _boards(m: Model, style: str, a: Span, c: Span, y: Span) -> list[Trimesh]:
    """Upright boards on ledges with a brace behind."""
    wide, high, deep = a[1] - a[0], c[1] - c[0], y[1] - y[0]
    count, joint = m.pick(4, 5, 7), m.pick(0.0, 0.004, 0.008)
    edges = np.linspace(a[0], a[1], count + 1)
    front, back = (y[0], y[0] + 0.55 * deep), (y[0] + 0.55 * deep, y[1])
    made = [slab(style, (p + joint, q - joint), front, c) for p, q in itertools.pairwise(edges)]
    rails = [c[0] + s * high for s in m.pick((0.12, 0.82), (0.1, 0.46, 0.84))]
    made += [slab(style, (a[0] + 0.04 * wide, a[1] - 0.04 * wide), back, (z, z + 0.08 * high)) for z in rails]
    if m.chance(0.6):
        b, t = 0.1 * wide, 0.05 * wide
        low, top = rails[0] + 0.06 * high, rails[-1] + 0.02 * high
        line = [(a[0] + t, low), (a[0] + t + b, low), (a[1] - t, top), (a[1] - t - b, top)]
        made.append(plate(style, line, back))
    return made


def leaf(m: Model, style: str, look: str, a: Span, c: Span, y: Span) -> list[Trimesh]:
    """A leaf of glass, panels, slats, boards or flat, between x, z and y."""
    if look == "boards":
        return _boards(m, style, a, c, y)
    wide, high, deep = a[1] - a[0], c[1] - c[0], y[1] - y[0]
    w = m.number(0.08, 0.16) * min(wide, high)
    if look != "flat":
        inner = (a[0] + w, a[1] - w), (c[0] + w, c[1] - w)
        return frame(style, a, c, y, w) + _filled(m, style, look, *inner, y)
    inner = (a[0] + w, a[1] - w), (c[0] + w, c[1] - w)
    if style == "block":
        return [cut(box(a, y, c), box(inner[0], (y[0] - 1, y[0] + 0.25 * deep), inner[1]))]
    made = [slab(style, a, y, c)]
    if style != "sheet" and m.chance(0.5):
        made.append(slab(style, inner[0], (y[0] - 0.12 * deep, y[0] + 0.1 * deep), inner[1]))
    return made


def grip(m: Model, style: str, x: float, z: float, y: float, way: float = -1.0, size: float = 1.0) -> list[Trimesh]:
    """A fixed pull on a face at y that looks along way: a bar, a knob, a hoop, a plate with a rim, or none."""
    look = m.pick("bar", "knob", "block", "hoop", "none")
    out, s = y + way * 0.04 * size, size
    if look == "bar":
        h = m.pick(0.06, 0.12, 0.25) * s
        path = [(x, y - way * 0.003, z - h), (x, out, z - h), (x, out, z + h), (x, y - way * 0.003, z + h)]
        if style in ("prop", "block", "sheet"):
            ends = [box((x - 0.008, x + 0.008), (y - way * 0.003, out), (v, v + 0.015 * s)) for v in (z - h, z + h - 0.015 * s)]
            return [*ends, box((x - 0.01, x + 0.01), (out - 0.006, out + 0.006), (z - h, z + h))]
        return [tube(path, 0.009 * s, 8)]
    if look == "knob":
        stem = rod((x, y - way * 0.003, z), (x, out, z), 0.009 * s, m.sections())
        return [stem, ball((x, out, z), (0.026 * s, 0.016 * s, 0.026 * s), 10)]
    if look == "block":
        return [
            slab(
                "round" if style == "round" else "old",
                (x - 0.015 * s, x + 0.015 * s),
                (y - way * 0.003, out),
                (z - 0.05 * s, z + 0.05 * s),
            )
        ]
    if look == "hoop":
        back = box((x - 0.02 * s, x + 0.02 * s), (y - way * 0.003, y + way * 0.008), (z - 0.035 * s, z + 0.035 * s))
        return [back, ring((x, y + way * 0.014, z - 0.03 * s), (0, 1, 0), 0.035 * s, 0.007 * s, 16)]
    return []


def lever(m: Model, part: str, parent: str, at: Point, toward: float, way: float = -1.0, degrees: float = 45.0) -> None:
    """A handle that turns on its leaf; its arm points toward +x or -x and is pressed down."""
    x, y, z = at
    long, out = m.number(0.09, 0.13), m.number(0.035, 0.05)
    m.add(parent, box((x - 0.02, x + 0.02), (y - way * 0.003, y + way * 0.006), (z - 0.08, z + m.pick(0.04, 0.1))))
    m.add(part, rod((x, y, z), (x, y + way * out, z), 0.01, m.sections()))
    arm = (x - toward * 0.01, x + toward * long), (y + way * (out - 0.012), y + way * (out + 0.004)), (z - 0.01, z + 0.01)
    m.add(part, slab(m.pick("round", "prop"), *arm))
    m.hinge(part, (x, y, z), (0, toward, 0), degrees, parent)
