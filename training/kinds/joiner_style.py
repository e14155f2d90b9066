"""How one joiner leaves furniture: six ways of modelling, bevelled and turned solids, sheets without thickness."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import trimesh
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import COLUMNS, Point, Span, box, loft, rod, rounded, turned, vec

WAYS = ("prop", "sheet", "cad", "round", "block", "old")
PULLS = {
    "prop": ("none", "plate", "plate", "bar", "lip"),
    "sheet": ("none", "flat", "bar", "plate"),
    "cad": ("bar", "cup", "strip", "lip", "knob"),
    "round": ("none", "knob", "bow", "strip", "bar"),
    "block": ("none", "notch", "notch", "bar"),
    "old": ("knob", "knob", "bow", "ring", "cup"),
}


@dataclass(frozen=True)
class Look:
    """One object's conventions: its way, thickness of boards and fronts, clearance, design, pulls and what is inside."""

    way: str
    wall: float
    thick: float
    inset: bool
    gap: float
    set_back: float
    design: int
    pull: str
    fused: bool
    inside: bool
    n: int


def draw_look(m: Model, scale: float = 1.0) -> Look:
    """Draws the conventions of one object."""
    way = m.pick(*WAYS)
    inside = m.chance(0.65)
    wall = 0.003 if way == "sheet" else m.number(0.014, 0.03) * scale
    thick = 0.0015 if way == "sheet" else m.number(0.014, 0.024) * scale
    inset = {"prop": inside and m.chance(0.3), "block": True, "old": m.chance(0.6)}.get(way, m.chance(0.35))
    return Look(
        way=way,
        wall=wall,
        thick=thick,
        inset=inset,
        gap=max(m.gap(0.4), -0.0006) if way != "block" else m.number(0.001, 0.004),
        set_back=m.pick(0.0, 0.0, 0.001, 0.003) if not inset else m.pick(0.0, 0.0, 0.002, -0.004),
        design=m.pick(0, 1, 2, 3),
        pull=m.pick(*PULLS[way]),
        fused=m.chance(0.3),
        inside=inside,
        n=m.pick(6, 8, 12) if way == "prop" else m.pick(12, 16, 24),
    )


def named(m: Model, stem: str) -> str:
    """The next free name of a sort of parts."""
    return f"{stem}_{sum(p.rstrip('0123456789') == stem + '_' for p in m.joints)}"


def shrunk(a: Span, by: float) -> Span:
    return (a[0] + by, a[1] - by)


def middle(a: Span) -> float:
    return (a[0] + a[1]) / 2


def parted(a: Span, weights: Sequence[float], between: float) -> list[Span]:
    """A span in pieces of given weights with room between them."""
    free = a[1] - a[0] - between * (len(weights) - 1)
    long = free * np.asarray(weights, float) / np.sum(weights)
    begin = a[0] + np.concatenate([[0], np.cumsum(long + between)[:-1]])
    return [(float(b), float(b + w)) for b, w in zip(begin, long, strict=True)]


def plane(axis: str, at: float, a: Span, b: Span, side: int = 1) -> Trimesh:
    """A rectangle without thickness across an axis, facing up the axis or down it."""
    outline = np.array([(a[0], b[0], at), (a[1], b[0], at), (a[1], b[1], at), (a[0], b[1], at)], float)
    faces = np.array([(0, 1, 2), (0, 2, 3)])
    return Trimesh(outline[:, COLUMNS[axis]], faces if (side > 0) != (axis == "y") else faces[:, ::-1], process=False)


def open_box(x: Span, y: Span, z: Span, without: str) -> Trimesh:
    """A box of planes that face outwards; `without` names the open sides, of '-x +x -y +y -z +z'."""
    spans = {"x": (y, z, x), "y": (x, z, y), "z": (x, y, z)}
    sides = [
        plane(axis, end[k], a, b, 2 * k - 1)
        for axis, (a, b, end) in spans.items()
        for k in (0, 1)
        if "-+"[k] + axis not in without
    ]
    points = np.concatenate([s.vertices for s in sides])
    faces = np.concatenate([s.faces + 4 * k for k, s in enumerate(sides)])
    return Trimesh(points, faces, process=False)


def bevelled(x: Span, y: Span, z: Span, radius: float, axis: str = "y", steps: int = 3) -> Trimesh:
    """A box with all edges rounded (steps > 1) or chamfered, the corners of its outline across `axis` too."""
    a, b, depth = {"x": (y, z, x), "y": (x, z, y), "z": (x, y, z)}[axis]
    r = min(radius, *(0.45 * (s[1] - s[0]) for s in (x, y, z)))
    rings = []
    for end, sign in ((depth[0], 1), (depth[1], -1)):
        turns = np.linspace(0, np.pi / 2, steps + 1)[:: 1 if sign > 0 else -1]
        for t in turns:
            inward = r * (1 - np.sin(t)) * 0.999
            outline = np.array(rounded(shrunk(a, inward), shrunk(b, inward), max(r - inward, 1e-5), steps).exterior.coords)[:-1]
            rings.append(np.c_[outline, np.full(len(outline), end + sign * r * (1 - np.cos(t)))])
    solid = loft(np.array(rings))
    solid = Trimesh(solid.vertices[:, COLUMNS[axis]], solid.faces, process=False)
    if solid.volume < 0:
        solid.invert()
    return solid


