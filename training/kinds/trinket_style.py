"""How the small things of one artist are drawn: conventions, turned shells, trays, slabs, knobs and loops."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from jaxtyping import Float
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.model import Model
from training.kinds.solids import Point, Span, ball, box, cut, loft, moved, prism, ring, rod, rounded, tube, vec

STYLES = ("blocky", "sheet", "assembly", "soft", "hollowed", "old")
Profile = Sequence[Sequence[float]]
Line = Float[np.ndarray, "n 2"]


@dataclass(frozen=True)
class Look:
    """The convention in which one object is drawn, and how finely its round things are."""

    m: Model
    style: str
    n: int

    @property
    def plain(self) -> bool:
        return self.style in ("blocky", "sheet")


def draw_look(m: Model) -> Look:
    """One convention for the whole object."""
    style = m.pick(*STYLES)
    return Look(m, style, m.pick(6, 8, 10, 12) if style == "blocky" else m.pick(16, 20, 28, 36))


def outline(n: int, power: float = 2.0, deep: float = 1.0, lobes: int = 0) -> Line:
    """A closed line of about unit radius: round, squarish for a high power, flattened along y, or with lobes."""
    t = (np.arange(n) + 0.5) * 2 * np.pi / n
    c, s = np.cos(t), np.sin(t)
    line = np.c_[np.sign(c) * np.abs(c) ** (2 / power), deep * np.sign(s) * np.abs(s) ** (2 / power)]
    return line * (1 + 0.06 * np.cos(lobes * t))[:, None] if lobes else line


def smooth(profile: Profile, rounds: int = 2) -> Line:
    """A profile with its corners cut, its ends kept."""
    points = np.array(profile, float)
    for _ in range(rounds):
        a, b = points[:-1], points[1:]
        middle = np.stack([0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b], 1).reshape(-1, 2)
        points = np.concatenate([points[:1], middle, points[-1:]])
    return points


def spun(profile: Profile, line: Line, at: Point = (0, 0, 0)) -> Trimesh:
    """A skin whose sections are a line scaled by the radii of a profile of (radius, z)."""
    points = np.array(profile, float)
    rings = np.concatenate([points[:, :1, None] * line[None], np.repeat(points[:, 1, None], len(line), 1)[..., None]], axis=2)
    return moved(loft(rings, caps=False), at)


def shell(look: Look, profile: Profile, thick: float, line: Line, down: bool = False) -> Trimesh:
    """A vessel from the axis below to its rim, or (down) a lid from its rim to the axis above."""
    points = smooth(profile) if look.style in ("soft", "old") else np.array(profile, float)
    if look.style == "sheet":
        return spun(points, line)
    if look.style == "blocky":
        middle = [[0.0, points[0 if down else -1, 1]]]
        return spun(np.concatenate([middle, points] if down else [points, middle]), line)
    inner = np.c_[np.maximum(points[:, 0] - thick, 0), points[:, 1] + (-thick if down else thick)]
    end = 0 if down else -1
    inner[end, 1] = points[end, 1]
    if not down:
        inner[:, 1] = np.minimum(inner[:, 1], points[-1, 1])
        return spun(np.concatenate([points, inner[::-1]]), line)
    inner[:, 1] = np.maximum(inner[:, 1], points[0, 1])
    return spun(np.concatenate([inner[::-1], points, inner[-1:]]), line)


def without(solid: Trimesh, direction: Point) -> Trimesh:
    """A sheet: a solid without the faces that look in a direction."""
    keep = solid.face_normals @ np.asarray(direction, float) < 0.5
    return Trimesh(solid.vertices, solid.faces[keep], process=False)


def sheet(shape: Polygon, z: float) -> Trimesh:
    """An outline as a surface without thickness."""
    solid = prism(shape, "z", (z - 1, z))
    return Trimesh(solid.vertices, solid.faces[solid.face_normals[:, 2] > 0.5])


def pebble(x: Span, y: Span, z: Span, power: float = 5.0, n: int = 28) -> Trimesh:
    """A superelliptic body that fills a box."""
    center = np.array([sum(x), sum(y), sum(z)]) / 2
    half = np.abs(np.array([x[1] - x[0], y[1] - y[0], z[1] - z[0]])) / 2
    t = np.linspace(-np.pi / 2, np.pi / 2, 11)
    profile = np.c_[np.abs(np.cos(t)) ** (2 / power), np.sign(t) * np.abs(np.sin(t)) ** (2 / power)]
    profile[[0, -1], 0] = 0
    solid = spun(profile, outline(n, power))
    solid.apply_scale(half / np.abs(solid.bounds[1]))
    return moved(solid, center)


def slab(look: Look, x: Span, y: Span, z: Span, radius: float = 0.0) -> list[Trimesh]:
    """A flat body: a box, a box without its back, a rounded plate, a stack with a rim, or a pebble."""
    radius = min(radius, 0.45 * min(abs(x[1] - x[0]), abs(y[1] - y[0])))
    if look.style == "sheet" and radius == 0:
        return [without(box(x, y, z), (0, 0, -1))]
    if look.style == "blocky" or radius == 0:
        return [box(x, y, z)]
    if look.style == "soft":
        return [bevelled(rounded(x, y, radius), z, 0.25)]
    if look.style == "old":
        low = z[0] + 0.4 * (z[1] - z[0])
        inset = 0.35 * radius
        top = rounded((x[0] + inset, x[1] - inset), (y[0] + inset, y[1] - inset), 0.6 * radius)
        return [prism(rounded(x, y, radius), "z", (z[0], low)), prism(top, "z", (low, z[1]))]
    return [prism(rounded(x, y, radius, 2 if look.plain else 5), "z", z)]


def bevelled(shape: Polygon, z: Span, share: float = 0.3) -> Trimesh:
    """A plate of an outline with edges bevelled above and below."""
    edge = share * (z[1] - z[0])
    points = np.array(shape.exterior.coords)[:-1]
    center, half = points.mean(0), np.ptp(points, axis=0) / 2
    rings = []
    for inset, at in ((edge, z[0]), (0.3 * edge, z[0] + 0.3 * edge), (0, z[0] + edge), (0, z[1] - edge)):
        rings.append(np.c_[center + (points - center) * (1 - inset / half), np.full(len(points), at)])
    for inset, at in ((0.3 * edge, z[1] - 0.3 * edge), (edge, z[1])):
        rings.append(np.c_[center + (points - center) * (1 - inset / half), np.full(len(points), at)])
    return loft(np.array(rings))


def tray(look: Look, x: Span, y: Span, z: Span, wall: float, radius: float = 0.0, down: bool = False) -> list[Trimesh]:
    """An open box: sheets, a block, boards, or one solid with a cavity; it opens below if down."""
    if look.style == "sheet":
        return [without(box(x, y, z), (0, 0, -1 if down else 1))]
    if look.style == "blocky" and look.m.chance(0.5):
        return [box(x, y, z)]
    floor = (z[1] - wall, z[1]) if down else (z[0], z[0] + wall)
    rest = (z[0], z[1] - wall) if down else (z[0] + wall, z[1])
    inside_x, inside_y = (x[0] + wall, x[1] - wall), (y[0] + wall, y[1] - wall)
    if look.style in ("assembly", "old") and radius < 2 * wall:
        sides = [box((a, a + wall), y, rest) for a in (x[0], x[1] - wall)]
        return [box(x, y, floor), *sides, *(box(inside_x, (b, b + wall), rest) for b in (y[0], y[1] - wall))]
    space = (z[0] - wall, z[1] - wall) if down else (z[0] + wall, z[1] + wall)
    if radius == 0:
        return [cut(box(x, y, z), box(inside_x, inside_y, space))]
    inner = rounded(inside_x, inside_y, max(radius - wall, 0.2 * radius))
    return [cut(prism(rounded(x, y, radius), "z", z), prism(inner, "z", space))]


def knob(look: Look, at: Point, r: float, high: float) -> list[Trimesh]:
    """What a lid is lifted by, standing on a point."""
    n, foot = look.n, np.asarray(at, float)
    kind = look.m.pick("ball", "disc", "turned", "loop", "stem")
    low = foot - vec(0, 0, 0.25 * high)
    if look.style == "blocky" and kind in ("turned", "loop"):
        return [box((foot[0] - r, foot[0] + r), (foot[1] - r, foot[1] + r), (low[2], foot[2] + high))]
    if kind == "ball":
        return [
            ball(foot + vec(0, 0, 0.6 * high), (r, r, 0.6 * high), max(8, n // 2)),
            rod(low, foot + vec(0, 0, 0.3 * high), 0.4 * r, n),
        ]
    if kind == "loop":
        half = np.linspace(0, np.pi, 9)
        path = [foot + vec(1.6 * r * np.cos(t), 0, high * (1.2 * np.sin(t) - 0.2)) for t in half]
        return [tube(path, 0.3 * r, 8)]
    if kind == "turned":
        shape = [(0, -0.25), (0.6, -0.25), (0.6, 0.05), (0.35, 0.25), (0.5, 0.45), (1, 0.7), (0.8, 0.95), (0, 1)]
        return [spun(np.array(shape) * (r, high), outline(n), foot)]
    if kind == "disc":
        return [
            rod(low, foot + vec(0, 0, 0.6 * high), 0.4 * r, n),
            rod(foot + vec(0, 0, 0.6 * high), foot + vec(0, 0, high), r, n),
        ]
    return [rod(low, foot + vec(0, 0, high), 0.7 * r, n)]


def ribs(count: int, radius: float, z: Span, thick: float) -> list[Trimesh]:
    """Small ridges round a cap that is turned by hand."""
    found = []
    for t in 2 * np.pi * np.arange(count) / count:
        c, s = radius * np.cos(t), radius * np.sin(t)
        found.append(rod((c, s, z[0]), (c, s, z[1]), thick, 5))
    return found


def ear(look: Look, side: int, at: Point, out: float, high: float, thick: float) -> Trimesh:
    """A handle at the side of a vessel, fixed at two heights: a round bar or a flat one with corners."""
    x, y, z = at
    if look.plain or look.m.chance(0.3):
        path = [(0, high / 2), (out, high / 2), (out, -high / 2), (0, -high / 2)]
    else:
        path = [(out * np.sin(t), high / 2 * np.cos(t)) for t in np.linspace(0, np.pi, 9)]
    return tube([vec(x + side * a, y, z + b) for a, b in path], thick, 6 if look.plain else 10)


def band(look: Look, radius: float, z: float, thick: float, line: Line) -> list[Trimesh]:
    """A bead or a flat strip round a vessel."""
    if look.plain or look.m.chance(0.4):
        h = 2 * thick
        return [
            spun(
                [
                    (0.97 * radius, z - h),
                    (radius + thick, z - h),
                    (radius + thick, z + h),
                    (0.97 * radius, z + h),
                    (0.97 * radius, z - h),
                ],
                line,
            )
        ]
    if np.ptp(line[:, 0]) - np.ptp(line[:, 1]) > 0.01 or abs(np.linalg.norm(line, axis=1) - 1).max() > 0.01:
        t = np.linspace(0, 2 * np.pi, 9)
        return [spun(np.c_[radius + thick * np.cos(t), z + thick * np.sin(t)], line)]
    return [ring((0, 0, z), (0, 0, 1), radius, thick, look.n)]


def screw(at: Point, axis: Point, r: float) -> Trimesh:
    """The head of a screw or a pin on a face."""
    foot, along = np.asarray(at, float), np.asarray(axis, float)
    return rod(foot - 0.3 * r * along, foot + 0.5 * r * along, r, 10)


def oriented(solid: Trimesh, axis: Point, center: Point) -> Trimesh:
    """A solid made round the z axis, moved so that z points along an axis from a point."""
    solid.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], np.asarray(axis, float)))
    return moved(solid, center)


def turned_plate(solid: Trimesh, degrees: float) -> Trimesh:
    """A solid turned about the vertical through the origin."""
    solid.apply_transform(trimesh.transformations.rotation_matrix(np.deg2rad(degrees), [0, 0, 1]))
    return solid
