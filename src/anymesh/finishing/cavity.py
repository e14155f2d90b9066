"""Walls for the cavity behind a panel where the body's own shell is far away, as beside a microwave's controls."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np
from jaxtyping import Float

from anymesh.finishing.blocks import board
from anymesh.finishing.free import moves_freely
from anymesh.finishing.panels import PanelBox
from anymesh.finishing.scenes import Growing, scene_of
from anymesh.finishing.settings import ShapeConfig
from anymesh.geometry.raycast_ import RayScene

MAX_SIDE_GAP_WALLS = 3.0  # in wall thicknesses: a side of the body nearer than this to the cavity's edge bounds it
TURNED = 0.05  # maximum difference between the axes of adjacent panels
INTO = 0.02  # share of a wall by which boards extend into what they end at; no shell is thinner
INSET = 0.02  # share of a board's side: what extends in no further only touches it
PROBES = 8  # rays along each direction of a side
THERE = 0.6  # minimum share of a strip between two panels that a rail fills
ALONG = 0.5  # minimum overlap of adjacent panels, as a share of the shorter edge
COVERS = 0.3  # minimum share of the body's side covered by panels with separate cavities; less is the flap of a bin
FIRST = 0.4  # share of the cavity's depth within which the body's face lies


def add_walls(panel: PanelBox, panels: Sequence[PanelBox], growing: Growing, config: ShapeConfig) -> None:
    """Add boards to the part that carries a panel, where the cavity behind it has no side."""
    parent, standing = growing.scenes.carriers(panel.part)[0], growing.triangles(*growing.scenes.carriers(panel.part))
    body, movers = scene_of(standing), scene_of(growing.others(parent))
    wall = config.wall * growing.scenes.diagonal
    if body is None or movers is None or _covered(panel, panels, standing) < COVERS:
        return
    for axis, sign in product((0, 1), (-1.0, 1.0)):
        if np.isfinite(_side(panel, axis, sign, body, wall)):
            continue
        for low, high in _boards(panel, panels, axis, sign, body, wall):
            clear = config.clearance * growing.scenes.diagonal
            for first in (low[2], panel.low[2] + clear):  # beside the panel, or else behind it
                low[2] = first
                new = board(low, high, panel.axes)
                if not crosses(movers, low, high, panel.axes) and moves_freely(panel.part, growing, growing, beside=new):
                    growing.add(parent, new, ["wall added beside the cavity of a moving part"])
                    break


def _covered(panel: PanelBox, panels: Sequence[PanelBox], standing: Float[np.ndarray, "n 3 3"]) -> float:
    """Compute the share of the body's side that a panel and those parallel to it cover."""
    side = np.ptp(standing.reshape(-1, 3) @ panel.axes[:2].T, axis=0)
    alike = [f for f in panels if _alike(panel, f)]
    return float(sum(np.prod((f.high - f.low)[:2]) for f in alike) / max(float(side.prod()), 1e-300))


def _alike(panel: PanelBox, other: PanelBox) -> bool:
    return float(np.abs(other.axes - panel.axes).max()) < TURNED


def _side(panel: PanelBox, axis: int, sign: float, base: RayScene, wall: float) -> float:
    """Compute the distance from an edge of the cavity to the body's side beyond it [m]; infinite if there is none nearby."""
    other = 1 - axis
    size = panel.high - panel.low
    share = (np.arange(PROBES) + 0.5) / PROBES
    along, deep = np.meshgrid(panel.low[other] + share * size[other], panel.low[2] + (0.2 + 0.6 * share) * size[2])
    local = np.zeros((along.size, 3))
    local[:, axis] = (panel.high if sign > 0 else panel.low)[axis] - sign * wall
    local[:, other], local[:, 2] = along.reshape(-1), deep.reshape(-1)
    ways = np.repeat(sign * panel.axes[axis][None], len(local), 0)
    return float(np.median(base.first_hit(local @ panel.axes, ways, (MAX_SIDE_GAP_WALLS + 1) * wall).distance) - wall)


