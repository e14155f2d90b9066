"""Cut vehicle bodies: shells with wheel wells, doors, panes, flaps, wheels and seats."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from shapely.geometry import MultiPolygon, Polygon
from trimesh import Trimesh

from training.kinds.game_style import Look, bow_handle, carve, circle, shaped, skin, wheel
from training.kinds.model import BASE
from training.kinds.solids import Span, box, cut, prism, rectangle, ring, rod


@dataclass
class Coach:
    """A body that doors and flaps are cut from; whole: before anything was taken."""

    a: Look
    profile: Polygon
    half: float
    lean: float
    bow: float
    belt: float
    wall: float
    whole: Trimesh
    body: Trimesh
    gap: float
    glass: bool

    def hollow(self, region: Polygon, half: float) -> None:
        """Takes out the inside within a region of the side view."""
        inside = biggest(self.profile.buffer(-self.wall, join_style=2).intersection(region))
        top = self.profile.bounds[3]
        solid = shaped(prism(inside, "x", (-half, half)), self.belt, top, self.lean, self.bow)
        self.body = cut(self.body, solid)

    def wells(self, spots: Sequence[tuple[float, float]], radius: float, deep: float) -> None:
        """Takes out the room for wheels at (y, z) on both sides."""
        for y, z in spots:
            for s in (-1, 1):
                tool = prism(circle(radius, 20, at=(y, z)), "x", (s * (self.half - deep), s * (self.half + 1)))
                self.body = cut(self.body, tool)

    def take(self, part: str, outline: Polygon, axis: str, depth: Span, window: Polygon | None = None) -> Trimesh:
        """Makes a part of what an outline cuts out, perhaps with a pane in it; part BASE: only the pane."""
        piece, self.body = carve(self.body, outline, axis, depth, self.gap)
        if window is not None and not window.is_empty:
            pane, piece = carve(piece, window, axis, depth, 0.002)
            if self.glass:
                self.put(part, pane)
        self.put(part, piece)
        return piece

    def pane(self, outline: Polygon, axis: str, depth: Span) -> None:
        """A window in the body itself."""
        piece, self.body = carve(self.body, outline, axis, depth, 0.003)
        if self.glass and len(piece.faces):
            self.put(BASE, piece)

    def put(self, part: str, piece: Trimesh) -> None:
        self.a.put(part, skin(piece, self.whole) if self.a.way == "sheet" else piece)

    def outline(self, y: Span, floor: float, keep_off: Sequence[tuple[float, float, float]] = ()) -> Polygon:
        """The part of the side wall between two stations, less circles (y, z, radius)."""
        found = self.profile.buffer(-self.wall - 0.01, join_style=2).intersection(rectangle(y, (floor, 9.0)))
        for at, z, radius in keep_off:
            found = found.difference(circle(radius, 20, at=(at, z)))
        return biggest(found)

    def side_door(self, part: str, outline: Polygon, side: int, degrees: float, glazed: bool, rear_hung: bool = False) -> None:
        """A door in the side wall, hung at its front or rear edge, with a handle at the other."""
        window = None
        if glazed:
            above = outline.intersection(rectangle((-99.0, 99.0), (self.belt + 0.04, 99.0))).buffer(-0.05, join_style=2)
            window = biggest(above) if above.area > 0.01 else None
        depth = (side * self.half * 0.72, side * (self.half + 1))
        piece = self.take(part, outline, "x", depth, window)
        low, high = piece.bounds
        edge, other = (high[1], low[1]) if rear_hung else (low[1], high[1])
        x = side * max(abs(low[0]), abs(high[0]))
        self.a.m.hinge(part, (x, edge, self.belt - 0.2), (0, 0, side if rear_hung else -side), degrees)
        toward, z = (1 if rear_hung else -1), self.belt - 0.09
        at = other + toward * 0.07
        if self.a.way != "sunk":
            grip = min(0.12, 0.3 * (high[1] - low[1]))
            solids = bow_handle(
                self.a, (x - side * 0.012, at, z), (x - side * 0.012, at + toward * grip, z), (side, 0, 0), 0.011
            )
            self.a.put(part, *solids)

    def finish(self) -> None:
        self.put(BASE, self.body)


def coach(a: Look, profile: Polygon, half: float, lean: float, bow: float, belt: float, wall: float) -> Coach:
    """The body whose side view is a profile."""
    if a.way == "round":
        profile = biggest(profile.buffer(-0.06).buffer(0.12, quad_segs=3).buffer(-0.06, quad_segs=3))
    whole = shaped(prism(profile, "x", (-half, half)), belt, profile.bounds[3], lean, bow)
    gap = {"low": 0.002, "sheet": 0.002, "sunk": a.m.number(0.004, 0.009)}.get(a.way, a.m.number(0.001, 0.007))
    glass = a.m.chance(0.7)
    return Coach(a, profile, half, lean, bow, belt, wall, whole, whole, gap, glass)


def biggest(found: Polygon | MultiPolygon) -> Polygon:
    """The largest of several pieces, without holes."""
    parts = list(found.geoms) if hasattr(found, "geoms") else [found]
    areas = [p for p in parts if isinstance(p, Polygon) and not p.is_empty]
    return Polygon(max(areas, key=lambda p: p.area).exterior.coords) if areas else Polygon()


def axle(a: Look, name: str, y: float, radius: float, width: float, track: float, bar: bool = True) -> None:
    """A wheel on either side that spins, and the axle between them."""
    for s, side in ((1, "left"), (-1, "right")):
        at = (s * track, y, radius)
        a.put(f"{name}_{side}", *wheel(a, at, radius, width, s))
        a.m.spin(f"{name}_{side}", at, (s, 0, 0))
    if bar:
        x = track - 0.3 * width
        a.put(BASE, rod((-x, y, radius), (x, y, radius), 0.1 * radius, 8))


def steering_wheel(a: Look, part: str, at: tuple[float, float, float], radius: float, parent: str = BASE) -> None:
    """A rim with spokes on a column that leads down to the front."""
    x, y, z = at
    tilt = a.m.number(0.35, 0.8)
    e = (0.0, 1.0 / (1 + tilt * tilt) ** 0.5, tilt / (1 + tilt * tilt) ** 0.5)
    a.put(part, ring(at, e, radius, 0.09 * radius, max(10, a.n)))
    up = (0.0, -e[2], e[1])
    for u, v in a.m.pick(((1, 0), (-1, 0), (0, -1)), ((1, 0), (-1, 0)), ((0.8, -0.6), (-0.8, -0.6), (0, 1))):
        end = (x + u * radius, y + v * up[1] * radius, z + v * up[2] * radius)
        a.put(part, rod(at, end, 0.08 * radius, 6))
    a.put(part, rod((x, y - 0.02 * e[1], z - 0.02 * e[2]), (x, y + 0.03 * e[1], z + 0.03 * e[2]), 0.25 * radius, a.n))
    far = (x, y - 0.3 * e[1], z - 0.3 * e[2])
    a.put(parent, rod((x, y - 0.015 * e[1], z - 0.015 * e[2]), far, 0.1 * radius, 8))
    a.m.spin(part, at, e, parent)


def seat(a: Look, x: float, y: float, z: float, wide: float = 0.46, part: str = BASE) -> None:
    """A cushion and a back, its front at y."""
    span = (x - wide / 2, x + wide / 2)
    a.put(part, a.block(span, (y, y + 0.48), (z, z + 0.2)), a.block(span, (y + 0.4, y + 0.54), (z + 0.15, z + 0.62)))
    if a.m.chance(0.5):
        a.put(part, box((x - 0.1, x + 0.1), (y + 0.44, y + 0.51), (z + 0.6, z + 0.78)))
