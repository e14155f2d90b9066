"""Fittings that kitchen and bathroom kinds share: bodies, fronts and their handles, hinges, feet, controls, racks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, TOWARD, glazed, hang, middle, sheet
from training.kinds.solids import Point, Span, ball, box, cut, join, prism, rectangle, rod, rounded, tube, vec

FRONTS = ("slab", "slab", "rounded", "pan", "sheet", "framed", "shaker", "raised", "liner", "glass")
PULLS = ("bar", "rail", "merged", "knob", "rim", "cup", "recess", "groove", "none")
UNIT = {"x": vec(1, 0, 0), "y": vec(0, 1, 0), "z": vec(0, 0, 1)}


@dataclass(frozen=True)
class Look:
    """How the fronts of one object are made. sunk: depth of inset fronts, None when they lie before the body [m]."""

    front: str
    pull: str
    thick: float
    sunk: float | None
    clear: float
    length: float

    @property
    def depth(self) -> Span:
        """The span of the fronts along y; the body's face lies at 0."""
        if self.sunk is None:
            return (-self.thick - self.clear, -self.clear)
        return (self.sunk, self.sunk + self.thick)


def look(m: Model, size: float, fronts: Sequence[str] = FRONTS, pulls: Sequence[str] = PULLS) -> Look:
    """Draw a manner for the fronts of an object of a size [m]."""
    sunk = m.pick(None, None, 0.0, 0.004, -0.003)
    return Look(
        m.pick(*fronts),
        m.pick(*pulls),
        m.number(0.012, 0.03),
        sunk,
        float(np.clip(m.gap(size), -0.001, 0.006)),
        m.pick(0.25, 0.5, 0.85),
    )


def without(solid: Trimesh, *normals: Point) -> Trimesh:
    """Open a solid: remove the flat faces of these directions."""
    away = np.zeros(len(solid.faces), bool)
    for n in normals:
        away |= solid.face_normals @ np.asarray(n, float) > 0.99
    return Trimesh(solid.vertices, solid.faces[~away], process=False)


def body(m: Model, x: Span, y: Span, z: Span, rooms: Sequence[tuple[Span, Span]], how: Look, wall: float = 0.018) -> bool:
    """Build the base behind fronts that fill the rooms (x, z); return whether the rooms are hollow."""
    style = m.pick("block", "cut", "cut", "boards", "sheets")
    lap = 0.6 * wall if how.sunk is None else 0.0
    holes = [((a[0] + lap, a[1] - lap), (b[0] + lap, b[1] - lap)) for a, b in rooms]
    back = y[1] - 0.03
    if style == "block":
        pocket = [] if how.sunk is None else [box(a, (y[0] - 1, y[0] + how.depth[1] + 0.002), b) for a, b in holes]
        m.add(BASE, cut(box(x, y, z), *pocket) if pocket else box(x, y, z))
        return False
    if style == "cut":
        m.add(BASE, cut(box(x, y, z), *(box(a, (y[0] - 1, back), b) for a, b in holes)))
        return True
    face = rectangle(x, z)
    for a, b in holes:
        face = face.difference(rectangle(a, b))
    if style == "sheets":
        m.add(BASE, without(box(x, y, z), (0, -1, 0)))
        m.add(BASE, without(prism(face, "y", (y[0], y[0] + 0.01)), (0, 1, 0), (1, 0, 0), (-1, 0, 0), (0, 0, 1), (0, 0, -1)))
        for a, b in holes if m.chance(0.7) else []:
            liner = without(box(a, (y[0], back), b), (0, -1, 0))
            liner.invert()
            m.add(BASE, liner)
        return True
    m.add(BASE, box((x[0], x[0] + wall), y, z), box((x[1] - wall, x[1]), y, z))
    m.add(BASE, *(box((x[0] + wall, x[1] - wall), y, (c, c + wall)) for c in (z[0], z[1] - wall)))
    m.add(BASE, box((x[0] + wall, x[1] - wall), (y[1] - 0.006, y[1]), (z[0] + wall, z[1] - wall)))
    tight = max(abs(a - b) for r in rooms for a, b in zip((*r[0], *r[1]), (*x, *z), strict=True)) < 2 * wall
    if not tight or m.chance(0.4):
        m.add(BASE, prism(face, "y", (y[0], y[0] + wall)))
    return True