def moulding(x: Span, y: Span, profile: Sequence[tuple[float, float]]) -> Trimesh:
    """A slab whose edge follows a profile of (overhang, height) on all four sides."""
    rings = []
    for out, z in profile:
        a, b = shrunk(x, -out), shrunk(y, -out)
        rings.append([(a[0], b[0], z), (a[1], b[0], z), (a[1], b[1], z), (a[0], b[1], z)])
    return loft(np.array(rings))


def turned_post(at: Point, profile: Sequence[tuple[float, float]], n: int, axis: Point = (0, 0, 1)) -> Trimesh:
    """A turned piece from `at` along an axis, of (radius, height) from its axis to its axis."""
    solid = trimesh.creation.revolve(np.array(profile, float), sections=n)
    if solid.volume < 0:
        solid.invert()
    solid.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], np.asarray(axis, float)))
    solid.apply_translation(np.asarray(at, float))
    return solid


def slab(look: Look, x: Span, y: Span, z: Span, axis: str = "z") -> Trimesh:
    """A board in the way of the object: a box, a sheet, a rounded board or one with a moulded edge."""
    if look.way == "sheet":
        return open_box(x, y, z, "-z" if axis == "z" else "+y")
    if look.way == "round":
        return bevelled(x, y, z, 0.012, axis)
    if look.way == "prop" and look.design == 1:
        return bevelled(x, y, z, 0.006, axis, 1)
    if look.way == "old" and axis == "z":
        h = z[1] - z[0]
        edge = [(-0.3 * h, z[0]), (-0.3 * h, z[0] + 0.2 * h), (0.0, z[0] + 0.5 * h), (0.0, z[1] - 0.1 * h), (-0.1 * h, z[1])]
        return moulding(x, y, edge)
    return box(x, y, z)


def place(m: Model, sub: Model, degrees: float, at: Point) -> None:
    """Puts a model that faces -Y into another one, turned about the vertical, its parts numbered on."""
    names = {BASE: BASE}
    up = (0, 0, 1)
    for part, j in sub.joints.items():
        names[part] = named(m, part.rstrip("0123456789_"))
        tip = turned_point(j.origin, degrees) + np.asarray(at, float)
        axis = turned_point(j.axis, degrees)
        parent = names[j.parent]
        if j.type == "prismatic":
            m.slide(names[part], axis, j.limits or 0.0, parent)
        elif j.limits is None:
            m.spin(names[part], tip, axis, parent)
        else:
            m.hinge(names[part], tip, axis, tuple(np.rad2deg(j.limits)), parent)
    for part, solid in sub.pieces:
        piece = turned(solid.copy(), up, degrees, (0, 0, 0))
        piece.apply_translation(np.asarray(at, float))
        m.add(names[part], piece)


def turned_point(point: Point, degrees: float) -> np.ndarray:
    """A point turned about the vertical."""
    c, s = np.cos(np.deg2rad(degrees)), np.sin(np.deg2rad(degrees))
    return np.array([c * point[0] - s * point[1], s * point[0] + c * point[1], point[2]])


def screw(at: Point, axis: Point, radius: float = 0.004) -> Trimesh:
    """A flat screw head that stands out a little."""
    a = np.asarray(at, float)
    d = np.asarray(axis, float)
    return rod(a - 0.003 * d, a + 0.001 * d, radius, 8)


def castor(m: Model, look: Look, at: Point, high: float) -> None:
    """A swivel castor under a point: a plate, a fork that swivels and a wheel."""
    x, y, top = at
    r = 0.36 * high
    fork, wheel = named(m, "castor"), named(m, "wheel")
    m.add(BASE, box((x - 0.02, x + 0.02), (y - 0.02, y + 0.02), (top - 0.004, top + 0.0005)))
    m.add(fork, rod((x, y, top - 0.004), (x, y, top - 0.2 * high), 0.007, look.n))
    m.add(fork, box((x - 0.013, x + 0.013), (y - 0.008, y + r), (top - 0.28 * high + 0.003, top - 0.2 * high + 0.002)))
    cheeks = [box((x + s * 0.0105, x + s * 0.013), (y, y + r), (top - high + 0.8 * r, top - 0.24 * high)) for s in (-1, 1)]
    m.add(fork, *cheeks)
    hub = vec(x, y + 0.55 * r, top - high + r)
    m.add(wheel, rod(hub - vec(0.01, 0, 0), hub + vec(0.01, 0, 0), r, max(look.n, 12)))
    m.add(fork, rod(hub - vec(0.0135, 0, 0), hub + vec(0.0135, 0, 0), 0.12 * r, 8))
    m.spin(fork, (x, y, top), (0, 0, 1))
    m.spin(wheel, hub, (1, 0, 0), fork)
