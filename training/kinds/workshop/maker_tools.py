"""Tools of two halves by another hand: gripping pliers, paper shears."""

from __future__ import annotations

import numpy as np
from shapely.affinity import rotate, scale
from shapely.geometry import LineString, Polygon
from shapely.geometry import Point as Spot
from trimesh import Trimesh

from training.kinds.maker_style import Maker, lathe, maker, plate
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, cut, moved, prism, ring, rod, tube, turned, vec

Half = tuple[int, str]
HALVES: tuple[Half, Half] = ((1, BASE), (-1, "other_half"))  # the side on which its jaw or blade lies, its part


def _place(k: Maker, half: Half, solids: list[Trimesh], rest: float, pivot: Span = (0.0, 0.0)) -> None:
    """Adds the pieces of a half, the moving one opened by `rest` [deg]."""
    for solid in solids:
        k.m.add(half[1], turned(solid, (0, 0, -1), rest, (*pivot, 0)) if half[0] < 0 else solid)


def gripping_pliers(m: Model) -> None:
    """Two halves that cross on a rivet: blunt, long-nosed, cutting or curved jaws; bare, round or sheathed handles."""
    k = maker(m)
    size, jaws = m.number(0.8, 1.3), m.pick("blunt", "long", "cutter", "curved")
    t, r, rest = m.number(0.008, 0.013) * size, m.number(0.011, 0.016) * size, m.pick(0.0, 0.0, 6.0, 14.0)
    long = {"blunt": 0.038, "long": 0.07, "cutter": 0.02, "curved": 0.045}[jaws] * size * m.number(0.85, 1.2)
    grip, spread = m.number(0.09, 0.15) * size, m.number(0.018, 0.03) * size
    fine = {"low": 2, "sheet": 3}.get(k.way, 6)
    path = np.array(
        [(0.5 * r, 0.5 * r), (0.75 * spread, 0.3 * grip), (spread, 0.6 * grip), (m.number(0.7, 1.15) * spread, grip)]
    )
    sheathed, thick = m.chance(0.7), m.number(0.0045, 0.0065) * size
    for half in HALVES:
        s = half[0]
        jaw = _jaw(jaws, s, r, long)
        disc = Spot(0, 0).buffer(r, quad_segs=fine)
        arm = LineString(path * (-s, 1)).buffer(thick, quad_segs=fine)
        layer = (0.0, 0.49 * t) if s > 0 else (0.51 * t, t)
        solids = [plate(disc.union(jaw).union(arm), "z", layer, k)]
        whole = jaw.difference(Spot(0, 0).buffer(1.05 * r)).buffer(0)
        rest_layer = (0.49 * t, t) if s > 0 else (0.0, 0.51 * t)
        if k.way != "low" and whole.geom_type == "Polygon" and not whole.is_empty:
            solids.append(prism(whole, "z", rest_layer))
        solids += _handle(k, path * (-s, 1), thick, t, sheathed)
        if k.way in ("cad", "soft", "cut") and jaws in ("blunt", "long"):
            step = long / 9
            teeth = [(s * 0.0004, -long + step * (i + 1.2)) for i in range(5)]
            solids += [rod((x, y, 0.1 * t), (x, y, 0.9 * t), 0.0012, 5) for x, y in teeth]
        _place(k, half, solids, rest)
    over = 0.0012 * size
    rivet = [rod((0, 0, -over), (0, 0, t + over), 0.5 * r, k.n)]
    if k.way in ("cad", "old"):
        rivet += [ring((0, 0, z), (0, 0, 1), 0.6 * r, 0.1 * r, 16) for z in (0, t)]
    m.add(m.pick(BASE, "other_half"), *rivet)
    m.hinge("other_half", (0, 0, 0), (0, 0, -1), (-rest, m.pick(30, 45, 55) - rest))


