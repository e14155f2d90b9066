"""Carousels of playgrounds."""

from __future__ import annotations

import numpy as np
import trimesh
from shapely.geometry import Point

from training.kinds.mason_style import slab, style_of, without_side
from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, cut, prism, rectangle, ring, rod, tube, turned


def _seats(style: str, r: float, z: float, count: int) -> list:
    """Benches about the middle with backs."""
    made = [slab(style, (0.55 * r, 0.85 * r), (-0.18 * r, 0.18 * r), (z + 0.25, z + 0.29))]
    made += [slab("prop" if style == "sheet" else style, (0.65 * r, 0.75 * r), (-0.1 * r, 0.1 * r), (z - 0.002, z + 0.252))]
    made += [slab(style, (0.83 * r, 0.86 * r), (-0.2 * r, 0.2 * r), (z + 0.24, z + 0.55))]
    return [s for solid in made for s in around(solid, count)]


def _hoops(m: Model, r: float, z: float, count: int) -> list:
    """Bent rails on a disc, along its rim or toward its middle."""
    h, n, bar = m.number(0.5, 0.75), m.pick(6, 8, 12), m.number(0.015, 0.022)
    if m.chance(0.5):
        path = [(0.9 * r, 0, z - 0.01), (0.9 * r, 0, z + h), (0.12 * r, 0, z + h), (0.05 * r, 0, z + 0.85 * h)]
        return [*around(tube(path, bar, n), count), rod((0, 0, z - 0.01), (0, 0, z + h + 0.05), 0.05, n)]
    t = np.pi / count * 0.6
    ends = [(0.9 * r * np.cos(v), 0.9 * r * np.sin(v)) for v in (-t, t)]
    path = [(*ends[0], z - 0.01), (*ends[0], z + h), (0.9 * r, 0, z + h), (*ends[1], z + h), (*ends[1], z - 0.01)]
    return around(tube(path, bar, n), count)


def _net(m: Model, r: float, z: float) -> list:
    """A mast with ropes down to the rim and rings of rope between them."""
    high, count = m.number(1.2, 2.2), m.pick(6, 8, 10)
    made = [rod((0, 0, z - 0.01), (0, 0, z + high), 0.045, 12)]
    made += around(rod((0.03, 0, z + 0.95 * high), (r, 0, z + 0.005), 0.012, 6), count)
    for share in m.pick((0.3, 0.6), (0.2, 0.45, 0.7)):
        at, up, half = r - share * (r - 0.03), z + share * 0.95 * high, np.pi / count
        ends = [(at * np.cos(v), at * np.sin(v), up) for v in (-half, half)]
        made += around(rod(*ends, 0.01, 6), count, 180 / count)
    return made


def _canopy(m: Model, style: str, r: float, z: float, n: int) -> list:
    """A pole that goes on to a pointed roof."""
    up, high = z + m.number(0.9, 1.4), m.number(0.25, 0.6)
    roof = trimesh.creation.cone(radius=r, height=high, sections=n)
    roof.apply_translation((0, 0, up))
    roof = without_side(roof, (0, 0, -1)) if style == "sheet" else roof
    rim = [ring((0, 0, up), (0, 0, 1), r - 0.01, 0.025, n)] if m.chance(0.5) else []
    return [rod((0, 0, z - 0.01), (0, 0, up + 0.6 * high), 0.035, n), roof, *rim, ball((0, 0, up + high), (0.05,) * 3, 10)]


def _spinner(m: Model, z: float, t: float, n: int, count: int) -> None:
    """A small disc with a post to hang on."""
    r, top = m.number(0.25, 0.4), m.number(1.4, 2.0)
    m.add("spinner", rod((0, 0, z), (0, 0, z + t), r, n), rod((0, 0, z), (0, 0, top), 0.03, n))
    m.add("spinner", *([ring((0, 0, top - 0.3), (0, 0, 1), 0.2, 0.016, n)] if m.chance(0.6) else []))
    m.add("spinner", *around(rod((0, 0, top - 0.3), (0.21, 0, top - 0.3), 0.014, 8), count))
    m.add("spinner", ball((0, 0, top), (0.05,) * 3, 10))
    m.spin("spinner", (0, 0, 0), (0, 0, 1))


