"""What fills the cells of the joiner's bodies: doors, drawers, flaps, sliding and folding fronts, shelves, things."""

from __future__ import annotations

from dataclasses import replace

from trimesh import Trimesh

from training.kinds.cabinets.joiner_bodies import Cell
from training.kinds.cabinets.joiner_contents import inside, tray
from training.kinds.cabinets.joiner_fronts import front, pull, with_notch
from training.kinds.joiner_style import Look, middle, named, parted, plane, shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, prism, rod, together


def fit(m: Model, look: Look, cells: list[Cell]) -> None:
    """Fills every cell with what it holds."""
    for cell in cells:
        sort, _, more = cell.holds.partition(" ")
        {
            "door": door,
            "pair": pair,
            "drawer": drawer,
            "flap": flap,
            "lift": flap,
            "tilt": tilt,
            "slide": sliding,
            "fold": folding,
            "blank": blank,
            "open": inside,
        }[sort](m, look, replace(cell, holds=sort), more)


def face(look: Look, c: Cell) -> tuple[Span, Span, Span]:
    """Where the front of a cell lies: x, z and depth."""
    g = look.gap
    if look.inset:
        y = (c.y[0] + look.set_back, c.y[0] + look.set_back + look.thick)
        return shrunk(c.x, g), shrunk(c.z, g), y
    side = [max(0.0, e - 0.001 if e < look.wall * 0.9 else 0.9 * e) - g / 2 for e in (c.left, c.right, c.below, c.above)]
    y1 = c.y[0] - look.set_back
    return (c.x[0] - side[0], c.x[1] + side[1]), (c.z[0] - side[2], c.z[1] + side[3]), (y1 - look.thick, y1)


def put(m: Model, look: Look, part: str, pieces: list[Trimesh], handle: list[Trimesh]) -> None:
    """Adds a front and its handle, as one mesh or as several."""
    m.add(part, *([together(pieces + handle)] if look.fused and handle else pieces + handle))


def faced(m: Model, look: Look, part: str, x: Span, z: Span, y: Span, grip: tuple[float, float, str, float], more: str) -> None:
    """A front with its pull at (x, z), which lies along x or z and is so long."""
    at_x, at_z, along, long = grip
    pieces = front(m, look, x, z, y, "glass" in more)
    pieces = with_notch(look, pieces, at_x, at_z, y[0], along)
    if "mirror" in more:
        pieces.append(box(shrunk(x, 0.03), (y[0] - 0.007, y[0] + 0.001), shrunk(z, 0.06)))
    lowered = y[0] + (0.0045 if look.way == "block" and look.design else 0.0)
    put(m, look, part, pieces, pull(look, (at_x, at_z), lowered, along, long))


def door(m: Model, look: Look, c: Cell, more: str) -> None:
    """One door hung on its left or its right."""
    if c.holds == "door":
        inside(m, look, c, more)
    x, z, y = face(look, c)
    left = "left" in more if ("left" in more or "right" in more) else m.chance(0.5)
    part = named(m, "door")
    wide, high = x[1] - x[0], z[1] - z[0]
    off = min(0.045, 0.2 * wide)
    at_x = x[1] - off if left else x[0] + off
    at_z = middle(z) if high > 1.1 or m.rng.random() < 0.3 else (z[1] - 0.25 * high if z[0] < 0.9 else z[0] + 0.25 * high)
    faced(m, look, part, x, z, y, (at_x, at_z, "z", min(0.16, 0.4 * high)), more)
    pivot = x[0] if left else x[1]
    if look.way in ("cad", "old"):
        hinges(m, look, part, pivot, 1 if left else -1, z, y)
    m.hinge(part, (pivot, y[0], middle(z)), (0, 0, -1 if left else 1), m.pick(90, 100, 110) if look.inset else 90)


