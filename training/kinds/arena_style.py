"""Bodies, plates, limbs, wheels and trims of one artist of science fiction and arms, each in one of six conventions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import Model
from training.kinds.solids import Point, Span, ball, box, cut, moved, prism, rectangle, rod, rounded, vec

STYLES = ("low", "low", "sheet", "cad", "round", "cut", "old")


@dataclass(frozen=True)
class Look:
    """The convention of an object: its style, the sections of a circle and the share of a side that is bevelled."""

    style: str
    n: int
    bevel: float

    def body(self, x: Span, y: Span, z: Span, without: str = "") -> list[Trimesh]:
        """A block; an open sheet lacks the side `without` such as "+z"."""
        side = min(abs(s[1] - s[0]) for s in (x, y, z))
        if self.style == "sheet":
            return [shell(x, y, z, without)]
        if self.style == "cad":
            return boards(x, y, z, 0.08 * side)
        if self.style == "round":
            return [superbox(x, y, z, 4 + 40 * self.bevel)]
        if self.style == "cut":
            lid = z[0] + 0.72 * (z[1] - z[0])
            seam, d = 0.02 * side, 0.03 * side
            band = prism(rectangle((x[0] - d, x[1] + d), (y[0] - d, y[1] + d), 2 * d), "z", (lid, lid + seam))
            return [cut(bevelled(x, y, z, 0.05 * side), band)]
        if self.style == "old":
            t = 0.06 * side
            rims = [box((x[0] - t, x[1] + t), (y[0] - t, y[1] + t), s) for s in ((z[0], z[0] + 2 * t), (z[1] - 1.5 * t, z[1]))]
            return [box(x, y, z), *rims]
        return [bevelled(x, y, z, self.bevel * side) if self.bevel > 0.05 else box(x, y, z)]

    def plate(self, x: Span, y: Span, z: Span, face: str) -> list[Trimesh]:
        """A flat panel that looks along `face`, such as "-y"."""
        spans, axis = {"x": x, "y": y, "z": z}, face[1]
        a, b = (tuple(sorted(spans[k])) for k in "xyz" if k != axis)
        low, high = sorted(spans[axis])
        return self.panel(rectangle(a, b), axis, (low, high) if face[0] == "+" else (high, low))

    def panel(self, outline: Polygon, axis: str, depth: Span) -> list[Trimesh]:
        """A panel of any outline along an axis, from its inner to its outer depth."""
        inner, outer = depth
        t = outer - inner
        left, low, right, high = outline.bounds
        side = min(right - left, high - low)
        small = outline.buffer(-0.14 * side, join_style="mitre")
        hollow = small.geom_type == "Polygon" and not small.is_empty
        if self.style == "sheet":
            flat = prism(outline, axis, (min(depth), min(depth) + abs(t)))
            normals = flat.face_normals[:, "xyz".index(axis)]
            return [Trimesh(flat.vertices, flat.faces[normals * np.sign(t) > 0.9], process=True)]
        if self.style == "round":
            soft = outline.buffer(-0.1 * side, join_style="mitre").buffer(0.1 * side, quad_segs=3)
            pieces = [prism(soft, axis, (inner, inner + 0.85 * t))]
            return pieces + ([prism(small.buffer(0.06 * side), axis, (inner + 0.8 * t, outer))] if hollow else [])
        if not hollow or self.style == "low":
            return [prism(outline, axis, depth)]
        if self.style == "cut":
            return [cut(prism(outline, axis, depth), prism(small, axis, (inner + 0.7 * t, outer + t)))]
        if self.style == "cad":
            return [prism(outline, axis, (inner, inner + 0.9 * t)), *self._screws(outline, axis, inner, outer, 0.02 * side)]
        frame = outline.difference(small)
        raised = small.buffer(-0.05 * side, join_style="mitre")
        return [prism(frame, axis, depth), prism(small, axis, (inner + 0.2 * t, inner + 0.6 * t))] + (
            [prism(raised, axis, (inner + 0.5 * t, inner + 0.85 * t))] if raised.geom_type == "Polygon" else []
        )

    def _screws(self, outline: Polygon, axis: str, inner: float, outer: float, radius: float) -> list[Trimesh]:
        ring = outline.buffer(-4 * radius, join_style="mitre")
        if ring.geom_type != "Polygon" or ring.is_empty:
            return []
        spots = np.array(ring.exterior.coords)[:-1][:8]
        deep = (inner + 0.3 * (outer - inner), outer)
        turn = np.linspace(0, 2 * np.pi, 6, endpoint=False)
        hexagon = radius * np.c_[np.cos(turn), np.sin(turn)]
        return [prism(Polygon(hexagon + spot), axis, deep) for spot in spots]

    def limb(self, a: Point, b: Point, wide: float, thick: float, side: Point = (1, 0, 0), taper: float = 1.0) -> list[Trimesh]:
        """A member between two points: `wide` along `side`, `thick` across; taper scales its far end."""
        long = float(np.linalg.norm(np.asarray(b, float) - np.asarray(a, float)))
        w, t = (-wide / 2, wide / 2), (-thick / 2, thick / 2)
        if self.style == "sheet":
            found = [shell(w, t, (0, long), "-z")]
        elif self.style == "cad":
            outline = rounded(t, (-0.3 * thick, long + 0.3 * thick), 0.4 * thick)
            found = [prism(outline, "x", (s * 0.5 * wide, s * 0.32 * wide)) for s in (-1, 1)]
            found += [rod((w[0], 0, q * long), (w[1], 0, q * long), 0.18 * thick, self.n) for q in (0.03, 0.5, 0.97)]
        elif self.style == "round":
            found = [superbox(w, t, (-0.06 * long, 1.06 * long), 3.2)]
        elif self.style == "cut":
            slot = box((w[0] - wide, w[1] + wide), (-0.2 * thick, 0.2 * thick), (0.25 * long, 0.75 * long))
            found = [cut(bevelled(w, t, (0, long), 0.12 * min(wide, thick)), slot)]
        elif self.style == "old":
            shape = [(0, 0), (0.9, 0), (1, 0.08), (0.6, 0.16), (0.75, 0.4), (0.5, 0.72), (0.8, 0.84), (0.7, 1), (0, 1)]
            found = [lathe([(0.5 * r * min(wide, thick) * 1.1, h * long) for r, h in shape], self.n)]
        else:
            found = [box(w, t, (0, long))]
        return [_laid(s, a, b, side, taper, long) for s in found]

    def knuckle(self, at: Point, axis: Point, radius: float, half: float) -> list[Trimesh]:
        """What is seen of a joint: a pin, a pin with washers or a ball."""
        at, axis = np.asarray(at, float), np.asarray(axis, float)
        if self.style == "round":
            return [ball(at, (1.1 * radius,) * 3, max(8, self.n))]
        found = [rod(at - half * axis, at + half * axis, radius, self.n)]
        if self.style in ("cad", "old"):
            found += [rod(at + s * half * axis, at + s * 1.15 * half * axis, 0.6 * radius, 6) for s in (-1, 1)]
        return found

    def wheel(self, at: Point, axis: Point, radius: float, half: float) -> list[Trimesh]:
        """A wheel about an axis."""
        n, h = max(10, self.n), half
        if self.style in ("low", "sheet"):
            found = [rod((0, 0, -h), (0, 0, h), radius, n)]
        elif self.style == "round":
            found = [lathe([(0, -h), (0.8 * radius, -h), (radius, -0.5 * h), (radius, 0.5 * h), (0.8 * radius, h), (0, h)], n)]
        elif self.style == "cut":
            holes = [
                rod((0.55 * radius * c, 0.55 * radius * s, -1), (0.55 * radius * c, 0.55 * radius * s, 1), 0.2 * radius, 8)
                for c, s in ((1, 0), (-0.5, 0.87), (-0.5, -0.87))
            ]
            found = [cut(rod((0, 0, -h), (0, 0, h), radius, n), *holes)]
        else:
            found = [
                trimesh.creation.annulus(0.8 * radius, radius, 2 * h, sections=n),
                rod((0, 0, -1.1 * h), (0, 0, 1.1 * h), 0.2 * radius, n),
            ]
            for k in range(5):
                c, s = np.cos(2.5133 * k / 2), np.sin(2.5133 * k / 2)
                found.append(
                    _laid(
                        box((-0.08 * radius, 0.08 * radius), (-0.6 * h, 0.6 * h), (0, 0.7 * radius)),
                        vec(0.15 * radius * c, 0.15 * radius * s, 0),
                        vec(0.85 * radius * c, 0.85 * radius * s, 0),
                        (-s, c, 0),
                        1.0,
                        0.7 * radius,
                    )
                )
        turn = trimesh.geometry.align_vectors([0, 0, 1], np.asarray(axis, float))
        for solid in found:
            solid.apply_transform(turn)
        return [moved(s, at) for s in found]


def look(m: Model) -> Look:
    """The convention of one object."""
    style = m.pick(*STYLES)
    n = m.pick(6, 8, 10) if style in ("low", "sheet") else m.pick(12, 16, 24)
    return Look(style, n, m.pick(0.0, 0.1, 0.18))


def bevelled(x: Span, y: Span, z: Span, size: float) -> Trimesh:
    """A box with bevelled edges."""
    x, y, z = (tuple(sorted(s)) for s in (x, y, z))
    spots = []
    for k in range(3):
        inset = [0.0 if i == k else size for i in range(3)]
        spots += [
            (sx[0] + sx[1] * inset[0], sy[0] + sy[1] * inset[1], sz[0] + sz[1] * inset[2])
            for sx in ((x[0], 1), (x[1], -1))
            for sy in ((y[0], 1), (y[1], -1))
            for sz in ((z[0], 1), (z[1], -1))
        ]
    return trimesh.convex.convex_hull(np.array(spots))


def superbox(x: Span, y: Span, z: Span, power: float) -> Trimesh:
    """A superellipsoid that fills a box."""
    solid = trimesh.creation.icosphere(subdivisions=3 if power < 5 else 2)
    length = (np.abs(solid.vertices) ** power).sum(1) ** (1 / power)
    spans = np.sort(np.array([x, y, z], float), axis=1)
    solid.vertices = spans.mean(1) + solid.vertices / length[:, None] * np.ptp(spans, axis=1) / 2
    return solid


def shell(x: Span, y: Span, z: Span, without: str = "") -> Trimesh:
    """The sides of a box as a sheet without thickness, one of them left out."""
    solid = box(x, y, z)
    if not without:
        return solid
    sign = 1 if without[0] == "+" else -1
    return Trimesh(solid.vertices, solid.faces[solid.face_normals[:, "xyz".index(without[1])] * sign < 0.5], process=False)


def boards(x: Span, y: Span, z: Span, t: float) -> list[Trimesh]:
    """A closed box of six boards."""
    return [
        box(x, y, (z[0], z[0] + t)),
        box(x, y, (z[1] - t, z[1])),
        *(box(s, y, (z[0] + t, z[1] - t)) for s in ((x[0], x[0] + t), (x[1] - t, x[1]))),
        *(box((x[0] + t, x[1] - t), s, (z[0] + t, z[1] - t)) for s in ((y[0], y[0] + t), (y[1] - t, y[1]))),
    ]


def lathe(profile: Sequence[Sequence[float]], sections: int) -> Trimesh:
    """A profile of (radius, z) turned about the z axis."""
    solid = trimesh.creation.revolve(np.array(profile, float), sections=max(6, sections))
    if solid.volume < 0:
        solid.invert()
    return solid


def _laid(solid: Trimesh, a: Point, b: Point, side: Point, taper: float, long: float) -> Trimesh:
    """A solid along z from 0 to `long` laid from a to b with its x along a side."""
    start, along = np.asarray(a, float), np.asarray(b, float) - np.asarray(a, float)
    along = along / np.linalg.norm(along)
    across = np.asarray(side, float) - (np.asarray(side, float) @ along) * along
    across = across / np.linalg.norm(across)
    u, v, w = solid.vertices.T
    scale = 1 + (taper - 1) * np.clip(w / long, 0, 1)
    third = np.cross(along, across)
    solid.vertices = start + np.outer(u * scale, across) + np.outer(v * scale, third) + np.outer(w, along)
    return solid