def _dish(m: Model, r: float, z: float, n: int) -> None:
    """A bowl with a rim that spins about a leaning line."""
    lean, deep = m.pick(6, 10, 15), m.number(0.25, 0.5)
    hollow = ball((0, 0, 0.02), (0.94 * r, 0.94 * r, 0.9 * deep), n)
    bowl = cut(ball((0, 0, 0), (r, r, deep), n), box((-9, 9), (-9, 9), (0, 9)), hollow)
    foot = z + deep + r * np.sin(np.deg2rad(lean)) * 0.4
    m.add(BASE, rod((0, 0, -0.02), (0, 0, foot - deep + 0.02), 0.07, n))
    for solid in (bowl, ring((0, 0, 0), (0, 0, 1), 0.98 * r, 0.03, n)):
        m.add("dish", turned(solid, (1, 0, 0), lean, (0, 0, -deep)))
        solid.apply_translation((0, 0, foot))
    m.spin("dish", (0, 0, foot - deep), (0, -np.sin(np.deg2rad(lean)), np.cos(np.deg2rad(lean))))


def _benches(m: Model, style: str, r: float, z: float, n: int, hub: bool) -> None:
    """Benches on a disc about a wheel on a pole, which stands when there is a hub, perhaps below a roof."""
    m.add("platform", *_seats(style, r, z, m.pick(3, 4, 6)))
    pole, part = z + m.number(0.45, 0.6), BASE if hub else "platform"
    m.add(part, rod((0, 0, 0 if hub else z - 0.01), (0, 0, pole), 0.04, n), ring((0, 0, pole), (0, 0, 1), 0.3 * r, 0.018, n))
    m.add(part, *around(rod((0, 0, pole), (0.3 * r, 0, pole), 0.012, 8), 4))
    if m.chance(0.4):
        m.add(part, *_canopy(m, style, m.number(0.8, 1.15) * r, pole, n))


def playground_carousel(m: Model) -> None:
    """A disc that spins, with hoops, benches about a wheel that stands, a net, a leaning dish, or a post to hang on."""
    style, n = style_of(m), m.pick(10, 16, 24, 32)
    design = m.pick("hoops", "hoops", "benches", "benches", "net", "dish", "post")
    r, z, t = m.number(0.7, 1.5), m.number(0.12, 0.4), m.number(0.02, 0.06)
    count, side = m.pick(3, 4, 5, 6), (-1.5 * r, 1.5 * r)
    if m.chance(0.5):
        m.add(BASE, prism(m.pick(Point(0, 0).buffer(1.4 * r, quad_segs=6), rectangle(side, side)), "z", (-0.06, 0)))
    m.add(BASE, rod((0, 0, -0.02), (0, 0, z - 0.002), m.number(0.12, 0.55) * (r if design != "post" else 0.5), n))
    if design == "post":
        _spinner(m, z, t, n, count)
        return
    if design == "dish":
        _dish(m, r, z, n)
        return
    disc, hub = rod((0, 0, z), (0, 0, z + t), r, n), design == "benches" and m.chance(0.6)
    m.add("platform", cut(disc, rod((0, 0, -1), (0, 0, 3), 0.06, n)) if hub else disc)
    if style in ("round", "assembly", "old"):
        m.add("platform", ring((0, 0, z + t / 2), (0, 0, 1), r, 0.55 * t, n))
    if style in ("assembly", "old"):
        m.add("platform", *around(box((0.6 * r, 0.95 * r), (-0.02, 0.02), (z - 0.03, z + 0.001)), 6))
    if design == "net":
        m.add("platform", *_net(m, 0.95 * r, z + t))
    elif design == "hoops":
        m.add("platform", *_hoops(m, r, z + t, count))
    else:
        _benches(m, style, r, z + t, n, hub)
    m.spin("platform", (0, 0, 0), (0, 0, 1))