def _jaw(jaws: str, s: int, r: float, long: float) -> Polygon:
    """The outline of a jaw on the side s, ahead of the rivet."""
    shapes = {
        "blunt": [(0, 0), (0, -long), (0.45, -long), (0.8, -0.55 * long), (1.0, 0)],
        "long": [(0, 0), (0, -long), (0.18, -long), (0.6, -0.35 * long), (0.95, 0)],
        "cutter": [(0, 0), (0, -long), (0.5, -0.95 * long), (1.15, -0.4 * long), (1.0, 0)],
        "curved": [
            (0, 0),
            (0, -0.3 * long),
            (0.35, -0.55 * long),
            (0, -0.85 * long),
            (0, -long),
            (0.7, -0.9 * long),
            (1.1, -0.4 * long),
        ],
    }
    outline = Polygon([(s * x * r, y) for x, y in [*shapes[jaws], (0.9, 0.1 * r)]])
    return outline.buffer(0)


def _handle(k: Maker, path: np.ndarray, thick: float, t: float, sheathed: bool) -> list[Trimesh]:
    """What is on an arm: nothing but its thickness, a sheath, a round grip, a ball at the end."""
    fine = 2 if k.way == "low" else 4
    outer = path[1:] + (path[1] - path[2]) * (0.0, 0.3)
    if k.way == "sheet":
        return []
    if k.way == "soft" and sheathed:
        spots = [vec(x, y, t / 2) for x, y in outer]
        return [tube(spots, 1.35 * thick, k.n), *(ball(p, (1.35 * thick,) * 3, k.n) for p in spots[::2])]
    if sheathed:
        shape = LineString(outer).buffer(1.45 * thick, quad_segs=fine)
        solids = [prism(shape, "z", (-0.15 * t, 1.15 * t))]
        if k.way == "cut":
            solids = [cut(solids[0], *(rod((*p, 1.05 * t), (*p, 2 * t), 0.6 * thick, 8) for p in outer[1:2]))]
        return solids
    solids = [prism(LineString(path[1:]).buffer(thick, quad_segs=fine), "z", (0, t))]
    if k.way == "old":
        solids.append(ball((*path[-1], t / 2), (1.3 * thick,) * 3, k.n))
    return solids


def paper_shears(m: Model) -> None:
    """Scissors: two equal loops, tailor's shears with a small and a long loop, or snips that are joined behind."""
    k = maker(m)
    design, t, rest = m.pick("loops", "loops", "tailor", "snips"), m.number(0.0015, 0.003), m.pick(0.0, 10.0, 25.0, 40.0)
    blade, wide = m.number(0.05, 0.12), m.number(0.008, 0.014)
    if design == "snips":
        _snips(k, blade, wide, t)
        return
    grip, spread = m.number(0.05, 0.08), m.number(0.018, 0.026)
    lead = m.number(0.3, 0.5)
    for half in HALVES:
        s = half[0]
        edge = [(-0.25 * wide * s, 0.3 * wide), (-0.2 * wide * s, -lead * blade), (0.0, -blade), (0.12 * wide * s, -blade)]
        outline = Polygon([*edge, (0.8 * wide * s, -0.25 * blade), (0.75 * wide * s, 0.4 * wide)]).buffer(0)
        arm = LineString([(0, 0), (-0.3 * s * spread, 0.3 * grip), (-0.55 * s * spread, 0.6 * grip)]).buffer(0.42 * wide)
        boss = Spot(0, 0).buffer(0.62 * wide, quad_segs=2 if k.way == "low" else 6)
        layer = (0.0, t) if s > 0 else (t + 0.0002, 2 * t + 0.0002)
        solids = [plate(outline.union(arm).union(boss), "z", layer, k)]
        stretch = 1.0 if design == "loops" else (1.7 if s > 0 else 0.8)
        solids += _loop(k, s, (grip, spread, stretch), t)
        _place(k, half, solids, rest)
    top = 2 * t + 0.0002
    screw = [rod((0, 0, -0.001), (0, 0, top + 0.001), 0.3 * wide, k.n)]
    if k.way == "cad":
        screw.append(ring((0, 0, top), (0, 0, 1), 0.36 * wide, 0.0006, 16))
    if k.way == "old":
        screw.append(moved(lathe([(0.45 * wide, 0), (0.4 * wide, 0.002), (0.2 * wide, 0.003)], k.n), (0, 0, top)))
    m.add(m.pick(BASE, "other_half"), *screw)
    m.hinge("other_half", (0, 0, 0), (0, 0, -1), (-rest, m.pick(60, 80) - rest))


