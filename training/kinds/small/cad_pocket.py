"""Folding knives as several artists model them: two scales and a blade, layers of tools, two handles."""

from __future__ import annotations

import numpy as np
import trimesh
from shapely.geometry import LineString, Polygon
from shapely.geometry import Point as Dot
from trimesh import Trimesh

from training.kinds.cad_style import bevelled, bolt, convention, rounds
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, ring, rod, rounded, turned, vec


def _leaf(style: str, outline: Polygon, z: Span, edge: bool = False) -> Trimesh:
    """A flat piece: a single surface in a sheet, thinner at its lower edge when ground."""
    if style == "sheet":
        points, faces = trimesh.creation.triangulate_polygon(outline)
        return Trimesh(np.c_[points, np.full(len(points), sum(z) / 2)], faces, process=False)
    solid = prism(outline, "z", z)
    if edge and style != "prop":
        low, high = solid.bounds[0, 1], solid.bounds[1, 1]
        share = np.clip((solid.vertices[:, 1] - low) / (0.5 * (high - low)), 0.25, 1)
        solid.vertices[:, 2] = sum(z) / 2 + (solid.vertices[:, 2] - sum(z) / 2) * share
    return solid


def _tool(m: Model, form: str, long: float, h: float) -> Polygon:
    """A blade, saw, driver, opener or file from a pin at the origin along +x; its edge at -y."""
    a, b = -0.42 * h, 0.3 * h
    tang = Dot(0, 0).buffer(0.3 * h, quad_segs=4)
    if form == "blade":
        tip = m.pick((long, 0.5 * (a + b)), (long, b), (long, 0.6 * a))
        edge = [(0.12 * long, a), (0.7 * long, a), (0.9 * long, 0.6 * a + 0.4 * tip[1])]
        body = Polygon([(0, -0.28 * h), (0.1 * long, -0.28 * h), *edge, tip, (0.75 * long, b), (0, b)])
    elif form == "saw":
        teeth = [(0.12 * long + k * 0.04 * long, a if k % 2 else a + 0.12 * h) for k in range(21)]
        body = Polygon([(0, -0.2 * h), *teeth, (0.96 * long, 0.2 * h), (0, 0.25 * h)])
    elif form == "driver":
        body = Polygon(
            [(0, -0.15 * h), (0.9 * long, -0.15 * h), (long, -0.25 * h), (long, 0.2 * h), (0.9 * long, 0.15 * h), (0, 0.15 * h)]
        )
    elif form == "opener":
        notch = Dot(0.6 * long, a).buffer(0.25 * h, quad_segs=4)
        body = Polygon([(0, -0.25 * h), (0.9 * long, a), (long, 0.1 * h), (0.8 * long, b), (0, b)]).difference(notch)
    else:
        body = Polygon([(0, -0.2 * h), (0.95 * long, -0.2 * h), (long, 0), (0.95 * long, 0.2 * h), (0, 0.2 * h)])
    return tang.union(body)


def _scale(form: str, long: float, h: float, end: float) -> Polygon:
    """The side of a handle from x = -end on."""
    if form == "straight":
        return rounded((-end, long + end), (-h / 2, h / 2), 0.49 * h, 6)
    if form == "waisted":
        x = np.linspace(-end, long + end, 12)
        t = (x + end) / (long + 2 * end)
        top, low = h * (0.42 + 0.08 * np.cos(4 * np.pi * t)), -h * (0.4 + 0.1 * np.cos(2 * np.pi * t))
        return Polygon([*zip(x, low, strict=True), *zip(x[::-1], top[::-1], strict=True)])
    return Polygon(
        [
            (-end, -0.3 * h),
            (0, -0.5 * h),
            (long, -0.5 * h),
            (long + end, -0.2 * h),
            (long + end, 0.35 * h),
            (long, 0.5 * h),
            (-end, 0.5 * h),
        ]
    )