def fill(m: Model, part: str, x: Span, y: Span, z: Span, how: Look, edge: str = "top") -> None:
    """Build a front in the object's manner with a handle at its edge (left, right, top, bottom, middle)."""
    wide, tall, thick = x[1] - x[0], z[1] - z[0], y[1] - y[0]
    rim, style = min(0.06, 0.2 * min(wide, tall)), how.front
    inner = (x[0] + rim, x[1] - rim), (z[0] + rim, z[1] - rim)
    if style == "sheet":
        m.add(part, sheet(x, y[0], z))
    elif style == "pan":
        m.add(part, without(box(x, y, z), (0, 1, 0)))
    elif style == "glass":
        glazed(m, part, x, y, z, rim)
    elif style == "rounded":
        m.add(part, prism(rounded(x, z, 0.3 * rim), "y", y))
    elif style == "framed":
        m.add(part, box((x[0], x[0] + rim), y, z), box((x[1] - rim, x[1]), y, z))
        m.add(part, *(box(inner[0], y, (c, c + rim)) for c in (z[0], z[1] - rim)))
        m.add(part, box(inner[0], (y[0] + 0.35 * thick, y[0] + 0.7 * thick), inner[1]))
    elif style == "shaker":
        m.add(part, cut(box(x, y, z), box(inner[0], (y[0] - 1, y[0] + 0.3 * thick), inner[1])))
    elif style == "liner":
        edge_in = 0.4 * rim
        m.add(part, box(x, (y[0], y[0] + 0.7 * thick), z))
        m.add(part, box((x[0] + edge_in, x[1] - edge_in), (y[0] + 0.7 * thick, y[1]), (z[0] + edge_in, z[1] - edge_in)))
    elif how.pull in ("recess", "groove") and style == "slab":
        m.add(part, _grooved(how, x, y, z, edge, rim))
    else:
        m.add(part, box(x, y, z))
    if style == "raised":
        m.add(part, prism(rectangle(*inner, 0.2 * rim), "y", (y[0] - 0.25 * thick, y[0])))
    pull(m, part, how, x, y[0], z, edge)


def blind(m: Model, x: Span, y: Span, z: Span, how: Look) -> None:
    """Build a fixed panel in the manner of the fronts, as a rule without a handle."""
    fill(m, BASE, x, y, z, how if m.chance(0.1) else replace(how, pull="none"), "middle")


def _place(how: Look, x: Span, z: Span, edge: str, rim: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Where a handle sits (x, 0, z), its direction, and half its length."""
    lying = edge in ("top", "bottom", "middle")
    at = vec(middle(x), 0, middle(z))
    if edge in ("left", "right"):
        at[0] = x[0] + 0.6 * rim if edge == "left" else x[1] - 0.6 * rim
    elif edge != "middle":
        at[2] = z[0] + 0.6 * rim if edge == "bottom" else z[1] - 0.6 * rim
    return at, UNIT["x" if lying else "z"], how.length * ((x[1] - x[0]) if lying else (z[1] - z[0])) / 2


def _grooved(how: Look, x: Span, y: Span, z: Span, edge: str, rim: float) -> Trimesh:
    """A slab with a pocket (recess) or a channel along all of its edge (groove)."""
    at, along, half = _place(how, x, z, edge, rim)
    half = 2.0 if how.pull == "groove" else min(half, 0.08)
    side = np.abs(np.cross(along, UNIT["y"])) * 0.3 * rim
    a, b = at - half * along - side, at + half * along + side
    return cut(box(x, y, z), box((a[0], b[0]), (y[0] - 1, y[0] + 0.6 * (y[1] - y[0])), (a[2], b[2])))


def pull(m: Model, part: str, how: Look, x: Span, front: float, z: Span, edge: str) -> None:
    """Add the handle of the object's manner before a front; recesses and grooves have none."""
    rim = min(0.06, 0.2 * min(x[1] - x[0], z[1] - z[0]))
    at, along, half = _place(how, x, z, edge, rim)
    at[1], out, r = front, vec(0, -min(0.04, 0.8 * rim), 0), min(0.007, 0.15 * rim)
    ends = [at - half * along, at + half * along]
    if how.pull == "bar":
        m.add(part, tube([ends[0], ends[0] + out, ends[1] + out, ends[1]], r, m.pick(6, 8)))
    elif how.pull in ("rail", "merged"):
        pad = vec(r, r, r)
        rail = box(*np.c_[ends[0] + out - pad, ends[1] + out + pad])
        posts = [rod(at + c * half * along, at + c * half * along + out, 0.8 * r, 8) for c in (-0.85, 0.85)]
        m.add(part, *([join(rail, *posts)] if how.pull == "merged" else [rail, *posts]))
    elif how.pull == "knob":
        round_ = ball(at + out, (2.2 * r,) * 3, m.sections()) if m.chance(0.5) else rod(at + 0.7 * out, at + out, 2 * r, 12)
        m.add(part, rod(at, at + out, r, 8), round_)
    elif how.pull == "rim":
        side = np.abs(np.cross(along, UNIT["y"]))
        a, b = at - half * along - 0.2 * r * side, at + half * along + 0.2 * r * side
        m.add(part, box((a[0], b[0]), (front - 0.5 * rim, front), (a[2], b[2])))
    elif how.pull == "cup":
        half = min(half, 0.05)
        a, b = at - half * along, at + half * along
        m.add(part, box((a[0], b[0] + 0.3 * rim), (front - 0.4 * rim, front), (a[2], b[2] + 0.3 * rim)))


def swing(m: Model, part: str, x: Span, y: Span, z: Span, side: str, degrees: float, parent: str = BASE) -> None:
    """Hinge a front at one side to open outwards: at its face, in barrels, at its back edge, on pins or with brackets."""
    style = m.pick("hang", "hang", "back", "pivot", "brackets")
    if style == "hang":
        hang(m, part, x, y, z, side, OUT, degrees, parent)
        return
    toward, thick = np.array(TOWARD[side], float), y[1] - y[0]
    half = vec((x[1] - x[0]) / 2, 0, (z[1] - z[0]) / 2)
    at = vec(middle(x), y[1] if style == "back" else middle(y), middle(z)) - toward * half
    along = np.abs(np.cross(toward, UNIT["y"])) * half
    if style == "pivot":
        at = at + 0.6 * thick * toward
        for c in (-1.0, 1.0) if m.chance(0.6) else ():
            a = at + c * along
            m.add(parent, rod(a - 0.01 * along, a + 0.01 * along, 0.3 * thick, m.sections()))
    elif style == "brackets":
        for c in m.pick((-0.7, 0.7), (-0.8, 0.0, 0.8)):
            a = at + c * along - 0.4 * thick * toward + vec(0, -0.4 * thick, 0)
            s = 0.05 * along + 0.4 * thick * (np.abs(toward) + UNIT["y"])
            m.add(parent, box(*np.c_[a - s, a + s]))
    m.hinge(part, at, np.cross(toward, (0, OUT, 0)), degrees, parent)


def door(m: Model, part: str, x: Span, z: Span, side: str, how: Look, degrees: float = 100, parent: str = BASE) -> None:
    """A front hinged at a side of its room, its handle at the other."""
    edge = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}[side]
    c = how.clear
    x, z = (x[0] + c, x[1] - c), (z[0] + c, z[1] - c)
    fill(m, part, x, how.depth, z, how, edge)
    swing(m, part, x, how.depth, z, side, degrees, parent)