def hinges(m: Model, look: Look, part: str, pivot: float, side: int, z: Span, y: Span) -> None:
    """Hinges that a person would see: knuckles in front, or cups on the back of the door."""
    high = z[1] - z[0]
    for at in (z[0] + 0.15 * high, z[1] - 0.15 * high):
        if look.way == "old":
            h = min(0.03, 0.06 * high)
            m.add(part, rod((pivot, y[0] - 0.002, at - h), (pivot, y[0] - 0.002, at + h), 0.005, look.n))
        elif look.inside and not look.inset:
            cup = pivot + side * (look.wall + 0.022)
            m.add(part, rod((cup, y[1] - 0.001, at), (cup, y[1] + 0.008, at), 0.014, look.n))
            wall = pivot + side * look.wall
            m.add(BASE, box((wall - side * 0.004, wall + side * 0.006), (y[1] + 0.02, y[1] + 0.06), (at - 0.008, at + 0.008)))


def pair(m: Model, look: Look, c: Cell, more: str) -> None:
    """Two doors that meet in the middle."""
    inside(m, look, c, more)
    half = middle(c.x)
    door(m, look, replace(c, x=(c.x[0], half), right=0.0, holds=""), more + " left")
    door(m, look, replace(c, x=(half, c.x[1]), left=0.0, holds=""), more + " right")


def drawer(m: Model, look: Look, c: Cell, more: str) -> None:
    """A drawer: its front and mostly a box behind it."""
    x, z, y = face(look, c)
    part = named(m, "drawer")
    wide, deep = x[1] - x[0], min(c.y[1] - c.y[0], 0.65)
    at_z = z[1] - 0.02 if look.pull == "lip" else middle(z)
    long = min(0.2, 0.5 * wide) if look.pull != "plate" else min(0.3, 0.6 * wide)
    if look.pull in ("knob", "ring") and wide > 0.55:
        faced(m, look, part, x, z, y, (x[0] + 0.2 * wide, at_z, "x", long), more)
        m.add(part, *pull(look, (x[1] - 0.2 * wide, at_z), y[0], "x", long))
    else:
        faced(m, look, part, x, z, y, (middle(x), at_z, "x", long), more)
    if look.inside:
        clear = 0.012 if look.way == "cad" else m.pick(0.003, 0.006, 0.012)
        back = c.y[0] + 0.92 * deep
        m.add(part, *tray(look, shrunk(c.x, clear), (y[1], back), (c.z[0] + clear, c.z[0] + 0.75 * (c.z[1] - c.z[0]))))
        if look.way == "cad":
            runners(m, part, c, (y[1] + 0.01, back), c.z[0] + 0.3 * (c.z[1] - c.z[0]))
    m.slide(part, (0, -1, 0), m.pick(0.5, 0.65, 0.8) * deep)


def runners(m: Model, part: str, c: Cell, y: Span, z: float) -> None:
    """Rails on both sides of a drawer's cell, and those that run in them."""
    for a, e in ((c.x[0], 1), (c.x[1], -1)):
        m.add(BASE, box((a - 0.001 * e, a + 0.006 * e), (c.y[0] + 0.03, y[1]), (z, z + 0.02)))
        m.add(part, box((a + 0.0065 * e, a + 0.013 * e), y, (z + 0.004, z + 0.016)))


def flap(m: Model, look: Look, c: Cell, more: str) -> None:
    """A flap that falls open below, or lifts from above."""
    inside(m, look, c, more)
    x, z, y = face(look, c)
    part = named(m, "flap")
    up = c.holds == "lift"
    at_z = z[0] + min(0.03, 0.2 * (z[1] - z[0])) if up else z[1] - min(0.03, 0.2 * (z[1] - z[0]))
    faced(m, look, part, x, z, y, (middle(x), at_z, "x", min(0.25, 0.4 * (x[1] - x[0]))), more)
    m.hinge(part, (middle(x), y[0], z[1] if up else z[0]), (-1 if up else 1, 0, 0), m.pick(80, 90))