def _handle(m: Model, style: str, long: float, h: float, thick: float, cover: float, layers: int) -> None:
    """Two scales with a back between them, or one solid with slots; pins through all."""
    outline, end = _scale(m.pick("straight", "straight", "waisted", "angled"), long, h, 0.45 * h), 0.45 * h
    z, back = layers * thick / 2, 0.34 * h
    if style == "hollow":
        solid = prism(outline, "z", (-z - cover, z + cover))
        m.add(BASE, cut(solid, box((-1, 1), (-1, back), (-z + 0.0002, z - 0.0002))))
    else:
        for s in (-1, 1):
            m.add(BASE, _leaf(style, outline, (s * z, s * (z + (0.3 if style == "assembly" else 1) * cover))))
            if style == "assembly":
                m.add(BASE, prism(outline.buffer(-0.06 * h), "z", (s * (z + 0.3 * cover), s * (z + cover))))
            if style == "antique":
                x = [(a * long, b * long) for a, b in ((-0.1, 0.08), (0.92, 1.1))]
                m.add(
                    BASE,
                    *(
                        prism(
                            outline.intersection(Polygon([(a, -h), (b, -h), (b, h), (a, h)])),
                            "z",
                            (s * z, s * (z + 1.3 * cover)),
                        )
                        for a, b in x
                    ),
                )
        spine = outline.intersection(Polygon([(0.4 * h, back), (long + end, back), (long + end, h), (0.4 * h, h)]))
        m.add(BASE, prism(spine, "z", (-z, z)))
    for x in (0.0, long) if layers > 1 or m.chance(0.5) else (0.0,):
        if style == "assembly":
            m.add(BASE, *(b for s in (-1, 1) for b in bolt((x, 0, s * (z + cover)), (0, 0, s), 0.13 * h)))
        m.add(BASE, rod((x, 0, -z - 1.1 * cover), (x, 0, z + 1.1 * cover), 0.12 * h, 8 if style == "prop" else 14))


def _jack(m: Model, style: str, n: int) -> None:
    """One blade, folded in or out; a button, a slide, a stud or a clip."""
    long, h = m.number(0.07, 0.12), m.number(0.018, 0.028)
    thick, cover = m.number(0.002, 0.0035), m.number(0.002, 0.005)
    _handle(m, style, long, h, 1.3 * thick, cover, 1)
    solids = [_leaf(style, _tool(m, "blade", m.number(0.8, 0.98) * long, h), (-0.5 * thick, 0.5 * thick), True)]
    if m.chance(0.5):
        x = 0.25 * long
        solids.append(rod((x, -0.52 * h, -1.2 * thick), (x, -0.52 * h, 1.2 * thick), 0.1 * h, n))
        solids.append(box((x - 0.1 * h, x + 0.1 * h), (-0.55 * h, -0.3 * h), (-0.5 * thick, 0.5 * thick)))
    if m.chance(0.4) and style != "sheet":
        solids.append(box((0.2 * long, 0.5 * long), (0.12 * h, 0.2 * h), (-0.55 * thick, 0.55 * thick)))
    out = m.pick(0, 0, 180, 180, 90)
    m.add("blade", *(turned(s, (0, 0, -1), out, (0, 0, 0)) for s in solids))
    m.hinge("blade", (0, 0, 0), (0, 0, -1), (-out, m.pick(180, 178) - out if out < 170 else 0))
    top = 0.65 * thick + cover
    if m.chance(0.35):
        m.add("lock_button", rod((0.2 * long, 0.1 * h, top - 0.001), (0.2 * long, 0.1 * h, top + 0.0015), 0.14 * h, n))
        m.slide("lock_button", (0, 0, -1), 0.0015)
    elif m.chance(0.4):
        m.add("safety", bevelled((0.3 * long, 0.3 * long + 0.009), (-0.1 * h, 0.1 * h), (top - 0.0003, top + 0.002), 0.0005))
        m.slide("safety", (1, 0, 0), 0.006)
    if m.chance(0.5):
        clip = [(1.0 * long, -top), (0.95 * long, -top - 0.002), (0.4 * long, -top - 0.002), (0.38 * long, -top - 0.0002)]
        m.add(BASE, prism(LineString(clip).buffer(0.0005, cap_style="flat"), "y", (-0.12 * h, 0.12 * h)))


