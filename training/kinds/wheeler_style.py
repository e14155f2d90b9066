"""One artist's ways of modelling vehicles: bodies out of three views, openings taken out of their skin, wheels, seats."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import trimesh
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, common, cut, moved, prism, rectangle, rod

STYLES = ("low", "sheet", "cad", "round", "flush")
Outline = Polygon | list[tuple[float, float]]


def three_view(side: Polygon, front: Polygon, plan: Polygon | None = None) -> Trimesh:
    """What outlines seen from the side (y, z), the front (x, z) and above (x, y) share."""
    (x0, _, x1, _), (y0, _, y1, _) = front.bounds, side.bounds
    solid = common(prism(side, "x", (x0 - 1, x1 + 1)), prism(front, "y", (y0 - 1, y1 + 1)))
    return solid if plan is None else common(solid, prism(plan, "z", (side.bounds[1] - 1, side.bounds[3] + 1)))


def softened(outline: Outline, radius: float, sections: int = 3) -> Polygon:
    """An outline with round corners."""
    polygon = Polygon(outline)
    if radius <= 0:
        return polygon
    inside = polygon.buffer(-radius, join_style=2)
    soft = inside.buffer(radius, quad_segs=sections)
    return soft if isinstance(soft, Polygon) and not soft.is_empty else polygon


def cross_section(half: float, low: float, waist: float, top: float, narrow: float) -> list[tuple[float, float]]:
    """The front view of a cab: upright up to the waist, then leaning in to narrow * half at the top."""
    n = narrow * half
    return [
        (-0.94 * half, low),
        (0.94 * half, low),
        (half, low + 0.12),
        (half, waist),
        (n, top),
        (-n, top),
        (-half, waist),
        (-half, low + 0.12),
    ]


@dataclass
class Hull:
    """A body of which parts are taken: skin is its outside, inner its inside, rest what is left of it."""

    m: Model
    style: str
    skin: Trimesh
    inner: Trimesh
    rest: Trimesh
    wall: float
    gap: float
    laid: bool
    glazed: bool
    hollow: bool

    def bite(self, outline: Polygon, axis: str, depth: Span, grow: float = 0.0) -> Trimesh:
        outline = outline.buffer(grow, join_style=2) if grow else outline
        return cut(prism(outline, axis, depth), self.inner)

    def take(self, outline: Outline, axis: str, depth: Span, out: Point) -> Trimesh:
        """A panel out of the skin; laid panels lie on a body without an opening."""
        outline = Polygon(outline)
        piece = common(self.skin, self.bite(outline, axis, depth))
        if self.laid:
            return moved(piece, 0.92 * self.wall * np.asarray(out, float))
        self.rest = cut(self.rest, self.bite(outline, axis, depth, self.gap))
        return piece

    def put(self, part: str, piece: Trimesh, *windows: Trimesh, shift: Point = (0, 0, 0)) -> None:
        """Adds a panel with its windows, as a sheet if that is the style."""
        for window in windows:
            glass, piece = common(piece, window), cut(piece, window)
            if self.glazed and len(glass.faces):
                self.m.add(part, moved(self.sheet(glass), shift))
        self.m.add(part, moved(self.sheet(piece), shift))

    def pane(self, outline: Outline, axis: str, depth: Span) -> None:
        """A window in the body itself."""
        bite = self.bite(Polygon(outline), axis, depth)
        glass = common(self.rest, bite)
        if not len(glass.faces):
            return
        self.rest = cut(self.rest, bite)
        if self.glazed or self.laid:
            self.m.add(BASE, self.sheet(glass))

    def arch(self, y: float, z: float, radius: float, depth: float, half: float) -> None:
        """Room for a wheel on either side."""
        for s in (-1, 1):
            room = rod((s * (half - depth), y, z), (s * (half + 0.5), y, z), radius, 16 if self.style == "low" else 32)
            self.skin, self.rest = cut(self.skin, room), cut(self.rest, room)

    def sheet(self, piece: Trimesh) -> Trimesh:
        """Only the faces on the outer skin, if the style is of sheets."""
        if self.style != "sheet" or not len(piece.faces):
            return piece
        _, away, _ = trimesh.proximity.closest_point(self.skin, piece.triangles_center)
        on = away < 1e-4
        return Trimesh(piece.vertices, piece.faces[on], process=False) if on.any() else piece

    def finish(self) -> None:
        self.m.add(BASE, self.sheet(self.rest))


def hull_of(m: Model, style: str, skin: Trimesh, inner: Trimesh, wall: float) -> Hull:
    """A hollow or a solid body, as is the style's way."""
    hollow = style in ("sheet", "cad") or (style == "round" and m.chance(0.6)) or (style == "low" and m.chance(0.2))
    laid = not hollow and m.chance({"low": 0.5}.get(style, 0.0))
    gap = 0.0 if laid else m.gap(1.0)
    return Hull(m, style, skin, inner, cut(skin, inner) if hollow else skin, wall, gap, laid, m.chance(0.6), hollow)