def drawer(m: Model, part: str, x: Span, z: Span, back: float, how: Look, inside: str = "box", edge: str = "") -> None:
    """A front that slides out with what hangs on it: a box, a wire basket, or nothing."""
    c = how.clear
    x, z = (x[0] + c, x[1] - c), (z[0] + c, z[1] - c)
    fill(m, part, x, how.depth, z, how, edge or m.pick("top", "middle"))
    if inside != "none":
        high = z[0] + m.pick(0.5, 0.8) * (z[1] - z[0])
        tray(m, part, (x[0] + 0.025, x[1] - 0.025), (how.depth[1], back - 0.04), (z[0] + 0.02, high), inside)
    m.slide(part, (0, -1, 0), m.number(0.6, 0.85) * back)


def tray(m: Model, part: str, x: Span, y: Span, z: Span, style: str) -> None:
    """An open container: of boards (box), of wire, or a cut block (tub)."""
    if style == "wire":
        r = 0.0025
        m.add(part, *(box(x, (b - r, b + r), (z[1] - 2 * r, z[1])) for b in y), *(box((a - r, a + r), y, z) for a in x))
        for b in np.linspace(*y, m.pick(5, 8)):
            m.add(part, tube([(x[0], b, z[1]), (x[0], b, z[0]), (x[1], b, z[0]), (x[1], b, z[1])], r, 4))
    elif style == "tub":
        t = min(0.01, 0.1 * (x[1] - x[0]))
        m.add(part, cut(box(x, y, z), box((x[0] + t, x[1] - t), (y[0] + t, y[1] - t), (z[0] + t, z[1] + 1))))
    else:
        m.add(part, box(x, y, (z[0], z[0] + 0.008)), box(x, (y[1] - 0.01, y[1]), z))
        m.add(part, *(box((a, a + 0.01), y, z) for a in (x[0], x[1] - 0.01)))


def rack(m: Model, part: str, x: Span, y: Span, z: float, bars: int = 0) -> None:
    """A grid of wires or a plate at a height."""
    if m.chance(0.3):
        m.add(part, box(x, y, (z, z + 0.008)))
        return
    r = 0.003
    m.add(part, *(rod((x[0], b, z), (x[1], b, z), r, 6) for b in y))
    m.add(part, *(rod((a, y[0], z), (a, y[1], z), 0.7 * r, 6) for a in np.linspace(*x, bars or m.pick(5, 9))))