def _loop(k: Maker, s: int, sizes: tuple[float, float, float], t: float) -> list[Trimesh]:
    """A loop for fingers behind an arm: a round bar, a plate with a hole, an angular one, or a shell on the arm."""
    grip, spread, stretch = sizes
    rx, ry = 0.5 * spread * min(1.15, stretch), 0.26 * grip * stretch + 0.2 * spread
    thick = k.m.number(0.0035, 0.0055)
    center = (-s * (0.62 * spread + 0.35 * rx), 0.62 * grip + 0.8 * ry)
    round_ = Spot(0, 0).buffer(1.0, quad_segs={"low": 2, "sheet": 3}.get(k.way, 8))
    middle = rotate(scale(round_, rx, ry), s * 8)
    outline = Polygon([(x + center[0], y + center[1]) for x, y in middle.exterior.coords])
    z = t if k.way != "sheet" else t / 2
    if k.way in ("soft", "old"):
        path = [vec(x, y, z) for x, y in outline.exterior.coords]
        return [tube(path, thick, k.n)]
    shape = outline.buffer(thick, quad_segs=2).difference(outline.buffer(-0.6 * thick))
    if k.way == "sheet":
        return [plate(shape, "z", (0.0, 2 * t), k)]
    depth = (-thick / 2, 2 * t + thick / 2)
    root = LineString([(-0.5 * s * spread, 0.5 * grip), center]).buffer(1.2 * thick).difference(outline.buffer(-0.5 * thick))
    whole = shape.union(root)
    if k.way == "low":
        depth = (0.0, 2 * t)
    return [prism(g, "z", depth) for g in getattr(whole, "geoms", [whole])]


def _snips(k: Maker, blade: float, wide: float, t: float) -> None:
    """Two blades on two bowed grips that are pinned together at the back."""
    grip, bow, rest = 0.9 * blade, k.m.number(1.2, 2.0) * wide, k.m.pick(6.0, 12.0)
    pivot = (0.0, grip)
    for half in HALVES:
        s = half[0]
        layer = (0.0, t) if s > 0 else (t + 0.0002, 2 * t + 0.0002)
        edge = [(-0.2 * s * wide, 0.1 * grip), (0.0, -blade), (0.1 * s * wide, -blade), (0.9 * s * wide, -0.1 * blade)]
        steel = Polygon([*edge, (0.9 * s * wide, 0.2 * grip), (-0.2 * s * wide, 0.2 * grip)]).buffer(0)
        line = LineString([(0.4 * s * wide, 0.1 * grip), (s * bow, 0.4 * grip), (0.8 * s * bow, 0.75 * grip), pivot])
        solids = [plate(steel.union(line.buffer(0.3 * wide, quad_segs=3)), "z", layer, k)]
        if k.way not in ("sheet", "low"):
            grips = LineString([(0.7 * s * bow, 0.25 * grip), (s * bow, 0.4 * grip), (0.8 * s * bow, 0.75 * grip)])
            solids.append(prism(grips.buffer(0.5 * wide, quad_segs=4), "z", (-t, 3 * t)))
        _place(k, half, solids, rest, pivot)
    k.m.add(k.m.pick(BASE, "other_half"), rod((*pivot, -0.001), (*pivot, 2 * t + 0.0012), 0.4 * wide, k.n))
    k.m.hinge("other_half", (*pivot, 0), (0, 0, -1), (-rest, 25 - rest))
