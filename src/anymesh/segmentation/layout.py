"""Layout of panels on a face of a fused cabinet, from its handles: one panel per handle.

Panels tile a face by cuts from side to side (a guillotine layout, as of facades). Along its own axis, a handle is in the middle
of its panel (a drawer, a flap). Otherwise it is next to an edge that is parallel to it (a door). A knob is in the middle or
next to an edge.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Float, Int
from scipy import ndimage

MAX_PANEL_ASPECT = 5.0  # maximum aspect ratio of a panel; a longer one belongs to a row of controls
GRID = 32  # cells along each side of a face, for finding the rectangle that it fills
MIN_FILL_RATIO = 0.9  # minimum share of filled cells
MAX_HANDLES = 12  # maximum number of handles on one face; more of them are not handles


@dataclass(frozen=True)
class PanelRectangle:
    """A rectangle of a face and the index of its handle."""

    low: tuple[float, float]
    high: tuple[float, float]
    handle: int


def filled(
    points: Float[np.ndarray, "n 2"], around: Float[np.ndarray, "2 2"]
) -> tuple[Float[np.ndarray, " 2"], Float[np.ndarray, " 2"]] | None:
    """Return the corners of the largest rectangle that the points fill and that contains `around`, None if there is none.

    Holes count as filled.

    around: lower and upper corner.
    """
    low, high = points.min(0), points.max(0)
    size = np.maximum((high - low) / GRID, 1e-300)

    def cell(p: np.ndarray) -> np.ndarray:
        return np.clip(((p - low) / size).astype(int), 0, GRID - 1)

    there = np.zeros((GRID, GRID), bool)
    there[tuple(cell(points).T)] = True
    total = np.pad(ndimage.binary_fill_holes(there), ((1, 0), (1, 0))).astype(int).cumsum(0).cumsum(1)
    (a0, b0), (a1, b1) = cell(around)
    i, j, k, m = np.meshgrid(
        np.arange(a0 + 1), np.arange(b0 + 1), np.arange(a1 + 1, GRID + 1), np.arange(b1 + 1, GRID + 1), indexing="ij"
    )
    area = (k - i) * (m - j)
    full = total[k, m] - total[i, m] - total[k, j] + total[i, j] >= MIN_FILL_RATIO * area
    if not full.any():
        return None
    at = np.unravel_index(np.where(full, area, 0).argmax(), area.shape)
    return low + size * [i[at], j[at]], low + size * [k[at], m[at]]


def tile(
    low: Float[np.ndarray, " 2"],
    high: Float[np.ndarray, " 2"],
    handles: Float[np.ndarray, "h 2 2"],
    along: Int[np.ndarray, " h"],
) -> tuple[PanelRectangle, ...]:
    """Return the panels of the likeliest layout of a face, one per handle; none if no layout is plausible.

    handles: (h, 2, 2) lower and upper corner of each; along: (h,) the axis that each runs along, -1 for a knob.
    """
    if not 0 < len(handles) <= MAX_HANDLES:
        return ()

    @cache
    def best(box: tuple[float, ...], members: tuple[int, ...]) -> tuple[float, tuple[PanelRectangle, ...]]:
        if len(members) == 1:
            panel = PanelRectangle((box[0], box[1]), (box[2], box[3]), members[0])
            return _layout_cost(panel, handles[members[0]], int(along[members[0]])), (panel,)
        best_layout: tuple[float, tuple[PanelRectangle, ...]] = (np.inf, ())
        for axis in (0, 1):
            for at, before, after in _cuts(box, members, handles, axis):
                one = best((*box[: 2 + axis], at, *box[3 + axis :]), before)
                two = best((*box[:axis], at, *box[axis + 1 :]), after)
                if one[0] + two[0] < best_layout[0]:
                    best_layout = (one[0] + two[0], one[1] + two[1])
        return best_layout

    cost, panels = best((float(low[0]), float(low[1]), float(high[0]), float(high[1])), tuple(range(len(handles))))
    return panels if np.isfinite(cost) else ()


def _layout_cost(panel: PanelRectangle, handle: np.ndarray, along: int) -> float:
    """Return the deviation of the handle from its expected place on such a panel; infinite if it cannot be a panel."""
    low, high = np.array(panel.low), np.array(panel.high)
    sides = high - low
    if sides.max() > MAX_PANEL_ASPECT * sides.min():
        return np.inf
    off = np.abs(handle.mean(0) - (low + high) / 2) / sides  # 0 in the middle, 0.5 at the edge
    if along < 0:
        return float(min(off.sum(), 1 - 2 * off.max()))
    return float(min(2 * off[along] + off[1 - along], 1 - 2 * off[1 - along]))


def _cuts(
    box: tuple[float, ...], members: tuple[int, ...], handles: np.ndarray, axis: int
) -> list[tuple[float, tuple[int, ...], tuple[int, ...]]]:
    """Return the positions for cuts of a rectangle across an axis, with the handles on both sides.

    Cuts are half way between two handles, and where a handle would be in the middle of its panel.
    """
    order = sorted(members, key=lambda h: handles[h, 0, axis])
    cuts = []
    for k in range(1, len(order)):
        before, after = tuple(sorted(order[:k])), tuple(sorted(order[k:]))
        start = max(handles[h, 1, axis] for h in before)
        end = min(handles[h, 0, axis] for h in after)
        if start >= end:
            continue
        middles = [float(handles[h, :, axis].mean()) for h in members]
        mirrored = [2 * m - box[axis + side] for m in middles for side in (0, 2)]
        cuts += [(at, before, after) for at in ((start + end) / 2, *mirrored) if start < at < end]
    return cuts
