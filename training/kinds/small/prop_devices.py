"""Small devices by another artist: spectacles."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from shapely import affinity
from shapely.geometry import LineString, Point, Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.prop_style import Style, draw_style, sheet
from training.kinds.solids import ball, box, mirrored, prism, rounded, tube, vec


def spectacles(m: Model) -> None:
    """Rims and a bridge with two folding temples: round, square, drop, half or no rims; sun glasses; open or folded."""
    s = draw_style(m)
    high, wide, gap = m.number(0.028, 0.048), m.number(0.044, 0.058), m.number(0.014, 0.022)
    bar, t = m.pick(0.0015, 0.003, 0.005), m.pick(0.0015, 0.003, 0.004)
    lens = _lens(m, wide, high)
    glazed = m.chance(0.75)
    rims = m.pick("full", "full", "full", "half", "none")
    middle = gap / 2 + wide / 2
    for sign in (-1, 1):
        shape = affinity.translate(affinity.scale(lens, sign, 1.0), sign * middle, 0)
        ring = shape.buffer(bar, join_style="round").difference(shape)
        if rims == "half":
            ring = ring.intersection(Polygon([(-1, 0), (1, 0), (1, 1), (-1, 1)]))
        if rims != "none":
            m.add(BASE, prism(ring, "y", (-t / 2, t / 2)))
        if rims == "none" or glazed:
            across, upward = np.reshape(shape.bounds, (2, 2)).T
            flat = s.way == "sheet" and rims == "full" and bar > 0.004
            m.add(
                BASE,
                sheet(tuple(across), (0, 0), tuple(upward)) if flat else prism(shape.buffer(0.0003), "y", (-0.0006, 0.0006)),
            )
    up = m.pick(0.15, 0.25, 0.4) * high
    inner, _, outer, _ = lens.intersection(LineString([(-1, up), (1, up)])).bounds
    half = middle + outer + bar
    _bridge(s, middle + inner + 0.001, up, max(bar, 0.0015))
    folded = m.chance(0.3)
    for sign in (-1, 1):
        m.add(
            BASE, box((sign * (half - bar - 0.003), sign * (half + 0.006)), (-t / 2, t / 2 + 0.004), (up - 0.0025, up + 0.0025))
        )
    at = vec(half + 0.004, t / 2 + 0.005, up)
    right = _temple(s, at, 2 * half, folded)
    for sign, part, pieces in ((-1, "temple_left", [mirrored(piece) for piece in right]), (1, "temple_right", right)):
        pin = at * (sign, 1, 1)
        if folded:
            turn = np.array([[0, -sign, 0], [sign, 0, 0], [0, 0, 1]], float)
            for piece in pieces:
                piece.vertices = (piece.vertices - pin) @ turn.T + pin + vec(0, 0.002 + (0.003 if sign > 0 else 0.0), 0)
        m.add(part, *pieces)
        m.hinge(part, pin, (0, 0, -sign if folded else sign), m.pick(85, 90))


def _lens(m: Model, wide: float, high: float) -> Polygon:
    """The outline of the right lens about its middle."""
    sort = m.pick("round", "square", "soft", "drop", "cat")
    x, z = (-wide / 2, wide / 2), (-high / 2, high / 2)
    if sort == "round":
        return affinity.scale(Point(0, 0).buffer(1.0, quad_segs=m.pick(3, 6, 8)), high / 2 * 1.08, high / 2)
    if sort == "square":
        return rounded(x, z, 0.12 * high)
    if sort == "soft":
        return rounded(x, z, 0.42 * high)
    if sort == "drop":
        points = [
            (x[0], 0.7 * z[1]),
            (0.7 * x[0], z[1]),
            (0.8 * x[1], z[1]),
            (x[1], 0.5 * z[1]),
            (0.7 * x[1], 0.7 * z[0]),
            (0.1 * x[1], z[0]),
            (0.6 * x[0], 0.5 * z[0]),
        ]
        return Polygon(points).buffer(-0.004).buffer(0.004, quad_segs=4)
    return Polygon(
        [
            (x[0], 0.6 * z[1]),
            (0.5 * x[0], z[1]),
            (1.1 * x[1], 1.3 * z[1]),
            (x[1], 0.3 * z[0]),
            (0.5 * x[1], z[0]),
            (0.7 * x[0], z[0]),
        ]
    )


def _bridge(s: Style, half: float, up: float, r: float) -> None:
    """A bridge, a second bar, nose pads on wires."""
    m = s.m
    if s.way in ("low", "sheet", "sunk"):
        m.add(BASE, box((-half, half), (-r, r), (up - r, up + 1.5 * r)))
    else:
        m.add(
            BASE,
            tube(
                [
                    vec(-half, 0, up),
                    vec(-0.5 * half, -0.001, up + 0.003),
                    vec(0.5 * half, -0.001, up + 0.003),
                    vec(half, 0, up),
                ],
                r,
                8,
            ),
        )
    if m.chance(0.2):
        m.add(BASE, tube([vec(-half - 0.003, 0, up + 0.012), vec(half + 0.003, 0, up + 0.012)], 0.8 * r, 8))
    if m.chance(0.5):
        for sign in (-1, 1):
            pad = vec(sign * (half - 0.001), 0.007, up - 0.012)
            m.add(
                BASE,
                ball(pad, (0.0018, 0.003, 0.006), 8),
                tube([vec(sign * half, 0, up - 0.01), pad + vec(0, -0.001, 0.001)], 0.0009, 6),
            )


def _temple(s: Style, at: Float[np.ndarray, " 3"], across: float, folded: bool) -> list[Trimesh]:
    """The right temple behind its hinge, with a bent end; not yet folded."""
    m, long, tall = s.m, min(0.145, 0.98 * across) if folded else s.m.number(0.125, 0.145), s.m.number(0.0015, 0.005)
    bend, drop = 0.72 * long, m.pick(0.0, 0.02, 0.03)
    thick = m.pick(0.0012, 0.002)
    path = [at, at + vec(0, bend, 0), at + vec(0, long, -drop)]
    if s.way in ("round", "cad") and m.chance(0.6):
        pieces = [tube(path, max(0.0013, 0.4 * tall), 8)]
        if drop:
            pieces.append(tube([at + vec(0, bend + 0.01, -0.3 * drop), path[2]], max(0.0013, 0.4 * tall) * 1.8, 8))
    else:
        shape = [(p[1], p[2] + tall) for p in path] + [(p[1], p[2] - tall) for p in path[::-1]]
        x = (at[0] - thick, at[0] + thick)
        pieces = [prism(shape, "x", x)]
        if s.way == "cad":
            pieces += [box((at[0] - 0.002, at[0] + 0.002), (at[1] - 0.003, at[1] + 0.006), (at[2] - 0.002, at[2] + 0.002))]
    return pieces