def body(m: Model, style: str, side: Outline, front: Outline, plan: Outline | None = None, wall: float = 0.05) -> Hull:
    """A hull out of outlines; corners are round where the style has it."""
    radius = {"round": m.number(0.05, 0.12), "flush": m.pick(0.0, 0.04), "cad": m.pick(0.0, 0.03)}.get(style, 0.0)
    wall = m.number(0.02, 0.03) if style == "low" else wall
    views = [softened(side, radius), softened(front, 1.6 * radius), softened(plan, 2 * radius) if plan else None]
    small = [None if v is None else v.buffer(-wall, join_style=2) for v in views]
    return hull_of(m, style, three_view(*views), three_view(*small), wall)


def lip(outline: Polygon, low: float, margin: float) -> Polygon:
    """The window of a door: what of it lies above a height, within a margin."""
    x0, _, x1, z1 = outline.bounds
    return outline.buffer(-margin, join_style=2).intersection(rectangle((x0, x1), (low, z1)))


def side_door(hull: Hull, part: str, outline: Polygon, s: int, half: float, waist: float, rear_hung: bool = False) -> None:
    """A door in a side with a window above the waist, hung at its front edge."""
    m = hull.m
    piece = hull.take(outline, "x", (s * 0.5 * half, s * (half + 0.3)), (s, 0, 0))
    window = lip(outline, waist, 0.06)
    panes = [prism(window, "x", (s * 0.3 * half, s * (half + 0.5)))] if window.area > 0.02 else []
    hull.put(part, piece, *panes)
    y0, _, y1, _ = outline.bounds
    x = s * (half + (0.9 * hull.wall if hull.laid else 0.0))
    m.hinge(part, (x, y1 if rear_hung else y0, waist), (0, 0, s if rear_hung else -s), m.number(55, 75))
    free = (y0 + 0.1, y0 + 0.25) if rear_hung else (y1 - 0.25, y1 - 0.1)
    grip(m, hull.style, part, x, s, free, waist - 0.1)


def grip(m: Model, style: str, part: str, x: float, s: int, span: Span, z: float, way: str | None = None) -> None:
    """A handle on a side at x: none, a block, a bar on posts, or an inlay."""
    way = way or {"low": m.pick("none", "block"), "cad": m.pick("bar", "block"), "sheet": m.pick("none", "block")}.get(
        style, m.pick("none", "block", "bar", "inlay")
    )
    y0, y1 = span
    if way == "block":
        m.add(part, box((x - s * 0.012, x + s * 0.03), span, (z - 0.018, z + 0.018)))
    elif way == "bar":
        m.add(part, rod((x + s * 0.035, y0 - 0.01, z), (x + s * 0.035, y1 + 0.01, z), 0.011, 8))
        m.add(part, *(rod((x - s * 0.015, y, z), (x + s * 0.035, y, z), 0.008, 8) for y in (y0 + 0.01, y1 - 0.01)))
    elif way == "inlay":
        m.add(part, box((x - s * 0.012, x + s * 0.004), (y0 - 0.02, y1), (z - 0.03, z + 0.03)))