def tilt(m: Model, look: Look, c: Cell, more: str) -> None:
    """A front with racks for shoes behind it, which tilts out over its lower edge."""
    x, z, y = face(look, c)
    part = named(m, "front")
    high, deep = z[1] - z[0], c.y[1] - c.y[0]
    faced(m, look, part, x, z, y, (middle(x), z[1] - min(0.05, 0.15 * high), "x", min(0.2, 0.4 * (x[1] - x[0]))), more)
    if look.inside:
        reach = min(0.85 * deep, 0.8 * high)
        low, inner = c.z[0] + 0.012, shrunk(c.x, 0.014)
        back = [(y[1], low), (y[1] + 0.5 * reach, low), (c.y[0] + reach, low + 0.35 * high), (y[1], low + 0.7 * high)]
        for s in ((inner[0], inner[0] + 0.006), (inner[1] - 0.006, inner[1])):
            m.add(
                part,
                plane("x", s[0], (y[1], c.y[0] + reach), (low, low + 0.5 * high))
                if look.way == "sheet"
                else prism(back, "x", s),
            )
        racks = m.pick(1, 2)
        for k in range(racks):
            a, b = low + k * 0.35 * high, c.y[0] + (0.45 + 0.4 * k / racks) * reach
            shelf = [(y[1] - 0.001, a), (b, a + 0.12 * high), (b, a + 0.12 * high + 0.006), (y[1] - 0.001, a + 0.006)]
            m.add(part, prism(shelf, "x", shrunk(inner, 0.003)))
    m.hinge(part, (middle(x), y[0], z[0]), (1, 0, 0), m.pick(30, 40, 48))


def blank(m: Model, look: Look, c: Cell, more: str) -> None:
    """A front that looks like a drawer and stays."""
    x, z, y = face(look, c)
    m.add(BASE, *front(m, look, x, z, (y[0], c.y[0] + 0.002 if not look.inset else y[1]), "glass" in more))


def sliding(m: Model, look: Look, c: Cell, more: str) -> None:
    """Panels that slide past each other in two tracks."""
    inside(m, look, c, more)
    count = 3 if "three" in more else 2
    flat = replace(look, pull="none" if look.pull in ("none", "notch", "bar", "ring", "bow") else look.pull)
    lap, t = 0.03, look.thick + 0.004
    y0 = c.y[0] + 0.004 if look.inset else c.y[0] - 2 * t - 0.004
    over = (0.0, 0.0) if look.inset else (0.9 * c.left, 0.9 * c.right)
    whole = (c.x[0] - over[0], c.x[1] + over[1])
    z = shrunk(c.z, 0.006)
    for s in ((c.z[0] - 0.004, z[0] + 0.002), (z[1] - 0.002, c.z[1] + 0.004)):
        m.add(BASE, box(whole, (y0 - 0.006, y0 + 2 * t + 0.006), s) if not look.inset else box(c.x, (y0, y0 + 2 * t), s))
    spans = parted(whole, (1,) * count, 0.0)
    for k, (a, b) in enumerate(spans):
        part = named(m, "sliding_door")
        x = (a - lap * (k > 0), b + lap * (k < count - 1))
        layer = y0 + t * (k % 2)
        grip = x[0] + 0.05 if k == 0 else x[1] - 0.05
        pieces = front(m, replace(flat, design=0), x, z, (layer + 0.001, layer + 0.001 + look.thick), "glass" in more)
        put(m, flat, part, pieces, pull(flat, (grip, middle(z)), layer + 0.001, "z", 0.12) if k % 2 == 0 else [])
        go = (b - a) - lap
        m.slide(part, (1, 0, 0) if k < count - 1 else (-1, 0, 0), go if k in (0, count - 1) else (-go, go))


def folding(m: Model, look: Look, c: Cell, more: str) -> None:
    """Two narrow doors that fold, the second hung on the first."""
    inside(m, look, c, more)
    x, z, y = face(look, c)
    half = middle(x)
    first, second = named(m, "door"), named(m, "folding_door")
    bare = replace(look, pull="none")
    faced(m, bare, first, (x[0], half - 0.001), z, y, (half, middle(z), "z", 0.1), more)
    faced(m, look, second, (half + 0.001, x[1]), z, y, (x[1] - 0.04, middle(z), "z", 0.14), more)
    m.hinge(first, (x[0], y[0], middle(z)), (0, 0, -1), 85)
    m.hinge(second, (half, y[1], middle(z)), (0, 0, 1), 170, first)