def _multi(m: Model, style: str, n: int) -> None:
    """Layers of tools that turn out from both ends of a handle."""
    long, h, thick, layers = m.number(0.06, 0.09), m.number(0.02, 0.026), m.number(0.002, 0.003), m.pick(2, 3, 4)
    _handle(m, style, long, h, thick, m.number(0.002, 0.004), layers)
    tools = list(m.rng.permutation(["blade", "saw", "driver", "opener", "file", "blade", "opener"]))
    for k in range(layers):
        mid = (k - (layers - 1) / 2) * thick
        z = (mid - 0.42 * thick, mid + 0.42 * thick)
        pair = m.chance(0.4)
        for end in (0, 1) if pair else (m.pick(0, 1),):
            form = str(tools.pop())
            reach = (m.number(0.38, 0.44) if pair else m.number(0.75, 0.95)) * long
            solid = _leaf(style, _tool(m, form, reach, 0.9 * h), z, form == "blade")
            if end:
                solid.apply_transform(np.diag([-1.0, 1, 1, 1]))
                solid.apply_translation((long, 0, 0))
            axis, at = (0, 0, 1 if end else -1), vec(long * end, 0, 0)
            out = m.pick(0, 0, 0, 90, 180)
            name = f"{form}_{k}{'_back' if end else ''}"
            m.add(name, turned(solid, axis, out, at))
            m.hinge(name, at, axis, (-out, 180 - out))
    if m.chance(0.6):
        m.add("ring", ring((long + 0.45 * h + 0.005, 0, 0), (0, 1, 0), 0.007, 0.0008, 20))
        m.hinge("ring", (long + 0.45 * h - 0.0015, 0, 0), (0, 1, 0), (-80, 80))


def _butterfly(m: Model, style: str, n: int) -> None:
    """A blade between two handles that both turn."""
    long, h, thick, cover = m.number(0.1, 0.13), m.number(0.011, 0.015), m.number(0.003, 0.004), 0.0022
    pins = {"handle": vec(0, h / 2, 0), BASE: vec(0, -h / 2, 0)}
    for part, p in pins.items():
        inner = -1 if part == "handle" else 1
        outline = rounded((-0.4 * h, long), (p[1] - 0.48 * h, p[1] + 0.48 * h), 0.3 * h)
        if m.chance(0.5):
            holes = [Dot(f * long, p[1]).buffer(0.22 * h) for f in np.linspace(0.2, 0.8, m.pick(3, 4, 5))]
            outline = outline.difference(holes[0]).difference(holes[1]).difference(holes[2])
        for s in (-1, 1):
            m.add(part, _leaf(style, outline, (s * 0.55 * thick, s * (0.55 * thick + cover))))
        edge = sorted((p[1] + inner * 0.3 * h, p[1] + inner * 0.48 * h))
        m.add(part, box((1.2 * h, 0.97 * long), edge, (-0.56 * thick, 0.56 * thick)))
        m.add(part, rod(p - vec(0, 0, thick / 2 + 1.3 * cover), p + vec(0, 0, thick / 2 + 1.3 * cover), 0.2 * h, n))
    w = 0.75 * h
    reach = 0.92 * long
    tip = [(-0.2 * reach, -w), (-0.8 * reach, -w), (-reach, m.pick(0.0, 0.6 * w)), (-0.75 * reach, w), (-0.2 * reach, w)]
    m.add("blade", _leaf(style, Polygon([(0.3 * h, -w), *tip, (0.3 * h, w)]), (-thick / 2, thick / 2)))
    m.hinge("blade", pins[BASE], (0, 0, 1), 180)
    m.hinge("handle", pins["handle"], (0, 0, 1), 180, "blade")


def folding_knife(m: Model) -> None:
    """A blade that folds into its handle, layers of tools, or a blade between two handles."""
    style = convention(m)
    form = m.pick(_jack, _jack, _multi, _multi, _butterfly)
    form(m, style, rounds(m, style))
    lie = m.pick(0, 0, 90)
    if lie:
        _tip(m, lie)


def _tip(m: Model, degrees: float) -> None:
    """Stand everything on its edge."""
    for _, solid in m.pieces:
        turned(solid, (1, 0, 0), degrees, (0, 0, 0))
    turn = trimesh.transformations.rotation_matrix(np.deg2rad(degrees), (1, 0, 0))[:3, :3]
    for joint in m.joints.values():
        joint.origin[:], joint.axis[:] = turn @ joint.origin, turn @ joint.axis