def _boards(
    panel: PanelBox, panels: Sequence[PanelBox], axis: int, sign: float, base: RayScene, wall: float
) -> Iterator[tuple[Float[np.ndarray, " 3"], Float[np.ndarray, " 3"]]]:
    """Yield the corners of the board at an edge of the cavity.

    There is none where the next cavity begins, unless a rail separates them.
    """
    edge = float((panel.high if sign > 0 else panel.low)[axis])
    beside = [
        (gap, f) for f in panels if (gap := _gap(panel, f, axis, sign)) is not None and -wall < gap < MAX_SIDE_GAP_WALLS * wall
    ]
    thick = wall
    if beside:
        thick, neighbour = min(beside, key=lambda pair: abs(pair[0]))
        if neighbour.part < panel.part or thick < wall / 4:
            return
    low, high = panel.low.copy(), panel.high.copy()
    for side, end in ((-1.0, low), (1.0, high)):  # into the body's sides if they are near, else into the next board
        far = _side(panel, 1 - axis, side, base, wall)
        end[1 - axis] += side * (far + INTO * wall if np.isfinite(far) else wall / 2)
    low[axis], high[axis] = (edge, edge + thick) if sign > 0 else (edge - thick, edge)
    face = _face_level(panel, low, high, axis, base)
    if beside and face is None:
        return
    low[2] = panel.low[2] if face is None else face + min(wall, float(panel.high[2] - face)) / 2
    high[2] = _back_level(panel, low, high, axis, base) + INTO * wall
    if high[2] > low[2]:
        yield low, high


def _back_level(panel: PanelBox, low: np.ndarray, high: np.ndarray, axis: int, base: RayScene) -> float:
    """Return where the body ends behind a board, along the inward direction."""
    local = _along(panel, low, high, axis)
    local[:, 2] = (low[2] + panel.high[2]) / 2
    far = float(panel.high[2] - low[2])
    hits = base.first_hit(local @ panel.axes, np.repeat(panel.axes[2][None], len(local), 0), far)
    return float(local[0, 2] + np.median(np.minimum(hits.distance, far)))


def _along(panel: PanelBox, low: np.ndarray, high: np.ndarray, axis: int) -> Float[np.ndarray, "n 3"]:
    """Return points along the centre line of a board without its ends, at depth 0."""
    share = np.linspace(0.1, 0.9, PROBES**2)
    local = np.zeros((PROBES**2, 3))
    local[:, axis] = (low + high)[axis] / 2
    local[:, 1 - axis] = (panel.low + share[:, None] * (panel.high - panel.low))[:, 1 - axis]
    return local


def _gap(panel: PanelBox, other: PanelBox, axis: int, sign: float) -> float | None:
    """Compute the distance of another parallel panel from an edge of a panel [m]; None if it is not beside it."""
    if other.part == panel.part or not _alike(panel, other):
        return None
    k = 1 - axis
    along = min(panel.high[k], other.high[k]) - max(panel.low[k], other.low[k])
    if along < ALONG * min(panel.high[k] - panel.low[k], other.high[k] - other.low[k]):
        return None
    gap = other.low[axis] - panel.high[axis] if sign > 0 else panel.low[axis] - other.high[axis]
    return float(gap)


def _face_level(panel: PanelBox, low: np.ndarray, high: np.ndarray, axis: int, base: RayScene) -> float | None:
    """Return where the body's own face is before a board, along the inward direction; None if it has none there."""
    local = _along(panel, low, high, axis)
    depth = float(panel.high[2] - panel.low[2])
    local[:, 2] = panel.low[2] - depth
    level = base.first_hit(local @ panel.axes, np.repeat(panel.axes[2][None], len(local), 0), (1 + FIRST) * depth).distance
    hit = np.isfinite(level)
    return float(np.median(level[hit]) + local[0, 2]) if hit.mean() > THERE else None


def crosses(
    scene: RayScene, low: Float[np.ndarray, " 3"], high: Float[np.ndarray, " 3"], axes: Float[np.ndarray, "3 3"]
) -> bool:
    """Return whether a box between two corners in the frame of `axes` (rows) contains any surface of a scene."""
    share = (np.arange(PROBES) + 0.5) / PROBES
    low, high = low + INSET * (high - low), high - INSET * (high - low)
    for k in range(3):
        u, v = (k + 1) % 3, (k + 2) % 3
        local = np.zeros((PROBES**2, 3))
        at = np.stack(np.meshgrid(share, share), -1).reshape(-1, 2)
        local[:, u], local[:, v], local[:, k] = low[u] + at[:, 0] * (high - low)[u], low[v] + at[:, 1] * (high - low)[v], low[k]
        ways = np.repeat(axes[k][None], len(local), 0)
        if (scene.first_hit(local @ axes, ways, float(high[k] - low[k])).face >= 0).any():
            return True
    return False
