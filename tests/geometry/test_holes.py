"""Test which missing triangles of closed surfaces are added again."""

from __future__ import annotations

import numpy as np
import pytest
from manifold3d import Manifold

from anymesh.geometry.holes import missing_triangles
from anymesh.geometry.surface import plain_triangles
from anymesh.geometry.topology import components
from anymesh.types.triangles import unshared


def triangles_of(solid: Manifold) -> np.ndarray:
    mesh = solid.to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3][np.asarray(mesh.tri_verts, np.int64)]


BIN = triangles_of(Manifold.cube((0.4, 0.3, 0.2)) - Manifold.cube((0.38, 0.28, 0.2)).translate((0.01, 0.01, 0.01)))
BALL = triangles_of(Manifold.sphere(1, 48))


@pytest.mark.parametrize("missing", range(len(BIN)))
def test_a_bin_without_one_triangle_is_a_bin(missing) -> None:
    closed, kept = plain_triangles(np.delete(BIN, missing, 0), 0.54)
    parts = components(*unshared(closed))
    assert parts.solid.all()
    assert len(closed) == len(BIN) == len(kept)
    volume = np.einsum("ij,ij->", closed[:, 0], np.cross(closed[:, 1], closed[:, 2])) / 6
    assert volume == pytest.approx(0.4 * 0.3 * 0.2 - 0.38 * 0.28 * 0.19)


def test_a_hundredth_of_a_smooth_solid_is_added() -> None:
    gone = np.random.default_rng(0).choice(len(BALL), len(BALL) // 100, replace=False)
    closed, _ = plain_triangles(np.delete(BALL, gone, 0), 3.5)
    assert components(*unshared(closed)).solid.all()
    assert len(closed) == len(BALL)


def test_two_neighbours_are_added_as_one_cover() -> None:
    corners = [set(map(tuple, face)) for face in BALL.round(9).tolist()]
    other = next(k for k in range(1, len(BALL)) if len(corners[0] & corners[k]) == 2)
    found, beside = missing_triangles(np.delete(BALL, [0, other], 0))
    assert len(found) == len(beside) == 2


def test_deliberate_openings_stay_open() -> None:
    box = triangles_of(Manifold.cube((1, 1, 1)))
    sheets = box[~(box[:, :, 2] == 1).all(1)]  # a bin of sheets
    flat = box[(box[:, :, 2] == 0).all(1)]
    prism = triangles_of(Manifold.cylinder(1, 1, 1, 3))
    tent = prism[~(prism[:, :, 2] == 0).all(1)]
    bowl = BALL[BALL[:, :, 2].max(1) <= 0.6]
    for surface in (sheets, flat, tent, bowl, np.delete(sheets, 0, 0), np.zeros((0, 3, 3))):
        assert len(missing_triangles(surface)[0]) == 0


def test_added_triangles_have_the_material_of_a_neighbour() -> None:
    _, kept = plain_triangles(BIN[1:], 0.54)
    assert kept.tolist()[:-1] == list(range(len(BIN) - 1))
    assert len({tuple(p) for p in BIN[1:][kept[-1]]} & {tuple(p) for p in BIN[0]}) == 2
