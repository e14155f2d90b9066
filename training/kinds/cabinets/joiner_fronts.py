"""Fronts of doors and drawers and what one pulls them by, in the six ways of the joiner."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.joiner_style import Look, bevelled, middle, open_box, parted, plane, shrunk, turned_post
from training.kinds.model import Model
from training.kinds.solids import Span, arch, box, cut, loft, prism, rectangle, ring, rod, rounded, tube, vec


def front(m: Model, look: Look, x: Span, z: Span, y: Span, glass: bool = False) -> list[Trimesh]:
    """The panel of a door or drawer between two depths, y[0] in front."""
    if glass:
        return glazed(look, x, z, y)
    return {"prop": _prop, "sheet": _sheet, "cad": _cad, "round": _round, "block": _block, "old": _old}[look.way](look, x, z, y)


def _edge(x: Span, z: Span) -> float:
    """Width of a frame that suits a front."""
    return min(0.06, 0.22 * min(x[1] - x[0], z[1] - z[0]))


def _prop(look: Look, x: Span, z: Span, y: Span) -> list[Trimesh]:
    if look.design == 0:
        return [box(x, y, z)]
    if look.design == 1:
        return [bevelled(x, y, z, 0.006, "y", 1)]
    if look.design == 3:
        boards = parted(z, (1, 1, 1) if z[1] - z[0] < 0.6 else (1,) * 5, 0.0)
        return [box(x, (y[0] + 0.003 * (k % 2), y[1]), s) for k, s in enumerate(boards)]
    e = _edge(x, z)
    return [box(x, y, z), box(shrunk(x, e), (y[0] - 0.006, y[0] + 0.001), shrunk(z, e))]


def _sheet(look: Look, x: Span, z: Span, y: Span) -> list[Trimesh]:
    if look.design == 0:
        return [plane("y", y[0], x, z, -1)]
    if look.design == 1:
        return [open_box(x, (y[0] - 0.012, y[0]), z, "+y")]
    e = _edge(x, z)
    if look.design == 3:
        strips = [plane("y", y[0] - 0.004, x, s, -1) for s in ((z[0], z[0] + e), (z[1] - e, z[1]))]
        return [plane("y", y[0], x, z, -1), *strips]
    rings = [(0.0, 0.0), (e, 0.0), (e + 0.008, 0.006), (e + 0.01, 0.006)]
    skin = np.array([_corners(shrunk(x, a), shrunk(z, a), y[0] + b - 0.006) for a, b in rings])
    panel = loft(skin, caps=False)
    if (panel.face_normals[:, 1] * panel.area_faces).sum() > 0:
        panel.invert()
    return [panel, plane("y", y[0], shrunk(x, e + 0.01), shrunk(z, e + 0.01), -1)]


def _corners(x: Span, z: Span, y: float) -> list[tuple[float, float, float]]:
    return [(x[0], y, z[0]), (x[1], y, z[0]), (x[1], y, z[1]), (x[0], y, z[1])]


def _members(x: Span, z: Span, y: Span, e: float) -> list[Trimesh]:
    """Two stiles and two rails."""
    stiles = [box(s, y, z) for s in ((x[0], x[0] + e), (x[1] - e, x[1]))]
    return stiles + [box(shrunk(x, e), y, s) for s in ((z[0], z[0] + e), (z[1] - e, z[1]))]


def _cad(look: Look, x: Span, z: Span, y: Span) -> list[Trimesh]:
    if look.design == 0:
        return [box(shrunk(x, 0.001), y, shrunk(z, 0.001)), *_members(x, z, y, 0.001)]
    if look.design == 1:
        e = _edge(x, z)
        thick = y[1] - y[0]
        return [
            *_members(x, z, y, e),
            box(shrunk(x, e - 0.006), (y[0] + 0.4 * thick, y[0] + 0.7 * thick), shrunk(z, e - 0.006)),
        ]
    wide = x[1] - x[0]
    boards = parted(x, [1] * max(2, round(wide / 0.11)), 0.002)
    planks = [box(s, (y[0], y[1] - 0.006), z) for s in boards]
    battens = [box(shrunk(x, 0.12 * wide), (y[1] - 0.006, y[1]), s) for s in parted(shrunk(z, _edge(x, z)), (1, 3, 1), 0)[::2]]
    return planks + battens


def _round(look: Look, x: Span, z: Span, y: Span) -> list[Trimesh]:
    r = min(0.014, 0.3 * min(x[1] - x[0], z[1] - z[0]))
    if look.design == 0:
        return [prism(rounded(x, z, r), "y", y)]
    if look.design == 1:
        return [bevelled(x, y, z, 0.4 * (y[1] - y[0]), "y")]
    if look.design == 3:
        inlay = rounded(shrunk(x, 0.9 * _edge(x, z)), shrunk(z, 0.9 * _edge(x, z)), 0.25 * min(x[1] - x[0], z[1] - z[0]))
        return [prism(rounded(x, z, r), "y", y), prism(inlay, "y", (y[0] - 0.002, y[0] + 0.001))]
    e = 0.8 * _edge(x, z)
    outer, inner = rounded(shrunk(x, e), shrunk(z, e), r), rounded(shrunk(x, e + 0.004), shrunk(z, e + 0.004), 0.7 * r)
    groove = prism(Polygon(outer.exterior.coords, [inner.exterior.coords]), "y", (y[0] - 0.01, y[0] + 0.003))
    return [cut(prism(rounded(x, z, r), "y", y), groove)]


def _block(look: Look, x: Span, z: Span, y: Span) -> list[Trimesh]:
    solid = box(x, y, z)
    e = _edge(x, z)
    if look.design == 1:
        solid = cut(solid, box(shrunk(x, e), (y[0] - 0.01, y[0] + 0.005), shrunk(z, e)))
    if look.design == 2:
        wide = x[1] - x[0]
        flutes = parted(shrunk(x, 0.01), [1] * min(24, max(3, round(wide / 0.03))), 0.0)
        solid = cut(solid, *(box((s[1] - 0.003, s[1]), (y[0] - 0.01, y[0] + 0.004), shrunk(z, -0.01)) for s in flutes[:-1]))
    if look.design == 3 and z[1] - z[0] > 0.25:
        slots = parted((z[1] - 0.16, z[1] - 0.05), (1,) * 4, 0.016)
        solid = cut(solid, *(box(shrunk(x, 0.25 * (x[1] - x[0])), (y[0] - 0.1, y[1] + 0.1), s) for s in slots))
    return [solid]


def _old(look: Look, x: Span, z: Span, y: Span) -> list[Trimesh]:
    e, thick = _edge(x, z), y[1] - y[0]
    field = [(e - 0.004, 0.75), (e - 0.004, 0.5), (e + 0.012, 0.35), (e + 0.018, 0.1), (e + 0.02, 0.1)]
    if look.design == 0:
        rings = [_corners(shrunk(x, a), shrunk(z, a), y[0] + b * thick) for a, b in field]
        bead = prism(rectangle(shrunk(x, e - 0.006), shrunk(z, e - 0.006), 0.006), "y", (y[0] - 0.004, y[0] + 0.5 * thick))
        return [*_members(x, z, y, e), loft(np.array(rings)), bead]
    if look.design == 3:
        fields = parted(shrunk(z, e), (1,) if z[1] - z[0] < 0.4 else (1, 1.6) if z[1] - z[0] < 1.2 else (1, 1, 0.6), e)
        rails = [box(shrunk(x, e), y, (a[1], a[1] + e)) for a in fields[:-1]]
        depth = (y[0] + 0.2 * thick, y[1] - 0.2 * thick)
        return [
            *_members(x, z, y, e),
            *rails,
            *(bevelled(shrunk(x, e - 0.002), depth, shrunk(s, -0.002), 0.012) for s in fields),
        ]
    if look.design == 1 and z[1] - z[0] > 0.35:
        inside = arch(shrunk(x, e), shrunk(z, e), min(0.4 * (x[1] - x[0] - 2 * e), 0.12))
        frame = Polygon(rectangle(x, z).exterior.coords, [inside.exterior.coords])
        lip = Polygon(inside.buffer(0.008, join_style=2).exterior.coords, [inside.buffer(-0.004, join_style=2).exterior.coords])
        panel = prism(inside.buffer(0.004, join_style=2), "y", (y[0] + 0.45 * thick, y[0] + 0.8 * thick))
        return [prism(frame, "y", y), panel, prism(lip, "y", (y[0] - 0.004, y[0] + 0.5 * thick))]
    bead = prism(rectangle(shrunk(x, 0.6 * e), shrunk(z, 0.6 * e), 0.009), "y", (y[0] - 0.005, y[0] + 0.002))
    cx, cz, r = middle(x), middle(z), 0.5 * min(0.12, x[1] - x[0] - 2 * e, z[1] - z[0] - 2 * e)
    lozenge = prism([(cx - 0.5 * r, cz), (cx, cz - r), (cx + 0.5 * r, cz), (cx, cz + r)], "y", (y[0] - 0.004, y[0] + 0.002))
    return [box(x, y, z), bead, *([lozenge] if look.design == 1 or z[1] - z[0] > 0.3 else [])]


def glazed(look: Look, x: Span, z: Span, y: Span) -> list[Trimesh]:
    """A frame with a pane, perhaps with bars across it, or a bare pane."""
    e, thick, at = _edge(x, z), y[1] - y[0], middle(y)
    if look.way == "sheet":
        pane = plane("y", y[0], x, z, -1)
        return [pane, *(plane("y", y[0] - 0.001, s, z, -1) for s in ((x[0], x[0] + e), (x[1] - e, x[1])))]
    if look.way in ("block", "round") and look.design == 0:
        return [prism(rounded(x, z, 0.004), "y", (at - 0.003, at + 0.003))]
    frame = _members(x, z, y, e) if look.way in ("cad", "old") else [prism(rectangle(x, z, e), "y", y)]
    inner_x, inner_z = shrunk(x, e), shrunk(z, e)
    pane = box(shrunk(inner_x, -0.004), (at - 0.002, at + 0.002), shrunk(inner_z, -0.004))
    pieces = [*frame, pane] if look.inside or look.design else frame
    if look.way == "old" or look.design == 2:
        bars = (max(1, round((x[1] - x[0]) / 0.2)), max(1, round((z[1] - z[0]) / 0.25)))
        depth = (y[0] + 0.15 * thick, y[1] - 0.15 * thick)
        pieces += [box((s[1] - 0.006, s[1] + 0.006), depth, inner_z) for s in parted(inner_x, [1] * bars[0], 0)[:-1]]
        pieces += [box(inner_x, depth, (s[1] - 0.006, s[1] + 0.006)) for s in parted(inner_z, [1] * bars[1], 0)[:-1]]
    return pieces


def pull(look: Look, at: tuple[float, float], y: float, along: str, long: float) -> list[Trimesh]:
    """What one pulls a front by, at (x, z) on its face y; bars lie along x or z."""
    x, z = at
    half = 0.5 * long
    d = vec(half, 0, 0) if along == "x" else vec(0, 0, half)
    u = d / half
    here = vec(x, y, z)
    wide, high = (half, 0.008) if along == "x" else (0.008, half)
    if look.pull == "knob":
        profile = [(0, -0.001), (0.007, -0.001), (0.006, 0.008), (0.014, 0.014), (0.016, 0.02), (0.011, 0.027), (0, 0.029)]
        return [turned_post(here, profile, look.n, (0, -1, 0))]
    if look.pull == "bar":
        out = vec(0, -0.028, 0)
        posts = [rod(here + s * 0.75 * d + vec(0, 0.002, 0), here + s * 0.75 * d + out, 0.004, look.n) for s in (-1, 1)]
        return [rod(here - d + out, here + d + out, 0.0055, look.n), *posts]
    if look.pull == "bow":
        bend = [here + 0.9 * d * np.cos(t) + vec(0, 0.003 - 0.032 * np.sin(t), 0) for t in np.linspace(0, np.pi, 9)]
        feet = [
            rod(here + s * 0.9 * d + vec(0, 0.002, 0), here + s * 0.9 * d - vec(0, 0.003, 0), 0.01, look.n) for s in (-1, 1)
        ]
        return [tube(bend, 0.005, 8), *feet]
    if look.pull == "ring":
        plate = prism(rounded((x - 0.015, x + 0.015), (z - 0.03, z + 0.03), 0.012), "y", (y - 0.003, y + 0.001))
        return [plate, ring((x, y - 0.008, z - 0.012), (0, 1, 0), 0.018, 0.003, max(12, look.n)), _stud(here, look)]
    if look.pull == "cup":
        t = np.linspace(0, np.pi / 2, 6)
        round_ = np.c_[np.sin(t), np.cos(t)] * (-1, 1)
        outer, inner = ((y, z - 0.004) + r * round_ for r in (0.024, 0.021))
        shell = [(y + 0.001, z + 0.02), *outer, *inner[::-1], (y + 0.001, z + 0.017)]
        ends = [(y + 0.001, z - 0.004), *((y, z - 0.004) + 0.022 * round_)[::-1], (y + 0.001, z + 0.018)]
        sides = [prism(ends, "x", (x + s * 0.038, x + s * 0.041)) for s in (-1, 1)]
        return [prism(shell, "x", (x - 0.04, x + 0.04)), *sides]
    if look.pull == "strip" and along == "x":
        lip = box((x - wide, x + wide), (y - 0.022, y + 0.001), (z - high, z - high + 0.003))
        return [box((x - wide, x + wide), (y - 0.003, y + 0.001), (z - high, z + high)), lip]
    if look.pull == "strip":
        return [box((x - 0.002, x + 0.002), (y - 0.024, y + 0.001), (z - high, z + high))]
    if look.pull in ("plate", "lip"):
        out = y - (0.018 if look.pull == "plate" else 0.03)
        return [box((x - 0.7 * wide, x + 0.7 * wide), (out, y + 0.001), (z - 0.7 * high, z + 0.7 * high))]
    if look.pull == "flat":
        a, b = here - 0.7 * d, here + 0.7 * d
        return [plane("y", y - 0.015, _span(a[0], b[0], 0.01), _span(a[2], b[2], 0.01), -1), _link(here, u)]
    return []


def _stud(here: np.ndarray, look: Look) -> Trimesh:
    return rod(here + vec(0, 0.001, 0.008), here + vec(0, -0.013, 0.008), 0.005, look.n)


def _span(a: float, b: float, least: float) -> Span:
    low, high = min(a, b), max(a, b)
    return (low, high) if high - low > least else (low - least, high + least)


def _link(here: np.ndarray, u: np.ndarray) -> Trimesh:
    """The plane that ties a flat handle to its front."""
    if u[0] > 0.5:
        return plane("z", here[2], (here[0] - 0.01, here[0] + 0.01), (here[1] - 0.015, here[1]))
    return plane("x", here[0], (here[1] - 0.015, here[1]), (here[2] - 0.01, here[2] + 0.01))


def with_notch(look: Look, pieces: list[Trimesh], x: float, z: float, y: float, along: str) -> list[Trimesh]:
    """The same front with a finger hold cut out of its first solid."""
    if look.pull != "notch" or not pieces[0].is_watertight:
        return pieces
    wide, high = (0.045, 0.014) if along == "x" else (0.014, 0.045)
    hold = bevelled((x - wide, x + wide), (y - 0.01, y + 0.01), (z - high, z + high), 0.006)
    return [cut(pieces[0], hold), *pieces[1:]]
