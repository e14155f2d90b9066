"""Seeded synthetic objects for `speed.py`: few parts with many faces, and many connected components."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import trimesh
from trimesh.creation import box, cylinder, icosphere, revolve
from trimesh.util import concatenate

SEED = 0
POT_LINES = 12  # segments of the three profiles of a pot, before they are divided
POT_POLES = 6  # ends of profiles on the axis, whose last row has triangles for quadrilaterals
POT_SECTIONS = 6  # sections round the axis, per row of a segment
TUBE_SHARE = 0.1  # of the components of a chandelier; the rest are beads
RING = 40  # items on one board of a shelf


def pot(faces: int) -> trimesh.Trimesh:
    """Make a pot with a lid that rests on it and a knob: three components, about `faces` faces."""
    rows = max(1, round(np.sqrt(faces / (2 * POT_LINES * POT_SECTIONS))))
    sections = max(12, round(faces / (2 * POT_LINES * rows - POT_POLES)))
    body = [(0, 0), (0.11, 0), (0.12, 0.02), (0.12, 0.14), (0.117, 0.14), (0.117, 0.022), (0, 0.004)]
    lid = [(0, 0.1405), (0.119, 0.1405), (0.119, 0.146), (0, 0.156)]
    knob = [(0, 0.1565), (0.012, 0.1565), (0.015, 0.17), (0, 0.178)]
    millimetres = [revolve(1000 * _finer(line, rows), sections=sections) for line in (body, lid, knob)]
    return concatenate(millimetres).apply_scale(0.001)  # revolved in metres, the smallest faces would be dropped


def _finer(line: list[tuple[float, float]], rows: int) -> np.ndarray:
    """Divide every segment of a line into `rows`."""
    at = np.linspace(0, len(line) - 1, rows * (len(line) - 1) + 1)
    points = np.array(line, float)
    return np.stack([np.interp(at, np.arange(len(line)), points[:, k]) for k in range(2)], 1)


def boards(components: int) -> trimesh.Trimesh:
    """Make a container of boards on a tray, each crossed by bars that go through it."""
    made = [_box((1.0, 0.6, 0.03), (0, 0, 0.015))]
    count = max(0, components - 1)
    across = max(1, int(np.ceil(np.sqrt(count / 4))))
    rng = np.random.default_rng(SEED)
    for k in range(count):
        board, bar = divmod(k, 4)
        row, column = divmod(board, across)
        x, y = -0.45 + 0.9 * (column + 0.5) / across, -0.27 + 0.54 * (row + 0.5) / across
        width, height = 0.7 / across, 0.25 + 0.1 * rng.random()
        if bar == 0:
            made.append(_box((width, 0.05 / across, height), (x, y, 0.03 + height / 2)))
        else:
            made.append(_box((0.04 / across, 0.3 / across, 0.01), (x, y, 0.03 + 0.06 * bar)))
    return concatenate(made)


def pile(components: int) -> trimesh.Trimesh:
    """Make a pile of long sticks in random directions, most of which cross others."""
    rng = np.random.default_rng(SEED)
    made = []
    for _ in range(components):
        pose = trimesh.transformations.random_rotation_matrix(rng.random(3))
        pose[:3, 3] = rng.uniform(-0.3, 0.3, 3)
        made.append(box((0.01, 0.01, 1.0)).apply_transform(pose))
    return concatenate(made)


def chandelier(components: int) -> trimesh.Trimesh:
    """Make a lamp: a stem, thin tubes out from it and strings of beads that hang below them."""
    made = [cylinder(0.02, 0.8, sections=24).apply_translation((0, 0, 0.4))]
    tubes = max(1, int(TUBE_SHARE * components)) if components > 1 else 0
    per_tube = -(-max(0, components - 1 - tubes) // max(1, tubes))
    bead = icosphere(subdivisions=1, radius=0.004)
    for k in range(tubes):
        angle, level = 2.4 * k, 0.3 + 0.4 * (k + 0.5) / tubes
        end = np.array([0.4 * np.cos(angle), 0.4 * np.sin(angle), level])
        made.append(cylinder(0.003, segment=[[0, 0, level], end], sections=12))
        for b in range(min(per_tube, components - len(made))):
            made.append(bead.copy().apply_translation(end - (0, 0, 0.012 * (b + 1))))
    return concatenate(made[:components])


def shelf(components: int) -> trimesh.Trimesh:
    """Make a shelf: a frame of boards in one piece, and items that stand on them."""
    levels = max(1, -(-components // RING))
    walls = [_box((0.02, 0.3, 0.35 * levels + 0.02), (x, 0, 0.175 * levels)) for x in (-0.51, 0.51)]
    floors = [_box((1.04, 0.3, 0.02), (0, 0, 0.35 * k)) for k in range(levels + 1)]
    frame = trimesh.boolean.union([*walls, *floors], engine="manifold")
    rng = np.random.default_rng(SEED)
    items = []
    for k in range(components - 1):
        level, at = divmod(k, RING)
        row, column = divmod(at, RING // 2)
        height, side = 0.05 + 0.2 * rng.random(), 0.02 + 0.015 * rng.random()
        where = (-0.47 + 0.94 * column / (RING // 2 - 1), -0.07 + 0.14 * row, 0.35 * level + 0.0101 + height / 2)
        round_one = k % 3 == 0
        shape = cylinder(side / 2, height, sections=16) if round_one else box((side, 1.5 * side, height))
        items.append(shape.apply_translation(where))
    return concatenate([frame, *items])


def _box(size: tuple[float, ...], middle: tuple[float, ...]) -> trimesh.Trimesh:
    return box(size).apply_translation(middle)


FACES: dict[str, Callable[[int], trimesh.Trimesh]] = {"pot": pot}
COMPONENTS: dict[str, Callable[[int], trimesh.Trimesh]] = {
    "boards": boards, "chandelier": chandelier, "shelf": shelf, "pile": pile,
}  # fmt: skip
